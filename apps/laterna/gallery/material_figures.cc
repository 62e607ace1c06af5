// Materials by glTF's extensions: one number of each swept over a row of balls.
#include <algorithm>
#include <cmath>

#include "laterna/material_lobes.h"
#include "sitting.h"
#include "studio.h"

namespace laterna::app {
namespace {

constexpr int kBalls = 6;

/// A row of balls in a studio and the light of a lamp; `set` makes each one's material, by a number from 0 to 1.
Shot balls(const std::function<void(Material& material, MaterialLobes& lobes, float t)>& set) {
  Shot shot;
  Scene& scene = shot.scene;
  for (int i = 0; i < kBalls; ++i) {
    const int material = add_material(scene, "ball", glm::vec3(0.7F), -1, 0.3F);
    auto lobes = std::make_shared<MaterialLobes>();
    set(scene.materials.back(), *lobes, static_cast<float>(i) / (kBalls - 1));
    scene.materials.back().lobes = std::move(lobes);
    add_object(scene, "ball", ball({1.1F * (static_cast<float>(i) - 0.5F * (kBalls - 1)), 0, 0}, 0.5F),
               material);
  }
  scene.environment.emplace();
  scene.environment->picture = add_picture(scene, "studio", sky_of(studio));
  add_sun(scene, "lamp", {{2, 4, 4}, {0, 0, 0}}, glm::vec3(2));
  shot.camera = {{0, 0.4, 9}, {0, 0, 0}};
  shot.yfov = Angle::degrees(11);
  shot.settings.shading = ShadingModel::pbr;
  shot.settings.height = shot.settings.width / 5;
  return shot;
}

/// Ridges along both axes, whose slopes are `texel`s of a normal map, roughness and occlusion in one picture.
Image relief_map() {
  constexpr int kSide = 256;
  Image map(kSide, kSide, 3, PixelType::u8, Transfer::linear);
  const auto codes = map.values<std::uint8_t>();
  const auto slope = [](int at) { return static_cast<float>(point_of_circle(at / 32.0).y) * 0.35F; };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float dx = slope(x), dy = slope(y), z = std::sqrt(1 - dx * dx - dy * dy);
      const float n[3] = {dx, dy, z};
      for (std::size_t k = 0; k < 3; ++k)
        codes[static_cast<std::size_t>(3 * (y * kSide + x)) + k] =
            static_cast<std::uint8_t>(std::lround(127.5F + 127.5F * n[k]));
    }
  }
  return map;
}

/// Checks of occlusion (R) and roughness (G).
Image checks_map() {
  constexpr int kSide = 64;
  Image map(kSide, kSide, 3, PixelType::u8, Transfer::linear);
  const auto codes = map.values<std::uint8_t>();
  for (std::size_t i = 0; i < codes.size(); i += 3) {
    const std::size_t x = i / 3 % kSide, y = i / 3 / kSide;
    const bool is_dark = ((x / 8 + y / 8) & 1U) != 0;
    codes[i] = is_dark ? 64 : 255;
    codes[i + 1] = is_dark ? 255 : 40;
    codes[i + 2] = 255;
  }
  return map;
}

Shot textured(const std::function<void(Material& material, int relief, int checks, float t)>& set) {
  Shot shot = balls([](Material&, MaterialLobes&, float) {});
  const int relief = add_picture(shot.scene, "relief", relief_map());
  const int checks = add_picture(shot.scene, "checks", checks_map());
  for (int i = 0; i < kBalls; ++i)
    set(shot.scene.materials[static_cast<std::size_t>(i)], relief, checks,
        static_cast<float>(i) / (kBalls - 1));
  return shot;
}

void draw_maps(Sitting& sitting) {
  sitting.picture("Normal map, its scale from 0 to 1.", textured([](Material& m, int relief, int, float t) {
                    m.normal_texture.picture = relief;
                    m.normal_scale = t;
                  }));
  sitting.picture("Roughness map, its factor from 0 to 1.",
                  textured([](Material& m, int, int checks, float t) {
                    m.metallic_roughness_texture.picture = checks;
                    m.metallic = 1;
                    m.roughness = t;
                  }));
  sitting.picture(
      "Occlusion map, its strength from 0 to 1: light from all around is held off, the lamp's is not.",
      textured([](Material& m, int, int checks, float t) {
        m.occlusion_texture.picture = checks;
        m.occlusion_strength = t;
        m.roughness = 0.8F;
      }));
}

void draw_lobes(Sitting& sitting) {
  sitting.picture("Clear coat from 0 to 1, over rough red.",
                  balls([](Material& m, MaterialLobes& l, float t) {
                    m.base_color = {0.5F, 0.02F, 0.02F, 1};
                    m.roughness = 0.6F;
                    l.clearcoat.factor = t;
                    l.clearcoat.roughness = 0.03F;
                  }));
  sitting.picture("Roughness of the coat from 0 to 1.", balls([](Material& m, MaterialLobes& l, float t) {
                    m.base_color = {0.5F, 0.02F, 0.02F, 1};
                    m.metallic = 1;
                    m.roughness = 0.6F;
                    l.clearcoat.factor = 1;
                    l.clearcoat.roughness = t;
                  }));
  sitting.picture("Sheen, its roughness from 0.1 to 1.", balls([](Material& m, MaterialLobes& l, float t) {
                    m.base_color = {0.06F, 0.02F, 0.08F, 1};
                    m.roughness = 1;
                    l.sheen.color = {0.9F, 0.6F, 1};
                    l.sheen.roughness = 0.1F + 0.9F * t;
                  }));
  sitting.picture("Specular factor from 0 to 1.", balls([](Material& m, MaterialLobes& l, float t) {
                    m.base_color = {0.02F, 0.12F, 0.3F, 1};
                    m.roughness = 0.15F;
                    l.specular.factor = t;
                  }));
  sitting.picture("Specular colour from white to ten times gold.",
                  balls([](Material& m, MaterialLobes& l, float t) {
                    m.base_color = {0.03F, 0.03F, 0.03F, 1};
                    m.roughness = 0.15F;
                    l.specular.color = glm::vec3(1) + t * (glm::vec3(10, 6, 1) - glm::vec3(1));
                  }));
  sitting.picture("Index of refraction from 1 to 2.5.", balls([](Material& m, MaterialLobes& l, float t) {
                    m.base_color = {0.02F, 0.12F, 0.3F, 1};
                    m.roughness = 0.15F;
                    l.ior = 1 + 1.5F * t;
                  }));
  sitting.picture("Brushed metal: anisotropy from 0 to 1.", balls([](Material& m, MaterialLobes& l, float t) {
                    m.base_color = {0.9F, 0.8F, 0.6F, 1};
                    m.metallic = 1;
                    m.roughness = 0.3F;
                    l.anisotropy.strength = t;
                  }));
  sitting.picture("A film of index 1.4, from 150 to 900 nm thick.",
                  balls([](Material& m, MaterialLobes& l, float t) {
                    m.base_color = {0.9F, 0.9F, 0.9F, 1};
                    m.metallic = 1;
                    m.roughness = 0.15F;
                    l.iridescence.factor = 1;
                    l.iridescence.ior = 1.4F;
                    l.iridescence.thickness_maximum = 150 + 750 * t;
                  }));
}

/// A wall of stripes behind the balls, for them to show.
Shot before_stripes(const std::function<void(Material& material, MaterialLobes& lobes, float t)>& set) {
  Shot shot = balls([&](Material& m, MaterialLobes& l, float t) {
    m.base_color = {1, 1, 1, 1};
    m.roughness = 0;
    l.transmission.factor = 1;
    l.volume.thickness = 1;
    set(m, l, t);
  });
  Image stripes(16, 16, 3, PixelType::u8, Transfer::srgb);
  const auto codes = stripes.values<std::uint8_t>();
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::size_t x = i / 3 % 16, y = i / 48;
    const std::uint8_t color[3] = {static_cast<std::uint8_t>(x < 8 ? 235 : 30),
                                   static_cast<std::uint8_t>(y < 8 ? 200 : 60), 90};
    codes[i] = color[i % 3];
  }
  const int wall =
      add_material(shot.scene, "wall", glm::vec3(1), add_picture(shot.scene, "stripes", stripes), 1);
  add_object(shot.scene, "wall", rectangle({0, 0, -1.2F}, {1, 0, 0}, {0, 1, 0}, {10, 3}, 0.3F), wall);
  return shot;
}

void draw_glass(Sitting& sitting) {
  sitting.picture("Index of refraction from 1 to 1.75.",
                  before_stripes([](Material&, MaterialLobes& l, float t) { l.ior = 1 + 0.75F * t; }));
  sitting.picture("Roughness from 0 to 0.6.",
                  before_stripes([](Material& m, MaterialLobes&, float t) { m.roughness = 0.6F * t; }));
  sitting.picture("Transmission from 0 to 1.",
                  before_stripes([](Material&, MaterialLobes& l, float t) { l.transmission.factor = t; }));
  sitting.picture("Green that takes 2 m to 0.1 m of glass.",
                  before_stripes([](Material&, MaterialLobes& l, float t) {
                    l.volume.attenuation_color = {0.2F, 0.8F, 0.35F};
                    l.volume.attenuation_distance = 2 + (0.1F - 2) * t;
                  }));
}

constexpr Figure kFigures[] = {
    {"material-maps", "Normal, roughness and occlusion maps", "glTF 2.0, 3.9.3", "Ridges and checks.",
     "Ridges of a normal map throw no shadows, and stay flat at the outline.", "laterna render scene.glb",
     draw_maps},
    {"material-lobes", "Clear coat, sheen, specular, brushed metal, films",
     "KHR_materials_clearcoat, _sheen, _specular, _ior, _anisotropy and _iridescence",
     "Left to right one number grows; all else stays.",
     "Light that is scattered between layers is left out, and so is what one ball shows of the others.",
     "laterna render scene.glb", draw_lobes},
    {"material-glass", "Through glass", "KHR_materials_transmission and _volume",
     "The wall is seen through each ball, bent as if light left it a metre deeper; shadows take on its "
     "colour.",
     "Glass is not seen through glass, nor what lies outside the picture; shadows are tinted, but light is "
     "not "
     "focused.",
     "laterna render scene.glb", draw_glass},
};

}  // namespace

Chapter material_chapter() {
  return {"Khronos Group: glTF 2.0 and its material extensions", "Materials, a number at a time.", kFigures};
}

}  // namespace laterna::app
