// What tests of ecogen begin with.
#pragma once

#include "lib/formats/ecosystem/ecosystem_file.h"
#include "tests/formats/tree_maker.h"
#include "tests/tools/little_obj.h"
#include "tests/tools/process.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {

using Json = nlohmann::ordered_json;

// A folder with two little trees and a page.
class Ecogen : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"a.stree", "b.tree"}) {
      const bool sensitive = std::string(name) == "a.stree";
      Tree tree = make_tree({.kind = sensitive ? TreeKind::sensitive : TreeKind::still}, 1);
      tree.header.origin = {};  // it stands where its instances do
      const auto bytes = encode_tree(tree);
      ASSERT_TRUE(bytes);
      write_text(file(name), {bytes->begin(), bytes->end()});
    }
    page_ = Json::parse(R"({"seed": 3,
      "terrain": {"size": [60, 40], "samples": [31, 21], "faults": {"count": 20, "first": 0.5, "smooth": 1}, "material": "soil"},
      "materials": [{"name": "soil", "diffuse": [0.2, 0.2, 0.1]}, {"name": "gold"}],
      "types": [{"name": "a", "tree": "a.stree", "count": 200, "scale": {"min": 0.01, "max": 0.02}, "tilt": "terrain"},
                {"name": "b", "tree": "b.tree", "count": 50, "scale": 0.03}]})");
  }

  std::string file(const std::string& name) const { return folder_.file(name); }
  void save() const { write_text(file("page.json"), page_.dump(1)); }
  Outcome run(std::vector<std::string> more = {}) const {
    save();
    std::vector<std::string> command{"ecogen", file("page.json"), "-o", file("out.eco")};
    command.insert(command.end(), more.begin(), more.end());
    return run_process(command);
  }
  Ecosystem load() const {
    const auto opened = EcosystemFile::open(file("out.eco"));
    EXPECT_TRUE(opened) << (opened ? "" : opened.error().what);
    EXPECT_EQ(opened->verify(), std::vector<std::string>{});
    auto eco = opened->load();
    EXPECT_TRUE(eco);
    return std::move(*eco);
  }
  // The one line of a refusal.
  std::string refusal(int status = 1) const {
    const Outcome o = run();
    EXPECT_EQ(o.status, status) << o.err;
    EXPECT_EQ(line_count(o.err), 1u) << o.err;
    EXPECT_FALSE(std::filesystem::exists(file("out.eco")));
    return o.err;
  }

  TemporaryFolder folder_;
  Json page_;
};

}  // namespace copse
