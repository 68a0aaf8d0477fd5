// SPDX-License-Identifier: Apache-2.0
// `halfway tables`: writes the generated files, or checks that the checkout's copies are current.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>

#include "sim/generator/generated_files.hpp"
#include "sim/os/file.hpp"
#include "sim/os/program.hpp"

namespace halfway::cli {
namespace {

struct TablesOptions {
  bool check = false;
  bool errors = false;
  std::string preset = "exact";
  std::optional<std::string> address_bits, data_bits;
};

/// The parsed and checked settings.
struct TablesSettings {
  bool exact;
  tables::CosineSizes sizes;
};

TablesSettings checked(const TablesOptions& o) {
  if (o.preset != "exact" && o.preset != "published")
    throw_bad_input("--preset: '{}' is not a preset; take exact or published", o.preset);
  TablesSettings s{o.preset == "exact", {}};
  tables::CosineSize& size = (s.exact ? s.sizes.exact : s.sizes.published).front();
  for (const auto& [option, given, bits] :
       {std::tuple{"--address-bits", &o.address_bits, &tables::CosineSize::address_bits},
        std::tuple{"--data-bits", &o.data_bits, &tables::CosineSize::data_bits}}) {
    if (!*given) continue;
    const std::string& text = **given;
    const int smallest = tables::c_smallest_cosine_size.*bits, largest = tables::c_largest_cosine_size.*bits;
    int& number = size.*bits;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || rest != text.data() + text.size() || number < smallest || number > largest)
      throw_bad_input("{}: '{}' is not a whole number from {} to {}", option, text, smallest, largest);
  }
  return s;
}

void print_tables(const tables::CosineSizes& sizes) {
  for (const tables::CosineTable& table : tables::cosine_tables(sizes)) {
    const double error = tables::table_error(table);
    fmt::print(
        "{:<9}  cos^{:<2}  {:>2}/{:<2} address/data bits  {:>6} bits  largest error {:5.2f}/255 ({:.5f})\n",
        table.exact ? "exact" : "published", table.power, table.size.address_bits, table.size.data_bits,
        table.bits(), 255 * error, error);
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

// Sizes of the checkout's tables that this run would remove.
std::vector<tables::CosineSize> sizes_that_go(const std::filesystem::path& checkout, bool exact,
                                              const tables::CosineSizes& sizes) {
  const auto package = read_file(checkout / "rtl/tables/cosine_pkg.vhd");
  const tables::CosineSizes present = tables::cosine_sizes_in(package ? *package : "");
  std::vector<tables::CosineSize> gone = exact ? present.exact : present.published;
  const auto& kept = exact ? sizes.exact : sizes.published;
  std::erase_if(gone, [&](const auto& size) { return std::ranges::find(kept, size) != kept.end(); });
  return gone;
}

int run(const Folders& folders, const TablesOptions& options) {
  const TablesSettings settings = checked(options);
  if (options.errors) {
    print_errors(settings.exact);
    return static_cast<int>(ExitCode::equal);
  }
  bool differs = false;
  if (!options.check)
    for (const bool exact : {true, false})
      for (const tables::CosineSize size : sizes_that_go(folders.source, exact, settings.sizes))
        fmt::print(
            "preset {0}: the tables of {1}/{2} address/data bits go; for them again: make tables PRESET={0} "
            "ADDRESS_BITS={1} DATA_BITS={2}\n",
            exact ? "exact" : "published", size.address_bits, size.data_bits);
  if (options.check)
    for (const std::string& message : tables::stale_files(folders.source, settings.sizes)) {
      fmt::print(stderr, "{}\n", message);
      differs = true;
    }
  for (const tables::GeneratedFile& file : tables::generated_files(folders.source, settings.sizes)) {
    if (tables::first_different_line(folders.source, file) == 0) {
      fmt::print("{}: as generated\n", file.path.string());
    } else if (!options.check) {
      must(write_file(folders.source / file.path, file.text));
      fmt::print("{}: written\n", file.path.string());
    }
  }
  print_tables(settings.sizes);
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
      ->capture_default_str();
  const tables::CosineSizes sizes;
  const auto add_bits = [&](const char* name, const char* what, std::optional<std::string>& text,
                            int tables::CosineSize::* bits) {
    return command->add_option(
        name, text,
        fmt::format("{}, {} to {} (default: {} in preset exact, {} in published)", what,
                    tables::c_smallest_cosine_size.*bits, tables::c_largest_cosine_size.*bits,
                    sizes.exact.front().*bits, sizes.published.front().*bits));
  };
  CLI::Option* address = add_bits("--address-bits", "a table has 2^this entries", options->address_bits,
                                  &tables::CosineSize::address_bits);
  CLI::Option* data =
      add_bits("--data-bits", "bits of an entry", options->data_bits, &tables::CosineSize::data_bits);
  command
      ->add_flag("--errors", options->errors,
                 "write nothing; print the largest error of cos^2 by address and data bits")
      ->excludes(check)
      ->excludes(address)
      ->excludes(data);
  command->callback([=, &folders, &exit_code] { exit_code = run(folders, *options); });
}

}  // namespace halfway::cli
