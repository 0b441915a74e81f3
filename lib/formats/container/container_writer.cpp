#include "lib/formats/container/container.h"
#include "lib/formats/container/container_layout.h"
#include "lib/formats/hash.h"
#include "lib/formats/little_endian.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <zstd.h>

namespace copse {
namespace {

using namespace container_layout;

// What is small is done at once at any level.
constexpr std::size_t k_small = 16 << 10;
constexpr int k_level_of_small = 19;

Result<std::vector<std::uint8_t>> compress(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> out(ZSTD_compressBound(bytes.size()));
  const int level = bytes.size() <= k_small ? k_level_of_small : k_zstd_level;
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size)) return fail(Fault::bug, "", ZSTD_getErrorName(size), "report this");
  out.resize(size);
  out.shrink_to_fit();
  return out;
}

Result<Array<std::uint8_t>> decompress(std::span<const std::uint8_t> bytes, std::uint64_t decoded_size) {
  std::vector<std::uint8_t> out(decoded_size);
  const std::size_t size = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (size != decoded_size)
    return refuse("", "a copied section does not decompress", "verify the source file");
  return Array<std::uint8_t>(std::move(out));
}

bool is_name(std::string_view name) {
  return name.size() == 4 &&
         std::all_of(name.begin(), name.end(), [](char c) { return c > 0x20 && c < 0x7f; });
}

void write_entry(std::span<std::uint8_t> entry, const SectionInfo& s) {
  std::copy(s.name.begin(), s.name.end(), entry.begin() + k_entry_name);
  put(entry, k_entry_version, s.version);
  put(entry, k_entry_encoding, static_cast<std::uint32_t>(s.encoding));
  put(entry, k_entry_stride, s.stride);
  put(entry, k_entry_offset, s.offset);
  put(entry, k_entry_stored, s.stored_size);
  put(entry, k_entry_decoded, s.decoded_size);
  put(entry, k_entry_checksum, s.checksum);
}

// `front`: header and table, the latter filled in.
void write_header(std::span<std::uint8_t> front, FileKind kind, std::size_t sections,
                  std::uint64_t file_size) {
  std::copy(k_magic.begin(), k_magic.end(), front.begin());
  put(front, k_version, k_container_version);
  put(front, k_kind, static_cast<std::uint32_t>(kind));
  put(front, k_section_count, static_cast<std::uint32_t>(sections));
  put(front, k_file_size, file_size);
  put(front, k_table_checksum, xxh3(front.subspan(k_header_size, sections * k_entry_size)));
  put(front, k_header_checksum, xxh3(front.first(k_header_checksum)));
}

}  // namespace

ContainerWriter::ContainerWriter(const Container& source) : kind_(source.kind()) {
  for (const SectionInfo& s : source.sections()) sections_.push_back({s, source.stored(s)});
}

Result<void> ContainerWriter::put(std::string_view name, std::uint32_t version, std::uint32_t stride,
                                  Array<std::uint8_t> decoded, Encoding encoding) {
  if (!is_name(name)) {
    return fail(Fault::bug, "", fmt::format("'{}' is no section name", name),
                "use four printable characters");
  }
  if (stride == 0 || decoded.size() % stride != 0) {
    return fail(Fault::bug, "",
                fmt::format("section {}: {} bytes are no multiple of {}", name, decoded.size(), stride),
                "report this");
  }
  Section section{{.name = std::string(name), .version = version, .stride = stride}, decoded};
  section.info.decoded_size = decoded.size();
  if (encoding == Encoding::zstd && !decoded.empty()) {
    auto small = compress(decoded);
    if (!small) return std::unexpected(small.error());
    if (small->size() < decoded.size()) {
      section.info.encoding = Encoding::zstd;
      section.bytes = std::move(*small);
    }
  }
  section.info.checksum = xxh3(section.bytes.span());
  const auto at =
      std::find_if(sections_.begin(), sections_.end(), [&](const auto& s) { return s.info.name == name; });
  if (at != sections_.end()) {
    *at = std::move(section);
  } else {
    sections_.push_back(std::move(section));
  }
  return {};
}

void ContainerWriter::remove(std::string_view name) {
  std::erase_if(sections_, [&](const Section& s) { return s.info.name == name; });
}

Result<Pieces> ContainerWriter::pieces() const {
  if (sections_.size() > k_max_sections) {
    return fail(Fault::bug, "", fmt::format("{} sections, the limit is {}", sections_.size(), k_max_sections),
                "report this");
  }
  std::vector<Section> sections = sections_;
  const auto lay_out = [&] {
    std::uint64_t end = k_header_size + sections.size() * k_entry_size;
    for (Section& s : sections) {
      s.info.offset = align_up(end, k_section_alignment);
      s.info.stored_size = s.bytes.size();
      end = s.info.offset + s.info.stored_size;
    }
    return end;
  };
  const std::uint64_t decoded =
      std::accumulate(sections.begin(), sections.end(), std::uint64_t{0},
                      [](auto sum, const Section& s) { return sum + s.info.decoded_size; });
  std::uint64_t size = lay_out();
  // More expansion than a reader accepts: what shrinks most (the first of equals) is stored raw.
  while (decoded > k_free_decoded_bytes + k_max_expansion * size) {
    const auto saved = [](const Section& s) { return s.info.decoded_size - s.bytes.size(); };
    const auto most = std::max_element(sections.begin(), sections.end(),
                                       [&](const auto& a, const auto& b) { return saved(a) < saved(b); });
    auto raw = decompress(most->bytes, most->info.decoded_size);
    if (!raw) return std::unexpected(raw.error());
    most->bytes = std::move(*raw);
    most->info.encoding = Encoding::raw;
    most->info.checksum = xxh3(most->bytes.span());
    size = lay_out();
  }
  std::vector<std::uint8_t> front(k_header_size + sections.size() * k_entry_size);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    write_entry(std::span(front).subspan(k_header_size + i * k_entry_size, k_entry_size), sections[i].info);
  }
  write_header(front, kind_, sections.size(), size);
  Pieces file{std::move(front)};
  for (Section& s : sections) {
    file.add(std::vector<std::uint8_t>(s.info.offset - file.size()));  // padding
    file.add(std::move(s.bytes));
  }
  return file;
}

Result<std::vector<std::uint8_t>> ContainerWriter::finish() const {
  const auto file = pieces();
  if (!file) return std::unexpected(file.error());
  return file->joined();
}

}  // namespace copse
