"""joint.coupler against closed forms: ratios of angles and displacements of two and three joints, by every way of holding the constraints."""

import json

import numpy as np
import pytest
from support import Run, assert_close, call, changed, run_with, scratch, written

WAYS = [{}, {"stabilise": "partitioning"}, {"stabilise": "baumgarte alpha=5s^-1 beta=5s^-1"}, {"stabilise": "projection"},
        {"coordinates": "full"}, {"method": "ida"}, {"method": "bdf"}, {"method": "radau"}, {"solver": "sparse"}, {"solver": "complete"},
        {"solver": "lapack"}, {"solver": "augmented_lagrangian"}]
LOOSE = {"ida", "bdf", "radau"}

HEAD = """deck = 1
[scene]
gravity = 0 -10 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] omega[rad/s]
a    1        0.02            0    {wa}
b    2        0.05            1    {wb}
d    3        0.03            2    {wd}
[points]
name body   xi[m]
o1   ground 0
o2   ground 1
o3   ground 2
pa   a      0
pb   b      0
pd   d      0
[joint.revolute]
name i j
ja o1 pa
jb o2 pb
{third}
[joint.coupler]
name joint_1 joint_2 joint_3 scale_1 scale_2 scale_3
{coupler}
[force.torque]
name body moment
t1 a 1.5N.m
t2 b -0.4N.m
t3 d 0.7N.m
[analysis.dynamic]
end = 2 s
start = given
tolerance = 1e-11
[output]
every = 20 ms
channels = *
"""
INERTIA = np.array([0.02, 0.05, 0.03])
TORQUE = np.array([1.5, -0.4, 0.7])


def scene(coupler, third="jd o3 pd", wa=0, wb=0, wd=0):
    return HEAD.format(coupler=coupler, third=third, wa=wa, wb=wb, wd=wd)


def allowed(settings):
    """Error that a method leaves: round-off of motions that are polynomials, or its tolerance."""
    return 1e-6 if settings.get("method") in LOOSE or "baumgarte" in settings.get("stabilise", "") else 1e-12


def powers(run, name, rates):
    """Sum of the powers of a coupler's moments and forces, and the largest of them."""
    parts = [run.item(f"joints/{kind}_{k}", name) * rate for k, rate in enumerate(rates, 1) for kind in ("moment", "force")]
    return sum(parts), max(abs(p).max() for p in parts)


@pytest.mark.parametrize("settings", WAYS, ids=str)
def test_two_revolutes(gudgeon, settings):
    """1 to -2.5 through many turns: both turn by the equation of the reduced inertia, and the moments are those of Newton's law."""
    run = run_with(gudgeon, scene("c ja jb - 1 -2.5 -", wa=5, wb=2), **settings)
    ratio = np.array([1, 0.4, 0])
    rate = (ratio @ TORQUE) / (ratio**2 @ INERTIA)
    t = run.time
    turned = 5 * t + rate * t**2 / 2
    assert turned[-1] > 8 * np.pi
    close = allowed(settings) * turned.max()
    assert_close(run.item("bodies/angle", "a"), turned, absolute=close, what="first")
    assert_close(run.item("bodies/angle", "b"), 0.4 * turned, absolute=close, what="second")
    moment = INERTIA[0] * rate - TORQUE[0]
    assert_close(run.item("joints/moment_1", "c"), moment + 0 * t, absolute=max(1e3 * allowed(settings), 1e-10), what="moment on the first")
    assert_close(run.item("joints/moment_2", "c"), -2.5 * moment + 0 * t, absolute=max(1e3 * allowed(settings), 1e-10), what="on the second")


@pytest.mark.parametrize("settings", WAYS, ids=str)
def test_differential(gudgeon, settings):
    """s_1 + s_2 = 2 s_3: accelerations and moments of the three shafts from the multiplier, and powers that sum to zero."""
    run = run_with(gudgeon, scene("c ja jb jd 1 1 -2", wa=4, wb=-1, wd=1.5), **settings)
    c = np.array([1, 1, -2])
    pull = (c @ (TORQUE / INERTIA)) / (c**2 @ (1 / INERTIA))
    rate = (TORQUE - c * pull) / INERTIA
    t = run.time
    spin = []
    for k, (name, first) in enumerate((("a", 4), ("b", -1), ("d", 1.5))):
        want = first * t + rate[k] * t**2 / 2
        assert_close(run.item("bodies/angle", name), want, absolute=allowed(settings) * 100, what=name)
        assert_close(run.item(f"joints/moment_{k + 1}", "c"), -c[k] * pull + 0 * t, absolute=max(1e3 * allowed(settings), 1e-10), what=f"moment {k}")
        spin.append(run.item("bodies/angular_velocity", name))
    total, largest = powers(run, "c", spin)
    assert_close(total, 0 * t, absolute=max(allowed(settings), 1e-12) * largest * 10, what="power")


@pytest.mark.parametrize("settings", WAYS, ids=str)
def test_turn_and_displacement(gudgeon, settings):
    """A body that sinks by its weight turns a shaft as a rope on a drum of 50 mm does."""
    text = scene("c ja jb - 50mm/rad 1 -").replace("jb o2 pb\n", "[joint.translational]\nname i j axis\njb o2 pb y\n[joint.revolute]\nname i j\n")
    text = text.replace("t2 b -0.4N.m\n", "")
    run = run_with(gudgeon, text, **settings)
    radius = 0.05
    rate = (1.5 + 2 * 10 * radius) / (0.02 + 2 * radius**2)
    t = run.time
    assert_close(run.item("bodies/angle", "a"), rate * t**2 / 2, absolute=allowed(settings) * rate, what="shaft")
    assert_close(run.item("bodies/position", "b")[:, 1], -radius * rate * t**2 / 2, absolute=allowed(settings) * rate, what="load")
    pull = 0.02 * rate - 1.5
    assert_close(run.item("joints/moment_1", "c"), pull + 0 * t, absolute=max(1e3 * allowed(settings), 1e-10), what="moment")
    assert_close(run.item("joints/force_2", "c"), pull / radius + 0 * t, absolute=max(1e4 * allowed(settings), 1e-9), what="force")
    assert not run.item("joints/force_1", "c").any() and not run.item("joints/moment_2", "c").any()


PLANETARY = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name    mass[kg] inertia[kg.m^2] x[m]
arm     1        0.01            0.05
sun     1        0.0005          0
planet  0.5      0.0002          0.1
[points]
name  body   xi[m]
o     ground 0
heel  arm    -0.05
tip   arm    0.05
s     sun    0
p     planet 0
[joint.revolute]
name i j
main o heel
jsun heel s
jpl  tip p
{tie}
[force.torque]
name body moment
m sun 0.3N.m
[analysis.dynamic]
end = 2 s
tolerance = 1e-11
start = given
[output]
every = 10 ms
channels = *
"""
TIES = {"gear": "[joint.gear]\nname i j radius_i[m] radius_j[m]\nc s p 0.06 0.04",
        "belt": "[joint.belt]\nname i j radius_i[m] radius_j[m] belt\nc s p 0.06 0.04 crossed",
        "coupler": "[joint.coupler]\nname joint_1 joint_2 scale_1 scale_2\nc jsun jpl 6 4"}


@pytest.mark.parametrize("settings", WAYS, ids=str)
def test_coupler_on_a_carrier_is_a_gear(gudgeon, settings):
    """Two wheels on an arm that swings by its weight move as with joint.gear and joint.belt: the row has three bodies there, theirs two."""
    runs = {name: run_with(gudgeon, PLANETARY.format(tie=tie), **settings) for name, tie in TIES.items()}
    close = 1e-4 if settings.get("method") in LOOSE or "baumgarte" in settings.get("stabilise", "") else 2e-8
    for body in ("arm", "sun", "planet"):
        angle = runs["gear"].item("bodies/angle", body)
        assert np.ptp(angle) > 2
        for name in ("belt", "coupler"):
            assert_close(runs[name].item("bodies/angle", body), angle, absolute=close * abs(angle).max(), what=f"{body}, {name}")
    run = runs["coupler"]
    spin = {body: run.item("bodies/angular_velocity", body) for body in ("arm", "sun", "planet")}
    total, largest = powers(run, "c", [spin["sun"] - spin["arm"], spin["planet"] - spin["arm"]])
    assert_close(total, 0 * total, absolute=max(close, 1e-9) * largest, what="power")
    energy = run.read("energy/residual")
    assert abs(energy).max() < (1e-3 if close > 1e-6 else 1e-7)


SPACE = """deck = 1
[scene]
space = spatial
gravity = {gravity} m/s^2
[bodies]
name  mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m] axis angle[deg] wx[rad/s] wy[rad/s] wz[rad/s]
shaft 1 0.02 0.02 0.02 {shaft} "{lean}" {by} {spin}
nut   2 0.05 0.05 0.05 {nut}   "{lean}" {by} 0 0 0
wheel 1 0.03 0.03 0.03 {wheel} "{lean}" {by} {turn}
[points]
name body xi[m] eta[m] zeta[m]
os ground {shaft}
on ground {nut}
ow ground {wheel}
s shaft 0 0 0
n nut 0 0 0
w wheel 0 0 0
[joint.revolute]
name i j axis_i axis_j
js os s "{z}" "0 0 1"
jw ow w "{z}" "0 0 1"
[joint.cylindrical]
name i j axis_i axis_j
jn on n "{z}" "0 0 1"
[joint.coupler]
name joint_1 joint_2 joint_3 scale_1 scale_2 scale_3 of_2
c js jn jw 30mm/rad -1 10mm/rad displacement
[force.torque]
name body frame mz
m shaft body 0.4N.m
[analysis.dynamic]
end = 3 s
start = given
tolerance = 1e-11
[output]
every = 20 ms
channels = *
"""


def space(lean, by, origin):
    """The same scene turned about an axis and moved: places, axis, gravity along it."""
    axis = np.array(lean, float) / np.linalg.norm(lean)
    cross = -np.cross(np.eye(3), axis).T
    turn = np.eye(3) + np.sin(np.radians(by)) * cross + (1 - np.cos(np.radians(by))) * cross @ cross
    text = lambda v: " ".join(f"{x:.17g}" for x in v)  # noqa: E731
    places = {name: text(turn @ np.array(at) + origin) for name, at in (("shaft", [0, 0, 0]), ("nut", [0.2, 0, 0]), ("wheel", [0, 0.3, 0]))}
    return SPACE.format(lean=text(axis), by=f"{by:.17g}", gravity=text(turn @ [0, 0, -10]), z=text(turn @ [0, 0, 1]),
                        spin=text(turn @ [0, 0, 6]), turn=text(turn @ [0, 0, -2]), **places), turn


@pytest.mark.parametrize("settings", WAYS, ids=str)
@pytest.mark.parametrize("place", [([0, 0, 1], 0, [0, 0, 0]), ([1, 2, -1], 77, [3, -5, 2])], ids=["upright", "tilted and shifted"])
def test_three_joints_in_space(gudgeon, place, settings):
    """30 mm s_shaft + 10 mm s_wheel = displacement of a nut that falls: closed form, turns counted, wherever the scene is."""
    text, turn = space(*place)
    text = text.replace("0 0 0\nwheel", "{v}\nwheel")
    speed = 0.03 * 6 - 0.01 * 2
    text = text.replace(" wz[rad/s]\n", " wz[rad/s] vx[m/s] vy[m/s] vz[m/s]\n").replace("{v}", "0 0 0 " + " ".join(f"{x:.17g}" for x in turn @ [0, 0, speed]))
    text = "\n".join(line + " 0 0 0" if line.startswith(("shaft 1", "wheel 1")) else line for line in text.splitlines()) + "\n"
    run = run_with(gudgeon, text, **settings)
    c, inertia, load = np.array([0.03, -1, 0.01]), np.array([0.02, 2, 0.03]), np.array([0.4, -20, 0])
    pull = (c @ (load / inertia)) / (c**2 @ (1 / inertia))
    rate = (load - c * pull) / inertia
    t = run.time
    close = 1e3 * allowed(settings)
    fall = (run.item("bodies/position", "nut") - run.item("bodies/position", "nut")[0]) @ (turn @ [0, 0, 1])
    assert_close(fall, speed * t + rate[1] * t**2 / 2, absolute=close, what="nut")
    for name, first, k in (("shaft", 6, 0), ("wheel", -2, 2)):
        spin = run.item("bodies/angular_velocity", name) @ (turn @ [0, 0, 1])
        assert_close(spin, first + rate[k] * t, absolute=close * 10, what=name)
        assert abs(first * t + rate[k] * t**2 / 2).max() > 2 * np.pi
    scale = abs(pull)
    assert_close(run.item("joints/moment_1", "c"), -c[0] * pull + 0 * t, absolute=1e2 * close * scale, what="on the shaft")
    assert_close(run.item("joints/force_2", "c"), -c[1] * pull + 0 * t, absolute=1e2 * close * scale, what="on the nut")
    assert_close(run.item("joints/moment_3", "c"), -c[2] * pull + 0 * t, absolute=1e2 * close * scale, what="on the wheel")


def test_offset_moves_the_bodies(gudgeon):
    """A given sum that the given positions do not have is met by the initial assembly, and kept."""
    text = changed(scene("c ja jb jd 1 1 -2").replace("scale_3\n", "scale_3 offset\n").replace("1 1 -2", "1 1 -2 30deg"), "analysis.dynamic", start=None)
    run = run_with(gudgeon, text)
    a, b, d = (run.item("bodies/angle", name) for name in "abd")
    assert_close(a + b - 2 * d, np.radians(30) + 0 * a, absolute=1e-10, what="sum")


def test_static_and_kinematic(gudgeon):
    """Springs on two coupled shafts balance where the work of a small turn is zero; a driven shaft turns the other by its ratio."""
    springs = "[force.torsion_spring]\nname i j stiffness[N.m/rad]\nk1 ground a 3\nk2 ground b 5\n"
    text = scene("c ja jb - 1 -2.5 -").replace("[force.torque]", springs + "[force.torque]")
    text = text[: text.index("[analysis.dynamic]")] + "[analysis.static]\n[output]\nchannels = *\n"
    directory = scratch()
    call(gudgeon, "run", written(directory, text.replace("t3 d 0.7N.m\n", "").replace("jd o3 pd\n", "[joint.rigid]\nname i j\nr o3 pd\n")),
         "--out", directory / "out", "--quiet", "--write", "channels")
    run = Run(directory / "out")
    angle = (1.5 - 0.4 * 0.4) / (3 + 5 * 0.4**2)
    assert_close(run.item("bodies/angle", "a"), angle, absolute=1e-9, what="first at rest")
    assert_close(run.item("bodies/angle", "b"), 0.4 * angle, absolute=1e-9, what="second at rest")
    assert_close(run.item("joints/moment_1", "c"), 3 * angle - 1.5, absolute=1e-8, what="moment at rest")
    driven = scene("c ja jb jd 1 1 -2").replace("[force.torque]", "[driver.angle]\nname joint angle\nd1 ja {3rad/s*t}\nd2 jb {1rad*sin(2rad/s*t)}\n[force.torque]")
    driven = driven[: driven.index("[analysis.dynamic]")] + "[analysis.kinematic]\nend = 5 s\n[output]\nevery = 50 ms\nchannels = *\n"
    directory = scratch()
    call(gudgeon, "run", written(directory, driven), "--out", directory / "out", "--quiet", "--write", "channels")
    run = Run(directory / "out")
    t = run.time
    assert_close(run.item("bodies/angle", "d"), (3 * t + np.sin(2 * t)) / 2, absolute=1e-10, what="driven")


def test_driven_shafts_carry_the_coupler(gudgeon):
    """Drivers of prescribed bodies feel the coupler: moments and powers by the law of the third shaft."""
    text = scene("c ja jb jd 1 1 -2").replace("[force.torque]", "[driver.angle]\nname joint angle\nd1 ja {3rad/s*t}\nd2 jb {1rad*sin(2rad/s*t)}\n[force.torque]")
    run = run_with(gudgeon, changed(text, "analysis.dynamic", start=None))
    t = run.time
    rate = -4 * np.sin(2 * t) / 2
    pull = (0.03 * rate - 0.7) / 2  # I_d a_d = T_d + 2 lambda
    assert_close(run.item("joints/moment_3", "c"), 2 * pull, absolute=1e-8, what="third")
    assert_close(run.item("joints/moment_1", "c"), -pull, absolute=1e-8, what="first")
    assert_close(run.item("drivers/moment", "d1"), -1.5 + pull, absolute=1e-8, what="driver of the first")
    assert_close(run.item("drivers/moment", "d2"), 0.05 * -4 * np.sin(2 * t) + 0.4 + pull, absolute=1e-8, what="driver of the second")
    assert abs(run.read("energy/residual")).max() < 1e-8


def test_sensitivity(gudgeon):
    """Derivative of the angle by a scale, in closed form: the ratio enters the reduced inertia and moment."""
    text = scene("c ja jb - 1 {-ratio} -").replace("[bodies]", "[parameters]\nratio = 2.5\n[bodies]", 1)
    text = text.replace("channels = *", "channels = a.angle b.angle") + "[sensitivity]\nparameters = ratio\nresults = at(a.angle,2s)\n"
    directory = scratch()
    done = call(gudgeon, "sensitivity", written(directory, text), "--out", directory / "out", "--quiet", expect=None)
    if done.returncode:
        raise AssertionError(done.stderr)
    found = json.loads((directory / "out/summary.json").read_text())
    n = 2.5
    upper, lower = 1.5 - 0.4 / n, 0.02 + 0.05 / n**2
    want = 2 * (0.4 / n**2 / lower + upper * 0.1 / n**3 / lower**2)
    assert abs(want) > 1 and json.dumps(found)
    values = [row for row in json.dumps(found).replace("[", " ").replace("]", " ").replace(",", " ").replace("}", " ").split() if _is_near(row, want)]
    assert values, (want, found)


def _is_near(word, want):
    try:
        return abs(float(word) - want) < 1e-6 * abs(want)
    except ValueError:
        return False


MISTAKES = [
    ("c ja jb - 1 0 -", "has a factor of zero"),
    ("c ja jb - 1 2mm -", "adds unlike terms"),
    ("c ja ja - 1 2 -", "names one coordinate twice"),
    ("c ja jb - 1 2 3", "has a third scale without a joint"),
    ("c ja jb jd 1 2 -", "has a factor of zero"),
]


@pytest.mark.parametrize("row, words", MISTAKES)
def test_mistakes(gudgeon, row, words):
    directory = scratch()
    done = call(gudgeon, "run", written(directory, scene(row)), "--out", directory / "out", expect=3)
    assert words in done.stderr and "scene.deck:" in done.stderr and "^" in done.stderr


def test_redundant_and_contradictory(gudgeon):
    """The same coupler twice is redundant and runs; two sums that differ cannot be assembled."""
    twice = scene("c ja jb jd 1 1 -2\ne ja jb jd 2 2 -4", wa=2, wb=0, wd=1)
    directory = scratch()
    done = call(gudgeon, "run", written(directory, twice), "--out", directory / "out", "--write", "channels")
    assert "redundant" in done.stdout + done.stderr
    run = Run(directory / "out")
    once = run_with(gudgeon, scene("c ja jb jd 1 1 -2", wa=2, wb=0, wd=1))
    assert_close(run.item("bodies/angle", "d"), once.item("bodies/angle", "d"), absolute=1e-6, what="third shaft")
    other = changed(twice.replace("scale_3\n", "scale_3 offset\n").replace("1 1 -2", "1 1 -2 0deg").replace("2 2 -4", "2 2 -4 40deg"),
                    "analysis.dynamic", start=None)
    directory = scratch()
    done = call(gudgeon, "run", written(directory, other), "--out", directory / "out", expect=4)
    assert "'c'" in done.stderr or "'e'" in done.stderr


SCREW = """deck = 1
[scene]
space = spatial
gravity = 1 2 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]
arm   2 0.02 0.03 0.04
block 1 0.01 0.01 0.02
[points]
name body xi[m] eta[m] zeta[m]
floor ground 0 0 0
heel arm 0 0 0
far arm 0.1 0.2 0
seat block 0.1 0.2 0
[joint.revolute]
name i j axis_i axis_j
pin floor heel "0 1 0" "0 1 0"
{joint}
[force.torque]
name body frame mx[N.m] my[N.m] mz[N.m]
turn block body 0.3 0.3 0.9
[analysis.dynamic]
end = 2 s
tolerance = 1e-11
start = given
[output]
every = 10 ms
channels = *
"""


@pytest.mark.parametrize("settings", [{}, {"method": "ida"}, {"solver": "sparse"}, {"coordinates": "full"}], ids=str)
def test_cylindrical_joint_as_a_screw(gudgeon, settings):
    """The angle and the displacement of one cylindrical joint on an arm that oscillates: the motion of joint.screw, over many turns."""
    ties = {"screw": "[joint.screw]\nname i j axis_i pitch[mm]\nthread far seat \"1 1 3\" 20",
            "coupler": "[joint.cylindrical]\nname i j axis_i\nthread far seat \"1 1 3\"\n[joint.coupler]\nname joint_1 joint_2 scale_1 scale_2 of_2\n"
                       "c thread thread {20/(2*pi)*1mm/rad} -1 displacement"}
    runs = {name: run_with(gudgeon, SCREW.format(joint=tie), **settings) for name, tie in ties.items()}
    close = 1e-4 if settings.get("method") in LOOSE else 1e-7
    turned = runs["screw"].item("joints/displacement", "thread")
    assert np.ptp(turned) > 0.06  # three turns
    for path, name in (("joints/displacement", "thread"), ("bodies/position", "block"), ("bodies/position", "arm")):
        assert_close(runs["coupler"].item(path, name), runs["screw"].item(path, name), absolute=close, what=name)


def test_initial_speed(gudgeon):
    """One shaft's initial speed and another's sum to that of the third."""
    text = scene("c ja jb jd 1 1 -2").replace("[force.torque]", "[initial.speed]\nname joint speed\nsa ja 3rad/s\nsb jb -1rad/s\n[force.torque]")
    run = run_with(gudgeon, changed(text, "analysis.dynamic", start=None))
    first = [run.item("bodies/angular_velocity", name)[0] for name in "abd"]
    assert_close(first, [3, -1, 1], absolute=1e-12, what="speeds at the start")


def test_restart_counts_turns(gudgeon):
    """Runs that continue from checkpoints after several turns in space are, to the bit, the run in one."""
    text = changed(space([1, 2, -1], 77, [3, -5, 2])[0], "analysis.dynamic", start=None)
    directory = scratch()
    done = call(gudgeon, "run", written(directory, text), "--verify-restart", "--out", directory / "out", "--write", "channels")
    assert "equal bit for bit" in done.stdout
    assert abs(Run(directory / "out").item("bodies/angular_velocity", "shaft")).max() * 1.5 > 2 * np.pi
