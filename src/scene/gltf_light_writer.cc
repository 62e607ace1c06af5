#include "scene/gltf_light_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "laterna/blend.h"
#include "scene/gltf_light_extensions.h"
#include "scene/gltf_setting_writer.h"
#include "scene/ies_writer.h"
#include "scene/light_flux.h"
#include "scene/rig_ranges.h"

namespace laterna::gltf {
namespace {

constexpr std::string_view kPunctual = "KHR_lights_punctual", kLamps = "EXT_lights_ies";

// glTF wants the inner cone to be smaller.
constexpr double kNearlyOuter = 0.999999;

std::string_view name_of(Attenuation attenuation) {
  switch (attenuation) {
    case Attenuation::inverse_square:
      return "inverse_square";
    case Attenuation::gltf_windowed:
      return "gltf_windowed";
    case Attenuation::linear:
      return "linear";
    case Attenuation::none:
      return "none";
    case Attenuation::custom:
      break;
  }
  return {};
}

std::string_view name_of(BlendMode mode) {
  const auto modes = list_blend_modes();
  return std::ranges::find(modes, mode, &BlendModeDescription::mode)->name;
}

std::string_view name_of(Outside outside) {
  switch (outside) {
    case Outside::black:
      return "black";
    case Outside::clamp:
      return "clamp";
    case Outside::repeat:
      return "repeat";
    case Outside::mirror:
      break;
  }
  return "mirror";
}

std::string_view name_of(AtEnd at_end) {
  switch (at_end) {
    case AtEnd::loop:
      return "loop";
    case AtEnd::hold:
      return "hold";
    case AtEnd::black:
      return "black";
    case AtEnd::ping_pong:
      break;
  }
  return "ping_pong";
}

// A cone about the axis that holds the frame, and one within it.
void set_cone_about(const Projection& p, Light& spot) {
  constexpr double kWidest = 0.999999;
  if (p.is_orthographic) {
    spot.inner_cone = Angle::radians(0);
    spot.outer_cone = Angle::radians(arctangent(
        std::hypot(std::max(-p.left, p.right), std::max(-p.bottom, p.top)) / std::max(p.far, 1e-3)));
    return;
  }
  const double x = std::max(-p.left, p.right), y = std::max(-p.bottom, p.top);
  const double outer = std::min(arctangent(std::sqrt(x * x + y * y)), kPi / 2 * kWidest);
  const double nearest = std::min({-p.left, p.right, -p.bottom, p.top});
  spot.outer_cone = Angle::radians(outer);
  spot.inner_cone = Angle::radians(nearest > 0 ? std::min(arctangent(nearest), outer * kNearlyOuter) : 0);
}

Json spot_json(const Light& spot) {
  return {{"innerConeAngle", spot.inner_cone.in_radians()}, {"outerConeAngle", spot.outer_cone.in_radians()}};
}

// A colour is at most 1 in glTF; the intensity makes up for it.
struct Shine {
  glm::vec3 color;
  double intensity;
};
Shine shine_of(const glm::vec3& color, double intensity) {
  // Lumens within next to nothing: endless is no number in JSON.
  constexpr double kMost = 1e30;
  if (!(intensity <= kMost)) intensity = kMost;
  const float most = std::max({color.x, color.y, color.z});
  if (most <= 1) return {color, intensity};
  return {glm::min(color / most, glm::vec3(1)), intensity * most};
}

// Whether our extensions take the numbers of how bright it is; glTF's own have no limit.
bool is_sayable(const Light& light) {
  return kAmountOfLight.holds(std::max({light.color.x, light.color.y, light.color.z})) &&
         kAmountOfLight.holds(light.lumens.value_or(light.intensity));
}

void set_source(Json& json, const LightSource& source) {
  if (source.radius > 0) json["radius"] = source.radius;
  if (source.width > 0 || source.height > 0) json["size"] = {source.width, source.height};
  if (source.angular_diameter.in_radians() > 0)
    set(json, "angular_diameter_deg", source.angular_diameter.in_radians());
}

// What fades toward the end of an endless range does not fade.
Attenuation attenuation_of(const Light& light) {
  if (light.attenuation == Attenuation::custom) return Attenuation::inverse_square;
  if (std::isfinite(light.range)) return light.attenuation;
  if (light.attenuation == Attenuation::linear) return Attenuation::none;
  return light.attenuation == Attenuation::gltf_windowed ? Attenuation::inverse_square : light.attenuation;
}

void set_attenuation(Json& json, const Light& light, const Light& plain) {
  const Attenuation attenuation = attenuation_of(light);
  if (attenuation != plain.attenuation) json["attenuation"] = word(name_of(attenuation));
  const bool uses_range = attenuation == Attenuation::linear || attenuation == Attenuation::gltf_windowed;
  if (uses_range && light.range != plain.range) json["range"] = light.range;
}

void set_box(Json& json, const Light& sun) {
  if (sun.fit) return;
  const Projection& p = sun.projection;
  if (p.left == -p.right && p.bottom == -p.top) {
    set(json, "half_width", p.right);
    set(json, "half_height", p.top);
  } else {
    json["frustum"] = sides(p);
  }
  set(json, "near", p.near);
  set(json, "far", p.far);
}

}  // namespace

Projection LightWriter::thrown(const Light& projector) const {
  Projection p = projector.projection;
  if (!projector.aspect_from_slide || projector.slide < 0) return p;
  const double half_width = (p.top - p.bottom) * pictures_.aspect(projector.slide) / 2;
  const double middle = (p.left + p.right) / (p.right - p.left) * half_width;
  p.left = middle - half_width;
  p.right = middle + half_width;
  return p;
}

double LightWriter::candela_of(const Light& light) const {
  if (!light.enabled) return 0;  // dark for those who cannot read "enabled"
  if (!light.lumens) return light.intensity;
  if (light.distribution != nullptr) return *light.lumens / luminous_flux(*light.distribution);
  if (light.type == LightType::spot) return *light.lumens / solid_angle_of_spot(light);
  if (light.type == LightType::point) return *light.lumens / (4 * kPi);
  // Of an intensity map the mean.
  return candela_from_lumens(*light.lumens, thrown(light), light.profile);
}

LightWriter::Plain LightWriter::plain(const Light& light) const {
  Plain plain;
  Light& shown = plain.light;
  const Shine shine = shine_of(light.color, candela_of(light));
  shown.color = shine.color;
  shown.intensity = shine.intensity;
  shown.type = light.type == LightType::projector ? LightType::spot : light.type;
  plain.json["type"] = shown.type == LightType::directional ? "directional"
                       : shown.type == LightType::spot      ? "spot"
                                                            : "point";
  if (!light.name.empty()) plain.json["name"] = light.name;
  if (shown.color != glm::vec3(1)) plain.json["color"] = components(shown.color);
  if (shown.intensity != 1) plain.json["intensity"] = shown.intensity;
  if (attenuation_of(light) == Attenuation::gltf_windowed && shown.type != LightType::directional) {
    shown.attenuation = light.attenuation;
    shown.range = light.range;
    plain.json["range"] = light.range;
  }
  if (light.type == LightType::spot) {
    shown.outer_cone = light.outer_cone;
    shown.inner_cone = light.inner_cone < light.outer_cone
                           ? light.inner_cone
                           : Angle::radians(light.outer_cone.in_radians() * kNearlyOuter);
  } else if (light.type == LightType::projector) {
    set_cone_about(thrown(light), shown);
  }
  if (shown.type == LightType::spot) plain.json["spot"] = spot_json(shown);
  return plain;
}

Result<Json> LightWriter::extension(const Light& light, const Light& plain, const std::string& place) {
  Json json = Json::object();
  if (light.attenuation == Attenuation::custom)
    document_.warn(place + ".custom_attenuation", "a function cannot be written down: inverse_square is");
  if (!light.enabled) json["enabled"] = false;
  if (is_sayable(light)) {
    if (light.color != plain.color) json["color"] = components(light.color);
    if (light.lumens) {
      set(json, "lumens", *light.lumens);
    } else if (light.intensity != plain.intensity) {
      json["intensity"] = light.intensity;
    }
  } else {
    document_.warn(
        place, fmt::format("brighter than {}: colour and intensity come back as others of the same product",
                           kAmountOfLight.high));
  }
  set_source(json, light.source);
  if (light.type == LightType::directional) {
    set_box(json, light);
  } else {
    set_attenuation(json, light, plain);
  }
  const bool has_cone = light.type == LightType::spot;
  if (has_cone && (light.inner_cone != plain.inner_cone || light.outer_cone != plain.outer_cone ||
                   light.distribution != nullptr)) {
    set(json, "inner_cone_deg", light.inner_cone.in_radians());
    set(json, "outer_cone_deg", light.outer_cone.in_radians());
  }
  if (light.type == LightType::projector) {
    if (const Result<void> written = set_projector(json, light); !written)
      return tl::unexpected(written.error());
  }
  if (Json shadow = shadow_json(light.shadow); !shadow.empty()) json["shadow"] = std::move(shadow);
  return json;
}

Result<void> LightWriter::set_projector(Json& json, const Light& light) {
  if (Result<void> written = set_slide(json, light); !written) return written;
  if (light.profile != BeamProfile::flat_field && !light.slide_is_intensity)
    json["profile"] = word("uniform_candela");
  if (light.outside != Outside::black) json["outside"] = word(name_of(light.outside));
  if (light.blend != BlendMode::add) json["blend"] = word(name_of(light.blend));
  if (light.black_level != 0) set(json, "black_level", light.black_level);
  if (light.panel_width > 0) json["pixels"] = {light.panel_width, light.panel_height};
  if (light.aperture.radius > 0) {
    set(json, "aperture_radius", light.aperture.radius);
    if (std::isfinite(light.aperture.focal_distance)) set(json, "focus", light.aperture.focal_distance);
  }
  set_frustum(json, light.projection, FrustumOf::projector, light.aspect_from_slide);
  if (!light.distortion.is_none()) {
    const LensDistortion& d = light.distortion;
    json["distortion"] = {d.k1, d.k2, d.p1, d.p2, d.k3};
  }
  return {};
}

Result<void> LightWriter::set_slide(Json& json, const Light& light) {
  if (light.slide < 0) return {};
  const Picture& picture = scene_.pictures[static_cast<std::size_t>(light.slide)];
  if (!picture.film) {
    Result<Json> slide = pictures_.slide(light.slide);
    if (!slide) return tl::unexpected(std::move(slide.error()));
    set(json, light.slide_is_intensity ? "intensity_map" : "slide", std::move(*slide));
    return {};
  }
  const FilmTiming usual;
  json["film"] = pictures_.film(light.slide);
  if (is_numbered(picture.file) && picture.film->frames_per_second != usual.frames_per_second)
    set(json, "fps", picture.film->frames_per_second);
  set_unless(json, "start", picture.film->start, usual.start);
  set_unless(json, "rate", picture.film->rate, usual.rate);
  if (picture.film->at_end != usual.at_end) set(json, "at_end", word(name_of(picture.film->at_end)));
  document_.warn(
      fmt::format("pictures[{}]", light.slide),
      fmt::format("a film is not taken in: the file names it as \"{}\"", pictures_.film(light.slide)));
  return {};
}

Result<void> LightWriter::write() {
  for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
    const Light& light = scene_.lights[i];
    if (light.distribution != nullptr) {
      index_of_.push_back(-1);
      continue;
    }
    Plain shown = plain(light);
    Result<Json> more = extension(light, shown.light, fmt::format("lights[{}]", i));
    if (!more) return tl::unexpected(std::move(more.error()));
    const bool is_projector = light.type == LightType::projector;
    if (is_projector || !more->empty())
      document_.extend(shown.json, is_projector ? kProjectorExtension : kLightingExtension, std::move(*more));
    Json& lights = document_.extension(kPunctual)["lights"];
    index_of_.push_back(static_cast<int>(lights.size()));
    lights.push_back(std::move(shown.json));
  }
  return {};
}

Result<void> LightWriter::hang(int index, const std::string& node_name, Json& node) {
  const Light& light = scene_.lights[static_cast<std::size_t>(index)];
  if (light.distribution == nullptr) {
    document_.extend(node, kPunctual, {{"light", index_of_[static_cast<std::size_t>(index)]}});
    return {};
  }
  const Shine shine = shine_of(light.color, candela_of(light));
  Light shown;
  shown.color = shine.color;
  shown.intensity = shine.intensity;
  const Result<int> listed = profile(light, node_name);
  if (!listed) return tl::unexpected(listed.error());
  Json lamp = {{"light", *listed}};
  if (shown.intensity != 1) lamp["multiplier"] = shown.intensity;
  if (shown.color != glm::vec3(1)) lamp["color"] = components(shown.color);
  Result<Json> more = extension(light, shown, fmt::format("lights[{}]", index));
  if (!more) return tl::unexpected(std::move(more.error()));
  if (!more->empty()) document_.extend(lamp, kLightingExtension, std::move(*more));
  document_.extend(node, kLamps, std::move(lamp));
  return {};
}

// Lamps of the same numbers are one file, wherever they were read from.
Result<int> LightWriter::lamp_file(const Light& light) {
  const auto known = file_of_lamp_.find(light.distribution.get());
  if (known != file_of_lamp_.end()) return known->second;
  const auto text = write_ies(*light.distribution);
  if (!text) {
    return tl::unexpected(
        Error(Failure::bad_usage,
              Diagnostic{{}, fmt::format("lights: \"{}\".distribution", light.name), text.error()}));
  }
  const auto [entry, is_new] = file_of_text_.try_emplace(*text, static_cast<int>(lamp_files_.size()));
  if (is_new) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(*text));
    Json file;
    if (surroundings_.embeds()) {
      file = {{"bufferView", document_.add_view(bytes)}, {"mimeType", "application/x-ies-lm-63"}};
    } else {
      file["uri"] =
          surroundings_.add(fmt::format("lamp{}.ies", lamp_files_.size() + 1), {bytes.begin(), bytes.end()});
    }
    lamp_files_.push_back(std::move(file));
  }
  file_of_lamp_.emplace(light.distribution.get(), entry->second);
  return entry->second;
}

// The extension's lights are lamp files, which several nodes may share; a light that is not called like its node needs its name
// there.
Result<int> LightWriter::profile(const Light& light, const std::string& node_name) {
  const std::string name = light.name == node_name ? std::string() : light.name;
  Result<int> file = lamp_file(light);
  if (!file) return file;
  const auto [entry, is_new] = profiles_.try_emplace({*file, name}, -1);
  if (!is_new) return entry->second;
  Json json = lamp_files_[static_cast<std::size_t>(*file)];
  if (!name.empty()) json["name"] = name;
  Json& lights = document_.extension(kLamps)["lights"];
  entry->second = static_cast<int>(lights.size());
  lights.push_back(std::move(json));
  return entry->second;
}

}  // namespace laterna::gltf
