// The impostor as geometry that any viewer draws: two of its pictures, upright and across one another.
#pragma once

#include "lib/formats/levels/impostors.h"
#include "lib/formats/mesh.h"

namespace copse {

// Appends two quads with the views nearest to +Z and +X, each in the plane that its view looks at square on,
// and what they need: a material with an alpha test whose texture is the atlas's colours, embedded. The part
// is called "impostor". `origin`: the tree's. The mesh has normals and texture coordinates at every corner,
// as append_state leaves it; the atlas holds views.
void append_impostor_cross(Mesh& mesh, const ImpostorAtlas& atlas, const Double3& origin);

}  // namespace copse
