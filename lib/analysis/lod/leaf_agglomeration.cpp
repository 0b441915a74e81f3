#include "lib/analysis/lod/leaf_agglomeration.h"

#include "lib/analysis/lod/crown_field.h"
#include "lib/analysis/lod/leaf_elements.h"
#include "lib/analysis/lod/leaf_matching.h"
#include "lib/analysis/lod/leaf_occlusion.h"
#include "lib/analysis/lod/leaf_shape.h"
#include "lib/analysis/lod/radius_ancestors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace copse {
namespace {

constexpr std::size_t k_window = 4;  // neighbours looked at on each side
constexpr double k_round = 0.25;     // of the leaves: how many at most go in a round
constexpr double k_asked = 0.25;     // of the leaves: when so many have gone it is asked whether to go on
constexpr int k_guests = 2;          // of one host in a round
constexpr float k_other = 0.04f;     // what ground counts that shows another leaf, beside one lost or gained
constexpr float k_near = 0.005f;  // of what a match covers: what one as far apart as the crown is wide costs
constexpr float k_stranger = 4;   // squared: how much farther leaves of another group are
constexpr double k_largest = 0.36;  // of the crown's cross-section: a leaf that fits inside
constexpr double k_hidden = 0.02;   // of a leaf: if it covers no more alone, it may be anywhere
constexpr int k_views = 6;          // from which it is seen what hides behind what,
constexpr double k_samples = 12;    // in so many points of a leaf,
constexpr float k_few = 1.5f;       // pixels: less is drawn as points
constexpr float k_doubt = 3;        // of which the field's word is worth so many
constexpr float k_kept = 0.35f;     // of a leaf's ground, what even a host at its place does not cover

// An alive leaf, as the search for hosts sees it.
struct Leaf {
  Float3 centre;
  float area = 0;
  float sole = 0, seen = 0;  // of its area: covers what nothing else does; is seen
  float harm = 0;            // of growing, per area
  std::uint32_t group = k_none, node = k_none;
  bool full = false;  // does not fit into the crown's hull any larger
};

struct Offer {
  float price = 0;
  std::uint32_t guest = k_none, host = k_none;
  friend bool operator<(const Offer& x, const Offer& y) {
    return x.price != y.price ? x.price < y.price : x.guest < y.guest;
  }
};

using Four [[gnu::vector_size(16)]] = float;
using FourNumbers [[gnu::vector_size(16)]] = std::uint32_t;

template <class To, class From>
To four_at(const From* first) {
  To four;
  std::memcpy(&four, first, sizeof four);
  return four;
}

// The alive leaves in columns, and as many more that are no one's host.
struct Neighbours {
  std::vector<float> x, y, z, area, sole, seen, harm, full;  // full: infinite for one that is
  std::vector<std::uint32_t> group;

  void take(std::span<const Leaf> leaves) {
    for (std::vector<float>* column : {&x, &y, &z, &area, &sole, &seen, &harm})
      column->assign(leaves.size() + k_window, 0);
    full.assign(leaves.size() + k_window, std::numeric_limits<float>::infinity());
    group.assign(leaves.size() + k_window, k_none);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Leaf& l = leaves[i];
      x[i] = l.centre.x, y[i] = l.centre.y, z[i] = l.centre.z, area[i] = l.area, sole[i] = l.sole;
      seen[i] = l.seen, harm[i] = l.harm, group[i] = l.group, full[i] = l.full ? full[i] : 0;
    }
  }
};

CrownField field_of(const LeafPieces& pieces) {
  std::vector<FoliageTriangle> triangles(pieces.part.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c)
      triangles[t].corners[c] = to_double(pieces.part.vertices[pieces.part.triangles[t][c]].position);
    triangles[t].opacity = pieces.opacity_of(t);
  }
  return {triangles, std::clamp(static_cast<int>(std::cbrt(double(triangles.size()))), 8, 64),
          k_quick_margin};
}

const AlphaMask* mask_of(const Looks& looks, std::uint32_t m) {
  return m < looks.masks.size() && !looks.masks[m].opaque.empty() ? &looks.masks[m] : nullptr;
}

class Agglomeration {
 public:
  Agglomeration(const LeafPieces& pieces, const CrownField& field, const RadiusAncestors& ancestors,
                LeafElements& elements)
      : pieces_(pieces), field_(field), ancestors_(ancestors), elements_(elements) {
    largest_ = k_largest * field_.cross_section();
    const double width = field_.hull().width();
    per_width_ = width > 0 ? static_cast<float>(1 / (width * width)) : 0;
    gather();
  }

  // Leaves that no one misses leave first.
  void run(const Looks& looks, std::size_t full) {
    leave_hidden(looks, double(full));
    while (alive_.size() > 1) round();
  }

  template <class Good>
  QuickMerges run_until(double triangles, const Good& good) {
    host_.resize(nodes_.size());
    std::iota(host_.begin(), host_.end(), 0u);
    QuickMerges out;
    std::size_t asked = alive_.size();
    for (bool goes_on = true; goes_on && alive_.size() > 1 && triangles_ > triangles;) {
      round();
      if (double(alive_.size()) > (1 - k_asked) * double(asked)) continue;
      asked = alive_.size(), goes_on = good(left());
    }
    out.leaves = left();
    // A host may have gone to another later: hosts of hosts, until one that is left.
    for (std::uint32_t& h : host_)
      while (host_[h] != h) h = host_[h];
    out.host = std::move(host_);
    return out;
  }

 private:
  struct Node {
    std::uint32_t radius = k_none;
    std::uint32_t drawn = k_none;  // in made_, once it has grown
    double area = 0;
  };

  std::vector<QuickMerges::Leaf> left() {
    std::vector<QuickMerges::Leaf> out;
    for (const Leaf& l : alive_)
      out.push_back({l.node, nodes_[l.node].radius, l.group,
                     nodes_[l.node].drawn == k_none ? elements_.drawn(l.node) : made_[nodes_[l.node].drawn]});
    return out;
  }

  void gather() {
    std::vector<Leaf> leaves(elements_.size());
    std::vector<Double3> centres(elements_.size());
    nodes_.resize(elements_.size());
    for (std::uint32_t n = 0; n < leaves.size(); ++n) {
      const LeafPiece& piece = pieces_.list[elements_.piece(n)];
      double area = 0;
      Double3 sum{}, corners{};
      for (const std::uint32_t t : elements_.source(n)) {
        const auto at = [&](int c) {
          return to_double(pieces_.part.vertices[pieces_.part.triangles[t][c]].position);
        };
        const Double3 a = at(0), b = at(1), c = at(2), normal = cross(b - a, c - a);
        const double own = 0.5 * std::sqrt(dot(normal, normal));
        area += own, sum += (a + b + c) * (own / 3), corners += (a + b + c) / 3;
      }
      centres[n] = area > 0 ? sum / area : corners / double(elements_.source(n).size());
      leaves[n].group = piece.group, leaves[n].node = n;
      nodes_[n].radius = piece.radius, nodes_[n].area = area;
      place(leaves[n], centres[n], area, field_.at(centres[n]).openness, field_.exposure(centres[n]));
    }
    for (const std::uint32_t n : curve_order(centres)) alive_.push_back(leaves[n]);
    triangles_ = double(pieces_.triangles.size());
  }

  // What no one misses leaves, and comes back, merged, when fewer leaves are needed than that would take.
  void leave_hidden(const Looks& looks, double full) {
    const double least = Occlusion::k_least * full;
    if (alive_.size() < 2 || triangles_ <= least) return;
    std::vector<DrawnLeaf::Face> faces;
    DoubleBox box;
    for (const std::uint32_t t : pieces_.triangles) faces.push_back(pieces_.part.triangles[t]);
    for (const SpectrumVertex& v : pieces_.part.vertices) box.grow(to_double(v.position));
    std::vector<ViewedLeaf> leaves;
    float mean = 0;
    for (const Leaf& l : alive_) mean += l.area / float(alive_.size());
    std::vector<float> prior;
    for (const Leaf& l : alive_) {
      const auto source = elements_.source(l.node);
      leaves.push_back({pieces_.part.vertices,
                        std::span(faces).subspan(source.data() - pieces_.triangles.data(), source.size()),
                        mask_of(looks, pieces_.list[elements_.piece(l.node)].material)});
      prior.push_back(mean > 0 ? k_doubt * (l.sole + k_other * l.seen) / mean : 0);
    }
    const Occlusion o = leaves_by_occlusion(leaves, box.centre(), 0.55 * length(box.extent()), box,
                                            {.views = k_views,
                                             .samples = k_samples,
                                             .other = k_other,
                                             .coverage = Occlusion::k_coverage,
                                             .few = k_few,
                                             .least = 1 + std::size_t(least),
                                             .prior = prior});
    if (o.gone.empty()) return;
    double shown = triangles_;
    std::vector<std::uint32_t> order;
    for (const Leaf& l : alive_) order.push_back(l.node);
    std::vector<std::uint32_t> together;
    for (std::size_t i = 0; i < o.gone.size(); ++i) {
      const Leaf& leaf = alive_[o.gone[i]];
      shown -= double(elements_.source(leaf.node).size()), together.push_back(leaf.node);
      if (i + 1 < o.gone.size() && o.step(i + 1) == o.step(i)) continue;
      std::sort(together.begin(), together.end());
      elements_.remove(together), together.clear();
    }
    elements_.hold(order, shown * Occlusion::k_shown);
  }

  static void place(Leaf& leaf, const Double3& centre, double area, double open, double seen) {
    leaf.centre = to_float(centre), leaf.area = static_cast<float>(area);
    leaf.sole = static_cast<float>(area * open), leaf.seen = static_cast<float>(area * seen);
    leaf.harm = static_cast<float>(open + k_other * seen);
  }

  void round() {
    find_hosts();
    const auto most = std::max<std::size_t>(1, static_cast<std::size_t>(k_round * double(alive_.size())));
    if (most < offers_.size()) std::nth_element(offers_.begin(), offers_.begin() + most, offers_.end());
    offers_.resize(std::min(most, offers_.size()));
    std::sort(offers_.begin(), offers_.end());
    taken_.assign(alive_.size(), 0);
    std::size_t merged = 0;
    for (const Offer& o : offers_) merged += merge(o, false);
    // Nothing fits: the cheapest are cut to what does.
    for (std::size_t i = 0; merged == 0 && i < (offers_.size() + 15) / 16; ++i) merge(offers_[i], true);
    std::erase_if(alive_, [](const Leaf& l) { return l.node == k_none; });
    elements_.show_at(alive_.size() == 1 ? 0 : triangles_);
  }

  // Every leaf's best host, four neighbours side by side.
  void find_hosts() {
    const std::size_t n = alive_.size();
    near_.take(alive_);
    price_.assign(n + k_window, std::numeric_limits<float>::max()), host_of_.resize(n + k_window);
    for (std::size_t i = 0; i < n; ++i)  // where all are full
      host_of_[i] = static_cast<std::uint32_t>(i + 1 < n ? i + 1 : i - 1);
    const auto largest = static_cast<float>(largest_);
    for (std::size_t i = 0; i < n; ++i) {
      const Leaf& a = alive_[i];
      const auto b = [&](const std::vector<float>& all) { return four_at<Four>(&all[i + 1]); };
      const Four dx = a.centre.x - b(near_.x), dy = a.centre.y - b(near_.y), dz = a.centre.z - b(near_.z);
      const Four apart = dx * dx + dy * dy + dz * dz, area = a.area + b(near_.area),
                 share = k_kept + 0.5f * apart / area;
      const Four lost = area > 0 ? (share < 1 ? share : Four{} + 1) : Four{};
      const Four strange =
          four_at<FourNumbers>(&near_.group[i + 1]) == a.group ? Four{} + 1 : Four{} + k_stranger;
      const Four over = 20 * (area - largest);
      const auto is_too_large = (largest > 0) & (area > largest);
      const Four far = k_near * area * apart * per_width_ * strange + (is_too_large ? over : Four{});
      const Four b_goes =
          far + lost * (b(near_.sole) + a.harm * b(near_.area)) + k_other * b(near_.seen) + near_.full[i];
      const Four a_goes = far + lost * (a.sole + b(near_.harm) * a.area) + k_other * a.seen + b(near_.full);
      for (std::size_t k = 0; k < k_window; ++k) {
        const std::size_t j = i + 1 + k;
        if (b_goes[k] < price_[j]) price_[j] = b_goes[k], host_of_[j] = static_cast<std::uint32_t>(i);
        if (a_goes[k] < price_[i]) price_[i] = a_goes[k], host_of_[i] = static_cast<std::uint32_t>(j);
      }
    }
    offers_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) offers_[i] = {price_[i], i, host_of_[i]};
  }

  std::size_t merge(const Offer& o, bool cut) {
    Leaf &host = alive_[o.host], &guest = alive_[o.guest];
    if (host.node == k_none || guest.node == k_none || taken_[o.guest] != 0 || taken_[o.host] >= k_guests)
      return 0;
    Node &h = nodes_[host.node], &g = nodes_[guest.node];
    DrawnLeaf leaf = drawn(host.node);
    const double area = h.area + g.area;
    const Double3 before = leaf.centre();
    if (!grow(leaf, largest_ > 0 ? std::min(area, largest_) : area, to_double(guest.centre),
              guest.sole > k_hidden * guest.area, cut)) {
      host.full = true;
      return 0;
    }
    const Double3 centre = leaf.centre();
    h.radius = ancestors_.common(h.radius, g.radius);
    if (host.group != guest.group) host.group = k_none;
    const std::uint32_t nodes[] = {host.node, guest.node};
    const LeafPiece& piece = pieces_.list[elements_.piece(host.node)];
    elements_.merge(nodes, leaf, piece.material, h.radius);
    const auto faces_of = [&](const Node& node, std::uint32_t n) {
      return node.drawn == k_none ? elements_.source(n).size() : made_[node.drawn].faces;
    };
    triangles_ -= double(faces_of(h, host.node) + faces_of(g, guest.node) - leaf.faces);
    if (h.drawn == k_none) h.drawn = static_cast<std::uint32_t>(made_.size()), made_.emplace_back();
    made_[h.drawn] = leaf, h.area = leaf.area();
    see(host, leaf, h.area, distance(before, centre));
    if (!host_.empty()) host_[guest.node] = host.node;
    guest.node = k_none, ++taken_[o.host];
    return 1;
  }

  DrawnLeaf drawn(std::uint32_t node) {
    if (nodes_[node].drawn != k_none) return made_[nodes_[node].drawn];
    const DrawnLeaf leaf = elements_.drawn(node);
    return leaf.frond == nullptr ? leaf : stand_in(node);
  }
  // A card for a piece of many triangles.
  DrawnLeaf stand_in(std::uint32_t node) {
    const std::uint32_t p = elements_.piece(node);
    Patch patch;
    Double3 shading{};
    const Double3 offset =
        to_double(pieces_.part.vertices[pieces_.part.triangles[elements_.source(node)[0]][0]].position);
    for (const std::uint32_t t : elements_.source(node)) {
      std::array<Double3, 3> corners;
      for (int c = 0; c < 3; ++c) {
        const SpectrumVertex& v = pieces_.part.vertices[pieces_.part.triangles[t][c]];
        corners[c] = to_double(v.position) - offset, shading += to_double(v.normal);
      }
      Patch own = patch_of(corners, 1, 1);
      own.up = pieces_.up_of(t) * own.area;
      patch += own;
    }
    const LeafShape shape =
        leaf_shape(patch, nullptr, offset,
                   {.card = pieces_.list[p].cut == LeafCut::card, .textured = true, .search = false});
    return leaf_of_shape(pieces_, p, elements_.source(node).front(), shape.corners,
                         dot(shape.normal, shading) < 0 ? -shape.normal : shape.normal);
  }

  // Scales the leaf to the area within the crown's hull. False when it does not fit, unless it may be cut.
  bool grow(DrawnLeaf& leaf, double area, const Double3& toward, bool seen, bool cut) const {
    const double now = leaf.area(), by = now > 0 ? std::sqrt(area / now) : 1;
    const Double3 centre = leaf.centre();
    // What is seen of the guest is covered better by a leaf that grows to its side.
    std::uint32_t farthest = 0;
    double least = 0;
    for (std::uint32_t k = 0; seen && k < leaf.corners; ++k) {
      const double along = dot(to_double(leaf.corner[k].position) - centre, toward - centre);
      if (along < least) least = along, farthest = k + 1;
    }
    const DrawnLeaf source = leaf;
    for (const std::uint32_t about : {farthest, 0u}) {
      const Double3 fixed = about == 0 ? centre : to_double(source.corner[about - 1].position);
      if (scale(leaf, source, fixed, by)) return true;
      if (farthest == 0) break;
    }
    for (double less = 0.9 * by; cut && less > 0.01; less *= 0.9)
      if (scale(leaf, source, centre, less)) return true;
    return cut;
  }

  bool scale(DrawnLeaf& leaf, const DrawnLeaf& source, const Double3& fixed, double by) const {
    std::array<Double3, 4> corners;
    for (std::uint32_t k = 0; k < leaf.corners; ++k)
      corners[k] = fixed + (to_double(source.corner[k].position) - fixed) * by;
    const auto all = std::span(corners).first(leaf.corners);
    const auto move = field_.hull().move_in(all, k_quick_margin, 0.9 * k_quick_margin);
    if (!move) return false;
    for (Double3& c : all) c += *move;
    for (std::uint32_t k = 0; k < leaf.corners; ++k) leaf.corner[k].position = to_float(corners[k]);
    return true;
  }

  // How much of a grown leaf is seen where it is now.
  void see(Leaf& host, const DrawnLeaf& leaf, double area, double moved) const {
    const Double3 centre = leaf.centre();
    if (area < 0.25 * field_.cell() * field_.cell() && moved < field_.cell()) {
      const double now = host.area;
      place(host, centre, area, now > 0 ? host.sole / now : 1, now > 0 ? host.seen / now : 1);
      return;
    }
    double open = field_.at(centre).openness, seen = field_.exposure(centre);
    for (const SpectrumVertex& v : leaf.vertices()) {
      const Double3 p = (to_double(v.position) + centre) * 0.5;
      open += field_.at(p).openness, seen += field_.exposure(p);
    }
    place(host, centre, area, open / (leaf.corners + 1), seen / (leaf.corners + 1));
  }

  const LeafPieces& pieces_;
  const CrownField& field_;
  const RadiusAncestors& ancestors_;
  LeafElements& elements_;
  double triangles_ = 0;             // now
  std::vector<std::uint32_t> host_;  // of each node, if anyone asks: who took it in
  double largest_ = 0;
  float per_width_ = 0;
  std::vector<Leaf> alive_;  // in the order of the curve
  Neighbours near_;
  std::vector<float> price_;            // that each alive leaf's best host asks,
  std::vector<std::uint32_t> host_of_;  // and which that is
  std::vector<Offer> offers_;
  std::vector<std::uint8_t> taken_;  // guests of each alive leaf in this round
  std::vector<Node> nodes_;
  std::vector<DrawnLeaf> made_;
};

}  // namespace

QuickMerges merge_quickly(const LeafPieces& pieces, const CrownField& field, const RadiusAncestors& ancestors,
                          LeafElements& elements, std::size_t triangles,
                          const std::function<bool(std::span<const QuickMerges::Leaf>)>& good) {
  return Agglomeration(pieces, field, ancestors, elements).run_until(double(triangles), good);
}

Spectrum agglomerate_leaves(const Tree& tree, const Looks& looks, const LeafPieces& pieces,
                            std::size_t full) {
  const CrownField field = field_of(pieces);
  const RadiusAncestors ancestors(tree);
  LeafElements elements(pieces);
  Agglomeration(pieces, field, ancestors, elements).run(looks, full);
  return elements.finish();
}

}  // namespace copse
