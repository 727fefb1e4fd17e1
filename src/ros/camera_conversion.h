// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "plumbline/camera/camera.h"

namespace plumb::ros_adapter {

// Without header; R is the identity, P repeats K.
sensor_msgs::CameraInfo ToCameraInfoMsg(const Camera& camera);

// Throws std::invalid_argument naming the field that is wrong: a model that is neither
// plumb_bob nor rational_polynomial, a wrong number of coefficients, skew in K, binning or a region
// of interest, or what Camera itself refuses. `name` becomes the camera's.
Camera FromCameraInfoMsg(const sensor_msgs::CameraInfo& msg, const std::string& name);

// Whether both describe the same sensor and lens, to the last bit; names do not count.
bool IsSameCamera(const Camera& a, const Camera& b);

}  // namespace plumb::ros_adapter
