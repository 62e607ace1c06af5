#include "debug_picture.h"

#include <fmt/format.h>

#include <array>

#include "laterna/technique_choice.h"
#include "outcome.h"
#include "progress_line.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

struct NamedKind {
  const char* name;
  DebugKind kind;
};
constexpr std::array<NamedKind, 4> kKindsOfLights = {{{"project-depth", DebugKind::project_depth},
                                                      {"cascades", DebugKind::cascades},
                                                      {"texel-density", DebugKind::texel_density},
                                                      {"pairs", DebugKind::pairs}}};

Result<ExplainedPicture> draw_depth(const Renderer& renderer, const View& camera,
                                    const RenderSettings& settings, RenderStatistics& statistics) {
  RenderSettings with_depth = settings;
  with_depth.layers = {Layer::depth};
  Result<LayeredImage> image = renderer.render(camera, with_depth, progress_line("rendering"), &statistics);
  if (image) image = depth_picture(*image);
  if (!image) return tl::unexpected(std::move(image.error()));
  return ExplainedPicture{std::move(*image), {"near is light, far dark, nothing white"}};
}

Result<ExplainedPicture> draw_projected_depth(const Renderer& renderer, const View& camera,
                                              const RenderSettings& settings, const std::string& light) {
  Result<LayeredImage> image = projected_depth(renderer, camera, settings, light);
  if (!image) return tl::unexpected(std::move(image.error()));
  return ExplainedPicture{
      std::move(*image),
      {"near the light is light, far from it dark: a surface in shadow shows the depth of what "
       "shades it; black lies outside the map"}};
}

Result<ExplainedPicture> draw_for_light(const Renderer& renderer, const View& camera,
                                        const RenderSettings& settings, const DebugChoice& choice) {
  switch (choice.kind) {
    case DebugKind::cascades:
      return cascade_picture(renderer, camera, settings, choice.light);
    case DebugKind::texel_density:
      return texel_density_picture(renderer, camera, settings, choice.light);
    case DebugKind::pairs:
      return shadow_pairs_picture(renderer, camera, settings, choice.light);
    default:
      return draw_projected_depth(renderer, camera, settings, choice.light);
  }
}

// Whether the picture's settings give a light what is to be shown.
Result<bool> applies(const Renderer& renderer, const View& camera, const RenderSettings& settings,
                     DebugKind kind, const Light& light) {
  const ShadowTechnique technique = technique_for(light, settings.shadows);
  if (kind == DebugKind::project_depth) return true;
  if (kind == DebugKind::cascades) return technique == ShadowTechnique::cascades;
  if (kind == DebugKind::pairs) return technique == ShadowTechnique::silhouette;
  return renderer.shadow_map_views(light.name, camera, settings).map([](const auto& maps) {
    return !maps.empty();
  });
}

// Said where no light has what is to be shown.
const char* describe_lack(DebugKind kind) {
  switch (kind) {
    case DebugKind::cascades:
      return "--debug cascades: no light has cascades: give a directional light \"technique\": \"cascades\" "
             "in a rig, or all with --shadows cascades";
    case DebugKind::texel_density:
      return "--debug texel-density: no light has its shadows by shadow maps";
    case DebugKind::pairs:
      return "--debug pairs: no light has projected silhouettes: give one \"technique\": \"silhouette\" in a "
             "rig, "
             "or all lights with --shadows silhouette";
    default:
      return "--debug project-depth: the scene has no light";
  }
}

Result<std::string> find_first_light(const Renderer& renderer, const View& camera,
                                     const RenderSettings& settings, DebugKind kind) {
  const Scene& scene = renderer.scene();
  for (const Node& node : scene.nodes) {
    if (node.light < 0) continue;
    const Light& light = scene.lights[static_cast<std::size_t>(node.light)];
    if (!light.enabled) continue;
    const Result<bool> found = applies(renderer, camera, settings, kind, light);
    if (!found) return tl::unexpected(found.error());
    if (*found) return light.name;
  }
  return tl::unexpected(bad_option(describe_lack(kind)));
}

}  // namespace

const char* describe_debug_choices() {
  return "depth: grey ramp; project-depth: a light's depth map thrown on the scene; cascades: which one "
         "answers, by "
         "colour; texel-density: shadow texels per pixel, by colour; pairs: which objects silhouettes may "
         "shade, "
         "striped with the colours of those that shade them; the last four take :LIGHT";
}

Result<DebugChoice> parse_debug_choice(const std::string& text) {
  if (text == "depth") return DebugChoice{};
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  for (const NamedKind& known : kKindsOfLights) {
    if (name != known.name) continue;
    if (colon == std::string::npos) return DebugChoice{known.kind, {}};
    if (colon + 1 < text.size()) return DebugChoice{known.kind, text.substr(colon + 1)};
  }
  return tl::unexpected(bad_option(
      fmt::format("--debug: expected depth, project-depth, cascades, texel-density or pairs, the last four "
                  "with or without :LIGHT, got \"{}\"",
                  text)));
}

Result<ExplainedPicture> draw_debug_picture(const Renderer& renderer, const View& camera,
                                            const RenderSettings& settings, const DebugChoice& choice,
                                            RenderStatistics& statistics) {
  if (choice.kind == DebugKind::depth) return draw_depth(renderer, camera, settings, statistics);
  DebugChoice with_light = choice;
  if (with_light.light.empty()) {
    Result<std::string> first = find_first_light(renderer, camera, settings, choice.kind);
    if (!first) return tl::unexpected(std::move(first.error()));
    with_light.light = std::move(*first);
  }
  return draw_for_light(renderer, camera, settings, with_light);
}

}  // namespace laterna::app
