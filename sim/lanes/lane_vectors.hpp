// SPDX-License-Identifier: Apache-2.0
// Operations of the generated lanes: vectors of a 64-bit number a lane, and masks of a bit a lane. With
// AVX-512 a mask is a mask register's; elsewhere the compiler does what it can.
#pragma once

#include <cstdint>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

#define LANE_FUNCTION static inline __attribute__((always_inline))

namespace halfway::lanes {

constexpr unsigned kLanes = 8;
using V = std::uint64_t __attribute__((vector_size(8 * kLanes)));
using S = std::int64_t __attribute__((vector_size(8 * kLanes)));
using M = std::uint8_t;
constexpr M kAll = 0xff;

LANE_FUNCTION V splat(std::uint64_t value) {
  return V{} + value;
}
#ifdef __AVX512F__
LANE_FUNCTION V select(M mask, V a, V b) {
  return (V)_mm512_mask_blend_epi64(mask, (__m512i)b, (__m512i)a);
}
LANE_FUNCTION V fill(M mask, std::uint64_t value) {
  return (V)_mm512_maskz_mov_epi64(mask, (__m512i)splat(value));
}
LANE_FUNCTION M test(V a, std::uint64_t bit) {
  return _mm512_test_epi64_mask((__m512i)a, (__m512i)splat(bit));
}
LANE_FUNCTION M equal(V a, V b) {
  return _mm512_cmpeq_epu64_mask((__m512i)a, (__m512i)b);
}
LANE_FUNCTION M less(V a, V b) {
  return _mm512_cmplt_epu64_mask((__m512i)a, (__m512i)b);
}
LANE_FUNCTION M signed_less(V a, V b) {
  return _mm512_cmplt_epi64_mask((__m512i)a, (__m512i)b);
}
LANE_FUNCTION V lookup(const std::uint64_t* table, V address) {
  return (V)_mm512_i64gather_epi64((__m512i)address, table, 8);
}
#else
LANE_FUNCTION V spread(M mask) {  // a lane's bit as all ones or zeros
  V bits{};
  for (unsigned i = 0; i < kLanes; ++i) bits[i] = -(std::uint64_t{mask} >> i & 1);
  return bits;
}
LANE_FUNCTION M gather_bits(V bits) {
  M mask = 0;
  for (unsigned i = 0; i < kLanes; ++i) mask |= static_cast<M>((bits[i] & 1) << i);
  return mask;
}
LANE_FUNCTION V select(M mask, V a, V b) {
  const V m = spread(mask);
  return (m & a) | (~m & b);
}
LANE_FUNCTION V fill(M mask, std::uint64_t value) {
  return spread(mask) & value;
}
LANE_FUNCTION M test(V a, std::uint64_t bit) {
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
LANE_FUNCTION V lookup(const std::uint64_t* table, V address) {
  V data{};
  for (unsigned i = 0; i < kLanes; ++i) data[i] = table[address[i]];
  return data;
}
#endif
LANE_FUNCTION M select(M mask, M a, M b) {
  return static_cast<M>((mask & a) | (~mask & b));
}
LANE_FUNCTION V multiply32(V a, V b) {  // of numbers below 2^32
  return (a & 0xffffffffu) * (b & 0xffffffffu);
}
LANE_FUNCTION V left_by(V a, V distance) {
  return select(less(distance, splat(64)), a << (distance & 63), V{});
}
LANE_FUNCTION V right_by(V a, V distance) {
  return select(less(distance, splat(64)), a >> (distance & 63), V{});
}
LANE_FUNCTION V signed_right_by(V a, V distance) {
  return (V)((S)a >> (S)select(less(distance, splat(63)), distance, splat(63)));
}

/// `width` bits of an array of words from bit `low` up; reads no word but those they lie in.
template <unsigned low, unsigned width>
LANE_FUNCTION std::uint64_t field(const std::uint32_t* words) {
  constexpr unsigned first = low / 32, shift = low % 32;
  std::uint64_t value = words[first] >> shift;
  if constexpr (shift + width > 32) value |= static_cast<std::uint64_t>(words[first + 1]) << (32 - shift);
  if constexpr (shift + width > 64) value |= static_cast<std::uint64_t>(words[first + 2]) << (64 - shift);
  if constexpr (width < 64) value &= (std::uint64_t{1} << width) - 1;
  return value;
}
LANE_FUNCTION void set_lane(V& vector, unsigned lane, std::uint64_t value) {
  reinterpret_cast<std::uint64_t __attribute__((may_alias))*>(&vector)[lane] = value;
}
LANE_FUNCTION void set_lane(M& mask, unsigned lane, std::uint64_t value) {
  mask = static_cast<M>((mask & ~(1u << lane)) | value << lane);
}

}  // namespace halfway::lanes
