// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace plumb {

// "marker 3", "markers 3, 5 and 7".
std::string NameMarkers(const std::vector<int>& ids);

// "photo a.jpg", "photos a.jpg and b.jpg", "photos a.jpg, b.jpg and 3 more".
std::string NamePhotos(const std::vector<std::string>& names);

// "1 photo", "3 photos".
std::string Count(std::size_t count, const std::string& noun);

// Fixed notation.
std::string Number(double value, int digits);

// "12 mm" where lengths are metres, "0.25 marker diameters" otherwise.
std::string Length(double length, bool is_metric);

}  // namespace plumb
