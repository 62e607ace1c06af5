#include "sets.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

#include "game_models.h"
#include "paintings.h"

namespace laterna::app {
namespace {

constexpr glm::vec3 kPlaster(0.74F, 0.72F, 0.68F);
constexpr glm::vec3 kClay(0.62F, 0.24F, 0.12F);
constexpr glm::vec3 kGlaze(0.16F, 0.38F, 0.44F);
constexpr glm::vec3 kHoney(0.72F, 0.50F, 0.16F);

Primitive urn(glm::vec3 foot) {
  return turned_piece(foot, {{0, 0},
                             {0.13F, 0},
                             {0.13F, 0},
                             {0.13F, 0.04F},
                             {0.065F, 0.08F},
                             {0.06F, 0.13F},
                             {0.16F, 0.24F},
                             {0.225F, 0.37F},
                             {0.23F, 0.48F},
                             {0.185F, 0.60F},
                             {0.105F, 0.68F},
                             {0.10F, 0.73F},
                             {0.145F, 0.80F},
                             {0.145F, 0.80F},
                             {0.125F, 0.80F},
                             {0.08F, 0.72F},
                             {0.08F, 0.66F},
                             {0, 0.64F}});
}

float random_height(int x, int z) {
  auto n = static_cast<std::uint32_t>(x) * 374761393U + static_cast<std::uint32_t>(z) * 668265263U;
  n = (n ^ (n >> 13U)) * 1274126177U;
  return static_cast<float>((n ^ (n >> 16U)) & 0xFFFFU) / 65535.0F;
}

/// Hills at the corners of squares of `side` metres, smooth between them, 0…1.
float hills(float x, float z, float side) {
  const float u = x / side + 0.37F;
  const float v = z / side + 0.11F;
  const int i = static_cast<int>(std::floor(u));
  const int k = static_cast<int>(std::floor(v));
  const float s = glm::smoothstep(0.0F, 1.0F, u - std::floor(u));
  const float t = glm::smoothstep(0.0F, 1.0F, v - std::floor(v));
  return glm::mix(glm::mix(random_height(i, k), random_height(i + 1, k), s),
                  glm::mix(random_height(i, k + 1), random_height(i + 1, k + 1), s), t);
}

float height_of_hills(float x, float z) { return 0.75F * hills(x, z, 1.7F) + 0.22F * hills(x, z, 0.6F); }

}  // namespace

Shot teapot_set() {
  Shot shot;
  set_mood(shot.scene, 0.22F);
  add_floor(shot.scene);
  shot.scene.phong = PhongHighlight{0.25F, 40};
  add_object(shot.scene, "teapot", teapot({0, 0, 0}), add_material(shot.scene, "glaze", kGlaze));
  shot.camera = {{0.55, 1.15, 2.35}, {0.12, 0.2, 0}};
  return shot;
}

Shot solids_set() {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.2F);
  add_floor(scene);
  const int plaster = add_material(scene, "plaster", kPlaster);
  const int boards =
      add_material(scene, "boards", glm::vec3(1), add_picture(scene, "boards", paint_boards(256)));
  add_object(scene, "urn", urn({-1.15F, 0, 0.35F}), plaster);
  add_object(scene, "teapot", teapot({-0.2F, 0, 0.62F}, 0.8F), add_material(scene, "glaze", kGlaze));
  add_object(scene, "ring", ring({-0.45F, 0.44F, -0.35F}, {0.75F, 0.15F, 1}, 0.35F, 0.09F),
             add_material(scene, "clay", kClay));
  add_object(scene, "plinth", box({0.55F, 0, -0.75F}, {1.15F, 0.5F, -0.15F}), boards);
  add_object(scene, "ball", ball({0.85F, 0.78F, -0.45F}, 0.28F), add_material(scene, "honey", kHoney));
  shot.camera = {{0.5, 2.1, 4.1}, {-0.05, 0.3, -0.05}};
  return shot;
}

Light& add_morning_sun(Scene& scene) {
  return add_sun(scene, "sun", {{-3.6, 4.0, 3.0}, {0, 0, 0}}, {0.95F, 0.90F, 0.80F});
}

void add_two_lamps(Scene& scene) {
  add_lamp(scene, "left", {{-3.0, 3.1, 2.3}, {0, 0.25, 0}}, Angle::degrees(24), {0.80F, 0.56F, 0.34F});
  add_lamp(scene, "right", {{2.9, 2.6, 2.2}, {0, 0.3, -0.1}}, Angle::degrees(24), {0.34F, 0.50F, 0.78F});
}

void add_walker(Scene& scene, const std::string& name, int number, glm::vec3 foot, float turn) {
  // They look along +X, mannequins along +Z.
  if (add_game_model(scene, name, number, {foot, turn - glm::half_pi<float>(), 0.13 * number})) return;
  const int coat = add_material(scene, "coat", glm::vec3(1), add_picture(scene, "coat", paint_coat(256)));
  add_object(scene, name, mannequin(foot, 0.18, turn), coat);
}

Shot parade_set(Ground ground) {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.22F);
  const auto height = [&](float x, float z) {
    return ground == Ground::hills ? height_of_hills(x, z) : 0.0F;
  };
  if (ground == Ground::hills) {
    const int hills_node = add_object(scene, "hills", terrain({0, 0, 0}, 12, 256, height_of_hills),
                                      add_material(scene, "grass", {0.42F, 0.52F, 0.24F}));
    scene.nodes[static_cast<std::size_t>(hills_node)].casts_shadow = false;
  } else {
    add_floor(scene);
  }
  constexpr std::array<glm::vec3, 4> kPlaces = {
      {{-1.7F, 0.25F, 0.55F}, {-0.75F, 0.6F, -0.25F}, {0.35F, -0.4F, 0.75F}, {1.45F, 0.8F, -0.2F}}};
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const glm::vec3 place = kPlaces.at(i);
    const glm::vec3 foot(place.x, height(place.x, place.z), place.z);
    add_walker(scene, "walker", static_cast<int>(i), foot, place.y);
  }
  shot.camera = {{0.4, 2.9, 6.9}, {0.2, 0.85, 0}};
  return shot;
}

Shot fence_set() {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.2F);
  add_floor(scene, 7);
  Primitive fence = box({-1.5F, 0.22F, -0.03F}, {1.5F, 0.34F, 0.03F});
  append(fence, box({-1.5F, 0.78F, -0.03F}, {1.5F, 0.90F, 0.03F}));
  for (int picket = 0; picket < 8; ++picket) {
    const float x = -1.44F + 0.39F * static_cast<float>(picket);
    append(fence, box({x, 0, 0.03F}, {x + 0.15F, 1.1F, 0.09F}));
  }
  add_object(scene, "fence", fence, add_material(scene, "paint", {0.78F, 0.77F, 0.72F}));
  add_object(scene, "ball", ball({0.75F, 0.28F, -0.85F}, 0.28F), add_material(scene, "clay", kClay));
  add_sun(scene, "sun", {{-2.2, 3.0, 2.6}, {0, 0, 0}}, {0.95F, 0.90F, 0.80F});
  shot.camera = {{-1.2, 1.9, -3.6}, {0.35, 0.25, -0.45}};
  return shot;
}

}  // namespace laterna::app
