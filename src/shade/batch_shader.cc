#include "shade/batch_shader.h"

#include <algorithm>

#include "shade/affine_slide.h"

namespace laterna::shade {

using shadow::kGroupSize;
using shadow::SurfaceSamples;

namespace {

bool does_not_add(const ShaderLight& light) { return light.open.has_value(); }
bool has_light_map(const frame::Surface& surface) { return surface.light_map.front.chain != nullptr; }

}  // namespace

BatchShader::BatchShader(const ShaderJob& job, TileLayers& layers, TileResult& result)
    : job_(job),
      layers_(layers),
      result_(result),
      source_{job.frame, job.view, job.interpolation, job.anisotropy},
      find_surface_points_(find_surface_points_for(job.instruction_set)),
      find_irradiance_(find_irradiance_for(job.instruction_set)),
      find_ambient_(find_ambient_for(job.instruction_set)),
      reflect_(reflect_for(job.instruction_set)),
      reflect_environment_(reflect_environment_for(job.instruction_set)),
      find_bounds_(find_bounds_for(job.instruction_set)),
      scatter_radiance_(scatter_radiance_for(job.instruction_set)),
      samples_(std::make_unique<SurfaceSamples>()),
      points_(std::make_unique<SurfacePoints>()),
      irradiance_(std::make_unique<Irradiance>()),
      coordinates_(std::make_unique<SlideCoordinates>()),
      radiance_(std::make_unique<Radiance>()),
      arrival_(std::make_unique<shadow::Arrival>()),
      seen_(std::make_unique<shadow::Arrival>()) {
  samples_->ray = job.view->homogeneous_ray();
  if (!job.photographs.photographs.empty()) {
    photographs_ =
        std::make_unique<PhotographPainter>(job.photographs, job.wanted.photographs, job.instruction_set);
  }
  for (const frame::Surface& surface : job.frame->surfaces)
    most_layers_ = std::max(most_layers_, surface.layers.size());
  if (most_layers_ > 0)
    layer_painter_ = std::make_unique<LayerPainter>(source_, job.decals, job.instruction_set);
  if (job.reflection.model == ShadingModel::pbr &&
      std::any_of(job.frame->surfaces.begin(), job.frame->surfaces.end(),
                  [](const frame::Surface& surface) { return surface.lobes != nullptr; }))
    lobe_shader_ = std::make_unique<LobeShader>(source_, job.lobes, job.instruction_set);
  if (std::any_of(job.frame->surfaces.begin(), job.frame->surfaces.end(), has_light_map))
    light_map_shader_ = std::make_unique<LightMapShader>(source_, job.reflection, job.instruction_set);
  if (std::any_of(job.lights.begin(), job.lights.end(), does_not_add))
    light_blender_ = std::make_unique<LightBlender>(job.instruction_set);
  has_lights_to_leave_out_ = std::any_of(job.lights.begin(), job.lights.end(), [](const ShaderLight& light) {
    return !light.reach.is_everywhere();
  });
}

void BatchShader::shade(const frame::Surface& surface, std::span<const ColorTarget> targets,
                        const IlluminationPart& part, bool is_opaque) {
  const bool sums = targets.size() == 1;
  const std::size_t groups = samples_->group_count;
  find_surface_points_(source_, surface, *samples_, *points_);
  lobes_ = surface.unlit || surface.lobes == nullptr ? nullptr : lobe_shader_.get();
  if (lobes_ != nullptr) lobes_->start(surface, *samples_, *points_);
  clock_.end_stage(Stage::surface);
  if (photographs_ != nullptr) paint_photographs(is_opaque);
  if (!surface.layers.empty()) lay_layers(surface, is_opaque);
  if (light_blender_ != nullptr)
    light_blender_->start(*samples_, targets.subspan(0, part.first_light == 0 ? 0 : part.first_light + 1));
  if (part.ambient) {
    find_ambient(surface);
    if (has_light_map(surface) && !surface.unlit)
      light_map_shader_->add(surface, *samples_, *points_, lobes_, *radiance_);
    if (is_opaque && sample_ == 0) layers_.store_geometry(*samples_, *points_);
    if (!sums) scatter_radiance_(*samples_, *radiance_, targets[0]);
  }
  // Where a light gives nothing, planes of the picture and of fragments are dark already.
  const bool may_leave_out = has_lights_to_leave_out_ && !wants_arrival(is_opaque) && !keeps_illumination();
  const frame::Bounds bounds = may_leave_out ? find_bounds_(*samples_) : frame::Bounds();
  for (std::size_t light = part.first_light; light < part.end_light; ++light) {
    if (surface.unlit && !wants_arrival(is_opaque)) continue;
    const ShaderLight& shader_light = job_.lights[light];
    if (may_leave_out && !shader_light.open && !shader_light.reach.touches(bounds)) continue;
    find_irradiance(shader_light.bound);
    clock_.end_stage(Stage::light);
    const double drawing_ms = find_arrival(shader_light, wants_arrival(is_opaque));
    clock_.end_stage(Stage::shadow, drawing_ms);
    const shadow::Arrival& seen = apply_tone(shader_light.tone, groups);
    if (is_opaque) store_light_layers(light, seen);
    if (surface.unlit) continue;
    if (light_blender_ != nullptr) {
      blend_light(shader_light, seen, sums, targets, light);
      continue;
    }
    reflect(seen, shader_light.tone.fill(), sums, *radiance_);
    if (!sums) scatter_radiance_(*samples_, *radiance_, targets[light + 1]);
  }
  if (part.environment && !surface.unlit) {
    reflect_environment(sums);
    if (!sums) scatter_radiance_(*samples_, *radiance_, targets.back());
  }
  if (sums) scatter_radiance_(*samples_, *radiance_, targets[0]);
  clock_.end_stage(Stage::light);
}

void BatchShader::find_ambient(const frame::Surface& surface) {
  if (lobes_ != nullptr) return lobes_->find_ambient(job_.reflection, *radiance_);
  find_ambient_(job_.reflection, surface, samples_->group_count, *points_, *radiance_);
}

void BatchShader::reflect(const shadow::Arrival& arrival, float fill, bool add, Radiance& radiance) {
  if (lobes_ != nullptr) return lobes_->reflect(*irradiance_, arrival, fill, add, radiance);
  reflect_(job_.reflection, samples_->group_count, *points_, *irradiance_, arrival, fill, add, radiance);
}

void BatchShader::reflect_environment(bool add) {
  if (lobes_ != nullptr) return lobes_->reflect_environment(*job_.environment, add, *radiance_);
  reflect_environment_(*job_.environment, job_.reflection, *samples_, *points_, add, *radiance_);
}

// Light that meets light of other modes than add.
void BatchShader::blend_light(const ShaderLight& light, const shadow::Arrival& seen, bool sums,
                              std::span<const ColorTarget> targets, std::size_t index) {
  const std::size_t groups = samples_->group_count;
  Radiance& change = light_blender_->change();
  reflect(seen, light.tone.fill(), false, change);
  if (light.open) {
    find_irradiance(*light.open);
    reflect(light_blender_->unhindered(), 0, false, light_blender_->open());
    light_blender_->blend(light.open->light->blend, groups);
  } else {
    light_blender_->add(groups);
  }
  if (sums) {
    add(*radiance_, change, groups);
  } else {
    scatter_radiance_(*samples_, change, targets[index + 1]);
  }
}

// Layers of the surface on its base colour; in many passes they are there already.
void BatchShader::lay_layers(const frame::Surface& surface, bool is_opaque) {
  if (job_.passes == Passes::multi && is_opaque) return load_base_colors();
  double drawing_ms = 0;
  for (const frame::LayerBinding& layer : surface.layers)
    drawing_ms += layer_painter_->paint(surface, layer, *samples_, *points_);
  clock_.add_drawing(drawing_ms);
  clock_.end_stage(Stage::surface, drawing_ms);
}

// Base colours from photographs.
void BatchShader::paint_photographs(bool is_opaque) {
  const double drawing_ms = photographs_->paint(*samples_, *points_);
  clock_.add_drawing(drawing_ms);
  if (is_opaque && sample_ == 0 && job_.wanted.photographs)
    layers_.store_photographs(*samples_, *photographs_);
  clock_.end_stage(Stage::surface, drawing_ms);
}

bool BatchShader::wants_arrival(bool is_opaque) const {
  return is_opaque &&
         (job_.wanted.visibility || job_.wanted.lux || job_.wanted.slide_uv || job_.wanted.pixel_density);
}

void BatchShader::find_irradiance(const BoundLight& light) {
  const SlideCoordinates* coordinates = nullptr;
  if (job_.interpolation == Interpolation::affine && light.light->type == LightType::projector) {
    find_affine_slide_coordinates(light, source_, *samples_, *coordinates_);
    coordinates = coordinates_.get();
  }
  find_irradiance_(light, *samples_, *points_, coordinates, *irradiance_);
  if (lobes_ != nullptr) lobes_->widen(*irradiance_);
}

// Of the lit samples, or of all where a layer shows it. Returns what ShadowTechnique::find_arrival does.
double BatchShader::find_arrival(const ShaderLight& light, bool of_all) {
  const std::size_t groups = samples_->group_count;
  const std::span wanted(of_all ? samples_->active : irradiance_->lit);
  if (light.shadow == nullptr) {
    arrival_->alpha.fill(1);
    arrival_->is_tinted = false;
    return 0;
  }
  const double drawing_ms = light.shadow->find_arrival(*samples_, wanted.first(groups), *arrival_);
  clock_.add_drawing(drawing_ms);
  if (!job_.frame->all_receive_shadows) release_non_receivers();
  return drawing_ms;
}

// Objects that receive no shadow are fully lit.
void BatchShader::release_non_receivers() {
  const SurfaceSamples& s = *samples_;
  for (std::size_t first = 0; first < s.group_count * kGroupSize; first += kGroupSize) {
    std::uint32_t all_flags = kReceivesShadow;
    TriangleId last = kNoTriangle;
    for (std::size_t i = first; i < first + kGroupSize; ++i) {
      if (s.id[i] == last) continue;
      last = s.id[i];
      all_flags &= job_.frame->clusters[cluster_of(last)].flags;
    }
    if (all_flags != 0) continue;
    for (std::size_t i = first; i < first + kGroupSize; ++i) {
      if ((job_.frame->clusters[cluster_of(s.id[i])].flags & kReceivesShadow) != 0) continue;
      for (shadow::SampleArray<float>* share : {&arrival_->alpha, &arrival_->r, &arrival_->g, &arrival_->b}) {
        (*share)[i] = 1;
      }
    }
  }
}

const shadow::Arrival& BatchShader::apply_tone(const ShadowTone& tone, std::size_t groups) {
  if (tone.is_physical()) return *arrival_;
  tone.apply(*arrival_, groups, *seen_);
  return *seen_;
}

// Layers that measure show what arrives; the papers' frame buffer is a picture, and shows what is `seen` to.
void BatchShader::store_light_layers(std::size_t light, const shadow::Arrival& seen) {
  const SurfaceSamples& s = *samples_;
  const WantedLayers& wanted = job_.wanted;
  if (wanted.visibility) layers_.add_visibility(light, s, *arrival_);
  if (wanted.slide_uv && sample_ == 0 && job_.lights[light].bound.light->type == LightType::projector) {
    layers_.store_slide_coordinates(light, s, *irradiance_);
  }
  if (keeps_illumination() && !job_.lights[light].open) {
    TileLayers::add_illumination(s, *irradiance_, seen, result_.pass_illumination[light]);
  }
  if (wanted.pixel_density && sample_ == 0) layers_.store_pixel_density(light, s);
  if (!wanted.lux || job_.lights[light].open) return;
  if (!job_.physical_lights.empty()) find_irradiance(job_.physical_lights[light]);
  layers_.add_lux(s, *irradiance_, *arrival_);
  if (!job_.physical_lights.empty()) find_irradiance(job_.lights[light].bound);
}

// Several textures on one primitive, the old way (MIT 6.837, lecture 20, slide 17): every polygon is scan-converted
// again for each layer, whose pass combines it with the base colour that the passes before have left in the frame
// buffer base_colors_.
void BatchShader::lay_pass(const frame::Surface& surface, std::size_t pass) {
  find_surface_points_(source_, surface, *samples_, *points_);
  if (pass > 0) {
    load_base_colors();
  } else if (photographs_ != nullptr) {
    paint_photographs(false);
  }
  clock_.add_drawing(layer_painter_->paint(surface, surface.layers[pass], *samples_, *points_));
  scatter(*samples_, points_->base_r.data(), base_colors_.r.data());
  scatter(*samples_, points_->base_g.data(), base_colors_.g.data());
  scatter(*samples_, points_->base_b.data(), base_colors_.b.data());
}

void BatchShader::load_base_colors() {
  for_each_sample(*samples_, samples_->active, [&](std::size_t i) {
    const std::uint32_t pixel = samples_->pixel[i];
    points_->base_r[i] = base_colors_.r[pixel];
    points_->base_g[i] = base_colors_.g[pixel];
    points_->base_b[i] = base_colors_.b[pixel];
  });
}

bool BatchShader::keeps_illumination() const {
  return job_.wanted.passes && job_.reflection.model == ShadingModel::papers && sample_ == 0;
}

}  // namespace laterna::shade
