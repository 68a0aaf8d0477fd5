// SPDX-License-Identifier: Apache-2.0
#include "setup/init_vector.hpp"

namespace halfway {
namespace {

using At = golden::Exact::init_header_at;

void put_section(InitVector& init, const EdgeSection& s, const golden::Field& x,
                 const golden::Field& quotient, const golden::Field& remainder, const golden::Field& divisor,
                 const golden::Field& error, const golden::Field& carry) {
  init.put(x, s.pixel);
  init.put(quotient, s.quotient);
  init.put(remainder, s.remainder);
  init.put(divisor, s.divisor);
  init.put(error, s.error);
  init.put(carry, s.carry);
}

}  // namespace

void put_header(InitVector& init, std::uint32_t triangle, const Walk& walk, const DepthWords& depth) {
  init.put(At::triangle, triangle);
  init.put(At::y, walk.y);
  init.put(At::upper_lines, walk.upper_lines);
  init.put(At::lower_lines, walk.lower_lines);
  init.put(At::backward, walk.backward);
  put_section(init, walk.start, At::start_x, At::start_quotient, At::start_remainder, At::start_divisor,
              At::start_error, At::start_carry);
  put_section(init, walk.upper, At::upper_x, At::upper_quotient, At::upper_remainder, At::upper_divisor,
              At::upper_error, At::upper_carry);
  put_section(init, walk.lower, At::lower_x, At::lower_quotient, At::lower_remainder, At::lower_divisor,
              At::lower_error, At::lower_carry);
  init.put(At::z, depth.value);
  init.put(At::z_dx, depth.dx);
  init.put(At::z_de0, depth.de0);
  init.put(At::z_de1, depth.de1);
}

}  // namespace halfway
