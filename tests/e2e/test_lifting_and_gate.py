"""The decks of the lifting arm and of the gate: kinds that no other deck has, against closed forms."""

import math

import numpy as np
from support import ROOT, Run, assert_close, call, changed, scratch, written


def run_deck(program, name, *options):
    """Run a deck of inputs/ without its figures."""
    directory = scratch()
    deck = written(directory, changed((ROOT / "inputs" / name).read_text(), "output", figures=None))
    return Run(directory / "out", call(program, "run", deck, "--out", directory / "out", "--write", "channels", *options))


def test_lifting_arm(gudgeon):
    """The cylinder follows its polynomial and holds; the arm's angle is that of the triangle hinge, foot, lug. The knuckle's moment is
    that of its spring and damper, and the cylinder's work is what the ledger says."""
    run = run_deck(gudgeon, "lifting_arm.deck", "--tolerance", "1e-11")
    t = run.time
    s = np.minimum(t / 2, 1)
    length = 0.88 + 0.25 * s**3 * (10 - 15 * s + 6 * s**2)
    assert_close(run.item("drivers/displacement", "cylinder"), length, absolute=1e-8, what="cylinder")
    foot = math.hypot(0.4, 0.6)
    opening = np.arccos((foot**2 + 0.7**2 - length**2) / (2 * foot * 0.7))
    angle = math.atan2(-0.6, 0.4) + opening
    assert_close(run.item("bodies/angle", "arm"), angle, absolute=1e-7, what="arm")
    moment = 120 * (run.item("forces/angle", "knuckle") + math.radians(20)) + 20 * run.item("forces/angular_rate", "knuckle")
    assert_close(run.item("forces/moment", "knuckle"), moment, absolute=1e-9, what="knuckle")
    rate = 0.25 * 30 * s**2 * (1 - s) ** 2 / 2
    power = run.item("drivers/force", "cylinder") * rate
    work = np.concatenate([[0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(t))])  # off by h^2
    assert_close(run.read("energy/drive_work"), work, absolute=2e-4 * work.max(), what="work")


def test_gate(gudgeon):
    """The buffer's force is the expression in penetration and rate, and never negative; a strong wind ends the run at a right angle."""
    run = run_deck(gudgeon, "gate.deck")
    assert len(run.contacts) == 3
    delta = run.rows("clearances/contacts/penetration")[:, 0]
    rate = run.rows("clearances/contacts/penetration_rate")[:, 0]
    force = np.maximum(40e3 * delta * (1 + (delta / 0.02) ** 2) + 1500 * rate * delta / 0.02, 0)
    closed = delta > 0
    assert closed.sum() > 20
    assert_close(run.rows("clearances/contacts/normal_force")[closed, 0], force[closed], absolute=1e-6, relative=1e-9, what="buffer")
    blown = run_deck(gudgeon, "gate.deck", "--set", "gust=60N.m")
    assert "gate.angle > 1.5708 rad" in blown.summary["message"]
    assert_close(blown.rows("bodies/angle")[-1], [math.pi / 2], absolute=1e-9)
