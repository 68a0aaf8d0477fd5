#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# wasm32.sh CHECKOUT HEADERS SCRATCH: checks that the sources of sim/extras/live/core_sources.txt compile for a browser, with the
# generated HEADERS: by clang for WebAssembly, without exceptions, with a standard library that has no threads, no file system and no from_chars of
# double. Only syntax and types are checked. Then it checks that a file with each of these is refused.
set -eu
checkout=$1 headers=$2 scratch=$3
sources=$(grep -v '^#' "$checkout/sim/extras/live/core_sources.txt")
compiler=clang++

fail() {
  echo "$1" >&2
  exit "${2:-1}"
}
command -v $compiler >/dev/null || fail "$compiler: not found; install it with: apt-get install clang" 3
[ -d /usr/include/wasm32-wasi ] || fail 'wasi-libc: not found; install it with: scripts/setup.sh tools' 3
[ -d /usr/include/wasm32-wasi/c++/v1 ] || fail 'libc++: not found; install it with: scripts/setup.sh tools' 3

# Use only these two libraries of /usr/include, because its other headers are those of another system.
rm -rf "$scratch"
mkdir -p "$scratch/include"
ln -s /usr/include/glm /usr/include/fmt /usr/include/nlohmann /usr/include/toml++ "$scratch/include"

check() { # FILE: its errors on stdout
  $compiler --target=wasm32-wasi -std=c++20 -fno-exceptions -fsyntax-only -I "$checkout/model" -I "$headers" -I "$checkout" \
    -isystem "$scratch/include" "$1" 2>&1
}

# Each source file, and all headers in one.
cd "$checkout"
find $sources -maxdepth 1 -name '*.hpp' ! -name '*_test.hpp' | sed 's/.*/#include "&"/' >"$scratch/headers.cpp"
wrong=0 count=0
for file in $(find $sources -maxdepth 1 -name '*.cpp' ! -name '*_test.cpp') "$scratch/headers.cpp"; do
  count=$((count + 1))
  check "$file" >"$scratch/errors" || { wrong=$((wrong + 1)); grep -E 'error' "$scratch/errors" | head -5; }
done
[ $count -gt 30 ] || fail "checked $count files only: where are the others of $checkout/sim/extras/live/core_sources.txt?"

# refused NAME: the file on stdin must not compile.
refused() {
  cat >"$scratch/planted.cpp"
  ! check "$scratch/planted.cpp" >"$scratch/errors" || fail "$1 in the core would not be found"
}
refused 'an exception' <<'END'
int f(int x) { if (x < 0) throw x; return x; }
END
refused 'a thread' <<'END'
#include <thread>
std::thread other;
END
refused 'a path' <<'END'
#include <filesystem>
bool f() { return std::filesystem::exists("x"); }
END
refused 'from_chars of double' <<'END'
#include <charconv>
double f(const char* begin, const char* end) { double x = 0; std::from_chars(begin, end, x); return x; }
END
[ $wrong -eq 0 ] || fail "$wrong of $count files of the core do not compile for a browser"
echo "$count files of the core compile for wasm32"
