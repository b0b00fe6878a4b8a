"""Broken decks from good ones: every mutant follows from the seed, its number and the decks alone."""

import pathlib
import random
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FOLDERS = ("inputs", "inputs/hard", "inputs/studies", "tests/fuzz/seeds")

NUMBERS = [
    "0", "-0", "-1", "1", "2", "0.5", "nan", "NaN", "inf", "-inf", "1e308", "-1e308", "1e-308", "4.9e-324", "1e400", "1e154", "1e-154",
    "1e30", "1e-30", "99999999999999999999", "2147483647", "2147483648", "-2147483649", "9223372036854775808", "1000000", "0x10", "1,5",
    "1.", ".5", ".", "-", "+", "--1", "1e", "1e+", "1d3", "", "\u22121", "\u00bd", "1_000", "1e-9", "1e9", "3.14159", "90", "180", "360",
]
UNITS = [
    "", "m", "mm", "um", "kg", "g", "s", "ms", "us", "N", "kN", "rad", "deg", "rpm", "Hz", "m/s", "m/s^2", "N/m", "N/m^1.5", "N.s/m", "Pa",
    "GPa", "J", "W", "kg.m^2", "rad/s", "rad/s^2", "1", "K", "degC", "K/m", "m^999", "m^-999", "m^1e308", "^2", "m^", "/s", "m/", "m//s",
    "\u00b5m", "\u00b0", "kg.m^2/s^2", "(m", "m)", "mm^0.3333", "s^-1", "N.m/rad",
]
EXPRESSIONS = [
    "{0}", "{1/0}", "{0/0}", "{t}", "{1m*t/1s}", "{sqrt(-1)}", "{log(0)}", "{log(-1)}", "{asin(2)}", "{acos(2)}", "{0^0}", "{0^-1}",
    "{(-1)^0.5}", "{exp(1000)}", "{exp(-1000)}", "{10^400}", "{1e200*1e200}", "{1e-200*1e-200}", "{tan(pi/2)}", "{atan2(0,0)}", "{min()}",
    "{max(1)}", "{abs()}", "{step(0)}", "{step(t)}", "{}", "{ }", "{{}}", "{(}", "{)}", "{1+}", "{+1}", "{--1}", "{1 2}", "{1m}",
    "{1m + 1s}", "{sin(1m)}", "{sin}", "{nothing}", "{t(1)}", "{pi}", "{pi()}", "{1;2}", "{a=1}", "{x}", "{cosh(800)}", "{sinh(1e9)}",
    "{1mm^0.5}", "{(1m)^(1s)}", "{2^(1m)}", "{(1m)^0.5}", "{1m^1e308}", "{min(1m,1s)}", "{atan2(1m,1s)}",
    "{" + "(" * 300 + "1" + ")" * 300 + "}", "{" + "1+" * 400 + "1}", "{" + "-" * 300 + "1}", "{" + "sin(" * 200 + "1" + ")" * 200 + "}",
]
WORDS = [
    "", "-", "none", "ground", "*", "*.*", "a.b", "x", "y", "name", "energy", "energy.*", "t", "on", "off", "\u00fc", "\u4e2d", "\u202e", "a" * 31,
    "a" * 200, "a" * 5000, "-a", "1a", "a/b", "../x", "a b", "=", "{", "}", "\"", "\"\"", "\"a", "[", "]", "#", "!", "\\", "'", "%s%n", "\0",
    "ideal", "clearance", "periodic", "error", "hold", "linear", "baumgarte alpha=5s^-1", "baumgarte alpha=", "2 turns of motor",
    "0 turns of motor", "-1 turns of motor", "1e300 turns of motor", "2 turns of nothing", "2 turns", "1 .. 5 in 3", "1 .. 5 mm in 0",
    "1 .. 5 mm in 1000000000", "0 .. 1 in 3 geometric", "-1 .. 1 in 3 geometric", "rk4", "ida", "bdf", "adams", "static", "given", "preload", "book",
    "blend", "foundation", "corners",
]
METHODS = ["verner", "dop853", "rk4", "rock4", "radau", "adams", "bdf", "ida"]


def seeds():
    """The decks that mutants are made of, found by themselves: name and text of each."""
    found = sorted(path for folder in FOLDERS for path in (ROOT / folder).glob("*.deck"))
    return [(path.relative_to(ROOT).as_posix(), path.read_text()) for path in found]


def companions():
    """Files that decks read, by their place in the tree."""
    paths = [path for folder in FOLDERS for path in (ROOT / folder).glob("*") if path.is_file()]
    return {path.relative_to(ROOT).as_posix(): path.read_bytes() for path in sorted(paths)}


class Mutator:
    """Makes mutant number k of a seed."""

    def __init__(self, seed):
        self.seed = seed
        self.decks = seeds()
        lines = [line for _, text in self.decks for line in text.splitlines() if line.strip() and not line.startswith("#")]
        self.lines = lines
        self.sections = [section for _, text in self.decks for section in split_sections(text)[1:]]

    def mutant(self, k):
        """Name of the deck that it was made of, and its text as bytes."""
        dice = random.Random(f"{self.seed} {k}")
        name, text = dice.choice(self.decks)
        for _ in range(dice.choice([1, 1, 1, 1, 1, 2, 2, 3, 6])):
            text = self.mutated(dice, text)
        data = text.encode("utf-8", "surrogatepass")
        if dice.random() < 0.03:
            data = with_noise(dice, data)
        return name, data

    def mutated(self, dice, text):
        """One change of a deck's text."""
        change = dice.choices(
            [self.change_cell, self.change_line, self.change_section, self.change_number, self.change_unit, self.swap_names, self.change_text],
            [5, 3, 2, 9, 2, 2, 1],
        )[0]
        return change(dice, text)

    def change_cell(self, dice, text):
        """A cell is deleted, doubled, swapped with another, or becomes something else."""
        lines = text.split("\n")
        at = content_line(dice, lines)
        if at is None:
            return text
        cells = re.findall(r'\{[^}]*\}|"[^"]*"|\S+|\s+', lines[at])
        full = [i for i, cell in enumerate(cells) if cell.strip()]
        if not full:
            return text
        i, j = dice.choice(full), dice.choice(full)
        what = dice.randrange(7)
        if what == 0:
            cells[i] = ""
        elif what == 1:
            cells[i] = cells[i] + " " + cells[i]
        elif what == 2:
            cells[i], cells[j] = cells[j], cells[i]
        elif what == 3:
            cells[i] = dice.choice(NUMBERS) + dice.choice(["", "", dice.choice(UNITS)])
        elif what == 4:
            cells[i] = dice.choice(EXPRESSIONS)
        elif what == 5:
            cells[i] = dice.choice(WORDS)
        else:
            cells[i] = mangled(dice, cells[i])
        lines[at] = "".join(cells)
        return "\n".join(lines)

    def change_line(self, dice, text):
        """A line is deleted, doubled, moved, swapped, cut short, or one of another deck comes in."""
        lines = text.split("\n")
        i, j = dice.randrange(len(lines)), dice.randrange(len(lines))
        what = dice.randrange(6)
        if what == 0:
            del lines[i]
        elif what == 1:
            lines.insert(i, lines[i])
        elif what == 2:
            lines[i], lines[j] = lines[j], lines[i]
        elif what == 3:
            lines[i] = lines[i][: dice.randrange(len(lines[i]) + 1)]
        elif what == 4:
            lines.insert(i, dice.choice(self.lines))
        else:
            lines[i] = dice.choice(self.lines)
        return "\n".join(lines)

    def change_section(self, dice, text):
        """A section is deleted, doubled, swapped, renamed, or one of another deck comes in."""
        parts = split_sections(text)
        if len(parts) < 3:
            return text
        i, j = dice.randrange(1, len(parts)), dice.randrange(1, len(parts))
        what = dice.randrange(6)
        if what == 0:
            del parts[i]
        elif what == 1:
            parts.insert(j, parts[i])
        elif what == 2:
            parts[i], parts[j] = parts[j], parts[i]
        elif what == 3:
            parts.insert(i, dice.choice(self.sections))
        elif what == 4:
            parts[i] = dice.choice(self.sections)
        else:
            parts[i] = re.sub(r"^\s*\[[^\]\n]*\]", re.match(r"\s*\[[^\]\n]*\]|", dice.choice(self.sections)).group().replace("\\", ""), parts[i])
        return "".join(parts)

    def change_number(self, dice, text):
        """A number becomes another one."""
        places = list(re.finditer(r"(?<![\w.])-?\d+(\.\d*)?(e-?\d+)?", text))
        if not places:
            return text
        place = dice.choice(places)
        new = dice.choice(NUMBERS)
        if dice.random() < 0.5:
            try:
                new = repr(float(place.group()) * dice.choice([-1.0, 0.0, 0.1, 10.0, 1e3, 1e-3, 1e6, 1e-6, 1e12, 1e-12]))
            except ValueError:
                pass
        return text[: place.start()] + new + text[place.end():]

    def change_unit(self, dice, text):
        """A unit in brackets or behind a number becomes another one."""
        places = list(re.finditer(r"(?<=\w\[)[^\]\n]*(?=\])|(?<=\d )[a-zA-Z][\w./^-]*|(?<=\d)[a-zA-Z][\w./^-]*", text))
        if not places:
            return text
        place = dice.choice(places)
        return text[: place.start()] + dice.choice(UNITS) + text[place.end():]

    def swap_names(self, dice, text):
        """Two words of the deck change places, once or everywhere; or one takes the other's name."""
        words = sorted(set(re.findall(r"\b[A-Za-z_]\w+", text)))
        if len(words) < 2:
            return text
        one, other = dice.sample(words, 2)
        if dice.random() < 0.2:
            other = dice.choice(["\u00fcber", "\u66f2\u67c4", "na\u00efve", "\u0394", "e\u0301", "a" * 64, "bob-2", "_"])
        if dice.random() < 0.5:
            return re.sub(rf"\b{one}\b", lambda _: other, text)
        places = list(re.finditer(rf"\b{one}\b", text))
        place = dice.choice(places)
        return text[: place.start()] + other + text[place.end():]

    def change_text(self, dice, text):
        """The deck ends early, or a few characters are other ones."""
        if dice.random() < 0.4:
            return text[: dice.randrange(len(text) + 1)]
        return mangled(dice, text)


def split_sections(text):
    """A deck cut before each section header."""
    return re.split(r"(?m)^(?=\s*\[)", text)


def content_line(dice, lines):
    """Number of a line that is no comment, if there is one."""
    full = [i for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith("#")]
    return dice.choice(full) if full else None


def mangled(dice, text):
    """A text with a few characters deleted, doubled or other ones."""
    signs = "{}[]()\"'#=.,;:!?-+*/^ \t\r\n\\0123456789eEdDxXaA_\u2212\u00e9\u4e2d\u200b\ufeff"
    for _ in range(dice.randrange(1, 4)):
        if not text:
            return dice.choice(signs)
        at = dice.randrange(len(text))
        text = text[:at] + dice.choice(["", text[at] * 2, dice.choice(signs), dice.choice(signs) + text[at]]) + text[at + 1:]
    return text


def with_noise(dice, data):
    """Bytes with a few random ones."""
    data = bytearray(data)
    for _ in range(dice.randrange(1, 6)):
        data.insert(dice.randrange(len(data) + 1), dice.randrange(256))
    return bytes(data)


def shortened(data):
    """A mutant that runs in no time: its motion ends early, with few output instants, unless the mutation touched just that."""
    text = data.decode("utf-8", "surrogateescape")
    text = re.sub(r"(?m)^(\s*end\s*=\s*)\d[\d.]*\s*(s|ms)\s*(#.*)?$", r"\g<1>2 ms", text)
    text = re.sub(r"(?m)^(\s*end\s*=\s*)\d[\d.]*\s*turns of \w+\s*(#.*)?$", r"\g<1>2 ms", text)
    text = re.sub(r"(?m)^(\s*after\s*=\s*)\d[\d.]*.*$", r"\g<1>0.5 ms", text)
    text = re.sub(r"(?m)^(\s*period\s*=\s*)\d[\d.]*.*$", r"\g<1>0.1 ms", text)
    text = re.sub(r"(?m)^(\s*every\s*=\s*)\d[\d.]*\s*(s|ms|us)\s*(#.*)?$", r"\g<1>0.1 ms", text)
    return text.encode("utf-8", "surrogateescape")
