"""Joints, springs, dampers and drivers of space against a commercial code, closed forms and independent integrations.

`python3 test_validation.py PROGRAM` prints the table of docs/theory/evidence/validation.md.
"""

import functools
import pathlib
import sys

import numpy as np
import pytest
from published_series import ALSO, AT_END, BETWEEN, SOURCE
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk
from support import ROOT, Run, call, changed, scratch, written

DECKS = ROOT / "tests" / "validation"
G = 9.80665      # m/s^2
J = 0.1 + 4.0    # moment of the bar about an end [kg.m^2]

# its own error in these series, as the closed forms below show: the same pendulum, wrong by 3e-4 at 5 s
COARSE = ("spherical_1", "universal_1", "universal_2", "universal_3")

PLACES = {"joint force": "joints/force", "joint moment": "joints/moment", "spring force": "reactions/force",
          "spring moment": "reactions/moment", "drive force": "reactions/force", "drive moment": "reactions/moment"}


@functools.lru_cache(maxsize=None)
def made(program, name, text=None):
    """The run of a deck of tests/validation, or of a text."""
    directory = scratch()
    deck = written(directory, changed(text or (DECKS / f"{name}.deck").read_text(), "output", figures=None))
    call(program, "run", deck, "--out", directory / "out", "--quiet", "--write", "channels")
    return Run(directory / "out")


def history(run, quantity):
    """A time history (instants, components) by its name here."""
    values = np.squeeze(run.read(PLACES.get(quantity, f"bodies/{quantity}")), axis=1)
    return values.reshape(len(values), -1)


def difference(run, quantity, t, expected):
    """Greatest difference at an instant, relative to the range of the channel."""
    k = int(np.argmin(abs(run.time - t)))
    assert abs(run.time[k] - t) < 1e-9
    values = history(run, quantity)
    value, expected = values[k], np.array(expected)
    if quantity == "orientation" and value @ expected < 0:
        value = -value
    largest = np.max(np.abs(values))
    return np.max(np.abs(value - expected)) / (largest if largest > 1e-9 else 1.0)


def differences(program, name):
    """All of a case: {quantity: greatest relative difference}."""
    run = made(program, name)
    of = {quantity: difference(run, quantity, 5.0, value) for quantity, value in AT_END[name].items()}
    for quantity, instants in BETWEEN.get(name, {}).items():
        of[quantity] = max(of[quantity], *(difference(run, quantity, t, value) for t, value in instants))
    return of


def test_every_deck_has_numbers():
    """No deck without a comparison."""
    assert sorted(AT_END) == sorted(path.stem for path in DECKS.glob("*.deck"))


@pytest.mark.parametrize("name", sorted(AT_END))
def test_published_series(gudgeon, name):
    """Motion and reactions as in the series of the other code."""
    limit = 2e-3 if name in COARSE else 2e-4 if name == "cylindrical_3" else 1e-4
    for quantity, value in differences(gudgeon, name).items():
        assert value < limit, f"{quantity}: {value:.1e} of its range"


def pendulum(t):
    """Angle from the downward vertical of the bar, released level, and its rate: Jacobi's elliptic functions."""
    k2 = 0.5
    rate = np.sqrt(2.0 * G / J)
    sn, cn, dn, _ = ellipj(ellipk(k2) + rate * t, k2)
    return 2 * np.arcsin(np.sqrt(k2) * sn), 2 * np.sqrt(k2) * rate * cn * dn / np.sqrt(1 - k2 * sn * sn)


@pytest.mark.parametrize("name, along", [("revolute_1", 0), ("spherical_1", 0), ("universal_1", 1), ("universal_2", 0),
                                         ("cylindrical_2", 0), ("distance_1", 1)])
def test_pendulum(gudgeon, name, along):
    """The bar swings in a plane: elliptic functions, at every instant, and the reaction from them."""
    run = made(gudgeon, name)
    moment = 4.0 if name == "distance_1" else J
    scale = np.sqrt(J / moment)
    angle, rate = pendulum(run.time * scale)
    rate = rate * scale
    side = np.sign(history(run, "position")[0, along])
    out = side * np.sin(angle)
    place = np.stack([2 * out, -2 * np.cos(angle)], axis=1)
    assert np.max(np.abs(history(run, "position")[:, [along, 2]] - place)) < 1e-9
    bend = -2.0 * G / moment * np.sin(angle)   # second derivative of the angle
    pull = np.stack([2 * side * (bend * np.cos(angle) - rate**2 * np.sin(angle)),
                     G + 2 * (bend * np.sin(angle) + rate**2 * np.cos(angle))], axis=1)
    assert np.max(np.abs(history(run, "joint force")[:, [along, 2]] + pull)) < 1e-8


def test_damped_oscillator(gudgeon):
    """Spring 1: a mass that falls into a spring and a damper along one line."""
    run = made(gudgeon, "spring_1")
    c, k = 0.5, 10.0
    w = np.sqrt(k - c * c / 4)
    decay = np.exp(-c * run.time / 2)
    z = -G / k * (1 - decay * (np.cos(w * run.time) + c / (2 * w) * np.sin(w * run.time)))
    assert np.max(np.abs(history(run, "position")[:, 2] - z)) < 1e-9


@pytest.mark.parametrize("angle", [30.0, -170.0, 700.0])
def test_torsion_spring(gudgeon, angle):
    """Spring and damper about a tilted pin without weight, wound by turns: a damped oscillation, turns counted."""
    text = (DECKS / "torsion_spring_1.deck").read_text().replace("0 0 -9.80665", "0 0 0")
    text = text.replace("zero ", "zero    free_angle[deg] ").replace("start ", f"start    {angle} ")
    run = made(gudgeon, "torsion_spring_1", text)
    c, k = 10.0 / J, 200.0 / J
    w = np.sqrt(k - c * c / 4)
    goal = np.radians(angle)
    expected = goal * (1 - np.exp(-c * run.time / 2) * (np.cos(w * run.time) + c / (2 * w) * np.sin(w * run.time)))
    assert np.max(np.abs(history(run, "position")[:, 0] - 2 * np.cos(expected))) < 1e-9 * max(1, goal)
    assert np.max(np.abs(run.item("forces/angle", "coil") - expected)) < 1e-9 * abs(goal)


def turn(axis, angle):
    """Matrix of a turn about a unit axis."""
    x = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * x + (1 - np.cos(angle)) * x @ x


def test_universal_by_two_angles(gudgeon):
    """Universal 3 from its two angles alone, integrated elsewhere: where the other code differs, this is right."""
    a = np.array([0.5, -0.5, np.sqrt(0.5)])          # arm in the ground
    b = np.array([-0.5, 0.5, np.sqrt(0.5)])          # arm in the bar, at the start: eta of the deck's zxz turns
    centre = np.array([np.sqrt(2), np.sqrt(2), 0])
    along = centre / 2
    tensor = 0.1 * np.eye(3) - 0.06 * np.outer(along, along) + 4 * (np.eye(3) - np.outer(along, along))

    def slope(_, q):
        first = turn(a, q[0])
        rot = first @ turn(b, q[1])
        arms = np.stack([a, first @ b], axis=1)
        omega = arms @ q[2:]
        inertia = rot @ tensor @ rot.T
        bend = np.cross(a * q[2], arms[:, 1]) * q[3]
        torque = np.cross(rot @ centre, [0, 0, -G]) - np.cross(omega, inertia @ omega) - inertia @ bend
        return np.concatenate([q[2:], np.linalg.solve(arms.T @ inertia @ arms, arms.T @ torque)])

    run = made(gudgeon, "universal_3")
    found = solve_ivp(slope, (0, 5), np.zeros(4), method="DOP853", rtol=1e-12, atol=1e-13, t_eval=run.time)
    place = np.array([turn(a, q[0]) @ turn(b, q[1]) @ centre for q in found.y.T])
    assert np.max(np.abs(history(run, "position") - place)) < 1e-8


def test_reaction_along_the_joint(gudgeon):
    """The same reaction along the axes of the joint: of a tilted pin the part along it, and the moments across it."""
    run = made(gudgeon, "revolute_2")
    z = np.array([0, 1, 1]) / np.sqrt(2)
    for quantity in ("force", "moment"):
        world, own = run.item(f"joints/{quantity}", "pin"), run.item(f"joints/joint_{quantity}", "pin")
        assert np.max(np.abs(own[:, 2] - world @ z)) < 1e-10
        assert np.max(np.abs(np.linalg.norm(own, axis=1) - np.linalg.norm(world, axis=1))) < 1e-10
    assert np.max(np.abs(run.item("joints/joint_force", "pin")[:, 2] + G / np.sqrt(2))) < 1e-10
    assert np.max(np.abs(run.item("joints/joint_moment", "pin")[:, 2])) < 1e-10


def shown(value):
    """A difference in the table: below the last printed digit nothing is left."""
    return "0" if value < 1e-9 else f"{value:.0e}".replace("e-0", "e-")


def main():
    """The table of docs/theory/evidence/validation.md."""
    columns = ["position", "velocity", "acceleration", "orientation", "angular_velocity", "angular_acceleration", "force", "moment"]
    n = 0
    print("| deck | series | position | velocity | acceleration | Euler parameters | angular velocity | angular acceleration | force | moment |")
    print("|---"*10 + "|")
    for name in AT_END:
        kind, case = name.rsplit("_", 1)
        cells = {}
        for quantity, value in differences(pathlib.Path(sys.argv[1]), name).items():
            who, what = (quantity.split(" ") + [None])[:2]
            words = shown(value) + (f" ({who})" if what and who != "joint" else "")
            key = what or who
            cells[key] = f"{cells[key]}, {words}" if key in cells else words
            n += 2 if name in ALSO else 1
        series = [f"{SOURCE[kind]}0{case}", *([ALSO[name]] if name in ALSO else [])]
        print("| " + " | ".join([name, ", ".join(path.split("/")[1] for path in series), *(cells[key] for key in columns)]) + " |")
    print(f"\n{n} series")


if __name__ == "__main__":
    main()
