// Base colours of a batch of samples under the layers of their surface.
#pragma once

#include <memory>
#include <vector>

#include "shade/blend_layers.h"
#include "shade/light_reach.h"
#include "shadow/shadow_technique.h"

namespace laterna::shade {

/// A projector whose slide layers show.
struct ShaderDecal {
  BoundLight bound;
  LightReach reach;
  std::unique_ptr<shadow::ShadowTechnique> visibility;  ///< null: everything is in sight
};

/// Buffers of one worker.
class LayerPainter {
 public:
  /// `decals`: in the frame's order.
  LayerPainter(const PointSource& source, const std::vector<ShaderDecal>& decals, InstructionSet set);

  /// Lays one layer of the samples' surface on the base colours of `points`. Returns what ShadowTechnique::find_arrival does.
  double paint(const frame::Surface& surface, const frame::LayerBinding& layer,
               const shadow::SurfaceSamples& samples, SurfacePoints& points);

 private:
  double find_decal(const frame::LayerBinding& layer, const shadow::SurfaceSamples& samples);

  const PointSource& source_;
  const std::vector<ShaderDecal>& decals_;
  FindTextureColor find_texture_color_;
  FindDecalColor find_decal_color_;
  BlendLayer blend_layer_;
  FindBounds find_bounds_;
  std::unique_ptr<LayerColor> color_;
  std::unique_ptr<shadow::Arrival> arrival_;
};

}  // namespace laterna::shade
