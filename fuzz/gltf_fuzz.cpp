// glTF and GLB: the reader tells them apart itself. A custom mutator keeps the container of a GLB whole, so
// that the fuzzer's changes reach the JSON and the buffer.
#include "fuzz/import_fuzz.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

std::uint32_t read_u32(const std::uint8_t* p) {
  std::uint32_t value = 0;
  std::memcpy(&value, p, 4);
  return value;
}

struct Glb {
  std::vector<std::uint8_t> json, bin;
};

bool split(const std::uint8_t* data, std::size_t size, Glb& out) {
  if (size < 20 || std::memcmp(data, "glTF", 4) != 0) return false;
  const std::size_t json = read_u32(data + 12);
  if (json > size - 20) return false;
  out.json.assign(data + 20, data + 20 + json);
  if (size >= 28 + json) out.bin.assign(data + 28 + json, data + size);
  return true;
}

std::vector<std::uint8_t> join(Glb glb) {
  while (glb.json.size() % 4 != 0) glb.json.push_back(' ');
  while (glb.bin.size() % 4 != 0) glb.bin.push_back(0);
  std::vector<std::uint8_t> out{'g', 'l', 'T', 'F', 2, 0, 0, 0};
  const auto put = [&out](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::uint8_t>(value >> shift));
  };
  put(28 + glb.json.size() + glb.bin.size());
  put(glb.json.size());
  put(0x4e4f534a);
  out.insert(out.end(), glb.json.begin(), glb.json.end());
  put(glb.bin.size());
  put(0x004e4942);
  out.insert(out.end(), glb.bin.begin(), glb.bin.end());
  return out;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  Glb glb;
  if (seed % 8 == 0 || !split(data, size, glb)) return LLVMFuzzerMutate(data, size, max_size);
  std::vector<std::uint8_t>& part = seed % 2 == 0 || glb.bin.empty() ? glb.json : glb.bin;
  const std::size_t used = part.size();
  part.resize(used + std::min<std::size_t>(256, max_size));
  part.resize(LLVMFuzzerMutate(part.data(), used, part.size()));
  const std::vector<std::uint8_t> out = join(glb);
  if (out.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(out.begin(), out.end(), data);
  return out.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return copse::fuzz_import(data, size, copse::MeshFormat::glb);
}
