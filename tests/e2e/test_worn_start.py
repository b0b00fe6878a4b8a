"""Surfaces that are worn at the start, and what a run writes of worn surfaces: closed forms, conservation, files, figure, messages."""

import collections
import functools
import json
import math
import re

import h5py
import numpy as np
import pytest
from support import assert_close, call, changed, scratch, written
from test_wear import LENGTH, LOAD, RADIUS, SHAFT, shaft

DEPTH, GROOVE = 1e-4, 9.8e-3
ARC = """
[worn.arc]
name     joint     surface   radius[mm]   depth[m]   direction[deg]
groove   bearing   bearing   9.8          {depth}    -90
"""


def volume_of_arc(depth):
    """Of a circle worn into the bush: areas of two segments."""
    d = RADIUS - GROOVE + depth
    a = math.acos((RADIUS**2 - GROOVE**2 - d**2) / (2 * GROOVE * d))
    b = math.atan2(GROOVE * math.sin(a), d + GROOVE * math.cos(a))
    return LENGTH * (GROOVE**2 * (a - math.sin(a) * math.cos(a)) - RADIUS**2 * (b - math.sin(b) * math.cos(b)))


def deck(tables="", end="0.02 s", cells=360, depth=0.0):
    """The shaft in its bush with tables of given wear, as deep in the bush as it is worn."""
    text = shaft("cells", str(cells)).replace("-0.501", f"{-0.501 - 1e3 * depth}")
    return changed(changed(text + tables, "analysis.dynamic", end=end), "output", every="0 s")


def cells_of(directory, side, group="wear_profiles"):
    """What the cells of a surface have lost."""
    with h5py.File(directory / "run.h5") as file:
        profiles = file[group]
        return profiles["volume"][()][profiles["surface"][()] == side.encode()]


def run(program, text, name="out", directory=None, *options):
    """The directory of a run."""
    directory = directory or scratch()
    call(program, "run", written(directory, text), "--out", directory / name, "--quiet", *options)
    return directory / name


@functools.cache
def run_of_groove(program):
    """A run from a worn bush, with all that it writes of wear."""
    text = changed(deck(ARC.replace("{depth}", str(DEPTH)), depth=DEPTH), "output", figures="wear(bearing)", worn_stl=50)
    text = text.replace("[output]", "[statistics]\nafter = 0.01 s\n[output]")
    return run(program, text, "out", None, "--csv")


@pytest.fixture
def first(gudgeon):
    """Its directory."""
    return run_of_groove(gudgeon)


def test_totals(gudgeon, first):
    """A run ends with what was worn at the start and what it took: no cell loses what it had, the sum is k F s."""
    summary = {row["surface"]: row for row in json.loads((first / "summary.json").read_text())["worn_surfaces"]}
    start = volume_of_arc(DEPTH)
    taken = 1e-15 * LOAD * summary["bearing"]["distance"]
    assert_close(summary["bearing"]["volume"] - start, taken, relative=0.02, what="what the run took of the bush")
    assert_close(summary["journal"]["volume"], 2 * taken, relative=0.02, what="what it took of the shaft")
    assert summary["bearing"]["depth_max"] == pytest.approx(DEPTH, rel=1e-3)
    assert math.degrees(summary["bearing"]["depth_angle"]) == pytest.approx(-90, abs=0.6)
    numbers = json.loads((first / "summary.json").read_text())["statistics"]
    for side in ("bearing", "journal"):
        assert numbers[f"bearing.{side}_worn_volume"] == summary[side]["volume"]
        assert numbers[f"bearing.{side}_worn_depth"] == summary[side]["depth_max"]


def test_goes_on_from_a_run(gudgeon, first):
    """Volumes of an earlier run are the start of the next one, cell by cell; in other cells their sum."""
    table = f"\n[worn.run]\nname   run\nbefore   {first / 'run.h5'}\n"
    for cells in (360, 90, 250):
        second = run(gudgeon, deck(table, "1 us", cells, DEPTH), "second")
        for side in ("bearing", "journal"):
            before, after = cells_of(first, side), cells_of(second, side)
            assert len(after) == cells
            if cells == 360:
                assert (after >= before).all()
            assert_close(after.sum(), before.sum(), relative=2e-4, what=f"{side} in {cells} cells")
            if cells == 90:
                assert_close(after, before.reshape(90, 4).sum(axis=1), absolute=1e-4 * before.sum(), what=side)
    one = run(gudgeon, deck(table.replace("name   run", "name   run   joint   surface").replace("run.h5", "run.h5   bearing   journal"), "1 us"), "one")
    assert cells_of(one, "bearing").sum() < 1e-6 * cells_of(first, "bearing").sum()
    assert_close(cells_of(one, "journal").sum(), cells_of(first, "journal").sum(), relative=2e-2, what="the journal alone")


def test_profile_of_a_file(gudgeon, first):
    """The CSV of a run is a profile of the next one: its volume is kept; deck.echo holds the samples, so that the file is not needed."""
    lines = (first / "bearing.bearing.csv").read_text().splitlines()
    assert lines[0] == "angle[rad],depth[m]" and len(lines) == 361
    table = f"\n[worn.profile]\nname   joint   surface   file\nbefore   bearing   bearing   {first / 'bearing.bearing.csv'}\n"
    second = run(gudgeon, deck(table, "1 us", depth=DEPTH), "second")
    volume = cells_of(second, "bearing")
    assert_close(volume.sum(), cells_of(first, "bearing").sum(), relative=2e-5, what="volume")
    depths = np.array([float(line.split(",")[1]) for line in lines[1:]])
    lost = LENGTH * math.pi / 360 * ((RADIUS + depths) ** 2 - RADIUS**2)
    assert_close(lost, cells_of(first, "bearing"), absolute=1e-12 * lost.sum(), what="depths of the file")
    echo = (second / "deck.echo").read_text()
    assert "bearing.csv" not in echo and "[worn.profile]" in echo
    again = run(gudgeon, echo, "again")
    assert (cells_of(again, "bearing") == volume).all()


def test_swept_depth(gudgeon):
    """A sweep over the depth of a groove: each case has its own, also where only what changed is read again."""
    text = deck(ARC, "1 us", depth=DEPTH).replace("[bodies]", "[parameters]\ndepth = 0.1 mm\n[bodies]")
    text = text.replace("depth[m]   direction", "depth   direction").replace("[output]", "[statistics]\nafter = 0 s\n[sweep]\ndepth = 0.02 0.05 0.1 mm\n[output]")
    out = scratch() / "out"
    call(gudgeon, "sweep", written(scratch(), text), "--out", out, "--quiet")
    rows = (out / "cases.csv").read_text().splitlines()
    column = rows[0].split(",").index("bearing.bearing_worn_volume mean [m^3]")
    volumes = [float(row.split(",")[column]) for row in rows[1:]]
    assert_close(volumes, [volume_of_arc(depth) for depth in (2e-5, 5e-5, 1e-4)], relative=1e-4, what="volumes")


def test_solids(first):
    """Solids are closed, and their volume is that of ring or pin with the magnified depths."""
    for side, sign in (("bearing", 1), ("journal", -1)):
        text = (first / f"bearing.{side}.stl").read_text()
        assert text.splitlines()[0] == f"solid bearing.{side} worn, depths times 50, mm"
        corners = np.array(re.findall(r"vertex (\S+) (\S+) (\S+)", text), float).reshape(-1, 3, 3)
        edges = collections.Counter()
        for triangle in corners:
            for k in range(3):
                edges[tuple(triangle[k]), tuple(triangle[(k + 1) % 3])] += 1
        assert all(n == 1 and edges[b, a] == 1 for (a, b), n in edges.items()), f"{side} is not closed"
        volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
        new = {"bearing": RADIUS, "journal": SHAFT}[side]
        depths = np.sqrt(new**2 + sign * 2 * cells_of(first, side) * 360 / (2 * math.pi * LENGTH)) - new
        radii = 1e3 * (new + 50 * depths)
        radii = (radii + np.roll(radii, 1)) / 2
        area = math.sin(2 * math.pi / 360) / 2 * (radii * np.roll(radii, -1)).sum()
        if side == "bearing":
            area = 360 * math.sin(2 * math.pi / 360) / 2 * (radii.max() + 500 * RADIUS) ** 2 - area
        assert_close(volume, area * 1e3 * LENGTH, relative=1e-7, what=side)
        normals = np.array(re.findall(r"facet normal (\S+) (\S+) (\S+)", text), float)
        crossed = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert (np.einsum("ij,ij->i", normals, crossed) > 0.999 * np.linalg.norm(crossed, axis=1)).all()


def test_figure(first):
    """The figure is there; its table has both depths and the radii as drawn, by the factors of its legend."""
    assert (first / "figures/wear.bearing.png").stat().st_size > 10000
    script = (first / "figures/wear.bearing.gp").read_text()
    blocks = (first / "figures/wear.bearing.dat").read_text().split("\n\n\n")
    assert len(blocks) == 2
    for side, sign, radius, block in (("bearing", 1, RADIUS, blocks[0]), ("journal", -1, SHAFT, blocks[1])):
        rows = np.array([line.split() for line in block.splitlines() if line and not line.startswith("#")], float)
        factor = float(re.search(rf"'{side}, depth × (\S+)'", script)[1])
        assert_close(rows[:, 2], radius + sign * factor * rows[:, 1], relative=1e-12, what=side)
        assert_close([rows[0, 0], rows[-1, 0]], [-math.pi, math.pi], absolute=1e-12, what="angles")
        assert 0.1 * radius < factor * rows[:, 1].max() <= 0.3 * radius


def test_explained_and_resumed(gudgeon):
    """`explain` tells what is worn; a run with a file of an earlier one is the same after an interruption, bit for bit."""
    directory = scratch()
    earlier = run(gudgeon, deck(end="1 ms"), "earlier", directory)
    text = deck("\n[worn.run]\nname   run\nbefore   earlier/run.h5\n", "2 ms")
    told = call(gudgeon, "explain", written(directory, text)).stdout
    volume = 1e9 * cells_of(earlier, "bearing").sum()
    assert float(re.search(r"bearing worn at the start: (\S+) mm\^3", told)[1]) == pytest.approx(volume, rel=1e-5)
    done = call(gudgeon, "run", written(directory, changed(text, "analysis.dynamic", checkpoint="1 ms", method="verner")), "--out", directory / "out", "--verify-restart")
    assert "equal bit for bit" in done.stdout


def test_runs_that_do_not_fit(gudgeon, first):
    """A run without wear, of other joints, or a damaged file is refused with words."""
    directory = scratch()
    text = deck()
    plain = run(gudgeon, text.replace("   dry\n", "   none\n"), "plain", directory)
    broken = directory / "broken.h5"
    bytes_of = bytearray((first / "run.h5").read_bytes())
    bytes_of[len(bytes_of) // 2] ^= 255
    broken.write_bytes(bytes_of)
    cases = [(f"name   run\nbefore   {plain / 'run.h5'}", "it has no worn surfaces"),
             (f"name   run\nbefore   {broken}", "it is corrupt, was changed after it was written"),
             (f"name   run   joint\nbefore   {first / 'run.h5'}   bearng", "did you mean 'bearing'?")]
    for rows, words in cases:
        told = call(gudgeon, "check", written(directory, text + f"\n[worn.run]\n{rows}\n"), expect=3).stderr
        assert words in told, told
    other = text.replace("\nbearing   bush", "\nother   bush")
    other = other.replace("bearing.normal_force", "other.normal_force")
    told = call(gudgeon, "check", written(directory, other + f"\n[worn.run]\nname   run\nbefore   {first / 'run.h5'}\n"), expect=3).stderr
    assert "the earlier run wore 'bearing', which is no joint with clearance of this deck" in told and "joints with clearance: other" in told


def test_figure_needs_a_wear_law(gudgeon):
    """A figure of wear names a joint that wears."""
    text = changed(deck().replace("   dry\n", "   none\n"), "output", figures="wear(bearing)")
    assert "joint 'bearing' has no wear law" in call(gudgeon, "check", written(scratch(), text), expect=3).stderr
    text = changed(deck(), "output", figures="wear(bearng)")
    assert "did you mean 'wear(bearing)'?" in call(gudgeon, "check", written(scratch(), text), expect=3).stderr
