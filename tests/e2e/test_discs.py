"""clearance.discs against Hertz's closed forms, momentum, and Coulomb's impulses; a disc beside a disc as a disc in a hole."""

import math

import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, changed, scratch, written

RADIUS, MASS, INERTIA, SPEED = 0.0286, 0.17, 5.56e-5, 2.0
YOUNG, POISSON = 207e9, 0.3


def shot(program, *settings, text=None, **analysis):
    """Run the billiard deck."""
    directory = scratch()
    text = text or (ROOT / "inputs/billiards.deck").read_text()
    words = [word for setting in settings for word in ("--set", setting)]
    call(program, "run", written(directory, changed(text, "analysis.dynamic", **analysis)), "--out", directory / "out", "--quiet",
         "--write", "channels", *words)
    return Run(directory / "out")


@pytest.mark.parametrize("method", ["verner", "rk4", "adams", "bdf", "ida"])
def test_head_on(gudgeon, method):
    """Equal elastic balls exchange their velocities; onset, peak force and duration are Hertz's."""
    text = (ROOT / "inputs/billiards.deck").read_text().replace("{-r}      0", "0         0")
    step = {"step": "1e-7 s", "end": "60 ms"} if method == "rk4" else {}
    run = shot(gudgeon, "law=hertz", "friction=0", text=text, method=method, **step)
    (contact,) = run.contacts
    assert_close(contact["time"], (0.15 - 2 * RADIUS) / SPEED, absolute=1e-8, what="onset")
    assert_close(contact["impact_speed"], SPEED, absolute=1e-7, what="impact speed")
    stiffness = 4 / (3 * 2 * (1 - POISSON**2) / YOUNG) * math.sqrt(RADIUS / 2)
    deepest = (5 / 4 * (MASS / 2) * SPEED**2 / stiffness) ** 0.4
    assert_close(contact["peak_force"], stiffness * deepest**1.5, absolute=1e-6 * contact["peak_force"], what="peak force")
    assert_close(contact["duration"], 2.9432751 * deepest / SPEED, absolute=1e-6 * contact["duration"], what="duration")
    for name, speed in (("cue", 0.0), ("object", SPEED)):
        assert_close(run.item("bodies/velocity", name)[-1], [speed, 0.0], absolute=1e-7 * SPEED, what=name)


@pytest.mark.parametrize("friction", [0.0, 0.06])
def test_half_ball(gudgeon, friction):
    """The line of centres is 30 degrees off; the sideways impulse is friction times the normal one, and both balls take the same spin."""
    run = shot(gudgeon, f"friction={friction}")
    (contact,) = run.contacts
    cosine = math.sqrt(3) / 2
    assert_close(contact["impact_speed"], SPEED * cosine, absolute=1e-9, what="impact speed")
    normal, across = np.array([cosine, -0.5]), np.array([0.5, cosine])
    cue, target = run.item("bodies/velocity", "cue")[-1], run.item("bodies/velocity", "object")[-1]
    assert_close(cue + target, [SPEED, 0.0], absolute=1e-12, what="momentum")
    impulse = MASS * target @ normal
    assert 0.97 * MASS * SPEED * cosine < impulse < 0.98 * MASS * SPEED * cosine  # (1 + 0.95)/2 of what both share
    turned = SPEED / 2 * contact["duration"] / (2 * RADIUS)  # of the line of centres, while they touch
    assert 1e-3 < turned < 2e-3
    assert_close(MASS * target @ across, friction * impulse, absolute=turned * impulse, what="impulse of friction")
    spins = [run.item("bodies/angular_velocity", name)[-1] for name in ("cue", "object")]
    assert_close(spins, [-friction * impulse * RADIUS / INERTIA] * 2, absolute=1e-3 * impulse * RADIUS / INERTIA, what="spins")
    assert abs(run.summary["energy_residual_max"]) < 1e-8 * run.summary["energy_max"]


def test_balls_that_begin_one_in_another(gudgeon):
    """They are refused, as any overlap is."""
    text = (ROOT / "inputs/billiards.deck").read_text().replace("-150      0 ", "-30       0 ")
    directory = scratch()
    done = call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", expect=4)
    assert "click" in done.stderr and "overlap" in done.stderr
