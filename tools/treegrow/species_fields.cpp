#include "tools/treegrow/species_fields.h"

namespace copse::grow {
namespace {

template <class Enum>
Choice choice(Enum& value) {
  Choice result{reinterpret_cast<std::uint8_t*>(&value), {}};  // an enum may be looked at as bytes
  static_assert(sizeof(Enum) == 1);
  for (std::uint8_t i = 0; *to_string(static_cast<Enum>(i)) != '\0'; ++i)
    result.names.push_back(to_string(static_cast<Enum>(i)));
  return result;
}

void add_tree(Species& s, std::vector<Field>& f) {
  const auto number = [&](const char* name, double& value, double low, double high, const char* meaning) {
    f.push_back({"", name, Number{&value, low, high}, meaning});
  };
  f.push_back({"", "name", Word{&s.name}, "of the species: what objects and materials are called after"});
  f.push_back({"", "summary", Word{&s.summary}, "one line for --list"});
  number("height", s.height, 1e-3, 1e4, "m, of an ordinary specimen");
  number("height_v", s.height_v, 0, 0.9, "+- share");
  number("ratio", s.ratio, 1e-4, 1, "radius of the trunk's base / height (grass: half the width / height)");
  number("ratio_power", s.ratio_power, 0, 10,
         "a branch is thinner than its parent by (length / parent's) ^ this");
  number("flare", s.flare, 0, 20, "thickening of the foot, share of the radius");
  number("lobes", s.lobes, 0, 20, "buttresses round the foot");
  number("lobe_depth", s.lobe_depth, 0, 0.9, "their depth, share of the radius");
  number("envelope_bottom", s.envelope_bottom, 0, 0.98, "share of the trunk that is bare below the crown");
  f.push_back(
      {"", "envelope", choice(s.envelope), "length of the branches from the crown's bottom to its top"});
  number("stems", s.stems, 1, 1e4, "from the root, each a hierarchy of its own");
  number("spread", s.spread, 0, 10, "radius of the clump that they make, share of the height");
  number("stem_lean", s.stem_lean, -80, 80, "degrees outward, of the outermost");
  number("clearance", s.clearance, 0, 0.9,
         "nothing but roots comes nearer to the ground, share of the height");
  number("root_depth", s.root_depth, 1e-4, 1, "of the root ring under the ground, share of the height");
  number("min_radius", s.min_radius, 1e-6, 0.1, "of any twig, share of the height");
  number("broken", s.broken, 0, 1, "share of the branches that are broken off");
  number("ring_size", s.ring_size, 2, 1000, "k, the vertices of every ring of the strict model");
  f.push_back({"", "bark", choice(s.bark), "what its texture looks like"});
  number("bark_repeat", s.bark_repeat, 1, 100, "repetitions of the texture round the trunk");
  f.push_back({"", "bark_colour", Colour{&s.bark_colour}, "linear RGB"});
}

void add_level(Level& l, const char* table, bool trunk, std::vector<Field>& f) {
  const auto number = [&](const char* name, double& value, double low, double high, const char* meaning) {
    f.push_back({table, name, Number{&value, low, high}, meaning});
  };
  if (!trunk) number("branches", l.branches, 0, 1e5, "stems of this level on a stem of the level before");
  number("length", l.length, 1e-3, 10, trunk ? "share of the height" : "share of the parent's length");
  number("length_v", l.length_v, 0, 0.9, "+- share");
  if (!trunk)
    number("bare", l.bare, 0, 0.98, "share of the parent, from its base, that bears none (not on trunks)");
  number("taper", l.taper, 0, 3, "0 cylinder, 1 cone, to 2 rounded end, to 3 bulges (palms)");
  number("curve", l.curve, -1000, 1000, "degrees over the stem; positive bends to the ground");
  number("curve_back", l.curve_back, -1000, 1000, "if not 0: instead, over the second half");
  number("curve_v", l.curve_v, 0, 1000, "degrees, bends to any side");
  number("attraction_up", l.attraction_up, -100, 100, "steady pull to the sky; negative hangs");
  number("splits", l.splits, 0, 100, "forks of a stem");
  number("split_angle", l.split_angle, 0, 180, "degrees between the arms");
  number("split_angle_v", l.split_angle_v, 0, 180, "+- degrees");
  if (!trunk) {
    number("down_angle", l.down_angle, 0, 180, "degrees between the stem and its parent, at the bottom");
    number("down_angle_top", l.down_angle_top, 0, 180, "at the top");
    number("down_angle_v", l.down_angle_v, 0, 180, "+- degrees");
    number("rotate", l.rotate, -360, 360,
           "degrees round the parent to the next; negative: to alternate sides");
    number("rotate_v", l.rotate_v, 0, 360, "+- degrees");
    number("whorl", l.whorl, 1, 100, "stems at one height");
  }
  number("nodes", l.nodes, 1, 1000, "points that the curve is drawn through");
  number("segments", l.segments, 1, 1e6, "generalized cylinders of an ordinary stem");
  number("sides", l.sides, 2, 1000, "k of this level with --break vary-k");
}

void add_leaves(Foliage& l, std::vector<Field>& f) {
  const auto number = [&](const char* name, double& value, double low, double high, const char* meaning) {
    f.push_back({"leaves", name, Number{&value, low, high}, meaning});
  };
  f.push_back({"leaves", "art", choice(l.art), "what the texture shows"});
  number("count", l.count, 0, 1e6, "on a stem of the last level");
  number("length", l.length, 1e-3, 100, "share of a tenth of the height");
  number("width", l.width, 1e-3, 100, "the same");
  number("size_v", l.size_v, 0, 0.9, "+- share");
  number("first", l.first, 0, 0.98, "share of the stem, from its base, that bears none");
  number("down_angle", l.down_angle, 0, 180, "degrees between leaf and stem, at the stem's base");
  number("down_angle_top", l.down_angle_top, 0, 180, "at its tip");
  number("down_angle_v", l.down_angle_v, 0, 180, "+- degrees");
  number("rotate", l.rotate, -360, 360, "as for stems");
  number("rotate_v", l.rotate_v, 0, 360, "+- degrees");
  number("face_up", l.face_up, 0, 1, "0 blades face along the stem, 1 the sky");
  number("hang", l.hang, 0, 1, "how far they bend to the ground");
  number("outward_normals", l.outward_normals, 0, 1, "how much normals lean out of the crown");
  number("clumps", l.clumps, 0, 10, "leaves on the level before the last, share of those on the last");
  f.push_back({"leaves", "colour", Colour{&l.colour}, "linear RGB of most leaves"});
  f.push_back({"leaves", "tint", Colour{&l.tint}, "linear RGB that the others lean to"});
}

}  // namespace

std::vector<Field> fields_of(Species& species) {
  std::vector<Field> fields;
  add_tree(species, fields);
  for (std::size_t l = 0; l < species.levels.size(); ++l)
    add_level(species.levels[l], k_level_tables[l], l == 0, fields);
  add_leaves(species.leaves, fields);
  fields.push_back({"grass", "blades", Number{&species.grass.blades, 0, 1e6},
                    "strips of the block; 0: not a block of grass"});
  fields.push_back({"grass", "block", Number{&species.grass.block, 1e-3, 1e4}, "m, edge of the block"});
  fields.push_back({"grass", "lean", Number{&species.grass.lean, 0, 80}, "+- degrees"});
  return fields;
}

}  // namespace copse::grow
