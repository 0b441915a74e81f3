#include "lib/analysis/surface/trunk_mesh.h"

#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/sew.h"
#include "lib/analysis/surface/weld.h"

#include <cmath>

namespace copse {
namespace {

// The mesh vertices that the trunk uses, ascending, and the trunk's triangles over them.
struct UsedVertices {
  std::vector<std::uint32_t> vertex;
  std::vector<Double3> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> source;
};

UsedVertices used_by_trunk(const Mesh& mesh, std::span<const std::uint8_t> is_trunk) {
  UsedVertices used;
  std::vector<std::uint32_t> number(mesh.positions.size(), k_none);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_trunk[t]) continue;
    for (const std::uint32_t v : mesh.triangles[t]) number[v] = 0;
    used.source.push_back(t);
  }
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == k_none) continue;
    number[v] = static_cast<std::uint32_t>(used.vertex.size());
    used.vertex.push_back(v);
    used.positions.push_back(mesh.positions[v]);
  }
  used.triangles.reserve(used.source.size());
  for (const std::uint32_t t : used.source) {
    const Triangle& m = mesh.triangles[t];
    used.triangles.push_back({number[m[0]], number[m[1]], number[m[2]]});
  }
  return used;
}

std::uint64_t scrambled(std::uint64_t x) {  // a bijection that leaves no pattern for sums to cancel in
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

// Which positions have triangles all round: each neighbour is met an even number of times. One in 2^64 others
// passes for such a one.
std::vector<std::uint8_t> are_closed(std::span<const Triangle> triangles,
                                     std::span<const std::uint32_t> same) {
  std::vector<std::uint64_t> odd(same.size(), 0);
  for (const Triangle& t : triangles) {
    const std::uint32_t a = same[t[0]], b = same[t[1]], c = same[t[2]];
    if (a == b || b == c || a == c) continue;
    const std::uint64_t x = scrambled(a + 1ull), y = scrambled(b + 1ull), z = scrambled(c + 1ull);
    odd[a] ^= y ^ z, odd[b] ^= x ^ z, odd[c] ^= x ^ y;
  }
  std::vector<std::uint8_t> closed(same.size());
  for (std::size_t v = 0; v < same.size(); ++v) closed[v] = odd[same[v]] == 0;
  return closed;
}

// Near positions are one where surfaces end: at seams, and where pieces meet. Where nothing is open nothing
// was computed twice, and two vertices that are near are two.
std::vector<std::uint32_t> weld_open(std::span<const Double3> positions,
                                     std::span<const Triangle> triangles) {
  const std::vector<std::uint8_t> closed = are_closed(triangles, weld(positions, 0.0));
  std::vector<double> reach = weld_tolerances(positions, triangles);
  for (std::size_t v = 0; v < reach.size(); ++v) {
    if (closed[v]) reach[v] = 0;
  }
  return weld(positions, reach);
}

// Gives every (representative, surface) pair a vertex of its own, numbered by its lowest used vertex.
class SurfaceVertices {
 public:
  SurfaceVertices(std::span<const std::uint32_t> representative, std::span<const std::uint32_t> surface)
      : first_(representative.size(), k_none), next_(representative.size(), k_none) {
    id.resize(representative.size(), k_none);
    for (std::uint32_t v = 0; v < representative.size(); ++v) {
      if (surface[v] == k_none) continue;  // only degenerate triangles use it
      std::uint32_t* link = &first_[representative[v]];
      while (*link != k_none && surface[*link] != surface[v]) link = &next_[*link];
      if (*link == k_none) {
        *link = v;
        id[v] = static_cast<std::uint32_t>(lowest.size());
        lowest.push_back(v);
      } else {
        id[v] = id[*link];
      }
    }
  }

  std::vector<std::uint32_t> id;      // of every used vertex
  std::vector<std::uint32_t> lowest;  // the used vertex whose position each id takes

 private:
  std::vector<std::uint32_t> first_, next_;
};

bool is_degenerate(const Triangle& t) {
  return t[0] == t[1] || t[0] == t[2] || t[1] == t[2];
}

}  // namespace

TrunkMesh make_trunk_mesh(const Mesh& mesh, std::span<const std::uint8_t> is_trunk, double tolerance,
                          std::span<const std::uint32_t> file_order) {
  UsedVertices used = used_by_trunk(mesh, is_trunk);
  const std::vector<std::uint32_t> representative =
      tolerance < 0 ? weld_open(used.positions, used.triangles) : weld(used.positions, tolerance);
  // Degenerate triangles still connect the piece that they lie in.
  const Components pieces = connected_components(used.triangles);
  TrunkMesh trunk;
  std::vector<Triangle> kept, welded;
  std::vector<std::uint32_t> kept_piece;
  for (std::size_t t = 0; t < used.triangles.size(); ++t) {
    const Triangle& u = used.triangles[t];
    const Triangle w{representative[u[0]], representative[u[1]], representative[u[2]]};
    if (is_degenerate(w)) continue;
    kept.push_back(u);
    welded.push_back(w);
    kept_piece.push_back(pieces.of[t]);
    trunk.source.push_back(used.source[t]);
    if (!file_order.empty()) trunk.file_order.push_back(file_order[used.source[t]]);
  }
  const std::vector<std::uint32_t> surface_of_piece = sew(used.positions, welded, kept_piece);
  std::vector<std::uint32_t> surface(used.positions.size(), k_none);
  for (std::size_t t = 0; t < kept.size(); ++t) {
    for (const std::uint32_t v : kept[t]) surface[v] = surface_of_piece[kept_piece[t]];
  }
  const SurfaceVertices vertices(representative, surface);
  trunk.positions.reserve(vertices.lowest.size());
  for (const std::uint32_t v : vertices.lowest) trunk.positions.push_back(used.positions[v]);
  trunk.triangles.reserve(kept.size());
  for (const Triangle& t : kept) {
    trunk.triangles.push_back({vertices.id[t[0]], vertices.id[t[1]], vertices.id[t[2]]});
  }
  std::vector<std::uint32_t> number(pieces.count, k_none);
  std::uint32_t count = 0;
  for (std::uint32_t& p : kept_piece) {
    if (number[p] == k_none) number[p] = count++;
    p = number[p];
  }
  trunk.piece = std::move(kept_piece);
  return trunk;
}

}  // namespace copse
