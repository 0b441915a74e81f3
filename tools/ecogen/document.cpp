#include "tools/ecogen/document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse::ecogen {
namespace {

using Step = std::variant<std::string, std::size_t>;

std::optional<std::vector<Step>> steps_of(std::string_view path) {
  std::vector<Step> steps;
  while (!path.empty()) {
    if (path.front() == '[') {
      const std::size_t end = path.find(']');
      std::size_t index = 0;
      if (end == std::string_view::npos) return std::nullopt;
      const auto [rest, error] = std::from_chars(path.data() + 1, path.data() + end, index);
      if (error != std::errc{} || rest != path.data() + end) return std::nullopt;
      steps.emplace_back(index);
      path.remove_prefix(end + 1);
    } else {
      const std::size_t end = std::min(path.find_first_of(".["), path.size());
      if (end == 0) return std::nullopt;
      steps.emplace_back(std::string(path.substr(0, end)));
      path.remove_prefix(end);
    }
    if (!path.empty() && path.front() == '.') {
      path.remove_prefix(1);
      if (path.empty() || path.front() == '[') return std::nullopt;
    }
  }
  if (steps.empty()) return std::nullopt;
  return steps;
}

std::string text_of(const Step& step, bool first) {
  if (const auto* key = std::get_if<std::string>(&step)) return first ? *key : "." + *key;
  return fmt::format("[{}]", std::get<std::size_t>(step));
}

// What the step leads to, null when that does not exist; the last step of an edit may make a key.
Json* follow(Json& from, const Step& step, bool may_make) {
  if (const auto* key = std::get_if<std::string>(&step)) {
    if (!from.is_object() || (!may_make && !from.contains(*key))) return nullptr;
    return &from[*key];
  }
  const std::size_t index = std::get<std::size_t>(step);
  return from.is_array() && index < from.size() ? &from[index] : nullptr;
}

}  // namespace

Result<void> edit(Json& document, const std::string& assignment) {
  const std::size_t equal = assignment.find('=');
  const auto usage = [&](const std::string& what) {
    return fail(Fault::usage, "", fmt::format("--edit '{}': {}", assignment, what),
                "write PATH=VALUE, such as types[0].count=500");
  };
  if (equal == std::string::npos) return usage("there is no '='");
  const auto steps = steps_of(std::string_view(assignment).substr(0, equal));
  if (!steps) return usage("this is no path");
  const std::string value = assignment.substr(equal + 1);
  Json* at = &document;
  std::string path;
  for (std::size_t i = 0; i < steps->size(); ++i) {
    const bool last = i + 1 == steps->size(), before_last = i + 2 == steps->size();
    const bool in_object = at->is_object();
    path += text_of((*steps)[i], i == 0);
    at = follow(*at, (*steps)[i], last);
    const auto* key = last ? nullptr : std::get_if<std::string>(&(*steps)[i + 1]);
    if (before_last && key && ((!at && in_object) || (at && !at->is_structured())))
      return fail(
          Fault::usage, "",
          fmt::format("--edit '{}': {} is {}", assignment, path, at ? "no object" : "not in the file"),
          fmt::format("set it with all that it needs: --edit '{}={{\"{}\": {}, ...}}'", path, *key, value));
    if (!at) return usage("there is nothing of this path in the file");
  }
  JsonFaults faults;
  try {
    *at = parse_json(value, faults);
  } catch (const nlohmann::json::exception&) {
    *at = value;
  }
  if (faults.deep) return usage(fmt::format("its value is nested more than {} levels deep", k_json_levels));
  if (!faults.twice.empty())
    return usage(fmt::format("the key '{}' stands twice in one object", faults.twice));
  return {};
}

void make_whole(Json& document) {
  std::vector<Json*> open{&document};
  while (!open.empty()) {
    Json& at = *open.back();
    open.pop_back();
    if (at.is_structured())
      for (Json& inside : at) open.push_back(&inside);
    if (!at.is_number_float()) continue;
    const auto v = at.get<double>();
    if (v != std::trunc(v) || std::abs(v) > 0x1p53) continue;
    if (v < 0)
      at = static_cast<std::int64_t>(v);
    else
      at = static_cast<std::uint64_t>(v);
  }
}

}  // namespace copse::ecogen
