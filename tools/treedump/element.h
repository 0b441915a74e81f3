// The elements of a tree's arrays, field by field: what JSON prints and --diff compares.
#pragma once

#include "lib/formats/tree/tree.h"

#include <array>
#include <cstdint>

namespace copse {

// Calls visit(name, value) for each field; a plain element is one field without a name.
template <class T, class Visit>
void each_field(const T& value, Visit&& visit) {
  visit("", value);
}
template <class Visit>
void each_field(const CornerTriangle& t, Visit&& visit) {
  visit("vertex", t.vertex);
  visit("normal", t.normal);
  visit("texcoord", t.texcoord);
}
template <class Visit>
void each_field(const Radius& r, Visit&& visit) {
  visit("centre", r.centre);
  visit("diameter", r.diameter);
  visit("outer_radius", r.outer_radius);
  visit("distance", r.distance);
  visit("first_child", r.first_child);
  visit("child_count", r.child_count);
  visit("flags", r.flags);
}
template <class Visit>
void each_field(const LeafGroup& g, Visit&& visit) {
  visit("centre", g.centre);
  visit("radius", g.radius);
  visit("mean_area", g.mean_area);
  visit("first", g.first);
  visit("count", g.count);
}
template <class Visit>
void each_field(const GroupNode& n, Visit&& visit) {
  visit("centre", n.centre);
  visit("radius", n.radius);
  visit("skip", n.skip);
  visit("group", n.group);
}
template <class Visit>
void each_field(const TreeHeader& h, Visit&& visit) {
  visit("origin", h.origin);
  visit("bounds_min", h.bounds.min);
  visit("bounds_max", h.bounds.max);
  visit("trunk_bounds_min", h.trunk_bounds.min);
  visit("trunk_bounds_max", h.trunk_bounds.max);
  visit("area_density_centre", h.area_density_centre);
  visit("mean_trunk_area", h.mean_trunk_area);
  visit("mean_leaf_area", h.mean_leaf_area);
  visit("roots", h.roots);
  visit("ring_size", h.ring_size);
  visit("segment_factor", h.segment_factor);
  visit("leaf_factor", h.leaf_factor);
  visit("unexplained", h.unexplained);
  visit("leaf_order", static_cast<std::uint32_t>(h.leaf_order));
  visit("monotone", static_cast<std::uint32_t>(h.monotone));
}
template <class Visit>
void each_field(const Material& m, Visit&& visit) {
  visit("ambient", m.ambient);
  visit("diffuse", m.diffuse);
  visit("specular", m.specular);
  visit("emission", m.emission);
  visit("shininess", m.shininess);
  visit("alpha", m.alpha);
  visit("alpha_cutoff", m.alpha_cutoff);
  visit("double_sided", static_cast<std::uint32_t>(m.double_sided));
  visit("texture", m.texture);
  visit("mean_colour", m.mean_colour);
  visit("alpha_coverage", m.alpha_coverage);
}

// The numbers of a field, one by one: visit(axis, number), axis "" for a plain number.
template <class Visit>
void each_number(float v, Visit&& visit) {
  visit("", v);
}
template <class Visit>
void each_number(double v, Visit&& visit) {
  visit("", v);
}
template <class Visit>
void each_number(std::uint32_t v, Visit&& visit) {
  visit("", v);
}
template <class T, class Visit>
void each_number(const Vec2<T>& v, Visit&& visit) {
  visit(".x", v.x);
  visit(".y", v.y);
}
template <class T, class Visit>
void each_number(const Vec3<T>& v, Visit&& visit) {
  visit(".x", v.x);
  visit(".y", v.y);
  visit(".z", v.z);
}
template <std::size_t N, class Visit>
void each_number(const std::array<std::uint32_t, N>& v, Visit&& visit) {
  constexpr std::array<const char*, 3> k_names{"[0]", "[1]", "[2]"};
  for (std::size_t i = 0; i < N; ++i) visit(k_names[i], v[i]);
}

}  // namespace copse
