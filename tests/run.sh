#!/usr/bin/env bash
# Builds everything into ./build and runs every test. On Debian 12 it first installs missing packages.
# Environment: JOBS, the number of parallel processes (default: one per processor).
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}

step=none
begin() {
  step=$1
  printf '\n== %s (%d s)\n' "$step" "$SECONDS"
}
summary() {
  local status=$?
  if [[ $status -eq 0 ]]; then
    printf '\ntests/run.sh: everything passed in %d s\n' "$SECONDS"
  else
    printf '\ntests/run.sh: FAILED in step "%s" after %d s\n' "$step" "$SECONDS" >&2
  fi
}
trap summary EXIT

begin "packages"
cmake/install_packages.sh report optional tests
begin "configure"
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release \
      -DMSC_VO_BUILD_APPS=ON -DMSC_VO_BUILD_TESTS=ON
begin "build"
cmake --build build --parallel "$jobs"
begin "test"
ctest --test-dir build --parallel "$jobs" --output-on-failure
