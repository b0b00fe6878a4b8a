"""A sweep as a Slurm array of 20 tasks on a Slurm of this host: one task is killed, one reaches its time limit; both are queued again, and
the merged file is that of a sweep that nothing disturbed. Usage: array_sweep.py GUDGEON DIRECTORY"""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TASKS = 20
SWEEP = """
[sweep]
c = 0.1 .. 0.5 mm in 40
[analysis.dynamic]
end = 40 turns of motor
[statistics]
after = 2 turns of motor
period = 1 turns of motor
channels = motor.moment
[output]
channels = motor.moment
figures = bifurcation(motor.moment)
"""


def contents(path):
    """Everything in a file but where and when it was made."""
    found = {}

    def look(name, node):
        if name.startswith("provenance"):
            return
        if isinstance(node, h5py.Dataset):
            value = node[()]
            found[name] = value.tobytes() if isinstance(value, np.ndarray) and value.dtype != object else str(value)
        for key, value in node.attrs.items():
            if key not in ("REFERENCE_LIST", "DIMENSION_LIST"):
                found[f"{name}@{key}"] = str(value)

    with h5py.File(path) as file:
        file.visititems(look)
        found.update({f"@{key}": str(value) for key, value in file.attrs.items()})
    return found


def words(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def sweep_of_part(out, part):
    """Process of the sweep of a part, 0 if there is none."""
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            line = pathlib.Path("/proc", name, "cmdline").read_bytes().split(b"\0")
            parent = int(pathlib.Path("/proc", name, "stat").read_text().rsplit(")", 1)[1].split()[1])
            above = pathlib.Path("/proc", str(parent), "cmdline").read_bytes().split(b"\0")
        except (OSError, IndexError):
            continue
        if f"{part}/{TASKS}".encode() in line and str(out).encode() in line and f"{part}/{TASKS}".encode() not in above:
            return int(name)
    return 0


def wait_for(what, condition, seconds):
    end = time.time() + seconds
    while time.time() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.2)
    sys.exit(f"waited {seconds} s in vain for {what}")


def task_of(array, part):
    """What Slurm knows of a task: a dictionary."""
    shown = subprocess.run(["scontrol", "-o", "show", "job", f"{array}_{part}"], capture_output=True, text=True).stdout
    return dict(word.split("=", 1) for word in shown.split() if "=" in word)


def main(program, place):
    program = pathlib.Path(program).resolve()
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    deck = place / "study.deck"
    deck.write_text(f'deck = 1\ninclude "{ROOT}/inputs/slider_crank_dry.deck"\n' + SWEEP)
    subprocess.run([program, "sweep", deck, "--out", place / "whole", "--quiet"], check=True)
    out = place / "study"
    os.environ.update(GUDGEON=str(program), OUT=str(out))
    os.chdir(place)
    # a minute is the least limit that Slurm has; the task that is to reach it is stopped meanwhile
    said = words(ROOT / "scripts/slurm/submit_sweep", deck, TASKS, "--time=2", "--signal=B:USR1@75", "--begin=now")
    print(said, end="")
    array, merge = said.split()[1], said.rsplit(" into ", 1)[0].split()[-1]
    late = wait_for("part 1", lambda: sweep_of_part(out, 1), 120)
    os.kill(late, signal.SIGSTOP)
    print("part 1 is held until its time is nearly up")
    killed = wait_for("part 2", lambda: sweep_of_part(out, 2), 120)
    os.kill(killed, signal.SIGKILL)
    print("part 2 is killed")
    wait_for("part 2 to be queued again", lambda: int(task_of(array, 2).get("Restarts", 0)) >= 1, 240)
    print("part 2 was queued again")
    wait_for("the time limit of part 1", lambda: "out of time" in "".join(p.read_text() for p in place.glob("slurm-*_1.out")), 240)
    os.kill(late, signal.SIGCONT)  # it has TERM waiting
    wait_for("part 1 to be queued again", lambda: int(task_of(array, 1).get("Restarts", 0)) >= 1, 240)
    print("part 1 was queued again")
    wait_for("the merge", lambda: task_of(merge, "").get("JobState") == "COMPLETED" or (out / "summary.json").exists(), 600)
    whole, merged = contents(place / "whole" / "sweep.h5"), contents(out / "sweep.h5")
    differ = sorted(name for name in whole.keys() | merged.keys() if whole.get(name) != merged.get(name))
    if differ:
        sys.exit(f"the merged file differs in {differ}")
    print(f"{len(merged)} datasets and attributes of the merged file are those of an undisturbed sweep")


main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve())
