// What will be drawn for the lights, before a pixel is: each light with its matrices and the shadow views that its
// technique wants. Matrices and lists only.
#pragma once

#include <deque>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "frame/frame.h"
#include "light/light_samples.h"

namespace laterna::light {

/// A projective map of the world that keeps triangles triangles, and parallel the rays of one light.
struct Warp {
  // Homogeneous: the fourth coordinate is positive where the map may be asked.
  glm::dmat4 warped_from_world{1.0};
  View light_view;  // orthographic: the light's, in the world
};

/// A depth map to be drawn: an ordinary View, drawn by the camera's raster code.
struct ShadowView {
  View view;
  int width = 0, height = 0;                // texels
  std::optional<Warp> warp = std::nullopt;  // with one, `view` is a view of the warped world

  [[nodiscard]] glm::dmat4 image_from_world() const {
    return warp ? view.image_from_world() * warp->warped_from_world : view.image_from_world();
  }
};

struct PlannedLight {
  const frame::PlacedLight* placed = nullptr;
  std::uint32_t number = 0;  // in the frame's order
  ShadowTechnique technique = ShadowTechnique::none;
  ShadowSettings settings;  // resolution filled in
  // map: one, or six for a light that shines all round; cascades: finest first
  std::vector<ShadowView> shadow_views;
  std::vector<ShadowPlane> ground_planes;  // ground
};

struct LightPlan {
  std::vector<PlannedLight> lights;  // in the frame's order
  // Lights as they shine from one point of their source or lens: moved, and without size.
  std::deque<Light> points;
  std::deque<frame::PlacedLight> placed_points;
};

struct PlanSettings {
  ShadowTechnique technique = ShadowTechnique::map;  // for lights that name none
  SampleIndex sample;  // of a mean: every light is planned as it shines from its point of that number
  const View* camera = nullptr;  // cascades follow it; without one there is a single map
};

LightPlan make_light_plan(const frame::Frame& frame, const PlanSettings& settings);

/// The light as if its technique were `map`.
PlannedLight with_shadow_map(PlannedLight planned, const frame::Frame& frame);

}  // namespace laterna::light
