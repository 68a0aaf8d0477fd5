// SPDX-License-Identifier: Apache-2.0
// halfway_bounds: checks every bound that model/tables states of a format or a table: that its derivation
// comes to no more, that nothing found or proved exceeds it, and that something comes within a factor of two
// of it.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "registry.hpp"
#include "sim/program/program.hpp"
#include "sim/system/file.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::bounds {

std::string number(double value) {
  if (value == std::floor(value) && std::fabs(value) < 0x1p53) return fmt::format("{:.0f}", value);
  return std::fabs(value) >= 0.001 && std::fabs(value) < 1e6 ? fmt::format("{:.5g}", value)
                                                             : fmt::format("{:.4g}", value);
}

namespace {

struct Options {
  bool quick = false;
  std::filesystem::path page{}, scratch{};
  std::string part{};
};

std::vector<Check> all_checks() {
  std::vector<Check> all;
  for (const auto& family : {integer_checks(), difference_checks(), angle_checks(), root_checks(),
                             power_checks(), setup_checks(), sum_checks()})
    all.insert(all.end(), family.begin(), family.end());
  return all;
}

// What is wrong with a row; empty where nothing is. `ratio` is the worst found over what is stated.
struct Verdict {
  std::string wrong;
  double ratio = 0;
};

constexpr double c_tight = 0.5;      // of a bound that means something
constexpr double c_rounding = 1e-9;  // of the doubles that both sides are computed in, relative

Verdict judged(const tables::Bound& bound, double derived, double capacity, const Finding& finding,
               std::string_view roomy) {
  Verdict v;
  const auto wrong = [&](const std::string& why) { v.wrong += (v.wrong.empty() ? "" : "; ") + why; };
  if (!finding.failure.empty()) wrong(finding.failure);
  if (derived > bound.value * (1 + c_rounding))
    wrong(fmt::format("its derivation comes to {}", number(derived)));
  const double worst = std::max(finding.worst, 0.0);
  v.ratio = bound.value == 0 ? 1.0 : worst / bound.value;
  if (finding.of_stated > 0) v.ratio = finding.of_stated;
  if (v.ratio > 1 + c_rounding || worst > bound.value * (1 + c_rounding))
    wrong(fmt::format("{} was found: {}", number(worst), finding.where));
  if (finding.proved > bound.value * (1 + 0x1p-9))
    wrong(fmt::format("no less than {} is proved", number(finding.proved)));
  if (bound.kind == tables::Bound::Kind::range && bound.value > capacity)
    wrong(fmt::format("the format holds {} at most", number(capacity)));
  if (bound.kind == tables::Bound::Kind::range && 2 * bound.value < capacity && roomy.empty())
    wrong(fmt::format("the format holds {}, more than twice as much", number(capacity)));
  if (v.ratio < c_tight)
    wrong(fmt::format("nothing comes within a factor of two of it: {} of it at {}", number(v.ratio),
                      finding.where));
  return v;
}

const char* or_dash(const std::string& text) {
  return text.empty() ? "–" : text.c_str();
}

class Report {
 public:
  explicit Report(Options options) : options_(std::move(options)) {
    context_.quick = options_.quick;
    context_.scratch = options_.scratch;
  }

  Result<int> run() {
    auto scratch = TemporaryFolder::make(options_.scratch);
    if (!scratch) return scratch.error();
    context_.scratch = scratch->path();
    const auto presets = tables::preset_formats();
    std::vector<Check> checks = all_checks();
    std::vector<bool> used(checks.size(), false);
    for (const tables::PresetFormats& preset : presets) formats(preset, checks, used);
    for (std::size_t i = 0; i < checks.size(); ++i)
      if (!used[i] && options_.part.empty())
        fail(fmt::format("{} {} {}: a check of no bound", checks[i].preset, checks[i].name, checks[i].of));
    if (options_.part.empty()) {
      all_tables("cosine tables", cosine_tables(context_));
      all_tables("function tables", function_tables(context_));
      rule();
      drift();
    }
    fmt::print("\n{}\n{} bounds, {} of them wrong\n", page_, bounds_, wrong_);
    if (wrong_ == 0 && !options_.page.empty()) {
      if (const auto written = write_page(); !written) return written.error();
    }
    return wrong_;
  }

 private:
  void fail(const std::string& what) {
    ++wrong_;
    fmt::print("{}\n", what);
    std::fflush(stdout);
  }

  void formats(const tables::PresetFormats& preset, const std::vector<Check>& checks,
               std::vector<bool>& used) {
    page_ += fmt::format(
        "\n### Formats of preset `{}`\n\n| format | | bound | from | derived | found | of the bound | where "
        "| how | "
        "proved |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
        preset.name);
    for (const tables::Format& format : preset.formats) {
      if (format.name.find(options_.part) == std::string_view::npos) continue;
      if (format.bounds.empty()) fail(fmt::format("{} {}: no bound is stated", preset.name, format.name));
      for (const tables::Bound& bound : format.bounds) {
        const auto check = std::find_if(checks.begin(), checks.end(), [&](const Check& c) {
          return (c.preset == "both" || c.preset == preset.name) && c.name == format.name && c.of == bound.of;
        });
        const std::string name =
            fmt::format("{} {}{}{}", preset.name, format.name, bound.of.empty() ? "" : ", ", bound.of);
        if (check == checks.end()) {
          fail(fmt::format("{}: nothing checks it", name));
          continue;
        }
        used[static_cast<std::size_t>(check - checks.begin())] = true;
        const auto began = std::chrono::steady_clock::now();
        const Finding finding = check->run(context_, preset, format, bound);
        const double seconds = seconds_since(began);
        const double derived = tables::derived(preset, format, bound);
        // A signed format holds one more below zero.
        const double capacity = std::ldexp(1.0, format.integer_bits) - (format.is_signed ? 0 : format.unit());
        const Verdict verdict = judged(bound, derived, capacity, finding, check->roomy);
        ++bounds_;
        if (!verdict.wrong.empty()) fail(fmt::format("{}: {}", name, verdict.wrong));
        const std::string text =
            fmt::format("| `{}` {}{}.{} | {} | {}{}{} | `{}` | {} | {} | {:.2f} | {}{} | {} | {} |\n",
                        format.name, format.is_signed ? 's' : 'u', format.integer_bits, format.fraction_bits,
                        bound.kind == tables::Bound::Kind::range ? "range" : or_dash(std::string(bound.of)),
                        tables::shown(bound.value), bound.unit.empty() ? "" : " ", bound.unit,
                        bound.derivation, number(derived), number(finding.worst), verdict.ratio,
                        finding.where, check->roomy.empty() ? "" : fmt::format("; {}", check->roomy),
                        check->how, finding.proved > 0 ? number(finding.proved) : "–");
        page_ += text;
        fmt::print("{}: {:.2f} of {} ({:.1f} s)\n", name, verdict.ratio, tables::shown(bound.value), seconds);
        std::fflush(stdout);
      }
    }
  }

  void all_tables(std::string_view title, const std::vector<TableFinding>& findings) {
    page_ += fmt::format(
        "\n### {}\n\n| table | bound | found | of the bound | Sollya | where |\n| --- | --- | --- | --- | "
        "--- | --- |\n",
        std::string(1, static_cast<char>(title[0] - 'a' + 'A')) + std::string(title.substr(1)));
    for (const TableFinding& f : findings) {
      const double ratio = f.worst / f.bound;
      ++bounds_;
      if (ratio > 1 || f.derived > f.bound * (1 + c_rounding) || ratio < c_tight)
        fail(fmt::format("{}: {} of its bound {}, derived {}", f.table, number(ratio), number(f.bound),
                         number(f.derived)));
      if (!f.failure.empty()) fail(fmt::format("{}: {}", f.table, f.failure));
      page_ += fmt::format("| {} | {} | {} | {:.2f} | {} | {} |\n", f.table, number(f.bound), number(f.worst),
                           ratio, f.sollya > 0 ? number(f.sollya) : "–", f.where);
    }
  }

  void rule() {
    page_ +=
        "\n### The published rule of fraction bits\n\n| lines + pixels M | rule: bits | off by, colour steps "
        "| a "
        "pixel shown wrong by | ours: bits | bound | found | of the bound | the rule's triangle |\n| --- | "
        "--- | --- | "
        "--- | --- | --- | --- | --- | --- |\n";
    for (const RuleRow& row : rule_rows(context_)) {
      const double ratio = row.our_error / row.our_bound;
      ++bounds_;
      if (ratio > 1 || ratio < c_tight)
        fail(fmt::format("M = {}: {} of our bound", row.walked, number(ratio)));
      // With the rule's bits the error would stay below half a step if it were right.
      if (row.rule_error < 0.5 || row.rule_shown < 2)
        fail(fmt::format("M = {}: the published rule was not seen to fail", row.walked));
      page_ += fmt::format("| {} | {} | {:.2f} | {} | {} | {:.3f} | {:.3f} | {:.2f} | {} |\n", row.walked,
                           row.rule_bits, row.rule_error, row.rule_shown, row.our_bits, row.our_bound,
                           row.our_error, ratio, row.triangle);
    }
  }

  void drift() {
    page_ +=
        "\n### The spherical paper's angle: drift by bits below the table's address\n\n| bits below | steps "
        "| "
        "addresses, bound | found |\n| --- | --- | --- | --- |\n";
    for (const DriftRow& row : drift_rows()) {
      ++bounds_;
      if (row.addresses > row.bound || row.addresses < row.bound / 2)
        fail(fmt::format("{} bits below the address: {} of {} addresses", row.bits_below, row.addresses,
                         row.bound));
      page_ += fmt::format("| {} | {} | {} | {:.3f} |\n", row.bits_below, row.steps, number(row.bound),
                           row.addresses);
    }
  }

  Status write_page() const {
    auto text = read_file(options_.page);
    if (!text) return text.error();
    constexpr std::string_view c_first = "\n### Formats of preset";
    text->resize(std::min(text->find(c_first), text->size()));
    return write_file(options_.page, *text + page_);
  }

  Options options_;
  Context context_;
  std::string page_;
  int bounds_ = 0, wrong_ = 0;
};

int main_of(const Options& options) {
  for (const char* tool : {"gappa", "sollya"}) {
    if (options.quick || !find_program(tool).empty()) continue;
    fmt::print(stderr, "{0}: is missing; install it with: apt-get install {0}\n", tool);
    return static_cast<int>(ExitCode::tool_failed);
  }
  Report report(options);
  const auto wrong = report.run();
  if (!wrong) {
    fmt::print(stderr, "{}\n", wrong.error().message);
    return static_cast<int>(wrong.error().code);
  }
  return static_cast<int>(*wrong == 0 ? ExitCode::equal : ExitCode::differs);
}

}  // namespace
}  // namespace halfway::bounds

int main(int argc, char** argv) {
  using namespace halfway;
  bounds::Options options;
  CLI::App app{"Checks the bounds that formats and tables state", "halfway_bounds"};
  app.add_flag("--quick", options.quick, "strides in place of exhaustion, without Gappa and Sollya: seconds");
  app.add_option("--page", options.page, "file whose tables are written anew");
  app.add_option("SCRATCH", options.scratch, "folder for temporary files")->required();
  app.add_option("PART", options.part, "only entries whose names hold it");
  int exit_code = 0;
  app.callback([&] { exit_code = bounds::main_of(options); });
  return cli::run_program(app, argc, argv, exit_code);
}
