"""Calls of the program: where it is, what it is told, what it says."""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

from .deck import Deck, spelled

if TYPE_CHECKING:
    from .result import Run

Progress = Union[bool, Callable[[str], object]]
DIAGNOSED = "error: "  # what messages of the program start with


class GudgeonError(RuntimeError):
    """The program ended with an exit code other than 0.

    `code` is the exit code (docs/reference/exit-codes.md; negative: the signal that ended it), `message` what the program said,
    `run` its results up to there, if it got so far that there are some.
    """

    def __init__(self, code: int, message: str, run: Run | None = None):
        super().__init__(message)
        self.code, self.message, self.run = code, message, run


def needed(module: str, use: str) -> Any:
    """A module that not everyone has."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"{use} needs {module}, which is not there: pip install {module}", name=module) from error


def program() -> str:
    """Path of the program: GUDGEON in the environment, else beside the package, on PATH, or in build/ of this checkout."""
    named = os.environ.get("GUDGEON")
    if named:
        return named
    here = pathlib.Path(__file__).resolve().parent
    beside = [here / "../bin", sysconfig.get_path("scripts"), here / "../../../../bin"]  # pip --target, pip, make install
    for path in (*(f"{folder}/gudgeon" for folder in beside), shutil.which("gudgeon") or "", f"{here}/../../../build/gudgeon"):
        if os.path.isfile(path) and os.access(path, os.X_OK):
            return os.path.realpath(path)
    raise FileNotFoundError("the program gudgeon is not found: name it by GUDGEON in the environment, or put it on PATH")


def words_of(options: Mapping[str, Any]) -> list[str]:
    """Options as words: `method="bdf"` is --method bdf, `ideal=True` is --ideal, a list is one word; None and False are omitted."""
    words = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        words.append("--" + name.replace("_", "-"))
        if value is not True:
            words.append(" ".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value))
    return words


def call(
    verb: str, deck: str | os.PathLike[str] | Deck, values: Mapping[str, Any] | None, out: str | os.PathLike[str] | None,
    progress: Progress, options: Mapping[str, Any], files: Sequence[str | os.PathLike[str]] = (),
) -> tuple[int, str, dict[str, Any]]:
    """Exit code, message and summary ({} if there is none) of `gudgeon VERB DECK FILES`; its directory in the summary is absolute."""
    text, folder, name = None, None, str(deck)
    values = dict(values or {})
    if isinstance(deck, Deck):
        text, values = deck.having(**values).parts()
        folder, name = deck.folder, f"{deck.name}.deck"
        out = out or pathlib.Path("outputs", deck.name + ("_precision" if verb == "precision" else ""))
    command = [program(), verb, "/dev/stdin" if text is not None else name, *map(os.path.abspath, files), "--json"]
    command += [word for key, value in values.items() for word in ("--set", f"{key}={spelled(value)}")]
    command += words_of({"out": os.path.abspath(out) if out else None, **options})
    said = []
    with tempfile.TemporaryFile("w+", encoding="utf-8") as told, subprocess.Popen(
        command, cwd=folder, stdin=subprocess.DEVNULL if text is None else subprocess.PIPE, stdout=told, stderr=subprocess.PIPE,
        encoding="utf-8", errors="replace",
    ) as process:
        try:
            if process.stdin:
                with contextlib.suppress(BrokenPipeError):  # it has ended before, and says why
                    process.stdin.write(text or "")
                with contextlib.suppress(BrokenPipeError):
                    process.stdin.close()
            for line in process.stderr or ():
                if not line.startswith("progress "):
                    said.append(line)
                elif progress:
                    (progress if callable(progress) else lambda text: print(text, file=sys.stderr))(line.strip())
        except BaseException:
            process.terminate()  # a motion is saved
            raise
        code = process.wait()
        told.seek(0)
        summary = json.loads(told.read() or "{}")
    if summary:
        summary["directory"] = os.path.abspath(summary["directory"])
    message = "".join(said).strip().replace("/dev/stdin", name)
    if code and not message:
        message = summary.get("message") or (f"ended by signal {-code}" if code < 0 else f"ended with exit code {code}")
    return code, message[len(DIAGNOSED):] if message.startswith(DIAGNOSED) else message, summary
