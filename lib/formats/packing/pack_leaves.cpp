#include "lib/formats/packing/pack_leaves.h"

#include "lib/formats/packing/context_mixing.h"
#include "lib/formats/packing/leaf_anchor.h"
#include "lib/formats/packing/leaf_frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

namespace copse {
namespace {

constexpr std::size_t k_recent_texcoords = 64;
constexpr double k_like_lean = 0.3, k_slow_lean = 1.0 / 16, k_fast_lean = 1.0 / 3;
constexpr std::size_t k_recent = 256;  // shapes and patterns that a leaf may name
constexpr std::int64_t k_most_units = std::int64_t{1} << 30;

bool in_grid(const Grid3& a) {
  return std::all_of(a.begin(), a.end(), [](std::int64_t x) { return std::abs(x) <= k_grid_limit; });
}

// ---- coding -----------------------------------------------------------------------------------------------

class LeafCoder {
 public:
  LeafCoder(RangeCoder& coder, PackedLeaves& leaves, const PackedTrunk& trunk, const Head& head)
      : c_(coder), l_(leaves), head_(head), anchors_(trunk, head.header.roots) {}

  std::string run() {
    if (std::string wrong = code_groups(); !wrong.empty()) return wrong;
    std::uint64_t triangles = 0;
    std::uint32_t leaf = 0;
    for (std::size_t g = 0; g < l_.group_sizes.size(); ++g) {
      for (std::uint32_t i = 0; i < l_.group_sizes[g]; ++i, ++leaf) {
        if (c_.decoding()) l_.list.emplace_back();
        PackedLeaf& x = l_.list[leaf];
        c_.stream("leaves: shapes");
        if (!code_shape(x)) return "a leaf's shape is not there";
        const LeafPattern& pattern = l_.patterns[l_.shapes[x.shape].pattern];
        triangles += pattern.vertices.size();
        if (triangles > head_.counts.leaf_triangles) return "the leaves have too many triangles";
        code_texcoords(x, pattern);
        if (!code_place(x, pattern, g, i == 0)) return "a leaf sits on a limb that is not there";
        for (const Grid3& v : x.vertices)
          if (!in_grid(v)) return "a leaf is out of range";
        code_normals(x, pattern, g);
        if (head_.leaf_materials) {
          c_.stream("leaves: materials");
          if (c_.bit(same_material_, x.material == material_))
            x.material = material_;
          else
            x.material = material_ = static_cast<std::uint32_t>(c_.number(material_model_, x.material));
        }
        if (c_.failed()) return "it ends in the leaves";
      }
    }
    if (triangles != head_.counts.leaf_triangles) return "the leaves do not hold all triangles";
    return "";
  }

 private:
  std::string code_groups() {
    if (c_.decoding()) l_.group_sizes.resize(head_.counts.groups);
    std::uint64_t sum = 0;
    for (std::uint32_t& n : l_.group_sizes) {
      c_.stream("leaves: groups");
      const std::uint64_t size = c_.number(group_size_, n);
      if (size == 0 || size > head_.counts.leaves - sum) return "a group has no leaf, or too many";
      sum += n = static_cast<std::uint32_t>(size);
    }
    if (sum != head_.counts.leaves) return "the groups do not hold all leaves";
    if (c_.plain(1, l_.normal_centres.empty() ? 0 : 1) == 0) return "";
    if (c_.decoding()) l_.normal_centres.resize(l_.group_sizes.size());
    Grid3 before{};
    for (Grid3& p : l_.normal_centres) {
      for (std::size_t a = 0; a < 3; ++a) p[a] = before[a] + c_.signed_number(centre_[a], p[a] - before[a]);
      if (!in_grid(p)) return "a centre of normals is out of range";
      before = p;
    }
    return "";
  }

  // Names one of the recent ones, or answers that a new one follows.
  bool recall(std::vector<std::uint32_t>& recent, NumberModel& model, std::uint32_t& which, bool& sound) {
    std::uint64_t symbol = 0;
    if (!c_.decoding()) {
      const auto at = std::find(recent.begin(), recent.end(), which);
      if (at != recent.end()) symbol = static_cast<std::uint64_t>(at - recent.begin()) + 1;
    }
    symbol = c_.number(model, symbol);
    sound = symbol <= recent.size();
    if (symbol == 0 || !sound) return false;
    which = recent[symbol - 1];
    recent.erase(recent.begin() + static_cast<std::ptrdiff_t>(symbol) - 1);
    recent.insert(recent.begin(), which);
    return true;
  }
  static void remember(std::vector<std::uint32_t>& recent, std::uint32_t which) {
    recent.insert(recent.begin(), which);
    if (recent.size() > k_recent) recent.pop_back();
  }

  bool code_shape(PackedLeaf& leaf) {
    bool sound = true;
    if (recall(recent_shapes_, shape_, leaf.shape, sound)) return true;
    if (!sound) return false;
    if (c_.decoding()) leaf.shape = static_cast<std::uint32_t>(l_.shapes.size()), l_.shapes.emplace_back();
    if (told_.size() <= leaf.shape) told_.resize(leaf.shape + 1, 0);
    told_[leaf.shape] = times_told_++;
    PackedShape& s = l_.shapes[leaf.shape];
    if (!recall(recent_patterns_, pattern_, s.pattern, sound)) {
      if (!sound) return false;
      if (c_.decoding())
        s.pattern = static_cast<std::uint32_t>(l_.patterns.size()), l_.patterns.emplace_back();
      if (!code_pattern(l_.patterns[s.pattern])) return false;
      find_first_wedges(s.pattern);
      remember(recent_patterns_, s.pattern);
    }
    remember(recent_shapes_, leaf.shape);
    return code_contents(s, l_.patterns[s.pattern]);
  }

  bool code_pattern(LeafPattern& p) {
    const std::uint64_t n = c_.number(triangles_, p.vertices.size());
    if (n > head_.counts.leaf_triangles) return false;
    if (c_.decoding()) p.vertices.resize(n), p.wedges.resize(n);
    std::uint32_t vertices = 0;
    std::vector<std::uint32_t> vertex_of;
    for (std::size_t t = 0; t < n; ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (!code_index(p.vertices[t][k], vertices, vertex_index_)) return false;
        const auto known = static_cast<std::uint32_t>(vertex_of.size());
        std::uint32_t wedges = known;
        if (!code_index(p.wedges[t][k], wedges, wedge_index_)) return false;
        if (wedges > known) {
          vertex_of.push_back(p.vertices[t][k]);
          if (c_.decoding()) p.carries.push_back(0);
          const bool normal = c_.bit(pattern_bits_[0], (p.carries[known] & has_normal) != 0);
          const bool texcoord = c_.bit(pattern_bits_[1], (p.carries[known] & has_texcoord) != 0);
          p.carries[known] =
              static_cast<std::uint8_t>((normal ? has_normal : 0) | (texcoord ? has_texcoord : 0));
          p.has_normals = p.has_normals || normal, p.has_texcoords = p.has_texcoords || texcoord;
        }
        if (vertex_of[p.wedges[t][k]] != p.vertices[t][k]) return false;
      }
      if (c_.failed()) return false;
    }
    p.vertex_count = vertices, p.vertex_of = std::move(vertex_of);
    return true;
  }
  void find_first_wedges(std::uint32_t pattern) {
    const LeafPattern& p = l_.patterns[pattern];
    if (first_wedge_.size() <= pattern) first_wedge_.resize(pattern + 1);
    std::vector<std::uint32_t>& first = first_wedge_[pattern];
    first.assign(p.vertex_count, k_none);
    for (std::uint32_t w = 0; w < p.vertex_of.size(); ++w)
      if (first[p.vertex_of[w]] == k_none) first[p.vertex_of[w]] = w;
  }
  // Where a vertex is in the picture, by the first pair that has it; nullptr where nothing has it.
  const Grid2* in_picture(const PackedLeaf& x, std::size_t vertex) const {
    const PackedShape& s = l_.shapes[x.shape];
    const std::vector<std::uint32_t>& first = first_wedge_[s.pattern];
    if (vertex >= first.size() || first[vertex] == k_none) return nullptr;
    return &(x.mapped ? s.texcoords : x.texcoords)[first[vertex]];
  }
  // 0 is the next one, n the one n before it.
  bool code_index(std::uint32_t& index, std::uint32_t& count, NumberModel& model) {
    const std::uint64_t back = c_.number(model, count - index);
    if (back > count) return false;
    index = count - static_cast<std::uint32_t>(back);
    if (back == 0) ++count;
    return true;
  }

  bool code_contents(PackedShape& s, const LeafPattern& p) {
    s.framed = c_.bit(framed_shape_, s.framed);
    if (s.framed && p.vertex_count < 3) return false;
    if (c_.decoding() && s.framed) s.places.resize(p.vertex_count - 2);
    for (Grid3& x : s.places) {
      for (std::int64_t& a : x) a = c_.signed_number(place_, a);
      for (const std::int64_t a : x)
        if (std::abs(a) > k_most_units) return false;
    }
    if (s.framed) s.anchored = c_.bit(anchored_shape_, s.anchored);
    for (std::size_t k = 0; k < 3 && s.anchored; ++k) {
      s.anchor[k] = c_.signed_number(place_, s.anchor[k]);
      if (std::abs(s.anchor[k]) > k_most_units) return false;
    }
    const std::size_t wedges = p.vertex_of.size();
    if (p.has_texcoords && !code_shape_texcoords(s, wedges)) return false;
    if (!p.has_normals) return !c_.failed();
    s.normals = static_cast<LeafNormals>(std::min<std::uint64_t>(
        c_.number(rule_, static_cast<std::uint64_t>(s.normals)), std::uint64_t(LeafNormals::from_centre)));
    if (s.normals == LeafNormals::from_centre && l_.normal_centres.empty()) return false;
    if (s.normals == LeafNormals::fixed) {
      if (c_.decoding()) s.fixed.resize(wedges);
      for (Octahedral& o : s.fixed)
        for (std::int32_t& k : o) k = limited(c_.signed_number(shape_normal_, k));
    }
    if (s.normals == LeafNormals::from_point) {
      for (Grid3* x : {&s.near, &s.far})
        for (std::int64_t& a : *x) {
          a = c_.signed_number(point_, a);
          if (std::abs(a) > k_most_units) return false;
        }
    }
    return !c_.failed();
  }
  // As one of the recent shapes', or new ones.
  bool code_shape_texcoords(PackedShape& s, std::size_t wedges) {
    std::uint64_t symbol = 0;
    if (!c_.decoding()) {
      const auto at = std::find(recent_texcoords_.begin(), recent_texcoords_.end(), s.texcoords);
      if (at != recent_texcoords_.end())
        symbol = static_cast<std::uint64_t>(at - recent_texcoords_.begin()) + 1;
    }
    symbol = c_.number(which_texcoords_, symbol);
    if (symbol > recent_texcoords_.size()) return false;
    if (symbol > 0) {
      s.texcoords = recent_texcoords_[symbol - 1];
      recent_texcoords_.erase(recent_texcoords_.begin() + static_cast<std::ptrdiff_t>(symbol) - 1);
      if (s.texcoords.size() != wedges) return false;
    } else {
      if (c_.decoding()) s.texcoords.resize(wedges);
      Grid2 before{};
      for (Grid2& uv : s.texcoords) {
        for (std::size_t k = 0; k < 2; ++k)
          uv[k] = before[k] + c_.signed_number(shape_texcoord_, uv[k] - before[k]);
        if (std::abs(uv[0]) > k_grid_limit || std::abs(uv[1]) > k_grid_limit) return false;
        before = uv;
      }
    }
    recent_texcoords_.insert(recent_texcoords_.begin(), s.texcoords);
    if (recent_texcoords_.size() > k_recent_texcoords) recent_texcoords_.pop_back();
    return true;
  }

  static std::int32_t limited(std::int64_t x) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(x, -k_octahedral_limit, k_octahedral_limit));
  }

  bool code_place(PackedLeaf& x, const LeafPattern& p, std::size_t group, bool is_first) {
    const PackedShape& s = l_.shapes[x.shape];
    if (s.framed) x.framed = c_.bit(framed_, x.framed);
    if (x.framed && !s.framed) x.framed = false;
    const std::size_t n = x.framed ? 2 : p.vertex_count;
    if (c_.decoding()) x.vertices.resize(n);
    if (x.framed && s.anchored) {
      c_.stream("leaves: limbs");
      if (!code_limb(x, group, is_first)) return false;
      if (x.limb != k_none) return code_anchored(x, s);
    }
    for (std::size_t v = 0; v < n; ++v) code_vertex(x, p, v, is_first);
    if (n > 0) last_ = x.vertices[0];
    if (!x.framed) return true;
    c_.stream("leaves: turns");
    x.half = c_.bit(half_, x.half);
    x.turn = c_.signed_number(turn_, x.turn);
    x.turn = std::clamp<std::int64_t>(x.turn, -k_most_units, k_most_units);
    return true;
  }

  void code_vertex(PackedLeaf& x, const LeafPattern& p, std::size_t v, bool is_first) {
    std::size_t kind = v == 0 ? (is_first ? 0 : 1) : x.framed ? 2 : 3;
    Grid3 expected = v == 0 ? last_ : expected_vertex(x, p, v, kind);
    c_.stream(v == 0 ? "leaves: first corners" : "leaves: other corners");
    std::size_t before = 0;
    double along = 0;  // second edge x first edge
    const std::optional<double> lean = kind == 3 && v == 2 ? mapped_along(x, p) : std::nullopt;
    Grid3 edge{};
    for (std::size_t a = 0; a < 3 && lean; ++a) edge[a] = x.vertices[1][a] - x.vertices[0][a];
    const std::array<std::size_t, 3> order = lean ? by_size(real(edge)) : std::array<std::size_t, 3>{0, 1, 2};
    for (const std::size_t a : order) {
      if (lean && a == order[2] && edge[a] != 0) {
        const double squared = dot(real(edge), real(edge));
        expected[a] =
            grid_offset(x.vertices[0][a] + std::llround((*lean * squared - along) / double(edge[a])));
        kind = 6;
      }
      const std::int64_t off = vertex_.code(
          c_, {3 * kind + a, 24 * kind + before, 24 * kind + off_[std::min<std::size_t>(v, 7)][a]},
          x.vertices[v][a] - expected[a]);
      x.vertices[v][a] = grid_offset(expected[a] + off);
      before = std::min<std::size_t>(size_class(off), 23), off_[std::min<std::size_t>(v, 7)][a] = before;
      along += double(x.vertices[v][a] - x.vertices[0][a]) * double(edge[a]);
    }
  }

  // None, so many up from where the group is, or another: one of the last such, or by number.
  bool code_limb(PackedLeaf& x, std::size_t group, bool is_first) {
    std::uint64_t symbol = 0;
    if (!c_.decoding() && x.limb != k_none) {
      symbol = k_most_up + 1;
      for (std::uint32_t up = 0; up < k_most_up && symbol > k_most_up; ++up)
        if (anchors_.radius_above(group, up) == x.limb) symbol = up + 1;
    }
    symbol = up_.code(c_, {last_up_, is_first ? std::size_t{0} : std::size_t{1}}, symbol);
    last_up_ = static_cast<std::size_t>(std::min<std::uint64_t>(symbol, k_most_up + 1));
    if (symbol <= k_most_up) {
      x.limb = symbol == 0 ? k_none : anchors_.radius_above(group, static_cast<std::uint32_t>(symbol - 1));
      return symbol == 0 || x.limb != k_none;
    }
    if (bool sound = true; recall(recent_limbs_, recent_limb_, x.limb, sound))
      return true;
    else if (!sound)
      return false;
    const std::int64_t from = anchors_.radius_above(group, 0);
    const std::int64_t r = from + c_.signed_number(limb_, std::int64_t{x.limb} - from);
    if (r < 0 || r >= std::int64_t{anchors_.count()}) return false;
    x.limb = static_cast<std::uint32_t>(r);
    remember(recent_limbs_, x.limb);
    return true;
  }

  // Its edge, its turn and then its place: by the limb that it sits on.
  bool code_anchored(PackedLeaf& x, const PackedShape& s) {
    const std::optional<LeafLimb> limb = anchors_.limb(x.limb);
    if (!limb) return false;
    c_.stream("leaves: places on limbs");
    x.along = c_.plain(limb->along_bits(), x.along);
    const Double3 axis = limb->axis(x.along);
    c_.stream("leaves: edges");
    Grid3 edge{};
    if (!c_.decoding())
      for (std::size_t a = 0; a < 3; ++a) edge[a] = x.vertices[1][a] - x.vertices[0][a];
    code_edge(edge, axis);
    c_.stream("leaves: turns");
    const Double3 e = real(edge);
    // What ends a limb leans otherwise than what sits along it.
    const bool ends = x.along + 1 == 1u << limb->along_bits();
    auto& [lean, number] =
        leans_.try_emplace({told_[x.shape], ends}, LeafLean{1, 0}, leans_.size()).first->second;
    const bool half = turn_of(lean, e, axis).half;
    x.half = c_.bit(other_half_, x.half != half) ? !half : half;
    const double units = turn_units(e);
    const std::int64_t expected = std::llround(turn_of(lean, e, axis, x.half) * units);
    const std::int64_t off = lean_.code(c_, {number, off_turn_}, x.turn - expected);
    x.turn = std::clamp<std::int64_t>(expected + off, -k_most_units, k_most_units);
    off_turn_ = size_class(off);
    const LeafFrame frame = leaf_frame(e, x.half, double(x.turn) / units);
    const LeafLean own = lean_of(frame, axis);
    const bool alike = std::abs(own[0] - lean[0]) + std::abs(own[1] - lean[1]) < k_like_lean;
    for (std::size_t k = 0; k < 2; ++k) lean[k] += (own[k] - lean[k]) * (alike ? k_slow_lean : k_fast_lean);
    c_.stream("leaves: anchors");
    const Double3 at = limb->point(x.along) - frame.out_of(real(s.anchor) * (frame.length / k_leaf_unit));
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t guess = std::llround(at[static_cast<int>(a)]);
      x.vertices[0][a] = grid_offset(guess + anchor_.code(c_, {a, off_anchor_[a]}, x.vertices[0][a] - guess));
      off_anchor_[a] = size_class(x.vertices[0][a] - guess);
      x.vertices[1][a] = grid_offset(x.vertices[0][a] + edge[a]);
    }
    last_ = x.vertices[0];
    return true;
  }

  // The axes, that along which this goes least first.
  static std::array<std::size_t, 3> by_size(const Double3& way) {
    std::array<std::size_t, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(way[static_cast<int>(a)]) < std::abs(way[static_cast<int>(b)]);
    });
    return order;
  }

  // Of a leaf whose first edge lies along one of its picture's sides: how far the second edge goes along it,
  // in lengths of it.
  std::optional<double> mapped_along(const PackedLeaf& x, const LeafPattern& p) const {
    if (!p.has_texcoords) return std::nullopt;
    const std::array<const Grid2*, 3> uv{in_picture(x, 0), in_picture(x, 1), in_picture(x, 2)};
    if (std::find(uv.begin(), uv.end(), nullptr) != uv.end()) return std::nullopt;
    for (const std::size_t k : {0u, 1u}) {
      const std::int64_t side = (*uv[1])[k] - (*uv[0])[k];
      if (side == 0 || (*uv[1])[1 - k] != (*uv[0])[1 - k]) continue;
      const double t = double((*uv[2])[k] - (*uv[0])[k]) / double(side);
      if (std::abs(t) <= 4) return t;
    }
    return std::nullopt;
  }

  // Across the limb: the coordinate in which the limb goes farthest follows from the other two.
  void code_edge(Grid3& edge, const Double3& axis) {
    const std::array<std::size_t, 3> order = by_size(axis);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = order[k];
      const double along = axis[static_cast<int>(a)];
      const std::int64_t expected =
          k < 2 ? 0 : std::llround(-sum / (along < 0 ? std::min(along, -0.5) : std::max(along, 0.5)));
      const std::int64_t off = edge_.code(c_, {k, 3 * off_edge_ + k}, edge[a] - expected);
      edge[a] = grid_offset(expected + off), off_edge_ = size_class(off);
      sum += along * double(edge[a]);
    }
  }

  // As its texture coordinates lie in the triangle of the first three; a parallelogram with a triangle
  // before; or the vertex before.
  Grid3 expected_vertex(const PackedLeaf& x, const LeafPattern& p, std::size_t v, std::size_t& kind) const {
    if (Grid3 out{}; v >= 3 && as_mapped(x, p, v, out)) {
      kind = 5;
      return out;
    }
    for (std::size_t t = 0; t < p.vertices.size() && v >= 3 && t < 64; ++t) {
      const auto& own = p.vertices[t];
      for (std::size_t k = 0; k < 3; ++k) {
        if (own[k] != v) continue;
        const std::uint32_t a = own[(k + 1) % 3], b = own[(k + 2) % 3];
        if (a >= v || b >= v) return x.vertices[v - 1];
        for (std::size_t u = 0; u < t; ++u) {
          const auto& other = p.vertices[u];
          for (std::size_t e = 0; e < 3; ++e) {
            const std::uint32_t q = other[e], r = other[(e + 1) % 3];
            if (!((q == a && r == b) || (q == b && r == a))) continue;
            kind = 4;
            Grid3 out{};
            for (std::size_t i = 0; i < 3; ++i)
              out[i] = x.vertices[a][i] + x.vertices[b][i] - x.vertices[other[(e + 2) % 3]][i];
            return out;
          }
        }
        return x.vertices[v - 1];
      }
    }
    return x.vertices[v - 1];
  }

  // Affine in texture coordinates.
  bool as_mapped(const PackedLeaf& x, const LeafPattern& p, std::size_t v, Grid3& out) const {
    if (!p.has_texcoords) return false;
    const std::array<const Grid2*, 4> uv{in_picture(x, 0), in_picture(x, 1), in_picture(x, 2),
                                         in_picture(x, v)};
    if (std::find(uv.begin(), uv.end(), nullptr) != uv.end()) return false;
    const auto side = [&](std::size_t i, std::size_t k) { return double((*uv[i])[k] - (*uv[0])[k]); };
    const double area = side(1, 0) * side(2, 1) - side(1, 1) * side(2, 0);
    if (area == 0) return false;
    const double s = (side(3, 0) * side(2, 1) - side(3, 1) * side(2, 0)) / area,
                 t = (side(1, 0) * side(3, 1) - side(1, 1) * side(3, 0)) / area;
    if (!(std::abs(s) <= 4 && std::abs(t) <= 4)) return false;
    for (std::size_t a = 0; a < 3; ++a)
      out[a] = x.vertices[0][a] + std::llround(s * double(x.vertices[1][a] - x.vertices[0][a]) +
                                               t * double(x.vertices[2][a] - x.vertices[0][a]));
    return true;
  }

  void code_normals(PackedLeaf& x, const LeafPattern& p, std::size_t group) {
    if (!p.has_normals) return;
    const PackedShape& s = l_.shapes[x.shape];
    c_.stream("leaves: normals");
    const bool by_rule = s.normals != LeafNormals::given;
    if (by_rule) x.shaded = c_.bit(shaded_, x.shaded);
    if (x.shaded) return;
    if (c_.decoding()) x.normals.resize(p.vertex_of.size());
    const std::vector<Double3> places = by_rule ? leaf_places(x, s, p.vertex_count) : std::vector<Double3>{};
    const LeafFrame frame = leaf_frame(places);
    const Grid3* centre = l_.normal_centres.empty() ? nullptr : &l_.normal_centres[group];
    for (std::uint32_t w = 0; w < x.normals.size(); ++w) {
      if (!(p.carries[w] & has_normal)) continue;
      Octahedral expected = w > 0 ? x.normals[w - 1] : last_normal_;
      if (by_rule) expected = to_octahedral(leaf_normal(s, frame, places, w, p.vertex_of[w], centre));
      for (std::size_t k = 0; k < 2; ++k)
        x.normals[w][k] = limited(
            expected[k] + c_.signed_number(normal_[by_rule], std::int64_t{x.normals[w][k]} - expected[k]));
    }
    if (!x.normals.empty()) last_normal_ = x.normals[0];
  }

  void code_texcoords(PackedLeaf& x, const LeafPattern& p) {
    if (!p.has_texcoords) return;
    const PackedShape& s = l_.shapes[x.shape];
    c_.stream("leaves: texture coordinates");
    x.mapped = c_.bit(mapped_, x.mapped);
    if (x.mapped) return;
    if (c_.decoding()) x.texcoords.resize(p.vertex_of.size());
    for (std::size_t w = 0; w < x.texcoords.size(); ++w)
      for (std::size_t k = 0; k < 2; ++k) {
        const std::int64_t uv =
            s.texcoords[w][k] + c_.signed_number(texcoord_, x.texcoords[w][k] - s.texcoords[w][k]);
        x.texcoords[w][k] = std::clamp(uv, -k_grid_limit, k_grid_limit);
      }
  }

  RangeCoder& c_;
  PackedLeaves& l_;
  const Head& head_;
  LeafAnchors anchors_;
  std::vector<std::uint32_t> recent_shapes_, recent_patterns_, recent_limbs_;
  std::uint32_t material_ = 0;
  Grid3 last_{};
  Octahedral last_normal_{};
  std::vector<std::vector<std::uint32_t>> first_wedge_;  // of each vertex of each pattern
  std::vector<std::vector<Grid2>> recent_texcoords_;
  // When each shape was last told. One that has been forgotten is told again, and is another one to who
  // reads: what is learnt of a shape goes by this, not by its number.
  std::vector<std::uint32_t> told_;
  std::uint32_t times_told_ = 0;
  // Of the last leaf of each shape that was told, and a number by first use.
  std::map<std::pair<std::uint32_t, bool>, std::pair<LeafLean, std::size_t>> leans_;
  std::size_t last_up_ = 0, off_turn_ = 0, off_edge_ = 0;
  std::array<std::size_t, 3> off_anchor_{};
  std::array<std::array<std::size_t, 3>, 8> off_{};

  NumberModel recent_limb_, rule_, which_texcoords_, group_size_, shape_, pattern_, triangles_, vertex_index_,
      wedge_index_, material_model_;
  std::array<BitModel, 2> pattern_bits_;
  BitModel framed_shape_, anchored_shape_, framed_, half_, other_half_, shaded_, mapped_, same_material_;
  std::array<SignedModel, 3> centre_;
  SignedModel limb_, place_, shape_texcoord_, shape_normal_, point_, turn_, texcoord_;
  std::array<SignedModel, 2> normal_;
  MixedSigned vertex_{21, 168, 168}, edge_{3, 75}, lean_{16, 32}, anchor_{3, 25};
  MixedNumber up_{k_most_up + 2, 2};
};

}  // namespace

std::string code_leaves(RangeCoder& coder, PackedLeaves& leaves, const PackedTrunk& trunk, const Head& head) {
  return std::make_unique<LeafCoder>(coder, leaves, trunk, head)->run();
}

std::string build_leaves(const PackedLeaves& leaves, const PackGrid& grid, const Head& head, Tree& tree) {
  const double step = grid.step();
  std::vector<std::uint32_t> first{0}, materials;
  std::vector<CornerTriangle> triangles;
  std::vector<Float3> vertices, normals;
  std::vector<Float2> texcoords;
  std::map<Octahedral, std::uint32_t> normal_number;
  std::map<Grid2, std::uint32_t> texcoord_number;
  std::size_t leaf = 0;
  for (std::size_t g = 0; g < leaves.group_sizes.size(); ++g) {
    for (std::uint32_t i = 0; i < leaves.group_sizes[g]; ++i, ++leaf) {
      const PackedLeaf& x = leaves.list[leaf];
      const PackedShape& s = leaves.shapes[x.shape];
      const LeafPattern& p = leaves.patterns[s.pattern];
      const std::vector<Double3> places = leaf_places(x, s, p.vertex_count);
      const auto base = static_cast<std::uint32_t>(vertices.size());
      for (const Double3& v : places) {
        if (std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) > 4 * double(k_grid_limit))
          return "a leaf is out of range";
        vertices.push_back(to_float(v * step));
      }
      const LeafFrame frame = leaf_frame(places);
      std::vector<std::uint32_t> normal_of_wedge, texcoord_of_wedge;
      for (std::uint32_t w = 0; w < p.vertex_of.size(); ++w) {
        if (!(p.carries[w] & has_normal)) normal_of_wedge.push_back(k_none);
        if ((p.carries[w] & has_normal) && x.shaded) {
          const Grid3* centre = leaves.normal_centres.empty() ? nullptr : &leaves.normal_centres[g];
          normal_of_wedge.push_back(static_cast<std::uint32_t>(normals.size()));
          normals.push_back(to_float(leaf_normal(s, frame, places, w, p.vertex_of[w], centre)));
        } else if (p.carries[w] & has_normal) {
          const auto [at, is_new] =
              normal_number.try_emplace(x.normals[w], static_cast<std::uint32_t>(normals.size()));
          if (is_new) normals.push_back(from_octahedral(x.normals[w]));
          normal_of_wedge.push_back(at->second);
        }
        if (!(p.carries[w] & has_texcoord)) {
          texcoord_of_wedge.push_back(k_none);
          continue;
        }
        const Grid2& uv = x.mapped ? s.texcoords[w] : x.texcoords[w];
        const auto [at, is_new] =
            texcoord_number.try_emplace(uv, static_cast<std::uint32_t>(texcoords.size()));
        if (is_new)
          texcoords.push_back({static_cast<float>(double(uv[0]) * grid.texcoord_step()),
                               static_cast<float>(double(uv[1]) * grid.texcoord_step())});
        texcoord_of_wedge.push_back(at->second);
      }
      for (std::size_t t = 0; t < p.vertices.size(); ++t) {
        CornerTriangle& out = triangles.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
          out.vertex[c] = base + p.vertices[t][c];
          out.normal[c] = normal_of_wedge[p.wedges[t][c]];
          out.texcoord[c] = texcoord_of_wedge[p.wedges[t][c]];
        }
      }
      first.push_back(static_cast<std::uint32_t>(triangles.size()));
      materials.push_back(x.material - 1);
    }
  }
  Leaves& l = tree.leaves;
  l.triangles = std::move(triangles), l.vertices = std::move(vertices), l.normals = std::move(normals);
  l.texcoords = std::move(texcoords), l.first_triangle = std::move(first);
  l.material = head.leaf_material;
  if (head.leaf_materials) l.materials = std::move(materials);
  return "";
}

}  // namespace copse
