// SPDX-License-Identifier: Apache-2.0
#include "sim/study/host_setup.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "setup/spherical_setup.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/sanitizers.hpp"
#include "sim/os/seconds.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/study/hardware.hpp"

namespace halfway::study {
namespace {

constexpr std::chrono::minutes c_longest{60};
constexpr std::size_t c_longest_name = 512;
constexpr std::string_view c_totals = "\ntotals: ";

// Runs of a measurement of time: at least, at most, and the time after which there are enough.
constexpr std::size_t c_fewest_runs = 3, c_most_runs = 100;
constexpr double c_enough_ns = 1e8;
constexpr int c_mesa_runs = 20;  // milliseconds each

// The quickest run: other work on the machine makes a run longer, never shorter.
template <class Work>
double quickest_ns(const Work& work) {
  double quickest = std::numeric_limits<double>::infinity(), whole = 0;
  for (std::size_t run = 0; run < c_fewest_runs || (run < c_most_runs && whole < c_enough_ns); ++run) {
    const double start = thread_seconds();
    work();
    const double taken = 1e9 * (thread_seconds() - start);
    quickest = std::min(quickest, taken);
    whole += taken;
  }
  return quickest;
}

}  // namespace

HostWork set_up_frame(const Scene& scene, FrameSize size, const HardwareKey& key, const SetupOptions& options,
                      const Models& models) {
  const std::unique_ptr<Setup> setup = models.setup(scene, size, key, options);
  HostWork work;
  std::vector<std::uint32_t> words;
  setup->append_prologue(words, work.counts);
  work.words = words.size();
  const std::unique_ptr<SetupWorker> worker = setup->worker();
  for (std::uint32_t unit = 0; unit < setup->units(); ++unit) {
    words.clear();
    worker->append(unit, words, work.counts);
    work.words += words.size();
  }
  return work;
}

SetupOptions frame_setup(const DesignPoint& point, const Scene& scene) {
  SetupOptions options = point.setup();
  if (point.method == Method::spherical && point.preset == Preset::exact)
    options.spherical.bells = std::make_shared<const Bells>(fitted_bells(scene));
  return options;
}

HostTime host_time(const DesignPoint& point, const std::string& scene_name, const SimulatorFolders& folders) {
  if (point.method == Method::phong_mesa) {
    MesaRequest request = mesa_request(point, scene_name);
    request.repetitions = c_mesa_runs;
    return {.ns = 1e9 * draw_by_mesa(request, folders.source).seconds, .words = 0};
  }
  const Scene scene = drawn_scene(scene_name, folders.source / "sim" / "scenes", point);
  if (in_hardware(point.method)) {
    const PointHardware hardware = drawing_hardware_of(point, scene, folders);
    const SetupOptions options = frame_setup(point, scene);
    HostTime time;
    time.ns = quickest_ns(
        [&] { time.words = set_up_frame(scene, point.size, hardware.key, options, hardware.models).words; });
    return time;
  }
  const RenderOptions options{.frame = point.size};
  const auto draw = point.method == Method::gouraud ? render_gouraud : render_reference;
  return {.ns = quickest_ns([&] { draw(scene, Projector(scene, point.size, {}).project_all(), options); }),
          .words = 0};
}

void in_processes(const std::filesystem::path& names, const std::function<void(const std::string&)>& each) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(names.c_str(), "r"), &std::fclose);
  if (!file) throw_bad_input("{}: {}", names.string(), std::strerror(errno));
  std::array<char, c_longest_name> line{};
  // This process allocates nothing from here on.
  while (std::fgets(line.data(), static_cast<int>(line.size()), file.get()) != nullptr) {
    line[std::strcspn(line.data(), "\n")] = '\0';
    const pid_t child = fork();
    if (child < 0) throw_tool_failed("fork: {}", std::strerror(errno));
    if (child == 0) {
      const Status done = caught([&] { each(line.data()); });
      if (!done) fmt::print(stderr, "{}\n", done.error().message);
      // Not every stream: that would move the offset of the names, which the processes share.
      std::fflush(stdout);
      std::_Exit(done ? 0 : 1);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (status != 0) throw_tool_failed("{}: could not be set up", line.data());
    dprintf(STDOUT_FILENO, "%d %s\n", child, line.data());
  }
}

std::optional<std::vector<std::uint64_t>> host_instructions(std::vector<std::string> worker,
                                                            const std::vector<std::string>& names,
                                                            const std::filesystem::path& scratch) {
  if (c_sanitized || find_program("valgrind").empty()) return std::nullopt;
  const TemporaryFolder folder = must(TemporaryFolder::make(scratch));
  // LD_BIND_NOW: otherwise the first call of a library function would cost more instructions than later
  // calls.
  Command command{.arguments = {"valgrind", "--tool=callgrind", "--quiet", "--toggle-collect=*set_up_frame*",
                                fmt::format("--callgrind-out-file={}/%p", folder.path().string())},
                  .standard_output = folder.path() / "processes",
                  .environment = {{"LD_BIND_NOW", "1"}},
                  .timeout = c_longest};
  const std::filesystem::path list = folder.path() / "names";
  must(write_file(list, fmt::format("{}\n", fmt::join(names, "\n"))));
  // The program stores this file name, and its length shifts the heap. /dev/stdin has the same length on
  // every machine.
  worker.insert(worker.end(), {"--set-up", "/dev/stdin"});
  command.arguments.insert(command.arguments.end(), worker.begin(), worker.end());
  command.standard_input = ::open(list.c_str(), O_RDONLY | O_CLOEXEC);
  if (command.standard_input < 0) throw_tool_failed("{}: {}", list.string(), std::strerror(errno));
  const ProcessEnd end = must(run_process(command, c_install_valgrind));
  const auto failed = [&](const std::string& what) {
    return Failure{tool_failed(fmt::format("valgrind: {}\n  while running: {}", what, to_string(command)))};
  };
  if (!end.succeeded()) throw failed(end.how() + ": " + end.output);
  std::istringstream lines(must(read_file(command.standard_output)));
  std::vector<std::uint64_t> counted;
  std::string line;
  for (const std::string& name : names) {
    const std::size_t space = std::getline(lines, line) ? line.find(' ') : std::string::npos;
    if (space == std::string::npos || line.substr(space + 1) != name) throw failed("no process of " + name);
    const auto text = read_file(folder.path() / line.substr(0, space));
    if (!text) throw failed(text.error().message);
    std::uint64_t instructions = 0;
    if (const std::size_t at = text->find(c_totals); at != std::string::npos)
      std::from_chars(text->data() + at + c_totals.size(), text->data() + text->size(), instructions);
    if (instructions == 0) throw failed("no instructions of set_up_frame counted for " + name);
    counted.push_back(instructions);
  }
  return counted;
}

}  // namespace halfway::study
