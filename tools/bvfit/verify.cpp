#include "tools/bvfit/verify.h"

#include "lib/analysis/volumes/certify.h"
#include "lib/formats/mapped_file.h"
#include "tools/bvfit/volumes_json.h"

#include <map>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

namespace fs = std::filesystem;

Result<std::vector<ReadSet>> sets_of_tree(const fs::path& path) {
  const auto file = TreeFile::open(path);
  if (!file) return std::unexpected(file.error());
  const auto volumes = load_volumes(*file);
  if (!volumes) return std::unexpected(volumes.error());
  if (volumes->empty()) return refuse(path.string(), "it holds no volumes", "fit some first (bvfit -o)");
  std::vector<ReadSet> sets;
  for (const VolumeSet& s : volumes->sets) {
    // A node's and an envelope's points are not those of a part: treedump --verify looks at these.
    if (s.part == VolumePart::node || s.motion != VolumeMotion::rest) continue;
    ReadSet set{set_name(s), {}};
    for (std::uint32_t i = s.first; i < s.first + s.count; ++i) {
      const VolumeRecord& r = volumes->volumes[i];
      set.volumes.push_back({std::string(name_of(r.kind)), std::string(r.method_name()),
                             to_double(volumes->volume(i)), (r.flags & VolumeRecord::certified) != 0});
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

Result<std::vector<ReadSet>> read_sets(const fs::path& path) {
  if (path.extension() == ".tree" || path.extension() == ".stree") return sets_of_tree(path);
  const auto file = MappedFile::open(path);
  if (!file) return std::unexpected(file.error());
  const auto bytes = file->bytes();
  return read_volumes_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

struct Verdict {
  const ReadSet* set = nullptr;
  const ReadVolume* volume = nullptr;
  Certificate certificate;
  Double3 worst;
};

std::string line_of(const Verdict& v) {
  const std::string what = fmt::format("{:<16} {:<10} {:<16}", v.set->name, v.volume->type, v.volume->method);
  if (v.certificate.holds()) return fmt::format("{} holds all {} points\n", what, v.certificate.points);
  return fmt::format("{} leaves {} of {} points outside, the worst by {:.3g}\n", what, v.certificate.outside,
                     v.certificate.points, v.certificate.excess);
}

}  // namespace

Result<void> verify_volumes(const Options& options, Context& context) {
  context.read(options.verify, true);
  const auto sets = read_sets(options.verify);
  if (!sets) return std::unexpected(sets.error());
  const auto input = read_input(options.inputs, context);
  if (!input) return std::unexpected(input.error());
  Stage stage = context.stage("verify");
  Verdict worst;
  std::size_t failed = 0, judged = 0;
  std::map<std::string, PartSet> parts;
  for (const ReadSet& set : *sets) {
    if (!parts.contains(set.name)) {
      auto part = part_named(*input, set.name);
      if (!part) return std::unexpected(part.error());
      parts.emplace(set.name, std::move(*part));
    }
    const PartSet& part = parts.at(set.name);
    for (const ReadVolume& volume : set.volumes) {
      Verdict v{&set, &volume, certify(volume.volume, part.points), {}};
      ++judged;
      if (!context.options().quiet || !v.certificate.holds()) context.print(line_of(v));
      if (v.certificate.holds()) continue;
      ++failed;
      v.worst = part.points[v.certificate.worst];
      if (worst.set == nullptr || v.certificate.excess > worst.certificate.excess) worst = v;
    }
  }
  stage.items(judged, "volumes");
  if (failed == 0) return {};
  return refuse(options.verify.string(),
                fmt::format("{} of {} volumes leave points outside; the worst is {} ({}) of '{}': point {} "
                            "({}, {}, {}) lies {:.3g} outside",
                            failed, judged, worst.volume->type, worst.volume->method, worst.set->name,
                            worst.certificate.worst, worst.worst.x, worst.worst.y, worst.worst.z,
                            worst.certificate.excess),
                "fit them again");
}

}  // namespace copse::bvfit
