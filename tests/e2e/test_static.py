"""Static equilibrium against closed forms: where it rests, what the joints bear, whether it is stable, and starts from it."""

import re

import numpy as np
import pytest
from scipy.optimize import brentq
from support import ROOT, Run, assert_close, call, changed, scratch, written

GRAVITY = 9.81

HEAD = "deck = 1\n[scene]\ngravity = 0 -9.81 m/s^2\n"
PENDULUM = (
    HEAD
    + """[parameters]
start = 80 deg                # from hanging
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]             y[m]              angle
rod   2.0       0.08             {0.5m*sin(start)}  {-0.5m*cos(start)}  {start - 90deg}
[points]
name  body    xi[m]  eta[m]
wall  ground   0      0
top   rod     -0.5    0
tip   rod      0.5    0
[joint.revolute]
name  i     j
pin   wall  top
MORE
[analysis.static]
"""
)


def run(gudgeon, text, *options, expect=0):
    """Run a deck given as text."""
    directory = scratch()
    done = call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", *options, expect=expect)
    return Run(directory / "out", done)


def angle_of(result, body):
    """Angle of a body, within half a turn."""
    angle = result.item("bodies/angle", body).ravel()
    return np.angle(np.exp(1j * angle))


@pytest.mark.parametrize("start", [80, 100, -170, 179.9])
def test_pendulum_hangs(gudgeon, start):
    """Whatever side it starts on, the pendulum settles below its pin, not above."""
    result = run(gudgeon, PENDULUM.replace("MORE", ""), "--set", f"start={start}deg")
    assert_close(result.item("bodies/position", "rod"), [[0.0, -0.5]], absolute=1e-14, what="centre of mass")
    assert_close(angle_of(result, "rod"), -np.pi / 2, absolute=1e-13, what="angle")
    assert_close(result.item("joints/force", "pin"), [[0.0, -2.0 * GRAVITY]], absolute=1e-12, what="force on the wall")
    assert result.read("time").tolist() == [0.0]
    assert result.summary["equilibrium"].startswith("stable")
    frequency = float(re.search(r"frequency ([0-9.]+) Hz", result.summary["equilibrium"])[1])
    exact = np.sqrt(2.0 * GRAVITY * 0.5 / (0.08 + 2.0 * 0.25)) / (2 * np.pi)
    assert_close(frequency, exact, relative=1e-5, what="natural frequency")
    assert result.summary["warnings"] == []


def test_pendulum_pushed(gudgeon):
    """A force at the tip: tan(angle from hanging) = F L / (m g L/2)."""
    text = PENDULUM.replace("MORE", "[force.point]\nname point fx\nhand tip {4N*cos(3s^-1*t)}")
    result = run(gudgeon, text)
    assert_close(angle_of(result, "rod"), np.arctan(4.0 / (2.0 * GRAVITY / 2)) - np.pi / 2, absolute=1e-13, what="angle")
    assert_close(result.item("joints/force", "pin"), [[4.0, -2.0 * GRAVITY]], absolute=1e-11, what="force on the wall")


def test_torque_that_does_not_come_from_a_potential_of_height(gudgeon):
    """A constant torque against gravity: sin(angle from hanging) = M / (m g L/2), on the stable side."""
    for start in (80, 170):
        text = PENDULUM.replace("MORE", "[force.torque]\nname body moment\nhand rod {5 N.m}")
        result = run(gudgeon, text, "--set", f"start={start}deg")
        expected = np.arcsin(5.0 / (2.0 * GRAVITY * 0.5)) - np.pi / 2
        assert_close(angle_of(result, "rod"), expected, absolute=1e-12, what="angle")


def test_unstable(gudgeon):
    """Upright exactly: found as it is, and called unstable, with the time in which a push grows e-fold."""
    result = run(gudgeon, PENDULUM.replace("MORE", ""), "--set", "start=180deg")
    assert_close(result.item("bodies/position", "rod"), [[0.0, 0.5]], absolute=1e-14, what="centre of mass")
    assert result.summary["equilibrium"].startswith("unstable in 1 of 1")
    growth = float(re.search(r"e-fold in ([0-9.]+) s", result.summary["equilibrium"])[1])
    assert_close(growth, np.sqrt((0.08 + 2.0 * 0.25) / (2.0 * GRAVITY * 0.5)), relative=1e-3, what="growth")
    (warning,) = result.summary["warnings"]
    assert "unstable" in warning
    assert "'rod'" in warning


def test_indifferent(gudgeon):
    """A balanced wheel stays where it is and is called indifferent, by its name; the pendulum beside it is not named."""
    text = PENDULUM.replace("MORE", "hub hub mid").replace("[points]\n", "wheel 1 0.1 3 0 0.3rad\n[points]\n")
    text = text.replace("tip   rod ", "hub ground 3 0\nmid wheel 0 0\ntip   rod ")
    result = run(gudgeon, text)
    assert result.summary["equilibrium"].startswith("neutrally stable in 1 of 2")
    (warning,) = result.summary["warnings"]
    assert re.findall(r"'(\w+)'", warning) == ["wheel"]
    assert_close(angle_of(result, "wheel"), 0.3, absolute=1e-12, what="angle of the wheel")
    assert_close(angle_of(result, "rod"), -np.pi / 2, absolute=1e-13, what="angle of the rod")


def test_toggle(gudgeon):
    """Two bars of weight W, one end pinned, the other on a guide and pulled by F: tan(slope) = W / (2 F)."""
    text = (
        HEAD
        + """[bodies]
name    mass[kg]  inertia[kg.m^2]  x[m]   y[m]   angle[deg]
left    3.0       0.1              0.35  -0.35  -45
right   3.0       0.1              1.05  -0.35   45
slider  0.5       0.1              1.4    0      0
[points]
name   body    xi[m]  eta[m]
wall   ground   0      0
l_a    left    -0.5    0
l_b    left     0.5    0
r_a    right   -0.5    0
r_b    right    0.5    0
pin    slider   0      0
[joint.revolute]
name  i     j
low   wall  l_a
knee  l_b   r_a
high  r_b   pin
[joint.translational]
name   i     j    axis
guide  wall  pin  x
[force.point]
name  point  fx
pull  pin    20N
[analysis.static]
"""
    )
    result = run(gudgeon, text)
    slope = np.arctan(3.0 * GRAVITY / (2 * 20.0))
    assert_close(angle_of(result, "left"), -slope, absolute=1e-12, what="slope of the left bar")
    assert_close(result.item("bodies/position", "slider"), [[2 * np.cos(slope), 0.0]], absolute=1e-12, what="slider")
    assert_close(result.item("joints/force", "knee"), [[20.0, 0.0]], absolute=1e-11, what="force in the knee")
    assert_close(result.item("joints/force", "low"), [[20.0, -3.0 * GRAVITY]], absolute=1e-11, what="force on the wall")
    assert result.summary["equilibrium"].startswith("stable")


def catenary(n, length, weight, span):
    """Slopes of n equal links between two pins at one height: tan of link k = (k - (n + 1)/2) w / H; H from the span."""
    rise = (np.arange(1, n + 1) - (n + 1) / 2) * weight
    horizontal = brentq(
        lambda h: (length * np.cos(np.arctan2(rise, h))).sum() - span, 1e-3, 1e3, xtol=1e-15, rtol=1e-15
    )
    return np.arctan2(rise, horizontal), horizontal


def test_hanging_chain(gudgeon):
    """Eight links from a zigzag: the discrete catenary, its forces, and that the motion begins from it at rest."""
    deck = ROOT / "inputs" / "hanging_chain.deck"
    text = changed(deck.read_text(), "output", figures=None, channels="*")
    result = run(gudgeon, text, "--analysis", "static")
    slopes, horizontal = catenary(8, 0.15, 0.1 * GRAVITY, 0.9)
    assert_close([angle_of(result, f"l{k}")[0] for k in range(1, 9)], slopes, absolute=1e-11, what="slopes")
    assert_close(result.item("joints/force", "p0"), [[horizontal, -0.4 * GRAVITY]], absolute=1e-10, what="left wall")
    assert_close(result.item("joints/force", "p4"), [[horizontal, 0.0]], absolute=1e-10, what="lowest pin")
    moving = run(gudgeon, changed(text, "analysis.dynamic", end="0.5 s", tolerance="1e-13"))
    assert_close(moving.read("bodies/position"), result.read("bodies/position"), absolute=1e-12, what="positions at rest")
    assert_close(moving.read("bodies/velocity"), 0.0, absolute=1e-11, what="velocities at rest")
    assert_close(moving.read("energy/kinetic"), 0.0, absolute=1e-20, what="kinetic energy")


def test_start_at_rest(gudgeon):
    """A pendulum started at its equilibrium under a side force stays there for a second; its deck angle is far off."""
    text = PENDULUM.replace("MORE", "[force.point]\nname point fx\nhand tip 4N")
    text = text.replace("[analysis.static]", "[analysis.dynamic]\nstart = static\nend = 1 s\ntolerance = 1e-10")
    result = run(gudgeon, text)
    for name in ("position", "angle"):
        values = result.read(f"bodies/{name}")
        assert_close(values, values[0], absolute=1e-12, what=name)
    for name in ("kinetic", "load_work", "residual"):
        assert_close(result.read(f"energy/{name}"), 0.0, absolute=1e-12, what=name)


@pytest.mark.parametrize("build", ["gudgeon", "gudgeon_debug"])
def test_loose_pin(build, request):
    """A pendulum on a loose pin rests with its journal below the centre, (m g / K)^(2/3) into the bearing; and stays so."""
    gudgeon = request.getfixturevalue(build)
    joint = """[material]
name   young[GPa]  poisson  density[kg/m^3]
steel  207         0.3      7850
[clearance.revolute]
name  bearing  journal  bearing_radius[mm]  clearance[mm]  material  level      law     friction
pin   wall     top      10                  0.1            steel     clearance  impact  none
[contact.hertz]
name    stiffness[N/m^1.5]
impact  2e9
"""
    text = PENDULUM.replace("[joint.revolute]\nname  i     j\npin   wall  top\nMORE\n", joint)
    result = run(gudgeon, text)
    depth = (2.0 * GRAVITY / 2e9) ** (2 / 3)
    assert_close(result.item("clearances/eccentricity", "pin"), [[0.0, -1e-4 - depth]], absolute=1e-13, what="journal")
    assert_close(result.read("clearances/contacts/penetration"), depth, absolute=1e-13, what="penetration")
    assert_close(result.item("clearances/force", "pin"), [[0.0, 2.0 * GRAVITY]], absolute=1e-7, what="force on the rod")
    assert_close(angle_of(result, "rod"), -np.pi / 2, absolute=1e-10, what="angle")
    assert result.summary["equilibrium"].startswith("stable")
    moving = run(
        gudgeon, text.replace("[analysis.static]", "[analysis.dynamic]\nstart = static\nend = 0.02 s\ntolerance = 1e-10")
    )
    assert_close(moving.read("bodies/position"), result.read("bodies/position"), absolute=1e-12, what="positions at rest")
    assert moving.summary["events"] == 0


def test_hung_on_springs(gudgeon):
    """A bar without joints on two springs: it settles level, each stretched by half the weight; the pull upward is stable."""
    text = (
        HEAD
        + """[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]   angle[deg]
bar   2.0       0.1              0.1  -0.15   20
[points]
name   body    xi[m]  eta[m]
left   ground  -0.5    0
right  ground   0.5    0
a      bar     -0.5    0
b      bar      0.5    0
[force.spring]
name  i      j   stiffness[N/m]  free_length[m]
one   left   a   500             0.2
two   right  b   500             0.2
[analysis.static]
"""
    )
    result = run(gudgeon, text)
    stretch = 2.0 * GRAVITY / 2 / 500
    assert_close(result.item("bodies/position", "bar"), [[0.0, -0.2 - stretch]], absolute=1e-12, what="where it hangs")
    assert_close(angle_of(result, "bar"), 0.0, absolute=1e-11, what="angle")
    assert result.summary["equilibrium"].startswith("stable")
    # the lowest is the swing to the side, a pendulum of the springs' length
    frequency = float(re.search(r"frequency ([0-9.]+) Hz", result.summary["equilibrium"])[1])
    assert_close(frequency, np.sqrt(GRAVITY / (0.2 + stretch)) / (2 * np.pi), relative=1e-5, what="natural frequency")
    assert_close(result.read("energy/elastic"), 500 * stretch**2, relative=1e-10, what="energy in the springs")


def test_redundant_joint(gudgeon):
    """A pin given twice: each bears half, and a warning names both."""
    result = run(gudgeon, PENDULUM.replace("MORE", "twin wall top"))
    for name in ("pin", "twin"):
        assert_close(result.item("joints/force", name), [[0.0, -GRAVITY]], absolute=1e-12, what=name)
    assert any("'pin' 'twin'" in warning for warning in result.summary["warnings"])


def test_driver_is_held(gudgeon):
    """A driver holds its joint where it is at t = 0; its moment is the one of statics."""
    text = PENDULUM.replace("MORE", "[driver.angle]\nname joint angle\nhold pin {-60deg + 1rad*sin(5s^-1*t)}")
    result = run(gudgeon, text)
    assert_close(angle_of(result, "rod"), -np.pi / 3, absolute=1e-13, what="angle")
    assert_close(result.item("drivers/moment", "hold"), 2.0 * GRAVITY * 0.5 * 0.5, absolute=1e-12, what="moment")
    assert result.summary["equilibrium"].startswith("stable: no body can move")


def test_figures_are_left_out(gudgeon):
    """One instant is no curve: figures become a warning."""
    text = PENDULUM.replace("MORE", "") + "[output]\nfigures = rod.angle\n"
    result = run(gudgeon, text)
    assert any("figures omitted" in warning for warning in result.summary["warnings"])
    assert not (result.directory / "figures").exists()


def test_one_instant_has_no_means(gudgeon):
    """Of an equilibrium summary and page tell values: nothing has a mean over no time, nor a part of it in contact."""
    result = run(gudgeon, PENDULUM.replace("MORE", "[output]\nchannels = rod.* pin.*\nreport = on\n"))
    text = (result.directory / "summary.txt").read_text()
    assert re.search(r"^values +value$", text, re.M) and "extremes " not in text
    assert re.search(r"pin\.force\.y \[N\] +-19\.62\n", text)
    for told in (text, (result.directory / "report.html").read_text()):
        assert not re.search(r"\bNaN\b", told) and "in contact" not in told


@pytest.mark.parametrize("build", ["release", "debug"])
def test_load_that_is_no_number(gudgeon, gudgeon_debug, build):
    """A load without a value at t = 0 has no equilibrium: the body is named at once, in both builds, without words of LAPACK."""
    text = (ROOT / "inputs/hanging_chain.deck").read_text().replace("(t - 0.5s)/1s", "(t - 0.5s)/0.0s")
    program = gudgeon if build == "release" else gudgeon_debug
    done = call(program, "check", written(scratch(), text), expect=4)
    assert "the load on 'l4' is not finite at t = 0" in done.stderr
    assert "DLASCL" not in done.stdout + done.stderr


def test_body_that_falls_beside_one_that_rests(gudgeon):
    """A ball that nothing holds has no equilibrium, though another one rests; how far it goes is no excuse for its weight."""
    text = (ROOT / "inputs/bouncing_ball.deck").read_text()
    text = text.replace("[analysis", "[analysis.static]\n\n[analysis", 1)
    rests = run(gudgeon, text, "--analysis", "static")
    assert "neutrally stable in 2 of 3 freedoms" in rests.summary["equilibrium"]
    falls = text.replace("\n[points]", "other    1          0.1               3      3.0      0            0\n\n[points]", 1)
    done = call(gudgeon, "run", written(scratch(), falls), "--analysis", "static", expect=4)
    assert "no static equilibrium was found" in done.stderr and "unbalanced loads act on 'other'" in done.stderr
