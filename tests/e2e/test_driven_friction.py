"""Coulomb friction of contacts whose sliding drivers prescribe, against mu F_N opposite to sliding over the whole run."""

import math

import numpy as np
import pytest
from support import Run, assert_close, call, scratch, written

MU = 0.2
REST = """
[material]
name young[GPa] poisson
steel 207 0.3
[contact.hertz]
name
normal
[friction.coulomb]
name coefficient static_coefficient
rough 0.2 {static}
[analysis.dynamic]
start = given
overlap = preload
end = {end}
tolerance = {tolerance}
{settings}
[output]
every = {every}
"""


def finished(program, model, *options, static=0.2, end="10 s", every="10 ms", tolerance="1e-11", settings=""):
    """A run of a model with the tables that all share."""
    directory = scratch()
    rest = REST.format(static=static, end=end, every=every, tolerance=tolerance, settings=settings)
    deck = written(directory, "deck = 1\n" + model + rest)
    call(program, "run", deck, "--out", directory / "out", "--quiet", *options)
    return Run(directory / "out")


def column(run, name, quantity, contact=""):
    """A column of a joint's .dat file."""
    names, rows = run.table(f"{name}.dat")
    place = next(k for k, head in enumerate(names) if quantity in head and contact in head)
    return np.array([float(row[place]) for row in rows])


def assert_opposite(run, velocity, contact="", name="f", sign=1.0, still=1e-9):
    """Friction is mu F_N against the velocity, at every instant at which there is one."""
    t = column(run, name, "time")
    v = np.array([velocity(x) for x in t])
    moves = np.abs(v) > still * np.max(np.abs(v))
    assert moves.sum() > 0.9 * len(t)
    normal = column(run, name, "normal_force", contact)
    assert normal.min() > 0.0
    friction = column(run, name, "friction_force", contact)
    assert_close(friction[moves], -sign * MU * (normal * np.sign(v))[moves], relative=1e-12, what="friction")


def slips(run):
    """Times of the events of friction."""
    names, rows = run.table("events.dat")
    return [float(row[names.index("time")]) for row in rows if row[names.index("kind")] in ("slip", "stick")]


def on_plane(position, tilt=0.0, shift=(0.0, 0.0)):
    """A ball led along a plane into which it is pressed by 10 um."""
    x, y = shift
    across = 0.09999
    return f"""[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]
p 1 0.01 {x - across * math.sin(tilt)!r} {y + across * math.cos(tilt)!r} -
[points]
name body xi[m] eta[m]
o ground {x!r} {y!r}
h ground {x - across * math.sin(tilt)!r} {y + across * math.cos(tilt)!r}
c p 0 0
[joint.translational]
name i j axis axis_angle[rad]
t h c x {tilt!r}
[driver.position]
name i j axis axis_angle[rad] position
d h c x {tilt!r} {{{position}}}
[clearance.plane]
name plane ball axis axis_angle[rad] radius[m] material law friction
f o c y {tilt!r} 0.1 steel normal rough
"""


METHODS = [("verner",), ("dop853",), ("rock4",), ("radau",), ("rk4", "step = 2 ms"), ("adams",), ("bdf",), ("ida",)]


@pytest.mark.parametrize("method", METHODS, ids=[m[0] for m in METHODS])
@pytest.mark.parametrize("amplitude, accuracy", [(1e-4, 1e-8), (2e-6, 1e-6), (1e-9, 1e-3)])
def test_slow_reversals(gudgeon, method, amplitude, accuracy):
    """Slow and slower: the friction turns where the driver does, at times known, by every method. A ball pressed into a plane has
    speeds of 1e-13 m/s from the last digits of its place: works and multistep states of slower motions are no better than that."""
    settings = "\n".join(("method = " + method[0],) + method[1:])
    run = finished(gudgeon, on_plane(f"{amplitude!r} m*sin(0.5rad/s*t)"), settings=settings)
    assert_opposite(run, lambda t: math.cos(0.5 * t))
    times = slips(run)
    assert len(times) == 2
    assert_close(times, [math.pi, 3.0 * math.pi], absolute=1e-13 if method[0] in ("verner", "dop853", "rk4") else 0.1 * accuracy, what="reversals")
    lost = column(run, "energy", "dissipated_friction")[-1]
    way = 3.0 * amplitude + amplitude * (math.sin(5.0) + 1.0)
    assert_close(lost, MU * column(run, "f", "normal_force")[0] * way, relative=accuracy, what="energy lost")


@pytest.mark.parametrize("static", [0.2, 0.4])
@pytest.mark.parametrize("coordinates", ["fewest", "full"])
def test_tilted_and_shifted(gudgeon, static, coordinates):
    """Anywhere, at any slope; a greater coefficient of sticking changes nothing where nothing can stick."""
    run = finished(
        gudgeon, on_plane("1e-4m*sin(0.5rad/s*t)", 0.7, (3.0, -2.0)), static=static, settings=f"coordinates = {coordinates}"
    )
    assert_opposite(run, lambda t: math.cos(0.5 * t))


def test_dwell(gudgeon):
    """At rest friction is any force between its limits, and none is given; from the first motion to the last it is mu F_N."""
    s = "(min(max(t - 1s, 0s), 2s)/2s)"
    run = finished(gudgeon, on_plane(f"1e-5m*{s}^3*(10 - 15*{s} + 6*{s}^2)"), end="4 s", settings="maximum_step = 50 ms")
    t = column(run, "f", "time")
    friction = column(run, "f", "friction_force")
    moves = (t > 1.001) & (t < 2.999)
    rests = (t <= 1.0) | (t >= 3.001)
    assert_close(friction[moves], -MU * column(run, "f", "normal_force")[moves], relative=1e-12, what="moving")
    assert_close(friction[rests], 0.0, what="at rest")


@pytest.mark.parametrize("coordinates", ["fewest", "full"])
def test_pressed_by_its_weight(gudgeon, coordinates):
    """A ball that a carriage leads along the plane, free to rise: its normal force is its weight."""
    depth = (9.81 / 1e9) ** (2.0 / 3.0)
    model = f"""[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
carriage 1 0.01 0 0.5
p 1 0.01 0 {0.1 - depth!r}
[points]
name body xi[m] eta[m]
o ground 0 0
h ground 0 0.5
q carriage 0 0
c p 0 0
[joint.translational]
name i j axis
t h q x
u q c y
[driver.position]
name i j axis position
d h q x {{1e-4m*sin(0.5rad/s*t)}}
[clearance.plane]
name plane ball axis radius[m] material law friction
f o c y 0.1 steel stiff rough
[contact.exact]
name restitution stiffness[N/m^1.5]
stiff 0.5 1e9
"""
    run = finished(gudgeon, model, settings=f"coordinates = {coordinates}")
    assert_opposite(run, lambda t: math.cos(0.5 * t))
    assert_close(column(run, "f", "normal_force"), 9.81, relative=1e-6, what="weight")


def test_moving_plane(gudgeon):
    """A plane that runs under a ball that stands, and under one that runs as well."""
    model = """[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
belt 1 0.01 0 0
p 1 0.01 0 0.09999
[points]
name body xi[m] eta[m]
h ground 0 0
k ground 0 0.09999
o belt 0 0
c p 0 0
[joint.translational]
name i j axis
t h o x
u k c x
[driver.position]
name i j axis position
d h o x {1e-4m*sin(0.5rad/s*t)}
e k c x {POSITION}
[clearance.plane]
name plane ball axis radius[m] material law friction
f o c y 0.1 steel normal rough
"""
    run = finished(gudgeon, model.replace("POSITION", "0m"))
    assert_opposite(run, lambda t: -math.cos(0.5 * t))
    run = finished(gudgeon, model.replace("POSITION", "1e-4m*sin(0.8rad/s*t)"))
    assert_opposite(run, lambda t: 0.8 * math.cos(0.8 * t) - 0.5 * math.cos(0.5 * t), still=1e-7)


@pytest.mark.parametrize("amplitude", [1e-3, 1e-7])
def test_loose_revolute(gudgeon, amplitude):
    """A journal that is turned to and fro where it lies, 10 um into its bearing."""
    model = f"""[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
p 1 0.01 0 -0.00011
[points]
name body xi[m] eta[m]
o ground 0 0
h ground 0 -0.00011
c p 0 0
[joint.revolute]
name i j
pin h c
[driver.angle]
name joint angle
d pin {{{amplitude!r} rad*sin(0.5rad/s*t)}}
[clearance.revolute]
name bearing journal bearing_radius[m] clearance[m] material law friction
f o c 0.02 1e-4 steel normal rough
"""
    run = finished(gudgeon, model)
    assert_opposite(run, lambda t: math.cos(0.5 * t))
    assert_close(slips(run), [math.pi, 3.0 * math.pi], absolute=1e-12, what="reversals")


def test_loose_guide(gudgeon):
    """A slider led along its guide, both lower corners pressed in by 10 um."""
    model = """[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
p 1 0.01 0 -0.00011
[points]
name body xi[m] eta[m]
o ground 0 0
h ground 0 -0.00011
c p 0 0
[joint.translational]
name i j axis
t h c x
[driver.position]
name i j axis position
d h c x {1e-4m*sin(0.5rad/s*t)}
[clearance.translational]
name guide slider axis length[m] height[m] gap[m] corner_radius[m] material law friction
f o c x 0.1 0.05 1e-4 0.001 steel normal rough
"""
    run = finished(gudgeon, model)
    for corner in ("A_lower", "B_lower"):
        assert_opposite(run, lambda t: math.cos(0.5 * t), corner)


def test_plate_between_jaws(gudgeon):
    """A plate between two jaws that run apart and back as slowly: it follows neither, and both rub with mu F_N all the time."""
    depth = 1e-5
    model = f"""[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
lower 1 0.01 0 0
upper 1 0.01 0 {0.2 - 2.0 * depth!r}
p 1 0.01 0 {0.1 - depth!r}
[points]
name body xi[m] eta[m]
h ground 0 0
k ground 0 {0.2 - 2.0 * depth!r}
g ground 0 {0.1 - depth!r}
o lower 0 0
u upper 0 0
c p 0 0
[joint.translational]
name i j axis
t h o x
s k u x
r g c x
[driver.position]
name i j axis position
d h o x {{1e-4m*sin(0.5rad/s*t)}}
e k u x {{-1e-4m*sin(0.5rad/s*t)}}
[clearance.plane]
name plane ball axis axis_angle[deg] radius[m] material law friction
f o c y 0 0.1 steel normal rough
b u c y 180 0.1 steel normal rough
"""
    run = finished(gudgeon, model, tolerance="1e-13")
    assert_opposite(run, lambda t: -math.cos(0.5 * t), name="f")
    assert_opposite(run, lambda t: math.cos(0.5 * t), name="b", sign=-1.0)
    assert_close(column(run, "p", "position.x"), 0.0, absolute=1e-11, what="the plate")
