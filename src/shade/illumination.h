// Light at surface points: what arrives unhindered, and what of it a surface sends to the eye.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "frame/frame.h"
#include "laterna/shading.h"
#include "shade/bound_lens.h"
#include "shade/surface_points.h"
#include "shadow/projected_view.h"
#include "shadow/shadow_technique.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// A light bound to the rays of the samples it will shine on. What the kernels read.
struct BoundLight {
  const Light* light = nullptr;
  float color[3];  // linear colour × candela (lamps: of their peak) or lux; papers: colour alone
  float position_ws[3];
  float forward_ws[3];                    // along the light's axis, away from it
  float cone_scale = 0, cone_offset = 1;  // KHR_lights_punctual's angular term
  float inverse_range = 0;                // 0: unlimited
  bool is_papers = false;

  // Measured lamps.
  const frame::LampTable* lamp = nullptr;
  float right_ws[3], up_ws[3];

  // Projectors.
  // (s, t), (0, 0) the top-left corner of the slide, or of the image of the beam that a distorting lens throws.
  shadow::ProjectedView slide_position;
  std::optional<BoundLens> lens;
  shadow::ProjectedRow homogeneous;
  bool is_orthographic = false;
  bool is_flat_field = true;
  const image::MipChain* slide = nullptr;
  float black_level = 0;  // of the slide
  Sampler slide_sampler;
  int anisotropy = 1;
  // Out of focus (Aperture): at distance d along the axis a point of the slide is a disc whose radii are these times
  // |inverse_focus − 1/d|, in units of the slide's sides; 0: in focus everywhere.
  float blur_s = 0, blur_t = 0, inverse_focus = 0;

  BoundLight(const frame::PlacedLight& placed, const raster::RasterView::Ray& ray, ShadingModel model,
             int anisotropy);
};

/// The same projector with neither slide nor colour before its lamp.
BoundLight with_open_gate(BoundLight projector, const frame::PlacedLight& placed);

/// Light arriving at samples if nothing stood in its way.
struct Irradiance {
  /// On a surface square to the light, per colour: lux in photometric units. 0 where the light does not shine.
  shadow::SampleArray<float> r, g, b;
  shadow::SampleArray<float> to_light_x_ws, to_light_y_ws, to_light_z_ws;  // unit
  shadow::SampleArray<float> cosine;  // n·l of the shading normal; papers: 1
  /// Samples on which the light shines and that face it: those whose shadow must be known.
  std::array<std::uint16_t, shadow::kMaxGroups> lit{};
  /// Slide coordinates, for the layer uv.<light>; NaN outside the frame. Only where asked for.
  shadow::SampleArray<float> slide_s, slide_t;
};

/// Overrides for slide coordinates (affine interpolation); null: equation 6.
struct SlideCoordinates {
  shadow::SampleArray<float> s, t;
  std::array<std::uint16_t, shadow::kMaxGroups> valid{};
};

using FindIrradiance = void (*)(const BoundLight& light, const shadow::SurfaceSamples& samples,
                                const SurfacePoints& points, const SlideCoordinates* coordinates,
                                Irradiance& irradiance);
FindIrradiance find_irradiance_for(InstructionSet set);

/// How surfaces answer.
struct ReflectionSettings {
  ShadingModel model = ShadingModel::pbr;
  std::optional<PhongHighlight> phong;
  float ambient[3] = {0, 0, 0};
};

/// Radiance toward the eye, per sample.
struct Radiance {
  shadow::SampleArray<float> r, g, b;
};

/// What needs no light: ambient light on the base colour, what the surface emits, unlit colour.
using FindAmbient = void (*)(const ReflectionSettings& settings, const frame::Surface& surface,
                             std::size_t groups, const SurfacePoints& points, Radiance& radiance);
FindAmbient find_ambient_for(InstructionSet set);

/// One light's part, by what arrives: added to `radiance`, or in its place. Samples that are not lit get 0. `fill`: of
/// what does not arrive this much is reflected diffusely all the same (ShadowSettings::fill).
using Reflect = void (*)(const ReflectionSettings& settings, std::size_t groups, const SurfacePoints& points,
                         const Irradiance& irradiance, const shadow::Arrival& arrival, float fill, bool add,
                         Radiance& radiance);
Reflect reflect_for(InstructionSet set);

}  // namespace laterna::shade
