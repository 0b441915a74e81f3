#include "lib/analysis/volumes/aspect_tree.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr double k_thinnest = 1e-6;  // of the longest extent
constexpr double k_same = 1e-6;

AspectNode leaf(VolumeKind kind) {
  return {0, 0, kind};
}

// How much larger a choice is than the smallest, as a logarithm. A flat sample's smallest volume is 0: then
// every other choice is merely much larger.
double regret(const AspectSample& s, std::size_t kind) {
  const double least = *std::min_element(s.volume.begin(), s.volume.end());
  if (!std::isfinite(s.volume[kind])) return 1e6;
  if (s.volume[kind] <= least * (1 + k_same)) return 0;
  return least > 0 ? std::min(std::log(s.volume[kind] / least), 20.0) : 20;
}

using Regrets = std::array<double, k_volume_kinds>;

struct Samples {
  std::span<const AspectSample> all;
  std::vector<Regrets> regrets;
};

struct BestKind {
  VolumeKind kind = VolumeKind::obb;
  double regret = 0;
};
BestKind best_kind(const Regrets& sums) {
  const auto at = std::min_element(sums.begin(), sums.end());
  return {static_cast<VolumeKind>(at - sums.begin()), *at};
}

Regrets& operator+=(Regrets& a, const Regrets& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
  return a;
}

struct Split {
  AspectNode node;
  double regret = std::numeric_limits<double>::infinity();
};

// The best comparison for these samples: every ratio, every threshold between two neighbours.
Split best_split(const Samples& samples, const std::vector<std::uint32_t>& members) {
  Split best;
  for (int ratio = 1; ratio <= 3; ++ratio) {
    const auto value = [&](std::uint32_t i) {
      return samples.all[i].ratios.ratio[static_cast<std::size_t>(ratio - 1)];
    };
    std::vector<std::uint32_t> order = members;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return value(a) != value(b) ? value(a) < value(b) : a < b;
    });
    std::vector<Regrets> above(order.size() + 1, Regrets{});
    for (std::size_t i = order.size(); i-- > 0;) {
      above[i] = above[i + 1];
      above[i] += samples.regrets[order[i]];
    }
    Regrets below{};
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
      below += samples.regrets[order[i]];
      const double a = value(order[i]), b = value(order[i + 1]);
      if (!(a < b)) continue;
      const double sum = best_kind(below).regret + best_kind(above[i + 1]).regret;
      if (sum < best.regret) best = {{ratio, std::sqrt(a * b), VolumeKind::obb}, sum};
    }
  }
  return best;
}

void grow(const Samples& samples, const std::vector<std::uint32_t>& members, std::size_t node, int level,
          AspectTree& tree) {
  Regrets sums{};
  for (const std::uint32_t i : members) sums += samples.regrets[i];
  const BestKind whole = best_kind(sums);
  tree.nodes[node] = leaf(whole.kind);
  if (level == AspectTree::k_levels) return;
  const Split split = best_split(samples, members);
  // A comparison that gains less than a thousandth a sample is noise.
  if (!(split.regret < whole.regret - 1e-3 * static_cast<double>(members.size()))) return;
  tree.nodes[node] = split.node;
  std::vector<std::uint32_t> above, below;
  for (const std::uint32_t i : members) {
    const double r = samples.all[i].ratios.ratio[static_cast<std::size_t>(split.node.ratio - 1)];
    (r > split.node.threshold ? above : below).push_back(i);
  }
  grow(samples, above, 2 * node + 1, level + 1, tree);
  grow(samples, below, 2 * node + 2, level + 1, tree);
}

// "kind" or "ratioN>T?A:B", the latter in brackets below the root.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Result<AspectTree> parse() {
    AspectTree tree;
    tree.nodes = {};
    if (!node(tree, 0, 0)) return std::unexpected(error_);
    if (at_ != text_.size()) return fault("nothing more is wanted");
    return tree;
  }

 private:
  bool node(AspectTree& tree, std::size_t i, int level) {
    const bool bracket = take("(");
    const std::size_t start = at_;
    while (at_ < text_.size() &&
           ((text_[at_] >= 'a' && text_[at_] <= 'z') || (text_[at_] >= '0' && text_[at_] <= '9')))
      ++at_;
    const std::string_view word = text_.substr(start, at_ - start);
    const bool compares = word.size() == 6 && word.starts_with("ratio") && word[5] >= '1' && word[5] <= '3';
    if (compares && level == AspectTree::k_levels) return refuse_here("more than three comparisons");
    if (compares) {
      if (!comparison(tree, i, level, word[5] - '0')) return false;
    } else {
      const auto kind = volume_kind(word);
      if (!kind) return at_ = start, refuse_here("a kind of volume, or ratio1, ratio2 or ratio3, is wanted");
      tree.nodes[i] = leaf(*kind);
    }
    return !bracket || take(")") || refuse_here("')' is wanted");
  }

  bool comparison(AspectTree& tree, std::size_t i, int level, int ratio) {
    if (!take(">")) return refuse_here("'>' is wanted");
    double threshold = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), threshold);
    if (error != std::errc() || !std::isfinite(threshold)) return refuse_here("a number is wanted");
    at_ = static_cast<std::size_t>(end - text_.data());
    tree.nodes[i] = {ratio, threshold, VolumeKind::obb};
    if (!take("?")) return refuse_here("'?' is wanted");
    if (!node(tree, 2 * i + 1, level + 1)) return false;
    if (!take(":")) return refuse_here("':' is wanted");
    return node(tree, 2 * i + 2, level + 1);
  }

  bool take(std::string_view token) {
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }
  std::unexpected<Error> fault(const std::string& what) const {
    return fail(Fault::usage, "", fmt::format("'{}', character {}: {}", text_, at_ + 1, what),
                "write it like ratio1>2?capsule:(ratio3>2.5?lozenge:obb)");
  }
  bool refuse_here(const std::string& what) {
    error_ = fault(what).error();
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Error error_;
};

}  // namespace

AspectRatios aspect_ratios(const Double3& extents) {
  std::array<double, 3> e{extents.x, extents.y, extents.z};
  std::sort(e.begin(), e.end());
  if (!(e[2] > 0)) return {};
  const double s = std::max(e[0], k_thinnest * e[2]), m = std::max(e[1], k_thinnest * e[2]);
  const double ratio2 = e[2] / m, ratio3 = m / s;
  return {{ratio2 / ratio3, ratio2, ratio3}};
}

AspectTree::AspectTree() {
  nodes = {};
  nodes[0] = {3, 1.001, VolumeKind::obb};
  nodes[1] = {3, 1.1, VolumeKind::obb};
  nodes[2] = {1, 2.4, VolumeKind::obb};
  nodes[3] = leaf(VolumeKind::obb);
  nodes[4] = {2, 1.15, VolumeKind::obb};
  nodes[5] = leaf(VolumeKind::cylinder);
  nodes[6] = leaf(VolumeKind::lozenge);
  nodes[9] = leaf(VolumeKind::obb);
  nodes[10] = leaf(VolumeKind::lozenge);
}

AspectTree AspectTree::seed() {
  AspectTree tree;
  auto& nodes = tree.nodes;
  nodes = {};
  nodes[0] = {1, 2, VolumeKind::obb};
  nodes[1] = leaf(VolumeKind::capsule);
  nodes[2] = {3, 1.25, VolumeKind::obb};
  nodes[5] = leaf(VolumeKind::lozenge);
  nodes[6] = {2, 1.25, VolumeKind::obb};
  nodes[13] = leaf(VolumeKind::lozenge);
  nodes[14] = leaf(VolumeKind::sphere);
  return tree;
}

VolumeKind AspectTree::choose(const AspectRatios& ratios) const {
  std::size_t i = 0;
  while (nodes[i].ratio != 0) {
    const bool above = ratios.ratio[static_cast<std::size_t>(nodes[i].ratio - 1)] > nodes[i].threshold;
    i = 2 * i + (above ? 1 : 2);
  }
  return nodes[i].kind;
}

std::vector<VolumeKind> AspectTree::kinds() const {
  std::vector<VolumeKind> out;
  std::vector<std::size_t> open{0};
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    if (nodes[i].ratio == 0) {
      if (std::find(out.begin(), out.end(), nodes[i].kind) == out.end()) out.push_back(nodes[i].kind);
    } else {
      open.insert(open.end(), {2 * i + 1, 2 * i + 2});
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string AspectTree::text() const {
  const auto of = [&](const auto& self, std::size_t i) -> std::string {  // at most three levels
    const AspectNode& n = nodes[i];
    if (n.ratio == 0) return std::string(name_of(n.kind));
    const std::string inside =
        fmt::format("ratio{}>{}?{}:{}", n.ratio, n.threshold, self(self, 2 * i + 1), self(self, 2 * i + 2));
    return i == 0 ? inside : "(" + inside + ")";
  };
  return of(of, 0);
}

Result<AspectTree> AspectTree::parse(std::string_view text) {
  if (text == "default") return AspectTree();
  if (text == "seed") return seed();
  return Parser(text).parse();
}

AspectTree tune_aspect_tree(std::span<const AspectSample> samples) {
  Samples s{samples, {}};
  for (const AspectSample& sample : samples) {
    Regrets r{};
    for (std::size_t k = 0; k < r.size(); ++k) r[k] = regret(sample, k);
    s.regrets.push_back(r);
  }
  std::vector<std::uint32_t> members(samples.size());
  std::iota(members.begin(), members.end(), 0u);
  AspectTree tree;
  tree.nodes = {};
  grow(s, members, 0, 0, tree);
  return tree;
}

AspectAgreement agreement(const AspectTree& tree, std::span<const AspectSample> samples) {
  AspectAgreement a;
  double sum = 0;
  for (const AspectSample& s : samples) {
    const double r = regret(s, static_cast<std::size_t>(tree.choose(s.ratios)));
    a.agree += r == 0, sum += r;
  }
  if (samples.empty()) return a;
  a.agree /= static_cast<double>(samples.size());
  a.excess = std::expm1(sum / static_cast<double>(samples.size()));
  return a;
}

}  // namespace copse
