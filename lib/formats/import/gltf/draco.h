// KHR_draco_mesh_compression: the mesh that a Draco bitstream holds.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace copse {

// A regular mesh takes Draco a few thousandths of a byte a face at best. What claims more faces or points
// than k_draco_floor and more than k_draco_ratio a byte is refused before memory is taken for it.
inline constexpr std::uint64_t k_draco_floor = std::uint64_t{1} << 20;
inline constexpr std::uint64_t k_draco_ratio = 256;

class DracoMesh {
 public:
  DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;
  ~DracoMesh();

  // Returns what is wrong, or an empty text.
  std::string decode(std::span<const std::uint8_t> bytes);

  std::uint32_t points() const;
  void indices(std::vector<std::uint32_t>& out) const;
  // `components` numbers a point of the attribute with that unique id. False: there is none, or it has fewer
  // components.
  bool numbers(std::uint32_t id, std::uint32_t components, std::span<double> out) const;
  bool numbers(std::uint32_t id, std::uint32_t components, std::span<float> out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace copse
