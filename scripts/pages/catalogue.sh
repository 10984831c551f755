#!/usr/bin/env bash
#
# Makes campaigns by the textbook's formulas (scripts/pages/catalogue.py), diagnoses them, and writes
# what is said of them into docs/catalogue.md:
#
#   bash scripts/pages/catalogue.sh [vuris]

source "$(dirname "${BASH_SOURCE[0]}")/blocks.sh"

PAGE=docs/catalogue.md
OUT=$WORK/catalogue
SEED=${SEED:-712}
PYTHON=
for python in python3 .tools/hdl/bin/python; do
  if "$python" -c 'import numpy' 2>/dev/null; then PYTHON=$python; fi
done
[[ -n $PYTHON ]] || fail "no python with numpy; way out: bash scripts/hdl-tools.sh cocotb"

rm -rf "$OUT"
mkdir -p "$OUT"
for strength in 1 0.33 3; do
  "$PYTHON" scripts/pages/catalogue.py make "$OUT/$strength" "$SEED" "$strength"
  "$PYTHON" scripts/pages/catalogue.py names | RAYON_NUM_THREADS=1 xargs -P "$(nproc)" -I{} \
    sh -c '"$1" diagnose "$2" --json "$2.json" >/dev/null' - "$VURIS" "$OUT/$strength/{}" ||
    fail "a campaign of $OUT/$strength could not be diagnosed"
done
"$PYTHON" scripts/pages/catalogue.py table "$OUT/1" "$OUT/0.33" "$OUT/3" >"$OUT/table.md"
put "$PAGE" answers <"$OUT/table.md"
