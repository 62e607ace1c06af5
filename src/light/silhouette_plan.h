// What projected silhouettes are drawn from, and for whom: Chen and Tung, Real-time shadow rendering using projective
// texture. Matrices and lists only.
#pragma once

#include <vector>

#include "light/light_plan.h"
#include "light/shadow_pairs.h"

namespace laterna::light {

struct SilhouetteObject {
  BoundingSphere sphere;                             // of all that casts or receives
  glm::dvec3 low_ws{0}, high_ws{0};                  // box of what casts
  std::uint32_t first_cluster = 0, end_cluster = 0;  // the object's run in the frame
  bool casts = false, receives = false;
};

/// An object that may shade another.
struct SilhouetteOccluder {
  std::uint32_t object = 0;
  /// Where its silhouette is drawn from: one view about it, the light's own, or six where it is all round the light.
  std::vector<ShadowView> views;
};

/// What one receiver looks up.
struct SilhouetteLookup {
  std::uint32_t occluder = 0;  // into SilhouettePlan::occluders
  bool is_ordered = false;     // see ShadowPair
};

struct SilhouettePlan {
  std::vector<SilhouetteObject> objects;  // by the frame's object number
  std::vector<SilhouetteOccluder> occluders;
  std::vector<std::vector<SilhouetteLookup>> lookups;  // by receiver
  std::size_t pairs = 0;
  int margin = 0;  // texels about a silhouette that smoothing may reach
};

SilhouettePlan make_silhouette_plan(const PlannedLight& planned, const frame::Frame& frame);

/// How far silhouettes reach beyond their object, as a share of its radius: smoothing blurs them, and a filter reads a
/// texel more.
double silhouette_spread(const ShadowSettings& settings);

}  // namespace laterna::light
