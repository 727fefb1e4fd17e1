#!/bin/bash
# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs those of Debian 12's packages that Plumbline needs and that are missing. With
# --lint, those of `make lint` and `make format` as well. Says nothing if nothing is missing.
set -euo pipefail

packages=(
  # Build.
  build-essential ccache cmake pkg-config
  # The core.
  libcairo2-dev libceres-dev libcgal-dev libcli11-dev libeigen3-dev libembree-dev libexiv2-dev libjpeg-dev
  libnanoflann-dev libopencv-dev libproj-dev libsqlite3-dev libsuitesparse-dev libyaml-cpp-dev
  nlohmann-json3-dev zlib1g-dev
  # ROS 1.
  libcv-bridge-dev libdiagnostic-updater-dev librosbag-storage-dev libtf2-ros-dev python3-diagnostic-msgs python3-nav-msgs python3-rostest
  python3-sensor-msgs python3-std-srvs python3-tf2-ros python3-visualization-msgs
  ros-core-dev rosbash rviz
  # The calibrator and the RViz panel.
  libtopic-tools-dev librviz-dev pluginlib-dev qtbase5-dev
  # Tests and the demo.
  imagemagick libapriltag-dev libbenchmark-dev libgl1-mesa-dri libgmock-dev libgtest-dev libmaxflow-dev libopencv-contrib-dev python3-numpy
  python3-yaml x11-utils xauth xvfb
)
if [[ ${1:-} == --lint ]]; then
  packages+=(clang-format-14 clang-tidy-14)
fi

installed=$(dpkg-query -W -f '${db:Status-Status} ${binary:Package}\n' |
  sed -n 's/^installed \([^:]*\).*/\1/p')
missing=$(comm -13 <(sort -u <<<"$installed") <(printf '%s\n' "${packages[@]}" | sort -u))
if [[ -z $missing ]]; then
  exit 0
fi

as_root=()
if [[ $EUID -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "These packages are missing; install them as root:" $missing >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "Installing:" $missing
"${as_root[@]}" apt-get update
# shellcheck disable=SC2086  # One word a package.
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y --no-install-recommends $missing
