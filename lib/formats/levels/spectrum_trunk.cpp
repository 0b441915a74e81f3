#include "lib/formats/levels/spectrum_trunk.h"

#include "lib/formats/levels/part_triangles.h"
#include "lib/formats/levels/spectrum_draft.h"
#include "lib/formats/little_endian.h"
#include "lib/formats/packing/context_mixing.h"
#include "lib/formats/packing/leaf_frame.h"
#include "lib/formats/packing/octahedral.h"
#include "lib/formats/packing/pack_trunk.h"
#include "lib/formats/packing/range_coder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <set>

namespace copse::spectrum_trunk {
namespace {

using Face = std::array<std::uint32_t, 3>;

constexpr std::uint32_t k_most_up = 512;  // radii between the ends of a tube that are looked at
constexpr std::size_t k_most_recent = 128, k_most_faces = 4096;
constexpr int k_normal_slack = 4;    // of 127: a normal of a made tube may be off by as many, some 3 degrees
constexpr int k_texcoord_slack = 2;  // bits that texture coordinates of made tubes have less
constexpr double k_fineness = 16;    // steps of a made tube's positions in the error of its state, at least
constexpr int k_dropped = 13;        // bits of an error

// How a made element's triangles hang together, by first use of vertices, and at which end each vertex is.
struct Pattern {
  std::vector<Face> faces;
  std::vector<std::uint8_t> at_child;

  // For each vertex, its place in the list of its end; for one at the child's end, the vertex at the other
  // end that it hangs on by an edge, the first of them.
  std::vector<std::uint32_t> place, partner;
  void link() {
    std::uint32_t count[2] = {0, 0};
    place.clear(), partner.assign(at_child.size(), k_none);
    for (const std::uint8_t end : at_child) place.push_back(count[end]++);
    for (const Face& f : faces)
      for (std::size_t c = 0; c < 3; ++c)
        for (const std::size_t d : {(c + 1) % 3, (c + 2) % 3})
          if (at_child[f[c]] && !at_child[f[d]] &&
              (partner[f[c]] == k_none || place[partner[f[c]]] > place[f[d]]))
            partner[f[c]] = f[d];
  }
};

struct Made {
  std::uint32_t birth = 0, death = k_none, material = k_none, radius = k_none;
  std::uint32_t up = 1;  // radii from its radius to the one at its other end
  Pattern pattern;
  std::vector<std::uint32_t> source;    // of the spectrum's vertices; encoding
  std::vector<std::uint32_t> vertices;  // of Plan::vertices
};

struct Plan {
  std::vector<std::uint32_t> piece_of, piece_radius, piece_death;
  std::vector<Made> made;                // by birth
  std::vector<SpectrumVertex> vertices;  // of what is made, as they are read
  const Spectrum* spectrum = nullptr;    // encoding
  double largest_error = 0;              // metres; encoding
  std::vector<float> errors;
  std::int32_t position = 0, texcoord = 0;
};

struct Place {
  Grid3 rel{};  // from the centre of its radius
  Octahedral normal{};
  Grid2 texcoord{};
};

class Coder {
 public:
  Coder(RangeCoder& coder, Plan& plan, const Tree& tree, const PartTriangles& part)
      : c_(coder),
        p_(plan),
        tree_(tree),
        part_(part),
        parent_(parents(tree)),
        centres_(absolute_centres(tree)),
        step_(std::ldexp(1.0, plan.position)),
        texcoord_step_(std::ldexp(1.0, plan.texcoord)),
        goes_on_(parent_.size(), k_none) {
    for (std::uint32_t r = 0; r < parent_.size(); ++r) {
      const std::uint32_t p = parent_[r];
      if (p == k_none || (tree.hierarchy.radii[r].flags & Radius::joint) != 0) continue;
      if (goes_on_[p] == k_none ||
          tree.hierarchy.radii[r].diameter > tree.hierarchy.radii[goes_on_[p]].diameter)
        goes_on_[p] = r;
    }
  }

  std::string run() {
    if (std::string wrong = code_pieces(); !wrong.empty()) return wrong;
    const std::uint32_t states = c_.plain(32, static_cast<std::uint32_t>(p_.errors.size()));
    if (states == 0 || (c_.decoding() && states > 1 + 64 * (c_.left() + tree_.radius_count())))
      return "it counts more steps than it can hold";
    code_errors(states);
    const std::size_t made = p_.made.size();
    std::size_t next = 0;
    for (std::uint32_t n = 1; n < states; ++n) {
      std::uint64_t born = 0;
      while (next + born < made && p_.made[next + born].birth == n) ++born;
      c_.stream("steps");
      born = c_.number(born_, born);
      if (born > k_most_faces) return "a step makes too much";
      const std::size_t first = next;
      for (std::uint64_t k = 0; k < born; ++k, ++next) {
        if (c_.decoding()) p_.made.emplace_back(), p_.made.back().birth = n;
        if (std::string wrong = code_ends(p_.made[next]); !wrong.empty()) return wrong;
      }
      if (std::string wrong = code_deaths(n, first, next); !wrong.empty()) return wrong;
      for (std::size_t k = first; k < next; ++k) {
        if (std::string wrong = code_tube(p_.made[k]); !wrong.empty()) return wrong;
        live(static_cast<std::uint32_t>(p_.piece_radius.size() + k), p_.made[k].radius);
      }
      if (c_.failed()) return "it ends in the steps";
    }
    return "";
  }

 private:
  std::string code_pieces() {
    if (c_.decoding()) p_.piece_of.assign(part_.triangles.size(), k_none);
    std::uint32_t pieces = 0;
    for (std::size_t s = 0; s < tree_.segment_count(); ++s) {
      const std::uint32_t base = pieces;
      const std::size_t end = std::min(tree_.first_triangle_of_segment(s + 1), part_.triangles.size());
      for (std::size_t t = tree_.first_triangle_of_segment(s); t < end; ++t) {
        c_.stream("pieces");
        const std::uint64_t back =
            c_.number(piece_[t == tree_.first_triangle_of_segment(s)], pieces - p_.piece_of[t]);
        if (back > pieces - base) return "a triangle belongs to a piece of another segment";
        p_.piece_of[t] = pieces - static_cast<std::uint32_t>(back);
        if (back != 0) continue;
        if (c_.decoding()) p_.piece_radius.push_back(k_none);
        std::uint32_t& r = p_.piece_radius[pieces++];
        const std::uint32_t own = s < tree_.trunk.lines.size() ? tree_.trunk.lines[s][1] : k_none;
        r = c_.bit(own_radius_, r == own) ? own : static_cast<std::uint32_t>(c_.number(radius_, r + 1u)) - 1;
        if (c_.failed()) return "it ends in the pieces";
      }
    }
    if (c_.decoding()) p_.piece_death.assign(pieces, k_none);
    for (std::uint32_t p = 0; p < pieces; ++p) live(p, p_.piece_radius[p]);
    return "";
  }

  void code_errors(std::uint32_t states) {
    std::uint32_t before = 0;
    for (std::uint32_t n = 0; n < states && !c_.failed(); ++n) {
      if (c_.decoding()) p_.errors.push_back(0);
      const std::uint32_t bits =
          c_.decoding() ? 0
                        : (std::bit_cast<std::uint32_t>(p_.errors[n]) + (1u << k_dropped) - 1) >> k_dropped;
      c_.stream("errors");
      before += static_cast<std::uint32_t>(c_.number(error_, bits - before));
      before = std::min(before, 0x7f7fffffu >> k_dropped);
      p_.errors[n] = std::bit_cast<float>(before << k_dropped);
    }
  }

  // ---- what lives and goes

  void live(std::uint32_t id, std::uint32_t radius) {
    alive_.insert(id);
    if (radius < parent_.size()) on_radius_[radius].insert(id);
  }
  void die(std::uint32_t id, std::uint32_t step) {
    const auto pieces = static_cast<std::uint32_t>(p_.piece_radius.size());
    const std::uint32_t radius = id < pieces ? p_.piece_radius[id] : p_.made[id - pieces].radius;
    (id < pieces ? p_.piece_death[id] : p_.made[id - pieces].death) = step;
    alive_.erase(id);
    if (radius < parent_.size()) on_radius_[radius].erase(id);
  }
  std::uint32_t death_of(std::uint32_t id) const {
    const auto pieces = static_cast<std::uint32_t>(p_.piece_radius.size());
    return id < pieces ? p_.piece_death[id] : p_.made[id - pieces].death;
  }

  std::string code_ends(Made& m) {
    c_.stream("tubes: ends");
    const std::int64_t r =
        last_radius_ + c_.signed_number(made_radius_, std::int64_t{m.radius} - last_radius_);
    if (r < 0 || r >= static_cast<std::int64_t>(parent_.size()))
      return "a tube ends at a radius that is not there";
    last_radius_ = r, m.radius = static_cast<std::uint32_t>(r);
    m.up = static_cast<std::uint32_t>(std::min<std::uint64_t>(c_.number(up_, m.up), k_most_up + 1));
    if (m.up == 0 || m.up > k_most_up) return "a tube spans no radius, or too many";
    return "";
  }
  std::uint32_t other_end(const Made& m) const {
    std::uint32_t r = m.radius;
    for (std::uint32_t k = 0; k < m.up && parent_[r] != k_none; ++k) r = parent_[r];
    return r;
  }

  // Whatever hangs on the radii that a new tube spans gives way to it; what else goes is named.
  std::string code_deaths(std::uint32_t step, std::size_t first, std::size_t end) {
    std::vector<std::uint32_t> replaced, others;
    for (std::size_t k = first; k < end; ++k) {
      std::uint32_t r = p_.made[k].radius;
      for (std::uint32_t i = 0; i < p_.made[k].up && r != k_none; ++i, r = parent_[r])
        if (const auto at = on_radius_.find(r); at != on_radius_.end())
          replaced.insert(replaced.end(), at->second.begin(), at->second.end());
    }
    std::sort(replaced.begin(), replaced.end());
    replaced.erase(std::unique(replaced.begin(), replaced.end()), replaced.end());
    for (const std::uint32_t id : replaced)
      if (c_.stream("what goes"); c_.bit(goes_, death_of(id) == step)) die(id, step);
    if (!c_.decoding())
      for (const std::uint32_t id : alive_)
        if (death_of(id) == step) others.push_back(id);
    c_.stream("what goes by number");
    const std::uint64_t n = c_.number(named_[end > first], others.size());
    if (n > alive_.size()) return "more goes than there is";
    others.resize(n);
    std::int64_t before = 0;
    for (std::uint32_t& id : others) {
      const std::int64_t x = before + c_.signed_number(name_, std::int64_t{id} - before);
      if (x < 0 || x > 0xffffffffll || !alive_.contains(static_cast<std::uint32_t>(x)))
        return "what is not there goes";
      id = static_cast<std::uint32_t>(x), before = x;
      die(id, step);
    }
    return "";
  }

  // ---- tubes

  std::string code_tube(Made& m) {
    const std::uint32_t expected = tree_.trunk.material;
    c_.stream("tubes: materials and patterns");
    m.material = c_.bit(same_material_, m.material == expected)
                     ? expected
                     : static_cast<std::uint32_t>(c_.number(material_, m.material + 1u)) - 1;
    if (!code_pattern(m.pattern)) return "the triangles of a tube are not sound";
    m.vertices.assign(m.pattern.at_child.size(), k_none);
    const Ends ends = ends_of(m);
    const std::vector<std::uint32_t>* known[2] = {nullptr, nullptr};
    for (std::size_t e = 0; e < 2; ++e)
      if (const auto at = rings_.find({ends.radius[e], ends.size[e]}); at != rings_.end())
        known[e] = &at->second;
    std::vector<std::uint32_t> lists[2];
    for (std::size_t i = 0; i < m.vertices.size(); ++i) {
      const std::size_t e = m.pattern.at_child[i];
      const std::uint32_t like = known[e] ? (*known[e])[m.pattern.place[i]] : k_none;
      const std::uint32_t wanted = c_.decoding() ? k_none : number_of(m.source[i]);
      std::uint32_t& v = m.vertices[i];
      const auto count = static_cast<std::uint32_t>(places_.size());
      c_.stream("tubes: which vertices");
      if (like != k_none && c_.bit(again_[again_before_], wanted == like)) {
        v = like, again_before_ = true;
      } else if (again_before_ = false; c_.bit(old_, wanted != k_none)) {
        const std::uint64_t back = c_.number(back_, count - 1 - wanted);
        if (back >= count) return "a tube names a vertex that is not there";
        v = count - 1 - static_cast<std::uint32_t>(back);
      } else {
        if (!code_vertex(m, i, ends, lists[e], like)) return "a vertex of a tube is out of range";
        v = count;
        if (!c_.decoding()) numbers_[m.source[i]] = v;
      }
      lists[e].push_back(v);
    }
    for (std::size_t e = 0; e < 2; ++e) {
      if (ends.size[e] > 2) {
        start_[ends.radius[e]] = lists[e].front();
        const Grid2 &first = places_[lists[e].front()].texcoord, &last = places_[lists[e].back()].texcoord;
        turn_ = {last[0] - first[0], last[1] - first[1]};
      }
      rings_[{ends.radius[e], ends.size[e]}] = std::move(lists[e]);
    }
    return "";
  }
  static std::size_t ring_size(const Pattern& p, std::uint8_t end) {
    return static_cast<std::size_t>(std::count(p.at_child.begin(), p.at_child.end(), end));
  }

  bool code_pattern(Pattern& p) {
    std::uint64_t symbol = 0;
    if (!c_.decoding()) {
      const auto at = std::find_if(recent_.begin(), recent_.end(), [&](const Pattern& x) {
        return x.faces == p.faces && x.at_child == p.at_child;
      });
      if (at != recent_.end()) symbol = static_cast<std::uint64_t>(at - recent_.begin()) + 1;
    }
    symbol = c_.number(pattern_, symbol);
    if (symbol > recent_.size()) return false;
    if (symbol > 0) {
      p = recent_[symbol - 1];
      recent_.erase(recent_.begin() + static_cast<std::ptrdiff_t>(symbol) - 1);
    } else {
      const std::uint64_t n = c_.number(face_count_, p.faces.size());
      if (n == 0 || n > k_most_faces) return false;
      if (c_.decoding()) p.faces.resize(n);
      std::uint32_t count = 0;
      for (Face& f : p.faces)
        for (std::uint32_t& v : f) {
          const std::uint64_t back = c_.number(index_, count - v);
          if (back > count) return false;
          v = count - static_cast<std::uint32_t>(back);
          if (back != 0) continue;
          if (c_.decoding()) p.at_child.push_back(0);
          p.at_child[count] = c_.bit(end_, p.at_child[count] != 0) ? 1 : 0;
          ++count;
        }
      if (c_.failed()) return false;
      p.link();
    }
    recent_.insert(recent_.begin(), p);
    if (recent_.size() > k_most_recent) recent_.pop_back();
    return true;
  }

  std::uint32_t number_of(std::uint32_t v) const {
    const auto at = numbers_.find(v);
    return at == numbers_.end() ? k_none : at->second;
  }

  struct Ends {
    std::uint32_t radius[2];
    std::size_t size[2];
    Double3 axis[2];  // of the rings
  };

  // A ring lies across the mean of its limb's directions there; a limb's first one across the first
  // direction.
  Ends ends_of(const Made& m) const {
    Ends ends{{other_end(m), m.radius}, {ring_size(m.pattern, 0), ring_size(m.pattern, 1)}, {}};
    std::uint32_t begin = m.radius;  // the first radius behind the other end
    for (std::uint32_t k = 1; k < m.up && parent_[begin] != k_none && parent_[parent_[begin]] != k_none; ++k)
      begin = parent_[begin];
    const auto from_parent = [&](std::uint32_t r) {
      return parent_[r] == k_none ? Double3{} : normalized(centres_[r] - centres_[parent_[r]], {});
    };
    const Double3 out = from_parent(begin);
    ends.axis[0] =
        normalized(goes_on_[ends.radius[0]] == begin ? from_parent(ends.radius[0]) + out : out, out);
    const Double3 in = from_parent(m.radius);
    const std::uint32_t next = goes_on_[m.radius];
    ends.axis[1] = normalized(next == k_none ? in : in + from_parent(next), in);
    return ends;
  }

  // Turns `v` as the least rotation from one unit vector to the other does.
  static Double3 carried(const Double3& v, const Double3& from, const Double3& to) {
    const Double3 axis = cross(from, to);
    const double c = dot(from, to);
    return c < -0.9 ? v : v * c + cross(axis, v) + axis * (dot(axis, v) / (1 + c));
  }

  // Bits that a position needs less: what is made errs by so much anyway.
  int coarseness(std::uint32_t step) const {
    const double most =
        double(p_.errors[std::min<std::size_t>(step, p_.errors.size() - 1)]) / (k_fineness * step_);
    int bits = 0;
    while (bits < 30 && std::ldexp(2.0, bits) <= most) ++bits;
    return bits;
  }
  static std::int64_t coarse(std::int64_t x, int bits) {
    const std::int64_t half = bits > 0 ? std::int64_t{1} << (bits - 1) : 0;
    return (x + half) >> bits;
  }
  static std::size_t class_of(std::int64_t x) { return std::min<std::size_t>(size_class(x), 23); }

  bool code_vertex(const Made& m, std::size_t i, const Ends& ends, const std::vector<std::uint32_t>& list,
                   std::uint32_t like) {
    const std::size_t e = m.pattern.at_child[i];
    const Double3 centre = centres_[ends.radius[e]];
    Place own;
    if (!c_.decoding()) own = place_of(p_.spectrum->vertices[m.source[i]], centre);
    std::size_t kind = 0;
    const Place expected = expected_place(m, i, ends, list, like, kind);
    bool sound = true;
    c_.stream("tubes: positions");
    const int bits = coarseness(m.birth);
    const std::size_t reach =
        class_of((std::abs(expected.rel[0]) + std::abs(expected.rel[1]) + std::abs(expected.rel[2])) >> bits);
    std::size_t before = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t off =
          position_.code(c_, {3 * kind + a, 24 * kind + before, 24 * kind + reach, 24 * kind + off_[a]},
                         coarse(own.rel[a] - expected.rel[a], bits));
      own.rel[a] = expected.rel[a] + off * (std::int64_t{1} << bits);
      before = off_[a] = class_of(off);
      sound = sound && std::abs(own.rel[a]) <= 16 * k_grid_limit;
    }
    const Octahedral towards =
        kind == 0 ? expected.normal : expected_normal(ends, e, list.size(), own, expected, kind);
    if (!c_.decoding() && near(own.normal, towards)) own.normal = towards;
    for (std::size_t k = 0; k < 2; ++k) {
      c_.stream("tubes: normals");
      const std::size_t way = std::min<std::size_t>(kind, 3);
      const std::int64_t turned = normal_.code(
          c_, {2 * way + k, 9 * way + off_normal_[k], 9 * k + off_normal_[0]}, own.normal[k] - towards[k]);
      own.normal[k] = static_cast<std::int32_t>(
          std::clamp<std::int64_t>(towards[k] + turned, -k_octahedral_limit, k_octahedral_limit));
      off_normal_[k] = std::min<std::size_t>(size_class(turned), 8);
      c_.stream("tubes: texture coordinates");
      const std::int64_t moved =
          texcoord_.code(c_, {2 * kind + k, 24 * kind + off_texcoord_[k], 24 * k + off_texcoord_[0]},
                         own.texcoord[k] - expected.texcoord[k]);
      own.texcoord[k] = expected.texcoord[k] + moved;
      off_texcoord_[k] = class_of(moved);
      sound = sound && std::abs(own.texcoord[k]) <= 16 * k_grid_limit;
    }
    last_texcoord_ = own.texcoord;
    places_.push_back(own);
    p_.vertices.push_back({to_float(centre + real(own.rel) * step_),
                           from_octahedral(own.normal),
                           {static_cast<float>(double(own.texcoord[0]) * texcoord_step_),
                            static_cast<float>(double(own.texcoord[1]) * texcoord_step_)}});
    if (!c_.decoding())
      p_.largest_error =
          std::max(p_.largest_error, distance(to_double(p_.vertices.back().position),
                                              to_double(p_.spectrum->vertices[m.source[i]].position)));
    return sound;
  }

  // Ribbons turn half to their edges; tubes look away from their axis, thin ones as at their other end.
  static Octahedral expected_normal(const Ends& ends, std::size_t e, std::size_t j, const Place& own,
                                    const Place& expected, std::size_t kind) {
    const Double3 r = real(own.rel), out = normalized(r - ends.axis[e] * dot(r, ends.axis[e]));
    if (ends.size[e] == 2) {
      const Double3 face = j == 0 ? cross(ends.axis[e], out) : cross(out, ends.axis[e]);
      return to_octahedral(normalized(face + out));
    }
    if (kind > 1) return to_octahedral(out);
    return to_octahedral(
        normalized(carried(to_double(from_octahedral(expected.normal)), ends.axis[0], ends.axis[1])));
  }

  static bool near(const Octahedral& a, const Octahedral& b) {
    return std::abs(a[0] - b[0]) <= k_normal_slack && std::abs(a[1] - b[1]) <= k_normal_slack;
  }

  Place place_of(const SpectrumVertex& v, const Double3& centre) const {
    const auto whole = [](double x) { return std::llround(std::clamp(x, -1e9, 1e9)); };
    const Double3 d = (to_double(v.position) - centre) / step_;
    return {{whole(d.x), whole(d.y), whole(d.z)},
            to_octahedral(to_double(v.normal)),
            {whole(v.texcoord.x / texcoord_step_), whole(v.texcoord.y / texcoord_step_)}};
  }

  // As in the ring of the same radius that was made before; or as at the tube's other end; or on round a
  // regular polygon.
  Place expected_place(const Made& m, std::size_t i, const Ends& ends, const std::vector<std::uint32_t>& list,
                       std::uint32_t like, std::size_t& kind) const {
    if (like != k_none) return kind = 0, places_[like];
    const std::size_t e = m.pattern.at_child[i], j = list.size(), sides = ends.size[e] - 1;
    Place out;
    if (const std::uint32_t q = m.pattern.partner[i]; e == 1 && q != k_none && q < i) {
      out = places_[m.vertices[q]];
      const double a = tree_.hierarchy.radii[ends.radius[0]].diameter,
                   b = tree_.hierarchy.radii[ends.radius[1]].diameter;
      const double by = a > 0 ? std::min(b / a, 4.0) : 1;
      const Double3 turned = carried(real(out.rel), ends.axis[0], ends.axis[1]) * by;
      out.rel = {std::llround(turned.x), std::llround(turned.y), std::llround(turned.z)};
      if (j > 0) out.texcoord[1] = places_[list[j - 1]].texcoord[1];
      return kind = 1, out;
    }
    if (j > 0) return around(ends.axis[e], list, sides, kind);
    out.texcoord = last_texcoord_, kind = 5;
    // Rings of one radius begin in the same direction, however many sides they have.
    if (const auto at = start_.find(ends.radius[e]); sides > 1 && at != start_.end())
      kind = 6, out = places_[at->second];
    return out;
  }

  // The next vertex of a ring: on by an equal angle; texture coordinates as they went, first as in the ring
  // before.
  Place around(const Double3& axis, const std::vector<std::uint32_t>& list, std::size_t sides,
               std::size_t& kind) const {
    const std::size_t j = list.size();
    const Place& before = places_[list[j - 1]];
    Place out;
    if (sides == 1) {
      for (std::size_t a = 0; a < 3; ++a) out.rel[a] = -before.rel[a];
      out.texcoord = before.texcoord;
      return kind = 3, out;
    }
    const double half = 3.14159265358979312 / static_cast<double>(sides), h2 = half * half;
    const double s = half * (1 - h2 / 6 * (1 - h2 / 20 * (1 - h2 / 42 * (1 - h2 / 72))));
    const double cosine = 1 - 2 * s * s, sine = 2 * s * std::sqrt(std::max(0.0, 1 - s * s));
    if (j == 1) {
      const Double3 r = real(before.rel), on = r * cosine + cross(axis, r) * sine;
      out.rel = {std::llround(on.x), std::llround(on.y), std::llround(on.z)};
      for (std::size_t k = 0; k < 2; ++k)
        out.texcoord[k] = before.texcoord[k] + turn_[k] / static_cast<std::int64_t>(sides);
      return kind = 4, out;
    }
    const Place& two = places_[list[j - 2]];
    for (std::size_t a = 0; a < 3; ++a)
      out.rel[a] = std::llround(2 * cosine * double(before.rel[a])) - two.rel[a];
    for (std::size_t k = 0; k < 2; ++k) out.texcoord[k] = 2 * before.texcoord[k] - two.texcoord[k];
    return kind = 2, out;
  }

  RangeCoder& c_;
  Plan& p_;
  const Tree& tree_;
  const PartTriangles& part_;
  std::vector<std::uint32_t> parent_;
  std::vector<Double3> centres_;
  double step_, texcoord_step_;
  std::vector<std::uint32_t> goes_on_;  // of each radius the thickest that is joined to it

  std::set<std::uint32_t> alive_;
  std::map<std::uint32_t, std::set<std::uint32_t>> on_radius_;
  std::int64_t last_radius_ = 0;
  std::vector<Pattern> recent_;
  std::map<std::pair<std::uint32_t, std::size_t>, std::vector<std::uint32_t>> rings_;
  std::map<std::uint32_t, std::uint32_t> numbers_;  // encoding: of the plan's vertices that are coded
  std::vector<Place> places_;                       // of those that are coded
  std::map<std::uint32_t, std::uint32_t> start_;    // of each radius, the first vertex of its last ring
  Grid2 last_texcoord_{}, turn_{};                  // turn_: once round the last ring
  bool again_before_ = false;

  std::array<NumberModel, 2> piece_, named_;
  NumberModel radius_, error_, born_, up_, material_, pattern_, face_count_, index_, back_;
  SignedModel made_radius_, name_;
  BitModel own_radius_, goes_, same_material_, end_, old_;
  std::array<BitModel, 2> again_;
  MixedSigned position_{21, 168, 168, 168}, normal_{8, 36, 18}, texcoord_{14, 168, 48};
  std::array<std::size_t, 3> off_{};
  std::array<std::size_t, 2> off_normal_{}, off_texcoord_{};
};

using Key = std::array<std::uint32_t, 8>;
Key key_of(const SpectrumVertex& v) {
  Key key{};
  std::memcpy(key.data(), &v, sizeof key);
  return key;
}

// Full detail tiles the tree's triangles, in pieces by first triangle.
bool read_pieces(const Spectrum& s, const PartTriangles& part, Plan& plan) {
  std::map<Key, std::uint32_t> numbers;
  std::map<Face, std::vector<std::uint32_t>> triangles;
  const auto number = [&](const SpectrumVertex& v) {
    return numbers.try_emplace(key_of(v), static_cast<std::uint32_t>(numbers.size())).first->second;
  };
  for (std::uint32_t t = part.triangles.size(); t-- > 0;) {
    const Face& f = part.triangles[t];
    triangles[{number(part.vertices[f[0]]), number(part.vertices[f[1]]), number(part.vertices[f[2]])}]
        .push_back(t);
  }
  std::vector<std::uint32_t> element(part.triangles.size(), k_none);
  for (std::uint32_t e = 0; e < s.elements.size(); ++e) {
    if (s.elements[e].birth != 0) continue;
    for (std::uint32_t t = s.first_triangle[e]; t < s.first_triangle[e + 1]; ++t) {
      const Face& f = s.triangles[t];
      auto at =
          triangles.find({number(s.vertices[f[0]]), number(s.vertices[f[1]]), number(s.vertices[f[2]])});
      if (at == triangles.end() || at->second.empty()) return false;
      const std::uint32_t own = at->second.back();
      at->second.pop_back();
      if (part.materials[own] != s.elements[e].material) return false;
      element[own] = e;
    }
  }
  std::map<std::uint32_t, std::uint32_t> piece;
  for (const std::uint32_t e : element) {
    if (e == k_none) return false;
    const auto [at, is_new] = piece.try_emplace(e, static_cast<std::uint32_t>(piece.size()));
    plan.piece_of.push_back(at->second);
    if (is_new)
      plan.piece_radius.push_back(s.elements[e].radius), plan.piece_death.push_back(s.elements[e].death);
  }
  return true;
}

// At which end each vertex is, and which radius the other end is: those that lie nearest.
bool read_ends(Made& m, const Spectrum& s, const std::vector<std::uint32_t>& parent,
               const std::vector<Double3>& centres) {
  if (m.radius >= parent.size() || parent[m.radius] == k_none) return false;
  const auto away = [&](std::uint32_t v, std::uint32_t r) {
    return distance(to_double(s.vertices[v].position), centres[r]);
  };
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t best = 0, radius = k_none, up = 1;
  for (std::uint32_t r = parent[m.radius]; r != k_none && up <= k_most_up; r = parent[r], ++up) {
    double sum = 0;
    for (const std::uint32_t v : m.source) sum += std::min(away(v, m.radius), away(v, r));
    if (sum < least) least = sum, best = up, radius = r;
    if (up > best + 16 && best > 0) break;
  }
  m.up = best;
  for (const std::uint32_t v : m.source)
    m.pattern.at_child.push_back(away(v, m.radius) < away(v, radius) ? 1 : 0);
  return true;
}

bool read_made(const Spectrum& s, const Tree& tree, Plan& plan) {
  const std::vector<std::uint32_t> parent = parents(tree);
  const std::vector<Double3> centres = absolute_centres(tree);
  for (std::uint32_t e = 0; e < s.elements.size(); ++e) {
    const SpectrumElement& x = s.elements[e];
    if (x.birth == 0) continue;
    Made m{.birth = x.birth,
           .death = x.death,
           .material = x.material,
           .radius = x.radius,
           .pattern = {},
           .source = {},
           .vertices = {}};
    std::map<std::uint32_t, std::uint32_t> local;
    for (std::uint32_t t = s.first_triangle[e]; t < s.first_triangle[e + 1]; ++t) {
      Face& face = m.pattern.faces.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [at, is_new] =
            local.try_emplace(s.triangles[t][c], static_cast<std::uint32_t>(local.size()));
        if (is_new) m.source.push_back(s.triangles[t][c]);
        face[c] = at->second;
      }
    }
    if (m.pattern.faces.size() > k_most_faces || !read_ends(m, s, parent, centres)) return false;
    m.pattern.link();
    plan.made.push_back(std::move(m));
  }
  std::stable_sort(plan.made.begin(), plan.made.end(), [](const Made& a, const Made& b) {
    return a.birth != b.birth ? a.birth < b.birth : a.radius < b.radius;
  });
  return true;
}

std::string spectrum_of(const Plan& plan, const PartTriangles& part, Spectrum& s) {
  std::vector<SpectrumDraft> drafts(plan.piece_radius.size());
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t) {
    SpectrumDraft& d = drafts[plan.piece_of[t]];
    d.faces.push_back(part.triangles[t]);
    d.element = {.birth = 0,
                 .death = plan.piece_death[plan.piece_of[t]],
                 .material = part.materials[t],
                 .radius = plan.piece_radius[plan.piece_of[t]]};
  }
  std::vector<SpectrumVertex> vertices = part.vertices;
  vertices.insert(vertices.end(), plan.vertices.begin(), plan.vertices.end());
  const auto base = static_cast<std::uint32_t>(part.vertices.size());
  for (const Made& m : plan.made) {
    SpectrumDraft d{{.birth = m.birth, .death = m.death, .material = m.material, .radius = m.radius}, {}};
    for (const Face& f : m.pattern.faces)
      d.faces.push_back({base + m.vertices[f[0]], base + m.vertices[f[1]], base + m.vertices[f[2]]});
    drafts.push_back(std::move(d));
  }
  s.errors = plan.errors;
  return assemble_spectrum(drafts, vertices, s);
}

}  // namespace

std::optional<EncodedSpectrum> encode(const Spectrum& spectrum, const Tree& tree,
                                      const SpectrumCodingOptions& options) {
  if (tree.radius_count() == 0) return std::nullopt;
  const PartTriangles part = trunk_triangles(tree);
  Plan plan;
  if (!read_pieces(spectrum, part, plan) || !read_made(spectrum, tree, plan)) return std::nullopt;
  plan.spectrum = &spectrum, plan.errors = spectrum.errors.to_vector();
  const Float3 e = tree.header.bounds.extent();
  double uv = 1;
  for (const SpectrumVertex& v : spectrum.vertices)
    uv = std::max({uv, std::abs(double{v.texcoord.x}), std::abs(double{v.texcoord.y})});
  plan.position = grid_exponent(std::max({e.x, e.y, e.z}), options.position_bits - 1);
  plan.texcoord = grid_exponent(std::min(uv, 4.0), options.texcoord_bits - k_texcoord_slack);
  RangeCoder coder;
  if (!std::make_unique<Coder>(coder, plan, tree, part)->run().empty()) return std::nullopt;
  EncodedSpectrum out{.bytes = std::vector<std::uint8_t>(8), .position_error = plan.largest_error};
  put(std::span(out.bytes), 0, plan.position), put(std::span(out.bytes), 4, plan.texcoord);
  out.streams = coder.costs();
  const std::vector<std::uint8_t> coded = coder.finish();
  out.bytes.insert(out.bytes.end(), coded.begin(), coded.end());
  return out;
}

std::expected<Spectrum, std::string> decode(std::span<const std::uint8_t> bytes, LodMethod method,
                                            const Tree& tree) {
  if (bytes.size() < 8) return std::unexpected("it is cut off");
  Plan plan;
  plan.position = get<std::int32_t>(bytes, 0), plan.texcoord = get<std::int32_t>(bytes, 4);
  if (plan.position < k_least_exponent || plan.position > k_most_exponent || plan.texcoord < -30 ||
      plan.texcoord > 10)
    return std::unexpected("the step of its grid is out of range");
  if (tree.radius_count() == 0) return std::unexpected("its tree has no hierarchy");
  const PartTriangles part = trunk_triangles(tree);
  RangeCoder coder(bytes.subspan(8));
  if (std::string wrong = std::make_unique<Coder>(coder, plan, tree, part)->run(); !wrong.empty())
    return std::unexpected(wrong);
  if (!coder.exhausted()) return std::unexpected("it has another length than what it holds");
  Spectrum s;
  s.method = method;
  if (std::string wrong = spectrum_of(plan, part, s); !wrong.empty()) return std::unexpected(wrong);
  return s;
}

}  // namespace copse::spectrum_trunk
