// Builds a Spectrum step by step: what makes levels says what appears, what disappears and what that costs;
// order, offsets and counts follow.
//
//   SpectrumBuilder b(LodMethod::collapse);
//   const auto v = b.vertex({...});
//   const auto leaf = b.element(material, radius, {{v, v + 1, v + 2}});   // there from now on
//   b.step(cost);                                                          // now step 1
//   b.remove(leaf);
//   Spectrum s = b.finish();
#pragma once

#include "lib/formats/levels/spectrum.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

class SpectrumBuilder {
 public:
  explicit SpectrumBuilder(LodMethod method) : method_(method) {}

  // Vertices may be shared by any elements. Returns its number.
  std::uint32_t vertex(const SpectrumVertex& vertex);
  // An element that is there from the current step on. Triangles index vertices. Returns its number, which
  // holds until finish().
  std::uint32_t element(std::uint32_t material, std::uint32_t radius,
                        std::span<const std::array<std::uint32_t, 3>> triangles);
  // An element whose whole life is known: its steps may be any that there are when finish() is called.
  std::uint32_t element(const SpectrumElement& element,
                        std::span<const std::array<std::uint32_t, 3>> triangles);
  // The element is gone from the current step on. An element that is removed in the step that made it never
  // was.
  void remove(std::uint32_t element);
  // Begins the next step: changes from here on show after one step more. `error` is the error of the state
  // that this step leads to, metres; the largest so far is what is stored.
  void step(double error);

  std::uint32_t steps() const { return static_cast<std::uint32_t>(errors_.size() - 1); }
  // At the current step; only of elements that were made and removed step by step.
  std::uint64_t triangles() const { return alive_; }

  // Sorts elements by descending death, then ascending birth, then number, and drops vertices that no element
  // uses. Triangle counts must not have grown from one step to the next: a step that adds more than it
  // removes is joined with those after it until the count is met. O(n log n).
  Spectrum finish();

 private:
  LodMethod method_;
  std::vector<SpectrumVertex> vertices_;
  std::vector<SpectrumElement> elements_;
  std::vector<std::uint32_t> first_{0};
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<float> errors_{0};
  std::uint64_t alive_ = 0;
};

}  // namespace copse
