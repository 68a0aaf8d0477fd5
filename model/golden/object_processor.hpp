// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/objects/object_processor.vhd: one processor of the chain, word by word, without timing.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "golden/object_edges.hpp"
#include "golden/object_merge.hpp"
#include "golden/raster_interpolator.hpp"
#include "golden/token_rasterizer.hpp"

namespace halfway::golden {

template <class Preset>
class ObjectProcessor {
 public:
  using Word = ObjectWord<Preset>;

  ObjectProcessor(const ProcessorsConfig& config, int subpixels)
      : config_(config),
        layout_(config),
        side_(side_of(subpixels)),
        edges_(side_),
        planes_(static_cast<std::size_t>(layout_.planes())),
        merge_(subpixels) {}

  /// Takes a word, and calls out(word) for each word that leaves.
  template <class Out>
  void take(const Word& in, Out&& out) {
    if (in.is_part() && (taking_ || !(stored_ && edges_.more()))) {
      take_part(in);
      return;
    }
    for (;;) {
      const auto choice = merge_.choose(in, has_own_ ? &own_ : nullptr);
      merge_.step(in, choice);
      if (choice.output) {
        const Word& chosen = choice.own ? own_ : in;
        if (chosen.is_element() && chosen.mask != choice.mask) {
          Word left = chosen;
          left.mask = choice.mask;
          out(left);
        } else {
          out(chosen);
        }
      }
      if (!choice.own) break;
    }
    if (in.is_head()) step(in.is_item(Command::new_scanline));
    if (in.kind == ObjectKind::strip_end) edges_.reset();
  }

 private:
  using PlaneAt = typename Preset::plane_header_at;
  using WalkAt = Exact::init_header_at;
  using Plane = RasterInterpolator<Preset::c_plane_sum_bits>;
  using Depth = RasterInterpolator<Exact::c_depth_sum_bits>;

  void take_part(const Word& in) {
    if (!taking_) store_.clear();
    store_.push_back(static_cast<std::uint32_t>(in.part));
    store_.push_back(static_cast<std::uint32_t>(in.part >> 32));
    stored_ = in.kind == ObjectKind::last_part;
    taking_ = !stored_;
    if (stored_) load();
  }

  void load() {
    element_ = {};
    element_.token.decode_request(store_);
    const auto walk = walk_of<Preset>(store_);
    element_.token.triangle = static_cast<std::uint32_t>(get_bits(walk, WalkAt::triangle));
    edges_.load(walk);
    load(depth_, walk, 0, WalkAt::z, WalkAt::z_dx, WalkAt::z_de0, WalkAt::z_de1);
    if (element_.token.command == Command::shadow) return;
    element_.token.command = Command::new_object;
    element_.token.decode_material(config_, store_);
    for (int p = 0; p < layout_.planes(); ++p)
      load(planes_[static_cast<std::size_t>(p)], store_, layout_.plane_low(p), PlaneAt::value, PlaneAt::dx,
           PlaneAt::de0, PlaneAt::de1);
  }

  // de1 has the upper bits of dx and de0.
  template <int W>
  static void load(RasterInterpolator<W>& interpolator, std::span<const std::uint32_t> words, int low,
                   const Field& value, const Field& dx, const Field& de0, const Field& de1) {
    using Interpolator = RasterInterpolator<W>;
    const std::uint64_t upper = get_bits(words, de1, low);
    const auto change = [&](const Field& field, std::uint64_t above) {
      return Interpolator::Change::from_bits(get_bits(words, field, low) | above << W);
    };
    interpolator.load(Interpolator::Value::from_bits(get_bits(words, value, low)), change(dx, upper & 7),
                      change(de0, upper >> 3 & 7));
  }

  // Goes to the next pixel, or to the first one of the next line.
  void step(bool line) {
    if (line) stored_ = stored_ && edges_.more();
    has_own_ = false;
    if (!stored_) return;
    const auto step_one = [&](auto& stepped) { line ? stepped.line_step() : stepped.pixel_step(); };
    step_one(edges_);
    step_one(depth_);
    const bool shadow = element_.is_shadow();
    if (!shadow)
      for (Plane& plane : planes_) step_one(plane);
    const std::uint32_t mask = edges_.mask();
    has_own_ = shadow ? (mask >> (side_ * (side_ / 2) + side_ / 2) & 1) != 0 : mask != 0;
    if (!has_own_) return;
    set_element(mask);
    own_ = element_;
  }

  // The element at the pixel's centre if the subpixels around it are covered, else at the first covered one.
  void set_element(std::uint32_t mask) {
    const std::uint32_t around = side_ == 4 ? 0x0660 : side_ == 2 ? 0xF : 1;
    const bool centre = (mask & around) == around;
    const int first = std::countr_zero(mask);
    const auto value = [&](const auto& interpolator) {
      return centre ? interpolator.value() : interpolator.value(side_, first / side_, first % side_);
    };
    auto& token = element_.token;
    token.z = static_cast<std::uint32_t>(
        low_bits(value(depth_).bits() >> Exact::c_depth_sum_fraction_bits, Preset::c_depth_bits));
    if (element_.is_shadow()) return;
    element_.mask = mask;
    // The upper bits of a plane's value. Setup has added half a step, so truncation rounds.
    const auto plane = [&](int number) {
      return value(planes_[static_cast<std::size_t>(number)]).value() >>
             (Preset::c_plane_sum_bits - Preset::c_vector_bits);
    };
    for (int i = 0; i < c_axes; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      token.normal[axis] = plane(i);
      if (layout_.has_place()) token.place[axis] = plane(c_axes + i);
    }
    if (layout_.has_distance()) token.distance = plane(2 * c_axes);
  }

  ProcessorsConfig config_;
  ProcessorsLayout<Preset> layout_;
  int side_;
  std::vector<std::uint32_t> store_;  ///< the host's vector
  bool stored_ = false, taking_ = false;
  ObjectEdges edges_;
  Depth depth_;
  std::vector<Plane> planes_;  // N, P or the view ray, 1/w
  Word element_;               // of the store
  Word own_;                   // of the last head; the store may already hold another triangle
  bool has_own_ = false;
  ObjectMerge<Preset> merge_;
};

}  // namespace halfway::golden
