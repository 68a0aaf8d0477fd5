// SPDX-License-Identifier: Apache-2.0
// Rows of three spaces of sim/studies: address bits of the cosine tables (tables.toml), the spherical shader
// within one colour step (one_step.toml), and the published processors' table of 1/sqrt(x) (roots.toml).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "accuracy/row.hpp"
#include "common/to_integer.hpp"
#include "golden/formats.hpp"
#include "sim/study/highlight_error.hpp"
#include "sim/system/must.hpp"
#include "tables/cosine.hpp"

namespace halfway::accuracy {
namespace {

using page::Fields;
using study::DesignPoint;

constexpr const char* c_near = "sim/studies/sphere.toml";
constexpr const char* c_distant = "sim/studies/distant_eye.toml";
constexpr const char* c_cosine_space = "sim/studies/tables.toml";
constexpr const char* c_one_step_space = "sim/studies/one_step.toml";
constexpr const char* c_root_space = "sim/studies/roots.toml";
constexpr const char* c_none = "–";

// Bits of the table of 1/sqrt(x); 0: it has none.
int seed_bits(const DesignPoint& point) {
  if (point.method != study::Method::processors_2) return 0;
  return point.words.seed_bits.value_or(golden::Published::c_root_entry_fraction_bits);
}

// The space's points, ordered by the word lengths. If it cannot be read, one row whose test fails with the
// reason.
std::vector<Row> rows_of(const std::string& space, Row (*row)(const DesignPoint&)) {
  auto points = study::read_space(folders().source / space);
  if (!points)
    return {{.id = "space", .measure = [error = points.error()]() -> Fields { throw Failure{error}; }}};
  std::ranges::stable_sort(*points, {}, seed_bits);
  std::vector<Row> rows;
  for (const DesignPoint& point : *points) rows.push_back(row(point));
  return rows;
}

std::string cells_text(const study::HardwareFigures& figures) {
  return figures.cells ? grouped(to_integer<std::uint64_t>(std::round(study::cell_count(*figures.cells))))
                       : c_none;
}

Row cosine_row(const DesignPoint& point) {
  const TableSize size = *point.tables;
  return {.id = fmt::format("size_{}x{}", size.address_bits, size.data_bits), .measure = [=]() -> Fields {
            const tables::CosineSizes defaults;
            const tables::CosineSize own = defaults.exact.front();
            const bool is_default = own.address_bits == size.address_bits && own.data_bits == size.data_bits;
            const double table =
                255 * tables::table_error(tables::cosine_table(true, 2, size.address_bits, size.data_bits));
            const Drawn d = drawn(point, loaded(c_near));
            const study::HardwareFigures f = figures_of(point, c_near);
            return {
                {"size",
                 fmt::format("{}×{}{}", size.address_bits, size.data_bits, is_default ? " (default)" : "")},
                {"largest error of cos²", fmt::format("{:.2f}", table)},
                {"rms error of the picture", fmt::format("{:.3f}", d.error.rms)},
                {"cells", cells_text(f)},
                {"iCE40: LUTs, RAMs", f.ice40 ? fmt::format("{}, {}", f.ice40->luts, f.ice40->rams) : c_none},
                {"clock, MHz", f.mhz ? fmt::format("{:.1f}", *f.mhz) : c_none},
                {"cycles", grouped(d.cycles)},
                {"time of the frame, µs",
                 f.mhz ? fmt::format("{:.1f}", static_cast<double>(d.cycles) / *f.mhz) : c_none}};
          }};
}

Row one_step_row(const DesignPoint& point) {
  const TableSize size = *point.tables;
  const int angle_bits = point.words.angle_bits.value_or(golden::Exact::c_angle_fraction_bits);
  return {.id = fmt::format("{}_{}x{}_angle_{}", point.own_tables ? "own" : "fitted", size.address_bits,
                            size.data_bits, angle_bits),
          .measure = [=]() -> Fields {
            const study::HighlightError e = study::worst_highlight_error(size, point.own_tables, angle_bits);
            const Drawn d = drawn(point, loaded(c_near));
            const study::HardwareFigures f = figures_of(point, c_near);
            return {
                {"tables", fmt::format("{}, {}×{}", point.own_tables ? "own" : "of powers", size.address_bits,
                                       size.data_bits)},
                {"fraction bits of angles", std::to_string(angle_bits)},
                {"fit", fmt::format("{:.2f}", e.fit)},
                {"table", fmt::format("{:.2f}", e.table)},
                {"angle", fmt::format("{:.2f}", e.angle)},
                {"worst error", fmt::format("{}{:.2f}", e.total() <= 1.0 ? "**" : "", e.total()) +
                                    (e.total() <= 1.0 ? "**" : "")},
                {"at exponent", fmt::format("{:.3g}", e.exponent)},
                {"rms error of the picture", fmt::format("{:.3f}", d.error.rms)},
                {"cells", cells_text(f)},
                {"iCE40: LUTs, RAMs", f.ice40 ? fmt::format("{}, {}", f.ice40->luts, f.ice40->rams) : c_none},
                {"clock, MHz", f.mhz ? fmt::format("{:.1f}", *f.mhz) : c_none},
                {"ms per frame",
                 f.mhz ? fmt::format("{:.3f}", static_cast<double>(d.cycles) / *f.mhz / 1e3) : c_none}};
          }};
}

std::string error_text(const DesignPoint& point, const char* scene) {
  const FrameDistance error = drawn(point, loaded(scene)).error;
  return fmt::format("{:.{}f} ({})", error.rms, error.rms < 10 ? 2 : 1, error.max_lsb);
}

std::string version_text(const DesignPoint& point) {
  const int bits = seed_bits(point);
  if (bits == 0) return "I, without a table";
  const std::string text = fmt::format("II, {} × {}", 1 << (bits - tables::c_seed_cells), bits);
  return point.words.seed_bits ? text : "**" + text + "**";
}

Row root_row(const DesignPoint& point) {
  const int bits = seed_bits(point);
  return {.id = bits == 0 ? "version_1" : fmt::format("version_2_bits_{}", bits), .measure = [=]() -> Fields {
            return {{"version, entries × bits of the table", version_text(point)},
                    {"rms error, near eye", error_text(point, c_near)},
                    {"rms error, distant eye", error_text(point, c_distant)},
                    {"cells", cells_text(figures_of(point, c_near))}};
          }};
}

}  // namespace

std::vector<Row> cosine_rows() {
  return rows_of(c_cosine_space, cosine_row);
}

std::vector<Row> one_step_rows() {
  return rows_of(c_one_step_space, one_step_row);
}

std::vector<Row> root_rows() {
  return rows_of(c_root_space, root_row);
}

}  // namespace halfway::accuracy
