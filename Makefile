# SPDX-FileCopyrightText: 2026 The Plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# `make help` lists the targets. Debian's own python3 must come first: catkin and ROS's scripts need it.
export PATH := /usr/bin:$(PATH)
SHELL := /bin/bash
# For cmake's make as well: its folders are of no interest.
MAKEFLAGS += --no-print-directory
# Clones of the project share what ccache holds: their own path is no part of its keys.
export CCACHE_BASEDIR := $(CURDIR)
export CCACHE_NOHASHDIR := 1
BUILD ?= build
SANITIZED := build-sanitize
JOBS ?= $(shell nproc)
SIMULATED := $(BUILD)/demo_flight
PHOTOS ?= $(SIMULATED)/photos
CAMERA ?= $(shell dirname "$(PHOTOS)")/camera.yaml

.PHONY: help has-photos deps build test test-sanitize bench demo docs format lint clean

help: ## Show the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-14s %s\n", $$1, $$2}' Makefile

deps: ## Install what is missing of Debian's packages (root or sudo)
	@scripts/install_dependencies.sh

$(BUILD)/CMakeCache.txt:
	cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=RelWithDebInfo

build: deps ## Build all: the core, the command line, the ROS nodes
	@$(MAKE) $(BUILD)/CMakeCache.txt
	cmake --build $(BUILD) -j$(JOBS)

test: build ## Build and run every test: the core's, the ROS graph's, and the core's under ASan and UBSan
	cmake --build $(BUILD) -j$(JOBS) --target tests
	source devel/setup.bash && ctest --test-dir $(BUILD) -j$(JOBS) --output-on-failure
	@$(MAKE) test-sanitize

test-sanitize: deps ## Run the core's tests under AddressSanitizer and UndefinedBehaviorSanitizer
	@test -f $(SANITIZED)/CMakeCache.txt || cmake -S . -B $(SANITIZED) \
	  -DCMAKE_BUILD_TYPE=RelWithDebInfo -DPLUMBLINE_BUILD_ROS=OFF -DPLUMBLINE_SANITIZE=ON
	cmake --build $(SANITIZED) -j$(JOBS) --target tests
	ctest --test-dir $(SANITIZED) -j$(JOBS) --output-on-failure

bench: build ## Measure accuracy and seconds a photo on the shared and the simulated scenes, into build/bench
	/usr/bin/python3 scripts/bench.py

has-photos:
	@test "$(PHOTOS)" = "$(SIMULATED)/photos" -o -d "$(PHOTOS)" || { \
	  echo "demo: no folder $(PHOTOS): give PHOTOS=dir CAMERA=camera.yaml, or neither" >&2; exit 1; }
	@test "$(origin PHOTOS)" != file -o "$(origin CAMERA)" = file || { \
	  echo "demo: CAMERA is of your own photos: give PHOTOS=dir with it, or neither" >&2; exit 1; }

# Made anew when the program or the scenario is newer.
$(SIMULATED)/.complete: devel/lib/plumbline/plumbline config/scenarios/demo.yaml
	rm -rf $(@D)
	source devel/setup.bash && rosrun plumbline plumbline simulate --scenario demo --output $(@D)
	touch $@

demo: has-photos build ## Fly a simulated facade, or PHOTOS= with CAMERA=, through the live ROS graph and RViz
	@test "$(PHOTOS)" != "$(SIMULATED)/photos" || $(MAKE) $(SIMULATED)/.complete
	source devel/setup.bash && scripts/demo.py --photos "$(PHOTOS)" --camera "$(CAMERA)" --out $(BUILD)/demo

docs: build ## Write the generated pages of docs/ anew
	scripts/parameters_doc.py $(BUILD)/list_parameters

format: ## Format all C++ sources with clang-format-14
	@scripts/install_dependencies.sh --lint
	scripts/format.sh -i

lint: ## Check format, clang-tidy-14, layers and generated pages
	@scripts/install_dependencies.sh --lint
	@$(MAKE) build
	scripts/lint.sh $(BUILD)

clean: ## Remove everything that was built
	rm -rf $(BUILD) $(SANITIZED) devel
