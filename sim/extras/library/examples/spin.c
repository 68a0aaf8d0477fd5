/* SPDX-License-Identifier: Apache-2.0
 * Draws a mesh that turns, on the board of docs/board.md:
 *
 *   spin MESH DEVICE [FRAMES]
 *
 * MESH: a mesh file or a scene file. DEVICE: /dev/spidev0.0, or the socket of `halfway board-sim --serve`. */
#include <halfway.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "spi.h"

enum { WIDTH = 320, HEIGHT = 240, LONGEST_PACKET = 512, LONGEST_WAIT = 60 /* seconds */ };
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

int main(int argc, char** argv) {
  if (argc < 3) {
    fprintf(stderr, "spin MESH DEVICE [FRAMES]\n");
    return HALFWAY_BAD_INPUT;
  }
  const int frames = argc > 3 ? atoi(argv[3]) : 360;
  const halfway_setup setup = {HALFWAY_TEST_OF_PRESET, 8.0};
  halfway_error error;
  halfway_scene* scene = halfway_load_scene(argv[1], NULL, &error);
  halfway_hardware* hardware = scene ? halfway_quadratic(3, 1, &error) : NULL;
  if (!hardware) return failed(&error);
  const int device = spi_open(argv[2]);
  if (device < 0) {
    perror(argv[2]);
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
  halfway_free_scene(scene);
  return HALFWAY_OK;
}
