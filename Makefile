# The short way to everything: each target installs what is missing (scripts/install-deps.sh), configures a preset of
# CMakePresets.json, builds and runs. JOBS says how many things are done at once.
JOBS ?= $(shell nproc)
export JOBS
export CMAKE_BUILD_PARALLEL_LEVEL := $(JOBS)
SHELL := /bin/bash
.SHELLFLAGS := -e -o pipefail -c
MAKEFLAGS += --no-print-directory

configure = cmake --preset $(1) --log-level=WARNING $(2) >/dev/null
build = cmake --build build/$(1) $(2)
# Failures with their output, and the summary; not a line for each test that passed.
ctest = ctest --test-dir build/$(1) --parallel $(JOBS) --output-on-failure --no-tests=error \
	| grep --line-buffered -Ev '^ *Start +[0-9]+:|Test +\#[0-9]+: .* (Passed|\*\*\*Skipped) '

.PHONY: help demo test bench lint format test-asan test-tsan test-scalar fuzz install clean

help: ## this list
	@sed -nE 's/^([a-z-]+):.*## (.*)/make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 18

demo: ## build, and light the example scenes into out/
	@scripts/install-deps.sh demo
	@$(call configure,release)
	@$(call build,release,--target laterna_cli side_by_side)
	@scripts/demo.sh

test: ## check the includes, build, run every test
	@scripts/install-deps.sh build
	@scripts/check_includes.py
	@$(call configure,release)
	@$(call build,release)
	@$(call ctest,release)

bench: ## how the cost of a frame grows, and every kernel, as tables; QUICK=1 for a glance
	@scripts/install-deps.sh bench
	@$(call configure,release,-DLATERNA_BUILD_BENCHMARKS=ON)
	@$(call build,release,--target growth_bench kernels_bench)
	@scripts/bench.sh $(if $(QUICK),--quick)

lint: ## clang-format and clang-tidy
	@scripts/install-deps.sh bench lint
	@$(call configure,lint)
	@scripts/lint.sh build/lint

format: ## let clang-format rewrite the sources
	@scripts/install-deps.sh lint
	@scripts/sources.sh | xargs clang-format-14 -i

test-asan: ## every test with AddressSanitizer and UndefinedBehaviorSanitizer
	@scripts/install-deps.sh build
	@$(call configure,asan)
	@$(call build,asan)
	@export ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1; \
	$(call ctest,asan)

test-tsan: ## every test with ThreadSanitizer
	@scripts/install-deps.sh build
	@$(call configure,tsan)
	@$(call build,tsan)
	@export TSAN_OPTIONS="halt_on_error=1:second_deadlock_stack=1:suppressions=$(CURDIR)/tests/tsan.supp"; \
	$(call ctest,tsan)

test-scalar: ## every test with kernels of one lane only
	@scripts/install-deps.sh build
	@$(call configure,scalar)
	@$(call build,scalar)
	@$(call ctest,scalar)

fuzz: ## each fuzzer for 60 s
	@scripts/install-deps.sh fuzz
	@scripts/fuzz.sh

install: ## the library and the program into PREFIX, by default /usr/local
	@scripts/install-deps.sh build
	@$(call configure,release)
	@$(call build,release,--target laterna laterna_cli)
	@cmake --install build/release $(if $(PREFIX),--prefix $(PREFIX))

clean: ## remove build/ and out/
	@rm -rf build out
