// SPDX-License-Identifier: Apache-2.0
#include "sim/study/design_point.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <set>

#include "sim/os/must.hpp"
#include "sim/os/toml_file.hpp"
#include "sim/run/draw_knobs.hpp"
#include "words/generator/formats.hpp"

namespace halfway::study {
namespace {

// One sweep of the file.
class Sweep {
 public:
  Sweep(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  /// File, line and key.
  std::string place(std::string_view key) const {
    const toml::node* node = table_.get(key);
    const auto line = (node == nullptr ? table_.source() : node->source()).begin.line;
    return fmt::format("{}:{}: {}", file_, line, key);
  }
  [[noreturn]] void fail(std::string_view key, std::string_view what) const {
    throw_bad_input("{} {}", place(key), what);
  }

  void allow(const std::vector<std::string_view>& keys) const {
    for (const auto& [key, node] : table_)
      if (std::ranges::find(keys, key.str()) == keys.end())
        fail(key.str(), fmt::format("is not a key here; the keys are {}", fmt::join(keys, ", ")));
  }

  // Replace each point by one copy per value of the parameter (one value or a list). If the key is missing,
  // leave the points unchanged.
  void multiply(std::vector<DesignPoint>& points, const Knob& knob) const;
  bool has(std::string_view key) const { return table_.contains(key); }

 private:
  const toml::table& table_;
  std::string file_;
};

}  // namespace

class SpaceValue {
 public:
  SpaceValue(const Sweep& sweep, const char* key, const toml::node& node)
      : sweep_(sweep), key_(key), node_(node) {}

  [[noreturn]] void fail(std::string_view what) const { sweep_.fail(key_, what); }

  double number(double least, double largest) const {
    const auto value = node_.value<double>();
    if (!value || !(*value >= least && *value <= largest))
      fail(fmt::format("takes numbers from {:g} to {:g}", least, largest));
    return *value;
  }
  int whole(int least, int largest) const {
    const double value = number(least, largest);
    if (to_integer<int>(value) != value) fail("takes whole numbers");
    return to_integer<int>(value);
  }
  bool flag() const {
    const auto value = node_.value_exact<bool>();
    if (!value) fail("takes true or false");
    return *value;
  }
  FrameSize size(std::uint32_t least) const {
    const auto size = parse_frame_size(node_.value<std::string>().value_or(""));
    if (!size || std::min(size->width, size->height) < least ||
        std::max(size->width, size->height) > c_max_frame_side)
      fail(fmt::format("takes WIDTHxHEIGHT in pixels, such as 640x480, each {} to {}", least,
                       c_max_frame_side));
    return *size;
  }
  // As in an option of the program.
  KnobText text() const {
    std::string text;
    node_.visit([&](const auto& node) {
      if constexpr (toml::is_string<decltype(node)>)
        text = *node;
      else if constexpr (toml::is_number<decltype(node)>)
        text = fmt::format("{}", *node);
    });
    return {sweep_.place(key_), text};
  }
  // One of the given values, by its name.
  template <class Value>
  Value name(const std::vector<Value>& known) const {
    std::vector<std::string> all;
    for (const Value value : known) {
      if (node_.value<std::string>() == to_string(value)) return value;
      all.emplace_back(to_string(value));
    }
    fail(fmt::format("takes {}", fmt::join(all, ", ")));
  }
  // Empty if it is the preset's own.
  std::optional<int> length(const DesignPoint& p, const tables::WordLength& length) const {
    static const std::vector<tables::PresetFormats> c_presets = tables::preset_formats();
    const auto& formats = c_presets[p.preset == Preset::exact ? 0 : 1];
    const int bits = whole(length.least, length.most);
    return bits == tables::format_of(formats, length.format).fraction_bits ? std::nullopt
                                                                           : std::optional(bits);
  }

 private:
  const Sweep& sweep_;
  const char* key_;
  const toml::node& node_;
};

namespace {

bool is_quadratic(const DesignPoint& p) {
  return p.method == Method::planes || p.method == Method::quadratic || p.method == Method::adaptive;
}
bool is_adaptive(const DesignPoint& p) {
  return p.method == Method::adaptive;
}
bool is_spherical(const DesignPoint& p) {
  return p.method == Method::spherical;
}
bool is_processors(const DesignPoint& p) {
  return p.method == Method::processors_1 || p.method == Method::processors_2;
}
bool has_hardware(const DesignPoint& p) {
  return in_hardware(p.method);
}
bool always(const DesignPoint&) {
  return true;
}

template <class Number>
std::string text_or_none(const std::optional<Number>& number) {
  return number ? fmt::format("{:g}", double(*number)) : std::string();
}

using Point = DesignPoint;
using Value = SpaceValue;

std::vector<Knob> own_knobs() {
  return {
      {"size", true, always, [](const Value& v, Point& p) { p.size = v.size(1); },
       [](const Point& p) { return to_string(p.size); }},
      {"tile", true, always, [](const Value& v, Point& p) { p.tile = v.size(c_least_tile); },
       [](const Point& p) { return to_string(p.tile); }},
      {"tessellation", true, always, [](const Value& v, Point& p) { p.tessellation = v.number(0.05, 100.0); },
       [](const Point& p) { return fmt::format("{:g}", p.tessellation); }},
      {"exponent", true, always, [](const Value& v, Point& p) { p.exponent = v.number(1.0, 1e6); },
       [](const Point& p) { return text_or_none(p.exponent); }},
      {"method", false, always,
       [](const Value& v, Point& p) {
         std::vector<Method> methods;
         for (std::size_t i = 0; i < c_method_names.size(); ++i) methods.push_back(static_cast<Method>(i));
         p.method = v.name(methods);
       },
       [](const Point& p) { return std::string(to_string(p.method)); }},
      {"preset", false, has_hardware,
       [](const Value& v, Point& p) { p.preset = v.name<Preset>({Preset::exact, Preset::published}); },
       [](const Point& p) { return std::string(to_string(p.preset)); }},
      {"newton", false, is_processors,
       [](const Value& v, Point& p) {
         const bool newton = v.flag();
         // In preset published, a square has no more bits than the table's entries are accurate for.
         if (newton && p.preset == Preset::published && is_processors(p))
           v.fail("is only allowed in preset exact");
         if (newton != (p.preset == Preset::exact)) p.words.newton = newton;
       },
       [](const Point& p) { return text_or_none(p.words.newton); }},
      {"own_tables", false, [](const Point& p) { return p.has_ends(); },
       [](const Value& v, Point& p) { p.own_tables = v.flag(); },
       [](const Point& p) { return std::string(p.own_tables ? "1" : ""); }},
  };
}

// Splitting is the method's choice: of the quadratic shader's methods only adaptive has its knobs.
bool belongs(const DrawKnob& knob, const DesignPoint& p) {
  return in_hardware(p.method) && knob.belongs(p.plan().shader, p.preset) &&
         (knob.selects_hardware || !is_quadratic(p) || is_adaptive(p));
}

bool applies(const DrawKnob& knob, const DesignPoint& p) {
  return belongs(knob, p) && (knob.matters == nullptr || knob.matters(p.plan(), p.host));
}

std::vector<Knob> all_knobs() {
  std::vector<Knob> all = own_knobs();
  for (const tables::WordLength& length : tables::c_word_lengths)
    all.push_back({length.key, false,
                   [&length](const Point& p) {
                     return in_hardware(p.method) &&
                            to_string(p.plan().shader) == std::string_view(length.shader);
                   },
                   [&length](const Value& v, Point& p) { p.words.*length.bits = v.length(p, length); },
                   [&length](const Point& p) { return text_or_none(p.words.*length.bits); }});
  for (const DrawKnob& knob : draw_knobs())
    if (knob.text != nullptr)
      all.push_back({knob.name, false, [&knob](const Point& p) { return applies(knob, p); },
                     [&knob](const Value& v, Point& p) { knob.set(v.text(), p.hardware, p.host); },
                     [&knob](const Point& p) { return knob.text(p.hardware, p.host); }});
  return all;
}

void Sweep::multiply(std::vector<DesignPoint>& points, const Knob& knob) const {
  const toml::node* node = table_.get(knob.name);
  if (node == nullptr) return;
  const toml::array one{*node};
  const toml::array& values = node->is_array() ? *node->as_array() : one;
  if (values.empty()) fail(knob.name, "is an empty list");
  std::vector<DesignPoint> product;
  for (const DesignPoint& point : points)
    for (const toml::node& value : values) {
      DesignPoint& next = product.emplace_back(point);
      knob.read({*this, knob.name, value}, next);
      // The value is checked, but has no effect.
      if (!knob.applies(next)) next = point;
    }
  points = std::move(product);
}

std::vector<DesignPoint> points_of(const Sweep& sweep) {
  std::vector<std::string_view> names;
  for (const Knob& knob : knobs()) names.emplace_back(knob.name);
  sweep.allow(names);
  if (!sweep.has("method")) sweep.fail("method", "is missing");
  std::vector<DesignPoint> points(1);
  for (const Knob& knob : knobs()) sweep.multiply(points, knob);
  for (const DrawKnob& knob : draw_knobs())
    if (sweep.has(knob.name) &&
        std::ranges::any_of(points, [&](const Point& p) { return belongs(knob, p); }) &&
        std::ranges::none_of(points, [&](const Point& p) { return applies(knob, p); }))
      sweep.fail(knob.name, fmt::format("goes with {}", knob.needs));
  for (const DesignPoint& p : points) {
    if (p.own_tables && !p.hardware.tables) sweep.fail("own_tables", "is only allowed with cosine");
    if (!p.words.angle_bits) continue;
    const words::CosineSize usual =
        p.preset == Preset::exact ? words::c_exact_cosine_size : words::c_published_cosine_size;
    const int address = p.hardware.tables.value_or(usual).address_bits;
    if (*p.words.angle_bits < address)
      sweep.fail("angle_bits", fmt::format("must be {} at least, the table's address", address));
  }
  // Version I uses the interpolated N without normalization; in preset exact that would be N/w.
  std::erase_if(points, [](const DesignPoint& p) {
    return p.method == Method::processors_1 && p.preset == Preset::exact;
  });
  return points;
}

}  // namespace

std::span<const Knob> knobs() {
  static const std::vector<Knob> c_knobs = all_knobs();
  return c_knobs;
}

std::string text_of(const Knob& knob, const DesignPoint& point) {
  return knob.applies(point) ? knob.text(point) : std::string();
}

std::string text_of(std::string_view knob, const DesignPoint& point) {
  return text_of(*std::ranges::find(knobs(), knob, &Knob::name), point);
}

std::string DesignPoint::picture() const {
  std::string text = to_string(size);
  if (in_tiles()) text += " in tiles of " + to_string(tile);
  if (tessellation != 1.0) text += fmt::format(", tessellation {:g}", tessellation);
  if (exponent) text += fmt::format(", exponent {:g}", *exponent);
  if (filtered()) text += ", filtered";
  return text;
}

std::string DesignPoint::design() const {
  std::string text = to_string(method);
  if (in_hardware(method)) text += fmt::format(" {}", to_string(preset));
  std::string lengths = own_tables ? " own" : "";
  for (const tables::WordLength& length : tables::c_word_lengths)
    if (const auto& bits = words.*length.bits) lengths += fmt::format(" {} {}", length.in_names, *bits);
  if (words.newton) lengths += *words.newton ? " with Newton" : " without Newton";
  for (const DrawKnob& knob : draw_knobs()) {
    if (knob.text != nullptr && applies(knob, *this)) {
      const std::string value = knob.text(hardware, host);
      if (knob.always_named || value != knob.text({}, {}))
        text += fmt::format(fmt::runtime(knob.in_names), value);
    }
    // The other word lengths follow the size of the tables.
    if (knob.name == std::string_view("cosine")) text += lengths;
  }
  return text;
}

std::string DesignPoint::name() const {
  return design() + ", " + picture();
}

std::string DesignPoint::host_work() const {
  DesignPoint same = *this;
  if (!own_tables) same.hardware.tables.reset();
  same.hardware.form.reset();
  return same.name();
}

PlanRequest DesignPoint::plan() const {
  PlanRequest request = hardware;
  request.preset = preset;
  if (is_spherical(*this)) request.shader = Shader::spherical;
  if (is_processors(*this)) request.shader = Shader::processors;
  if (method == Method::planes) request.degree = 1;
  return request;
}

SetupOptions DesignPoint::setup() const {
  SetupOptions options = host;
  if (method != Method::adaptive) options.quadratic.test = HighlightTest::none;
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
    throw_bad_input("{}: no sweep; give it a [[sweep]] with a method", path.string());
  std::vector<DesignPoint> points;
  for (const toml::node& node : *sweeps) {
    if (node.as_table() == nullptr) top.fail("sweep", "must be a table: [[sweep]]");
    std::ranges::copy(points_of(Sweep(*node.as_table(), path.string())), std::back_inserter(points));
  }
  return ordered(std::move(points));
}

}  // namespace halfway::study
