#include "light/silhouette_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "light/light_rays.h"

namespace laterna::light {
namespace {

using frame::Frame;
using frame::PlacedLight;

// Texels that a bilinear filter reads beyond the last one that is covered.
constexpr int kFilterRim = 2;

// A view about an object is at most this wide: sine of its half-angle, 60°. Nearer to the light than that the light's own
// views serve.
constexpr double kWidestSine = 0.866;

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void include(const Cluster& c) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min<double>(low[k], c.low_ws[k]);
      high[k] = std::max<double>(high[k], c.high_ws[k]);
    }
  }
};

bool takes_part(const Cluster& cluster) {
  return is_opaque_caster(cluster) || (cluster.flags & (kReceivesShadow | kVisible)) != 0;
}

double square_to_farthest_vertex(const Frame& frame, const Cluster& cluster, const glm::dvec3& centre) {
  double farthest = 0;
  for (std::size_t v = cluster.first_vertex; v < cluster.first_vertex + cluster.vertex_count; ++v) {
    const glm::dvec3 d = glm::dvec3(frame.positions_ws[v]) - centre;
    farthest = std::max(farthest, glm::dot(d, d));
  }
  return farthest;
}

SilhouetteObject describe_object(const Frame& frame, std::uint32_t first, std::uint32_t end) {
  SilhouetteObject object;
  object.first_cluster = first;
  object.end_cluster = end;
  Box whole;
  Box casting;
  for (std::uint32_t c = first; c < end; ++c) {
    const Cluster& cluster = frame.clusters[c];
    if (!takes_part(cluster)) continue;
    whole.include(cluster);
    if (is_opaque_caster(cluster)) {
      object.casts = true;
      casting.include(cluster);
    }
    if ((cluster.flags & kReceivesShadow) != 0) object.receives = true;
  }
  if (!object.casts && !object.receives) return object;
  object.low_ws = casting.low;
  object.high_ws = casting.high;
  object.sphere.centre = 0.5 * (whole.low + whole.high);
  double square = 0;
  for (std::uint32_t c = first; c < end; ++c) {
    if (takes_part(frame.clusters[c]))
      square = std::max(square, square_to_farthest_vertex(frame, frame.clusters[c], object.sphere.centre));
  }
  object.sphere.radius = std::sqrt(square);
  return object;
}

// The clusters of an object are neighbours.
std::vector<SilhouetteObject> describe_objects(const Frame& frame) {
  std::vector<SilhouetteObject> objects(frame.object_names.size());
  const auto count = static_cast<std::uint32_t>(frame.clusters.size());
  for (std::uint32_t first = 0, end = 0; first < count; first = end) {
    const std::uint32_t object = frame.clusters[first].object;
    while (end < count && frame.clusters[end].object == object) ++end;
    objects[object] = describe_object(frame, first, end);
  }
  return objects;
}

// Share of a picture's half side that `margin` texels on each side leave.
double inner_share(int side, int margin) { return side > 4 * margin ? 1 - 2.0 * margin / side : 0.5; }

// Parallel rays: a square about the object's box.
ShadowView orthographic_view(const PlacedLight& placed, const SilhouetteObject& object, int side,
                             int margin) {
  const glm::dvec3 centre = 0.5 * (object.low_ws + object.high_ws) - placed.pose.position_ws;
  const glm::dvec3 half_box = 0.5 * (object.high_ws - object.low_ws);
  const auto reach = [&](const glm::dvec3& axis) { return glm::dot(glm::abs(axis), half_box); };
  const glm::dvec3 right = placed.pose.right_ws();
  const glm::dvec3 up = placed.pose.up_ws();
  const glm::dvec3 forward = placed.pose.forward_ws();
  // A box with no extent at all is given a little.
  const double largest = std::max({half_box.x, half_box.y, half_box.z, 1e-6});
  const double half = std::max({std::min(std::max(reach(right), reach(up)), object.sphere.radius * 1.000001),
                                1e-3 * largest}) /
                      inner_share(side, margin);
  const double x = glm::dot(right, centre);
  const double y = glm::dot(up, centre);
  const double z = glm::dot(forward, centre);
  const double deep = reach(forward) + 1e-3 * largest;
  double near = z - deep;
  // A light with a box of its own begins at its near plane.
  if (has_frustum(*placed.light)) near = std::max(near, placed.view.projection.near);
  // Of an object wholly before it nothing is drawn.
  const double far = std::max(z + deep, near + deep);
  return {{placed.pose, {true, x - half, x + half, y - half, y + half, near, far}}, side, side};
}

// About the object's sphere, which the light is outside of. Nothing but the object is drawn, so that the planes need not
// be tight.
ShadowView perspective_view(const PlacedLight& placed, const SilhouetteObject& object, int side, int margin) {
  const glm::dvec3 gaze = object.sphere.centre - placed.pose.position_ws;
  const double distance = glm::length(gaze);
  const double radius = std::max(object.sphere.radius, 1e-6 * distance);
  const double tangent = radius / std::sqrt((distance - radius) * (distance + radius));
  const double half = tangent / inner_share(side, margin);
  const glm::dvec3 up = std::abs(gaze.y) > 0.99 * distance ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const double near = 0.5 * (distance - radius);
  ShadowView shadow;
  shadow.view.pose = *Pose::look_at(placed.pose.position_ws, object.sphere.centre, up);
  shadow.view.projection = {false, -half, half, -half, half, near, std::numeric_limits<double>::infinity()};
  shadow.width = shadow.height = side;
  return shadow;
}

double square_of_half_diagonal(const ShadowView& shadow) {
  const Projection& p = shadow.view.projection;
  const double x = std::max(-p.left, p.right);
  const double y = std::max(-p.bottom, p.top);
  return x * x + y * y;
}

// Whether some of the object lies before the projector's near plane, which lies across the projector's own axis: only
// the projector's own view cuts it there.
bool is_cut_by_near_plane(const PlacedLight& placed, const SilhouetteObject& object) {
  if (placed.light->type != LightType::projector) return false;
  const glm::dvec3 forward = placed.pose.forward_ws();
  const glm::dvec3 centre = 0.5 * (object.low_ws + object.high_ws) - placed.pose.position_ws;
  const double reach = glm::dot(glm::abs(forward), 0.5 * (object.high_ws - object.low_ws));
  return glm::dot(forward, centre) - reach < placed.view.projection.near;
}

std::vector<ShadowView> occluder_views(const PlannedLight& planned, const SilhouetteObject& object,
                                       const std::vector<ShadowView>& own_views, int margin) {
  const PlacedLight& placed = *planned.placed;
  const int side = planned.settings.resolution;
  if (placed.light->type == LightType::directional) return {orthographic_view(placed, object, side, margin)};
  if (is_parallel(*placed.light) || is_cut_by_near_plane(placed, object)) return own_views;
  const double distance = glm::distance(object.sphere.centre, placed.pose.position_ws);
  if (object.sphere.radius >= kWidestSine * distance) return own_views;
  ShadowView about = perspective_view(placed, object, side, margin);
  // What lies beside a light's cone or frame is dark in any case.
  if (own_views.size() == 1 && square_of_half_diagonal(own_views[0]) < square_of_half_diagonal(about))
    return own_views;
  return {std::move(about)};
}

// Every two objects, whether their outlines overlap or not.
std::vector<ShadowPair> all_pairs(std::span<const BoundingSphere> spheres, const glm::dvec4& light) {
  std::vector<SphereOutline> outlines;
  for (const BoundingSphere& sphere : spheres) outlines.emplace_back(sphere, light);
  std::vector<ShadowPair> pairs;
  for (std::uint32_t a = 0; a < outlines.size(); ++a) {
    for (std::uint32_t b = 0; b < outlines.size(); ++b) {
      if (a != b && !outlines[b].lies_before(outlines[a]))
        pairs.push_back({a, b, outlines[a].lies_before(outlines[b])});
    }
  }
  return pairs;
}

// Without an order each of two shades the other.
void ignore_order(std::vector<ShadowPair>& pairs) {
  const std::size_t count = pairs.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (pairs[i].is_ordered) pairs.push_back({pairs[i].receiver, pairs[i].occluder, true});
    pairs[i].is_ordered = true;
  }
}

// Of the objects that take part.
std::vector<ShadowPair> pairs_of(const std::vector<SilhouetteObject>& objects, const PlannedLight& planned) {
  const glm::dvec4 light = homogeneous_light(*planned.placed);
  const double spread = 1 + silhouette_spread(planned.settings);
  std::vector<BoundingSphere> spheres;
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    if (!objects[i].casts && !objects[i].receives) continue;
    spheres.push_back({objects[i].sphere.centre, objects[i].sphere.radius * spread});
    numbers.push_back(i);
  }
  std::vector<ShadowPair> pairs =
      planned.settings.culls_occluders ? sweep_shadow_pairs(spheres, light) : all_pairs(spheres, light);
  if (!planned.settings.orders_objects) ignore_order(pairs);
  for (ShadowPair& pair : pairs) {
    pair.occluder = numbers[pair.occluder];
    pair.receiver = numbers[pair.receiver];
  }
  return pairs;
}

// Light's own views, as for a shadow map; faces of a cube with as much to spare as smoothing needs.
std::vector<ShadowView> own_views_of(PlannedLight planned, const Frame& frame, int margin) {
  planned.settings.kernel = std::max(planned.settings.kernel, 2 * margin);
  return with_shadow_map(std::move(planned), frame).shadow_views;
}

}  // namespace

double silhouette_spread(const ShadowSettings& settings) {
  const int margin = kFilterRim + settings.smooth;
  return 2 * (1 / inner_share(settings.resolution, margin) - 1);
}

SilhouettePlan make_silhouette_plan(const PlannedLight& planned, const Frame& frame) {
  SilhouettePlan plan;
  plan.margin = kFilterRim + planned.settings.smooth;
  plan.objects = describe_objects(frame);
  plan.lookups.resize(plan.objects.size());
  const std::vector<ShadowView> own_views = own_views_of(planned, frame, plan.margin);
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::vector<std::uint32_t> occluder_of(plan.objects.size(), kNone);
  for (const ShadowPair& pair : pairs_of(plan.objects, planned)) {
    const SilhouetteObject& object = plan.objects[pair.occluder];
    if (!object.casts || !plan.objects[pair.receiver].receives) continue;
    std::uint32_t& occluder = occluder_of[pair.occluder];
    if (occluder == kNone) {
      occluder = static_cast<std::uint32_t>(plan.occluders.size());
      plan.occluders.push_back({pair.occluder, occluder_views(planned, object, own_views, plan.margin)});
    }
    plan.lookups[pair.receiver].push_back({occluder, pair.is_ordered});
    ++plan.pairs;
  }
  return plan;
}

}  // namespace laterna::light
