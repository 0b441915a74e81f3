// drawn_mesh: triangles as a renderer would get them, for measuring levels of detail against their source.
#pragma once

#include "lib/analysis/measure/texture_statistics.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/mesh.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace copse {

// One normal and one texture coordinate a position, or none at all. `material` has one entry a triangle.
struct DrawnMesh {
  std::vector<Double3> positions;
  std::vector<Float3> normals;    // empty: flat shading
  std::vector<Float2> texcoords;  // empty: no texture; v up
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> material;  // k_none: white and opaque
};

// What an alpha test lets through, one byte a texel (0 or 1), rows from the top. Empty: everything.
struct AlphaMask {
  int width = 0, height = 0;
  std::vector<std::uint8_t> opaque;

  bool passes(double u, double v) const;  // repeats in both directions; v up; nearest texel
};

// One a material. Opaque where there is no texture, no image, or no texel that fails. Without an alpha test a
// texel of alpha under a half fails.
std::vector<AlphaMask> alpha_masks(std::span<const Material> materials, const ImageSource& images);

// Corners that share vertex, normal and texture coordinate share a position; in order of first use. What
// lacks a normal or a texture coordinate gets zeros when others of its kind have one.
DrawnMesh drawn_leaves(const Tree& tree);
DrawnMesh drawn_trunk(const Tree& tree);

// What is drawn of a spectrum after `steps` steps, with the positions that it uses.
DrawnMesh drawn_state(const Spectrum& spectrum, std::uint32_t steps);
// What is drawn of a spectrum when these elements are: not 0, one entry an element.
DrawnMesh drawn_elements(const Spectrum& spectrum, std::span<const std::uint8_t> drawn);

// Puts `more` behind what is there.
void append(DrawnMesh& mesh, const DrawnMesh& more);

double area(const DrawnMesh& mesh, std::uint32_t triangle);
double area(const DrawnMesh& mesh);  // of all triangles, in order
DoubleBox bounds(const DrawnMesh& mesh);

}  // namespace copse
