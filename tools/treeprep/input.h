// Reads the input meshes and makes them one, in copse's frame.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/result.h"
#include "tools/common/tool.h"
#include "tools/treeprep/options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse::treeprep {

struct Input {
  std::vector<std::uint32_t> undefined_materials;  // of the mesh's: named, but defined in no file; ascending
  Mesh mesh;                                       // oriented, scaled; at least one triangle
  // Where each triangle was in the file; empty where they are in its order. Those that lay scattered are
  // brought together, and those of collision hulls and coarser levels left out, but with --strict.
  std::vector<std::uint32_t> file_order;
  std::string name;                 // for messages: the first file, "(+2 more)" where there are several
  std::string format;               // "obj", "glb", ...
  std::vector<std::string> faults;  // with --strict: what the files themselves have wrong
};

// The largest extent of a tree, in metres: beyond it the area of a triangle may not fit a float32.
inline constexpr double k_largest_extent = 1e18;

// Texture references come out relative to the folder of `options.output`. What was dropped or mended is
// warned about; with --strict it is also listed in `faults`.
Result<Input> read_input(const Options& options, Context& context);

// The last step of read_input(): into copse's frame and, but with --strict, without what stands in for a tree
// that is there besides (stand_ins.h) and in spatial order. Refuses a mesh without triangles and one that is
// too large.
Result<void> settle(Input& input, const Options& options, Context& context);

// The distance in metres within which --weld makes positions one; negative: decided place by place.
double weld_tolerance(const Input& input, const Options& options);

}  // namespace copse::treeprep
