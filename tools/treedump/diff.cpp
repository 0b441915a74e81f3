#include "lib/formats/tree/tree_sections.h"
#include "tools/treedump/element.h"
#include "tools/treedump/text.h"
#include "tools/treedump/views.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <type_traits>

#include <fmt/format.h>

namespace copse {
namespace {

// Sections that are compared field by field, or told as notes.
constexpr std::string_view k_records[] = {"HEAD", "OMIT", "PROV", "MATL", "MNAM", "TEXR", "TNAM", "TDAT"};

// How a field of an array's elements differs: in how many elements, and by how much at most.
struct FieldDifference {
  std::size_t count = 0;
  double most = 0;
  bool is_real = false;
};

class Comparison {
 public:
  explicit Comparison(double tolerance) : tolerance_(tolerance) {}

  // Fields of two elements, one record after another. Fields keep the order in which they first differ.
  template <class T>
  bool element(const T& a, const T& b) {
    values_.clear();
    each_field(a, [&](const char* name, const auto& value) {
      each_number(value, [&](const char* axis, auto number) {
        values_.push_back({name, axis, to_real(number), is_real(number)});
      });
    });
    std::size_t at = 0;
    bool same = true;
    each_field(b, [&](const char*, const auto& value) {
      each_number(value, [&](const char*, auto number) {
        same = number_equal(values_[at++], to_real(number)) && same;
      });
    });
    return same;
  }

  const std::vector<std::string>& order() const { return order_; }
  const FieldDifference& of(const std::string& name) const { return fields_.at(name); }

 private:
  struct Value {
    const char* name;
    const char* axis;
    double number;
    bool is_real;
  };
  template <class T>
  static double to_real(T number) {
    return static_cast<double>(number);
  }
  template <class T>
  static bool is_real(T) {
    return std::is_floating_point_v<T>;
  }

  bool number_equal(const Value& a, double b) {
    if (a.number == b || (std::isnan(a.number) && std::isnan(b))) return true;
    const double difference = std::fabs(a.number - b);
    if (a.is_real && difference <= tolerance_) return true;
    const std::string name = std::string(a.name) + a.axis;
    const auto [field, is_new] = fields_.try_emplace(name);
    if (is_new) order_.push_back(name);
    ++field->second.count;
    field->second.is_real = a.is_real;
    field->second.most = std::max(field->second.most, std::isnan(difference) ? INFINITY : difference);
    return false;
  }

  double tolerance_;
  std::vector<Value> values_;
  std::map<std::string, FieldDifference> fields_;
  std::vector<std::string> order_;
};

std::string fields_text(const Comparison& comparison) {
  std::string out;
  for (const std::string& name : comparison.order()) {
    const FieldDifference& field = comparison.of(name);
    const std::string label = name.empty()                                 ? "values"
                              : name.front() == '.' || name.front() == '[' ? name.substr(name.front() == '.')
                                                                           : name;
    out += fmt::format("{}{} in {}", out.empty() ? "" : ", ", label, count_text(field.count));
    if (field.is_real) out += fmt::format(" by up to {:.6g}", field.most);
  }
  return out;
}

template <class T>
void diff_array(std::string_view name, const Array<T>& a, const Array<T>& b, double tolerance,
                std::vector<std::string>& lines) {
  const std::string_view what = describe_section(name);
  if (a.empty() != b.empty()) {
    lines.push_back(fmt::format("{} ({}): only in the {} file", name, what, b.empty() ? "first" : "second"));
    return;
  }
  if (a.size() != b.size()) {
    lines.push_back(
        fmt::format("{} ({}): {} elements, then {}", name, what, count_text(a.size()), count_text(b.size())));
    return;
  }
  Comparison comparison(tolerance);
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += comparison.element(a[i], b[i]) ? 0 : 1;
  if (different == 0) return;
  lines.push_back(fmt::format("{} ({}): {} of {} elements differ: {}", name, what, count_text(different),
                              count_text(a.size()), fields_text(comparison)));
}

// Every array of the first tree against its like in the second; returns the names of all that there are.
std::vector<std::string_view> diff_arrays(const TreeFile& file_a, const Tree& a, const TreeFile& file_b,
                                          const Tree& b, double tolerance, std::vector<std::string>& lines) {
  const Head head_a{.header = a.header, .counts = file_a.counts()};
  const Head head_b{.header = b.header, .counts = file_b.counts()};
  std::vector<std::string_view> seen;
  for_each_array(
      a, head_a, [&]<class T>(std::string_view name, const Array<T>& first, std::uint64_t, Presence) {
        seen.push_back(name);
        Array<T> second;
        for_each_array(b, head_b,
                       [&]<class U>(std::string_view other, const Array<U>& array, std::uint64_t, Presence) {
                         if constexpr (std::is_same_v<T, U>) {
                           if (other == name) second = array;
                         }
                       });
        diff_array(name, first, second, tolerance, lines);
      });
  for_each_array(b, head_b, [&](std::string_view name, const auto& array, std::uint64_t, Presence) {
    if (!array.empty() && std::find(seen.begin(), seen.end(), name) == seen.end()) {
      lines.push_back(fmt::format("{} ({}): only in the second file", name, describe_section(name)));
    }
    seen.push_back(name);
  });
  return seen;
}

template <class T>
void diff_record(const std::string& name, const T& a, const T& b, double tolerance,
                 std::vector<std::string>& lines) {
  std::vector<std::string> before;
  each_field(a, [&](const char* field, const auto& value) {
    each_number(value, [&](const char* axis, auto number) {
      before.push_back(fmt::format("{}{} {}", field, axis, number));
    });
  });
  Comparison comparison(tolerance);
  if (comparison.element(a, b)) return;
  std::size_t at = 0;
  each_field(b, [&](const char* field, const auto& value) {
    each_number(value, [&](const char* axis, auto number) {
      const std::string key = std::string(field) + axis;
      const auto& order = comparison.order();
      if (std::find(order.begin(), order.end(), key) != order.end()) {
        lines.push_back(fmt::format("{}: {}, then {}", name, before[at], number));
      }
      ++at;
    });
  });
}

void diff_materials(const Tree& a, const Tree& b, double tolerance, std::vector<std::string>& lines) {
  if (a.materials.size() != b.materials.size()) {
    lines.push_back(fmt::format("materials: {}, then {}", a.materials.size(), b.materials.size()));
  }
  for (std::size_t m = 0; m < std::min(a.materials.size(), b.materials.size()); ++m) {
    const std::string name = fmt::format("material {}", m);
    if (a.materials[m].name != b.materials[m].name) {
      lines.push_back(
          fmt::format("{}: name '{}', then '{}'", name, a.materials[m].name, b.materials[m].name));
    }
    diff_record(name, a.materials[m], b.materials[m], tolerance, lines);
  }
  if (a.textures.size() != b.textures.size()) {
    lines.push_back(fmt::format("textures: {}, then {}", a.textures.size(), b.textures.size()));
  }
  for (std::size_t t = 0; t < std::min(a.textures.size(), b.textures.size()); ++t) {
    if (a.textures[t] == b.textures[t]) continue;
    lines.push_back(fmt::format("texture {}: '{}' of {} embedded, then '{}' of {}", t, a.textures[t].uri,
                                bytes_text(a.textures[t].bytes.size()), b.textures[t].uri,
                                bytes_text(b.textures[t].bytes.size())));
  }
  if (a.trunk.material != b.trunk.material) lines.push_back("material of the trunk differs");
  if (a.leaves.material != b.leaves.material) lines.push_back("material of the leaves differs");
}

void note_storage(const Container& a, const Container& b, std::vector<std::string>& notes) {
  for (const SectionInfo& first : a.sections()) {
    const SectionInfo* second = b.find(first.name);
    if (second == nullptr || (first.encoding == second->encoding && first.stored_size == second->stored_size))
      continue;
    notes.push_back(fmt::format("{}: stored {} in {}, then {} in {}", first.name,
                                encoding_name(first.encoding), bytes_text(first.stored_size),
                                encoding_name(second->encoding), bytes_text(second->stored_size)));
  }
  if (a.size() != b.size())
    notes.push_back(fmt::format("the files have {} and {}", bytes_text(a.size()), bytes_text(b.size())));
}

}  // namespace

Result<Difference> diff_files(const TreeFile& a, const TreeFile& b, double tolerance) {
  const auto tree_a = a.load();
  if (!tree_a) return std::unexpected(tree_a.error());
  const auto tree_b = b.load();
  if (!tree_b) return std::unexpected(tree_b.error());
  Difference difference;
  if (a.header().kind != b.header().kind) {
    difference.lines.push_back(a.header().kind == TreeKind::still ? "kind: .tree, then .stree"
                                                                  : "kind: .stree, then .tree");
  }
  diff_record("header", a.header(), b.header(), tolerance, difference.lines);
  diff_materials(*tree_a, *tree_b, tolerance, difference.lines);
  if (a.omitted() != b.omitted()) difference.lines.push_back("different sections were left out on purpose");
  // Volumes, levels of detail and whatever else tools have added have no fields here: their bytes count.
  std::vector<std::string_view> compared = diff_arrays(a, *tree_a, b, *tree_b, tolerance, difference.lines);
  compared.insert(compared.end(), std::begin(k_records), std::end(k_records));
  auto others = diff_sections(a.container(), b.container(), compared);
  if (!others) return std::unexpected(others.error());
  difference.lines.insert(difference.lines.end(), others->begin(), others->end());
  if (tree_a->provenance != tree_b->provenance) difference.notes.push_back("provenance differs");
  note_storage(a.container(), b.container(), difference.notes);
  return difference;
}

Result<Difference> diff_containers(const Container& a, const Container& b) {
  constexpr std::array<std::string_view, 1> k_told_as_note{"PROV"};
  Difference difference;
  auto lines = diff_sections(a, b, k_told_as_note);
  if (!lines) return std::unexpected(lines.error());
  difference.lines = std::move(*lines);
  note_storage(a, b, difference.notes);
  return difference;
}

}  // namespace copse
