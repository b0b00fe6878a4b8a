"""The restitution that two free bodies show, at every speed, for balls of 1 kg and 1 g, against closed forms."""

import math

import pytest
from support import Run, call, scratch, written

YOUNG, POISSON = 207e9, 0.3

DECK = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s] vy[m/s]
p {mass!r} {inertia!r} {x!r} {y!r} {vx!r} {vy!r}
[points]
name body xi[m] eta[m]
c p 0 0
r ground {wall_x!r} {wall_y!r}
[material]
name young[GPa] poisson
steel 207 0.3
[clearance.plane]
name plane ball axis axis_angle[rad] radius[m] material law
b r c x {angle!r} {radius!r} steel law
{law}
[analysis.dynamic]
start = given
end = {end!r} s
method = {method}
tolerance = {tolerance}
[output]
every = {end!r} s
"""


def shown(program, law, speed, mass, radius, method="verner", tolerance=1e-12, tilt=0.0, contact=None):
    """Restitution of a ball that flies against a wall, and the time that it touches."""
    stiffness = 4.0 / 3.0 * YOUNG / (1.0 - POISSON**2) / 2.0 * math.sqrt(radius)
    time = contact or 3.218 * (mass**2 / (stiffness**2 * speed)) ** 0.2
    way = radius + 2.0 * speed * time
    c, s = math.cos(tilt), math.sin(tilt)
    text = DECK.format(
        mass=mass,
        inertia=0.4 * mass * radius**2,
        x=-way * c,
        y=-way * s,
        vx=speed * c,
        vy=speed * s,
        wall_x=0.0,
        wall_y=0.0,
        angle=math.pi + tilt,
        radius=radius,
        law=law,
        end=12.0 * time,
        method=method,
        tolerance=tolerance,
    )
    directory = scratch()
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    (row,) = run.contacts
    assert row["impact_speed"] == pytest.approx(speed, rel=1e-12)
    return row["release_speed"] / row["impact_speed"], row["duration"]


BALLS = [(1.0, 0.1), (1e-3, 1e-3)]


@pytest.mark.parametrize("mass, radius", BALLS, ids=["1 kg", "1 g"])
@pytest.mark.parametrize("restitution", [0.01, 0.1, 0.5, 0.9, 0.99])
@pytest.mark.parametrize("tilt", [0.0, 0.7])
def test_exact(gudgeon, mass, radius, restitution, tilt):
    """contact.exact delivers what it is asked for, from 1 um/s to 10 m/s."""
    law = f"[contact.exact]\nname restitution\nlaw {restitution}"
    for speed in (1e-6, 1e-4, 1e-2, 1.0, 10.0):
        e, _ = shown(gudgeon, law, speed, mass, radius, tilt=tilt)
        assert e == pytest.approx(restitution, abs=1e-6), f"at {speed} m/s"


@pytest.mark.parametrize("mass, radius", BALLS, ids=["1 kg", "1 g"])
@pytest.mark.parametrize("method", ["adams", "bdf", "ida"])
def test_exact_by_multistep_methods(gudgeon, method, mass, radius):
    """The methods of SUNDIALS too, at their best tolerance."""
    for speed in (1e-6, 1e-3, 1.0):
        e, _ = shown(gudgeon, "[contact.exact]\nname restitution\nlaw 0.5", speed, mass, radius, method)
        assert e == pytest.approx(0.5, abs=1e-6), f"at {speed} m/s"


def test_default_tolerance(gudgeon):
    """What the default tolerance gives does not get worse as bodies get slower."""
    for speed in (1e-6, 1e-3, 1.0):
        e, _ = shown(gudgeon, "[contact.exact]\nname restitution\nlaw 0.5", speed, 1.0, 0.1, tolerance=1e-8)
        assert e == pytest.approx(0.5, abs=1e-4), f"at {speed} m/s"


def hunt_crossley_shown(h):
    """e of F = K delta^n (1 + h rate/v0): h(1 + e) = ln[(1 + h)/(1 - h e)], by bisection."""
    low, high = 1e-9, 1.0
    for _ in range(200):
        e = 0.5 * (low + high)
        if h * e < 1.0 and h * (1.0 + e) > math.log((1.0 + h) / (1.0 - h * e)):
            low = e
        else:
            high = e
    return e


@pytest.mark.parametrize(
    "kind, h",
    [("lankarani_nikravesh", lambda ce: 0.75 * (1 - ce**2)), ("hunt_crossley", lambda ce: 1.5 * (1 - ce))],
    ids=["lankarani_nikravesh", "hunt_crossley"],
)
def test_hysteresis_laws(gudgeon, kind, h):
    """Laws with another damping factor show what their integral says, at every speed."""
    for ce in (0.5, 0.9):
        for speed in (1e-6, 1e-3, 1.0):
            e, _ = shown(gudgeon, f"[contact.{kind}]\nname restitution\nlaw {ce}", speed, 1.0, 0.1)
            assert e == pytest.approx(hunt_crossley_shown(h(ce)), abs=1e-6), f"{kind} {ce} at {speed} m/s"


def test_kelvin_voigt(gudgeon):
    """A linear spring shows the same restitution and lasts as long at every speed: pi/2 sqrt(m/K) each way, the second 1/ce longer."""
    stiffness, ce = 1e8, 0.5
    law = f"[contact.kelvin_voigt]\nname stiffness[N/m] restitution form\nlaw {stiffness} {ce} squared"
    half = 0.5 * math.pi * math.sqrt(1.0 / stiffness)
    for speed in (1e-6, 1e-3, 1.0):
        e, time = shown(gudgeon, law, speed, 1.0, 0.1, contact=2.0 * half)
        assert e == pytest.approx(ce, abs=1e-6), f"at {speed} m/s"
        assert time == pytest.approx(half * (1.0 + 1.0 / ce), rel=1e-6), f"at {speed} m/s"


def test_explain_tells_what_is_small(gudgeon):
    """What counts as nothing is printed, in proportion to the speed of the mechanism."""

    def said(speed):
        text = DECK.format(mass=1.0, inertia=0.004, x=-0.2, y=0.0, vx=speed, vy=0.0, wall_x=0.0, wall_y=0.0, angle=math.pi,
                           radius=0.1, law="[contact.exact]\nname restitution\nlaw 0.5", end=1.0, method="verner", tolerance=1e-8)
        text = text.replace("radius[m] material law\n", "radius[m] material law friction\n").replace("steel law\n", "steel law dry\n")
        text = text.replace("[analysis.dynamic]", "[friction.coulomb]\nname coefficient\ndry 0.1\n[analysis.dynamic]")
        lines = call(gudgeon, "explain", written(scratch(), text)).stdout.splitlines()
        lines = lines[lines.index("numerical thresholds") :]
        return {line.split(":")[0].strip(): float(line.split(":")[1].split()[0]) for line in lines if " m/s (" in line}

    slow, fast = said(1e-3), said(1.0)
    of_run = [name for name in fast if "never moves" in name or "from rest" in name]
    assert len(of_run) == 2 and len(fast) >= 7
    for name in fast:
        assert fast[name] == pytest.approx(slow[name] * (1.0 if name in of_run else 1e3), rel=1e-2), name
