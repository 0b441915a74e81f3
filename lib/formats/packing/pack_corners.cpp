#include "lib/formats/packing/pack_corners.h"

#include "lib/formats/packing/context_mixing.h"
#include "lib/formats/packing/leaf_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

namespace copse {
namespace {

using Symbols = std::vector<std::uint8_t>;

constexpr std::size_t k_most_wedges = 64;  // of a vertex that are looked at
constexpr std::size_t k_most_recent = 24;  // texture coordinates
constexpr double k_flat = 0.004;           // 5 degrees, rms: mean of 1 - cosine

// The angle whose cosine this is, within 7e-5 (Abramowitz and Stegun 4.4.45): the same everywhere.
double angle_of(double cosine) {
  const double c = std::clamp(std::abs(cosine), 0.0, 1.0);
  const double a = std::sqrt(1 - c) * (1.5707288 + c * (-0.2121144 + c * (0.0742610 - c * 0.0187293)));
  return cosine < 0 ? 3.14159265358979312 - a : a;
}

// Places, limbs and neighbours of vertices, and what their normals are likely to be.
class Surface {
 public:
  Surface(const PackedTrunk& trunk, std::uint32_t roots) : t_(trunk), parent_(parents_of(trunk, roots)) {
    for (std::uint32_t r = 0; r < t_.radii.size(); ++r) {
      first_.push_back(static_cast<std::uint32_t>(places_.size()));
      for (std::uint32_t j = 0; j < t_.radii[r].vectors; ++j) {
        places_.push_back(real(t_.radii[r].centre) + real(t_.vectors[places_.size()]));
        radius_.push_back(r);
      }
    }
    first_neighbour_.assign(places_.size() + 1, 0);
    for (const auto& t : t_.triangles)
      for (const std::uint32_t v : t) first_neighbour_[v + 1] += 2;
    for (std::size_t v = 0; v < places_.size(); ++v) first_neighbour_[v + 1] += first_neighbour_[v];
    neighbours_.resize(first_neighbour_.back());
    std::vector<std::uint32_t> next(first_neighbour_.begin(), first_neighbour_.end() - 1);
    for (const auto& t : t_.triangles)
      for (std::size_t c = 0; c < 3; ++c)
        for (const std::size_t o : {(c + 1) % 3, (c + 2) % 3}) neighbours_[next[t[c]]++] = t[o];
  }

  void use(TrunkNormals base) {
    normals_.assign(places_.size(), Double3{});
    for (const auto& t : t_.triangles) {
      const Double3 n = face(t);
      for (std::size_t c = 0; c < 3; ++c) {
        if (base == TrunkNormals::by_area) normals_[t[c]] += n;
        if (base != TrunkNormals::by_angle) continue;
        const Double3 a = normalized(places_[t[(c + 1) % 3]] - places_[t[c]], {}),
                      b = normalized(places_[t[(c + 2) % 3]] - places_[t[c]], {});
        normals_[t[c]] += normalized(n, {}) * angle_of(dot(a, b));
      }
    }
    for (std::size_t v = 0; v < places_.size(); ++v)
      normals_[v] = normalized(base == TrunkNormals::radial ? real(t_.vectors[v]) : normals_[v]);
  }

  Double3 face(const std::array<std::uint32_t, 3>& t) const {
    return cross(places_[t[1]] - places_[t[0]], places_[t[2]] - places_[t[0]]);
  }
  const Double3& normal(std::uint32_t v) const { return normals_[v]; }
  // x along the surface's normal there, y round the limb.
  LeafFrame frame(std::uint32_t v) const {
    const std::uint32_t r = radius_[v], p = parent_[r];
    const Double3 axis =
        p == k_none ? Double3{0, 1, 0} : normalized(real(t_.radii[r].centre) - real(t_.radii[p].centre));
    LeafFrame f;
    f.x = normals_[v], f.y = normalized(cross(axis, f.x), across(f.x)), f.z = cross(f.x, f.y);
    return f;
  }
  std::span<const std::uint32_t> neighbours(std::uint32_t v) const {
    return std::span(neighbours_).subspan(first_neighbour_[v], first_neighbour_[v + 1] - first_neighbour_[v]);
  }
  std::uint32_t radius(std::uint32_t v) const { return radius_[v]; }
  // The vertex so many further on in the ring.
  std::uint32_t on(std::uint32_t v, std::uint32_t by) const {
    const std::uint32_t r = radius_[v];
    return first_[r] + (v - first_[r] + by) % t_.radii[r].vectors;
  }
  // The same place of the parent's ring, where that has as many; or none.
  std::uint32_t below(std::uint32_t v) const {
    const std::uint32_t r = radius_[v], p = parent_[r];
    return p == k_none || t_.radii[p].vectors != t_.radii[r].vectors ? k_none : first_[p] + (v - first_[r]);
  }
  std::uint32_t ring_size(std::uint32_t v) const { return t_.radii[radius_[v]].vectors; }

 private:
  const PackedTrunk& t_;
  std::vector<std::uint32_t> parent_, first_, radius_, first_neighbour_, neighbours_;
  std::vector<Double3> places_, normals_;
};

class CornerCoder {
 public:
  CornerCoder(RangeCoder& coder, PackedTrunk& trunk, const Head& head)
      : c_(coder), t_(trunk), head_(head), surface_(trunk, head.header.roots), known_(trunk.vectors.size()) {}

  std::string run(std::span<const std::array<std::uint32_t, 2>> lines) {
    c_.stream("trunk corners: which");
    t_.normals = static_cast<TrunkNormals>(c_.plain(2, static_cast<std::uint32_t>(t_.normals)));
    surface_.use(t_.normals);
    std::map<std::array<std::uint32_t, 3>, Symbols> seen;
    std::uint32_t at = 0;
    for (std::size_t s = 0; s < lines.size(); ++s) {
      Symbols& like = seen[{t_.radii[lines[s][1]].vectors, t_.radii[lines[s][0]].vectors, t_.counts[s]}];
      Symbols symbols;
      for (const std::uint32_t end = at + t_.counts[s]; at < end; ++at) {
        for (std::size_t corner = 0; corner < 3; ++corner)
          if (!code_wedge(at, corner, like, symbols)) return "a corner names what is not there";
        if (c_.failed()) return "it ends in normals and texture coordinates";
      }
      like = std::move(symbols);
    }
    return "";
  }

 private:
  using Wedges = std::vector<PackedWedge>;

  bool code_wedge(std::uint32_t at, std::size_t corner, const Symbols& like, Symbols& symbols) {
    const std::uint32_t v = t_.triangles[at][corner];
    PackedWedge& wedge = t_.wedges[at][corner];
    Wedges& known = known_[v];
    std::uint64_t symbol = 0;
    c_.stream("trunk corners: which");
    if (!c_.decoding()) {
      const auto found = std::find(known.begin(), known.end(), wedge);
      if (found != known.end()) symbol = static_cast<std::uint64_t>(found - known.begin()) + 1;
    }
    const std::size_t i = symbols.size();
    if (!known.empty()) {
      const std::size_t guess = i < like.size() ? std::min<std::size_t>(like[i], 3) : 4;
      const std::size_t before = i > 0 ? std::min<std::size_t>(symbols[i - 1], 2) : 3;
      const std::size_t held = std::min<std::size_t>(known.size(), 7);
      symbol = choice_.code(c_, {4 * guess + before, 3 * held + corner, 4 * held + before}, symbol);
    }
    if (symbol > known.size()) return false;
    symbols.push_back(static_cast<std::uint8_t>(std::min<std::uint64_t>(symbol, 255)));
    if (symbol == 0) {
      code_normal(wedge, at, v);
      code_texcoord(wedge, at, corner);
    } else {
      wedge = known[symbol - 1];
      known.erase(known.begin() + static_cast<std::ptrdiff_t>(symbol) - 1);
    }
    known.insert(known.begin(), wedge);
    if (known.size() > k_most_wedges) known.pop_back();
    return true;
  }

  // ---- normals

  void code_normal(PackedWedge& wedge, std::uint32_t at, std::uint32_t v) {
    if (head_.counts.trunk_normals == 0) return;
    c_.stream("trunk normals");
    wedge.has_normal = c_.bit(has_normal_, wedge.has_normal);
    if (!wedge.has_normal) return;
    std::size_t kind = 0;
    const Octahedral expected = expected_normal(at, v, kind);
    std::size_t before = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::int64_t off = normal_.code(c_, {2 * kind + k, 9 * k + before, 9 * kind + off_normal_[k]},
                                            wedge.normal[k] - expected[k]);
      wedge.normal[k] = static_cast<std::int32_t>(
          std::clamp<std::int64_t>(expected[k] + off, -k_octahedral_limit, k_octahedral_limit));
      before = off_normal_[k] = std::min<std::size_t>(size_class(off), 8);
    }
  }

  // That of the face; that which the vertex has; turned from the surface's as the neighbour's is whose
  // surface is most alike.
  Octahedral expected_normal(std::uint32_t at, std::uint32_t v, std::size_t& kind) const {
    if (t_.normals == TrunkNormals::faces) return to_octahedral(normalized(surface_.face(t_.triangles[at])));
    if (!known_[v].empty() && known_[v][0].has_normal) return kind = 1, known_[v][0].normal;
    const std::uint32_t like = most_alike(v, [&](std::uint32_t w) { return known_[w][0].has_normal; });
    if (like == k_none) return kind = 2, to_octahedral(surface_.normal(v));
    const Double3 turned = surface_.frame(like).into(to_double(from_octahedral(known_[like][0].normal)));
    return kind = 3, to_octahedral(normalized(surface_.frame(v).out_of(turned)));
  }

  // Of the neighbours that are known.
  template <class Wanted>
  std::uint32_t most_alike(std::uint32_t v, const Wanted& wanted) const {
    std::uint32_t best = k_none;
    double most = -2;
    for (const std::uint32_t w : surface_.neighbours(v)) {
      if (w == v || known_[w].empty() || !wanted(w)) continue;
      const double alike = dot(surface_.normal(v), surface_.normal(w));
      if (alike > most) most = alike, best = w;
    }
    return best;
  }

  // ---- texture coordinates

  static constexpr std::size_t k_slots = 8;
  using Slots = std::array<const Grid2*, k_slots>;

  void code_texcoord(PackedWedge& wedge, std::uint32_t at, std::size_t corner) {
    if (head_.counts.trunk_texcoords == 0) return;
    c_.stream("trunk texture coordinates");
    wedge.has_texcoord = c_.bit(has_texcoord_, wedge.has_texcoord);
    if (!wedge.has_texcoord) return;
    Grid2 jump{}, going_on{};
    const Slots slots = slots_of(at, corner, jump, going_on);
    std::size_t mask = 0;
    for (std::size_t s = 0; s < k_slots; ++s) mask |= (slots[s] != nullptr ? std::size_t{1} : 0) << s;
    for (std::size_t k = 0; k < 2; ++k) {
      std::int64_t& x = wedge.texcoord[k];
      std::vector<std::int64_t>& recent = recent_[k];
      std::size_t symbol = 0;
      if (!c_.decoding()) symbol = symbol_of(slots, recent, k, x);
      symbol = which_.code(c_, {2 * mask + k, 16 * k + last_which_[k], 2 * last_which_[0] + k}, symbol);
      last_which_[k] = static_cast<std::size_t>(std::min<std::size_t>(symbol, 15));
      if (symbol > 0 && symbol <= k_slots && slots[symbol - 1] != nullptr) {
        x = (*slots[symbol - 1])[k];
      } else if (symbol > k_slots && symbol - k_slots <= recent.size()) {
        x = recent[symbol - k_slots - 1];
      } else {
        const std::size_t base = base_of(slots);
        const std::int64_t expected = base < k_slots   ? (*slots[base])[k]
                                      : recent.empty() ? 0
                                                       : recent.front();
        const std::int64_t off = texcoord_.code(c_, {2 * base + k, k}, x - expected);
        x = expected + off;
        if (std::abs(x) > k_grid_limit) x = 0;
      }
      if (slots[0] != nullptr && x != (*slots[0])[k]) jump_[k] = x - (*slots[0])[k];
      if (const auto old = std::find(recent.begin(), recent.end(), x); old != recent.end()) recent.erase(old);
      recent.insert(recent.begin(), x);
      if (recent.size() > k_most_recent) recent.pop_back();
    }
  }
  static std::size_t symbol_of(const Slots& slots, const std::vector<std::int64_t>& recent, std::size_t k,
                               std::int64_t x) {
    for (std::size_t s = 0; s < k_slots; ++s)
      if (slots[s] != nullptr && (*slots[s])[k] == x) return s + 1;
    const auto old = std::find(recent.begin(), recent.end(), x);
    return old == recent.end() ? 0 : k_slots + 1 + static_cast<std::size_t>(old - recent.begin());
  }
  static std::size_t base_of(const Slots& slots) {
    for (const std::size_t s : {0u, 2u, 4u, 3u, 5u, 6u, 7u})
      if (slots[s] != nullptr) return s;
    return k_slots;
  }

  // Of the vertex itself; that as far on as such were last; in the ring as its neighbour is, seen from the
  // ring before; of the neighbour whose surface is most alike; of those in the ring; of the triangle.
  Slots slots_of(std::uint32_t at, std::size_t corner, Grid2& jump, Grid2& going_on) const {
    const auto& t = t_.triangles[at];
    const std::uint32_t v = t[corner];
    const auto of = [&](std::uint32_t w) -> const Grid2* {
      return w == k_none || known_[w].empty() || !known_[w][0].has_texcoord ? nullptr
                                                                            : &known_[w][0].texcoord;
    };
    Slots s{};
    s[0] = of(v);
    if (s[0] != nullptr) {
      for (std::size_t k = 0; k < 2; ++k) jump[k] = (*s[0])[k] + jump_[k];
      s[1] = &jump;
    }
    if (const std::uint32_t k = surface_.ring_size(v); k > 1) {
      s[4] = of(surface_.on(v, k - 1)), s[5] = of(surface_.on(v, 1));
      const std::uint32_t below = surface_.below(v);
      const Grid2 *b = s[4], *a = of(below), *z = below == k_none ? nullptr : of(surface_.on(below, k - 1));
      if (a != nullptr && b != nullptr && z != nullptr) {
        for (std::size_t i = 0; i < 2; ++i) going_on[i] = (*b)[i] + (*a)[i] - (*z)[i];
        s[2] = &going_on;
      }
    }
    s[3] = of(most_alike(v, [&](std::uint32_t w) {
      return known_[w][0].has_texcoord && surface_.radius(w) != surface_.radius(v);
    }));
    for (std::size_t back = 1; back <= corner; ++back)
      if (const PackedWedge& w = t_.wedges[at][corner - back]; w.has_texcoord) s[5 + back] = &w.texcoord;
    return s;
  }

  RangeCoder& c_;
  PackedTrunk& t_;
  const Head& head_;
  Surface surface_;
  std::vector<Wedges> known_;  // of every vertex, the last one first
  std::array<std::vector<std::int64_t>, 2> recent_;
  Grid2 jump_{};
  std::array<std::size_t, 2> off_normal_{}, last_which_{};

  BitModel has_normal_, has_texcoord_;
  MixedNumber choice_{20, 24, 32};
  MixedSymbol which_{k_slots + k_most_recent + 1, {2 << k_slots, 32, 32}};
  MixedSigned normal_{8, 18, 36}, texcoord_{2 * (k_slots + 1), 2};
};

}  // namespace

TrunkNormals nearest_normals(const PackedTrunk& trunk, std::uint32_t roots) {
  Surface surface(trunk, roots);
  double apart = 0, least = std::numeric_limits<double>::infinity();
  std::size_t n = 0;
  for (std::size_t t = 0; t < trunk.triangles.size(); ++t)
    for (const PackedWedge& w : trunk.wedges[t])
      if (w.has_normal)
        apart +=
            1 - dot(normalized(surface.face(trunk.triangles[t]), {}), to_double(from_octahedral(w.normal))),
            ++n;
  if (n > 0 && apart < k_flat * static_cast<double>(n)) return TrunkNormals::faces;
  TrunkNormals best = TrunkNormals::by_area;
  for (const TrunkNormals base : {TrunkNormals::by_area, TrunkNormals::by_angle, TrunkNormals::radial}) {
    surface.use(base);
    double bits = 0;
    for (std::size_t t = 0; t < trunk.triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c)
        if (trunk.wedges[t][c].has_normal)
          bits += std::log2(1 + k_octahedral_limit *
                                    distance(surface.normal(trunk.triangles[t][c]),
                                             to_double(from_octahedral(trunk.wedges[t][c].normal))));
    if (bits < least) least = bits, best = base;
  }
  return best;
}

std::string code_corners(RangeCoder& coder, PackedTrunk& trunk,
                         std::span<const std::array<std::uint32_t, 2>> lines, const Head& head) {
  if (head.counts.trunk_normals == 0 && head.counts.trunk_texcoords == 0) return "";
  return std::make_unique<CornerCoder>(coder, trunk, head)->run(lines);
}

}  // namespace copse
