"""Running random scenes with Coulomb's friction: what is wrong with one, and the hundreds of `make stability`.

Every run ends by itself, takes at most RATIO times the steps of the same scene with a smooth law (transition speed:
`random_friction.TRANSITION`), and closes its ledger to RESIDUAL, or to RATIO times what the method leaves open with the smooth law.
Friction takes energy only, but for GIVEN: in space a contact sticks as soon as it is slower than the tolerance times the speed of
the mechanism; the force that holds it works on what is left of that speed, as much as a tolerance of the energy. And it acts
anywhere within its penetration: it may give what it works on turns of the bodies about LEVER times that.
verner and bdf agree on the first contact: on the way to its onset within NEAR, which is the tolerance of a position, and on its impulse.
Where there are at most REGULAR contacts, differences have no time to grow: they agree on the whole run.
"""

import pathlib
import shutil
import subprocess

import numpy as np
from random_friction import KINDS, METHODS, draw
from support import Run, changed, written

LIMIT = 120  # seconds for one run
EACH = 100  # scenes of a kind in the full set; each by one of the methods, in turn, and by verner and bdf
RATIO = 10.0  # of the steps
FEW = 2000  # steps that are few, whatever the smooth law takes
RESIDUAL = 1e-4  # of the ledger, of the largest energy
LEVER = 2.0  # within contacts, of their penetration
GIVEN = 1e-7  # energy that friction may give between two rows: ten tolerances, of the largest energy
NEAR = 1e-8  # way between two onsets of one contact by two methods: ten tolerances of a body of 0.1 m [m]
REGULAR = 4  # contacts of a run
OF_ENERGY, OF_IMPULSE, OF_PLACE = 1e-5, 1e-4, 1e-7  # lost by friction, of the largest energy; of all impulses; last place [m]
AGREEMENT = 1e-3  # of the impulse of the first contact, by two methods
OF_ALL = 1e-8  # and the tolerance of all impulses, for a first contact that only grazes


def run(program, scene, method, friction, directory):
    """A run of a scene, or words about why there is none."""
    step = {"step": f"{scene.step!r} s", "tolerance": None} if method == "rk4" else {}
    directory = pathlib.Path(directory) / f"{method}_{friction}"
    directory.mkdir()
    text = scene.text + scene.tables.get(friction, "")
    deck = written(directory, changed(text, "analysis.dynamic", method=method, **step))
    command = [str(program), "run", str(deck), "--out", str(directory / "out"), "--write", "channels", "--set", f"friction={friction}"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return f"no end after {LIMIT} s"
    if done.returncode != 0:
        return f"exit code {done.returncode}: {next((x for x in done.stderr.splitlines() if x.startswith('error')), '')}"
    return Run(directory / "out", done)


def residual_of(result):
    """Of the ledger, of the largest energy."""
    return result.summary["energy_residual_max"]/max(result.summary["energy_max"], 1e-300)


def mistakes_of(program, scene, method, directory):
    """Run a scene by a method, with the smooth law too where it asks for much: a list of all that is wrong."""
    result = run(program, scene, method, "coulomb", directory)
    if isinstance(result, str):
        return [result]
    return faults_of(result, scene, method, lambda: run(program, scene, method, "smooth", directory))


def faults_of(result, scene, method, run_smooth):
    """What is wrong with a run that came to its end; `run_smooth` runs it with the smooth law."""
    mistakes, steps, residual = [], result.summary["steps"], residual_of(result)
    is_open = method != "rk4" and not residual <= RESIDUAL
    if steps > FEW or is_open:
        smooth = run_smooth()
        if isinstance(smooth, str):
            return [f"the smooth law: {smooth}"]
        if steps > max(FEW, RATIO*smooth.summary["steps"]):
            mistakes.append(f"{steps} steps, {smooth.summary['steps']} with the smooth law")
        if is_open and not residual <= RATIO*residual_of(smooth):
            mistakes.append(f"residual of the ledger {residual:.1e} of the energy, {residual_of(smooth):.1e} with the smooth law")
    given = np.max(-np.diff(result.read("energy/dissipated_friction").ravel()) - np.diff(work_within(result, "spatial" in scene.text)))
    if given > GIVEN*result.summary["energy_max"]:
        mistakes.append(f"friction gives {given:.1e} J of {result.summary['energy_max']:.1e}")
    return mistakes


def work_within(result, is_spatial):
    """Of friction on turns of the bodies within the penetration, up to each output instant: the most. Of any contact in space; in the plane
    of two or more that act at once."""
    angular = result.rows("bodies/angular_velocity")
    force, depth = (result.rows(f"clearances/contacts/{name}") for name in ("friction_force", "penetration"))
    spin = np.sum(np.linalg.norm(angular, axis=2), axis=1) if is_spatial else np.sum(np.abs(angular), axis=1)
    power = LEVER*np.sum(np.abs(force)*np.maximum(depth, 0.0), axis=1)*spin
    if not is_spatial:
        power *= np.count_nonzero(force, axis=1) > 1
    time = result.rows("time")
    work = np.concatenate([[0.0], np.cumsum(0.5*(power[1:] + power[:-1])*np.diff(time))])
    return np.interp(result.time, time, work)


def disagreement(program, scene, directory):
    """What verner and bdf say differently about the first contact, or a regular run; an empty list where they agree."""
    results = [run(program, scene, method, "coulomb", directory) for method in ("verner", "bdf")]
    if any(isinstance(result, str) for result in results):
        return []  # `mistakes_of` says so
    a, b = (result.contacts for result in results)
    if len(a) == 0 or len(b) == 0 or not a["duration"][0] > 0.0:
        return [] if len(a) == len(b) or not len(a)*len(b) == 0 else ["a contact by one method only"]
    words = []
    if abs(a["time"][0] - b["time"][0])*a["impact_speed"][0] > NEAR:
        words.append(f"first onset at {a['time'][0]!r} s by verner, {b['time'][0]!r} s by bdf, at {a['impact_speed'][0]:.3g} m/s")
    if abs(a["impulse"][0] - b["impulse"][0]) > AGREEMENT*abs(a["impulse"][0]) + OF_ALL*np.sum(a["impulse"]):
        words.append(f"first impulse {a['impulse'][0]:.6g} N s by verner, {b['impulse'][0]:.6g} N s by bdf")
    return words + (differences(*results) if min(len(a), len(b)) <= REGULAR else [])


def differences(one, other):
    """What two runs of a scene say differently in the whole; an empty list where they agree."""
    if len(one.contacts) != len(other.contacts):
        return [f"{len(one.contacts)} contacts and {len(other.contacts)}"]
    lost = [run.read("energy/dissipated_friction").ravel()[-1]/one.summary["energy_max"] for run in (one, other)]
    impulse = [np.sum(run.contacts["impulse"]) for run in (one, other)]
    way = np.max(np.abs(one.read("bodies/position")[-1] - other.read("bodies/position")[-1]))
    return ([f"friction takes {lost[0]!r} and {lost[1]!r} of the energy"]*(not abs(lost[0] - lost[1]) <= OF_ENERGY)
            + [f"impulses of {impulse[0]!r} and {impulse[1]!r} N s"]*(not abs(impulse[0] - impulse[1]) <= OF_IMPULSE*abs(impulse[0]))
            + [f"places {way:.1e} m apart"]*(not way <= OF_PLACE))


def run_friction(program, scratch, each=EACH, tell=lambda done, total, label: None):
    """All scenes of all kinds: a line of words for each that went wrong, and how many scenes there were."""
    wrong, done, total = [], 0, each*len(KINDS)
    for kind in KINDS:
        for seed in range(each):
            scene = draw(kind, seed)
            tell(done, total, scene.label)
            for method in dict.fromkeys((METHODS[seed % len(METHODS)], "verner", "bdf")):
                directory = pathlib.Path(scratch) / "friction"
                directory.mkdir()
                wrong += [f"{scene.label}, {method}: {mistake}" for mistake in mistakes_of(program, scene, method, directory)]
                shutil.rmtree(directory)
            directory = pathlib.Path(scratch) / "friction"
            directory.mkdir()
            wrong += [f"{scene.label}: {mistake}" for mistake in disagreement(program, scene, directory)]
            shutil.rmtree(directory)
            done += 1
    return wrong, total
