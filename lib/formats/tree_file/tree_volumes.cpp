#include "lib/formats/tree_file/tree_volumes.h"

#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree_file/tree_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr std::uint32_t k_version = 1;
constexpr std::array<std::string_view, k_volume_parts> k_part_names{"whole",   "trunk", "leaves", "group",
                                                                    "segment", "cell",  "node"};

template <class T>
Array<std::uint8_t> as_bytes(const Array<T>& array) {
  return {std::span(reinterpret_cast<const std::uint8_t*>(array.data()), array.size() * sizeof(T)), nullptr};
}

template <class T>
Result<void> read(const TreeFile& file, std::string_view name, Array<T>& out) {
  const SectionInfo* section = file.container().find(name);
  if (!section) return {};
  if (section->version != k_version || section->stride != sizeof(T)) {
    return file.container().refuse_section(
        *section, 0,
        fmt::format("version {} with a stride of {} is unknown to this program", section->version,
                    section->stride));
  }
  const auto bytes = file.section(name);
  if (!bytes) return std::unexpected(bytes.error());
  const auto owner = std::make_shared<Array<std::uint8_t>>(*bytes);
  out = {std::span(reinterpret_cast<const T*>(owner->data()), owner->size() / sizeof(T)), owner};
  return {};
}

// How many of a part there can be; 1 where there is but one and no index.
std::uint64_t limit_of(VolumePart part, const TreeCounts& counts, std::size_t nodes) {
  switch (part) {
    case VolumePart::group:
      return counts.groups;
    case VolumePart::segment:
      return counts.segments;
    case VolumePart::node:
      return nodes;
    case VolumePart::cell:
      return k_none;
    case VolumePart::whole:
    case VolumePart::trunk:
    case VolumePart::leaves:
      break;
  }
  return 0;
}

void check_sets(const TreeVolumes& v, const TreeCounts& counts, Findings& findings) {
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < v.sets.size(); ++i) {
    const VolumeSet& s = v.sets[i];
    const auto part = static_cast<std::uint32_t>(s.part), motion = static_cast<std::uint32_t>(s.motion);
    if (part >= k_volume_parts || motion > 1) {
      findings.add("VSET", i, "an unknown part or motion", fmt::format("{} {}", part, motion));
      continue;
    }
    const float most = s.motion == VolumeMotion::envelope ? 180 : 0;
    if (!(s.sway >= 0 && s.sway <= most))
      findings.add("VSET", i, "an angle of sway that is out of range", fmt::format("{}", s.sway));
    const std::uint64_t limit = limit_of(s.part, counts, v.nodes.size());
    if (limit == 0 ? s.index != k_none : s.index >= limit) {
      findings.add("VSET", i, "index of the part out of range", fmt::format("{}", s.index));
    }
    if (s.first != next || s.count == 0 ||
        s.count > v.volumes.size() - std::min<std::uint64_t>(next, v.volumes.size())) {
      findings.add("VSET", i, "its volumes do not follow those of the set before",
                   fmt::format("{} from {}", s.count, s.first));
      return;
    }
    if (s.chosen >= s.count)
      findings.add("VSET", i, "what is chosen is none of its volumes", fmt::format("{}", s.chosen));
    next += s.count;
  }
  if (next != v.volumes.size()) findings.add("VOLU", next, "volumes of no set");
}

bool is_method_name(const VolumeRecord& r) {
  const std::string_view name = r.method_name();
  const bool printable = std::all_of(name.begin(), name.end(), [](char c) { return c > 0x20 && c < 0x7f; });
  const bool filled = std::all_of(r.method.begin() + static_cast<std::ptrdiff_t>(name.size()), r.method.end(),
                                  [](char c) { return c == 0; });
  return !name.empty() && printable && filled;
}

void check_records(const TreeVolumes& v, Findings& findings) {
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < v.volumes.size(); ++i) {
    const VolumeRecord& r = v.volumes[i];
    if (static_cast<std::uint32_t>(r.kind) >= k_volume_kinds) {
      findings.add("VOLU", i, "an unknown kind", fmt::format("{}", static_cast<std::uint32_t>(r.kind)));
      return;
    }
    if (r.first != next || !is_number_count(r.kind, r.count) ||
        r.count > v.numbers.size() - std::min<std::uint64_t>(next, v.numbers.size())) {
      findings.add("VOLU", i, "its numbers do not follow those of the volume before",
                   fmt::format("{} from {}", r.count, r.first));
      return;
    }
    next += r.count;
    if ((r.flags & ~std::uint32_t{VolumeRecord::certified}) != 0) {
      findings.add("VOLU", i, "unknown flags", fmt::format("{}", r.flags));
    }
    if (!is_method_name(r)) findings.add("VOLU", i, "a method without a name");
    if (!(r.volume >= 0) || !(r.lower_bound >= 0) || !std::isfinite(r.volume) ||
        !(r.lower_bound <= r.volume)) {
      findings.add("VOLU", i, "a volume that is negative, not finite or below its bound",
                   fmt::format("{} {}", r.volume, r.lower_bound));
    }
    if (!is_sound(v.volume(i))) findings.add("VOLU", i, "numbers that make no volume");
  }
  if (next != v.numbers.size()) findings.add("VNUM", next, "numbers of no volume");
}

// Depth first: every node ends inside the one that it hangs below, and a node without an item has something
// below it.
void check_nodes(const TreeVolumes& v, Findings& findings) {
  std::vector<std::uint32_t> ends;
  for (std::uint32_t i = 0; i < v.nodes.size(); ++i) {
    const VolumeNode& n = v.nodes[i];
    while (!ends.empty() && ends.back() == i) ends.pop_back();
    const std::uint32_t end = ends.empty() ? static_cast<std::uint32_t>(v.nodes.size()) : ends.back();
    const bool bottom = n.item != k_none;
    if ((ends.empty() && i != 0) || n.skip > end || n.skip < i + 1 + (bottom ? 0 : 1) ||
        (bottom && n.skip != i + 1)) {
      findings.add("VNOD", i, "the nodes are not those of a tree, depth first", fmt::format("{}", n.skip));
      return;
    }
    if (i == 0 && n.skip != v.nodes.size()) findings.add("VNOD", 0, "nodes that are not below the root");
    if (n.set >= v.sets.size()) findings.add("VNOD", i, "set out of range", fmt::format("{}", n.set));
    if (!bottom) ends.push_back(n.skip);
  }
}

}  // namespace

std::string_view VolumeRecord::method_name() const {
  const auto end = std::find(method.begin(), method.end(), '\0');
  return {method.data(), static_cast<std::size_t>(end - method.begin())};
}

std::string set_name(const VolumeSet& set) {
  std::string name(k_part_names[static_cast<std::size_t>(set.part)]);
  if (set.index != k_none) name += fmt::format(" {}", set.index);
  if (set.motion == VolumeMotion::envelope) name += " envelope";
  return name;
}

Result<std::vector<std::uint8_t>> with_volumes(const Container& file, const TreeVolumes& volumes) {
  ContainerWriter writer(file);
  Result<void> state;
  // A file whose tree is packed is to be small; elsewhere volumes are read in place.
  const Encoding encoding = file.find("PACK") ? Encoding::zstd : Encoding::raw;
  const auto put = [&](std::string_view name, const auto& array) {
    writer.remove(name);
    if (array.empty() || !state) return;
    state = writer.put(name, k_version, sizeof array[0], as_bytes(array), encoding);
  };
  put("VSET", volumes.sets);
  put("VOLU", volumes.volumes);
  put("VNUM", volumes.numbers);
  put("VNOD", volumes.nodes);
  if (!state) return std::unexpected(state.error());
  return writer.finish();
}

Result<TreeVolumes> load_volumes(const TreeFile& file) {
  TreeVolumes v;
  if (auto ok = read(file, "VSET", v.sets); !ok) return std::unexpected(ok.error());
  if (auto ok = read(file, "VOLU", v.volumes); !ok) return std::unexpected(ok.error());
  if (auto ok = read(file, "VNUM", v.numbers); !ok) return std::unexpected(ok.error());
  if (auto ok = read(file, "VNOD", v.nodes); !ok) return std::unexpected(ok.error());
  const auto wrong = check_volumes(v, file.counts());
  if (!wrong.empty()) {
    return refuse(file.container().name(), wrong.front(), "fit the volumes again (bvfit)");
  }
  return v;
}

std::vector<std::string> check_volumes(const TreeVolumes& volumes, const TreeCounts& counts) {
  Findings findings;
  check_sets(volumes, counts, findings);
  check_records(volumes, findings);
  check_nodes(volumes, findings);
  return findings.lines();
}

}  // namespace copse
