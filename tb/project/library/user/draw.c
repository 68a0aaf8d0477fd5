/* SPDX-License-Identifier: Apache-2.0
 * draw SCENE SHADER PRESET WIDTH HEIGHT init|trace|ppm: prints a scene's init vectors in hexadecimal, the golden model's
 * fragments, or the frame, in the forms of `halfway init` and `halfway sim`. */
#include <halfway.h>
#include <halfway_core.h>
#include <halfway_core_registers.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failed(const halfway_error* error) {
  fprintf(stderr, "%s\n", error->text);
  return error->code;
}

static void print_vectors(const halfway_vectors* vectors, const halfway_hardware* hardware) {
  const size_t words = halfway_words_per_vector(hardware), digits = (halfway_init_bits(hardware) + 3) / 4;
  const uint32_t* word = halfway_words(vectors);
  for (size_t i = 0; i < halfway_vector_count(vectors); ++i, word += words) {
    for (size_t digit = digits; digit-- > 0;)
      putchar("0123456789abcdef"[word[digit / 8] >> (digit % 8 * 4) & 15]);
    putchar('\n');
  }
}

static void print_trace(const halfway_fragments* fragments) {
  const halfway_fragment* f = halfway_fragment_data(fragments);
  for (size_t i = 0; i < halfway_fragment_count(fragments); ++i, ++f)
    printf("%lu %u %u %lu %u %u %u\n", (unsigned long)f->triangle, (unsigned)f->y, (unsigned)f->x,
           (unsigned long)f->z, (unsigned)f->red, (unsigned)f->green, (unsigned)f->blue);
}

int main(int argc, char** argv) {
  if (argc != 7) return HALFWAY_BAD_INPUT;
  const char *shaders[] = {"quadratic", "spherical", "processors"}, *what = argv[6];
  const uint32_t width = (uint32_t)atoi(argv[4]), height = (uint32_t)atoi(argv[5]);
  halfway_request request = {0};
  while (strcmp(shaders[request.shader], argv[2]) != 0)
    if (++request.shader == 3) return HALFWAY_BAD_INPUT;
  request.preset = strcmp(argv[3], "published") == 0 ? HALFWAY_PUBLISHED : HALFWAY_EXACT;

  halfway_error error;
  halfway_scene* scene = halfway_load_scene(argv[1], SCENES, &error);
  halfway_hardware* hardware = scene ? halfway_plan(scene, &request, &error) : NULL;
  halfway_vectors* vectors =
      hardware ? halfway_scene_vectors(scene, hardware, width, height, NULL, &error) : NULL;
  halfway_fragments* fragments = vectors ? halfway_draw_golden(vectors, &error) : NULL;
  halfway_frame* frame = fragments ? halfway_make_frame(scene, width, height, &error) : NULL;
  if (!frame || halfway_add_fragments(frame, halfway_fragment_data(fragments),
                                      halfway_fragment_count(fragments), &error))
    return failed(&error);

  if (strcmp(what, "init") == 0) print_vectors(vectors, hardware);
  if (strcmp(what, "trace") == 0) print_trace(fragments);
  if (strcmp(what, "ppm") == 0) {
    printf("P6\n%lu %lu\n255\n", (unsigned long)width, (unsigned long)height);
    fwrite(halfway_rgb(frame), 3, (size_t)width * height, stdout);
  }
  halfway_free_frame(frame);
  halfway_free_fragments(fragments);
  halfway_free_vectors(vectors);
  halfway_free_hardware(hardware);
  halfway_free_scene(scene);
  return HALFWAY_OK;
}
