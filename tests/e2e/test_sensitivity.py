"""Derivatives of results by parameters, against extrapolated differences of runs at 1e-13 and closed forms; what is refused."""

import functools
import json
import math

import h5py
import numpy as np
import pytest
from support import ROOT, Run, assert_close, call, scratch, written

DRY = ROOT / "inputs/sensitivity_slider_crank.deck"
BUSHING = ROOT / "inputs/slider_crank_6_6_bushing.deck"
VALUES = {"c": (5e-4, "m"), "speed": (5000 * math.pi / 30, "rad/s"), "restitution": (0.9, ""), "young": (207e9, "Pa"),
          "rod": (0.21, "kg")}
STEPS = {"c": 4e-4, "speed": 2e-4, "restitution": 3e-4, "young": 1e-3, "rod": 5e-4}  # of differences, over the values
FREE = """
deck = 1
[scene]
gravity = 0 -10 m/s^2
[parameters]
height = 50 mm
friction = 0
word = elastic
[bodies]
name   mass[kg]   inertia[kg.m^2]   y
ball   0.5        0.1               {height + 100 mm}
[points]
name     body
origin   ground
centre   ball
[material]
name    young[GPa]   poisson   density[kg/m^3]
steel   207          0.3       7850
[clearance.plane]
name    plane    ball     axis   radius[mm]   material   law       friction
floor   origin   centre   y      100          steel      elastic   coulomb
[contact.hertz]
name
elastic
[friction.ambrosio]
name      coefficient   v0[m/s]   v1[m/s]
coulomb   {friction}    1e-4      1e-3
[analysis.dynamic]
start = given
end = 120 ms
[sensitivity]
"""


def study_of(program, deck, *options, expect=0):
    """summary.json of a study, and its directory."""
    directory = scratch()
    done = call(program, "sensitivity", deck, "--out", directory / "out", "--quiet", *options, expect=expect)
    if expect:
        return done
    return json.loads((directory / "out/summary.json").read_text()), directory / "out"


def numbers_of(program, deck, name, value, unit, columns, n):
    """Columns of the first contacts of a run with another value of a parameter."""
    directory = scratch()
    call(program, "run", deck, "--out", directory / "out", "--quiet", "--write", "channels", "--tolerance", "1e-13",
         "--method", "dop853", "--set", f"{name}={float(value)!r} {unit}".strip())
    return np.array([Run(directory / "out").contacts[column][:n] for column in columns])


def differences(program, deck, name, value, unit, part, columns, n):
    """Derivatives by differences of runs, extrapolated twice, and what the last extrapolation changed."""
    steps = []
    for k in range(3):
        high, low = value * (1 + part / 2**k), value * (1 - part / 2**k)
        above, below = (numbers_of(program, deck, name, x, unit, columns, n) for x in (high, low))
        steps.append((above - below) / (high - low))
    once = [(4 * steps[k + 1] - steps[k]) / 3 for k in (0, 1)]
    twice = (16 * once[1] - once[0]) / 15
    return twice, np.abs(twice - once[1])


STUDY = functools.cache(study_of)


def of(summary, kind, name, n, joint="gudgeon"):
    """Values and errors of a kind of results for the first contacts."""
    pairs = [summary["sensitivity"][f"{joint}.{kind}({k + 1})"][name] for k in range(n)]
    return np.array([pair["value"] for pair in pairs], float), np.array([pair["error"] for pair in pairs], float)


@pytest.mark.parametrize("name", VALUES)
def test_slider_crank(gudgeon, name):
    """Onsets of ten impacts, their speeds, and five peak forces by every parameter: within stated errors of differences of runs."""
    summary, _ = STUDY(gudgeon, DRY)
    value, unit = VALUES[name]
    right, unsure = differences(gudgeon, DRY, name, value, unit, STEPS[name], ("time", "impact_speed", "peak_force"), 10)
    for row, kind, n in ((0, "onset", 10), (1, "impact_speed", 10), (2, "peak_force", 5)):
        found, error = of(summary, kind, name, n)
        assert_close(found, right[row][:n], absolute=3 * error + 30 * unsure[row][:n], what=f"{kind} by {name}: stated errors")
        assert_close(found, right[row][:n], relative=1e-6 if kind == "onset" else 5e-6,
                     absolute=2e-7 * np.abs(right[row][:n]).max(), what=f"{kind} by {name}")


@pytest.mark.parametrize("method, close", [("verner", 1e-6), ("dop853", 1e-6), ("radau", 3e-5)])
def test_methods(gudgeon, method, close):
    """Explicit methods and an implicit one give the same, each within its stated errors."""
    summary, _ = STUDY(gudgeon, DRY)
    other, _ = study_of(gudgeon, DRY, "--method", method)
    for name in VALUES:
        a, error_a = of(summary, "onset", name, 7)
        b, error_b = of(other, "onset", name, 7)
        assert_close(b, a, absolute=3 * (error_a + error_b), what=f"{method} by {name}: stated errors")
        assert_close(b, a, relative=close, absolute=close * np.abs(a).max(), what=f"{method} by {name}")


def test_bushing_in_space(gudgeon):
    """A pin in a bushing in space: onsets by clearance and speed."""
    deck = written(scratch(), BUSHING.read_text().replace("end        = 83.7758 ms", "end        = 2 ms")
                   + "\n[sensitivity]\nparameters = c speed\nresults = gudgeon.onset(1..6)\n")
    summary, _ = study_of(gudgeon, deck)
    for name, value, unit, part in (("c", 5e-4, "m", 1e-3), ("speed", 150.0, "rad/s", 1e-3)):
        right, unsure = differences(gudgeon, deck, name, value, unit, part, ("time",), 6)
        found, error = of(summary, "onset", name, 6)
        assert_close(found, right[0], absolute=3 * error + 30 * unsure[0], what=f"by {name}: stated errors")
        assert_close(found, right[0], relative=1e-6, what=f"by {name}")


def test_files(gudgeon):
    """CSV and HDF5 have what summary.json has; the echo has the section."""
    summary, place = STUDY(gudgeon, DRY)
    lines = (place / "sensitivity.csv").read_text().splitlines()
    assert lines[0] == "result,parameter,value,error,unit,reason"
    assert len(lines) == 1 + 27 * 5
    assert "[sensitivity]" in (place / "deck.echo").read_text()
    with h5py.File(place / "sensitivity.h5") as file:
        results, names, values = (file[f"sensitivity/{name}"][()] for name in ("result", "parameter", "value"))
        for result, name, value in zip(results, names, values):
            there = summary["sensitivity"][result.decode().strip()][name.decode().strip()]["value"]
            assert (math.isnan(value) and there is None) or value == there
        assert file["sensitivity_results/value"].shape == (27,)
        assert np.all(file["sensitivity_parameters/grazing"][()] > 0)


def test_free_flight(gudgeon):
    """The elastic bounce of a ball: v = sqrt(2 g H); the second value is refused, as the motion has no second onset."""
    results = "floor.onset(1..2) floor.impact_speed(1) at(ball.position.y,50ms)"
    deck = written(scratch(), FREE + "parameters = height\nresults = " + results)
    summary, _ = study_of(gudgeon, deck)
    speed = math.sqrt(2 * 10 * 0.05)
    derivatives = summary["sensitivity"]
    assert_close(derivatives["floor.onset(1)"]["height"]["value"], 1 / speed, relative=1e-10)
    assert_close(derivatives["floor.impact_speed(1)"]["height"]["value"], 10 / speed, relative=1e-10)
    assert_close(derivatives["at(ball.position.y,50ms)"]["height"]["value"], 1, relative=1e-12)
    assert derivatives["floor.onset(2)"]["height"]["value"] is None
    assert "none until its end" in derivatives["floor.onset(2)"]["height"]["reason"]
    assert_close(summary["sensitivity_parameters"][0]["grazing"], 2 * 0.05, relative=1e-9, what="the speed by its derivative")


def test_instants(gudgeon):
    """A table that stops: the velocity of its driver jumps at an instant; a parameter that moves the instant is refused."""
    table = FREE
    for old, new in (("[points]\n", "table  5          1                 0m\n[points]\n"),
                     ("word = elastic", "v = 0.3 m/s\nt1 = 20 ms"), ("height = 50", "height = 10"),
                     ("centre   ball\n", "centre   ball\ntop      table\n"), ("floor   origin", "floor   top"),
                     ("[material]", "[joint.translational]\nname i j axis\nguide origin top y\n[driver.position]\n"
                      "name i j axis position\nshaker origin top y {v*min(t, t1)}\n[material]")):
        assert old in table
        table = table.replace(old, new)
    deck = written(scratch(), table + "parameters = v t1\nresults = floor.onset(1) floor.impact_speed(1)")
    summary, _ = study_of(gudgeon, deck)
    time = math.sqrt(2 * (0.01 - 0.3 * 0.02) / 10)
    assert_close(summary["sensitivity"]["floor.onset(1)"]["v"]["value"], -0.02 / (10 * time), relative=1e-9, what="onset")
    assert_close(summary["sensitivity"]["floor.impact_speed(1)"]["v"]["value"], -0.02 / time, relative=1e-9, what="speed")
    assert "depend on it" in summary["sensitivity"]["floor.onset(1)"]["t1"]["reason"]


@pytest.mark.parametrize("words, message", [
    ("parameters = hight\nresults = floor.onset(1)", "did you mean 'height'?"),
    ("parameters = word\nresults = floor.onset(1)", "parameter 'word' is a word"),
    ("parameters = height\nresults = floor.onsets(1)", "'floor.onsets(1)' is not a result"),
    ("parameters = height\nresults = flor.onset(1)", "'flor' is not a joint with clearance"),
    ("parameters = height\nresults = floor.onset(0)", "is not the number of an onset"),
    ("parameters = height\nresults = at(ball.position,1ms)", "is not a single number"),
    ("parameters = height\nresults = at(ball.position.y,1s)", "is not within the motion"),
    ("parameters = height\nresults = max(energy.kinetic)", "has no derivatives"),
])
def test_wrong_words(gudgeon, words, message):
    """Words of the section are checked, also by `check`."""
    deck = written(scratch(), FREE + words)
    for verb in ("check", "sensitivity"):
        assert message in call(gudgeon, verb, deck, expect=3).stderr


def test_parameter_at_a_bound(gudgeon):
    """A coefficient of friction of zero cannot be less: refused with what the deck says."""
    deck = written(scratch(), FREE + "parameters = friction height\nresults = floor.onset(1)")
    summary, _ = study_of(gudgeon, deck)
    pair = summary["sensitivity"]["floor.onset(1)"]["friction"]
    assert pair["value"] is None and "the deck does not take" in pair["reason"]
    assert summary["sensitivity"]["floor.onset(1)"]["height"]["value"] > 0


@pytest.mark.parametrize("options, message", [
    (("--method", "adams"), "is not a one-step method"),
    (("--method", "rock4"), "chooses its stages by the steps before"),
    (("--set", "height=40mm", "--method", "radou"), "did you mean 'radau'?"),
])
def test_methods_that_do_not(gudgeon, options, message):
    """Methods with a history are refused by name."""
    deck = written(scratch(), FREE + "parameters = height\nresults = floor.onset(1)")
    assert message in study_of(gudgeon, deck, *options, expect=2).stderr


def test_no_section(gudgeon):
    """A deck without the section."""
    assert "no section [sensitivity]" in study_of(gudgeon, ROOT / "inputs/slider_crank_dry.deck", expect=2).stderr
