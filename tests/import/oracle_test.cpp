// Other people's readers and writers agree with ours where a file is well-formed.
#include "tests/import/testing.h"

#include <iostream>

// Their headers warn.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#define TINYOBJLOADER_USE_DOUBLE
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <tiny_obj_loader.h>
#pragma GCC diagnostic pop

namespace copse {
namespace {

using namespace copse::testing;

TEST(Oracle, TinyobjloaderReadsTheSameCornersFromTheRealTrees) {
  const std::filesystem::path folder = COPSE_SOURCE_DIR "/../shared/trees";
  if (!std::filesystem::exists(folder)) {
    std::cout << "skipped: the real trees are not at " << folder << "\n";
    return;
  }
  for (const char* name : {"sap_quaking_aspen.obj", "quaternius_oak_1.obj", "kenney_tree_detailed_fall.obj",
                           "shapespark_tree_1.obj"}) {
    const Import ours = good(import_mesh(folder / name));
    std::ifstream stream(folder / name);
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    ASSERT_TRUE(tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr, false))
        << error;
    ASSERT_EQ(attributes.vertices.size(), 3 * ours.mesh.positions.size());
    for (std::size_t i = 0; i < attributes.vertices.size(); ++i)
      // tinyobjloader rounds the last digit its own way.
      ASSERT_NEAR(attributes.vertices[i], ours.mesh.positions[i / 3][static_cast<int>(i % 3)], 1e-14) << name;
    std::size_t triangle = 0;
    for (const auto& shape : shapes) {
      for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3, ++triangle) {
        for (std::size_t c = 0; c < 3; ++c) {
          const tinyobj::index_t& theirs = shape.mesh.indices[i + c];
          ASSERT_EQ(static_cast<std::uint32_t>(theirs.vertex_index), ours.mesh.triangles[triangle][c])
              << name;
          const auto agrees = [&](const std::vector<Triangle>& corners, int index) {
            return corners.empty() || corners[triangle][c] == static_cast<std::uint32_t>(index);
          };
          ASSERT_TRUE(agrees(ours.mesh.texcoord_triangles, theirs.texcoord_index)) << name;
          ASSERT_TRUE(agrees(ours.mesh.normal_triangles, theirs.normal_index)) << name;
        }
      }
    }
    EXPECT_EQ(triangle, ours.mesh.triangles.size());
  }
}

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

TEST(Oracle, WhatOpenMeshWritesIsReadBack) {
  // A grid of quads with two triangles, with coordinates that float32 holds exactly.
  Polygons mesh;
  std::vector<Polygons::VertexHandle> v;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) v.push_back(mesh.add_vertex({x * 0.5, y * 0.25, x * y * 0.125}));
  }
  for (std::size_t y = 0; y < 3; ++y) {
    for (std::size_t x = 0; x < 3; ++x) {
      const std::size_t i = 4 * y + x;
      if (i == 0) {
        mesh.add_face(v[0], v[1], v[5]);
        mesh.add_face(v[0], v[5], v[4]);
      } else {
        mesh.add_face(v[i], v[i + 1], v[i + 5], v[i + 4]);
      }
    }
  }
  using OpenMesh::IO::Options;
  const std::vector<std::pair<std::string, Options>> kinds{{"a.ply", Options()},
                                                           {"b.ply", Options(Options::Binary)},
                                                           {"c.ply", Options(Options::Binary | Options::MSB)},
                                                           {"d.off", Options()},
                                                           {"e.obj", Options()}};
  const Folder folder;
  for (const auto& [name, options] : kinds) {
    const auto path = folder.path() / name;
    ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path.string(), options)) << name;
    const Import ours = good(import_mesh(path));
    ASSERT_EQ(ours.mesh.positions.size(), mesh.n_vertices()) << name;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto& p = mesh.point(v[i]);
      EXPECT_EQ(ours.mesh.positions[i], (Double3{p[0], p[1], p[2]})) << name;
    }
    EXPECT_EQ(ours.mesh.triangles.size(), 18u) << name;
    EXPECT_EQ(ours.counts.cut_polygons, 8u) << name;
  }
}

TEST(Oracle, WhatOpenMeshWritesAsStlIsReadAndWeldedBack) {
  Polygons mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({1, 0, 0}), c = mesh.add_vertex({0, 1, 0}),
             d = mesh.add_vertex({0, 0, 1});
  mesh.add_face(a, c, b);
  mesh.add_face(a, b, d);
  mesh.add_face(b, c, d);
  mesh.add_face(c, a, d);
  const Folder folder;
  for (const bool binary : {false, true}) {
    const auto path = folder.path() / (binary ? "b.stl" : "a.stl");
    const auto options =
        binary ? OpenMesh::IO::Options(OpenMesh::IO::Options::Binary) : OpenMesh::IO::Options();
    ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path.string(), options));
    const Import ours = good(import_mesh(path));
    EXPECT_EQ(ours.mesh.positions.size(), 4u);
    EXPECT_EQ(ours.mesh.triangles.size(), 4u);
  }
}

}  // namespace
}  // namespace copse
