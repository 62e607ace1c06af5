#include "render_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "laterna/technique_choice.h"

namespace laterna::app {

void advise_exposure(const LayeredImage& image, float exposure, bool is_automatic) {
  std::size_t seen = 0;
  std::size_t white = 0;
  std::size_t dark = 0;
  const std::vector<float>& alpha = image.find("A")->values;
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    if (alpha[i] <= 0) continue;
    const float brightest = exposure * std::max({image.channels[0].values[i], image.channels[1].values[i],
                                                 image.channels[2].values[i]});
    ++seen;
    white += brightest >= 1 ? 1U : 0U;
    dark += brightest < 0.002F ? 1U : 0U;
  }
  if (seen == 0) fmt::print(stderr, "laterna: note: nothing of the scene is in the picture\n");
  if (2 * white > seen)
    fmt::print(stderr, "laterna: note: more than half of the picture is over-exposed: try --exposure auto\n");
  if (seen > 0 && 10 * dark > 9 * seen) {
    fmt::print(
        stderr,
        "laterna: note: nearly all of the picture is black: try {}--from-light NAME, which shows what a "
        "lamp's light falls on; films may be dark at this --time\n",
        is_automatic ? "" : "--exposure auto, or ");
  }
}

nlohmann::json statistics_json(const RenderStatistics& s, double load_ms) {
  nlohmann::json memory = nlohmann::json::array();
  for (const auto& light : s.shadow_memory) {
    memory.push_back({{"light", light.light}, {"maps", light.maps}, {"bytes", light.bytes}});
  }
  nlohmann::json silhouettes = nlohmann::json::array();
  for (const auto& light : s.silhouettes) {
    silhouettes.push_back({{"light", light.light},
                           {"objects", light.objects},
                           {"pairs", light.pairs},
                           {"silhouettes", light.silhouettes},
                           {"silhouettes_drawn", light.silhouettes_drawn}});
  }
  nlohmann::json told = {{"load_ms", load_ms},         {"plan_ms", s.plan_ms},
                         {"shadow_ms", s.shadow_ms},   {"bin_ms", s.bin_ms},
                         {"shade_ms", s.shade_ms},     {"render_ms", s.total_ms},
                         {"triangles", s.triangles},   {"triangles_drawn", s.triangles_drawn},
                         {"maps_drawn", s.maps_drawn}, {"maps_kept", s.maps_kept},
                         {"silhouettes", silhouettes}, {"shadow_memory", memory},
                         {"pictures", s.pictures},     {"noise", s.noise}};
  told["map_reuse"] = {{"maps_updated", s.map_reuse.maps_updated},
                       {"tiles_kept", s.map_reuse.tiles_kept},
                       {"tiles_updated", s.map_reuse.tiles_updated},
                       {"tiles_drawn", s.map_reuse.tiles_drawn},
                       {"triangles", s.map_reuse.triangles},
                       {"moving_triangles", s.map_reuse.moving_triangles},
                       {"bytes", s.map_reuse.bytes}};
  return told;
}

void advise_softness(const Scene& scene, ShadowTechnique for_all) {
  for (const Light& light : scene.lights) {
    const ShadowTechnique technique = technique_for(light, for_all);
    const bool is_hard = technique != ShadowTechnique::pcss && technique != ShadowTechnique::none;
    const bool is_wide = light.source.has_size() || light.aperture.radius > 0;
    if (!light.enabled || !is_wide || !is_hard) continue;
    fmt::print(stderr,
               "laterna: note: light \"{}\" has {}, but its shadows are hard: try --shadows exact "
               "--accumulate 64, or --shadows pcss, which is a guess\n",
               light.name, light.source.has_size() ? "a size" : "an aperture");
  }
}
void tell_idle_projectors(const Renderer& renderer) {
  for (const std::string& name : renderer.idle_projectors()) {
    fmt::print(stderr,
               "laterna: note: the light of projector \"{}\" meets nothing: laterna inspect --light tells "
               "where it points\n",
               name);
  }
}

void advise_luminance(const RenderRequest& request) {
  const RenderSettings& settings = request.settings;
  const bool is_shown = std::ranges::find(settings.layers, Layer::luminance) != settings.layers.end() ||
                        (request.false_color && request.false_color->layer == Layer::luminance);
  if (!is_shown || settings.shading == ShadingModel::pbr) return;
  fmt::print(
      stderr,
      "laterna: note: luminance is in cd/m² only with --shading pbr: in this model a white matt surface "
      "under 1 lx is 1\n");
}

void tell_noise(int pictures, double noise) {
  fmt::print(stderr, "laterna: mean of {} pictures, estimated noise {:.2g} % of the mean luminance\n",
             pictures, 100 * noise);
}

}  // namespace laterna::app
