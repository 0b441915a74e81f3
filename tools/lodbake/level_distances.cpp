#include "tools/lodbake/level_distances.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace copse::lodbake {
namespace {

constexpr double k_room = 1.001;   // beyond bands that just touch
constexpr double k_widest = 1e12;  // times the first distance: farther than any scene sees

std::unexpected<Error> usage(std::string what, std::string remedy) {
  return fail(Fault::usage, "", std::move(what), std::move(remedy));
}

// Times the distance before, so that two bands touch; `hysteresis` below 1.
double touching(double hysteresis) {
  return (1 + hysteresis) / (1 - hysteresis);
}

// The levels whose distance is named.
std::vector<std::size_t> anchors(const NamedDistances& named) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < named.levels.size(); ++i)
    if (named.levels[i]) out.push_back(i);
  return out;
}

Result<void> check_order(const Options& options, double apart) {
  const std::optional<double> borders[] = {options.near, options.medium, options.far};
  std::optional<double> before;
  for (const auto& border : borders) {
    if (!border) continue;
    // Two bands that overlap would leave no place where the level between them is drawn.
    if (before && *before * apart >= *border)
      return usage("--near, --medium and --far are too close to one another, or out of order",
                   "let each be farther than the one before by more than both bands of --hysteresis");
    before = border;
  }
  return {};
}

void stretch(const std::vector<double>& natural, std::size_t from, std::size_t to, std::vector<double>& out) {
  const double low = std::log(natural[from]), high = std::log(natural[to]);
  for (std::size_t i = from + 1; i < to; ++i) {
    const double even = double(i - from) / double(to - from);
    const double w = high > low ? (std::log(natural[i]) - low) / (high - low) : even;
    out[i] = out[from] * std::pow(out[to] / out[from], w);
  }
}

}  // namespace

std::size_t level_count(const Options& options) {
  const std::size_t named = std::max(options.discrete.size(), options.discrete_error.size());
  return named > 0 ? named : 2;
}

NamedDistances named_distances(const Options& options) {
  const std::size_t n = level_count(options);
  NamedDistances out{.near = {}, .levels = std::vector<std::optional<double>>(n)};
  const bool spare = n == 1   ? options.near && options.far
                     : n == 2 ? options.near && options.medium && options.far
                              : false;
  if (spare) out.near = options.near;
  if (options.near && !spare) out.levels.front() = options.near;
  if (options.medium && n > 1) out.levels[n == 2 && options.far ? 0 : 1] = options.medium;
  if (options.far) out.levels.back() = options.far;
  return out;
}

Result<void> check_distances(const Options& options) {
  const double apart = touching(options.hysteresis / 100);
  const std::size_t n = level_count(options);
  if (n == 1 && options.medium)
    return usage("--medium: there is one level alone, and it begins at --near",
                 "drop it, or name two levels or more");
  if (n == 1 && options.near && options.far && !options.continuous && options.foliage != FoliageMethod::prune)
    return usage("--near and --far: there is one level alone, and it begins at one distance",
                 "drop one of them, name two levels or more, or add --continuous, which goes from --near on");
  const bool falls = options.continuous || options.foliage == FoliageMethod::prune;
  if (falls && options.near && !(*options.near > 0))
    return usage("--near 0: detail falls in proportion to it, and nothing would be left at any distance",
                 "name a distance above 0");
  if (auto ordered = check_order(options, apart); !ordered) return ordered;
  if (std::pow(apart, double(n - 1)) > k_widest)
    return usage(fmt::format("--hysteresis {}: {} levels would lie farther apart than anything is seen",
                             options.hysteresis, n),
                 "name fewer levels, or a smaller --hysteresis");
  const NamedDistances named = named_distances(options);
  const std::vector<std::size_t> at = anchors(named);
  for (std::size_t k = 1; k < at.size(); ++k) {
    const double from = *named.levels[at[k - 1]], to = *named.levels[at[k]];
    if (from * std::pow(apart, double(at[k] - at[k - 1])) < to) continue;
    return usage(fmt::format("levels {} and {} begin at {:.4g} and {:.4g} m: with a hysteresis of {:.3g} % "
                             "some level between would be drawn nowhere",
                             at[k - 1] + 1, at[k] + 1, from, to, options.hysteresis),
                 "name distances that are farther apart, fewer levels, or a smaller --hysteresis");
  }
  return {};
}

std::vector<double> follow_named(const std::vector<double>& natural, const NamedDistances& named) {
  std::vector<double> out = natural;
  std::vector<std::size_t> at = anchors(named);
  for (const std::size_t i : at) out[i] = *named.levels[i];
  // From 0 on nothing is in proportion: what follows is as if nothing came before it.
  if (!at.empty() && !(out[at.front()] > 0)) at.erase(at.begin());
  if (at.empty()) return out;
  const std::size_t first = at.front(), last = at.back();
  const double nearer = std::min(1.0, out[first] / natural[first]),
               farther = std::max(1.0, out[last] / natural[last]);
  for (std::size_t i = 0; i < first; ++i)
    if (!named.levels[i]) out[i] = natural[i] * nearer;
  for (std::size_t i = last + 1; i < out.size(); ++i) out[i] = natural[i] * farther;
  for (std::size_t k = 1; k < at.size(); ++k) stretch(natural, at[k - 1], at[k], out);
  return out;
}

void keep_apart(std::vector<double>& distances, const NamedDistances& named, double hysteresis) {
  const double apart = touching(hysteresis);
  const std::vector<std::size_t> at = anchors(named);
  // Between two named ones there may be just enough room.
  const auto room = [&](std::size_t i) {
    const auto to = std::lower_bound(at.begin(), at.end(), i);
    if (to == at.end() || to == at.begin()) return apart * k_room;
    const double from = distances[*std::prev(to)];
    const double even = std::pow(distances[*to] / from, 1 / double(*to - *std::prev(to)));
    return from > 0 ? std::min(apart * k_room, even) : apart * k_room;
  };
  for (std::size_t i = 1; i < distances.size(); ++i)
    if (!named.levels[i]) distances[i] = std::max(distances[i], distances[i - 1] * room(i));
  for (std::size_t i = distances.size() - 1; i-- > 0;)
    if (!named.levels[i]) distances[i] = std::min(distances[i], distances[i + 1] / room(i + 1));
}

}  // namespace copse::lodbake
