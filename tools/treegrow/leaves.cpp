#include "tools/treegrow/leaves.h"

#include "tools/treegrow/rotation.h"

#include <algorithm>
#include <cmath>

namespace copse::grow {
namespace {

constexpr std::uint64_t k_leaf_key = 30;
constexpr int k_variants = 4;  // drawings on a leaf texture, two by two

// A leaf's frame in space.
struct Pose {
  Double3 base;                // where it is held
  Double3 across, along, out;  // unit vectors: x, y, z of its shape
  double length = 0, width = 0;
};

class LeafBuilder {
 public:
  LeafBuilder(const Species& species, const Skeleton& skeleton, const Layout& layout, const Breaks& breaks,
              const Tubes& tubes, Surface& surface, Truth& truth)
      : species_(species),
        skeleton_(skeleton),
        layout_(layout),
        breaks_(breaks),
        tubes_(tubes),
        surface_(surface),
        truth_(truth),
        form_(leaf_form(breaks)),
        shape_(leaf_shape(breaks)) {}

  void run() {
    truth_.leaf_centres.reserve(layout_.leaves);
    truth_.leaf_branch.reserve(layout_.leaves);
    add_texcoords();
    for (std::size_t i = 0; i < skeleton_.stems.size(); ++i)
      if (layout_.stems[i].leaves > 0) build_stem(i);
    truth_.leaf_components = layout_.leaves * form_.components;
    truth_.leaf_triangles = layout_.leaf_triangles;
  }

 private:
  void add_texcoords();
  void build_stem(std::size_t i);
  Pose pose(const Stem& stem, std::size_t index, std::uint32_t leaf, std::uint32_t count, double turn,
            Random& random) const;
  double lowest(const Pose& pose) const;
  void add_leaf(std::size_t stem, Pose pose, std::uint32_t leaf, Random& random);
  std::uint32_t held_by(std::size_t stem, const Double3& base) const;
  void group(std::size_t stem, std::size_t first_leaf, std::uint32_t first_vertex);

  const Species& species_;
  const Skeleton& skeleton_;
  const Layout& layout_;
  const Breaks& breaks_;
  const Tubes& tubes_;
  Surface& surface_;
  Truth& truth_;
  const LeafForm form_;
  const LeafShape shape_;
  std::uint32_t first_texcoord_ = 0;  // shapes' corners, variant after variant
  std::uint32_t held_ = k_none;       // the vertex that the leaf before was held by
};

// All leaves of a variant share their texture coordinates.
void LeafBuilder::add_texcoords() {
  const bool half = breaks_.has(Break::one_material);
  for (int variant = 0; variant < k_variants; ++variant) {
    for (const LeafShape::Vertex& v : shape_.vertices) {
      // Half a texel inside the drawing's quarter, so that filtering does not reach the next one.
      const double u = (0.004 + 0.992 * v.uv.x + variant % 2) / 2,
                   w = (0.004 + 0.992 * v.uv.y + variant / 2) / 2;
      const std::uint32_t t = surface_.texcoord(half ? 0.5 + u / 2 : u, w);
      if (variant == 0 && &v == &shape_.vertices[0]) first_texcoord_ = t;
    }
  }
}

Pose LeafBuilder::pose(const Stem& stem, std::size_t index, std::uint32_t leaf, std::uint32_t count,
                       double turn, Random& random) const {
  const Foliage& f = species_.leaves;
  const double low = std::max(f.first, stem.exit);
  const double x = (leaf + random.uniform(0.2, 0.8)) / count;
  const double t = low + (1 - low) * x;
  const Double3 axis = stem_direction(stem, t);
  const Double3 top = perpendicular(axis, std::abs(axis.y) > 0.97 ? Double3{1, 0, 0} : k_up);
  const double side = f.rotate < 0 ? (leaf % 2 == 0 ? f.rotate : -f.rotate) : turn + f.rotate * leaf;
  const Double3 radial = rotated(top, axis, (side + random.around(0, f.rotate_v)) * k_degree);
  const double down = f.down_angle + (f.down_angle_top - f.down_angle) * x + random.around(0, f.down_angle_v);

  Pose p;
  const TubePlace place = tube_place(layout_, tubes_, index, t);
  p.base = place.centre + radial * (0.6 * place.radius);
  p.along = normalized(axis * std::cos(down * k_degree) + radial * std::sin(down * k_degree));
  p.along = turned_towards(p.along, -k_up, f.hang * length(cross(p.along, k_up)));
  // A blade faces along its twig, or the sky.
  const Double3 facing = normalized(perpendicular(p.along, axis) * (1 - f.face_up) + k_up * f.face_up);
  p.out = perpendicular(p.along, facing);
  p.across = cross(p.along, p.out);
  const double unit = skeleton_.height / 10 * layout_.leaf_scale * random.around(1, f.size_v);
  p.length = unit * f.length * form_.length;
  p.width = unit * f.width * form_.width;
  if (breaks_.has(Break::needles)) {
    // Needles stand all round the twig.
    const Double3 any = rotated(radial, axis, random.uniform(0, 360) * k_degree);
    p.along = normalized(axis * 0.6 + any);
    p.out = perpendicular(p.along, axis);
    p.across = cross(p.along, p.out);
    p.width = p.length / 14;
  }
  return p;
}

double LeafBuilder::lowest(const Pose& p) const {
  double y = p.base.y;
  for (const LeafShape::Vertex& v : shape_.vertices)
    y = std::min(y, p.base.y + p.across.y * v.position.x * p.width + p.along.y * v.position.y * p.length +
                        p.out.y * v.position.z * p.length);
  return y;
}

// The ring vertex of a stem nearest to a point.
std::uint32_t LeafBuilder::held_by(std::size_t stem, const Double3& base) const {
  const StemLayout& own = layout_.stems[stem];
  std::uint32_t best = k_none;
  double distance_to_best = 0;
  for (std::uint32_t r = 0; r < own.count; ++r) {
    for (std::uint32_t c = 0; c < own.k; ++c) {
      const std::uint32_t v = tubes_.first_vertex[own.first + r] + c;
      const double d = distance(surface_.placement().undo(surface_.position(v)), base);
      if (best == k_none || d < distance_to_best) best = v, distance_to_best = d;
    }
  }
  return best;
}

void LeafBuilder::add_leaf(std::size_t stem, Pose p, std::uint32_t leaf, Random& random) {
  std::uint32_t held = k_none;
  if (breaks_.has(Break::leaves_on_bark)) held = held_by(stem, p.base);
  if (breaks_.has(Break::touching_leaves) && leaf % 2 == 1) held = held_;
  const auto place = [&](const Double3& q, double swell) {
    const Double3 s{q.x * swell, 0.5 + (q.y - 0.5) * swell, q.z * swell};
    return p.across * (s.x * p.width) + p.along * (s.y * p.length) + p.out * (s.z * p.length);
  };
  if (held != k_none)
    p.base = surface_.placement().undo(surface_.position(held)) - place(shape_.vertices[0].position, 1);
  const double under = lowest(p) - 0.003 * skeleton_.height;
  if (under < 0 && held == k_none) p.base.y -= under;

  Double3 outward = normalized(p.base + p.along * (0.5 * p.length) - skeleton_.crown_centre);
  if (outward.y < -0.2) outward = normalized(Double3{outward.x, -0.2, outward.z});
  const double lean = shape_.solid ? 0 : species_.leaves.outward_normals;
  const bool away = dot(p.out, outward) < 0 && !shape_.solid;
  const auto first = surface_.last_vertex() + 1;
  Double3 centre;
  for (const LeafShape::Vertex& v : shape_.vertices) {
    const double swell = shape_.solid && &v != &shape_.vertices[0] ? random.around(1, 0.14) : 1;
    const Double3 own = p.across * v.normal.x + p.along * v.normal.y + p.out * v.normal.z;
    const Double3 normal = normalized((away ? -own : own) * (1 - lean) + outward * lean);
    const std::uint32_t index = surface_.vertex(p.base + place(v.position, swell), normal);
    if (index == first && held != k_none) surface_.move(index, surface_.position(held));
    centre += surface_.position(index);
  }
  held_ = first;
  const auto n = static_cast<std::uint32_t>(shape_.vertices.size());
  const auto variant = static_cast<std::uint32_t>(random.below(k_variants));
  const std::uint32_t texcoord = first_texcoord_ + variant * n;
  for (const auto& face : shape_.faces) {
    std::array<std::uint32_t, 8> v{}, t{};
    for (std::size_t c = 0; c < face.size(); ++c) v[c] = first + face[c], t[c] = texcoord + face[c];
    if (face.size() == 3) {
      surface_.triangle({v[0], v[1], v[2]}, {t[0], t[1], t[2]});
    } else if (face.size() == 4) {
      surface_.quad({v[0], v[1], v[2], v[3]}, {t[0], t[1], t[2], t[3]});
    } else {
      surface_.polygon(std::span(v).first(face.size()), std::span(t).first(face.size()));
    }
  }
  truth_.leaf_centres.push_back(centre / static_cast<double>(n));
  truth_.leaf_branch.push_back(static_cast<std::uint32_t>(stem));
}

// The leaves of a branch in a sphere round the mean of their centres.
void LeafBuilder::group(std::size_t stem, std::size_t first_leaf, std::uint32_t first_vertex) {
  TruthLeafGroup g;
  const std::size_t end = truth_.leaf_centres.size();
  for (std::size_t l = first_leaf; l < end; ++l) g.centre += truth_.leaf_centres[l];
  g.leaves = static_cast<std::uint32_t>(end - first_leaf);
  g.centre = g.centre / g.leaves;
  g.branch = static_cast<std::uint32_t>(stem);
  for (std::uint32_t v = first_vertex; v <= surface_.last_vertex(); ++v)
    g.radius = std::max(g.radius, distance(surface_.position(v), g.centre));
  truth_.leaf_groups.push_back(g);
}

void LeafBuilder::build_stem(std::size_t i) {
  const Stem& stem = skeleton_.stems[i];
  const std::uint32_t count = layout_.stems[i].leaves;
  const std::size_t first_leaf = truth_.leaf_centres.size();
  const std::uint32_t first_vertex = surface_.last_vertex() + 1;
  Random random = stem.random.fork(k_leaf_key);
  const double turn = random.uniform(0, 360);
  held_ = k_none;
  for (std::uint32_t leaf = 0; leaf < count; ++leaf) {
    Random own = random.fork(leaf);
    add_leaf(i, pose(stem, i, leaf, count, turn, own), leaf, own);
  }
  group(i, first_leaf, first_vertex);
}

}  // namespace

void build_leaves(const Species& species, const Skeleton& skeleton, const Layout& layout,
                  const Breaks& breaks, const Tubes& tubes, Surface& surface, Truth& truth) {
  if (layout.leaves > 0) LeafBuilder(species, skeleton, layout, breaks, tubes, surface, truth).run();
}

}  // namespace copse::grow
