// lines_points: how large a tree drawn as lines and points will be on screen, as a runtime estimates it, and
// how wrong that is.
//
// The spectrum itself is in every tree's file: segments by ascending diameter with accumulated lengths,
// leaves by distance inside their group, mean areas, the trunk's centre of area density (digest 000,
// sections 3.1 to 3.6). What a runtime needs of it are projections, for a few multiplications each; their
// truth is a sum over all triangles.
#pragma once

#include "lib/analysis/lod/patch.h"
#include "lib/formats/tree/tree.h"

#include <span>
#include <vector>

namespace copse {

// Projected on a plane at distance 1 from the eye: square metres and metres there (times near^2 and near for
// another near plane). Nothing is hidden by anything else; a leaf counts with the share that its alpha lets
// through.
struct Projection {
  double leaf_area = 0, trunk_area = 0, length = 0;
};

// The eye looks along -`toward` (unit, from the tree to the eye).
struct EyeAt {
  Double3 position, toward;
};

// How much of what is there shows: its directions are taken as
enum class Orientation {
  seed,       // spread evenly, and lengths as printed, by the cosine of the angle to the view (erratum E7)
  isotropic,  // spread evenly: half of a leaf's area, a quarter of a trunk's, pi / 4 of a length
  tensor,  // what their second moments say, in closed form: six numbers each for leaves, trunk and segments
};

struct EstimateOptions {
  Orientation orientation = Orientation::tensor;
  double divisor = 2;  // of isotropic leaf area; the thesis tuned it to 1.8 (equation 4.4, erratum E15)
};

// What does not depend on the view, summed up once: linear in the tree.
class ProjectionEstimate {
 public:
  explicit ProjectionEstimate(const Tree& tree);
  // Cost: the leaf groups. Depths below 1 count as 1 (erratum E14).
  Projection at(const EyeAt& eye, const EstimateOptions& options = {}) const;

 private:
  struct Group {
    Double3 centre;
    double area;
  };
  std::vector<Group> groups_;
  Double3 trunk_centre_;
  double trunk_area_ = 0, length_ = 0;
  // Mean over length of direction direction^T, over area of normal normal^T.
  Symmetric3 directions_, leaf_normals_, trunk_normals_;
};

// The sums over all triangles and segments. Trunk area: half of the sum over both faces, what a closed
// surface shows.
Projection true_projection(const Tree& tree, const EyeAt& eye);

// The relative errors |estimate / truth - 1| over the directions: the largest and the mean, for an eye so far
// that the tree's bounding sphere covers `coverage` of a square view of 60 degrees (1: just fits).
struct ProjectionErrors {
  Projection mean, largest;
};
ProjectionErrors projection_errors(const Tree& tree, double coverage, std::span<const Double3> directions,
                                   const EstimateOptions& options = {});

}  // namespace copse
