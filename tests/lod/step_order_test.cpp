#include "lib/analysis/lod/step_order.h"

#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Four leaves a b c d; step 1 makes x of a and b, step 2 y of c and d, step 3 z of x and y.
struct Four {
  enum { a, b, c, d, x, y, z };
  Four() {
    SpectrumBuilder builder(LodMethod::collapse);
    std::vector<std::uint32_t> made;
    const auto add = [&] {
      const auto name = static_cast<float>(made.size());
      const std::uint32_t v = builder.vertex({{name, 0, 0}, {}, {}});
      const std::array<std::uint32_t, 3> corners{v, v, v};
      made.push_back(builder.element(k_none, k_none, std::span(&corners, 1)));
    };
    for (int i = 0; i < 4; ++i) add();
    const auto join = [&](int one, int two, double error) {
      builder.step(error);
      builder.remove(made[static_cast<std::size_t>(one)]),
          builder.remove(made[static_cast<std::size_t>(two)]);
      add();
    };
    join(a, b, 1), join(c, d, 2), join(x, y, 3);
    spectrum = builder.finish();
  }
  static int name(const Spectrum& s, std::size_t e) {
    return static_cast<int>(s.vertices[s.triangles[s.first_triangle[e]][0]].position.x);
  }
  // What is drawn, as names.
  std::vector<int> drawn(const StepOrder::State& state) const {
    std::vector<int> out;
    for (std::size_t e = 0; e < state.drawn.size(); ++e)
      if (state.drawn[e]) out.push_back(name(spectrum, e));
    std::sort(out.begin(), out.end());
    return out;
  }
  // These must not be drawn after so many steps of the other part.
  StepOrder::MustGo until(std::vector<int> which, std::uint32_t steps) const {
    return [this, which, steps](std::uint32_t e, std::uint32_t other) {
      return other >= steps && std::ranges::find(which, name(spectrum, e)) != which.end();
    };
  }
  Spectrum spectrum;
};

TEST(StepOrder, WithoutAnyWishStepsGoInTheirOrder) {
  const Four four;
  const StepOrder order(four.spectrum, {});
  StepOrder::State state = order.full_detail();
  EXPECT_EQ(state.triangles, 4u);
  std::vector<StepOrder::Batch> batches;
  EXPECT_TRUE(order.take_forced(state, 99, batches));
  EXPECT_TRUE(batches.empty());
  order.take_until(state, 99, 3, batches);
  EXPECT_EQ(batches, (std::vector<StepOrder::Batch>{{1}}));
  order.take_until(state, 99, 0, batches);
  EXPECT_EQ(batches, (std::vector<StepOrder::Batch>{{1}, {2}, {3}}));
  EXPECT_EQ(four.drawn(state), std::vector<int>{Four::z});
}

TEST(StepOrder, WhatMustGoGoesFirst) {
  const Four four;
  const StepOrder order(four.spectrum, four.until({Four::d}, 10));
  StepOrder::State state = order.full_detail();
  std::vector<StepOrder::Batch> batches;
  EXPECT_TRUE(order.take_forced(state, 9, batches));
  EXPECT_TRUE(batches.empty()) << "not yet";
  EXPECT_TRUE(order.take_forced(state, 10, batches));
  EXPECT_EQ(batches, (std::vector<StepOrder::Batch>{{2}}));
  EXPECT_EQ(four.drawn(state), (std::vector<int>{Four::a, Four::b, Four::y}));
}

TEST(StepOrder, WhatMustNotBeDrawnIsPassedOver) {
  const Four four;
  const StepOrder order(four.spectrum, four.until({Four::d, Four::y}, 10));
  StepOrder::State state = order.full_detail();
  std::vector<StepOrder::Batch> batches;
  EXPECT_TRUE(order.take_forced(state, 10, batches));
  EXPECT_EQ(batches, (std::vector<StepOrder::Batch>{{2, 1, 3}})) << "y goes with what takes it away";
  const Spectrum s = order.reordered(batches);
  EXPECT_EQ(s.steps(), 1u);
  EXPECT_EQ(s.elements.size(), 5u) << "x and y are never drawn";
  EXPECT_EQ(s.errors[1], 3.0f);
}

TEST(StepOrder, WhatNeverGoesCannotBeTaken) {
  const Four four;
  const StepOrder order(four.spectrum, four.until({Four::z}, 1));
  StepOrder::State state = order.full_detail();
  std::vector<StepOrder::Batch> batches;
  EXPECT_TRUE(order.take_forced(state, 5, batches)) << "it is not there yet";
  order.take_until(state, 5, 0, batches);
  EXPECT_EQ(four.drawn(state), (std::vector<int>{Four::x, Four::y}));
}

TEST(StepOrder, TheReorderedSpectrumDrawsWhatItsStateHad) {
  const Four four;
  const StepOrder order(four.spectrum, four.until({Four::d}, 10));
  StepOrder::State state = order.full_detail();
  std::vector<StepOrder::Batch> batches;
  ASSERT_TRUE(order.take_forced(state, 10, batches));
  const Spectrum s = order.reordered(batches);
  EXPECT_EQ(s.steps(), 3u) << "what was not asked for lies behind";
  EXPECT_TRUE(std::ranges::equal(s.counts, four.spectrum.counts));
  std::vector<int> names;
  for (std::size_t e = 0; e < s.elements.size(); ++e)
    if (s.elements[e].birth <= 1 && s.elements[e].death > 1) names.push_back(Four::name(s, e));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, four.drawn(state));
  EXPECT_EQ(s.errors[1], 2.0f) << "the error of the step that was drawn forward";
  EXPECT_EQ(s.errors[2], 2.0f);
}

}  // namespace
}  // namespace copse
