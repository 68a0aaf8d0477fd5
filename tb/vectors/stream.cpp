// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <optional>

#include "golden/parameter_register.hpp"
#include "golden/stream_queue.hpp"
#include "golden/stream_register.hpp"
#include "sim/files/vector_file.hpp"
#include "vectors/entities.hpp"
#include "vectors/random.hpp"

namespace halfway::vectors {
namespace {

template <int Bits>
using FlatWord = std::array<std::uint32_t, (Bits + 31) / 32>;

template <int Bits>
FlatWord<Bits> random_word(Random& random) {
  FlatWord<Bits> word;
  random.fill(word);
  return word;
}

// A line: checked, load, start; value, before the edge that may load.
template <int Bits>
void write_parameter(const Folder& folder) {
  Random random(Bits);
  VectorFile file;
  golden::ParameterRegister<FlatWord<Bits>> twin;
  for (int i = 0; i < 600; ++i) {
    const bool load = i == 0 || random.one_in(i < 300 ? 2 : 6);
    const auto start = random_word<Bits>(random);
    file.flag(i > 0).flag(load).words_of(start, Bits).words_of(twin.value(), Bits).end_vector();
    if (load) twin.load(start);
  }
  file.write(folder / (std::to_string(Bits) + ".txt"));
}

// A line: reset, in_valid, in_data, out_ready; in_ready, out_valid, out_data (valid if out_valid).
template <int Bits>
void write_stream(const Folder& folder) {
  Random random(Bits);
  VectorFile file;
  golden::StreamRegister<FlatWord<Bits>> twin;
  constexpr int c_vectors = 3000;
  bool waits = false;  // the word was not taken
  auto data = random_word<Bits>(random);
  for (int i = 0; i < c_vectors; ++i) {
    // Full speed, then a fast source, a fast sink, and both at random, with resets.
    const int part = i * 4 / c_vectors;
    const bool in_valid = waits || part < 2 || random.one_in(2),
               out_ready = part == 0 || part == 2 || random.one_in(2);
    const bool reset = i == 0 || (i > c_vectors / 8 && random.one_in(60));
    if (!waits) data = random_word<Bits>(random);
    waits = in_valid && !twin.in_ready(out_ready) && !reset;
    file.flag(i > 0).flag(reset).flag(in_valid).words_of(data, Bits).flag(out_ready);
    file.flag(twin.in_ready(out_ready)).flag(twin.out_valid()).words_of(twin.out_data(), Bits).end_vector();
    twin.clock(reset, in_valid, data, out_ready);
  }
  file.write(folder / (std::to_string(Bits) + ".txt"));
}

// A line: reset, claim, in_valid, in_data, out_ready; room, pending, out_valid, out_data (valid if
// out_valid).
template <int Bits, int IndexBits>
void write_queue(const Folder& folder) {
  Random random(Bits);
  VectorFile file;
  golden::StreamQueue<FlatWord<Bits>> twin((1 << IndexBits) - 1);
  constexpr int c_vectors = 4000, c_soon = 2;
  int claimed = 0;                    // claimed words that have not entered
  std::array<bool, c_soon> before{};  // the claims of the last clocks
  for (int i = 0; i < c_vectors; ++i) {
    // Full speed, each word a fixed time after its claim; then a fast source, a fast sink, both at random.
    const int part = i * 4 / c_vectors;
    const bool reset = i == 0 || (i > c_vectors / 8 && random.one_in(80));
    const bool claim = twin.room() && (part < 2 || random.one_in(2));
    const bool comes = part == 0 ? before.back() : claimed > 0 && random.one_in(2);
    const bool out_ready = part == 0 || part == 2 || random.one_in(2);
    const auto data = random_word<Bits>(random);
    file.flag(i > 0).flag(reset).flag(claim).flag(comes && !reset).words_of(data, Bits).flag(out_ready);
    const auto shown = twin.out_valid() ? twin.out_data() : FlatWord<Bits>{};
    file.flag(twin.room()).flag(twin.pending()).flag(twin.out_valid()).words_of(shown, Bits).end_vector();
    twin.clock(reset, claim, comes ? std::optional(data) : std::nullopt, out_ready);
    claimed = reset ? 0 : claimed + claim - comes;
    before = {claim && !reset, before.front() && !reset};
  }
  file.write(folder / (std::to_string(Bits) + ".txt"));
}

}  // namespace

std::vector<Entity> stream_entities() {
  return {
      {"parameter_register",
       [](const Folder& folder) {
         write_parameter<1>(folder);
         write_parameter<40>(folder);
         write_parameter<83>(folder);
       }},
      {"stream_register",
       [](const Folder& folder) {
         write_stream<1>(folder);
         write_stream<32>(folder);
         write_stream<497>(folder);
       }},
      {"stream_queue",
       [](const Folder& folder) {
         write_queue<1, 2>(folder);
         write_queue<32, 3>(folder);
         write_queue<97, 3>(folder);
         write_queue<98, 4>(folder);
       }},
  };
}

}  // namespace halfway::vectors
