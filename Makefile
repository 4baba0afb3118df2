# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# make demo   install the packages of the command, build it, flatten the bundled creature, list the files
# make test   install also the packages of tests, build, run every test, list tests that did not run
# make test-core    the same without browsers, gmsh, VTK and MPI: a third of the packages
# make install PREFIX=/usr/local    install the build
# make wheel  the Python package with its libraries, dist/*.whl; PYTHON=/usr/bin/python3.12: for another Python;
#             GPL=OFF: without code under the GPL or LGPL, built in build/permissive
# make blender-addon  the add-on for Blender with such wheels inside, dist/majorant_blender.zip
# make site   docs/ and the pages of the headers as a site with a search, build/site/index.html
# make command | build | asan | tsan | bench | clean
JOBS ?= $(shell nproc)
PREFIX ?= /usr/local
GPL ?= ON
BUILD = $(if $(filter OFF,$(GPL)),build/permissive,build/release)
BINARY = $(BUILD)/apps/majorant
OUT = out
PYTHON ?= /usr/bin/python3
JUNIT = --test-output-size-passed 100000 --output-junit

# The generator of an existing build tree; else Ninja if it is installed, else make.
GENERATOR = $(or $(shell sed -n 's/^CMAKE_GENERATOR:INTERNAL=//p' $(BUILD)/CMakeCache.txt 2> /dev/null),\
                 $(if $(shell command -v ninja 2> /dev/null),Ninja,Unix Makefiles))

.PHONY: demo install test test-core build setup test-setup core-setup configure command asan tsan bench site wheel blender-addon clean

demo: command
	@mkdir -p $(OUT)
	@$(BINARY) parametrize examples/meshes/creature.obj --degree 3 -o $(OUT)/creature.vtu \
	  -o $(OUT)/creature.obj -o $(OUT)/creature.svg -o $(OUT)/creature.html \
	  --report $(OUT)/creature.json
	@echo "the map, for ParaView:        $(OUT)/creature.vtu"
	@echo "textured mesh, for Blender:   $(OUT)/creature.obj"
	@echo "the layout, for any browser:  $(OUT)/creature.svg"
	@echo "both views, for any browser:  $(OUT)/creature.html"
	@echo "report:                       $(OUT)/creature.json"

install:
	@test -x $(BINARY) || { echo "nothing is built yet; first: make command" >&2; exit 1; }
	@cmake --install $(BUILD) --prefix $(PREFIX)

test: build
	@ctest --preset release -j $(JOBS) -LE mpi --no-tests=error $(JUNIT) tests.xml; status=$$?; \
	  ctest --preset release -L mpi $(JUNIT) tests_mpi.xml || status=$$?; \
	  /usr/bin/python3 cmake/scripts/skipped_tests.py build/release/tests.xml build/release/tests_mpi.xml; \
	  exit $$status

test-core: core-setup configure
	cmake --build $(BUILD) -j $(JOBS)
	@ctest --preset release -j $(JOBS) -LE mpi --no-tests=error $(JUNIT) tests.xml; status=$$?; \
	  /usr/bin/python3 cmake/scripts/skipped_tests.py build/release/tests.xml; exit $$status

setup:
	@cmake/scripts/install_packages.sh

core-setup:
	@cmake/scripts/install_packages.sh cmake/scripts/packages_python.txt cmake/scripts/packages_core.txt

test-setup:
	@cmake/scripts/install_packages.sh cmake/scripts/packages_python.txt cmake/scripts/packages_core.txt cmake/scripts/packages_test.txt \
	  cmake/scripts/packages_site.txt
	@cmake/scripts/install_packages.sh cmake/scripts/packages_browser.txt || echo "no browser, or no npm"
	@cmake/scripts/install_packages.sh cmake/scripts/packages_mpi.txt || echo "no PETSc, so no majorant-mpi"

configure: setup
	@cmake --preset release -B $(BUILD) -G "$(GENERATOR)" -DMAJORANT_GPL=$(GPL) > /dev/null

command: configure
	@cmake --build $(BUILD) -j $(JOBS) --target majorant_command

build: test-setup configure
	cmake --build $(BUILD) -j $(JOBS)

asan: test-setup
	cmake --preset asan
	cmake --build --preset asan -j $(JOBS)
	ctest --preset asan -j $(JOBS) --no-tests=error

tsan:
	@cmake/scripts/install_packages.sh cmake/scripts/packages_python.txt cmake/scripts/packages_core.txt cmake/scripts/packages_test.txt \
	  cmake/scripts/packages_tsan.txt
	cmake --preset tsan
	cmake --build --preset tsan -j $(JOBS)
	ctest --preset tsan -j $(JOBS) --no-tests=error

bench: build
	build/release/bench/majorant_bench

wheel: configure
	@cmake/scripts/install_packages.sh cmake/scripts/packages_python.txt
	@cmake -B $(BUILD) -DPython_EXECUTABLE=$(PYTHON) > /dev/null
	@cmake --build $(BUILD) -j $(JOBS) --target majorant_python
	@wheel=$$(/usr/bin/python3 cmake/scripts/make_wheel.py $(BUILD) dist --python $(PYTHON)) && echo $$wheel && \
	  /usr/bin/python3 cmake/scripts/make_wheel.py --check $$wheel

blender-addon: wheel
	@/usr/bin/python3 cmake/scripts/make_blender_addon.py dist/majorant_blender.zip \
	  $$(ls dist/majorant-*.whl | grep $(if $(filter OFF,$(GPL)),,-v) '+permissive-')

site:
	@cmake/scripts/install_packages.sh cmake/scripts/packages_site.txt
	@/usr/bin/python3 cmake/scripts/make_site.py

clean:
	rm -rf build $(OUT)
