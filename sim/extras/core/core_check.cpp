// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/core/core_check.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "golden_run/packets.hpp"
#include "sim/extras/library/halfway_core.h"
#include "sim/extras/library/halfway_core_registers.h"
#include "sim/extras/library/objects.hpp"
#include "sim/files/image.hpp"
#include "sim/os/command_line.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/socket_client.hpp"

namespace halfway::core {
namespace {

using golden::FramePlace;

/// Before and after the memory of the driver.
constexpr std::size_t c_margin = 4096;

/// The processor: what the driver needs.
class Host {
 public:
  Host(const CoreKey& key, MemoryTiming timing, const SimulatorFolders& folders)
      : core_(key, timing, folders) {}

  const halfway_core_access& access() const { return access_; }
  CoreSimulator& core() { return core_; }

  /// Makes a memory with noise in it. Its margins do not belong to the driver.
  halfway_core_memory make_memory(std::size_t size) {
    std::mt19937 random(1);
    memory_.resize(size + 2 * c_margin);
    for (std::uint8_t& byte : memory_) byte = static_cast<std::uint8_t>(random());
    core_.memory().connect(memory_, c_memory_address);
    return {memory_.data() + c_margin, c_memory_address + c_margin, size};
  }
  const std::vector<std::uint8_t>& memory() const { return memory_; }
  /// The memory when the core was told about the last command.
  const std::vector<std::uint8_t>& before() const { return before_; }
  std::uint32_t word(std::uint32_t address) const {
    std::uint32_t word = 0;
    for (std::uint32_t i = 0; i < 4; ++i)
      word |= std::uint32_t{before_[address - c_memory_address + i]} << (8 * i);
    return word;
  }
  std::uint32_t read(std::uint32_t offset) {
    return guarded([&] { return core_.read(offset).value; });
  }

  /// Throws Failure if a function of the driver has failed. The simulation's own error comes first.
  void must_be(bool done, const halfway_error& error) const {
    if (done) return;
    throw Failure{error_ ? *error_ : Error{static_cast<ExitCode>(error.code), error.text}};
  }

 private:
  void write(std::uint32_t offset, std::uint32_t value) {
    if (offset == HALFWAY_CORE_RING_HEAD) before_ = memory_;
    guarded([&] { return core_.write(offset, value); });
  }
  void wait() {
    guarded([&] {
      core_.wait(c_most_frame_clocks);
      return 0;
    });
  }
  /// Keeps the first error, because the library makes another one of it. After it the core stands still.
  template <class Work>
  auto guarded(const Work& work) -> decltype(work()) {
    if (error_) return {};
    try {
      return work();
    } catch (const Failure& failure) {
      error_ = failure.error;
      throw;
    }
  }

  CoreSimulator core_;
  std::vector<std::uint8_t> memory_, before_;
  std::optional<Error> error_;
  halfway_core_access access_ = {
      .read = [](void* host, std::uint32_t offset) { return static_cast<Host*>(host)->read(offset); },
      .write = [](void* host, std::uint32_t offset,
                  std::uint32_t value) { static_cast<Host*>(host)->write(offset, value); },
      .wait = [](void* host) { static_cast<Host*>(host)->wait(); },
      .context = this};
};

/// Draws the frame into the memory before() and compares. Returns the number of kept fragments.
std::uint64_t compare(Host& host, const FrameStream& stream, FrameSize size, PixelFormat format,
                      std::span<const std::uint8_t, 3> background) {
  const std::uint32_t ring = host.read(HALFWAY_CORE_RING_BASE);
  const auto word = [&](unsigned number) { return host.word(ring + 4 * number); };
  const std::uint32_t strides = word(HALFWAY_CORE_COMMAND_COLOUR_STRIDE_WORD);
  const FramePlace place{.colour_base = host.core().picture(),
                         .colour_stride = strides & HALFWAY_CORE_COMMAND_COLOUR_STRIDE_MASK,
                         .depth_base = word(HALFWAY_CORE_COMMAND_DEPTH_BASE_WORD),
                         .depth_stride = strides >> HALFWAY_CORE_COMMAND_DEPTH_STRIDE_SHIFT,
                         .width = size.width,
                         .height = size.height,
                         .right = size.width,
                         .bottom = size.height};
  std::vector<std::uint8_t> expected = host.before();
  golden::FrameMemory golden(format, expected, c_memory_address);
  golden.clear(place, background[0], background[1], background[2]);
  std::uint64_t kept = 0;
  for (const Fragment& fragment : stream.golden) kept += golden.draw(place, fragment) ? 1 : 0;
  std::size_t count = 0, first = 0;
  for (std::size_t i = expected.size(); i-- > 0;)
    if (host.memory()[i] != expected[i]) ++count, first = i;
  if (count > 0)
    throw Failure{
        {ExitCode::differs,
         fmt::format("{} bytes of the memory differ; the first, {:08x}, is {:02x} instead of {:02x}; "
                     "the picture is at {:08x}, depths are at {:08x}",
                     count, c_memory_address + first, host.memory()[first], expected[first],
                     place.colour_base, place.depth_base)}};
  return kept;
}

/// The number of packets of kind 1 that the command draws.
std::uint64_t triangle_packets(Host& host) {
  const std::uint32_t ring = host.read(HALFWAY_CORE_RING_BASE);
  std::uint32_t at = host.word(ring + 4 * HALFWAY_CORE_COMMAND_PACKETS_WORD);
  const std::uint32_t end = at + 4 * host.word(ring + 4 * HALFWAY_CORE_COMMAND_PACKET_WORDS_WORD);
  std::uint64_t triangles = 0;
  while (at < end) {
    const std::uint32_t header = host.word(at);
    if (static_cast<PacketKind>(header & 0xFFFF) == PacketKind::triangle) ++triangles;
    // A whole number of pairs of words.
    at += 8 * ((header >> 16) / 2 + 1);
  }
  return triangles;
}

void check_counters(const CoreFigures& figures, const CoreFigures& expected, std::uint64_t clocks) {
  const auto differ = [](const std::string& what) { throw Failure{{ExitCode::differs, what}}; };
  if (figures.triangles != expected.triangles || figures.fragments != expected.fragments ||
      figures.pixels != expected.pixels)
    differ(fmt::format("the counters have {} triangles, {} fragments and {} pixels instead of {}, {} and {}",
                       figures.triangles, figures.fragments, figures.pixels, expected.triangles,
                       expected.fragments, expected.pixels));
  // A busy clock has at most one word each way, and one fragment that is taken or waits.
  const std::uint64_t least =
      std::max({figures.words_read, figures.words_written, figures.fragments + figures.stalled_clocks});
  if (figures.clocks < least || figures.clocks > clocks)
    differ(fmt::format("busy_clocks is {} instead of {} to {}", figures.clocks, least, clocks));
}

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

CoreFigures check_core(const Scene& scene, const CoreKey& key, const CoreCheckOptions& options,
                       const SimulatorFolders& folders) {
  FrameStream stream = must(whole_stream(scene, options.size, key.shader, options.frame));
  for (const std::string& note : stream.notes) cli::say(fmt::format("{}: {}", scene.name, note));
  const halfway_vectors vectors{key.shader, stream.init_bits, std::move(stream.words)};
  const halfway_core_layout layout{.width = options.size.width,
                                   .height = options.size.height,
                                   .packet_words = halfway_packet_words(&vectors)};
  const halfway_core_frame frame{.clear_colour = {to_byte(scene.background.r), to_byte(scene.background.g),
                                                  to_byte(scene.background.b)}};

  // Draw it.
  Host host(key, options.timing, folders);
  halfway_error error{};
  const std::size_t bytes = halfway_core_bytes(&host.access(), &layout, &error);
  host.must_be(bytes != 0, error);
  const halfway_core_memory memory = host.make_memory(bytes);
  const std::unique_ptr<halfway_core, decltype(&halfway_close_core)> core(
      halfway_open_core(&host.access(), &memory, &layout, &error), halfway_close_core);
  host.must_be(core != nullptr, error);
  host.must_be(halfway_queue_frame(core.get(), &vectors, &frame, &error) == HALFWAY_OK, error);
  host.must_be(halfway_wait_core(core.get(), &error) == HALFWAY_OK, error);

  // Show and compare it.
  Frame picture(options.size);
  host.must_be(halfway_read_picture(core.get(), picture.rgb.data(), &error) == HALFWAY_OK, error);
  must(make_folders(options.picture.parent_path()));
  must(write_png(options.picture, picture));
  const std::uint64_t kept = compare(host, stream, options.size, key.format, frame.clear_colour);
  const CoreFigures figures{.triangles = host.read(HALFWAY_CORE_TRIANGLES),
                            .fragments = host.read(HALFWAY_CORE_FRAGMENTS),
                            .pixels = host.read(HALFWAY_CORE_PIXELS),
                            .clocks = host.read(HALFWAY_CORE_BUSY_CLOCKS),
                            .stalled_clocks = host.read(HALFWAY_CORE_STALLED_CLOCKS),
                            .words_read = host.core().memory().words_read(),
                            .words_written = host.core().memory().words_written()};
  check_counters(figures,
                 {.triangles = triangle_packets(host), .fragments = stream.golden.size(), .pixels = kept},
                 host.core().clocks());
  return figures;
}

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
