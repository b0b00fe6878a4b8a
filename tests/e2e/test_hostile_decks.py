"""Names that no file should have, decks of absurd sizes: each is refused or read at once, and nothing outside the output is touched."""

import json
import resource
import subprocess

import pytest
from conftest import IS_SANITIZED
from support import Run, call, changed, plain_deck, scratch, written

SHORT = plain_deck([("analysis.dynamic", "end", "0.2 ms")])
NAMES = [
    "../PWNED", "../../PWNED", "/PWNED", "a/b", "..", ".", "`touch PWNED`", "$(touch PWNED)", ";touch PWNED", "|touch PWNED",
    "!touch PWNED", "'; system('touch PWNED'); '", "a b", "a\\nb", "%s%n", "\u00fcber", "\u66f2\u67c4", "\u202ea", "e\u0301", "a\u200bb", "n" * 61,
    "n" * 10000, "*", "-", "\\\"",
]
PLACES = ["crank", "throw", "big_end", "motor", "steel", "gudgeon", "lankarani_nikravesh", "ambrosio"]  # one name of each sort
SECONDS = 10.0  # for what takes a second of a processor at most
MEMORY = 2 << 30  # bytes of address space

ABSURD = {
    "unknown_sections": ("check", SHORT + "[x]\n" * 300_000, 3, b"unknown section"),
    "doubled_sections": ("check", SHORT + "[guards]\n" * 300_000, 3, b"section guards is given twice"),
    "channels": ("check", changed(SHORT, "output", channels='"' + "slider.velocity " * 200_000 + '"'), 3, b"unknown channel"),
    "brackets": ("check", SHORT.replace("{restitution}", "{" + "(" * 200_000 + "1" + ")" * 200_000 + "}"), 3, b"invalid expression"),
    "signs": ("check", SHORT.replace("{restitution}", "{" + "-" * 200_000 + "1}"), 3, b"invalid expression"),
    "unit": ("check", SHORT.replace("mass[kg]", "mass[" + "kg." * 200_000 + "kg]"), 3, b"wrong dimension"),
    "exponent": ("check", SHORT.replace("0.5 mm", "1e" + "9" * 200_000 + " mm"), 3, b"1e99"),
    "sweep": ("check", SHORT + "\n[sweep]\nc = 0.1 .. 0.5 mm in 2000000000\n", 3, b"range of 'c'"),
    "grid": ("check", SHORT + "\n[sweep]\nc = 0.1 .. 0.5 mm in 9999\nrestitution = 0.1 .. 0.9 in 9999\n", 3, b"too many"),
    "instants": ("check", changed(SHORT, "output", every="1e-30 s", instants_limit="2e9"), 3, b"output times"),
    "pictures": ("run", changed(SHORT, "output", figures="animation(n=2000000000)"), 3, b"not a number of pictures"),
    "ensemble": ("check", SHORT + "\n[ensemble]\nruns = 1e18\n", 3, b"runs"),
    "bins": ("check", SHORT + "\n[statistics]\nafter = 0.1 ms\nbins = 1e18\n", 3, b"bins"),
}


def content(directory):
    """Every file below a directory."""
    return sorted(path.relative_to(directory).as_posix() for path in directory.rglob("*"))


def limited():
    """Little memory for a process that is to be started; a sanitizer alone maps terabytes of addresses."""
    if not IS_SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def end_of(gudgeon, verb, text, *options):
    """How a verb ends with a deck, in little memory and time."""
    directory = scratch()
    command = [str(gudgeon), verb, str(written(directory, text)), *options]
    return subprocess.run(command, cwd=directory, capture_output=True, stdin=subprocess.DEVNULL, timeout=SECONDS, preexec_fn=limited)


def test_hostile_names_are_refused(gudgeon):
    """Names are letters, digits, _ and -: any other is told where it stands, in each table, and no file comes of it."""
    directory = scratch()
    for k, name in enumerate(NAMES):
        place = PLACES[k % len(PLACES)]
        lines = SHORT.splitlines()
        at = next(i for i, line in enumerate(lines) if line.split()[:1] == [place])
        lines[at] = f'"{name}"' + lines[at][len(place):]
        deck = written(directory, "\n".join(lines) + "\n")
        said = call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", expect=3, cwd=directory).stderr
        assert "name" in said and f":{at + 1}:" in said, (name, said)
        assert len(said) < 100_000
    assert content(directory) == ["scene.deck"]


def test_the_longest_name_is_a_file(gudgeon):
    """What is allowed of names works as a name of a file: one that looks like an option, and one of 60 characters."""
    for name in ("-rf", "n" * 60):
        directory = scratch()
        text = "\n".join(name + line[5:] if line.startswith("motor ") else line for line in SHORT.splitlines()) + "\n"
        text = changed(text, "output", channels=f"{name}.*", figures=f"{name}.moment")
        call(gudgeon, "run", written(directory, text), "--out", "out", "--quiet", cwd=directory)
        assert (directory / "out" / f"{name}.dat").exists() and len(list((directory / "out" / "figures").glob("*.png"))) == 1
        assert sorted(path.name for path in directory.iterdir()) == ["out", "scene.deck"]


@pytest.mark.parametrize("word", ["../../PWNED", "/PWNED", "`touch PWNED`", "x" * 10000, "slider.velocity/../../PWNED", "\u66f2.\u67c4"])
@pytest.mark.parametrize("key", ["channels", "figures"])
def test_hostile_words_are_refused(gudgeon, key, word):
    """Channels and figures give files their names: words that are neither are refused."""
    directory = scratch()
    deck = written(directory, changed(SHORT, "output", **{key: f'"{word}"'}))
    call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", expect=3, cwd=directory)
    assert content(directory) == ["scene.deck"]


def test_a_long_title(gudgeon):
    """A title of a million characters, none of them of UTF-8 twice in a row, is written whole."""
    title = "\u00e9x" * 300_000
    directory = scratch()
    deck = written(directory, changed(SHORT, "scene", title=f'"{title}"'))
    call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", limit=SECONDS)
    assert json.dumps(title, ensure_ascii=False) in (directory / "out" / "summary.json").read_text(encoding="utf-8")
    assert Run(directory / "out").read("deck") == deck.read_text()


@pytest.mark.parametrize("case", ABSURD)
def test_absurd_sizes_end_at_once(gudgeon, case):
    """In 2 GB and some seconds."""
    verb, text, code, told = ABSURD[case]
    done = end_of(gudgeon, verb, text)
    assert done.returncode == code and told in done.stderr, done.stderr[:2000]


def test_an_empty_word_for_a_number(gudgeon_debug):
    """Quotes without anything between them where a number is wanted: the mistake, in the build with all checks too."""
    for old, new in (("0.30", '""'), ("207", '""'), ("1.0e-4", '"{"'), ("0.5 mm", '""')):
        assert old in SHORT
        done = end_of(gudgeon_debug, "check", SHORT.replace(old, new, 1))
        assert done.returncode == 3 and b"not a number" in done.stderr, done.stderr


ESCAPES = "\x1b[31mred\x1b[0m\x1b]0;owned\x07\x7f\u009b1m"


@pytest.mark.parametrize("verb, options", (("explain", ()), ("check", ()), ("run", ()), ("run", ("--json",))))
def test_nothing_of_a_deck_commands_the_terminal(gudgeon, verb, options):
    """Control characters of a title are made visible in all that is printed."""
    text = SHORT.replace('title', '# title', 1).replace("[scene]", f'[scene]\ntitle = "{ESCAPES}"', 1)
    done = end_of(gudgeon, verb, text, *options)
    assert done.returncode == 0, done.stderr
    said = done.stdout + done.stderr
    assert not [byte for byte in said if byte < 32 and byte not in (9, 10)] and b"\x7f" not in said and b"\xc2\x9b" not in said
    assert b"red" in said or verb == "check"
