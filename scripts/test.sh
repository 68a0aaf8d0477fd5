#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs the tests in build/ and prints the ten slowest.
#
#   scripts/test.sh quick JOBS          without the tests that have the label `whole`
#   scripts/test.sh all JOBS            every test that has not passed on this tree, also in an interrupted run
#   scripts/test.sh quick JOBS REGEX    every test whose name matches, each case of a C++ test by its own name
set -eu
tier=$1 jobs=$2 tests=${3-}
cd "$(dirname "$0")/.."

set -- --output-on-failure -j "$jobs" --output-junit tests.xml
log=/dev/null
if [ -n "$tests" ]; then
  set -- "$@" --no-tests=error --build-config cases --tests-regex "$tests"
elif [ "$tier" = quick ]; then
  set -- "$@" --no-tests=error --label-exclude '^whole$'
else
  # ctest's output of all runs on this tree: it names the tests that passed.
  log=$PWD/build/passed.log
  tree=$(find . -path ./build -prune -o -path ./.git -prune -o -type f -print0 | sort -z |
    xargs -0 sha256sum -- build/setup*.stamp | sha256sum)
  [ "$(head -n 1 "$log" 2>/dev/null)" = "$tree" ] || echo "$tree" >"$log"
  passed=$(sed -n 's/^ *[0-9]*\/[0-9]* Test *#[0-9]*: \([^ ]*\) \.*   Passed .*/\1/p' "$log" | sed 's/[.+]/\\&/g' | paste -sd '|')
  if [ -n "$passed" ]; then
    echo 'Tests that passed on this tree before are not run; to run them again, remove build/passed.log'
    set -- "$@" --exclude-regex "^($passed)\$"
  fi
fi

# Most tests draw few pixels: Verilator's C++ is compiled for longer than an optimized library saves.
export HALFWAY_QUICK_BUILDS=1
rm -f build/tests.xml build/tests.failed
{ (cd build && ctest "$@" 2>&1) || echo "$?" >build/tests.failed; } | tee -a "$log"
if [ -f build/tests.xml ]; then
  echo 'The slowest tests, in seconds:'
  sed -n 's/.*<testcase name="\([^"]*\)".* time="\([^"]*\)".*/\2 \1/p' build/tests.xml | sort -rn | head -n 10
fi
[ ! -f build/tests.failed ] || exit "$(cat build/tests.failed)"
