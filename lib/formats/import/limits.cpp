#include "lib/formats/import/limits.h"

#include "lib/formats/import/gltf/accessor.h"
#include "lib/formats/import/gltf/draco.h"
#include "lib/formats/import/gltf/json.h"
#include "lib/formats/import/gltf/meshopt.h"
#include "lib/formats/import/image.h"
#include "lib/formats/import/import.h"
#include "lib/formats/import/mesh_builder.h"
#include "lib/formats/import/polygon.h"
#include "lib/formats/import/source.h"

namespace copse {

std::vector<ImportLimit> import_limits() {
  return {
      {"vertices, texture coordinates, normals or triangles of a mesh", k_most_elements, "of each"},
      {"mesh read from a pipe", k_stream_limit, "bytes"},
      {"gzipped mesh, always allowed to inflate to", k_inflate_floor, "bytes"},
      {"gzipped mesh, larger ones by its stored size", k_inflate_ratio, "times"},
      {"name of an object or group", k_name_length, "bytes"},
      {"names of all parts, or four times the file", k_part_names_floor, "bytes"},
      {"work to cut a polygon of n corners, times n log2 n", k_cut_budget, "steps"},
      {"nesting of glTF's JSON", k_json_depth, "levels"},
      {"glTF scene with instances, or as the file has bytes", ImportOptions{}.instance_limit,
       "triangles and vertices"},
      {"glTF accessor without data, or as the file has bytes", k_zero_accessor_floor, "elements"},
      {"Draco mesh, always allowed", k_draco_floor, "faces and points"},
      {"Draco mesh, larger ones a byte", k_draco_ratio, "faces and points"},
      {"meshopt buffer view, by its packed size", k_meshopt_ratio, "times"},
      {"image", k_image_pixels, "pixels"},
  };
}

}  // namespace copse
