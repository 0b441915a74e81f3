// What a frame cost: the rows of --stats and the table of --report.
#pragma once

#include "lib/formats/report.h"
#include "tools/treeplay/renderer.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace copse::treeplay {

class Statistics {
 public:
  // t_application: until the picture is decided. t_render: until it is finished (not only sent).
  void add(const FramePlan& plan, double t_application, double t_render);

  // Of an ecosystem: what of its instances was read up to now.
  void read(const StreamCounts& counts) { read_ = counts; }

  // cli.md's columns; empty where nothing is measured.
  std::string csv() const;
  // Mean, median, 95 % and largest of each time.
  Table table() const;
  // Of an ecosystem: what finding out what is seen took, the mean of a frame.
  Table culling() const;
  // Of an ecosystem: which part of its instances was ever read.
  Table streaming(const Ecosystem& eco) const;

 private:
  struct Row {
    double application = 0, render = 0;
    std::uint64_t triangles = 0, lines = 0, points = 0, tested = 0, drawn = 0, plane_tests = 0;
    std::string level;  // its number, its error and the distance, as the CSV has them
    std::optional<ForestCounts> forest;
  };
  std::vector<Row> rows_;
  StreamCounts read_;
};

}  // namespace copse::treeplay
