// Row 66: textures with depth (MIT 6.837, lecture 20; Oliveira, Bishop and McAllister 2000), against meshes that are truly
// displaced, drawn by the same engine.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "laterna/relief.h"
#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

// One channel of 16 bits; heights 0 … 1.
struct Heights {
  int width = 0, height = 0;
  std::vector<std::uint16_t> values;

  Heights(int w, int h, const std::function<double(int, int)>& height_at) : width(w), height(h) {
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x)
        values.push_back(static_cast<std::uint16_t>(std::lround(65535 * height_at(x, y))));
    }
  }
  // Texel (x, y), continued beyond the sides.
  [[nodiscard]] double texel(int x, int y, Wrap wrap) const {
    const auto held = [wrap](int i, int size) {
      if (wrap == Wrap::clamp) return std::clamp(i, 0, size - 1);
      const int period = wrap == Wrap::repeat ? size : 2 * size;
      const int within = (i % period + period) % period;
      return within < size ? within : 2 * size - 1 - within;
    };
    return values[static_cast<std::size_t>(held(y, height) * width + held(x, width))] / 65535.0;
  }
  // Between the middles of texels, bilinearly.
  [[nodiscard]] double at(glm::dvec2 uv, Wrap wrap = Wrap::repeat) const {
    const double x = uv.x * width - 0.5, y = uv.y * height - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const auto row = [&](int v) { return std::lerp(texel(i, v, wrap), texel(i + 1, v, wrap), x - i); };
    return std::lerp(row(j), row(j + 1), y - j);
  }
};

// Courses of bricks with bevelled edges between mortar: 4 × 8 of them.
Heights bricks(int side) {
  return {side, side, [side](int x, int y) {
            const double course = y * 8.0 / side, row = std::floor(course);
            const double brick = x * 4.0 / side + 0.5 * std::fmod(row, 2);
            const double dx = std::min(brick - std::floor(brick), std::ceil(brick) - brick) / 4;
            const double dy = std::min(course - row, row + 1 - course) / 8;
            const double rough = 0.06 * std::sin(0.9 * x) * std::cos(1.3 * y);
            return std::clamp((std::min(dx, dy) - 0.008) / 0.012, 0.0, 1.0) * 0.92 + 0.04 + rough * 0.5;
          }};
}

int add_heights(Scene& scene, const Heights& heights) {
  auto image = std::make_shared<Image>(heights.width, heights.height, 1, PixelType::u16, Transfer::srgb);
  std::copy(heights.values.begin(), heights.values.end(), image->values<std::uint16_t>().begin());
  Picture picture;
  picture.pixels = std::move(image);
  scene.pictures.push_back(std::move(picture));
  return static_cast<int>(scene.pictures.size()) - 1;
}

constexpr double kDepth = 0.06;  // metres

// A floor from −1 to 1 in x and z whose texture coordinates are (x + 1) / 2, (z + 1) / 2, with a relief.
void add_relief_floor(Scene& scene, const Heights& heights, Relief relief = {}) {
  add_object(scene, "floor", floor(1), {0.8F, 0.7F, 0.6F});
  if (relief.depth == Relief().depth) relief.depth = kDepth;
  relief.texture.picture = add_heights(scene, heights);
  scene.materials.back().relief = std::make_shared<const Relief>(relief);
}

// The same floor as triangles, four quads for each cell between texels.
void add_displaced_floor(Scene& scene, const Heights& heights) {
  const int side = 2 * heights.width;
  Primitive p;
  for (int j = 0; j <= side; ++j) {
    for (int i = 0; i <= side; ++i) {
      const glm::dvec2 uv(static_cast<double>(i) / side, static_cast<double>(j) / side);
      p.positions.emplace_back(2 * uv.x - 1, kDepth * (heights.at(uv) - 1), 2 * uv.y - 1);
      p.uv[0].emplace_back(uv);
    }
  }
  const auto row = static_cast<std::uint32_t>(side + 1);
  for (std::uint32_t j = 0; j + 1 < row; ++j) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = j * row + i;
      p.indices.insert(p.indices.end(), {a, a + row, a + row + 1, a, a + row + 1, a + 1});
    }
  }
  add_object(scene, "floor", std::move(p), {0.8F, 0.7F, 0.6F});
}

// Looks down on the floor's middle at an angle from its normal.
View camera_at(double angle_deg, double aspect) {
  const double a = angle_deg * 3.14159265358979 / 180;
  return look({0.3, 2.5 * std::cos(a), 2.5 * std::sin(a)}, {0, 0, 0}, 30, aspect);
}

constexpr int kWidth = 240, kHeight = 180;

RenderSettings settings_with(std::vector<Layer> layers, ShadowTechnique technique = ShadowTechnique::none) {
  RenderSettings settings = test_settings(kWidth, kHeight);
  settings.shading = ShadingModel::papers;
  settings.shadows = technique;
  settings.layers = std::move(layers);
  return settings;
}

LayeredImage draw(Scene scene, const RenderSettings& settings, const View& camera = camera_at(60, 4.0 / 3)) {
  return make_renderer(std::move(scene)).render(camera, settings).value();
}

glm::dvec3 position(const LayeredImage& image, int x, int y) {
  return {at(image, "P.X", x, y), at(image, "P.Y", x, y), at(image, "P.Z", x, y)};
}

// Whether a pixel shows the inside of the floor: its border has no walls in a relief, and a mesh has no border.
bool is_inside(const LayeredImage& image, int x, int y) {
  const glm::dvec3 p = position(image, x, y);
  return at(image, "id.object", x, y) == 0 && std::abs(p.x) < 0.85 && std::abs(p.z) < 0.85;
}

// At 60° every pixel shows the point of the brick that the displaced mesh shows there: its place on the mesh is in the pixel's
// middle, and the mesh is seen as far away there, or, where outlines of bricks run between pixels, within one pixel of it.
TEST(Relief, BricksAt60DegreesLieWhereTheDisplacedMeshHasThem) {
  const Heights heights = bricks(64);
  Scene with_relief, with_mesh;
  add_relief_floor(with_relief, heights);
  add_displaced_floor(with_mesh, heights);
  const RenderSettings settings = settings_with({Layer::position, Layer::object, Layer::depth});
  const LayeredImage relief = draw(std::move(with_relief), settings),
                     mesh = draw(std::move(with_mesh), settings);
  const glm::dmat4 image_from_world = camera_at(60, 4.0 / 3).image_from_world();
  int pixels = 0, moved = 0, elsewhere = 0;
  double most = 0, squares = 0;
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth; ++x) {
      if (!is_inside(relief, x, y)) continue;
      const glm::dvec3 p = position(relief, x, y);
      const double height = kDepth * (heights.at({(p.x + 1) / 2, (p.z + 1) / 2}) - 1);
      const glm::dvec4 on_mesh = image_from_world * glm::dvec4(p.x, height, p.z, 1);
      const double parallax = glm::length(
          glm::dvec2(on_mesh.x / on_mesh.w * kWidth - x - 0.5, on_mesh.y / on_mesh.w * kHeight - y - 0.5));
      ++pixels;
      most = std::max(most, parallax);
      squares += parallax * parallax;
      const double distance = at(relief, "Z", x, y);
      double nearest = distance + 1, farthest = 0;
      for (int v = y - 1; v <= y + 1; ++v) {
        for (int u = x - 1; u <= x + 1; ++u) {
          nearest = std::min<double>(nearest, at(mesh, "Z", u, v));
          farthest = std::max<double>(farthest, at(mesh, "Z", u, v));
        }
      }
      moved += std::abs(distance - at(mesh, "Z", x, y)) > 0.002 ? 1 : 0;
      elsewhere += distance < nearest - 1e-4 || distance > farthest + 1e-4 ? 1 : 0;
    }
  }
  EXPECT_GT(pixels, 10000);
  EXPECT_LE(most, 0.05);
  EXPECT_LE(std::sqrt(squares / pixels), 0.005);
  EXPECT_EQ(elsewhere, 0);
  EXPECT_LE(moved, pixels / 200);
  RecordProperty("most_px", std::to_string(most));
  RecordProperty("rms_px", std::to_string(std::sqrt(squares / pixels)));
  RecordProperty("pixels_with_another_point", moved);
}

// Seen at 60° from the normal, a step of depth d hides d tan 60° of the floor behind it.
TEST(Relief, AStepShiftsByItsDepthTimesTheTangent) {
  const Heights step(64, 1, [](int x, int) { return x < 32 ? 1.0 : 0.0; });
  Scene scene;
  Relief clamped;
  clamped.texture.sampler.wrap_u = Wrap::clamp;
  add_relief_floor(scene, step, clamped);
  const double sine = std::sin(3.14159265358979 / 3), cosine = 0.5;
  View camera = look({-3 * sine, 3 * cosine, 0}, {0, 0, 0}, 30, 1);
  camera.projection = Projection::orthographic(0.5, 0.5, 0.1, 20);
  RenderSettings settings = settings_with({Layer::position});
  settings.width = settings.height = 500;
  const LayeredImage image = draw(std::move(scene), settings, camera);
  // Upward in the picture is away from the camera.
  int edge = 499;
  while (edge > 0 && at(image, "P.Y", 250, edge) > -1e-4F) --edge;
  const double pixel = 1.0 / 500 / cosine;                   // along the floor
  const double top = 2 * (31.5 / 64) - 1;                    // the last middle of a texel that is high
  EXPECT_NEAR(at(image, "P.X", 250, edge + 1), top, pixel);  // the edge of the step
  EXPECT_NEAR(at(image, "P.Y", 250, edge), -kDepth, 1e-5);
  EXPECT_NEAR(at(image, "P.X", 250, edge), top + kDepth * sine / cosine, pixel);
}

// Heights of no order, of odd size, however they go on beyond their sides: what is seen lies on the surface, and nothing of the
// surface stands before it.
TEST(Relief, NothingOfTheSurfaceStandsBeforeWhatIsSeen) {
  std::mt19937 random(7);
  const Heights heights(7, 5, [&](int, int) { return static_cast<double>(random() % 1000) / 999; });
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
    Scene scene;
    Relief relief;
    relief.texture.sampler.wrap_u = relief.texture.sampler.wrap_v = wrap;
    relief.texture.uv_from_mesh_uv = {2.2F, 0.5F, -0.6F, -0.4F, 2.7F, -0.7F};
    relief.kind = ReliefKind::depth;
    relief.depth = 0.3;
    add_relief_floor(scene, heights, relief);
    RenderSettings settings = settings_with({Layer::position, Layer::object});
    settings.width = settings.height = 48;
    const glm::dvec3 eye(1.5, 0.9, 2.2);
    const LayeredImage image = draw(std::move(scene), settings, look(eye, {0, 0, 0}, 30, 1));
    const auto depth_at = [&](glm::dvec3 p) {
      const glm::dvec2 uv((p.x + 1) / 2, (p.z + 1) / 2);
      return 0.3 * heights.at({2.2 * uv.x + 0.5 * uv.y - 0.6, -0.4 * uv.x + 2.7 * uv.y - 0.7}, wrap);
    };
    int seen = 0;
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 48; ++x) {
        if (at(image, "id.object", x, y) != 0) continue;
        ++seen;
        const glm::dvec3 p = position(image, x, y);
        ASSERT_NEAR(-p.y, depth_at(p), 1e-4) << x << " " << y;
        const glm::dvec3 top = p + (eye - p) * (-p.y / (eye.y - p.y));
        for (int i = 0; i < 500; ++i) {
          const glm::dvec3 before = glm::mix(top, p, i / 500.0);
          ASSERT_LE(-before.y, depth_at(before) + 1e-4) << x << " " << y << " " << i;
        }
      }
    }
    EXPECT_GT(seen, 500);
  }
}

// Lit by a slide and a low lamp, under a post and with a ball that lies in the mortar.
void light_and_fill(Scene& scene) {
  add_object(scene, "ball", sphere({0.1F, 0.02F, 0.2F}, 0.1F, 32), {0.2F, 0.4F, 0.9F});
  add_object(scene, "post", box({-0.35F, 0.25F, 0.3F}, {0.03F, 0.25F, 0.03F}), {0.9F, 0.3F, 0.2F});
  Light lantern;
  lantern.name = "lantern";
  lantern.type = LightType::projector;
  lantern.projection = Projection::perspective(Angle::degrees(40), 1, 0.1, 20);
  lantern.slide = add_picture(scene, 8, 8, [](int x, int y) {
    return (x + y) % 2 == 0 ? glm::u8vec3(255, 220, 60) : glm::u8vec3(30, 60, 220);
  });
  lantern.shadow.resolution = 1024;
  add_light(scene, lantern, {-1.2, 1.8, 0.9}, {0, 0, 0});
  Light lamp = spot("lamp", 60);
  lamp.shadow.resolution = 1024;
  add_light(scene, lamp, {2.6, 0.9, -0.7}, {0, 0, 0});
}

struct LitPair {
  LayeredImage relief, mesh;
};
LitPair draw_lit(ShadowTechnique technique, std::vector<Layer> layers, Relief relief = {}) {
  const Heights heights = bricks(64);
  Scene with_relief, with_mesh;
  add_relief_floor(with_relief, heights, relief);
  add_displaced_floor(with_mesh, heights);
  light_and_fill(with_relief);
  light_and_fill(with_mesh);
  layers.push_back(Layer::position);
  layers.push_back(Layer::object);
  return {draw(std::move(with_relief), settings_with(layers, technique)),
          draw(std::move(with_mesh),
               settings_with(layers,
                             technique == ShadowTechnique::none ? technique : ShadowTechnique::raytraced))};
}

// The share of the floor's inner pixels on which a channel differs by more than a twentieth.
double differing_share(const LayeredImage& a, const LayeredImage& b, const std::string& channel) {
  int pixels = 0, differing = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (!is_inside(a, x, y) || !is_inside(b, x, y)) continue;
      ++pixels;
      differing += std::abs(at(a, channel, x, y) - at(b, channel, x, y)) > 0.05F ? 1 : 0;
    }
  }
  EXPECT_GT(pixels, 8000);
  return static_cast<double>(differing) / pixels;
}

// Slides, shadows of other things and the relief's own fall where rays say they fall on the mesh.
TEST(Relief, SlidesAndShadowsLandOnTheDisplacedPoint) {
  for (const ShadowTechnique technique :
       {ShadowTechnique::map, ShadowTechnique::exact, ShadowTechnique::raytraced}) {
    const LitPair lit = draw_lit(technique, {Layer::visibility, Layer::light});
    SCOPED_TRACE(static_cast<int>(technique));
    EXPECT_LE(differing_share(lit.relief, lit.mesh, "visibility.lamp"), 0.025);
    EXPECT_LE(differing_share(lit.relief, lit.mesh, "visibility.lantern"), 0.025);
    EXPECT_LE(differing_share(lit.relief, lit.mesh, "light.lantern.B"), 0.03);
    Relief flat_light;
    flat_light.self_shadow = false;
    const LitPair unshaded = draw_lit(technique, {Layer::visibility}, flat_light);
    EXPECT_GE(differing_share(unshaded.relief, unshaded.mesh, "visibility.lamp"), 0.1);
  }
}

// A ball that lies half below the plane of the polygon is seen as it is on the mesh.
TEST(Relief, WhatReachesIntoItIsHiddenByItsHeights) {
  const LitPair lit = draw_lit(ShadowTechnique::none, {});
  int ball = 0, different = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool in_relief = at(lit.relief, "id.object", x, y) == 1,
                 in_mesh = at(lit.mesh, "id.object", x, y) == 1;
      ball += in_mesh ? 1 : 0;
      different += in_relief != in_mesh ? 1 : 0;
    }
  }
  EXPECT_GT(ball, 300);
  EXPECT_LE(different, 8);
}

// Light that comes from the heights' gradient: on a plane that leans, Lambert's cosine.
TEST(Relief, ItsNormalIsThatOfItsHeights) {
  const Heights ramp(64, 1, [](int x, int) { return x / 63.0; });
  Scene scene;
  add_relief_floor(scene, ramp);
  const LayeredImage image = draw(std::move(scene), settings_with({Layer::normal}), camera_at(30, 4.0 / 3));
  const double slope = kDepth * 64 / 63 / 2;  // metres per metre: a tile is 2 m wide
  const double length = std::sqrt(1 + slope * slope);
  EXPECT_NEAR(at(image, "N.X", kWidth / 2, kHeight / 2), -slope / length, 1e-4);
  EXPECT_NEAR(at(image, "N.Y", kWidth / 2, kHeight / 2), 1 / length, 1e-4);
  EXPECT_NEAR(at(image, "N.Z", kWidth / 2, kHeight / 2), 0, 1e-4);
}

// Where the edges are cut, the outline is that of the heights: at its far side nothing stands where they are low.
TEST(Relief, CutEdgesShowTheOutline) {
  const auto covered = [](double height, bool cuts) {
    const Heights flat(4, 4, [height](int, int) { return height; });
    Scene scene;
    Relief relief;
    relief.cut_edges = cuts;
    add_relief_floor(scene, flat, relief);
    View camera = look({0, 1.5, 2.598076}, {0, 0, 0}, 30, 1);
    camera.projection = Projection::orthographic(1.2, 1.2, 0.1, 20);
    RenderSettings settings = settings_with({Layer::object});
    settings.width = settings.height = 480;
    const LayeredImage image = draw(std::move(scene), settings, camera);
    int pixels = 0;
    for (int y = 0; y < 480; ++y) pixels += at(image, "id.object", 240, y) == 0 ? 1 : 0;
    return pixels;
  };
  // 2 m at 30° to the line of sight are 1 m high on screen, and a pixel is 5 mm.
  EXPECT_NEAR(covered(0, false), 200, 1);
  EXPECT_NEAR(covered(1, true), 200, 1);
  // Of the rays that enter, those over the last d tan 60° leave again at the far side.
  EXPECT_NEAR(covered(0, true), 200 - kDepth * std::sqrt(3.0) * 0.5 / 0.005, 1);
}

TEST(Relief, NoDepthIsNoRelief) {
  const Heights heights = bricks(32);
  Scene flat, without;
  Relief none;
  none.depth = 0;
  add_relief_floor(flat, heights, none);
  add_relief_floor(without, heights);
  without.materials.back().relief = nullptr;
  for (Scene* scene : {&flat, &without}) light_and_fill(*scene);
  RenderSettings settings =
      settings_with({Layer::light, Layer::visibility, Layer::position}, ShadowTechnique::map);
  settings.shading = ShadingModel::pbr;
  EXPECT_EQ(count_different_pixels(draw(std::move(flat), settings), draw(std::move(without), settings)), 0U);
}

// Every instruction set and number of threads gives the same bits, with one pass and with many.
TEST(Relief, IsTheSameOnEveryMachine) {
  const auto scene = [] {
    Scene made;
    Relief relief;
    relief.cut_edges = true;
    add_relief_floor(made, bricks(48), relief);
    light_and_fill(made);
    return made;
  };
  RenderSettings settings =
      settings_with({Layer::light, Layer::visibility, Layer::normal}, ShadowTechnique::map);
  settings.width = 150, settings.height = 110;
  settings.samples = 2;
  const View camera = camera_at(65, 15.0 / 11);
  const LayeredImage expected =
      make_renderer(scene(), 1, InstructionSet::scalar).render(camera, settings).value();
  for (const InstructionSet set : supported_instruction_sets()) {
    const Renderer renderer = make_renderer(scene(), 3, set);
    EXPECT_EQ(count_different_pixels(expected, renderer.render(camera, settings).value()), 0U)
        << name_of(set);
    settings.passes = Passes::multi;
    EXPECT_EQ(count_different_pixels(expected, renderer.render(camera, settings).value()), 0U)
        << name_of(set);
    settings.passes = Passes::single;
  }
}

}  // namespace
}  // namespace laterna
