#include "shade/tile_shader.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "shade/affine_slide.h"
#include "shade/fragment_list.h"
#include "shade/light_blender.h"
#include "shade/light_map.h"
#include "shade/relief_cut.h"
#include "shade/sample_batch.h"
#include "shade/scatter.h"
#include "shade/surface_groups.h"

namespace laterna::shade {

using raster::kTilePixels;
using shadow::kGroupSize;
using shadow::kMaxGroups;
using shadow::SurfaceSamples;

namespace {

ColorTarget target_of(TileColor& color) { return {color.r.data(), color.g.data(), color.b.data()}; }

void fill(TileColor& color, float r, float g, float b) {
  color.r.fill(r);
  color.g.fill(g);
  color.b.fill(b);
}

void add(TilePlane& sum, const TilePlane& part) {
  for (std::size_t i = 0; i < kTilePixels; ++i) sum[i] += part[i];
}
void add(TileColor& sum, const TileColor& part) {
  add(sum.r, part.r);
  add(sum.g, part.g);
  add(sum.b, part.b);
}
void scale(TilePlane& plane, float factor) {
  for (float& value : plane) value *= factor;
}
void scale(TileColor& color, float factor) {
  scale(color.r, factor);
  scale(color.g, factor);
  scale(color.b, factor);
}

bool does_not_add(const ShaderLight& light) { return light.open.has_value(); }

}  // namespace

class TileShader::Worker {
 public:
  explicit Worker(const ShaderJob& job)
      : job_(job),
        offsets_(sample_offsets(job.samples_per_pixel, job.jitter)),
        source_{job.frame, job.view, job.interpolation, job.anisotropy},
        cut_(source_, job.instruction_set),
        rasterise_visibility_(raster::rasterise_visibility_for(job.instruction_set)),
        rasterise_fragments_(raster::rasterise_fragments_for(job.instruction_set)),
        find_surface_points_(find_surface_points_for(job.instruction_set)),
        find_irradiance_(find_irradiance_for(job.instruction_set)),
        find_ambient_(find_ambient_for(job.instruction_set)),
        add_light_map_(add_light_map_for(job.instruction_set)),
        reflect_(reflect_for(job.instruction_set)),
        reflect_environment_(reflect_environment_for(job.instruction_set)),
        show_environment_(show_environment_for(job.instruction_set)),
        pixel_rays_(*job.view),
        fill_from_blocks_(fill_from_blocks_for(job.instruction_set)),
        find_bounds_(find_bounds_for(job.instruction_set)),
        scatter_radiance_(scatter_radiance_for(job.instruction_set)),
        groups_(*job.frame),
        samples_(std::make_unique<SurfaceSamples>()),
        points_(std::make_unique<SurfacePoints>()),
        irradiance_(std::make_unique<Irradiance>()),
        coordinates_(std::make_unique<SlideCoordinates>()),
        radiance_(std::make_unique<Radiance>()),
        arrival_(std::make_unique<shadow::Arrival>()),
        seen_(std::make_unique<shadow::Arrival>()),
        layers_(*job.frame, *job.view, job.wanted, result_) {
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
    if (!job.mirrors.mirror_of_cluster.empty())
      mirror_shader_ = std::make_unique<MirrorShader>(job.mirrors, *job.view);
    if (std::any_of(job.lights.begin(), job.lights.end(), does_not_add))
      light_blender_ = std::make_unique<LightBlender>(job.instruction_set);
    has_lights_to_leave_out_ =
        std::any_of(job.lights.begin(), job.lights.end(),
                    [](const ShaderLight& light) { return !light.reach.is_everywhere(); });
  }

  const TileResult& shade(int tile_x, int tile_y) {
    tile_x_ = tile_x;
    tile_y_ = tile_y;
    is_timed_ = (tile_x + 3 * tile_y) % kTilesPerTimed == 0 || shading_stages_.total() == 0;
    watch_.start();
    for (std::size_t sample = 0; sample < offsets_.size(); ++sample) {
      sample_ = sample;
      rasterise();
      raster_ms_ += watch_.lap_ms();
      if (is_timed_) stage_watch_.start();
      shade_sample();
      shade_ms_ += watch_.lap_ms();
    }
    finish();
    shade_ms_ += watch_.lap_ms();
    return result_;
  }

  [[nodiscard]] StageTimes times() const {
    StageTimes times = shading_stages_.share_out(shade_ms_ - map_ms_);
    times[Stage::raster] = raster_ms_;
    return times;
  }
  [[nodiscard]] double map_ms() const { return map_ms_; }

 private:
  // Reading the clock for every batch and light would cost some per cent: it is done in one tile of so many.
  static constexpr int kTilesPerTimed = 8;

  // `elsewhere_ms`: of the lap, what is accounted for elsewhere.
  void end_stage(Stage stage, double elsewhere_ms = 0) {
    if (is_timed_) shading_stages_[stage] += stage_watch_.lap_ms() - elsewhere_ms;
  }

  // -------------------------------------------------------------------------------------------- one sample per pixel

  void rasterise() {
    task_ = {job_.view, job_.batches, tile_x_, tile_y_, offsets_[sample_].x, offsets_[sample_].y, &cut_};
    depth_.fill(job_.view->reversed_far);
    ids_.fill(kNoTriangle);
    rasterise_visibility_(task_, depth_.data(), ids_.data());
    fragments_.clear();
    if (job_.frame->has_blending) rasterise_fragments_(task_, depth_.data(), fragments_.list());
    fragments_.sort();
  }

  // Whether light by light radiance must be kept: asked for, or needed because the picture is put together from more
  // than one surface or sample per pixel. Beauty is then the sum of the planes in the lights' order, which is what it
  // is without them: the picture does not depend on which layers are asked for.
  [[nodiscard]] bool keeps_planes() const {
    return job_.wanted.lights || offsets_.size() > 1 || !fragments_.is_empty() || job_.frame->has_mirrors;
  }

  // Ambient, each light, the environment where there is one; what mirrors show comes after them.
  [[nodiscard]] std::size_t shaded_planes() const { return job_.lights.size() + (job_.environment ? 2 : 1); }
  // Without the plane of what mirrors show.
  [[nodiscard]] std::span<const ColorTarget> shaded(std::span<const ColorTarget> targets) const {
    return targets.first(std::min(targets.size(), shaded_planes()));
  }

  void shade_sample() {
    const bool has_planes = keeps_planes();
    planes_.resize(has_planes ? shaded_planes() + (job_.frame->has_mirrors ? 1 : 0) : 0);
    const std::span<TileColor> planes = has_planes ? std::span(planes_) : std::span(&result_.beauty, 1);
    const glm::vec3 background = job_.background != nullptr ? *job_.background : glm::vec3(0);
    std::vector<ColorTarget> targets;
    for (TileColor& plane : planes) {
      const glm::vec3 start = targets.empty() ? background : glm::vec3(0);
      fill(plane, start.r, start.g, start.b);
      targets.push_back(target_of(plane));
    }
    if (sample_ == 0) layers_.start_tile();
    if (job_.passes == Passes::multi) {
      shade_in_passes(shaded(targets));
    } else {
      shade_visible(shaded(targets), everything());
    }
    if (shows_environment()) show_environment(shaded(targets).back());
    if (mirror_shader_ != nullptr) reflect_in_mirrors();
    find_coverage();
    if (!fragments_.is_empty()) blend_fragments();
    accumulate(has_planes);
    end_stage(Stage::light);
  }

  [[nodiscard]] TileOrigin origin() const {
    const SampleOffset& offset = offsets_[sample_];
    return {*job_.frame, *job_.view, tile_x_, tile_y_, offset.x, offset.y};
  }

  // What of the illumination is found: ambient light, a range of the lights, the environment where there is one.
  struct Part {
    bool ambient;
    std::size_t first_light, end_light;
    bool environment;
  };
  [[nodiscard]] Part everything() const {
    return {true, 0, job_.lights.size(), job_.environment.has_value()};
  }

  void shade_visible(std::span<const ColorTarget> targets, const Part& part) {
    for_each_visible_batch([&](const frame::Surface& surface) { shade_batch(surface, targets, part, true); });
  }

  // Calls `use` with samples_ filled in, all of that surface.
  template <class Use>
  void for_each_visible_batch(Use use) {
    groups_.collect(ids_);
    for (const SurfaceGroups::Group& group : groups_.groups()) {
      for (std::size_t first = 0; first < group.blocks.size(); first += kMaxGroups) {
        const std::size_t count = std::min(kMaxGroups, group.blocks.size() - first);
        fill_from_blocks_(origin(), std::span(group.blocks).subspan(first, count), depth_.data(), ids_.data(),
                          *samples_);
        use(job_.frame->surfaces[group.surface]);
      }
    }
  }

  // Several textures on one primitive, the old way (MIT 6.837, lecture 20, slide 17): every polygon is scan-converted
  // again for each layer, whose pass combines it with the base colour that the passes before have left in the frame
  // buffer base_colors_.
  void lay_in_passes() {
    for (std::size_t pass = 0; pass < most_layers_; ++pass) {
      scan_convert_again();
      for_each_visible_batch([&](const frame::Surface& surface) {
        if (pass >= surface.layers.size()) return;
        find_surface_points_(source_, surface, *samples_, *points_);
        if (pass > 0) {
          load_base_colors();
        } else if (photographs_ != nullptr) {
          paint_photographs(false);
        }
        map_ms_ += layer_painter_->paint(surface.layers[pass], *samples_, *points_);
        scatter(*samples_, points_->base_r.data(), base_colors_.r.data());
        scatter(*samples_, points_->base_g.data(), base_colors_.g.data());
        scatter(*samples_, points_->base_b.data(), base_colors_.b.data());
      });
    }
  }

  void load_base_colors() {
    for_each_sample(*samples_, samples_->active, [&](std::size_t i) {
      const std::uint32_t pixel = samples_->pixel[i];
      points_->base_r[i] = base_colors_.r[pixel];
      points_->base_g[i] = base_colors_.g[pixel];
      points_->base_b[i] = base_colors_.b[pixel];
    });
  }

  // Segal et al. 1992, sections 3.1 and 3.3. Pass 1, hidden surface removal, has left z_p in depth_; c_p starts as the
  // ambient image. For each light, every polygon is scan-converted again with the test z = z_p: pass 2 finds α_p and
  // the colour c_τ that the slide throws, pass 3 adds c · c_τ · α_p to c_p. (Section 3.1 multiplies the sum over the
  // slides by c once, at the end; multiplied slide by slide it is the same number, and what each light gives stays
  // its own layer.)
  void shade_in_passes(std::span<const ColorTarget> targets) {
    lay_in_passes();
    shade_visible(targets, {true, 0, 0, false});
    keep_pass(0);
    for (std::size_t light = 0; light < job_.lights.size(); ++light) {
      scan_convert_again();
      start_illumination_pass(light);
      shade_visible(targets, {false, light, light + 1, false});
      keep_pass(light + 1);
    }
    if (job_.environment) shade_visible(targets, {false, 0, 0, true});
  }

  // The triangles whose depth equals z_p: at equal depth any triangle beats none.
  void scan_convert_again() {
    ids_.fill(kNoTriangle);
    rasterise_visibility_(task_, depth_.data(), ids_.data());
  }

  // c_p as it is after ambient light (0) or light number `pass`.
  void keep_pass(std::size_t pass) {
    if (!job_.wanted.passes || sample_ != 0) return;
    result_.pass_colors.resize(job_.lights.size() + 1);
    if (pass == 0) {
      result_.pass_colors[0] = planes_[0];
      return;
    }
    result_.pass_colors[pass] = result_.pass_colors[pass - 1];
    add(result_.pass_colors[pass], planes_[pass]);
  }

  // c_p before pass 2 of a light: ambient light, or what the slides before it have made of it.
  void start_illumination_pass(std::size_t light) {
    if (!keeps_illumination()) return;
    std::vector<TileColor>& passes = result_.pass_illumination;
    passes.resize(job_.lights.size());
    if (light > 0) {
      passes[light] = passes[light - 1];
    } else {
      const float* ambient = job_.reflection.ambient;
      fill(passes[0], ambient[0], ambient[1], ambient[2]);
    }
  }

  [[nodiscard]] bool keeps_illumination() const {
    return job_.wanted.passes && job_.reflection.model == ShadingModel::papers && sample_ == 0;
  }

  // -------------------------------------------------------------------------------------------- one batch of samples

  // All samples of samples_, which lie on one surface. One target takes the sum; more take ambient, each light and the
  // environment.
  void shade_batch(const frame::Surface& surface, std::span<const ColorTarget> targets, const Part& part,
                   bool is_opaque) {
    const bool sums = targets.size() == 1;
    const std::size_t groups = samples_->group_count;
    find_surface_points_(source_, surface, *samples_, *points_);
    lobes_ = surface.unlit || surface.lobes == nullptr ? nullptr : lobe_shader_.get();
    if (lobes_ != nullptr) lobes_->start(surface, *samples_, *points_);
    end_stage(Stage::surface);
    if (photographs_ != nullptr) paint_photographs(is_opaque);
    if (!surface.layers.empty()) lay_layers(surface, is_opaque);
    if (light_blender_ != nullptr)
      light_blender_->start(*samples_, targets.subspan(0, part.first_light == 0 ? 0 : part.first_light + 1));
    if (part.ambient) {
      find_ambient(surface);
      if (surface.light_map.front.chain != nullptr && !surface.unlit)
        add_light_map_(source_, job_.reflection, surface.light_map, *samples_, *points_, *radiance_);
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
      end_stage(Stage::light);
      const double drawing_ms = find_arrival(shader_light, wants_arrival(is_opaque));
      end_stage(Stage::shadow, drawing_ms);
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
    end_stage(Stage::light);
  }

  void find_ambient(const frame::Surface& surface) {
    if (lobes_ != nullptr) return lobes_->find_ambient(job_.reflection, *radiance_);
    find_ambient_(job_.reflection, surface, samples_->group_count, *points_, *radiance_);
  }

  void reflect(const shadow::Arrival& arrival, float fill, bool add, Radiance& radiance) {
    if (lobes_ != nullptr) return lobes_->reflect(*irradiance_, arrival, fill, add, radiance);
    reflect_(job_.reflection, samples_->group_count, *points_, *irradiance_, arrival, fill, add, radiance);
  }

  void reflect_environment(bool add) {
    if (lobes_ != nullptr) return lobes_->reflect_environment(*job_.environment, add, *radiance_);
    reflect_environment_(*job_.environment, job_.reflection, *samples_, *points_, add, *radiance_);
  }

  // Light that meets light of other modes than add.
  void blend_light(const ShaderLight& light, const shadow::Arrival& seen, bool sums,
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
  void lay_layers(const frame::Surface& surface, bool is_opaque) {
    if (job_.passes == Passes::multi && is_opaque) return load_base_colors();
    double drawing_ms = 0;
    for (const frame::LayerBinding& layer : surface.layers)
      drawing_ms += layer_painter_->paint(layer, *samples_, *points_);
    map_ms_ += drawing_ms;
    end_stage(Stage::surface, drawing_ms);
  }

  // -------------------------------------------------------------------------------------------- environment

  [[nodiscard]] bool shows_environment() const { return job_.environment && job_.environment->is_visible; }

  // Where nothing is before it.
  void show_environment(const ColorTarget& target) {
    const TileOrigin from = origin();
    for (std::size_t block = 0; block < kTilePixels / kGroupSize; ++block) {
      const std::size_t first = block * kGroupSize;
      const TriangleId* ids = ids_.data() + first;
      if (std::all_of(ids, ids + kGroupSize, [](TriangleId id) { return id != kNoTriangle; })) continue;
      const auto column = block % raster::kBlocksPerSide, row = block / raster::kBlocksPerSide;
      alignas(64) float x[kGroupSize], y[kGroupSize], r[kGroupSize], g[kGroupSize], b[kGroupSize];
      for (std::size_t i = 0; i < kGroupSize; ++i) {
        x[i] = from.x + static_cast<float>(column * 4 + (i & 3U));
        y[i] = from.y + static_cast<float>(row * 4 + (i >> 2U));
      }
      show_environment_(*job_.environment, pixel_rays_, x, y, r, g, b);
      for (std::size_t i = 0; i < kGroupSize; ++i) {
        if (ids[i] != kNoTriangle) continue;
        target.r[first + i] = r[i];
        target.g[first + i] = g[i];
        target.b[first + i] = b[i];
      }
    }
  }

  // -------------------------------------------------------------------------------------------- mirrors

  // A pixel of the tile, at the sample that is being shaded.
  [[nodiscard]] MirrorSample mirror_sample(std::uint32_t pixel, float q) const {
    const std::uint32_t block = pixel / kGroupSize, within = pixel % kGroupSize;
    const auto x = static_cast<int>(block % raster::kBlocksPerSide * raster::kBlockSide + (within & 3U));
    const auto y = static_cast<int>(block / raster::kBlocksPerSide * raster::kBlockSide + (within >> 2U));
    const TileOrigin from = origin();
    return {tile_x_ * raster::kTileSide + x, tile_y_ * raster::kTileSide + y, from.x + static_cast<float>(x),
            from.y + static_cast<float>(y), q};
  }

  static void weigh(TileColor& plane, std::size_t pixel, const glm::vec3& weight) {
    plane.r[pixel] *= weight.r;
    plane.g[pixel] *= weight.g;
    plane.b[pixel] *= weight.b;
  }

  // What opaque mirrors show, over what their surfaces show themselves.
  void reflect_in_mirrors() {
    for (std::uint32_t i = 0; i < kTilePixels; ++i) {
      const MirrorPicture* picture = ids_[i] == kNoTriangle ? nullptr : mirror_shader_->picture_of(ids_[i]);
      if (picture == nullptr) continue;
      const Mirroring seen = mirror_shader_->reflect(*picture, mirror_sample(i, depth_[i]));
      for (std::size_t plane = 0; plane < shaded_planes(); ++plane)
        weigh(planes_[plane], i, 1.0F - seen.share);
      planes_.back().r[i] = seen.share.r * seen.radiance.r;
      planes_.back().g[i] = seen.share.g * seen.radiance.g;
      planes_.back().b[i] = seen.share.b * seen.radiance.b;
    }
  }

  // The same for a fragment that blends: what it lets through and its own surface share what is not mirrored.
  void reflect_in_fragment(const raster::Fragment& fragment) {
    const MirrorPicture* picture = mirror_shader_->picture_of(fragment.id);
    if (picture == nullptr) return;
    const Mirroring seen =
        mirror_shader_->reflect(*picture, mirror_sample(fragment.pixel, fragment.reversed_depth));
    for (TileColor& plane : planes_) weigh(plane, fragment.pixel, 1.0F - seen.share);
    planes_.back().r[fragment.pixel] += seen.share.r * seen.radiance.r;
    planes_.back().g[fragment.pixel] += seen.share.g * seen.radiance.g;
    planes_.back().b[fragment.pixel] += seen.share.b * seen.radiance.b;
    const float most = std::max({seen.share.r, seen.share.g, seen.share.b});
    coverage_[fragment.pixel] = coverage_[fragment.pixel] * (1 - most) + most;
  }

  // Base colours from photographs.
  void paint_photographs(bool is_opaque) {
    const double drawing_ms = photographs_->paint(*samples_, *points_);
    map_ms_ += drawing_ms;
    if (is_opaque && sample_ == 0 && job_.wanted.photographs)
      layers_.store_photographs(*samples_, *photographs_);
    end_stage(Stage::surface, drawing_ms);
  }

  [[nodiscard]] bool wants_arrival(bool is_opaque) const {
    return is_opaque &&
           (job_.wanted.visibility || job_.wanted.lux || job_.wanted.slide_uv || job_.wanted.pixel_density);
  }

  void find_irradiance(const BoundLight& light) {
    const SlideCoordinates* coordinates = nullptr;
    if (job_.interpolation == Interpolation::affine && light.light->type == LightType::projector) {
      find_affine_slide_coordinates(light, source_, *samples_, *coordinates_);
      coordinates = coordinates_.get();
    }
    find_irradiance_(light, *samples_, *points_, coordinates, *irradiance_);
    if (lobes_ != nullptr) lobes_->widen(*irradiance_);
  }

  // Of the lit samples, or of all where a layer shows it. Returns what ShadowTechnique::find_arrival does.
  double find_arrival(const ShaderLight& light, bool of_all) {
    const std::size_t groups = samples_->group_count;
    const std::span wanted(of_all ? samples_->active : irradiance_->lit);
    if (light.shadow == nullptr) {
      arrival_->alpha.fill(1);
      arrival_->is_tinted = false;
      return 0;
    }
    const double drawing_ms = light.shadow->find_arrival(*samples_, wanted.first(groups), *arrival_);
    map_ms_ += drawing_ms;
    if (!job_.frame->all_receive_shadows) release_non_receivers();
    return drawing_ms;
  }

  // Objects that receive no shadow are fully lit.
  void release_non_receivers() {
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
        for (shadow::SampleArray<float>* share :
             {&arrival_->alpha, &arrival_->r, &arrival_->g, &arrival_->b}) {
          (*share)[i] = 1;
        }
      }
    }
  }

  const shadow::Arrival& apply_tone(const ShadowTone& tone, std::size_t groups) {
    if (tone.is_physical()) return *arrival_;
    tone.apply(*arrival_, groups, *seen_);
    return *seen_;
  }

  // -------------------------------------------------------------------------------------------- blending

  // Back to front over the opaque surface, each of the planes by itself: what a light sends through a pane of glass
  // stays that light's.
  void blend_fragments() {
    const std::size_t count = fragments_.list().size();
    fragment_values_.assign(count * (3 * planes_.size() + 1) + kGroupSize, 0.0F);
    std::vector<ColorTarget> targets;
    for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
      float* first = fragment_values_.data() + count * 3 * plane;
      targets.push_back({first, first + count, first + 2 * count});
    }
    float* alpha = fragment_values_.data() + count * 3 * planes_.size();
    for (const FragmentList::Run& run : fragments_.by_surface(*job_.frame)) {
      for (std::size_t first = 0; first < run.fragments.size(); first += shadow::kMaxSamples) {
        const std::size_t size = std::min(shadow::kMaxSamples, run.fragments.size() - first);
        fill_from_fragments(origin(), fragments_.list(), run.fragments.subspan(first, size), *samples_);
        shade_batch(job_.frame->surfaces[run.surface], shaded(targets), everything(), false);
        scatter(*samples_, points_->alpha.data(), alpha);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t pixel = fragments_.list()[i].pixel;
      const float a = alpha[i];
      const auto over = [&](float& below, float value) { below = below * (1 - a) + value * a; };
      for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
        over(planes_[plane].r[pixel], targets[plane].r[i]);
        over(planes_[plane].g[pixel], targets[plane].g[i]);
        over(planes_[plane].b[pixel], targets[plane].b[i]);
      }
      over(coverage_[pixel], 1);
      if (mirror_shader_ != nullptr) reflect_in_fragment(fragments_.list()[i]);
    }
  }

  // -------------------------------------------------------------------------------------------- layers

  void find_coverage() {
    const bool is_all_covered = job_.background != nullptr || shows_environment();
    for (std::size_t i = 0; i < kTilePixels; ++i)
      coverage_[i] = ids_[i] == kNoTriangle && !is_all_covered ? 0.0F : 1.0F;
  }

  // Layers that measure show what arrives; the papers' frame buffer is a picture, and shows what is `seen` to.
  void store_light_layers(std::size_t light, const shadow::Arrival& seen) {
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

  // Adds this sample's planes to the pixel's.
  void accumulate(bool has_planes) {
    if (!has_planes) {
      result_.radiance.clear();  // one sample, and it is the pixel: shading has written beauty itself
      result_.alpha = coverage_;
      return;
    }
    if (sample_ == 0) {
      result_.radiance.resize(planes_.size());
      std::copy(planes_.begin(), planes_.end(), result_.radiance.begin());
      result_.alpha = coverage_;
      return;
    }
    for (std::size_t i = 0; i < planes_.size(); ++i) add(result_.radiance[i], planes_[i]);
    add(result_.alpha, coverage_);
  }

  void finish() {
    if (result_.radiance.empty()) return;
    // The number of samples is a power of two: the mean is exact.
    const float share = 1.0F / static_cast<float>(offsets_.size());
    if (offsets_.size() > 1) {
      for (TileColor& plane : result_.radiance) scale(plane, share);
      for (TilePlane& plane : result_.visibility) scale(plane, share);
      if (job_.wanted.lux) scale(result_.lux, share);
      scale(result_.alpha, share);
    }
    result_.beauty = result_.radiance[0];
    for (std::size_t i = 1; i < result_.radiance.size(); ++i) add(result_.beauty, result_.radiance[i]);
  }

  const ShaderJob& job_;
  std::vector<SampleOffset> offsets_;
  PointSource source_;
  ReliefCut cut_;
  raster::RasteriseVisibility rasterise_visibility_;
  raster::RasteriseFragments rasterise_fragments_;
  FindSurfacePoints find_surface_points_;
  FindIrradiance find_irradiance_;
  FindAmbient find_ambient_;
  AddLightMap add_light_map_;
  Reflect reflect_;
  ReflectEnvironment reflect_environment_;
  ShowEnvironment show_environment_;
  PixelRays pixel_rays_;
  FillFromBlocks fill_from_blocks_;
  FindBounds find_bounds_;
  ScatterRadiance scatter_radiance_;

  int tile_x_ = 0, tile_y_ = 0;
  std::size_t sample_ = 0;
  raster::TileTask task_{};
  TilePlane depth_;
  alignas(64) std::array<TriangleId, kTilePixels> ids_{};
  TilePlane coverage_;
  FragmentList fragments_;
  std::vector<float> fragment_values_;
  bool has_lights_to_leave_out_ = false;
  std::vector<TileColor> planes_;
  SurfaceGroups groups_;
  std::unique_ptr<SurfaceSamples> samples_;
  std::unique_ptr<SurfacePoints> points_;
  std::unique_ptr<Irradiance> irradiance_;
  std::unique_ptr<SlideCoordinates> coordinates_;
  std::unique_ptr<Radiance> radiance_;
  std::unique_ptr<shadow::Arrival> arrival_, seen_;
  std::unique_ptr<PhotographPainter> photographs_;  // null: there are none
  std::size_t most_layers_ = 0;                     // of any surface
  std::unique_ptr<LayerPainter> layer_painter_;     // null: no surface has layers
  TileColor base_colors_;                        // of the tile's surfaces that have layers, with many passes
  std::unique_ptr<LightBlender> light_blender_;  // null: all lights add
  std::unique_ptr<LobeShader> lobe_shader_;      // null: no surface shows lobes
  LobeShader* lobes_ = nullptr;                  // of the batch; null: its surface has none
  std::unique_ptr<MirrorShader> mirror_shader_;  // null: the picture shows no mirrors
  TileResult result_;
  TileLayers layers_;

  Stopwatch watch_, stage_watch_;
  bool is_timed_ = false;
  double raster_ms_ = 0, shade_ms_ = 0;
  double map_ms_ = 0;          // of shade_ms_
  StageTimes shading_stages_;  // of the tiles that are timed
};

TileShader::TileShader(const ShaderJob& job) : worker_(std::make_unique<Worker>(job)) {}
TileShader::~TileShader() = default;
const TileResult& TileShader::shade(int tile_x, int tile_y) { return worker_->shade(tile_x, tile_y); }
StageTimes TileShader::times() const { return worker_->times(); }
double TileShader::map_ms() const { return worker_->map_ms(); }

}  // namespace laterna::shade
