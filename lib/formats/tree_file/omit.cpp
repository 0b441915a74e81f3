#include "lib/formats/tree_file/omit.h"

#include "lib/formats/materials.h"
#include "lib/formats/tree/tree_sections.h"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

namespace copse {
namespace {

using Names = std::set<std::string, std::less<>>;

const Omissible* find(std::string_view name) {
  const auto& all = omissible_sections();
  const auto at = std::find_if(all.begin(), all.end(), [&](const Omissible& o) { return o.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::unexpected<Error> not_omissible(const std::string& name) {
  std::string known;
  for (const Omissible& o : omissible_sections())
    known += fmt::format("{}{}", known.empty() ? "" : ", ", o.name);
  if (name == "RADI") {
    return fail(Fault::usage, "", "section RADI cannot be left out: an .stree is its hierarchy",
                "write a .tree");
  }
  return fail(Fault::usage, "", fmt::format("section '{}' cannot be left out", name), "choose from " + known);
}

// The named sections and all that goes with them.
Result<Names> closure(const std::vector<std::string>& names) {
  Names done;
  std::vector<std::string> open = names;
  while (!open.empty()) {
    const std::string name = std::move(open.back());
    open.pop_back();
    const Omissible* section = find(name);
    if (!section) return not_omissible(name);
    if (!done.insert(name).second) continue;
    for (std::size_t at = 0; at + 4 <= section->also.size(); at += 5) {
      open.emplace_back(section->also.substr(at, 4));
    }
  }
  return done;
}

// Decoded bytes of a section, with those of what has no name of its own: offsets and texts.
std::uint64_t section_bytes(const Tree& tree, std::string_view name) {
  if (name == "PROV") return tree.provenance.size();
  if (name == "MATL") {
    const auto encoded = encode_materials(tree.materials);
    return encoded.records.size() + encoded.names.size();
  }
  std::uint64_t bytes = 0;
  if (name == "TEXR" || name == "TDAT") {
    for (const Texture& t : tree.textures) {
      bytes += name == "TDAT" ? t.bytes.size() : k_texture_record + t.uri.size() + t.mime.size();
    }
    return bytes;
  }
  const auto offsets_of = [](std::string_view section) -> std::string_view {
    return section == "RVEC" ? "RFIR" : section == "TTRI" ? "TFIR" : section == "LTRI" ? "LFIR" : "";
  };
  for_each_array(tree, {.header = tree.header, .counts = {}},
                 [&](std::string_view section, const auto& array, std::uint64_t, Presence) {
                   if (section == name || section == offsets_of(name)) bytes += array.span().size_bytes();
                 });
  return bytes;
}

// Sets the normals' (texture coordinates') indices of all corners to k_none.
Array<CornerTriangle> without(const Array<CornerTriangle>& triangles, bool normals, bool texcoords) {
  std::vector<CornerTriangle> out = triangles.to_vector();
  for (CornerTriangle& t : out) {
    if (normals) t.normal = {k_none, k_none, k_none};
    if (texcoords) t.texcoord = {k_none, k_none, k_none};
  }
  return out;
}

void leave_out_materials(Tree& tree, const Names& gone) {
  if (gone.contains("PROV")) tree.provenance.clear();
  if (gone.contains("MATL")) tree.materials.clear(), tree.trunk.material = tree.leaves.material = k_none;
  if (gone.contains("TDAT")) {
    for (Texture& t : tree.textures) t.bytes.clear();
  }
  if (gone.contains("TEXR")) {
    tree.textures.clear();
    for (Material& m : tree.materials) m.texture = k_none;
  }
}

void leave_out_trunk(Tree& tree, const Names& gone) {
  Trunk& t = tree.trunk;
  const auto normals = gone.contains("TNRM"), texcoords = gone.contains("TTEX");
  if (gone.contains("TTRI")) {
    t.triangles = {}, t.first_triangle = {};
    tree.header.segment_factor = tree.header.unexplained = 0;
  } else if ((normals && !t.normals.empty()) || (texcoords && !t.texcoords.empty())) {
    t.triangles = without(t.triangles, normals, texcoords);
  }
  if (gone.contains("RVEC") && tree.header.kind == TreeKind::sensitive) {
    tree.hierarchy.vectors = {}, tree.hierarchy.first_vector = {};
    tree.header.ring_size = 0;
  }
  if (gone.contains("TVTX")) t.vertices = {};
  if (gone.contains("TLVX")) t.line_vertices = {};
  if (gone.contains("TLIN")) t.lines = {};
  if (gone.contains("TDIA")) t.diameters = {};
  if (gone.contains("TACC")) t.accumulated_lengths = {};
  if (gone.contains("TMAT")) t.materials = {};
  if (normals) t.normals = {};
  if (texcoords) t.texcoords = {};
}

// A terminal radius whose group is gone carries none.
void forget_groups(Tree& tree) {
  std::vector<Radius> radii = tree.hierarchy.radii.to_vector();
  for (Radius& r : radii) {
    if (r.flags & Radius::terminal) r.child_count = 0, r.first_child = k_none;
  }
  tree.hierarchy.radii = std::move(radii);
}

void leave_out_leaves(Tree& tree, const Names& gone) {
  Leaves& l = tree.leaves;
  const auto normals = gone.contains("LNRM"), texcoords = gone.contains("LTEX");
  if (gone.contains("LTRI")) {
    l.triangles = {}, l.first_triangle = {};
    tree.header.leaf_factor = 0;
  } else if ((normals && !l.normals.empty()) || (texcoords && !l.texcoords.empty())) {
    l.triangles = without(l.triangles, normals, texcoords);
  }
  if (gone.contains("LVTX")) l.vertices = {};
  if (gone.contains("LCEN")) l.centres = {};
  if (gone.contains("LMAT")) l.materials = {};
  if (normals) l.normals = {};
  if (texcoords) l.texcoords = {};
  if (gone.contains("LORD")) l.order = {};
  if (gone.contains("LGHI")) l.group_hierarchy = {};
  if (gone.contains("LGRP")) {
    if (!l.groups.empty()) forget_groups(tree);
    l.groups = {};
  }
}

// Optional arrays that the tree came without, although it has what they belong to.
std::vector<Omitted> already_gone(const Tree& tree) {
  std::vector<Omitted> gone;
  const Head head = head_of(tree);
  for_each_array(tree, head,
                 [&](std::string_view name, const auto& array, std::uint64_t size, Presence presence) {
                   using Element = std::remove_cvref_t<decltype(array[0])>;
                   if (presence == Presence::optional && array.empty() && size > 0) {
                     gone.push_back({std::string(name), size * sizeof(Element)});
                   }
                 });
  return gone;
}

}  // namespace

const std::vector<Omissible>& omissible_sections() {
  static const std::vector<Omissible> k_sections{
      {"PROV", "provenance", ""},
      {"MATL", "materials", "TMAT LMAT TEXR"},
      {"TEXR", "textures", "TDAT"},
      {"RVEC", "vertex vectors of the hierarchy: the trunk's surface", "TTRI"},
      {"TTRI", "triangles of the trunk", "RVEC TVTX TMAT TNRM TTEX"},
      {"TLIN", "lines of the trunk", "TLVX"},
      {"TDIA", "diameters of the segments", ""},
      {"TACC", "accumulated lengths of the segments", ""},
      {"TMAT", "materials of the trunk's triangles", ""},
      {"TVTX", "vertices of the trunk", "TTRI"},
      {"TLVX", "vertices of the trunk's lines", "TLIN"},
      {"TNRM", "normals of the trunk", ""},
      {"TTEX", "texture coordinates of the trunk", ""},
      {"LTRI", "triangles of the leaves", "LVTX LNRM LTEX"},
      {"LCEN", "centres of the leaves: their points", ""},
      {"LMAT", "materials of the leaves", ""},
      {"LVTX", "vertices of the leaves", "LTRI"},
      {"LNRM", "normals of the leaves", ""},
      {"LTEX", "texture coordinates of the leaves", ""},
      {"LGRP", "leaf groups", "LORD LGHI"},
      {"LORD", "order of the leaves in their groups", ""},
      {"LGHI", "hierarchy of spheres over the leaf groups", ""},
      {"TDAT", "embedded image files", ""},
  };
  return k_sections;
}

Result<Reduced> leave_out(const Tree& tree, const std::vector<std::string>& names) {
  const Result<Names> gone = closure(names);
  if (!gone) return std::unexpected(gone.error());
  // Only these two exist in one kind alone; the other kind has nothing to leave out under their names.
  const bool sensitive = tree.header.kind == TreeKind::sensitive;
  const auto foreign = [&](std::string_view name) {
    return sensitive ? name == "TVTX" || name == "TLVX" : name == "RVEC";
  };
  const std::vector<Omitted> before = already_gone(tree);
  Reduced reduced{.tree = tree, .omitted = {}};
  leave_out_materials(reduced.tree, *gone);
  leave_out_trunk(reduced.tree, *gone);
  leave_out_leaves(reduced.tree, *gone);
  for (const Omissible& o : omissible_sections()) {
    const auto known =
        std::find_if(before.begin(), before.end(), [&](const Omitted& b) { return b.name == o.name; });
    if (known != before.end()) {
      reduced.omitted.push_back(*known);
    } else if (gone->contains(o.name) && !foreign(o.name)) {
      reduced.omitted.push_back({std::string(o.name), section_bytes(tree, o.name)});
    }
  }
  return reduced;
}

}  // namespace copse
