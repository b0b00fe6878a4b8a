"""Friction in ideal joints against closed forms: pins and guides, by every law that a joint takes, and by every way of solving."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from support import Run, assert_close, call, scratch, written

G = 9.81
COEFFICIENT = 0.2
# laws whose force at fast, steady sliding is the coefficient times the normal force
LAWS = {
    "threlfall": "coefficient v_r[m/s] above\nrub  0.2 1e-3 exponential",
    "rooney_deravi": "coefficient v1[m/s]\nrub  0.2 1e-3",
    "ambrosio": "coefficient v0[m/s] v1[m/s]\nrub  0.2 1e-4 1e-3",
    "brown_mcphee": "coefficient static_coefficient v_t[m/s]\nrub  0.2 0.2 1e-3",
    "stribeck": "coefficient static_coefficient\nrub  0.2 0.3",
    "dahl": "coefficient stiffness[m^-1]\nrub  0.2 1e4",
    "lugre": "coefficient static_coefficient bristle_stiffness[m^-1]\nrub  0.2 0.3 1e4",
}
DRY = "[friction.threlfall]\nname coefficient v_r[m/s] above\nrub  0.2 1e-3 exponential\n"
WAYS = [{}, {"method": "ida"}, {"method": "bdf"}, {"method": "adams"}, {"solver": "sparse"}, {"solver": "lapack"},
        {"stabilise": "partitioning"}, {"stabilise": "baumgarte alpha=5s^-1 beta=5s^-1"}]


def run(program, text, end="0.2 s", every="5 ms", expect=0, tolerance="1e-10", **settings):
    """Run a deck given as text."""
    directory = scratch()
    more = "".join(f"{key} = {value}\n" for key, value in settings.items())
    text = f"deck = 1\n{text}\n[analysis.dynamic]\nend = {end}\ntolerance = {tolerance}\n{more}[output]\nevery = {every}\n"
    done = call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", expect=expect)
    return Run(directory / "out", done)


def law(name):
    """The table of a law, whose row is called rub."""
    return f"[friction.{name}]\nname {LAWS[name]}\n"


def disc(radius=0.02, preload=5.0, inertia=0.01, speed=20.0):
    """A disc of 2 kg that turns on a pin."""
    return f"""
[scene]
gravity = 0 -{G} m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] omega[rad/s]
disc 2 {inertia} 0.3 -0.2 {speed}
[points]
name body xi[m] eta[m]
axle ground 0.3 -0.2
hub disc 0 0
[joint.revolute]
name i j friction radius[m] preload[N]
pin axle hub rub {radius} {preload}
"""


@pytest.mark.parametrize("name", LAWS)
def test_disc_coasts_down(gudgeon, name):
    """omega' = -c r (m g + preload)/I, whatever the law; the moment, the reaction and the ledger tell the same."""
    result = run(gudgeon, law(name) + disc(), tolerance="1e-9")
    rate = COEFFICIENT * 0.02 * (2 * G + 5) / 0.01
    late = result.time > 0.05  # bristles have bent by then
    assert_close(result.read("bodies/angular_acceleration").ravel()[late], -rate + 0 * result.time[late], absolute=1e-6 * rate,
                 what="deceleration")
    assert_close(result.item("joints/friction_moment", "pin").ravel()[late], -0.01 * rate + 0 * result.time[late],
                 absolute=1e-8 * rate, what="friction moment")
    assert_close(result.item("joints/force", "pin")[:, 1], -2 * G + 0 * result.time, absolute=1e-9, what="force on the ground")
    omega = result.read("bodies/angular_velocity").ravel()
    lost = 0.005 * (omega[0] ** 2 - omega**2)
    assert_close(result.read("energy/dissipated_friction").ravel(), lost, absolute=1e-9, what="lost by friction")


def test_disc_stops_and_stays(gudgeon):
    """A disc with bristles comes to rest when the closed form says, and turns no more."""
    result = run(gudgeon, law("dahl") + disc(speed=1.0), end="0.3 s")
    rate = COEFFICIENT * 0.02 * (2 * G + 5) / 0.01
    omega = result.read("bodies/angular_velocity").ravel()
    rest = result.time > 1.0 / rate + 0.02
    turn = result.read("bodies/angle").ravel()
    assert_close(turn[-1], 0.5 / rate, relative=0.02, what="angle of the way")
    assert rest.sum() > 5
    assert abs(turn[rest] - turn[-1]).max() < 2e-3
    assert abs(omega[rest]).max() < 0.2


def pendulum():
    """A bar of 3 kg on a pin at its end, horizontal, turning: its reaction depends on the acceleration that friction changes."""
    return DRY + f"""
[scene]
gravity = 0 -{G} m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] vy[m/s] omega[rad/s]
bar 3 0.05 0.4 0 1.2 3
[points]
name body xi[m] eta[m]
axle ground 0 0
end bar -0.4 0
[joint.revolute]
name i j friction radius[m]
pin axle end rub 0.1
"""


@pytest.mark.parametrize("settings", WAYS, ids=str)
def test_pendulum_implicit_reaction(gudgeon, settings):
    """At the start (I + m L^2) a = -m g L - c r R(a), R = m |(-L w^2, L a + g)|: a root that is found by bisection here."""
    result = run(gudgeon, pendulum(), end="0.3 s", every="2 ms", **settings)
    m, length, inertia, omega = 3.0, 0.4, 0.05, 3.0

    def left(a):
        reaction = m * np.hypot(length * omega**2, length * a + G)
        return (inertia + m * length**2) * a + m * G * length + COEFFICIENT * 0.1 * reaction

    a = brentq(left, -100, 0, xtol=1e-14)
    assert_close(result.read("bodies/angular_acceleration").ravel()[0], a, relative=1e-8, what="acceleration at the start")
    residual = result.read("energy/residual").ravel()
    assert abs(residual).max() < 1e-6
    # what friction has taken is the integral of its moment over the angle
    angle, rate = result.read("bodies/angle").ravel(), result.read("bodies/angular_velocity").ravel()
    height = 0.4 * np.sin(angle)
    energy = 0.5 * (inertia + m * length**2) * rate**2 + m * G * height
    assert_close(energy[0] - energy, result.read("energy/dissipated_friction").ravel(), absolute=1e-6, what="lost by friction")
    assert energy[0] - energy[-1] > 0.05


def block(tilt, preload=0.0, speed=1.0, ahead=0.0, above=0.0, slider_length=0.0):
    """A block on a guide that rises with an angle; its centre of mass is behind and above the point that slides."""
    c, s = np.cos(tilt), np.sin(tilt)
    x, y = -ahead * c - above * s, -ahead * s + above * c
    return f"""
[scene]
gravity = 0 -{G} m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[rad] vx[m/s] vy[m/s]
block 4 0.02 {x:.17g} {y:.17g} {tilt:.17g} {speed * c:.17g} {speed * s:.17g}
[points]
name body xi[m] eta[m]
foot ground 0 0
shoe block {ahead:.17g} {-above:.17g}
[joint.translational]
name i j axis axis_angle[rad] friction slider_length[m] preload[N]
way foot shoe x {tilt:.17g} rub {slider_length} {preload}
"""


@pytest.mark.parametrize("preload", [0.0, 12.0])
@pytest.mark.parametrize("speed", [1.0, -1.0])
def test_block_on_inclined_guide(gudgeon, speed, preload):
    """a = -g sin(tilt) -+ c (g cos(tilt) + preload/m) up and down the guide."""
    tilt = 0.4
    result = run(gudgeon, DRY + block(tilt, preload, speed), end="0.1 s")
    friction = COEFFICIENT * (4 * G * np.cos(tilt) + preload)
    a = -G * np.sin(tilt) - np.sign(speed) * friction / 4
    acceleration = result.item("bodies/acceleration", "block")
    along = acceleration[:, 0] * np.cos(tilt) + acceleration[:, 1] * np.sin(tilt)
    assert_close(along, a + 0 * along, absolute=1e-8, what="acceleration")
    assert_close(result.item("joints/friction_force", "way").ravel(), -np.sign(speed) * friction + 0 * along, absolute=1e-8,
                 what="friction force")
    force = result.item("joints/force", "way")  # on the guide
    assert_close(-force[:, 0] * np.sin(tilt) + force[:, 1] * np.cos(tilt), -4 * G * np.cos(tilt) + 0 * along, absolute=1e-8,
                 what="normal force")
    assert abs(result.read("energy/residual")).max() < 1e-9


@pytest.mark.parametrize("speed", [1.0, -1.0])
@pytest.mark.parametrize("settings", WAYS, ids=str)
def test_slider_bears_on_its_ends(gudgeon, settings, speed):
    """Normal force and friction load the ends by their moment: f = 2 c N d/(L +- 2 c h) up and down, an implicit relation."""
    tilt, ahead, above, length = 0.3, 0.3, 0.3, 0.4
    result = run(gudgeon, DRY + block(tilt, 0.0, speed, ahead, above, length), end="0.05 s", **settings)
    normal = 4 * G * np.cos(tilt)
    # about the centre of mass, from which the shoe is d ahead and h below: M = N d - f h going up, N d + f h going down
    friction = 2 * COEFFICIENT * normal * ahead / (length + speed * 2 * COEFFICIENT * above)
    moment = normal * ahead - speed * friction * above
    assert 2 * moment / length > 1.1 * normal  # so one end is lifted, and N alone would give less
    assert_close(result.item("joints/friction_force", "way").ravel(), -speed * friction + 0 * result.time, relative=1e-7,
                 what="friction")
    assert_close(abs(result.item("joints/moment", "way").ravel()), moment + 0 * result.time, relative=1e-7, what="moment")


def test_slider_wedges(gudgeon):
    """Beyond L = 2 c h there is no force of friction going down: the run says which joint wedges, and going up it goes on."""
    result = run(gudgeon, DRY + block(0.0, 0.0, -1.0, 0.3, 0.6, 0.2), end="0.05 s", expect=5)
    assert "friction in 'way' raises its own normal force: the joint jams" in result.done.stderr
    result = run(gudgeon, DRY + block(0.0, 0.0, 1.0, 0.3, 0.6, 0.2), end="0.05 s")
    friction = 2 * COEFFICIENT * 4 * G * 0.3 / (0.2 + 2 * COEFFICIENT * 0.6)
    assert_close(result.item("joints/friction_force", "way").ravel(), -friction + 0 * result.time, relative=1e-7, what="friction")


def test_block_holds_by_bristles(gudgeon):
    """Below the angle of friction a block with bristles rests, all but for their deflection; without any it would slide 0.7 m."""
    tilt = 0.15
    for name in ("dahl", "lugre"):
        result = run(gudgeon, law(name) + block(tilt, 0.0, 0.0), end="1 s", every="20 ms", tolerance="1e-8")
        position = result.item("bodies/position", "block")
        assert np.hypot(*position.T).max() < (5e-4 if name == "dahl" else 1e-4), name
        late = result.time > 0.8
        force = result.item("joints/friction_force", "way").ravel()
        if name == "lugre":
            assert_close(force[late], 4 * G * np.sin(tilt) + 0 * force[late], relative=2e-2, what="force that holds")


@pytest.mark.parametrize("settings", [{}] + [{"method": name} for name in ("verner", "bdf", "radau", "adams")], ids=str)
def test_load_within_the_jump_of_threlfall(gudgeon, settings):
    """A load between 95 % and the full force holds the sliding at the rise that stands for the jump, with few steps: where the line
    1 - 3 (1 - v/v_r) has it. Explicit methods are at their stability limit there, as at rest: the rate of 2 v' is 3 F/v_r."""
    speed, full, part = 1e-3, COEFFICIENT*100.0, 0.98
    result = run(gudgeon, f"""
[friction.threlfall]
name coefficient v_r[m/s] above
rub {COEFFICIENT} {speed} book
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
b 2 0.01 0 0
[points]
name body xi[m] eta[m]
o ground 0 0
p b 0 0
[joint.translational]
name i j axis friction preload[N]
guide o p x rub 100
[force.point]
name point fx fy
pull p {{{part*full} N}} {{0 N}}
""", tolerance="1e-8", limit_cpu="20 s", **settings)
    late = result.time > 0.1
    assert_close(result.read("bodies/velocity")[late, 0, 0], speed*(1.0 - (1.0 - part)/3.0), relative=1e-6, what="speed")
    assert result.summary["steps"] < 2.0*0.2*3.0*full/speed/2.0


def test_driven_disc(gudgeon):
    """A driver gives what friction takes: its power, and its moment in a kinematic analysis too."""
    text = DRY + disc(speed=0.0) + "[driver.speed]\nname joint speed[rad/s]\nmotor pin -15\n"
    moment = COEFFICIENT * 0.02 * (2 * G + 5)
    result = run(gudgeon, text)
    assert_close(result.item("drivers/moment", "motor").ravel(), -moment + 0 * result.time, relative=1e-9, what="driving moment")
    assert_close(result.read("energy/drive_work").ravel(), 15 * moment * result.time, absolute=1e-8, what="work")
    assert_close(result.read("energy/dissipated_friction").ravel(), 15 * moment * result.time, absolute=1e-8, what="lost")
    directory = scratch()
    deck = f"deck = 1\n{text}\n[analysis.kinematic]\nend = 0.1 s\n[output]\nevery = 10 ms\n"
    call(gudgeon, "run", written(directory, deck), "--out", directory / "out", "--quiet")
    result = Run(directory / "out")
    assert_close(result.item("drivers/moment", "motor").ravel(), -moment + 0 * result.time, relative=1e-9, what="kinematic")
    assert_close(result.item("joints/friction_moment", "pin").ravel(), moment + 0 * result.time, relative=1e-9, what="friction")


def test_two_pins_share_a_way(gudgeon):
    """A heavy bar on two driven cranks of a parallelogram: friction of both pins by the work that the driver does."""
    text = DRY + f"""
[scene]
gravity = 0 -{G} m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
crank 0.001 1e-6 0.05 0
bar   6     0.1  0.1  0
[points]
name body xi[m] eta[m]
axle ground 0 0
heel crank -0.05 0
toe crank 0.05 0
end bar 0 0
[joint.revolute]
name i j friction radius[m]
main axle heel rub 0.03
pin toe end rub 0.01
[joint.parallel]
name i j
flat ground bar
[driver.speed]
name joint speed[rad/s]
motor main 8
"""
    result = run(gudgeon, text, end="1 s", every="10 ms")
    assert abs(result.read("energy/residual")).max() < 1e-7

    def reaction(t, mass, crank):
        """Force of a pin that carries a mass on the circle of the crank, and the crank's own mass at half of it."""
        n = 8.0**2 * (0.1 * mass + 0.05 * crank)
        return np.hypot(-n * np.cos(8 * t), -n * np.sin(8 * t) + (mass + crank) * G)

    lost = COEFFICIENT * 8 * (0.03 * quad(lambda t: reaction(t, 6.0, 0.001), 0, 1, epsabs=1e-12)[0]
                              + 0.01 * quad(lambda t: reaction(t, 6.0, 0.0), 0, 1, epsabs=1e-12)[0])
    assert_close(result.read("energy/dissipated_friction").ravel()[-1], lost, relative=1e-7, what="lost by friction")


@pytest.mark.parametrize("settings", [{}, {"method": "bdf"}, {"method": "ida"}, {"solver": "sparse"}], ids=str)
def test_with_a_contact_that_sticks(gudgeon, settings):
    """A full disc rolls on a cart that friction in its guide brakes: a_cart = -c (M + m) g/(M + m/3), a_disc = a_cart/3."""
    weight, stiffness = 3 * G, 1e8
    text = DRY + f"""
[scene]
gravity = 0 -{G} m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] vx[m/s]
cart 2 0.1 0 0 1
disc 3 {0.5 * 3 * 0.2**2} 0 {0.2 - weight / stiffness:.17g} 1
[points]
name body xi[m] eta[m]
rail ground 0 0
shoe cart 0 0
top cart 0 0
centre disc 0 0
[joint.translational]
name i j axis friction
way rail shoe x rub
[material]
name young[GPa] poisson
steel 207 0.3
[clearance.plane]
name plane ball axis radius[m] material law friction
roll top centre y 0.2 steel spring grip
[contact.kelvin_voigt]
name stiffness[N/m] restitution
spring {stiffness} 1
[friction.coulomb]
name coefficient
grip 0.5
"""
    result = run(gudgeon, text, end="0.1 s", start="given", overlap="preload", **settings)
    cart = -COEFFICIENT * 5 * G / (2 + 3 / 3)
    time = result.time
    assert_close(result.item("bodies/velocity", "cart")[:, 0], 1 + cart * time, absolute=1e-6, what="cart")
    assert_close(result.item("bodies/velocity", "disc")[:, 0], 1 + cart / 3 * time, absolute=1e-6, what="disc")
    assert_close(result.item("bodies/angular_velocity", "disc").ravel(), (cart - cart / 3) * time / 0.2, absolute=1e-5, what="turn")
    assert abs(result.read("energy/residual")).max() < 1e-6


@pytest.mark.parametrize("change, words", [
    ((DRY, "[friction.coulomb]\nname coefficient\nrub 0.2\n"), ["needs stick-slip events", "friction.lugre"]),
    (("rub 0.02", "rub 0"), ["has friction but no radius", "give the radius of the pin"]),
    (("hub rub", "hub rob"), ["unknown friction 'rob'", "did you mean 'rub'"]),
], ids=["sticks", "radius", "name"])
def test_mistakes(gudgeon, change, words):
    """What a joint cannot rub by is said, with its place."""
    result = run(gudgeon, (DRY + disc()).replace(*change), expect=3)
    for word in words:
        assert word in result.done.stderr, result.done.stderr
    assert "scene.deck:" in result.done.stderr
