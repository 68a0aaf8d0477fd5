// SPDX-License-Identifier: Apache-2.0
// The words of a text file, line by line.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway {

inline constexpr std::string_view c_byte_order_mark = "\xef\xbb\xbf";
/// What is wrong with text that starts with the mark of UTF-16; empty for other text.
inline std::string_view utf16_fault(std::string_view text) {
  return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") ? "the text is UTF-16; save it as UTF-8"
                                                                      : "";
}

template <class Words>
bool contains(const Words& words, std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

/// Lines end with LF, CR LF or CR. Words are separated by blanks. With `comments`, '#' at the start of a word
/// begins a comment up to the end of the line. With `continuation`, a backslash at the end of a line, outside
/// a comment, joins it with the next line. A byte order mark at the start is skipped.
class TextLines {
 public:
  struct Syntax {
    bool comments = true;
    bool continuation = true;
  };

  TextLines(std::string_view text, std::string_view file, Syntax syntax);

  /// Go to the next line. False at the end of the text.
  bool next();
  /// Return the next word of the line; empty at its end.
  std::string_view word();
  /// Return the rest of the line, without blanks at its ends. It may contain '#'. The line is not continued.
  std::string_view rest();
  /// The number of the line, from 1; of joined lines the first.
  std::uint64_t line() const { return line_; }
  /// `file:line`.
  std::string place() const;
  /// An error at the line: `file:line: what`.
  Error error(std::string_view what) const;

 private:
  bool is_at_line_end() const { return at_ == text_.size() || text_[at_] == '\n' || text_[at_] == '\r'; }
  bool is_continued(std::size_t at) const;
  void skip_line_end();

  std::string_view text_;
  std::string_view file_;
  Syntax syntax_;
  std::size_t at_ = 0;
  std::uint64_t ends_ = 0;  ///< line ends before at_
  std::uint64_t line_ = 0;
};

}  // namespace halfway
