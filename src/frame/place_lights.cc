#include "frame/place_lights.h"

#include <cmath>

#include "base/elementary.h"

namespace laterna::frame {
namespace {

PlacedLight place(const Light& light, int node, const Pose& pose, const Frame& frame) {
  PlacedLight placed;
  placed.light = &light;
  placed.node = node;
  placed.pose = pose;
  placed.slide = frame.textures->find(light.slide, slide_use(light));
  Projection projection = light.projection;
  if (light.type == LightType::projector && light.aspect_from_slide && placed.slide != nullptr) {
    const double aspect = static_cast<double>(placed.slide->width()) / placed.slide->height();
    const double half_width = (projection.top - projection.bottom) * aspect / 2;
    // A frustum that is off its axis stays so in proportion.
    const double middle =
        (projection.left + projection.right) / (projection.right - projection.left) * half_width;
    projection.left = middle - half_width;
    projection.right = middle + half_width;
  }
  placed.view = {pose, projection};
  if (light.type == LightType::projector && !light.distortion.is_none()) {
    placed.lens.emplace(light.distortion, projection);
    placed.view.projection = placed.lens->beam;
  }
  placed.intensity = light.intensity;
  if (light.type == LightType::projector && light.lumens) {
    placed.intensity = placed.lens ? candela_from_lumens(*light.lumens, *placed.lens, beam_profile(light))
                                   : candela_from_lumens(*light.lumens, projection, beam_profile(light));
  }
  return placed;
}

// Solid angle of the quarter frustum between the axis and the side tangents x and y (signed).
double quarter_solid_angle(double x, double y) { return arctangent(x * y / std::sqrt(1 + x * x + y * y)); }

}  // namespace

BeamProfile beam_profile(const Light& light) {
  return light.slide_is_intensity ? BeamProfile::uniform_candela : light.profile;
}

double solid_angle(const Projection& p) {
  return quarter_solid_angle(p.right, p.top) - quarter_solid_angle(p.left, p.top) -
         quarter_solid_angle(p.right, p.bottom) + quarter_solid_angle(p.left, p.bottom);
}

double candela_from_lumens(double lumens, const Projection& p, BeamProfile profile) {
  const double area = (p.right - p.left) * (p.top - p.bottom);  // at 1 m
  if (p.is_orthographic) return lumens / area;                  // lux, at any distance
  return lumens / (profile == BeamProfile::flat_field ? area : solid_angle(p));
}

double candela_from_lumens(double lumens, const SlideLens& lens, BeamProfile profile) {
  return lumens / (profile == BeamProfile::flat_field ? lens.area : lens.solid_angle);
}

void place_lights_and_cameras(const Scene& scene, const std::vector<glm::dmat4>& world_from_node,
                              Frame& frame) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.light < 0 && node.camera < 0) continue;
    const Result<Pose> pose = Pose::from_matrix(world_from_node[i]);
    if (!pose) continue;  // validate() has refused such a scene
    const int index = static_cast<int>(i);
    if (node.camera >= 0)
      frame.cameras.push_back({&scene.cameras[static_cast<std::size_t>(node.camera)], index, *pose});
    if (node.light < 0) continue;
    const Light& light = scene.lights[static_cast<std::size_t>(node.light)];
    if (light.enabled) frame.lights.push_back(place(light, index, *pose, frame));
  }
}

}  // namespace laterna::frame
