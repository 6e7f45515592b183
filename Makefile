# Holdfast: one word for every common job. `make help` lists them.
JOBS ?= $(shell nproc)
CORPUS ?=
RELEASE := build/release
NATIVE := build/native
LIBCXX := build/libcxx
N ?= 100000
SEED ?= 1
MINUTES ?= 5
PYTHON ?= /usr/bin/python3

.PHONY: help setup build demo test python wheel slurm python-corpus corpus paste-corpus random planes solvers partitioned scale scale-slurm scale-whole scale-interfaces scaling fuzz bench field repair fetch-content tables paper figures format viewer web-test web-bits pictures docs web tidy debug asan tsan libcxx install clean
.DEFAULT_GOAL := help

help:  ## this list
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' $(MAKEFILE_LIST) | expand -t 16

setup:  ## installs what is missing of the Debian packages that building and testing need
	@scripts/setup.sh build

$(RELEASE)/build.ninja: CMakePresets.json | setup
	@cmake --preset release

build: setup $(RELEASE)/build.ninja  ## the program, build/release/holdfast
	@cmake --build $(RELEASE) -j $(JOBS) --target holdfast_cli

demo: build  ## makes a mechanical part, meshes it and checks the mesh
	@python3 scripts/demo.py $(RELEASE)/holdfast build/demo

test: build python  ## every test, with a subset of the corpus where there is one
	@scripts/setup.sh test python-test browser
	@cmake --build $(RELEASE) -j $(JOBS)
	@HOLDFAST_CORPUS="$(CORPUS)" ctest --preset release -j $(JOBS)

python: setup $(RELEASE)/build.ninja  ## the Python package, in build/release/python (PYTHONPATH), with the program
	@scripts/setup.sh python
	@cmake --preset release -DHOLDFAST_BUILD_PYTHON=ON >/dev/null
	@cmake --build $(RELEASE) -j $(JOBS) --target holdfast_python_program

wheel:  ## a wheel and an sdist of a clean clone in build/dist, tried in a fresh environment
	@scripts/setup.sh build python python-test
	@python/tests/wheel.sh . $(PYTHON) build/dist

slurm: python  ## an array of four on a Slurm cluster of this machine alone (as root)
	@scripts/setup.sh slurm
	@python/tests/slurm.sh $(RELEASE)/holdfast

python-corpus: python  ## N=500 surfaces of CORPUS=dir through batch and through the module: the same bytes
	@PYTHONPATH=$(RELEASE)/python $(PYTHON) python/tests/corpus.py "$(or $(CORPUS),../shared/corpus)" --jobs $(JOBS) $(ARGS)

solvers: build  ## every format into Debian's solvers, and problems solved by them, to docs/solvers.md (ARGS="--only gmsh")
	@scripts/setup.sh solvers
	@$(PYTHON) tests/solvers/run.py $(RELEASE)/holdfast $(if $(ARGS),,--write docs/solvers.md) $(ARGS)

partitioned: build  ## DOLFINx, OpenFOAM, VTK and Gmsh on meshes in pieces, as two processes, to docs/scaling.md
	@scripts/setup.sh solvers
	@$(PYTHON) tests/solvers/partitioned.py $(RELEASE)/holdfast --write docs/scaling.md $(or $(ARGS),--no-msh)

SCALE = PYTHONPATH=$(RELEASE)/python /usr/bin/python3 scripts/scale.py $(RELEASE)/holdfast

scale: python  ## N=1e6 tetrahedra in parts through Dask, one worker killed, to docs/scaling.md; goes on where it stopped
	@scripts/setup.sh python-test
	@$(SCALE) build/scale-$(N) --elements $(N) --write docs/scaling.md $(ARGS)

scale-slurm: python  ## the same through an array on a Slurm cluster of this machine alone (as root)
	@scripts/setup.sh python-test slurm
	@python/tests/slurm_cluster.sh env $(SCALE) build/scale-slurm-$(N) --elements $(N) --slurm --write docs/scaling.md $(ARGS)

scale-whole: build  ## 10^6 and 10^7 tetrahedra in one process, beside Gmsh HXT and TetGen, to docs/scaling.md
	@scripts/setup.sh bench
	@$(PYTHON) bench/large.py $(RELEASE)/holdfast build/scale-whole --write docs/scaling.md $(ARGS)

scale-interfaces: build  ## the demo part whole and in 2, 8 and 64 parts, their elements, to docs/scaling.md
	@$(PYTHON) bench/interfaces.py $(RELEASE)/holdfast build/scale-interfaces --write docs/scaling.md $(ARGS)

scaling: build  ## what threads gain by stage, and what more cores would, to docs/scaling.md
	@$(PYTHON) bench/scaling.py $(RELEASE)/holdfast build/scaling --write docs/scaling.md $(ARGS)

corpus: build  ## meshes and verifies every surface of CORPUS=dir (options: ARGS="--only 'gen_*'")
	@python3 scripts/corpus.py --holdfast $(RELEASE)/holdfast --corpus "$(or $(CORPUS),../shared/corpus)" \
	  --jobs $(JOBS) $(ARGS)

paste-corpus: build  ## pastes, verifies and fills every assembly (*_nofuse) of the unpacked corpus (ARGS="--most BYTES --only 'gmsh_*'")
	@python3 scripts/corpus_paste.py --holdfast $(RELEASE)/holdfast $(ARGS)

random: setup $(RELEASE)/build.ninja  ## meshes N random complexes of SEED and checks every mesh; goes on where it stopped
	@cmake --build $(RELEASE) -j $(JOBS) --target random_complexes
	@python3 scripts/random_complexes.py --program $(RELEASE)/tests/random/random_complexes --count $(N) --seed $(SEED) \
	  --jobs $(JOBS) $(ARGS)

planes: setup $(RELEASE)/build.ninja  ## triangulates N random planes from SEED by every method and checks them; goes on where it stopped
	@cmake --build $(RELEASE) -j $(JOBS) --target random_planes
	@python3 scripts/random_planes.py --program $(RELEASE)/tests/random/random_planes --count $(N) --seed $(SEED) --jobs $(JOBS) $(ARGS)

fuzz:  ## every reader, mesh, untangle, check and plane on arbitrary bytes, each for MINUTES, under the sanitizers
	@scripts/setup.sh build fuzz
	@cmake --preset fuzz
	@cmake --build build/fuzz -j $(JOBS) --target fuzz_targets
	@scripts/fuzz.sh build/fuzz $$(( $(MINUTES) * 60 )) $(JOBS)

bench:  ## speed against TetGen, CGAL and Gmsh, to docs/benchmarks.md; goes on where it stopped (ARGS="--again mesh")
	@scripts/setup.sh build bench node
	@cmake --preset release -DHOLDFAST_BUILD_BENCH=ON
	@cmake --build $(RELEASE) -j $(JOBS) --target holdfast_cli cgal_delaunay cgal_plane plane_times tetgen_delaunay
	@$(if $(if $(findstring --part,$(ARGS)),$(findstring native,$(ARGS)),all),cmake --preset native && cmake --build $(NATIVE) -j $(JOBS) --target holdfast_cli,:)
	@python3 bench/run.py --build $(RELEASE) --native $(NATIVE) --corpus "$(or $(CORPUS),../shared/corpus)" $(ARGS)

field:  ## meshes to compute with, beside Gmsh, TetGen and Netgen, to docs/field.md
	@scripts/setup.sh build bench field
	@cmake --preset release -DHOLDFAST_BUILD_BENCH=ON
	@cmake --build $(RELEASE) -j $(JOBS) --target holdfast_cli mesh_shape
	@python3 bench/field.py --build $(RELEASE) --corpus "$(or $(CORPUS),../shared/corpus)" $(ARGS)

repair: build  ## broken surfaces repaired and verified, beside admesh and CGAL, to docs/repair.md; goes on where it stopped
	@scripts/setup.sh build bench
	@cmake --preset release -DHOLDFAST_BUILD_BENCH=ON
	@cmake --build $(RELEASE) -j $(JOBS) --target holdfast_cli cgal_autorefine
	@python3 bench/repair.py --holdfast $(RELEASE)/holdfast --rows $(RELEASE)/bench/repair.jsonl --out docs/repair.md \
	  --autorefine $(RELEASE)/cgal_autorefine --jobs $(JOBS) $(ARGS)

fetch-content: setup  ## a project that takes the library by CMake's FetchContent, compiled as a whole and run
	@cmake -G Ninja -S tests/consumer/fetch_content -B build/fetch_content -DCMAKE_BUILD_TYPE=Release -DHOLDFAST_SOURCE=$(CURDIR)
	@cmake --build build/fetch_content -j $(JOBS)
	@build/fetch_content/consumer

tables: build  ## the paper's tables beside TetGen, for the corpus and the paper's cases, to docs/results.md
	@scripts/setup.sh bench
	@python3 bench/tables.py --build $(RELEASE) --corpus "$(or $(CORPUS),../shared/corpus)" --jobs $(JOBS) $(ARGS)

paper: build  ## every figure, table and bound of the paper, measured, to docs/paper.md; goes on where it stopped (ARGS="--again pictures")
	@scripts/setup.sh paper
	@cmake --build $(RELEASE) -j $(JOBS) --target literal
	@$(PYTHON) bench/paper/run.py --build $(RELEASE) $(ARGS)

figures: build  ## the figures of the documents, from runs of the program, to docs/figures
	@python3 scripts/figures.py $(RELEASE)/holdfast

VIEWER_TOOLS := viewer/node_modules/.package-lock.json
$(VIEWER_TOOLS): viewer/package-lock.json
	@command -v npm >/dev/null || scripts/setup.sh node
	@npm ci --prefix viewer --no-audit --no-fund --ignore-scripts
	@touch $@

viewer: $(VIEWER_TOOLS)  ## viewer/dist: the page that the program fills, out of viewer/src
	@cd viewer && npx tsc --noEmit && node build.mjs

WEB := build/web

web: $(VIEWER_TOOLS)  ## build/web: the page that meshes in a browser, index.html, and the npm package (ten minutes)
	@scripts/setup.sh emscripten
	@JOBS=$(JOBS) web/build.sh $(WEB)

web-test: build $(VIEWER_TOOLS)  ## pages in headless Chromium: each control, no request, foreign names; with those of `make web`
	@scripts/setup.sh browser
	@tests=viewer/test/*.test.mjs; \
	if web/build.sh --stands $(WEB); then tests="$$tests web/test/*.test.mjs"; \
	else echo "web-test: $(WEB) is not built from these sources, so that the page that meshes is not tested: make web"; fi; \
	HOLDFAST=$(RELEASE)/holdfast WEB=$(WEB) node --test $$tests

web-bits: build  ## 200 surfaces of CORPUS=dir through the npm package: the native bytes; to docs/web.md (ARGS="--count 50")
	@HOLDFAST=$(RELEASE)/holdfast WEB=$(WEB) node web/test/bits.mjs "$(or $(CORPUS),../shared/corpus)" \
	  --write docs/web.md $(ARGS)

pictures: build $(VIEWER_TOOLS)  ## docs/pictures, from runs of the program seen by headless Chromium
	@scripts/setup.sh browser
	@node viewer/pictures.mjs $(RELEASE)/holdfast docs/pictures

docs: build  ## the documents as a site with search, meshes and the page of `make web`, build/site/index.html
	@scripts/setup.sh docs
	@python3 scripts/site.py $(RELEASE)/holdfast build

format:  ## clang-format on every source
	@scripts/setup.sh lint
	@git ls-files '*.cpp' '*.h' | xargs clang-format -i

tidy:  ## clang-tidy on every source (FILES="..." for some)
	@scripts/setup.sh build lint
	@cmake --preset tidy >/dev/null
	@echo $(or $(FILES),$$(git ls-files 'src/*.cpp')) | xargs -n 1 -P $(JOBS) clang-tidy -p build/tidy --quiet --extra-arg=-Wno-unknown-warning-option

debug: setup  ## the tests with assertions and a mesh validated after every operation
	@cmake --preset debug
	@cmake --build build/debug -j $(JOBS)
	@HOLDFAST_CORPUS=none ctest --preset debug -j $(JOBS)

asan: setup  ## the tests under the address and undefined behaviour sanitizers
	@cmake --preset asan
	@cmake --build build/asan -j $(JOBS)
	@HOLDFAST_CORPUS=none ctest --preset asan -j $(JOBS)

tsan: setup  ## what runs on several threads, under the thread sanitizer
	@cmake --preset tsan
	@cmake --build build/tsan -j $(JOBS) --target mesh_tests recover_tests refine_tests optimise_tests property_tests
	@HOLDFAST_CORPUS=none ctest --preset tsan -j $(JOBS) \
	  -R '^(Threads|Parallel|Delaunay|DelaunayThreads|SurfaceThreads|Parts|TasksInParts|ImproveInParts|InPlaceParts|SearchInParts|ForcedApex|FieldThreads(Stop|Monitor))\.|FieldThreads.*/sphere'

libcxx: build  ## build/libcxx/holdfast by clang++ and libc++, and a comparison of its meshes with those of the program
	@scripts/setup.sh libcxx
	@cmake --preset libcxx
	@cmake --build $(LIBCXX) -j $(JOBS) --target holdfast_cli
	@python3 tests/cli/same_bits.py $(RELEASE)/holdfast --other $(LIBCXX)/holdfast

install: build  ## library, headers and program to PREFIX (default /usr/local)
	@cmake --build $(RELEASE) -j $(JOBS) --target holdfast holdfast_cli
	@cmake --install $(RELEASE) --prefix $(or $(PREFIX),/usr/local)

clean:  ## removes build/
	@rm -rf build
