#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what hcsp needs from Debian 12, as root or with sudo; does nothing when all of it is there.
#   install_packages.sh build    what the library and hcsp-solve are built from
#   install_packages.sh test     that, and what the tests use
set -euo pipefail

build=(cmake ninja-build g++ libboost1.81-dev libeigen3-dev libfmt-dev libmpfr-dev libtbb-dev libcli11-dev
       nlohmann-json3-dev coinor-libclp-dev node-d3)
tests=(libgtest-dev libgmock-dev python3 clang-format clang-tidy chromium)

case "${1:-}" in
  build) packages=("${build[@]}") ;;
  test) packages=("${build[@]}" "${tests[@]}") ;;
  *) echo "usage: $0 build|test" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "All packages are installed."
  exit 0
fi

echo "Installing: ${missing[*]}"
as_root=()
if ((EUID != 0)); then as_root=(sudo); fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
