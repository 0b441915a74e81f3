// How an engine draws a scene whose things move (docs/runtime.md, "A scene that moves"), over what bvfit has
// stored: UpperIndex above the things, the stored hierarchy below each, Sentinels where a part has left the
// pose that the nodes were fitted to.
#include "lib/analysis/tree/tree_parts.h"
#include "lib/formats/container/atomic_file.h"
#include "lib/formats/random.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_volumes.h"
#include "lib/runtime/sentinels.h"
#include "lib/runtime/upper_index.h"
#include "lib/runtime/volume_tests.h"
#include "tests/formats/tree_maker.h"
#include "tests/tools/process.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

// --- the engine's half

// Many trees of one file, each at a place of its own, with parts that may be away from their pose.
struct Thing {
  Float3 place;
  Sentinels away;
  std::map<std::uint32_t, Float3> moved;  // bottom node -> by how much
};

// Planes as something sees them that is moved by `by`.
std::vector<FloatPlane> seen_from(std::span<const FloatPlane> planes, const Float3& by) {
  std::vector<FloatPlane> out(planes.begin(), planes.end());
  for (FloatPlane& p : out) p.offset += dot(p.normal, by);
  return out;
}

// Calls visit(item) for every part of the thing that no plane in `mask` keeps out.
template <class Visit>
void visible_parts(const TreeVolumes& tree, const Thing& thing, std::span<const FloatPlane> planes,
                   std::uint32_t mask, Visit&& visit) {
  const std::vector<FloatPlane> here = seen_from(planes, thing.place);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open;  // end of a node's run, planes undecided in it
  for (std::uint32_t i = 0; i < tree.nodes.size();) {
    while (!open.empty() && open.back().first <= i) open.pop_back();
    std::uint32_t left = open.empty() ? mask : open.back().second;
    const VolumeNode& node = tree.nodes[i];
    const bool is_bottom = node.item != k_none;
    const auto moved = thing.moved.find(i);
    const bool is_moved = moved != thing.moved.end();
    // What is above a part that is away cannot be trusted: what is below decides.
    if (is_bottom || !thing.away.is_stale(i)) {
      const Volume<float> volume = tree.chosen(tree.sets[node.set]);
      // A part that is away may be where the planes of its node were decided otherwise: it asks them all.
      const bool outside =
          is_moved ? in_frustum(volume, seen_from(here, moved->second), left = mask) == Visibility::outside
                   : in_frustum(volume, here, left) == Visibility::outside;
      if (outside) {
        i = node.skip;
        continue;
      }
    }
    if (is_bottom) visit(node.item);
    open.emplace_back(node.skip, left);
    ++i;
  }
}

// --- the scene

class MovingScene : public testing::Test {
 protected:
  void SetUp() override {
    const auto bytes = encode_tree(
        make_tree({.radii = 30, .leaves = 60, .groups = 12, .ring = 5, .segment = 10, .leaf = 2}, 3));
    ASSERT_TRUE(bytes);
    ASSERT_TRUE(write_file(folder_.path() / "oak.stree", std::span<const std::uint8_t>(*bytes)));
    const Outcome fitted = run_process({"bvfit", folder_.file("oak.stree"), "--per", "groups", "--hierarchy",
                                        "kd2", "--quality", "fast", "-q", "-o", folder_.file("bv.stree")});
    ASSERT_EQ(fitted.status, 0) << fitted.err;
    const auto file = TreeFile::open(folder_.path() / "bv.stree");
    ASSERT_TRUE(file);
    tree_ = file->load().value();
    volumes_ = load_volumes(*file).value();
    ASSERT_FALSE(volumes_.nodes.empty());
    for (std::uint32_t i = 0; i < volumes_.nodes.size(); ++i) {
      if (volumes_.nodes[i].item != k_none) bottoms_.push_back(i);
    }
  }

  std::vector<Thing> some_things(Random& random) const {
    std::vector<Thing> things;
    for (int i = 0; i < 20; ++i) {
      things.push_back({to_float(Double3{random.around(0, 40), random.around(0, 5), random.around(0, 40)}),
                        Sentinels(volumes_.nodes.span()),
                        {}});
      for (int k = 0; k < i % 4; ++k) {
        const std::uint32_t part = bottoms_[random.below(bottoms_.size())];
        const Double3 by{random.around(0, 30), random.around(0, 30), random.around(0, 30)};
        things.back().moved[part] = to_float(by);
        things.back().away.leave(part);
      }
    }
    return things;
  }

  // Of the thing with its parts where they are now.
  FloatBox box_of(const Thing& thing) {
    DoubleBox box;
    for (const std::uint32_t i : bottoms_) {
      for (const Double3& p : points_of(thing, i)) box.grow(p);
    }
    return round_outward(box);
  }

  std::vector<Double3> points_of(const Thing& thing, std::uint32_t bottom) {
    TreeParts parts(tree_);
    std::vector<Double3> out;
    const auto moved = thing.moved.find(bottom);
    const Double3 by =
        to_double(thing.place) + (moved != thing.moved.end() ? to_double(moved->second) : Double3{});
    for (const std::uint32_t p : parts.part(VolumePart::group, volumes_.nodes[bottom].item).points)
      out.push_back(parts.points()[p] + by);
    return out;
  }

  TemporaryFolder folder_;
  Tree tree_;
  TreeVolumes volumes_;
  std::vector<std::uint32_t> bottoms_;
};

std::vector<FloatPlane> some_frustum(Random& random) {
  std::vector<FloatPlane> planes;
  const Double3 eye{random.around(0, 30), random.around(0, 10), random.around(0, 30)};
  for (int i = 0; i < 4; ++i) {
    const Double3 n = normalized(Double3{random.around(0, 1), random.around(0, 1), random.around(0, 1)});
    planes.push_back({to_float(n), static_cast<float>(-dot(n, eye))});
  }
  return planes;
}

bool is_inside(std::span<const FloatPlane> planes, const Double3& p) {
  constexpr double k_margin = 1e-3;  // of the float32 in which planes are moved
  return std::all_of(planes.begin(), planes.end(), [&](const FloatPlane& plane) {
    return dot(to_double(plane.normal), p) + plane.offset > k_margin;
  });
}

TEST_F(MovingScene, NoPartThatIsInViewIsMissedWhereverThingsAndPartsHaveGone) {
  Random random(5);
  std::size_t seen = 0, visited = 0, all = 0;
  for (int frame = 0; frame < 10; ++frame) {
    const std::vector<Thing> things = some_things(random);
    UpperIndex index(static_cast<std::uint32_t>(things.size()));
    for (std::uint32_t t = 0; t < things.size(); ++t) index.place(t, box_of(things[t]));
    index.update();
    const std::vector<FloatPlane> planes = some_frustum(random);
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    index.in_frustum(planes, 15, [&](std::uint32_t thing, std::uint32_t mask) {
      visible_parts(volumes_, things[thing], planes, mask, [&](std::uint32_t item) {
        found.insert({thing, item});
      });
    });
    visited += found.size();
    for (std::uint32_t t = 0; t < things.size(); ++t) {
      for (const std::uint32_t bottom : bottoms_) {
        const std::vector<Double3> points = points_of(things[t], bottom);
        const bool in_view =
            std::any_of(points.begin(), points.end(), [&](const Double3& p) { return is_inside(planes, p); });
        seen += in_view, ++all;
        if (in_view) {
          EXPECT_TRUE(found.contains({t, volumes_.nodes[bottom].item})) << "thing " << t;
        }
      }
    }
  }
  EXPECT_GT(seen, 0u);
  EXPECT_LT(visited, all / 2) << "nothing was left out";
}

}  // namespace
}  // namespace copse
