"""Figures whose axes are asked for, and ranges of curves that turn too often: their scripts and numbers against closed forms."""

import functools
import re

import numpy as np
import pytest
from support import DECK, call, changed, scratch, written

SHAKER = """deck = 1
[scene]
title = "a shaken arm"
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]  angle[deg]
arm   1         0.1              0.2   0     0
[points]
name  body    xi[m]  eta[m]
main  ground  0      0
heel  arm     -0.2   0
[joint.revolute]
name  i     j
pin   main  heel
[driver.angle]
name   joint  angle
motor  pin    {0.2rad*sin(2*pi*t*FREQUENCY/1s)}
[analysis.kinematic]
end = 1 s
[output]
every = 0.1 ms
channels = arm.angle
"""


def drawn(gudgeon, text, figures, *options):
    """The directory of a run with some figures."""
    directory = scratch()
    call(gudgeon, "run", written(directory, changed(text, "output", figures=figures)), "--out", directory / "out", "--quiet", *options)
    return directory / "out" / "figures"


def short(text):
    """The slider-crank for a part of a turn."""
    return changed(text, "analysis.dynamic", end="3 ms")


@functools.lru_cache(maxsize=None)
def crank_run(gudgeon):
    """Curves in units, over an angle, between ends, in panels."""
    return drawn(gudgeon, short(DECK.read_text(encoding="utf-8")),
                 "slider.velocity.x in mm/s + gudgeon.normal_force from 0 to 50 kN against motor.coordinate in deg from 0 deg to 90 deg  "
                 "panels(crank.angle in deg, slider.velocity + crank.velocity.x, energy.kinetic) against time in us")


@pytest.fixture(name="crank")
def crank_figures(gudgeon):
    """Their directory."""
    return crank_run(gudgeon)


def only(folder, pattern):
    """The one file of that name."""
    (path,) = folder.glob(pattern)
    return path


def test_over_an_angle(crank):
    """The table of channels of three files has the motor's angle, 5000 rpm; the axes are as asked, in the units asked for."""
    script = only(crank, "slider*.gp").read_text(encoding="utf-8")
    table = np.loadtxt(only(crank, "slider*.dat"), skiprows=len(re.findall(r"(?m)^#", only(crank, "slider*.dat").read_text())) + 1)
    np.testing.assert_allclose(table[:, 3], 5000 * 2 * np.pi / 60 * table[:, 0], atol=1e-9)
    assert "set xrange [0:90]" in script and "set y2range [0:50]" in script
    assert "set xlabel 'motor.coordinate [deg]'" in script and "set xtics 15" in script
    assert "set ylabel 'velocity [mm/s]'" in script and "set y2label 'normal force [kN]'" in script
    assert re.search(r"using \(\$4\*57\.2958\):\(\$2\*1000\) .*title 'slider.velocity.x'", script)
    assert re.search(r"using \(\$4\*57\.2958\):\(\$3\*0\.001\) axes x1y2 .*title 'gudgeon.normal_force \(right\)'", script)
    assert only(crank, "slider*.png").stat().st_size > 5000


def test_panels(crank):
    """A panel each, the abscissa named once and below; components that nobody sees are left out, named ones are not."""
    script = only(crank, "panels*.gp").read_text(encoding="utf-8")
    assert script.count("set origin 0,") == 3 and script.count("\nplot ") == 3
    assert script.count("set xlabel 'time [µs]'") == 1 and script.index("set xlabel") > script.index("unset xlabel")
    labels = re.findall(r"set ylabel '(.*?)'", script)
    assert labels[:2] == ["angle [deg]", "velocity [m/s]"] and labels[2].startswith("kinetic [")
    assert "slider.velocity.x" in script and "crank.velocity.x" in script and "slider.velocity.y" not in script
    assert only(crank, "panels*.png").stat().st_size > 5000


def test_echo_draws_the_same(gudgeon, crank):
    """deck.echo, read again, asks for the same figures."""
    echo = (crank.parent / "deck.echo").read_text(encoding="utf-8")
    directory = scratch()
    call(gudgeon, "run", written(directory, echo), "--out", directory / "out", "--quiet")
    assert {path.name for path in (directory / "out" / "figures").iterdir()} == {path.name for path in crank.iterdir()}
    for path in crank.glob("*.gp"):
        assert (directory / "out" / "figures" / path.name).read_text() == path.read_text()


@pytest.mark.parametrize("frequency", [40, 900])
def test_solid_blocks_are_ranges(gudgeon, frequency):
    """A sine of 900 turns is drawn as its range and its mean, one of 40 as a line."""
    folder = drawn(gudgeon, SHAKER.replace("FREQUENCY", str(frequency)), "arm.angle")
    script = (folder / "arm.angle.gp").read_text(encoding="utf-8")
    assert ("filledcurves" in script) == (frequency == 900)
    if frequency == 40:
        assert not list(folder.glob("*.range.dat"))
        return
    text = (folder / "arm.angle.range.dat").read_text(encoding="utf-8")
    middle, least, greatest, mean = np.loadtxt([line for line in text.splitlines() if line[0] not in "#\""]).T
    np.testing.assert_allclose(middle, (np.arange(len(middle)) + 0.5) / len(middle), rtol=1e-12)
    assert np.all(least < -0.19) and np.all(greatest > 0.19) and np.all(abs(least) <= 0.2 * (1 + 1e-9))
    assert np.abs(mean[1:-1]).max() < 0.05
    assert "'arm.angle, range'" in script and "'mean'" in script


def ranges(script):
    """Ends of both axes as the script sets them."""
    return [re.search(rf"set {axis}range \[(.*?):(.*?)\]", script).groups() for axis in "xy"]


def test_curves_of_the_twin_are_not_cut(gudgeon):
    """The loose pendulum stays above zero, the ideal one does not: the axis reaches as far as the lower of them."""
    text = changed((DECK.parent / "double_pendulum.deck").read_text(encoding="utf-8"), "analysis.dynamic", end="2.4 s")
    folder = drawn(gudgeon, text, "second.position.y")
    least = [np.genfromtxt(folder.parent / f"second.{kind}dat", names=True)["secondpositionym"].min()
             for kind in ("", "ideal.")]
    assert least[0] > -1e-9 and least[1] < -0.05
    assert re.search(r"set yrange \[(.*?):", (folder / "second.position.y.gp").read_text(encoding="utf-8")).group(1) == "*"


def test_axes_that_end_at_zero(gudgeon):
    """A force over its penetration begins at zero both ways; a position that never rises above zero ends there."""
    text = (DECK.parent / "impact.deck").read_text(encoding="utf-8")
    folder = drawn(gudgeon, text, "portrait(contact.penetration, contact.normal_force)")
    script = only(folder, "*.gp").read_text(encoding="utf-8")
    assert ranges(script) == [("0", "*"), ("0", "*")] and "set offsets 0, graph 0.03, graph 0.05, 0" in script
    shaken = SHAKER.replace("0.2rad*sin(2*pi*t*FREQUENCY/1s)", "-1rad/s*t")
    script = only(drawn(gudgeon, shaken, "arm.angle"), "*.gp").read_text(encoding="utf-8")
    assert "set yrange [*:0]" in script and "set offsets 0, 0, 0, graph 0.05" in script


def test_components_of_a_vector_have_one_unit(gudgeon):
    """A portrait of 24.8 kN over 3.5 kN is in kN both ways; of quantities that lie far apart each has its own unit."""
    text = changed((DECK.parent / "big_end.deck").read_text(encoding="utf-8"), "analysis.dynamic", end="45 ms")
    text = text.replace('"engine_gas.txt"', f'"{DECK.parent / "engine_gas.txt"}"')
    folder = drawn(gudgeon, text, "portrait(big_end.force.x,big_end.force.y) portrait(rod.position.x,big_end.eccentricity.y)")
    script = only(folder, "portrait.big*.gp").read_text(encoding="utf-8")
    assert "big_end.force.x [kN]" in script and "big_end.force.y [kN]" in script
    script = only(folder, "portrait.rod*.gp").read_text(encoding="utf-8")
    assert "rod.position.x [mm]" in script and "big_end.eccentricity.y [µm]" in script


def test_mistakes_have_a_place(gudgeon):
    """The caret stands below the wrong part, and the nearest word is told."""
    text = DECK.read_text(encoding="utf-8")
    for figures, part, words in (
        ("slider.velocity.x + crank.angel against motor.coordinate", "crank.angel", "did you mean 'crank.angle'"),
        ("slider.velocity.x agianst motor.coordinate", "agianst", "did you mean 'against'"),
        ("slider.velocity.x against motor.coordinate in mm", "mm", "does not match the dimension"),
        ("slider.velocity.x in mm/s from 1 mm to 2 mm", "mm", "does not match the dimension"),
        ("against motor.coordinate", "against", "missing figure before"),
        ("gudgeon.orbit in mm", "in", "is valid for figures of curves"),
        ("panels(slider.velocity.x, crank.angle", "panels(slider.velocity.x, crank.angle", "missing closing parenthesis"),
    ):
        directory = scratch()
        done = call(gudgeon, "check", written(directory, changed(text, "output", figures=figures)), expect=3)
        assert words in done.stderr + done.stdout, figures
        line, caret = re.search(r"\| (figures.*)\n.*\| (\s*\^+)", done.stderr + done.stdout).groups()
        first = caret.index("^")
        assert line[first : first + caret.count("^")] == part, (figures, done.stderr)


BLOCK = """deck = 1
[scene]
title = "Thrown block"
gravity = 0 -9.81 m/s^2
[bodies]
name   mass[kg]   inertia[kg.m^2]   x[m]   y[m]   vx[m/s]   vy[m/s]
block  0.5        1e-4              0      0      1         2
[points]
name   body     xi[m]   eta[m]
guide  ground   0       0
pin    block    0       0
[material]
name   young[GPa]   poisson
steel  207          0.3
[contact.hertz]
name
hertz
[friction.rooney_deravi]
name   coefficient   v1[mm/s]
rubs   0.1           1
[clearance.translational]
name   guide   slider   axis   length[mm]   height[mm]   gap    corner_radius[mm]   material   law     friction
loose  guide   pin      x      40           20           1mm    1                   steel      hertz   rubs
[analysis.dynamic]
start = given
end   = 0.001 s
[output]
every = 0.01 ms
figures = loose.force
"""


def test_scale_of_the_ideal_joints_holds_their_curve(gudgeon, tmp_path):
    """A block thrown against the upper side of its guide: the force on it is downward, that of the ideal guide m g upward."""
    call(gudgeon, "run", written(tmp_path, BLOCK), "--out", tmp_path / "run", "--quiet")
    script = (tmp_path / "run" / "figures" / "loose.force.gp").read_text(encoding="utf-8")
    second = script.split("zoom on the ideal curves")[1]
    unit = {"N": 1.0, "kN": 1e3}[re.search(r"force \[(.*?)\]", second).group(1)]
    least, greatest = (float(end) * unit for end in re.search(r"set yrange \[(.*?):(.*?)\]", second).groups())
    assert least < 0.0 and greatest > 0.5 * 9.81


@pytest.mark.parametrize(
    ("figure", "changes", "first", "second"),
    [
        ("loose.force.y", (("0.5        1e-4", "5e-6       1e-4"), ("end   = 0.001", "end   = 0.003")), "N", "µN"),
        ("loose.force.y in kN", (("0.5        1e-4", "5e-3       1e-4"), ("end   = 0.001", "end   = 0.003")), "kN", "10⁻⁶ kN"),
        ("loose.force.y", (("0.5        1e-4", "5000       1e-4"), ("1         2", "1         0")), "kN", ""),
    ],
)
def test_prefixes_follow_what_is_drawn(gudgeon, figure, changes, first, second):
    """A block that hits its guide has forces far above m g: on the scale of the ideal joints they have a unit of their own. One
    that flies between its sides has none: the unit is that of m g."""
    text = BLOCK + "[force.point]\nname point fx fy\nshake pin {0 N} FORCE\n"
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    text = text.replace("FORCE", "{0.02N*sin(2*pi*t*2/1ms)}" if "kN" in figure else "{0.02mN*sin(2*pi*t*2/1ms)}")
    folder = drawn(gudgeon, text, figure)
    script = only(folder, "*.gp").read_text(encoding="utf-8")
    parts = script.split("zoom on the ideal curves")
    units = [re.search(r"set ylabel 'force \[(.*?)\]'", part).group(1) for part in parts]
    assert units == [first, second][: len(parts)] and len(parts) == (2 if second else 1)


def test_ticks_of_a_narrow_ordinate_differ(gudgeon, tmp_path):
    """A speed that differs from 62.83185307 rad/s by a billionth of it is drawn less a value so round that what is left fills the axis."""
    text = """deck = 1
[bodies]
name   mass[kg]   inertia[kg.m^2]   x[m]   y[m]   omega[rad/s]
wheel  1          1                 0      0      62.83185307
[force.torque]
name   body    moment
push   wheel   {1e-7 N.m*sin(2*pi*t/1s)}
[analysis.dynamic]
start     = given
end       = 1 s
tolerance = 1e-12
[output]
every   = 10 ms
figures = wheel.angular_velocity
"""
    call(gudgeon, "run", written(tmp_path, text), "--out", tmp_path / "run", "--quiet")
    script = (tmp_path / "run" / "figures" / "wheel.angular_velocity.gp").read_text(encoding="utf-8")
    round_value = float(re.search(r"less ([0-9.]+) rad/s", script).group(1))
    span = 1e-7 / np.pi
    assert abs(round_value - 62.83185307) < 1e4 * span


NARROW = """deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]  omega[rad/s]  vx[m/s]  vy[m/s]
fly   1         1                0     0     314.159       0        0
far   1         1                1000  1001  0             1e-3     2e-3
[force.torque]
name   body   moment
push   fly    {RIPPLE*sin(2*pi*t*5/1s)}
[analysis.dynamic]
start     = given
end       = 1 s
tolerance = 1e-12
[output]
every   = 10 ms
"""


@pytest.mark.parametrize(
    ("figure", "ripple", "words"),
    [
        ("fly.angular_velocity in rpm", "0.05 N.m", r"angular velocity less 3000 rpm \[rpm\]"),
        ("fly.angular_velocity in rpm", "5e-8 N.m", r"angular velocity less 2999.9974\d* rpm \[10⁻⁹ rpm\]"),
        ("far.position.x in mm", "0 N.m", r"position less 1e6 mm \[mm\]"),
        ("far.position.x from 999.9995 m to 1000.0005 m", "0 N.m", r"position less 1000 m \[mm\]"),
    ],
)
def test_narrow_ordinates_in_a_unit(gudgeon, figure, ripple, words):
    """An axis in a unit that is asked for, or with ends, shows what is beyond a round value too, and the curve is within its ends."""
    script = only(drawn(gudgeon, NARROW.replace("RIPPLE", ripple), figure), "*.gp").read_text(encoding="utf-8")
    assert re.search(f"set ylabel '{words}'", script), script
    assert re.search(r"using 1:\(\(\$\d+-\([0-9.]+\)\)\*", script), script
    if "from" in figure:
        assert "set yrange [-0.5:0.5]" in script


def test_narrow_portraits(gudgeon):
    """Both axes of a portrait show what is beyond a round value; numbers that do not change have ticks that differ."""
    folder = drawn(gudgeon, NARROW.replace("RIPPLE", "0 N.m"), "portrait(far.position.x,far.position.y) portrait(fly.angular_velocity,fly.angle)")
    script = (folder / "portrait.far.position.x.far.position.y.gp").read_text(encoding="utf-8")
    for axis, value in (("x", 1000), ("y", 1001)):
        assert re.search(rf"set {axis}label 'far.position.{axis} less {value} m \[mm\]'", script), script
    columns = re.search(r"plot '\.\./far\.dat' using \(\(\$(\d+)-\((\d+)\)\)\*1000\):\(\(\$(\d+)-\((\d+)\)\)\*1000\)", script).groups()
    rows = np.loadtxt(folder.parent / "far.dat")
    for column, less, speed in zip(columns[::2], columns[1::2], (1, 2)):
        np.testing.assert_allclose((rows[:, int(column) - 1] - float(less)) * 1000, speed * rows[:, 0], atol=1e-6)
    script = (folder / "portrait.fly.angular_velocity.fly.angle.gp").read_text(encoding="utf-8")
    least, greatest = (float(end) for end in re.search(r"set xrange \[(.*?):(.*?)\]", script).groups())
    assert least < 300 < 330 < greatest


def test_long_names_fit_their_panels(gudgeon):
    """A name that is longer than a sixth of the picture has smaller letters; in a picture of its own it has those of all."""
    text = NARROW.replace("RIPPLE", "0.05 N.m")
    one = "fly.angular_velocity in rpm"
    for figure, size in ((one, 15), ("panels(" + ", ".join(6 * [one]) + ")", 10)):
        script = only(drawn(gudgeon, text, figure), "*.gp").read_text(encoding="utf-8")
        assert set(re.findall(r"set ylabel 'angular velocity less 3000 rpm \[rpm\]' font ',(\d+)'", script)) == {str(size)}


@pytest.mark.parametrize(
    ("figure", "ends", "words"),
    [
        ("far.velocity.y against far.position.x", "0:1", r"far\.position\.x less 1000 m \[mm\]"),
        ("far.velocity.y against far.position.x in mm", "0:1", r"far\.position\.x less 1e6 mm \[mm\]"),
        ("panels(far.velocity.x, far.velocity.y) against far.position.x from 999.9995 m to 1000.0005 m", "-0.5:0.5",
         r"far\.position\.x less 1000 m \[mm\]"),
    ],
)
def test_narrow_abscissas(gudgeon, figure, ends, words):
    """The abscissa of one channel against another shows what is beyond a round value: ticks of 1000 m to 1000.001 m all read the same."""
    script = only(drawn(gudgeon, NARROW.replace("RIPPLE", "0 N.m"), figure), "*.gp").read_text(encoding="utf-8")
    assert re.search(f"set xlabel '{words}'", script), script
    assert f"set xrange [{ends}]" in script
    assert all(re.match(r"\(\(\$\d+-\(1000\)\)\*1000\):", columns) for columns in re.findall(r"using (\S+)", script)), script


def test_long_legends_have_room(gudgeon):
    """A panel with a legend of several rows is higher by these, and by the name of the abscissa: its plot is as high as the others."""
    folder = drawn(gudgeon, short(DECK.read_text(encoding="utf-8")),
                   "panels(slider.position.x, energy.*)  panels(slider.position.x, energy.kinetic)")
    rows = []
    for pattern in ("*all.gp", "*kinetic.gp"):
        script = only(folder, pattern).read_text(encoding="utf-8")
        whole = int(re.search(r"size \d+,(\d+)", script).group(1)) * 6 / 5
        sizes = [float(size) * whole for size in re.findall(r"set size 1,(\S+); set origin 0,", script)]
        places = [float(place) * whole for place in re.findall(r"set size 1,\S+; set origin 0,(\S+)", script)]
        assert len(sizes) == 2 and places[1] == 0 and abs(places[0] - sizes[1]) < 1.5
        rows.append((sizes[1] - sizes[0] - 55) / 28)
    assert abs(rows[1]) < 0.1 and abs(rows[0] - 1.0) < 0.1  # energies of contacts and friction, kinetic, drive_work: two columns


def test_names_of_figures(gudgeon, tmp_path):
    """`as NAME` names the files of any figure; a backslash continues a line; a name for two figures, or a bad one, is an error."""
    figures = "slider.velocity + slider.acceleration as motion_of-slider.1 \\\n  panels(slider.velocity, slider.position) against time in ms as all \\\n strip(n=3) as positions"
    base = changed(DECK.read_text(encoding="utf-8"), "analysis.dynamic", end="1 ms")
    call(gudgeon, "run", written(tmp_path, changed(base, "output", figures=figures)), "--out", tmp_path / "run", "--quiet")
    assert {path.name for path in (tmp_path / "run/figures").glob("*.png")} == {"motion_of-slider.1.png", "all.png", "positions.png"}
    for wrong, message in (("slider.velocity as a/b", "is not a name of files"), ("slider.velocity as", "missing argument after 'as'"),
                           ("slider.velocity as x slider.position as x", "have the same name of files, x"),
                           ("slider.velocity \\\n", "nothing follows the backslash")):
        done = call(gudgeon, "check", written(tmp_path, changed(base, "output", figures=wrong)), expect=3)
        assert message in done.stderr, done.stderr
