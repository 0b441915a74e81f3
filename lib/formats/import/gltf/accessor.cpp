#include "lib/formats/import/gltf/accessor.h"

#include "lib/formats/import/text.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace copse {
namespace {

std::uint32_t component_size(std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

std::uint32_t component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4" || type == "MAT2") return 4;
  if (type == "MAT3") return 9;
  return type == "MAT4" ? 16 : 0;
}

// Columns of MAT2 and MAT3 of small components start at multiples of 4 bytes; no attribute read here is one.
bool is_padded(const std::string& type, std::uint32_t size) {
  return (type == "MAT2" && size == 1) || (type == "MAT3" && size < 4);
}

template <class Component>
Component load(const std::uint8_t* p) {
  Component value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

template <class Component, class Number>
Number convert(Component value, bool normalized) {
  if constexpr (std::is_integral_v<Component>) {
    if (normalized) {
      const double fraction = static_cast<double>(value) / std::numeric_limits<Component>::max();
      return static_cast<Number>(std::max(fraction, -1.0));
    }
  }
  return static_cast<Number>(value);
}

template <class Component, class Number>
void read_as(const GltfAccessor& a, std::uint32_t components, std::span<Number> out) {
  const auto element = [&](const std::uint8_t* from, Number* to) {
    for (std::uint32_t c = 0; c < components; ++c)
      to[c] = convert<Component, Number>(load<Component>(from + c * sizeof(Component)), a.normalized);
  };
  if (a.data == nullptr) {
    std::fill(out.begin(), out.end(), Number{0});
  } else {
    for (std::uint64_t i = 0; i < a.count; ++i) element(a.data + i * a.stride, out.data() + i * components);
  }
  for (std::uint64_t i = 0; i < a.sparse_count; ++i) {
    std::uint64_t at = 0;
    if (a.sparse_index_type == 5121) at = a.sparse_indices[i];
    if (a.sparse_index_type == 5123) at = load<std::uint16_t>(a.sparse_indices + i * 2);
    if (a.sparse_index_type == 5125) at = load<std::uint32_t>(a.sparse_indices + i * 4);
    if (at < a.count)
      element(a.sparse_values + i * a.components * sizeof(Component), out.data() + at * components);
  }
}

template <class Number>
void read_any(const GltfAccessor& a, std::uint32_t components, std::span<Number> out) {
  switch (a.component_type) {
    case 5120:
      return read_as<std::int8_t>(a, components, out);
    case 5121:
      return read_as<std::uint8_t>(a, components, out);
    case 5122:
      return read_as<std::int16_t>(a, components, out);
    case 5123:
      return read_as<std::uint16_t>(a, components, out);
    case 5125:
      return read_as<std::uint32_t>(a, components, out);
    default:
      return read_as<float>(a, components, out);
  }
}

class Opener {
 public:
  Opener(GltfDocument& document, GltfAccessor& out)
      : document_(document), builder_(document.builder()), out_(out) {}

  bool open(const JsonValue& json, bool count_only) {
    out_ = {};
    out_.path = json.path();
    std::uint64_t component_type = 0;
    std::string type;
    if (!json["count"].read(out_.count, builder_) || !json["componentType"].read(component_type, builder_) ||
        !json["type"].read(type, builder_) || !json["normalized"].read(out_.normalized, builder_))
      return false;
    const std::uint32_t size = component_size(component_type);
    out_.components = component_count(type);
    if (size == 0 || out_.components == 0 || is_padded(type, size))
      return refuse(fmt::format("{} of component type {} cannot be read", in_quotes(type), component_type));
    out_.component_type = static_cast<std::uint32_t>(component_type);
    if (out_.count > std::numeric_limits<std::uint32_t>::max() - 1)
      return refuse(fmt::format("has {} elements", out_.count));
    return count_only || (base(json, size) && sparse(json["sparse"], size));
  }

 private:
  bool refuse(const std::string& what) {
    return builder_.refuse(fmt::format("{}: {}", out_.path, what), k_gltf_remedy);
  }

  // The bytes of `count` elements that lie `stride` apart, from `offset` of a view.
  bool locate(const JsonValue& json, std::uint64_t count, std::uint64_t element, std::uint64_t& stride,
              const std::uint8_t*& data) {
    std::uint32_t view_index = k_none;
    std::uint64_t offset = 0;
    GltfDocument::View view;
    if (!json["bufferView"].read_index(view_index, document_.root()["bufferViews"].size(), builder_) ||
        !json["byteOffset"].read(offset, builder_))
      return false;
    if (view_index == k_none) return true;
    if (!document_.view(view_index, view)) return false;
    if (stride == 0) stride = view.stride == 0 ? element : view.stride;
    if (stride < element) return refuse(fmt::format("elements of {} bytes lie {} apart", element, stride));
    // count < 2^32, and a stride beyond the view is refused before it is multiplied.
    const bool good =
        count == 0 ||
        (fits(offset, element, view.bytes.size()) && (stride <= view.bytes.size() || count == 1) &&
         fits(offset, (count - 1) * (count == 1 ? 0 : stride) + element, view.bytes.size()));
    if (!good)
      return refuse(fmt::format("{} elements from byte {} reach beyond bufferViews[{}] of {} bytes", count,
                                offset, view_index, view.bytes.size()));
    data = view.bytes.data() + (count == 0 ? 0 : offset);
    return true;
  }

  bool base(const JsonValue& json, std::uint32_t size) {
    if (!locate(json, out_.count, std::uint64_t{size} * out_.components, out_.stride, out_.data))
      return false;
    if (out_.data == nullptr && out_.count > std::max(k_zero_accessor_floor, document_.stored_bytes()))
      return refuse(fmt::format("{} elements without a buffer view", out_.count));
    return true;
  }

  bool sparse(const JsonValue& json, std::uint32_t size) {
    if (!json.exists()) return true;
    std::uint64_t index_type = 0;
    const JsonValue indices = json["indices"], values = json["values"];
    if (!json["count"].read(out_.sparse_count, builder_) ||
        !indices["componentType"].read(index_type, builder_))
      return false;
    if (index_type != 5121 && index_type != 5123 && index_type != 5125)
      return refuse(fmt::format("sparse indices of component type {}", index_type));
    if (out_.sparse_count > out_.count)
      return refuse(fmt::format("{} sparse elements of {}", out_.sparse_count, out_.count));
    out_.sparse_index_type = static_cast<std::uint32_t>(index_type);
    std::uint64_t index_stride = component_size(index_type);
    std::uint64_t value_stride = std::uint64_t{size} * out_.components;
    if (!locate(indices, out_.sparse_count, index_stride, index_stride, out_.sparse_indices) ||
        !locate(values, out_.sparse_count, value_stride, value_stride, out_.sparse_values))
      return false;
    if (out_.sparse_count > 0 && (out_.sparse_indices == nullptr || out_.sparse_values == nullptr))
      return refuse("its sparse elements have no buffer view");
    return true;
  }

  GltfDocument& document_;
  MeshBuilder& builder_;
  GltfAccessor& out_;
};

}  // namespace

bool open_accessor(GltfDocument& document, std::uint32_t index, GltfAccessor& out, bool count_only) {
  return Opener(document, out).open(document.root()["accessors"].at(index), count_only);
}

void read_numbers(const GltfAccessor& accessor, std::uint32_t components, std::span<double> out) {
  read_any(accessor, components, out);
}

void read_numbers(const GltfAccessor& accessor, std::uint32_t components, std::span<float> out) {
  read_any(accessor, components, out);
}

bool read_indices(GltfDocument& document, const GltfAccessor& a, std::vector<std::uint32_t>& out) {
  const bool is_unsigned = a.component_type == 5121 || a.component_type == 5123 || a.component_type == 5125;
  if (!is_unsigned || a.components != 1)
    return document.builder().refuse(a.path + " holds no indices: they are unsigned scalars", k_gltf_remedy);
  out.resize(a.count);
  if (a.sparse_count == 0 && a.data != nullptr) {
    for (std::uint64_t i = 0; i < a.count; ++i) {
      const std::uint8_t* p = a.data + i * a.stride;
      out[i] = a.component_type == 5121   ? *p
               : a.component_type == 5123 ? load<std::uint16_t>(p)
                                          : load<std::uint32_t>(p);
    }
    return true;
  }
  std::vector<double> numbers(a.count);
  read_numbers(a, 1, numbers);
  std::transform(numbers.begin(), numbers.end(), out.begin(),
                 [](double v) { return static_cast<std::uint32_t>(v); });
  return true;
}

}  // namespace copse
