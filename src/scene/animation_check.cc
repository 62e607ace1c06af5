#include "scene/animation_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "laterna/material_lobes.h"
#include "scene/number_scans.h"

namespace laterna {
namespace {

class AnimationCheck {
 public:
  AnimationCheck(const Scene& scene, FaultList& faults) : scene_(scene), faults_(faults) {}

  void run() {
    for (std::size_t i = 0; i < scene_.skins.size(); ++i)
      check_skin(scene_.skins[i], fmt::format("skins[{}]", i));
    for (std::size_t m = 0; m < scene_.meshes.size(); ++m) check_mesh(m);
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i)
      check_node(scene_.nodes[i], fmt::format("nodes[{}]", i));
    for (std::size_t i = 0; i < scene_.clips.size(); ++i)
      check_clip(scene_.clips[i], fmt::format("clips[{}]", i));
    if (key_numbers_ > kMaxKeyNumbers)
      faults_.error("clips",
                    fmt::format("{} numbers of key frames are more than {}", key_numbers_, kMaxKeyNumbers));
  }

 private:
  void check_skin(const Skin& skin, const std::string& place) {
    if (skin.joints.empty()) faults_.error(place + ".joints", "expected at least one joint");
    if (skin.joint_from_bind.size() != skin.joints.size()) {
      faults_.error(place + ".joint_from_bind", fmt::format("has {} matrices, but there are {} joints",
                                                            skin.joint_from_bind.size(), skin.joints.size()));
    }
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
      check_index(fmt::format("{}.joints[{}]", place, i), skin.joints[i], scene_.nodes.size(), "nodes");
    for (std::size_t i = 0; i < skin.joint_from_bind.size(); ++i) {
      for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
          if (std::isfinite(skin.joint_from_bind[i][column][row])) continue;
          faults_.error(fmt::format("{}.joint_from_bind[{}]", place, i), "holds a value that is not finite");
          return;
        }
      }
    }
  }

  void check_index(const std::string& place, int index, std::size_t count, std::string_view list) {
    if (index >= 0 && static_cast<std::size_t>(index) < count) return;
    faults_.error(place, fmt::format("{} is no index into the {} {}", index, count, list));
  }

  void check_mesh(std::size_t mesh) {
    const std::vector<Primitive>& primitives = scene_.meshes[mesh].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const Primitive& primitive = primitives[p];
      const std::string place = fmt::format("meshes[{}].primitives[{}]", mesh, p);
      if (primitive.targets.size() > kMaxMorphTargets)
        faults_.error(place + ".targets",
                      fmt::format("{} are more than {}", primitive.targets.size(), kMaxMorphTargets));
      for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
        const MorphTarget& target = primitive.targets[t];
        const std::string of_target = fmt::format("{}.targets[{}]", place, t);
        check_displacements(target.positions, primitive, of_target + ".positions");
        check_displacements(target.normals, primitive, of_target + ".normals");
        check_displacements(target.tangents, primitive, of_target + ".tangents");
      }
      check_influences(primitive, place);
    }
  }

  void check_displacements(const std::vector<glm::vec3>& values, const Primitive& primitive,
                           const std::string& place) {
    if (!values.empty() && values.size() != primitive.positions.size()) {
      faults_.error(place, fmt::format("has {} elements, but there are {} positions", values.size(),
                                       primitive.positions.size()));
    }
    const std::span<const float> components = components_of(values);
    const std::size_t bad = first_not_finite(components);
    if (bad < components.size())
      faults_.error(fmt::format("{}[{}]", place, bad / 3), "expected finite numbers");
  }

  void check_influences(const Primitive& primitive, const std::string& place) {
    const std::size_t expected =
        primitive.influences < 0
            ? 0
            : primitive.positions.size() * static_cast<std::size_t>(primitive.influences);
    if (primitive.influences < 0 || primitive.joints.size() != expected ||
        primitive.joint_weights.size() != expected) {
      faults_.error(place + ".joints",
                    fmt::format("expected {} joints and weights, {} for each of {} vertices, got {} and {}",
                                expected, primitive.influences, primitive.positions.size(),
                                primitive.joints.size(), primitive.joint_weights.size()));
      return;
    }
    for (std::size_t i = 0; i < expected; ++i) {
      const float weight = primitive.joint_weights[i];
      if (weight >= 0 && weight <= 1.001F) continue;
      faults_.error(fmt::format("{}.joint_weights[{}]", place, i),
                    fmt::format("expected a number from 0 to 1, got {}", weight));
      return;
    }
  }

  void check_node(const Node& node, const std::string& place) {
    for (const float weight : node.weights) {
      if (!std::isfinite(weight)) faults_.error(place + ".weights", "expected finite numbers");
    }
    if (node.skin < 0) {
      if (node.skin < -1)
        faults_.error(place + ".skin", fmt::format("{} is no index, nor -1 for none", node.skin));
      return;
    }
    if (static_cast<std::size_t>(node.skin) >= scene_.skins.size())
      return check_index(place + ".skin", node.skin, scene_.skins.size(), "skins");
    if (node.mesh < 0 || static_cast<std::size_t>(node.mesh) >= scene_.meshes.size()) return;
    const std::size_t joints = scene_.skins[static_cast<std::size_t>(node.skin)].joints.size();
    for (const Primitive& primitive : scene_.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const auto most = std::max_element(primitive.joints.begin(), primitive.joints.end());
      if (most == primitive.joints.end() || *most < joints) continue;
      faults_.error(place + ".skin", fmt::format("its mesh is pulled by joint {}, but skins[{}] has only {}",
                                                 *most, node.skin, joints));
    }
  }

  void check_clip(const Clip& clip, const std::string& place) {
    if (clip.at_end != AtEnd::loop && clip.at_end != AtEnd::hold && clip.at_end != AtEnd::ping_pong)
      faults_.error(place + ".at_end", "expected loop, hold or ping_pong");
    for (std::size_t i = 0; i < clip.keys.size(); ++i)
      check_keys(clip.keys[i], fmt::format("{}.keys[{}]", place, i));
    for (std::size_t i = 0; i < clip.channels.size(); ++i)
      check_channel(clip, clip.channels[i], fmt::format("{}.channels[{}]", place, i));
  }

  void check_keys(const KeyFrames& keys, const std::string& place) {
    key_numbers_ += keys.values.size();
    if (keys.times.empty()) faults_.error(place + ".times", "expected at least one key");
    for (std::size_t i = 0; i < keys.times.size(); ++i) {
      if (!(std::abs(keys.times[i]) <= kMaxSceneTime)) {
        faults_.error(fmt::format("{}.times[{}]", place, i),
                      fmt::format("expected a number from {:g} to {:g}, got {}", -kMaxSceneTime,
                                  kMaxSceneTime, keys.times[i]));
        return;
      }
      if (i == 0 || keys.times[i] >= keys.times[i - 1]) continue;
      faults_.error(fmt::format("{}.times[{}]", place, i),
                    fmt::format("expected a time not before {}, got {}", keys.times[i - 1], keys.times[i]));
      return;
    }
    for (std::size_t i = 0; i < keys.values.size(); ++i) {
      if (std::isfinite(keys.values[i])) continue;
      faults_.error(fmt::format("{}.values[{}]", place, i), "expected a finite number");
      return;
    }
  }

  // How many things of that kind there are, and what they are called.
  [[nodiscard]] std::pair<std::size_t, std::string_view> targets_of(const ClipChannel& channel) const {
    using P = AnimatedProperty;
    if (channel.property <= P::look_at) return {scene_.nodes.size(), "nodes"};
    if (channel.property <= P::far && !channel.of_light) return {scene_.cameras.size(), "cameras"};
    if (channel.property <= P::outer_cone) return {scene_.lights.size(), "lights"};
    return {scene_.materials.size(), "materials"};
  }

  void check_texture(const ClipChannel& channel, const std::string& place) {
    const bool of_lobes = channel.property >= AnimatedProperty::texture_offset &&
                          scene_.materials[static_cast<std::size_t>(channel.target)].lobes != nullptr;
    const int last = 4 + (of_lobes ? static_cast<int>(kLobeTextures) : 0);
    if (channel.texture < 0 || channel.texture > last)
      faults_.error(place + ".texture", fmt::format("expected 0 to {}, got {}", last, channel.texture));
  }

  void check_channel(const Clip& clip, const ClipChannel& channel, const std::string& place) {
    if (channel.property > AnimatedProperty::texture_scale)
      return faults_.error(place + ".property", "is no value of the enumeration");
    const auto [count, list] = targets_of(channel);
    if (channel.target < 0 || static_cast<std::size_t>(channel.target) >= count)
      return check_index(place + ".target", channel.target, count, list);
    if (channel.keys < 0 || static_cast<std::size_t>(channel.keys) >= clip.keys.size())
      return check_index(place + ".keys", channel.keys, clip.keys.size(), "keys");
    check_texture(channel, place);
    const KeyFrames& keys = clip.keys[static_cast<std::size_t>(channel.keys)];
    if (changes_light(channel)) check_light(channel, keys, place);
    auto components = static_cast<std::size_t>(component_count(channel.property));
    const Node* node = channel.property <= AnimatedProperty::look_at
                           ? &scene_.nodes[static_cast<std::size_t>(channel.target)]
                           : nullptr;
    if (channel.property == AnimatedProperty::weights) {
      components = morph_targets_of(*node);
      if (components == 0)
        return faults_.error(place + ".target",
                             fmt::format("the mesh of nodes[{}] has no morph targets", channel.target));
    } else if (node != nullptr && channel.property != AnimatedProperty::look_at && !node->transform) {
      faults_.error(
          place + ".target",
          fmt::format("nodes[{}] has a matrix: only translation, rotation and scale move", channel.target));
    }
    const std::size_t per_key = components * (keys.interpolation == KeyInterpolation::cubic_spline ? 3 : 1);
    if (keys.values.size() != per_key * keys.times.size()) {
      faults_.error(place,
                    fmt::format("expected {} numbers, {} for each of {} keys, got {}",
                                per_key * keys.times.size(), per_key, keys.times.size(), keys.values.size()));
    } else if (channel.property == AnimatedProperty::rotation) {
      check_rotations(keys, place);
    }
  }

  static bool changes_light(const ClipChannel& channel) {
    using P = AnimatedProperty;
    return channel.property > P::look_at && channel.property <= P::outer_cone &&
           (channel.property > P::far || channel.of_light);
  }

  // Lights must stay of a kind that can be drawn while they change.
  void check_light(const ClipChannel& channel, const KeyFrames& keys, const std::string& place) {
    using P = AnimatedProperty;
    const Light& light = scene_.lights[static_cast<std::size_t>(channel.target)];
    if (channel.property <= P::y_extent && !light.distortion.is_none())
      faults_.error(place + ".property", "the lens distorts its frame as it is: that cannot change");
    if (channel.property != P::outer_cone) return;
    const std::size_t step = keys.interpolation == KeyInterpolation::cubic_spline ? 3 : 1;
    for (std::size_t i = step / 2; i < keys.values.size(); i += step) {
      Light changed = light;
      changed.outer_cone = Angle::radians(keys.values[i]);
      const std::string message = find_fault(changed.shadow.layout, changed);
      if (!message.empty()) return faults_.error(place + ".keys", message);
    }
  }

  [[nodiscard]] std::size_t morph_targets_of(const Node& node) const {
    if (node.mesh < 0 || static_cast<std::size_t>(node.mesh) >= scene_.meshes.size()) return 0;
    const std::vector<Primitive>& primitives = scene_.meshes[static_cast<std::size_t>(node.mesh)].primitives;
    return primitives.empty() ? 0 : primitives.front().targets.size();
  }

  void check_rotations(const KeyFrames& keys, const std::string& place) {
    const bool has_slopes = keys.interpolation == KeyInterpolation::cubic_spline;
    for (std::size_t i = 0; i < keys.times.size(); ++i) {
      const double* q = keys.values.data() + (has_slopes ? 12 * i + 4 : 4 * i);
      if (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 1e-12) continue;
      faults_.error(place, fmt::format("the rotation of key {} has no length", i));
      return;
    }
  }

  const Scene& scene_;
  FaultList& faults_;
  std::uint64_t key_numbers_ = 0;
};

}  // namespace

void check_animation(const Scene& scene, FaultList& faults) { AnimationCheck(scene, faults).run(); }

}  // namespace laterna
