#include "tools/treeprep/strict_stage.h"
namespace copse::treeprep {
Result<void> strict_stage(const Input&, const Classification&, Context&) {
  return {};
}
}  // namespace copse::treeprep
