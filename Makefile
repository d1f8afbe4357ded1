# Every command of the project. From a fresh clone it needs Python 3.11 or later and a Rust toolchain;
# everything else is installed into .venv, at the versions that requirements/*.txt pin.
#
#   make demo     grow the gallery's models; writes pictures and files to out/
#   make test     the engine's tests, then the package's
#   make lint     formatting, clippy, ruff, the order of imports, mypy and the stub of the engine, warnings as errors
#   make counts   instructions of a unit of work on twenty paths, beside the committed table (needs valgrind; WRITE=1:
#                 write the table again)
#   make recorded  hashes of what every method, kernel, gallery model and command gives, beside the committed table: before
#                 and after a change that must not change bits (half a minute; WRITE=1: write the table again)
#   make bench    speed compared with WebPPL and a hand-written limit, on one thread (needs node and npm)
#   make figures-sosmc  the figures and the table of chapter 5, into out/figures-sosmc (QUICK=1: a smoke run)
#   make guides   train the guides that come with the package again, into python/niwaki/guides/shipped (two minutes)
#   make figures-hmc  the figures and the tables of chapter 4, into out/figures-hmc (QUICK=1: a smoke run)
#   make figures-guides  the figures and the numbers of chapter 6, into docs/pictures/guides (QUICK=1: a smoke run)
#   make bench-c3 proposals of Markov chains compared with WebPPL and the limit, with figures (15 minutes; QUICK=1: two)
#   make bench-hmc gradients and effective samples compared with JAX, NumPyro, nutpie and the limit (4 minutes; QUICK=1: one)
#   make bench-vi  evidence bounds and seconds of variational inference, beside NumPyro and BlackJAX (QUICK=1: two models)
#   make bench-wait  seconds from a command to its last byte for each gallery model, beside Embree's primary rays
#   make bench-sketches  what a primitive costs in each sketch, beside loops by hand, parry3d and trimesh (three minutes)
#   make bench-drag  random drags of parts of five gallery models: how many arrive, why not, how soon
#   make bench-searches  the default search and others at equal CPU on many kinds of problems (QUICK=1: ten minutes)
#   make bench-fit  hidden parameters of sixteen generators, sought by optimisers with as many evaluations (hours; SEEDS=1
#                 BUDGET=300: one)
#   make bench-fit-intervals  whether intervals of `nw.fit` cover hidden parameters, and probabilities of switches are true
#   make bench-fit-furniture  furniture by other people (FURNITURE=the Debian package), fitted by a chair and a shelf
#   make bench-fit-blender  hidden values of two node trees, found by `nw.fit` (NIWAKI_BLENDER=the program, or a Python
#                 that has bpy)
#   make bench-repair  scripts repaired by few numbers; with NIWAKI_SCENE_PROGRAMS beside an optimiser made for them
#   make bench-batch  a thousand searches, killed ten times: their bytes, and the CPU beyond the searches (2 minutes)
#   make studio-page  bundle the studio's page again, into python/niwaki/studio/page (needs node and npm)
#   make test-studio  the studio in a browser: its journeys, their times, screenshots in out/studio (needs Chromium)
#   make studio-pictures  the same, and its screenshots and times go into docs/pictures
#   make blender  the extension for Blender, into out/blender (BLENDER_PYTHON=3.13: for Blender 5.1 and later)
#   make test-blender  the extension in Blender as a module, without a window (400 MB): 4.2 on Python 3.11, or 5.2 on
#                 Python 3.13 with BLENDER_PYTHON=3.13
#   make blender-pictures  the same, and its picture goes into docs/pictures
#   make soak     the long tests, with fresh printed seeds (NIWAKI_FUZZ_SECONDS: how long finite programs are tried)
#   make cluster  batches on Ray and on Dask, on this machine alone (installs both)
#   make fuzz     the fuzzers, each for MINUTES (10) by JOBS processes (1; ONLY="core_text sources": those); needs cargo-fuzz
#   make sanitize the tests of the crates with unsafe code under the address sanitizer (needs a nightly toolchain with
#                 rustup; skipped with a line where there is none)
#   make mutants  deliberate errors in the engine, which the tests must reject (ONLY=name: those); out/mutants.md
#   make wheel    the wheel of this machine, into dist/; one for Python 3.11 and later
#   make sdist    the sources that build a wheel, into dist/
#   make package  both, and their tests: empty environments without a toolchain, one for each Python of the machine
#                 (PYTHONS="/path/to/python3.12 ...": those), and a wheel from the sdist (15 minutes)
#   make licences write THIRD-PARTY again, after a change of Cargo.lock; `make lint` compares it
#   make words    Python's words for shapes and distributions, and what the manual has of them, from the engine's tables; a test
#                 compares them
#   make imports  circles of imports, and the map docs/ideas/imports.md again; a test compares it
#   make docs     the manual, into docs/_build/html, and the engine's pages, into target/doc; runs every snippet of the
#                 manual first (ONLY="files chains": those pages; minutes)
#   make format   format the sources
#   make locks    pin the newest versions of the packages in pyproject.toml
#   make clean    remove everything that these targets created

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:

PYTHON ?= $(shell for p in python3 python3.13 python3.12 python3.11; do \
  $$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
VENV := .venv
PY := $(VENV)/bin/python
STAMPS := $(VENV)/stamps
PIP := $(PY) -m pip --disable-pip-version-check --quiet

# maturin sets these for the build scripts of the binding; setting them for every cargo command keeps
# cargo from building the binding's dependencies once for the wheel and once more for the tests.
export PYO3_PYTHON := $(CURDIR)/$(PY)
export PYO3_BUILD_EXTENSION_MODULE := 1
CARGO_FLAGS := --release --locked
LIMIT := --manifest-path benches/limit/Cargo.toml --target-dir benches/.cache/limit
FUZZERS := --manifest-path fuzz/Cargo.toml --target-dir fuzz/target/lint

RUST := $(shell find crates -name '*.rs' -o -name Cargo.toml) Cargo.toml Cargo.lock
PYTHON_SOURCES := python tests benches integrations docs/conf.py docs/running

PARTS :=
PYTHONS :=
MINUTES := 10
JOBS := 1

.PHONY: all demo guides test test-rust test-python lint-rust lint-python studio-page test-studio studio-pictures blender test-blender blender-pictures lint counts recorded bench bench-c3 bench-hmc bench-vi bench-wait bench-sketches bench-drag bench-searches bench-fit bench-batch check-files figures-sosmc figures-hmc figures-guides soak cluster fuzz sanitize mutants wheel sdist package licences docs format locks clean imports words bench-fit-intervals bench-fit-furniture bench-fit-blender bench-repair
all: $(STAMPS)/engine

# ---- set-up: one stamp for each thing that is made, older than what depends on it

$(STAMPS)/venv:
	@test -n "$(PYTHON)" || { echo "no Python 3.11 or later found; name one: make PYTHON=/path/to/python3" >&2; exit 1; }
	@command -v cargo >/dev/null || { echo "no cargo found; install a Rust toolchain first" >&2; exit 1; }
	$(PYTHON) -m venv $(VENV)
	@mkdir -p $(STAMPS) && touch $@

$(STAMPS)/%: requirements/%.txt $(STAMPS)/venv
	$(PIP) install --require-hashes -r $<
	@touch $@

# A change of Rust sources or of the package's metadata builds the engine again, in place.
$(STAMPS)/engine: $(RUST) pyproject.toml $(STAMPS)/core $(STAMPS)/build
	VIRTUAL_ENV=$(CURDIR)/$(VENV) $(VENV)/bin/maturin develop $(CARGO_FLAGS)
	@touch $@

# ---- targets for users

demo: $(STAMPS)/engine
	$(PY) -m niwaki.shell.demo out

test: test-rust test-python

test-rust: $(STAMPS)/engine
	cargo test $(CARGO_FLAGS) --workspace --tests
	cargo test $(CARGO_FLAGS) --workspace --doc

test-python: $(STAMPS)/engine $(STAMPS)/test
	$(PY) -m pytest -n auto --dist worksteal

# The types of the page come from the messages; the bundle is committed, and a test compares it where node is found.
studio-page: $(STAMPS)/engine $(STAMPS)/test
	$(PY) -m niwaki.studio.types studio/page/src/messages.ts
	cd studio/page && npm ci --silent --no-audit --no-fund && npm run --silent check && npm run --silent build

# Two browsers at once; one where pictures and times are taken for the manual.
BROWSERS = $(if $(NIWAKI_PICTURES)$(NIWAKI_TIMES),,-n 2 --dist loadfile)
test-studio: $(STAMPS)/engine $(STAMPS)/test
	@if command -v chromium >/dev/null; then \
	  $(MAKE) --no-print-directory $(STAMPS)/browser && NIWAKI_BROWSER=$$(command -v chromium) $(PY) -m pytest $(BROWSERS) tests/browser; \
	else echo "no chromium found: the studio's page is not tested in a browser (apt-get install chromium)"; fi

studio-pictures:
	NIWAKI_PICTURES=docs/pictures $(MAKE) --no-print-directory test-studio

# A zip with the wheel and what it needs; pip downloads the latter, at the hashes of requirements/core.txt.
BLENDER_PYTHON := 3.11
blender: $(STAMPS)/engine wheel
	$(PY) integrations/blender/build_extension.py --wheel dist/niwaki-*.whl --python $(BLENDER_PYTHON) --out out/blender

# Blender as a module, in an environment of its own: Niwaki is only in the zip.
IN_BLENDER := $(VENV)/blender-$(BLENDER_PYTHON)
$(STAMPS)/blender-%: integrations/blender/requirements-%.txt $(STAMPS)/venv
	python$* -m venv $(VENV)/blender-$*
	$(VENV)/blender-$*/bin/python -m pip --disable-pip-version-check --quiet install --require-hashes -r $<
	$(VENV)/blender-$*/bin/python -c "import bpy"
	@touch $@

test-blender:
	@if command -v python$(BLENDER_PYTHON) >/dev/null && $(MAKE) --no-print-directory $(STAMPS)/blender-$(BLENDER_PYTHON); then \
	  $(MAKE) --no-print-directory blender && rm -rf out/blender/home && mkdir -p out/blender/home && \
	  $(MAKE) --no-print-directory check-files && NIWAKI_SOLIDS=$(CURDIR)/out/solids \
	  BLENDER_USER_RESOURCES=$(CURDIR)/out/blender/home NIWAKI_ZIP=$$(ls -t out/blender/*.zip | head -n 1) \
	    $(IN_BLENDER)/bin/python -m pytest -q -c /dev/null --rootdir tests/integrations/blender -p no:cacheprovider \
	    --confcutdir tests/integrations/blender --import-mode importlib tests/integrations/blender/inside_blender.py \
	    tests/integrations/blender/meshes_in_blender.py tests/integrations/blender/fits_in_blender.py; \
	else echo "no Blender as a module here (Python $(BLENDER_PYTHON), 400 MB, libraries of X): the extension is not tested in it"; fi

blender-pictures:
	NIWAKI_PICTURES=$(CURDIR)/docs/pictures $(MAKE) --no-print-directory test-blender

lint: lint-rust lint-python

# A folder of its own: it runs beside the build of the engine.
lint-rust: $(STAMPS)/venv
	cargo fmt --all --check
	cargo fmt --manifest-path benches/limit/Cargo.toml --check
	cargo fmt --manifest-path benches/sketches/Cargo.toml --check
	cargo fmt --manifest-path fuzz/Cargo.toml --check
	cargo clippy $(CARGO_FLAGS) --target-dir target/clippy --workspace --all-targets -- -D warnings
	cargo clippy $(CARGO_FLAGS) $(LIMIT) --all-targets -- -D warnings

lint-python: $(STAMPS)/engine $(STAMPS)/lint
	$(VENV)/bin/ruff format --check $(PYTHON_SOURCES)
	$(VENV)/bin/ruff check $(PYTHON_SOURCES)
	$(VENV)/bin/lint-imports --no-cache
	$(VENV)/bin/mypy
	$(VENV)/bin/stubtest niwaki._engine
	$(PY) tests/house/licences.py
	@if command -v cargo-deny >/dev/null; then cargo deny --locked check licenses bans sources; fi
	@if command -v actionlint >/dev/null; then actionlint; fi

counts: $(STAMPS)/engine
	$(PY) benches/counts.py $(if $(WRITE),--write)

recorded: $(STAMPS)/engine $(STAMPS)/test
	$(PY) tests/recorded/recorded.py $(if $(WRITE),--write)

bench: $(STAMPS)/engine $(STAMPS)/bench
	$(PY) benches/startup.py
	$(PY) benches/reference.py
	$(PY) benches/machine.py

guides: $(STAMPS)/engine
	$(PY) benches/shipped_guides.py $(ONLY)

figures-sosmc: $(STAMPS)/engine $(STAMPS)/bench
	$(PY) benches/figures_sosmc out/figures-sosmc $(PARTS)

figures-hmc: $(STAMPS)/engine $(STAMPS)/bench $(STAMPS)/test
	$(PY) benches/figures_hmc out/figures-hmc $(PARTS)

figures-guides: $(STAMPS)/engine $(STAMPS)/bench
	$(PY) benches/figures_guides out/figures-guides $(PARTS)

bench-c3: $(STAMPS)/engine $(STAMPS)/bench
	$(PY) benches/c3.py

# Installs half a gigabyte of peers; with them here, the tests that need JAX and ArviZ run.
bench-hmc: $(STAMPS)/engine $(STAMPS)/bench-hmc $(STAMPS)/test
	$(PY) -m pytest tests/niwaki/result/test_with_peers.py
	$(PY) benches/gradients.py

bench-vi: $(STAMPS)/engine $(STAMPS)/bench-hmc
	$(PY) benches/vi.py

bench-wait: $(STAMPS)/engine $(STAMPS)/bench
	$(PY) benches/wait.py

bench-sketches: $(STAMPS)/engine $(STAMPS)/bench
	$(PY) benches/primitives.py

bench-drag: $(STAMPS)/engine
	$(PY) benches/drag.py

bench-searches: $(STAMPS)/engine
	$(PY) benches/board.py

bench-fit: $(STAMPS)/engine $(STAMPS)/bench-fit
	$(PY) benches/black_boxes.py

bench-fit-intervals: $(STAMPS)/engine $(STAMPS)/bench-fit
	$(PY) benches/fit_intervals.py

bench-fit-furniture: $(STAMPS)/engine $(STAMPS)/bench-fit
	$(PY) benches/fit_furniture.py

bench-fit-blender: $(STAMPS)/engine
	$(PY) benches/fit_blender.py

bench-repair: $(STAMPS)/engine
	$(PY) benches/repair.py $(ONLY)

bench-batch: $(STAMPS)/engine
	$(PY) benches/batch.py

# Admesh and the validator of Khronos take part where they are installed: see the file.
check-files: $(STAMPS)/engine $(STAMPS)/test
	$(PY) benches/solid_files.py out/solids

soak: $(STAMPS)/engine $(STAMPS)/test
	NIWAKI_REPETITIONS=4 cargo test $(CARGO_FLAGS) --workspace -- --include-ignored
	$(PY) -m pytest -m soak || { status=$$?; [ $$status -eq 5 ] && echo "no long test yet" || exit $$status; }
	$(PY) tests/fuzz/fuzzers.py --minutes 1

# Installs Ray and Dask, which take 300 MB; both listen on the loopback only.
cluster: $(STAMPS)/engine $(STAMPS)/test $(STAMPS)/cluster
	$(PY) -m pytest tests/niwaki/batches

# Builds the engine once more, with counters of what a run reaches. The fuzzers' lints are here, because they build it too.
fuzz: $(STAMPS)/engine $(STAMPS)/test
	cargo clippy $(CARGO_FLAGS) $(FUZZERS) -- -D warnings
	$(PY) tests/fuzz/fuzzers.py --minutes $(MINUTES) --jobs $(JOBS) $(if $(ONLY),--only $(ONLY))

# Machine code is in `grad` and `vm`, slices of one memory in `grad`; the unsafe code of `infer` only calls instructions of
# the processor. A folder of its own, because the flags of the compiler differ.
SANITIZED := -p niwaki-grad -p niwaki-vm
HOST := $(shell rustc -vV 2>/dev/null | sed -n 's/host: //p')
sanitize: $(STAMPS)/venv
	@if cargo +nightly --version >/dev/null 2>&1; then \
	  RUSTFLAGS=-Zsanitizer=address ASAN_OPTIONS=detect_leaks=0 \
	    cargo +nightly test --release --locked --target $(HOST) --target-dir target/sanitize $(SANITIZED) --tests; \
	else echo "make sanitize needs a nightly toolchain (rustup toolchain install nightly): skipped"; fi

mutants: $(STAMPS)/venv
	$(PY) tests/mutants/mutants.py $(ONLY)

# Each replaces the one that is there. The engine is compiled with the profile of `make test`, so little is built again.
MATURIN := VIRTUAL_ENV=$(CURDIR)/$(VENV) $(VENV)/bin/maturin
wheel: $(STAMPS)/build
	rm -f dist/niwaki-*.whl
	$(MATURIN) build $(CARGO_FLAGS) --out dist

sdist: $(STAMPS)/build
	rm -f dist/niwaki-*.tar.gz
	$(MATURIN) sdist --out dist

package: $(STAMPS)/engine $(STAMPS)/test wheel sdist
	NIWAKI_PACKAGE=dist NIWAKI_PYTHONS="$(PYTHONS)" $(PY) -m pytest --durations=0 -o tmp_path_retention_policy=failed tests/package

licences: $(STAMPS)/venv
	$(PY) tests/house/licences.py --write

words: $(STAMPS)/engine
	$(PY) tests/house/words.py

imports: $(STAMPS)/venv
	$(PY) tests/house/imports.py --write

# The test extra has the libraries that pages about printing, colours and structures need.
docs: $(STAMPS)/engine $(STAMPS)/docs $(STAMPS)/test
	$(PY) docs/running/snippets.py docs/made $(ONLY)
	$(PY) docs/running/reference.py docs/made
	$(VENV)/bin/sphinx-build -W --keep-going -q -j auto -b html docs docs/_build/html
	RUSTDOCFLAGS="-D warnings" cargo doc $(CARGO_FLAGS) --workspace --exclude niwaki-py --no-deps
	@echo "the manual: docs/_build/html/index.html; the engine: target/doc/niwaki_vm/index.html"

format: $(STAMPS)/lint
	cargo fmt --all
	cargo fmt --manifest-path benches/limit/Cargo.toml
	cargo fmt --manifest-path benches/sketches/Cargo.toml
	cargo fmt --manifest-path fuzz/Cargo.toml
	$(VENV)/bin/ruff format $(PYTHON_SOURCES)
	$(VENV)/bin/ruff check --fix $(PYTHON_SOURCES)

# uv writes locks that hold on Python 3.11 and later, with hashes and without the address of an index.
locks: $(STAMPS)/venv
	$(PIP) install uv
	for extra in core build studio mcp test browser lint docs bench bench-fit bench-hmc cluster guides-oracle; do \
	  $(VENV)/bin/uv pip compile pyproject.toml $$([ $$extra = core ] || echo --extra $$extra -c requirements/core.txt) \
	    --upgrade --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header --no-annotate \
	    --quiet -o requirements/$$extra.txt; \
	done
	for python in 3.11 3.13; do \
	  $(VENV)/bin/uv pip compile integrations/blender/requirements.in --upgrade --python-version $$python \
	    --generate-hashes --no-emit-index-url --no-header --no-annotate --quiet \
	    -o integrations/blender/requirements-$$python.txt; \
	done

clean:
	rm -rf $(VENV) target out dist docs/_build docs/made benches/.cache fuzz/target fuzz/corpus fuzz/artifacts
	find python tests benches \( -name __pycache__ -o -name '*.so' \) -prune -exec rm -rf {} +
