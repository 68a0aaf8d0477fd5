// SPDX-License-Identifier: Apache-2.0
// Linked into an instrumented simulation: counts, and at the end writes what it counted into the file that
// HALFWAY_COVERAGE names. GHDL hands an unconstrained array as the address of two: elements and bounds.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

struct bounds {
  int32_t left, right;
  uint8_t direction;
  uint32_t length;
};
struct array {
  const unsigned char* elements;
  const struct bounds* bounds;
};

enum { c_most = 1 << 16, c_zero = 2, c_one = 3 };  // places in std_ulogic
enum { c_rose = 4, c_fell = 8, c_value = 3 };

// A byte a bit, the first on the left: its last defined value (0: none yet, else 2 or 3), whether it rose and fell.
struct seen {
  uint32_t length;
  unsigned char* bits;
};

static uint64_t s_ran[c_most], s_false[c_most], s_true[c_most];
static struct {
  uint32_t count;
  struct seen* instances;
} s_seen[c_most];
static int32_t s_instances;

static void write_all(void) {
  const char* name = getenv("HALFWAY_COVERAGE");
  FILE* file = name == NULL ? NULL : fopen(name, "w");
  if (file == NULL) return;
  for (uint32_t id = 0; id < c_most; ++id) {
    if (s_ran[id] != 0) fprintf(file, "ran %u\n", id);
    if (s_false[id] != 0) fprintf(file, "false %u\n", id);
    if (s_true[id] != 0) fprintf(file, "true %u\n", id);
    for (uint32_t i = 0; i < s_seen[id].count; ++i) {
      const struct seen* s = &s_seen[id].instances[i];
      if (s->length == 0) continue;
      fprintf(file, "saw %u ", id);
      for (uint32_t k = 0; k < s->length; ++k)
        fputc((s->bits[k] & (c_rose | c_fell)) == (c_rose | c_fell) ? '1' : '0', file);
      fputc('\n', file);
    }
  }
  fprintf(file, "end\n");
  fclose(file);
}

__attribute__((constructor)) static void begin(void) { atexit(write_all); }

int halfway_ran(int32_t id) {
  ++s_ran[id];
  return 1;
}

int halfway_was(int32_t id, int condition) {
  if (condition & 1)
    ++s_true[id];
  else
    ++s_false[id];
  return condition & 1;
}

int32_t halfway_new_instance(int32_t file_id) {
  (void)file_id;
  return s_instances++;
}

int halfway_saw(int32_t instance, int32_t id, const struct array* word) {
  const uint32_t length = word->bounds->length;
  if ((uint32_t)instance >= s_seen[id].count) {
    const uint32_t count = (uint32_t)instance + 1;
    s_seen[id].instances = realloc(s_seen[id].instances, count * sizeof(struct seen));
    for (uint32_t i = s_seen[id].count; i < count; ++i) s_seen[id].instances[i] = (struct seen){0, NULL};
    s_seen[id].count = count;
  }
  struct seen* s = &s_seen[id].instances[instance];
  if (s->bits == NULL && length > 0) {
    s->length = length;
    s->bits = calloc(length, 1);
  }
  for (uint32_t i = 0; i < s->length && i < length; ++i) {
    const unsigned char value = word->elements[i];
    if (value != c_zero && value != c_one) continue;
    const unsigned char before = s->bits[i] & c_value;
    if (before != 0 && before != value) s->bits[i] |= value == c_one ? c_rose : c_fell;
    s->bits[i] = (unsigned char)((s->bits[i] & ~c_value) | value);
  }
  return 1;
}
