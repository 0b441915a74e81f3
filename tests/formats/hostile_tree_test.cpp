// Whatever the bytes are: a refusal that names a place, or a tree in which check_tree finds nothing.
#include "lib/formats/random.h"
#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/formats/tampering.h"
#include "tests/formats/tree_maker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using namespace container_layout;
using tampering::Bytes;
using tampering::entry_of;
using tampering::section_at;
using tampering::set;
using testing::HasSubstr;
using testing::IsEmpty;

Bytes small_file(TreeKind kind, Encoding encoding, std::uint64_t seed = 1,
                 const std::vector<std::string>& omit = {}) {
  const Tree tree = make_tree(
      {.kind = kind, .roots = 1, .radii = 5, .leaves = 4, .groups = 2, .joints = 3, .materials = 2}, seed);
  return *encode_tree(tree, {.encoding = encoding, .omit = omit});
}

// Loads without trust; "" when that succeeds.
std::string refusal(const Bytes& bytes) {
  const auto file = TreeFile::from_bytes(bytes, "f");
  if (!file) return file.error().what;
  const auto tree = file->load();
  return tree ? "" : tree.error().what;
}

TEST(HostileTree, EveryFlippedByteIsRefused) {
  for (const TreeKind kind : {TreeKind::still, TreeKind::sensitive}) {
    for (const Encoding encoding : {Encoding::raw, Encoding::zstd}) {
      const Bytes sound = small_file(kind, encoding, 1, {"LCEN"});
      ASSERT_EQ(refusal(sound), "");
      for (std::size_t i = 0; i < sound.size(); ++i) {
        for (const int flip : {1 << (i % 8), 0xff}) {
          Bytes bytes = sound;
          bytes[i] ^= static_cast<std::uint8_t>(flip);
          ASSERT_THAT(refusal(bytes), HasSubstr("offset")) << "byte " << i << " ^ " << flip;
        }
      }
    }
  }
}

TEST(HostileTree, EveryTruncationIsRefused) {
  const Bytes sound = small_file(TreeKind::sensitive, Encoding::raw);
  for (std::size_t size = 0; size < sound.size(); ++size) {
    ASSERT_THAT(refusal({sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(size)}),
                HasSubstr("offset"))
        << size;
  }
}

// Every count and constant of HEAD, larger and smaller, with right checksums: the sizes of the sections or
// the elements give it away. Three numbers say nothing about an array, so only their own checks can refuse
// them.
TEST(HostileTree, EveryForgedCountIsRefused) {
  for (const TreeKind kind : {TreeKind::still, TreeKind::sensitive}) {
    const Bytes sound = small_file(kind, Encoding::raw);
    const std::size_t head = section_at(sound, "HEAD");
    for (std::size_t field = 96; field < 192; field += 4) {
      const auto value = get<std::uint32_t>(sound, head + field);
      for (const std::uint32_t forged :
           {value + 1, value - 1, value + 0x40000000, value * 2 + 7, 0u, 0x7fffffffu, 0xffffffffu}) {
        const bool unexplained = field == 172,
                   still_constant = kind == TreeKind::still && (field == 152 || field == 160);
        const bool any_order = field == 96, material = field == 176 || field == 180;
        if (forged == value || any_order || unexplained || still_constant || material) continue;
        Bytes bytes = sound;
        set(bytes, head + field, forged);
        EXPECT_NE(refusal(bytes), "") << "HEAD + " << field << ": " << value << " -> " << forged;
      }
    }
  }
}

TEST(HostileTree, AMissingSectionIsRefusedUnlessTheFileListsIt) {
  const Bytes sound = small_file(TreeKind::sensitive, Encoding::raw);
  const auto container = Container::from_bytes(sound, "f");
  for (const SectionInfo& s : container->sections()) {
    if (s.name == "PROV") continue;  // a text that nothing refers to
    ContainerWriter writer(*container);
    writer.remove(s.name);
    const std::string why = refusal(*writer.finish());
    EXPECT_NE(why, "") << s.name;
  }
}

TEST(HostileTree, AForeignSizeVersionOrStrideIsRefused) {
  const Bytes sound = small_file(TreeKind::sensitive, Encoding::raw);
  const auto container = Container::from_bytes(sound, "f");
  for (const SectionInfo& s : container->sections()) {
    Bytes bytes = sound;
    set<std::uint32_t>(bytes, entry_of(bytes, s.name) + k_entry_version, 2);
    EXPECT_THAT(refusal(bytes), HasSubstr("section " + s.name + " at offset")) << s.name;
    bytes = sound;
    set<std::uint32_t>(bytes, entry_of(bytes, s.name) + k_entry_stride, s.stride == 1 ? 2 : s.stride / 2);
    EXPECT_NE(refusal(bytes), "") << s.name;
    const auto content = container->read(s)->to_vector();
    ContainerWriter writer(*container);
    Bytes more(content.size() + s.stride);
    std::copy(content.begin(), content.end(), more.begin());
    ASSERT_TRUE(writer.put(s.name, 1, s.stride, more));
    EXPECT_EQ(refusal(*writer.finish()).empty(), s.name == "PROV") << s.name;
    ASSERT_TRUE(writer.put(s.name, 1, s.stride, Bytes()));
    EXPECT_NE(refusal(*writer.finish()), "") << s.name;
  }
}

TEST(HostileTree, SectionsOfTheOtherKindAreRefused) {
  const auto still = Container::from_bytes(small_file(TreeKind::still, Encoding::raw), "f");
  const auto sensitive = Container::from_bytes(small_file(TreeKind::sensitive, Encoding::raw), "f");
  ContainerWriter a(*still), b(*sensitive);
  ASSERT_TRUE(a.put("RADI", 1, 36, sensitive->read(*sensitive->find("RADI"))->to_vector()));
  ASSERT_TRUE(b.put("TVTX", 1, 12, still->read(*still->find("TVTX"))->to_vector()));
  EXPECT_THAT(refusal(*a.finish()), HasSubstr("a .tree carries no hierarchy"));
  EXPECT_THAT(refusal(*b.finish()), HasSubstr("an .stree carries no trunk vertices"));
}

TEST(HostileTree, AnUnknownSectionIsKeptAndSkipped) {
  const auto container = Container::from_bytes(small_file(TreeKind::sensitive, Encoding::raw), "f");
  ContainerWriter writer(*container);
  ASSERT_TRUE(writer.put("VOLS", 9, 1, Bytes{1, 2, 3}));
  const Bytes bytes = *writer.finish();
  EXPECT_EQ(refusal(bytes), "");
  const auto file = TreeFile::from_bytes(bytes, "f");
  EXPECT_EQ(file->section("VOLS")->to_vector(), (Bytes{1, 2, 3}));
  EXPECT_FALSE(file->section("NONE"));
}

TEST(HostileTree, AnEcosystemIsNoTree) {
  const auto file = TreeFile::from_bytes(*ContainerWriter(FileKind::eco).finish(), "f.eco");
  EXPECT_THAT(file.error().what, HasSubstr("no tree but an ecosystem"));
}

TEST(HostileTree, ErrorsNameTheElementsOffset) {
  Bytes bytes = small_file(TreeKind::sensitive, Encoding::raw);
  const std::size_t at = section_at(bytes, "TTRI") + 36;
  set<std::uint32_t>(bytes, at + 4, 0x1000);
  EXPECT_THAT(refusal(bytes),
              HasSubstr("section TTRI at offset " + std::to_string(at) + ": element 1: vertex index"));
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  Bytes mutate(Bytes bytes) {
    const std::uint64_t changes = 1 + random_.below(6);
    for (std::uint64_t i = 0; i < changes && !bytes.empty(); ++i) change(bytes);
    if (random_.chance(0.75)) tampering::mend_checksums(bytes);
    return bytes;
  }

 private:
  void change(Bytes& bytes) {
    const std::size_t at = random_.below(bytes.size());
    const std::size_t word = at / 4 * 4;
    switch (random_.below(8)) {
      case 0:
        bytes[at] = static_cast<std::uint8_t>(random_.next());
        break;
      case 1:
      case 2:
        if (word + 4 <= bytes.size()) put(std::span(bytes), word, interesting());
        break;
      case 3:
        if (word + 4 <= bytes.size())
          put(std::span(bytes), word,
              static_cast<std::uint32_t>(get<std::uint32_t>(bytes, word) + random_.below(3) - 1));
        break;
      case 4: {  // a field of the header, the table or HEAD
        const std::size_t field = random_.below(std::min<std::size_t>(bytes.size(), 2000)) / 4 * 4;
        if (field + 4 <= bytes.size()) put(std::span(bytes), field, interesting());
        break;
      }
      case 5: {  // one place over another
        const std::size_t from = random_.below(bytes.size()), size = random_.below(64);
        const std::size_t n = std::min({size, bytes.size() - from, bytes.size() - at});
        std::copy_n(Bytes(bytes).begin() + static_cast<std::ptrdiff_t>(from), n,
                    bytes.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      }
      case 6:
        bytes[at] ^= static_cast<std::uint8_t>(1u << random_.below(8));
        break;
      default:
        if (random_.chance(0.1)) bytes.resize(at);
    }
  }
  std::uint32_t interesting() {
    constexpr std::uint32_t k_values[] = {
        0,      1,          2,          3,          7,          64,         0x7f,       0xff,
        0xffff, 0x7f800000, 0x7fc00000, 0x3f800000, 0x80000000, 0x7fffffff, 0xfffffffe, 0xffffffff};
    return k_values[random_.below(std::size(k_values))];
  }
  Random random_;
};

constexpr const char* k_names[] = {"PROV", "MATL", "TEXR", "TDAT", "RADI", "RFIR", "RVEC", "TTRI", "TFIR",
                                   "TLIN", "TDIA", "TACC", "TMAT", "TVTX", "TLVX", "TNRM", "TTEX", "LTRI",
                                   "LFIR", "LCEN", "LMAT", "LVTX", "LNRM", "LTEX", "LGRP", "LORD", "LGHI"};

TEST(HostileTree, TenThousandMutantsAreRefusedOrSound) {
  std::vector<Bytes> bases;
  for (const TreeKind kind : {TreeKind::still, TreeKind::sensitive}) {
    for (const Encoding encoding : {Encoding::raw, Encoding::zstd}) {
      for (std::uint64_t seed = 0; seed < 4; ++seed)
        bases.push_back(
            small_file(kind, encoding, seed,
                       seed == 3 ? std::vector<std::string>{"TNRM", "LCEN"} : std::vector<std::string>{}));
    }
  }
  std::size_t loaded = 0;
  for (std::uint64_t seed = 0; seed < 10000; ++seed) {
    const Bytes bytes = Mutator(seed).mutate(bases[seed % bases.size()]);
    for (const Trust trust : {Trust::nothing, Trust::checksums, Trust::file}) {
      const auto file = TreeFile::from_bytes(bytes, "mutant", trust);
      if (!file) continue;
      const auto tree = file->load();
      const auto failures = file->verify();
      // Parts of it: what they refer to is not there.
      const std::size_t n = std::size(k_names);
      const auto part = file->load({k_names[seed % n], k_names[seed / n % n], k_names[seed / n / n % n]});
      if (trust != Trust::nothing || !tree) continue;
      ++loaded;
      ASSERT_THAT(check_tree(*tree), IsEmpty()) << "seed " << seed;
      ASSERT_THAT(failures, IsEmpty()) << "seed " << seed;
      ASSERT_TRUE(encode_tree(*tree)) << "seed " << seed;
      ASSERT_TRUE(part) << "seed " << seed << ": " << part.error().what;
    }
  }
  // Some changes are harmless (a normal, a colour): if none were, the mutants would all die at the door.
  EXPECT_GT(loaded, 300u);
  EXPECT_LT(loaded, 5000u);
}

}  // namespace
}  // namespace copse
