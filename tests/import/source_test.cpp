// Where the bytes come from: files, pipes, gzip; and which format they are taken for.
#include "lib/formats/import/source.h"

#include "lib/formats/import/detect.h"
#include "tests/import/testing.h"

#include <cstring>
#include <thread>

#include <sys/stat.h>

namespace copse {
namespace {

using namespace copse::testing;

constexpr const char* k_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(Source, AGzippedMeshIsReadWhateverItsName) {
  const Folder folder;
  for (const char* name : {"tree.obj.gz", "tree.OBJ.GZ", "tree.obj", "tree"}) {
    const std::string packed = gzipped(k_triangle);
    const Import m = good(import_mesh(folder.write(name, packed)));
    EXPECT_EQ(m.format, MeshFormat::obj);
    EXPECT_EQ(m.mesh.triangles.size(), 1u);
    EXPECT_EQ(m.bytes, packed.size());
  }
}

TEST(Source, AllMembersOfAGzipFileAreInflated) {
  const std::string packed = gzipped("v 0 0 0\nv 1 0 0\n") + gzipped("v 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(good(read(packed, MeshFormat::obj)).mesh.triangles.size(), 1u);
  EXPECT_EQ(good(read(packed + std::string(512, '\0'), MeshFormat::obj)).mesh.triangles.size(), 1u);
}

TEST(Source, EveryTruncationOfAGzipFileIsRefused) {
  const std::string packed = gzipped(k_triangle);
  for (std::size_t size = 2; size < packed.size(); ++size)
    EXPECT_EQ(error_of(read(packed.substr(0, size), MeshFormat::obj)),
              "import: error: tree: byte " + std::to_string(size) +
                  ": the gzip data end in the middle; copy or compress it again");
}

TEST(Source, DamagedGzipDataAreRefused) {
  std::string packed = gzipped(k_triangle);
  packed[packed.size() - 6] = static_cast<char>(packed[packed.size() - 6] ^ 1);
  EXPECT_EQ(error_of(read(packed, MeshFormat::obj)),
            "import: error: tree: byte " + std::to_string(packed.size() - 4) +
                ": the gzip data are damaged (incorrect data check); copy or compress it again");
  EXPECT_NE(error_of(read(gzipped(k_triangle) + "tail", MeshFormat::obj))
                .find("what follows the gzip data is not gzip"),
            std::string::npos);
}

TEST(Source, AGzipBombIsRefused) {
  const std::string packed = gzipped(std::string(66 << 20, '\n'));
  ASSERT_LT(packed.size(), 200'000u);
  EXPECT_EQ(error_of(read(packed, MeshFormat::obj)),
            "import: error: tree: inflates " + std::to_string(packed.size()) +
                " bytes to more than 67108864; if this is not an attack, store it uncompressed");
}

TEST(Source, FilesThatCannotBeReadAreAnIoError) {
  const Folder folder;
  const auto missing = import_mesh(folder.path() / "none.obj");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().fault, Fault::io);
  EXPECT_EQ(error_of(missing),
            "import: error: " + (folder.path() / "none.obj").string() +
                ": cannot be read: No such file or directory; check the name and the permissions");
  EXPECT_EQ(error_of(import_mesh(folder.path())),
            "import: error: " + folder.path().string() + ": is a folder; name a file in it");
}

TEST(Source, AnEmptyFileAndAnUnknownOneAreRefused) {
  const Folder folder;
  const auto empty = import_mesh(folder.write("tree.obj", ""));
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().fault, Fault::refused);
  EXPECT_EQ(empty.error().what, "is empty");
  EXPECT_EQ(error_of(read("hello", MeshFormat::unknown)),
            "import: error: tree: is of no mesh format that is read here; give OBJ, PLY, OFF, STL, glTF or "
            "GLB, gzipped "
            "or not");
}

TEST(Source, APipeIsReadToItsEnd) {
  const Folder folder;
  const auto path = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(path) << k_triangle; });
  EXPECT_EQ(good(import_mesh(path)).mesh.triangles.size(), 1u);
  writer.join();
}

TEST(Source, ReferencesStayBelowTheFolder) {
  EXPECT_EQ(below("/m", "a.mtl"), "/m/a.mtl");
  EXPECT_EQ(below("/m", "maps\\a.png"), "/m/maps/a.png");
  EXPECT_EQ(below("/m", "x/../a.mtl"), "/m/a.mtl");
  EXPECT_EQ(below("", "./a.mtl"), "a.mtl");
  for (const std::string& outside :
       {std::string("/etc/passwd"), std::string("../a"), std::string("x/../../a"), std::string("C:/a"),
        std::string("\\\\host\\a"), std::string(""), std::string("a\0b", 3)})
    EXPECT_EQ(below("/m", outside), "") << outside;
}

TEST(Detect, TheContentDecidesBeforeTheExtension) {
  const auto detect = [](std::string_view text, const char* name) {
    return detect_format(as_bytes(text), name);
  };
  EXPECT_EQ(detect("glTF....", "x.obj"), MeshFormat::glb);
  EXPECT_EQ(detect("ply\nformat", "x.obj"), MeshFormat::ply);
  EXPECT_EQ(detect("ply\r\nformat", "x"), MeshFormat::ply);
  EXPECT_EQ(detect("OFF\n", "x.obj"), MeshFormat::off);
  EXPECT_EQ(detect("# c\nSTCNOFF 1\n", "x"), MeshFormat::off);
  EXPECT_EQ(detect(" {\"asset\":{}}", "x.txt"), MeshFormat::gltf);
  EXPECT_EQ(detect("solid x\nfacet", "x"), MeshFormat::stl);
  EXPECT_EQ(detect("# c\nv 0 0 0\n", "x"), MeshFormat::obj);
  EXPECT_EQ(detect("4 1 0\n", "x.off"), MeshFormat::off);
  EXPECT_EQ(detect("anything", "x.STL"), MeshFormat::stl);
  EXPECT_EQ(detect("anything", "x.ply.gz"), MeshFormat::ply);
  EXPECT_EQ(detect("anything", "x"), MeshFormat::unknown);
  std::string binary(84 + 50, '\0');
  binary[80] = 1;
  EXPECT_EQ(detect(binary, "x.obj"), MeshFormat::stl);
  EXPECT_STREQ(format_name(MeshFormat::glb), "GLB");
}

}  // namespace
}  // namespace copse
