// A scene made ready, and pictures of it. A Renderer may be asked by several threads at once; it has no global state,
// and what it gives depends on neither the number of threads nor the instruction set.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/image.h"
#include "laterna/instruction_set.h"
#include "laterna/result.h"
#include "laterna/scene.h"
#include "laterna/shading.h"
#include "laterna/stages.h"
#include "laterna/view.h"

namespace laterna {

/// Groups of channels beside beauty; list_layers() describes them.
enum class Layer : std::uint8_t {
  /// ambient.R/G/B, light.<name>.R/G/B and, where there is one, environment.R/G/B, and of scenes with mirrors
  /// reflection.R/G/B; beauty is their sum in this order, bit for bit
  light,
  visibility,  ///< visibility.<name>: the fraction α of the light that arrives
  uv,          ///< uv.<name>.u/.v: slide coordinates of projectors, NaN outside the frame
  lux,         ///< lux.Y: direct illuminance of the surface in lux
  depth,       ///< Z: metres along the axis, +infinity where nothing is
  position,    ///< P.X/Y/Z: world, metres
  normal,      ///< N.X/Y/Z: shading normal, world
  albedo,      ///< albedo.R/G/B: base colour, linear
  /// photo.seen: how many photographs see the surface, −1 where nothing is; photo.weight.<name>: each one's share of the
  /// colour; photo.color.<name>.R/G/B: its linear colour before gain, NaN where it does not see the surface
  photographs,
  object,     ///< id.object: number of the object, −1 where nothing is; names in the metadata
  passes,     ///< pass.*: the frame buffer after each pass, with Passes::multi
  luminance,  ///< luminance.Y: cd/m² toward the camera, where shading is pbr; otherwise the picture's luminance
  /// pixel_density.<name>: of each projector, pixels per metre of the surface, in the sparser direction.
  pixel_density,
};
struct LayerDescription {
  Layer layer;
  std::string_view name;      ///< on the command line
  std::string_view channels;  ///< in files
  std::string_view meaning;
};
std::span<const LayerDescription> list_layers();

/// Pictures of one mean.
inline constexpr int kMaxAccumulated = 65536;

struct RenderSettings {
  int width = 1280, height = 720;  ///< 1…16384 each
  int samples = 1;                 ///< per pixel: 1, 2, 4, 8 or 16
  ShadingModel shading = ShadingModel::pbr;
  ShadowTechnique shadows = ShadowTechnique::map;  ///< for lights that name none
  Passes passes = Passes::single;
  Interpolation interpolation = Interpolation::perspective;
  int anisotropy = 8;  ///< most probes of a stretched texture footprint, 1…16
  std::vector<Layer> layers;
  /// The picture is the mean of this many, which differ in where they sample each pixel, from where on a light with a size it
  /// shines, and through which point of its lens a projector throws its slide. 1: one, from the middle of all. 1…kMaxAccumulated.
  int accumulate = 1;
  /// No more pictures than it takes for this estimated noise, a fraction of the mean luminance. 0: all.
  double noise = 0;
  /// How many mirrors are seen one in the other (laterna/mirrors.h): 0 … kMaxMirrorDepth. The last are plain surfaces.
  int mirror_depth = 2;
  bool keep_shadow_maps = true;  ///< false: drawn anew even where nothing has changed
};

/// Called now and then with the fraction done, in [0, 1], from one thread at a time; false asks to stop.
using Progress = std::function<bool(double fraction)>;

/// Where pixels go. Rows from the top, `row_stride` in elements.
struct ColorTarget8 {
  std::uint8_t* pixels = nullptr;  ///< sRGB-encoded
  int channels = 3;                ///< 3: R, G, B; 4: with alpha, colour not premultiplied
  std::size_t row_stride = 0;
  float exposure = 1;  ///< factor on linear light before encoding
};
struct ChannelTarget {
  std::string name;  ///< a channel's name, such as "R", "Z" or "light.sun.G"
  float* pixels = nullptr;
  std::size_t row_stride = 0;
};
struct RenderTarget {
  std::optional<ColorTarget8> color8;
  std::vector<ChannelTarget> channels;
};

/// A mean of pictures as far as it has come (RenderSettings::accumulate).
struct PartialMean {
  int pictures = 0;  ///< averaged so far
  double noise = 0;  ///< as RenderStatistics::noise
  /// Writes it where the picture goes, as if it were the last; costs little beside a picture. Valid during the call only.
  std::function<void()> write;
  /// What write() fills in, where Renderer::render() was called; with the caller's own memory null.
  const LayeredImage* image = nullptr;
};
/// Called after each picture of a mean, from one thread; false: the mean of what there is will do.
using Preview = std::function<bool(const PartialMean&)>;

/// What a picture cost.
struct RenderStatistics {
  // Phases, one after the other, by the clock:
  double plan_ms = 0;  ///< lights' matrices
  /// Sorting what casts shadows. Shadow maps are drawn while shading, where they are asked for; here, where there are so
  /// many that their sorted casters would take over 1 GB.
  double shadow_ms = 0;
  double bin_ms = 0;    ///< culling, transforming, clipping, sorting by tile
  double shade_ms = 0;  ///< rasterising and shading
  double total_ms = 0;
  // What they are made of, summed over threads:
  StageTimes map_stages;      ///< of all shadow maps drawn
  StageTimes picture_stages;  ///< of the camera's view
  std::uint64_t triangles = 0,
                triangles_drawn = 0;  ///< of the camera's view: considered, and sorted into tiles
  int maps_drawn = 0, maps_kept = 0;  ///< shadow maps: made, or changed in part; and left as they were
  /// What was redone of shadow maps, and what was not (docs/caches.md). Tiles are 64 × 64 texels, drawn when a sample asks
  /// for them.
  struct MapReuse {
    int maps_updated = 0;             ///< of maps_drawn: only where something moved
    std::uint64_t tiles_kept = 0;     ///< that were drawn for earlier pictures
    std::uint64_t tiles_updated = 0;  ///< what moves was drawn over what stands
    std::uint64_t tiles_drawn = 0;    ///< with everything in them
    /// Sorted into maps: all casters, or those that stand; and those that move, over them.
    std::uint64_t triangles = 0, moving_triangles = 0;
    std::size_t bytes = 0;  ///< kept when the picture was done
  };
  MapReuse map_reuse;
  int mirror_pictures = 0;  ///< drawn of what mirrors show
  int pictures = 1;         ///< that were averaged
  /// Estimated standard error of the picture's luminance, over all pixels, as a fraction of its mean. 0 for one picture.
  double noise = 0;
  struct LightMemory {
    std::string light;
    int maps = 0;
    std::size_t bytes = 0;
  };
  std::vector<LightMemory> shadow_memory;
  /// Of each light with projected silhouettes (rows 38, 47).
  struct SilhouetteWork {
    std::string light;
    std::size_t objects = 0;            ///< that cast or receive
    std::size_t pairs = 0;              ///< of an occluder and a receiver that it may shade
    std::size_t silhouettes = 0;        ///< one for each occluder, six where it is all round the light
    std::size_t silhouettes_drawn = 0;  ///< those that a sample in the picture asked for
  };
  std::vector<SilhouetteWork> silhouettes;
};

/// What changes of time have made anew.
struct PosingStatistics {
  std::uint64_t primitives_posed = 0;  ///< instances of primitives whose vertices were calculated again
  std::uint64_t casters_moved = 0;     ///< changes of time that moved something which casts shadows
  std::uint64_t vertices_posed = 0;
};

/// How much RendererOptions::environment_cache holds at most; what was not used for longest goes first.
inline constexpr std::uint64_t kEnvironmentCacheBytes = std::uint64_t{1} << 30;

/// RendererOptions::cache_bytes, unless set.
inline constexpr std::uint64_t kDefaultCacheBytes = std::uint64_t{4} << 30;
inline constexpr std::uint64_t kMaxCacheBytes = std::uint64_t{1} << 40;

struct RendererOptions {
  int threads = 0;                                ///< 0: one per processor
  std::optional<InstructionSet> instruction_set;  ///< unset: the best this machine has
  double time = 0;                                ///< scene time in seconds: see Renderer::set_time
  /// A folder in which what was worked out from environments is kept from run to run; empty: nowhere. At most
  /// kEnvironmentCacheBytes; what cannot be read or written there is worked out anew.
  std::filesystem::path environment_cache = {};
  /// Shadow maps, what stands still in them and its sorted triangles take no more than this between pictures; what was not
  /// used for longest is given up first. 0: nothing is kept. At most kMaxCacheBytes.
  std::uint64_t cache_bytes = kDefaultCacheBytes;
  Progress environment_progress = {};  ///< of working out the environment; what it returns is not looked at
};

/// A shadow map, as seen by its light.
struct ShadowMapView {
  View view;                  ///< a warped map's: as it would be without
  int width = 0, height = 0;  ///< texels
  /// As View::image_from_world(), with the warp.
  glm::dmat4 image_from_world{1.0};
};

class Renderer;
/// How long the pictures of a mean (RenderSettings::accumulate) are exposed: each is of an instant of its own, and what moves
/// meanwhile is blurred (Haeberli and Akeley 1990, section 4.1).
struct Shutter {
  /// Of scene time, half before the renderer's time and half after it; 0 … kMaxSceneTime. The first picture is of the middle.
  double seconds = 0;
  std::function<Result<View>(const Renderer&)> view_now =
      {};  ///< at the renderer's time; unset: the view does not move
};

struct Probe;
struct ProbeSettings;
struct ProbeReport;

class Renderer {
 public:
  /// Validates the scene, decodes its pictures and lays out its triangles.
  /// A scene with neither a light nor ambient light set is given a "default sun" over the viewer's shoulder and a
  /// little ambient light: scene() then holds them, and a warning that says so.
  static Result<Renderer> create(Scene scene, const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  [[nodiscard]] const Scene& scene() const;
  [[nodiscard]] int threads() const;
  [[nodiscard]] InstructionSet instruction_set() const;

  /// The view of a camera of the scene for a picture of width × height; an empty name is the first camera.
  /// Error: no camera of that name; lists those that are there.
  [[nodiscard]] Result<View> camera_view(const std::string& name, int width, int height) const;
  /// A view of the whole scene from in front and a little above, for scenes without a camera.
  [[nodiscard]] View overview(int width, int height) const;
  /// What a light sees: the view of its shadow map. Error: no such light, or one that shines all round.
  [[nodiscard]] Result<View> light_view(const std::string& name) const;

  /// The place on a projector's slide, (0, 0) its top-left corner, that lights a point, with the distortion of its lens;
  /// outside [0, 1] beyond the frame. Nothing behind the lens, or where a distorting one throws nothing.
  /// Error: no projector of that name.
  [[nodiscard]] Result<std::optional<glm::dvec2>> slide_from_world(const std::string& projector,
                                                                   const glm::dvec3& point_ws) const;
  /// The other way: where a place of the slide is seen on a wall square to the beam, `distance` metres along its axis.
  /// Error: no projector of that name, or its lens throws that place nowhere.
  [[nodiscard]] Result<glm::dvec3> world_from_slide(const std::string& projector, glm::dvec2 slide,
                                                    double distance) const;

  /// Names of all channels that `settings` produce, in the order of a file.
  [[nodiscard]] std::vector<std::string> channel_names(const RenderSettings& settings) const;

  /// Draws into the caller's memory. Shadow maps are kept from call to call while lights and casters stay.
  Result<RenderStatistics> render_into(const View& view, const RenderSettings& settings,
                                       const RenderTarget& target, const Progress& progress = {},
                                       const Preview& preview = {}) const;
  /// Draws all channels, with metadata. R, G, B are linear and unclamped; A is coverage, colour premultiplied by it.
  Result<LayeredImage> render(const View& view, const RenderSettings& settings, const Progress& progress = {},
                              RenderStatistics* statistics = nullptr, const Preview& preview = {}) const;

  /// The same of what moves while a shutter is open. Afterwards the renderer is at the time at which it was.
  /// Error: as of set_time(), `view_now` or render(); a shutter that is open for less than no time, or beyond ±kMaxSceneTime.
  Result<LayeredImage> render_exposed(const View& view, const RenderSettings& settings,
                                      const Shutter& shutter, const Progress& progress = {},
                                      RenderStatistics* statistics = nullptr, const Preview& preview = {});

  /// Illuminance at points, light by light (laterna/probes.h). What shadows each light has is found by rays, whatever its
  /// technique; lights without shadows pass through everything here too. Error: a faulty probe or setting.
  [[nodiscard]] Result<ProbeReport> measure_probes(std::span<const Probe> probes,
                                                   const ProbeSettings& settings,
                                                   const Progress& progress = {}) const;
  /// Probes all over an object (a name in id.object), on the outer side of every triangle: where lines parallel to the
  /// world axis that the triangle faces most meet it, `spacing` metres apart. Error: no such object, or too many probes.
  [[nodiscard]] Result<std::vector<Probe>> probes_on_object(const std::string& object, double spacing) const;

  /// Projectors that are on and in whose beam, and nearer than their far plane, there is no surface at all, as far as
  /// surfaces' bounds tell. Their names, in the scene's order.
  [[nodiscard]] std::vector<std::string> idle_projectors() const;

  /// Moves a node, or replaces a light. What does not depend on it is kept. Warnings of a film that a new slide is (it ends
  /// early) are added to scene().warnings. Not to be called during a render.
  Result<void> set_transform(int node, const glm::dmat4& parent_from_node);
  Result<void> set_light(int light, Light value);

  /// Sets Photograph::gain of every photograph, in their order. Not to be called during a render.
  /// Error: another number of gains than photographs, or one that is not finite and above 0.
  Result<void> set_photograph_gains(std::span<const glm::vec3> gains);
  /// Scene time in seconds, within ±kMaxSceneTime: every film shows its frame of that time, and what clips move is where it
  /// then is: a picture is the one that a renderer made at that time draws, bit for bit. Returns how many films show another
  /// frame than before. Only what moved is made anew; shadow maps are kept where no caster did. Frames of films at evenly
  /// spaced times, forward or backward, are made ready ahead. Not to be called during a render. Error: a frame that cannot be
  /// read, or something moves farther out than kMaxCoordinate; the time and everything else then stay as they were.
  Result<int> set_time(double seconds);
  [[nodiscard]] double time() const;
  /// What it has cost since the renderer was made.
  [[nodiscard]] PosingStatistics posing_statistics() const;

  /// The box around all surfaces, as they are posed now. Empty scenes: low = high = 0.
  struct Box {
    glm::dvec3 low_ws{0}, high_ws{0};
  };
  [[nodiscard]] Box bounds() const;

  /// The depth maps of a light's shadow maps: one, or six for a light that shines all round. Channel "Z": metres along
  /// the map's axis, +infinity where nothing is. `statistics`: what drawing cost, up to the conversion to metres.
  /// Error: no such light, no such face. depth_map_views() draws nothing.
  [[nodiscard]] Result<std::vector<ShadowMapView>> depth_map_views(const std::string& light) const;
  [[nodiscard]] Result<LayeredImage> depth_map(const std::string& light, int face = 0,
                                               RenderStatistics* statistics = nullptr) const;

  /// The shadow maps that a picture of `camera` reads for a light: one, six faces, or cascades, the finest first; empty
  /// where its technique draws none. Error: no such light, or a technique that a light cannot have.
  [[nodiscard]] Result<std::vector<ShadowMapView>> shadow_map_views(const std::string& light,
                                                                    const View& camera,
                                                                    const RenderSettings& settings) const;

 private:
  struct Implementation;
  explicit Renderer(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// 2^stops: the same number on every machine.
float exposure_from_stops(double stops);

/// Factor that brings a picture's log-mean luminance to middle grey (0.18), from its R, G, B and A channels (Reinhard
/// et al., Photographic tone reproduction for digital images, 2002), or less, so that no more than a hundredth of it is
/// over-exposed: in dark rooms the mean is that of the dark. 1 for a picture without light or without these channels.
float automatic_exposure(const LayeredImage& image);

}  // namespace laterna
