#include "lib/analysis/rings/polyline_simplification.h"

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

namespace copse {
namespace {

// Questions a point and halving before ends are taken to be split off one by one: a hundred points never get
// there.
constexpr std::size_t k_patience = 8;

class Simplification {
 public:
  Simplification(std::span<std::uint8_t> keep, const PointNeed& need)
      : keep_(keep), need_(need), left_(k_patience * keep.size() * (std::bit_width(keep.size()) + 1)) {}

  void run() {
    std::size_t last = keep_.size();
    for (std::size_t i = 0; i < keep_.size(); ++i) {
      if (!keep_[i]) continue;
      if (last < i) split(last, i);
      last = i;
    }
  }

 private:
  void split(std::size_t from, std::size_t to) {
    todo_.assign(1, {from, to});
    while (!todo_.empty()) {
      const auto [a, b] = todo_.back();
      todo_.pop_back();
      if (left_ < b - a) {
        reach_ahead(a, b);
        continue;
      }
      left_ -= b - a;
      const std::size_t worst = most_needed(a, b);
      if (worst == a) continue;
      keep_[worst] = 1;
      todo_.emplace_back(worst, b), todo_.emplace_back(a, worst);
    }
  }

  std::size_t most_needed(std::size_t a, std::size_t b) const {
    std::size_t worst = a;
    double most = 1;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double need = need_(a, b, i);
      if (need > most) most = need, worst = i;
    }
    return worst;
  }

  bool is_straight(std::size_t a, std::size_t b) const {
    for (std::size_t i = a + 1; i < b; ++i) {
      if (need_(a, b, i) > 1) return false;
    }
    return true;
  }

  // From each point that stays to one as far ahead as doubling and then halving the step finds: what it costs
  // to find a step is its length times its logarithm.
  void reach_ahead(std::size_t a, std::size_t b) {
    while (a < b) {
      std::size_t good = 1, bad = 2;
      while (a + bad <= b && is_straight(a, a + bad)) good = bad, bad *= 2;
      bad = std::min(bad, b - a + 1);
      while (good + 1 < bad) {
        const std::size_t middle = good + (bad - good) / 2;
        (is_straight(a, a + middle) ? good : bad) = middle;
      }
      keep_[a += good] = 1;
    }
  }

  std::span<std::uint8_t> keep_;
  const PointNeed& need_;
  std::size_t left_;  // questions
  std::vector<std::pair<std::size_t, std::size_t>> todo_;
};

}  // namespace

void simplify_polyline(std::span<std::uint8_t> keep, const PointNeed& need) {
  Simplification(keep, need).run();
}

}  // namespace copse
