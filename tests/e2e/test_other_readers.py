"""run.h5 as programs of others read it: Octave's load, xarray by its engines, h5py; strings and dimensions that suit all of them."""

import functools
import importlib.util
import shutil
import subprocess

import h5py
import numpy as np
import pytest
from support import Run, call, finished, plain_deck, scratch, written

GROUPS = ("bodies", "joints", "drivers", "clearances", "clearances/contacts", "energy", "extremes/channels", "extremes/joints",
          "provenance/files", "provenance/parameters", "statistics", "summary")


@functools.cache
def rich_run(gudgeon):
    """A run with statistics, histograms and spectra."""
    text = plain_deck([("analysis.dynamic", "end", "25 ms"), ("output", "channels", "*")]) + "\n[statistics]\nafter = 5 ms\nperiod = 1 turns of motor\nchannels = motor.moment\n" \
        "spectra = slider.velocity\n"
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", "--write", "channels")
    return Run(directory / "out")


@pytest.fixture
def run(gudgeon):
    """That run, made once."""
    return rich_run(gudgeon)


def datasets(path):
    """Names, shapes, types and scales of all datasets."""
    found = {}

    def visit(name, node):
        if isinstance(node, h5py.Dataset):
            is_scale = node.attrs.get("CLASS") == b"DIMENSION_SCALE"
            found[name] = (node.dtype, node.shape, [len(scale) or is_scale for scale in node.dims])

    with h5py.File(path) as file:
        file.visititems(visit)
    return found


def test_every_dimension_has_a_scale_and_every_string_a_length(run):
    """In all groups, tables too: readers of netCDF refuse a group with a dimension that has none, Octave strings of variable length."""
    for name, (dtype, _, scales) in datasets(run.directory / "run.h5").items():
        assert all(scales), name
        assert dtype.kind in "SfiV" and (dtype.kind != "S" or dtype.itemsize > 1), name


@pytest.mark.parametrize("deck, options", [("journal_bearing", ("--analysis", "static")), ("slider_crank_dry", ("--horizon",)),
                                           ("four_bar_spatial", ())])
def test_so_have_those_of_other_analyses(gudgeon, root, tmp_path, deck, options):
    """Films, their eigenvalues, growth, and space."""
    call(gudgeon, "run", root / f"inputs/{deck}.deck", "--out", tmp_path / "out", "--quiet", "--write", "numbers", *options)
    for name, (dtype, _, scales) in datasets(tmp_path / "out/run.h5").items():
        assert all(scales) and dtype.kind in "SfiV", name


@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_xarray_opens_every_group(run, engine):
    """The numbers by name of their item and component, with the time of the file."""
    xarray = pytest.importorskip("xarray")
    if importlib.util.find_spec({"netcdf4": "netCDF4"}.get(engine, engine)) is None:
        pytest.skip(f"{engine} is not there")
    path = run.directory / "run.h5"
    with xarray.open_dataset(path, engine=engine) as top:
        np.testing.assert_array_equal(top["time"], run.rows("time"))
        assert top.sizes["event"] == len(run.rows("events")) and top["row_kind"].dims == ("time",)
    for group in GROUPS:
        with xarray.open_dataset(path, engine=engine, group=group) as data:
            data.load()
    with xarray.open_dataset(path, engine=engine, group="bodies") as bodies:
        bodies = bodies.assign_coords(names=bodies["names"].astype(str))
        np.testing.assert_array_equal(bodies["velocity"].sel(names="slider").isel(component=0), run.rows("bodies/velocity")[:, 2, 0])
    with xarray.open_dataset(path, engine=engine, group="statistics") as statistics:
        assert statistics["spectrum"].dims == ("frequency", "spectrum_names")
        assert statistics["strobe"].dims == ("strobe_time", "strobe_names")


def test_octave_loads_it(run):
    """`load run.h5`: every group but the records of /events, of which it warns; numbers and names are those of the file."""
    if not shutil.which("octave"):
        pytest.skip("octave is not there")
    script = 's = load("run.h5"); names = cellstr(s.bodies.names); k = find(strcmp(names, "slider"));' \
        'v = squeeze(s.bodies.velocity(1, k, :)); printf("%s\\n", strjoin(fieldnames(s)\', " "));' \
        'printf("%.17g %.17g %d\\n", v(end), s.time(end), numel(v)); printf("%s|", cellstr(s.extremes.channels.name){:});'
    done = subprocess.run(["octave", "--no-gui", "--norc", "--quiet", "--eval", script], cwd=run.directory, capture_output=True, text=True,
                          timeout=120)
    assert done.returncode == 0, done.stderr
    fields, numbers, names = done.stdout.splitlines()
    warnings = [line for line in done.stderr.splitlines() if line.startswith(("warning: load", "error: load", "HDF5-DIAG"))]
    assert warnings == ["warning: load: can't read 'events' (unknown datatype)"]
    with h5py.File(run.directory / "run.h5") as file:
        assert set(fields.split()) == set(file) - {"events"}
        v = file["bodies/velocity"][:, 2, 0]
        assert [float(word) for word in numbers.split()] == [v[-1], file["time"][-1], len(v)]
        assert names.split("|")[:-1] == list(file["extremes/channels/name"].asstr())


def test_characters_beyond_ascii(gudgeon):
    """A deck with them is kept byte by byte, and marked as UTF-8."""
    directory = scratch()
    text = plain_deck([("analysis.dynamic", "end", "1 ms")]) + "# µ = 0.1, Lagerspiel 5 µm\n"
    (directory / "deck.deck").write_text(text, encoding="utf-8")
    call(gudgeon, "run", directory / "deck.deck", "--out", directory / "out", "--quiet", "--write", "channels")
    with h5py.File(directory / "out/run.h5") as file:
        assert file["deck"][()].decode("utf-8") == text
        assert file["deck"].id.get_type().get_cset() == h5py.h5t.CSET_UTF8
        assert file["bodies/names"].id.get_type().get_cset() == h5py.h5t.CSET_ASCII


def test_compare_reads_files_of_format_2_1(gudgeon, tmp_path):
    """Strings of variable length, as run.h5 had them: the same run in that form shows no difference."""
    directory = finished(gudgeon).directory
    shutil.copytree(directory, tmp_path / "old")
    with h5py.File(tmp_path / "old/run.h5", "r+") as file:
        for name, (dtype, shape, _) in datasets(directory / "run.h5").items():
            if dtype.kind == "S" and shape:
                values = list(file[name].asstr())
                del file[name]
                file.create_dataset(name, data=values, dtype=h5py.string_dtype())
        file.attrs["format_version"] = np.array([2, 1], "i4")
        del file.attrs["checksum"]
    done = call(gudgeon, "compare", directory, tmp_path / "old", expect=None)
    assert done.returncode == 0, done.stdout + done.stderr
