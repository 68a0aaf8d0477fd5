// SPDX-License-Identifier: Apache-2.0
// Memory for GHDL 2: large blocks stay at their address when they grow.
//
// Synthesis in GHDL 2 writes through a reference into a table that may just have been moved to another
// address (https://github.com/ghdl/ghdl/issues/2139, mended in GHDL 3). The write is lost, and with it the
// connection of some bits of a variable: about one in a hundred of our netlists is wrong without a message.
// Loaded before the C library, this gives each large block addresses for later growth. Pages that are not
// used take no memory.
#include <malloc.h>

#include <cstddef>

extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_realloc(void* block, std::size_t size);

static std::size_t with_room(std::size_t size) {
  constexpr std::size_t c_large = 4096, c_room = std::size_t{64} << 20;
  return size >= c_large && size < c_room ? c_room : size;
}

void* malloc(std::size_t size) {
  return __libc_malloc(with_room(size));
}

void* realloc(void* block, std::size_t size) {
  if (block != nullptr && size != 0 && size <= malloc_usable_size(block)) return block;
  return __libc_realloc(block, with_room(size));
}

}  // extern "C"
