"""Results of a study of tolerances as tables."""

from __future__ import annotations

import functools
import os
import pathlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from .call import GudgeonError, Progress, call, needed
from .deck import Deck
from .result import Results
from .verbs import table

if TYPE_CHECKING:
    import pandas

KEYS = ["request", "contributor"]


class Tolerances(Results):
    """What `gudgeon tolerance` left in a directory. Values are SI; column `unit` has the unit of the request."""

    def __init__(self, path: str | os.PathLike[str]):
        self.directory = pathlib.Path(path)
        self.file = self.directory / "tolerance.h5"
        if not self.file.is_file():
            raise FileNotFoundError(f"{path}: no study of tolerances, there is no {self.file}")

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json (docs/reference/output.md); `directory` is the one that is read."""
        return {**super().summary, "directory": str(self.directory)}

    def _table(self, name: str) -> pandas.DataFrame:
        """A table of tolerance.h5, with the unit of each request."""
        with needed("h5py", "reading tolerance.h5").File(self.file, "r") as file:
            group = file[f"tolerance_{name}"]
            data = {key: column.asstr()[()] if column.dtype.kind in "OS" else column[()]
                    for key, column in group.items() if len(column.shape) == 1 and not key.startswith("part_")}
        frame: pandas.DataFrame = needed("pandas", "a table").DataFrame(data)
        if name != "widths":
            frame["unit"] = [self.summary["tolerance"][request]["unit"] for request in frame["request"]]
        return frame

    @functools.cached_property
    def requests(self) -> pandas.DataFrame:
        """By request, at the time that is shown of it: worst case, scatter, mean, yield, capability."""
        return self._table("requests").set_index("request")

    @functools.cached_property
    def contributors(self) -> pandas.DataFrame:
        """By request and contributor, largest first: derivative at the same time, parts of the scatter, Sobol' indices with intervals."""
        frame, of = self._table("contributors"), self.derivatives
        of = of[of["time"] == of["request"].map(self.requests["time"])]
        return frame.merge(of[[*KEYS, "derivative", "contributor_unit"]], on=KEYS, how="left").set_index(KEYS)

    @functools.cached_property
    def times(self) -> pandas.DataFrame:
        """Each request over the output times: worst case, scatter, mean, of the members with intervals."""
        return self._table("times")

    @functools.cached_property
    def derivatives(self) -> pandas.DataFrame:
        """Each request and contributor over the output times: derivatives, Sobol' indices with intervals."""
        return self._table("derivatives")

    @functools.cached_property
    def histogram(self) -> pandas.DataFrame:
        """Members in the bins of each request."""
        return self._table("histograms")

    @functools.cached_property
    def worst(self) -> pandas.DataFrame:
        """Members with the lowest and the highest value of each request: number, value, deviations of the parameters, places of pins."""
        frame = self._table("worst")
        with needed("h5py", "reading tolerance.h5").File(self.file, "r") as file:
            group = file["tolerance_worst"]
            for name, column in zip(str(group.attrs["parts"]).split(), group["deviation"][()].T):
                frame[name] = column
        return frame

    @functools.cached_property
    def yields(self) -> pandas.DataFrame:
        """Part of the members within the limits, with its interval: of all limits together (`all`), and of each request with limits."""
        of, requests = self.summary, self.requests
        rows = {"all": of["tolerance_study"]["yield"]}
        rows.update({name: of["tolerance"][name]["yield"] for name in requests.index[requests["yield"].notna()]})
        frame: pandas.DataFrame = needed("pandas", "a table").DataFrame.from_dict(rows, orient="index")
        return frame if len(rows) > 1 else frame.iloc[:0]

    @functools.cached_property
    def members(self) -> pandas.DataFrame:
        """Of the dynamic level: the run of each member, a row as of `gudgeon.sweep`. Members of the kinematic level are not kept."""
        study = self.summary["tolerance_study"]
        if study["level"] != "dynamic":
            raise ValueError("members of the kinematic level are not kept: see histogram and worst")
        frame = table(self.summary, "sweep.csv")
        beside = 0 if frame["run"].max() > 1 else 2*len(study["parameters"])  # cases for derivatives, after the nominal one
        kept: pandas.DataFrame = frame[frame["case"].between(beside + 2, beside + 1 + study["members"])].reset_index(drop=True)
        return kept

    def __repr__(self) -> str:
        return f"<gudgeon tolerances {self.directory}: {len(self.requests)} requests, {len(self.warnings)} warnings>"


def tolerance(
    deck: str | os.PathLike[str] | Deck, *, set: Mapping[str, Any] | None = None, out: str | os.PathLike[str] | None = None,
    progress: Progress = False, **options: Any,
) -> Tolerances:
    """Study the tolerances of a deck with `[tolerance]`. Options are those of `gudgeon tolerance`, as `jobs=2`."""
    code, message, summary = call("tolerance", deck, set, out, progress, options)
    if code:
        raise GudgeonError(code, message)
    return Tolerances(summary["directory"])
