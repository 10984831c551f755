#!/usr/bin/env bash
#
# Runs the cocotb tests on a core of every camera preset, with a small sensor: three seeds in Icarus, one in Verilator.
#
#   bash tb/cocotb/all.sh PATH/OF/vuris
#
# The last line of each run says how many tests have failed; exit code 1: some have.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
vuris=${1:?"say where the program vuris is"}
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
failed=0

run() { # folder, simulator, seed
  local log=$work/log
  if .tools/hdl/bin/python -B tb/cocotb/run.py "$1" --simulator "$2" --seed "$3" >"$log" 2>&1; then
    echo "$(tail -n 1 "$log"), seed $3"
  else
    cat "$log"
    failed=1
  fi
}

for preset in vuris vuris-fast vuris-four-frame; do
  "$vuris" explain --spec "$preset" --toml |
    sed -e 's/^width = .*/width = 24/' -e 's/^height = .*/height = 10/' >"$work/$preset.toml"
  "$vuris" generate --spec "$work/$preset.toml" --out "$work/$preset" >/dev/null
  for seed in 1 2 3; do run "$work/$preset" icarus "$seed"; done
  run "$work/$preset" verilator 1
done
exit "$failed"
