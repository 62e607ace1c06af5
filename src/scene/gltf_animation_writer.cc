#include "scene/gltf_animation_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "scene/gltf_animation_pointers.h"
#include "scene/gltf_light_extensions.h"
#include "scene/key_frames.h"
#include "scene/scene_pose.h"
#include "scene/spelling.h"

namespace laterna::gltf {
namespace {

using P = AnimatedProperty;

constexpr int kFloat = 5126;
// Straight pieces between two keys of a gaze, for programs that know translations and rotations alone.
constexpr int kPieces = 16;

bool is_part(P property) { return property <= P::scale || property == P::look_at; }

std::string_view type_of(P property) {
  switch (property == P::weights || property == P::look_at ? 1 : component_count(property)) {
    case 2:
      return "VEC2";
    case 3:
      return "VEC3";
    case 4:
      return "VEC4";
    default:
      return "SCALAR";
  }
}

const char* word(KeyInterpolation interpolation) {
  switch (interpolation) {
    case KeyInterpolation::step:
      return "STEP";
    case KeyInterpolation::linear:
      return "LINEAR";
    case KeyInterpolation::cubic_spline:
      break;
  }
  return "CUBICSPLINE";
}

int add_numbers(Document& document, const std::vector<double>& values, std::string_view type,
                std::size_t components) {
  const std::vector<float> floats(values.begin(), values.end());
  return document.add_accessor(std::as_bytes(std::span(floats)), Document::Target::none, kFloat, type,
                               floats.size() / components);
}

// Never later than they are: at the very instant of a cut, a film's frame shows what comes after it.
std::vector<double> as_early_floats(const std::vector<double>& times) {
  std::vector<double> floats;
  for (const double time : times) {
    const auto nearest = static_cast<float>(time);
    floats.push_back(nearest > time ? std::nextafter(nearest, -std::numeric_limits<float>::infinity())
                                    : nearest);
  }
  return floats;
}

// The way of a gaze, for those who do not know of gazes.
struct Way {
  KeyFrames translations, rotations;
};

Way way_of(const KeyFrames& gaze) {
  Way way;
  way.translations.interpolation = way.rotations.interpolation =
      gaze.interpolation == KeyInterpolation::step ? KeyInterpolation::step : KeyInterpolation::linear;
  glm::dquat last(1, 0, 0, 0);
  const auto add = [&](double time) {
    double values[9];
    sample_keys(gaze, time, false, values);
    const glm::dmat4 matrix = gaze_matrix(values);
    glm::dquat rotation = glm::quat_cast(glm::dmat3(matrix));
    if (glm::dot(rotation, last) < 0) rotation = -rotation;
    last = rotation;
    for (KeyFrames* keys : {&way.translations, &way.rotations}) keys->times.push_back(time);
    for (int k = 0; k < 3; ++k) way.translations.values.push_back(matrix[3][k]);
    way.rotations.values.insert(way.rotations.values.end(), {rotation.x, rotation.y, rotation.z, rotation.w});
  };
  const int pieces = gaze.interpolation == KeyInterpolation::step ? 1 : kPieces;
  add(gaze.times.front());
  for (std::size_t i = 1; i < gaze.times.size(); ++i) {
    const double from = gaze.times[i - 1], to = gaze.times[i];
    for (int piece = 1; piece <= pieces && to > from; ++piece) add(from + (to - from) * piece / pieces);
  }
  return way;
}

class ClipWriter {
 public:
  ClipWriter(const Scene& scene, const Clip& clip, std::string place, const std::vector<int>& light_indices,
             Document& document)
      : scene_(scene), clip_(clip), place_(std::move(place)), lights_(light_indices), document_(document) {}

  void write(bool is_first) {
    for (const ClipChannel& channel : clip_.channels) {
      if (channel.property == P::look_at) gazing_.insert(channel.target);
    }
    for (const ClipChannel& channel : clip_.channels) write_channel(channel);
    if (channels_.empty()) return;
    Json json;
    if (!clip_.name.empty()) json["name"] = clip_.name;
    json["channels"] = std::move(channels_);
    json["samplers"] = std::move(samplers_);
    Json lighting = Json::object();
    if (clip_.plays != is_first) lighting["plays"] = clip_.plays;
    if (clip_.is_path) lighting["path"] = true;
    if (clip_.at_end != AtEnd::loop) lighting["atEnd"] = clip_.at_end == AtEnd::hold ? "hold" : "pingPong";
    if (!lighting.empty()) document_.extend(json, kLightingExtension, std::move(lighting));
    document_.add("animations", std::move(json));
  }

 private:
  void write_channel(const ClipChannel& channel) {
    const KeyFrames& keys = clip_.keys[static_cast<std::size_t>(channel.keys)];
    if (channel.property == P::look_at) {
      const Way way = way_of(keys);
      add_channel(add_sampler(way.translations, P::translation), node_target(channel.target, "translation"));
      add_channel(add_sampler(way.rotations, P::rotation), node_target(channel.target, "rotation"));
    } else if (channel.property <= P::weights) {
      // A gaze takes the place of these.
      if (gazing_.contains(channel.target) && channel.property != P::weights) return;
      const std::string path = property_path(AnimatedKind::node, channel.property, 0, false);
      add_channel(sampler_of(channel), node_target(channel.target, path));
      return;
    }
    const std::string pointer = pointer_to(channel);
    if (pointer.empty()) {
      document_.warn(place_, fmt::format("clip {}: glTF has no name for {}: it stands still in the file",
                                         in_quotes(clip_.name), moved_by(channel)));
      return;
    }
    Json target = {{"path", "pointer"}};
    document_.extend(target, "KHR_animation_pointer", {{"pointer", pointer}});
    add_channel(sampler_of(channel), std::move(target));
  }

  static Json node_target(int node, std::string_view path) { return {{"node", node}, {"path", path}}; }

  void add_channel(int sampler, Json target) {
    channels_.push_back({{"sampler", sampler}, {"target", std::move(target)}});
  }

  // The property and whose it is, in glTF's words where it has one for others of the kind.
  [[nodiscard]] std::string moved_by(const ClipChannel& channel) const {
    const auto target = static_cast<std::size_t>(channel.target);
    const auto of = [&](std::string_view word, AnimatedKind kind, const std::string& name) {
      const std::string path = property_path(kind, channel.property, channel.texture, false);
      return fmt::format("{} of the {} {}", path.empty() ? "a property" : path, word, in_quotes(name));
    };
    if (channel.property == P::look_at) return of("node", AnimatedKind::node, scene_.nodes[target].name);
    if (channel.property >= P::base_color)
      return of("material", AnimatedKind::material, scene_.materials[target].name);
    if (channel.property >= P::light_color || channel.of_light)
      return of("light", AnimatedKind::light, scene_.lights[target].name);
    return of("camera", AnimatedKind::camera, scene_.cameras[target].name);
  }

  // Empty: there is none.
  [[nodiscard]] std::string pointer_to(const ClipChannel& channel) const {
    const auto target = static_cast<std::size_t>(channel.target);
    const auto below = [&](std::string_view list, int index, AnimatedKind kind, bool is_orthographic) {
      std::string path = property_path(kind, channel.property, channel.texture, is_orthographic);
      if (channel.property == P::lumens && scene_.lights[target].type != LightType::projector)
        path = kFluxOfOtherLights;
      return index < 0 || path.empty() ? std::string() : fmt::format("/{}/{}/{}", list, index, path);
    };
    if (channel.property == P::look_at) return below("nodes", channel.target, AnimatedKind::node, false);
    if (channel.property >= P::base_color)
      return below("materials", channel.target, AnimatedKind::material, false);
    if (channel.property >= P::light_color || channel.of_light)
      return below("extensions/KHR_lights_punctual/lights", lights_[target], AnimatedKind::light, false);
    return below("cameras", channel.target, AnimatedKind::camera,
                 scene_.cameras[target].projection.is_orthographic);
  }

  // Channels share keys; those of a rotation are brought to unit length where they are read.
  int sampler_of(const ClipChannel& channel) {
    const auto [known, is_new] = samplers_of_.try_emplace({channel.keys, type_of(channel.property)}, 0);
    if (is_new)
      known->second = add_sampler(clip_.keys[static_cast<std::size_t>(channel.keys)], channel.property);
    return known->second;
  }

  int add_sampler(const KeyFrames& keys, P property) {
    const auto [times, is_new] = inputs_.try_emplace(keys.times, 0);
    if (is_new) {
      const std::vector<double> floats = as_early_floats(keys.times);
      times->second = add_numbers(document_, floats, "SCALAR", 1);
      Json& accessor = document_.at("accessors", times->second);
      accessor["min"] = Json::array({shortest(static_cast<float>(floats.front()))});
      accessor["max"] = Json::array({shortest(static_cast<float>(floats.back()))});
    }
    const std::string_view type = type_of(property);
    const int output =
        add_numbers(document_, keys.values, type,
                    type == "SCALAR" ? 1 : static_cast<std::size_t>(component_count(property)));
    samplers_.push_back(
        {{"input", times->second}, {"interpolation", word(keys.interpolation)}, {"output", output}});
    return static_cast<int>(samplers_.size()) - 1;
  }

  const Scene& scene_;
  const Clip& clip_;
  std::string place_;
  const std::vector<int>& lights_;
  Document& document_;
  Json channels_ = Json::array(), samplers_ = Json::array();
  std::map<std::pair<int, std::string_view>, int> samplers_of_;
  std::map<std::vector<double>, int> inputs_;
  std::set<int> gazing_;
};

}  // namespace

std::vector<bool> nodes_moved_by_parts(const Scene& scene) {
  std::vector<bool> moved(scene.nodes.size(), false);
  for (const Clip& clip : scene.clips) {
    for (const ClipChannel& channel : clip.channels) {
      if (is_part(channel.property)) moved[static_cast<std::size_t>(channel.target)] = true;
    }
  }
  return moved;
}

void write_skins(const Scene& scene, Document& document) {
  for (const Skin& skin : scene.skins) {
    std::vector<double> matrices;
    for (const glm::dmat4& matrix : skin.joint_from_bind) {
      for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) matrices.push_back(matrix[column][row]);
      }
    }
    Json json;
    if (!skin.name.empty()) json["name"] = skin.name;
    json["joints"] = skin.joints;
    json["inverseBindMatrices"] = add_numbers(document, matrices, "MAT4", 16);
    document.add("skins", std::move(json));
  }
}

void write_animations(const Scene& scene, const std::vector<int>& light_indices, Document& document) {
  for (std::size_t i = 0; i < scene.clips.size(); ++i) {
    ClipWriter writer(scene, scene.clips[i], fmt::format("clips[{}]", i), light_indices, document);
    writer.write(document.count("animations") == 0);
  }
}

}  // namespace laterna::gltf
