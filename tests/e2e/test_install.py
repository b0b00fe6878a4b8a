"""make install and uninstall, the man page, and the completions of bash and zsh."""

import os
import re
import shutil
import subprocess

import pytest
from conftest import ROOT, built, directory_of

SLIDER_CRANK = "share/gudgeon/decks/slider_crank_dry.deck"


def call(command, expect=0, **arguments):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=300, check=False, **arguments)
    assert done.returncode == expect, done.stdout + done.stderr
    return done.stdout


def files_below(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if not path.is_dir())


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A prefix below a DESTDIR that the release build was installed to, for all tests that change nothing there."""
    place = tmp_path_factory.mktemp("dest")
    call([ROOT / "scripts/install", built(directory_of("release") / "gudgeon"), "/opt/mine", place])
    return place / "opt/mine"


@pytest.fixture
def installed_to_change(root, gudgeon, tmp_path):
    """Another one, of one test."""
    call([root / "scripts/install", gudgeon, "/opt/mine", tmp_path / "dest"])
    return tmp_path / "dest/opt/mine"


def remove(root, gudgeon, installed, expect=0):
    return call([root / "scripts/install", "--remove", gudgeon, "/opt/mine", installed.parents[1]], expect=expect)


def test_libraries_are_loaded_on_demand(root, tmp_path):
    """`make LINK=shared` and `make LINK=static` are what they say: the last command of a build names archives or none."""
    for link in ("shared", "static"):
        told = call(["make", "-n", f"LINK={link}", f"B={tmp_path / link}", "binary"], cwd=root).splitlines()
        last = [line for line in told if f"-o {tmp_path / link}/gudgeon " in line]
        assert len(last) == 1 and last[0].startswith(os.environ.get("FC", "gfortran"))
        assert ("-Bstatic" in last[0]) == (link == "static")


def test_what_is_installed(root, installed):
    there = set(files_below(installed))
    for name in ("bin/gudgeon", "share/man/man1/gudgeon.1", "share/bash-completion/completions/gudgeon",
                 "share/zsh/site-functions/_gudgeon", "share/doc/gudgeon/LICENSE", "share/doc/gudgeon/CITATION.cff"):
        assert name in there
    decks = {"share/gudgeon/decks/" + str(path.relative_to(root / "inputs")) for path in (root / "inputs").rglob("*.deck")}
    assert len(decks) > 20 and decks <= there


def test_licences_are_installed(installed, gudgeon):
    """Of every archive that the linker read: the notice of its package and the licences that this names; no library under the GPL."""
    if not shutil.which("dpkg-query"):
        pytest.skip("dpkg is not there")
    licences = installed / "share/doc/gudgeon/licences"
    table = [line.split(" | ") for line in (licences / "README").read_text().splitlines() if " | " in line][1:]
    linked = open(f"{gudgeon}.linked", encoding="utf-8").read()
    archives = {os.path.basename(os.path.realpath(path)) for path in re.findall(r"^\(?(/\S*?\.a)\b", linked, re.M)}
    assert archives <= {row[0] for row in table} and ("libhdf5_serial.a" not in linked or len(archives) > 8)
    assert not {"libfftw3.a", "libklu.a", "libbtf.a", "libquadmath.a"} & archives
    for name, package, *_ in table:
        assert (licences / f"{package}.copyright").stat().st_size > 300, name
    named = set(re.findall(r"/usr/share/common-licenses/([\w.+-]*\w)", "".join(p.read_text(encoding="utf-8") for p in licences.glob("*.copyright"))))
    assert named & {path.name for path in licences.iterdir()} == {name for name in named if os.path.exists(f"/usr/share/common-licenses/{name}")}


def test_a_missing_notice_is_told(root, tmp_path):
    """A library that belongs to no package: an error names it, and install says that licences are missing."""
    (tmp_path / "made").mkdir()
    (tmp_path / "libmine.a").write_bytes(b"")
    (tmp_path / "made/gudgeon.linked").write_text(f"obj/main.o\n({tmp_path}/libmine.a)mine.o\n")
    done = subprocess.run([root / "scripts/notices", tmp_path / "made/gudgeon.linked", tmp_path / "licences"], capture_output=True, text=True)
    assert done.returncode == 1 and ("libmine.a" in done.stderr or "dpkg" in done.stderr)


def test_module_file(installed, tmp_path):
    """As Environment Modules and Lmod read it: the program, its page and the package are found."""
    (path,) = (installed / "share/modulefiles/gudgeon").iterdir()
    text = path.read_text(encoding="utf-8")
    assert text.startswith("#%Module") and "@" not in text and 'set prefix "/opt/mine"' in text
    command = shutil.which("modulecmd") or next((p for p in ("/usr/lib/modulecmd.tcl", "/usr/share/lmod/lmod/libexec/lmod") if os.path.exists(p)), None)
    if command is None:
        pytest.skip("neither Environment Modules nor Lmod is there")
    told = call([command, "sh", "load", "gudgeon"], env={"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "MODULEPATH": str(path.parents[1])})
    said = call(["sh", "-c", f'{told}\necho "$PATH|$MANPATH|$PYTHONPATH|$GUDGEON"'], env={"PATH": "/usr/bin:/bin"}).strip().split("|")
    assert [word.split(":")[0] for word in said] == ["/opt/mine/bin", "/opt/mine/share/man", "/opt/mine/share/gudgeon/python", "/opt/mine/bin/gudgeon"]


def test_the_installed_program_works_from_anywhere(installed, tmp_path):
    program = installed / "bin/gudgeon"
    elsewhere = tmp_path / "else where"
    elsewhere.mkdir()
    call([program, "run", installed / SLIDER_CRANK, "--quiet", "--write", "numbers"], cwd=elsewhere)
    assert (elsewhere / "outputs/slider_crank_dry/run.h5").exists()
    call([program, "new", "my"], cwd=elsewhere)
    call([program, "check", "my.deck"], cwd=elsewhere)
    assert "joint.revolute" in call([program, "list"], cwd=elsewhere)
    # decks that read files beside them, too
    call([program, "check", installed / "share/gudgeon/decks/valve_train.deck"], cwd=elsewhere)


def test_uninstall_leaves_nothing_of_ours_and_all_that_is_not(root, gudgeon, installed_to_change):
    mine = installed_to_change / "share/gudgeon/decks/my.deck"
    mine.write_text("deck = 1\n")
    other = installed_to_change / "bin/other"
    other.write_text("#!/bin/sh\n")
    assert "is kept" in remove(root, gudgeon, installed_to_change)
    assert files_below(installed_to_change) == ["bin/other", "share/gudgeon/decks/my.deck"]
    mine.unlink()
    remove(root, gudgeon, installed_to_change, expect=9)


def test_uninstall_takes_its_folders_away(root, gudgeon, installed_to_change):
    call(["python3", "-c", "import gudgeon"], env={**os.environ, "PYTHONPATH": str(installed_to_change / "share/gudgeon/python")})
    remove(root, gudgeon, installed_to_change)
    assert files_below(installed_to_change) == []
    assert not (installed_to_change / "share/gudgeon").exists() and not (installed_to_change / "share/doc/gudgeon").exists()


def test_installing_again_drops_what_is_gone(root, gudgeon, installed_to_change):
    gone = installed_to_change / "share/gudgeon/decks/of_an_earlier_version.deck"
    gone.write_text("deck = 1\n")
    with open(installed_to_change / "share/gudgeon/installed", "a", encoding="utf-8") as listing:
        listing.write("share/gudgeon/decks/of_an_earlier_version.deck\n")
    call([root / "scripts/install", gudgeon, "/opt/mine", installed_to_change.parents[1]])
    assert not gone.exists()
    assert (installed_to_change / SLIDER_CRANK).exists()


def test_a_listing_that_leads_elsewhere_is_refused(root, gudgeon, installed_to_change, tmp_path):
    precious = tmp_path / "dest/opt/precious"
    precious.write_text("kept\n")
    (installed_to_change / "share/gudgeon/installed").write_text("../precious\n")
    remove(root, gudgeon, installed_to_change, expect=9)
    assert precious.exists()


def test_prefix_must_be_absolute(root, gudgeon, tmp_path):
    call([root / "scripts/install", gudgeon, "usr", tmp_path], expect=9)
    assert not list(tmp_path.iterdir())


def test_man_page(installed, gudgeon):
    page = installed / "share/man/man1/gudgeon.1"
    text = page.read_text(encoding="utf-8").replace("\\-", "-")
    for section in ("NAME", "SYNOPSIS", "COMMANDS", "OPTIONS", "DECK", "EXIT STATUS", "ENVIRONMENT", "FILES", "EXAMPLES"):
        assert f".SH {section}\n" in text
    for option in re.findall(r"^  (--[\w-]+)", call([gudgeon, "help"]), re.M):
        assert f"\\fB{option}\\fR" in text, option
    for line in call([gudgeon, "list"]).splitlines():
        assert f".B {line.split()[0]}\n" in text


@pytest.mark.parametrize("checker", [["man", "--warnings", "-l"], ["groff", "-man", "-ww", "-Tutf8"],
                                     ["mandoc", "-Tlint", "-Wwarning"]], ids=lambda words: words[0])
def test_man_page_is_sound(installed, checker):
    if not shutil.which(checker[0]):
        pytest.skip(f"{checker[0]} is not there")
    done = subprocess.run([*checker, str(installed / "share/man/man1/gudgeon.1")], capture_output=True, text=True, timeout=60,
                          check=False, env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "100"})
    said = done.stderr + (done.stdout if checker[0] == "mandoc" else "")
    assert done.returncode == 0 and said == ""


def candidates(installed, words, cwd):
    """What bash offers for the last of the words."""
    script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _gudgeon; printf "%s\\n" "${COMPREPLY[@]}"'
    completion = installed / "share/bash-completion/completions/gudgeon"
    return call(["bash", "-c", script, "bash", completion, *words], cwd=cwd).split("\n")[:-1]


def test_bash_completes(installed, gudgeon, tmp_path):
    folder = tmp_path / "work"
    folder.mkdir()
    (folder / "a b.deck").write_text("[parameters]\nc = 1 mm\nspeed=3 rpm\n[bodies]\nx = 4\n")
    (folder / "note.txt").write_text("")
    (folder / "decks").mkdir()

    def offered(*words):
        return candidates(installed, ["gudgeon", *words], folder)

    verbs = re.findall(r"^  gudgeon (\w+)", call([gudgeon, "help"]), re.M)
    assert offered("") == verbs and len(verbs) >= 8
    assert offered("ex") == ["explain"]
    # every option that is offered is taken: the program does not call it unknown
    for verb in verbs:
        for option in filter(None, offered(verb, "--")):
            said = subprocess.run([gudgeon, verb, option], capture_output=True, text=True, timeout=60, check=False, cwd=folder)
            assert "unknown option" not in said.stderr, (verb, option)
    assert offered("run", "") == ["a b.deck", "decks"]
    assert offered("run", "a b.deck", "--method", "v") == ["verner"]
    assert offered("run", "--method", "=", "b") == ["bdf"]
    assert "ida" in offered("run", "--method", "=")
    assert offered("run", "--analysis", "k") == ["kinematic"]
    assert offered("run", "--out", "") == ["decks"]
    assert offered("run", "a b.deck", "--set", "") == ["c=", "speed="]
    assert offered("help", "friction.a") == ["friction.ambrosio"]
    kinds = [line.split()[0] for line in call([gudgeon, "list"]).splitlines()]
    assert offered("help", "") == kinds


def test_methods_offered_are_the_program_s(installed, gudgeon, tmp_path):
    offered = candidates(installed, ["gudgeon", "run", "--method", ""], tmp_path)
    listed = [line.split()[0] for line in call([gudgeon, "list"]).splitlines()]
    assert sorted("integrator." + name for name in offered) == sorted(name for name in listed if name.startswith("integrator."))


def test_zsh_reads_its_completion(installed):
    if not shutil.which("zsh"):
        pytest.skip("zsh is not there")
    completion = installed / "share/zsh/site-functions/_gudgeon"
    call(["zsh", "-f", "-n", completion])


def test_no_completion_for_other_shells(gudgeon):
    done = subprocess.run([gudgeon, "help", "--completion", "fishy"], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 2 and "bash" in done.stderr and done.stdout == ""


def test_citation_is_sound(root):
    """The keys that CFF 1.2.0 requires, and the version that the program has."""
    text = (root / "CITATION.cff").read_text(encoding="utf-8")
    for key in ("cff-version: 1.2.0", "message:", "title:", "authors:", "doi: 10.1007/978-3-540-74361-3"):
        assert re.search(rf"^\s*{re.escape(key)}", text, re.M), key
    version = re.search(r'program_version = "([^"]+)"', (root / "src/foundation/core/version.f90").read_text(encoding="utf-8")).group(1)
    date = re.search(r'program_date = "([^"]+)"', (root / "src/foundation/core/version.f90").read_text(encoding="utf-8")).group(1)
    assert f"version: {version}\n" in text and f'date-released: "{date}"\n' in text
