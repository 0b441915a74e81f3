#include "fuzz/import_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return copse::fuzz_import(data, size, copse::MeshFormat::off);
}
