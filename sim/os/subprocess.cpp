// SPDX-License-Identifier: Apache-2.0
#include "sim/os/subprocess.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "sim/os/descriptor.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_kept_output = 32U << 10;  ///< bytes kept of the start and of the end

/// Keeps the start and the end of a program's output.
class KeptOutput {
 public:
  void add(const char* bytes, std::size_t count) {
    const std::size_t to_head = std::min(count, c_kept_output - head_.size());
    head_.append(bytes, to_head);
    tail_.append(bytes + to_head, count - to_head);
    if (tail_.size() > 2 * c_kept_output) {
      left_out_ += tail_.size() - c_kept_output;
      tail_.erase(0, tail_.size() - c_kept_output);
    }
  }
  std::string text() const {
    return left_out_ == 0 ? head_ + tail_
                          : fmt::format("{}\n... {} bytes left out ...\n{}", head_, left_out_, tail_);
  }

 private:
  std::string head_, tail_;
  std::size_t left_out_ = 0;
};

struct Pipe {
  Descriptor reader, writer;
  bool open() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return false;
    reader.reset(ends[0]);
    writer.reset(ends[1]);
    return true;
  }
};

struct Start {
  const char* program;
  char* const* arguments;
  char* const* variables;
  const char* folder;  ///< empty: the caller's folder
  int input, output, error;
  int failure;  ///< receives errno if the program does not start
  pid_t parent;
};

/// Return the child's process id, or -1. Until exec, the child runs in the parent's memory while the parent
/// waits (vfork), so it may only make system calls. A fork would copy the page tables and later every written
/// page; that takes longer than many of the programs run.
[[gnu::noinline]] pid_t start(const Start& s) {
  const pid_t child = ::vfork();
  if (child != 0) return child;
  ::setpgid(0, 0);                     // own process group: a timeout ends the child and all its children
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // the child ends when this process ends for any reason
  const bool orphan = ::getppid() != s.parent;
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (!orphan && ::dup2(s.input, 0) >= 0 && ::dup2(s.output, 1) >= 0 && ::dup2(s.error, 2) >= 0 &&
      (*s.folder == '\0' || ::chdir(s.folder) == 0)) {
    ::execve(s.program, s.arguments, s.variables);
  }
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(s.failure, &error, sizeof error);
  ::_exit(127);
}

}  // namespace

std::string ProcessEnd::how() const {
  if (timed_out) return "stopped because it ran out of time";
  if (signal != 0) return fmt::format("killed by signal {} ({})", signal, ::strsignal(signal));
  return fmt::format("exit status {}", exit_status);
}

std::string shell_word(std::string_view word) {
  std::string text = "'";
  for (const char c : word) c == '\'' ? text += "'\\''" : text += c;
  return text + "'";
}

std::string to_string(const Command& command) {
  std::string text;
  for (const std::string& argument : command.arguments) {
    if (!text.empty()) text += ' ';
    const bool plain =
        !argument.empty() && argument.find_first_not_of(
                                 "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                                 "_-+=./:,@%") == std::string::npos;
    text += plain ? argument : shell_word(argument);
  }
  return text;
}

std::string failed_text(const std::string& doing, const Command& command, const ProcessEnd& end) {
  return fmt::format("{}: {} failed ({}):\n{}\n  while running: {}", doing, command.arguments.front(),
                     end.how(), end.output, to_string(command));
}

std::filesystem::path find_program(const std::string& name) {
  const auto runs = [](const std::filesystem::path& path) {
    struct stat status;
    return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && ::access(path.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos)
    return runs(name) ? std::filesystem::path(name) : std::filesystem::path();
  const char* variable = std::getenv("PATH");
  std::string_view rest = variable == nullptr ? "/usr/bin:/bin" : variable;
  while (true) {
    const std::size_t colon = rest.find(':');
    const std::string_view folder = rest.substr(0, colon);
    const auto path = std::filesystem::path(folder.empty() ? "." : folder) / name;
    if (runs(path)) return path;
    if (colon == std::string_view::npos) return {};
    rest.remove_prefix(colon + 1);
  }
}

Result<ProcessEnd> run_process(const Command& command, const std::string& install) {
  const std::string& name = command.arguments.front();
  Descriptor input(command.standard_input);
  std::filesystem::path program = find_program(name);
  if (program.empty()) return tool_failed(fmt::format("{}: not found; install it with: {}", name, install));
  // The child may change its folder first, and PATH may contain relative paths.
  program = std::filesystem::absolute(program);

  Pipe output, failure;
  if (input.get() < 0) input.reset(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  Descriptor file;
  if (!output.open() || !failure.open() || input.get() < 0) {
    return tool_failed(fmt::format("{}: cannot start: {}", name, std::strerror(errno)));
  }
  if (!command.standard_output.empty()) {
    file.reset(::open(command.standard_output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (file.get() < 0) {
      return tool_failed(
          fmt::format("{}: cannot write: {}", command.standard_output.string(), std::strerror(errno)));
    }
  }

  // Allocate all memory before the child starts: another thread may hold the allocator's lock.
  std::vector<char*> arguments;
  for (const std::string& argument : command.arguments)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  std::vector<std::string> own_variables;
  std::vector<char*> variables;
  for (const auto& [key, value] : command.environment) own_variables.push_back(key + '=' + value);
  for (std::string& variable : own_variables) variables.push_back(variable.data());
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const bool replaced =
        std::any_of(command.environment.begin(), command.environment.end(),
                    [&](const auto& pair) { return text.substr(0, text.find('=')) == pair.first; });
    if (!replaced) variables.push_back(*variable);
  }
  variables.push_back(nullptr);
  const pid_t child = start({.program = program.c_str(),
                             .arguments = arguments.data(),
                             .variables = variables.data(),
                             .folder = command.working_folder.c_str(),
                             .input = input.get(),
                             .output = file.get() >= 0 ? file.get() : output.writer.get(),
                             .error = output.writer.get(),
                             .failure = failure.writer.get(),
                             .parent = ::getpid()});
  if (child < 0) return tool_failed(fmt::format("{}: cannot start: {}", name, std::strerror(errno)));
  ::setpgid(child, child);
  input.reset();
  output.writer.reset();
  failure.writer.reset();
  file.reset();

  int error = 0;
  ssize_t got;
  while ((got = ::read(failure.reader.get(), &error, sizeof error)) < 0 && errno == EINTR) {
  }
  if (got > 0) {
    ::waitpid(child, nullptr, 0);
    return tool_failed(fmt::format("{}: cannot start: {}", program.string(), std::strerror(error)));
  }

  ProcessEnd end;
  KeptOutput kept;
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  Clock::time_point next_poll = start + command.poll_interval;
  std::vector<char> chunk(1U << 16);
  int status = 0;
  bool exited = false, open = true;
  Clock::time_point exit_time{};
  while (!exited || open) {
    if (!exited) {
      exited = ::waitpid(child, &status, WNOHANG) == child;
      if (exited) exit_time = Clock::now();
    }
    const Clock::time_point now = Clock::now();
    // A grandchild may keep the pipe open. Wait at most one second after the child's end.
    if (exited && now - exit_time > std::chrono::seconds(1)) break;
    if (!exited && !end.timed_out && command.timeout && now - start >= *command.timeout) {
      end.timed_out = true;
      ::kill(-child, SIGKILL);
    }
    if (command.on_poll && now >= next_poll) {
      command.on_poll();
      next_poll = now + command.poll_interval;
    }
    pollfd watched{output.reader.get(), POLLIN, 0};
    // Closing the pipe wakes poll at once, usually when the child ends. Poll for the end of a child that
    // closed it earlier.
    const int wait_ms = open ? (exited ? 10 : 20) : 1;
    const int ready = ::poll(open ? &watched : nullptr, open ? 1 : 0, wait_ms);
    if (open && ready > 0) {
      got = ::read(output.reader.get(), chunk.data(), chunk.size());
      if (got > 0) kept.add(chunk.data(), static_cast<std::size_t>(got));
      if (got == 0 || (got < 0 && errno != EINTR)) open = false;
    }
  }
  ::kill(-child, SIGKILL);  // remaining processes of its group
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  if (WIFEXITED(status)) end.exit_status = WEXITSTATUS(status);
  end.output = kept.text();
  return end;
}

}  // namespace halfway
