// What the fuzzers of the mesh readers share: an import is an Error or a mesh that keeps all promises of
// import.h.
#pragma once

#include "lib/formats/import/import.h"
#include "tests/import/soundness.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace copse {

inline int fuzz_import(const std::uint8_t* data, std::size_t size, MeshFormat format) {
  for (const bool strict : {false, true}) {
    const Result<Import> result =
        import_mesh({data, size}, format, "fuzz", {.strict = strict, .instance_limit = 100'000});
    const char* broken = nullptr;
    if (result) broken = testing::broken_promise(*result);
    if (!result && result.error().fault == Fault::bug) broken = result.error().what.c_str();
    if (broken == nullptr) continue;
    std::fprintf(stderr, "%s\n", broken);
    std::abort();
  }
  return 0;
}

}  // namespace copse
