// A facade that photographs are taken of, and what they must show, written down from the formulas.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "reference/shapes.h"

namespace laterna::reference {

/// A wall 8 m wide and 6 m high in the plane z = 0, with balconies, a pillar and a wing before it.
Scene facade();

/// A camera of OpenCV's numbers at `position`, looking at `target`.
View photograph_view(glm::dvec3 position, glm::dvec3 target, double focal_pixels, glm::dvec2 principal,
                     int width, int height);

/// The point of the plane z = 0 that a view sees at a place of its picture, in pixels from the top-left corner.
glm::dvec2 on_facade(const View& view, int width, int height, glm::dvec2 pixel);
/// Where a view sees a point.
glm::dvec2 in_picture(const View& view, int width, int height, glm::dvec3 point_ws);

/// Appends a photograph whose pixels are linear floats, or 8-bit sRGB; the function takes (x, y).
void add_photograph(Scene& scene, const std::string& name, const View& view, int width, int height,
                    const std::function<glm::vec3(int, int)>& linear_color, bool as_codes = false);

/// Whether a point with that normal is in the frame of the photograph, faces it, and no triangle of the scene's meshes, placed
/// as their nodes say, hides it. In double, one triangle after the other.
bool sees(const Scene& scene, const Photograph& photograph, glm::dvec3 point_ws, glm::dvec3 normal_ws);

/// The sRGB code of a linear value.
int code_of(float linear);

}  // namespace laterna::reference
