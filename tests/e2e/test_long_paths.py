"""Orbits and portraits of long runs: what their pixels show of a path that passes a place often, and of its twin."""

import subprocess

import numpy as np
from support import DECK, changed, scratch
from test_asked_figures import SHAKER, drawn


def pixels(picture):
    """Columns, rows and colours (n, 5) of a picture, read by gnuplot."""
    table = scratch() / "pixels.dat"
    words = f"set table '{table}'; plot '{picture}' binary filetype=png with rgbimage"
    subprocess.run(["gnuplot", "-e", words], check=True, capture_output=True, timeout=60)
    return np.loadtxt(table, usecols=range(5))


def test_a_long_path_is_dark_where_it_passes_often(gudgeon):
    """Of 25,000 rows of two swings at once, the turns at the ends of the slow one are darker than the middle, and the key is opaque."""
    text = changed(SHAKER, "output", every="0.04 ms", channels="arm.angle arm.angular_velocity")
    text = text.replace("{0.2rad*sin(2*pi*t*FREQUENCY/1s)}", "{0.1rad*sin(2*pi*t*3/1s)+0.02rad*sin(2*pi*t*200/1s)}")
    folder = drawn(gudgeon, text, "portrait(arm.angle,arm.angular_velocity)")
    name = "portrait.arm.angle.arm.angular_velocity"
    assert (folder / f"{name}.path.dat").exists()
    found = pixels(folder / f"{name}.png")[:, 2:]
    red = found[(found[:, 2] > found[:, 0] + 15) & (found[:, 2] > 170), 0]  # of what is blue
    assert red.max() > 200 and red.min() < 80, (red.min(), red.max())
    assert np.count_nonzero(red < 120) > 500
    script = (folder / f"{name}.gp").read_text(encoding="utf-8")
    assert "every ::0::0:0" in script and script.count("#1f6fb4") == 1


def test_the_twin_is_seen_on_a_long_path(gudgeon):
    """The line of the ideal joints lies over the path in a colour that the path does not have."""
    text = changed(DECK.read_text(encoding="utf-8"), "analysis.dynamic", end="0.1 s", tolerance="1e-6")
    text = changed(text, "output", every="4 us")
    folder = drawn(gudgeon, text, "portrait(slider.velocity.x,slider.acceleration.x)")
    name = "portrait.slider.velocity.x.slider.acceleration.x"
    assert (folder / f"{name}.path.dat").exists()
    x, y, *colours = pixels(folder / f"{name}.png").T
    black = np.all(np.array(colours) < 60, axis=0) & (abs(x - x.mean()) < 200) & (abs(y - y.mean()) < 150)
    assert np.count_nonzero(black) > 150
