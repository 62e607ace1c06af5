// The lecture's environment and specular maps, re-made.
#include <algorithm>

#include "highlight_figure.h"
#include "laterna/environment.h"
#include "laterna/environment_probe.h"
#include "sitting.h"
#include "studio.h"

namespace laterna::app {
namespace {

/// Balls of rising roughness in a row.
Shot balls(float metallic, glm::vec3 colour) {
  Shot shot;
  Scene& scene = shot.scene;
  for (int i = 0; i < 5; ++i) {
    const float roughness = 0.25F * static_cast<float>(i);
    const int material = add_material(scene, "ball", colour, -1, roughness);
    scene.materials.back().metallic = metallic;
    add_object(scene, "ball", ball({1.1F * static_cast<float>(i - 2), 0, 0}, 0.5F), material);
  }
  scene.environment.emplace();
  scene.environment->picture = add_picture(scene, "studio", sky_of(studio));
  shot.camera = {{0, 0.5, 7}, {0, 0, 0}};
  shot.yfov = Angle::degrees(24);
  shot.settings.shading = ShadingModel::pbr;
  shot.settings.height = 280;
  return shot;
}

void draw_specular(Sitting& sitting) {
  sitting.picture(
      "Metal: roughness 0, 0.25, 0.5, 0.75 and 1. The window is at the left, and mirrored at the left.",
      balls(1, {0.95F, 0.93F, 0.88F}));
  sitting.picture("Glazed red: mirrored above, diffuse beneath.", balls(0, {0.55F, 0.08F, 0.06F}));
  sitting.picture(
      "White metal in light of 0.6 from everywhere, before a darker background: each ball sends back all "
      "that falls on "
      "it, whatever its roughness.",
      [] {
        Shot shot = balls(1, glm::vec3(1));
        shot.scene.pictures.back().pixels =
            std::make_shared<Image>(sky_of([](const glm::dvec3&) { return glm::vec3(0.6F); }));
        shot.scene.environment->visible = false;
        shot.scene.background = glm::vec3(0.4F);
        return shot;
      }());
}

constexpr glm::vec3 kLow(-3, 0, -4), kHigh(3, 3.4F, 4);
constexpr glm::dvec3 kMiddle(0, 1.5, 0);

/// A room whose walls differ, without anything in it.
Scene room() {
  Scene scene;
  Image tiles(64, 64, 3, PixelType::u8, Transfer::srgb);
  const auto codes = tiles.values<std::uint8_t>();
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::size_t x = i / 3 % 64, y = i / 192;
    codes[i] = ((x / 32 + y / 32) & 1U) != 0 ? 225 : 120;
  }
  const int checks = add_picture(scene, "checks", tiles);
  const glm::vec3 half = (kHigh - kLow) / 2.0F, middle = (kHigh + kLow) / 2.0F;
  const auto side = [&](const char* name, glm::vec3 centre, glm::vec3 right, glm::vec3 up, glm::vec2 size,
                        glm::vec3 colour) {
    add_object(scene, name, rectangle(centre, right, up, size, 1), add_material(scene, name, colour, checks));
  };
  side("floor", {0, kLow.y, 0}, {1, 0, 0}, {0, 0, -1}, {2 * half.x, 2 * half.z}, {0.8F, 0.7F, 0.55F});
  side("ceiling", {0, kHigh.y, 0}, {1, 0, 0}, {0, 0, 1}, {2 * half.x, 2 * half.z}, glm::vec3(0.8F));
  side("left", {kLow.x, middle.y, 0}, {0, 0, -1}, {0, 1, 0}, {2 * half.z, 2 * half.y}, {0.8F, 0.25F, 0.2F});
  side("right", {kHigh.x, middle.y, 0}, {0, 0, 1}, {0, 1, 0}, {2 * half.z, 2 * half.y}, {0.2F, 0.4F, 0.8F});
  side("back", {0, middle.y, kLow.z}, {1, 0, 0}, {0, 1, 0}, {2 * half.x, 2 * half.y}, {0.3F, 0.65F, 0.3F});
  side("front", {0, middle.y, kHigh.z}, {-1, 0, 0}, {0, 1, 0}, {2 * half.x, 2 * half.y},
       {0.75F, 0.65F, 0.2F});
  scene.ambient = glm::vec3(1);
  scene.ambient_is_set = true;
  return scene;
}

/// What the middle of the room sees of it; nothing where it cannot be drawn.
std::optional<Image> room_from_its_middle() {
  const Result<Renderer> renderer = Renderer::create(room());
  if (!renderer) return std::nullopt;
  RenderSettings settings;
  settings.samples = 4;
  settings.shading = ShadingModel::phong;
  const Result<LayeredImage> cube = render_environment(*renderer, {kMiddle, 256}, settings);
  if (!cube) return std::nullopt;
  const auto sky =
      convert_environment(*cube, {EnvironmentChart::cube, EnvironmentChart::latlong, kSkyHeight});
  if (!sky) return std::nullopt;
  Image image(2 * kSkyHeight, kSkyHeight, 3, PixelType::f32, Transfer::linear);
  const auto values = image.values<float>();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = sky->channels[i % 3].values[i / 3];
  return image;
}

void draw_parallax(Sitting& sitting) {
  const std::optional<Image> probe = room_from_its_middle();
  if (!probe) return;
  sitting.image("What the middle of the room sees, drawn by six views.", *probe);
  Shot shot;
  Scene& scene = shot.scene;
  scene = room();
  const int mirror = add_material(scene, "mirror", glm::vec3(1), -1, 0);
  scene.materials.back().metallic = 1;
  add_object(scene, "ball", ball({1.2F, 0.9F, -2}, 0.9F), mirror);
  // The mirror alone is to be lit, and by it alone: the room shows its colours.
  scene.ambient = glm::vec3(0);
  scene.environment.emplace();
  scene.environment->picture = add_picture(scene, "probe", *probe);
  scene.environment->center_ws = kMiddle;
  scene.environment->box_low_ws = kLow;
  scene.environment->box_high_ws = kHigh;
  scene.environment->radius = 3.2;
  for (Material& material : scene.materials) {
    if (material.metallic == 1) continue;
    material.unlit = true;
  }
  shot.camera = {{-0.6, 1.7, 2.2}, {0.9, 1.1, -2}};
  shot.yfov = Angle::degrees(46);
  sitting.picture(
      "Infinitely far: the reflected direction alone. The floor's tiles do not meet their reflections.",
      shot);
  scene.environment->distance = EnvironmentDistance::sphere;
  sitting.picture("On a sphere of 3.2 metres.", shot);
  scene.environment->distance = EnvironmentDistance::box;
  sitting.picture("On the walls: what is mirrored is where it is.", shot);
}

void draw_charts(Sitting& sitting) {
  LayeredImage source;
  source.width = 2 * kSkyHeight;
  source.height = kSkyHeight;
  const Image sky = sky_of(studio);
  for (std::size_t k = 0; k < 3; ++k) {
    Channel channel{std::string(1, "RGB"[k]), {}};
    for (std::size_t i = k; i < sky.values<float>().size(); i += 3)
      channel.values.push_back(std::min(sky.values<float>()[i], 1.0F));
    source.channels.push_back(std::move(channel));
  }
  for (const EnvironmentChartDescription& known : list_environment_charts()) {
    const auto chart = convert_environment(source, {EnvironmentChart::latlong, known.chart, 128});
    if (!chart) return;
    Image image(chart->width, chart->height, 3, PixelType::f32, Transfer::linear);
    const auto values = image.values<float>();
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = chart->channels[i % 3].values[i / 3];
    sitting.image(std::string(known.name) + ": " + std::string(known.meaning) + ".", image);
  }
}

constexpr Figure kFigures[] = {
    {"environment-map", "Mirrored, and mirrored roughly", "Slides on environment and specular maps",
     "One environment. The rougher the metal, the wider the lobe that is averaged over; the window and the "
     "lamp become "
     "highlights: lights with a size, through a filtered map.",
     "Balls do not see each other, and nothing shades the sky.",
     "laterna render scene.glb --environment sky.hdr", draw_specular},
    {"highlights", "Per vertex, per pixel, by a map", "Slides on specular maps",
     "A corner that the highlight meets spreads it over all triangles around it; of one that falls between "
     "corners "
     "hardly anything is left. At pixels it has the shape that the normals give it, and a map takes the "
     "lamp's size along.",
     "The engine lights pixels alone: the corners' light was worked out by it on a facet for each corner, "
     "and became the "
     "colours of the first ball's corners.",
     "laterna render scene.glb --environment sky.hdr", draw_highlights},
    {"parallax", "Same point, same distance", "The slide's assumption, and what a box makes of it",
     "A mirror ball away from the middle of a room, lit by what the middle sees.",
     "A box is right for walls alone: furniture would be mirrored as if it were painted on them.",
     "laterna environment --from-scene room.glb --at 0,1.5,0 -o room.hdr, and in the rig \"environment\": "
     "{\"image\": "
     "\"room.hdr\", \"center\": [0, 1.5, 0], \"box\": {\"low\": [-3, 0, -4], \"high\": [3, 3.4, 4]}}",
     draw_parallax},
    {"charts", "What's the best chart?", "The slide's question",
     "The same directions in seven charts. OpenGL's cube faces are as seen from outside, and so look "
     "mirrored.",
     "Every chart stretches some directions: laterna environment --list-charts says how much.",
     "laterna environment sky.hdr cube.exr --chart cube", draw_charts},
};

}  // namespace

Chapter environment_chapter() {
  return {"MIT 6.837, lecture 20: Advanced Texture Mapping", "Environment mapping.", kFigures};
}

}  // namespace laterna::app
