#!/bin/sh
# SPDX-License-Identifier: MIT
# Measures settings of `ssao` on the gallery, and writes ssao_gallery.csv. Measurements that the
# folder ssao/ holds are not repeated. Takes half an hour on two cores.
#
# usage: studies/ssao.sh [FOLDER_OF_SCENES]
set -eu
[ $# -eq 0 ] || scenes=$(cd "$1" && pwd)
cd "$(dirname "$0")"

measure() {
  grisaille measure --gallery gallery.toml ${scenes:+--scenes "$scenes"} "$@" --samples 128 \
    --size 1280x720 --rounds 3 --backend both --out ssao
}

# sweep KEY=VALUE,...: settings of the slices. All sweeps name the same parameters.
sweep() {
  swept="--sweep ssao.estimator=slices --sweep ssao.slices=1"
  for one in "$@"; do swept="$swept --sweep ssao.$one"; done
  # shellcheck disable=SC2086
  measure $swept
}

# Backs that are assumed.
assumed="thickness=0.7 backs=assumed refine=nothing contrast=0.1 edge_denoise=6 guard_band=0.045"
# shellcheck disable=SC2086
{
  sweep resolution=full edge_slices=1 kernel_size=12,16 blur_size=5 $assumed
  sweep resolution=half edge_slices=2 kernel_size=12,16 blur_size=10 $assumed
  sweep resolution=quarter edge_slices=2 kernel_size=12 blur_size=20 $assumed
}

# The thickness of bodies.
quarter="resolution=quarter edge_slices=2 blur_size=20 thickness=1 guard_band=0.045"
half="resolution=half edge_slices=1 blur_size=10 thickness=1 guard_band=0.045 edge_denoise=1"
# shellcheck disable=SC2086
{
  sweep $quarter kernel_size=20 backs=bodies refine=nothing contrast=0.1 edge_denoise=1,6
  sweep $quarter kernel_size=24 backs=bodies refine=edges contrast=0.1 edge_denoise=1
  sweep $quarter kernel_size=24 backs=bodies refine=contrasts contrast=0.1,0.2 edge_denoise=1
  sweep $half kernel_size=16,20,24 backs=bodies refine=edges contrast=0.1
  sweep $half kernel_size=24 backs=bodies refine=contrasts contrast=0.1,0.2
  sweep resolution=full edge_slices=1 kernel_size=16,24 blur_size=5 thickness=1 backs=bodies \
    guard_band=0.045 refine=nothing contrast=0.1 edge_denoise=6
}

# Drawn backs.
wide="thickness=1 guard_band=0.09 edge_denoise=1 contrast=0.1"
# shellcheck disable=SC2086
{
  sweep $quarter kernel_size=24 backs=drawn refine=contrasts contrast=0.1,0.2 edge_denoise=1
  sweep $half kernel_size=24 backs=drawn refine=contrasts contrast=0.1,0.2
  sweep $wide resolution=half edge_slices=2 kernel_size=24,32 blur_size=10 backs=drawn \
    refine=contrasts
  sweep $wide resolution=full edge_slices=1,2 kernel_size=48 blur_size=5 backs=drawn refine=nothing
  sweep $wide resolution=half edge_slices=1 kernel_size=24 blur_size=10 backs=peeled \
    refine=contrasts
  sweep $wide resolution=full edge_slices=1 kernel_size=48 blur_size=5 backs=peeled refine=nothing
}

measure --sweep ssao.estimator=classic --sweep ssao.kernel_size=16,64 --sweep ssao.blur_size=4 \
  --sweep ssao.blur=edge_aware --sweep ssao.intensity=2
cp ssao/results.csv ssao_gallery.csv
