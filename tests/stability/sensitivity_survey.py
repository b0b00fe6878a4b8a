"""Derivatives of random scenes by `gudgeon sensitivity` against extrapolated differences of runs; part of `make stability`.

    python3 -B tests/stability/sensitivity_survey.py --build build --scenes 200 --csv sensitivity.csv

For each parameter q runs at 1e-13 with q (1 +- s), s = WIDEST/4^k, give a table of extrapolated differences (Ridders). Of it the
entry counts that differs least from those it is made of; that difference, of the entry CHANCE places behind it in this order,
times SURE, is what the reference does not know.
Runs whose contacts are others, or whose results jump, have no such entry: nothing is compared there.

A derivative is wrong if it differs from the reference by more than both errors. Errors are too large if they are many times the
difference from a study at a tighter tolerance. A refused derivative has a reason.
"""

import argparse
import collections
import csv
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "e2e"))

from sensitivity_scenes import KINDS, draw  # noqa: E402
from support import Run, changed, written  # noqa: E402

LIMIT = 60  # seconds for one command
SCENES = 200
TOLERANCE, TIGHT, OF_RUNS = "1e-11", "1e-13", "1e-13"
WIDEST = 1e-3  # first change of a parameter, of it [1]
LEVELS = 5  # changes
CHANCE = 2  # entries that may agree with their neighbours by chance
SURE = 3.0  # times what the reference does not know
ROUND_OFF = 1e-13  # of a result of a run [1]
OF_PEAK = 1e-8  # what a run may miss of a peak or an extreme, of it [1]
WITHIN, OF_MEDIAN = 0.99, 10.0  # derivatives within their errors; errors over differences, in the median
BAD = ("wrong", "failed", "no reason")
COLUMNS = ("scene", "result", "parameter", "value", "error", "reference", "unsure", "tight", "reason", "verdict")


def command(program, verb, deck, out, *options):
    """Run the program: None, or words about a failure."""
    words = [str(program), verb, str(deck), "--out", str(out), "--quiet", *options]
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=LIMIT, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return f"no end after {LIMIT} s"
    if done.returncode:
        return f"{verb}: exit code {done.returncode}: {next((x for x in done.stderr.splitlines() if x.startswith('error')), '')}"
    return None


def study_of(program, scene, directory, tolerance):
    """Results and derivatives of a study, or words."""
    deck = written(directory, scene.text, "study.deck")
    wrong = command(program, "sensitivity", deck, directory / tolerance, "--tolerance", tolerance)
    return wrong or json.loads((directory / tolerance / "summary.json").read_text())["sensitivity"]


def results_of_run(run, words):
    """The results that a study was asked for, from a run; nan where it has none."""
    events, values = run.contacts, []
    extremes = run.group("extremes/channels")
    names = [str(name).strip() for name in extremes["name"]]
    for word in words:
        contact, channel = re.fullmatch(r"(\w+)\.(\w+)\((\d+)\)", word), re.fullmatch(r"(max|min|at)\(([\w.]+),?(.*)\)", word)
        if contact:
            rows = events[[str(item, "ascii").strip() == contact[1] for item in events["item"]]]
            n = int(contact[3]) - 1
            values.append(rows["time" if contact[2] == "onset" else contact[2]][n] if n < len(rows) else math.nan)
        elif channel[1] == "at":
            body, quantity, axis = channel[2].split(".")
            row = np.argmin(np.abs(run.time - float(channel[3].removesuffix("s"))))
            values.append(run.item(f"bodies/{quantity}", body)[row]["xyz".index(axis)])
        else:
            values.append(extremes["greatest" if channel[1] == "max" else "least"][names.index(channel[2])])
    return np.array(values, float)


def reference_of(program, scene, name, words, directory):
    """Derivatives by one parameter by extrapolated differences of runs, and what is not known of them; nan: nothing is."""
    value, unit = scene.parameters[name]
    deck = written(directory, changed(scene.text, "analysis.dynamic", tolerance=OF_RUNS), "run.deck")
    rows, size = [], None
    for k in range(LEVELS):
        ends = []
        for sign in (1, -1):
            out = directory / f"{name}_{k}_{sign}"
            change = f"{name}={value*(1 + sign*WIDEST/4**k)!r} {unit}".strip()
            wrong = command(program, "run", deck, out, "--write", "channels", "--set", change)
            if wrong:
                return np.full(len(words), math.nan), np.full(len(words), math.nan)
            ends.append(results_of_run(Run(out), words))
            shutil.rmtree(out)
        step = value*WIDEST/4**k
        size = np.abs(ends[0])
        row = [(ends[0] - ends[1])/(2*step)]
        for j in range(k):
            row.append(row[j] + (row[j] - rows[-1][j])/(16**(j + 1) - 1))
        rows.append(row)
    missing = np.where([re.match(r"(max|min)\(|.*\.peak_", word) is not None for word in words], OF_PEAK, ROUND_OFF)
    best, away = np.full(len(words), math.nan), []
    for k in range(1, LEVELS):
        noise = missing*size/(value*WIDEST/4**k)
        for j in range(1, k + 1):
            away.append(np.maximum(np.abs(rows[k][j] - rows[k][j - 1]), np.abs(rows[k][j] - rows[k - 1][j - 1])) + noise)
            better = away[-1] <= np.min(away, axis=0)
            best[better] = rows[k][j][better]
    fine = np.abs(rows[-1][0] - rows[-2][0]) + noise  # what the finest differences do not know
    return best, np.maximum(np.sort(away, axis=0)[CHANCE], np.abs(best - rows[-1][0]) - fine)


def judge(pair, reference, unsure):
    """The verdict on a derivative of a study."""
    if pair["value"] is None:
        return "refused" if pair.get("reason") else "no reason"
    if not math.isfinite(reference):
        return "unknown"
    if not abs(pair["value"] - reference) <= pair["error"] + SURE*unsure:
        return "wrong"
    return "right" if SURE*unsure <= 1e-3*abs(reference) or SURE*unsure <= pair["error"] else "unsure"


def survey_scene(program, scene, directory):
    """Rows of the table for a scene."""
    study, tight = (study_of(program, scene, directory, tolerance) for tolerance in (TOLERANCE, TIGHT))
    blank = dict.fromkeys(COLUMNS, "") | {"scene": scene.label}
    if isinstance(study, str):
        return [blank | {"reason": study, "verdict": "failed"}]
    rows, words = [], list(study)
    for name in scene.parameters:
        references, unsure = reference_of(program, scene, name, words, directory)
        for k, word in enumerate(words):
            pair = study[word][name]
            other = math.nan if isinstance(tight, str) else tight[word][name]["value"]
            rows.append(blank | {"result": word, "parameter": name, "value": pair["value"], "error": pair["error"],
                                 "reference": references[k], "unsure": unsure[k], "tight": other, "reason": pair.get("reason", ""),
                                 "verdict": judge(pair, references[k], unsure[k])})
    return rows


def verdict_of(rows):
    """Lines of words, and whether all is well."""
    count = collections.Counter(row["verdict"] for row in rows)
    compared = count["right"] + count["wrong"]
    share = count["right"]/max(compared, 1)
    ratios = [row["error"]/abs(row["value"] - row["tight"]) for row in rows
              if row["verdict"] == "right" and row["tight"] not in (None, row["value"]) and row["tight"] == row["tight"] and row["value"]]
    ratio = float(np.median(ratios)) if ratios else math.nan
    lines = [", ".join(f"{n} {verdict}" for verdict, n in sorted(count.items())),
             f"{compared} derivatives compared, {100*share:.2f} % within their errors; "
             f"errors are {ratio:.1f} times the difference from a tighter study in the median of {len(ratios)}"]
    is_well = share >= WITHIN and (ratio <= OF_MEDIAN or not ratios) and not count["no reason"] and not count["failed"]
    return lines, is_well


def run_survey(program, scratch, scenes=SCENES, kinds=KINDS):
    """All scenes, kinds in turn: rows of the table."""
    rows = []
    for n in range(scenes):
        scene = draw(kinds[n % len(kinds)], n//len(kinds))
        directory = pathlib.Path(scratch) / f"scene_{n}"
        directory.mkdir()
        rows += survey_scene(program, scene, directory)
        shutil.rmtree(directory)
    return rows


def told(row):
    """A row in words."""
    return " ".join(f"{name}={row[name]}" for name in COLUMNS if row[name] != "")


def wrong_derivatives(program, scenes=SCENES):
    """Lines about derivatives if too many are wrong; says how many there were."""
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="gudgeon_sensitivity_"))
    try:
        rows = run_survey(program, scratch, scenes)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    lines, is_well = verdict_of(rows)
    print("\n" + "\n".join(lines))
    return [] if is_well else [told(row) for row in rows if row["verdict"] in BAD] or lines[-1:]


def main():
    """Run, print, write, judge."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    parser.add_argument("--scenes", type=int, default=SCENES, help="how many")
    parser.add_argument("--kinds", nargs="+", default=KINDS, choices=KINDS, help="which")
    parser.add_argument("--csv", type=pathlib.Path, default=ROOT / "outputs" / "sensitivity.csv", help="where the table goes")
    options = parser.parse_args()
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="gudgeon_sensitivity_"))
    try:
        rows = run_survey((options.build / "gudgeon").resolve(), scratch, options.scenes, options.kinds)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    options.csv.parent.mkdir(parents=True, exist_ok=True)
    with open(options.csv, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    for row in rows:
        if row["verdict"] in BAD:
            print(told(row))
    lines, is_well = verdict_of(rows)
    print("\n".join(lines))
    sys.exit(0 if is_well else 1)


if __name__ == "__main__":
    main()
