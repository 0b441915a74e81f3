#include "lib/analysis/rings/ring_reader.h"

#include "lib/analysis/surface/tolerances.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

// Mean cosine between the rungs of a strip and its axis there: 0 for square rungs. A strip whose quads are
// all cut the same way can also be read along its diagonals.
double RingReader::obliqueness() const {
  const RingTree& rings = front_.rings();
  double sum = 0;
  std::size_t count = 0;
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    if (rings.ring(r).size() != 2) continue;
    // Strips do not fork: rings follow one another.
    const std::uint32_t before = r == 0 ? r : r - 1, after = std::min(r + 1, rings.size() - 1);
    const Double3 axis = measure_ring(mesh_.positions, rings.ring(after)).centre -
                         measure_ring(mesh_.positions, rings.ring(before)).centre;
    const Double3 rung = mesh_.positions[rings.ring(r)[1]] - mesh_.positions[rings.ring(r)[0]];
    sum += std::abs(dot(normalized(axis, {}), normalized(rung, {})));
    ++count;
  }
  return count == 0 ? 1 : sum / static_cast<double>(count);
}

// Whether one end alone is sunk below y = 0, as the foot of a blade of grass is.
bool RingReader::has_foot() const {
  const RingTree& rings = front_.rings();
  const auto sunk = [&](std::uint32_t r) {
    return std::ranges::all_of(rings.ring(r), [&](std::uint32_t v) { return mesh_.positions[v].y < 0; });
  };
  return sunk(0) != sunk(rings.size() - 1);
}

// How many ends of the reading are neither a flat lid nor the middle of a flat cap. The ends of a closed tube
// are flat, but for tips; where a surface is read across its sides they are corners.
std::size_t RingReader::pointed_ends() const {
  const RingTree& rings = front_.rings();
  std::vector<std::uint32_t> next(rings.size(), k_none);  // the one ring that an end leads to
  std::vector<std::uint32_t> children(rings.size(), 0);
  for (std::uint32_t r = 1; r < rings.size(); ++r) {
    next[r] = rings.parent[r];
    if (++children[rings.parent[r]] == 1 && rings.parent[r] == 0) next[0] = r;
  }
  std::size_t pointed = 0;
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    if (children[r] != (r == 0 ? 1 : 0)) continue;
    const auto ring = rings.ring(r);
    pointed += ring.size() == 1 ? !closes_flat(ring[0], rings.ring(next[r])) : !is_flat(ring);
  }
  return pointed;
}

// Whether every ring of more than two vertices is a regular polygon: true rings of most generators are, and
// rings that are read across the sides of a tube are not.
bool RingReader::is_regular() const {
  const RingTree& rings = front_.rings();
  const auto is_regular_ring = [&](std::span<const std::uint32_t> ring) {
    const RingMeasure m = measure_ring(mesh_.positions, ring);
    const double tolerance = k_regular_ring * m.diameter / 2;
    const auto edge = [&](std::size_t i) {
      return distance(mesh_.positions[ring[i]], mesh_.positions[ring[(i + 1) % ring.size()]]);
    };
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (std::abs(distance(mesh_.positions[ring[i]], m.centre) - m.diameter / 2) > tolerance) return false;
      if (std::abs(edge(i) - edge(0)) > tolerance) return false;
    }
    return true;
  };
  for (std::uint32_t r = 0; r < rings.size(); ++r) {
    if (rings.ring(r).size() > 2 && !is_regular_ring(rings.ring(r))) return false;
  }
  return true;
}

bool RingReader::closes_flat(std::uint32_t point, std::span<const std::uint32_t> ring) const {
  const RingMeasure m = measure_ring(mesh_.positions, ring);
  return distance(mesh_.positions[point], m.centre) <= k_lid_height * m.diameter / 2;
}

bool RingReader::is_flat(std::span<const std::uint32_t> ring) const {
  const RingMeasure m = measure_ring(mesh_.positions, ring);
  return std::ranges::all_of(ring, [&](std::uint32_t v) {
    return std::abs(dot(mesh_.positions[v] - m.centre, m.normal)) <= k_lid_height * m.diameter / 2;
  });
}

// Adds the readings from these starts that succeed.
void RingReader::try_starts(std::span<const RingStarts::Ring> starts, RingSizes sizes,
                            std::vector<Reading>& readings) {
  for (const RingStarts::Ring& start : starts) {
    if (budget_ == 0) break;
    if (!attempt(start, start.size() > 2, sizes) || front_.rings().size() < 2) continue;
    const bool is_strip = sizes == RingSizes::any;
    Reading& r = readings.emplace_back();
    r.start = start;
    if (is_strip) r.oblique = obliqueness();
    if (!is_strip) r.pointed = pointed_ends();
    r.rank = {is_strip ? has_foot() : is_regular(), slenderness() / static_cast<double>(1 + r.pointed)};
  }
}

// Leaves the best of the readings in front_; the first of equals. Best is, of strips, the squarest; of those
// that are about as square, one that stands with a foot in the ground; of tubes, one whose rings are regular;
// then the most slender, where every end that is not flat must be made up for by length.
bool RingReader::read_best(std::span<const Reading> readings, RingSizes sizes) {
  if (readings.empty()) return false;
  const double squarest = std::ranges::min(readings, {}, &Reading::oblique).oblique;
  const Reading* best = nullptr;
  for (const Reading& reading : readings) {
    if (reading.oblique > squarest + k_about_square) continue;
    if (best == nullptr || reading.rank > best->rank) best = &reading;
  }
  return front_.read(best->start, best->start.size() > 2, sizes);
}

bool RingReader::read_open(std::uint32_t boundary_vertex, std::span<const std::uint32_t> vertices) {
  const RingStarts::Ring first = starts_.loop_through(boundary_vertex);
  const bool read = !first.empty() && attempt(first, true, RingSizes::any);
  // One ring that is all lid: a disc without inner vertices.
  if (read && front_.rings().size() == 1 && front_.triangles().size() + 2 == first.size()) {
    std::vector<Reading> readings;
    try_starts(starts_.rungs(vertices), RingSizes::any, readings);
    return read_best(readings, RingSizes::any);
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
  // Where a tube is sheared its lid meets one side of it smoothly: look closer until lids come off.
  std::vector<Reading> readings;
  for (const double smooth : k_lid_smooth_cosines) {
    for (RingStarts::Ring& rim : starts_.lids(triangles, smooth)) starts.push_back(std::move(rim));
    try_starts(starts, RingSizes::constant, readings);
    if (std::ranges::any_of(readings, [](const Reading& r) { return r.pointed == 0; })) break;
    starts.clear();
  }
  return read_best(readings, RingSizes::constant);
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
    limbs.append(measures[r], parent, rings.ring(r).size() == 1 ? RadiusSource::point : RadiusSource::ring,
                 rings.ring(r));
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
