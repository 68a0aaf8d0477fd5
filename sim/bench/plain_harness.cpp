// SPDX-License-Identifier: Apache-2.0
// Test harness for a model of the RTL made by Verilator or CXXRTL. It uses the model as the tools' manuals
// do: set the inputs, evaluate with the clock low, read the outputs, evaluate with the clock high.
//   program INIT FRAGMENTS
// INIT contains init vectors, each in whole words, least significant first. Fragments are written to
// FRAGMENTS. Both files have the machine's memory layout. Prints the processor seconds of the clock loop.
// C++17, because Verilator's default flags select it.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#ifdef HALFWAY_CXXRTL
#include "model.cc"
#else
#include "Vshader.h"
#include "verilated.h"
#endif

namespace {

constexpr std::size_t c_init_words = (HALFWAY_INIT_BITS + 31) / 32;
constexpr std::uint64_t c_idle_limit = 100000;  // clocks without progress that count as a hang

struct Fragment {  // same layout as in model/frame/fragment.hpp
  std::uint32_t triangle, z;
  std::uint16_t y, x;
  std::uint8_t red, green, blue, reserved;
};

#ifdef HALFWAY_CXXRTL
// An output is a value, or a wire if a register drives it.
template <class Port>
auto chunks(const Port& port, int) -> decltype(&port.curr.data[0]) {
  return &port.curr.data[0];
}
template <class Port>
auto chunks(const Port& port, long) -> decltype(&port.data[0]) {
  return &port.data[0];
}
template <class Port>
std::uint32_t get(const Port& port) {
  return chunks(port, 0)[0];
}

class Model {
 public:
  void reset(bool on) { shader_.p_reset.set<bool>(on); }
  void ready(bool on) { shader_.p_fragment__ready.set<bool>(on); }
  void offer(const std::uint32_t* words) {
    shader_.p_init__valid.set<bool>(words != nullptr);
    if (words != nullptr)
      std::memcpy(&shader_.p_init__data.data[0], words, sizeof(shader_.p_init__data.data));
  }
  void evaluate(bool clock) {
    shader_.p_clk.set<bool>(clock);
    shader_.step();
  }
  bool takes() const { return get(shader_.p_init__ready) != 0; }
  bool valid() const { return get(shader_.p_fragment__valid) != 0; }
  bool busy() const { return get(shader_.p_busy) != 0; }
  bool fault() const { return get(shader_.p_fault) != 0; }
  Fragment fragment() const {
    const auto& s = shader_;
    return {get(s.p_fragment__triangle),
            get(s.p_fragment__z),
            static_cast<std::uint16_t>(get(s.p_fragment__y)),
            static_cast<std::uint16_t>(get(s.p_fragment__x)),
            static_cast<std::uint8_t>(get(s.p_fragment__red)),
            static_cast<std::uint8_t>(get(s.p_fragment__green)),
            static_cast<std::uint8_t>(get(s.p_fragment__blue)),
            0};
  }

 private:
  cxxrtl_design::HALFWAY_TOP shader_;
};
#else
class Model {
 public:
  void reset(bool on) { shader_.reset = on; }
  void ready(bool on) { shader_.fragment_ready = on; }
  void offer(const std::uint32_t* words) {
    shader_.init_valid = words != nullptr;
    if (words != nullptr) std::memcpy(&shader_.init_data, words, sizeof(shader_.init_data));
  }
  void evaluate(bool clock) {
    shader_.clk = clock;
    shader_.eval();
  }
  bool takes() const { return shader_.init_ready != 0; }
  bool valid() const { return shader_.fragment_valid != 0; }
  bool busy() const { return shader_.busy != 0; }
  bool fault() const { return shader_.fault != 0; }
  Fragment fragment() const {
    const Vshader& s = shader_;
    return {static_cast<std::uint32_t>(s.fragment_triangle), static_cast<std::uint32_t>(s.fragment_z),
            static_cast<std::uint16_t>(s.fragment_y),        static_cast<std::uint16_t>(s.fragment_x),
            static_cast<std::uint8_t>(s.fragment_red),       static_cast<std::uint8_t>(s.fragment_green),
            static_cast<std::uint8_t>(s.fragment_blue),      0};
  }

 private:
  Vshader shader_;
};
#endif

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int fail(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return fail("usage: program INIT FRAGMENTS");
  std::vector<std::uint32_t> words;
  std::FILE* file = std::fopen(argv[1], "rb");
  if (file == nullptr) return fail("cannot read the init vectors");
  for (std::uint32_t word; std::fread(&word, sizeof word, 1, file) == 1;) words.push_back(word);
  std::fclose(file);

  Model model;
  model.reset(true);
  model.ready(true);
  model.offer(nullptr);
  for (int i = 0; i < 4; ++i) {
    model.evaluate(false);
    model.evaluate(true);
  }
  model.reset(false);

  std::vector<Fragment> fragments;
  const std::uint32_t *next = words.data(), *const end = next + words.size() / c_init_words * c_init_words;
  std::uint64_t still = 0;
  const double start = processor_seconds();
  model.offer(next == end ? nullptr : next);
  for (;;) {
    model.evaluate(false);
    if (model.fault()) return fail("fault");
    const bool take = next != end && model.takes(), valid = model.valid();
    if (valid) fragments.push_back(model.fragment());
    if (!take && !valid && next == end && !model.busy()) break;
    still = take || valid ? 0 : still + 1;
    if (still > c_idle_limit) return fail("hang");
    model.evaluate(true);
    if (take) {
      next += c_init_words;
      model.offer(next == end ? nullptr : next);
    }
  }
  const double seconds = processor_seconds() - start;

  file = std::fopen(argv[2], "wb");
  if (file == nullptr ||
      std::fwrite(fragments.data(), sizeof(Fragment), fragments.size(), file) != fragments.size() ||
      std::fclose(file) != 0)
    return fail("cannot write the fragments");
  std::printf("%.9f\n", seconds);
  return 0;
}
