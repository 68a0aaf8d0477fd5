#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Tests a page of evidence: a run that is killed continues, a tree with changes is refused, a broken threshold fails.
# Then scripts/evidence.sh, with small programs in place of those that measure.
# evidence.sh SMALL_PAGE HALFWAY_PAGE ROOT WORK_FOLDER
set -eu
program=$1 halfway_page=$2 root=$3 work=$4
rm -rf "$work"
mkdir -p "$work/tb/evidence" "$work/build"
cd "$work"
fail() { echo "evidence: $*" >&2; cat log >&2; exit 1; }
git() { command git -c user.name=n -c user.email=e -c init.defaultBranch=main "$@" >/dev/null; }
run() { # wanted exit code, words of the output, options
  wanted=$1 words=$2 code=0
  shift 2
  "$program" --gtest_brief=1 --evidence "$@" >log 2>&1 || code=$?
  [ $code = "$wanted" ] || fail "the exit code is $code, not $wanted"
  grep -qF -- "$words" log || fail "'$words' is missing"
}
measured() { tr -d '\n' <build/measured; }

git init .
printf 'build\nlog\n' >.gitignore
printf '# Small\n\nText.\n' >page.md
printf '[items]\nrule = "at least"\na = 1\nb = 1\nc = 5\n' >tb/evidence/thresholds.toml
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
sed -i 's/^c = 5/c = 6/' tb/evidence/thresholds.toml
run 1 'tb/evidence/thresholds.toml:5: items: c: it is 5; the threshold is 6, at least'
sed -i 's/^c = 6/c = 5/; s/^b = 1//' tb/evidence/thresholds.toml
run 1 'tb/evidence/thresholds.toml:1: items: b has no threshold; it is 1'
git checkout -q tb

run 0 '--evidence --part=TEXT' --help

# Changes that are not committed.
echo 2 >source.c
run 2 'source.c'
git commit -am two
run 0 'small: 1 of 3 rows are measured; the page is not written' --part=items/a
cmp page.md before.md || fail 'a page was written although rows are missing'
echo -1 >build/c
run 1 'FAILED'
cmp page.md before.md || fail 'a page was written although a row is missing'
echo 7 >build/c
run 0 'small: page.md is written'
[ "$(measured)" = abcabc ] || fail "measured again: $(measured)"
# Rows of this commit that are measured again are written.
rm build/evidence/*/small.jsonl
echo 8 >build/c
run 0 'small: page.md is written'
grep -q '^| c | 8' page.md || fail 'the page has a row of the first measurement'

# scripts/evidence.sh.
mkdir -p scripts build/tb docs/results
cp "$root/scripts/evidence.sh" scripts
ln -s "$halfway_page" build/tb/halfway_page
for page in bounds proofs mutants synthesis; do printf '# Page\n' >docs/results/$page.md; done
git add . && git commit -m three
commit=$(command git rev-parse HEAD)
fake() { # program, shell text
  printf '#!/bin/sh\necho "$0 $*" >>build/calls\n%s\n' "$2" >build/tb/"$1"
  chmod +x build/tb/"$1"
}
evidence() { # wanted exit code, words of the output, arguments
  wanted=$1 words=$2 code=0
  shift 2
  scripts/evidence.sh "$@" >log 2>&1 || code=$?
  [ $code = "$wanted" ] || fail "evidence.sh $*: the exit code is $code, not $wanted"
  [ -z "$words" ] || grep -qF -- "$words" log || fail "evidence.sh $*: '$words' is missing"
}
evidence 2 'give one of: bounds cells accuracy' targets no_page
evidence 0 'halfway_mutants halfway_vectors' targets mutants
echo 3 >source.c
evidence 2 ' M source.c' targets all
evidence 2 ' M source.c' measure bounds 1
git checkout -q source.c
fake halfway_bounds "mkdir -p build/evidence/$commit; touch build/evidence/$commit/bounds.jsonl"
evidence 0 '== bounds: page 1 of 1' measure bounds 1
grep -q 'halfway_bounds --gtest_brief=1 --evidence$' build/calls || fail "called: $(cat build/calls)"
# A page of this commit is not measured: only if a journal of it is there, for the thresholds, or if $again is 1.
rm build/evidence/"$commit"/bounds.jsonl build/calls
printf 'Measured by `make evidence PAGE=bounds` at commit `%s`\n' "$(echo "$commit" | cut -c 1-12)" >>docs/results/bounds.md
evidence 0 'every page is of this commit' measure bounds 1
[ ! -e build/calls ] || fail 'a page of this commit was measured'
echo row >build/evidence/"$commit"/bounds.jsonl
again=1 evidence 0 '== bounds' measure bounds 1
[ ! -s build/evidence/"$commit"/bounds.jsonl ] || fail 'rows that were measured before are kept with again=1'
touch build/evidence/"$commit"/transcripts.done
evidence 0 '' targets transcripts
[ ! -s log ] || fail 'transcripts of this commit are measured'
again=1 evidence 0 'halfway' targets transcripts
fake halfway_synth 'exit 0'
design=core evidence 0 '' measure clocks 1
grep -q 'halfway_synth clocks --page core --jobs 1$' build/calls || fail "called: $(cat build/calls)"
fake halfway_bounds 'exit 1'
evidence 1 'bounds ends with 1' measure bounds 1
# With options, results are only printed, whatever has changed.
fake halfway_proofs 'exit 0'
echo 3 >source.c
evidence 0 '' run proofs 1 raster
grep -q 'halfway_proofs . build/proofs raster$' build/calls || fail "called: $(cat build/calls)"
echo 'evidence: passed'
