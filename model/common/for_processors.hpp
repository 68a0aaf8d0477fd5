// SPDX-License-Identifier: Apache-2.0
// HALFWAY_FOR_PROCESSORS: a function compiled for several processors, and chosen by the one that it runs on;
// all that it calls is inlined.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define HALFWAY_FOR_PROCESSORS \
  __attribute__((flatten, target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define HALFWAY_FOR_PROCESSORS
#endif
