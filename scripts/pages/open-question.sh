#!/usr/bin/env bash
#
# Simulates the bench of the paper with a candidate concealed, diagnoses it, and writes
# what is printed into docs/open-question.md:
#
#   bash scripts/pages/open-question.sh [vuris]

source "$(dirname "${BASH_SOURCE[0]}")/blocks.sh"

PAGE=docs/open-question.md
CAMERA=tests/data/paper-bench/camera.toml
OUT=$WORK/open-question
RATIO=1.2337 # constant over modulated light of two square waves, π²/8

rm -rf "$OUT"
mkdir -p "$OUT"

# A measurement takes 125 ms: four frames of 31.25 ms, five of 25 ms. One call has one frame period.
simulate() { # name, camera, options
  local name=$1 camera=$2
  shift 2
  local bench=(--camera "$camera" --constant-ratio "$RATIO" --velocities-m-s 2 "$@")
  shown simulate "${bench[@]}" --frame-period-s 0.03125 --recordings four-sweep,four-rail,four-motion \
    --out "$OUT/$name"
  shown simulate "${bench[@]}" --frame-period-s 0.025 --recordings wdft-sweep,wdft-rail,wdft-motion,harmonics \
    --out "$OUT/$name-wdft"
  printf '```console\n$ mv %s\n```\n' "$OUT/$name-wdft/*/ $OUT/$name"
  mv "$OUT/$name-wdft"/*/ "$OUT/$name"
  rm -r "$OUT/$name-wdft"
}

diagnose() { # campaign or recording, file name
  shown diagnose "$OUT/$1" --json "$OUT/$2.json"
}

FALLOFF=(--effect inverse_square_falloff)
MULTI_PATH=(--effect multipath_interference)
NON_LINEAR=(--effect intensity_nonlinearity)
# The sizes that come nearest to the paper's motion errors, by the table of `vuris paper`.
LARGE_MULTI_PATH=(--effect multipath_interference:relative_amplitude=0.8,wall_distance_m=3.51)
LARGE_NON_LINEAR=(--effect intensity_nonlinearity:quadratic=0.5,cubic=0.6)

simulate falloff "$CAMERA" "${FALLOFF[@]}" | put "$PAGE" simulate
simulate nothing "$CAMERA" >/dev/null
for seed in 1 2 3; do simulate "nothing-$seed" "$CAMERA" --seed "$seed" >/dev/null; done
simulate multi-path "$CAMERA" "${MULTI_PATH[@]}" >/dev/null
simulate non-linear "$CAMERA" "${NON_LINEAR[@]}" >/dev/null
simulate falloff-multi-path "$CAMERA" "${FALLOFF[@]}" "${MULTI_PATH[@]}" >/dev/null
simulate falloff-non-linear "$CAMERA" "${FALLOFF[@]}" "${NON_LINEAR[@]}" >/dev/null
simulate large-multi-path "$CAMERA" "${LARGE_MULTI_PATH[@]}" >/dev/null
simulate large-non-linear "$CAMERA" "${LARGE_NON_LINEAR[@]}" >/dev/null

# The paper gives no phases of Table I's harmonics: here they are others than the simulation believes.
sed 's/^phase_rad.*/phase_rad = [0.0, 2.1, -0.9, 0.4, 1.7, -2.6, 3.0]/' "$CAMERA" >"$OUT/phases.toml"
simulate unknown-phases "$OUT/phases.toml" "${FALLOFF[@]}" >/dev/null
cp "$OUT/falloff/camera.toml" "$OUT/unknown-phases/camera.toml"

(
  echo '```toml'
  sed -n '/^\[physics\]/,$p' "$OUT/falloff/camera.toml"
  echo '```'
) | put "$PAGE" camera
diagnose falloff/four-motion falloff-motion | put "$PAGE" motion
diagnose falloff falloff | put "$PAGE" all

NAMES=(nothing nothing-1 nothing-2 nothing-3 multi-path non-linear falloff-multi-path falloff-non-linear
  large-multi-path large-non-linear unknown-phases)
for name in "${NAMES[@]}"; do
  diagnose "$name/four-motion" "$name-motion" >/dev/null
  diagnose "$name" "$name" >/dev/null
done

verdicts() { # suffix of the file names
  python3 scripts/pages/verdicts.py "nothing=$OUT/nothing$1.json" "nothing, seed 1=$OUT/nothing-1$1.json" \
    "nothing, seed 2=$OUT/nothing-2$1.json" "nothing, seed 3=$OUT/nothing-3$1.json" \
    "falloff=$OUT/falloff$1.json" \
    "multi-path=$OUT/multi-path$1.json" "non-linear pixel=$OUT/non-linear$1.json" \
    "falloff and multi-path=$OUT/falloff-multi-path$1.json" \
    "falloff and non-linear pixel=$OUT/falloff-non-linear$1.json" \
    "multi-path, large=$OUT/large-multi-path$1.json" "non-linear pixel, large=$OUT/large-non-linear$1.json" \
    "falloff and the harmonics' phases=$OUT/unknown-phases$1.json"
}
verdicts -motion | put "$PAGE" verdicts-motion
verdicts "" | put "$PAGE" verdicts-all

"$VURIS" paper | sed -n "/^## The paper's candidates/,/^## Rivals/p" | grep '^|' | put "$PAGE" distances
