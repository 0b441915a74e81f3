#include "tests/treeprep/mesh_of_bytes.h"

#include "lib/analysis/measure/cylinder_error.h"
#include "lib/formats/random.h"
#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/import/soundness.h"
#include "tests/trunk/tube_maker.h"
#include "tools/common/context.h"
#include "tools/treeprep/analyse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace copse {
namespace {

// Bytes from the front; zeros when there are no more.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool empty() const { return bytes_.empty(); }
  std::uint32_t next() {
    if (bytes_.empty()) return 0;
    const std::uint8_t byte = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return byte;
  }
  int below(std::uint32_t n) { return static_cast<int>(next() % n); }
  template <class T, std::size_t n>
  T one_of(const T (&choices)[n]) {
    return choices[next() % n];
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

Double3 in_cube(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

// Where and how large a mesh is.
struct Place {
  double size = 1, offset = 0, stretch = 1;
  int axis = 0;
  bool shuffled = false;
};

Place place_of(Bytes& bytes) {
  Place place;
  place.size = bytes.one_of({1.0, 1.0, 1.0, 0.01, 1e4, 1e-30, 1e-300, 1e16});
  place.offset = bytes.one_of({0.0, 0.0, 0.0, 1e7, 1e15});
  place.stretch = bytes.one_of({1.0, 1.0, 1.0, 1.0, 0.0, 1e-6, 1e6});
  place.axis = bytes.below(3);
  place.shuffled = bytes.below(4) == 0;
  return place;
}

class Builder {
 public:
  explicit Builder(Bytes& bytes) : bytes_(bytes) {
    for (const char* name : {"", "bark", "leaf"}) {
      Material material;
      material.name = name;
      mesh_.materials.push_back(material);
    }
  }

  std::size_t triangles() const { return mesh_.triangles.size(); }

  void piece() {
    const int kind = bytes_.below(8);
    random_ = Random(bytes_.next());
    open_part(bytes_.below(4));
    add(kind);
    mesh_.part_of.resize(mesh_.triangles.size(), part_);
  }

  // As an import promises it: no triangle has a corner twice.
  Mesh finish(const Place& place) {
    for (Double3& p : mesh_.positions) {
      p[place.axis] *= place.stretch;
      p = p * place.size + Double3{place.offset, place.offset, -place.offset};
    }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Triangle c = mesh_.triangles[t];
      if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
      mesh_.part_of[kept] = mesh_.part_of[t];
      mesh_.triangles[kept++] = c;
    }
    mesh_.triangles.resize(kept), mesh_.part_of.resize(kept);
    TubeMaker maker;
    maker.mesh = std::move(mesh_);
    if (place.shuffled) maker.shuffle(7);
    return std::move(maker.mesh);
  }

 private:
  void add(int kind) {
    switch (kind) {
      case 0:
        return tube();
      case 1:
        return soup();
      case 2:
        return lump();
      case 3:
        return sheet();
      case 4:
        return pages();
      case 5:
        return repeat();
      case 6:
        return tie();
      default:
        return collapse();
    }
  }

  void open_part(int choice) {  // 0: goes on with the part before
    if (choice == 0 && !mesh_.parts.empty()) return;
    part_ = static_cast<std::uint32_t>(mesh_.parts.size());
    Part part;
    part.material = static_cast<std::uint32_t>(choice % 3);
    mesh_.parts.push_back(part);
  }

  std::uint32_t vertex(const Double3& p) {
    mesh_.positions.push_back(p);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }
  std::uint32_t any_vertex() { return static_cast<std::uint32_t>(random_.below(mesh_.positions.size())); }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh_.triangles.push_back({a, b, c}); }

  // From a vertex that is there, or from anywhere, on a crooked way.
  void tube() {
    TubeShape shape;
    shape.sides = 2 + bytes_.below(9);
    const int rings = 2 + bytes_.below(24);
    const double thickness = bytes_.one_of({0.02, 0.1, 0.5}), taper = bytes_.one_of({1.0, 0.9, 0.5, 1.1});
    const double crooked = bytes_.one_of({0.0, 0.2, 1.0, 3.0});
    Double3 at = mesh_.positions.empty() ? Double3{} : mesh_.positions[any_vertex()];
    Double3 step = in_cube(random_) * 0.3 + Double3{0, 0.2, 0};
    double radius = thickness;
    for (int r = 0; r < rings; ++r, radius *= taper) {
      shape.axis.push_back(at);
      shape.radius.push_back(radius);
      step += in_cube(random_) * (0.1 * crooked);
      at += step;
    }
    static constexpr TubeEnd k_ends[] = {TubeEnd::open, TubeEnd::fan, TubeEnd::lid, TubeEnd::point};
    shape.first = bytes_.one_of(k_ends), shape.last = bytes_.one_of(k_ends);
    const std::uint32_t how = bytes_.next();
    shape.diagonals = static_cast<Diagonals>(how & 3);
    shape.seam = how & 4, shape.split = (how & 24) == 24;
    TubeMaker tube;
    tube.add(shape, how & 32 ? 4 : 0);
    const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.insert(mesh_.positions.end(), tube.mesh.positions.begin(), tube.mesh.positions.end());
    for (const Triangle& t : tube.mesh.triangles) triangle(base + t[0], base + t[1], base + t[2]);
  }

  // Triangles between random points, or between points of a coarse lattice, so that many meet at one.
  void soup() {
    const int count = 1 + 4 * bytes_.below(256);
    const int lattice = bytes_.one_of({0, 2, 3, 5, 9});
    const double reach = bytes_.one_of({0.05, 0.3, 2.0});
    for (int t = 0; t < count; ++t) {
      const Double3 middle = in_cube(random_);
      Triangle corner;
      for (std::uint32_t& c : corner) {
        Double3 p = middle + in_cube(random_) * reach;
        if (lattice > 0)
          p = {std::round(p.x * lattice), std::round(p.y * lattice), std::round(p.z * lattice)};
        c = vertex(p);
      }
      triangle(corner[0], corner[1], corner[2]);
    }
  }

  // A closed surface: a sphere of rows, dented.
  void lump() {
    const int rows = 2 + bytes_.below(14), sides = 3 + bytes_.below(18);
    const double dents = bytes_.one_of({0.0, 0.2, 1.0});
    const Double3 middle = in_cube(random_) * 2;
    const auto point = [&](double polar, double turn) {
      const double r = 1 + dents * random_.uniform(-1, 1);
      return vertex(middle + Double3{r * std::sin(polar) * std::cos(turn), r * std::cos(polar),
                                     r * std::sin(polar) * std::sin(turn)});
    };
    const auto n = static_cast<std::uint32_t>(sides);
    const std::uint32_t top = point(0, 0), first = top + 1;
    for (int r = 1; r < rows; ++r) {
      for (int s = 0; s < sides; ++s) point(std::numbers::pi * r / rows, 2 * std::numbers::pi * s / sides);
    }
    const std::uint32_t bottom = point(std::numbers::pi, 0);
    for (std::uint32_t s = 0; s < n; ++s) triangle(top, first + (s + 1) % n, first + s);
    for (std::uint32_t row = first; row + n < bottom; row += n) quads(row, row + n, n);
    for (std::uint32_t s = 0; s < n; ++s) triangle(bottom, bottom - n + s, bottom - n + (s + 1) % n);
  }

  void quads(std::uint32_t row, std::uint32_t next, std::uint32_t n) {
    for (std::uint32_t s = 0; s < n; ++s) {
      triangle(row + s, row + (s + 1) % n, next + s);
      triangle(row + (s + 1) % n, next + (s + 1) % n, next + s);
    }
  }

  void sheet() {
    const int columns = 1 + bytes_.below(20), rows = 1 + bytes_.below(20);
    const double folds = bytes_.one_of({0.0, 0.1, 1.0});
    const Double3 from = in_cube(random_);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (int r = 0; r <= rows; ++r) {
      for (int c = 0; c <= columns; ++c)
        vertex(from + Double3{c * 0.1, r * 0.1, 0} + in_cube(random_) * folds);
    }
    const auto wide = static_cast<std::uint32_t>(columns + 1);
    for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(rows); ++r) {
      for (std::uint32_t c = 0; c + 1 < wide; ++c) {
        const std::uint32_t v = first + r * wide + c;
        triangle(v, v + 1, v + wide);
        triangle(v + 1, v + wide + 1, v + wide);
      }
    }
  }

  void pages() {
    const int count = 1 + bytes_.below(64);
    const std::uint32_t a = mesh_.positions.empty() ? vertex({}) : any_vertex(), b = vertex(in_cube(random_));
    for (int i = 0; i < count; ++i) triangle(a, b, vertex(in_cube(random_)));
  }

  // The last triangles once more: with their own vertices or the same, turned round or not, moved or not.
  void repeat() {
    const std::size_t most = std::min<std::size_t>(mesh_.triangles.size(), 4 * bytes_.next());
    const std::uint32_t how = bytes_.next();
    const Double3 away = how & 4 ? in_cube(random_) : Double3{};
    const std::size_t from = mesh_.triangles.size() - most;
    for (std::size_t t = from; t < from + most; ++t) {
      Triangle c = mesh_.triangles[t];
      if (how & 1) std::swap(c[0], c[1]);
      if (how & 6) {
        for (std::uint32_t& v : c) v = vertex(mesh_.positions[v] + away);
      }
      triangle(c[0], c[1], c[2]);
    }
  }

  void tie() {
    const int count = 1 + bytes_.below(32);
    if (mesh_.positions.empty()) return;
    for (int i = 0; i < count; ++i) triangle(any_vertex(), any_vertex(), any_vertex());
  }

  // Some vertices fall onto others, or all onto a lattice.
  void collapse() {
    const std::uint32_t how = bytes_.next();
    if (mesh_.positions.empty()) return;
    if (how % 4 == 0) {
      const double cells = 1 << (how / 4 % 8);
      for (Double3& p : mesh_.positions)
        p = {std::round(p.x * cells) / cells, std::round(p.y * cells) / cells,
             std::round(p.z * cells) / cells};
      return;
    }
    for (std::uint32_t i = 0; i < how; ++i) mesh_.positions[any_vertex()] = mesh_.positions[any_vertex()];
  }

  Bytes& bytes_;
  Mesh mesh_;
  Random random_{0};
  std::uint32_t part_ = 0;
};

treeprep::Options options_of(Bytes& bytes) {
  treeprep::Options options;
  options.skeleton = bytes.one_of({Skeleton::automatic, Skeleton::rings, Skeleton::surface});
  const std::uint32_t how = bytes.next();
  if ((how & 3) == 1) options.trunk_patterns = {"*"};
  if ((how & 3) == 2) options.trunk_patterns = {"bark"}, options.leaf_patterns = {"leaf"};
  if (how & 4) options.max_leaf_groups = 2;
  if ((how & 24) == 24) options.weld = 0.01;
  if ((how & 96) == 96) options.roots = {{0, 1, 0}, {1e3, 0, 0}};
  options.leaf_order = bytes.one_of({LeafOrder::group, LeafOrder::terminal, LeafOrder::random});
  return options;
}

// What a user's fault may be is no fault of the tool.
std::string wrong_refusal(const Error& error) {
  return error.fault == Fault::refused || error.fault == Fault::usage ? "" : to_line(error, "treeprep");
}

std::string wrong_tree(const Tree& tree) {
  if (const auto faults = check_tree(tree); !faults.empty()) return "the tree: " + faults.front();
  auto bytes = encode_tree(tree);
  if (!bytes) return to_line(bytes.error(), "encode_tree");
  const auto file = TreeFile::from_bytes(std::move(*bytes), "job");
  if (!file) return to_line(file.error(), "TreeFile");
  const auto loaded = file->load();
  return loaded ? "" : to_line(loaded.error(), "load");
}

}  // namespace

PrepareJob job_of_bytes(std::span<const std::uint8_t> all, std::size_t most_triangles) {
  Bytes bytes(all);
  PrepareJob job;
  job.still = bytes.below(4) == 0;
  job.options = options_of(bytes);
  const Place place = place_of(bytes);
  Builder builder(bytes);
  while (!bytes.empty() && builder.triangles() < most_triangles) builder.piece();
  job.mesh = builder.finish(place);
  return job;
}

std::vector<std::uint8_t> random_job(std::uint64_t number) {
  Random random(number);
  std::vector<std::uint8_t> bytes(8 + random.below(72));
  for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.next());
  return bytes;
}

std::string prepare_job(PrepareJob job) {
  if (const char* broken = testing::broken_promise(job.mesh)) return std::string("the job itself: ") + broken;
  CommonOptions common;
  common.quiet = true;
  ToolContext context({.name = "treeprep", .summary = {}, .examples = {}, .limits = {}}, common);
  treeprep::Input input;
  input.mesh = std::move(job.mesh);
  input.name = "job";
  if (const auto ok = treeprep::settle(input, job.options, context); !ok) return wrong_refusal(ok.error());
  const TreeKind kind = job.still ? TreeKind::still : TreeKind::sensitive;
  const auto analysis = treeprep::analyse(input, job.options, kind, {}, context);
  if (!analysis) return wrong_refusal(analysis.error());
  if (const std::string wrong = wrong_tree(analysis->assembled.tree); !wrong.empty()) return wrong;
  const CylinderError e = cylinder_error(analysis->trunk, analysis->hierarchy, bounds(input.mesh).extent().y);
  for (const double v : {e.of_radius.max, e.of_radius.rms, e.of_height.max, e.of_height.rms}) {
    if (!(v >= 0 && std::isfinite(v))) return fmt::format("an error of the cylinders is {}", v);
  }
  return {};
}

}  // namespace copse
