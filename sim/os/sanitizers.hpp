// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace halfway {

/// True if built with AddressSanitizer or ThreadSanitizer. These reserve terabytes of addresses and do not
/// run under Valgrind. GCC defines these macros; Clang has __has_feature.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool c_sanitized = true;
#elif defined(__has_feature)
inline constexpr bool c_sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool c_sanitized = false;
#endif

}  // namespace halfway
