// libFuzzer over the whole of treeprep behind its readers: bytes become a mesh and options (tests/treeprep).
#include "tests/treeprep/mesh_of_bytes.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string wrong = copse::prepare_job(copse::job_of_bytes({data, size}, 400));
  if (wrong.empty()) return 0;
  std::puts(wrong.c_str());
  std::abort();
}
