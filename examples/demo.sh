#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From a bare Debian 12 to a solved SLAM problem: installs what hcsp needs, builds it, solves the shipped model
# and leaves slam.html at the root of the project. Run as root or as a user with sudo.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

echo "== 1/3 Packages"
examples/install_packages.sh build

echo "== 2/3 Build (Release, into build/release)"
cmake --preset release -DHCSP_BUILD_TESTS=OFF
cmake --build build/release --target hcsp-solve

echo "== 3/3 Solve models/slam/slam.hcsp: where was the robot, and where are the walls?"
build/release/lang/hcsp-solve models/slam/slam.hcsp --truth models/slam/room_truth.csv -o slam.html

echo
echo "The trajectory, the map and the dug space are drawn in $PWD/slam.html: open it in any browser."
