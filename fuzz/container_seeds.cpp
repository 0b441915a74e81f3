// Writes the seeds of fuzz_container: small sound trees of every kind, so that the fuzzer starts behind the
// header.
//   fuzz_container_seeds fuzz/corpus/container
#include "lib/formats/container/atomic_file.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_pack.h"
#include "tests/formats/tree_maker.h"

#include <cstdio>
#include <string>

namespace copse {
namespace {

Result<void> write_seed(const std::filesystem::path& folder, TreeKind kind, bool constant,
                        Encoding encoding) {
  const std::uint32_t one = constant ? 2 : 0;
  const Tree tree = make_tree({.kind = kind,
                               .roots = 1,
                               .radii = 4,
                               .leaves = 3,
                               .groups = 2,
                               .ring = one,
                               .segment = one,
                               .leaf = one,
                               .one_material = constant},
                              1);
  WriteOptions options{.encoding = encoding};
  if (constant) options.omit = {"TNRM", "TTEX"};
  const auto bytes = encode_tree(tree, options);
  if (!bytes) return std::unexpected(bytes.error());
  std::string name = encoding == Encoding::raw ? "raw" : "zstd";
  if (constant) name += "_constant";
  name += kind == TreeKind::still ? ".tree" : ".stree";
  return write_file(folder / name, *bytes);
}

Result<void> write_packed_seed(const std::filesystem::path& folder) {
  const Tree tree =
      make_tree({.roots = 1, .radii = 6, .leaves = 5, .groups = 2, .materials = 2, .textures = 1}, 3);
  const auto plain = encode_tree(tree);
  if (!plain) return std::unexpected(plain.error());
  const auto file = Container::from_bytes(*plain, "seed");
  if (!file) return std::unexpected(file.error());
  const auto packed = pack_tree(tree, {});
  if (!packed) return std::unexpected(packed.error());
  ContainerWriter writer(*file);
  if (auto done = put_packed(writer, *packed); !done) return done;
  const auto bytes = writer.finish();
  if (!bytes) return std::unexpected(bytes.error());
  return write_file(folder / "packed.stree", *bytes);
}

}  // namespace
}  // namespace copse

int main(int argc, char** argv) {
  using namespace copse;
  if (argc != 2) return std::puts("fuzz_container_seeds FOLDER"), 2;
  if (const auto written = write_packed_seed(argv[1]); !written)
    return std::puts(to_line(written.error(), "fuzz_container_seeds").c_str()), 3;
  for (const TreeKind kind : {TreeKind::still, TreeKind::sensitive}) {
    for (const bool constant : {false, true}) {
      for (const Encoding encoding : {Encoding::raw, Encoding::zstd}) {
        const auto written = write_seed(argv[1], kind, constant, encoding);
        if (!written) return std::puts(to_line(written.error(), "fuzz_container_seeds").c_str()), 3;
      }
    }
  }
}
