// SPDX-License-Identifier: Apache-2.0
#include "sim/study/design_point.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "common/to_integer.hpp"
#include "frame/frame.hpp"
#include "golden/formats.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/system/file.hpp"
#include "tables/cosine.hpp"

namespace halfway::study {
namespace {

// Ends the reading of a space; `read_space` turns it into its error.
struct BadSpace {
  Error error;
};

// What is read off one sweep: a list for each of its keys.
class Sweep {
 public:
  Sweep(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  [[noreturn]] void fail(std::string_view key, std::string_view what) const {
    const toml::node* node = table_.get(key);
    const auto line = (node == nullptr ? table_.source() : node->source()).begin.line;
    throw BadSpace{bad_input(fmt::format("{}:{}: {} {}", file_, line, key, what))};
  }

  void allow(const std::vector<std::string_view>& keys) const {
    for (const auto& [key, node] : table_)
      if (std::ranges::find(keys, key.str()) == keys.end())
        fail(key.str(), fmt::format("is no key here; those are {}", fmt::join(keys, ", ")));
  }

  // The values under a key, one or a list of them; `otherwise` where there is none.
  template <class Value, class Read>
  std::vector<Value> list(std::string_view key, std::vector<Value> otherwise, const Read& read) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return otherwise;
    std::vector<Value> values;
    if (const toml::array* array = node->as_array()) {
      for (const toml::node& item : *array) values.push_back(read(item));
    } else {
      values.push_back(read(*node));
    }
    if (values.empty()) fail(key, "is an empty list");
    return values;
  }

  std::vector<double> numbers(std::string_view key, std::vector<double> otherwise, double least,
                              double largest) const {
    return list<double>(key, std::move(otherwise), [&](const toml::node& node) {
      const auto value = node.value<double>();
      if (!value || !(*value >= least && *value <= largest))
        fail(key, fmt::format("takes numbers from {:g} to {:g}", least, largest));
      return *value;
    });
  }

  std::vector<FrameSize> sizes(std::string_view key, FrameSize otherwise, std::uint32_t least) const {
    return list<FrameSize>(key, {otherwise}, [&](const toml::node& node) {
      const auto size = parse_frame_size(node.value<std::string>().value_or(""));
      if (!size || std::min(size->width, size->height) < least ||
          std::max(size->width, size->height) > c_max_frame_side)
        fail(key, fmt::format("takes WIDTHxHEIGHT in pixels, such as 640x480, each {} to {}", least,
                              c_max_frame_side));
      return *size;
    });
  }

  template <class Value>
  std::vector<Value> names(std::string_view key, std::vector<Value> otherwise,
                           const std::vector<std::pair<std::string_view, Value>>& known) const {
    return list<Value>(key, std::move(otherwise), [&](const toml::node& node) {
      const auto text = node.value<std::string>();
      for (const auto& [name, value] : known)
        if (text == name) return value;
      std::vector<std::string_view> all;
      for (const auto& [name, value] : known) all.push_back(name);
      fail(key, fmt::format("takes {}", fmt::join(all, ", ")));
    });
  }

 private:
  const toml::table& table_;
  std::string file_;
};

// A product of lists, point by point.
template <class Value, class Set>
void multiply(std::vector<DesignPoint>& points, const std::vector<Value>& values, const Set& set) {
  std::vector<DesignPoint> product;
  for (const DesignPoint& point : points)
    for (const Value& value : values) {
      product.push_back(point);
      set(product.back(), value);
    }
  points = std::move(product);
}

bool is_processors(Method method) {
  return method == Method::processors_1 || method == Method::processors_2;
}

std::vector<DesignPoint> points_of(const Sweep& sweep) {
  sweep.allow({"method", "preset", "address_bits", "data_bits", "angle_bits", "fraction_bits", "seed_bits",
               "newton", "form", "threshold", "tessellation", "exponent", "size", "tile"});
  std::vector<std::pair<std::string_view, Method>> methods;
  for (std::size_t i = 0; i < c_method_names.size(); ++i)
    methods.emplace_back(c_method_names[i], static_cast<Method>(i));
  std::vector<DesignPoint> points(1);
  multiply(points, sweep.sizes("size", DesignPoint{}.size, 1),
           [](DesignPoint& p, FrameSize size) { p.size = size; });
  multiply(points, sweep.sizes("tile", DesignPoint{}.tile, c_least_tile),
           [](DesignPoint& p, FrameSize tile) { p.tile = tile; });
  multiply(points, sweep.numbers("tessellation", {1.0}, 0.05, 100.0),
           [](DesignPoint& p, double factor) { p.tessellation = factor; });
  // NaN: the scene's own.
  multiply(points, sweep.numbers("exponent", {std::nan("")}, 1.0, 1e6), [](DesignPoint& p, double exponent) {
    if (!std::isnan(exponent)) p.exponent = exponent;
  });
  multiply(points, sweep.names<Method>("method", {}, methods),
           [](DesignPoint& p, Method method) { p.method = method; });
  if (points.empty()) sweep.fail("method", "is missing");
  multiply(points,
           sweep.names<Preset>("preset", {Preset::exact},
                               {{"exact", Preset::exact}, {"published", Preset::published}}),
           [](DesignPoint& p, Preset preset) { p.preset = preset; });
  const auto bits = [&](const char* key, int least, int most) {
    std::vector<int> whole;
    for (const double value : sweep.numbers(key, {0.0}, least, most)) {
      whole.push_back(to_integer<int>(value));
      if (whole.back() != value) sweep.fail(key, "takes whole numbers");
    }
    return whole;
  };
  multiply(points,
           bits("address_bits", tables::c_smallest_cosine_size.address_bits,
                tables::c_largest_cosine_size.address_bits),
           [&](DesignPoint& p, int address) {
             if (address > 0) p.tables = TableSize{address, 0};
           });
  multiply(
      points,
      bits("data_bits", tables::c_smallest_cosine_size.data_bits, tables::c_largest_cosine_size.data_bits),
      [&](DesignPoint& p, int data) {
        if ((data > 0) != p.tables.has_value()) sweep.fail("data_bits", "goes with address_bits alone");
        if (p.tables) p.tables->data_bits = data;
      });
  // A word length means something in some methods alone, and the preset's own is no other.
  const auto length = [&](const char* key, tables::Range range, bool (*has)(Method),
                          std::optional<int> tables::WordLengths::*word, int exact, int published) {
    multiply(points, bits(key, range.least, range.most), [&](DesignPoint& p, int value) {
      const int own = p.preset == Preset::exact ? exact : published;
      if (value != 0 && value != own && has(p.method)) p.words.*word = value;
    });
  };
  length(
      "angle_bits", tables::c_angle_range, [](Method m) { return m == Method::spherical; },
      &tables::WordLengths::angle_bits, golden::Exact::c_angle_fraction_bits,
      golden::Published::c_angle_fraction_bits);
  length(
      "fraction_bits", tables::c_fraction_range,
      [](Method m) { return m == Method::quadratic || m == Method::adaptive; },
      &tables::WordLengths::fraction_bits, golden::Exact::c_intensity_fraction_bits,
      golden::Published::c_intensity_fraction_bits);
  length("seed_bits", tables::c_seed_range, is_processors, &tables::WordLengths::seed_bits,
         golden::Exact::c_root_entry_fraction_bits, golden::Published::c_root_entry_fraction_bits);
  multiply(points,
           sweep.list<std::optional<bool>>("newton", {std::nullopt},
                                           [&](const toml::node& node) {
                                             const auto value = node.value_exact<bool>();
                                             if (!value) sweep.fail("newton", "takes true or false");
                                             return value;
                                           }),
           [&](DesignPoint& p, std::optional<bool> newton) {
             if (!newton || !is_processors(p.method)) return;
             // A square of published is no longer than the table's entry is good for.
             if (*newton && p.preset == Preset::published)
               sweep.fail("newton", "goes with preset exact alone");
             if (*newton != (p.preset == Preset::exact)) p.words.newton = newton;
           });
  for (const DesignPoint& p : points)
    if (p.method == Method::spherical && p.words.angle_bits) {
      const int address = p.tables ? p.tables->address_bits : p.preset == Preset::exact ? 9 : 6;
      if (*p.words.angle_bits < address)
        sweep.fail("angle_bits", fmt::format("must be {} at least, the table's address", address));
    }
  multiply(
      points,
      sweep.names<ProcessorForm>("form", {ProcessorForm::unrolled},
                                 {{"folded", ProcessorForm::folded}, {"unrolled", ProcessorForm::unrolled}}),
      [](DesignPoint& p, ProcessorForm form) { p.form = form; });
  // Version I takes N as it is interpolated; in preset exact that is N/w.
  std::erase_if(points, [](const DesignPoint& p) {
    return p.method == Method::processors_1 && p.preset == Preset::exact;
  });
  multiply(points, sweep.numbers("threshold", {DesignPoint{}.threshold}, 0.01, 255.0),
           [](DesignPoint& p, double threshold) { p.threshold = threshold; });
  return points;
}

}  // namespace

bool DesignPoint::has_threshold() const {
  return method == Method::adaptive || (method == Method::spherical && preset == Preset::exact);
}

std::string DesignPoint::picture() const {
  std::string text = to_string(size);
  if (in_tiles()) text += " in tiles of " + to_string(tile);
  if (tessellation != 1.0) text += fmt::format(", tessellation {:g}", tessellation);
  if (exponent) text += fmt::format(", exponent {:g}", *exponent);
  return text;
}

std::string DesignPoint::design() const {
  std::string text = to_string(method);
  if (in_hardware(method)) text += fmt::format(" {}", to_string(preset));
  if (method == Method::spherical && tables)
    text += fmt::format(" {}x{}", tables->address_bits, tables->data_bits);
  if (words.angle_bits) text += fmt::format(" angle {}", *words.angle_bits);
  if (words.fraction_bits) text += fmt::format(" fraction {}", *words.fraction_bits);
  if (words.seed_bits) text += fmt::format(" seed {}", *words.seed_bits);
  if (words.newton) text += *words.newton ? " with Newton" : " without Newton";
  if (is_processors(method) && form == ProcessorForm::folded) text += " folded";
  if (has_threshold()) text += fmt::format(", threshold {:g}", threshold);
  return text;
}

std::string DesignPoint::name() const {
  return design() + ", " + picture();
}

PlanRequest DesignPoint::plan() const {
  PlanRequest request;
  request.preset = preset;
  if (method == Method::spherical) {
    request.shader = Shader::spherical;
    request.tables = tables;
  } else if (is_processors(method)) {
    request.shader = Shader::processors;
    request.form = form;
  }
  return request;
}

SetupOptions DesignPoint::setup() const {
  SetupOptions options;
  options.quadratic.test = method == Method::adaptive ? HighlightTest::conservative : HighlightTest::none;
  options.quadratic.threshold = threshold;
  options.spherical.threshold = threshold;
  options.processors.normalize = method == Method::processors_2;
  return options;
}

std::vector<DesignPoint> ordered(std::vector<DesignPoint> points) {
  std::set<std::string> known;
  std::erase_if(points, [&](const DesignPoint& point) { return !known.insert(point.name()).second; });
  std::ranges::stable_sort(points, {}, &DesignPoint::picture);
  return points;
}

Result<std::vector<DesignPoint>> read_space(const std::filesystem::path& path) {
  const auto text = read_file(path);
  if (!text) return text.error();
  try {
    const toml::table root = toml::parse(*text, path.string());
    const Sweep top(root, path.string());
    top.allow({"sweep"});
    const toml::array* sweeps = root["sweep"].as_array();
    if (sweeps == nullptr || sweeps->empty())
      return bad_input(path.string() + ": no sweep; give it a [[sweep]] with a method");
    std::vector<DesignPoint> points;
    for (const toml::node& node : *sweeps) {
      if (node.as_table() == nullptr) top.fail("sweep", "must be a table: [[sweep]]");
      std::ranges::copy(points_of(Sweep(*node.as_table(), path.string())), std::back_inserter(points));
    }
    return ordered(std::move(points));
  } catch (const BadSpace& bad) {
    return bad.error;
  } catch (const toml::parse_error& bad) {
    return bad_input(fmt::format("{}:{}: {}", path.string(), bad.source().begin.line, bad.description()));
  }
}

}  // namespace halfway::study
