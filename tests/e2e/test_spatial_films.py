"""Films in space: the lubricated slider-crank beside its planar run, tilted films and balls against Reynolds' equation."""

import re

import numpy as np
import pytest
from scipy.sparse import lil_matrix
from scipy.sparse.linalg import spsolve
from support import ROOT, Run, call, scratch, written

RADIUS, CLEARANCE, VISCOSITY = 9.9e-3, 0.1e-3, 0.05  # of the pin or ball [m], [m], [Pa.s]


def run(program, text, *options):
    """A run without figures and tables."""
    directory = scratch()
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet", "--write", "channels", *options)
    return Run(directory / "out")


def in_space(text):
    """The planar slider-crank as a deck of space."""
    text = text.replace("space    = planar", "space    = spatial").replace("0 0 m/s^2", "0 0 0 m/s^2")
    text = re.sub(r"^(name +mass\[kg\]).*$", r"\1 ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[mm]", text, flags=re.M)
    text = re.sub(r"^(crank|rod|slider) +(\S+) +(\S+e-4) +(\S+) +0 +0$", r"\1 \2 \3 \3 \3 \4", text, flags=re.M)
    return re.sub(r"name +i +j +axis\nguide +main +pin +x", 'name i j axis_i\nguide main pin "1 0 0"', text)


@pytest.mark.parametrize("film, level", [("pinkus_sternlicht", "lubricated"), ("finite", "lubricated"), ("squeeze", "hybrid")])
def test_slider_crank_in_space(gudgeon, film, level):
    """Half a turn of the slider-crank of section 5.7 in space and in the plane."""
    text = (ROOT / "inputs/slider_crank_lubricated.deck").read_text()
    text = re.sub(r"^figures.*$", "", text.replace("20 us", "100 us").replace("{turns} turns of motor", "6 ms"), flags=re.M)
    runs = [run(gudgeon, deck, "--set", f"film={film}", "--set", f"level={level}", "--tolerance", "1e-10") for deck in (text, in_space(text))]
    for name in ("eccentricity", "force", "film_thickness", "film_power", "side_flow", "drag_journal", "drag_bearing"):
        plane, space = (one.item(f"clearances/{name}", "gudgeon") for one in runs)
        plane, space = (values.reshape(len(values), -1) for values in (plane, space))
        n = plane.shape[1]
        scale = abs(plane).max()
        assert abs(space[:, :n] - plane).max() < 3e-6 * scale, name
        assert not n < space.shape[1] or abs(space[:, n:]).max() < 1e-9 * scale, name


PIN = """deck = 1
[scene]
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] x[m] y[m] vx vy wx wy wz {turn_heads}
shaft 1 1e-3 1e-3 1e-3 {x} {y} {vx} {vy} {wx} {wy} {wz} {turn}
[points]
name body
hole ground
pin shaft
[lubricant]
name viscosity
oil {viscosity}Pa.s
{joint}
[analysis.dynamic]
start = given
end = 1 ns
[output]
every = 1 ns
"""


def bushing(film, length):
    """A joint with a pin longer than its bushing."""
    return (f"[film.{film}]\n" + ("name boundary resolution\nwet " + "{boundary} fine\n" if film == "grid" else "name\nwet\n")
            + "[clearance.revolute]\nname bearing journal axis_j bearing_radius[m] clearance[m] length[m] journal_length[m] "
            + "level film lubricant\n"
            + f'joint hole pin "0 0 1" {RADIUS + CLEARANCE} {CLEARANCE} {length} {2 * length} lubricated wet oil\n')


def film_of(program, joint, e, v, tilt=(0.0, 0.0), turning=(0.0, 0.0, 0.0)):
    """Force and moment of the film at the start: eccentricity over c, velocity, tilt as a rotation vector, angular velocity."""
    angle = np.hypot(*tilt)
    heads, turn = ("axis angle[rad]", f'"{tilt[0]} {tilt[1]} 0" {angle}') if angle > 0 else ("", "")
    speeds = {f"w{name}": f"{rate}rad/s" for name, rate in zip("xyz", turning)}
    text = PIN.format(x=e[0] * CLEARANCE, y=e[1] * CLEARANCE, vx=f"{v[0]}m/s", vy=f"{v[1]}m/s", turn_heads=heads, turn=turn,
                      joint=joint, viscosity=VISCOSITY, **speeds)
    got = run(program, text)
    names = ("film_force", "film_moment")[: 1 + ("clearance.revolute" in joint)]
    return [got.item(f"clearances/{name}", "joint")[0] for name in names]


def reynolds(length, e, v, g, w, positive, n=180, m=64):
    """Force, first moment and least gap of a tilted journal: central differences at nodes, an active set for p >= 0."""
    theta = np.arange(n) * 2 * np.pi / n
    y = np.linspace(-1, 1, m + 1)
    dt, dz = theta[1] * RADIUS, y[1] * length / 2 - y[0] * length / 2
    u = np.array([np.cos(theta), np.sin(theta)])

    def ends(s, t):
        return CLEARANCE - np.outer(np.ones_like(s), np.array(e) @ t) * CLEARANCE - np.outer(s, np.array(g) @ t)

    h = ends(y, u)
    h_t = ends(y, np.array([np.cos(theta + theta[1] / 2), np.sin(theta + theta[1] / 2)])) ** 3
    h_z = ends((y[1:] + y[:-1]) / 2, u) ** 3
    source = -12 * VISCOSITY * (np.outer(np.ones(m + 1), np.array(v) @ u) + np.outer(y, np.array(w) @ u))
    number = np.arange((m - 1) * n).reshape(m - 1, n)
    matrix, right = lil_matrix((number.size, number.size)), source[1:-1].ravel()
    for j in range(1, m):
        for k in range(n):
            row = number[j - 1, k]
            for other, g_ in ((number[j - 1, (k + 1) % n], h_t[j, k] / dt**2), (number[j - 1, k - 1], h_t[j, k - 1] / dt**2)):
                matrix[row, row] -= g_
                matrix[row, other] += g_
            for jj, g_ in ((j + 1, h_z[j, k] / dz**2), (j - 1, h_z[j - 1, k] / dz**2)):
                matrix[row, row] -= g_
                if 0 < jj < m:
                    matrix[row, number[jj - 1, k]] += g_
    matrix = matrix.tocsr()
    p = spsolve(matrix.tocsc(), right)
    wet = p > 0
    for _ in range(60 * positive):
        p = np.zeros(number.size)
        p[wet] = spsolve(matrix[wet][:, wet].tocsc(), right[wet])
        scale = abs(matrix.diagonal())
        new = (p - (right - matrix @ p) / scale * wet.__invert__()) > 0
        if np.all(new == wet):
            break
        wet = new
    p = p.reshape(m - 1, n)
    area = dt * dz
    return [-area * np.array([(p * u[i]).sum() for i in (0, 1)]),
            -area * np.array([(p * u[i] * y[1:-1, None]).sum() for i in (0, 1)]) * length / 2, h.min()]


TILTED = [(0.01, (0.5, 0.1), (2e-3, -1e-3), (4.0, 6.0), (0.0, 0.0, 0.0)),
          (0.02, (0.3, -0.4), (3e-3, 1e-3), (-2.0, 2.5), (0.4, -0.3, 30.0)),
          (0.02, (0.1, 0.0), (0.0, 0.0), (5.0, -4.0), (0.0, 0.0, 40.0))]


@pytest.mark.parametrize("boundary", ["full", "reynolds"])
@pytest.mark.parametrize("length, e, v, tilt, turning", TILTED)
def test_tilted_grid(gudgeon, boundary, length, e, v, tilt, turning):
    """Force and couple of film.grid with a pin that lies askew, turns and tips over; tilts in mrad."""
    tilt = np.array(tilt) * 1e-3
    force, moment = film_of(gudgeon, bushing("grid", length).format(boundary=boundary), e, v, tilt, turning)
    angle = np.hypot(*tilt)
    axis = np.array([tilt[1], -tilt[0]]) / angle * np.tan(angle)  # slope of the pin
    pin = np.array([axis[0], axis[1], 1.0])
    turning = np.array(turning)

    def spin(x):
        return np.array([-x[1], x[0]]) * turning[2] / 2

    g = axis * length / 2
    e_m = np.array(e) * CLEARANCE
    of_tilt = np.cross(turning, pin)
    g_dot = (of_tilt[:2] - np.cross(turning, [*axis, 0])[2] * axis / 2) * length / 2
    expected, first, least = reynolds(length, e, np.array(v) - spin(e_m), g, g_dot - spin(g), boundary == "reynolds")
    assert least > 0.05 * CLEARANCE
    assert np.linalg.norm(force[:2] - expected) < 5e-3 * np.linalg.norm(expected)
    couple = np.cross([0, 0, 1.0], [*first, 0])[:2]
    assert np.linalg.norm(moment[:2] - couple) < 1e-2 * np.linalg.norm(couple)


@pytest.mark.parametrize("film, limit", [("finite", 0.25), ("short_exact", 0.25)])
def test_aligned_halves(gudgeon, film, limit):
    """Films of aligned journals, tilted by a quarter of the gap: force within 4 %, couple within a quarter."""
    length = 0.005 if film == "finite" else 0.002
    e, v, slope = (0.5, 0.0), (2e-3, -1e-3), np.array([0.6, 0.8]) * 0.25 * 0.5 * CLEARANCE / (length / 2)
    angle = np.arctan(np.hypot(*slope))
    tilt = np.array([-slope[1], slope[0]]) / np.hypot(*slope) * angle
    force, moment = film_of(gudgeon, bushing(film, length), e, v, tilt)
    expected, first, _ = reynolds(length, e, v, slope * length / 2, (0.0, 0.0), True)
    assert np.linalg.norm(force[:2] - expected) < 0.04 * np.linalg.norm(expected)
    couple = np.cross([0, 0, 1.0], [*first, 0])[:2]
    assert np.linalg.norm(moment[:2] - couple) < limit * np.linalg.norm(couple)


def sphere(eps, order, n=4000):
    """Pressure over 12 mu R^2 v/c^3 of a ball, order 0 (squeeze) or 1 (across) about the line of centres, by finite volumes."""
    angle = (np.arange(n) + 0.5) * np.pi / n
    edge = np.arange(1, n) * np.pi / n
    step = np.pi / n
    link = np.sin(edge) * (1 - eps * np.cos(edge)) ** 3 / step
    source = np.sin(angle) * (np.cos(angle) if order == 0 else np.sin(angle)) * step
    diagonal = np.zeros(n)
    diagonal[:-1] += link
    diagonal[1:] += link
    diagonal += order * (1 - eps * np.cos(angle)) ** 3 / np.sin(angle) * step
    matrix = lil_matrix((n, n))
    matrix.setdiag(diagonal)
    matrix.setdiag(-link, 1)
    matrix.setdiag(-link, -1)
    if order == 0:  # any pressure may be added: none at the equator
        source -= source.mean()
        matrix[n // 2, :] = 0
        matrix[n // 2, n // 2], matrix[n // 2, n // 2 - 1] = 0.5, 0.5
        source[n // 2] = 0
    return angle, spsolve(matrix.tocsc(), source)


@pytest.mark.parametrize("pressure", ["full", "positive"])
@pytest.mark.parametrize("eps, v, turning", [
    (0.0, (1e-3, 0.0), (0, 0, 0)), (0.6, (2e-3, 0.0), (0, 0, 0)), (0.6, (-1e-3, 0.0), (0, 0, 0)), (0.6, (1e-3, 2e-3), (0, 0, 0)),
    (0.9, (1e-3, 0.0), (0, 0, 60.0))])
def test_ball(gudgeon, pressure, eps, v, turning):
    """Force of film.spherical against pressures of Reynolds' equation on the sphere, by finite volumes of both orders."""
    joint = (f"[film.spherical]\nname pressure\nwet {pressure}\n[clearance.spherical]\n"
             "name bearing journal bearing_radius[m] clearance[m] level film lubricant\n"
             f"joint hole pin {RADIUS + CLEARANCE} {CLEARANCE} lubricated wet oil\n")
    force = film_of(gudgeon, joint, (eps, 0.0), v, turning=turning)[0]
    v_r, v_t = v[0], v[1] - turning[2] / 2 * eps * CLEARANCE
    (angle, p_0), (_, p_1) = sphere(eps, 0), sphere(eps, 1)
    beta = (np.arange(720) + 0.5) * np.pi / 360
    p = 12 * VISCOSITY * RADIUS**2 / CLEARANCE**3 * (v_r * p_0[:, None] + v_t * np.outer(p_1, np.cos(beta)))
    if pressure == "positive":
        p = np.maximum(p, 0)
    area = RADIUS**2 * np.sin(angle)[:, None] * (np.pi / len(angle)) * (np.pi / 360)
    expected = -np.array([(p * area * np.cos(angle)[:, None]).sum(), (p * area * np.outer(np.sin(angle), np.cos(beta))).sum()])
    assert np.linalg.norm(force[:2] - expected) < 1e-4 * np.linalg.norm(expected)


def told(program, film, heads, values):
    """Warnings of a run of a pin whose film of a given kind it lies in anyhow."""
    joint = bushing(film, 0.02).format(boundary="reynolds")
    text = PIN.format(x=0.5 * CLEARANCE, y=0.0, vx="0.01m/s", vy="0m/s", wx="0rad/s", wy="0rad/s", wz="10rad/s", turn_heads=heads, turn=values,
                      joint=joint, viscosity=VISCOSITY)
    return run(program, text).summary["warnings"]


def test_films_beyond_their_validity_say_so(gudgeon):
    """A tilt of 0.02 c of 10 mm at a gap of c/2 is more than aligned halves hold, and film.grid needs no warning; nor does a small tilt. A
    pin that fills a part of its film is told with the part."""
    tilt = 0.5 * CLEARANCE * 0.5 / 0.01  # adds half of the gap left in the middle at the ends
    (words,) = told(gudgeon, "finite", "axis angle[rad]", f'"0 1 0" {tilt}')
    assert "'joint', film 'wet': the tilt changes the film thickness at an end by 0.5 of that in the middle" in words and "film.grid has no such limit" in words
    assert told(gudgeon, "finite", "axis angle[rad]", f'"0 1 0" {0.2 * tilt}') == []
    assert told(gudgeon, "grid", "axis angle[rad]", f'"0 1 0" {tilt}') == []
    (words,) = told(gudgeon, "finite", "z[m]", "0.015")
    assert "'joint': the pin covers only 0.75 of the film length" in words


def test_a_supply_is_where_the_deck_puts_it(gudgeon):
    """Angles of a supply count from `x_i`, the first axis across that of the bushing unless it is given: turned back by 30 degrees, with an
    angle that much larger, the supply is at the same place; the angle alone makes another force."""
    def force(angle, x_i=None):
        joint = bushing("grid", 0.02).replace("{boundary} fine", "reynolds fine fixed 40deg 0.8 5e4Pa " + f"{angle}deg")
        joint = joint.replace("boundary resolution", "boundary resolution supply width length pressure angle")
        if x_i:
            joint = joint.replace("axis_j", "axis_j x_i").replace('"0 0 1"', f'"0 0 1" "{x_i}"')
        return film_of(gudgeon, joint, (0.4, 0.2), (2e-3, 1e-3))[0]

    first = force(50)
    assert np.array_equal(first, force(50, "1 0 0.3"))
    back = np.radians(-30)
    assert np.linalg.norm(force(80, f"{np.cos(back)} {np.sin(back)} 0") - first) < 2e-3 * np.linalg.norm(first)
    assert np.linalg.norm(force(80) - first) > 2e-2 * np.linalg.norm(first)
