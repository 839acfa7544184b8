#!/usr/bin/env bash
# Builds msc_vo for 64-bit ARM on a Debian 12 of another architecture.
#
#   cross_build.sh ROOT BUILD [TARGET...]
#
# ROOT holds the libraries for arm64 of cmake/debian_packages*.txt; it is made unless it exists, and needs
# 1.5 GB. BUILD is the folder of the build, TARGETs are those of its Ninja (default: all). Programs and
# unit tests run under qemu-user:
#
#   qemu-aarch64 -L ROOT BUILD/apps/msc_vo --version
#   ctest --test-dir BUILD -L unit
#
# install_packages.sh arm64 installs what this script needs.
set -euo pipefail
if [[ $# -lt 2 ]]; then
  echo "usage: cmake/cross_build.sh ROOT BUILD [TARGET...]" >&2
  exit 2
fi
root=$(realpath --canonicalize-missing "$1")
build=$2
source=$(realpath "$(dirname "$0")/..")
libraries=/usr/lib/aarch64-linux-gnu

if [[ ! -d $root ]]; then
  # The libraries, and g++ for that of C++.
  packages=$(cd "$source/cmake" && grep --no-filename --extended-regexp '^(lib|nlohmann|g\+\+)' \
             debian_packages.txt debian_packages_report.txt debian_packages_developer.txt)
  mmdebstrap --architectures=arm64 --variant=extract --include="${packages//$'\n'/,}" bookworm "$root.new" \
             http://deb.debian.org/debian
  # What the packages' scripts would do, which are for arm64: the alternatives of BLAS and LAPACK.
  for name in libblas.so libblas.so.3 liblapack.so liblapack.so.3; do
    ln --symbolic "atlas/$name" "$root.new$libraries/$name"
  done
  # Ceres names these libraries by absolute paths.
  sed --in-place "s#;$libraries/#;$root$libraries/#g" "$root.new$libraries/cmake/Ceres/CeresTargets.cmake"
  mv "$root.new" "$root"
fi

cmake -S "$source" -B "$build" -G Ninja --toolchain "$source/cmake/toolchains/aarch64-linux-gnu.cmake" \
      -DCMAKE_SYSROOT="$root" -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DMSC_VO_WARNINGS_AS_ERRORS=ON
cmake --build "$build" ${3:+--target "${@:3}"}
