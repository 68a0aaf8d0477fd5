// SPDX-License-Identifier: Apache-2.0
// Cells of an iCE40 in Yosys's JSON.
#pragma once

#include <string>

namespace halfway::synth {

/// `Json`: nlohmann's ordered or unordered type. Converting one to the other would make a copy.
template <class Json>
bool is_register(const Json& cell) {
  return cell.at("type").template get_ref<const std::string&>().starts_with("SB_DFF");
}

}  // namespace halfway::synth
