// The corners of leaves that stand for others, coded beside those (spectrum_leaves.h): as one of them that
// has grown, or a regular triangle or rectangle in a frame, or corner by corner; in units of 1/32 of the
// leaf's size. Full areas are kept: a leaf is as large as all triangles that it stands for, unless it is said
// otherwise.
#pragma once

#include "lib/formats/levels/leaf_forest.h"
#include "lib/formats/packing/octahedral.h"
#include "lib/formats/packing/pack_trunk.h"
#include "lib/formats/packing/range_coder.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace copse {

class MadeLeaves {
 public:
  // `texcoord_step`: texture coordinates are whole numbers of it.
  MadeLeaves(RangeCoder& coder, const PartTriangles& part, double texcoord_step);

  // What every node stands for in all; to be called once the forest's structure is there.
  void sum(const LeafForest& forest);
  double area(std::uint32_t node) const { return sums_[node].area; }

  // Faces and vertices of the node, those of what it stands for being there. Encoding puts what a reader will
  // get in their place. What is wrong, empty when nothing is.
  std::string code(LeafForest& forest, std::uint32_t node);

 private:
  using Face = std::array<std::uint32_t, 3>;
  struct Sum {
    double area = 0;
    Double3 first{}, shading{};  // area x centre, area x normal
  };
  struct Member {
    std::vector<SpectrumVertex> vertices;
    std::vector<Face> faces;
    double area = 0;
  };
  struct Fit {
    std::int64_t like = 0, about = 0, size = 0, stretch = 0, turn = 0;
    std::array<std::int64_t, 3> move{};
    Octahedral normal{};
    bool half = false, other = false;
    std::vector<Double3> places;
    double error = 0;
  };

  std::vector<Member> members(const LeafForest& forest, std::uint32_t node) const;
  bool code_faces(LeafForest::Node& node);
  std::vector<Double3> grown(const Fit& fit, const std::vector<Member>& list) const;
  std::vector<Double3> framed(const Fit& fit, std::size_t corners, const Sum& sum) const;
  Fit fit_grown(const LeafForest::Node& node, const std::vector<Member>& list) const;
  Fit fit_framed(const LeafForest::Node& node, const Sum& sum) const;
  bool code_places(LeafForest::Node& node, const std::vector<Member>& list, const Sum& sum,
                   std::size_t& like);
  bool code_corners(LeafForest::Node& node, const Sum& sum);
  void code_normals(LeafForest::Node& node, const Member* like, const Sum& sum);
  bool code_texcoords(LeafForest::Node& node);
  bool code_number(std::int64_t& value, SignedModel& model, std::int64_t limit);

  RangeCoder& c_;
  const PartTriangles& part_;
  double texcoord_step_;
  std::vector<Sum> sums_;
  std::vector<std::vector<Face>> recent_faces_;
  std::vector<std::vector<Grid2>> recent_texcoords_;
  std::array<NumberModel, 6> number_;
  NumberModel mode_, like_, about_, normal_mode_, face_index_, which_faces_, which_texcoords_;
  SignedModel size_, power_, framed_size_, stretch_, turn_, corner_, first_corner_, texcoord_;
  std::array<SignedModel, 2> move_, normal_, shade_;
  BitModel half_, other_;
};

}  // namespace copse
