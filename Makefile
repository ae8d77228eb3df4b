# Two commands do all set-up on a fresh machine: `make` runs the default experiment, `make test` runs the tests.
SHELL := bash
.SHELLFLAGS := -eu -o pipefail -c
VENV := .venv
BIN := $(VENV)/bin
PYTHON ?= $(shell command -v python3.11 || command -v python3)
READY := $(VENV)/.ready
ASSETS := src/morphoskel/reporting/assets
PIP_AUDIT := 2.10.1
THREE := 0.187.0
ESBUILD := 0.28.2

.PHONY: all test lint unit fuzz plan test-load test-faults test-cluster slurm bench format lock licences audit viewer help clean

all: $(READY) ## every table and figure on the embedded data set (results/demo)
	@$(BIN)/morphoskel run

test: lint unit ## format, lint and type checks, unit and property tests, and the smallest experiment end to end

lint: $(READY) ## format, lint and type checks alone
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/snakefmt --check Snakefile workflow
	$(BIN)/mypy
	PATH="$(CURDIR)/$(BIN):$$PATH" $(BIN)/python -m snakemake --lint

unit: $(READY) ## tests alone; `make unit ARGS="-k dilation"` picks some
	$(BIN)/pytest --numprocesses auto --maxprocesses 8 --dist loadfile $(ARGS)

plan: $(READY) ## what the published protocol will cost, or any: `make plan ARGS="experiment=demo --at-once 4"`
	@$(BIN)/morphoskel plan $(or $(ARGS),experiment=paper)

test-load: $(READY) ## as many shapes as ModelNet40 has through the chain, interrupted twice; goes on where it was (results/load)
	$(BIN)/python -m tests.load $(ARGS)

test-faults: $(READY) ## runs that are killed, damaged and starved of disk, and what a rerun makes of them (some as root only)
	$(BIN)/pytest -m "faults or not faults" tests/faults $(ARGS)

test-cluster: slurm ## the smallest experiment through a SLURM cluster on this machine; TARGETS="table_... key=value" for a part of it
	tests/cluster/install_slurm
	CLUSTER_TARGETS="$(TARGETS)" $(BIN)/pytest tests/cluster/through_slurm.py $(ARGS)

slurm: $(READY) ## add what submits jobs to a SLURM cluster to the environment
	$(BIN)/pip install --disable-pip-version-check --quiet --constraint requirements.lock --no-build-isolation --editable ".[slurm]"

bench: $(READY) ## speed and memory beside the released computation; `make bench ARGS=scaling` picks one
	$(BIN)/python -m benchmarks $(ARGS)

fuzz: $(READY) ## damaged files for every reader; `make fuzz ARGS="ply npz --count 100000 --seed 1"` picks some
	PYTHONPATH=tests $(BIN)/python -m fuzz $(ARGS)

format: $(READY) ## rewrite all code in the project's format
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .
	$(BIN)/snakefmt Snakefile workflow

$(READY): requirements.lock pyproject.toml
	@$(PYTHON) -c 'import sys; v = sys.version_info[:2]; sys.exit(None if v == (3, 11) else "Python 3.11 is needed, this is %d.%d; name one with: make PYTHON=/path/to/python3.11" % v)'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --disable-pip-version-check --quiet --requirement requirements.lock
	$(BIN)/pip install --disable-pip-version-check --quiet --no-deps --no-build-isolation --editable .
	$(BIN)/python -m morphoskel.system_libraries
	$(BIN)/python -m morphoskel.precompile
	@touch $(READY)

lock: ## pin the newest versions that pyproject.toml admits, in requirements.lock and environment.yml
	$(PYTHON) -m venv --clear $(VENV)-lock
	$(VENV)-lock/bin/pip install --disable-pip-version-check --quiet torch==2.13.0 hatchling editables ".[dev]"
	$(VENV)-lock/bin/python -m morphoskel.lock
	$(VENV)-lock/bin/python -m morphoskel.licences
	rm -rf $(VENV)-lock

licences: $(READY) ## list the licences of the pinned packages in docs/licences.md
	$(BIN)/python -m morphoskel.licences

audit: ## known vulnerabilities of the pinned packages; asks the package index, and fails if it cannot answer
	$(PYTHON) -m venv --clear $(VENV)-audit
	$(VENV)-audit/bin/pip install --disable-pip-version-check --quiet pip-audit==$(PIP_AUDIT)
	$(VENV)-audit/bin/pip-audit --strict --no-deps --disable-pip --requirement requirements.lock
	rm -rf $(VENV)-audit

viewer: ## bundle the script of the interactive viewer anew, with the three.js and esbuild pinned here (needs npm)
	scratch=$$(mktemp -d); trap 'rm -rf "$$scratch"' EXIT; \
	cp $(ASSETS)/viewer*.js "$$scratch"; rm -f "$$scratch/viewer.min.js"; cd "$$scratch"; \
	digest=$$(LC_ALL=C; cat viewer*.js | sha256sum | cut -c -16); \
	npm install --no-save --no-audit --no-fund --ignore-scripts three@$(THREE) esbuild@$(ESBUILD); \
	banner="/* MorphoSkel viewer, made by make viewer of sources $$digest. Holds three.js $(THREE), see three.LICENSE. */"; \
	node_modules/.bin/esbuild viewer.js --bundle --minify --format=iife --target=es2022 --legal-comments=none \
		--banner:js="$$banner" --outfile=viewer.min.js; \
	cp viewer.min.js "$(CURDIR)/$(ASSETS)/viewer.min.js"; \
	cp node_modules/three/LICENSE "$(CURDIR)/$(ASSETS)/three.LICENSE"

help: ## this list
	@grep -hE '^[a-z-]+:.*## ' Makefile | sed -E 's/^([a-z-]+):.*## (.*)/  make \1|\2/' | column -t -s '|'

clean: ## remove the results and the generated data; keeps the environment, results/reference and downloads
	@read -r -p "Remove results/* (but not results/reference) and resources/manifest, resources/data/synthetic*? [y/N] " answer; \
	if [ "$$answer" = y ]; then \
		find results -mindepth 1 -maxdepth 1 ! -name README.md ! -name reference -exec rm -rf {} +; \
		rm -rf resources/manifest resources/data/synthetic*; \
	fi
