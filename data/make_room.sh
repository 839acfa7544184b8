#!/usr/bin/env bash
# Renders data/room, the sample sequence of this repository: 32 images along a trajectory through a
# furnished room, with the depth noise of a Kinect. Argument: the msc_vo command (default: that of
# build/). The seed is fixed, so that the same build gives the same files.
set -euo pipefail
cd "$(dirname "$0")/.."
msc_vo=${1:-build/apps/msc_vo}

if [[ ! -x $msc_vo ]]; then
  echo "$msc_vo is not there: build the target msc_vo_command, or give the command's path" >&2
  exit 1
fi
# A fast camera and five images per second show three walls of the room in a few megabytes.
exec "$msc_vo" synthesize data/room --scene room --seed 8 --frames 32 --fps 5 --speed 0.5 \
  --noise kinect --image-sigma 1 --jpeg --jpeg-quality 90 --overwrite
