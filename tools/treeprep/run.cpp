#include "tools/treeprep/run.h"

#include "lib/analysis/measure/cylinder_error.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_pack.h"
#include "tools/treeprep/analyse.h"
#include "tools/treeprep/findings.h"
#include "tools/treeprep/input.h"
#include "tools/treeprep/parts.h"
#include "tools/treeprep/picture.h"
#include "tools/treeprep/provenance.h"

#include <fmt/format.h>

namespace copse::treeprep {
namespace {

Result<TreeKind> kind_of(const std::filesystem::path& output) {
  if (output.extension() == ".tree") return TreeKind::still;
  if (output.extension() == ".stree") return TreeKind::sensitive;
  return fail(Fault::usage, output.string(), "the output's extension picks its kind",
              "name it .tree (static) or .stree (able to move)");
}

// The measures and pictures that only a report or a page shows.
Result<void> report_stage(const Input& input, const Analysis& a, const LeftOut& left_out, Context& context) {
  Report& report = context.report();
  if (context.options().report.empty() && context.options().html.empty()) return {};
  report_findings(
      {input.mesh, input.file_order, a.classes, a.trunk, a.hierarchy, a.assembled.tree, a.leaves.merged},
      report);
  if (!left_out.sections.empty()) {
    const auto reduced = leave_out(a.assembled.tree, left_out.sections);
    if (!reduced) return std::unexpected(reduced.error());
    report_left_out(reduced->omitted, report);
  }
  {
    Stage stage = context.stage("measure");
    stage.items(a.trunk.triangles.size(), "trunk triangles");
    report_errors(cylinder_error(a.trunk, a.hierarchy, bounds(input.mesh).extent().y), report);
  }
  if (context.options().html.empty()) return {};
  Stage stage = context.stage("draw");
  auto skeletons = skeleton_pictures(input.mesh, a.classes, a.hierarchy);
  if (!skeletons) return std::unexpected(skeletons.error());
  auto groups = group_pictures(input.mesh, a.classes, a.leaves.groups.groups, a.assembled.tree.header.origin);
  if (!groups) return std::unexpected(groups.error());
  report.pictures = std::move(*skeletons);
  report.pictures.insert(report.pictures.end(), groups->begin(), groups->end());
  return {};
}

// Packed: the file is written as it would be, then its sections are packed into one.
Result<void> write_packed(const Options& options, const Tree& tree, const LeftOut& left_out, Stage& stage,
                          Context& context) {
  auto plain = encode_tree(tree, {.encoding = Encoding::raw, .omit = left_out.sections});
  if (!plain) return std::unexpected(plain.error());
  const auto file = TreeFile::from_bytes(std::move(*plain), options.output.string(), Trust::file);
  if (!file) return std::unexpected(file.error());
  const auto reduced = file->load();
  if (!reduced) return std::unexpected(reduced.error());
  if (const std::string why = why_unpackable(*reduced); !why.empty())
    return fail(Fault::usage, options.output.string(), "this tree cannot be packed: " + why,
                "leave --encode small away, or name an .stree and omit less");
  const auto packed = pack_tree(*reduced, {.position_bits = options.position_bits});
  if (!packed)
    return fail(packed.error().fault, options.output.string(), packed.error().what, packed.error().remedy);
  context.report().errors.push_back({"packing of the trunk, largest",
                                     packed->trunk_error,
                                     "m",
                                     packed->trunk_error,
                                     {},
                                     {},
                                     "the tree before packing"});
  context.report().errors.push_back({"packing of the leaves, largest",
                                     packed->leaf_error,
                                     "m",
                                     packed->leaf_error,
                                     {},
                                     {},
                                     "the tree before packing"});
  ContainerWriter writer(file->container());
  if (auto done = compress_records(writer, file->container()); !done) return done;
  if (auto done = put_packed(writer, *packed); !done) return done;
  const auto bytes = writer.finish();
  if (!bytes) return std::unexpected(bytes.error());
  stage.items(bytes->size(), "bytes");
  return context.write(options.output, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

Result<void> write_stage(const Options& options, Analysis& a, const LeftOut& left_out, Context& context) {
  Stage stage = context.stage("write");
  auto origin = provenance(options, context.options().seed);
  if (!origin) return std::unexpected(origin.error());
  a.assembled.tree.provenance = std::move(*origin);
  if (options.small) return write_packed(options, a.assembled.tree, left_out, stage, context);
  const auto bytes =
      encode_tree_pieces(a.assembled.tree, {.encoding = options.encoding, .omit = left_out.sections});
  if (!bytes) return std::unexpected(bytes.error());
  stage.items(bytes->size(), "bytes");
  return context.write(options.output, *bytes);
}

}  // namespace

Result<void> run(const Options& options, Context& context) {
  const auto kind = kind_of(options.output);
  if (!kind) return std::unexpected(kind.error());
  const auto left_out = left_out_parts(options.omit, options.only);
  if (!left_out) return std::unexpected(left_out.error());
  if (const auto ok = context.check_output(options.output); !ok) return ok;
  auto input = read_input(options, context);
  if (!input) return std::unexpected(input.error());
  if (const auto ok = context.check_output(options.output); !ok)
    return ok;  // now that it is known what is read
  auto analysis = analyse(*input, options, *kind, *left_out, context);
  if (!analysis) return std::unexpected(analysis.error());
  if (const auto ok = write_stage(options, *analysis, *left_out, context); !ok) return ok;
  return report_stage(*input, *analysis, *left_out, context);
}

}  // namespace copse::treeprep
