// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/Gaps.h>
#include <plumbline/MeshDelta.h>

#include <map>
#include <optional>
#include <vector>

#include "plumbline/quality/gaps.h"
#include "plumbline/quality/quality_block.h"

namespace plumb::ros_adapter {

// The qualities that are not known yet are those of a face that nobody sees.
plumbline::MeshBlock ToMeshBlockMsg(const QualityBlock& block);

// With the advice for the camera given; without header.
plumbline::Gaps ToGapsMsg(const std::vector<Gap>& gaps,
                          const GapOptions& options,
                          const Measure& measure,
                          const std::optional<Rigid3>& newest_cam_from_map);

}  // namespace plumb::ros_adapter
