#include "laterna/render.h"

#include <utility>

#include "base/refuse.h"
#include "frame/slide_points.h"
#include "light/light_plan.h"
#include "render/camera_views.h"
#include "render/channels.h"
#include "render/idle_projectors.h"
#include "render/memory_guard.h"
#include "render/open_sheets.h"
#include "render/picture_drawer.h"
#include "render/posed_scene.h"
#include "render/probe_grid.h"
#include "render/probe_light.h"
#include "render/progress_report.h"
#include "render/scene_defaults.h"
#include "render/settings_check.h"

namespace laterna {

using render::guarded;
using render::ProgressReport;

struct Renderer::Implementation {
  Implementation(Scene scene, const RendererOptions& options)
      : pool(options.threads),
        instruction_set(options.instruction_set.value_or(best_instruction_set())),
        posed(std::move(scene), options, pool),
        drawer(posed, pool, instruction_set, options.cache_bytes) {}

  /// The light of that name in a plan.
  [[nodiscard]] static Result<light::PlannedLight> find_light(light::LightPlan plan, const std::string& name);
  [[nodiscard]] Result<light::PlannedLight> planned_light(const std::string& name) const;
  [[nodiscard]] Result<const frame::PlacedLight*> find_projector(const std::string& name) const;
  /// The light with the one shadow view of that face.
  [[nodiscard]] Result<light::PlannedLight> planned_face(const std::string& name, int face) const;

  TaskPool pool;
  InstructionSet instruction_set;
  render::PosedScene posed;
  render::PictureDrawer drawer;
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
    if (Result<void> built = implementation->posed.load(); !built)
      return tl::unexpected(std::move(built.error()));
    if (Result<void> flat = implementation->drawer.check_mirrors(); !flat)
      return tl::unexpected(std::move(flat.error()));
    if (Result<void> lit = implementation->drawer.load_environment(options); !lit)
      return tl::unexpected(std::move(lit.error()));
    return Renderer(std::move(implementation));
  });
}

const Scene& Renderer::scene() const { return implementation_->posed.scene(); }
int Renderer::threads() const { return implementation_->pool.threads(); }
InstructionSet Renderer::instruction_set() const { return implementation_->instruction_set; }

Result<View> Renderer::camera_view(const std::string& name, int width, int height) const {
  return render::camera_view(implementation_->posed.frame(), name, width, height);
}

View Renderer::overview(int width, int height) const {
  return render::overview(implementation_->posed.frame(), width, height);
}

Result<RenderStatistics> Renderer::render_into(const View& view, const RenderSettings& settings,
                                               const RenderTarget& target, const Progress& progress,
                                               const Preview& preview) const {
  return guarded([&] { return implementation_->drawer.draw(view, settings, {target, preview}, progress); });
}

std::vector<std::string> Renderer::channel_names(const RenderSettings& settings) const {
  std::vector<std::string> names;
  for (const render::PictureChannel& channel :
       render::picture_channels(settings, implementation_->posed.frame())) {
    names.push_back(channel.name);
  }
  return names;
}

Result<LayeredImage> Renderer::render(const View& view, const RenderSettings& settings,
                                      const Progress& progress, RenderStatistics* statistics,
                                      const Preview& preview) const {
  return guarded(
      [&] { return implementation_->drawer.draw_channels(view, settings, progress, statistics, preview); });
}

Result<LayeredImage> Renderer::render_exposed(const View& view, const RenderSettings& settings,
                                              const Shutter& shutter, const Progress& progress,
                                              RenderStatistics* statistics, const Preview& preview) {
  const double middle = time();
  if (Result<void> checked = render::check_shutter(shutter.seconds, middle); !checked)
    return tl::unexpected(checked.error());
  const render::PictureDrawer::Expose expose = [&](SampleIndex sample) -> Result<View> {
    const double instant = middle + shutter.seconds * (sample_number(sample, SampleDimension::instant) - 0.5);
    if (const Result<int> posed = set_time(instant); !posed) return tl::unexpected(posed.error());
    return shutter.view_now ? shutter.view_now(*this) : view;
  };
  Result<LayeredImage> image = guarded([&] {
    return implementation_->drawer.draw_channels(view, settings, progress, statistics, preview, &expose);
  });
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
    ProbeReport measured = render::measure_probes(
        {self.posed.frame(), self.pool, self.instruction_set, self.posed.casters().ray_scene(), report},
        probes, settings);
    if (report.is_cancelled())
      return tl::unexpected(Error(Failure::cancelled, Diagnostic{{}, {}, "cancelled"}));
    return measured;
  });
}

Result<std::vector<Probe>> Renderer::probes_on_object(const std::string& object, double spacing) const {
  return guarded([&] { return render::probes_on_object(implementation_->posed.frame(), object, spacing); });
}

Result<void> Renderer::set_transform(int node, const glm::dmat4& parent_from_node) {
  return implementation_->posed.set_transform(node, parent_from_node);
}

Result<void> Renderer::set_light(int light, Light value) {
  return implementation_->posed.set_light(light, std::move(value));
}

Result<void> Renderer::set_photograph_gains(std::span<const glm::vec3> gains) {
  return implementation_->posed.set_photograph_gains(gains);
}

Result<int> Renderer::set_time(double seconds) { return implementation_->posed.set_time(seconds); }

double Renderer::time() const { return implementation_->posed.time(); }

PosingStatistics Renderer::posing_statistics() const { return implementation_->posed.posing(); }

Renderer::Box Renderer::bounds() const {
  const frame::Bounds& bounds = implementation_->posed.frame().bounds;
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
      find_light(light::make_light_plan(posed.frame(), {ShadowTechnique::map, {}, nullptr}), name);
  // Where a light asks for no shadow map, the one it would have is shown.
  if (planned) planned = light::with_shadow_map(std::move(*planned), posed.frame());
  return planned;
}

namespace {

std::vector<ShadowMapView> views_of(const light::PlannedLight& planned) {
  std::vector<ShadowMapView> views;
  views.reserve(planned.shadow_views.size());
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
  const Result<light::PlannedLight> planned = Implementation::find_light(
      light::make_light_plan(self.posed.frame(), {settings.shadows, {}, &camera}), light);
  return planned.map(views_of);
}

std::vector<std::string> Renderer::idle_projectors() const {
  return render::idle_projectors(implementation_->posed.frame());
}

Result<View> Renderer::light_view(const std::string& name) const {
  const Result<light::PlannedLight> planned = implementation_->planned_light(name);
  if (!planned) return tl::unexpected(planned.error());
  if (planned->shadow_views.size() == 1) return planned->shadow_views[0].view;
  return refuse("light \"" + name +
                "\" shines all round: it has no one view (a picture of all directions from there draws "
                "`laterna environment --from-scene`)");
}

Result<const frame::PlacedLight*> Renderer::Implementation::find_projector(const std::string& name) const {
  const auto projector_of = [](const frame::PlacedLight& placed) {
    return placed.light->type == LightType::projector ? placed.light : nullptr;
  };
  for (const frame::PlacedLight& placed : posed.frame().lights) {
    const Light* projector = projector_of(placed);
    if (projector != nullptr && projector->name == name) return &placed;
  }
  return refuse_missing("projector \"" + name + "\" that is on", posed.frame().lights, projector_of);
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

Result<LayeredImage> Renderer::depth_map(const std::string& light, int face,
                                         RenderStatistics* statistics) const {
  const Implementation& self = *implementation_;
  const Result<light::PlannedLight> planned = self.planned_face(light, face);
  if (!planned) return tl::unexpected(planned.error());
  return guarded([&]() -> Result<LayeredImage> {
    RenderStatistics cost;
    LayeredImage distances = self.drawer.draw_distances(*planned, cost);
    if (statistics != nullptr) *statistics = cost;
    return distances;
  });
}

}  // namespace laterna
