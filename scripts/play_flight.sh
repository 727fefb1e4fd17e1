#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Plays the photos of a recorded flight once all its topics are heard: BAG RATE, further topics, and
# what roslaunch adds.
set -euo pipefail
bag=$1
rate=$2
shift 2
if [[ $bag != /* ]]; then
  echo "bag must be an absolute path, such as ${PLUMBLINE_CALLED_FROM:-$PWD}/$bag, but is $bag" >&2
  exit 78
fi
if [[ ! -f $bag ]]; then
  echo "$bag: there is no such file; record one with flight.launch record:=true" >&2
  exit 78
fi
exec rosrun rosbag play --quiet --wait-for-subscribers --rate "$rate" "$bag" \
  --topics /plumbline/photo "$@"
