#include "lib/formats/report.h"

#include <nlohmann/json.hpp>

namespace copse {
namespace {

// Keeps keys in the order of cli.md. Doubles print as the shortest text that reads back the same; what is not
// finite prints as null.
using Json = nlohmann::ordered_json;

template <class T, class ToJson>
Json list(const std::vector<T>& elements, ToJson&& convert) {
  Json out = Json::array();
  for (const T& e : elements) out.push_back(convert(e));
  return out;
}

Json to_json(const FileRecord& f) {
  return {{"path", f.path}, {"bytes", f.bytes}, {"hash", f.hash}};
}

Json to_json(const StageRecord& s) {
  return {{"name", s.name}, {"seconds", s.seconds}, {"items", s.items}, {"unit", s.unit}};
}

Json to_json(const ErrorRecord& e) {
  Json out{{"name", e.name}, {"value", e.value}, {"unit", e.unit}};
  if (e.max) out["max"] = *e.max;
  if (e.p95) out["p95"] = *e.p95;
  if (e.rms) out["rms"] = *e.rms;
  out["reference"] = e.reference;
  return out;
}

Json to_json(const CurvePoint& p) {
  return {{"label", p.label}, {"x", p.x}, {"y", p.y}};
}

Json to_json(const Curve& c) {
  return {{"name", c.name}, {"x", c.x}, {"y", c.y}, {"points", list(c.points, [](const auto& p) {
                                                       return to_json(p);
                                                     })}};
}

Json to_json(const Table& t) {
  return {{"name", t.name}, {"columns", t.columns}, {"rows", t.rows}};
}

// An option that was given several times has a list of values.
Json options_to_json(const std::vector<std::pair<std::string, std::string>>& options) {
  Json out = Json::object();
  for (const auto& [name, value] : options) {
    if (!out.contains(name)) {
      out[name] = value;
    } else if (out[name].is_array()) {
      out[name].push_back(value);
    } else {
      out[name] = Json::array({out[name], value});
    }
  }
  return out;
}

}  // namespace

std::string to_json(const Report& report) {
  const auto convert = [](const auto& e) { return to_json(e); };
  const Json out{{"schema", "copse.report/1"},
                 {"tool", report.tool},
                 {"version", report.version},
                 {"inputs", list(report.inputs, convert)},
                 {"outputs", list(report.outputs, convert)},
                 {"options", options_to_json(report.options)},
                 {"seconds", report.seconds},
                 {"peak_bytes", report.peak_bytes},
                 {"stages", list(report.stages, convert)},
                 {"errors", list(report.errors, convert)},
                 {"curves", list(report.curves, convert)},
                 {"tables", list(report.tables, convert)},
                 {"warnings", report.warnings}};
  // File names may hold any bytes, JSON only UTF-8: what is not is replaced, never thrown about.
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace copse
