// What is known of a surface at each sample once its triangle's corners are interpolated and its textures looked up.
#pragma once

#include "frame/frame.h"
#include "laterna/instruction_set.h"
#include "laterna/shading.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// Reflectance and orientation of samples, in the order of SurfaceSamples.
struct SurfacePoints {
  shadow::SampleArray<float> normal_x_ws, normal_y_ws,
      normal_z_ws;  // shading normal, unit, toward the viewer's side
  shadow::SampleArray<float> to_eye_x_ws, to_eye_y_ws, to_eye_z_ws;  // unit
  shadow::SampleArray<float> base_r, base_g, base_b, alpha;          // base colour, linear
  shadow::SampleArray<float> metallic, roughness, occlusion;
  shadow::SampleArray<float> emissive_r, emissive_g, emissive_b;
};

/// What finding surface points needs to know of where the samples come from.
struct PointSource {
  const frame::Frame* frame = nullptr;
  const raster::RasterView* view = nullptr;
  Interpolation interpolation = Interpolation::perspective;
  int anisotropy = 1;
};

/// Fills the world-space part of `samples`, all of one surface, and `points`.
using FindSurfacePoints = void (*)(const PointSource& source, const frame::Surface& surface,
                                   shadow::SurfaceSamples& samples, SurfacePoints& points);
FindSurfacePoints find_surface_points_for(InstructionSet set);

}  // namespace laterna::shade
