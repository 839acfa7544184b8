#!/usr/bin/env bash
# From a clean clone to a report in the browser: installs missing packages, builds, renders a walk of
# 30 s through a furnished house with the noise of a depth camera, estimates the camera's trajectory,
# compares it with the ground truth, and fuses the depth images if Open3D is installed. Writes
# out/demo/report.html, and opens it where there is a display. Takes no arguments. Environment: JOBS,
# the number of parallel build processes (default: one per processor).
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}
house=out/demo-house
result=out/demo

say() { printf '\n== %s\n' "$*"; }

say "Packages"
cmake/install_packages.sh report

say "Build"
options=(-DCMAKE_BUILD_TYPE=Release)
# Compiles several files at a time, in less than half the time. A build folder keeps what it was made with.
if [[ ! -f build/CMakeCache.txt ]]; then options+=(-DCMAKE_UNITY_BUILD=ON); fi
cmake -S . -B build -G Ninja "${options[@]}"
targets=(msc_vo_command)
if [[ $(cmake --build build --target help) == *msc_vo_fusion:* ]]; then
  targets+=(msc_vo_fusion)
fi
cmake --build build --parallel "$jobs" --target "${targets[@]}"
msc_vo=build/apps/msc_vo

if [[ ! -d $house ]]; then
  say "Render a house: a round through its four rooms, 300 images with the noise of a Kinect"
  # Renamed when complete, so that an interrupted run leaves no incomplete sequence.
  rm -rf "$house.part"
  "$msc_vo" synthesize "$house.part" --scene house --frames 300 --fps 10 --speed 0.7 \
            --noise kinect --jpeg
  mv "$house.part" "$house"
fi

say "Track"
"$msc_vo" replay "$house" --output "$result"

if [[ ${#targets[@]} -gt 1 ]]; then
  say "Fuse the depth images into a surface"
  "$msc_vo" fuse "$house" "$result/trajectory.txt" --voxel 0.03 --every 3 \
            --output "$result/surface.ply" --report "$result/report.html"
fi

say "Evaluate"
"$msc_vo" evaluate "$house/groundtruth.txt" "$result/trajectory.txt"

report=$PWD/$result/report.html
if [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xdg-open >/dev/null; then
  say "Done: opening $report"
  xdg-open "$report" >/dev/null 2>&1 || true
else
  say "Done: open $report"
fi
