#include "shade/layer_painter.h"

#include <algorithm>

namespace laterna::shade {

LayerPainter::LayerPainter(const PointSource& source, const std::vector<ShaderDecal>& decals,
                           InstructionSet set)
    : source_(source),
      decals_(decals),
      find_texture_color_(find_texture_color_for(set)),
      find_decal_color_(find_decal_color_for(set)),
      blend_layer_(blend_layer_for(set)),
      find_bounds_(find_bounds_for(set)),
      color_(std::make_unique<LayerColor>()),
      arrival_(std::make_unique<shadow::Arrival>()) {}

double LayerPainter::paint(const frame::Surface& surface, const frame::LayerBinding& layer,
                           const shadow::SurfaceSamples& samples, SurfacePoints& points) {
  double drawing_ms = 0;
  if (layer.decal < 0) {
    find_texture_color_(source_, surface, layer, samples, *color_);
  } else {
    drawing_ms = find_decal(layer, samples);
  }
  blend_layer_(layer, samples.group_count, *color_, points);
  return drawing_ms;
}

// A slide is on what its projector sees; at soft edges in part.
double LayerPainter::find_decal(const frame::LayerBinding& layer, const shadow::SurfaceSamples& samples) {
  const ShaderDecal& decal = decals_[static_cast<std::size_t>(layer.decal)];
  color_->covered.fill(0);
  if (!decal.reach.touches(find_bounds_(samples))) return 0;
  find_decal_color_(decal.bound, samples, *color_);
  if (!layer.occluded || decal.visibility == nullptr) return 0;
  const std::span covered = std::span<const std::uint16_t>(color_->covered).first(samples.group_count);
  if (std::all_of(covered.begin(), covered.end(), [](std::uint16_t group) { return group == 0; })) return 0;
  const double drawing_ms = decal.visibility->find_arrival(samples, covered, *arrival_);
  for_each_sample(samples, covered, [&](std::size_t i) { color_->presence[i] = arrival_->alpha[i]; });
  return drawing_ms;
}

}  // namespace laterna::shade
