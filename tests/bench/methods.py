"""`method = auto` against every named method: processor time for the same error, deck by deck.

    python3 tests/bench/methods.py [--build build] [--limit SECONDS] [--rounds N] [--keep] [DECK[,NAME=VALUE]...]

Without decks: all of inputs/, inputs/hard and grip.deck beside this file with a dynamic analysis at a tolerance. Writes methods.csv below bench/ of the build, of which
report.py makes a table of docs/theory/evidence/performance.md.

The error of a run is the maximum difference of positions of bodies to the reference, over their maximum range, or of angles (in space: Euler
parameters), at the output times up to that at which two tight runs of different methods still agree. The time is processor time of the solution,
the minimum of the rounds. The time of a named method for the error of `auto` is interpolated between its runs at tolerances 1000 times looser to
100 times tighter than the deck's, by a power law. Where the error of `auto` is below the difference of the two references, runs at looser tolerances
than the deck's are left out, because their errors there are unknown. `auto` and the best of them are then timed again, in turns. A run that takes
--limit (a reference: four times that), or four times the best of its deck so far, is ended and not counted.
--keep takes reference and named runs from the last call (methods.json beside the table) where they are there.
"""

import argparse
import csv
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from support import changed, text_of  # noqa: E402

NAMED = ("radau", "bdf", "dop853", "verner", "rock4", "adams", "ida")
FACTORS = (1.0, 100.0, 10.0, 1000.0, 0.1, 0.01)
TIGHT = ("dop853", "radau", "verner", "bdf")
TIGHTER = 1e-3            # tolerance of a reference over the deck's
LIMITS = 1e-14, 1e-2      # tolerances
AGREED = 1e-7             # difference up to which two tight runs agree
ENOUGH = 0.1              # processor time after which there is no further round [s]
MOVES = 1e-12             # range of what moves [m or rad]
COLUMNS = ("deck", "tolerance", "error", "auto", "ms", "best_named", "best_ms", "ratio")


class Bench:
    """Runs of one deck."""

    def __init__(self, program, deck, limit, rounds, kept):
        self.program, self.limit, self.rounds, self.kept = program, limit, rounds, kept
        self.deck, *settings = deck.split(",")
        self.options = [word for setting in settings for word in ("--set", setting)]
        self.best = limit / 4
        text = text_of(ROOT / self.deck)
        turning = "*.orientation" if re.search(r"^ *space *= *spatial", text, re.M) else "*.angle"
        self.text = changed(text, "output", channels=f"*.position {turning}", figures=None, contact_rows="off", report=None, motion=None, fields=None)

    def run(self, method, tolerance, limit, rounds=1):
        """Processor time, times and positions of a run, and its summary; None if it fails or takes too long."""
        seconds = []
        with tempfile.TemporaryDirectory() as directory:
            (pathlib.Path(directory) / "scene.deck").write_text(self.text)
            for path in (ROOT / self.deck).parent.iterdir():   # curves that the deck reads
                (pathlib.Path(directory) / path.name).symlink_to(path)
            for _ in range(rounds):
                command = [self.program, "run", "scene.deck", *self.options, "--method", method, "--out", "out", "--quiet", "--write", "channels"]
                command += ["--tolerance", repr(tolerance)] if tolerance else []
                done = subprocess.run(command, capture_output=True, check=False, cwd=directory, preexec_fn=lambda: signal.setitimer(signal.ITIMER_PROF, limit))
                if done.returncode:
                    return None
                summary = json.loads(pathlib.Path(f"{directory}/out/summary.json").read_text())
                seconds.append(summary["cpu_seconds"])
                if sum(seconds) > ENOUGH:
                    break
            with h5py.File(f"{directory}/out/run.h5") as file:
                if "tolerance" not in summary:
                    return None
                is_output = file["row_kind"][()] == 0
                places = [file[f"bodies/{name}"][()][is_output] for name in ("position", "angle", "orientation") if f"bodies/{name}" in file]
                return min(seconds), [values.reshape(len(values), -1) for values in places], summary

    def measured(self, method, tolerance):
        """A timed run."""
        found = self.run(method, tolerance, min(self.limit, 4 * self.best + 0.2), self.rounds)
        if found:
            self.best = min(self.best, found[0])
        return found

    def reference(self, tolerance):
        """Positions of the tightest run, up to where another one agrees with it, and the difference there."""
        runs = []
        for method in TIGHT:
            found = self.run(method, min(1e-12, max(2.0 * LIMITS[0], TIGHTER * tolerance)), 4 * self.limit)
            runs += [found] if found else []
            if len(runs) == 2:
                break
        else:
            return None
        apart = difference(runs[0][1], runs[1][1])
        last = int(np.argmax(apart > AGREED)) if (apart > AGREED).any() else len(apart)
        return ([values[:last] for values in runs[0][1]], float(apart[:last].max())) if last > 1 else None

    def points(self, tolerance):
        """Error and time of the named methods over their tolerances."""
        reference = self.reference(tolerance)
        if reference is None:
            return None
        found = {}
        for method in NAMED:
            points = []
            for factor in FACTORS:
                run = self.measured(method, min(LIMITS[1], max(LIMITS[0], factor * tolerance)))
                if run:
                    points.append((max(error_of(run, reference[0]), reference[1], 1e-15), run[0], run[2]["tolerance"]))
                elif factor == FACTORS[0]:
                    break
            found[method] = points
        return {"points": found, "reference": [values.tolist() for values in reference[0]], "agreed": reference[1]}

    def row(self):
        """The row of the table, or why there is none."""
        auto = self.measured("auto", None)
        if not auto:
            return "no dynamic analysis, or it fails"
        tolerance = auto[2]["tolerance"]
        if not tolerance:
            return "fixed steps"
        key = " ".join([self.deck, *self.options])
        if key not in self.kept:
            self.kept[key] = self.points(tolerance)
        if self.kept[key] is None:
            return "no two tight runs agree"
        kept = self.kept[key]
        error = max(error_of(auto, [np.array(values) for values in kept["reference"]]), kept["agreed"], 1e-15)
        if error <= kept["agreed"]:
            kept = {**kept, "points": {method: [point for point in points if point[2] <= tolerance * (1.0 + 1e-6)] for method, points in kept["points"].items()}}
        costs = {method: cost_at(points, error) for method, points in kept["points"].items()}
        best = min(costs, key=costs.get)
        ms = auto[0]
        for _ in range(self.rounds):   # in turns, since others use the machine too
            ms = min([ms, *(found[0] for found in [self.run("auto", None, self.limit)] if found)])
            for k, (error_there, seconds, tolerance_there) in enumerate(kept["points"][best]):
                if costs[best] < 2.0 * seconds < 4.0 * costs[best]:
                    again = self.run(best, tolerance_there, self.limit)
                    kept["points"][best][k] = (error_there, min([seconds, *([again[0]] if again else [])]), tolerance_there)
        costs[best] = cost_at(kept["points"][best], error)
        return {"deck": " ".join([self.deck.removesuffix(".deck"), *self.options[1::2]]), "tolerance": tolerance, "error": error,
                "auto": re.sub(r"^auto \((.*)\)$", r"\1", auto[2]["method"]), "ms": 1e3 * ms, "best_named": best, "best_ms": 1e3 * costs[best], "ratio": ms / costs[best]}


def error_of(run, reference):
    """Maximum error of a run."""
    return float(difference(run[1], reference).max())


def difference(ours, theirs):
    """Maximum difference at each output time, of positions or of angles, over the maximum range of each."""
    n = min(len(ours[0]), len(theirs[0]))
    found = np.zeros(n)
    for one, other in zip(ours, theirs):
        scale = np.ptp(other, axis=0).max()
        if scale > MOVES:
            found = np.maximum(found, np.abs(one[:n] - other[:n]).max(axis=1) / scale)
    return found


def cost_at(points, error):
    """Time for an error, by a power law between the cheapest runs on both sides of it."""
    good = [point for point in points if point[0] <= error * (1.0 + 1e-6)]
    if not good:
        return float("inf")
    right = min(good, key=lambda point: point[1])
    coarse = [point for point in points if point[0] > error and point[1] < right[1]]
    if not coarse or right[0] >= error:
        return right[1]
    left = max(coarse, key=lambda point: point[1])
    part = np.log(error / right[0]) / np.log(left[0] / right[0])
    return float(right[1] * (left[1] / right[1]) ** part)


def main():
    """Print the rows as they are found, write the table, and say what part of it is within 1.5."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    parser.add_argument("--limit", type=float, default=20.0, help="processor time of a run [s]")
    parser.add_argument("--rounds", type=int, default=3, help="runs of which the fastest counts")
    parser.add_argument("--keep", action="store_true", help="take named runs of the last call where they are there")
    parser.add_argument("decks", nargs="*")
    given, _ = parser.parse_known_args()
    decks = given.decks or [str(path.relative_to(ROOT)) for folder in ("inputs", "inputs/hard") for path in sorted((ROOT / folder).glob("*.deck"))]
    decks += [] if given.decks else ["tests/bench/grip.deck"]
    results = given.build.resolve() / "bench"
    results.mkdir(parents=True, exist_ok=True)
    kept = json.loads((results / "methods.json").read_text()) if given.keep and (results / "methods.json").exists() else {}
    rows = []
    for deck in decks:
        row = Bench(str(given.build.resolve() / "gudgeon"), deck, given.limit, given.rounds, kept).row()
        if isinstance(row, str):
            print(f"{deck}: {row}", flush=True)
            continue
        rows.append(row)
        print("{deck}: {ratio:.2f} ({ms:.3g} ms, {best_named} {best_ms:.3g} ms), error {error:.1e}, {auto}".format(**row), flush=True)
        (results / "methods.json").write_text(json.dumps(kept))
    with open(results / "methods.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    if rows:
        ratios = [row["ratio"] for row in rows]
        print(f"{sum(ratio <= 1.5 for ratio in ratios)} of {len(ratios)} decks within 1.5, the maximum ratio is {max(ratios):.2f}")


if __name__ == "__main__":
    main()
