// libFuzzer over everything that reads an .eco.
#include "tests/formats/read_ecosystem.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string wrong = copse::read_ecosystem({data, data + size});
  if (wrong.empty()) return 0;
  std::puts(wrong.c_str());
  std::abort();
}
