// SPDX-License-Identifier: Apache-2.0
#include "setup/walk_header.hpp"

namespace halfway {
namespace {

using At = words::Exact::init_header_at;

void put_section(InitVector& init, const EdgeSection& s, const words::Field& x, const words::Field& quotient,
                 const words::Field& remainder, const words::Field& divisor, const words::Field& error,
                 const words::Field& carry, int low) {
  init.put(x, s.pixel, low);
  init.put(quotient, s.quotient, low);
  init.put(remainder, s.remainder, low);
  init.put(divisor, s.divisor, low);
  init.put(error, s.error, low);
  init.put(carry, s.carry, low);
}

}  // namespace

// Inline all, so that the places of the fields are constants.
[[gnu::flatten]] void put_header(InitVector& init, std::uint32_t triangle, const Walk& walk,
                                 const DepthWords& depth, int low) {
  init.put(At::triangle, triangle, low);
  init.put(At::y, walk.y, low);
  init.put(At::upper_lines, walk.upper_lines, low);
  init.put(At::lower_lines, walk.lower_lines, low);
  init.put(At::backward, walk.backward, low);
  put_section(init, walk.start, At::start_x, At::start_quotient, At::start_remainder, At::start_divisor,
              At::start_error, At::start_carry, low);
  put_section(init, walk.upper, At::upper_x, At::upper_quotient, At::upper_remainder, At::upper_divisor,
              At::upper_error, At::upper_carry, low);
  put_section(init, walk.lower, At::lower_x, At::lower_quotient, At::lower_remainder, At::lower_divisor,
              At::lower_error, At::lower_carry, low);
  init.put(At::z, depth.value, low);
  init.put(At::z_dx, depth.dx, low);
  init.put(At::z_de0, depth.de0, low);
  init.put(At::z_de1, depth.de1, low);
}

}  // namespace halfway
