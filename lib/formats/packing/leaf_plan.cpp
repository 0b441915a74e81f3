#include "lib/formats/packing/leaf_plan.h"

#include "lib/formats/packing/leaf_anchor.h"
#include "lib/formats/packing/leaf_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace copse {
namespace {

constexpr double k_same_shape = 0.6;             // steps: by which two leaves of one shape may differ
constexpr std::size_t k_most_classes = 256;      // shapes of a pattern that a leaf is compared with
constexpr std::uint32_t k_worth = 3;             // leaves that pay for a shape's places
constexpr double k_anchored = 16;                // steps: how near a limb half of a shape's leaves sit
constexpr double k_near_limb = 64;               // and how near one of them
constexpr double k_limb_cell = 4 * k_near_limb;  // of a grid of limbs
constexpr std::size_t k_samples = 64;            // leaves that tell where those of their shape sit
constexpr std::size_t k_corners = 8;             // of a leaf that may be where it sits, or half way
constexpr std::uint32_t k_most_vertices = 256;   // of a leaf that may be a frame

struct Source {
  std::uint32_t pattern = 0, shape = 0, group = 0, material = 0;
  std::vector<Double3> places;   // steps
  std::vector<Double3> normals;  // of wedges
  std::vector<Grid2> texcoords;
};

struct Class {
  std::uint32_t pattern = 0, members = 0;
  std::vector<Double3> places;  // in the frame, the first edge is 1
};

std::vector<std::uint32_t> key_of(const LeafPattern& p) {
  std::vector<std::uint32_t> key(p.carries.begin(), p.carries.end());
  for (std::size_t t = 0; t < p.vertices.size(); ++t) {
    key.insert(key.end(), p.vertices[t].begin(), p.vertices[t].end());
    key.insert(key.end(), p.wedges[t].begin(), p.wedges[t].end());
  }
  return key;
}

// Solves a x = b of n rows in place, with pivots; what hardly matters stays 0.
template <std::size_t N>
std::array<double, N> solved(std::array<std::array<double, N>, N> a, std::array<double, N> b) {
  double trace = 0;
  for (std::size_t i = 0; i < N; ++i) trace += a[i][i];
  for (std::size_t i = 0; i < N; ++i) a[i][i] += 1e-9 * trace + 1e-300;
  for (std::size_t i = 0; i < N; ++i) {
    std::size_t p = i;
    for (std::size_t r = i + 1; r < N; ++r)
      if (std::abs(a[r][i]) > std::abs(a[p][i])) p = r;
    std::swap(a[i], a[p]), std::swap(b[i], b[p]);
    for (std::size_t r = i + 1; r < N; ++r) {
      const double f = a[r][i] / a[i][i];
      for (std::size_t c = i; c < N; ++c) a[r][c] -= f * a[i][c];
      b[r] -= f * b[i];
    }
  }
  std::array<double, N> x{};
  for (std::size_t i = N; i-- > 0;) {
    double sum = b[i];
    for (std::size_t c = i + 1; c < N; ++c) sum -= a[i][c] * x[c];
    x[i] = sum / a[i][i];
  }
  return x;
}

// I - n n^T
std::array<std::array<double, 3>, 3> across_of(const Double3& n) {
  std::array<std::array<double, 3>, 3> m{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[i][j] = (i == j ? 1.0 : 0.0) - n[i] * n[j];
  return m;
}

Grid3 rounded(const Double3& p) {
  const auto whole = [](double x) {
    return std::llround(
        std::clamp(std::isfinite(x) ? x : 0.0, -1e6 * k_leaf_unit / 64, 1e6 * k_leaf_unit / 64));
  };
  return {whole(p.x), whole(p.y), whole(p.z)};
}

class Planner {
 public:
  Planner(const Tree& tree, const PackGrid& grid, const PackedTrunk& trunk)
      : tree_(tree), grid_(grid), anchors_(trunk, tree.header.roots) {}

  PackedLeaves run(std::span<const std::uint32_t> order) {
    for (const LeafGroup& g : tree_.leaves.groups) out_.group_sizes.push_back(g.count);
    place_limbs();
    read(order, {});
    if (const std::vector<std::uint8_t> turned = first_corners();
        std::find_if(turned.begin(), turned.end(), [](auto x) { return x != 0; }) != turned.end()) {
      std::vector<std::uint8_t> of_leaf;
      for (const Source& s : sources_) of_leaf.push_back(turned[s.pattern]);
      sources_.clear(), out_.patterns.clear(), pattern_number_.clear();
      read(order, of_leaf);
    }
    classify();
    make_shapes();
    for (const Source& s : sources_) {
      out_.list.push_back(placed(s));
      out_.largest_error = std::max(out_.largest_error, worst(out_.list.back(), s));
    }
    anchor();
    shade();
    for (std::size_t i = 0; i < sources_.size(); ++i) map(sources_[i], out_.list[i]);
    return std::move(out_);
  }

 private:
  void read(std::span<const std::uint32_t> order, const std::vector<std::uint8_t>& turned) {
    std::uint32_t group = 0, left = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      while (left == 0 && group < out_.group_sizes.size()) left = out_.group_sizes[group++];
      --left;
      read(order[i], turned.empty() ? 0 : turned[i]);
      sources_.back().group = group - 1;
    }
  }

  // `turned`: the corner of the first triangle that comes first.
  void read(std::uint32_t leaf, std::size_t turned) {
    const Leaves& l = tree_.leaves;
    Source s;
    LeafPattern p;
    std::map<std::uint32_t, std::uint32_t> vertex;
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> wedge;
    for (std::size_t t = tree_.first_triangle_of_leaf(leaf); t < tree_.first_triangle_of_leaf(leaf + 1);
         ++t) {
      const CornerTriangle& corners = l.triangles[t];
      const std::size_t turn = t == tree_.first_triangle_of_leaf(leaf) ? turned : 0;
      auto &vs = p.vertices.emplace_back(), &ws = p.wedges.emplace_back();
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t c = (corner + turn) % 3;
        const std::uint32_t v = corners.vertex[c];
        const auto [at, is_new] = vertex.try_emplace(v, p.vertex_count);
        if (is_new) ++p.vertex_count, s.places.push_back(to_double(l.vertices[v]) / grid_.step());
        const auto [w, new_wedge] = wedge.try_emplace({v, corners.normal[c], corners.texcoord[c]},
                                                      static_cast<std::uint32_t>(p.vertex_of.size()));
        if (new_wedge) {
          p.vertex_of.push_back(at->second);
          const bool normal = !l.normals.empty() && corners.normal[c] != k_none;
          const bool texcoord = !l.texcoords.empty() && corners.texcoord[c] != k_none;
          p.carries.push_back(
              static_cast<std::uint8_t>((normal ? has_normal : 0) | (texcoord ? has_texcoord : 0)));
          p.has_normals = p.has_normals || normal, p.has_texcoords = p.has_texcoords || texcoord;
          s.normals.push_back(normal ? normalized(to_double(l.normals[corners.normal[c]])) : Double3{});
          s.texcoords.push_back(texcoord ? on_grid(l.texcoords[corners.texcoord[c]]) : Grid2{});
        }
        vs[corner] = at->second, ws[corner] = w->second;
      }
    }
    const auto [at, is_new] =
        pattern_number_.try_emplace(key_of(p), static_cast<std::uint32_t>(out_.patterns.size()));
    if (is_new) out_.patterns.push_back(std::move(p));
    s.pattern = at->second;
    s.material = (l.materials.empty() ? l.material : l.materials[leaf]) + 1;
    sources_.push_back(std::move(s));
  }
  Grid2 on_grid(const Float2& uv) const {
    return {std::llround(uv.x / grid_.texcoord_step()), std::llround(uv.y / grid_.texcoord_step())};
  }

  // Leaves of one pattern whose vertices lie alike in their frames.
  void classify() {
    std::vector<std::vector<std::uint32_t>> of_pattern(out_.patterns.size());
    for (Source& s : sources_) {
      std::vector<std::uint32_t>& list = of_pattern[s.pattern];
      const LeafFrame f = leaf_frame(s.places);
      std::vector<Double3> local;
      if (f.length > 0 && s.places.size() >= 3 && s.places.size() <= k_most_vertices)
        for (std::size_t v = 2; v < s.places.size(); ++v)
          local.push_back(f.into(s.places[v] - s.places[0]) / f.length);
      std::uint32_t found = k_none;
      for (std::size_t i = list.size(); i-- > 0 && found == k_none && list.size() - i <= k_most_classes;)
        if (alike(classes_[list[i]], local, f.length)) found = list[i];
      if (found == k_none) {
        found = static_cast<std::uint32_t>(classes_.size());
        list.push_back(found), classes_.push_back({s.pattern, 0, local});
      }
      Class& c = classes_[found];
      ++c.members, s.shape = found;
      for (std::size_t v = 0; v < local.size(); ++v)
        c.places[v] += (local[v] - c.places[v]) / double(c.members);
    }
  }
  static bool alike(const Class& c, const std::vector<Double3>& local, double scale) {
    if (local.empty() || c.places.size() != local.size()) return local.empty() && c.places.empty();
    for (std::size_t v = 0; v < local.size(); ++v)
      if (!(distance(local[v], c.places[v]) * scale <= k_same_shape)) return false;
    return true;
  }

  void make_shapes() {
    for (const Class& c : classes_) {
      PackedShape s{.pattern = c.pattern, .framed = c.members >= k_worth && !c.places.empty()};
      for (std::size_t v = 0; s.framed && v < c.places.size(); ++v)
        s.places.push_back(rounded(c.places[v] * k_leaf_unit));
      out_.shapes.push_back(std::move(s));
    }
    for (const Source& s : sources_) {
      PackedShape& shape = out_.shapes[s.shape];
      if (shape.texcoords.empty()) shape.texcoords = s.texcoords;
    }
  }

  double worst(const PackedLeaf& x, const Source& s) const {
    const std::vector<Double3> places =
        leaf_places(x, out_.shapes[s.shape], static_cast<std::uint32_t>(s.places.size()));
    double error = 0;
    for (std::size_t v = 0; v < places.size(); ++v) error = std::max(error, distance(places[v], s.places[v]));
    return error;
  }

  PackedLeaf placed(const Source& s) const {
    PackedLeaf x{.shape = s.shape, .material = s.material};
    for (const Double3& p : s.places) x.vertices.push_back(rounded(p));
    if (!out_.shapes[s.shape].framed) return x;
    PackedLeaf best = x;
    best.framed = true, best.vertices.resize(2);
    turn(best, s);
    double error = worst(best, s);
    // One corner one step to one side, as long as it helps.
    for (int round = 0; round < 3 && error > 0.7 * k_leaf_tolerance; ++round) {
      const PackedLeaf from = best;
      for (int way = 0; way < 12; ++way) {
        PackedLeaf other = from;
        other.vertices[way / 6][way / 2 % 3] += way % 2 ? -1 : 1;
        turn(other, s);
        if (const double e = worst(other, s); e < error) error = e, best = other;
      }
    }
    return error <= k_leaf_tolerance ? best : x;
  }

  // The turn that brings the shape's vertices nearest.
  void turn(PackedLeaf& x, const Source& s) const {
    const PackedShape& shape = out_.shapes[s.shape];
    const Double3 base = real(x.vertices[0]), edge = real(x.vertices[1]) - base;
    const LeafFrame f = leaf_frame(edge, false, 0);
    double along = 0, across = 0;
    for (std::size_t v = 0; v < shape.places.size(); ++v) {
      const Double3 p = real(shape.places[v]), q = f.into(s.places[v + 2] - base);
      along += p.y * q.y + p.z * q.z, across += p.y * q.z - p.z * q.y;
    }
    double angle = std::atan2(across, along);
    const double quarter = std::atan2(1, 0);
    x.half = std::abs(angle) > quarter;
    if (x.half) angle += angle > 0 ? -2 * quarter : 2 * quarter;
    x.turn = std::llround(std::tan(angle / 2) * turn_units(edge));
  }

  // ---- anchors

  struct Seat {
    std::uint32_t limb = k_none, along = 0;
    double away = std::numeric_limits<double>::infinity();
  };
  // The nearest place on a limb: of its group, or any that is about as near as it has to be.
  Seat seat(std::size_t group, const Double3& p) const {
    Seat best;
    for (std::uint32_t r = anchors_.radius_above(group, 0), up = 0; r != k_none && up < k_most_up; ++up) {
      sit(r, p, best);
      r = anchors_.parent(r);
    }
    if (best.away <= 1) return best;
    const auto near = limbs_at_.find(cell_of(p));
    if (near == limbs_at_.end()) return best;
    for (const std::uint32_t r : near->second) sit(r, p, best);
    return best;
  }
  void sit(std::uint32_t r, const Double3& p, Seat& best) const {
    const std::optional<LeafLimb> limb = anchors_.limb(r);
    if (!limb) return;
    const Double3 way = limb->to - limb->from;
    const double size = dot(way, way),
                 t = size > 0 ? std::clamp(dot(p - limb->from, way) / size, 0.0, 1.0) : 0;
    const double most = std::ldexp(1.0, limb->along_bits());
    const auto along = static_cast<std::uint32_t>(std::min(std::floor(t * most + 0.5), most - 1));
    if (const double d = distance(p, limb->point(along)); d < best.away) best = {r, along, d};
  }

  static Grid3 cell_of(const Double3& p) {
    const auto cell = [](double x) { return static_cast<std::int64_t>(std::floor(x / k_limb_cell)); };
    return {cell(p.x), cell(p.y), cell(p.z)};
  }
  // Which limbs pass through or beside each cell.
  void place_limbs() {
    for (std::uint32_t r = 0; r < anchors_.count(); ++r) {
      const std::optional<LeafLimb> limb = anchors_.limb(r);
      if (!limb) continue;
      const double size = distance(limb->from, limb->to);
      const auto parts = static_cast<std::uint32_t>(2 * size / k_limb_cell) + 1;
      for (std::uint32_t i = 0; i <= parts; ++i) {
        const Double3 p = limb->from + (limb->to - limb->from) * (double(i) / double(parts));
        for (int side = 0; side < 8; ++side) {
          const Double3 reach{side & 1 ? k_near_limb : -k_near_limb, side & 2 ? k_near_limb : -k_near_limb,
                              side & 4 ? k_near_limb : -k_near_limb};
          std::vector<std::uint32_t>& list = limbs_at_[cell_of(p + reach)];
          if (list.empty() || list.back() != r) list.push_back(r);
        }
      }
    }
  }

  // Of every pattern the corner to begin with: that whose edge lies best across the limb.
  std::vector<std::uint8_t> first_corners() const {
    std::vector<std::array<double, 3>> bits(out_.patterns.size());
    std::vector<std::size_t> seen(out_.patterns.size(), 0);
    for (const Source& s : sources_) {
      const auto& faces = out_.patterns[s.pattern].vertices;
      if (faces.empty() || seen[s.pattern]++ >= k_samples) continue;
      Seat best;
      for (std::size_t v = 0; v < std::min(s.places.size(), k_corners); ++v)
        for (std::size_t u = 0; u <= v; ++u)
          if (const Seat other = seat(s.group, (s.places[u] + s.places[v]) / 2); other.away < best.away)
            best = other;
      if (best.limb == k_none) continue;
      const Double3 axis = anchors_.limb(best.limb)->axis(best.along);
      for (std::size_t k = 0; k < 3; ++k)
        bits[s.pattern][k] +=
            std::log2(1 + std::abs(dot(s.places[faces[0][(k + 1) % 3]] - s.places[faces[0][k]], axis)));
    }
    std::vector<std::uint8_t> out;
    for (std::size_t p = 0; p < bits.size(); ++p) {
      const auto& b = bits[p];
      const auto least = static_cast<std::size_t>(std::min_element(b.begin(), b.end()) - b.begin());
      const double gain = b[0] - b[least];
      out.push_back(gain > double(std::min(seen[p], k_samples)) ? static_cast<std::uint8_t>(least)
                                                                : std::uint8_t{0});
    }
    return out;
  }

  // Where the leaves of each shape sit on their limbs, if they do.
  void anchor() {
    std::vector<std::vector<std::uint32_t>> members(out_.shapes.size());
    for (std::uint32_t i = 0; i < out_.list.size(); ++i)
      if (out_.list[i].framed) members[out_.list[i].shape].push_back(i);
    for (std::size_t k = 0; k < members.size(); ++k) {
      PackedShape& shape = out_.shapes[k];
      if (members[k].size() < k_worth || !find_anchor(members[k], shape)) continue;
      shape.anchored = true;
      for (const std::uint32_t i : members[k]) {
        PackedLeaf& x = out_.list[i];
        const Seat s = seat(sources_[i].group, place_of(x, shape, shape.anchor));
        if (s.away <= k_near_limb) x.limb = s.limb, x.along = s.along;
      }
    }
  }
  Double3 place_of(const PackedLeaf& x, const PackedShape& shape, const Grid3& in_frame) const {
    const std::vector<Double3> places = leaf_places(x, shape, out_.patterns[shape.pattern].vertex_count);
    const Double3 edge = places[1] - places[0];
    const LeafFrame f = leaf_frame(edge, x.half, double(x.turn) / turn_units(edge));
    return places[0] + f.out_of(real(in_frame) * (f.length / k_leaf_unit));
  }

  // The corner, or the point half way between two, that is nearest to limbs in most of the leaves.
  bool find_anchor(const std::vector<std::uint32_t>& members, PackedShape& shape) const {
    std::vector<Grid3> corners{{0, 0, 0}, {static_cast<std::int64_t>(k_leaf_unit), 0, 0}};
    for (std::size_t v = 0; v < shape.places.size() && corners.size() < k_corners; ++v)
      corners.push_back(shape.places[v]);
    double least = k_anchored;
    const std::size_t apart = std::max<std::size_t>(1, members.size() / k_samples);
    for (std::size_t v = 0; v < corners.size(); ++v)
      for (std::size_t u = 0; u <= v; ++u) {
        Grid3 p{};
        for (std::size_t a = 0; a < 3; ++a) p[a] = (corners[u][a] + corners[v][a]) / 2;
        std::vector<double> away;
        for (std::size_t i = 0; i < members.size(); i += apart)
          away.push_back(seat(sources_[members[i]].group, place_of(out_.list[members[i]], shape, p)).away);
        std::nth_element(away.begin(), away.begin() + static_cast<std::ptrdiff_t>(away.size() / 2),
                         away.end());
        if (const double half = away[away.size() / 2]; half < least) least = half, shape.anchor = p;
      }
    return least < k_anchored;
  }

  // ---- normals

  void shade() {
    if (tree_.leaves.normals.empty()) return;
    std::vector<std::vector<std::uint32_t>> members(out_.shapes.size());
    for (std::uint32_t i = 0; i < sources_.size(); ++i) members[sources_[i].shape].push_back(i);
    fit_centres();
    bool centres = false;
    for (std::size_t k = 0; k < members.size(); ++k) {
      PackedShape& shape = out_.shapes[k];
      PackedShape best = shape;
      double least = cost(members[k], best);
      for (const LeafNormals rule : {LeafNormals::fixed, LeafNormals::from_point, LeafNormals::from_centre}) {
        if (rule != LeafNormals::from_centre && members[k].size() < k_worth) continue;
        PackedShape other = shape;
        other.normals = rule;
        if (rule == LeafNormals::fixed) fit_fixed(members[k], other);
        if (rule == LeafNormals::from_point) fit_point(members[k], other);
        if (const double c = cost(members[k], other); c < least) least = c, best = other;
      }
      shape = best;
      centres = centres || shape.normals == LeafNormals::from_centre;
      for (const std::uint32_t i : members[k]) {
        out_.list[i].shaded = shape.normals != LeafNormals::given && fits(sources_[i], out_.list[i], shape);
        if (!out_.list[i].shaded)
          for (const Double3& n : sources_[i].normals) out_.list[i].normals.push_back(to_octahedral(n));
      }
    }
    if (!centres) out_.normal_centres.clear();
  }

  bool carried(const Source& s, std::size_t wedge) const {
    return (out_.patterns[s.pattern].carries[wedge] & has_normal) != 0;
  }
  std::vector<Double3> by_rule(const Source& s, const PackedLeaf& x, const PackedShape& shape) const {
    const LeafPattern& p = out_.patterns[s.pattern];
    const std::vector<Double3> places = leaf_places(x, shape, p.vertex_count);
    const LeafFrame f = leaf_frame(places);
    std::vector<Double3> out;
    for (std::uint32_t w = 0; w < p.vertex_of.size(); ++w)
      out.push_back(leaf_normal(shape, f, places, w, p.vertex_of[w], &out_.normal_centres[s.group]));
    return out;
  }
  bool fits(const Source& s, const PackedLeaf& x, const PackedShape& shape) const {
    const std::vector<Double3> rule = by_rule(s, x, shape);
    for (std::size_t w = 0; w < rule.size(); ++w)
      if (carried(s, w) && !(distance(rule[w], s.normals[w]) <= k_leaf_normal_tolerance)) return false;
    return true;
  }

  // Bits, about.
  double cost(const std::vector<std::uint32_t>& members, const PackedShape& shape) const {
    double bits = shape.normals == LeafNormals::from_point ? 100.0
                  : shape.normals == LeafNormals::fixed ? 12.0 * double(sources_[members[0]].normals.size())
                                                        : 0.0;
    for (const std::uint32_t i : members) {
      const Source& s = sources_[i];
      const bool given = shape.normals == LeafNormals::given;
      if (!given && fits(s, out_.list[i], shape)) continue;
      const std::vector<Double3> rule = given ? s.normals : by_rule(s, out_.list[i], shape);
      for (std::size_t w = 0; w < s.normals.size(); ++w) {
        if (!carried(s, w)) continue;
        const Octahedral n = to_octahedral(s.normals[w]), r = to_octahedral(rule[given && w > 0 ? w - 1 : w]);
        for (std::size_t k = 0; k < 2; ++k) bits += 1 + 1.5 * std::log2(1.0 + std::abs(n[k] - r[k]));
      }
    }
    return bits;
  }

  void fit_fixed(const std::vector<std::uint32_t>& members, PackedShape& shape) const {
    std::vector<Double3> sums(sources_[members[0]].normals.size());
    for (const std::uint32_t i : members) {
      const LeafFrame f =
          leaf_frame(leaf_places(out_.list[i], shape, out_.patterns[shape.pattern].vertex_count));
      for (std::size_t w = 0; w < sums.size(); ++w) sums[w] += f.into(sources_[i].normals[w]);
    }
    for (const Double3& n : sums) shape.fixed.push_back(to_octahedral(normalized(n)));
  }

  // The point near + length x far of the frame from which all normals lead away, by least squares.
  void fit_point(const std::vector<std::uint32_t>& members, PackedShape& shape) const {
    std::array<std::array<double, 6>, 6> a{};
    std::array<double, 6> b{};
    const LeafPattern& p = out_.patterns[shape.pattern];
    for (const std::uint32_t i : members) {
      const std::vector<Double3> places = leaf_places(out_.list[i], shape, p.vertex_count);
      const LeafFrame f = leaf_frame(places);
      for (std::size_t w = 0; w < p.vertex_of.size(); ++w) {
        if (!(p.carries[w] & has_normal)) continue;
        const Double3 q = f.into(places[p.vertex_of[w]] - places[0]);
        const auto m = across_of(f.into(sources_[i].normals[w]));
        const std::array<double, 2> weight{1, f.length};
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 3; ++c) {
            b[r] += weight[r / 3] * m[r % 3][c] * q[c];
            for (int h = 0; h < 2; ++h) a[r][c + 3 * h] += weight[r / 3] * weight[h] * m[r % 3][c];
          }
      }
    }
    const auto x = solved(a, b);
    shape.near = rounded(Double3{x[0], x[1], x[2]} * k_near_unit);
    shape.far = rounded(Double3{x[3], x[4], x[5]} * k_leaf_unit);
  }

  void fit_centres() {
    struct Sum {
      std::array<std::array<double, 3>, 3> a{};
      std::array<double, 3> b{};
      Double3 base{};
      bool any = false;
    };
    std::vector<Sum> sums(out_.group_sizes.size());
    for (const Source& s : sources_) {
      Sum& sum = sums[s.group];
      const LeafPattern& p = out_.patterns[s.pattern];
      for (std::size_t w = 0; w < s.normals.size(); ++w) {
        if (!(p.carries[w] & has_normal)) continue;
        const Double3 place = s.places[p.vertex_of[w]];
        if (!sum.any) sum.base = place, sum.any = true;
        const auto m = across_of(s.normals[w]);
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) sum.a[r][c] += m[r][c], sum.b[r] += m[r][c] * (place - sum.base)[c];
      }
    }
    for (const Sum& sum : sums) {
      const auto x = solved(sum.a, sum.b);
      Grid3 centre = rounded(sum.base + Double3{x[0], x[1], x[2]});
      for (std::int64_t& k : centre) k = std::clamp(k, -k_grid_limit, k_grid_limit);
      out_.normal_centres.push_back(centre);
    }
  }

  void map(const Source& s, PackedLeaf& x) const {
    if (!out_.patterns[s.pattern].has_texcoords) return;
    x.mapped = s.texcoords == out_.shapes[s.shape].texcoords;
    if (!x.mapped) x.texcoords = s.texcoords;
  }

  const Tree& tree_;
  PackGrid grid_;
  LeafAnchors anchors_;
  std::map<Grid3, std::vector<std::uint32_t>> limbs_at_;
  PackedLeaves out_;
  std::vector<Source> sources_;
  std::vector<Class> classes_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> pattern_number_;
};

}  // namespace

PackedLeaves plan_leaves(const Tree& tree, const PackGrid& grid, const PackedTrunk& trunk,
                         std::span<const std::uint32_t> order) {
  return Planner(tree, grid, trunk).run(order);
}

}  // namespace copse
