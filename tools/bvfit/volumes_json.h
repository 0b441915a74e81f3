// copse.volumes/1 (cli.md): written, and read back from any source.
#pragma once

#include "lib/formats/result.h"
#include "tools/bvfit/fits.h"

#include <span>
#include <string>
#include <vector>

namespace copse::bvfit {

// One volume a line. Numbers are those of the float32 values, so that reading them as doubles or as floats
// gives the same.
std::string volumes_json(const Input& input, std::span<const SetFit> sets, const Options& options);

// Volumes as another program may have written them: numbers in double, as they are.
struct ReadVolume {
  std::string type, method;
  Volume<double> volume;
  bool says_certified = false;
};
struct ReadSet {
  std::string name;
  std::vector<ReadVolume> volumes;
};
// Refused: what is no JSON, has no sets, or has a volume whose type or members are unknown or missing.
Result<std::vector<ReadSet>> read_volumes_json(const std::string& text, const std::string& file);

}  // namespace copse::bvfit
