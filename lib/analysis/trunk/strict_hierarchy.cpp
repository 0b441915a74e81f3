#include "lib/analysis/trunk/strict_hierarchy.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <array>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

// The trunk over the model's own vertices: the welded ones, in their order.
class StrictReader {
 public:
  StrictReader(const StrictModel& model, const Mesh& mesh, std::span<const std::uint32_t> welded)
      : model_(model), source_(mesh), welded_(welded), id_(mesh.positions.size(), k_none) {}

  StrictTrunk run(std::span<const std::uint32_t> leaf_of) {
    take_vertices();
    take_triangles(leaf_of);
    order_rings();
    measure();
    store_radii();
    name_segments();
    return std::move(out_);
  }

 private:
  std::size_t radii() const { return model_.parent.size(); }
  std::span<const std::uint32_t> ring(std::uint32_t r) const {
    return std::span(ring_vertices_)
        .subspan(model_.first_vertex[r], model_.first_vertex[r + 1] - model_.first_vertex[r]);
  }

  void take_vertices() {
    Indices used = model_.vertices;
    std::ranges::sort(used);
    for (const std::uint32_t v : used) {
      id_[v] = static_cast<std::uint32_t>(out_.mesh.positions.size());
      out_.mesh.positions.push_back(source_.positions[v]);
    }
    ring_of_.assign(used.size(), k_none);
    for (std::uint32_t r = 0; r < radii(); ++r) {
      for (std::uint32_t i = model_.first_vertex[r]; i < model_.first_vertex[r + 1]; ++i) {
        ring_vertices_.push_back(id_[model_.vertices[i]]);
        ring_of_[ring_vertices_.back()] = r;
      }
    }
  }

  void take_triangles(std::span<const std::uint32_t> leaf_of) {
    std::vector<Triangle> as_stored;
    for (std::uint32_t t = 0; t < source_.triangles.size(); ++t) {
      const Triangle& m = source_.triangles[t];
      const Triangle w{welded_[m[0]], welded_[m[1]], welded_[m[2]]};
      if (leaf_of[t] != k_none || w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
      out_.mesh.triangles.push_back({id_[w[0]], id_[w[1]], id_[w[2]]});
      out_.mesh.source.push_back(t);
      as_stored.push_back(m);
    }
    out_.mesh.piece = connected_components(as_stored).of;
  }

  // Round each ring along the sides that its bands have in it; a ring that these do not close stays in the
  // order of its vertices.
  void order_rings() {
    std::vector<std::array<std::uint32_t, 2>> beside(ring_of_.size(), {k_none, k_none});
    Indices sides(ring_of_.size(), 0);
    const auto join = [&](std::uint32_t v, std::uint32_t w) {
      if (beside[v][0] == w || beside[v][1] == w) return;
      if (sides[v] < 2) beside[v][sides[v]] = w;
      ++sides[v];
    };
    for (const Triangle& t : out_.mesh.triangles) {
      for (int e = 0; e < 3; ++e) {
        const std::uint32_t a = t[e], b = t[(e + 1) % 3], c = t[(e + 2) % 3];
        if (ring_of_[a] == ring_of_[b] && ring_of_[c] != ring_of_[a]) join(a, b), join(b, a);
      }
    }
    for (std::uint32_t r = 0; r < radii(); ++r) walk_round(ring(r), beside, sides);
  }

  void walk_round(std::span<const std::uint32_t> vertices,
                  std::span<const std::array<std::uint32_t, 2>> beside,
                  std::span<const std::uint32_t> sides) {
    if (vertices.size() < 3 || std::ranges::any_of(vertices, [&](auto v) { return sides[v] != 2; })) return;
    Indices round{vertices.front()};
    std::uint32_t before = k_none;
    for (std::uint32_t at = vertices.front(); round.size() <= vertices.size();) {
      const std::array<std::uint32_t, 2>& next = beside[at];
      const std::uint32_t to = before == k_none    ? std::min(next[0], next[1])
                               : next[0] == before ? next[1]
                                                   : next[0];
      before = at, at = to;
      if (at == vertices.front()) break;
      round.push_back(at);
    }
    if (round.size() != vertices.size()) return;
    std::ranges::copy(round, ring_vertices_.begin() + (vertices.data() - ring_vertices_.data()));
  }

  void measure() {
    for (std::uint32_t r = 0; r < radii(); ++r) {
      const auto vertices = ring(r);
      const auto k = static_cast<double>(vertices.size());
      Double3 sum;
      for (const std::uint32_t v : vertices) sum = sum + out_.mesh.positions[v];
      const Double3 centre = sum / k;
      double away = 0;
      for (const std::uint32_t v : vertices) away += distance(out_.mesh.positions[v], centre);
      centre_.push_back(centre);
      diameter_.push_back(2 * away / k);
    }
  }

  void store_radii() {
    std::vector<Indices> children(radii());
    Indices todo;
    for (std::uint32_t r = 0; r < radii(); ++r) {
      if (model_.parent[r] != k_none) children[model_.parent[r]].push_back(r);
    }
    stored_.assign(radii(), k_none);
    for (std::uint32_t root = 0; root < radii(); ++root) {
      if (model_.parent[root] != k_none) continue;
      todo.push_back(root);
      while (!todo.empty()) {
        const std::uint32_t r = todo.back();
        todo.pop_back();
        Indices& below = children[r];
        std::ranges::stable_sort(
            below, [&](std::uint32_t a, std::uint32_t b) { return diameter_[a] > diameter_[b]; });
        store(r, model_.parent[r] != k_none && children[model_.parent[r]].front() == r);
        todo.insert(todo.end(), below.rbegin(), below.rend());
      }
    }
    for (const Indices& below : children) first_child_.push_back(below.empty() ? k_none : below.front());
  }

  void store(std::uint32_t r, bool continues) {
    Hierarchy& h = out_.hierarchy;
    stored_[r] = static_cast<std::uint32_t>(h.radii.size());
    RadiusNode& node = h.radii.emplace_back();
    node.centre = centre_[r], node.diameter = diameter_[r];
    if (model_.parent[r] != k_none) node.parent = stored_[model_.parent[r]];
    node.branch = continues ? h.radii[node.parent].branch : branches_++;
    const auto vertices = ring(r);
    h.ring_vertices.insert(h.ring_vertices.end(), vertices.begin(), vertices.end());
    h.first_vertex.push_back(static_cast<std::uint32_t>(h.ring_vertices.size()));
  }

  void name_segments() {
    for (const Triangle& t : out_.mesh.triangles) {
      const std::uint32_t a = ring_of_[t[0]], b = ring_of_[t[1]], c = ring_of_[t[2]];
      const std::uint32_t other = b != a ? b : c;
      const std::uint32_t child = other == a ? (model_.parent[a] != k_none ? a : first_child_[a])
                                  : model_.parent[other] == a ? other
                                                              : a;
      out_.hierarchy.segment_of.push_back(child == k_none ? k_none : stored_[child]);
    }
  }

  const StrictModel& model_;
  const Mesh& source_;
  std::span<const std::uint32_t> welded_;
  Indices id_, ring_vertices_, ring_of_, stored_, first_child_;
  std::vector<Double3> centre_;
  std::vector<double> diameter_;
  std::uint32_t branches_ = 0;
  StrictTrunk out_;
};

}  // namespace

StrictTrunk strict_hierarchy(const StrictModel& model, const Mesh& mesh,
                             std::span<const std::uint32_t> welded, std::span<const std::uint32_t> leaf_of) {
  return StrictReader(model, mesh, welded).run(leaf_of);
}

}  // namespace copse
