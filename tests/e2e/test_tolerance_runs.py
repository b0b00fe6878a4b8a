"""Tolerances at the dynamic level: runs against closed forms, split of the variance, parts and killed studies, what is refused."""

import json
import math
import subprocess
import time

import h5py
import pytest
from support import ROOT, answer_signals, call, scratch, written

BALL = """
deck = 1
[scene]
title = "thrown ball"
gravity = 0 -10 m/s^2
[parameters]
h = 1 m
v = 4 m/s
k = 3 N
m = 1 kg
[bodies]
name mass[kg] inertia[kg.m^2] y vy
ball {m} 0.1 {h} {v}
[points]
name body
centre ball
[force.point]
name point fx
wind centre {k}
[tolerance]
name plus_minus distribution
h 0.1m uniform
v 0.5m/s uniform
k 0.6N triangular
[tolerance.limit]
name channel lower upper
high ball.position.y.max - 1.8m
[tolerance.study]
requests = ball.position.final ball.velocity.y.rms
members = 300
points = 60
seed = 2
[analysis.dynamic]
start = given
end = 0.5 s
tolerance = 1e-10
[output]
every = 0.01 s
"""
SLIDER_CRANK = ROOT / "inputs/studies/tolerance_study.deck"
FILES = ["tolerance.csv", "tolerance_derivatives.csv", "sweep.csv"]


def study(program, text, *options, **values):
    """summary.json of a study, and its directory."""
    directory = scratch()
    settings = [word for name, value in values.items() for word in ("--set", f"{name}={value}")]
    call(program, "tolerance", written(directory, text), "--out", directory / "out", "--quiet", *settings, *options)
    return json.loads((directory / "out/summary.json").read_text()), directory / "out"


def test_closed_forms(gudgeon):
    """Final values, maximum and rms of a throw: derivatives, worst case, standard deviations, indices, yield."""
    summary, out = study(gudgeon, BALL)
    assert summary["tolerance_study"]["level"] == "dynamic" and summary["tolerance_study"]["method"] == "runs"
    of, span = summary["tolerance"], 0.5
    final, high, rms = (of[f"ball.{name}"] for name in ("position.y.final", "position.y.max", "velocity.y.rms"))
    assert final["nominal"]["value"] == pytest.approx([1 + 4 * span - 5 * span**2], rel=1e-12)
    assert high["nominal"]["value"] == pytest.approx([1 + 4**2 / 20], rel=1e-9)
    assert rms["nominal"]["value"] == pytest.approx([math.sqrt(16 - 40 * span + 100 * span**2 / 3)], rel=5e-4)  # trapezoidal rule
    for name, by in ((final, {"h": 1, "v": span, "k": 0}), (high, {"h": 1, "v": 0.4, "k": 0})):
        for parameter, slope in by.items():
            assert name["derivative"][parameter]["value"] == pytest.approx([slope], abs=1e-8)
    assert of["ball.position.x.final"]["derivative"]["k"]["value"] == pytest.approx([span**2 / 2], rel=1e-9)
    assert high["band"]["value"] == pytest.approx([0.1 + 0.4 * 0.5], rel=1e-7)
    sigma = math.sqrt((0.1**2 + (0.4 * 0.5) ** 2) / 3)
    assert high["sigma"]["value"] == pytest.approx([sigma], rel=1e-7)
    assert high["sigma"]["sampled_low"][0] < sigma < high["sigma"]["sampled_high"][0]
    assert high["mean"]["value"] == pytest.approx([1.8 + 0.05 * 0.5**2 / 3], rel=1e-8)  # half the second derivative 1/g times s^2
    assert final["index"]["v"]["linear"] == pytest.approx([(span * 0.5) ** 2 / ((span * 0.5) ** 2 + 0.1**2)], rel=1e-8)
    for name in "hvk":
        index = final["index"][name]
        assert abs(index["value"][0] - index["linear"][0]) < index["high"][0] - index["low"][0]
    # v^2/20 + h <= 1.8: over the rectangle of h and v the mean of (1.9 - v^2/20... - 0.9)/0.2, cut at 0 and 1
    good = sum(min(max((1.8 - v * v / 20 - 0.9) / 0.2, 0), 1) for v in (3.5 + (i + 0.5) / 10000 for i in range(10000))) / 10000
    assert high["yield"]["low"] < good < high["yield"]["high"]
    assert high["yield"]["members"] == 300 and "variance" not in high
    capability = (1.8 - high["mean"]["sampled"][0]) / (3 * high["sigma"]["sampled"][0])
    assert high["capability"]["value"] == pytest.approx(capability, rel=1e-9) and final["capability"]["value"] is None
    with h5py.File(out / "tolerance.h5") as file:
        assert file["tolerance_times/sigma"].shape == (4,)
    assert len((out / "sweep.csv").read_text().splitlines()) == 1 + 1 + 6 + 300 + 5 * 60
    call(gudgeon, "check", out / "deck.echo")


def test_failed_members(gudgeon):
    """Members without a model are failed parts; derivatives that need one are zero, with a warning."""
    text = BALL.replace("k 0.6N triangular", "m 2kg uniform")
    summary, _ = study(gudgeon, text)
    common = summary["tolerance_study"]
    assert common["open"] / 300 == pytest.approx(0.25, abs=0.08)  # mass from -1 kg to 3 kg
    assert common["yield"]["value"] <= 1 - common["open"] / 300
    assert any("failed runs for some derivatives" in line for line in summary["warnings"])
    assert any("failed parts" in line for line in summary["warnings"])
    assert summary["tolerance"]["ball.position.x.final"]["derivative"]["m"]["value"] == [0]


def test_nominal_case_fails(gudgeon):
    """Without the nominal run there is no study."""
    text = BALL + "[guards]\nstop = ball.position.y > 1.2 m\n"
    text = text.replace("requests = ball.position.final", "requests = ball.position.final ball.velocity.x.mean")
    directory = scratch()
    bad = written(directory, text.replace("end = 0.5 s", "end = 0.5 s\nlimit_cpu = 1e-9 s"))
    assert "the nominal mechanism failed" in call(gudgeon, "tolerance", bad, "--out", directory / "out", "--quiet", expect=5).stderr


def test_settings(gudgeon):
    """`--set` gives a toleranced parameter another nominal value; the seed another sample; the same seed the same one."""
    first, _ = study(gudgeon, BALL, h="2m")
    assert first["tolerance"]["ball.position.y.final"]["nominal"]["value"] == pytest.approx([2.75], rel=1e-12)
    small = BALL.replace("members = 300\npoints = 60", "members = 20\npoints = 10")
    one, other = study(gudgeon, small)[0], study(gudgeon, small, "--jobs", "1")[0]
    assert one["tolerance"] == other["tolerance"]
    assert study(gudgeon, small.replace("seed = 2", "seed = 3"))[0]["tolerance"] != one["tolerance"]


def test_parts_and_kills(gudgeon):
    """Parts, and a study that was killed, give the very files of one that ran through."""
    text = BALL.replace("members = 300", "members = 100").replace("points = 60", "points = 20")
    whole, out = study(gudgeon, text)
    directory = scratch()
    deck = written(directory, text)
    for part in ("1/3", "3/3"):
        call(gudgeon, "tolerance", deck, "--out", directory / "parts", "--quiet", "--shard", part)
    call(gudgeon, "tolerance", deck, "--out", directory / "parts", "--quiet")
    command = [str(gudgeon), "tolerance", str(deck), "--out", str(directory / "killed"), "--quiet"]
    process = subprocess.Popen(command, preexec_fn=answer_signals)
    journal = directory / "killed/sweep.runs"
    while process.poll() is None and not (journal.exists() and journal.stat().st_size > 20000):
        time.sleep(0.01)
    process.kill()
    process.wait()
    before = journal.stat().st_size
    assert not (directory / "killed/tolerance.csv").exists() and before > 20000
    call(*command)
    for name in ("parts", "killed"):
        for file in FILES:
            assert (directory / name / file).read_bytes() == (out / file).read_bytes(), (name, file)
        again = json.loads((directory / name / "summary.json").read_text())
        assert again["tolerance"] == whole["tolerance"]


@pytest.mark.slow
def test_chaos_of_the_slider_crank(gudgeon):
    """Nearly all variance is within the motion where it is chaotic, nearly all between parts where it is not."""
    found = {}
    for c in ("0.5mm", "0.1mm"):
        directory = scratch()
        call(gudgeon, "tolerance", SLIDER_CRANK, "--set", f"c={c}", "--out", directory / "out", "--quiet", limit=600)
        summary = json.loads((directory / "out/summary.json").read_text())
        of = summary["tolerance"]["slider.acceleration.x.rms"]["variance"]
        assert of["share_within"]["value"] == pytest.approx(of["motion"] / (of["motion"] + of["parts"]), rel=1e-12)
        assert of["share_within"]["low"] <= of["share_within"]["value"] <= of["share_within"]["high"]
        assert of["members"] == 40
        assert "figures/tolerance_variance.png" in summary["figures"]
        found[c] = of["share_within"]
    assert found["0.5mm"]["value"] > 0.9 and found["0.5mm"]["low"] > 0.8
    assert found["0.1mm"]["value"] < 0.1 and found["0.1mm"]["high"] < 0.3


@pytest.mark.parametrize("old, new, words", [
    ("ball.velocity.y.rms", "ball.velocity.y", "'ball.velocity.y' is not a number of a run"),
    ("ball.velocity.y.rms", "ball.velocity.y.rmss", "did you mean 'ball.velocity.y.rms'"),
    ("ball.velocity.y.rms", "bull.velocity.y.rms", "bull"),
    ("ball.position.y.max", "ball.position.max", "is not a single number"),
    ("- 1.8m", "- 1.8s", "wrong dimension of a limit"),
    ("members = 300", "members = 1", "one member has no standard deviation"),
    ("points = 60", "points = 3", "too few points"),
    ("[tolerance.limit]", "[tolerance.joint]\nname pin\nball disc\n[tolerance.limit]", "at the kinematic level only"),
])
def test_refused(gudgeon, old, new, words):
    """Errors of the tables, by every verb that reads the deck."""
    assert old in BALL
    path = written(scratch(), BALL.replace(old, new, 1))
    for verb in ("tolerance", "check"):
        run = call(gudgeon, verb, path, expect=3)
        assert words in run.stderr, run.stderr


def test_nothing_to_study(gudgeon):
    """No scatter, no request."""
    start, end = BALL.index("[tolerance]"), BALL.index("[tolerance.limit]")
    for text, words in ((BALL[:start] + BALL[end:], "nothing scatters"),
                        (BALL[:end] + "[analysis" + BALL.split("[analysis")[1], "no requests of a run")):
        assert words in call(gudgeon, "tolerance", written(scratch(), text), expect=2).stderr


def test_indices_by_a_polynomial(gudgeon):
    """Sobol' points and a polynomial through 64 members: the mean of the throw and its indices are exact, without further runs."""
    text = BALL.replace("members = 300\npoints = 60\n", "members = 64\nindices = polynomial\nplan = sobol\n")
    summary, out = study(gudgeon, text)
    of, span = summary["tolerance"], 0.5
    by_h, by_v = 0.1**2 / 3, (0.5 * span) ** 2 / 3
    final, high = of["ball.position.y.final"], of["ball.position.y.max"]
    assert final["index"]["h"]["value"] == pytest.approx([by_h / (by_h + by_v)], rel=1e-12)
    assert final["index"]["v"]["total"] == pytest.approx([by_v / (by_h + by_v)], rel=1e-12)
    assert final["index"]["k"]["value"] == [0] and final["index_missed"] == 0
    # h + v^2/(2 g): with v = 4 (1 + x), variance of 0.8 (2 x + x^2)
    x = 0.125
    by_v = 0.8**2 * (4 * x**2 / 3 + x**4 * 4 / 45)
    assert high["index"]["h"]["value"] == pytest.approx([by_h / (by_h + by_v)], rel=1e-9)
    assert high["mean"]["sampled"] == pytest.approx([1.8 + 0.8 * x**2 / 3], rel=1e-6)
    with h5py.File(out / "tolerance.h5") as file:
        assert file["tolerance_requests/missed"][...].max() < 1e-12
    assert len((out / "sweep.csv").read_text().splitlines()) == 1 + 1 + 2 * 3 + 64


def test_polynomials_are_refused(gudgeon, root):
    """At the kinematic level, of an ensemble, and more numbers than a Sobol' sequence has: in words."""
    four_bar = (root / "inputs/tolerance_four_bar.deck").read_text()
    done = call(gudgeon, "tolerance", written(scratch(), four_bar + "\n[tolerance.study]\nindices = polynomial\n"), expect=2)
    assert "indices = polynomial is of the dynamic level" in done.stderr
    several = BALL.replace("points = 60", "indices = polynomial") + "[ensemble]\nruns = 2\n"
    done = call(gudgeon, "tolerance", written(scratch(), several), expect=2)
    assert "indices = polynomial needs one run of a member" in done.stderr
    many = "\n".join(f"q{k} = 1 m" for k in range(54))
    rows = "\n".join(f"q{k} 0.1m uniform" for k in range(54))
    text = BALL.replace("[parameters]", "[parameters]\n" + many).replace("k 0.6N triangular", "k 0.6N triangular\n" + rows)
    done = call(gudgeon, "tolerance", written(scratch(), text.replace("points = 60", "points = 60\nplan = sobol")), expect=2)
    assert "plan = sobol takes up to 53 random numbers, and a member has 57" in done.stderr


def test_a_polynomial_that_misses_too_much(gudgeon):
    """In chaos a polynomial of the parameters tells nothing: no indices, and a warning says how much it misses."""
    text = SLIDER_CRANK.read_text()
    text = text[: text.index("[ensemble]")] + text[text.index("[statistics]") :]
    text = text.replace("motor.moment.rms", "slider.velocity.x.final").replace("members  = 40", "members = 40\nindices = polynomial")
    summary, _ = study(gudgeon, text)
    rms = summary["tolerance"]["slider.acceleration.x.rms"]
    assert rms["index_missed"] > 0.2 and rms["index"]["c"]["value"] == [None] and rms["index"]["c"]["total"] == [None]
    assert any("of the variance of slider.acceleration.x.rms: it has no indices" in words for words in summary["warnings"])
