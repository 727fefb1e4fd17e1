#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a command, and again whenever it crashes: roslaunch's respawn would also repeat, without an end,
# the start of a node with a wrong parameter. Such a node ends with 78 (EX_CONFIG), and so does this.
set -uo pipefail
is_ending=
trap 'is_ending=1' INT TERM
while true; do
  "$@"
  code=$?
  if [[ $code == 0 || $code == 78 || -n $is_ending ]]; then
    exit "$code"
  fi
  echo "$(basename "$1") has ended with code $code and is started again" >&2
  sleep 2
done
