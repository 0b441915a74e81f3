#include "lib/formats/levels/spectrum_codec.h"

#include "lib/formats/levels/spectrum_leaves.h"
#include "lib/formats/levels/spectrum_trunk.h"
#include "lib/formats/little_endian.h"
#include "lib/formats/packing/octahedral.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <meshoptimizer.h>
#include <zstd.h>

namespace copse::spectrum_codec {
namespace {

// method, coding, vertices, elements, triangles, states; then 8 f32 (box and texture range), bits; then
// streams.
constexpr std::size_t k_header = 24, k_ranges = 44, k_streams = 4;
constexpr int k_zstd_small = 19;  // small files are written once and read often

using Bytes = std::vector<std::uint8_t>;
using Text = std::string;

struct PackedVertex {
  std::uint16_t position[3];
  std::int8_t normal[2];  // octahedral
  std::uint16_t texcoord[2];
};
static_assert(sizeof(PackedVertex) == 12);

struct Ranges {
  Float3 min, max;
  Float2 low, high;
  std::uint8_t position_bits = 16, texcoord_bits = 16;

  double step() const {
    const double side = std::max({double{max.x} - min.x, double{max.y} - min.y, double{max.z} - min.z});
    return side / static_cast<double>((1u << position_bits) - 1);
  }
  double step(int axis) const {
    const double side = axis == 0 ? double{high.x} - low.x : double{high.y} - low.y;
    return side / static_cast<double>((1u << texcoord_bits) - 1);
  }
};

Ranges ranges_of(const Spectrum& s, const SpectrumCodingOptions& options) {
  Ranges r;
  r.position_bits = static_cast<std::uint8_t>(std::clamp(options.position_bits, 8, 16));
  r.texcoord_bits = static_cast<std::uint8_t>(std::clamp(options.texcoord_bits, 8, 16));
  FloatBox box;
  for (const SpectrumVertex& v : s.vertices) box.grow(v.position);
  if (!box.empty()) r.min = box.min, r.max = box.max;
  if (!s.vertices.empty()) r.low = r.high = s.vertices[0].texcoord;
  for (const SpectrumVertex& v : s.vertices) {
    r.low = {std::min(r.low.x, v.texcoord.x), std::min(r.low.y, v.texcoord.y)};
    r.high = {std::max(r.high.x, v.texcoord.x), std::max(r.high.y, v.texcoord.y)};
  }
  return r;
}

std::uint16_t quantised(double value, double low, double step) {
  return step > 0 ? static_cast<std::uint16_t>(std::lround(std::clamp((value - low) / step, 0.0, 65535.0)))
                  : 0;
}

PackedVertex packed(const SpectrumVertex& v, const Ranges& r) {
  PackedVertex p{};
  for (int c = 0; c < 3; ++c) p.position[c] = quantised(v.position[c], r.min[c], r.step());
  const Octahedral normal = to_octahedral(to_double(v.normal));
  for (int c = 0; c < 2; ++c) p.normal[c] = static_cast<std::int8_t>(normal[c]);
  p.texcoord[0] = quantised(v.texcoord.x, r.low.x, r.step(0));
  p.texcoord[1] = quantised(v.texcoord.y, r.low.y, r.step(1));
  return p;
}

SpectrumVertex unpacked(const PackedVertex& p, const Ranges& r) {
  SpectrumVertex v;
  for (int c = 0; c < 3; ++c) v.position[c] = static_cast<float>(r.min[c] + p.position[c] * r.step());
  v.normal = from_octahedral({p.normal[0], p.normal[1]});
  v.texcoord = {static_cast<float>(r.low.x + p.texcoord[0] * r.step(0)),
                static_cast<float>(r.low.y + p.texcoord[1] * r.step(1))};
  return v;
}

void put_varint(Bytes& out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) out.push_back(static_cast<std::uint8_t>(value | 0x80));
  out.push_back(static_cast<std::uint8_t>(value));
}
std::uint64_t zigzag(std::int64_t v) {
  return (static_cast<std::uint64_t>(v) << 1) ^ static_cast<std::uint64_t>(v >> 63);
}

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64 && at_ < bytes_.size(); shift += 7) {
      const std::uint8_t b = bytes_[at_++];
      value |= static_cast<std::uint64_t>(b & 0x7f) << shift;
      if (b < 0x80) return value;
    }
    failed_ = true;
    return 0;
  }
  std::int64_t signed_varint() {
    const std::uint64_t v = varint();
    return static_cast<std::int64_t>(v >> 1) ^ -static_cast<std::int64_t>(v & 1);
  }
  bool done() const { return !failed_ && at_ == bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

// Elements as differences: death and birth column by column, then what they hang on.
Bytes pack_elements(const Spectrum& s) {
  Bytes out;
  const std::uint32_t states = static_cast<std::uint32_t>(s.errors.size());
  std::int64_t before = states;
  for (const SpectrumElement& e : s.elements) {
    const std::int64_t death = e.death == k_none ? states : e.death;
    put_varint(out, static_cast<std::uint64_t>(before - death));
    before = death;
  }
  before = 0;
  for (const SpectrumElement& e : s.elements)
    put_varint(out, zigzag(std::int64_t{e.birth} - before)), before = e.birth;
  before = 0;
  for (const SpectrumElement& e : s.elements)
    put_varint(out, zigzag(std::int64_t{e.material + 1} - before)), before = e.material + 1;
  before = 0;
  for (const SpectrumElement& e : s.elements)
    put_varint(out, zigzag(std::int64_t{e.radius + 1} - before)), before = e.radius + 1;
  for (std::size_t e = 0; e < s.elements.size(); ++e)
    put_varint(out, s.first_triangle[e + 1] - s.first_triangle[e]);
  return out;
}

bool unpack_elements(std::span<const std::uint8_t> bytes, std::size_t states,
                     std::vector<SpectrumElement>& elements, std::vector<std::uint32_t>& first) {
  Reader in(bytes);
  std::int64_t value = static_cast<std::int64_t>(states);
  for (SpectrumElement& e : elements) {
    value -= static_cast<std::int64_t>(in.varint() & 0xffffffffu);
    if (value < 0) return false;
    e.death = value == static_cast<std::int64_t>(states) ? k_none : static_cast<std::uint32_t>(value);
  }
  const auto column = [&](std::uint32_t SpectrumElement::*field, std::int64_t offset) {
    value = 0;
    for (SpectrumElement& e : elements) {
      value = static_cast<std::int64_t>(static_cast<std::uint64_t>(value) +
                                        static_cast<std::uint64_t>(in.signed_varint()));
      if (value < 0 || value > 0xffffffffll) return false;
      e.*field = static_cast<std::uint32_t>(value - offset);
    }
    return true;
  };
  if (!column(&SpectrumElement::birth, 0) || !column(&SpectrumElement::material, 1) ||
      !column(&SpectrumElement::radius, 1))
    return false;
  std::uint64_t at = 0;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    at += in.varint() & 0xffffffffu;
    if (at > 0xffffffffu) return false;
    first[e + 1] = static_cast<std::uint32_t>(at);
  }
  return in.done();
}

// Errors never shrink and are not negative, so their bits grow too.
Bytes pack_errors(const Spectrum& s) {
  Bytes out;
  std::uint32_t before = 0;
  for (const float e : s.errors) {
    const auto bits = std::bit_cast<std::uint32_t>(e);
    put_varint(out, bits - before);
    before = bits;
  }
  return out;
}

Bytes compressed(const Bytes& bytes) {
  Bytes out(ZSTD_compressBound(bytes.size()));
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), k_zstd_small));
  return out;
}

void add_stream(Bytes& out, const Bytes& bytes) {
  const Bytes small = compressed(bytes);
  const std::size_t at = out.size();
  out.resize(at + 8);
  put(std::span<std::uint8_t>(out), at, static_cast<std::uint32_t>(small.size()));
  put(std::span<std::uint8_t>(out), at + 4, static_cast<std::uint32_t>(bytes.size()));
  out.insert(out.end(), small.begin(), small.end());
}

template <class T>
void add_array(Bytes& out, const Array<T>& array) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(array.data());
  out.insert(out.end(), bytes, bytes + array.size() * sizeof(T));
}

Bytes header_of(const Spectrum& s, SpectrumCoding coding) {
  Bytes out(k_header);
  const std::span<std::uint8_t> bytes(out);
  put(bytes, 0, static_cast<std::uint32_t>(s.method)), put(bytes, 4, static_cast<std::uint32_t>(coding));
  put(bytes, 8, static_cast<std::uint32_t>(s.vertices.size())),
      put(bytes, 12, static_cast<std::uint32_t>(s.elements.size()));
  put(bytes, 16, static_cast<std::uint32_t>(s.triangles.size())),
      put(bytes, 20, static_cast<std::uint32_t>(s.errors.size()));
  return out;
}

Result<EncodedSpectrum> encode_small(const Spectrum& s, const SpectrumCodingOptions& options) {
  EncodedSpectrum out{.bytes = header_of(s, SpectrumCoding::small)};
  const Ranges r = ranges_of(s, options);
  const std::size_t at = out.bytes.size();
  out.bytes.resize(at + k_ranges);
  const std::span<std::uint8_t> bytes(out.bytes);
  put(bytes, at, r.min), put(bytes, at + 12, r.max), put(bytes, at + 24, r.low), put(bytes, at + 32, r.high);
  put(bytes, at + 40, r.position_bits), put(bytes, at + 41, r.texcoord_bits);
  std::vector<PackedVertex> vertices;
  for (const SpectrumVertex& v : s.vertices) {
    vertices.push_back(packed(v, r));
    const Double3 off = to_double(unpacked(vertices.back(), r).position) - to_double(v.position);
    out.position_error = std::max(out.position_error, length(off));
  }
  Bytes coded(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(PackedVertex)));
  coded.resize(meshopt_encodeVertexBuffer(coded.data(), coded.size(), vertices.data(), vertices.size(),
                                          sizeof(PackedVertex)));
  add_stream(out.bytes, coded);
  Bytes indices(meshopt_encodeIndexBufferBound(3 * s.triangles.size(), s.vertices.size()));
  indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(),
                                           reinterpret_cast<const unsigned*>(s.triangles.data()),
                                           3 * s.triangles.size()));
  add_stream(out.bytes, indices);
  add_stream(out.bytes, pack_elements(s));
  add_stream(out.bytes, pack_errors(s));
  return out;
}

std::expected<std::vector<Bytes>, Text> read_streams(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::vector<Bytes> streams;
  for (std::size_t i = 0; i < k_streams; ++i) {
    if (bytes.size() < at + 8) return std::unexpected("it is cut off");
    const std::size_t stored = get<std::uint32_t>(bytes, at), size = get<std::uint32_t>(bytes, at + 4);
    at += 8;
    if (bytes.size() - at < stored) return std::unexpected("it is cut off");
    if (size > k_free_decoded_bytes + k_max_expansion * stored)
      return std::unexpected("a stream claims to be larger than it can be");
    Bytes out(size);
    if (ZSTD_decompress(out.data(), size, bytes.data() + at, stored) != size)
      return std::unexpected("a stream does not decompress");
    at += stored;
    streams.push_back(std::move(out));
  }
  if (at != bytes.size()) return std::unexpected("bytes follow its end");
  return streams;
}

std::expected<Spectrum, Text> decode_small(std::span<const std::uint8_t> bytes, Spectrum s) {
  if (bytes.size() < k_header + k_ranges) return std::unexpected("it is cut off");
  const std::uint64_t vertices = get<std::uint32_t>(bytes, 8), elements = get<std::uint32_t>(bytes, 12),
                      triangles = get<std::uint32_t>(bytes, 16), states = get<std::uint32_t>(bytes, 20);
  Ranges r{get<Float3>(bytes, k_header),
           get<Float3>(bytes, k_header + 12),
           get<Float2>(bytes, k_header + 24),
           get<Float2>(bytes, k_header + 32),
           bytes[k_header + 40],
           bytes[k_header + 41]};
  if (r.position_bits < 8 || r.position_bits > 16 || r.texcoord_bits < 8 || r.texcoord_bits > 16)
    return std::unexpected("its numbers have an unknown width");
  const auto streams = read_streams(bytes, k_header + k_ranges);
  if (!streams) return std::unexpected(streams.error());
  // Every element, triangle and state takes at least a byte of its stream or its block; so memory is bounded
  // by them.
  if (elements * 5 > (*streams)[2].size() || states > (*streams)[3].size() ||
      triangles > (*streams)[1].size() || vertices > 3 * triangles)
    return std::unexpected("it counts more than its streams hold");
  std::vector<PackedVertex> packed_vertices(vertices);
  if (vertices > 0 && meshopt_decodeVertexBuffer(packed_vertices.data(), vertices, sizeof(PackedVertex),
                                                 (*streams)[0].data(), (*streams)[0].size()) != 0)
    return std::unexpected("its vertices do not decode");
  std::vector<SpectrumVertex> out;
  out.reserve(vertices);
  for (const PackedVertex& p : packed_vertices) out.push_back(unpacked(p, r));
  std::vector<std::array<std::uint32_t, 3>> corners(triangles);
  if (triangles > 0 && meshopt_decodeIndexBuffer(reinterpret_cast<unsigned*>(corners.data()), 3 * triangles,
                                                 (*streams)[1].data(), (*streams)[1].size()) != 0)
    return std::unexpected("its triangles do not decode");
  std::vector<SpectrumElement> lives(elements);
  std::vector<std::uint32_t> first(elements + 1);
  if (!unpack_elements((*streams)[2], states, lives, first))
    return std::unexpected("its elements do not decode");
  Reader in((*streams)[3]);
  std::vector<float> errors;
  std::uint32_t bits = 0;
  for (std::uint64_t n = 0; n < states; ++n)
    errors.push_back(std::bit_cast<float>(bits += static_cast<std::uint32_t>(in.varint())));
  if (!in.done()) return std::unexpected("its errors do not decode");
  s.vertices = std::move(out), s.triangles = std::move(corners), s.elements = std::move(lives);
  s.first_triangle = std::move(first), s.errors = std::move(errors);
  return s;
}

template <class T>
bool take_array(std::span<const std::uint8_t> bytes, std::size_t& at, std::uint64_t count, Array<T>& out) {
  if ((bytes.size() - at) / sizeof(T) < count) return false;
  std::vector<T> elements(count);
  if (count > 0) std::memcpy(elements.data(), bytes.data() + at, count * sizeof(T));
  at += count * sizeof(T);
  out = std::move(elements);
  return true;
}

std::expected<Spectrum, Text> decode_fast(std::span<const std::uint8_t> bytes, Spectrum s) {
  const std::uint64_t vertices = get<std::uint32_t>(bytes, 8), elements = get<std::uint32_t>(bytes, 12),
                      triangles = get<std::uint32_t>(bytes, 16), states = get<std::uint32_t>(bytes, 20);
  std::size_t at = k_header;
  const bool whole = take_array(bytes, at, vertices, s.vertices) &&
                     take_array(bytes, at, elements, s.elements) &&
                     take_array(bytes, at, elements + 1, s.first_triangle) &&
                     take_array(bytes, at, triangles, s.triangles) && take_array(bytes, at, states, s.errors);
  if (!whole || at != bytes.size()) return std::unexpected("it has another size than its counts give");
  return s;
}

}  // namespace

// Nothing where the spectrum is not one of the tree's own, or would not be what it was when it is read.
std::optional<EncodedSpectrum> encode_based(const Spectrum& s, const SpectrumCodingOptions& options,
                                            const Tree& tree) {
  const bool trunk = s.method == LodMethod::radii;
  if (!trunk && s.method != LodMethod::collapse) return std::nullopt;
  auto coded = trunk ? spectrum_trunk::encode(s, tree, options) : spectrum_leaves::encode(s, tree, options);
  if (!coded) return std::nullopt;
  const auto back = trunk ? spectrum_trunk::decode(coded->bytes, s.method, tree)
                          : spectrum_leaves::decode(coded->bytes, s.method, tree);
  if (!back || back->elements.size() != s.elements.size() || back->triangles.size() != s.triangles.size())
    return std::nullopt;
  Bytes out = header_of(*back, SpectrumCoding::based);
  out.insert(out.end(), coded->bytes.begin(), coded->bytes.end());
  coded->bytes = std::move(out);
  return coded;
}

std::expected<Spectrum, Text> decode_based(std::span<const std::uint8_t> bytes, LodMethod method,
                                           const Tree& tree) {
  const std::uint64_t vertices = get<std::uint32_t>(bytes, 8), elements = get<std::uint32_t>(bytes, 12),
                      triangles = get<std::uint32_t>(bytes, 16), states = get<std::uint32_t>(bytes, 20);
  const std::uint64_t own = tree.leaves.triangles.size() + tree.trunk.triangles.size();
  if (32 * vertices + 20 * elements + 12 * triangles + 8 * states >
      k_free_decoded_bytes + k_max_expansion * (bytes.size() + own))
    return std::unexpected("it claims to be larger than it can be");
  if (method != LodMethod::collapse && method != LodMethod::radii)
    return std::unexpected("this method is not coded against the tree");
  auto s = method == LodMethod::radii ? spectrum_trunk::decode(bytes.subspan(k_header), method, tree)
                                      : spectrum_leaves::decode(bytes.subspan(k_header), method, tree);
  if (s && (s->vertices.size() != vertices || s->elements.size() != elements ||
            s->triangles.size() != triangles || s->errors.size() != states))
    return std::unexpected("its header counts something else than what it holds");
  return s;
}

Result<EncodedSpectrum> encode(const Spectrum& s, const SpectrumCodingOptions& options, const Tree* tree) {
  if (options.coding == SpectrumCoding::small) {
    if (tree != nullptr)
      if (auto based = encode_based(s, options, *tree)) return std::move(*based);
    return encode_small(s, options);
  }
  EncodedSpectrum out{.bytes = header_of(s, SpectrumCoding::fast)};
  add_array(out.bytes, s.vertices), add_array(out.bytes, s.elements), add_array(out.bytes, s.first_triangle);
  add_array(out.bytes, s.triangles), add_array(out.bytes, s.errors);
  return out;
}

std::expected<Spectrum, std::string> decode(std::span<const std::uint8_t> bytes, const Tree* tree) {
  if (bytes.size() < k_header) return std::unexpected("it is cut off");
  const auto method = get<std::uint32_t>(bytes, 0), coding = get<std::uint32_t>(bytes, 4);
  if (method < 1 || method > 4)
    return std::unexpected(fmt::format("method {} is unknown to this program", method));
  Spectrum s;
  s.method = static_cast<LodMethod>(method);
  if (coding == static_cast<std::uint32_t>(SpectrumCoding::fast)) return decode_fast(bytes, std::move(s));
  if (coding == static_cast<std::uint32_t>(SpectrumCoding::small)) return decode_small(bytes, std::move(s));
  if (coding == static_cast<std::uint32_t>(SpectrumCoding::based)) {
    if (tree == nullptr) return std::unexpected("it is coded against the tree, which is not there");
    return decode_based(bytes, s.method, *tree);
  }
  return std::unexpected(fmt::format("coding {} is unknown to this program", coding));
}

}  // namespace copse::spectrum_codec
