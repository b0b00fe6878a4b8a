"""Random scenes with friction by many methods and laws: exit codes, steps over those with the smooth law, agreement of two methods.

    python3 -B tests/stability/friction_survey.py --build build --methods verner bdf --each 100 --csv friction.csv

One process at a time. A line for each run that went wrong, a table at the end or when it is interrupted. `each` scenes of a
kind; of the law `any` scene n has law n of `OTHER_LAWS`, in turn. The smooth law is that of Brown and McPhee, its transition
speed is `random_friction.TRANSITION`.

Two methods agree as far as the motion is regular: onsets and impact speeds of the first contacts, and the last place where all
is at rest. Units: the tolerance asked, of a place, of a body of 0.1 m (an onset counts by the way until then), and the
tolerance times the largest impact speed. Impacts, and sticking that ends, multiply an error; methods that agree differ by as
many tolerances at any tolerance.
"""

import argparse
import csv
import dataclasses
import pathlib
import shutil
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "e2e"))

from friction_runs import RATIO, faults_of, run  # noqa: E402
from random_friction import END, KINDS, OTHER_LAWS, TRANSITION, draw  # noqa: E402

SIZE = 0.1  # of a body [m]
FIRST = 3  # contacts compared
BRISTLES = ("lugre", "dahl")  # give back what bends them
AT_REST = 1e-10  # kinetic energy of a scene at rest, of the largest energy
COLUMNS = ("scene", "method", "law", "code", "steps", "smooth_steps", "seconds", "residual", "contacts", "events", "not_unique",
           "faults")


def code_of(result):
    """Exit code of a run, or words."""
    return 0 if not isinstance(result, str) else result.split(":")[0].removeprefix("exit code ")


def measure(program, scene, method, law, directory):
    """A run with a law, and with the smooth one: the run, and its row of the table."""
    result = run(program, scene, method, law, directory)
    smooth = run(program, scene, method, "smooth", directory)
    row = dict.fromkeys(COLUMNS, "") | {"scene": scene.label, "method": method, "law": law, "code": code_of(result)}
    if not isinstance(smooth, str):
        row["smooth_steps"] = smooth.summary["steps"]
    if isinstance(result, str):
        return result, row | {"faults": result}
    summary = result.summary
    faults = faults_of(result, scene, method, lambda: smooth)
    if law in BRISTLES:
        faults = [words for words in faults if not words.startswith("friction gives")]
    if not faults and not isinstance(smooth, str) and summary["steps"] > RATIO*smooth.summary["steps"]:
        faults = [f"{summary['steps']} steps, {smooth.summary['steps']} with the smooth law"]
    return result, row | {
        "steps": summary["steps"], "seconds": summary["cpu_seconds"],
        "residual": summary["energy_residual_max"]/summary["energy_max"],
        "contacts": len(result.contacts), "events": summary["events"],
        "not_unique": int(any("sticking contacts are not unique" in words for words in summary["warnings"])), "faults": "; ".join(faults)}


def is_at_rest(result):
    """Whether nothing moves at the end."""
    return result.read("energy/kinetic").ravel()[-1] < AT_REST*result.summary["energy_max"]


def agreement(one, other, tolerance):
    """Differences in tolerances: of the first onsets, of their impact speeds, of the last place (nan: not at rest by both)."""
    a, b = one.contacts, other.contacts
    n = min(FIRST, len(a), len(b))
    speed = max(np.max(a["impact_speed"], initial=1e-300), 1e-300)
    onsets = np.abs(a["time"][:n] - b["time"][:n])*a["impact_speed"][:n]/(tolerance*SIZE)
    speeds = np.abs(a["impact_speed"][:n] - b["impact_speed"][:n])/(tolerance*speed)
    rest = np.nan
    if is_at_rest(one) and is_at_rest(other):
        rest = np.max(np.abs(one.read("bodies/position")[-1] - other.read("bodies/position")[-1]))/(tolerance*SIZE)
    return list(onsets) + [np.nan]*(FIRST - n), list(speeds) + [np.nan]*(FIRST - n), rest


def laws_of(law, seed):
    """The law of a scene."""
    return OTHER_LAWS[seed % len(OTHER_LAWS)] if law == "any" else law


def drawn(kind, seed, options):
    """A scene with the end and the tolerance asked for."""
    scene = draw(kind, seed)
    text = scene.text
    for line, other in ((f"end = {END!r} s", f"end = {options.end!r} s"), (f"every = {END/50!r} s", f"every = {options.end/50!r} s"),
                        ("tolerance = 1e-8", f"tolerance = {options.tolerance}")):
        text = text.replace(line, other)
    return dataclasses.replace(scene, text=text)


def survey(program, options):
    """All runs: rows of the table, and what two methods say of each scene."""
    rows, agreements = [], []
    scratch = pathlib.Path(tempfile.mkdtemp(prefix="gudgeon_friction_"))
    try:
        for seed in range(options.first, options.first + options.each):
            print(f"seed {seed}", file=sys.stderr, flush=True)
            for kind in options.kinds:
                scene, results, law = drawn(kind, seed, options), {}, laws_of(options.law, seed)
                for method in options.methods:
                    directory = scratch / "run"
                    directory.mkdir()
                    results[method], row = measure(program, scene, method, law, directory)
                    rows.append(row)
                    if row["faults"]:
                        print(f"{scene.label}, {method}, {law}: {row['faults']}", flush=True)
                    if len(options.methods) > 1 and not isinstance(results[method], str):
                        shutil.move(directory / f"{method}_{law}" / "out", scratch / method)
                        results[method].directory = scratch / method
                    shutil.rmtree(directory)
                pair = [results[method] for method in options.methods[:2]]
                if len(pair) == 2 and not any(isinstance(result, str) for result in pair):
                    agreements.append((scene.label, law, *agreement(*pair, float(options.tolerance))))
                for method in options.methods:
                    shutil.rmtree(scratch / method, ignore_errors=True)
    except KeyboardInterrupt:
        print("interrupted")
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    return rows, agreements


def spread(values):
    """Number, median, ninth tenth and greatest of values that are."""
    values = np.array([x for x in values if np.isfinite(x)])
    if len(values) == 0:
        return "none"
    median, most = np.quantile(values, [0.5, 0.9])
    return f"{len(values):4d} scenes: median {median:.2g}, 90 % below {most:.2g}, greatest {np.max(values):.2g}"


def tell(rows, agreements, methods):
    """The table."""
    print(f"\nsteps over those with the smooth law, transition speed {TRANSITION} m/s")
    print(f"{'method':10s} {'runs':>5s} {'ended 0':>7s} {'other codes':20s} {'median':>7s} {'maximum':>8s} {'above 10':>8s} "
          f"{'not unique':>10s} {'faults':>6s} {'seconds':>8s}")
    for method in methods:
        mine = [row for row in rows if row["method"] == method]
        ended = [row for row in mine if row["code"] == 0]
        ratios = np.array([row["steps"]/row["smooth_steps"] for row in ended if row["smooth_steps"]] or [np.nan])
        others = " ".join(sorted({str(row["code"]) for row in mine} - {"0"}))
        print(f"{method:10s} {len(mine):5d} {len(ended):7d} {others:20s} {np.median(ratios):7.2f} {np.max(ratios):8.2f} "
              f"{np.sum(ratios > RATIO):8d} {sum(row['not_unique'] for row in ended):10d} {sum(bool(row['faults']) for row in mine):6d} "
              f"{sum(row['seconds'] for row in ended):8.0f}")
    if agreements:
        print(f"\ndifferences of {methods[0]} and {methods[1]}, in tolerances")
        for k in range(FIRST):
            print(f"onset {k + 1}:        {spread([entry[2][k] for entry in agreements])}")
            print(f"impact speed {k + 1}: {spread([entry[3][k] for entry in agreements])}")
        print(f"place at rest:  {spread([entry[4] for entry in agreements])}")


def write_csv(path, rows, agreements):
    """The rows, and beside them the differences of two methods."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    with open(path.with_suffix(".pairs.csv"), "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        names = [f"{what}_{k + 1}" for what in ("onset", "speed") for k in range(FIRST)]
        writer.writerow(["scene", "law", *names, "rest"])
        writer.writerows([label, law, *onsets, *speeds, rest] for label, law, onsets, speeds, rest in agreements)


def main():
    """Run and tell."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    parser.add_argument("--methods", nargs="+", default=["verner", "bdf"], help="the first two are compared")
    parser.add_argument("--law", default="coulomb", help=f"coulomb, any, or one of {' '.join(OTHER_LAWS)}")
    parser.add_argument("--kinds", nargs="+", default=KINDS, choices=KINDS, metavar="KIND", help=" ".join(KINDS))
    parser.add_argument("--first", type=int, default=0, help="number of the first scene of a kind")
    parser.add_argument("--each", type=int, default=100, help="scenes of a kind")
    parser.add_argument("--end", type=float, default=END, help="of a scene [s]")
    parser.add_argument("--tolerance", default="1e-8", help="of all runs")
    parser.add_argument("--csv", type=pathlib.Path, help="a file for the rows; .pairs.csv beside it has what two methods say")
    options = parser.parse_args()
    rows, agreements = survey((options.build / "gudgeon").resolve(), options)
    tell(rows, agreements, options.methods)
    if options.csv:
        write_csv(options.csv, rows, agreements)


if __name__ == "__main__":
    main()
