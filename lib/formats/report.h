// copse.report/1: what was done, how long it took, how wrong it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace copse {

struct FileRecord {
  std::string path;
  std::uint64_t bytes = 0;
  std::string hash;  // "xxh3:" and 16 hexadecimal digits
};

struct StageRecord {
  std::string name;
  double seconds = 0;
  std::uint64_t items = 0;
  std::string unit;  // "triangles"
};

// One error measure. Fields that were not measured stay empty and are not printed.
struct ErrorRecord {
  std::string name;  // "radius-centre"
  double value = 0;  // the mean, unless the name says otherwise
  std::string unit;  // "m", "ratio", ...
  std::optional<double> max, p95, rms;
  std::string reference;  // what it was measured against: "input mesh"
};

struct CurvePoint {
  std::string label;
  double x = 0, y = 0;
};

struct Curve {
  std::string name, x, y;
  std::vector<CurvePoint> points;
  // Labelled points are trials of something that is to be small: a line joins those that nothing further left
  // is below, and only they are labelled.
  bool trials = false;
};

// A picture for the page: an SVG fragment (<svg ...>...</svg>) with a caption.
struct ReportPicture {
  std::string title, caption, svg;
};

// A table for the page and, as "tables", for the JSON.
struct Table {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

struct Report {
  std::string tool, version;
  std::vector<FileRecord> inputs, outputs;
  std::vector<std::pair<std::string, std::string>> options;  // as given or defaulted, in a fixed order
  double seconds = 0;
  std::uint64_t peak_bytes = 0;
  std::vector<StageRecord> stages;
  std::vector<ErrorRecord> errors;
  std::vector<Curve> curves;
  std::vector<Table> tables;
  std::vector<ReportPicture> pictures;  // for the page only
  std::vector<std::string> warnings;
};

// The report as JSON text, schema copse.report/1 (cli.md). Extra keys: "tables".
std::string to_json(const Report& report);

}  // namespace copse
