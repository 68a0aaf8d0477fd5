// SPDX-License-Identifier: Apache-2.0
#include "specification/hard_cases/screen_drawing.hpp"

#include <fmt/format.h>

#include "setup/quadratic_setup.hpp"
#include "words/init_vector.hpp"

namespace halfway::stability {
namespace {

// Appends the piece's vectors for the preset. `tag` is the triangle's number.
void append_exact(const ScreenPiece& piece, std::uint32_t tag, FrameSize frame,
                  std::vector<std::uint32_t>& words) {
  const Walks walks = plan_walks(piece.points, piece.unit_bits, frame);
  if (walks.empty()) return;
  const auto depth = [&](std::size_t i) {
    return fixed(piece.depth[i], words::Exact::c_depth_sum_fraction_bits);
  };
  halfway::append_exact({words, 1}, {tag,
                                     piece.points,
                                     piece.unit_bits,
                                     walks,
                                     DepthFit(piece.points, piece.unit_bits, {depth(0), depth(1), depth(2)}),
                                     {piece.sample}});
}

// The vertices of preset published: each is the pixel in which the point lies.
void append_published(const ScreenPiece& piece, std::uint32_t tag, std::vector<std::uint32_t>& words) {
  const auto vertex = [&](std::size_t i) {
    const std::int32_t half_pixel = 1 << (piece.unit_bits - 1);
    const ScreenPoint from_centre = {piece.points[i].x - half_pixel, piece.points[i].y - half_pixel};
    return half_vertex(from_centre, piece.unit_bits, piece.depth[i]);
  };
  halfway::append_published({words, 1}, tag, {vertex(0), vertex(1), vertex(2)}, {piece.sample});
}

// Measures error(fragment, piece) of each fragment against bound(steps to it).
template <class Error, class Bound>
void measure_pieces(Trial& trial, Preset preset, std::span<const ScreenPiece> pieces, FrameSize frame,
                    const Error& error, const Bound& bound) {
  for (const Fragment& f : draw_pieces(trial, preset, pieces, frame)) {
    const ScreenPiece& piece = pieces[f.triangle];
    trial.measure(preset, error(f, piece), bound(most_steps(piece, frame)),
                  [&] { return pixel_of(piece, f.x, f.y); });
  }
}

}  // namespace

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
  return trial.draw({.shader = Shader::quadratic, .preset = preset, .channels = 1}, words);
}

void measure_colours(Trial& trial, Preset preset, std::span<const ScreenPiece> pieces, FrameSize frame) {
  measure_pieces(trial, preset, pieces, frame, colour_off,
                 [&](double steps) { return colour_bound(preset, steps); });
}

void measure_depths(Trial& trial, Preset preset, std::span<const ScreenPiece> pieces, FrameSize frame) {
  const auto depth_off = [](const Fragment& f, const ScreenPiece& piece) {
    const auto at = barycentric(piece.points, centre(f.x, piece.unit_bits), centre(f.y, piece.unit_bits));
    return std::abs(f.z - linear(at.real(), {piece.depth[0], piece.depth[1], piece.depth[2]}));
  };
  measure_pieces(trial, preset, pieces, frame, depth_off, depth_bound);
}

}  // namespace halfway::stability
