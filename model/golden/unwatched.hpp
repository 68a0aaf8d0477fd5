// SPDX-License-Identifier: Apache-2.0
// Callbacks of a golden shader that read its registers. These do nothing.
#pragma once

#include "golden/edge_walker.hpp"

namespace halfway::golden {

struct Unwatched {
  template <class Shader>
  void line(const Shader&) {}
  template <class Shader>
  void span(const Shader&, SpanXWord) {}
  template <class Shader>
  void processor(const Shader&, SpanXWord, int) {}
};

}  // namespace halfway::golden
