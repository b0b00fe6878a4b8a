"""docs/theory/evidence/performance.md from the tables and pictures that the timers left in build/bench: `make bench BENCH=--docs`.

A part whose table is not there, as those of `make bench-peers`, stays as the page has it. Nothing is measured here.
"""

import argparse
import csv
import math
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

# Table, picture, heading, what stands before the table.
PARTS = (
    ("slider_crank_dry.csv", "slider_crank_dry.png", "Speed against error: the dry slider-crank of section 4.4",
     "24 ms, two turns. Errors: the maximum of the first ten onsets [s], the maximum relative ones of speeds and peak forces of the "
     "first five impacts, against an independent solution. `hand-coded`: a program for this one scene in minimal coordinates, the "
     "limit of what a general program can hope for. `ns_least`: of the shortest run."),
    ("small_run.csv", None, "A small run from start to exit",
     "The same mechanism, figures off: processor time of the whole process, median and minimum, and its maximum memory. The first run has "
     "two output times of one channel, the second those of the deck (2401 times, and rows at contacts)."),
    ("folders.csv", None, "Where the instructions of that run go",
     "With the output of the deck, by folder of src/ and by library (callgrind)."),
    ("sample_cost.csv", None, "What a sample costs",
     "The same mechanism with twelve channels every 2 us, in instructions (callgrind). `evaluation`: of the right-hand side. `sample`: state, "
     "evaluation, reactions and channels at an output time. `row`: what is then written to run.h5."),
    ("large_scenes.csv", "large_scenes.png", "Large scenes: time by body, start, memory",
     "Decks of `scripts/make_chain`, ledger off, RK4 in steps of 1 ms. `us_per_body`: by body and right-hand side; `start_s`: reading, "
     "assembling and output; memory beyond that of the smallest scene."),
    ("holding.csv", None, "Stabilisation methods and integrators",
     "CPU time against error over a sequence of tolerances."),
    ("space_cost.csv", None, "The plane beside space",
     "The dry slider-crank, ledger off: as the deck of the plane has it (its crank is a known function of time), with all coordinates of the "
     "plane, and translated to space. Instructions of a right-hand side (callgrind); onsets of the first five impacts against the plane's."),
    ("methods.csv", None, "The method that auto chooses, and the best named one",
     "Every deck of inputs/ and inputs/hard with a dynamic analysis at a tolerance, and tests/bench/grip.deck. `error`: of positions or angles, the "
     "maximum over their range, at the deck's tolerance by `method = auto`. `best_ms`: processor time of the best named method (verner, dop853, radau, "
     "bdf, rock4, adams, ida) for the same error, between its tolerances by a power law; empty: none of them is as accurate. `auto`: the steps that were made, where the method changed, and h lambda there."),
    ("tolerance_cost.csv", None, "Studies of tolerances",
     "Processor time of whole studies, one process after the other. Runs are those of the dry slider-crank, with 13 runs beside the members. "
     "`motions_s`: of all motions with their output times; `ratio`: `study_s` over it; `solution_s`: of as many motions without output times, "
     "by single runs; `us_per_member`: of the members alone."),
    ("peers/peers_ratio.csv", None, "Other programs on the same scenes (`make bench-peers`)",
     "Time of Simbody (Runge-Kutta-Merson and -Fehlberg; Adams of CPODES for chains), MuJoCo (RK4, implicitfast) and Exudyn (kinematic "
     "tree with DOPRI5 for chains, index-2 trapezoidal rule for loops) over gudgeon's (verner, in space dop853 too, for the governor "
     "radau; ledger off) at the same error; each by its cheapest setting. Empty: that error is not reached, or the program is not tried "
     "on that scene: contact laws as these cannot be "
     "given to MuJoCo's and Exudyn's compiled code. Errors: maximum distance of a centre of mass at the end, over the scene's size; "
     "of the slider-crank and of the pendulum in a ball and socket with clearance the maximum of ten onsets [s]."),
)
MOST_ROWS = 120


def value(text):
    """A cell: three digits of a number, nothing for one that is not finite."""
    try:
        number = float(text)
    except ValueError:
        return text
    if not math.isfinite(number):
        return ""
    return text if number == int(number) and abs(number) < 1e6 else f"{number:.3g}"


def table(path):
    """A CSV file as Markdown."""
    with open(path, newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    lines = ["| " + " | ".join(head) + " |", "|" + "---|"*len(head)]
    lines += ["| " + " | ".join(value(cell) for cell in row) + " |" for row in rows[:MOST_ROWS]]
    if len(rows) > MOST_ROWS:
        lines.append(f"\n{len(rows) - MOST_ROWS} more rows: `make bench`, build/bench/{path.name}.")
    return "\n".join(lines)


def machine():
    """Processor, compiler and revision in a line."""
    model = next((line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines()
                  if line.startswith("model name")), "unknown processor")
    compiler = subprocess.run(["gfortran", "--version"], capture_output=True, text=True).stdout.splitlines()[:1]
    return f"{model}, shared with others; {compiler[0] if compiler else 'compiler unknown'}, `-O3 -march=x86-64-v3`, one thread."


def main():
    """Write the page."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the tables are")
    given, _ = options.parse_known_args()
    results, figures, page = given.build / "bench", ROOT / "docs/figures", ROOT / "docs/theory/evidence/performance.md"
    text = ["# Performance", "",
            "Written by `make bench BENCH=--docs` (tests/bench/report.py) from the last measurement; what it means stands in "
            "[accuracy.md](accuracy.md). " + machine(), "",
            "CPU times are medians over rounds in each of which everything ran once. Others use the machine too: compare ratios within "
            "a table."]
    kept = {part.split("\n", 1)[0]: part.rstrip() for part in page.read_text(encoding="utf-8").split("\n## ")[1:]}
    for name, picture, heading, words in PARTS:
        if not (results / name).exists():
            text += ["", "## " + kept[heading]] if heading in kept else []
            continue
        text += ["", f"## {heading}", "", words, "", table(results / name)]
        if picture and (results / picture).exists():
            shutil.copy(results / picture, figures / f"performance_{picture}")
            text += ["", f"![{heading}](../../figures/performance_{picture})"]
    for picture in sorted((results / "peers").glob("peers_*.png")):
        shutil.copy(picture, figures / f"performance_{picture.name}")
        text += ["", f"![{picture.stem}](../../figures/performance_{picture.name})"]
    page.write_text("\n".join(text) + "\n", encoding="utf-8")
    print(f"{page} written.")


if __name__ == "__main__":
    main()
