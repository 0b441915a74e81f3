// At which distance an instance of a type is drawn in which of its levels, and where one fades into the next.
//
// Levels of the file go by distance, the picture behind them as well; where there is none, stochastic levels
// by how many pixels the tree is high. Between two of them both are drawn, each in its share of the pixels
// (an ordered dither), so that nothing pops.
#pragma once

#include "tools/treeplay/forest.h"

#include <cstdint>
#include <vector>

namespace copse::treeplay {

inline constexpr std::uint32_t k_impostor = 0xfffffffe;  // instead of a level's number

// Which pixels of a copy are drawn, as DrawCopy has it in the fourth byte of its tint.
inline constexpr std::uint8_t k_all_pixels = 255;
inline constexpr int k_fade_steps = 127;

struct LadderLevel {
  std::uint32_t level = 0;  // of ForestType::levels; k_impostor
  std::uint8_t pixels = k_all_pixels;
};

struct LadderChoice {
  LadderLevel main;   // with the larger share of the pixels
  LadderLevel other;  // fading out or in; level k_none: there is none
};

class LevelLadder {
 public:
  LevelLadder() = default;
  // `own`: in its own materials, those of its picture. `pixel`: tangent of the angle that one covers. `fade`:
  // a border's width to each side, as a share of its distance (0: none), never beyond half way to the next.
  LevelLadder(const ForestType& type, bool own, double pixel, double fade);

  // `away`: metres from the eye for a tree of scale 1.
  LadderChoice at(double away) const;

 private:
  struct Border {
    double distance = 0, from = 0, to = 0;  // fades between
    std::uint32_t level = 0;                // beyond it
  };
  std::vector<Border> borders_;  // ascending
};

}  // namespace copse::treeplay
