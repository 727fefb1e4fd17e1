// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/run_node.h"

#include <langinfo.h>

#include <clocale>
#include <string>

namespace plumb::ros_adapter {

void UseUtf8InLogs() {
  std::setlocale(LC_CTYPE, "");
  if (nl_langinfo(CODESET) != std::string("UTF-8")) std::setlocale(LC_CTYPE, "C.UTF-8");
}

}  // namespace plumb::ros_adapter
