# make demo   install what is missing, build, flatten the bundled creature, say where the files are
# make test   install what is missing, build, run every test
# make build | asan | tsan | bench | clean
JOBS ?= $(shell nproc)
BINARY = build/release/apps/majorant
OUT = out

.PHONY: demo test build setup configure command asan tsan bench clean

demo: command
	@mkdir -p $(OUT)
	@$(BINARY) parametrize meshes/creature.obj --degree 3 -o $(OUT)/creature.vtu \
	  -o $(OUT)/creature.obj -o $(OUT)/creature.svg --report $(OUT)/creature.json
	@echo "the map, for ParaView:        $(OUT)/creature.vtu"
	@echo "textured mesh, for Blender:   $(OUT)/creature.obj"
	@echo "the layout, for any browser:  $(OUT)/creature.svg"
	@echo "report:                       $(OUT)/creature.json"

test: build
	ctest --preset release -j $(JOBS)

setup:
	@scripts/install_packages.sh

configure: setup
	@cmake --preset release > /dev/null

command: configure
	@cmake --build --preset release -j $(JOBS) --target majorant_command

build: configure
	cmake --build --preset release -j $(JOBS)

asan: setup
	cmake --preset asan
	cmake --build --preset asan -j $(JOBS)
	ctest --preset asan -j $(JOBS)

tsan:
	@scripts/install_packages.sh scripts/packages_tsan.txt
	cmake --preset tsan
	cmake --build --preset tsan -j $(JOBS)
	ctest --preset tsan -j $(JOBS)

bench: build
	build/release/bench/majorant_bench

clean:
	rm -rf build $(OUT)
