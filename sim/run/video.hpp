// SPDX-License-Identifier: Apache-2.0
// Write frames to a video file by ffmpeg.
#pragma once

#include <filesystem>
#include <future>
#include <optional>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway {

/// Writes a temporary file next to `file`. `commit` renames it; without `commit` an existing file stays. The
/// file's ending selects the format.
class VideoWriter {
 public:
  /// Check that a video can be written: bad_input for a wrong folder, name or ending, tool_failed without
  /// ffmpeg.
  static Status check(const std::filesystem::path& file);

  /// All frames have the given size; `rate` frames per second.
  static Result<VideoWriter> open(const std::filesystem::path& file, FrameSize size, unsigned rate);
  VideoWriter(VideoWriter&& other) noexcept;
  VideoWriter& operator=(VideoWriter&&) = delete;
  ~VideoWriter();

  Status add(const Frame& frame);
  Status commit();
  /// End ffmpeg and remove the unfinished file. Called from another thread that is about to end the process.
  void abandon() const;

 private:
  VideoWriter(std::filesystem::path file, TemporaryFolder folder)
      : file_(std::move(file)), folder_(std::move(folder)) {}
  /// Signal the end of the frames and wait for ffmpeg.
  Status finish();
  void close_input();

  std::filesystem::path file_;
  std::optional<TemporaryFolder> folder_;
  int input_ = -1;  ///< of ffmpeg
  std::shared_future<Result<ProcessEnd>> ffmpeg_;
};

}  // namespace halfway
