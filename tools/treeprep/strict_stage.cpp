#include "tools/treeprep/strict_stage.h"

#include "lib/analysis/surface/weld.h"
#include "lib/analysis/trunk/strict_model.h"

#include <fmt/format.h>

namespace copse::treeprep {

Result<void> strict_stage(const Input& input, const Classification& classes, Context& context) {
  Stage stage = context.stage("strict model");
  stage.items(input.mesh.triangles.size(), "triangles");
  const Mesh& mesh = input.mesh;
  const std::vector<std::uint32_t> welded =
      weld(mesh.positions, weld_tolerances(mesh.positions, mesh.triangles));
  const StrictModel model = read_strict_model(mesh, welded, classes.leaf_of);
  if (model.breaches.empty()) return {};
  for (const Breach& breach : model.breaches) context.warn(input.name + ": " + to_text(breach));
  return refuse(input.name,
                fmt::format("it breaks {} rules of the strict model, named above", model.breaches.size()),
                "mend the mesh, or leave --strict out to have it read as it is");
}

}  // namespace copse::treeprep
