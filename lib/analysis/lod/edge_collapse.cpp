#include "lib/analysis/lod/edge_collapse.h"

#include "lib/analysis/lod/edge_quadric.h"
#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace copse {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Attributes = std::array<float, k_attributes>;

constexpr float k_border_weight = 10;  // of a plane across a border or a seam
constexpr double k_pass_share = 0.35;  // of the candidates that a pass goes through, cheapest first
constexpr float k_pass_slack = 1.5f;   // beyond the cost of the last of them

enum class Kind : std::uint8_t { inner, border, seam, fixed };

std::uint32_t next_corner(std::uint32_t c) {
  return c == 2 ? 0 : c + 1;
}

struct Candidate {
  std::uint32_t thrown = 0, kept = 0;  // positions
  float cost = 0;
};

class Collapser {
 public:
  Collapser(const PartTriangles& mesh, const EdgeCollapseOptions& options) : mesh_(mesh), options_(options) {
    triangles_ = mesh.triangles;
    number_positions();
    drop_degenerate();
    build_rings();
    classify();
    add_quadrics();
  }

  EdgeCollapses run() {
    bool all = false;
    while (triangles_.size() > options_.min_triangles) {
      build_rings();
      collect();
      if (candidates_.empty()) break;
      const std::size_t made = pass(all);
      drop_degenerate();
      if (made == 0 && all) break;
      all = made == 0;
    }
    out_.triangles = triangles_.size();
    return std::move(out_);
  }

 private:
  // One number for every place; coordinates in a unit box.
  void number_positions() {
    std::uint32_t count = 0;
    for (const std::uint32_t p : mesh_.position_of) count = std::max(count, p + 1);
    places_.resize(count), wedge_.assign(count, k_none), next_wedge_.assign(mesh_.vertices.size(), k_none);
    DoubleBox box;
    for (const SpectrumVertex& v : mesh_.vertices) box.grow(to_double(v.position));
    size_ = box.empty() ? 1 : std::max(length(box.extent()), 1e-300);
    const Double3 low = box.empty() ? Double3{} : box.min;
    Float2 uv_low{}, uv_high{};
    for (const SpectrumVertex& v : mesh_.vertices) {
      uv_low = {std::min(uv_low.x, v.texcoord.x), std::min(uv_low.y, v.texcoord.y)};
      uv_high = {std::max(uv_high.x, v.texcoord.x), std::max(uv_high.y, v.texcoord.y)};
    }
    const float weight = static_cast<float>(options_.attribute_weight) * 0.1f;
    attributes_.resize(mesh_.vertices.size());
    for (std::uint32_t v = mesh_.vertices.size() & 0xffffffffu; v-- > 0;) {
      const std::uint32_t p = mesh_.position_of[v];
      places_[p] = to_float((to_double(mesh_.vertices[v].position) - low) / size_);
      next_wedge_[v] = wedge_[p], wedge_[p] = v;
      const SpectrumVertex& x = mesh_.vertices[v];
      const float repeats = std::max({1.0f, uv_high.x - uv_low.x, uv_high.y - uv_low.y});
      attributes_[v] = {weight * x.normal.x, weight * x.normal.y, weight * x.normal.z,
                        weight * x.texcoord.x / repeats * 4, weight * x.texcoord.y / repeats * 4};
    }
    quadrics_.resize(count), attribute_quadrics_.resize(mesh_.vertices.size());
    kinds_.assign(count, Kind::inner), stamp_.assign(count, 0), touched_.assign(count, 0);
    moved_.resize(mesh_.vertices.size());
    for (std::uint32_t v = 0; v < moved_.size(); ++v) moved_[v] = v;
  }

  std::uint32_t place(std::uint32_t vertex) const { return mesh_.position_of[vertex]; }

  void drop_degenerate() {
    std::erase_if(triangles_, [&](const Corners& t) {
      const std::uint32_t a = place(t[0]), b = place(t[1]), c = place(t[2]);
      return a == b || b == c || c == a;
    });
  }

  // The triangles round every position, in order.
  void build_rings() {
    ring_first_.assign(places_.size() + 1, 0);
    for (const Corners& t : triangles_)
      for (const std::uint32_t v : t) ++ring_first_[place(v) + 1];
    for (std::size_t p = 0; p < places_.size(); ++p) ring_first_[p + 1] += ring_first_[p];
    ring_.resize(3 * triangles_.size());
    fill_.assign(ring_first_.begin(), ring_first_.end() - 1);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (const std::uint32_t v : triangles_[t]) ring_[fill_[place(v)]++] = t;
  }

  std::span<const std::uint32_t> ring(std::uint32_t p) const {
    return {ring_.data() + ring_first_[p], ring_.data() + ring_first_[p + 1]};
  }

  // Triangles that run from p to q, and their wedges; `twice`: more than one does.
  struct Directed {
    std::uint32_t count = 0, from = k_none, to = k_none;
  };
  Directed directed(std::uint32_t p, std::uint32_t q) const {
    Directed d;
    for (const std::uint32_t t : ring(p)) {
      const Corners& c = triangles_[t];
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t v = moved_[c[i]], w = moved_[c[next_corner(i)]];
        if (place(v) != p || place(w) != q) continue;
        ++d.count;
        d.from = v, d.to = w;
      }
    }
    return d;
  }

  void classify() {
    for (std::uint32_t p = 0; p < places_.size(); ++p) {
      std::uint32_t borders = 0, seams = 0;
      bool broken = false;
      for (const std::uint32_t t : ring(p)) {
        const Corners& c = triangles_[t];
        for (std::uint32_t i = 0; i < 3; ++i) {
          if (place(c[i]) != p) continue;
          const std::uint32_t q = place(c[next_corner(i)]), r = place(c[next_corner(next_corner(i))]);
          const Directed out = directed(p, q), back = directed(q, p);
          if (out.count > 1 || back.count > 1) broken = true;
          if (back.count == 0) ++borders;
          if (back.count == 1 && !(same_texcoord(back.to, out.from) && same_texcoord(back.from, out.to)))
            ++seams;
          if (directed(p, r).count == 0) ++borders;  // the edge from r comes in and none goes out
        }
      }
      kinds_[p] = broken || borders > 2 || borders == 1 || (borders > 0 && seams > 0) ||
                          (seams != 0 && seams != 2) || !one_fan(p)
                      ? Kind::fixed
                  : borders == 2 ? Kind::border
                  : seams == 2   ? Kind::seam
                                 : Kind::inner;
    }
  }

  // Whether the triangles round p hang together by edges at p.
  bool one_fan(std::uint32_t p) {
    const auto all = ring(p);
    if (all.size() < 2) return true;
    std::vector<std::uint8_t> seen(all.size(), 0);
    std::vector<std::size_t> stack{0};
    seen[0] = 1;
    std::size_t reached = 1;
    const auto others = [&](std::uint32_t t) {
      std::array<std::uint32_t, 2> out{};
      std::size_t n = 0;
      for (const std::uint32_t v : triangles_[t])
        if (place(v) != p && n < 2) out[n++] = place(v);
      return out;
    };
    if (all.size() > 64) return true;  // a lid's middle
    while (!stack.empty()) {
      const auto a = others(all[stack.back()]);
      stack.pop_back();
      for (std::size_t j = 0; j < all.size(); ++j) {
        if (seen[j]) continue;
        const auto b = others(all[j]);
        if (a[0] != b[0] && a[0] != b[1] && a[1] != b[0] && a[1] != b[1]) continue;
        seen[j] = 1, ++reached;
        stack.push_back(j);
      }
    }
    return reached == all.size();
  }

  void add_quadrics() {
    for (const Corners& t : triangles_) {
      const Float3 a = places_[place(t[0])], b = places_[place(t[1])], c = places_[place(t[2])];
      const Double3 e0 = to_double(b) - to_double(a), e1 = to_double(c) - to_double(a), n = cross(e0, e1);
      const double twice = length(n);
      if (!(twice > 0)) continue;
      const Float3 unit = to_float(n / twice);
      const auto area = static_cast<float>(0.5 * twice);
      PlaneQuadric q;
      q.add_plane(unit, -dot(unit, a), area);
      for (const std::uint32_t v : t) quadrics_[place(v)] += q;
      add_gradients(t, a, e0, e1, n / (twice * twice), area);
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t p = place(t[i]), r = place(t[next_corner(i)]);
        const Directed back = directed(r, p);
        const bool border = back.count == 0,
                   seam = back.count == 1 &&
                          !(same_texcoord(back.to, t[i]) && same_texcoord(back.from, t[next_corner(i)]));
        if (!border && !seam) continue;
        const Double3 along = to_double(places_[r]) - to_double(places_[p]);
        const double l = length(along);
        if (!(l > 0)) continue;
        const Float3 across = to_float(normalized(cross(along, n), {0, 0, 0}));
        PlaneQuadric plane;
        plane.add_plane(across, -dot(across, places_[p]),
                        static_cast<float>(l * l) * (border ? k_border_weight : 1.0f));
        plane.weight = 0;
        quadrics_[p] += plane, quadrics_[r] += plane;
      }
    }
  }

  // The gradient of every attribute over a face: a = g . p + d.
  void add_gradients(const Corners& t, const Float3& origin, const Double3& e0, const Double3& e1,
                     const Double3& n, float area) {
    AttributeQuadric q;
    const Double3 g0 = cross(e1, n), g1 = cross(n, e0);
    for (std::size_t k = 0; k < k_attributes; ++k) {
      const double a0 = attributes_[t[0]][k], d1 = attributes_[t[1]][k] - a0, d2 = attributes_[t[2]][k] - a0;
      const Double3 g = g0 * d1 + g1 * d2;
      q.add_gradient(k, to_float(g), static_cast<float>(a0 - dot(g, to_double(origin))), area);
    }
    q.weight = area;
    for (const std::uint32_t v : t) attribute_quadrics_[v] += q;
  }

  bool same_texcoord(std::uint32_t a, std::uint32_t b) const {
    return mesh_.vertices[a].texcoord == mesh_.vertices[b].texcoord;
  }

  // Where each wedge of p goes when p collapses onto q: along an edge of their triangles. A wedge that has no
  // such edge differs in its normal alone, or there is no way: it takes the way of the wedge with its texture
  // coordinates, to the nearest normal there.
  bool map_wedges(std::uint32_t p, std::uint32_t q) {
    map_.clear();
    if (next_wedge_[wedge_[p]] == k_none && next_wedge_[wedge_[q]] == k_none) {
      map_.push_back({wedge_[p], wedge_[q]});
      return true;
    }
    loose_.clear();
    for (const std::uint32_t t : ring(p)) {
      std::uint32_t at_p = k_none, at_q = k_none;
      for (const std::uint32_t c : triangles_[t]) {
        const std::uint32_t v = moved_[c];
        if (place(v) == p) at_p = v;
        if (place(v) == q) at_q = v;
      }
      if (at_p == k_none) continue;
      if (at_q == k_none) {
        loose_.push_back(at_p);
        continue;
      }
      const auto same =
          std::find_if(map_.begin(), map_.end(), [&](const CollapsedWedge& m) { return m.thrown == at_p; });
      if (same == map_.end()) {
        map_.push_back({at_p, at_q});
      } else if (!same_texcoord(same->kept, at_q)) {
        return false;
      }
    }
    const std::size_t along = map_.size();
    for (const std::uint32_t v : loose_) {
      if (std::any_of(map_.begin(), map_.end(), [&](const CollapsedWedge& m) { return m.thrown == v; }))
        continue;
      const std::uint32_t to = loose_target(v, q, along);
      if (to == k_none) return false;
      map_.push_back({v, to});
    }
    return along > 0;
  }

  std::uint32_t loose_target(std::uint32_t v, std::uint32_t q, std::size_t along) const {
    std::uint32_t best = k_none;
    float nearest = -2;
    for (std::size_t i = 0; i < along; ++i) {
      if (!same_texcoord(map_[i].thrown, v)) continue;
      for (std::uint32_t w = wedge_[q]; w != k_none; w = next_wedge_[w]) {
        if (!same_texcoord(w, map_[i].kept)) continue;
        const float alike = dot(mesh_.vertices[w].normal, mesh_.vertices[v].normal);
        if (alike > nearest) nearest = alike, best = w;
      }
    }
    return best;
  }

  float cost(std::uint32_t p, std::uint32_t q) const {
    float value = quadrics_[p].at(places_[q]);
    for (const CollapsedWedge& m : map_)
      value += attribute_quadrics_[m.thrown].at(places_[q], attributes_[m.kept]);
    return value;
  }

  bool may_go(std::uint32_t p, std::uint32_t q, bool on_border) const {
    switch (kinds_[p]) {
      case Kind::inner:
        return true;
      case Kind::border:
        return on_border;
      case Kind::seam:
        return kinds_[q] == Kind::seam || kinds_[q] == Kind::fixed;
      case Kind::fixed:
        break;
    }
    return false;
  }

  void collect() {
    candidates_.clear();
    const auto offer = [&](std::uint32_t p, std::uint32_t q, bool border, Candidate& best) {
      if (!may_go(p, q, border) || !map_wedges(p, q)) return;
      const float c = cost(p, q);
      const float weight = quadrics_[p].weight;
      if (weight > 0 && quadrics_[p].at(places_[q]) > weight * limit_) return;
      if (std::isfinite(c) && (best.thrown == k_none || c < best.cost)) best = {p, q, c};
    };
    for (const Corners& t : triangles_) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t p = place(t[i]), q = place(t[next_corner(i)]);
        const bool may_be_border = kinds_[p] != Kind::inner && kinds_[q] != Kind::inner;
        const bool border = may_be_border && directed(q, p).count == 0;
        if (p > q && !border) continue;
        Candidate best{k_none, k_none, 0};
        offer(p, q, border, best);
        offer(q, p, border, best);
        if (best.thrown != k_none) candidates_.push_back(best);
      }
    }
    sort_candidates();
  }

  // By cost, equal ones in their order: costs are not negative, so their bits sort as they do.
  void sort_candidates() {
    constexpr std::uint32_t k_bits = 11, k_size = 1u << k_bits;
    scratch_.resize(candidates_.size());
    for (std::uint32_t shift = 0; shift < 33; shift += k_bits) {
      std::array<std::uint32_t, k_size + 1> count{};
      const auto key = [&](const Candidate& c) {
        return (std::bit_cast<std::uint32_t>(c.cost) >> shift) & (k_size - 1);
      };
      for (const Candidate& c : candidates_) ++count[key(c) + 1];
      for (std::uint32_t i = 0; i < k_size; ++i) count[i + 1] += count[i];
      for (const Candidate& c : candidates_) scratch_[count[key(c)]++] = c;
      candidates_.swap(scratch_);
    }
  }

  std::size_t pass(bool all) {
    ++pass_;
    const std::size_t goal =
        std::min(candidates_.size() - 1,
                 static_cast<std::size_t>(k_pass_share * static_cast<double>(candidates_.size())));
    const float limit = all ? std::numeric_limits<float>::infinity() : candidates_[goal].cost * k_pass_slack;
    std::uint64_t left = triangles_.size();
    std::size_t made = 0;
    for (const Candidate& c : candidates_) {
      if (c.cost > limit || left <= options_.min_triangles) break;
      if (touched_[c.thrown] == pass_ || touched_[c.kept] == pass_) continue;
      std::uint32_t gone = 0;
      if (!allowed(c.thrown, c.kept, gone) || !map_wedges(c.thrown, c.kept)) continue;
      apply(c);
      left -= gone;
      ++made;
    }
    for (Corners& t : triangles_)
      for (std::uint32_t& v : t) v = moved_[v];
    return made;
  }

  // Link condition, folds and faces that would be there twice. Neither end has been touched in this pass, so
  // their rings are complete, through moved_.
  bool allowed(std::uint32_t p, std::uint32_t q, std::uint32_t& gone) {
    const std::uint32_t mark = ++mark_;
    for (const std::uint32_t t : ring(q)) {
      for (const std::uint32_t c : triangles_[t]) stamp_[place(moved_[c])] = mark;
    }
    const std::uint32_t seen = ++mark_;
    std::uint32_t shared = 0;
    gone = 0;
    for (const std::uint32_t t : ring(p)) {
      const Corners c{moved_[triangles_[t][0]], moved_[triangles_[t][1]], moved_[triangles_[t][2]]};
      const Corners at{place(c[0]), place(c[1]), place(c[2])};
      if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) continue;
      const bool has_q = at[0] == q || at[1] == q || at[2] == q;
      gone += has_q;
      for (const std::uint32_t x : at) {
        if (x == p || x == q || stamp_[x] == seen) continue;
        shared += stamp_[x] == mark;
        stamp_[x] = seen;
      }
      if (!has_q && folds(at, p, q)) return false;
    }
    return gone > 0 && gone <= 2 && shared == gone && !makes_twice(p, q);
  }

  bool folds(const Corners& at, std::uint32_t p, std::uint32_t q) const {
    Float3 before[3], after[3];
    for (std::size_t i = 0; i < 3; ++i)
      before[i] = places_[at[i]], after[i] = at[i] == p ? places_[q] : before[i];
    const Float3 n = cross(before[1] - before[0], before[2] - before[0]),
                 m = cross(after[1] - after[0], after[2] - after[0]);
    const float product = dot(n, m), squares = dot(n, n) * dot(m, m);
    const auto limit = static_cast<float>(options_.fold_cosine);
    return product <= 0 ? dot(n, n) > 0 : product * product < limit * limit * squares;
  }

  bool makes_twice(std::uint32_t p, std::uint32_t q) const {
    for (const std::uint32_t t : ring(p)) {
      const Corners at{place(moved_[triangles_[t][0]]), place(moved_[triangles_[t][1]]),
                       place(moved_[triangles_[t][2]])};
      if (at[0] == q || at[1] == q || at[2] == q) continue;
      for (const std::uint32_t u : ring(q)) {
        std::uint32_t same = 0;
        bool has_p = false;
        for (const std::uint32_t c : triangles_[u]) {
          const std::uint32_t x = place(moved_[c]);
          has_p = has_p || x == p;
          for (const std::uint32_t y : at) same += y != p && y == x;
        }
        if (same == 2 && !has_p) return true;
      }
    }
    return false;
  }

  void apply(const Candidate& c) {
    for (const CollapsedWedge& m : map_) {
      moved_[m.thrown] = m.kept;
      attribute_quadrics_[m.kept] += attribute_quadrics_[m.thrown];
      out_.wedges.push_back(m);
    }
    const PlaneQuadric& q = quadrics_[c.thrown];
    const double mean = q.weight > 0 ? q.at(places_[c.kept]) / q.weight : 0;
    out_.errors.push_back(static_cast<float>(std::sqrt(mean) * size_));
    out_.first.push_back(static_cast<std::uint32_t>(out_.wedges.size()));
    quadrics_[c.kept] += q;
    touched_[c.thrown] = touched_[c.kept] = pass_;
  }

  const PartTriangles& mesh_;
  const EdgeCollapseOptions& options_;
  double size_ = 1;
  float limit_ = static_cast<float>(options_.max_error * options_.max_error);
  std::vector<Corners> triangles_;
  std::vector<Float3> places_;
  std::vector<std::uint32_t> wedge_, next_wedge_;
  std::vector<Attributes> attributes_;
  std::vector<PlaneQuadric> quadrics_;
  std::vector<AttributeQuadric> attribute_quadrics_;
  std::vector<Kind> kinds_;
  std::vector<std::uint32_t> ring_first_, ring_, fill_, moved_, stamp_, touched_;
  std::vector<CollapsedWedge> map_;
  std::vector<std::uint32_t> loose_;
  std::vector<Candidate> candidates_, scratch_;
  std::uint32_t mark_ = 0, pass_ = 0;
  EdgeCollapses out_;
};

}  // namespace

EdgeCollapses collapse_edges(const PartTriangles& mesh, const EdgeCollapseOptions& options) {
  if (mesh.triangles.empty()) return {};
  return Collapser(mesh, options).run();
}

CollapsedState collapsed_state(const PartTriangles& mesh, const EdgeCollapses& collapses, std::size_t count) {
  std::vector<std::uint32_t> moved(mesh.vertices.size());
  for (std::uint32_t v = 0; v < moved.size(); ++v) moved[v] = v;
  // Backwards: when a vertex is thrown, where its keeper ends is known already.
  for (std::size_t i = collapses.first[count]; i-- > 0;)
    moved[collapses.wedges[i].thrown] = moved[collapses.wedges[i].kept];
  CollapsedState state;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corners& c = mesh.triangles[t];
    const Corners now{moved[c[0]], moved[c[1]], moved[c[2]]};
    const std::uint32_t a = mesh.position_of[now[0]], b = mesh.position_of[now[1]],
                        d = mesh.position_of[now[2]];
    if (a == b || b == d || d == a) continue;
    state.triangles.push_back(now);
    state.source.push_back(t);
  }
  return state;
}

Spectrum edge_spectrum(const PartTriangles& mesh, const EdgeCollapses& collapses,
                       std::span<const std::uint32_t> radius_of) {
  SpectrumBuilder builder(LodMethod::edges);
  for (const SpectrumVertex& v : mesh.vertices) builder.vertex(v);
  std::vector<Corners> now = mesh.triangles;
  std::vector<std::uint32_t> element(now.size());
  // The triangles of every vertex, as chains through corners; a collapse hangs one chain behind another.
  std::vector<std::uint32_t> head(mesh.vertices.size(), k_none), tail(mesh.vertices.size(), k_none),
      next(3 * now.size(), k_none);
  const auto radius = [&](std::uint32_t t) { return radius_of.empty() ? k_none : radius_of[t]; };
  const auto degenerate = [&](const Corners& t) {
    const std::uint32_t a = mesh.position_of[t[0]], b = mesh.position_of[t[1]], c = mesh.position_of[t[2]];
    return a == b || b == c || c == a;
  };
  for (std::uint32_t t = 0; t < now.size(); ++t) {
    element[t] = builder.element(mesh.materials[t], radius(t), std::span(&now[t], 1));
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t v = now[t][c], at = 3 * t + c;
      (head[v] == k_none ? head[v] : next[tail[v]]) = at;
      tail[v] = at;
    }
  }
  double error = 0;
  for (std::size_t i = 0; i < collapses.size(); ++i) {
    error = std::max(error, static_cast<double>(collapses.errors[i]));
    builder.step(error);
    if (i == 0) {
      for (std::uint32_t t = 0; t < now.size(); ++t)
        if (degenerate(now[t])) builder.remove(element[t]), element[t] = k_none;
    }
    for (std::uint32_t w = collapses.first[i]; w < collapses.first[i + 1]; ++w) {
      const auto [thrown, kept] = collapses.wedges[w];
      for (std::uint32_t at = head[thrown]; at != k_none; at = next[at]) {
        const std::uint32_t t = at / 3;
        now[t][at % 3] = kept;
        if (element[t] == k_none) continue;
        builder.remove(element[t]);
        element[t] = degenerate(now[t])
                         ? k_none
                         : builder.element(mesh.materials[t], radius(t), std::span(&now[t], 1));
      }
      if (head[thrown] == k_none) continue;
      (head[kept] == k_none ? head[kept] : next[tail[kept]]) = head[thrown];
      tail[kept] = tail[thrown];
    }
  }
  return builder.finish();
}

}  // namespace copse
