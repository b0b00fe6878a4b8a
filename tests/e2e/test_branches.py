"""Joints of space through their whole range: rows hold on one branch, and where an angle has no value a run ends with code 5 and says so."""

import subprocess

import numpy as np
import pytest
from support import assert_close, run_with, scratch, written

HEAD = """deck = 1
[scene]
space = spatial
[bodies]
name  mass[kg]  ixx[kg.m^2]  iyy[kg.m^2]  izz[kg.m^2]  x[m]  y[m]  z[m]  vx[m/s]  vy[m/s]  vz[m/s]  wx[rad/s]  wy[rad/s]  wz[rad/s]
b     1         2            {iyy}        4            {x}   0     0     {v}      {w}
[points]
name  body    xi[m]
o     ground  0
p     b       {xi}
"""
TAIL = """
[analysis.dynamic]
end = {end} s
tolerance = 1e-10
[output]
every = 0.01 s
channels = *
"""


def rotations(rows):
    """(n, 3, 3) Rotation matrices of Euler parameters."""
    e = rows / np.linalg.norm(rows, axis=1)[:, None]
    w, x, y, z = e.T
    return np.moveaxis(np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]), 2, 0)


def free_on_constant_velocity(inertia, spin, times, h=1e-3):
    """Euler parameters of a body that a joint of e_3 = 0 holds at its centre of mass, without loads: Euler's equations with the moment
    that keeps n . w = 2 e_3' = 0, n = (-e_2, e_1, e_0) in the body, by the classical method of Runge and Kutta."""
    def rate(state):
        e, w = state[:4], state[4:]
        n = np.array([-e[2], e[1], e[0]])
        e_rate = 0.5 * np.array([-e[1] * w[0] - e[2] * w[1] - e[3] * w[2], e[0] * w[0] + e[2] * w[2] - e[3] * w[1],
                                 e[0] * w[1] - e[1] * w[2] + e[3] * w[0], e[0] * w[2] + e[1] * w[1] - e[2] * w[0]])
        n_rate = np.array([-e_rate[2], e_rate[1], e_rate[0]])
        free = -np.cross(w, inertia * w) / inertia
        return np.concatenate([e_rate, free - (n @ free + n_rate @ w) / (n @ (n / inertia)) * n / inertia])

    state, found = np.concatenate([[1, 0, 0, 0], spin]), []
    for t0, t1 in zip(np.concatenate([[0], times[:-1]]), times, strict=True):
        steps = max(1, round((t1 - t0) / h))
        for _ in range(steps if t1 > t0 else 0):
            d = (t1 - t0) / steps
            k1 = rate(state)
            k2 = rate(state + d / 2 * k1)
            k3 = rate(state + d / 2 * k2)
            k4 = rate(state + d * k3)
            state = state + d / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        found.append(state[:4])
    return np.array(found)


def constant_velocity(iyy, end):
    """A body on the joint at its centre of mass, that bends through half a turn."""
    return (HEAD.format(iyy=iyy, x=0, xi=0, v="0 0 0", w="6 1 0")
            + '[joint.constant_velocity]\nname i j axis_i axis_j\ncv o p "0 0 1" "0 0 1"\n' + TAIL.format(end=end))


@pytest.mark.parametrize("settings", [{}, {"stabilise": "partitioning"}, {"stabilise": "baumgarte alpha=5s^-1 beta=5s^-1"},
                                      {"method": "ida"}, {"method": "bdf"}, {"method": "radau"}], ids=str)
def test_bend_beyond_half_a_turn(gudgeon, settings):
    """A bend through 180 degrees and on: the shafts still turn together. With two equal moments of inertia the axis of the bend stays."""
    run = run_with(gudgeon, constant_velocity(3, 1.2), **settings)
    e = run.item("bodies/orientation", "b")
    wanted = free_on_constant_velocity(np.array([2.0, 3.0, 4.0]), np.array([6.0, 1.0, 0.0]), run.time)
    close = 1e-5 if settings else 1e-7
    assert_close(rotations(e), rotations(wanted), absolute=close, what="orientation")
    assert_close(e[:, 3], 0 * run.time, absolute=close, what="e_3")
    assert wanted[:, 0].min() < -0.9, "beyond half a turn"
    run = run_with(gudgeon, constant_velocity(2, 1.2), **settings)
    bend = np.sqrt(37) * run.time
    assert_close(run.item("joints/bend", "cv").ravel(), abs((bend + np.pi) % (2 * np.pi) - np.pi), absolute=10 * close, what="bend")


# kind, columns, its row, where the body begins, its velocities; what its rows hold, of rotations R and places r of the point: nothing left
AXES = ("i j axis_i axis_j", 'o p "0 0 1" "0 0 1"')
SWEEPS = {
    "spherical": (("i j", "o p"), 0, "0 0 0", "5 4 3", lambda R, r: r),
    "revolute": (AXES, 0, "0 0 0", "0 0 7", lambda R, r: np.hstack([r, R[:, :2, 2]])),
    "cylindrical": (AXES, 0, "0 0 1", "0 0 7", lambda R, r: np.hstack([r[:, :2], R[:, :2, 2]])),
    "screw": (("i j axis_i axis_j pitch[mm]", 'o p "0 0 1" "0 0 1" 20'), 0, f"0 0 {0.14 / (2 * np.pi)!r}", "0 0 7", lambda R, r: np.hstack(
        [r[:, :2], R[:, :2, 2], (r[:, 2:] - 0.02 / (2 * np.pi) * np.unwrap(np.arctan2(R[:, 1, 0], R[:, 0, 0]))[:, None])])),
    "screw of a fine pitch": (("i j axis_i axis_j pitch[um]", 'o p "0 0 1" "0 0 1" 0.1'), 0, f"0 0 {7e-7 / (2 * np.pi)!r}", "0 0 7", lambda R, r: np.hstack(
        [r[:, :2], R[:, :2, 2], (r[:, 2:]*1e5 - 0.01 / (2 * np.pi) * np.unwrap(np.arctan2(R[:, 1, 0], R[:, 0, 0]))[:, None])])),
    "universal": (("i j axis_i axis_j", 'o p "1 0 0" "0 1 0"'), 0, "0 0 0", "6 5 0", lambda R, r: np.hstack([r, R[:, :1, 1]])),
    "perpendicular": (("i j axis_i axis_j", 'o p "1 0 0" "0 1 0"'), 0, "1 2 3", "6 5 0", lambda R, r: R[:, :1, 1]),
    "parallel_axes": (AXES, 0, "1 2 3", "0 0 7", lambda R, r: R[:, :2, 2]),
    "planar": (AXES, 0, "1 2 0", "0 0 7", lambda R, r: np.hstack([r[:, 2:], R[:, :2, 2]])),
    "inplane": (("i j axis_i", 'o p "0 0 1"'), 0, "1 2 0", "5 4 3", lambda R, r: r[:, 2:]),
    "inline": (("i j axis_i", 'o p "0 0 1"'), 0, "0 0 1", "5 4 3", lambda R, r: r[:, :2]),
    "orientation": (("i j", "o p"), 0, "1 2 3", "0 0 0", lambda R, r: (R - np.eye(3)).reshape(len(R), 9)),
    "distance": (("i j length[m]", "o p 1"), 1, "0 3 4", "5 4 3", lambda R, r: np.linalg.norm(r, axis=1)[:, None] - 1),
    "revolute_spherical": (("i j axis_i length[m]", 'o p "0 0 1" 1'), 1, "0 5 0", "5 4 3",
                           lambda R, r: np.stack([r[:, 2], np.linalg.norm(r, axis=1) - 1], 1)),
}


@pytest.mark.parametrize("kind", SWEEPS)
def test_whole_range(gudgeon, kind):
    """A body that nothing drives, through turns and more of what its joint leaves: its rows hold as geometry says, and the energy stays."""
    columns, x, v, w, left = SWEEPS[kind]
    text = HEAD.format(iyy=3, x=x, xi=0, v=v, w=w) + f"[joint.{kind.split()[0]}]\nname {columns[0]}\njoint {columns[1]}\n" + TAIL.format(end=3)
    run = run_with(gudgeon, text)
    assert run.summary["status"] == "complete" and run.summary["warnings"] == []
    turns, r = rotations(run.item("bodies/orientation", "b")), run.item("bodies/position", "b")
    assert_close(left(turns, r), 0 * left(turns, r), absolute=1e-8, what="what the joint holds")
    kinetic = run.read("energy/kinetic").ravel()
    assert_close(kinetic, kinetic[0] + 0 * kinetic, relative=1e-8, what="energy")
    if kind != "orientation":
        assert np.trace(turns, axis1=1, axis2=2).min() < -0.9, "half a turn at least"


PLANE = """deck = 1
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  angle[deg]  omega[rad/s]  vy[m/s]
sun    1         0.3              0     0           2             0
arm    1         0.1              0     0           5             0
wheel  1         0.2              0.3   0           {spin}        1.5
[points]
name   body    xi[m]
o      ground  0
s      sun     0
a      arm     0
tip    arm     0.3
w      wheel   0
[joint.revolute]
name   i    j
post   o    s
hinge  o    a
spin   tip  w
"""
# kind, columns, row; the wheel's speed at which the row holds with 2 rad/s of the sun and 5 rad/s of the arm; the row's angle of sun, arm and wheel
PLANAR_SWEEPS = {
    "gear": (("i j radius_i[m] radius_j[m]", "s w 0.1 0.2"), 6.5, (0.1, -0.3, 0.2)),
    "gear with a ring": (("i j radius_i[m] radius_j[m]", "s w 0.5 -0.2"), -2.5, (0.5, -0.3, -0.2)),
    "gear in a ring": (("i j radius_i[m] radius_j[m]", "s w -2.7 3"), 2.3, (-2.7, -0.3, 3)),
    "belt": (("i j radius_i[m] radius_j[m]", "s w 0.1 0.05"), -1, (0.1, -0.05, -0.05)),
    "belt with a cross": (("i j radius_i[m] radius_j[m] belt", "s w 0.1 0.05 crossed"), 11, (0.1, -0.15, 0.05)),
    "parallel": (("i j", "sun wheel"), 2, (1, 0, -1)),
}


@pytest.mark.parametrize("kind", PLANAR_SWEEPS)
def test_whole_turns_in_the_plane(gudgeon, kind):
    """A sun, an arm and a wheel at its end, which nothing drives, through several turns: angles hold the row without a turn gained or lost,
    and energy and moment of momentum stay."""
    columns, spin, row = PLANAR_SWEEPS[kind]
    text = PLANE.format(spin=spin) + f"[joint.{kind.split()[0]}]\nname {columns[0]}\njoint {columns[1]}\n" + TAIL.format(end=6)
    run = run_with(gudgeon, text)
    assert run.summary["status"] == "complete" and run.summary["warnings"] == []
    angle = np.stack([run.item("bodies/angle", name).ravel() for name in ("sun", "arm", "wheel")], 1)
    assert abs(angle[-1]).max() > 4 * np.pi, "turns"
    assert_close(angle @ row / np.linalg.norm(row), 0 * run.time, absolute=1e-8, what="what the joint holds")
    kinetic = run.read("energy/kinetic").ravel()
    assert_close(kinetic, kinetic[0] + 0 * kinetic, relative=1e-8, what="energy")


def ended(gudgeon, text, code=5):
    """What a run says that ends."""
    done = subprocess.run([gudgeon, "run", written(scratch(), text), "--out", scratch() / "out"], capture_output=True, text=True)
    assert done.returncode == code, (done.returncode, done.stderr)
    return done.stderr


SWING = """deck = 1
[scene]
space = spatial
[bodies]
name   mass[kg]  ixx[kg.m^2]  iyy[kg.m^2]  izz[kg.m^2]  axis     angle[deg]
arm    1         0.1          0.1          0.1          "1 0 0"  {tilt}
wheel  1         0.1          0.1          0.1          "1 0 0"  {tilt}
pinion 1         0.1          0.1          0.1          "1 0 0"  0
[points]
name   body    xi[m]
o      ground  0
a      arm     0
w      wheel   0
g      pinion  0
[joint.revolute]
name   i   j   axis_i   axis_j
hinge  o   a   "1 0 0"  "1 0 0"
spin   a   w   "0 0 1"  "0 0 1"
post   o   g   "0 0 1"  "0 0 1"
[driver.angle]
name   joint  angle
swing  hinge  {angle}
[driver.speed]
name   joint  speed[rad/s]
turn   post   3
"""


def test_bevel_gears_that_become_parallel(gudgeon):
    """An arm swings the axis of one bevel gear through that of the other: no direction is left, and joint and angle are named."""
    gear = '[joint.gear]\nname i j axis_i axis_j radius_i[m] radius_j[m]\nmesh g w "0 0 1" "0 0 1" 0.1 0.1\n'
    text = SWING.replace("{tilt}", "90").replace("{angle}", "{90deg - 1rad*t/(1 s)}") + gear + TAIL.format(end=3)
    words = ended(gudgeon, text)
    assert "joint 'mesh' has lost its mesh" in words and "deg" in words
    told = float(words.split(" deg")[0].split()[-1])
    assert 10 < told < np.degrees(np.arcsin(0.25)) + 0.01
    still = run_with(gudgeon, text.replace("1rad*t/(1 s)", "0.3rad*sin(2rad*t/(1 s))"))
    assert still.summary["status"] == "complete"


def test_gears_on_one_axis(gudgeon):
    """Gears in space whose centres coincide have no line of centres: refused at the start."""
    gear = '[joint.gear]\nname i j axis_i axis_j radius_i[m] radius_j[m]\nmesh g w "0 0 1" "0 0 1" 0.1 0.2\n'
    text = SWING.replace("{tilt}", "0").replace("{angle}", "{0rad*t/(1 s)}") + gear + TAIL.format(end=1)
    words = ended(gudgeon, text, code=4)
    assert "joint 'mesh' has coaxial gears, 0 m apart, without a line of centres" in words


@pytest.mark.parametrize("method", ["verner", "bdf"])
def test_torsion_spring_whose_axes_part(gudgeon, method):
    """A torsional spring about axes that a motion tilts beyond a right angle, where its angle has no value: force and angle are named."""
    spring = "[force.torsion_spring]\nname i j stiffness[N.m/rad]\ncoil ground wheel 0.1\n"
    text = (SWING.replace("{tilt}", "0").replace("{angle}", "{1rad*t/(1 s)}") + spring
            + TAIL.format(end=3).replace("tolerance", f"method = {method}\ntolerance"))
    words = ended(gudgeon, text)
    assert "force element 'coil' has an undefined angle: the angle between its axes is " in words and "limit is 90 deg" in words


def test_rack_whose_pinion_tilts(gudgeon):
    """A pinion whose axis tilts by a right angle against where it meshed."""
    rack = '[joint.rack]\nname i j axis_i axis_j radius[m]\nmesh o w "1 0 0" "0 0 1" 0.1\n'
    text = SWING.replace("{tilt}", "0").replace("{angle}", "{1rad*t/(1 s)}") + rack + TAIL.format(end=3)
    words = ended(gudgeon, text)
    assert "joint 'mesh'" in words and "deg" in words


def test_distance_driven_to_nothing(gudgeon):
    """A driver of a distance that falls below zero cannot be followed: it is named."""
    text = (HEAD.format(iyy=3, x=1, xi=0, v="0 0 0", w="0 0 0")
            + "[joint.inline]\nname i j axis_i\nrail o p \"1 0 0\"\n[driver.distance]\nname i j distance\npull o p {1m - 1m/(1s)*t}\n"
            + TAIL.format(end=2))
    assert "'pull'" in ended(gudgeon, text)
