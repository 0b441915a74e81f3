// Polygons in an OBJ.
#pragma once

#include "lib/formats/mesh.h"

#include <string>

namespace copse::grow {

// The text of an OBJ whose `f` lines are the triangles of `mesh` in order; each polygon that was cut into a
// fan (Mesh::face_of) becomes one line again.
std::string join_faces(std::string obj, const Mesh& mesh);

}  // namespace copse::grow
