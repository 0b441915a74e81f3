// copse.volumes/1 (cli.md): written, and read back from any source.
#pragma once

#include "lib/formats/result.h"
#include "tools/bvfit/fits.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace copse::bvfit {

// One volume a line. Numbers are those of the float32 values, so that reading them as doubles or as floats
// gives the same. A hierarchy is "nodes": depth first, "skip" as in BoxNode, "set" an index into "sets".
std::string volumes_json(const Input& input, std::span<const SetFit> sets, std::span<const VolumeNode> nodes,
                         const Options& options);

// Volumes as another program may have written them: numbers in double, as they are.
struct ReadVolume {
  std::string type, method;
  Volume<double> volume;
  std::optional<double> says_volume = std::nullopt, says_bound = std::nullopt;
};
struct ReadSet {
  std::string name;  // without " envelope"
  VolumeMotion motion = VolumeMotion::rest;
  float sway = 0;               // of an envelope, degrees; 0: not known
  std::uint32_t node = k_none;  // whose set this is; k_none of a part's
  std::vector<ReadVolume> volumes;
};
struct ReadVolumes {
  std::vector<ReadSet> sets;
  std::vector<VolumeNode> nodes;  // skip and set alone
};
// Refused: what is no JSON, has no sets, has a volume whose type or members are unknown or missing, or nodes
// that are no hierarchy over the sets.
Result<ReadVolumes> read_volumes_json(const std::string& text, const std::string& file);

// Tells the sets of inner nodes so; false when the nodes are no hierarchy over the sets.
bool find_node_sets(ReadVolumes& volumes);

}  // namespace copse::bvfit
