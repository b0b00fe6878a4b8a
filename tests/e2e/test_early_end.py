"""Figures of runs that end before their time: pictures of a crank at constant speed against its closed form, axes that end with it."""

import json

import numpy as np
import pytest
from support import call, changed, plain_deck, written
from test_drawn_figures import run, strokes
from test_motion_file import CRANK

TURN = 2 * np.pi / 7  # [s]
LONG = changed(CRANK, "analysis.dynamic", end="3 s") + "[guards]\nstop = motor.coordinate > 14 rad\n"  # it ends at 2 s


def tips(found):
    """Where the tip of the crank is in each position of a picture."""
    return np.array([line[1] for line in found[0]["line"]])


def tips_of(found):
    """The same in pictures of an animation."""
    return np.array([frame["line"][0][1] for frame in found])


def at(times):
    """Where it is at some times."""
    return 0.5 * np.stack([np.cos(7 * times), np.sin(7 * times)], axis=1)


def test_the_last_row_is_the_end(gudgeon, tmp_path):
    """`mechanism` is as the run stops, between two output instants, and so is it at the end of the path of a point."""
    text = changed(LONG, "guards", stop="motor.coordinate > 14.03 rad")
    folder = run(gudgeon, tmp_path, text, "mechanism coupler(tip)")
    end = np.array([14.03 / 7])
    np.testing.assert_allclose(tips(strokes(folder / "mechanism.dat")), at(end), atol=1e-5)
    found = strokes(folder / "coupler.tip.dat")
    np.testing.assert_allclose(tips(found), at(end), atol=1e-5)
    np.testing.assert_allclose(found[0]["path"][0], at(np.append(np.arange(201) * 0.01, end)), atol=1e-5)


@pytest.mark.parametrize("options", [(), ("--verify-restart",)])
def test_windows_end_with_the_run(gudgeon, tmp_path, options):
    """A strip and the path of a point are of the last turn before the stop, also after a restart: pictures at the eighths of a turn."""
    text = changed(LONG, "guards", stop="motor.coordinate > 14.01 rad")  # between two output instants: on one, rounding says whether it has two rows
    folder = run(gudgeon, tmp_path, text, "strip(n=8) coupler(tip, last = 1 turn of motor)", *options)
    times = np.round(np.arange(10, 18) * TURN / 8 / 0.01) * 0.01
    np.testing.assert_allclose(tips(strokes(folder / "strip.n.8.dat")), at(times), atol=1e-5)
    path = strokes(next(folder.glob("coupler*.dat")))[0]["path"][0]
    rows = np.append(np.arange(201) * 0.01, 14.01 / 7)
    np.testing.assert_allclose(path, at(rows[rows >= rows[-1] - TURN - 0.005]), atol=1e-5)


def test_a_whole_run_that_ends_early(gudgeon, tmp_path):
    """An animation of all of a run has the pictures up to the end, and that one; it moves."""
    text = changed(LONG, "analysis.dynamic", end="0.8 s").replace("14 rad", "3.52 rad")  # less than a turn, and it ends at 0.503 s
    found = strokes(run(gudgeon, tmp_path, text, "animation(n=9)") / "animation.n.9.dat")
    np.testing.assert_allclose(tips_of(found), at(np.append(np.arange(6) * 0.1, 3.52 / 7)), atol=1e-5)


def test_a_guard_that_ends_it(gudgeon, tmp_path):
    """A run that fails shows the mechanism where it failed."""
    text = plain_deck([("analysis.dynamic", "end", "4 ms")]) + "\n[guards]\nspeed = 20 m/s\n"
    call(gudgeon, "run", written(tmp_path, changed(text, "output", figures="mechanism strip(n=3)")), "--out", tmp_path / "run",
         "--quiet", expect=5)
    assert (tmp_path / "run" / "figures" / "mechanism.png").stat().st_size > 3000
    warnings = json.loads((tmp_path / "run" / "summary.json").read_text())["warnings"]
    assert not [w for w in warnings if "no values" in w]


def test_axes_end_with_the_run(gudgeon, tmp_path):
    """Panels with and without the ideal twin, which goes on to the end of the deck, have one time axis: that of the run."""
    text = plain_deck([("output", "figures", "panels(gudgeon.penetration, slider.velocity.x)")])
    text += "\n[guards]\nstop = motor.coordinate > 3 rad\n"
    call(gudgeon, "run", written(tmp_path, text), "--out", tmp_path / "run", "--quiet")
    script = next((tmp_path / "run" / "figures").glob("panels*.gp")).read_text(encoding="utf-8")
    end = 1e3 * 3.0 / (5000 * 2 * np.pi / 60)
    (low, high), = [line.split("[")[1].rstrip("]").split(":") for line in script.splitlines() if line.startswith("set xrange")]
    assert float(low) == 0.0 and float(high) == pytest.approx(end, rel=1e-6)


def test_panels_without_numbers(gudgeon, tmp_path):
    """Of three panels the last has none: two are drawn, the time below the second, and a warning names the channel."""
    text = plain_deck([("analysis.dynamic", "end", "2 ms")]) + "\n[request]\nname value unit\nnone {sqrt(-1 s - t)} -\n"
    figures = "panels(slider.velocity.x, slider.position.x, request.none) panels(slider.velocity.x + slider.position.x, slider.velocity.y) " \
              "panels(slider.velocity.x, slider.position.x + slider.velocity.y)"
    call(gudgeon, "run", written(tmp_path, changed(text, "output", figures=figures)), "--out", tmp_path / "run", "--quiet")
    folder = tmp_path / "run" / "figures"
    script = next(folder.glob("panels*none.gp")).read_text(encoding="utf-8")
    assert script.count("set origin 0,") == 2 and script.index("set xlabel 'time") < script.rindex("plot ")
    warnings = json.loads((tmp_path / "run" / "summary.json").read_text())["warnings"]
    assert [w for w in warnings if w.endswith("no values of request.none")]
    assert len(list(folder.glob("panels*.png"))) == 3  # the second and the third have names of their own


@pytest.mark.parametrize("options", [(), ("--verify-restart",)])
def test_a_strip_of_a_first_window(gudgeon, tmp_path, options):
    """A run that ends at 0.36 s, within its first turn of 0.9 s, has eight positions at equal intervals, and the last is its end."""
    text = changed(LONG, "guards", stop="motor.coordinate > 2.5 rad")
    found = tips(strokes(run(gudgeon, tmp_path, text, "strip(n=8)", *options) / "strip.n.8.dat"))
    turned = np.arctan2(found[:, 1], found[:, 0]) / 7
    assert len(turned) == 8 and turned[0] == pytest.approx(0, abs=1e-5) and turned[-1] == pytest.approx(2.5 / 7, abs=1e-5)
    np.testing.assert_allclose(np.diff(turned), 2.5 / 7 / 7, atol=0.0101)  # to an output interval


def test_a_strip_of_many_instants(gudgeon, tmp_path):
    """Of 3572 instants at least 32 pictures are kept: eight positions of them are equally spaced to a quarter."""
    text = changed(changed(LONG, "output", every="0.1 ms"), "guards", stop="motor.coordinate > 2.5 rad")
    found = tips(strokes(run(gudgeon, tmp_path, text, "strip(n=8)") / "strip.n.8.dat"))
    turned = np.arctan2(found[:, 1], found[:, 0]) / 7
    assert len(turned) == 8 and turned[-1] == pytest.approx(2.5 / 7, abs=1e-5)
    assert np.ptp(np.diff(turned)) < 0.26 * 2.5 / 7 / 7
