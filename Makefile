# Needs Python >= 3.11, Rust and make; everything else goes into .venv, exactly as pinned in requirements/.
.DEFAULT_GOAL := help
SHELL := /bin/sh

PYTHON ?= $(shell for name in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$name -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$name && break; done)
VENV := .venv
BIN := $(VENV)/bin
# One interpreter for every build of the extension, so that cargo and maturin do not rebuild behind each other's back.
export PYO3_PYTHON := $(CURDIR)/$(BIN)/python
export PIP_DISABLE_PIP_VERSION_CHECK := 1
export PIP_QUIET := 1

RUST_SOURCES := $(shell find crates -type f -not -path '*/target/*') Cargo.toml Cargo.lock
TOOLS := $(VENV)/.tools-installed
PEERS := $(VENV)/.peers-installed
BUILT := $(VENV)/.extension-built

.PHONY: help
help: ## Show this list
	@echo "usage: make TARGET"
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  %-16s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

$(TOOLS): requirements/dev.txt
	@test -n "$(PYTHON)" || { echo "evenlight needs Python >= 3.11: make PYTHON=/path/to/python3" >&2; exit 1; }
	@command -v cargo >/dev/null || { echo "evenlight needs Rust: cargo is not on the PATH" >&2; exit 1; }
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --require-hashes -r requirements/dev.txt
	@touch $@

$(PEERS): requirements/peers.txt $(TOOLS)
	$(BIN)/python -m pip install --require-hashes -r requirements/peers.txt
	@touch $@

$(BUILT): $(TOOLS) pyproject.toml $(RUST_SOURCES)
	VIRTUAL_ENV=$(CURDIR)/$(VENV) $(BIN)/maturin develop --release --locked --quiet
	@touch $@

.PHONY: setup
setup: $(BUILT) ## Make .venv and build the package into it (again only after a change)

.PHONY: demo
demo: setup ## Render a scene of ours with two samplers and say where the pictures are
	$(BIN)/python examples/demo.py

.PHONY: test
test: setup ## Run all Rust and Python tests
# In the profile of the extension: dependencies are compiled once, and what is tested is what is used.
	cargo test --locked --quiet --release --workspace --exclude evenlight-python
	$(BIN)/python -m pytest

.PHONY: test-statistics
test-statistics: setup ## Run the longer statistical tests
	cargo test --locked --quiet --release -p evenlight-points --features statistics
	$(BIN)/python -m pytest statistics

.PHONY: lint
lint: setup ## Check formatting, lints, types, stubs, docs and dependency arrows
	cargo fmt --check
	cargo clippy --locked --quiet --workspace --all-targets --all-features -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --locked --quiet --workspace --no-deps --document-private-items
	$(BIN)/ruff format --check
	$(BIN)/ruff check
	$(BIN)/mypy
	$(BIN)/python -m mypy.stubtest evenlight._core
	$(BIN)/lint-imports

.PHONY: format
format: $(TOOLS) ## Format all sources
	cargo fmt
	$(BIN)/ruff format
	$(BIN)/ruff check --fix

.PHONY: validate
validate: setup ## Compare with an independent renderer's references (EVENLIGHT_SCENES: their folder)
	$(BIN)/python -m benches.validate

.PHONY: bench
bench: setup $(PEERS) bench-points bench-quality ## Measure speed, memory and error against Mitsuba 3, SciPy and QMCPy
	$(BIN)/python -m benches.run

.PHONY: bench-points
bench-points: setup $(PEERS) ## Measure the speed of points against SciPy, QMCPy, sobol_burley and memory itself
	$(BIN)/python -m benches.points

.PHONY: bench-quality
bench-quality: setup $(PEERS) ## Measure discrepancies, indices and sorts against SciPy, SALib and NumPy
	$(BIN)/python -m benches.quality

.PHONY: bench-estimators
bench-estimators: setup $(PEERS) ## Measure estimators against QMCPy, pypmc and vegas
	OPENBLAS_NUM_THREADS=1 $(BIN)/python -m benches.estimators

.PHONY: bench-chains
bench-chains: setup $(PEERS) ## Measure chains against nutpie and BlackJAX, and what evenly spread numbers gain
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m benches.chains

.PHONY: bench-multilevel
bench-multilevel: setup $(PEERS) ## Measure multilevel methods against QMCPy, and how their costs grow
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m benches.multilevel

.PHONY: bench-smc
bench-smc: setup ## Measure particle filters against particles (EVENLIGHT_PARTICLES: an interpreter that has it)
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m benches.smc

.PHONY: docs
docs: setup ## Build the Rust documentation into target/doc
	RUSTDOCFLAGS="-D warnings" cargo doc --locked --workspace --no-deps

.PHONY: lock
lock: ## Renew the pinned requirements (needs uv)
	uv pip compile pyproject.toml --group dev --universal --python-version 3.11 --generate-hashes \
		--no-emit-index-url --upgrade --custom-compile-command "make lock" --quiet -o requirements/dev.txt
	uv pip compile pyproject.toml --group peers -c requirements/dev.txt --universal --python-version 3.11 \
		--generate-hashes --no-emit-index-url --upgrade --custom-compile-command "make lock" --quiet \
		-o requirements/peers.txt

.PHONY: clean
clean: ## Remove everything that was built or rendered
	rm -rf target $(VENV) out .mypy_cache .pytest_cache .ruff_cache .import_linter_cache
	find python -name '*.so' -delete
