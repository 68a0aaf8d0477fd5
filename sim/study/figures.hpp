// SPDX-License-Identifier: Apache-2.0
// A measurement as named values, the columns of records and tables.
#pragma once

#include "sim/study/measure.hpp"

namespace halfway::study {

/// Call `visit` with each setup counter and its name.
template <class Counts, class Visit>
void for_each_setup_figure(Counts& setup, const Visit& visit) {
  visit("screen_triangles", setup.triangles);
  visit("leaves", setup.leaves);
  visit("unresolved", setup.unresolved);
  visit("init_vectors", setup.vectors);
  visit("line_records", setup.records);
  visit("host_evaluations", setup.shaded);
}

/// Call `visit` with every value of a measurement and its column name, in the table's order.
template <class Measured, class Visit>
void for_each_figure(Measured& m, const Visit& visit) {
  visit("hardware", m.hardware);
  visit("triangles", m.triangles);
  visit("fragments", m.fragments);
  visit("cycles", m.cycles);
  visit("pixels", m.picture.pixels);
  visit("largest_error", m.picture.max_lsb);
  visit("error_99", m.picture.percentile99);
  visit("rms", m.picture.rms);
  visit("psnr_db", m.picture.psnr_db);
  visit("highlight_pixels", m.highlight.pixels);
  visit("highlight_largest_error", m.highlight.max_lsb);
  visit("highlight_error_99", m.highlight.percentile99);
  visit("highlight_rms", m.highlight.rms);
  visit("highlight_psnr_db", m.highlight.psnr_db);
  visit("perceived_pixels", m.perceived);
  visit("mach_edges", m.mach_bands.edges);
  visit("mach_rms", m.mach_bands.rms);
  visit("mach_largest", m.mach_bands.largest);
  for_each_setup_figure(m.counts, visit);
  visit("host_instructions", m.host_instructions);
}

}  // namespace halfway::study
