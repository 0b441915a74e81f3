#include "lib/formats/levels/spectrum_draft.h"

#include <algorithm>

namespace copse {

std::string assemble_spectrum(std::vector<SpectrumDraft>& drafts, const std::vector<SpectrumVertex>& vertices,
                              Spectrum& spectrum) {
  std::stable_sort(drafts.begin(), drafts.end(), [](const SpectrumDraft& a, const SpectrumDraft& b) {
    return a.element.death != b.element.death ? a.element.death > b.element.death
                                              : a.element.birth < b.element.birth;
  });
  std::vector<std::uint32_t> number(vertices.size(), k_none), first{0};
  std::vector<SpectrumVertex> used;
  std::vector<SpectrumElement> elements;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const SpectrumDraft& d : drafts) {
    if (d.faces.empty()) return "an element without triangles";
    elements.push_back(d.element);
    for (std::array<std::uint32_t, 3> f : d.faces) {
      for (std::uint32_t& v : f) {
        if (number[v] == k_none)
          number[v] = static_cast<std::uint32_t>(used.size()), used.push_back(vertices[v]);
        v = number[v];
      }
      triangles.push_back(f);
    }
    first.push_back(static_cast<std::uint32_t>(triangles.size()));
  }
  spectrum.vertices = std::move(used), spectrum.elements = std::move(elements);
  spectrum.first_triangle = std::move(first), spectrum.triangles = std::move(triangles);
  return "";
}

}  // namespace copse
