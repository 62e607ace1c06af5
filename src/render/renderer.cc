#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "base/refuse.h"
#include "base/stopwatch.h"
#include "base/without_exceptions.h"
#include "frame/place_lights.h"
#include "frame/slide_points.h"
#include "laterna/render.h"
#include "light/decal_plan.h"
#include "light/light_plan.h"
#include "light/photograph_plan.h"
#include "render/camera_views.h"
#include "render/cost_sum.h"
#include "render/depth_map_cache.h"
#include "render/environment.h"
#include "render/idle_projectors.h"
#include "render/metadata.h"
#include "render/open_sheets.h"
#include "render/photograph_feathers.h"
#include "render/picture_accumulation.h"
#include "render/picture_writer.h"
#include "render/probe_grid.h"
#include "render/probe_light.h"
#include "render/progress_report.h"
#include "render/scene_defaults.h"
#include "render/settings_check.h"
#include "render/shadow_casting.h"
#include "scene/scene_pose.h"

namespace laterna {

using render::BinsPool;
using render::ProgressReport;

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

// Before so many pictures have been averaged, how they differ says little.
constexpr int kFewestPictures = 8;

// Sorted triangles kept from picture to picture, so that their memory is touched only once.
constexpr std::size_t kIdleBinMemory = std::size_t{256} << 20U;

// Whether two states of a material let light through alike, where it lets any through.
bool same_cut_outs(const frame::Surface& a, const frame::Surface& b) {
  if (a.alpha_mode == AlphaMode::opaque) return true;
  return a.alpha_cutoff == b.alpha_cutoff && a.base_color == b.base_color &&
         a.base_color_texture.uv_from_mesh_uv == b.base_color_texture.uv_from_mesh_uv;
}

// The door of every call that may need much memory.
template <class Work>
auto guarded(Work work) -> decltype(work()) {
  return without_exceptions(
      refuse("not enough memory: ask for a smaller picture, fewer layers or smaller shadow maps").value(),
      work);
}

}  // namespace

struct Renderer::Implementation {
  Implementation(Scene s, const RendererOptions& options)
      : scene(std::move(s)),
        pool(options.threads),
        set(options.instruction_set.value_or(best_instruction_set())),
        time(options.time),
        poses(scene) {
    poses.apply(scene, time);
  }

  // Pictures are decoded and triangles cut into clusters at the same time.
  Result<void> load() {
    frame::TextureLoading pictures(scene, set, time);
    frame::MeshClustering clusters(scene);
    pool.for_each(pictures.task_count() + clusters.task_count(), [&](std::size_t task, int) {
      if (task < pictures.task_count()) {
        pictures.run(task);
      } else {
        clusters.run(task - pictures.task_count());
      }
    });
    Result<frame::TextureLibrary> library = pictures.finish();
    if (!library) return tl::unexpected(std::move(library.error()));
    textures = std::make_shared<frame::TextureLibrary>(std::move(*library));
    meshes = clusters.take();
    tell_warnings();
    return rebuild();
  }

  // What shines from all around; nothing where nothing does.
  Result<void> load_environment(const RendererOptions& options) {
    if (!scene.environment) return {};
    Result<image::EnvironmentMap> map = render::prepare_environment(
        scene, pool, set, options.environment_cache, options.environment_progress);
    if (!map) return tl::unexpected(std::move(map.error()));
    environment = std::make_unique<const image::EnvironmentMap>(std::move(*map));
    split_sum = std::make_unique<const shade::SplitSum>(shade::make_split_sum(pool));
    return {};
  }

  // Of pictures, each once, however often they are loaded.
  void tell_warnings() {
    for (const Diagnostic& warning : textures->warnings()) {
      if (std::find(scene.warnings.begin(), scene.warnings.end(), warning) == scene.warnings.end())
        scene.warnings.push_back(warning);
    }
  }

  // The frame anew, because what casts shadows has moved.
  Result<void> rebuild() {
    Result<frame::Frame> built = frame::Frame::build(scene, textures, meshes, pool);
    if (!built) return tl::unexpected(std::move(built.error()));
    frame = std::move(*built);
    forget_casters();
    return {};
  }

  // What is known of casters is of how they were.
  void forget_casters() {
    ++casters_revision;
    const std::lock_guard lock(casters_mutex);
    rays.reset();
    casters.reset();
    panes.reset();
    neighbours.reset();
    feathers.clear();
  }

  // Everything that clips move, where it is at a time. Lights and cameras are still to be placed.
  Result<PoseChanges> pose(double seconds) {
    const PoseChanges changes = poses.apply(scene, seconds);
    bool casters_changed = false;
    if (changes.materials) {
      const std::vector<frame::Surface> before = frame.surfaces;
      frame.make_surfaces(scene);
      casters_changed = !std::equal(before.begin(), before.end(), frame.surfaces.begin(), same_cut_outs);
    }
    if (changes.nodes) {
      const Result<frame::Reposed> reposed = frame.repose(scene, pool);
      if (!reposed) {
        // As it was before, which was sound.
        poses.apply(scene, time);
        frame.make_surfaces(scene);
        static_cast<void>(frame.repose(scene, pool));
        forget_casters();
        return tl::unexpected(reposed.error());
      }
      posing.primitives_posed += reposed->parts;
      posing.vertices_posed += reposed->vertices;
      casters_changed |= reposed->moves_casters;
    }
    if (casters_changed) {
      ++posing.casters_moved;
      forget_casters();
    }
    return changes;
  }

  // Whether a mesh hangs on the node or below it, or may hang on it by a skin.
  [[nodiscard]] bool carries_mesh(int node) const {
    if (!scene.skins.empty()) return true;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
      if (scene.nodes[i].mesh < 0) continue;
      for (int n = static_cast<int>(i); n >= 0; n = scene.nodes[static_cast<std::size_t>(n)].parent) {
        if (n == node) return true;
      }
    }
    return false;
  }

  std::shared_ptr<const trace::RayScene> ray_scene() const {
    const std::lock_guard lock(casters_mutex);
    if (rays == nullptr) rays = std::make_shared<const trace::RayScene>(frame);
    return rays;
  }

  std::shared_ptr<const shadow::CasterTree> caster_tree(shadow::CasterTree::Casters which) const {
    const std::lock_guard lock(casters_mutex);
    auto& tree = which == shadow::CasterTree::Casters::opaque ? casters : panes;
    if (tree == nullptr) tree = std::make_shared<const shadow::CasterTree>(frame, which);
    return tree;
  }

  // Which triangle lies across each edge: found when a shadow first asks, placed anew when casters have moved.
  const frame::TriangleNeighbours* triangle_neighbours() const {
    const std::lock_guard lock(casters_mutex);
    if (mesh_neighbours == nullptr) {
      mesh_neighbours =
          std::make_shared<const frame::MeshNeighbours>(frame::find_mesh_neighbours(scene, meshes, pool));
    }
    if (neighbours == nullptr) {
      neighbours = std::make_unique<const frame::TriangleNeighbours>(
          frame::place_neighbours(mesh_neighbours, scene, meshes));
    }
    return neighbours.get();
  }

  // One for each photograph, drawn when a picture first asks.
  const std::vector<image::MipChain>& photograph_feathers() const {
    const std::lock_guard lock(casters_mutex);
    StageTimes unused;
    for (std::size_t i = feathers.size(); i < frame.photographs.size(); ++i) {
      const light::ShadowView view = light::photograph_view(frame.photographs[i], render::kFeatherMapSide);
      const shadow::DepthMap depth =
          render::draw_depth_map({frame, pool, bins, set, unused}, view, CasterFaces::both, false);
      feathers.push_back(
          render::make_feather(depth, *frame.photographs[i].picture, scene.photograph_settings.feather));
    }
    return feathers;
  }

  // Photographs with what finds the surfaces that they see.
  shade::PhotographJob make_photograph_job(const raster::RasterView::Ray& ray, const RenderSettings& settings,
                                           const light::PhotographPlan& plan,
                                           render::ShadowCasting& casting) const {
    shade::PhotographJob job;
    const PhotographSettings& how = scene.photograph_settings;
    job.unseen = how.unseen;
    for (std::size_t i = 0; i < plan.photographs.size(); ++i) {
      const light::PlannedLight& planned = plan.photographs[i];
      const image::MipChain* feather = how.feather > 0 ? &photograph_feathers()[i] : nullptr;
      job.photographs.push_back(
          {shade::BoundPhotograph(frame.photographs[i], ray, how.blend, feather, settings.anisotropy),
           shade::LightReach(*planned.placed, ShadingModel::papers), casting.make(planned, planned.number)});
    }
    return job;
  }

  // Projectors that paint, with what finds the surfaces that they see.
  static std::vector<shade::ShaderDecal> make_decals(const raster::RasterView::Ray& ray,
                                                     const RenderSettings& settings,
                                                     std::span<const light::PlannedLight> plan,
                                                     render::ShadowCasting& casting) {
    std::vector<shade::ShaderDecal> decals;
    for (const light::PlannedLight& planned : plan) {
      decals.push_back({shade::BoundLight(*planned.placed, ray, ShadingModel::papers, settings.anisotropy),
                        shade::LightReach(*planned.placed, ShadingModel::papers),
                        casting.make(planned, planned.number)});
    }
    return decals;
  }

  // What a picture is planned to need of lights and what is used like them.
  struct PicturePlan {
    light::LightPlan lights;
    light::PhotographPlan photographs;
    std::vector<light::PlannedLight> decals;
  };

  // Everything the tiles share, with every shadow technique ready to answer.
  shade::ShaderJob make_job(const raster::RasterView& view, const RenderSettings& settings,
                            const PicturePlan& planned_picture, RenderStatistics& statistics,
                            ProgressReport& progress) const {
    const light::LightPlan& plan = planned_picture.lights;
    shade::ShaderJob job;
    job.frame = &frame;
    job.view = &view;
    job.reflection.model = settings.shading;
    job.reflection.phong = scene.phong;
    for (int i = 0; i < 3; ++i) job.reflection.ambient[i] = scene.ambient[i];
    job.interpolation = settings.interpolation;
    job.anisotropy = settings.anisotropy;
    job.samples_per_pixel = settings.samples;
    job.passes = settings.passes;
    if (environment != nullptr)
      job.environment.emplace(*scene.environment, *environment, *split_sum, scene.phong);
    const bool is_hidden = job.environment && job.environment->is_visible;
    job.background = scene.background && !is_hidden ? &*scene.background : nullptr;
    job.wanted = render::wanted_layers(settings);
    job.instruction_set = set;
    const raster::RasterView::Ray ray = view.homogeneous_ray();
    render::ShadowCasting casting(
        {frame, pool, set, casters_revision, bins, maps, [this] { return ray_scene(); },
         [this](shadow::CasterTree::Casters which) { return caster_tree(which); },
         [this] { return triangle_neighbours(); }, view, settings, statistics, progress});
    job.photographs = make_photograph_job(ray, settings, planned_picture.photographs, casting);
    job.decals = make_decals(ray, settings, planned_picture.decals, casting);
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
    return job;
  }

  // Where a picture goes. `image`: what holds the target, where the caller has no memory of its own.
  // Before a picture of a mean is drawn: brings the scene to the instant of that picture, and gives the view of it. Without,
  // all pictures are of one instant.
  using Expose = std::function<Result<View>(SampleIndex)>;
  struct Destination {
    const RenderTarget& target;
    const Preview& preview;
    const LayeredImage* image = nullptr;
    const Expose* expose = nullptr;
  };
  Result<RenderStatistics> draw(const View& from, const RenderSettings& settings,
                                const Destination& destination, const Progress& progress) const;
  RenderStatistics draw_picture(const View& from, const RenderSettings& settings, SampleIndex sample,
                                const render::PictureWriter& writer, ProgressReport& progress) const;
  Result<RenderStatistics> draw_mean(const View& from, const RenderSettings& settings,
                                     const Destination& destination, ProgressReport& progress) const;
  void draw_bands(const raster::RasterView& view, const RenderSettings& settings, shade::ShaderJob& job,
                  const render::PictureWriter& writer, RenderStatistics& statistics,
                  ProgressReport& progress) const;

  /// The light of that name in a plan.
  [[nodiscard]] static Result<light::PlannedLight> find_light(light::LightPlan plan, const std::string& name);
  [[nodiscard]] Result<light::PlannedLight> planned_light(const std::string& name) const;
  [[nodiscard]] Result<const frame::PlacedLight*> find_projector(const std::string& name) const;
  /// The light with the one shadow view of that face.
  [[nodiscard]] Result<light::PlannedLight> planned_face(const std::string& name, int face) const;
  [[nodiscard]] Result<LayeredImage> draw_channels(const View& view, const RenderSettings& settings,
                                                   const Progress& progress, RenderStatistics* statistics,
                                                   const Preview& preview,
                                                   const Expose* expose = nullptr) const;

  // While a picture is drawn. The last one out lets the shadow maps rest.
  class Drawing {
   public:
    explicit Drawing(const Implementation& of) : of_(of) { ++of_.pictures_drawn_now; }
    ~Drawing() {
      if (--of_.pictures_drawn_now == 0) of_.maps.rest();
      of_.bins.trim(kIdleBinMemory);
    }
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

   private:
    const Implementation& of_;
  };

  Scene scene;  // as it is posed now
  TaskPool pool;
  InstructionSet set;
  double time;
  ScenePose poses;
  PosingStatistics posing;
  std::shared_ptr<frame::TextureLibrary> textures;
  frame::ClusteredMeshes meshes;
  frame::Frame frame;
  std::unique_ptr<const image::EnvironmentMap> environment;
  std::unique_ptr<const shade::SplitSum> split_sum;
  std::uint64_t casters_revision = 0;
  mutable BinsPool bins;
  mutable render::DepthMapCache maps;
  mutable render::ReusePool<shadow::DepthMap> shown_maps;  // whose memory depth_map() draws into
  mutable std::atomic<int> pictures_drawn_now = 0;
  mutable std::mutex casters_mutex;
  mutable std::shared_ptr<const trace::RayScene> rays;
  mutable std::shared_ptr<const shadow::CasterTree> casters, panes;
  mutable std::shared_ptr<const frame::MeshNeighbours> mesh_neighbours;
  mutable std::unique_ptr<const frame::TriangleNeighbours> neighbours;
  mutable std::vector<image::MipChain> feathers;
};

Renderer::Renderer(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Result<Renderer> Renderer::create(Scene scene, const RendererOptions& options) {
  if (std::vector<Diagnostic> faults = validate(scene); !faults.empty()) {
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  }
  if (Result<void> checked = render::check_options(options); !checked) return tl::unexpected(checked.error());
  return guarded([&]() -> Result<Renderer> {
    render::add_default_light(scene);
    render::add_missing_tangents(scene);
    render::warn_of_open_sheets(scene);
    auto implementation = std::make_unique<Implementation>(std::move(scene), options);
    if (Result<void> built = implementation->load(); !built) return tl::unexpected(std::move(built.error()));
    if (Result<void> lit = implementation->load_environment(options); !lit)
      return tl::unexpected(std::move(lit.error()));
    return Renderer(std::move(implementation));
  });
}

const Scene& Renderer::scene() const { return implementation_->scene; }
int Renderer::threads() const { return implementation_->pool.threads(); }
InstructionSet Renderer::instruction_set() const { return implementation_->set; }

Result<View> Renderer::camera_view(const std::string& name, int width, int height) const {
  return render::camera_view(implementation_->frame, name, width, height);
}

View Renderer::overview(int width, int height) const {
  return render::overview(implementation_->frame, width, height);
}

// Triangles sorted by tile, then tiles shaded, one band of tile rows after the other.
void Renderer::Implementation::draw_bands(const raster::RasterView& view, const RenderSettings& settings,
                                          shade::ShaderJob& job, const render::PictureWriter& writer,
                                          RenderStatistics& statistics, ProgressReport& progress) const {
  const int tiles_x = raster::tiles_across(settings.width);
  const int tiles_y = raster::tiles_across(settings.height);
  const int bands = band_count(frame, tiles_y);
  std::vector<std::unique_ptr<shade::TileShader>> shaders(static_cast<std::size_t>(pool.threads()));
  std::vector<double> encode_ms(shaders.size());
  const auto binned = bins.take();
  raster::BinOptions options;
  options.cull = raster::CullFaces::single_sided;
  options.required_flags = kVisible;
  options.instruction_set = set;
  for (const shade::SampleOffset& offset : shade::sample_offsets(settings.samples, job.jitter)) {
    options.sample_reach = std::max({options.sample_reach, std::abs(offset.x), std::abs(offset.y)});
  }
  for (int band = 0; band < bands && !progress.is_cancelled(); ++band) {
    const int first_row = tiles_y * band / bands;
    const int end_row = tiles_y * (band + 1) / bands;
    Stopwatch watch;
    watch.start();
    options.pixels = {0, first_row * raster::kTileSide, settings.width,
                      std::min(end_row * raster::kTileSide, settings.height)};
    binned->fill(view, frame.geometry(), options, pool);
    job.batches = binned->batches();
    statistics.triangles += binned->statistics().triangles;
    statistics.triangles_drawn += binned->statistics().triangles_binned;
    statistics.picture_stages += binned->statistics().times;
    statistics.bin_ms += watch.lap_ms();

    pool.for_each(static_cast<std::size_t>(tiles_x * (end_row - first_row)), [&](std::size_t i, int worker) {
      if (progress.is_cancelled()) return;
      auto& shader = shaders[static_cast<std::size_t>(worker)];
      if (shader == nullptr) shader = std::make_unique<shade::TileShader>(job);
      const int x = static_cast<int>(i) % tiles_x;
      const int y = first_row + static_cast<int>(i) / tiles_x;
      const shade::TileResult& tile = shader->shade(x, y);
      Stopwatch encode_watch;
      encode_watch.start();
      writer.write(x, y, tile);
      encode_ms[static_cast<std::size_t>(worker)] += encode_watch.lap_ms();
      progress.advance();
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

// One picture: everything as it is at one sample of what is averaged.
RenderStatistics Renderer::Implementation::draw_picture(const View& from, const RenderSettings& settings,
                                                        SampleIndex sample,
                                                        const render::PictureWriter& writer,
                                                        ProgressReport& progress) const {
  Stopwatch watch;
  watch.start();
  RenderStatistics statistics;
  const PicturePlan plan = {light::make_light_plan(frame, {settings.shadows, sample, &from}),
                            light::make_photograph_plan(frame, scene.photograph_settings.visibility),
                            light::make_decal_plan(frame, settings.shadows)};
  statistics.plan_ms = watch.lap_ms();
  const raster::RasterView view(from, settings.width, settings.height);
  shade::ShaderJob job = make_job(view, settings, plan, statistics, progress);
  job.jitter = jitter_of(sample);
  statistics.shadow_ms = watch.lap_ms();
  if (!progress.is_cancelled()) draw_bands(view, settings, job, writer, statistics, progress);
  for (std::size_t i = 0; i < job.lights.size(); ++i)
    render::report_drawn(plan.lights.lights[i], job.lights[i].shadow.get(), statistics);
  statistics.total_ms = statistics.plan_ms + statistics.shadow_ms + watch.lap_ms();
  return statistics;
}

// The mean of pictures at different samples. The target has been checked.
Result<RenderStatistics> Renderer::Implementation::draw_mean(const View& from, const RenderSettings& settings,
                                                             const Destination& destination,
                                                             ProgressReport& progress) const {
  Stopwatch watch;
  watch.start();
  RenderStatistics statistics;
  render::PictureAccumulation pictures(settings, frame, pool);
  const auto write = [&] { pictures.write(settings, destination.target, set, frame); };
  for (int i = 0; i < settings.accumulate && !progress.is_cancelled(); ++i) {
    const SampleIndex sample = {i, settings.accumulate};
    const Result<View> view = destination.expose != nullptr ? (*destination.expose)(sample) : from;
    if (!view) return tl::unexpected(view.error());
    const Result<render::PictureWriter> writer =
        render::PictureWriter::create(pictures.picture_settings(), pictures.picture_target(), frame, set);
    const RenderStatistics one = draw_picture(*view, pictures.picture_settings(), sample, *writer, progress);
    if (progress.is_cancelled()) break;
    pictures.add();
    render::add_costs(statistics, one);
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

Result<RenderStatistics> Renderer::Implementation::draw(const View& from, const RenderSettings& settings,
                                                        const Destination& destination,
                                                        const Progress& progress) const {
  if (Result<void> checked = render::check_settings(settings, from); !checked)
    return tl::unexpected(checked.error());
  Result<render::PictureWriter> writer =
      render::PictureWriter::create(settings, destination.target, frame, set);
  if (!writer) return tl::unexpected(std::move(writer.error()));

  const Drawing drawing(*this);
  ProgressReport report(progress, static_cast<std::size_t>(raster::tiles_across(settings.width)) *
                                      static_cast<std::size_t>(raster::tiles_across(settings.height)) *
                                      static_cast<std::size_t>(settings.accumulate));
  Result<RenderStatistics> statistics = settings.accumulate == 1
                                            ? draw_picture(from, settings, {}, *writer, report)
                                            : draw_mean(from, settings, destination, report);
  if (report.is_cancelled())
    return tl::unexpected(Error(Failure::cancelled, Diagnostic{{}, {}, "cancelled"}));
  return statistics;
}

Result<RenderStatistics> Renderer::render_into(const View& view, const RenderSettings& settings,
                                               const RenderTarget& target, const Progress& progress,
                                               const Preview& preview) const {
  return guarded([&] { return implementation_->draw(view, settings, {target, preview}, progress); });
}

std::vector<std::string> Renderer::channel_names(const RenderSettings& settings) const {
  std::vector<std::string> names;
  for (const render::PictureChannel& channel : render::picture_channels(settings, implementation_->frame)) {
    names.push_back(channel.name);
  }
  return names;
}

Result<LayeredImage> Renderer::Implementation::draw_channels(const View& view, const RenderSettings& settings,
                                                             const Progress& progress,
                                                             RenderStatistics* statistics,
                                                             const Preview& preview,
                                                             const Expose* expose) const {
  if (Result<void> checked = render::check_settings(settings, view); !checked)
    return tl::unexpected(checked.error());
  LayeredImage image;
  image.width = settings.width;
  image.height = settings.height;
  RenderTarget target;
  const auto stride = static_cast<std::size_t>(settings.width);
  for (const render::PictureChannel& channel : render::picture_channels(settings, frame)) {
    image.channels.push_back(
        {channel.name, std::vector<float>(stride * static_cast<std::size_t>(settings.height))});
  }
  for (Channel& channel : image.channels)
    target.channels.push_back({channel.name, channel.values.data(), stride});
  image.metadata = render::describe(settings, view, frame);
  Result<RenderStatistics> done = draw(view, settings, {target, preview, &image, expose}, progress);
  if (!done) return tl::unexpected(std::move(done.error()));
  if (statistics != nullptr) *statistics = *done;
  return image;
}

Result<LayeredImage> Renderer::render(const View& view, const RenderSettings& settings,
                                      const Progress& progress, RenderStatistics* statistics,
                                      const Preview& preview) const {
  return guarded(
      [&] { return implementation_->draw_channels(view, settings, progress, statistics, preview); });
}

Result<LayeredImage> Renderer::render_exposed(const View& view, const RenderSettings& settings,
                                              const Shutter& shutter, const Progress& progress,
                                              RenderStatistics* statistics, const Preview& preview) {
  const double middle = time();
  if (Result<void> checked = render::check_shutter(shutter.seconds, middle); !checked)
    return tl::unexpected(checked.error());
  const Implementation::Expose expose = [&](SampleIndex sample) -> Result<View> {
    const double instant = middle + shutter.seconds * (sample_number(sample, SampleDimension::instant) - 0.5);
    if (const Result<int> posed = set_time(instant); !posed) return tl::unexpected(posed.error());
    return shutter.view_now ? shutter.view_now(*this) : view;
  };
  Result<LayeredImage> image = guarded(
      [&] { return implementation_->draw_channels(view, settings, progress, statistics, preview, &expose); });
  const Result<int> restored = set_time(middle);
  if (image && !restored) return tl::unexpected(restored.error());
  return image;
}

Result<ProbeReport> Renderer::measure_probes(std::span<const Probe> probes, const ProbeSettings& settings,
                                             const Progress& progress) const {
  if (Result<void> checked = render::check_probes(probes, settings); !checked)
    return tl::unexpected(checked.error());
  const Implementation& self = *implementation_;
  return guarded([&]() -> Result<ProbeReport> {
    ProgressReport report(progress, render::probe_steps(probes, settings));
    ProbeReport measured =
        render::measure_probes({self.frame, self.pool, self.set, self.ray_scene(), report}, probes, settings);
    if (report.is_cancelled())
      return tl::unexpected(Error(Failure::cancelled, Diagnostic{{}, {}, "cancelled"}));
    return measured;
  });
}

Result<std::vector<Probe>> Renderer::probes_on_object(const std::string& object, double spacing) const {
  return guarded([&] { return render::probes_on_object(implementation_->frame, object, spacing); });
}

Result<void> Renderer::set_transform(int node, const glm::dmat4& parent_from_node) {
  Implementation& self = *implementation_;
  if (node < 0 || static_cast<std::size_t>(node) >= self.scene.nodes.size()) {
    return refuse("the scene has no node " + std::to_string(node));
  }
  glm::dmat4& place = self.scene.nodes[static_cast<std::size_t>(node)].parent_from_node;
  const glm::dmat4 before = place;
  place = parent_from_node;
  std::vector<Diagnostic> faults = validate(self.scene);
  if (faults.empty()) {
    self.poses.set_node(node, parent_from_node);
    self.poses.apply(self.scene, self.time);
    if (!self.carries_mesh(node)) {
      self.frame.place_lights_and_cameras(self.scene);
      return {};
    }
  }
  Result<void> built = faults.empty() ? guarded([&] { return self.rebuild(); })
                                      : tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  if (!built) {
    place = before;
    self.poses.set_node(node, before);
  }
  return built;
}

Result<void> Renderer::set_light(int light, Light value) {
  Implementation& self = *implementation_;
  if (light < 0 || static_cast<std::size_t>(light) >= self.scene.lights.size()) {
    return refuse("the scene has no light " + std::to_string(light));
  }
  Light& place = self.scene.lights[static_cast<std::size_t>(light)];
  std::swap(place, value);
  if (std::vector<Diagnostic> faults = validate(self.scene); !faults.empty()) {
    std::swap(place, value);
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  }
  self.poses.set_light(light, place);
  self.poses.apply(self.scene, self.time);
  const std::vector<int> decals = frame::decal_lights(self.scene);
  const bool is_decal = std::find(decals.begin(), decals.end(), light) != decals.end();
  const auto is_missing = [&](image::MipUse use) { return self.textures->find(place.slide, use) == nullptr; };
  if (place.slide >= 0 &&
      (is_missing(frame::slide_use(place)) || (is_decal && is_missing(frame::kLayerUse)))) {
    Result<void> loaded = guarded([&] { return self.load(); });
    if (!loaded) {
      std::swap(place, value);
      self.poses.set_light(light, place);
    }
    return loaded;
  }
  self.frame.place_lights_and_cameras(self.scene);
  return {};
}

Result<void> Renderer::set_photograph_gains(std::span<const glm::vec3> gains) {
  std::vector<Photograph>& photographs = implementation_->scene.photographs;
  if (gains.size() != photographs.size()) {
    return refuse("expected a gain for each of " + std::to_string(photographs.size()) + " photographs, got " +
                  std::to_string(gains.size()));
  }
  std::vector<Photograph> before = photographs;
  for (std::size_t i = 0; i < gains.size(); ++i) photographs[i].gain = gains[i];
  if (std::vector<Diagnostic> faults = validate(implementation_->scene); !faults.empty()) {
    for (std::size_t i = 0; i < gains.size(); ++i) photographs[i].gain = before[i].gain;
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  }
  return {};
}

Result<int> Renderer::set_time(double seconds) {
  Implementation& self = *implementation_;
  if (Result<void> checked = render::check_time(seconds); !checked) return tl::unexpected(checked.error());
  return guarded([&]() -> Result<int> {
    Result<int> changed = self.textures->show(seconds);
    if (!changed) return changed;
    const Result<PoseChanges> moved = self.pose(seconds);
    if (!moved) {
      static_cast<void>(self.textures->show(self.time));
      return tl::unexpected(moved.error());
    }
    self.time = seconds;
    if (*changed > 0 || moved->nodes || moved->cameras || moved->lights)
      self.frame.place_lights_and_cameras(self.scene);
    return changed;
  });
}

double Renderer::time() const { return implementation_->time; }

PosingStatistics Renderer::posing_statistics() const { return implementation_->posing; }

Renderer::Box Renderer::bounds() const {
  const frame::Bounds& bounds = implementation_->frame.bounds;
  return {glm::dvec3(bounds.low), glm::dvec3(bounds.high)};
}

namespace {

/// Says which there are. `light_of(item)`: the light, or null where it is not what is missed.
template <class Items, class LightOf>
tl::unexpected<Error> refuse_missing(const std::string& missed, const Items& items, LightOf light_of) {
  std::string names;
  for (const auto& item : items) {
    const Light* light = light_of(item);
    if (light != nullptr) names += (names.empty() ? "\"" : ", \"") + light->name + "\"";
  }
  return refuse("the scene has no " + missed + ": " + (names.empty() ? "it has none" : "it has " + names));
}

}  // namespace

Result<light::PlannedLight> Renderer::Implementation::find_light(light::LightPlan plan,
                                                                 const std::string& name) {
  for (light::PlannedLight& planned : plan.lights) {
    if (planned.placed->light->name == name) return std::move(planned);
  }
  return refuse_missing("light \"" + name + "\"", plan.lights,
                        [](const light::PlannedLight& planned) { return planned.placed->light; });
}

Result<light::PlannedLight> Renderer::Implementation::planned_light(const std::string& name) const {
  Result<light::PlannedLight> planned =
      find_light(light::make_light_plan(frame, {ShadowTechnique::map, {}, nullptr}), name);
  // Where a light asks for no shadow map, the one it would have is shown.
  if (planned) planned = light::with_shadow_map(std::move(*planned), frame);
  return planned;
}

namespace {

std::vector<ShadowMapView> views_of(const light::PlannedLight& planned) {
  std::vector<ShadowMapView> views;
  for (const light::ShadowView& shadow : planned.shadow_views) {
    views.push_back({shadow.warp ? shadow.warp->light_view : shadow.view, shadow.width, shadow.height,
                     shadow.image_from_world()});
  }
  return views;
}

}  // namespace

Result<std::vector<ShadowMapView>> Renderer::shadow_map_views(const std::string& light, const View& camera,
                                                              const RenderSettings& settings) const {
  const Implementation& self = *implementation_;
  if (Result<void> checked = render::check_settings(settings, camera); !checked)
    return tl::unexpected(checked.error());
  const Result<light::PlannedLight> planned =
      Implementation::find_light(light::make_light_plan(self.frame, {settings.shadows, {}, &camera}), light);
  return planned.map(views_of);
}

std::vector<std::string> Renderer::idle_projectors() const {
  return render::idle_projectors(implementation_->frame);
}

Result<View> Renderer::light_view(const std::string& name) const {
  const Result<light::PlannedLight> planned = implementation_->planned_light(name);
  if (!planned) return tl::unexpected(planned.error());
  if (planned->shadow_views.size() == 1) return planned->shadow_views[0].view;
  return refuse("light \"" + name + "\" shines all round: it has no one view");
}

Result<const frame::PlacedLight*> Renderer::Implementation::find_projector(const std::string& name) const {
  const auto projector_of = [](const frame::PlacedLight& placed) {
    return placed.light->type == LightType::projector ? placed.light : nullptr;
  };
  for (const frame::PlacedLight& placed : frame.lights) {
    const Light* projector = projector_of(placed);
    if (projector != nullptr && projector->name == name) return &placed;
  }
  return refuse_missing("projector \"" + name + "\" that is on", frame.lights, projector_of);
}

Result<std::optional<glm::dvec2>> Renderer::slide_from_world(const std::string& projector,
                                                             const glm::dvec3& point_ws) const {
  return implementation_->find_projector(projector).map(
      [&](const frame::PlacedLight* placed) { return frame::slide_from_world(*placed, point_ws); });
}

Result<glm::dvec3> Renderer::world_from_slide(const std::string& projector, glm::dvec2 slide,
                                              double distance) const {
  const Result<const frame::PlacedLight*> placed = implementation_->find_projector(projector);
  if (!placed) return tl::unexpected(placed.error());
  const std::optional<glm::dvec3> point = frame::world_from_slide(**placed, slide, distance);
  if (!point) return refuse("the lens of \"" + projector + "\" throws that place nowhere");
  return *point;
}

Result<std::vector<ShadowMapView>> Renderer::depth_map_views(const std::string& light) const {
  return implementation_->planned_light(light).map(views_of);
}

Result<light::PlannedLight> Renderer::Implementation::planned_face(const std::string& name, int face) const {
  Result<light::PlannedLight> planned = planned_light(name);
  if (!planned) return planned;
  const int count = static_cast<int>(planned->shadow_views.size());
  if (face < 0 || face >= count) {
    return refuse("light \"" + name + "\" has " + std::to_string(count) +
                  (count == 1 ? " depth map" : " depth maps") + ", counted from 0; there is no number " +
                  std::to_string(face));
  }
  planned->shadow_views = {planned->shadow_views[static_cast<std::size_t>(face)]};
  return planned;
}

namespace {

// Rows of metres, from the top.
LayeredImage metres_of(const shadow::DepthMap& map) {
  LayeredImage image;
  image.width = map.width();
  image.height = map.height();
  image.channels.push_back({"Z", {}});
  std::vector<float>& values = image.channels[0].values;
  values.reserve(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()));
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) values.push_back(static_cast<float>(map.distance(x, y)));
  }
  return image;
}

}  // namespace

Result<LayeredImage> Renderer::depth_map(const std::string& light, int face,
                                         RenderStatistics* statistics) const {
  const Implementation& self = *implementation_;
  const Result<light::PlannedLight> planned = self.planned_face(light, face);
  if (!planned) return tl::unexpected(planned.error());
  return guarded([&]() -> Result<LayeredImage> {
    RenderStatistics cost;
    Stopwatch watch;
    watch.start();
    const auto map = self.shown_maps.take();
    *map = render::draw_depth_map({self.frame, self.pool, self.bins, self.set, cost.map_stages},
                                  planned->shadow_views[0], planned->settings.caster_faces, false,
                                  std::move(*map));
    cost.shadow_ms = cost.total_ms = watch.lap_ms();
    cost.maps_drawn = 1;
    if (statistics != nullptr) *statistics = cost;
    self.bins.trim(kIdleBinMemory);
    return metres_of(*map);
  });
}

}  // namespace laterna
