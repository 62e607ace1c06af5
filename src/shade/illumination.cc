#include "shade/illumination.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "frame/place_lights.h"

namespace laterna::shade {
namespace {

Wrap wrap_of(Outside outside) {
  switch (outside) {
    case Outside::repeat:
      return Wrap::repeat;
    case Outside::mirror:
      return Wrap::mirror;
    default:
      return Wrap::clamp;
  }
}

}  // namespace

BoundLight::BoundLight(const frame::PlacedLight& placed, const raster::RasterView::Ray& ray,
                       ShadingModel model, int most_probes)
    : light(placed.light),
      inverse_range(std::isinf(placed.light->range) ? 0.0F : static_cast<float>(1 / placed.light->range)),
      is_papers(model == ShadingModel::papers),
      lamp(placed.lamp),
      homogeneous(shadow::homogeneous_row(ray)),
      is_orthographic(placed.view.projection.is_orthographic),
      is_flat_field(frame::beam_profile(*placed.light) == BeamProfile::flat_field),
      slide(placed.slide),
      black_level(placed.light->slide_is_intensity ? 0.0F : static_cast<float>(placed.light->black_level)),
      anisotropy(most_probes) {
  for (int i = 0; i < 3; ++i) {
    color[i] = static_cast<float>(light->color[i] * (is_papers ? 1.0 : placed.intensity));
    position_ws[i] = static_cast<float>(placed.pose.position_ws[i]);
    forward_ws[i] = static_cast<float>(placed.pose.forward_ws()[i]);
    right_ws[i] = static_cast<float>(placed.pose.right_ws()[i]);
    up_ws[i] = static_cast<float>(placed.pose.up_ws()[i]);
  }
  if (light->type == LightType::spot) {
    // KHR_lights_punctual, "Inner and Outer Cone Angles".
    const double inner = cosine(light->inner_cone.in_radians());
    const double outer = cosine(light->outer_cone.in_radians());
    const double scale = 1 / std::max(0.001, inner - outer);
    cone_scale = static_cast<float>(scale);
    cone_offset = static_cast<float>(-outer * scale);
  }
  if (light->type == LightType::projector) {
    const glm::dmat4 m = glm::transpose(placed.view.image_from_world());
    slide_position = {shadow::ProjectedRow(m[0], ray), shadow::ProjectedRow(m[1], ray),
                      shadow::ProjectedRow(m[3], ray)};
    if (placed.lens) lens.emplace(*placed.lens);
    slide_sampler.wrap_u = slide_sampler.wrap_v = wrap_of(light->outside);
    const Projection& frame = placed.lens ? placed.lens->frame : placed.view.projection;
    blur_s = static_cast<float>(light->aperture.radius / (frame.right - frame.left));
    blur_t = static_cast<float>(light->aperture.radius / (frame.top - frame.bottom));
    inverse_focus = static_cast<float>(1 / light->aperture.focal_distance);
  }
}

BoundLight with_open_gate(BoundLight projector, const frame::PlacedLight& placed) {
  projector.slide = nullptr;
  std::fill_n(projector.color, 3, projector.is_papers ? 1.0F : static_cast<float>(placed.intensity));
  return projector;
}

}  // namespace laterna::shade
