#!/usr/bin/env bash
# From a clean clone to a report in the browser: installs missing packages, builds, renders a room
# with the noise of a depth camera, estimates the camera's trajectory, and compares it with the
# ground truth. Writes out/demo/report.html. Takes no arguments. Environment: JOBS, the number of
# parallel build processes (default: one per processor).
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}
room=out/demo-room
result=out/demo

say() { printf '\n== %s\n' "$*"; }

say "Packages"
cmake/install_packages.sh report

say "Build"
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release
cmake --build build --parallel "$jobs" --target msc_vo_command
msc_vo=build/apps/msc_vo

if [[ ! -d $room ]]; then
  say "Render a room: 150 images with the noise of a Kinect"
  # Renamed when complete, so that an interrupted run leaves no incomplete sequence.
  rm -rf "$room.part"
  "$msc_vo" synthesize "$room.part" --scene room --frames 150 --noise kinect
  mv "$room.part" "$room"
fi

say "Track"
"$msc_vo" replay "$room" --output "$result"

say "Evaluate"
"$msc_vo" evaluate "$room/groundtruth.txt" "$result/trajectory.txt"

say "Done: open $PWD/$result/report.html"
