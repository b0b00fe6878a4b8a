"""What decks may say, asked of the program itself: its kinds, their columns and words; and changes of decks made of them."""

import pathlib
import random
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from mutants import EXPRESSIONS, NUMBERS, UNITS, WORDS, Mutator, mangled, split_sections, with_noise  # noqa: E402

HEADING = re.compile(r"(?m)^## (\S+)$")
KEY = re.compile(r"(?m)^  (\w+) +(.*)$")
NAME_LENGTHS = (59, 60, 61, 10000)


class Key:
    """A column of a table or a key of a section, as the manual tells it."""

    def __init__(self, name, told):
        self.name = name
        unit = re.search(r"\[([^\]]+)\]", told)
        self.unit = unit.group(1) if unit else None
        self.is_name = "(name from" in told
        groups = re.findall(r"\(([a-z_0-9]+(?: [a-z_0-9]+)*)\)", told)
        self.choices = groups[-1].split() if groups and not self.is_name else []
        options = re.search(r"options ([\w ]+);", told)
        self.options = options.group(1).split() if options else []
        self.is_required = told.endswith("required")


class Kind:
    """A section of a deck."""

    def __init__(self, name, told):
        self.name = name
        block = re.search(r"(columns \(besides name\)|keys):\n((?:  .*\n)*)", told)
        self.is_table = bool(block) and block.group(1) != "keys"
        self.keys = [Key(*pair) for pair in KEY.findall(block.group(2))] if block else []


def kinds_of(program):
    """All kinds of sections that the program knows; those of plane and of space are two of one name."""
    manual = subprocess.run([str(program), "help", "--manual"], capture_output=True, text=True, check=True, timeout=60).stdout
    parts = HEADING.split(manual)
    kinds = [Kind(name, told) for name, told in zip(parts[1::2], parts[2::2])]
    found = [kind for kind in kinds if kind.keys]
    assert len(found) > 20, "the manual does not look as expected"
    return found


class GuidedMutator(Mutator):
    """Changes decks with the words of the program, and crosses them with others that led to new places."""

    def __init__(self, seed, kinds):
        super().__init__(seed)
        self.kinds = kinds

    def changed(self, number, text, other):
        """A text with some changes, as bytes; `other` is one to cross it with."""
        dice = random.Random(f"{self.seed} {number}")
        for _ in range(dice.choice([1, 1, 1, 2, 2, 3, 4, 8])):
            what = dice.randrange(12)
            if what < 5:
                text = self.mutated(dice, text)
            elif what < 7:
                text = self.with_section(dice, text)
            elif what < 10:
                text = self.with_word(dice, text)
            else:
                text = crossed(dice, text, other)
        data = text.encode("utf-8", "surrogatepass" if dice.random() < 0.5 else "replace")
        return with_noise(dice, data) if dice.random() < 0.03 else data

    def with_section(self, dice, text):
        """A section comes in, or takes the place of another of its kind, with any of its keys."""
        kind = dice.choice(self.kinds)
        names = re.findall(r"(?m)^\s*([A-Za-z_]\w*)\s+\S", text) or ["a"]
        keys = [key for key in kind.keys if key.is_required or dice.random() < dice.choice([0.1, 0.5, 0.9])]
        if kind.is_table:
            rows = ["name " + " ".join(header_cell(dice, key) for key in keys)]
            rows += [" ".join([a_name(dice), *(self.cell(dice, key, names, False) for key in keys)]) for _ in range(dice.choice([0, 1, 1, 2, 5]))]
        else:
            rows = [f"{key.name} = {self.cell(dice, key, names, True)}" for key in keys]
        section = f"[{kind.name}]\n" + "\n".join(rows) + "\n\n"
        parts = split_sections(text)
        same = [i for i, part in enumerate(parts) if part.lstrip().startswith(f"[{kind.name}]")]
        if same and dice.random() < 0.7:
            parts[dice.choice(same)] = section
        else:
            parts.insert(dice.randrange(1, len(parts) + 1), section)
        return "".join(parts)

    def cell(self, dice, key, names, with_unit):
        """A value for a key: mostly one of its sort."""
        luck = dice.random()
        if luck < 0.05:
            return dice.choice(EXPRESSIONS)
        if luck < 0.1:
            return dice.choice(WORDS) or '""'
        if key.is_name or (luck < 0.2 and not key.unit):
            return dice.choice(names)
        if key.choices and luck < 0.95:
            word = dice.choice(key.choices)
            if key.options and dice.random() < 0.5:
                word += f" {dice.choice(key.options)}={dice.choice(NUMBERS)}"
            return word if with_unit or " " not in word else f'"{word}"'
        number = dice.choice(NUMBERS) or "0" if luck < 0.5 else f"{dice.uniform(0, 2):.3g}"
        if key.unit and with_unit:
            number += " " + (key.unit if dice.random() < 0.9 else dice.choice(UNITS))
        return number

    def with_word(self, dice, text):
        """A key comes in at its section, or a word becomes a key, a choice or the name of a kind."""
        kind = dice.choice(self.kinds)
        key = dice.choice(kind.keys)
        present = list(re.finditer(rf"(?m)^\s*\[{re.escape(kind.name)}\].*\n", text))
        names = re.findall(r"(?m)^\s*([A-Za-z_]\w*)\s+\S", text) or ["a"]
        if present and not kind.is_table:
            at = dice.choice(present).end()
            return f"{text[:at]}{key.name} = {self.cell(dice, key, names, True)}\n{text[at:]}"
        if present and dice.random() < 0.8:
            return with_column(dice, text, dice.choice(present).end(), header_cell(dice, key), lambda: self.cell(dice, key, names, False))
        places = list(re.finditer(r"[A-Za-z_][\w.]*", text))
        if not places:
            return text
        place = dice.choice(places)
        new = dice.choice([kind.name, key.name, *key.choices, a_name(dice), mangled(dice, place.group())])
        return text[: place.start()] + new + text[place.end():]


def header_cell(dice, key):
    """The head of a column, with its unit, none, or a wrong one."""
    if not key.unit:
        return key.name
    luck = dice.random()
    return key.name if luck < 0.05 else f"{key.name}[{key.unit if luck < 0.9 else dice.choice(UNITS)}]"


def a_name(dice):
    """A name of an item: short mostly, at times as long as names may be, or much longer."""
    if dice.random() < 0.9:
        return dice.choice("abcdefgh") + str(dice.randrange(20))
    return "n" * dice.choice(NAME_LENGTHS) if dice.random() < 0.3 else dice.choice(WORDS) or "x"


def with_column(dice, text, begin, head, cell):
    """A column comes to the table whose rows begin there."""
    end = re.compile(r"(?m)^\s*\[|\Z").search(text, begin).start()
    lines = text[begin:end].split("\n")
    full = [i for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith("#")]
    for number, i in enumerate(full):
        lines[i] += " " + (head if number == 0 else cell())
    if dice.random() < 0.1 and full:
        lines[dice.choice(full)] += " " + cell()
    return text[:begin] + "\n".join(lines) + text[end:]


def crossed(dice, text, other):
    """Sections of two decks together, or the first part of one with the last of the other."""
    mine, theirs = split_sections(text), split_sections(other)
    if dice.random() < 0.5 and len(theirs) > 1:
        mine.insert(dice.randrange(1, len(mine) + 1), dice.choice(theirs[1:]))
        return "".join(mine)
    return "".join(mine[: dice.randrange(len(mine) + 1)] + theirs[dice.randrange(len(theirs)) :])
