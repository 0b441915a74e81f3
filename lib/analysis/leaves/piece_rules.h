// piece_rules: trunk or leaf, piece by piece, from verdicts, shapes and places, with the reason in words.
#pragma once

#include "lib/analysis/leaves/classify.h"
#include "lib/analysis/leaves/part_verdicts.h"
#include "lib/analysis/leaves/piece_scan.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace copse {

struct PieceClasses {
  std::vector<PartClass> kind;        // one a piece
  std::vector<std::uint32_t> reason;  // one a piece: index into reasons
  std::vector<std::string> reasons;   // each once
};

// docs/leaves.md lists the rules in their order. Linear, but for piles of unlike blobs: of those fewer than
// k_piled of a kind are compared with each other, at most 2000 comparisons a triangle.
PieceClasses classify_pieces_by_rule(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                     const PieceScan& scan, std::span<const PartVerdict> verdicts);

}  // namespace copse
