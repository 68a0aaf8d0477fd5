// SPDX-License-Identifier: Apache-2.0
// Frames to a video file, by ffmpeg.
#pragma once

#include <filesystem>
#include <future>
#include <optional>

#include "common/result.hpp"
#include "frame/frame.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway {

/// Writes beside the file, and renames with `commit`: else what was there stays. The format is what ffmpeg
/// makes of the file's ending.
class VideoWriter {
 public:
  /// Whether a video could be written there: bad input where the folder or the name is none, or the ending no
  /// video's, tool_failed without ffmpeg.
  static Status check(const std::filesystem::path& file);

  /// `rate` frames a second, all of this size.
  static Result<VideoWriter> open(const std::filesystem::path& file, FrameSize size, unsigned rate);
  VideoWriter(VideoWriter&& other) noexcept;
  VideoWriter& operator=(VideoWriter&&) = delete;
  ~VideoWriter();

  Status add(const Frame& frame);
  Status commit();
  /// Ends ffmpeg and removes what is unfinished, from another thread that is about to end the process.
  void abandon() const;

 private:
  VideoWriter(std::filesystem::path file, TemporaryFolder folder)
      : file_(std::move(file)), folder_(std::move(folder)) {}
  /// The end of the frames; ffmpeg's own.
  Status finish();
  void close_input();

  std::filesystem::path file_;
  std::optional<TemporaryFolder> folder_;
  int input_ = -1;  ///< of ffmpeg
  std::shared_future<Result<ProcessEnd>> ffmpeg_;
};

}  // namespace halfway
