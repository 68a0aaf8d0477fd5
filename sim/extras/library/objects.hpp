// SPDX-License-Identifier: Apache-2.0
// The objects behind the C interface, and the way in which its functions report errors.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "common/result.hpp"
#include "frame/assemble.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "sim/extras/library/halfway.h"

struct halfway_scene {
  halfway::Scene scene;
  halfway::Camera own_camera;  ///< to which halfway_orbit_camera is relative
};

struct halfway_hardware {
  halfway::HardwareKey key;
  halfway::PlanRequest request;  ///< for which the key was planned
  std::string name;
  unsigned init_bits;
};

struct halfway_vectors {
  halfway::HardwareKey key;
  unsigned init_bits;
  std::vector<std::uint32_t> words;
};

struct halfway_fragments {
  std::vector<halfway_fragment> list;
};

struct halfway_frame {
  halfway::FrameAssembler assembler;
};

namespace halfway::library {

constexpr std::size_t words_per_vector(unsigned init_bits) {
  return (init_bits + 31) / 32;
}

/// Write an error to the caller's structure, if there is one, and return its code.
int write_error(halfway_error* out, ExitCode code, const std::string& text);

/// Run a function that returns a Result or Status; an exception becomes an error.
template <class Work>
auto without_exceptions(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return tool_failed("not enough memory; use a smaller scene or frame");
  } catch (const std::exception& exception) {
    return tool_failed(exception.what());
  }
}

/// Return the new object of a function that returns a Result of it, or null.
template <class Object, class Work>
Object* made(halfway_error* error, Work&& work) {
  auto result = without_exceptions([&]() -> Result<std::unique_ptr<Object>> {
    auto value = work();
    if (!value) return value.error();
    return std::make_unique<Object>(std::move(*value));
  });
  if (!result) {
    write_error(error, result.error().code, result.error().message);
    return nullptr;
  }
  write_error(error, ExitCode::equal, {});
  return result->release();
}

/// Return the code of a function that returns a Status.
template <class Work>
int done(halfway_error* error, Work&& work) {
  const Status status = without_exceptions(work);
  return status ? write_error(error, ExitCode::equal, {})
                : write_error(error, status.error().code, status.error().message);
}

/// Refuse a frame that no hardware draws.
Status check_frame(std::uint32_t width, std::uint32_t height);

}  // namespace halfway::library
