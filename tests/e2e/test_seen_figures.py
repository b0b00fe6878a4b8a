"""What figures show, read from their data and scripts: names beside marks, numbers over two parameters, gaps of angles, planes, films."""

import functools
import re

import numpy as np
from film_decks import BEARING
from support import ROOT, Run, call, changed, scratch, written

# A rotor at constant speed, in the plane and in space, whose angle about the hinge goes from pi to -pi.
SPACE_ROTOR = """deck = 1
[scene]
space   = spatial
gravity = 0 0 0 m/s^2
[bodies]
name   mass[kg]  ixx[kg.m^2]  iyy[kg.m^2]  izz[kg.m^2]  wz[rad/s]
rotor  1         0.1          0.1          0.1          10
[points]
name   body    xi[m]  eta[m]  zeta[m]
floor  ground  0     0     0
hub    rotor   0     0     0
top    rotor   0     0     0.2
rim    rotor   0.2   0.03  0
[joint.revolute]
name   i      j    axis_i
hinge  floor  hub  "0 0 1"
[analysis.dynamic]
end = 1.5 s
[output]
every   = 20 ms
"""

# Numbers of a grid in closed form: the request is a b; where b = 3 a mass is negative, and the case fails.
GRID = """deck = 1
[scene]
title   = "Grid"
gravity = 0 0 m/s^2
[parameters]
a = 1
b = 1
[bodies]
name   mass        inertia[kg.m^2]
rotor  {(5.5 - a*b)*1kg}  0.1
[points]
name   body    xi[m]  eta[m]
floor  ground  0      0
hub    rotor   0      0
[joint.revolute]
name  i      j
pin   floor  hub
[driver.speed]
name   joint  speed
motor  pin    1rad/s
[request]
name     value
product  {a*b + 0*motor.coordinate/1rad}
[analysis.dynamic]
end = 10 ms
[output]
every   = 1 ms
channels = request.product
figures = contour(request.product.mean)
[statistics]
after    = 0 s
channels = request.product
[sweep]
a = 1 3 2
b = 1 2 4
"""


@functools.lru_cache(maxsize=None)
def figures_of(program, text, *options, end=None):
    """A run with its figures."""
    directory = scratch()
    text = changed(text, "analysis.dynamic", end=end) if end else text
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", *options)
    return Run(directory / "out")


def named(run, name):
    """Names in the data of a picture of the mechanism, with their places."""
    lines = (run.directory / "figures" / f"{name}.dat").read_text().splitlines()
    found = [re.fullmatch(r'(\S+) (\S+) (\d+) "(.+)"', line) for line in lines]
    return {match[4]: (float(match[1]), float(match[2])) for match in found if match}


def test_names_stand_beside_their_marks(gudgeon):
    """Bodies, joints and free points of a four-bar: each once, no two at one place, off with a word, and the axes have units."""
    text = changed((ROOT / "inputs/four_bar.deck").read_text(), "output", figures="mechanism(t=1ms) mechanism(t=2ms,names=off)")
    run = figures_of(gudgeon, text, end="3 ms")
    names = named(run, "mechanism.t.1ms")
    wanted = {str(name) for path in ("bodies", "joints") for name in run.read(f"{path}/names")}
    assert wanted <= set(names)
    places = np.array(list(names.values()))
    apart = np.abs(places[:, None] - places[None]) + 1e9*np.eye(len(places))[:, :, None]
    assert apart.max(axis=2).min() > 0.0
    script = (run.directory / "figures/mechanism.t.1ms.gp").read_text()
    assert "with labels" in script and re.search(r"set xlabel 'x \[m?m\]'", script)
    assert not named(run, "mechanism.t.2ms.names.off")


def test_names_are_clear_of_strokes(gudgeon):
    """No stroke passes through the middle of a name where there is room: that of a single arm."""
    text = changed((ROOT / "inputs/double_pendulum.deck").read_text(), "output", figures="mechanism(t=1ms,names=on)")
    run = figures_of(gudgeon, text, end="2 ms")
    lines = (run.directory / "figures/mechanism.t.1ms.names.on.dat").read_text().splitlines()
    strokes = np.array([[float(x) for x in line.split()[:2]] for line in lines if line and line[0] not in "#" and '"' not in line])
    low, high = strokes.min(axis=0), strokes.max(axis=0)
    for name, place in named(run, "mechanism.t.1ms.names.on").items():
        assert np.linalg.norm(strokes - place, axis=1).min() > 0.004*np.linalg.norm(high - low), name


def test_contours_over_two_parameters(gudgeon):
    """Means of all cases in their cells, written there, a failed one without a value; one parameter alone is refused."""
    directory = scratch()
    call(gudgeon, "sweep", written(directory, GRID), "--out", directory / "out", "--quiet", expect=8)
    table = np.loadtxt(directory / "out/figures/contour.request.product.mean.dat")
    assert table.shape == (9, 7)
    assert np.array_equal(table[:, 0], np.repeat([1.0, 2.0, 3.0], 3)) and np.array_equal(table[:, 1], np.tile([1.0, 2.0, 4.0], 3))
    product = table[:, 0]*table[:, 1]
    fails = product > 5.5
    assert fails.sum() == 3 and np.array_equal(np.isnan(table[:, 2]), fails)
    np.testing.assert_allclose(table[~fails, 2], product[~fails], rtol=1e-12)
    assert np.array_equal(table[:3, 5:], [[0.5, 1.5], [1.5, 3.0], [3.0, 5.0]])
    script = (directory / "out/figures/contour.request.product.mean.gp").read_text()
    assert "no value" in script and "sprintf('%.4g', $3*1))" in script and "with points" in script and "levels" not in script
    assert (directory / "out/figures/contour.request.product.mean.png").stat().st_size > 5000
    alone = GRID.replace("b = 1 2 4\n", "")
    assert "grid of two parameters" in call(gudgeon, "sweep", written(scratch(), alone), expect=3).stderr


def test_contour_lines_among_many_cases(gudgeon):
    """More than 25 cases have lines at round levels instead of their values."""
    directory = scratch()
    text = GRID.replace("5.5 - a*b", "50 - a*b").replace("a = 1 3 2", "a = 1 2 3 4 5 6").replace("b = 1 2 4", "b = 1 2 3 4 5").replace("end = 10 ms", "end = 1 ms")
    call(gudgeon, "sweep", written(directory, text), "--out", directory / "out", "--quiet")
    script = (directory / "out/figures/contour.request.product.mean.gp").read_text()
    levels = [float(x) for x in re.search(r"levels discrete (.*)", script)[1].split(",")]
    assert levels == [5, 10, 15, 20, 25] and "sprintf('%.4g'" not in script and "with points" in script
    assert (directory / "out/figures/contour.request.product.mean.png").stat().st_size > 5000


def test_angles_have_gaps_where_they_jump(gudgeon):
    """A transparent piece where pi becomes -pi, in a history and over another channel; none in an angle that does not."""
    text = changed(SPACE_ROTOR, "output", figures="hinge.angle portrait(hinge.angle,rotor.position.x) rotor.velocity.x")
    run = figures_of(gudgeon, text)
    angle = np.loadtxt(run.directory / "hinge.dat")
    assert (np.abs(np.diff(angle, axis=0)) > np.pi).any()
    for name in ("hinge.angle", "portrait.hinge.angle.rotor.position.x"):
        script = (run.directory / f"figures/{name}.gp").read_text()
        assert "0xff000000" in script, name
        assert (run.directory / f"figures/{name}.png").stat().st_size > 5000
    assert "0xff000000" not in (run.directory / "figures/rotor.velocity.x.gp").read_text()


def test_orbits_in_space_say_their_plane(gudgeon):
    """The two components that move most, and the range of the third; an orbit of chords says so."""
    text = changed((ROOT / "inputs/slider_crank_6_6_ball.deck").read_text(), "output", figures="gudgeon.orbit", every="200us")
    run = figures_of(gudgeon, text, end="20 ms")
    script = (run.directory / "figures/gudgeon.orbit.gp").read_text()
    match = re.search(r"projection on the plane (\w), (\w) of the world frame; (\w) from (\S+) to (\S+)", script)
    assert match and {match[1], match[2], match[3]} == set("xyz")
    spans = np.ptp(run.item("clearances/eccentricity", "gudgeon"), axis=0)
    assert "xyz".index(match[3]) == len(spans) - 1 - np.argmin(spans[::-1])


def test_chords_are_said(gudgeon):
    """A path of four rows a turn is of straight lines, one of a thousand is not."""
    text = changed(SPACE_ROTOR, "output", figures="portrait(rim.velocity.x,rim.velocity.y)", channels="rim.velocity")
    for every, is_of_chords in (("160ms", True), ("1ms", False)):
        run = figures_of(gudgeon, changed(text, "output", every=every))
        script = (run.directory / "figures/portrait.rim.velocity.x.rim.velocity.y.gp").read_text()
        assert ("straight lines between output times" in script) == is_of_chords, every


def test_turns_of_shafts_crosses_and_gears_are_drawn(gudgeon):
    """A bar across a shaft, two arms of a cross, teeth of gears: strokes that turn with their bodies."""
    text = changed(SPACE_ROTOR.replace("rim    rotor   0.2   0.03  0\n", ""), "output", figures="animation(n=4,names=off)")
    run = figures_of(gudgeon, text, end="0.4 s")
    lines = (run.directory / "figures/animation.n.4.names.off.dat").read_text()
    assert len([block for block in lines.split("\n\n\n") if block.strip()]) == 4*10
    text = changed(SPACE_ROTOR, "output", figures="animation(n=4)")
    lines = (figures_of(gudgeon, text, end="0.4 s").directory / "figures/animation.n.4.dat").read_text()
    assert len([block for block in lines.split("\n\n\n") if block.strip()]) == 4*10 and lines.count('"rim"') == 4
    gears = changed((ROOT / "inputs/planetary_gear.deck").read_text(), "output", figures="mechanism(t=1ms,names=off)")
    plain = (figures_of(gudgeon, gears, end="2 ms").directory / "figures/mechanism.t.1ms.names.off.dat").read_text()
    assert plain.count("\n\n") > 60
    bent = changed((ROOT / "inputs/bent_shafts.deck").read_text(), "output", figures="mechanism(t=2ms) mechanism(t=40ms)")
    run = figures_of(gudgeon, bent, end="50 ms")
    first, second = ((run.directory / f"figures/mechanism.t.{t}.dat").read_text() for t in ("2ms", "40ms"))
    assert first != second


def test_films_across_zero_are_whole(gudgeon):
    """A load along x presses the journal towards 0 degrees: the film is one part of the picture, which spans a turn."""
    text = BEARING.read_text().replace("name     point    fy\nweight   centre   {-load}", "name     point    fx\nweight   centre   {load}")
    text = changed(changed(text, "output", figures="film(bearing)"), "scene", gravity="0 0 m/s^2")
    run = figures_of(gudgeon, text, "--set", "film=short_gumbel", "--set", "duration=0.1s", "--set", "gumbel=corrected")
    blocks = (run.directory / "figures/film.bearing.dat").read_text().split("\n\n\n")[1]
    middle = np.array([[float(x) for x in line.split()] for line in blocks.splitlines() if line and line[0] != "#"])
    theta, pressure = middle[:, 0], middle[:, 2]
    assert len(theta) == 361 and np.all(np.diff(theta) > 0.0)
    np.testing.assert_allclose(theta[-1] - theta[0], 2*np.pi, rtol=1e-12)
    acts = pressure > 1e-6*pressure.max()
    assert not acts[0] and not acts[-1] and np.count_nonzero(np.diff(acts.astype(int))) == 2
    assert acts[np.argmin(np.abs(theta))] or acts[np.argmin(np.abs(theta - 2*np.pi))]
