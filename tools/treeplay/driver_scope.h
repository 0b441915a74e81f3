// While one lives, what is allocated is not looked for by the leak checker of a sanitizer build: graphics
// drivers keep what they allocate when they start, and unload themselves before the checker could tell whose
// it was.
#pragma once

#ifdef __has_feature
#define COPSE_ASAN_CLANG __has_feature(address_sanitizer)
#else
#define COPSE_ASAN_CLANG 0
#endif

#if defined(__SANITIZE_ADDRESS__) || COPSE_ASAN_CLANG
#include <sanitizer/lsan_interface.h>
#endif

namespace copse::treeplay {

#if defined(__SANITIZE_ADDRESS__) || COPSE_ASAN_CLANG
using DriverScope = __lsan::ScopedDisabler;
#else
struct DriverScope {
  DriverScope() {}  // not trivial: an object that only lives is not an unused variable
  ~DriverScope() {}
};
#endif

}  // namespace copse::treeplay
