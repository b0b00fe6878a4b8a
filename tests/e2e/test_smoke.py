"""Every verb once, on small decks of the plane, of space and with a film: part of `make quick`."""

import re

import pytest
from conftest import ROOT
from support import DECK, SLOWNESS, Run, assert_close, call, changed, finished, plain_deck, scratch, text_of, written

DECKS = {  # deck of inputs/ and the end of its motion
    "slider_crank_dry": "6 ms", "slider_crank_lubricated": "2 ms", "double_pendulum": "20 ms", "bouncing_ball": "200 ms",
    "four_bar": "50 ms", "lifting_arm": "50 ms", "planetary_gear": "20 ms", "incline": "100 ms",
    "big_end": "1 ms", "crosshead": "5 ms", "shaken_pendulum": "100 ms", "hatch": "50 ms", "ferris_wheel": "50 ms",
    "slider_crank_translational": "4 ms", "slider_crank_6_6_bushing": "5 ms", "pinball": "50 ms",
}
SHORT = (("analysis.dynamic", "end", "5 ms"),)
ONSET_LIMIT = 1e-6  # s
FORCE_LIMIT = 1e-3  # of each peak
LEDGER_LIMIT = 1e-3  # of the largest energy
SWEEP = "\n[sweep]\nlaw = hertz lankarani_nikravesh\nc = 0.5 0.2 mm\n"


def test_every_verb_has_a_smoke_test(gudgeon):
    """The verbs of `gudgeon help` are those below."""
    verbs = set(re.findall(r"(?m)^  gudgeon (\w+)", call(gudgeon, "help").stdout))
    known = "run sweep merge life sensitivity orbit modes tolerance fit precision check explain compare import new list help version"
    assert verbs == set(known.split())


@pytest.mark.parametrize("name", DECKS)
def test_check_explain_run(gudgeon, name):
    """A deck is right, described, and its motion closes the energy ledger."""
    deck = ROOT / "inputs" / f"{name}.deck"
    assert "no errors" in call(gudgeon, "check", deck).stdout
    assert "\nmodel\n" in call(gudgeon, "explain", deck).stdout
    folder = scratch()
    text = re.sub(r'"([^"/\s]+\.txt)"', lambda found: f'"{deck.parent / found.group(1)}"', text_of(deck))
    text = changed(changed(text, "analysis.dynamic", end=DECKS[name], ledger="on"), "output", figures=None)
    call(gudgeon, "run", written(folder, text), "--out", folder / "out", "--quiet", "--write", "channels")
    summary = Run(folder / "out").summary
    assert summary["status"] == "complete"
    assert summary["energy_residual_max"] < LEDGER_LIMIT


@pytest.mark.parametrize("method", ["dop853", "adams", "bdf", "ida", "rock4", "radau"])
def test_methods_agree(gudgeon, method):
    """Every method meets the impacts of the dry slider-crank at the times at which `verner` does."""
    reference = finished(gudgeon, "--method", "verner", "--tolerance", "1e-10", changes=SHORT).contacts
    contacts = finished(gudgeon, "--method", method, "--tolerance", "1e-8", changes=SHORT).contacts
    assert len(reference) > 2
    assert_close(contacts["time"], reference["time"], absolute=ONSET_LIMIT, what="onsets")
    assert_close(contacts["peak_force"], reference["peak_force"], relative=FORCE_LIMIT, what="peaks of the forces")


def test_static(gudgeon):
    """The static analysis of the loaded journal bearing."""
    folder = scratch()
    call(gudgeon, "run", ROOT / "inputs" / "journal_bearing.deck", "--analysis", "static", "--out", folder / "out", "--quiet")
    assert Run(folder / "out").summary["status"] == "complete"


def test_kinematic(gudgeon):
    """The kinematic analysis of the four-bar linkage."""
    folder = scratch()
    text = changed(text_of(ROOT / "inputs" / "four_bar_kinematic.deck"), "output", figures=None)
    call(gudgeon, "run", written(folder, text), "--analysis", "kinematic", "--out", folder / "out", "--quiet")
    assert Run(folder / "out").summary["status"] == "complete"


def test_sweep_and_merge(gudgeon):
    """Four cases in two parts, put together."""
    folder = scratch()
    deck = written(folder, plain_deck([("analysis.dynamic", "end", "1 ms")]) + SWEEP)
    for part in ("1/2", "2/2"):
        call(gudgeon, "sweep", deck, "--out", folder / "out", "--quiet", "--shard", part)
    call(gudgeon, "merge", folder / "out", "--quiet")
    assert (folder / "out" / "sweep.h5").exists()


def test_life(gudgeon):
    """The bush wears by two micrometres."""
    folder = scratch()
    call(gudgeon, "life", ROOT / "inputs" / "worn_bush.deck", "--set", "depth=12um", "--out", folder / "out", "--quiet")
    assert (folder / "out" / "life.h5").exists()


def test_tolerance(gudgeon):
    """A four-bar with tolerances."""
    folder = scratch()
    call(gudgeon, "tolerance", ROOT / "inputs" / "tolerance_four_bar.deck", "--out", folder / "out", "--quiet")
    assert (folder / "out" / "tolerance.h5").exists()


def test_fit(gudgeon):
    """Restitution of a bouncing ball from a record."""
    folder = scratch()
    deck, record = (ROOT / "inputs" / f"fit_restitution.{ending}" for ending in ("deck", "csv"))
    call(gudgeon, "fit", deck, record, "--out", folder / "out", "--quiet", "--write", "channels")
    assert (folder / "out" / "fit.h5").exists()


def test_precision(gudgeon):
    """Two methods compared in a short motion."""
    folder = scratch()
    deck = written(folder, plain_deck([("analysis.dynamic", "end", "1 ms")]))
    call(gudgeon, "precision", deck, "--methods", "verner dop853", "--budget", f"{2 * SLOWNESS}s", "--out", folder / "out", "--quiet")
    assert (folder / "out" / "precision.csv").exists()


def test_compare(gudgeon):
    """A run equals itself, and differs from one with another clearance."""
    folder = scratch()
    deck = written(folder, plain_deck([("analysis.dynamic", "end", "2 ms")]))
    for name, clearance in (("a", "0.5mm"), ("b", "0.4mm")):
        call(gudgeon, "run", deck, "--set", f"c={clearance}", "--out", folder / name, "--quiet")
    call(gudgeon, "compare", folder / "a", folder / "a", "--out", folder / "same")
    call(gudgeon, "compare", folder / "a", folder / "b", "--out", folder / "other", expect=1)


def test_import(gudgeon):
    """The deck of an Adams dataset has no mistakes."""
    folder = scratch()
    call(gudgeon, "import", ROOT / "tests" / "adams" / "pendulum.adm", cwd=folder)
    call(gudgeon, "check", "pendulum.deck", cwd=folder)


def test_new(gudgeon):
    """The deck to start from has no mistakes."""
    folder = scratch()
    call(gudgeon, "new", "mine", cwd=folder)
    call(gudgeon, "check", "mine.deck", cwd=folder)


@pytest.mark.parametrize("arguments", [("list",), ("list", "contact"), ("help", "joint", "revolute"), ("help", "--manual"),
                                       ("help", "--man"), ("version",)], ids=" ".join)
def test_words(gudgeon, arguments):
    """Verbs that print and exit."""
    assert call(gudgeon, *arguments).stdout


def test_mistake(gudgeon):
    """A misspelt column: exit code 3 and the nearest word."""
    deck = written(scratch(), DECK.read_text().replace("clearance   length", "clearence   length"))
    assert "did you mean 'clearance'" in call(gudgeon, "check", deck, expect=3).stderr
