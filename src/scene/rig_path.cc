#include "scene/rig_path.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/elementary.h"
#include "laterna/lamps.h"
#include "scene/instance_transforms.h"
#include "scene/rig_pose.h"
#include "scene/rig_ranges.h"

namespace laterna {
namespace {

constexpr std::size_t kMaxKeys = std::size_t{1} << 20U;

enum class Smoothness : std::uint8_t { smooth, linear, step };

// A property's values at some of the keys.
struct Track {
  AnimatedProperty property;
  std::size_t components;
  bool is_place;  // runs on Catmull-Rom splines
  std::vector<double> times, values;
};

// How fast a value changes at key i: the chord from its forerunner to its successor (Catmull and Rom, A class of local
// interpolating splines, 1974, for keys at any times).
double chord_slope(double h0, double d0, double h1, double d1) { return (h0 * d0 + h1 * d1) / (h0 + h1); }

// The same for values that may not overshoot: 0 at extremes, elsewhere a harmonic mean (Fritsch and Butland, A method for
// constructing local monotone piecewise cubic interpolants, 1984).
double monotone_slope(double h0, double d0, double h1, double d1) {
  if (!(d0 * d1 > 0)) return 0;
  return 3 * (h0 + h1) / ((2 * h1 + h0) / d0 + (h1 + 2 * h0) / d1);
}

class TrackSlopes {
 public:
  TrackSlopes(const Track& track, bool loops) : track_(track), loops_(loops && is_closed()) {}

  [[nodiscard]] double at(std::size_t key, std::size_t component) const {
    const std::size_t last = track_.times.size() - 1;
    const auto chord = [&](std::size_t from) {
      const double length = track_.times[from + 1] - track_.times[from];
      return std::pair{length, (value(from + 1, component) - value(from, component)) / length};
    };
    if (last == 0) return 0;
    const bool is_end = key == 0 || key == last;
    if (is_end && !loops_) return chord(key == 0 ? 0 : last - 1).second;
    const auto [h0, d0] = chord(is_end ? last - 1 : key - 1);
    const auto [h1, d1] = chord(is_end ? 0 : key);
    return track_.is_place ? chord_slope(h0, d0, h1, d1) : monotone_slope(h0, d0, h1, d1);
  }

 private:
  [[nodiscard]] double value(std::size_t key, std::size_t component) const {
    return track_.values[key * track_.components + component];
  }
  // Ends where it began, so that a loop goes on without a corner.
  [[nodiscard]] bool is_closed() const {
    for (std::size_t c = 0; c < track_.components; ++c) {
      if (value(0, c) != value(track_.times.size() - 1, c)) return false;
    }
    return true;
  }

  const Track& track_;
  bool loops_;
};

KeyFrames to_key_frames(const Track& track, Smoothness smoothness, bool loops) {
  KeyFrames keys{KeyInterpolation::linear, track.times, track.values};
  if (smoothness == Smoothness::step) keys.interpolation = KeyInterpolation::step;
  if (smoothness != Smoothness::smooth || track.times.size() < 2) return keys;
  keys.interpolation = KeyInterpolation::cubic_spline;
  keys.values.clear();
  const TrackSlopes slopes(track, loops);
  for (std::size_t k = 0; k < track.times.size(); ++k) {
    for (int part = 0; part < 3; ++part) {
      for (std::size_t c = 0; c < track.components; ++c)
        keys.values.push_back(part == 1 ? track.values[k * track.components + c] : slopes.at(k, c));
    }
  }
  return keys;
}

class PathReader {
 public:
  PathReader(const JsonDocument& json, const JsonValue& owner, const JsonValue& path, const PathOwner& what,
             FaultList& faults)
      : json_(json), owner_(json, owner, faults), path_(json, path, faults), what_(what), faults_(faults) {}

  std::optional<Clip> read() {
    const std::size_t errors_before = faults_.error_count();
    smoothness_ = path_
                      .choice<Smoothness>("interpolation", {{"smooth", Smoothness::smooth},
                                                            {"linear", Smoothness::linear},
                                                            {"step", Smoothness::step}})
                      .value_or(Smoothness::smooth);
    clip_.at_end =
        path_
            .choice<AtEnd>("at_end",
                           {{"hold", AtEnd::hold}, {"loop", AtEnd::loop}, {"ping_pong", AtEnd::ping_pong}})
            .value_or(AtEnd::hold);
    clip_.is_path = true;
    path_.require("keys");
    const JsonValue* keys = path_.array("keys");
    path_.report_unknown_members("a path");
    if (keys == nullptr) return std::nullopt;
    if (keys->children.empty()) path_.error("keys", "expected at least one key");
    if (keys->children.size() > kMaxKeys)
      path_.error("keys", fmt::format("{} are more than {}", keys->children.size(), kMaxKeys));
    for (const JsonValue& key : keys->children) {
      if (faults_.error_count() == errors_before) read_key(key);
    }
    if (faults_.error_count() != errors_before) return std::nullopt;
    for (const Track& track : tracks_) add(track);
    return std::move(clip_);
  }

 private:
  void read_key(const JsonValue& value) {
    JsonObject key(json_, value, faults_);
    constexpr NumberRange kTime{0, kMaxSceneTime, false, false};
    key.require("time");
    const std::optional<double> time = key.number("time", kTime);
    if (time && *time <= last_time_)
      key.error("time",
                fmt::format("{} s does not come after the key before it, at {} s", *time, last_time_));
    last_time_ = time.value_or(last_time_);
    if (what_.camera != nullptr) {
      read_place(key);
      read_field_of_view(key, what_.camera->projection, true);
    } else if (what_.light != nullptr) {
      read_place(key);
      read_light(key, *what_.light);
    } else {
      read_transform(key);
    }
    key.report_unknown_members("a key");
  }

  // A point light has no direction, unless a lamp is aimed.
  [[nodiscard]] bool is_aimed() const { return owner_.has("target"); }

  void read_place(JsonObject& key) {
    const bool moves = key.has("position") || key.has("target") || key.has("up");
    if (!has_keys_) moves_ = moves;
    has_keys_ = true;
    if (moves != moves_) {
      key.error({}, "either all keys of a path say where it stands or looks, or none does");
    }
    if (!moves) return;
    if (what_.light != nullptr && what_.light->distribution != nullptr &&
        what_.light->distribution->type != PhotometricType::type_c) {
      return key.error({}, "a lamp whose photometry is of type A or B does not move along paths");
    }
    if (!is_aimed()) {
      if (key.has("target"))
        return key.error("target", "this light has no target of its own, and shines all round");
      key.require("position");
      const auto position = key.numbers<3>("position", kCoordinate);
      if (!position) return;
      const auto [x, y, z] = *position;
      // A lamp hangs straight down, with its +X where the world's is.
      if (what_.light != nullptr && what_.light->distribution != nullptr)
        return push<9>(AnimatedProperty::look_at, true, {x, y, z, x, y - 1, z, 0, 0, -1});
      return push(AnimatedProperty::translation, true, *position);
    }
    if (const std::optional<std::array<double, 9>> place = read_look_at(key, owner_))
      push(AnimatedProperty::look_at, true, *place);
  }

  // Of a node, as glTF has them.
  void read_transform(JsonObject& key) {
    if (const auto translation = key.numbers<3>("translation", kCoordinate))
      push(AnimatedProperty::translation, true, *translation);
    if (const auto scale = key.numbers<3>("scale", kCoordinate)) push(AnimatedProperty::scale, false, *scale);
    const auto r = key.numbers<4>("rotation");
    if (!r) return;
    std::optional<glm::dvec4> rotation = normalized_rotation(glm::dvec4((*r)[0], (*r)[1], (*r)[2], (*r)[3]));
    if (!rotation) return key.error("rotation", "expected a unit quaternion, got one without length");
    // Of the two quaternions of a rotation the one that is nearer to the key before it.
    if (glm::dot(*rotation, last_rotation_) < 0) *rotation = -*rotation;
    last_rotation_ = *rotation;
    push<4>(AnimatedProperty::rotation, true, {rotation->x, rotation->y, rotation->z, rotation->w});
  }

  void read_field_of_view(JsonObject& key, const Projection& projection, bool has_any) {
    const std::optional<double> yfov = key.number("yfov_deg", kFieldOfView);
    if (!yfov) return;
    if (!has_any || projection.is_orthographic)
      return key.error("yfov_deg", "only what has a perspective frustum has a field of view");
    push<1>(AnimatedProperty::yfov, false, {Angle::degrees(*yfov).in_radians()});
  }

  void read_light(JsonObject& key, const Light& light) {
    read_field_of_view(key, light.projection, light.type == LightType::projector);
    if (light.type == LightType::projector && !light.distortion.is_none() && key.has("yfov_deg"))
      key.error("yfov_deg", "the lens distorts its frame as it is: its field of view does not change");
    const bool is_sun = light.type == LightType::directional;
    for (const char* name : {"candela", "lux"}) {
      const std::optional<double> amount = key.number(name, kAmountOfLight);
      if (!amount) continue;
      if (is_sun != (std::string_view(name) == "lux"))
        key.error(name, is_sun ? "expected lux of a directional light" : "only directional lights have lux");
      if (light.lumens) key.error(name, "the light is given in lumens");
      push<1>(AnimatedProperty::intensity, false, {*amount});
    }
    if (const auto lumens = key.number("lumens", kAmountOfLight)) {
      if (!light.lumens) key.error("lumens", "the light itself is not given in lumens");
      push<1>(AnimatedProperty::lumens, false, {*lumens});
    }
    if (const auto color = key.numbers<3>("color", kAmountOfLight))
      push(AnimatedProperty::light_color, false, *color);
    if (const auto range = key.number("range", kPositiveLength)) {
      if (!std::isfinite(light.range)) key.error("range", "the light itself has no range");
      push<1>(AnimatedProperty::range, false, {*range});
    }
    read_cone(key, light, "inner_cone_deg", AnimatedProperty::inner_cone);
    read_cone(key, light, "outer_cone_deg", AnimatedProperty::outer_cone);
  }

  void read_cone(JsonObject& key, const Light& light, std::string_view name, AnimatedProperty property) {
    const std::optional<double> angle = key.number(name, kHalfAngle);
    if (!angle) return;
    if (light.type != LightType::spot) key.error(name, "only spots have cones");
    push<1>(property, false, {Angle::degrees(*angle).in_radians()});
  }

  template <std::size_t N>
  void push(AnimatedProperty property, bool is_place, const std::array<double, N>& values) {
    Track* track = nullptr;
    for (Track& known : tracks_) {
      if (known.property == property) track = &known;
    }
    if (track == nullptr) track = &tracks_.emplace_back(Track{property, N, is_place, {}, {}});
    track->times.push_back(last_time_);
    track->values.insert(track->values.end(), values.begin(), values.end());
  }

  void add(const Track& track) {
    ClipChannel channel;
    channel.property = track.property;
    channel.target = track.property <= AnimatedProperty::look_at ? what_.node : what_.index;
    channel.of_light = what_.light != nullptr;
    channel.keys = static_cast<int>(clip_.keys.size());
    clip_.keys.push_back(to_key_frames(track, smoothness_, clip_.at_end == AtEnd::loop));
    clip_.channels.push_back(channel);
  }

  const JsonDocument& json_;
  JsonObject owner_, path_;
  const PathOwner& what_;
  FaultList& faults_;
  Smoothness smoothness_ = Smoothness::smooth;
  bool has_keys_ = false, moves_ = false;
  double last_time_ = -1;
  glm::dvec4 last_rotation_{0, 0, 0, 1};
  std::vector<Track> tracks_;
  Clip clip_;
};

}  // namespace

std::optional<Clip> read_rig_path(const JsonDocument& json, const JsonValue& owner, const PathOwner& what,
                                  FaultList& faults) {
  JsonObject object(json, owner, faults);
  const JsonValue* path = object.object("path");
  if (path == nullptr) return std::nullopt;
  return PathReader(json, owner, *path, what, faults).read();
}

}  // namespace laterna
