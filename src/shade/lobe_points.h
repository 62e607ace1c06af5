// What the lobes of a surface's reflection come to at each sample.
#pragma once

#include "frame/surface_lobes.h"
#include "shade/surface_points.h"

namespace laterna::shade {

/// In the order of SurfaceSamples. Of lobes that the surface lacks, nothing is written and nothing is read.
struct LobePoints {
  /// Of what is no metal: F₀ before it is weighed, and the weight, which is F₉₀ too.
  shadow::SampleArray<float> f0_r, f0_g, f0_b, specular;
  shadow::SampleArray<float> clearcoat, clearcoat_roughness;
  shadow::SampleArray<float> coat_normal_x_ws, coat_normal_y_ws, coat_normal_z_ws;  // unit
  shadow::SampleArray<float> sheen_r, sheen_g, sheen_b, sheen_roughness;
  shadow::SampleArray<float> anisotropy;  // strength
  shadow::SampleArray<float> along_x_ws, along_y_ws,
      along_z_ws;  // unit, across the normal: where highlights are long
  shadow::SampleArray<float> iridescence, film_thickness;  // nanometres
  shadow::SampleArray<float> transmission, thickness;      // metres
};

/// Fills `lobes`, of samples whose `points` are known, all of one surface that has lobes.
using FindLobePoints = void (*)(const PointSource& source, const frame::Surface& surface,
                                const shadow::SurfaceSamples& samples, const SurfacePoints& points,
                                LobePoints& lobes);
FindLobePoints find_lobe_points_for(InstructionSet set);

}  // namespace laterna::shade
