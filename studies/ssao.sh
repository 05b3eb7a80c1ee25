#!/bin/sh
# SPDX-License-Identifier: MIT
# Measures the settings of ssao.grids on the gallery. Writes ssao.csv and the effect's presets.
# Measurements that the folder ssao/ holds are not repeated. Takes twenty minutes on two cores.
#
# usage: studies/ssao.sh [FOLDER_OF_SCENES]
set -eu
[ $# -eq 0 ] || scenes=$(cd "$1" && pwd)
cd "$(dirname "$0")"
grisaille measure --gallery gallery.toml ${scenes:+--scenes "$scenes"} --grids ssao.grids \
  --samples 128 --size 1280x720 --rounds 3 --backend both --out ssao \
  --presets ../effects/ssao/presets.toml --also classic=ssao.estimator=classic
cp ssao/results.csv ssao.csv
