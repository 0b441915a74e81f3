#include "lib/analysis/lod/leaf_collapse.h"

#include "lib/analysis/lod/crown_field.h"
#include "lib/analysis/lod/leaf_matching.h"
#include "lib/analysis/lod/leaf_pieces.h"
#include "lib/analysis/lod/leaf_shape.h"
#include "lib/analysis/lod/leaf_views.h"
#include "lib/analysis/lod/radius_ancestors.h"
#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

using Face = std::array<std::uint32_t, 3>;

constexpr double k_prior = 20;      // pixels that the field's word on a leaf is worth
constexpr double k_good = 0.1;      // pixels of change in all views: no better successor is looked for
constexpr double k_layers = 7;      // of leaves, behind which nothing is seen whichever way it lies
constexpr double k_hidden = 0.02;   // of a leaf: if it covers no more alone, it may be anywhere
constexpr double k_margin = 0.012;  // of the crown's width, out of its hull

int cells_for(std::size_t triangles) {
  return std::clamp(static_cast<int>(2 * std::cbrt(double(triangles))), 8, 64);
}

CrownField field_of(const LeafPieces& pieces, int cells) {
  std::vector<FoliageTriangle> triangles(pieces.part.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c)
      triangles[t].corners[c] = to_double(pieces.part.vertices[pieces.part.triangles[t][c]].position);
    triangles[t].opacity = pieces.opacity_of(t);
  }
  return {triangles, cells > 0 ? cells : cells_for(triangles.size())};
}

// What is drawn of a node.
struct Drawn {
  std::vector<SpectrumVertex> vertices;
  std::vector<Face> faces;  // of `vertices`
  std::vector<ViewedTriangle> viewed;

  void see() {
    viewed.clear();
    for (const Face& f : faces) {
      ViewedTriangle t;
      for (int c = 0; c < 3; ++c)
        t.corners[c] = to_double(vertices[f[c]].position), t.texcoords[c] = vertices[f[c]].texcoord;
      viewed.push_back(t);
    }
  }
  double area() const {
    double sum = 0;
    for (const ViewedTriangle& t : viewed)
      sum += 0.5 * length(cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
    return sum;
  }
  Double3 centre() const {
    Double3 sum{};
    for (const SpectrumVertex& v : vertices) sum += to_double(v.position) / double(vertices.size());
    return sum;
  }
};

// What may take the place of two leaves.
struct Successor {
  Drawn drawn;
  std::uint32_t like = k_none;  // the node that it looks like
  double displacement = 0;
  double cost = std::numeric_limits<double>::infinity();
};

class Collapse {
 public:
  Collapse(const Tree& tree, const Looks& looks, const LeafPieces& pieces, const LeafCollapseOptions& options)
      : pieces_(pieces),
        looks_(looks),
        options_(options),
        field_(field_of(pieces, options.cells)),
        ancestors_(tree),
        builder_(LodMethod::collapse) {
    shape_.emptiness = options.emptiness;
    shape_.largest = options.largest * field_.cross_section();
    for (const SpectrumVertex& v : pieces.part.vertices) box_.grow(to_double(v.position));
    offset_ = box_.empty() ? Double3{} : box_.centre();
  }

  Spectrum run() {
    make_nodes();
    put_source();
    alive_.resize(nodes_.size());
    std::iota(alive_.begin(), alive_.end(), 0u);
    while (alive_.size() > 1) round();
    return builder_.finish();
  }

 private:
  struct Node {
    std::uint32_t piece = 0;          // whose material and texture it has
    std::uint32_t triangle = k_none;  // of the source, when it is one of a piece's
    std::uint32_t radius = k_none, group = k_none;
    std::uint32_t element = k_none;  // of the spectrum, while it has one of its own
    Patch patch;
    Drawn drawn;
    double displacement = 0;  // metres, of what it stands for
    bool core = false;        // took the area of leaves from everywhere
  };
  struct Merge {
    std::vector<std::uint32_t> members;  // places in alive_: the host first
    Successor successor;
    double price = 0;  // a triangle
    bool core = false, fits = true;
  };

  // One node a triangle of an opaque piece, one a piece that has alpha.
  void make_nodes() {
    for (std::uint32_t p = 0; p < pieces_.list.size(); ++p) {
      const LeafPiece& piece = pieces_.list[p];
      first_node_.push_back(static_cast<std::uint32_t>(nodes_.size()));
      const auto all = std::span(pieces_.triangles).subspan(piece.first, piece.last - piece.first);
      if (piece.card) {
        add_source(p, k_none, all);
      } else {
        for (const std::uint32_t& t : all) add_source(p, t, std::span(&t, 1));
      }
    }
    first_node_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  }

  void add_source(std::uint32_t p, std::uint32_t triangle, std::span<const std::uint32_t> triangles) {
    Node node{.piece = p,
              .triangle = triangle,
              .radius = pieces_.list[p].radius,
              .group = pieces_.list[p].group,
              .element = k_none,
              .patch = {},
              .drawn = {},
              .displacement = 0,
              .core = false};
    std::vector<std::uint32_t> used;
    for (const std::uint32_t t : triangles) {
      node.patch += patch(t);
      Face face;
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t v = pieces_.part.triangles[t][c];
        const auto at = std::find(used.begin(), used.end(), v);
        face[c] = static_cast<std::uint32_t>(at - used.begin());
        if (at == used.end()) used.push_back(v), node.drawn.vertices.push_back(pieces_.part.vertices[v]);
      }
      node.drawn.faces.push_back(face);
    }
    node.drawn.see();
    nodes_.push_back(std::move(node));
  }

  Patch patch(std::uint32_t triangle) const {
    std::array<Double3, 3> corners;
    Double3 shading{};
    for (int c = 0; c < 3; ++c) {
      const SpectrumVertex& v = pieces_.part.vertices[pieces_.part.triangles[triangle][c]];
      corners[c] = to_double(v.position);
      shading += to_double(v.normal) / 3;
    }
    const Double3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    const double seen = field_.exposure(middle), open = field_.at(middle).openness;
    for (Double3& c : corners) c -= offset_;
    Patch p = patch_of(corners, pieces_.opacity_of(triangle), seen);
    p.open = p.area * open, p.shading = shading * p.area, p.up = pieces_.up_of(triangle) * p.area;
    return p;
  }

  void put_source() {
    for (const SpectrumVertex& v : pieces_.part.vertices) builder_.vertex(v);
    std::vector<Face> faces;
    for (const LeafPiece& piece : pieces_.list) {
      faces.clear();
      for (std::uint32_t t = piece.first; t < piece.last; ++t)
        faces.push_back(pieces_.part.triangles[pieces_.triangles[t]]);
      piece_element_.push_back(builder_.element(piece.material, piece.radius, faces));
    }
  }

  const AlphaMask* mask_of(const Node& node) const {
    const std::uint32_t m = pieces_.list[node.piece].material;
    return m < looks_.masks.size() && !looks_.masks[m].opaque.empty() ? &looks_.masks[m] : nullptr;
  }
  ViewedLeaf viewed(const Node& node) const { return {node.drawn.viewed, mask_of(node)}; }

  std::vector<ViewedLeaf> viewed(std::span<const std::uint32_t> nodes) const {
    std::vector<ViewedLeaf> out;
    for (const std::uint32_t n : nodes) out.push_back(viewed(nodes_[n]));
    return out;
  }

  // Pictures as fine as the leaves that are left, so that a round costs what they are many.
  void sharpen() {
    double area = 0;
    for (const std::uint32_t n : alive_) area += nodes_[n].patch.area;
    mean_area_ = area / double(alive_.size());
    const double pixel = std::sqrt(area / (2 * options_.leaf_pixels * double(alive_.size())));
    if (views_ && !(pixel > 1.6 * asked_)) return;
    asked_ = std::isfinite(pixel) ? pixel : 0;
    views_.emplace(offset_, 0.55 * length(box_.extent()), asked_, turns_++);
    std::vector<std::uint32_t> source(first_node_.back());
    std::iota(source.begin(), source.end(), 0u);
    views_->set_source(viewed(source));
  }

  void round() {
    sharpen();
    const std::vector<LeafViews::Count> counts = views_->look(viewed(alive_));
    weigh(views_->coverage());
    std::vector<MatchLeaf> leaves;
    alone_.clear();
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      const Node& n = nodes_[alive_[i]];
      const Patch& p = n.patch;
      // Few pixels say little: what the field says counts as some more of them.
      const double covered = std::max<double>(counts[i].total, 0.5), sure = 1 / (covered + k_prior);
      const double open = p.area > 0 ? p.open / p.area : 1, seen = p.opaque > 0 ? p.visible / p.opaque : 1;
      leaves.push_back({n.drawn.centre(), facing(p), p.area, covered,
                        covered * sure * (counts[i].sole + k_prior * open),
                        covered * sure * (0.5 * counts[i].seen + k_prior * seen), n.group});
      alone_.push_back(std::min(leaves.back().sole / covered, 1.0));
    }
    weights_.room = room(counts);
    // Of very many leaves more at a time: each of them matters less.
    const double share = options_.round * std::clamp(std::sqrt(double(alive_.size()) / 1e4), 1.0, 2.0);
    weights_.most = std::max<std::size_t>(1, std::size_t(share * double(alive_.size())));
    const std::vector<LeafMatch> matches = match_leaves(leaves, weights_);
    std::vector<Merge> merges(matches.size());
    tbb::enumerable_thread_specific<LeafViews::Exchange> exchanges(
        [&] { return LeafViews::Exchange(*views_); });
    tbb::parallel_for(std::size_t{0}, matches.size(),
                      [&](std::size_t i) { merges[i] = merge_of(matches[i], exchanges.local()); });
    std::stable_sort(merges.begin(), merges.end(),
                     [](const Merge& x, const Merge& y) { return x.price < y.price; });
    merges.resize((merges.size() * 3 + 3) / 4);
    // What does not fit waits: it may fit with another.
    const auto late =
        std::stable_partition(merges.begin(), merges.end(), [](const Merge& m) { return m.fits; });
    merges.erase(std::max(late, merges.begin() + 1), merges.end());
    for (Merge& m : merges) apply(m);
    std::erase(alive_, k_none);
  }

  // What the cores may still take: of a crown in which leaves hide one another k_layers times over, nothing.
  double room(std::span<const LeafViews::Count> counts) {
    double covered = 0, seen = 0, area = 0, hidden = 0;
    for (const LeafViews::Count& c : counts) covered += c.total, seen += 0.5 * c.seen;
    if (hidden_share_ < 0) hidden_share_ = covered > 0 ? std::max(0.0, 1 - k_layers * seen / covered) : 0;
    for (const std::uint32_t n : alive_) {
      area += nodes_[n].patch.area;
      if (nodes_[n].core) hidden += nodes_[n].patch.area;
    }
    return hidden_share_ * area - hidden;
  }

  // Coverage is held where it was: the more there is too much of it, the less may be gained.
  void weigh(double coverage) {
    const double too_much = std::clamp(20 * (coverage - 1), -1.0, 1.0);
    weights_.window = options_.window, weights_.largest = shape_.largest, weights_.other = options_.other;
    weights_.lost = 1 - too_much, weights_.gained = 1 + too_much;
  }

  static Double3 facing(const Patch& p) {
    if (!(p.area > 0)) return {0, 1, 0};
    const auto& m = p.facing.m;
    const std::array<Double3, 3> columns{{{m[0], m[3], m[4]}, {m[3], m[1], m[5]}, {m[4], m[5], m[2]}}};
    const Double3* best = &columns[0];
    for (const Double3& c : columns)
      if (dot(c, c) > dot(*best, *best)) best = &c;
    const Double3 n = normalized(*best);
    return n * std::sqrt(std::clamp(p.facing.along(n) / p.area, 0.0, 1.0));
  }

  double limit(double area) const { return shape_.largest > 0 ? std::min(area, shape_.largest) : area; }

  // The best that can take the place of the alive leaves of a match.
  Merge merge_of(const LeafMatch& match, LeafViews::Exchange& exchange) const {
    Merge out{match.guests, {}, 0, match.core};
    out.members.insert(out.members.begin(), match.host);
    Patch sum;
    std::vector<ViewedLeaf> gone;
    double triangles = 0;
    const Node* look = nullptr;
    for (const std::uint32_t m : out.members) {
      const Node& n = nodes_[alive_[m]];
      sum += n.patch, gone.push_back(viewed(n)), triangles += double(n.drawn.faces.size());
      if (look == nullptr || n.patch.visible > look->patch.visible) look = &n;
    }
    exchange.remove(out.members, gone);
    const double area = limit(sum.area);
    const auto consider = [&](Successor s, const Node& like) {
      s.cost = cost(s, like, exchange) + missing(s.drawn, area);
      if (s.cost < out.successor.cost) out.successor = std::move(s);
      return out.successor.cost < k_good;
    };
    bool good = false;
    // First about their centres; the vertices of the better one tell to which side it should grow.
    const auto grow = [&](std::uint32_t k, std::uint32_t about) {
      const Node& n = nodes_[alive_[k]];
      if (good || n.drawn.faces.size() > 2 || about > n.drawn.vertices.size()) return;
      if (std::optional<Drawn> d = grown(n, area, about)) good = consider({std::move(*d), k}, n);
    };
    grow(match.host, 0);
    if (match.guests.size() == 1) grow(match.guests.front(), 0);
    const std::uint32_t better = out.successor.like == k_none ? match.host : out.successor.like;
    for (std::uint32_t about = 1; about <= 4; ++about) grow(better, about);
    if (!good) good = consider(between(sum, *look), *look);
    const Node& like = out.successor.like == k_none ? *look : nodes_[alive_[out.successor.like]];
    if (!good && sum.area > 6 * mean_area_) search(out.successor, like, area, exchange);
    out.fits = out.successor.drawn.area() > 0.99 * area;
    out.successor.displacement = displaced(out.members, out.successor);
    out.price = out.successor.cost / std::max(triangles - double(out.successor.drawn.faces.size()), 0.5);
    return out;
  }

  // What the area costs that a successor lacks: as much as if all of it was to be seen.
  double missing(const Drawn& drawn, double area) const {
    const double pixel = views_->pixel();
    return LeafViews::k_views * std::max(area - drawn.area(), 0.0) / (2 * pixel * pixel);
  }

  double cost(const Successor& s, const Node& like, LeafViews::Exchange& exchange) const {
    const LeafViews::Change c = exchange.add({s.drawn.viewed, mask_of(like)}, s.like);
    return c.covered + weights_.other * c.other;
  }

  // Compass search: moves, turns and stretches a large leaf to where it does least harm.
  void search(Successor& best, const Node& like, double area, LeafViews::Exchange& exchange) const {
    double step = 1;
    for (int round = 0; round < 4; ++round) {
      const double before = best.cost;
      for (int way = 0; way < 14; ++way) {
        std::optional<Drawn> d = varied(best.drawn, way / 2, way % 2 != 0 ? -step : step);
        if (!d) continue;
        Successor s{std::move(*d), best.like};
        s.cost = cost(s, like, exchange) + missing(s.drawn, area);
        if (s.cost < best.cost) best = std::move(s);
      }
      if (best.cost >= before) step /= 2;
    }
  }

  // 0-2: moved along an axis, 3-5: turned about one, 6: stretched.
  std::optional<Drawn> varied(const Drawn& drawn, int what, double step) const {
    Drawn out = drawn;
    const Double3 c = drawn.centre();
    const double size = std::sqrt(drawn.area());
    const ViewedTriangle& t = drawn.viewed.front();
    const Double3 u = normalized(t.corners[1] - t.corners[0]);
    const Double3 n = normalized(cross(u, t.corners[2] - t.corners[0]));
    const std::array<Double3, 3> axes{u, cross(n, u), n};
    Double3 move{};
    if (what < 3) move = axes[what] * (0.35 * step * size);
    const Double3 &p = axes[(what + 1) % 3], &q = axes[(what + 2) % 3];
    const double cosine = std::cos(0.5 * step), sine = std::sin(0.5 * step), stretch = std::exp(0.3 * step);
    const auto turned = [&](const Double3& v) {
      const double x = dot(v, p), y = dot(v, q);
      return v + p * (x * (cosine - 1) - y * sine) + q * (x * sine + y * (cosine - 1));
    };
    const auto stretched = [&](const Double3& v) {
      return v + axes[0] * (dot(v, axes[0]) * (stretch - 1)) +
             axes[1] * (dot(v, axes[1]) * (1 / stretch - 1));
    };
    std::vector<Double3> corners;
    for (SpectrumVertex& v : out.vertices) {
      const Double3 r = to_double(v.position) - c;
      corners.push_back(c + (what < 3 ? r + move : what < 6 ? turned(r) : stretched(r)));
      if (what >= 3 && what < 6) v.normal = to_float(normalized(turned(to_double(v.normal))));
    }
    if (!inside(corners)) return {};
    for (std::size_t i = 0; i < corners.size(); ++i) out.vertices[i].position = to_float(corners[i]);
    out.see();
    return out;
  }

  bool inside(std::span<const Double3> corners) const {
    return field_.excess(corners) <= 1.1 * k_margin * std::max(field_.width(), 0.0);
  }

  // The leaf itself, grown about its centre (0) or one of its vertices (1, ...).
  // Nothing when it does not fit into the crown's hull.
  std::optional<Drawn> grown(const Node& node, double area, std::uint32_t about) const {
    Drawn out = node.drawn;
    const double now = out.area();
    const Double3 fixed = about == 0 ? out.centre() : to_double(out.vertices[about - 1].position);
    const double by = now > 0 ? std::sqrt(area / now) : 1;
    std::vector<Double3> corners;
    bool outside = area > 16 * field_.cell() * field_.cell();
    for (const SpectrumVertex& v : out.vertices) {
      corners.push_back(fixed + (to_double(v.position) - fixed) * by);
      outside = outside || field_.at(corners.back()).emptiness > 0;
    }
    if (outside) {
      const double margin = k_margin * field_.width();
      const Double3 back = field_.way_back(corners, margin);
      for (Double3& c : corners) c += back;
      if (!inside(corners)) return {};
    }
    for (std::size_t c = 0; c < corners.size(); ++c) out.vertices[c].position = to_float(corners[c]);
    out.see();
    return out;
  }

  // What fits nowhere is cut to what does.
  void fit(std::vector<Double3>& corners) const {
    constexpr double k_cut = 0.9;
    for (int tries = 0; tries < 16 && !inside(corners); ++tries) {
      Double3 centre{};
      for (const Double3& c : corners) centre += c / double(corners.size());
      for (Double3& c : corners) c = centre + (c - centre) * k_cut;
      const Double3 back = field_.way_back(corners, k_margin * field_.width());
      for (Double3& c : corners) c += back;
    }
  }

  Successor between(const Patch& sum, const Node& look) const {
    ShapeOptions options = shape_;
    options.card = pieces_.list[look.piece].cut == LeafCut::card;
    options.textured = pieces_.list[look.piece].card;
    const LeafShape shape = leaf_shape(sum, &field_, offset_, options);
    Successor out;
    const bool agree = dot(sum.shading, sum.shading) > 0.25 * sum.area * sum.area;
    const Double3 faces = dot(shape.normal, sum.shading) < 0 ? -shape.normal : shape.normal;
    const Float3 normal = to_float(agree ? normalized(sum.shading) : faces);
    const std::uint32_t triangle =
        look.triangle == k_none ? pieces_.triangles[pieces_.list[look.piece].first] : look.triangle;
    const std::array<Float2, 4> uv = pieces_.texcoords(look.piece, triangle);
    const int n = options.card ? 4 : 3;
    std::vector<Double3> corners(shape.corners.begin(), shape.corners.begin() + n);
    fit(corners);
    for (int c = 0; c < n; ++c) out.drawn.vertices.push_back({to_float(corners[c]), normal, uv[c]});
    out.drawn.faces = {{0, 1, 2}};
    if (options.card) out.drawn.faces.push_back({0, 2, 3});
    const Double3 front = cross(shape.corners[1] - shape.corners[0], shape.corners[2] - shape.corners[0]);
    if (dot(front, to_double(normal)) < 0)
      for (Face& f : out.drawn.faces) std::swap(f[1], f[2]);
    out.drawn.see();
    return out;
  }

  // How far the ground that only these leaves cover is from what is drawn for them: what others cover too
  // leaves no hole. No less than half of the size of a leaf that goes. Adds up from merge to merge.
  double displaced(std::span<const std::uint32_t> members, const Successor& successor) const {
    double worst = 0;
    for (const std::uint32_t m : members) {
      const Node& n = nodes_[alive_[m]];
      if (m == successor.like) {
        worst = std::max(worst, n.displacement);
        continue;
      }
      if (alone_[m] < k_hidden) continue;
      const double moved = n.displacement + distance(n.drawn.centre(), successor.drawn.centre());
      worst = std::max({worst, std::sqrt(alone_[m]) * moved, 0.5 * std::sqrt(n.drawn.area())});
    }
    return worst;
  }

  // One leaf after the other joins the first, which grows toward what it is to be in the end.
  void apply(const Merge& merge) {
    std::vector<std::uint32_t> gone;
    for (const std::uint32_t m : merge.members) gone.push_back(alive_[m]), alive_[m] = k_none;
    builder_.step(merge.successor.displacement);
    for (const std::uint32_t n : gone) dissolve(n, gone);
    for (const std::uint32_t n : gone)
      if (nodes_[n].element != k_none) builder_.remove(nodes_[n].element);
    std::uint32_t look = gone.front();
    for (const std::uint32_t n : gone)
      if (nodes_[n].patch.visible > nodes_[look].patch.visible) look = n;
    if (merge.successor.like != k_none)
      for (std::size_t i = 0; i < gone.size(); ++i)
        if (merge.members[i] == merge.successor.like) look = gone[i];
    Node node = nodes_[look];
    node.displacement = merge.successor.displacement;
    node.core = merge.core || nodes_[gone.front()].core;
    node.patch = {}, node.radius = nodes_[gone.front()].radius, node.group = nodes_[gone.front()].group;
    for (const std::uint32_t n : gone) {
      node.patch += nodes_[n].patch;
      node.radius = ancestors_.common(node.radius, nodes_[n].radius);
      if (nodes_[n].group != node.group) node.group = k_none;
    }
    node.drawn = merge.successor.drawn;
    node.element = put(node);
    nodes_.push_back(std::move(node));
    alive_[merge.members.front()] = static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  // A piece of the source goes as a whole: those of its triangles that stay get elements of their own.
  void dissolve(std::uint32_t node, std::span<const std::uint32_t> gone) {
    if (node >= first_node_.back()) return;  // made by a merge
    const std::uint32_t p = nodes_[node].piece;
    if (piece_element_[p] == k_none) return;
    builder_.remove(piece_element_[p]);
    piece_element_[p] = k_none;
    for (std::uint32_t n = first_node_[p]; n < first_node_[p + 1]; ++n) {
      if (std::find(gone.begin(), gone.end(), n) != gone.end()) continue;
      nodes_[n].element = builder_.element(pieces_.list[p].material, nodes_[n].radius,
                                           std::span(&pieces_.part.triangles[nodes_[n].triangle], 1));
    }
  }

  std::uint32_t put(const Node& node) {
    std::vector<std::uint32_t> numbers;
    for (const SpectrumVertex& v : node.drawn.vertices) numbers.push_back(builder_.vertex(v));
    std::vector<Face> faces = node.drawn.faces;
    for (Face& f : faces)
      for (std::uint32_t& v : f) v = numbers[v];
    return builder_.element(pieces_.list[node.piece].material, node.radius, faces);
  }

  const LeafPieces& pieces_;
  Looks looks_;
  LeafCollapseOptions options_;
  CrownField field_;
  RadiusAncestors ancestors_;
  SpectrumBuilder builder_;
  ShapeOptions shape_;
  MatchOptions weights_;
  DoubleBox box_;
  Double3 offset_;
  std::optional<LeafViews> views_;
  double asked_ = 0, mean_area_ = 0, hidden_share_ = -1;
  std::uint64_t turns_ = 0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> alive_;
  std::vector<double> alone_;  // of each alive leaf the share that no other covers
  std::vector<std::uint32_t> first_node_, piece_element_;
};

}  // namespace

Spectrum collapse_spectrum(const Tree& tree, const Looks& looks, const LeafCollapseOptions& options) {
  const LeafPieces pieces = leaf_pieces(tree);
  return Collapse(tree, looks, pieces, options).run();
}

}  // namespace copse
