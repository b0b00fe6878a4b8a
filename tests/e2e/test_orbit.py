"""Periodic orbits against exact impact maps, extrapolated in the stiffness; bifurcations; the horizon; what is refused."""

import csv
import json
import math

import h5py
import numpy as np
import pytest
from support import ROOT, assert_close, call, scratch, written

STIFFNESS = (1e9, 32e9, 1024e9)  # N/m^1.5; the time of a contact goes with the power -0.4: a quarter each
ONLY = ("parameter ", "from  ", "to  ")


def orbit_of(program, deck, *sets, options=(), expect=0, limits=None):
    """Object `orbit` of summary.json, and its directory. Limits: the range of the branch; none: no branch."""
    directory = scratch()
    text = (ROOT / "inputs" / f"{deck}.deck").read_text()
    lines = text.splitlines()
    start = lines.index("[orbit]")
    for k in range(start, start + 7):
        if limits is None and lines[k].startswith(ONLY):
            lines[k] = ""
        elif limits is not None and lines[k].split() and lines[k].split()[0] in limits:
            lines[k] = f"{lines[k].split()[0]} = {limits[lines[k].split()[0]]}"
    words = [word for name in sets for word in ("--set", name)]
    done = call(program, "orbit", written(directory, "\n".join(lines) + "\n"), "--out", directory / "out", "--quiet", *words, *options,
                expect=expect)
    if expect:
        return done
    return json.loads((directory / "out/summary.json").read_text())["orbit"], directory / "out"


def extrapolated(values):
    """The limit of values whose error is a series in a quantity that is a quarter in each next one."""
    factor = 4
    while len(values) > 1:
        values = [(factor * b - a) / (factor - 1) for a, b in zip(values, values[1:])]
        factor *= 4
    return values[0]


def rigid(program, deck, *sets, **keywords):
    """Phase, multipliers and bifurcations in the limit of rigid contacts."""
    orbits = [orbit_of(program, deck, f"stiffness={k:.17g} N/m^1.5", *sets, **keywords)[0] for k in STIFFNESS]
    mu = extrapolated([np.array([complex(*pair) for pair in orbit["multipliers"]]) for orbit in orbits])
    found = [[b["type"] for b in orbit["bifurcations"]] for orbit in orbits]
    assert found[0] == found[1] == found[2]
    values = [extrapolated([orbit["bifurcations"][k]["value"] for orbit in orbits]) for k in range(len(found[0]))]
    return extrapolated([orbit["phase"] for orbit in orbits]), mu, list(zip(found[0], values)), orbits


def ball_limits(e):
    """Fold and period doubling of the ball."""
    low = math.pi * (1 - e) / (1 + e)
    return low, math.hypot(low, 2 * (1 + e**2) / (1 + e)**2)


@pytest.mark.parametrize("e, gamma", [(0.5, 1.2), (0.6, 1.3), (0.5, 1.7)])
def test_shaken_ball(gudgeon, e, gamma):
    """Phase and multipliers: closed forms; the last orbit is unstable."""
    phase, mu, _, orbits = rigid(gudgeon, "shaken_ball", f"e={e}", f"gamma={gamma}")
    low, high = ball_limits(e)
    phi = math.acos(low / gamma)
    trace = 1 + e**2 - (1 + e)**2 * gamma * math.sin(phi)
    right = np.roots([1, -trace, e**2])
    assert_close(phase, phi, absolute=1e-6, what="phase")
    assert abs(orbits[0]["phase"] - phi) > 1e-6, "a finite stiffness is seen"
    for value in right:
        assert_close(np.min(abs(mu - value)), 0, absolute=1e-5, what="multiplier")
    assert orbits[-1]["stable"] == (gamma < high)
    assert [len(orbit["events"]) for orbit in orbits] == [1, 1, 1]
    assert_close(orbits[0]["period"], 2 * math.pi / 100, relative=1e-12, what="period")


@pytest.mark.slow
def test_bifurcations_of_the_ball(gudgeon):
    """Fold and period doubling at their closed forms, for another coefficient of restitution than the deck's."""
    e = 0.6
    _, _, found, _ = rigid(gudgeon, "shaken_ball", f"e={e}", "gamma=1.0", limits={"from": "0.7", "to": "1.5"})
    assert [name for name, _ in found] == ["fold", "period_doubling"]
    assert_close([value for _, value in found], ball_limits(e), absolute=1e-5, what="fold and period doubling")


def pair(e, a, branch):
    """Phase, speed before the impact and derivative of the map over half a period, reflected, of the exact map with b = w = 1."""
    alpha = (1 + e) / (1 - e)
    phi = math.atan2(2, alpha * math.pi) + branch * math.acos(-2 / (a * math.sqrt(4 + (alpha * math.pi)**2)))
    v = -alpha * a * math.cos(phi)
    before, after = -v, -v  # from the upper wall down: the speed is as before it, reflected
    t, u = phi, phi + math.pi
    rate = a * math.cos(u) - before
    du = np.array([a * math.cos(t) - after, math.pi]) / rate
    dv = np.array([0, -e]) - (1 + e) * a * math.sin(u) * du
    return math.remainder(phi, 2 * math.pi), v, np.diag([1, -1]) @ np.array([du, dv])


@pytest.mark.parametrize("e, a, branch", [(0.9, 0.5, 1), (0.8, 0.2, 1), (0.5, 0.5, 1), (0.7, 0.3, 1), (0.8, 1, 1), (0.8, 0.2, -1),
                                          (0.6, 0.25, -1)])
def test_impact_pair(gudgeon, e, a, branch):
    """Phase and multipliers of the symmetric orbit and of its unstable partner: the exact map."""
    phase, mu, _, orbits = rigid(gudgeon, "impact_pair", f"e={e}", f"amplitude={a} m", f"branch={branch}")
    phi, speed, half = pair(e, a, branch)
    right = np.linalg.eigvals(half @ half)
    assert_close(phase, phi, absolute=1e-6, what="phase")
    for value in right:
        assert_close(np.min(abs(mu - value)), 0, absolute=1e-5 * max(1, abs(value)), what="multiplier")
    assert_close(np.prod(mu).real, e**4, absolute=1e-5, what="product of the multipliers")
    events = {event["contact"]: event["impact_speed"] for event in orbits[-1]["events"]}
    assert_close(events["high"], speed - a * math.cos(phi), relative=1e-4, what="impact speed")
    assert set(events) == {"high", "low"}
    assert orbits[0]["stable"] == bool(np.all(abs(right) < 1))


@pytest.mark.slow
@pytest.mark.parametrize("e", [0.8, 0.7])
def test_fold_of_the_pair(gudgeon, e):
    """The branch turns at the least amplitude, from the stable orbits to the unstable ones."""
    least = 2 / math.hypot(2, (1 + e) / (1 - e) * math.pi)
    _, _, found, orbits = rigid(gudgeon, "impact_pair", f"e={e}", f"amplitude={1.2 * least} m",
                                limits={"from": f"{0.8 * least} m", "to": f"{1.3 * least} m"})
    assert [name for name, _ in found] == ["fold"]
    assert_close(found[0][1], least, absolute=1e-6, what="amplitude of the fold")
    assert [orbit["branch_ends"] for orbit in orbits] == [["end of the range"] * 2] * 3


@pytest.mark.slow
@pytest.mark.parametrize("e", [0.8, 0.6])
def test_symmetry_breaking_of_the_pair(gudgeon, e):
    """Symmetry breaks where the reflected map over half a period has the multiplier -1, by bisection."""
    low, high = 0.3, 1.5
    assert np.linalg.det(pair(e, low, 1)[2] + np.eye(2)) > 0 > np.linalg.det(pair(e, high, 1)[2] + np.eye(2))
    for _ in range(60):
        middle = (low + high) / 2
        half = pair(e, middle, 1)[2]
        low, high = (middle, high) if np.linalg.det(half + np.eye(2)) > 0 else (low, middle)
    assert 0.4 < low < 1.1
    _, _, found, _ = rigid(gudgeon, "impact_pair", f"e={e}", f"amplitude={0.95 * low} m",
                           limits={"from": f"{0.9 * low} m", "to": f"{1.1 * low} m"})
    assert [name for name, _ in found] == ["symmetry_breaking"]
    assert_close(found[0][1], low, relative=1e-5, what="amplitude")


@pytest.mark.slow
def test_files(gudgeon):
    """branch.csv and orbit.h5 have the branch; the table of the echo; unstable orbits beyond the fold."""
    orbit, place = orbit_of(gudgeon, "shaken_ball", limits={"from": "1", "to": "1.25"})
    rows = list(csv.reader((place / "branch.csv").read_text().splitlines()))
    assert rows[0][0] == "parameter" and "[orbit]" in (place / "deck.echo").read_text()
    with h5py.File(place / "orbit.h5") as file:
        values = file["branch/parameter"][()]
        stable = file["branch/stable"][()]
        speeds = file["branch/impact_speed"][()]
        assert file["branch/multiplier"].shape == (len(values), 4)
        assert_close(file["orbit_multipliers/re"][()], [pair[0] for pair in orbit["multipliers"]])
    assert_close(values, [float(row[0]) for row in rows[1:]])
    fold = [b["value"] for b in orbit["bifurcations"] if b["type"] == "fold"]
    assert len(fold) == 1 and np.all(values >= fold[0] - 1e-9)
    turn = int(np.argmin(values))
    assert not np.any(stable[:turn]) and np.all(stable[turn + 1:])
    assert np.all(np.diff(speeds) > 0), "the branch is one curve"
    assert (place / "figures/orbit_branch.png").stat().st_size > 10000


def test_horizon(gudgeon):
    """Slider-crank in continuous contact: logarithm of the greatest multiplier and exponent of --horizon; two periods are twice."""
    text = (ROOT / "inputs/slider_crank_dry.deck").read_text()
    for old, new in (("c           = 0.5 mm", "c = 0.1 mm"), ("law         = lankarani_nikravesh", "law = kelvin_voigt"),
                     ("restitution = 0.9", "restitution = 0.5"), ("speed       = 5000 rpm", "speed = 8000 rpm"),
                     ("end         = 24 ms", "end = 60 turns of motor"), ("every       = 10 us", "every = 1 ms")):
        assert old in text
        text = text.replace(old, new)
    text = "\n".join(line for line in text.splitlines() if not line.startswith("figures"))
    directory = scratch()
    logs = []
    for n in (1, 2):
        deck = written(directory, text + f"\n[orbit]\nperiod = 1 turns of motor\nperiods = {n}\nsettle = 40\n")
        call(gudgeon, "orbit", deck, "--out", directory / "orbit", "--quiet")
        orbit = json.loads((directory / "orbit/summary.json").read_text())["orbit"]
        assert_close(orbit["period"], n * 60 / 8000, relative=1e-12, what="period")
        assert orbit["events"] == [] and orbit["phase"] is None and orbit["stable"]
        logs.append(math.log(math.hypot(*orbit["multipliers"][0])))
    assert_close(logs[1], 2 * logs[0], absolute=1e-5, what="two periods")
    call(gudgeon, "run", deck, "--out", directory / "run", "--quiet", "--horizon", "--write", "numbers", "--tolerance", "1e-11")
    exponent = json.loads((directory / "run/summary.json").read_text())["exponent"]
    assert_close(exponent * 60 / 8000, logs[0], absolute=1e-4, what="exponent of a period")


@pytest.mark.parametrize("deck, changes, periods, n, close", [
    ("shaken_ball", ["gamma=1.045"], 1, 400, 1e-4), ("shaken_ball", ["gamma=1.5"], 1, 400, 1e-4),
    ("shaken_ball", ["e=0.6", "gamma=1.31"], 1, 400, 1e-4), ("shaken_ball", ["gamma=1.53"], 2, 400, 1e-4),
    ("impact_pair", ["amplitude=0.72 m"], 1, 1000, 1e-3)])
def test_exponents_of_periodic_windows(gudgeon, deck, changes, periods, n, close):
    """Impacts of stiff contacts: the exponent of --horizon is the logarithm of the greatest multiplier. The bodies are guided, so that
    no direction is neutral. Multipliers of the ball are real, those of the pair complex: there a change swings beside its decay, and
    what that adds goes with 1/n."""
    text = (ROOT / "inputs" / f"{deck}.deck").read_text()
    text = "\n".join(line for line in text.splitlines() if not line.startswith(ONLY))
    guide = next(line for line in text.splitlines() if line.startswith("guide "))
    text = text.replace(guide, f"{guide}\nhold origin centre y")
    text = text.replace("[orbit]", f"[orbit]\nperiods = {periods}\nsettle = 200")
    rate = 100 if deck == "shaken_ball" else 1
    period = 2 * math.pi / rate * periods
    lines = [f"end = {period * n!r} s" if line.startswith("end ") else line for line in text.splitlines()]
    lines = [f"every = {period!r} s" if line.startswith("every ") else line for line in lines]
    place = written(scratch(), "\n".join(lines) + "\n")
    out = place.parent / "out"
    sets = [word for change in changes for word in ("--set", change)]
    call(gudgeon, "orbit", place, *sets, "--out", out, "--quiet")
    orbit = json.loads((out / "summary.json").read_text())["orbit"]
    assert orbit["stable"] and len(orbit["events"]) in (periods, 2 * periods)
    call(gudgeon, "run", place, *sets, "--out", out, "--quiet", "--horizon", "--write", "numbers", "--tolerance", "1e-11")
    exponent = json.loads((out / "summary.json").read_text())["exponent"]
    assert_close(exponent * period, math.log(math.hypot(*orbit["multipliers"][0])), absolute=close, what="exponent of a period")


@pytest.mark.parametrize("old, new, message", [
    ("parameter   = gamma", "parameter = gama", "did you mean 'gamma'?"),
    ("contact     = impact", "contact = impakt", "'impakt' is not a joint with clearance"),
    ("to          = 2.5", "to = 0.1", "'to' must be greater than 'from'"),
    ("to          = 2.5", "to = 1.1", "not within"),
    ("to          = 2.5", "to = 2.5 mm", "has not the unit"),
    ("from        = 0.5", "", "no 'from'"),
    ("period      = {2*pi/w}", "period = 0 s", "positive"),
    ("period      = {2*pi/w}", "period = {2*pi/w}\nperiods = 1.5", "not a whole number"),
])
def test_wrong_words(gudgeon, old, new, message):
    """Words of the section are checked, also by `check`."""
    text = (ROOT / "inputs/shaken_ball.deck").read_text()
    assert old in text
    deck = written(scratch(), text.replace(old, new))
    for verb in ("check", "orbit"):
        assert message in call(gudgeon, verb, deck, expect=3).stderr


def test_refusals(gudgeon):
    """No section; a method with a history; no orbit."""
    none = ROOT / "inputs/slider_crank_dry.deck"
    assert "no section [orbit]" in call(gudgeon, "orbit", none, "--out", scratch() / "out", expect=2).stderr
    assert "not a one-step method" in orbit_of(gudgeon, "shaken_ball", options=("--method", "adams"), expect=2).stderr
    assert "no periodic orbit" in orbit_of(gudgeon, "impact_pair", "amplitude=0.03 m", expect=5).stderr


def test_linear_oscillator(gudgeon):
    """The deck of the reference, a linear oscillator: multipliers exp(s T), which no contact has a part in."""
    directory = scratch()
    deck = "\n".join(line for line in (ROOT / "docs/reference/decks/orbit.deck").read_text().splitlines()
                     if not line.startswith(ONLY))
    call(gudgeon, "orbit", written(directory, deck + "\n"), "--out", directory / "out", "--quiet")
    mu = [complex(*pair) for pair in json.loads((directory / "out/summary.json").read_text())["orbit"]["multipliers"]]
    right = np.exp(complex(-1, math.sqrt(99)) * 2 * math.pi / 8)
    assert_close([mu[0].real, mu[0].imag, mu[1].imag], [right.real, right.imag, -right.imag], absolute=2e-7, what="multipliers")
