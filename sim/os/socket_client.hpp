// SPDX-License-Identifier: Apache-2.0
// A program that uses this one as a device, through a Unix socket.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "sim/os/descriptor.hpp"

namespace halfway {

class SocketClient {
 public:
  /// Waits at the socket until one program connects. The socket's name exists only meanwhile. Throws Failure.
  explicit SocketClient(const std::filesystem::path& socket);

  /// Return false at the end of the connection.
  bool read(void* bytes, std::size_t count);
  bool write(std::span<const std::uint8_t> bytes);

 private:
  Descriptor client_;
};

}  // namespace halfway
