"""Results of a run: everything is read when it is first asked for."""

from __future__ import annotations

import base64
import functools
import html
import json
import os
import pathlib
from typing import TYPE_CHECKING, Any

from .call import needed

if TYPE_CHECKING:
    import numpy
    import pandas
    import xarray

    from . import reader

USE = "reading run.h5"


class Results:
    """A directory of results: what its summary says."""

    directory: pathlib.Path

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json (docs/reference/output.md)."""
        summary: dict[str, Any] = json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))
        return summary

    @property
    def warnings(self) -> list[str]:
        """What the run or study warned of."""
        return list(self.summary["warnings"])

    @property
    def figures(self) -> list[pathlib.Path]:
        """Paths of the figures and animations."""
        return [self.directory / name for name in self.summary["figures"]]


class Run(Results):
    """What a run left behind: `directory`, `file` (its run.h5), and what the properties say."""

    def __init__(self, path: str | os.PathLike[str]):
        path = pathlib.Path(path)
        self.file = path / "run.h5" if path.is_dir() else path
        self.directory = self.file.parent
        if not self.file.is_file():
            raise FileNotFoundError(f"{path}: no run of gudgeon, there is no {self.file}")

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json (docs/reference/output.md); of a run that has not ended, what run.h5 has so far."""
        if (self.directory / "summary.json").exists():
            return super().summary
        of = self.arrays()
        return {**of.summary, "status": of.attributes["status"], "message": of.attributes["status_message"],
                "warnings": of.warnings, "figures": [], "loose_joints": []}

    @property
    def status(self) -> str:
        """`complete`, `stopped`, `failed` or `running`."""
        return str(self.summary["status"])

    def arrays(self, rows: str = "instants") -> reader.Run:
        """Channels as a dictionary of arrays, `rows`: "instants", equally spaced, or "all", with those at contacts."""
        needed("h5py", USE)
        from . import reader

        return reader.read(self.file, rows)

    @functools.cached_property
    def _instants(self) -> reader.Run:
        return self.arrays()

    def __getitem__(self, channel: str) -> numpy.ndarray:
        """A channel at the output times."""
        return self._instants[channel]

    def peak(self, channel: str) -> tuple[float, float]:
        """The greatest magnitude of a channel, located between the rows too, and its time."""
        return self._instants.peak(channel)

    @functools.cached_property
    def channels(self) -> xarray.Dataset:
        """Channels over the output times, `attrs["units"]` of each its unit."""
        needed("xarray", "a dataset")
        return self._instants.to_xarray()

    @functools.cached_property
    def extremes(self) -> pandas.DataFrame:
        """By channel: unit, least and greatest value with their times, located between the rows too, mean and root mean square."""
        columns = ["unit", "least", "least_time", "greatest", "greatest_time", "mean", "rms"]
        with needed("h5py", USE).File(self.file, "r") as file:
            group = file.get("extremes/channels", {})
            data = {name: group[name].asstr()[()] if name in ("unit", "name") else group[name][()] for name in group}
        index = needed("pandas", "a table").Index(data.pop("name", []), name="channel")
        frame: pandas.DataFrame = needed("pandas", "a table").DataFrame(data, index=index, columns=columns)
        return frame

    @functools.cached_property
    def events(self) -> pandas.DataFrame:
        """Located events by time, of every kind; `attrs["units"]` has units by column."""
        with needed("h5py", USE).File(self.file, "r") as file:
            rows, units = file["events"][()], file["events"].attrs["units"].split()
        names = rows.dtype.names
        data = {name: [word.decode() for word in rows[name]] if rows.dtype[name].kind == "S" else rows[name] for name in names}
        frame: pandas.DataFrame = needed("pandas", "a table").DataFrame(data)
        frame.attrs["units"] = dict(zip(names, units))
        return frame

    @property
    def contacts(self) -> pandas.DataFrame:
        """Those of the events that are contacts: onset, impact speed, peak force, duration, energy lost."""
        contacts: pandas.DataFrame = self.events[self.events["kind"] == "contact"].reset_index(drop=True)
        return contacts

    @property
    def joints(self) -> pandas.DataFrame:
        """Joints with clearance: impacts, contact fraction, greatest speed, force and penetration."""
        frame: pandas.DataFrame = needed("pandas", "a table").DataFrame(self.summary["loose_joints"])
        return frame

    def __repr__(self) -> str:
        return f"<gudgeon run {self.directory}: {self.status}, {len(self.warnings)} warnings>"

    def _repr_png_(self) -> bytes | None:
        """The first figure, for a notebook."""
        return next((path.read_bytes() for path in self.figures if path.suffix == ".png"), None)

    def _repr_html_(self) -> str:
        """Status, warnings and figures, for a notebook."""
        of = self.summary
        said = [f"<b>{html.escape(str(of.get('title', '')))}</b> {html.escape(self.status)}: {html.escape(str(self.directory))}"]
        said += [f"warning: {html.escape(text)}" for text in self.warnings]
        pictures = [base64.b64encode(path.read_bytes()).decode() for path in self.figures if path.suffix == ".png"]
        return "<br>".join(said) + "".join(f'<br><img src="data:image/png;base64,{data}">' for data in pictures)


def read(path: str | os.PathLike[str]) -> Run:
    """A run that was made before, by its directory or its run.h5."""
    return Run(path)
