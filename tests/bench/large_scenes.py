"""Time and memory of large scenes: chains of pendulums in the plane and of rods on ball joints in space, four-bars, rods on a disc.

A few steps of each with the ledger off. CPU time is that of the solution alone, the least of several runs (other work on the
machine only adds to it), by right-hand side and body; memory is the greatest of the process beyond that of the smallest chain.
"""

import argparse
import itertools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from pictures import draw, keep, show

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BOUNDS = {"pendulum": 0.3, "balls": 0.4}  # most microseconds by body and right-hand side of chains
FLAT = 0.3  # most part by which the times above N = 100 may differ
CHAINS = (4, 10, 40, 100, 400, 1000, 4000, 10000)
MOST_EVALUATIONS = 3.0e7  # evaluations of a body in one run, about: some hundred of the longest chain, whose first ones touch new memory
COLUMNS = ("scene", "n", "bodies", "solver", "stabilise", "chosen", "rhs", "cpu_us", "us_per_body", "start_s", "memory_kb_per_body")


def bodies_of(kind, n):
    """How many bodies a scene has."""
    return {"four_bars": 2*n + 1, "star": n + 1}.get(kind, n)


def plan(quick):
    """Scene, N, solver and way of holding the constraints of each measurement."""
    chains = CHAINS[:6] if quick else CHAINS
    for chain in BOUNDS:
        for n in chains:
            for hold in ("baumgarte", "projection"):
                yield chain, n, "auto", hold
            yield chain, n, "sparse", "baumgarte"
    for n in (1, 10, 40, 400):
        for solver in ("auto", "sparse"):
            yield "four_bars", n, solver, "baumgarte"
    for n in (4, 10, 30, 100) if quick else (4, 10, 30, 100, 1000):
        for solver in ("auto", "schur", "sparse") if n <= 100 else ("auto",):
            yield "star", n, solver, "baumgarte"


def deck(directory, kind, n, solver, hold):
    """The generated deck: fixed steps, the fewer the larger the scene."""
    steps = max(3, min(400, int(MOST_EVALUATIONS/(30*bodies_of(kind, n)))))
    path = directory / f"{kind}_{n}_{solver}_{hold}.deck"
    command = [sys.executable, str(ROOT / "scripts" / "make_chain"), kind, str(n), "--ledger", "off", "--solver", solver,
               "--stabilise", hold, "--end", f"{steps*1e-3:g}", "--every", f"{steps*1e-3:g}", "--maximum-step", "1e-3",
               "--method", "rk4", "--out", str(path)]
    subprocess.run(command, check=True)
    path.write_text(path.read_text().replace("maximum_step ", "step "))
    return path


def timed(command):
    """Run a command: CPU time [s] and greatest memory [kB] of the process."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"code {child.returncode} of: {' '.join(command)}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss


def solver_chosen(program, path):
    """What `explain` says of the solver: the word that runs."""
    text = subprocess.run([str(program), "explain", str(path)], capture_output=True, text=True, check=True).stdout
    return next(line.split()[1] for line in text.splitlines() if line.split()[:1] == ["solver"])


def run_once(program, path, out):
    """CPU time of the solution and of the rest [s], greatest memory [kB], right-hand sides."""
    seconds, memory = timed([str(program), "run", str(path), "--quiet", "--out", str(out)])
    summary = json.loads((out / "summary.json").read_text())
    shutil.rmtree(out)
    return summary["cpu_seconds"], seconds - summary["cpu_seconds"], memory, summary["rhs_evaluations"]


def measure(program, directory, scenes, repeat):
    """The table. All scenes in each of several rounds: a burst of other work on the machine spoils one round, not one scene."""
    decks = [deck(directory, *scene) for scene in scenes]
    runs = [[] for _ in scenes]
    for k in range(repeat):
        print(f"bench: large scenes, round {k + 1} of {repeat}", file=sys.stderr)
        for path, done in zip(decks, runs):
            done.append(run_once(program, path, directory / "out"))
    rows = []
    for (kind, n, solver, hold), path, done in zip(scenes, decks, runs):
        solution, rest, memory, rhs = (min(run[k] for run in done) for k in range(4))
        bodies = bodies_of(kind, n)
        rows.append({"scene": kind, "n": n, "bodies": bodies, "solver": solver, "stabilise": hold,
                     "chosen": solver_chosen(program, path), "rhs": rhs, "cpu_us": 1e6*solution,
                     "us_per_body": 1e6*solution/rhs/bodies, "start_s": rest, "memory_kb": memory})
    return rows


def judge(rows):
    """Whether chains keep the bounds, in words."""
    for (scene, bound), hold in itertools.product(BOUNDS.items(), ("baumgarte", "projection")):
        chain = {row["n"]: row["us_per_body"] for row in rows
                 if row["scene"] == scene and row["solver"] == "auto" and row["stabilise"] == hold and row["n"] >= 100}
        most, least = max(chain.values()), min(chain.values())
        words = ("met" if most <= bound else "NOT met", "met" if most <= (1.0 + FLAT)*least else "NOT met")
        print(f"Bound: {scene}, N = 100 to {max(chain)} with {hold}, at most {bound} us by body and right-hand side: "
              f"{most:.3f}: {words[0]}; flat within {100*FLAT:.0f} %: {100*(most/least - 1.0):.0f} %: {words[1]}.")


def main():
    """Measure all, show, keep, draw, judge."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the program is")
    options.add_argument("--repeat", type=int, default=5, help="runs of which the fastest is taken")
    options.add_argument("--quick", action="store_true", help="up to 1000 bodies")
    given, _ = options.parse_known_args()
    results = given.build / "bench"
    with tempfile.TemporaryDirectory(prefix="gudgeon_bench_") as temporary:
        rows = measure(given.build / "gudgeon", pathlib.Path(temporary), tuple(plan(given.quick)), given.repeat)
    base = min(row["memory_kb"] for row in rows)
    for row in rows:
        row["memory_kb_per_body"] = (row["memory_kb"] - base)/row["bodies"]
    print("\nLarge scenes, ledger off, RK4 in steps of 1 ms; start_s: reading, assembling and output [s].\n")
    show(COLUMNS, rows)
    keep(COLUMNS, rows, results / "large_scenes.csv")
    series = {}
    for row in rows:
        series.setdefault(f"{row['scene']}, {row['solver']}, {row['stabilise']}", []).append((row["bodies"], row["us_per_body"]))
    draw(series, results / "large_scenes.png", "Time of a right-hand side by body", ("bodies", "us by body and right-hand side"))
    print(f"\n{results}/large_scenes.csv and .png hold this table and its picture.\n")
    judge(rows)


if __name__ == "__main__":
    main()
