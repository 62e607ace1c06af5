// Pictures with exact shadows: those of rays, whatever the threads and the instruction set.
#include <gtest/gtest.h>

#include "reference/everything.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using reference::same_bits;

// All its lights that cast shadows cast exact ones; cut-outs, glass, instances and what casts nothing are among its objects.
Scene everything_exact() {
  Scene scene = reference::everything();
  for (Light& light : scene.lights) {
    if (light.shadow.technique != ShadowTechnique::none) light.shadow = {};
  }
  return scene;
}

RenderSettings settings_with(ShadowTechnique technique) {
  RenderSettings settings;
  settings.width = 200;
  settings.height = 140;
  settings.shadows = technique;
  settings.layers = {Layer::visibility, Layer::light, Layer::object};
  return settings;
}

LayeredImage draw(ShadowTechnique technique, int threads, std::optional<InstructionSet> set = {}) {
  const RenderSettings settings = settings_with(technique);
  return reference::render(reference::make_renderer(everything_exact(), threads, set),
                           reference::everything_view(settings.width, settings.height), settings);
}

TEST(ExactShadows, AreThoseOfRays) {
  const LayeredImage exact = draw(ShadowTechnique::exact, 2), traced = draw(ShadowTechnique::raytraced, 2);
  int lights = 0;
  for (const Channel& channel : exact.channels) {
    if (!channel.name.starts_with("visibility.")) continue;
    ++lights;
    const std::vector<float>& truth = traced.find(channel.name)->values;
    int differ = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) differ += channel.values[i] == truth[i] ? 0 : 1;
    // Rays in single precision may miss an edge that they graze.
    EXPECT_LE(differ, 1) << channel.name;
  }
  EXPECT_GT(lights, 8);
}

TEST(ExactShadows, DependOnNeitherThreadsNorInstructionSet) {
  const LayeredImage expected = draw(ShadowTechnique::exact, 1, InstructionSet::scalar);
  for (const int threads : {2, 7}) EXPECT_TRUE(same_bits(draw(ShadowTechnique::exact, threads), expected));
  for (const InstructionSet set : supported_instruction_sets()) {
    EXPECT_TRUE(same_bits(draw(ShadowTechnique::exact, 3, set), expected)) << name_of(set);
  }
}

// A caster moves: the next picture is that of a renderer which never knew it elsewhere.
TEST(ExactShadows, FollowCastersThatMove) {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(3));
  const int box = reference::add_object(scene, "box", reference::box({0, 1, 0}, {0.4F, 0.4F, 0.4F}));
  Light light;
  light.type = LightType::point;
  light.name = "lamp";
  reference::add_light(scene, light, {0.5, 4, 0.3}, {0, 0, 0});
  const View view = reference::look({0, 3, 6}, {0, 0, 0}, 50, 1);
  RenderSettings settings = reference::test_settings(64, 64);
  settings.shadows = ShadowTechnique::exact;
  Renderer renderer = reference::make_renderer(scene);
  const LayeredImage before = reference::render(renderer, view, settings);
  glm::dmat4& place = scene.nodes[static_cast<std::size_t>(box)].parent_from_node;
  place[3] = glm::dvec4(1, 0.2, 0.5, 1);
  ASSERT_TRUE(renderer.set_transform(box, place));
  const LayeredImage after = reference::render(renderer, view, settings);
  EXPECT_FALSE(same_bits(after, before));
  EXPECT_TRUE(same_bits(after, reference::render(reference::make_renderer(scene), view, settings)));
}

}  // namespace
}  // namespace laterna
