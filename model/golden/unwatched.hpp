// SPDX-License-Identifier: Apache-2.0
// The callbacks of a golden shader in which its registers can be read; these ignore them all.
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
