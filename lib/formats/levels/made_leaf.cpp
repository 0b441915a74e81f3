#include "lib/formats/levels/made_leaf.h"

#include "lib/formats/packing/leaf_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr double k_units = 32;             // of a leaf's size
constexpr double k_grown_tolerance = 1.0;  // units: what is grown may be off
constexpr double k_frame_tolerance = 1.7;
constexpr double k_steps = 64;             // of sizes and stretches
constexpr int k_tilts = 48, k_turns = 48;  // of a normal's octahedron and of a quarter turn
constexpr std::size_t k_most_members = 64, k_most_recent = 64, k_most_faces = 256;
constexpr double k_same_normal = 0.035;
constexpr double k_point = 0.8773826753016615;  // of an equilateral triangle of area 1: centre to corner
constexpr double k_side = 0.7598356856515924;   // and half its side
enum Mode : std::uint64_t { as_grown, as_frame, as_corners };
enum NormalMode : std::uint64_t { as_like, one_shaded, one_face, each };

double area_of(std::span<const SpectrumVertex> v, std::span<const std::array<std::uint32_t, 3>> faces) {
  double area = 0;
  for (const auto& f : faces) {
    const Double3 a = to_double(v[f[0]].position);
    const Double3 n = cross(to_double(v[f[1]].position) - a, to_double(v[f[2]].position) - a);
    area += 0.5 * std::sqrt(dot(n, n));
  }
  return area;
}

Double3 mean_of(std::span<const SpectrumVertex> v) {
  Double3 sum{};
  for (const SpectrumVertex& x : v) sum += to_double(x.position);
  return v.empty() ? sum : sum / static_cast<double>(v.size());
}

double worst(const std::vector<Double3>& places, std::span<const SpectrumVertex> v) {
  double error = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    error = std::max(error, distance(places[i], to_double(v[i].position)));
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

std::int64_t whole(double x) {
  return std::llround(std::clamp(std::isfinite(x) ? x : 0.0, -1e9, 1e9));
}

// Where the corners of a leaf of area 1 lie in its frame.
Double3 unit_corner(std::size_t corners, std::size_t i, bool other) {
  if (corners == 3)
    return i == 0 ? Double3{k_point, 0, 0} : Double3{-k_point / 2, i == 1 ? k_side : -k_side, 0};
  if (other && (i == 1 || i == 2)) i = 3 - i;
  return {i == 1 || i == 2 ? 0.5 : -0.5, i >= 2 ? 0.5 : -0.5, 0};
}

// A normal with k_tilts steps a quarter, and a turn about it.
LeafFrame frame_at(const Octahedral& normal, bool half, std::int64_t turn) {
  const double u = double(normal[0]) / k_tilts, v = double(normal[1]) / k_tilts;
  const Octahedral fine{static_cast<std::int32_t>(whole(u * k_octahedral_limit)),
                        static_cast<std::int32_t>(whole(v * k_octahedral_limit))};
  // x of the frame is the normal here: y and z lie in the leaf.
  return leaf_frame(to_double(from_octahedral(fine)), half, double(turn) / k_turns);
}

Octahedral coarse(const Double3& n) {
  const Octahedral fine = to_octahedral(n);
  const auto step = [](std::int32_t x) {
    return static_cast<std::int32_t>(whole(double(x) * k_tilts / k_octahedral_limit));
  };
  return {step(fine[0]), step(fine[1])};
}

Double3 face_of(std::span<const SpectrumVertex> v, std::span<const std::array<std::uint32_t, 3>> faces) {
  Double3 sum{};
  for (const auto& f : faces) {
    const Double3 a = to_double(v[f[0]].position);
    sum += cross(to_double(v[f[1]].position) - a, to_double(v[f[2]].position) - a);
  }
  return normalized(sum);
}

}  // namespace

MadeLeaves::MadeLeaves(RangeCoder& coder, const PartTriangles& part, double texcoord_step)
    : c_(coder), part_(part), texcoord_step_(texcoord_step) {}

void MadeLeaves::sum(const LeafForest& forest) {
  sums_.assign(forest.nodes.size(), {});
  for (std::size_t n = forest.nodes.size(); n-- > 0;) {
    const LeafForest::Node& node = forest.nodes[n];
    Sum& sum = sums_[n];
    for (std::uint32_t i = node.first_source; i < node.first_source + node.sources; ++i) {
      const auto& f = part_.triangles[forest.sources[i]];
      const std::array<SpectrumVertex, 3> v{part_.vertices[f[0]], part_.vertices[f[1]], part_.vertices[f[2]]};
      const std::array<Face, 1> face{{{0, 1, 2}}};
      const double area = area_of(v, face);
      sum.area += area, sum.first += mean_of(v) * area;
      for (const SpectrumVertex& x : v) sum.shading += to_double(x.normal) * (area / 3);
    }
    for (std::uint32_t k = node.first_child; k < node.first_child + node.children; ++k)
      sum.area += sums_[k].area, sum.first += sums_[k].first, sum.shading += sums_[k].shading;
  }
}

std::vector<MadeLeaves::Member> MadeLeaves::members(const LeafForest& forest, std::uint32_t n) const {
  const LeafForest::Node& node = forest.nodes[n];
  std::vector<Member> out;
  // Triangles of one piece that go together are one member too.
  for (std::uint32_t i = node.first_source, end = i + node.sources; i < end;) {
    const std::uint32_t piece = forest.piece_of[forest.sources[i]];
    Member m;
    std::vector<std::uint32_t> used;
    for (; i < end && forest.piece_of[forest.sources[i]] == piece && m.faces.size() < k_most_faces; ++i) {
      Face& face = m.faces.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t v = part_.triangles[forest.sources[i]][c];
        const auto at = std::find(used.begin(), used.end(), v);
        face[c] = static_cast<std::uint32_t>(at - used.begin());
        if (at == used.end()) used.push_back(v), m.vertices.push_back(part_.vertices[v]);
      }
    }
    m.area = area_of(m.vertices, m.faces);
    out.push_back(std::move(m));
  }
  for (std::uint32_t k = node.first_child; k < node.first_child + node.children; ++k) {
    const LeafForest::Node& child = forest.nodes[k];
    if (child.drawn) out.push_back({child.vertices, child.faces, area_of(child.vertices, child.faces)});
  }
  std::stable_sort(out.begin(), out.end(), [](const Member& a, const Member& b) { return a.area > b.area; });
  if (out.size() > k_most_members) out.resize(k_most_members);
  return out;
}

bool MadeLeaves::code_number(std::int64_t& value, SignedModel& model, std::int64_t limit) {
  value = c_.signed_number(model, value);
  return std::abs(value) <= limit;
}

std::string MadeLeaves::code(LeafForest& forest, std::uint32_t n) {
  LeafForest::Node& node = forest.nodes[n];
  if (!code_faces(node)) return "the triangles of a made leaf are not sound";
  const std::vector<Member> list = members(forest, n);
  std::size_t like = 0;
  if (!code_places(node, list, sums_[n], like)) return "the corners of a made leaf are out of range";
  for (const SpectrumVertex& v : node.vertices)
    if (!is_finite(v.position)) return "a corner of a made leaf is not finite";
  const Member* model =
      like < list.size() && list[like].vertices.size() == node.vertices.size() ? &list[like] : nullptr;
  code_normals(node, model, sums_[n]);
  return code_texcoords(node) ? "" : "the texture coordinates of a made leaf are out of range";
}

bool MadeLeaves::code_faces(LeafForest::Node& node) {
  std::uint64_t symbol = 0;
  if (!c_.decoding()) {
    const auto at = std::find(recent_faces_.begin(), recent_faces_.end(), node.faces);
    if (at != recent_faces_.end()) symbol = static_cast<std::uint64_t>(at - recent_faces_.begin()) + 1;
  }
  c_.stream("made: triangles");
  symbol = c_.number(which_faces_, symbol);
  if (symbol > recent_faces_.size()) return false;
  if (symbol > 0) {
    node.faces = recent_faces_[symbol - 1];
    recent_faces_.erase(recent_faces_.begin() + static_cast<std::ptrdiff_t>(symbol) - 1);
  } else {
    const std::uint64_t n = c_.number(face_index_, node.faces.size());
    if (n == 0 || n > k_most_faces) return false;
    if (c_.decoding()) node.faces.resize(n);
    std::uint32_t count = 0;
    for (Face& f : node.faces)
      for (std::uint32_t& v : f) {
        const std::uint64_t back = c_.number(face_index_, count - v);
        if (back > count) return false;
        v = count - static_cast<std::uint32_t>(back);
        if (back == 0) ++count;
      }
  }
  recent_faces_.insert(recent_faces_.begin(), node.faces);
  if (recent_faces_.size() > k_most_recent) recent_faces_.pop_back();
  std::uint32_t most = 0;
  for (const Face& f : node.faces) most = std::max({most, f[0], f[1], f[2]});
  if (c_.decoding()) node.vertices.resize(std::size_t{most} + 1);
  return node.vertices.size() == std::size_t{most} + 1;
}

std::vector<Double3> MadeLeaves::grown(const Fit& fit, const std::vector<Member>& list) const {
  const Member& m = list[static_cast<std::size_t>(fit.like)];
  const double by = (k_steps + double(fit.size)) / k_steps;
  const Double3 fixed = fit.about == 0
                            ? mean_of(m.vertices)
                            : to_double(m.vertices[static_cast<std::size_t>(fit.about) - 1].position);
  const double unit = std::sqrt(m.area) * by / k_units;
  const Double3 move{double(fit.move[0]) * unit, double(fit.move[1]) * unit, double(fit.move[2]) * unit};
  std::vector<Double3> out;
  for (const SpectrumVertex& v : m.vertices)
    out.push_back(fixed + (to_double(v.position) - fixed) * by + move);
  return out;
}

MadeLeaves::Fit MadeLeaves::fit_grown(const LeafForest::Node& node, const std::vector<Member>& list) const {
  Fit best;
  best.error = std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  const double own = area_of(node.vertices, node.faces);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Member& m = list[k];
    if (m.faces != node.faces || m.vertices.size() != node.vertices.size() || !(m.area > 0)) continue;
    const double by = std::sqrt(own / m.area), size = std::sqrt(own);
    for (std::size_t about = 0; about <= m.vertices.size(); ++about) {
      Fit fit;
      fit.like = static_cast<std::int64_t>(k), fit.about = static_cast<std::int64_t>(about);
      fit.size = std::clamp<std::int64_t>(whole(k_steps * (by - 1)), 1 - static_cast<std::int64_t>(k_steps),
                                          1 << 20);
      const std::vector<Double3> still = grown(fit, list);
      Double3 off{};
      for (std::size_t v = 0; v < still.size(); ++v)
        off += (to_double(node.vertices[v].position) - still[v]) / double(still.size());
      const double unit = size / k_units;
      for (int a = 0; a < 3; ++a) fit.move[static_cast<std::size_t>(a)] = whole(off[a] / unit);
      fit.places = grown(fit, list);
      fit.error = worst(fit.places, node.vertices) / unit;
      const double bits = std::abs(double(fit.move[0])) + std::abs(double(fit.move[1])) +
                          std::abs(double(fit.move[2])) + 0.1 * double(k) + 0.01 * double(about);
      if (fit.error <= k_grown_tolerance && bits < least) least = bits, best = fit;
    }
  }
  return best;
}

std::vector<Double3> MadeLeaves::framed(const Fit& fit, std::size_t corners, const Sum& sum) const {
  const double size = std::sqrt(sum.area) * (k_steps + double(fit.size)) / k_steps;
  const double stretch = (k_steps + double(fit.stretch)) / k_steps, unit = size / k_units;
  const LeafFrame f = frame_at(fit.normal, fit.half, fit.turn);
  const Double3 centre = (sum.area > 0 ? sum.first / sum.area : sum.first) +
                         Double3{double(fit.move[0]), double(fit.move[1]), double(fit.move[2])} * unit;
  std::vector<Double3> out;
  for (std::size_t i = 0; i < corners; ++i) {
    const Double3 p = unit_corner(corners, i, fit.other);
    out.push_back(centre + f.y * (p.x * size * stretch) + f.z * (p.y * size / stretch));
  }
  return out;
}

MadeLeaves::Fit MadeLeaves::fit_framed(const LeafForest::Node& node, const Sum& sum) const {
  Fit best;
  best.error = std::numeric_limits<double>::infinity();
  const std::size_t n = node.vertices.size();
  const double own = area_of(node.vertices, node.faces);
  if ((n != 3 && n != 4) || !(own > 0) || !(sum.area > 0)) return best;
  const auto at = [&](std::size_t i) { return to_double(node.vertices[i].position); };
  const Double3 centre = mean_of(node.vertices);
  for (const bool other : {false, true}) {
    if (other && n == 3) continue;
    const std::size_t b = other ? 2 : 1;
    const Double3 along = n == 3 ? at(0) - centre : at(b) - at(0),
                  across = n == 3 ? at(1) - at(2) : at(3) - at(0);
    const double size = std::sqrt(own);
    Fit fit;
    fit.other = other;
    const double stretch = n == 3 ? length(along) / (k_point * size)
                                  : std::sqrt(length(along) / std::max(length(across), 1e-300));
    fit.stretch = std::clamp<std::int64_t>(whole(k_steps * (stretch - 1)),
                                           1 - static_cast<std::int64_t>(k_steps), 1 << 12);
    fit.size = std::clamp<std::int64_t>(whole(k_steps * (size / std::sqrt(sum.area) - 1)),
                                        1 - static_cast<std::int64_t>(k_steps), 1 << 12);
    fit.normal = coarse(normalized(cross(along, across)));
    const LeafFrame f = frame_at(fit.normal, false, 0);
    double angle = std::atan2(dot(along, f.z), dot(along, f.y));
    const double quarter = std::atan2(1, 0);
    fit.half = std::abs(angle) > quarter;
    if (fit.half) angle += angle > 0 ? -2 * quarter : 2 * quarter;
    fit.turn = whole(std::tan(angle / 2) * k_turns);
    const double unit = std::sqrt(sum.area) * (k_steps + double(fit.size)) / k_steps / k_units;
    const Double3 off = centre - sum.first / sum.area;
    for (int a = 0; a < 3; ++a) fit.move[static_cast<std::size_t>(a)] = whole(off[a] / unit);
    fit.places = framed(fit, n, sum);
    fit.error = worst(fit.places, node.vertices) / unit;
    if (fit.error < best.error) best = fit;
  }
  return best;
}

bool MadeLeaves::code_places(LeafForest::Node& node, const std::vector<Member>& list, const Sum& sum,
                             std::size_t& like) {
  Fit fit;
  std::uint64_t mode = as_corners;
  if (!c_.decoding()) {
    fit = fit_grown(node, list);
    if (fit.error <= k_grown_tolerance)
      mode = as_grown;
    else if (fit = fit_framed(node, sum); fit.error <= k_frame_tolerance)
      mode = as_frame;
  }
  c_.stream("made: mode");
  mode = c_.number(mode_, mode);
  static const char* const k_names[] = {"made: grown", "made: framed", "made: corners"};
  c_.stream(k_names[std::min<std::uint64_t>(mode, 2)]);
  if (mode == as_grown) {
    fit.like = static_cast<std::int64_t>(c_.number(like_, static_cast<std::uint64_t>(fit.like)));
    if (fit.like < 0 || fit.like >= static_cast<std::int64_t>(list.size())) return false;
    const Member& m = list[static_cast<std::size_t>(fit.like)];
    if (m.vertices.size() != node.vertices.size()) return false;
    fit.about = static_cast<std::int64_t>(c_.number(about_, static_cast<std::uint64_t>(fit.about)));
    if (fit.about < 0 || fit.about > static_cast<std::int64_t>(m.vertices.size())) return false;
    const double by = m.area > 0 ? std::sqrt(sum.area / m.area) : 1;
    const std::int64_t expected = whole(std::min(k_steps * (by - 1), 1e6));
    fit.size -= expected;
    if (!code_number(fit.size, size_, 1 << 22)) return false;
    fit.size += expected;
    for (std::int64_t& x : fit.move)
      if (!code_number(x, move_[0], 1 << 20)) return false;
    fit.places = grown(fit, list);
    like = static_cast<std::size_t>(fit.like);
  } else if (mode == as_frame) {
    if (node.vertices.size() != 3 && node.vertices.size() != 4) return false;
    if (!code_number(fit.size, framed_size_, 1 << 13) || !code_number(fit.stretch, stretch_, 1 << 13))
      return false;
    const Octahedral expected =
        coarse(list.empty() ? Double3{0, 1, 0} : face_of(list[0].vertices, list[0].faces));
    for (std::size_t k = 0; k < 2; ++k)
      fit.normal[k] = static_cast<std::int32_t>(std::clamp<std::int64_t>(
          expected[k] + c_.signed_number(normal_[k], fit.normal[k] - expected[k]), -k_tilts, k_tilts));
    if (node.vertices.size() == 4) fit.other = c_.bit(other_, fit.other);
    fit.half = c_.bit(half_, fit.half);
    if (!code_number(fit.turn, turn_, k_turns)) return false;
    for (std::int64_t& x : fit.move)
      if (!code_number(x, move_[1], 1 << 20)) return false;
    fit.places = framed(fit, node.vertices.size(), sum);
  } else if (mode == as_corners) {
    return code_corners(node, sum);
  } else {
    return false;
  }
  for (std::size_t v = 0; v < node.vertices.size(); ++v) node.vertices[v].position = to_float(fit.places[v]);
  return true;
}

bool MadeLeaves::code_corners(LeafForest::Node& node, const Sum& sum) {
  double own = c_.decoding() ? 0 : area_of(node.vertices, node.faces);
  // The unit is a power of two beside the size of what it stands for: thin leaves have less area than size.
  const double base = std::sqrt(sum.area);
  double reach = 0;
  for (const SpectrumVertex& v : node.vertices)
    reach = std::max(reach, distance(to_double(v.position), to_double(node.vertices[0].position)));
  own = std::max(std::sqrt(own), reach / 8);
  std::int64_t power = own > 0 ? whole(std::floor(std::log2(own / (base > 0 ? base : 1)))) : 0;
  if (!code_number(power, power_, 200)) return false;
  const double unit = (base > 0 ? base : 1) * std::ldexp(1.0, static_cast<int>(power)) / k_units;
  Double3 before = sum.area > 0 ? sum.first / sum.area : sum.first;
  for (std::size_t i = 0; i < node.vertices.size(); ++i) {
    SpectrumVertex& v = node.vertices[i];
    const Double3 off = to_double(v.position) - before;
    Double3 place = before;
    for (int a = 0; a < 3; ++a) {
      std::int64_t x = whole(off[a] / unit);
      if (!code_number(x, i == 0 ? first_corner_ : corner_, std::int64_t{1} << 40)) return false;
      place[a] += double(x) * unit;
    }
    v.position = to_float(place), before = place;
  }
  return true;
}

void MadeLeaves::code_normals(LeafForest::Node& node, const Member* like, const Sum& sum) {
  const Octahedral shaded = to_octahedral(normalized(sum.shading));
  const Octahedral face = to_octahedral(face_of(node.vertices, node.faces));
  std::uint64_t mode = each;
  if (!c_.decoding()) {
    bool same = like != nullptr, one = true;
    for (std::size_t v = 0; v < node.vertices.size(); ++v) {
      const Double3 n = to_double(node.vertices[v].normal);
      same = same && distance(n, to_double(like->vertices[v].normal)) <= k_same_normal;
      one = one && node.vertices[v].normal == node.vertices[0].normal;
    }
    const Octahedral own = to_octahedral(to_double(node.vertices[0].normal));
    const auto off = [&](const Octahedral& o) { return std::abs(o[0] - own[0]) + std::abs(o[1] - own[1]); };
    mode = same ? as_like : !one ? each : off(face) < off(shaded) ? one_face : one_shaded;
  }
  c_.stream("made: normals");
  mode = std::min<std::uint64_t>(c_.number(normal_mode_, mode), each);
  if (mode == as_like && like == nullptr) mode = one_shaded;
  Octahedral last = mode == one_face ? face : shaded;
  for (std::size_t v = 0; v < node.vertices.size(); ++v) {
    if (mode == as_like) {
      node.vertices[v].normal = like->vertices[v].normal;
      continue;
    }
    if (v == 0 || mode == each) {
      const Octahedral own = to_octahedral(to_double(node.vertices[v].normal));
      for (std::size_t k = 0; k < 2; ++k)
        last[k] = static_cast<std::int32_t>(
            std::clamp<std::int64_t>(last[k] + c_.signed_number(shade_[mode == each], own[k] - last[k]),
                                     -k_octahedral_limit, k_octahedral_limit));
    }
    node.vertices[v].normal = from_octahedral(last);
  }
}

bool MadeLeaves::code_texcoords(LeafForest::Node& node) {
  std::vector<Grid2> own(node.vertices.size());
  std::uint64_t symbol = 0;
  if (!c_.decoding()) {
    for (std::size_t v = 0; v < own.size(); ++v)
      own[v] = {whole(node.vertices[v].texcoord.x / texcoord_step_),
                whole(node.vertices[v].texcoord.y / texcoord_step_)};
    const auto at = std::find(recent_texcoords_.begin(), recent_texcoords_.end(), own);
    if (at != recent_texcoords_.end())
      symbol = static_cast<std::uint64_t>(at - recent_texcoords_.begin()) + 1;
  }
  c_.stream("made: texture coordinates");
  symbol = c_.number(which_texcoords_, symbol);
  if (symbol > recent_texcoords_.size()) return false;
  if (symbol > 0) {
    own = recent_texcoords_[symbol - 1];
    recent_texcoords_.erase(recent_texcoords_.begin() + static_cast<std::ptrdiff_t>(symbol) - 1);
    if (own.size() != node.vertices.size()) return false;
  } else {
    Grid2 before{};
    for (Grid2& uv : own)
      for (std::size_t k = 0; k < 2; ++k) {
        std::int64_t x = uv[k] - before[k];
        if (!code_number(x, texcoord_, 4 * k_grid_limit)) return false;
        uv[k] = before[k] += x;
      }
  }
  recent_texcoords_.insert(recent_texcoords_.begin(), own);
  if (recent_texcoords_.size() > k_most_recent) recent_texcoords_.pop_back();
  for (std::size_t v = 0; v < own.size(); ++v)
    node.vertices[v].texcoord = {static_cast<float>(double(own[v][0]) * texcoord_step_),
                                 static_cast<float>(double(own[v][1]) * texcoord_step_)};
  return true;
}

}  // namespace copse
