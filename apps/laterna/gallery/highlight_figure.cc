#include "highlight_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "contact_sheet.h"
#include "sitting.h"
#include "studio.h"

namespace laterna::app {
namespace {

constexpr int kSide = 300;             // pixels of a picture
constexpr double kHalfPicture = 0.56;  // metres, around a ball of half a metre
constexpr int kCoarse = 7;             // rings of the coarse ball; around, it has twice as many sides
constexpr int kCell = 3;               // pixels of a facet of the table below

// Two places of the lamp: a corner of the coarse ball lies in the highlight, and none does.
const glm::dvec3 kToLamps[] = {glm::normalize(glm::dvec3(0.45, 0.5, 1)),
                               glm::normalize(glm::dvec3(0.85, 0.85, 1))};
constexpr double kLux = 3;

// Seen without perspective and lit from infinitely far, what a point shows depends on its normal alone.
View square_on(double half) {
  return {Pose::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}).value(),
          Projection::orthographic(half, half, 0.1, 10)};
}

RenderSettings settings_of(int side) {
  RenderSettings settings;
  settings.width = settings.height = side;
  settings.shading = ShadingModel::pbr;
  settings.shadows = ShadowTechnique::none;
  return settings;
}

Primitive faceted_ball(int rings) {
  Primitive p;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    const glm::dvec2 rise = point_of_circle(0.5 * i / rings - 0.25);
    for (int j = 0; j <= around; ++j) {
      const glm::dvec2 turn = point_of_circle(static_cast<double>(j) / around);
      const glm::vec3 normal(rise.x * turn.x, rise.y, rise.x * turn.y);
      p.normals.push_back(glm::normalize(normal));
      p.positions.push_back(0.5F * p.normals.back());
    }
  }
  const auto row = static_cast<std::uint32_t>(around + 1);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(rings); ++i) {
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t a = i * row + j;
      p.indices.insert(p.indices.end(), {a, a + row, a + row + 1, a, a + row + 1, a + 1});
    }
  }
  return p;
}

// A facet for each normal, side by side toward the camera.
Primitive table_of(const std::vector<glm::vec3>& normals, int side) {
  Primitive p;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto x = static_cast<float>(static_cast<int>(i) % side),
               y = static_cast<float>(static_cast<int>(i) / side);
    const auto half = static_cast<float>(side) / 2;
    const auto first = static_cast<std::uint32_t>(p.positions.size());
    for (const glm::vec2& corner : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) {
      p.positions.emplace_back(x + corner.x - half, half - y - corner.y, 0);
      p.normals.push_back(normals[i]);
    }
    p.indices.insert(p.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  }
  return p;
}

enum class LitBy { lamp, specular_map };

Scene glazed(Primitive primitive, LitBy light, const glm::dvec3& to_lamp) {
  Scene scene;
  const int material = add_material(scene, "glaze", {0.45F, 0.05F, 0.04F}, -1, 0.3F);
  add_object(scene, "ball", std::move(primitive), material);
  scene.ambient = glm::vec3(0);
  scene.ambient_is_set = true;
  scene.background = glm::vec3(0.2F);
  if (light == LitBy::lamp) {
    add_sun(scene, "lamp", {5.0 * to_lamp, {0, 0, 0}}, glm::vec3(1)).intensity = kLux;
  } else {
    // The lamp as a disc in the sky, 12° across, which gives as much light. A cap's solid angle is 2π (1 − cosine).
    constexpr double kCosine = 0.994521895368273;  // of 6°
    constexpr double kSolidAngle = 2 * 3.14159265358979323846 * (1 - kCosine);
    scene.environment.emplace();
    scene.environment->picture =
        add_picture(scene, "lamp in the sky", sky_of([&](const glm::dvec3& direction) {
                      const bool is_lamp = glm::dot(direction, to_lamp) > kCosine;
                      return glm::vec3(is_lamp ? static_cast<float>(kLux / kSolidAngle) : 0.0F);
                    }));
    scene.environment->visible = false;
  }
  return scene;
}

Result<LayeredImage> draw(Scene scene, double half, int side) {
  const Result<Renderer> renderer = Renderer::create(std::move(scene));
  if (!renderer) return tl::unexpected(renderer.error());
  return renderer->render(square_on(half), settings_of(side));
}

glm::vec3 color_at(const LayeredImage& image, std::size_t pixel) {
  return {image.find("R")->values[pixel], image.find("G")->values[pixel], image.find("B")->values[pixel]};
}

// Gouraud's ball: light is worked out at the corners, by the code that works it out at pixels, and colours run between them.
Result<Scene> lit_at_vertices(const Primitive& ball, const glm::dvec3& to_lamp) {
  int side = 1;
  while (side * side < static_cast<int>(ball.normals.size())) ++side;
  const Result<LayeredImage> table =
      draw(glazed(table_of(ball.normals, side), LitBy::lamp, to_lamp), 0.5 * side, side * kCell);
  if (!table) return tl::unexpected(table.error());
  Primitive colored = ball;
  float most = 1;
  for (std::size_t i = 0; i < ball.normals.size(); ++i) {
    const std::size_t x = i % static_cast<std::size_t>(side) * kCell + kCell / 2;
    const std::size_t y = i / static_cast<std::size_t>(side) * kCell + kCell / 2;
    const glm::vec3 color = color_at(*table, y * static_cast<std::size_t>(side) * kCell + x);
    colored.colors.emplace_back(color, 1);
    most = std::max({most, color.r, color.g, color.b});
  }
  for (glm::vec4& color : colored.colors) color = glm::vec4(glm::vec3(color) / most, 1);
  Scene scene = glazed(std::move(colored), LitBy::lamp, to_lamp);
  scene.materials[0].unlit = true;
  scene.materials[0].base_color = glm::vec4(glm::vec3(most), 1);
  return scene;
}

// Root mean square of the difference where both show the ball, as a share of the brightest pixel of `truth`.
double error_of(const LayeredImage& image, const LayeredImage& truth) {
  const glm::dvec2 middle(kSide / 2.0);
  const double radius = 0.9 * kSide * 0.25 / kHalfPicture;  // within the coarse ball's outline
  double squares = 0, most = 0;
  int pixels = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const glm::dvec2 at(i % kSide + 0.5, i / kSide + 0.5);
    const glm::vec3 shown = color_at(image, static_cast<std::size_t>(i)),
                    expected = color_at(truth, static_cast<std::size_t>(i));
    most = std::max<double>(most, expected.g);
    if (glm::distance(at, middle) > radius) continue;
    const double difference = shown.g - expected.g;
    squares += difference * difference;
    ++pixels;
  }
  return std::sqrt(squares / pixels) / most;
}

}  // namespace

void draw_highlights(Sitting& sitting) {
  constexpr int kFine = 96;
  const Primitive coarse = faceted_ball(kCoarse), fine = faceted_ball(kFine);
  const auto accept = [&](Scene scene) {
    return sitting.accept(draw(std::move(scene), kHalfPicture, kSide));
  };
  std::vector<std::vector<LayeredImage>> rows;
  std::string errors;
  for (const glm::dvec3& to_lamp : kToLamps) {
    std::optional<Scene> gouraud = sitting.accept(lit_at_vertices(coarse, to_lamp));
    if (!gouraud) return;
    const auto by_vertex = accept(std::move(*gouraud)),
               by_pixel = accept(glazed(coarse, LitBy::lamp, to_lamp)),
               by_map = accept(glazed(coarse, LitBy::specular_map, to_lamp)),
               true_lamp = accept(glazed(fine, LitBy::lamp, to_lamp)),
               true_map = accept(glazed(fine, LitBy::specular_map, to_lamp));
    if (!by_vertex || !by_pixel || !by_map || !true_lamp || !true_map) return;
    errors +=
        fmt::format("{}{:.3f}, {:.3f}, {:.3f}", errors.empty() ? "" : "; ", error_of(*by_vertex, *true_lamp),
                    error_of(*by_pixel, *true_lamp), error_of(*by_map, *true_map));
    rows.push_back({*by_vertex, *by_pixel, *by_map, *true_lamp});
  }
  const std::string caption = fmt::format(
      "A ball of {} × {} sides, its light worked out at its corners, at its pixels, and looked up in a "
      "specular map in "
      "which the lamp is a disc of 12°; at the right a ball of {} × {} sides, at its pixels. Below, the lamp "
      "stands "
      "elsewhere. Error against the finer ball under the same light, as a share of its brightest pixel (root "
      "mean "
      "square): {}.",
      kCoarse, 2 * kCoarse, kFine, 2 * kFine, errors);
  sitting.print(caption, contact_sheet(rows));
}

}  // namespace laterna::app
