// SPDX-License-Identifier: Apache-2.0
#include "sim/run/draw_knobs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>

#include "sim/os/must.hpp"
#include "words/generator/cosine.hpp"

namespace halfway {
namespace {

constexpr int c_most_levels = 5;  // of subdivision

// False if the number is out of the type's range.
template <class Number>
bool read(const KnobText& value, Number& number, const char* what) {
  const char* end = value.text.data() + value.text.size();
  const auto [stop, error] = std::from_chars(value.text.data(), end, number);
  if (stop != end || error == std::errc::invalid_argument)
    value.fail(fmt::format("'{}' is not {}", value.text, what));
  return error == std::errc();
}

int whole_number(const KnobText& value, int least, int most) {
  int number = 0;
  if (!read(value, number, "a whole number") || number < least || number > most)
    value.fail(fmt::format("{} is not {} to {}", value.text, least, most));
  return number;
}

double above_zero(const KnobText& value) {
  double number = 0.0;
  if (!read(value, number, "a number") || !(number > 0.0) || !std::isfinite(number))
    value.fail(fmt::format("{} is not above 0", value.text));
  return number;
}

template <class Value>
Value one_of(const KnobText& value, std::initializer_list<Value> choices) {
  std::vector<const char*> names;
  for (const Value choice : choices) {
    if (value.text == to_string(choice)) return choice;
    names.push_back(to_string(choice));
  }
  value.fail(fmt::format("'{}' is not one of its values; take {}", value.text, fmt::join(names, " or ")));
}

}  // namespace

void KnobText::fail(std::string_view what) const {
  throw_bad_input("{}: {}", place, what);
}

std::string DrawKnob::option() const {
  std::string option = std::string("--") + name;
  std::ranges::replace(option, '_', '-');
  return option;
}

bool DrawKnob::belongs(Shader shader, Preset preset) const {
  return std::ranges::any_of(belongs_to, [&](const auto& hardware) {
    return hardware.first == shader && hardware.second.value_or(preset) == preset;
  });
}

const std::vector<DrawKnob>& draw_knobs() {
  using Request = PlanRequest;
  using Options = SetupOptions;
  using Text = KnobText;
  using Hardware = decltype(DrawKnob::belongs_to);
  const Hardware quadratic = {{Shader::quadratic, {}}}, spherical = {{Shader::spherical, {}}},
                 processors = {{Shader::processors, {}}}, exact = {{Shader::spherical, Preset::exact}};
  const auto both = [](Hardware one, const Hardware& other) {
    one.insert(one.end(), other.begin(), other.end());
    return one;
  };
  static const std::vector<DrawKnob> c_knobs = {
      {"cosine", spherical, true,
       fmt::format("spherical: {},\na size that `make tables` has made (default: the preset's)",
                   tables::c_cosine_values),
       [](const Text& v, Request& plan, Options&) {
         plan.tables = tables::parse_cosine_size(v.text);
         if (!plan.tables) v.fail(fmt::format("'{}' is not {}", v.text, tables::c_cosine_values));
       },
       [](const Request& plan, const Options&) { return plan.tables ? to_string(*plan.tables) : ""; }, " {}"},
      {"lights", both(spherical, processors), true,
       fmt::format("spherical and processors, with --all-effects: number of lights, up to {} (default: that\n"
                   "of the scene, at least one)",
                   c_most_lights),
       [](const Text& v, Request& plan, Options&) {
         plan.lights = unsigned(whole_number(v, 1, c_most_lights));
       },
       nullptr, "", [](const Request& plan, const Options&) { return plan.all_effects; },
       "--all-effects; give both"},
      {"degree", quadratic, true,
       "quadratic: 2, or 1: planes through the colours at the vertices, as in Gouraud's shading,\n"
       "by hardware without second differences (default: 2)",
       [](const Text& v, Request& plan, Options&) { plan.degree = whole_number(v, 1, 2); }},
      {"form", processors, true,
       "processors: unrolled, one object per clock, or folded, as published: one datapath\n"
       "per processor, several clocks per object (default: unrolled)",
       [](const Text& v, Request& plan, Options&) {
         plan.form = one_of(v, {ProcessorForm::unrolled, ProcessorForm::folded});
       },
       [](const Request& plan, const Options&) -> std::string {
         return to_string(plan.form.value_or(ProcessorForm::unrolled));
       },
       " {}"},
      {"highlight_test", quadratic, false,
       "quadratic: test for splitting a triangle in four: none, centroid (as published),\n"
       "conservative, or proved (default: conservative in preset exact, centroid in published)",
       [](const Text& v, Request&, Options& setup) {
         setup.quadratic.test = one_of(v, {HighlightTest::none, HighlightTest::centroid,
                                           HighlightTest::conservative, HighlightTest::proved});
       },
       [](const Request&, const Options& setup) -> std::string { return to_string(setup.quadratic.test); },
       " {}"},
      {"max_level", quadratic, false,
       fmt::format("quadratic: levels of splitting, 0 to {0} (default: {0})", c_most_levels),
       [](const Text& v, Request&, Options& setup) {
         setup.quadratic.max_level = whole_number(v, 0, c_most_levels);
       }},
      {"span_ends", exact, false,
       "spherical, preset exact: surface or slerp: vectors at a span's ends from the surface, or by\n"
       "slerp along the edges, as published: never cut into strips, so errors are large close to a\n"
       "light (default: surface)",
       [](const Text& v, Request&, Options& setup) {
         setup.spherical.ends = one_of(v, {SpanEnds::on_surface, SpanEnds::slerped_along_edges});
       },
       [](const Request&, const Options& setup) -> std::string { return to_string(setup.spherical.ends); },
       " {}"},
      {"objects", processors, true,
       fmt::format(
           "processors: a chain of this many object processors, up to {}, instead of the rasterizer: only\n"
           "visible objects are shaded (default: 0, the rasterizer; {} for a scene with shadows)",
           c_most_object_processors, c_object_processors),
       [](const Text& v, Request& plan, Options&) {
         plan.objects = unsigned(whole_number(v, 0, c_most_object_processors));
       },
       [](const Request& plan, const Options&) {
         return plan.objects > 0 ? std::to_string(plan.objects) : "";
       },
       " objects {}"},
      {"subpixels", processors, true,
       "processors, with --objects: 1, or 4 or 16 subpixels of a pixel, which is then filtered (default: 1)",
       [](const Text& v, Request& plan, Options&) {
         plan.subpixels = unsigned(whole_number(v, 1, 16));
         if (plan.subpixels != 1 && plan.subpixels != 4 && plan.subpixels != 16)
           v.fail(fmt::format("{} is not 1, 4 or 16", v.text));
       },
       [](const Request& plan, const Options&) { return std::to_string(plan.subpixels); }, " subpixels {}",
       [](const Request& plan, const Options&) { return plan.objects > 0; }, "objects above 0; give both"},
      {"threshold", both(quadratic, exact), false,
       fmt::format("error above which a triangle is split (quadratic) or cut into strips (spherical, preset\n"
                   "exact), in colour steps of 1/255 (default: {})",
                   QuadraticSetupOptions{}.threshold),
       [](const Text& v, Request&, Options& setup) {
         setup.quadratic.threshold = setup.spherical.threshold = above_zero(v);
       },
       [](const Request&, const Options& setup) { return fmt::format("{:g}", setup.quadratic.threshold); },
       ", threshold {}",
       [](const Request& plan, const Options& setup) {
         return plan.shader != Shader::spherical || setup.spherical.ends == SpanEnds::on_surface;
       },
       "span ends on the surface: with slerp no triangle is cut", true},
  };
  return c_knobs;
}

}  // namespace halfway
