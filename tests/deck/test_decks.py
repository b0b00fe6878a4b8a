"""Bad decks: each NAME.deck is refused with the lines of NAME.expected, in order, on the error stream.

The expected file may begin with `# exit N` (else 3) and `# arguments ...` (put behind the deck). Each line
has to occur somewhere in a later line of the output than the one before it.
"""

import pathlib
import random
import subprocess
import time

import pytest

HERE = pathlib.Path(__file__).resolve().parent
DECKS = sorted(path.stem for path in HERE.glob("*.expected"))
EXIT_DECK = 3
SIZE = 10_000_000  # bytes of noise
LIMIT = 5.0  # seconds for refusing them; one is the aim


def check(program, deck, *arguments, cwd=HERE):
    """Run `gudgeon check` on a deck; the answer must look like an answer, whatever it says."""
    begin = time.perf_counter()
    done = subprocess.run(
        [program, "check", deck, *arguments],
        cwd=cwd,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=60,
        stdin=subprocess.DEVNULL,
    )
    done.seconds = time.perf_counter() - begin
    for sign in ("Backtrace", "Fortran runtime error", "Program received signal", "Traceback", "SIG", "STOP"):
        assert sign not in done.stderr, done.stderr
    assert done.returncode >= 0, f"ended by signal {-done.returncode}"
    return done


def expectation(name):
    """Exit code, arguments and lines of an expected file."""
    code, arguments, lines = EXIT_DECK, [], []
    for line in (HERE / f"{name}.expected").read_text().splitlines():
        if line.startswith("# exit "):
            code = int(line.split()[2])
        elif line.startswith("# arguments "):
            arguments = line.split()[2:]
        else:
            lines.append(line)
    assert lines, f"{name}.expected expects nothing"
    return code, arguments, lines


def assert_in_order(lines, text):
    """Each of the lines is part of a line of the text, in this order."""
    rest = iter(text.splitlines())
    for line in lines:
        assert any(line in candidate for candidate in rest), f"not found, or not in this order: {line}\n\n{text}"


def test_there_are_enough_decks():
    """A deck without its expectation, or the other way round, is a mistake of this folder."""
    assert len(DECKS) >= 45
    assert DECKS == sorted(path.stem for path in HERE.glob("*.deck"))


@pytest.mark.parametrize("build", ["gudgeon", "gudgeon_debug"])
@pytest.mark.parametrize("name", DECKS)
def test_bad_deck(name, build, request):
    """The deck is refused for the right reason, with nothing on the output stream."""
    code, arguments, lines = expectation(name)
    done = check(request.getfixturevalue(build), f"{name}.deck", *arguments)
    assert_in_order(lines, done.stderr)
    assert done.returncode == code, done.stderr
    assert done.stdout == ""


def test_shown_mistakes_are_limited(gudgeon):
    """Of many mistakes 20 are shown and the rest is counted."""
    done = check(gudgeon, "many_mistakes.deck")
    assert done.stderr.count("error:") == 20
    assert "... and " in done.stderr


def test_missing_deck(gudgeon, tmp_path):
    """A deck that is not there is named."""
    done = check(gudgeon, "nowhere.deck", cwd=tmp_path)
    assert_in_order(["cannot read the deck 'nowhere.deck'", "no such file"], done.stderr)
    assert done.returncode == EXIT_DECK


def test_directory_as_deck(gudgeon, tmp_path):
    """A directory is not a deck."""
    (tmp_path / "folder.deck").mkdir()
    done = check(gudgeon, "folder.deck", cwd=tmp_path)
    assert_in_order(["cannot read the deck 'folder.deck'", "it is a directory"], done.stderr)
    assert done.returncode == EXIT_DECK


def noise(kind):
    """Ten megabytes of something that is not a deck; the same each time."""
    source = random.Random(1)
    if kind == "bytes":
        return source.randbytes(SIZE)
    letters = bytes(range(32, 127)) + b"\n\n"
    text = bytes(source.choices(letters, k=SIZE))
    return {
        "text": text,
        "text_after_version": b"deck = 1\n" + text,
        "rows": b"deck = 1\n[bodies]\nname mass[kg]\n" + text,
        "one_line": b"deck = 1\n[bodies]\n" + text.replace(b"\n", b" "),
        "brackets": b"deck = 1\n[bodies]\nname mass[kg]\na {" + b"(" * SIZE + b"}\n",
    }[kind]


@pytest.mark.parametrize("kind", ["bytes", "text", "text_after_version", "rows", "one_line", "brackets"])
def test_noise_is_refused_at_once(kind, gudgeon, tmp_path, record_property):
    """Noise neither crashes the reader nor keeps it busy."""
    (tmp_path / "noise.deck").write_bytes(noise(kind))
    done = check(gudgeon, "noise.deck", cwd=tmp_path)
    record_property("seconds", done.seconds)
    assert done.returncode == EXIT_DECK, done.stderr
    assert done.stderr.count("error:") <= 20
    assert len(done.stderr) < 100_000
    assert done.seconds < LIMIT
