#include "lib/formats/tree/check_tree.h"

#include "lib/formats/tree/check_parts.h"
#include "lib/formats/tree/tree_sections.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace copse {

std::string to_text(const Finding& f) {
  if (f.element == Finding::k_no_element) return f.section + ": " + f.what;
  return fmt::format("{}[{}]: {}", f.section, f.element, f.what);
}

bool Findings::counted(std::string_view section, std::string_view kind) {
  auto at = std::find_if(kinds_.begin(), kinds_.end(),
                         [&](const Kind& k) { return k.kind == kind && k.section == section; });
  if (at == kinds_.end()) at = kinds_.insert(at, {std::string(section), std::string(kind)});
  return ++at->count <= k_listed;
}

void Findings::list(std::string_view section, std::size_t element, std::string_view kind,
                    const std::string& detail) {
  std::string what(kind);
  if (!detail.empty()) what += ": " + detail;
  listed_.push_back({std::string(section), element, std::move(what)});
}

std::vector<std::string> Findings::lines() const {
  std::vector<std::string> lines;
  for (const Finding& f : listed_) lines.push_back(to_text(f));
  for (const Kind& k : kinds_) {
    if (k.count > k_listed) lines.push_back(fmt::format("{}: {}: {} in all", k.section, k.kind, k.count));
  }
  return lines;
}

namespace {

constexpr std::uint64_t k_max_count = k_none - 1;  // indices are 32 bits, and the last value means "none"

struct SizeCheck {
  Findings& findings;

  void parallel(std::string_view section, std::size_t size, std::size_t wanted, std::string_view of) const {
    if (size != 0 && size != wanted) {
      findings.add(section, Finding::k_no_element, "not parallel",
                   fmt::format("{} entries for {} {}", size, wanted, of));
    }
  }
  // Runs of elements: all of one length, or offsets.
  void runs(std::string_view section, std::uint32_t constant, const Array<std::uint32_t>& offsets,
            std::size_t owners, std::size_t elements) const {
    if (constant != 0) {
      if (elements == 0) {
        findings.add(section, Finding::k_no_element, "a constant length of runs that are empty",
                     fmt::format("{}", constant));
      }
      if (!offsets.empty()) {
        findings.add(section, Finding::k_no_element, "offsets beside a constant",
                     fmt::format("{}", constant));
      }
      if (elements != std::uint64_t{constant} * owners) {
        findings.add(section, Finding::k_no_element, "the constant does not fit",
                     fmt::format("{} elements in {} runs of {}", elements, owners, constant));
      }
      return;
    }
    if (elements == 0 && offsets.empty()) return;
    if (offsets.size() != owners + 1) {
      findings.add(section, Finding::k_no_element, "not parallel",
                   fmt::format("{} offsets for {} runs", offsets.size(), owners));
    } else if (offsets[0] != 0 || offsets[owners] != elements) {
      findings.add(section, Finding::k_no_element, "offsets do not span the elements",
                   fmt::format("{} to {} of {}", offsets[0], offsets[owners], elements));
    }
  }
};

}  // namespace

std::vector<std::string> check_sizes(const Tree& tree) {
  Findings findings;
  const SizeCheck check{findings};
  const TreeHeader& h = tree.header;
  const Trunk& t = tree.trunk;
  const Leaves& l = tree.leaves;
  const bool sensitive = h.kind == TreeKind::sensitive;
  if (!sensitive && h.kind != TreeKind::still) findings.add("HEAD", Finding::k_no_element, "unknown kind");
  if (sensitive && !(t.vertices.empty() && t.line_vertices.empty())) {
    findings.add("TVTX", Finding::k_no_element, "an .stree carries no trunk vertices: they are rebuilt");
  }
  const RadiusHierarchy& r = tree.hierarchy;
  if (!sensitive && !(r.radii.empty() && r.vectors.empty() && r.first_vector.empty())) {
    findings.add("RADI", Finding::k_no_element, "a .tree carries no hierarchy");
  }
  for_each_array(tree, {.header = h, .counts = {}},
                 [&](std::string_view name, const auto& array, std::uint64_t, Presence) {
                   if (array.size() > k_max_count) {
                     findings.add(name, Finding::k_no_element, "too many elements for 32-bit indices");
                   }
                 });
  const std::size_t segments = tree.segment_count(), leaves = tree.leaf_count();
  check.parallel("TLIN", t.lines.size(), segments, "segments");
  check.parallel("TACC", t.accumulated_lengths.size(), segments, "segments");
  check.parallel("TMAT", t.materials.size(), t.triangles.size(), "triangles");
  check.runs("TFIR", h.segment_factor, t.first_triangle, segments, t.triangles.size());
  check.parallel("LORD", l.order.size(), leaves, "leaves");
  check.parallel("LMAT", l.materials.size(), leaves, "leaves");
  check.runs("LFIR", h.leaf_factor, l.first_triangle, leaves, l.triangles.size());
  if (sensitive) check.runs("RFIR", h.ring_size, r.first_vector, r.radii.size(), r.vectors.size());
  return findings.lines();
}

std::string check_counts(const Head& head) {
  const TreeHeader& h = head.header;
  const TreeCounts& c = head.counts;
  const auto runs = [](const char* what, std::uint32_t constant, std::uint32_t owners,
                       std::uint32_t elements) {
    const bool fits = constant == 0 ? elements == 0 || owners > 0
                                    : elements > 0 && std::uint64_t{constant} * owners == elements;
    return fits ? std::string() : fmt::format("{} {} in {} runs of {}", elements, what, owners, constant);
  };
  const bool sensitive = h.kind == TreeKind::sensitive;
  if (!sensitive && c.radii > 0) return fmt::format("{} radii, but a .tree carries no hierarchy", c.radii);
  if (sensitive && c.line_vertices > 0) {
    return fmt::format("{} line vertices, but an .stree's lines join radii", c.line_vertices);
  }
  std::string wrong = runs("trunk triangles", h.segment_factor, c.segments, c.trunk_triangles);
  if (wrong.empty()) wrong = runs("leaf triangles", h.leaf_factor, c.leaves, c.leaf_triangles);
  if (wrong.empty() && sensitive) wrong = runs("vertex vectors", h.ring_size, c.radii, c.trunk_vertices);
  if (wrong.empty() &&
      ((head.trunk_materials && c.trunk_triangles == 0) || (head.leaf_materials && c.leaves == 0))) {
    wrong = "materials of each, but there are none";
  }
  return wrong;
}

void check_elements(const Tree& tree, const Head& head, Findings& findings) {
  const Check check{tree, head, findings};
  check_header(check);
  const bool hierarchy = check_hierarchy(check);
  check_trunk(check, hierarchy);
  const bool leaves = check_leaves(check);
  check_groups(check, leaves);
  check_group_hierarchy(check);
}

std::vector<std::string> check_tree(const Tree& tree) {
  if (auto wrong = check_sizes(tree); !wrong.empty()) return wrong;
  Findings findings;
  check_elements(tree, head_of(tree), findings);
  return findings.lines();
}

}  // namespace copse
