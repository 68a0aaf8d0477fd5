// SPDX-License-Identifier: Apache-2.0
#include "judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "plan/plan.hpp"
#include "setup/setup.hpp"
#include "sim/compare/limits.hpp"
#include "sim/ghdl/ghdl_runner.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/stream_files/init_file.hpp"
#include "sim/stream_files/trace.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/subprocess.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway::mutants {
namespace {

constexpr FrameSize c_frame{32, 24};
constexpr double c_least_seconds = 20.0;  // of a processor
constexpr double c_times_as_long = 4.0;
constexpr std::chrono::hours c_hung{1};
constexpr std::chrono::minutes c_analysis{10};

struct FrameOf {
  const char* scene;
  Shader shader;
  Preset preset;
  bool all_effects;
  ProcessorForm form = ProcessorForm::unrolled;
};

// With every effect, and with those of a scene alone; grey and coloured.
constexpr FrameOf c_frames[] = {
    {"lights", Shader::quadratic, Preset::exact, true},
    {"matte", Shader::quadratic, Preset::exact, false},
    {"lights", Shader::quadratic, Preset::published, true},
    {"lights", Shader::spherical, Preset::exact, true},
    {"highlights", Shader::spherical, Preset::exact, false},
    {"matte", Shader::spherical, Preset::published, false},
    {"lights", Shader::spherical, Preset::published, true},
    {"shadows", Shader::processors, Preset::exact, true, ProcessorForm::folded},
    {"shadows", Shader::processors, Preset::exact, true, ProcessorForm::unrolled},
    {"shadows", Shader::processors, Preset::published, true, ProcessorForm::folded},
    {"shadows", Shader::processors, Preset::published, true, ProcessorForm::unrolled},
    {"matte", Shader::processors, Preset::exact, false, ProcessorForm::unrolled},
    {"highlights", Shader::processors, Preset::published, false, ProcessorForm::folded},
};

// `work.saturate` says that the file of entity saturate is used.
void add_used(const VhdlSource& source, const std::map<std::string, const VhdlSource*>& units,
              std::set<const VhdlSource*>& used) {
  if (!used.insert(&source).second) return;
  const std::string_view text = source.content;
  constexpr std::string_view mark = "work.";
  for (std::size_t at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at + 1)) {
    std::size_t end = at + mark.size();
    while (end < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_'))
      ++end;
    const auto unit = units.find(std::string(text.substr(at + mark.size(), end - at - mark.size())));
    if (unit != units.end()) add_used(*unit->second, units, used);
  }
}

std::string said_failure(const std::string& output) {
  return output.substr(0, 2000);
}

bool is_in(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

// `tb/x_tb.vhd:1:2:@123ns:(report note): x_tb: passed` ends at 123.
std::uint64_t end_of(const std::string& output, const std::string& top) {
  const std::size_t said = output.find("ns:(report note): " + top + ": passed");
  const std::size_t at = said == std::string::npos ? said : output.rfind('@', said);
  return at == std::string::npos ? 0 : std::strtoull(output.c_str() + at + 1, nullptr, 10);
}

// Without the line that says how many clocks it took.
std::string fragments_of(std::string trace) {
  const std::size_t at = trace.rfind("\ncycles ");
  if (at != std::string::npos) trace.erase(at, trace.find('\n', at + 1) - at);
  return trace;
}

}  // namespace

void in_parallel(unsigned workers, std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> threads;
  for (unsigned i = 0; i < std::max(1U, workers); ++i)
    threads.emplace_back([&] {
      for (std::size_t job; (job = next++) < count;) work(job);
    });
}

Remembered::Remembered(std::filesystem::path path) : path_(std::move(path)) {
  std::ifstream file(path_);
  for (std::string line; std::getline(file, line);)
    if (const std::size_t space = line.find(' '); space != std::string::npos)
      answers_[line.substr(0, space)] = line.substr(space + 1);
}

std::optional<std::string> Remembered::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto at = answers_.find(key);
  return at == answers_.end() ? std::nullopt : std::optional(at->second);
}

void Remembered::add(const std::string& key, const std::string& answer) {
  const std::lock_guard lock(mutex_);
  answers_[key] = answer;
  std::ofstream(path_, std::ios::app) << key << ' ' << answer << '\n';
}

Result<Judge> Judge::open(const Folders& folders, unsigned workers, bool with_frames,
                          const std::function<void(const std::string&)>& told) {
  Judge judge;
  judge.folders_ = folders;
  if (auto made = make_folders(folders.scratch); !made) return made.error();
  judge.remembered_ = std::make_unique<Remembered>(folders.scratch / "remembered");
  if (auto prepared = judge.prepare(workers, with_frames, told); !prepared) return prepared.error();
  return judge;
}

Status Judge::add_frames(std::vector<VhdlSource>& sources) {
  const std::filesystem::path folder = folders_.scratch / "frames";
  for (const FrameOf& of : c_frames) {
    const auto scene = load_scene(of.scene, folders_.source / "sim/scenes");
    if (!scene) return scene.error();
    PlanRequest request{.shader = of.shader, .preset = of.preset, .all_effects = of.all_effects};
    if (of.shader == Shader::processors) request.form = of.form;
    const auto plan = plan_scene(*scene, request);
    if (!plan) return plan.error();
    Test test;
    test.key = plan->key;
    test.name = fmt::format("{} {}", of.scene, plan->key.name());
    const std::size_t number = frames_.size();
    test.top = fmt::format("frame_{}_tb", number);
    test.golden = folder / fmt::format("{}.golden", number);
    test.init = folder / fmt::format("{}.init", number);

    const auto setup = make_setup(*scene, c_frame, plan->key, {});
    auto init = InitFileWriter::open(test.init, plan->key.name(), setup->init_bits());
    if (!init) return init.error();
    auto trace = TraceWriter::open(test.golden, plan->key.name());
    if (!trace) return trace.error();
    SceneStream stream(*setup, plan->key, 1);
    for (Batch batch; stream.next(batch);) {
      init->write(batch.init_words);
      trace->write(batch.golden);
    }
    if (auto done = init->commit(); !done) return done;
    if (auto done = trace->commit(); !done) return done;

    auto testbench = GhdlRunner::testbench(plan->key, folders_.source);
    if (!testbench) return testbench.error();
    for (std::size_t at; (at = testbench->content.find("frame_tb")) != std::string::npos;)
      testbench->content.replace(at, 8, test.top);
    testbench->name = fmt::format("tb/{}.vhd", test.top);
    for (const auto& [name, value] : plan->key.generics())
      test.arguments.push_back(fmt::format("-g{}={}", name, value));
    test.arguments.push_back("-gg_init_file=" + test.init.string());
    // Every clock of it stalls or not at random: what a stall disturbs is seen too.
    test.arguments.push_back("-gg_stall_seed=1");
    test.arguments.push_back(fmt::format("-gg_idle_limit={}", c_idle_limit));
    sources.push_back(std::move(*testbench));
    frames_.push_back(std::move(test));
  }
  return Ok{};
}

Status Judge::prepare(unsigned workers, bool with_frames,
                      const std::function<void(const std::string&)>& told) {
  auto rtl = read_rtl_sources(folders_.source);
  if (!rtl) return rtl.error();
  rtl_ = std::move(*rtl);
  std::vector<VhdlSource> sources = rtl_;
  for (const char* shared :
       {"tb/tb_pkg.vhd", "tb/shaders/shader_checker.vhd", "tb/illumination/processor_checker.vhd"}) {
    auto source = read_vhdl_source(folders_.source, shared);
    if (!source) return source.error();
    sources.push_back(std::move(*source));
  }
  const std::size_t first_testbench = sources.size();
  for (const char* stage :
       {"tables", "arithmetic", "stream", "interpolation", "raster", "illumination", "shaders"}) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folders_.source / "tb" / stage, error))
      if (entry.path().filename().string().ends_with("_tb.vhd"))
        names.push_back(entry.path().filename().string());
    if (names.empty()) return tool_failed(fmt::format("tb/{}: holds no testbench", stage));
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) {
      auto source = read_vhdl_source(folders_.source, fmt::format("tb/{}/{}", stage, name));
      if (!source) return source.error();
      Test test;
      test.top = std::filesystem::path(name).stem();
      test.name = test.top.substr(0, test.top.size() - 3);
      test.arguments = {"-gg_folder=" + (folders_.vectors / test.name).string()};
      if (!std::filesystem::exists(folders_.vectors / test.name))
        return bad_input(fmt::format("{}: holds no vectors for {}; halfway_vectors writes them",
                                     folders_.vectors.string(), test.top));
      testbenches_.push_back(std::move(test));
      sources.push_back(std::move(*source));
    }
  }
  if (with_frames) {
    told("frames by the golden model");
    if (auto added = add_frames(sources); !added) return added;
  }

  std::map<std::string, const VhdlSource*> units;
  for (const VhdlSource& source : sources)
    for (const std::string_view mark : {"\nentity ", "\npackage "})
      for (std::size_t at = source.content.find(mark); at != std::string::npos;
           at = source.content.find(mark, at + 1)) {
        const std::size_t name = at + mark.size();
        units.emplace(source.content.substr(name, source.content.find(' ', name) - name), &source);
      }
  for (std::size_t i = 0; i < testbenches_.size() + frames_.size(); ++i) {
    Test& test = i < testbenches_.size() ? testbenches_[i] : frames_[i - testbenches_.size()];
    std::set<const VhdlSource*> used;
    add_used(sources[first_testbench + i], units, used);
    for (const VhdlSource* source : used)
      if (source->name.starts_with("rtl/")) test.uses.insert(source->name.substr(4));
  }

  testbench_sources_.assign(sources.begin() + static_cast<std::ptrdiff_t>(rtl_.size()), sources.end());
  told("analysis");
  const auto tool = GhdlTool::find();
  if (!tool) return tool.error();
  const auto library = GhdlLibrary::open(*tool, sources, "", folders_.scratch / "cache");
  if (!library) return library.error();
  library_ = library->folder();
  back_end_ = tool->back_end;
  std::map<std::string, const VhdlSource*> rtl_files;
  for (const VhdlSource& source : rtl_) rtl_files[source.name.substr(4)] = &source;
  for (std::size_t i = 0; i < testbenches_.size() + frames_.size(); ++i) {
    Test& test = i < testbenches_.size() ? testbenches_[i] : frames_[i - testbenches_.size()];
    ContentHash hash;
    hash.add("test 1").add(tool->version).add(sources[first_testbench + i].content);
    for (std::size_t shared = rtl_.size(); shared < first_testbench; ++shared)
      hash.add(sources[shared].content);
    for (const std::string& file : test.uses) hash.add(file).add(rtl_files.at(file)->content);
    std::set<std::filesystem::path> data = {test.init, test.golden};
    if (test.golden.empty()) {
      data.clear();
      for (const auto& entry : std::filesystem::recursive_directory_iterator(folders_.vectors / test.name))
        if (entry.is_regular_file()) data.insert(entry.path());
    }
    for (const auto& path : data) {
      const auto content = read_file(path);
      if (!content) return content.error();
      hash.add(path.filename().string()).add(*content);
    }
    test.hash = hash.hex();
  }
  if (!with_frames) return Ok{};

  // Without a fault all must pass; how long each takes then is what a fault's run is measured by.
  std::vector<Test*> tests;
  for (Test& test : testbenches_) tests.push_back(&test);
  for (Test& test : frames_) tests.push_back(&test);
  // The longest first, as far as that is known.
  const auto key_of = [](const std::string& what) { return ContentHash().add("seconds").add(what).hex(); };
  for (Test* test : tests) {
    const auto before = remembered_->find(key_of(test->name));
    test->seconds = before ? std::strtod(before->c_str(), nullptr) : 0;
  }
  std::stable_sort(tests.begin(), tests.end(),
                   [](const Test* a, const Test* b) { return a->seconds > b->seconds; });
  std::mutex mutex;
  Status failed = Ok{};
  in_parallel(workers, tests.size(), [&](std::size_t i) {
    tests[i]->seconds = 1000;
    const auto began = std::chrono::steady_clock::now();
    auto folder = bench({});
    const std::string ends_key = ContentHash().add("ends").add(tests[i]->hash).hex();
    Result<Verdict> verdict = Verdict::survived;
    if (const auto ends = remembered_->find(ends_key)) {
      tests[i]->ends_ns = std::strtoull(ends->c_str(), nullptr, 10);
    } else {
      std::string output;
      verdict = folder.run_anew(*tests[i], &output);
      tests[i]->ends_ns = tests[i]->golden.empty() ? end_of(output, tests[i]->top) : 0;
      if (verdict && *verdict == Verdict::survived)
        remembered_->add(ends_key, std::to_string(tests[i]->ends_ns));
    }
    const std::lock_guard lock(mutex);
    tests[i]->seconds = seconds_since(began);
    // From an earlier run, where this one did not need it.
    const std::string key = key_of(tests[i]->hash);
    if (const auto before = remembered_->find(key))
      tests[i]->seconds = std::max(tests[i]->seconds, std::strtod(before->c_str(), nullptr));
    else
      for (const std::string& of : {key, key_of(tests[i]->name)})
        remembered_->add(of, fmt::format("{}", tests[i]->seconds));
    told(fmt::format("{} without a fault: {:.1f} s", tests[i]->name, tests[i]->seconds));
    if (!verdict) failed = verdict.error();
    if (verdict && *verdict != Verdict::survived)
      failed = Error{ExitCode::differs, fmt::format("{}: fails without any fault", tests[i]->name)};
  });
  return failed;
}

Status Judge::Bench::make() {
  if (folder_) return Ok{};
  auto folder = TemporaryFolder::make(judge_.folders_.scratch / "benches");
  if (!folder) return folder.error();
  std::error_code error;
  std::filesystem::copy(
      judge_.library_, folder->path(),
      std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing, error);
  if (error)
    return tool_failed(fmt::format("{}: cannot copy: {}", judge_.library_.string(), error.message()));
  if (!exchanged_.file.empty())
    if (auto written = write_file(folder->path() / "rtl" / exchanged_.file, exchanged_.content); !written)
      return written.error();
  folder_.emplace(std::move(*folder));
  return Ok{};
}

Result<Verdict> Judge::Bench::run(const Test& test) {
  const std::string key = ContentHash().add(test.hash).add(exchanged_.file).add(exchanged_.content).hex();
  if (const auto before = judge_.remembered_->find(key)) return static_cast<Verdict>(std::stoi(*before));
  const auto verdict = run_anew(test);
  if (verdict) judge_.remembered_->add(key, std::to_string(static_cast<int>(*verdict)));
  return verdict;
}

Result<Verdict> Judge::Bench::run_anew(const Test& test, std::string* output) {
  if (auto made = make(); !made) return made.error();
  // Analyses what hangs on the change and is needed here, no more.
  const auto made = run_process({.arguments = {"ghdl", "-m", "--std=08", test.top},
                                 .working_folder = folder_->path(),
                                 .timeout = c_analysis},
                                kInstallGhdl);
  if (!made) return made.error();
  if (made->timed_out) return tool_failed(fmt::format("{}: GHDL's analysis takes too long", test.top));
  if (!made->succeeded()) return Verdict::stillborn;

  // Processor time, which does not hang on what else the machine does.
  const int seconds = static_cast<int>(c_least_seconds + c_times_as_long * test.seconds);
  Command command{.arguments = {"sh", "-c", "ulimit -t \"$0\" && exec \"$@\"", std::to_string(seconds)},
                  .working_folder = folder_->path(),
                  .timeout = c_hung};
  // `ghdl -r` hides what ended a program that it linked.
  if (judge_.back_end_ == GhdlBackEnd::mcode)
    command.arguments.insert(command.arguments.end(), {"ghdl", "-r", "--std=08", test.top});
  else
    command.arguments.push_back("./" + test.top);
  command.arguments.insert(command.arguments.end(), test.arguments.begin(), test.arguments.end());
  const std::filesystem::path trace = folder_->path() / (test.top + ".trace");
  if (!test.golden.empty()) command.arguments.push_back("-gg_trace_file=" + trace.string());
  command.arguments.insert(command.arguments.end(), {"--ieee-asserts=disable", "--assert-level=error"});
  if (test.ends_ns > 0) command.arguments.push_back(fmt::format("--stop-time={}ns", 2 * test.ends_ns));
  const auto end = run_process(command, kInstallGhdl);
  if (!end) return end.error();
  if (output != nullptr) *output = end->output;
  if (end->timed_out || end->signal == SIGXCPU || end->signal == SIGKILL) return Verdict::killed_by_time;
  if (!end->succeeded()) {
    if (is_in(end->output, ": cannot open") || is_in(end->output, ": cannot write"))
      return tool_failed(fmt::format("{}: {}", test.top, said_failure(end->output)));
    if (is_in(end->output, "error during elaboration")) return Verdict::stillborn;
    return Verdict::killed;
  }
  if (test.golden.empty())
    return is_in(end->output, test.top + ": passed")      ? Verdict::survived
           : is_in(end->output, "stopped by --stop-time") ? Verdict::killed_by_time
                                                          : Verdict::killed;
  const auto golden = read_file(test.golden), drawn = read_file(trace);
  if (!golden) return golden.error();
  if (!drawn) return drawn.error();
  return fragments_of(*drawn) == *golden ? Verdict::survived : Verdict::killed;
}

Result<Verdict> Judge::run_verilated(const Test& frame, const Exchanged& exchanged) const {
  auto folder = TemporaryFolder::make(folders_.scratch / "benches");
  if (!folder) return folder.error();
  std::error_code error;
  constexpr auto options = std::filesystem::copy_options::recursive;
  for (const char* part : {"rtl", "sim"}) {
    std::filesystem::copy(folders_.source / part, folder->path() / part, options, error);
    if (error) return tool_failed(fmt::format("{}: cannot copy: {}", part, error.message()));
  }
  if (!exchanged.file.empty())
    if (auto written = write_file(folder->path() / "rtl" / exchanged.file, exchanged.content); !written)
      return written.error();
  auto simulator = VerilatorSimulator::open(frame.key, {folder->path(), folder->path() / "cache"},
                                            {.stall_seed = 1, .idle_limit = c_idle_limit});
  if (!simulator) return exchanged.file.empty() ? Result<Verdict>(simulator.error()) : Verdict::stillborn;
  const auto init = read_init_file(frame.init, frame.key.name());
  if (!init) return init.error();
  const auto golden = read_trace(frame.golden, frame.key.name());
  if (!golden) return golden.error();
  std::vector<Fragment> drawn;
  const std::size_t most = golden->fragments.size() + c_most_surplus;
  Status ran = simulator->run(init->words, init->size(), drawn, most);
  if (ran) ran = simulator->finish(drawn, most);
  if (!ran) return ran.error().code == ExitCode::differs ? Result<Verdict>(Verdict::killed) : ran.error();
  return drawn == golden->fragments ? Verdict::survived : Verdict::killed;
}

}  // namespace halfway::mutants
