#include "lib/formats/report.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

using Json = nlohmann::ordered_json;

Report full_report() {
  Report r;
  r.tool = "treeprep";
  r.version = "0.1.0";
  r.inputs = {{.path = "oak.glb", .bytes = 12, .hash = "xxh3:0123456789abcdef"}};
  r.outputs = {{.path = "oak.stree", .bytes = 34, .hash = "xxh3:fedcba9876543210"}};
  r.options = {{"jobs", "2"}, {"trunk", "bark*"}, {"trunk", "wood*"}, {"trunk", "stem"}};
  r.seconds = 0.1;
  r.peak_bytes = std::numeric_limits<std::uint64_t>::max();
  r.stages = {{.name = "read", .seconds = 1.0 / 3, .items = 7, .unit = "triangles"}};
  r.errors = {{.name = "radius-centre",
               .value = 1e-300,
               .unit = "m",
               .max = 2,
               .p95 = {},
               .rms = 0.5,
               .reference = "input mesh"}};
  r.curves = {{.name = "obb", .x = "seconds", .y = "excess", .points = {{.label = "a", .x = 1, .y = 2}}}};
  r.tables = {{.name = "t", .columns = {"a", "b"}, .rows = {{"1", "2"}, {"3", "4"}}}};
  r.warnings = {"one", "two"};
  return r;
}

TEST(ReportJson, HasTheKeysOfTheContractInTheirOrder) {
  const Json json = Json::parse(to_json(full_report()));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys,
            (std::vector<std::string>{"schema", "tool", "version", "inputs", "outputs", "options", "seconds",
                                      "peak_bytes", "stages", "errors", "curves", "tables", "warnings"}));
  EXPECT_EQ(json["schema"], "copse.report/1");
  EXPECT_EQ(json["inputs"][0].dump(), R"({"path":"oak.glb","bytes":12,"hash":"xxh3:0123456789abcdef"})");
  EXPECT_EQ(
      json["errors"][0].dump(),
      R"({"name":"radius-centre","value":1e-300,"unit":"m","max":2.0,"rms":0.5,"reference":"input mesh"})");
  EXPECT_EQ(json["curves"][0].dump(),
            R"({"name":"obb","x":"seconds","y":"excess","points":[{"label":"a","x":1.0,"y":2.0}]})");
  EXPECT_EQ(json["tables"][0].dump(), R"({"name":"t","columns":["a","b"],"rows":[["1","2"],["3","4"]]})");
}

TEST(ReportJson, KeepsEveryValueOfAnOptionThatWasGivenSeveralTimes) {
  const Json json = Json::parse(to_json(full_report()));
  EXPECT_EQ(json["options"].dump(), R"({"jobs":"2","trunk":["bark*","wood*","stem"]})");
}

TEST(ReportJson, NumbersReadBackTheSame) {
  const Json json = Json::parse(to_json(full_report()));
  EXPECT_EQ(json["seconds"].get<double>(), 0.1);
  EXPECT_EQ(json["stages"][0]["seconds"].get<double>(), 1.0 / 3);
  EXPECT_EQ(json["errors"][0]["value"].get<double>(), 1e-300);
  EXPECT_EQ(json["peak_bytes"].get<std::uint64_t>(), std::numeric_limits<std::uint64_t>::max());
}

TEST(ReportJson, WhatIsNotFiniteIsNull) {
  Report r = full_report();
  r.seconds = std::numeric_limits<double>::quiet_NaN();
  r.errors[0].value = std::numeric_limits<double>::infinity();
  const Json json = Json::parse(to_json(r));
  EXPECT_TRUE(json["seconds"].is_null());
  EXPECT_TRUE(json["errors"][0]["value"].is_null());
}

TEST(ReportJson, AFileNameThatIsNoUtf8DoesNotThrow) {
  Report r = full_report();
  r.inputs[0].path = "oak\xff\xfe.glb";
  EXPECT_TRUE(Json::accept(to_json(r)));
}

TEST(ReportJson, AnEmptyReportHasEmptyLists) {
  const Json json = Json::parse(to_json(Report{}));
  for (const char* key : {"inputs", "outputs", "stages", "errors", "curves", "tables", "warnings"}) {
    EXPECT_EQ(json[key], Json::array()) << key;
  }
  EXPECT_EQ(json["options"], Json::object());
}

}  // namespace
}  // namespace copse
