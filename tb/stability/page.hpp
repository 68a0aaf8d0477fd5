// SPDX-License-Identifier: Apache-2.0
// The page of hard cases: each command writes its own sections anew and leaves the others alone.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "common/result.hpp"

namespace halfway::stability {

struct Section {
  std::string heading{};  ///< without the ##
  std::string body{};     ///< ends with a line's end
};

/// The text with these sections in it: each in the place of the one with its heading, or at the end.
std::string with_sections(std::string_view text, std::span<const Section> sections);

Status write_sections(const std::filesystem::path& page, std::span<const Section> sections);

}  // namespace halfway::stability
