#include "reference/everything.h"

#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <numeric>

#include "reference/shapes.h"

namespace laterna::reference {
namespace {

int add_rgba(Scene& scene, int side, const std::function<glm::u8vec4(int, int)>& pixel) {
  auto image = std::make_shared<Image>(side, side, 4, PixelType::u8, Transfer::srgb);
  std::span<std::uint8_t> values = image->values<std::uint8_t>();
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const glm::u8vec4 c = pixel(x, y);
      for (int k = 0; k < 4; ++k) values[static_cast<std::size_t>((y * side + x) * 4 + k)] = c[k];
    }
  }
  Picture picture;
  picture.name = "rgba";
  picture.pixels = std::move(image);
  scene.pictures.push_back(std::move(picture));
  return static_cast<int>(scene.pictures.size()) - 1;
}

glm::u8vec3 hashed(int x, int y) {
  const unsigned h = static_cast<unsigned>(x) * 2654435761U ^ static_cast<unsigned>(y) * 2246822519U;
  return {h >> 8U & 255U, h >> 16U & 255U, h >> 24U};
}

struct Pictures {
  int checker, holes, bumps, metal, slide, beam;
};

Pictures add_pictures(Scene& scene) {
  Pictures p{};
  p.checker = add_picture(scene, 64, 64, [](int x, int y) {
    return (x / 8 + y / 8) % 2 == 0 ? glm::u8vec3(230, 180, 90) : glm::u8vec3(40, 60, 120);
  });
  p.holes = add_rgba(scene, 32, [](int x, int y) {
    return glm::u8vec4(hashed(x / 4, y / 4), (x / 8 + y / 8) % 2 == 0 ? 255 : 30);
  });
  p.bumps = add_picture(scene, 32, 32, [](int x, int y) {
    return glm::u8vec3(128 + (x % 8 - 4) * 12, 128 + (y % 8 - 4) * 12, 230);
  });
  p.metal =
      add_picture(scene, 16, 16, [](int x, int y) { return glm::u8vec3(200 + x, 30 + 14 * y, 16 * x); });
  p.slide = add_picture(scene, 48, 32, [](int x, int y) { return hashed(x / 3, y / 3); });
  p.beam = add_picture(scene, 32, 32, [](int x, int y) {
    return glm::u8vec3(static_cast<std::uint8_t>(255 - 7 * (std::abs(x - 16) + std::abs(y - 16))));
  });
  return p;
}

Texture texture(int picture) {
  Texture t;
  t.picture = picture;
  return t;
}

void add_objects(Scene& scene, const Pictures& p) {
  add_object(scene, "floor", floor(12));
  scene.materials.back().base_color_texture = texture(p.checker);
  scene.materials.back().base_color_texture.uv_from_mesh_uv = {9, 2, 0, -2, 9, 0.5F};

  add_object(scene, "wall", wall(5, 2.5F, -4), {0.8F, 0.8F, 0.7F});
  scene.nodes.back().parent_from_node[3] = glm::dvec4(0, 2, 0, 1);
  scene.materials.back().normal_texture = texture(p.bumps);
  scene.materials.back().roughness = 0.6F;

  add_object(scene, "ring", torus({-1.4F, 0.8F, 0}, 0.7F, 0.25F, 32), {0.9F, 0.7F, 0.3F});
  scene.materials.back().metallic = 1;
  scene.materials.back().metallic_roughness_texture = texture(p.metal);
  scene.materials.back().occlusion_texture = texture(p.metal);

  add_object(scene, "leaves", wall(0.9F, 0.9F, 1.2F));
  scene.nodes.back().parent_from_node[3] = glm::dvec4(1.6, 1, 0, 1);
  scene.materials.back().base_color_texture = texture(p.holes);
  scene.materials.back().alpha_mode = AlphaMode::mask;
  scene.materials.back().double_sided = true;

  for (const float z : {2.0F, 1.5F}) {
    add_object(scene, "glass", sphere({z - 1.7F, 1.3F, z}, 0.5F, 20), {0.4F, z / 2, 0.9F});
    scene.materials.back().alpha_mode = AlphaMode::blend;
    scene.materials.back().base_color.a = 0.45F;
    scene.materials.back().double_sided = z > 1.8F;
  }

  add_object(scene, "lamp", box({-2.6F, 0.4F, 1.5F}, {0.3F, 0.4F, 0.3F}), {0.2F, 0.2F, 0.2F});
  scene.materials.back().emissive = {1.5F, 0.8F, 0.3F};
  scene.materials.back().emissive_texture = texture(p.slide);

  add_object(scene, "sign", box({2.8F, 1.8F, -1}, {0.4F, 0.3F, 0.1F}), {0.1F, 0.9F, 0.2F});
  scene.materials.back().unlit = true;

  Primitive painted = box({0.2F, 0.3F, 0.4F}, {0.3F, 0.3F, 0.3F});
  for (std::size_t i = 0; i < painted.positions.size(); ++i) {
    painted.colors.emplace_back(glm::vec3(hashed(static_cast<int>(i), 3)) / 255.0F, 1);
  }
  add_object(scene, "painted", std::move(painted));
  for (const double x : {-1.0, 0.0, 1.5}) {
    scene.nodes.back().node_from_instance.push_back(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, 2.4)));
  }

  add_object(scene, "casts nothing", box({3.2F, 0.5F, 1}, {0.3F, 0.5F, 0.3F}), {0.5F, 0.5F, 0.9F});
  scene.nodes.back().casts_shadow = false;
  add_object(scene, "receives nothing", box({-3.4F, 0.6F, -1}, {0.5F, 0.6F, 0.3F}), {0.9F, 0.5F, 0.5F});
  scene.nodes.back().receives_shadow = false;
  add_object(scene, "unseen", sphere({0.5F, 3, 0.5F}, 0.3F, 16));
  scene.nodes.back().visible = false;
}

Light light(const char* name, LightType type, glm::vec3 color, double intensity) {
  Light l;
  l.name = name;
  l.type = type;
  l.color = color;
  l.intensity = intensity;
  l.shadow.resolution = 200;
  return l;
}

Light projector(const char* name, int slide, Outside outside, ShadowFilter filter) {
  Light l = light(name, LightType::projector, {1, 1, 1}, 14);
  l.slide = slide;
  l.outside = outside;
  l.shadow.filter = filter;
  l.projection = Projection::perspective(Angle::degrees(38), 1, 0.2, 40);
  return l;
}

void add_lamps(Scene& scene) {
  Light bulb = light("bulb", LightType::point, {1, 0.8F, 0.6F}, 9);
  bulb.attenuation = Attenuation::gltf_windowed;
  bulb.range = 14;
  add_light(scene, bulb, {-2.5, 3, 2}, {0, 0, 0});
  Light ember = light("ember", LightType::point, {0.9F, 0.2F, 0.1F}, 0.7);
  ember.attenuation = Attenuation::custom;
  ember.custom_attenuation = [](float z) { return 1 / (1 + z * z); };
  ember.shadow.filter = ShadowFilter::percentage_closer;
  add_light(scene, ember, {2.6, 0.8, 2}, {0, 0, 0});

  Light spot = light("spot", LightType::spot, {0.6F, 0.9F, 1}, 30);
  spot.inner_cone = Angle::degrees(14);
  spot.outer_cone = Angle::degrees(28);
  spot.shadow.filter = ShadowFilter::bilinear;
  add_light(scene, spot, {1, 5, 4}, {0.3, 0, 0});
  Light wide = light("wide spot", LightType::spot, {0.3F, 0.3F, 0.5F}, 4);
  wide.outer_cone = Angle::degrees(85);
  wide.attenuation = Attenuation::linear;
  wide.range = 11;
  add_light(scene, wide, {-4, 4, 1}, {-1, 0, 0});

  Light sun = light("sun", LightType::directional, {1, 0.95F, 0.8F}, 0.8);
  add_light(scene, sun, {4, 8, 3}, {0, 0, 0});
  Light moon = light("moon", LightType::directional, {0.5F, 0.6F, 1}, 0.2);
  moon.fit = false;
  moon.projection = Projection::orthographic(4, 4, 0.1, 30);
  moon.shadow.filter = ShadowFilter::percentage_closer;
  moon.shadow.kernel = 4;
  moon.shadow.outside_is_lit = false;
  add_light(scene, moon, {-5, 9, 5}, {0, 0, 0});
}

void add_projectors(Scene& scene, const Pictures& p) {
  add_light(scene, projector("lantern", p.slide, Outside::black, ShadowFilter::refined), {-0.5, 2.2, 6},
            {0, 1.5, -4});
  add_light(scene, projector("clamped", p.slide, Outside::clamp, ShadowFilter::nearest), {5, 3, 3},
            {1, 0, 0});
  Light repeated = projector("repeated", p.checker, Outside::repeat, ShadowFilter::percentage_closer);
  repeated.profile = BeamProfile::uniform_candela;
  repeated.lumens = 20;
  add_light(scene, repeated, {-5, 4, 3}, {-1, 0, 0});
  Light mirrored = projector("mirrored", p.slide, Outside::mirror, ShadowFilter::bilinear);
  mirrored.shadow.constant_bias = 0.02;
  mirrored.shadow.slope_bias = 1;
  mirrored.shadow.caster_faces = CasterFaces::back_only;
  add_light(scene, mirrored, {0, 6, 0.5}, {0.1, 0, 0});
  Light beam = projector("beam", p.beam, Outside::black, ShadowFilter::refined);
  beam.slide_is_intensity = true;
  beam.shadow.technique = ShadowTechnique::none;
  add_light(scene, beam, {3, 4, 5}, {2, 0, -1});
  Light parallel = projector("parallel", p.checker, Outside::black, ShadowFilter::refined);
  parallel.projection = Projection::orthographic(2, 2, 0.1, 20);
  parallel.intensity = 0.4;
  add_light(scene, parallel, {-2, 6, 4}, {0, 0, 1});
}

}  // namespace

Scene everything() {
  Scene scene;
  const Pictures pictures = add_pictures(scene);
  add_objects(scene, pictures);
  add_lamps(scene);
  add_projectors(scene, pictures);
  scene.ambient = {0.06F, 0.07F, 0.09F};
  scene.ambient_is_set = true;
  return scene;
}

View everything_view(int width, int height) {
  return look({0.8, 2.6, 7.5}, {0, 0.9, 0}, 46, static_cast<double>(width) / height);
}

std::vector<Layer> all_layers(Passes passes) {
  std::vector<Layer> layers;
  for (const LayerDescription& description : list_layers()) {
    if (description.layer != Layer::passes || passes == Passes::multi) layers.push_back(description.layer);
  }
  return layers;
}

::testing::AssertionResult same_bits(const LayeredImage& a, const LayeredImage& b) {
  if (a.width != b.width || a.height != b.height) return ::testing::AssertionFailure() << "sizes differ";
  if (a.channels.size() != b.channels.size())
    return ::testing::AssertionFailure() << "numbers of channels differ";
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    if (a.channels[c].name != b.channels[c].name) {
      return ::testing::AssertionFailure() << a.channels[c].name << " and " << b.channels[c].name;
    }
    const std::vector<float>& x = a.channels[c].values;
    const std::vector<float>& y = b.channels[c].values;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (std::memcmp(&x[i], &y[i], sizeof(float)) == 0 || (x[i] != x[i] && y[i] != y[i])) continue;
      const auto width = static_cast<std::size_t>(a.width);
      return ::testing::AssertionFailure() << a.channels[c].name << " at " << i % width << ", " << i / width
                                           << ": " << x[i] << " and " << y[i];
    }
  }
  return ::testing::AssertionSuccess();
}

}  // namespace laterna::reference
