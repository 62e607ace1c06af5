#include "light/light_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "laterna/technique_choice.h"
#include "light/cascades.h"
#include "light/floor.h"
#include "light/light_space_perspective.h"
#include "light/sun_view.h"

namespace laterna::light {
namespace {

using frame::Frame;
using frame::PlacedLight;

constexpr int kDefaultResolution = 2048;
constexpr int kDefaultFaceResolution = 1024;
constexpr int kDefaultSilhouetteResolution = 512;

// Where shadow maps of point and spot lights begin: before the nearest caster, but no farther than this. Reversed depth
// loses nothing by it.
constexpr double kFarthestNear = 0.01;
// Light inside a cluster's box: a share of the largest cluster's size, so that toys and planets are treated alike.
constexpr double kSmallestNear = 1e-5;

// Faces of cubes see this share of their side more to each side for `pcss`, whose filters are as wide as penumbrae; what
// lies beyond is not looked for.
constexpr int kSoftBorder = 8;
// And this many texels for the coarser levels of `variance`.
constexpr int kMipBorder = 8;

double distance_to(const Cluster& c, const glm::dvec3& point) {
  const glm::dvec3 low(c.low_ws[0], c.low_ws[1], c.low_ws[2]);
  const glm::dvec3 high(c.high_ws[0], c.high_ws[1], c.high_ws[2]);
  return glm::distance(point, glm::clamp(point, low, high));
}

// The near plane of a light that has none: no caster is nearer, unless it touches the light.
double near_plane(const PlacedLight& placed, const Frame& frame) {
  double nearest = kFarthestNear;
  double extent = 0;
  for (const Cluster& c : frame.clusters) {
    if ((c.flags & kCastsShadow) == 0) continue;
    // A face of a cube is 1/√3 as far as its corner.
    nearest = std::min(nearest, 0.5 * distance_to(c, placed.pose.position_ws));
    for (int k = 0; k < 3; ++k) extent = std::max(extent, static_cast<double>(c.high_ws[k]) - c.low_ws[k]);
  }
  return std::max(nearest, std::min(kFarthestNear, kSmallestNear * extent));
}

// How far a shadow map of a point or spot light must see. Range limits only those that fade by it.
double far_plane(const Light& light) {
  const bool ends =
      light.attenuation == Attenuation::gltf_windowed || light.attenuation == Attenuation::linear;
  return ends ? light.range : std::numeric_limits<double>::infinity();
}

// Texels beyond a cube face's own directions, for filters at its edges.
int face_border(const ShadowSettings& settings, ShadowTechnique technique) {
  const int taps = 2 + settings.kernel / 2;
  if (technique == ShadowTechnique::pcss) return std::max(taps, settings.resolution / kSoftBorder);
  if (technique == ShadowTechnique::variance)
    return taps + kMipBorder + static_cast<int>(std::ceil(settings.blur));
  return taps;
}

// +X, −X, +Y, −Y, +Z, −Z of the world; up is chosen to be no neighbour's direction of view.
std::vector<ShadowView> cube_views(const Pose& pose, int resolution, int border, double near, double far) {
  const int side = resolution + 2 * border;
  const double half = static_cast<double>(side) / resolution;
  std::vector<ShadowView> views;
  for (int face = 0; face < 6; ++face) {
    glm::dvec3 gaze(0);
    gaze[face / 2] = face % 2 == 0 ? 1 : -1;
    const glm::dvec3 up = face / 2 == 1 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    ShadowView shadow;
    shadow.view.pose = *Pose::look_at(pose.position_ws, pose.position_ws + gaze, up);
    // look_at normalises (target − position), which rounds where the position is far from the origin.
    shadow.view.pose.world_from_view_rotation = glm::dmat3(glm::cross(gaze, up), up, -gaze);
    shadow.view.projection = {false, -half, half, -half, half, near, far};
    shadow.width = shadow.height = side;
    views.push_back(shadow);
  }
  return views;
}

// The same texels, and some more to each side. Means of what a filter saw are only those about a receiver where it sees as
// far to every side.
ShadowView widened(ShadowView shadow, int border) {
  Projection& p = shadow.view.projection;
  const double x = border * (p.right - p.left) / shadow.width;
  const double y = border * (p.top - p.bottom) / shadow.height;
  p.left -= x;
  p.right += x;
  p.bottom -= y;
  p.top += y;
  shadow.width += 2 * border;
  shadow.height += 2 * border;
  return shadow;
}

// Out of focus a slide reaches beyond its frame, at tangents up to radius |1/focus − 1/d| more, and needs shadows there:
// as far as from half the focal distance on, and a tenth of the frame for what is nearer. In texels of the same size, unless
// those are more than a map may have.
ShadowView widened_for_focus(const PlacedLight& placed, ShadowView shadow) {
  const Aperture& aperture = placed.light->aperture;
  const Projection& p = placed.view.projection;
  const double blur = aperture.radius / aperture.focal_distance;
  const double share = std::clamp(blur / std::min(p.right - p.left, p.top - p.bottom), 0.1, 0.5);
  const auto most = static_cast<int>(kMaxShadowResolution / (1 + 2 * share));
  shadow.width = std::min(shadow.width, most);
  shadow.height = std::min(shadow.height, most);
  return widened(shadow, static_cast<int>(std::floor(share * shadow.width)));
}

std::vector<ShadowView> shadow_views(const PlacedLight& placed, const Frame& frame,
                                     const ShadowSettings& settings, ShadowTechnique technique) {
  const Light& light = *placed.light;
  const int border = technique == ShadowTechnique::variance ? face_border(settings, technique) : 0;
  switch (light.type) {
    case LightType::directional:
      if (light.fit)
        return {fit_to_box(placed.pose, box_of_casters(placed.pose, frame), settings.resolution)};
      return {widened({{placed.pose, light.projection}, settings.resolution, settings.resolution}, border)};
    case LightType::projector:
      return {widened({placed.view, settings.resolution, settings.resolution}, border)};
    case LightType::spot: {
      const double half_angle = light.outer_cone.in_degrees();
      if (shines_all_round(light)) break;
      // A little wider than the cone, for the filter at its rim.
      const Angle field = Angle::degrees(std::min(2 * half_angle * 1.01 + 0.1, 2 * kWidestSingleMap + 2));
      return {{{placed.pose, Projection::perspective(field, 1, near_plane(placed, frame), far_plane(light))},
               settings.resolution,
               settings.resolution}};
    }
    case LightType::point:
      break;
  }
  return cube_views(placed.pose, settings.resolution, face_border(settings, technique),
                    near_plane(placed, frame), far_plane(light));
}

}  // namespace

namespace {

// The light itself, or one point of its source or lens.
const PlacedLight* place(const PlacedLight& placed, SampleIndex sample, LightPlan& plan) {
  if (sample.count == 1 || !has_samples(*placed.light)) return &placed;
  PlacedLight& moved = plan.placed_points.emplace_back(at_sample(placed, sample));
  Light& light = plan.points.emplace_back(*placed.light);
  light.source = {};
  light.aperture = {};
  moved.light = &light;
  return &moved;
}

int default_resolution(ShadowTechnique technique, LightType type) {
  if (technique == ShadowTechnique::silhouette) return kDefaultSilhouetteResolution;
  return type == LightType::point ? kDefaultFaceResolution : kDefaultResolution;
}

// The floor is looked for once for all lights that name no planes.
void find_ground_planes(const Frame& frame, std::vector<PlannedLight>& lights) {
  const auto wants_floor = [](const PlannedLight& planned) {
    return planned.technique == ShadowTechnique::ground && planned.settings.planes.empty();
  };
  std::vector<ShadowPlane> floor;
  if (std::any_of(lights.begin(), lights.end(), wants_floor)) {
    if (const std::optional<ShadowPlane> found = find_floor(frame)) floor.push_back(*found);
  }
  for (PlannedLight& planned : lights) {
    if (planned.technique != ShadowTechnique::ground) continue;
    planned.ground_planes = wants_floor(planned) ? floor : planned.settings.planes;
  }
}

}  // namespace

LightPlan make_light_plan(const Frame& frame, const PlanSettings& plan_settings) {
  LightPlan plan;
  for (const PlacedLight& placed : frame.lights) {
    PlannedLight planned;
    planned.number = static_cast<std::uint32_t>(plan.lights.size());
    planned.placed = place(placed, plan_settings.sample, plan);
    planned.settings = placed.light->shadow;
    planned.technique = technique_for(*planned.placed->light, plan_settings.technique);
    if (planned.settings.resolution == 0) {
      planned.settings.resolution = default_resolution(planned.technique, placed.light->type);
    }
    switch (planned.technique) {
      case ShadowTechnique::map:
      case ShadowTechnique::pcss:
      case ShadowTechnique::variance:
        planned.shadow_views = shadow_views(*planned.placed, frame, planned.settings, planned.technique);
        break;
      case ShadowTechnique::cascades:
        planned.shadow_views = cascade_views(*planned.placed, frame, planned.settings, plan_settings.camera);
        break;
      default:
        break;
    }
    if (planned.technique == ShadowTechnique::map && planned.settings.warp != ShadowWarp::none) {
      planned.shadow_views = {
          light_space_perspective_view(*planned.placed, frame, planned.settings, plan_settings.camera)};
    }
    if (planned.placed->light->aperture.radius > 0) {
      for (ShadowView& shadow : planned.shadow_views) shadow = widened_for_focus(*planned.placed, shadow);
    }
    plan.lights.push_back(std::move(planned));
  }
  find_ground_planes(frame, plan.lights);
  return plan;
}

PlannedLight with_shadow_map(PlannedLight planned, const Frame& frame) {
  planned.technique = ShadowTechnique::map;
  planned.shadow_views = shadow_views(*planned.placed, frame, planned.settings, ShadowTechnique::map);
  return planned;
}

}  // namespace laterna::light
