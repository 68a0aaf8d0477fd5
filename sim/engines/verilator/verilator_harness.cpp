// SPDX-License-Identifier: Apache-2.0
// Compiled in one translation unit with the verilated model (prefix Vshader).
// A cycle is the same as in tb/rtl/frame_tb.vhd: inputs change after the rising edge, outputs are sampled
// just before the next one. Only Verilator's public interface is used: it is the same in all versions.
#include <cstring>
#include <memory>
#include <type_traits>

#include "Vshader.h"
#include "sim/engines/verilator/harness_api.h"
#include "verilated.h"
#ifdef HALFWAY_WAVES
#include "verilated_fst_c.h"
#endif

#define HALFWAY_EXPORT extern "C" __attribute__((visibility("default")))

namespace {

constexpr bool c_waves =
#ifdef HALFWAY_WAVES
    true;
#else
    false;
#endif

constexpr std::size_t words_of(std::size_t bits) {
  return (bits + 31) / 32;
}
constexpr std::size_t c_init_words = words_of(HALFWAY_INIT_BITS);
constexpr int c_late_cycles = 8;  // clocks to wait for a fault, as in tb/rtl/frame_tb.vhd

// Ports of up to 64 bits are integers, wider ones arrays of words.
template <class Port>
void write_port(Port& port, const std::uint32_t* words) {
  if constexpr (std::is_integral_v<Port>) {
    std::uint64_t value = words[0];
    if constexpr (sizeof(Port) == 8) value |= static_cast<std::uint64_t>(words[1]) << 32;
    port = static_cast<Port>(value);
  } else {
    static_assert(sizeof(Port) == 4 * c_init_words);
    std::memcpy(&port[0], words, sizeof(Port));
  }
}

class Model {
 public:
  explicit Model(const HalfwayOptions& options) : options_(options), random_(options.stall_seed) {
    context_.traceEverOn(c_waves);
    shader_ = std::make_unique<Vshader>(&context_, "shader");
#ifdef HALFWAY_WAVES
    if (options.waves_path != nullptr) {
      waves_ = std::make_unique<VerilatedFstC>();
      shader_->trace(waves_.get(), 99);
      waves_->open(options.waves_path);
    }
#endif
    shader_->clk = 0;
    shader_->reset = 1;
    shader_->init_valid = 0;
    shader_->fragment_ready = 0;
    shader_->eval();
    for (int i = 0; i < 4; ++i) rising_edge();
    shader_->reset = 0;
    shader_->eval();
  }

  ~Model() {
#ifdef HALFWAY_WAVES
    if (waves_) waves_->close();
#endif
    shader_->final();
  }

  bool waves_failed() const {
#ifdef HALFWAY_WAVES
    return waves_ && !waves_->isOpen();
#else
    return false;
#endif
  }

  std::uint64_t cycles() const { return started_ ? last_move_ + 1 : 0; }

  int advance(HalfwayStreams& streams, bool drain) {
    const bool stall = options_.stall_seed != 0;
    return stall ? loop<true>(streams, drain) : loop<false>(streams, drain);
  }

 private:
  void rising_edge() {
    shader_->clk = 1;
    shader_->eval();
    shader_->clk = 0;
    shader_->eval();
  }

  std::uint32_t next_random() {  // xorshift32 (Marsaglia 2003), as in tb/rtl/frame_tb.vhd.
    random_ ^= random_ << 13;
    random_ ^= random_ >> 17;
    random_ ^= random_ << 5;
    return random_;
  }

  template <bool stall>
  void drive(const HalfwayStreams& streams) {
    bool ready = true;
    if constexpr (stall) {
      const std::uint32_t random = next_random();
      ready = (random & 1U) != 0;
      offered_ = streams.vectors > 0 && (offered_ || (random & 2U) != 0);
    } else {
      offered_ = streams.vectors > 0;
    }
    shader_->fragment_ready = ready;
    shader_->init_valid = offered_;
    if (offered_) write_port(shader_->init_data, streams.words);
    shader_->eval();
  }

  // A counter may detect an error of a token after the token has left.
  bool faults_late() {
    for (int i = 0; i < c_late_cycles && !shader_->fault; ++i) rising_edge();
    return shader_->fault;
  }

  HalfwayFragment fragment() const {
    return {static_cast<std::uint32_t>(shader_->fragment_triangle),
            static_cast<std::uint32_t>(shader_->fragment_z),
            static_cast<std::uint16_t>(shader_->fragment_y),
            static_cast<std::uint16_t>(shader_->fragment_x),
            static_cast<std::uint8_t>(shader_->fragment_red),
            static_cast<std::uint8_t>(shader_->fragment_green),
            static_cast<std::uint8_t>(shader_->fragment_blue),
            0};
  }

  void dump([[maybe_unused]] std::uint64_t cycle, [[maybe_unused]] bool clock) {
#ifdef HALFWAY_WAVES
    if (waves_ == nullptr || cycle < options_.waves_from || cycle >= options_.waves_to) return;
    waves_->dump(10 * cycle + (clock ? 5 : 0));
#endif
  }

  template <bool stall>
  int loop(HalfwayStreams& streams, bool drain) {
    std::uint64_t cycle = cycle_, last_move = last_move_;
    int status = halfway_done;
    if (!drain && streams.vectors == 0) return status;
    if (!stall || drive_due_) drive<stall>(streams);
    while (true) {
      drive_due_ = false;
      if (streams.count == streams.capacity) {
        status = halfway_buffer_full;
        break;
      }
      if (shader_->fault) {
        status = halfway_fault;
        break;
      }
      const bool take = offered_ && shader_->init_ready;
      const bool valid = shader_->fragment_valid;
      const bool emit = valid && (!stall || shader_->fragment_ready);
      if (take && !started_) {
        started_ = true;
        cycle = 0;  // cycles are counted from here
      }
      if constexpr (stall) {
        const HalfwayFragment now = fragment();
        if (holding_ && (!valid || std::memcmp(&now, &held_, sizeof now) != 0)) {
          status = halfway_changed;
          break;
        }
        held_ = now;
        holding_ = valid && !emit;
      }
      if (emit) streams.fragments[streams.count++] = fragment();
      if constexpr (c_waves) {
        if (started_) dump(cycle, false);
      }
      if (take || emit) {
        last_move = cycle;
      } else {
        if (drain && !valid && !shader_->busy) {
          if (faults_late()) status = halfway_fault;
          break;
        }
        if (cycle - last_move >= options_.idle_limit) {
          status = halfway_hang;
          break;
        }
      }
      rising_edge();
      if constexpr (c_waves) {
        if (started_) dump(cycle, true);
      }
      ++cycle;
      if (take) {
        offered_ = false;
        streams.words += c_init_words;
        --streams.vectors;
        if (!drain && streams.vectors == 0) {
          drive_due_ = true;
          break;
        }
      }
      if (stall || take) drive<stall>(streams);
    }
    cycle_ = cycle;
    last_move_ = last_move;
    return status;
  }

  HalfwayOptions options_;
  VerilatedContext context_;
  std::unique_ptr<Vshader> shader_;
#ifdef HALFWAY_WAVES
  std::unique_ptr<VerilatedFstC> waves_;
#endif
  std::uint64_t cycle_ = 0, last_move_ = 0;
  std::uint32_t random_;
  bool started_ = false, offered_ = false, holding_ = false;
  bool drive_due_ = true;  ///< the inputs of the next cycle are not set yet
  HalfwayFragment held_{};
};

}  // namespace

HALFWAY_EXPORT int halfway_run(void* model, HalfwayStreams* streams) {
  return static_cast<Model*>(model)->advance(*streams, false);
}

HALFWAY_EXPORT int halfway_drain(void* model, HalfwayStreams* streams) {
  streams->vectors = 0;
  return static_cast<Model*>(model)->advance(*streams, true);
}

HALFWAY_EXPORT uint64_t halfway_cycles(const void* model) {
  return static_cast<const Model*>(model)->cycles();
}

HALFWAY_EXPORT uint32_t halfway_harness_version(void) {
  return HALFWAY_HARNESS_VERSION;
}

HALFWAY_EXPORT void* halfway_create(const HalfwayOptions* options) {
  if (options->init_bits != HALFWAY_INIT_BITS) return nullptr;
  if (options->waves_path != nullptr && !c_waves) return nullptr;
  auto model = std::make_unique<Model>(*options);
  return model->waves_failed() ? nullptr : model.release();
}

HALFWAY_EXPORT void halfway_destroy(void* model) {
  delete static_cast<Model*>(model);
}
