// SPDX-License-Identifier: Apache-2.0
#include "sim/study/design_point.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "common/to_integer.hpp"
#include "frame/frame.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"
#include "sim/os/toml_file.hpp"
#include "words/formats.hpp"
#include "words/generator/cosine.hpp"

namespace halfway::study {
namespace {

// The names of values in a space.
const char* name_of(Method method) {
  return to_string(method);
}
const char* name_of(Preset preset) {
  return to_string(preset);
}
const char* name_of(ProcessorForm form) {
  return to_string(form);
}
using study::name_of;

// One sweep of the file.
class Sweep {
 public:
  Sweep(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  [[noreturn]] void fail(std::string_view key, std::string_view what) const {
    const toml::node* node = table_.get(key);
    const auto line = (node == nullptr ? table_.source() : node->source()).begin.line;
    throw Failure{bad_input(fmt::format("{}:{}: {} {}", file_, line, key, what))};
  }

  void allow(const std::vector<std::string_view>& keys) const {
    for (const auto& [key, node] : table_)
      if (std::ranges::find(keys, key.str()) == keys.end())
        fail(key.str(), fmt::format("is not a key here; the keys are {}", fmt::join(keys, ", ")));
  }

  // Replace each point by one copy per value of the key (one value or a list). If the key is missing, leave
  // the points unchanged. `set` writes a value into a point.
  template <class Set>
  void multiply(std::vector<DesignPoint>& points, std::string_view key, const Set& set) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return;
    const toml::array one{*node};
    const toml::array& values = node->is_array() ? *node->as_array() : one;
    if (values.empty()) fail(key, "is an empty list");
    std::vector<DesignPoint> product;
    for (const DesignPoint& point : points)
      for (const toml::node& value : values) set(product.emplace_back(point), value);
    points = std::move(product);
  }

  double number(std::string_view key, const toml::node& node, double least, double largest) const {
    const auto value = node.value<double>();
    if (!value || !(*value >= least && *value <= largest))
      fail(key, fmt::format("takes numbers from {:g} to {:g}", least, largest));
    return *value;
  }

  int whole(std::string_view key, const toml::node& node, int least, int largest) const {
    const double value = number(key, node, least, largest);
    if (to_integer<int>(value) != value) fail(key, "takes whole numbers");
    return to_integer<int>(value);
  }

  FrameSize size(std::string_view key, const toml::node& node, std::uint32_t least) const {
    const auto size = parse_frame_size(node.value<std::string>().value_or(""));
    if (!size || std::min(size->width, size->height) < least ||
        std::max(size->width, size->height) > c_max_frame_side)
      fail(key, fmt::format("takes WIDTHxHEIGHT in pixels, such as 640x480, each {} to {}", least,
                            c_max_frame_side));
    return *size;
  }

  // Look up one of the given values by its name.
  template <class Value>
  Value name(std::string_view key, const toml::node& node, const std::vector<Value>& known) const {
    std::vector<std::string> all;
    for (const Value value : known) {
      if (node.value<std::string>() == name_of(value)) return value;
      all.emplace_back(name_of(value));
    }
    fail(key, fmt::format("takes {}", fmt::join(all, ", ")));
  }

 private:
  const toml::table& table_;
  std::string file_;
};

bool is_processors(Method method) {
  return method == Method::processors_1 || method == Method::processors_2;
}

std::vector<DesignPoint> points_of(const Sweep& sweep) {
  sweep.allow({"method", "preset", "address_bits", "data_bits", "own_tables", "angle_bits", "fraction_bits",
               "seed_bits", "newton", "form", "highlight_test", "span_ends", "threshold", "tessellation",
               "exponent", "size", "tile"});
  std::vector<DesignPoint> points(1);
  const auto multiply = [&](std::string_view key, const auto& set) { sweep.multiply(points, key, set); };
  const auto numbers = [&](std::string_view key, double least, double largest, const auto& set) {
    multiply(key, [&](DesignPoint& p, const toml::node& node) {
      set(p, sweep.number(key, node, least, largest));
    });
  };
  const auto lengths = [&](std::string_view key, int least, int largest, const auto& set) {
    multiply(key,
             [&](DesignPoint& p, const toml::node& node) { set(p, sweep.whole(key, node, least, largest)); });
  };
  multiply("size", [&](DesignPoint& p, const toml::node& node) { p.size = sweep.size("size", node, 1); });
  multiply("tile",
           [&](DesignPoint& p, const toml::node& node) { p.tile = sweep.size("tile", node, c_least_tile); });
  numbers("tessellation", 0.05, 100.0, [](DesignPoint& p, double factor) { p.tessellation = factor; });
  numbers("exponent", 1.0, 1e6, [](DesignPoint& p, double exponent) { p.exponent = exponent; });
  bool has_method = false;
  multiply("method", [&](DesignPoint& p, const toml::node& node) {
    std::vector<Method> methods;
    for (std::size_t i = 0; i < c_method_names.size(); ++i) methods.push_back(static_cast<Method>(i));
    p.method = sweep.name("method", node, methods);
    has_method = true;
  });
  if (!has_method) sweep.fail("method", "is missing");
  multiply("preset", [&](DesignPoint& p, const toml::node& node) {
    p.preset = sweep.name<Preset>("preset", node, {Preset::exact, Preset::published});
  });
  constexpr tables::CosineSize c_least = tables::c_smallest_cosine_size,
                               c_most = tables::c_largest_cosine_size;
  lengths("address_bits", c_least.address_bits, c_most.address_bits, [](DesignPoint& p, int address) {
    p.tables = words::CosineSize{address, 0};
  });
  lengths("data_bits", c_least.data_bits, c_most.data_bits, [&](DesignPoint& p, int data) {
    if (!p.tables) sweep.fail("data_bits", "is only allowed with address_bits");
    p.tables->data_bits = data;
  });
  if (std::ranges::any_of(points, [](const DesignPoint& p) { return p.tables && p.tables->data_bits == 0; }))
    sweep.fail("data_bits", "is only allowed with address_bits");
  multiply("own_tables", [&](DesignPoint& p, const toml::node& node) {
    const auto own = node.value_exact<bool>();
    if (!own) sweep.fail("own_tables", "takes true or false");
    if (p.method != Method::spherical || p.preset != Preset::exact) return;
    if (*own && !p.tables) sweep.fail("own_tables", "is only allowed with address_bits and data_bits");
    p.own_tables = *own;
  });
  // A word length applies to some methods only. The preset's own length counts as not given.
  const auto length = [&](std::string_view key, tables::Range range, bool (*has)(Method),
                          std::optional<int> tables::WordLengths::*word, int exact, int published) {
    lengths(key, range.least, range.most, [&](DesignPoint& p, int value) {
      const int own = p.preset == Preset::exact ? exact : published;
      if (value != own && has(p.method)) p.words.*word = value;
    });
  };
  length(
      "angle_bits", tables::c_angle_range, [](Method m) { return m == Method::spherical; },
      &tables::WordLengths::angle_bits, words::Exact::c_angle_fraction_bits,
      words::Published::c_angle_fraction_bits);
  length(
      "fraction_bits", tables::c_fraction_range,
      [](Method m) { return m == Method::planes || m == Method::quadratic || m == Method::adaptive; },
      &tables::WordLengths::fraction_bits, words::Exact::c_intensity_fraction_bits,
      words::Published::c_intensity_fraction_bits);
  length("seed_bits", tables::c_seed_range, is_processors, &tables::WordLengths::seed_bits,
         words::Exact::c_root_entry_fraction_bits, words::Published::c_root_entry_fraction_bits);
  multiply("newton", [&](DesignPoint& p, const toml::node& node) {
    const auto newton = node.value_exact<bool>();
    if (!newton) sweep.fail("newton", "takes true or false");
    if (!is_processors(p.method)) return;
    // In preset published, a square has no more bits than the table's entries are accurate for.
    if (*newton && p.preset == Preset::published) sweep.fail("newton", "is only allowed in preset exact");
    if (*newton != (p.preset == Preset::exact)) p.words.newton = newton;
  });
  for (const DesignPoint& p : points)
    if (p.method == Method::spherical && p.words.angle_bits) {
      const int address = p.tables ? p.tables->address_bits : p.preset == Preset::exact ? 9 : 6;
      if (*p.words.angle_bits < address)
        sweep.fail("angle_bits", fmt::format("must be {} at least, the table's address", address));
    }
  multiply("form", [&](DesignPoint& p, const toml::node& node) {
    p.form = sweep.name<ProcessorForm>("form", node, {ProcessorForm::folded, ProcessorForm::unrolled});
  });
  multiply("highlight_test", [&](DesignPoint& p, const toml::node& node) {
    const HighlightTest test = sweep.name<HighlightTest>(
        "highlight_test", node, {HighlightTest::conservative, HighlightTest::centroid});
    if (p.method == Method::adaptive) p.test = test;
  });
  multiply("span_ends", [&](DesignPoint& p, const toml::node& node) {
    const SpanEnds ends =
        sweep.name<SpanEnds>("span_ends", node, {SpanEnds::on_surface, SpanEnds::slerped_along_edges});
    if (p.has_ends()) p.ends = ends;
  });
  // Version I uses the interpolated N without normalization; in preset exact that would be N/w.
  std::erase_if(points, [](const DesignPoint& p) {
    return p.method == Method::processors_1 && p.preset == Preset::exact;
  });
  numbers("threshold", 0.01, 255.0, [](DesignPoint& p, double threshold) { p.threshold = threshold; });
  return points;
}

}  // namespace

bool DesignPoint::has_threshold() const {
  return method == Method::adaptive || (has_ends() && ends == SpanEnds::on_surface);
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
    text += fmt::format(" {}x{}{}", tables->address_bits, tables->data_bits, own_tables ? " own" : "");
  if (words.angle_bits) text += fmt::format(" angle {}", *words.angle_bits);
  if (words.fraction_bits) text += fmt::format(" fraction {}", *words.fraction_bits);
  if (words.seed_bits) text += fmt::format(" seed {}", *words.seed_bits);
  if (words.newton) text += *words.newton ? " with Newton" : " without Newton";
  if (is_processors(method) && form == ProcessorForm::folded) text += " folded";
  if (method == Method::adaptive && test != HighlightTest::conservative)
    text += fmt::format(" {}", name_of(test));
  if (has_ends() && ends != SpanEnds::on_surface) text += fmt::format(" {}", name_of(ends));
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
  } else if (method == Method::planes) {
    request.degree = 1;
  } else if (is_processors(method)) {
    request.shader = Shader::processors;
    request.form = form;
  }
  return request;
}

SetupOptions DesignPoint::setup() const {
  SetupOptions options;
  options.quadratic.test = method == Method::adaptive ? test : HighlightTest::none;
  options.quadratic.threshold = threshold;
  options.spherical.ends = ends;
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

std::vector<DesignPoint> read_space(const std::filesystem::path& path) {
  const toml::table root = read_toml(path);
  const Sweep top(root, path.string());
  top.allow({"sweep"});
  const toml::array* sweeps = root["sweep"].as_array();
  if (sweeps == nullptr || sweeps->empty())
    throw Failure{bad_input(path.string() + ": no sweep; give it a [[sweep]] with a method")};
  std::vector<DesignPoint> points;
  for (const toml::node& node : *sweeps) {
    if (node.as_table() == nullptr) top.fail("sweep", "must be a table: [[sweep]]");
    std::ranges::copy(points_of(Sweep(*node.as_table(), path.string())), std::back_inserter(points));
  }
  return ordered(std::move(points));
}

}  // namespace halfway::study
