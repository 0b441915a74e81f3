// What a frame cost: the rows of --stats and the table of --report.
#pragma once

#include "lib/formats/report.h"
#include "tools/treeplay/renderer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse::treeplay {

class Statistics {
 public:
  // t_application: until the picture is decided. t_render: until it is finished (not only sent).
  void add(const FramePlan& plan, double t_application, double t_render);

  // cli.md's columns; empty where nothing is measured.
  std::string csv() const;
  // Mean, median, 95 % and largest of each time.
  Table table() const;

 private:
  struct Row {
    double application = 0, render = 0;
    std::uint64_t triangles = 0, lines = 0, points = 0, tested = 0, drawn = 0, plane_tests = 0;
    std::string level;  // its number, its error and the distance, as the CSV has them
  };
  std::vector<Row> rows_;
};

}  // namespace copse::treeplay
