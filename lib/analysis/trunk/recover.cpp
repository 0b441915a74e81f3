#include "lib/analysis/trunk/recover.h"

#include "lib/analysis/rings/limbs.h"
#include "lib/analysis/rings/ring_reader.h"
#include "lib/analysis/surface/fans.h"
#include "lib/analysis/surface/surface_copies.h"
#include "lib/analysis/surface/surfaces.h"
#include "lib/analysis/surface/tolerances.h"
#include "lib/analysis/trunk/attach.h"
#include "lib/analysis/trunk/join.h"
#include "lib/analysis/trunk/root.h"
#include "lib/analysis/trunk/welded.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace copse {
namespace {

void append_welded(const Hierarchy& part, std::span<const std::uint32_t> triangles, Limbs& limbs) {
  const std::uint32_t base = limbs.rings();
  for (std::uint32_t r = 0; r < part.radii.size(); ++r) {
    const RadiusNode& node = part.radii[r];
    const std::uint32_t first = part.first_vertex[r], end = part.first_vertex[r + 1];
    limbs.append({node.centre, node.diameter, {}}, node.parent == k_none ? k_none : base + node.parent,
                 node.source, std::span(part.ring_vertices).subspan(first, end - first));
  }
  ++limbs.size;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (part.segment_of[i] != k_none) limbs.owner[triangles[i]] = base + part.segment_of[i];
  }
  limbs.notes.insert(limbs.notes.end(), part.notes.begin(), part.notes.end());
}

// Ground that trees stand on: flat, half as wide as everything or wider, at the bottom.
bool is_plate(const DoubleBox& surface, const DoubleBox& all) {
  const Double3 e = surface.extent(), whole = all.extent();
  return e.y <= k_plate_height * std::min(e.x, e.z) &&
         std::min(e.x / whole.x, e.z / whole.z) >= k_plate_width &&
         surface.min.y - all.min.y <= k_plate_height * whole.y && whole.y > e.y;
}

// One a surface.
std::vector<std::uint8_t> find_plates(const TrunkMesh& mesh, const Surfaces& surfaces) {
  std::vector<std::uint8_t> is_plate_of(surfaces.size(), 0);
  if (surfaces.size() < 2) return is_plate_of;
  DoubleBox all;
  for (const Double3& p : mesh.positions) all.grow(p);
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    DoubleBox box;
    for (const std::uint32_t v : surfaces.vertices(s)) box.grow(mesh.positions[v]);
    is_plate_of[s] = is_plate(box, all);
  }
  return is_plate_of;
}

// Ground is no limb that lies there, as its rings would say, but a short thick stub that stands there: what
// moves as little as what grows on it. False where it has no thickness to be long.
bool append_ground(const TrunkMesh& mesh, std::span<const std::uint32_t> triangles,
                   std::span<const std::uint32_t> vertices, Limbs& limbs) {
  DoubleBox box;
  for (const std::uint32_t v : vertices) box.grow(mesh.positions[v]);
  const Double3 centre = box.centre();
  std::vector<std::uint32_t> below, above;
  for (const std::uint32_t v : vertices) (mesh.positions[v].y < centre.y ? below : above).push_back(v);
  if (below.empty() || above.empty()) return false;
  const std::uint32_t foot = limbs.rings();
  const auto append_level = [&](std::span<const std::uint32_t> level, double y, std::uint32_t parent) {
    const Double3 middle{centre.x, y, centre.z};
    double sum = 0;
    for (const std::uint32_t v : level) {
      const Double3 from = mesh.positions[v] - middle;
      sum += std::hypot(from.x, from.z);
    }
    const double diameter = 2 * sum / static_cast<double>(level.size());
    limbs.append({middle, diameter, {0, 1, 0}}, parent, RadiusSource::surface, level);
  };
  append_level(below, box.min.y, k_none);
  append_level(above, box.max.y, foot);
  ++limbs.size;
  for (const std::uint32_t t : triangles) limbs.owner[t] = foot + 1;
  return true;
}

// Reads rings, and needs half of what the trunk takes up for that; gone while a large surface is read by
// other means, which need as much.
class Readers {
 public:
  explicit Readers(const TrunkMesh& mesh) : mesh_(mesh) { make(); }
  RingReader& get() {
    if (!reader_) make();
    return *reader_;
  }
  void release() {
    reader_.reset();
    fans_.reset();
  }
  const auto& repeated() const { return repeated_; }  // as Fans has them

 private:
  void make() {
    fans_.emplace(make_fans(mesh_.positions.size(), mesh_.triangles));
    repeated_ = fans_->repeated;
    reader_.emplace(mesh_, *fans_);
  }

  const TrunkMesh& mesh_;
  std::optional<Fans> fans_;
  std::optional<RingReader> reader_;
  decltype(Fans::repeated) repeated_;
};

constexpr std::size_t k_readers_again = 4;  // times that they are made again at most

Limbs read_limbs(const TrunkMesh& mesh, const RecoverOptions& options) {
  Limbs limbs;
  limbs.owner.assign(mesh.triangles.size(), k_none);
  limbs.lid.assign(mesh.triangles.size(), 0);
  Readers readers(mesh);
  const Surfaces surfaces = make_surfaces(mesh);
  const WeldedOptions welded{options.skeleton == Skeleton::automatic ? WeldedMethod::automatic
                             : options.skeleton == Skeleton::rings   ? WeldedMethod::rings
                                                                     : WeldedMethod::surface};
  const std::vector<std::uint8_t> plates = find_plates(mesh, surfaces);
  const SurfaceCopies copies = find_surface_copies(mesh, surfaces);
  std::uint32_t tubes = 0, grounds = 0, copied = 0;
  std::uint64_t welded_triangles = 0;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    const auto triangles = surfaces.triangles(s);
    if (copies.original[s] != k_none) {
      ++copied;
      continue;
    }
    limbs.is_plate.push_back(plates[s]);
    if (plates[s] != 0 && append_ground(mesh, triangles, surfaces.vertices(s), limbs)) {
      ++grounds;
      continue;
    }
    if (options.skeleton != Skeleton::surface && readers.get().read(triangles, surfaces.vertices(s), limbs)) {
      ++tubes;
      continue;
    }
    if (triangles.size() * k_readers_again >= mesh.triangles.size()) readers.release();
    append_welded(recover_welded(mesh, triangles, welded), triangles, limbs);
    welded_triangles += triangles.size();
  }
  for (const auto& [triangle, original] : readers.repeated()) {
    limbs.owner[triangle] = limbs.owner[original];
    limbs.lid[triangle] = limbs.lid[original];
  }
  for (const auto& [triangle, original] : copies.triangles) {
    limbs.owner[triangle] = limbs.owner[original];
    limbs.lid[triangle] = limbs.lid[original];
  }
  limbs.notes.push_back(fmt::format("{} of {} surfaces read as rings; {} triangles lie in the others", tubes,
                                    surfaces.size() - grounds - copied, welded_triangles));
  if (copied > 0) {
    limbs.notes.push_back(
        fmt::format("{} surfaces of {} triangles lie corner for corner on others, and are read with these",
                    copied, copies.triangles.size()));
  }
  if (grounds > 0)
    limbs.notes.push_back("a plate at the bottom, half as wide as everything, is ground and no limb");
  return limbs;
}

// The limbs, attached, in the order in which they are stored.
class Assembly {
 public:
  Assembly(const Limbs& limbs, std::span<const Attachment> attachments)
      : limbs_(limbs), parent_(limbs.rings(), k_none), id_(limbs.rings(), k_none) {
    for (std::uint32_t r = 0; r < limbs.rings(); ++r) {
      if (limbs.merged_into[r] != k_none) continue;
      parent_[r] = limbs.parent[r] != k_none ? limbs.parent_of(r) : attachments[limbs.limb[r]].ring;
    }
  }

  Hierarchy run() {
    list_children();
    list_copies();
    for (std::uint32_t r = 0; r < limbs_.rings(); ++r) {
      if (limbs_.merged_into[r] == k_none && parent_[r] == k_none) store_tree(r);
    }
    name_segments();
    hierarchy_.notes = limbs_.notes;
    return std::move(hierarchy_);
  }

 private:
  bool is_joint(std::uint32_t r) const { return limbs_.parent[r] == k_none && parent_[r] != k_none; }

  // Children by parent: joints last, thicker before thinner, so that the first is the main line.
  void list_children() {
    first_child_.assign(limbs_.rings() + 1, 0);
    for (const std::uint32_t p : parent_) {
      if (p != k_none) ++first_child_[p + 1];
    }
    for (std::uint32_t r = 0; r < limbs_.rings(); ++r) first_child_[r + 1] += first_child_[r];
    child_.resize(first_child_.back());
    std::vector<std::uint32_t> next(first_child_.begin(), first_child_.end() - 1);
    for (std::uint32_t r = 0; r < limbs_.rings(); ++r) {
      if (parent_[r] != k_none) child_[next[parent_[r]]++] = r;
    }
    for (std::uint32_t r = 0; r < limbs_.rings(); ++r) {
      std::ranges::sort(children(r), [&](std::uint32_t a, std::uint32_t b) {
        if (is_joint(a) != is_joint(b)) return is_joint(b);
        if (limbs_.diameter[a] != limbs_.diameter[b]) return limbs_.diameter[a] > limbs_.diameter[b];
        return a < b;
      });
    }
  }

  std::span<std::uint32_t> children(std::uint32_t r) {
    return std::span(child_).subspan(first_child_[r], first_child_[r + 1] - first_child_[r]);
  }

  void list_copies() {
    for (std::uint32_t r = 0; r < limbs_.rings(); ++r) {
      if (limbs_.merged_into[r] != k_none) copies_.emplace_back(limbs_.alive(r), r);
    }
    std::ranges::sort(copies_);
  }

  void store_tree(std::uint32_t root) {
    std::vector<std::uint32_t> todo{root};
    while (!todo.empty()) {
      const std::uint32_t r = todo.back();
      todo.pop_back();
      store(r);
      const auto below = children(r);
      todo.insert(todo.end(), below.rbegin(), below.rend());
    }
  }

  void store(std::uint32_t r) {
    id_[r] = static_cast<std::uint32_t>(hierarchy_.radii.size());
    RadiusNode& node = hierarchy_.radii.emplace_back();
    node.centre = limbs_.centre[r];
    node.diameter = limbs_.diameter[r];
    node.source = limbs_.source[r];
    node.joint = is_joint(r);
    if (parent_[r] != k_none) node.parent = id_[parent_[r]];
    const bool continues = parent_[r] != k_none && !node.joint && children(parent_[r]).front() == r;
    node.branch = continues ? hierarchy_.radii[node.parent].branch : branches_++;
    auto& vertices = hierarchy_.ring_vertices;
    vertices.insert(vertices.end(), limbs_.ring(r).begin(), limbs_.ring(r).end());
    for (auto c = std::ranges::lower_bound(copies_, std::pair(r, 0u)); c != copies_.end() && c->first == r;
         ++c) {
      vertices.insert(vertices.end(), limbs_.ring(c->second).begin(), limbs_.ring(c->second).end());
    }
    hierarchy_.first_vertex.push_back(static_cast<std::uint32_t>(vertices.size()));
  }

  void name_segments() {
    std::vector<std::uint32_t> far(limbs_.rings(), k_none);  // of each band
    for (std::uint32_t r = 0; r < limbs_.rings(); ++r) {
      if (limbs_.merged_into[r] == k_none && limbs_.band[r] != k_none) far[limbs_.band[r]] = id_[r];
    }
    hierarchy_.segment_of.assign(limbs_.owner.size(), k_none);
    for (std::size_t t = 0; t < limbs_.owner.size(); ++t) {
      const std::uint32_t owner = limbs_.owner[t];
      if (owner == k_none) continue;
      hierarchy_.segment_of[t] = limbs_.lid[t] ? lid_segment(limbs_.alive(owner)) : far[owner];
    }
  }

  std::uint32_t lid_segment(std::uint32_t ring) {
    if (limbs_.parent[ring] != k_none) return id_[ring];
    const auto below = children(ring);
    return below.empty() || is_joint(below.front()) ? k_none : id_[below.front()];
  }

  const Limbs& limbs_;
  std::vector<std::uint32_t> parent_, id_, first_child_, child_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> copies_;  // (alive ring, its copy)
  std::uint32_t branches_ = 0;
  Hierarchy hierarchy_;
};

// Sets the bases of the limbs at the points, and returns these limbs.
std::vector<std::uint32_t> name_roots(Limbs& limbs, std::span<const Double3> points,
                                      std::vector<std::uint32_t>& bases) {
  std::vector<std::uint32_t> named;
  const std::vector<std::uint32_t> ends = nearest_ends(limbs, points);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i] == k_none) continue;
    const std::uint32_t limb = limbs.limb[ends[i]];
    const Double3& p = points[i];
    if (std::ranges::count(named, limb) != 0) {
      limbs.notes.push_back(fmt::format(
          "root {:g},{:g},{:g} is nearest to a surface that begins at another root and is left out", p.x, p.y,
          p.z));
      continue;
    }
    named.push_back(limb);
    bases[limb] = ends[i];
  }
  return named;
}

}  // namespace

Hierarchy recover_hierarchy(const TrunkMesh& mesh, const RecoverOptions& options) {
  Limbs limbs = read_limbs(mesh, options);
  LimbSegments segments(limbs);
  if (limbs.size > 1) join(limbs, segments);
  const Ground ground(limbs, segments, mesh.positions);
  std::vector<std::uint32_t> bases = choose_bases(limbs, segments, ground);
  const std::vector<std::uint32_t> roots = name_roots(limbs, options.roots, bases);
  const std::vector<Attachment> attachments = attach(limbs, segments, ground, bases, roots);
  for (const Attachment& attachment : attachments) {
    if (attachment.base != k_none) reroot(limbs, attachment.base);
  }
  return Assembly(limbs, attachments).run();
}

}  // namespace copse
