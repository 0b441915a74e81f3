// What treeprep found, as tables and errors of the report.
#pragma once

#include "lib/analysis/leaves/classify.h"
#include "lib/analysis/measure/cylinder_error.h"
#include "lib/analysis/rings/hierarchy.h"
#include "lib/analysis/surface/trunk_mesh.h"
#include "lib/formats/report.h"
#include "lib/formats/tree/tree.h"
#include "lib/formats/tree_file/omit.h"

#include <span>
#include <vector>

namespace copse::treeprep {

struct Findings {
  const Mesh& mesh;
  std::span<const std::uint32_t> file_order;  // Input::file_order
  const Classification& classes;
  const TrunkMesh& trunk;
  const Hierarchy& hierarchy;
  const Tree& tree;
  std::uint32_t merged_groups = 0;  // by --max-leaf-groups
};

// Counts, where the hierarchy comes from, and the components by class and reason.
void report_findings(const Findings& findings, Report& report);

// The error of the generalized cylinders, as shares of radius and height, and the shares explained.
void report_errors(const CylinderError& error, Report& report);

// What --omit and --only left out and what that saved; nothing is known of what was not even computed.
void report_left_out(const std::vector<Omitted>& omitted, Report& report);

}  // namespace copse::treeprep
