"""Groups of bodies that nothing joins: each with its own steps, its motion as if all were integrated together, or it were alone."""

import math

import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, changed, plain, scratch, written

DECK = (ROOT / "inputs/hard/side_by_side.deck").read_text()
RADIUS, GRAVITY = 0.01, 9.81


def run_of(program, text, *words, write="channels"):
    """Run a deck's text."""
    directory = scratch()
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", "--write", write, *words)
    return Run(directory / "out", done)


def events_of(run):
    """The events in an order that does not depend on round-off."""
    return sorted(run.read("events"), key=lambda row: (row["item"], row["contact"], row["time"]))


@pytest.mark.parametrize("method", ["verner", "dop853", "rock4", "radau", "adams", "bdf", "ida"])
def test_apart_as_together(gudgeon, method):
    """All events and the motion are the same to what the tolerance allows, the loads' instants and friction's among them."""
    tolerance = {"bdf": "5e-11", "adams": "8e-12"}.get(method, "1e-10")  # whose errors are the largest, or scatter most
    text = changed(DECK, "analysis.dynamic", method=method, tolerance=tolerance)
    apart, together = (run_of(gudgeon, text, "--set", f"groups={word}") for word in ("apart", "together"))
    assert (apart.summary["groups"], together.summary["groups"]) == (6, 1)
    assert len(apart.read("events")) > 20
    for one, other in zip(events_of(apart), events_of(together), strict=True):
        assert (one["item"], one["kind"], one["state_after"]) == (other["item"], other["kind"], other["state_after"])
        assert_close(one["time"], other["time"], absolute=1e-6, what="time of an event")
        if one["kind"] == b"contact":
            assert_close(one["peak_force"], other["peak_force"], absolute=1e-3, relative=1e-6, what="peak force")
            assert_close(one["energy_lost"], other["energy_lost"], absolute=1e-8, what="energy lost")
    for channel in ("position", "angle", "velocity"):
        assert_close(apart.read(f"bodies/{channel}")[-1], together.read(f"bodies/{channel}")[-1], absolute=3e-7, what=channel)
    for term in ("kinetic", "potential", "load_work", "dissipated_contact", "dissipated_friction"):
        assert_close(apart.read(f"energy/{term}")[-1], together.read(f"energy/{term}")[-1], absolute=1e-7, what=term)
    assert apart.summary["energy_residual_max"] < 1e-8 * apart.summary["energy_max"]


def test_what_is_told(gudgeon):
    """Rows at contacts, strobes, warnings of guards and of drivers are those of the whole."""
    slow_waves = DECK.replace("0.3       7850", "0.3       1e8")  # a warning of the guard impact_speed
    text = slow_waves + "\n[statistics]\nafter = 50 ms\nperiod = 1 turns of motor\nchannels = loose.normal_force\n"
    apart, together = (run_of(gudgeon, text, "--set", f"groups={word}") for word in ("apart", "together"))
    for kind in ("onset_rows", "peak_rows", "end_rows", "contacts", "samples"):
        assert apart.summary[kind] == together.summary[kind] > 0
    assert np.all(np.diff(apart.rows("time")) >= 0)
    greatest = apart.rows("clearances/contacts/normal_force").max(axis=0)
    for joint, force in zip(apart.read("clearances/contact_joint"), greatest, strict=True):
        peaks = [row["peak_force"] for row in apart.contacts if plain(row["item"]) == plain(joint)]
        assert_close(force, max(peaks), relative=1e-6, what=plain(joint))

    def subjects(run):
        return [warning.split(":")[0].split(" at ")[0] for warning in run.summary["warnings"]]

    assert sorted(subjects(apart)) == sorted(subjects(together))
    assert any("quasi-static" in warning for warning in apart.summary["warnings"])
    strobes = [run.summary["statistics"]["loose.impacts_per_period"] for run in (apart, together)]
    assert strobes[0] == strobes[1] > 0


def test_explained(gudgeon):
    """`explain` tells the groups, and why they stay together where they must."""
    directory = scratch()
    path = written(directory, DECK)
    assert "6 independent groups of bodies, integrated separately" in call(gudgeon, "explain", path).stdout
    assert "integrated together (groups = together)" in call(gudgeon, "explain", path, "--set", "groups=together").stdout
    path = written(directory, DECK + "\n[guards]\nstop = ring.position.y < 0.38m\n", "stopped.deck")
    assert "integrated together (a stop condition applies to all of them)" in call(gudgeon, "explain", path).stdout
    run = run_of(gudgeon, path.read_text())
    assert run.summary["groups"] == 1
    ring = [plain(name).strip() for name in run.read("bodies/names")].index("ring")
    assert_close(run.rows("bodies/position")[-1, ring, 1], 0.38, absolute=1e-9, what="where the run stops")
    path = written(directory, changed(DECK, "analysis.dynamic", maximum_steps="100000"), "counted.deck")
    assert "integrated together (a limit applies to the sum of their steps or evaluations)" in call(gudgeon, "explain", path).stdout


def balls(n, groups="apart"):
    """A deck of n elastic balls that fall from different heights, and the heights."""
    heights = [0.02 + 0.03 * ((k * 0.618034) % 1) for k in range(n)]
    lines = ["deck = 1", "[scene]", f"gravity = 0 -{GRAVITY} m/s^2", "[bodies]", "name mass[kg] inertia[kg.m^2] x[m] y[m]"]
    lines += [f"b{k} 0.1 1e-5 {k * 0.1:.3f} {height:.17g}" for k, height in enumerate(heights)]
    lines += ["[points]", "name body xi[m] eta[m]", "o ground 0 0"] + [f"c{k} b{k} 0 0" for k in range(n)]
    lines += ["[clearance.plane]", "name plane ball axis radius[m] material law"]
    lines += [f"f{k} o c{k} y {RADIUS} steel h" for k in range(n)]
    lines += ["[material]", "name young[GPa] poisson", "steel 207 0.3", "[contact.hertz]", "name", "h", "[analysis.dynamic]"]
    lines += ["start = given", "end = 80 ms", "tolerance = 1e-8", f"groups = {groups}", "[output]", "every = 20 ms"]
    return "\n".join([*lines, "channels = b0.*", ""]), heights


def test_balls_fall_and_bounce(gudgeon):
    """First onsets of 60 balls are those of free fall; elastic balls come back with the speed they had."""
    text, heights = balls(60)
    run = run_of(gudgeon, text)
    assert run.summary["groups"] == 60
    first = {}
    for row in run.contacts:
        first.setdefault(row["item"], row)
    for k, height in enumerate(heights):
        fall = height - RADIUS
        time = math.sqrt(2 * fall / GRAVITY)
        if time > 0.0799:
            continue
        row = first[f"f{k}".encode()]
        assert_close(row["time"], time, absolute=1e-12, what=f"onset of ball {k}")
        assert_close(row["impact_speed"], math.sqrt(2 * GRAVITY * fall), relative=1e-12, what=f"speed of ball {k}")
        if math.isfinite(row["release_speed"]):
            assert_close(row["release_speed"], row["impact_speed"], relative=1e-7, what=f"restitution of ball {k}")


def test_work_is_that_of_each(gudgeon):
    """An impact of one ball costs the others nothing: evaluations, each of one ball, grow with the number of balls; together they
    grow with its square."""
    cost = {n: run_of(gudgeon, balls(n)[0], write="numbers").summary["rhs_evaluations"] / n for n in (50, 400)}
    assert abs(cost[400] - cost[50]) < 0.05 * cost[50]
    together = {n: run_of(gudgeon, balls(n, "together")[0], write="numbers").summary["rhs_evaluations"] for n in (50, 100)}
    assert together[100] > 1.8 * together[50] > 10 * cost[50]


def test_groups_of_driven_bodies(gudgeon):
    """Bodies that drivers alone move go with a group that has unknowns; where there is none, they make their own."""
    driven = "\n".join(
        ["deck = 1", "[bodies]", "name mass[kg] inertia[kg.m^2] x[m] y[m]", "a 1 1 0 0", "b 1 1 1 0", "[points]"]
        + ["name body xi[m] eta[m]", "ga ground 0 0", "gb ground 1 0", "pa a 0 0", "pb b 0 0", "[joint.revolute]", "name i j"]
        + ["ja ga pa", "jb gb pb", "[driver.speed]", "name joint speed", "ma ja 1rad/s", "mb jb 2rad/s", "[analysis.dynamic]"]
        + ["end = 1 s", "[output]", "every = 0.1 s", ""]
    )
    run = run_of(gudgeon, driven)
    assert run.summary["groups"] == 2
    assert_close(run.read("bodies/angle")[-1], [1.0, 2.0], absolute=1e-9, what="angles")
    free = driven.replace("[points]", "c 1 1 2 0\n[points]")
    run = run_of(gudgeon, free)
    assert run.summary["groups"] == 1
    assert_close(run.read("bodies/angle")[-1], [1.0, 2.0, 0.0], absolute=1e-12, what="angles")


@pytest.mark.parametrize("groups", ["apart", "together"])
@pytest.mark.parametrize("method", ["verner", "dop853", "rock4", "radau", "adams", "bdf", "ida"])
def test_work_of_a_driver_beside_what_flies(gudgeon, method, groups):
    """A ball that falls asks for no steps; those that the work of a driver takes are made all the same, as where it is alone."""
    text = "\n".join(
        ["deck = 1", "[scene]", "gravity = 0 -9.81 m/s^2", "[bodies]", "name mass[kg] inertia[kg.m^2] x[m] y[m]"]
        + ["arm 2.5 0.033 0.2 0", "ball 2.5 5e-4 5 5", "[points]", "name body xi[m] eta[m]", "o ground 0 0", "heel arm -0.2 0", "[joint.revolute]", "name i j", "pin o heel", "[driver.angle]"]
        + ["name joint angle", "shaker pin {0.5rad*sin(30rad/s*t)}", "[analysis.dynamic]", "end = 1 s", f"groups = {groups}", "[output]"]
        + ["every = 10 ms", ""]
    )
    run = run_of(gudgeon, changed(text, "analysis.dynamic", method=method))
    assert run.summary["energy_residual_max"] < 1e-6 * run.summary["energy_max"] and not run.summary["warnings"]
    rate = 15.0 * np.cos(30.0 * run.time)  # of the angle 0.5 rad sin(30/s t) [rad/s]
    kinetic = 0.5 * (0.033 + 2.5 * 0.2**2) * (rate**2 - 15.0**2)
    potential = 2.5 * 9.81 * 0.2 * np.sin(0.5 * np.sin(30.0 * run.time))
    assert_close(run.read("energy/drive_work").ravel(), kinetic + potential, absolute=1e-3, what="work")


def test_ideal_twin_is_assembled_as_such(gudgeon):
    """The overlaid twin starts with velocities that its ideal joints allow, also where another contact has no ideal joint."""
    directory = scratch()
    done = call(gudgeon, "run", written(directory, DECK), "--out", directory / "out", "--set", "groups=together")
    assert "no overlay of ideal joints" not in done.stdout + done.stderr
    assert (directory / "out/ring.ideal.dat").exists()
