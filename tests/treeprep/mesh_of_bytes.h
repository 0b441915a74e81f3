// A job for treeprep made from any bytes, for the fuzzer and the tests that replay what it found: the first
// bytes choose the options, the others pieces of a mesh, one after another.
#pragma once

#include "lib/formats/mesh.h"
#include "tools/treeprep/options.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace copse {

struct PrepareJob {
  Mesh mesh;  // keeps the promises of import.h
  treeprep::Options options;
  bool still = false;  // a .tree, else an .stree
};

// Tubes with every kind of end, soups, lumps, folded sheets, pages round one edge, repeated and flipped
// pieces, triangles between vertices that are there, vertices that fall together; at any scale, far from the
// origin, flattened or drawn out. No piece is begun once `most_triangles` are reached; none has more than
// 1200.
PrepareJob job_of_bytes(std::span<const std::uint8_t> bytes, std::size_t most_triangles);

// Bytes of a random job, by its number.
std::vector<std::uint8_t> random_job(std::uint64_t number);

// Runs the analysis as the tool does, writes the tree and loads it. What is wrong with the result; empty when
// it is sound or was refused as a user's fault is.
std::string prepare_job(PrepareJob job);

}  // namespace copse
