// Material libraries of OBJ files.
#pragma once

#include "lib/formats/import/mesh_builder.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

// The materials of a mesh by name, in order of their first mention.
class MaterialTable {
 public:
  explicit MaterialTable(Mesh& mesh) : mesh_(mesh) {}
  std::uint32_t find_or_add(const std::string& name);
  // The same, of a material that a library says the look of.
  std::uint32_t define(const std::string& name);
  std::uint32_t add_texture(const std::string& uri);
  // Mentioned, but never defined; ascending.
  std::vector<std::uint32_t> undefined() const;

 private:
  Mesh& mesh_;
  std::vector<bool> defined_;  // one a material
  std::map<std::string, std::uint32_t> by_name_, texture_by_uri_;
};

// Reads Ka Kd Ks Ke Ns d Tr map_Kd map_d of every newmtl into the mesh's materials; what it does not know it
// skips, what it cannot read it warns about. Colours are taken as linear, as Blender writes them
// (docs/import.md).
void read_mtl(std::string_view text, const std::string& name, MaterialTable& table, MeshBuilder& builder);

}  // namespace copse
