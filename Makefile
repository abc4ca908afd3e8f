# `make` lists the verbs. Each installs what it needs and nothing twice (docker/install.sh).

HOST := 127.0.0.1
PORT := 8000
DATA := data

SHELL := /bin/bash
python := .venv/bin/python
gl := export TEXLOOM_GL="$$(docker/install.sh gl)"
pytest := $(python) -m pytest -n 2 --dist loadfile --timeout 300

.DEFAULT_GOAL := help
.PHONY: help run test test-all check fix bench faults soak gallery lock clean installed

help:
	@echo 'Texloom: describe a texture or a scene in JSON, get back a picture.'
	@grep -E '^[a-z-]+:.*## ' Makefile | sed -E 's/:[^#]*## /\t/' | expand -t 12

run: ## serve on 127.0.0.1:8000; HOST=.. PORT=.. DATA=.. change address and data folder
	@docker/install.sh run
	@$(gl) TEXLOOM_HOST='$(HOST)' TEXLOOM_PORT='$(PORT)' TEXLOOM_DATA='$(DATA)'; \
	docker/install.sh warm && exec $(python) -m service

test: installed ## the tests that need no corpus and no fuzzing: under ten minutes on two cores
	@$(gl); TEXLOOM_DATA=.cache docker/install.sh warm && $(pytest) -m 'not corpus and not contract'

# One more session: what `make test` left out, and the OpenGL tests on the other platform.
test-all: test ## that, the corpus, the other OpenGL platform and the contract fuzzing
	@$(gl); \
	if [ "$$TEXLOOM_GL" = osmesa ]; then \
		export TEXLOOM_GL=egl; extra='gl or corpus or contract'; \
	else \
		echo 'texloom: no second OpenGL platform here, EGL is the only one'; \
		extra='corpus or contract'; \
	fi; \
	$(pytest) -m "$$extra"

check: installed ## lint, format, types, import contracts, locks in step with pyproject.toml
	$(python) -m ruff check .
	$(python) -m ruff format --check .
	$(python) -m mypy
	$(python) .venv/bin/lint-imports
	$(python) docker/lock.py check

fix: installed ## repair what ruff can repair, format, write openapi.json anew
	$(python) -m ruff check --fix .
	$(python) -m ruff format .
	$(python) -m service.openapi

bench: installed ## measure, and write tests/benchmarks/RESULTS.md
	@$(gl); $(python) -m tests.benchmarks.run

faults: installed ## run jobs while processes are killed and the disk fills, and count what is lost
	@$(gl); TEXLOOM_DATA=.cache docker/install.sh warm && $(python) -m tests.faults

soak: installed ## keep a service busy for twenty minutes, and watch its memory and open files
	@$(gl); TEXLOOM_DATA=.cache docker/install.sh warm && $(python) -m tests.soak

gallery: installed ## draw every example anew
	@$(gl); $(python) -m tests.gallery

lock: installed ## resolve the dependencies of pyproject.toml anew into both locks
	$(python) docker/lock.py make

clean: ## remove .venv and every cache; the data folder stays
	rm -rf .venv .cache .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache \
		.schemathesis schemathesis-report tests/.failures build dist *.egg-info
	find api_schemas service worker tests -name __pycache__ -type d -prune -exec rm -rf {} +

installed:
	@docker/install.sh dev
