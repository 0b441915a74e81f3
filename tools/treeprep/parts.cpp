#include "tools/treeprep/parts.h"

#include "lib/formats/tree_file/omit.h"

#include <algorithm>
#include <set>

namespace copse::treeprep {
namespace {

using Names = std::set<std::string, std::less<>>;

std::string known_names() {
  std::string names;
  for (const PartName& part : part_names()) names += (names.empty() ? "" : ", ") + part.name;
  for (const Omissible& section : omissible_sections()) names += ", " + std::string(section.name);
  return names;
}

Result<Names> sections_of(const std::vector<std::string>& names, const char* option) {
  Names sections;
  for (const std::string& name : names) {
    const auto part = std::find_if(part_names().begin(), part_names().end(),
                                   [&](const PartName& p) { return p.name == name; });
    const bool is_section = std::any_of(omissible_sections().begin(), omissible_sections().end(),
                                        [&](const Omissible& s) { return s.name == name; });
    if (part != part_names().end()) {
      sections.insert(part->sections.begin(), part->sections.end());
    } else if (is_section) {
      sections.insert(name);
    } else {
      return fail(Fault::usage, "", std::string(option) + " does not know '" + name + "'",
                  "use one of: " + known_names());
    }
  }
  return sections;
}

// Whether one of `kept` is meaningless without `section`, directly or through others.
bool is_needed(std::string_view section, const Names& kept) {
  if (kept.contains(section)) return true;
  for (const Omissible& s : omissible_sections()) {
    if (s.name != section) continue;
    for (std::size_t at = 0; at + 4 <= s.also.size(); at += 5) {
      if (kept.contains(s.also.substr(at, 4))) return true;
    }
  }
  return false;
}

// Keeps adding what is needed until nothing more is.
Names with_needed(Names kept) {
  for (bool grew = true; grew;) {
    grew = false;
    for (const Omissible& s : omissible_sections()) {
      if (!kept.contains(s.name) && is_needed(s.name, kept)) kept.emplace(s.name), grew = true;
    }
  }
  return kept;
}

}  // namespace

const std::vector<PartName>& part_names() {
  static const std::vector<PartName> k_names{
      {"lines", "a line a segment, for distant branches", {"TLIN", "TDIA", "TACC"}},
      {"trunk-normals", "normals of the trunk", {"TNRM"}},
      {"trunk-texcoords", "texture coordinates of the trunk", {"TTEX"}},
      {"leaves", "all about leaves", {"LTRI", "LCEN", "LMAT", "LGRP", "LORD", "LGHI"}},
      {"leaf-geometry", "the leaves' triangles; centres and groups stay", {"LTRI"}},
      {"leaf-normals", "normals of the leaves", {"LNRM"}},
      {"leaf-texcoords", "texture coordinates of the leaves", {"LTEX"}},
      {"leaf-groups", "which leaves hang on which terminal radius", {"LGRP", "LORD", "LGHI"}},
      {"group-hierarchy", "bounding spheres over the leaf groups", {"LGHI"}},
      {"textures", "texture references and embedded images", {"TEXR", "TDAT"}},
  };
  return k_names;
}

Result<LeftOut> left_out_parts(const std::vector<std::string>& omit, const std::vector<std::string>& only) {
  if (!omit.empty() && !only.empty()) {
    return fail(Fault::usage, "", "--omit and --only exclude each other", "give one of them");
  }
  auto named = only.empty() ? sections_of(omit, "--omit") : sections_of(only, "--only");
  if (!named) return std::unexpected(named.error());
  const Names kept = only.empty() ? Names{} : with_needed(*named);
  LeftOut out;
  for (const Omissible& s : omissible_sections()) {
    const bool gone = only.empty() ? named->contains(s.name) : !kept.contains(s.name);
    if (!gone) continue;
    out.sections.emplace_back(s.name);
    out.groups |= s.name == "LGRP";
    out.group_hierarchy |= s.name == "LGHI";
    out.textures |= s.name == "TEXR";
  }
  out.group_hierarchy |= out.groups;
  return out;
}

}  // namespace copse::treeprep
