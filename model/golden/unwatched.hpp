// SPDX-License-Identifier: Apache-2.0
// The callbacks of a golden shader that show its registers; this one ignores them all.
#pragma once

#include "golden/edge_walker.hpp"

namespace halfway::golden {

struct Unwatched {
  template <class Shader>
  void line(const Shader&) {}
  template <class Shader>
  void span(const Shader&, SpanXWord) {}
  template <class Shader>
  void sample(const Shader&, SpanXWord) {}
  template <class Shader>
  void processor(const Shader&, SpanXWord, int) {}
  template <class Shader>
  void product(const Shader&, SpanXWord) {}
};

}  // namespace halfway::golden
