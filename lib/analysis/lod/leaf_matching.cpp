#include "lib/analysis/lod/leaf_matching.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr double k_turning = 0.125;  // of a leaf's area: turning it by a right angle moves it so far, squared
constexpr double k_kept = 0.35;      // of what a guest covered, what a host at its very place does not
constexpr double k_near = 0.005;  // of what a match covers: what one as far apart as the crown is wide costs
constexpr double k_stranger = 4;  // squared: how much farther leaves of another group are
constexpr std::uint32_t k_nobody = 0xffffffffu, k_core = 0xfffffffeu;
constexpr int k_offers = 3;                    // hosts that a guest asks, one after the other
constexpr std::size_t k_asked = 4;             // leaves that are asked for each core that is wanted
constexpr double k_growth = 1.2;               // by so much a core must be able to grow
constexpr std::size_t k_most_guests = 0x7fff;  // of one host, however small they are

// Spreads the low 21 bits over every third bit.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

class Matching {
 public:
  Matching(std::span<const MatchLeaf> leaves, const MatchOptions& options)
      : leaves_(leaves), options_(options) {
    for (const MatchLeaf& l : leaves) box_.grow(l.centre);
    const Double3 e = box_.empty() ? Double3{} : box_.extent();
    per_width_ = dot(e, e) > 0 ? 1 / dot(e, e) : 0;
  }

  // What is too large together is matched only when nothing else is left.
  std::vector<LeafMatch> run() {
    sort();
    find_cores();
    find_hosts();
    std::vector<LeafMatch> out = take(true);
    return out.empty() ? take(false) : out;
  }

 private:
  struct Offer {
    float price;
    std::uint32_t guest, host;
    friend bool operator<(const Offer& x, const Offer& y) {
      if (x.price != y.price) return x.price < y.price;
      return x.guest != y.guest ? x.guest < y.guest : x.host < y.host;
    }
  };

  std::vector<LeafMatch> take(bool fitting) {
    gone_.assign(leaves_.size(), 0), guests_.assign(leaves_.size(), 0);
    match_of_.assign(leaves_.size(), k_nobody);
    area_.clear();
    for (const MatchLeaf& l : leaves_) area_.push_back(l.area);
    std::vector<LeafMatch> out;
    std::size_t taken = 0, sorted = 0;
    // Few of the offers are ever looked at: they are sorted as they are needed.
    for (std::size_t i = 0; i < offers_.size() && taken < options_.most; ++i) {
      if (i == sorted) {
        sorted = std::min(offers_.size(), std::max<std::size_t>(2 * sorted, 2 * options_.most + 64));
        if (sorted < offers_.size())
          std::nth_element(offers_.begin() + i, offers_.begin() + sorted, offers_.end());
        std::sort(offers_.begin() + i, offers_.begin() + sorted);
      }
      const std::uint32_t guest = offers_[i].guest;
      if (match_of_[guest] != k_nobody) continue;
      std::uint32_t host = offers_[i].host;
      const bool core = host == k_core;
      if (core) host = core_for(guest);
      if (host == k_nobody || gone_[host] != 0 || !takes(host, guest, fitting)) continue;
      if (match_of_[host] == k_nobody) {
        match_of_[host] = static_cast<std::uint32_t>(out.size());
        out.push_back({host, {}, false});
      }
      LeafMatch& match = out[match_of_[host]];
      match.core = match.core || core;
      if (core) options_.room -= leaves_[guest].area;
      match.guests.push_back(guest);
      match_of_[guest] = match_of_[host], gone_[guest] = 1, ++taken;
      area_[host] += leaves_[guest].area, ++guests_[host];
    }
    return out;
  }

  // Whether the host may have one guest more.
  bool takes(std::uint32_t host, std::uint32_t guest, bool fitting) const {
    if (!fitting) return guests_[host] == 0;
    const double area = area_[host] + leaves_[guest].area;
    if (options_.largest > 0 && area > options_.largest) return false;
    if (guests_[host] < options_.guests) return true;
    const auto core = std::find(cores_.begin(), cores_.end(), host);
    return core != cores_.end() && guests_[host] < k_most_guests && area < held_[core - cores_.begin()];
  }

  std::uint32_t core_for(std::uint32_t guest) const {
    if (leaves_[guest].area > options_.room) return k_nobody;
    for (const std::uint32_t c : cores_)
      if (takes(c, guest, true)) return c;
    return k_nobody;
  }

  // Of the leaves that may still grow those that show least of it; of equals the largest.
  void find_cores() {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < leaves_.size(); ++i)
      if (options_.largest <= 0 || 1.2 * leaves_[i].area < options_.largest) all.push_back(i);
    const std::size_t n = options_.room > 0 ? std::min({options_.cores, all.size(), leaves_.size() / 16}) : 0;
    // Some of them have no room to grow.
    const std::size_t asked = std::min(k_asked * n, all.size());
    std::partial_sort(all.begin(), all.begin() + asked, all.end(), [&](std::uint32_t x, std::uint32_t y) {
      const double p = harm(leaves_[x]), q = harm(leaves_[y]);
      if (p != q) return p < q;
      return leaves_[x].area != leaves_[y].area ? leaves_[x].area > leaves_[y].area : x < y;
    });
    for (std::size_t i = 0; i < asked && cores_.size() < n; ++i) {
      const double area = leaves_[all[i]].area, wanted = std::max(2 * area, options_.core * options_.largest);
      const double held = options_.holds ? std::min(options_.holds(all[i]), wanted) : wanted;
      if (held > k_growth * area) cores_.push_back(all[i]), held_.push_back(held);
    }
  }

  // Of growing, for each pixel that is covered more.
  double harm(const MatchLeaf& host) const {
    if (!(host.covered > 0)) return options_.gained + options_.other;
    return (options_.gained * host.sole + options_.other * host.seen) / host.covered;
  }

  void sort() {
    std::vector<Double3> centres;
    centres.reserve(leaves_.size());
    for (const MatchLeaf& l : leaves_) centres.push_back(l.centre);
    order_ = curve_order(centres);
  }

  // `guest` vanishes, `host` has its area beside its own.
  // Of what the guest covered the grown host covers the more the nearer it is.
  double absorbed(const MatchLeaf& host, const MatchLeaf& guest, double elsewhere) const {
    return elsewhere * (options_.lost * guest.sole + harm(host) * guest.covered) +
           options_.other * guest.seen;
  }

  // Of anything that two leaves may become.
  double shared(const MatchLeaf& a, const MatchLeaf& b) const {
    const double area = a.area + b.area, covered = a.covered + b.covered;
    const Double3 d = a.centre - b.centre;
    const double agree = dot(a.normal, b.normal);
    const double apart = dot(d, d) + k_turning * area * (1 - agree * agree);
    // Of two leaves that touch and lie in one plane a third is elsewhere when they become one.
    const double moved = area > 0 ? std::min(0.5 + 0.5 * apart / area, 1.3) : 0;
    elsewhere_ = area > 0 ? std::min(k_kept + 0.5 * dot(d, d) / area, 1.0) : 1;
    between_ = moved * (0.5 * (options_.lost + options_.gained) * (a.sole + b.sole) +
                        options_.other * (a.seen + b.seen));
    const double excess =
        options_.largest > 0 && area > options_.largest ? (area - options_.largest) / area * covered : 0;
    return 20 * excess + k_near * covered * dot(d, d) * per_width_ * (a.group == b.group ? 1 : k_stranger);
  }

  void find_hosts() {
    const auto n = static_cast<std::uint32_t>(order_.size());
    constexpr Offer k_none_yet{std::numeric_limits<float>::infinity(), 0, k_nobody};
    std::vector<std::array<Offer, k_offers>> best(n);
    for (auto& offers : best) offers.fill(k_none_yet);
    const auto offer = [&](std::uint32_t guest, std::uint32_t host, double cost) {
      Offer o{static_cast<float>(cost), guest, host};
      for (Offer& kept : best[guest])
        if (o.price < kept.price) std::swap(o, kept);
    };
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = order_[i];
      const auto end = std::min<std::size_t>(n, std::size_t{i} + options_.window + 1);
      for (std::size_t j = i + 1; j < end; ++j) {
        const std::uint32_t b = order_[j];
        const double both = shared(leaves_[a], leaves_[b]);
        const double b_goes = absorbed(leaves_[a], leaves_[b], elsewhere_),
                     a_goes = absorbed(leaves_[b], leaves_[a], elsewhere_);
        offer(b, a, both + std::min(b_goes, between_));
        offer(a, b, both + std::min(a_goes, between_));
      }
    }
    std::vector<std::uint8_t> is_core(n, 0);
    for (const std::uint32_t c : cores_) is_core[c] = 1;
    for (std::uint32_t guest = 0; guest < n; ++guest) {
      if (is_core[guest] != 0) continue;
      if (!cores_.empty()) offer(guest, k_core, absorbed(leaves_[cores_.back()], leaves_[guest], 1));
      for (const Offer& o : best[guest])
        if (o.host != k_nobody) offers_.push_back(o);
    }
  }

  std::span<const MatchLeaf> leaves_;
  MatchOptions options_;
  DoubleBox box_;
  double per_width_ = 0;
  mutable double between_ = 0, elsewhere_ = 1;
  std::vector<std::uint32_t> order_;  // along the curve
  std::vector<std::uint32_t> cores_, match_of_;
  std::vector<Offer> offers_;
  std::vector<double> held_;  // what each core can grow to
  std::vector<double> area_;  // of a host with its guests
  std::vector<std::size_t> guests_;
  std::vector<std::uint8_t> gone_;
};

struct Keyed {
  std::uint64_t key;
  std::uint32_t number;
};

// Of equal keys the first stays first.
void sort_by_key(std::vector<Keyed>& all) {
  constexpr std::size_t k_few = 512;
  constexpr int k_bits = 11, k_key_bits = 63;
  if (all.size() < k_few) {
    std::stable_sort(all.begin(), all.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
    return;
  }
  std::vector<Keyed> other(all.size());
  for (int shift = 0; shift < k_key_bits; shift += k_bits) {
    std::array<std::uint32_t, (1 << k_bits) + 1> first{};
    const auto digit = [&](const Keyed& k) { return k.key >> shift & ((1u << k_bits) - 1); };
    for (const Keyed& k : all) ++first[digit(k) + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    for (const Keyed& k : all) other[first[digit(k)]++] = k;
    all.swap(other);
  }
}

}  // namespace

std::vector<std::uint32_t> curve_order(std::span<const Double3> points) {
  DoubleBox box;
  for (const Double3& p : points) box.grow(p);
  const Double3 e = box.empty() ? Double3{} : box.extent();
  const double longest = std::max({e.x, e.y, e.z}), scale = longest > 0 ? 0x1fffff / longest : 0;
  const auto cell = [&](double v) {
    return static_cast<std::uint64_t>(std::isfinite(scale) ? std::clamp(v * scale, 0.0, double(0x1fffff))
                                                           : 0);
  };
  std::vector<Keyed> keyed;
  keyed.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Double3 c = points[i] - box.min;
    keyed.push_back({spread(cell(c.x)) | spread(cell(c.y)) << 1 | spread(cell(c.z)) << 2, i});
  }
  sort_by_key(keyed);
  std::vector<std::uint32_t> order;
  order.reserve(keyed.size());
  for (const Keyed& k : keyed) order.push_back(k.number);
  return order;
}

std::vector<LeafMatch> match_leaves(std::span<const MatchLeaf> leaves, const MatchOptions& options) {
  return Matching(leaves, options).run();
}

}  // namespace copse
