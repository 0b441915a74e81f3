#include "lib/analysis/measure/texture_statistics.h"

#include "lib/analysis/measure/footprints.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse {
namespace {

// What is summed over texels: linear colour weighted by visible alpha, that alpha, and what is covered.
struct Sums {
  std::array<double, 3> colour{};
  double alpha = 0, covered = 0;

  Sums& operator+=(const Sums& b) {
    for (int c = 0; c < 3; ++c) colour[c] += b.colour[c];
    alpha += b.alpha, covered += b.covered;
    return *this;
  }
  friend Sums operator*(Sums a, double s) {
    for (double& c : a.colour) c *= s;
    a.alpha *= s, a.covered *= s;
    return a;
  }
  friend Sums operator+(Sums a, const Sums& b) { return a += b; }
  friend Sums operator-(const Sums& a, const Sums& b) { return a + b * -1; }
};

std::array<double, 256> linear_of_srgb() {
  std::array<double, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double c = i / 255.0;
    table[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return table;
}

// A texture under one material's alpha test.
class Texels {
 public:
  Texels(const TextureImage& image, const Material& material)
      : image_(image), alpha_(material.alpha), cutoff_(material.alpha_cutoff), linear_(linear_of_srgb()) {}

  int width() const { return image_.width; }
  int height() const { return image_.height; }
  Sums at(int x, int y) const {
    const std::uint8_t* texel =
        image_.rgba.data() + 4 * (std::size_t(y) * std::size_t(image_.width) + std::size_t(x));
    const double alpha = texel[3] / 255.0;
    const bool visible = cutoff_ <= 0 || alpha * alpha_ >= cutoff_;
    Sums sums;
    if (!visible) return sums;
    for (int c = 0; c < 3; ++c) sums.colour[c] = alpha * linear_[texel[c]];
    sums.alpha = alpha;
    sums.covered = cutoff_ > 0 ? 1 : alpha;
    return sums;
  }

 private:
  const TextureImage& image_;
  double alpha_, cutoff_;
  std::array<double, 256> linear_;
};

// Sums over any stretch of a row that repeats without end, in constant time.
class Row {
 public:
  explicit Row(int width) : prefix_(std::size_t(width) + 1) {}

  void read(const Texels& texels, int y) {
    for (int x = 0; x < texels.width(); ++x) {
      prefix_[std::size_t(x) + 1] = prefix_[std::size_t(x)] + texels.at(x, y);
    }
  }
  Sums between(double from, double to) const { return up_to(to) - up_to(from); }

 private:
  Sums up_to(double x) const {
    const double width = static_cast<double>(prefix_.size() - 1);
    const double repeats = std::floor(x / width);
    const double inside = std::clamp(x - repeats * width, 0.0, width);
    const auto texel = std::min(static_cast<std::size_t>(inside), prefix_.size() - 2);
    const double part = inside - static_cast<double>(texel);
    return prefix_.back() * repeats + prefix_[texel] + (prefix_[texel + 1] - prefix_[texel]) * part;
  }
  std::vector<Sums> prefix_;
};

constexpr double k_least_lines = 8;  // a footprint
constexpr auto k_most_footprints = static_cast<std::size_t>(k_scanlines / k_least_lines);

// At most k_most_footprints that stand for all: whichever lies under the middle of each of as many equal
// steps through the sum of the areas, with the area of its steps.
std::vector<Footprint> sampled(std::vector<Footprint> all) {
  if (all.size() <= k_most_footprints) return all;
  double area = 0, passed = 0;
  for (const Footprint& f : all) area += f.area;
  const double step = area / static_cast<double>(k_most_footprints);
  std::size_t met = 0;
  std::vector<Footprint> out;
  for (const Footprint& f : all) {
    passed += f.area;
    const std::size_t until = std::min(k_most_footprints, static_cast<std::size_t>(passed / step + 0.5));
    if (until > met) out.push_back({f.corners, step * static_cast<double>(until - met)});
    met = until;
  }
  return out;
}

struct Scanline {
  std::uint32_t footprint;
  int row;
  double from, to;
};

// The scanlines of a footprint, in texels, y downwards from the image's top: one a row of texels, but at most
// `most`, which then start at `phase` (0 to 1) of a step, so that many footprints together still meet every
// row.
template <class Emit>
void scan(const Footprint& footprint, int width, int height, double most, double phase, Emit&& emit) {
  std::array<Double3, 3> p;
  for (int i = 0; i < 3; ++i) {
    p[i] = {footprint.corners[i].x * double(width), (1 - double{footprint.corners[i].y}) * height, 0};
  }
  std::sort(p.begin(), p.end(), [](const Double3& a, const Double3& b) { return a.y < b.y; });
  const double tall = p[2].y - p[0].y;
  const double lines = std::clamp(std::ceil(tall), k_least_lines, most);
  const auto x_at = [](const Double3& a, const Double3& b, double y) {
    return b.y > a.y ? a.x + (b.x - a.x) * std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0) : a.x;
  };
  for (double line = lines < most ? 0.5 : phase; line < lines; line += 1) {
    const double y = p[0].y + tall * line / lines;
    const double one = x_at(p[0], p[2], y), other = y < p[1].y ? x_at(p[0], p[1], y) : x_at(p[1], p[2], y);
    const double wrapped = y - std::floor(y / height) * height;
    emit(std::min(static_cast<int>(wrapped), height - 1), std::min(one, other), std::max(one, other));
  }
}

// Means over footprints: collects their scanlines, then walks the image once for all of them.
class Sampler {
 public:
  Sampler(const Texels& texels, std::span<const Footprint> footprints)
      : texels_(texels), footprints_(footprints), sums_(footprints.size()), lengths_(footprints.size(), 0) {}

  // The means, each times its footprint's area.
  Sums run() {
    const double most = std::floor(k_scanlines / static_cast<double>(footprints_.size()));
    for (std::uint32_t f = 0; f < footprints_.size(); ++f) {
      const double turns = f * 0.6180339887498949;  // golden ratio: evenly spread phases
      const double phase = turns - std::floor(turns);
      scan(footprints_[f], texels_.width(), texels_.height(), most, phase,
           [&](int row, double from, double to) {
             // Without a width there is still a texel under it.
             if (!(to - from > 1e-9 * texels_.width())) from = std::floor(from), to = from + 1;
             lines_.push_back({f, row, from, to});
           });
    }
    sum_up();
    Sums all;
    for (std::size_t f = 0; f < footprints_.size(); ++f)
      all += sums_[f] * (footprints_[f].area / lengths_[f]);
    return all;
  }

 private:
  void sum_up() {
    Row row(texels_.width());
    int read = -1;
    for (const std::uint32_t l : lines_by_row()) {
      const Scanline& line = lines_[l];
      if (line.row != read) row.read(texels_, read = line.row);
      sums_[line.footprint] += row.between(line.from, line.to);
      lengths_[line.footprint] += line.to - line.from;
    }
  }

  // The lines in the order of their rows, those of a row in their own.
  std::vector<std::uint32_t> lines_by_row() const {
    std::vector<std::uint32_t> next(static_cast<std::size_t>(texels_.height()) + 1, 0), order(lines_.size());
    for (const Scanline& line : lines_) ++next[static_cast<std::size_t>(line.row) + 1];
    for (std::size_t r = 1; r < next.size(); ++r) next[r] += next[r - 1];
    for (std::uint32_t l = 0; l < lines_.size(); ++l)
      order[next[static_cast<std::size_t>(lines_[l].row)]++] = l;
    return order;
  }

  const Texels& texels_;
  std::span<const Footprint> footprints_;
  std::vector<Sums> sums_;
  std::vector<double> lengths_;
  std::vector<Scanline> lines_;
};

Sums mean_of_all(const Texels& texels) {
  Sums sums;
  for (int y = 0; y < texels.height(); ++y) {
    Sums row;
    for (int x = 0; x < texels.width(); ++x) row += texels.at(x, y);
    sums += row;
  }
  return sums * (1.0 / texels.width() / texels.height());
}

void sample(const Mesh& mesh, std::span<const std::uint32_t> triangles, const Texels& texels,
            TextureStatistics& out) {
  Footprints found = footprints(mesh, triangles, k_footprint_tiles);
  out.footprints = found.list.size();
  out.whole = found.whole;
  double area = found.whole_area;
  for (const Footprint& f : found.list) area += f.area;
  const bool flat = !(area > 0);  // nothing drawn, or nothing to weight by
  Sums sums;
  if (!flat) {
    const std::vector<Footprint> kept = sampled(std::move(found.list));
    sums = Sampler(texels, kept).run();
  }
  if (flat || found.whole_area > 0) {
    sums += mean_of_all(texels) * (flat ? 1 : found.whole_area);
    if (flat) area = 1;
  }
  out.alpha_coverage = static_cast<float>(std::clamp(sums.covered / area, 0.0, 1.0));
  if (sums.alpha > 0) {
    out.mean_colour = to_float(Double3{sums.colour[0], sums.colour[1], sums.colour[2]} / sums.alpha);
  }
  out.sampled = true;
}

// Triangles by material: those of material m are list[first[m] .. first[m + 1]).
struct ByMaterial {
  std::vector<std::uint32_t> first, list;
};

ByMaterial sort_by_material(const Mesh& mesh) {
  ByMaterial out;
  out.first.assign(mesh.materials.size() + 1, 0);
  const auto material_of = [&](std::size_t t) { return mesh.parts[mesh.part_of[t]].material; };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (material_of(t) < mesh.materials.size()) ++out.first[material_of(t)];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& n : out.first) n = sum += n;
  out.list.resize(sum);
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    if (material_of(t) < mesh.materials.size())
      out.list[--out.first[material_of(t)]] = static_cast<std::uint32_t>(t);
  }
  return out;
}

}  // namespace

std::vector<TextureStatistics> texture_statistics(const Mesh& mesh, const ImageSource& images) {
  std::vector<TextureStatistics> out(mesh.materials.size());
  const ByMaterial sorted = sort_by_material(mesh);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> users;  // texture, material
  for (std::uint32_t m = 0; m < mesh.materials.size(); ++m) {
    out[m].triangles = sorted.first[m + 1] - sorted.first[m];
    if (mesh.materials[m].texture != k_none) users.emplace_back(mesh.materials[m].texture, m);
  }
  std::sort(users.begin(), users.end());
  std::optional<TextureImage> image;
  for (std::size_t i = 0; i < users.size(); ++i) {
    const auto [texture, material] = users[i];
    if (i == 0 || texture != users[i - 1].first) image = images(texture);
    if (!image || image->width < 1 || image->height < 1) continue;
    const std::span<const std::uint32_t> triangles =
        std::span(sorted.list).subspan(sorted.first[material], out[material].triangles);
    sample(mesh, triangles, Texels(*image, mesh.materials[material]), out[material]);
  }
  return out;
}

void apply(std::span<const TextureStatistics> statistics, std::vector<Material>& materials) {
  for (std::size_t m = 0; m < materials.size() && m < statistics.size(); ++m) {
    if (!statistics[m].sampled) continue;
    materials[m].mean_colour = statistics[m].mean_colour;
    materials[m].alpha_coverage = statistics[m].alpha_coverage;
  }
}

}  // namespace copse
