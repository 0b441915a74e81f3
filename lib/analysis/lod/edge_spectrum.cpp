#include "lib/analysis/lod/edge_spectrum.h"

#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>

namespace copse {
namespace {

using Corners = std::array<std::uint32_t, 3>;

}  // namespace

CollapsedState collapsed_state(const PartTriangles& mesh, const EdgeCollapses& collapses, std::size_t count) {
  std::vector<std::uint32_t> moved(mesh.vertices.size());
  for (std::uint32_t v = 0; v < moved.size(); ++v) moved[v] = v;
  // Backwards: when a vertex is thrown, where its keeper ends is known already.
  for (std::size_t i = collapses.first[count]; i-- > 0;)
    moved[collapses.wedges[i].thrown] = moved[collapses.wedges[i].kept];
  CollapsedState state;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corners& c = mesh.triangles[t];
    const Corners now{moved[c[0]], moved[c[1]], moved[c[2]]};
    const std::uint32_t a = mesh.position_of[now[0]], b = mesh.position_of[now[1]],
                        d = mesh.position_of[now[2]];
    if (a == b || b == d || d == a) continue;
    state.triangles.push_back(now);
    state.source.push_back(t);
  }
  return state;
}

Spectrum edge_spectrum(const PartTriangles& mesh, const EdgeCollapses& collapses,
                       std::span<const std::uint32_t> radius_of) {
  SpectrumBuilder builder(LodMethod::edges);
  for (const SpectrumVertex& v : mesh.vertices) builder.vertex(v);
  std::vector<Corners> now = mesh.triangles;
  std::vector<std::uint32_t> element(now.size());
  // The triangles of every vertex, as chains through corners; a collapse hangs one chain behind another.
  std::vector<std::uint32_t> head(mesh.vertices.size(), k_none), tail(mesh.vertices.size(), k_none),
      next(3 * now.size(), k_none);
  const auto radius = [&](std::uint32_t t) { return radius_of.empty() ? k_none : radius_of[t]; };
  const auto degenerate = [&](const Corners& t) {
    const std::uint32_t a = mesh.position_of[t[0]], b = mesh.position_of[t[1]], c = mesh.position_of[t[2]];
    return a == b || b == c || c == a;
  };
  for (std::uint32_t t = 0; t < now.size(); ++t) {
    element[t] = builder.element(mesh.materials[t], radius(t), std::span(&now[t], 1));
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t v = now[t][c], at = 3 * t + c;
      (head[v] == k_none ? head[v] : next[tail[v]]) = at;
      tail[v] = at;
    }
  }
  double error = 0;
  for (std::size_t i = 0; i < collapses.size(); ++i) {
    error = std::max(error, static_cast<double>(collapses.errors[i]));
    builder.step(error);
    if (i == 0) {
      for (std::uint32_t t = 0; t < now.size(); ++t)
        if (degenerate(now[t])) builder.remove(element[t]), element[t] = k_none;
    }
    for (std::uint32_t w = collapses.first[i]; w < collapses.first[i + 1]; ++w) {
      const auto [thrown, kept] = collapses.wedges[w];
      for (std::uint32_t at = head[thrown]; at != k_none; at = next[at]) {
        const std::uint32_t t = at / 3;
        now[t][at % 3] = kept;
        if (element[t] == k_none) continue;
        builder.remove(element[t]);
        element[t] = degenerate(now[t])
                         ? k_none
                         : builder.element(mesh.materials[t], radius(t), std::span(&now[t], 1));
      }
      if (head[thrown] == k_none) continue;
      (head[kept] == k_none ? head[kept] : next[tail[kept]]) = head[thrown];
      tail[kept] = tail[thrown];
    }
  }
  return builder.finish();
}

}  // namespace copse
