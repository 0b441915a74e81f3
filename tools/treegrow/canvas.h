// A picture in linear light that shapes are painted on, and the noise that barks are made of.
#pragma once

#include "lib/formats/import/image.h"
#include "lib/formats/vec.h"

#include <cstdint>
#include <vector>

namespace copse::grow {

// Square; pixel (0, 0) is at the lower left, coordinates run from 0 to 1.
class Canvas {
 public:
  explicit Canvas(int size);

  int size() const { return size_; }
  // Puts a colour over what is there, `cover` of the pixel.
  void over(int x, int y, const Double3& colour, double cover);
  void set(int x, int y, const Double3& colour) { over(x, y, colour, 1); }
  // Takes another canvas of half the size into a quarter: 0 and 1 below, 2 and 3 above.
  void put_quarter(int quarter, const Canvas& other);

  // Half as large, each pixel the mean of four: what was painted finely becomes smooth.
  Canvas halved() const;
  // sRGB, 8 bits. With alpha, colour is carried on past the edges of shapes, so that filtering finds no
  // background there; without, what is not covered is black.
  Image image(bool with_alpha) const;

 private:
  struct Pixel {
    Double3 colour;  // times cover
    double cover = 0;
  };
  Pixel& at(int x, int y) {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) +
                   static_cast<std::size_t>(x)];
  }
  const Pixel& at(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) +
                   static_cast<std::size_t>(x)];
  }
  int size_;
  std::vector<Pixel> pixels_;
};

// Two square pictures of one size, side by side.
Image beside(const Image& left, const Image& right);

// Noise that repeats after `px` and `py` units: it tiles. All are continuous but for the cells' numbers.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : seed_(seed) {}
  // Smooth, in about [-1, 1], one hill a unit.
  double smooth(double x, double y, int px, int py) const;
  // Octaves of it, each twice as fine and `gain` as strong.
  double cloud(double x, double y, int px, int py, int octaves, double gain = 0.5) const;

  // Cells round scattered points, one a unit square.
  struct Cell {
    double nearest;      // distance to the nearest point
    double border;       // how much farther the next one is: 0 on the border
    std::uint64_t name;  // of the cell
  };
  Cell cell(double x, double y, int px, int py) const;

 private:
  std::uint64_t lattice(int x, int y, int px, int py) const;
  std::uint64_t seed_;
};

inline double mix(double a, double b, double t) {
  return a + (b - a) * t;
}
inline Double3 mix(const Double3& a, const Double3& b, double t) {
  return a + (b - a) * t;
}
// 0 below a, 1 above b, smooth in between.
inline double ramp(double a, double b, double x) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace copse::grow
