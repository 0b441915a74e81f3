#include "tools/treegrow/treegrow.h"

#include "tools/treegrow/disturb.h"
#include "tools/treegrow/leaves.h"
#include "tools/treegrow/surface.h"
#include "tools/treegrow/tubes.h"

#include <cmath>

namespace copse::grow {
namespace {

constexpr double k_east = 1e7, k_south = 2e7;  // of --break far-offset, m

Placement placement_of(const Order& order, const Plan& plan) {
  Placement p;
  const double height = plan.skeleton.height;
  const double depth = plan.skeleton.root_depth;
  if (order.breaks.has(Break::root_at_zero)) p.offset.y = depth;
  if (order.breaks.has(Break::root_above_ground)) p.offset.y = depth + 0.1 * height;
  if (order.breaks.has(Break::far_offset)) p.offset += Double3{k_east, 0, k_south};
  p.z_up = order.breaks.has(Break::z_up);
  p.scale = order.breaks.has(Break::centimetres) ? 100 : 1;
  // 6 decimals for a tree of 10 m and more, as exporters print them; more for what is smaller.
  p.step = std::pow(10, std::floor(std::log10(height * p.scale)) - 7);
  return p;
}

struct Names {
  std::string object, material;
};

Names names_of(const Order& order, bool leaf) {
  if (order.breaks.has(Break::neutral_names)) {
    const std::string number = leaf ? ".002" : ".001";
    return {"Object" + number, "Material" + number};
  }
  if (order.species.grass.blades > 0) return {"grass", "grass"};
  if (order.breaks.has(Break::leafy_name)) {
    return {"Leafy_" + order.species.name, leaf ? "Material.002" : "Material.001"};
  }
  const std::string& name = order.species.name;
  return leaf ? Names{name + "_leaves", "leaf_" + name} : Names{name + "_trunk", "bark_" + name};
}

// Materials without their textures: what can be said before anything is painted.
void add_materials(const Order& order, bool has_leaves, Mesh& mesh) {
  const Species& s = order.species;
  const bool grass = s.grass.blades > 0;
  if (order.breaks.has(Break::no_names)) {
    mesh.parts = {Part{}, Part{}};
    return;
  }
  Material bark{.name = names_of(order, false).material};
  bark.ambient = s.bark_colour * 0.4f;
  bark.diffuse = grass ? s.leaves.colour : s.bark_colour;
  bark.double_sided = grass;
  mesh.materials.push_back(bark);
  mesh.parts.push_back({names_of(order, false).object, "", 0});
  if (!has_leaves) return;
  if (order.breaks.has(Break::one_material)) {
    mesh.materials[0].name = s.name;
    mesh.materials[0].double_sided = true;
    mesh.parts = {Part{s.name, "", 0}, Part{s.name, "", 0}};
    return;
  }
  Material leaf{.name = names_of(order, true).material};
  leaf.ambient = s.leaves.colour * 0.4f;
  leaf.diffuse = s.leaves.colour;
  leaf.double_sided = !order.breaks.has(Break::blobs);
  mesh.materials.push_back(leaf);
  mesh.parts.push_back({names_of(order, true).object, "", 1});
}

}  // namespace

Grown make_mesh(const Order& order, const Plan& plan) {
  Surface surface(placement_of(order, plan), order.breaks.has(Break::quads));
  const std::uint64_t triangles = total_triangles(plan.layout, order.breaks);
  surface.reserve(triangles);
  Grown grown;
  Truth& truth = grown.truth;
  const Tubes tubes = build_tubes(order.species, plan.skeleton, plan.layout, order.breaks, surface, truth);
  surface.begin_part(1);
  build_leaves(order.species, plan.skeleton, plan.layout, order.breaks, tubes, surface, truth);
  grown.mesh = surface.finish();
  add_materials(order, plan.layout.leaves > 0, grown.mesh);
  truth.bounds = bounds(grown.mesh);
  truth.z_up = order.breaks.has(Break::z_up);
  truth.height = truth.z_up ? truth.bounds.extent().z : truth.bounds.extent().y;
  truth.name = order.species.name;
  disturb(grown.mesh, order.breaks, order.seed);
  return grown;
}

Result<Grown> grow_mesh(const Order& order) {
  const auto plan = make_plan(order);
  if (!plan) return std::unexpected(plan.error());
  return make_mesh(order, *plan);
}

}  // namespace copse::grow
