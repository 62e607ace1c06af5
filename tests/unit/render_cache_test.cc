// Shadow maps kept from picture to picture (rows 77, 78 and 105 of the papers' list), and scenes that change.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "reference/everything.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using reference::everything;
using reference::same_bits;

struct OneLight {
  Scene scene;
  int floor = -1, box = -1, lamp = -1;
};

OneLight one_light(LightType type = LightType::projector) {
  OneLight s;
  s.floor = reference::add_object(s.scene, "floor", reference::floor(5));
  s.box = reference::add_object(s.scene, "box", reference::box({0, 0.5F, 0}, {0.5F, 0.5F, 0.5F}));
  Light light;
  light.name = "lamp";
  light.type = type;
  light.intensity = 40;
  light.shadow.resolution = 256;
  s.lamp = reference::add_light(s.scene, light, {2, 4, 2}, {0, 0, 0});
  return s;
}

View on_path(int frame) {
  const double angle = 0.06 * frame;
  return reference::look({5 * std::sin(angle), 2.5, 5 * std::cos(angle)}, {0, 0.3, 0}, 45, 1.25);
}

RenderSettings small_settings() {
  RenderSettings settings;
  settings.width = 100;
  settings.height = 80;
  settings.layers = {Layer::visibility};
  return settings;
}

struct Drawn {
  LayeredImage picture;
  RenderStatistics statistics;
};

Drawn draw(const Renderer& renderer, const View& view, const RenderSettings& settings) {
  Drawn drawn;
  Result<LayeredImage> picture = renderer.render(view, settings, {}, &drawn.statistics);
  EXPECT_TRUE(picture);
  if (picture) drawn.picture = std::move(*picture);
  return drawn;
}

// Cascades follow the camera: a picture never reads those of another one's, and those that have not moved are kept.
TEST(ShadowMapCache, CascadesAreDrawnAnewWhereTheCameraHasMovedThem) {
  OneLight one = one_light(LightType::directional);
  for (int i = 0; i < 12; ++i)
    reference::add_object(one.scene, "far",
                          reference::box({3, 1, -10.0F * static_cast<float>(i)}, {1, 1, 1}));
  one.scene.lights[0].shadow.technique = ShadowTechnique::cascades;
  const Renderer renderer = reference::make_renderer(one.scene);
  RenderSettings anew = small_settings();
  anew.keep_shadow_maps = false;
  int drawn_maps = 0, kept_maps = 0;
  for (int frame = 0; frame < 12; ++frame) {
    const View view = on_path(frame / 2);
    const Drawn drawn = draw(renderer, view, small_settings());
    EXPECT_TRUE(same_bits(drawn.picture, draw(reference::make_renderer(one.scene), view, anew).picture))
        << frame;
    const int maps = drawn.statistics.maps_drawn + drawn.statistics.maps_kept;
    EXPECT_GT(maps, 1);
    if (frame % 2 == 1) {
      EXPECT_EQ(drawn.statistics.maps_kept, maps);
    } else {
      EXPECT_GT(drawn.statistics.maps_drawn, 0);
    }
    drawn_maps += drawn.statistics.maps_drawn;
    kept_maps += drawn.statistics.maps_kept;
  }
  EXPECT_GT(drawn_maps, 6);
  EXPECT_GT(kept_maps, 6 * 2);
}

TEST(ShadowMapCache, AHundredPicturesFromAMovingCameraDrawOneMap) {
  Renderer renderer = reference::make_renderer(one_light().scene);
  RenderSettings without = small_settings();
  without.keep_shadow_maps = false;
  const Renderer cacheless = reference::make_renderer(one_light().scene);
  int drawn = 0, kept = 0, drawn_without = 0;
  for (int frame = 0; frame < 100; ++frame) {
    const Drawn with_cache = draw(renderer, on_path(frame), small_settings());
    drawn += with_cache.statistics.maps_drawn;
    kept += with_cache.statistics.maps_kept;
    if (frame % 10 != 0) continue;
    const Drawn anew = draw(cacheless, on_path(frame), without);
    drawn_without += anew.statistics.maps_drawn;
    EXPECT_EQ(anew.statistics.maps_kept, 0);
    ASSERT_TRUE(same_bits(with_cache.picture, anew.picture)) << frame;
  }
  EXPECT_EQ(drawn, 1);
  EXPECT_EQ(kept, 99);
  EXPECT_EQ(drawn_without, 10);
}

TEST(ShadowMapCache, MovingACasterDrawsTheMapAgain) {
  OneLight s = one_light();
  Renderer renderer = reference::make_renderer(s.scene);
  int drawn = 0;
  for (int frame = 0; frame < 100; ++frame) {
    if (frame == 50) {
      const glm::dmat4 moved = glm::translate(glm::dmat4(1), glm::dvec3(0.7, 0.2, 0));
      ASSERT_TRUE(renderer.set_transform(s.box, moved));
      s.scene.nodes[static_cast<std::size_t>(s.box)].parent_from_node = moved;
    }
    const Drawn got = draw(renderer, on_path(frame), small_settings());
    drawn += got.statistics.maps_drawn;
    if (frame < 49 || frame > 51) continue;
    ASSERT_TRUE(same_bits(got.picture,
                          draw(reference::make_renderer(s.scene), on_path(frame), small_settings()).picture));
  }
  EXPECT_EQ(drawn, 2);
}

TEST(ShadowMapCache, MovingTheLightDrawsTheMapAgainAndBrightnessDoesNot) {
  OneLight s = one_light();
  Renderer renderer = reference::make_renderer(s.scene);
  const auto maps_drawn = [&] {
    const Drawn got = draw(renderer, on_path(3), small_settings());
    EXPECT_TRUE(same_bits(got.picture,
                          draw(reference::make_renderer(s.scene), on_path(3), small_settings()).picture));
    return got.statistics.maps_drawn;
  };
  EXPECT_EQ(maps_drawn(), 1);
  Light& lamp = s.scene.lights[0];
  lamp.intensity = 10;
  lamp.color = {1, 0, 0};
  ASSERT_TRUE(renderer.set_light(0, lamp));
  EXPECT_EQ(maps_drawn(), 0);
  lamp.shadow.kernel = 5;  // how it is read, not what it holds
  ASSERT_TRUE(renderer.set_light(0, lamp));
  EXPECT_EQ(maps_drawn(), 0);
  lamp.shadow.resolution = 300;
  ASSERT_TRUE(renderer.set_light(0, lamp));
  EXPECT_EQ(maps_drawn(), 1);
  lamp.shadow.caster_faces = CasterFaces::back_only;
  ASSERT_TRUE(renderer.set_light(0, lamp));
  EXPECT_EQ(maps_drawn(), 1);
  s.scene.nodes[static_cast<std::size_t>(s.lamp)].parent_from_node[3].x += 0.5;
  ASSERT_TRUE(
      renderer.set_transform(s.lamp, s.scene.nodes[static_cast<std::size_t>(s.lamp)].parent_from_node));
  EXPECT_EQ(maps_drawn(), 1);
  EXPECT_EQ(maps_drawn(), 0);
  lamp.enabled = false;
  ASSERT_TRUE(renderer.set_light(0, lamp));
  EXPECT_EQ(maps_drawn(), 0);
}

TEST(ShadowMapCache, OtherSettingsBetweenDoNotConfuseIt) {
  const OneLight s = one_light();
  const Renderer renderer = reference::make_renderer(s.scene);
  const Drawn first = draw(renderer, on_path(1), small_settings());
  RenderSettings other = small_settings();
  other.shadows = ShadowTechnique::none;
  EXPECT_EQ(draw(renderer, on_path(1), other).statistics.maps_drawn, 0);
  other.shadows = ShadowTechnique::raytraced;
  EXPECT_EQ(draw(renderer, on_path(1), other).statistics.maps_drawn, 0);
  const Drawn again = draw(renderer, on_path(1), small_settings());
  EXPECT_EQ(again.statistics.maps_drawn, 0);
  EXPECT_TRUE(same_bits(again.picture, first.picture));
}

// Row 78: every light's maps and their bytes.
TEST(ShadowMemory, IsReportedPerLight) {
  const Scene scene = everything();
  const Renderer renderer = reference::make_renderer(scene);
  RenderStatistics statistics;
  ASSERT_TRUE(renderer.render(reference::everything_view(100, 80), small_settings(), {}, &statistics));
  std::vector<std::string> expected;
  for (const Light& light : scene.lights) {
    if (light.shadow.technique != ShadowTechnique::none) expected.push_back(light.name);
  }
  ASSERT_EQ(statistics.shadow_memory.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const RenderStatistics::LightMemory& memory = statistics.shadow_memory[i];
    EXPECT_EQ(memory.light, expected[i]);
    int texels = 0;
    for (int face = 0; face < static_cast<int>(renderer.depth_map_views(memory.light)->size()); ++face) {
      const LayeredImage map = renderer.depth_map(memory.light, face).value();
      texels += map.width * map.height;
    }
    EXPECT_EQ(memory.maps, static_cast<int>(renderer.depth_map_views(memory.light)->size())) << memory.light;
    // A float per texel, for refined shadows the triangle too; stored in whole tiles of 64 × 64.
    EXPECT_GE(memory.bytes, static_cast<std::size_t>(texels) * 4) << memory.light;
    EXPECT_LE(memory.bytes, static_cast<std::size_t>(texels) * 8 * 2) << memory.light;
  }
  EXPECT_EQ(statistics.shadow_memory[0].maps, 6);  // the bulb shines all round
}

TEST(ShadowMemory, AMapOf256TexelsTakesAQuarterMegabyteAndItsTrianglesAsMuch) {
  OneLight s = one_light();
  for (const ShadowFilter filter : {ShadowFilter::refined, ShadowFilter::bilinear}) {
    s.scene.lights[0].shadow.filter = filter;
    RenderStatistics statistics;
    ASSERT_TRUE(reference::make_renderer(s.scene).render(on_path(0), small_settings(), {}, &statistics));
    ASSERT_EQ(statistics.shadow_memory.size(), 1U);
    EXPECT_EQ(statistics.shadow_memory[0].maps, 1);
    EXPECT_EQ(statistics.shadow_memory[0].bytes, (filter == ShadowFilter::refined ? 2U : 1U) * 256 * 256 * 4);
  }
}

// ---------------------------------------------------------------------------------------------- changes

TEST(SceneChanges, WhatCannotBeIsRefusedAndLeavesEverythingAsItWas) {
  const OneLight s = one_light();
  Renderer renderer = reference::make_renderer(s.scene);
  const LayeredImage before = draw(renderer, on_path(2), small_settings()).picture;
  const auto message = [](const Result<void>& result) {
    return result ? "no error" : to_string(result.error());
  };

  EXPECT_EQ(message(renderer.set_transform(99, glm::dmat4(1))), "the scene has no node 99");
  EXPECT_EQ(message(renderer.set_transform(-1, glm::dmat4(1))), "the scene has no node -1");
  EXPECT_NE(message(renderer.set_transform(s.box, glm::dmat4(std::nan("")))), "no error");
  EXPECT_NE(message(renderer.set_transform(s.lamp, glm::dmat4(0))), "no error");
  EXPECT_NE(message(renderer.set_transform(s.box, glm::translate(glm::dmat4(1), glm::dvec3(1e11, 0, 0)))),
            "no error");
  EXPECT_EQ(message(renderer.set_light(1, Light{})), "the scene has no light 1");
  EXPECT_EQ(message(renderer.set_light(-1, Light{})), "the scene has no light -1");
  Light bad = s.scene.lights[0];
  bad.intensity = -1;
  EXPECT_NE(message(renderer.set_light(0, bad)), "no error");

  EXPECT_TRUE(same_bits(draw(renderer, on_path(2), small_settings()).picture, before));
  EXPECT_EQ(draw(renderer, on_path(2), small_settings()).statistics.maps_drawn, 0);
}

TEST(SceneChanges, ASlideThatCannotBeReadIsRefusedAndLeavesTheOldOne) {
  OneLight s = one_light();
  Picture missing;
  missing.name = "missing.png";
  missing.file = "/nowhere/missing.png";
  s.scene.pictures.push_back(missing);
  Renderer renderer = reference::make_renderer(s.scene);
  const LayeredImage before = draw(renderer, on_path(2), small_settings()).picture;
  Light with_slide = s.scene.lights[0];
  with_slide.slide = 0;
  with_slide.intensity = 5;
  const Result<void> changed = renderer.set_light(0, with_slide);
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error().failure, Failure::bad_input);
  EXPECT_EQ(renderer.scene().lights[0].slide, -1);
  EXPECT_EQ(renderer.scene().lights[0].intensity, 40);
  EXPECT_TRUE(same_bits(draw(renderer, on_path(2), small_settings()).picture, before));
}

TEST(SceneChanges, ANewSlideIsReadWhenALightTakesIt) {
  OneLight s = one_light();
  reference::add_picture(s.scene, 8, 8, [](int x, int y) {
    return (x + y) % 2 == 0 ? glm::u8vec3(255) : glm::u8vec3(0, 40, 90);
  });
  Renderer renderer = reference::make_renderer(s.scene);
  draw(renderer, on_path(2), small_settings());
  s.scene.lights[0].slide = 0;
  ASSERT_TRUE(renderer.set_light(0, s.scene.lights[0]));
  EXPECT_TRUE(same_bits(draw(renderer, on_path(2), small_settings()).picture,
                        draw(reference::make_renderer(s.scene), on_path(2), small_settings()).picture));
}

TEST(SceneChanges, AMovedParentTakesItsChildrenAlong) {
  OneLight s = one_light();
  Node parent;
  parent.name = "cart";
  s.scene.nodes.push_back(parent);
  const int cart = static_cast<int>(s.scene.nodes.size()) - 1;
  s.scene.nodes[static_cast<std::size_t>(s.box)].parent = cart;
  s.scene.nodes[static_cast<std::size_t>(s.lamp)].parent = cart;
  Renderer renderer = reference::make_renderer(s.scene);
  draw(renderer, on_path(2), small_settings());
  const glm::dmat4 moved = glm::translate(glm::dmat4(1), glm::dvec3(-0.8, 0, 0.4));
  ASSERT_TRUE(renderer.set_transform(cart, moved));
  s.scene.nodes.back().parent_from_node = moved;
  EXPECT_TRUE(same_bits(draw(renderer, on_path(2), small_settings()).picture,
                        draw(reference::make_renderer(s.scene), on_path(2), small_settings()).picture));
}

}  // namespace
}  // namespace laterna
