// Normals where a file has none, or has useless ones.
#pragma once

#include <cstddef>

#include "laterna/scene.h"

namespace laterna {

/// The corner indices of triangle t, whether the primitive has indices or not.
struct Corners {
  std::size_t a, b, c;
};
Corners corners_of(const Primitive& primitive, std::size_t triangle);
std::size_t triangle_count(const Primitive& primitive);

/// Gives each triangle vertices of its own; indices become empty.
void unshare_vertices(Primitive& primitive);

/// glTF 2.0, 3.7.2.1: without normals a mesh is flat. Vertices become unshared; tangents, which need normals,
/// go. A triangle without area gets an arbitrary unit normal.
void compute_flat_normals(Primitive& primitive);

/// Smooth normals with edges: at each corner the faces around the same position count, weighted by their
/// angle there, as long as they are bent from the corner's own face by no more than `crease`. Vertices are
/// split where normals differ. Where more than 256 faces meet, the crease is not looked at.
void compute_smooth_normals(Primitive& primitive, Angle crease);

/// Brings normals to unit length; those without a length are taken from the faces around. Returns how
/// many of these any triangle uses.
std::size_t repair_normals(Primitive& primitive);

}  // namespace laterna
