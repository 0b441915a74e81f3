#include "lib/analysis/leaves/classify.h"

#include "lib/analysis/leaves/leaf_units.h"
#include "lib/analysis/leaves/part_verdicts.h"
#include "lib/analysis/leaves/piece_rules.h"
#include "lib/analysis/leaves/piece_scan.h"
#include "lib/analysis/leaves/pieces.h"
#include "lib/analysis/surface/weld.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

// Parts of one key may form one piece: all that is surely trunk, all that is surely leaf, and of the rest
// what has one material and one verdict.
Indices keys_of_parts(const Mesh& mesh, const std::vector<PartVerdict>& verdicts) {
  using Key = std::tuple<NameClass, Binding, std::uint32_t>;
  const auto key_of = [&](std::size_t p) {
    const PartVerdict& v = verdicts[p];
    return Key{v.kind, v.binding, v.binding == Binding::firm ? k_none : mesh.parts[p].material};
  };
  std::vector<Key> known;
  for (std::size_t p = 0; p < verdicts.size(); ++p) known.push_back(key_of(p));
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  Indices keys;
  for (std::size_t p = 0; p < verdicts.size(); ++p) {
    keys.push_back(
        static_cast<std::uint32_t>(std::lower_bound(known.begin(), known.end(), key_of(p)) - known.begin()));
  }
  return keys;
}

// Welds what lies near each other on the borders of undecided pieces that are not flat: a tube whose seam was
// computed twice would pass for a sheet otherwise. Cards need no such care, and they are the many. Answers
// whether anything was welded.
bool weld_borders(const Mesh& mesh, const PieceScan& scan, Indices& welded) {
  // The vertices of these pieces alone, under numbers of their own.
  Indices number(mesh.positions.size(), k_none), vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> on_border;
  const auto number_of = [&](std::uint32_t v) {
    std::uint32_t& n = number[welded[v]];
    if (n == k_none) {
      n = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(welded[v]);
      on_border.push_back(0);
    }
    return n;
  };
  scan.for_each_bent_piece([&](std::span<const std::uint32_t> piece) {
    for (const std::uint32_t t : piece) {
      const Triangle& v = mesh.triangles[t];
      triangles.push_back({number_of(v[0]), number_of(v[1]), number_of(v[2])});
      for (int e = 0; e < 3; ++e) {
        if (!(scan.pieces().edges[t] & Pieces::border_0 << e)) continue;
        on_border[triangles.back()[e]] = on_border[triangles.back()[(e + 1) % 3]] = 1;
      }
    }
  });
  if (triangles.empty()) return false;
  std::vector<Double3> positions;
  for (const std::uint32_t v : vertices) positions.push_back(mesh.positions[v]);
  Indices equal = weld(positions, 0.0);
  std::vector<double> reach = weld_tolerances(positions, triangles, equal);
  for (std::size_t i = 0; i < reach.size(); ++i) reach[i] *= on_border[i];
  const Indices joined = weld(positions, reach, std::move(equal));
  bool changed = false;
  for (std::uint32_t i = 0; i < joined.size(); ++i) {
    welded[vertices[i]] = vertices[joined[i]];
    changed |= joined[i] != i;
  }
  // A representative may have moved on: whoever pointed to it follows.
  if (changed) {
    for (std::uint32_t& v : welded) v = welded[v];
  }
  return changed;
}

Classification collect(const Mesh& mesh, const Indices& welded, const PieceScan& scan, PieceClasses classes) {
  Classification out;
  const Pieces& pieces = scan.pieces();
  std::vector<std::uint8_t> is_leaf(pieces.count);
  for (std::uint32_t p = 0; p < pieces.count; ++p) is_leaf[p] = classes.kind[p] == PartClass::leaf;
  const LeafUnits units = leaf_units(mesh, welded, scan.triangles(), is_leaf);
  out.leaf_count = units.count;
  out.reasons = std::make_shared<const std::vector<std::string>>(std::move(classes.reasons));
  out.components.resize(pieces.count);
  for (std::uint32_t p = 0; p < pieces.count; ++p) {
    const std::span<const std::uint32_t> triangles = scan.triangles().of(p);
    const auto n = static_cast<std::uint32_t>(triangles.size());
    out.components[p] = {classes.kind[p], (*out.reasons)[classes.reason[p]], mesh.part_of[triangles[0]], n};
    (is_leaf[p] ? out.leaf_triangles : out.trunk_triangles) += n;
  }
  out.leaf_of.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) out.leaf_of[t] = units.of[pieces.of[t]];
  return out;
}

Classification classify_pieces(const Mesh& mesh, Indices& welded, bool refine,
                               const std::vector<PartVerdict>& verdicts) {
  const Indices keys = keys_of_parts(mesh, verdicts);
  const auto scan_pieces = [&] {
    return PieceScan(mesh, welded, edge_pieces(mesh.triangles, welded, mesh.part_of, keys), verdicts);
  };
  std::optional<PieceScan> scan(scan_pieces());
  if (refine && weld_borders(mesh, *scan, welded)) {
    scan.reset();  // first: there may be millions of pieces
    scan.emplace(scan_pieces());
  }
  Classification out = collect(mesh, welded, *scan, classify_pieces_by_rule(mesh, welded, *scan, verdicts));
  out.component_of = std::move(*scan).take_piece_of();
  return out;
}

// Whether a piece of trunk reaches a quarter of the mesh's height: something for leaves to hang on.
bool has_trunk_of_size(const Mesh& mesh, const Classification& c) {
  constexpr double k_share = 0.25;
  std::vector<DoubleBox> boxes(c.components.size());
  DoubleBox all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      all.grow(mesh.positions[v]);
      boxes[c.component_of[t]].grow(mesh.positions[v]);
    }
  }
  for (std::size_t p = 0; p < boxes.size(); ++p) {
    const bool is_trunk = c.components[p].kind == PartClass::trunk && !boxes[p].empty();
    if (is_trunk && boxes[p].extent().y >= k_share * all.extent().y) return true;
  }
  return false;
}

// A name that says leaf of a whole tree ("LeafyOak") beside something without a say (a stone) leaves no
// trunk: then names bind as they do where all bear them, and what they said stands unless that finds a trunk.
void look_for_trunk_in_leaves(const Mesh& mesh, Indices& welded, bool refine,
                              std::vector<PartVerdict>& verdicts, Classification& found) {
  if (has_trunk_of_size(mesh, found) || !loosen_leaf_names(verdicts)) return;
  Classification again = classify_pieces(mesh, welded, refine, verdicts);
  if (has_trunk_of_size(mesh, again)) found = std::move(again);
}

Result<Classification> check_and_classify(const Mesh& mesh, Indices welded, bool refine,
                                          const ClassifyOptions& options) {
  constexpr std::size_t k_most_triangles = 0xffffffffu / 3;
  if (mesh.triangles.size() > k_most_triangles) {
    return refuse("", "the mesh has more than " + std::to_string(k_most_triangles) + " triangles",
                  "split it into several files");
  }
  Result<std::vector<PartVerdict>> verdicts = part_verdicts(mesh, options);
  if (!verdicts) return std::unexpected(std::move(verdicts.error()));
  Classification found = classify_pieces(mesh, welded, refine, *verdicts);
  if (options.trunk_patterns.empty() && options.leaf_patterns.empty())
    look_for_trunk_in_leaves(mesh, welded, refine, *verdicts, found);
  return found;
}

}  // namespace

Result<Classification> classify(const Mesh& mesh, const ClassifyOptions& options) {
  return check_and_classify(mesh, weld(mesh.positions, 0.0), true, options);
}

Result<Classification> classify(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                const ClassifyOptions& options) {
  return check_and_classify(mesh, {welded.begin(), welded.end()}, false, options);
}

}  // namespace copse
