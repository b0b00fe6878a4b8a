"""Beams, bushings and belts: tips of cantilevers, the 45 degree bend, energy at large rotations, drives, against closed forms and published values."""

import numpy as np
import pytest
from support import Run, assert_close, call, scratch, written

STATIC = "[analysis.static]\n[output]\nchannels = *\n"


def run(gudgeon, text, *options, expect=0):
    """Run a deck given as text."""
    directory = scratch()
    done = call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", *options, expect=expect)
    return Run(directory / "out", done) if expect == 0 else done


def planar_cantilever(n, force, moment=0.0, length=2.0):
    """A chain of n beams along x on n bodies, loaded at the tip; E A, E I, G and the shear ratio of `SECTION`."""
    rows = range(1, n + 1)
    return (
        "deck = 1\n[scene]\ngravity = 0 0 m/s^2\n[bodies]\nname mass[kg] inertia[kg.m^2] x[m]\n"
        + "".join(f"n{k} 1 1 {length * k / n!r}\n" for k in rows)
        + "[points]\nname body\nn0 ground\n"
        + "".join(f"p{k} n{k}\n" for k in rows)
        + "[force.beam]\nname i j modulus[Pa] area[m^2] second_moment[m^4] shear_modulus[Pa] shear_ratio\n"
        + "".join(f"b{k} {'n0' if k == 1 else f'p{k - 1}'} p{k} 2e7 0.01 1e-5 8e6 1.2\n" for k in rows)
        + f"[force.point]\nname point fy[N]\nload p{n} {force}\n[force.torque]\nname body moment[N.m]\nturn n{n} {moment}\n"
        + STATIC
    )


@pytest.mark.parametrize("n", [1, 20])
def test_tip_of_a_planar_cantilever(gudgeon, n):
    """P L^3/(3 E I) + a P L/(G A) + M L^2/(2 E I), and the slope, with one element as with twenty."""
    force, moment, length, bending = 1e-3, 2e-3, 2.0, 200.0
    tip = run(gudgeon, planar_cantilever(n, force, moment))
    deflection = force * length**3 / (3 * bending) + 1.2 * force * length / (8e6 * 0.01) + moment * length**2 / (2 * bending)
    slope = force * length**2 / (2 * bending) + moment * length / bending
    assert_close(tip.item("bodies/position", f"n{n}").ravel()[1], deflection, relative=1e-6, what="deflection")
    assert_close(tip.item("bodies/angle", f"n{n}").ravel()[0], slope, relative=1e-6, what="slope")
    assert_close(tip.item("forces/moment", "b1").ravel()[0], moment + force * length, relative=1e-6, what="moment on the wall")


def test_beam_bent_to_a_circle(gudgeon):
    """A moment 2 pi E I/L bends a cantilever to a full circle: the error of its tip falls with the square of the length of the beams."""
    errors = []
    for n in (10, 20):
        text = planar_cantilever(n, 0.0, 0.0, 1.0)
        radius = 1 / (2 * np.pi) * 4  # a quarter of the circle, so that the search finds it from the straight shape
        text = text.replace(f"turn n{n} 0.0", f"turn n{n} {200.0 / radius!r}")
        tip = run(gudgeon, text)
        angle = 1 / radius
        assert_close(tip.item("bodies/angle", f"n{n}").ravel()[0], angle, relative=1e-9, what="angle of the tip")
        exact = radius * np.array([np.sin(angle), 1 - np.cos(angle)])
        errors.append(np.abs(tip.item("bodies/position", f"n{n}").ravel()[:2] - exact).max())
    assert errors[0] < 2e-3
    assert 3.5 < errors[0] / errors[1] < 4.5, errors


@pytest.mark.parametrize("n", [1, 20])
def test_tip_of_a_spatial_cantilever(gudgeon, n):
    """Bending about both axes of the section, torsion and tension, along a direction across all axes of the world."""
    along = np.array([0.48, 0.6, 0.64])
    y = np.array([0.8, 0.0, -0.6])
    y -= (y @ along) * along
    y /= np.linalg.norm(y)
    z = np.cross(along, y)
    length, e, g, area, i_y, i_z, j = 2.0, 2e7, 8e6, 0.01, 1e-5, 3e-5, 2e-5
    load = 2e-6  # so small that the deflection does not turn the loads
    force = load * (2 * along + y - 3 * z)
    twist = load
    rows = range(1, n + 1)

    def vector(x):
        return '"' + " ".join(repr(float(c)) for c in x) + '"'

    text = (
        "deck = 1\n[scene]\nspace = spatial\ngravity = 0 0 0 m/s^2\n[bodies]\nname mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] z[m]\n"
        + "".join(f"n{k} 1 1 1 1 " + " ".join(repr(float(c)) for c in along * length * k / n) + "\n" for k in rows)
        + "[points]\nname body\nn0 ground\n"
        + "".join(f"p{k} n{k}\n" for k in rows)
        + "[force.beam]\nname i j y_i modulus[Pa] shear_modulus[Pa] area[m^2] second_moment_y[m^4] second_moment_z[m^4] torsion_constant[m^4] shear_ratio_y shear_ratio_z\n"
        + "".join(f"b{k} {'n0' if k == 1 else f'p{k - 1}'} p{k} {vector(y)} {e} {g} {area} {i_y} {i_z} {j} 1.2 1.1\n" for k in rows)
        + f"[force.point]\nname point fx[N] fy[N] fz[N]\nload p{n} " + " ".join(repr(float(c)) for c in force)
        + f"\n[force.torque]\nname body mx[N.m] my[N.m] mz[N.m]\nturn n{n} " + " ".join(repr(float(c)) for c in twist * along) + "\n"
        + STATIC
    )
    tip = run(gudgeon, text)
    u = tip.item("bodies/position", f"n{n}").ravel() - along * length
    flexible_y = length**3 / (3 * e * i_z) + 1.2 * length / (g * area)
    flexible_z = length**3 / (3 * e * i_y) + 1.1 * length / (g * area)
    scale = 3 * load * flexible_z
    assert_close(u @ y, load * flexible_y, absolute=1e-6 * scale, what="deflection along y")
    assert_close(u @ z, -3 * load * flexible_z, absolute=1e-6 * scale, what="deflection along z")
    assert_close(u @ along, 2 * load * length / (e * area), absolute=1e-4 * scale, what="elongation")
    turned = sum(tip.item("forces/rotation", f"b{k}").reshape(-1) for k in rows)
    assert_close(turned[0], twist * length / (g * j), relative=1e-5, what="twist")
    assert_close(tip.item("forces/force", "b1").ravel(), force, absolute=1e-4 * load, what="force on the wall")


BEND = {300: (58.84, 22.33, 40.08), 600: (47.23, 15.79, 53.37)}  # K. J. Bathe, S. Bolourchi, Int. J. Num. Meth. Engng 14 (1979) 961-986


def bend(n, load):
    """A bend of 45 degrees in the plane, radius 100 inch, section 1 x 1 inch, E = 1e7 psi, loaded across it at its end."""
    angles = np.pi / 4 * np.arange(n + 1) / n
    places = np.array([np.sin(angles), 1 - np.cos(angles)]).T * 100
    rows = range(1, n + 1)
    return (
        "deck = 1\n[scene]\nspace = spatial\ngravity = 0 0 0 m/s^2\n[bodies]\nname mass[lb] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[inch] y[inch]\n"
        + "".join(f"n{k} 1 1 1 1 {places[k][0]!r} {places[k][1]!r}\n" for k in rows).replace("np.float64(", "").replace(")", "")
        + "[points]\nname body\nn0 ground\n"
        + "".join(f"p{k} n{k}\n" for k in rows)
        + "[force.beam]\nname i j y_i modulus[psi] shear_modulus[psi] area[inch^2] second_moment_y[inch^4] second_moment_z[inch^4] torsion_constant[inch^4]\n"
        + "".join(f'b{k} {"n0" if k == 1 else f"p{k - 1}"} p{k} "-1 1 0" 1e7 5e6 1 {1 / 12!r} {1 / 12!r} 0.1406\n' for k in rows)
        + f"[force.point]\nname point fz[lbf]\nload p{n} {load}\n" + STATIC
    )


@pytest.mark.parametrize("load", [300, 600])
def test_bend_of_45_degrees(gudgeon, load):
    """Eight beams within 1 % of the published displacement of the tip; the steps between meshes fall with the square of their length."""
    tips = [run(gudgeon, bend(n, load)).item("bodies/position", f"n{n}").ravel() / 0.0254 for n in (4, 8, 16)]
    start = 100 * np.array([np.sin(np.pi / 4), 1 - np.cos(np.pi / 4), 0])
    away = np.linalg.norm(np.array(BEND[load]) - start)
    assert np.abs(tips[1] - BEND[load]).max() < 0.01 * away, tips[1]
    ratio = np.linalg.norm(tips[1] - tips[0]) / np.linalg.norm(tips[2] - tips[1])
    assert 3.3 < ratio < 4.8, ratio


BUSHING = """deck = 1
[scene]
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] wx[rad/s] wy[rad/s] wz[rad/s] vy[m/s]
arm 1 0.02 0.03 0.04 0.1 SPIN 0.3
[points]
name body xi[m] eta[m]
wall ground 0 0
eye arm -0.1 0
[force.bushing]
name i j stiffness_x[N/m] stiffness_y[N/m] stiffness_z[N/m] angular_stiffness_x[N.m/rad] angular_stiffness_y[N.m/rad] angular_stiffness_z[N.m/rad] damping_time preload_x[N] preload_moment_z[N.m] coupling cross_coupling
rubber wall eye 900 700 800 0.3 0.4 0.5 DAMPING 0.6 0.05 "100 0 50 N/m" "2 0 0 0 1 0 0 0 1 N/rad"
[analysis.dynamic]
end = 3 s
tolerance = 1e-10
[output]
every = 5 ms
channels = *
"""


@pytest.mark.parametrize("damping", ["0 s", "20 ms"])
def test_energy_of_a_bushing_at_large_rotations(gudgeon, damping):
    """A coupled, preloaded bushing turns far about several axes: the ledger closes, with and without damping."""
    result = run(gudgeon, BUSHING.replace("SPIN", "5 -6 4").replace("DAMPING", damping.replace(" ", "")))
    far = np.linalg.norm(result.item("forces/rotation", "rubber"), axis=1).max()
    assert far > 1.0, far
    elastic = result.read("energy/elastic")
    assert np.ptp(elastic) > 0.1
    assert np.abs(result.read("energy/residual")).max() < 1e-8
    lost = result.read("energy/dissipated_damper")
    assert (lost[-1] > 0.1) == (damping != "0 s")


def test_half_a_turn_of_a_bushing_stops_the_run(gudgeon):
    done = run(gudgeon, BUSHING.replace("SPIN", "0 0 40").replace("DAMPING", "0s"), expect=5)
    assert "force element 'rubber' has turned by more than half a revolution" in done.stderr


DRIVE = """deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
motor 1 0.02 0 0
fan 3 0.3 0.5 0.1
[points]
name body xi[m] eta[m]
m0 ground 0 0
f0 ground 0.5 0.1
m motor 0 0
f fan 0 0
[joint.revolute]
name i j
sm m0 m
sf f0 f
[joint.belt]
name i j radius_i[mm] radius_j[mm] belt
belt m f RADII
[force.torque]
name body moment[N.m]
drive motor 3
load fan -0.5
[analysis.dynamic]
start = given
end = 1 s
tolerance = 1e-11
[output]
every = 10 ms
channels = *
"""


@pytest.mark.parametrize("space", ["plane", "space"])
@pytest.mark.parametrize("radii,sign", [("50 150 open", 1), ("50 150 crossed", -1), ("80 80 open", 1), ("80 80 crossed", -1)])
def test_belt_drive(gudgeon, radii, sign, space):
    """Angles, pull and power in closed form: open and crossed, of equal radii too, where the line of centres drops out of the row."""
    text = DRIVE.replace("RADII", radii)
    if space == "space":
        text = text.replace("gravity = 0 0 m/s^2", "space = spatial\ngravity = 0 0 0 m/s^2")
        text = text.replace("inertia[kg.m^2]", "ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]").replace("1 0.02", "1 0.02 0.02 0.02").replace("3 0.3 ", "3 0.3 0.3 0.3 ")
        text = text.replace("moment[N.m]", "mz[N.m]")
    result = run(gudgeon, text)
    r = [float(x) / 1000 for x in radii.split()[:2]]
    ratio = sign * r[0] / r[1]
    alpha = (3.0 - 0.5 * ratio) / (0.02 + 0.3 * ratio**2)
    t = result.read("time")
    if space == "space":
        angle, far = (np.unwrap(result.item("joints/angle", name).ravel()) for name in ("sm", "sf"))
    else:
        angle, far = (result.item("bodies/angle", name).ravel() for name in ("motor", "fan"))
    assert_close(angle, 0.5 * alpha * t**2, absolute=1e-9, what="angle of the motor")
    assert_close(far, ratio * angle, absolute=1e-12 * max(1, angle.max()), what="angle of the fan")
    pull = (0.02 * alpha - 3.0) / r[0]
    assert_close(result.item("joints/pull", "belt").ravel(), pull + 0 * t, absolute=1e-10, what="pull")
    assert np.abs(result.read("energy/residual")).max() < 1e-9


def test_belt_on_a_carrier_that_turns(gudgeon):
    """Pulleys of a turning carrier: R_i (w_i - w_c) = R_j (w_j - w_c), over more than a turn of the line of centres."""
    text = """deck = 1
[scene]
gravity = 0 0 m/s^2
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
carrier 1 0.1 0 0
fan 1 0.05 0.5 0
[points]
name body xi[m]
o ground 0
c carrier 0
far carrier 0.5
f fan 0
[joint.revolute]
name i j
post o c
shaft far f
[driver.speed]
name joint speed[rad/s]
turn post 9
[joint.belt]
name i j radius_i[mm] radius_j[mm]
belt o f 60 40
[analysis.dynamic]
end = 2 s
tolerance = 1e-10
[output]
every = 10 ms
channels = *
"""
    result = run(gudgeon, text)
    t = result.read("time")
    assert_close(result.item("bodies/angle", "fan").ravel(), 9 * (1 - 60 / 40) * t, absolute=1e-9, what="angle of the fan")
