#include "light/cascades.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/elementary.h"
#include "light/camera_frustum.h"

namespace laterna::light {
namespace {

// The sphere around a slice of a frustum, in the camera's own space (x, y, and distance along the axis).
struct Sphere {
  glm::dvec3 centre;
  double radius;
};

Sphere sphere_around(const Projection& p, double near, double far) {
  const double across = 0.5 * (p.right - p.left), upward = 0.5 * (p.top - p.bottom);
  const glm::dvec2 middle(0.5 * (p.left + p.right), 0.5 * (p.bottom + p.top));
  // Where near and far corners are equally far away; beyond far, the far corners alone count.
  const double slope = p.is_orthographic ? 0 : across * across + upward * upward;
  const double distance = std::min(0.5 * (near + far) * (1 + slope), far);
  const auto at = [&](double x, double y, double d) {
    return p.is_orthographic ? glm::dvec3(x, y, d) : glm::dvec3(x * d, y * d, d);
  };
  Sphere sphere = {at(middle.x, middle.y, distance), 0};
  for (const double d : {near, far}) {
    for (const double x : {p.left, p.right}) {
      for (const double y : {p.bottom, p.top})
        sphere.radius = std::max(sphere.radius, glm::distance(sphere.centre, at(x, y, d)));
    }
  }
  return sphere;
}

// Texel columns or rows of the light's raster; the first begins `first` texels from the light's axis.
struct TexelSpan {
  double first;
  int count;
};

// The fewest texels a map has across.
constexpr int kLeastTexels = 16;

TexelSpan span_of(double centre, double radius, double texel, int count, const Range& casters, int rim) {
  const double first = std::floor((centre - radius) / texel) - rim;
  const double end = first + count;
  // What casts lies within the band: this map answers for it alone.
  const double margin = rim + std::ceil(static_cast<double>(cascade_band(count, count)));
  const double casters_first = std::floor(casters.low / texel) - margin;
  const double casters_end = std::ceil(casters.high / texel) + margin;
  const double held_first = std::clamp(casters_first, first, end - kLeastTexels);
  const double held_end = std::clamp(casters_end, held_first + kLeastTexels, end);
  return {held_first, static_cast<int>(held_end - held_first)};
}

// The map of one slice. Its view stands on a coarse raster of its own: near enough for single precision to be as good
// there as at the light, and unmoved by small steps of the camera, so that these do not even change how it rounds.
ShadowView view_of_slice(const Pose& light, const LightBox& casters, const glm::dvec3& centre_ws,
                         double radius, int resolution, int rim) {
  const double texel = 2 * radius / (resolution - 2 * rim - 1);
  const glm::dvec3 centre = centre_ws - light.position_ws;
  const auto across = [&](const glm::dvec3& axis, const Range& range) {
    return span_of(glm::dot(axis, centre), radius, texel, resolution, range, rim);
  };
  const TexelSpan x = across(light.right_ws(), casters.x), y = across(light.up_ws(), casters.y);
  const auto standpoint = [&](const TexelSpan& span) {
    return std::floor((span.first + 0.5 * span.count) / resolution + 0.5) * resolution;
  };
  const double at_x = standpoint(x), at_y = standpoint(y);
  ShadowView shadow;
  shadow.width = x.count;
  shadow.height = y.count;
  shadow.view.pose = light;
  shadow.view.pose.position_ws += light.right_ws() * (at_x * texel) + light.up_ws() * (at_y * texel);
  shadow.view.projection = {true,
                            (x.first - at_x) * texel,
                            (x.first - at_x + x.count) * texel,
                            (y.first - at_y) * texel,
                            (y.first - at_y + y.count) * texel,
                            casters.depth.low,
                            casters.depth.high};
  return shadow;
}

LightBox box_of_light(const frame::PlacedLight& placed, const frame::Frame& frame) {
  const Light& light = *placed.light;
  if (light.fit) return box_of_casters(placed.pose, frame);
  const Projection& p = light.projection;
  return {{p.left, p.right}, {p.bottom, p.top}, {p.near, p.far}};
}

ShadowView whole_view(const frame::PlacedLight& placed, const LightBox& box, int resolution) {
  if (placed.light->fit) return fit_to_box(placed.pose, box, resolution);
  return {{placed.pose, placed.light->projection}, resolution, resolution};
}

}  // namespace

std::vector<double> find_splits(double near, double far, int count, double lambda) {
  std::vector<double> splits;
  for (int i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    const double uniform = near + (far - near) * t;
    const double logarithmic = lambda > 0 ? near * power(far / near, t) : 0;
    splits.push_back(lambda * logarithmic + (1 - lambda) * uniform);
  }
  splits.back() = far;
  return splits;
}

std::vector<ShadowView> cascade_views(const frame::PlacedLight& placed, const frame::Frame& frame,
                                      const ShadowSettings& settings, const View* camera) {
  const LightBox box = box_of_light(placed, frame);
  const ShadowView whole = whole_view(placed, box, settings.resolution);
  if (camera == nullptr) return {whole};
  Range depth = find_depth_range(*camera, frame);
  if (settings.cascade_distance > 0) depth.high = settings.cascade_distance;
  depth.low = std::min(depth.low, 0.5 * depth.high);
  const Projection& p = camera->projection;
  // Without perspective what is near is not larger.
  const double lambda = p.is_orthographic ? 0 : settings.split_lambda;
  const std::vector<double> splits = find_splits(depth.low, depth.high, settings.cascades, lambda);
  const int rim = cascade_rim(settings.kernel);
  const int resolution = std::max(settings.resolution, 4 * (kLeastTexels + rim));
  std::vector<ShadowView> views;
  for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
    const Sphere sphere = sphere_around(p, splits[i], splits[i + 1]);
    const glm::dvec3 centre_ws = camera->pose.position_ws + camera->pose.right_ws() * sphere.centre.x +
                                 camera->pose.up_ws() * sphere.centre.y +
                                 camera->pose.forward_ws() * sphere.centre.z;
    views.push_back(view_of_slice(placed.pose, box, centre_ws, sphere.radius, resolution, rim));
    if (texel_of(views.back()) < texel_of(whole)) continue;
    // One map of everything is as fine, and needs no further ones.
    views.back() = whole;
    return views;
  }
  return views;
}

}  // namespace laterna::light
