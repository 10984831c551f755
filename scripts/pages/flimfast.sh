#!/usr/bin/env bash
#
# Diagnoses the recording flimfast, and writes what is printed into docs/real-flimfast.md:
#
#   VURIS_REAL=DIR bash scripts/pages/flimfast.sh [vuris]

source "$(dirname "${BASH_SOURCE[0]}")/real.sh"

PAGE=docs/real-flimfast.md
linked flimfast frames.npy

(
  echo '```toml'
  cat "$OUT/flimfast/recording.toml"
  echo '```'
) | put "$PAGE" recording
shown diagnose "$OUT/flimfast" --json "$OUT/flimfast.json" --report "$OUT/flimfast.html" | put "$PAGE" diagnosis
python3 scripts/pages/settings.py "$OUT/flimfast.json" | put "$PAGE" settings
python3 scripts/pages/fading.py "$OUT/flimfast" "$OUT/flimfast.json" | put "$PAGE" fading
python3 scripts/pages/picture.py "$OUT/flimfast.html" "frame of a set" docs/images/flimfast-frames.svg
python3 scripts/pages/picture.py "$OUT/flimfast.html" "row" docs/images/flimfast-rows.svg
