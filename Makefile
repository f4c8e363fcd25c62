# The front door: what a fresh Debian 12 machine needs is installed on the way.
.DEFAULT_GOAL := help
.PHONY: help install install-tests configure configure-tests package install-package perifrac build run mpi test test-mpi test-slow check-style tidy docs site tutorials scenes experiments gallery paper stability forecast effects instructions study study-quick toughness faults attack fuzz fuzz-many sanitize mutants bench benchmarks clean

FUZZ_SECONDS ?= 60
FUZZ_INPUTS ?= 10000000
ATTACK_COUNT ?= 3000
ATTACK_JOBS ?= 2
SCENE ?= configs/hf_complete.yaml
BUILD := build/release
PERIFRAC := $(BUILD)/bin/perifrac

help:
	@echo 'make run        install, build, run $(SCENE), say where the picture is'
	@echo 'make test       install, build, run all tests but the slow ones'
	@echo 'make test-slow  the slow verification runs'
	@echo 'make package    a Debian package, and a folder that runs from anywhere (docs/install.md)'
	@echo 'make install-package  makes the package and installs it'
	@echo 'make paper      the figures of the paper, its scheme beside ours (some 40 minutes)'
	@echo 'make mpi        a program that mpirun divides among processes: docs/many_machines.md'
	@echo 'make test-mpi   its tests'
	@echo 'make bench      kernels, timed'
	@echo 'make benchmarks  kernels beside LAMMPS, growth to ten million points, scenes: docs/benchmarks.md (some 20 minutes, 17 GB)'
	@echo 'make docs       write docs/configuration.md and configs/perifrac.schema.json anew'
	@echo 'make site       the pages as a site to read and search offline: build/release/site/docs/index.html'
	@echo 'make tutorials  runs the tutorials and takes their pictures anew'
	@echo 'make gallery    docs/gallery.md: twelve scenes with picture, command and time (some minutes)'
	@echo 'make scenes     errors that all shipped scenes reach: docs/scenes.md (some twenty minutes, 5 GB)'
	@echo 'make experiments  scenes beside measurements: docs/experiments.md'
	@echo 'make toughness  K_app / K_IC of both fracture criteria (docs/fracture.md), some minutes'
	@echo 'make study-quick  error against wall time of explicit and implicit pore flow'
	@echo 'make study  every study of configs/studies; writes the pictures of docs/studies.md anew'
	@echo 'make forecast  run times that check foretells beside those that runs take: docs/forecast.md'
	@echo 'make effects    what each effect costs in time and memory: docs/effects.md'
	@echo 'make instructions  that absent effects cost none, and work follows activity (valgrind)'
	@echo 'make stability  hard cases in many combinations of modules: docs/stability.md'
	@echo 'make faults     kills, full disks, spoilt checkpoints and more at random moments: docs/reliability.md'
	@echo 'make attack     ATTACK_COUNT made-up scenes, run at two spacings and windows: docs/reliability.md'
	@echo 'make fuzz       scenes and checkpoints made up by a fuzzer, FUZZ_SECONDS each (clang 16)'
	@echo 'make fuzz-many  FUZZ_INPUTS checkpoints, without the address sanitizer, which is faster (clang 16)'
	@echo 'make tidy       length and complexity of our functions (clang-tidy 16)'
	@echo 'make mutants    physics changed by the patches of tests/mutants: the tests named there must fail'
	@echo 'make sanitize   unit and contract tests under the address, undefined and thread sanitizers, and cracks that cut rock free (clang 16)'

# What running needs; tests need more.
install:
	@tools/install run

install-tests:
	@tools/install test

# Tests are part of the build where what they need is there.
configure: install
	@cmake --preset $$(tools/install --is-there test && echo release || echo program) --log-level=WARNING > /dev/null

configure-tests: install-tests
	@cmake --preset release --log-level=WARNING > /dev/null

perifrac: configure
	@cmake --build --preset release --target perifrac

build: configure-tests
	@cmake --build --preset release

# One build for each instruction set: docs/install.md.
package:
	@tools/install package
	@cmake --preset package $(PACKAGE_OPTIONS) --log-level=WARNING > /dev/null
	@cmake --build build/package --target perifrac_launcher perifrac_pages all
	@cd build/package && cpack > cpack.log || { cat cpack.log; exit 1; }
	@ls -sh build/package/packages/*.deb build/package/packages/*.tar.gz

install-package: package
	$$([ $$(id -u) = 0 ] || echo sudo) apt-get install -y ./build/package/packages/perifrac*.deb

run: perifrac
	@$(PERIFRAC) run $(SCENE)

test: build check-style
	ctest --preset release --label-exclude slow

# Tests come with it where what they need is there.
mpi:
	@tools/install run mpi
	@cmake --preset mpi -DPERIFRAC_TESTS=$$(tools/install --is-there test && echo ON || echo OFF) --log-level=WARNING > /dev/null
	@cmake --build build/mpi --target perifrac
	@echo 'mpirun -n 2 build/mpi/bin/perifrac run $(SCENE)'

test-mpi: install-tests mpi
	@cmake --build build/mpi --target contract_coupling contract_physics
	@ctest --test-dir build/mpi --output-on-failure --label-regex ranks

test-slow: build
	@command -v npm > /dev/null || tools/install editor
	ctest --preset release --label-regex slow

check-style: install-tests
	@tools/check_style

tidy:
	@tools/install clang
	@tools/check_tidy

bench: build
	$(BUILD)/bin/perifrac_bench

benchmarks: build
	@tools/install test peers
	@/usr/bin/python3 bench/benchmarks/benchmarks.py $(PERIFRAC) $(BUILD)/bin/perifrac_bench

paper: perifrac
	@/usr/bin/python3 docs/paper/figures.py $(PERIFRAC)

docs: perifrac
	$(PERIFRAC) list --page > docs/configuration.md
	$(PERIFRAC) schema > configs/perifrac.schema.json

# Broken links and anchors are errors.
site: install-tests
	sphinx-build -q -W --keep-going -c docs/site . $(BUILD)/site
	@echo $(BUILD)/site/docs/index.html

tutorials: perifrac
	tests/docs/tutorials.py $(PERIFRAC) --pictures

# Goes on where it was stopped, as studies do.
scenes: perifrac
	@/usr/bin/python3 docs/collect_scenes.py $(PERIFRAC) $(FRESH)

experiments: perifrac
	@/usr/bin/python3 -B tests/verification/experiments/rubin_1983.py $(PERIFRAC) --page
	@/usr/bin/python3 -B tests/verification/experiments/wu_2008.py $(PERIFRAC) --page

# Twelve scenes with pictures; some ten minutes. Goes on where it was stopped.
gallery: perifrac
	@/usr/bin/python3 docs/collect_gallery.py $(PERIFRAC) $(FRESH)

# Studies go on where they were stopped. FRESH=--fresh runs everything again, as on another machine.
study-quick: perifrac
	$(PERIFRAC) study configs/studies/explicit_or_implicit.yaml $(FRESH)

study: perifrac
	@for file in configs/studies/*.yaml; do $(PERIFRAC) study $$file $(FRESH) || exit; done
	@/usr/bin/python3 docs/collect_studies.py runs

forecast: perifrac
	tests/verification/forecast.py $(PERIFRAC) --page docs/forecast.md

effects: perifrac
	bench/effects/effects.py $(PERIFRAC) --page docs/effects.md

# valgrind knows no AVX-512: a build of its own.
instructions: install-tests
	@cmake -S . -B build/portable -G Ninja -DPERIFRAC_NATIVE=OFF -DPERIFRAC_TESTS=OFF -DPERIFRAC_BENCH=ON > /dev/null
	@cmake --build build/portable --target perifrac perifrac_solid_step
	bench/effects/instructions.py build/portable

stability: perifrac
	tests/stability/stability.py $(PERIFRAC) --page docs/stability.md

faults: perifrac
	tests/robustness/faults.py $(PERIFRAC) --kills 50 --page docs/reliability.md

# Goes on where it was stopped.
attack: perifrac
	nice tests/attack/attack.py $(PERIFRAC) --count $(ATTACK_COUNT) --jobs $(ATTACK_JOBS)

fuzz: perifrac
	@tools/install clang
	@cmake --preset sanitize --log-level=WARNING > /dev/null
	cmake --build build/sanitize --target fuzz_scene fuzz_checkpoint
	tests/fuzz/fuzz.py $(PERIFRAC) build/sanitize/bin --seconds $(FUZZ_SECONDS)

fuzz-many: perifrac
	@tools/install clang
	@cmake --preset fuzz --log-level=WARNING > /dev/null
	cmake --build build/fuzz --target fuzz_checkpoint
	tests/fuzz/fuzz.py $(PERIFRAC) build/fuzz/bin --only checkpoint --inputs $(FUZZ_INPUTS)

sanitize: install-tests
	@tools/install clang
	for preset in sanitize sanitize-thread; do \
	  cmake --preset $$preset --log-level=WARNING > /dev/null && cmake --build --preset $$preset && \
	  ctest --preset $$preset || exit; done
	GLIBC_TUNABLES=glibc.malloc.hugetlb=0 OMP_WAIT_POLICY=passive tests/robustness/cut_free_test.py build/sanitize/bin/perifrac --times 20

mutants: configure-tests
	tests/mutants/mutants.py

toughness: configure-tests
	@cmake --build --preset release --target verification_slow
	$(BUILD)/bin/verification_slow --gtest_filter=*Toughness*

clean:
	rm -rf build
