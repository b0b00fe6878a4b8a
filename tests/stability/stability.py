"""Runs the hard cases in every way the table asks for, prints what came out and writes it as CSV; then random scenes.

Called by `make stability`. The exit code is 1 if one way falls short of its stated limit or a scene goes wrong, else 0.
"""

import argparse
import csv
import dataclasses
import math
import os
import pathlib
import shutil
import sys
import tempfile
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from cases import CASES, ROOT  # noqa: E402
import random_loops  # noqa: E402
import random_statics  # noqa: E402
import sensitivity_survey  # noqa: E402
from friction_runs import run_friction  # noqa: E402
from random_runs import run_random  # noqa: E402
from runs import Result, solve  # noqa: E402

COLUMNS = (("case", 22), ("method", 38), ("tolerance", 9), ("error", 8), ("limit", 7), ("energy_drift", 8), ("violation", 8),
           ("cpu_seconds", 8), ("steps", 7), ("verdict", 0))
TITLES = {"energy_drift": "energy", "cpu_seconds": "CPU s"}


class Progress:
    """What is done and how long the rest will take: one line on a terminal that is written over, now and then a line in a log."""

    def __init__(self, total, stream=sys.stderr, pause=60.0):
        self.total, self.stream, self.pause = total, stream, pause
        self.start = self.told = time.monotonic()
        self.is_terminal = stream.isatty()

    def tell(self, done, label):
        """Say that `done` runs are behind and `label` comes next."""
        now = time.monotonic()
        to_go = f", about {(now - self.start)/done*(self.total - done):.0f} s to go" if done else ""
        if self.is_terminal:
            self.stream.write(f"\r\033[K{done} of {self.total}{to_go}: {label}"[:150])
            self.stream.flush()
        elif now - self.told > self.pause:
            self.told = now
            self.stream.write(f"{done} of {self.total}{to_go}\n")

    def clear(self):
        """Take the line away before something else is printed."""
        if self.is_terminal:
            self.stream.write("\r\033[K")
            self.stream.flush()


def cell(value):
    """A number or word of the table."""
    if isinstance(value, float):
        return "-" if math.isnan(value) else f"{value:.1e}" if value < 1e-2 or value >= 1e3 else f"{value:.3g}"
    return str(value) or "-"


def line(values):
    """A line of the table."""
    return "  ".join(value.ljust(width) for value, (_, width) in zip(values, COLUMNS)).rstrip()


def chosen(only):
    """Cases whose name or deck contains one of the words; all without words."""
    return [case for case in CASES if not only or any(word.lower() in f"{case.name} {case.deck}".lower() for word in only)]


def run_all(program, cases, required_only):
    """Every way of every case; prints each line as it is known."""
    planned = [(case, way) for case in cases for way in case.ways if way.is_required or not required_only]
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="gudgeon_stability_"))
    progress, results, last = Progress(len(planned)), [], None
    print(line([TITLES.get(name, name) for name, _ in COLUMNS]))
    try:
        for number, (case, way) in enumerate(planned):
            progress.tell(number, f"{case.name}, {way.label}")
            directory = scratch / str(number)
            directory.mkdir()
            result = solve(program, case, way, directory)
            shutil.rmtree(directory)
            results.append(result)
            progress.clear()
            if case.name != last:
                print(f"-- {case.name}: {case.what}; {case.deck}")
                last = case.name
            print(line([cell(getattr(result, name)) for name, _ in COLUMNS]), flush=True)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    return results


def wrong_scenes(program, run_all_of, what):
    """Lines about random scenes that went wrong; says how many there were."""
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="gudgeon_random_"))
    progress = Progress(1)

    def tell(done, total, label):
        progress.total = total
        progress.tell(done, label)

    try:
        wrong, total = run_all_of(program, scratch, tell=tell)
    finally:
        progress.clear()
        shutil.rmtree(scratch, ignore_errors=True)
    print(f"\n{total} {what}, {len(wrong)} mistakes")
    return wrong


def write_csv(path, results):
    """The table for other programs."""
    names = [field.name for field in dataclasses.fields(Result)]
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        writer.writerows([getattr(result, name) for name in names] for result in results)


def main():
    """Run, print, write, judge."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    parser.add_argument("--csv", type=pathlib.Path, default=ROOT / "outputs" / "stability.csv", help="where the table goes")
    parser.add_argument("--required", action="store_true", help="leave out the ways that are shown only")
    parser.add_argument("only", nargs="*", help="words: run the cases whose name or deck contains one; "
                        "random: random scenes; friction: those that rub; sensitivity: derivatives of such")
    options = parser.parse_args()
    program = options.build / "gudgeon"
    if not program.exists():
        sys.exit(f"{program} is not there: run `make stability`, which builds it")
    results = run_all(program.resolve(), chosen(options.only), options.required)
    write_csv(options.csv, results)
    failed = [result for result in results if result.has_failed]
    judged = sum(result.verdict == "ok" for result in results) + len(failed)
    print(f"\n{judged} ways have limits, {len(failed)} fall short; {len(results) - judged} are shown only; {options.csv}")
    for result in failed:
        print(f"short: {result.case}, {result.method}, {result.tolerance}: {result.verdict}")
    wrong = []
    if not options.only or "random" in options.only:
        wrong += wrong_scenes(program.resolve(), run_random, "runs of random scenes")
        wrong += random_statics.wrong_scenes(program.resolve()) + random_loops.wrong_scenes(program.resolve())
    if not options.only or "friction" in options.only:
        wrong += wrong_scenes(program.resolve(), run_friction, "random scenes with Coulomb's friction")
    if not options.only or "sensitivity" in options.only:
        wrong += sensitivity_survey.wrong_derivatives(program.resolve())
    for words in wrong:
        print(f"wrong: {words}")
    sys.exit(1 if failed or wrong else 0)


if __name__ == "__main__":
    main()
