// Where vertices and faces of a mesh under construction go.
#pragma once

#include "lib/formats/mesh.h"

#include <array>
#include <cstdint>
#include <span>

namespace copse::grow {

// From the generator's frame (metres, +Y up, ground at 0) to the mesh's.
struct Placement {
  bool z_up = false;
  double scale = 1;
  Double3 offset;   // added first, in metres
  double step = 0;  // coordinates are whole multiples of it, as an exporter that prints so many decimals
                    // gives them; a power of ten, 0: exact

  Double3 apply(const Double3& p) const;
  Double3 undo(const Double3& p) const;
  Double3 turn(const Double3& direction) const {
    return z_up ? Double3{direction.x, -direction.z, direction.y} : direction;
  }
};

class Surface {
 public:
  Surface(Placement placement, bool quads) : placement_(placement), quads_(quads) {}

  const Placement& placement() const { return placement_; }
  Mesh& mesh() { return mesh_; }
  Double3 position(std::uint32_t vertex) const { return mesh_.positions[vertex]; }

  std::uint32_t vertex(const Double3& position, const Double3& normal);
  // A vertex in the very place of another one, or `apart` from it.
  std::uint32_t twin(std::uint32_t of, const Double3& apart = {});
  std::uint32_t texcoord(double u, double v);
  void move(std::uint32_t vertex, const Double3& to) { mesh_.positions[vertex] = to; }
  std::uint32_t last_vertex() const { return static_cast<std::uint32_t>(mesh_.positions.size() - 1); }
  void begin_part(std::uint32_t part) { part_ = part; }
  // Corners counter-clockwise seen from outside; vertices and texture coordinates in parallel.
  void triangle(const std::array<std::uint32_t, 3>& v, const std::array<std::uint32_t, 3>& t);
  void quad(const std::array<std::uint32_t, 4>& v, const std::array<std::uint32_t, 4>& t);
  void polygon(std::span<const std::uint32_t> v, std::span<const std::uint32_t> t);
  std::uint64_t triangles() const { return mesh_.triangles.size(); }

  // Room for so many triangles, and the vertices that usually come with them.
  void reserve(std::uint64_t triangles);
  // Gives the mesh away; normals are indexed as positions are.
  Mesh finish();

 private:
  void push(const std::array<std::uint32_t, 3>& v, const std::array<std::uint32_t, 3>& t);
  Mesh mesh_;
  Placement placement_;
  bool quads_;
  std::uint32_t part_ = 0;
  std::uint32_t faces_ = 0;
};

}  // namespace copse::grow
