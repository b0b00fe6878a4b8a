"""Decks as text, with values that are still open."""

from __future__ import annotations

import os
import pathlib
import re
from typing import Any

NAME = re.compile(r"\$(?:([A-Za-z_]\w*)|\{([A-Za-z_]\w*)\})")


def spelled(value: Any) -> str:
    """A value as a deck has it: numbers and texts as they are, True and False as on and off."""
    return {True: "on", False: "off"}[value] if isinstance(value, bool) else str(value)


class Deck:
    """A deck as text.

    `values` replace `$name` and `${name}`, anywhere in the text; those that the text does not have are values of the deck's own
    parameters, as `--set`. Files that it includes are relative to `folder`; results go to `outputs/NAME`.

        crank = gudgeon.Deck.read("crank.deck")
        gudgeon.run(crank.having(c="0.1 mm"))
        gudgeon.Deck('deck = 1\\ninclude "crank.deck"\\n[analysis.dynamic]\\nend = $end\\n', end="5 ms")
    """

    def __init__(self, text: str, folder: str | os.PathLike[str] = ".", name: str = "deck", **values: Any):
        self.text, self.folder, self.name, self.values = text, pathlib.Path(folder), name, values

    @classmethod
    def read(cls, path: str | os.PathLike[str], **values: Any) -> Deck:
        """A deck of a file, named like it."""
        path = pathlib.Path(path)
        return cls(path.read_text(encoding="utf-8"), path.parent, path.stem, **values)

    def having(self, **values: Any) -> Deck:
        """The same deck with further values, or other ones."""
        return Deck(self.text, self.folder, self.name, **{**self.values, **values})

    def parts(self) -> tuple[str, dict[str, Any]]:
        """The text without `$name`, and the values of the deck's own parameters; a `$name` without value is a KeyError."""
        names = set()

        def inserted(found: re.Match[str]) -> str:
            names.add(found[1] or found[2])
            return spelled(self.values[found[1] or found[2]])

        text = NAME.sub(inserted, self.text)
        return text, {name: value for name, value in self.values.items() if name not in names}
