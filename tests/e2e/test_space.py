"""Mechanisms in space against closed forms, independent integrations, the plane, and themselves turned."""

import re

import numpy as np
import pytest
from support import ROOT, Run, call, changed, plain, plain_deck, scratch, written
from translated import in_space

DECKS = ROOT / "inputs"


def run_text(program, text, **settings):
    """Run a deck with other settings of the analysis, without figures."""
    directory = scratch()
    call(program, "run", written(directory, changed(text, "analysis.dynamic", **settings)), "--out", directory / "out", "--quiet",
         "--write", "channels")
    return Run(directory / "out")


def deck(name):
    """Text of a deck of inputs/."""
    return (DECKS / name).read_text()


def channel(run, name):
    """A time history by the name that it has in a deck."""
    item, quantity = name.split(".")
    if item == "energy":
        return run.read(f"energy/{quantity}")
    for room in ("bodies", "joints", "drivers", "clearances"):
        try:
            return run.item(f"{room}/{quantity}", item)
        except (KeyError, ValueError):
            continue
    raise KeyError(name)


def near(actual, expected, absolute, what):
    """Within a limit, or one each."""
    assert np.all(abs(np.asarray(actual) - np.asarray(expected)) <= np.asarray(absolute)), (
        f"{what}: {actual} for {expected}, off by {abs(np.asarray(actual) - np.asarray(expected))}")


def at(run, t):
    """Row of a time."""
    k = int(np.argmin(abs(run.time - t)))
    assert abs(run.time[k] - t) < 1e-9
    return k


METHODS = [{}, {"method": "dop853"}, {"method": "adams", "tolerance": "1e-11"}, {"method": "bdf", "tolerance": "1e-11"},
           {"method": "ida", "tolerance": "1e-10"}]


@pytest.mark.parametrize("settings", METHODS, ids=str)
def test_tumbling_body(gudgeon, settings):
    """Euler's equations: Jacobi's elliptic functions."""
    run = run_text(gudgeon, deck("hard/tumbling_body.deck"), **settings)
    limit = {"{}": 2e-9, "{'method': 'dop853'}": 1e-9}.get(str(settings), 1e-4)  # passing an unstable turn, round-off grows
    spin = channel(run, "body.spin")
    for t, expected in ((0.5, (-2.755093076653706, 14.74515046172723, 1.592747925340059)),
                        (1.0, (-4.175541761862209, -14.40745817259049, 2.412132459398762)),
                        (5.0, (14.38320617286519, 4.258330681012523, 8.304549351834158))):
        near(spin[at(run, t)], expected, limit, f"spin at {t} s")
    w = channel(run, "body.spin")
    h = np.linalg.norm(w * np.array([1.0, 2.0, 3.0]), axis=1)
    near(h, np.full(len(h), 30.001666620372942), 10 * limit, "angular momentum")


@pytest.mark.parametrize("settings", METHODS, ids=str)
def test_heavy_top(gudgeon, settings):
    """Nutation of a top that is released with a spin: an independent integration of its two angles."""
    run = run_text(gudgeon, deck("hard/heavy_top.deck"), **settings)
    limit = 1e-9 if not settings or settings["method"] == "dop853" else 1e-4
    r = channel(run, "top.position")
    theta = np.arccos(r[:, 2] / 0.5)
    phi = np.arctan2(r[:, 1], r[:, 0])
    near(theta[at(run, 0.5)], 1.225043183976763, limit, "theta at 0.5 s")
    near(theta[at(run, 1.0)], 0.9921776458293687, limit, "theta at 1 s")
    near(phi[at(run, 0.5)], 0.9409055358087592, limit, "phi at 0.5 s")
    near(phi[at(run, 1.0)], 3.095658019763792, limit, "phi at 1 s")


PENDULUM = """deck = 1
[scene]
space = spatial
gravity = {g} m/s^2
[bodies]
name  mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] xi_axis eta_axis
bar   1        0.08333     1e-3        0.08333     {r}  "{xi}"  "{eta}"
[points]
name   body    eta[m]
pivot  ground  0
top    bar     -0.5
[joint.revolute]
name  i      j    axis_i
pin   pivot  top  "{axis}"
[analysis.dynamic]
end = 2 s
tolerance = 1e-12
[output]
every = 0.1 s
"""


def rotation(seed):
    """Any rotation."""
    q = np.random.default_rng(seed).normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def words(vector):
    """Numbers as in a deck."""
    return " ".join(repr(float(x)) for x in vector)


def test_pendulum_about_tilted_axes(gudgeon):
    """A pendulum about any axis is that of the plane: the same angles."""
    planar = run_text(gudgeon, """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name  mass[kg] inertia[kg.m^2] x[m]  y[m] angle[deg]
bar   1        0.08333         0.5   0    -90
[points]
name   body    xi[m] eta[m]
pivot  ground  0     0
top    bar     0     -0.5
[joint.revolute]
name  i      j
pin   pivot  top
[analysis.dynamic]
end = 2 s
tolerance = 1e-12
[output]
every = 0.1 s
""")
    for seed in range(3):
        a = rotation(seed)
        run = run_text(gudgeon, PENDULUM.format(g=words(a @ [0, -9.81, 0]), r=words(a @ [0.5, 0, 0]), xi=words(a @ [0, -1, 0]),
                                                eta=words(a @ [1, 0, 0]), axis=words(a @ [0, 0, 1])))
        flat = channel(run, "bar.position") @ a
        near(flat[:, :2], channel(planar, "bar.position"), 1e-9, f"rotation {seed}")
        near(flat[:, 2], np.zeros(len(flat)), 1e-12, "stays in its plane")
        near(np.linalg.norm(channel(run, "pin.force"), axis=1), np.linalg.norm(channel(planar, "pin.force"), axis=1), 1e-8,
                     "reaction")


@pytest.mark.parametrize("settings", METHODS, ids=str)
def test_double_pendulum(gudgeon, settings):
    """Without clearance: an independent integration of both angles."""
    text = deck("double_pendulum.deck").replace("   law   stiffness\n", "   law   stiffness   level\n").replace(
        "      ln    full", "      ln    full        ideal")
    text = changed(text, "output", every="0.25 s")
    run = run_text(gudgeon, text, **{"end": "1 s", "tolerance": "1e-11", **settings})
    limit = 1e-8 if not settings or settings["method"] == "dop853" else 1e-5
    r = channel(run, "second.position")
    near(r[at(run, 0.5)], (0.39670707059920635, 0.9734099528021545, 0.3809154288320489), limit, "0.5 s")
    near(r[at(run, 0.75)], (-0.55715678286395, 0.9627751913258663, -0.11242886762809075), limit, "0.75 s")


def test_double_pendulum_with_clearance(gudgeon):
    """Both bases fall freely and touch at once, after sqrt(2 c/g)."""
    run = run_text(gudgeon, changed(deck("double_pendulum.deck"), "output", every="1 ms"), end="0.02 s", tolerance="1e-10")
    first = run.contacts[:2]
    assert {plain(row["contact"]) for row in first} == {"a", "b"}
    for row in first:
        near(row["time"], np.sqrt(2 * 0.5e-3 / 9.81), 1e-12, "onset")
        near(row["peak_force"], 1466.43645, 1e-4, "peak force")


def test_spatial_four_bar(gudgeon):
    """All joints ideal: heights of the rocker's centre of mass, by an independent integration."""
    text = deck("four_bar_spatial.deck").replace("   law\nball", "   law   level\nball").replace("steel      ln\n", "steel      ln    ideal\n")
    run = run_text(gudgeon, changed(text, "output", every="0.1 s"), end="0.5 s", tolerance="1e-11")
    z = channel(run, "rocker.position")[:, 2]
    near(z[at(run, 0.1)], 0.030525532, 2e-9, "0.1 s")
    near(z[at(run, 0.5)], 0.030147352, 2e-9, "0.5 s")


def first_impacts(run, n):
    """Onset, speed, greatest force of all contacts together, and duration of the first impacts."""
    rows = {}
    for row in run.contacts:
        key = round(row["time"], 9)
        before = rows.get(key, (0, 0, 0.0, 0))
        rows[key] = (row["time"], row["impact_speed"], before[2] + row["peak_force"], row["duration"])
    return np.array([rows[key] for key in sorted(rows)][:n])


def test_slider_crank_in_three_models(gudgeon):
    """Section 6.6: pin in the plane, ball in a socket, pin in a bushing agree on the first impacts."""
    of = {}
    for name in ("planar", "ball", "bushing"):
        run = run_text(gudgeon, deck(f"slider_crank_6_6_{name}.deck"), end="4 ms", tolerance="1e-11")
        of[name] = first_impacts(run, 5)
    near(of["planar"][0], (4.41191968e-4, 2.263897, 20924.979, 6.1918e-5), (1e-12, 1e-6, 1e-2, 1e-9), "first impact")
    for name in ("ball", "bushing"):
        near(of[name][:3] / of["planar"][:3], np.ones((3, 4)), 1e-6, name)
        near(of[name][:, 0], of["planar"][:, 0], 1e-9, f"{name}: onsets")


def test_plane_in_space(gudgeon):
    """The slider-crank of section 4.4, translated: pin in a bushing, onsets and forces of the first five impacts; the same bodies leave the unknowns."""
    text = plain_deck()
    settings = {"end": "2 ms", "tolerance": "1e-11"}
    planar, spatial = (first_impacts(run_text(gudgeon, t, **settings), 5) for t in (text, in_space(text)))
    near(spatial[:, 0], planar[:, 0], 1e-9, "onsets")
    near(spatial / planar, np.ones((5, 4)), 1e-6, "impacts")
    explained = call(gudgeon, "explain", written(scratch(), in_space(text))).stdout
    assert "'crank': prescribed motion" in explained
    assert "2 unknown coordinates, 0 constraint rows in the equations" in explained


def test_full_stiffness_at_each_base(gudgeon):
    """The book's stiffness: shorter and harder by the known factors."""
    half = first_impacts(run_text(gudgeon, deck("slider_crank_6_6_bushing.deck"), end="0.6 ms", tolerance="1e-10"), 1)[0]
    text = re.sub(r"(?m)^base( +)= half", r"base\1= full", deck("slider_crank_6_6_bushing.deck"))
    full = first_impacts(run_text(gudgeon, text, end="0.6 ms", tolerance="1e-10"), 1)[0]
    near(full[3] / half[3], 0.754, 1e-3, "duration")
    near(full[2] / half[2], 1.303, 1e-3, "force of both bases")


@pytest.mark.parametrize("name, limit", [("a04_bricard", 1e-6), ("door_on_three_hinges", 1e-6), ("gimbal", 1e-8)])
def test_energy(gudgeon, name, limit):
    """Redundant rows and gimbal positions leave the ledger closed."""
    run = run_text(gudgeon, deck(f"hard/{name}.deck"))
    assert max(abs(channel(run, "energy.residual"))) < limit * max(abs(channel(run, "energy.kinetic")))


def test_turned_scene(gudgeon):
    """The four-bar turned as a whole: the same impacts, and positions that are turned."""
    a = rotation(7)
    text = deck("four_bar_spatial.deck")
    text = text.replace("gravity  = 0 0 -9.81 m/s^2", f"gravity = {words(a @ [0, 0, -9.81])} m/s^2")

    def body(match):
        line = match.group(0)
        quoted = [np.array(list(map(float, q.split()))) for q in re.findall(r'"([^"]*)"', line)]
        cells = line.split('"')[0].split()
        r = np.array(list(map(float, cells[5:8])))
        return " ".join(cells[:5]) + " " + words(a @ r) + "".join(f' "{words(a @ q)}"' for q in quoted)

    text = re.sub(r"(?m)^(crank|coupler|rocker) +0\..*$", body, text)
    text = text.replace("d        ground    -0.04   -0.085    0", "d ground " + words(a @ [-0.04, -0.085, 0]))
    text = text.replace('"1 0 0"\nside', f'"{words(a @ [1, 0, 0])}"\nside').replace('side     d    d_4    "0 1 0"',
                                                                                f'side d d_4 "{words(a @ [0, 1, 0])}"')
    straight = run_text(gudgeon, changed(deck("four_bar_spatial.deck"), "output", every="5 ms"), end="60 ms", tolerance="1e-11")
    run = run_text(gudgeon, changed(text, "output", every="5 ms"), end="60 ms", tolerance="1e-11")
    n = 3
    assert len(straight.contacts) >= n
    for one, other in zip(straight.contacts[:n], run.contacts[:n]):
        near(other["time"], one["time"], 1e-9, "onset")
        near(other["peak_force"] / one["peak_force"], 1.0, 1e-6, "peak force")
    k = at(run, 0.03)
    near(channel(run, "rocker.position")[k], a @ channel(straight, "rocker.position")[at(straight, 0.03)], 1e-8, "position")


BAR = """deck = 1
[scene]
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name  mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] {columns}
bar   1        {moments} {cells}
[analysis.dynamic]
end = 1 ms
[output]
every = 1 ms
"""


@pytest.mark.parametrize("columns, moments, cells, expected", [
    ("x[m]", "1 1 3", "0", "exceeds the sum of the other two"),
    ("ixy[kg.m^2]", "1 1 1", "2", "not positive"),
    ("e0 e1 angle[deg] axis", "1 1 1", '0.5 0.5 30 "0 0 1"', "given twice"),
    ("angle[deg]", "1 1 1", "30", "no axis"),
    ("xi_axis", "1 1 1", '"1 0 0"', "both xi_axis and eta_axis"),
    ("xi_axis eta_axis", "1 1 1", '"1 0 0" "2 0 0"', "two parallel axes"),
    ("axis angle[deg]", "1 1 1", '"1 0" 30', "3 numbers"),
    ("axis angle[deg]", "1 1 1", '"0 0 0" 30', "zero vector as a direction"),
    ("sequence angle1[deg]", "1 1 1", "zzx 30", "zzx"),
])
def test_mistakes_of_bodies(gudgeon, columns, moments, cells, expected):
    """What no body can have is refused, with its place."""
    path = written(scratch(), BAR.format(columns=columns, moments=moments, cells=cells))
    done = call(gudgeon, "check", path, expect=(1, 2, 3))
    assert expected in done.stderr
    assert ":7:" in done.stderr


def test_sections_of_the_other_space(gudgeon):
    """A kind of the plane is refused in space by name, and the other way round; so is a vector of the other space."""
    text = BAR.format(columns="x[m]", moments="1 1 1", cells="0")
    done = call(gudgeon, "check", written(scratch(), text + "[joint.pin_in_slot]\nname i j axis\n"), expect=(1, 2, 3))
    assert "joint.pin_in_slot does not exist in space" in done.stderr
    done = call(gudgeon, "check", written(scratch(), text.replace("0 0 -9.81", "0 -9.81")), expect=(1, 2, 3))
    assert "gravity has two" in done.stderr
    planar = (ROOT / "inputs/four_bar.deck").read_text() + "\n[joint.spherical]\nname i j\n"
    done = call(gudgeon, "check", written(scratch(), planar), expect=(1, 2, 3))
    assert "joint.spherical does not exist in the plane" in done.stderr


def test_axes_opposed(gudgeon):
    """A joint that is closed the wrong way round is refused by name."""
    text = deck("slider_crank_6_6_ball.deck").replace('main      main    heel    "0 1 0"', 'main      main    heel    "0 1 0"   "0 -1 0"'
                                                      ).replace("name      i       j       axis_i", "name      i       j       axis_i   axis_j")
    done = call(gudgeon, "run", written(scratch(), text), "--out", scratch() / "out", expect=(4, 5, 6, 7))
    assert "'main' is assembled in the reversed configuration" in done.stderr


DRIVEN = """deck = 1
[scene]
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name   mass[kg]  ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]  x[mm]
crank  0.15      1e-3        1e-3        1e-3         76.2
rod    0.30      2e-4        2e-4        2e-4         304.8
slider 0.15      1e-4        1e-4        1e-4         457.2
[points]
name   body    xi[mm]
main   ground  0
heel   crank   -76.2
throw  crank   76.2
big    rod     -152.4
small  rod     152.4
pin    slider  0
[joint.revolute]
name  i     j     axis_i
main  main  heel  "0 1 0"
[joint.spherical]
name     i      j
big_end  throw  big
[joint.universal]
name     i      j    axis_i   axis_j
gudgeon  small  pin  "0 1 0"  "0 0 1"
[joint.translational]
name   i     j    axis_i
guide  main  pin  "1 0 0"
[driver.speed]
name   joint  speed[rad/s]
motor  main   150
[analysis.kinematic]
end = 2 turns of motor
[analysis.dynamic]
end = 2 turns of motor
tolerance = 1e-11
[output]
every = 1 ms
"""


def test_kinematic_analysis(gudgeon):
    """A driven mechanism without integration: the slider's closed form, and the motion and the moment of the dynamic analysis."""
    dynamic = run_text(gudgeon, DRIVEN.replace("[analysis.kinematic]\nend = 2 turns of motor\n", ""))
    kinematic = run_text(gudgeon, DRIVEN)
    t = kinematic.time
    x = 0.1524 * np.cos(150 * t) + np.sqrt(0.3048**2 - (0.1524 * np.sin(150 * t)) ** 2)
    near(channel(kinematic, "slider.position")[:, 0], x, 1e-12, "slider")
    near(channel(kinematic, "motor.coordinate"), 150 * t, 1e-9, "turns are counted")
    n = min(len(t), len(dynamic.time))
    near(channel(dynamic, "slider.position")[:n], channel(kinematic, "slider.position")[:n], 1e-9, "position")
    near(channel(dynamic, "slider.acceleration")[:n], channel(kinematic, "slider.acceleration")[:n], 1e-4, "acceleration")
    near(channel(dynamic, "motor.moment")[:n], channel(kinematic, "motor.moment")[:n], 1e-5, "moment")


def test_static_analysis(gudgeon):
    """A body hangs from a spring with its eye above its centre of mass, whatever its tensor: the stretch is closed form."""
    hanging = """deck = 1
[scene]
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name  mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] z[m] axis      angle[deg]
ball  2        0.1         0.2         0.3         -1   "1 2 3"   20
[points]
name  body    xi[m] eta[m] zeta[m]
roof  ground  0     0      0
eye   ball    0.03  0.04   0.12
[force.spring]
name   i     j    stiffness[N/m] damping[N.s/m] free_length[m]
cord   roof  eye  1000           1              0.5
[analysis.static]
[output]
every = 1 s
"""
    directory = scratch()
    call(gudgeon, "run", written(directory, hanging), "--out", directory / "out", "--quiet", "--write", "channels")
    run = Run(directory / "out")
    near(channel(run, "ball.position")[0], (0.0, 0.0, -(0.5 + 2 * 9.81 / 1000 + 0.13)), 1e-9, "hangs below its eye")


def test_groups_apart(gudgeon):
    """Bodies that nothing joins move the same, integrated apart or together."""
    text = """deck = 1
[scene]
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name  mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] ixy[kg.m^2] x[m] wx[rad/s] wy[rad/s] wz[rad/s] sequence angle1[deg] angle2[deg] angle3[deg]
a     1        1           2           2.5         0.3         0    0.1       5         0.1       zxz      10          20          30
b     1        1           2           2.5         0           3    0.1       5         0.1       none     -           -           -
c     1        0.1         0.1         0.1         0           6    0         0         0         xyz      10          20          30
[points]
name  body    xi[m] eta[m] zeta[m]
g     ground  6     0      1
p     c       0.1   0      0.2
q     c       0     0      0.3
[force.spring]
name  i  j  stiffness[N/m] damping[N.s/m] free_length[m]
s     g  p  100            1              0.5
[force.point]
name  point  fx[N]               fy[N] fz[N] frame
f     q      {1 N*sin(3 rad/s*t)} 0     2     body
[force.torque]
name  body  mx[N.m]  frame
t     a     0.5      body
[analysis.dynamic]
end = 1 s
tolerance = 1e-11
[output]
every = 0.1 s
"""
    apart = run_text(gudgeon, text)
    together = run_text(gudgeon, text, groups="together")
    for name in ("a", "b", "c"):
        for quantity in ("position", "spin", "orientation"):
            near(channel(apart, f"{name}.{quantity}"), channel(together, f"{name}.{quantity}"), 1e-8, f"{name}.{quantity}")


def test_torsion_spring_counts_turns(gudgeon):
    """A wheel on a weak torsional spring turns many times and back, as a harmonic oscillator, about any axis."""
    run = run_text(gudgeon, """deck = 1
[scene]
space = spatial
[bodies]
name  mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]
wheel 1        0.1         0.1         0.1
[points]
name  body
g     ground
p     wheel
[joint.revolute]
name  i  j  axis_i
pin   g  p  "1 1 0"
[force.torsion_spring]
name    i       j      axis_i   stiffness[N.m/rad]
spring  ground  wheel  "1 1 0"  0.1
[initial.speed]
name  joint  speed[rad/s]
go    pin    20
[analysis.dynamic]
end = 7 s
tolerance = 1e-10
[output]
every = 0.1 s
""")
    with_turns = run.item("forces/angle", "spring")
    near(with_turns, 20 * np.sin(run.time), 1e-7, "angle")
    assert max(with_turns) > 6 * np.pi


@pytest.mark.parametrize("columns, cells, start", [
    ("e0 e1 e2 e3", "-0.8 0.3 0.1 0.2", (-0.8, 0.3, 0.1, 0.2)),
    ("e0 e1", "0 -2", (0, -1, 0, 0)),
    ("axis angle[deg]", '"0 0 1" 200', (-np.cos(np.radians(100)), 0, 0, -np.sin(np.radians(100)))),
    ("sequence angle1[deg] angle2[deg] angle3[deg]", "zxz 180 90 180", (np.sqrt(0.5), -np.sqrt(0.5), 0, 0)),
    ("axis angle[deg]", '"0 1 -1" -180', (0, 0, np.sqrt(0.5), -np.sqrt(0.5))),
])
@pytest.mark.parametrize("product", [0.0, 0.03])
def test_sign_of_euler_parameters(gudgeon, columns, cells, start, product):
    """Euler parameters begin as the deck has them, else with the first of them positive, principal axes or not, and do not jump."""
    text = BAR.format(columns=f"ixy[kg.m^2] wx[rad/s] wz[rad/s] {columns}", moments="0.1 0.2 0.25", cells=f"{product} 9 4 {cells}")
    run = run_text(gudgeon, changed(text, "output", every="10 ms"), end="1 s")
    found = run.item("bodies/orientation", "bar")
    assert found[0] == pytest.approx(np.array(start)/np.linalg.norm(start), abs=1e-12)
    assert np.abs(np.diff(found, axis=0)).max() < 0.1
