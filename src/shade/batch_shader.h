// A batch of samples of one surface, from where they lie to the radiance that they send to the eye: base colour, layers
// and photographs on it, ambient light, every light with its shadow, the environment.
#pragma once

#include <memory>
#include <span>

#include "shade/light_blender.h"
#include "shade/light_map_shader.h"
#include "shade/sample_batch.h"
#include "shade/scatter.h"
#include "shade/shader_job.h"
#include "shade/shading_clock.h"
#include "shade/tile_layers.h"

namespace laterna::shade {

/// What of the illumination is found: ambient light, a range of the lights, the environment where there is one.
struct IlluminationPart {
  bool ambient;
  std::size_t first_light, end_light;
  bool environment;
};

/// Buffers of one worker, reused from batch to batch.
class BatchShader {
 public:
  /// `layers` and `result` take what batches give beside radiance. All three outlive the shader.
  BatchShader(const ShaderJob& job, TileLayers& layers, TileResult& result);

  /// The batch: filled in by the caller, its ray excepted.
  [[nodiscard]] shadow::SurfaceSamples& samples() { return *samples_; }
  [[nodiscard]] const PointSource& source() const { return source_; }
  [[nodiscard]] ShadingClock& clock() { return clock_; }
  [[nodiscard]] const ShadingClock& clock() const { return clock_; }

  /// Of a pixel's samples, the one that batches are of from here on; layers are of the first.
  void start_sample(std::size_t sample) { sample_ = sample; }

  /// All samples of the batch, which lie on one surface. One target takes the sum; more take ambient, each light and the
  /// environment. Opaque batches give their layers, too.
  void shade(const frame::Surface& surface, std::span<const ColorTarget> targets,
             const IlluminationPart& part, bool is_opaque);
  /// How opaque the samples of the last batch are.
  [[nodiscard]] const float* alpha() const { return points_->alpha.data(); }

  /// Of any surface.
  [[nodiscard]] std::size_t most_layers() const { return most_layers_; }
  /// Passes::multi: layer number `pass` of the surface combined with the base colours that the passes before it left.
  void lay_pass(const frame::Surface& surface, std::size_t pass);
  /// Whether c_p of the slide algorithm is kept, light by light.
  [[nodiscard]] bool keeps_illumination() const;

 private:
  void find_ambient(const frame::Surface& surface);
  void reflect(const shadow::Arrival& arrival, float fill, bool add, Radiance& radiance);
  void reflect_environment(bool add);
  void blend_light(const ShaderLight& light, const shadow::Arrival& seen, bool sums,
                   std::span<const ColorTarget> targets, std::size_t index);
  void lay_layers(const frame::Surface& surface, bool is_opaque);
  void paint_photographs(bool is_opaque);
  [[nodiscard]] bool wants_arrival(bool is_opaque) const;
  void find_irradiance(const BoundLight& light);
  double find_arrival(const ShaderLight& light, bool of_all);
  void release_non_receivers();
  const shadow::Arrival& apply_tone(const ShadowTone& tone, std::size_t groups);
  void store_light_layers(std::size_t light, const shadow::Arrival& seen);
  void load_base_colors();

  const ShaderJob& job_;
  TileLayers& layers_;
  TileResult& result_;
  PointSource source_;
  FindSurfacePoints find_surface_points_;
  FindIrradiance find_irradiance_;
  FindAmbient find_ambient_;
  Reflect reflect_;
  ReflectEnvironment reflect_environment_;
  FindBounds find_bounds_;
  ScatterRadiance scatter_radiance_;

  std::size_t sample_ = 0;
  bool has_lights_to_leave_out_ = false;
  std::unique_ptr<shadow::SurfaceSamples> samples_;
  std::unique_ptr<SurfacePoints> points_;
  std::unique_ptr<Irradiance> irradiance_;
  std::unique_ptr<SlideCoordinates> coordinates_;
  std::unique_ptr<Radiance> radiance_;
  std::unique_ptr<shadow::Arrival> arrival_, seen_;
  std::unique_ptr<PhotographPainter> photographs_;  // null: there are none
  std::size_t most_layers_ = 0;
  std::unique_ptr<LayerPainter> layer_painter_;  // null: no surface has layers
  TileColor base_colors_;                        // of the tile's surfaces that have layers, with many passes
  std::unique_ptr<LightBlender> light_blender_;  // null: all lights add
  std::unique_ptr<LobeShader> lobe_shader_;      // null: no surface shows lobes
  LobeShader* lobes_ = nullptr;                  // of the batch; null: its surface has none
  std::unique_ptr<LightMapShader> light_map_shader_;  // null: no surface has a light map
  ShadingClock clock_;
};

}  // namespace laterna::shade
