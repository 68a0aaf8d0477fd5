/* SPDX-License-Identifier: Apache-2.0
 * The registers and the memory of the simulated core: `halfway core-sim --serve SOCKET`. */
#ifndef CORE_PORT_H
#define CORE_PORT_H

#include <halfway_core.h>

struct core_port {
  int socket;
  halfway_core_access access; /* its functions end the program with a message if the simulation has ended */
  halfway_core_memory memory;
};

/* Returns 0 if it fails: see errno. The port must not be moved then. */
int core_port_open(struct core_port* port, const char* name);

#endif
