/* SPDX-License-Identifier: Apache-2.0
 * Draws a mesh that turns, on the board of docs/board.md or on the core of docs/rtl/core.md:
 *
 *   spin MESH DEVICE [FRAMES]
 *
 * MESH: a mesh file or a scene file. DEVICE: /dev/spidev0.0, or the socket of `halfway board-sim --serve`; or
 * core:SOCKET, with the socket of `halfway core-sim --serve`. */
#include <halfway.h>
#include <halfway_core.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core_port.h"
#include "spi.h"

enum { WIDTH = 320, HEIGHT = 240, LONGEST_PACKET = 512, LONGEST_WAIT = 60 /* seconds */ };
enum { MOST_PACKET_WORDS = 1 << 20 };
enum { READ_STATUS = 0, DRAW = 1, END_FRAME = 2, ROOM = 0x80, ENDING = 0x40, FAULT = 0x20, ERROR = 0x10 };

static int failed(const halfway_error* error) {
  fprintf(stderr, "%s\n", error->text);
  return error->code;
}

/* CRC-16/CCITT-FALSE. */
static unsigned crc16(const uint8_t* bytes, size_t count) {
  unsigned crc = 0xffff;
  for (size_t i = 0; i < count; ++i) {
    crc ^= (unsigned)bytes[i] << 8;
    for (int bit = 0; bit < 8; ++bit) crc = crc & 0x8000 ? (crc << 1 ^ 0x1021) & 0xffff : crc << 1;
  }
  return crc;
}

/* Sends one packet and prints what the board reports. Returns its status byte. */
static uint8_t exchange(int device, const uint8_t* packet, size_t count) {
  uint8_t answer[LONGEST_PACKET];
  spi_transfer(device, packet, answer, count);
  if (answer[0] == 0xff) return ENDING; /* no status: bits 7 and 6 are never both 1 */
  if (answer[0] & FAULT) fprintf(stderr, "the board reports a fragment outside the frame\n");
  if (answer[0] & ERROR) fprintf(stderr, "the board has dropped a packet: check its wiring\n");
  return answer[0];
}

/* Waits until the board can take a packet, adds the CRC, and sends it. */
static void send_packet(int device, uint8_t* packet, size_t count) {
  const uint8_t read_status = READ_STATUS, needed = packet[0] == DRAW ? ROOM : 0;
  const time_t start = time(NULL);
  while ((exchange(device, &read_status, 1) & (ENDING | needed)) != needed)
    if (time(NULL) - start > LONGEST_WAIT) {
      fprintf(stderr, "the board takes no packet: check its wiring and its bitstream\n");
      exit(HALFWAY_FAILED);
    }
  const unsigned crc = crc16(packet, count);
  packet[count] = (uint8_t)(crc >> 8);
  packet[count + 1] = (uint8_t)crc;
  exchange(device, packet, count + 2);
}

static void send_vector(int device, const uint32_t* words, unsigned bits) {
  uint8_t packet[LONGEST_PACKET] = {DRAW};
  size_t count = 1;
  for (unsigned byte = (bits + 7) / 8; byte-- > 0;)
    packet[count++] = (uint8_t)(words[byte / 4] >> (8 * (byte % 4)));
  send_packet(device, packet, count);
}

static void end_frame(int device, unsigned next_background) {
  uint8_t packet[LONGEST_PACKET] = {END_FRAME, (uint8_t)(next_background >> 8), (uint8_t)next_background};
  send_packet(device, packet, 3);
}

static int spin_on_board(halfway_scene* scene, const char* name, int frames) {
  const halfway_setup setup = {HALFWAY_TEST_OF_PRESET, 8.0};
  halfway_error error;
  halfway_hardware* hardware = halfway_quadratic(3, 1, &error);
  if (!hardware) return failed(&error);
  const int device = spi_open(name);
  if (device < 0) {
    perror(name);
    return HALFWAY_FAILED;
  }
  for (int frame = 0; frame < frames; ++frame) {
    if (halfway_orbit_camera(scene, 360.0 * frame / frames, 10.0, 1.0, &error)) return failed(&error);
    halfway_vectors* vectors = halfway_scene_vectors(scene, hardware, WIDTH, HEIGHT, &setup, &error);
    if (!vectors) return failed(&error);
    const uint32_t* words = halfway_words(vectors);
    for (size_t i = 0; i < halfway_vector_count(vectors); ++i, words += halfway_words_per_vector(hardware))
      send_vector(device, words, halfway_init_bits(hardware));
    end_frame(device, 0);
    halfway_free_vectors(vectors);
  }
  halfway_free_hardware(hardware);
  return HALFWAY_OK;
}

/* Compares a picture with the golden model's. */
static int check_picture(const uint8_t* rgb, const halfway_vectors* vectors) {
  halfway_error error;
  halfway_fragments* fragments = halfway_draw_golden(vectors, &error);
  halfway_frame* frame = fragments ? halfway_make_frame(NULL, WIDTH, HEIGHT, &error) : NULL;
  if (!frame || halfway_add_fragments(frame, halfway_fragment_data(fragments),
                                      halfway_fragment_count(fragments), &error))
    return failed(&error);
  const int differs = memcmp(rgb, halfway_rgb(frame), 3 * WIDTH * HEIGHT) != 0;
  if (differs) fprintf(stderr, "the picture differs from the golden model's\n");
  halfway_free_frame(frame);
  halfway_free_fragments(fragments);
  return differs ? HALFWAY_DIFFERS : HALFWAY_OK;
}

static void write_picture(const uint8_t* rgb, int number) {
  char name[32];
  snprintf(name, sizeof name, "spin-%d.ppm", number);
  FILE* file = fopen(name, "wb");
  if (!file || fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT) < 0 ||
      fwrite(rgb, 3, WIDTH * HEIGHT, file) != WIDTH * HEIGHT || fclose(file) != 0) {
    perror(name);
    exit(HALFWAY_FAILED);
  }
}

/* The core must have been made for this scene, with pixels of XRGB8888: RGB565 is not the golden model's. */
static int spin_on_core(halfway_scene* scene, const char* name, int frames) {
  static uint8_t rgb[3 * WIDTH * HEIGHT];
  const halfway_request request = {0};
  const halfway_core_layout layout = {WIDTH, HEIGHT, MOST_PACKET_WORDS, 0};
  halfway_error error;
  halfway_hardware* hardware = halfway_plan(scene, &request, &error);
  if (!hardware) return failed(&error);
  struct core_port port;
  if (!core_port_open(&port, name)) {
    perror(name);
    return HALFWAY_FAILED;
  }
  halfway_core* core = halfway_open_core(&port.access, &port.memory, &layout, &error);
  if (!core) return failed(&error);
  for (int frame = 0; frame < frames; ++frame) {
    if (halfway_orbit_camera(scene, 360.0 * frame / frames, 10.0, 1.0, &error)) return failed(&error);
    halfway_vectors* vectors = halfway_scene_vectors(scene, hardware, WIDTH, HEIGHT, NULL, &error);
    if (!vectors || halfway_queue_frame(core, vectors, NULL, &error) || halfway_wait_core(core, &error) ||
        halfway_read_picture(core, rgb, &error))
      return failed(&error);
    write_picture(rgb, frame);
    const int checked = check_picture(rgb, vectors);
    if (checked != HALFWAY_OK) return checked;
    halfway_free_vectors(vectors);
  }
  halfway_close_core(core);
  halfway_free_hardware(hardware);
  return HALFWAY_OK;
}

int main(int argc, char** argv) {
  if (argc < 3) {
    fprintf(stderr, "spin MESH DEVICE [FRAMES]\n");
    return HALFWAY_BAD_INPUT;
  }
  const char core[] = "core:";
  const int frames = argc > 3 ? atoi(argv[3]) : 360;
  halfway_error error;
  halfway_scene* scene = halfway_load_scene(argv[1], NULL, &error);
  if (!scene) return failed(&error);
  const int is_core = strncmp(argv[2], core, strlen(core)) == 0;
  const int code = is_core ? spin_on_core(scene, argv[2] + strlen(core), frames)
                           : spin_on_board(scene, argv[2], frames);
  halfway_free_scene(scene);
  return code;
}
