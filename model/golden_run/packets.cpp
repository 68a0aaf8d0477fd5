// SPDX-License-Identifier: Apache-2.0
#include "golden_run/packets.hpp"

#include "words/processors_layout.hpp"
#include "words/spherical_layout.hpp"

namespace halfway {
namespace {

template <class Preset>
int bits_of(const HardwareKey& key, PacketKind kind, int init_bits) {
  if (key.shader == Shader::spherical) {
    const words::SphericalLayout<Preset> layout(golden_config(key));
    return kind == PacketKind::record ? layout.record_bits()
                                      : layout.ambient_low(static_cast<int>(key.channels));
  }
  if (key.shader == Shader::processors) {
    const words::ProcessorsLayout<Preset> layout(processors_config(key));
    if (kind == PacketKind::load) return layout.light_colour_low(static_cast<int>(key.channels));
    if (kind == PacketKind::walk) return layout.plane_low(0);
    return layout.init_material_low() + layout.material_bits();
  }
  return init_bits;
}

template <class Preset>
PacketKind command_kind(std::span<const std::uint32_t> vector) {
  const words::Command command = words::command_of<Preset>(vector);
  if (words::is_load(command)) return PacketKind::load;
  return command == words::Command::new_object ? PacketKind::triangle : PacketKind::walk;
}

void append_packet(std::vector<std::uint32_t>& packets, PacketKind kind,
                   std::span<const std::uint32_t> words) {
  packets.push_back(static_cast<std::uint32_t>(kind) | static_cast<std::uint32_t>(words.size()) << 16);
  packets.insert(packets.end(), words.begin(), words.end());
  if (words.size() % 2 == 0) packets.push_back(0);
}

}  // namespace

PacketWriter::PacketWriter(const HardwareKey& key) : key_(key), golden_(make_golden_model(key_)) {
  const int init_bits = static_cast<int>(golden_->init_bits());
  for (const PacketKind kind :
       {PacketKind::triangle, PacketKind::record, PacketKind::load, PacketKind::walk}) {
    const int bits = key_.preset == Preset::exact ? bits_of<words::Exact>(key_, kind, init_bits)
                                                  : bits_of<words::Published>(key_, kind, init_bits);
    words_[static_cast<std::size_t>(kind)] = static_cast<std::size_t>(bits + 31) / 32;
  }
}

PacketKind PacketWriter::kind_of(std::span<const std::uint32_t> vector) {
  if (key_.shader == Shader::processors)
    return key_.preset == Preset::exact ? command_kind<words::Exact>(vector)
                                        : command_kind<words::Published>(vector);
  if (records_ > 0) {
    --records_;
    return PacketKind::record;
  }
  records_ = golden_->group(vector) - 1;
  return PacketKind::triangle;
}

void PacketWriter::append(std::vector<std::uint32_t>& packets, std::span<const std::uint32_t> init_words) {
  const std::size_t vector_words = (golden_->init_bits() + 31) / 32;
  for (; !init_words.empty(); init_words = init_words.subspan(vector_words)) {
    const auto vector = init_words.first(vector_words);
    const PacketKind kind = kind_of(vector);
    append_packet(packets, kind, vector.first(words_[static_cast<std::size_t>(kind)]));
  }
}

void PacketWriter::append_end(std::vector<std::uint32_t>& packets) {
  append_packet(packets, PacketKind::end, {});
}

}  // namespace halfway
