#include "lib/analysis/lod/hausdorff_errors.h"

#include "lib/analysis/lod/leaf_matching.h"
#include "lib/analysis/measure/triangle_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace copse {
namespace {

constexpr std::size_t k_pieces = 16;  // more a triangle that is drawn, until half of them are left
constexpr std::size_t k_least_pieces = 8192;
constexpr std::size_t k_tried = 4;  // elements of a step that are asked before all others
constexpr double k_loose = 1.1;  // how much farther than the nearest triangle one may be that is taken for it
constexpr double k_close = 0.2;  // of the error: what is so near needs no nearer one
constexpr double k_infinite = std::numeric_limits<double>::infinity();

// A triangle or a part of one.
using Piece = std::array<Double3, 3>;

double square(double v) {
  return v * v;
}
double square_between(const Double3& a, const Double3& b) {
  return dot(a - b, a - b);
}
Double3 middle(const Piece& p) {
  return (p[0] + p[1] + p[2]) / 3;
}

double radius_about(const Double3& centre, const Piece& p) {
  return std::sqrt(
      std::max({square_between(p[0], centre), square_between(p[1], centre), square_between(p[2], centre)}));
}

// No point of it is farther from a triangle than this.
double square_farthest(const Piece& piece, const Piece& triangle) {
  double most = 0;
  for (const Double3& c : piece)
    most = std::max(most, square_distance(c, triangle[0], triangle[1], triangle[2]));
  return most;
}

// A tree of boxes over triangles along a space-filling curve, four to a node at every level.
class TriangleTree {
 public:
  struct Found {
    double square = k_infinite;
    std::uint32_t triangle = k_none;  // by its place here
  };

  TriangleTree() = default;
  TriangleTree(const Spectrum& s, std::span<const std::uint32_t> elements) {
    std::vector<Double3> middles;
    std::vector<Listed> all;
    for (const std::uint32_t e : elements)
      for (std::uint32_t t = s.first_triangle[e]; t < s.first_triangle[e + 1]; ++t) {
        Listed listed{.corners = {}, .normal = {}, .element = e};
        for (int c = 0; c < 3; ++c) listed.corners[c] = s.vertices[s.triangles[t][c]].position;
        const Piece p = listed.piece();
        listed.normal = to_float(normalized(cross(p[1] - p[0], p[2] - p[0]), {}));
        all.push_back(listed), middles.push_back(middle(listed.piece()));
      }
    for (const std::uint32_t t : curve_order(middles)) triangles_.push_back(all[t]);
    for (std::size_t below = triangles_.size(); !triangles_.empty();) {
      first_.push_back(nodes_.size());
      const std::size_t size = (below + 3) / 4;
      nodes_.resize(nodes_.size() + size);
      for (std::size_t i = 0; i < below; ++i) nodes_[first_.back() + i / 4].put(i % 4, box_below(i));
      if (size == 1) break;
      below = size;
    }
  }

  // Of triangles of elements that count, if it is nearer than `most` (squared), one that is no more than
  // k_loose times as far as the nearest, or any that is no farther than `enough` (squared).
  template <class Counts>
  Found nearest(const Double3& p, double enough, double most, const Counts& counts) const {
    Found best{.square = most};
    const Float3 q = to_float(p);
    std::array<Open, 64> stack{};
    int depth = 0;
    if (!first_.empty()) stack[depth++] = {0, 0, static_cast<std::uint32_t>(first_.size()), 0};
    while (depth > 0 && best.square > enough) {
      const Open now = stack[--depth];
      if (double(now.square) * (k_loose * k_loose) >= best.square) continue;
      if (now.level == 0) {
        const Listed& t = triangles_[now.index];
        if (!counts(t.element)) continue;
        const double off = dot(t.normal, q - t.corners[0]);
        if (off * off * (k_loose * k_loose) >= best.square) continue;
        const double value =
            square_distance(p, to_double(t.corners[0]), to_double(t.corners[1]), to_double(t.corners[2]));
        if (value < best.square) best = {value, now.index};
        continue;
      }
      Four squares, order;
      nodes_[first_[now.level - 1] + now.index].look(q, squares, order);
      // The nearest last: it is taken first. In boxes that overlap the one whose middle is nearest.
      const int below = depth;
      for (std::uint32_t c = 0; c < 4; ++c) {
        if (!(double(squares[c]) * (k_loose * k_loose) < best.square)) continue;
        int at = depth++;
        for (; at > below && stack[at - 1].order < order[c]; --at) stack[at] = stack[at - 1];
        stack[at] = {squares[c], order[c], now.level - 1, 4 * now.index + c};
      }
    }
    return best;
  }

  Piece piece(std::uint32_t triangle) const { return triangles_[triangle].piece(); }
  std::uint32_t element(std::uint32_t triangle) const { return triangles_[triangle].element; }

 private:
  struct Listed {
    std::array<Float3, 3> corners;
    Float3 normal;  // of its plane; none of a triangle of no size
    std::uint32_t element = k_none;
    Piece piece() const { return {to_double(corners[0]), to_double(corners[1]), to_double(corners[2])}; }
  };
  struct Open {
    float square = 0, order = 0;
    std::uint32_t level = 0, index = 0;
  };
  // Four boxes side by side.
  using Four [[gnu::vector_size(16)]] = float;
  struct Node {
    static constexpr float k_far = std::numeric_limits<float>::infinity();
    static constexpr Four k_all_far{k_far, k_far, k_far, k_far};
    std::array<Four, 3> low{k_all_far, k_all_far, k_all_far}, high{-k_all_far, -k_all_far, -k_all_far};
    void put(std::size_t i, const FloatBox& box) {
      for (int a = 0; a < 3; ++a) low[a][i] = box.min[a], high[a][i] = box.max[a];
    }
    FloatBox box() const {
      FloatBox all;
      for (int i = 0; i < 4; ++i)
        all.grow(FloatBox{{low[0][i], low[1][i], low[2][i]}, {high[0][i], high[1][i], high[2][i]}});
      return all;
    }
    // Squared distances to the boxes, and what they are to be looked at by.
    void look(const Float3& p, Four& squares, Four& order) const {
      squares = order = Four{};
      const std::array<float, 3> at{p.x, p.y, p.z};
      for (int a = 0; a < 3; ++a) {
        const Four under = low[a] - at[a], over = at[a] - high[a], middle = under - over;
        const Four out = under > over ? under : over, d = out > 0 ? out : Four{};
        squares += d * d, order += d * d + 1e-3f * middle * middle;
      }
    }
  };

  // Of the i-th of what the last level so far is made of.
  FloatBox box_below(std::size_t i) const {
    if (first_.size() > 1) return nodes_[first_[first_.size() - 2] + i].box();
    FloatBox box;
    for (const Float3& c : triangles_[i].corners) box.grow(c);
    return box;
  }

  std::vector<Listed> triangles_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> first_;  // node of each level, from the triangles up
};

class HausdorffErrors {
 public:
  explicit HausdorffErrors(const Spectrum& s) : s_(s), drawn_(s.elements.size(), 0) {
    sort_by_birth();
    DoubleBox box;
    for (const SpectrumVertex& v : s.vertices) box.grow(to_double(v.position));
    if (!box.empty()) enough_ = floor_ = k_hausdorff_floor * length(box.extent());
  }

  std::vector<float> run() {
    std::vector<float> errors(s_.counts.size(), std::numeric_limits<float>::max());
    errors[0] = 0;
    begin();
    for (std::uint32_t n = 1; n < errors.size() && s_.counts[n] > 0; ++n) {
      take(n);
      errors[n] = changed_ ? std::min(round_up(enough_), std::numeric_limits<float>::max()) : 0.0f;
    }
    return errors;
  }

 private:
  // What of full detail is near the same element: a piece, or several such, in a ball.
  struct Bunch {
    Double3 centre;
    double radius = 0;
    std::uint32_t piece = k_none, first = k_none;  // or its first part
    std::uint32_t next = k_none;                   // in the list that it is in
  };

  void sort_by_birth() {
    first_born_.assign(s_.counts.size() + 1, 0);
    for (const SpectrumElement& e : s_.elements) ++first_born_[e.birth + 1];
    std::partial_sum(first_born_.begin(), first_born_.end(), first_born_.begin());
    born_.resize(s_.elements.size());
    std::vector<std::uint32_t> at(first_born_);
    for (std::uint32_t e = 0; e < s_.elements.size(); ++e) born_[at[s_.elements[e].birth]++] = e;
  }
  std::span<const std::uint32_t> born(std::uint32_t step) const {
    return std::span(born_).subspan(first_born_[step], first_born_[step + 1] - first_born_[step]);
  }

  Piece piece_of(std::uint32_t triangle) const {
    const auto& t = s_.triangles[triangle];
    return {to_double(s_.vertices[t[0]].position), to_double(s_.vertices[t[1]].position),
            to_double(s_.vertices[t[2]].position)};
  }

  // All of full detail is near itself.
  void begin() {
    near_.assign(s_.elements.size(), k_none);
    source_ = TriangleTree(s_, born(0));
    for (const std::uint32_t e : born(0)) {
      drawn_[e] = 1;
      for (std::uint32_t t = s_.first_triangle[e]; t < s_.first_triangle[e + 1]; ++t)
        attach(bunch_of(piece_of(t)), e);
    }
    next_dead_ = static_cast<std::uint32_t>(s_.elements.size());
    while (next_dead_ > 0 && s_.elements[next_dead_ - 1].death == 0) --next_dead_;
  }

  std::uint32_t bunch_of(const Piece& piece) {
    const Double3 c = middle(piece);
    bunches_.push_back(
        {.centre = c, .radius = radius_about(c, piece), .piece = static_cast<std::uint32_t>(pieces_.size())});
    pieces_.push_back(piece);
    return static_cast<std::uint32_t>(bunches_.size() - 1);
  }

  void attach(std::uint32_t bunch, std::uint32_t element) {
    bunches_[bunch].next = near_[element], near_[element] = bunch;
  }

  // Whether full detail that is near the element reaches all of the piece, as far as some bunches tell.
  bool near_known(const Piece& piece, std::uint32_t element) const {
    const Double3 c = middle(piece);
    const double left = enough_ - radius_about(c, piece);
    std::size_t tried = 0;
    for (std::uint32_t b = near_[element]; b != k_none && tried < k_tried; b = bunches_[b].next, ++tried)
      if (left >= bunches_[b].radius &&
          square_between(c, bunches_[b].centre) <= square(left - bunches_[b].radius))
        return true;
    return false;
  }

  // From state n - 1 to n.
  void take(std::uint32_t n) {
    const std::span<const std::uint32_t> born_now = born(n);
    const std::uint32_t last = next_dead_;
    for (; next_dead_ > 0 && s_.elements[next_dead_ - 1].death == n; --next_dead_) drawn_[next_dead_ - 1] = 0;
    changed_ = changed_ || !born_now.empty() || next_dead_ < last;
    for (const std::uint32_t e : born_now) drawn_[e] = 1;
    if (n >= renewed_) renew(n);
    tried_ = born_now.first(std::min(born_now.size(), k_tried));
    for (std::uint32_t e = next_dead_; e < last; ++e) leave(e);
    const auto all = [](std::uint32_t) { return true; };
    for (const std::uint32_t e : born_now)
      for (std::uint32_t t = s_.first_triangle[e]; t < s_.first_triangle[e + 1]; ++t) {
        const Piece piece = piece_of(t);
        if (near_known(piece, e)) continue;
        todo_.assign(1, piece);
        while (!todo_.empty()) settle(source_, all);
      }
  }

  // The tree of what is drawn from now on, until half of it is left.
  void renew(std::uint32_t n) {
    const auto half = s_.counts[n] / 2;
    const auto found = std::lower_bound(s_.counts.begin() + n, s_.counts.end(), half, std::greater<>());
    renewed_ = std::max(n + 1, static_cast<std::uint32_t>(found - s_.counts.begin()));
    std::vector<std::uint32_t> elements;
    for (std::uint32_t e = 0; e < s_.elements.size() && s_.elements[e].death > n; ++e)
      if (s_.elements[e].birth < renewed_) elements.push_back(e);
    tree_ = TriangleTree(s_, elements);
    pieces_left_ = k_least_pieces + k_pieces * s_.counts[n];
    spent_ = pieces_left_ / 8, coarser_ = pieces_left_ - spent_, slack_ = k_hausdorff_slack;
  }

  // What was near an element that is gone is near another now.
  void leave(std::uint32_t element) {
    open_.clear();
    for (std::uint32_t b = near_[element]; b != k_none; b = bunches_[b].next) open_.push_back(b);
    near_[element] = k_none;
    bunch_up();
    while (!open_.empty()) {
      const std::uint32_t b = open_.back();
      open_.pop_back();
      const std::uint32_t to = near_enough(bunches_[b]);
      if (to != k_none)
        attach(b, to);
      else if (bunches_[b].piece != k_none)
        find_place(bunches_[b].piece, b);
      else
        for (std::uint32_t c = bunches_[b].first; c != k_none; c = bunches_[c].next) open_.push_back(c);
    }
  }

  // What is open in bunches as large as half of what is near enough, two and two.
  void bunch_up() {
    if (open_.size() < 2) return;
    sort_open();
    for (bool any = true; any && open_.size() > 1;) {
      any = false;
      std::size_t kept = 0;
      for (std::size_t i = 0; i < open_.size();) {
        const std::uint32_t both = i + 1 < open_.size() ? joined(open_[i], open_[i + 1]) : k_none;
        any = any || both != k_none;
        open_[kept++] = both != k_none ? both : open_[i];
        i += both != k_none ? 2 : 1;
      }
      open_.resize(kept);
    }
  }

  std::uint32_t joined(std::uint32_t a, std::uint32_t b) {
    const Bunch &x = bunches_[a], &y = bunches_[b];
    const double apart = std::sqrt(square_between(x.centre, y.centre));
    Bunch both = x.radius >= y.radius + apart ? x : y;
    if (both.radius < std::min(x.radius, y.radius) + apart) {
      both.radius = 0.5 * (x.radius + y.radius + apart);
      both.centre = x.centre + (y.centre - x.centre) * (apart > 0 ? (both.radius - x.radius) / apart : 0.0);
    }
    if (!(2 * both.radius <= enough_)) return k_none;
    both.piece = k_none, both.first = a, both.next = k_none;
    bunches_[a].next = b, bunches_[b].next = k_none;
    bunches_.push_back(both);
    return static_cast<std::uint32_t>(bunches_.size() - 1);
  }

  // What is near comes one after the other.
  void sort_open() {
    spans_.assign(1, {0, open_.size()});
    while (!spans_.empty()) {
      const auto [first, last] = spans_.back();
      spans_.pop_back();
      if (last - first < 3) continue;
      const std::span<std::uint32_t> some = std::span(open_).subspan(first, last - first);
      DoubleBox box;
      for (const std::uint32_t b : some) box.grow(bunches_[b].centre);
      const Double3 e = box.extent();
      const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
      const double half = box.centre()[axis];
      const auto upper = std::partition(some.begin(), some.end(),
                                        [&](std::uint32_t b) { return bunches_[b].centre[axis] < half; });
      const auto at = first + static_cast<std::size_t>(upper - some.begin());
      if (at == first || at == last) continue;
      spans_.push_back({first, at}), spans_.push_back({at, last});
    }
  }

  // An element that is drawn to which all of the bunch is near.
  std::uint32_t near_enough(const Bunch& bunch) const {
    const double left = enough_ - bunch.radius;
    if (!(left >= 0)) return k_none;
    for (const std::uint32_t e : tried_)
      for (std::uint32_t t = s_.first_triangle[e]; t < s_.first_triangle[e + 1]; ++t) {
        const Piece p = piece_of(t);
        if (square_distance(bunch.centre, p[0], p[1], p[2]) <= square(left)) return e;
      }
    if (bunch.piece != k_none) return k_none;  // find_place() looks further
    const double enough = square(left), most = std::nextafter(enough, k_infinite);
    const TriangleTree::Found found =
        tree_.nearest(bunch.centre, enough, most, [&](std::uint32_t e) { return drawn_[e] != 0; });
    return found.triangle != k_none ? tree_.element(found.triangle) : k_none;
  }

  // A piece of full detail that is nearer to one drawn element than the error, once that is as large as it
  // must be; or its parts are. `bunch`: what the piece itself is in.
  void find_place(std::uint32_t piece, std::uint32_t bunch) {
    todo_.assign(1, pieces_[piece]);
    bool whole = true;
    while (!todo_.empty()) {
      const Piece now = todo_.back();
      const std::uint32_t e = settle(tree_, [&](std::uint32_t el) { return drawn_[el] != 0; });
      if (e == k_none) {
        whole = false;
        continue;
      }
      attach(whole ? bunch : bunch_of(now), e);
    }
  }

  // The last piece of todo_: makes the error as large as it must be for it at least, and gives the element
  // that it is near to; or puts its parts in its place.
  template <class Counts>
  std::uint32_t settle(const TriangleTree& tree, const Counts& counts) {
    const Piece piece = todo_.back();
    todo_.pop_back();
    const Double3 centre = middle(piece);
    const double radius = radius_about(centre, piece), stop = std::max(enough_ - radius, k_close * enough_);
    const TriangleTree::Found found = tree.nearest(centre, square(stop), k_infinite, counts);
    if (found.triangle == k_none) return k_none;
    const double apart = std::sqrt(found.square);
    const std::uint32_t near = tree.element(found.triangle);
    if (apart + radius <= enough_) return near;  // it may be any that is so near: it says no more
    if (apart > stop) raise(apart / k_loose);    // else there may be nearer ones
    if (apart + radius <= enough_) return near;
    const double farthest = square_farthest(piece, tree.piece(found.triangle));
    if (farthest <= square(enough_)) return near;
    if (pieces_left_ < 3) {
      enough_ = std::max(enough_, std::min(apart + radius, std::sqrt(farthest)));
      return near;
    }
    pieces_left_ -= 3;
    if (pieces_left_ < coarser_) {
      coarser_ -= std::min(coarser_, spent_), slack_ *= 2;
      enough_ = std::max({enough_, (1 + slack_) * error_, slack_ / k_hausdorff_slack * floor_});
    }
    const Double3 ab = (piece[0] + piece[1]) * 0.5, bc = (piece[1] + piece[2]) * 0.5,
                  ca = (piece[2] + piece[0]) * 0.5;
    for (const Piece& part : {Piece{piece[0], ab, ca}, {ab, piece[1], bc}, {ca, bc, piece[2]}, {ab, bc, ca}})
      todo_.push_back(part);
    return k_none;
  }

  void raise(double error) {
    if (!(error > std::max(error_, 0.1 * floor_))) return;  // not what rounding makes
    error_ = error, enough_ = std::max(enough_, (1 + slack_) * error_);
  }

  const Spectrum& s_;
  std::vector<std::uint8_t> drawn_;               // one an element
  std::vector<std::uint32_t> first_born_, born_;  // elements by their birth
  std::uint32_t next_dead_ = 0;                   // they go from the back
  TriangleTree source_, tree_;                    // of full detail, of what is drawn now and soon
  std::uint32_t renewed_ = 1;                     // the step from which tree_ does not know all
  std::vector<Bunch> bunches_;
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> near_;  // the first bunch that is near each element
  std::vector<std::uint32_t> open_;
  std::vector<std::pair<std::size_t, std::size_t>> spans_;  // of open_, while it is bunched up
  std::vector<Piece> todo_;
  std::span<const std::uint32_t> tried_;
  std::size_t pieces_left_ = 0, spent_ = 0, coarser_ = 0;  // each time spent_ have gone the slack is doubled
  double slack_ = k_hausdorff_slack;
  bool changed_ = false;
  // The error is no less than error_ as far as known; what is no farther than enough_ is near.
  double error_ = 0, enough_ = 0, floor_ = 0;
};

}  // namespace

std::vector<float> hausdorff_errors(const Spectrum& spectrum) {
  if (spectrum.counts.empty()) return {};
  return HausdorffErrors(spectrum).run();
}

}  // namespace copse
