// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plumbline/map/photo_verdict.h"

namespace plumb {

// What speaks for the pose, for a person: "1041 landmarks agree", of a photo that is not located
// "12 of 94 matches agree". Empty if no match was tried.
std::string DescribeAgreement(const PhotoVerdict& verdict);

}  // namespace plumb
