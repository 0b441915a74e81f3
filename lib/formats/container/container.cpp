#include "lib/formats/container/container.h"

#include "lib/formats/container/container_layout.h"
#include "lib/formats/container/mapped_file.h"
#include "lib/formats/hash.h"
#include "lib/formats/little_endian.h"

#include <algorithm>
#include <new>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <zstd.h>

namespace copse {
namespace {

using namespace container_layout;

constexpr const char* k_remedy = "restore the file, or make it again";

std::unexpected<Error> damaged(const std::string& file, std::uint64_t offset, const std::string& what) {
  return refuse(file, fmt::format("header at offset {}: {}", offset, what), k_remedy);
}

std::string described(const SectionInfo& s, std::uint64_t offset_in_section) {
  return fmt::format("section {} at offset {}", s.name, s.offset + offset_in_section);
}

// A name stands in messages before it is known to be sound.
std::string shown_name(std::span<const std::uint8_t> name) {
  std::string text;
  for (const std::uint8_t c : name) {
    text += c > 0x20 && c < 0x7f ? std::string(1, static_cast<char>(c)) : fmt::format("\\x{:02x}", c);
  }
  return text;
}

// Memory aligned as sections are in a file and not filled first; null when there is not that much.
std::shared_ptr<std::uint8_t> room_for(std::size_t size) {
  constexpr std::align_val_t k_alignment{k_section_alignment};
  auto* bytes = static_cast<std::uint8_t*>(::operator new(size, k_alignment, std::nothrow));
  return {bytes, [](std::uint8_t* p) { ::operator delete(p, k_alignment); }};
}

struct TableReader {
  const std::string& file;
  std::span<const std::uint8_t> bytes;
  std::vector<SectionInfo> sections = {};
  std::set<std::string, std::less<>> names = {};
  std::uint64_t end = 0;            // of the section before
  std::uint64_t decoded_total = 0;  // checked after each section, so it cannot overflow

  Result<void> read_entry(std::size_t index);
  Result<void> read(std::uint32_t count);
};

Result<void> TableReader::read_entry(std::size_t index) {
  const std::size_t at = k_header_size + index * k_entry_size;
  const auto name = bytes.subspan(at + k_entry_name, 4);
  const auto bad = [&](std::size_t field, const std::string& what) {
    return refuse(file,
                  fmt::format("section {} in the table at offset {}: {}", shown_name(name), at + field, what),
                  k_remedy);
  };
  if (std::any_of(name.begin(), name.end(), [](std::uint8_t c) { return c <= 0x20 || c >= 0x7f; })) {
    return bad(k_entry_name, "the name is not four printable characters");
  }
  SectionInfo s;
  s.name.assign(name.begin(), name.end());
  s.version = get<std::uint32_t>(bytes, at + k_entry_version);
  s.stride = get<std::uint32_t>(bytes, at + k_entry_stride);
  s.offset = get<std::uint64_t>(bytes, at + k_entry_offset);
  s.stored_size = get<std::uint64_t>(bytes, at + k_entry_stored);
  s.decoded_size = get<std::uint64_t>(bytes, at + k_entry_decoded);
  s.checksum = get<std::uint64_t>(bytes, at + k_entry_checksum);
  const auto encoding = get<std::uint32_t>(bytes, at + k_entry_encoding);
  if (encoding > static_cast<std::uint32_t>(Encoding::zstd)) {
    return bad(k_entry_encoding, fmt::format("encoding {} is unknown to this version", encoding));
  }
  s.encoding = static_cast<Encoding>(encoding);
  if (!names.insert(s.name).second) {
    return bad(k_entry_name, "the name occurs twice");
  }
  if (s.offset != align_up(end, k_section_alignment)) {
    return bad(k_entry_offset, fmt::format("it starts at {}, the section before ends at {}", s.offset, end));
  }
  if (s.offset > bytes.size() || s.stored_size > bytes.size() - s.offset) {
    return bad(k_entry_stored, fmt::format("{} bytes at {} do not fit a file of {} bytes", s.stored_size,
                                           s.offset, bytes.size()));
  }
  if (s.encoding == Encoding::raw && s.stored_size != s.decoded_size) {
    return bad(k_entry_decoded,
               fmt::format("raw, but {} bytes stored stand for {}", s.stored_size, s.decoded_size));
  }
  const std::uint64_t limit = k_free_decoded_bytes + k_max_expansion * bytes.size();
  if (s.decoded_size > limit - decoded_total) {
    return bad(k_entry_decoded,
               fmt::format("its {} decoded bytes bring the file's total over the limit of {} for a "
                           "file of {} bytes",
                           s.decoded_size, limit, bytes.size()));
  }
  if (s.stride == 0 || s.decoded_size % s.stride != 0) {
    return bad(k_entry_stride,
               fmt::format("{} bytes are no multiple of its stride {}", s.decoded_size, s.stride));
  }
  decoded_total += s.decoded_size;
  end = s.offset + s.stored_size;
  sections.push_back(std::move(s));
  return {};
}

Result<void> TableReader::read(std::uint32_t count) {
  end = k_header_size + count * k_entry_size;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (auto entry = read_entry(i); !entry) return entry;
  }
  if (end == bytes.size()) return {};
  return refuse(file, fmt::format("{} bytes after the last section, at offset {}", bytes.size() - end, end),
                k_remedy);
}

// The fixed header; answers the number of sections, whose table is known to be inside the file and undamaged.
Result<std::uint32_t> read_header(std::span<const std::uint8_t> bytes, const std::string& file) {
  if (bytes.size() < k_magic.size() || !std::equal(k_magic.begin(), k_magic.end(), bytes.begin())) {
    return refuse(file, "not a copse file: the magic number is missing at offset 0",
                  "name a .tree, .stree or .eco file");
  }
  if (bytes.size() < k_header_size) {
    return damaged(file, bytes.size(), fmt::format("the file ends after {} bytes", bytes.size()));
  }
  const auto version = get<std::uint32_t>(bytes, k_version);
  if (version != k_container_version) {
    return refuse(file,
                  fmt::format("header at offset {}: format version {}, this program reads version {}",
                              k_version, version, k_container_version),
                  "use the release of copse that wrote it, or make the file again");
  }
  if (xxh3(bytes.first(k_header_checksum)) != get<std::uint64_t>(bytes, k_header_checksum)) {
    return damaged(file, k_header_checksum, "its checksum does not match");
  }
  const auto kind = get<std::uint32_t>(bytes, k_kind);
  if (kind < 1 || kind > static_cast<std::uint32_t>(FileKind::eco)) {
    return damaged(file, k_kind, fmt::format("kind {} is unknown", kind));
  }
  if (!all_zero(bytes.subspan(k_reserved0, 4)) || !all_zero(bytes.subspan(k_reserved1, 16))) {
    return damaged(file, k_reserved0, "reserved bytes are not zero");
  }
  const auto size = get<std::uint64_t>(bytes, k_file_size);
  if (size != bytes.size()) {
    return damaged(file, k_file_size,
                   fmt::format("the file should have {} bytes, it has {}", size, bytes.size()));
  }
  const auto count = get<std::uint32_t>(bytes, k_section_count);
  if (count > k_max_sections || k_header_size + count * k_entry_size > bytes.size()) {
    return damaged(file, k_section_count, fmt::format("a table of {} sections does not fit", count));
  }
  if (xxh3(bytes.subspan(k_header_size, count * k_entry_size)) !=
      get<std::uint64_t>(bytes, k_table_checksum)) {
    return refuse(file, fmt::format("section table at offset {}: its checksum does not match", k_header_size),
                  k_remedy);
  }
  return count;
}

}  // namespace

Result<Container> Container::open(const std::filesystem::path& path) {
  auto mapped = MappedFile::open(path);
  if (!mapped) return std::unexpected(mapped.error());
  return parse(mapped->bytes(), mapped->owner(), path.string());
}

Result<Container> Container::from_bytes(std::vector<std::uint8_t> bytes, std::string name) {
  auto owner = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  const std::span<const std::uint8_t> view = *owner;
  return parse(view, std::move(owner), std::move(name));
}

Result<Container> Container::parse(std::span<const std::uint8_t> bytes, std::shared_ptr<const void> owner,
                                   std::string name) {
  const auto count = read_header(bytes, name);
  if (!count) return std::unexpected(count.error());
  TableReader table{.file = name, .bytes = bytes};
  if (auto read = table.read(*count); !read) return std::unexpected(read.error());
  Container c;
  c.kind_ = static_cast<FileKind>(get<std::uint32_t>(bytes, k_kind));
  c.sections_ = std::move(table.sections);
  c.name_ = std::move(name);
  c.bytes_ = bytes;
  c.owner_ = std::move(owner);
  return c;
}

const SectionInfo* Container::find(std::string_view section) const {
  const auto at =
      std::find_if(sections_.begin(), sections_.end(), [&](const auto& s) { return s.name == section; });
  return at == sections_.end() ? nullptr : &*at;
}

std::unexpected<Error> Container::refuse_section(const SectionInfo& section, std::uint64_t offset_in_section,
                                                 const std::string& what) const {
  return refuse(name_, described(section, offset_in_section) + ": " + what, k_remedy);
}

Array<std::uint8_t> Container::stored(const SectionInfo& section) const {
  return {bytes_.subspan(section.offset, section.stored_size), owner_};
}

Result<void> Container::verify(const SectionInfo& section) const {
  const auto index = static_cast<std::size_t>(&section - sections_.data());
  const std::uint64_t before = index == 0 ? k_header_size + sections_.size() * k_entry_size
                                          : sections_[index - 1].offset + sections_[index - 1].stored_size;
  if (!all_zero(bytes_.subspan(before, section.offset - before))) {
    return refuse(name_,
                  fmt::format("padding before section {}, at offset {}: not zero", section.name, before),
                  k_remedy);
  }
  const std::uint64_t actual = xxh3(bytes_.subspan(section.offset, section.stored_size));
  if (actual == section.checksum) return {};
  return refuse_section(section, 0,
                        fmt::format("checksum {:016x} expected, {:016x} found", section.checksum, actual));
}

Result<Array<std::uint8_t>> Container::read(const SectionInfo& section, Verify check) const {
  if (check == Verify::yes) {
    if (auto sound = verify(section); !sound) return std::unexpected(sound.error());
  }
  const Array<std::uint8_t> bytes = stored(section);
  if (section.encoding == Encoding::raw) return bytes;
  const std::string what = "its zstd frame ";
  if (ZSTD_getFrameContentSize(bytes.data(), bytes.size()) != section.decoded_size) {
    return refuse_section(section, 0, what + "does not hold what the table says");
  }
  const std::size_t frame = ZSTD_findFrameCompressedSize(bytes.data(), bytes.size());
  if (ZSTD_isError(frame) || frame != bytes.size())
    return refuse_section(section, 0, what + "does not end with it");
  const auto decoded = room_for(section.decoded_size);
  if (!decoded)
    return refuse_section(section, 0, fmt::format("no memory for its {} bytes", section.decoded_size));
  const std::size_t size = ZSTD_decompress(decoded.get(), section.decoded_size, bytes.data(), bytes.size());
  if (ZSTD_isError(size)) return refuse_section(section, 0, what + "is damaged: " + ZSTD_getErrorName(size));
  if (size != section.decoded_size) return refuse_section(section, 0, what + "is too short");
  return Array<std::uint8_t>({decoded.get(), size}, decoded);
}

}  // namespace copse
