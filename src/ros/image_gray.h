// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sensor_msgs/Image.h>

#include "plumbline/image/gray_photo.h"

namespace plumb::ros_adapter {

// Grey values of an image of a topic: colour, Bayer, mono and 16 bits. 16-bit values are scaled by
// the smallest whole number of bits that holds them, for cameras write 10, 12 or 14. Never throws
// for what the message holds.
GrayPhoto ToGrayPhoto(const sensor_msgs::ImageConstPtr& msg);

}  // namespace plumb::ros_adapter
