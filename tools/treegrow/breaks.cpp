#include "tools/treegrow/breaks.h"

#include <algorithm>
#include <ranges>

namespace copse::grow {

const std::vector<BreakInfo>& break_table() {
  using enum Break;
  using G = BreakGroup;
  static const std::vector<BreakInfo> table{
      {free_tubes, "free-tubes", G::join,
       "branches are tubes of their own that start inside the parent, on its middle line",
       "first ring's parent is the nearer of the two parent rings that it lies between (`attach`)"},
      {laid_against, "laid-against", G::join,
       "branches are tubes of their own that touch the parent's surface from outside", "as free-tubes"},
      {welded_forks, "welded-forks", G::join,
       "a fork is one welded surface: both arms share a saddle of vertices and half of the parent's ring "
       "each",
       "the arms' first whole rings are children of the parent's ring"},
      {extruded, "extruded", G::join,
       "a branch is pulled out of a patch of the parent's faces: its foot is cut into two parent rings",
       "first ring's parent is the lower of the two cut rings (`attach` names both)"},
      {extruded_faces, "extruded-faces", G::join, "a branch is one face of its parent's, pulled out: k = 4",
       "as extruded"},
      {inset_faces, "inset-faces", G::join,
       "as extruded-faces; the face is inset first, so that a frame of four faces is left of it",
       "the inset's outline is the branch's first ring"},
      {open_ends, "open-ends", G::ends, "tubes end in an open ring (as in the strict model)", ""},
      {capped_fan, "capped-fan", G::ends, "every open end is closed by triangles to a vertex in its middle",
       ""},
      {capped_ngon, "capped-ngon", G::ends, "every open end is closed by one polygon of k corners", ""},
      {pointed, "pointed", G::ends, "tips run out into a single vertex beyond the last ring",
       "the point is a ring of diameter 0 with `tip` = 1"},
      {collapsed_rings, "collapsed-rings", G::ends,
       "tips end in a ring whose k vertices are all in one point; half of its triangles have no area",
       "as pointed"},
      {seams, "seams", G::none, "rings have k + 1 vertices: the first is there twice, for the texture's edge",
       ""},
      {loose_seams, "loose-seams", G::none,
       "what should coincide (seams, tubes laid end to end) is apart by up to 1e-6 of the height", ""},
      {vary_k, "vary-k", G::none, "k falls from level to level", "`k` of each branch"},
      {huge_rings, "huge-rings", G::none, "k is twelve times as large; with vary-k that of the trunk alone",
       "`k` of each branch"},
      {rough, "rough", G::none,
       "ring vertices are moved by up to 12 % of the radius: no ring is round or flat",
       "centre and diameter are those of the moved vertices"},
      {end_to_end, "end-to-end", G::turned,
       "stems are cut into tubes of three segments, laid end to end and not welded", ""},
      {end_to_end_turned, "end-to-end-turned", G::turned,
       "the same, each tube turned by half a side: no vertices coincide",
       "the second of two such rings has `same_as`"},
      {quad_cards, "quad-cards", G::leaf, "a leaf is a flat card of two triangles", "`triangles`"},
      {crossed_cards, "crossed-cards", G::leaf, "a leaf is two cards that cross, not connected",
       "`components`, `triangles`"},
      {bent_cards, "bent-cards", G::leaf, "a leaf is a bent card of 3 x 3 vertices, 8 triangles",
       "`triangles`"},
      {two_sided_cards, "two-sided-cards", G::leaf,
       "a leaf is two coincident cards, back to back, with vertices of their own",
       "`components`, `triangles`"},
      {discs, "discs", G::leaf, "a leaf is a flat polygon of 8 corners, 6 triangles", "`triangles`"},
      {fronds, "fronds", G::leaf, "a leaf is a folded, drooping strip of 24 triangles", "`triangles`"},
      {needles, "needles", G::leaf, "a leaf is a needle of two triangles, 14 times as long as wide",
       "`triangles`"},
      {blobs, "blobs", G::leaf, "leaves are closed lumps of 80 triangles", "`triangles`; a lump is one leaf"},
      {touching_leaves, "touching-leaves", G::none,
       "leaves that follow one another on a twig touch at the stalk: welded by position they are one piece",
       ""},
      {leaves_on_bark, "leaves-on-bark", G::none,
       "leaves touch the trunk: the stalk's vertex has the position of a ring vertex", ""},
      {quads, "quads", G::none,
       "bark and cards are four-cornered faces (in an OBJ; the other formats hold triangles)", ""},
      {split_normals, "split-normals", G::none, "flat shading: every face has its own vertices", ""},
      {no_normals, "no-normals", G::none, "no normals", ""},
      {no_uvs, "no-uvs", G::none, "no texture coordinates", ""},
      {shuffled, "shuffled", G::none, "vertices and faces are in random order", ""},
      {flipped, "flipped", G::none, "half of the faces are turned over", ""},
      {duplicate_triangles, "duplicate-triangles", G::none, "one triangle in fifty is there twice", ""},
      {degenerate_triangles, "degenerate-triangles", G::none,
       "one triangle in fifty more, with two equal corners or without area", ""},
      {stray_vertices, "stray-vertices", G::none, "one vertex in fifty more, which no face names", ""},
      {no_names, "no-names", G::names, "no objects, groups, materials or textures", ""},
      {neutral_names, "neutral-names", G::names, "names say nothing: Object.001, Material.001, Material.002",
       ""},
      {one_material, "one-material", G::names,
       "one object and one material with one texture for bark and leaves", ""},
      {leafy_name, "leafy-name", G::names,
       "the one object is called by its leaves (Leafy_birch) and the materials say nothing", ""},
      {several_trees, "several-trees", G::none, "three trees in one mesh", "one root a stem"},
      {z_up, "z-up", G::none, "+Z is up", "in the mesh's frame, `up_axis` = z"},
      {centimetres, "centimetres", G::none, "units are centimetres", "in the mesh's units"},
      {root_at_zero, "root-at-zero", G::root, "the root ring lies at y = 0", ""},
      {root_above_ground, "root-above-ground", G::root,
       "the root ring lies a tenth of the height above y = 0", ""},
      {far_offset, "far-offset", G::none, "the tree stands 1e7 m east and 2e7 m south of the origin",
       "in the mesh's frame"},
  };
  return table;
}

void Breaks::add(Break id) {
  const auto& table = break_table();
  const BreakGroup group = table[static_cast<std::size_t>(id)].group;
  for (const BreakInfo& other : table)
    if (group != BreakGroup::none && other.group == group) set_.reset(static_cast<std::size_t>(other.id));
  set_.set(static_cast<std::size_t>(id));
}

std::vector<std::string> Breaks::names() const {
  std::vector<std::string> names;
  for (const BreakInfo& info : break_table())
    if (has(info.id)) names.emplace_back(info.name);
  return names;
}

Breaks artist_breaks() {
  Breaks breaks;
  for (const Break id :
       {Break::free_tubes, Break::pointed, Break::seams, Break::vary_k, Break::quad_cards, Break::quads})
    breaks.add(id);
  return breaks;
}

Result<Breaks> parse_breaks(std::string_view list) {
  if (list.empty())
    return fail(Fault::usage, "", "--break: no name is given", "--list-breaks shows them all");
  Breaks breaks;
  std::vector<const BreakInfo*> named;
  for (const auto part : std::views::split(list, ',')) {
    const std::string_view name(part.begin(), part.end());
    if (name == "none") continue;
    if (name == "artist") {
      breaks = artist_breaks();
      continue;
    }
    const auto& table = break_table();
    const auto found = std::ranges::find_if(table, [&](const BreakInfo& i) { return i.name == name; });
    if (found == table.end())
      return fail(Fault::usage, "",
                  "--break: there is no way to break a mesh called '" + std::string(name) + "'",
                  "--list-breaks shows them all");
    named.push_back(&*found);
  }
  for (const BreakInfo* info : named) {
    for (const BreakInfo* other : named)
      if (other != info && info->group != BreakGroup::none && other->group == info->group &&
          other->id != info->id)
        return fail(Fault::usage, "",
                    "--break: " + std::string(info->name) + " and " + other->name + " exclude one another",
                    "name one of them");
    breaks.add(info->id);
  }
  return breaks;
}

}  // namespace copse::grow
