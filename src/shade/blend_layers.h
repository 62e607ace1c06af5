// Layers of colour: what each shows at samples, and what becomes of the colour or light below it.
#pragma once

#include "frame/frame.h"
#include "laterna/blend.h"
#include "laterna/instruction_set.h"
#include "shade/illumination.h"
#include "shade/surface_points.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// What a layer's picture shows at samples: linear, colour not multiplied by alpha.
struct LayerColor {
  shadow::SampleArray<float> r, g, b, alpha;
  shadow::SampleArray<float> presence;  ///< 0 … 1: how much of the layer is there
  /// Samples that the layer is on, a bit each, by group.
  std::array<std::uint16_t, shadow::kMaxGroups> covered{};
};

/// A texture on the samples' surface.
using FindTextureColor = void (*)(const PointSource& source, const frame::Surface& surface,
                                  const frame::LayerBinding& layer, const shadow::SurfaceSamples& samples,
                                  LayerColor& color);
FindTextureColor find_texture_color_for(InstructionSet set);

/// A projector's slide, in focus, on what is in its frame and faces it. Whether anything stands between is not asked.
using FindDecalColor = void (*)(const BoundLight& projector, const shadow::SurfaceSamples& samples,
                                LayerColor& color);
FindDecalColor find_decal_color_for(InstructionSet set);

/// Lays it on the base colours of `points`, by the layer's mode, colour and opacity.
using BlendLayer = void (*)(const frame::LayerBinding& layer, std::size_t groups, const LayerColor& color,
                            SurfacePoints& points);
BlendLayer blend_layer_for(InstructionSet set);

/// A projector's part in radiance where it does not add: `own` is what it would add; `open`, what it would with nothing
/// before its lamp (neither slide nor colour, nor anything that casts a shadow); `earlier`, the sum over the lights before
/// it. The mode's formula is taken of light in units of `open`, which is white: t = own / open. `change` becomes what it
/// gives, the difference that it makes, and `earlier` the sum with it.
using BlendLight = void (*)(BlendMode mode, std::size_t groups, const Radiance& open, const Radiance& own,
                            Radiance& earlier, Radiance& change);
BlendLight blend_light_for(InstructionSet set);

}  // namespace laterna::shade
