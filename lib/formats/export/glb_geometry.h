// The geometry of a GLB: primitives as arrays or Draco streams in one binary chunk.
#pragma once

#include "lib/formats/export/export.h"
#include "lib/formats/export/unify.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace copse {

struct BufferView {
  std::uint64_t offset = 0, size = 0;
  std::uint32_t target = 0;  // 34962 vertices, 34963 indices, 0 neither
};

// One attribute or the indices of a primitive.
struct Accessor {
  std::optional<std::uint32_t> view;  // none when a Draco stream holds it
  std::uint32_t component = 5126;     // 5126 float, 5125 uint32, 5123 uint16
  std::uint64_t count = 0;
  const char* type = "SCALAR";
  std::optional<std::array<Float3, 2>> bounds;  // min, max: exactly those of the stored values
};

struct DracoStream {
  std::uint32_t view = 0;
  int position = 0, normal = -1, texcoord = -1;  // ids of the attributes in the stream; -1: none
};

struct Primitive {
  std::uint32_t part = 0;
  std::uint32_t indices = 0, position = 0;  // accessors
  std::optional<std::uint32_t> normal, texcoord;
  std::optional<DracoStream> draco;
};

struct GlbGeometry {
  std::vector<BufferView> views;
  std::vector<Accessor> accessors;
  std::vector<Primitive> primitives;
  Double3 translation;  // of all positions; float32 values
  std::string binary;   // each view begins at a multiple of 4

  std::uint32_t add_view(std::string_view bytes, std::uint32_t target);
};

// Errors (refused): coordinates beyond float32, or more than a GLB holds.
Result<GlbGeometry> glb_geometry(const Mesh& mesh, const std::string& name, const ExportOptions& options);

// A primitive as Draco stores it: the stream, and what a decoder will find in it.
struct DracoPrimitive {
  std::string bytes;
  DracoStream ids;  // without `view`
  std::uint64_t vertices = 0, triangles = 0;
  std::array<Float3, 2> bounds;
};
Result<DracoPrimitive> encode_draco(const UnifiedMesh& unified, const std::vector<Float3>& positions,
                                    const std::vector<Float2>& texcoords, int position_bits);

}  // namespace copse
