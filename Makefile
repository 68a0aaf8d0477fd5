# SPDX-License-Identifier: Apache-2.0
# Sets the machine up, builds, and calls `halfway`; the program itself holds everything else.

.DEFAULT_GOAL := help
MAKEFLAGS += --no-builtin-rules --no-print-directory

# What a target hands to the program. Values travel through the environment and are quoted where they are
# used: neither make nor a shell ever reads them as code.
variables := SCENE SHADER PRESET SIZE SIMULATOR OUT PIXEL THREADS ADDRESS_BITS DATA_BITS TESTS JOBS \
  ALL_EFFECTS LIGHTS FORM FAST MEASURE OBJECTS RATE TRIANGLES SEED SECONDS TARGET FRAMES VIDEO TERMINAL \
  SPACE FULL ERROR PSNR TIME CLOCK EXECUTOR PARTS TILE DESIGN SEEDS PIN
$(foreach name,$(variables),$(eval override $(name) := $$(value $(name))))
export $(variables)

jobs := $${JOBS:-$$(nproc)}
option = $${$(1):+$(2)="$$$(1)"}
# A flag is given where its variable is neither empty nor 0.
flag = $$(case "$${$(1)}" in ('' | 0) ;; (*) echo $(2) ;; esac)
# One set-up, configuration or build at a time in this checkout: ninja would write into the other's files.
# What is started does not inherit the lock: it would outlive this make in whatever that leaves running.
lock = mkdir -p build && { flock -n build/make.lock true || echo 'waiting for another make in this checkout' >&2; } \
  && flock -o build/make.lock
# What is built with sanitizers: make sanitize and make fuzz share it.
sanitized = $(lock) sh -c 'cmake --log-level=NOTICE -S . -B build/sanitize -G Ninja -DHALFWAY_SANITIZE=ON \
  -DCMAKE_CXX_COMPILER=clang++ && cmake --build build/sanitize -j "$$@"' make "$(jobs)"
scene := $${SCENE:+-- "$$SCENE"}
run_options := $(call option,SHADER,--shader) $(call option,PRESET,--preset) $(call option,SIZE,--size) \
  $(call option,FORM,--form) $(call flag,ALL_EFFECTS,--all-effects) $(call option,LIGHTS,--lights) \
  $(call flag,FAST,--fast)
sim_options := $(run_options) $(call option,SIMULATOR,--simulator) $(call option,THREADS,--threads) \
  $(call option,OUT,--out)
table_options := $(call option,PRESET,--preset) $(call option,ADDRESS_BITS,--address-bits) \
  $(call option,DATA_BITS,--data-bits)
synth_options := --jobs "$(jobs)" $(call option,SEEDS,--seeds) $(call flag,PIN,--pin --readme README.md) \
  --page tb/synth/README.md . build/cache $${DESIGN:+"$$DESIGN"}

.PHONY: help sim view compare why plan savings study slurm-test figures report check-report diagrams gallery tables \
  check-tables test sanitize fuzz kills mutate prove stability search bounds synth bench build program generator mcode configure \
  setup doctor format check-format clean

help: ## this list
	@echo 'Halfway: shading hardware in VHDL, checked bit for bit against C++'
	@echo
	@sed -n 's/^\([a-z0-9-]*\):.*## \(.*\)/  make \1	\2/p' Makefile | expand -t 22
	@echo
	@echo 'Variables, e.g. make sim SCENE=../shared/meshes/cow.obj SIZE=800x600'
	@echo '  SCENE      a built-in scene, a TOML file or a mesh file   (default: all built-in scenes)'
	@echo '  SHADER     quadratic, spherical or processors             (default: quadratic)'
	@echo '  FORM       folded or unrolled shading processors          (default: unrolled)'
	@echo '  PRESET     exact or published                             (default: exact)'
	@echo '  SIZE       WIDTHxHEIGHT in pixels                         (default: 640x480)'
	@echo '  SIMULATOR  ghdl, verilator or lanes; make view: auto, verilator or lanes (default: both; auto)'
	@echo '  OUT        the folder for results                         (default: build/out)'
	@echo '  THREADS    threads for setup and golden model; make view: for whole frames   (default: all cores)'
	@echo '  ALL_EFFECTS  1: hardware with every effect, whatever the scene calls for; LIGHTS  for how many lights'
	@echo '  FAST       1: the quadratic shader built for the clock: the same fragments'
	@echo '  FRAMES     make view: steps of one turn of the camera         (default: 36)'
	@echo '  VIDEO, RATE  make view: a file for a video, and its frames a second; TERMINAL  1: draw in the terminal'
	@echo '  MEASURE    1: make plan counts cells by Yosys, and cycles and seconds by simulation'
	@echo '  OBJECTS, RATE  make plan: how many shading processors draw so many objects a pixel, frames a second'
	@echo '  ERROR, PSNR, TIME  make study: the cheapest hardware within so many steps of 1/255, of so many dB, in 10ms'
	@echo '  CLOCK      make study: MHz that hardware is taken to run at whose clock is not known'
	@echo '  PLACE      1: make study places and routes hardware for its clock, minutes for each design'
	@echo '  FULL, SPACE  make study: 1: the whole space; or a TOML file of designs'
	@echo '  EXECUTOR, PARTS  make study: slurm: as a job array of so many tasks   (default: local; 64)'
	@echo '  TILE       make study: larger frames are drawn in tiles of WIDTHxHEIGHT   (default: 1280x960)'
	@echo '  TRIANGLES, SEED  make search: how many, and which ones     (default: 10000000, 1)'
	@echo '  PIXEL      x,y of the pixel that make why explains'
	@echo '  ADDRESS_BITS, DATA_BITS   make tables: size of cosine tables  (default: 9, 8; published 6, 6)'
	@echo '  TESTS      a regular expression: make test runs only the tests that match'
	@echo '  JOBS       parallel compilations, tests and fuzzers       (default: all cores)'
	@echo '  SECONDS, TARGET   make fuzz: for how long each (default: 60), and one target alone'
	@echo '  DESIGN, SEEDS  make synth: only designs with this in their names; seeds of placement  (default: all, 3)'
	@echo '  PIN        1: make synth pins the figures in place of comparing; make study PLACE=1 the clocks'

sim: program ## scenes through golden model, GHDL and Verilator: compare, write frames
	@build/halfway sim $(sim_options) $(scene)

view: program ## one scene from all sides, by the RTL in Verilator or lanes (SCENE; VIDEO=turn.mp4, TERMINAL=1)
	@build/halfway view $(run_options) $(call option,SIMULATOR,--simulator) $(call option,THREADS,--threads) $(call option,OUT,--out) \
	  $(call option,FRAMES,--frames) $(call option,VIDEO,--video) $(call option,RATE,--rate) \
	  $(call flag,TERMINAL,--terminal) $(scene)

compare: program ## the frames that make sim left, once more
	@build/halfway compare $(call option,SHADER,--shader) $(call flag,ALL_EFFECTS,--all-effects) \
	  $(call flag,FAST,--fast) $(call option,OUT,--out) $(scene)

why: program ## one pixel stage by stage, golden beside RTL (SCENE, PIXEL)
	@build/halfway why $(run_options) $(call option,PIXEL,--pixel) $(call option,OUT,--out) $(scene)

plan: program ## the hardware that a scene calls for, and why (SCENE; MEASURE=1: cells and time)
	@build/halfway plan $(run_options) $(call flag,MEASURE,--measure) $(call option,SIMULATOR,--simulator) \
	  $(call option,OBJECTS,--objects) $(call option,RATE,--rate) $(call option,THREADS,--threads) $(scene)

savings: program ## what README tells of hardware left out, measured anew and written there: minutes
	@build/halfway savings $(call option,THREADS,--threads)

study: program ## accuracy against time over the design space (FULL=1; SCENE; ERROR, PSNR, TIME ask; EXECUTOR=slurm)
	@case "$${SPACE:+$${FULL#0}}" in ('') ;; (*) echo 'study: FULL is a space, too; give it or SPACE' >&2; exit 2 ;; esac
	@build/halfway study $${SPACE:+--space "$$SPACE"} $(call flag,FULL,--space sim/studies/full.toml) $(call option,SIZE,--size) $(call option,TILE,--tile) $(call option,ERROR,--error) \
	  $(call option,PSNR,--psnr) $(call option,TIME,--time) $(call option,CLOCK,--clock) $(call flag,PLACE,--place) $(call flag,PIN,--pin) \
	  $(call option,EXECUTOR,--executor) $(call option,PARTS,--parts) $(call option,THREADS,--threads) \
	  $(call option,OUT,--out) $(scene)

slurm-test: configure ## a study as a job array on a Slurm that the test starts on this machine, and ends
	@$(lock) cmake --build build -j "$(jobs)" --target halfway
	@tb/slurm/slurm.sh build/halfway . build/tb/slurm

figures: program ## what the papers print, drawn and measured anew: published beside measured, in sim/figures
	@build/halfway figures --out build/figures --page sim/figures

# What the page is made of is made first where it is missing; GHDL draws by shading processors for minutes.
report: program ## one HTML page: frames, accuracy against time, effects, figures, waveforms, tables
	@for shader in quadratic spherical processors; do for scene in sim/scenes/*.toml; do name=$$(basename "$$scene" .toml); \
	  [ -f "build/out/$$name/$$shader/summary.json" ] || build/halfway sim --shader $$shader \
	    $$([ $$shader != processors ] || echo --simulator verilator) -- "$$name" || [ $$? = 1 ] || exit 3; done; done
	@[ -f build/study/study.csv ] || $(MAKE) study
	@[ -f build/figures/figures.json ] || [ -f sim/figures/figures.json ] || $(MAKE) figures
	@build/halfway report

check-report: build ## the page of make report in headless Chromium, by mouse and by keys
	@ctest --test-dir build --output-on-failure --no-tests=error -R '^ReportPage'

diagrams: setup ## the shaders' block diagrams in rtl/diagrams, drawn from their text
	@scripts/diagrams.sh build/diagrams

gallery: program ## the pictures in sim/gallery, drawn anew by the RTL; README.md's front, measured anew
	@scripts/gallery.sh build/gallery
	@build/halfway study --out build/gallery/study $(call option,THREADS,--threads)
	@build/halfway report --study build/gallery/study --front sim/gallery --readme README.md

tables: generator ## write ROMs and formats anew
	@build/halfway_generator tables $(table_options)

check-tables: generator ## fail if make tables would change anything
	@build/halfway_generator tables --check $(table_options)

test: build mcode ## every test
	@flock -o build/test.lock ctest --test-dir build --output-on-failure --no-tests=error -j "$(jobs)" $${TESTS:+--tests-regex "$$TESTS"}

sanitize: setup ## every test with AddressSanitizer and UndefinedBehaviorSanitizer, in build/sanitize
	@$(sanitized)
	@LSAN_OPTIONS="suppressions=$$(pwd -P)/tb/fuzz/leaks.txt:print_suppressions=0" flock -o build/test.lock \
	  ctest --test-dir build/sanitize --output-on-failure --no-tests=error -j "$(jobs)" \
	  $${TESTS:+--tests-regex "$$TESTS"}

fuzz: setup ## libFuzzer on every kind of input (SECONDS each; TARGET: one alone)
	@$(sanitized) --target halfway_fuzz_targets
	@scripts/fuzz.sh "$${SECONDS:-60}" "$(jobs)" $${TARGET:+"$$TARGET"}

kills: build ## the long form of the tests with kill -9: 60 moments in place of a few
	@tb/robustness/kill.sh build/halfway build/halfway_generator . build/tb/kills 60

mutate: configure ## small faults in the RTL, which the tests must find, and what those tests reach
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_mutants halfway_vectors
	@build/tb/halfway_vectors all build/tb/vectors
	@build/tb/halfway_mutants --jobs "$(jobs)" --page tb/mutants/README.md . build/tb/vectors build/tb/mutants

prove: configure ## formal proofs on the RTL, each with faults that it must refute
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_proofs
	@build/tb/halfway_proofs --page tb/proofs/README.md . build/proofs

families := edges quadratic spherical processors shadows illumination arithmetic conversions
stability: configure ## hard cases, in specification, golden model and RTL: what breaks, and what holds
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_stability halfway_page
	@rm -rf build/stability
	@printf '%s\n' $(families) | xargs -P "$(jobs)" -I{} build/tb/halfway_stability --gtest_brief=1 \
	  '--gtest_filter={}/HardCases.Full/*' --gtest_output=xml:build/stability/{}.xml
	@build/tb/halfway_page tb/stability/README.md $(families:%=build/stability/%.xml)

search: configure ## random triangles in golden model and RTL; what fails is shrunk and kept (TRIANGLES, SEED)
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_search
	@build/tb/halfway_search $(call option,TRIANGLES,--triangles) $(call option,SEED,--seed) \
	  --page=tb/stability/README.md --keep=tb/stability/regressions .

bounds: configure ## every bound of formats and tables: derived, proved, and how near the worst found comes
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_bounds
	@build/tb/halfway_bounds --page tb/bounds/README.md build/bounds

synth: configure ## cells on two FPGAs, and the clock on one, against what is pinned (DESIGN, SEEDS, PIN=1)
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_synth synth_frames
	@build/tb/halfway_synth --check $(synth_options)
	@build/tb/synth_frames
	@build/tb/halfway_synth $(synth_options)

bench: configure mcode ## speed: other ways to the same picture, growth, small triangles, cores; writes its page
	@$(lock) cmake --build build -j "$(jobs)" --target halfway halfway_bench
	@build/halfway_bench --jobs "$(jobs)" --page model/bench/README.md --readme README.md

# GHDL's other back end, beside the installed one.
mcode: setup
	@scripts/unpack.sh build/tools/ghdl-mcode ghdl-mcode ghdl-common || echo 'without it: its way is skipped' >&2

build: program ## program and tests
	@$(lock) cmake --build build -j "$(jobs)"

program: configure
	@$(lock) cmake --build build -j "$(jobs)" --target halfway

generator: configure
	@$(lock) cmake --build build -j "$(jobs)" --target halfway_generator

# Again when set-up found a change on the machine; from scratch when the checkout has moved.
configure: setup
	@$(lock) sh -c 'here=$$(pwd -P); key=$$(cat build/setup*.stamp); fresh=; cd "$$here"; \
	if ! grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$$here" build/CMakeCache.txt; then fresh=--fresh; \
	elif [ -f build/configure.stamp ] && [ "$$(cat build/configure.stamp)" = "$$key" ]; then exit 0; fi; \
	cmake --log-level=NOTICE $$fresh -S . -B build -G Ninja && printf "%s\n" "$$key" >build/configure.stamp'

# Installs what scripts/packages.txt lists and the machine lacks: for every target the groups build and sim.
with_tools := bench bounds check-report diagrams figures format check-format fuzz gallery mutate prove report sanitize \
  savings slurm-test study synth test
setup:
	@$(lock) scripts/setup.sh $(if $(filter $(with_tools),$(MAKECMDGOALS)),tools) \
	  $(if $(filter test check-report sanitize slurm-test,$(MAKECMDGOALS)),test) \
	  $(if $(filter plan,$(MAKECMDGOALS)),$(call flag,MEASURE,tools)) \
	  $(if $(filter view,$(MAKECMDGOALS)),$(call flag,VIDEO,tools))

doctor: ## tools and libraries found, and the command that mends what is missing
	@sh scripts/setup.sh --doctor

format: setup ## format C++ and VHDL
	@scripts/format.sh

check-format: setup ## fail if make format would change anything
	@scripts/format.sh --check

clean: ## remove everything that was built
	rm -rf build
