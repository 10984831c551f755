# Sourced by the scripts of real recordings beside it: where these are.

source "$(dirname "${BASH_SOURCE[0]}")/blocks.sh"

[[ -n ${VURIS_REAL:-} ]] || fail "VURIS_REAL is not set; way out: VURIS_REAL=DIR make real-pages, DIR with flimfast/ and cfpe/"
VURIS_REAL=$(realpath "$VURIS_REAL")
OUT=$WORK/real
mkdir -p "$OUT"

# The folder $1 of VURIS_REAL, which has the file $2, by a name that does not depend on where it is.
linked() {
  [[ -e $VURIS_REAL/$1/$2 ]] || fail "$VURIS_REAL/$1 has no $2; expected the files that docs/real-$1.md lists"
  ln -sfn "$VURIS_REAL/$1" "$OUT/$1"
}
