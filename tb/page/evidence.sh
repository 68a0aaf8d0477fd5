#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Tests a page of evidence: a run that is killed continues, a tree with changes is refused, a broken threshold fails.
# evidence.sh PROGRAM WORK_FOLDER: the program is small_page.
set -eu
program=$1 work=$2
rm -rf "$work"
mkdir -p "$work/tb" "$work/build"
cd "$work"
fail() { echo "evidence: $*" >&2; cat log >&2; exit 1; }
git() { command git -c user.name=n -c user.email=e -c init.defaultBranch=main "$@" >/dev/null; }
run() { # wanted exit code, words of the output
  code=0
  "$program" --gtest_brief=1 --evidence >log 2>&1 || code=$?
  [ $code = "$1" ] || fail "the exit code is $code, not $1"
  grep -qF -- "$2" log || fail "'$2' is missing"
}
measured() { tr -d '\n' <build/measured; }

git init .
printf 'build\nlog\n' >.gitignore
printf '# Small\n\nText.\n' >page.md
printf '[items]\nrule = "at least"\na = 1\nb = 1\nc = 5\n' >tb/thresholds.toml
echo 1 >source.c
git add .
git commit -m one
echo 5 >build/c

# Kill a run in the middle. The next one measures only what is missing, and writes the page.
"$program" --gtest_brief=1 --evidence >log 2>&1 &
process=$!
until grep -q '"a"' build/evidence/*/small.jsonl 2>/dev/null; do
  kill -0 $process 2>/dev/null || fail 'ended before it was killed'
  sleep 0.05
done
kill -9 $process
wait $process 2>/dev/null || true
printf '{"name":"b","sect' >>"$(echo build/evidence/*/small.jsonl)"
[ "$(cat page.md)" = "$(printf '# Small\n\nText.')" ] || fail 'a killed run wrote the page'
touch build/go
run 0 'small: page.md is written'
[ "$(measured)" = abc ] || fail "measured twice: $(measured)"
short=$(command git rev-parse HEAD | cut -c 1-12)
grep -q "^Measured by \`make evidence PAGE=small\` at commit \`$short\` on .*git version.*Machine: " page.md || fail 'the page has no line'
[ "$(grep -c '^| [abc] |' page.md)" = 3 ] || fail 'the page has not three rows'

# Nothing more to do. A commit of pages or of thresholds does not change that; one of a source does.
cp page.md before.md
run 0 'small: page.md is of this commit'
git add . && git commit -m pages
run 0 'small: page.md is of this commit'
cmp page.md before.md && [ "$(measured)" = abc ] || fail 'a page of this commit was measured again'

# A broken threshold: the page is true, and the exit code is 1.
sed -i 's/^c = 5/c = 6/' tb/thresholds.toml
run 1 'tb/thresholds.toml:5: items: c: it is 5; the threshold is 6, at least'
sed -i 's/^c = 6/c = 5/; s/^b = 1//' tb/thresholds.toml
run 1 'tb/thresholds.toml:1: items: b has no threshold; it is 1'
git checkout -q tb

# Changes that are not committed.
echo 2 >source.c
run 2 'source.c'
git commit -am two
echo -1 >build/c
run 1 'FAILED'
cmp page.md before.md || fail 'a page was written although a row is missing'
echo 7 >build/c
run 0 'small: page.md is written'
[ "$(measured)" = abcabc ] || fail "measured again: $(measured)"
echo 'evidence: passed'
