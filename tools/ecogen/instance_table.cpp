#include "tools/ecogen/instance_table.h"

#include "lib/analysis/ecosystem/tilt.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "tools/common/command_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace copse::ecogen {
namespace {

constexpr std::array<std::string_view, 14> k_columns{
    "type",          "x",      "y",   "z",     "head", "pitch", "roll", "scale", "trunk_material",
    "leaf_material", "motion", "red", "green", "blue"};
enum Column : std::size_t {
  c_type,
  c_x,
  c_y,
  c_z,
  c_head,
  c_pitch,
  c_roll,
  c_scale,
  c_trunk,
  c_leaf,
  c_motion,
  c_red,
  c_green,
  c_blue
};

// Quoted when it must be (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

// Blanks round a field that is not quoted are its table's looks.
void trim(std::string& field) {
  const std::size_t first = field.find_first_not_of(" \t");
  field = first == std::string::npos ? "" : field.substr(first, field.find_last_not_of(" \t") - first + 1);
}

// One row; `rest` begins behind it. None when a quote is never closed.
std::optional<std::vector<std::string>> next_row(std::string_view& rest) {
  std::vector<std::string> fields(1);
  bool quoted = false, kept = false;  // kept: the field was in quotes
  const auto finish = [&] {
    if (!kept) trim(fields.back());
    kept = false;
  };
  std::size_t i = 0;
  for (; i < rest.size(); ++i) {
    const char c = rest[i];
    if (quoted) {
      if (c != '"')
        fields.back() += c;
      else if (i + 1 < rest.size() && rest[i + 1] == '"')
        fields.back() += rest[++i];
      else
        quoted = false;
    } else if (c == '"' && fields.back().find_first_not_of(" \t") == std::string::npos && !kept) {
      fields.back().clear();
      quoted = kept = true;
    } else if (c == ',') {
      finish();
      fields.emplace_back();
    } else if (c == '\n') {
      break;
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  if (quoted) return std::nullopt;
  finish();
  rest.remove_prefix(std::min(i + 1, rest.size()));
  return fields;
}

class TableReader {
 public:
  TableReader(const std::string& file, Scene& scene) : file_(file) {
    for (TypeSource& t : scene.types) types_.emplace(t.name, &t);
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
      materials_.emplace(scene.materials[m].name, static_cast<std::uint32_t>(m));
  }

  Result<void> read(std::string_view rest) {
    constexpr std::string_view k_mark = "\xef\xbb\xbf";  // spreadsheets put it before UTF-8
    if (rest.starts_with(k_mark)) rest.remove_prefix(k_mark.size());
    auto header = next_row(rest);
    if (!header) return wrong("a quote is never closed");
    if (auto known = read_header(*header); !known) return known;
    while (!rest.empty()) {
      ++line_;
      const auto row = next_row(rest);
      if (!row) return wrong("a quote is never closed");
      if (row->size() == 1 && row->front().empty()) continue;
      if (row->size() != at_.size())
        return wrong(fmt::format("{} fields, the first line has {}", row->size(), at_.size()));
      if (auto added = add(*row); !added) return added;
    }
    return {};
  }

 private:
  std::unexpected<Error> wrong(const std::string& what, const std::string& remedy = "mend the line") const {
    return refuse(file_, fmt::format("line {}: {}", line_, what), remedy);
  }

  Result<void> read_header(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const auto known = std::find(k_columns.begin(), k_columns.end(), name);
      if (known == k_columns.end()) {
        const std::string nearest = nearest_name(name, {k_columns.begin(), k_columns.end()});
        return wrong(fmt::format("column '{}' is unknown", name),
                     nearest.empty() ? "see docs/ecogen.md for their names"
                                     : fmt::format("did you mean '{}'?", nearest));
      }
      if (std::find(at_.begin(), at_.end(), static_cast<std::size_t>(known - k_columns.begin())) != at_.end())
        return wrong(fmt::format("column '{}' is there twice", name), "leave one");
      at_.push_back(static_cast<std::size_t>(known - k_columns.begin()));
    }
    for (const Column c : {c_type, c_x, c_z})
      if (std::find(at_.begin(), at_.end(), c) == at_.end())
        return wrong(fmt::format("there is no column '{}'", k_columns[c]), "add it");
    return {};
  }

  template <class Number>
  Result<void> number(const std::string& text, Column column, double low, double high, Number& out) const {
    if (text.empty()) return {};
    double value = 0;
    const char* first = text.data() + (text.front() == '+' && text.size() > 1 && text[1] != '-');
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(value >= low && value <= high) ||
        (std::is_integral_v<Number> && value != std::floor(value)))
      return wrong(fmt::format("{} '{}' is not allowed", k_columns[column], text),
                   fmt::format("give it a {}number from {} to {}", std::is_integral_v<Number> ? "whole " : "",
                               low, high));
    out = static_cast<Number>(value);
    return {};
  }

  Result<void> material(const std::string& name, Column column, std::uint32_t& out) const {
    if (name.empty()) return {};
    const auto at = materials_.find(name);
    if (at == materials_.end())
      return wrong(fmt::format("{}: there is no material called '{}'", k_columns[column], name),
                   "add it to the page");
    out = at->second;
    return {};
  }

  Result<void> add(const std::vector<std::string>& row) {
    std::array<std::string, k_columns.size()> f;
    for (std::size_t i = 0; i < row.size(); ++i) f[at_[i]] = row[i];
    const auto known = types_.find(f[c_type]);
    if (known == types_.end())
      return wrong(fmt::format("there is no type called '{}'", f[c_type]), "add it to the page");
    TypeSource* const type = known->second;
    PlantedSource p;
    p.trunk_material = type->trunk_material;
    p.leaf_material = type->leaf_material;
    p.motion = type->motion;
    if (f[c_x].empty() || f[c_z].empty()) return wrong("x or z is empty");
    double y = 0, pitch = 0, roll = 0;
    Result<void> state;
    const auto take = [&](Column c, double low, double high, auto& out) {
      if (state) state = number(f[c], c, low, high, out);
    };
    take(c_x, -1e9, 1e9, p.x), take(c_y, -1e9, 1e9, y), take(c_z, -1e9, 1e9, p.z);
    take(c_head, -1e9, 1e9, p.head), take(c_pitch, -1e9, 1e9, pitch), take(c_roll, -1e9, 1e9, roll);
    take(c_scale, 1e-31, 1e6, p.scale);  // a page takes 1e-30, and what is stored may round below it
    take(c_motion, 0, 4294967295.0, p.motion);
    take(c_red, 0, 255, p.tint[0]), take(c_green, 0, 255, p.tint[1]), take(c_blue, 0, 255, p.tint[2]);
    if (state) state = material(f[c_trunk], c_trunk, p.trunk_material);
    if (state) state = material(f[c_leaf], c_leaf, p.leaf_material);
    if (!state) return state;
    if (!f[c_y].empty()) p.y = y;
    if (!f[c_pitch].empty()) p.pitch = pitch;
    if (!f[c_roll].empty()) p.roll = roll;
    type->planted.push_back(p);
    return {};
  }

  const std::string& file_;
  std::map<std::string, TypeSource*> types_;  // by name
  std::map<std::string, std::uint32_t> materials_;
  std::size_t line_ = 1;
  std::vector<std::size_t> at_;  // which column of ours each of theirs is
};

}  // namespace

std::string instances_csv(const Ecosystem& eco) {
  std::string out = fmt::format("{}\n", fmt::join(k_columns, ","));
  const auto material = [&](std::uint32_t m) {
    return m == k_none ? std::string() : field(eco.materials[m].name);
  };
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t k = b.first; k < b.first + b.count; ++k) {
      const Instance i = instance_of(eco, b, k);
      const Angles a = angles_of(i.rotation);
      const auto unsigned_zero = [](double x) { return x + 0.0; };  // nobody has said -0
      fmt::format_to(std::back_inserter(out), "{},{},{},{},{:.9g},{:.9g},{:.9g},{},{},{},{},{},{},{}\n",
                     field(eco.types[i.type].name), i.position.x, i.position.y, i.position.z,
                     unsigned_zero(a.head), unsigned_zero(a.pitch), unsigned_zero(a.roll), i.scale,
                     material(i.trunk_material), material(i.leaf_material), i.motion, i.tint[0], i.tint[1],
                     i.tint[2]);
    }
  return out;
}

Result<void> add_instances(std::string_view csv, const std::string& file, Scene& scene) {
  return TableReader(file, scene).read(csv);
}

}  // namespace copse::ecogen
