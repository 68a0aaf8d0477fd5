// SPDX-License-Identifier: Apache-2.0
// Cells of an iCE40 in Yosys's JSON.
#pragma once

#include <string>
#include <string_view>

namespace halfway::synth {

inline bool is_register_type(std::string_view type) {
  return type.starts_with("SB_DFF");
}

/// `Json`: nlohmann's ordered or unordered type. Converting one to the other would make a copy.
template <class Json>
bool is_register(const Json& cell) {
  return is_register_type(cell.at("type").template get_ref<const std::string&>());
}

}  // namespace halfway::synth
