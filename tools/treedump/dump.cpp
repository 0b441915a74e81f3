#include "tools/treedump/dump.h"

#include "lib/formats/tree/tree_sections.h"

#include <algorithm>
#include <array>
#include <utility>

namespace copse {
namespace {

using Name = std::pair<std::string_view, std::string_view>;

constexpr std::array k_sections{Name{"HEAD", "header"},
                                Name{"PROV", "provenance"},
                                Name{"OMIT", "what was left out"},
                                Name{"MATL", "materials"},
                                Name{"MNAM", "names of the materials"},
                                Name{"TEXR", "textures"},
                                Name{"TNAM", "names of the textures"},
                                Name{"PACK", "trunk, leaves and hierarchy, packed"},
                                Name{"TDAT", "embedded images"},
                                Name{"RADI", "radii of the hierarchy"},
                                Name{"RFIR", "first vector of each radius"},
                                Name{"RVEC", "vectors from centre to vertex"},
                                Name{"TTRI", "trunk triangles"},
                                Name{"TFIR", "first triangle of each segment"},
                                Name{"TLIN", "lines of the segments"},
                                Name{"TDIA", "diameters of the segments"},
                                Name{"TACC", "accumulated lengths"},
                                Name{"TMAT", "material of each trunk triangle"},
                                Name{"TVTX", "trunk vertices"},
                                Name{"TLVX", "vertices of the lines"},
                                Name{"TNRM", "trunk normals"},
                                Name{"TTEX", "trunk texture coordinates"},
                                Name{"LTRI", "leaf triangles"},
                                Name{"LFIR", "first triangle of each leaf"},
                                Name{"LCEN", "leaf centres"},
                                Name{"LMAT", "material of each leaf"},
                                Name{"LVTX", "leaf vertices"},
                                Name{"LNRM", "leaf normals"},
                                Name{"LTEX", "leaf texture coordinates"},
                                Name{"LGRP", "leaf groups"},
                                Name{"LORD", "order of the leaves"},
                                Name{"LGHI", "spheres over the leaf groups"},
                                Name{"EHED", "header"},
                                Name{"ETYP", "types of trees"},
                                Name{"ENAM", "names of the types"},
                                Name{"EVOL", "bounding volumes of the types"},
                                Name{"EVNM", "numbers of these volumes"},
                                Name{"EHGT", "heights of the terrain"},
                                Name{"EPNT", "vertices of the terrain"},
                                Name{"EBOX", "box hierarchy"},
                                Name{"EKDT", "kd-tree over the blocks"},
                                Name{"ERTR", "R-tree over the blocks"},
                                Name{"EBLK", "blocks of instances"},
                                Name{"EHSH", "hashes of the blocks' instances"},
                                Name{"EINS", "instances, 24 bytes"},
                                Name{"EINX", "instances, 48 bytes"},
                                Name{"VSET", "sets of bounding volumes"},
                                Name{"VOLU", "bounding volumes"},
                                Name{"VNUM", "numbers of the volumes"},
                                Name{"VNOD", "hierarchy of volumes"},
                                Name{"LSTR", "level-of-detail spectrum of the trunk"},
                                Name{"LSLV", "level-of-detail spectrum of the leaves"},
                                Name{"LSLD", "levels of detail"},
                                Name{"FCEL", "cells of the foliage"},
                                Name{"FORD", "order of the leaves in their cells"},
                                Name{"FVWS", "views of the foliage"},
                                Name{"FVTR", "triangles of these views"},
                                Name{"FVIS", "visibility of the cells"},
                                Name{"FPAR", "parameters of foliage pruning"},
                                Name{"IMPO", "impostor: its views"},
                                Name{"IMPA", "impostor: colours"},
                                Name{"IMPN", "impostor: normals and depths"}};

void note(Dump& dump, const Error& error) {
  if (!dump.problem) dump.problem = error;
}

// Reads one section of `file` into `tree`; what fails leaves it empty. Textures come with their images.
void load_section(Dump& dump, const std::string& name) {
  if (name == "TDAT") return;
  auto part = name == "TEXR" ? dump.file->load({"TEXR", "TDAT"}) : dump.file->load({name});
  if (!part && name == "TEXR") note(dump, part.error()), part = dump.file->load({name});
  if (!part && part.error().fault == Fault::usage) return;  // what other tools have added is read elsewhere
  if (!part) return note(dump, part.error());
  if (name == "PROV") dump.tree.provenance = std::move(part->provenance);
  if (name == "MATL") dump.tree.materials = std::move(part->materials);
  if (name == "TEXR") dump.tree.textures = std::move(part->textures);
  const Head head{.header = part->header, .counts = dump.file->counts()};
  std::vector<std::pair<std::string_view, void*>> targets;
  for_each_array(dump.tree, head, [&](std::string_view section, auto& array, std::uint64_t, Presence) {
    targets.emplace_back(section, &array);
  });
  for_each_array(
      *part, head, [&]<class T>(std::string_view section, Array<T>& array, std::uint64_t, Presence) {
        if (section != name) return;
        const auto target =
            std::find_if(targets.begin(), targets.end(), [&](const auto& t) { return t.first == section; });
        *static_cast<Array<T>*>(target->second) = std::move(array);
      });
}

}  // namespace

std::string_view describe_section(std::string_view name) {
  const auto at =
      std::find_if(k_sections.begin(), k_sections.end(), [&](const Name& n) { return n.first == name; });
  if (at != k_sections.end()) return at->second;
  return name.size() == 4 && name[0] == 'P' &&
                 name.find_first_not_of("0123456789ABCDEF", 1) == std::string_view::npos
             ? "a packed tree"
             : "unknown to this version";
}

std::string_view encoding_name(Encoding encoding) {
  return encoding == Encoding::zstd ? "zstd" : "raw";
}

std::string_view kind_name(FileKind kind) {
  switch (kind) {
    case FileKind::tree:
      return "still tree (.tree)";
    case FileKind::stree:
      return "sensitive tree (.stree)";
    case FileKind::eco:
      break;
  }
  return "ecosystem (.eco)";
}

Result<Dump> open_dump(const std::filesystem::path& path, const std::vector<std::string>& wanted) {
  auto container = Container::open(path);
  if (!container) return std::unexpected(container.error());
  Dump dump{.path = path,
            .container = std::move(*container),
            .sections = {},
            .file = {},
            .tree = {},
            .problem = {}};
  for (const SectionInfo& info : dump.container.sections()) {
    const auto sound = dump.container.verify(info);
    dump.sections.push_back({.info = info, .damage = sound ? std::string() : sound.error().what});
    if (!sound) note(dump, sound.error());
  }
  auto file = TreeFile::open(path, Trust::checksums);
  if (!file) {
    note(dump, file.error());
    return dump;
  }
  dump.file = std::move(*file);
  if (const auto frame = dump.file->load(std::vector<std::string>{})) {
    dump.tree = *frame;  // the header and what it says of materials
  }
  for (const SectionState& section : dump.sections) {
    const std::string& name = section.info.name;
    const bool asked = wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
    if (!asked || !section.damage.empty()) continue;
    if (name != "PACK") {
      load_section(dump, name);
      continue;
    }
    const Head head{.header = dump.tree.header, .counts = dump.file->counts()};
    const Tree none;
    for_each_array(none, head, [&](std::string_view packed, const auto&, std::uint64_t, Presence) {
      if (dump.file->has(packed)) load_section(dump, std::string(packed));
    });
  }
  return dump;
}

}  // namespace copse
