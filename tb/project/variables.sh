#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Tests that the Makefile refuses unused variables, and that its table of variables agrees with its recipes and with the
# options of the program.
#
#   variables.sh MAKEFILE WORK_FOLDER PROGRAM
set -u
makefile=$(realpath "$1")
work=$2
program=$3
unset MAKEFLAGS MFLAGS MAKELEVEL
export LC_ALL=C
rm -rf "$work"
mkdir -p "$work"
cd "$work" || exit 1
failures=0
fail() {
  echo "variables: $*" >&2
  failures=$((failures + 1))
}

# The table as reported by the Makefile: the targets, the variables of one target, all variables.
targets() { sed -n 's/^\([a-z0-9-]*\):[^=].*/\1/p; s/^\([a-z0-9-]*\):$/\1/p' "$1" | sort -u; }
taken() { make -f "$1" -n "$2" NO_SUCH_VARIABLE=1 2>&1 | sed -n 's/.* uses: \(.*\)\.  Stop\.$/\1/p' | sed 's/^no variables$//' | xargs -n 1 | sort -u; }
known() { sed -n 's/^about_\([A-Z_]*\) := .*/\1/p' "$1" | sort -u; }
# The variables in the recipes of a target and of all targets that it depends on.
used() { make -f "$1" -n "$2" 2>/dev/null | grep -oE '\$\{?[A-Z_]+' | tr -d '${' | sort -u | comm -12 - <(known "$1"); }

# True if a target's recipes use exactly the variables in the table.
agrees() { [ "$(used "$1" "$2")" = "$(taken "$1" "$2")" ]; }

# Without these files, make report would call make again.
mkdir -p build/study build/figures
touch build/study/study.csv build/figures/figures.json
cp "$makefile" Makefile
[ "$(targets Makefile | wc -l)" -gt 25 ] || fail "few targets are found: $(targets Makefile)"
for target in $(targets Makefile); do
  agrees Makefile "$target" ||
    fail "make $target: its recipe uses $(used Makefile "$target" | xargs), its table says $(taken Makefile "$target" | xargs)"
done

for target in sim view live board-sim core-sim compare why plan verilog savings study; do
  help=$("$program" "$target" --help)
  options=$(make -n "$target" | grep '^build/halfway ' | grep -oE -- '--[a-z_-]+' | sort -u)
  [ -n "$options" ] || fail "make $target gives halfway no option"
  for option in $options; do
    [[ $help == *" $option "* ]] || fail "halfway $target has no $option"
  done
done

# The check above must detect a variable that is missing in the table, and one too many.
sed 's/^about_TRIANGLES := search /about_TRIANGLES := plan /' Makefile >lacking.mk
sed 's/^about_PIXEL := why /about_PIXEL := why,search /' Makefile >surplus.mk
! agrees lacking.mk search || fail "a variable that the table lacks is not found"
! agrees surplus.mk search || fail "a variable too many in the table is not found"

# Expected refusal: exit code 2, a complete message, and no other action.
refused() { # arguments of make, words of the message
  local arguments=$1 output word
  shift
  output=$(eval "make $arguments" 2>&1)
  [ $? = 2 ] || fail "make $arguments: the exit code is not 2"
  for word in "$@"; do
    [[ $output == *"$word"* ]] || fail "make $arguments: '$word' is missing in: $output"
  done
  [ ! -e build/make.lock ] || fail "make $arguments: the check comes after set-up"
}
refused 'sim COSINE=10x8' 'make sim does not use COSINE' 'belongs to tables check-tables' 'uses: SCENE SHADER'
refused 'sim SCNE=x' 'make sim does not use SCNE' 'no target uses it' 'uses: SCENE'
refused "sim 'SCENE=a b' 'SCNE=c SIZE=d e'" 'does not use SCNE'
refused 'SIZE=9x9' 'make help does not use SIZE' 'uses: no variables'
refused 'clean SIZE=9x9' 'make clean does not use SIZE'
refused 'sim compare TILE=9x9' 'make sim compare does not use TILE'

accepted() {
  eval "$1" >accepted.log 2>&1 || fail "$1: $(cat accepted.log)"
}
accepted 'make -n sim "SCENE=a b=c \$(touch touched)" SIZE=9x9 OUT='
[ ! -e touched ] || fail 'make runs the text of a variable'
accepted 'make -n tables COSINE=10x9'
accepted 'make -n sim compare SIZE=9x9'
# Variables in the environment are not refused.
accepted 'COSINE=10x8 make -n sim'

# make help lists a dozen targets, make help-all each target with a text and each variable. The table names targets.
[ "$(make help | grep -c '^  make ')" = 13 ] || fail "make help lists not 13 targets: $(make help)"
make help-all >help.log || fail 'make help-all fails'
for name in $(known Makefile); do
  grep -q "^  $name  *[^ ]" help.log || fail "make help-all does not explain $name"
done
for name in $(sed -n 's/^about_[A-Z_]* := \([a-z,-]*\) .*/\1/p' Makefile | tr , '\n' | sort -u); do
  targets Makefile | grep -qx -- "$name" || fail "the table of variables names $name, which is no target"
done
[ $failures = 0 ] && echo 'variables: passed'
