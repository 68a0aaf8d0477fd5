/* SPDX-License-Identifier: Apache-2.0
 *
 * The driver of halfway_core: frames of init vectors in, pictures in memory out. Objects, errors and options
 * are those of halfway.h. A core is used by one thread at a time.
 *
 * The driver reaches the registers through functions of the caller, and writes commands and packets into
 * memory that the core also sees. It has two buffers for packets, two pictures and one depth buffer: while a
 * frame is drawn, the next one can be queued, and the last finished picture can be shown.
 */
#ifndef HALFWAY_CORE_H
#define HALFWAY_CORE_H

#include "halfway.h"

/* NOLINTBEGIN(modernize-use-using,readability-identifier-naming): C */

#ifdef __cplusplus
extern "C" {
#endif

/* Registers have 32 bits; offsets are in bytes. halfway_core_registers.h has their names. */
typedef struct halfway_core_access {
  uint32_t (*read)(void* context, uint32_t offset);
  void (*write)(void* context, uint32_t offset, uint32_t value);
  void (*wait)(
      void* context); /* returns when the core's interrupt is active, or earlier; null: the driver polls */
  void* context;
} halfway_core_access;

/* `read` and `write` for registers that are mapped into the address space, such as by UIO or /dev/mem:
 * `registers` is the address of the first one. */
uint32_t halfway_mapped_read(void* registers, uint32_t offset);
void halfway_mapped_write(void* registers, uint32_t offset, uint32_t value);

/* Memory that processor and core see. It must be coherent or not cached. */
typedef struct halfway_core_memory {
  void* bytes;      /* as the processor sees it */
  uint32_t address; /* of the same byte as the core sees it; a multiple of 8 */
  size_t size;
} halfway_core_memory;

typedef struct halfway_core_layout {
  uint32_t width, height; /* of frames: 1 to 4096 pixels */
  size_t packet_words;    /* of the largest frame: halfway_packet_words */
  uint32_t polls; /* after this number of waits or reads without the end of a command the driver gives up;
                     0: 100 000 000 */
} halfway_core_layout;

typedef struct halfway_core halfway_core;

/* Words of 32 bits of the packets of these vectors. */
size_t halfway_packet_words(const halfway_vectors* vectors);

/* The size of memory that this layout needs; 0 on an error. Reads the core's pixel format. */
size_t halfway_core_bytes(const halfway_core_access* access, const halfway_core_layout* layout,
                          halfway_error* error);

/* New: the core behind these registers, freed by halfway_close_core. Checks identity and version, ends a
 * command that another program has left, and enables the core. Access and memory must stay until
 * halfway_close_core. */
halfway_core* halfway_open_core(const halfway_core_access* access, const halfway_core_memory* memory,
                                const halfway_core_layout* layout, halfway_error* error);

/* Ends the frame that is drawn, and disables the core. */
void halfway_close_core(halfway_core* core);

/* Refuses hardware whose vectors the core cannot take. The exponents of own tables cannot be checked: the
 * core's must be those of the hardware. */
int halfway_check_core(const halfway_core* core, const halfway_hardware* hardware, halfway_error* error);

typedef struct halfway_core_frame {
  int keep;                /* not 0: draw onto the frame that was queued before; otherwise clear first */
  uint8_t clear_colour[3]; /* red, green, blue */
  uint32_t left, top, width, height; /* only these pixels are cleared and drawn; width or height 0: all */
} halfway_core_frame;

/* Queues the frame of these vectors, which may be freed then. `frame` may be null. If both packet buffers are
 * in use, waits for one. The frame is drawn into the picture that is not the last one; if a frame that was
 * not yet done has a fault, the one that is queued after it is drawn over the last finished picture. */
int halfway_queue_frame(halfway_core* core, const halfway_vectors* vectors, const halfway_core_frame* frame,
                        halfway_error* error);

/* Waits for all queued frames. Returns an error with the names of the faults of all frames since the last
 * call. */
int halfway_wait_core(halfway_core* core, halfway_error* error);

/* Copies the last finished picture: red, green and blue of each pixel, line by line from the top left. Fails
 * before the first one. */
int halfway_read_picture(halfway_core* core, uint8_t* rgb, halfway_error* error);

#ifdef __cplusplus
}
#endif

/* NOLINTEND(modernize-use-using,readability-identifier-naming) */

#endif
