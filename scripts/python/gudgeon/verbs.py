"""Verbs of the program as functions."""

from __future__ import annotations

import os
import pathlib
import re
import warnings
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .call import GudgeonError, Progress, call, needed
from .deck import Deck, spelled
from .result import Run

if TYPE_CHECKING:
    import pandas

SOME_FAILED = 8  # exit code of a sweep: its table has the messages


def run(
    deck: str | os.PathLike[str] | Deck, *, set: Mapping[str, Any] | None = None, out: str | os.PathLike[str] | None = None,
    progress: Progress = False, **options: Any,
) -> Run:
    """Run a deck, a path or a `Deck`, and give its results.

    `set`: values of parameters, as {"c": "0.1 mm"}; `out`: directory of the results, else outputs/NAME. Options are those of
    `gudgeon run`: `tolerance=1e-9`, `method="bdf"`, `ideal=True`, `write="channels"`, `accuracy=1e-6`. `progress`: True shows how far
    a long run is, a function is called with that line. A run that fails is a GudgeonError.
    """
    code, message, summary = call("run", deck, set, out, progress, options)
    there = Run(summary["directory"]) if summary else None
    if code or there is None:
        raise GudgeonError(code, message, there)
    return there


def sweep(
    deck: str | os.PathLike[str] | Deck, *, over: Mapping[str, Sequence[Any]] | None = None, cases: bool = False,
    set: Mapping[str, Any] | None = None, out: str | os.PathLike[str] | None = None, progress: Progress = False, **options: Any,
) -> pandas.DataFrame:
    """All runs of a sweep, one in a row; with `cases` all cases, with mean, deviation, least and greatest of their runs.

    `over` makes the sweep of a deck without one: {"c": ["0.1 mm", "0.2 mm"]}, all combinations of several. Options are those of
    `gudgeon sweep`, as `jobs=2`. Runs that failed are rows with their `exit_code` and `message`, and a warning. Of the frame,
    `attrs["units"]` has units by column, `attrs["summary"]` the summary, `attrs["directory"]` where all of it is.
    """
    needed("pandas", "a table")
    if over:
        deck = deck if isinstance(deck, Deck) else Deck.read(deck)
        lines = [f"{name} = {' '.join(spelled(value).replace(' ', '') for value in values)}\n" for name, values in over.items()]
        deck = Deck(f"{deck.text}\n[sweep]\n{''.join(lines)}", deck.folder, deck.name, **deck.values)
    code, message, summary = call("sweep", deck, set, out, progress, options)
    if code == SOME_FAILED:
        warnings.warn(message, RuntimeWarning, stacklevel=2)
    elif code:
        raise GudgeonError(code, message)
    return table(summary, "cases.csv" if cases else "sweep.csv")


def precision(
    deck: str | os.PathLike[str] | Deck, *, set: Mapping[str, Any] | None = None, out: str | os.PathLike[str] | None = None,
    progress: Progress = False, **options: Any,
) -> pandas.DataFrame:
    """Error and cost of methods and tolerances, a run in a row; `attrs["summary"]["choice"]` is the cheapest within `accuracy`.

    Options are those of `gudgeon precision`: `methods=["verner", "bdf"]`, `accuracy=1e-6`, `budget="60s"`. `attrs` as of `sweep`.
    """
    needed("pandas", "a table")
    code, message, summary = call("precision", deck, set, out, progress, options)
    if code:
        raise GudgeonError(code, message)
    return table(summary, "precision.csv")


def life(
    deck: str | os.PathLike[str] | Deck, *, set: Mapping[str, Any] | None = None, out: str | os.PathLike[str] | None = None,
    progress: Progress = False, **options: Any,
) -> pandas.DataFrame:
    """Wear of a deck with `[life]`, a surface after a jump in a row; `attrs["summary"]["wear"]` has the end of each joint with intervals.

    Options are those of `gudgeon life`: `tolerance=1e-6`, `jobs=2`. `attrs` as of `sweep`.
    """
    needed("pandas", "a table")
    code, message, summary = call("life", deck, set, out, progress, options)
    if code:
        raise GudgeonError(code, message)
    return table(summary, "life.csv")


def fit(
    deck: str | os.PathLike[str] | Deck, *data: str | os.PathLike[str], set: Mapping[str, Any] | None = None,
    out: str | os.PathLike[str] | None = None, progress: Progress = False, **options: Any,
) -> pandas.DataFrame:
    """Parameters of a deck with `[fit]` from files of data, an unknown in a row: `value`, `low` and `high` of the 95 % interval, `deviation`,
    `seen`, `unit`.

    Options are those of `gudgeon fit`: `tolerance=1e-9`, `time="1 unit=ms"`. `attrs` has `summary` and `directory`.
    """
    pandas = needed("pandas", "a table")
    code, message, summary = call("fit", deck, set, out, progress, options, data)
    if code:
        raise GudgeonError(code, message)
    frame: pandas.DataFrame = pandas.DataFrame.from_dict(summary["fit"], orient="index")
    frame.attrs.update(summary=summary, directory=summary["directory"])
    return frame


def table(summary: dict[str, Any], name: str) -> pandas.DataFrame:
    """A file of comma-separated values, its headings without units."""
    path = pathlib.Path(summary["directory"], name)
    texts = dict.fromkeys(("message", "warnings", "reason"), str)
    frame: pandas.DataFrame = needed("pandas", "a table").read_csv(
        path, float_precision="round_trip", keep_default_na=False, na_values=[""], converters=texts)
    pairs = (re.findall(r"^(.*?)(?: \[(.*)\])?$", heading)[0] for heading in frame.columns)
    units = {name: unit or "1" for name, unit in pairs}
    frame.columns = list(units)
    frame.attrs.update(units=units, summary=summary, directory=summary["directory"])
    return frame
