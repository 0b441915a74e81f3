#include "lib/analysis/skeleton/creation_order_cgal.h"
#include "lib/analysis/skeleton/flow_skeleton.h"
#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/geodesic.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <numeric>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mean_curvature_flow_skeletonization.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/Euler_operations.h>

namespace copse {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
// Holes are filled along a Delaunay triangulation, which walks in circles when its predicates are rounded.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using ClosedMesh = CGAL::Surface_mesh<Point>;
using Flow = CGAL::Mean_curvature_flow_skeletonization<ClosedMesh>;

// The surface is scaled to unit size round the origin.
struct Frame {
  Double3 centre;
  double size = 1;
  Point to(const Double3& p) const {
    const Double3 q = (p - centre) / size;
    return {q.x, q.y, q.z};
  }
  Double3 from(const Point& p) const { return centre + Double3{p.x(), p.y(), p.z()} * size; }
};

Frame frame_of(const Surface& s) {
  DoubleBox box;
  for (const Double3& p : s.positions) box.grow(p);
  const Double3 e = box.extent();
  const double size = std::max({e.x, e.y, e.z});
  return {box.centre(), size > 0 ? size : 1};
}

// The surface's triangles, turned to agree with one another; where they cannot, vertices are doubled.
struct Soup {
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::uint32_t> vertex;  // one a point
};

Soup orient(const Surface& s, const Frame& frame) {
  struct Copies : PMP::Default_orientation_visitor {
    explicit Copies(std::vector<std::uint32_t>& of) : of_(of) {}
    void duplicated_vertex(std::size_t from, std::size_t to) {
      if (of_.size() <= to) of_.resize(to + 1, k_none);
      of_[to] = of_[from];
    }
    std::vector<std::uint32_t>& of_;
  };
  Soup soup;
  for (const Double3& p : s.positions) soup.points.push_back(frame.to(p));
  for (const Triangle& t : s.triangles) soup.triangles.push_back({t[0], t[1], t[2]});
  soup.vertex.resize(soup.points.size());
  std::iota(soup.vertex.begin(), soup.vertex.end(), 0u);
  Copies copies(soup.vertex);
  PMP::orient_polygon_soup(soup.points, soup.triangles, CGAL::parameters::visitor(copies));
  soup.vertex.resize(soup.points.size(), k_none);
  return soup;
}

using VertexId = ClosedMesh::Property_map<ClosedMesh::Vertex_index, std::uint32_t>;

// One mesh a connected piece of the soup. A face that would touch another one in a vertex only is left out.
std::vector<ClosedMesh> separate(const Soup& soup) {
  std::vector<Triangle> triangles;
  for (const auto& t : soup.triangles) {
    triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                         static_cast<std::uint32_t>(t[2])});
  }
  const Components pieces = connected_components(triangles);
  std::vector<ClosedMesh> meshes(pieces.count);
  std::vector<VertexId> ids;
  for (ClosedMesh& m : meshes)
    ids.push_back(m.add_property_map<ClosedMesh::Vertex_index>("v:id", k_none).first);
  std::vector<ClosedMesh::Vertex_index> made(soup.points.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t piece = pieces.of[i];
    for (const std::uint32_t v : triangles[i]) {
      if (made[v] != ClosedMesh::null_vertex()) continue;
      made[v] = meshes[piece].add_vertex(soup.points[v]);
      ids[piece][made[v]] = soup.vertex[v];
    }
    meshes[piece].add_face(made[triangles[i][0]], made[triangles[i][1]], made[triangles[i][2]]);
  }
  return meshes;
}

// Triangles across a border of few vertices; a vertex in the middle of one of many, or where that fails.
void fill_holes(ClosedMesh& mesh) {
  std::vector<ClosedMesh::Halfedge_index> borders;
  PMP::extract_boundary_cycles(mesh, std::back_inserter(borders));
  for (const auto h : borders) {
    const auto around = CGAL::halfedges_around_face(h, mesh);
    CGAL::Vector_3<Kernel> sum(0, 0, 0);
    std::size_t count = 0;
    for (const auto e : around) sum += mesh.point(mesh.target(e)) - CGAL::ORIGIN, ++count;
    std::vector<ClosedMesh::Face_index> made;
    if (count <= k_widest_hole) PMP::triangulate_hole(mesh, h, std::back_inserter(made));
    if (!made.empty()) continue;
    CGAL::Euler::fill_hole(h, mesh);
    const auto spoke = CGAL::Euler::add_center_vertex(h, mesh);
    mesh.point(mesh.target(spoke)) = CGAL::ORIGIN + sum / static_cast<double>(count);
  }
}

// To the edges of an even mesh of so many triangles. False for a sliver, which would take more than twice
// as many edges: on it the flow, which splits wide angles at every step, goes on without end.
bool cut_long_edges(ClosedMesh& mesh, double triangles) {
  const double even = std::sqrt(PMP::area(mesh) / triangles * 4 / std::sqrt(3.0));
  double all = 0;
  for (const auto e : mesh.edges()) all += PMP::edge_length(mesh.halfedge(e), mesh);
  if (!(all <= 2 * triangles * even)) return false;
  PMP::split_long_edges(mesh.edges(), even, mesh);
  return true;
}

// Fills the borders, turns the mesh inside in, thins it out to what the flow can carry, and cuts long edges,
// as skeleton points come from vertices: into as many triangles as the piece's share of the surface is due,
// or a heap of many little pieces would flow for minutes. False when that does not give a closed mesh with
// something inside.
bool close(ClosedMesh& mesh, double share) {
  const double triangles = share * static_cast<double>(k_flow_triangles_at_least);
  fill_holes(mesh);
  if (mesh.number_of_faces() < 4 || !CGAL::is_closed(mesh)) return false;
  const double volume = PMP::volume(mesh);
  if (volume < 0) PMP::reverse_face_orientations(mesh);
  const double area = PMP::area(mesh);
  if (!(std::abs(volume) > k_flow_thinnest * area * std::sqrt(area))) return false;
  if (mesh.number_of_faces() > k_flow_triangles) {
    CGAL::Surface_mesh_simplification::edge_collapse(
        mesh, CGAL::Surface_mesh_simplification::Count_stop_predicate<ClosedMesh>(k_flow_triangles * 3 / 2));
  }
  if (static_cast<double>(mesh.number_of_faces()) < triangles && !cut_long_edges(mesh, triangles))
    return false;
  mesh.collect_garbage();
  return true;
}

void add_skeleton(const Flow::Skeleton& flowed, const ClosedMesh& mesh, const Frame& frame,
                  CurveSkeleton& k) {
  const auto id = mesh.property_map<ClosedMesh::Vertex_index, std::uint32_t>("v:id").first;
  const auto base = static_cast<std::uint32_t>(k.points.size());
  for (const auto n : CGAL::make_range(vertices(flowed))) {
    k.points.push_back(frame.from(flowed[n].point));
    for (const auto v : flowed[n].vertices) {
      if (id[v] != k_none) k.node_of[id[v]] = base + static_cast<std::uint32_t>(n);
    }
  }
  for (const auto e : CGAL::make_range(edges(flowed))) {
    const auto a = base + static_cast<std::uint32_t>(source(e, flowed));
    const auto b = base + static_cast<std::uint32_t>(target(e, flowed));
    k.edges.emplace_back(std::min(a, b), std::max(a, b));
  }
}

// Vertices that did not flow go where their neighbours on the surface went, the fewest edges away.
void spread_nodes(const Surface& s, const Lists& triangles_of, CurveSkeleton& k) {
  std::vector<std::uint32_t> queue;
  for (std::uint32_t v = 0; v < k.node_of.size(); ++v) {
    if (k.node_of[v] != k_none) queue.push_back(v);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const std::uint32_t t : triangles_of[queue[i]]) {
      for (const std::uint32_t w : s.triangles[t]) {
        if (k.node_of[w] == k_none) k.node_of[w] = k.node_of[queue[i]], queue.push_back(w);
      }
    }
  }
}

// Leaves out what no vertex of the surface leads to: what a filled hole has added.
void drop_stray_points(CurveSkeleton& k) {
  UnionFind sets(k.points.size());
  for (const auto& [a, b] : k.edges) sets.unite(a, b);
  std::vector<std::uint8_t> used(k.points.size(), 0);
  for (const std::uint32_t n : k.node_of) used[sets.find(n)] = 1;
  std::vector<std::uint32_t> number(k.points.size(), k_none);
  std::vector<Double3> points;
  for (std::uint32_t n = 0; n < number.size(); ++n) {
    if (!used[sets.find(n)]) continue;
    number[n] = static_cast<std::uint32_t>(points.size());
    points.push_back(k.points[n]);
  }
  std::erase_if(k.edges, [&](const auto& e) { return number[e.first] == k_none; });
  for (auto& [a, b] : k.edges) a = number[a], b = number[b];
  for (std::uint32_t& n : k.node_of) n = number[n];
  k.points = std::move(points);
}

// Joins the skeletons of pieces where an edge of the surface joins their vertices, and lists the triangles.
void connect(const Surface& s, CurveSkeleton& k) {
  UnionFind sets(k.points.size());
  for (const auto& [a, b] : k.edges) sets.unite(a, b);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> held;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = k.node_of[s.triangles[t][e]], b = k.node_of[s.triangles[t][(e + 1) % 3]];
      held.emplace_back(a, t);
      if (sets.find(a) == sets.find(b)) continue;
      sets.unite(a, b);
      k.edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::ranges::sort(k.edges);
  const auto repeated = std::ranges::unique(k.edges);
  k.edges.erase(repeated.begin(), repeated.end());
  k.triangles = make_lists(held, k.points.size());
}

double distance_to_triangle(const Surface& s, std::uint32_t t, const Point& p) {
  const auto corner = [&](std::size_t i) {
    const Double3& c = s.positions[s.triangles[t][i]];
    return Point(c.x, c.y, c.z);
  };
  return std::sqrt(CGAL::squared_distance(p, Kernel::Triangle_3(corner(0), corner(1), corner(2))));
}

// The rough radius at a point is its distance from the triangles whose vertices flowed there; a point that
// none flowed to has that of the nearest one along the skeleton that has.
void measure_radii(const Surface& s, CurveSkeleton& k) {
  k.radii.assign(k.points.size(), -1);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t n = 0; n < k.points.size(); ++n) {
    const Point p(k.points[n].x, k.points[n].y, k.points[n].z);
    for (const std::uint32_t t : k.triangles[n]) {
      const double d = distance_to_triangle(s, t, p);
      if (k.radii[n] < 0 || d < k.radii[n]) k.radii[n] = d;
    }
    if (k.radii[n] >= 0) queue.push_back(n);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> both = k.edges;
  for (const auto& [a, b] : k.edges) both.emplace_back(b, a);
  const Lists neighbours = make_lists(both, k.points.size());
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const std::uint32_t n : neighbours[queue[i]]) {
      if (k.radii[n] < 0) k.radii[n] = k.radii[queue[i]], queue.push_back(n);
    }
  }
}

}  // namespace

CurveSkeleton flow_skeleton(const Surface& surface) {
  CurveSkeleton k;
  if (surface.triangles.empty()) return k;
  k.node_of.assign(surface.positions.size(), k_none);
  const Frame frame = frame_of(surface);
  const CreationOrderBlock block;
  try {
    std::vector<ClosedMesh> pieces = separate(orient(surface, frame));
    const double all = std::accumulate(pieces.begin(), pieces.end(), 0.0, [](double n, const ClosedMesh& m) {
      return n + static_cast<double>(m.number_of_faces());
    });
    for (ClosedMesh& mesh : pieces) {
      if (!close(mesh, static_cast<double>(mesh.number_of_faces()) / all)) continue;
      Flow::Skeleton flowed;
      Flow flow(mesh);
      // Towards the middle by Voronoi poles: CGAL asks which of them lie inside, and on meshes that intersect
      // themselves it asks for ever. Circles are centred on sections later on.
      flow.set_is_medially_centered(false);
      flow(flowed);
      add_skeleton(flowed, mesh, frame, k);
    }
  } catch (const std::exception&) {
    return {};  // a factorisation failed: the caller has another method
  }
  if (std::ranges::count(k.node_of, k_none) == std::ssize(k.node_of)) return {};
  spread_nodes(surface, triangles_of_vertices(surface), k);
  drop_stray_points(k);
  std::uint32_t lowest = 0;
  for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
    if (surface.positions[v].y < surface.positions[lowest].y) lowest = v;
  }
  k.base = k.node_of[lowest];
  connect(surface, k);
  measure_radii(surface, k);
  return k;
}

}  // namespace copse
