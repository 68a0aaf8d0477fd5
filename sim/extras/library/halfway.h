/* SPDX-License-Identifier: Apache-2.0
 *
 * libhalfway: scenes or arrays of triangles in, init vectors for the hardware out; the golden model's
 * fragments; frames.
 *
 * Objects are opaque. Each function whose comment says "new" returns an object of the caller, who frees it by
 * the function halfway_free_... of its kind; null may be freed. An object keeps copies of what it needs: it
 * does not depend on the objects from which it was made. Pointers into an object are valid until the object
 * is changed or freed.
 *
 * A function that can fail takes a halfway_error, which may be null. It returns null or an error's code, and
 * writes code and text. No C++ exception leaves the library. There are no globals: different objects may be
 * used by different threads at the same time.
 *
 * In the structures of options, 0 selects the default of each field, so `= {0}` is a valid value.
 */
#ifndef HALFWAY_H
#define HALFWAY_H

#include <stddef.h>
#include <stdint.h>

/* NOLINTBEGIN(modernize-use-using,readability-identifier-naming): C */

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Errors ---- */

/* The values are the exit codes of the program `halfway`. */
enum halfway_code { HALFWAY_OK = 0, HALFWAY_DIFFERS = 1, HALFWAY_BAD_INPUT = 2, HALFWAY_FAILED = 3 };

typedef struct halfway_error {
  int code;        /* one of halfway_code */
  char text[1000]; /* "file:line: what, and what to do"; a longer text is cut */
} halfway_error;

/* ---- Scenes: camera, lights, materials and triangles in world space ---- */

typedef struct halfway_scene halfway_scene;

/* New: a scene file (.toml), a mesh file (.obj .ply .stl .gltf .glb), or a built-in scene: the name of a file
 * in `scenes_folder`, without .toml. The folder may be null. CMake's variable halfway_SCENES names the
 * installed one. */
halfway_scene* halfway_load_scene(const char* name, const char* scenes_folder, halfway_error* error);

/* New: the text of a scene file that names no mesh files. `name` is for messages. */
halfway_scene* halfway_parse_scene(const char* toml, const char* name, halfway_error* error);

/* Triangles in world space, counter-clockwise seen from outside. Surfaces that are not closed are drawn from
 * both sides. */
typedef struct halfway_mesh {
  const double* positions; /* 3 per vertex */
  const double* normals;   /* 3 per vertex; null: smooth normals are computed */
  size_t vertices;
  const uint32_t* corners; /* 3 vertices per triangle; null: vertices 0 1 2, 3 4 5, ... */
  size_t triangles;
  const double* colour; /* red, green, blue, 0 to 1; null: white */
} halfway_mesh;

/* New: one mesh, a camera that sees all of it, and a white light from the camera's upper left. */
halfway_scene* halfway_make_scene(const halfway_mesh* mesh, halfway_error* error);

typedef struct halfway_camera {
  double eye[3], target[3], up[3];
  double vertical_fov_degrees; /* 0: 40 */
} halfway_camera;

int halfway_set_camera(halfway_scene* scene, const halfway_camera* camera, halfway_error* error);

/* Moves the camera to an orbit around its target, relative to the camera that the scene was made with or that
 * was set last: azimuth counter-clockwise seen from above, elevation towards up; the distance is multiplied
 * by the factor. */
int halfway_orbit_camera(halfway_scene* scene, double azimuth_degrees, double elevation_degrees,
                         double distance_factor, halfway_error* error);

typedef struct halfway_light {
  double to_light[3];  /* direction to the light; any length above 0 */
  double intensity[3]; /* red, green, blue */
} halfway_light;

/* Replaces all lights by these directional ones. A scene file can describe other kinds. */
int halfway_set_lights(halfway_scene* scene, const halfway_light* lights, size_t count, halfway_error* error);

size_t halfway_triangle_count(const halfway_scene* scene);
void halfway_free_scene(halfway_scene* scene);

/* ---- Hardware: shader, preset, effects, word lengths ---- */

typedef struct halfway_hardware halfway_hardware;

enum halfway_shader { HALFWAY_QUADRATIC = 0, HALFWAY_SPHERICAL = 1, HALFWAY_PROCESSORS = 2 };
enum halfway_preset { HALFWAY_EXACT = 0, HALFWAY_PUBLISHED = 1 };

typedef struct halfway_request {
  int shader;      /* halfway_shader */
  int preset;      /* halfway_preset */
  int degree;      /* of the quadratic shader: 2 (default), or 1 for planes */
  int all_effects; /* not 0: hardware with every effect, such as three channels for a grey scene */
} halfway_request;

/* New: the hardware that the scene needs. */
halfway_hardware* halfway_plan(const halfway_scene* scene, const halfway_request* request,
                               halfway_error* error);

/* New: a quadratic shader of preset exact, without a scene: with 1 or 3 channels, of degree 1 or 2. For
 * halfway_screen_vectors, or for a board whose hardware does not depend on the scene. */
halfway_hardware* halfway_quadratic(int channels, int degree, halfway_error* error);

const char* halfway_name(const halfway_hardware* hardware);        /* such as quadratic_shader-exact-c3 */
unsigned halfway_init_bits(const halfway_hardware* hardware);      /* bits of one init vector */
size_t halfway_words_per_vector(const halfway_hardware* hardware); /* words of 32 bits */
void halfway_free_hardware(halfway_hardware* hardware);

/* ---- Init vectors: the input of the hardware, in the order in which it must receive them ---- */

typedef struct halfway_vectors halfway_vectors;

enum halfway_highlight_test {
  HALFWAY_TEST_OF_PRESET = 0, /* conservative in preset exact, centroid in preset published */
  HALFWAY_TEST_NONE = 1,
  HALFWAY_TEST_CENTROID = 2,
  HALFWAY_TEST_CONSERVATIVE = 3
};

typedef struct halfway_setup {
  int highlight_test; /* halfway_highlight_test, of the quadratic shader */
  double threshold;   /* colour steps above which a triangle is split or cut; 0: 2 */
} halfway_setup;

/* New: the vectors of a frame. Width and height are 1 to 4096 pixels. `setup` may be null. Fails for a scene
 * that needs other hardware; a moved camera never does. */
halfway_vectors* halfway_scene_vectors(const halfway_scene* scene, const halfway_hardware* hardware,
                                       uint32_t width, uint32_t height, const halfway_setup* setup,
                                       halfway_error* error);

/* A triangle on the screen, in either orientation, with the colours of your own illumination model. It may
 * leave the frame. */
typedef struct halfway_screen_triangle {
  uint32_t number;   /* in the fragments */
  double x[3], y[3]; /* pixels, y down, -2048 to 6143; the centre of the first pixel is (0.5, 0.5) */
  double z[3];       /* depth, 0 (near) to 1 */
  double colour[6]
               [3]; /* red, green, blue in colour steps, 0 to 1023 (255 is white; one channel: the first), at
                       vertices 0, 1, 2 and at the midpoints of edges 0-1, 0-2, 1-2 (degree 1: not read) */
} halfway_screen_triangle;

/* New: the vectors of these triangles, for hardware of halfway_quadratic. Vertices are rounded to 1/16 pixel;
 * a triangle without area is left out. */
halfway_vectors* halfway_screen_vectors(const halfway_screen_triangle* triangles, size_t count,
                                        const halfway_hardware* hardware, uint32_t width, uint32_t height,
                                        halfway_error* error);

size_t halfway_vector_count(const halfway_vectors* vectors);
/* halfway_words_per_vector words for each vector, least significant word first; unused bits are 0. */
const uint32_t* halfway_words(const halfway_vectors* vectors);
void halfway_free_vectors(halfway_vectors* vectors);

/* ---- Fragments: the output of the hardware ---- */

typedef struct halfway_fragment {
  uint32_t triangle;
  uint32_t z; /* 24 bits, increases with distance */
  uint16_t y, x;
  uint8_t red, green, blue, reserved;
} halfway_fragment;

typedef struct halfway_fragments halfway_fragments;

/* New: the golden model's fragments. The hardware must output the same in the same order. */
halfway_fragments* halfway_draw_golden(const halfway_vectors* vectors, halfway_error* error);

size_t halfway_fragment_count(const halfway_fragments* fragments);
const halfway_fragment* halfway_fragment_data(const halfway_fragments* fragments);
void halfway_free_fragments(halfway_fragments* fragments);

/* ---- Frames: depth test and picture ---- */

typedef struct halfway_frame halfway_frame;

/* New: a frame with the scene's background, or a black one if the scene is null. */
halfway_frame* halfway_make_frame(const halfway_scene* scene, uint32_t width, uint32_t height,
                                  halfway_error* error);

/* Draws fragments, of the golden model or of the hardware. The one with the smallest z is kept; of equal z
 * the first. */
int halfway_add_fragments(halfway_frame* frame, const halfway_fragment* fragments, size_t count,
                          halfway_error* error);

/* Red, green and blue of each pixel, line by line from the top left. */
const uint8_t* halfway_rgb(const halfway_frame* frame);
void halfway_clear_frame(halfway_frame* frame);
void halfway_free_frame(halfway_frame* frame);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using,readability-identifier-naming) */

#endif
