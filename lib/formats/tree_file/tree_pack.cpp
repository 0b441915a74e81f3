#include "lib/formats/tree_file/tree_pack.h"

#include "lib/formats/little_endian.h"
#include "lib/formats/materials.h"
#include "lib/formats/packing/leaf_plan.h"
#include "lib/formats/packing/pack_trunk.h"
#include "lib/formats/packing/range_coder.h"
#include "lib/formats/tree/derive_tree.h"
#include "lib/formats/tree/tree_sections.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include <fmt/format.h>

namespace copse {

struct PackedGroups {
  std::vector<Grid3> centres;
  struct Node {
    std::uint32_t below = 0;  // nodes; none: a bottom node
    std::int64_t group = -1;
    Grid3 centre{};
  };
  std::vector<Node> nodes;
};

struct PackPlan {
  PackGrid grid;
  PackedTrunk trunk;
  PackedLeaves leaves;
  PackedGroups groups;
};

namespace {

constexpr std::size_t k_pack_header = 8;  // two i32: the exponents of the grids

// ---- groups -----------------------------------------------------------------------------------------------

class GroupCoder {
 public:
  GroupCoder(RangeCoder& coder, PackedGroups& groups, const PackedLeaves& leaves, const Head& head)
      : c_(coder), g_(groups), leaves_(leaves), head_(head) {}

  std::string run() {
    if (c_.decoding()) g_.centres.resize(head_.counts.groups), g_.nodes.resize(head_.counts.group_nodes);
    std::size_t leaf = 0;
    c_.stream("groups");
    for (std::size_t g = 0; g < g_.centres.size(); ++g) {
      Grid3 sum{};
      for (std::uint32_t i = 0; i < leaves_.group_sizes[g]; ++i, ++leaf)
        for (std::size_t a = 0; a < 3 && !leaves_.list[leaf].vertices.empty(); ++a)
          sum[a] += leaves_.list[leaf].vertices[0][a];
      for (std::int64_t& a : sum) a /= std::max<std::int64_t>(leaves_.group_sizes[g], 1);
      if (!code(g_.centres[g], sum, centre_)) return "a group is out of range";
    }
    std::int64_t group = 0;
    Grid3 last{};
    std::vector<std::uint32_t> ends;  // of the nodes that the next one is below
    for (std::uint32_t i = 0; i < g_.nodes.size(); ++i) {
      PackedGroups::Node& n = g_.nodes[i];
      const std::uint64_t below = c_.number(below_, n.below);
      if (below >= g_.nodes.size() - i) return "a group node reaches out of the hierarchy";
      n.below = static_cast<std::uint32_t>(below);
      while (!ends.empty() && ends.back() <= i) ends.pop_back();
      const std::uint32_t end = i + 1 + n.below;
      if (end > (ends.empty() ? g_.nodes.size() : ends.back()))
        return "a group node reaches out of the one above";
      if (below > 0) ends.push_back(end);
      if (below == 0) {
        n.group = group + c_.signed_number(group_, n.group - group);
        if (n.group < 0 || n.group >= std::int64_t{head_.counts.groups}) return "a group node names no group";
        group = n.group + 1;
      }
      const Grid3& expected = below == 0 ? g_.centres[static_cast<std::size_t>(n.group)] : last;
      if (!code(n.centre, expected, node_[below != 0])) return "a group node is out of range";
      if (below != 0) last = n.centre;
      if (c_.failed()) return "it ends in the groups";
    }
    return "";
  }

 private:
  bool code(Grid3& p, const Grid3& expected, std::array<SignedModel, 3>& model) {
    bool sound = true;
    for (std::size_t a = 0; a < 3; ++a) {
      p[a] = expected[a] + c_.signed_number(model[a], p[a] - expected[a]);
      sound = sound && std::abs(p[a]) <= k_grid_limit;
    }
    return sound;
  }

  RangeCoder& c_;
  PackedGroups& g_;
  const PackedLeaves& leaves_;
  const Head& head_;
  NumberModel below_;
  SignedModel group_;
  std::array<SignedModel, 3> centre_;
  std::array<std::array<SignedModel, 3>, 2> node_;
};

PackedGroups plan_groups(const Tree& tree, const PackGrid& grid) {
  const auto on_grid = [&](const Float3& p) {
    const double s = grid.step();
    return Grid3{std::llround(p.x / s), std::llround(p.y / s), std::llround(p.z / s)};
  };
  PackedGroups out;
  for (const LeafGroup& g : tree.leaves.groups) out.centres.push_back(on_grid(g.centre));
  for (std::uint32_t i = 0; i < tree.leaves.group_hierarchy.size(); ++i) {
    const GroupNode& n = tree.leaves.group_hierarchy[i];
    out.nodes.push_back({n.skip - i - 1, n.group == k_none ? -1 : std::int64_t{n.group}, on_grid(n.centre)});
  }
  return out;
}

void build_groups(const PackedGroups& packed, const PackedLeaves& leaves, const PackGrid& grid, Tree& tree) {
  const auto place = [&](const Grid3& p) {
    return to_float(Double3{double(p[0]), double(p[1]), double(p[2])} * grid.step());
  };
  std::vector<LeafGroup> groups;
  std::uint32_t first = 0;
  for (std::size_t g = 0; g < packed.centres.size(); ++g) {
    groups.push_back({.centre = place(packed.centres[g]),
                      .radius = 0,
                      .mean_area = 0,
                      .first = first,
                      .count = leaves.group_sizes[g]});
    first += leaves.group_sizes[g];
  }
  std::vector<GroupNode> nodes;
  for (std::uint32_t i = 0; i < packed.nodes.size(); ++i) {
    const PackedGroups::Node& n = packed.nodes[i];
    nodes.push_back({.centre = place(n.centre),
                     .skip = i + 1 + n.below,
                     .group = n.group < 0 ? k_none : static_cast<std::uint32_t>(n.group)});
  }
  std::vector<std::uint32_t> order(leaves.list.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  tree.leaves.groups = std::move(groups);
  tree.leaves.group_hierarchy = std::move(nodes);
  tree.leaves.order = std::move(order);
}

// ---- the whole --------------------------------------------------------------------------------------------

PackGrid grid_of(const Tree& tree, const PackOptions& options) {
  const Float3 e = tree.header.bounds.extent();
  double largest = 1;
  for (const auto* uvs : {&tree.trunk.texcoords, &tree.leaves.texcoords})
    for (const Float2& uv : *uvs)
      largest = std::max({largest, std::abs(double{uv.x}), std::abs(double{uv.y})});
  return {grid_exponent(std::max({e.x, e.y, e.z}), std::clamp(options.position_bits, 8, 20)),
          grid_exponent(std::min(largest, 4.0), std::clamp(options.texcoord_bits, 8, 20))};
}

bool holds(const PackGrid& grid, const Tree& tree) {
  const FloatBox& b = tree.header.bounds;
  double far = 0, uv_far = 0;
  for (int a = 0; a < 3 && !b.empty(); ++a)
    far = std::max({far, std::abs(double{b.min[a]}), std::abs(double{b.max[a]})});
  for (const Double3& c : absolute_centres(tree))
    far = std::max({far, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  for (const auto* uvs : {&tree.trunk.texcoords, &tree.leaves.texcoords})
    for (const Float2& uv : *uvs) uv_far = std::max({uv_far, std::abs(double{uv.x}), std::abs(double{uv.y})});
  return far / grid.step() < double(k_grid_limit) / 2 &&
         uv_far / grid.texcoord_step() < double(k_grid_limit) / 2;
}

// Each group's leaves together, by `rank`; where the file says how a group's leaves are ordered, that order
// stands.
std::vector<std::uint32_t> leaf_order(const Tree& tree, std::span<const std::uint32_t> rank) {
  std::vector<std::uint32_t> order = tree.leaves.order.to_vector();
  if (tree.header.leaf_order != LeafOrder::group) return order;
  for (const LeafGroup& g : tree.leaves.groups)
    std::sort(order.begin() + g.first, order.begin() + g.first + g.count,
              [&](std::uint32_t a, std::uint32_t b) { return rank[a] < rank[b]; });
  return order;
}

std::string code(RangeCoder& coder, PackPlan& plan, const Head& head) {
  if (std::string wrong = code_trunk(coder, plan.trunk, head); !wrong.empty()) return wrong;
  if (std::string wrong = code_leaves(coder, plan.leaves, plan.trunk, head); !wrong.empty()) return wrong;
  return GroupCoder(coder, plan.groups, plan.leaves, head).run();
}

std::expected<Tree, std::string> build(const PackPlan& plan, const Head& head,
                                       const std::vector<Material>& materials) {
  Tree tree;
  tree.header = head.header;
  tree.materials = materials;
  build_trunk(plan.trunk, plan.grid, head, tree);
  if (std::string wrong = build_leaves(plan.leaves, plan.grid, head, tree); !wrong.empty())
    return std::unexpected(wrong);
  build_groups(plan.groups, plan.leaves, plan.grid, tree);
  derive(tree);
  return tree;
}

// The bytes of a plan and what will be read from them.
Result<PackedTree> written(PackPlan plan, const Head& head, const Tree& like) {
  auto built = build(plan, head, like.materials);
  if (!built) return refuse("", built.error(), "store it with --encode fast");
  PackedTree out;
  out.tree = std::move(*built);
  out.tree.textures = like.textures, out.tree.provenance = like.provenance;
  RangeCoder coder;
  if (const std::string wrong = code(coder, plan, head_of(out.tree)); !wrong.empty())
    return fail(Fault::bug, "", "a packed tree that does not read: " + wrong, "report this");
  out.bytes.resize(k_pack_header);
  put(std::span(out.bytes), 0, plan.grid.position), put(std::span(out.bytes), 4, plan.grid.texcoord);
  out.streams = coder.costs();
  const std::vector<std::uint8_t> coded = coder.finish();
  out.bytes.insert(out.bytes.end(), coded.begin(), coded.end());
  out.trunk_error = plan.trunk.largest_error * plan.grid.step();
  out.leaf_error = plan.leaves.largest_error * plan.grid.step();
  // Nothing else would tell before the file is needed.
  if (const auto back = unpack_tree(out.bytes, head_of(out.tree), like.materials); !back)
    return fail(Fault::bug, "", "a packed tree that does not read: " + back.error(), "report this");
  out.plan = std::make_shared<const PackPlan>(std::move(plan));
  return out;
}

}  // namespace

std::string why_unpackable(const Tree& tree) {
  if (tree.header.kind != TreeKind::sensitive) return "a .tree has no hierarchy to pack by";
  const Leaves& l = tree.leaves;
  const Trunk& t = tree.trunk;
  const std::size_t segments = tree.segment_count(), leaves = tree.leaf_count();
  if (t.lines.size() != segments || t.diameters.size() != segments ||
      t.accumulated_lengths.size() != segments || (segments > 0 && t.triangles.empty()))
    return "sections of its trunk were left out";
  if (l.centres.size() != leaves || l.order.size() != leaves ||
      (leaves > 0 && (l.triangles.empty() || l.groups.empty())))
    return "sections of its leaves were left out";
  return "";
}

Result<PackedTree> pack_tree(const Tree& tree, const PackOptions& options) {
  if (const std::string why = why_unpackable(tree); !why.empty())
    return fail(Fault::bug, "", "a tree that cannot be packed: " + why, "report this");
  PackPlan plan{.grid = grid_of(tree, options), .trunk = {}, .leaves = {}, .groups = {}};
  if (!holds(plan.grid, tree))
    return refuse(
        "",
        "the tree lies too far from its origin, or its texture repeats too often, for a grid of this step",
        "store it with --encode fast, or with fewer --position-bits");
  plan.trunk = plan_trunk(tree, plan.grid);
  std::vector<std::uint32_t> rank(tree.leaf_count());
  std::iota(rank.begin(), rank.end(), 0u);
  plan.leaves = plan_leaves(tree, plan.grid, plan.trunk, leaf_order(tree, rank));
  plan.groups = plan_groups(tree, plan.grid);
  return written(std::move(plan), head_of(tree), tree);
}

Result<PackedTree> renumbered(const PackedTree& packed, std::span<const std::uint32_t> leaves) {
  PackPlan plan = *packed.plan;
  std::vector<std::uint32_t> rank(leaves.size());
  for (std::uint32_t i = 0; i < rank.size(); ++i) rank[leaves[i]] = i;
  std::vector<PackedLeaf> list;
  Tree numbered;  // whose leaves are in the order of the plan
  numbered.header.leaf_order = packed.tree.header.leaf_order,
  numbered.leaves.groups = packed.tree.leaves.groups;
  std::vector<std::uint32_t> as_is(leaves.size());
  std::iota(as_is.begin(), as_is.end(), 0u);
  numbered.leaves.order = as_is;
  for (const std::uint32_t leaf : leaf_order(numbered, rank)) list.push_back(plan.leaves.list[leaf]);
  plan.leaves.list = std::move(list);
  return written(std::move(plan), head_of(packed.tree), packed.tree);
}

std::expected<Tree, std::string> unpack_tree(std::span<const std::uint8_t> bytes, const Head& head,
                                             const std::vector<Material>& materials) {
  if (bytes.size() < k_pack_header) return std::unexpected("it is cut off");
  if (head.header.kind != TreeKind::sensitive) return std::unexpected("a .tree is not packed");
  std::uint64_t decoded = 0;
  const Tree none;
  for_each_array(none, head, [&](std::string_view, const auto& array, std::uint64_t count, Presence) {
    decoded += count * sizeof array[0];
  });
  if (decoded > k_free_decoded_bytes + k_max_expansion * bytes.size())
    return std::unexpected("the header counts more than it can hold");
  PackPlan plan{.grid = {get<std::int32_t>(bytes, 0), get<std::int32_t>(bytes, 4)},
                .trunk = {},
                .leaves = {},
                .groups = {}};
  for (const std::int32_t e : {plan.grid.position, plan.grid.texcoord})
    if (e < k_least_exponent || e > k_most_exponent)
      return std::unexpected("the step of its grid is out of range");
  RangeCoder coder(bytes.subspan(k_pack_header));
  if (std::string wrong = code(coder, plan, head); !wrong.empty()) return std::unexpected(wrong);
  if (!coder.exhausted()) return std::unexpected("it has another length than what it holds");
  auto tree = build(plan, head, materials);
  if (!tree) return tree;
  Head found = head_of(*tree);
  found.counts.textures = head.counts.textures;  // they are sections of their own
  if (encode_head(found) != encode_head(head))
    return std::unexpected("the header says something else than what is packed");
  return tree;
}

Result<void> compress_records(ContainerWriter& writer, const Container& source) {
  for (const char* name : {"PROV", "MATL", "MNAM", "TEXR", "TNAM"}) {
    const SectionInfo* s = source.find(name);
    if (!s || s->encoding != Encoding::raw) continue;
    auto bytes = source.read(*s);
    if (!bytes) return std::unexpected(bytes.error());
    if (auto done = writer.put(name, s->version, s->stride, *bytes, Encoding::zstd); !done) return done;
  }
  return {};
}

Result<void> put_packed(ContainerWriter& writer, const PackedTree& packed) {
  const Head head = head_of(packed.tree);
  if (auto done = writer.put("HEAD", k_tree_section_version, 1, encode_head(head)); !done) return done;
  for_each_array(packed.tree, head,
                 [&](std::string_view name, const auto&, std::uint64_t, Presence) { writer.remove(name); });
  return writer.put("PACK", k_pack_version, 1, packed.bytes);
}

Result<Container> unpacked(const Container& file) {
  const SectionInfo* section = file.find("PACK");
  if (!section) return file;
  const SectionInfo *head_section = file.find("HEAD"), *records = file.find("MATL"),
                    *names = file.find("MNAM");
  if (section->version != k_pack_version)
    return file.refuse_section(*section, 0,
                               fmt::format("version {} is unknown to this program", section->version));
  if (!head_section)
    return refuse(file.name(), "section HEAD is missing from the table at offset 64",
                  "restore the file, or make it again");
  Array<std::uint8_t> bytes[4];
  const SectionInfo* const wanted[] = {section, head_section, records, names};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!wanted[i]) continue;
    auto read = file.read(*wanted[i]);
    if (!read) return std::unexpected(read.error());
    bytes[i] = std::move(*read);
  }
  Head head;
  head.header.kind = static_cast<TreeKind>(file.kind());
  if (const HeadFault fault = decode_head(bytes[1], head); !fault.what.empty())
    return file.refuse_section(*head_section, fault.offset, fault.what);
  std::vector<Material> materials;
  if (const RecordFault fault = decode_materials(bytes[2], bytes[3], materials); !fault.what.empty())
    return file.refuse_section(records ? *records : *section, 0, fault.what);
  auto tree = unpack_tree(bytes[0], head, materials);
  if (!tree) return file.refuse_section(*section, 0, tree.error());
  ContainerWriter writer(file);
  writer.remove("PACK");
  Result<void> state;
  for_each_array(*tree, head, [&](std::string_view name, const auto& array, std::uint64_t count, Presence) {
    if (state && file.find(name)) state = file.refuse_section(*file.find(name), 0, "it stands beside PACK");
    if (state && count > 0)
      state = writer.put(name, k_tree_section_version, sizeof array[0], array.as_bytes());
  });
  if (!state) return std::unexpected(state.error());
  auto whole = writer.finish();
  if (!whole) return std::unexpected(whole.error());
  return Container::from_bytes(std::move(*whole), file.name());
}

}  // namespace copse
