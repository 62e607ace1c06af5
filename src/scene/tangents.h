// Tangents for normal maps where a file has none.
#pragma once

#include "laterna/scene.h"

namespace laterna {

/// Tangents along u of the texture coordinates `uv_set`, as mikktspace defines them in outline: each face's
/// direction of rising u, projected into the vertex's plane and weighted by the face's angle there, summed
/// over all corners that share position, normal and coordinates and have the same handedness. bitangent = w ·
/// cross(normal, tangent) points along falling v (glTF's v points down the picture): w is +1 where the
/// picture is not mirrored. Vertices on a seam between the two hands are split. Faces without area in uv take
/// their neighbours' tangent, or an arbitrary one across the normal. Positions, normals (unit) and that uv
/// set must be there. The coordinates are the mesh's own: a texture transform does not enter, as for tangents
/// stored in files.
void compute_tangents(Primitive& primitive, int uv_set);

}  // namespace laterna
