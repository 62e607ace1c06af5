#include "shade/tile_shader.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "shade/batch_shader.h"
#include "shade/fragment_list.h"
#include "shade/relief_cut.h"
#include "shade/sample_batch.h"
#include "shade/scatter.h"
#include "shade/surface_groups.h"

namespace laterna::shade {

using raster::kTilePixels;
using shadow::kGroupSize;
using shadow::kMaxGroups;

namespace {

ColorTarget target_of(TileColor& color) { return {color.r.data(), color.g.data(), color.b.data()}; }

}  // namespace

class TileShader::Worker {
 public:
  explicit Worker(const ShaderJob& job)
      : job_(job),
        offsets_(sample_offsets(job.samples_per_pixel, job.jitter, job.is_turned)),
        layers_(*job.frame, *job.view, job.wanted, result_),
        batch_(job, layers_, result_),
        cut_(batch_.source(), job.instruction_set),
        rasterise_visibility_(raster::rasterise_visibility_for(job.instruction_set)),
        rasterise_fragments_(raster::rasterise_fragments_for(job.instruction_set)),
        show_environment_(show_environment_for(job.instruction_set)),
        pixel_rays_(*job.view),
        fill_from_blocks_(fill_from_blocks_for(job.instruction_set)),
        groups_(*job.frame) {
    if (!job.mirrors.mirror_of_cluster.empty())
      mirror_shader_ = std::make_unique<MirrorShader>(job.mirrors, *job.view, sampled_at());
  }

  const TileResult& shade(int tile_x, int tile_y) {
    tile_x_ = tile_x;
    tile_y_ = tile_y;
    batch_.clock().start_tile(tile_x, tile_y);
    watch_.start();
    for (std::size_t sample = 0; sample < offsets_.size(); ++sample) {
      sample_ = sample;
      batch_.start_sample(sample);
      rasterise();
      raster_ms_ += watch_.lap_ms();
      batch_.clock().start_stage();
      shade_sample();
      shade_ms_ += watch_.lap_ms();
    }
    finish();
    shade_ms_ += watch_.lap_ms();
    return result_;
  }

  [[nodiscard]] StageTimes times() const {
    StageTimes times = batch_.clock().stages(shade_ms_);
    times[Stage::raster] = raster_ms_;
    return times;
  }
  [[nodiscard]] double map_ms() const { return batch_.clock().drawing_ms(); }

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
    batch_.clock().end_stage(Stage::light);
  }

  [[nodiscard]] TileOrigin origin() const {
    const SampleOffset& offset = offsets_[sample_];
    return {*job_.frame, *job_.view, tile_x_, tile_y_, offset.x, offset.y};
  }

  [[nodiscard]] IlluminationPart everything() const {
    return {true, 0, job_.lights.size(), job_.environment.has_value()};
  }

  void shade_visible(std::span<const ColorTarget> targets, const IlluminationPart& part) {
    for_each_visible_batch(
        [&](const frame::Surface& surface) { batch_.shade(surface, targets, part, true); });
  }

  // Calls `use` with the batch filled in, all of that surface.
  template <class Use>
  void for_each_visible_batch(Use use) {
    groups_.collect(ids_);
    for (const SurfaceGroups::Group& group : groups_.groups()) {
      for (std::size_t first = 0; first < group.blocks.size(); first += kMaxGroups) {
        const std::size_t count = std::min(kMaxGroups, group.blocks.size() - first);
        fill_from_blocks_(origin(), std::span(group.blocks).subspan(first, count), depth_.data(), ids_.data(),
                          batch_.samples());
        use(job_.frame->surfaces[group.surface]);
      }
    }
  }

  // Every polygon scan-converted again for each layer.
  void lay_in_passes() {
    for (std::size_t pass = 0; pass < batch_.most_layers(); ++pass) {
      scan_convert_again();
      for_each_visible_batch([&](const frame::Surface& surface) {
        if (pass < surface.layers.size()) batch_.lay_pass(surface, pass);
      });
    }
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
    if (!batch_.keeps_illumination()) return;
    std::vector<TileColor>& passes = result_.pass_illumination;
    passes.resize(job_.lights.size());
    if (light > 0) {
      passes[light] = passes[light - 1];
    } else {
      const float* ambient = job_.reflection.ambient;
      fill(passes[0], ambient[0], ambient[1], ambient[2]);
    }
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

  // Where mirrored pictures have the one sample of a pixel; several are a mean about its centre.
  [[nodiscard]] glm::vec2 sampled_at() const {
    if (offsets_.size() > 1) return glm::vec2(0);
    return glm::vec2(offsets_[0].x, offsets_[0].y) / 256.0F;
  }

  // A pixel of the tile, at the sample that is being shaded.
  [[nodiscard]] MirrorSample mirror_sample(std::uint32_t pixel, float q) const {
    constexpr auto kBlock = static_cast<std::uint32_t>(kGroupSize);
    const std::uint32_t block = pixel / kBlock, within = pixel % kBlock;
    const auto x = static_cast<int>(block % raster::kBlocksPerSide * raster::kBlockSide + (within & 3U));
    const auto y = static_cast<int>(block / raster::kBlocksPerSide * raster::kBlockSide + (within >> 2U));
    const TileOrigin from = origin();
    return {tile_x_ * raster::kTileSide + x,
            tile_y_ * raster::kTileSide + y,
            from.x + static_cast<float>(x),
            from.y + static_cast<float>(y),
            q,
            sample_};
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

  // What lies behind water is seen where the ray that it bends ends, not straight behind.
  void refract_in_fragment(const raster::Fragment& fragment) {
    const MirrorPicture* picture = mirror_shader_->refracted_by(fragment.id);
    if (picture == nullptr) return;
    const glm::vec3 seen =
        mirror_shader_->refract(*picture, mirror_sample(fragment.pixel, fragment.reversed_depth));
    for (TileColor& plane : planes_) weigh(plane, fragment.pixel, glm::vec3(0));
    planes_[0].r[fragment.pixel] = seen.r;
    planes_[0].g[fragment.pixel] = seen.g;
    planes_[0].b[fragment.pixel] = seen.b;
    coverage_[fragment.pixel] = 1;
  }

  // What mirrors show, over a fragment that blends: what it lets through and its own surface share what is not mirrored.
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
        fill_from_fragments(origin(), fragments_.list(), run.fragments.subspan(first, size),
                            batch_.samples());
        batch_.shade(job_.frame->surfaces[run.surface], shaded(targets), everything(), false);
        scatter(batch_.samples(), batch_.alpha(), alpha);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t pixel = fragments_.list()[i].pixel;
      const float a = alpha[i];
      if (mirror_shader_ != nullptr) refract_in_fragment(fragments_.list()[i]);
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

  // Adds this sample's planes to the pixel's.
  void accumulate(bool has_planes) {
    if (!has_planes) {
      result_.radiance.clear();  // one sample, and it is the pixel: shading has written beauty itself
      result_.alpha = coverage_;
      return;
    }
    keep_sample();
    if (sample_ == 0) {
      result_.radiance.resize(planes_.size());
      std::copy(planes_.begin(), planes_.end(), result_.radiance.begin());
      result_.alpha = coverage_;
      return;
    }
    for (std::size_t i = 0; i < planes_.size(); ++i) add(result_.radiance[i], planes_[i]);
    add(result_.alpha, coverage_);
  }

  // What this sample shows by itself.
  void keep_sample() {
    if (!job_.wanted.samples) return;
    result_.samples.resize(offsets_.size());
    TileColor& sum = result_.samples[sample_];
    sum = planes_[0];
    for (std::size_t i = 1; i < planes_.size(); ++i) add(sum, planes_[i]);
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
  TileResult result_;
  TileLayers layers_;
  BatchShader batch_;
  ReliefCut cut_;
  raster::RasteriseVisibility rasterise_visibility_;
  raster::RasteriseFragments rasterise_fragments_;
  ShowEnvironment show_environment_;
  PixelRays pixel_rays_;
  FillFromBlocks fill_from_blocks_;

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
  std::unique_ptr<MirrorShader> mirror_shader_;  // null: the picture shows no mirrors

  Stopwatch watch_;
  double raster_ms_ = 0, shade_ms_ = 0;
};

TileShader::TileShader(const ShaderJob& job) : worker_(std::make_unique<Worker>(job)) {}
TileShader::~TileShader() = default;
const TileResult& TileShader::shade(int tile_x, int tile_y) { return worker_->shade(tile_x, tile_y); }
StageTimes TileShader::times() const { return worker_->times(); }
double TileShader::map_ms() const { return worker_->map_ms(); }

}  // namespace laterna::shade
