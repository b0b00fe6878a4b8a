#!/bin/sh
# Runs every deck of inputs/ and tells where the figures are; without decks also draws what compares several runs.
# scripts/make_figures.sh PROGRAM [DECK...]
set -u
cd "$(dirname "$0")/.." || exit 1

program=$1
shift
comparisons=""
if [ $# -eq 0 ]; then
   comparisons="scripts/four_bar_figures scripts/law_figures scripts/slider_crank_figures scripts/lubrication_figures scripts/space_figures"
   set -- inputs/*.deck
fi
[ -e "$1" ] || { echo "no decks in inputs/" >&2; exit 1; }

failed=""
for deck in "$@"; do
   name=$(basename "$deck" .deck)
   if "$program" run "$deck" --out "outputs/$name" --quiet; then
      n=$(find "outputs/$name/figures" -name '*.png' 2>/dev/null | wc -l)
      echo "$deck: $n figures in outputs/$name/figures"
   else
      echo "$deck: ended with code $?" >&2
      failed="$failed $name"
   fi
done
for script in $comparisons; do
   "${PYTHON:-/usr/bin/python3}" -B "$script" "$program" || failed="$failed $(basename "$script")"
done
[ -z "$failed" ] || { echo "failed:$failed" >&2; exit 1; }
