// The lecture's relief textures, re-made.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <memory>

#include "laterna/relief.h"
#include "paintings.h"
#include "sitting.h"

namespace laterna::app {
namespace {

constexpr int kHeightsSide = 512;
constexpr float kPaving = 2.4F;  // metres
constexpr float kJoint = 0.06F;  // their depth

/// Where a place of the paving, 0…1, lies on its stone: how far from the joints, 0 … 1, and which stone it is.
struct OnStone {
  float height = 0;
  int stone = 0;
};
OnStone stone_at(glm::vec2 p) {
  const float course = p.y * 10, row = std::floor(course);
  const bool is_odd = (static_cast<int>(row) & 1) != 0;
  const float along = p.x * 5 + (is_odd ? 0.5F : 0.0F), column = std::floor(along);
  // Distances from the stone's sides, in stones' heights.
  const float dx = 2 * std::min(along - column, column + 1 - along);
  const float dy = std::min(course - row, row + 1 - course);
  constexpr float kRound = 0.22F, kGap = 0.05F;
  const float ax = std::max(kRound + kGap - dx, 0.0F), ay = std::max(kRound + kGap - dy, 0.0F);
  const float inside = std::max(1 - std::sqrt(ax * ax + ay * ay) / kRound, 0.0F);
  const float dome = std::sqrt(std::max(1 - (1 - inside) * (1 - inside), 0.0F));
  return {dome, static_cast<int>(row) * 7 + static_cast<int>(column) * 3};
}

Image paint_heights() {
  Image image(kHeightsSide, kHeightsSide, 1, PixelType::u16, Transfer::linear);
  const std::span<std::uint16_t> values = image.values<std::uint16_t>();
  std::size_t next = 0;
  for (int y = 0; y < kHeightsSide; ++y) {
    for (int x = 0; x < kHeightsSide; ++x) {
      const glm::vec2 p = (glm::vec2(x, y) + 0.5F) / static_cast<float>(kHeightsSide);
      values[next++] = static_cast<std::uint16_t>(std::lround(65535 * stone_at(p).height));
    }
  }
  return image;
}

Image paint_stones() {
  Image image(kHeightsSide, kHeightsSide, 3, PixelType::u8, Transfer::srgb);
  const std::span<std::uint8_t> values = image.values<std::uint8_t>();
  std::size_t next = 0;
  for (int y = 0; y < kHeightsSide; ++y) {
    for (int x = 0; x < kHeightsSide; ++x) {
      const OnStone at = stone_at((glm::vec2(x, y) + 0.5F) / static_cast<float>(kHeightsSide));
      const float shade = 0.8F + 0.04F * static_cast<float>(at.stone % 6);
      const glm::vec3 stone = glm::vec3(0.80F, 0.76F, 0.70F) * shade;
      const glm::vec3 colour = glm::mix(glm::vec3(0.42F, 0.38F, 0.34F), stone, std::min(4 * at.height, 1.0F));
      for (int c = 0; c < 3; ++c) values[next++] = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
    }
  }
  return image;
}

enum class Paving { flat, relief, mesh };

/// Texture coordinates are x and z.
Primitive square() {
  const float s = kPaving / 2;
  Primitive p;
  p.positions = {{-s, 0, s}, {s, 0, s}, {s, 0, -s}, {-s, 0, -s}};
  p.normals.assign(4, {0, 1, 0});
  p.uv[0] = {{-s, s}, {s, s}, {s, -s}, {-s, -s}};
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

/// What the relief stands for, as triangles.
Primitive displaced(const Image& heights) {
  const auto texel = [&](int x, int y) {
    return heights.value(std::clamp(x, 0, kHeightsSide - 1), std::clamp(y, 0, kHeightsSide - 1), 0);
  };
  return terrain({0, 0, 0}, kPaving, kHeightsSide, [&](float x, float z) {
    const glm::vec2 p = (glm::vec2(x, z) / kPaving + 0.5F) * static_cast<float>(kHeightsSide) - 0.5F;
    const glm::vec2 low = glm::floor(p), share = p - low;
    const int i = static_cast<int>(low.x), j = static_cast<int>(low.y);
    const float above = glm::mix(texel(i, j), texel(i + 1, j), share.x),
                below = glm::mix(texel(i, j + 1), texel(i + 1, j + 1), share.x);
    return kJoint * (glm::mix(above, below, share.y) - 1);
  });
}

/// Paving with a bowl in it, lit by a slide and a low lamp.
Shot paving(Paving as) {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0.10F);
  const int stones =
      add_material(scene, "stones", glm::vec3(1), add_picture(scene, "stones", paint_stones()), 0.7F);
  Texture& texture = scene.materials.back().base_color_texture;
  texture.sampler.wrap_u = texture.sampler.wrap_v = Wrap::clamp;
  texture.uv_from_mesh_uv = {1 / kPaving, 0, 0.5F, 0, 1 / kPaving, 0.5F};
  const Image heights = paint_heights();
  if (as == Paving::relief) {
    Relief relief;
    relief.texture = texture;
    relief.texture.picture = add_picture(scene, "heights", heights);
    relief.depth = static_cast<double>(kJoint);
    relief.cut_edges = true;
    scene.materials.back().relief = std::make_shared<const Relief>(relief);
  }
  add_object(scene, "paving", as == Paving::mesh ? displaced(heights) : square(), stones);
  const int clay = add_material(scene, "clay", {0.75F, 0.35F, 0.25F});
  add_object(scene, "ball", ball({0.62F, 0.06F, 0.35F}, 0.12F), clay);
  add_object(scene, "post", box({-0.72F, -0.06F, -0.2F}, {-0.66F, 0.5F, -0.14F}), clay);
  Light& lantern = add_projector(scene, "lantern", {{-0.6, 2.2, 1.6}, {0, 0, 0.1}}, Angle::degrees(34),
                                 add_picture(scene, "lake", paint_lake(768, 512)));
  lantern.color = glm::vec3(0.9F);
  lantern.shadow.resolution = 2048;
  Light& lamp =
      add_lamp(scene, "lamp", {{2.4, 0.75, -1.2}, {0, 0, 0}}, Angle::degrees(50), {0.9F, 0.75F, 0.5F});
  lamp.shadow.resolution = 2048;
  shot.camera = {{0.5, 1.05, 2.2}, {0.02, -0.02, 0.1}};
  shot.yfov = Angle::degrees(38);
  return shot;
}

std::optional<LayeredImage> picture_of(Sitting& sitting, Paving as) {
  const std::optional<Drawing> ready = sitting.prepare(paving(as));
  if (!ready) return std::nullopt;
  return sitting.accept(ready->renderer.render(ready->view, ready->settings));
}

void draw_relief(Sitting& sitting) {
  sitting.picture("Flat: the slide and the shadows lie in one plane.", paving(Paving::flat));
  sitting.picture("The same two triangles with a relief.", paving(Paving::relief));
  sitting.picture("The truth: 524288 triangles.", paving(Paving::mesh));
  const auto relief = picture_of(sitting, Paving::relief), mesh = picture_of(sitting, Paving::mesh);
  if (relief && mesh)
    sitting.print("Relief and triangles: their difference, four times.",
                  difference_picture(*relief, *mesh, 4));
  const Detail part = {0.42, 0.5, 0.2, 0.2, 4};
  sitting.detail("Relief, enlarged: the slide bends over the stones, which shade one another.",
                 paving(Paving::relief), part);
  sitting.detail("Triangles, enlarged.", paving(Paving::mesh), part);
}

constexpr Figure kFigures[] = {
    {"relief", "A texture with depth", "Slides on relief textures",
     "Heights on two triangles, found along every ray of sight. Parallax, outlines, the slide, the shadow of "
     "the post and the "
     "stones' own are those of the displaced mesh.",
     "What a relief casts on other things is the shadow of its flat polygon.",
     "\"surfaces\": [{\"material\": \"stones\", \"relief\": {\"picture\": \"heights.png\", \"depth\": 0.06, "
     "\"cut_edges\": true}}]",
     draw_relief},
};

}  // namespace

Chapter relief_chapter() {
  return {"MIT 6.837, lecture 20: relief textures", "Oliveira, Bishop and McAllister, 2000, per pixel.",
          kFigures};
}

}  // namespace laterna::app
