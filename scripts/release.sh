#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes the files of a release into build/release/VERSION, and tags the commit vVERSION. The version is that of CMakeLists.txt.
#
# Exit codes: 0 all is written, 1 the checkout is not one to release, 3 a tool is missing or broken.
set -eu
cd "$(dirname "$0")/.."

fail() {
  echo "release: $1" >&2
  exit "${2:-1}"
}

version=$(sed -n 's/^project(halfway VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
folder=build/release/$version
[ -z "$(git status --porcelain)" ] || fail 'files are changed or unknown to git: commit them'
if git rev-parse -q --verify "refs/tags/v$version" >/dev/null; then
  fail "v$version is a tag: raise the version in CMakeLists.txt"
fi
# The section of this version, without its title.
changes=$(awk -v title="## $version" '/^## /{ inside = $0 == title } inside && $0 != title' CHANGELOG.md)
[ -n "$changes" ] || fail "CHANGELOG.md has no section '## $version': name the unreleased one so"

rm -rf "$folder"
mkdir -p "$folder/verilog"
printf '%s\n' "$changes" >"$folder/changes.md"
for shader in quadratic spherical processors; do
  for top in '' --axi; do
    # shellcheck disable=SC2086 # no word if it is empty
    build/halfway verilog spheres --shader "$shader" --all-effects $top --out "$folder/verilog" || fail "no Verilog of $shader" 3
  done
done
build/halfway live || fail 'no page of make live' 3
cp build/live/index.html "$folder/live.html"
git archive --prefix="halfway-$version/" HEAD | gzip -9n >"$folder/halfway-$version.tar.gz"
git tag -a "v$version" -m "Halfway $version" -m "$changes"
echo "$folder: the sources, the Verilog of each shader, the page of make live, the changes; tag v$version"
