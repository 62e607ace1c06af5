#include "shade/photograph_blend.h"

namespace laterna::shade {

BoundPhotograph::BoundPhotograph(const frame::PlacedPhotograph& placed, const raster::RasterView::Ray& ray,
                                 PhotographBlend blend, const image::MipChain* feather_map, int most_probes)
    : homogeneous(shadow::homogeneous_row(ray)),
      by_view(blend == PhotographBlend::view),
      picture(placed.picture),
      feather(feather_map),
      anisotropy(most_probes) {
  const Photograph& photograph = *placed.photograph;
  const glm::dmat4 m = glm::transpose(View{photograph.pose, photograph.projection}.image_from_world());
  picture_position = {shadow::ProjectedRow(m[0], ray), shadow::ProjectedRow(m[1], ray),
                      shadow::ProjectedRow(m[3], ray)};
  const Projection& p = photograph.projection;
  const double pixels = static_cast<double>(picture->width()) * picture->height();
  pixels_at_unit = static_cast<float>(pixels / ((p.right - p.left) * (p.top - p.bottom)));
  for (int i = 0; i < 3; ++i) {
    position_ws[i] = static_cast<float>(photograph.pose.position_ws[i]);
    forward_ws[i] = static_cast<float>(photograph.pose.forward_ws()[i]);
    gain[i] = photograph.gain[i];
  }
}

}  // namespace laterna::shade
