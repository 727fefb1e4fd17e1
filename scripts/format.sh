#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs clang-format-14 over all C++ sources with the given arguments: -i, or --dry-run -Werror.
set -euo pipefail
cd "$(dirname "$0")/.."
find include src test -name '*.h' -o -name '*.cc' | xargs clang-format-14 "$@"
