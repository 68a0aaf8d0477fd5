/* SPDX-License-Identifier: Apache-2.0 */
#include "spi.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

enum { BITS_PER_SECOND = 12000000 }; /* the board takes 12.5 million */

static int is_socket(int descriptor) {
  struct stat status;
  return fstat(descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
}

int socket_open(const char* name) {
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  if (strlen(name) >= sizeof address.sun_path) {
    errno = ENAMETOOLONG;
    return -1;
  }
  strncpy(address.sun_path, name, sizeof address.sun_path - 1);
  const int device = socket(AF_UNIX, SOCK_STREAM, 0);
  return connect(device, (const struct sockaddr*)&address, sizeof address) == 0 ? device : -1;
}

int spi_open(const char* name) {
  struct stat status;
  if (stat(name, &status) != 0) return -1;
  if (S_ISSOCK(status.st_mode)) return socket_open(name);
  const int device = open(name, O_RDWR);
  const uint8_t mode = SPI_MODE_0;
  return device >= 0 && ioctl(device, SPI_IOC_WR_MODE, &mode) == 0 ? device : -1;
}

static int transfer(int device, const uint8_t* out, uint8_t* in, size_t count) {
  if (is_socket(device)) {
    const uint32_t length = (uint32_t)count;
    return send(device, &length, sizeof length, MSG_NOSIGNAL) == (ssize_t)sizeof length &&
           send(device, out, count, MSG_NOSIGNAL) == (ssize_t)count &&
           recv(device, in, count, MSG_WAITALL) == (ssize_t)count;
  }
  const struct spi_ioc_transfer message = {.tx_buf = (uintptr_t)out,
                                           .rx_buf = (uintptr_t)in,
                                           .len = (uint32_t)count,
                                           .speed_hz = BITS_PER_SECOND,
                                           .bits_per_word = 8};
  return ioctl(device, SPI_IOC_MESSAGE(1), &message) == (int)count;
}

void spi_transfer(int device, const uint8_t* out, uint8_t* in, size_t count) {
  if (transfer(device, out, in, count)) return;
  perror("SPI");
  exit(3);
}
