#!/bin/sh
# SPDX-License-Identifier: MIT
# Shoots atrium.json anew: from each of the study's cameras 64 shots through a grid of its pixels, in
# seven colours, each with a range of 0.5 m. What one camera shoots the others see from the side.
set -eu
cd "$(dirname "$0")"
set --
for camera in atrium vases aisle gallery; do
  fires=""
  for i in $(seq 0 63); do
    case $((i % 7)) in
      0) color=ff5010 ;; 1) color=1a80ff ;; 2) color=30c040 ;; 3) color=ffc800 ;;
      4) color=c030c0 ;; 5) color=10b0a0 ;; *) color=e03060 ;;
    esac
    # Every second row half a step to the right.
    fires="$fires --add sspm=$((20 + 80 * (i % 8) + 40 * (i / 8 % 2))),$((22 + 45 * (i / 8))),color=#$color,range=0.5"
  done
  # shellcheck disable=SC2086
  grisaille render --camera "../cameras/$camera.json" --size 640x360 --effects sspm "$@" $fires \
    --save sspm=atrium.json --write depth=depth.exr
  set -- --load sspm=atrium.json
done
rm depth.exr
