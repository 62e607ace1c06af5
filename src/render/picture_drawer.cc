#include "render/picture_drawer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/refuse.h"
#include "base/stopwatch.h"
#include "frame/surface_lobes.h"
#include "light/decal_plan.h"
#include "light/mirror_plan.h"
#include "render/behind_picture.h"
#include "render/channels.h"
#include "render/cost_sum.h"
#include "render/depth_map_painter.h"
#include "render/environment.h"
#include "render/metadata.h"
#include "render/photograph_feathers.h"
#include "render/picture_accumulation.h"
#include "render/settings_check.h"

namespace laterna::render {
namespace {

// Set-up triangles of the camera's view are held to about this much memory: larger scenes are drawn in bands.
constexpr std::size_t kBinMemory = std::size_t{512} << 20U;

int band_count(const frame::Frame& frame, int tile_rows) {
  const std::size_t bytes = frame.triangle_count() * sizeof(raster::SmallTriangle);
  return static_cast<int>(
      std::clamp<std::size_t>((bytes + kBinMemory - 1) / kBinMemory, 1, static_cast<std::size_t>(tile_rows)));
}

// Where samples of a picture of a mean lie in their pixels; those of the first stay where they are.
shade::SampleOffset jitter_of(SampleIndex sample) {
  const auto offset = [&](SampleDimension dimension) {
    return static_cast<int>(std::floor(256 * sample_number(sample, dimension))) - 128;
  };
  return {offset(SampleDimension::pixel_x), offset(SampleDimension::pixel_y)};
}

// What painters of maps do while a picture is drawn.
class MapWorkMeter {
 public:
  explicit MapWorkMeter(const MapWork& work) : work_(work), before_(read()) {}
  void report(RenderStatistics::MapReuse& reuse) const {
    const Counts now = read();
    reuse.tiles_drawn += now.tiles_drawn - before_.tiles_drawn;
    reuse.tiles_updated += now.tiles_updated - before_.tiles_updated;
    reuse.triangles += now.triangles - before_.triangles;
    reuse.moving_triangles += now.moving_triangles - before_.moving_triangles;
  }

 private:
  struct Counts {
    std::uint64_t tiles_drawn, tiles_updated, triangles, moving_triangles;
  };
  [[nodiscard]] Counts read() const {
    return {work_.tiles_drawn, work_.tiles_updated, work_.triangles, work_.moving_triangles};
  }
  const MapWork& work_;
  Counts before_;
};

// Before so many pictures have been averaged, how they differ says little.
constexpr int kFewestPictures = 8;

// Sorted triangles kept from picture to picture, so that their memory is touched only once.
constexpr std::size_t kIdleBinMemory = std::size_t{256} << 20U;

// Projectors that paint, with what finds the surfaces that they see.
std::vector<shade::ShaderDecal> make_decals(const raster::RasterView::Ray& ray,
                                            const RenderSettings& settings,
                                            std::span<const light::PlannedLight> plan,
                                            ShadowCasting& casting) {
  std::vector<shade::ShaderDecal> decals;
  for (const light::PlannedLight& planned : plan) {
    decals.push_back({shade::BoundLight(*planned.placed, ray, ShadingModel::papers, settings.anisotropy),
                      shade::LightReach(*planned.placed, ShadingModel::papers),
                      casting.make(planned, planned.number)});
  }
  return decals;
}

// Rows of metres, from the top.
LayeredImage metres_of(const shadow::DepthMap& map, const TaskPool& pool) {
  LayeredImage image;
  image.width = map.width();
  image.height = map.height();
  image.channels.push_back({"Z", {}});
  std::vector<float>& values = image.channels[0].values;
  const auto width = static_cast<std::size_t>(map.width());
  values.resize(width * static_cast<std::size_t>(map.height()));
  pool.for_each(static_cast<std::size_t>(map.height()), [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < map.width(); ++x)
      values[row * width + static_cast<std::size_t>(x)] = static_cast<float>(map.distance(x, y));
  });
  return image;
}

}  // namespace

class PictureDrawer::Drawing {
 public:
  explicit Drawing(const PictureDrawer& of) : of_(of) {
    const std::lock_guard lock(of_.drawing_mutex_);
    ++of_.pictures_drawn_now_;
  }
  ~Drawing() {
    // None begins before the caches are at rest.
    const std::lock_guard lock(of_.drawing_mutex_);
    if (--of_.pictures_drawn_now_ == 0) of_.let_caches_rest();
    of_.bins_.trim(std::min<std::size_t>(kIdleBinMemory, of_.cache_bytes_));
  }
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

 private:
  const PictureDrawer& of_;
};

// Paraboloid maps have what others leave.
void PictureDrawer::let_caches_rest() const {
  maps_.rest(cache_bytes_);
  paraboloids_.rest(cache_bytes_ - maps_.kept_bytes());
}

Result<void> PictureDrawer::check_mirrors() const {
  if (!frame().has_mirrors) return {};
  return light::find_mirrors(frame()).map([](const std::vector<light::FlatMirror>&) {});
}

Result<void> PictureDrawer::load_environment(const RendererOptions& options) {
  if (frame::may_show(posed_.scene(), AnimatedProperty::transmission))
    split_sum_ = std::make_unique<const shade::SplitSum>(shade::make_split_sum(pool_));
  if (frame::may_show(posed_.scene(), AnimatedProperty::sheen_color))
    sheen_ = std::make_unique<const shade::SheenAlbedo>(shade::make_sheen_albedo(pool_));
  if (!posed_.scene().environment) return {};
  Result<image::EnvironmentMap> map = prepare_environment(
      posed_.scene(), pool_, instruction_set_, options.environment_cache, options.environment_progress);
  if (!map) return tl::unexpected(std::move(map.error()));
  environment_ = std::make_unique<const image::EnvironmentMap>(std::move(*map));
  if (split_sum_ == nullptr)
    split_sum_ = std::make_unique<const shade::SplitSum>(shade::make_split_sum(pool_));
  return {};
}

// One for each photograph, drawn when a picture first asks.
const std::vector<image::MipChain>& PictureDrawer::photograph_feathers() const {
  const std::lock_guard lock(feathers_mutex_);
  if (feathers_revision_ != posed_.casters().revision()) feathers_.clear();
  feathers_revision_ = posed_.casters().revision();
  StageTimes unused;
  for (std::size_t i = feathers_.size(); i < frame().photographs.size(); ++i) {
    const light::ShadowView view = light::photograph_view(frame().photographs[i], kFeatherMapSide);
    const shadow::DepthMap depth =
        draw_depth_map({frame(), pool_, bins_, instruction_set_, unused}, view, CasterFaces::both, false);
    feathers_.push_back(
        make_feather(depth, *frame().photographs[i].picture, posed_.scene().photograph_settings.feather));
  }
  return feathers_;
}

// Photographs with what finds the surfaces that they see.
shade::PhotographJob PictureDrawer::make_photograph_job(const raster::RasterView::Ray& ray,
                                                        const RenderSettings& settings,
                                                        const light::PhotographPlan& plan,
                                                        ShadowCasting& casting) const {
  shade::PhotographJob job;
  const PhotographSettings& how = posed_.scene().photograph_settings;
  job.unseen = how.unseen;
  for (std::size_t i = 0; i < plan.photographs.size(); ++i) {
    const light::PlannedLight& planned = plan.photographs[i];
    const image::MipChain* feather = how.feather > 0 ? &photograph_feathers()[i] : nullptr;
    job.photographs.push_back(
        {shade::BoundPhotograph(frame().photographs[i], ray, how.blend, feather, settings.anisotropy),
         shade::LightReach(*planned.placed, ShadingModel::papers), casting.make(planned, planned.number)});
  }
  return job;
}

// Everything the tiles share, with every shadow technique ready to answer.
shade::ShaderJob PictureDrawer::make_job(const raster::RasterView& view, const RenderSettings& settings,
                                         const PicturePlan& planned_picture, const std::vector<int>& way,
                                         RenderStatistics& statistics, ProgressReport& progress) const {
  shade::ShaderJob job;
  job.frame = &frame();
  job.view = &view;
  job.reflection.model = settings.shading;
  job.reflection.phong = posed_.scene().phong;
  for (int i = 0; i < 3; ++i) job.reflection.ambient[i] = posed_.scene().ambient[i];
  job.interpolation = settings.interpolation;
  job.anisotropy = settings.anisotropy;
  job.samples_per_pixel = settings.samples;
  job.passes = settings.passes;
  if (environment_ != nullptr)
    job.environment.emplace(*posed_.scene().environment, *environment_, *split_sum_, posed_.scene().phong);
  job.lobes = {split_sum_.get(), sheen_.get(), nullptr};
  const bool is_hidden = job.environment && job.environment->is_visible;
  job.background = posed_.scene().background && !is_hidden ? &*posed_.scene().background : nullptr;
  job.wanted = wanted_layers(settings);
  job.instruction_set = instruction_set_;
  const raster::RasterView::Ray ray = view.homogeneous_ray();
  ShadowCasting casting({frame(), pool_, instruction_set_, bins_, maps_, paraboloids_, posed_.casters(), view,
                         settings, statistics, progress, way});
  job.photographs = make_photograph_job(ray, settings, planned_picture.photographs, casting);
  job.decals = make_decals(ray, settings, planned_picture.decals, casting);
  add_lights(ray, settings, planned_picture.lights, casting, progress, job);
  return job;
}

// Each light with what answers for its shadows.
void PictureDrawer::add_lights(const raster::RasterView::Ray& ray, const RenderSettings& settings,
                               const light::LightPlan& plan, ShadowCasting& casting, ProgressReport& progress,
                               shade::ShaderJob& job) const {
  for (std::size_t i = 0; i < plan.lights.size(); ++i) {
    const light::PlannedLight& planned = plan.lights[i];
    shade::BoundLight bound(*planned.placed, ray, settings.shading, settings.anisotropy);
    if (progress.asks_to_stop()) break;
    job.lights.push_back({bound, shade::LightReach(*planned.placed, settings.shading),
                          casting.make(planned, i), shade::ShadowTone(planned.settings)});
    if (planned.placed->light->blend != BlendMode::add)
      job.lights.back().open = with_open_gate(bound, *planned.placed);
    if (job.wanted.lux && settings.shading == ShadingModel::papers) {
      job.physical_lights.emplace_back(*planned.placed, ray, ShadingModel::phong, settings.anisotropy);
    }
  }
}

// Triangles sorted by tile, then tiles shaded, one band of tile rows after the other.
void PictureDrawer::draw_bands(const raster::RasterView& view, const RenderSettings& settings,
                               shade::ShaderJob& job, const PicturePart& part, RenderStatistics& statistics,
                               ProgressReport& progress) const {
  const int left = part.pixels.x_begin / raster::kTileSide, top = part.pixels.y_begin / raster::kTileSide;
  const int tiles_x = raster::tiles_across(part.pixels.x_end) - left;
  const int tiles_y = raster::tiles_across(part.pixels.y_end) - top;
  const int bands = band_count(frame(), tiles_y);
  std::vector<std::unique_ptr<shade::TileShader>> shaders(static_cast<std::size_t>(pool_.threads()));
  std::vector<double> encode_ms(shaders.size());
  const auto binned = bins_.take();
  raster::BinOptions options;
  options.cull = raster::CullFaces::single_sided;
  options.required_flags = kVisible;
  options.excluded_flags = part.excluded_flags;
  options.cut_flags = kAlphaMask | kRelief;
  options.instruction_set = instruction_set_;
  options.cut = part.cut;
  options.left_out = part.left_out;
  for (const shade::SampleOffset& offset :
       shade::sample_offsets(settings.samples, job.jitter, job.is_turned)) {
    options.sample_reach = std::max({options.sample_reach, std::abs(offset.x), std::abs(offset.y)});
  }
  for (int band = 0; band < bands && !progress.is_cancelled(); ++band) {
    const int first_row = top + tiles_y * band / bands;
    const int end_row = top + tiles_y * (band + 1) / bands;
    Stopwatch watch;
    watch.start();
    options.pixels = raster::overlap(
        part.pixels, {0, first_row * raster::kTileSide, settings.width, end_row * raster::kTileSide});
    binned->fill(view, frame().geometry(), options, pool_);
    job.batches = binned->batches();
    statistics.triangles += binned->statistics().triangles;
    statistics.triangles_drawn += binned->statistics().triangles_binned;
    statistics.picture_stages += binned->statistics().times;
    statistics.bin_ms += watch.lap_ms();

    pool_.for_each(static_cast<std::size_t>(tiles_x * (end_row - first_row)), [&](std::size_t i, int worker) {
      if (progress.is_cancelled()) return;
      auto& shader = shaders[static_cast<std::size_t>(worker)];
      if (shader == nullptr) shader = std::make_unique<shade::TileShader>(job);
      const int x = left + static_cast<int>(i) % tiles_x;
      const int y = first_row + static_cast<int>(i) / tiles_x;
      const shade::TileResult& tile = shader->shade(x, y);
      Stopwatch encode_watch;
      encode_watch.start();
      part.write(x, y, tile);
      encode_ms[static_cast<std::size_t>(worker)] += encode_watch.lap_ms();
      if (part.seen == nullptr) progress.advance();
    });
    statistics.shade_ms += watch.lap_ms();
  }
  for (std::size_t i = 0; i < shaders.size(); ++i) {
    statistics.picture_stages[Stage::encode] += encode_ms[i];
    if (shaders[i] == nullptr) continue;
    statistics.picture_stages += shaders[i]->times();
    statistics.map_stages[Stage::raster] += shaders[i]->map_ms();
  }
}

// Whether what lies behind some surfaces is to be seen through them.
bool PictureDrawer::looks_through(const RenderSettings& settings) const {
  return frame().has_transmission && settings.shading == ShadingModel::pbr;
}

// The same part without what light goes through: those surfaces then show it, refracted.
Result<shade::EarlierView> PictureDrawer::draw_behind(const raster::RasterView& view,
                                                      const RenderSettings& settings, const PicturePart& part,
                                                      shade::ShaderJob& job, RenderStatistics& statistics,
                                                      ProgressReport& progress) const {
  RenderSettings plain = settings;
  plain.layers = {};
  BehindPicture picture(settings.width, settings.height);
  const Result<PictureWriter> writer =
      PictureWriter::create(plain, picture.target(), frame(), instruction_set_);
  if (!writer) return tl::unexpected(writer.error());
  PicturePart behind = part;
  // Refraction and blur reach beyond a mirror's part.
  behind.pixels = {0, 0, settings.width, settings.height};
  behind.excluded_flags |= kTransmissive;
  behind.write = [&](int tile_x, int tile_y, const shade::TileResult& tile) {
    writer->write(tile_x, tile_y, tile);
  };
  const shade::WantedLayers wanted = std::exchange(job.wanted, wanted_layers(plain));
  draw_bands(view, plain, job, behind, statistics, progress);
  job.wanted = wanted;
  return picture.seen_from(view, instruction_set_);
}

// A part of one view's picture, planned anew.
Result<void> PictureDrawer::draw_part(const View& from, const RenderSettings& settings, SampleIndex sample,
                                      const PicturePart& part, shade::MirrorJob mirrors,
                                      RenderStatistics& statistics, ProgressReport& progress) const {
  Stopwatch watch;
  watch.start();
  const PicturePlan plan = {
      light::make_light_plan(frame(), {settings.shadows, sample, &from}),
      light::make_photograph_plan(frame(), posed_.scene().photograph_settings.visibility),
      light::make_decal_plan(frame(), settings.shadows)};
  statistics.plan_ms += watch.lap_ms();
  const raster::RasterView view(from, settings.width, settings.height);
  const std::vector<int> way = part.seen != nullptr ? part.seen->way : std::vector<int>();
  if (frame().has_mirrors) maps_.make_room(cache_bytes_);
  shade::ShaderJob job = make_job(view, settings, plan, way, statistics, progress);
  job.jitter = jitter_of(sample);
  job.is_turned = part.seen != nullptr && part.seen->is_turned;
  job.mirrors = std::move(mirrors);
  if (part.wants_depth) job.wanted.geometry = true;
  job.wanted.samples = part.wants_samples;
  statistics.shadow_ms += watch.lap_ms();
  std::optional<shade::EarlierView> behind;
  if (looks_through(settings) && !progress.is_cancelled()) {
    Result<shade::EarlierView> drawn = draw_behind(view, settings, part, job, statistics, progress);
    if (!drawn) return tl::unexpected(std::move(drawn.error()));
    job.lobes.behind = &behind.emplace(std::move(*drawn));
  }
  if (!progress.is_cancelled()) draw_bands(view, settings, job, part, statistics, progress);
  if (part.seen != nullptr) {
    ++statistics.mirror_pictures;
    return {};
  }
  for (std::size_t i = 0; i < job.lights.size(); ++i)
    report_drawn(plan.lights.lights[i], job.lights[i].shadow.get(), statistics);
  return {};
}

// What its mirrors show, the deepest first.
Result<shade::MirrorJob> PictureDrawer::draw_mirrors(const View& from, const RenderSettings& settings,
                                                     SampleIndex sample, RenderStatistics& statistics,
                                                     ProgressReport& progress) const {
  const Result<light::MirrorPlan> plan =
      light::make_mirror_plan(frame(), from, settings.width, settings.height, settings.mirror_depth);
  if (!plan) return tl::unexpected(plan.error());
  RenderSettings plain = settings;
  plain.layers = {};
  Result<void> outcome;
  const auto draw_one = [&](const View& view, const PicturePart& part, shade::MirrorJob within) {
    if (outcome && !progress.asks_to_stop())
      outcome = draw_part(view, plain, sample, part, std::move(within), statistics, progress);
  };
  shade::MirrorJob mirrors = MirrorDrawing(frame(), *plan, settings.width, settings.height, settings.samples,
                                           posed_.time(), sample, draw_one)
                                 .draw();
  if (!outcome) return tl::unexpected(std::move(outcome.error()));
  return mirrors;
}

// One picture: everything as it is at one sample of what is averaged.
Result<RenderStatistics> PictureDrawer::draw_picture(const View& from, const RenderSettings& settings,
                                                     SampleIndex sample, const PictureWriter& writer,
                                                     ProgressReport& progress) const {
  Stopwatch watch;
  watch.start();
  RenderStatistics statistics;
  const MapWorkMeter work(maps_.work());
  shade::MirrorJob mirrors;
  if (frame().has_mirrors) {
    Result<shade::MirrorJob> drawn = draw_mirrors(from, settings, sample, statistics, progress);
    if (!drawn) return tl::unexpected(std::move(drawn.error()));
    mirrors = std::move(*drawn);
  }
  PicturePart whole;
  whole.pixels = {0, 0, settings.width, settings.height};
  whole.write = [&](int tile_x, int tile_y, const shade::TileResult& tile) {
    writer.write(tile_x, tile_y, tile);
  };
  const Result<void> drawn =
      draw_part(from, settings, sample, whole, std::move(mirrors), statistics, progress);
  if (!drawn) return tl::unexpected(drawn.error());
  work.report(statistics.map_reuse);
  statistics.total_ms = watch.lap_ms();
  return statistics;
}

// The mean of pictures at different samples. The target has been checked.
Result<RenderStatistics> PictureDrawer::draw_mean(const View& from, const RenderSettings& settings,
                                                  const Destination& destination,
                                                  ProgressReport& progress) const {
  Stopwatch watch;
  watch.start();
  RenderStatistics statistics;
  PictureAccumulation pictures(settings, frame(), pool_);
  const auto write = [&] { pictures.write(settings, destination.target, instruction_set_, frame()); };
  for (int i = 0; i < settings.accumulate && !progress.is_cancelled(); ++i) {
    const SampleIndex sample = {i, settings.accumulate};
    const Result<View> view = destination.expose != nullptr ? (*destination.expose)(sample) : from;
    if (!view) return tl::unexpected(view.error());
    if (Result<void> checked = check_settings(settings, *view); !checked)
      return tl::unexpected(checked.error());
    const Result<PictureWriter> writer = PictureWriter::create(
        pictures.picture_settings(), pictures.picture_target(), frame(), instruction_set_);
    Result<RenderStatistics> one =
        draw_picture(*view, pictures.picture_settings(), sample, *writer, progress);
    if (!one) return one;
    if (progress.is_cancelled()) break;
    pictures.add();
    add_costs(statistics, *one);
    if (settings.noise > 0 && pictures.count() >= kFewestPictures && pictures.noise() <= settings.noise)
      break;
    if (destination.preview && i + 1 < settings.accumulate &&
        !destination.preview({pictures.count(), pictures.noise(), write, destination.image})) {
      break;
    }
  }
  if (progress.is_cancelled()) return statistics;
  statistics.pictures = pictures.count();
  statistics.noise = pictures.noise();
  write();
  statistics.total_ms = watch.lap_ms();
  return statistics;
}

Result<RenderStatistics> PictureDrawer::draw(const View& from, const RenderSettings& settings,
                                             const Destination& destination, const Progress& progress) const {
  if (Result<void> checked = check_settings(settings, from); !checked) return tl::unexpected(checked.error());
  Result<PictureWriter> writer =
      PictureWriter::create(settings, destination.target, frame(), instruction_set_);
  if (!writer) return tl::unexpected(std::move(writer.error()));

  auto drawing = std::make_unique<const Drawing>(*this);
  ProgressReport report(progress, static_cast<std::size_t>(raster::tiles_across(settings.width)) *
                                      static_cast<std::size_t>(raster::tiles_across(settings.height)) *
                                      static_cast<std::size_t>(settings.accumulate) *
                                      (looks_through(settings) ? 2 : 1));
  Result<RenderStatistics> statistics = settings.accumulate == 1
                                            ? draw_picture(from, settings, {}, *writer, report)
                                            : draw_mean(from, settings, destination, report);
  if (report.is_cancelled())
    return tl::unexpected(Error(Failure::cancelled, Diagnostic{{}, {}, "cancelled"}));
  drawing.reset();
  if (statistics) statistics->map_reuse.bytes = maps_.kept_bytes() + paraboloids_.kept_bytes();
  return statistics;
}

Result<LayeredImage> PictureDrawer::draw_channels(const View& view, const RenderSettings& settings,
                                                  const Progress& progress, RenderStatistics* statistics,
                                                  const Preview& preview, const Expose* expose) const {
  if (Result<void> checked = check_settings(settings, view); !checked) return tl::unexpected(checked.error());
  LayeredImage image;
  image.width = settings.width;
  image.height = settings.height;
  RenderTarget target;
  const auto stride = static_cast<std::size_t>(settings.width);
  for (const PictureChannel& channel : picture_channels(settings, frame())) {
    image.channels.push_back(
        {channel.name, std::vector<float>(stride * static_cast<std::size_t>(settings.height))});
  }
  for (Channel& channel : image.channels)
    target.channels.push_back({channel.name, channel.values.data(), stride});
  image.metadata = describe(settings, view, frame());
  Result<RenderStatistics> done = draw(view, settings, {target, preview, &image, expose}, progress);
  if (!done) return tl::unexpected(std::move(done.error()));
  if (statistics != nullptr) *statistics = *done;
  return image;
}

LayeredImage PictureDrawer::draw_distances(const light::PlannedLight& planned,
                                           RenderStatistics& statistics) const {
  Stopwatch watch;
  watch.start();
  const auto map = shown_maps_.take();
  *map = draw_depth_map({frame(), pool_, bins_, instruction_set_, statistics.map_stages},
                        planned.shadow_views[0], planned.settings.caster_faces, false, std::move(*map));
  statistics.shadow_ms = statistics.total_ms = watch.lap_ms();
  statistics.maps_drawn = 1;
  bins_.trim(std::min<std::size_t>(kIdleBinMemory, cache_bytes_));
  return metres_of(*map, pool_);
}

}  // namespace laterna::render
