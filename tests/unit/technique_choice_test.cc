// Which technique a light gets, and what a rig is told of settings that it does not read.
#include "laterna/technique_choice.h"

#include <gtest/gtest.h>

#include "reference/picture_probes.h"
#include "reference/shapes.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

Light light_of(LightType type, std::optional<ShadowTechnique> own = {}) {
  Light light;
  light.name = type == LightType::directional ? "sun" : "lamp";
  light.type = type;
  light.shadow.technique = own;
  return light;
}

TEST(TechniqueChoice, TheLightsOwnThenThePicturesWhereItServesThenMap) {
  for (const TechniqueDescription& asked : list_techniques()) {
    const ShadowTechnique technique = asked.technique;
    EXPECT_EQ(technique_for(light_of(LightType::directional), technique), technique);
    EXPECT_EQ(technique_for(light_of(LightType::point, ShadowTechnique::exact), technique),
              ShadowTechnique::exact);
    const bool serves_lamps = technique != ShadowTechnique::cascades;
    EXPECT_EQ(technique_for(light_of(LightType::point), technique),
              serves_lamps ? technique : ShadowTechnique::map);
  }
  Light beam = light_of(LightType::projector);
  beam.projection = Projection::orthographic(1, 1, 0, 10);
  beam.source.radius = 0.1;
  EXPECT_EQ(technique_for(beam, ShadowTechnique::pcss), ShadowTechnique::map);
}

// The picture's cascades serve the sun; the lamp has what `map` gives it, bit for bit.
TEST(TechniqueChoice, APictureMayAskForWhatOnlySomeLightsCanHave) {
  using namespace reference;
  Scene scene;
  add_object(scene, "floor", reference::floor(3));
  add_object(scene, "ball", sphere({0, 0.6F, 0}, 0.6F, 24));
  add_light(scene, light_of(LightType::directional), {1, 3, 2}, {0, 0, 0});
  add_light(scene, light_of(LightType::point), {-1, 2, 1}, {0, 0, 0});
  const View camera = look({1, 2, 4}, {0, 0.3, 0}, 40, 1);
  RenderSettings settings = test_settings(64, 64);
  settings.layers = {Layer::visibility};
  const Renderer renderer = make_renderer(scene);
  settings.shadows = ShadowTechnique::cascades;
  const LayeredImage asked = render(renderer, camera, settings);
  EXPECT_EQ(renderer.shadow_map_views("lamp", camera, settings).value().size(), 6U);
  settings.shadows = ShadowTechnique::map;
  const LayeredImage maps = render(renderer, camera, settings);
  const std::span<const float> lamp = values_of(asked, "visibility.lamp");
  const std::span<const float> mapped = values_of(maps, "visibility.lamp");
  EXPECT_TRUE(std::equal(lamp.begin(), lamp.end(), mapped.begin()));
  scene.lights[0].shadow.technique = ShadowTechnique::cascades;
  const LayeredImage named = render(make_renderer(scene), camera, settings);
  EXPECT_EQ(count_different_pixels(asked, named), 0U);
}

std::vector<std::string> warnings_of(const std::string& shadow) {
  const TemporaryFolder folder;
  const std::string rig =
      R"({"lights": [{"name": "lamp", "type": "point", "position": [0, 5, 1], "shadow": )" + shadow + "}]}";
  const std::filesystem::path file = folder.write("rig.json", rig);
  const Scene scene = load_or_fail({}, {.rigs = {file}});
  std::vector<std::string> messages;
  for (const Diagnostic& warning : scene.warnings) {
    std::string text = to_string(warning);
    EXPECT_TRUE(text.starts_with(file.string() + ": line 1: lights[0].shadow.")) << text;
    messages.push_back(text.substr(text.find("lights[0].shadow.") + 17));
  }
  return messages;
}

TEST(UnreadShadowSettings, AreNamedWithTheTechniquesThatReadThem) {
  using Messages = std::vector<std::string>;
  EXPECT_EQ(warnings_of(R"({"technique": "map", "planes": [{"normal": [0, 1, 0], "distance": 0}]})"),
            Messages{R"(planes: has no effect with "technique": "map": it is read by "ground")"});
  EXPECT_EQ(
      warnings_of(R"({"technique": "exact", "cascades": 3, "filter": "nearest"})"),
      (Messages{
          R"(filter: has no effect with "technique": "exact": it is read by "silhouette", "map", "pcss" and "cascades")",
          R"(cascades: has no effect with "technique": "exact": it is read by "cascades")"}));
  EXPECT_EQ(warnings_of(R"({"technique": "ground", "blur": 8, "smooth": 2, "constant_bias": 0.01})").size(),
            3U);
}

TEST(UnreadShadowSettings, AreNotDefaultsNorWhatIsReadNorWhatSomebodyElseDecides) {
  const char* silent[] = {
      R"({"technique": "exact", "cascades": 4, "filter": "refined", "outside": "lit", "moments": "exponential", "smooth": 0})",
      R"({"technique": "map", "filter": "percentage_closer", "kernel": 5, "outside": "shadowed", "soft_edge": 0.1})",
      R"({"technique": "variance", "moments": "variance", "blur": 1, "bleeding_reduction": 0.4, "caster_faces": "back_only"})",
      R"({"technique": "silhouette", "smooth": 4, "smooth_kernel": "binomial", "order": "none", "cull": false})",
      R"({"technique": "raytraced", "resolution": 512, "opacity": 0.5, "fill": 0.1})",
      R"({"technique": "none", "blur": 8})",
      R"({"blur": 8, "smooth": 3})",
  };
  for (const char* shadow : silent) EXPECT_EQ(warnings_of(shadow), std::vector<std::string>{}) << shadow;
}

}  // namespace
}  // namespace laterna
