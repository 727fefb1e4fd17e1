// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <plumbline/Georeference.h>
#include <std_msgs/Header.h>

#include "plumbline/georeference/georeference.h"
#include "plumbline/georeference/survey.h"

namespace plumb::ros_adapter {

// `survey` is the one it was computed with, or null.
plumbline::Georeference ToGeoreferenceMsg(const Georeference& georeference,
                                          const Survey* survey,
                                          const std_msgs::Header& header);

}  // namespace plumb::ros_adapter
