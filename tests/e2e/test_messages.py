"""Messages that name the place, the value and the way out: assembly, dead centres, units, expressions, joints with clearance, sweeps."""

import re

import pytest
from support import ROOT, call, scratch, written
from test_closing import SLIDER_CRANK as KINEMATIC

DOOR = """deck = 1
[scene]
space = spatial
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m]
door 1 0.1 0.1 0.1 0.5
[points]
name body xi[m] zeta[m]
o1 ground 0 0.5
o2 ground 0 -0.5
d1 door -0.5 0.5
d2 door -0.5 -0.5
[joint.revolute]
name i j axis_i axis_j
upper o1 d1 "0 0 1" "0 0 1"
lower o2 d2 "0 0 1" "AXIS"
[analysis.dynamic]
end = 0.1 s
"""

LINKS = """deck = 1
[scene]
space = spatial
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m]
a 1 0.1 0.1 0.1 0.5
b 1 0.1 0.1 0.1 1.5
[points]
name body xi[m]
o ground 0
a0 a -0.5
a1 a 0.5
b0 b -0.5
b1 b 0.5
e ground 2
[joint.revolute]
name i j axis_i axis_j
p o a0 "0 0 1" "0 0 1"
q a1 b0 "0 0 1" "AXIS"
r b1 e "0 0 1" "0 0 1"
[analysis.dynamic]
end = 0.1 s
"""

PENDULUM = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m]
rod 1 0.1 0.5
[points]
name body xi[m]
o ground 0
end rod -0.5
[joint.revolute]
name i j
pivot o end
[analysis.dynamic]
end = 0.1 s
"""


@pytest.mark.parametrize("deck, joint, bodies", [(DOOR, "lower", "ground and 'door'"), (LINKS, "q", "'a' and 'b'")])
@pytest.mark.parametrize("axis, degrees", [("0 0.02 1", 1.146), ("0 1 1", 45.0)])
def test_axes_that_differ(gudgeon, deck, joint, bodies, axis, degrees):
    """The joint, both bodies, and the angle between its axes where the deck puts them."""
    said = call(gudgeon, "check", written(scratch(), deck.replace("AXIS", axis)), expect=4).stderr
    found = re.search(rf"at the given positions of the bodies '{joint}' between {bodies} is off by \S+ mm and (\S+) deg", said)
    assert found, said
    assert float(found[1]) == pytest.approx(degrees, rel=5e-3)  # three digits


def test_axes_at_right_angles(gudgeon):
    """No turn helps at first: 90 degrees, between which bodies."""
    said = call(gudgeon, "check", written(scratch(), DOOR.replace("AXIS", "0 1 0")), expect=4).stderr
    assert "'lower'" in said and "between ground and 'door' are perpendicular" in said and "90 deg off" in said and "57.3" not in said, said


SLIDER_CRANK = KINEMATIC.replace("[analysis.kinematic]", "[analysis.dynamic]")


def test_dynamic_run_started_at_a_dead_centre(gudgeon):
    """Driver, joints of the loop, angles of its bodies, and what to do."""
    said = call(gudgeon, "check", written(scratch(), SLIDER_CRANK), expect=4).stderr
    assert "dead centre of driver 'push' at t = 0 s" in said, said
    assert all(f"'{name}'" in said for name in ("A", "B", "C")) and "'crank' 0 deg" in said, said
    assert "start some degrees away" in said, said


@pytest.mark.parametrize("analysis", ["dynamic", "kinematic"])
def test_dead_centre_on_the_way(gudgeon, analysis):
    """The crank stops at acos(3/8): loop, driver and the angle of the crank."""
    text = (ROOT / "inputs/hard/dead_point.deck").read_text().replace("analysis.dynamic", f"analysis.{analysis}")
    if analysis == "kinematic":
        text = re.sub(r"^(?:tolerance|stabilise) .*\n", "", text, flags=re.M)
    where = scratch()
    said = call(gudgeon, "run", written(where, text), "--out", where / "out", "--quiet", "--write", "numbers", expect=5).stderr
    found = re.search(r"near a dead centre: the loop of (.*) can hardly be moved there by driver 'motor'; angles: .*'coupler' (\S+) deg", said)
    assert found, said
    assert all(f"'{name}'" in found[1] for name in ("main", "crankpin", "top", "pivot")), said


PIN = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[m]
rod 1 0.1 0.1
[points]
name body xi[m]
o ground 0
a0 rod -0.1
[joint.revolute]
name i j
p o a0
[driver.angle]
name joint angle
m p {60rpm*t}
[analysis.dynamic]
end = 0.1 s
"""


@pytest.mark.parametrize("unit, meant", [("rpmm", "rpm"), ("rads", "rad/s"), ("rps", "rev/s"), ("Nmm", "N.mm"), ("mmm", "mm")])
def test_nearest_unit(gudgeon, unit, meant):
    said = call(gudgeon, "check", written(scratch(), PIN.replace("60rpm*t", f"60{unit}*t")), expect=3).stderr
    assert f"unknown unit '{unit}': did you mean '{meant}'?" in said, said


@pytest.mark.parametrize("word, meant", [("hinge", "revolute"), ("prismatic", "translational"), ("weld", "rigid"), ("revolut", "revolute")])
def test_joints_of_other_programs(gudgeon, word, meant):
    """A joint by the name that other programs give it."""
    text = PENDULUM.replace("[joint.revolute]", f"[joint.{word}]")
    assert text != PENDULUM
    said = call(gudgeon, "check", written(scratch(), text), expect=3).stderr
    assert f"did you mean [joint.{meant}]?" in said, said


def test_mobility_is_told(gudgeon):
    """A joint that was forgotten shows: two rows less. With clearance the ideal twin has its own."""
    assert "2 constraint rows (mobility 1), 0 joints" in call(gudgeon, "check", written(scratch(), PENDULUM)).stdout
    deck = ROOT / "inputs/slider_crank_dry.deck"
    assert "(mobility 2, 0 with all joints ideal), 1 joint with" in call(gudgeon, "check", deck).stdout


def test_power_of_ten_with_a_unit(gudgeon):
    """A unit behind an exponent: how it is written."""
    said = call(gudgeon, "check", written(scratch(), PIN.replace("60rpm*t", "10^4.5 N/m^1.5")), expect=3).stderr
    assert "write 10^4.5 * 1 N/m^1.5" in said, said


def test_driven_joint_with_clearance(gudgeon):
    """It is there, and cannot be driven; nor can a joint of another type by a driver that is not for it."""
    loose = PIN.replace("[joint.revolute]\nname i j\np o a0\n", """[material]
name young[GPa] poisson
steel 207 0.3
[contact.hertz]
name
h
[clearance.revolute]
name bearing journal clearance[mm] bearing_radius[mm] law material
p o a0 0.1 10 h steel
""")
    said = call(gudgeon, "check", written(scratch(), loose), expect=3).stderr
    assert "'p' in column joint of driver.angle is a clearance.revolute" in said and "ideal joint" in said, said
    rigid = PIN.replace("[joint.revolute]", "[joint.rigid]")
    said = call(gudgeon, "check", written(scratch(), rigid), expect=3).stderr
    assert "'p' in column joint of driver.angle is a joint.rigid" in said, said


def test_unknown_variable_of_a_law(gudgeon):
    """The variables that the expression may use."""
    text = PIN + "[contact.expression]\nname force\nlaw {1e9N/m*x}\n"
    said = call(gudgeon, "check", written(scratch(), text), expect=3).stderr
    assert "unknown variable or parameter 'x'" in said and "variables here: delta, rate, v0" in said, said


def test_unsupported_function_of_adams(gudgeon):
    """The function, the line of its statement, and the measures that there are."""
    text = (ROOT / "tests/adams/slider_crank.adm").read_text()
    text = text.replace("FUNCTION = -20\n, - 10*SIN(4*PI*TIME)", "FUNCTION = -3*VM(41)")
    path = written(scratch(), text, "model.adm")
    line = next(k for k, words in enumerate(text.splitlines(), 1) if words.startswith("SFORCE/1"))
    said = call(gudgeon, "import", path, cwd=path.parent).stdout
    assert re.search(rf"line {line}, column 1: SFORCE/1: function VM is not supported \(.*DM DX .*\): -3\*VM\(41\)", said), said


def test_wall_time_is_said(gudgeon):
    """Not a signal: the limit that the command line sets."""
    text = PIN.replace("end = 0.1 s", "end = 1e6 s").replace("[bodies]", "[scene]\ngravity = 0 -9.81 m/s^2\n[bodies]", 1)
    text = text.replace("[driver.angle]\nname joint angle\nm p {60rpm*t}\n", "")
    where = scratch()
    said = call(gudgeon, "run", written(where, text), "--out", where / "out", "--quiet", "--write", "numbers", "--walltime", "1s", expect=7).stderr
    assert "stopped by the time limit of --walltime at t = " in said and "signal" not in said, said


SWEEP = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[parameters]
length = 1 m
[bodies]
name mass[kg] inertia[kg.m^2] x
rod 1 0.0833 {0.5*length}
[points]
name body xi
wall ground 0m
top rod {-0.5*length}
[joint.revolute]
name i j
pin wall top
[sweep]
length = LENGTHS m
[statistics]
channels = pin.force
[analysis.dynamic]
end = 0.1 s
[output]
every = 10 ms
figures = statistics(pin.force.y.max)
"""


def test_table_of_a_sweep_and_comparison(gudgeon):
    """Twenty cases and where the others are; the numbers of its figure; two sweeps are compared case by case."""
    where = scratch()
    text = SWEEP.replace("LENGTHS", " ".join(f"{0.5 + 0.05 * k:.2f}" for k in range(24)))
    deck = written(where, text)
    said = call(gudgeon, "sweep", deck, "--out", where / "a").stdout
    lines = [line.split() for line in said.splitlines()]
    (head,) = [k for k, words in enumerate(lines) if words[:2] == ["case", "length"]]
    rows = (where / "a/cases.csv").read_text().splitlines()
    column = rows[0].split(",").index("pin.force.y.max mean [N]")
    assert lines[head] == ["case", "length", "pin.force.y.max", "[N]"]
    for k in range(20):
        assert lines[head + 1 + k][:2] == [str(k + 1), f"{0.5 + 0.05 * k:.2f}m"], lines[head + 1 + k]
        assert float(lines[head + 1 + k][2]) == pytest.approx(float(rows[k + 1].split(",")[column]), rel=1e-4)
    assert "4 more in cases.csv" in said
    call(gudgeon, "sweep", deck, "--out", where / "b", "--quiet")
    assert "0 of" in call(gudgeon, "compare", where / "a", where / "b").stdout
    text = (where / "b/cases.csv").read_text().splitlines()
    cells = text[3].split(",")
    cells[column] = repr(1.01 * float(cells[column]))
    text[3] = ",".join(cells)
    (where / "b/cases.csv").write_text("\n".join(text) + "\n")
    said = call(gudgeon, "compare", where / "a", where / "b", expect=1).stdout
    assert "case 3, pin.force.y.max mean [N]: " in said and "1 of" in said, said
    call(gudgeon, "compare", where / "a", where / "b", "--relative", "0.1")


def test_thresholds_of_what_the_deck_has(gudgeon):
    """No thresholds of friction and contacts for a pendulum; those of sticking where a law sticks."""
    said = call(gudgeon, "explain", written(scratch(), PIN)).stdout
    assert "numerical thresholds" in said and not re.search(r"slip|sliding|stick|penetration.*threshold", said.split("numerical thresholds")[1]), said
    said = call(gudgeon, "explain", ROOT / "inputs/incline.deck", "--set", "friction=coulomb").stdout
    assert "slip-to-stick" in said
