// SPDX-License-Identifier: Apache-2.0
#include "sim/os/shared_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <new>

#include "sim/os/file.hpp"

namespace halfway {
namespace {

constexpr std::chrono::minutes c_build_timeout{120};

}  // namespace

Result<std::string> run_tool(Command command, const std::string& install, const std::string& doing) {
  command.timeout = c_build_timeout;
  const auto end = run_process(command, install);
  if (!end) return end.error();
  if (end->succeeded()) return end->output;
  return tool_failed(failed_text(doing, command, *end) +
                     room_note({command.working_folder, std::filesystem::temp_directory_path()}));
}

Result<std::string> ask(const std::vector<std::string>& question, const std::string& install) {
  auto answer = run_tool(Command{.arguments = question, .working_folder = {}, .standard_output = {}}, install,
                         "looking for " + question.front());
  if (!answer) return answer.error();
  while (!answer->empty() && answer->back() == '\n') answer->pop_back();
  return *answer;
}

namespace {

/// The processor that -march=native selects. Another machine may read a cache on a shared disk.
std::string processor() {
  const auto text = read_file("/proc/cpuinfo");
  if (!text) return "unknown";
  std::string found;
  for (const char* key : {"model name", "flags", "Features"}) {
    const std::size_t at = text->find(key);
    if (at != std::string::npos) found += text->substr(at, text->find('\n', at) - at);
  }
  return found;
}

}  // namespace

Result<Compiler> Compiler::find(const std::string& wanted) {
  Compiler found{!wanted.empty() ? wanted : (find_program("clang++").empty() ? "g++" : "clang++"), {}};
  const auto version = ask({found.program, "--version"}, c_install_compiler);
  if (!version) return version.error();
  found.identity = found.program + '\n' + *version + '\n' + processor();
  return found;
}

std::string optimization(const char* level) {
  const char* const quick = std::getenv("HALFWAY_QUICK_BUILDS");
  return quick != nullptr ? quick : level;
}

void* SharedLibrary::symbol(const char* name) const {
  return ::dlsym(handle_.get(), name);
}

Result<SharedLibrary> SharedLibrary::load(const std::filesystem::path& file) {
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const std::string why = ::dlerror();
    // What the loader says if the file, or a library that it needs, finds no memory.
    for (const char* full : {"failed to map segment", "Cannot allocate memory"})
      if (why.find(full) != std::string::npos) throw std::bad_alloc();
    return tool_failed(fmt::format("{}: cannot be loaded: {}; delete {} and try again", file.string(), why,
                                   file.parent_path().string()));
  }
  return SharedLibrary(std::shared_ptr<void>(handle, [](void* closing) { ::dlclose(closing); }), file);
}

}  // namespace halfway
