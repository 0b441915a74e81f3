// The named ways in which a mesh can break the strict model of the thesis (digest 000, section 1.1).
// Each is independent of the others; those of one group exclude one another.
#pragma once

#include "lib/formats/result.h"

#include <bitset>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace copse::grow {

enum class Break : std::uint8_t {
  // how a branch joins its parent (strict: the parent's ring has a band of triangles to each child ring)
  free_tubes,
  laid_against,
  welded_forks,
  extruded,
  extruded_faces,
  inset_faces,
  // how a tube ends (strict: at an open ring)
  open_ends,
  capped_fan,
  capped_ngon,
  pointed,
  collapsed_rings,
  // rings and tubes
  seams,
  loose_seams,
  vary_k,
  huge_rings,
  rough,
  end_to_end,
  end_to_end_turned,
  // leaves (strict: one isolated triangle each)
  quad_cards,
  crossed_cards,
  bent_cards,
  two_sided_cards,
  discs,
  fronds,
  needles,
  blobs,
  touching_leaves,
  leaves_on_bark,
  // faces
  quads,
  split_normals,
  no_normals,
  no_uvs,
  shuffled,
  flipped,
  duplicate_triangles,
  degenerate_triangles,
  stray_vertices,
  // names and materials
  no_names,
  neutral_names,
  one_material,
  leafy_name,
  // the scene
  several_trees,
  z_up,
  centimetres,
  root_at_zero,
  root_above_ground,
  far_offset,
};
inline constexpr std::size_t k_break_count = static_cast<std::size_t>(Break::far_offset) + 1;

// What excludes what.
enum class BreakGroup : std::uint8_t { none, join, ends, turned, leaf, names, root };

struct BreakInfo {
  Break id;
  const char* name;  // as on the command line
  BreakGroup group;
  const char* what;   // what is done to the mesh
  const char* truth;  // what the truth then says; empty: nothing changes
};

const std::vector<BreakInfo>& break_table();  // in the order of the enum

class Breaks {
 public:
  bool has(Break id) const { return set_[static_cast<std::size_t>(id)]; }
  void add(Break id);  // takes the others of its group out
  // Whether branches are pulled out of their parents' surface, and whether out of single faces of it.
  bool pulls_faces() const { return has(Break::extruded_faces) || has(Break::inset_faces); }
  bool pulls_out() const { return has(Break::extruded) || pulls_faces(); }
  bool none() const { return set_.none(); }
  std::vector<std::string> names() const;
  friend bool operator==(const Breaks&, const Breaks&) = default;

 private:
  std::bitset<k_break_count> set_;
};

// What an artist's export usually looks like, and what treegrow makes when nothing else is said.
Breaks artist_breaks();

// A comma-separated list of names; "none" is the strict model and "artist" stands for artist_breaks(), out of
// which names of the same group then take the artist's. Two names of one group are refused.
Result<Breaks> parse_breaks(std::string_view list);

}  // namespace copse::grow
