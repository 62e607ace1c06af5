// Photographs thrown back through their cameras: a View with a picture, used backward. Where a projector adds light, a
// photograph says what the surfaces that it sees look like. docs/photographs.md tells more.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "laterna/shadows.h"
#include "laterna/view.h"

namespace laterna {

/// A pinhole camera's picture of the scene. Surfaces that it sees take its colour as their base colour; where several see a
/// surface, their mean by weight (PhotographSettings). It sees a surface within its frame that faces it and that nothing
/// hides which casts shadows; panes hide where they block more than half.
struct Photograph {
  std::string name;
  /// Index into Scene::pictures. Where its alpha is below ½ it shows nothing: a mask.
  int picture = -1;
  Pose pose;
  /// Perspective. The frustum is the whole picture: pixels need not be square.
  Projection projection;
  glm::vec3 gain{1};  ///< factor on its linear light, above 0: evens out exposure and white balance
};

/// Which of several photographs counts for a surface. All weigh by resolution and angle: w = (ρ cos θ)², ρ the photograph's
/// pixels per square metre of surface and θ the angle between the shading normal and the way to the camera.
enum class PhotographBlend : std::uint8_t {
  surface,  ///< nothing else counts: the colours of a surface stay when the camera moves
  /// As well by how near the photograph's direction of view is to the picture's (Debevec, Taylor and Malik, Modeling and
  /// Rendering Architecture from Photographs, 1996): from where a photograph was taken the picture is that photograph.
  view,
};

struct PhotographSettings {
  /// What finds which surfaces a photograph sees: `exact`, `map` or `raytraced`.
  ShadowTechnique visibility = ShadowTechnique::exact;
  /// Over this share of a photograph's longer side, from 0 (hard seams) to 0.5, its weight grows from its sides, from the rims
  /// of what stands before something else, and from its mask.
  double feather = 0.05;
  PhotographBlend blend = PhotographBlend::surface;
  /// False: what photographs show is the light that they were taken in, and no other shines (every material as if `unlit`).
  /// True: their colours are base colours, and the scene's lights shine on them.
  bool are_lit = false;
  glm::vec3 unseen{0};  ///< linear base colour of surfaces that no photograph sees
};

}  // namespace laterna
