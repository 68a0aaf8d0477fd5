// SPDX-License-Identifier: Apache-2.0
// The vector type of the generated lanes and everything that depends on the processor: V holds a 32-bit
// number per lane, M a condition per lane. Another processor needs another version of this header only.
// With AVX-512, M is a mask register. Otherwise the compiler translates the vector extension.
#pragma once

#include <cstdint>
#include <cstring>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

#define LANE_FUNCTION static inline __attribute__((always_inline))
#define LANE_STEP static __attribute__((noinline))

namespace halfway::lanes {

constexpr unsigned c_lanes = 16;
using V = std::uint32_t __attribute__((vector_size(4 * c_lanes)));
using S = std::int32_t __attribute__((vector_size(4 * c_lanes)));
using M = std::uint16_t;
constexpr M c_all = 0xffff, c_none = 0;

LANE_FUNCTION V splat(std::uint32_t value) {
  return V{} + value;
}
#ifdef __AVX512F__
LANE_FUNCTION V select(M mask, V a, V b) {
  return (V)_mm512_mask_blend_epi32(mask, (__m512i)b, (__m512i)a);
}
LANE_FUNCTION V fill(M mask, std::uint32_t value) {
  return (V)_mm512_maskz_mov_epi32(mask, (__m512i)splat(value));
}
LANE_FUNCTION void assign(M mask, V& to, V value) {
  _mm512_mask_store_epi32(&to, mask, (__m512i)value);
}
LANE_FUNCTION M test(V a, std::uint32_t bit) {
  return _mm512_test_epi32_mask((__m512i)a, (__m512i)splat(bit));
}
LANE_FUNCTION M equal(V a, V b) {
  return _mm512_cmpeq_epu32_mask((__m512i)a, (__m512i)b);
}
LANE_FUNCTION M less(V a, V b) {
  return _mm512_cmplt_epu32_mask((__m512i)a, (__m512i)b);
}
LANE_FUNCTION M signed_less(V a, V b) {
  return _mm512_cmplt_epi32_mask((__m512i)a, (__m512i)b);
}
LANE_FUNCTION V lookup(const std::uint32_t* table, V address) {
  return (V)_mm512_i32gather_epi32((__m512i)address, table, 4);
}
#else
LANE_FUNCTION V spread(M mask) {  // each lane's bit as all ones or zeros
  V bits{};
  for (unsigned i = 0; i < c_lanes; ++i) bits[i] = -(std::uint32_t{mask} >> i & 1);
  return bits;
}
LANE_FUNCTION M gather_bits(V bits) {
  M mask = 0;
  for (unsigned i = 0; i < c_lanes; ++i) mask |= static_cast<M>((bits[i] & 1) << i);
  return mask;
}
LANE_FUNCTION V select(M mask, V a, V b) {
  const V m = spread(mask);
  return (m & a) | (~m & b);
}
LANE_FUNCTION V fill(M mask, std::uint32_t value) {
  return spread(mask) & value;
}
LANE_FUNCTION void assign(M mask, V& to, V value) {
  to = select(mask, value, to);
}
LANE_FUNCTION M test(V a, std::uint32_t bit) {
  return gather_bits((V)((a & bit) != 0));
}
LANE_FUNCTION M equal(V a, V b) {
  return gather_bits((V)(a == b));
}
LANE_FUNCTION M less(V a, V b) {
  return gather_bits((V)(a < b));
}
LANE_FUNCTION M signed_less(V a, V b) {
  return gather_bits((V)((S)a < (S)b));
}
LANE_FUNCTION V lookup(const std::uint32_t* table, V address) {
  V data{};
  for (unsigned i = 0; i < c_lanes; ++i) data[i] = table[address[i]];
  return data;
}
#endif
LANE_FUNCTION M select(M mask, M a, M b) {
  return static_cast<M>((mask & a) | (~mask & b));
}
LANE_FUNCTION void assign(M mask, M& to, M value) {
  to = select(mask, value, to);
}
LANE_FUNCTION M invert(M mask) {
  return static_cast<M>(~mask);
}
LANE_FUNCTION bool any(M mask) {
  return mask != 0;
}
// The lanes of a mask as bits, and the reverse.
LANE_FUNCTION std::uint32_t to_bits(M mask) {
  return mask;
}
LANE_FUNCTION M to_mask(std::uint32_t bits) {
  return static_cast<M>(bits);
}
LANE_FUNCTION void set_lane(V& vector, unsigned lane, std::uint32_t value) {
  reinterpret_cast<std::uint32_t __attribute__((may_alias))*>(&vector)[lane] = value;
}
LANE_FUNCTION void set_lane(M& mask, unsigned lane, std::uint32_t value) {
  mask = static_cast<M>((mask & ~(1u << lane)) | value << lane);
}

/// Four words per lane, one vector per word. Turned, the words of each lane are adjacent: lane 4 q + j is the
/// q-th quarter of the j-th vector.
struct Row {
  V words[4];
};
// From each four words of `a` and `b`: words i and j of both, alternating; two of each, from word i on.
#define LANE_PAIRS(a, b, i, j)                                                                            \
  __builtin_shufflevector(a, b, i, 16 + i, j, 16 + j, 4 + i, 20 + i, 4 + j, 20 + j, 8 + i, 24 + i, 8 + j, \
                          24 + j, 12 + i, 28 + i, 12 + j, 28 + j)
#define LANE_HALVES(a, b, i)                                                                          \
  __builtin_shufflevector(a, b, i, 1 + i, 16 + i, 17 + i, 4 + i, 5 + i, 20 + i, 21 + i, 8 + i, 9 + i, \
                          24 + i, 25 + i, 12 + i, 13 + i, 28 + i, 29 + i)
LANE_FUNCTION Row turn(const Row& row) {
  const V* w = row.words;
  const V low[] = {LANE_PAIRS(w[0], w[1], 0, 1), LANE_PAIRS(w[2], w[3], 0, 1)};
  const V high[] = {LANE_PAIRS(w[0], w[1], 2, 3), LANE_PAIRS(w[2], w[3], 2, 3)};
  return {LANE_HALVES(low[0], low[1], 0), LANE_HALVES(low[0], low[1], 2), LANE_HALVES(high[0], high[1], 0),
          LANE_HALVES(high[0], high[1], 2)};
}
LANE_FUNCTION char* of_lane(Row& turned, unsigned lane) {
  return reinterpret_cast<char*>(&turned.words[lane % 4]) + lane / 4 * 16;
}

}  // namespace halfway::lanes
