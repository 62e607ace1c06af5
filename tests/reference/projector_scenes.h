// Projectors, slides and walls, from which the tests of projected light are put together.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>

#include "reference/shapes.h"

namespace laterna::reference {

/// A picture of linear floats from a function of (x, y): what it holds is what the slide throws, unrounded.
int add_linear_picture(Scene& scene, int width, int height, const std::function<glm::vec3(int, int)>& pixel);

/// A projector of which only name, frustum and slide are chosen. `half_width` and `half_height` are tangents.
Light projector(const std::string& name, double half_width, double half_height, int slide = -1);

/// A camera without perspective, square-on to walls that face +Z: `half_height` metres are half the picture.
View square_on(double half_height, double aspect, glm::dvec2 centre = {0, 0});

/// Settings of the papers' model: base colour · (ambient + Σ slide · α).
RenderSettings papers_settings(int width, int height);

}  // namespace laterna::reference
