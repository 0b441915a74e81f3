#include "bench/volumes_peers.h"

#ifdef COPSE_HAS_FCL
#include <fcl/math/bv/utility.h>
#endif

namespace copse {

#ifdef COPSE_HAS_FCL

const bool FclPeer::available = true;

struct FclPeer::Points {
  std::vector<fcl::Vector3d> all;
};

FclPeer::FclPeer(std::span<const Double3> points) : points_(std::make_unique<Points>()) {
  for (const Double3& p : points) points_->all.emplace_back(p.x, p.y, p.z);
}

namespace {
Double3 ours(const fcl::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
}  // namespace

OrientedBox<double> FclPeer::box() const {
  fcl::OBBd b;
  fcl::fit(points_->all.data(), static_cast<int>(points_->all.size()), b);
  return {ours(b.To), {ours(b.axis.col(0)), ours(b.axis.col(1)), ours(b.axis.col(2))}, ours(b.extent)};
}

Lozenge<double> FclPeer::lozenge() const {
  fcl::RSSd s;
  fcl::fit(points_->all.data(), static_cast<int>(points_->all.size()), s);
  return {ours(s.To), ours(s.axis.col(0) * s.l[0]), ours(s.axis.col(1) * s.l[1]), s.r};
}

#else

const bool FclPeer::available = false;
struct FclPeer::Points {};
FclPeer::FclPeer(std::span<const Double3>) {}
OrientedBox<double> FclPeer::box() const {
  return {};
}
Lozenge<double> FclPeer::lozenge() const {
  return {};
}

#endif

FclPeer::~FclPeer() = default;

}  // namespace copse
