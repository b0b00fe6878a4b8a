"""deck.echo, the deck as it was understood, and what `explain` says of the same: defaults, IMSL's names, titles."""

import pathlib
import re

import pytest
from support import Run, assert_close, call, changed, plain_deck, scratch, written
from test_warnings import PENDULUM

ASSEMBLY = 4
INPUTS = pathlib.Path(__file__).resolve().parent.parent.parent / "inputs"
BACKSLASHES = ['"C:\\\\new\\\\table"', '"ends in \\\\"', '"a\\\\\\"b\\\\\\""', '"\\\\n is no line"', '"{/Symbol a} \\\\# \\\\{"']


def run_deck(program, text):
    """Run a deck given as text."""
    directory = scratch()
    return Run(directory / "out", call(program, "run", written(directory, text), "--out", directory / "out", "--quiet"))


def echoed(program, text):
    """A run, and the run of its echo, whose own echo must be the same."""
    first = run_deck(program, text)
    echo = (first.directory / "deck.echo").read_text()
    call(program, "check", written(scratch(), echo))
    second = run_deck(program, echo)
    assert (second.directory / "deck.echo").read_text() == echo
    return first, second


def defaults(program, text):
    """The defaults that `explain` lists."""
    said = call(program, "explain", written(scratch(), text)).stdout
    return said, said.split("defaults used")[1]


def test_imsl_tolerance(gudgeon):
    """tol = 1e-5: the run has it, explain says it and does not call it a default."""
    text = changed(PENDULUM, "analysis.dynamic", tol="1e-5")
    said, taken = defaults(gudgeon, text)
    assert "tolerance 1e-5" in said
    assert "analysis.dynamic tolerance" not in taken and "initial_step" in taken
    assert not re.search(r"\b(tol|hinit|hmin|hmax|mxstep|mxfcn|inorm) =", taken)
    assert "analysis.dynamic tolerance = 1e-8" in defaults(gudgeon, PENDULUM)[1]
    first, plain = run_deck(gudgeon, text), run_deck(gudgeon, changed(PENDULUM, "analysis.dynamic", tolerance="1e-5"))
    assert first.summary["tolerance"] == 1e-5
    assert first.summary["rhs_evaluations"] == plain.summary["rhs_evaluations"] < run_deck(gudgeon, PENDULUM).summary["rhs_evaluations"]


def test_echo_of_imsl_names(gudgeon):
    """The echo of a deck with IMSL's names has no mistakes and means the same."""
    text = plain_deck([("analysis.dynamic", "tolerance", None), ("analysis.dynamic", "tol", "1e-6"),
                       ("analysis.dynamic", "hinit", "2 us"), ("analysis.dynamic", "hmax", "50 us"),
                       ("analysis.dynamic", "mxstep", "5000"), ("analysis.dynamic", "inorm", "2"),
                       ("analysis.dynamic", "end", "1 ms")])
    first, second = echoed(gudgeon, text)
    assert first.summary["tolerance"] == second.summary["tolerance"] == 1e-6
    assert first.summary["steps"] == second.summary["steps"] > 20  # hmax
    assert_close(second.item("bodies/position", "slider"), first.item("bodies/position", "slider"), absolute=1e-12)
    assert_close(second.contacts["time"], first.contacts["time"], absolute=1e-12)


def test_inorm_is_norm(gudgeon):
    """inorm = 2 is norm = relative, and not the default."""
    runs = [run_deck(gudgeon, changed(PENDULUM, "analysis.dynamic", coordinates="full", **setting)).summary
            for setting in ({"inorm": "2"}, {"norm": "relative"}, {})]
    steps = [(run["rhs_evaluations"], run["energy_residual_max"]) for run in runs]
    assert steps[0] == steps[1] != steps[2]
    text = changed(PENDULUM, "analysis.dynamic", inorm="2")
    assert "norm =" not in defaults(gudgeon, text)[1]
    assert re.search(r"^norm += relative$", (run_deck(gudgeon, text).directory / "deck.echo").read_text(), re.MULTILINE)


def test_both_names_with_one_value(gudgeon):
    """Saying the same thing twice is no mistake."""
    call(gudgeon, "check", written(scratch(), changed(PENDULUM, "analysis.dynamic", tol="1e-5", tolerance="1e-5")))


@pytest.mark.parametrize("title", BACKSLASHES)
def test_backslashes_in_a_title(gudgeon, title):
    """A title with backslashes is the same after an echo."""
    first, second = echoed(gudgeon, changed(PENDULUM, "scene", title=title))
    meant = title[1:-1].replace('\\"', '"').replace("\\\\", "\\")
    assert first.summary["title"] == second.summary["title"] == meant


def test_echo_of_velocities_left_out(gudgeon):
    """Velocities that follow from the given ones do so in the echo too."""
    first, second = echoed(gudgeon, PENDULUM)
    assert second.summary["warnings"] == []
    assert_close(second.item("bodies/velocity", "bob")[0], first.item("bodies/velocity", "bob")[0], absolute=1e-12)


def test_explain_without_assembly(gudgeon):
    """A mechanism that cannot be assembled: explain says so, gives no gaps, and fails as check does."""
    text = plain_deck().replace("\npin      slider", "\nhigh     ground     0    900\npin      slider")
    deck = written(scratch(), text.replace("guide    main     pin", "guide    high     pin"))
    done = call(gudgeon, "explain", deck, expect=ASSEMBLY)
    assert "NOT assembled" in done.stdout and "cannot be assembled" in done.stderr
    for word in ("initial clearance", "assembled in", "no redundant rows"):
        assert word not in done.stdout, word
    assert "radial clearance 0.5 mm" in done.stdout and "defaults used" in done.stdout
    said = call(gudgeon, "explain", written(scratch(), plain_deck())).stdout
    assert "NOT assembled" not in said and "initial clearance 0.5 mm" in said and "assembled in" in said


def test_echo_of_guards(gudgeon):
    """What ends or warns of a run is part of the deck as it was understood."""
    text = plain_deck([("analysis.dynamic", "end", "1 ms")]) + "\n[guards]\npenetration = 0.5\nstop = gudgeon.penetration > 0.3 mm\n"
    first, second = echoed(gudgeon, text)
    echo = (first.directory / "deck.echo").read_text()
    assert re.search(r"\[guards\](\n.*)*\npenetration\s*=\s*0\.5\b", echo), echo[-1500:]
    assert "[guards]" not in (run_deck(gudgeon, plain_deck([("analysis.dynamic", "end", "1 ms")])).directory / "deck.echo").read_text()


@pytest.mark.parametrize("way", ["procedure1", "procedure2"])
def test_echo_of_a_deck_run_as_programs_of_old(gudgeon_debug, way):
    """What --legacy makes of a deck is a deck: limits with their units, no faces of sliders without a law."""
    for deck in (INPUTS / "slider_crank_dry.deck", INPUTS / "hard" / "wedged_slider.deck"):
        text = re.sub(r"(?m)^end( *)= .*", r"end\1= 0.1 ms", re.sub(r"(?m)^every( *)= .*", r"every\1= 0.1 ms", deck.read_text()))
        directory = scratch()
        call(gudgeon_debug, "run", written(directory, text), "--out", directory / "out", "--quiet", "--legacy", way, "--write", "numbers")
        call(gudgeon_debug, "check", directory / "out" / "deck.echo")
        echo = (directory / "out" / "deck.echo").read_text()
        assert re.search(r"(?m)^contact_onset += " + ("interpolate" if way == "procedure1" else "reject limit=1e-7m") + "$", echo)
