#include "tools/treeprep/strict_stage.h"

#include "lib/analysis/surface/weld.h"
#include "lib/analysis/trunk/strict_model.h"

#include <fmt/format.h>

namespace copse::treeprep {
namespace {

// "4.1, 4.5"
std::string rules_of(const StrictModel& model) {
  std::string rules;
  for (const Breach& breach : model.breaches) {
    const std::string number = breach.rule.substr(0, breach.rule.find(':'));
    if (rules.ends_with(number)) continue;
    rules += (rules.empty() ? "" : ", ") + number;
  }
  return rules;
}

std::unexpected<Error> refuse_breaches(const Input& input, const StrictModel& model, Context& context) {
  for (const std::string& fault : input.faults) context.print(fault + "\n");
  for (const Breach& breach : model.breaches) context.print(to_text(breach) + "\n");
  const std::string rules = rules_of(model);
  return refuse(input.name,
                rules.empty() ? "the file is not sound, see the list"
                : input.faults.empty()
                    ? fmt::format("it breaks the strict model's rules {}, see the list", rules)
                    : fmt::format("the file is not sound and breaks the strict model's "
                                  "rules {}, see the list",
                                  rules),
                "mend the mesh, or leave --strict out to have it read as it is");
}

}  // namespace

Result<StrictTrunk> strict_stage(const Input& input, const Classification& classes, const Options& options,
                                 Context& context) {
  Stage stage = context.stage("strict model");
  stage.items(input.mesh.triangles.size(), "triangles");
  const Mesh& mesh = input.mesh;
  const std::vector<std::uint32_t> welded =
      options.weld < 0 ? weld(mesh.positions, weld_tolerances(mesh.positions, mesh.triangles))
                       : weld(mesh.positions, weld_tolerance(input, options));
  const StrictModel model = read_strict_model(mesh, welded, classes.leaf_of);
  if (!input.faults.empty() || !model.breaches.empty()) return refuse_breaches(input, model, context);
  return strict_hierarchy(model, mesh, welded, classes.leaf_of);
}

}  // namespace copse::treeprep
