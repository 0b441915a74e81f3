#include "lib/formats/container/container.h"

#include "tests/formats/tampering.h"

#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using namespace container_layout;
using tampering::entry_of;
using tampering::section_at;
using tampering::set;
using testing::HasSubstr;

using Bytes = std::vector<std::uint8_t>;

Bytes pattern(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * i >> 3);
  return bytes;
}

// Three sections, the second compressed, the last one empty.
Bytes small_file() {
  ContainerWriter writer(FileKind::eco);
  EXPECT_TRUE(writer.put("AAAA", 1, 4, pattern(100)));
  EXPECT_TRUE(writer.put("BBBB", 7, 1, Bytes(1000, 9), Encoding::zstd));
  EXPECT_TRUE(writer.put("CCCC", 1, 1, Bytes()));
  return *writer.finish();
}

// What is wrong with a file, "" when nothing is: opening it and reading all of it.
std::string refusal(Bytes bytes) {
  const auto file = Container::from_bytes(std::move(bytes), "f");
  if (!file) return file.error().what;
  for (const SectionInfo& s : file->sections()) {
    if (const auto read = file->read(s); !read) return read.error().what;
  }
  return "";
}

TEST(Container, GivesBackWhatWasPut) {
  const auto file = Container::from_bytes(small_file(), "f");
  ASSERT_TRUE(file) << file.error().what;
  EXPECT_EQ(file->kind(), FileKind::eco);
  ASSERT_EQ(file->sections().size(), 3u);
  const SectionInfo& b = file->sections()[1];
  EXPECT_EQ(b.name, "BBBB");
  EXPECT_EQ(b.version, 7u);
  EXPECT_EQ(b.encoding, Encoding::zstd);
  EXPECT_EQ(b.decoded_size, 1000u);
  EXPECT_LT(b.stored_size, 100u);
  EXPECT_EQ(b.offset % 64, 0u);
  EXPECT_EQ(file->read(*file->find("AAAA"))->to_vector(), pattern(100));
  EXPECT_EQ(file->read(b)->to_vector(), Bytes(1000, 9));
  EXPECT_EQ(file->read(*file->find("CCCC"))->size(), 0u);
  EXPECT_EQ(file->find("DDDD"), nullptr);
}

TEST(Container, UsesRawSectionsInPlace) {
  const auto file = Container::from_bytes(small_file(), "f");
  const SectionInfo& a = *file->find("AAAA");
  EXPECT_EQ(file->read(a)->data(), file->stored(a).data());
}

TEST(Container, SectionsOutliveTheFile) {
  Array<std::uint8_t> kept;
  {
    const auto file = Container::from_bytes(small_file(), "f");
    kept = *file->read(*file->find("AAAA"));
  }
  EXPECT_EQ(kept.to_vector(), pattern(100));
}

TEST(Container, RefusesEveryFlippedBit) {
  const Bytes sound = small_file();
  ASSERT_EQ(refusal(sound), "");
  for (std::size_t i = 0; i < sound.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      Bytes bytes = sound;
      bytes[i] ^= static_cast<std::uint8_t>(1 << bit);
      ASSERT_NE(refusal(bytes), "") << "byte " << i << " bit " << bit;
    }
  }
}

TEST(Container, RefusesEveryTruncationAndEveryTrailingByte) {
  const Bytes sound = small_file();
  for (std::size_t size = 0; size < sound.size(); ++size) {
    ASSERT_NE(refusal({sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(size)}), "") << size;
  }
  for (const std::uint8_t extra : {0, 1}) {
    Bytes bytes = sound;
    bytes.push_back(extra);
    ASSERT_NE(refusal(bytes), "");
  }
}

TEST(Container, NamesTheSectionAndTheOffset) {
  Bytes bytes = small_file();
  const std::size_t at = section_at(bytes, "AAAA");
  bytes[at + 5] ^= 1;
  EXPECT_THAT(refusal(bytes), HasSubstr("section AAAA at offset " + std::to_string(at) + ": checksum"));
  bytes = small_file();
  bytes[section_at(bytes, "BBBB") - 1] = 1;
  EXPECT_THAT(refusal(bytes), HasSubstr("padding before section BBBB, at offset"));
}

// From here on the checksums are right, and the structure itself must refuse.
struct Forgery {
  const char* name;
  const char* message;
  void (*forge)(Bytes&);
};

const Forgery k_forgeries[] = {
    {"Version", "format version 2", [](Bytes& b) { set<std::uint32_t>(b, k_version, 2); }},
    {"Kind0", "kind 0 is unknown", [](Bytes& b) { set<std::uint32_t>(b, k_kind, 0); }},
    {"Kind4", "kind 4 is unknown", [](Bytes& b) { set<std::uint32_t>(b, k_kind, 4); }},
    {"Reserved", "reserved bytes", [](Bytes& b) { set<std::uint32_t>(b, k_reserved0, 1); }},
    {"Reserved1", "reserved bytes", [](Bytes& b) { set<std::uint32_t>(b, k_reserved1 + 12, 1); }},
    {"TrailingByte", "1 bytes after the last section",
     [](Bytes& b) { b.push_back(0), tampering::mend_checksums(b); }},
    {"Name", "not four printable characters",
     [](Bytes& b) { set<std::uint8_t>(b, entry_of(b, "AAAA"), ' '); }},
    {"NameTwice", "the name occurs twice",
     [](Bytes& b) { set<std::uint32_t>(b, entry_of(b, "BBBB"), 0x41414141); }},
    {"Encoding", "encoding 2 is unknown",
     [](Bytes& b) { set<std::uint32_t>(b, entry_of(b, "AAAA") + k_entry_encoding, 2); }},
    {"Stride0", "no multiple of its stride 0",
     [](Bytes& b) { set<std::uint32_t>(b, entry_of(b, "AAAA") + k_entry_stride, 0); }},
    {"Stride", "100 bytes are no multiple of its stride 3",
     [](Bytes& b) { set<std::uint32_t>(b, entry_of(b, "AAAA") + k_entry_stride, 3); }},
    {"OffsetBefore", "it starts at 0",
     [](Bytes& b) { set<std::uint64_t>(b, entry_of(b, "AAAA") + k_entry_offset, 0); }},
    {"OffsetOverlaps", "the section before ends at",
     [](Bytes& b) { set<std::uint64_t>(b, entry_of(b, "BBBB") + k_entry_offset, section_at(b, "AAAA")); }},
    {"OffsetUnaligned", "the section before ends at",
     [](Bytes& b) {
       set<std::uint64_t>(b, entry_of(b, "BBBB") + k_entry_offset, section_at(b, "BBBB") + 1);
     }},
    {"StoredHuge", "do not fit a file",
     [](Bytes& b) { set<std::uint64_t>(b, entry_of(b, "AAAA") + k_entry_stored, ~std::uint64_t{0}); }},
    {"StoredWraps", "do not fit a file",
     [](Bytes& b) { set<std::uint64_t>(b, entry_of(b, "AAAA") + k_entry_stored, ~std::uint64_t{0} - 191); }},
    {"RawSizes", "raw, but",
     [](Bytes& b) { set<std::uint64_t>(b, entry_of(b, "AAAA") + k_entry_decoded, 104); }},
    {"DecodedHuge", "over the limit",
     [](Bytes& b) {
       set<std::uint64_t>(b, entry_of(b, "BBBB") + k_entry_decoded, std::uint64_t{100} << 30);
     }},
    {"DecodedMore", "does not hold what the table says",
     [](Bytes& b) { set<std::uint64_t>(b, entry_of(b, "BBBB") + k_entry_decoded, 1001); }},
    {"Padding", "not zero", [](Bytes& b) { set<std::uint8_t>(b, section_at(b, "BBBB") - 1, 1); }},
    {"Frame", "zstd frame", [](Bytes& b) { set<std::uint8_t>(b, section_at(b, "BBBB"), 1); }},
    {"SectionsMany", "a table of 4097 sections",
     [](Bytes& b) {
       put<std::uint32_t>(b, k_section_count, 4097),
           put(std::span(b), k_header_checksum, xxh3(std::span(b).first(k_header_checksum)));
     }},
    {"SectionsFewer", "the section before ends at 112",
     [](Bytes& b) { set<std::uint32_t>(b, k_section_count, 1); }},
};

class Forged : public testing::TestWithParam<Forgery> {};
void PrintTo(const Forgery& forgery, std::ostream* out) {  // NOLINT: GoogleTest's name
  *out << forgery.name;
}
TEST_P(Forged, IsRefusedByTheStructureItself) {
  Bytes bytes = small_file();
  GetParam().forge(bytes);
  EXPECT_THAT(refusal(bytes), HasSubstr(GetParam().message));
}
INSTANTIATE_TEST_SUITE_P(Container, Forged, testing::ValuesIn(k_forgeries),
                         [](const auto& f) { return f.param.name; });

TEST(Container, AFrameOfAnotherLengthThanTheSectionIsRefused) {
  ContainerWriter writer(FileKind::eco);
  ASSERT_TRUE(writer.put("BBBB", 1, 1, Bytes(1000, 9), Encoding::zstd));
  Bytes bytes = *writer.finish();
  bytes.push_back(0);  // part of the section, but behind its frame
  const std::size_t entry = entry_of(bytes, "BBBB");
  set(bytes, entry + k_entry_stored, get<std::uint64_t>(bytes, entry + k_entry_stored) + 1);
  EXPECT_THAT(refusal(bytes), HasSubstr("does not end with it"));
}

TEST(Container, ASmallFileCannotAskForMuchMemory) {
  // A frame of run-length blocks: 64 MiB of zeros in about 2 KB, as no honest writer stores it.
  ContainerWriter writer(FileKind::eco);
  ASSERT_TRUE(writer.put("BOMB", 1, 1, Bytes(std::size_t{64} << 20), Encoding::zstd));
  const Bytes honest = *writer.finish();
  EXPECT_GT(honest.size(), std::size_t{64} << 20) << "the writer stores raw what a reader would not decode";
  EXPECT_EQ(refusal(honest), "");
  ContainerWriter small(FileKind::eco);
  ASSERT_TRUE(small.put("BOMB", 1, 1, Bytes(1000), Encoding::zstd));
  Bytes bytes = *small.finish();
  set(bytes, entry_of(bytes, "BOMB") + k_entry_decoded,
      k_free_decoded_bytes + k_max_expansion * bytes.size() + 1);
  EXPECT_THAT(refusal(bytes), HasSubstr("over the limit"));
}

TEST(Container, StoresRawOnlyAsMuchAsTheLimitAsksFor) {
  ContainerWriter writer(FileKind::eco);
  ASSERT_TRUE(writer.put("ONE_", 1, 1, Bytes(std::size_t{1} << 20), Encoding::zstd));
  ASSERT_TRUE(writer.put("TWO_", 1, 1, Bytes(std::size_t{8} << 20), Encoding::zstd));
  const Bytes bytes = *writer.finish();
  const auto file = Container::from_bytes(bytes, "f");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->find("ONE_")->encoding, Encoding::zstd);
  EXPECT_EQ(file->find("TWO_")->encoding, Encoding::raw);
  EXPECT_EQ(refusal(bytes), "");
}

TEST(ContainerWriter, CopiesUnknownSectionsAsTheyAre) {
  const auto source = Container::from_bytes(small_file(), "f");
  ContainerWriter writer(*source);
  EXPECT_EQ(*writer.finish(), small_file());
  ASSERT_TRUE(writer.put("DDDD", 1, 1, pattern(3)));
  ASSERT_TRUE(writer.put("AAAA", 2, 1, pattern(5)));
  writer.remove("CCCC");
  const auto copy = Container::from_bytes(*writer.finish(), "g");
  ASSERT_TRUE(copy);
  ASSERT_EQ(copy->sections().size(), 3u);
  EXPECT_EQ(copy->sections()[0].name, "AAAA");
  EXPECT_EQ(copy->sections()[0].version, 2u);
  EXPECT_EQ(copy->sections()[1].name, "BBBB");
  EXPECT_EQ(copy->sections()[1].version, 7u);
  EXPECT_EQ(copy->sections()[2].name, "DDDD");
  EXPECT_EQ(copy->read(copy->sections()[0])->to_vector(), pattern(5));
  EXPECT_EQ(copy->read(copy->sections()[1])->to_vector(), Bytes(1000, 9));
}

TEST(ContainerWriter, ACopyDoesNotHideDamage) {
  Bytes bytes = small_file();
  bytes[section_at(bytes, "AAAA")] ^= 1;
  const auto damaged = Container::from_bytes(bytes, "f");
  ASSERT_TRUE(damaged);
  EXPECT_THAT(refusal(*ContainerWriter(*damaged).finish()), HasSubstr("section AAAA"));
}

TEST(ContainerWriter, RefusesWhatIsNoSection) {
  ContainerWriter writer(FileKind::tree);
  EXPECT_FALSE(writer.put("ABC", 1, 1, Bytes()));
  EXPECT_FALSE(writer.put("AB D", 1, 1, Bytes()));
  EXPECT_FALSE(writer.put("ABCD", 1, 3, pattern(4)));
  EXPECT_FALSE(writer.put("ABCD", 1, 0, pattern(4)));
}

TEST(Container, TellsAForeignFileFromADamagedOne) {
  EXPECT_THAT(refusal(Bytes{'g', 'l', 'T', 'F', 2, 0, 0, 0}), HasSubstr("not a copse file"));
  EXPECT_THAT(refusal({}), HasSubstr("not a copse file"));
  EXPECT_EQ(Container::open("/no/such/file").error().fault, Fault::io);
}

}  // namespace
}  // namespace copse
