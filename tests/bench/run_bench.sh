#!/usr/bin/env bash
# Speed against error of the dry slider-crank beside a hand-coded program of the same scene (bench.py), time and memory of
# large scenes (large_scenes.py), speed against error of each way of holding the constraints (holding.py), a small run from start to exit
# (small_run.py), a sample beside an evaluation (sample_cost.py), the plane beside space (space_cost.py), the method that auto chooses
# beside every named one on all decks (methods.py), an evaluation of each lubricant film (film_cost.f90), studies of tolerances beside
# the motions of their members (tolerance_cost.py). --docs: docs/theory/evidence/performance.md from all of it (report.py).
# Called by `make bench`, which builds the programs. Options go to all: --repeat N, --quick; --callgrind to the first.
# Speed fails nothing: the exit code is 0 unless something could not be run at all.
set -euo pipefail
cd "$(dirname "$0")/../.."

build=${GUDGEON_BUILD:-build}
python=${PYTHON:-/usr/bin/python3}
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 PYTHONDONTWRITEBYTECODE=1

for program in "$build/gudgeon" "$build/bench/minimal_slider_crank" "$build/bench/film_cost"; do
   if [ ! -x "$program" ]; then
      echo "$program is not there: run \`make bench\`, which builds it" >&2
      exit 1
   fi
done
docs=""
options=()
for option in "$@"; do
   if [ "$option" = --docs ]; then docs=yes; else options+=("$option"); fi
done
set -- "${options[@]+"${options[@]}"}"
"$python" tests/bench/bench.py --build "$build" "$@"
"$build/bench/film_cost" inputs/journal_bearing.deck
"$python" tests/bench/small_run.py --build "$build" "$@"
"$python" tests/bench/sample_cost.py --build "$build" "$@"
"$python" tests/bench/large_scenes.py --build "$build" "$@"
"$python" tests/bench/holding.py --build "$build" "$@"
"$python" tests/bench/space_cost.py --build "$build" "$@"
"$python" tests/bench/methods.py --build "$build" "$@"
"$python" tests/bench/tolerance_cost.py --build "$build" "$@"
[ -z "$docs" ] || "$python" tests/bench/report.py --build "$build"
