// SPDX-License-Identifier: Apache-2.0
// The tokens between shading processors as separate fields. Flat words are used only at the interfaces.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "golden/vector_shift.hpp"
#include "golden/words.hpp"
#include "words/processors_layout.hpp"

namespace halfway::golden {

/// Unsigned words of one format: red, green, blue; or one channel.
using Channels = std::array<std::uint32_t, 3>;

/// A processor's registers for its light, in view space. The formats are those of light_axes and
/// light_colour.
struct ShadingLight {
  bool positional = false, spot = false;
  std::uint32_t shift = 0;  ///< of the surfaces' places, exact
  std::int64_t outer = 0;
  std::uint32_t slope = 0;
  int around_eye = 0;  ///< number of shadow volumes around the eye
  Axes place{};        ///< or direction to the light
  Axes axis{};
  Axes half{};  ///< published
  Channels intensity{};
};

/// The layout is in processors_pkg. Of a load's flat words only the light is used, of a head's and a shadow
/// polygon's only the pixel.
template <class Preset>
struct ShadingToken {
  Command command = Command::new_object;
  std::uint32_t light_number = 0;  ///< of the light to load or of the light that casts the shadow
  bool opens = false, normalize = false;
  std::uint32_t triangle = 0, y = 0, x = 0, z = 0;
  Axes normal{};  ///< a vector before the ambient processor, a direction after it
  Axes place{};   ///< P, or the view ray
  std::int64_t distance = 0;
  Axes view{};
  std::uint32_t exponent = 0;
  Channels ambient{}, diffuse{}, specular{};  ///< k of the material
  Channels radiance{};                        ///< I so far
  ShadingLight light{};

  /// Colour with which the ambient processor starts: half a step if it has a fraction, so that truncation
  /// rounds.
  static constexpr std::uint32_t c_first_radiance =
      Preset::c_radiance_fraction_bits == 0 ? 0 : 1U << (Preset::c_radiance_fraction_bits - 1);

  bool is_object() const { return command == Command::new_object; }
  bool is_define() const { return command == Command::define || command == Command::redefine; }
  /// The token is for the light with its number.
  bool is_for_light() const {
    return is_define() || command == Command::remove || command == Command::shadow;
  }
  /// The colour of new_frame is the background of the filter.
  bool has_light() const { return is_define() || command == Command::new_frame; }

  bool has_pixel() const { return is_object() || is_head(command) || command == Command::shadow; }

  static ShadingToken decode(const ProcessorsConfig& config, std::span<const std::uint32_t> words) {
    const ProcessorsLayout<Preset> layout(config);
    ShadingToken token;
    const auto word = [&](const Field& field) { return static_cast<std::uint32_t>(get_bits(words, field)); };
    token.command = static_cast<Command>(word(At::command));
    token.light_number = word(At::light);
    token.opens = word(At::opens) != 0;
    token.normalize = word(At::normalize) != 0;
    if (token.has_light()) token.light = decode_light(config, words);
    if (!token.has_pixel()) return token;
    token.triangle = word(At::triangle);
    token.y = word(At::y);
    token.x = word(At::x);
    token.z = word(At::z);
    if (!token.is_object()) return token;
    visit(token, config, layout, [&](auto& value, int low, int bits) { get_word(words, value, low, bits); });
    return token;
  }

  /// Writes this token's fields and keeps all other bits.
  void encode(const ProcessorsConfig& config, std::span<std::uint32_t> words) const {
    const ProcessorsLayout<Preset> layout(config);
    set_bits(words, At::command, static_cast<std::uint32_t>(command));
    set_bits(words, At::light, light_number);
    set_bits(words, At::opens, opens);
    set_bits(words, At::normalize, normalize);
    if (has_light()) encode_light(config, light, words);
    if (!has_pixel()) return;
    set_bits(words, At::triangle, triangle);
    set_bits(words, At::y, y);
    set_bits(words, At::x, x);
    set_bits(words, At::z, z);
    if (!is_object()) return;
    visit(*this, config, layout, [&](const auto& value, int low, int bits) {
      set_bits(words, word_at(low, bits), static_cast<std::uint64_t>(value));
    });
  }

  /// Takes the request of a host's vector that draws: command, light and flags.
  void decode_request(std::span<const std::uint32_t> vector) {
    using Request = typename Preset::request_header_at;
    command = static_cast<Command>(get_bits(vector, Request::command));
    light_number = static_cast<std::uint32_t>(get_bits(vector, Request::light));
    opens = get_bits(vector, Request::opens) != 0;
    normalize = get_bits(vector, Request::normalize) != 0;
  }
  /// Takes the material of a host's vector.
  void decode_material(const ProcessorsConfig& config, std::span<const std::uint32_t> vector) {
    const ProcessorsLayout<Preset> layout(config);
    visit_material(*this, config, layout, layout.init_material_low(),
                   [&](auto& value, int low, int bits) { get_word(vector, value, low, bits); });
  }

  /// The light defined by a host's vector or by a token.
  static ShadingLight decode_light(const ProcessorsConfig& config, std::span<const std::uint32_t> words) {
    ShadingLight light;
    for_each_light_word(config, light,
                        [&](auto& value, int low, int bits) { get_word(words, value, low, bits); });
    return light;
  }
  static void encode_light(const ProcessorsConfig& config, const ShadingLight& light,
                           std::span<std::uint32_t> words) {
    for_each_light_word(config, light, [&](const auto& value, int low, int bits) {
      set_bits(words, word_at(low, bits), static_cast<std::uint64_t>(value));
    });
  }

 private:
  using At = typename Preset::pixel_header_at;
  static constexpr bool c_exact = ProcessorsLayout<Preset>::c_exact;

  static constexpr Field word_at(int low, int bits) { return {"", low, bits, false, 0}; }

  template <class T>
  static void get_word(std::span<const std::uint32_t> words, T& value, int low, int bits) {
    const std::uint64_t raw = get_bits(words, word_at(low, bits));
    if constexpr (std::is_signed_v<T>)
      value = static_cast<T>(static_cast<std::int64_t>(raw << (64 - bits)) >> (64 - bits));
    else
      value = static_cast<T>(raw);
  }

  // Calls use(word, lowest bit, bits) for every word of an object after its header.
  template <class Self, class Use>
  static void visit(Self& self, const ProcessorsConfig& config, const ProcessorsLayout<Preset>& layout,
                    Use&& use) {
    for (int i = 0; i < c_axes; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      use(self.normal[axis], layout.normal_low(i), Preset::c_vector_bits);
      if (layout.has_place()) use(self.place[axis], layout.place_low(i), Preset::c_vector_bits);
      if (layout.has_view()) use(self.view[axis], layout.view_low(i), Preset::c_direction_bits);
    }
    if (layout.has_distance()) use(self.distance, layout.distance_low(), Preset::c_vector_bits);
    visit_material(self, config, layout, layout.material_low(), use);
    for (int i = 0; i < config.channels; ++i)
      use(self.radiance[static_cast<std::size_t>(i)], layout.radiance_low(i), Preset::c_radiance_bits);
  }
  template <class Self, class Use>
  static void visit_material(Self& self, const ProcessorsConfig& config,
                             const ProcessorsLayout<Preset>& layout, int material, Use&& use) {
    if (config.specular) use(self.exponent, material + layout.exponent_low(), Preset::c_exponent_bits);
    for (int i = 0; i < config.channels; ++i) {
      const auto channel = static_cast<std::size_t>(i);
      use(self.ambient[channel], material + layout.ambient_low(i), Preset::c_coefficient_bits);
      if (config.diffuse)
        use(self.diffuse[channel], material + layout.diffuse_low(i), Preset::c_coefficient_bits);
      if (config.specular)
        use(self.specular[channel], material + layout.specular_low(i), Preset::c_coefficient_bits);
    }
  }

  template <class Light, class Use>
  static void for_each_light_word(const ProcessorsConfig& config, Light& light, Use&& use) {
    using Layout = ProcessorsLayout<Preset>;
    using Header = typename Preset::light_axes_header_at;
    using Axis = typename Preset::light_axes_channel_at;
    const auto at = [&](auto& value, const Field& field, int low) {
      use(value, low + field.low, field.bits);
    };
    constexpr int c_low = Layout::light_axes_low();
    at(light.positional, Header::positional, c_low);
    at(light.spot, Header::spot, c_low);
    if constexpr (c_exact) at(light.shift, Header::shift, c_low);
    at(light.outer, Header::outer, c_low);
    at(light.slope, Header::slope, c_low);
    at(light.around_eye, Header::around_eye, c_low);
    for (int i = 0; i < c_axes; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      at(light.place[axis], Axis::place, Layout::light_axis_low(i));
      at(light.axis[axis], Axis::axis, Layout::light_axis_low(i));
      if constexpr (!c_exact) at(light.half[axis], Axis::half, Layout::light_axis_low(i));
    }
    for (int i = 0; i < config.channels; ++i)
      at(light.intensity[static_cast<std::size_t>(i)], Preset::light_colour_channel_at::intensity,
         Layout::light_colour_low(i));
  }
};

}  // namespace halfway::golden
