#include "tools/treeprep/provenance.h"

#include "lib/formats/hash.h"

#include <nlohmann/json.hpp>

namespace copse::treeprep {
namespace {

nlohmann::ordered_json options_json(const Options& options, std::uint64_t seed) {
  static constexpr const char* k_skeletons[] = {"auto", "rings", "surface"};
  static constexpr const char* k_orders[] = {"group", "terminal", "random"};
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  if (options.up == UpAxis::z) out["up"] = "z";
  if (options.scale != 1) out["scale"] = options.scale;
  if (options.weld >= 0) out["weld"] = options.weld;
  if (options.strict) out["strict"] = true;
  if (!options.trunk_patterns.empty()) out["trunk"] = options.trunk_patterns;
  if (!options.leaf_patterns.empty()) out["leaf"] = options.leaf_patterns;
  if (options.skeleton != Skeleton::automatic)
    out["skeleton"] = k_skeletons[static_cast<int>(options.skeleton)];
  for (const Double3& p : options.roots) out["roots"].push_back({p.x, p.y, p.z});
  if (options.max_leaf_groups > 0) out["max-leaf-groups"] = options.max_leaf_groups;
  if (options.leaf_order != LeafOrder::group)
    out["leaf-order"] = k_orders[static_cast<int>(options.leaf_order)];
  if (options.leaf_order == LeafOrder::random) out["seed"] = seed;
  return out;
}

}  // namespace

Result<std::string> provenance(const Options& options, std::uint64_t seed) {
  nlohmann::ordered_json out;
  out["tool"] = "treeprep";
  out["version"] = COPSE_VERSION;
  out["sources"] = nlohmann::ordered_json::array();
  for (const std::filesystem::path& path : options.inputs) {
    auto file = hash_file(path);
    if (!file) return std::unexpected(file.error());
    nlohmann::ordered_json source{{"name", path.filename().string()}};
    if (!file->hash.empty()) source.update({{"bytes", file->bytes}, {"hash", file->hash}});  // else a pipe
    out["sources"].push_back(std::move(source));
  }
  out["options"] = options_json(options, seed);
  return out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace copse::treeprep
