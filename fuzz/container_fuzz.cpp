// libFuzzer over everything that reads a .tree or .stree.
#include "tests/formats/read_everything.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string wrong = copse::read_everything({data, data + size});
  if (wrong.empty()) return 0;
  std::puts(wrong.c_str());
  std::abort();
}
