// SPDX-License-Identifier: Apache-2.0
// Format of the data from halfway_mesh_reader to `load_mesh`: plain values in sequence.
#pragma once

#include <cstdint>
#include <cstdio>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>

namespace halfway {

class ReplySink {
 public:
  explicit ReplySink(int descriptor) : file_(::fdopen(descriptor, "wb")) {}
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (std::fwrite(&value, sizeof value, 1, file_) != 1) throw std::bad_alloc();
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) put(c);
  }
  void finish() {
    if (std::fflush(file_) != 0) throw std::bad_alloc();
  }

 private:
  std::FILE* file_;
};

class ReplySource {
 public:
  explicit ReplySource(std::FILE* file) : file_(file) {}
  template <class T>
  T get() {
    T value{};
    if (std::fread(&value, sizeof value, 1, file_) != 1) failed_ = true;
    return value;
  }
  std::string get_text() {
    std::string text;
    for (auto left = get<std::uint64_t>(); left > 0 && !failed_; --left) text += get<char>();
    return text;
  }
  bool failed() const { return failed_; }

 private:
  std::FILE* file_;
  bool failed_ = false;
};

enum class ReplyKind : std::uint8_t { mesh, error };

/// Limit of the reader's processor time, enforced by the system.
inline constexpr unsigned c_reader_cpu_seconds = 300;

}  // namespace halfway
