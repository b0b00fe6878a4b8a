"""The reader of the Python package, gudgeon.reader, against run.h5 as h5py shows it, and the dimensions that other readers look up."""

import csv
import io
import subprocess
import sys

import h5py
import numpy as np
import pytest
from support import call, finished, scratch, written

SPACE = """deck = 1
[scene]
title = "A ball thrown in space, beside a body at rest"
space = spatial
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2] vx[m/s] wz[rad/s]
ball 1 1 1 1 3 2
stone 1 1 1 1 0 0
[analysis.dynamic]
start = given
end = 1 s
[output]
every = 0.25 s
channels = ball.position ball.orientation stone.velocity
"""


@pytest.fixture
def reader(root, monkeypatch):
    monkeypatch.syspath_prepend(str(root / "scripts/python"))
    from gudgeon import reader

    return reader


def test_channels_are_those_of_the_file(gudgeon, reader):
    made = finished(gudgeon)
    instants, rows = reader.read(made.directory), reader.read(made.directory / "run.h5", rows="all")
    with h5py.File(made.directory / "run.h5") as file:
        kinds = file["row_kind"][:]
        np.testing.assert_array_equal(rows["row_kind"], kinds)
        np.testing.assert_array_equal(rows["slider.velocity.x"], file["bodies/velocity"][:, 0, 0])
        np.testing.assert_array_equal(instants["slider.velocity.x"], file["bodies/velocity"][:, 0, 0][kinds == 0])
        np.testing.assert_array_equal(rows["gudgeon.normal_force"], file["clearances/contacts/normal_force"][:, 0])
        assert instants.events.tobytes() == file["events"][:].tobytes()
        assert instants.summary["samples"] == len(instants["time"]) == (kinds == 0).sum()
    assert instants.units["slider.velocity.x"] == "m/s" and instants.attributes["status"] == "complete"


def test_vectors_and_parameters_of_space(gudgeon, reader):
    directory = scratch()
    call(gudgeon, "run", written(directory, SPACE), "--out", directory / "out", "--quiet")
    run = reader.read(directory / "out")
    np.testing.assert_allclose(run["ball.position.x"], 3 * run["time"], atol=1e-12)
    np.testing.assert_allclose(abs(run["ball.orientation.e3"]), abs(np.sin(run["time"])), atol=1e-5)
    assert "ball.velocity.x" in run and "stone.velocity.z" in run, "a quantity is kept for all items"
    with pytest.raises(KeyError, match="did you mean ball.position.x"):
        run["ball.positon.x"]
    with pytest.raises(KeyError, match="nothing: no such channel"):
        run.peak("nothing")


def test_every_dimension_of_a_history_has_a_name(gudgeon):
    directory = scratch()
    call(gudgeon, "run", written(directory, SPACE), "--out", directory / "out", "--quiet")
    for place in (finished(gudgeon).directory, directory / "out"):
        with h5py.File(place / "run.h5") as file:
            found = {}

            def look(path, node):
                if "DIMENSION_LIST" in getattr(node, "attrs", {}):
                    found[path] = [[scale.name for scale in dimension.values()] for dimension in node.dims]
                    assert [len(names) for names in found[path]] == [1] * node.ndim, path
                    for dimension in node.dims:
                        assert dimension[0].shape[0] == node.shape[list(node.dims).index(dimension)], path

            file.visititems(look)
            wanted = [["/time"], ["/bodies/names"], ["/component"]]
            assert found["bodies/velocity"] == wanted and found["row_kind"] == [["/time"]]
            uses = {(file[use["dataset"]].name, use["dimension"]) for use in file["component"].attrs["REFERENCE_LIST"]}
            assert ("/bodies/velocity", 2) in uses


def test_as_a_program(gudgeon, root):
    made = finished(gudgeon)
    script = root / "scripts/gudgeon_reader.py"

    def run(*arguments):
        return subprocess.run([sys.executable, script, *arguments], capture_output=True, text=True, timeout=60)

    listed = run(made.directory)
    assert listed.returncode == 0 and "slider.velocity.x" in listed.stdout and "[m/s]" in listed.stdout
    table = list(csv.reader(io.StringIO(run(made.directory, "slider.velocity", "time").stdout)))
    assert table[0] == ["time [s]", "slider.velocity.x [m/s]", "slider.velocity.y [m/s]"]
    np.testing.assert_array_equal(np.array(table[1:], float)[:, 1], made.item("bodies/velocity", "slider")[:, 0])
    wrong = run(made.directory, "slider.velosity")
    assert wrong.returncode == 1 and "slider.velosity" in wrong.stderr
    assert run(root).returncode == 1
