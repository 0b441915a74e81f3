#include "lib/formats/levels/spectrum_leaves.h"

#include "lib/formats/levels/leaf_forest.h"
#include "lib/formats/levels/made_leaf.h"
#include "lib/formats/little_endian.h"
#include "lib/formats/packing/leaf_frame.h"
#include "lib/formats/packing/range_coder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numeric>

namespace copse::spectrum_leaves {
namespace {

using Node = LeafForest::Node;

constexpr std::uint32_t k_far = 4096;  // radii up from a leaf's that are counted

// Numbers of a sorted set, by rank, in logarithmic time.
class Ranks {
 public:
  explicit Ranks(std::size_t n) : sums_(n + 1, 0), top_(std::bit_floor(n)) {}
  void add(std::size_t i, int by) {
    for (++i; i < sums_.size(); i += i & (~i + 1)) sums_[i] += by;
    count_ += by;
  }
  std::uint32_t before(std::size_t i) const {
    int sum = 0;
    for (; i > 0; i -= i & (~i + 1)) sum += sums_[i];
    return static_cast<std::uint32_t>(sum);
  }
  // The member that has `rank` members before it.
  std::size_t at(std::uint32_t rank) const {
    std::size_t i = 0;
    auto left = static_cast<int>(rank);
    for (std::size_t step = top_; step > 0; step /= 2)
      if (i + step < sums_.size() && sums_[i + step] <= left) i += step, left -= sums_[i];
    return i;
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(count_); }

 private:
  std::vector<int> sums_;
  std::size_t top_;
  int count_ = 0;
};

class Coder {
 public:
  Coder(RangeCoder& coder, LeafForest& forest, std::vector<float>& errors, const Tree& tree,
        const PartTriangles& part, double texcoord_step)
      : c_(coder),
        f_(forest),
        errors_(errors),
        tree_(tree),
        part_(part),
        leaves_(coder, part, texcoord_step) {}

  std::string run() {
    if (std::string wrong = code_pieces(); !wrong.empty()) return wrong;
    if (std::string wrong = code_forest(); !wrong.empty()) return wrong;
    leaves_.sum(f_);
    if (std::string wrong = code_steps(); !wrong.empty()) return wrong;
    code_errors();
    return code_nodes();
  }

 private:
  // Triangles of a leaf that are one element at first.
  std::string code_pieces() {
    if (c_.decoding()) f_.piece_of.assign(part_.triangles.size(), k_none);
    std::uint32_t pieces = 0, radius = 0;
    for (std::size_t leaf = 0; leaf < tree_.leaf_count(); ++leaf) {
      const std::uint32_t base = pieces;
      const std::size_t first = tree_.first_triangle_of_leaf(leaf);
      const std::size_t end = std::min(tree_.first_triangle_of_leaf(leaf + 1), part_.triangles.size());
      for (std::size_t t = first; t < end; ++t) {
        c_.stream("pieces");
        const std::uint64_t back =
            c_.number(piece_[std::min<std::size_t>(t - first, 7)], pieces - f_.piece_of[t]);
        if (back > pieces - base) return "a triangle belongs to a piece of another leaf";
        f_.piece_of[t] = pieces - static_cast<std::uint32_t>(back);
        if (back != 0) continue;
        ++pieces;
        if (c_.decoding()) f_.radii.push_back(0);
        std::uint32_t& own = f_.radii[pieces - 1];
        if (c_.bit(same_radius_, own == radius - 1))
          own = radius - 1;
        else
          own = (radius = static_cast<std::uint32_t>(c_.number(piece_radius_, own + 1u))) - 1;
        if (c_.failed()) return "it ends in the pieces";
      }
    }
    return "";
  }

  std::string code_forest() {
    const std::uint32_t count = c_.plain(32, static_cast<std::uint32_t>(f_.nodes.size()));
    // Each triangle goes once or twice, and no merge makes more than it takes.
    if (count == 0 || count > 4 * part_.triangles.size() + std::size_t{1} + c_.left() * 8)
      return "it counts more leaves than it can hold";
    if (c_.decoding()) f_.nodes.resize(1), f_.sources.reserve(part_.triangles.size());
    used_.assign(part_.triangles.size(), 0);
    std::vector<std::uint32_t> open{0};
    std::uint32_t sources = 0, nodes = 1;
    while (!open.empty()) {
      const std::uint32_t n = open.back();
      open.pop_back();
      Node& node = f_.nodes[n];
      c_.stream("forest");
      const std::uint64_t children = c_.number(children_, node.children),
                          own = c_.number(own_[std::min<std::uint64_t>(children, 3)], node.sources);
      if (children > count - nodes || own > part_.triangles.size() - sources)
        return "a leaf stands for more than there is";
      node.first_child = nodes, node.children = static_cast<std::uint32_t>(children);
      node.first_source = sources, node.sources = static_cast<std::uint32_t>(own);
      for (std::uint32_t i = 0; i < node.sources; ++i, ++sources)
        if (!code_source(sources)) return "a triangle goes twice";
      nodes += node.children;
      if (c_.decoding()) f_.nodes.resize(nodes);
      for (std::uint32_t k = nodes; k-- > nodes - f_.nodes[n].children;)
        f_.nodes[k].parent = n, open.push_back(k);
      if (c_.failed()) return "it ends in the forest";
    }
    return nodes == count && sources == part_.triangles.size() ? "" : "the forest does not hold all leaves";
  }

  // The next triangle that has not gone yet, mostly.
  bool code_source(std::uint32_t i) {
    c_.stream("sources");
    if (c_.decoding()) f_.sources.push_back(0);
    while (next_ < used_.size() && used_[next_]) ++next_;
    const auto expected = static_cast<std::int64_t>(next_);
    const std::int64_t jump = c_.signed_number(jump_[jumped_], std::int64_t{f_.sources[i]} - expected);
    const std::int64_t t = expected + jump;
    if (t < 0 || t >= static_cast<std::int64_t>(used_.size()) || used_[static_cast<std::size_t>(t)])
      return false;
    jumped_ = jump != 0;
    f_.sources[i] = static_cast<std::uint32_t>(t), used_[static_cast<std::size_t>(t)] = 1;
    next_ = static_cast<std::size_t>(t);
    return true;
  }

  // From the last step to the first: which of the leaves that are there was made in it. Large ones are made
  // last, so they are numbered by the area that they stand for.
  std::string code_steps() {
    const std::size_t n = f_.nodes.size();
    std::vector<std::uint32_t> by_area(n), rank(n), order(n);
    std::iota(by_area.begin(), by_area.end(), 0u);
    std::stable_sort(by_area.begin(), by_area.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return leaves_.area(a) > leaves_.area(b); });
    for (std::uint32_t i = 0; i < n; ++i) rank[by_area[i]] = i;
    if (!c_.decoding()) {
      std::iota(order.begin(), order.end(), 0u);
      std::stable_sort(order.begin() + 1, order.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return f_.nodes[a].step > f_.nodes[b].step; });
    }
    Ranks there(n);
    const auto make = [&](const Node& node) {
      for (std::uint32_t k = node.first_child; k < node.first_child + node.children; ++k)
        there.add(rank[k], 1);
    };
    make(f_.nodes[0]);
    std::uint32_t steps = 0;  // from the end
    for (std::size_t i = 1; i < n; ++i) {
      c_.stream("steps");
      const bool together =
          i > 1 && c_.bit(together_, f_.nodes[order[i]].step == f_.nodes[order[i - 1]].step);
      const std::uint32_t wanted = c_.decoding() ? 0 : there.before(rank[order[i]]);
      const std::uint64_t k = c_.number(which_, wanted);
      if (k >= there.size()) return "a step makes a leaf that is not there";
      const std::size_t place = there.at(static_cast<std::uint32_t>(k));
      const std::uint32_t node = by_area[place];
      there.add(place, -1), make(f_.nodes[node]);
      steps += together ? 0 : 1;
      order[i] = node;
      if (c_.decoding()) f_.nodes[node].step = steps;
      if (c_.failed()) return "it ends in the steps";
    }
    if (c_.decoding()) {
      for (std::size_t i = 1; i < n; ++i) f_.nodes[i].step = steps + 1 - f_.nodes[i].step;
      f_.steps = steps;
    } else if (steps != f_.steps) {
      return "a step without a leaf";
    }
    order_.assign(order.rbegin(), order.rend() - 1);
    return "";
  }

  // Rounded up to 11 bits: they are bounds.
  void code_errors() {
    constexpr int k_dropped = 13;
    if (c_.decoding()) errors_.assign(std::size_t{f_.steps} + 1, 0);
    std::uint32_t before = 0;
    for (float& e : errors_) {
      const std::uint32_t bits =
          c_.decoding() ? 0 : (std::bit_cast<std::uint32_t>(e) + (1u << k_dropped) - 1) >> k_dropped;
      c_.stream("errors");
      before += static_cast<std::uint32_t>(c_.number(error_, bits - before));
      e = std::bit_cast<float>(std::min(before << k_dropped, 0x7f7fffffu));
    }
  }

  std::string code_nodes() {
    for (const std::uint32_t n : order_) {
      Node& node = f_.nodes[n];
      c_.stream("made: materials and radii");
      node.drawn = c_.bit(drawn_, node.drawn);
      if (!node.drawn) continue;
      const std::uint32_t like = node.sources > 0 ? f_.sources[node.first_source] : k_none;
      const Node* child = node.children > 0 ? &f_.nodes[node.first_child] : nullptr;
      const std::uint32_t material = like != k_none ? part_.materials[like]
                                     : child        ? child->material
                                                    : k_none;
      const std::uint32_t radius = like != k_none ? f_.radii[f_.piece_of[like]]
                                   : child        ? child->radius
                                                  : k_none;
      if (c_.bit(same_material_, node.material == material))
        node.material = material;
      else
        node.material = static_cast<std::uint32_t>(c_.number(material_, node.material + 1u)) - 1;
      code_radius(node, radius);
      if (std::string wrong = leaves_.code(f_, n); !wrong.empty()) return wrong;
      if (c_.failed()) return "it ends in the leaves";
    }
    return "";
  }

  // So many up from where the first of those that it stands for hangs, or by number.
  void code_radius(Node& node, std::uint32_t from) {
    if (parent_.empty()) parent_ = parents(tree_);
    std::uint64_t up = 0;
    if (!c_.decoding()) {
      std::uint32_t r = from;
      for (std::uint32_t k = 1; k < k_far && up == 0; ++k) {
        if (r == node.radius) up = k;
        if (r >= parent_.size()) break;
        r = parent_[r];
      }
    }
    up = std::min<std::uint64_t>(c_.number(up_, up), k_far);
    if (up == 0) {
      node.radius = static_cast<std::uint32_t>(c_.number(radius_, node.radius + 1u)) - 1;
      return;
    }
    for (std::uint64_t k = 1; k < up && from < parent_.size(); ++k) from = parent_[from];
    node.radius = from;
  }

  RangeCoder& c_;
  LeafForest& f_;
  std::vector<float>& errors_;
  const Tree& tree_;
  const PartTriangles& part_;
  MadeLeaves leaves_;
  std::vector<std::uint8_t> used_;
  std::vector<std::uint32_t> order_, parent_;
  std::size_t next_ = 0;
  bool jumped_ = false;
  std::array<NumberModel, 8> piece_;
  std::array<NumberModel, 4> own_;
  NumberModel piece_radius_, children_, which_, error_, material_, up_, radius_;
  std::array<SignedModel, 2> jump_;
  BitModel same_radius_, together_, drawn_, same_material_;
};

std::string code(RangeCoder& coder, LeafForest& forest, std::vector<float>& errors, const Tree& tree,
                 const PartTriangles& part, int exponent) {
  return std::make_unique<Coder>(coder, forest, errors, tree, part, std::ldexp(1.0, exponent))->run();
}

std::int32_t texcoord_exponent(const Spectrum& s, int bits) {
  double largest = 1;
  for (const SpectrumVertex& v : s.vertices)
    largest = std::max({largest, std::abs(double{v.texcoord.x}), std::abs(double{v.texcoord.y})});
  return std::ilogb(std::min(largest, 4.0)) +
         (std::min(largest, 4.0) > 1.4142 * std::exp2(std::ilogb(std::min(largest, 4.0))) ? 1 : 0) - bits;
}

}  // namespace

std::optional<EncodedSpectrum> encode(const Spectrum& spectrum, const Tree& tree,
                                      const SpectrumCodingOptions& options) {
  const PartTriangles part = leaf_triangles(tree);
  auto forest = leaf_forest(spectrum, part);
  if (!forest) return std::nullopt;
  Spectrum again;
  if (!spectrum_of(*forest, part, again).empty()) return std::nullopt;
  if (again.elements.size() != spectrum.elements.size() ||
      again.triangles.size() != spectrum.triangles.size())
    return std::nullopt;
  for (std::size_t e = 0; e < again.elements.size(); ++e)
    if (again.elements[e].birth != spectrum.elements[e].birth ||
        again.elements[e].death != spectrum.elements[e].death)
      return std::nullopt;
  const LeafForest before = *forest;
  std::vector<float> errors = spectrum.errors.to_vector();
  const std::int32_t exponent = texcoord_exponent(spectrum, options.texcoord_bits);
  RangeCoder coder;
  if (!code(coder, *forest, errors, tree, part, exponent).empty()) return std::nullopt;
  EncodedSpectrum out;
  for (std::size_t n = 0; n < before.nodes.size(); ++n)
    for (std::size_t v = 0; v < before.nodes[n].vertices.size(); ++v)
      out.position_error =
          std::max(out.position_error, distance(to_double(before.nodes[n].vertices[v].position),
                                                to_double(forest->nodes[n].vertices[v].position)));
  out.bytes.resize(4);
  put(std::span(out.bytes), 0, exponent);
  out.streams = coder.costs();
  const std::vector<std::uint8_t> coded = coder.finish();
  out.bytes.insert(out.bytes.end(), coded.begin(), coded.end());
  return out;
}

std::expected<Spectrum, std::string> decode(std::span<const std::uint8_t> bytes, LodMethod method,
                                            const Tree& tree) {
  if (bytes.size() < 4) return std::unexpected("it is cut off");
  const auto exponent = get<std::int32_t>(bytes, 0);
  if (exponent < -30 || exponent > 10)
    return std::unexpected("the step of texture coordinates is out of range");
  const PartTriangles part = leaf_triangles(tree);
  LeafForest forest;
  std::vector<float> errors;
  RangeCoder coder(bytes.subspan(4));
  if (std::string wrong = code(coder, forest, errors, tree, part, exponent); !wrong.empty())
    return std::unexpected(wrong);
  if (!coder.exhausted()) return std::unexpected("it has another length than what it holds");
  Spectrum s;
  s.method = method;
  if (std::string wrong = spectrum_of(forest, part, s); !wrong.empty()) return std::unexpected(wrong);
  s.errors = std::move(errors);
  return s;
}

std::vector<std::uint32_t> leaf_order(const Spectrum& spectrum, const Tree& tree) {
  const PartTriangles part = leaf_triangles(tree);
  const auto forest = leaf_forest(spectrum, part);
  if (!forest) return {};
  std::vector<std::uint32_t> leaf_of(part.triangles.size()), order;
  for (std::uint32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < tree.first_triangle_of_leaf(leaf + 1); ++t)
      leaf_of[t] = leaf;
  std::vector<std::uint8_t> seen(tree.leaf_count(), 0);
  const auto reach = [&](std::uint32_t leaf) {
    if (!seen[leaf]) seen[leaf] = 1, order.push_back(leaf);
  };
  for (const std::uint32_t t : forest->sources) reach(leaf_of[t]);
  for (std::uint32_t leaf = 0; leaf < seen.size(); ++leaf) reach(leaf);
  return order;
}

}  // namespace copse::spectrum_leaves
