"""docs/reference/output.md against real runs: every object and key documented, everything documented as always there present."""

import fnmatch
import json
import re
import subprocess

import h5py
import numpy as np
import pytest
from support import is_history

DECK = "inputs/slider_crank_dry.deck"
KINDS = {"real": "f8", "int8": "i1", "int32": "i4", "int64": "i8"}
MADE = {}
SCALE_ATTRIBUTES = {"CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST"}


def run(gudgeon, root, directory, *options):
    """Run the first deck into a directory."""
    command = [gudgeon, "run", DECK, "--out", directory, "--quiet", *options]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    return directory


@pytest.fixture
def made(gudgeon, root, tmp_path_factory):
    """The directory of a run of the first deck, made once."""
    if gudgeon not in MADE:
        MADE[gudgeon] = run(gudgeon, root, tmp_path_factory.mktemp("layout") / "run")
    return MADE[gudgeon]


def table(root, heading):
    """Rows of the table under a heading of docs/reference/output.md."""
    text = (root / "docs/reference/output.md").read_text(encoding="utf-8")
    section = re.split(r"^#+ ", text.split(f"# {heading}\n", 1)[1], maxsplit=1, flags=re.M)[0]
    lines = [re.split(r"(?<!\\)\|", line)[1:-1] for line in section.splitlines() if line.startswith("|")]
    rows = [[cell.strip().strip("`") for cell in line] for line in lines]
    assert len(rows) > 2, f"no table under '{heading}'"
    return [dict(zip(rows[0], row)) for row in rows[2:]]


def datasets(file):
    """All datasets by path."""
    found = {}
    file.visititems(lambda name, node: found.update({f"/{name}": node}) if isinstance(node, h5py.Dataset) else None)
    return found


def is_of_type(dtype, word):
    """Whether a type in the file is the documented one."""
    if word == "string":
        return h5py.check_string_dtype(dtype) is not None
    if word == "word":
        return dtype == np.dtype("S8")
    if word == "table":
        return dtype.names is not None
    return dtype == np.dtype(KINDS[word])


def shape_symbols(word):
    """`(n, nb, d)` as a list of symbols."""
    return [] if word == "scalar" else [part.strip() for part in word.strip("()").split(",")]


def test_every_dataset_is_as_documented(made, root):
    rows = table(root, "Datasets")
    sizes = {}
    with h5py.File(made / "run.h5", "r") as file:
        found = datasets(file)
        for path, node in found.items():
            row = next((row for row in rows if fnmatch.fnmatch(path, row["path"])), None)
            assert row, f"{path} is not in docs/reference/output.md"
            assert is_of_type(node.dtype, row["type"]), f"{path}: {node.dtype}"
            symbols = shape_symbols(row["shape"])
            assert len(symbols) == node.ndim, f"{path}: {node.shape}"
            for symbol, size in zip(symbols, node.shape):
                assert sizes.setdefault(symbol, size) == size, f"{path}: {symbol} is {size}, elsewhere {sizes[symbol]}"
            if row["units"] != "list":
                assert node.attrs["units"] == row["units"], path
            assert node.attrs["frame"] == row["frame"], path
            assert node.attrs["long_name"], path
        missing = [row["path"] for row in rows if row["present"] == "always" and row["path"] not in found]
        assert not missing


def documented(root):
    """Rows of the datasets by path, one for each path of a row; a star stands for the names of the deck."""
    rows = {}
    for row in table(root, "Datasets"):
        paths = [path.strip("`") for path in row["path"].split(", ")] if row["path"].startswith("/") else []
        for place, path in enumerate(paths):
            units = row["units"].split(", ")
            rows[path.replace("NAME", "*")] = {**row, "unit": units[place] if len(units) == len(paths) else units[0]}
    return rows


@pytest.mark.parametrize("deck, options", [
    ("primitives", ()),
    ("slider_crank_6_6_bushing", ()),
    ("slider_crank_6_6_lubricated", ()),
    ("crosshead", ()),
    ("valve_train", ()),
    ("four_bar_kinematic", ()),
    ("journal_bearing", ()),
    ("journal_bearing", ("--analysis", "static")),
])
def test_datasets_of_other_scenes_are_documented(gudgeon, root, tmp_path, deck, options):
    """Path, type, number of dimensions, unit and frame of what other scenes write, of the plane and of space."""
    command = [gudgeon, "run", f"inputs/{deck}.deck", "--out", tmp_path / "run", "--quiet", "--write", "channels", *options]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    rows = documented(root)
    with h5py.File(tmp_path / "run" / "run.h5", "r") as file:
        for path, node in datasets(file).items():
            row = next((row for name, row in rows.items() if fnmatch.fnmatch(path, name)), None)
            assert row, f"{path} is not in docs/reference/output.md"
            assert is_of_type(node.dtype, row["type"]), f"{path}: {node.dtype}"
            ranks = [0] if row["shape"] == "scalar" else [len(shape_symbols(word)) for word in re.findall(r"\([^)]*\)", row["shape"])]
            assert node.ndim in ranks, f"{path}: {node.shape}"
            assert row["unit"] in ("list", "its own") or node.attrs["units"] == row["unit"], path
            assert re.search(rf"\b{node.attrs['frame']}\b", row["frame"]), f"{path}: {node.attrs['frame']}"


def test_moments_of_torsional_springs_beside_torques(gudgeon, tmp_path, root):
    """One number about the axis and two that do not exist; the attribute has the frames of both, as the table says."""
    (tmp_path / "t.deck").write_text("""deck = 1
[scene]
space = spatial
gravity = 0 0 0 m/s^2
[bodies]
name mass[kg] ixx[kg.m^2] iyy[kg.m^2] izz[kg.m^2]
bar 1 1 1 1
[points]
name body xi[m]
a ground 0
b bar 0
[joint.revolute]
name i j axis_i
pin a b "0 0 1"
[force.torsion_spring]
name i j axis_i stiffness[N.m/rad] free_angle[rad]
twist ground bar "0 0 1" 3 0.1
[force.torque]
name body mx[N.m]
push bar 1
[analysis.dynamic]
end = 1 ms
[output]
every = 1 ms
""")
    done = subprocess.run([gudgeon, "run", tmp_path / "t.deck", "--out", tmp_path / "run", "--quiet"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    with h5py.File(tmp_path / "run" / "run.h5", "r") as file:
        moment = file["forces/moment"]
        rows = dict(zip(file["forces/names"].asstr()[:], moment[0]))
        np.testing.assert_allclose(rows["twist"], [-0.3, np.nan, np.nan], rtol=1e-12)
        np.testing.assert_allclose(rows["push"], [1, 0, 0], atol=1e-15)
        assert moment.attrs["frame"] == documented(root)["/forces/moment"]["frame"] == "world, joint"


@pytest.mark.parametrize("options", [(), ("--csv", "--horizon"), ("--accuracy", "1e-3", "--budget", "20 s"), ("static",)])
def test_every_key_of_the_summary_is_documented(gudgeon, root, tmp_path, options):
    """Keys of summary.json both ways, objects and lists as they are called, and the keys of the objects in lists."""
    deck, options = (("journal_bearing", ("--analysis", "static")) if options == ("static",) else ("slider_crank_translational", options))
    command = [gudgeon, "run", f"inputs/{deck}.deck", "--out", tmp_path / "run", "--quiet", *options]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, timeout=600)
    assert done.returncode in (0, 6), done.stderr
    summary = json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))
    rows = {key: row for row in table(root, "summary.json") for key in re.findall(r"[a-zA-Z_]\w+", row["key"])}
    for key, value in summary.items():
        row = rows.get(re.sub(r"_\d+$", "_K", key))
        assert row, f"{key} is not in docs/reference/output.md"
        told = row["what it is"]
        if isinstance(value, list):
            assert re.search(r"\blists?\b|\bthe same\b", told), f"{key}: {told}"
        assert not isinstance(value, dict) or "an object" in told, f"{key}: {told}"
        if isinstance(value, list) and value and isinstance(value[0], dict) and key in ("extremes", "first_impacts"):
            named = set(re.findall(r"`(\w+)`", f"{told}`")) | ({row["field"] for row in table(root, "Fields of /events")} if key == "first_impacts" else set())
            assert set(value[0]) <= named, key
        if key == "loose_joints":
            paths = {row["path"].rpartition("/")[2] for row in table(root, "Datasets") if row["path"].startswith("/extremes/joints/")}
            assert set(value[0]) == paths - {"name"} | {"joint"} if value else True
    assert not [key for key, row in rows.items() if row["when"] == "always" and key not in summary]


def test_every_attribute_is_as_documented(made, root):
    rows = table(root, "Attributes")
    with h5py.File(made / "run.h5", "r") as file:
        nodes = {"/": file}
        file.visititems(lambda name, node: nodes.update({f"/{name}": node}))
        for path, node in nodes.items():
            wanted = {row["attribute"]: row for row in rows if row["object"] == path}
            if isinstance(node, h5py.Dataset):
                wanted.update({row["attribute"]: row for row in rows if row["object"] == "every dataset"})
            assert set(node.attrs) - SCALE_ATTRIBUTES == set(wanted), path
            for name, row in wanted.items():
                handle = node.attrs.get_id(name)
                assert is_of_type(handle.dtype, row["type"]), f"{path} {name}: {handle.dtype}"
                assert handle.shape == ((2,) if row["shape"] == "(2)" else ()), f"{path} {name}"
        assert file.attrs["filetype"] == "gudgeon run"
        assert list(file.attrs["format_version"]) == [2, 2]
        assert file.attrs["status"].decode() == "complete"


def test_events_are_as_documented(made, root):
    rows = table(root, "Fields of /events")
    with h5py.File(made / "run.h5", "r") as file:
        events = file["events"]
        assert list(events.dtype.names) == [row["field"] for row in rows]
        assert events.attrs["units"].split() == [row["unit"] for row in rows]
        for row in rows:
            kind = events.dtype[row["field"]].kind
            assert kind == ("S" if row["type"] == "string" else "f"), row["field"]
        assert np.all(np.diff(events["time"]) >= 0)
        assert np.sum(events["kind"] == b"contact") == file["summary"].attrs["contacts"]


def test_time_is_a_dimension_scale(made):
    with h5py.File(made / "run.h5", "r") as file:
        n = len(file["time"])
        told = {sort: file["summary"].attrs[f"{sort}_rows"] for sort in ("onset", "peak", "end", "jump", "stop")}
        assert n == file["summary"].attrs["samples"] + sum(told.values())
        assert list(np.bincount(file["row_kind"], minlength=6)[1:]) == list(told.values())
        for path, node in datasets(file).items():
            if is_history(node):
                assert node.shape[0] == n, path
            elif path != "/time":
                assert "/energy/" not in path and "/contacts/" not in path, f"{path} has no time"


def test_text_files_hold_the_same_numbers(made):
    with h5py.File(made / "run.h5", "r") as file:
        names = list(file["bodies/names"].asstr())
        item = names.index("slider")
        values = np.loadtxt(made / "slider.dat")
        labels = (made / "slider.dat").read_text().splitlines()[0].split()[1:]
        assert labels[0] == "time[s]"
        assert np.array_equal(values[:, 0], file["time"][:])
        column = labels.index("slider.velocity.x[m/s]")
        assert np.array_equal(values[:, column], file["bodies/velocity"][:, item, 0])
        named = np.genfromtxt(made / "slider.dat", names=True)
        assert np.array_equal(named["slidervelocityxms"], values[:, column])
        events = np.genfromtxt(made / "events.dat", names=True, dtype=None, encoding=None)
        assert np.array_equal(events["peak_forceN"], file["events"]["peak_force"], equal_nan=True)
        assert list(events["kind"]) == [kind.decode() for kind in file["events"]["kind"]]


def test_summary_is_json_and_names_its_files(made):
    summary = json.loads((made / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "complete"
    for name in summary["files"] + summary["figures"]:
        assert (made / name).stat().st_size > 0, name
    for name in summary["figures"]:
        assert (made / name).read_bytes().startswith((b"\x89PNG", b"GIF89a", b"<!DOCTYPE html>")), name
        assert (made / name).with_suffix(".gp").exists(), name


def test_equal_runs_differ_in_provenance_only(made, gudgeon, root, tmp_path):
    again = run(gudgeon, root, tmp_path / "another_place")
    with h5py.File(made / "run.h5", "r") as first, h5py.File(again / "run.h5", "r") as second:
        nodes = {"/": first}
        first.visititems(lambda name, node: nodes.update({f"/{name}": node}))
        for path, node in nodes.items():
            if path == "/provenance":
                continue
            other = second[path]
            for name in set(node.attrs) - SCALE_ATTRIBUTES:
                assert np.asarray(node.attrs[name]).tobytes() == np.asarray(other.attrs[name]).tobytes() or np.all(
                    node.attrs[name] == other.attrs[name]
                ), f"{path} {name}"
            if isinstance(node, h5py.Dataset):
                if node.dtype.kind == "O":
                    assert np.all(node[()] == other[()]), path
                else:
                    assert node[()].tobytes() == other[()].tobytes(), path
    for path in made.glob("*.dat"):
        assert path.read_bytes() == (again / path.name).read_bytes(), path.name


def test_an_older_run_is_kept(gudgeon, root, tmp_path):
    place = tmp_path / "run"
    run(gudgeon, root, place)
    first = (place / "run.h5").read_bytes()
    run(gudgeon, root, place)
    assert (tmp_path / "run.1" / "run.h5").read_bytes() == first
    run(gudgeon, root, place)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["run", "run.1"]


def test_a_foreign_directory_is_left_alone(gudgeon, root, tmp_path):
    (tmp_path / "thesis.txt").write_text("precious")
    done = subprocess.run(
        [gudgeon, "run", DECK, "--out", tmp_path, "--quiet"], cwd=root, capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 9
    assert "stays unchanged" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]
