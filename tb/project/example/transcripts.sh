#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes the line of `make sim` into the pages that quote it, and fails if a code block that starts with
# `$ build/halfway` is not what the program prints. A block may leave out lines, and the right ends of lines.
# transcripts.sh HALFWAY ROOT FOLDER
set -eu
halfway=$1 root=$2 folder=$3
mkdir -p "$folder"
cd "$folder"
wrong=0
fail() { echo "$1"; wrong=1; }

# The line of `make sim`.
"$halfway" sim spheres --out out >printed.txt
for page in README.md docs/performance.md; do
  awk 'NR == FNR { line = $0; next } /^spheres +quadratic +exact / { $0 = line; ++found } { print }
    END { exit !found }' printed.txt "$root/$page" >page.md || { fail "$page: has no line of make sim"; continue; }
  cat page.md >"$root/$page"
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
