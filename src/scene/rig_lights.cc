#include "scene/rig_lights.h"

#include <fmt/format.h>

#include "laterna/film.h"
#include "laterna/image.h"
#include "scene/rig_pose.h"
#include "scene/rig_ranges.h"
#include "scene/rig_shadows.h"
#include "scene/spelling.h"
#include "scene/uri.h"

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

class LightReader {
 public:
  LightReader(const JsonDocument& json, const JsonValue& value, const std::filesystem::path& folder,
              std::vector<Picture>& pictures, FaultList& faults)
      : json_(json), object_(json, value, faults), folder_(folder), pictures_(pictures), faults_(faults) {}

  std::optional<RigLight> read() {
    const std::size_t errors_before = faults_.error_count();
    object_.require("type");
    const auto type = object_.choice<LightType>("type", {{"directional", LightType::directional},
                                                         {"point", LightType::point},
                                                         {"spot", LightType::spot},
                                                         {"projector", LightType::projector}});
    if (!type) return std::nullopt;
    light_.type = *type;
    read_common();
    switch (*type) {
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
    object_.report_unknown_members(fmt::format("a {}", name_of(*type)));
    if (faults_.error_count() != errors_before) return std::nullopt;
    return RigLight{std::move(light_), world_from_light_};
  }

 private:
  void read_common() {
    light_.name = object_.string("name").value_or("");
    if (object_.has("name") && light_.name.empty()) object_.error("name", "is empty");
    light_.enabled = object_.boolean("enabled").value_or(true);
    if (const auto color = object_.numbers<3>("color", kAmountOfLight)) {
      light_.color = glm::vec3((*color)[0], (*color)[1], (*color)[2]);
    }
    read_place();
    read_brightness();
    read_source();
  }

  void read_place() {
    if (light_.type == LightType::point) {
      object_.require("position");
      const auto position = object_.numbers<3>("position", kCoordinate);
      if (position) world_from_light_[3] = glm::dvec4((*position)[0], (*position)[1], (*position)[2], 1);
    } else if (const std::optional<glm::dmat4> pose = read_pose(object_)) {
      world_from_light_ = *pose;
    }
  }

  // Each type has one unit (the projector two); the others are named as what they are, not as unknown keys.
  void read_brightness() {
    const bool is_sun = light_.type == LightType::directional,
               is_projector = light_.type == LightType::projector;
    const std::string_view right = is_sun         ? "\"lux\""
                                   : is_projector ? "\"candela\" or \"lumens\""
                                                  : "\"candela\"";
    for (const std::string_view name :
         {"lux", "candela", "lumens", "intensity", "luminance", "power", "watts"}) {
      const bool is_right = name == "lux"       ? is_sun
                            : name == "candela" ? !is_sun
                                                : name == "lumens" && is_projector;
      if (is_right || !object_.has(name)) continue;
      object_.any(name);
      object_.error(name, fmt::format("the brightness of a {} is given in {}", name_of(light_.type), right));
    }
    if (is_sun) {
      light_.intensity = object_.number("lux", kAmountOfLight).value_or(1);
      return;
    }
    light_.intensity = object_.number("candela", kAmountOfLight).value_or(1);
    if (!is_projector) return;
    light_.lumens = object_.number("lumens", kAmountOfLight);
    if (light_.lumens && object_.has("candela"))
      object_.error("lumens", "give either candela or lumens, not both");
  }

  void read_source() {
    LightSource& source = light_.source;
    const bool is_sun = light_.type == LightType::directional;
    if (is_sun) {
      constexpr NumberRange kSkyAngle{0, 90, false, false};
      if (const auto degrees = object_.number("angular_diameter_deg", kSkyAngle))
        source.angular_diameter = Angle::degrees(*degrees);
    }
    for (const std::string_view name : {"radius", "size"}) {
      if (is_sun && object_.any(name) != nullptr) {
        object_.error(name, "a directional light is far away: give its \"angular_diameter_deg\"");
      }
    }
    if (is_sun) return;
    source.radius = object_.number("radius", kLength).value_or(0);
    if (const auto size = object_.numbers<2>("size", kLength)) {
      source.width = (*size)[0];
      source.height = (*size)[1];
      if (object_.has("radius")) object_.error("size", "give either radius or size, not both");
    }
  }

  void read_attenuation() {
    const std::optional<double> range = object_.number("range", kPositive);
    const auto attenuation =
        object_.choice<Attenuation>("attenuation", {{"none", Attenuation::none},
                                                    {"linear", Attenuation::linear},
                                                    {"inverse_square", Attenuation::inverse_square},
                                                    {"gltf_windowed", Attenuation::gltf_windowed}});
    light_.attenuation =
        attenuation.value_or(range ? Attenuation::gltf_windowed : Attenuation::inverse_square);
    light_.range = range.value_or(light_.range);
    const bool uses_range =
        light_.attenuation == Attenuation::linear || light_.attenuation == Attenuation::gltf_windowed;
    if (uses_range && !object_.has("range")) {
      object_.error("attenuation", "needs \"range\" beside it");
    } else if (!uses_range && range && attenuation) {
      object_.error("range", "has no effect with this attenuation: leave one of them out");
    }
  }

  void read_directional() {
    bool has_box = false;
    for (const std::string_view name : {"half_width", "half_height", "near", "far"})
      has_box |= object_.has(name);
    const double half_width = object_.number("half_width", kPositive).value_or(1);
    const double half_height = object_.number("half_height", kPositive).value_or(1);
    const double near = object_.number("near").value_or(0);
    const double far = object_.number("far").value_or(near + 1);
    if (!has_box) return;
    object_.require_all({"half_width", "half_height", "far"});
    if (far <= near) object_.error("far", fmt::format("must be beyond near ({}), got {}", near, far));
    light_.projection = Projection::orthographic(half_width, half_height, near, far);
    light_.fit = false;
  }

  void read_spot() {
    read_attenuation();
    const double inner = object_.number("inner_cone_deg", kHalfAngle).value_or(0);
    const double outer = object_.number("outer_cone_deg", kHalfAngle).value_or(45);
    if (inner > outer) {
      object_.error(object_.has("inner_cone_deg") ? "inner_cone_deg" : "outer_cone_deg",
                    fmt::format("the inner cone ({}) must not exceed the outer cone ({})", inner, outer));
    }
    light_.inner_cone = Angle::degrees(inner);
    light_.outer_cone = Angle::degrees(outer);
  }

  void read_projector() {
    read_attenuation();
    if (object_.has("slide") && object_.has("intensity_map")) {
      object_.error("intensity_map", "give either slide or intensity_map, not both");
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
      object_.error("profile", "has no effect: an intensity_map says itself how the beam spreads");
    light_.outside = object_
                         .choice<Outside>("outside", {{"black", Outside::black},
                                                      {"clamp", Outside::clamp},
                                                      {"repeat", Outside::repeat},
                                                      {"mirror", Outside::mirror}})
                         .value_or(light_.outside);
    const std::optional<double> slide_aspect = aspect_for_horizontal_field();
    if (const auto frustum = read_frustum(json_, object_, faults_, slide_aspect)) {
      light_.projection = frustum->projection;
      light_.aspect_from_slide = !frustum->aspect_is_given && !slide_aspect;
    }
  }

  int read_slide(std::string_view key) {
    object_.any("slide");
    object_.any("intensity_map");
    const std::optional<std::string> name = object_.string(key);
    if (!name) return -1;
    auto path = resolve_typed_file(folder_, *name);
    if (!path) {
      object_.error(key, path.error());
      return -1;
    }
    Picture picture;
    picture.file = std::move(*path);
    picture.name = picture.file.string();
    pictures_.push_back(std::move(picture));
    return static_cast<int>(pictures_.size()) - 1;
  }

  int read_film() {
    for (const std::string_view other : {"slide", "intensity_map"}) {
      if (object_.any(other) != nullptr)
        object_.error("film", fmt::format("give either film or {}, not both", other));
    }
    const FilmTiming timing = read_film_timing();
    const std::optional<std::string> name = object_.string("film");
    if (!name) return -1;
    Picture picture;
    picture.film = timing;
    auto path = resolve_typed_file(folder_, *name);
    if (path) {
      picture.file = std::move(*path);
    } else if (is_numbered(*name)) {
      picture.file = folder_ / *name;
    } else {
      object_.error("film", path.error());
      return -1;
    }
    if (path && object_.has("fps"))
      object_.error(
          "fps", "has no effect: this file says itself how long its frames last; \"rate\" makes it faster");
    picture.name = picture.file.string();
    pictures_.push_back(std::move(picture));
    return static_cast<int>(pictures_.size()) - 1;
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

  // A horizontal field of view leaves the vertical one to the slide's shape, so the slide's header is read
  // now. Elsewhere the renderer fits the width when it has decoded the slide.
  std::optional<double> aspect_for_horizontal_field() {
    if (!object_.has("hfov_deg") || object_.has("aspect")) return std::nullopt;
    if (light_.slide < 0) return 1;
    const Picture& picture = pictures_.back();
    if (picture.film) {
      const Result<FilmHeader> film = read_film_header(picture.file, picture.film->frames_per_second);
      if (film) return static_cast<double>(film->width) / film->height;
      object_.error("film", to_string(film.error()));
      return 1;
    }
    const Result<ImageHeader> header = read_image_header(picture.file);
    if (header) return static_cast<double>(header->width) / header->height;
    object_.error(light_.slide_is_intensity ? "intensity_map" : "slide", to_string(header.error()));
    return 1;
  }

  const JsonDocument& json_;
  JsonObject object_;
  const std::filesystem::path& folder_;
  std::vector<Picture>& pictures_;
  FaultList& faults_;
  Light light_;
  glm::dmat4 world_from_light_{1.0};
};

}  // namespace

std::optional<RigLight> read_rig_light(const JsonDocument& json, const JsonValue& value,
                                       const std::filesystem::path& folder, std::vector<Picture>& pictures,
                                       FaultList& faults) {
  return LightReader(json, value, folder, pictures, faults).read();
}

}  // namespace laterna
