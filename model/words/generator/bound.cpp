// SPDX-License-Identifier: Apache-2.0
#include "words/generator/bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace halfway::tables {
namespace {

class Formula {
 public:
  Formula(std::string_view text, std::span<const Quantity> quantities)
      : text_(text), left_(text), quantities_(quantities) {}

  double value() {
    const double sum = this->sum();
    if (next() != '\0') fail("unexpected text");
    return sum;
  }

 private:
  [[noreturn]] void fail(std::string_view why) const {
    throw std::logic_error(fmt::format("formula '{}': {} before '{}'", text_, why, left_));
  }

  // The next non-space character; '\0' at the end.
  char next() {
    while (!left_.empty() && left_.front() == ' ') left_.remove_prefix(1);
    return left_.empty() ? '\0' : left_.front();
  }
  bool take(char c) {
    if (next() != c) return false;
    left_.remove_prefix(1);
    return true;
  }

  double sum() {
    double value = product();
    for (;;) {
      if (take('+'))
        value += product();
      else if (take('-'))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    double value = power();
    for (;;) {
      if (take('*'))
        value *= power();
      else if (take('/'))
        value /= power();
      else
        return value;
    }
  }
  // Its precedence is higher than that of a sign before it, lower than that of a sign in the exponent.
  double power() {
    if (take('-')) return -power();
    const double base = atom();
    return take('^') ? std::pow(base, power()) : base;
  }
  double atom() {
    if (take('(')) return bracketed();
    const char c = next();
    if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      double value = 0.0;
      const auto [end, error] = std::from_chars(left_.data(), left_.data() + left_.size(), value);
      if (error != std::errc{}) fail("no number");
      left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
      return value;
    }
    const auto end = std::ranges::find_if(
        left_, [](char l) { return std::isalnum(static_cast<unsigned char>(l)) == 0 && l != '_'; });
    const std::string_view name(left_.begin(), end);
    if (name.empty()) fail("a number or a name is missing");
    if (name == "sqrt") {
      left_.remove_prefix(name.size());
      if (!take('(')) fail("sqrt has no bracket");
      return std::sqrt(bracketed());
    }
    const auto quantity = std::ranges::find(quantities_, name, &Quantity::name);
    if (quantity == quantities_.end()) fail("no such quantity");
    left_.remove_prefix(name.size());
    return quantity->value;
  }
  double bracketed() {
    const double value = sum();
    if (!take(')')) fail("a closing bracket is missing");
    return value;
  }

  std::string_view text_, left_;
  std::span<const Quantity> quantities_;
};

}  // namespace

double evaluated(std::string_view formula, std::span<const Quantity> quantities) {
  return Formula(formula, quantities).value();
}

std::string shown(double value) {
  int exponent = 0;
  if (std::frexp(value, &exponent) == 0.5 && (value < 0.1 || value > 0x1p20))
    return fmt::format("2^{}", exponent - 1);
  return value == std::floor(value) && value < 0x1p53 ? fmt::format("{:.0f}", value)
                                                      : fmt::format("{:.3g}", value);
}

std::string to_string(const Bound& bound) {
  std::string text = bound.of.empty() ? "" : fmt::format("{}: ", bound.of);
  text += bound.kind == Bound::Kind::range ? "at most " : "off by at most ";
  text += shown(bound.value);
  if (!bound.unit.empty()) text += fmt::format(" {}", bound.unit);
  const std::string value = shown(bound.value);
  if (bound.derivation != value) text += fmt::format(": {}", bound.derivation);
  return text;
}

}  // namespace halfway::tables
