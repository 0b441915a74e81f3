#include "tools/treegrow/grow.h"

#include "tools/treegrow/rotation.h"

#include <algorithm>
#include <cmath>

namespace copse::grow {
namespace {

constexpr double k_pipe =
    2.2;  // area exponent of a fork: r^2.2 is what the arms share (da Vinci's rule is 2)
// Streams of a stem; children and arms have theirs by number.
constexpr std::uint64_t k_curve_key = 1, k_child_key = 2, k_tree_key = 1u << 31, k_fork_key = 1u << 30;

// What a stem needs while it grows and nobody needs afterwards.
struct Bud {
  Double3 direction;
  Double3 bend_axis;           // positive curve turns the direction about it
  std::size_t first_node = 0;  // of a whole stem of this level: forks start later
};

class Grower {
 public:
  Grower(const Species& species, const Growth& growth)
      : species_(species), growth_(growth), height_(growth.height > 0 ? growth.height : species.height) {}

  Skeleton run(std::uint64_t seed);

 private:
  void plant(std::uint32_t tree, const Random& seed);
  void plant_grass(std::uint32_t tree, const Random& seed);
  void shape(std::uint32_t index);
  bool step(Stem& stem, Bud& bud, const Level& level, std::size_t j, std::size_t count, Random& random);
  void split(std::uint32_t index, std::size_t node, std::size_t count, Random& random);
  void find_exit(Stem& stem) const;
  void branch(std::uint32_t index);
  void add_branch(std::uint32_t parent, double at, double x, double turn, Random random);
  void bear_leaves(Stem& stem);
  void measure();
  double usual_length(std::size_t level) const;
  bool is_too_large(double more_stems);
  std::size_t last_level() const { return species_.levels.size() - 1; }

  const Species& species_;
  const Growth& growth_;
  const double height_;
  double tree_height_ = 0;  // of the tree that is growing
  Skeleton skeleton_;
  std::vector<Bud> buds_;    // one a stem
  std::uint64_t nodes_ = 0;  // of all stems
};

// Billboards on a jittered grid, each a stem of its own.
void Grower::plant_grass(std::uint32_t tree, const Random& seed) {
  tree_height_ = height_;
  const double edge = species_.grass.block * height_ / species_.height;
  const double blades = std::max(1.0, std::round(species_.grass.blades * growth_.twigs));
  if (is_too_large(blades)) return;
  const auto count = static_cast<std::uint32_t>(blades);
  const auto cells = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
  const double x = edge * (tree - (growth_.trees - 1) / 2.0);
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random = seed.fork(i);
    // Every cell of the grid is as likely to stay empty: the i-th blade of `count` in cells^2 cells.
    const auto cell = static_cast<std::uint32_t>(static_cast<std::uint64_t>(i) * cells * cells / count);
    const double u = (cell % cells + random.uniform(0.1, 0.9)) / cells,
                 v = (cell / cells + random.uniform(0.1, 0.9)) / cells;
    Stem stem;
    stem.tree = tree;
    stem.random = random;
    stem.length = height_ * (1 + species_.root_depth) * random.around(1, species_.levels[0].length_v);
    stem.radius = height_ * species_.ratio * random.around(1, 0.15);
    stem.nodes = {{x + (u - 0.5) * edge, -species_.root_depth * height_, (v - 0.5) * edge}};
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    const Double3 outward{std::cos(turn), 0, std::sin(turn)};
    const double lean = random.around(0, species_.grass.lean) * k_degree;
    Bud bud;
    bud.direction = normalized(k_up * std::cos(lean) + outward * std::sin(lean));
    bud.bend_axis = perpendicular(bud.direction, cross(k_up, outward));
    skeleton_.stems.push_back(std::move(stem));
    buds_.push_back(bud);
  }
}

// Stems from the root: one in the middle, or a clump that leans outward.
void Grower::plant(std::uint32_t tree, const Random& seed) {
  Random random = seed.fork(k_tree_key);
  tree_height_ = height_ * random.around(1, species_.height_v);
  const auto count = static_cast<std::uint32_t>(std::max(1.0, std::round(species_.stems)));
  const double turn = random.uniform(0, 360);
  // Trees stand in a row, an inner crown's width apart, about the origin.
  const double x = height_ * 0.9 * (tree - (growth_.trees - 1) / 2.0);
  for (std::uint32_t i = 0; i < count; ++i) {
    Stem stem;
    stem.tree = tree;
    stem.random = seed.fork(i);
    const double angle = (turn + 137.508 * i) * k_degree;
    const Double3 outward{std::cos(angle), 0, std::sin(angle)};
    const double ring = std::sqrt((i + 0.5) / count);
    const Level& level = species_.levels[0];
    stem.length = tree_height_ * level.length * random.around(1, count > 1 ? level.length_v : 0);
    if (count > 1) stem.length *= 1 - 0.35 * ring * ring;
    stem.radius = tree_height_ * species_.ratio *
                  std::pow(stem.length / (tree_height_ * level.length), species_.ratio_power);
    Double3 foot = outward * (count > 1 ? species_.spread * tree_height_ * ring : 0);
    foot += Double3{x, -species_.root_depth * height_, 0};
    stem.nodes = {foot};
    const double lean = species_.stem_lean * (count > 1 ? ring : 1) * random.around(1, 0.3) * k_degree;
    Bud bud;
    bud.direction = normalized(k_up * std::cos(lean) + outward * std::sin(lean));
    bud.bend_axis = perpendicular(bud.direction, cross(k_up, outward));
    skeleton_.stems.push_back(std::move(stem));
    buds_.push_back(bud);
  }
}

// Grows the curve of a stem, node by node; forks are added as stems that are shaped later.
void Grower::shape(std::uint32_t index) {
  const Level& level = species_.levels[skeleton_.stems[index].level];
  const auto count = static_cast<std::size_t>(std::max(1.0, std::round(level.nodes)));
  Random random = skeleton_.stems[index].random.fork(k_curve_key);
  Bud bud = buds_[index];
  if (skeleton_.stems[index].girth.empty()) skeleton_.stems[index].girth = {1};
  const double per_node = level.splits / std::max(1.0, static_cast<double>(count) * 0.7);
  std::size_t end = count;  // a broken stem is a whole one whose growth stops early
  if (const double to = skeleton_.stems[index].to; to < 1)
    end = std::max(bud.first_node + 1, static_cast<std::size_t>(std::ceil(to * static_cast<double>(count))));
  skeleton_.stems[index].to = static_cast<double>(end) / static_cast<double>(count);
  for (std::size_t j = bud.first_node; j < end; ++j) {
    Stem& stem = skeleton_.stems[index];
    if (!step(stem, bud, level, j, count, random)) break;
    const bool may_split = j + 2 < end && static_cast<double>(j + 1) >= 0.25 * static_cast<double>(count);
    buds_[index] = bud;
    if (may_split && random.chance(per_node)) split(index, j + 1, count, random), bud = buds_[index];
  }
  Stem& stem = skeleton_.stems[index];
  stem.length = 0;
  for (std::size_t j = 1; j < stem.nodes.size(); ++j)
    stem.length += distance(stem.nodes[j - 1], stem.nodes[j]);
  const double last = static_cast<double>(stem.nodes.size() - 1);
  for (double& at : stem.splits) at /= last;  // node -> parameter
  std::erase_if(stem.splits, [](double at) { return at >= 1; });
}

// One step of the curve. False when the stem has met the ground and ends there.
bool Grower::step(Stem& stem, Bud& bud, const Level& level, std::size_t j, std::size_t count,
                  Random& random) {
  const double n = static_cast<double>(count);
  double bend = level.curve / n;
  if (level.curve_back != 0) bend = 2 * (2 * j < count ? level.curve : level.curve_back) / n;
  Double3& d = bud.direction;
  d = rotated(d, bud.bend_axis, bend * k_degree);
  const Double3 any = rotated(perpendicular(d, bud.bend_axis), d, random.uniform(0, 2 * std::numbers::pi));
  d = rotated(d, any, random.around(0, level.curve_v / std::sqrt(n)) * k_degree);
  const Double3 target = level.attraction_up >= 0 ? k_up : -k_up;
  const double lying = length(cross(d, target));
  d = turned_towards(d, target, std::abs(level.attraction_up) * lying / n);
  d = normalized(d);
  bud.bend_axis = perpendicular(d, bud.bend_axis);

  const double step = stem.length / n;
  const double floor = species_.clearance * tree_height_;
  const Double3 here = stem.nodes.back();
  if (stem.level > 0 && here.y + d.y * step < floor) {
    const bool hangs = level.attraction_up < 0 || stem.level == last_level();
    if (hangs && stem.nodes.size() >= 2) return false;
    d = normalized(Double3{d.x, std::max(0.05, (floor - here.y) / step), d.z});
    bud.bend_axis = perpendicular(d, bud.bend_axis);
  }
  if (++nodes_; is_too_large(0)) return false;
  stem.nodes.push_back(here + d * step);
  stem.girth.push_back(stem.girth.back());
  return true;
}

// The stem forks at its newest node: this stem goes on as one arm, a new stem is the other.
void Grower::split(std::uint32_t index, std::size_t node, std::size_t count, Random& random) {
  Stem& stem = skeleton_.stems[index];
  const Level& level = species_.levels[stem.level];
  Bud& bud = buds_[index];
  const double angle = random.around(level.split_angle, level.split_angle_v) * k_degree;
  const double share = random.uniform(0.4, 0.6);
  const Double3 axis = rotated(bud.bend_axis, bud.direction, random.uniform(0, 2 * std::numbers::pi));

  Stem arm;
  arm.parent = index;
  arm.tree = stem.tree;
  arm.kind = StemKind::fork;
  arm.level = stem.level;
  arm.radius = stem.radius;
  arm.length = stem.length;
  arm.parent_at = static_cast<double>(stem.nodes.size() - 1);  // a node, until the stem is whole
  arm.from = static_cast<double>(node) / static_cast<double>(count);
  arm.nodes = {stem.nodes.back()};
  arm.girth = {stem.girth.back() * std::pow(1 - share, 1 / k_pipe)};
  arm.random = stem.random.fork(k_fork_key + node);
  stem.splits.push_back(arm.parent_at);
  stem.girth.back() *= std::pow(share, 1 / k_pipe);
  Bud other = bud;
  other.first_node = node;
  other.direction = rotated(bud.direction, axis, angle * share);
  other.bend_axis = perpendicular(other.direction, other.bend_axis);
  bud.direction = rotated(bud.direction, axis, -angle * (1 - share));
  bud.bend_axis = perpendicular(bud.direction, bud.bend_axis);
  ++stem.children;
  skeleton_.stems.push_back(std::move(arm));
  buds_.push_back(other);
}

// Where the stem's middle line leaves the body of its parent.
void Grower::find_exit(Stem& stem) const {
  if (stem.kind == StemKind::root) return;
  const Stem& parent = skeleton_.stems[stem.parent];
  const Double3 at = stem_position(parent, stem.parent_at), along = stem_direction(parent, stem.parent_at);
  const double radius = stem_radius(species_, parent, stem.parent_at);
  constexpr int k_steps = 64;
  for (int i = 1; i <= k_steps / 2; ++i) {
    stem.exit = static_cast<double>(i) / k_steps;
    const Double3 p = stem_position(stem, stem.exit) - at;
    if (length(p - along * dot(p, along)) > 1.05 * radius) break;
  }
}

// Gives up when so many more stems, of at least two nodes each, would be too many.
bool Grower::is_too_large(double more_stems) {
  if (static_cast<double>(nodes_) + 2 * more_stems > static_cast<double>(growth_.most_nodes))
    skeleton_.too_large = true;
  return skeleton_.too_large;
}

// Of a stem of a level, by and large: what the number of its branches is meant for.
double Grower::usual_length(std::size_t level) const {
  double usual = tree_height_ * species_.levels[level].length;
  for (std::size_t l = 1; l < level; ++l) usual *= species_.levels[l].length * 0.7;
  return usual;
}

// Sets the stems of the next level on this one.
void Grower::branch(std::uint32_t index) {
  const std::size_t next = skeleton_.stems[index].level + 1u;
  if (next > last_level()) return;
  const Stem stem = skeleton_.stems[index];  // a copy: the stems move as branches are added
  const Level& level = species_.levels[next];
  Random random = stem.random.fork(k_child_key);
  const double bare = stem.level == 0 ? species_.envelope_bottom : level.bare;
  // The whole stem bears `branches` from `bare` to its tip; this one bears what falls to its part of it.
  const double part = stem.to - stem.from;
  const double low = std::max({bare, stem.from, stem.from + stem.exit * 1.2 * part});
  const double high = std::min(stem.to, 0.985);
  if (high <= low) return;
  double count = level.branches * (high - low) / std::max(1e-9, 0.985 - bare);
  if (stem.level > 0)
    count *= std::clamp(0.15 + 0.85 * stem.length / (part * usual_length(stem.level)), 0.15, 1.5);
  count *= next == last_level() ? growth_.twigs : growth_.branches;
  const auto whorl = std::max<std::int64_t>(1, std::llround(level.whorl));
  const std::int64_t whorls = random.round(count / static_cast<double>(whorl));
  if (is_too_large(count)) return;
  double turn = random.uniform(0, 360);
  for (std::int64_t i = 0; i < whorls * whorl; ++i) {
    const double jitter = random.around(0, whorl > 1 ? 0.12 : 0.4);
    const double share = (static_cast<double>(i / whorl) + 0.5 + jitter) / static_cast<double>(whorls);
    const double z = low + (high - low) * share;
    const double x = std::clamp((z - bare) / std::max(1e-9, 1 - bare), 0.0, 1.0);
    double towards = turn;
    if (level.rotate < 0) {
      towards = i % 2 == 0 ? level.rotate : -level.rotate;
    } else {
      const bool same_whorl = (i + 1) % whorl != 0;
      turn +=
          whorl == 1 ? level.rotate : 360.0 / static_cast<double>(whorl) + (same_whorl ? 0 : level.rotate);
    }
    towards += random.around(0, level.rotate_v);
    add_branch(index, (z - stem.from) / part, x, towards, random.fork(static_cast<std::uint64_t>(i)));
  }
}

void Grower::add_branch(std::uint32_t parent_index, double at, double x, double turn, Random random) {
  const Stem& parent = skeleton_.stems[parent_index];
  const Level& level = species_.levels[parent.level + 1u];
  Stem stem;
  stem.parent = parent_index;
  stem.tree = parent.tree;
  stem.kind = StemKind::side;
  stem.level = static_cast<std::uint8_t>(parent.level + 1);
  stem.parent_at = at;
  stem.random = random;
  const double whole = parent.length / (parent.to - parent.from);
  const double z = parent.from + at * (parent.to - parent.from);
  const double reach =
      parent.level == 0 ? whole * envelope_length(species_.envelope, x) : whole * (1 - 0.6 * z);
  stem.length = level.length * reach * random.around(1, level.length_v);
  const double there = stem_radius(species_, parent, at);
  stem.radius = std::min(0.75 * there, parent.radius * std::pow(stem.length / whole, species_.ratio_power));
  stem.radius = std::max(stem.radius, species_.min_radius * tree_height_);
  if (random.chance(species_.broken)) stem.to = random.uniform(0.25, 0.7);

  const Double3 along = stem_direction(parent, at);
  const Double3 top = perpendicular(along, std::abs(along.y) > 0.95 ? Double3{1, 0, 0} : k_up);
  const double down = (level.down_angle + (level.down_angle_top - level.down_angle) * x +
                       random.around(0, level.down_angle_v)) *
                      k_degree;
  const Double3 radial = rotated(top, along, turn * k_degree);
  Bud bud;
  bud.direction = normalized(along * std::cos(down) + radial * std::sin(down));
  bud.bend_axis = perpendicular(bud.direction, cross(bud.direction, -k_up));
  if (std::abs(bud.direction.y) > 0.98)
    bud.bend_axis = perpendicular(bud.direction, cross(bud.direction, radial));
  stem.nodes = {stem_position(parent, at)};
  ++skeleton_.stems[parent_index].children;
  skeleton_.stems.push_back(std::move(stem));
  buds_.push_back(bud);
}

void Grower::bear_leaves(Stem& stem) {
  if (species_.leaves.art == LeafArt::none || species_.leaves.count <= 0) return;
  double share = 0;
  if (stem.level == last_level()) share = 1;
  if (stem.level + 1u == last_level()) share = species_.leaves.clumps;
  stem.leaf_weight = share * stem.length;
}

void Grower::measure() {
  skeleton_.twigs = growth_.twigs;
  skeleton_.root_depth = species_.root_depth * height_;
  Double3 sum;
  double weight = 0;
  for (const Stem& stem : skeleton_.stems) {
    const Double3 tip = stem.nodes.back();
    skeleton_.height = std::max(skeleton_.height, tip.y);
    skeleton_.leaf_weight += stem.leaf_weight;
    sum += tip * stem.length;
    weight += stem.length;
  }
  if (weight > 0) skeleton_.crown_centre = sum / weight;
  // Light comes from above: the middle that normals lean away from lies in the lower crown.
  skeleton_.crown_centre.y -= 0.12 * skeleton_.height;
}

Skeleton Grower::run(std::uint64_t seed) {
  const Random random(seed);
  for (std::uint32_t tree = 0; tree < growth_.trees; ++tree) {
    const std::size_t first = skeleton_.stems.size();
    if (species_.grass.blades > 0) {
      plant_grass(tree, random.fork(tree));
    } else {
      plant(tree, random.fork(tree));
    }
    for (std::size_t i = first; i < skeleton_.stems.size(); ++i) {
      const auto index = static_cast<std::uint32_t>(i);
      if (Stem& arm = skeleton_.stems[i]; arm.kind == StemKind::fork) {
        const Stem& parent = skeleton_.stems[arm.parent];
        arm.parent_at /= static_cast<double>(parent.nodes.size() - 1);
      }
      shape(index);
      if (skeleton_.too_large) return std::move(skeleton_);
      Stem& stem = skeleton_.stems[i];
      find_exit(stem);
      bear_leaves(stem);
      branch(index);
    }
  }
  measure();
  return std::move(skeleton_);
}

}  // namespace

Skeleton grow(const Species& species, const Growth& growth, std::uint64_t seed) {
  return Grower(species, growth).run(seed);
}

}  // namespace copse::grow
