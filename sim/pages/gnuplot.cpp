// SPDX-License-Identifier: Apache-2.0
#include "sim/pages/gnuplot.hpp"

#include <fmt/format.h>

#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway {

Result<std::string> run_gnuplot(std::string_view script, const std::filesystem::path& folder,
                                const std::string& name) {
  const std::filesystem::path file = folder / (name + ".gnuplot"), picture = folder / (name + ".raw.svg");
  if (Status s = write_file(file, fmt::format("set output '{}'\n{}", picture.filename().string(), script));
      !s)
    return s.error();
  const auto end = run_process({.arguments = {"gnuplot", file.filename().string()},
                                .working_folder = folder,
                                .environment = {{"LC_ALL", "C.UTF-8"}}},
                               "apt-get install gnuplot-nox");
  if (!end) return end.error();
  if (!end->succeeded() || !end->output.empty())
    return tool_failed(fmt::format("{}: gnuplot: {}: {}", file.string(), end->how(), end->output));
  auto svg = read_file(picture);
  std::error_code ignored;
  std::filesystem::remove(picture, ignored);
  return svg;
}

}  // namespace halfway
