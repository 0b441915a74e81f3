#include "lib/formats/import/gltf/json.h"

#include "lib/formats/import/text.h"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse {
namespace {

using Json = nlohmann::json;

const Json* as_json(const void* value) {
  return static_cast<const Json*>(value);
}

constexpr const char* k_remedy = "export the mesh again, or check it with the glTF validator";

// Whether brackets nest no deeper than k_json_depth. The parser does not recurse, but who uses its result
// might.
bool is_shallow(std::string_view text) {
  std::uint32_t depth = 0;
  bool inside = false;  // a string
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inside) {
      if (c == '\\') ++i;
      if (c == '"') inside = false;
    } else if (c == '"') {
      inside = true;
    } else if (c == '{' || c == '[') {
      if (++depth > k_json_depth) return false;
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return true;
}

}  // namespace

struct JsonText::Impl {
  Json root;
};

JsonText::JsonText() : impl_(std::make_unique<Impl>()) {}
JsonText::~JsonText() = default;

bool JsonText::parse(std::string_view text, MeshBuilder& builder) {
  if (!is_shallow(text))
    return builder.refuse(fmt::format("its JSON nests deeper than {} levels", k_json_depth), k_remedy);
  try {
    impl_->root = Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& e) {
    return builder.refuse(fmt::format("byte {} of its JSON is wrong", e.byte), k_remedy);
  } catch (const Json::exception& e) {
    return builder.refuse(fmt::format("its JSON cannot be read: {}", e.what()), k_remedy);
  }
  if (!impl_->root.is_object()) return builder.refuse("its JSON is no object", k_remedy);
  return true;
}

JsonValue JsonText::root() const {
  return {&impl_->root, ""};
}

bool JsonValue::is_object() const {
  return exists() && as_json(value_)->is_object();
}

bool JsonValue::is_array() const {
  return exists() && as_json(value_)->is_array();
}

JsonValue JsonValue::operator[](const char* key) const {
  std::string path = path_.empty() ? key : path_ + "." + key;
  if (!is_object()) return {nullptr, std::move(path)};
  const auto it = as_json(value_)->find(key);
  return {it == as_json(value_)->end() ? nullptr : &*it, std::move(path)};
}

std::size_t JsonValue::size() const {
  return is_array() ? as_json(value_)->size() : 0;
}

JsonValue JsonValue::at(std::size_t index) const {
  std::string path = fmt::format("{}[{}]", path_, index);
  return {index < size() ? &(*as_json(value_))[index] : nullptr, std::move(path)};
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::members() const {
  std::vector<std::pair<std::string, JsonValue>> out;
  if (!is_object()) return out;
  for (const auto& [key, value] : as_json(value_)->items())
    out.emplace_back(key, JsonValue(&value, path_ + "." + key));
  return out;
}

bool JsonValue::wrong(const char* expected, MeshBuilder& builder) const {
  return builder.refuse(fmt::format("{} is not {}", path_, expected), k_remedy);
}

bool JsonValue::read(std::string& out, MeshBuilder& builder) const {
  if (!exists()) return true;
  if (!as_json(value_)->is_string()) return wrong("a text", builder);
  out = as_json(value_)->get_ref<const std::string&>();
  return true;
}

bool JsonValue::read(bool& out, MeshBuilder& builder) const {
  if (!exists()) return true;
  if (!as_json(value_)->is_boolean()) return wrong("true or false", builder);
  out = as_json(value_)->get<bool>();
  return true;
}

bool JsonValue::read(double& out, MeshBuilder& builder) const {
  if (!exists()) return true;
  if (!as_json(value_)->is_number()) return wrong("a number", builder);
  const double value = as_json(value_)->get<double>();
  if (!std::isfinite(value)) return wrong("finite", builder);
  out = value;
  return true;
}

bool JsonValue::read(float& out, MeshBuilder& builder) const {
  double value = out;
  if (!read(value, builder)) return false;
  if (std::abs(value) > std::numeric_limits<float>::max()) return wrong("finite", builder);
  out = static_cast<float>(value);
  return true;
}

bool JsonValue::read(std::uint64_t& out, MeshBuilder& builder) const {
  if (!exists()) return true;
  const Json& value = *as_json(value_);
  if (value.is_number_unsigned()) {
    out = value.get<std::uint64_t>();
    return true;
  }
  // Some writers print whole numbers as 12.0.
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number >= 0 && number <= 9007199254740992.0 && number == std::floor(number)) {
      out = static_cast<std::uint64_t>(number);
      return true;
    }
  }
  return wrong("a whole number from 0 up", builder);
}

bool JsonValue::read(std::span<double> out, MeshBuilder& builder) const {
  if (!exists()) return true;
  if (!is_array() || size() != out.size())
    return wrong(fmt::format("an array of {} numbers", out.size()).c_str(), builder);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!at(i).read(out[i], builder)) return false;
  }
  return true;
}

bool JsonValue::read_index(std::uint32_t& out, std::size_t count, MeshBuilder& builder) const {
  if (!exists()) return true;
  std::uint64_t value = 0;
  if (!read(value, builder)) return false;
  if (value >= count || value >= k_none)
    return builder.refuse(fmt::format("{} is {}, but there are only {}", path_, value, count), k_remedy);
  out = static_cast<std::uint32_t>(value);
  return true;
}

std::string JsonValue::text() const {
  return exists() && as_json(value_)->is_string() ? as_json(value_)->get<std::string>() : std::string();
}

}  // namespace copse
