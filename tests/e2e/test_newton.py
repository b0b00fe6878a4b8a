"""Newton's laws from what is recorded, without a word from the program.

Velocities and accelerations are differences of recorded positions; forces on every body add up to mass times
acceleration. The window is 1 ms, three impacts, sampled every 0.1 us.
"""

import numpy as np
import pytest
from reference_values import INERTIA, MASS
from support import assert_close, finished

EVERY = 1e-7
CHANGES = (
    ("analysis.dynamic", "end", "1 ms"),
    ("output", "every", "0.1 us"),
    ("output", "channels", None),
)


@pytest.fixture
def run(gudgeon):
    """All channels of the first millisecond."""
    return finished(gudgeon, "--tolerance", "1e-11", changes=CHANGES)


def smooth(run, reach):
    """Instants at least `reach` samples from any onset or end of contact, where the motion is not smooth."""
    kept = np.ones(len(run.time), bool)
    kept[:reach] = kept[-reach:] = False
    ends = run.contacts["time"] + run.contacts["duration"]
    for instant in np.concatenate([run.contacts["time"], ends[np.isfinite(ends)]]):
        kept &= np.abs(run.time - instant) > (reach + 1) * EVERY
    return kept


def slope(values):
    """First derivative by five-point central differences."""
    d = np.zeros_like(values)
    d[2:-2] = (8.0 * (values[3:-1] - values[1:-3]) - (values[4:] - values[:-4])) / (12.0 * EVERY)
    return d


def pin(run):
    """Place of the journal's centre, on the rod, and of the crank pin [m]."""
    rod, angle = run.item("bodies/position", "rod"), run.item("bodies/angle", "rod")
    arm = 0.06 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return rod + arm, rod - arm


def cross(a, b):
    """Component out of the plane."""
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


@pytest.mark.parametrize("body", MASS)
def test_velocity_and_acceleration_are_derivatives(run, body):
    """Differences of position give the velocity, differences of the velocity the acceleration."""
    kept = smooth(run, 4)
    assert kept.sum() > 0.99 * len(kept)
    for part, names in (("place", ("position", "velocity", "acceleration")),
                        ("turn", ("angle", "angular_velocity", "angular_acceleration"))):
        place, speed, change = (run.item(f"bodies/{name}", body) for name in names)
        for value, rate, what in ((place, speed, "velocity"), (speed, change, "acceleration")):
            peak = np.abs(rate).max()
            noise = 1e-12 * max(np.abs(value).max(), 1e-6) / EVERY  # what 12 digits of the value leave of its differences
            allowed = 2e-7 * peak + noise
            assert_close(slope(value)[kept], rate[kept], absolute=allowed, what=f"{body}, {part}: {what}")


def test_slider_obeys_newton(run):
    """Along the guide only the gudgeon pulls: what the recorded force gives is what the positions do."""
    kept = smooth(run, 6)
    force = -run.item("clearances/force", "gudgeon")
    along = slope(slope(run.item("bodies/position", "slider")))[:, 0]
    peak = np.abs(force).max()
    assert peak > 4e4
    assert_close(MASS["slider"] * along[kept], force[kept, 0], absolute=1e-5 * peak, what="m a along the guide")


def test_slider_rests_on_the_guide(run):
    """Across the guide nothing moves: the guide takes the gudgeon's force there and, at the pin, no moment."""
    force = -run.item("clearances/force", "gudgeon")
    guide = run.item("joints/force", "guide")  # on the ground
    peak = np.abs(force).max()
    assert_close(force[:, 1] - guide[:, 1], 0.0, absolute=1e-9 * peak, what="forces across")
    assert_close(guide[:, 0], 0.0, absolute=1e-9 * peak, what="guide along")


def test_rod_obeys_newton_and_euler(run):
    """Forces of crank pin and gudgeon on the rod against its recorded acceleration."""
    journal, crank_pin = pin(run)
    place = run.item("bodies/position", "rod")
    at_journal = run.item("clearances/force", "gudgeon")
    at_crank = -run.item("joints/force", "big_end")  # recorded: on the crank
    peak = np.abs(at_journal).max()
    inertial = MASS["rod"] * run.item("bodies/acceleration", "rod")
    assert_close(at_journal + at_crank, inertial, absolute=1e-9 * peak, what="forces on the rod")
    # without friction the contact force points through the journal's centre wherever it acts
    moment = cross(journal - place, at_journal) + cross(crank_pin - place, at_crank)
    inertial = INERTIA["rod"] * run.item("bodies/angular_acceleration", "rod")
    assert_close(moment, inertial, absolute=1e-9 * 0.06 * peak, what="moments on the rod")


def test_crank_is_driven(run):
    """The motor's moment balances the force of the rod on the crank pin: the crank turns uniformly."""
    _, crank_pin = pin(run)
    at_pin = run.item("joints/force", "big_end")
    moment = run.item("drivers/moment", "motor")
    peak = np.abs(moment).max()
    assert_close(moment, -cross(crank_pin, at_pin), absolute=1e-8 * peak, what="moment of the motor")
    at_main = -run.item("joints/force", "main")  # recorded: on the ground
    inertial = MASS["crank"] * run.item("bodies/acceleration", "crank")
    scale = np.abs(at_pin).max()
    assert_close(at_pin + at_main, inertial, absolute=1e-9 * scale, what="forces on the crank")
