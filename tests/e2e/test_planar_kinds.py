"""Springs, links, slots, drivers of lengths, initial speeds and named functions against closed forms."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.special import ellipj, ellipk
from support import ROOT, Run, assert_close, call, changed, scratch, written

G = 9.81
NOTHING_LOST = "stabilise = none"


def run(program, text, *options, files=(), expect=0):
    """Run a deck given as text, with files beside it."""
    directory = scratch()
    for name, content in files:
        written(directory, content, name)
    done = call(program, "run", written(directory, "deck = 1\n" + text), "--out", directory / "out", "--quiet", *options,
                expect=expect)
    return Run(directory / "out", done)


def tail(end, every, tolerance="1e-11", more=""):
    """The last sections of a deck."""
    return f"[analysis.dynamic]\nend = {end}\ntolerance = {tolerance}\n{more}\n[output]\nevery = {every}\n"


OSCILLATOR = """
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]  angle[deg]  vy[m/s]
mass  2         0.01             0     -0.5  0           0.3
[points]
name  body    xi[m]  eta[m]
hook  ground  0      0
eye   mass    0      0.05
line  ground  0      0
slide mass    0      0
[joint.translational]
name   i     j      axis
guide  line  slide  y
"""


def spring(damping):
    """Rows of a spring of 200 N/m and 0.3 m with 1.5 N of preload."""
    return ("[force.spring]\nname i j stiffness[N/m] damping[N.s/m] free_length[m] preload[N]\n"
            f"coil hook eye 200 {damping} 0.3 1.5\n")


@pytest.mark.parametrize("damping", [0.0, 3.0, 60.0])
def test_mass_on_a_spring(gudgeon, damping):
    """Free, damped and overdamped: the closed form of the linear oscillator."""
    result = run(gudgeon, OSCILLATOR + spring(damping) + tail("4 s", "5 ms"))
    t = result.time
    m, k, c = 2.0, 200.0, damping
    # length of the spring l = -(y + 0.05); 2 y'' = -g m + tension, tension = k (l - 0.3) + c l' + 1.5
    rest = 0.3 + (m * G - 1.5) / k
    x0, v0 = 0.45 - rest, -0.3
    roots = np.roots([m, c, k]).astype(complex)
    a = np.linalg.solve([[1, 1], roots], [x0, v0])
    length = rest + (a[0] * np.exp(roots[0] * t) + a[1] * np.exp(roots[1] * t)).real
    rate = (a[0] * roots[0] * np.exp(roots[0] * t) + a[1] * roots[1] * np.exp(roots[1] * t)).real
    assert_close(result.item("forces/length", "coil"), length, absolute=2e-9, what="length")
    assert_close(result.item("forces/rate", "coil"), rate, absolute=5e-8, what="rate")
    tension = k * (length - 0.3) + c * rate + 1.5
    assert_close(result.item("forces/tension", "coil"), tension, absolute=4e-6, what="tension")
    assert_close(result.item("forces/force", "coil")[:, 1], -tension, absolute=4e-6, what="force on the hook")
    stored = result.read("energy/elastic")
    assert_close(stored, 0.5 * k * (length - 0.3 + 1.5 / k) ** 2, absolute=1e-6, what="stored energy")
    lost = np.concatenate([[0.0], np.cumsum(c * (rate[1:] ** 2 + rate[:-1] ** 2) / 2 * np.diff(t))])
    assert_close(result.read("energy/dissipated_damper"), lost, absolute=2e-3 * max(lost[-1], 1e-9), what="lost in the damper")
    assert result.summary["energy_residual_max"] < 1e-8 * result.summary["energy_max"]


def test_ledger_of_springs_falls_with_the_tolerance(gudgeon):
    """Springs with dampers and actuators: the residual falls with the tolerance."""
    text = (ROOT / "inputs" / "valve_train.deck").read_text()
    text = changed(text, "output", figures=None)
    files = [("valve_lift.txt", (ROOT / "inputs" / "valve_lift.txt").read_text())]
    relative = []
    for tolerance in ("1e-6", "1e-8", "1e-10"):
        summary = run(gudgeon, text.replace("deck = 1\n", "", 1), "--tolerance", tolerance, files=files).summary
        relative.append(summary["energy_residual_max"] / summary["energy_max"])
    assert relative[0] > relative[1] > relative[2], relative
    assert relative[2] < 1e-9, relative


def test_torsional_oscillator(gudgeon):
    """A wheel on a torsional spring with an actuator at another frequency: closed form of the forced oscillator."""
    text = """
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  omega[rad/s]
wheel  1         0.02             0     0     2
[points]
name   body    xi[m]  eta[m]
axle   ground  0      0
hub    wheel   0      0
[joint.revolute]
name  i     j
pin   axle  hub
[force.torsion_spring]
name    i       j      stiffness[N.m/rad]  free_angle[rad]  preload[N.m]  actuator
spiral  ground  wheel  0.5                 0.4              0.1           {-0.03 N.m*sin(3 rad/s*t)}
"""
    result = run(gudgeon, text + tail("6 s", "10 ms"))
    t = result.time
    j, k = 0.02, 0.5
    w = np.sqrt(k / j)
    rest = 0.4 - 0.1 / k
    # j a'' = -k (a - rest) + 0.03 sin 3 t
    p = 0.03 / (k - j * 9.0)
    angle = rest - rest * np.cos(w * t) + (2.0 - 3.0 * p) / w * np.sin(w * t) + p * np.sin(3.0 * t)
    assert_close(result.item("bodies/angle", "wheel"), angle, absolute=5e-8, what="angle")
    assert_close(result.item("forces/angle", "spiral"), angle, absolute=5e-8, what="angle of the spring")
    moment = k * (angle - 0.4) + 0.1 - 0.03 * np.sin(3.0 * t)
    assert_close(result.item("forces/moment", "spiral"), moment, absolute=5e-8, what="moment")
    assert result.summary["energy_residual_max"] < 1e-8 * result.summary["energy_max"]


def test_bead_in_a_turning_slot(gudgeon):
    """A bead in a slot that turns evenly: r = r0 cosh(w t); the slot pushes with 2 m w r', the motor with that times r."""
    text = """
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]
arm   1         0.05             0     0
bead  0.3       1e-5             0.1   0
[points]
name   body    xi[m]  eta[m]
axle   ground  0      0
hub    arm     0      0
pin    bead    0      0
[joint.revolute]
name  i     j
shaft axle  hub
[joint.pin_in_slot]
name  i    j    axis
slot  hub  pin  x
[driver.speed]
name   joint  speed[rad/s]
motor  shaft  3
"""
    # the deck gives the bead no velocity: it starts with that of the slot
    result = run(gudgeon, text + tail("1 s", "2 ms"))
    t = result.time
    m, w = 0.3, 3.0
    r, dr = 0.1 * np.cosh(w * t), 0.1 * w * np.sinh(w * t)
    along, across = np.stack([np.cos(w * t), np.sin(w * t)], -1), np.stack([-np.sin(w * t), np.cos(w * t)], -1)
    assert_close(result.item("bodies/position", "bead"), r[:, None] * along, absolute=1e-8, what="position")
    assert_close(result.item("joints/force", "slot"), -2 * m * w * dr[:, None] * across, absolute=1e-6, what="force on the arm")
    assert_close(result.item("joints/moment", "slot"), 0.0, absolute=1e-9, what="a pin gives no moment")
    assert_close(result.item("drivers/moment", "motor"), 2 * m * w * dr * r, absolute=1e-6, what="moment of the motor")


def test_pendulum_on_a_massless_link(gudgeon):
    """A particle on a distance joint: the pendulum, by elliptic functions; the tension is Newton's."""
    length, start = 0.8, 2.0
    text = f"""
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]                   y[m]
bob   0.7       1e-3             {{{length}m*sin({start})}}  {{-{length}m*cos({start})}}
[points]
name   body    xi[m]  eta[m]
hook   ground  0      0
eye    bob     0      0
[joint.distance]
name  i     j
link  hook  eye
"""
    result = run(gudgeon, text + tail("10 s", "20 ms"))
    t = result.time
    k, w = np.sin(start / 2), np.sqrt(G / length)
    sn, cn, dn, _ = ellipj(ellipk(k * k) - w * t, k * k)
    angle = 2 * np.arcsin(k * sn)
    rate = -2 * k * w * cn
    place = length * np.stack([np.sin(angle), -np.cos(angle)], -1)
    assert_close(result.item("bodies/position", "bob"), place, absolute=3e-7, what="position")
    tension = 0.7 * (length * rate**2 + G * np.cos(angle))
    assert_close(result.item("joints/tension", "link"), tension, absolute=2e-5, what="tension")
    force = result.item("joints/force", "link")
    assert_close(force, tension[:, None] * place / length, absolute=2e-5, what="force on the hook pulls to the bob")
    assert result.summary["energy_residual_max"] < 1e-8 * result.summary["energy_max"]


def test_statics_of_links_and_slots(gudgeon):
    """A body hung from two links, and one on an inclined slot and a link: reactions of statics by hand."""
    text = """
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]  angle[deg]
lamp  2         0.01             0     -0.4  0
block 3         0.01             5     0     30
[points]
name   body    xi[m]  eta[m]
left   ground  -0.3   0
right  ground  0.3    0
ring   lamp    0      0
rail   ground  5      0
foot   block   0      0
wall   ground  4      -0.577350269189625764509
[joint.distance]
name   i      j     length[m]
a      left   ring  0.5
b      right  ring  0.5
stay   wall   foot  -
[joint.pin_in_slot]
name   i     j     axis  axis_angle[deg]
ramp   rail  foot  x     30
"""
    result = run(gudgeon, text + tail("10 ms", "1 ms"))
    # two links at 3:4:5 carry 2 g: 2 T 4/5 = 2 g
    for link, side in (("a", 1), ("b", -1)):
        pull = 2 * G / 1.6
        assert_close(result.item("joints/tension", link), pull, absolute=1e-9, what=link)
        assert_close(result.item("joints/force", link)[0], [side * 0.6 * pull, -0.8 * pull], absolute=1e-9, what=link)
    # the stay lies along the ramp below the block: it is pressed by 3 g sin 30, the ramp by 3 g cos 30
    assert_close(result.item("joints/tension", "stay"), -3 * G * 0.5, absolute=1e-9, what="stay")
    normal = 3 * G * np.sqrt(3) / 2
    assert_close(result.item("joints/force", "ramp")[0], [normal * 0.5, -normal * np.sqrt(3) / 2], absolute=1e-9, what="ramp")


def test_driven_distance_lifts_a_weight(gudgeon):
    """A cylinder between the ground and a weight in a vertical guide: force m (g + f''), power force times f'."""
    text = """
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]
cage   4         0.1              0     1
[points]
name   body    xi[m]  eta[m]
floor  ground  0      0
foot   cage    0      0
[joint.translational]
name   i      j     axis
shaft  floor  foot  y
[function.polynomial]     # 5th degree: from 1 m to 2 m in 2 s, smooth at both ends
name   c0[m]  c3[m/s^3]  c4[m/s^4]  c5[m/s^5]
rise   1      1.25       -0.9375    0.1875
"""
    rows = {
        "driver.distance": "name i j distance\nram floor foot {rise(t)}\n",
        "driver.position": "name i j axis position\nram floor foot y {rise(t)}\n",
    }
    for kind, row in rows.items():
        # the motion is known, so nothing but this limits the steps over which the works are integrated
        result = run(gudgeon, text + f"[{kind}]\n" + row + tail("2 s", "10 ms", more="maximum_step = 20 ms"))
        t = result.time
        f = 1 + 1.25 * t**3 - 0.9375 * t**4 + 0.1875 * t**5
        df = 3.75 * t**2 - 3.75 * t**3 + 0.9375 * t**4
        ddf = 7.5 * t - 11.25 * t**2 + 3.75 * t**3
        assert_close(f[-1], 2.0, absolute=1e-12, what="the lift ends at 2 m")
        assert_close(result.item("bodies/position", "cage")[:, 1], f, absolute=1e-8, what=kind)
        assert_close(result.item("drivers/displacement", "ram"), f, absolute=1e-8, what=kind)
        assert_close(result.item("drivers/force", "ram"), 4 * (G + ddf), absolute=1e-6, what=kind + ": force")
        assert_close(result.item("drivers/power", "ram"), 4 * (G + ddf) * df, absolute=1e-6, what=kind + ": power")
        work = 4 * G * (f - 1) + 2 * df**2
        assert_close(result.read("energy/drive_work"), work, absolute=1e-6, what=kind + ": work")


LINKAGE = """
[bodies]      # the start of the deck is rough; the crank stands at 10 degrees
name     mass[kg]  inertia[kg.m^2]  x[m]    y[m]   angle[deg]
crank    1         0.01             0.98    0.17   10
coupler  2         0.05             3.3     1.5    40
rocker   1.5       0.03             4.5     1.4    120
[points]
name   body     xi[m]  eta[m]
a0     ground   0      0
b0     ground   5      0
a1     crank    -1     0
a2     crank    1      0
c1     coupler  -2     0
c2     coupler  2      0
b1     rocker   -1.6   0
b2     rocker   1.6    0
[joint.revolute]
name   i   j
motor  a0  a1
elbow  a2  c1
wrist  c2  b2
stand  b0  b1
"""


def test_initial_speed_is_exact_and_lets_go(gudgeon):
    """The crank has the deck's angle and the given speed exactly; then it is free and slows down or speeds up."""
    text = LINKAGE + "[initial.speed]\nname joint speed[rad/s]\nkick motor 6.283185307179586\n"
    result = run(gudgeon, text + tail("1 s", "10 ms"))
    assert result.item("bodies/angular_velocity", "crank")[0] == pytest.approx(6.283185307179586, rel=4e-16, abs=0)
    assert result.item("bodies/angle", "crank")[0] == pytest.approx(np.radians(10), rel=1e-14)
    omega = result.item("bodies/angular_velocity", "crank")
    assert np.ptp(omega) > 0.5, "nothing holds the speed"
    energy = result.read("energy/kinetic")
    assert_close(energy, energy[0], relative=1e-8, what="nothing works on it")
    assert result.item("joints/violation_rate", "wrist")[0] < 1e-13


def test_initial_speed_of_a_loose_mechanism(gudgeon):
    """Between two moving bodies, with start = given: the relative speed is exact."""
    text = LINKAGE + "[initial.speed]\nname joint speed[rad/s]\nkick elbow -2.5\n"
    result = run(gudgeon, text + tail("10 ms", "1 ms", more="start = given"))
    relative = result.item("bodies/angular_velocity", "coupler") - result.item("bodies/angular_velocity", "crank")
    assert relative[0] == pytest.approx(-2.5, rel=2e-15)


def test_initial_speed_that_contradicts(gudgeon):
    """A driver on the same joint at another speed: an assembly error that names both."""
    text = (LINKAGE + "[initial.speed]\nname joint speed[rad/s]\nkick motor 6\n[driver.speed]\nname joint speed[rad/s]\n"
            "engine motor 5\n")
    done = run(gudgeon, text + tail("1 s", "10 ms"), expect=4).done
    assert "'kick'" in done.stderr and "'engine'" in done.stderr, done.stderr


def test_samples_from_a_file_are_scipys_spline(gudgeon):
    """A table of a force from a file, not a knot and periodic: values between the samples are those of scipy."""
    rng = np.random.default_rng(3)
    at = np.cumsum(rng.uniform(0.5, 2.0, 30))
    at -= at[0]
    force = rng.normal(size=30)
    force[-1] = force[0]
    content = "# a comment\nt[ms]  pull[N]\n" + "".join(f"{a!r} {f!r}  # row\n" for a, f in zip(at.tolist(), force.tolist()))
    for word, how in (("hold", "not-a-knot"), ("periodic", "periodic")):
        text = f"""
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]
mass   1         1                0     0
[points]
name   body   xi[m]  eta[m]
eye    mass   0      0
[function.samples]
name   file         beyond
pull   "pull.txt"   {word}
[force.point]
name   point  fx
rope   eye    {{pull(t)}}
"""
        result = run(gudgeon, text + tail("40 ms", "0.1 ms", tolerance="1e-8"), files=[("pull.txt", content)])
        t = np.minimum(result.time * 1e3, at[-1]) if word == "hold" else np.mod(result.time * 1e3, at[-1])
        assert_close(result.item("forces/force", "rope")[:, 0], CubicSpline(at, force, bc_type=how)(t), absolute=1e-9, what=how)
        echo = (result.directory / "deck.echo").read_text()
        again = run(gudgeon, echo.split("deck = 1\n", 1)[1])
        assert np.array_equal(again.item("forces/force", "rope"), result.item("forces/force", "rope")), "the echo needs no file"


def test_spring_with_actuator_follows_an_ode(gudgeon):
    """A free mass on a spring in the plane, pulled by a harmonic actuator: scipy integrates the same two equations."""
    text = """
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  vx[m/s]
mass   0.5       0.01             0.6   -0.3  1
[points]
name   body    xi[m]  eta[m]
hook   ground  0      0
eye    mass    0      0
[function.harmonic]
name   amplitude[N]  angular_frequency[rad/s]  phase[deg]  offset[N]
pulse  2             9                         40          1
[force.spring]
name   i     j    stiffness[N/m]  damping[N.s/m]  free_length[mm]  actuator
coil   hook  eye  60              0.2             400              {pulse(t)}
"""
    result = run(gudgeon, text + tail("3 s", "10 ms"))

    def right(t, y):
        r, v = y[:2], y[2:]
        length = np.hypot(*r)
        u = r / length
        tension = 60 * (length - 0.4) + 0.2 * (u @ v) + 1 + 2 * np.sin(9 * t + np.radians(40))
        return [*v, *(-tension * u / 0.5 - np.array([0, G]))]

    known = solve_ivp(right, (0, 3), [0.6, -0.3, 1, 0], t_eval=result.time, rtol=1e-12, atol=1e-13, method="DOP853").y
    assert_close(result.item("bodies/position", "mass"), known[:2].T, absolute=1e-8, what="position")
    assert result.summary["energy_residual_max"] < 1e-8 * result.summary["energy_max"]


FREE_MASS = """
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  vx[m/s]
mass   0.5       0.01             {start}   0     {speed}
[points]
name   body    xi[m]  eta[m]
hook   ground  -1     0
line   ground  0      0
eye    mass    0      0
[joint.translational]
name   i     j     axis
guide  line  eye   x
[force.spring]
name   i     j    free_length[m]  stiffness[N/m]  law
coil   hook  eye  1               {stiffness}     {law}
"""


def test_law_of_a_hardening_spring(gudgeon):
    """Duffing's oscillator: a cubic law beside the stiffness, by an elliptic function; its energy is stored."""
    m, k, b, a = 0.5, 20.0, 300.0, 0.3
    text = FREE_MASS.format(start=a, speed=0, stiffness=k, law="{300 N/m^3*x^3}")
    result = run(gudgeon, text + tail("5 s", "10 ms"))
    # x'' = -(k x + b x^3)/m:  x = a cn(w t | n),  w^2 = (k + b a^2)/m,  n = b a^2/(2 (k + b a^2))
    w, n = np.sqrt((k + b * a**2) / m), b * a**2 / (2 * (k + b * a**2))
    x = a * ellipj(w * result.time, n)[1]
    assert_close(result.item("bodies/position", "mass")[:, 0], x, absolute=3e-8, what="position")
    assert_close(result.item("forces/tension", "coil"), k * x + b * x**3, absolute=3e-6, what="tension")
    assert_close(result.read("energy/elastic"), k * x**2 / 2 + b * x**4 / 4, absolute=1e-6, what="stored energy")
    assert_close(result.read("energy/load_work"), 0.0, absolute=0.0, what="no loads")
    assert result.summary["energy_residual_max"] < 1e-8 * result.summary["energy_max"]


def test_law_of_a_stop(gudgeon):
    """A stop behind a gap, by samples over the stretch: flight, half a period on the stop, flight back."""
    m, v, gap, k = 0.5, 2.0, 0.1, 5000.0
    text = FREE_MASS.format(start=0, speed=v, stiffness=0, law="{5000 N/m*max(x - 100 mm, 0mm)}")
    result = run(gudgeon, text + tail("0.25 s", "1 ms", tolerance="1e-10"))
    t, w = result.time, np.sqrt(k / m)
    on, off = gap / v, gap / v + np.pi / w
    x = np.where(t < on, v * t, np.where(t < off, gap + v / w * np.sin(w * (t - on)), gap - v * (t - off)))
    assert_close(result.item("bodies/position", "mass")[:, 0], x, absolute=1e-7, what="position")
    assert result.summary["energy_residual_max"] < 1e-6 * result.summary["energy_max"]


def test_law_of_a_torsional_spring_by_samples(gudgeon):
    """A law given by samples of a sine over the angle: the pendulum without gravity."""
    angles = np.linspace(-3, 3, 61)
    text = f"""
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  angle[rad]
wheel  1         0.02             0     0     2.5
[points]
name   body    xi[m]  eta[m]
axle   ground  0      0
hub    wheel   0      0
[joint.revolute]
name  i     j
pin   axle  hub
[function.samples]
name  at  value
bend  "{' '.join(map(repr, angles.tolist()))} rad"  "{' '.join(map(repr, np.sin(angles).tolist()))} N.m"
[force.torsion_spring]
name    i       j      free_angle[rad]  law
spiral  ground  wheel  0.5              {{bend(x)}}
"""
    result = run(gudgeon, text + tail("2 s", "10 ms"))
    n, w = np.sin(1.0) ** 2, np.sqrt(1 / 0.02)
    sn = ellipj(ellipk(n) - w * result.time, n)[0]
    assert_close(result.item("bodies/angle", "wheel"), 0.5 + 2 * np.arcsin(np.sqrt(n) * sn), absolute=5e-5, what="angle")
    assert result.summary["energy_residual_max"] < 1e-7 * result.summary["energy_max"]


@pytest.mark.parametrize("name", ["quick_return", "valve_train"])
def test_examples(gudgeon, name):
    """The example decks run with a closed ledger."""
    directory = scratch()
    call(gudgeon, "run", ROOT / "inputs" / f"{name}.deck", "--out", directory / "out", "--quiet")
    summary = Run(directory / "out").summary
    assert summary["status"] == "complete"
    assert summary["energy_residual_max"] < 1e-6 * summary["energy_max"]


def test_quick_return_ratio(gudgeon):
    """The arm of the quick return swings by asin(r/a), and its ways take (180 + 2 swing) to (180 - 2 swing)."""
    directory = scratch()
    text = changed((ROOT / "inputs" / "quick_return.deck").read_text(), "output", figures=None, every="0.1 ms")
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    result = Run(directory / "out")
    angle = np.degrees(result.item("bodies/angle", "arm"))
    swing = np.degrees(np.arcsin(0.08 / 0.2))
    assert_close([angle.min(), angle.max()], [90 - swing, 90 + swing], absolute=1e-4, what="swing")
    turn = slice(0, 10001)
    slow = abs(result.time[turn][np.argmax(angle[turn])] - result.time[turn][np.argmin(angle[turn])])
    slow = max(slow, 1 - slow)
    assert_close(slow / (1 - slow), (180 + 2 * swing) / (180 - 2 * swing), absolute=5e-3, what="ratio of the ways")
