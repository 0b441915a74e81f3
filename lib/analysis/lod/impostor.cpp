#include "lib/analysis/lod/impostor.h"

#include "lib/analysis/measure/alpha_raster.h"
#include "lib/analysis/measure/view_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

double to_linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
std::uint8_t to_srgb_byte(double v) {
  v = std::clamp(v, 0.0, 1.0);
  return static_cast<std::uint8_t>(
      std::lround(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
}
std::uint8_t to_byte(double v) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
}

// A copy of each material's picture: an ImageSource's last one is gone with the next call.
struct Paint {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
  Double3 tint{1, 1, 1};

  Double3 colour(double u, double v) const {
    if (rgba.empty()) return tint;
    const auto texel = [](double t, int n) {
      return std::clamp(static_cast<int>((t - std::floor(t)) * n), 0, n - 1);
    };
    const std::size_t at = 4 * (static_cast<std::size_t>(texel(1 - v, height)) * width + texel(u, width));
    return {tint.x * to_linear(rgba[at] / 255.0), tint.y * to_linear(rgba[at + 1] / 255.0),
            tint.z * to_linear(rgba[at + 2] / 255.0)};
  }
};

std::vector<Paint> paints_of(std::span<const Material> materials, const ImageSource& images) {
  std::vector<Paint> out(materials.size());
  for (std::size_t m = 0; m < materials.size(); ++m) {
    out[m].tint = to_double(materials[m].diffuse);
    if (materials[m].texture != k_none && images) {
      if (const auto image = images(materials[m].texture)) {
        out[m].width = image->width, out[m].height = image->height;
        out[m].rgba.assign(image->rgba.begin(), image->rgba.end());
        continue;
      }
    }
    const Double3 mean = to_double(materials[m].mean_colour);
    out[m].tint = {out[m].tint.x * mean.x, out[m].tint.y * mean.y, out[m].tint.z * mean.z};
  }
  return out;
}

class Painter {
 public:
  Painter(const DrawnMesh& mesh, std::span<const Material> materials, const ImageSource& images,
          const ImpostorOptions& options)
      : mesh_(mesh),
        options_(options),
        paints_(paints_of(materials, images)),
        masks_(alpha_masks(materials, images)),
        looks_{materials, masks_} {}

  Impostor run() {
    out_.layout = options_.layout;
    out_.views = impostor_views(options_.layout, static_cast<std::uint32_t>(options_.views));
    out_.size = options_.size;
    const int columns = options_.views, rows = static_cast<int>(out_.views.size()) / std::max(columns, 1);
    out_.width = columns * options_.size, out_.height = rows * options_.size;
    const std::size_t pixels = static_cast<std::size_t>(out_.width) * out_.height;
    out_.albedo.assign(4 * pixels, 0), out_.normal.assign(4 * pixels, 0), out_.depth.assign(pixels, 0);
    const DoubleBox box = bounds(mesh_);
    if (box.empty()) return std::move(out_);
    out_.centre = box.centre();
    for (const Triangle& t : mesh_.triangles)
      for (const std::uint32_t v : t)
        out_.radius = std::max(out_.radius, distance(mesh_.positions[v], out_.centre));
    tbb::parallel_for(std::size_t{0}, out_.views.size(), [&](std::size_t v) { paint(v); });
    return std::move(out_);
  }

 private:
  struct Sample {
    float depth = -std::numeric_limits<float>::infinity();
    std::uint32_t triangle = k_none;
  };
  struct Sum {
    Double3 colour{}, normal{};
    double depth = 0;
    int hits = 0;
  };

  void paint(std::size_t index) {
    OrthographicView view =
        view_of_sphere(out_.centre, out_.radius, out_.views[index], options_.size * options_.samples);
    std::vector<Sample> seen(static_cast<std::size_t>(view.width) * view.height);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      for_each_sample(
          on_screen(mesh_, looks_, view, t), view.width, view.height,
          [&](std::size_t p, float z) { return z > seen[p].depth; },
          [&](std::size_t p, float z) {
            seen[p] = {z, t};
          });
    }
    const int x0 = static_cast<int>(index) % options_.views * options_.size,
              y0 = static_cast<int>(index) / options_.views * options_.size;
    std::vector<Sum> sums(static_cast<std::size_t>(options_.size) * options_.size);
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) {
        const Sample& s = seen[static_cast<std::size_t>(y) * view.width + x];
        if (s.triangle != k_none)
          add(s, view, x + 0.5, y + 0.5,
              sums[static_cast<std::size_t>(y / options_.samples) * options_.size + x / options_.samples]);
      }
    for (int y = 0; y < options_.size; ++y)
      for (int x = 0; x < options_.size; ++x)
        put(x0 + x, y0 + y, sums[static_cast<std::size_t>(y) * options_.size + x]);
    bleed(x0, y0);
  }

  void add(const Sample& s, const OrthographicView& view, double px, double py, Sum& sum) const {
    const Triangle& t = mesh_.triangles[s.triangle];
    const Double3 a = view.project(mesh_.positions[t[0]]), b = view.project(mesh_.positions[t[1]]),
                  c = view.project(mesh_.positions[t[2]]);
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const double u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
    const double v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area, w = 1 - u - v;
    double s0 = 0, t0 = 0;
    if (!mesh_.texcoords.empty()) {
      const Float2 &p = mesh_.texcoords[t[0]], &q = mesh_.texcoords[t[1]], &r = mesh_.texcoords[t[2]];
      s0 = u * p.x + v * q.x + w * r.x, t0 = u * p.y + v * q.y + w * r.y;
    }
    const std::uint32_t m = mesh_.material[s.triangle];
    sum.colour += m < paints_.size() ? paints_[m].colour(s0, t0) : Double3{1, 1, 1};
    sum.normal += facing(t, view, u, v, w);
    sum.depth += s.depth, ++sum.hits;
  }

  // In the view's frame; a leaf seen from behind is lit from behind, so its normal is turned to the viewer.
  Double3 facing(const Triangle& t, const OrthographicView& view, double u, double v, double w) const {
    Double3 n{};
    if (!mesh_.normals.empty())
      n = to_double(mesh_.normals[t[0]]) * u + to_double(mesh_.normals[t[1]]) * v +
          to_double(mesh_.normals[t[2]]) * w;
    if (dot(n, n) < 1e-6)
      n = cross(mesh_.positions[t[1]] - mesh_.positions[t[0]], mesh_.positions[t[2]] - mesh_.positions[t[0]]);
    n = normalized(n);
    const Double3 in_view{dot(n, view.right), dot(n, view.up), dot(n, view.toward)};
    return in_view.z < 0 ? -in_view : in_view;
  }

  void put(int x, int y, const Sum& sum) {
    if (sum.hits == 0) return;
    const std::size_t at = static_cast<std::size_t>(y) * out_.width + x;
    const double n = sum.hits;
    const auto alpha = to_byte(n / (options_.samples * options_.samples));
    const Double3 facing = normalized(sum.normal, {0, 0, 1});
    for (int c = 0; c < 3; ++c) {
      out_.albedo[4 * at + c] = to_srgb_byte(sum.colour[c] / n);
      out_.normal[4 * at + c] = to_byte((facing[c] + 1) / 2);
    }
    out_.albedo[4 * at + 3] = out_.normal[4 * at + 3] = alpha;
    out_.depth[at] = to_byte((sum.depth / n / out_.radius + 1) / 2);
  }

  // All but alpha; `to` and `from` are the bytes at which pixels begin.
  void take(std::size_t from, std::size_t to) {
    std::copy_n(&out_.albedo[from], 3, &out_.albedo[to]);
    std::copy_n(&out_.normal[from], 3, &out_.normal[to]);
    out_.depth[to / 4] = out_.depth[from / 4];
  }

  // Spreads colours into the empty pixels of a view, so that filtering meets no black rim: rows, then
  // columns.
  void bleed(int x0, int y0) {
    const int n = options_.size;
    const auto pixel = [&](int x, int y) {
      return 4 * (static_cast<std::size_t>(y0 + y) * out_.width + x0 + x);
    };
    const auto line = [&](auto&& at, auto&& has) {
      std::vector<int> nearest(n, -1);
      for (int i = 0, last = -1; i < n; ++i) nearest[i] = last = has(i) ? i : last;
      for (int i = n - 1, next = -1; i >= 0; --i) {
        next = has(i) ? i : next;
        if (next >= 0 && (nearest[i] < 0 || next - i < i - nearest[i])) nearest[i] = next;
      }
      for (int i = 0; i < n; ++i)
        if (!has(i) && nearest[i] >= 0) take(at(nearest[i]), at(i));
    };
    std::vector<std::uint8_t> row_has(n, 0);
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) row_has[y] |= out_.albedo[pixel(x, y) + 3] > 0;
      line([&](int x) { return pixel(x, y); }, [&](int x) { return out_.albedo[pixel(x, y) + 3] > 0; });
    }
    for (int x = 0; x < n; ++x)
      line([&](int y) { return pixel(x, y); }, [&](int y) { return row_has[y] != 0; });
  }

  const DrawnMesh& mesh_;
  ImpostorOptions options_;
  std::vector<Paint> paints_;
  std::vector<AlphaMask> masks_;
  Looks looks_;
  Impostor out_;
};

}  // namespace

Impostor make_impostor(const DrawnMesh& mesh, std::span<const Material> materials, const ImageSource& images,
                       const ImpostorOptions& options) {
  ImpostorOptions sane = options;
  sane.views = std::clamp(sane.views, 1, 64), sane.size = std::clamp(sane.size, 1, 1024),
  sane.samples = std::clamp(sane.samples, 1, 8);
  return Painter(mesh, materials, images, sane).run();
}

namespace {

// A view of the atlas as a function of the place in it: x to the right, y up, both -1 to 1.
class ViewReader {
 public:
  ViewReader(const Impostor& impostor, std::uint32_t view)
      : impostor_(impostor),
        toward_(impostor.views[view]),
        frame_(impostor_frame(toward_)),
        x0_(static_cast<int>(view) % (impostor.width / impostor.size) * impostor.size),
        y0_(static_cast<int>(view) / (impostor.width / impostor.size) * impostor.size) {}

  struct Texel {
    Double3 colour, normal;  // times alpha; linear, and in the tree's frame
    double alpha = 0;
  };

  // Where a ray through `from` along `along` meets the tree: where it is as deep as the picture says there.
  Texel at(const Double3& from, const Double3& along) const {
    const double slope = dot(along, toward_);
    if (!(std::abs(slope) > 1e-3)) return {};
    double height = 0;
    std::array<double, 2> place{};
    for (int step = 0; step < 3; ++step) {
      const Double3 p = from + along * ((height - dot(from, toward_)) / slope);
      place = {dot(p, frame_.right) / impostor_.radius, dot(p, frame_.up) / impostor_.radius};
      height = (2 * depth(place) - 1) * impostor_.radius;
    }
    return read(place);
  }

 private:
  std::size_t pixel(int x, int y) const {
    const int last = impostor_.size - 1;
    return static_cast<std::size_t>(y0_ + std::clamp(y, 0, last)) *
               static_cast<std::size_t>(impostor_.width) +
           static_cast<std::size_t>(x0_ + std::clamp(x, 0, last));
  }
  double depth(const std::array<double, 2>& p) const {
    const double half = impostor_.size / 2.0;
    const auto at = [&](double v) {
      return static_cast<int>(std::clamp(std::floor(v), -1.0, double(impostor_.size)));
    };
    return impostor_.depth[pixel(at(half + p[0] * half), at(half - p[1] * half))] / 255.0;
  }
  Texel read(const std::array<double, 2>& p) const {
    if (!(std::abs(p[0]) <= 1 && std::abs(p[1]) <= 1)) return {};
    const double half = impostor_.size / 2.0, x = half + p[0] * half - 0.5, y = half - p[1] * half - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    Texel out;
    for (const int dy : {0, 1})
      for (const int dx : {0, 1}) {
        const double weight = (dx ? x - i : 1 - (x - i)) * (dy ? y - j : 1 - (y - j));
        add(pixel(i + dx, j + dy), weight, out);
      }
    return out;
  }
  void add(std::size_t pixel, double weight, Texel& out) const {
    const std::uint8_t *c = &impostor_.albedo[4 * pixel], *n = &impostor_.normal[4 * pixel];
    const double alpha = weight * c[3] / 255.0;
    out.alpha += alpha;
    out.colour += Double3{to_linear(c[0] / 255.0), to_linear(c[1] / 255.0), to_linear(c[2] / 255.0)} * alpha;
    out.normal +=
        (frame_.right * (n[0] / 127.5 - 1) + frame_.up * (n[1] / 127.5 - 1) + toward_ * (n[2] / 127.5 - 1)) *
        alpha;
  }

  const Impostor& impostor_;
  Double3 toward_;
  ImpostorFrame frame_;
  int x0_, y0_;
};

}  // namespace

Picture draw_impostor(const Impostor& impostor, const OrthographicView& view) {
  static const Double3 light = normalized({0.35, 0.8, 0.5});
  Picture out{view.width, view.height, {}, {}};
  const std::size_t pixels = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
  out.colour.assign(pixels, {1, 1, 1}), out.coverage.assign(pixels, 0);
  if (impostor.views.empty() || !(impostor.radius > 0)) return out;
  const auto views = static_cast<std::uint32_t>(impostor.width / impostor.size);
  const ImpostorBlend blend = impostor_blend(impostor.layout, views, view.toward);
  const Double3 offset = view.centre - impostor.centre;
  for (std::size_t p = 0; p < pixels; ++p) {
    const double x = (static_cast<double>(p % view.width) + 0.5 - view.width / 2.0) * view.pixel,
                 y = (view.height / 2.0 - static_cast<double>(p / view.width) - 0.5) * view.pixel;
    ViewReader::Texel sum;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(blend.weight[k] > 0)) continue;
      const auto texel =
          ViewReader(impostor, blend.view[k]).at(offset + view.right * x + view.up * y, view.toward);
      sum.alpha += blend.weight[k] * texel.alpha;
      sum.colour += texel.colour * blend.weight[k], sum.normal += texel.normal * blend.weight[k];
    }
    const double lit = 0.5 + 0.5 * std::abs(dot(normalized(sum.normal), light));
    out.colour[p] = to_float(sum.colour * lit + Double3{1, 1, 1} * (1 - sum.alpha));
    out.coverage[p] = static_cast<float>(sum.alpha);
  }
  return out;
}

}  // namespace copse
