#!/usr/bin/env python3
"""Certification of `gudgeon run --accuracy`: whether the intervals of random decks hold the true errors.

certify.py --build DIRECTORY [-n 200] [--first 0] [--seed 1] [--space] [--truth dop853] [--jobs 2] [--csv FILE]

Each deck runs with an accuracy of its own. Its truth is a run by another method at a tolerance of 1e-14 (or as near to it as the method
comes), confirmed by a run of a third kind: Verner's method with the constraints held in another way, all coordinates kept and another
solver. Compared is every channel that the run makes a claim of, at every output instant up to the last time that it claims, and its
extremes. The exit code is 1 if fewer than 95 % of the decks hold.
"""

import argparse
import concurrent.futures
import csv
import dataclasses
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import random_decks  # noqa: E402

sys.path.insert(0, str(HERE.parent / "e2e"))
import h5py  # noqa: E402
import numpy as np  # noqa: E402
from support import changed, is_history, plain  # noqa: E402

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
ROOT = HERE.parent.parent
WANTED = 0.95  # part of the decks that must hold
KNOWN = 0.2  # of the error claimed: truth must be known as well as this
TOLERANCES = ("1e-14", "1e-13", "1e-12", "1e-11")
LIMIT = 300  # seconds for one run
NOWHERE = ("contact_point", "contact_angle")  # of contacts that touch: elsewhere the direction may be that of round-off
SECOND = {"method": "verner", "solver": "lapack", "coordinates": "full"}


@dataclasses.dataclass
class Verdict:
    """What came of a deck."""

    deck: str
    asked: float
    claim: str = ""
    claimed_until: float = math.nan
    end: float = math.nan
    compared_until: float = math.nan
    error: float = math.nan  # claimed, over the scale
    true_error: float = math.nan  # over the scale
    worst: float = math.nan  # greatest true error of a channel over its interval
    truth_error: float = math.nan  # what truth and its confirmation differ by, over the interval
    channel: str = ""
    tolerance: float = math.nan
    verdict: str = ""


class History:
    """The channels of a run.h5 by their names."""

    def __init__(self, path):
        self.values, self.extremes, self.rounds = {}, {}, set()
        with h5py.File(path, "r") as file:
            self.is_instant = file["row_kind"][()] == 0
            self.time = file["time"][()][self.is_instant]
            for room in ("bodies", "joints", "drivers", "clearances", "forces"):
                if f"{room}/names" in file:
                    self.take(file, room, [str(name) for name in plain(file[f"{room}/names"][()])])
            if "clearances/contact_joint" in file:
                joints, labels = (plain(file[f"clearances/contact_{what}"][()]) for what in ("joint", "label"))
                several = [list(joints).count(joint) > 1 for joint in joints]
                self.take(file, "clearances/contacts", [f"{j}.{b}" if many else str(j) for j, b, many in zip(joints, labels, several)])
            if "extremes/channels/name" in file:
                names, least, greatest = (plain(file[f"extremes/channels/{what}"][()]) for what in ("name", "least", "greatest"))
                self.extremes = {str(name): (low, high) for name, low, high in zip(names, least, greatest)}
            if "energy" in file:
                for name, data in file["energy"].items():
                    self.values[f"energy.{name}"] = data[()][self.is_instant]

    def take(self, file, room, items):
        """The quantities of a room."""
        for name, data in file[room].items():
            if not isinstance(data, h5py.Dataset) or not is_history(data):
                continue
            values = data[()]
            for k, item in enumerate(items):
                parts = ("x", "y", "z")[:values.shape[2]] if values.ndim == 3 and values.shape[2] < 4 else ("e0", "e1", "e2", "e3")
                for c in range(values.shape[2] if values.ndim == 3 else 1):
                    label = f"{item}.{name}" + (f".{parts[c]}" if values.ndim == 3 else "")
                    column = values[:, k, c] if values.ndim == 3 else values[:, k]
                    self.values[label] = column[self.is_instant]
                    if (room, name) in (("joints", "angle"), ("clearances/contacts", "contact_angle")):
                        self.rounds.add(label)  # it jumps by a turn: its extremes are those of the output instants


def run(program, text, directory, *options):
    """Run a deck; its exit code."""
    directory.mkdir()
    deck = directory / "deck.deck"
    deck.write_text(text)
    command = [str(program), "run", str(deck), "--out", str(directory / "out"), "--quiet", "--write", "channels", *options]
    try:
        return subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=LIMIT).returncode
    except subprocess.TimeoutExpired:
        return None


def tight(program, text, directory, settings):
    """The tightest run with some settings that comes to its end; None if there is none."""
    for tolerance in TOLERANCES:
        if run(program, changed(text, "analysis.dynamic", tolerance=tolerance, **settings), directory) == 0:
            return History(directory / "out" / "run.h5")
        shutil.rmtree(directory, ignore_errors=True)
    return None


def forget_free_places(truth, others):
    """Where contacts that are free in the truth would act counts as the same in the others."""
    for label, column in truth.values.items():
        contact, _, what = re.sub(r"\.[xyz]$", "", label).rpartition(".")
        if what in NOWHERE:
            is_free = truth.values[f"{contact}.state"] == 0
            for one in others:
                n = min(len(column), len(one.values[label]))
                one.values[label][:n] = np.where(is_free[:n], column[:n], one.values[label][:n])


def distance(a, b, n):
    """Greatest difference of two columns up to an instant, and of their extremes."""
    with np.errstate(invalid="ignore"):
        d = np.abs(a[:n] - b[:n])
    d = float(np.nanmax(d)) if np.any(np.isfinite(d)) else 0.0
    return d


def judge(deck, program, scratch, method):
    """Run a deck and its truth by a method, and compare."""
    verdict = Verdict(deck.label, deck.accuracy)
    code = run(program, deck.text, scratch / "run", "--accuracy", repr(deck.accuracy))
    if code not in (0, 6):
        verdict.verdict = f"exit code {code}"
        return verdict
    with h5py.File(scratch / "run" / "out" / "run.h5", "r") as file:
        group = file["accuracy"]
        claims = {key: plain(group[key][()]) for key in ("names", "scale", "error", "min", "max")}
        verdict.claim, verdict.claimed_until = plain(group.attrs["claim"]), float(group.attrs["claimed_until"])
        verdict.error, verdict.tolerance = float(group.attrs["error"]), float(file["summary"].attrs["tolerance"])
    history = History(scratch / "run" / "out" / "run.h5")
    verdict.end = float(history.time[-1])
    if verdict.claim == "none":
        verdict.verdict = "nothing claimed"
        return verdict
    truth, second = (tight(program, deck.text, scratch / name, settings) for name, settings in (("truth", {"method": method}), ("second", SECOND)))
    if truth is None or second is None:
        verdict.verdict = "no truth"
        return verdict
    return compare(verdict, claims, history, truth, second)


def compare(verdict, claims, history, truth, second):
    """The true errors over the intervals that are claimed, as long as the truth is known much better than what is claimed."""
    n = int(np.sum(history.time <= verdict.claimed_until*(1.0 + 1e-12)))
    forget_free_places(truth, (history, second))
    names = [str(name) for name in claims["names"]]
    claimed = verdict.asked if verdict.claim != "reached" else verdict.error
    far = np.max([np.abs(truth.values[name][:n] - second.values[name][:n])/scale for name, scale in zip(names, claims["scale"])], axis=0)
    unknown = np.flatnonzero(~(far <= KNOWN*claimed))
    is_known = unknown.size == 0
    n = n if is_known else int(unknown[0])
    if n < 2:
        verdict.verdict = "no truth"
        return verdict
    verdict.compared_until = float(history.time[n - 1])
    verdict.worst = verdict.true_error = verdict.truth_error = 0.0
    for k, name in enumerate(names):
        error, scale = float(claims["error"][k]), float(claims["scale"][k])
        d = distance(history.values[name], truth.values[name], n)
        if is_known and not any(what in name for what in NOWHERE):  # the extremes are of all that is claimed
            low, high = float(np.nanmin(truth.values[name][:n])), float(np.nanmax(truth.values[name][:n]))
            d = max(d, claims["min"][k] - low, high - claims["max"][k])
            if n == len(history.time) and name not in truth.rounds:  # located between output instants too
                low, high = truth.extremes.get(name, (low, high))
                d = max(d, abs(low - claims["min"][k]), abs(high - claims["max"][k]))
        verdict.true_error = max(verdict.true_error, d/scale)
        if d/error > verdict.worst:
            verdict.worst, verdict.channel = d/error, name
            verdict.truth_error = distance(truth.values[name], second.values[name], n)/error
    holds = verdict.worst <= 1.0 and verdict.true_error <= claimed
    doubtful = not holds and verdict.worst - verdict.truth_error <= 1.0
    verdict.verdict = ("holds" if is_known else "holds as far as the truth is known") if holds else "doubtful truth" if doubtful else "FAILS"
    return verdict


def certify(program, numbers, seed, jobs, tell=lambda verdict: None, families=random_decks.FAMILIES, truth="dop853"):
    """The verdicts of some decks."""
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="gudgeon_certify_"))

    def one(number):
        place = scratch / str(number)
        place.mkdir()
        verdict = judge(random_decks.make(number, seed, families), program, place, truth)
        shutil.rmtree(place, ignore_errors=True)
        tell(verdict)
        return verdict

    try:
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            return list(pool.map(one, numbers))
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def has_failed(verdicts):
    """Whether too few of the decks that make a claim hold it."""
    judged = [verdict for verdict in verdicts if verdict.verdict not in ("no truth", "nothing claimed")]
    held = sum(verdict.verdict.startswith("holds") for verdict in judged)
    return held < WANTED*len(judged)


def main():
    """Run, print, write, judge."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    parser.add_argument("-n", type=int, default=200, help="decks")
    parser.add_argument("--first", type=int, default=0, help="number of the first")
    parser.add_argument("--seed", type=int, default=1, help="of the decks")
    parser.add_argument("--space", action="store_true", help="decks in space instead of those of the plane")
    parser.add_argument("--truth", default="dop853", help="method whose motion is the truth")
    parser.add_argument("--jobs", type=int, default=2, help="decks at once")
    parser.add_argument("--csv", type=pathlib.Path, default=ROOT / "outputs" / "certify.csv", help="where the table goes")
    options = parser.parse_args()
    program = (options.build / "gudgeon").resolve()

    def tell(verdict):
        if verdict.verdict != "holds":
            print(f"{verdict.deck}, asked {verdict.asked:.2g}, {verdict.claim}: {verdict.verdict}; {verdict.channel} {verdict.worst:.2g} of its "
                  f"interval, truth {verdict.truth_error:.1g}; claimed to {verdict.claimed_until:.4g} of {verdict.end:.4g} s, compared to "
                  f"{verdict.compared_until:.4g} s", flush=True)

    families = random_decks.IN_SPACE if options.space else random_decks.FAMILIES
    verdicts = certify(program, range(options.first, options.first + options.n), options.seed, options.jobs, tell, families, options.truth)
    options.csv.parent.mkdir(parents=True, exist_ok=True)
    with open(options.csv, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([field.name for field in dataclasses.fields(Verdict)])
        writer.writerows([dataclasses.astuple(verdict) for verdict in verdicts])
    for what in ("verdict", "claim"):
        words = [getattr(verdict, what) or "-" for verdict in verdicts]
        print(f"{what}: " + ", ".join(f"{words.count(word)} {word}" for word in sorted(set(words))))
    ratios = sorted(verdict.worst for verdict in verdicts if math.isfinite(verdict.worst))
    if ratios:
        print(f"true error over interval, worst channel of a deck: median {ratios[len(ratios)//2]:.2g}, greatest {ratios[-1]:.2g}; {options.csv}")
    sys.exit(1 if has_failed(verdicts) else 0)


if __name__ == "__main__":
    main()
