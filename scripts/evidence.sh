#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Measures pages of evidence. A page that names the commit is not measured again, unless $again is 1. Of the clocks, only
# designs with $design in their names are placed again.
#
#   scripts/evidence.sh programs PAGE               prints the programs that the page needs
#   scripts/evidence.sh targets PAGE                the same for the pages to be measured; refuses files with changes
#   scripts/evidence.sh measure PAGE JOBS           measures and writes pages
#   scripts/evidence.sh run PAGE JOBS [OPTION...]   one page; with options of its program, results are only printed
#
# PAGE is a name of the list below, or `all` for those before `speed`. Exit codes: 0 done, 1 something does not hold or a
# threshold is broken, 2 bad usage or files with changes, 3 a tool is missing or failed.
set -eu
cd "$(dirname "$0")/.."
root=$PWD

# Name, minutes on two cores, Markdown file, programs.
pages='bounds 1 docs/results/bounds.md halfway_bounds
cells 4 docs/results/synthesis.md halfway_synth
accuracy 4 docs/accuracy.md halfway
transcripts 1 README.md halfway
figures 1 docs/results/figures/README.md halfway
gallery 4 docs/accuracy.md halfway_studies
hard_cases 7 docs/results/hard_cases.md halfway_stability
proofs 14 docs/results/proofs.md halfway_proofs
mutants 12 docs/results/mutants.md halfway_mutants halfway_vectors
speed 30 docs/results/speed.md halfway halfway_bench
clocks 300 docs/results/synthesis.md halfway_synth'
by_name='speed clocks'

names() { echo "$pages" | cut -d ' ' -f 1; }
line_of() { echo "$pages" | grep "^$1 "; }
minutes_of() { line_of "$1" | cut -d ' ' -f 2; }
file_of() { line_of "$1" | cut -d ' ' -f 3; }
programs_of() { line_of "$1" | cut -d ' ' -f 4-; }
bad_usage() { echo "evidence: $*" >&2; exit 2; }

journal_of() { echo "build/evidence/$commit/$1"; }
is_measured() {
  [ "${again:-0}" != 1 ] || return 1
  # Transcripts name no commit.
  if [ "$1" = transcripts ]; then [ -e "$(journal_of transcripts).done" ]; return; fi
  # With a journal, the program compares the rows with the thresholds again.
  [ ! -e "$(journal_of "$1").jsonl" ] &&
    grep -qF "PAGE=$1\` at commit \`$(echo "$commit" | cut -c 1-12)\`" "$(file_of "$1")"
}

# The pages to measure.
chosen() {
  for name in $(names); do
    case "$page: $by_name " in
      "all:"*" $name "*) ;;
      "all:"* | "$name:"*) is_measured "$name" || echo "$name" ;;
    esac
  done
}

# Commands of the pages. `end_page NAME TOOL...` names the origin in a page that a program without rows wrote.
end_page() {
  name=$1
  shift
  build/tb/halfway_page . "$name" "$(file_of "$name")" "$@"
}
# Study scenes, and write their tables into a part of the page of accuracy.
write_study() { # part, space, scenes
  part=$1 space=$2
  shift 2
  for scene; do
    shift
    out=build/accuracy/$(basename "$space" .toml)/$(basename "$scene" .toml)
    build/halfway study "$scene" --space "$space" --device hx8k --out "$out" ${threads:+--threads "$threads"}
    set -- "$@" "$out/study.csv"
  done
  build/tb/halfway_page . --table "$part" docs/accuracy.md "$@"
}
run() { # page, options
  name=$1
  shift
  if [ $# -gt 0 ]; then evidence=; else evidence=--evidence; fi
  case $name in
    bounds) build/tb/halfway_bounds --gtest_brief=1 $evidence ;;
    accuracy)
      mkdir -p build/accuracy
      # The study's sphere without its highlight, under one light.
      bright=
      for intensity in 1 10 100 1000; do
        bright="$bright build/accuracy/bright_$intensity.toml"
        sed "s/^k_s = .*/k_s = 0.0/; s/^intensity = .*/intensity = $intensity.0/" sim/study/spaces/sphere.toml \
          >"build/accuracy/bright_$intensity.toml"
      done
      printf '[[sweep]]\nmethod = "spherical"\n' >build/accuracy/bright.toml
      # shellcheck disable=SC2086 # scenes
      {
        write_study frames sim/study/spaces/accuracy.toml spheres
        write_study 'within one step' sim/study/spaces/one_step.toml sim/study/spaces/sphere.toml
        write_study 'cosine tables' sim/study/spaces/tables.toml sim/study/spaces/sphere.toml
        write_study 'bright lights' build/accuracy/bright.toml $bright
        write_study 'root tables' sim/study/spaces/roots.toml sim/study/spaces/sphere.toml sim/study/spaces/distant_eye.toml
      }
      end_page accuracy ghdl verilator yosys
      build/tb/halfway_page . --judge accuracy docs/accuracy.md 'largest error'
      ;;
    hard_cases)
      build/tb/halfway_stability --gtest_list_tests | sed -n 's,^\([a-z_]*\)/HardCases\.$,\1,p' | sort -u |
        xargs -P "$jobs" -I{} build/tb/halfway_stability --gtest_brief=1 --evidence --part={}/
      ;;
    cells) build/tb/halfway_synth cells ${evidence:+--page} --jobs "$jobs" "$@" ;;
    clocks)
      [ "${again:-0}" != 1 ] || set -- --again "$@"
      build/tb/halfway_synth clocks ${evidence:+--page ${design:+"$design"}} --jobs "$jobs" "$@"
      [ -z "$evidence" ] || build/tb/halfway_synth board --page
      ;;
    proofs) build/tb/halfway_proofs $evidence . build/proofs "$@" ;;
    mutants)
      build/tb/halfway_vectors all build/tb/vectors
      build/tb/halfway_mutants ${evidence:+--evidence --step 10} --jobs "$jobs" . build/tb/vectors build/tb/mutants "$@"
      ;;
    figures)
      build/halfway figures --out build/figures --page docs/results/figures
      end_page figures ghdl verilator
      ;;
    gallery)
      # GHDL draws the same picture by the shading processors, in a quarter of an hour.
      for drawing in 'spheres' 'teapot' 'shadows --shader processors'; do
        scene=${drawing%% *}
        # shellcheck disable=SC2086 # a scene and options
        build/halfway sim $drawing --simulator verilator --out build/gallery/"$scene"
        cp build/gallery/"$scene"/"$scene"/*/verilator.png docs/results/gallery/"$scene".png
      done
      build/halfway study --out build/gallery/study ${threads:+--threads "$threads"}
      build/halfway report --study build/gallery/study --front docs/results/gallery --page docs/accuracy.md
      build/halfway study --space sim/study/spaces/times.toml --out build/gallery/times ${threads:+--threads "$threads"}
      build/halfway study sim/study/spaces/red_sphere.toml --space sim/study/spaces/colour.toml --out build/gallery/colour \
        ${threads:+--threads "$threads"}
      { cat build/gallery/times/times.csv && sed 1d build/gallery/colour/times.csv; } >build/gallery/times.csv
      build/halfway report --study build/gallery --times docs/results/gallery --page docs/accuracy.md --readme README.md
      end_page gallery verilator
      ;;
    transcripts)
      tb/project/example/transcripts.sh "$root/build/halfway" "$root" "$root/build/tb/transcripts"
      ;;
    speed)
      build/halfway_bench --jobs "$jobs" --page docs/results/speed.md
      end_page speed ghdl verilator
      build/tb/halfway_page . --judge speed docs/results/speed.md 'relative to Mesa'
      ;;
  esac
}

command=${1-} page=${2-}
case " $(names | tr '\n' ' ')all " in
  *" $page "*) ;;
  *) bad_usage "there is no page $page; give one of: $(names | paste -sd ' ')" ;;
esac
shift 2
case $command in
  programs) programs_of "$page" ;;
  targets)
    commit=$(build/tb/halfway_page .) || exit
    for name in $(chosen); do programs_of "$name"; done
    ;;
  run)
    jobs=$1
    shift
    run "$page" "$@"
    ;;
  measure)
    commit=$(build/tb/halfway_page .) || exit
    left=$(chosen)
    count=$(echo "$left" | wc -w) number=0 end=0
    [ "$count" -gt 0 ] || echo 'evidence: every page is of this commit'
    for name in $left; do
      number=$((number + 1)) minutes=0
      for other in $(echo "$left" | sed -n "/^$name\$/,\$p"); do minutes=$((minutes + $(minutes_of "$other"))); done
      echo "== $name: page $number of $count; about $(minutes_of "$name") min, $minutes min with the pages that follow"
      [ "${again:-0}" != 1 ] || rm -f "$(journal_of "$name").jsonl"
      code=0
      scripts/evidence.sh run "$name" "$1" || code=$?
      if [ $code = 0 ]; then
        [ "$name" != transcripts ] || { mkdir -p "build/evidence/$commit" && touch "$(journal_of transcripts).done"; }
      else
        echo "evidence: $name ends with $code" >&2
        [ $code -le 3 ] || code=1 # of xargs
        [ $end -ne 0 ] || end=$code
      fi
    done
    exit $end
    ;;
  *) bad_usage 'give programs, targets, measure or run' ;;
esac
