#!/usr/bin/env python3
"""Fuzz the readers guided by coverage: what leads to a new edge of the program is kept, and changed further.

guided.py --build DIRECTORY [--seconds 60] [--seed 1] [--jobs 2] [--corpus DIRECTORY] [--keep DIRECTORY]

DIRECTORY is the release build; the program of its build `sanitize` reads the decks: wrong accesses, undefined behaviour and lost
memory end it. A finding is such an end, an exit code that is not documented for a mistake of the user, an error without a word,
the echo of a good deck that is no good deck, lost memory, or a deck that takes more than a second of processor time, which the
release build measures anew. The decks of findings are kept, each with what was said. What was learnt stays in the corpus.
"""

import argparse
import collections
import multiprocessing
import os
import pathlib
import random
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from dictionary import GuidedMutator, kinds_of  # noqa: E402
from mutants import companions  # noqa: E402

READERS = {"check": 12, "echo": 5, "explain": 3}  # readers of tests/fuzz/many_decks.f90, and how often each is tried
DOCUMENTED = (0, 3, 4, 5, 9)
LONGEST = 1.0  # seconds of processor time that the release build may take for a deck
HANG = 60.0  # seconds after which a deck is taken to have no end
LARGEST = 60000  # bytes of a deck; larger ones take long and find the same
BETWEEN_LEAKS = 250  # decks between two looks for lost memory
OWN_FRAME = re.compile(r"#\d+ 0x[0-9a-f]+ in (\S+) (?:\./)?((?:src|tests)/\S+)")
SANITIZERS = {
    "ASAN_OPTIONS": "exitcode=99:allocator_may_return_null=1:max_allocation_size_mb=2000:hard_rss_limit_mb=4000:detect_stack_use_after_return=0",
    "UBSAN_OPTIONS": "exitcode=99:print_stacktrace=1",
    "LSAN_OPTIONS": f"exitcode=99:print_suppressions=0:suppressions={pathlib.Path(__file__).resolve().parent.parent / 'sanitize' / 'leaks.supp'}",
}


class Fell(Exception):
    """The program ended while it read a deck, or did not come to an end."""


class Reader:
    """A program that reads one deck after the other and says what it reached."""

    def __init__(self, program, scratch, environment=()):
        self.program, self.scratch = program, scratch
        self.environment = {**os.environ, **dict(environment)}
        self.process, self.errors = None, None

    def start(self):
        """Start it anew."""
        self.errors = tempfile.TemporaryFile()
        self.process = subprocess.Popen([str(self.program)], cwd=self.scratch, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors,
                                        env=self.environment)
        self.rest = b""

    def read(self, line, limit=HANG):
        """Code, news, edges and microseconds of one deck; else Fell with what was said."""
        if self.process is None:
            self.start()
        said, end = "", time.monotonic() + limit
        try:
            self.process.stdin.write(line.encode() + b"\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            raise Fell(self.last_words()) from None
        while True:
            word = self.line(end)
            if word is None:
                self.stop()
                raise Fell("no end")
            if word == b"":
                raise Fell(self.last_words())
            found = re.match(rb"end \d+ (-?\d+) (-?\d+) (\d+) (\d+)$", word.rstrip())
            if found:
                return [int(number) for number in found.groups()], said
            if not word.startswith(b"begin"):
                said += word.decode("utf-8", "replace")

    def line(self, end):
        """The next line; b"": none comes; None: it takes too long."""
        while b"\n" not in self.rest:
            if not select.select([self.process.stdout], [], [], max(0.0, end - time.monotonic()))[0]:
                return None
            more = os.read(self.process.stdout.fileno(), 65536)
            if not more:
                return b""
            self.rest += more
        word, self.rest = self.rest.split(b"\n", 1)
        return word + b"\n"

    def last_words(self):
        """What a program that ended had to say."""
        code = self.process.wait(60)
        text = self.errors_text()
        self.stop()
        return f"exit {code}\n{text}"

    def errors_text(self):
        """What stands on the standard error so far."""
        self.errors.seek(0)
        return self.errors.read().decode("utf-8", "replace")

    def stop(self):
        """End it."""
        if self.process is None:
            return
        self.process.kill()
        self.process.wait()
        for file in (self.process.stdin, self.process.stdout, self.errors):
            try:
                file.close()
            except BrokenPipeError:
                pass
        self.process = None


class Worker:
    """One of the processes that change decks and have them read."""

    def __init__(self, number, options, scratch, messages):
        self.number, self.options, self.messages = number, options, messages
        self.scratch = scratch / f"worker{number}"
        for path, content in companions().items():
            (self.scratch / path).parent.mkdir(parents=True, exist_ok=True)
            (self.scratch / path).write_bytes(content)
        self.reader = Reader(options.build / "sanitize" / "tests" / "many_decks", self.scratch,
                             {**SANITIZERS, "GUDGEON_COVERAGE": str(scratch / "coverage")})
        self.plain = Reader(options.build / "tests" / "many_decks", self.scratch)
        self.mutator = GuidedMutator(f"{options.seed} {number}", kinds_of(options.build / "gudgeon"))
        self.dice = random.Random(f"{options.seed} {number} choice")
        self.corpus, self.names, self.recent = [], set(), []
        self.counts = collections.Counter()

    def work(self):
        """Read the decks there are, then changes of them until the time is over."""
        end = time.monotonic() + self.options.seconds
        for place, (name, text) in enumerate(self.mutator.decks):
            if place % self.options.jobs == self.number:
                self.try_deck("check", name, text.encode("utf-8"), True)
            else:
                self.corpus.append((name, text))
        self.look_at_others(self.number, self.options.jobs)
        k = 0
        while time.monotonic() < end:
            k += 1
            name, text = self.chosen()
            data = self.mutator.changed(k, text, self.chosen()[1])[:LARGEST]
            reader = self.dice.choices(list(READERS), READERS.values())[0]
            self.try_deck(reader, name, data, False)
            if k % BETWEEN_LEAKS == 0:
                self.look_for_leaks()
                self.look_at_others(0, 1, is_read=True)
                self.tell()
        self.look_for_leaks()
        self.tell()
        self.reader.stop()
        self.plain.stop()

    def chosen(self):
        """A deck of the corpus, half of the time one of the latest; one that was there before where none has been read to its end."""
        decks = self.corpus or self.mutator.decks
        return self.dice.choice(decks[-50:] if self.dice.random() < 0.5 else decks)

    def tell(self):
        """How far it has come."""
        self.messages.put(("count", self.number, dict(self.counts)))

    def look_at_others(self, first, step, is_read=False):
        """Decks that are kept in the corpus: those of earlier runs are read, those of other workers taken as they are."""
        places = sorted(path for path in self.options.corpus.rglob("*.deck") if path not in self.names)
        for path in places[0 if is_read else first :: 1 if is_read else step]:
            self.names.add(path)
            name = (path.parent / "any.deck").relative_to(self.options.corpus).as_posix()
            data = path.read_bytes()
            if is_read:
                self.corpus.append((name, data.decode("utf-8", "replace")))
            else:
                self.try_deck("check", name, data, True)

    def place(self, name):
        """Where a deck lies while it is read: beside the one that it was made of."""
        return (self.scratch / name).with_name("deck_that_is_read.deck")

    def line(self, reader, name):
        """What tells the program to read it."""
        return f"{reader} {'--ideal ' if self.dice.random() < 0.1 else ''}{self.place(name)}"

    def try_deck(self, reader, name, data, is_kept):
        """Have a deck read; it joins the corpus if it is new, or is to be kept."""
        self.place(name).write_bytes(data)
        line = self.line(reader, name)
        self.counts["decks"] += 1
        try:
            (code, news, edges, micro), said = self.reader.read(line)
        except Fell as fall:
            self.recent.clear()
            if str(fall) == "no end":
                self.counts["slow"] += 1
                self.check_time(line, name, data)
            elif fell_for_memory(str(fall)):
                self.counts["memory"] += 1
                self.check_memory(line, name, data, str(fall))
            else:
                self.finding(line, name, data, str(fall))
            return
        self.recent.append((line, name, data))
        self.counts[f"exit {code}"] += 1
        if code not in DOCUMENTED:
            self.finding(line, name, data, f"code {code}\n{said}")
        if micro > 1e6 * LONGEST:
            self.counts["slow"] += 1
            self.check_time(line, name, data)
        if news > 0 and self.number >= 0:
            self.counts["new"] += 1
            if not is_kept:
                self.keep(name, data)
        if news > 0 or is_kept:
            self.corpus.append((name, data.decode("utf-8", "replace")))

    def keep(self, name, data):
        """A deck that led to a new edge goes to the corpus on disk."""
        path = (self.options.corpus / name).with_name(f"{self.options.seed}_{self.number}_{os.getpid()}_{self.counts['decks']:07d}.deck")
        path.parent.mkdir(parents=True, exist_ok=True)
        self.names.add(path)
        path.write_bytes(data)

    def check_time(self, line, name, data):
        """Whether the release build takes too long, too."""
        try:
            (_, _, _, micro), _ = self.plain.read(line, 10.0 * LONGEST)
        except Fell as fall:
            if fell_for_memory(str(fall)):
                return
            self.finding(line, name, data, f"in the release build: {fall}")
            return
        if micro > 1e6 * LONGEST:
            self.finding(line, name, data, f"takes {1e-6 * micro:.1f} s of processor time in the release build")

    def check_memory(self, line, name, data, said):
        """A deck for which there was no memory: it said so, and the release build does, or has it."""
        try:
            self.plain.read(line, 10.0 * LONGEST)
        except Fell as fall:
            if not fell_for_memory(str(fall)):
                self.finding(line, name, data, f"{said}\nin the release build: {fall}")

    def look_for_leaks(self):
        """Whether the last decks lost memory, and which of them."""
        try:
            lost = self.reader.read("leaks now")[0][0]
        except Fell as fall:
            self.finding("leaks", "inputs/none.deck", b"", str(fall))
            return
        if lost:
            text = self.reader.errors_text()
            self.reader.stop()
            for line, name, data in reversed(self.recent[-BETWEEN_LEAKS:]):
                self.place(name).write_bytes(data)
                try:
                    self.reader.read(line)
                    if self.reader.read("leaks now")[0][0]:
                        self.finding(line, name, data, "lost memory\n" + self.reader.errors_text())
                        break
                except Fell:
                    pass
                self.reader.stop()
            else:
                self.finding("leaks", "inputs/none.deck", b"", "lost memory\n" + text)
            self.reader.stop()
        self.recent.clear()

    def finding(self, line, name, data, said):
        """Tell of a finding."""
        self.counts["findings"] += 1
        self.messages.put(("finding", " ".join(line.split()[:-1]), name, data, said))


def fell_for_memory(said):
    """Whether a program ended because it was given no more memory, and said so as it should."""
    return said.startswith("exit 9\n") and "memory" in said and "AddressSanitizer:" not in said.replace("AddressSanitizer failed to allocate", "")


def sort_of(said):
    """What a finding is, for telling the same ones from others: the first line that says what, and the first own places."""
    head = next((line for line in said.splitlines() if re.search(r"ERROR: |runtime error|Fortran runtime|code -|lost memory|takes|no end", line)),
                said.splitlines()[0] if said else "")
    head = re.sub(r"==\d+==|0x[0-9a-f]+|\b[\d.]+ s\b", "", head)
    return head[:200], " <- ".join(f"{place}" for _, place in OWN_FRAME.findall(said)[:3])


def run_worker(number, options, scratch, messages):
    """A process of its own."""
    try:
        Worker(number, options, scratch, messages).work()
    finally:
        messages.put(("end", number))


def fuzz(options):
    """Fuzz for some seconds: findings by sort, counts, and how many edges are known."""
    sorts, counts, running = {}, {}, options.jobs
    started = told = time.monotonic()
    options.corpus.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="gudgeon_fuzz_", dir=options.scratch) as scratch:
        scratch = pathlib.Path(scratch)
        messages = multiprocessing.Queue()
        workers = [multiprocessing.Process(target=run_worker, args=(k, options, scratch, messages)) for k in range(options.jobs)]
        for worker in workers:
            worker.start()
        while running > 0:
            kind, *content = messages.get()
            if kind == "end":
                running -= 1
            elif kind == "count":
                counts[content[0]] = content[1]
            else:
                note(sorts, options, *content)
            if options.is_loud and time.monotonic() - told > 30:
                told = time.monotonic()
                print(f"{told - started:.0f} s: {summary(counts, scratch)}, {len(sorts)} sorts of findings", flush=True)
        for worker in workers:
            worker.join()
        edges = n_edges(scratch)
    total = sum((collections.Counter(count) for count in counts.values()), collections.Counter())
    if any(worker.exitcode for worker in workers):
        raise RuntimeError("a worker of the fuzzer fell over, see above")
    return sorts, total, edges


def n_edges(scratch):
    """How many edges any deck has reached."""
    path = scratch / "coverage"
    data = path.read_bytes() if path.exists() else b""
    return len(data) - data.count(0)


def summary(counts, scratch):
    """How far it has come, in words."""
    total = sum((collections.Counter(count) for count in counts.values()), collections.Counter())
    return f"{total['decks']} decks, {n_edges(scratch)} edges, {total['new']} decks with news"


def note(sorts, options, reader, name, data, said):
    """Keep the first deck of each sort of finding."""
    sort = sort_of(said)
    sorts.setdefault(sort, []).append((reader, name, data, said))
    if len(sorts[sort]) > 1:
        return
    if options.is_loud:
        print(f"finding: {reader}: {' | '.join(sort)}", flush=True)
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
        (options.keep / f"{len(sorts):03d}.deck").write_bytes(data)
        (options.keep / f"{len(sorts):03d}.txt").write_text(f"{reader} beside {name}\n{said}", errors="replace")


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True, help="directory of the release build")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", default=str(int(time.time())), help="default: another one each time")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--corpus", type=pathlib.Path, help="default: DIRECTORY/fuzz/corpus")
    parser.add_argument("--keep", type=pathlib.Path, help="directory for the decks of findings; default: DIRECTORY/fuzz/findings")
    options = parser.parse_args()
    options.build = options.build.resolve()
    options.is_loud = True
    options.corpus = options.corpus or options.build / "fuzz" / "corpus"
    options.keep = options.keep or options.build / "fuzz" / "findings"
    options.scratch = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    shutil.rmtree(options.keep, ignore_errors=True)
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    sorts, counts, edges = fuzz(options)
    for sort, cases in sorted(sorts.items(), key=lambda entry: -len(entry[1])):
        print(f"{len(cases):6d}  {' | '.join(sort)}   [{cases[0][0]}]")
    print(", ".join(f"{name}: {count}" for name, count in sorted(counts.items())))
    print(f"seed {options.seed}: {counts['decks']} decks in {options.seconds:.0f} s, {edges} edges, {sum(map(len, sorts.values()))} findings "
          f"of {len(sorts)} sorts" + (f", kept in {options.keep}" if sorts else ""))
    return 1 if sorts else 0


if __name__ == "__main__":
    sys.exit(main())
