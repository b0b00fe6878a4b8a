#!/usr/bin/env python3
"""Reads what a run of gudgeon left behind: run.h5 as a dict of arrays with units.

    from gudgeon.reader import read               # or, of this file alone: from gudgeon_reader import read

    run = read("outputs/slider_crank_dry")        # the directory of a run, or its run.h5
    run["slider.velocity.x"]                      # an array, one number for each output instant
    run.units["slider.velocity.x"]                # "m/s"
    run["time"], run.events["impact_speed"]       # instants; the table of events
    run.extremes["slider.velocity.x"].greatest    # located between the rows too; least, least_time, greatest_time
    run.peak("slider.velocity.x")                 # the greatest magnitude and its time
    run.to_pandas(), run.to_xarray()              # where pandas or xarray are there

Names are those of the deck's `channels`: item.quantity, item.quantity.component, and item.contact.quantity where a joint has several
contacts. `read(path, rows="all")` has the rows of contacts too (`run["row_kind"]` tells what each is); what was not recorded of an item
is NaN. As a program it lists the channels of a run, or writes some as columns:

    python3 -m gudgeon.reader outputs/slider_crank_dry
    python3 -m gudgeon.reader outputs/slider_crank_dry slider.velocity.x gudgeon.force > table.csv

Needs h5py and numpy. Format 2 of run.h5: docs/reference/output.md.
"""

from __future__ import annotations

import argparse
import csv
import difflib
import os
import pathlib
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import h5py
import numpy as np

if TYPE_CHECKING:
    import pandas
    import xarray

FORMAT = 2
ROOMS = ("bodies", "joints", "drivers", "clearances", "forces", "points", "motions", "reactions")
COMPONENTS = {2: "xy", 3: "xyz", 4: ("e0", "e1", "e2", "e3")}


class Extremes(NamedTuple):
    """Least and greatest value of a channel, with their times."""

    least: float
    least_time: float
    greatest: float
    greatest_time: float


class Run(dict[str, np.ndarray]):
    """Channels of a run by name; `units`, `help` and `extremes` by the same names, `attributes` of the file and its summary, `events`."""

    def __init__(self, path: str | os.PathLike[str], rows: str = "instants"):
        super().__init__()
        if rows not in ("instants", "all"):
            raise ValueError(f"rows = {rows!r}: it is 'instants' or 'all'")
        path = pathlib.Path(path)
        self.path = path / "run.h5" if path.is_dir() else path
        self.units: dict[str, str] = {}
        self.help: dict[str, str] = {}
        self.extremes: dict[str, Extremes] = {}
        with h5py.File(self.path, "r") as file:
            kind = file.attrs.get("filetype")
            if kind != "gudgeon run" or file.attrs["format_version"][0] != FORMAT:
                raise ValueError(f"{self.path}: not a run of gudgeon in format {FORMAT} (filetype {kind!r})")
            self.attributes: dict[str, Any] = {name: plain(value) for name, value in file.attrs.items()}
            self.summary: dict[str, Any] = {name: plain(value) for name, value in file["summary"].attrs.items()}
            self.events: np.ndarray = file["events"][()]
            self.warnings: list[str] = [plain(line) for line in file["warnings"][()]] if "warnings" in file else []
            n = len(file["time"])  # grows last: a run that goes on, or was killed, may have more of the others
            kinds = file["row_kind"][:n]
            self._rows = np.ones(n, bool) if rows == "all" else kinds == 0
            self._time = file["time"][:n]
            self._put("time", file["time"], file["time"][:n])
            if rows == "all":
                self._put("row_kind", file["row_kind"], kinds)
            for room in ROOMS:
                if room in file:
                    self._take_room(file[room], [plain(name) for name in file[room].get("names", [])])
            if "clearances/contacts" in file:
                joints, labels = (file[f"clearances/contact_{word}"][()] for word in ("joint", "label"))
                names = [".".join(filter(None, (plain(j), plain(k)))) for j, k in zip(joints, labels)]
                self._take_room(file["clearances/contacts"], names)
            for room, word in (("energy", "energy"), ("requests", "request")):
                for quantity, data in file.get(room, {}).items():
                    self._put(f"{word}.{quantity}", data, data[:n])
            if "extremes/channels" in file:  # as the run located them; before it has ended those of its rows stand
                of = file["extremes/channels"]
                numbers = zip(*(of[name][()].tolist() for name in Extremes._fields))
                for name, extremes in zip(map(plain, of["name"][()]), map(Extremes._make, numbers)):
                    if name in self.extremes and np.isfinite(extremes.least):
                        self.extremes[name] = extremes

    def _put(self, name: str, data: h5py.Dataset, values: np.ndarray) -> None:
        """Keep a channel; one without any number was not recorded of its item."""
        if values.dtype.kind == "f" and len(values) and np.isnan(values).all():
            return
        self[name] = values[self._rows] if len(values) == len(self._rows) else values
        if values.dtype.kind == "f" and name != "time" and len(values) == len(self._time) > 0:
            least, greatest = int(np.nanargmin(values)), int(np.nanargmax(values))
            self.extremes[name] = Extremes(
                float(values[least]), float(self._time[least]), float(values[greatest]), float(self._time[greatest])
            )
        self.units[name] = plain(data.attrs["units"])
        self.help[name] = plain(data.attrs["long_name"])

    def _take_room(self, group: h5py.Group, names: list[str]) -> None:
        """The histories of a room: (rows, items) or (rows, items, components)."""
        n = len(self._rows)
        for quantity, data in group.items():
            if not is_history(data):
                continue
            values = data[:n]
            for item, name in enumerate(names):
                if values.ndim == 2:
                    self._put(f"{name}.{quantity}", data, values[:, item])
                    continue
                for component, letter in enumerate(COMPONENTS[values.shape[2]]):
                    self._put(f"{name}.{quantity}.{letter}", data, values[:, item, component])

    def __missing__(self, name: str) -> np.ndarray:
        raise KeyError(self._unknown(name, self))

    def _unknown(self, name: str, known: Iterable[str]) -> str:
        """What is said of a channel that is not there."""
        near = difflib.get_close_matches(name, list(known), n=3, cutoff=0.5)
        return f"{name}: no such channel" + (f"; did you mean {' or '.join(near)}?" if near else "")

    def peak(self, name: str) -> tuple[float, float]:
        """The greatest magnitude of a channel, and when: that of the summary, `compare` and the statistics of the whole run."""
        if name not in self.extremes:
            raise KeyError(self._unknown(name, self.extremes))
        of = self.extremes[name]
        if abs(of.least) > abs(of.greatest):
            return abs(of.least), of.least_time
        return abs(of.greatest), of.greatest_time

    def to_pandas(self) -> pandas.DataFrame:
        """A pandas.DataFrame with the time as index; units are in `attrs["units"]`."""
        import pandas

        frame: pandas.DataFrame = pandas.DataFrame({name: values for name, values in self.items() if name != "time"}, index=self["time"])
        frame.index.name = "time"
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """An xarray.Dataset over the time, each variable with its units."""
        import xarray

        def variable(name: str) -> tuple[str, np.ndarray, dict[str, str]]:
            return ("time", self[name], {"units": self.units[name], "long_name": self.help[name]})

        return xarray.Dataset(
            {name: variable(name) for name in self if name != "time"}, coords={"time": variable("time")}, attrs=self.attributes
        )


def read(path: str | os.PathLike[str], rows: str = "instants") -> Run:
    """A run by its directory or its run.h5. `rows`: "instants", equally spaced, or "all", with those at contacts."""
    return Run(path, rows)


def is_history(data: Any) -> bool:
    """Whether the first dimension of what a group holds is the time of the file."""
    if not isinstance(data, h5py.Dataset) or not data.ndim or not len(data.dims[0]):
        return False
    return bool(data.dims[0][0].name == "/time")


def plain(value: Any) -> Any:
    """Strings of HDF5 as strings, numbers and arrays as they are."""
    if isinstance(value, bytes):
        return value.rstrip(b"\0").decode()
    return value


def main() -> None:
    parser = argparse.ArgumentParser(description="Channels of a run of gudgeon, or some of them as CSV.")
    parser.add_argument("run", help="directory of a run, or its run.h5")
    parser.add_argument("channels", nargs="*", help="channels to write, or items and quantities: all of theirs")
    parser.add_argument("--rows", choices=("instants", "all"), default="instants", help="all: those at contacts too")
    asked = parser.parse_args()
    try:
        run = read(asked.run, asked.rows)
    except (OSError, ValueError) as error:
        sys.exit(f"gudgeon_reader: {error}")
    if not asked.channels:
        width = max(map(len, run))
        for name in run:
            between = ""
            if name in run.extremes:
                between = f"  {run.extremes[name].least:.6g} to {run.extremes[name].greatest:.6g}"
            print(f"{name:{width}}  [{run.units[name]}]  {run.help[name]}{between}")
        return
    names = ["time"]
    for word in asked.channels:
        found = [name for name in run if name == word or name.startswith(f"{word}.")]
        if not found:
            sys.exit(f"gudgeon_reader: '{word}' is not recorded; without channels all that are there are listed")
        names += [name for name in found if name not in names]
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow([f"{name} [{run.units[name]}]" for name in names])
    table.writerows(zip(*(map(repr, map(float, run[name])) for name in names)))


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:
        sys.stderr.close()
