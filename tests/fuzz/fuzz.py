#!/usr/bin/env python3
"""Fuzz: broken decks through check, explain and a short run. Each call has a defined end, or it is a finding.

fuzz.py --build DIRECTORY [-n 1000] [--seed 1] [--first 0] [--jobs 2] [--debug] [--explain 0.25] [--run 0.15] [--keep DIRECTORY]

A finding is an exit code that the program does not document for a user's mistake, a signal, a message of the run-time
system, an error without a word, or a check or explain that does not end. A run that does not end within the limit is stopped
and counted: decks may ask for long motions. The decks of findings are kept, each with what the program said.
"""

import argparse
import collections
import concurrent.futures
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from mutants import METHODS, Mutator, companions, shortened  # noqa: E402

DOCUMENTED = {"check": (0, 2, 3, 4, 5, 9), "explain": (0, 2, 3, 4, 5, 9), "run": (0, 2, 3, 4, 5, 6, 9)}
CRASH = re.compile(r"Backtrace|Fortran runtime error|Program received signal|\bSIG[A-Z]{3,4}\b|Operating system error|^(ERROR )?STOP|internal error", re.M)
BATCH = 40  # mutants of one scratch directory
FRAME = re.compile(r"^#\d+\s+0x[0-9a-f]+ in (\S+)\s*(?:\n\s+at (\S+))?", re.M)


class Call:
    """One verb with its options on one mutant, and how it ended."""

    def __init__(self, number, name, verb, options, data):
        self.number, self.name, self.verb, self.options, self.data = number, name, verb, options, data
        self.code, self.text = None, ""

    def __str__(self):
        return " ".join([self.verb, *self.options])

    def wrong(self):
        """What is wrong with the end of the call; blank: nothing."""
        if self.code is None:
            return "" if self.verb == "run" else "no end"
        if self.code not in DOCUMENTED[self.verb]:
            return f"exit {self.code}"
        if CRASH.search(self.text):
            return "message of the run-time system"
        if self.verb == "run" and self.code != 0 and "error" not in self.text:
            return f"exit {self.code} without a word"
        return ""

    def place(self):
        """Where it happened: the first frames of the program's own, or the run-time system's sentence."""
        frames = [name + (f" {place}" if place else "") for name, place in FRAME.findall(self.text)]
        own = [frame for frame in frames if "src/" in frame]
        sentence = re.search(r"Fortran runtime error: .*|At line .*", self.text)
        last = self.text.strip().splitlines()[-1][:160] if self.text.strip() else ""
        return " <- ".join(own[:2]) or (sentence.group() if sentence else last)


def calls(mutator, k, options):
    """The calls that mutant k goes through."""
    name, data = mutator.mutant(k)
    dice = random.Random(f"{mutator.seed} {k} calls")
    chosen = [Call(k, name, "check", (), data)]
    if dice.random() < options.explain:
        chosen.append(Call(k, name, "explain", ("--ideal",) if dice.random() < 0.3 else (), data))
    if dice.random() < 0.1:
        chosen.append(Call(k, name, "check", ("--ideal",), data))
    if dice.random() < options.run:
        extra = ("--ideal",) if dice.random() < 0.2 else ()
        if dice.random() < 0.3:
            extra += ("--method", dice.choice(METHODS))
        chosen.append(Call(k, name, "run", extra, shortened(data)))
    return chosen


def file_of(scratch, call, tag):
    """The mutant as a file beside the deck that it was made of."""
    place = scratch / call.name
    place = place.with_name(f"{place.stem}_{call.number}{tag}.deck")
    place.write_bytes(call.data)
    return place


def run_one(programs, scratch, call, limit):
    """A run in a process of its own."""
    place, out = file_of(scratch, call, "r"), scratch / f"out{call.number}"
    command = [str(programs.gudgeon), "run", str(place), "--out", str(out), "--quiet", *call.options]
    try:
        done = subprocess.run(command, cwd=scratch, capture_output=True, stdin=subprocess.DEVNULL, timeout=limit)
        call.code, call.text = done.returncode, done.stderr.decode("utf-8", "replace")
    except subprocess.TimeoutExpired as late:
        call.text = (late.stderr or b"").decode("utf-8", "replace")
    shutil.rmtree(out, ignore_errors=True)
    out.with_name(out.name + ".lock").unlink(missing_ok=True)
    place.unlink(missing_ok=True)


def run_many(programs, scratch, batch, limit):
    """Checks and explanations, many in one process; after a crash the next process goes on behind it."""
    places = [file_of(scratch, call, "c") for call in batch]
    lines = [f"{call.verb} {' '.join(call.options)} {place}" for call, place in zip(batch, places)]
    first = 0
    while first < len(batch):
        late = False
        with tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as errors:
            process = subprocess.Popen([str(programs.many)], cwd=scratch, stdin=subprocess.PIPE, stdout=said, stderr=errors)
            try:
                process.communicate("\n".join(lines[first:]).encode() + b"\n", timeout=limit + 0.2 * limit * len(lines[first:]) / 10)
            except subprocess.TimeoutExpired:
                late = True
                process.kill()
                process.wait()
            said.seek(0)
            errors.seek(0)
            ends = re.findall(r"(?m)^end (\d+) (-?\d+)\b", said.read().decode("utf-8", "replace"))
            text = errors.read().decode("utf-8", "replace")
        for number, code in ends:
            batch[first + int(number) - 1].code = int(code)
        first += len(ends)
        if first < len(batch):
            batch[first].code, batch[first].text = None if late else process.returncode, text
            first += 1
    for place in places:
        place.unlink(missing_ok=True)


def try_batch(programs, mutator, numbers, options, limit):
    """Take mutants through their calls."""
    made = [call for k in numbers for call in calls(mutator, k, options)]
    with tempfile.TemporaryDirectory(prefix="gudgeon_fuzz_", dir=options.scratch) as scratch:
        scratch = pathlib.Path(scratch)
        for path, content in companions().items():
            (scratch / path).parent.mkdir(parents=True, exist_ok=True)
            (scratch / path).write_bytes(content)
        run_many(programs, scratch, [call for call in made if call.verb != "run"], limit)
        for call in made:
            if call.verb == "run":
                run_one(programs, scratch, call, limit)
    return made


def fuzz(programs, options):
    """All mutants: the calls with findings by what and where, and counts."""
    mutator = Mutator(options.seed)
    limit = options.limit * (4 if options.debug else 1)
    classes, counts = {}, collections.Counter()
    numbers = range(options.first, options.first + options.n)
    batches = [numbers[k : k + BATCH] for k in range(0, len(numbers), BATCH)]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for done, made in enumerate(pool.map(lambda batch: try_batch(programs, mutator, batch, options, limit), batches), 1):
            for call in made:
                counts[f"{call.verb} {'stopped' if call.code is None else call.code}"] += 1
                if not call.wrong():
                    continue
                key = (call.wrong(), call.place())
                if key not in classes and options.keep:
                    keep(options.keep, len(classes), call)
                classes.setdefault(key, []).append(call)
            if options.is_loud and done * BATCH % 1000 < BATCH:
                print(f"{done * BATCH} mutants, {sum(map(len, classes.values()))} findings of {len(classes)} sorts", flush=True)
    return classes, counts


def keep(directory, number, call):
    """Keep the deck of a finding and what the program said."""
    directory = pathlib.Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    (directory / f"{number:03d}.deck").write_bytes(call.data)
    (directory / f"{number:03d}.txt").write_text(f"{call}: {call.wrong()}: {call.name} {call.number}\n{call.text}", errors="replace")


class Programs:
    """The programs of a build."""

    def __init__(self, build, debug):
        folder = pathlib.Path(build) / "debug" if debug else pathlib.Path(build)
        self.gudgeon, self.many = folder / "gudgeon", folder / "tests" / "many_decks"


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True, help="directory of the release build")
    parser.add_argument("-n", type=int, default=1000, help="number of mutants")
    parser.add_argument("--first", type=int, default=0, help="number of the first mutant")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--debug", action="store_true", help="the build with run-time checks")
    parser.add_argument("--explain", type=float, default=0.25, help="share of the mutants that are explained")
    parser.add_argument("--run", type=float, default=0.15, help="share of the mutants that are run")
    parser.add_argument("--limit", type=float, default=10.0, help="seconds for a call, four times as many in debug")
    parser.add_argument("--keep", help="directory for the decks of findings")
    options = parser.parse_args()
    options.is_loud = True
    options.scratch = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    if options.keep:
        shutil.rmtree(options.keep, ignore_errors=True)
    classes, counts = fuzz(Programs(options.build, options.debug), options)
    for key, cases in sorted(classes.items(), key=lambda entry: -len(entry[1])):
        print(f"{len(cases):6d}  {key[0]}: {key[1]}   [{cases[0]}: {cases[0].name} {cases[0].number}]")
    print(", ".join(f"{name}: {count}" for name, count in sorted(counts.items())))
    print(f"{options.n} mutants, {sum(counts.values())} calls, {sum(map(len, classes.values()))} findings")
    return 1 if classes else 0


if __name__ == "__main__":
    sys.exit(main())
