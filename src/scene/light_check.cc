#include "scene/light_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/lamps.h"
#include "scene/scene_check.h"

namespace laterna {
namespace {

class LightCheck : SceneCheck {
 public:
  LightCheck(const Scene& scene, FaultList& faults) : SceneCheck(scene, faults) {}

  void run() { check_lights(); }

 private:
  void check_lights();
  void check_light(const Light& light, const std::string& place);
  void check_panel(const Light& light, const std::string& place);
  void check_distribution(const Light& light, const std::string& place);
  void check_distortion(const Light& light, const std::string& place);
  void check_aperture(const Light& light, const std::string& place);
  void check_source(const Light& light, const std::string& place);
  void check_shadow(const ShadowSettings& shadow, const std::string& place);
  void check_plane(const ShadowPlane& plane, const std::string& place);
};

void LightCheck::check_lights() {
  check_names(scene_.lights, "lights");
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) check_light(scene_.lights[i], item("lights", i));
}

void LightCheck::check_light(const Light& light, const std::string& place) {
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

void LightCheck::check_panel(const Light& light, const std::string& place) {
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

void LightCheck::check_distribution(const Light& light, const std::string& place) {
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

void LightCheck::check_distortion(const Light& light, const std::string& place) {
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

void LightCheck::check_aperture(const Light& light, const std::string& place) {
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

void LightCheck::check_source(const Light& light, const std::string& place) {
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

void LightCheck::check_shadow(const ShadowSettings& shadow, const std::string& place) {
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

void LightCheck::check_plane(const ShadowPlane& plane, const std::string& place) {
  for (int k = 0; k < 3; ++k)
    check_number(place + ".normal", plane.normal[k], -kMaxCoordinate, kMaxCoordinate);
  check_number(place + ".distance", plane.distance, -kMaxCoordinate, kMaxCoordinate);
  if (glm::dot(plane.normal, plane.normal) < 1e-24)
    fault(place + ".normal", "expected a vector that is not zero");
}

}  // namespace

void check_lights(const Scene& scene, FaultList& faults) { LightCheck(scene, faults).run(); }

}  // namespace laterna
