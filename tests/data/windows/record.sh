#!/usr/bin/env bash
# Records the windows of this folder. Arguments: the msc_vo command (default: that of build/) and a
# folder for the rendered sequences (default: a temporary one).
set -euo pipefail
cd "$(dirname "$0")"
msc_vo=$(realpath "${1:-../../../build/apps/msc_vo}")
work=$(realpath "${2:-$(mktemp -d)}")

# record NAME SEQUENCE POINTS LINES KEYFRAME: the window of a keyframe of a replay.
record() {
  "$msc_vo" replay "$2" --quiet --output "$work/out_$1" --dump-windows "$work/windows_$1" \
    --set "features.points.num_points=$3" --set "features.lines.max_lines=$4"
  cp "$work/windows_$1/window_$(printf %06d "$5").txt" "$1.txt"
}
synthesize() {
  "$msc_vo" synthesize "$work/$1" --scene "$1" --frames 90 --noise kinect --jpeg --seed 3 \
    --fps 15 --speed 0.5
}

record room ../../../data/room 120 40 7
synthesize corridor
record corridor "$work/corridor" 120 40 8
synthesize house
record house "$work/house" 70 30 16
