// Water that is seen through, and mirrors and water in means and films: "reflection, not shadow" (row 49).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/mirrors.h"
#include "light/mirror_plan.h"
#include "raster/raster_view.h"
#include "reference/picture_probes.h"
#include "reference/shapes.h"
#include "trace/ray_scene.h"

namespace laterna {
namespace {

using namespace reference;

constexpr double kIndex = 1.333;

// Neither mirrors nor covers anything, as far as it is told.
Mirror clear_water(glm::vec3 reflectance = glm::vec3(0)) {
  Mirror water;
  water.ior = static_cast<float>(kIndex);
  water.reflectance = reflectance;
  water.volume.emplace();
  return water;
}

int add_glowing(Scene& scene, const std::string& name, Primitive primitive, glm::vec3 color = glm::vec3(1)) {
  const int node = add_object(scene, name, std::move(primitive), color);
  scene.materials.back().unlit = true;
  return node;
}

// In the plane y = 0.
void add_water(Scene& scene, const Mirror& water, float half_side = 20) {
  scene.nodes[static_cast<std::size_t>(add_object(scene, "water", floor(half_side), glm::vec3(0)))]
      .casts_shadow = false;
  scene.materials.back().alpha_mode = AlphaMode::blend;
  scene.materials.back().base_color.a = 0;
  scene.materials.back().mirror = std::make_shared<const Mirror>(water);
}

Scene dark() {
  Scene scene;
  scene.ambient_is_set = true;
  return scene;
}

glm::dvec2 middle_of_light(const LayeredImage& image) {
  glm::dvec2 sum(0);
  double light = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double value = at(image, "R", x, y);
      sum += value * glm::dvec2(x + 0.5, y + 0.5);
      light += value;
    }
  }
  return sum / light;
}

glm::dvec2 pixel_of(const View& view, const glm::dvec3& point, int width, int height) {
  const glm::dvec4 image = view.image_from_world() * glm::dvec4(point, 1);
  return {image.x / image.w * width, image.y / image.w * height};
}

// Where light from a point below y = 0 leaves the water on its way to the eye: the shortest optical path (Fermat), by halving.
glm::dvec3 leaves_water(const glm::dvec3& point, const glm::dvec3& eye) {
  const glm::dvec2 across(eye.x - point.x, eye.z - point.z);
  const double reach = glm::length(across);
  double low = 0, high = reach;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double below = middle / std::hypot(middle, point.y),
                 above = (reach - middle) / std::hypot(reach - middle, eye.y);
    (kIndex * below < above ? low : high) = middle;
  }
  const glm::dvec2 offset = reach > 0 ? across * (low / reach) : glm::dvec2(0);
  return {point.x + offset.x, 0, point.z + offset.y};
}

// Row 49: what lies on the bottom is seen where the ray that Snell's law bends leaves the water.
TEST(Water, APointBelowIsSeenWhereItsRayLeavesTheWater) {
  const View view = look({0, 2, 3}, {0, 0, -0.5}, 60, 1.5);
  for (const glm::vec3 point : {glm::vec3(0, -1, 0.5F), glm::vec3(0.9F, -1, -1), glm::vec3(-1.2F, -1, -3)}) {
    Scene scene = dark();
    add_water(scene, clear_water());
    add_glowing(scene, "bottom", floor(30, -1), glm::vec3(0));
    Mesher dot;
    const float s = 0.04F, y = -0.9999F;
    dot.quad({point.x - s, y, point.z + s}, {point.x + s, y, point.z + s}, {point.x + s, y, point.z - s},
             {point.x - s, y, point.z - s});
    add_glowing(scene, "dot", dot.primitive);
    RenderSettings settings = test_settings(240, 160);
    settings.accumulate = 4;
    const LayeredImage image = render(make_renderer(std::move(scene)), view, settings);
    const glm::dvec2 expected = pixel_of(view, leaves_water(point, {0, 2, 3}), 240, 160);
    EXPECT_LT(glm::distance(middle_of_light(image), expected), 0.3) << point.x;
    EXPECT_GT(glm::distance(pixel_of(view, point, 240, 160), expected), 5) << "or it would tell nothing";
  }
}

// Against rays: at every pixel, what the refracted ray meets. One look knows nothing of what the eye would not see without the
// water: of a ring that stands in it, that is the other side.
TEST(Water, ShowsWhatRefractedRaysMeet) {
  const auto make = [] {
    Scene scene = dark();
    add_water(scene, clear_water());
    add_glowing(scene, "ring", torus({0, -0.8F, 0}, 0.9F, 0.25F, 32));
    scene.nodes[static_cast<std::size_t>(add_glowing(scene, "bottom", floor(8, -1.2F), glm::vec3(0)))]
        .casts_shadow = false;
    return scene;
  };
  const View view = look({0.3, 2, 2.2}, {0, -0.6, 0}, 50, 1);
  constexpr int kSide = 128;
  const LayeredImage image = render(make_renderer(make()), view, test_settings(kSide, kSide));
  const OwnedFrame own = make_frame(make());
  const trace::RayScene rays(own.frame);
  const laterna::raster::RasterView camera(view, kSide, kSide);
  int met = 0, different = 0, different_unbent = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec3 ray =
          glm::normalize(camera.direction_0 + camera.direction_x * (x + 0.5 - camera.origin_x) +
                         camera.direction_y * (y + 0.5 - camera.origin_y));
      const glm::dvec3 place = camera.eye_ws + ray * (-camera.eye_ws.y / ray.y);
      const auto is_met_along = [&](const glm::dvec3& along) {
        return rays.is_blocked(glm::vec3(place), glm::vec3(along), 1e-3F, 100, kNoTriangle);
      };
      glm::dvec3 bent(ray.x / kIndex, 0, ray.z / kIndex);
      bent.y = -std::sqrt(1 - bent.x * bent.x - bent.z * bent.z);
      const bool shown = at(image, "R", x, y) > 0.5F;
      met += is_met_along(bent) ? 1 : 0;
      different += is_met_along(bent) != shown ? 1 : 0;
      different_unbent += is_met_along(ray) != shown ? 1 : 0;
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_LE(different, met / 16);  // on outlines, by a pixel
  EXPECT_GT(different_unbent, met / 4);
}

// The same from below, against rays: they fan out as they leave the water, up to the horizon.
TEST(Water, SeenFromBelowShowsWhatRefractedRaysMeet) {
  const auto make = [] {
    Scene scene = dark();
    add_water(scene, clear_water());
    scene.materials.back().double_sided = true;
    Mesher walls;
    for (const float side : {-1.0F, 1.0F}) {
      const float x = 1.5F * side;
      walls.quad({x, 0.05F, -2}, {x, 0.05F, 2}, {x, 1.2F, 2}, {x, 1.2F, -2});
    }
    add_glowing(scene, "walls", walls.primitive);
    scene.materials.back().double_sided = true;
    return scene;
  };
  constexpr int kWidth = 160, kHeight = 90;
  for (const double yfov : {80.0, 110.0}) {
    const View view = look({0.1, -0.4, 1}, {-1.4, 0.2, 0.3}, yfov, 16.0 / 9);
    const LayeredImage image = render(make_renderer(make()), view, test_settings(kWidth, kHeight));
    const OwnedFrame own = make_frame(make());
    const trace::RayScene rays(own.frame);
    const laterna::raster::RasterView camera(view, kWidth, kHeight);
    int looked = 0, met = 0, different = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec3 ray =
            glm::normalize(camera.direction_0 + camera.direction_x * (x + 0.5 - camera.origin_x) +
                           camera.direction_y * (y + 0.5 - camera.origin_y));
        glm::dvec3 bent(ray.x * kIndex, 0, ray.z * kIndex);
        const double squared = 1 - bent.x * bent.x - bent.z * bent.z;
        if (ray.y < 0 || squared < 0.05) continue;  // what is refracted there is little
        bent.y = std::sqrt(squared);
        const glm::dvec3 place = camera.eye_ws + ray * (-camera.eye_ws.y / ray.y);
        const bool is_met = rays.is_blocked(glm::vec3(place), glm::vec3(bent), 1e-3F, 100, kNoTriangle);
        ++looked;
        met += is_met ? 1 : 0;
        different += is_met != (at(image, "R", x, y) > 0.25F) ? 1 : 0;
      }
    }
    EXPECT_GT(met, 300) << yfov;
    EXPECT_GT(looked - met, 300) << yfov;
    EXPECT_LE(different, looked / 12) << yfov;  // on outlines, and at the rim of the window
  }
}

// Row 49, and KHR_materials_volume: color^(way / distance), the way along the refracted ray; in orthographic views too.
TEST(Water, TakesOnItsColourWithTheWayBelow) {
  for (const double degrees : {0.0, 55.0}) {
    for (const bool is_orthographic : {false, true}) {
      Scene scene = dark();
      Mirror water = clear_water();
      water.volume->attenuation_color = {0.2F, 0.7F, 1};
      water.volume->attenuation_distance = 2;
      add_water(scene, water);
      add_glowing(scene, "bottom", floor(90, -1.5F));
      const double angle = degrees / 180 * std::acos(-1.0);
      View view =
          look({0, 5 * std::cos(angle), 5 * std::sin(angle)}, {0, 0, 0}, 5, 1, {0, std::sin(angle), -1});
      if (is_orthographic) view.projection = Projection::orthographic(0.5, 0.5, 0.05, 1000);
      const LayeredImage image = render(make_renderer(std::move(scene)), view, test_settings(33, 33));
      const double way = 1.5 / std::sqrt(1 - std::pow(std::sin(angle) / kIndex, 2));
      EXPECT_NEAR(at(image, "R", 16, 16), std::pow(0.2, way / 2), 1e-5) << degrees;
      EXPECT_NEAR(at(image, "G", 16, 16), std::pow(0.7, way / 2), 1e-5) << degrees;
      EXPECT_EQ(at(image, "B", 16, 16), 1) << degrees;
      EXPECT_EQ(at(image, "A", 16, 16), 1);
    }
  }
}

// From below: within Snell's window, 48.6° about the zenith, the sky; beyond it nothing but what is mirrored.
TEST(Water, SeenFromBelowHasAWindow) {
  Scene scene = dark();
  add_water(scene, clear_water(glm::vec3(1)));
  scene.materials.back().double_sided = true;
  scene.background = glm::vec3(1);
  add_glowing(scene, "bottom", floor(90, -3), glm::vec3(0));
  const View view = look({0, -1, 0}, {0, 0, 0}, 120, 1, {0, 0, 1});
  constexpr int kSide = 201;
  const LayeredImage image = render(make_renderer(std::move(scene)), view, test_settings(kSide, kSide));
  const auto row = row_of(image, "R", kSide / 2);
  const std::vector<double> edges = crossings(row, 0.2);
  ASSERT_EQ(edges.size(), 2U);
  const double window = std::tan(std::asin(1 / kIndex)) / std::tan(60 / 180.0 * std::acos(-1.0)) * kSide / 2;
  EXPECT_NEAR(edges[1] - edges[0], 2 * window, 2.5);
  EXPECT_NEAR(row[kSide / 2], 1 - 0.0204, 1e-3);
}

// Where it is shallow what lies below comes near, so that at the shore nothing jumps; and a clear sheet of index 1 is as good as none.
TEST(Water, IsNoneWhereItDoesNotBend) {
  const auto picture = [](bool with_water) {
    Scene scene = dark();
    scene.background = glm::vec3(0.1F, 0.2F, 0.4F);
    Mesher beach;
    beach.quad({-9, -2, 4}, {9, -2, 4}, {9, 1, -5}, {-9, 1, -5});
    add_glowing(scene, "beach", beach.primitive, {0.7F, 0.6F, 0.4F});
    add_glowing(scene, "post", box({0.3F, 0, 0.5F}, {0.1F, 1.2F, 0.1F}), {0.2F, 0.1F, 0});
    if (with_water) {
      Mirror water = clear_water();
      water.ior = 1;
      add_water(scene, water);
    }
    return render(make_renderer(std::move(scene)), look({0.5, 1.5, 5}, {0, 0, 0}, 50, 1),
                  test_settings(96, 96));
  };
  const LayeredImage with = picture(true), without = picture(false);
  for (const char* channel : {"R", "G", "B"}) {
    int different = 0;
    for (std::size_t i = 0; i < 96 * 96; ++i)
      different += std::abs(values_of(with, channel)[i] - values_of(without, channel)[i]) > 1e-5F ? 1 : 0;
    EXPECT_LE(different, 2 * 96) << channel;  // outlines, between pixels
  }
}

// A lit pool with waves, which move.
Scene pool() {
  Scene scene;
  add_object(scene, "bottom", floor(3, -1), {0.6F, 0.5F, 0.3F});
  add_object(scene, "ball", sphere({0.3F, -0.2F, 0}, 0.5F, 24), {0.8F, 0.3F, 0.2F});
  Mirror water = clear_water(glm::vec3(1));
  water.volume->attenuation_color = {0.3F, 0.6F, 0.7F};
  water.volume->attenuation_distance = 1;
  water.waves = {{{1, 0, 0.3}, 0.7, 0.01, {}, 0}, {{0, 0, 1}, 0.5, 0.01, 0.25, 0}};
  add_water(scene, water, 3);
  scene.materials.back().base_color = {0.1F, 0.3F, 0.3F, 0.2F};
  scene.nodes.back().casts_shadow = true;
  Light lamp;
  lamp.name = "lamp";
  lamp.type = LightType::spot;
  lamp.intensity = 30;
  add_light(scene, lamp, {1, 4, 1}, {0, 0, 0});
  scene.background = glm::vec3(0.5F, 0.6F, 0.8F);
  scene.ambient = glm::vec3(0.05F);
  return scene;
}
const View kOverPool = look({0, 1.2, 3}, {0, -0.3, 0}, 55, 1);

TEST(Water, LooksTheSameWithAnyThreadsAndInstructionSetAndItsLayersAddUp) {
  RenderSettings settings = test_settings(64, 64);
  settings.layers = {Layer::light};
  const LayeredImage one = render(make_renderer(pool(), 1), kOverPool, settings);
  for (std::size_t i = 0; i < values_of(one, "R").size(); ++i) {
    const float sum = values_of(one, "ambient.R")[i] + values_of(one, "light.lamp.R")[i] +
                      values_of(one, "reflection.R")[i];
    ASSERT_EQ(values_of(one, "R")[i], sum);
  }
  EXPECT_EQ(count_different_pixels(one, render(make_renderer(pool(), 3), kOverPool, settings)), 0U);
  for (const InstructionSet set : supported_instruction_sets())
    EXPECT_EQ(count_different_pixels(one, render(make_renderer(pool(), 1, set), kOverPool, settings)), 0U);
}

// A film's frame is the still of its time, whatever came before; and waves do move.
TEST(Water, MovesInFilmsAsInStills) {
  const RenderSettings settings = test_settings(64, 64);
  Renderer film = make_renderer(pool());
  const LayeredImage first = render(film, kOverPool, settings);
  for (const double seconds : {0.04, 0.08, 0.5}) {
    ASSERT_TRUE(film.set_time(seconds));
    RendererOptions options;
    options.time = seconds;
    const Renderer still = *Renderer::create(pool(), options);
    const LayeredImage frame = render(film, kOverPool, settings);
    EXPECT_EQ(count_different_pixels(frame, render(still, kOverPool, settings)), 0U) << seconds;
    EXPECT_GT(count_different_pixels(frame, first), 200U) << seconds;
  }
}

// While a shutter is open waves go on: over a whole period, whenever it begins, they look the same.
TEST(Water, BlursWhileAShutterIsOpen) {
  Scene scene = pool();
  Mirror water = *scene.materials[2].mirror;
  water.waves = {{{0, 0, 1}, 0.5, 0.01, 0.25, 0}};  // a period of 2 s
  scene.materials[2].mirror = std::make_shared<const Mirror>(water);
  Renderer renderer = make_renderer(std::move(scene));
  RenderSettings settings = test_settings(48, 48);
  settings.accumulate = 32;
  const auto at_time = [&](double seconds, double open) {
    EXPECT_TRUE(renderer.set_time(seconds));
    LayeredImage image = *renderer.render_exposed(kOverPool, settings, {open});
    EXPECT_EQ(renderer.time(), seconds);
    return image;
  };
  const auto difference = [](const LayeredImage& a, const LayeredImage& b) {
    double sum = 0;
    for (std::size_t i = 0; i < values_of(a, "G").size(); ++i)
      sum += std::abs(static_cast<double>(values_of(a, "G")[i]) - static_cast<double>(values_of(b, "G")[i]));
    return sum;
  };
  const LayeredImage frozen = at_time(1, 0), moved = at_time(1.5, 0);
  EXPECT_EQ(count_different_pixels(moved, render(renderer, kOverPool, settings)), 0U);
  EXPECT_LT(difference(at_time(1, 2), at_time(1.5, 2)), 0.2 * difference(frozen, moved));
}

// What is mirrored, what is refracted and the picture itself follow the camera each with maps of its own, which stay from picture to picture.
TEST(Water, MirroredViewsKeepMapsThatFollowTheCamera) {
  Scene scene = pool();
  scene.lights.clear();
  scene.nodes.erase(
      std::remove_if(scene.nodes.begin(), scene.nodes.end(), [](const Node& n) { return n.light >= 0; }),
      scene.nodes.end());
  Light sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  sun.intensity = 3;
  sun.shadow.technique = ShadowTechnique::cascades;
  sun.shadow.cascades = 2;
  sun.shadow.resolution = 128;
  add_light(scene, sun, {1, 4, 1}, {0, 0, 0});
  Light lamp;
  lamp.name = "lamp";
  lamp.type = LightType::spot;
  lamp.intensity = 10;
  lamp.shadow.technique = ShadowTechnique::map;
  lamp.shadow.resolution = 128;
  add_light(scene, lamp, {-1, 3, 1}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  RenderStatistics statistics;
  const RenderSettings settings = test_settings(48, 48);
  ASSERT_TRUE(renderer.render(kOverPool, settings, {}, &statistics));
  EXPECT_EQ(statistics.mirror_pictures, 2);
  EXPECT_EQ(statistics.maps_drawn, 3 * 2 + 1) << "cascades of three views, and the lamp's";
  ASSERT_TRUE(renderer.render(kOverPool, settings, {}, &statistics));
  EXPECT_EQ(statistics.maps_drawn, 0);
  EXPECT_EQ(statistics.maps_kept, 3 * 3);
}

// Water that ends half a pixel beside the picture: nothing of it is seen, and nothing is drawn.
TEST(Water, BesideThePictureIsNotLookedInto) {
  Scene scene = dark();
  add_water(scene, clear_water(glm::vec3(1)), 1);
  const OwnedFrame own = make_frame(std::move(scene));
  View view = look({0, 5, 5}, {0, 0, 0}, 20, 1);
  const auto looks_beside = [&](double pixels) {
    // The picture's left side is so far right of the water's right side.
    constexpr double kPixel = 0.01;
    view.pose.position_ws = {0, 5, 5};
    const glm::dvec3 right = view.pose.right_ws();
    view.projection = Projection::orthographic(0.64, 0.64, 0.1, 20);
    const double middle = 1 + pixels * kPixel + 0.5 * (view.projection.right - view.projection.left);
    view.pose.position_ws += right * middle;
    const Result<light::MirrorPlan> plan = light::make_mirror_plan(own.frame, view, 128, 128, 2);
    for (const light::MirrorView& seen : plan->views) {
      for (const double side : {seen.view.projection.left, seen.view.projection.right,
                                seen.view.projection.bottom, seen.view.projection.top})
        EXPECT_TRUE(std::abs(side) < 1e6) << side;
    }
    return std::count_if(plan->views.begin(), plan->views.end(),
                         [](const light::MirrorView& seen) { return seen.is_refracted; });
  };
  EXPECT_EQ(looks_beside(-5), 1);
  EXPECT_EQ(looks_beside(0.3), 0);
}

}  // namespace
}  // namespace laterna
