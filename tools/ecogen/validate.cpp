// The document against the schema, by valijson; this file words what it finds.
#include "tools/common/command_line.h"
#include "tools/ecogen/document.h"
#include "tools/ecogen/texts.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace copse::ecogen {
namespace {

using Plain = nlohmann::json;  // what valijson's adapter takes

const Plain& schema_json() {
  static const Plain json = Plain::parse(k_schema);
  return json;
}

const Plain& resolved(const Plain& schema) {
  const Plain* at = &schema;
  while (at->contains("$ref"))
    at = &schema_json().at(Plain::json_pointer(at->at("$ref").get<std::string>().substr(1)));
  return *at;
}

// A place in the document as a user writes it, and what is there.
struct Place {
  std::string path;  // empty: the document itself
  const Plain* value = nullptr;
  const Plain* schema = nullptr;  // null when the schema knows nothing of it

  std::string text() const { return path.empty() ? "the document" : path; }
  Place member(const std::string& key, const Plain* inside) const {
    return {path.empty() ? key : path + "." + key, &value->at(key), inside};
  }
  Place element(std::size_t i, const Plain* inside) const {
    return {fmt::format("{}[{}]", path, i), &value->at(i), inside};
  }
};

bool is_of_type(const Plain& value, const std::string& type) {
  return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
         (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
         (type == "number" && value.is_number()) || (type == "integer" && value.is_number_integer());
}

// The branch of a oneOf that the value was probably meant for: of its kind.
const Plain& branch_for(const Plain& schema, const Plain& value) {
  const Plain& s = resolved(schema);
  if (!s.contains("oneOf")) return s;
  for (const Plain& branch : s["oneOf"]) {
    const Plain& b = resolved(branch);
    if (b.contains("type") && is_of_type(value, b["type"].get<std::string>())) return b;
    if (b.contains("enum") && value.is_string()) return b;
  }
  return s;
}

// What the schema knows of a step from here, null when nothing.
const Plain* inside(const Plain* schema, const Plain& value, const std::string* key) {
  if (!schema) return nullptr;
  const Plain& s = branch_for(*schema, value);
  if (key)
    return s.contains("properties") && s["properties"].contains(*key) ? &s["properties"][*key] : nullptr;
  return s.contains("items") ? &s["items"] : nullptr;
}

std::string number_text(const Plain& n) {
  return n.is_number_integer() ? n.dump() : fmt::format("{}", n.get<double>());
}

std::string range_text(const Plain& s) {
  if (s.contains("exclusiveMinimum"))
    return fmt::format(" above {}, at most {}", number_text(s["exclusiveMinimum"]),
                       number_text(s["maximum"]));
  if (s.contains("minimum") && s.contains("maximum"))
    return fmt::format(" from {} to {}", number_text(s["minimum"]), number_text(s["maximum"]));
  if (s.contains("minimum")) return fmt::format(" of at least {}", number_text(s["minimum"]));
  return "";
}

std::string length_text(const Plain& s, const char* least, const char* most, const char* noun) {
  if (s.contains(least) && s.contains(most) && s[least] == s[most])
    return fmt::format(" of {} {}", number_text(s[least]), noun);
  if (s.contains(least) && s.contains(most))
    return fmt::format(" of {} to {} {}", number_text(s[least]), number_text(s[most]), noun);
  if (s.contains(most)) return fmt::format(" of at most {} {}", number_text(s[most]), noun);
  return "";
}

std::vector<std::string> known_keys(const Plain& s) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : s.at("properties").items()) keys.push_back(key);
  return keys;
}

std::string allowed(const Plain& schema) {
  const Plain& s = resolved(schema);
  if (s.contains("oneOf")) {
    std::vector<std::string> options;
    for (const Plain& branch : s["oneOf"]) options.push_back(allowed(branch));
    return fmt::format("{}", fmt::join(options, ", or "));
  }
  if (s.contains("enum")) {
    std::vector<std::string> values;
    for (const Plain& v : s["enum"]) values.push_back(v.dump());
    return fmt::format("{}", fmt::join(values, ", "));
  }
  const std::string type = s.value("type", "anything");
  if (type == "number") return fmt::format("a number{}", range_text(s));
  if (type == "integer") return fmt::format("a whole number{}", range_text(s));
  if (type == "string")
    return fmt::format("a text{}", length_text(s, "minLength", "maxLength", "characters"));
  if (type == "boolean") return "true or false";
  if (type == "array")
    return fmt::format("a list{}{}", length_text(s, "minItems", "maxItems", "elements"),
                       s.value("uniqueItems", false) ? ", none of them twice" : "");
  if (type == "object") return fmt::format("an object with {}", fmt::join(known_keys(s), ", "));
  return type;
}

std::string shown(const Plain& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  const std::string text = value.dump(-1, ' ', true, Plain::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

std::unexpected<Error> unknown_key(const Place& at, const std::string& key,
                                   const std::vector<std::string>& known, const std::string& file) {
  const std::string nearest = nearest_name(key, known);
  return refuse(file, fmt::format("{}: '{}' is unknown here", at.text(), key),
                nearest.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                                : fmt::format("did you mean '{}'?", nearest));
}

// Unknown and missing keys, which the schema forbids, with the names that a user needs. Depth is bounded by
// the parser.
Result<void> check_keys(const Place& at, const std::string& file) {
  if (!at.schema) return {};
  if (at.value->is_array()) {
    for (std::size_t i = 0; i < at.value->size(); ++i)
      if (auto good = check_keys(at.element(i, inside(at.schema, *at.value, nullptr)), file); !good)
        return good;
    return {};
  }
  if (!at.value->is_object()) return {};
  const Plain& s = branch_for(*at.schema, *at.value);
  if (!s.contains("properties")) return {};
  for (const auto& [key, value] : at.value->items()) {
    if (!s["properties"].contains(key)) return unknown_key(at, key, known_keys(s), file);
    if (auto good = check_keys(at.member(key, &s["properties"][key]), file); !good) return good;
  }
  for (const Plain& required : s.value("required", Plain::array()))
    if (!at.value->contains(required.get<std::string>()))
      return refuse(file, fmt::format("{}: '{}' is missing", at.text(), required.get<std::string>()),
                    fmt::format("give it {}", allowed(s["properties"][required.get<std::string>()])));
  return {};
}

// valijson's context, "<root>", "[types]", "[2]", "[scale]", as a place.
Place place_of(const std::vector<std::string>& context, const Plain& document) {
  Place at{"", &document, &schema_json()};
  for (std::size_t i = 1; i < context.size(); ++i) {
    const std::string key = context[i].substr(1, context[i].size() - 2);
    if (at.value->is_array()) {
      at = at.element(std::stoul(key), inside(at.schema, *at.value, nullptr));
    } else if (at.value->is_object() && at.value->contains(key)) {
      at = at.member(key, inside(at.schema, *at.value, &key));
    } else {
      break;
    }
  }
  return at;
}

const valijson::Schema& compiled_schema() {
  static const std::unique_ptr<valijson::Schema> compiled = [] {
    auto schema = std::make_unique<valijson::Schema>();
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    const valijson::adapters::NlohmannJsonAdapter adapter(schema_json());
    parser.populateSchema(adapter, *schema);
    return schema;
  }();
  return *compiled;
}

// The document as valijson can take it: it reads whole numbers as signed ones, so those above all of them,
// which a seed may be, become the largest of these. No other limit of the schema lies there.
Plain within_signed(Plain document) {
  constexpr auto k_most = std::numeric_limits<std::int64_t>::max();
  std::vector<Plain*> open{&document};
  while (!open.empty()) {
    Plain& at = *open.back();
    open.pop_back();
    if (at.is_structured())
      for (Plain& inside : at) open.push_back(&inside);
    else if (at.is_number_unsigned() && at.get<std::uint64_t>() > std::uint64_t{k_most})
      at = k_most;
  }
  return document;
}

}  // namespace

Result<void> validate(const Json& document, const std::string& file) {
  const Plain plain = document;
  if (auto good = check_keys({"", &plain, &schema_json()}, file); !good) return good;
  valijson::Validator validator;
  valijson::ValidationResults results;
  const Plain readable = within_signed(plain);
  const valijson::adapters::NlohmannJsonAdapter adapter(readable);
  if (validator.validate(compiled_schema(), adapter, &results)) return {};
  // The deepest place says most; of several as deep the first.
  valijson::ValidationResults::Error error, deepest;
  while (results.popError(error))
    if (error.context.size() > deepest.context.size()) deepest = error;
  const Place at = place_of(deepest.context, plain);
  return refuse(file, fmt::format("{}: {} is not allowed here", at.text(), shown(*at.value)),
                at.schema ? fmt::format("give it {}", allowed(*at.schema)) : deepest.description);
}

}  // namespace copse::ecogen
