// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace plumb {

// Visits the outline of each 8-connected set of pixels that are not 0, and of each hole in one:
// the set's own pixels along the hole. A set without extent is one point; otherwise neighbours in
// the list are neighbours in the image, and a pixel that is passed twice is in it twice. The list
// is valid during the visit. Outlines come in the order of their topmost, leftmost pixels.
//
// What cv::findContours finds with RETR_LIST and CHAIN_APPROX_NONE, but without storing it: a photo
// of trees has a million specks.
//
// The mask is of CV_8U; its pixels are overwritten, and those of its rim count as 0.
void VisitOutlines(cv::Mat& mask, const std::function<void(const std::vector<cv::Point>&)>& visit);

}  // namespace plumb
