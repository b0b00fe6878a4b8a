# gudgeon: GNU make. `make help` says what there is.

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
MAKEFLAGS += --no-print-directory

# ---- what may be set on the command line or in the environment --------------------------------------

MODE ?= release
BUILD ?= build
ifeq ($(origin FC),default)
FC := gfortran
endif
ifeq ($(origin CC),default)
CC := gcc
endif
PYTHON ?= /usr/bin/python3
PREFIX ?= /usr/local
DESTDIR ?=
SUITE ?= trixie
DIR ?=
JOBS ?= $(shell nproc 2>/dev/null || echo 1)
SUNDIALS_DIR ?=
HDF5_DIR ?=
SUITESPARSE_DIR ?=
THREE_DIR ?= /usr/share/javascript/three
LAPACK ?=
ifeq ($(origin ARCH),undefined)
ifeq ($(shell uname -m),x86_64)
# a processor of 2013 or later; without its vector instructions the compiler's own default
ARCH := $(if $(shell grep -qw avx2 /proc/cpuinfo 2>/dev/null || test ! -e /proc/cpuinfo && echo yes),x86-64-v3)
endif
endif
ARCH := $(strip $(ARCH))

export FC PYTHON SUNDIALS_DIR HDF5_DIR SUITESPARSE_DIR THREE_DIR LAPACK
export OPENBLAS_NUM_THREADS := 1
export PYTHONDONTWRITEBYTECODE := 1

# ---- what people call -------------------------------------------------------------------------------

parallel = $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j$(JOBS))
inner = +@$(MAKE) $(parallel) MODE=
# Tests on all processors where pytest-xdist is there, each file of tests on one of them; PYTEST='-n 0' for one after the other
workers = $(if $(shell $(PYTHON) -c 'import xdist' 2>/dev/null && echo yes),-p xdist -n $(JOBS) --dist loadfile)

.PHONY: all install uninstall wheel debug run quick test mutate release test-sanitize test-debian check bench bench-peers new-kind-test vtk-test browser-test slurm-test stability certify release_for_tests debug_for_tests fuzz figures studies film-table film-errors lint format docs clean help
.PHONY: objects binary test_program bench_programs fuzz_program film_programs

all:
	$(inner)$(MODE) binary

debug:
	$(inner)debug binary

run:
	@scripts/setup
	$(inner)release binary
	$(BUILD)/gudgeon run inputs/slider_crank_dry.deck

pytest = @GUDGEON_BUILD=$(abspath $(BUILD)) PYTEST_DISABLE_PLUGIN_AUTOLOAD=1 $(PYTHON) -B -m pytest -c tests/pytest.ini $(workers)

# The release build only: Fortran tests, each verb once, the scripts
quick: export GUDGEON_TIER := quick
quick:
	@scripts/setup
	$(inner)release binary test_program
	$(pytest) $(PYTEST) tests/test_fortran.py tests/e2e/test_smoke.py tests/scripts

test:
	@scripts/setup
	+@$(MAKE) $(parallel) release_for_tests debug_for_tests
	$(pytest) --durations=15 $(PYTEST) tests

# Both builds at once: while one waits for a long source or links, the other has work for all processors
release_for_tests debug_for_tests:
	+@$(MAKE) MODE=$(@:_for_tests=) binary test_program fuzz_program

# Changes one operator, constant or condition of src at a time and counts the tests that notice; N, SEED, DIR=src/math
SEED ?= 1
mutate:
	@scripts/setup
	@$(PYTHON) -B scripts/mutate --build $(abspath $(BUILD))/mutate -n $(if $(filter command line,$(origin N)),$(N),40) --seed $(SEED) $(if $(DIR),--folders $(DIR)) $(MUTATE)

# Checks that version, changelog, citation and man page agree, and writes build/gudgeon-VERSION.tar.gz
release:
	$(inner)release binary
	@$(PYTHON) -B scripts/release $(abspath $(BUILD))

# The tests in a build with the sanitizers of addresses, leaks and undefined behaviour, an hour; what they say is in build/sanitize/reports
test-sanitize:
	@scripts/setup
	$(inner)sanitize binary test_program fuzz_program
	@scripts/test_sanitize $(abspath $(BUILD)) $(workers) $(PYTEST)

test-debian:
	@scripts/test_debian $(SUITE) $(or $(DIR),$(BUILD)/debian/$(SUITE))

install:
	$(inner)release binary
	@scripts/install $(abspath $(BUILD))/gudgeon $(PREFIX) $(DESTDIR)

# The Python package with the program inside
wheel:
	$(inner)release binary
	@$(PYTHON) -B scripts/make_wheel $(abspath $(BUILD))/gudgeon $(abspath $(BUILD))

uninstall:
	@scripts/install --remove $(abspath $(BUILD))/gudgeon $(PREFIX) $(DESTDIR)

check:
	$(inner)debug test_program
	@$(BUILD)/debug/tests/run_tests $(TESTS)

bench:
	$(inner)release binary bench_programs
	@GUDGEON_BUILD=$(abspath $(BUILD)) tests/bench/run_bench.sh $(BENCH)

# Other programs on the same scenes: PEERS='--quick' for options of tests/bench/peers/peers.py
bench-peers:
	$(inner)release binary
	@tests/bench/peers/set_up.sh $(abspath $(BUILD))/bench/peers
	@$(PYTHON) -B tests/bench/peers/peers.py --build $(abspath $(BUILD)) $(PEERS)

# the worked examples of docs/developer/new-kind.md added to a copy of the sources, built and run; some minutes
new-kind-test:
	$(inner)release binary
	@GUDGEON_NEW_KIND=1 GUDGEON_BUILD=$(abspath $(BUILD)) PYTEST_DISABLE_PLUGIN_AUTOLOAD=1 \
	  $(PYTHON) -B -m pytest -c tests/pytest.ini $(PYTEST) tests/scripts/test_new_kind.py

# motion.vtkhdf read by VTK itself, from PyPI in a virtual environment
vtk-test:
	$(inner)release binary
	@tests/vtk/set_up.sh $(abspath $(BUILD))/vtk
	@$(BUILD)/vtk/venv/bin/python -B tests/vtk/read_motion.py $(BUILD)/gudgeon $(BUILD)/vtk/run

# the pages of animations, and the site where there is one, opened by Chromium, without a window
browser-test:
	$(inner)release binary
	@$(PYTHON) -B tests/browser/open_pages.py $(BUILD)/gudgeon $(BUILD)/browser
	@$(PYTHON) -B tests/browser/open_site.py $(BUILD)/docs/site

# a sweep as a job array of a Slurm on this host, with tasks that are killed and out of time; as root, see docs/reference/batch.md
slurm-test:
	$(inner)release binary
	@tests/slurm/run.sh $(abspath $(BUILD))/gudgeon $(abspath $(BUILD))/slurm

stability:
	@scripts/setup
	$(inner)release binary
	@$(PYTHON) -B tests/stability/stability.py --build $(abspath $(BUILD)) $(STABILITY)
	@GUDGEON_ALL_DECKS=1 GUDGEON_BUILD=$(abspath $(BUILD)) PYTEST_DISABLE_PLUGIN_AUTOLOAD=1 \
	  $(PYTHON) -B -m pytest -c tests/pytest.ini $(workers) $(PYTEST) tests/e2e/test_one_peak.py tests/e2e/test_unknown_numbers.py

# runs killed at random moments: readable, and resumed bit for bit; KILL='--restarts 5 --kills 20 --seed 1' for options
kill-test:
	@scripts/setup
	$(inner)release binary
	@$(PYTHON) -B tests/restart/kill_runs.py $(BUILD)/gudgeon $(KILL)

# whether the intervals of `gudgeon run --accuracy` hold the true errors of random decks; CERTIFY='-n 50 --seed 2' for options
certify:
	$(inner)release binary
	@$(PYTHON) -B tests/accuracy/certify.py --build $(abspath $(BUILD)) $(CERTIFY)

# SECONDS=1800: guided by coverage, with the sanitizers, FUZZ='--seed 2' for options of tests/fuzz/guided.py. Without: N mutants in
# each build; FUZZ='--run 0.5 --seed 2' for options of tests/fuzz/fuzz.py
N ?= 1000
ifeq ($(origin SECONDS),command line)
fuzz:
	$(inner)release binary fuzz_program
	$(inner)sanitize fuzz_program
	@$(PYTHON) -B tests/fuzz/guided.py --build $(BUILD) --seconds $(SECONDS) $(FUZZ)
else
fuzz:
	$(inner)release binary fuzz_program
	$(inner)debug binary fuzz_program
	@$(PYTHON) -B tests/fuzz/fuzz.py --build $(abspath $(BUILD)) -n $(N) $(FUZZ)
	@$(PYTHON) -B tests/fuzz/fuzz.py --build $(abspath $(BUILD)) --debug -n $(N) $(FUZZ)
endif

figures:
	@scripts/setup
	$(inner)release binary
	@scripts/make_figures.sh $(BUILD)/gudgeon

studies:
	@scripts/setup
	$(inner)release binary
	@scripts/make_studies $(BUILD)/gudgeon $(STUDIES)

# The tables of `finite` and of the side flow from films on a grid, some minutes; and the errors of all films against the grid
film-table:
	$(inner)release film_programs
	@$(BUILD)/films/film_table > $(BUILD)/films/finite_table.inc && mv $(BUILD)/films/finite_table.inc src/mechanics/lubrication/
	@$(BUILD)/films/flow_table > $(BUILD)/films/finite_flow.inc && mv $(BUILD)/films/finite_flow.inc src/mechanics/lubrication/

film-errors:
	$(inner)release film_programs
	@$(BUILD)/films/film_errors > $(BUILD)/films/film_errors.csv && mv $(BUILD)/films/film_errors.csv docs/data/

lint:
	@scripts/lint $(abspath $(BUILD))

format:
	@scripts/lint $(abspath $(BUILD)) --format

docs:
	$(inner)release binary
	@$(PYTHON) -B scripts/make_docs $(BUILD)

clean:
	rm -rf $(BUILD)

help:
	@echo "make            build/gudgeon                        make debug    build/debug/gudgeon, all checks"
	@echo "make run        set up, build, run a first deck       make figures  run every deck of inputs/"
	@echo "make quick      set up, build release, Fortran tests and each verb once: under 2 minutes after the build"
	@echo "make test       set up, build both, run every test    make check    Fortran tests only: TESTS='module[.name] ...'"
	@echo "make test PYTEST='-m \"not slow\"'  omits the tests that take more than 5 s"
	@echo "make mutate     tests of the tests: N=40 SEED=1 DIR='src/...' changes of one operator or constant, survivors listed"
	@echo "make release    checks that version, changelog, citation and man page agree; build/gudgeon-VERSION.tar.gz"
	@echo "make bench      the timers of tests/bench             make lint     format and style; make format corrects the format"
	@echo "make bench-peers  other programs (Simbody, MuJoCo, Exudyn) on the same scenes: time against error; PEERS='--quick'"
	@echo "make new-kind-test  the worked examples of docs/developer/new-kind.md added to a copy of the sources, built and run"
	@echo "make vtk-test   the file of a motion (motion = vtkhdf) read by VTK itself, from PyPI in a virtual environment"
	@echo "make browser-test  pages of animations and of runs opened by Chromium: no error, another picture after a step"
	@echo "make slurm-test    a sweep as a job array of a Slurm on this host, with tasks killed and out of time (as root)"
	@echo "make stability  the hard cases of inputs/hard, each stabilisation method beside its limit; extremes of all decks"
	@echo "make kill-test  runs killed at random moments, read and resumed; KILL='--kills 20' for options"
	@echo "make certify    intervals of 'run --accuracy' against the true errors of 200 random decks; CERTIFY='-n 50' for options"
	@echo "make fuzz       N=1000 broken decks through check, explain and run in both builds; FUZZ='--run 0.5' for options"
	@echo "make fuzz SECONDS=1800  the deck reader, guided by coverage, in a build with sanitizers; FUZZ='--seed 2' for options"
	@echo "make test-sanitize  the tests in a build with sanitizers of addresses, leaks, undefined behaviour: an hour; PYTEST='-k reader'"
	@echo "make studies    the sweeps of inputs/studies, some minutes: STUDIES=--docs copies their results to docs/data and docs/figures"
	@echo "make film-table   the table of the film 'finite' anew, some minutes; make film-errors: docs/data/film_errors.csv"
	@echo "make docs       pages of docs/reference, the site in build/docs/site, API pages; make clean: remove build/"
	@echo "make install    program, man page, completions, decks below PREFIX=/usr/local; make uninstall takes them away again"
	@echo "make wheel      build/gudgeon-VERSION-py3-none-PLATFORM.whl: the Python package with the program inside"
	@echo "make test-debian  as root: 'make run && make test' in a bare Debian SUITE=trixie|bookworm in DIR=build/debian/SUITE"
	@echo "make -j objects compile all sources without linking (-k: continue after errors)"
	@echo
	@echo "Variables: MODE=release|debug  ARCH=x86-64-v3 (ARCH= for the compiler's default)  BUILD=build  JOBS=$(JOBS)"
	@echo "           SUNDIALS_DIR= HDF5_DIR= SUITESPARSE_DIR= (prefixes)  THREE_DIR= (three.js)  LAPACK='-L... -l...'  FC=gfortran  PYTHON=/usr/bin/python3"
	@echo "           LINK=static|shared (libraries within the program, where Debian's archives are there; a path above means shared)"
	@echo "           PREFIX=/usr/local DESTDIR= (before every path installed)"
	@echo "           PYTEST='-k expression' (options for make test)  STABILITY='--required A02' (options for make stability)"
	@echo "           BENCH='--quick --docs' (options for make bench; --docs writes docs/theory/evidence/performance.md)"

# ---- building one mode ------------------------------------------------------------------------------

ifeq ($(MODE),release)
B := $(BUILD)
else ifneq ($(filter $(MODE),debug sanitize),)
B := $(BUILD)/$(MODE)
else
$(error MODE=$(MODE): release, debug or sanitize)
endif

ifneq ($(filter binary test_program bench_programs fuzz_program film_programs objects,$(MAKECMDGOALS)),)

ifeq ($(shell command -v $(FC)),)
$(error $(FC) not found: scripts/setup installs what is needed)
endif

# SUNDIALS: Debian's place, or a prefix. Its version and its kind of index go to the sources that the preprocessor reads.
SUNDIALS_PREFIX := $(or $(SUNDIALS_DIR),/usr)
SUNDIALS_MODULES := $(patsubst %/fcvode_mod.mod,%,$(firstword $(wildcard $(patsubst %,$(SUNDIALS_PREFIX)/%/fcvode_mod.mod,\
                    include/sundials/fortran fortran include))))
SUNDIALS_VERSION := $(if $(wildcard $(SUNDIALS_MODULES)/fsundials_core_mod.mod),7,$(if \
                    $(wildcard $(SUNDIALS_MODULES)/fsundials_context_mod.mod),6))
SUNDIALS_INDEX := $(if $(shell grep '^.define SUNDIALS_INT64_T' $(SUNDIALS_PREFIX)/include/sundials/sundials_config.h 2>/dev/null),64,32)
ifeq ($(SUNDIALS_VERSION),)
$(error no Fortran modules of SUNDIALS 6 or 7 in $(SUNDIALS_PREFIX): scripts/setup installs what is needed, SUNDIALS_DIR= names a prefix)
endif

# three.js: scripts that the page of an animation holds
THREE_FILES := $(THREE_DIR)/build/three.min.js $(THREE_DIR)/examples/js/controls/OrbitControls.js
ifneq ($(words $(wildcard $(THREE_FILES))),2)
$(error no three.js in $(THREE_DIR): scripts/setup installs what is needed (libjs-three), THREE_DIR= names a folder)
endif

# The source tree: two levels of folders, docs/developer/architecture.md.
MAIN := src/app/main.f90
SOURCES := $(filter-out $(MAIN),$(sort $(wildcard src/*/*.f90 src/*/*/*.f90 src/*/*/*.F90)))
C_SOURCES := $(sort $(wildcard src/*/*/*.c))
TEST_SOURCES := $(sort $(wildcard tests/unit/test_*.f90 tests/identity/test_*.f90 tests/order/test_*.f90 \
                tests/invariance/test_*.f90))
TEST_HELPERS := $(sort $(filter-out $(TEST_SOURCES),$(wildcard tests/*.f90 tests/unit/*.f90 tests/identity/*.f90 \
                tests/order/*.f90 tests/order/*.F90 tests/invariance/*.f90)))
BENCH_MAINS := $(sort $(shell grep -li '^program ' /dev/null $(wildcard tests/bench/*.f90)))
FILM_MAINS := $(sort $(shell grep -li '^program ' /dev/null $(wildcard tests/films/*.f90)))
FILM_HELPERS := $(sort $(filter-out $(FILM_MAINS),$(wildcard tests/films/*.f90)))
FUZZ_MAIN := tests/fuzz/many_decks.f90
COVERAGE := tests/fuzz/coverage.c
BENCH_HELPERS := $(sort $(filter-out $(BENCH_MAINS),$(wildcard tests/bench/*.f90)))
GENERATED := $(B)/build_info.f90 $(B)/tests/run_tests.f90

object = $(patsubst %,$(B)/obj/%.o,$(basename $(1)))
# Sources and folders named below for flags of their own: a name that is not there ends make.
named = $(foreach f,$(1),$(if $(wildcard $(f)),$(f),$(error Makefile names $(f), which is not there)))
named_objects = $(call object,$(call named,$(1)))
of_folders = $(addsuffix /%,$(call named,$(addprefix src/,$(1))))
OBJECTS := $(call object,$(SOURCES) $(C_SOURCES)) $(B)/obj/gen/build_info.o
MAIN_OBJECT := $(call object,$(MAIN))
TEST_OBJECTS := $(call object,$(TEST_SOURCES) $(TEST_HELPERS)) $(B)/obj/gen/run_tests.o
BENCH_PROGRAMS := $(BENCH_MAINS:tests/bench/%.f90=$(B)/bench/%)
FILM_PROGRAMS := $(FILM_MAINS:tests/films/%.f90=$(B)/films/%)

# Libraries: Debian's places, or prefixes.
comma := ,
SUNDIALS_INCLUDE := -I$(SUNDIALS_MODULES)
SUNDIALS_PATH := $(foreach d,$(wildcard $(SUNDIALS_DIR:%=%/lib) $(SUNDIALS_DIR:%=%/lib64)),-L$(d) -Wl,-rpath,$(d))
SUNDIALS_LIBRARIES := $(SUNDIALS_PATH) -lsundials_farkode_mod -lsundials_fcvode_mod -lsundials_fida_mod \
  -lsundials_fkinsol_mod -lsundials_fsunnonlinsolfixedpoint_mod -lsundials_fsunnonlinsolnewton_mod \
  -lsundials_fsunlinsoldense_mod -lsundials_fsunmatrixdense_mod -lsundials_fsunlinsolklu_mod \
  -lsundials_fsunmatrixsparse_mod -lsundials_fsunlinsolspgmr_mod -lsundials_fnvecserial_mod \
  -lsundials_arkode -lsundials_cvode -lsundials_ida -lsundials_kinsol -lsundials_sunnonlinsolfixedpoint \
  -lsundials_sunnonlinsolnewton -lsundials_sunlinsoldense -lsundials_sunmatrixdense -lsundials_sunlinsolklu \
  -lsundials_sunmatrixsparse -lsundials_sunlinsolspgmr -lsundials_nvecserial
ifneq ($(SUNDIALS_VERSION),6)
SUNDIALS_LIBRARIES += -lsundials_fcore_mod -lsundials_core
endif

ifneq ($(HDF5_DIR),)
HDF5_INCLUDE := $(patsubst %,-I%,$(sort $(HDF5_DIR)/include \
                $(dir $(wildcard $(patsubst %,$(HDF5_DIR)/%/hdf5.mod,include include/* mod/* lib)))))
HDF5_LIBRARIES := $(foreach d,$(wildcard $(HDF5_DIR)/lib $(HDF5_DIR)/lib64),-L$(d) -Wl,-rpath,$(d)) -lhdf5_fortran -lhdf5_hl -lhdf5
else ifneq ($(shell pkg-config --exists hdf5-serial 2>/dev/null && echo yes),)
HDF5_INCLUDE := $(shell pkg-config --cflags hdf5-serial)
HDF5_LIBRARIES := -lhdf5_serial_fortran -lhdf5_serial_hl $(shell pkg-config --libs hdf5-serial)
else ifneq ($(shell command -v h5fc 2>/dev/null),)
HDF5_SHOW := $(shell h5fc -show)
HDF5_INCLUDE := $(filter -I%,$(HDF5_SHOW))
HDF5_LIBRARIES := $(filter -L% -l% -Wl% %.a,$(HDF5_SHOW))
else
HDF5_INCLUDE := -I/usr/include/hdf5/serial
HDF5_LIBRARIES := -lhdf5_serial_fortran -lhdf5_serial_hl -lhdf5_serial
endif

ifneq ($(SUITESPARSE_DIR),)
SUITESPARSE_PATH := $(foreach d,$(wildcard $(SUITESPARSE_DIR)/lib $(SUITESPARSE_DIR)/lib64),-L$(d) -Wl,-rpath,$(d))
endif

# Debian's archives where all are there and no other place is named: a program that has its libraries in it begins in 2 ms; loading
# some sixty, of which HDF5 and MPI need most, takes it ten. OpenBLAS without threads, whose sums are the same on all machines. KLU, its
# BTF and libquadmath are loaded, from libexec/gudgeon beside bin first: their licence, the LGPL, asks that users can replace them.
OPENBLAS := $(firstword $(wildcard /usr/lib/*/openblas-serial/libopenblas.a))
ARCHIVES := $(and $(OPENBLAS),$(wildcard /usr/lib/*/libsundials_fcvode_mod.a),$(wildcard /usr/lib/*/libhdf5_serial_fortran.a), \
  $(wildcard /usr/lib/*/libsz.a),$(wildcard /usr/lib/*/libaec.a),$(wildcard /usr/lib/*/libz.a),$(wildcard /usr/lib/*/libklu.so))
LINK ?= $(if $(SUNDIALS_DIR)$(HDF5_DIR)$(SUITESPARSE_DIR)$(LAPACK),shared,$(if $(ARCHIVES),static,shared))
ifeq ($(LINK),static)
# Archives that want no others: those of SUNDIALS 7 want MPI, that of HDF5 after 1.10 curl and OpenSSL; these are loaded. What
# blas_threads looks up at run time stays visible.
HDF5_MINOR := $(shell awk '/define H5_VERS_MINOR/ { print $$3 }' /usr/include/hdf5/serial/H5public.h 2>/dev/null)
HDF5_ARCHIVES := $(if $(filter 10,$(HDF5_MINOR)),-lhdf5_serial_fortran -lhdf5_serial_hl -lhdf5_serial -lsz -laec -lz)
SUNDIALS_ARCHIVES := $(if $(filter 6,$(SUNDIALS_VERSION)),-Wl$(comma)--start-group $(SUNDIALS_LIBRARIES) -Wl$(comma)--end-group)
# gfortran's own too, but where a library that is loaded brings it along, and in the sanitized build, whose tools want it loaded.
RUN_TIME := $(if $(and $(HDF5_ARCHIVES),$(SUNDIALS_ARCHIVES),$(filter-out sanitize,$(MODE))), \
  $(wildcard $(shell $(FC) -print-file-name=libgfortran.a)) -static-libgcc)
LIBRARIES := -Wl,--as-needed $(if $(SUNDIALS_ARCHIVES),,$(SUNDIALS_LIBRARIES)) $(if $(HDF5_ARCHIVES),,$(HDF5_LIBRARIES)) \
  -Wl,-Bstatic $(SUNDIALS_ARCHIVES) $(HDF5_ARCHIVES) \
  $(foreach f,openblas_set_num_threads blas_memory_alloc blas_memory_free,-Wl$(comma)-u$(comma)$(f) -Wl$(comma)--export-dynamic-symbol=$(f)) \
  $(OPENBLAS) $(RUN_TIME) -Wl,-Bdynamic -lklu -lpthread -ldl -lm -Wl,--disable-new-dtags -Wl,-rpath,'$$ORIGIN/../libexec/gudgeon'
else ifeq ($(LINK),shared)
LIBRARIES := -Wl,--as-needed $(SUNDIALS_LIBRARIES) $(HDF5_LIBRARIES) $(SUITESPARSE_PATH) -lklu \
  $(or $(LAPACK),-llapack -lblas) -lm
else
$(error LINK=$(LINK): static or shared)
endif

# Off, because contracts need the noise: arguments that one kind does not use, comparing with an exact zero. Off too: gfortran's
# false alarms about allocatable descriptors (signalling NaN finds the real ones) and about queries of files in conditions.
WARNINGS := -Wall -Wextra -Wimplicit-interface -Wno-unused-dummy-argument -Wno-compare-reals \
            -Wno-maybe-uninitialized -Wno-uninitialized -Wno-function-elimination
ifeq ($(MODE),release)
# Loops here are short: as calls of memcpy and memset (loop-distribute-patterns) they take longer. Vectors of the two components
# of a point (slp-vectorize) take longer too: they are put together from memory, just written, and taken apart again.
# A program at a fixed place needs not be adjusted to where it was loaded: a fifth of its start. Of the notes for debuggers the
# numbers of lines, for profiles: all of them take an eighth of the time to compile.
FIXED_PLACE := -no-pie
OPTIMISE := -O3 -fno-tree-loop-distribute-patterns -fno-tree-slp-vectorize -fno-pie -g1 $(ARCH:%=-march=%)
else ifeq ($(MODE),sanitize)
# Wrong accesses and leaks of memory, and what the language leaves undefined: the first one ends the program.
# Of the undefined in Fortran, sums, shifts and conversions: checks of the pointer at each access to a component make the compiler
# take minutes for a file, and where an access is wrong the address tells.
SANITIZE := -fno-sanitize-recover=all -fno-omit-frame-pointer -fsanitize=address,undefined,float-cast-overflow
OPTIMISE := -O1 -g -fno-var-tracking -fno-sanitize-recover=all -fno-omit-frame-pointer \
            -fsanitize=address,signed-integer-overflow,integer-divide-by-zero,shift,float-cast-overflow
else
# No trap for overflow: a number of a deck that leads there is told as one that is not finite, by both builds alike.
OPTIMISE := -Og -g -fcheck=all,no-array-temps -ffpe-trap=invalid,zero -finit-real=snan \
            -finit-derived -fbacktrace -Werror
endif
FFLAGS := -std=f2018 -fimplicit-none $(WARNINGS) $(OPTIMISE)
DEFINES := -DSUNDIALS_VERSION=$(SUNDIALS_VERSION) -DSUNDIALS_INDEX=$(SUNDIALS_INDEX)
CFLAGS := -std=c11 -Wall -Wextra $(filter -fno-pie,$(OPTIMISE)) $(filter-out -f%,$(OPTIMISE))$(if $(SANITIZE), $(SANITIZE))
PREFIX_MAP := -ffile-prefix-map=$(CURDIR)=.
COMPILE = $(FC) $(FFLAGS) $(PREFIX_MAP) -J$(B)/mod -I$(B)/mod $(SUNDIALS_INCLUDE) $(HDF5_INCLUDE)
# Lists of objects go by files: a shell takes 128 kB of words at most.
LINK_PROGRAM = $(file >$@.objects,$(sort $(filter %.o,$^)))$(FC) $(FFLAGS) $(FIXED_PLACE) -o $@ @$@.objects $(LIBRARIES)

# Files that change only when their content does: flags, what is linked, build_info, the test program.
keep_if_equal = cmp -s $(1).new $(1) && rm -f $(1).new || mv $(1).new $(1)
$(shell mkdir -p $(sort $(B)/mod $(B)/obj/gen $(B)/tests $(B)/bench $(B)/films \
  $(dir $(call object,$(SOURCES) $(C_SOURCES) $(MAIN) $(TEST_SOURCES) $(TEST_HELPERS) $(BENCH_MAINS) $(BENCH_HELPERS) \
  $(FILM_MAINS) $(FILM_HELPERS) $(FUZZ_MAIN) $(COVERAGE)))))
$(shell { $(FC) --version | head -n 1; echo '$(COMPILE) $(DEFINES) $(CC) $(CFLAGS)'; } > $(B)/flags.new; \
  $(call keep_if_equal,$(B)/flags); \
  scripts/buildinfo $(FC) '$(FFLAGS)' > $(B)/build_info.f90.new; $(call keep_if_equal,$(B)/build_info.f90); \
  awk -f scripts/testmain.awk $(TEST_SOURCES) > $(B)/tests/run_tests.f90.new; \
  $(call keep_if_equal,$(B)/tests/run_tests.f90))
$(file >$(B)/objects.new,$(OBJECTS) $(TEST_OBJECTS) $(LIBRARIES))
$(shell $(call keep_if_equal,$(B)/objects))
ifneq ($(shell awk -v obj=$(B)/obj -v mod=$(B)/mod -v gen=$(B) -f scripts/moddeps.awk $(SOURCES) $(MAIN) \
  $(TEST_HELPERS) $(TEST_SOURCES) $(BENCH_HELPERS) $(BENCH_MAINS) $(FILM_HELPERS) $(FILM_MAINS) $(FUZZ_MAIN) \
  $(GENERATED) > $(B)/deps.mk || echo failed),)
$(error the modules do not fit together, see above)
endif

# $(1): source. The object is there; only its .mod is missing, so compile once more.
define compile_if_gone
@test -f $@ || { echo "  FC $(1) (for $(@F))"; $(COMPILE) $(if $(filter %.F90,$(1)),$(DEFINES)) -c $(1) -o $<; }
endef

include $(B)/deps.mk
stale := $(filter-out $(interfaces),$(wildcard $(B)/mod/*.mod $(B)/mod/*.smod))
ifneq ($(stale),)
$(shell rm -f $(stale))
endif

# Text that becomes part of the program
page := src/results/figures/page_bytes
$(call object,$(call named,$(page).c)): private CFLAGS += -DTHREE='"$(THREE_DIR)"'
$(call object,$(page).c): $(wildcard src/results/figures/page/*) $(THREE_FILES)

objects: $(OBJECTS) $(TEST_OBJECTS) $(MAIN_OBJECT) $(call object,$(BENCH_MAINS) $(FILM_MAINS) $(FUZZ_MAIN))
binary: $(B)/gudgeon
test_program: $(B)/tests/run_tests
bench_programs: $(BENCH_PROGRAMS)
film_programs: $(FILM_PROGRAMS)
fuzz_program: $(B)/tests/many_decks

# gudgeon.linked lists every file that the linker read: scripts/notices has the licences of those that are in the program.
$(B)/gudgeon: $(MAIN_OBJECT) $(OBJECTS) $(B)/objects
	@echo "  LD $@"
	@$(LINK_PROGRAM) -Wl,--trace > $@.linked

$(B)/tests/run_tests: $(TEST_OBJECTS) $(OBJECTS) $(B)/objects
	@echo "  LD $@"
	@$(LINK_PROGRAM)

$(BENCH_PROGRAMS): $(B)/bench/%: $(B)/obj/tests/bench/%.o $(call object,$(BENCH_HELPERS)) $(OBJECTS) $(B)/objects
	@echo "  LD $@"
	@$(LINK_PROGRAM)

$(FILM_PROGRAMS): $(B)/films/%: $(B)/obj/tests/films/%.o $(call object,$(FILM_HELPERS) $(TEST_HELPERS)) $(OBJECTS) $(B)/objects
	@echo "  LD $@"
	@$(LINK_PROGRAM)

$(B)/tests/many_decks: $(call object,$(FUZZ_MAIN) $(COVERAGE)) $(OBJECTS) $(B)/objects
	@echo "  LD $@"
	@$(LINK_PROGRAM)

# What runs once takes longer to optimise than it can gain: the reading of decks, the verbs, the studies and the figures; and the tests,
# not what they test: with -O1 or -Og some take three times as long to compile. The verbs, and the files that copy whole scenes, take
# twice as long with -O1 or -Og as without: a copy of a scene is thousands of statements.
COPIES_SCENES := $(patsubst %,src/%.f90,analysis/assembly/driver_conflict analysis/dynamic/subsystems input/builder/scene_groups \
  input/scene/read_scene input/scene/scene results/writers/precision_file studies/accuracy/accuracy_search \
  studies/accuracy/accuracy_trial studies/life/life_rates studies/orbit/campbell studies/orbit/linear_state \
  studies/orbit/orbit_source studies/orbit/period_map studies/precision/reference_search studies/runs/jobs \
  studies/sensitivity/varied_system studies/tolerance/sensitivities)
ONCE := $(call object,$(filter $(call of_folders,app),$(SOURCES))) $(call named_objects,$(COPIES_SCENES))
ifeq ($(MODE),release)
RUNS_ONCE := input/scene input/adams studies results/figures results/comparison
$(filter-out $(ONCE),$(call object,$(filter $(call of_folders,$(RUNS_ONCE)),$(SOURCES)))): private FFLAGS += -O1
endif
ifneq ($(MODE),sanitize)
$(ONCE): private FFLAGS += -O0
$(TEST_OBJECTS): private FFLAGS += -O0 $(if $(filter release,$(MODE)),-ffrontend-optimize)
endif

# Kernels that are text of a procedure so that they are part of it: the compiler finds sine and cosine too large for that. Their loops
# are of one or two bodies or contacts: what makes long loops fast is in their way, and so is what keeps more at hand than there are
# registers.
ifeq ($(MODE),release)
SHORT_LOOPS := -fno-tree-ch -fira-region=one -fno-move-loop-invariants -fno-tree-slsr
$(call named_objects,src/mechanics/system/mechanism_direct.f90): private FFLAGS += -O2 -fno-gcse -fno-code-hoisting -fno-tree-pre $(SHORT_LOOPS) \
  --param=max-inline-insns-auto=200
$(call named_objects,src/mechanics/clearance/round_contacts.f90): private FFLAGS += $(SHORT_LOOPS) --param=max-inline-insns-auto=200
# what is looked at after each step
$(call named_objects,$(patsubst %,src/%.f90,analysis/dynamic/dynamic analysis/times/output_times analysis/monitors/guards \
  analysis/monitors/contact_monitor_steps integrators/contract/integrator mechanics/reduction/planar_one_dof \
  mechanics/system/mechanism_scales)): private FFLAGS += $(SHORT_LOOPS)
$(call named_objects,$(patsubst %,src/mechanics/%.f90,system/balanced_report clearance/round_reports)): private FFLAGS += -O2 -fno-gcse --param=max-inline-insns-auto=200
endif

# What reads decks and makes kinds of their rows notes where it goes, for `make fuzz SECONDS=`.
ifeq ($(MODE),sanitize)
COVERED := $(addprefix foundation/,core text units numerics curves expressions contracts) input/functions input/deck input/scene \
  input/builder $(addprefix mechanics/,contact lubrication joints forces clearance)
$(call object,$(filter $(call of_folders,$(COVERED)),$(SOURCES))): private FFLAGS += -fsanitize-coverage=trace-pc
$(B)/gudgeon $(B)/tests/run_tests: $(call object,$(COVERAGE))
endif

$(B)/obj/%.o: %.f90 $(B)/flags
	@echo "  FC $<"
	@$(COMPILE) -c $< -o $@

$(B)/obj/%.o: %.F90 $(B)/flags
	@echo "  FC $<"
	@$(COMPILE) $(DEFINES) -c $< -o $@

$(B)/obj/gen/build_info.o: $(B)/build_info.f90 $(B)/flags
	@$(COMPILE) -c $< -o $@

$(B)/obj/gen/run_tests.o: $(B)/tests/run_tests.f90 $(B)/flags
	@$(COMPILE) -c $< -o $@

$(B)/obj/%.o: %.c $(B)/flags
	@echo "  CC $<"
	@$(CC) $(CFLAGS) $(PREFIX_MAP) $(HDF5_INCLUDE) -MMD -MP -c $< -o $@

-include $(patsubst %.o,%.d,$(call object,$(C_SOURCES) $(COVERAGE)))

endif
