"""`method = auto` against every named method: processor time for the same error, deck by deck, as a table.

    python3 tests/bench/methods.py [--program build/gudgeon] [--limit SECONDS] [--rounds N] [DECK[,NAME=VALUE]...]

Without decks: all of inputs/ and inputs/hard that have a dynamic analysis. The error of a run is the greatest difference of any coordinate of any
body to the reference, over the greatest range of one, at the output instants up to that at which two tight runs of different methods still
agree. The time is that of the solution, the least of the rounds. What a named method takes for the error of `auto` is found
between its runs at tolerances a hundred times looser to ten times tighter than the deck's, by a power law. A run may take three times as long as the best of
its deck so far, and --limit at most; what takes longer is not counted.
"""

import argparse
import json
import pathlib
import resource
import subprocess
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMED = ("radau", "bdf", "dop853", "verner", "rock4", "adams", "ida")
FACTORS = (1.0, 100.0, 10.0, 0.1)
TIGHT = (("radau", 1e-11), ("dop853", 1e-12), ("bdf", 1e-11))
LEAST = 1e-14   # tolerance


class Bench:
    """Runs of one deck."""

    def __init__(self, program, deck, limit, rounds):
        self.program, self.limit, self.rounds = program, limit, rounds
        self.deck, *settings = deck.split(",")
        self.options = [word for setting in settings for word in ("--set", setting)]
        self.best = limit / 3

    def run(self, method, tolerance, limit, rounds=1):
        """Processor time, times and positions of a run; none if it fails or takes too long."""
        seconds = []
        with tempfile.TemporaryDirectory() as directory:
            for _ in range(rounds):
                command = [self.program, "run", self.deck, *self.options, "--method", method, "--out", f"{directory}/out", "--quiet", "--write", "numbers"]
                command += ["--tolerance", repr(tolerance)] if tolerance else []
                allowed = max(2, round(limit + 0.5))
                done = subprocess.run(command, capture_output=True, check=False, cwd=ROOT,
                                      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (allowed, allowed)))
                if done.returncode:
                    return None
                summary = json.loads(pathlib.Path(f"{directory}/out/summary.json").read_text())
                seconds.append(summary["cpu_seconds"])
            with h5py.File(f"{directory}/out/run.h5") as file:
                if "bodies/position" not in file or "tolerance" not in summary:
                    return None
                kept = file["row_kind"][()] == 0
                return min(seconds), file["time"][()][kept], file["bodies/position"][()][kept], summary

    def measured(self, method, tolerance):
        """A timed run."""
        found = self.run(method, tolerance, min(self.limit, 3 * self.best + 1), self.rounds)
        if found:
            self.best = min(self.best, found[0])
        return found

    def reference(self):
        """Times and positions of the tightest run, and up to where another one agrees with it."""
        runs = [run for run in (self.run(method, tolerance, self.limit) for method, tolerance in TIGHT) if run]
        if len(runs) < 2:
            return None
        n = min(len(run[1]) for run in runs)
        apart = difference(runs[0][2][:n], runs[1][2][:n])
        last = int(np.argmax(apart > 1e-7)) if (apart > 1e-7).any() else n
        return (runs[0][1][:last], runs[0][2][:last], float(apart[:last].max())) if last > 1 else None

    def row(self):
        """The row of the table."""
        auto = self.measured("auto", None)
        if not auto:
            return [self.deck, "no dynamic analysis, or it fails"]
        reference = self.reference()
        if reference is None:
            return [self.deck, "no reference"]
        error = max(self.error(auto, reference), reference[2], 1e-15)
        tolerance = auto[3]["tolerance"]
        if not tolerance:
            return [self.deck, "fixed steps"]
        costs = {}
        for method in NAMED:
            points = []
            for factor in FACTORS:
                found = self.measured(method, min(1e-2, max(LEAST, factor * tolerance)))
                if not found:
                    if factor == FACTORS[0]:
                        break
                    continue
                points.append((max(self.error(found, reference), reference[2], 1e-15), found[0]))
            costs[method] = cost_at(points, error)
        best = min(costs, key=costs.get)
        return [self.deck, f"{error:.1e}", auto[3]["method"], f"{1e3 * auto[0]:.3g}", best, f"{1e3 * costs[best]:.3g}", f"{auto[0] / costs[best]:.2f}"]

    @staticmethod
    def error(run, reference):
        """Greatest error of a run."""
        n = min(len(run[1]), len(reference[1]))
        return float(difference(run[2][:n], reference[1][:n]).max())


def difference(ours, theirs):
    """Greatest difference at each instant, over the greatest range."""
    n = len(theirs)
    scale = max(np.ptp(theirs.reshape(n, -1), axis=0).max(), 1e-300)
    return np.abs(ours - theirs).reshape(n, -1).max(axis=1) / scale


def cost_at(points, error):
    """Time for an error, by a power law between the cheapest runs on both sides of it."""
    good = [point for point in points if point[0] <= error]
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
    """Print the table as it grows, and what part of it is within 1.5."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build" / "gudgeon"))
    parser.add_argument("--limit", type=float, default=20.0)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("decks", nargs="*")
    given = parser.parse_args()
    decks = given.decks or [str(path.relative_to(ROOT)) for folder in ("inputs", "inputs/hard") for path in sorted((ROOT / folder).glob("*.deck"))]
    ratios = []
    print("| deck | error | auto | CPU ms | best named | CPU ms | ratio |\n|---|---|---|---|---|---|---|")
    for deck in decks:
        row = Bench(given.program, deck, given.limit, given.rounds).row()
        print("| " + " | ".join(row + [""] * (7 - len(row))) + " |", flush=True)
        if len(row) == 7:
            ratios.append(float(row[6]))
    if ratios:
        print(f"\n{sum(ratio <= 1.5 for ratio in ratios)} of {len(ratios)} decks within 1.5, the greatest ratio is {max(ratios):.2f}")


if __name__ == "__main__":
    main()
