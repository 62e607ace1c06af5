// Pictures of a posed scene: what the tiles share is put together, light by light, and the tiles are drawn.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "image/environment_map.h"
#include "image/mip_chain.h"
#include "laterna/render.h"
#include "light/light_plan.h"
#include "light/photograph_plan.h"
#include "raster/raster_view.h"
#include "render/depth_map_cache.h"
#include "render/mirror_drawing.h"
#include "render/picture_writer.h"
#include "render/posed_scene.h"
#include "render/progress_report.h"
#include "render/reuse_pool.h"
#include "render/shadow_casting.h"
#include "shade/sheen_albedo.h"
#include "shade/split_sum.h"
#include "shade/tile_shader.h"

namespace laterna::render {

/// Keeps from picture to picture what costs much to make: shadow maps, their memory, sorted triangles. May draw several
/// pictures at once.
class PictureDrawer {
 public:
  /// Both must outlive it.
  PictureDrawer(const PosedScene& posed, const TaskPool& pool, InstructionSet instruction_set,
                std::uint64_t cache_bytes)
      : posed_(posed),
        pool_(pool),
        instruction_set_(instruction_set),
        cache_bytes_(cache_bytes),
        maps_(posed.caster_changes()),
        paraboloids_(posed.caster_changes()) {}

  /// What shines from all around is made ready; nothing where nothing does. So are tables that materials ask for.
  Result<void> load_environment(const RendererOptions& options);

  /// Error: a mirror that is not flat.
  [[nodiscard]] Result<void> check_mirrors() const;

  /// Before a picture of a mean is drawn: brings the scene to the instant of that picture, and gives the view of it.
  /// Without, all pictures are of one instant.
  using Expose = std::function<Result<View>(SampleIndex)>;
  /// Where a picture goes. `image`: what holds the target, where the caller has no memory of its own.
  struct Destination {
    const RenderTarget& target;
    const Preview& preview;
    const LayeredImage* image = nullptr;
    const Expose* expose = nullptr;
  };
  [[nodiscard]] Result<RenderStatistics> draw(const View& from, const RenderSettings& settings,
                                              const Destination& destination, const Progress& progress) const;
  /// draw() into memory of its own.
  [[nodiscard]] Result<LayeredImage> draw_channels(const View& view, const RenderSettings& settings,
                                                   const Progress& progress, RenderStatistics* statistics,
                                                   const Preview& preview,
                                                   const Expose* expose = nullptr) const;
  /// The light's first shadow view: one channel, Z, in metres, rows from the top.
  [[nodiscard]] LayeredImage draw_distances(const light::PlannedLight& planned,
                                            RenderStatistics& statistics) const;

 private:
  // What a picture is planned to need of lights and what is used like them.
  struct PicturePlan {
    light::LightPlan lights;
    light::PhotographPlan photographs;
    std::vector<light::PlannedLight> decals;
  };
  // Between pictures.
  void let_caches_rest() const;
  // While pictures are drawn. The last one out lets the shadow maps rest.
  class Drawing;

  [[nodiscard]] const frame::Frame& frame() const { return posed_.frame(); }
  [[nodiscard]] const std::vector<image::MipChain>& photograph_feathers() const;
  [[nodiscard]] shade::PhotographJob make_photograph_job(const raster::RasterView::Ray& ray,
                                                         const RenderSettings& settings,
                                                         const light::PhotographPlan& plan,
                                                         ShadowCasting& casting) const;
  [[nodiscard]] shade::ShaderJob make_job(const raster::RasterView& view, const RenderSettings& settings,
                                          const PicturePlan& planned_picture,
                                          const std::vector<int>& reflections, RenderStatistics& statistics,
                                          ProgressReport& progress) const;
  void add_lights(const raster::RasterView::Ray& ray, const RenderSettings& settings,
                  const light::LightPlan& plan, ShadowCasting& casting, ProgressReport& progress,
                  shade::ShaderJob& job) const;
  void draw_bands(const raster::RasterView& view, const RenderSettings& settings, shade::ShaderJob& job,
                  const PicturePart& part, RenderStatistics& statistics, ProgressReport& progress) const;
  [[nodiscard]] bool looks_through(const RenderSettings& settings) const;
  Result<shade::EarlierView> draw_behind(const raster::RasterView& view, const RenderSettings& settings,
                                         const PicturePart& part, shade::ShaderJob& job,
                                         RenderStatistics& statistics, ProgressReport& progress) const;
  Result<void> draw_part(const View& from, const RenderSettings& settings, SampleIndex sample,
                         const PicturePart& part, shade::MirrorJob mirrors, RenderStatistics& statistics,
                         ProgressReport& progress) const;
  Result<shade::MirrorJob> draw_mirrors(const View& from, const RenderSettings& settings, SampleIndex sample,
                                        RenderStatistics& statistics, ProgressReport& progress) const;
  Result<RenderStatistics> draw_picture(const View& from, const RenderSettings& settings, SampleIndex sample,
                                        const PictureWriter& writer, ProgressReport& progress) const;
  Result<RenderStatistics> draw_mean(const View& from, const RenderSettings& settings,
                                     const Destination& destination, ProgressReport& progress) const;

  const PosedScene& posed_;
  const TaskPool& pool_;
  InstructionSet instruction_set_;
  std::uint64_t cache_bytes_;  // that are kept between pictures
  std::unique_ptr<const image::EnvironmentMap> environment_;
  std::unique_ptr<const shade::SplitSum> split_sum_;  // of environments and transmission
  std::unique_ptr<const shade::SheenAlbedo> sheen_;
  mutable BinsPool bins_;
  mutable DepthMapCache maps_;
  mutable ParaboloidMapCache paraboloids_;
  mutable ReusePool<shadow::DepthMap> shown_maps_;  // whose memory draw_distances() draws into
  mutable std::mutex drawing_mutex_;
  mutable int pictures_drawn_now_ = 0;
  mutable std::mutex feathers_mutex_;
  mutable std::uint64_t feathers_revision_ = 0;  // of the casters that they were drawn of
  mutable std::vector<image::MipChain> feathers_;
};

}  // namespace laterna::render
