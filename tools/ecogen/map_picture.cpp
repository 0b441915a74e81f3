#include "tools/ecogen/map_picture.h"

#include "lib/analysis/ecosystem/ground.h"
#include "lib/formats/ecosystem/instance_codec.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse::ecogen {
namespace {

constexpr int k_side = 1024;

const Double3 k_light{-0.5, 0.7, -0.5};

class Painter {
 public:
  explicit Painter(const Ecosystem& eco) : eco_(eco), ground_(eco.terrain) {
    const double w = ground_.x1() - ground_.x0(), d = ground_.z1() - ground_.z0(), longest = std::max(w, d);
    scale_ = longest > 0 ? k_side / longest : 1;
    image_.width = std::clamp(static_cast<int>(std::lround(w * scale_)), 1, k_side);
    image_.height = std::clamp(static_cast<int>(std::lround(d * scale_)), 1, k_side);
    image_.rgba.assign(static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height) * 4,
                       255);
    image_.has_alpha = false;
  }

  Image paint() {
    relief();
    trees();
    return std::move(image_);
  }

 private:
  void put(int x, int y, const Double3& c, double cover) {
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || cover <= 0) return;
    std::uint8_t* p =
        image_.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                                  static_cast<std::size_t>(x));
    for (int a = 0; a < 3; ++a)
      p[a] = static_cast<std::uint8_t>(
          std::lround(p[a] + (255 * std::clamp(c[a], 0.0, 1.0) - p[a]) * std::min(cover, 1.0)));
  }

  void relief() {
    const double low = eco_.bounds.empty() ? 0 : eco_.origin.y + double{eco_.bounds.min.y};
    double high = low + 1e-9;
    for (std::uint32_t r = 0; r < eco_.terrain.rows; ++r)
      for (std::uint32_t c = 0; c < eco_.terrain.columns; ++c)
        high = std::max(high, eco_.terrain.vertex(c, r).y);
    for (int y = 0; y < image_.height; ++y)
      for (int x = 0; x < image_.width; ++x) {
        const auto here = ground_.at(ground_.x0() + (x + 0.5) / scale_, ground_.z0() + (y + 0.5) / scale_);
        if (!here) continue;
        const double t = (here->height - low) / (high - low);
        const double shade = 0.62 + 0.5 * (dot(here->normal, k_light) / length(k_light));
        const Double3 tint = Double3{0.62, 0.70, 0.52} * (1 - t) + Double3{0.86, 0.82, 0.72} * t;
        put(x, y, tint * shade, 1);
      }
  }

  void disc(double cx, double cy, double r, const Double3& colour, double opacity) {
    const double reach = r + 1;
    for (int y = static_cast<int>(std::floor(cy - reach)); y <= static_cast<int>(std::ceil(cy + reach)); ++y)
      for (int x = static_cast<int>(std::floor(cx - reach)); x <= static_cast<int>(std::ceil(cx + reach));
           ++x) {
        const double d = std::sqrt((x + 0.5 - cx) * (x + 0.5 - cx) + (y + 0.5 - cy) * (y + 0.5 - cy));
        // Half a pixel of smooth border; a crown is lighter towards the sun.
        const double light = r > 1.5 ? 1 - 0.25 * ((x + 0.5 - cx) + (y + 0.5 - cy)) / r : 1;
        put(x, y, colour * light, std::clamp(r - d + 0.5, 0.0, 1.0) * opacity);
      }
  }

  void trees() {
    struct Crown {
      double top, x, y, radius;
      std::uint32_t type;
    };
    std::vector<Crown> crowns;
    for (const InstanceBlock& b : eco_.blocks)
      for (std::size_t i = b.first; i < b.first + b.count; ++i) {
        const Instance s = instance_of(eco_, b, i);
        const FloatBox& box = eco_.types[s.type].bounds;
        if (box.empty()) continue;
        const Float3 e = box.extent();
        crowns.push_back({s.position.y + s.scale * double{box.max.y}, (s.position.x - ground_.x0()) * scale_,
                          (s.position.z - ground_.z0()) * scale_,
                          0.5 * s.scale * scale_ * 0.5 * (double{e.x} + double{e.z}), s.type});
      }
    std::stable_sort(crowns.begin(), crowns.end(),
                     [](const Crown& a, const Crown& b) { return a.top < b.top; });
    for (const Crown& c : crowns) {
      const double r = std::max(c.radius, 0.45);
      if (r > 2) disc(c.x + 0.3 * r, c.y + 0.3 * r, r, {0.05, 0.08, 0.05}, 0.35);
      disc(c.x, c.y, r, type_colour(c.type), std::min(1.0, 0.5 + 0.25 * r));
    }
  }

  const Ecosystem& eco_;
  TerrainGround ground_;
  double scale_ = 1;  // pixels a metre
  Image image_;
};

}  // namespace

Double3 type_colour(std::size_t type) {
  // Told apart on green, and by most colour-blind eyes (after Okabe and Ito); then again, darker.
  static constexpr std::array<Double3, 8> k_colours{{{0.05, 0.35, 0.15},
                                                     {0.90, 0.62, 0.0},
                                                     {0.34, 0.71, 0.91},
                                                     {0.80, 0.40, 0.0},
                                                     {0.94, 0.89, 0.26},
                                                     {0.80, 0.47, 0.65},
                                                     {0.0, 0.45, 0.70},
                                                     {0.45, 0.62, 0.28}}};
  return k_colours[type % k_colours.size()] * (1 - 0.3 * static_cast<double>(type / k_colours.size() % 3));
}

Image map_picture(const Ecosystem& eco) {
  return Painter(eco).paint();
}

}  // namespace copse::ecogen
