// What other libraries fit round the same points.
#pragma once

#include "lib/formats/volumes/volume.h"

#include <memory>
#include <span>

namespace copse {

// CGAL's points of a model, made once: making them is no part of its time.
class CgalPeer {
 public:
  explicit CgalPeer(std::span<const Double3> points);
  ~CgalPeer();
  double box_volume() const;              // oriented_bounding_box
  BoundingSphere<double> sphere() const;  // Min_sphere_of_spheres_d, double
  OrientedBox<double> principal_box() const;

 private:
  struct Points;
  std::unique_ptr<Points> points_;
};

// FCL's. Built without it: available is false and nothing may be called.
class FclPeer {
 public:
  static const bool available;
  explicit FclPeer(std::span<const Double3> points);
  ~FclPeer();
  OrientedBox<double> box() const;  // OBB
  Lozenge<double> lozenge() const;  // RSS

 private:
  struct Points;
  std::unique_ptr<Points> points_;
};

}  // namespace copse
