// Blended surfaces over opaque ones, as pictures.
#include <gtest/gtest.h>

#include "reference/shapes.h"

namespace laterna {
namespace {

// Panes at many places and depths, lit and unlit ones by turns, so that tiles have different numbers of fragments.
Scene panes() {
  Scene scene;
  reference::add_object(scene, "wall", reference::wall(4, 3, -2), {0.7F, 0.6F, 0.5F});
  for (int i = 0; i < 24; ++i) {
    const int row = i / 6;
    const float x = static_cast<float>(i % 6) - 2.5F;
    const float y = 0.9F * static_cast<float>(row) - 1.4F;
    reference::Mesher mesher;
    const float half = 0.25F + 0.02F * static_cast<float>(i);
    const float z = -1.5F + 0.05F * static_cast<float>(i);
    mesher.quad({x - half, y - half, z}, {x + half, y - half, z}, {x + half, y + half, z},
                {x - half, y + half, z});
    reference::add_object(scene, "pane " + std::to_string(i), mesher.primitive, {0.2F, 0.5F, 0.9F});
    scene.materials.back().alpha_mode = AlphaMode::blend;
    scene.materials.back().base_color[3] = 0.4F;
    scene.materials.back().unlit = i % 2 == 0;
  }
  Light lamp;
  lamp.name = "lamp";
  lamp.type = LightType::point;
  lamp.intensity = 40;
  reference::add_light(scene, lamp, {1, 1, 2}, {0, 0, -2});
  return scene;
}

LayeredImage picture_of(int threads) {
  const Renderer renderer = reference::make_renderer(panes(), threads);
  RenderSettings settings = reference::test_settings(330, 250);
  settings.layers = {Layer::light};
  return reference::render(renderer, reference::look({0, 0, 4}, {0, 0, -2}, 50, 1.32), settings);
}

TEST(RenderBlending, UnlitPanesSendNothingOfALight) {
  const LayeredImage one = picture_of(1);
  for (const int threads : {2, 7}) {
    const LayeredImage many = picture_of(threads);
    ASSERT_EQ(one.channels.size(), many.channels.size());
    for (std::size_t i = 0; i < one.channels.size(); ++i) {
      EXPECT_EQ(one.channels[i].values, many.channels[i].values) << one.channels[i].name;
    }
  }
  // An unlit pane of alpha 0.4 lets 0.6 of the wall's light through and adds none.
  Scene bare = panes();
  for (Material& material : bare.materials) {
    if (material.unlit) material.base_color[3] = 0;
  }
  const Renderer renderer = reference::make_renderer(std::move(bare), 1);
  RenderSettings settings = reference::test_settings(330, 250);
  settings.layers = {Layer::light};
  const LayeredImage without =
      reference::render(renderer, reference::look({0, 0, 4}, {0, 0, -2}, 50, 1.32), settings);
  // The middle of pane 0, with no other before it.
  const int x = 50, y = 196;
  const float behind = reference::at(without, "light.lamp.R", x, y);
  ASSERT_GT(behind, 0.1F);
  EXPECT_NEAR(reference::at(one, "light.lamp.R", x, y), 0.6F * behind, 1e-5F);
}

}  // namespace
}  // namespace laterna
