#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# view_pictures.sh FOLDER WxH SCALE BACKEND [NAMES]: makes the pictures of the viewer's manual pages again, in
# FOLDER, on a display of WxH pixels with the text scale SCALE (1 or more) of the desktop, and on
# BACKEND (opengl or vulkan). Look at them for text that is cut, overlaps or is too small.
# NAMES: an extended regular expression; it makes only the pictures whose names match.
# It runs the commands of docs/manual/view.md and docs/manual/view_tasks.md with other values of
# --size and --backend. Needs a build, Xvfb, and xrdb (Debian: xvfb, x11-xserver-utils).
set -euo pipefail
[[ $# -ge 4 && $# -le 5 && $2 =~ ^[0-9]+x[0-9]+$ && $4 =~ ^(opengl|vulkan)$ ]] || { sed -n '3,8s/^# \{0,1\}//p' "$0" >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mkdir -p "$1"
cd "$1"
size=$2 scale=$3 backend=$4 names=${5:-}

exec {ready}<> <(:)
# With -noreset, the scale stays when no program is connected.
Xvfb -displayfd "$ready" -screen 0 "${size}x24" -nolisten tcp -noreset 2>/dev/null &
server=$!
trap 'kill $server' EXIT
read -r -u "$ready" number
export DISPLAY=:$number PATH=$root/build/bin:$PATH XDG_CONFIG_HOME=$PWD/config XDG_STATE_HOME=$PWD/state
printf 'Xft.dpi: %d\n' "$(awk "BEGIN {print int(96 * $scale + 0.5)}")" | xrdb -merge

other=vulkan
[[ $backend == vulkan ]] && other=opengl
for page in view view_tasks; do
  # shellcheck disable=SC2016  # the backticks are those of a block in Markdown
  sed -n '/^```sh$/,/^```$/{/^```/d;p}' "$root/docs/manual/$page.md" | grep -E '^(printf .* > [a-z_]+\.json|grisaille (render|scene) |grisaille view .*--capture )' |
    sed -E "/^grisaille view/{s/ --size [0-9]+x[0-9]+/ --size $size/; s/ --backend [a-z]+//; s/ --split-backend [a-z]+/ --split-backend $other/; s/\$/ --backend $backend --fresh/}"
done >commands.sh
sed -i '/--session /s/ --fresh$//' commands.sh
if [[ -n $names ]]; then
  sed -i -E "/--capture/{/--capture ($names)\.png/!d}" commands.sh
fi
bash -euo pipefail commands.sh
