// SPDX-License-Identifier: Apache-2.0
// The vector types of the generated lanes: V holds a 32-bit number per lane, M a condition per lane. They are
// written in the vector extension of GCC and Clang; the number of lanes is the only parameter. Its default is
// what the processor's vectors hold. Without vectors of this width the compiler splits them.
// A mask is a vector of all ones or zeros per lane. Only AVX-512 has registers for masks; there it is a bit
// per lane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#if defined(__x86_64__)
#include <immintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#define LANE_FUNCTION static inline __attribute__((always_inline))
#define LANE_STEP static __attribute__((noinline))

namespace halfway::lanes {

#ifndef HALFWAY_LANES
#if defined(__AVX512DQ__)
#define HALFWAY_LANES 16
#elif defined(__AVX2__)
#define HALFWAY_LANES 8
#else
#define HALFWAY_LANES 4
#endif
#endif
constexpr unsigned c_lanes = HALFWAY_LANES;

using V = std::uint32_t __attribute__((vector_size(4 * c_lanes)));
using S = std::int32_t __attribute__((vector_size(4 * c_lanes)));
// Two lanes as one number, as in a little-endian processor.
using W = std::uint64_t __attribute__((vector_size(4 * c_lanes)));
using D = std::int64_t __attribute__((vector_size(4 * c_lanes)));

LANE_FUNCTION V splat(std::uint32_t value) {
  return V{} + value;
}
LANE_FUNCTION V lookup(const std::uint32_t* table, V address) {
#if HALFWAY_LANES == 16 && defined(__AVX512DQ__)
  return (V)_mm512_i32gather_epi32((__m512i)address, table, 4);
#else
  V data{};
  for (unsigned i = 0; i < c_lanes; ++i) data[i] = table[address[i]];
  return data;
#endif
}
LANE_FUNCTION V invert(V a) {
  return ~a;
}
LANE_FUNCTION void set_lane(V& vector, unsigned lane, std::uint32_t value) {
  reinterpret_cast<std::uint32_t __attribute__((may_alias))*>(&vector)[lane] = value;
}

#if HALFWAY_LANES == 16 && defined(__AVX512DQ__)
using M = std::uint16_t;
constexpr M c_all = 0xffff, c_none = 0;

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
LANE_FUNCTION std::uint32_t to_bits(M mask) {
  return mask;
}
LANE_FUNCTION M to_mask(std::uint32_t bits) {
  return static_cast<M>(bits);
}
#else
using M = S;
const M c_all = M{} - 1, c_none{};

LANE_FUNCTION V select(M mask, V a, V b) {
  return ((V)mask & a) | (~(V)mask & b);
}
LANE_FUNCTION V fill(M mask, std::uint32_t value) {
  return (V)mask & value;
}
LANE_FUNCTION void assign(M mask, V& to, V value) {
  to = select(mask, value, to);
}
LANE_FUNCTION M test(V a, std::uint32_t bit) {
  return (a & bit) == splat(bit);
}
LANE_FUNCTION M equal(V a, V b) {
  return a == b;
}
LANE_FUNCTION M less(V a, V b) {
  return a < b;
}
LANE_FUNCTION M signed_less(V a, V b) {
  return (S)a < (S)b;
}
/// The lanes of a mask as bits: one instruction where the processor has it.
LANE_FUNCTION std::uint32_t to_bits(M mask) {
#if HALFWAY_LANES == 8 && defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps((__m256)mask));
#elif HALFWAY_LANES == 4 && defined(__SSE2__)
  return static_cast<std::uint32_t>(_mm_movemask_ps((__m128)mask));
#elif HALFWAY_LANES == 4 && defined(__wasm_simd128__)
  return wasm_i32x4_bitmask((v128_t)mask);
#else
  std::uint32_t bits = 0;
  for (unsigned i = 0; i < c_lanes; ++i) bits |= (static_cast<std::uint32_t>(mask[i]) & 1) << i;
  return bits;
#endif
}
LANE_FUNCTION M to_mask(std::uint32_t bits) {
  V own{};
  for (unsigned i = 0; i < c_lanes; ++i) own[i] = 1u << i;
  return (own & bits) == own;
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
  return to_bits(mask) != 0;
}
LANE_FUNCTION void set_lane(M& mask, unsigned lane, std::uint32_t value) {
  mask = to_mask((to_bits(mask) & ~(1u << lane)) | value << lane);
}

/// Four words per lane, one vector per word. Turned, the words of each lane are adjacent: lane 4 q + j is the
/// q-th quarter of the j-th vector.
struct Row {
  V words[4];
};
using LaneNumbers = std::make_index_sequence<c_lanes>;
/// From each four words of `a` and `b`: words `first` and `first + 1` of both, alternating.
template <std::size_t first, std::size_t... i>
LANE_FUNCTION V pairs(V a, V b, std::index_sequence<i...>) {
  return __builtin_shufflevector(a, b, (i % 2 * c_lanes + i / 4 * 4 + i % 4 / 2 + first)...);
}
/// From each four words of `a` and `b`: words `first` and `first + 1` of a, then of b.
template <std::size_t first, std::size_t... i>
LANE_FUNCTION V halves(V a, V b, std::index_sequence<i...>) {
  return __builtin_shufflevector(a, b, (i % 4 / 2 * c_lanes + i / 4 * 4 + i % 2 + first)...);
}
LANE_FUNCTION Row turn(const Row& row) {
  const V* w = row.words;
  constexpr LaneNumbers c_all;
  const V low[] = {pairs<0>(w[0], w[1], c_all), pairs<0>(w[2], w[3], c_all)};
  const V high[] = {pairs<2>(w[0], w[1], c_all), pairs<2>(w[2], w[3], c_all)};
  return {halves<0>(low[0], low[1], c_all), halves<2>(low[0], low[1], c_all),
          halves<0>(high[0], high[1], c_all), halves<2>(high[0], high[1], c_all)};
}
LANE_FUNCTION char* of_lane(Row& turned, unsigned lane) {
  return reinterpret_cast<char*>(&turned.words[lane % 4]) + lane / 4 * 16;
}

}  // namespace halfway::lanes
