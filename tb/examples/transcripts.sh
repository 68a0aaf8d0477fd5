#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# What pages quote of the program's output must be what it prints: the line of `make sim` without its seconds, and every
# code block that starts with `$ build/halfway`. A block may leave out lines, and the right ends of lines.
# transcripts.sh check|write HALFWAY ROOT FOLDER: `write` mends the line of `make sim`.
set -eu
mode=$1 halfway=$2 root=$3 folder=$4
mkdir -p "$folder"
cd "$folder"
wrong=0
fail() { echo "$1"; wrong=1; }

# The line of `make sim`.
without_seconds() { sed 's/, [0-9.]* s |/ |/g; s/ | [0-9.]* s$//' "$1"; }
"$halfway" sim spheres --out out >printed.txt
without_seconds printed.txt >printed.bare
for page in README.md docs/performance.md; do
  grep '^spheres  *quadratic  *exact ' "$root/$page" >quoted.txt || true
  without_seconds quoted.txt >quoted.bare
  if cmp -s printed.bare quoted.bare; then continue; fi
  if [ "$mode" = write ] && [ -s quoted.txt ]; then
    awk 'NR == FNR { line = $0; next } /^spheres +quadratic +exact / { $0 = line } { print }' \
      printed.txt "$root/$page" >page.md
    cat page.md >"$root/$page"
    echo "$page: the line of make sim is written"
  else
    fail "$page: is not what halfway sim spheres prints; make evidence writes it:"
    diff quoted.bare printed.bare || true
  fi
done

# Code blocks: each line must begin a line of the output, in the output's order. The commands name files in sim/.
ln -sfn "$root/sim" sim
blocks=0
for page in $(cd "$root" && grep -rl --include='*.md' '^\$ build/halfway ' README.md docs sim/*/*.md); do
  awk '/^\$ build\/halfway / { print substr($0, 17) }' "$root/$page" >commands.txt
  while IFS= read -r command; do
    blocks=$((blocks + 1))
    # shellcheck disable=SC2086 # words of a command
    "$halfway" $command >printed.txt </dev/null || fail "$page: does not run: $command"
    awk -v command="\$ build/halfway $command" -v page="$page" '
      { sub(/ +$/, "") }
      NR == FNR { printed[++count] = $0; next }
      /^```/ { quotes = 0 }
      quotes {
        ++lines
        while (++at <= count && index(printed[at], $0) != 1) { }
        if (at > count) { print page ":" FNR ": is not in the output of " command; exit 1 }
      }
      $0 == command { quotes = 1 }
      END { if (!lines) exit 1 }' printed.txt "$root/$page" || wrong=1
  done <commands.txt
done

[ "$blocks" -gt 0 ] || fail 'no page quotes a command'
[ $wrong = 0 ] || exit 1
echo 'transcripts: passed'
