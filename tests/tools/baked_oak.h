#pragma once

#include "lib/formats/import/import.h"
#include "tests/tools/little_obj.h"
#include "tests/tools/process.h"

#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace copse {

// A little tree, prepared; lodbake reads it and writes beside it.
class BakedOak : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_.path() / "oak.obj", little_tree_obj(8, 12, 60));
    const Outcome o = run_process({"treeprep", folder_.file("oak.obj"), "-o", tree_, "-q"});
    ASSERT_EQ(o.status, 0) << o.err;
  }
  Outcome bake(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"lodbake", tree_, "-o", out_});
    return run_process(arguments);
  }
  std::size_t triangles(std::vector<std::string> arguments, const std::string& name = "level.obj") const {
    arguments.insert(arguments.begin(), {"treedump", out_, "--export", folder_.file(name)});
    const Outcome o = run_process(arguments);
    EXPECT_EQ(o.status, 0) << o.err;
    const auto mesh = import_mesh(folder_.path() / name);
    return mesh ? mesh->mesh.triangles.size() : 0;
  }

  TemporaryFolder folder_;
  std::string tree_ = folder_.file("oak.stree"), out_ = folder_.file("oak.lod.stree");
};

}  // namespace copse
