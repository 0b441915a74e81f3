#include "lib/formats/packing/pack_trunk.h"

#include "lib/formats/packing/context_mixing.h"
#include "lib/formats/packing/leaf_frame.h"
#include "lib/formats/packing/pack_corners.h"
#include "lib/formats/tree/derive_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace copse {
namespace {

using Symbols = std::vector<std::uint8_t>;

constexpr double k_in_line = 0.05;    // square of the sine between two vectors of a ring
constexpr std::size_t k_recent = 16;  // vertices that a triangle may name by how long ago they were used
enum Symbol : std::uint8_t { next_of_child = k_recent, next_of_parent, by_number, symbol_count };

Grid3 operator+(const Grid3& a, const Grid3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Grid3 operator-(const Grid3& a, const Grid3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
bool in_grid(const Grid3& a) {
  return std::all_of(a.begin(), a.end(), [](std::int64_t x) { return std::abs(x) <= k_grid_limit; });
}

Float3 stored(const Grid3& a, double step) {
  return to_float(real(a) * step);
}

// Radii breadth first: the parent of each, and where its vectors begin.
struct Shape {
  std::vector<std::uint32_t> parent, first;

  Shape(const PackedTrunk& trunk, std::uint32_t roots) : parent(parents_of(trunk, roots)), first{0} {
    for (const PackedRadius& r : trunk.radii) first.push_back(first.back() + r.vectors);
  }
};

std::vector<Radius> radii_of(const PackedTrunk& trunk, const Shape& shape, double step, std::uint32_t roots) {
  std::vector<Radius> out(trunk.radii.size());
  std::uint32_t next = roots;
  for (std::uint32_t r = 0; r < out.size(); ++r) {
    const PackedRadius& p = trunk.radii[r];
    Radius& x = out[r];
    const Grid3 base = shape.parent[r] == k_none ? Grid3{} : trunk.radii[shape.parent[r]].centre;
    x.centre = stored(p.centre - base, step);
    x.diameter = static_cast<float>(double(p.diameter) * step / 4);
    x.flags = (p.joint ? Radius::joint : 0u) | (p.children == 0 ? Radius::terminal : 0u);
    x.child_count = p.children, x.first_child = p.children > 0 ? next : k_none;
    next += p.children;
    if (p.children == 0 && p.group >= 0)
      x.child_count = 1, x.first_child = static_cast<std::uint32_t>(p.group);
  }
  return out;
}

std::vector<std::array<std::uint32_t, 2>> lines_of(const PackedTrunk& trunk, const Shape& shape,
                                                   std::uint32_t roots) {
  Tree tree;
  tree.header.kind = TreeKind::sensitive, tree.header.roots = roots;
  tree.hierarchy.radii = radii_of(trunk, shape, 1, roots);
  return segments_of(tree);
}

class TrunkCoder {
 public:
  TrunkCoder(RangeCoder& coder, PackedTrunk& trunk, const Head& head) : c_(coder), t_(trunk), head_(head) {}

  std::string run() {
    if (c_.decoding()) {
      t_.radii.resize(head_.counts.radii);
      t_.vectors.resize(head_.counts.trunk_vertices);
      t_.triangles.resize(head_.counts.trunk_triangles);
      t_.wedges.resize(head_.counts.trunk_triangles);
      t_.materials.resize(head_.counts.trunk_triangles);
    }
    if (std::string wrong = code_radii(); !wrong.empty()) return wrong;
    const Shape shape(t_, head_.header.roots);
    if (shape.first.back() != t_.vectors.size()) return "the rings do not hold all vertices";
    shape_ = &shape;
    for (std::uint32_t r = 0; r < t_.radii.size(); ++r) {
      code_ring(r);
      if (c_.failed()) return "it ends in the rings";
    }
    for (const Grid3& v : t_.vectors)
      if (!in_grid(v)) return "a vertex is out of range";
    const auto lines = lines_of(t_, shape, head_.header.roots);
    if (lines.size() != head_.counts.segments) return "its segments are not as many as the header says";
    if (std::string wrong = code_triangles(lines); !wrong.empty()) return wrong;
    code_materials();
    return code_corners(c_, t_, lines, head_);
  }

 private:
  // ---- radii

  std::string code_radii() {
    std::uint64_t next = head_.header.roots;
    if (next > t_.radii.size()) return "more roots than radii";
    std::vector<std::uint32_t> parent(t_.radii.size(), k_none);
    std::int64_t group = -1, vertices = 0;
    for (std::uint32_t r = 0; r < t_.radii.size(); ++r) {
      PackedRadius& x = t_.radii[r];
      const std::uint32_t p = parent[r];
      const std::size_t kind = p == k_none ? 0 : t_.radii[p].children > 1 ? 1 : 2;
      c_.stream("radii: links");
      const std::uint64_t children = c_.number(children_[kind], x.children);
      if (children > t_.radii.size() - next) return "a radius has more children than there are radii";
      x.children = static_cast<std::uint32_t>(children);
      for (std::uint32_t k = 0; k < x.children; ++k) parent[next++] = r;
      if (x.children == 0 && c_.bit(has_group_, x.group >= 0))
        x.group = group += 1 + c_.signed_number(group_, x.group - group - 1);
      if (x.group >= std::int64_t{head_.counts.groups} || x.group < -1) return "a leaf group out of range";
      x.joint = c_.bit(joint_[kind], x.joint);
      c_.stream("radii: centres");
      code_centre(x, p, p == k_none ? k_none : parent[p], kind);
      if (!in_grid(x.centre)) return "a radius is out of range";
      c_.stream("radii: links");
      const std::int64_t like = p == k_none ? 0 : t_.radii[p].vectors;
      const std::int64_t n = like + c_.signed_number(ring_size_[kind], std::int64_t{x.vectors} - like);
      if (n < 0 || n > std::int64_t{head_.counts.trunk_vertices} - vertices)
        return "a ring has too many vertices";
      vertices += n;
      x.vectors = static_cast<std::uint32_t>(n);
      if (c_.failed()) return "it ends in the radii";
    }
    return next == t_.radii.size() ? "" : "some radii hang on nothing";
  }

  // A limb goes on as it went.
  void code_centre(PackedRadius& x, std::uint32_t p, std::uint32_t before, std::size_t kind) {
    Grid3 expected{};
    if (p != k_none) expected = t_.radii[p].centre;
    if (before != k_none) expected = expected + (t_.radii[p].centre - t_.radii[before].centre);
    const std::size_t reach =
        p == k_none || before == k_none ? 0 : length_class(t_.radii[p].centre - t_.radii[before].centre);
    std::size_t last = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t off =
          centre_.code(c_, {3 * kind + a, 24 * kind + last, 24 * kind + reach}, x.centre[a] - expected[a]);
      x.centre[a] = expected[a] + off;
      last = std::min<std::size_t>(size_class(off), 23);
    }
  }

  static std::size_t length_class(const Grid3& v) {
    return std::min<std::size_t>(size_class(std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2])), 23);
  }

  void code_ring(std::uint32_t r) {
    PackedRadius& x = t_.radii[r];
    const std::uint32_t p = shape_->parent[r], first = shape_->first[r];
    const bool alike = p != k_none && t_.radii[p].vectors == x.vectors;
    double sum = 0;
    for (std::uint32_t j = 0; j < x.vectors; ++j) {
      Grid3& v = t_.vectors[first + j];
      Grid3 expected{};
      if (alike && j >= 2) {
        expected = as_image(first, shape_->first[p], j);
      } else if (alike) {
        expected = as_parents(first, shape_->first[p], j);
      } else if (j >= 2) {
        expected = around(first, j, x.vectors);
      } else if (j == 1) {
        for (std::size_t a = 0; a < 3; ++a) expected[a] = -t_.vectors[first][a] / 2;
      }
      const std::size_t kind = alike ? std::min<std::size_t>(j, 2) : 3 + std::min<std::size_t>(j, 2);
      const std::size_t reach = length_class(expected);
      c_.stream("rings: vectors");
      std::size_t last = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t off = vector_.code(
            c_, {3 * kind + a, 24 * kind + last, 24 * kind + reach, 24 * kind + off_[a]}, v[a] - expected[a]);
        v[a] = grid_offset(expected[a] + off);
        last = off_[a] = std::min<std::size_t>(size_class(off), 23);
      }
      sum += length(real(v));
    }
    const std::int64_t mean = x.vectors == 0 ? 0 : std::llround(8 * sum / x.vectors);
    c_.stream("rings: diameters");
    x.diameter = mean + c_.signed_number(diameter_, x.diameter - mean);
    if (x.diameter < 0 || x.diameter > 16 * k_grid_limit) x.diameter = 0;
  }

  // The parent's vector by the parent's first two, in this ring's: as a ring that is turned, stretched or
  // sheared lies; as the parent's where those two are nearly in line.
  Grid3 as_image(std::uint32_t first, std::uint32_t parents, std::uint32_t j) const {
    const Double3 a = real(t_.vectors[parents]), b = real(t_.vectors[parents + 1]),
                  p = real(t_.vectors[parents + j]);
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), area = aa * bb - ab * ab;
    if (!(area > k_in_line * aa * bb)) return as_parents(first, parents, j);
    const double ap = dot(a, p), bp = dot(b, p), s = (ap * bb - bp * ab) / area,
                 t = (bp * aa - ap * ab) / area;
    if (!(std::abs(s) <= 2 && std::abs(t) <= 2)) return as_parents(first, parents, j);
    const Double3 x = real(t_.vectors[first]) * s + real(t_.vectors[first + 1]) * t;
    return {std::llround(x.x), std::llround(x.y), std::llround(x.z)};
  }

  // The parent's vector, as much longer as the one before was.
  Grid3 as_parents(std::uint32_t first, std::uint32_t parents, std::uint32_t j) const {
    const Double3 like = real(t_.vectors[parents + j]);
    double scale = 1;
    if (j > 0) {
      const double before = length(real(t_.vectors[parents + j - 1]));
      scale = before > 0 ? std::min(length(real(t_.vectors[first + j - 1])) / before, 4.0) : 1;
    }
    return {std::llround(like.x * scale), std::llround(like.y * scale), std::llround(like.z * scale)};
  }

  // On round a regular polygon: v[j] = 2 cos(2 pi / k) v[j - 1] - v[j - 2].
  Grid3 around(std::uint32_t first, std::uint32_t j, std::uint32_t k) const {
    const double half = 3.14159265358979312 / k, s2 = half * half;  // 1 - 2 sin^2, by its series
    const double s = half * (1 - s2 / 6 * (1 - s2 / 20 * (1 - s2 / 42 * (1 - s2 / 72))));
    const double twice = 2 * (1 - 2 * s * s);
    Grid3 out{};
    for (std::size_t a = 0; a < 3; ++a)
      out[a] = std::llround(twice * double(t_.vectors[first + j - 1][a])) - t_.vectors[first + j - 2][a];
    return in_grid(out) ? out : Grid3{};
  }

  // ---- triangles

  struct Segment {
    std::uint32_t ring[2];  // where the child's and the parent's vectors begin
    std::uint32_t size[2];
    std::uint32_t last[2];  // used: the next one is after it
    std::vector<std::uint32_t> recent;
  };

  Segment segment(const std::array<std::uint32_t, 2>& line) const {
    Segment s{};
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t r = line[1 - side];
      s.ring[side] = shape_->first[r], s.size[side] = t_.radii[r].vectors;
      s.last[side] = s.size[side] == 0 ? 0 : s.size[side] - 1;
    }
    return s;
  }
  static std::uint32_t next_in(const Segment& s, std::size_t side) {
    return s.size[side] == 0 ? k_none : s.ring[side] + (s.last[side] + 1) % s.size[side];
  }
  static void use(Segment& s, std::uint32_t v) {
    const auto at = std::find(s.recent.begin(), s.recent.end(), v);
    if (at != s.recent.end()) s.recent.erase(at);
    s.recent.insert(s.recent.begin(), v);
    if (s.recent.size() > k_recent) s.recent.pop_back();
    for (std::size_t side = 0; side < 2; ++side)
      if (v >= s.ring[side] && v < s.ring[side] + s.size[side]) s.last[side] = v - s.ring[side];
  }
  static std::uint8_t symbol_of(const Segment& s, std::uint32_t v) {
    const auto at = std::find(s.recent.begin(), s.recent.end(), v);
    if (at != s.recent.end()) return static_cast<std::uint8_t>(at - s.recent.begin());
    if (v == next_in(s, 0)) return next_of_child;
    return v == next_in(s, 1) ? next_of_parent : by_number;
  }

  std::string code_triangles(const std::vector<std::array<std::uint32_t, 2>>& lines) {
    if (c_.decoding()) t_.counts.assign(lines.size(), 0);
    std::uint32_t at = 0;
    for (std::size_t s = 0; s < lines.size(); ++s) {
      Segment here = segment(lines[s]);
      const std::array<std::uint32_t, 2> rings{here.size[0], here.size[1]};
      const std::int64_t like = usual_.count(rings) ? usual_[rings] : rings[0] + rings[1];
      c_.stream("trunk triangles: counts");
      const std::int64_t n = like + c_.signed_number(count_, std::int64_t{t_.counts[s]} - like);
      if (n < 0 || n > std::int64_t{head_.counts.trunk_triangles} - at)
        return "a segment has too many triangles";
      t_.counts[s] = static_cast<std::uint32_t>(n), usual_[rings] = n;
      Symbols& like_last = seen_[{rings[0], rings[1], t_.counts[s]}];
      Symbols symbols;
      for (const std::uint32_t end = at + t_.counts[s]; at < end; ++at) {
        for (std::uint32_t& v : t_.triangles[at])
          if (!code_corner(here, v, like_last, symbols)) return "a triangle names a vertex that is not there";
        if (c_.failed()) return "it ends in the triangles";
      }
      like_last = std::move(symbols);
    }
    return at == t_.triangles.size() ? "" : "the segments do not hold all triangles";
  }

  bool code_corner(Segment& s, std::uint32_t& v, const Symbols& like, Symbols& symbols) {
    c_.stream("trunk triangles: corners");
    std::uint8_t symbol = c_.decoding() ? std::uint8_t{0} : symbol_of(s, v);
    const std::size_t i = symbols.size();
    const std::uint8_t before = i > 0 ? symbols[i - 1] : std::uint8_t{symbol_count};
    const std::uint8_t two = i > 1 ? symbols[i - 2] : std::uint8_t{symbol_count};
    constexpr std::size_t n = symbol_count + 1;
    const std::size_t expected = i < like.size() ? like[i] : n;
    const bool went = i > 0 && i <= like.size() && before == like[i - 1];
    const std::size_t last = std::min<std::size_t>(before, symbol_count), corner = i % 3;
    const auto sides = [](std::size_t k) { return std::min<std::size_t>(k, 7); };
    symbol = static_cast<std::uint8_t>(std::min<std::size_t>(
        symbol_.code(c_,
                     {3 * last + corner, 3 * (n * last + std::min<std::size_t>(two, symbol_count)) + corner,
                      2 * (3 * expected + corner) + (went ? 1 : 0),
                      3 * (n * (8 * sides(s.size[0]) + sides(s.size[1])) + last) + corner},
                     symbol),
        symbol_count));
    if (symbol < k_recent) {
      if (symbol >= s.recent.size()) return false;
      v = s.recent[symbol];
    } else if (symbol == next_of_child || symbol == next_of_parent) {
      v = next_in(s, symbol - next_of_child);
    } else {
      c_.stream("trunk triangles: corners by number");
      const std::int64_t base = s.ring[0];
      v = static_cast<std::uint32_t>(base + c_.signed_number(vertex_, std::int64_t{v} - base));
    }
    if (v >= t_.vectors.size()) return false;
    symbols.push_back(symbol);
    use(s, v);
    return true;
  }

  void code_materials() {
    if (!head_.trunk_materials) return;
    std::uint64_t before = 0;
    for (std::uint32_t& m : t_.materials)
      if (c_.bit(same_material_, m == before))
        m = static_cast<std::uint32_t>(before);
      else
        m = static_cast<std::uint32_t>(before = c_.number(material_, m));
  }

  RangeCoder& c_;
  PackedTrunk& t_;
  const Head& head_;
  const Shape* shape_ = nullptr;
  std::map<std::array<std::uint32_t, 2>, std::int64_t> usual_;
  std::map<std::array<std::uint32_t, 3>, Symbols> seen_;

  std::array<NumberModel, 3> children_;
  std::array<SignedModel, 3> ring_size_;
  MixedSigned centre_{9, 72, 72}, vector_{18, 144, 144, 144};
  std::array<std::size_t, 3> off_{};
  std::array<BitModel, 3> joint_;
  BitModel has_group_, same_material_;
  SignedModel group_, diameter_, count_, vertex_;
  NumberModel material_;
  MixedSymbol symbol_{symbol_count + 1,
                      {3 * (symbol_count + 1), 3 * (symbol_count + 1) * (symbol_count + 1),
                       6 * (symbol_count + 2), 192 * (symbol_count + 1)}};
};

Grid3 on_grid(const Double3& p, double step) {
  return {std::llround(p.x / step), std::llround(p.y / step), std::llround(p.z / step)};
}

PackedWedge wedge_of(const Trunk& trunk, const CornerTriangle& t, std::size_t c, const PackGrid& grid) {
  PackedWedge w;
  w.has_normal = !trunk.normals.empty() && t.normal[c] != k_none;
  w.has_texcoord = !trunk.texcoords.empty() && t.texcoord[c] != k_none;
  if (w.has_normal) w.normal = to_octahedral(to_double(trunk.normals[t.normal[c]]));
  if (w.has_texcoord) {
    const Float2 uv = trunk.texcoords[t.texcoord[c]];
    w.texcoord = {std::llround(uv.x / grid.texcoord_step()), std::llround(uv.y / grid.texcoord_step())};
  }
  return w;
}

// A walk over the triangles of a segment from neighbour to neighbour, each turned so that the edge to the one
// before comes first: then only where it goes on and its third corner are news.
class SegmentWalk {
 public:
  explicit SegmentWalk(std::vector<CornerTriangle> triangles)
      : triangles_(std::move(triangles)), taken_(triangles_.size(), 0) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) edges_[edge(t, c)].push_back(t);
  }

  // The triangles in their new order, with their old places; which of three corners is the first one now.
  struct Step {
    std::uint32_t triangle = 0;
    std::size_t first = 0;
  };
  std::vector<Step> steps() {
    std::vector<Step> out, branches;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (taken_[t]) continue;
      for (Step now{t, 0};;) {
        taken_[now.triangle] = 1;
        out.push_back(now);
        branches.push_back(now);
        bool found = false;
        while (!found && !branches.empty()) {
          found = next_of(branches.back(), now);
          if (!found) branches.pop_back();
        }
        if (!found) break;
      }
    }
    return out;
  }

 private:
  using Edge = std::array<std::uint32_t, 2>;
  Edge edge(std::uint32_t t, std::size_t c) const {
    return {triangles_[t].vertex[c % 3], triangles_[t].vertex[(c + 1) % 3]};
  }
  // The neighbour across the last edge, or across the one before.
  bool next_of(const Step& at, Step& next) {
    for (const std::size_t side : {2u, 1u, 0u}) {
      const Edge e = edge(at.triangle, at.first + side);
      const auto found = edges_.find({e[1], e[0]});
      if (found == edges_.end()) continue;
      for (const std::uint32_t t : found->second) {
        if (taken_[t]) continue;
        next.triangle = t;
        for (std::size_t c = 0; c < 3; ++c)
          if (edge(t, c) == Edge{e[1], e[0]}) next.first = c;
        return true;
      }
    }
    return false;
  }

  std::vector<CornerTriangle> triangles_;
  std::vector<std::uint8_t> taken_;
  std::map<Edge, std::vector<std::uint32_t>> edges_;
};

}  // namespace

std::int32_t grid_exponent(double size, int bits) {
  if (!(size > 0)) return -bits;
  int exponent = 0;
  const double fraction = std::frexp(size, &exponent);
  if (fraction < 0.70710678118654757) --exponent;
  return std::clamp(exponent - bits, k_least_exponent, k_most_exponent);
}

double PackGrid::step() const {
  return std::ldexp(1.0, position);
}
double PackGrid::texcoord_step() const {
  return std::ldexp(1.0, texcoord);
}

std::vector<std::uint32_t> parents_of(const PackedTrunk& trunk, std::uint32_t roots) {
  std::vector<std::uint32_t> parent(trunk.radii.size(), k_none);
  std::uint32_t next = roots;
  for (std::uint32_t r = 0; r < trunk.radii.size(); ++r)
    for (std::uint32_t c = 0; c < trunk.radii[r].children; ++c) parent[next++] = r;
  return parent;
}

PackedTrunk plan_trunk(const Tree& tree, const PackGrid& grid) {
  PackedTrunk out;
  const double step = grid.step();
  const std::vector<Double3> centres = absolute_centres(tree);
  const std::vector<Float3> vertices = trunk_vertices(tree);
  for (std::uint32_t r = 0; r < tree.radius_count(); ++r) {
    const Radius& x = tree.hierarchy.radii[r];
    const bool terminal = (x.flags & Radius::terminal) != 0;
    PackedRadius p{
        .children = terminal ? 0 : x.child_count,
        .group = terminal && x.child_count == 1 ? std::int64_t{x.first_child} : -1,
        .joint = (x.flags & Radius::joint) != 0,
        .centre = on_grid(centres[r], step),
        .vectors = static_cast<std::uint32_t>(tree.first_vector_of(r + 1) - tree.first_vector_of(r)),
        .diameter = std::llround(4 * double(x.diameter) / step)};
    for (std::size_t v = tree.first_vector_of(r); v < tree.first_vector_of(r + 1); ++v) {
      const Grid3 place = on_grid(to_double(vertices[v]), step);
      out.largest_error = std::max(out.largest_error, distance(real(place), to_double(vertices[v]) / step));
      out.vectors.push_back(place - p.centre);
    }
    out.radii.push_back(p);
  }
  std::vector<std::uint32_t> segment_of(tree.radius_count(), k_none);
  for (std::uint32_t s = 0; s < tree.trunk.lines.size(); ++s) segment_of[tree.trunk.lines[s][1]] = s;
  const Shape shape(out, tree.header.roots);
  for (const auto& line : lines_of(out, shape, tree.header.roots)) {
    const std::uint32_t s = segment_of[line[1]];
    const std::size_t first = tree.first_triangle_of_segment(s), end = tree.first_triangle_of_segment(s + 1);
    out.counts.push_back(static_cast<std::uint32_t>(end - first));
    SegmentWalk walk({tree.trunk.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                      tree.trunk.triangles.begin() + static_cast<std::ptrdiff_t>(end)});
    for (const SegmentWalk::Step& step_on : walk.steps()) {
      const std::size_t t = first + step_on.triangle;
      auto& corners = out.triangles.emplace_back();
      auto& wedges = out.wedges.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t from = (step_on.first + c) % 3;
        corners[c] = tree.trunk.triangles[t].vertex[from];
        wedges[c] = wedge_of(tree.trunk, tree.trunk.triangles[t], from, grid);
      }
      out.materials.push_back((tree.trunk.materials.empty() ? tree.trunk.material : tree.trunk.materials[t]) +
                              1);
    }
  }
  out.normals = nearest_normals(out, tree.header.roots);
  return out;
}

std::string code_trunk(RangeCoder& coder, PackedTrunk& trunk, const Head& head) {
  return std::make_unique<TrunkCoder>(coder, trunk, head)->run();  // models fill some hundred kilobytes
}

void build_trunk(const PackedTrunk& trunk, const PackGrid& grid, const Head& head, Tree& tree) {
  const Shape shape(trunk, head.header.roots);
  tree.hierarchy.radii = radii_of(trunk, shape, grid.step(), head.header.roots);
  std::vector<Float3> vectors;
  for (const Grid3& v : trunk.vectors) vectors.push_back(stored(v, grid.step()));
  tree.hierarchy.vectors = std::move(vectors);
  tree.hierarchy.first_vector = shape.first;
  tree.trunk.lines = lines_of(trunk, shape, head.header.roots);
  std::vector<std::uint32_t> first{0};
  for (const std::uint32_t n : trunk.counts) first.push_back(first.back() + n);
  tree.trunk.first_triangle = std::move(first);
  std::map<Octahedral, std::uint32_t> normal_number;
  std::map<Grid2, std::uint32_t> texcoord_number;
  std::vector<Float3> normals;
  std::vector<Float2> texcoords;
  std::vector<CornerTriangle> triangles(trunk.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    triangles[t].vertex = trunk.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      const PackedWedge& w = trunk.wedges[t][c];
      if (w.has_normal) {
        const auto [at, is_new] =
            normal_number.try_emplace(w.normal, static_cast<std::uint32_t>(normals.size()));
        if (is_new) normals.push_back(from_octahedral(w.normal));
        triangles[t].normal[c] = at->second;
      }
      if (w.has_texcoord) {
        const auto [at, is_new] =
            texcoord_number.try_emplace(w.texcoord, static_cast<std::uint32_t>(texcoords.size()));
        if (is_new)
          texcoords.push_back({static_cast<float>(double(w.texcoord[0]) * grid.texcoord_step()),
                               static_cast<float>(double(w.texcoord[1]) * grid.texcoord_step())});
        triangles[t].texcoord[c] = at->second;
      }
    }
  }
  tree.trunk.triangles = std::move(triangles);
  tree.trunk.normals = std::move(normals);
  tree.trunk.texcoords = std::move(texcoords);
  tree.trunk.material = head.trunk_material;
  if (head.trunk_materials) {
    std::vector<std::uint32_t> materials;
    for (const std::uint32_t m : trunk.materials) materials.push_back(m - 1);
    tree.trunk.materials = std::move(materials);
  }
}

}  // namespace copse
