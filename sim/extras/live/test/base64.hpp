// SPDX-License-Identifier: Apache-2.0
// Words in the text of a test's page.
#pragma once

#include <OpenImageIO/strutil.h>

#include <string>

namespace halfway {

template <class Items>
std::string base64(const Items& items) {
  return OIIO::Strutil::base64_encode(
      {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(items[0])});
}

}  // namespace halfway
