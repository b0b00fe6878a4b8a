"""Kinematic analysis against closed forms: motion, driving and reaction forces, redundancy, dead centres."""

import re

import h5py
import numpy as np
import pytest
from reference_values import CRANK_LENGTH, CRANK_SPEED, IDEAL, IDEAL_FIELDS, IDEAL_PEAKS, IDEAL_PERIOD, ROD_LENGTH
from support import Run, assert_close, call, changed, plain_deck, scratch, written

REFERENCE = {field: np.array(column) for field, column in zip(IDEAL_FIELDS, zip(*IDEAL))}
PART = 1e-12  # of each channel's peak

# The four-bar of the book's section 2.8: lengths [m], masses [kg], inertias [kg.m^2]; crank turned at a constant speed.
GROUND, CRANK, LINK = 0.25, 0.20, 0.40
MASS = {"crank": 1.00, "coupler": 2.25, "rocker": 2.00}
INERTIA = {"crank": 0.30, "coupler": 2.00, "rocker": 1.35}
SPEED = 20 * np.pi
GRAVITY = 9.81

FOUR_BAR = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name      mass[kg]  inertia[kg.m^2]  x[m]    y[m]          angle[deg]
crank     1.00      0.30             0.1     0             0
coupler   2.25      2.00             0.2125  0.1996089928  86.41667830152
rocker    2.00      1.35             0.2375  0.1996089928  93.58332169848
[points]
name    body      xi[m]  eta[m]
wall_a  ground     0      0
wall_d  ground     0.25   0
heel    crank     -0.1    0
throw   crank      0.1    0
big     coupler   -0.2    0
small   coupler    0.2    0
foot    rocker    -0.2    0
head    rocker     0.2    0
[joint.revolute]
name  i       j
a     wall_a  heel
b     throw   big
c     small   head
d     wall_d  foot
MORE
DRIVER
[analysis.kinematic]
end = END
[output]
every = EVERY
"""
CRANK_MOTOR = f"[driver.speed]\nname joint speed[rad/s]\nmotor a {SPEED!r}\n"


def four_bar(driver=CRANK_MOTOR, end="200 ms", every="1 ms", more=""):
    """The four-bar's deck."""
    return FOUR_BAR.replace("MORE", more).replace("DRIVER", driver).replace("END", end).replace("EVERY", every)


def run(gudgeon, text, *options, expect=0):
    """Run a deck given as text."""
    directory = scratch()
    done = call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", *options, expect=expect)
    return Run(directory / "out", done)


def kinematic(text):
    """The slider-crank's deck with its dynamic section turned into a kinematic one."""
    for key in ("start", "method", "tolerance", "stabilise", "ledger"):
        text = changed(text, "analysis.dynamic", **{key: None})
    return text.replace("[analysis.dynamic]", "[analysis.kinematic]")


@pytest.fixture(scope="module")
def slider_crank():
    """The book's slider-crank; its loose joint is taken as ideal."""
    return kinematic(changed(plain_deck(), "output", channels="*"))


def test_slider_crank(gudgeon, slider_crank):
    """Positions, velocities, accelerations, driving moment and gudgeon reaction against the table of closed forms."""
    ideal = run(gudgeon, slider_crank)
    for turn in (0, 1):
        rows = np.rint((REFERENCE["time"] + turn * IDEAL_PERIOD) / 1e-5).astype(int)
        for quantity in ("position", "velocity", "acceleration"):
            motion = ideal.item(f"bodies/{quantity}", "slider")[rows]
            assert_close(motion[:, 0], REFERENCE[quantity], absolute=PART * IDEAL_PEAKS[quantity], what=quantity)
            assert_close(motion[:, 1], 0.0, absolute=PART * IDEAL_PEAKS[quantity], what=f"{quantity} across")
        moment = ideal.item("drivers/moment", "motor")[rows]
        assert_close(moment, REFERENCE["moment"], absolute=PART * IDEAL_PEAKS["moment"], what="moment")
        force = ideal.item("clearances/force", "gudgeon")[rows]
        for k, axis in enumerate("xy"):
            expected = REFERENCE[f"force_{axis}"]
            assert_close(force[:, k], expected, absolute=PART * IDEAL_PEAKS["force"], what=f"force {axis}")
    assert ideal.summary["samples"] == 2401
    assert ideal.summary["violation_max"] < 1e-15
    assert any("treats joints with clearance as ideal" in warning for warning in ideal.summary["warnings"])


def test_every_instant(gudgeon, slider_crank):
    """Two turns, every instant: x = l2 cos phi + sqrt(l3^2 - l2^2 sin^2 phi) and its derivatives."""
    ideal = run(gudgeon, slider_crank)
    phi = CRANK_SPEED * ideal.time
    sine, cosine = CRANK_LENGTH * np.sin(phi), CRANK_LENGTH * np.cos(phi)
    root = np.sqrt(ROD_LENGTH**2 - sine**2)
    root_1 = -sine * cosine / root
    root_2 = (sine**2 - cosine**2 - root_1**2) / root
    exact = {
        "position": cosine + root,
        "velocity": CRANK_SPEED * (root_1 - sine),
        "acceleration": CRANK_SPEED**2 * (root_2 - cosine),
    }
    for quantity, expected in exact.items():
        actual = ideal.item(f"bodies/{quantity}", "slider")[:, 0]
        assert_close(actual, expected, absolute=PART * IDEAL_PEAKS[quantity], what=quantity)


def test_same_channels_as_a_dynamic_run(gudgeon, slider_crank):
    """Every channel of the ideal motion but the integrated works, with the values of a dynamic run."""
    still = run(gudgeon, slider_crank)
    moving = run(gudgeon, changed(plain_deck(), "output", channels="*"), "--ideal", "--tolerance", "1e-12")

    def numbers(directory):
        found = {}
        with h5py.File(directory / "run.h5", "r") as file:
            file.visititems(
                lambda name, node: found.update({name: node[()]})
                if isinstance(node, h5py.Dataset) and node.dtype.kind == "f" and len(node.shape) > 1
                else None
            )
        return found

    ours, theirs = numbers(still.directory), numbers(moving.directory)
    works = ("work", "dissipated", "residual")
    assert set(ours) == {name for name in theirs if not any(word in name for word in works)}
    for name, values in ours.items():
        if "violation" in name or "eccentricity" in name:
            assert np.abs(values).max() < 1e-9, name
            continue
        assert_close(values, theirs[name], absolute=1e-8 * np.abs(theirs[name]).max() + 1e-11, what=name)


def vector_loop(time, speed=SPEED):
    """Angles of coupler and rocker, their rates and accelerations, from crank + coupler = ground + rocker."""
    crank = np.exp(1j * speed * time)
    diagonal = GROUND - CRANK * crank  # from the throw to wall_d
    half = np.arccos(np.abs(diagonal) / (2 * LINK))  # isosceles: coupler and rocker have one length
    coupler = np.exp(1j * (np.angle(diagonal) + half))
    rocker = -np.exp(1j * (np.angle(diagonal) - half))
    out = {"coupler": [np.angle(coupler)], "rocker": [np.unwrap(np.angle(rocker))]}
    # LINK (coupler w3 - rocker w4) = -CRANK crank w2; the same for accelerations
    matrix = np.stack([np.stack([coupler.real, -rocker.real], -1), np.stack([coupler.imag, -rocker.imag], -1)], -2)
    right = -CRANK * crank * speed / LINK
    rates = np.linalg.solve(matrix, np.stack([right.real, right.imag], -1)[..., None])[..., 0]
    right = (-CRANK * crank * 1j * speed**2 - LINK * 1j * (coupler * rates[:, 0] ** 2 - rocker * rates[:, 1] ** 2)) / LINK
    accelerations = np.linalg.solve(matrix, np.stack([right.real, right.imag], -1)[..., None])[..., 0]
    for k, name in enumerate(("coupler", "rocker")):
        out[name] += [rates[:, k], accelerations[:, k]]
    centres = {
        "crank": (CRANK / 2 * crank, [(CRANK / 2 * crank, speed, 0.0)]),
        "coupler": (None, [(CRANK * crank, speed, 0.0), (LINK / 2 * coupler, rates[:, 0], accelerations[:, 0])]),
        "rocker": (None, [(LINK / 2 * rocker, rates[:, 1], accelerations[:, 1])]),
    }
    for name, (_, arms) in centres.items():
        out[f"{name}.velocity"] = sum(1j * w * arm for arm, w, _ in arms)
        out[f"{name}.acceleration"] = sum((1j * alpha - w**2) * arm for arm, w, alpha in arms)
    return out


def test_four_bar(gudgeon):
    """Angles, rates, accelerations; the motor's moment by the balance of power; the rocker's pins by Newton's laws."""
    result = run(gudgeon, four_bar())
    exact = vector_loop(result.time)
    for name in ("coupler", "rocker"):
        for quantity, expected in zip(("angle", "angular_velocity", "angular_acceleration"), exact[name]):
            actual = result.item(f"bodies/{quantity}", name).ravel()
            if quantity == "angle":
                actual = actual + expected[0] - actual[0] + np.angle(np.exp(1j * (actual[0] - expected[0])))
            assert_close(actual, expected, absolute=1e-11 * np.abs(expected).max(), what=f"{quantity} of {name}")
    power = 0.0
    for name in MASS:
        v, a = exact[f"{name}.velocity"], exact[f"{name}.acceleration"]
        power = power + MASS[name] * ((v.conjugate() * a).real + GRAVITY * v.imag)
        if name != "crank":
            power = power + INERTIA[name] * exact[name][1] * exact[name][2]
    moment = result.item("drivers/moment", "motor").ravel()
    assert_close(moment, power / SPEED, absolute=1e-10 * np.abs(moment).max(), what="moment of the motor")
    # rocker: force of pin c (on i, the coupler; so its negative) and of pin d (on the ground) and weight give m a
    c, d = result.item("joints/force", "c"), result.item("joints/force", "d")
    total = -(c[:, 0] + 1j * c[:, 1]) - (d[:, 0] + 1j * d[:, 1]) - 1j * MASS["rocker"] * GRAVITY
    expected = MASS["rocker"] * exact["rocker.acceleration"]
    assert_close(total.real, expected.real, absolute=1e-10 * np.abs(c).max(), what="forces on the rocker, x")
    assert_close(total.imag, expected.imag, absolute=1e-10 * np.abs(c).max(), what="forces on the rocker, y")
    kinetic = 0.5 * INERTIA["crank"] * SPEED**2
    for name in MASS:
        kinetic = kinetic + 0.5 * MASS[name] * np.abs(exact[f"{name}.velocity"]) ** 2
        if name != "crank":
            kinetic = kinetic + 0.5 * INERTIA[name] * exact[name][1] ** 2
    assert_close(result.read("energy/kinetic").ravel(), kinetic, relative=1e-11, what="kinetic energy")


@pytest.mark.parametrize("every", ["25 ms", "70 ms"])
def test_coarse_output_stays_on_the_branch(gudgeon, every):
    """A quarter turn and more between instants: the steps between keep the branch and the count of turns."""
    coarse = run(gudgeon, four_bar(end="700 ms", every=every))
    exact = vector_loop(np.linspace(0.0, 0.7, 7001))
    rows = np.rint(coarse.time * 1e4).astype(int)
    angle = coarse.item("bodies/angle", "rocker").ravel()
    assert_close(angle, exact["rocker"][0][rows], absolute=1e-9, what="angle of the rocker")
    assert_close(coarse.item("bodies/angle", "crank").ravel(), SPEED * coarse.time, absolute=1e-11, what="turns of the crank")
    assert coarse.summary["steps"] > 50 * (len(coarse.time) - 1) / 20


def test_redundant_joint(gudgeon):
    """A joint given twice: same motion, each takes half of the reaction, and a warning says so."""
    one = run(gudgeon, four_bar())
    two = run(gudgeon, four_bar(more="twin  wall_a  heel\n"))
    for quantity in ("position", "velocity", "acceleration", "angle"):
        expected = one.read(f"bodies/{quantity}")
        assert_close(two.read(f"bodies/{quantity}"), expected, absolute=1e-11 * np.abs(expected).max(), what=quantity)
    single = one.item("joints/force", "a")
    for name in ("a", "twin"):
        assert_close(two.item("joints/force", name), 0.5 * single, absolute=1e-10 * np.abs(single).max(), what=name)
    (warning,) = two.summary["warnings"]
    assert "not unique" in warning
    assert re.findall(r"'(\w+)'", warning) == ["a", "twin"]
    assert one.summary["warnings"] == []


def test_overdetermined_parallelogram(gudgeon):
    """A platform on three equal parallel cranks: one row too many; the platform moves on a circle without turning."""
    cranks = range(3)
    text = "deck = 1\n[scene]\ngravity = 0 -9.81 m/s^2\n[bodies]\nname mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]\n"
    text += "platform 4 1 1.1 0.1732050807568877 0\n"
    text += "".join(f"c{k} 1 0.01 {k + 0.05} 0.08660254037844387 60\n" for k in cranks)
    text += "[points]\nname body xi[m] eta[m]\n"
    text += "".join(f"w{k} ground {k} 0\nh{k} c{k} -0.1 0\nt{k} c{k} 0.1 0\np{k} platform {k - 1} 0\n" for k in cranks)
    text += "[joint.revolute]\nname i j\n" + "".join(f"low{k} w{k} h{k}\nhigh{k} t{k} p{k}\n" for k in cranks)
    text += "[driver.speed]\nname joint speed[rad/s]\nmotor low0 2\n[analysis.kinematic]\nend = 0.9 s\n[output]\nevery = 10 ms\n"
    result = run(gudgeon, text)
    arm = 0.2 * np.exp(1j * (np.pi / 3 + 2 * result.time))
    position = result.item("bodies/position", "platform")
    assert_close(position[:, 0], 1 + arm.real, absolute=1e-13, what="x of the platform")
    assert_close(position[:, 1], arm.imag, absolute=1e-13, what="y of the platform")
    assert_close(result.item("bodies/angle", "platform"), 0.0, absolute=1e-13, what="angle of the platform")
    acceleration = result.item("bodies/acceleration", "platform")
    assert_close(acceleration[:, 0], -4 * arm.real, absolute=1e-11, what="acceleration")
    # the motor lifts the platform and three cranks; inertia does no work on circles at constant speed
    weights = (4 * arm.real + 3 * 0.5 * arm.real) * GRAVITY
    assert_close(result.item("drivers/moment", "motor").ravel(), weights, absolute=1e-11, what="moment")
    total = sum(result.item("joints/force", f"high{k}") for k in cranks)  # on the cranks
    assert_close(total[:, 1], -4 * GRAVITY - 4 * acceleration[:, 1], absolute=1e-11, what="force of the platform")
    assert "not unique" in result.summary["warnings"][0]


@pytest.mark.parametrize("speed, limit", [(1.0, 0.9125), (-1.0, -0.6875)])
def test_dead_point(gudgeon, speed, limit):
    """A driven rocker ends where crank and coupler are in line: exit 5 with the time, the driver, and all before it saved."""
    driver = f"[driver.speed]\nname joint speed[rad/s]\nmotor d {speed}\n"
    result = run(gudgeon, four_bar(driver, end="3 s", every="10 ms"), expect=5)
    start = np.radians(93.58332169848)
    # cosine rule in the triangle wall_a, wall_d, c; crank and coupler together are 0.6 m or 0.2 m long
    expected = abs(np.pi - np.arccos(limit) - start)
    message = result.done.stderr
    found = re.search(r"cannot follow driver 'motor' beyond t = ([0-9.]+) s", message)
    assert found, message
    assert_close(float(found[1]), expected, absolute=2e-8, what="time of the dead centre")
    assert "a dead centre" in message
    assert "results up to the last output time are saved" in message
    assert_close(result.time[-1], np.floor(expected * 100) / 100, absolute=1e-12, what="last instant saved")
    angle = result.item("bodies/angle", "rocker").ravel()
    assert_close(angle - angle[0], speed * result.time, absolute=1e-12, what="angle of the rocker")
    assert result.summary["status"] == "failed"


def test_slider_driven_beyond_its_reach(gudgeon, slider_crank):
    """The slider driven outward from midway: crank and rod in line, 170 mm, is as far as it gets."""
    text = changed(slider_crank, "output", every="1 ms")
    motor = next(line for line in text.splitlines() if line.startswith("motor "))
    text = text.replace(motor + "\n", "").replace("[driver.speed]", "[driver.position]")
    text = text.replace("name     joint    speed\n", "name i j axis position\nram main pin x {150mm + 100mm/1s*t}\n")
    text = changed(text, "analysis.kinematic", end="1 s").replace("motor.moment", "ram.*")
    result = run(gudgeon, text.replace("crank    0.30       1.0e-4            25      0       0", MIDWAY), expect=5)
    found = re.search(r"cannot follow driver 'ram' beyond t = ([0-9.]+) s", result.done.stderr)
    assert found, result.done.stderr
    assert_close(float(found[1]), 0.2, absolute=1e-8, what="time")
    slider = result.item("bodies/position", "slider")[:, 0]
    assert_close(slider, 0.15 + 0.1 * result.time, absolute=1e-13, what="slider")
    angle = result.item("bodies/angle", "crank").ravel()
    exact = np.arccos((CRANK_LENGTH**2 + slider**2 - ROD_LENGTH**2) / (2 * CRANK_LENGTH * slider))
    assert_close(angle, exact, absolute=1e-10, what="angle of the crank")


MIDWAY = "crank    0.30       1.0e-4            15      20       53"
CHANGE_POINT = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]
left 1 0.01 0 0.1 90
bar 1 0.01 0.5 0.2 0
right 1 0.01 1 0.1 90
[points]
name body xi[m] eta[m]
w0 ground 0 0
w1 ground 1 0
a0 left -0.1 0
a1 left 0.1 0
b0 bar -0.5 0
b1 bar 0.5 0
c0 right -0.1 0
c1 right 0.1 0
[joint.revolute]
name i j
p w0 a0
q a1 b0
r b1 c1
s w1 c0
[driver.speed]
name joint speed
motor p 60rpm
[analysis.kinematic]
end = 2 s
[output]
every = EVERY
"""


def test_change_point_is_passed(gudgeon):
    """A parallelogram in line at every half turn, between output instants: it goes on as a parallelogram."""
    result = run(gudgeon, CHANGE_POINT.replace("EVERY", "7.3 ms"))
    assert_close(result.item("bodies/angle", "bar"), 0.0, absolute=1e-11, what="angle of the bar")
    phi = np.pi / 2 + 2 * np.pi * result.time
    assert_close(result.item("bodies/angle", "right").ravel(), phi, absolute=1e-11, what="angle of the other crank")
    assert_close(result.item("bodies/angular_velocity", "right").ravel(), 2 * np.pi, absolute=1e-9, what="its speed")


def test_change_point_at_an_instant(gudgeon):
    """The same at an output instant: where branches meet nothing tells the rates, and the run ends there."""
    result = run(gudgeon, CHANGE_POINT.replace("EVERY", "10 ms"), expect=5)
    found = re.search(r"cannot follow driver 'motor' beyond t = ([0-9.]+) s", result.done.stderr)
    assert_close(float(found[1]), 0.25, absolute=3e-6, what="time")
    assert "a bifurcation of the motion" in result.done.stderr
    assert "output times away from" in result.done.stderr
    assert_close(result.item("bodies/angular_velocity", "right").ravel(), 2 * np.pi, absolute=1e-9, what="speed until then")
    assert len(result.time) == 25


def test_jump_of_a_driver(gudgeon):
    """A driver that jumps cannot be followed across the jump."""
    driver = "[driver.angle]\nname joint angle\nmotor a {2rad*t/1s + 0.5rad*step(t - 0.105s)}\n"
    result = run(gudgeon, four_bar(driver), expect=5)
    assert "beyond t = 0.105" in result.done.stderr
    assert "has a position residual of" in result.done.stderr
    assert_close(result.time[-1], 0.105, absolute=1.001e-3, what="last instant saved")


def test_what_it_does_not_know_is_told(gudgeon):
    """Guards, statistics and ensembles are of motions in time: a warning says that they are left out; --member is refused."""
    directory = scratch()
    text = four_bar() + "[guards]\nstop = crank.angle > 1 rad\n[statistics]\nchannels = crank.angle\n"
    deck = written(directory, text)
    done = call(gudgeon, "run", deck, "--out", directory / "out", "--write", "channels")
    told = Run(directory / "out", done).summary["warnings"]
    assert [words for words in told if "[guards] not used" in words] and [words for words in told if "[statistics] not used" in words]
    assert "--member" in call(gudgeon, "run", deck, "--member", "1", expect=2).stderr


def test_no_work_channels(gudgeon):
    """What only an integration can give is no channel of a kinematic run."""
    text = changed(four_bar(), "output", channels="energy.drive_work")
    directory = scratch()
    done = call(gudgeon, "check", written(directory, text), expect=3)
    assert "energy.drive_work" in done.stderr
    assert "kinetic potential elastic" in done.stderr


def test_explain(gudgeon, slider_crank):
    """`explain` counts freedoms against drivers and says that clearances are dropped."""
    done = call(gudgeon, "explain", written(scratch(), slider_crank))
    assert "1 degree of freedom without drivers, 1 driver" in done.stdout
    assert "a kinematic analysis treats all joints as ideal" in done.stdout
    assert "2401 output times" in done.stdout
    assert "analysis.dynamic" not in done.stdout
    done = call(gudgeon, "explain", written(scratch(), four_bar(more="twin  wall_a  heel\n")))
    assert "redundant constraints: 2 of 11 rows" in done.stdout


def test_option_analysis(gudgeon):
    """`--analysis` takes another section than the first of the deck, and says which there are."""
    text = changed(plain_deck(), "output", channels="slider.*") + "[analysis.kinematic]\nend = 12 ms\n"
    assert run(gudgeon, text, "--analysis", "kinematic").summary["method"] == "newton"
    assert run(gudgeon, text, "--tolerance", "1e-6").summary["method"] == "auto (verner)"
    done = run(gudgeon, text, "--analysis", "static", expect=2).done
    assert "no section [analysis.static]" in done.stderr
    assert "dynamic kinematic" in done.stderr
    done = run(gudgeon, text, "--analysis", "kinematic", "--method", "verner", expect=2).done
    assert "--method" in done.stderr


def test_echo_means_the_same(gudgeon):
    """deck.echo of a kinematic run gives the same motion again."""
    first = run(gudgeon, four_bar())
    again = run(gudgeon, (first.directory / "deck.echo").read_text())
    assert_close(again.read("bodies/position"), first.read("bodies/position"), absolute=1e-14, what="positions")
