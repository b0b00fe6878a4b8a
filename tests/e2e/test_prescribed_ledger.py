"""The ledger where the motion is prescribed: no error of the motion limits the steps, only that of works and losses does.

What is asserted: the residual of the ledger, greatest of all steps, is below 100 times the tolerance of the largest energy or work, by
every adaptive method. Works are compared with closed forms, and with quadratures of the deck's own powers, as well.
"""

import json
import math

import pytest
from support import ROOT, Run, assert_close, call, changed, scratch, written

METHODS = ["auto", "verner", "dop853", "adams", "bdf", "ida", "radau", "rock4"]
TOLERANCES = ["1e-6", "1e-8"]
TERMS = ["kinetic", "elastic", "drive_work", "load_work", "stabilisation_work", "dissipated_contact", "dissipated_friction", "dissipated_damper",
         "dissipated_film"]

SLIDER = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[mm] y[mm]
rack 2.5 1e-3 0 0
wheel 1 1e-3 0 100
[points]
name body xi[mm] eta[mm]
o ground 0 0
q ground 0 100
far ground 300 40
r rack 0 0
w wheel 0 0
[joint.translational]
name i j axis
slide o r x
[joint.revolute]
name i j
pin q w
[driver.position]
name i j axis position
push o r x {position}
{more}
[analysis.dynamic]
end = 1.2 s
[output]
every = 50 ms
channels = energy.*
"""
RISE = "{100mm*step5(t,0s,0,1s,1)}"
SWING = "{40mm*sin(9rad/s*t)+10mm*sin(31rad/s*t)}"
SPRING = "[force.spring]\nname i j stiffness[N/m] damping[N.s/m] free_length[mm]\ns far r 400 6 200\n"
DAMPER = '[force.spring]\nname i j damper\nd far r {3N.s/m*v+20N.s^3/m^3*v^3}\n'
POINT = '[force.point]\nname point fx\nf r {5N*sin(17rad/s*t)}\n'
GUIDE = """[friction.rooney_deravi]
name coefficient v1[m/s]
rub 0.3 0.05
"""

CRANK = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]
crank 3 0.02 0.1 0 0
[points]
name body xi[m] eta[m]
o ground 0 0
top ground 0.05 0.5
c crank -0.1 0
e crank 0.1 0
[joint.revolute]
name i j
main o c
[driver.angle]
name joint angle
turn main {angle}
[force.spring]
name i j stiffness[N/m] damping[N.s/m] free_length[m]
s top e 250 4 0.3
[force.torsion_spring]
name i j stiffness[N.m/rad] damping[N.m.s/rad]
t ground crank 2 0.3
[analysis.dynamic]
end = 2 s
[output]
every = 50 ms
channels = energy.*
"""
WAVE = "{1.2rad*sin(5rad/s*t)+0.3rad*cos(13rad/s*t)-0.3rad}"

FILM = """deck = 1
[bodies]
name mass[kg] inertia[kg.m^2] x[mm] y[mm]
journal 0.5 1e-4 0.02 0
[points]
name body xi[mm] eta[mm]
housing ground 0 0
centre journal 0 0
[joint.parallel]
name i j
straight ground journal
[driver.position]
name i j axis position
across housing centre x {0.02mm*cos(20rad/s*t)+0.03mm*sin(33rad/s*t)}
along housing centre y {0.05mm*sin(20rad/s*t)}
[lubricant]
name viscosity[Pa.s]
oil 0.1
[film.pinkus_sternlicht]
name
ps
[clearance.revolute]
name bearing journal bearing_radius[mm] clearance[mm] length[mm] level film lubricant
b housing centre 10 0.2 20 lubricated ps oil
[analysis.dynamic]
end = 1 s
start = given
[output]
every = 50 ms
channels = energy.*
"""

SPACE = """deck = 1
[scene]
space = spatial
gravity = 0 0 -9.81 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m]
arm 2 0.02 0.05 0.06 0.3 0 0
[points]
name body xi[m] eta[m] zeta[m]
o ground 0 0 0
far ground 0.4 0.5 0.2
a arm -0.3 0 0
e arm 0.2 0.1 0
[joint.revolute]
name i j axis_i
main o a "0 1 1"
[driver.angle]
name joint angle
turn main {0.9rad*sin(6rad/s*t)}
[force.spring]
name i j stiffness[N/m] damping[N.s/m] free_length[m]
s far e 120 5 0.2
[analysis.dynamic]
end = 1.5 s
[output]
every = 50 ms
channels = energy.*
"""


def slider(position, more=""):
    return SLIDER.replace("{position}", position).replace("{more}", more)


def rubbing(text):
    """The slider's guide rubs."""
    text = text.replace("name i j axis\nslide o r x\n", "name i j axis friction preload[N]\nslide o r x rub 8\n")
    return text.replace("[joint.revolute]", GUIDE + "[joint.revolute]")


DECKS = {
    "rise": slider(RISE),
    "swing": slider(SWING),
    "spring": slider(RISE, SPRING),
    "damper": slider(SWING, DAMPER),
    "force": slider(SWING, POINT),
    "all of them": slider(SWING, SPRING + DAMPER + POINT),
    "rubbing guide": rubbing(slider(SWING)),
    "crank": CRANK.replace("{angle}", WAVE),
    "film": FILM,
    "space": SPACE,
}


def share(gudgeon, text, tolerance, *options):
    """Greatest residual over the tolerance of the largest energy or work, and the summary."""
    directory = scratch()
    deck = text if hasattr(text, "read_text") else written(directory, text)
    done = call(gudgeon, "run", deck, "--out", directory / "out", "--tolerance", tolerance, "--write", "channels", "--json", *options)
    told = json.loads(done.stdout)
    largest = max(max(abs(e["least"]), abs(e["greatest"])) for e in told["extremes"] if e["channel"] in [f"energy.{term}" for term in TERMS])
    largest = max(largest, told["energy_max"])
    return told["energy_residual_max"] / (largest * float(tolerance)), told


@pytest.mark.parametrize("tolerance", TOLERANCES)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("deck", DECKS)
def test_residual(gudgeon, deck, method, tolerance):
    """The residual is below 100 times the tolerance of the largest energy or work, and no step is lost in noise."""
    residual, told = share(gudgeon, DECKS[deck], tolerance, "--method", method)
    assert residual < 100.0, (deck, method, tolerance, residual)
    assert told["steps"] + told["rejected_steps"] < 20000, told["steps"]


@pytest.mark.parametrize("tolerance", ["1e-6", "1e-9"])
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", ["bent_shafts", "lifting_arm", "quick_return", "shaken_pendulum", "slider_crank_dry", "slider_crank_translational",
                                  "slider_crank_6_6_lubricated", "valve_train"])
def test_decks_of_inputs(gudgeon, name, method, tolerance):
    """Decks with drivers, all of whose joints are ideal: most are prescribed wholly."""
    text = (ROOT / "inputs" / f"{name}.deck").read_text()
    if "[analysis.dynamic]" not in text:
        pytest.skip("no dynamic analysis")
    text = changed(text, "output", channels="energy.*", figures=None, motion=None)
    directory = scratch()
    for table in (ROOT / "inputs").glob("*.txt"):
        (directory / table.name).write_text(table.read_text())
    residual, told = share(gudgeon, written(directory, text), tolerance, "--method", method, "--ideal")
    assert residual < 100.0, (name, method, tolerance, residual)


def test_work_of_the_driver_is_known(gudgeon):
    """Of a mass alone the work of its driver is its kinetic energy, in each row; of a spring the energy that it stores and loses besides."""
    for method in METHODS:
        directory = scratch()
        call(gudgeon, "run", written(directory, slider(RISE)), "--out", directory / "out", "--method", method, "--tolerance", "1e-8", "--write", "channels",
             "--quiet")
        run = Run(directory / "out")
        largest = 0.5 * 2.5 * 0.1875**2
        s = [min(t, 1.0) for t in run.time]
        speed = [0.1 * 30 * x**2 * (1 - x) ** 2 for x in s]
        assert_close(run.read("energy/drive_work").ravel(), [1.25 * v**2 for v in speed], absolute=1e-6 * largest, what=method)


def test_losses_of_a_prescribed_damper(gudgeon):
    """A damper between prescribed points loses the integral of c v^2, whatever the method."""
    text = slider("{40mm*sin(9rad/s*t)}", "[force.spring]\nname i j damping[N.s/m]\nd far r 6\n")
    n = 200001
    speed = []
    for k in range(n):
        t = 1.2 * k / (n - 1)
        x, v = 0.04 * math.sin(9 * t), 0.36 * math.cos(9 * t)
        speed.append((x - 0.3) * v / math.hypot(x - 0.3, 0.04))
    step = 1.2 / (n - 1)
    lost = 6 * step * sum((w * v**2 for w, v in zip([0.5] + [1.0] * (n - 2) + [0.5], speed)))
    for method in METHODS:
        directory = scratch()
        call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--method", method, "--tolerance", "1e-8", "--write", "channels", "--quiet")
        assert_close(Run(directory / "out").read("energy/dissipated_damper").ravel()[-1], lost, relative=1e-6, what=method)
