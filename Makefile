# Everything a person needs: `make` lists it. Recipes use relative paths only, so that any folder will do.
.DEFAULT_GOAL := help
.PHONY: help run test test-deep mutants lint bench clean

# `make run PYTHON=/path/to/python` chooses the interpreter; else tools/make_environment.sh finds one.
export PYTHON

WORKERS ?= 2

help: ## List these commands
	@sed -nE 's/^([a-z-]+):.*## (.*)/make \1\t\2/p' Makefile | expand -t 18

run: .venv/run.stamp ## Judge the scene library on every renderer found here; write the report to results/
	.venv/bin/raytruth run

test: lint ## Check style and types, and run all tests
	.venv/bin/pytest -n $(WORKERS)

test-deep: .venv/test.stamp ## Run the properties with 10,000 random examples each, and the long simulations
	.venv/bin/pytest -n $(WORKERS) --dist worksteal --hypothesis-profile deep -m "hypothesis or simulation"

mutants: .venv/test.stamp ## Judge all mutants of the tracer's physics that has changed, by the tests and by the matrix
	.venv/bin/python -m tests.mutation

lint: .venv/test.stamp ## Check style and types only
	.venv/bin/ruff check .
	.venv/bin/ruff format --check .
	.venv/bin/mypy

bench: .venv/test.stamp ## Time the tracer beside its peers, and the truth beside floats
	.venv/bin/python -m benchmarks.peers
	.venv/bin/python -m benchmarks.truth_cost

clean: ## Remove the environment and all caches; results/ stays
	rm -rf .venv build dist *.egg-info .hypothesis .mypy_cache .pytest_cache .ruff_cache

# What Blender's library is linked with and does not bring along.
FOR_BLENDER = libgl1 libsm6 libxfixes3 libxi6 libxkbcommon0 libxrender1

# The stamps: an environment is made again only when what it is made from has changed.
.venv/run.stamp: pyproject.toml constraints.txt tools/make_environment.sh
	@bash tools/make_environment.sh '.[embree,sandbox,vtk]' bubblewrap libllvm19 povray libegl1 libgl1-mesa-dri $(FOR_BLENDER)
	@touch $@

.venv/test.stamp: pyproject.toml constraints.txt tools/make_environment.sh
	@bash tools/make_environment.sh '.[test]' bubblewrap libllvm19 povray libegl1 libgl1-mesa-dri $(FOR_BLENDER) chromium
	@touch $@ .venv/run.stamp
