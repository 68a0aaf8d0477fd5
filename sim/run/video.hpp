// SPDX-License-Identifier: Apache-2.0
// Write frames to a video file by ffmpeg.
#pragma once

#include <filesystem>
#include <future>

#include "frame/frame.hpp"
#include "sim/os/descriptor.hpp"
#include "sim/os/file.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway {

/// Writes a temporary file next to `file`. `commit` renames it; without `commit` an existing file stays. The
/// file's ending selects the format.
class VideoWriter {
 public:
  /// Check that a video can be written: bad_input for a wrong folder, name or ending, tool_failed without
  /// ffmpeg.
  static void check(const std::filesystem::path& file);

  /// All frames have the given size; `rate` frames per second.
  VideoWriter(const std::filesystem::path& file, FrameSize size, unsigned rate);
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;
  ~VideoWriter();

  void add(const Frame& frame);
  void commit();
  /// End ffmpeg and remove the unfinished file. Called from another thread that is about to end the process.
  void abandon() const;

 private:
  /// Signal the end of the frames and wait for ffmpeg.
  void finish();

  std::filesystem::path file_;
  TemporaryFolder folder_;
  Descriptor input_;  ///< of ffmpeg
  std::shared_future<Result<ProcessEnd>> ffmpeg_;
};

}  // namespace halfway
