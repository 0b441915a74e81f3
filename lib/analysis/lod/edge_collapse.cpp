#include "lib/analysis/lod/edge_collapse.h"

#include "lib/analysis/lod/edge_quadric.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace copse {
namespace {

// What is at the corners of a triangle; the fourth number is not used.
using Corners = std::array<std::uint32_t, 4>;
using Attributes = std::array<float, k_attributes>;

constexpr float k_border_weight = 10;  // of a plane across a border or a seam
constexpr float k_infinity = std::numeric_limits<float>::infinity();
constexpr double k_pass_share = 0.4;  // of the vertices that a pass goes through, cheapest first
constexpr double k_few = 0.02;        // a pass that makes fewer of them go is followed by one that tries more
constexpr float k_pass_slack = 1.5f;  // beyond the cost of the last of them

enum class Kind : std::uint8_t { inner, border, seam, fixed };

// The corner that follows and the one before in the same triangle; corners are 4 * triangle + place in it.
std::uint32_t next_corner(std::uint32_t c) {
  return (c & 3) == 2 ? c - 2 : c + 1;
}
std::uint32_t previous_corner(std::uint32_t c) {
  return (c & 3) == 0 ? c + 2 : c - 1;
}

// A corner as the vertex that is there sees it.
struct Around {
  std::uint32_t corner = 0;
  std::uint32_t next = 0, previous = 0;  // the positions at the two other corners
  std::uint32_t next_node = 0;
};

struct Candidate {
  std::uint32_t thrown = k_none, kept = k_none;  // positions
  float cost = 0;
};

// All vertices of a position with the same texture coordinate: one value of the attributes, their normals'
// mean.
struct Node {
  Float3 place;
  Attributes attributes{};
};

class Collapser {
 public:
  Collapser(const PartTriangles& mesh, const EdgeCollapseOptions& options) : mesh_(mesh), options_(options) {
    number_positions();
    number_nodes();
    place_triangles();
    build_rings();
    find_opposites();
    classify();
    add_quadrics();
    opposite_ = {};
  }

  EdgeCollapses run() {
    double share = k_pass_share;
    while (triangles_.size() > options_.min_triangles) {
      collect();
      const std::size_t made = candidates_.empty() ? 0 : pass(share);
      if (made == 0 && (share >= 1 || candidates_.empty())) break;
      const bool few = static_cast<double>(made) < k_few * static_cast<double>(candidates_.size());
      share = few ? std::min(1.0, 2 * share) : k_pass_share;
      drop_degenerate();
      build_rings();
    }
    out_.triangles = triangles_.size();
    return std::move(out_);
  }

 private:
  // ---- the mesh: positions, nodes (what is one in texture), wedges (the mesh's vertices)

  // One number for every place; coordinates in a unit box.
  void number_positions() {
    std::uint32_t count = 0;
    for (const std::uint32_t p : mesh_.position_of) count = std::max(count, p + 1);
    places_.resize(count), wedge_.assign(count, k_none), next_wedge_.assign(mesh_.vertices.size(), k_none);
    DoubleBox box;
    for (const SpectrumVertex& v : mesh_.vertices) box.grow(to_double(v.position));
    size_ = box.empty() ? 1 : std::max(length(box.extent()), 1e-300);
    const Double3 low = box.empty() ? Double3{} : box.min;
    for (auto v = static_cast<std::uint32_t>(mesh_.vertices.size()); v-- > 0;) {
      const std::uint32_t p = place(v);
      places_[p] = to_float((to_double(mesh_.vertices[v].position) - low) / size_);
      next_wedge_[v] = wedge_[p], wedge_[p] = v;
    }
    quadrics_.resize(count);
    kinds_.assign(count, Kind::inner), stamp_.assign(count, 0), touched_.assign(count, 0);
    stale_.assign(count, 1), refused_.assign(count, 0), best_.resize(count);
  }

  void number_nodes() {
    Float2 low{}, high{};
    for (const SpectrumVertex& v : mesh_.vertices) {
      low = {std::min(low.x, v.texcoord.x), std::min(low.y, v.texcoord.y)};
      high = {std::max(high.x, v.texcoord.x), std::max(high.y, v.texcoord.y)};
    }
    const float weight = static_cast<float>(options_.attribute_weight) * 0.1f,
                repeats = std::max({1.0f, high.x - low.x, high.y - low.y});
    node_of_.resize(mesh_.vertices.size());
    first_node_.assign(1, 0);
    for (std::uint32_t p = 0; p < places_.size(); ++p) {
      for (std::uint32_t v = wedge_[p]; v != k_none; v = next_wedge_[v]) {
        std::uint32_t like = wedge_[p];
        while (!same_texcoord(like, v)) like = next_wedge_[like];
        const SpectrumVertex& x = mesh_.vertices[v];
        if (like == v) {
          node_of_[v] = static_cast<std::uint32_t>(nodes_.size());
          nodes_.push_back(
              {places_[p],
               {0, 0, 0, weight * x.texcoord.x / repeats * 4, weight * x.texcoord.y / repeats * 4}});
        } else {
          node_of_[v] = node_of_[like];
        }
        Attributes& a = nodes_[node_of_[v]].attributes;
        a[0] += x.normal.x, a[1] += x.normal.y, a[2] += x.normal.z;
      }
      for (std::size_t n = first_node_.back(); n < nodes_.size(); ++n) {
        Attributes& a = nodes_[n].attributes;
        const Float3 normal = to_float(normalized(to_double({a[0], a[1], a[2]})));
        a[0] = weight * normal.x, a[1] = weight * normal.y, a[2] = weight * normal.z;
      }
      first_node_.push_back(static_cast<std::uint32_t>(nodes_.size()));
    }
    node_quadrics_.resize(nodes_.size());
  }

  std::uint32_t place(std::uint32_t vertex) const { return mesh_.position_of[vertex]; }
  std::uint32_t node_count(std::uint32_t p) const { return first_node_[p + 1] - first_node_[p]; }
  bool same_texcoord(std::uint32_t a, std::uint32_t b) const {
    return mesh_.vertices[a].texcoord == mesh_.vertices[b].texcoord;
  }

  void place_triangles() {
    wedges_.reserve(mesh_.triangles.size());
    for (const auto& t : mesh_.triangles) wedges_.push_back({t[0], t[1], t[2], 0});
    triangles_.resize(wedges_.size()), corner_nodes_.resize(wedges_.size());
    wedge_now_.resize(mesh_.vertices.size()), node_now_.resize(nodes_.size());
    std::iota(wedge_now_.begin(), wedge_now_.end(), 0);
    std::iota(node_now_.begin(), node_now_.end(), 0);
    drop_degenerate();
  }

  static bool degenerate(const Corners& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }
  // What went in a pass is known by wedge and node; the triangles are told at its end, in their order.
  void drop_degenerate() {
    std::size_t n = 0;
    for (const Corners& t : wedges_) {
      Corners wedges{}, places{}, nodes{};
      for (std::size_t i = 0; i < 3; ++i)
        wedges[i] = wedge_now_[t[i]], places[i] = place(wedges[i]), nodes[i] = node_of_[wedges[i]];
      if (!degenerate(places)) triangles_[n] = places, corner_nodes_[n] = nodes, wedges_[n] = wedges, ++n;
    }
    triangles_.resize(n), wedges_.resize(n), corner_nodes_.resize(n);
  }

  // The corners at every position, in order. In a pass they are kept as they are, but for what the kept end
  // of a collapse gains: it is not looked at again in the same pass.
  void build_rings() {
    ring_first_.assign(places_.size() + 1, 0);
    for (const Corners& t : triangles_)
      for (std::size_t i = 0; i < 3; ++i) ++ring_first_[t[i] + 1];
    for (std::size_t p = 0; p < places_.size(); ++p) ring_first_[p + 1] += ring_first_[p];
    ring_.resize(3 * triangles_.size());
    fill_.assign(ring_first_.begin(), ring_first_.end() - 1);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const Corners &at = triangles_[t], &nodes = corner_nodes_[t];
      ring_[fill_[at[0]]++] = {4 * t, at[1], at[2], nodes[1]};
      ring_[fill_[at[1]]++] = {4 * t + 1, at[2], at[0], nodes[2]};
      ring_[fill_[at[2]]++] = {4 * t + 2, at[0], at[1], nodes[0]};
    }
  }
  std::span<const Around> ring(std::uint32_t p) const {
    return {ring_.data() + ring_first_[p], ring_.data() + ring_first_[p + 1]};
  }
  std::span<Around> ring(std::uint32_t p) {
    return {ring_.data() + ring_first_[p], ring_.data() + ring_first_[p + 1]};
  }
  std::uint32_t at(std::uint32_t corner) const { return triangles_[corner >> 2][corner & 3]; }
  std::uint32_t wedge_at(std::uint32_t corner) const { return wedge_now_[wedges_[corner >> 2][corner & 3]]; }
  std::uint32_t node_at(std::uint32_t corner) const {
    return node_now_[corner_nodes_[corner >> 2][corner & 3]];
  }

  // ---- what kind of vertex each is

  // Of every edge from a corner to the next one: the corner where the edge back begins.
  void find_opposites() {
    opposite_.assign(4 * triangles_.size(), k_none), broken_.assign(places_.size(), 0);
    for (std::uint32_t c = 0; c < opposite_.size(); ++c) {
      if ((c & 3) == 3) continue;
      const std::uint32_t p = at(c), q = at(next_corner(c));
      std::uint32_t same = 0, back = 0;
      for (const Around& d : ring(p)) same += d.next == q;
      for (const Around& d : ring(q)) {
        if (d.next != p) continue;
        opposite_[c] = d.corner, ++back;
      }
      if (same > 1 || back > 1) broken_[p] = broken_[q] = 1;
    }
  }
  // Whether the edge from this corner to the next one is a seam of the texture.
  bool seam(std::uint32_t corner) const {
    const std::uint32_t back = opposite_[corner];
    return back != k_none &&
           !(node_at(next_corner(back)) == node_at(corner) && node_at(back) == node_at(next_corner(corner)));
  }

  void classify() {
    for (std::uint32_t p = 0; p < places_.size(); ++p) {
      std::uint32_t borders = 0, seams = 0;
      for (const auto& [c, next, previous, node] : ring(p)) {
        borders += opposite_[c] == k_none;
        borders += opposite_[previous_corner(c)] == k_none;
        seams += seam(c);
      }
      const bool fixed = broken_[p] != 0 || borders > 2 || borders == 1 || (borders > 0 && seams > 0) ||
                         (seams != 0 && seams != 2) || !one_fan(p);
      kinds_[p] = fixed ? Kind::fixed : borders == 2 ? Kind::border : seams == 2 ? Kind::seam : Kind::inner;
    }
  }

  // Whether the triangles round p hang together by edges at p; p is not broken.
  bool one_fan(std::uint32_t p) const {
    const auto all = ring(p);
    if (all.empty()) return true;
    const auto open =
        std::find_if(all.begin(), all.end(), [&](const Around& c) { return opposite_[c.corner] == k_none; });
    const std::uint32_t start = (open == all.end() ? all.front() : *open).corner;
    std::size_t reached = 1;
    for (std::uint32_t c = opposite_[previous_corner(start)];
         c != k_none && c != start && reached < all.size(); c = opposite_[previous_corner(c)])
      ++reached;
    return reached == all.size();
  }

  // ---- quadrics

  void add_quadrics() {
    for (std::uint32_t first = 0; first < opposite_.size(); first += 4) {
      const Corners& t = triangles_[first >> 2];
      const Float3 a = places_[t[0]];
      const Double3 e0 = to_double(places_[t[1]]) - to_double(a),
                    e1 = to_double(places_[t[2]]) - to_double(a), n = cross(e0, e1);
      const double twice = length(n);
      if (!(twice > 0)) continue;
      const Float3 unit = to_float(n / twice);
      const auto area = static_cast<float>(0.5 * twice);
      PlaneQuadric q;
      q.add_plane(unit, -dot(unit, a), area);
      for (std::size_t i = 0; i < 3; ++i) quadrics_[t[i]] += q;
      add_gradients(first, a, e0, e1, n / (twice * twice), area);
      for (std::uint32_t c = first; c < first + 3; ++c)
        if (opposite_[c] == k_none || seam(c)) add_fence(c, n);
    }
  }

  // The plane across a border or a seam.
  void add_fence(std::uint32_t corner, const Double3& face) {
    const std::uint32_t p = at(corner), r = at(next_corner(corner));
    const Double3 along = to_double(places_[r]) - to_double(places_[p]);
    const double l = length(along);
    if (!(l > 0)) return;
    const Float3 across = to_float(normalized(cross(along, face), {0, 0, 0}));
    PlaneQuadric plane;
    plane.add_plane(across, -dot(across, places_[p]),
                    static_cast<float>(l * l) * (opposite_[corner] == k_none ? k_border_weight : 1.0f));
    plane.weight = 0;
    quadrics_[p] += plane, quadrics_[r] += plane;
  }

  // The gradient of every attribute over a face: a = g . p + d.
  void add_gradients(std::uint32_t first, const Float3& origin, const Double3& e0, const Double3& e1,
                     const Double3& n, float area) {
    const std::uint32_t at[3] = {node_at(first), node_at(first + 1), node_at(first + 2)};
    const Double3 g0 = cross(e1, n), g1 = cross(n, e0);
    std::array<std::array<float, k_attributes>, 4> gradient;
    for (std::size_t k = 0; k < k_attributes; ++k) {
      const double a0 = nodes_[at[0]].attributes[k], d1 = nodes_[at[1]].attributes[k] - a0,
                   d2 = nodes_[at[2]].attributes[k] - a0;
      const Double3 g = g0 * d1 + g1 * d2;
      gradient[0][k] = static_cast<float>(g.x), gradient[1][k] = static_cast<float>(g.y),
      gradient[2][k] = static_cast<float>(g.z);
      gradient[3][k] = static_cast<float>(a0 - dot(g, to_double(origin)));
    }
    AttributeQuadric q;
    q.set(gradient, area);
    for (const std::uint32_t v : at) node_quadrics_[v] += q;
  }

  // ---- what collapses where

  float most_error(const PlaneQuadric& planes) const {
    return planes.weight > 0 ? planes.weight * limit_ : k_infinity;
  }

  // What it costs to go to a node, infinity when that errs too much.
  float way(const PlaneQuadric& planes, std::uint32_t from, std::uint32_t to, float most) const {
    const Node& target = nodes_[to];
    const float base = planes.at(target.place);
    if (!(base <= most)) return k_infinity;
    return base + node_quadrics_[from].at(target.place, target.attributes);
  }

  // Calls offer(q, cost) for every q onto which p may collapse; costs above the bound need not be told.
  template <class Offer>
  void choices(std::uint32_t p, const float& bound, Offer offer) {
    const PlaneQuadric& planes = quadrics_[p];
    const float most = most_error(planes);
    const std::uint32_t node = first_node_[p];
    const auto weigh = [&](std::uint32_t q, std::uint32_t to) {
      const float cost = way(planes, node, to, std::min(most, bound));
      if (std::isfinite(cost)) offer(q, cost);
    };
    if (kinds_[p] == Kind::inner && node_count(p) == 1) {
      for (const Around& c : ring(p)) weigh(c.next, c.next_node);
    } else if (kinds_[p] == Kind::border && node_count(p) == 1) {
      for (const Around& c : ring(p)) {
        if (shared_faces(p, c.next) == 1) weigh(c.next, c.next_node);
        if (shared_faces(p, c.previous) == 1) weigh(c.previous, node_at(previous_corner(c.corner)));
      }
    } else if (kinds_[p] == Kind::seam || kinds_[p] == Kind::inner || kinds_[p] == Kind::border) {
      seam_choices(p, most, bound, offer);
    }
  }
  std::uint32_t shared_faces(std::uint32_t p, std::uint32_t q) const {
    std::uint32_t faces = 0;
    for (const Around& c : ring(p)) faces += c.next == q || c.previous == q;
    return faces;
  }

  // All nodes of p go, each along an edge of its own triangles.
  template <class Offer>
  void seam_choices(std::uint32_t p, float most, const float& bound, Offer offer) {
    const std::uint32_t used = find_own_nodes(p);
    for (const Around& c : ring(p)) {
      const std::uint32_t q = c.next;
      if (kinds_[q] != Kind::seam && kinds_[q] != Kind::fixed) continue;
      float cost = quadrics_[p].at(places_[q]);
      if (!(cost <= std::min(most, bound))) continue;
      std::uint32_t mapped = 0;
      bool sound = true;
      for (std::uint32_t n = first_node_[p]; n < first_node_[p + 1] && sound; ++n) {
        const std::uint32_t to = node_along(p, q, n, sound);
        if (to == k_none) continue;
        cost += node_quadrics_[n].at(places_[q], nodes_[to].attributes);
        ++mapped;
      }
      if (sound && mapped == used && std::isfinite(cost)) offer(q, cost);
    }
  }
  // The node of p itself in each of its triangles. How many there are.
  std::uint32_t find_own_nodes(std::uint32_t p) {
    own_nodes_.clear();
    for (const Around& a : ring(p)) own_nodes_.push_back(node_at(a.corner));
    std::uint32_t used = 0;
    for (std::uint32_t n = first_node_[p]; n < first_node_[p + 1]; ++n)
      used += std::find(own_nodes_.begin(), own_nodes_.end(), n) != own_nodes_.end();
    return used;
  }
  // The node of q that the triangles with an edge from node n of p to q have; not sound: two of them.
  std::uint32_t node_along(std::uint32_t p, std::uint32_t q, std::uint32_t n, bool& sound) const {
    std::uint32_t to = k_none;
    const auto follow = [&](std::uint32_t node) {
      if (to != k_none && to != node) sound = false;
      to = node;
    };
    const auto around = ring(p);
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (own_nodes_[i] != n) continue;
      if (around[i].next == q) follow(around[i].next_node);
      if (around[i].previous == q) follow(node_at(previous_corner(around[i].corner)));
    }
    return to;
  }

  Candidate cheapest(std::uint32_t p) {
    Candidate best{k_none, k_none, k_infinity};
    choices(p, best.cost, [&](std::uint32_t q, float cost) {
      if (best.thrown == k_none || cost < best.cost || (cost == best.cost && q < best.kept))
        best = {p, q, cost};
    });
    return best;
  }

  // The best way of every vertex that is left. What nothing has changed round since it was looked at still
  // has its last one, or none that is allowed.
  void collect() {
    candidates_.clear();
    for (std::uint32_t p = 0; p < places_.size(); ++p) {
      if (kinds_[p] == Kind::fixed || ring(p).empty()) continue;
      if (stale_[p]) best_[p] = cheapest(p), stale_[p] = refused_[p] = 0;
      if (best_[p].thrown != k_none) candidates_.push_back(best_[p]);
    }
    sort_candidates();
  }

  // By cost, in steps of a half: what costs about the same goes in the order of the mesh. Costs are not
  // negative, so their bits sort as they do.
  void sort_candidates() {
    constexpr std::uint32_t k_shift = 22, k_size = 1u << (32 - k_shift);
    const auto key = [](const Candidate& c) { return std::bit_cast<std::uint32_t>(c.cost) >> k_shift; };
    std::array<std::uint32_t, k_size + 1> first{};
    for (const Candidate& c : candidates_) ++first[key(c) + 1];
    for (std::uint32_t i = 0; i < k_size; ++i) first[i + 1] += first[i];
    scratch_.resize(candidates_.size());
    for (const Candidate& c : candidates_) scratch_[first[key(c)]++] = c;
    candidates_.swap(scratch_);
  }

  std::size_t pass(double share) {
    ++pass_;
    const auto goal = static_cast<std::size_t>(share * static_cast<double>(candidates_.size()));
    const float limit = goal + 1 >= candidates_.size() ? k_infinity : candidates_[goal].cost * k_pass_slack;
    std::uint64_t left = triangles_.size();
    std::size_t made = 0;
    for (const Candidate& c : candidates_) {
      if (left <= options_.min_triangles) break;
      if (c.cost > limit || touched(c)) continue;
      std::uint32_t gone = attempt(c);
      if (gone == 0) gone = detour(c, limit);
      left -= gone;
      made += gone > 0;
    }
    return made;
  }
  bool touched(const Candidate& c) const { return touched_[c.thrown] == pass_ || touched_[c.kept] == pass_; }

  // Makes a collapse if it is allowed. How many triangles go: 0 when it is refused.
  std::uint32_t attempt(const Candidate& c) {
    std::uint32_t gone = 0;
    if (!allowed(c.thrown, c.kept, gone) || !map_wedges(c.thrown, c.kept)) return 0;
    apply(c);
    return gone;
  }

  // The further ways of a vertex whose best one is refused, the cheapest first.
  std::uint32_t detour(const Candidate& refused, float limit) {
    const std::uint32_t p = refused.thrown;
    ways_.clear();
    choices(p, k_infinity, [&](std::uint32_t q, float cost) { ways_.push_back({p, q, cost}); });
    const auto before = [](const Candidate& a, const Candidate& b) {
      return a.cost != b.cost ? a.cost < b.cost : a.kept < b.kept;
    };
    std::sort(ways_.begin(), ways_.end(), before);
    best_[p] = {}, refused_[p] = 1;
    for (const Candidate& c : ways_) {
      if (!before(refused, c)) continue;
      if (c.cost > limit || touched(c)) {
        best_[p] = c;
        return 0;
      }
      if (const std::uint32_t gone = attempt(c); gone > 0) return gone;
    }
    return 0;
  }

  // Link condition, folds and faces that would be there twice. Neither end has been touched in this pass, so
  // their rings are complete.
  bool allowed(std::uint32_t p, std::uint32_t q, std::uint32_t& gone) {
    gone = 0;
    for (const Around& c : ring(p)) gone += c.next != c.previous && (c.next == q || c.previous == q);
    if (gone == 0 || gone > 2 || shared_neighbours(p, q) != gone) return false;
    for (const auto& [c, x, y, node] : ring(p))
      if (x != y && x != q && y != q && folds(p, x, y, q)) return false;
    return gone < 2 || !makes_twice(p, q);
  }
  // Whether every neighbour of p is the next one in one of its triangles.
  bool closed(std::uint32_t p) const { return kinds_[p] == Kind::inner || kinds_[p] == Kind::seam; }
  std::uint32_t shared_neighbours(std::uint32_t p, std::uint32_t q) {
    const std::uint32_t mark = ++mark_, seen = ++mark_;
    for (const Around& c : ring(q)) stamp_[c.next] = mark;
    if (!closed(q))
      for (const Around& c : ring(q)) stamp_[c.previous] = mark;
    std::uint32_t shared = 0;
    const auto count = [&](std::uint32_t z) {
      if (z == q || z == p || stamp_[z] != mark) return;
      ++shared;
      stamp_[z] = seen;
    };
    for (const Around& c : ring(p)) count(c.next);
    if (!closed(p))
      for (const Around& c : ring(p)) count(c.previous);
    return shared;
  }

  // Whether the triangle p x y turns over when p goes to q.
  bool folds(std::uint32_t p, std::uint32_t x, std::uint32_t y, std::uint32_t q) const {
    const Float3 a = places_[p], b = places_[x], c = places_[y], to = places_[q];
    const Float3 n = cross(b - a, c - a), m = cross(b - to, c - to);
    const float product = dot(n, m), squares = dot(n, n) * dot(m, m);
    const auto limit = static_cast<float>(options_.fold_cosine);
    return product <= 0 ? dot(n, n) > 0 : product * product < limit * limit * squares;
  }

  // The faces of p whose other corners are neighbours of q: the two that the link condition lets through.
  bool makes_twice(std::uint32_t p, std::uint32_t q) const {
    std::uint32_t apex[2] = {k_none, k_none}, n = 0;
    for (const auto& [c, x, y, node] : ring(p)) {
      if (x == y || n == 2 || (x != q && y != q)) continue;
      apex[n++] = x == q ? y : x;
    }
    const auto has_face = [&](std::uint32_t v) {
      return std::any_of(ring(v).begin(), ring(v).end(), [&](const Around& c) {
        return (c.next == apex[0] && c.previous == apex[1]) || (c.next == apex[1] && c.previous == apex[0]);
      });
    };
    return has_face(p) && has_face(q);
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
    for (const Around& a : ring(p)) {
      const std::uint32_t own = wedge_at(a.corner);
      bool along = false;
      for (const std::uint32_t d : {next_corner(a.corner), previous_corner(a.corner)}) {
        if ((d == next_corner(a.corner) ? a.next : a.previous) != q) continue;
        along = true;
        const auto same =
            std::find_if(map_.begin(), map_.end(), [&](const CollapsedWedge& m) { return m.thrown == own; });
        if (same == map_.end()) {
          map_.push_back({own, wedge_at(d)});
        } else if (node_of_[same->kept] != node_at(d)) {
          return false;
        }
      }
      if (!along) loose_.push_back(own);
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
      if (node_of_[map_[i].thrown] != node_of_[v]) continue;
      for (std::uint32_t w = wedge_[q]; w != k_none; w = next_wedge_[w]) {
        if (node_of_[w] != node_of_[map_[i].kept]) continue;
        const float alike = dot(mesh_.vertices[w].normal, mesh_.vertices[v].normal);
        if (alike > nearest) nearest = alike, best = w;
      }
    }
    return best;
  }

  void apply(const Candidate& c) {
    for (std::size_t i = 0; i < map_.size(); ++i) {
      const std::uint32_t from = node_of_[map_[i].thrown], to = node_of_[map_[i].kept];
      const bool added = std::any_of(map_.begin(), map_.begin() + static_cast<std::ptrdiff_t>(i),
                                     [&](const CollapsedWedge& m) { return node_of_[m.thrown] == from; });
      if (!added) node_quadrics_[to] += node_quadrics_[from];
      wedge_now_[map_[i].thrown] = map_[i].kept, node_now_[from] = to;
      out_.wedges.push_back(map_[i]);
    }
    // What lies round the kept one alone goes where it did for what it did, but what was refused may be
    // allowed.
    for (const Around& a : ring(c.kept)) {
      stale_[a.next] |= refused_[a.next];
      stale_[a.previous] |= refused_[a.previous];
    }
    for (const Around& a : ring(c.thrown)) {
      stale_[a.next] = stale_[a.previous] = 1;
      for (Around& b : ring(a.next))
        if (b.previous == c.thrown) b.previous = c.kept;
      for (Around& b : ring(a.previous))
        if (b.next == c.thrown) b.next = c.kept, b.next_node = node_now_[b.next_node];
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
  std::vector<Corners> triangles_, wedges_, corner_nodes_;  // of what is left: positions, wedges, nodes
  std::vector<Float3> places_;
  std::vector<std::uint32_t> wedge_, next_wedge_;    // of each position a chain
  std::vector<std::uint32_t> node_of_;               // of each wedge
  std::vector<std::uint32_t> wedge_now_, node_now_;  // where it went in this pass; itself if it is there
  std::vector<std::uint32_t> first_node_;            // of each position, and the end
  std::vector<Node> nodes_;
  std::vector<PlaneQuadric> quadrics_;  // of positions
  std::vector<AttributeQuadric> node_quadrics_;
  std::vector<Kind> kinds_;
  std::vector<std::uint8_t> broken_, stale_, refused_;
  std::vector<Candidate> best_;  // of each position
  std::vector<std::uint32_t> opposite_;
  std::vector<Around> ring_;  // in the order of positions
  std::vector<std::uint32_t> ring_first_, fill_, stamp_, touched_;
  std::vector<CollapsedWedge> map_;
  std::vector<std::uint32_t> loose_, own_nodes_;
  std::vector<Candidate> candidates_, scratch_, ways_;
  std::uint32_t mark_ = 0, pass_ = 0;
  EdgeCollapses out_;
};

}  // namespace

EdgeCollapses collapse_edges(const PartTriangles& mesh, const EdgeCollapseOptions& options) {
  if (mesh.triangles.empty()) return {};
  return Collapser(mesh, options).run();
}

}  // namespace copse
