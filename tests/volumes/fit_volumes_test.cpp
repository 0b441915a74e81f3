#include "lib/analysis/volumes/fit_volumes.h"

#include "lib/analysis/volumes/certify.h"
#include "tests/volumes/point_sets.h"

#include <algorithm>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

std::vector<FittedVolume> fit_all(const Points& points, const FitOptions& options = {},
                                  const Triangles& triangles = {}) {
  const auto fitter = VolumeFitter::make(points, triangles);
  EXPECT_TRUE(fitter) << fitter.error().what;
  std::vector<FittedVolume> out;
  for (const FitMethod& m : fit_methods()) {
    auto v = fitter->fit(m, options);
    EXPECT_TRUE(v) << name_of(m.kind) << " " << m.name;
    if (v) out.push_back(std::move(*v));
  }
  return out;
}
const FittedVolume& of(const std::vector<FittedVolume>& all, VolumeKind kind, std::string_view method) {
  return *std::find_if(all.begin(), all.end(), [&](const FittedVolume& v) {
    return v.method.kind == kind && v.method.name == method;
  });
}

TEST(FitVolumes, EveryKindHasAMethodThatSearchesAndNamesAreUnique) {
  std::set<std::pair<VolumeKind, std::string_view>> names;
  std::set<VolumeKind> searched;
  for (const FitMethod& m : fit_methods()) {
    EXPECT_TRUE(names.insert({m.kind, m.name}).second) << m.name;
    EXPECT_LE(m.name.size(), 23u);  // a file holds 24 characters
    if (m.least) searched.insert(m.kind);
  }
  for (const auto& [kind, name] : names) EXPECT_TRUE(searched.contains(kind)) << name_of(kind);
}

TEST(FitVolumes, NoPointOfTheWholeBatteryIsOutsideAnyVolumeAsStored) {
  for (const NamedPoints& set : float32_battery()) {
    for (const FittedVolume& v : fit_all(set.points)) {
      EXPECT_TRUE(v.certified) << set.name << ": " << name_of(v.method.kind) << " " << v.method.name;
      EXPECT_TRUE(certify(v.volume, set.points).holds())
          << set.name << ": " << name_of(v.method.kind) << " " << v.method.name;
      EXPECT_LE(v.lower_bound, v.fitted) << set.name << " " << name_of(v.method.kind) << " " << v.method.name;
      EXPECT_LE(v.fitted, v.measures.volume)
          << set.name << ": " << name_of(v.method.kind) << " " << v.method.name;
    }
  }
}

// Whether what the search gives is, as stored, at most as large as all that is a case of it.
void expect_searches_least(const Points& points, const std::string& name) {
  const auto all = fit_all(points);
  double reach = 0;
  for (const Double3& p : points) reach = std::max(reach, length(p));
  for (const FittedVolume& searched : all) {
    if (!searched.method.least || searched.method.kind == VolumeKind::kdop) continue;
    const VolumeKind kind = searched.method.kind;
    for (const FittedVolume& other : all) {
      const bool ball = other.method.kind == VolumeKind::sphere && kind == VolumeKind::capsule;
      const bool swept =
          kind == VolumeKind::lozenge && other.method.least &&
          (other.method.kind == VolumeKind::sphere || other.method.kind == VolumeKind::capsule);
      if (other.method.kind != kind && !ball && !swept) continue;
      // The same body in another type has other numbers, which round otherwise.
      const double unit = kind == other.method.kind ? 0 : 4 * 0x1p-23 * reach * other.measures.surface;
      EXPECT_LE(searched.measures.volume, other.measures.volume * (1 + (unit > 0 ? 1e-6 : 0)) + unit)
          << name << ": " << name_of(kind) << " " << name_of(other.method.kind) << " " << other.method.name;
    }
  }
}

TEST(FitVolumes, TheSearchIsNeverWorseThanTheQuickMethodsAsStored) {
  for (const NamedPoints& set : float32_battery()) {
    expect_searches_least(set.points, set.name);
    Points far = set.points, flat = set.points;
    for (Double3& p : far) p += Double3{5e4, -3e4, 7e4};
    for (Double3& p : flat) p = {p.x + p.y, p.y - 0.3 * p.x, 0.4 * p.x + 1.7 * p.y};
    expect_searches_least(far, set.name + " far");
    expect_searches_least(flat, set.name + " flattened");
    for (Double3& p : flat) p += Double3{3000, 100, -700};
    expect_searches_least(flat, set.name + " flattened and far");
  }
}

TEST(FitVolumes, TheMinimalSpheresSupportIsOnItAndHoldsIt) {
  for (const NamedPoints& set : float32_battery()) {
    const auto all = fit_all(set.points);
    const FittedVolume& ball = of(all, VolumeKind::sphere, "minimal");
    ASSERT_GE(ball.support.size(), 1u) << set.name;
    ASSERT_LE(ball.support.size(), 4u) << set.name;
    const auto& sphere = std::get<BoundingSphere<float>>(ball.volume);
    double size = 0;
    for (const Double3& p : set.points) size = std::max(size, length(p));
    for (const Double3& p : ball.support) {
      EXPECT_NE(std::find(set.points.begin(), set.points.end(), p), set.points.end()) << set.name;
      EXPECT_NEAR(distance(p, to_double(sphere.centre)), sphere.radius, 1e-6 * size + 2e-45) << set.name;
    }
    const auto alone = fit_all(ball.support);
    EXPECT_NEAR(std::get<BoundingSphere<float>>(of(alone, VolumeKind::sphere, "minimal").volume).radius,
                sphere.radius, 1e-6 * size + 2e-45)
        << set.name;
  }
}

TEST(FitVolumes, KnownVolumesAreFound) {
  const auto cube = fit_all(cube_corners());
  EXPECT_NEAR(of(cube, VolumeKind::sphere, "minimal").measures.volume, 2.720699046, 1e-6);
  EXPECT_NEAR(of(cube, VolumeKind::obb, "minimal").measures.volume, 1, 1e-6);
  EXPECT_LE(of(cube, VolumeKind::capsule, "minimal").measures.volume, 2.63945038 * 1.001);
  EXPECT_LE(of(cube, VolumeKind::lozenge, "minimal").measures.volume, 2.444035895 * 1.002);
  const auto torus = fit_all(copse::torus(40, 32, 0.5, 0.125));
  EXPECT_NEAR(of(torus, VolumeKind::sphere, "minimal").measures.volume, 1.022653859, 1e-6);
  EXPECT_LE(of(torus, VolumeKind::obb, "minimal").measures.volume, 0.388220379 * 1.0001);
  EXPECT_LE(of(torus, VolumeKind::lozenge, "minimal").measures.volume, 0.35435676 * 1.002);
  const auto line = fit_all(copse::line(50, {0.1, 0.2, 0.3}));
  EXPECT_NEAR(of(line, VolumeKind::sphere, "minimal").measures.volume, 3226.851027, 1e-2);
}

// The least of a kind, as the tool keeps it of all methods of a quality.
double least_of(const Points& points, VolumeKind kind, FitQuality quality) {
  const auto fitter = VolumeFitter::make(points);
  double least = std::numeric_limits<double>::infinity();
  for (const FitMethod& m : fit_methods()) {
    if (m.kind != kind || (quality == FitQuality::fast ? !m.quick || m.on_hull : !m.least)) continue;
    if (const auto v = fitter->fit(m, {quality})) least = std::min(least, v->measures.volume);
  }
  return least;
}

TEST(FitVolumes, NoOrientedBoxIsLargerThanTheOneAlongTheAxesAtAnyQuality) {
  for (const NamedPoints& set : float32_battery()) {
    const auto fitter = VolumeFitter::make(set.points);
    const FittedVolume upright = *fitter->fit(fit_methods()[0]);
    ASSERT_EQ(upright.method.kind, VolumeKind::aabb);
    double reach = 0;
    for (const Double3& p : set.points) reach = std::max(reach, length(p));
    // The middle of a box along the axes is rounded where its corners are not.
    const double unit = 2 * 0x1p-23 * reach * upright.measures.surface;
    for (const FitQuality quality : {FitQuality::fast, FitQuality::balanced, FitQuality::exact}) {
      EXPECT_LE(least_of(set.points, VolumeKind::obb, quality), upright.measures.volume + unit)
          << set.name << " at quality " << static_cast<int>(quality);
    }
  }
}

// A closed surface over some of the points: what the method that weighs the surface goes by.
Triangles triangles_over(const Points& points) {
  const ConvexHull hull = convex_hull(make_point_cloud(points).value());
  Triangles out;
  for (const auto& f : hull.faces)
    out.push_back({hull.indices[f[0]], hull.indices[f[1]], hull.indices[f[2]]});
  return out;
}

std::string label(const FittedVolume& v) {
  return fmt::format("{} {}", name_of(v.method.kind), v.method.name);
}

TEST(FitVolumes, NotOneByteOfAnyMethodDependsOnTheOrderOrRepetitionOfThePoints) {
  for (const Points& points :
       {turned(twig(10)), random_cloud(9, 300, {1, 0.5, 2}), lattice(9, 3), copse::torus(20, 12, 0.5, 0.2),
        turned(grid(10, 7, {1, 0, 0}, {0, 1, 0})), random_cloud(10, 9000, {1, 1, 1})}) {
    Triangles triangles = triangles_over(points);
    const auto before = fit_all(points, {}, triangles);
    Random random(1);
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    random.shuffle(std::span(order));
    Points shuffled(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) shuffled[order[i]] = points[i];
    shuffled.insert(shuffled.end(), points.begin(), points.begin() + 4);
    for (auto& t : triangles) {
      for (std::uint32_t& v : t) v = order[v];
    }
    random.shuffle(std::span(triangles));
    const auto after = fit_all(shuffled, {}, triangles);
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(before[i].volume, after[i].volume) << label(before[i]) << " of " << points.size();
      EXPECT_EQ(before[i].lower_bound, after[i].lower_bound) << label(before[i]) << " of " << points.size();
    }
  }
}

// Where of equally far points the first is taken, small sets tell.
TEST(FitVolumes, NotOneByteOfSmallSetsDependsOnTheOrder) {
  Random random(4);
  for (int round = 0; round < 200; ++round) {
    Points points;
    for (int i = 0; i < 6; ++i)
      points.push_back(
          {double(random.below(14)) - 7, double(random.below(14)) - 7, double(random.below(14)) - 7});
    Points other(points.rbegin(), points.rend());
    const auto a = VolumeFitter::make(points), b = VolumeFitter::make(other);
    for (const FitMethod& m : fit_methods()) {
      if (!m.quick) continue;
      const auto one = a->fit(m), two = b->fit(m);
      ASSERT_TRUE(one && two);
      EXPECT_EQ(one->volume, two->volume) << label(*one) << " of set " << round;
      EXPECT_EQ(one->fitted, two->fitted) << label(*one) << " of set " << round;
    }
  }
}

TEST(FitVolumes, NoQuickCapsuleIsLargerThanTheBallNorQuickLozengeThanTheCapsule) {
  for (const NamedPoints& set : mixed_sets()) {
    const auto fitter = VolumeFitter::make(set.points);
    const auto volume = [&](VolumeKind kind, const char* name) {
      for (const FitMethod& m : fit_methods()) {
        if (m.kind == kind && m.name == name) return fitter->fit(m)->measures.volume;
      }
      return 0.0;
    };
    const double ball = volume(VolumeKind::sphere, "minimal"),
                 capsule = volume(VolumeKind::capsule, "least-squares"), room = 1 + 1e-5;
    EXPECT_LE(capsule, ball * room) << set.name;
    EXPECT_LE(volume(VolumeKind::lozenge, "gaussian"), capsule * room) << set.name;
  }
}

// Powers of two change no digit of a coordinate, so that they may change none of the fit either.
TEST(FitVolumes, ScaleByAPowerOfTwoChangesNothingButTheExponentsOfAnyMethod) {
  const Points points = turned(random_cloud(3, 200, {1, 2, 4}));
  const Triangles triangles = triangles_over(points);
  const auto base = fit_all(points, {}, triangles);
  for (const double scale : {0x1p-100, 0x1p100}) {  // 1e-30 and 1e30
    const auto scaled = fit_all(copse::scaled(points, scale), {}, triangles);
    ASSERT_EQ(scaled.size(), base.size());
    for (std::size_t i = 0; i < base.size(); ++i) {
      const std::vector<float> a = numbers_of(base[i].volume), b = numbers_of(scaled[i].volume);
      for (std::size_t k = 0; k < a.size(); ++k) {
        // Axes and normals have no length.
        const bool same = b[k] == static_cast<float>(a[k] * scale) || b[k] == a[k];
        EXPECT_TRUE(same) << label(base[i]) << " number " << k << " at scale " << scale << ": " << a[k] << " "
                          << b[k];
      }
      EXPECT_EQ(scaled[i].measures.volume, base[i].measures.volume * scale * scale * scale) << label(base[i]);
    }
  }
}

TEST(FitVolumes, OtherScalesChangeNothingButRoundingOfAnyMethod) {
  const Points points = turned(random_cloud(3, 200, {1, 2, 4}));
  const auto base = fit_all(points);
  for (const double scale : {1e-30, 3.7e-7, 1e30}) {
    const auto scaled = fit_all(copse::scaled(points, scale));
    for (std::size_t i = 0; i < base.size(); ++i) {
      const double volume = scaled[i].measures.volume / scale / scale / scale;
      EXPECT_NEAR(volume / base[i].measures.volume, 1, 1e-5) << label(base[i]) << " " << scale;
    }
  }
}

// What float32 can say there: at 1e7 its unit is 1, so that a cloud of a thousand keeps three digits.
TEST(FitVolumes, APlaceFarAwayChangesNothingButRoundingOfAnyMethod) {
  const Points points = turned(random_cloud(3, 200, {1, 2, 4}));
  const auto base = fit_all(points);
  for (const double size : {1.0, 1e6}) {
    for (const double place : {1e4, 1e7}) {
      if (size < place * 1e-4) continue;
      const auto moved = fit_all(scaled(points, size, {place, -place, place}));
      for (std::size_t i = 0; i < base.size(); ++i) {
        EXPECT_NEAR(moved[i].measures.volume / size / size / size / base[i].measures.volume, 1, 1e-2)
            << label(base[i]) << " of size " << size << " at " << place;
        EXPECT_TRUE(moved[i].certified);
      }
    }
  }
}

TEST(FitVolumes, FarFromTheOriginNoLozengeIsLargerThanTheCapsuleNorThatThanTheBall) {
  for (const double far : {1e5, 1e6, 1e7}) {
    for (int seed = 0; seed < 6; ++seed) {
      Points points = random_cloud(40 + seed, 6 + 4 * seed, {1, 1, 1});
      for (Double3& p : points) p += Double3{far, far, far};
      const auto all = fit_all(points);
      const double ball = of(all, VolumeKind::sphere, "minimal").measures.volume,
                   capsule = of(all, VolumeKind::capsule, "minimal").measures.volume;
      EXPECT_LE(capsule, ball * (1 + 1e-6)) << far << ", " << seed;
      EXPECT_LE(of(all, VolumeKind::lozenge, "minimal").measures.volume, capsule * (1 + 1e-6))
          << far << ", " << seed;
    }
  }
}

TEST(FitVolumes, WhenTheTimeIsUpEveryMethodStillGivesAProvenVolumeNoWorseThanTheQuickOnes) {
  for (const Points& points : {turned(twig(10)), copse::torus(40, 32, 0.5, 0.125),
                               random_cloud(10, 9000, {1, 1, 1}), lattice(9, 3)}) {
    const auto late = fit_all(points, {FitQuality::exact, Deadline::after(0)});
    for (const FittedVolume& v : late) {
      EXPECT_TRUE(v.certified && certify(v.volume, points).holds()) << label(v);
      EXPECT_LE(v.lower_bound, v.measures.volume) << label(v);
      if (!v.method.least || v.method.kind == VolumeKind::kdop) continue;
      for (const FittedVolume& quick : late) {
        if (quick.method.kind == v.method.kind && quick.method.quick) {
          EXPECT_LE(v.measures.volume, quick.measures.volume) << label(v) << " " << label(quick);
        }
      }
    }
  }
}

TEST(FitVolumes, TimeEnoughGivesWhatNoLimitGivesAndAProof) {
  const Points points = turned(random_cloud(3, 60, {1, 2, 4}));
  const auto all = fit_all(points), timed = fit_all(points, {FitQuality::balanced, Deadline::after(60)});
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_LE(timed[i].measures.volume, all[i].measures.volume * (1 + 1e-6)) << label(all[i]);
    const double gap = exact_gap(timed[i].method.kind);
    if (timed[i].method.least && std::isfinite(gap)) {
      EXPECT_LE(timed[i].measures.volume, timed[i].lower_bound * (1 + gap + 1e-5)) << label(timed[i]);
    }
  }
}

TEST(FitVolumes, MoreTimeGivesNoWorseVolumes) {
  const Points points = copse::torus(40, 32, 0.5, 0.125);
  std::vector<FittedVolume> before;
  for (const double seconds : {0.0, 1e-3, 1e-2, 60.0}) {
    std::vector<FittedVolume> now;
    for (const FitMethod& m : fit_methods()) {
      if (!m.least) continue;
      const auto fitter = VolumeFitter::make(points, {});
      auto v = fitter->fit(m, {FitQuality::balanced, Deadline::after(seconds)});
      ASSERT_TRUE(v) << m.name;
      now.push_back(std::move(*v));
    }
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_LE(now[i].measures.volume, before[i].measures.volume * (1 + 1e-6)) << label(now[i]);
    before = std::move(now);
  }
}

TEST(FitVolumes, LowerBoundsAreSharedWithinAKind) {
  const Points points = cube_corners();
  const auto fitter = VolumeFitter::make(points);
  std::vector<FittedVolume> all;
  for (const FitMethod& m : fit_methods()) all.push_back(*fitter->fit(m));
  fitter->share_lower_bounds(all);
  double bound = -1;
  for (const FittedVolume& v : all) {
    if (v.method.kind != VolumeKind::obb) continue;
    if (bound >= 0) {
      EXPECT_EQ(v.lower_bound, bound);
    }
    bound = v.lower_bound;
  }
}

TEST(FitVolumes, NoHullIsBuiltForMethodsThatNeedNoneAndNoByteTellsWhetherThereIsOne) {
  const Points points = turned(random_cloud(9, 300, {1, 0.5, 2}));
  const auto without = VolumeFitter::make(points), with = VolumeFitter::make(points);
  with->hull();
  std::set<VolumeKind> kinds;
  for (const FitMethod& m : fit_methods()) {
    if (m.on_hull) continue;
    EXPECT_TRUE(m.quick) << m.name;
    kinds.insert(m.kind);
    const auto a = without->fit(m, {FitQuality::fast}), b = with->fit(m, {FitQuality::fast});
    EXPECT_EQ(a->volume, b->volume) << name_of(m.kind) << " " << m.name;
    EXPECT_EQ(a->lower_bound, b->lower_bound) << name_of(m.kind) << " " << m.name;
  }
  EXPECT_EQ(kinds.size(), k_volume_kinds);
  EXPECT_FALSE(without->has_hull());
  EXPECT_EQ(without->hull_seconds(), 0);
  EXPECT_TRUE(with->has_hull());
}

TEST(FitVolumes, WhatIsNotFiniteOrNothingIsRefused) {
  EXPECT_FALSE(VolumeFitter::make(Points{}));
  EXPECT_FALSE(VolumeFitter::make(Points{{0, 0, 0}, {0, std::numeric_limits<double>::quiet_NaN(), 0}}));
}

TEST(FitVolumes, CoordinatesBeyondFloat32GiveNoVolume) {
  const Points huge = scaled(cube_corners(), 1e200);
  const auto fitter = VolumeFitter::make(huge);
  ASSERT_TRUE(fitter);
  for (const FitMethod& m : fit_methods()) EXPECT_FALSE(fitter->fit(m)) << m.name;
}

}  // namespace
}  // namespace copse
