// SPDX-License-Identifier: Apache-2.0
#include "mesh_files/text_lines.hpp"

#include <algorithm>

namespace halfway {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

}  // namespace

TextLines::TextLines(std::string_view text, std::string_view file, Syntax syntax)
    : text_(text), file_(file), syntax_(syntax) {
  if (text_.starts_with(c_byte_order_mark)) at_ = c_byte_order_mark.size();
}

bool TextLines::next() {
  if (line_ > 0) {
    while (!word().empty()) {
    }
    if (at_ == text_.size()) return false;
    skip_line_end();
  }
  line_ = ends_ + 1;
  return at_ < text_.size();
}

std::string_view TextLines::word() {
  // Skip blanks, continued line ends and a comment.
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (is_continued(at_)) {
      ++at_;
      skip_line_end();
    } else {
      break;
    }
  }
  if (syntax_.comments && at_ < text_.size() && text_[at_] == '#') {
    at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
  }

  const std::size_t first = at_;
  while (!is_at_line_end() && !is_blank(text_[at_]) && !is_continued(at_)) ++at_;
  return text_.substr(first, at_ - first);
}

std::string_view TextLines::rest() {
  while (!is_at_line_end() && is_blank(text_[at_])) ++at_;
  const std::size_t first = at_;
  at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
  std::size_t last = at_;
  while (last > first && is_blank(text_[last - 1])) --last;
  return text_.substr(first, last - first);
}

std::string TextLines::place() const {
  return std::string(file_) + ":" + std::to_string(line_);
}

Error TextLines::error(std::string_view what) const {
  return bad_input(place() + ": " + std::string(what));
}

/// True for a backslash before a line end.
bool TextLines::is_continued(std::size_t at) const {
  return text_[at] == '\\' && syntax_.continuation && at + 1 < text_.size() &&
         (text_[at + 1] == '\n' || text_[at + 1] == '\r');
}

void TextLines::skip_line_end() {
  if (at_ == text_.size()) return;
  const bool is_pair = text_.substr(at_, 2) == "\r\n";
  at_ += is_pair ? 2 : 1;
  ++ends_;
}

}  // namespace halfway
