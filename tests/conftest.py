"""What every Python test may use: the programs that `make test` has built, and the project's directory."""

import os
import pathlib
import sys

import pytest

sys.dont_write_bytecode = True

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("GUDGEON_BUILD", ROOT / "build")).resolve()
IS_SANITIZED = os.environ.get("GUDGEON_SANITIZED") == "yes"  # make test-sanitize: one build stands for both
IS_QUICK = os.environ.get("GUDGEON_TIER") == "quick"  # make quick: the release build only
if IS_SANITIZED:
    DIRECTORY = {"sanitize": BUILD / "sanitize"}
elif IS_QUICK:
    DIRECTORY = {"release": BUILD}
else:
    DIRECTORY = {"release": BUILD, "debug": BUILD / "debug"}

os.environ["OPENBLAS_NUM_THREADS"] = "1"


def directory_of(mode):
    """Where the programs of a build are; where there is one build only, it stands for both."""
    return DIRECTORY.get(mode) or next(iter(DIRECTORY.values()))


def pytest_collection_modifyitems(items):
    """What cannot be tried with the sanitizers is left out, with the reason that left_out.txt gives."""
    if not IS_SANITIZED:
        return
    rows = [line.split(maxsplit=1) for line in (ROOT / "tests/sanitize/left_out.txt").read_text().splitlines() if line[:1] not in ("", "#")]
    unused = {name for name, _ in rows}
    for item in items:
        for name, reason in rows:
            if name in item.nodeid:
                unused.discard(name)
                item.add_marker(pytest.mark.skip(reason=reason))
    present = {item.nodeid.split("::")[0].rsplit("/", 1)[-1] for item in items}
    gone = [name for name in unused if name.split("::")[0] in present and len(present) > 1 and "-k" not in sys.argv]
    assert not gone, f"left_out.txt names tests that are gone: {gone}"


def built(path):
    """The program, or a failure that says how to make it."""
    if not path.exists():
        pytest.fail(f"{path} is not there: run `make test`, which builds it", pytrace=False)
    return path


@pytest.fixture
def root():
    """The project's directory."""
    return ROOT


@pytest.fixture
def gudgeon():
    """The release build of the program."""
    return built(directory_of("release") / "gudgeon")


@pytest.fixture
def gudgeon_debug():
    """The program built with all run-time checks."""
    return built(directory_of("debug") / "gudgeon")
