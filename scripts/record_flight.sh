#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Records the wire of a flight to SESSION/flight.bag; an earlier one there becomes flight_1.bag,
# flight_2.bag, … and one that was cut off flight_1.bag.active, … (`rosbag reindex` mends it). The
# first argument is the session folder; roslaunch adds its own.
set -euo pipefail
session=$1
shift
if [[ $session != /* ]]; then
  exit 78  # The nodes say so.
fi
mkdir -p "$session"
set_aside() {
  [[ -e $session/flight$1 ]] || return 0
  local number=1
  while [[ -e $session/flight_$number.bag || -e $session/flight_$number.bag.active ]]; do
    number=$((number + 1))
  done
  mv "$session/flight$1" "$session/flight_$number$1"
}
set_aside .bag
set_aside .bag.active
exec rosrun rosbag record -O "$session/flight.bag" --buffsize=0 \
  /plumbline/photo /plumbline/photo_verdict /plumbline/stored_photos /plumbline/map_delta \
  /plumbline/session_camera /plumbline/marker_detections /plumbline/photo_positions /plumbline/georeference \
  /plumbline/metres_per_map_unit /plumbline/control_points \
  /diagnostics /tf /rosout "$@"
