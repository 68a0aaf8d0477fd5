/* SPDX-License-Identifier: Apache-2.0 */
#include "core_port.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "spi.h"

enum { READ = 0, WRITE = 1, WAIT = 2, MEMORY_ADDRESS = 0x10000000, LONGEST_NAME = 256 };

static uint32_t request(void* port, uint32_t kind, uint32_t offset, uint32_t value) {
  const int core = ((const struct core_port*)port)->socket;
  const uint32_t words[3] = {kind, offset, value};
  uint32_t answer[2] = {0, 0}; /* value, response */
  if (send(core, words, sizeof words, MSG_NOSIGNAL) == (ssize_t)sizeof words &&
      recv(core, answer, sizeof answer, MSG_WAITALL) == (ssize_t)sizeof answer && answer[1] == 0)
    return answer[0];
  fprintf(stderr, "the core does not answer an access to register %02x\n", offset);
  exit(HALFWAY_FAILED);
}

static uint32_t read_register(void* port, uint32_t offset) {
  return request(port, READ, offset, 0);
}

static void write_register(void* port, uint32_t offset, uint32_t value) {
  request(port, WRITE, offset, value);
}

static void wait_for_interrupt(void* port) {
  request(port, WAIT, 0, 0);
}

int core_port_open(struct core_port* port, const char* name) {
  char memory[LONGEST_NAME];
  struct stat status;
  snprintf(memory, sizeof memory, "%s.memory", name);
  const int file = open(memory, O_RDWR);
  if (file < 0 || fstat(file, &status) != 0) return 0;
  const size_t size = (size_t)status.st_size;
  void* bytes = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (bytes == MAP_FAILED) return 0;
  port->socket = socket_open(name);
  port->memory = (halfway_core_memory){bytes, MEMORY_ADDRESS, size};
  port->access = (halfway_core_access){read_register, write_register, wait_for_interrupt, port};
  return port->socket >= 0;
}
