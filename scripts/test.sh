#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs the tests in build/ that have not passed on this checkout's files, also in an interrupted run, and prints the ten
# slowest.
#
#   scripts/test.sh quick JOBS          without the tests that have the label `whole`
#   scripts/test.sh all JOBS            all
#   scripts/test.sh quick JOBS REGEX    every test whose name matches, each case of a C++ test by its own name
set -eu
tier=$1 jobs=$2 tests=${3-}
cd "$(dirname "$0")/.."

# The hash of all files and installed tools, with VHDL as this sed script leaves it.
hash_of_files() {
  find . -path ./build -prune -o -path ./.git -prune -o -type f -print0 | sort -z >build/passed/files
  {
    grep -zv '\.vhd$' build/passed/files | xargs -0 sha256sum -- build/setup*.stamp
    grep -z '\.vhd$' build/passed/files | xargs -0 sed -s -e 1F -e "$1"
  } | sha256sum
}
# ctest's output of all runs on the same files, in build/passed/NAME. Its first line is the hash.
keep_output() { # name hash
  [ "$(head -n 1 "build/passed/$1" 2>/dev/null)" = "$2" ] || echo "$2" >"build/passed/$1"
}
passed_in() { # name
  sed -n 's/^ *[0-9]*\/[0-9]* Test *#[0-9]*: \([^ ]*\) \.*   Passed .*/\1/p' "build/passed/$1"
}

set -- --output-on-failure -j "$jobs" --output-junit tests.xml
outputs=
if [ -n "$tests" ]; then
  set -- "$@" --no-tests=error --build-config cases --tests-regex "$tests"
else
  [ "$tier" = all ] || set -- "$@" --label-exclude '^whole$'
  # A comment changes only the result of tests that read the text of VHDL.
  mkdir -p build/passed
  keep_output text "$(hash_of_files '')"
  keep_output code "$(hash_of_files '/^ *--/d')"
  outputs='build/passed/text build/passed/code'
  readers='^(format|tables|vhdl_text|(rtl_lint|pages|proofs|mutants)_test|tb\.mutants|prove\.faults\..*|evidence.*)$'
  passed=$({ passed_in text && passed_in code | grep -Ev "$readers"; } | sort -u)
  if [ -n "$passed" ]; then
    echo "$(echo "$passed" | wc -l) tests have passed on these files; to run them again, remove build/passed"
    set -- "$@" --exclude-regex "^($(echo "$passed" | sed 's/[.+]/\\&/g' | paste -sd '|'))\$"
  else
    set -- "$@" --no-tests=error
  fi
fi

# Most tests draw few pixels: Verilator's C++ is compiled for longer than an optimized library saves. Tests that draw many
# have another level in their CMakeLists.txt.
export HALFWAY_QUICK_BUILDS=-O0
rm -f build/tests.xml build/tests.failed
# shellcheck disable=SC2086
{ (cd build && ctest "$@" 2>&1) || echo "$?" >build/tests.failed; } | tee -a $outputs
# Files that changed during the tests: it is not known which tests saw them.
if [ -n "$outputs" ] && [ "$(hash_of_files '')" != "$(head -n 1 build/passed/text)" ]; then rm -r build/passed; fi
if grep -qs '<testcase' build/tests.xml; then
  echo 'The slowest tests, in seconds:'
  sed -n 's/.*<testcase name="\([^"]*\)".* time="\([^"]*\)".*/\2 \1/p' build/tests.xml | sort -rn | head -n 10
fi
[ ! -f build/tests.failed ] || exit "$(cat build/tests.failed)"
