"""Periodic orbits of exact impact maps, extrapolated in the stiffness: a ball on a shaking table, a mass between walls."""

import math

import pytest
from support import ROOT, Run, assert_close, call, scratch

STIFFNESS = (1e9, 32e9, 1024e9)  # N/m^1.5; the time of a contact goes with the power -0.4: a quarter each


def last_impact(program, deck, joint, stiffness, *sets):
    """Time and speed of the last but one impact of a joint."""
    directory = scratch()
    options = [word for name in sets for word in ("--set", name)]
    call(program, "run", ROOT / "inputs" / f"{deck}.deck", "--out", directory / "out", "--quiet", "--write", "channels",
         "--tolerance", "1e-12", "--set", f"stiffness={stiffness:.17g} N/m^1.5", *options)
    contacts = Run(directory / "out").contacts
    row = contacts[[name.decode().strip() == joint for name in contacts["item"]]][-2]
    return float(row["time"]), float(row["impact_speed"])


def extrapolated(values):
    """The limit of values whose error is a series in a quantity that is a quarter in each next one."""
    factor = 4
    while len(values) > 1:
        values = [(factor * b - a) / (factor - 1) for a, b in zip(values, values[1:])]
        factor *= 4
    return values[0]


@pytest.mark.parametrize("e, a", [(0.8, 0.2), (0.5, 0.5)])
def test_impact_pair(gudgeon, e, a):
    """Phase and speed of the symmetric orbit: closed forms."""
    alpha = (1 + e) / (1 - e)
    phi = math.atan2(2, alpha * math.pi) + math.acos(-2 / (a * math.sqrt(4 + (alpha * math.pi)**2)))
    phases, speeds = [], []
    for stiffness in STIFFNESS:
        time, speed = last_impact(gudgeon, "impact_pair", "high", stiffness, f"e={e}", f"amplitude={a} m")
        phases.append(math.remainder(time + math.atan2(2, alpha * math.pi) + math.pi / 2, 2 * math.pi))
        speeds.append(speed)
    assert abs(phases[0] - phi) > 1e-6, "a finite stiffness is seen"
    assert_close(extrapolated(phases), phi, absolute=1e-7, what="phase")
    assert_close(extrapolated(speeds), -(alpha + 1) * a * math.cos(phi), relative=1e-7, what="speed against the wall")


def test_shaken_ball(gudgeon):
    """Phase and speed of the orbit of one impact a period: closed forms."""
    e, gamma, g, w = 0.5, 1.2, 9.81, 100
    phi = math.acos(math.pi * (1 - e) / ((1 + e) * gamma))
    impacts = [last_impact(gudgeon, "shaken_ball", "impact", stiffness) for stiffness in STIFFNESS]
    phases = [math.remainder(w * time - math.pi / 2, 2 * math.pi) for time, _ in impacts]
    speeds = [speed for _, speed in impacts]
    assert_close(extrapolated(phases), phi, absolute=1e-6, what="phase")
    speed = g * math.pi / w + gamma * g / w * math.cos(phi)
    assert_close(extrapolated(speeds), speed, relative=1e-6, what="speed against the table")
