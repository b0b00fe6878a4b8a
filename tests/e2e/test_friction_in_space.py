"""Friction that remembers, in space: against the plane, and against independent integrations of a pin that turns and slides."""

import functools

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from support import ROOT, Run, call, changed, plain, scratch, written
from translated import in_space

N, STIFFNESS, RADIUS = 2.0, 2e6, 10e-3          # normal force of both bases [N], stiffness of both [N/m], of the pin [m]
ARM = RADIUS - 0.5 * N / STIFFNESS              # of the friction force [m]
MASS, INERTIA = 0.5, 2e-5                       # of the pin [kg], about its axis [kg.m^2]
PUSH, TWIST = (0.75, 7.0), (6e-3, 9.0)          # amplitudes and frequencies of the load along the axis and of the moment about it

PIN = """deck = 1
[scene]
title = "Pin that turns and slides in a bushing, pressed against it"
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]
pin  0.5 1e-3 1e-3 2e-5
cart 0.1 1e-4 1e-4 1e-4
[points]
name body xi[mm]
bore ground 0
hub cart 0
core pin 0
[joint.translational]
name i j axis_i
rail bore hub "1 0 0"
[joint.cylindrical]
name i j
slide hub core
[material]
name young[GPa] poisson
steel 207 0.3
[clearance.revolute]
name bearing journal bearing_radius[mm] clearance[mm] length[mm] material law friction ends
loose bore core 10.1 0.1 40 steel stiff rub endless
[contact.kelvin_voigt]
name stiffness[N/m] restitution
stiff 2e6 1
[friction.KIND]
name COLUMNS
rub CELLS
[force.point]
name point fx[N] fz
press hub 2 0N
push core 0 {0.75N*sin(7/1s*t)}
[force.torque]
name body mz
twist pin {6e-3N.m*sin(9/1s*t)}
[analysis.dynamic]
start = static
end = 1.2 s
tolerance = 1e-10
[output]
every = 10 ms
channels = pin.velocity pin.angular_velocity loose.friction_force loose.normal_force
"""


def run_pin(program, kind, columns, cells, **settings):
    """Run the pin with a friction law."""
    directory = scratch()
    text = changed(PIN.replace("KIND", kind).replace("COLUMNS", columns).replace("CELLS", cells), "analysis.dynamic", **settings)
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet")
    return Run(directory / "out")


def load(t):
    """Force along the axis and moment about it over the arm [N]."""
    return np.array([PUSH[0] * np.sin(PUSH[1] * t), TWIST[0] * np.sin(TWIST[1] * t) / ARM])


def sliding_rates(t, v, friction):
    """Derivatives of the velocity along the axis and about it, the latter times the arm."""
    return (load(t) + friction) / np.array([MASS, INERTIA / ARM**2])


@functools.lru_cache(maxsize=None)
def phases(sliding, static, end):
    """Times at which the pin begins to slide and comes to rest, by Coulomb's law for a vector; and its velocity at the end."""
    times, t, v = [], 0.0, np.zeros(2)

    def rates(t, v):
        speed = np.linalg.norm(v)
        direction = v / speed if speed > 1e-12 else load(t) / np.linalg.norm(load(t))
        return sliding_rates(t, v, -sliding * N * direction)

    def stop(t, v):
        return np.linalg.norm(v) - 1e-9 if t > times[-1] + 1e-6 else 1.0

    stop.terminal, stop.direction = True, -1
    while t < end:
        places = np.linspace(t, end, 4001)
        beyond = [np.linalg.norm(load(x)) - static * N for x in places]
        k = next((k for k in range(4000) if beyond[k] < 0 <= beyond[k + 1]), None)
        if k is None:
            break
        times.append(brentq(lambda x: np.linalg.norm(load(x)) - static * N, places[k], places[k + 1], xtol=1e-15))
        found = solve_ivp(rates, (times[-1], end), np.zeros(2), method="DOP853", rtol=1e-11, atol=1e-14, first_step=1e-7,
                          max_step=1e-3, events=stop)
        t, v = found.t[-1], found.y[:, -1]
        if t < end:
            times.append(t)
            v = np.zeros(2)
    return times, v


@pytest.mark.parametrize("settings", [{}, {"method": "dop853"}, {"method": "rock4"}, {"method": "radau"}, {"method": "adams"}, {"method": "bdf"}, {"method": "ida"}], ids=str)
def test_coulomb_along_and_about_an_axis(gudgeon, settings):
    """Both bases hold together, slip together, and stop together, when a vector of load and moment says so."""
    run = run_pin(gudgeon, "coulomb", "coefficient static_coefficient", "0.38 0.4", **settings)
    times, v = phases(0.38, 0.4, 1.2)
    rows = [(row["time"], plain(row["kind"]).strip()) for row in run.read("events")]
    rows = sorted(row for row in rows if row[1] in ("stick", "slip") and row[0] > 0)
    assert len(times) == 5 and len(rows) == 10
    for k, (t, kind) in enumerate(rows):
        assert abs(t - times[k // 2]) < 1e-6, (k, t, times)
        assert kind == ("slip" if k % 4 < 2 else "stick")
    end = [run.item("bodies/velocity", "pin")[-1, 2], ARM * run.item("bodies/angular_velocity", "pin")[-1, 2]]
    assert np.allclose(end, v, rtol=1e-5, atol=0)


LAWS = {"lugre": ("coefficient static_coefficient stribeck_speed bristle_stiffness bristle_damping viscosity",
                  "0.3 0.4 1mm/s 1e4m^-1 10s/m 0.5s/m"),
        "dahl": ("coefficient stiffness", "0.35 1e4m^-1")}


@pytest.mark.parametrize("kind", LAWS)
def test_bristles_along_and_about_an_axis(gudgeon, kind):
    """Deflections are vectors: an independent integration of both components."""
    run = run_pin(gudgeon, kind, *LAWS[kind], end="0.4 s")
    arm_of_z = np.zeros(2)

    def friction(v, z):
        speed = np.linalg.norm(v)
        if kind == "dahl":
            return -N * 1e4 * z, v - speed * 1e4 / 0.35 * z
        steady = 0.3 + 0.1 * np.exp(-((speed / 1e-3) ** 2))
        rate = v - 1e4 * speed / steady * z
        return -N * (1e4 * z + 10.0 * rate + 0.5 * v), rate

    def rates(t, y):
        force, z_rate = friction(y[:2], y[2:])
        return np.concatenate((sliding_rates(t, y[:2], force), z_rate))

    found = solve_ivp(rates, (0, 0.4), np.concatenate((np.zeros(2), arm_of_z)), method="LSODA", rtol=1e-10, atol=1e-14,
                      t_eval=[0.1, 0.2, 0.3, 0.4])
    for t, v in zip(found.t, found.y[:2].T):
        k = int(np.argmin(abs(run.time - t)))
        here = [run.item("bodies/velocity", "pin")[k, 2], ARM * run.item("bodies/angular_velocity", "pin")[k, 2]]
        assert np.allclose(here, v, rtol=0, atol=2e-6 * np.abs(found.y[:2]).max()), (t, here, v)


@pytest.mark.parametrize("kind, columns, cells", [
    ("coulomb", "coefficient static_coefficient", "0.1 0.12"),
    ("lugre", "coefficient static_coefficient bristle_stiffness", "0.1 0.12 1e6m^-1"),
    ("dahl", "coefficient stiffness exponent", "0.1 1e6m^-1 2")], ids=["coulomb", "lugre", "dahl"])
def test_slider_crank_as_in_the_plane(gudgeon, kind, columns, cells):
    """Section 4.4 with friction that remembers: the first impacts are those of the plane, reversals of sliding among them."""
    onsets = []
    deck = (ROOT / "inputs" / "slider_crank_dry.deck").read_text()
    for text in (deck, in_space(deck)):
        text = text.replace("{law}   ambrosio", "{law}   rub")
        text = text.replace("[friction.ambrosio]", f"[friction.{kind}]\nname {columns}\nrub {cells}\n\n[friction.ambrosio]")
        directory = scratch()
        call(gudgeon, "run", written(directory, changed(text, "analysis.dynamic", end="2 ms", tolerance="1e-9")), "--out",
             directory / "out", "--quiet", "--write", "channels")
        run = Run(directory / "out")
        onsets.append(sorted({round(row["time"], 12) for row in run.contacts}))
    assert len(onsets[0]) >= 6 and len(onsets[1]) == len(onsets[0])
    assert max(abs(a - b) for a, b in zip(*onsets)) < 1e-8


def run_gudgeon_pin(gudgeon, coefficient, method, tolerance):
    """The slider-crank of section 6.6 with Coulomb friction between gudgeon pin and bushing: the ledger closes to the end."""
    text = (ROOT / "inputs" / "slider_crank_6_6_bushing.deck").read_text()
    text = text.replace("journal   axis_i    bearing_radius", "journal   friction   axis_i    bearing_radius")
    text = text.replace('pin       "0 1 0"   10', 'pin       rub   "0 1 0"   10')
    text = text.replace("[analysis.dynamic]", f"[friction.coulomb]\nname coefficient\nrub {coefficient}\n\n[analysis.dynamic]")
    text = changed(changed(text, "output", figures=None, every="0.1 ms"), "analysis.dynamic", tolerance=tolerance)
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--method", method, "--write", "numbers", "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    assert run.summary["status"] == "complete", method
    assert run.summary["energy_residual_max"] < 1e-5 * run.summary["energy_max"], method
    return run


@pytest.mark.parametrize("coefficient, methods", [("0.05", ("verner", "dop853", "radau")), ("0.2", ("dop853", "rock4"))])
def test_both_ends_of_a_pin_that_stick(gudgeon, coefficient, methods):
    """They hold the same two bodies: that drives neither, and at their limit they give way together. The ledger closes to the end."""
    for method in methods:
        run_gudgeon_pin(gudgeon, coefficient, method, "1e-6")


@pytest.mark.parametrize("coefficient, method, tolerance", [
    ("0.2", "radau", "1.3e-6"), ("0.2", "radau", "1.1e-6"), ("0.2", "dop853", "0.7e-6"), ("0.05", "dop853", "5e-7"),
    ("0.05", "verner", "5e-7"), ("0.4", "dop853", "3e-5")])
def test_ends_of_a_pin_that_give_way_one_after_the_other(gudgeon, coefficient, method, tolerance):
    """One that gives way is not held by the other again, and one that is to slip goes one way: time passes, in a few steps."""
    assert run_gudgeon_pin(gudgeon, coefficient, method, tolerance).summary["steps"] < 50000
