"""The pages of docs/reference that come from the program: what it says of itself, headers of the kinds' files, small decks."""

import collections
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PLACE = ROOT / "docs/reference"
MARK = "<!-- Made by `make docs` from the program: do not edit. -->"
# groups of which a deck has several tables, and the parameter that names the one of an example
CHOSEN = {"contact": "law", "friction": "friction", "film": "film", "wear": "wear", "integrator": "method"}

Column = collections.namedtuple("Column", "name meaning value limits default")
Section = collections.namedtuple("Section", "space about head heading columns channels")


def cell(text):
    """Text in a cell of a table."""
    parts = re.split(r"(`[^`]*`)", text)
    return "".join(
        part.replace("|", r"\|") if part.startswith("`") else re.sub(r"([\\*_<>|\[\]$~])", r"\\\1", part) for part in parts
    )


def table(heads, rows):
    """A table of Markdown."""
    return "\n".join("| " + " | ".join(row) + " |" for row in [heads, ["---"] * len(heads), *rows])


def anchor(heading):
    """The anchor of a heading, as forges and Sphinx make it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def column_of(line):
    """A column or key, from its line."""
    name, text = line.split(None, 1)
    found = re.fullmatch(
        r"(?P<meaning>.*?)(?: (?P<value>\[[^\[\]]*\]|\([^()]*\)))?(?P<options>; options [^;]*)?"
        r"(?P<limits>(?:; (?:>|>=|<|<=|not) +[^;]*)*)(?:; (?:(?P<required>required)|default (?P<default>.*)))?",
        text,
    )
    default = "required" if found["required"] else f"`{found['default']}`" if found["default"] else ""
    value = (found["value"] or "").strip("[]()") + (found["options"] or "")
    return Column(name, found["meaning"], value, found["limits"].strip("; ").replace(";", ",").replace("  ", " "), default)


def channel_of(line):
    """A channel, from its line."""
    return Column(*re.fullmatch(r"(\S+) +(.*) \[(.*)\]", line.strip()).groups(), "", "")


def header_of(kind, space):
    """The header of the file of a kind: its equations, signs, source and limits."""
    group, _, last = kind.partition(".")
    files = [
        path for path in sorted((ROOT / "src").glob("*/*/*.f90")) if f'info%name = "{kind}"' in path.read_text(encoding="utf-8")
    ]
    files = [
        path
        for path in files
        if space == bool(re.search("in_space|use spatial_joint, only|use spatial_driver", path.read_text("utf-8")))
    ]
    names = (kind.replace(".", "_"), f"law_{last}", last if group == "integrator" else "")
    files += [path for name in names for path in sorted((ROOT / "src").glob(f"*/*/{name}.f90"))] if last else []
    lines = files[0].read_text(encoding="utf-8").splitlines() if files else []
    n = next((k for k, line in enumerate(lines) if not line.startswith("!>")), 0)
    return "\n".join(re.sub("^!> ?", "", line) for line in lines[:n])


def section_of(kind, body):
    """What the manual says of a kind in one of the spaces."""
    words, _, block = body.partition("```\n")
    space = words.strip().startswith("In space: ")
    about, *more = words.strip().removeprefix("In space: ").splitlines()
    columns, channels, heading = [], [], "Keys" if block.startswith("keys:") else "Columns"
    for line in block.partition("```")[0].splitlines():
        if not line.startswith(" "):
            target = channels if line == "channels:" else columns
        else:
            target.append((channel_of if target is channels else column_of)(line))
    head = header_of(kind, space)
    return Section(
        space, about, ([f"```text\n{head}\n```"] if head else []) + [cell(line) for line in more], heading, columns, channels
    )


class Manual:
    """All that the program says of itself."""

    def __init__(self, program):
        text = subprocess.run([program, "help", "--manual"], capture_output=True, text=True, check=True).stdout
        parts = re.split(r"^## (.*)\n", text, flags=re.M)
        self.version = re.search(r"^# Manual of gudgeon (\S+)$", text, re.M)[1]
        self.usage = parts[0].partition("```\n")[2].partition("```")[0]
        self.tables, self.blocks = {}, {}
        for kind, body in zip(parts[1::2], parts[2::2]):
            if " " in kind or kind == "functions":
                self.blocks[kind] = body.strip()
            else:
                self.tables.setdefault(kind, []).append(section_of(kind, body))
        self.decks = {path.name: path.read_text(encoding="utf-8") for path in sorted((PLACE / "decks").glob("*.deck"))}

    def verbs(self):
        """(verb, line of use, help)."""
        return re.findall(r"^  gudgeon ((\S+)(?: [A-Z]+| \[\w+\])*(?: \[OPTION\]\.\.\.)?) +(.*)$", self.usage, re.M)

    def options(self):
        """(option, help, verbs that take it)."""
        found = re.findall(r"^  (--.*?)(?:  +| (?=[a-z]+ (?!.*  )))(.*) \(([a-z ]+)\)$", self.usage.split("Options")[1], re.M)
        assert len(found) == self.usage.count("\n  --"), "an option is not understood"
        return [(name, words, takers.split()) for name, words, takers in found]

    def deck_with(self, kind, space):
        """The deck named after a table or its group, else the shortest that has it; of several laws of a group only this."""
        group, _, last = kind.partition(".")
        sign = {"integrator": rf"\nmethod *= (?:{last}|{{method}})\n", "energy": r" energy\."}.get(
            group, rf"\n\[{re.escape(kind)}\]"
        )
        own, ours = (kind, f"{kind}.space"), (group, f"{group}.space")
        for name in sorted(self.decks, key=lambda n: (n[:-5] not in own, n[:-5] not in ours, self.decks[n].count("\n"), n)):
            deck = self.decks[name]
            if re.search(sign, deck) and (space is None or space == ("spatial" in deck)):
                if re.search(rf"(?m)^{CHOSEN.get(group)} *= ", deck):
                    kept = [
                        part
                        for part in re.split(r"(?m)^(?=\[)", deck)
                        if not part.startswith(f"[{group}.") or part.startswith(f"[{kind}]")
                    ]
                    deck = re.sub(rf"(?m)^({CHOSEN[group]} *= ).*$", rf"\g<1>{last}", "".join(kept), count=1)
                return deck
        return ""


def rows_of(manual, columns):
    """Rows of the columns of a table; names of other tables are links."""

    def value(column):
        words = cell(column.value)
        if not column.value.startswith("name from "):
            return words
        return "name from " + " ".join(
            f"[{cell(name)}]({name}.md)" if name in manual.tables else f"[{name}*](index.md#{name.strip('.')})"
            for name in column.value.split()[2:]
        )

    return [(f"`{c.name}`", cell(c.meaning), value(c), c.default, cell(c.limits)) for c in columns]


def table_page(manual, kind):
    """The page of a table."""
    sections = manual.tables[kind]
    page = [f"# {kind}", MARK]
    for section in sections:
        level = "##"
        if len(sections) > 1:
            page.append("## " + ("In space" if section.space else "In the plane"))
            level = "###"
        elif section.space:
            page.append("In space only.")
        page += [cell(section.about[0].upper() + section.about[1:]), *section.head]
        if section.columns:
            page += [
                f"{level} {section.heading}",
                table(("name", "meaning", "unit or value", "default", "limits"), rows_of(manual, section.columns)),
            ]
        if section.channels:
            page += [
                f"{level} Channels",
                table(("name", "meaning", "unit"), [(f"`{c.name}`", cell(c.meaning), cell(c.value)) for c in section.channels]),
            ]
        deck = manual.deck_with(kind, section.space if len(sections) > 1 else None)
        if deck:
            page += [f"{level} A deck that runs", f"```text\n{deck.strip()}\n```"]
    return page


def by_group(manual):
    """Tables by their group, in the order of the manual; first those that are a group of their own."""
    groups = {}
    for kind in manual.tables:
        groups.setdefault(kind.partition(".")[0], []).append(kind)
    return dict(sorted(groups.items(), key=lambda item: len(item[1]) > 1))


def pages_of(manual):
    """All pages: path below docs/reference, and its blocks."""
    pages = {f"tables/{kind}.md": table_page(manual, kind) for kind in manual.tables}
    index = [
        "# Tables",
        MARK,
        f"Tables of gudgeon {manual.version}: every table and every section of settings of a deck, with columns, units, defaults, "
        "limits, channels and a deck that runs. "
        "`gudgeon help NAME` prints the same. How a deck is written: [the deck](../deck.md).",
    ]
    for group, kinds in by_group(manual).items():
        index.append(
            "\n".join(
                f"- [{kind}]({kind}.md): {cell(manual.tables[kind][0].about.rstrip('.'))}"
                + (
                    " (in the plane and in space)"
                    if len(manual.tables[kind]) > 1
                    else " (in space)"
                    if manual.tables[kind][0].space
                    else ""
                )
                for kind in kinds
            )
        )
        if len(kinds) > 1:
            index.insert(-1, f"## {group}")
    pages["tables/index.md"] = index

    options = manual.options()
    verbs = [
        "# Verbs and options",
        MARK,
        f"Those of gudgeon {manual.version}. The command line is `gudgeon VERB OPERAND OPTION...`; "
        "`gudgeon VERB --help` prints what is here.",
    ]
    for line, verb, words in manual.verbs():
        taken = [(f"`{name}`", cell(text)) for name, text, takers in options if verb in takers]
        verbs += [f"## {verb}", f"`gudgeon {line}`", cell(words[0].upper() + words[1:]) + "."] + (
            [table(("option", "meaning"), taken)] if taken else []
        )
    environment = re.search(r"^Environment: (\w+) (.*)$", manual.usage, re.M)
    pages["verbs.md"] = verbs + [
        "## Environment",
        table(("variable", "meaning"), [(f"`{environment[1]}`", cell(environment[2]))]),
    ]

    codes = " ".join(re.search(r"Exit codes: (.*?)\.\n(?=\w)", manual.usage, re.S)[1].split())
    codes = re.findall(r"(\d+) (.*?)(?:, (?=\d)|$)", codes)
    pages["exit-codes.md"] = ["# Exit codes", MARK, table(("code", "meaning"), [(code, cell(words)) for code, words in codes])]

    functions = re.findall(r"^  (.*?\)) +(\S.*)$", manual.blocks["functions"], re.M)
    pages["functions.md"] = [
        "# Functions of expressions",
        MARK,
        "Also the tables `[function.*]` by their names, and the constant `pi`. "
        "How expressions are written: [the deck](deck.md#grammar).",
        table(("function", "value"), [(f"`{name}`", cell(words)) for name, words in functions]),
    ]
    pages["thresholds.md"] = [
        "# Numerical thresholds",
        MARK,
        manual.blocks["Numerical thresholds"].replace("```\n", "```text\n", 1),
    ]
    pages["units.md"] = units_page()

    channels = {}
    for kind, sections in manual.tables.items():
        for section in sections:
            for c in section.channels:
                channels.setdefault((c.name, c.value), {}).setdefault(c.meaning, {})[kind] = f"[{kind}](tables/{kind}.md)"
    rows = [
        (f"`{name}`", cell(unit), "; ".join(f"{cell(words)} ({', '.join(kinds.values())})" for words, kinds in meanings.items()))
        for (name, unit), meanings in sorted(channels.items())
    ]
    pages["channels.md"] = [
        "# Channels",
        MARK,
        "`ITEM.CHANNEL` names a channel, `ITEM.CHANNEL.x` a component. Which are written, and how: "
        "[files of a run](output.md#which-channels).",
        table(("channel", "unit", "meaning, and the tables whose items have it"), rows),
    ]
    pages["words.md"] = words_page(manual, [verb for _, verb, _ in manual.verbs()], options, [name for name, _ in functions])
    return {name: "\n\n".join(blocks) + "\n" for name, blocks in pages.items()}


def units_page():
    """Names of units, from the list of the program that reads them."""
    source = next((ROOT / "src").rglob("named_units.f90")).read_text(encoding="utf-8")
    rows = []
    for name, prefixes, unit in re.findall(r'named_unit_t\("(\w+)", "(\w*)", unit_t\((.*)\)\)', source):
        number = {word: float(value) for word, value in re.findall(r"(numerator|denominator|power)=([-\d.]+)", unit)}
        factor = number.get("numerator", 1) / number.get("denominator", 1) * 10 ** number.get("power", 0)
        value = f"pi/{1 / factor:.0f}" if "numerator=pi" in unit else f"{factor:.10g}{' pi' if 'pi' in unit else ''}"
        base = ".".join(
            f"{n}" + (f"^{power}" if power != "1" else "")
            for n, power in re.findall(r"(\w+)=(-?\d+)", unit.partition("dim_t(")[2])
        )
        base = re.sub(r"\bk\b", "K", base)
        offset = ", plus 273.15 K" if "offset" in unit else ""
        rows.append((f"`{name}`", " ".join(f"`{letter}`" for letter in prefixes), f"{value} {base}{offset}"))
    return [
        "# Units",
        MARK,
        "A unit is a product of names with exponents: `kg.m^2`, `N.s/m`, `N/m^1.5`, `W/(m.K)`, `s^-1`; `1` for none. Prefixes: "
        "`G` 1e9, `M` 1e6, `k` 1e3, `d` 0.1, `c` 0.01, `m` 1e-3, `u` 1e-6, `n` 1e-9, `p` 1e-12. How numbers and units are written: "
        "[the deck](deck.md#grammar).",
        table(("unit", "prefixes", "in SI"), rows),
    ]


def words_page(manual, verbs, options, functions):
    """Every word of a deck or command line, and the pages that have it."""
    places = {}
    for kind, sections in manual.tables.items():
        places.setdefault(kind, {})[f"[table](tables/{kind}.md)"] = 0
        for section in sections:
            for c in (*section.columns, *section.channels):
                places.setdefault(c.name, {})[f"[{kind}](tables/{kind}.md)"] = 0
    for verb in verbs:
        places.setdefault(verb, {})[f"[verb](verbs.md#{verb})"] = 0
    for name, _, takers in options:
        places.setdefault(name.split()[0], {}).update((f"[{taker}](verbs.md#{taker})", 0) for taker in takers)
    for name in re.findall(r"(\w+)\(", " ".join(functions)):
        places.setdefault(name, {})["[function](functions.md)"] = 0
    page, letter = ["# Index", MARK], ""
    for word in sorted(places, key=lambda word: (word.lstrip("-").lower(), word)):
        line = f"- `{word}`: {', '.join(places[word])}"
        if word.lstrip("-")[0].lower() != letter:
            letter = word.lstrip("-")[0].lower()
            page += [f"## {letter.upper()}", line]
        else:
            page[-1] += "\n" + line
    return page


def differing(pages):
    """Generated pages that are not there, are other ones, or are there without a table."""
    there = {f"tables/{path.name}" for path in (PLACE / "tables").glob("*.md")}
    return sorted(
        {name for name, text in pages.items() if not (PLACE / name).exists() or (PLACE / name).read_text("utf-8") != text}
        | (there - set(pages))
    )
