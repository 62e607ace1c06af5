#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "base/elementary.h"
#include "base/refuse.h"
#include "laterna/measure.h"
#include "laterna/technique_choice.h"
#include "light/cascades.h"
#include "measure/painted_surfaces.h"

namespace laterna {
namespace {

// A light's maps and the settings they are read with.
struct LightMaps {
  std::vector<ShadowMapView> views;
  std::vector<glm::dmat4> image_from_world;
  bool are_cascades = false;
  int kernel = 0;

  /// Where a point lies in a map: texels from its top-left corner.
  [[nodiscard]] std::optional<glm::dvec2> texel_of(std::size_t map, const glm::dvec3& point_ws) const {
    const glm::dvec4 q = image_from_world[map] * glm::dvec4(point_ws, 1);
    if (q.w <= 0) return std::nullopt;
    const glm::dvec2 texel = glm::dvec2(q) / q.w * glm::dvec2(views[map].width, views[map].height);
    if (texel.x < 0 || texel.y < 0 || texel.x >= views[map].width || texel.y >= views[map].height)
      return std::nullopt;
    return texel;
  }

  /// The share of the answer that a map gives where no finer one does: see light::cascade_band.
  [[nodiscard]] double weight_of(std::size_t map, const glm::dvec3& point_ws) const {
    const std::optional<glm::dvec2> texel = texel_of(map, point_ws);
    if (!texel) return 0;
    if (!are_cascades || map + 1 == views.size()) return 1;
    const glm::dvec2 size(views[map].width, views[map].height);
    const glm::dvec2 inside = glm::min(*texel, size - *texel);
    const double band = light::cascade_band(views[map].width, views[map].height);
    return std::clamp((std::min(inside.x, inside.y) - light::cascade_rim(kernel)) / band, 0.0, 1.0);
  }
};

Result<LightMaps> find_maps(const Renderer& renderer, const View& camera, const RenderSettings& settings,
                            const std::string& name) {
  Result<std::vector<ShadowMapView>> views = renderer.shadow_map_views(name, camera, settings);
  if (!views) return tl::unexpected(std::move(views.error()));
  if (views->empty()) return refuse("light \"" + name + "\": its shadows are found without shadow maps");
  const Scene& scene = renderer.scene();
  const int index = scene.nodes[static_cast<std::size_t>(find_light_node(scene, name))].light;
  const Light& light = scene.lights[static_cast<std::size_t>(index)];
  LightMaps maps;
  maps.views = std::move(*views);
  for (const ShadowMapView& map : maps.views) maps.image_from_world.push_back(map.image_from_world);
  maps.are_cascades = technique_for(light, settings.shadows) == ShadowTechnique::cascades;
  maps.kernel = light.shadow.kernel;
  return maps;
}

struct NamedColor {
  const char* name;
  glm::dvec3 color;
};

// What no map holds.
constexpr NamedColor kNoMap = {"grey", {0.15, 0.15, 0.15}};

constexpr std::array<NamedColor, 8> kCascadeColors = {{{"red", {0.9, 0.1, 0.1}},
                                                       {"green", {0.1, 0.7, 0.1}},
                                                       {"blue", {0.1, 0.25, 0.9}},
                                                       {"yellow", {0.9, 0.8, 0.1}},
                                                       {"magenta", {0.8, 0.1, 0.7}},
                                                       {"cyan", {0.1, 0.75, 0.8}},
                                                       {"orange", {0.95, 0.4, 0.05}},
                                                       {"violet", {0.4, 0.15, 0.8}}}};

// Texels per pixel from 1/8 to 8, in steps of two.
constexpr std::array<NamedColor, 7> kDensityColors = {{{"dark red", {0.35, 0, 0}},
                                                       {"red", {0.95, 0.05, 0.02}},
                                                       {"orange", {0.95, 0.5, 0.02}},
                                                       {"green", {0.1, 0.7, 0.1}},
                                                       {"cyan", {0.05, 0.7, 0.75}},
                                                       {"blue", {0.05, 0.2, 0.95}},
                                                       {"dark blue", {0.02, 0.02, 0.3}}}};
constexpr int kMostSteps = 3;

glm::dvec3 density_color(double texels_per_pixel) {
  const double step =
      std::clamp(logarithm2(texels_per_pixel), -1.0 * kMostSteps, 1.0 * kMostSteps) + kMostSteps;
  const auto low = std::min(static_cast<std::size_t>(step), kDensityColors.size() - 2);
  const double t = step - static_cast<double>(low);
  return glm::mix(kDensityColors[low].color, kDensityColors[low + 1].color, t);
}

// How many texels or pixels there are in a metre where a point is, square to the gaze: the root of their number in a
// square metre, which is that of the area between the two gradients of the picture's coordinates.
double steps_per_metre(const glm::dmat4& image_from_world, const glm::dvec2& size,
                       const glm::dvec3& point_ws) {
  const glm::dmat4 rows = glm::transpose(image_from_world);
  const glm::dvec4 q = image_from_world * glm::dvec4(point_ws, 1);
  const auto gradient = [&](int k) {
    return (glm::dvec3(rows[k]) - glm::dvec3(rows[3]) * (q[k] / q.w)) * (size[k] / q.w);
  };
  return std::sqrt(glm::length(glm::cross(gradient(0), gradient(1))));
}

// Texels per metre of the map that answers for a point; of a cube's faces, which reach a little beyond their edges, the
// one that it lies before, where the texels are widest.
std::optional<double> texels_per_metre(const LightMaps& maps, const glm::dvec3& point_ws) {
  std::optional<double> density;
  for (std::size_t i = 0; i < maps.views.size(); ++i) {
    if (maps.weight_of(i, point_ws) < 0.5) continue;
    const double here = steps_per_metre(maps.image_from_world[i],
                                        glm::dvec2(maps.views[i].width, maps.views[i].height), point_ws);
    if (maps.are_cascades) return here;
    density = std::min(density.value_or(here), here);
  }
  return density;
}

}  // namespace

Result<ExplainedPicture> cascade_picture(const Renderer& renderer, const View& camera,
                                         const RenderSettings& settings, const std::string& light) {
  const Result<LightMaps> maps = find_maps(renderer, camera, settings, light);
  if (!maps) return tl::unexpected(maps.error());
  if (!maps->are_cascades)
    return refuse("light \"" + light + "\" has no cascades: its shadow technique is another one");
  Result<LayeredImage> picture =
      measure::paint_surfaces(renderer, camera, settings, [&](const measure::SeenSurface& seen) {
        glm::dvec3 color = kNoMap.color;
        for (std::size_t i = maps->views.size(); i-- > 0;)
          color = glm::mix(color, kCascadeColors[i].color, maps->weight_of(i, seen.point_ws));
        return color;
      });
  if (!picture) return tl::unexpected(std::move(picture.error()));
  ExplainedPicture explained = {std::move(*picture), {}};
  for (std::size_t i = 0; i < maps->views.size(); ++i) {
    const ShadowMapView& map = maps->views[i];
    const double texel = (map.view.projection.right - map.view.projection.left) / map.width;
    explained.legend.push_back(fmt::format("{:<9} cascade {}: {} x {} texels of {:.4g} mm",
                                           kCascadeColors[i].name, i + 1, map.width, map.height,
                                           1000 * texel));
  }
  explained.legend.push_back(fmt::format("{:<9} beyond all of them", kNoMap.name));
  return explained;
}

Result<ExplainedPicture> texel_density_picture(const Renderer& renderer, const View& camera,
                                               const RenderSettings& settings, const std::string& light) {
  const Result<LightMaps> maps = find_maps(renderer, camera, settings, light);
  if (!maps) return tl::unexpected(maps.error());
  const glm::dmat4 image_from_world = camera.image_from_world();
  const glm::dvec2 pixels(settings.width, settings.height);
  std::vector<double> per_metre;
  Result<LayeredImage> picture =
      measure::paint_surfaces(renderer, camera, settings, [&](const measure::SeenSurface& seen) {
        const std::optional<double> texels = texels_per_metre(*maps, seen.point_ws);
        if (!texels) return kNoMap.color;
        per_metre.push_back(*texels);
        return density_color(*texels / steps_per_metre(image_from_world, pixels, seen.point_ws));
      });
  if (!picture) return tl::unexpected(std::move(picture.error()));
  ExplainedPicture explained = {std::move(*picture), {}};
  for (std::size_t i = 0; i < kDensityColors.size(); ++i) {
    const double density = exponential2(static_cast<double>(i) - kMostSteps);
    const char* beyond = i == 0 ? " or fewer" : i + 1 == kDensityColors.size() ? " or more" : "";
    explained.legend.push_back(
        fmt::format("{:<9} {:g}{} shadow texels along a pixel", kDensityColors[i].name, density, beyond));
  }
  explained.legend.push_back(fmt::format("{:<9} outside the map", kNoMap.name));
  if (!per_metre.empty()) {
    std::sort(per_metre.begin(), per_metre.end());
    explained.legend.push_back(fmt::format("texels per metre: {:.4g} to {:.4g}, median {:.4g}",
                                           per_metre.front(), per_metre.back(),
                                           per_metre[per_metre.size() / 2]));
  }
  return explained;
}

}  // namespace laterna
