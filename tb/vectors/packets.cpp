// SPDX-License-Identifier: Apache-2.0
// Files of words_to_fragments for each hardware, frame after frame. packets: the last word of a packet, and
// the word. fragments: the transfers at the output: last one of the frame, cause of the fault, whether it has
// a fragment, and the data. A frame with a fault has only its last transfer.
#include <fmt/format.h>

#include "sim/driver/frame_driver.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/files/vector_file.hpp"
#include "sim/os/must.hpp"
#include "vectors/entities.hpp"
#include "vectors/packet_frames.hpp"

namespace halfway::vectors {
namespace {

// As in rtl/axi/axi_pkg.vhd.
enum class Cause { none, wrong_kind, wrong_length, shader_fault, limit_reached };

// tb/rtl/tb_shaders_pkg.vhd has the same list, with the generics.
const PacketHardware c_hardware[] = {
    {"quadratic", {.shader = Shader::quadratic}},
    {"spherical", {.shader = Shader::spherical, .preset = Preset::published}},
    {"no_light", {.shader = Shader::spherical}, false},
    {"processors", {.shader = Shader::processors}},
    {"objects", {.shader = Shader::processors, .preset = Preset::published, .objects = 4}, true, true},
};

std::vector<PacketWords> packets_of(const PacketWords& words) {
  std::vector<PacketWords> packets;
  for (std::size_t at = 0; at < words.size(); at += packets.back().size()) {
    const std::size_t size = (words[at] >> 16) / 2 * 2 + 2;
    packets.emplace_back(words.begin() + static_cast<std::ptrdiff_t>(at),
                         words.begin() + static_cast<std::ptrdiff_t>(at + size));
  }
  return packets;
}

Scene scene_for(const PacketHardware& hardware) {
  Scene scene = must(load_scene(HALFWAY_SOURCE_DIR "/sim/report/timing.toml", {}));
  scene.shadows = hardware.shadows;
  if (!hardware.lights) scene.directional.clear();
  return scene;
}

class Frames {
 public:
  Frames(const PacketHardware& hardware, FrameSize size) : frame_(hardware, size) {
    PacketWriter::append_end(end_);
  }

  void good() {
    for (const PacketWords& packet : frame_.packets()) send(packet);
    send(end_);
    for (const Fragment& f : frame_.golden()) transfer(&f, &f == &frame_.golden().back(), Cause::none);
  }
  void empty() {
    send(end_);
    transfer(nullptr, true, Cause::none);
  }
  // A frame of `count` good packets and a bad one. The packets behind it are dropped.
  void bad(std::size_t count, const PacketWords& packet, Cause cause) {
    for (std::size_t i = 0; i < count; ++i) send(frame_.packets()[i]);
    send(packet);
    for (std::size_t i = count; i < std::min(count + 3, frame_.packets().size()); ++i)
      send(frame_.packets()[i]);
    send(end_);
    transfer(nullptr, true, cause);
  }
  // Frames with a packet that is wrong in one place.
  void all_bad() {
    const std::size_t at = frame_.packets().size() / 2;
    const PacketWords good_packet = frame_.packets()[at];
    PacketWords packet = good_packet;
    packet[0] ^= 8U;
    bad(at, packet, Cause::wrong_kind);
    good();
    bad(0, packet, Cause::wrong_kind);
    packet = good_packet;
    packet[0] += 2U << 16;
    packet.resize(packet.size() + 2);
    bad(at, packet, Cause::wrong_length);
    packet = good_packet;
    packet.resize(packet.size() - 2);
    bad(at, packet, Cause::wrong_length);
    good();
    bad(at, {good_packet[0]}, Cause::wrong_length);
    bad(at, {good_packet[0] % (1U << 16) | 1U << 16, 0}, Cause::wrong_length);
    bad(1, {static_cast<std::uint32_t>(PacketKind::end) | 1U << 16, 0}, Cause::wrong_length);
  }
  // A frame that ends before its last line records.
  void without_records() {
    send(frame_.packets()[0]);
    send(end_);
    transfer(nullptr, true, Cause::limit_reached);
  }
  // An unknown command.
  void with_shader_fault() {
    PacketWords packet = frame_.packets()[0];
    packet[1] &= ~7U;
    bad(1, packet, Cause::shader_fault);
  }

  bool has_records() const {
    return frame_.key().shader == Shader::spherical && frame_.key().spherical.records();
  }
  bool has_commands() const { return frame_.key().shader == Shader::processors; }
  void write(const Folder& folder, const char* name) const {
    words_.write(folder / fmt::format("{}_words.txt", name));
    fragments_.write(folder / fmt::format("{}_fragments.txt", name));
  }

 private:
  void send(const PacketWords& packet) {
    for (std::size_t i = 0; i < packet.size(); ++i)
      words_.flag(i + 1 == packet.size()).word(packet[i], 32).end_vector();
  }
  void transfer(const Fragment* f, bool last, Cause cause) {
    fragments_.flag(last).word(static_cast<std::uint64_t>(cause), 3).flag(f != nullptr);
    put_fragment(fragments_, f != nullptr ? *f : Fragment{}).end_vector();
  }

  PacketFrame frame_;
  PacketWords end_;
  VectorFile words_, fragments_;
};

template <int divisor>
void write_words_to_fragments(const Folder& folder) {
  for (const PacketHardware& hardware : c_hardware) {
    Frames frames(hardware, {16, 12 / divisor});
    frames.good();
    frames.empty();
    frames.all_bad();
    if (frames.has_records()) frames.without_records();
    if (frames.has_commands()) frames.with_shader_fault();
    frames.good();
    frames.write(folder, hardware.name);
  }
}

}  // namespace

VectorFile& put_fragment(VectorFile& file, const Fragment& f) {
  const std::uint32_t words[] = {f.x | std::uint32_t{f.y} << 16, f.z, f.triangle,
                                 f.red | std::uint32_t{f.green} << 8 | std::uint32_t{f.blue} << 16};
  return file.words_of(words, 128);
}

std::span<const PacketHardware> packet_hardware() {
  return c_hardware;
}

PacketFrame::PacketFrame(const PacketHardware& hardware, FrameSize size) {
  const Scene scene = scene_for(hardware);
  key_ = must(plan_scene(scene, hardware.plan)).key;
  FrameStream stream = must(whole_stream(scene, size, key_));
  PacketWords words;
  PacketWriter(key_).append(words, stream.words);
  packets_ = packets_of(words);
  golden_ = std::move(stream.golden);
}

std::vector<Entity> packets_entities() {
  return {{"words_to_fragments", write_words_to_fragments<1>},
          {"short/words_to_fragments", write_words_to_fragments<c_short>}};
}

}  // namespace halfway::vectors
