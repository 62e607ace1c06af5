#include "frame/place_lights.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/elementary.h"
#include "frame/lamp_table.h"
#include "image/luminance.h"

namespace laterna::frame {
namespace {

// What `lumens` come to, by what sends them.
double candela_of(const Light& light, const PlacedLight& placed) {
  if (placed.lamp != nullptr) {
    // Scaled as a whole: the peak by as much as the flux.
    return placed.lamp->peak_candela * (light.lumens ? *light.lumens / placed.lamp->lumens : light.intensity);
  }
  if (!light.lumens) return light.intensity;
  switch (light.type) {
    case LightType::point:
      return *light.lumens / (4 * kPi);
    case LightType::spot:
      return *light.lumens / solid_angle_of_spot(light);
    default:
      break;
  }
  if (placed.lens) return candela_from_lumens(*light.lumens, *placed.lens, beam_profile(light));
  const Projection& projection = placed.view.projection;
  if (light.slide_is_intensity && placed.slide != nullptr && !projection.is_orthographic) {
    const double angle = solid_angle_of_map(*placed.slide, projection);
    return angle > 0 ? *light.lumens / angle : 0;  // a black map throws nothing
  }
  return candela_from_lumens(*light.lumens, projection, beam_profile(light));
}

const LampTable* find_lamp(const Light& light, Frame& frame) {
  if (light.distribution == nullptr) return nullptr;
  std::shared_ptr<const LampTable>& table = frame.lamps[light.distribution];
  if (table == nullptr) table = std::make_shared<const LampTable>(*light.distribution);
  return table.get();
}

PlacedLight place(const Light& light, int node, const Pose& pose, image::MipUse slide_use, Frame& frame) {
  PlacedLight placed;
  placed.light = &light;
  placed.node = node;
  placed.pose = pose;
  placed.slide = frame.textures->find(light.slide, slide_use);
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
  placed.lamp = find_lamp(light, frame);
  placed.intensity = candela_of(light, placed);
  return placed;
}

}  // namespace

BeamProfile beam_profile(const Light& light) {
  return light.slide_is_intensity ? BeamProfile::uniform_candela : light.profile;
}

double solid_angle_of_map(const image::MipChain& map, const Projection& p) {
  // Levels are means over area: a few hundred cells to a side are as good as all texels.
  constexpr int kEnoughCells = 256;
  int level = 0;
  while (level + 1 < map.level_count &&
         std::max(map.levels[static_cast<std::size_t>(level)].width,
                  map.levels[static_cast<std::size_t>(level)].height) > kEnoughCells)
    ++level;
  const image::MipLevel& size = map.levels[static_cast<std::size_t>(level)];
  const double width = (p.right - p.left) / size.width, height = (p.top - p.bottom) / size.height;
  double sum = 0;
  for (int y = 0; y < size.height; ++y) {
    const double top = p.top - y * height;
    for (int x = 0; x < size.width; ++x) {
      const double left = p.left + x * width;
      const std::array<float, 4> value = image::texel(map, level, x, y);
      const double luminance = image::luminance<double>(value[0], value[1], value[2]);
      sum += luminance * solid_angle({false, left, left + width, top - height, top, 1, 2});
    }
  }
  return sum;
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
    if (light.enabled) frame.lights.push_back(place(light, index, *pose, slide_use(light), frame));
  }
}

std::vector<int> decal_lights(const Scene& scene) {
  std::set<int> lights;
  for (const Material& material : scene.materials) {
    for (const SurfaceLayer& layer : material.layers) {
      if (layer.projector >= 0) lights.insert(layer.projector);
    }
  }
  return {lights.begin(), lights.end()};
}

void place_decals(const Scene& scene, const std::vector<glm::dmat4>& world_from_node, Frame& frame) {
  for (const int index : decal_lights(scene)) {
    const auto node = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                   [&](const Node& candidate) { return candidate.light == index; });
    const std::ptrdiff_t at = node - scene.nodes.begin();
    const Result<Pose> pose = Pose::from_matrix(world_from_node[static_cast<std::size_t>(at)]);
    frame.decals.push_back(
        place(scene.lights[static_cast<std::size_t>(index)], static_cast<int>(at), *pose, kLayerUse, frame));
  }
}

}  // namespace laterna::frame
