"""motion.vtkhdf: what VTKHDF 2.0 prescribes, places against closed forms, runs that are killed, full disks, shapes."""

import os
import re
import resource
import signal
import subprocess

import h5py
import numpy as np
import pytest
from support import ROOT, WrittenRun, call, plain_deck, written

TYPES = ("Vertices", "Lines", "Polygons", "Strips")
DATA = ("velocity", "normal_force", "penetration", "state")
CRANK = """deck = 1
[scene]
title = "a driven crank"
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]  angle[deg]
crank  1         0.1              0.2   0     0
[points]
name  body    xi[m]  eta[m]
main  ground  0      0
heel  crank   -0.2   0
tip   crank   0.3    0
[joint.revolute]
name  i     j
pin   main  heel
[driver.speed]
name   joint  speed
motor  pin    7rad/s
[analysis.dynamic]
end = 1 s
[output]
every = 10 ms
motion = vtkhdf
"""


def run_deck(gudgeon, directory, text, name, *options):
    """Run a deck's text into a directory of that name."""
    call(gudgeon, "run", written(directory, text, f"{name}.deck"), "--out", directory / name, "--quiet", *options)


def with_motion(name):
    """A deck of inputs/ that asks for the file, its bodies drawn by their points."""
    text = (ROOT / "inputs" / name).read_text(encoding="utf-8")
    text = re.sub(r"(?ms)^\[shapes\].*?(?=^\[)", "", text)
    return text.replace("[output]\n", "[output]\nmotion = vtkhdf\n")


def steps_of(path):
    """Times, points and data of every step, read as the format says."""
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        steps = root["Steps"]
        n = len(steps["Values"])
        assert n <= steps.attrs["NSteps"] <= n + 128  # more for a moment: a block's times come last
        n_point = root["NumberOfPoints"][:]
        assert len(n_point) == 1 and not steps["PartOffsets"][:n].any() and (steps["NumberOfParts"][:n] == 1).all()
        at = steps["PointOffsets"][:n]
        rows = root["Points"][:]
        found = {"time": steps["Values"][:n], "Points": np.array([rows[i : i + n_point[0]] for i in at]).reshape(n, n_point[0], 3)}
        for name in DATA:
            at = steps["PointDataOffsets"][name][:n]
            rows = root["PointData"][name][:]
            found[name] = np.array([rows[i : i + n_point[0]] for i in at]).reshape(n, n_point[0], *rows.shape[1:])
        cells = 0
        for kind in TYPES:
            group = root[kind]
            assert group["NumberOfCells"][:] == len(group["Offsets"]) - 1
            assert group["NumberOfConnectivityIds"][:] == len(group["Connectivity"]) == group["Offsets"][-1]
            assert np.all(group["Connectivity"][:] < n_point[0])
            found[kind] = np.split(group["Connectivity"][:], group["Offsets"][1:-1]) if group["NumberOfCells"][0] else []
            cells += group["NumberOfCells"][0]
        assert steps["CellOffsets"].shape[1:] == steps["ConnectivityIdOffsets"].shape[1:] == (4,)
        assert not steps["CellOffsets"][:n].any() and not steps["ConnectivityIdOffsets"][:n].any()
        for name in ("body", "contact"):
            assert len(root["CellData"][name]) == cells and not steps["CellDataOffsets"][name][:n].any()
            found[name] = root["CellData"][name][:]
        assert list(root.attrs["Version"]) == [2, 0] and root.attrs["Type"] == b"PolyData"
        assert file.attrs["filetype"] == "gudgeon motion"
        found["status"] = file.attrs["status"].decode()
        return found


def test_a_driven_crank(gudgeon, tmp_path):
    """Both ends of the crank on their circles, with their velocities, at the times of the output instants."""
    run_deck(gudgeon, tmp_path, CRANK.replace("end = 1 s", "end = 1 s\ntolerance = 1e-10"), "run")
    found = steps_of(tmp_path / "run" / "motion.vtkhdf")
    assert found["status"] == "complete"
    np.testing.assert_allclose(found["time"], np.arange(101) * 0.01, atol=1e-15)
    assert [list(line) for line in found["Lines"]] == [[0, 1]] and list(found["body"]) == [1]
    angle = 7 * found["time"]
    tip = 0.5 * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    np.testing.assert_allclose(found["Points"][:, 0], 0 * tip, atol=1e-10)
    np.testing.assert_allclose(found["Points"][:, 1], tip, atol=1e-9)
    np.testing.assert_allclose(found["velocity"][:, 1], 7 * tip @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]), atol=1e-8)
    assert np.all(found["state"] == -1) and not found["normal_force"].any()


def test_bodies_and_contacts_of_the_slider_crank(gudgeon, tmp_path):
    """Rods have the deck's lengths, the contact has the force of run.h5 and lies on the bearing where it touches."""
    deck = with_motion("slider_crank_dry.deck").replace("end         = 24 ms", "end         = 3 ms")
    run_deck(gudgeon, tmp_path, deck, "run")
    found = steps_of(tmp_path / "run" / "motion.vtkhdf")
    crank, rod = found["Lines"][:2]
    for line, length in ((crank, 0.05), (rod, 0.12)):
        ends = found["Points"][:, line]
        np.testing.assert_allclose(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), length, rtol=1e-12)
    with h5py.File(tmp_path / "run" / "run.h5", "r") as file:
        here = file["row_kind"][:] == 0
        np.testing.assert_array_equal(found["time"], file["time"][:][here])
        np.testing.assert_array_equal(found["normal_force"][:, -1], file["clearances/contacts/normal_force"][:][here, 0])
        np.testing.assert_array_equal(found["penetration"][:, -1], file["clearances/contacts/penetration"][:][here, 0])
        slider = file["bodies/position"][:][here][:, list(file["bodies/names"].asstr()).index("slider")]
    touches = found["state"][:, -1] == 1
    assert touches.sum() > 20 and not touches.all()
    away = np.linalg.norm(found["Points"][:, -1, :2] - slider, axis=1)[touches]
    np.testing.assert_allclose(away, 0.010 + found["penetration"][touches, -1] / 2, rtol=1e-9)


def test_a_pendulum_in_space(gudgeon, tmp_path):
    """A body that turns freely about a fixed axis: its ends go on their circles; boxes, spheres and cylinders have their sizes."""
    deck = """deck = 1
[scene]
space = spatial
[bodies]
name  mass[kg]  ixx[kg.m^2]  iyy[kg.m^2]  izz[kg.m^2]  x[m]  wz[rad/s]
arm   1         0.01         0.02         0.025        0.5   3
[points]
name  body    xi[m]
hole  ground  0
heel  arm     -0.5
tip   arm     0.25
[joint.revolute]
name  i     j     axis_i
pin   hole  heel  "0 0 1"
[shapes]
name   body    shape     points[m]              radius[m]  length[m]  width[m]  height[m]  xi[m]  axis
plate  arm     polygon   "-0.5 0 0 0.25 0 0 0 0.1 0"  -    -          -         -          -      -
block  arm     box       -                      -          0.1        0.2       0.3        0.25   -
ball   arm     sphere    -                      0.05       -          -         -          0.25   -
post   ground  cylinder  -                      0.02       0.4        -         -          -      "0 0 1"
[analysis.dynamic]
end = 1 s
tolerance = 1e-11
[output]
every = 20 ms
motion = vtkhdf
"""
    run_deck(gudgeon, tmp_path, deck, "run")
    found = steps_of(tmp_path / "run" / "motion.vtkhdf")
    angle = 3 * found["time"]
    tip = np.stack([0.75 * np.cos(angle), 0.75 * np.sin(angle), 0 * angle], axis=1)
    np.testing.assert_allclose(found["Points"][:, 1], tip, atol=1e-7)
    np.testing.assert_allclose(np.linalg.norm(found["velocity"][:, 1], axis=1), 2.25, rtol=1e-7)
    corners = found["Points"][:, 3:11]
    np.testing.assert_allclose(np.linalg.norm(corners - tip[:, None], axis=2), np.sqrt(0.05**2 + 0.1**2 + 0.15**2), rtol=1e-6)
    sphere = found["Points"][:, 11 : 11 + 24 * 13]
    np.testing.assert_allclose(np.linalg.norm(sphere - tip[:, None], axis=2), 0.05, rtol=1e-5)
    post = found["Points"][:, 11 + 24 * 13 :]
    np.testing.assert_allclose(np.hypot(post[..., 0], post[..., 1]), 0.02, rtol=1e-12)
    assert np.allclose(abs(post[..., 2]), 0.2) and set(found["body"]) == {0, 1}


def test_a_run_killed_at_any_write(gudgeon, tmp_path):
    """A SIGKILL at any write leaves no file, or one that can be read, with the steps that it says."""
    name = "motion.vtkhdf"
    deck = tmp_path / "scene.deck"
    changes = (("analysis.dynamic", "end", "12 ms"), ("output", "every", "20 us"))
    deck.write_text(plain_deck(changes).replace("[output]\n", "[output]\nmotion = vtkhdf\n"), encoding="utf-8")

    run = WrittenRun(gudgeon, deck, tmp_path, name)
    whole = steps_of(run.whole)
    assert len(whole["time"]) == 601 and run.writes > 100
    lengths = []
    for at, left in run.left_by_kills([*range(1, run.writes - 30, 37), *range(run.writes - 30, run.writes + 1)]):
        try:
            found = steps_of(left)
        except OSError as failure:  # before the first flush there is no file yet
            assert "signature not found" in str(failure) and not lengths, (at, failure)
            continue
        n = len(found["time"])
        lengths.append(n)
        for key in ("time", "Points", *DATA):
            np.testing.assert_array_equal(found[key], whole[key][:n], err_msg=f"{key}, killed at write {at}")
    assert lengths == sorted(lengths) and lengths[0] == 0 and lengths[-1] == 601


@pytest.mark.parametrize("kilobytes", [100, 600, 2000])
def test_a_file_that_may_not_grow(gudgeon, tmp_path, kilobytes):
    """`ulimit -f`: exit code 9 with a message, and the steps that it says can be read."""
    deck = with_motion("slider_crank_dry.deck").replace("channels  ", "figures = gudgeon.orbit\nchannels  ")
    deck = written(tmp_path, "\n".join(line for line in deck.splitlines() if not line.startswith("figures  ")))
    limit = 1024 * kilobytes
    done = subprocess.run(
        [gudgeon, "run", deck, "--out", tmp_path / "run", "--quiet"], capture_output=True, text=True, timeout=60,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
    )
    assert done.returncode == 9, done
    told = re.search(r"motion.vtkhdf.*?saved and readable: (\d+) steps", done.stderr)
    assert told or "run.h5: File too large; nothing was saved" in done.stderr, done.stderr
    if told and int(told.group(1)) > 0:
        assert len(steps_of(tmp_path / "run" / "motion.vtkhdf")["time"]) == int(told.group(1))


def test_no_file_without_the_word(gudgeon, tmp_path):
    """Neither a deck that does not ask for it nor a run for its numbers leaves the file."""
    run_deck(gudgeon, tmp_path, CRANK.replace("motion = vtkhdf", ""), "plain")
    run_deck(gudgeon, tmp_path, CRANK, "numbers", "--write", "channels")
    assert not list(tmp_path.glob("*/motion.vtkhdf"))


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ('a  crank  polygon  "0 0 1 0 mm"  -', "needs at least three corners, two coordinates each"),
        ('a  crank  polygon  "0 0 1 0 1 1 s"  -', "are not lengths"),
        ("a  crank  circle  -  -", "needs a radius"),
        ("a  crank  box  -  -", "needs a length and a width"),
        ("a  krank  circle  -  1", "unknown body 'krank'"),
        ("a  crank  circl  -  1", "circl"),
    ],
)
def test_mistakes_of_shapes(gudgeon, tmp_path, row, message):
    """Each is told with its place."""
    deck = tmp_path / "bad.deck"
    text = CRANK + f"[shapes]\nname  body  shape  points  radius[mm]\n{row}\n"
    deck.write_text(text, encoding="utf-8")
    done = subprocess.run([gudgeon, "check", deck], capture_output=True, text=True, timeout=60)
    assert done.returncode == 3 and message in done.stderr and f"bad.deck:{len(text.splitlines())}:" in done.stderr, done.stderr
