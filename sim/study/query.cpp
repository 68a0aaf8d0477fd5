// SPDX-License-Identifier: Apache-2.0
#include "sim/study/query.hpp"

#include <fmt/ranges.h>

#include <charconv>
#include <initializer_list>
#include <set>

namespace halfway::study {
namespace {

// The value of an option, a number with one of the units; std::nullopt: the option is not given. Throws
// Failure if `is_valid` is false for the number.
template <class IsValid>
std::optional<double> read_quantity(const char* option, const std::string& text,
                                    std::initializer_list<std::pair<std::string_view, double>> units,
                                    const IsValid& is_valid, const char* what) {
  if (text.empty()) return std::nullopt;
  double number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool right = error == std::errc{} && std::isfinite(number) && is_valid(number);
  std::string_view unit(rest);
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const auto& [name, size] : units)
    if (right && unit == name) return number * size;
  throw_bad_input("{}: '{}' is not valid; {}", option, text, what);
}

std::string time_text(double seconds) {
  constexpr std::array c_units = {std::pair{1.0, "s"}, std::pair{1e-3, "ms"}, std::pair{1e-6, "us"}};
  for (const auto& [size, unit] : c_units)
    if (seconds >= size) return fmt::format("{:.4g} {}", seconds / size, unit);
  return fmt::format("{:.4g} ns", seconds / 1e-9);
}

// Quantities that the offers of a market are compared by.
struct Scales {
  bool cells;
  bool seconds;  ///< known for some offers
  bool cycles;   ///< also needed, because the seconds of some offers are unknown
  bool host;
};
Scales scales_of(std::span<const Offer> offers) {
  const auto timed = [](const Offer& o) { return o.seconds.has_value(); };
  return {.cells = std::ranges::all_of(offers, [](const Offer& o) { return o.cells.has_value(); }),
          .seconds = std::ranges::any_of(offers, timed),
          .cycles = !std::ranges::all_of(offers, [](const Offer& o) { return o.seconds || !o.fits; }),
          .host = std::ranges::all_of(offers, [](const Offer& o) { return o.host.has_value(); })};
}

// Cells, time, host. Prices are compared lexicographically.
Costs price_of(const Offer& offer, Scales scales) {
  constexpr double c_none = std::numeric_limits<double>::infinity();
  return {scales.cells ? *offer.cells : 0.0, scales.seconds ? offer.seconds.value_or(c_none) : 0.0,
          scales.cycles || !offer.seconds ? offer.cycles : 0.0, scales.host ? *offer.host : 0.0};
}

bool accurate_enough(const Offer& offer, const Demand& demand) {
  return (!demand.largest_error || offer.largest_error <= *demand.largest_error) &&
         (!demand.psnr_db || offer.psnr_db >= *demand.psnr_db);
}

bool in_time(const Offer& offer, const Demand& demand) {
  const std::optional<double>& seconds = offer.frame_seconds ? offer.frame_seconds : offer.seconds;
  return !demand.seconds || (seconds && *seconds <= *demand.seconds);
}

bool by_psnr(const Demand& demand) {
  return demand.psnr_db && !demand.largest_error;
}

// Errors with the measure of the demand first; lower is better.
Costs errors_of(const Offer& offer, const Demand& demand) {
  Costs errors = {offer.largest_error, -offer.psnr_db};
  if (by_psnr(demand)) std::swap(errors[0], errors[1]);
  return errors;
}

Costs joined(Costs a, const Costs& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The offer with the smallest `key` among those that satisfy `take`; the first of equals.
template <class Key, class Take>
std::optional<std::size_t> least(std::span<const Offer> offers, const Key& key, const Take& take) {
  std::optional<std::size_t> found;
  for (std::size_t at = 0; at < offers.size(); ++at)
    if (take(offers[at]) && (!found || key(offers[at]) < key(offers[*found]))) found = at;
  return found;
}

std::string offer_text(const Offer& o) {
  std::string text = fmt::format("largest error {:g}/255, PSNR {:.2f} dB", o.largest_error, o.psnr_db);
  if (o.cells) text += fmt::format(", {:.0f} cells", *o.cells);
  text += fmt::format(", {:.0f} cycles", o.cycles);
  if (o.seconds) text += fmt::format(" ({})", time_text(*o.seconds));
  if (o.frame_seconds) text += fmt::format(", a frame with the host in {}", time_text(*o.frame_seconds));
  if (o.host) text += fmt::format(", {:.0f} host instructions per triangle", *o.host);
  return text;
}

const char* time_scale(Scales scales) {
  if (!scales.cycles) return "nanoseconds";
  return scales.seconds ? "cycles, and in nanoseconds where the clock is known" : "cycles";
}

const char* host_scale(Scales scales) {
  return scales.host ? "the host's work in instructions per triangle"
                     : "the host's work not compared: its instructions are not counted (this needs Valgrind)";
}

// The difference of the costs of `there` and `here`.
std::string difference_text(const Offer& here, const Offer& there) {
  std::vector<std::string> texts;
  const auto add = [&](double from, double to, const char* what) {
    if (from == to) return;
    std::string text = fmt::format("{:+.0f} {}", to - from, what);
    if (from > 0) text += fmt::format(" ({:+.3g} %)", 100.0 * (to / from - 1.0));
    texts.push_back(std::move(text));
  };
  if (here.cells && there.cells) add(*here.cells, *there.cells, "cells");
  add(here.cycles, there.cycles, "cycles");
  if (here.seconds && there.seconds && *here.seconds != *there.seconds)
    texts.push_back(fmt::format("{}{} ({:+.3g} %)", *there.seconds < *here.seconds ? '-' : '+',
                                time_text(std::fabs(*there.seconds - *here.seconds)),
                                100.0 * (*there.seconds / *here.seconds - 1.0)));
  if (here.host && there.host) add(*here.host, *there.host, "host instructions per triangle");
  return texts.empty() ? "no other cost" : fmt::format("{}", fmt::join(texts, ", "));
}

// The searched space: the number of designs and the parameters in which they differ.
std::string knobs_text(const Market& market, std::span<const Record> records) {
  std::vector<const char*> turned, left;
  for (const Knob& knob : knobs()) {
    if (knob.is_picture) continue;
    std::set<std::string> values;
    for (const Offer& offer : market.offers)
      if (const DesignPoint& point = records[offer.record].point; knob.applies(point))
        values.insert(knob.text(point));
    if (!values.empty()) (values.size() > 1 ? turned : left).push_back(knob.name);
  }
  std::string text = fmt::format("  {:<14} {} points of hardware", "looked at", market.offers.size());
  if (!turned.empty()) text += fmt::format("; varied: {}", fmt::join(turned, ", "));
  if (!left.empty()) text += fmt::format("; not varied: {}", fmt::join(left, ", "));
  return text + "\n";
}

// The front as a table. Only steps of increasing accuracy are listed; the whole front is longer.
std::string front_text(const Market& market, const Answer& answer, const Demand& demand,
                       std::span<const Record> records) {
  const Scales scales = scales_of(market.offers);
  std::string text =
      fmt::format("  {:<14} {} of {} points of hardware, time in {}, {}\n", "front", answer.front.size(),
                  market.offers.size(), time_scale(scales), host_scale(scales));
  text += fmt::format("  its steps, each more accurate (by {}) than all cheaper points:\n",
                      by_psnr(demand) ? "PSNR" : "largest error");
  text += fmt::format("  {:>9} {:>8}  {:>8} {:>9} {:>10} {:>13}  {}\n", "error/255", "PSNR, dB", "cells",
                      "cycles", "time", "host/triangle", "design");
  for (const std::size_t at : answer.steps) {
    const Offer& o = market.offers[at];
    text += fmt::format("  {:>9g} {:>8.2f}  {:>8} {:>9.0f} {:>10} {:>13}  {}\n", o.largest_error, o.psnr_db,
                        o.cells ? fmt::format("{:.0f}", *o.cells) : "-", o.cycles,
                        o.seconds ? time_text(*o.seconds) : "-",
                        o.host ? fmt::format("{:.0f}", *o.host) : "-", records[o.record].point.design());
  }
  return text;
}

}  // namespace

std::string Demand::text() const {
  std::vector<std::string> texts;
  if (largest_error) texts.push_back(fmt::format("largest error at most {:g}/255", *largest_error));
  if (psnr_db) texts.push_back(fmt::format("PSNR at least {:g} dB", *psnr_db));
  if (seconds) texts.push_back(fmt::format("a frame in {}", time_text(*seconds)));
  return fmt::format("{}", fmt::join(texts, ", "));
}

Demand read_demand(const std::string& error, const std::string& psnr, const std::string& time) {
  const auto above_zero = [](double number) { return number > 0; };
  return {.largest_error = read_quantity(
              "--error", error, {{"", 1.0}}, [](double steps) { return steps >= 0 && steps <= 255; },
              "take steps of 1/255 from 0 to 255, such as 2"),
          .psnr_db = read_quantity("--psnr", psnr, {{"", 1.0}, {"dB", 1.0}}, above_zero,
                                   "take decibels above 0, such as 45"),
          .seconds = read_quantity("--time", time, {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}},
                                   above_zero, "take a time with its unit, s, ms, us or ns, such as 10ms")};
}

std::optional<double> mhz_of(const std::string& hardware, const HardwareTable& table, Clock assumed) {
  const auto found = table.find(hardware);
  if (found == table.end()) return assumed;
  if (!found->second.fits) return std::nullopt;
  return found->second.mhz ? found->second.mhz : assumed;
}

std::vector<Market> markets_of(std::span<const Record> records, const HardwareTable& hardware, Clock clock) {
  std::vector<Market> markets;
  for (std::size_t at = 0; at < records.size(); ++at) {
    const DesignPoint& point = records[at].point;
    const Measurement& measured = records[at].measured;
    if (!in_hardware(point.method)) continue;
    Offer offer{.record = at,
                .largest_error = static_cast<double>(measured.picture.max_lsb),
                .psnr_db = measured.picture.psnr_db,
                .cycles = static_cast<double>(measured.cycles)};
    if (measured.host_instructions && measured.triangles > 0)
      offer.host = static_cast<double>(*measured.host_instructions) / static_cast<double>(measured.triangles);
    if (const auto found = hardware.find(measured.hardware); found != hardware.end()) {
      const synth::Cost& figures = found->second;
      if (figures.cells) offer.cells = synth::cell_count(*figures.cells);
      offer.fits = figures.fits;
    }
    if (const auto mhz = mhz_of(measured.hardware, hardware, clock))
      offer.seconds = offer.cycles / (*mhz * 1e6);
    if (offer.seconds && measured.host_time)
      offer.frame_seconds = std::max(*offer.seconds, 1e-9 * measured.host_time->ns);
    const std::string picture = point.picture();
    auto market = std::ranges::find(markets, picture, &Market::picture);
    if (market == markets.end()) market = markets.insert(market, Market{picture, {}});
    market->offers.push_back(offer);
  }
  return markets;
}

std::vector<Costs> costs_of(std::span<const Offer> offers) {
  const Scales scales = scales_of(offers);
  std::vector<Costs> costs;
  for (const Offer& offer : offers) costs.push_back(joined(errors_of(offer, {}), price_of(offer, scales)));
  return costs;
}

Answer answer(std::span<const Offer> offers, const Demand& demand) {
  const Scales scales = scales_of(offers);
  const auto price = [&](const Offer& o) { return price_of(o, scales); };
  const auto errors = [&](const Offer& o) { return errors_of(o, demand); };
  const auto cheapest_first = [&](const Offer& o) { return joined(price(o), errors(o)); };
  const auto best_first = [&](const Offer& o) { return joined(errors(o), price(o)); };
  const auto any = [](const Offer&) { return true; };

  Answer found;
  found.front = front_of(costs_of(offers));
  std::ranges::stable_sort(found.front, {}, [&](std::size_t at) { return cheapest_first(offers[at]); });

  found.cheapest = least(offers, cheapest_first,
                         [&](const Offer& o) { return accurate_enough(o, demand) && in_time(o, demand); });
  found.quickest = least(
      offers, [&](const Offer& o) { return joined({*o.frame_seconds}, best_first(o)); },
      [&](const Offer& o) { return o.frame_seconds && accurate_enough(o, demand) && in_time(o, demand); });
  const auto without_clock = [&](bool fits) {
    return static_cast<std::size_t>(std::ranges::count_if(offers, [&](const Offer& o) {
      return demand.seconds && !o.seconds && o.fits == fits && accurate_enough(o, demand);
    }));
  };
  found.unknown = without_clock(true);
  found.no_room = without_clock(false);
  for (const std::size_t at : found.front)
    if (found.steps.empty() || errors(offers[at])[0] < errors(offers[found.steps.back()])[0])
      found.steps.push_back(at);
  found.best = least(offers, best_first, any);
  found.best_met = least(offers, best_first,
                         [&](const Offer& o) { return accurate_enough(o, demand) && in_time(o, demand); });
  found.fastest = least(
      offers, [&](const Offer& o) { return joined({o.seconds.value_or(0)}, best_first(o)); },
      [](const Offer& o) { return o.seconds.has_value(); });
  found.fewest_cycles = least(offers, [&](const Offer& o) { return joined({o.cycles}, best_first(o)); }, any);
  if (!found.cheapest) return found;
  const Offer& here = offers[*found.cheapest];
  found.cheaper = least(offers, best_first, [&](const Offer& o) { return price(o) < price(here); });
  found.accurate = least(offers, cheapest_first, [&](const Offer& o) {
    return in_time(o, demand) && errors(o)[0] < errors(here)[0];
  });
  return found;
}

std::string to_text(const Market& market, const Answer& answer, const Demand& demand,
                    std::span<const Record> records) {
  const Scales scales = scales_of(market.offers);
  const auto name = [&](std::size_t at) { return records[market.offers[at].record].point.design(); };
  if (!demand.any()) return market.picture + "\n" + front_text(market, answer, demand, records);
  std::string text;
  if (answer.quickest)
    text = fmt::format("{}: the quickest with {} is {}, {} a frame with the host\n", market.picture,
                       demand.text(), name(*answer.quickest),
                       time_text(*market.offers[*answer.quickest].frame_seconds));
  else
    text = fmt::format("{}: {}\n", market.picture, demand.text());
  const auto line = [&](const char* what, std::size_t at, const std::string& more) {
    text += fmt::format("  {:<14} {}: {}{}\n", what, name(at), offer_text(market.offers[at]), more);
  };
  const auto against = [&](std::size_t from, std::size_t to) {
    return "; " + difference_text(market.offers[from], market.offers[to]);
  };
  if (!answer.cheapest) {
    text += fmt::format("  none of {} points of hardware meets it\n", market.offers.size());
    if (answer.best) line("most accurate", *answer.best, "");
    if (answer.fastest)
      line("fastest", *answer.fastest, scales.cycles ? "; among those with a known clock" : "");
    if (answer.fewest_cycles && scales.cycles) line("fewest cycles", *answer.fewest_cycles, "");
  } else {
    line("cheapest", *answer.cheapest, "");
    const auto neighbour = [&](const char* what, std::optional<std::size_t> at, const char* none) {
      if (at)
        line(what, *at, against(*answer.cheapest, *at));
      else
        text += fmt::format("  {:<14} {}\n", what, none);
    };
    if (demand.accuracy()) {
      if (answer.quickest) line("quickest", *answer.quickest, "");
      neighbour("cheaper", answer.cheaper, "none");
      neighbour("more accurate", answer.accurate, demand.seconds ? "none within that time" : "none");
    } else {
      neighbour("most accurate", answer.best_met, "");
    }
  }
  const auto uncounted = [&](std::size_t count, const char* why) {
    if (count == 0) return;
    text += fmt::format("  {} point{}: {}{}\n", count, count == 1 ? "" : "s",
                        demand.accuracy() ? "accurate enough, but " : "", why);
  };
  uncounted(answer.unknown, "the clock is not known (--place, or --clock)");
  uncounted(answer.no_room, "too large for the device");
  return text + knobs_text(market, records) + front_text(market, answer, demand, records);
}

}  // namespace halfway::study
