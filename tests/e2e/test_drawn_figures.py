"""Figures that draw the mechanism: places in their data against closed forms, frames, pages, mistakes."""

import json
import re

import h5py
import numpy as np
import pytest
from page_data import page_data
from support import DECK, ROOT, call, changed, written
from test_motion_file import CRANK
from test_universal_pair import DECK as UNIVERSAL

STYLES = ("ground", "body", "line", "path", "pin", "symbol", "hole", "journal", "arrow", "name")
TITLE = r"""a </script><script>alert(1)</script> & 'b' \"c\" `id`"""


def run(gudgeon, directory, text, figures, *options):
    """The directory of the figures of a deck."""
    call(gudgeon, "run", written(directory, changed(text, "output", figures=figures, motion=None)), "--out", directory / "run",
         "--quiet", *options)
    return directory / "run" / "figures"


def strokes(path):
    """Polylines by style, of each frame, in metres."""
    text = path.read_text(encoding="utf-8")
    unit = {"mm": 1e-3, "m": 1.0, "µm": 1e-6}[re.search(r"x \[(.*?)\]", text).group(1)]
    blocks = [block for block in text.split("\n", 1)[1].split("\n\n\n") if block.strip()]
    lines = [[np.loadtxt(part.splitlines(), ndmin=2, usecols=(0, 1)) * unit for part in block.split("\n\n") if part.strip()] for block in blocks]
    assert len(lines) % len(STYLES) == 0
    return [dict(zip(STYLES, lines[k : k + len(STYLES)])) for k in range(0, len(lines), len(STYLES))]


def test_path_of_a_point(gudgeon, tmp_path):
    """The tip of a crank goes on its circle, all the way; the mechanism stands where the run ends."""
    found = strokes(run(gudgeon, tmp_path, CRANK, "coupler(tip)") / "coupler.tip.dat")
    assert len(found) == 1 and len(found[0]["path"]) == 1
    path = found[0]["path"][0]
    np.testing.assert_allclose(np.hypot(*path.T), 0.5, rtol=1e-5)
    np.testing.assert_allclose(np.unwrap(np.arctan2(path[:, 1], path[:, 0])), 7 * np.arange(101) * 0.01, atol=1e-4)
    np.testing.assert_allclose(found[0]["line"][0], [[0, 0], [0.5 * np.cos(7), 0.5 * np.sin(7)]], atol=1e-5)


@pytest.mark.parametrize(("every", "is_told"), [("10 ms", False), ("100 ms", True)])
def test_a_path_of_few_rows_says_so(gudgeon, tmp_path, every, is_told):
    """Chords of a path that turns by 0.7 rad from row to row are no circle: the figure says what they are."""
    folder = run(gudgeon, tmp_path, changed(CRANK, "output", every=every), "coupler(tip)")
    assert ("straight lines between output times" in (folder / "coupler.tip.gp").read_text()) == is_told


def test_strip_over_the_last_turn(gudgeon, tmp_path):
    """Positions at equal parts of the last turn, at the output instants nearest to them."""
    found = strokes(run(gudgeon, tmp_path, CRANK, "strip(n=5)") / "strip.n.5.dat")
    turn = 2 * np.pi / 7
    times = np.round((1 - turn + turn * np.arange(5) / 5) / 0.01) * 0.01
    tips = np.array([line[1] for line in found[0]["line"]])
    np.testing.assert_allclose(tips, 0.5 * np.stack([np.cos(7 * times), np.sin(7 * times)], axis=1), atol=1e-5)


def test_animation(gudgeon, tmp_path):
    """As many pictures as asked for in the GIF and in the page, at their times; text of the deck stays text."""
    folder = run(gudgeon, tmp_path, changed(CRANK, "scene", title=f'"{TITLE}"'), "animation(n=12, last = 1 turn of motor)")
    name = "animation.n.12.last.1turnofmotor"
    found = strokes(folder / f"{name}.dat")
    assert len(found) == 12
    turn = 2 * np.pi / 7
    for k, frame in enumerate(found):
        t = np.round((1 - turn + turn * k / 12) / 0.01) * 0.01
        np.testing.assert_allclose(frame["line"][0][1], [0.5 * np.cos(7 * t), 0.5 * np.sin(7 * t)], atol=1e-5)
    picture = (folder / f"{name}.gif").read_bytes()
    assert picture[:6] == b"GIF89a" and picture.count(b"\x21\xf9\x04") == 12 and len(picture) < 2_000_000
    page = (folder / f"{name}.html").read_text(encoding="utf-8")
    assert page.count("<script>") == 3 and "alert(1)</script>" not in page
    data = page_data(folder / f"{name}.html")
    assert data["repeats"] and len(data["t"]) == 13 and abs(data["t"][-1] - 1) < 1e-12, "the page has the end of the turn too"
    listed = json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))
    assert [f"figures/{name}.gif", f"figures/{name}.html"] == listed["figures"] and not listed["warnings"]
    assert not list(folder.glob("*.png")) and not list(folder.glob("*.log"))


def test_loose_joint_is_magnified(gudgeon, tmp_path):
    """The journal lies in its symbol as in run.h5, magnified by the factor that the picture states; the arrow is the force."""
    text = changed(DECK.read_text(encoding="utf-8"), "analysis.dynamic", end="3 ms")
    folder = run(gudgeon, tmp_path, text, "mechanism(t=2ms)")
    frame = strokes(folder / "mechanism.t.2ms.dat")[0]
    script = (folder / "mechanism.t.2ms.gp").read_text(encoding="utf-8")
    factor = float(re.search(r"clearance × ([0-9.e+]+)", script).group(1))
    with h5py.File(tmp_path / "run" / "run.h5") as file:
        row = np.flatnonzero((file["row_kind"][:] == 0) & (abs(file["time"][:] - 2e-3) < 1e-9))[0]
        eccentricity = file["clearances/eccentricity"][row, 0]
        force = file["clearances/force"][row, 0]
    hole, journal = (frame[style][0][:-1].mean(axis=0) for style in ("hole", "journal"))
    np.testing.assert_allclose(journal - hole, factor * eccentricity, rtol=0.02)
    arrow = frame["arrow"][0][1] - frame["arrow"][0][0]
    np.testing.assert_allclose(arrow / np.hypot(*arrow), force / np.hypot(*force), atol=1e-3)
    assert float(re.search(r"longest arrow ([0-9.]+) N", script).group(1)) == float(f"{np.hypot(*force):.3g}")


def test_paths_are_thinned_and_keep_peaks(gudgeon, tmp_path):
    """Of 12,000 rows the page has no more than 4000, in order, with the greatest force of all."""
    text = changed(DECK.read_text(encoding="utf-8"), "output", every="2 us")
    folder = run(gudgeon, tmp_path, text, "animation(n=2, last=24ms)")
    track = page_data(folder / "animation.n.2.last.24ms.html")["track"]
    times, forces = track["t"], track["f"][0]
    with h5py.File(tmp_path / "run" / "run.h5") as file:
        size = np.linalg.norm(file["clearances/force"][:, 0], axis=1)
        assert len(size) > 12000
    assert 2000 <= len(times) == len(forces) <= 4000 and np.all(np.diff(times) >= 0)
    assert times[0] == 0 and times[-1] > 23.9e-3 and abs(np.linalg.norm(forces, axis=1).max() - size.max()) < 1e-4 * size.max()


def test_space_in_four_views(gudgeon, tmp_path):
    """A spatial scene stands in four views; the last is along z, the second along y."""
    text = (DECK.parent / "four_bar_spatial.deck").read_text(encoding="utf-8")
    text = changed(text, "analysis.dynamic", end="10 ms")
    folder = run(gudgeon, tmp_path, text, "mechanism(t=0s)")
    lines = strokes(folder / "mechanism.t.0s.dat")[0]["line"]
    assert len(lines) == 12  # three bodies in four views
    crank, coupler = lines[3:5]
    np.testing.assert_allclose(crank[1] - crank[0], [0, 0.02], atol=1e-6)
    np.testing.assert_allclose(coupler[1] - coupler[0], [-0.0749111544, 0.0452473088], atol=1e-5)
    np.testing.assert_allclose(lines[10][1] - lines[10][0], [-0.0749111544, -0.085], atol=1e-5)


def test_labels_of_views_are_in_the_picture(gudgeon, tmp_path):
    """Each view of a scene that is wide in one and high in another has its label within the frame, above what it shows."""
    text = changed((DECK.parent / "pinball.deck").read_text(encoding="utf-8"), "analysis.dynamic", end="1 ms")
    script = (run(gudgeon, tmp_path, text, "mechanism(t=0s)") / "mechanism.t.0s.gp").read_text(encoding="utf-8")
    (x0, x1), (y0, y1) = (map(float, re.search(rf"set {axis}range \[(.*):(.*)\]", script).groups()) for axis in "xy")
    labels = re.findall(r"set label '(\w, \w)' at (\S+), (\S+) center", script)
    assert [name for name, _, _ in labels] == ["x, z", "y, z", "x, y"]
    for _, x, y in labels:
        assert x0 < float(x) < x1 and y0 < float(y) < y1


def test_walls_of_a_guide_touch_what_slides(gudgeon, tmp_path):
    """The piston of [shapes] is 18 mm high: so far apart are the walls of its guide."""
    text = changed(DECK.read_text(encoding="utf-8"), "analysis.dynamic", end="1 ms")
    frame = strokes(run(gudgeon, tmp_path, text, "mechanism(t=1ms)") / "mechanism.t.1ms.dat")[0]
    walls = [line for line in frame["ground"] if len(line) == 2 and np.ptp(line[:, 0]) > 0.02 and np.ptp(line[:, 1]) < 1e-9]
    piston = max(frame["body"], key=lambda line: line[:, 0].mean())
    np.testing.assert_allclose(sorted(wall[0, 1] for wall in walls), [piston[:, 1].min(), piston[:, 1].max()], atol=1e-6)


def test_a_disc_shows_its_turn(gudgeon, tmp_path):
    """The diameter of a disc that rolls down an incline is turned by the way over the radius, in every position."""
    deck = (DECK.parent / "incline.deck").read_text(encoding="utf-8")
    found = strokes(run(gudgeon, tmp_path, deck, "strip(n=6)") / "strip.n.6.dat")[0]["line"]
    rims, diameters = ([line for line in found if len(line) == n] for n in (97, 2))
    assert len(rims) == len(diameters) == 6
    centres = np.array([line[:-1].mean(axis=0) for line in rims])
    turns = np.unwrap([np.arctan2(*(line[0] - line[1])[::-1]) for line in diameters])
    assert np.allclose([line.mean(axis=0) for line in diameters], centres, atol=1e-6)
    np.testing.assert_allclose(turns - turns[0], np.hypot(*(centres - centres[0]).T) / 0.05, atol=0.02)


ELEMENT = """deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]  vx[m/s]
cart  1         1                1     0     1
[points]
name  body    xi[m]  eta[m]
post  ground  0      0
eye   cart    0      0
[force.spring]
name  i     j    stiffness[N/m]  damping[N.s/m]  law
line  post  eye  STIFFNESS       2               LAW
[analysis.dynamic]
end = 0.1 s
[output]
every = 0.1 s
"""


@pytest.mark.parametrize(("stiffness", "law", "lines"), [(5, "{0 N}", 1), (0, "{3 N/m*x}", 1), (0, "{0 N}", 4), (0, "-", 4)])
def test_springs_and_dampers(gudgeon, tmp_path, stiffness, law, lines):
    """A spring is one line with a zigzag, a damper a piston in a cylinder; a wall stands across it where it is fixed."""
    text = ELEMENT.replace("STIFFNESS", str(stiffness)).replace("LAW", law)
    frame = strokes(run(gudgeon, tmp_path, text, "mechanism(t=0s)") / "mechanism.t.0s.dat")[0]
    assert len(frame["symbol"]) == lines
    ends = np.concatenate(frame["symbol"])
    assert np.isclose(ends[:, 0].min(), 0) and np.isclose(ends[:, 0].max(), 1) and np.ptp(ends[:, 1]) > 0.01
    wall = frame["ground"][0]
    assert np.allclose(wall[:, 0], 0) and np.isclose(wall[:, 1].sum(), 0) and np.ptp(wall[:, 1]) > 0.02
    assert all(line[:, 0].max() < 1e-9 for line in frame["ground"]), "hatched behind the wall"


@pytest.mark.parametrize("stiffness", [5, 0])
def test_a_short_spring_is_slender(gudgeon, tmp_path, stiffness):
    """In a scene of 30 m a spring or damper of 1 m is at most 0.4 of its length wide, its corners are few, and no picture has others."""
    text = ELEMENT.replace("STIFFNESS", str(stiffness)).replace("LAW", "-").replace("every = 0.1 s", "every = 10 ms")
    folder = run(gudgeon, tmp_path, text.replace("[force.spring]", "far ground 30 0\n[force.spring]"), "animation(n=4)")
    found = strokes(folder / "animation.n.4.dat")
    widths = [np.ptp(np.concatenate(frame["symbol"])[:, 1]) for frame in found]
    lengths = [np.ptp(np.concatenate(frame["symbol"])[:, 0]) for frame in found]
    assert max(widths) <= 0.4 * max(lengths) * 1.001 and np.ptp(widths) < 1e-3 and min(widths) > 0.1 * max(lengths)
    assert {sum(len(line) for line in frame["symbol"]) for frame in found} == ({6} if stiffness else {10})
    assert all(np.ptp(frame["ground"][0][:, 1]) < 1 for frame in found)
    half = page_data(folder / "animation.n.4.html")["marks"][0]["c"]
    assert abs(2 * half - widths[0]) < 1e-3


def test_loads_are_arrows(gudgeon, tmp_path):
    """A force at a point, 3 t and 4 t, is an arrow from there, whose length goes with it; the picture states the longest."""
    text = ELEMENT.replace("STIFFNESS", "5").replace("LAW", "-").replace("every = 0.1 s", "every = 10 ms")
    text += "[force.point]\nname point fx fy\npush eye {30 N/s*t} {40 N/s*t}\n"
    folder = run(gudgeon, tmp_path, text, "animation(n=6, last=50ms)")
    found = strokes(folder / "animation.n.6.last.50ms.dat")
    arrows = np.array([frame["arrow"][0][1] - frame["arrow"][0][0] for frame in found])
    sizes = np.hypot(*arrows.T)
    np.testing.assert_allclose(arrows / sizes[:, None], np.tile([0.6, 0.8], (6, 1)), atol=1e-3)
    np.testing.assert_allclose(sizes / sizes[-1], np.arange(5, 11) / 10, rtol=1e-3)
    with h5py.File(tmp_path / "run" / "run.h5") as file:
        row = np.argmin(abs(file["time"][:] - 0.1))
        np.testing.assert_allclose(found[-1]["arrow"][0][0], file["bodies/position"][row, 0], atol=1e-4)
    assert "longest arrow 5 N" in (folder / "animation.n.6.last.50ms.gp").read_text(encoding="utf-8")
    assert "arrows: loads and forces on journals, longest 5 N" in (folder / "animation.n.6.last.50ms.html").read_text(encoding="utf-8")
    data = page_data(folder / "animation.n.6.last.50ms.html")
    (mark,) = (mark for mark in data["marks"] if mark["n"] == "push")
    np.testing.assert_allclose(data["g"][:, mark["q"] - 1, :2], np.outer(np.arange(5, 11) / 10, [3, 4]), rtol=1e-6)


@pytest.mark.parametrize(
    ("figure", "message"),
    [
        ("coupler(tipp)", "unknown point 'tipp'"),
        ("coupler()", "write mechanism("),
        ("animaton", "did you mean 'animation'?"),
        ("mecanism(t=2ms)", "did you mean 'mechanism(t=2ms)'?"),
        ("mechanism(t=2s)", "is not an output time"),
        ("mechanism(t=2ms,1ms)", "times must increase"),
        ("mechanism(t=2)", "not a time of the run"),
        ("strip(n=1)", "not a number of pictures"),
        ("animation(last = 1 turns of moter)", "unknown driver 'moter'"),
        ("animation(last = 9 turns of motor)", "never completes so many turns"),
        ("strip(last = 3 s)", "before the first output time"),
    ],
)
def test_mistakes(gudgeon, tmp_path, figure, message):
    """Each is told at its word."""
    deck = written(tmp_path, changed(CRANK, "output", figures=figure))
    done = call(gudgeon, "check", deck, expect=3)
    assert message in done.stderr and "scene.deck:21" in done.stderr, done.stderr


def test_a_run_that_ends_early_draws_what_it_reached(gudgeon, tmp_path):
    """Frames after a stop are left out, the last is that of the stop, and a figure without any is told."""
    text = CRANK + "[guards]\nstop = crank.angle > 3 rad\n"
    folder = run(gudgeon, tmp_path, text, "animation(n=10, last=1s) mechanism(t=0.9s)")
    assert len(strokes(folder / "animation.n.10.last.1s.dat")) == 5
    listed = json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))
    assert listed["warnings"] == [
        "figure mechanism(t=0.9s): no values to draw: the output times shown have no values (`from` and `last` in [output], the end of the run)"
    ]


@pytest.mark.parametrize("figure", ["mechanism", "strip(n=3)", "animation(n=4)", "mechanism(t=0.1s,0.9s)"])
@pytest.mark.parametrize("force", ["{-5N}", "{5N}"])
def test_arrows_end_within_the_picture(gudgeon, tmp_path, figure, force):
    """Whichever way a force points, its arrow, a quarter of the size of the scene, is not cut by the frame."""
    (path,) = run(gudgeon, tmp_path, CRANK + f"\n[force.point]\nname point fx fy\npush tip {force} {force}\n", figure).glob("*.dat")
    script = path.with_suffix(".gp").read_text(encoding="utf-8")
    frame = np.array([[float(end) for end in re.search(rf"set {axis}range \[(.*?):(.*?)\]", script).groups()] for axis in "xy"])
    unit = {"mm": 1e-3, "m": 1.0}[re.search(r"x \[(.*?)\]", path.read_text(encoding="utf-8")).group(1)]
    arrows = [line for one in strokes(path) for line in one["arrow"] if len(line) > 1]
    assert arrows
    for line in arrows:
        assert np.all(line >= unit * frame[:, 0]) and np.all(line <= unit * frame[:, 1]), (line, frame)


@pytest.mark.parametrize(("point", "is_beyond"), [("", False), ("eye slider 10 0\n", False), ("eye slider 10 90\n", True)])
def test_loose_slider_has_its_size(gudgeon, tmp_path, point, is_beyond):
    """A slider loose in a guide is drawn with length and height of its row, whatever points it has, between its walls, gaps
    included; a line goes to a point beyond it."""
    text = (ROOT / "inputs" / "slider_crank_translational.deck").read_text()
    text = changed(text.replace("pin      slider     0      0\n", f"pin slider 0 0\n{point}"), "analysis.dynamic", end="0.2 ms")
    row = text.split("[clearance.translational]")[1].splitlines()
    head, cells = row[1].split(), row[2].split()
    length, height = (float(cells[head.index(name)]) * 1e-3 for name in ("length[mm]", "height[mm]"))
    gap = 0.5e-3
    folder = run(gudgeon, tmp_path, text, "mechanism(t=0ms) animation(n=2)")
    frame = strokes(folder / "mechanism.t.0ms.dat")[0]
    sides = [np.ptp(line, axis=0) for line in frame["body"]]
    assert sum(np.allclose(side, [length, height], rtol=0.02) for side in sides) == 1, sides
    walls = [line for line in frame["ground"] if len(line) == 2 and np.ptp(line[:, 0]) > length and np.ptp(line[:, 1]) < 1e-9]
    np.testing.assert_allclose(np.ptp([wall[0, 1] for wall in walls]), height + 2 * gap, rtol=1e-3)
    ends = np.concatenate([line for line in frame["line"] if len(line) == 2])
    assert (ends[:, 1].max() > 0.08) == is_beyond
    marks = page_data(folder / "animation.n.2.html")["marks"]
    assert any(np.allclose(mark["h"], height / 2 + gap, rtol=1e-3) for mark in marks)


def test_loose_block_of_space_has_its_size(gudgeon, tmp_path):
    """In space too: length along the guide, width along `width_axis`, height across both, in the side view and from above."""
    text = (ROOT / "inputs" / "crosshead.deck").read_text().replace("20          20           40 ", "24          16           40 ")
    text = changed(text, "analysis.dynamic", end="2 ms")
    found = strokes(run(gudgeon, tmp_path, text, "mechanism(t=0ms)") / "mechanism.t.0ms.dat")
    sides = [tuple(np.round(np.ptp(line, axis=0), 6)) for line in found[0]["body"]]
    for want in ((0.040, 0.024), (0.040, 0.016), (0.024, 0.016)):  # the three pairs of sides, each seen square in one of the views
        assert any(np.allclose(sorted(side), sorted(want), atol=2e-4) for side in sides), (want, sides)


def test_ticks_of_a_section_are_apart(gudgeon, tmp_path):
    """A quick return with a loose bearing repeats itself to micrometres: few ticks, that differ, and none that touches the next."""
    text = (ROOT / "inputs" / "quick_return.deck").read_text().replace("stand   foot    heel\n", "")
    text = text.replace("[joint.distance]", "[material]\nname young[GPa] poisson\nsteel 207 0.3\n[clearance.revolute]\nname bearing journal "
                        "bearing_radius[mm] clearance[mm] material law\nstand foot heel 20 0.1 steel ln\n[contact.lankarani_nikravesh]\n"
                        "name restitution\nln 0.9\n[statistics]\nperiod = 1 turn of motor\nafter = 3 turns of motor\n[joint.distance]")
    text = changed(changed(text, "analysis.dynamic", end="6 turns of motor", tolerance="1e-6"), "output", report="off")
    figures = "section(arm.angle,arm.angular_velocity) section(ram.position.x,ram.velocity.x) section(arm.position.x,arm.position.y)"
    folder = run(gudgeon, tmp_path, text, figures)
    scripts = sorted(folder.glob("section.*.gp"))
    assert len(scripts) == 3
    for script in scripts:
        words = script.read_text(encoding="utf-8")
        for axis, column, room in (("x", 1, 1000), ("y", 2, 10000)):
            values = np.loadtxt(script.with_suffix(".dat"))[:, column]
            factor = float(re.search(r"using \(\$2\*([0-9.eE+-]+)\):\(\$3\*([0-9.eE+-]+)\)", words).group(column))
            low, high = factor * values.min(), factor * values.max()
            found = re.search(rf"set {axis}tics ([0-9.eE+-]+); set format {axis} '(%.[0-9]+f)'", words)
            assert found, (script.name, axis)
            step = float(found.group(1))
            ticks = step * np.arange(np.floor(low / step) - 1, np.ceil(high / step) + 2)
            labels = [found.group(2) % tick for tick in ticks]
            assert len(set(labels)) == len(labels) <= 9 and (high - low) / step <= 4.0 + 1e-9
            assert sum(10 * len(label) + 15 for label in labels) <= room, labels


YOKE = """deck = 1
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[mm]
crank  0.5       2e-4             0
yoke   2         1e-2             50
[points]
name  body    xi[mm]
O     ground  0
wall  ground  150
hub   crank   0
pin   crank   50
slot  yoke    0
[joint.revolute]
name   i  j
shaft  O  hub
[joint.translational]
name   i  j     axis
guide  O  slot  x
[joint.pin_in_slot]
name   i     j    axis
slide  slot  pin  y
[force.spring]
name    i     j     stiffness[N/m]
return  slot  wall  800
[driver.angle]
name   joint  angle
motor  shaft  {cycloidal(t, 0s, 0deg, 0.8s, 360deg)}
[analysis.dynamic]
end = 1 s
[output]
every = 1 ms
"""


def test_a_motion_from_rest_to_rest_is_shown_to_its_end(gudgeon, tmp_path):
    """Of a turn that is not even the last position is drawn, in a strip, a GIF and a page, whose curves go to the end too."""
    folder = run(gudgeon, tmp_path, YOKE, "strip(n=6) animation(n=11) panels(yoke.position.x in cm, yoke.velocity.x + return.tension) against time in ms")
    assert "6 positions, the last at 1 s" in (folder / "strip.n.6.gp").read_text(encoding="utf-8")
    assert len(strokes(folder / "animation.n.11.dat")) == 11
    data = page_data(folder / "animation.n.11.html")
    assert not data["repeats"] and len(data["t"]) == 11 and abs(data["t"][-1] - 1) < 1e-9
    assert [(plot["title"], plot["unit"]) for plot in data["plots"]] == [("yoke.position.x", "cm"), ("yoke.velocity.x", "m/s"), ("return.tension", "N")]
    x = data["plots"][0]["curves"][0]
    assert x["x"][-1] == 1 and abs(x["y"].max() - 5) < 1e-5 and abs(x["y"].min() + 5) < 1e-3


def test_a_slot_is_as_long_as_the_way_of_its_pin(gudgeon, tmp_path):
    """The pin goes 50 mm up and down: the slot, fixed in the yoke, is longer by its ends; the pin is in it at every position."""
    found = strokes(run(gudgeon, tmp_path, YOKE, "animation(n=41)") / "animation.n.41.dat")
    for frame in found:
        slots = [line for line in frame["symbol"] if len(line) == 5]
        (pin,) = (p.mean(axis=0) for p in (line[:-1] for line in frame["pin"]) if abs(np.hypot(*p.mean(axis=0)) - 0.05) < 1e-5)
        (slot,) = (line for line in slots if np.ptp(line[:, 1]) > 0.09)
        low, high = slot.min(axis=0), slot.max(axis=0)
        assert np.all(pin > low) and np.all(pin < high) and abs(pin[0] - (low + high)[0] / 2) < 1e-6
        assert 0.099 < high[1] - low[1] < 0.12 and high[0] - low[0] < 0.01


BORE = """deck = 1
[bodies]
name     mass[kg]  inertia[kg.m^2]
journal  1         1e-3
[points]
name  body
B     ground
J     journal
[material]
name   young[GPa]  poisson
steel  207         0.3
[contact.lankarani_nikravesh]
name  restitution
hit   0.5
[clearance.revolute]
name  bearing  journal  bearing_radius[mm]  clearance[um]  material  law
brg   B        J        30                  40             steel     hit
[force.point]
name  point  fx
load  J      100N
[analysis.dynamic]
end = 10 ms
[output]
every = 0.1 ms
"""


def test_a_bearing_has_its_size(gudgeon, tmp_path):
    """A bearing of 60 mm is 60 mm wide; its journal touches the wall where its eccentricity is the clearance, and has a diameter."""
    folder = run(gudgeon, tmp_path, BORE, "mechanism animation(n=5)")
    frame = strokes(folder / "mechanism.dat")[0]
    (hole,), (journal, diameter) = frame["hole"], frame["journal"]
    np.testing.assert_allclose(np.ptp(hole, axis=0), 0.06, rtol=1e-3)
    assert len(diameter) == 2 and 0.048 < np.ptp(journal[:, 0]) < 0.058
    np.testing.assert_allclose(np.hypot(*(diameter[1] - diameter[0])), np.ptp(journal[:, 0]), rtol=2e-3)
    factor = float(re.search(r"clearance × ([0-9.e+]+)", (folder / "mechanism.gp").read_text(encoding="utf-8")).group(1))
    np.testing.assert_allclose((np.ptp(hole[:, 0]) - np.ptp(journal[:, 0])) / 2, factor * 40e-6, rtol=0.02)
    data = page_data(folder / "animation.n.5.html")
    (mark,) = (mark for mark in data["marks"] if mark["n"] == "brg")
    np.testing.assert_allclose(mark["R"], [0.03, 0.03 - data["magnified"] * 40e-6], rtol=1e-6)


def test_turns_of_shafts_are_seen(gudgeon, tmp_path):
    """Arms of crosses and bars of shafts are in the page; a shaft in a cylindrical joint has a bar as well."""
    text = UNIVERSAL.replace("METHOD", "auto").replace("SOLVER", "schur").replace("STABILISE", "projection").replace(
        "channels = input.spin middle.spin output.spin input.orientation\n", "").replace("[joint.revolute]\nname   i     j  axis_i\nfirst  left  i1 \"1 0 0\"\nsecond right o2 \"1 0 0\"",
                             "[joint.revolute]\nname i j axis_i\nfirst left i1 \"1 0 0\"\n[joint.cylindrical]\nname i j axis_i\nsecond right o2 \"1 0 0\"")
    assert "cylindrical" in text
    data = page_data(run(gudgeon, tmp_path, text, "animation(n=3)") / "animation.n.3.html")
    crosses = [mark for mark in data["marks"] if np.any(mark["aj"])]
    assert [mark["n"] for mark in crosses] == ["near", "far"] and all(np.any(mark["a"]) for mark in crosses)
    bars = {part["b"]: part for part in data["parts"] if len(part["l"]) == 2}
    assert sorted(bars) == [1, 3], "input and output"
    for part in bars.values():
        (first, second) = (part["s"][line[1]] - part["s"][line[0]] for line in part["l"])
        assert abs(np.dot(first, second)) < 1e-6
