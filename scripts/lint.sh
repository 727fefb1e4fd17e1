#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks layers, licences, format, the generated pages, that the benchmarks compile, and clang-tidy.
# The argument is the build folder.
set -uo pipefail
cd "$(dirname "$0")/.."
build=${1:?the build folder}
failed=0
fail() {
  echo "lint: $*" >&2
  failed=1
}

core=$(find include src -name '*.h' -o -name '*.cc' | grep -vE '^src/(ros|nodes|rviz)/')
packages='ros|roscpp|rosbag|rosgraph_msgs|cv_bridge|pluginlib|nodelet|rviz|tf2?|tf2_[a-z]+'
packages+='|image_transport|dynamic_reconfigure|diagnostic_updater|xmlrpcpp|[a-z]+_msgs|std_srvs'
if grep -nE "#include [<\"](($packages)/|plumbline/[A-Z])" $core; then
  fail "a ROS header in the core, which is free of ROS"
fi
for file in $(find include src test scripts cmake msg srv config launch rviz -type f \
  -not -name '*.pyc' -not -path 'test/data/*') Makefile CMakeLists.txt; do
  head -n 4 "$file" | grep -q 'SPDX-License-Identifier: GPL-3.0-or-later' ||
    fail "$file has no licence header"
done
scripts/format.sh --dry-run -Werror || fail "unformatted sources; run make format"
"$build/list_parameters" >/dev/null && scripts/parameters_doc.py --check "$build/list_parameters" ||
  fail "docs/parameters.md"

cmake --build "$build" -j"$(nproc)" --target benchmarks >/dev/null || fail "the benchmarks"

mkdir -p "$build/lint"
cmake -S . -B "$build/lint" -DPLUMBLINE_BUILD_ROS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null ||
  fail "cmake for clang-tidy"
# clang 14 does not know avxvnni, for which tile_kernel.cc asks the processor.
grep '\.cc$' <<<"$core" | grep -v '/tile_kernel\.cc$' |
  xargs scripts/tidy.py --build "$build/lint" || fail "clang-tidy"
exit $failed
