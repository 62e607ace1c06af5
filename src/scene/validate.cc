// The rules that every scene must meet before it is rendered, whether it was read or built in code.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <unordered_map>

#include "laterna/lamps.h"
#include "laterna/scene.h"
#include "scene/animation_check.h"
#include "scene/fault_list.h"
#include "scene/normals.h"
#include "scene/number_scans.h"
#include "scene/spelling.h"
#include "scene/surface_attributes.h"

namespace laterna {
namespace {

// Of a photograph: beyond, it is no exposure.
constexpr float kMostGain = 1e6F;

std::string item(std::string_view list, std::size_t index) { return fmt::format("{}[{}]", list, index); }

template <class Vector>
bool is_finite(const Vector& v) {
  for (int i = 0; i < Vector::length(); ++i) {
    if (!std::isfinite(v[i])) return false;
  }
  return true;
}

class Validator {
 public:
  explicit Validator(const Scene& scene) : scene_(scene) {}

  std::vector<Diagnostic> run() {
    check_pictures();
    for (std::size_t i = 0; i < scene_.materials.size(); ++i)
      check_material(scene_.materials[i], item("materials", i));
    check_meshes();
    check_cameras();
    check_lights();
    check_photographs();
    check_whole_scene();
    check_animation(scene_, faults_);
    check_nodes();
    return faults_.errors();
  }

 private:
  void fault(std::string place, std::string message) { faults_.error(std::move(place), std::move(message)); }

  // Reports a value outside [low, high], or not finite.
  void check_number(const std::string& place, double value, double low, double high) {
    if (value >= low && value <= high && std::isfinite(value)) return;
    if (std::isinf(high)) {
      fault(place, fmt::format("expected a finite number of at least {}, got {}", low, value));
    } else {
      fault(place, fmt::format("expected a number from {} to {}, got {}", low, high, value));
    }
  }

  template <class Vector>
  void check_color(const std::string& place, const Vector& color, double high) {
    for (int i = 0; i < Vector::length(); ++i) {
      check_number(item(place, static_cast<std::size_t>(i)), color[i], 0, high);
    }
  }

  // Values that a cast may have put into an enumeration.
  template <class Enumeration>
  void check_enumerator(const std::string& place, Enumeration value, Enumeration last) {
    const auto number = static_cast<unsigned>(value);
    if (number > static_cast<unsigned>(last)) {
      fault(place, fmt::format("{} is no value of the enumeration, which ends at {}", number,
                               static_cast<unsigned>(last)));
    }
  }

  void check_reference(const std::string& place, int index, std::size_t count, std::string_view list) {
    if (index >= -1 && (index < 0 || static_cast<std::size_t>(index) < count)) return;
    fault(place, fmt::format("{} is no index into the {} {}, nor -1 for none", index, count, list));
  }

  void check_pictures();
  void check_film(const Picture& picture, const std::string& place);
  void check_texture(const Texture& texture, const std::string& place);
  void check_material(const Material& material, const std::string& place);
  void check_layers(const Material& material, const std::string& place);
  void check_layer_projector(const SurfaceLayer& layer, const std::string& place);
  void check_meshes();
  void check_primitive(const Primitive& primitive, const std::string& place);
  template <class Vector>
  void check_attribute(const std::vector<Vector>& values, const Primitive& primitive,
                       const std::string& place);
  void check_directions(const Primitive& primitive, const std::string& place);
  void check_triangles(const Primitive& primitive, const std::string& place);
  void check_cameras();
  void check_lights();
  void check_light(const Light& light, const std::string& place);
  void check_panel(const Light& light, const std::string& place);
  void check_distribution(const Light& light, const std::string& place);
  void check_distortion(const Light& light, const std::string& place);
  void check_source(const Light& light, const std::string& place);
  void check_aperture(const Light& light, const std::string& place);
  void check_shadow(const ShadowSettings& shadow, const std::string& place);
  void check_plane(const ShadowPlane& plane, const std::string& place);
  void check_photographs();
  void check_photograph(const Photograph& photograph, const std::string& place);
  void check_whole_scene();
  void check_environment(const Environment& environment);
  void check_environment_picture(const std::string& place, int picture, bool is_needed);
  void check_nodes();
  void check_node(const Node& node, const std::string& place);
  void check_matrix(const glm::dmat4& matrix, const std::string& place);
  bool check_parents();
  void check_places();
  void check_placed_meshes(const std::vector<glm::dmat4>& world_from_node);
  template <class Named>
  void check_names(const std::vector<Named>& things, std::string_view list);

  const Scene& scene_;
  FaultList faults_{std::string()};
};

void Validator::check_pictures() {
  for (std::size_t i = 0; i < scene_.pictures.size(); ++i) {
    const Picture& picture = scene_.pictures[i];
    const int sources =
        (picture.file.empty() ? 0 : 1) + (picture.encoded.empty() ? 0 : 1) + (picture.pixels ? 1 : 0);
    if (sources != 1) {
      fault(item("pictures", i),
            fmt::format("expected exactly one of file, encoded and pixels, got {}", sources));
    }
    if (picture.pixels && picture.pixels->empty())
      fault(item("pictures", i) + ".pixels", "the image is empty");
    if (picture.film) check_film(picture, item("pictures", i) + ".film");
  }
}

void Validator::check_film(const Picture& picture, const std::string& place) {
  const FilmTiming& film = *picture.film;
  if (picture.file.empty()) fault(place, "is set, but the picture is no file");
  const auto check = [&](const char* name, double value, double most) {
    if (!(value > 0 && value <= most))
      fault(place + name, fmt::format("expected a number greater than 0, at most {:g}, got {}", most, value));
  };
  check(".frames_per_second", film.frames_per_second, kMaxFramesPerSecond);
  check(".rate", film.rate, kMaxFilmRate);
  if (!(std::abs(film.start) <= kMaxSceneTime))
    fault(place + ".start", fmt::format("expected a number from {:g} to {:g}, got {}", -kMaxSceneTime,
                                        kMaxSceneTime, film.start));
  check_enumerator(place + ".at_end", film.at_end, AtEnd::ping_pong);
}

void Validator::check_texture(const Texture& texture, const std::string& place) {
  check_reference(place + ".picture", texture.picture, scene_.pictures.size(), "pictures");
  const auto picture = static_cast<std::size_t>(texture.picture);
  if (texture.is_set() && picture < scene_.pictures.size() && scene_.pictures[picture].film)
    fault(place + ".picture", "is a film; only a light's slide can be one");
  check_enumerator(place + ".sampler.wrap_u", texture.sampler.wrap_u, Wrap::clamp);
  check_enumerator(place + ".sampler.wrap_v", texture.sampler.wrap_v, Wrap::clamp);
  check_enumerator(place + ".sampler.magnify", texture.sampler.magnify, Filter::linear);
  check_enumerator(place + ".sampler.minify", texture.sampler.minify, Filter::linear);
  check_enumerator(place + ".sampler.mip", texture.sampler.mip, MipFilter::linear);
  if (texture.uv_set != 0 && texture.uv_set != 1) {
    fault(place + ".uv_set", fmt::format("expected 0 or 1, got {}", texture.uv_set));
  }
  for (std::size_t i = 0; i < texture.uv_from_mesh_uv.size(); ++i) {
    if (std::isfinite(texture.uv_from_mesh_uv[i])) continue;
    fault(item(place + ".uv_from_mesh_uv", i),
          fmt::format("expected a finite number, got {}", texture.uv_from_mesh_uv[i]));
  }
}

void Validator::check_material(const Material& material, const std::string& place) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  check_color(place + ".base_color", material.base_color, kMaxRadiance);
  check_enumerator(place + ".alpha_mode", material.alpha_mode, AlphaMode::blend);
  check_number(place + ".metallic", material.metallic, 0, 1);
  check_number(place + ".roughness", material.roughness, 0, 1);
  check_number(place + ".normal_scale", material.normal_scale, -1e6, 1e6);
  check_number(place + ".occlusion_strength", material.occlusion_strength, 0, 1);
  check_color(place + ".emissive", material.emissive, kMaxRadiance);
  check_number(place + ".alpha_cutoff", material.alpha_cutoff, 0, kEndless);
  check_texture(material.base_color_texture, place + ".base_color_texture");
  check_texture(material.metallic_roughness_texture, place + ".metallic_roughness_texture");
  check_texture(material.normal_texture, place + ".normal_texture");
  check_texture(material.occlusion_texture, place + ".occlusion_texture");
  check_texture(material.emissive_texture, place + ".emissive_texture");
  check_layers(material, place + ".layers");
}

void Validator::check_layers(const Material& material, const std::string& place) {
  if (material.layers.size() > kMaxSurfaceLayers)
    fault(place, fmt::format("{} layers are more than {}", material.layers.size(), kMaxSurfaceLayers));
  for (std::size_t i = 0; i < material.layers.size(); ++i) {
    const SurfaceLayer& layer = material.layers[i];
    const std::string at = item(place, i);
    check_texture(layer.texture, at + ".texture");
    check_layer_projector(layer, at + ".projector");
    check_color(at + ".color", layer.color, kMaxRadiance);
    check_number(at + ".opacity", layer.opacity, 0, 1);
    check_enumerator(at + ".blend", layer.blend, BlendMode::dot3);
  }
}

void Validator::check_layer_projector(const SurfaceLayer& layer, const std::string& place) {
  check_reference(place, layer.projector, scene_.lights.size(), "lights");
  if (layer.projector < 0 || static_cast<std::size_t>(layer.projector) >= scene_.lights.size()) return;
  const Light& light = scene_.lights[static_cast<std::size_t>(layer.projector)];
  if (layer.texture.is_set()) fault(place, "is set beside a texture: a layer shows one or the other");
  if (light.type != LightType::projector)
    fault(place, fmt::format("light {} is no projector", in_quotes(light.name)));
  if (light.slide_is_intensity)
    fault(place, fmt::format("light {} throws an intensity map, which is no colour", in_quotes(light.name)));
  if (std::none_of(scene_.nodes.begin(), scene_.nodes.end(),
                   [&](const Node& node) { return node.light == layer.projector; }))
    fault(place, fmt::format("light {} stands at no node", in_quotes(light.name)));
}

void Validator::check_meshes() {
  std::uint64_t vertices = 0, triangles = 0;
  for (std::size_t m = 0; m < scene_.meshes.size(); ++m) {
    const std::vector<Primitive>& primitives = scene_.meshes[m].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      check_primitive(primitives[p], item(item("meshes", m) + ".primitives", p));
      vertices += primitives[p].positions.size();
      triangles += triangle_count(primitives[p]);
    }
  }
  if (vertices > kMaxVertices)
    fault("meshes", fmt::format("{} vertices are more than {}", vertices, kMaxVertices));
  if (triangles > kMaxTriangles)
    fault("meshes", fmt::format("{} triangles are more than {}", triangles, kMaxTriangles));
}

template <class Vector>
void Validator::check_attribute(const std::vector<Vector>& values, const Primitive& primitive,
                                const std::string& place) {
  if (!values.empty() && values.size() != primitive.positions.size()) {
    fault(place, fmt::format("has {} elements, but there are {} positions", values.size(),
                             primitive.positions.size()));
  }
  const std::span<const float> components = components_of(values);
  const std::size_t bad = first_not_finite(components);
  if (bad == components.size()) return;
  fault(item(place, bad / static_cast<std::size_t>(Vector::length())), "expected finite numbers");
}

void Validator::check_directions(const Primitive& primitive, const std::string& place) {
  const auto flat = std::find(primitive.normals.begin(), primitive.normals.end(), glm::vec3(0));
  if (flat != primitive.normals.end()) {
    fault(item(place + ".normals", static_cast<std::size_t>(flat - primitive.normals.begin())),
          "a normal has no length");
  }
  for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
    const glm::vec4 tangent = primitive.tangents[i];
    if (glm::vec3(tangent) != glm::vec3(0) && std::abs(tangent.w) == 1) continue;
    fault(item(place + ".tangents", i), "expected a direction, and w = 1 or -1");
    break;
  }
  if (!primitive.tangents.empty() && primitive.normals.empty()) {
    fault(place + ".tangents", "tangents mean nothing without normals");
  }
}

void Validator::check_triangles(const Primitive& primitive, const std::string& place) {
  if (primitive.indices.empty()) {
    if (primitive.positions.size() % 3 == 0) return;
    fault(place + ".positions",
          fmt::format("without indices, expected a multiple of 3, got {}", primitive.positions.size()));
    return;
  }
  if (primitive.indices.size() % 3 != 0) {
    fault(place + ".indices", fmt::format("expected a multiple of 3, got {}", primitive.indices.size()));
  }
  const std::size_t beyond = first_beyond(primitive.indices, primitive.positions.size());
  if (beyond == primitive.indices.size()) return;
  fault(item(place + ".indices", beyond),
        fmt::format("{} is beyond the {} positions", primitive.indices[beyond], primitive.positions.size()));
}

void Validator::check_primitive(const Primitive& primitive, const std::string& place) {
  check_attribute(primitive.positions, primitive, place + ".positions");
  check_attribute(primitive.normals, primitive, place + ".normals");
  check_attribute(primitive.tangents, primitive, place + ".tangents");
  check_attribute(primitive.uv[0], primitive, place + ".uv[0]");
  check_attribute(primitive.uv[1], primitive, place + ".uv[1]");
  check_attribute(primitive.colors, primitive, place + ".colors");
  check_directions(primitive, place);
  check_triangles(primitive, place);
  check_reference(place + ".material", primitive.material, scene_.materials.size(), "materials");
  if (primitive.material < 0 || static_cast<std::size_t>(primitive.material) >= scene_.materials.size())
    return;
  for (const Texture* texture : textures_of(scene_.materials[static_cast<std::size_t>(primitive.material)])) {
    const auto set = static_cast<std::size_t>(texture->uv_set);
    if (!texture->is_set() || set > 1 || primitive.positions.empty() || !primitive.uv[set].empty()) continue;
    fault(fmt::format("{}.uv[{}]", place, set),
          fmt::format("is empty, but materials[{}] has a texture that uses it", primitive.material));
    return;
  }
}

template <class Named>
void Validator::check_names(const std::vector<Named>& things, std::string_view list) {
  std::unordered_map<std::string_view, std::size_t> first;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const auto [found, is_new] = first.try_emplace(things[i].name, i);
    if (!is_new) {
      fault(item(list, i) + ".name",
            fmt::format("{} is also the name of {}[{}]", in_quotes(things[i].name), list, found->second));
    }
  }
}

void Validator::check_cameras() {
  check_names(scene_.cameras, "cameras");
  for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
    if (std::string message = find_fault(scene_.cameras[i].projection); !message.empty()) {
      fault(item("cameras", i) + ".projection", std::move(message));
    }
  }
}

void Validator::check_lights() {
  check_names(scene_.lights, "lights");
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) check_light(scene_.lights[i], item("lights", i));
}

void Validator::check_photographs() {
  check_names(scene_.photographs, "photographs");
  for (std::size_t i = 0; i < scene_.photographs.size(); ++i)
    check_photograph(scene_.photographs[i], item("photographs", i));
  const PhotographSettings& settings = scene_.photograph_settings;
  const std::string place = "photograph_settings";
  if (settings.visibility != ShadowTechnique::exact && settings.visibility != ShadowTechnique::map &&
      settings.visibility != ShadowTechnique::raytraced) {
    fault(place + ".visibility", "expected exact, map or raytraced");
  }
  check_enumerator(place + ".blend", settings.blend, PhotographBlend::view);
  check_number(place + ".feather", settings.feather, 0, 0.5);
  check_color(place + ".unseen", settings.unseen, kMaxRadiance);
}

void Validator::check_photograph(const Photograph& photograph, const std::string& place) {
  if (photograph.picture < 0 || static_cast<std::size_t>(photograph.picture) >= scene_.pictures.size()) {
    fault(place + ".picture",
          fmt::format("{} is no index into the {} pictures", photograph.picture, scene_.pictures.size()));
  } else if (scene_.pictures[static_cast<std::size_t>(photograph.picture)].film) {
    fault(place + ".picture", "is a film: only slides may change with time");
  }
  if (std::string message = find_fault(photograph.projection); !message.empty()) {
    fault(place + ".projection", std::move(message));
  } else if (photograph.projection.is_orthographic) {
    fault(place + ".projection", "a photograph's projection must be perspective");
  }
  if (std::string message = find_fault(photograph.pose); !message.empty())
    fault(place + ".pose", std::move(message));
  for (int i = 0; i < 3; ++i) {
    const float gain = photograph.gain[i];
    if (gain > 0 && gain <= kMostGain) continue;
    fault(item(place + ".gain", static_cast<std::size_t>(i)),
          fmt::format("expected a number above 0 and up to {}, got {}", kMostGain, gain));
  }
}

void Validator::check_light(const Light& light, const std::string& place) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  check_enumerator(place + ".type", light.type, LightType::projector);
  check_enumerator(place + ".profile", light.profile, BeamProfile::uniform_candela);
  check_enumerator(place + ".outside", light.outside, Outside::mirror);
  check_enumerator(place + ".attenuation", light.attenuation, Attenuation::custom);
  check_color(place + ".color", light.color, kEndless);
  check_number(place + ".intensity", light.intensity, 0, kEndless);
  // Radiance is light per area and angle: it needs room above the intensity itself.
  constexpr double kMaxProduct = 1e30;
  const double brightest = std::max({light.color.x, light.color.y, light.color.z});
  if (std::isfinite(light.intensity) && std::isfinite(brightest) &&
      light.intensity * brightest > kMaxProduct) {
    fault(place + ".intensity",
          fmt::format("{} times the colour's {} is more than {}", light.intensity, brightest, kMaxProduct));
  }
  if (light.lumens) {
    check_number(place + ".lumens", *light.lumens, 0, kEndless);
    if (light.type == LightType::directional)
      fault(place + ".lumens", "a directional light's brightness is not given in lumens");
    // Candela are lumens by solid angle.
    constexpr double kMaxLumens = 1e18;
    if (std::isfinite(brightest) && *light.lumens * brightest > kMaxLumens)
      fault(place + ".lumens",
            fmt::format("{} times the colour's {} is more than {}", *light.lumens, brightest, kMaxLumens));
    constexpr double kNarrowest = 0.01;
    if (light.type == LightType::spot && light.outer_cone.in_degrees() < kNarrowest) {
      fault(place + ".outer_cone", fmt::format("expected at least {} degrees of a light in lumens, got {}",
                                               kNarrowest, light.outer_cone.in_degrees()));
    }
  }
  check_distribution(light, place + ".distribution");
  if (!(light.range > 0))
    fault(place + ".range", fmt::format("expected a number greater than 0, got {}", light.range));
  if (light.attenuation == Attenuation::custom && !light.custom_attenuation) {
    fault(place + ".custom_attenuation", "is not set, but attenuation is custom");
  }
  if (light.type == LightType::spot) {
    const double inner = light.inner_cone.in_degrees(), outer = light.outer_cone.in_degrees();
    if (!(inner >= 0 && inner <= outer && outer <= 90)) {
      fault(place + ".outer_cone",
            fmt::format("expected 0 <= inner cone <= outer cone <= 90 degrees, got {:.6g} and {:.6g}", inner,
                        outer));
    }
  }
  check_reference(place + ".slide", light.slide, scene_.pictures.size(), "pictures");
  if (light.slide_is_intensity && light.slide < 0) {
    fault(place + ".slide", "is not set, but slide_is_intensity says that it holds the intensities");
  }
  if (std::string message = find_fault(light.projection); has_frustum(light) && !message.empty()) {
    fault(place + ".projection", std::move(message));
  }
  if (light.type == LightType::directional && !light.fit && !light.projection.is_orthographic) {
    fault(place + ".projection", "a directional light's projection must be orthographic");
  }
  check_enumerator(place + ".blend", light.blend, BlendMode::dot3);
  if (light.blend != BlendMode::add) {
    if (light.type != LightType::projector)
      fault(place + ".blend", "only a projector combines with light in another way than add");
    if (const std::string_view message = find_light_fault(light.blend); !message.empty())
      fault(place + ".blend", std::string(message));
  }
  check_panel(light, place);
  check_distortion(light, place + ".distortion");
  check_source(light, place + ".source");
  check_aperture(light, place + ".aperture");
  check_shadow(light.shadow, place + ".shadow");
  if (std::string message = find_fault(light.shadow.depth, light); !message.empty())
    fault(place + ".shadow.depth", std::move(message));
  if (std::string message = find_fault(light.shadow.warp, light); !message.empty())
    fault(place + ".shadow.warp", std::move(message));
  if (std::string message = find_fault(light.shadow.layout, light); !message.empty())
    fault(place + ".shadow.layout", std::move(message));
  if (light.shadow.technique) {
    if (std::string message = find_fault(*light.shadow.technique, light); !message.empty())
      fault(place + ".shadow.technique", std::move(message));
  }
}

void Validator::check_panel(const Light& light, const std::string& place) {
  check_number(place + ".black_level", light.black_level, 0, 1);
  if (light.black_level > 0 && light.slide_is_intensity)
    fault(place + ".black_level", "an intensity map holds all that is thrown: it has no black level");
  check_number(place + ".panel_width", light.panel_width, 0, kMaxImageSide);
  check_number(place + ".panel_height", light.panel_height, 0, kMaxImageSide);
  if ((light.panel_width == 0) != (light.panel_height == 0)) {
    fault(place + ".panel_height", fmt::format("expected a width and a height, or neither, got {} x {}",
                                               light.panel_width, light.panel_height));
  }
}

void Validator::check_distribution(const Light& light, const std::string& place) {
  if (light.distribution == nullptr) return;
  if (light.type != LightType::point && light.type != LightType::spot)
    fault(place, "only point and spot lights have one");
  std::string message = find_fault(*light.distribution);
  if (message.empty() && light.lumens && luminous_flux(*light.distribution) <= 0)
    message = "is dark: it cannot be scaled to lumens";
  constexpr double kMaxCandela = 1e30;
  if (message.empty() && light.intensity * *std::max_element(light.distribution->candela.begin(),
                                                             light.distribution->candela.end()) >
                             kMaxCandela)
    message = fmt::format("its candela times the light's intensity are more than {}", kMaxCandela);
  if (!message.empty()) fault(place, std::move(message));
}

void Validator::check_distortion(const Light& light, const std::string& place) {
  if (light.distortion.is_none() || !find_fault(light.projection).empty()) return;
  if (light.type != LightType::projector) return fault(place, "only a projector has a lens that distorts");
  if (light.aspect_from_slide) {
    return fault(place,
                 "needs a frame of a known shape: set aspect_from_slide to false, and the slide's aspect in "
                 "the projection");
  }
  if (std::string message = find_fault(light.distortion, light.projection); !message.empty())
    fault(place, std::move(message));
  // Which directions its bright parts go to is the lens's affair.
  if (light.slide_is_intensity && light.lumens)
    fault(place, "an intensity map behind a lens that distorts is given in candela, not lumens");
}

void Validator::check_aperture(const Light& light, const std::string& place) {
  const Aperture& aperture = light.aperture;
  check_number(place + ".radius", aperture.radius, 0, kMaxCoordinate);
  if (!(aperture.focal_distance >= kNearestFocus)) {
    fault(place + ".focal_distance",
          fmt::format("expected at least {} m, got {}", kNearestFocus, aperture.focal_distance));
  }
  if (!(aperture.radius > 0)) return;
  if (light.type != LightType::projector || light.projection.is_orthographic)
    fault(place + ".radius", "only a projector with perspective has a lens to open");
  if (light.source.has_size())
    fault(place + ".radius", "the light shines from its lens: leave out the source's size");
}

void Validator::check_source(const Light& light, const std::string& place) {
  const LightSource& source = light.source;
  check_number(place + ".radius", source.radius, 0, kMaxCoordinate);
  check_number(place + ".width", source.width, 0, kMaxCoordinate);
  check_number(place + ".height", source.height, 0, kMaxCoordinate);
  check_number(place + ".angular_diameter", source.angular_diameter.in_degrees(), 0, 90);
  const bool is_sun = light.type == LightType::directional;
  const bool is_ball = source.radius > 0, is_rectangle = source.width > 0 || source.height > 0;
  if (is_sun && (is_ball || is_rectangle))
    fault(place, "a directional light is far away: its size is an angular_diameter");
  if (!is_sun && source.angular_diameter.in_degrees() > 0)
    fault(place + ".angular_diameter", "only a directional light's size is an angle");
  if (is_ball && is_rectangle) fault(place, "it is either a ball or a rectangle, not both");
}

void Validator::check_shadow(const ShadowSettings& shadow, const std::string& place) {
  check_enumerator(place + ".filter", shadow.filter, ShadowFilter::averaged_depths);
  check_enumerator(place + ".warp", shadow.warp, ShadowWarp::light_space_perspective);
  check_enumerator(place + ".layout", shadow.layout, ShadowLayout::dual_paraboloid);
  check_enumerator(place + ".caster_faces", shadow.caster_faces, CasterFaces::back_only);
  if (shadow.resolution < 0 || shadow.resolution > kMaxShadowResolution) {
    fault(place + ".resolution", fmt::format("expected from 1 to {}, or 0 for the default, got {}",
                                             kMaxShadowResolution, shadow.resolution));
  }
  if (shadow.kernel < kLeastKernel || shadow.kernel > kMostKernel) {
    fault(place + ".kernel",
          fmt::format("expected from {} to {}, got {}", kLeastKernel, kMostKernel, shadow.kernel));
  }
  check_enumerator(place + ".depth", shadow.depth, ShadowDepth::radial);
  check_enumerator(place + ".moments", shadow.moments, ShadowMoments::exponential);
  check_number(place + ".soft_edge", shadow.soft_edge, 0, kMaxCoordinate);
  check_number(place + ".bleeding_reduction", shadow.bleeding_reduction, 0, 1);
  check_number(place + ".blur", shadow.blur, 0, kMaxShadowBlur);
  if (shadow.cascades < 1 || shadow.cascades > kMostCascades) {
    fault(place + ".cascades", fmt::format("expected from 1 to {}, got {}", kMostCascades, shadow.cascades));
  }
  check_number(place + ".split_lambda", shadow.split_lambda, 0, 1);
  check_number(place + ".cascade_distance", shadow.cascade_distance, 0, kMaxCoordinate);
  check_color(place + ".color", shadow.color, 1);
  check_number(place + ".opacity", shadow.opacity, 0, 1);
  check_number(place + ".ambient", shadow.ambient, 0, 1);
  check_number(place + ".fill", shadow.fill, 0, 1);
  for (std::size_t i = 0; i < shadow.planes.size(); ++i)
    check_plane(shadow.planes[i], item(place + ".planes", i));
  check_number(place + ".smooth", shadow.smooth, 0, kMostSmoothing);
  check_enumerator(place + ".smooth_kernel", shadow.smooth_kernel, SmoothKernel::binomial);
  if (shadow.constant_bias)
    check_number(place + ".constant_bias", *shadow.constant_bias, -kMaxCoordinate, kMaxCoordinate);
  if (shadow.slope_bias)
    check_number(place + ".slope_bias", *shadow.slope_bias, -kMaxCoordinate, kMaxCoordinate);
}

void Validator::check_plane(const ShadowPlane& plane, const std::string& place) {
  for (int k = 0; k < 3; ++k)
    check_number(place + ".normal", plane.normal[k], -kMaxCoordinate, kMaxCoordinate);
  check_number(place + ".distance", plane.distance, -kMaxCoordinate, kMaxCoordinate);
  if (glm::dot(plane.normal, plane.normal) < 1e-24)
    fault(place + ".normal", "expected a vector that is not zero");
}

void Validator::check_environment(const Environment& environment) {
  const std::string place = "environment";
  const bool has_picture = environment.picture >= 0;
  if (has_picture == !environment.specular_pictures.empty())
    fault(place, "expected either a picture or specular_pictures");
  check_environment_picture(place + ".picture", environment.picture, has_picture);
  for (std::size_t i = 0; i < environment.specular_pictures.size(); ++i) {
    for (const int face : environment.specular_pictures[i])
      check_environment_picture(item(place + ".specular_pictures", i), face, true);
  }
  if (environment.chart) check_enumerator(place + ".chart", *environment.chart, EnvironmentChart::octahedral);
  check_enumerator(place + ".distance", environment.distance, EnvironmentDistance::sphere);
  check_number(place + ".intensity", environment.intensity, 0, kMaxRadiance);
  if (environment.irradiance) {
    for (std::size_t i = 0; i < 9; ++i) {
      for (int k = 0; k < 3; ++k)
        check_number(item(place + ".irradiance", i), (*environment.irradiance)[i][k], -kMaxRadiance,
                     kMaxRadiance);
    }
  }
  const glm::dmat3& rotation = environment.world_from_environment;
  const glm::dmat3 product = glm::transpose(rotation) * rotation;
  constexpr double kTolerance = 1e-6;
  bool is_rotation = glm::determinant(rotation) > 0;
  for (int i = 0; i < 9; ++i) {
    const double off = product[i / 3][i % 3] - (i / 3 == i % 3 ? 1 : 0);
    is_rotation = is_rotation && std::abs(off) <= kTolerance;
  }
  if (!is_rotation) fault(place + ".world_from_environment", "its columns are no right-handed rotation");
  for (int k = 0; k < 3; ++k) {
    const double low = environment.box_low_ws[k], high = environment.box_high_ws[k];
    check_number(place + ".center_ws", environment.center_ws[k], -kMaxCoordinate, kMaxCoordinate);
    check_number(place + ".box_low_ws", low, -kMaxCoordinate, kMaxCoordinate);
    check_number(place + ".box_high_ws", high, -kMaxCoordinate, kMaxCoordinate);
    if (environment.distance == EnvironmentDistance::box && !(low < high))
      fault(place + ".box_high_ws", "expected corners greater than those of box_low_ws");
  }
  check_number(place + ".radius", environment.radius, 0, kMaxCoordinate);
}

void Validator::check_environment_picture(const std::string& place, int picture, bool is_needed) {
  check_reference(place, picture, scene_.pictures.size(), "pictures");
  const bool is_there = picture >= 0 && static_cast<std::size_t>(picture) < scene_.pictures.size();
  if (is_needed && picture == -1) fault(place, "expected a picture");
  if (is_there && scene_.pictures[static_cast<std::size_t>(picture)].film)
    fault(place, "an environment cannot be a film");
}

void Validator::check_whole_scene() {
  if (scene_.environment) check_environment(*scene_.environment);
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  check_color("ambient", scene_.ambient, kMaxRadiance);
  if (scene_.background) check_color("background", *scene_.background, kMaxRadiance);
  if (!scene_.phong) return;
  check_number("phong.specular", scene_.phong->specular, 0, kEndless);
  check_number("phong.shininess", scene_.phong->shininess, 0, kEndless);
}

void Validator::check_matrix(const glm::dmat4& matrix, const std::string& place) {
  for (int column = 0; column < 4; ++column) {
    if (!is_finite(matrix[column])) return fault(place, "the matrix holds a value that is not finite");
    if (matrix[column][3] != (column == 3 ? 1 : 0))
      return fault(place, "the matrix's last row must be 0 0 0 1");
  }
}

void Validator::check_node(const Node& node, const std::string& place) {
  check_reference(place + ".parent", node.parent, scene_.nodes.size(), "nodes");
  check_reference(place + ".mesh", node.mesh, scene_.meshes.size(), "meshes");
  check_reference(place + ".camera", node.camera, scene_.cameras.size(), "cameras");
  check_reference(place + ".light", node.light, scene_.lights.size(), "lights");
  check_matrix(node.parent_from_node, place + ".parent_from_node");
  for (std::size_t i = 0; i < node.node_from_instance.size(); ++i) {
    check_matrix(node.node_from_instance[i], item(place + ".node_from_instance", i));
  }
}

// Whether the parents form a forest. Each walk upward stops at a node that an earlier one has passed.
bool Validator::check_parents() {
  enum class Mark : std::uint8_t { unseen, on_path, done };
  std::vector<Mark> marks(scene_.nodes.size(), Mark::unseen);
  bool is_forest = true;
  std::vector<std::size_t> path;
  for (std::size_t start = 0; start < scene_.nodes.size(); ++start) {
    path.clear();
    auto node = static_cast<std::ptrdiff_t>(start);
    while (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::unseen) {
      marks[static_cast<std::size_t>(node)] = Mark::on_path;
      path.push_back(static_cast<std::size_t>(node));
      node = scene_.nodes[static_cast<std::size_t>(node)].parent;
    }
    if (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::on_path) {
      fault(item("nodes", static_cast<std::size_t>(node)) + ".parent", "the node is its own ancestor");
      is_forest = false;
    }
    for (const std::size_t seen : path) marks[seen] = Mark::done;
  }
  return is_forest;
}

void Validator::check_nodes() {
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) check_node(scene_.nodes[i], item("nodes", i));
  // What follows walks the tree and looks into the meshes, so it needs all of them sound.
  if (faults_.has_errors() || !check_parents()) return;
  check_places();
}

void Validator::check_places() {
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene_);
  std::vector<int> camera_node(scene_.cameras.size(), -1), light_node(scene_.lights.size(), -1);
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    const Node& node = scene_.nodes[i];
    for (const auto& [index, owner, list] :
         {std::tuple{node.camera, &camera_node, "cameras"}, std::tuple{node.light, &light_node, "lights"}}) {
      if (index < 0) continue;
      int& first = (*owner)[static_cast<std::size_t>(index)];
      if (first >= 0)
        fault(item("nodes", i), fmt::format("{}[{}] already stands at nodes[{}]", list, index, first));
      first = static_cast<int>(i);
      const Result<Pose> pose = Pose::from_matrix(world_from_node[i]);
      if (!pose)
        fault(item("nodes", i),
              fmt::format("{}[{}] cannot stand here: {}", list, index, to_string(pose.error())));
      const glm::dvec4 at = world_from_node[i][3];
      if (std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) > kMaxCoordinate) {
        fault(item("nodes", i), fmt::format("{}[{}] is more than {} m away", list, index, kMaxCoordinate));
      }
    }
  }
  check_placed_meshes(world_from_node);
}

struct Bounds {
  glm::dvec3 low{0}, high{0};
  bool is_empty = true;
};

Bounds bounds_of(const Mesh& mesh) {
  Bounds bounds;
  glm::vec3 low(std::numeric_limits<float>::max()), high(-std::numeric_limits<float>::max());
  for (const Primitive& primitive : mesh.primitives) {
    for (const glm::vec3& p : primitive.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    bounds.is_empty &= primitive.positions.empty();
  }
  bounds.low = low;
  bounds.high = high;
  return bounds;
}

// Whether the box, once placed, keeps within the coordinates that single precision can calculate with.
bool is_within_reach(const Bounds& bounds, const glm::dmat4& world_from_mesh) {
  if (bounds.is_empty) return true;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                       (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                       (corner & 4) != 0 ? bounds.high.z : bounds.low.z, 1);
    const glm::dvec4 world = world_from_mesh * p;
    // Written so that NaN fails.
    if (!(std::max({std::abs(world.x), std::abs(world.y), std::abs(world.z)}) <= kMaxCoordinate))
      return false;
    if (std::isnan(world.x) || std::isnan(world.y) || std::isnan(world.z)) return false;
  }
  return true;
}

void Validator::check_placed_meshes(const std::vector<glm::dmat4>& world_from_node) {
  std::vector<Bounds> bounds;
  std::vector<std::uint64_t> triangles;
  for (const Mesh& mesh : scene_.meshes) {
    bounds.push_back(bounds_of(mesh));
    std::uint64_t count = 0;
    for (const Primitive& primitive : mesh.primitives) count += triangle_count(primitive);
    triangles.push_back(count);
  }
  std::uint64_t placed = 0;
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    const Node& node = scene_.nodes[i];
    if (node.mesh < 0) continue;
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const std::size_t copies = std::max<std::size_t>(node.node_from_instance.size(), 1);
    placed += triangles[mesh] * copies;
    if (node.skin >= 0) continue;  // placed by its joints: the frame sees where
    bool fits = node.node_from_instance.empty() ? is_within_reach(bounds[mesh], world_from_node[i]) : true;
    for (const glm::dmat4& node_from_instance : node.node_from_instance) {
      fits = fits && is_within_reach(bounds[mesh], world_from_node[i] * node_from_instance);
    }
    if (!fits)
      fault(item("nodes", i),
            fmt::format("meshes[{}] reaches more than {} m from the origin", mesh, kMaxCoordinate));
  }
  if (placed > kMaxPlacedTriangles) {
    fault("nodes", fmt::format("they show {} triangles, more than {}", placed, kMaxPlacedTriangles));
  }
}

}  // namespace

std::vector<Diagnostic> validate(const Scene& scene) { return Validator(scene).run(); }

}  // namespace laterna
