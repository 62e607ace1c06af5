#include "scene/rig_lights.h"

#include <fmt/format.h>

#include <cmath>

#include "base/elementary.h"
#include "image/numbered_files.h"
#include "laterna/blend.h"
#include "laterna/film.h"
#include "laterna/image.h"
#include "laterna/lamps.h"
#include "laterna/light_color.h"
#include "scene/rig_distortion.h"
#include "scene/rig_frustum.h"
#include "scene/rig_pose.h"
#include "scene/rig_ranges.h"
#include "scene/rig_shadows.h"

namespace laterna {
namespace {

std::string_view name_of(LightType type) {
  switch (type) {
    case LightType::directional:
      return "directional light";
    case LightType::point:
      return "point light";
    case LightType::spot:
      return "spot light";
    case LightType::projector:
      break;
  }
  return "projector";
}

// Reads one light, from a rig or from an extension of glTF: the settings are the same, and their limits. `light` holds what is
// known of it before.
class LightReader {
 public:
  LightReader(const JsonDocument& json, const JsonValue& value, const SettingNames& names, LightFiles& files,
              FaultList& faults, Light light)
      : json_(json),
        object_(json, value, faults, names),
        files_(files),
        faults_(faults),
        light_(std::move(light)) {}

  // All that a rig says.
  std::optional<RigLight> read() {
    const std::size_t errors_before = faults_.error_count();
    is_lamp_ = object_.has("ies");
    object_.require("type");
    const auto type = object_.choice<LightType>("type", {{"directional", LightType::directional},
                                                         {"point", LightType::point},
                                                         {"spot", LightType::spot},
                                                         {"projector", LightType::projector}});
    if (!type) return std::nullopt;
    light_.type = *type;
    light_.name = object_.string("name").value_or("");
    if (object_.has("name") && light_.name.empty()) object_.error("name", "is empty");
    read_lamp();
    read_place();
    reject_wrong_units();
    object_.any("path");  // read when the light has its node (rig_path.h)
    read_settings();
    if (faults_.error_count() != errors_before) return std::nullopt;
    return RigLight{std::move(light_), world_from_light_};
  }

  // All that glTF leaves to say of a light whose type, place, name and lamp are known.
  Light read_extension() {
    is_lamp_ = light_.distribution != nullptr;
    for (const std::string_view allowed : {"extensions", "extras"}) object_.any(allowed);
    // Of lamps, glTF has one kind; with a cone it is a spot.
    if (is_lamp_ && (object_.has("inner_cone_deg") || object_.has("outer_cone_deg")))
      light_.type = LightType::spot;
    read_settings();
    return std::move(light_);
  }

 private:
  void read_settings() {
    light_.enabled = object_.boolean("enabled").value_or(true);
    read_color();
    read_brightness();
    read_source();
    switch (light_.type) {
      case LightType::directional:
        read_directional();
        break;
      case LightType::point:
        read_attenuation();
        break;
      case LightType::spot:
        read_spot();
        break;
      case LightType::projector:
        read_projector();
        break;
    }
    // What a light can have depends on all of the above.
    read_rig_shadow(json_, object_, faults_, light_);
    object_.report_unknown_members(fmt::format("a {}", name_of(light_.type)));
  }

  // Of the lamp, and of what is put before it.
  void read_color() {
    if (const auto color = object_.numbers<3>("color", kAmountOfLight)) {
      light_.color = glm::vec3((*color)[0], (*color)[1], (*color)[2]);
    }
    constexpr NumberRange kTemperature{kLeastKelvin, kMostKelvin, false, false};
    if (const auto kelvin = object_.number("color_temperature", kTemperature)) {
      light_.color = color_of_temperature(*kelvin);
      if (object_.has("color")) object_.error("color_temperature", give_either("color", "color_temperature"));
    }
    if (const auto filter = object_.numbers<3>("filter", kZeroToOne)) {
      light_.color *= glm::vec3((*filter)[0], (*filter)[1], (*filter)[2]);
    }
    using NamedGel = std::pair<std::string_view, const Gel*>;
    std::vector<NamedGel> gels;
    for (const Gel& gel : list_gels()) gels.emplace_back(gel.name, &gel);
    if (const auto gel = object_.choice<const Gel*>("gel", std::span<const NamedGel>(gels)))
      light_.color *= transmission(**gel);
  }

  // Of two settings that exclude each other.
  [[nodiscard]] std::string give_either(std::string_view one, std::string_view other) const {
    const SettingNames& names = object_.names();
    return fmt::format("give either {} or {}, not both", names.spelled(one), names.spelled(other));
  }

  // A measured lamp says itself how bright it is and where it shines.
  void read_lamp() {
    const std::optional<std::string> name = object_.string("ies");
    if (!object_.has("ies")) return;
    if (light_.type != LightType::point && light_.type != LightType::spot)
      return object_.error(
          "ies", fmt::format("only point and spot lights have one, not a {}", name_of(light_.type)));
    if (!name) return;
    const auto path = files_.find(*name);
    if (!path) return object_.error("ies", path.error());
    Result<LightDistribution> lamp = read_lamp_file(*path);
    if (!lamp) return object_.error("ies", to_string(lamp.error()));
    light_.distribution = std::make_shared<const LightDistribution>(std::move(*lamp));
  }

  void read_place() {
    if (light_.type == LightType::point && !(is_lamp_ && object_.has("target"))) {
      object_.require("position");
      // A lamp hangs, if nothing else is said.
      if (is_lamp_) world_from_light_ = downward();
      const auto position = object_.numbers<3>("position", kCoordinate);
      if (position) world_from_light_[3] = glm::dvec4((*position)[0], (*position)[1], (*position)[2], 1);
    } else if (const std::optional<glm::dmat4> pose = read_pose(object_)) {
      world_from_light_ = *pose;
    }
    // Photometry of types A and B has its vertical angles toward the light's +X (EXT_lights_ies); who aims a floodlight
    // means them upward.
    if (light_.distribution != nullptr && light_.distribution->type != PhotometricType::type_c) {
      const glm::dvec4 right = world_from_light_[0], up = world_from_light_[1];
      world_from_light_[0] = up;
      world_from_light_[1] = -right;
    }
  }

  // Looking down, with the light's up toward −Z, as on a map with north up.
  static glm::dmat4 downward() { return {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}; }

  // Each type has its units; the others are named as what they are, not as unknown keys.
  void reject_wrong_units() {
    const bool is_sun = light_.type == LightType::directional;
    const std::string_view right = is_sun     ? "\"lux\""
                                   : is_lamp_ ? "its file, \"lumens\" or \"scale\""
                                              : "\"candela\" or \"lumens\"";
    for (const std::string_view name :
         {"lux", "candela", "lumens", "scale", "intensity", "luminance", "power", "watts"}) {
      const bool is_right = name == "lux"       ? is_sun
                            : name == "candela" ? !is_sun && !is_lamp_
                            : name == "scale"   ? is_lamp_
                                                : name == "lumens" && !is_sun;
      if (is_right || !object_.has(name)) continue;
      object_.any(name);
      object_.error(name,
                    fmt::format("the brightness of a {} is given in {}",
                                is_lamp_ ? std::string_view("measured lamp") : name_of(light_.type), right));
    }
  }

  void read_brightness() {
    const bool is_sun = light_.type == LightType::directional;
    const std::string_view key = is_sun ? "lux" : is_lamp_ ? "scale" : "candela";
    light_.intensity = object_.number(key, kAmountOfLight).value_or(light_.intensity);
    if (is_sun) return;
    light_.lumens = object_.number("lumens", kAmountOfLight);
    if (!light_.lumens) return;
    if (object_.has(key)) object_.error("lumens", give_either(key, "lumens"));
    light_.intensity = 1;
  }

  void read_source() {
    LightSource& source = light_.source;
    const bool is_sun = light_.type == LightType::directional;
    if (is_sun) {
      constexpr NumberRange kSkyAngle{0, 90, false, false};
      source.angular_diameter =
          object_.angle("angular_diameter_deg", kSkyAngle).value_or(source.angular_diameter);
    }
    for (const std::string_view name : {"radius", "size"}) {
      if (is_sun && object_.any(name) != nullptr) {
        object_.error(name, fmt::format("a directional light is far away: give its {}",
                                        object_.quoted("angular_diameter_deg")));
      }
    }
    if (is_sun) return;
    source.radius = object_.number("radius", kLength).value_or(0);
    if (const auto size = object_.numbers<2>("size", kLength)) {
      source.width = (*size)[0];
      source.height = (*size)[1];
      if (object_.has("radius")) object_.error("size", give_either("radius", "size"));
    }
  }

  void read_attenuation() {
    const std::optional<double> range = object_.number("range", kPositive);
    const auto attenuation =
        object_.choice<Attenuation>("attenuation", {{"none", Attenuation::none},
                                                    {"linear", Attenuation::linear},
                                                    {"inverse_square", Attenuation::inverse_square},
                                                    {"gltf_windowed", Attenuation::gltf_windowed}});
    light_.attenuation = attenuation.value_or(range ? Attenuation::gltf_windowed : light_.attenuation);
    light_.range = range.value_or(light_.range);
    const bool uses_range =
        light_.attenuation == Attenuation::linear || light_.attenuation == Attenuation::gltf_windowed;
    if (uses_range && std::isinf(light_.range) && !object_.has("range")) {
      object_.error("attenuation", "needs \"range\" beside it");
    } else if (!uses_range && range && attenuation) {
      object_.error("range", "has no effect with this attenuation: leave one of them out");
    }
  }

  void read_directional() {
    bool has_box = false;
    for (const std::string_view name : {"half_width", "half_height", "near", "far", "frustum"})
      has_box |= object_.has(name);
    const double half_width = object_.number("half_width", kPositive).value_or(1);
    const double half_height = object_.number("half_height", kPositive).value_or(1);
    const double near = object_.number("near").value_or(0);
    const double far = object_.number("far").value_or(near + 1);
    const JsonValue* sides = object_.object("frustum");
    if (!has_box) return;
    sides != nullptr ? object_.require("far") : object_.require_all({"half_width", "half_height", "far"});
    for (const std::string_view name : {"half_width", "half_height"}) {
      if (sides != nullptr && object_.has(name)) object_.error("frustum", give_either("frustum", name));
    }
    if (far <= near)
      object_.error(
          "far", fmt::format("must be beyond {} ({}), got {}", object_.names().spelled("near"), near, far));
    light_.projection = Projection::orthographic(half_width, half_height, near, far);
    if (sides != nullptr) read_sides(json_, *sides, faults_, light_.projection);
    light_.fit = false;
  }

  void read_spot() {
    read_attenuation();
    if (light_.distribution != nullptr && !object_.has("inner_cone_deg") && !object_.has("outer_cone_deg"))
      return widen_to_lamp();
    light_.inner_cone = object_.angle("inner_cone_deg", kHalfAngle).value_or(light_.inner_cone);
    light_.outer_cone = object_.angle("outer_cone_deg", kHalfAngle).value_or(light_.outer_cone);
    if (light_.inner_cone > light_.outer_cone) {
      object_.error(object_.has("inner_cone_deg") ? "inner_cone_deg" : "outer_cone_deg",
                    fmt::format("the inner cone ({:.6g}) must not exceed the outer cone ({:.6g})",
                                as_given(light_.inner_cone), as_given(light_.outer_cone)));
    }
  }

  [[nodiscard]] double as_given(Angle angle) const {
    return object_.names().angles_are_in_radians() ? angle.in_radians() : angle.in_degrees();
  }

  // Without a cone of its own a spot shines as far as its lamp does. Beyond a right angle no cone reaches: then it is a
  // point light, aimed.
  void widen_to_lamp() {
    constexpr double kRise = 0.002;  // of the cosine, from the outer cone to full light
    const double widest = angle_from_axis(*light_.distribution);
    const double inner = cosine(Angle::degrees(widest).in_radians());
    if (inner < kRise) {
      light_.type = LightType::point;
      return;
    }
    light_.inner_cone = Angle::degrees(widest);
    light_.outer_cone = Angle::radians(arccosine(inner - kRise));
  }

  void read_projector() {
    read_attenuation();
    if (object_.has("slide") && object_.has("intensity_map")) {
      object_.error("intensity_map", give_either("slide", "intensity_map"));
    }
    light_.slide_is_intensity = object_.has("intensity_map");
    light_.slide =
        object_.has("film") ? read_film() : read_slide(light_.slide_is_intensity ? "intensity_map" : "slide");
    reject_timing_without_film();
    light_.profile = object_
                         .choice<BeamProfile>("profile", {{"flat_field", BeamProfile::flat_field},
                                                          {"uniform_candela", BeamProfile::uniform_candela}})
                         .value_or(light_.profile);
    if (light_.slide_is_intensity && object_.has("profile"))
      object_.error("profile", fmt::format("has no effect: an {} says itself how the beam spreads",
                                           object_.names().spelled("intensity_map")));
    light_.outside = object_
                         .choice<Outside>("outside", {{"black", Outside::black},
                                                      {"clamp", Outside::clamp},
                                                      {"repeat", Outside::repeat},
                                                      {"mirror", Outside::mirror}})
                         .value_or(light_.outside);
    read_panel();
    read_blend();
    read_aperture();
    object_.any("distortion");
    const std::optional<bool> from_slide = object_.boolean("aspect_from_slide");
    const std::optional<double> slide_aspect = aspect_for_lens();
    if (const auto frustum = read_frustum(json_, object_, faults_, FrustumOf::projector, slide_aspect)) {
      light_.projection = frustum->projection;
      light_.aspect_from_slide = from_slide.value_or(!frustum->aspect_is_given && !slide_aspect);
      read_rig_distortion(json_, object_, faults_, light_);
    }
  }

  void read_panel() {
    light_.black_level = object_.number("black_level", kZeroToOne).value_or(0);
    if (light_.slide_is_intensity && object_.has("black_level"))
      object_.error("black_level", "has no effect: an intensity map holds all that is thrown");
    constexpr NumberRange kPixels{1, kMaxImageSide, false, false};
    if (const auto pixels = object_.numbers<2>("pixels", kPixels)) {
      light_.panel_width = static_cast<int>((*pixels)[0]);
      light_.panel_height = static_cast<int>((*pixels)[1]);
      if (light_.panel_width != (*pixels)[0] || light_.panel_height != (*pixels)[1])
        object_.error("pixels", "expected whole numbers");
    }
  }

  void read_blend() {
    using NamedMode = std::pair<std::string_view, BlendMode>;
    std::vector<NamedMode> modes;
    for (const BlendModeDescription& known : list_blend_modes()) modes.emplace_back(known.name, known.mode);
    light_.blend =
        object_.choice<BlendMode>("blend", std::span<const NamedMode>(modes)).value_or(light_.blend);
    if (const std::string_view message = find_light_fault(light_.blend); !message.empty())
      object_.error("blend", std::string(message));
  }

  void read_aperture() {
    Aperture& aperture = light_.aperture;
    aperture.radius = object_.number("aperture_radius", kLength).value_or(0);
    const NumberRange in_focus{kNearestFocus, kMaxCoordinate, false, false};
    if (const auto focus = object_.number("focus", in_focus)) aperture.focal_distance = *focus;
    if (object_.has("focus") && !object_.has("aperture_radius"))
      object_.error("focus", fmt::format("needs {} beside it: through a pinhole all is in focus",
                                         object_.quoted("aperture_radius")));
    if (!(aperture.radius > 0)) return;
    if (object_.has("orthographic"))
      object_.error("aperture_radius", "a parallel projector has no lens to open");
    for (const std::string_view name : {"radius", "size"}) {
      if (object_.has(name))
        object_.error(name, fmt::format("the light shines from its lens: give either this or {}",
                                        object_.names().spelled("aperture_radius")));
    }
  }

  int read_slide(std::string_view key) {
    object_.any("slide");
    object_.any("intensity_map");
    return object_.has(key) ? files_.read_picture(object_, key) : -1;
  }

  int read_film() {
    for (const std::string_view other : {"slide", "intensity_map"}) {
      if (object_.any(other) != nullptr) object_.error("film", give_either("film", other));
    }
    const FilmTiming timing = read_film_timing();
    const std::optional<std::string> name = object_.string("film");
    if (!name) return -1;
    Picture picture;
    picture.film = timing;
    const auto path = files_.find(*name);
    if (path) {
      picture.file = *path;
    } else if (const auto pattern = files_.pattern(*name); pattern && is_numbered(*pattern)) {
      picture.file = *pattern;
      if (const auto numbered = image::find_numbered_files(picture.file); !numbered) {
        object_.error("film", to_string(numbered.error()));
        return -1;
      }
    } else {
      object_.error("film", path.error());
      return -1;
    }
    if (path && object_.has("fps")) {
      object_.error("fps",
                    fmt::format("has no effect: this file says itself how long its frames last; {} makes it "
                                "faster",
                                object_.quoted("rate")));
    }
    picture.name = picture.file.string();
    return files_.add(std::move(picture));
  }

  FilmTiming read_film_timing() {
    constexpr NumberRange kSceneTime{-kMaxSceneTime, kMaxSceneTime, false, false};
    constexpr NumberRange kRate{0, kMaxFilmRate, true, false};
    constexpr NumberRange kFramesPerSecond{0, kMaxFramesPerSecond, true, false};
    FilmTiming timing;
    timing.frames_per_second = object_.number("fps", kFramesPerSecond).value_or(timing.frames_per_second);
    timing.start = object_.number("start", kSceneTime).value_or(timing.start);
    timing.rate = object_.number("rate", kRate).value_or(timing.rate);
    timing.at_end = object_
                        .choice<AtEnd>("at_end", {{"loop", AtEnd::loop},
                                                  {"hold", AtEnd::hold},
                                                  {"black", AtEnd::black},
                                                  {"ping_pong", AtEnd::ping_pong}})
                        .value_or(timing.at_end);
    return timing;
  }

  void reject_timing_without_film() {
    if (object_.has("film")) return;
    for (const std::string_view name : {"fps", "start", "rate", "at_end"}) {
      if (object_.any(name) != nullptr) object_.error(name, "belongs to a \"film\", and there is none");
    }
  }

  // A horizontal field of view leaves the vertical one to the slide's shape, and a lens distorts a frame of some
  // shape, so the slide's header is read now. Elsewhere the renderer fits the width when it has decoded the slide.
  std::optional<double> aspect_for_lens() {
    const bool distorts = object_.has("distortion") && !object_.has("aspect") && !object_.has("intrinsics") &&
                          !object_.has("frustum");
    if (!distorts && !needs_aspect_of_picture(object_)) return std::nullopt;
    if (light_.slide < 0) return 1;
    const Picture& picture = files_.at(light_.slide);
    if (picture.film) {
      const Result<FilmHeader> film = read_film_header(picture.file, picture.film->frames_per_second);
      if (film) return static_cast<double>(film->width) / film->height;
      object_.error("film", to_string(film.error()));
      return 1;
    }
    const Result<ImageHeader> header = picture.file.empty() ? read_image_header(picture.encoded, picture.name)
                                                            : read_image_header(picture.file);
    if (header) return static_cast<double>(header->width) / header->height;
    object_.error(light_.slide_is_intensity ? "intensity_map" : "slide", to_string(header.error()));
    return 1;
  }

  const JsonDocument& json_;
  JsonObject object_;
  LightFiles& files_;
  FaultList& faults_;
  Light light_;
  bool is_lamp_ = false;
  glm::dmat4 world_from_light_{1.0};
};

}  // namespace

std::optional<RigLight> read_rig_light(const JsonDocument& json, const JsonValue& value, LightFiles& files,
                                       FaultList& faults) {
  return LightReader(json, value, kRigNames, files, faults, {}).read();
}

Light read_light_extension(const JsonDocument& json, const JsonValue& value, LightFiles& files,
                           FaultList& faults, Light light) {
  return LightReader(json, value, kGltfNames, files, faults, std::move(light)).read_extension();
}

}  // namespace laterna
