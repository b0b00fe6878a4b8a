"""Parameters from data: an oscillator and a bouncing ball by their closed forms, intervals, unseen parameters, sets, windows, errors."""

import csv
import json
import math
import random
import subprocess

import h5py
import numpy as np
import pytest
from support import ROOT, assert_close, call, scratch, written

BOUNCE, RECORD = ROOT / "inputs/fit_restitution.deck", ROOT / "inputs/fit_restitution.csv"
STIFFNESS, MASS, X0, V0 = 200.0, 2.0, 0.05, 0.3   # N/m, kg, m, m/s
OSCILLATOR = """
deck = 1
[scene]
gravity = 0 0 m/s^2
[parameters]
k = 150 N/m
m = 2 kg
x0 = 50 mm
v0 = 0.3 m/s
t0 = 0 s
inertia = 1e-3 kg.m^2
word = linear
[bodies]
name   mass   inertia     x      vx
block  {m}    {inertia}   {x0}   {v0}
[points]
name     body     xi[m]   eta[m]
anchor   ground   -1      0
origin   ground   0       0
centre   block    0       0
[joint.translational]
name    i        j        axis
guide   origin   centre   x
[force.spring]
name     i        j        stiffness   free_length[m]
spring   anchor   centre   {k}         1
[analysis.dynamic]
start = given
end = 2 s
"""
PENDULUM = """
deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[parameters]
m = 1 kg
[bodies]
name    mass[kg]   inertia[kg.m^2]   x[m]   y[m]
upper   1          0.01              0.5    0
lower   {m}        0.01              1.5    0
[points]
name   body     xi[m]   eta[m]
wall   ground   0       0
heel   upper    -0.5    0
tip    upper    0.5     0
top    lower    -0.5    0
[joint.revolute]
name    i      j
base    wall   heel
elbow   tip    top
[analysis.dynamic]
start = given
end = 20 s
[output]
every = 50 ms
channels = lower.position
"""
SENSOR = "[fit.sensor]\nname channel column offset delay\nlaser block.position.x x {offset} {delay}\n"


def motion(t, x0=X0, v0=V0, k=STIFFNESS, m=MASS):
    """Position of the oscillator."""
    w = math.sqrt(k / m)
    return x0 * math.cos(w * t) + v0 / w * math.sin(w * t)


def data(folder, rows, name="data.csv", heading="time [s],x [mm]"):
    """A file of data."""
    (folder / name).write_text(heading + "\n" + "\n".join(",".join(repr(float(x)) for x in row) for row in rows) + "\n")
    return folder / name


def fit_of(program, deck, *files, options=("--write", "numbers"), expect=0):
    """The summary of a fit, or what was said if it fails."""
    folder = scratch()
    done = call(program, "fit", written(folder, deck) if isinstance(deck, str) else deck, *files, "--out", folder / "out", "--quiet", *options,
                expect=expect)
    return done if expect else json.loads((folder / "out/summary.json").read_text())


def oscillator(unknowns, offset="-", delay="-", more=""):
    """The deck with its tables."""
    return OSCILLATOR + f"[fit]\nname lower upper\n{unknowns}\n" + SENSOR.format(offset=offset, delay=delay) + more


def test_stiffness_without_noise(gudgeon):
    """Stiffness, start, offset and delay of the sensor come out to the accuracy of the motion."""
    rows = [(t, 1e3 * (motion(t - 0.004) + 0.003)) for t in np.linspace(0.05, 1.9, 150)]
    deck = oscillator("k 100N/m 300N/m\nv0 0m/s 1m/s", offset="10mm", delay="10ms")
    found = fit_of(gudgeon, deck, data(scratch(), rows))["fit"]
    for name, value in {"k": STIFFNESS, "v0": V0, "laser.offset": 0.003, "laser.delay": 0.004}.items():
        assert_close(found[name]["value"], value, relative=1e-6, what=name)
        assert found[name]["seen"] and found[name]["high"] - found[name]["low"] < 1e-4 * abs(value)


def test_intervals(gudgeon):
    """Standard deviations and correlation are those of the closed form's derivatives; a given sigma has the normal quantile."""
    random.seed(5)
    sigma, times = 2e-3, np.linspace(0.0, 2.0, 101)
    rows = [(t, 1e3 * (motion(t) + random.gauss(0, sigma))) for t in times]
    deck = oscillator("k 100N/m 300N/m\nv0 0m/s 1m/s")
    summary = fit_of(gudgeon, deck, data(scratch(), rows))
    found = summary["fit"]
    k, v0 = found["k"]["value"], found["v0"]["value"]
    step = 1e-5
    jac = np.array([[(motion(t, k=k * (1 + step), v0=v0) - motion(t, k=k * (1 - step), v0=v0)) / (2 * step * k),
                     (motion(t, k=k, v0=v0 + step) - motion(t, k=k, v0=v0 - step)) / (2 * step)] for t in times])
    residuals = np.array([motion(t, k=k, v0=v0) - x / 1e3 for t, x in rows])
    assert_close(jac.T @ residuals / (np.linalg.norm(jac, axis=0) * np.linalg.norm(residuals)), 0 * jac[0], absolute=1e-4, what="minimum")
    cov = residuals @ residuals / (len(times) - 2) * np.linalg.inv(jac.T @ jac)
    assert_close([found[name]["deviation"] for name in ("k", "v0")], np.sqrt(np.diag(cov)), relative=1e-4, what="deviations")
    assert_close(summary["fit_correlations"][0]["correlation"], cov[0, 1] / math.sqrt(cov[0, 0] * cov[1, 1]), absolute=1e-4)
    assert_close(found["k"]["high"] - found["k"]["low"], 2 * 1.9842169 * found["k"]["deviation"], relative=1e-5, what="Student, 99")
    assert found["k"]["low"] < STIFFNESS < found["k"]["high"] and found["v0"]["low"] < V0 < found["v0"]["high"]
    given = deck.replace("name channel column offset delay", "name channel column sigma").replace("x - -", "x 2mm")
    found = fit_of(gudgeon, given, data(scratch(), rows))["fit"]
    assert_close(found["k"]["deviation"], sigma * math.sqrt(np.linalg.inv(jac.T @ jac)[0, 0]), relative=1e-3, what="given")
    assert_close(found["k"]["high"] - found["k"]["low"], 2 * 1.9599640 * found["k"]["deviation"], relative=1e-6, what="normal")


def test_not_seen(gudgeon):
    """A parameter without influence is named, and two that act by their ratio only cannot be told from each other."""
    rows = [(t, 1e3 * motion(t) + (-1) ** i) for i, t in enumerate(np.linspace(0.0, 2.0, 51))]
    summary = fit_of(gudgeon, oscillator("k 100N/m 300N/m\ninertia 1e-4kg.m^2 1e-2kg.m^2"), data(scratch(), rows))
    assert not summary["fit"]["inertia"]["seen"] and summary["fit"]["k"]["seen"]
    assert any("the data do not see 'inertia'" in warning for warning in summary["warnings"])
    assert_close([summary["fit"]["inertia"][end] for end in ("low", "high")], [1e-4, 1e-2], relative=1e-2)
    assert summary["fit"]["k"]["low"] < STIFFNESS < summary["fit"]["k"]["high"]
    summary = fit_of(gudgeon, oscillator("k 100N/m 300N/m\nm 1kg 3kg"), data(scratch(), rows))
    assert any("'k'; it cannot be separated from 'm'" in warning for warning in summary["warnings"])
    assert_close(summary["fit"]["k"]["value"] / summary["fit"]["m"]["value"], STIFFNESS / MASS, relative=2e-2)


def test_sets(gudgeon):
    """Two files with other starts, and one file cut into windows whose starts are unknown too: multiple shooting."""
    folder = scratch()
    times = np.linspace(0.0, 2.0, 101)
    files = [data(folder, [(t, 1e3 * motion(t, x0=x)) for t in times], f"{x}.csv") for x in (0.05, -0.02)]
    sets = "[fit.set]\nname file set\na 1 -\nb 2 \"x0=-20mm\"\n"
    found = fit_of(gudgeon, oscillator("k 100N/m 300N/m\nv0 0m/s 1m/s", more=sets), *files)["fit"]
    assert_close([found["k"]["value"], found["v0"]["value"]], [STIFFNESS, V0], relative=1e-6)
    windows = "[fit.set]\nname from to\nfirst 0s 1s\nsecond 1s 2s\n"
    deck = oscillator("k 100N/m 300N/m no\nx0 -0.2m 0.2m yes\nv0 -1m/s 1m/s yes", more=windows).replace("lower upper", "lower upper each")
    found = fit_of(gudgeon, deck, files[0])["fit"]
    w = math.sqrt(STIFFNESS / MASS)
    speed = -X0 * w * math.sin(w) + V0 * math.cos(w)
    truth = {"k": STIFFNESS, "x0.first": X0, "v0.first": V0, "x0.second": motion(1.0), "v0.second": speed}
    assert_close([found[name]["value"] for name in truth], list(truth.values()), relative=1e-6, what="windows")


def test_bouncing_ball(gudgeon):
    """The deck of inputs: the closed form's parameters are in their intervals, files agree, figures are drawn."""
    folder = scratch()
    call(gudgeon, "fit", BOUNCE, RECORD, "--out", folder / "out", "--quiet")
    summary = json.loads((folder / "out/summary.json").read_text())
    for name, value in {"e": 0.8, "height": 0.3, "camera.offset": 0.002}.items():
        assert summary["fit"][name]["low"] < value < summary["fit"][name]["high"], name
    assert summary["fit"]["e"]["deviation"] < 2e-4 and summary["warnings"] == []
    assert_close(summary["fit_sensors"][0]["sigma"], 1e-3, relative=0.1, what="noise")
    with (folder / "out/fit.csv").open() as file:
        rows = list(csv.DictReader(file))
    square = sum(float(row["residual"]) ** 2 for row in rows)
    assert_close(square / (len(rows) - 3), summary["fit_search"]["deviation"] ** 2, relative=1e-6, what="residuals")
    with h5py.File(folder / "out/fit.h5") as file:
        assert_close(file["fit/value"][0], summary["fit"]["e"]["value"], relative=1e-15)
        assert file["fit_data/residual"].shape == (301,)
    assert "[fit.sensor]" in (folder / "out/deck.echo").read_text()
    for name in ("fit", "fit_residuals", "fit_ellipses"):
        assert (folder / f"out/figures/{name}.png").stat().st_size > 5000


def test_record_is_the_closed_form():
    """The data of inputs are those of the script."""
    assert subprocess.run([ROOT / "scripts/make_fit_data", "--check"], check=False).returncode == 0


def test_beyond_the_horizon(gudgeon):
    """Chaotic: data after the motion has lost its digits are left out, with the time; stages lead the search to the parameter."""
    deck = PENDULUM + "[fit]\nname lower upper start\nm 0.5kg 2kg 0.9kg\n[fit.sensor]\nname channel column\nx lower.position.x x\n"
    deck += "[fit.study]\ntolerance = 1e-7\nuntil = \"0.5 1 1.5 2 2.5 3 s\"\n"
    folder = scratch()
    call(gudgeon, "run", written(folder, PENDULUM), "--out", folder / "run", "--quiet", "--csv", "--tolerance", "1e-12", "--method", "dop853")
    random.seed(3)
    with (folder / "run/lower.csv").open() as file:
        rows = [(float(row["time[s]"]), 1e3 * (float(row["lower.position.x[m]"]) + random.gauss(0, 1e-3))) for row in csv.DictReader(file)]
    summary = fit_of(gudgeon, deck, data(scratch(), rows))
    assert any("are not fitted: the motion is beyond its horizon" in warning for warning in summary["warnings"]), summary["warnings"]
    assert 30 < summary["fit_search"]["data"] < len(rows) - 20
    assert summary["fit"]["m"]["low"] < 1.0 < summary["fit"]["m"]["high"]
    assert summary["fit"]["m"]["deviation"] < 1e-3


@pytest.mark.parametrize("old, new, message", [
    ("k 100N/m 300N/m", "kk 100N/m 300N/m", "'kk' is not a parameter of the deck"),
    ("k 100N/m 300N/m", "word 1 2", "parameter 'word' is a word"),
    ("k 100N/m 300N/m", "k 100N 300N/m", "wrong dimension of lower"),
    ("k 100N/m 300N/m", "k 300N/m 100N/m", "the upper bound is not above the lower one"),
    ("k 100N/m 300N/m", "k 200N/m 300N/m", "is not within its bounds"),
    ("block.position.x", "block.position", "is not a single number"),
    ("block.position.x", "energy.kinetic", "has no derivatives"),
    ("x - -", "x 3s -", "wrong dimension of a sensor"),
    ("x - -", "x 0mm -", "the maximum offset must be positive"),
    ("[fit.study]", "[fit.study]\nuntil = \"2 1 s\"", "not positive and ascending"),
    ("[fit.study]", "[fit.set]\nname set\na x0\n[fit.study]", "is not NAME=VALUE"),
])
def test_wrong_words(gudgeon, old, new, message):
    """Words of the tables are checked, also by `check`."""
    deck = oscillator("k 100N/m 300N/m", more="[fit.study]\n")
    assert old in deck
    deck = written(scratch(), deck.replace(old, new))
    assert message in call(gudgeon, "check", deck, expect=3).stderr
    assert message in call(gudgeon, "fit", deck, RECORD, expect=3).stderr


def test_wrong_data(gudgeon):
    """Missing files, columns and times are named."""
    deck = oscillator("k 100N/m 300N/m")
    file = data(scratch(), [(0.0, 1.0), (1.0, 2.0)])
    assert "needs a deck and its data" in fit_of(gudgeon, deck, expect=2).stderr
    assert "cannot read" in fit_of(gudgeon, deck, "nowhere.csv", expect=9).stderr
    assert "no column 'x'" in fit_of(gudgeon, deck, RECORD, expect=2).stderr
    assert "no data within the motion" in fit_of(gudgeon, deck, data(scratch(), [(5.0, 1.0), (6.0, 2.0)]), expect=2).stderr
    assert "too few for 2 unknowns" in fit_of(gudgeon, oscillator("k 100N/m 300N/m\nv0 0m/s 1m/s"), file, expect=5).stderr
    assert "in file 2" in fit_of(gudgeon, deck + "[fit.set]\nname file\na 2\n", file, expect=2).stderr
    assert "no table [fit]" in fit_of(gudgeon, ROOT / "inputs/slider_crank_dry.deck", file, expect=2).stderr
    assert "is not a one-step method" in fit_of(gudgeon, deck, file, options=("--method", "adams"), expect=2).stderr
