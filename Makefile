# make reproduce   run the studies of the paper's claims and write the report; QUICK=1 shortens them; PERTURBED=SEED and
#                  TARGET=NAME run them with other rounding beside the plain results (python -m validation --help)
# make test        the fast tests, in two processes, then those of pages in a browser, which skip without Chromium
#                  (BROWSER=0 leaves them out)
# make bench       time the benchmarks on this machine, keep the times in .benchmarks for --benchmark-compare, and race
#                  the kernels against those of the accepted baseline
# make docs        write the docs site to docs/out: open docs/out/index.html
# make lint        check style, types and allowed imports
# make bullet      build pybullet from source, which has no wheel for Python 3.12 and later: needs a C++ compiler and
#                  about six minutes of one core
# make rivals      install the packages of rivals.lock (some 0.6 GB) in an environment of their own, .venv-rivals, which
#                  sees those of the suite too; .venv-rivals/bin/python -m validation --rivals compares with them
# make next-numba  try the newest numba in an environment of its own, .venv-next: the compiled code and its cache
# make lowest      test with the lowest versions that pyproject.toml allows, in an environment of their own, .venv-lowest
# make clean       remove results, report and caches; the environment in .venv stays
#
# Needs Python 3.11 to 3.14 (tested on 3.11) and make; `make -C CHECKOUT ...` works from any folder.

BIN := .venv/bin
# Touched after a full installation, so that set-up runs once for each state of these two files.
STAMP := .venv/installed
FLAGS := $(if $(filter-out 0,$(QUICK)),--quick) $(if $(PERTURBED),--perturbed $(PERTURBED)) $(if $(TARGET),--target $(TARGET))
# The first of these that starts; a command may exist and fail to start.
PYTHON ?= $(shell for p in python3.11 python3.12 python3.13 python3.14 python3; do $$p -c '' 2>/dev/null && { echo $$p; break; }; done)

# Where the user's cache cannot be written, as in a read-only home, what would lie there lies in the checkout.
CACHE := $(if $(XDG_CACHE_HOME),$(XDG_CACHE_HOME),$(HOME)/.cache)
ifneq ($(shell mkdir -p '$(CACHE)/fctd' 2>/dev/null && test -w '$(CACHE)/fctd' && echo kept),kept)
export XDG_CACHE_HOME := $(CURDIR)/.cache
endif

# Said before the work begins; minutes on two cores from an empty cache of compiled code, as in the README.
SET_UP_TAKES := 2
TESTS_TAKE := $(if $(filter 0,$(BROWSER)),7,11)
STUDIES_TAKE := $(if $(filter-out 0,$(QUICK)),4,10)

.PHONY: reproduce test bench docs lint bullet rivals next-numba lowest clean say-tests say-studies

say-tests:
	@echo "tests: about $(TESTS_TAKE) minutes on two cores"

say-studies:
	@echo "studies and report: about $(STUDIES_TAKE) minutes on two cores"

reproduce: say-studies $(STAMP)
	@status=0; $(BIN)/python -m validation --reproduce $(FLAGS) || status=$$?; \
	if [ $$status -le 1 ]; then $(BIN)/python -m reports || status=1; fi; exit $$status

# Without compiled files, each process would compile the tests and the suite anew; what is compiled before they begin is
# compiled once.
test: export PYTHONDONTWRITEBYTECODE :=
test: say-tests $(STAMP)
	@$(BIN)/python -m compileall -q fctd references validation reports benchmarks docs
	@$(BIN)/python -m fctd compile
	$(BIN)/python -m pytest --numprocesses=2 --dist=worksteal
ifneq ($(BROWSER),0)
	$(BIN)/python -m pytest --numprocesses=2 --dist=loadfile -m browser -q tests
endif

bench: $(STAMP)
	$(BIN)/python -m pytest benchmarks --benchmark-enable --benchmark-autosave --benchmark-sort=name
	$(BIN)/python -m benchmarks gate

docs: $(STAMP)
	rm -rf docs/out
	$(BIN)/python -m sphinx -W -q -j auto -b html docs docs/out

lint: $(STAMP)
	$(BIN)/python -m ruff check
	$(BIN)/python -m ruff format --check
	$(BIN)/python -m mypy
	$(BIN)/lint-imports

$(STAMP): requirements.lock pyproject.toml
	@[ -n "$(PYTHON)" ] || { echo "error: no python3 found; Python 3.11 to 3.14 is needed" >&2; exit 1; }
	@$(PYTHON) -c 'import sys; v = sys.version_info; \
	sys.exit(None if (3, 11) <= v < (3, 15) else "error: Python 3.11 to 3.14 is needed; $(PYTHON) is %d.%d (make PYTHON=... names another)" % v[:2])'
	@echo "set-up first: about $(SET_UP_TAKES) minutes on two cores, and the download"
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile --only-binary=:all: -r requirements.lock
	@$(BIN)/python -m compileall -qq -j 0 .venv/lib || true # pip uses one core, and ignores what is no Python, too
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	@touch $@

bullet: $(STAMP)
	$(BIN)/python -m pip install --disable-pip-version-check --no-deps --no-build-isolation --use-pep517 \
	--no-binary=pybullet "$$(sed -n 's/^\(pybullet==[^ ;]*\).*/\1/p' requirements.lock)"

rivals: .venv-rivals/installed

# The environment sees the suite's packages, so that pip finds those of the first lock installed. What is never imported
# is not compiled.
.venv-rivals/installed: $(STAMP) rivals.lock
	$(BIN)/python -m venv --without-pip .venv-rivals
	$(BIN)/python -c 'from sysconfig import get_path as path; \
	open(path("purelib", vars={"base": ".venv-rivals"}) + "/suite.pth", "w").write("import site; site.addsitedir(%r)\n" % path("purelib"))'
	.venv-rivals/bin/python -m pip install --quiet --disable-pip-version-check --no-compile --only-binary=:all: \
	-r requirements.lock -r rivals.lock
	.venv-rivals/bin/python -m pip check --disable-pip-version-check
	@touch $@

next-numba: $(STAMP)
	rm -rf .venv-next && cp -a .venv .venv-next
	.venv-next/bin/python -m pip install --quiet --disable-pip-version-check --upgrade --pre numba
	.venv-next/bin/python -c 'import numba; print("numba", numba.__version__)'
	.venv-next/bin/python -m pytest -q -m 'slow or not slow' tests/mechanics tests/steady tests/test_package.py

# Python 3.11, as later ones have no wheels of these versions. Pins and users' extras are read from pyproject.toml.
lowest: $(STAMP)
	rm -rf .venv-lowest && $(PYTHON) -m venv .venv-lowest
	$(BIN)/python .ci/lowest.py > .venv-lowest/pins
	.venv-lowest/bin/python -m pip install --quiet --disable-pip-version-check --only-binary=:all: -r .venv-lowest/pins
	.venv-lowest/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation -e .
	.venv-lowest/bin/python -m pip check --disable-pip-version-check
	.venv-lowest/bin/python -m pytest -q tests/case tests/store tests/results tests/model tests/hydraulics \
	tests/mechanics tests/steady tests/monitoring tests/plots tests/report tests/sweep/test_design.py tests/sweep/test_indices.py

clean:
	rm -rf .cache .venv-next .venv-lowest validation/results reports/out docs/out build dist *.egg-info .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis .benchmarks
	find . -name __pycache__ -not -path './.venv/*' -prune -exec rm -rf {} +
