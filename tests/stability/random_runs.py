"""Running random scenes: what is wrong with one, and the hundreds of `make stability`."""

import math
import pathlib
import shutil
import subprocess

import numpy as np
from random_scenes import G, IMPACTS, KINDS, draw, fall
from support import Run, changed, written

METHODS = ("verner", "dop853", "rk4", "radau", "adams", "bdf", "ida")  # rock4, for dampers, closes the ledger of a corner to 3e-4 only
TOLERANCE = "1e-10"
# A fall without spin stays one only to what a method leaves of a spin that grows: each impact makes it a hundredfold. Errors of a
# spin below the tolerance are not seen by any error test, and of all methods adams alone, in whose iteration without a matrix such
# a part of the motion may grow from step to step, lets it come up to there: 4e-10 of the speed after one impact in two scenes of
# 400, a thousandth of that in the next tolerance 1 % away and with all other methods. The motion of the centre is right to 1e-10.
# Only where four impacts are compared: scenes of other sizes have round-off above 1e-11.
TIGHT = {"adams": "1e-11"}
STEPS = 400  # of rk4 in an elastic impact: the force begins as the power 3/2, so that the order is less than that of the method
STEPS_OF_OTHERS = 25  # where onsets are not compared
LIMIT = 60  # seconds for one run
EACH = 200  # scenes of a kind in the full set
TIME_ERROR = 1e-8  # of an onset [s]
ENERGY_ERROR = 1e-5  # residual of the ledger over the largest energy; of fixed steps it depends on the scene
SURE = {"flat_block": IMPACTS, "straight_bar": IMPACTS}  # impacts compared with the reference; the others are less stable
SURE_OF_OTHERS = 1  # their falls amplify round-off a hundredfold and more with each impact


def mistakes_of(program, scene, method, directory):
    """Run a scene by a method: a list of all that is wrong."""
    least = 100.0*scene.shortest(math.sqrt(2.0*G*scene.gap*scene.cosine))/(STEPS if scene.kind in SURE else STEPS_OF_OTHERS)
    tolerance = TIGHT.get(method, TOLERANCE) if scene.kind in SURE else TOLERANCE
    step = {"step": f"{least!r} s"} if method == "rk4" else {"tolerance": tolerance}
    deck = written(directory, changed(scene.text, "analysis.dynamic", method=method, **step))
    out = pathlib.Path(directory) / "out"
    command = [str(program), "run", str(deck), "--out", str(out), "--write", "numbers"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return [f"no end after {LIMIT} s"]
    if done.returncode != 0:
        return [f"exit code {done.returncode}: {next((x for x in done.stderr.splitlines() if x.startswith('error')), '')}"]
    run = Run(out)
    return mistakes_of_run(run, scene, method)


def mistakes_of_run(run, scene, method):
    """What is wrong with a run that came to its end."""
    contacts, summary, mistakes = run.contacts, run.summary, []
    shortest = [scene.shortest(max(speed, 1e-300)) for speed in contacts["impact_speed"]]
    for what, is_wrong in (
        ("impact speed not positive", ~(contacts["impact_speed"] > 0.0)),
        ("no force", ~(contacts["peak_force"] > 0.0)),
        ("shorter than a hundredth of an impact", contacts["duration"] < shortest),
    ):
        if np.any(is_wrong):
            mistakes.append(f"{np.sum(is_wrong)} of {len(contacts)} contacts: {what}")
    residual = summary["energy_residual_max"]/summary["energy_max"]
    if method != "rk4" and not residual <= ENERGY_ERROR:
        mistakes.append(f"residual of the ledger {residual:.1e} of the energy")
    return mistakes + (wrong_impacts(contacts, scene) if scene.is_symmetric else [])


def wrong_impacts(contacts, scene):
    """Onsets that are not those of one mass on springs."""
    sure = SURE.get(scene.kind, SURE_OF_OTHERS)
    onsets = contacts["time"][:sure*scene.count]
    if len(onsets) < sure*scene.count:
        return [f"{len(contacts)} contacts, not {IMPACTS*scene.count}"]
    error = np.abs(onsets.reshape(sure, scene.count) - fall(scene)[:sure, :1]).max()
    return [f"an onset is {error:.1e} s off"] if not error <= TIME_ERROR else []


def run_random(program, scratch, each=EACH, tell=lambda done, total, label: None):
    """All scenes of all kinds by all methods: a line of words for each that went wrong, and how many runs there were."""
    wrong, done, total = [], 0, each*len(KINDS)*len(METHODS)
    for kind in KINDS:
        for seed in range(each):
            scene = draw(kind, seed)
            for method in METHODS:
                tell(done, total, f"{scene.label}, {method}")
                directory = pathlib.Path(scratch) / "random"
                directory.mkdir()
                wrong += [f"{scene.label}, {method}: {mistake}" for mistake in mistakes_of(program, scene, method, directory)]
                shutil.rmtree(directory)
                done += 1
    return wrong, total
