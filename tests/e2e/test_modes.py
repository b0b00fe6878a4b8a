"""Modes of linearised mechanisms against closed forms; matrices against motions; Campbell diagrams; what is refused."""

import json
import math

import h5py
import numpy as np
import pytest
import test_whirl as whirl
from scipy.linalg import eigh, expm
from support import ROOT, Run, assert_close, call, scratch, written

G = 9.81


def modes_of(program, text, *sets, expect=0, options=()):
    """Summary of `gudgeon modes`, and its directory."""
    out = scratch() / "out"
    words = [word for name in sets for word in ("--set", name)]
    path = text if str(text).endswith(".deck") else written(scratch(), text)
    done = call(program, "modes", path, "--out", out, "--quiet", *words, *options, expect=expect)
    return done if expect else (json.loads((out / "summary.json").read_text()), out)


def eigenvalues(summary):
    """All eigenvalues: of a pair one is listed."""
    values = [complex(*mode["eigenvalue"]) for mode in summary["modes"]]
    return np.array(values + [value.conjugate() for value in values if value.imag > 0])


def assert_same_eigenvalues(found, right, relative, what):
    """Each eigenvalue has its partner; errors relative to its modulus."""
    assert len(found) == len(right), f"{what}: {len(found)} eigenvalues, {len(right)} expected"
    left = list(right)
    for value in sorted(found, key=abs):
        k = int(np.argmin([abs(value - other) for other in left]))
        assert abs(value - left[k]) <= relative * abs(left[k]), f"{what}: {value} beside {left[k]}"
        left.pop(k)


def second_order(m, c, k):
    """Eigenvalues of M x'' + C x' + K x = 0."""
    n = len(m)
    return np.linalg.eigvals(np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]]))


ARMS = {"m": (1.3, 0.7), "j": (0.02, 0.03), "l": 0.8, "s": (0.35, 0.45)}


def double_pendulum():
    """Squares of the frequencies: arms with their mass centres at s from their pins."""
    (m1, m2), (j1, j2), length, (s1, s2) = ARMS["m"], ARMS["j"], ARMS["l"], ARMS["s"]
    mass = [[j1 + m1 * s1**2 + m2 * length**2, m2 * length * s2], [m2 * length * s2, j2 + m2 * s2**2]]
    return eigh(np.diag([(m1 * s1 + m2 * length) * G, m2 * s2 * G]), mass, eigvals_only=True)


PLANE = """deck = 1
[scene]
title = "Double pendulum"
gravity = 0 -9.81 m/s^2
[bodies]
name   mass[kg]   inertia[kg.m^2]   x[m]   y[m]
a      1.3        0.02              0      -0.35
b      0.7        0.03              0      -1.25
[points]
name   body     xi[m]   eta[m]
o      ground   0       0
a1     a        0       0.35
a2     a        0       -0.45
b1     b        0       0.45
[joint.revolute]
name   i    j
p      o    a1
q      a2   b1
[analysis.dynamic]
end = 1 s
"""

def test_double_pendulum(gudgeon):
    """In the plane: frequencies of the closed form, no damping, and the shares of the kinetic energy."""
    summary, out = modes_of(gudgeon, PLANE)
    square = double_pendulum()
    assert_close([mode["frequency"] for mode in summary["modes"]], np.sqrt(square) / (2 * math.pi), relative=1e-10, what="frequencies")
    assert max(abs(mode["damping_ratio"]) for mode in summary["modes"]) < 1e-10
    mass, s = ARMS["m"], ARMS["s"]
    (x, y), = [eigh(np.diag([(mass[0] * s[0] + mass[1] * ARMS["l"]) * G, mass[1] * s[1] * G]),
                    [[ARMS["j"][0] + mass[0] * s[0]**2 + mass[1] * ARMS["l"]**2, mass[1] * ARMS["l"] * s[1]],
                     [mass[1] * ARMS["l"] * s[1], ARMS["j"][1] + mass[1] * s[1]**2]])[1][:, 0]]
    energy = {"a.x": mass[0] * (s[0] * x)**2, "a.angle": ARMS["j"][0] * x**2, "b.x": mass[1] * (ARMS["l"] * x + s[1] * y)**2,
              "b.angle": ARMS["j"][1] * y**2}
    for name, value in energy.items():
        assert_close(summary["modes"][0]["participation"][name], value / sum(energy.values()), absolute=1e-9, what=name)
    with h5py.File(out / "modes.h5", "r") as file:
        assert file["states/a"].shape == (4, 4)
        assert_same_eigenvalues(np.linalg.eigvals(file["states/a"][()]), eigenvalues(summary), 1e-8, "A of modes.h5")


@pytest.mark.parametrize("axis", [(0, 0, 1), (0.3, 0.5, -0.7)])
def test_double_pendulum_in_space(gudgeon, axis):
    """In space, its pins along any axis: gravity counts by the part that is across them."""
    n = np.array(axis) / np.linalg.norm(axis)
    up = np.array([0, 1, 0]) - n[1] * n
    part = np.linalg.norm(up)
    up /= part

    def words(vector):
        return " ".join(map(repr, map(float, vector)))

    rows = [f'{name} {m} 0.3 0.3 {j} {words(-s * up)} "{words(np.cross(up, n))}" "{words(up)}"'
            for name, m, j, s in (("a", 1.3, 0.02, 0.35), ("b", 0.7, 0.03, 1.25))]
    text = (PLANE.replace("0 -9.81", "0 -9.81 0").replace("[bodies]", "space = spatial\n[bodies]")
            .replace("inertia[kg.m^2]   x[m]   y[m]", "ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] xi_axis eta_axis")
            .replace("a      1.3        0.02              0      -0.35", rows[0])
            .replace("b      0.7        0.03              0      -1.25", rows[1])
            .replace("name   i    j\n", "name   i    j   axis_i\n").replace("o    a1", f'o    a1  "{words(n)}"').replace("a2   b1", 'a2   b1   "0 0 1"'))
    summary, _ = modes_of(gudgeon, text)
    expected = np.sqrt(double_pendulum() * part) / (2 * math.pi)
    assert_close([mode["frequency"] for mode in summary["modes"]], expected, relative=1e-9, what="frequencies")
    assert summary["linear_model"]["states"] == 4


def test_redundant_rows_change_nothing(gudgeon):
    """A joint that stands twice: as many eigenvalues, the same ones."""
    text = PLANE.replace("q      a2   b1\n", "q      a2   b1\nr      a2   b1\n")
    assert_same_eigenvalues(eigenvalues(modes_of(gudgeon, text)[0]), eigenvalues(modes_of(gudgeon, PLANE)[0]), 1e-9, "eigenvalues")


@pytest.mark.parametrize("n", [1, 20])
def test_chain(gudgeon, n):
    """N masses between N + 1 springs, damped in proportion: omega_j = 2 sqrt(k/m) sin(j pi/(2 (N + 1))), zeta_j = omega_j c/(2 k)."""
    k, m, c = 800.0, 0.25, 0.4
    names = ["wall"] + [f"p{i}" for i in range(1, n + 1)] + ["end"]
    text = "\n".join(
        ["deck = 1", "[scene]", 'title = "Chain"', "[bodies]", "name mass[kg] inertia[kg.m^2] x[m]"]
        + [f"b{i} {m} 1 {0.1 * i}" for i in range(1, n + 1)]
        + ["[points]", "name body xi[m]", "wall ground 0", f"end ground {0.1 * (n + 1)}"] + [f"p{i} b{i} 0" for i in range(1, n + 1)]
        + ["[joint.translational]", "name i j axis"] + [f"g{i} wall p{i} x" for i in range(1, n + 1)]
        + ["[force.spring]", "name i j free_length[m] stiffness[N/m] damping[N.s/m]"]
        + [f"s{i} {names[i]} {names[i + 1]} 0.1 {k} {c}" for i in range(n + 1)] + ["[analysis.static]", ""])
    omega = 2 * math.sqrt(k / m) * np.sin(np.arange(1, n + 1) * math.pi / (2 * (n + 1)))
    summary, _ = modes_of(gudgeon, text)
    assert_close([mode["frequency"] for mode in summary["modes"]], omega / (2 * math.pi), relative=1e-9, what="frequencies")
    assert_close([mode["damping_ratio"] for mode in summary["modes"]], omega * c / (2 * k), relative=1e-8, what="damping ratios")


ROTOR = """deck = 1
[scene]
title = "Overhung rotor"
space = spatial
[parameters]
speed = 300 rad/s
[bodies]
name      mass[kg]   ixx[kg.m^2]   iyy[kg.m^2]   izz[kg.m^2]   z[m]
carrier   0.5        0.002         0.002         0.001         0.1
disc      6          0.03          0.03          0.055         0.3
[points]
name    body      zeta[m]
frame   ground    0
seat    carrier   -0.1
nose    carrier   0.2
hub     disc      0
[joint.revolute]
name   i      j
spin   nose   hub
[driver.speed]
name    joint   speed
motor   spin    {speed}
[force.bushing]
name   i       j      stiffness_x[N/m]   stiffness_y[N/m]   stiffness_z[N/m]   {angular} damping_x[N.s/m]
bush   frame   seat   4e5                4e5                9e5                2e4  2e4  3e3  0
[analysis.dynamic]
end = 10 ms
[modes]
at = steady
""".replace("{angular}", "angular_stiffness_x[N.m/rad] angular_stiffness_y[N.m/rad] angular_stiffness_z[N.m/rad]")


def whirl_of_rotor(speed):
    """Eigenvalues of the rotor on its bushing: lateral motions as x + i y, axial motion, and torsion against the spinning disc."""
    k, bend, twist, axial = 4e5, 2e4, 3e3, 9e5
    m, place = np.array([0.5, 6.0]), np.array([0.1, 0.3])
    total, first, second = m.sum(), m @ place, m @ place**2 + 0.002 + 0.03
    mass = np.array([[total, first], [first, second]])  # of the seat's displacement and the slope of the axis
    values = np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)],
                                         [-np.linalg.solve(mass, np.diag([k, bend])), np.linalg.solve(mass, np.diag([0, 1j * 0.055 * speed]))]]))
    lateral = np.concatenate([values, values.conjugate()])
    torsion = math.sqrt(twist / (0.001 + 0.055))  # the drive holds the disc's angle to the carrier's
    stretch = math.sqrt(axial / total)
    return np.concatenate([lateral, [1j * torsion, -1j * torsion, 1j * stretch, -1j * stretch]])


@pytest.mark.parametrize("speed", [0.0, 300.0, 2000.0])
def test_whirl_of_an_overhung_rotor(gudgeon, speed):
    """Forward and backward whirl of a rotor with gyroscopic moments."""
    summary, _ = modes_of(gudgeon, ROTOR, f"speed={speed!r} rad/s")
    assert_same_eigenvalues(eigenvalues(summary), whirl_of_rotor(speed), 1e-8, "whirl")
    assert summary["linear_model"]["unsteady"] < 1e-9
    assert not summary["warnings"]


def test_instant_of_a_steady_motion(gudgeon):
    """At an instant of the motion that is steady the eigenvalues are the same."""
    text = (ROTOR.replace("at = steady", "at = time\ntime = 7 ms").replace("z[m]\ncarrier", "z[m]   wz[rad/s]\ncarrier")
            .replace("0.001         0.1\n", "0.001         0.1    0\n").replace("0.055         0.3\n", "0.055         0.3    {speed}\n"))
    assert_same_eigenvalues(eigenvalues(modes_of(gudgeon, text)[0]), whirl_of_rotor(300.0), 1e-7, "whirl")


TABLE = """deck = 1
[scene]
title = "Mass on a turntable"
[parameters]
speed = 20 rad/s
[bodies]
name    mass[kg]   inertia[kg.m^2]   x[m]
table   1          0.1               0
mass    2          0.01              0.3
[points]
name     body     xi[m]
axis     ground   0
centre   table    0
rim      table    0.3
seat     mass     0
[joint.revolute]
name   i      j
pin    axis   centre
[driver.speed]
name    joint   speed
motor   pin     {speed}
[force.bushing]
name   i     j      stiffness_x[N/m]   stiffness_y[N/m]   angular_stiffness[N.m/rad]
bush   rim   seat   3000               5000               40
[analysis.dynamic]
end = 10 ms
[modes]
at = steady
axes = table
"""


@pytest.mark.parametrize("speed", [0.0, 20.0, 45.0])
def test_mass_on_a_turntable(gudgeon, speed):
    """In axes that turn: Coriolis and centrifugal terms on unequal springs; above the speed sqrt(k_x/m) unstable."""
    summary, _ = modes_of(gudgeon, TABLE, f"speed={speed!r} rad/s")
    m, j = 2.0, 0.01
    stretch = 0.3 * m * speed**2 / (3000 - m * speed**2)  # the seat moves out by so much
    mass, coriolis = np.diag([m, m, j]), np.array([[0, -2 * m * speed, 0], [2 * m * speed, 0, 0], [0, 0, 0]])
    stiffness = np.diag([3000 - m * speed**2, 5000 - m * speed**2, 40])
    right = second_order(mass, coriolis, stiffness)
    assert_same_eigenvalues(eigenvalues(summary), right, 1e-8 if stretch < 1 else 1e-7, "eigenvalues")
    assert (max(right.real) > 1e-6) == (max(eigenvalues(summary).real) > 1e-6)


GOVERNOR = """deck = 1
[scene]
title = "Pendulum on a shaft that turns"
space = spatial
gravity = 0 0 -9.81 m/s^2
[parameters]
speed = 7 rad/s
[bodies]
name    mass[kg]   ixx[kg.m^2]   iyy[kg.m^2]   izz[kg.m^2]   x[m]   z[m]
shaft   1          0.01          0.01          0.01          0      0
ball    2          0.02          0.02          0.02          0.3    -0.4
[points]
name   body     xi[m]   zeta[m]
foot   ground   0       0
axle   shaft    0       0
eye    ball     -0.3    0.4
[joint.revolute]
name   i      j      axis_i
spin   foot   axle   "0 0 1"
pin    axle   eye    "0 1 0"
[driver.speed]
name    joint   speed
motor   spin    {speed}
[analysis.dynamic]
end = 10 ms
[modes]
at = steady
axes = shaft
outputs = ball.position
"""


@pytest.mark.parametrize("speed", [5.0, 7.0])
def test_pendulum_on_a_shaft(gudgeon, speed):
    """The steady motion has cos = g/(l w^2), small motions about it the frequency w sin sqrt(m l^2/(m l^2 + J))."""
    summary, _ = modes_of(gudgeon, GOVERNOR, f"speed={speed!r} rad/s")
    sine = math.sqrt(1 - (G / (0.5 * speed**2))**2)
    assert_close(summary["modes"][0]["frequency"], speed * sine * math.sqrt(0.5 / 0.52) / (2 * math.pi), relative=1e-8, what="frequency")
    assert len(summary["modes"]) == 1


def test_rotor_in_films(gudgeon):
    """A rigid rotor in a short bearing: eigenvalues of its eight coefficients in closed form."""
    eps = whirl.eccentricity(whirl.SPEED)
    summary, _ = modes_of(gudgeon, whirl.DECK)
    assert_same_eigenvalues(eigenvalues(summary), whirl.eigenvalues(*whirl.coefficients(eps, whirl.SPEED)), 1e-8, "rigid rotor")


BEND, DRAG = 2.5e6, 40.0  # of the shaft between journal and disc

JEFFCOTT = (
    whirl.DECK.replace("journal   10         2.5e-3            0       0\n",
                       "journal   3          2.5e-3            0       0\ndisc      7          2.5e-3            0       {-7*9.81/2.5e3*1mm}\n")
    .replace("centre    journal   0        0\n", "centre    journal   0        0\nhub       disc      0        0\n")
    .replace("coupling   shaft   journal\n", "coupling   shaft   journal\nbend       journal   disc\n")
    .replace("[lubricant]", f"[force.bushing]\nname   i        j     stiffness_x[N/m]   stiffness_y[N/m]   damping_x[N.s/m]   damping_y[N.s/m]\n"
             f"spring  centre   hub   {BEND}   {BEND}   {DRAG}   {DRAG}\n[lubricant]")
)


def jeffcott(speed):
    """Eigenvalues of a disc of 7 kg on a flexible shaft whose journal of 3 kg runs in a film; the damping of the shaft turns with it."""
    k, b = whirl.coefficients(whirl.eccentricity(speed), speed)
    mass = np.diag([3.0, 3.0, 7.0, 7.0])
    tie = np.kron([[1, -1], [-1, 1]], np.eye(2))
    first = np.diag([1.0, 0.0])
    circulation = DRAG * speed * np.kron([[1, -1], [-1, 1]], [[0, 1], [-1, 0]])
    return second_order(mass, np.kron(first, b) + DRAG * tie, np.kron(first, k) + BEND * tie + circulation)


@pytest.mark.parametrize("speed", [300.0, 500.0, 900.0])
def test_jeffcott_rotor_in_films(gudgeon, speed):
    """All eight eigenvalues, of the closed form of the short bearing under both weights."""
    summary, _ = modes_of(gudgeon, JEFFCOTT, f"speed={speed!r} rad/s")
    assert_same_eigenvalues(eigenvalues(summary), jeffcott(speed), 1e-8, "Jeffcott rotor")


CAMPBELL = """
[modes]
parameter = speed
from = 200 rad/s
to = 1600 rad/s
points = 15
"""


def test_campbell_diagram(gudgeon):
    """Frequencies at each speed, and the onset of whirl: the closed form, and that of the static analysis."""
    summary, out = modes_of(gudgeon, whirl.DECK + CAMPBELL)
    speed, frequency = whirl.threshold()
    onset, = summary["stability"]
    assert_close(onset["parameter"], speed, relative=1e-8, what="onset")
    assert_close(2 * math.pi * onset["frequency"], frequency, relative=1e-7, what="frequency of the onset")
    assert onset["beyond"] == "unstable"
    small = whirl.static(gudgeon)["small_motions"]
    assert_close(onset["parameter"], small["onset"] * whirl.SPEED, relative=1e-7, what="onset of the static analysis")
    rows = np.genfromtxt(out / "campbell.csv", delimiter=",", names=True)
    names = rows.dtype.names
    for p in np.unique(rows[names[0]]):
        some = rows[rows[names[0]] == p]
        found = np.array([complex(re, im) for re, im in zip(some[names[4]], some[names[5]])])
        found = np.concatenate([found, found[found.imag > 0].conjugate()])
        right = whirl.eigenvalues(*whirl.coefficients(whirl.eccentricity(p), p))
        assert_same_eigenvalues(found, right, 1e-7, f"at {p}")
    assert (out / "figures" / "campbell.png").stat().st_size > 10000
    assert len(np.unique(rows[names[1]])) <= 4, "branches"


def test_values_that_a_deck_refuses(gudgeon):
    """Values without a state are named in warnings, the others are there; without any the verb fails."""
    text = PLANE.replace("[bodies]", "[parameters]\nm = 1.3 kg\n[bodies]").replace("a      1.3 ", "a      {m}")
    text = text.replace("mass[kg]", "mass").replace("b      0.7", "b      0.7kg")
    diagram = "[modes]\nparameter = m\nfrom = -1 kg\nto = {} kg\npoints = 5\n"
    summary, _ = modes_of(gudgeon, text + diagram.format(3))
    assert sorted({row["parameter"] for row in summary["campbell"]}) == [1, 2, 3]
    assert sum("does not take" in warning for warning in summary["warnings"]) == 2
    assert "does not take" in modes_of(gudgeon, text + diagram.format(-0.5), expect=4).stderr


TWO_FILMS = whirl.DECK.replace("[lubricant]", "[clearance.revolute]\nname      bearing   journal   bearing_radius[mm]   clearance[mm]   length[mm]   level  "
                               "film     lubricant\nsecond    housing   centre    25.15                0.15            20           lubricated   {film}   oil\n"
                               "[lubricant]")


def test_unequal_inertias(gudgeon):
    """A rotor with unequal inertias is not steady in axes of the world, but in its own: the closed form in these."""
    text = ROTOR.replace("6          0.03          0.03          0.055", "6          0.03          0.036         0.055")
    assert any("not steady" in warning for warning in modes_of(gudgeon, text)[0]["warnings"])
    text = TOP.replace("0.01          0.01          0.015", "0.01          0.02          0.025").replace("at = time", "at = time\naxes = top")
    summary, _ = modes_of(gudgeon, text)
    assert not summary["warnings"]
    i, j, k, weight, spin = 0.01 + 0.08, 0.02 + 0.08, 0.025, 2 * G * 0.2, 100.0
    coriolis = spin * (i + j - k) * np.array([[0, -1], [1, 0]])  # of the slopes along the body's axes
    right = second_order(np.diag([i, j]), coriolis, np.diag([(k - j) * spin**2 - weight, (k - i) * spin**2 - weight]))
    assert_same_eigenvalues(eigenvalues(summary), np.concatenate([right, [0, 0]]), 1e-8, "eigenvalues")


def test_rotor_on_two_films(gudgeon):
    """Two bearings of different gaps carry the rotor: the onset of whirl is that of the static analysis, which has other differences."""
    summary, _ = modes_of(gudgeon, TWO_FILMS + CAMPBELL.replace("1600", "3000"))
    onset, = summary["stability"]
    static = whirl.run_of(gudgeon, "--analysis", "static", text=TWO_FILMS).summary["small_motions"]
    assert_close(onset["parameter"], static["onset"] * whirl.SPEED, relative=1e-6, what="onset")
    assert_close(2 * math.pi * onset["frequency"], static["onset_frequency"], relative=1e-6, what="frequency")
    found = sorted(eigenvalues(summary), key=lambda value: -value.real)
    listed = [value["growth"] for value in static["eigenvalues"]]
    assert_close([value.real for value in found], listed, relative=1e-6, what="growth")


TOP = """deck = 1
[scene]
title = "Sleeping top"
space = spatial
gravity = 0 0 -9.81 m/s^2
[parameters]
spin = 100 rad/s
[bodies]
name   mass[kg]   ixx[kg.m^2]   iyy[kg.m^2]   izz[kg.m^2]   z[m]   wz[rad/s]
top    2          0.01          0.01          0.015         0.2    {spin}
[points]
name   body     zeta[m]
foot   ground   0
tip    top      -0.2
[joint.spherical]
name   i      j
ball   foot   tip
[analysis.dynamic]
end = 1 s
[modes]
at = time
"""


@pytest.mark.parametrize("spin", [60.0, 100.0, 300.0])
def test_sleeping_top(gudgeon, spin):
    """Upright on its tip: stable from the spin 2 sqrt(I m g l)/I_p on; precession and nutation of the closed form in axes of the world."""
    summary, _ = modes_of(gudgeon, TOP, f"spin={spin!r} rad/s")
    inertia, weight = 0.01 + 2 * 0.2**2, 2 * G * 0.2
    roots = np.roots([inertia, -1j * 0.015 * spin, -weight])  # of the slope of the axis as x + i y
    right = np.concatenate([roots, roots.conjugate(), [0, 0]])
    assert_same_eigenvalues(eigenvalues(summary), right, 1e-8, "eigenvalues")
    assert summary["linear_model"]["unsteady"] < 1e-9
    assert (max(eigenvalues(summary).real) > 1e-6) == (0.015 * spin < 2 * math.sqrt(inertia * weight))


def test_cantilever(gudgeon):
    """A row of beams between lumped masses: the same finite elements, assembled here."""
    n, length, mass, bend = 8, 0.6, 1140 * 0.6 * 0.03 * 0.006, 3e9 * 0.03 * 0.006**3 / 12
    area, shear = 3e9 * 0.03 * 0.006, 3e9 / 2.8 * 0.03 * 0.006 / 1.2
    e = length / n
    phi = 12 * bend / (shear * e**2)
    block = bend / (e**3 * (1 + phi)) * np.array([[12, 6 * e, -12, 6 * e], [6 * e, (4 + phi) * e**2, -6 * e, (2 - phi) * e**2],
                                                  [-12, -6 * e, 12, -6 * e], [6 * e, (2 - phi) * e**2, -6 * e, (4 + phi) * e**2]])
    stiffness = np.zeros((2 * n + 2, 2 * n + 2))
    for k in range(n):
        stiffness[2 * k:2 * k + 4, 2 * k:2 * k + 4] += block
    lumps = np.array([v for k in range(n - 1) for v in (mass / 8, mass / 8 * 0.075**2 / 12)] + [mass / 16, mass / 16 * 0.075**2 / 48])
    lateral = eigh(stiffness[2:, 2:], np.diag(lumps), eigvals_only=True)
    chain = area / e * (np.diag([2.0] * (n - 1) + [1.0]) - np.eye(n, k=1) - np.eye(n, k=-1))
    axial = eigh(chain, np.diag(lumps[::2]), eigvals_only=True)
    deck = (ROOT / "inputs" / "cantilever_beams.deck").read_text().replace("0.1ms", "0s").replace("0 -9.81", "0 0")
    summary, _ = modes_of(gudgeon, deck)
    expected = np.sort(np.sqrt(np.concatenate([lateral, axial]))) / (2 * math.pi)
    assert_close([mode["frequency"] for mode in summary["modes"]], expected, relative=1e-8, what="frequencies")
    exact = 1.8751040687**2 / (2 * math.pi) * math.sqrt(bend / (mass * length**3))
    assert_close(summary["modes"][0]["frequency"], exact, relative=0.01, what="first frequency of a slender beam")
    hanging = modes_of(gudgeon, ROOT / "inputs" / "cantilever_beams.deck")[0]
    slowest = min(mode["frequency"] for mode in hanging["modes"] if mode["frequency"] > 0)
    said = float(hanging["linear_model"]["state"].split("frequency ")[1].split()[0])
    assert_close(slowest, said, relative=1e-5, what="lowest frequency of the static analysis")


DAMPED = (
    PLANE.replace("[analysis.dynamic]\nend = 1 s\n", "")
    .replace("[bodies]", "[parameters]\npush = 0 N\ntwist = 0 N.m\nmove = 0 m\n[bodies]\nbase   1          0.1               0      0")
    .replace("name   mass", "NAME").replace("[bodies]\nbase   1          0.1               0      0\nNAME", "[bodies]\nname   mass")
    .replace("a      1.3 ", "base   1          0.1               0      0\na      1.3 ")
    .replace("o      ground   0       0\n", "o      base     0       0\nwall   ground   0       0\n")
    + """[joint.translational]
name   i      j   axis
rail   wall   o   x
[driver.position]
name    i      j   axis   position
shake   wall   o   x      {move*(t/1s)^2*(3-2*t/0.5s)}
[force.torsion_spring]
name   i      j   stiffness[N.m/rad]   damping[N.m.s/rad]
hold   base   a   3                    0.9
link   a      b   2                    0.4
[force.point]
name   point   fx       fy
fan    b1      {push}   0N
[force.torque]
name   body   moment
turn   a      {twist}
[analysis.static]
[analysis.dynamic]
end = 0.4 s
tolerance = 1e-12
[output]
every = 20 ms
channels = *
[modes]
inputs = fan.fx a.mz shake
outputs = b.position b.velocity b.acceleration p.force q.force
"""
)


def matrices(out):
    """A, B, C, D."""
    with h5py.File(out / "modes.h5", "r") as file:
        return file["states/a"][()], file["states/b"][()], file["outputs/c"][()], file["outputs/d"][()]


def end_of(program, text, *sets):
    """Time histories of the channels of the outputs."""
    out = scratch() / "out"
    words = [word for name in sets for word in ("--set", name)]
    run = Run(out, call(program, "run", written(scratch(), text), "--out", out, "--write", "channels", *words))
    columns = [run.item(f"bodies/{name}", "b") for name in ("position", "velocity", "acceleration")]
    columns += [run.item("joints/force", name) for name in "pq"]
    return run.time, np.hstack(columns)


@pytest.mark.parametrize("name, amplitude", [("push", 1e-3), ("twist", 1e-3), ("move", 1e-3)])
def test_matrices_against_motions(gudgeon, name, amplitude):
    """A small step of a force, of a moment, and a motion of the base: the differences of two runs are C z + D u, z' = A z + B u."""
    summary, out = modes_of(gudgeon, DAMPED)
    a, b, c, d = matrices(out)
    names = summary["linear_model"]["inputs"]
    assert names == ["fan.fx", "a.mz", "shake.displacement", "shake.speed", "shake.acceleration"]
    assert a.shape == (4, 4) and d.shape == (10, 5)
    unit = {"push": "N", "twist": "N.m", "move": "m"}[name]
    (time, up), (_, down) = [end_of(gudgeon, DAMPED, f"{name}={sign * amplitude} {unit}") for sign in (1, -1)]
    response = (up - down) / (2 * amplitude)
    # the input and its chain as further states: a step, or the polynomial t^2 (3 - 4 t) of the base with its derivatives
    n = 1 if name != "move" else 4
    big = np.zeros((4 + n, 4 + n))
    big[:4, :4] = a
    start = np.zeros(4 + n)
    if n == 1:
        k = ["push", "twist"].index(name)
        big[:4, 4], through = b[:, k], np.column_stack([d[:, k]])
        start[4] = 1
    else:  # displacement, speed, acceleration, jerk
        big[:4, 4:7] = b[:, 2:]
        big[4:7, 5:8] = np.eye(3)
        through = np.hstack([d[:, 2:], np.zeros((10, 1))])
        start[4:] = [0, 0, 6, -24]
    predicted = np.array([np.hstack([c, through]) @ expm(big * t) @ start for t in time])
    for k in range(10):
        scale = abs(predicted[:, k]).max()
        if scale > 1e-9:
            assert_close(response[:, k], predicted[:, k], absolute=1e-6 * scale, what=f"output {k}")


def test_base_motion_has_no_hidden_inertia(gudgeon):
    """The acceleration of the base is in D only: what it moves at once is across the free directions."""
    _, out = modes_of(gudgeon, DAMPED)
    _, b, _, d = matrices(out)
    assert_close(b[:, 4], 0, absolute=1e-12, what="B")
    assert abs(d[:, 4]).max() > 1e-3


@pytest.mark.parametrize("line, message", [
    ("inputs = b1.fq", "not an input"), ("inputs = nothing", "not an input"), ("inputs = o.fx", "not an input"), ("inputs = p.fx", "not an input"), ("inputs = a.mx", "not an input"),
    ("outputs = b.nothing", "unknown channel"), ("outputs = energy.kinetic", "is an energy"), ("axes = nobody", "is not a body"),
    ("at = sometimes", "sometimes"), ("parameter = none", "not a parameter"), ("parameter = w", "no 'from'"),
    ("parameter = w\nfrom = 1 m\nto = 2 m", "has not the unit"), ("parameter = w\nfrom = 1 rad/s\nto = 1 rad/s", "must differ"),
    ("points = 3.5", "not a whole number"), ("time = 1 turns of nobody", "nobody"),
])
def test_mistakes(gudgeon, line, message):
    """Each mistake of the section has its message, with its place, for all verbs that read decks."""
    text = PLANE.replace("[bodies]", "[parameters]\nw = 1 rad/s\n[bodies]") + "[modes]\n" + line + "\n"
    done = modes_of(gudgeon, text, expect=3)
    assert message in done.stderr and "scene.deck:" in done.stderr and "^" in done.stderr
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    assert message in done.stderr


def test_states_that_are_not_there(gudgeon):
    """No equilibrium, no steady motion: a message, and an exit code."""
    falls = PLANE.replace("q      a2   b1\n", "")
    assert "no static equilibrium" in modes_of(gudgeon, falls, expect=4).stderr
    assert "no steady motion" in modes_of(gudgeon, falls + "[modes]\nat = steady\n", expect=4).stderr


def test_instant_that_is_no_equilibrium(gudgeon):
    """The state is told to be none."""
    summary, _ = modes_of(gudgeon, PLANE.replace("b1     b        0       0.45", "b1     b        0.45    0") + "[modes]\nat = time\n")
    assert any("not an equilibrium" in warning for warning in summary["warnings"])
    assert summary["linear_model"]["residual"] > 1e-3


def test_nothing_is_free(gudgeon):
    """Drivers prescribe everything: no modes, which is said, and files without rows."""
    out = scratch() / "out"
    done = call(gudgeon, "modes", ROOT / "inputs" / "four_bar_kinematic.deck", "--out", out)
    assert "no modes" in done.stdout
    assert json.loads((out / "summary.json").read_text())["modes"] == []
    with h5py.File(out / "modes.h5", "r") as file:
        assert file["modes/frequency"].shape == (0,)


def test_contact_that_presses(gudgeon):
    """A ball at rest on a plane: the tangent stiffness of Hertz' law, 1.5 K^(2/3) (m g)^(1/3), without damping."""
    summary, _ = modes_of(gudgeon, ROOT / "inputs" / "bouncing_ball.deck", "law=hertz")
    stiffness = 4 / 3 * math.sqrt(0.1) * 207e9 / (2 * (1 - 0.3**2))
    mode, = [mode for mode in summary["modes"] if mode["frequency"] > 1]
    assert_close(mode["frequency"], math.sqrt(1.5 * stiffness**(2 / 3) * G**(1 / 3)) / (2 * math.pi), relative=1e-7, what="frequency")
    assert mode["participation"]["ball.y"] > 0.999999
    assert abs(mode["damping_ratio"]) < 1e-6


SLOW = ("primitives",)  # its search for an equilibrium takes half a minute
DECKS = sorted(path for folder in ("", "hard") for path in (ROOT / "inputs" / folder).glob("*.deck") if path.stem not in SLOW)


@pytest.mark.parametrize("deck", DECKS, ids=[path.stem for path in DECKS])
def test_every_deck(gudgeon_debug, deck):
    """Modes or a message: all decks, with run-time checks."""
    out = scratch() / "out"
    done = call(gudgeon_debug, "modes", deck, "--out", out, "--quiet", expect=(0, 4))
    if done.returncode:
        assert "no static equilibrium" in done.stderr
        return
    summary = json.loads((out / "summary.json").read_text())
    model = summary["linear_model"]
    assert len(eigenvalues(summary)) == model["states"] >= 2 * model["degrees_of_freedom"]
    for mode in summary["modes"]:
        assert sum(mode["participation"].values()) <= 1 + 1e-9


def test_bristles_are_states(gudgeon):
    """Friction with bristles adds its states; constraints and Euler parameters add none."""
    deck = (ROOT / "inputs" / "hard" / "side_by_side.deck").read_text()
    summary, _ = modes_of(gudgeon, deck + "\n[modes]\nat = time\ntime = 50 ms\n")
    model = summary["linear_model"]
    assert model["states"] == 2 * model["degrees_of_freedom"] + 2
    summary, _ = modes_of(gudgeon, ROOT / "inputs" / "hard" / "a04_bricard.deck")
    assert summary["linear_model"]["states"] == 2
