// SPDX-License-Identifier: Apache-2.0
#include "sim/run/video.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/socket.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "sim/os/must.hpp"

namespace halfway {
namespace {

constexpr const char* c_install = "apt-get install ffmpeg";
constexpr std::chrono::seconds c_patience{2};  // waiting time for ffmpeg's end
// Endings of files that always contain one video. Other endings mean images, sound or playlists to ffmpeg, or
// are unknown.
constexpr std::string_view c_endings[] = {".mp4", ".m4v", ".mov", ".mkv", ".webm", ".avi",
                                          ".ogv", ".ts",  ".flv", ".wmv", ".gif"};

bool is_ending(std::string ending) {
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::ranges::find(c_endings, ending) != std::end(c_endings);
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

TemporaryFolder temporary_beside(const std::filesystem::path& file) {
  return must(TemporaryFolder::make(folder_of(file)));
}

}  // namespace

void VideoWriter::check(const std::filesystem::path& file) {
  const auto refuse = [](const std::string& why) { throw_bad_input("--video: {}", why); };
  if (!file.has_filename() || !file.has_extension())
    refuse(fmt::format("'{}' is not the name of a video; give a file such as turn.mp4", file.string()));
  if (!is_ending(file.extension().string()))
    refuse(fmt::format("'{}' does not have the ending of a video; take one of {}", file.string(),
                       fmt::join(c_endings, " ")));
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    refuse(fmt::format("{} is a folder; name a file", file.string()));
  if (find_program("ffmpeg").empty())
    throw_tool_failed("ffmpeg: not found, and --video needs it; install it with: {}", c_install);
  temporary_beside(file);
}

VideoWriter::VideoWriter(const std::filesystem::path& file, FrameSize size, unsigned rate)
    : file_(file), folder_(temporary_beside(file)) {
  // A socket instead of a pipe: writing after ffmpeg's end then returns an error without a signal.
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw_tool_failed("ffmpeg: cannot be given frames: {}", std::strerror(errno));
  input_.reset(ends[0]);
  Command command{
      .arguments = {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y"},
      .standard_input = ends[1],
  };
  const auto add = [&](std::initializer_list<std::string> more) {
    command.arguments.insert(command.arguments.end(), more);
  };
  add({"-f", "rawvideo", "-pix_fmt", "rgb24", "-s", to_string(size), "-r", std::to_string(rate)});
  // Most players support only 4:2:0, which needs even sizes.
  add({"-i", "pipe:0", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"});
  add({(folder_.path() / file_.filename()).string()});
  ffmpeg_ = std::async(std::launch::async,
                       [command = std::move(command)] { return run_process(command, c_install); });
}

VideoWriter::~VideoWriter() {
  input_.reset();
  if (ffmpeg_.valid()) ffmpeg_.wait();
}

void VideoWriter::add(const Frame& frame) {
  const std::uint8_t* bytes = frame.rgb.data();
  for (std::size_t left = frame.rgb.size(); left > 0;) {
    const ssize_t sent = ::send(input_.get(), bytes, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) {
      finish();
      throw_tool_failed("ffmpeg: stopped reading frames without a message");
    }
    bytes += sent;
    left -= static_cast<std::size_t>(sent);
  }
}

void VideoWriter::finish() {
  input_.reset();
  const ProcessEnd end = must(ffmpeg_.get());
  if (!end.succeeded())
    throw_tool_failed("{}: ffmpeg could not make it ({}):\n{}{}", file_.string(), end.how(), end.output,
                      room_note({folder_of(file_)}));
}

void VideoWriter::commit() {
  finish();
  std::error_code error;
  std::filesystem::rename(folder_.path() / file_.filename(), file_, error);
  if (error) throw_tool_failed("{}: cannot move the video here: {}", file_.string(), error.message());
}

void VideoWriter::abandon() const {
  ::shutdown(input_.get(), SHUT_RDWR);
  if (const auto ffmpeg = ffmpeg_; ffmpeg.valid()) ffmpeg.wait_for(c_patience);
  std::error_code ignored;
  std::filesystem::remove_all(folder_.path(), ignored);
}

}  // namespace halfway
