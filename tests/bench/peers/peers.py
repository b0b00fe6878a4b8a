"""gudgeon and other programs on the same scenes: processor time of the solution against its error, in one interleaved run.

Each program solves each scene of scenes.py over a ladder of tolerances or steps, round by round, so that what else the machine does
meets all. Errors are the greatest distance of any centre of mass at the end from the reference, over the scene's size; of the
slider-crank, the greatest error of the first ten onsets [s] against an independent solution, of the pendulum in a ball and socket
against gudgeon's own. The reference of the others is gudgeon's own tightest run; what the best run of another program differs from it is shown beside it. A run that fails is told with its reason.
"""

import argparse
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "tests" / "e2e"), str(ROOT / "tests" / "bench")]
import scenes  # noqa: E402
from pictures import draw, keep, show  # noqa: E402
from reference_values import IMPACTS  # noqa: E402
from support import Run, changed, written  # noqa: E402

COLUMNS = ("scene", "program", "setting", "error", "cpu_s", "least_s", "steps")
ONSETS = 10  # of a loose joint, whose errors are told
DECADES = [10.0**-k for k in range(1, 12)]


def ladder(first, last, per_decade=1):
    """Tolerances from 10^-first to 10^-last."""
    return [f"{10.0**(-k/per_decade):.3g}" for k in range(first*per_decade, last*per_decade + 1)]


def steps(first, last):
    """Numbers of steps, doubled from one to the next."""
    return [str(first*2**k) for k in range(round(math.log2(last/first)) + 1)]


def plan(quick):
    """Scenes, and the settings of each program for it."""
    tolerances = ladder(2, 9)
    chains = (4, 16, 64) if quick else (4, 16, 64, 256, 1024)
    for n in chains:
        most = max(250, min(32000, 4*10**6//n))
        yield scenes.chain(n), {
            "gudgeon": [("verner", t) for t in ladder(2, 11)],
            "Simbody": [(m, t) for m in ("merson", "feldberg", "cpodes_adams") for t in tolerances],
            "MuJoCo": [(m, s) for m in ("RK4", "implicitfast") for s in steps(250, most)],
            "Exudyn": [("tree", t) for t in ladder(2, 10)] if n <= 64 else []}
    loops = {"Simbody": [(m, t) for m in ("merson", "feldberg") for t in tolerances]}
    yield scenes.andrews(), {
        "gudgeon": [("verner", t) for t in ladder(3, 12)], **loops,
        "MuJoCo": [(m, s) for m in ("RK4", "implicitfast") for s in steps(250, 32000)],
        "Exudyn": [("trapezoidal", s) for s in steps(250, 16000)]}
    yield scenes.four_bars(4 if quick else 40), {
        "gudgeon": [("verner", t) for t in ladder(3, 11)], **loops,
        "MuJoCo": [(m, s) for m in ("RK4", "implicitfast") for s in steps(1000, 32000)],
        "Exudyn": [("trapezoidal", s) for s in steps(1000, 4000)]}
    yield scenes.slider_crank(), {
        "gudgeon": [("verner", t) for t in ladder(3, 12)], **loops}
    for scene in scenes.SPATIAL[::3] if quick else scenes.SPATIAL:
        yield scene, {
            "gudgeon": [(m, t) for m in ("verner", "dop853") for t in ladder(3, 11)]
            + ([("radau", t) for t in ladder(2, 11)] if scene["name"] == "governor" else []),
            "Simbody": [(m, t) for m in ("merson", "feldberg", "cpodes_bdf" if scene["name"] == "governor" else "cpodes_adams")
                        for t in ladder(2, 7 if scene["loose"] else 9)]}


class Programs:
    """What runs here, and how."""

    def __init__(self, build, directory, limit):
        self.build, self.directory, self.limit = build, directory, limit
        tools = build / "bench" / "peers"
        python = tools / "venv" / "bin" / "python"
        here = pathlib.Path(__file__).parent
        self.commands = {"gudgeon": [str(build / "gudgeon")]}
        if (tools / "simbody_peer").exists():
            self.commands["Simbody"] = [str(tools / "simbody_peer")]
        self.in_space = str(tools / "simbody_space")
        for name, script in (("MuJoCo", "mujoco_peer.py"), ("Exudyn", "exudyn_peer.py")):
            if python.exists() and not subprocess.run([str(python), "-c", f"import {name.lower()}"], capture_output=True).returncode:
                self.commands[name] = [str(python), "-W", "ignore", str(here / script)]

    def run(self, program, scene, setting):
        """Processor time, steps, centres (x, y) at the end and onsets, or why there are none."""
        try:
            if program == "gudgeon":
                return self.own(scene, setting)
            command, text = self.commands[program], ""
            if "deck" in scene:
                command = [self.in_space, scene["name"]]
            else:
                text = "\n".join(scenes.lines(scene))
            done = subprocess.run([*command, *setting], input=text, capture_output=True, text=True, timeout=self.limit)
        except subprocess.TimeoutExpired:
            return {"why": f"longer than {self.limit:.0f} s"}
        if done.returncode != 0:
            said = " ".join(done.stderr.split())
            return {"why": said[-200:] if said else f"ended with code {done.returncode}"}
        found = {"centres": [], "onsets": []}
        for line in done.stdout.splitlines():
            word, *values = line.split()
            values = [float(v) for v in values]
            if word == "centre":
                found["centres"].append(values)
            elif word == "onset":
                found["onsets"] += values
            elif word in ("cpu", "steps"):
                found[word] = values[0]
        return found if all(math.isfinite(v) for c in found["centres"] for v in c) else {"why": "not finite"}

    def own(self, scene, setting):
        """gudgeon's run; the energy ledger, which no other program keeps, is off."""
        method, tolerance = setting
        path = written(self.directory, text_of_scene(scene, method), f"{scene['name']}_{method}.deck")
        out = self.directory / f"{scene['name']}_out"
        done = subprocess.run([*self.commands["gudgeon"], "run", str(path), "--tolerance", tolerance, "--quiet", "--out", str(out)],
                              capture_output=True, text=True, timeout=max(self.limit, 60.0))
        if done.returncode != 0:
            return {"why": (done.stderr.splitlines() or [f"code {done.returncode}"])[0]}
        run = Run(out)
        onsets = list(run.read("events")["time"]) if scene["loose"] else []
        centres = run.read("bodies/position")[-1].tolist()
        if "deck" in scene:
            names = [name.strip() for name in run.read("bodies/names")]
            centres = [centres[names.index(name)] for name in scene["bodies"]]
        return {"cpu": run.summary["cpu_seconds"], "steps": run.summary["steps"], "onsets": onsets, "centres": centres}


def text_of_scene(scene, method):
    """A scene as a deck with hardly any output."""
    if "deck" not in scene:
        return scenes.deck(scene, method, "auto")
    text = (ROOT / scene["deck"]).read_text()
    end = re.search(r"(?m)^end\s*=\s*(.*)$", text)[1]
    for key, value in scene["parameters"].items():
        text = changed(text, "parameters", **{key: value})
    text = changed(text, "analysis.dynamic", method=method, ledger="off")
    return changed(text, "output", figures=None, every=end, channels="*.position")


def error_of(scene, found, reference):
    """The error of a run by the scene's measure; not a number if there are other contacts."""
    if scene["loose"]:
        wanted = reference["onsets"][:ONSETS]
        return max(abs(a - b) for a, b in zip(found["onsets"], wanted)) if len(found["onsets"]) >= len(wanted) else math.nan
    return max(math.dist(a, b) for a, b in zip(found["centres"], reference["centres"]))/scene["size"]


def measure(programs, scene, settings, repeat, budget):
    """All runs of a scene in rounds: rows with the median time, and what failed with its reason. A ladder that has taken the budget
    in one run goes no further."""
    if scene["name"] == "slider_crank":
        reference = {"onsets": [impact[0] for impact in IMPACTS]}
    else:
        reference = programs.run("gudgeon", scene, ("dop853", "1e-12") if "deck" in scene else ("verner", "1e-13"))
    rows, failed, times, over = {}, {}, {}, set()
    for k in range(repeat):
        for program, ladder_of in settings.items():
            if program not in programs.commands:
                continue
            for setting in ladder_of:
                if (program, setting[0]) in over or (program, setting) in failed:
                    continue
                found = programs.run(program, scene, setting)
                if "why" in found:
                    failed[program, setting] = found["why"]
                    continue
                times.setdefault((program, setting), []).append(found["cpu"])
                rows[program, setting] = {"scene": scene["name"], "program": program, "setting": " ".join(setting),
                                          "error": error_of(scene, found, reference), "steps": int(found["steps"])}
                if found["cpu"] > budget:
                    over.add((program, setting[0]))
    for key, row in rows.items():
        row["cpu_s"], row["least_s"] = statistics.median(times[key]), min(times[key])
    return list(rows.values()), failed


def cheapest(rows, program, error):
    """Least time of a program for at most an error, interpolated between the neighbours on its front; None if it is not reached."""
    front = sorted(((r["cpu_s"], r["error"]) for r in rows if r["program"] == program and r["error"] > 0.0))
    best, before = math.inf, None
    for cpu, e in front:
        if e >= best:
            continue
        best = e
        if e <= error:
            if before is None or before[1] <= error:
                return cpu
            part = math.log(before[1]/error)/math.log(before[1]/e)
            return before[0]*(cpu/before[0])**part
        before = cpu, e
    return None


def compare(rows):
    """For each error and program: its time over gudgeon's."""
    table = []
    for name in dict.fromkeys(r["scene"] for r in rows):
        of_scene = [r for r in rows if r["scene"] == name]
        for error in DECADES:
            if error > 1e-5 and name in ("slider_crank", "ball_pendulum"):
                continue  # onsets are tens of microseconds apart
            own = cheapest(of_scene, "gudgeon", error)
            others = {p: cheapest(of_scene, p, error) for p in ("Simbody", "MuJoCo", "Exudyn")}
            if own is None or all(v is None for v in others.values()):
                continue
            table.append({"scene": name, "error": error, "gudgeon_s": own, **{p: v/own if v else math.nan for p, v in others.items()}})
    return table


def main():
    """Measure, show, keep and draw; the exit code is 1 if another program is ahead anywhere."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the programs are")
    options.add_argument("--repeat", type=int, default=3, help="rounds of which the median is taken")
    options.add_argument("--quick", action="store_true", help="small scenes only")
    options.add_argument("--only", default="", help="scenes whose names hold this")
    options.add_argument("--budget", type=float, default=10.0, help="seconds of a run after which its ladder ends")
    given = options.parse_args()
    results = given.build / "bench" / "peers"
    results.mkdir(parents=True, exist_ok=True)
    everything, reasons = [], []
    with tempfile.TemporaryDirectory(prefix="gudgeon_peers_") as temporary:
        programs = Programs(given.build, pathlib.Path(temporary), 6*given.budget)
        missing = {"Simbody", "MuJoCo", "Exudyn"} - set(programs.commands)
        if missing:
            print(f"bench-peers: not there, so not measured: {' '.join(sorted(missing))}", file=sys.stderr)
        for scene, settings in plan(given.quick):
            if given.only not in scene["name"]:
                continue
            print(f"bench-peers: {scene['name']}", file=sys.stderr)
            rows, failed = measure(programs, scene, settings, given.repeat, given.budget)
            everything += rows
            reasons += [f"{scene['name']}: {program} {' '.join(setting)}: {why}" for (program, setting), why in failed.items()]
            series = {}
            for row in rows:
                if row["error"] > 0.0:
                    series.setdefault(f"{row['program']} {row['setting'].split()[0]}", []).append((row["error"], row["cpu_s"]))
            unit = "greatest error of ten onsets [s]" if scene["loose"] else "error of positions at the end, over the size [1]"
            draw(series, results / f"peers_{scene['name']}.png", f"{scene['name']}: cost against error", (unit, "CPU time of the solution [s]"))
    keep(COLUMNS, everything, results / "peers.csv")
    show(COLUMNS, everything)
    print("\nTime of the others over gudgeon's at the same error (1: equal; -: that error is not reached):\n")
    table = compare(everything)
    keep(("scene", "error", "gudgeon_s", "Simbody", "MuJoCo", "Exudyn"), table, results / "peers_ratio.csv")
    show(("scene", "error", "gudgeon_s", "Simbody", "MuJoCo", "Exudyn"), table)
    if reasons:
        print("\nRuns without a result:")
        print("\n".join(reasons))
    behind = [(r["scene"], r["error"], p) for r in table for p in ("Simbody", "MuJoCo", "Exudyn") if r[p] < 1.0]
    print("\n" + ("gudgeon is ahead of every other at every error that both reach." if not behind else
                  "Behind at: " + "; ".join(f"{s}, {e:g}, {p}" for s, e, p in behind)))
    sys.exit(1 if behind else 0)


if __name__ == "__main__":
    main()
