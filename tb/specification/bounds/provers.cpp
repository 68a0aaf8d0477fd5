// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include "registry.hpp"
#include "sim/os/file.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::bounds {

void prove(const Context& context, const std::string& script, double limit, Finding& finding) {
  if (context.quick) return;
  const auto folder = TemporaryFolder::make(std::filesystem::temp_directory_path());
  if (!folder) {
    finding.failure = folder.error().message;
    return;
  }
  const std::filesystem::path file = folder->path() / "bound.gappa";
  const auto written = write_file(file, script);
  const auto end = run_process({.arguments = {"gappa", file.string()}, .timeout = std::chrono::minutes(60)},
                               "apt-get install gappa");
  if (!written || !end)
    finding.failure = (written ? end.error() : written.error()).message;
  else if (end->succeeded())
    finding.proved = limit;
  else  // the last part of the output names what could not be proved
    finding.failure = "Gappa does not prove it: " +
                      end->output.substr(std::min(end->output.rfind("Error"), end->output.size()));
}

}  // namespace halfway::bounds
