// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulation/photo_job.h"
#include "simulation/sample_list.h"

namespace plumb::internal {

// Computes the radiance of every sample of the list: the mean over samples_per_axis^2
// places of its footprint, which is `footprint_px` wide.
void ShadeSamples(const PhotoJob& job,
                  int samples_per_axis,
                  float footprint_px,
                  SampleList* samples);

}  // namespace plumb::internal
