#include "lib/analysis/leaves/piece_rules.h"

#include "lib/analysis/leaves/end_to_end.h"
#include "lib/analysis/leaves/stem_contacts.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace copse {
namespace {

// What a piece was found to be; the words are below.
enum class Finding : std::uint8_t {
  named,         // a firm verdict
  sheet,         // leaf
  few_sheets,    // trunk: in a mesh that is all named trunk, a sheet or a few are bark
  cap,           // trunk
  ground,        // trunk
  blade,         // trunk: grass moves from its root, each blade a strip of its own (thesis 5.6)
  stem,          // trunk
  continued,     // trunk: a blob or sheet that a stem goes on from, end to end
  squat,         // trunk: a plate among many stems of as many triangles
  needle,        // leaf
  carried_stem,  // leaf: a slender crown
  named_stem,    // leaf: in a mesh that is all named leaf, a stem that hangs on no trunk
  blob,          // leaf
  named_blob,    // trunk
  brown_blob,    // trunk
  pillar,        // trunk: a blob that carries wider ones
  stump,         // trunk: the largest blob on the ground, under cards
  only_piece,    // trunk: a blob that is all there is
};

bool is_trunk(Finding f, NameClass named) {
  switch (f) {
    case Finding::named:
      return named == NameClass::trunk;
    case Finding::few_sheets:
    case Finding::cap:
    case Finding::ground:
    case Finding::blade:
    case Finding::stem:
    case Finding::continued:
    case Finding::squat:
    case Finding::named_blob:
    case Finding::brown_blob:
    case Finding::pillar:
    case Finding::stump:
    case Finding::only_piece:
      return true;
    default:
      return false;
  }
}

// --- thresholds ------------------------------------------------------------------------------------------

constexpr std::uint32_t k_many = 8;       // alike sheets are foliage whatever the mesh is called
constexpr std::uint32_t k_piled = 32;     // blobs with so many alike are foliage, not trunks
constexpr std::uint32_t k_needles = 100;  // alike spikes
constexpr std::uint32_t k_needle_triangles = 12;
constexpr double k_needle_size = 0.03;      // of the mesh's height
constexpr std::uint32_t k_squat = 3;        // stems for each plate of as many triangles that is one of them
constexpr double k_trunk_size = 0.25;       // of the mesh's height: what a trunk has at least
constexpr double k_on_ground = 0.1;         // of the mesh's height: roots and slopes
constexpr double k_ground_thickness = 0.1;  // of the mesh's height
constexpr double k_lowest = 0.02;           // of the mesh's height
constexpr double k_meadow = 0.5;            // of the mesh's width: over which blades stand
constexpr double k_narrower = 0.8;          // a trunk's width over that of the crown on it
constexpr double k_lone_sheet = 16;         // a trunk in one open surface is so many times any leaf's area
constexpr double k_much_narrower = 0.6;     // the same where the crown is as slender as a stem
constexpr double k_bulky_elongation = 6, k_bulky_fill = 0.3;  // slender crowns

// --- colours ---------------------------------------------------------------------------------------------

Float3 colour_of(const Material& m) {
  return {m.diffuse.x * m.mean_colour.x, m.diffuse.y * m.mean_colour.y, m.diffuse.z * m.mean_colour.z};
}
bool is_green(const Material& m) {
  const Float3 c = colour_of(m);
  return c.y > 1.15f * c.x && c.y > 1.15f * c.z;
}
bool is_brown(const Material& m) {
  const Float3 c = colour_of(m);
  return c.x > 1.15f * c.y && c.y > 1.1f * c.z && c.x < 0.6f;
}

class Rules {
 public:
  Rules(const Mesh& mesh, std::span<const std::uint32_t> welded, const PieceScan& scan,
        std::span<const PartVerdict> verdicts)
      : mesh_(mesh), welded_(welded), scan_(scan), verdicts_(verdicts), found_(scan.pieces().count) {
    height_ = scan.bounds().empty() ? 0 : scan.bounds().extent().y;
    ground_ = scan.bounds().empty() ? 0 : scan.bounds().min.y;
  }

  std::vector<Finding> run() {
    look_at_materials();
    for (std::uint32_t p = 0; p < found_.size(); ++p) found_[p] = first_look(p);
    find_chains();
    find_caps();
    for (const PlacedPiece& placed : scan_.placed()) look_at_place(placed);
    find_named_stems();
    find_continued();
    find_squat();
    find_piles();
    find_stump();
    return std::move(found_);
  }

 private:
  const PartVerdict& verdict(std::uint32_t p) const { return verdicts_[scan_.part(p)]; }
  bool trunk(std::uint32_t p) const { return is_trunk(found_[p], verdict(p).kind); }
  std::size_t triangle_count(std::uint32_t p) const { return scan_.triangles().of(p).size(); }

  Finding first_look(std::uint32_t p) const {
    const PieceFact& fact = scan_.fact(p);
    if (fact.decided) return Finding::named;
    const PartVerdict& v = verdict(p);
    if (fact.shape == ShapeKind::stem) return Finding::stem;
    if (fact.shape == ShapeKind::blob) {
      if (v.kind == NameClass::trunk) return Finding::named_blob;
      return v.kind == NameClass::none && found_.size() == 1 ? Finding::only_piece : Finding::blob;
    }
    if (is_blade(p)) return Finding::blade;
    const bool bark = v.kind == NameClass::trunk && v.binding == Binding::whole;
    return bark && scan_.alike(p) < k_many ? Finding::few_sheets : Finding::sheet;
  }

  // Named grass, or a mesh that is nothing but strips: rooted as the thesis asks, or many of them standing
  // all over the ground (the fronds of a fern begin in one place).
  bool is_blade(std::uint32_t p) const {
    const PieceFact& fact = scan_.fact(p);
    if (verdict(p).grass.empty()) return all_rooted_strips_ || all_standing_strips_;
    return fact.strip && fact.stands;
  }

  void look_at_materials() {
    constexpr std::size_t k_blade_triangles = 4;  // without a name; fewer are cards
    for (std::uint32_t p = 0; p < found_.size(); ++p) {
      const bool may_be_blade = verdict(p).kind == NameClass::none && triangle_count(p) >= k_blade_triangles;
      all_rooted_strips_ = all_rooted_strips_ && may_be_blade && scan_.fact(p).rooted;
      all_standing_strips_ = all_standing_strips_ && may_be_blade && scan_.fact(p).footed;
      if (scan_.fact(p).decided) {
        any_named_leaf_ |= verdict(p).kind == NameClass::leaf;
        continue;
      }
      any_sheet_ |= scan_.fact(p).shape == ShapeKind::sheet;
      if (const Material* m = material_of(p)) any_green_ |= is_green(*m);
    }
    const Double3 feet = scan_.feet().extent(), all = scan_.bounds().extent();
    all_standing_strips_ = all_standing_strips_ && found_.size() >= k_many &&
                           std::max(feet.x, feet.z) >= k_meadow * std::max(all.x, all.z);
  }
  const Material* material_of(std::uint32_t p) const {
    const std::uint32_t m = mesh_.parts[scan_.part(p)].material;
    return m < mesh_.materials.size() ? &mesh_.materials[m] : nullptr;
  }

  bool is_ground(const PieceShape& s) const {
    const Double3 all = scan_.bounds().extent(), e = s.box.extent();
    return height_ > 0 && e.y <= k_ground_thickness * height_ && e.x >= 0.5 * all.x && e.z >= 0.5 * all.z &&
           s.box.min.y <= ground_ + k_lowest * height_ && scan_.pieces().count > 1;
  }
  bool stands_on_ground(const PieceShape& s) const { return s.box.min.y <= ground_ + k_on_ground * height_; }

  void look_at_place(const PlacedPiece& placed) {
    const std::uint32_t p = placed.piece;
    const PieceShape& s = placed.shape;
    const PartVerdict& v = verdict(p);
    Finding& found = found_[p];
    if (v.kind != NameClass::leaf && is_ground(s) && s.kind != ShapeKind::stem) {
      found = Finding::ground;
    } else if (found == Finding::stem && v.kind != NameClass::trunk && is_needle(p, s)) {
      found = Finding::needle;
    } else if (found == Finding::blob && any_green_ && material_of(p) && is_brown(*material_of(p))) {
      found = Finding::brown_blob;
    }
  }
  // In a mesh that is all named leaf the name says nothing of a trunk, nor of what hangs on one.
  void find_named_stems() {
    std::vector<std::uint32_t> stems, standing;
    double thickest = 0;
    for (std::uint32_t i = 0; i < scan_.placed().size(); ++i) {
      const auto& [p, s] = scan_.placed()[i];
      if (found_[p] != Finding::stem || !is_whole_leaf(p)) continue;
      stems.push_back(i);
      if (!stands_on_ground(s) || s.size < k_trunk_size * height_) continue;
      standing.push_back(i);
      thickest = std::max(thickest, thickness(s));
    }
    const std::vector<std::uint8_t> is_wood = stem_contacts(mesh_, scan_, stems, standing);
    for (std::size_t i = 0; i < stems.size(); ++i) {
      const auto& [p, s] = scan_.placed()[stems[i]];
      if (is_bulky(s) && thickness(s) > thickest) {
        found_[p] = Finding::carried_stem;
      } else if (!is_wood[i]) {
        found_[p] = Finding::named_stem;
      }
    }
  }
  static double thickness(const PieceShape& s) { return s.size > 0 ? s.area / s.size : 0; }
  static bool is_bulky(const PieceShape& s) {
    return s.elongation <= k_bulky_elongation && s.fill >= k_bulky_fill;
  }
  bool is_whole_leaf(std::uint32_t p) const {
    return verdict(p).kind == NameClass::leaf && verdict(p).binding == Binding::whole;
  }
  // Thousands of equal spikes are needles, unless there are other leaves or they go on from one another: then
  // they are twigs.
  bool is_needle(std::uint32_t p, const PieceShape& s) const {
    return !any_sheet_ && !is_chained(p) && !any_named_leaf_ && triangle_count(p) <= k_needle_triangles &&
           scan_.alike(p) >= k_needles && s.size <= k_needle_size * height_;
  }

  // --- tubes laid end to end ---------------------------------------------------------------

  bool is_chained(std::uint32_t p) const { return !chain_of_.empty() && chain_size_[chain_of_[p]] > 1; }

  // Which pieces go on from one another, where that can tell anything of one.
  void find_chains() {
    constexpr std::size_t k_tube_triangles = 6;
    std::vector<std::uint32_t> asked;
    bool doubtful = false;
    for (std::uint32_t p = 0; p < found_.size(); ++p) {
      const PieceFact& fact = scan_.fact(p);
      if (fact.decided || fact.planar || fact.strip || triangle_count(p) < k_tube_triangles) continue;
      asked.push_back(p);
      doubtful |= !trunk(p) || triangle_count(p) <= k_needle_triangles;
    }
    if (!doubtful) return;
    chain_of_ = end_to_end(mesh_, welded_, scan_.pieces(), scan_.triangles(), asked);
    chain_size_.assign(found_.size(), 0);
    for (const std::uint32_t c : chain_of_) ++chain_size_[c];
  }

  // What goes on from trunk is trunk; so is a chain that is long for its thickness, whatever its links are.
  void find_continued() {
    if (chain_of_.empty()) return;
    std::vector<std::uint8_t> wooden(found_.size(), 0);
    std::vector<std::uint32_t> links;
    for (std::uint32_t p = 0; p < found_.size(); ++p) {
      if (!is_chained(p)) continue;
      links.push_back(p);
      wooden[chain_of_[p]] |= trunk(p);
    }
    std::ranges::stable_sort(links, {}, [&](std::uint32_t p) { return chain_of_[p]; });
    for (std::size_t begin = 0, end = 0; begin < links.size(); begin = end) {
      const std::uint32_t chain = chain_of_[links[begin]];
      while (end < links.size() && chain_of_[links[end]] == chain) ++end;
      const std::span<const std::uint32_t> all = std::span(links).subspan(begin, end - begin);
      if (!wooden[chain] && !is_long(all)) continue;
      for (const std::uint32_t p : all) {
        if (found_[p] == Finding::blob || found_[p] == Finding::sheet) found_[p] = Finding::continued;
      }
    }
  }
  bool is_long(std::span<const std::uint32_t> pieces) const {
    std::vector<std::uint32_t> triangles;
    for (const std::uint32_t p : pieces) {
      const auto of = scan_.triangles().of(p);
      triangles.insert(triangles.end(), of.begin(), of.end());
    }
    return shape_of(mesh_, welded_, scan_.pieces(), triangles).kind == ShapeKind::stem;
  }

  // A last twig may be as short as it is wide, and thin by chance: where most things of as many triangles in
  // its part are stems, it is one.
  void find_squat() {
    std::unordered_map<std::uint64_t, std::uint32_t> stems, plates;  // by part and triangles; looked up only
    const auto key = [&](std::uint32_t p) { return std::uint64_t{scan_.part(p)} << 32 | triangle_count(p); };
    const auto is_plate = [&](std::uint32_t p) {
      return found_[p] == Finding::sheet && scan_.fact(p).solid && !scan_.fact(p).planar;
    };
    bool any = false;
    for (std::uint32_t p = 0; p < found_.size(); ++p) any = any || is_plate(p);
    if (!any) return;
    for (std::uint32_t p = 0; p < found_.size(); ++p) {
      if (is_plate(p)) ++plates[key(p)];
      if (found_[p] == Finding::stem) ++stems[key(p)];
    }
    for (std::uint32_t p = 0; p < found_.size(); ++p) {
      if (is_plate(p) && stems[key(p)] >= k_squat * plates[key(p)]) found_[p] = Finding::squat;
    }
  }

  // --- caps: a few triangles of another material that close a tube ---------------------------------------

  struct BorderEdge {
    std::uint32_t low, high, piece;
    auto operator<=>(const BorderEdge&) const = default;
  };

  void find_caps() {
    std::vector<BorderEdge> edges;
    for (std::uint32_t p = 0; p < found_.size(); ++p) {
      if (found_[p] != Finding::sheet || !scan_.fact(p).capped) continue;
      for_each_edge(p, [&](std::uint32_t t, int e, std::uint32_t low, std::uint32_t high) {
        if (scan_.pieces().edges[t] & Pieces::border_0 << e) edges.push_back({low, high, p});
      });
    }
    if (edges.empty()) return;
    std::sort(edges.begin(), edges.end());
    std::unordered_map<std::uint32_t, int> votes;  // of a piece; looked up only
    for (std::uint32_t p = 0; p < found_.size(); ++p) {
      for_each_edge(p, [&](std::uint32_t, int, std::uint32_t low, std::uint32_t high) {
        auto at = std::lower_bound(edges.begin(), edges.end(), BorderEdge{low, high, 0});
        for (; at != edges.end() && at->low == low && at->high == high; ++at) {
          if (at->piece != p) votes[at->piece] += trunk(p) ? 1 : -1;
        }
      });
    }
    for (std::uint32_t p = 0; p < found_.size(); ++p) {
      if (found_[p] != Finding::sheet || !scan_.fact(p).capped) continue;
      const auto vote = votes.find(p);
      if (vote != votes.end() && vote->second > 0) found_[p] = Finding::cap;
    }
  }
  template <class Use>
  void for_each_edge(std::uint32_t p, Use&& use) const {
    for (const std::uint32_t t : scan_.triangles().of(p)) {
      for (int e = 0; e < 3; ++e) {
        const std::uint32_t a = welded_[mesh_.triangles[t][e]], b = welded_[mesh_.triangles[t][(e + 1) % 3]];
        if (a != b) use(t, e, std::min(a, b), std::max(a, b));
      }
    }
  }

  // --- piles: trunks that are as stubby as crowns, crowns as slender as trunks ---------------------------

  static double width(const PieceShape& s) { return std::max(s.box.extent().x, s.box.extent().z); }
  // `upper` sits on `lower`: it begins above its lower quarter, near or below its top, and goes on above,
  // over its middle.
  static bool sits_on(const PieceShape& upper, const PieceShape& lower) {
    const DoubleBox &u = upper.box, &l = lower.box;
    const double h = l.extent().y;
    const Double3 c = l.centre();
    return u.min.x <= c.x && c.x <= u.max.x && u.min.z <= c.z && c.z <= u.max.z &&
           u.min.y >= l.min.y + 0.25 * h && u.min.y <= l.max.y + 0.1 * h && u.max.y > l.max.y;
  }

  void find_piles() {
    std::vector<const PlacedPiece*> pile;
    for (const PlacedPiece& placed : scan_.placed()) {
      const Finding f = found_[placed.piece];
      const bool slender =
          f == Finding::stem && is_bulky(placed.shape) && verdict(placed.piece).kind == NameClass::none;
      if ((f == Finding::blob || slender) && scan_.alike(placed.piece) < k_piled) pile.push_back(&placed);
    }
    std::sort(pile.begin(), pile.end(), [](const PlacedPiece* a, const PlacedPiece* b) {
      return a->shape.box.min.y != b->shape.box.min.y ? a->shape.box.min.y < b->shape.box.min.y
                                                      : a->piece < b->piece;
    });
    std::vector<bool> carried(pile.size(), false);
    for (std::size_t lower = 0; lower < pile.size(); ++lower) {
      const PieceShape& l = pile[lower]->shape;
      for (std::size_t upper = lower + 1; upper < pile.size(); ++upper) {
        const PieceShape& u = pile[upper]->shape;
        if (u.box.min.y > l.box.max.y + 0.1 * l.box.extent().y) break;
        if (!sits_on(u, l)) continue;
        judge_pair(*pile[lower], carried[lower], *pile[upper]);
        carried[upper] = true;
      }
    }
  }
  void judge_pair(const PlacedPiece& lower, bool carried, const PlacedPiece& upper) {
    const double share = width(lower.shape) / width(upper.shape);
    // Of blobs of one make the lower one carries the upper one only from the ground: up there both are
    // foliage.
    const bool alike = scan_.part(lower.piece) == scan_.part(upper.piece) &&
                       triangle_count(lower.piece) == triangle_count(upper.piece);
    const bool may_carry = !alike || stands_on_ground(lower.shape);
    if (found_[lower.piece] == Finding::blob && !carried && may_carry && share <= k_narrower)
      found_[lower.piece] = Finding::pillar;
    const bool crown = found_[upper.piece] == Finding::stem && stands_on_ground(lower.shape);
    if (crown && !carried && share <= k_much_narrower) found_[upper.piece] = Finding::carried_stem;
  }

  // A trunk with all its branches in one open surface looks like a sheet; what tells it is that it is far
  // larger than every other one, unlike any, and stands on the ground.
  const PlacedPiece* lone_sheet() const {
    const PlacedPiece* largest = nullptr;
    double second = 0;
    for (const PlacedPiece& placed : scan_.placed()) {
      if (found_[placed.piece] != Finding::sheet) continue;
      if (!largest || placed.shape.area > largest->shape.area) {
        second = largest ? largest->shape.area : 0;
        largest = &placed;
      } else {
        second = std::max(second, placed.shape.area);
      }
    }
    if (!largest || second <= 0 || largest->shape.area < k_lone_sheet * second) return nullptr;
    const bool stands = stands_on_ground(largest->shape) && largest->shape.size >= k_trunk_size * height_;
    return stands && verdict(largest->piece).kind == NameClass::none ? largest : nullptr;
  }

  // Cards, blobs and no trunk: the largest blob on the ground is one (a baobab).
  void find_stump() {
    bool cards = any_named_leaf_;
    for (std::uint32_t p = 0; p < found_.size(); ++p) {
      if (trunk(p) && found_[p] != Finding::ground) return;
      cards |= found_[p] == Finding::sheet;
    }
    if (!cards) return;
    const PlacedPiece* largest = lone_sheet();
    if (largest) found_[largest->piece] = Finding::stump;
    if (largest) return;
    for (const PlacedPiece& placed : scan_.placed()) {
      if (found_[placed.piece] != Finding::blob || verdict(placed.piece).kind != NameClass::none) continue;
      if (!stands_on_ground(placed.shape) || placed.shape.size < k_trunk_size * height_) continue;
      if (!largest || placed.shape.area > largest->shape.area) largest = &placed;
    }
    if (largest) found_[largest->piece] = Finding::stump;
  }

  const Mesh& mesh_;
  std::span<const std::uint32_t> welded_;
  const PieceScan& scan_;
  std::span<const PartVerdict> verdicts_;
  std::vector<Finding> found_;
  double height_ = 0, ground_ = 0;
  bool any_sheet_ = false, any_named_leaf_ = false, any_green_ = false;
  bool all_rooted_strips_ = true, all_standing_strips_ = true;
  std::vector<std::uint32_t> chain_of_, chain_size_;  // one a piece: of tubes laid end to end; or empty
};

// --- words -----------------------------------------------------------------------------------------------

std::string counted(const char* what, std::size_t triangles) {
  return std::string(what) + " of " + std::to_string(triangles) +
         (triangles == 1 ? " triangle" : " triangles");
}

std::string describe(Finding f, const PieceFact& fact, std::size_t n) {
  switch (f) {
    case Finding::named:
      return "";
    case Finding::sheet:
    case Finding::few_sheets:
      if (n == 1) return "a single triangle";
      return counted(fact.solid     ? "a thin plate"
                     : fact.layered ? "a card laid back to back"
                     : fact.planar  ? "a flat card"
                                    : "a bent sheet",
                     n);
    case Finding::cap:
      return counted("a cap", n) + " whose border lies on trunk";
    case Finding::ground:
      return counted("a ground plate", n) + ": flat, wide and lowest";
    case Finding::blade:
      return counted("a blade", n) + " that stands on the ground";
    case Finding::stem:
      return counted("a stem", n) + ": long for its thickness";
    case Finding::squat:
      return counted("a short tube", n) + " among many longer ones";
    case Finding::needle:
      return counted("a spike", n) + ": a needle";
    case Finding::carried_stem:
      return counted("a slender crown", n) + " on a narrower trunk";
    case Finding::named_stem:
      return counted("a stem", n) + " that hangs on no trunk";
    case Finding::blob:
      return counted("a blob", n);
    case Finding::continued:
      return counted("a tube", n) + " that is laid end to end with others";
    case Finding::named_blob:
      return counted("a lump", n);
    case Finding::brown_blob:
      return counted("a brown lump", n) + " beside green ones";
    case Finding::pillar:
      return counted("a lump", n) + " that carries a wider one";
    case Finding::stump:
      return counted("a lump", n) + " on the ground under the leaves";
    case Finding::only_piece:
      return counted("a lump", n) + ", all in one piece";
  }
  return "";
}

class Reasons {
 public:
  Reasons(const PieceScan& scan, std::span<const PartVerdict> verdicts) : scan_(scan), verdicts_(verdicts) {}

  std::uint32_t of(std::uint32_t piece, Finding f) {
    const PieceFact& fact = scan_.fact(piece);
    const std::uint32_t part = scan_.part(piece);
    const auto n = static_cast<std::uint32_t>(scan_.triangles().of(piece).size());
    const unsigned flags = static_cast<unsigned>(f) * 8 + fact.solid * 4u + fact.layered * 2u + fact.planar;
    const std::uint64_t triangles = f == Finding::named ? 0 : n;
    const Key key{std::uint64_t{part} << 8 | flags, triangles};
    if (key == last_key_ && !texts_.empty()) return last_;
    const auto [at, fresh] = known_.try_emplace(key, static_cast<std::uint32_t>(texts_.size()));
    if (fresh) texts_.push_back(text(piece, f, n));
    last_key_ = key;
    return last_ = at->second;
  }
  std::vector<std::string> take() && { return std::move(texts_); }

 private:
  struct Key {
    std::uint64_t part_and_flags = 0, triangles = 0;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const {
      return (k.part_and_flags * 0x9e3779b97f4a7c15u) ^ (k.triangles * 0xff51afd7ed558ccdu);
    }
  };

  std::string text(std::uint32_t piece, Finding f, std::uint32_t n) const {
    const PartVerdict& v = verdicts_[scan_.part(piece)];
    if (f == Finding::named) return v.reason;
    std::string words = describe(f, scan_.fact(piece), n);
    const std::uint32_t alike = scan_.alike(piece);
    if (alike > 1) words += ", one of " + std::to_string(alike) + " alike";
    if (f == Finding::blade && !v.grass.empty()) return v.grass + ", and it is " + words;
    if (v.kind == NameClass::none) return words;
    const bool agrees = is_trunk(f, v.kind) == (v.kind == NameClass::trunk);
    return v.reason + (agrees ? ", and it is " : ", but it is ") + words;
  }

  const PieceScan& scan_;
  std::span<const PartVerdict> verdicts_;
  std::unordered_map<Key, std::uint32_t, Hash> known_;  // looked up only
  std::vector<std::string> texts_;
  Key last_key_;
  std::uint32_t last_ = 0;
};

}  // namespace

PieceClasses classify_pieces_by_rule(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                     const PieceScan& scan, std::span<const PartVerdict> verdicts) {
  const std::vector<Finding> found = Rules(mesh, welded, scan, verdicts).run();
  Reasons reasons(scan, verdicts);
  PieceClasses classes;
  classes.kind.resize(found.size());
  classes.reason.resize(found.size());
  for (std::uint32_t p = 0; p < found.size(); ++p) {
    const bool trunk = is_trunk(found[p], verdicts[scan.part(p)].kind);
    classes.kind[p] = trunk ? PartClass::trunk : PartClass::leaf;
    classes.reason[p] = reasons.of(p, found[p]);
  }
  classes.reasons = std::move(reasons).take();
  return classes;
}

}  // namespace copse
