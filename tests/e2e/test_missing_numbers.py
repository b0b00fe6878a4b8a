"""Numbers that are not known, or not known yet, in the build that traps arithmetic with them: nothing of it ends the program."""

import csv

import pytest
from support import ROOT, Run, call, changed, plain_deck, scratch, written

STATISTICS = "\n[statistics]\nafter = 1 ms\nperiod = 1 ms\nchannels = motor.moment\n"

RUBBING = """deck = 1
[bodies]
name    mass[kg]  inertia[kg.m^2]  x[m]   y[m]  angle[rad]
crank   0.3       2.55e-5          0.015  0     0
rod     0.2       1.6867e-4        0.08   0     0
slider  0.2       8.6667e-6        0.13   0     0
[points]
name   body    xi[m]   eta[m]
main   ground  0       0
heel   crank   -0.015  0
throw  crank   0.015   0
big    rod     -0.05   0
small  rod     0.05    0
eye    slider  0       0
[material]
name   young[GPa]  poisson
steel  70          0.3
[friction.lugre]
name     coefficient  static_coefficient  stribeck_speed[mm/s]
bristle  0.099219     0.36935             9.265
[friction.brown_mcphee]
name  coefficient  static_coefficient  v_t[mm/s]
way   0.055535     0.34601             27.261
[friction.dahl]
name   coefficient  stiffness[m^-1]  exponent
yield  0.055789     1e4              0.5
[contact.esdu]
name  restitution
law   1
[joint.revolute]
name     i      j     friction  radius[mm]
bearing  main   heel  bristle   5
pin      throw  big   none      5
[joint.translational]
name   i     j    axis  friction
guide  main  eye  x     way
[clearance.revolute]
name     bearing  journal  bearing_radius[mm]  clearance[mm]  length[mm]  material  law  friction
gudgeon  eye      small    20                  0.2847         10          steel     law  yield
[driver.speed]
name   joint    speed[rad/s]
motor  bearing  360.7
[analysis.dynamic]
method = rk4
solver = sparse
step = 10 us
end = 10 ms
"""


def short(*changes):
    """A few milliseconds of the dry slider-crank."""
    return plain_deck([("analysis.dynamic", "end", "4 ms"), ("output", "every", "1 ms"), *changes])


def test_a_case_without_a_run(gudgeon_debug):
    """A case of a sweep whose runs have all failed has no mean: its cells are empty."""
    directory = scratch()
    deck = written(directory, short() + STATISTICS + "\n[sweep]\nc = 0.5 20 mm\n")
    call(gudgeon_debug, "sweep", deck, "--out", directory / "out", "--jobs", 1, "--quiet", expect=8)
    rows = list(csv.DictReader((directory / "out" / "cases.csv").open()))
    assert [row["runs"] for row in rows] == ["1", "0"]
    assert float(rows[0]["motor.moment.rms mean [N.m]"]) > 0.0
    assert rows[1]["motor.moment.rms mean [N.m]"] == rows[1]["motor.moment.rms deviation [N.m]"] == ""


def test_statistics_of_few_instants_are_compared(gudgeon_debug):
    """The significance of means of five instants is not known: what differs by more than is allowed differs."""
    directory = scratch()
    for name, end in (("a", "4 ms"), ("b", "4 ms")):
        deck = written(directory, short(("analysis.dynamic", "end", end), ("parameters", "c", "0.5 mm" if name == "a" else "0.2 mm")))
        call(gudgeon_debug, "run", deck, "--quiet", "--out", directory / name)
    options = ("--quiet", "--statistics", "--out", directory / "c")
    call(gudgeon_debug, "compare", directory / "a", directory / "a", *options)
    call(gudgeon_debug, "compare", directory / "a", directory / "b", *options, expect=1)


@pytest.mark.parametrize("method", ["adams", "bdf", "ida"])
def test_gains_follow_before_the_first_step(gudgeon_debug, method):
    """A library of methods with a history has no step before its first: the gain that follows does without it."""
    directory = scratch()
    text = short(("analysis.dynamic", "method", method), ("analysis.dynamic", "stabilise", "baumgarte_adaptive"))
    call(gudgeon_debug, "run", written(directory, text), "--quiet", "--out", directory / "out")
    assert Run(directory / "out").summary["status"] == "complete"


def test_orbit_of_what_is_not_round(gudgeon_debug):
    """A ball on a plane has no clearance and no orbit, which is a mistake of the deck."""
    directory = scratch()
    text = changed((ROOT / "inputs" / "bouncing_ball.deck").read_text(), "output", figures="floor.orbit")
    done = call(gudgeon_debug, "check", written(directory, text), expect=3)
    assert "no orbit of 'floor'" in done.stderr


def test_no_accuracy_has_no_worst_channel(gudgeon_debug):
    """Where runs part before the first instant nothing is claimed, and no channel is named that limits it."""
    directory = scratch()
    output = {"figures": None, "from": None, "last": None, "every": "30 ms"}
    text = changed((ROOT / "inputs" / "slider_crank_two_joints.deck").read_text(), "output", **output)
    text = changed(text, "analysis.dynamic", end="60 ms")
    options = ("--accuracy", "1e-4", "--write", "channels", "--quiet")
    call(gudgeon_debug, "run", written(directory, text), "--out", directory / "out", *options, expect=6)
    accuracy = Run(directory / "out").summary["accuracy"]
    assert accuracy["claim"] == "none" and accuracy["limited_by"] == "" and accuracy["extremes"] == []


def test_an_accuracy_without_time_for_a_run(gudgeon_debug):
    """Where no run came to its end there is none to take: an error says why."""
    directory = scratch()
    options = ("--accuracy", "1e-9", "--budget", "1ms", "--quiet")
    done = call(gudgeon_debug, "run", written(directory, short()), "--out", directory / "out", *options, expect=5)
    assert "no run was completed: time budget exhausted" in done.stderr


def test_friction_that_diverges(gudgeon_debug):
    """Fixed steps that are far too long for bristles make forces beyond all bounds; the iteration that finds friction from them gives up."""
    directory = scratch()
    done = call(gudgeon_debug, "run", written(directory, RUBBING), "--out", directory / "out", "--quiet", expect=5)
    assert "the equations of motion cannot be solved" in done.stderr


def test_accuracy_of_what_is_no_number(gudgeon_debug):
    """A request without a number from some time on, and one that never has any, beside --accuracy: an interval for what there is."""
    directory = scratch()
    text = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]
ball  1         0.01             0     1
[request]
name   value                       unit
half   {log(ball.position.y/(1 m))}  1
never  {sqrt(-1 - t/(1 s))}          1
[analysis.dynamic]
end = 0.6 s
start = given
[output]
every = 10 ms
channels = ball.position request.half request.never
"""
    call(gudgeon_debug, "run", written(directory, text), "--accuracy", "1e-3", "--quiet", "--out", directory / "out", "--write", "channels")
    found = {entry["channel"]: entry for entry in Run(directory / "out").summary["extremes"]}
    assert found["request.never"]["greatest"] is None and found["request.half"]["greatest"] == 0


def test_figures_of_what_is_no_number_at_some_instants(gudgeon_debug):
    """A root of what is negative now and then: a curve, sections and portraits with gaps, no spectrum, and a warning instead."""
    directory = scratch()
    figures = "spectrum(request.root) section(request.root,motor.moment) request.root portrait(request.root,motor.moment) " \
              "motor.moment against request.root in 1 request.root + motor.moment"
    text = short(("output", "figures", figures), ("output", "every", "20 us")) + STATISTICS
    text += "\n[request]\nname value unit\nroot {sqrt(motor.moment/1N.m)} 1\n"
    done = call(gudgeon_debug, "run", written(directory, text), "--out", directory / "out")
    assert "no spectrum of 'request.root'" in done.stdout + done.stderr
    assert len(list((directory / "out" / "figures").glob("*.png"))) == 5
