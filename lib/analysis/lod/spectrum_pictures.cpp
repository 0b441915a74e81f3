#include "lib/analysis/lod/spectrum_pictures.h"

#include <algorithm>
#include <array>
#include <limits>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

// What is seen at a sample so far.
struct Sample {
  float depth = -std::numeric_limits<float>::infinity();
  std::uint32_t triangle = k_none;

  // Of two at the same depth the lower index wins, whichever comes first.
  bool wants(float d, std::uint32_t t) const { return d > depth || (d == depth && t < triangle); }
  void put(float d, std::uint32_t t) {
    if (wants(d, t)) depth = d, triangle = t;
  }
};

// Where a triangle is seen when nothing is in front of it.
struct Fragment {
  std::uint32_t sample = 0;
  float depth = 0;
  std::uint32_t triangle = 0;
};

// The fragments of an element: up to where the next one's begin.
struct Kept {
  std::uint32_t element = 0, first = 0;
};

}  // namespace

// One of both spectra; its elements and triangles are counted on from those before.
class SpectrumPictures::Part {
 public:
  Part(const Spectrum& spectrum, const Looks& looks, std::uint32_t first_element,
       std::uint32_t first_triangle)
      : spectrum_(spectrum), looks_(looks), element_(first_element), triangle_(first_triangle) {}

  bool holds(std::uint32_t element) const { return element >= element_; }

  void shade(std::span<Float3> shades) const {
    tbb::parallel_for(std::size_t{0}, spectrum_.elements.size(), [&](std::size_t e) {
      const std::uint32_t m = spectrum_.elements[e].material;
      const Material* material = m < looks_.materials.size() ? &looks_.materials[m] : nullptr;
      for (std::uint32_t t = spectrum_.first_triangle[e]; t < spectrum_.first_triangle[e + 1]; ++t) {
        std::array<Double3, 3> corners;
        Double3 normals{};
        for (std::size_t c = 0; c < 3; ++c) {
          const SpectrumVertex& v = vertex(t, c);
          corners[c] = to_double(v.position), normals += to_double(v.normal);
        }
        shades[triangle_ + t] = shaded(corners, normals, material);
      }
    });
  }

  // Calls wants(sample, depth, triangle) and see(sample, depth, triangle) as for_each_sample does.
  template <class Wants, class See>
  void samples(std::uint32_t element, const OrthographicView& view, Wants wants, See see) const {
    const std::uint32_t e = element - element_;
    const std::uint32_t m = spectrum_.elements[e].material;
    ScreenTriangle screen;
    if (m < looks_.masks.size() && !looks_.masks[m].opaque.empty()) screen.mask = &looks_.masks[m];
    for (std::uint32_t t = spectrum_.first_triangle[e]; t < spectrum_.first_triangle[e + 1]; ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const SpectrumVertex& v = vertex(t, c);
        screen.corners[c] = {view.project(to_double(v.position)), v.texcoord};
      }
      for_each_sample(
          screen, view.width, view.height,
          [&](std::size_t sample, float depth) { return wants(sample, depth, triangle_ + t); },
          [&](std::size_t sample, float depth) { see(sample, depth, triangle_ + t); });
    }
  }

 private:
  const SpectrumVertex& vertex(std::uint32_t triangle, std::size_t corner) const {
    return spectrum_.vertices[spectrum_.triangles[triangle][corner]];
  }

  const Spectrum& spectrum_;
  const Looks looks_;
  const std::uint32_t element_, triangle_;
};

class SpectrumPictures::View {
 public:
  View(const OrthographicView& view, int samples, std::size_t most)
      : view_(view), fine_(view), samples_(samples), most_(most) {
    fine_.width *= samples, fine_.height *= samples, fine_.pixel /= samples;
  }

  // `fresh` elements are drawn and have never been before.
  Picture draw(const Part& trunk, const Part& leaves, std::span<const std::uint8_t> drawn,
               std::span<const std::uint32_t> fresh, std::span<const Float3> shades) {
    seen_.assign(static_cast<std::size_t>(fine_.width) * fine_.height, {});
    const auto part = [&](std::uint32_t element) -> const Part& {
      return leaves.holds(element) ? leaves : trunk;
    };
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      if (!drawn[kept_[k].element]) continue;
      const std::size_t end = k + 1 < kept_.size() ? kept_[k + 1].first : fragments_.size();
      for (std::size_t f = kept_[k].first; f < end; ++f)
        seen_[fragments_[f].sample].put(fragments_[f].depth, fragments_[f].triangle);
    }
    for (const std::uint32_t element : beyond_)
      if (drawn[element]) look(part(element), element);
    for (const std::uint32_t element : fresh) keep(part(element), element);
    return picture(shades);
  }

 private:
  void look(const Part& part, std::uint32_t element) {
    part.samples(
        element, fine_,
        [&](std::size_t sample, float depth, std::uint32_t t) { return seen_[sample].wants(depth, t); },
        [&](std::size_t sample, float depth, std::uint32_t t) { seen_[sample].put(depth, t); });
  }

  void keep(const Part& part, std::uint32_t element) {
    const std::size_t first = fragments_.size();
    bool room = true;
    part.samples(
        element, fine_,
        [&](std::size_t sample, float depth, std::uint32_t t) {
          return fragments_.size() < most_ || seen_[sample].wants(depth, t);
        },
        [&](std::size_t sample, float depth, std::uint32_t t) {
          seen_[sample].put(depth, t);
          room = room && fragments_.size() < most_;
          if (room) fragments_.push_back({static_cast<std::uint32_t>(sample), depth, t});
        });
    room = room && fragments_.size() < most_;
    if (!room) fragments_.resize(first), beyond_.push_back(element);
    if (fragments_.size() > first) kept_.push_back({element, static_cast<std::uint32_t>(first)});
  }

  // The mean of the samples of each pixel, as draw_picture adds them up.
  Picture picture(std::span<const Float3> shades) const {
    Picture out{view_.width, view_.height, {}, {}};
    const std::size_t n = static_cast<std::size_t>(view_.width) * view_.height;
    out.colour.resize(n), out.coverage.resize(n);
    const float weight = 1.0f / static_cast<float>(samples_ * samples_);
    for (std::size_t at = 0; at < n; ++at) {
      const std::size_t x = at % view_.width, y = at / view_.width;
      Float3 sum{};
      int hits = 0;
      for (int j = 0; j < samples_; ++j) {
        const std::size_t row = (y * samples_ + j) * fine_.width + x * samples_;
        for (int i = 0; i < samples_; ++i) {
          const std::uint32_t t = seen_[row + i].triangle;
          sum += t == k_none ? Float3{1, 1, 1} : shades[t];
          hits += t != k_none;
        }
      }
      out.colour[at] = sum * weight;
      out.coverage[at] = static_cast<float>(hits) * weight;
    }
    return out;
  }

  OrthographicView view_, fine_;
  int samples_;
  std::size_t most_;
  std::vector<Sample> seen_;
  std::vector<Fragment> fragments_;
  std::vector<Kept> kept_;
  std::vector<std::uint32_t> beyond_;  // elements that there was no room for
};

SpectrumPictures::SpectrumPictures(const LodSpectra& spectra, const Looks& looks,
                                   std::span<const OrthographicView> views, int samples, std::size_t kept)
    : spectra_(spectra), known_(spectra.trunk.elements.size() + spectra.leaves.elements.size(), 0) {
  const std::size_t triangles = spectra.trunk.triangles.size();
  trunk_ = std::make_unique<const Part>(spectra.trunk, looks, 0, 0);
  leaves_ = std::make_unique<const Part>(spectra.leaves, looks,
                                         static_cast<std::uint32_t>(spectra.trunk.elements.size()),
                                         static_cast<std::uint32_t>(triangles));
  shades_.resize(triangles + spectra.leaves.triangles.size());
  trunk_->shade(shades_), leaves_->shade(shades_);
  for (const OrthographicView& view : views) views_.emplace_back(view, samples, kept);
}

SpectrumPictures::~SpectrumPictures() = default;

std::vector<Picture> SpectrumPictures::draw(std::uint32_t trunk_steps, std::span<const std::uint8_t> leaves) {
  std::vector<std::uint8_t> drawn(known_.size());
  const auto& trunk = spectra_.trunk.elements;
  for (std::size_t e = 0; e < trunk.size(); ++e)
    drawn[e] = trunk[e].birth <= trunk_steps && trunk_steps < trunk[e].death;
  std::copy(leaves.begin(), leaves.end(), drawn.begin() + static_cast<std::ptrdiff_t>(trunk.size()));
  std::vector<std::uint32_t> fresh;
  for (std::size_t e = 0; e < drawn.size(); ++e) {
    if (!drawn[e] || known_[e]) continue;
    known_[e] = 1;
    fresh.push_back(static_cast<std::uint32_t>(e));
  }
  std::vector<Picture> pictures(views_.size());
  tbb::parallel_for(std::size_t{0}, pictures.size(), [&](std::size_t v) {
    pictures[v] = views_[v].draw(*trunk_, *leaves_, drawn, fresh, shades_);
  });
  return pictures;
}

}  // namespace copse
