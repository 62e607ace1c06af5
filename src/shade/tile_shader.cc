#include "shade/tile_shader.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "shade/affine_slide.h"
#include "shade/fragment_list.h"
#include "shade/surface_groups.h"

namespace laterna::shade {

using raster::kTilePixels;
using shadow::kGroupSize;
using shadow::kMaxGroups;
using shadow::SurfaceSamples;

namespace {

/// Where one colour per sample goes; SurfaceSamples::pixel is the index.
struct ColorTarget {
  float *r, *g, *b;
};

ColorTarget target_of(TileColor& color) { return {color.r.data(), color.g.data(), color.b.data()}; }

void scatter(const SurfaceSamples& samples, const float* values, float* target) {
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    const std::size_t first = group * kGroupSize;
    const std::uint32_t* pixel = samples.pixel.data() + first;
    if (samples.active[group] == 0xFFFFU && pixel[15] == pixel[0] + 15) {
      std::memcpy(target + *pixel, values + first, kGroupSize * sizeof(float));
      continue;
    }
    for (unsigned mask = samples.active[group]; mask != 0; mask &= mask - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(mask));
      target[pixel[i]] = values[first + i];
    }
  }
}

void scatter(const SurfaceSamples& samples, const Radiance& radiance, const ColorTarget& target) {
  scatter(samples, radiance.r.data(), target.r);
  scatter(samples, radiance.g.data(), target.g);
  scatter(samples, radiance.b.data(), target.b);
}

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

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

}  // namespace

class TileShader::Worker {
 public:
  explicit Worker(const ShaderJob& job)
      : job_(job),
        offsets_(sample_offsets(job.samples_per_pixel)),
        source_{job.frame, job.view, job.interpolation, job.anisotropy},
        cut_(source_, false, job.instruction_set),
        rasterise_visibility_(raster::rasterise_visibility_for(job.instruction_set)),
        rasterise_fragments_(raster::rasterise_fragments_for(job.instruction_set)),
        find_surface_points_(find_surface_points_for(job.instruction_set)),
        find_irradiance_(find_irradiance_for(job.instruction_set)),
        find_ambient_(find_ambient_for(job.instruction_set)),
        reflect_(reflect_for(job.instruction_set)),
        groups_(*job.frame),
        samples_(std::make_unique<SurfaceSamples>()),
        points_(std::make_unique<SurfacePoints>()),
        irradiance_(std::make_unique<Irradiance>()),
        coordinates_(std::make_unique<SlideCoordinates>()),
        radiance_(std::make_unique<Radiance>()) {
    samples_->ray = job.view->homogeneous_ray();
    const std::size_t lights = job.lights.size();
    if (job.wanted.visibility) result_.visibility.resize(lights);
    if (job.wanted.slide_uv) {
      result_.slide_s.resize(lights);
      result_.slide_t.resize(lights);
    }
  }

  const TileResult& shade(int tile_x, int tile_y) {
    tile_x_ = tile_x;
    tile_y_ = tile_y;
    for (std::size_t sample = 0; sample < offsets_.size(); ++sample) {
      sample_ = sample;
      rasterise();
      shade_sample();
    }
    finish();
    return result_;
  }

 private:
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
    return job_.wanted.lights || offsets_.size() > 1 || !fragments_.is_empty();
  }

  void shade_sample() {
    const bool has_planes = keeps_planes();
    planes_.resize(has_planes ? job_.lights.size() + 1 : 1);
    for (TileColor& plane : planes_) fill(plane, 0, 0, 0);
    if (job_.background != nullptr) {
      fill(planes_[0], job_.background->r, job_.background->g, job_.background->b);
    }
    start_data_layers();
    std::vector<ColorTarget> targets;
    for (TileColor& plane : planes_) targets.push_back(target_of(plane));
    if (job_.passes == Passes::multi) {
      shade_in_passes(targets);
    } else {
      shade_visible(targets, {true, 0, job_.lights.size()});
    }
    find_coverage();
    if (!fragments_.is_empty()) blend_fragments();
    accumulate(has_planes);
  }

  // What of the illumination is found: ambient light, and a range of the lights.
  struct Part {
    bool ambient;
    std::size_t first_light, end_light;
  };

  void shade_visible(std::span<const ColorTarget> targets, const Part& part) {
    groups_.collect(ids_);
    for (const SurfaceGroups::Group& group : groups_.groups()) {
      for (std::size_t first = 0; first < group.blocks.size(); first += kMaxGroups) {
        fill_from_blocks(
            std::span(group.blocks).subspan(first, std::min(kMaxGroups, group.blocks.size() - first)));
        shade_batch(job_.frame->surfaces[group.surface], targets, part, true);
      }
    }
  }

  // Segal et al. 1992, sections 3.1 and 3.3. Pass 1, hidden surface removal, has left z_p in depth_; c_p starts as the
  // ambient image. For each light, every polygon is scan-converted again with the test z = z_p: pass 2 finds α_p and
  // the colour c_τ that the slide throws, pass 3 adds c · c_τ · α_p to c_p. (Section 3.1 multiplies the sum over the
  // slides by c once, at the end; multiplied slide by slide it is the same number, and what each light gives stays
  // its own layer.)
  void shade_in_passes(std::span<const ColorTarget> targets) {
    shade_visible(targets, {true, 0, 0});
    keep_pass(0);
    for (std::size_t light = 0; light < job_.lights.size(); ++light) {
      scan_convert_again();
      start_illumination_pass(light);
      shade_visible(targets, {false, light, light + 1});
      keep_pass(light + 1);
    }
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

  void fill_from_blocks(std::span<const SurfaceGroups::Block> blocks) {
    SurfaceSamples& s = *samples_;
    s.group_count = blocks.size();
    const int origin_x = tile_x_ * raster::kTileSide - job_.view->origin_x;
    const int origin_y = tile_y_ * raster::kTileSide - job_.view->origin_y;
    for (std::size_t group = 0; group < blocks.size(); ++group) {
      const std::size_t block = blocks[group].block;
      const std::size_t first = group * kGroupSize;
      s.active[group] = blocks[group].mask;
      const float x =
          static_cast<float>(origin_x + static_cast<int>(block % raster::kBlocksPerSide) * 4) + sample_x();
      const float y =
          static_cast<float>(origin_y + static_cast<int>(block / raster::kBlocksPerSide) * 4) + sample_y();
      for (std::size_t i = 0; i < kGroupSize; ++i) {
        s.x[first + i] = x + static_cast<float>(i & 3U);
        s.y[first + i] = y + static_cast<float>(i >> 2U);
        s.q[first + i] = depth_[block * kGroupSize + i];
        s.id[first + i] = ids_[block * kGroupSize + i];
        s.pixel[first + i] = static_cast<std::uint32_t>(block * kGroupSize + i);
      }
      repeat_active(group);
    }
    bound_position_error();
  }

  [[nodiscard]] float sample_x() const {
    return 0.5F + static_cast<float>(offsets_[sample_].x) / raster::kSubpixels;
  }
  [[nodiscard]] float sample_y() const {
    return 0.5F + static_cast<float>(offsets_[sample_].y) / raster::kSubpixels;
  }

  // Samples that do not count become copies of one that does.
  void repeat_active(std::size_t group) {
    SurfaceSamples& s = *samples_;
    if (s.active[group] == 0xFFFFU) return;
    const std::size_t first = group * kGroupSize;
    const std::size_t from = first + static_cast<std::size_t>(__builtin_ctz(s.active[group]));
    for (std::size_t i = 0; i < kGroupSize; ++i) {
      if ((s.active[group] >> i & 1U) != 0) continue;
      s.x[first + i] = s.x[from];
      s.y[first + i] = s.y[from];
      s.q[first + i] = s.q[from];
      s.id[first + i] = s.id[from];
    }
  }

  // Half a unit in the last place of the coordinates as stored, and a few of the distance for the ray's arithmetic.
  void bound_position_error() {
    SurfaceSamples& s = *samples_;
    const frame::Bounds& bounds = job_.frame->bounds;
    float extent = 0;
    for (int k = 0; k < 3; ++k)
      extent = std::max({extent, std::abs(bounds.low[k]), std::abs(bounds.high[k])});
    float q = s.q[0];
    for (std::size_t i = 1; i < s.group_count * kGroupSize; ++i) q = std::min(q, s.q[i]);
    const float distance =
        job_.view->is_orthographic ? static_cast<float>(job_.view->view.projection.far) : 1 / q;
    s.position_error = 1.2e-7F * extent + 4e-7F * distance;
  }

  // -------------------------------------------------------------------------------------------- one batch of samples

  // All samples of samples_, which lie on one surface. One target takes the sum, more take ambient and each light.
  void shade_batch(const frame::Surface& surface, std::span<const ColorTarget> targets, const Part& part,
                   bool is_opaque) {
    const bool sums = targets.size() == 1;
    const std::size_t groups = samples_->group_count;
    find_surface_points_(source_, surface, *samples_, *points_);
    if (part.ambient) {
      find_ambient_(job_.reflection, surface, groups, *points_, *radiance_);
      if (is_opaque && sample_ == 0) store_geometry();
      if (!sums) scatter(*samples_, *radiance_, targets[0]);
    }
    for (std::size_t light = part.first_light; light < part.end_light; ++light) {
      if (surface.unlit && !wants_arrival(is_opaque)) continue;
      const ShaderLight& shader_light = job_.lights[light];
      find_irradiance(shader_light.bound);
      find_arrival(shader_light, wants_arrival(is_opaque));
      if (is_opaque) store_light_layers(light);
      if (surface.unlit) continue;
      reflect_(job_.reflection, groups, *points_, *irradiance_, arrival_.data(), sums, *radiance_);
      if (!sums) scatter(*samples_, *radiance_, targets[light + 1]);
    }
    if (sums) scatter(*samples_, *radiance_, targets[0]);
  }

  [[nodiscard]] bool wants_arrival(bool is_opaque) const {
    return is_opaque && (job_.wanted.visibility || job_.wanted.lux || job_.wanted.slide_uv);
  }

  void find_irradiance(const BoundLight& light) {
    const SlideCoordinates* coordinates = nullptr;
    if (job_.interpolation == Interpolation::affine && light.light->type == LightType::projector) {
      find_affine_slide_coordinates(light, source_, *samples_, *coordinates_);
      coordinates = coordinates_.get();
    }
    find_irradiance_(light, *samples_, *points_, coordinates, *irradiance_);
  }

  // α of the lit samples, or of all where a layer shows it.
  void find_arrival(const ShaderLight& light, bool of_all) {
    const std::size_t groups = samples_->group_count;
    const std::span wanted(of_all ? samples_->active : irradiance_->lit);
    std::fill_n(arrival_.begin(), groups * kGroupSize, 1.0F);
    if (light.shadow != nullptr) light.shadow->find_arrival(*samples_, wanted.first(groups), arrival_.data());
    release_non_receivers();
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
        if ((job_.frame->clusters[cluster_of(s.id[i])].flags & kReceivesShadow) == 0) arrival_[i] = 1;
      }
    }
  }

  // -------------------------------------------------------------------------------------------- blending

  // Back to front over the opaque surface, each of the planes by itself: what a light sends through a pane of glass
  // stays that light's.
  void blend_fragments() {
    const std::size_t count = fragments_.list().size();
    fragment_values_.resize(count * (3 * planes_.size() + 1));
    std::vector<ColorTarget> targets;
    for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
      float* first = fragment_values_.data() + count * 3 * plane;
      targets.push_back({first, first + count, first + 2 * count});
    }
    float* alpha = fragment_values_.data() + count * 3 * planes_.size();
    for (const FragmentList::Run& run : fragments_.by_surface(*job_.frame)) {
      for (std::size_t first = 0; first < run.fragments.size(); first += shadow::kMaxSamples) {
        fill_from_fragments(
            run.fragments.subspan(first, std::min(shadow::kMaxSamples, run.fragments.size() - first)));
        shade_batch(job_.frame->surfaces[run.surface], targets, {true, 0, job_.lights.size()}, false);
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
    }
  }

  // `fragments`: indices into the fragment list.
  void fill_from_fragments(std::span<const std::uint32_t> fragments) {
    SurfaceSamples& s = *samples_;
    s.group_count = (fragments.size() + kGroupSize - 1) / kGroupSize;
    std::fill_n(s.active.begin(), s.group_count, std::uint16_t{0});
    const int origin_x = tile_x_ * raster::kTileSide - job_.view->origin_x;
    const int origin_y = tile_y_ * raster::kTileSide - job_.view->origin_y;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const raster::Fragment& fragment = fragments_.list()[fragments[i]];
      const std::uint32_t block = fragment.pixel / kGroupSize;
      const int x = static_cast<int>(block % raster::kBlocksPerSide * 4 + (fragment.pixel & 3U));
      const int y = static_cast<int>(block / raster::kBlocksPerSide * 4 + (fragment.pixel >> 2U & 3U));
      s.x[i] = static_cast<float>(origin_x + x) + sample_x();
      s.y[i] = static_cast<float>(origin_y + y) + sample_y();
      s.q[i] = fragment.reversed_depth;
      s.id[i] = fragment.id;
      s.pixel[i] = fragments[i];
      std::uint16_t& active = s.active[i / kGroupSize];
      active = static_cast<std::uint16_t>(active | 1U << (i % kGroupSize));
    }
    repeat_active(s.group_count - 1);
    bound_position_error();
  }

  // -------------------------------------------------------------------------------------------- layers

  void find_coverage() {
    for (std::size_t i = 0; i < kTilePixels; ++i)
      coverage_[i] = ids_[i] == kNoTriangle && !job_.background ? 0.0F : 1.0F;
  }

  void start_data_layers() {
    const WantedLayers& wanted = job_.wanted;
    if (wanted.visibility) {
      for (std::size_t light = 0; light < job_.lights.size(); ++light) {
        if (sample_ == 0) result_.visibility[light].fill(0);
      }
    }
    if (wanted.lux && sample_ == 0) result_.lux.fill(0);
    if (sample_ != 0) return;
    for (TilePlane& plane : result_.slide_s) plane.fill(kNaN);
    for (TilePlane& plane : result_.slide_t) plane.fill(kNaN);
    if (wanted.geometry) {
      result_.depth.fill(kInfinity);
      fill(result_.position, 0, 0, 0);
      fill(result_.normal, 0, 0, 0);
      result_.object.fill(kNoObject);
    }
    if (wanted.albedo) fill(result_.albedo, 0, 0, 0);
  }

  // Layers of the surface itself, at the sample nearest to the pixel's centre.
  void store_geometry() {
    const SurfaceSamples& s = *samples_;
    if (job_.wanted.albedo) {
      scatter(s, points_->base_r.data(), result_.albedo.r.data());
      scatter(s, points_->base_g.data(), result_.albedo.g.data());
      scatter(s, points_->base_b.data(), result_.albedo.b.data());
    }
    if (!job_.wanted.geometry) return;
    scatter(s, s.x_ws.data(), result_.position.r.data());
    scatter(s, s.y_ws.data(), result_.position.g.data());
    scatter(s, s.z_ws.data(), result_.position.b.data());
    scatter(s, points_->normal_x_ws.data(), result_.normal.r.data());
    scatter(s, points_->normal_y_ws.data(), result_.normal.g.data());
    scatter(s, points_->normal_z_ws.data(), result_.normal.b.data());
    for (std::size_t group = 0; group < s.group_count; ++group) {
      for (unsigned mask = s.active[group]; mask != 0; mask &= mask - 1) {
        const std::size_t i = group * kGroupSize + static_cast<std::size_t>(__builtin_ctz(mask));
        result_.depth[s.pixel[i]] = static_cast<float>(job_.view->distance_from_reversed(s.q[i]));
        result_.object[s.pixel[i]] = job_.frame->clusters[cluster_of(s.id[i])].object;
      }
    }
  }

  void store_light_layers(std::size_t light) {
    const SurfaceSamples& s = *samples_;
    const WantedLayers& wanted = job_.wanted;
    if (wanted.visibility) add_to(result_.visibility[light], [&](std::size_t i) { return arrival_[i]; });
    if (wanted.slide_uv && sample_ == 0 && job_.lights[light].bound.light->type == LightType::projector) {
      scatter(s, irradiance_->slide_s.data(), result_.slide_s[light].data());
      scatter(s, irradiance_->slide_t.data(), result_.slide_t[light].data());
    }
    if (keeps_illumination()) add_illumination(result_.pass_illumination[light]);
    if (!wanted.lux) return;
    if (!job_.physical_lights.empty()) find_irradiance(job_.physical_lights[light]);
    const Irradiance& e = *irradiance_;
    // Rec. 709 luminance of what falls on the surface.
    add_to(result_.lux, [&](std::size_t i) {
      if ((e.lit[i / kGroupSize] >> (i % kGroupSize) & 1U) == 0) return 0.0F;
      return (0.2126F * e.r[i] + 0.7152F * e.g[i] + 0.0722F * e.b[i]) * e.cosine[i] * arrival_[i];
    });
    if (!job_.physical_lights.empty()) find_irradiance(job_.lights[light].bound);
  }

  // Pass 2 of the slide algorithm: c_p ← c_p + c_τ, where light arrives.
  void add_illumination(TileColor& sum) {
    const Irradiance& e = *irradiance_;
    const auto arriving = [&](std::size_t i, float value) {
      return (e.lit[i / kGroupSize] >> (i % kGroupSize) & 1U) == 0 ? 0.0F : value * arrival_[i];
    };
    add_to(sum.r, [&](std::size_t i) { return arriving(i, e.r[i]); });
    add_to(sum.g, [&](std::size_t i) { return arriving(i, e.g[i]); });
    add_to(sum.b, [&](std::size_t i) { return arriving(i, e.b[i]); });
  }

  template <class Value>
  void add_to(TilePlane& plane, Value value) {
    const SurfaceSamples& s = *samples_;
    for (std::size_t group = 0; group < s.group_count; ++group) {
      for (unsigned mask = s.active[group]; mask != 0; mask &= mask - 1) {
        const std::size_t i = group * kGroupSize + static_cast<std::size_t>(__builtin_ctz(mask));
        plane[s.pixel[i]] += value(i);
      }
    }
  }

  // Adds this sample's planes to the pixel's.
  void accumulate(bool has_planes) {
    if (!has_planes) {
      result_.radiance.clear();  // one sample, and it is the pixel
      result_.beauty = planes_[0];
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
  std::span<const SampleOffset> offsets_;
  PointSource source_;
  SurfaceCut cut_;
  raster::RasteriseVisibility rasterise_visibility_;
  raster::RasteriseFragments rasterise_fragments_;
  FindSurfacePoints find_surface_points_;
  FindIrradiance find_irradiance_;
  FindAmbient find_ambient_;
  Reflect reflect_;

  int tile_x_ = 0, tile_y_ = 0;
  std::size_t sample_ = 0;
  raster::TileTask task_{};
  TilePlane depth_;
  alignas(64) std::array<TriangleId, kTilePixels> ids_{};
  TilePlane coverage_;
  FragmentList fragments_;
  std::vector<float> fragment_values_;
  std::vector<TileColor> planes_;
  SurfaceGroups groups_;
  std::unique_ptr<SurfaceSamples> samples_;
  std::unique_ptr<SurfacePoints> points_;
  std::unique_ptr<Irradiance> irradiance_;
  std::unique_ptr<SlideCoordinates> coordinates_;
  std::unique_ptr<Radiance> radiance_;
  shadow::SampleArray<float> arrival_;
  TileResult result_;
};

TileShader::TileShader(const ShaderJob& job) : worker_(std::make_unique<Worker>(job)) {}
TileShader::~TileShader() = default;
const TileResult& TileShader::shade(int tile_x, int tile_y) { return worker_->shade(tile_x, tile_y); }

}  // namespace laterna::shade
