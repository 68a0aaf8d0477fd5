// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/core/core_server.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "sim/os/must.hpp"
#include "sim/os/socket_client.hpp"

namespace halfway::core {
namespace {

constexpr std::size_t c_shared_bytes = 1 << 24;

/// A file in memory, which another program can map, too.
class SharedMemory {
 public:
  explicit SharedMemory(std::filesystem::path file)
      : file_(std::move(file)),
        descriptor_(::open(file_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)) {
    if (descriptor_.get() < 0 || ::ftruncate(descriptor_.get(), c_shared_bytes) != 0) fail();
    address_ = ::mmap(nullptr, c_shared_bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_.get(), 0);
    if (address_ == MAP_FAILED) fail();
  }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  ~SharedMemory() {
    ::munmap(address_, c_shared_bytes);
    ::unlink(file_.c_str());
  }
  std::span<std::uint8_t> bytes() const { return {static_cast<std::uint8_t*>(address_), c_shared_bytes}; }

 private:
  [[noreturn]] void fail() const {
    throw_tool_failed("{}: cannot share it: {}", file_.string(), std::strerror(errno));
  }
  std::filesystem::path file_;
  Descriptor descriptor_;
  void* address_ = nullptr;
};

}  // namespace

CoreServerReport serve_core(const CoreKey& key, MemoryTiming timing, const std::filesystem::path& socket,
                            const SimulatorFolders& folders) {
  const SharedMemory memory(socket.string() + ".memory");
  CoreSimulator core(key, timing, folders);
  core.memory().connect(memory.bytes(), c_memory_address);
  SocketClient client(socket);
  CoreServerReport report;
  enum Kind : std::uint32_t { read, write, wait };
  for (std::array<std::uint32_t, 3> request; client.read(&request, sizeof request); ++report.accesses) {
    const auto [kind, address, value] = request;
    CoreSimulator::Answer answer{};
    if (kind == read)
      answer = core.read(address);
    else if (kind == write)
      answer.response = core.write(address, value);
    else if (kind == wait)
      core.wait(c_most_frame_clocks);
    else
      throw_bad_input("{}: a request of kind {}", socket.string(), kind);
    const std::array<std::uint32_t, 2> words = {answer.value, answer.response};
    if (!client.write({reinterpret_cast<const std::uint8_t*>(words.data()), sizeof words})) break;
  }
  report.clocks = core.clocks();
  return report;
}

}  // namespace halfway::core
