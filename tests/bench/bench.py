"""Runs gudgeon and the hand-coded program over a ladder of tolerances: time, counts and errors of each.

CPU times are those of the solution alone, without reading the deck or writing output, each the median of several
rounds; the least is shown too: other work on the same core, seen or not, makes a run up to twice as long. Errors are those of the first ten onsets (greatest), and of impact speed and peak force of the first five impacts
(greatest, relative) against an independent solution; the motion is chaotic and comparable no further.
"""

import argparse
import csv
import math
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests" / "e2e"))
from reference_values import IMPACT_FIELDS, IMPACTS  # noqa: E402
from support import Run, plain_deck, written  # noqa: E402

BOUND, HAND_CODED = 100.0, 46.0  # most nanoseconds per right-hand side with the ledger off, where the hand-coded program takes so many
TOLERANCES = [f"1e-{k}" for k in range(4, 13)]
COLUMNS = ("program", "ledger", "method", "tolerance", "steps", "rejected", "rhs", "cpu_us", "ns_per_rhs", "ns_least",
           "error_onsets", "error_speeds", "error_forces", "residual")
METHODS = ("verner", "dop853")
KINDS = [("gudgeon", ledger, method) for method in METHODS for ledger in ("on", "off")] + [("hand-coded", "-", "verner")]
TITLES = {("gudgeon", "on", "verner"): "gudgeon, verner, with energy ledger", ("gudgeon", "off", "verner"): "gudgeon, verner, ledger off",
          ("gudgeon", "on", "dop853"): "gudgeon, dop853, with energy ledger", ("gudgeon", "off", "dop853"): "gudgeon, dop853, ledger off",
          ("hand-coded", "-", "verner"): "hand-coded minimal coordinates"}
STYLES = {kind: style for kind, style in zip(KINDS, ((7, "#0072b2"), (5, "#d55e00"), (6, "#0072b2"), (4, "#d55e00"), (9, "#555555")))}
COMPARED = [10.0 ** (-7.0 - k / 2.0) for k in range(7)]  # errors of onsets at which times are compared [s]


def deck(directory, ledger, end="24 ms"):
    """The deck with hardly any output: two instants of one channel, no rows at contacts, no figures."""
    changes = [("analysis.dynamic", "ledger", ledger), ("analysis.dynamic", "end", end), ("output", "every", end),
               ("output", "channels", "slider.position"), ("output", "contact_rows", "off")]
    return written(directory, plain_deck(changes), f"ledger_{ledger}_{end.replace(' ', '')}.deck")


def command(program, scene, method, tolerance, out):
    """The command line of one run."""
    return [str(program), "run", str(scene), "--method", method, "--tolerance", tolerance, "--quiet", "--json", "--out", str(out)]


def greatest(run, field, count, relative):
    """Greatest error of a field of the first contacts."""
    reference = [impact[IMPACT_FIELDS.index(field)] for impact in IMPACTS[:count]]
    found = run.contacts[field][:count]
    if len(found) < count:
        return math.nan
    return max(abs(a - b) / (abs(b) if relative else 1.0) for a, b in zip(found, reference))


def gudgeon_run(program, directory, ledger, method, tolerance):
    """One run: its CPU time [s], counts and errors."""
    out = directory / f"{ledger}_{method}_{tolerance}"
    done = subprocess.run(command(program, deck(directory, ledger), method, tolerance, out), capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"gudgeon ended with code {done.returncode} at tolerance {tolerance}:\n{done.stderr}")
    run = Run(out)
    row = {
        "program": "gudgeon", "ledger": ledger, "method": method, "tolerance": tolerance, "steps": run.summary["steps"],
        "rejected": run.summary["rejected_steps"], "rhs": run.summary["rhs_evaluations"],
        "error_onsets": greatest(run, "time", 10, False),
        "error_speeds": greatest(run, "impact_speed", 5, True),
        "error_forces": greatest(run, "peak_force", 5, True),
        "residual": run.summary["energy_residual_max"] / run.summary["energy_max"] if ledger == "on" else math.nan,
    }
    shutil.rmtree(out)
    return run.summary["cpu_seconds"], row


def measured_rows(program, hand_coded, directory, tolerances, repeat):
    """All tolerances with the ledger on and off, and the hand-coded program, in rounds: a burst of other work on the
    machine spoils a round of all, not one of them. CPU times are medians over the rounds."""
    cpu, rows = {}, {}
    for k in range(repeat):
        print(f"bench: round {k + 1} of {repeat}", file=sys.stderr)
        for row in hand_coded_rows(hand_coded, 0.01):
            key = row["tolerance"], KINDS[-1]
            rows[key] = row
            cpu.setdefault(key, []).append(row["cpu_us"] / 1e6)
        for tolerance in tolerances:
            for kind in KINDS[:-1]:
                seconds, rows[tolerance, kind] = gudgeon_run(program, directory, kind[1], kind[2], tolerance)
                cpu.setdefault((tolerance, kind), []).append(seconds)
    for key, row in rows.items():
        row["cpu_us"] = 1e6 * statistics.median(cpu[key])
        row["ns_per_rhs"] = 1e3 * row["cpu_us"] / row["rhs"]
        row["ns_least"] = 1e9 * min(cpu[key]) / row["rhs"]
    return rows


def hand_coded_rows(program, seconds):
    """The hand-coded program's table."""
    text = subprocess.run([str(program), str(seconds)], capture_output=True, text=True, check=True).stdout
    names, *lines = (line.split() for line in text.splitlines())
    for line in lines:
        found = dict(zip(names, line))
        exponent = round(-math.log10(float(found["tolerance"])))
        yield {
            "program": "hand-coded", "ledger": "-", "method": "verner", "tolerance": f"1e-{exponent}", "steps": int(found["steps"]),
            "rejected": int(found["rejected"]), "rhs": int(found["rhs"]), "cpu_us": float(found["cpu_us"]),
            "error_onsets": float(found["error_10"]), "error_speeds": float(found["speeds"]), "error_forces": math.nan,
            "residual": math.nan,
        }


def cell(value):
    """A number as the table on the terminal shows it."""
    if not isinstance(value, float):
        return str(value)
    if math.isnan(value):
        return "-"
    return f"{value:.1f}" if value >= 1.0 else f"{value:.1e}"


def show(rows):
    """The table: for each tolerance gudgeon by each method, with and without ledger, and the hand-coded program."""
    heads = ("program", "ledger", "method", "tol", "steps", "rejected", "rhs", "CPU [us]", "ns/rhs", "least", "onsets [s]", "speeds",
             "forces", "residual")
    lines = [heads] + [tuple(cell(row[column]) for column in COLUMNS) for row in rows]
    widths = [max(len(line[k]) for line in lines) for k in range(len(heads))]
    print("Dry slider-crank, 24 ms. Errors: first 10 onsets; speeds and forces of the first 5 impacts, relative.\n")
    for k, line in enumerate(lines):
        print("  ".join(c.ljust(w) if i < 3 else c.rjust(w) for i, (c, w) in enumerate(zip(line, widths))).rstrip())
        if k == 0 or k < len(rows) and rows[k - 1]["tolerance"] != rows[k]["tolerance"]:
            print()


def keep(rows, path):
    """The same as a CSV file."""
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        table.writerows({c: f"{v:.6g}" if isinstance(v, float) else v for c, v in row.items()} for row in rows)


def kind_of(row):
    """Program, ledger and method of a row."""
    return row["program"], row["ledger"], row["method"]


def cheapest(rows, kinds, error, quantity="cpu_us"):
    """Least CPU time [us], or another quantity, of some kinds for an error: between two tolerances of a kind logarithms go along a line."""
    times = []
    for kind in kinds:
        points = sorted((math.log(row["error_onsets"]), math.log(row[quantity])) for row in rows
                        if kind_of(row) == kind and row["error_onsets"] > 0.0)
        for (x0, y0), (x1, y1) in zip(points, points[1:]):
            if x0 <= math.log(error) <= x1 and x1 > x0:
                times.append(math.exp(y0 + (y1 - y0) * (math.log(error) - x0) / (x1 - x0)))
    return min(times, default=math.nan)


def ratios(rows):
    """CPU time over that of the hand-coded program at the same error of onsets, 1e-7 s to 1e-10 s, means."""
    for ledger in ("off", "on"):
        for kinds in ([("gudgeon", ledger, method)] for method in METHODS):
            yield ledger, kinds[0][2], statistics.mean(cheapest(rows, kinds, e) / cheapest(rows, KINDS[-1:], e) for e in COMPARED)
        kinds = [("gudgeon", ledger, method) for method in METHODS]
        yield ledger, "the cheaper one", statistics.mean(cheapest(rows, kinds, e) / cheapest(rows, KINDS[-1:], e) for e in COMPARED)


def draw(rows, path):
    """CPU time against error, a line per program."""
    series = {}
    for row in rows:
        if row["error_onsets"] > 0.0:
            series.setdefault(kind_of(row), []).append((row["error_onsets"], row["cpu_us"] / 1e3))
    blocks = "".join(f"${n} << E\n" + "".join(f"{x:.4e} {y:.4e}\n" for x, y in points) + "E\n"
                     for n, points in enumerate(series.values(), 1)).replace("$", "$d")
    curves = ", ".join("$d{} using 1:2 with linespoints lw 2 pt {} ps 1.3 lc rgb '{}' title '{}'".format(n, *STYLES[kind], TITLES[kind])
                       for n, kind in enumerate(series, 1))
    script = f"""set terminal pngcairo size 900,600 font 'DejaVu Sans,11'
set output '{path}'
set logscale xy
set format xy '10^{{%T}}'
set xlabel 'greatest error of the first ten onsets of contact [s]'
set ylabel 'CPU time of the solution [ms]'
set title 'Dry slider-crank, two turns: tolerances 1e-4 to 1e-12'
set grid
set key top right
{blocks}plot {curves}
"""
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def instructions(program, directory, ledger):
    """Instructions per right-hand side: what a run of two turns takes more than a run of one."""
    counts = []
    for end in ("12 ms", "24 ms"):
        out = directory / f"callgrind_{ledger}_{end.split()[0]}"
        tool = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={directory / 'callgrind.out'}"]
        done = subprocess.run(tool + command(program, deck(directory, ledger, end), "verner", "1e-8", out), capture_output=True, text=True)
        collected = re.search(r"Collected : (\d+)", done.stderr)
        if done.returncode != 0 or not collected:
            return None
        counts.append((int(collected[1]), Run(out).summary["rhs_evaluations"]))
    (one, rhs_one), (two, rhs_two) = counts
    return (two - one) / (rhs_two - rhs_one)


def main():
    """Run everything, print the table, keep it, draw it, and say whether the bound is met."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the programs are")
    options.add_argument("--repeat", type=int, default=9, help="rounds of runs of which the median is taken")
    options.add_argument("--quick", action="store_true", help="tolerances 1e-6, 1e-8 and 1e-10 only")
    options.add_argument("--callgrind", action="store_true", help="count instructions per right-hand side as well")
    given = options.parse_args()
    program, results = given.build / "gudgeon", given.build / "bench"
    tolerances = ["1e-6", "1e-8", "1e-10"] if given.quick else TOLERANCES
    rows = []
    with tempfile.TemporaryDirectory(prefix="gudgeon_bench_") as temporary:
        directory = pathlib.Path(temporary)
        measured = measured_rows(program, results / "minimal_slider_crank", directory, tolerances, given.repeat)
        for tolerance in tolerances:
            rows += [measured[tolerance, kind] for kind in KINDS]
        show(rows)
        print("\nCPU time over that of the hand-coded program at the same error of onsets, mean over 1e-7 s to 1e-10 s:")
        for ledger, method, ratio in ratios(rows):
            print(f"  ledger {ledger}, {method}: {ratio:.2f}")
        keep(rows, results / "slider_crank_dry.csv")
        if shutil.which("gnuplot"):
            draw(rows, results / "slider_crank_dry.png")
            print(f"\n{results}/slider_crank_dry.csv and .png hold this table and its picture.")
        if given.callgrind and shutil.which("valgrind"):
            for ledger in ("on", "off"):
                count = instructions(program, directory, ledger)
                print(f"Instructions per right-hand side, ledger {ledger}: {count:.0f}" if count else
                      "valgrind could not run the program (built for instructions that it does not know?)")
    print(f"\nBound, ledger off: at most {BOUND:.0f} ns per right-hand side where the hand-coded program takes {HAND_CODED:.0f}; means over the same errors:")
    for quantity, words in (("ns_per_rhs", "medians"), ("ns_least", "shortest runs")):
        hand_coded = statistics.mean(cheapest(rows, KINDS[-1:], error, quantity) for error in COMPARED)
        for method in METHODS:
            taken = statistics.mean(cheapest(rows, [("gudgeon", "off", method)], error, quantity) for error in COMPARED)
            scaled = taken*HAND_CODED/hand_coded
            print(f"  {words}, {method}: {taken:.0f} ns, hand-coded {hand_coded:.1f}, that is {scaled:.0f} for {HAND_CODED:.0f}: "
                  f"{'met' if scaled <= BOUND else 'NOT met'}")


if __name__ == "__main__":
    main()
