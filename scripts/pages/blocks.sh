# Sourced by the scripts beside it: blocks of a page of docs/ that are printed by commands, between the lines
#   <!-- printed: NAME -->   and   <!-- end -->

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

VURIS=$(realpath "${1:-target/release/vuris}")
WORK=target/pages
export PYTHONDONTWRITEBYTECODE=1

fail() {
  echo "$(basename "$0"): $1" >&2
  exit 1
}

[[ -x $VURIS ]] || fail "$VURIS is not there; way out: cargo build --release --locked"

# What a command line of vuris prints, below that line.
shown() { shown_as "$*" "$@"; }

# The same, with $1 in the line's place, where files would make it too long.
shown_as() {
  local printed
  printed=$("$VURIS" "${@:2}" 2>&1) || fail "vuris $1: $printed"
  printf '```console\n$ vuris %s\n%s\n```\n' "$1" "$printed"
}

# Standard input takes the place of block $2 of the page $1, and is printed, too.
put() {
  local page=$1 name=$2 printed
  grep -qxF "<!-- printed: $name -->" "$page" || fail "$page has no block $name"
  printed=$(mktemp)
  tee "$printed"
  [[ -s $printed ]] || fail "nothing was printed for $name; $page stays as it was"
  awk -v begin="<!-- printed: $name -->" -v printed="$printed" '
    inside && $0 == "<!-- end -->" { inside = 0 }
    !inside { print }
    $0 == begin { inside = 1; while ((getline line < printed) > 0) print line }
  ' "$page" >"$printed.page"
  cat "$printed.page" >"$page"
  rm "$printed" "$printed.page"
}
