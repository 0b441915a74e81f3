// What a species of tree is: the parameters of the growth model. --print writes them as TOML, --params reads
// them back; docs/treegrow.md explains each with its effect.
//
// The model is that of Weber and Penn, "Creation and rendering of realistic trees" (SIGGRAPH 1995), with
// three liberties: angles say what they do in words (positive curve bends down), forks share their area by
// the pipe model, and every stem has its own random stream, so that changing one level leaves the others
// alone.
#pragma once

#include "lib/formats/vec.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace copse::grow {

// How long the branches of level 1 are, from the lowest (x = 0) to the highest (x = 1) on the trunk.
enum class Envelope : std::uint8_t {
  conical,        // 1 at the bottom, 0.2 at the top: conifers
  spherical,      // longest in the middle
  hemispherical,  // longest at the bottom, round top
  cylindrical,    // the same everywhere
  tapered,        // 1 at the bottom, 0.5 at the top
  flame,          // longest at 0.3
  inverse,        // longest at the top: vases
  umbrella,       // short until the upper half
};

// The drawing on a leaf's texture.
enum class LeafArt : std::uint8_t {
  none,
  oak,      // a spray of lobed leaves
  birch,    // a spray of small toothed diamonds
  needles,  // a flat shoot of needles
  pine,     // a tuft of long needles
  palm,     // one long leaflet
  willow,   // a string of narrow leaves
  round,    // a spray of small round leaves
  blossom,  // flowers and a few leaves
  grass,    // blades
};

enum class BarkArt : std::uint8_t { furrowed, birch, scaly, palm, ridged, smooth, weathered, grass };

// One level of branching: 0 is the trunk, the last one carries the leaves. Angles in degrees; every `_v` is a
// uniform variation to both sides.
struct Level {
  double branches = 0;  // stems of this level on each stem of the level before (level 0: unused)
  double length = 1;    // share of the length that the model gives: level 0 of the height
  double length_v = 0;
  double bare = 0;            // share of the *parent's* length, from its base, that carries none of them
  double taper = 1;           // 0 cylinder, 1 cone, 1 to 2 rounded end, 2 to 3 periodic bulges (palms)
  double curve = 0;           // bend over the whole stem; positive: towards the ground
  double curve_back = 0;      // if not 0, the second half bends by this instead
  double curve_v = 0;         // random bend, in any direction
  double attraction_up = 0;   // steady pull: positive to the sky, negative to the ground (weeping)
  double splits = 0;          // forks a stem of this level makes, on average
  double split_angle = 0;     // between the two arms
  double split_angle_v = 0;   //
  double down_angle = 45;     // between the stem and its parent's direction, for the lowest stem
  double down_angle_top = 0;  // the same for the highest; in between it runs linearly
  double down_angle_v = 0;    //
  double rotate = 137.5;      // turn round the parent from one stem to the next; negative: alternate sides,
                              // that far from the parent's upper side
  double rotate_v = 0;        //
  double whorl = 1;           // stems that leave the parent at one height
  double nodes = 6;           // points that the curve is drawn through
  double segments = 6;        // generalized cylinders of a stem of ordinary length, at detail 1
  double sides = 6;           // ring vertices k at detail 1, with --break vary-k
};

struct Foliage {
  LeafArt art = LeafArt::none;
  double count = 0;     // leaves a stem of the last level, at detail 1
  double length = 0.5;  // of a card, as a share of the nominal height / 10
  double width = 0.5;
  double size_v = 0.15;                // share
  double first = 0.1;                  // share of the stem that is bare
  double down_angle = 45;              // between leaf and stem at the stem's base
  double down_angle_top = 45;          // and at its tip
  double down_angle_v = 15;            //
  double rotate = 137.5;               // as for stems
  double rotate_v = 20;                //
  double face_up = 0.5;                // 0: blades face along the stem, 1: blades face the sky
  double hang = 0;                     // how far leaves bend to the ground by their weight, 0 to 1
  double outward_normals = 0.7;        // how much the shading normal leans outward from the crown's middle
  double clumps = 0;                   // leaves on the level before the last, as a share of `count`
  Float3 colour{0.20f, 0.33f, 0.09f};  // linear RGB of the typical leaf
  Float3 tint{0.30f, 0.36f, 0.08f};    // what the others lean to
};

// A block of billboards (digest 000, section 4.9) instead of a tree.
struct Grass {
  double blades = 0;  // 0: not a grass block
  double block = 1;   // edge of the square block, m at nominal height
  double lean = 20;   // degrees, either way
};

struct Species {
  std::string name;
  std::string summary;
  double height = 10;          // m, of an ordinary specimen
  double height_v = 0;         // share
  double ratio = 0.02;         // base radius / trunk length
  double ratio_power = 1.2;    // how fast branches get thinner than their parents: r ~ length^power
  double flare = 0.5;          // thickening of the foot, share of the radius
  double lobes = 0;            // buttresses of the foot
  double lobe_depth = 0;       // share of the radius
  double envelope_bottom = 0;  // share of the trunk's length that is bare below the crown
  Envelope envelope = Envelope::spherical;
  double stems = 1;            // stems from the root
  double spread = 0;           // how far apart these stand, share of the height
  double stem_lean = 0;        // degrees from the vertical
  double clearance = 0.05;     // no branch and no leaf comes nearer to the ground, share of the height
  double root_depth = 0.02;    // of the root ring under the ground, share of the height
  double min_radius = 0.0004;  // of any twig, share of the height
  double broken = 0;           // share of branches that are broken off (dead trees)
  double ring_size = 6;        // k of the strict model at detail 1
  std::vector<Level> levels;   // 1 to 4
  Foliage leaves;
  Grass grass;
  BarkArt bark = BarkArt::furrowed;
  double bark_repeat = 2;                   // repetitions round the trunk
  Float3 bark_colour{0.18f, 0.13f, 0.09f};  // linear RGB
};

// The species that come with the tool, in the order of --list: the files in species/.
const std::vector<std::string>& species_names();

// The built-in species of a name; nothing when there is none.
std::optional<Species> find_species(std::string_view name);

const char* to_string(Envelope envelope);
const char* to_string(LeafArt art);
const char* to_string(BarkArt art);

// `x` in [0, 1]; the result in [0.05, 1].
double envelope_length(Envelope envelope, double x);

}  // namespace copse::grow
