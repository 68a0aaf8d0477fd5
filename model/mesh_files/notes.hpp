// SPDX-License-Identifier: Apache-2.0
// What a reader of mesh files left out or changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/check_numbers.hpp"

namespace halfway {

/// One note for each kind of thing, with its first place and its count.
class Notes {
 public:
  /// Count a thing. `place` is the file, with the line or object if it is known.
  void add(std::string_view place, std::string_view what) {
    auto found = notes_.find(what);
    if (found == notes_.end() && notes_.size() >= c_most) {
      what = "more is left out";
      found = notes_.find(what);
    }
    if (found == notes_.end())
      notes_.emplace(what, Note{.first_place = std::string(place)});
    else
      ++found->second.count;
  }
  /// "place: what", and the count if it is not 1.
  std::vector<std::string> list() const {
    std::vector<std::string> list;
    for (const auto& [what, note] : notes_) {
      list.push_back(note.first_place + ": " + what);
      if (note.count > 1) list.back() += " (" + std::to_string(note.count) + " times)";
    }
    return list;
  }

 private:
  static constexpr std::size_t c_most = 100;  ///< a damaged file may have any number of kinds
  struct Note {
    std::string first_place;
    std::uint64_t count = 1;
  };
  std::map<std::string, Note, std::less<>> notes_;
};

/// The normal, or zero with a note if a number is not finite. `place` returns the place.
template <class Place>
glm::dvec3 known_normal(const glm::dvec3& normal, Notes& notes, Place&& place) {
  if (is_finite(normal)) return normal;
  notes.add(place(), "a normal is not three finite numbers; it is computed");
  return glm::dvec3(0.0);
}

}  // namespace halfway
