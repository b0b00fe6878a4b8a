"""Oil whirl of a rotor on a film: coefficients and onset against textbook formulas, eigenvalues against motions in time.

The formulas are those of the half film of a short bearing (Friswell et al., Dynamics of Rotating Machines (2010), section 5.5) and of
the limit of a rigid rotor (Lund 1987); the motions are runs of the same deck that are pushed a little.
"""

import functools
import math

import h5py
import numpy as np
import pytest
from support import Run, assert_close, call, scratch, written

RADIUS, LENGTH, CLEARANCE, VISCOSITY, MASS = 25e-3, 25e-3, 0.1e-3, 0.02, 10.0  # of the journal
LOAD, SPEED = MASS * 9.81, 500.0  # N, rad/s
SCALE = VISCOSITY * LENGTH**3 * RADIUS / CLEARANCE**2

DECK = """deck = 1
[scene]
title = "A rigid rotor on a short film"
space = planar
gravity = 0 -9.81 m/s^2
[parameters]
speed = 500 rad/s
film = short_gumbel
push = 0 N
duration = 0.1 s
[bodies]
name      mass[kg]   inertia[kg.m^2]   x[mm]   y[mm]
shaft     1          2.5e-4            0       0
journal   10         2.5e-3            0       0
[points]
name      body      xi[mm]   eta[mm]
housing   ground    0        0
axis      shaft     0        0
centre    journal   0        0
[joint.revolute]
name      i         j
main      housing   axis
[joint.parallel]
name       i       j
coupling   shaft   journal
[driver.speed]
name     joint   speed
motor    main    {speed}
[force.point]
name     point    fx
push     centre   {push*exp(-((t - 5 ms)/1 ms)^2)}
[clearance.revolute]
name      bearing   journal   bearing_radius[mm]   clearance[mm]   length[mm]   level        film     lubricant
bearing   housing   centre    25.1                 0.1             25           lubricated   {film}   oil
[lubricant]
name   viscosity
oil    20cP
[film.short_gumbel]
name
short_gumbel
[film.finite]
name
finite
[film.short_sommerfeld]
name
short_sommerfeld
[film.grid]
name   resolution
grid   coarse
[film.squeeze]
name
squeeze
[analysis.dynamic]
start = static
end = {duration}
method = bdf
tolerance = 1e-11
[analysis.static]
tolerance = 1e-12
[output]
every = 0.1 ms
channels = bearing.*
"""


def run_of(gudgeon, *options, text=DECK, **settings):
    """A run of the deck, with settings of its parameters."""
    out = scratch() / "out"
    words = [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]
    done = call(gudgeon, "run", written(scratch(), text), "--out", out, "--write", "channels", *options, *words)
    return Run(out, done)


def static(gudgeon, **settings):
    """The summary of the steady state."""
    return run_of(gudgeon, "--analysis", "static", **settings).summary


def load_of(eps):
    """Load over scale and speed: half film of a short bearing."""
    return eps / (4 * (1 - eps**2) ** 2) * math.sqrt(math.pi**2 * (1 - eps**2) + 16 * eps**2)


def eccentricity(speed):
    """Where the load is carried, by bisection."""
    low, high = 0.0, 1 - 1e-9
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if SCALE * speed * load_of(middle) < LOAD else (low, middle)
    return low


def coefficients(eps, speed):
    """Stiffness and damping, x across the load and y along it."""
    pi, q = math.pi, 1 - eps**2
    root, h = math.sqrt(q), (math.pi**2 * q + 16 * eps**2) ** -1.5
    a = h * np.array([
        [4 * (pi**2 * (2 - eps**2) + 16 * eps**2), pi * (pi**2 * q**2 - 16 * eps**4) / (eps * root)],
        [-pi * (pi**2 * q * (1 + 2 * eps**2) + 32 * eps**2 * (1 + eps**2)) / (eps * root),
         4 * (pi**2 * (1 + 2 * eps**2) + 32 * eps**2 * (1 + eps**2) / q)],
    ])
    cross = -8 * (pi**2 * (1 + 2 * eps**2) - 16 * eps**2)
    b = h * np.array([
        [2 * pi * root * (pi**2 * (1 + 2 * eps**2) - 16 * eps**2) / eps, cross],
        [cross, 2 * pi * (pi**2 * q**2 + 48 * eps**2) / (eps * root)],
    ])
    return LOAD / CLEARANCE * a, LOAD / CLEARANCE / speed * b


def critical_mass(k, b):
    """Mass of a rigid rotor at its limit, and the frequency of its whirl."""
    stiffness = (k[0, 0] * b[1, 1] + k[1, 1] * b[0, 0] - k[0, 1] * b[1, 0] - k[1, 0] * b[0, 1]) / np.trace(b)
    square = ((stiffness - k[0, 0]) * (stiffness - k[1, 1]) - k[0, 1] * k[1, 0]) / np.linalg.det(b)
    return stiffness / square, math.sqrt(square)


def eigenvalues(k, b, mass=MASS):
    """Of a rigid rotor, the greatest growth first."""
    values = np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)], [-k / mass, -b / mass]]))
    return values[np.argsort(-values.real)]


@functools.lru_cache
def threshold():
    """The speed at which the rotor's mass is the critical one, and the frequency there."""
    low, high = 500.0, 1500.0
    for _ in range(100):
        middle = (low + high) / 2
        mass, frequency = critical_mass(*coefficients(eccentricity(middle), middle))
        low, high = (middle, high) if mass > MASS else (low, middle)
    return low, frequency


def matrix(film, name):
    """A matrix of a film in the summary."""
    return np.array([[film[f"{name}_{i}{j}"] for j in "xy"] for i in "xy"])


def test_coefficients_and_eigenvalues(gudgeon):
    """The equilibrium, the eight coefficients, the rotor's limit and all four eigenvalues."""
    run = run_of(gudgeon, "--analysis", "static")
    film = run.summary["films"][0]
    eps = eccentricity(SPEED)
    k, b = coefficients(eps, SPEED)
    assert_close(film["eccentricity_ratio"], eps, relative=1e-9, what="eccentricity")
    assert_close(film["attitude"], math.atan(math.pi * math.sqrt(1 - eps**2) / (4 * eps)), absolute=1e-9, what="attitude")
    assert_close(matrix(film, "stiffness"), k, absolute=1e-8 * abs(k).max(), what="stiffness")
    assert_close(matrix(film, "damping"), b, absolute=1e-8 * abs(b).max(), what="damping")
    mass, frequency = critical_mass(k, b)
    assert_close(film["critical_mass"], mass, relative=1e-7, what="critical mass")
    assert_close(film["whirl_frequency"], frequency, relative=1e-7, what="frequency of the whirl")
    with h5py.File(run.directory / "run.h5", "r") as file:
        values = file["films/eigenvalues"][()]
        assert_close(file["films/stiffness"][()][0], matrix(film, "stiffness"), absolute=0, what="run.h5")
        assert_close(file["films/damping"][()][0], matrix(film, "damping"), absolute=0, what="run.h5")
    expected = eigenvalues(k, b)
    assert_close(values[:, 0], expected.real, relative=1e-6, what="growth")
    assert_close(abs(values[:, 1]), abs(expected.imag), absolute=1e-6 * abs(expected).max(), what="frequency")
    assert "asymptotically stable" in run.summary["equilibrium"]
    assert "critical mass" in run.done.stdout
    assert "stable below" in run.done.stdout


@pytest.mark.parametrize("factor", [0.6, 1.4])
def test_onset(gudgeon, factor):
    """The speed at which whirl sets in, from below and from above, is that at which the mass is the critical one."""
    speed, frequency = threshold()
    summary = static(gudgeon, speed=f"{factor * speed!r} rad/s")
    small = summary["small_motions"]
    assert_close(small["onset"] * factor * speed, speed, relative=1e-7, what="onset")
    assert_close(small["onset_frequency"], frequency, relative=1e-6, what="frequency")
    assert ("asymptotically stable" if factor < 1 else "unstable; fastest mode") in summary["equilibrium"]
    assert any("unstable" in warning for warning in summary["warnings"]) == (factor > 1)


def growth_in_time(run, after):
    """Growth and frequency of a small motion, from its distance to the equilibrium: a fit of a swinging exponential."""
    e = run.item("clearances/eccentricity", "bearing")
    x = (e[:, 1] - e[0, 1])[run.time > after]
    step = run.time[1] - run.time[0]
    # two terms of a linear recurrence, x[n+1] = a x[n] + b x[n-1], by least squares
    a, b = np.linalg.lstsq(np.column_stack([x[1:-1], x[:-2]]), x[2:], rcond=None)[0]
    root = np.log(np.roots([1, -a, -b]).astype(complex)[0]) / step
    return root.real, abs(root.imag)


@pytest.mark.parametrize("film", ["short_gumbel", "finite"])
@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_push_in_time(gudgeon, film, factor):
    """Below the threshold a push dies, above it grows, at the rate and the frequency of the eigenvalue."""
    base = static(gudgeon, film=film)
    speed = f"{factor * base['small_motions']['onset'] * SPEED!r} rad/s"
    first = static(gudgeon, film=film, speed=speed)["small_motions"]["eigenvalues"][0]
    assert (first["growth"] < 0) == (factor < 1)
    run = run_of(gudgeon, film=film, speed=speed, push="0.1 N")
    growth, frequency = growth_in_time(run, 0.03)
    assert_close(growth, first["growth"], absolute=2e-3 * abs(first["frequency"]), what="growth")
    assert_close(frequency, abs(first["frequency"]), relative=2e-3, what="frequency")


ARM = (
    DECK.replace("shaft     1          2.5e-4            0       0\n",
                 "shaft     1          2.5e-4            0       0\narm       4          0.02              -150    0\n")
    .replace("housing   ground    0        0\n",
             "frame     ground    0        0\nhousing   arm       150      0\nhinge     ground    -300     0\nfoot      arm       -150     0\n"
             "floor     ground    -100     -200\nseat      arm       50       0\n")
    .replace("main      housing   axis\n", "main      frame     axis\nhinge     hinge     foot\n")
    .replace("[lubricant]", "[force.spring]\nname   i       j       stiffness[N/m]   free_length[mm]   damping[N.s/m]\n"
             "strut  floor     seat      8e5              200.2             20\n[lubricant]")
)


def test_bearing_on_an_arm(gudgeon):
    """The limit is one of the whole mechanism: on an arm on a spring the bearing whirls earlier, and motions in time go with it."""
    run = run_of(gudgeon, "--analysis", "static", text=ARM)
    small = run.summary["small_motions"]
    assert len(small["eigenvalues"]) == 6
    assert small["onset"] < 1 < static(gudgeon)["small_motions"]["onset"]
    first = small["eigenvalues"][0]
    moved = run_of(gudgeon, text=ARM, push="0.1 N", duration="0.4 s")
    growth, frequency = growth_in_time(moved, 0.25)
    assert_close(growth, first["growth"], absolute=2e-4 * abs(first["frequency"]), what="growth")
    assert_close(frequency, abs(first["frequency"]), relative=5e-3, what="frequency")


def test_steady_state_to_round_off(gudgeon, gudgeon_debug):
    """What the last digits of positions leave out of balance is enough, whatever order a build adds the loads up in."""
    onsets = [run_of(program, "--analysis", "static", text=ARM).summary["small_motions"]["onset"] for program in (gudgeon, gudgeon_debug)]
    assert_close(onsets[0], onsets[1], relative=1e-6, what="onset")


def test_full_film_whirls_at_any_speed(gudgeon):
    """A full film holds nothing: unstable at every speed, and said so."""
    summary = static(gudgeon, film="short_sommerfeld")
    assert "unstable; fastest mode" in summary["equilibrium"]
    assert summary["small_motions"]["onset"] is None
    assert "unstable down to 0.03333 times" in summary["small_motions"]["onset_text"]


def test_search_is_left_out(gudgeon):
    """`whirl_search = 1`: no search, and nothing is said of an onset."""
    text = DECK.replace("[analysis.static]", "[analysis.static]\nwhirl_search = 1")
    summary = run_of(gudgeon, "--analysis", "static", text=text).summary
    assert "onset" not in summary["small_motions"]
    assert summary["films"][0]["critical_mass"] > 0


def test_explain(gudgeon):
    """explain finds the steady state by itself, and says so where there is none."""
    said = call(gudgeon, "explain", written(scratch(), DECK)).stdout
    assert "steady state of the films" in said
    assert "critical mass" in said
    assert "times this speed; whirl onset at" in said
    said = call(gudgeon, "explain", written(scratch(), DECK), "--set", "film=squeeze", expect=4).stdout
    assert "do not determine one" in said


def test_no_steady_state(gudgeon):
    """A driver that accelerates bodies: balanced for an instant, and no stability is claimed."""
    text = DECK.replace("journal   10         2.5e-3            0       0", "journal   10         2.5e-3            0       0\n"
                        "crank     1          1e-3              10      0").replace(
        "axis      shaft     0        0\n", "axis      shaft     0        0\nhub       shaft     10       0\npin       crank     0        0\n")
    text = text.replace("[joint.parallel]", "[joint.rigid]\nname   i   j\nfix    hub   pin\n[joint.parallel]")
    summary = run_of(gudgeon, "--analysis", "static", text=text).summary
    assert "instantaneous only" in summary["equilibrium"]
    assert summary["small_motions"] == {"judged": False}
