"""Static equilibrium where no weight acts: residuals are measured by the forces that act, not by their sum."""

import sys

import numpy as np
import pytest
from scipy.optimize import brentq
from support import ROOT, Run, assert_close, call, scratch, written

sys.path.insert(0, str(ROOT / "tests" / "stability"))
import random_statics  # noqa: E402

EACH = 3  # scenes of a kind; `make stability` tries 200
STIFFNESS, HIGH, FREE = 1e4, 0.2, np.hypot(1.0, 0.2)

ARCH = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
w 1 1e-2 0 0.2
[points]
name body xi[m] eta[m]
l ground -1 0
r ground 1 0
o ground 0 0
c w 0 0
[joint.translational]
name i j axis
rail o c y
[force.spring]
name i j stiffness[N/m] free_length
s1 l c 1e4 {sqrt(1m^2+(0.2m)^2)}
s2 r c 1e4 {sqrt(1m^2+(0.2m)^2)}
[force.point]
name point fy
load c LOAD
"""


def run(gudgeon, text, **options):
    """Run a deck given as text."""
    directory = scratch()
    return Run(directory / "out", call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", **options))


def pull(y):
    """Force of both springs on the arch, upwards."""
    length = np.hypot(1.0, y)
    return -2.0 * STIFFNESS * (length - FREE) * y / length


@pytest.mark.parametrize("load, low, high", [(1.0, 0.15, 0.2), (20.0, 0.13, 0.2), (50.0, -0.4, -0.2), (1e-6, 0.19, 0.2)])
def test_arch_under_a_force(gudgeon, load, low, high):
    """An arch of two springs under a force alone, below and above the load at which it snaps through."""
    result = run(gudgeon, ARCH.replace("LOAD", f"{-load}N") + "[analysis.static]\n")
    expected = brentq(lambda y: pull(y) - load, low, high, xtol=1e-15)
    assert_close(result.item("bodies/position", "w")[0, 1], expected, absolute=1e-12, what="height")
    assert "stable" in result.summary["equilibrium"]


def test_start_at_rest(gudgeon):
    """A motion begins there and stays there."""
    result = run(gudgeon, ARCH.replace("LOAD", "-20N") + "[analysis.dynamic]\nstart = static\nend = 1 s\n[output]\nchannels = *\n")
    expected = brentq(lambda y: pull(y) - 20.0, 0.13, 0.2, xtol=1e-15)
    assert_close(result.item("bodies/position", "w")[:, 1], expected, absolute=1e-10, what="height")


FILM = """deck = 1
[scene]
gravity = 0 GRAVITY m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
shaft 1 1e-3 0 0
journal 53.5168 1e-3 0 0
[points]
name body xi[m] eta[m]
housing ground 0 0
axis shaft 0 0
centre journal 0 0
[joint.revolute]
name i j
main housing axis
[joint.parallel]
name i j
coupling shaft journal
[driver.speed]
name joint speed
motor main 157.1rad/s
[force.point]
name point fy
load centre FORCE
[clearance.revolute]
name bearing journal bearing_radius[mm] clearance length[mm] level film lubricant
bearing housing centre 50.1 0.1mm 30 lubricated film oil
[lubricant]
name viscosity
oil 0.1Pa.s
[film.short_gumbel]
name
film
[analysis.static]
tolerance = 1e-12
"""


def test_whirl_under_a_force(gudgeon):
    """A force in place of the weight: the same equilibrium, eigenvalues and onset of whirl."""
    by_force = run(gudgeon, FILM.replace("GRAVITY", "0").replace("FORCE", "-525N"))
    by_weight = run(gudgeon, FILM.replace("GRAVITY", repr(-525.0 / 53.5168)).replace("FORCE", "0N"))
    for name in ("position",):
        assert_close(by_force.item(f"bodies/{name}", "journal"), by_weight.item(f"bodies/{name}", "journal"), absolute=1e-14, what=name)
    ours, theirs = (run.summary["small_motions"]["onset"] for run in (by_force, by_weight))
    assert theirs > 1.0
    assert_close(ours, theirs, relative=1e-7, what="onset of whirl")


@pytest.mark.parametrize("kind", random_statics.KINDS)
def test_random_scenes(gudgeon, kind):
    """Springs, contacts and films in the plane and in space: forces balance to 1e-10 of their magnitudes, or to the last digits."""
    for seed in range(EACH):
        mistakes = random_statics.mistakes_of(gudgeon, kind, seed, scratch())
        assert not mistakes, f"{kind} {seed}: {'; '.join(mistakes)}"
