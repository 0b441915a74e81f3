#include "lib/analysis/surface/trunk_mesh.h"

#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/sew.h"
#include "lib/analysis/surface/weld.h"

#include <algorithm>
#include <utility>

namespace copse {
namespace {

// The positions that the trunk uses, in the mesh's order, and the trunk's triangles over them.
struct UsedVertices {
  std::vector<Double3> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> source;
};

UsedVertices used_by_trunk(const Mesh& mesh, std::span<const std::uint8_t> is_trunk) {
  UsedVertices used;
  std::vector<std::uint32_t> number(mesh.positions.size(), k_none);
  used.source.reserve(is_trunk.size() - static_cast<std::size_t>(std::ranges::count(is_trunk, 0)));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_trunk[t]) continue;
    for (const std::uint32_t v : mesh.triangles[t]) number[v] = 0;
    used.source.push_back(t);
  }
  used.positions.reserve(number.size() - static_cast<std::size_t>(std::ranges::count(number, k_none)));
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == k_none) continue;
    number[v] = static_cast<std::uint32_t>(used.positions.size());
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
  std::vector<std::uint32_t> equal = weld(positions, 0.0);
  const std::vector<std::uint8_t> closed = are_closed(triangles, equal);
  std::vector<double> reach = weld_tolerances(positions, triangles, equal);
  for (std::size_t v = 0; v < reach.size(); ++v) {
    if (closed[v]) reach[v] = 0;
  }
  return weld(positions, reach, std::move(equal));
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

// Leaves out the triangles that are degenerate once welded, in `used` and in `piece` (one a triangle). The
// answer: the others, welded.
std::vector<Triangle> keep_sound(std::span<const std::uint32_t> representative, UsedVertices& used,
                                 std::vector<std::uint32_t>& piece) {
  std::vector<Triangle> welded;
  welded.reserve(used.triangles.size());
  for (std::size_t t = 0; t < used.triangles.size(); ++t) {
    const Triangle& u = used.triangles[t];
    const Triangle w{representative[u[0]], representative[u[1]], representative[u[2]]};
    if (is_degenerate(w)) continue;
    const std::size_t kept = welded.size();
    used.triangles[kept] = u, used.source[kept] = used.source[t], piece[kept] = piece[t];
    welded.push_back(w);
  }
  used.triangles.resize(welded.size()), used.source.resize(welded.size()), piece.resize(welded.size());
  return welded;
}

// The surface that each position lies on; k_none where no triangle uses it.
std::vector<std::uint32_t> surfaces_of(const UsedVertices& used, std::span<const std::uint32_t> piece,
                                       std::span<const Triangle> welded) {
  const std::vector<std::uint32_t> surface_of_piece = sew(used.positions, welded, piece);
  std::vector<std::uint32_t> surface(used.positions.size(), k_none);
  for (std::size_t t = 0; t < used.triangles.size(); ++t) {
    for (const std::uint32_t v : used.triangles[t]) surface[v] = surface_of_piece[piece[t]];
  }
  return surface;
}

void number_by_first(Components& pieces) {
  std::vector<std::uint32_t> number(pieces.count, k_none);
  pieces.count = 0;
  for (std::uint32_t& p : pieces.of) {
    if (number[p] == k_none) number[p] = pieces.count++;
    p = number[p];
  }
}

}  // namespace

TrunkMesh make_trunk_mesh(const Mesh& mesh, std::span<const std::uint8_t> is_trunk, double tolerance,
                          std::span<const std::uint32_t> file_order) {
  UsedVertices used = used_by_trunk(mesh, is_trunk);
  const std::vector<std::uint32_t> representative =
      tolerance < 0 ? weld_open(used.positions, used.triangles) : weld(used.positions, tolerance);
  // Degenerate triangles still connect the piece that they lie in.
  Components pieces = connected_components(used.triangles);
  TrunkMesh trunk;
  {
    const std::vector<Triangle> welded = keep_sound(representative, used, pieces.of);
    const std::vector<std::uint32_t> surface = surfaces_of(used, pieces.of, welded);
    const SurfaceVertices vertices(representative, surface);
    trunk.positions.reserve(vertices.lowest.size());
    for (const std::uint32_t v : vertices.lowest) trunk.positions.push_back(used.positions[v]);
    for (Triangle& t : used.triangles) t = {vertices.id[t[0]], vertices.id[t[1]], vertices.id[t[2]]};
  }
  trunk.triangles = std::move(used.triangles);
  trunk.source = std::move(used.source);
  if (!file_order.empty()) {
    trunk.file_order.reserve(trunk.source.size());
    for (const std::uint32_t t : trunk.source) trunk.file_order.push_back(file_order[t]);
  }
  number_by_first(pieces);
  trunk.piece = std::move(pieces.of);
  return trunk;
}

}  // namespace copse
