#include "shadow/relief_shadow.h"

#include <array>

namespace laterna::shadow {

ReliefLight::ReliefLight(const light::PlannedLight& planned, const raster::RasterView& camera)
    : is_parallel(laterna::is_parallel(*planned.placed->light)),
      stays_in_picture(planned.technique == laterna::ShadowTechnique::volume),
      is_orthographic(camera.is_orthographic),
      x_add(static_cast<float>(camera.x_add)),
      y_add(static_cast<float>(camera.y_add)),
      w_add(static_cast<float>(camera.w_add)),
      low_x(static_cast<float>(-camera.origin_x)),
      low_y(static_cast<float>(-camera.origin_y)),
      high_x(static_cast<float>(camera.width - camera.origin_x)),
      high_y(static_cast<float>(camera.height - camera.origin_y)) {
  const Pose& pose = planned.placed->pose;
  const glm::dvec3 forward = pose.forward_ws();
  for (int i = 0; i < 3; ++i) {
    position_ws[i] = static_cast<float>(pose.position_ws[i]);
    to_light_ws[i] = static_cast<float>(-forward[i]);
    eye_ws[i] = static_cast<float>(camera.eye_ws[i]);
    axis_ws[i] = static_cast<float>(camera.axis_ws[i]);
    x_row[i] = static_cast<float>(camera.x_row[i]);
    y_row[i] = static_cast<float>(camera.y_row[i]);
    w_row[i] = static_cast<float>(camera.w_row[i]);
    direction_x[i] = static_cast<float>(camera.direction_x[i]);
    direction_y[i] = static_cast<float>(camera.direction_y[i]);
  }
}

double ShadowOnRelief::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                    Arrival& arrival) const {
  const Cluster& cluster = frame_.clusters[cluster_of(samples.id[0])];
  if ((cluster.flags & kRelief) == 0) return technique_->find_arrival(samples, wanted, arrival);
  return find_on_relief(frame_.surfaces[cluster.material], samples, wanted, arrival);
}

double ShadowOnRelief::find_on_relief(const frame::Surface& surface, const SurfaceSamples& samples,
                                      std::span<const std::uint16_t> wanted, Arrival& arrival) const {
  SurfaceSamples entries;
  std::array<std::uint16_t, kMaxGroups> shaded{};
  find_relief_entries_(frame_, surface, light_, samples, entries, shaded.data());
  const double drawing_ms = technique_->find_arrival(entries, wanted, arrival);
  if (!surface.relief.self_shadow) return drawing_ms;
  for_each_sample(samples, std::span<const std::uint16_t>(shaded).first(samples.group_count),
                  [&](std::size_t i) {
                    for (SampleArray<float>* share : {&arrival.alpha, &arrival.r, &arrival.g, &arrival.b})
                      (*share)[i] = 0;
                  });
  return drawing_ms;
}

}  // namespace laterna::shadow
