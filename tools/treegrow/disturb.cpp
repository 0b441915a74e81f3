#include "tools/treegrow/disturb.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace copse::grow {
namespace {

constexpr std::uint64_t k_shares = 50;  // one in so many is duplicated, degenerate or stray

enum Key : std::uint64_t { k_duplicate = 100, k_degenerate, k_stray, k_flip, k_vertices, k_faces, k_corner };

// The first triangle of each face, and one past the last of the last.
std::vector<std::uint32_t> face_starts(const Mesh& mesh) {
  std::vector<std::uint32_t> starts;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (t == 0 || mesh.face_of[t] != mesh.face_of[t - 1]) starts.push_back(t);
  starts.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
  return starts;
}

void append_like(Mesh& mesh, std::size_t like, const Triangle& corners) {
  mesh.triangles.push_back(corners);
  mesh.normal_triangles.push_back(corners);
  mesh.texcoord_triangles.push_back(mesh.texcoord_triangles[like]);
  mesh.part_of.push_back(mesh.part_of[like]);
  mesh.face_of.push_back(mesh.face_of.back() + 1);
}

// `count` different triangles, in ascending order (selection sampling, Knuth 3.4.2 S).
std::vector<std::uint32_t> sample(std::uint64_t total, std::uint64_t count, Random random) {
  std::vector<std::uint32_t> chosen;
  for (std::uint64_t t = 0; t < total && chosen.size() < count; ++t)
    if (random.below(total - t) < count - chosen.size()) chosen.push_back(static_cast<std::uint32_t>(t));
  return chosen;
}

void duplicate(Mesh& mesh, std::uint64_t clean, const Random& random) {
  for (const std::uint32_t t : sample(clean, clean / k_shares, random))
    append_like(mesh, t, mesh.triangles[t]);
}

std::uint32_t add_twin(Mesh& mesh, std::uint32_t of) {
  const Double3 p = mesh.positions[of];
  const Float3 n = mesh.normals[of];
  mesh.positions.push_back(p);
  mesh.normals.push_back(n);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void degenerate(Mesh& mesh, std::uint64_t clean, const Random& random) {
  bool twin = false;
  for (const std::uint32_t t : sample(clean, clean / k_shares, random)) {
    const Triangle corners = mesh.triangles[t];
    const std::uint32_t last = twin ? add_twin(mesh, corners[0]) : corners[0];
    append_like(mesh, t, {corners[0], corners[1], last});
    twin = !twin;
  }
}

void stray(Mesh& mesh, Random random) {
  const DoubleBox box = bounds(mesh);
  const std::size_t count = mesh.positions.size() / k_shares;
  for (std::size_t i = 0; i < count; ++i) {
    mesh.positions.push_back({random.uniform(box.min.x, box.max.x), random.uniform(box.min.y, box.max.y),
                              random.uniform(box.min.z, box.max.z)});
    mesh.normals.push_back({0, 1, 0});
  }
}

// A turned face begins at the same corner and goes round the other way.
void flip(Mesh& mesh, Random random) {
  const auto starts = face_starts(mesh);
  for (std::size_t f = 0; f + 1 < starts.size(); ++f) {
    if (!random.chance(0.5)) continue;
    for (auto* corners : {&mesh.triangles, &mesh.normal_triangles, &mesh.texcoord_triangles}) {
      const auto face = std::span(*corners).subspan(starts[f], starts[f + 1] - starts[f]);
      std::reverse(face.begin(), face.end());
      for (Triangle& triangle : face) std::swap(triangle[1], triangle[2]);
    }
  }
}

// Every face gets its own vertices and its own normal.
void split(Mesh& mesh) {
  std::vector<Double3> positions;
  std::vector<Float3> normals;
  const auto starts = face_starts(mesh);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> seen;  // of one face: old, new
  for (std::size_t f = 0; f + 1 < starts.size(); ++f) {
    seen.clear();
    Double3 normal;
    for (std::uint32_t t = starts[f]; t < starts[f + 1]; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      normal += cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    }
    for (std::uint32_t t = starts[f]; t < starts[f + 1]; ++t) {
      for (std::uint32_t& corner : mesh.triangles[t]) {
        const auto known =
            std::find_if(seen.begin(), seen.end(), [&](const auto& s) { return s.first == corner; });
        if (known != seen.end()) {
          corner = known->second;
          continue;
        }
        positions.push_back(mesh.positions[corner]);
        normals.push_back(to_float(normalized(normal)));
        seen.emplace_back(corner, static_cast<std::uint32_t>(positions.size() - 1));
        corner = seen.back().second;
      }
    }
  }
  mesh.positions = std::move(positions);
  mesh.normals = std::move(normals);
  mesh.normal_triangles = mesh.triangles;
}

template <class T>
std::vector<T> reordered(const std::vector<T>& from, const std::vector<std::uint32_t>& order) {
  std::vector<T> to;
  to.reserve(order.size());
  for (const std::uint32_t i : order) to.push_back(from[i]);
  return to;
}

void shuffle(Mesh& mesh, const Random& random) {
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  random.fork(k_vertices).shuffle(std::span(order));
  mesh.positions = reordered(mesh.positions, order);
  mesh.normals = reordered(mesh.normals, order);
  std::vector<std::uint32_t> now(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) now[order[i]] = i;
  for (Triangle& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) corner = now[corner];
  mesh.normal_triangles = mesh.triangles;

  const auto starts = face_starts(mesh);
  std::vector<std::uint32_t> faces(starts.size() - 1), triangles;
  std::iota(faces.begin(), faces.end(), 0u);
  random.fork(k_faces).shuffle(std::span(faces));
  for (const std::uint32_t f : faces)
    for (std::uint32_t t = starts[f]; t < starts[f + 1]; ++t) triangles.push_back(t);
  mesh.triangles = reordered(mesh.triangles, triangles);
  mesh.normal_triangles = reordered(mesh.normal_triangles, triangles);
  mesh.texcoord_triangles = reordered(mesh.texcoord_triangles, triangles);
  mesh.part_of = reordered(mesh.part_of, triangles);
  mesh.face_of = reordered(mesh.face_of, triangles);
}

}  // namespace

void disturb(Mesh& mesh, const Breaks& breaks, std::uint64_t seed) {
  const Random random = Random(seed).fork(k_corner);
  const std::uint64_t clean = mesh.triangles.size();
  if (breaks.has(Break::duplicate_triangles)) duplicate(mesh, clean, random.fork(k_duplicate));
  if (breaks.has(Break::degenerate_triangles)) degenerate(mesh, clean, random.fork(k_degenerate));
  if (breaks.has(Break::flipped)) flip(mesh, random.fork(k_flip));
  if (breaks.has(Break::split_normals)) split(mesh);
  if (breaks.has(Break::stray_vertices)) stray(mesh, random.fork(k_stray));
  if (breaks.has(Break::shuffled)) shuffle(mesh, random);
  if (breaks.has(Break::no_normals)) mesh.normals.clear(), mesh.normal_triangles.clear();
  if (breaks.has(Break::no_uvs)) mesh.texcoords.clear(), mesh.texcoord_triangles.clear();
}

}  // namespace copse::grow
