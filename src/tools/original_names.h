// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plumbline/map/session_store.h"

namespace plumb::tools {

// `views` under the names their photos had where they came from, without folders: a photo that was
// copied anew after the first copy was refused is kept as a_2.jpg, but is a.jpg to whoever
// took it. Located photos that came under one name keep the names they have in the session.
std::vector<ViewState> WithOriginalNames(std::vector<ViewState> views,
                                         const std::vector<StoredPhoto>& photos);

}  // namespace plumb::tools
