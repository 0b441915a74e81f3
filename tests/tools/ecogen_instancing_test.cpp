// An outside reader of EXT_mesh_gpu_instancing: glTF Transform, from npm. The Khronos validator does not look
// into the extension, and Blender 3.4 does not know it.
#include "lib/formats/ecosystem/instance_codec.h"
#include "tests/tools/ecogen_folder.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <tuple>

namespace copse {
namespace {

// Where an instance stands, how large it is, and where its +Y and its +X lead.
struct Stand {
  Double3 at, up, side;
  double scale;
};

std::vector<Stand> by_place(std::vector<Stand> stands) {
  std::ranges::sort(stands, {}, [](const Stand& s) { return std::tuple(s.at.x, s.at.y, s.at.z); });
  return stands;
}

std::vector<Stand> stands_of(const Ecosystem& eco) {
  std::vector<Stand> out;
  for (const InstanceBlock& block : eco.blocks) {
    for (std::size_t i = block.first; i < block.first + block.count; ++i) {
      const Instance instance = instance_of(eco, block, i);
      out.push_back({instance.position, rotate(instance.rotation, {0, 1, 0}),
                     rotate(instance.rotation, {1, 0, 0}), instance.scale});
    }
  }
  return by_place(std::move(out));
}

// Prints a line of ten numbers an instance, by the matrices that the reader makes.
constexpr const char* k_reader = R"(
const { NodeIO } = require('@gltf-transform/core'), { EXTMeshGPUInstancing } = require('@gltf-transform/extensions');
const along = (q, v) => {  // v turned by q
  const [x, y, z, w] = q, [a, b, c] = v;
  const t = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * t[0] + y * t[2] - z * t[1], b + w * t[1] + z * t[0] - x * t[2], c + w * t[2] + x * t[1] - y * t[0]];
};
new NodeIO().registerExtensions([EXTMeshGPUInstancing]).read(process.argv[2]).then(document => {
  for (const node of document.getRoot().listNodes()) {
    const batch = node.getExtension('EXT_mesh_gpu_instancing');
    if (!batch) continue;
    const [t, r, s] = ['TRANSLATION', 'ROTATION', 'SCALE'].map(name => batch.getAttribute(name));
    const m = node.getWorldMatrix();
    for (let i = 0; i < t.getCount(); ++i) {
      const p = t.getElement(i, []), q = r.getElement(i, []);
      const at = [0, 1, 2].map(k => m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k]);
      console.log(...at, ...along(q, [0, 1, 0]), ...along(q, [1, 0, 0]), s.getElement(i, [])[1]);
    }
  }
});)";

TEST_F(Ecogen, AnotherReaderFindsEveryInstanceOfTheGlbWhereItStands) {
  page_["terrain"]["origin"] = {1000, 50, -2000};
  ASSERT_EQ(run({"--export", file("f.glb")}).status, 0);
  write_text(file("read.js"), k_reader);
  const char* modules = std::getenv("NODE_PATH");
  const Outcome o = run_process({"/bin/sh", "-c", "node '" + file("read.js") + "' '" + file("f.glb") + "'"},
                                {std::string("NODE_PATH=") + (modules ? modules : "")});
  if (o.err.find("Cannot find module") != std::string::npos || o.status == 127)
    GTEST_SKIP() << "node or @gltf-transform could not be had: `./run test` installs them "
                    "(cmake/debian-judges.txt)";
  ASSERT_EQ(o.status, 0) << o.err;
  std::vector<Stand> read;
  std::istringstream lines(o.out);
  for (Stand s{}; lines >> s.at.x >> s.at.y >> s.at.z >> s.up.x >> s.up.y >> s.up.z >> s.side.x >> s.side.y >>
                  s.side.z >> s.scale;)
    read.push_back(s);
  read = by_place(std::move(read));
  const std::vector<Stand> wanted = stands_of(load());
  ASSERT_EQ(read.size(), wanted.size());
  ASSERT_EQ(read.size(), 250u);
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_LT(distance(read[i].at, wanted[i].at), 1e-5);  // of 60 m, in float32
    EXPECT_LT(distance(read[i].up, wanted[i].up), 1e-6);
    EXPECT_LT(distance(read[i].side, wanted[i].side), 1e-6);
    EXPECT_NEAR(read[i].scale, wanted[i].scale, 1e-6 * wanted[i].scale);
  }
}

}  // namespace
}  // namespace copse
