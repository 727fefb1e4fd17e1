// SPDX-FileCopyrightText: 2026 The Plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/yaml_hint.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(TabulatorHint, NamesTheFirstLineThatIsIndentedByOne) {
  EXPECT_EQ(TabulatorHint("a:\n  b: 1\n \tc: 2\n\td: 3\n"),
            "; line 3 is indented by a tabulator: use spaces");
}

TEST(TabulatorHint, LeavesTabulatorsWithinALineAlone) {
  EXPECT_EQ(TabulatorHint("a:\t1\n  b: 2\t# c\n"), "");
  EXPECT_EQ(TabulatorHint(""), "");
}

}  // namespace
}  // namespace plumb
