#include "tests/formats/tree_maker.h"

#include "lib/formats/random.h"
#include "lib/formats/tree/tree_header.h"
#include "lib/formats/tree/tree_sections.h"
#include "lib/formats/volumes/sphere_contains.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

Float3 random_point(Random& random, double size) {
  return to_float({random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)});
}

std::vector<Float3> random_points(Random& random, std::size_t count) {
  std::vector<Float3> points(count);
  for (Float3& p : points) p = random_point(random, 1);
  return points;
}

std::vector<Float2> random_texcoords(Random& random, std::size_t count) {
  std::vector<Float2> points(count);
  for (Float2& p : points)
    p = {static_cast<float>(random.uniform()), static_cast<float>(random.uniform(-3, 3))};
  return points;
}

std::uint32_t pick(Random& random, std::uint64_t count) {
  return static_cast<std::uint32_t>(random.below(count));
}

// An index below `count`, or sometimes none; always none when there is nothing.
std::uint32_t pick_or_none(Random& random, std::uint64_t count) {
  return count == 0 || random.chance(0.1) ? k_none : pick(random, count);
}

// The step of offsets that all have the same one, else 0; with a constant the offsets are not kept.
std::uint32_t store_offsets(Indices offsets, std::uint32_t constant, Array<std::uint32_t>& stored) {
  if (offsets.size() < 2 || offsets.back() == 0) return 0;
  if (constant != 0) return constant;
  stored = std::move(offsets);
  return 0;
}

struct Areas {
  double sum = 0;
  Double3 weighted{};
  void add(const Double3& a, const Double3& b, const Double3& c) {
    const double area = 0.5 * length(cross(b - a, c - a));
    sum += area;
    weighted += (a + b + c) * (area / 3);
  }
};

class Maker {
 public:
  Maker(const TreeShape& shape, std::uint64_t seed) : shape_(shape), random_(seed) {}

  Tree make() {
    make_materials();
    make_radii();
    make_vectors();
    make_segments();
    make_leaves();
    make_groups();
    h_.kind = shape_.kind;
    h_.leaf_order = shape_.leaf_order;
    h_.bounds.grow(h_.trunk_bounds);
    h_.origin = {1e6, 0.25, -3};
    tree_.provenance = R"({"tool":"test"})";
    if (shape_.kind == TreeKind::still) {
      tree_.hierarchy = {};
      h_.monotone = false, h_.roots = h_.ring_size = 0;
    }
    return std::move(tree_);
  }

 private:
  void make_materials() {
    for (std::uint32_t i = 0; i < shape_.textures; ++i) {
      Texture t{.uri = i % 2 ? "bark" + std::to_string(i) + ".png" : "",
                .mime = i % 3 ? "image/png" : "",
                .bytes = {}};
      if (i % 2 == 0) t.bytes.assign(1 + i, static_cast<std::uint8_t>(7 * i + 1));
      tree_.textures.push_back(std::move(t));
    }
    for (std::uint32_t i = 0; i < shape_.materials; ++i) {
      Material m;
      m.name = std::string(i, static_cast<char>('a' + i));
      m.diffuse = {0.1f, 0.2f, static_cast<float>(random_.uniform())};
      m.shininess = static_cast<float>(i);
      m.double_sided = i % 2;
      m.texture = pick_or_none(random_, shape_.textures);
      m.alpha_coverage = static_cast<float>(random_.uniform(0.25, 1));
      tree_.materials.push_back(std::move(m));
    }
  }

  void make_radii() {
    const std::uint32_t roots = std::min(shape_.roots, shape_.radii);
    radii_.resize(shape_.radii);
    centres_.resize(shape_.radii);
    parent_.assign(shape_.radii, k_none);
    h_.roots = roots;
    h_.monotone = shape_.radii > 0;
    std::uint32_t next = roots;
    for (std::uint32_t i = 0; i < shape_.radii; ++i) {
      Radius& r = radii_[i];
      Double3 base{};
      r.centre = random_point(random_, 2);
      if (i >= roots) {
        base = centres_[parent_[i]];
        r.distance = static_cast<float>(length(to_double(r.centre)));
        if (shape_.joints && random_.below(shape_.joints) == 0) r.flags |= Radius::joint;
      }
      centres_[i] = base + to_double(r.centre);
      r.diameter = 0.25f * static_cast<float>(random_.below(8));  // many ties
      if (i >= roots && r.diameter > radii_[parent_[i]].diameter) h_.monotone = false;
      const std::uint32_t least = next == i + 1 && next < shape_.radii ? 1 : 0;
      const auto children = std::min<std::uint32_t>(shape_.radii - next, least + pick(random_, 3));
      if (children == 0) {
        r.flags |= Radius::terminal;
        continue;
      }
      r.first_child = next;
      r.child_count = children;
      for (std::uint32_t c = 0; c < children; ++c) parent_[next++] = i;
    }
  }

  void make_vectors() {
    first_vector_ = {0};
    std::vector<Float3> vectors;
    for (std::size_t i = 0; i < radii_.size(); ++i) {
      const std::uint32_t count = shape_.ring ? shape_.ring : 1 + pick(random_, 5);
      double reach = 0;
      for (std::uint32_t v = 0; v < count; ++v) {
        vectors.push_back(random_point(random_, 0.3));
        reach = std::max(reach, length(to_double(vectors.back())));
        positions_.push_back(to_float(centres_[i] + to_double(vectors.back())));
        h_.trunk_bounds.grow(positions_.back());
      }
      radii_[i].outer_radius = round_up(reach * (1 + 1e-15));
      first_vector_.push_back(static_cast<std::uint32_t>(vectors.size()));
    }
    h_.ring_size = store_offsets(first_vector_, shape_.ring, tree_.hierarchy.first_vector);
    tree_.hierarchy.vectors = std::move(vectors);
  }

  std::uint32_t vertex_of(std::uint32_t radius) {
    return first_vector_[radius] + pick(random_, first_vector_[radius + 1] - first_vector_[radius]);
  }

  CornerTriangle corners(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    CornerTriangle t{.vertex = {a, b, c}};
    const std::uint32_t columns = k_columns;
    for (std::size_t i = 0; i < 3; ++i) {
      t.normal[i] = pick_or_none(random_, shape_.normals ? columns : 0);
      t.texcoord[i] = pick_or_none(random_, shape_.texcoords ? columns : 0);
    }
    return t;
  }

  void make_segments() {
    Trunk& trunk = tree_.trunk;
    Indices child;
    for (std::uint32_t r = h_.roots; r < radii_.size(); ++r) {
      if (!(radii_[r].flags & Radius::joint)) child.push_back(r);
    }
    const auto diameter = [&](std::uint32_t r) {
      return std::max(radii_[r].diameter, radii_[parent_[r]].diameter);
    };
    std::sort(child.begin(), child.end(),
              [&](auto a, auto b) { return std::pair(diameter(a), a) < std::pair(diameter(b), b); });
    std::vector<CornerTriangle> triangles;
    std::vector<std::array<std::uint32_t, 2>> lines;
    std::vector<float> diameters;
    std::vector<double> sums;
    Indices first{0}, materials;
    Areas areas;
    double sum = 0;
    for (const std::uint32_t r : child) {
      const std::uint32_t count = shape_.segment ? shape_.segment : pick(random_, 5);
      for (std::uint32_t t = 0; t < count; ++t) {
        // In this order whatever the compiler: arguments have none.
        const std::uint32_t a = vertex_of(parent_[r]), b = vertex_of(r),
                            c = vertex_of(t % 2 ? r : parent_[r]);
        triangles.push_back(corners(a, b, c));
        materials.push_back(pick_or_none(random_, shape_.materials));
        const auto& v = triangles.back().vertex;
        areas.add(to_double(positions_[v[0]]), to_double(positions_[v[1]]), to_double(positions_[v[2]]));
      }
      first.push_back(static_cast<std::uint32_t>(triangles.size()));
      lines.push_back({parent_[r], r});
      diameters.push_back(diameter(r));
      sums.push_back(sum += distance(centres_[r], centres_[parent_[r]]));
    }
    if (!triangles.empty()) {
      h_.mean_trunk_area = static_cast<float>(areas.sum / static_cast<double>(triangles.size()));
      if (areas.sum > 0) h_.area_density_centre = to_float(areas.weighted / areas.sum);
      trunk.normals = random_points(random_, shape_.normals ? k_columns : 0);
      trunk.texcoords = random_texcoords(random_, shape_.texcoords ? k_columns : 0);
      h_.unexplained = pick(random_, triangles.size());
    }
    h_.segment_factor = store_offsets(first, shape_.segment, trunk.first_triangle);
    trunk.triangles = std::move(triangles);
    trunk.diameters = std::move(diameters);
    trunk.accumulated_lengths = std::move(sums);
    if (shape_.one_material && shape_.materials > 0) {
      trunk.material = 0;
    } else {
      trunk.materials = std::move(materials);
    }
    if (shape_.kind == TreeKind::still) {
      std::vector<Float3> ends;
      for (const Double3& c : centres_) ends.push_back(to_float(c));
      trunk.line_vertices = std::move(ends);
      trunk.vertices = positions_;
    }
    trunk.lines = std::move(lines);
  }

  void make_leaves() {
    Leaves& leaves = tree_.leaves;
    std::vector<CornerTriangle> triangles;
    std::vector<Float3> vertices, centres;
    Indices first{0}, materials;
    for (std::uint32_t leaf = 0; leaf < shape_.leaves; ++leaf) {
      const Float3 middle = random_point(random_, 3);
      const std::uint32_t count = shape_.leaf ? shape_.leaf : 1 + pick(random_, 3);
      materials.push_back(pick_or_none(random_, shape_.materials));
      if (shape_.one_material && shape_.materials > 0) materials.back() = shape_.materials - 1;
      const double share =
          materials.back() == k_none ? 1.0 : double{tree_.materials[materials.back()].alpha_coverage};
      Areas areas;
      Double3 sum{};
      for (std::uint32_t t = 0; t < count; ++t) {
        const auto v = static_cast<std::uint32_t>(vertices.size());
        for (int i = 0; i < 3; ++i) {
          vertices.push_back(middle + random_point(random_, 0.1));
          h_.bounds.grow(vertices.back());
          sum += to_double(vertices.back());
        }
        triangles.push_back(corners(v, v + 1, v + 2));
        areas.add(to_double(vertices[v]), to_double(vertices[v + 1]), to_double(vertices[v + 2]));
      }
      leaf_areas_.push_back(share * areas.sum);
      centres.push_back(to_float(sum / (3.0 * count)));
      first.push_back(static_cast<std::uint32_t>(triangles.size()));
    }
    first_leaf_triangle_ = first;
    if (shape_.leaves > 0) {
      leaves.normals = random_points(random_, shape_.normals ? k_columns : 0);
      leaves.texcoords = random_texcoords(random_, shape_.texcoords ? k_columns : 0);
      h_.mean_leaf_area =
          static_cast<float>(std::accumulate(leaf_areas_.begin(), leaf_areas_.end(), 0.0) / shape_.leaves);
    }
    h_.leaf_factor = store_offsets(first, shape_.leaf, leaves.first_triangle);
    leaves.triangles = std::move(triangles);
    leaves.vertices = std::move(vertices);
    leaves.centres = std::move(centres);
    if (shape_.one_material && shape_.materials > 0) {
      leaves.material = shape_.materials - 1;
    } else {
      leaves.materials = std::move(materials);
    }
  }

  void make_groups() {
    const std::uint32_t count = std::min(shape_.groups, shape_.leaves);
    Leaves& leaves = tree_.leaves;
    if (count > 0) {
      Indices order(shape_.leaves);
      std::iota(order.begin(), order.end(), 0u);
      random_.shuffle(std::span(order));
      for (std::uint32_t g = 0; g < count; ++g) {
        const std::uint32_t begin = static_cast<std::uint32_t>(std::uint64_t{g} * shape_.leaves / count);
        const std::uint32_t end = static_cast<std::uint32_t>((std::uint64_t{g} + 1) * shape_.leaves / count);
        groups_.push_back(make_group(std::span(order).subspan(begin, end - begin), begin));
      }
      leaves.order = std::move(order);
      nodes_.reserve(2 * count);
      make_nodes(0, count);
    }
    std::uint32_t next = 0;
    for (Radius& r : radii_) {
      if (r.flags & Radius::terminal && next < count && random_.chance(0.8))
        r.child_count = 1, r.first_child = next++;
    }
    leaves.groups = groups_;
    leaves.group_hierarchy = nodes_;
    tree_.hierarchy.radii = radii_;
  }

  LeafGroup make_group(std::span<std::uint32_t> members, std::uint32_t first) {
    const Leaves& leaves = tree_.leaves;
    LeafGroup group{.first = first, .count = static_cast<std::uint32_t>(members.size())};
    Double3 sum{};
    double area = 0;
    for (const std::uint32_t leaf : members)
      sum += to_double(leaves.centres[leaf]), area += leaf_areas_[leaf];
    group.centre = to_float(sum / static_cast<double>(members.size()));
    group.mean_area = static_cast<float>(area / static_cast<double>(members.size()));
    for (const std::uint32_t leaf : members) {
      for (std::uint32_t t = first_leaf_triangle_[leaf]; t < first_leaf_triangle_[leaf + 1]; ++t) {
        for (const std::uint32_t v : leaves.triangles[t].vertex)
          enclose(group.centre, group.radius, leaves.vertices[v], 0);
      }
    }
    if (shape_.leaf_order == LeafOrder::group) {
      std::sort(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto d = [&](std::uint32_t leaf) {
          return distance(to_double(leaves.centres[leaf]), to_double(group.centre));
        };
        return std::pair(d(a), a) < std::pair(d(b), b);
      });
    }
    return group;
  }

  static void enclose(const Float3& centre, float& radius, const Float3& inner, float inner_radius) {
    radius =
        std::max(radius, static_cast<float>(distance(to_double(inner), to_double(centre)) + inner_radius));
    while (!sphere_contains(centre, radius, inner, inner_radius)) {
      radius = std::nextafter(radius, std::numeric_limits<float>::infinity());
    }
  }

  // Halves, depth first. The depth is the logarithm of the number of groups.
  std::size_t make_nodes(std::uint32_t begin, std::uint32_t end) {
    const std::size_t node = nodes_.size();
    nodes_.emplace_back();
    if (end - begin == 1) {
      const LeafGroup& g = groups_[begin];
      nodes_[node] = {.centre = g.centre,
                      .radius = g.radius,
                      .skip = static_cast<std::uint32_t>(node + 1),
                      .group = begin};
      return node;
    }
    const std::uint32_t middle = begin + (end - begin) / 2;
    GroupNode sphere;
    const std::size_t left = make_nodes(begin, middle), right = make_nodes(middle, end);
    sphere.centre = nodes_[left].centre;
    for (const std::size_t child : {left, right})
      enclose(sphere.centre, sphere.radius, nodes_[child].centre, nodes_[child].radius);
    sphere.skip = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node] = sphere;
    return node;
  }

  static constexpr std::uint32_t k_columns = 9;  // normals and texture coordinates of each section
  const TreeShape& shape_;
  Random random_;
  Tree tree_;
  TreeHeader& h_ = tree_.header;
  std::vector<Radius> radii_;
  std::vector<Double3> centres_;
  Indices parent_, first_vector_, first_leaf_triangle_;
  std::vector<Float3> positions_;
  std::vector<double> leaf_areas_;
  std::vector<LeafGroup> groups_;
  std::vector<GroupNode> nodes_;
};

}  // namespace

Tree make_tree(const TreeShape& shape, std::uint64_t seed) {
  return Maker(shape, seed).make();
}

bool same(const Tree& a, const Tree& b) {
  if (!(a.header == b.header && a.materials == b.materials && a.textures == b.textures &&
        a.provenance == b.provenance && a.trunk.material == b.trunk.material &&
        a.leaves.material == b.leaves.material)) {
    return false;
  }
  std::vector<std::string> bytes_a, bytes_b;
  const auto collect = [](std::vector<std::string>& bytes) {
    return [&](std::string_view, const auto& array, std::uint64_t, Presence) {
      bytes.emplace_back(reinterpret_cast<const char*>(array.data()), array.span().size_bytes());
    };
  };
  for_each_array(a, {.header = a.header, .counts = {}}, collect(bytes_a));
  for_each_array(b, {.header = b.header, .counts = {}}, collect(bytes_b));
  return bytes_a == bytes_b;
}

}  // namespace copse
