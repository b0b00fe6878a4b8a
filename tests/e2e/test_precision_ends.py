"""`gudgeon precision`: limits of a deck that runs exceed, conditions that end them, the reference, and why there are no twins."""

import re

from conftest import ROOT
from support import SLOWNESS, Run, call, changed, scratch, text_of, written
from test_precision import CLOSED, HARD, compared, ladders, no_figures

MOVING = "deck = 1\n" + CLOSED["oscillator"][0] + "[analysis.dynamic]\nend = 2 s\n"
REST = changed(MOVING.replace(" 1.5  0\n", " 1    0\n"), "analysis.dynamic", end="1 s")  # where the spring is slack


def test_runs_beyond_a_limit_of_the_deck_have_failed(gudgeon):
    """By constraints without stabilisation: every run whose violation is above `violation_limit`, and no other."""
    limit = 1e-6
    text = changed(no_figures(text_of(HARD / "a02_four_bars_1.deck")), "analysis.dynamic", end="0.5 s", stabilise="none")
    text += ladders(per_decade=2, coarsest="1e-3", perturbation="0")
    free = compared(gudgeon, text, "--methods", "verner adams")
    held = compared(gudgeon, changed(text, "analysis.dynamic", violation_limit=f"{limit} m"), "--methods", "verner adams")
    beyond = [(row["setting"], row["asked"]) for row in free.rows if row["state"] == "done" and row["violation [m]"] > limit]
    failed = [(row["setting"], row["asked"]) for row in held.rows if row["state"] == "failed" and "audit failed" in row["reason"]]
    assert 0 < len(beyond) < len(free.rows) and failed == beyond
    assert f"allowed {limit:.0e}".replace("e-06", "e-6") in (held.directory / "summary.txt").read_text()
    assert held.summary["reference"] == free.summary["reference"] != ""


def test_runs_whose_ledger_does_not_close_have_failed(gudgeon):
    text = changed(MOVING, "analysis.dynamic", ledger="on") + ladders(perturbation="0", finest="1e-10")
    worst = [row["ledger"] for row in compared(gudgeon, text, "--methods", "verner").rows]
    limit = 0.5 * (max(worst) + sorted(worst)[-2])
    held = compared(gudgeon, changed(text, "analysis.dynamic", energy_limit=f"{limit:.17g}"), "--methods", "verner")
    assert [row["state"] for row in held.rows] == ["failed" if error > limit else "done" for error in worst]
    assert "the energy error reached" in held.rows[worst.index(max(worst))]["reason"]


def test_a_condition_that_the_start_meets(gudgeon):
    """There is nothing to compare, and it is said by which condition."""
    text = MOVING + "[guards]\nstop = mass.position.x > 1.2 m\n" + ladders()
    directory = scratch()
    done = call(gudgeon, "precision", written(directory, text), "--out", directory / "out", expect=5)
    assert "nothing to compare: the motion is stopped as requested at t = 0 s: mass.position.x > 1.2 m" in done.stderr
    assert "the initial state already meets this condition of 'stop'" in done.stderr


def test_the_time_of_an_end_is_an_onset(gudgeon):
    """x = 1 m + 0.5 m cos 5 t falls below 0.8 m at t = acos(-0.4)/5: the onset error of a run without contacts is that of its end."""
    text = MOVING + "[guards]\nstop = mass.position.x < 0.8 m\n" + ladders(perturbation="0", finest="1e-8")
    study = compared(gudgeon, text, "--methods", "verner")
    reference = study.summary["reference"].split()
    ends = {}
    for tolerance in [row["asked"] for row in study.rows] + [float(reference[1])]:
        directory = scratch()
        call(gudgeon, "run", written(directory, text), "--method", reference[0], "--tolerance", repr(tolerance), "--out", directory / "out", "--quiet")
        ends[tolerance] = Run(directory / "out").summary["time_end"]
    for row in study.rows:
        assert row["onsets [s]"] == abs(ends[row["asked"]] - ends[float(reference[1])])
    assert study.rows[0]["onsets [s]"] > 1e-9
    assert "and end time" in (study.directory / "summary.txt").read_text()


def test_the_reference_is_the_tightest_run_there_is_time_for(gudgeon):
    """Coulomb friction, stiff: implicit methods get through quickly, explicit ones do not. Twice the time gives no coarser reference."""
    asked = []
    for seconds in (6, 12):
        directory = scratch()
        call(gudgeon, "precision", ROOT / "inputs" / "friction.deck", "--set", "friction=coulomb", "--budget", f"{seconds * SLOWNESS}s",
             "--out", directory / "out", "--quiet")
        words = (directory / "out" / "summary.txt").read_text()
        asked.append(float(re.search(r"reference  \S+ (\S+), confirmed by", words)[1]))
    assert asked[0] <= 1e-9 and asked[1] <= asked[0]


def reason(study):
    """Why there are no twins."""
    return re.search(r"horizon    unknown: (.*)", (study.directory / "summary.txt").read_text())[1]


def test_why_there_are_no_twins(gudgeon):
    """Not the time, where there was enough: a ladder that ends too early, a condition that ends twins elsewhere."""
    loose = compared(gudgeon, MOVING + ladders(finest="1e-6", budget="0 s"), "--methods", "verner")
    assert reason(loose) == "no run of verner at the tolerance of neighbouring trajectories, 1e-10 or less was requested ('finest' of [precision])"
    text = MOVING + "[guards]\nstop = mass.position.y > 1e-12 m or mass.position.y < -1e-12 m\n"
    text += ladders(budget="0 s")  # it stays at 0, unlike that of every twin
    assert reason(compared(gudgeon, text, "--methods", "verner")) == "a stop condition ends perturbed motions at other times"


def test_no_time_for_twins_is_told(gudgeon):
    """What one takes, and that it was not there."""
    text = changed(text_of(ROOT / "inputs" / "slider_crank_dry.deck"), "output", figures=None)
    study = compared(gudgeon, changed(text, "analysis.dynamic", end="400 ms"), "--methods", "verner", "--budget", f"{3 * SLOWNESS}s")
    assert "time budget exhausted for " in reason(study)
