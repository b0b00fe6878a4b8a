"""Large scenes: sparse factors from the start on, and nothing that grows faster than the scene."""

import os
import subprocess

import numpy as np
import pytest
from support import Run, call, changed, made, scratch, written

MANY = 300  # bodies: more rows than the dense start takes
G = 9.81


def run_chain(gudgeon, n, *options, **settings):
    """A chain of pendulums, run."""
    directory = scratch()
    text = changed(made("pendulum", n, *options), "analysis.dynamic", **settings)
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    return Run(directory / "out")


def test_long_chain_keeps_its_energy(gudgeon):
    """A chain of 300 released at rest: no energy comes or goes, and its pins hold."""
    summary = run_chain(gudgeon, MANY, "--end", "0.2", tolerance="1e-10").summary
    assert summary["energy_residual_max"] <= 1e-9*summary["energy_max"]
    assert summary["violation_max"] <= 1e-9


def test_long_chain_begins_as_newton_says(gudgeon):
    """Accelerations of 300 rods released from the horizontal: Newton's laws of all rods at once, solved as a full matrix.

    At rest all rods stay where they are along x. With a_k and b_k the accelerations of middle and angle of rod k and s_k the
    force of pin k on it: a_k = s_k - s_{k+1} - g, b_k/12 = -(s_k + s_{k+1})/2, and pin k asks for
    a_{k-1} + b_{k-1}/2 = a_k - b_k/2.
    """
    run = run_chain(gudgeon, MANY, "--end", "1e-6", "--channels", "*.acceleration *.angular_acceleration")
    n, matrix, right = MANY, np.zeros((3*MANY, 3*MANY)), np.zeros(3*MANY)
    for k in range(n):
        a, b, s = k, n + k, 2*n + k
        matrix[k, [a, s]], right[k] = (1, -1), -G
        matrix[n + k, [b, s]] = 1/12, 0.5
        if k + 1 < n:
            matrix[k, s + 1], matrix[n + k, s + 1] = 1, 0.5
        matrix[2*n + k, [a, b]] = 1, -0.5
        if k > 0:
            matrix[2*n + k, [a - 1, b - 1]] = -1, -0.5
    expected = np.linalg.solve(matrix, right)
    bodies = run.group("bodies")
    assert np.max(np.abs(bodies["acceleration"][0, :, 0])) <= 1e-9
    assert np.max(np.abs(bodies["acceleration"][0, :, 1] - expected[:n])) <= 1e-9*G
    assert np.max(np.abs(bodies["angular_acceleration"][0] - expected[n : 2*n])) <= 1e-9*G


def test_what_fades_along_a_chain_ends_at_zero(gudgeon):
    """From pin to pin the released rods turn 2 + sqrt(3) times less: beyond the least normal number, where arithmetic is slow on
    some processors, they do not turn at all."""
    run = run_chain(gudgeon, 700, "--end", "1e-6", "--channels", "*.angular_acceleration")
    turning = np.abs(run.group("bodies")["angular_acceleration"])
    assert np.max(turning) > 1
    assert np.any(turning == 0)
    assert np.min(turning[turning > 0]) >= np.finfo(float).tiny


@pytest.mark.parametrize("solver", ("schur", "sparse"))
def test_chain_moves_as_with_full_matrices(gudgeon, solver):
    """A chain of 60: the same motion from sparse factors as from the full matrix."""
    options = ("--end", "0.2", "--every", "0.02", "--channels", "*.position *.angle", "--solver")
    runs = [run_chain(gudgeon, 60, *options, word, tolerance="1e-11") for word in (solver, "lapack")]
    found, expected = (run.group("bodies") for run in runs)
    for name in ("position", "angle"):
        assert np.max(np.abs(found[name] - expected[name])) <= 1e-9, name


def test_redundant_pins_of_a_long_chain_are_named(gudgeon):
    """Two pins that repeat others are found and named among 300."""
    text = made("pendulum", MANY, "--end", "1e-3", "--channels", "rod_1.position")
    text = text.replace("[analysis.dynamic]", "[joint.revolute]\nname i j\nagain rod_6_b rod_7_a\nonce_more wall rod_1_a\n\n[analysis.dynamic]")
    directory = scratch()
    done = call(gudgeon, "explain", written(directory, text))
    line = next(line for line in done.stdout.splitlines() if "redundant constraints" in line)
    assert f"4 of {2*MANY + 4} rows" in line
    named = line.split("the reactions of")[1].split(" are not unique")[0].replace("'", "").split()
    assert sorted(named) == ["again", "once_more", "pin_1", "pin_7"]


def test_long_chain_that_cannot_close_is_refused(gudgeon):
    """The end of a chain of 300 m pinned 400 m away."""
    text = made("pendulum", MANY, "--channels", "rod_1.position")
    text = text.replace("[analysis.dynamic]", "[points]\nname body xi[m] eta[m]\nfar ground 400 0\n\n[joint.revolute]\nname i j\n"
                        f"anchor rod_{MANY}_b far\n\n[analysis.dynamic]")
    done = call(gudgeon, "check", written(scratch(), text), expect=4)
    assert "the mechanism cannot be assembled" in done.stderr


def test_ten_thousand_bodies_stay_small(gudgeon):
    """Reading, assembling and three steps of 10,000 rods in the memory of a table: full matrices would be gigabytes."""
    directory = scratch()
    deck = written(directory, made("pendulum", 10000, "--end", "0.01", "--every", "0.01", "--ledger", "off"))
    child = subprocess.Popen([str(gudgeon), "run", str(deck), "--quiet", "--out", str(directory / "out")])
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode == 0
    assert used.ru_maxrss <= 600_000, "kB"
    run = Run(directory / "out")
    # all rods are still level but those near the pin: the last one falls freely
    assert abs(run.item("bodies/position", "rod_10000")[-1, 1] + 0.5*G*0.01**2) <= 1e-9
    assert run.summary["violation_max"] <= 1e-9
