// SPDX-License-Identifier: Apache-2.0
#include "specification/hard_cases/screen_drawing.hpp"

#include <fmt/format.h>

namespace halfway::stability {

std::string name_of(const Points& p, int unit_bits) {
  return fmt::format("({}, {}) ({}, {}) ({}, {}) in 1/{} pixel", p[0].x, p[0].y, p[1].x, p[1].y, p[2].x,
                     p[2].y, 1 << unit_bits);
}

std::string pixel_of(const ScreenPiece& piece, std::int64_t x, std::int64_t y) {
  return fmt::format("pixel {},{} of {}", x, y, name_of(piece.points, piece.unit_bits));
}

std::vector<Points> split(const Points& whole, int level) {
  std::vector<Points> pieces = {whole};
  for (int n = 0; n < level; ++n) {
    std::vector<Points> deeper;
    for (const Points& p : pieces) std::ranges::copy(quarters(p), std::back_inserter(deeper));
    pieces = std::move(deeper);
  }
  return pieces;
}

std::vector<Fragment> draw_pieces(Trial& trial, Preset preset, std::span<const ScreenPiece> pieces,
                                  FrameSize frame) {
  std::vector<std::uint32_t> words;
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    if (preset == Preset::exact)
      append_exact(pieces[i], i, frame, words);
    else if (in_frame(pieces[i], frame))
      append_published(pieces[i], i, words);
  return trial.draw(preset == Preset::exact ? c_exact_key : c_published_key, words);
}

void measure_colours(Trial& trial, Preset preset, std::span<const ScreenPiece> pieces, FrameSize frame) {
  for (const Fragment& f : draw_pieces(trial, preset, pieces, frame)) {
    const ScreenPiece& piece = pieces[f.triangle];
    trial.measure(preset, colour_off(f, piece), colour_bound(preset, most_steps(piece, frame)),
                  [&] { return pixel_of(piece, f.x, f.y); });
  }
}

void measure_depths(Trial& trial, Preset preset, std::span<const ScreenPiece> pieces, FrameSize frame) {
  for (const Fragment& f : draw_pieces(trial, preset, pieces, frame)) {
    const ScreenPiece& piece = pieces[f.triangle];
    trial.measure(preset, depth_off(f, piece), depth_bound(most_steps(piece, frame)),
                  [&] { return pixel_of(piece, f.x, f.y); });
  }
}

}  // namespace halfway::stability
