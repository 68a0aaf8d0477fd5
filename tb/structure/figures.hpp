// SPDX-License-Identifier: Apache-2.0
// Measured figures in the text of a page that a person writes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace halfway {

/// What a person writes of a page: its words, separated by one space each. Left out are comments, the parts
/// between
/// `<!-- NAME: written by COMMAND -->` and `<!-- end of NAME -->`, and code that the test `transcripts`
/// compares with what the program prints. A line of a table is enclosed in the words |.
class HandWritten {
 public:
  explicit HandWritten(std::string_view page);

  const std::string& text() const { return text_; }
  /// Line of the page with the word at this position of the text.
  std::size_t line_at(std::size_t position) const;

  struct Figure {
    std::size_t position;  ///< in the text
    std::string words;     ///< the number and its unit
  };
  /// Numbers that look measured, in order: a number with a unit such as MHz, ms, minutes, %, cells, MiB, dB,
  /// colour steps or times; 1000 or more triangles, pixels, fragments or the like; a number with decimals
  /// other than 0.5; a cell of a table that is a number. Left out are inline code, versions, and columns of
  /// clocks, bits and defaults.
  std::vector<Figure> figures() const;

 private:
  struct Word {
    std::size_t position, line;
    bool code;   ///< in a block of code
    bool given;  ///< in a cell of a column of clocks, bits or defaults
    bool cell;   ///< first word of a cell below the head of a table
  };
  std::string_view word(std::size_t index) const;
  /// Last word of the figure that starts with this word.
  std::optional<std::size_t> end_of_figure(std::size_t first) const;
  void add_words(std::string_view line, std::size_t number, bool code);
  void add_row(std::string_view line, std::size_t number);

  std::string text_;
  std::vector<Word> words_;
  std::vector<std::string> head_;  ///< cells of the head of the current table
};

}  // namespace halfway
