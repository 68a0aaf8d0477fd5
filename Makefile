# SPDX-License-Identifier: Apache-2.0
# Installs tools, builds, and calls `halfway`. All other functions are in the program.

.DEFAULT_GOAL := help
MAKEFLAGS += --no-builtin-rules --no-print-directory

# Each variable: the targets that use it, and its help text. A variable on the command line that no given target uses is
# an error: otherwise it would be ignored.
about_SCENE := sim,view,board-sim,core-sim,compare,why,plan,verilog,study a built-in scene, a TOML file or a mesh file (default: all built-in scenes)
about_SHADER := sim,view,core-sim,compare,why,plan,verilog quadratic, spherical or processors (default: quadratic)
about_DEGREE := sim,view,core-sim,why,plan,verilog degree of the quadratic shader: 2, or 1 for planes (Gouraud shading) (default: 2)
about_FORM := sim,view,core-sim,why,plan,verilog folded or unrolled shading processors (default: unrolled)
about_OBJECTS := sim,view,core-sim,why,plan,verilog number of object processors before the shading processors (default: the rasterizer; 16 for a scene with shadows)
about_SUBPIXELS := sim,view,core-sim,why,plan,verilog with OBJECTS: 1, or 4 or 16 subpixels of a pixel, which is then filtered (default: 1)
about_PRESET := sim,view,core-sim,why,plan,verilog,tables,check-tables exact or published (default: exact; make tables: both, or with a size one of them)
about_SIZE := sim,view,core-sim,why,plan,verilog,study WIDTHxHEIGHT in pixels (default: 640x480)
about_OWN_TABLES := sim 1: spherical shader with a table for each exponent of the scene: within one colour step
about_ALL_EFFECTS := sim,view,core-sim,compare,why,plan,verilog 1: hardware with every effect, whether or not the scene needs it
about_LIGHTS := sim,view,core-sim,why,plan,verilog with ALL_EFFECTS: the number of lights of the hardware
about_SIMULATOR := sim,view,board-sim,plan ghdl, verilator or lanes; make view: auto, verilator or lanes (default: ghdl and verilator; auto)
about_OUT := sim,view,board-sim,core-sim,compare,why,verilog,study the folder for results (default: build/out)
about_THREADS := sim,view,live,core-sim,plan,savings,study,gallery threads for setup and golden model; make view: for whole frames (default: all cores)
about_FRAMES := view steps of one turn of the camera (default: 36)
about_VIDEO := view a file for a video
about_RATE := view,plan frames per second: of the video; make plan: that the shading processors draw
about_TERMINAL := view 1: draw in the terminal
about_MULTIPLIER_BITS := verilog width of multipliers in the device; 0: products in lookup tables (default: 18)
about_FORMAT := core-sim,verilog with CORE=1, and for make core-sim: rgb565 or xrgb8888: pixels in memory, with 16 or 32 bits of depth (default: rgb565)
about_BUS := core-sim,verilog with CORE=1, and for make core-sim: 32 or 64: width of the bus to the memory (default: 64)
about_LATENCY := core-sim clocks from an address to its first word, and from a write to its response (default: 30)
about_AXI := verilog 1: make verilog: the top with AXI4-Stream ports
about_CORE := verilog 1: make verilog: halfway_core, from commands in memory to a picture in memory
about_PIXEL := why x,y of the pixel that make why explains
about_MEASURE := plan 1: count cells by Yosys, and cycles and seconds by simulation
about_OBJECTS_PER_PIXEL := plan objects per pixel that the shading processors draw
about_SPACE := study a TOML file of designs
about_FULL := study,mutate 1: make study: the whole space of designs; make mutate: all faults
about_TILE := study larger frames are drawn in tiles of WIDTHxHEIGHT (default: 1280x960)
about_ERROR := study query: the cheapest hardware with a largest error of at most this many steps of 1/255
about_PSNR := study query: the cheapest hardware with at least this PSNR in dB
about_TIME := study query: the best hardware that draws a frame in this time, such as 10ms
about_CLOCK := study MHz assumed for hardware whose clock is unknown
about_PLACE := study 1: place and route hardware for its clock, minutes for each design
about_EXECUTOR := study local or slurm (a job array) (default: local)
about_PARTS := study tasks of the job array (default: 64)
about_COSINE := tables,check-tables address bits x data bits of the cosine tables (default: 9x8; published 6x6)
about_TESTS := test,sanitize a regular expression: only the tests that match, of both tiers
about_ENTITY := testbench the entity whose testbench runs, such as triangle_walker
about_FILES := lint only C++ files with this text in their paths (default: all)
about_SECONDS := fuzz seconds for each fuzzer (default: 60)
about_TARGET := fuzz only this fuzzer
about_TRIANGLES := search number of random triangles (default: 10000000)
about_SEED := search seed of the random triangles (default: 1)
about_PROOF := prove only proofs with this text in their names, such as raster/edge_walker (default: all)
about_DESIGN := evidence,mutate,synth only designs with this text in their names; evidence: only PAGE=clocks (default: all)
about_SEEDS := synth number of placement seeds (default: 3)
about_DEVICE := live,plan,study,synth the FPGA whose clocks count: hx8k (iCE40, without multipliers) or ecp5 (default: ecp5; make synth: hx8k)
about_PAGE := evidence only this page: bounds, cells, accuracy, transcripts, figures, gallery, hard_cases, proofs, mutants; or speed, clocks (default: all but speed and clocks)
about_AGAIN := evidence 1: measure pages of this commit, too
about_JOBS := sim,view,live,board-sim,core-sim,compare,why,plan,verilog,savings,study,figures,report,release,gallery,tables,check-tables,test,test-all,testbench,lint,sanitize,fuzz,mutate,prove,evidence,stability,search,bounds,synth,board,bench,build,program,studies,generator parallel compilations, tests and fuzzers (default: all cores)

variables := $(shell sed -n 's/^about_\([A-Z_]*\) := .*/\1/p' $(firstword $(MAKEFILE_LIST)))
# Each variable's option, such as ALL_EFFECTS=--all-effects.
flags := $(shell sed -n '/^about_/{s/^about_\([A-Z_]*\) := .*/\1=--\L\1/;:a;s/=\(.*\)_/=\1-/;ta;p}' $(firstword $(MAKEFILE_LIST)))
comma := ,
users_of = $(subst $(comma), ,$(firstword $(about_$(1))))
text_of = $(wordlist 2,$(words $(about_$(1))),$(about_$(1)))
goals := $(or $(MAKECMDGOALS),help)
used := $(foreach name,$(variables),$(if $(filter $(goals),$(call users_of,$(name))),$(name)))
given := $(filter-out -%,$(foreach name,$(.VARIABLES),$(if $(filter command,$(origin $(name))),$(name))))
unused := $(firstword $(filter-out $(used),$(given)))
ifneq ($(unused),)
$(error make $(goals) does not use $(unused): $(if $(call users_of,$(unused)),it belongs to \
  $(call users_of,$(unused)),no target uses it); make $(goals) uses: $(or $(strip $(used)),no variables))
endif

# Values are passed in the environment and quoted where they are used, so that neither make nor a shell executes them
# as code.
$(foreach name,$(variables),$(eval override $(name) := $$(value $(name))))
export $(variables)
# Of the back ends that are installed, Debian's ghdl starts mcode if it is not told otherwise. LLVM's programs are the fastest.
export GHDL_BACKEND ?= llvm

jobs := $${JOBS:-$$(nproc)}
option = $${$(1):+$(2)="$$$(1)"}
# Passes a flag if its variable is neither empty nor 0.
flag = $$(case "$${$(1)}" in ('' | 0) ;; (*) echo $(2) ;; esac)
# The options of a target's command: its variables are options of the same names, and flags if their texts begin with 1:.
options = $(foreach name,$(filter-out SCENE FULL JOBS,$(variables)),$(if $(filter $@,$(call users_of,$(name))),$(call \
  $(if $(filter 1:,$(word 2,$(about_$(name)))),flag,option),$(name),$(patsubst $(name)=%,%,$(filter $(name)=%,$(flags))))))
# Only one set-up, configuration or build at a time in this checkout: two runs of ninja would overwrite each other's
# files. The commands do not inherit the lock (-o): a background process would keep it after the end of make.
lock = mkdir -p build && { flock -n build/make.lock true || echo 'waiting for another make in this checkout' >&2; } \
  && flock -o build/make.lock
# The build with sanitizers, which make sanitize and make fuzz share.
sanitized = $(lock) sh -c 'cmake --log-level=NOTICE -S . -B build/sanitize -G Ninja -DHALFWAY_SANITIZE=ON \
  -DCMAKE_CXX_COMPILER=clang++ && cmake --build build/sanitize -j "$$@"' make "$(jobs)"
build_targets = { [ -z "$$targets" ] || { $(lock) cmake --build build -j "$(jobs)" --target $$targets; }; }
# Measures a page of evidence. With options, which variables give, its program only prints.
measure = set -- $(2); if [ $$\# -gt 0 ]; then targets=$$(scripts/evidence.sh programs "$(1)") && $(build_targets) && \
  scripts/evidence.sh run "$(1)" "$(jobs)" "$$@"; else $(lock) cmake --build build -j "$(jobs)" --target halfway_page && \
  targets=$$(scripts/evidence.sh targets "$(1)") && $(build_targets) && scripts/evidence.sh measure "$(1)" "$(jobs)"; fi
scene := $${SCENE:+-- "$$SCENE"}

.PHONY: help help-all $(sort $(foreach name,$(variables),$(call users_of,$(name)))) configure setup diagrams doctor format \
  check-format clean

# The targets of make help; make help-all lists all.
first_targets := sim view live why plan verilog study report test testbench evidence doctor clean
list = sed -n 's/^\([a-z0-9-]*\):.*\#\# \(.*\)/  make \1	\2/p' Makefile | expand -t 22

help: ## the most used targets
	@echo 'Halfway: shading hardware in VHDL, checked bit for bit against C++'
	@echo
	@$(list) | grep -E '^  make ($(subst $(subst ,, ),|,$(first_targets))) '
	@echo
	@echo 'make help-all lists all targets, and the variables, e.g. make sim SCENE=path/to/mesh.obj SIZE=800x600'

help-all: ## all targets and variables
	@$(list)
	@echo
	@echo 'Variables, and the targets that use each'
	@printf '  %s\t%s   [%s]\n' $(foreach name,$(variables),'$(name)' '$(call text_of,$(name))' \
	  '$(if $(filter JOBS,$(name)),every target that builds,$(call users_of,$(name)))') | expand -t 16

sim: program ## draw scenes by golden model, GHDL and Verilator, compare, write frames
	@build/halfway sim $(options) $(scene)

view: program ## draw one scene from all sides, by the RTL in Verilator or lanes (SCENE; VIDEO=turn.mp4, TERMINAL=1)
	@build/halfway view $(options) $(scene)

live: program ## write a page in which the RTL draws, live in a browser: build/live/index.html
	@build/halfway live $(options)

board-sim: program ## draw two frames on the simulated board, from the pins to the picture on a monitor (SCENE)
	@build/halfway board-sim $(options) $(scene)

core-sim: program ## draw scenes by the whole core in Verilator: registers, driver, picture in a simulated memory (SCENE)
	@build/halfway core-sim $(options) $(scene)

compare: program ## compare the stored results of make sim again
	@build/halfway compare $(options) $(scene)

why: program ## show one pixel stage by stage, in golden model and RTL (SCENE, PIXEL)
	@build/halfway why $(options) $(scene)

plan: program ## list the hardware that a scene needs, with reasons (SCENE; MEASURE=1: cells and time)
	@build/halfway plan $(options) $(scene)

verilog: program ## write the hardware of a scene as Verilog in build/verilog/KEY (SCENE; AXI=1: with AXI4-Stream ports; CORE=1: the whole core)
	@build/halfway verilog $(options) $(scene)

savings: program ## measure the tables of docs/effects.md again (minutes)
	@build/halfway savings $(options)

study: studies ## measure accuracy and time over the design space (FULL=1; SCENE; queries: ERROR, PSNR, TIME; EXECUTOR=slurm)
	@case "$${SPACE:+$${FULL#0}}" in ('') ;; (*) echo 'study: FULL is a space, too; give it or SPACE' >&2; exit 2 ;; esac
	@build/halfway study $(call flag,FULL,--space sim/study/spaces/full.toml) $(options) $(scene)

figures: configure ## make evidence PAGE=figures: draw and measure the papers' figures and tables again
	@$(call measure,figures)

# Missing parts of the page are made first. The shading processors are drawn only by Verilator: GHDL needs minutes.
report: program ## write one HTML page: frames, accuracy against time, effects, figures, waveforms, tables
	@for shader in quadratic spherical processors; do for scene in sim/scenes/*.toml; do name=$$(basename "$$scene" .toml); \
	  [ -f "build/out/$$name/$$shader/summary.json" ] || build/halfway sim --shader $$shader \
	    $$([ $$shader != processors ] || echo --simulator verilator) -- "$$name" || [ $$? = 1 ] || exit 3; done; done
	@[ -f build/study/study.csv ] || $(MAKE) study
	@[ -f build/figures/figures.json ] || [ -f docs/results/figures/figures.json ] || $(MAKE) figures
	@build/halfway report

diagrams: configure ## draw the shaders' block diagrams in rtl/diagrams, and docs/folders.svg
	@scripts/diagrams.sh build/diagrams

gallery: configure ## make evidence PAGE=gallery: draw the pictures and plots of the pages again (THREADS)
	@export threads="$$THREADS"; $(call measure,gallery)

tables: generator ## write the generated ROMs and formats
	@build/halfway_generator tables $(options)

check-tables: generator ## fail if make tables would change anything
	@build/halfway_generator tables --check $(options)

test: build ## test each feature, entity and shader, if not tested on these files before (TESTS: only some, of all tests)
	@unset MAKEFLAGS; flock -o build/test.lock scripts/test.sh quick "$(jobs)" "$$TESTS"

test-all: build ## run every test that has not passed on these files: continues an interrupted run
	@unset MAKEFLAGS; flock -o build/test.lock scripts/test.sh all "$(jobs)"

testbench: configure ## run one VHDL testbench in GHDL, with vectors from the golden model (ENTITY)
	@[ -n "$$ENTITY" ] || { echo 'testbench: give ENTITY=name, such as make testbench ENTITY=triangle_walker' >&2; exit 2; }
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_row_testbenches halfway_vectors
	@ctest --test-dir build --output-on-failure --no-tests=error -R "^(tb|board)\.$$ENTITY\$$"

# Warnings of clang-tidy and of GHDL are errors.
lint: configure ## run clang-tidy on the C++ (FILES: only some) and check GHDL's warnings on the VHDL
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_row_testbenches rtl_lint_test
	@$(lock) cmake --log-level=NOTICE --preset lint
	@scripts/lint.sh build/lint "$(jobs)" "$$FILES"
	@ctest --test-dir build --output-on-failure --no-tests=error -R '^tb\.analysis$$|^rtl_lint_test$$'

sanitize: setup ## run every test with AddressSanitizer and UndefinedBehaviorSanitizer, in build/sanitize
	@$(sanitized)
	@unset MAKEFLAGS; LSAN_OPTIONS="suppressions=$$(pwd -P)/tb/inputs/random/leaks.txt:print_suppressions=0" flock -o build/test.lock \
	  ctest --test-dir build/sanitize --output-on-failure --no-tests=error -j "$(jobs)" \
	  $${TESTS:+--build-config cases --tests-regex "$$TESTS"}

fuzz: setup ## run libFuzzer on every kind of input (SECONDS each; TARGET: only one)
	@$(sanitized) --target halfway_fuzz_targets
	@scripts/fuzz.sh "$${SECONDS:-60}" "$(jobs)" $${TARGET:+"$$TARGET"}

mutate: configure ## make evidence PAGE=mutants; FULL=1 or DESIGN: print what finds all faults of all or some netlists
	@$(call measure,mutants,$(call flag,FULL,--step 1) $${DESIGN:+"$$DESIGN"})

prove: configure ## make evidence PAGE=proofs; PROOF: only print some proofs and the faults that they refute
	@$(call measure,proofs,$${PROOF:+"$$PROOF"})

evidence: configure ## measure the pages of evidence that are not of this commit, 45 minutes for all; may be interrupted (PAGE: one)
	@export again="$$AGAIN" design="$$DESIGN"; $(call measure,$${PAGE:-all})

stability: configure ## make evidence PAGE=hard_cases: hard cases in specification, golden model and RTL
	@$(call measure,hard_cases)

search: configure ## test random triangles and scenes in the golden model, some of them in the RTL (TRIANGLES, SEED)
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_search
	@build/tb/halfway_search $(call option,TRIANGLES,--triangles) $(call option,SEED,--seed) \
	  --page=docs/results/hard_cases.md .

bounds: configure ## make evidence PAGE=bounds: error bounds of formats and tables
	@$(call measure,bounds)

synth: configure ## compare cells on two FPGAs and the clock on one with the thresholds (DESIGN, SEEDS; DEVICE=ecp5)
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_synth synth_frames
	@[ "$${DEVICE:-hx8k}" != hx8k ] || { build/tb/halfway_synth cells --jobs "$(jobs)" $${DESIGN:+"$$DESIGN"} && build/tb/synth_frames; }
	@build/tb/halfway_synth clocks --jobs "$(jobs)" $(call option,DEVICE,--device) $(call option,SEEDS,--seeds) $${DESIGN:+"$$DESIGN"}

board: configure ## make the bitstream of the board and compare its figures with the thresholds
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_synth
	@build/tb/halfway_synth board

bench: configure ## make evidence PAGE=speed: ways to the same picture, whole frames, frames in a browser, small triangles
	@$(call measure,speed)

build: program ## build program and tests
	@$(lock) cmake --build build -j "$(jobs)"

program: configure
	@$(lock) cmake --build build -j "$(jobs)" --target halfway

studies: configure
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_studies

generator: configure
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_generator

# Configures again if set-up has changed the machine, and from scratch if the checkout was moved.
configure: setup
	@$(lock) sh -c 'here=$$(pwd -P); key=$$(cat build/setup*.stamp); fresh=; cd "$$here"; \
	if ! grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$$here" build/CMakeCache.txt; then fresh=--fresh; \
	elif [ -f build/configure.stamp ] && [ "$$(cat build/configure.stamp)" = "$$key" ]; then exit 0; fi; \
	cmake --log-level=NOTICE $$fresh -S . -B build -G Ninja && printf "%s\n" "$$key" >build/configure.stamp'

# Installs missing packages of scripts/packages.txt: the groups build and sim for every target, others if needed.
with_tools := bench board bounds diagrams evidence figures format check-format fuzz gallery lint live mutate prove release report sanitize \
  savings study synth test test-all
setup:
	@$(lock) scripts/setup.sh $(if $(filter $(with_tools),$(MAKECMDGOALS)),tools) \
	  $(if $(filter test test-all sanitize,$(MAKECMDGOALS)),test) \
	  $(if $(filter plan,$(MAKECMDGOALS)),$(call flag,MEASURE,tools)) \
	  $(if $(filter view,$(MAKECMDGOALS)),$(call flag,VIDEO,tools))

release: program ## write sources, Verilog and page of this version in build/release, and tag the commit
	@scripts/release.sh

doctor: ## list tools and libraries, and the command that installs the missing ones
	@sh scripts/setup.sh --doctor

format: setup ## format C++ and VHDL
	@scripts/format.sh

check-format: setup ## fail if make format would change anything
	@scripts/format.sh --check

clean: ## remove everything that was built
	rm -rf build
