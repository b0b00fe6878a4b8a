"""Equal runs are equal bit for bit; the checked build agrees with the fast one."""

import functools

import h5py
import numpy as np
import pytest
from support import DECK, Run, assert_close, call, finished, plain, plain_deck, scratch, written

IMPACT = ("time", "impact_speed", "peak_force", "peak_penetration", "duration", "release_speed", "energy_lost")


def bits(value):
    """Type, shape and bytes of a value; texts of variable length as texts."""
    value = np.asarray(plain(value))
    return str(value.dtype), value.shape, value.tobytes() if value.dtype != object else repr(value.tolist())


def contents(path):
    """Everything in an HDF5 file but /provenance: name of object or attribute to its bits."""
    found = {}

    def attributes(name, thing):
        for key in thing.attrs:
            if key in ("DIMENSION_LIST", "REFERENCE_LIST"):  # places in the file
                found[name, key] = len(thing.attrs[key])
            else:
                found[name, key] = bits(thing.attrs[key])

    def visit(name, thing):
        if name == "provenance" or name.startswith("provenance/"):
            return
        attributes(name, thing)
        found[name] = bits(thing[()]) if isinstance(thing, h5py.Dataset) else "group"

    with h5py.File(path, "r") as file:
        attributes("/", file)
        file.visititems(visit)
    return found


@functools.lru_cache(maxsize=None)
def two_runs(program):
    """The directories of two runs of one deck, figures and all."""
    directory = scratch()
    for name in ("one", "two"):
        call(program, "run", DECK, "--out", directory / name, "--quiet", "--tolerance", "1e-8")
    return directory / "one", directory / "two"


@pytest.fixture
def twice(gudgeon):
    """Two equal runs, made once."""
    return two_runs(gudgeon)


def test_hdf5_is_equal(twice):
    """All datasets and attributes outside /provenance, recursively."""
    one, two = (contents(directory / "run.h5") for directory in twice)
    assert one.keys() == two.keys()
    assert len(one) > 20
    assert [key for key in one if one[key] != two[key]] == []


def test_text_files_are_equal(twice):
    """Time histories, events, deck.echo and the scripts of the figures, byte for byte; the same files in both."""
    names = [sorted(str(p.relative_to(d)) for p in d.rglob("*") if p.is_file()) for d in twice]
    assert names[0] == names[1]
    compared = [n for n in names[0] if n.endswith((".dat", ".echo", ".gp"))]
    assert "deck.echo" in compared and "events.dat" in compared and len(compared) > 5
    differ = [n for n in compared if (twice[0] / n).read_bytes() != (twice[1] / n).read_bytes()]
    assert differ == []


def test_provenance_is_where_differences_are(twice):
    """The attributes that may differ are there, and only there."""
    with h5py.File(twice[0] / "run.h5", "r") as file:
        assert {"created", "command", "host", "cpu_seconds", "wall_seconds"} <= set(file["provenance"].attrs)
        assert not {"created", "host", "cpu_seconds"} & set(file.attrs)


def test_deck_echo_is_a_deck(gudgeon, twice):
    """deck.echo, with its defaults written out, is read again and gives the same impacts."""
    directory = scratch()
    echo = written(directory, (twice[0] / "deck.echo").read_text(), "echo.deck")
    call(gudgeon, "run", echo, "--out", directory / "out", "--quiet")
    again, first = Run(directory / "out"), Run(twice[0])
    for field in IMPACT[:3]:
        assert_close(again.contacts[field][:5], first.contacts[field][:5], relative=1e-9, what=field)


def test_debug_agrees_with_release(gudgeon, gudgeon_debug):
    """The first five impacts to a part in 1e9."""
    fast, checked = (finished(program, "--tolerance", "1e-10") for program in (gudgeon, gudgeon_debug))
    for field in IMPACT:
        assert_close(checked.contacts[field][:5], fast.contacts[field][:5], relative=1e-9, what=field)


def test_tolerance_of_the_deck_and_of_the_command_line(gudgeon):
    """`--tolerance` does what the deck's key does."""
    directory = scratch()
    deck = written(directory, plain_deck([("analysis.dynamic", "tolerance", "1e-7")]))
    call(gudgeon, "run", deck, "--out", directory / "out", "--quiet")
    by_deck, by_option = Run(directory / "out"), finished(gudgeon, "--tolerance", "1e-7")
    assert np.array_equal(by_deck.contacts["time"], by_option.contacts["time"])
    assert by_deck.summary["steps"] == by_option.summary["steps"]
