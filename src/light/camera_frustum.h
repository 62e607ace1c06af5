// What of a frame a camera sees, as far as boxes of clusters tell.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "light/sun_view.h"

namespace laterna::light {

struct ClusterBox {
  glm::dvec3 middle{0}, reach{0};
};

ClusterBox box_of(const Cluster& cluster);

/// Boxes of visible clusters between the four sides of a view.
std::vector<ClusterBox> find_seen_boxes(const View& camera, const frame::Frame& frame);

/// How far along the camera's axis there is anything to see, in metres. In a perspective view in steps of powers of two,
/// so that it stays as it is while the camera moves a little.
Range find_depth_range(const View& camera, const frame::Frame& frame);

}  // namespace laterna::light
