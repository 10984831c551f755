#!/usr/bin/env bash
#
# Imports and diagnoses the pictures cfpe, and writes what is printed into docs/real-cfpe.md:
#
#   VURIS_REAL=DIR bash scripts/pages/cfpe.sh [vuris]

source "$(dirname "${BASH_SOURCE[0]}")/real.sh"

PAGE=docs/real-cfpe.md
IN=$OUT/cfpe
linked cfpe 0100h.bmp
linked cfpe 0411h.bmp

# Nothing is modulated here: any frequency will do.
UNTOLD=(--frequency-hz 30e6 --frame-period-s 0.1)

# Every $4th of the twelve pictures of scene $2 as recording $1, of a step of $3 degrees; more options after these.
take() {
  local out=$OUT/$1 scene=$2 degrees=$3 every=$4 step files=()
  shift 4
  for ((step = 0; step < 12; step += every)); do files+=("$IN/$scene$(printf %02d "$step")h.bmp"); done
  local options=(--steps "${#files[@]}" --step-deg "$degrees" "${UNTOLD[@]}" "$@" --out "$out")
  rm -rf "$out"
  shown_as "import stack $IN/$scene{00..11..$every}h.bmp ${options[*]}" import stack "${files[@]}" "${options[@]}"
}

# The phase of every picture's pixels, from all twelve and from every third and fourth.
wiggling() { # scene
  local kind
  take "$1" "$1" 30 1 >/dev/null
  take "$1-four" "$1" 90 3 >/dev/null
  take "$1-three" "$1" 120 4 >/dev/null
  for kind in "" -four -three; do
    "$VURIS" process "$OUT/$1$kind" --spec vuris --scheme auto --out "$OUT/$1$kind-phase" >/dev/null
  done
  echo "scene $1, four of twelve:  $(python3 scripts/pages/wiggling.py "$OUT/$1-phase" "$OUT/$1-four-phase" 4)"
  echo "scene $1, three of twelve: $(python3 scripts/pages/wiggling.py "$OUT/$1-phase" "$OUT/$1-three-phase" 3)"
}

take 01 01 30 1 | put "$PAGE" import
(
  echo '```'
  wiggling 01
  wiggling 04
  echo '```'
) | put "$PAGE" wiggling
shown diagnose "$OUT/01" --report "$OUT/01.html" --write-camera "$OUT/01-camera.toml" | put "$PAGE" diagnosis
python3 scripts/pages/picture.py "$OUT/01.html" "signal, DN" docs/images/cfpe-signal.svg
python3 scripts/pages/picture.py "$OUT/01.html" "phase, turns" docs/images/cfpe-phase.svg
(
  echo '```toml'
  sed -n '/^\[correlation\]/,$p' "$OUT/01-camera.toml"
  echo '```'
) | put "$PAGE" camera
shown diagnose "$OUT/04" | put "$PAGE" other
take 04-told 04 30 1 --camera "$OUT/01-camera.toml" >/dev/null
shown diagnose "$OUT/04-told" | put "$PAGE" told

# Every scene that is there, alone, and told by every other one: what verdicts say of it.
scenes=()
for scene in 01 04 06 08; do [[ -e $IN/${scene}00h.bmp ]] && scenes+=("$scene"); done
for scene in "${scenes[@]}"; do
  take "$scene" "$scene" 30 1 >/dev/null
  "$VURIS" diagnose "$OUT/$scene" --json "$OUT/$scene.json" --write-camera "$OUT/$scene-camera.toml" >/dev/null
done
for scene in "${scenes[@]}"; do
  for other in "${scenes[@]}"; do
    [[ $scene == "$other" ]] && continue
    take "$scene-by-$other" "$scene" 30 1 --camera "$OUT/$other-camera.toml" >/dev/null
    "$VURIS" diagnose "$OUT/$scene-by-$other" --json "$OUT/$scene-by-$other.json" >/dev/null
  done
done
python3 scripts/pages/scenes.py "$OUT" "${scenes[@]}" | put "$PAGE" scenes
