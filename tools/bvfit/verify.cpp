#include "tools/bvfit/verify.h"

#include "lib/analysis/volumes/certify.h"
#include "lib/analysis/volumes/check_certificates.h"
#include "lib/analysis/volumes/fit_volumes.h"
#include "lib/analysis/volumes/volume_measures.h"
#include "lib/formats/container/mapped_file.h"
#include "lib/formats/printable.h"
#include "tools/bvfit/volumes_json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

namespace fs = std::filesystem;

// Points times volumes: some minutes where doubles decide, hours where most points lie on tilted faces. A
// forged file must not take days.
constexpr std::uint64_t k_most_tests = std::uint64_t{1} << 32;

Result<ReadVolumes> volumes_of_tree(const fs::path& path) {
  const auto file = TreeFile::open(path);
  if (!file) return std::unexpected(file.error());
  const auto volumes = load_volumes(*file);
  if (!volumes) return std::unexpected(volumes.error());
  if (volumes->empty()) return refuse(path.string(), "it holds no volumes", "fit some first (bvfit -o)");
  ReadVolumes read;
  for (const VolumeSet& s : volumes->sets) {
    ReadSet set{set_name({.part = s.part, .index = s.index}), s.motion, s.sway, k_none, {}};
    for (std::uint32_t i = s.first; i < s.first + s.count; ++i) {
      const VolumeRecord& r = volumes->volumes[i];
      set.volumes.push_back({std::string(name_of(r.kind)), std::string(r.method_name()),
                             to_double(volumes->volume(i)), r.volume, r.lower_bound});
    }
    read.sets.push_back(std::move(set));
  }
  read.nodes = volumes->nodes.to_vector();
  if (!find_node_sets(read))
    return refuse(path.string(), "VNOD: two nodes have the same set", "fit the volumes again (bvfit)");
  return read;
}

Result<ReadVolumes> read_volumes(const fs::path& path) {
  if (path.extension() == ".tree" || path.extension() == ".stree") return volumes_of_tree(path);
  const auto file = MappedFile::open(path);
  if (!file) return std::unexpected(file.error());
  const auto bytes = file->bytes();
  return read_volumes_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

// What sets that are told by name are to hold, of whatever input. Parts are gathered a kind at a time and
// kept.
class NamedContents {
 public:
  NamedContents(const Input& input, const ReadVolumes& volumes) : input_(input), volumes_(volumes) {}

  Result<std::vector<Double3>> of(const ReadSet& set) {
    std::vector<Double3> out;
    if (set.node == k_none) {
      if (auto ok = add(set.name, set, out); !ok) return std::unexpected(ok.error());
      return out;
    }
    for (const std::uint32_t below : sets_below(volumes_.nodes, set.node)) {
      if (auto ok = add(volumes_.sets[below].name, set, out); !ok) return std::unexpected(ok.error());
    }
    return out;
  }

 private:
  // The points of a part, as `moving` sways.
  Result<void> add(const std::string& name, const ReadSet& moving, std::vector<Double3>& out) {
    const auto part = part_named(name);
    if (!part) return std::unexpected(part.error());
    if (moving.motion == VolumeMotion::rest || moving.sway == 0) {
      out.insert(out.end(), (*part)->points.begin(), (*part)->points.end());
      return {};
    }
    if (!sway_ || sway_->degrees() != moving.sway) {
      auto sway = Sway::make(input_, moving.sway);
      if (!sway) return std::unexpected(sway.error());
      sway_ = std::move(*sway);
    }
    const std::vector<Double3> envelope = sway_->envelope(**part);
    out.insert(out.end(), envelope.begin(), envelope.end());
    return {};
  }

  Result<const PartSet*> part_named(const std::string& name) {
    if (const auto at = parts_.find(name); at != parts_.end()) return &at->second;
    auto like = parts_like(input_, name);
    if (!like) return std::unexpected(like.error());
    for (PartSet& part : *like) {
      std::string its_name = part.name;
      parts_.emplace(std::move(its_name), std::move(part));
    }
    if (const auto at = parts_.find(name); at != parts_.end()) return &at->second;
    return refuse(input_.name, fmt::format("it has no set of points '{}'", name),
                  "name the mesh that the volumes were fitted to");
  }

  const Input& input_;
  const ReadVolumes& volumes_;
  std::map<std::string, PartSet> parts_;
  std::optional<Sway> sway_;
};

struct Verdict {
  std::string set;
  const ReadVolume* volume = nullptr;
  Certificate certificate;
  Double3 worst;
};

// ' (minimal)'; of a volume whose method nobody has told nothing.
std::string method_text(const ReadVolume& v) {
  return v.method.empty() ? "" : fmt::format(" ({})", v.method);
}

// Outside is decided exactly; how far, in float64.
std::string distance_text(double d) {
  if (d == 0) return "less than float64 can tell";
  return std::isfinite(d) ? fmt::format("{:.3g}", d) : "no distance that can be told";
}

constexpr double k_rounding = 1e-6;  // of axes, as certify takes it

double degrees_between(const Double3& a, const Double3& b) {
  return std::acos(std::clamp(dot(a / length(a), b / length(b)), -1.0, 1.0)) * 180 / std::numbers::pi;
}

struct Fault {
  std::string what, mend;
};

std::optional<Fault> fault_of_sizes(const char* what, const Double3& sizes) {
  for (int i = 0; i < 3; ++i) {
    if (!(sizes[i] >= 0))
      return Fault{fmt::format("{} {} is {:.9g}", what, i, sizes[i]), "write none below 0"};
  }
  return std::nullopt;
}
std::optional<Fault> fault_of_radius(double radius) {
  if (radius >= 0) return std::nullopt;
  return Fault{fmt::format("radius is {:.9g}", radius), "write none below 0"};
}

// What is wrong with the sizes or the directions of a volume, which makes it hold nothing; none when that is
// not why.
std::optional<Fault> fault_of(const DoubleBox& v) {
  for (int i = 0; i < 3; ++i) {
    if (v.min[i] > v.max[i])
      return Fault{fmt::format("min {:.9g} is above its max {:.9g} along {}", v.min[i], v.max[i], "xyz"[i]),
                   "write the least as min"};
  }
  return std::nullopt;
}
std::optional<Fault> fault_of(const BoundingSphere<double>& v) {
  return fault_of_radius(v.radius);
}
std::optional<Fault> fault_of(const Capsule<double>& v) {
  return fault_of_radius(v.radius);
}
std::optional<Fault> fault_of(const Cylinder<double>& v) {
  if (v.a == v.b) return Fault{"a and b are one point, which leaves its direction open", "write two points"};
  return fault_of_radius(v.radius);
}
template <class V>
std::optional<Fault> fault_of_axes(const V& v) {
  const std::string mend = "write unit axes at right angles";
  for (std::size_t i = 0; i < v.axes.size(); ++i) {
    if (const double square = dot(v.axes[i], v.axes[i]); !(std::abs(square - 1) <= k_rounding))
      return Fault{fmt::format("axis {} is {:.9g} long and not 1", i, std::sqrt(square)), mend};
  }
  for (std::size_t i = 0; i < v.axes.size(); ++i) {
    const std::size_t j = (i + 1) % v.axes.size();
    if (std::abs(dot(v.axes[i], v.axes[j])) <= k_rounding) continue;
    return Fault{fmt::format("axes {} and {} are at {:.9g} degrees and not at right angles", std::min(i, j),
                             std::max(i, j), degrees_between(v.axes[i], v.axes[j])),
                 mend};
  }
  return std::nullopt;
}
std::optional<Fault> fault_of(const OrientedBox<double>& v) {
  const auto fault = fault_of_sizes("half extent", v.half_extents);
  return fault ? fault : fault_of_axes(v);
}
std::optional<Fault> fault_of(const Ellipsoid<double>& v) {
  const auto fault = fault_of_sizes("semi-axis", v.semi_axes);
  return fault ? fault : fault_of_axes(v);
}
std::optional<Fault> fault_of(const Lozenge<double>& v) {
  if (const auto fault = fault_of_radius(v.radius)) return fault;
  if (length(v.edge0) == 0 || length(v.edge1) == 0) return std::nullopt;
  const double degrees = degrees_between(v.edge0, v.edge1);
  if (std::abs(degrees - 90) * std::numbers::pi / 180 <= k_rounding) return std::nullopt;
  return Fault{fmt::format("edges are at {:.9g} degrees and not at right angles", degrees),
               "write edges at right angles"};
}
std::optional<Fault> fault_of(const Kdop<double>& v) {
  if (v.min.size() != v.normals.size() || v.max.size() != v.normals.size())
    return Fault{
        fmt::format("{} normals have {} min and {} max", v.normals.size(), v.min.size(), v.max.size()),
        "write one of each a normal"};
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    if (v.normals[i] == Double3{}) return Fault{fmt::format("normal {} is 0", i), "write a direction"};
    if (v.min[i] > v.max[i])
      return Fault{fmt::format("min {:.9g} is above its max {:.9g} along normal {}", v.min[i], v.max[i], i),
                   "write the least as min"};
  }
  if (!std::isinf(measures_of(v).volume)) return std::nullopt;
  return Fault{"slabs leave a direction open", "write slabs whose normals span space"};
}
std::optional<Fault> false_shape(const Volume<double>& volume) {
  return std::visit([](const auto& v) { return fault_of(v); }, volume);
}

// An envelope whose motion nobody has told is judged by what is at rest, and says so.
std::string name_of_set(const ReadSet& set) {
  if (set.motion == VolumeMotion::rest) return set.name;
  return set.name + (set.sway > 0 ? " envelope" : " envelope, at rest");
}

std::string line_of(const Verdict& v) {
  const std::string what = fmt::format("{:<16} {:<10} {:<16}", printable(v.set), printable(v.volume->type),
                                       printable(v.volume->method));
  if (v.certificate.holds()) return fmt::format("{} holds all {} points\n", what, v.certificate.points);
  return fmt::format("{} leaves {} of {} points outside, the worst by {}\n", what, v.certificate.outside,
                     v.certificate.points, distance_text(v.certificate.excess));
}

constexpr double k_digits = 1e-5;  // of numbers that volumes say of themselves, relative

// What a flat thing's volume cancels from.
double flat_room(const VolumeMeasures& m) {
  return 1e-12 * m.surface * m.mean_width;
}

// What is wrong with the numbers that a volume says of itself; empty when nothing is.
std::string false_numbers(const ReadVolume& v) {
  const VolumeMeasures m = measures_of(v.volume);
  const double room = k_digits * m.volume + flat_room(m);
  if (v.says_volume && !(std::abs(*v.says_volume - m.volume) <= room))
    return fmt::format("its \"volume\" is {:.6g}, not {:.6g}", m.volume, *v.says_volume);
  if (v.says_bound && !(*v.says_bound >= 0 && *v.says_bound <= m.volume + room))
    return fmt::format("its \"lower_bound\" {:.6g} is no bound of its volume, {:.6g}", *v.says_bound,
                       m.volume);
  return "";
}

// Its slabs, as near to the points as they go.
Kdop<double> drawn_tight(Kdop<double> v, std::span<const Double3> points) {
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    v.min[i] = std::numeric_limits<double>::infinity(), v.max[i] = -v.min[i];
    for (const Double3& p : points) {
      const double x = dot(v.normals[i], p);
      v.min[i] = std::min(v.min[i], x), v.max[i] = std::max(v.max[i], x);
    }
  }
  return v;
}

// A smaller volume of its kind round the same points than its lower bound allows; empty when the quick fits
// and the minimal sphere find none. What holds the points is found anew only for volumes that claim a bound.
std::string false_bound(const ReadVolume& v, std::span<const Double3> points) {
  if (!v.says_bound || !(*v.says_bound > 0) || points.empty()) return "";
  const auto refutes = [&](const VolumeMeasures& m) {
    return *v.says_bound > m.volume * (1 + k_digits) + flat_room(m);
  };
  const auto text = [&](const std::string& what, const VolumeMeasures& m) {
    return fmt::format("its \"lower_bound\" {:.6g} is none: {} of {:.6g} holds the points", *v.says_bound,
                       what, m.volume);
  };
  if (const auto* kdop = std::get_if<Kdop<double>>(&v.volume)) {
    const VolumeMeasures m = measures_of(drawn_tight(*kdop, points));
    return refutes(m) ? text("one with the same normals", m) : "";
  }
  const auto fitter = VolumeFitter::make(points);
  if (!fitter) return "";  // float32 cannot hold what is as large
  for (const FitMethod& m : fit_methods()) {
    if (static_cast<std::size_t>(m.kind) != v.volume.index()) continue;
    if (!m.quick && !(m.least && m.kind == VolumeKind::sphere)) continue;
    const auto fit = fitter->fit(m, {.quality = FitQuality::fast});
    if (fit && fit->certified && refutes(fit->measures)) return text(m.name + " one", fit->measures);
  }
  return "";
}

}  // namespace

Result<void> verify_volumes(const Options& options, Context& context) {
  context.read(options.verify, true);
  const auto volumes = read_volumes(options.verify);
  if (!volumes) return std::unexpected(volumes.error());
  const auto input = read_input(options.inputs, context);
  if (!input) return std::unexpected(input.error());
  Stage stage = context.stage("verify");
  Verdict worst;
  std::string lie;  // the first
  std::size_t failed = 0, judged = 0, done = 0;
  std::uint64_t tests = 0;
  NamedContents contents(*input, *volumes);
  for (const ReadSet& set : volumes->sets) {
    const auto points = contents.of(set);
    if (!points) return std::unexpected(points.error());
    tests += (points->size() + 1) * (set.volumes.size() + 1);
    if (tests > k_most_tests)
      return refuse(options.verify.string(), "more volumes and points than can be judged",
                    "judge parts of it");
    for (const ReadVolume& volume : set.volumes) {
      Verdict v{name_of_set(set), &volume, certify(volume.volume, *points), {}};
      ++judged;
      if (!context.options().quiet || !v.certificate.holds()) context.print(line_of(v));
      if (v.certificate.holds()) {
        if (!lie.empty()) continue;
        std::string wrong = false_numbers(volume);
        // points at rest tell nothing of a bound that holds for their motion
        const bool all = set.motion == VolumeMotion::rest || set.sway > 0;
        if (wrong.empty() && all) wrong = false_bound(volume, *points);
        if (!wrong.empty())
          lie = fmt::format("{}{} of '{}': {}", volume.type, method_text(volume), v.set, wrong);
        continue;
      }
      ++failed;
      v.worst = (*points)[v.certificate.worst];
      if (worst.volume == nullptr || v.certificate.excess > worst.certificate.excess) worst = v;
    }
    stage.progress(static_cast<double>(++done) / static_cast<double>(volumes->sets.size()));
  }
  stage.items(judged, "volumes");
  if (judged == 0)
    return refuse(options.verify.string(), "it has no volumes, so there is nothing to verify",
                  "fit some first (bvfit -o)");
  if (failed == 0 && !lie.empty()) return refuse(options.verify.string(), lie, "fit them again");
  if (failed == 0) return {};
  const std::string which =
      fmt::format("{} of {} volumes leave points outside; the worst is {}{} of '{}'", failed, judged,
                  worst.volume->type, method_text(*worst.volume), worst.set);
  if (const auto fault = false_shape(worst.volume->volume))
    return refuse(options.verify.string(), fmt::format("{}: its {}", which, fault->what), fault->mend);
  return refuse(
      options.verify.string(),
      fmt::format("{}: point {} ({}, {}, {}) lies outside by {}", which, worst.certificate.worst,
                  worst.worst.x, worst.worst.y, worst.worst.z, distance_text(worst.certificate.excess)),
      "fit them again");
}

}  // namespace copse::bvfit
