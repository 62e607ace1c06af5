// The solids of the gallery's scenes. All but `rectangle` and `terrain` are closed, as shadow volumes like them.
// Nothing here calls libm, which may answer differently on another machine: the pictures would.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "laterna/scene.h"

namespace laterna::app {

/// Cosine and sine of a part of a full turn.
glm::dvec2 point_of_circle(double turns);

/// A flat rectangle of `size` metres around `centre`, spanned by unit vectors; the front is where `right` × `up` points.
/// The texture repeats every `metres_per_tile`.
Primitive rectangle(glm::vec3 centre, glm::vec3 right, glm::vec3 up, glm::vec2 size, float metres_per_tile);

Primitive box(glm::vec3 low, glm::vec3 high);

/// A radius at a height: a point of the outline of a turned piece.
struct Turning {
  float radius, height;
};
/// A piece turned on the lathe around +Y through `foot`, its outline a smooth curve through `corners` from the foot
/// up. Two corners at the same place make a sharp edge.
Primitive turned_piece(glm::vec3 foot, const std::vector<Turning>& corners, int segments = 48);
Primitive ball(glm::vec3 centre, float radius);

/// A point on the middle line of a pipe, and how thick it is there.
struct PipePoint {
  glm::vec3 centre;
  float radius;
};
/// A round pipe along a smooth curve through `points`, closed at both ends.
Primitive pipe(const std::vector<PipePoint>& points, int segments = 20);
/// A ring (torus) whose axis is `axis`.
Primitive ring(glm::vec3 centre, glm::vec3 axis, float radius, float tube, int segments = 72);

/// A sheet of side × side quads over the square of `size` metres around `centre`; `height` in metres, of x and z from
/// the centre.
Primitive terrain(glm::vec3 centre, float size, int side, const std::function<float(float, float)>& height);

/// A teapot: body, lid, spout and handle. About 0.6 m high.
Primitive teapot(glm::vec3 foot, float scale = 1);
/// A wooden mannequin 1.8 m tall that walks along +Z turned by `turns` about +Y; `stride` in −1…1 is where in its step.
Primitive mannequin(glm::vec3 foot, double turns, float stride);

/// Appends `more` to `primitive`.
void append(Primitive& primitive, const Primitive& more);
/// Each corner p becomes centre + scale (p − centre).
void scale_about(Primitive& primitive, glm::vec3 centre, float scale);

}  // namespace laterna::app
