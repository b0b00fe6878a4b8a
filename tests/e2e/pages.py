"""Decks and commands of the pages in docs/tutorials, docs/how-to and docs/reference, run as a reader would.

The first word after a fence says what is in it, the others how it is run:

    deck NAME.deck        a deck: written to NAME.deck in the page's directory, where `inputs` is that of the sources
    deck                  tables of a deck (pages of the reference): the program must know each table, column and key
    LANGUAGE NAME         any other file, also `text NAME`
    sh [exit=N]           commands, run in that directory, one a line; the last one ends with exit code N (0)
    sh needs=NAME         run where this program or Python package is installed, else listed
    sh elsewhere          not run: what needs a cluster or a program with a window is listed
    text                  lines of the output of the commands before, in their order; `...` stands for anything

As a program it runs pages and prints what their commands say:  python3 -B tests/e2e/pages.py [--figures] PROGRAM PAGE...
`--figures` takes their pictures, `![...](figures/RUN.FIGURE.png)`, from outputs/RUN/figures/FIGURE.png of these runs.
"""

import dataclasses
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FOLDERS = ("docs/tutorials", "docs/how-to")
PAGES = sorted(page for folder in FOLDERS for page in (ROOT / folder).glob("*.md") if page.name != "index.md")
REFERENCE = [ROOT / "docs/reference" / f"{name}.md" for name in ("batch", "compare", "deck", "import", "output", "precision", "space")]
UNKNOWN = re.compile(r"^error: .*(?:unknown (?:table|column|key|section|type|unit)|not a (?:column|key|table)).*", re.M)  # of a fragment
MOST_WORDS = 25  # of a sentence
TOLERANCE = 0.02  # of a number in a line of output; digits that change from one processor or compiler to another are shown as `...`
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?!\w|\.\d)", re.I)


@dataclasses.dataclass
class Fence:
    """What stands between two lines of three backticks."""

    line: int
    words: list
    text: str

    @property
    def kind(self):
        """The first word."""
        return self.words[0] if self.words else ""

    def option(self, name):
        """The value of a word NAME=VALUE."""
        return next((word.split("=", 1)[1] for word in self.words if word.startswith(f"{name}=")), None)

    @property
    def is_run(self):
        """Whether its commands are run on this machine."""
        needed = self.option("needs")
        is_there = needed is None or shutil.which(needed) is not None or importlib.util.find_spec(needed) is not None
        return self.kind == "sh" and "elsewhere" not in self.words and is_there

    @property
    def commands(self):
        """Its commands, without comments; a backslash at the end of a line continues it."""
        lines = self.text.replace("\\\n", " ").splitlines()
        return [line for line in (re.sub(r"(^|\s)#.*", "", line).strip() for line in lines) if line]


def fences(text):
    """All fences of a page."""
    found = []
    for match in re.finditer(r"^```([^\n`]*)\n(.*?)^```$", text, re.M | re.S):
        found.append(Fence(text.count("\n", 0, match.start()) + 1, match[1].split(), match[2]))
    return found


def prose(text):
    """A page without its fences."""
    return re.sub(r"^```[^\n`]*\n.*?^```$", "", text, flags=re.M | re.S)


def long_sentences(text):
    """Sentences of a page with more than MOST_WORDS words, headings and tables apart; a formula or code within a line is a word."""
    text = re.sub(r"\$[^$\n]+\$", "formula", re.sub(r"\$\$.*?\$\$", "", prose(text), flags=re.S))
    text = re.sub(r"`[^`]*`", "code", re.sub(r"^(?:\||#).*$", "", text, flags=re.M))
    for block in re.split(r"\n\s*\n|\n(?=- |\d+\. )", re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)):
        for sentence in re.split(r"(?<=[.?!])\s+(?=\S)", " ".join(block.split())):
            if len(sentence.split()) > MOST_WORDS:
                yield sentence


def pictures(text):
    """(path, run, figure) of each picture of a page."""
    return [(path, *pathlib.PurePath(path).stem.split(".", 1)) for path in re.findall(r"!\[[^\]]*\]\(([^)]+\.png)\)", text)]


def is_same(word, said):
    """Whether a word of a page is this word of the output: numbers within TOLERANCE; `...` at an end stands for the rest."""
    if word.endswith("..."):
        return said.startswith(word[:-3])
    if word.startswith("..."):
        return said.endswith(word[3:])
    a, b = NUMBER.findall(word), NUMBER.findall(said)
    is_near = len(a) == len(b) and all(abs(float(x) - float(y)) <= TOLERANCE * abs(float(x)) for x, y in zip(a, b))
    return is_near and NUMBER.sub("#", word) == NUMBER.sub("#", said)


def is_shown(words, said):
    """Whether the words of a line of a page are those of a line of output; `...` stands for any words."""
    if not words or words[0] == "...":
        return not words and not said or bool(words) and any(is_shown(words[1:], said[k:]) for k in range(len(said) + 1))
    return bool(said) and is_same(words[0], said[0]) and is_shown(words[1:], said[1:])


def missing(shown, said):
    """The first line of a text fence that the output does not have, in this order; None if it has all."""
    said = iter(said.splitlines())
    for line in shown.splitlines():
        if line.strip() not in ("", "...") and not any(is_shown(line.split(), other.split()) for other in said):
            return line
    return None


def environment(program, directory):
    """The program, this Python and the package gudgeon are found as if they were installed."""
    programs = directory / ".programs"
    programs.mkdir()
    (programs / "gudgeon").symlink_to(pathlib.Path(program).resolve())
    (programs / "python3").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n', encoding="utf-8")  # a link leaves its environment
    (programs / "python3").chmod(0o755)
    path = f"{programs}:{os.environ['PATH']}"
    return {**os.environ, "PATH": path, "PYTHONPATH": str(ROOT / "scripts/python"), "GUDGEON": str(pathlib.Path(program).resolve()),
            "PYTHONDONTWRITEBYTECODE": "1", "LC_ALL": "C.UTF-8"}


class Failure(AssertionError):
    """What a page says is not what happens."""


def check_fragment(fence, directory, surroundings):
    """What the program says of tables that are no whole deck."""
    text = fence.text if "deck = 1" in fence.text else f"deck = 1\n{fence.text}"
    path = directory / f"fragment_{fence.line}.deck"
    path.write_text(text, encoding="utf-8")
    done = subprocess.run(["gudgeon", "check", path.name], cwd=directory, env=surroundings, text=True, timeout=60, errors="replace",
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    return done.stdout


def run_page(page, program, directory, echo=lambda text: None):
    """Write the files of a page and run its commands, in their order; the number of commands."""
    surroundings, said, n = environment(program, directory), None, 0
    (directory / "inputs").symlink_to(ROOT / "inputs")
    for fence in fences(page.read_text(encoding="utf-8")):
        where = f"{page.name}:{fence.line}"
        if fence.words == ["text"]:
            line = None if said is None else missing(fence.text, said)
            if line is not None:
                raise Failure(f"{where}: the output has no line `{line}`:\n{said[-6000:]}")
        elif fence.kind == "sh":
            commands, said = (fence.commands, "") if fence.is_run else ([], None)
            for command in commands:
                n += 1
                expected = int(fence.option("exit") or 0) if command == commands[-1] else 0
                done = subprocess.run(["bash", "-c", command], cwd=directory, env=surroundings, text=True, timeout=600,
                                      errors="replace", stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                      stderr=subprocess.STDOUT, check=False)
                said += done.stdout
                echo(f"$ {command}\n{done.stdout}")
                if done.returncode != expected:
                    raise Failure(f"{where}: exit code {done.returncode}, not {expected}: {command}\n{done.stdout[-3000:]}")
        elif fence.words == ["deck"]:
            n += 1
            wrong = UNKNOWN.findall(check_fragment(fence, directory, surroundings))
            if wrong:
                raise Failure(f"{where}: {wrong[0]}")
        elif fence.words:
            path = directory / fence.words[1]
            path.parent.mkdir(exist_ok=True)
            path.write_text(fence.text, encoding="utf-8")
    return n


def main():
    """Run pages and print their commands with what these say."""
    takes_figures = "--figures" in sys.argv
    program, *pages = [word for word in sys.argv[1:] if word != "--figures"]
    for page in map(pathlib.Path, pages):
        with tempfile.TemporaryDirectory() as directory:
            n = run_page(page, program, pathlib.Path(directory), print)
            print(f"{page.name}: {n} commands")
            for path, run, figure in pictures(page.read_text(encoding="utf-8")) if takes_figures else ():
                target = page.parent / path
                target.parent.mkdir(exist_ok=True)
                shutil.copy(pathlib.Path(directory) / "outputs" / run / "figures" / f"{figure}.png", target)


if __name__ == "__main__":
    main()
