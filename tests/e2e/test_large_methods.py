"""bdf and ida in large scenes: sparse matrices, memory in proportion to the bodies, the same motion as from other methods."""

import os
import subprocess

import numpy as np
import pytest
from support import Run, call, changed, made, scratch, written

IMPLICIT = ("bdf", "ida")
G = 9.81


def run(gudgeon, text, limit=120):
    """A deck, run."""
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", limit=limit)
    return Run(directory / "out")


def oscillators(n, method, end=0.5, extra=""):
    """n bodies of 1 kg, each on a spring of its own: x = 0.1 m cos(omega t) with omega^2 = 100 k."""
    bodies = "".join(f"b{k} 1 1 {1 + 0.1:g} {k} 0\n" for k in range(1, n + 1))
    points = "".join(f"c{k} b{k} 0 0\nw{k} ground 0 {k}\n" for k in range(1, n + 1))
    springs = "".join(f"s{k} w{k} c{k} {100*(1 + k/n):.17g} 1\n" for k in range(1, n + 1))
    return (f"deck = 1\n[scene]\ntitle = \"oscillators\"\n[bodies]\nname mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]\n{bodies}"
            f"[points]\nname body xi[m] eta[m]\n{points}[force.spring]\nname i j stiffness[N/m] free_length[m]\n{springs}{extra}"
            f"[analysis.dynamic]\nend = {end} s\nmethod = {method}\ntolerance = 1e-9\n[output]\nevery = {end/10} s\n"
            "channels = *.position.x energy.*\n")


@pytest.mark.parametrize("method", IMPLICIT)
def test_free_bodies_move_as_in_closed_form(gudgeon, method):
    """Sixty bodies that know nothing of one another, each with its own frequency."""
    n = 60
    found = run(gudgeon, oscillators(n, method))
    omega = np.sqrt(100*(1 + np.arange(1, n + 1)/n))
    expected = 1 + 0.1*np.cos(np.outer(found.time, omega))
    assert np.max(np.abs(found.read("bodies/position")[:, :, 0] - expected)) <= 1e-6
    assert found.summary["energy_residual_max"] <= 1e-6*found.summary["energy_max"]


@pytest.mark.parametrize("method", IMPLICIT)
def test_free_bodies_with_run_time_checks(gudgeon_debug, method):
    """The same in the build that checks bounds, for a short while."""
    n = 60
    found = run(gudgeon_debug, oscillators(n, method, end=0.02))
    omega = np.sqrt(100*(1 + np.arange(1, n + 1)/n))
    expected = 1 + 0.1*np.cos(np.outer(found.time, omega))
    assert np.max(np.abs(found.read("bodies/position")[:, :, 0] - expected)) <= 1e-6


@pytest.mark.parametrize("method", IMPLICIT)
def test_a_chain_moves_as_with_another_method(gudgeon, method):
    """Sixty pendulums in a row, against Runge-Kutta-Verner at a thousandth of the tolerance; the ledger closes."""
    options = ("--end", "0.2", "--every", "0.02", "--channels", "*.position *.angle energy.*")
    runs = [run(gudgeon, made("pendulum", 60, *options, "--method", word, "--tolerance", tolerance))
            for word, tolerance in ((method, "1e-8"), ("verner", "1e-11"))]
    for name in ("position", "angle"):
        found, expected = (run.read(f"bodies/{name}") for run in runs)
        assert np.max(np.abs(found - expected)) <= 2e-6, name
    summary = runs[0].summary
    assert summary["energy_residual_max"] <= 1e-5*summary["energy_max"]
    assert summary["violation_max"] <= 1e-7


@pytest.mark.parametrize("method", IMPLICIT)
def test_balls_that_bounce_give_back_what_the_law_says(gudgeon, method):
    """Sixty balls fly at a plane at once: each leaves with the restitution of the exact law, at its own speed."""
    n, speeds = 60, np.linspace(0.4, 0.6, 60)
    bodies = "".join(f"b{k} 1 1 {k} 0.101 0 {-v:.17g}\n" for k, v in enumerate(speeds))
    points = "".join(f"c{k} b{k} 0 0\n" for k in range(n))
    rows = "".join(f"j{k} floor c{k} y 0.1 steel hard\n" for k in range(n))
    text = (f"deck = 1\n[scene]\ntitle = \"balls\"\n[bodies]\nname mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg] vy[m/s]\n{bodies}"
            f"[points]\nname body xi[m] eta[m]\nfloor ground 0 0\n{points}[material]\nname young[GPa] poisson\nsteel 1 0.3\n"
            f"[contact.exact]\nname restitution\nhard 0.8\n[clearance.plane]\nname plane ball axis radius[m] material law\n{rows}[analysis.dynamic]\nend = 0.08 s\nmethod = {method}\n"
            "tolerance = 1e-9\n[output]\nevery = 0.01 s\nchannels = b1.position\n")
    contacts = run(gudgeon, text).contacts
    assert len(contacts) == n
    assert np.max(np.abs(np.sort(contacts["impact_speed"])/speeds - 1)) <= 1e-6
    assert np.max(np.abs(contacts["release_speed"]/contacts["impact_speed"]/0.8 - 1)) <= 1e-5


@pytest.mark.parametrize("method", IMPLICIT)
def test_discs_roll_as_in_closed_form(gudgeon, method):
    """Sixty discs roll down inclines of their own, kept from sliding by friction that sticks: 2/3 of g sin(angle)."""
    n, slopes, depth = 60, np.linspace(5.0, 15.0, 60), (9.81/1e9)**(2/3)
    place = [(0.05 - depth)*np.array([-np.sin(a), np.cos(a)]) for a in np.radians(slopes)]
    bodies = "".join(f"b{k} 1 1.25e-3 {x:.17g} {y:.17g}\n" for k, (x, y) in enumerate(place))
    points = "".join(f"c{k} b{k} 0 0\n" for k in range(n))
    rows = "".join(f"j{k} foot c{k} y {a:.17g} 0.05 steel hard rough\n" for k, a in enumerate(slopes))
    text = (f"deck = 1\n[scene]\ngravity = 0 -9.81 m/s^2\n[bodies]\nname mass[kg] inertia[kg.m^2] x[m] y[m]\n{bodies}"
            f"[points]\nname body xi[m] eta[m]\nfoot ground 0 0\n{points}[material]\nname young[GPa] poisson\nsteel 207 0.3\n"
            "[contact.exact]\nname restitution stiffness[N/m^1.5]\nhard 0.5 1e9\n[friction.coulomb]\nname coefficient\nrough 0.3\n"
            f"[clearance.plane]\nname plane ball axis axis_angle[deg] radius[m] material law friction\n{rows}"
            f"[analysis.dynamic]\nstart = given\noverlap = preload\nend = 0.05 s\nmethod = {method}\ntolerance = 1e-8\n"
            "[output]\nevery = 0.01 s\nchannels = *.angle energy.*\n")
    found = run(gudgeon, text)
    angle = found.read("bodies/angle")[-1].reshape(-1)
    expected = 0.5*(2/3)*9.81*np.sin(np.radians(slopes))*0.05**2/0.05
    assert np.max(np.abs(angle/expected - 1)) <= 1e-4
    assert found.summary["energy_residual_max"] <= 1e-6*found.summary["energy_max"]


@pytest.mark.parametrize("method", IMPLICIT)
def test_evaluations_do_not_grow_with_the_bodies(gudgeon, method):
    """A Jacobian takes as many differences as a body has neighbours, not as there are states: four times the bodies, as many."""
    counts = [run(gudgeon, made("pendulum", n, "--end", "0.02", "--every", "0.02", "--method", method)).summary["rhs_evaluations"]
              for n in (60, 240)]
    assert counts[1] <= 2*counts[0], counts


@pytest.mark.slow
@pytest.mark.parametrize("method", IMPLICIT)
@pytest.mark.parametrize("kind", ("chain", "free"))
def test_ten_thousand_bodies_fit(gudgeon, kind, method):
    """Full matrices would be 30 GB: a chain, and bodies of their own."""
    n, directory = 10000, scratch()
    if kind == "chain":
        text = made("pendulum", n, "--end", "1e-3", "--every", "1e-3", "--method", method, "--channels", f"rod_{n}.position")
    else:
        text = changed(oscillators(n, method, end=1e-3), "output", channels=f"b{n}.position.x")
    child = subprocess.Popen([str(gudgeon), "run", str(written(directory, text)), "--quiet", "--out", str(directory / "out")])
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0
    assert used.ru_maxrss <= 1_200_000, "kB"
    end = Run(directory / "out").item("bodies/position", f"rod_{n}" if kind == "chain" else f"b{n}")[-1]
    expected = -0.5*G*1e-6 if kind == "chain" else 1 + 0.1*np.cos(np.sqrt(200)*1e-3)
    assert abs(end[1 if kind == "chain" else 0] - expected) <= 1e-8
