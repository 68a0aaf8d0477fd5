// SPDX-License-Identifier: Apache-2.0
#include "sim/os/socket_client.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sim/os/must.hpp"

namespace halfway {
namespace {

[[noreturn]] void fail(const std::filesystem::path& socket, const char* what) {
  throw_tool_failed("{}: {}: {}", socket.string(), what, std::strerror(errno));
}

}  // namespace

SocketClient::SocketClient(const std::filesystem::path& socket) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket.string().size() >= sizeof address.sun_path)
    throw_bad_input("{}: too long for the name of a socket; use a shorter path", socket.string());
  std::strcpy(address.sun_path, socket.c_str());
  const Descriptor listener(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  ::unlink(socket.c_str());
  if (listener.get() < 0 ||
      ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener.get(), 1) != 0)
    fail(socket, "cannot listen");
  client_.reset(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC));
  ::unlink(socket.c_str());
  if (client_.get() < 0) fail(socket, "no client");
}

bool SocketClient::read(void* bytes, std::size_t count) {
  return count == 0 || ::recv(client_.get(), bytes, count, MSG_WAITALL) == static_cast<ssize_t>(count);
}

bool SocketClient::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace halfway
