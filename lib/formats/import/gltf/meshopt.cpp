#include "lib/formats/import/gltf/meshopt.h"

#include <algorithm>

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace copse {
namespace {

// The combinations that the extension allows; the decoders themselves only assert them.
std::string check(std::span<const std::uint8_t> packed, const MeshoptView& view) {
  const bool attributes = view.mode == "ATTRIBUTES";
  if (!attributes && view.mode != "TRIANGLES" && view.mode != "INDICES")
    return "the mode '" + view.mode + "' is not known";
  const bool good_stride = attributes ? view.stride >= 4 && view.stride <= 256 && view.stride % 4 == 0
                                      : view.stride == 2 || view.stride == 4;
  if (!good_stride) return fmt::format("byteStride {} does not fit mode {}", view.stride, view.mode);
  if (view.mode == "TRIANGLES" && view.count % 3 != 0)
    return fmt::format("{} indices are no triangles", view.count);
  const std::string& filter = view.filter;
  if (!filter.empty() && filter != "NONE") {
    const bool known = (filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) ||
                       (filter == "QUATERNION" && view.stride == 8) || filter == "EXPONENTIAL";
    if (!known || !attributes) return fmt::format("the filter '{}' does not fit", filter);
  }
  const std::uint64_t most = (k_meshopt_ratio * packed.size() + k_meshopt_floor) / view.stride;
  if (view.count > most)
    return fmt::format("{} packed bytes cannot hold {} elements of {} bytes", packed.size(), view.count,
                       view.stride);
  return {};
}

}  // namespace

std::string decode_meshopt(std::span<const std::uint8_t> packed, const MeshoptView& view,
                           std::vector<std::uint8_t>& out) {
  if (std::string reason = check(packed, view); !reason.empty()) return reason;
  out.resize(view.count * view.stride);
  if (view.count == 0) return {};
  int status = 0;
  if (view.mode == "ATTRIBUTES") {
    status = meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, packed.data(), packed.size());
  } else if (view.mode == "TRIANGLES") {
    status = meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, packed.data(), packed.size());
  } else {
    status = meshopt_decodeIndexSequence(out.data(), view.count, view.stride, packed.data(), packed.size());
  }
  if (status != 0) return fmt::format("the packed data are damaged ({})", status);
  // The filters want their elements in whole groups of four; the last ones are done in a padded copy.
  const auto filter = [&](auto apply) {
    std::vector<std::uint8_t> padded(out);
    const std::uint64_t count = (view.count + 3) / 4 * 4;
    padded.resize(count * view.stride);
    apply(padded.data(), count, view.stride);
    std::copy_n(padded.begin(), out.size(), out.begin());
  };
  if (view.filter == "OCTAHEDRAL") filter(meshopt_decodeFilterOct);
  if (view.filter == "QUATERNION") filter(meshopt_decodeFilterQuat);
  if (view.filter == "EXPONENTIAL") filter(meshopt_decodeFilterExp);
  return {};
}

}  // namespace copse
