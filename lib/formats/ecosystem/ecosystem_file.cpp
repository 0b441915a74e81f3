#include "lib/formats/ecosystem/ecosystem_file.h"

#include "lib/formats/ecosystem/check_ecosystem.h"
#include "lib/formats/ecosystem/ecosystem_header.h"
#include "lib/formats/ecosystem/ecosystem_sections.h"
#include "lib/formats/ecosystem/type_volumes.h"

#include <utility>

#include <fmt/format.h>

namespace copse {

struct EcosystemFile::Impl {
  Container file;
  Trust trust = Trust::nothing;
  Ecosystem head;  // the head alone
  EcosystemCounts counts;

  std::unexpected<Error> missing(std::string_view name) const {
    return refuse(file.name(), fmt::format("section {} is missing from the table at offset 64", name),
                  "restore the file, or make it again");
  }
  Result<void> check_section(std::string_view name, std::uint64_t count, std::size_t stride) const;
  Result<void> check_table() const;
  Result<Array<std::uint8_t>> bytes(std::string_view name, Verify verify) const {
    const SectionInfo* section = file.find(name);
    if (!section) return Array<std::uint8_t>();
    return file.read(*section, verify);
  }
  std::unexpected<Error> refuse_fault(std::string_view section, const RecordFault& fault) const {
    const SectionInfo* at = file.find(section);
    if (!at)
      return refuse(file.name(), fmt::format("section {}: {}", section, fault.what), "make the file again");
    return file.refuse_section(*at, at->encoding == Encoding::raw ? fault.offset : 0, fault.what);
  }
  Result<void> load_records(Ecosystem& eco, Verify verify) const;
  Result<Ecosystem> load(Verify verify, Instances instances) const;
  // Whether the instances can stay where they are until they are used.
  bool can_wait(std::string_view section) const {
    const SectionInfo* at = file.find(section);
    return (section == "EINS" || section == "EINX") && at && at->encoding == Encoding::raw;
  }
};

Result<void> EcosystemFile::Impl::check_section(std::string_view name, std::uint64_t count,
                                                std::size_t stride) const {
  const SectionInfo* section = file.find(name);
  if (!section) {
    if (count == 0 || may_be_missing(name)) return {};
    return missing(name);
  }
  if (section->version != section_version(name))
    return file.refuse_section(*section, 0,
                               fmt::format("version {} is unknown to this program", section->version));
  if (section->stride != stride)
    return file.refuse_section(*section, 0, fmt::format("stride {}, expected {}", section->stride, stride));
  if (section->decoded_size == 0 || section->decoded_size / stride != count)
    return file.refuse_section(
        *section, 0, fmt::format("{} elements, the header says {}", section->decoded_size / stride, count));
  return {};
}

Result<void> EcosystemFile::Impl::check_table() const {
  Result<void> state;
  const auto check = [&](std::string_view name, std::uint64_t count, std::size_t stride) {
    if (state) state = check_section(name, count, stride);
  };
  check("MATL", counts.materials, k_material_record);
  check("TEXR", counts.textures, k_texture_record);
  check("ETYP", counts.types, k_type_record);
  for (const std::string_view name : {"PROV", "MNAM", "TNAM", "ENAM", "TDAT"})
    if (const SectionInfo* section = file.find(name)) check(name, section->decoded_size, 1);
  const std::pair<std::string_view, std::size_t> volumes[] = {{"EVOL", k_type_volume_record},
                                                              {"EVNM", sizeof(float)}};
  for (const auto& [name, stride] : volumes)
    if (const SectionInfo* section = file.find(name)) check(name, section->decoded_size / stride, stride);
  for_each_array(head, counts, [&]<class T>(std::string_view name, const Array<T>&, std::uint64_t count) {
    check(name, count, sizeof(T));
  });
  return state;
}

Result<void> EcosystemFile::Impl::load_records(Ecosystem& eco, Verify verify) const {
  const auto read = [&](std::string_view name, Array<std::uint8_t>& out) -> Result<void> {
    auto decoded = bytes(name, verify);
    if (!decoded) return std::unexpected(decoded.error());
    out = std::move(*decoded);
    return {};
  };
  Array<std::uint8_t> provenance, materials, material_names, textures, texture_names, images, types,
      type_names, volumes, volume_numbers;
  const std::pair<std::string_view, Array<std::uint8_t>*> wanted[] = {
      {"PROV", &provenance},    {"MATL", &materials},     {"MNAM", &material_names}, {"TEXR", &textures},
      {"TNAM", &texture_names}, {"TDAT", &images},        {"ETYP", &types},          {"ENAM", &type_names},
      {"EVOL", &volumes},       {"EVNM", &volume_numbers}};
  for (const auto& [name, out] : wanted)
    if (auto done = read(name, *out); !done) return done;
  eco.provenance.assign(provenance.begin(), provenance.end());
  if (const auto f = decode_materials(materials, material_names, eco.materials); !f.what.empty())
    return refuse_fault("MATL", f);
  if (const auto f = decode_textures(textures, texture_names, images, true, eco.textures); !f.what.empty())
    return refuse_fault("TEXR", f);
  std::vector<bool> packed;
  if (const auto f = decode_types(types, type_names, eco.types, packed); !f.what.empty())
    return refuse_fault("ETYP", f);
  if (const auto f = decode_type_volumes(volumes, volume_numbers, eco.types); !f.what.empty())
    return refuse_fault("EVOL", f);
  for (std::size_t i = 0; i < eco.types.size(); ++i) {
    if (!packed[i]) continue;
    if (!file.find(packed_section(i))) return missing(packed_section(i));
    if (auto done = read(packed_section(i), eco.types[i].packed); !done) return done;
  }
  return {};
}

Result<Ecosystem> EcosystemFile::Impl::load(Verify verify, Instances instances) const {
  Ecosystem eco = head;
  if (auto records = load_records(eco, verify); !records) return std::unexpected(records.error());
  Result<void> state;
  for_each_array(eco, counts, [&]<class T>(std::string_view name, Array<T>& array, std::uint64_t) {
    if (!state) return;
    const bool waits = instances == Instances::on_demand && can_wait(name);
    auto decoded = bytes(name, waits ? Verify::no : verify);
    if (!decoded) {
      state = std::unexpected(decoded.error());
      return;
    }
    const auto owner = std::make_shared<Array<std::uint8_t>>(std::move(*decoded));
    array = {std::span(reinterpret_cast<const T*>(owner->data()), owner->size() / sizeof(T)), owner};
  });
  if (!state) return std::unexpected(state.error());
  return eco;
}

Result<EcosystemFile> EcosystemFile::open(const std::filesystem::path& path, Trust trust) {
  auto container = Container::open(path);
  if (!container) return std::unexpected(container.error());
  return from_container(std::move(*container), trust);
}

Result<EcosystemFile> EcosystemFile::from_bytes(std::vector<std::uint8_t> bytes, std::string name,
                                                Trust trust) {
  auto container = Container::from_bytes(std::move(bytes), std::move(name));
  if (!container) return std::unexpected(container.error());
  return from_container(std::move(*container), trust);
}

Result<EcosystemFile> EcosystemFile::from_container(Container container, Trust trust) {
  auto impl = std::make_shared<Impl>();
  impl->file = std::move(container);
  impl->trust = trust;
  if (impl->file.kind() != FileKind::eco)
    return refuse(impl->file.name(), "header at offset 12: this is a tree, no ecosystem",
                  "name an .eco file");
  const SectionInfo* section = impl->file.find("EHED");
  if (!section) return impl->missing("EHED");
  if (section->version != 1)
    return impl->file.refuse_section(*section, 0,
                                     fmt::format("version {} is unknown to this program", section->version));
  const auto bytes = impl->file.read(*section);
  if (!bytes) return std::unexpected(bytes.error());
  const HeadFault fault = decode_ecosystem_head(*bytes, impl->head, impl->counts);
  if (!fault.what.empty()) return impl->file.refuse_section(*section, fault.offset, fault.what);
  if (auto table = impl->check_table(); !table) return std::unexpected(table.error());
  return EcosystemFile(std::move(impl));
}

const Container& EcosystemFile::container() const {
  return impl_->file;
}

Result<Ecosystem> EcosystemFile::load(Instances instances) const {
  auto eco = impl_->load(impl_->trust == Trust::file ? Verify::no : Verify::yes, instances);
  if (!eco || impl_->trust != Trust::nothing) return eco;
  Findings findings;
  if (instances == Instances::on_demand && (impl_->can_wait("EINS") || impl_->can_wait("EINX")))
    check_ecosystem_frame(*eco, findings);
  else
    check_ecosystem_elements(*eco, findings);
  if (findings.empty()) return eco;
  const Finding& first = findings.listed().front();
  const SectionInfo* section = impl_->file.find(first.section);
  const bool has_element = first.element != Finding::k_no_element;
  if (!section) return refuse(impl_->file.name(), to_text(first), "make the file again");
  return impl_->file.refuse_section(
      *section, has_element && section->encoding == Encoding::raw ? first.element * section->stride : 0,
      has_element ? fmt::format("element {}: {}", first.element, first.what) : first.what);
}

std::vector<std::string> EcosystemFile::verify() const {
  std::vector<std::string> failures;
  for (const SectionInfo& s : impl_->file.sections())
    if (auto sound = impl_->file.verify(s); !sound) failures.push_back(sound.error().what);
  auto eco = impl_->load(Verify::no, Instances::at_once);
  if (!eco) {
    failures.push_back(eco.error().what);
    return failures;
  }
  const auto wrong = check_ecosystem(*eco);
  failures.insert(failures.end(), wrong.begin(), wrong.end());
  return failures;
}

}  // namespace copse
