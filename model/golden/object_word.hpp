// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/objects/objects_pkg.vhd: the words of the chain of object processors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>

#include "golden/shading_token.hpp"
#include "words/object_limits.hpp"

namespace halfway::golden {

enum class ObjectKind { item = 0, part = 1, last_part = 2, strip_end = 3 };

inline constexpr int c_part_bits = 64;

using words::has_filter, words::side_of, words::most_columns, words::most_lines;

/// Bits of an item. It is laid out as a token without its colour.
template <class Preset>
constexpr int item_bits(const ProcessorsConfig& config) {
  const ProcessorsLayout<Preset> layout(config);
  return std::max({c_part_bits, layout.light_colour_low(config.channels), layout.radiance_low(0)});
}

/// Number of parts of a host's vector: of one with an object, or of one with a shadow polygon.
template <class Preset>
constexpr int parts_of(const ProcessorsConfig& config, bool shadow) {
  const ProcessorsLayout<Preset> layout(config);
  return ((shadow ? layout.plane_low(0) : layout.init_bits()) + c_part_bits - 1) / c_part_bits;
}

template <class Preset>
struct ObjectWord {
  ObjectKind kind = ObjectKind::item;
  std::uint32_t mask = 0;      ///< subpixels of an object, bit side * row + column
  ShadingToken<Preset> token;  ///< of an item: a head, an element or a load
  std::uint64_t part = 0;

  bool is_item(Command command) const { return kind == ObjectKind::item && token.command == command; }
  bool is_shadow() const { return is_item(Command::shadow); }
  bool is_element() const { return is_shadow() || is_item(Command::new_object); }
  bool is_head() const { return kind == ObjectKind::item && words::is_head(token.command); }
  bool is_part() const { return kind == ObjectKind::part || kind == ObjectKind::last_part; }
  /// Position of an element in its list.
  auto key() const { return std::tuple(token.z, is_shadow(), token.triangle); }
};

}  // namespace halfway::golden
