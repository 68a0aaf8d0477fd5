// SPDX-License-Identifier: Apache-2.0
// A trace of parts of signals as 32-bit words, as a hardware module records it.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/driver/stages.hpp"

namespace halfway {

class WordTrace final : public SignalTrace {
 public:
  /// `words`: edge by edge, the words of each part in their order, the least significant first.
  WordTrace(const std::set<TracedPart>& parts, std::vector<std::uint32_t> words);

  std::size_t edges() const override { return words_per_edge_ == 0 ? 0 : words_.size() / words_per_edge_; }
  std::optional<std::uint64_t> part(const std::string& path, std::size_t edge, int low,
                                    int bits) const override;

 private:
  struct Place {
    int low, bits;
    std::size_t word;
  };
  std::map<std::string, std::vector<Place>> places_;  ///< by path
  std::size_t words_per_edge_ = 0;
  std::vector<std::uint32_t> words_;
};

}  // namespace halfway
