"""`method = auto`: the explicit method to the bit where nothing is stiff, radau where it is, told in the summary; named methods that are too slow."""

import h5py
import numpy as np
import pytest
from support import ROOT, assert_close, call, changed, finished, run_with, written

GRIP = (ROOT / "tests" / "bench" / "grip.deck").read_text()


def numbers(path):
    """All numbers of run.h5 but those that tell of the program and the run."""
    found = {}
    with h5py.File(path / "run.h5") as file:
        file.visititems(lambda name, node: found.update({name: node[()]}) if isinstance(node, h5py.Dataset) and node.dtype.kind == "f" else None)
    return found


def test_grip(gudgeon):
    """8.6 million steps by verner; the motion is that of radau at a tighter tolerance."""
    run = run_with(gudgeon, GRIP, method="auto")
    assert run.summary["steps"] < 3000 and run.summary["rhs_evaluations"] < 60000
    assert "dop853, and radau in" in run.summary["method"] and "h lambda" in run.summary["method"]
    reference = run_with(gudgeon, GRIP.replace("1e-8", "1e-10"), method="radau")
    for name in ("bodies/position", "bodies/velocity"):
        ours, theirs = (one.read(name)[:, 0] for one in (run, reference))
        assert_close(ours, theirs, absolute=1e-5 * np.abs(theirs).max(), what=name)


@pytest.mark.parametrize("tolerance, method", [("1.1e-8", "verner"), ("1e-8", "dop853")])
def test_to_the_bit(gudgeon, tmp_path, tolerance, method):
    """The dry slider-crank is not stiff."""
    deck = ROOT / "inputs" / "slider_crank_dry.deck"
    for name in ("auto", method):
        call(gudgeon, "run", deck, "--method", name, "--tolerance", tolerance, "--out", tmp_path / name, "--quiet")
    ours, theirs = numbers(tmp_path / "auto"), numbers(tmp_path / method)
    assert ours.keys() == theirs.keys() and len(ours) > 10
    for name in ours:
        assert np.array_equal(ours[name], theirs[name], equal_nan=True), name


def test_restart(gudgeon, tmp_path):
    """Saved and taken back within the stiff stretch: the same bits."""
    deck = written(tmp_path, changed(GRIP, "analysis.dynamic", method="auto", checkpoint="1.5 s", end="5 s"))
    done = call(gudgeon, "run", deck, "--out", tmp_path / "out", "--verify-restart")
    assert "equal bit for bit after" in done.stdout


def test_explained(gudgeon, tmp_path):
    """`explain` tells what there is to choose from."""
    deck = written(tmp_path, changed(GRIP, "analysis.dynamic", method="auto"))
    assert "explicit steps of order 6 (verner" in call(gudgeon, "explain", deck, "--tolerance", "1e-7").stdout
    assert "explicit steps of order 8 (dop853" in call(gudgeon, "explain", deck).stdout


def test_named_method_that_is_too_slow(gudgeon):
    """A film by verner: the warning says once by how much radau is better, and it is; the same by auto has none."""
    text = (ROOT / "inputs" / "journal_bearing.deck").read_text()
    runs = {name: run_with(gudgeon, text, method=name) for name in ("verner", "radau", "auto")}
    told = [words for words in runs["verner"].summary["warnings"] if words.startswith("stiff for method = verner")]
    assert len(told) == 1 and "radau" in told[0]
    assert not any("stiff for" in words for name in ("radau", "auto") for words in runs[name].summary["warnings"])
    assert runs["auto"].summary["rhs_evaluations"] < 3 * runs["radau"].summary["rhs_evaluations"]
