# SPDX-License-Identifier: GPL-3.0-or-later
# Set-up, demo and tests. Each command installs what it misses, so it is also the first command of a
# newcomer; a second run installs nothing. `make` alone lists the commands.

PYTHON ?= python3
VENV ?= .venv
# The versions the tests were last run with. `make CONSTRAINTS=/dev/null` takes the newest instead.
CONSTRAINTS ?= constraints.txt
# Where `make demo` puts the scans and what it makes of them.
DEMO := demo-output

BIN := $(VENV)/bin
SUDO := $(if $(filter 0,$(shell id -u)),,sudo)
BUILD_PACKAGES := g++ cmake ninja-build python3-dev python3-venv \
  libcgal-dev libeigen3-dev libnanoflann-dev libtbb-dev libgtest-dev
# Pictures without a screen, and the scans of the demo.
DEMO_PACKAGES := libosmesa6 libcgal-demo
# A browser, to see that pages render: for the tests alone.
TEST_PACKAGES := chromium
DEBIAN_PACKAGES := $(BUILD_PACKAGES) $(DEMO_PACKAGES)
SCANS := /usr/share/doc/libcgal-dev/data.tar.gz

PACKAGE_SOURCES := CMakeLists.txt pyproject.toml $(shell find src python -type f -not -name '*.pyc')
CPP_SOURCES := $(shell find src tests/cpp examples/cpp -name '*.[ch]pp')

.NOTPARALLEL:
.PHONY: help setup demo gallery docs docs-test wheel three test lint format core sanitize pytest fuzz bench-setup results losses trained-losses clean debian

help:
	@echo "make demo      reconstruct two clouds into $(DEMO)/"
	@echo "make gallery   reconstruct twenty clouds and models into build/gallery/, for make docs"
	@echo "make test      everything below"
	@echo "make lint      ruff, mypy, import-linter, clang-format"
	@echo "make core      the C++ core: build with warnings as errors, run its tests"
	@echo "make sanitize  the same under the address and undefined-behaviour sanitizers"
	@echo "make pytest    the Python tests, on the installed package"
	@echo "make fuzz      random clouds and damaged files, see docs/robustness.md"
	@echo "make results   one suite of benchmarks, see docs/benchmark.md; make losses trains for one"
	@echo "make docs      the site, into build/site/; make docs-test runs the commands that it shows"
	@echo "make wheel     wheel and sdist into dist/, see docs/releasing.md"
	@echo "make setup     Debian packages, $(VENV)/, the package in it"
	@echo "make format    let ruff and clang-format rewrite the sources"
	@echo "make clean     remove build/, dist/, $(VENV)/ and $(DEMO)/"

# ---- set-up ----------------------------------------------------------------------------------------

# Minimal Debian images leave out /usr/share/doc, where the scans of the demo lie: hence the path-include.
debian:
	@if ! command -v dpkg-query >/dev/null; then \
	  echo "== Not Debian: please see to it that there are (Debian's names): $(BUILD_PACKAGES)"; exit 0; fi; \
	missing=$$(for package in $(DEBIAN_PACKAGES); do \
	  dpkg-query -W -f='$${Status}' $$package 2>/dev/null | grep -q 'ok installed' || echo $$package; done); \
	if [ -n "$$missing" ]; then \
	  echo "== Installing Debian packages:" $$missing; \
	  $(SUDO) apt-get update -qq && \
	  $(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends \
	    -o Dpkg::Options::=--path-include=$(SCANS) $$missing >/dev/null; fi

$(VENV)/.dependencies: pyproject.toml $(CONSTRAINTS) | debian
	@echo "== Installing Python packages into $(VENV)/ (PyTorch is the large one)"
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install -qq --upgrade 'pip>=25.1'
	$(BIN)/pip install -qq -c $(CONSTRAINTS) --group dev
	@touch $@

# Not isolated, since an isolated build would compile nanobind anew each time.
$(VENV)/.package: $(VENV)/.dependencies $(PACKAGE_SOURCES)
	@echo "== Building and installing hdpea into $(VENV)/"
	$(BIN)/pip install -qq -c $(CONSTRAINTS) --no-build-isolation '.[cluster,dataset,io,picture,texture,torch]'
	@touch $@

setup: debian $(VENV)/.package

bench-setup: setup
	$(BIN)/pip install -qq -c $(CONSTRAINTS) --group bench
	$(BIN)/pip install -qq -c $(CONSTRAINTS) --no-build-isolation '.[benchmark,cluster,dataset,io,picture,texture,torch]'

# One suite into docs/results/: make results SUITE=quick MESHES=meshes/ [MODELS="--models 5"]
results: RESULTS = results/$(basename $(notdir $(SUITE)))
results: bench-setup
	$(BIN)/hdpea benchmark $(SUITE) build/$(RESULTS) --meshes $(MESHES) $(MODELS)
	@mkdir -p docs/$(RESULTS)
	find build/$(RESULTS) -maxdepth 1 \( -name results.md -o -name "*.svg" \) -exec cp -t docs/$(RESULTS) {} +

# Hours: make losses TRAINING=meshes/train MESHES=meshes/val; goes on where it was stopped.
losses: SUITE = benchmarks/losses.toml
losses: trained-losses results

trained-losses: bench-setup
	$(BIN)/hdpea dataset build $(TRAINING) build/training
	$(BIN)/hdpea dataset build $(MESHES) build/validation
	$(BIN)/python benchmarks/training_ablation.py build/training build/validation build/losses --steps 500

# The wheel brings TBB, GMP and MPFR, and runs where glibc is no older than here. Another Python: PYTHON, and a VENV for it.
wheel: debian $(VENV)/.dependencies
	$(BIN)/pip install -qq -c $(CONSTRAINTS) --group wheel
	rm -rf build/wheel
	$(BIN)/python -m build --no-isolation --sdist --outdir dist
	$(BIN)/pip wheel -qq --no-deps --no-build-isolation --wheel-dir build/wheel .
	PATH="$(abspath $(BIN)):$$PATH" $(BIN)/auditwheel repair --strip --wheel-dir dist build/wheel/hdpea-*.whl

# three.js for the pages that hdpea writes: one bundle of what they use, in the repository. To renew it: npm, and a new
# version here and in NOTICE.
THREE := 0.187.0
PAGES := python/hdpea/pages
three:
	npm install --silent --no-save --prefix build/three three@$(THREE) esbuild@0.28
	cp $(PAGES)/three.js build/three/entry.js
	(echo "/*! three.js $(THREE), bundled for hdpea."; cat build/three/node_modules/three/LICENSE; echo "*/"; \
	  build/three/node_modules/.bin/esbuild build/three/entry.js --bundle --minify --charset=utf8 --format=iife \
	    --global-name=THREE --legal-comments=none --log-level=warning) > $(PAGES)/three.min.js
	cp build/three/node_modules/three/LICENSE LICENSES/three.txt

# ---- demo ------------------------------------------------------------------------------------------

DEMO_CLOUDS := kitten point_set_3
$(DEMO)/kitten.xyz: | debian
	@mkdir -p $(DEMO)
	tar -xzf $(SCANS) -C $(DEMO) --strip-components=2 $(DEMO_CLOUDS:%=data/points_3/%.xyz)

demo: setup $(DEMO)/kitten.xyz
	@for cloud in $(DEMO_CLOUDS); do \
	  echo "== $$cloud"; \
	  $(BIN)/hdpea reconstruct $(DEMO)/$$cloud.xyz $(DEMO)/$$cloud.obj \
	    --report $(DEMO)/$$cloud.json --picture $(DEMO)/$$cloud.png --page $(DEMO)/$$cloud.html || exit; \
	done
	@echo "== Open $(DEMO_CLOUDS:%=$(DEMO)/%.html) in a browser; pictures, meshes and reports lie beside them."

# Twenty clouds and models of libcgal-demo, with a page of each; `make docs` puts on the site what is there. Minutes.
gallery: setup
	$(BIN)/python benchmarks/gallery.py build/gallery docs/gallery.md

# ---- docs ------------------------------------------------------------------------------------------

# Every warning is an error (not with --quiet), a link that leads nowhere among them. The banner is about other programs.
docs: $(VENV)/.dependencies
	$(BIN)/pip install -qq -c $(CONSTRAINTS) --group docs
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build
	@echo "== Open build/site/index.html in a browser."

# Every command on the pages, but for those that take hours or change the machine (tools/shown_commands.py).
docs-test: setup docs
	$(BIN)/python tools/shown_commands.py

# ---- tests -----------------------------------------------------------------------------------------

test pytest: DEBIAN_PACKAGES += $(TEST_PACKAGES)

test: lint core sanitize pytest

lint: setup
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/clang-format --dry-run -Werror $(CPP_SOURCES)

format: $(VENV)/.dependencies
	$(BIN)/ruff check --fix
	$(BIN)/ruff format
	$(BIN)/clang-format -i $(CPP_SOURCES)

core: debian
	cmake --workflow --preset default

# The tests of the core, and then its Python functions fed what breaks their contracts.
SANITIZED := build/sanitize/python
sanitize: debian $(VENV)/.dependencies
	cmake --workflow --preset sanitize
	cmake build/sanitize -DHDPEA_BUILD_PYTHON=ON -DPython_EXECUTABLE=$(abspath $(BIN))/python >/dev/null
	cmake --build build/sanitize --target _core
	@mkdir -p $(SANITIZED)
	cp -r python/hdpea build/sanitize/src/bindings/_core*.so $(SANITIZED)
	mv $(SANITIZED)/_core*.so $(SANITIZED)/hdpea
	LD_PRELOAD="$$(g++ -print-file-name=libasan.so) $$(g++ -print-file-name=libubsan.so)" \
	  ASAN_OPTIONS=detect_leaks=0 PYTHONPATH=$(SANITIZED) $(BIN)/pytest tests/python/core

# The tests of a file run in one process, since they share the meshes that they look at.
pytest: setup
	$(BIN)/pytest --numprocesses 2 --dist loadfile

# Random clouds, files, commands and calls of the core, for as long as it takes: make fuzz CLOUDS=10000 SEED=7
CLOUDS ?= 10000
FILES ?= 5000
COMMANDS ?= 2000
CORE ?= 5000
SEED ?= 0
MINUTES ?= 600
fuzz: setup
	PYTHONPATH=tests/python $(BIN)/python benchmarks/fuzz.py --seed $(SEED) --minutes $(MINUTES) \
	  --clouds $(CLOUDS) --files $(FILES) --commands $(COMMANDS) --core $(CORE)

clean:
	rm -rf build dist $(VENV) $(DEMO)
