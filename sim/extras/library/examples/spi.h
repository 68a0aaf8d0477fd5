/* SPDX-License-Identifier: Apache-2.0
 * One packet at a time over Linux's spidev, or to the simulated board: `halfway board-sim --serve SOCKET`. */
#ifndef SPI_H
#define SPI_H

#include <stddef.h>
#include <stdint.h>

/* Connects to the socket of a simulation. Returns as spi_open. */
int socket_open(const char* name);

/* Opens a device, /dev/spidevB.C, or a socket. Returns a descriptor; -1: see errno. */
int spi_open(const char* name);

/* Sends and receives the bytes of one packet, while select is low. Ends the program with a message if that
 * fails. */
void spi_transfer(int device, const uint8_t* out, uint8_t* in, size_t count);

#endif
