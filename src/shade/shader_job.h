// What a picture's tiles are shaded from.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "raster/tile_raster.h"
#include "shade/environment_light.h"
#include "shade/illumination.h"
#include "shade/layer_painter.h"
#include "shade/light_reach.h"
#include "shade/lobe_shader.h"
#include "shade/mirror_shader.h"
#include "shade/photograph_painter.h"
#include "shade/sample_offsets.h"
#include "shade/shadow_tone.h"
#include "shade/tile_layers.h"
#include "shadow/shadow_technique.h"

namespace laterna::shade {

/// A light as the shaders use it.
struct ShaderLight {
  BoundLight bound;
  LightReach reach;
  /// Null: nothing stands in its way.
  std::unique_ptr<shadow::ShadowTechnique> shadow;
  ShadowTone tone;
  /// The light with nothing before its lamp, where it does more than add (Light::blend).
  std::optional<BoundLight> open = std::nullopt;
};

/// Everything that is the same for all tiles of a picture.
struct ShaderJob {
  const frame::Frame* frame = nullptr;
  const raster::RasterView* view = nullptr;
  std::span<const raster::Batch> batches;
  std::vector<ShaderLight> lights;
  PhotographJob photographs;
  std::vector<ShaderDecal> decals;  // the frame's
  std::optional<EnvironmentLight> environment;
  LobeJob lobes;
  MirrorJob mirrors;
  std::vector<BoundLight> physical_lights;  // for lux where the model is not physical; otherwise empty
  ReflectionSettings reflection;
  Interpolation interpolation = Interpolation::perspective;
  int anisotropy = 1;
  int samples_per_pixel = 1;
  SampleOffset jitter;  // of the samples
  bool is_turned =
      false;  // the picture's left is another's right, and so are its samples' (light::MirrorView)
  Passes passes = Passes::single;
  const glm::vec3* background = nullptr;  // null: black and transparent
  WantedLayers wanted;
  InstructionSet instruction_set = InstructionSet::scalar;
};

}  // namespace laterna::shade
