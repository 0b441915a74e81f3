#include "lib/formats/tree_file/tree_file.h"

#include "lib/formats/little_endian.h"
#include "lib/formats/materials.h"
#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree/tree_sections.h"
#include "lib/formats/tree_file/tree_pack.h"
#include "lib/formats/tree_file/tree_volumes.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

using Names = std::vector<std::string>;

bool holds(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_tree_section(std::string_view name) {
  constexpr std::string_view k_records[] = {"HEAD", "OMIT", "PROV", "MATL", "MNAM", "TEXR", "TNAM", "TDAT"};
  bool found = std::find(std::begin(k_records), std::end(k_records), name) != std::end(k_records);
  for (const TreeKind kind : {TreeKind::still, TreeKind::sensitive}) {
    Head head;
    head.header.kind = kind;
    const Tree tree;
    for_each_array(tree, head, [&](std::string_view array, const auto&, std::uint64_t, Presence) {
      found |= array == name;
    });
  }
  return found;
}

}  // namespace

struct TreeFile::Impl {
  Container stored;  // as it is
  Container file;    // as it reads: what is packed, unpacked
  Trust trust = Trust::nothing;
  Head head;
  std::vector<Omitted> omitted;
  Names omitted_names;

  Result<void> read_head();
  Result<void> read_omitted();
  Result<void> check_version(const SectionInfo& section, std::size_t stride) const;
  Result<void> check_section(std::string_view name, std::uint64_t count, std::size_t stride,
                             Presence presence) const;
  Result<void> check_table() const;
  Result<Tree> load(const Names* only, Verify verify) const;

  bool is_omitted(std::string_view name) const { return holds(omitted_names, name); }
  std::unexpected<Error> missing(std::string_view name) const {
    return refuse(file.name(), fmt::format("section {} is missing from the table at offset 64", name),
                  "restore the file, or make it again");
  }
  // The decoded bytes of a section, none when there is no such section.
  Result<Array<std::uint8_t>> bytes(std::string_view name, Verify verify) const {
    const SectionInfo* section = file.find(name);
    if (!section) return Array<std::uint8_t>();
    return file.read(*section, verify);
  }
  Result<void> load_records(const Names* only, Verify verify, Tree& tree) const;
  std::unexpected<Error> refuse_finding(const Finding& finding) const;
};

Result<void> TreeFile::Impl::read_head() {
  if (file.kind() != FileKind::tree && file.kind() != FileKind::stree) {
    return refuse(file.name(), "header at offset 12: this is no tree but an ecosystem",
                  "name a .tree or .stree file");
  }
  head.header.kind = static_cast<TreeKind>(file.kind());
  const SectionInfo* section = file.find("HEAD");
  if (!section) return missing("HEAD");
  if (auto known = check_version(*section, 1); !known) return known;
  const auto bytes = file.read(*section);
  if (!bytes) return std::unexpected(bytes.error());
  const HeadFault fault = decode_head(*bytes, head);
  if (!fault.what.empty()) return file.refuse_section(*section, fault.offset, fault.what);
  return {};
}

Result<void> TreeFile::Impl::read_omitted() {
  const SectionInfo* section = file.find("OMIT");
  if (!section) return {};
  if (auto known = check_version(*section, k_omitted_record); !known) return known;
  const auto bytes = file.read(*section);
  if (!bytes) return std::unexpected(bytes.error());
  if (bytes->empty()) return file.refuse_section(*section, 0, "it is empty");
  const auto& known = omissible_sections();
  auto next = known.begin();
  for (std::size_t at = 0; at < bytes->size(); at += k_omitted_record) {
    Omitted entry{.name = std::string(bytes->begin() + static_cast<std::ptrdiff_t>(at),
                                      bytes->begin() + static_cast<std::ptrdiff_t>(at) + 4),
                  .bytes = get<std::uint64_t>(*bytes, at + k_omitted_bytes)};
    next = std::find_if(next, known.end(), [&](const Omissible& o) { return o.name == entry.name; });
    if (next == known.end()) {
      return file.refuse_section(*section, at, "a name that is unknown, repeated or out of order");
    }
    if (!all_zero(bytes->span().subspan(at + 4, 4))) {
      return file.refuse_section(*section, at + 4, "reserved bytes are not zero");
    }
    if (file.find(entry.name)) {
      return file.refuse_section(*section, at, entry.name + " is listed, yet it is there");
    }
    omitted_names.push_back(entry.name);
    omitted.push_back(std::move(entry));
    ++next;
  }
  return {};
}

Result<void> TreeFile::Impl::check_version(const SectionInfo& section, std::size_t stride) const {
  if (section.version != k_tree_section_version) {
    return file.refuse_section(section, 0,
                               fmt::format("version {} is unknown to this program", section.version));
  }
  if (section.stride == stride) return {};
  return file.refuse_section(section, 0, fmt::format("stride {}, expected {}", section.stride, stride));
}

Result<void> TreeFile::Impl::check_section(std::string_view name, std::uint64_t count, std::size_t stride,
                                           Presence presence) const {
  const SectionInfo* section = file.find(name);
  if (!section) {
    const bool may_miss = presence == Presence::optional && is_omitted(name);
    if (count == 0 || may_miss) return {};
    return missing(name);
  }
  if (auto known = check_version(*section, stride); !known) return known;
  if (section->decoded_size == 0 || section->decoded_size / stride != count) {
    return file.refuse_section(
        *section, 0, fmt::format("{} elements, the header says {}", section->decoded_size / stride, count));
  }
  return {};
}

// Every section that this version knows has the size that HEAD gives it, or is missing for a stated reason.
Result<void> TreeFile::Impl::check_table() const {
  if (const std::string wrong = check_counts(head); !wrong.empty()) {
    return file.refuse_section(*file.find("HEAD"), 0, wrong);
  }
  Result<void> state;
  const auto check = [&](std::string_view name, std::uint64_t count, std::size_t stride, Presence presence) {
    if (state) state = check_section(name, count, stride, presence);
  };
  // Texts have no count of their own: what their records say is checked when they are read.
  const auto texts = [&](std::string_view name) {
    const SectionInfo* section = file.find(name);
    if (section) check(name, section->decoded_size, 1, Presence::required);
  };
  texts("PROV");
  check("MATL", head.counts.materials, k_material_record, Presence::required);
  texts("MNAM");
  check("TEXR", head.counts.textures, k_texture_record, Presence::required);
  texts("TNAM");
  texts("TDAT");
  const Tree tree;
  for_each_array(tree, head,
                 [&](std::string_view name, const auto& array, std::uint64_t count, Presence presence) {
                   check(name, count, sizeof array[0], presence);
                 });
  const bool sensitive = head.header.kind == TreeKind::sensitive;
  for (const std::string_view name : {"RADI", "RFIR", "RVEC", "TVTX", "TLVX"}) {
    const SectionInfo* section = file.find(name);
    if (state && section && (name[0] == 'R') != sensitive) {
      state = file.refuse_section(
          *section, 0, sensitive ? "an .stree carries no trunk vertices" : "a .tree carries no hierarchy");
    }
  }
  return state;
}

Result<void> TreeFile::Impl::load_records(const Names* only, Verify verify, Tree& tree) const {
  const auto wanted = [&](std::string_view name) { return !only || holds(*only, name); };
  if (wanted("PROV")) {
    const auto text = bytes("PROV", verify);
    if (!text) return std::unexpected(text.error());
    tree.provenance.assign(text->begin(), text->end());
  }
  if (wanted("MATL")) {
    const auto records = bytes("MATL", verify), names = bytes("MNAM", verify);
    if (!records) return std::unexpected(records.error());
    if (!names) return std::unexpected(names.error());
    const RecordFault fault = decode_materials(*records, *names, tree.materials);
    if (!fault.what.empty()) return refuse_finding({"MATL", fault.offset / k_material_record, fault.what});
  }
  if (wanted("TEXR") || wanted("TDAT")) {
    const auto records = bytes("TEXR", verify), texts = bytes("TNAM", verify);
    if (!records) return std::unexpected(records.error());
    if (!texts) return std::unexpected(texts.error());
    const auto images = wanted("TDAT") ? bytes("TDAT", verify) : Array<std::uint8_t>();
    if (!images) return std::unexpected(images.error());
    const RecordFault fault = decode_textures(*records, *texts, *images, wanted("TDAT"), tree.textures);
    if (!fault.what.empty()) return refuse_finding({"TEXR", fault.offset / k_texture_record, fault.what});
  }
  return {};
}

Result<Tree> TreeFile::Impl::load(const Names* only, Verify verify) const {
  Tree tree;
  tree.header = head.header;
  tree.trunk.material = head.trunk_material;
  tree.leaves.material = head.leaf_material;
  if (auto records = load_records(only, verify, tree); !records) return std::unexpected(records.error());
  Result<void> state;
  for_each_array(tree, head, [&]<class T>(std::string_view name, Array<T>& array, std::uint64_t, Presence) {
    if (!state || (only && !holds(*only, name))) return;
    const auto decoded = bytes(name, verify);
    if (!decoded) {
      state = std::unexpected(decoded.error());
      return;
    }
    const auto owner = std::make_shared<Array<std::uint8_t>>(*decoded);
    array = {std::span(reinterpret_cast<const T*>(owner->data()), owner->size() / sizeof(T)), owner};
  });
  if (!state) return std::unexpected(state.error());
  return tree;
}

std::unexpected<Error> TreeFile::Impl::refuse_finding(const Finding& finding) const {
  const SectionInfo* section = file.find(finding.section);
  if (!section) return refuse(file.name(), to_text(finding), "make the file again");
  const bool has_element = finding.element != Finding::k_no_element;
  return file.refuse_section(
      *section, has_element && section->encoding == Encoding::raw ? finding.element * section->stride : 0,
      has_element ? fmt::format("element {}: {}", finding.element, finding.what) : finding.what);
}

Result<TreeFile> TreeFile::open(const std::filesystem::path& path, Trust trust) {
  auto container = Container::open(path);
  if (!container) return std::unexpected(container.error());
  return from_container(std::move(*container), trust);
}

Result<TreeFile> TreeFile::from_bytes(std::vector<std::uint8_t> bytes, std::string name, Trust trust) {
  auto container = Container::from_bytes(std::move(bytes), std::move(name));
  if (!container) return std::unexpected(container.error());
  return from_container(std::move(*container), trust);
}

Result<TreeFile> TreeFile::from_container(Container container, Trust trust) {
  auto impl = std::make_shared<Impl>();
  auto whole = unpacked(container);
  if (!whole) return std::unexpected(whole.error());
  impl->stored = std::move(container);
  impl->file = std::move(*whole);
  impl->trust = trust;
  if (auto head = impl->read_head(); !head) return std::unexpected(head.error());
  if (auto omitted = impl->read_omitted(); !omitted) return std::unexpected(omitted.error());
  if (auto table = impl->check_table(); !table) return std::unexpected(table.error());
  return TreeFile(std::move(impl));
}

const TreeHeader& TreeFile::header() const {
  return impl_->head.header;
}
const TreeCounts& TreeFile::counts() const {
  return impl_->head.counts;
}
const std::vector<SectionInfo>& TreeFile::sections() const {
  return impl_->stored.sections();
}
const std::vector<std::string>& TreeFile::omitted() const {
  return impl_->omitted_names;
}
const std::vector<Omitted>& TreeFile::omissions() const {
  return impl_->omitted;
}
bool TreeFile::has(std::string_view section) const {
  return impl_->file.find(section) != nullptr;
}
std::uint64_t TreeFile::size() const {
  return impl_->stored.size();
}
const Container& TreeFile::container() const {
  return impl_->stored;
}

Result<Array<std::uint8_t>> TreeFile::section(std::string_view name) const {
  const SectionInfo* section = impl_->file.find(name);
  if (!section) return impl_->missing(name);
  return impl_->file.read(*section, impl_->trust == Trust::file ? Verify::no : Verify::yes);
}

Result<Tree> TreeFile::load() const {
  return load_named(nullptr);
}

Result<Tree> TreeFile::load(const std::vector<std::string>& only) const {
  return load_named(&only);
}

Result<Tree> TreeFile::load_named(const std::vector<std::string>* only) const {
  for (const std::string& name : only ? *only : Names()) {
    if (is_tree_section(name)) continue;
    return fail(Fault::usage, impl_->file.name(), fmt::format("'{}' is no section of a tree", name),
                "see docs/formats.md for their names");
  }
  auto tree = impl_->load(only, impl_->trust == Trust::file ? Verify::no : Verify::yes);
  if (!tree || impl_->trust != Trust::nothing) return tree;
  Findings findings;
  check_elements(*tree, impl_->head, findings);
  if (!findings.empty()) return impl_->refuse_finding(findings.listed().front());
  return tree;
}

std::vector<std::string> TreeFile::verify() const {
  std::vector<std::string> failures;
  for (const SectionInfo& s : sections()) {
    if (auto sound = impl_->stored.verify(s); !sound) failures.push_back(sound.error().what);
  }
  auto tree = impl_->load(nullptr, Verify::no);
  if (!tree) {
    failures.push_back(tree.error().what);
    return failures;
  }
  Findings findings;
  check_elements(*tree, impl_->head, findings);
  const auto lines = findings.lines();
  failures.insert(failures.end(), lines.begin(), lines.end());
  if (const auto volumes = load_volumes(*this); !volumes) failures.push_back(volumes.error().what);
  return failures;
}

}  // namespace copse
