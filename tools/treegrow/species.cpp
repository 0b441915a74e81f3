#include "tools/treegrow/species.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse::grow {
const char* to_string(Envelope envelope) {
  switch (envelope) {
    case Envelope::conical:
      return "conical";
    case Envelope::spherical:
      return "spherical";
    case Envelope::hemispherical:
      return "hemispherical";
    case Envelope::cylindrical:
      return "cylindrical";
    case Envelope::tapered:
      return "tapered";
    case Envelope::flame:
      return "flame";
    case Envelope::inverse:
      return "inverse";
    case Envelope::umbrella:
      return "umbrella";
  }
  return "";
}

const char* to_string(LeafArt art) {
  switch (art) {
    case LeafArt::none:
      return "none";
    case LeafArt::oak:
      return "oak";
    case LeafArt::birch:
      return "birch";
    case LeafArt::needles:
      return "needles";
    case LeafArt::pine:
      return "pine";
    case LeafArt::palm:
      return "palm";
    case LeafArt::willow:
      return "willow";
    case LeafArt::round:
      return "round";
    case LeafArt::blossom:
      return "blossom";
    case LeafArt::grass:
      return "grass";
  }
  return "";
}

const char* to_string(BarkArt art) {
  switch (art) {
    case BarkArt::furrowed:
      return "furrowed";
    case BarkArt::birch:
      return "birch";
    case BarkArt::scaly:
      return "scaly";
    case BarkArt::palm:
      return "palm";
    case BarkArt::ridged:
      return "ridged";
    case BarkArt::smooth:
      return "smooth";
    case BarkArt::weathered:
      return "weathered";
    case BarkArt::grass:
      return "grass";
  }
  return "";
}

double envelope_length(Envelope envelope, double x) {
  const double y = 1 - std::clamp(x, 0.0, 1.0);  // distance from the top, as a share of the crown
  constexpr double k_pi = std::numbers::pi;
  switch (envelope) {
    case Envelope::conical:
      return 0.06 + 0.94 * y;
    case Envelope::spherical:
      return 0.2 + 0.8 * std::sin(k_pi * y);
    case Envelope::hemispherical:
      return 0.2 + 0.8 * std::sin(0.5 * k_pi * y);
    case Envelope::cylindrical:
      return 1;
    case Envelope::tapered:
      return 0.5 + 0.5 * y;
    case Envelope::flame:
      return y <= 0.7 ? 0.1 + 0.9 * y / 0.7 : 0.5 + 0.5 * (1 - y) / 0.3;
    case Envelope::inverse:
      return 1 - 0.8 * y;
    case Envelope::umbrella:
      return y > 0.5 ? 0.15 : 1 - 0.6 * y;
  }
  return 1;
}

}  // namespace copse::grow
