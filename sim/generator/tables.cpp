// SPDX-License-Identifier: Apache-2.0
// `halfway tables`: writes the generated files, or checks that the checkout's copies are current.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <tuple>

#include "sim/generator/generated_files.hpp"
#include "sim/os/command_line.hpp"
#include "sim/os/file.hpp"

namespace halfway::cli {
namespace {

struct TablesOptions {
  bool check = false;
  bool errors = false;
  std::string preset = "exact";
  std::optional<std::string> cosine;
};

tables::CosineSizes checked_sizes(const TablesOptions& o) {
  tables::CosineSizes sizes;
  if (!o.cosine) return sizes;
  const auto size = tables::parse_cosine_size(*o.cosine);
  if (!size) throw_bad_input("--cosine: '{}' is not {}", *o.cosine, tables::c_cosine_values);
  (o.preset == "exact" ? sizes.exact : sizes.published).front() = *size;
  return sizes;
}

void print_tables(const tables::CosineSizes& sizes) {
  for (const tables::CosineTable& table : tables::cosine_tables(sizes)) {
    const double error = tables::table_error(table);
    fmt::print(
        "{:<9}  cos^{:<2}  {:>5} address x data bits  {:>6} bits  largest error {:5.2f}/255 ({:.5f})\n",
        table.exact ? "exact" : "published", table.power, to_string(table.size), table.bits(), 255 * error,
        error);
  }
}

// Print the errors of a cos^2 table of each size: the data of the spherical paper's figure 11.
void print_errors(bool exact) {
  constexpr int c_fewest = 4, c_most = 10;
  fmt::print("cos^2, preset {}: largest error in 1/255\n{:>12}", exact ? "exact" : "published", "data bits");
  for (int data = c_fewest; data <= c_most; ++data) fmt::print("{:>7}", data);
  fmt::print("\n");
  for (int address = c_fewest; address <= c_most; ++address) {
    fmt::print("{:>2} {:<9}", address,
               address == c_fewest       ? "address"
               : address == c_fewest + 1 ? "bits"
                                         : "");
    for (int data = c_fewest; data <= c_most; ++data)
      fmt::print("{:>7.2f}", 255 * tables::table_error(tables::cosine_table(exact, 2, {address, data})));
    fmt::print("\n");
  }
}

// Names the sizes of the checkout's tables that this run removes.
void print_removed(const std::filesystem::path& checkout, const tables::CosineSizes& sizes) {
  const auto package = read_file(checkout / "rtl/tables/cosine_pkg.vhd");
  const tables::CosineSizes present = tables::cosine_sizes_in(package ? *package : "");
  for (const auto& [preset, before, kept] :
       {std::tuple{"exact", present.exact, sizes.exact}, {"published", present.published, sizes.published}})
    for (const tables::CosineSize size : before)
      if (std::ranges::find(kept, size) == kept.end())
        fmt::print(
            "preset {0}: the tables of {1} address x data bits go; for them again: make tables PRESET={0} "
            "COSINE={1}\n",
            preset, to_string(size));
}

int run(const Folders& folders, const TablesOptions& options) {
  const tables::CosineSizes sizes = checked_sizes(options);
  if (options.errors) {
    print_errors(options.preset == "exact");
    return static_cast<int>(ExitCode::equal);
  }
  bool differs = false;
  if (!options.check) print_removed(folders.source, sizes);
  if (options.check)
    for (const std::string& message : tables::stale_files(folders.source, sizes)) {
      fmt::print(stderr, "{}\n", message);
      differs = true;
    }
  for (const tables::GeneratedFile& file : tables::generated_files(folders.source, sizes)) {
    if (tables::first_different_line(folders.source, file) == 0) {
      fmt::print("{}: as generated\n", file.path.string());
    } else if (!options.check) {
      must(write_file(folders.source / file.path, file.text));
      fmt::print("{}: written\n", file.path.string());
    }
  }
  print_tables(sizes);
  return static_cast<int>(differs ? ExitCode::differs : ExitCode::equal);
}

}  // namespace

void add_tables(CLI::App& app, const Folders& folders, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "tables", "write the generated VHDL (formats, cosine tables) again; print the cost of the tables");
  auto options = std::make_shared<TablesOptions>();
  CLI::Option* check = command->add_flag("--check", options->check,
                                         "write nothing; exit 1 if a file is not as it would be written");
  command
      ->add_option("--preset", options->preset,
                   "preset of the cosine tables with these sizes: exact or published")
      ->check(CLI::IsMember({"exact", "published"}))
      ->capture_default_str();
  const tables::CosineSizes sizes;
  CLI::Option* cosine = command->add_option(
      "--cosine", options->cosine,
      fmt::format("{} (default: {} in preset exact, {} in published)", tables::c_cosine_values,
                  to_string(sizes.exact.front()), to_string(sizes.published.front())));
  command
      ->add_flag("--errors", options->errors,
                 "write nothing; print the largest error of cos^2 by address and data bits")
      ->excludes(check)
      ->excludes(cosine);
  command->callback([=, &folders, &exit_code] { exit_code = run(folders, *options); });
}

}  // namespace halfway::cli
