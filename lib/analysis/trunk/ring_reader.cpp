#include "lib/analysis/trunk/ring_reader.h"

#include "lib/analysis/trunk/tolerances.h"

#include <algorithm>

namespace copse {

RingReader::RingReader(const TrunkMesh& mesh, const Fans& fans)
    : mesh_(mesh), starts_(mesh, fans), front_(mesh, fans) {}

bool RingReader::attempt(std::span<const std::uint32_t> start, bool closed, RingSizes sizes) {
  const bool success = front_.read(start, closed, sizes);
  budget_ -= std::min(budget_, front_.triangles().size());
  return success;
}

// Length of the axis over the mean diameter of the rings that have one.
double RingReader::slenderness() const {
  const RingTree& rings = front_.rings();
  std::vector<Double3> centres;
  double axis = 0, diameters = 0;
  std::size_t count = 0;
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    const RingMeasure measure = measure_ring(mesh_.positions, rings.ring(r));
    centres.push_back(measure.centre);
    if (rings.parent[r] != k_none) axis += distance(measure.centre, centres[rings.parent[r]]);
    if (rings.ring(r).size() > 1) diameters += measure.diameter, ++count;
  }
  return count == 0 || diameters <= 0 ? 0 : axis / (diameters / static_cast<double>(count));
}

// Leaves the most slender of the readings that succeed in front_; the first of equals.
bool RingReader::read_best(std::span<const RingStarts::Ring> starts, RingSizes sizes) {
  const RingStarts::Ring* best = nullptr;
  double best_slenderness = -1;
  for (const RingStarts::Ring& start : starts) {
    if (budget_ == 0) break;
    if (!attempt(start, start.size() > 2, sizes) || front_.rings().size() < 2) continue;
    const double s = slenderness();
    if (s > best_slenderness) best = &start, best_slenderness = s;
  }
  return best != nullptr && front_.read(*best, best->size() > 2, sizes);
}

bool RingReader::read_open(std::uint32_t boundary_vertex, std::span<const std::uint32_t> vertices) {
  const RingStarts::Ring first = starts_.loop_through(boundary_vertex);
  const bool read = !first.empty() && attempt(first, true, RingSizes::any);
  // One ring that is all lid: a disc without inner vertices.
  if (read && front_.rings().size() == 1 && front_.triangles().size() + 2 == first.size()) {
    return read_best(starts_.rungs(vertices), RingSizes::any);
  }
  if (read) return front_.rings().size() > 1 && slenderness() > k_flat_slenderness;
  for (const RingStarts::Ring& loop : starts_.loops(vertices)) {
    if (budget_ == 0) break;
    if (attempt(loop, true, RingSizes::any) && front_.rings().size() > 1 &&
        slenderness() > k_flat_slenderness) {
      return true;
    }
  }
  return false;
}

bool RingReader::read_closed(std::span<const std::uint32_t> triangles,
                             std::span<const std::uint32_t> vertices) {
  std::vector<RingStarts::Ring> starts;
  for (const std::uint32_t v : vertices) {
    if (starts_.may_be_apex(v)) starts.push_back({v});
  }
  for (RingStarts::Ring& rim : starts_.lids(triangles)) starts.push_back(std::move(rim));
  return read_best(starts, RingSizes::constant);
}

// Cap centres, and rings inset in the plane of a cap, belong to the lid of the ring that they close.
std::vector<std::uint32_t> RingReader::lid_ring_of(std::span<const RingMeasure> measures) const {
  const RingTree& rings = front_.rings();
  const auto closes = [&](std::uint32_t end, std::uint32_t ring) {
    const double radius = measures[ring].diameter / 2;
    const double reach = rings.ring(end).size() == 1 ? k_lid_height : k_join_tolerance;
    return rings.ring(ring).size() >= 3 && measures[end].diameter < measures[ring].diameter &&
           distance(measures[end].centre, measures[ring].centre) <= reach * radius;
  };
  std::vector<std::uint32_t> lid_of(rings.size(), k_none), children(rings.size(), 0);
  std::uint32_t kept = rings.size();
  for (std::uint32_t r = rings.size() - 1; r > 0; --r) {
    const std::uint32_t parent = rings.parent[r];
    if (children[r] == 0 && kept > 2 && closes(r, parent)) {
      lid_of[r] = parent;
      --kept;
    } else {
      ++children[parent];
    }
  }
  // The start is an end as well, when one ring alone follows it.
  std::uint32_t root = 0;
  for (std::uint32_t r = 1; r < rings.size(); ++r) {
    if (rings.parent[r] != root || lid_of[r] != k_none) continue;
    if (children[root] != 1 || kept <= 2 || !closes(root, r)) break;
    lid_of[root] = r;
    root = r;
    --kept;
  }
  return lid_of;
}

void RingReader::append(Limbs& limbs) const {
  const RingTree& rings = front_.rings();
  std::vector<RingMeasure> measures;
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    measures.push_back(measure_ring(mesh_.positions, rings.ring(r)));
  }
  const std::vector<std::uint32_t> lid_of = lid_ring_of(measures);
  std::vector<std::uint32_t> id(rings.size(), k_none);
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    if (lid_of[r] != k_none) continue;
    id[r] = limbs.rings();
    const std::uint32_t parent = rings.parent[r] == k_none ? k_none : id[rings.parent[r]];
    limbs.append(measures[r].centre, measures[r].diameter, parent,
                 rings.ring(r).size() == 1 ? RadiusSource::point : RadiusSource::ring, rings.ring(r));
  }
  ++limbs.size;
  for (const std::uint32_t t : front_.triangles()) {
    std::uint32_t ring = front_.owner(t);
    bool lid = front_.is_lid(t);
    // A band between a ring and an end that became part of its lid is lid.
    const std::uint32_t near = rings.parent[ring];
    if (!lid && near != k_none && lid_of[near] != k_none) lid = true;
    while (lid_of[ring] != k_none) ring = lid_of[ring], lid = true;
    limbs.owner[t] = id[ring];
    limbs.lid[t] = lid;
  }
}

bool RingReader::read(std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> vertices,
                      Limbs& limbs) {
  budget_ = k_ring_attempts * triangles.size();
  const std::uint32_t boundary = starts_.first_on_boundary(vertices);
  const bool read = boundary != k_none ? read_open(boundary, vertices) : read_closed(triangles, vertices);
  if (read) append(limbs);
  return read;
}

}  // namespace copse
