// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include "registry.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::bounds {

std::optional<std::string> gappa(const Context& context, std::string_view script) {
  if (context.quick) return std::nullopt;
  const std::filesystem::path file = context.scratch / "bound.gappa";
  if (const auto written = write_file(file, script); !written) return written.error().message;
  const auto end = run_process({.arguments = {"gappa", file.string()}, .timeout = std::chrono::minutes(60)},
                               "apt-get install gappa");
  if (!end) return end.error().message;
  // The last part of Gappa's output names what it could not prove.
  return end->succeeded() ? std::string()
                          : end->output.substr(std::min(end->output.rfind("Error"), end->output.size()));
}

}  // namespace halfway::bounds
