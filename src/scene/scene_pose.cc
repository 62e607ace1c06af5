#include "scene/scene_pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <span>

#include "base/elementary.h"
#include "scene/key_frames.h"
#include "scene/lobe_factors.h"

namespace laterna {
namespace {

bool moves_node(AnimatedProperty property) { return property <= AnimatedProperty::look_at; }
bool changes_frustum(AnimatedProperty property) {
  return property >= AnimatedProperty::yfov && property <= AnimatedProperty::far;
}
bool changes_light(const ClipChannel& channel) {
  return channel.of_light || (channel.property >= AnimatedProperty::light_color &&
                              channel.property <= AnimatedProperty::outer_cone);
}

glm::dvec3 vector_of(std::span<const double> v) { return {v[0], v[1], v[2]}; }

float to_float(double value, double low, double high) {
  return static_cast<float>(std::clamp(value, low, high));
}

// Keeps products of three finite in single precision.
float to_amount(double value) { return to_float(value, 0, kMaxRadiance); }

void scale_sides(Projection& p, double horizontal, double vertical) {
  p.left *= horizontal, p.right *= horizontal;
  p.bottom *= vertical, p.top *= vertical;
}

// Whatever interpolation comes to, a frustum stays one.
void set_frustum(Projection& p, AnimatedProperty property, double value) {
  constexpr double kLeast = 1e-6, kMost = 1e9;
  const double half_width = (p.right - p.left) / 2, half_height = (p.top - p.bottom) / 2;
  switch (property) {
    case AnimatedProperty::yfov: {
      const double factor = tangent(std::clamp(value, kLeast, kPi - kLeast) / 2) / half_height;
      return scale_sides(p, factor, factor);
    }
    case AnimatedProperty::aspect:
      return scale_sides(p, std::clamp(value, kLeast, kMost) * half_height / half_width, 1);
    case AnimatedProperty::x_extent:
      return scale_sides(p, std::clamp(value, kLeast, kMost) / half_width, 1);
    case AnimatedProperty::y_extent:
      return scale_sides(p, 1, std::clamp(value, kLeast, kMost) / half_height);
    case AnimatedProperty::near:
      p.near = std::max(value, p.is_orthographic ? 0 : kLeast);
      p.far = std::max(p.far, p.near * (1 + kLeast) + kLeast);
      return;
    default:
      p.far = std::max(value, p.near * (1 + kLeast) + kLeast);
      return;
  }
}

void set_light_value(Light& light, AnimatedProperty property, std::span<const double> v) {
  constexpr double kShortest = 1e-6;
  switch (property) {
    case AnimatedProperty::light_color:
      light.color = {to_amount(v[0]), to_amount(v[1]), to_amount(v[2])};
      return;
    case AnimatedProperty::intensity:
      light.intensity = std::clamp(v[0], 0.0, kMaxRadiance);
      return;
    case AnimatedProperty::lumens:
      light.lumens = std::clamp(v[0], 0.0, kMaxRadiance);
      return;
    case AnimatedProperty::range:
      light.range = std::max(v[0], kShortest);
      return;
    case AnimatedProperty::inner_cone:
      light.inner_cone = Angle::radians(std::clamp(v[0], 0.0, kPi / 2));
      return;
    default:
      light.outer_cone = Angle::radians(std::clamp(v[0], kShortest, kPi / 2));
      return;
  }
}

Texture& texture_of(Material& material, int number) {
  Texture* const textures[] = {&material.base_color_texture, &material.metallic_roughness_texture,
                               &material.normal_texture, &material.occlusion_texture,
                               &material.emissive_texture};
  constexpr int kOwn = std::size(textures);
  return number < kOwn ? *textures[number]
                       : lobe_texture_of(material, static_cast<std::size_t>(number - kOwn));
}

// KHR_texture_transform: uv' = translation · rotation · scale · uv, factor by factor from the left.
void multiply_texture(Texture& texture, AnimatedProperty property, std::span<const double> v) {
  std::array<float, 6>& m = texture.uv_from_mesh_uv;
  if (property == AnimatedProperty::texture_offset) {
    m = {1, 0, static_cast<float>(v[0]), 0, 1, static_cast<float>(v[1])};
    return;
  }
  double factor[4] = {1, 0, 0, 1};  // rows
  if (property == AnimatedProperty::texture_rotation) {
    const double angle = std::fmod(v[0], 2 * kPi);
    factor[0] = factor[3] = cosine(angle);
    factor[1] = sine(angle);
    factor[2] = -factor[1];
  } else {
    factor[0] = v[0], factor[3] = v[1];
  }
  for (std::size_t row = 0; row < 2; ++row) {
    const double a = m[3 * row], b = m[3 * row + 1];
    m[3 * row] = static_cast<float>(a * factor[0] + b * factor[2]);
    m[3 * row + 1] = static_cast<float>(a * factor[1] + b * factor[3]);
  }
}

void set_material_value(Material& material, const ClipChannel& channel, std::span<const double> v) {
  switch (channel.property) {
    case AnimatedProperty::base_color:
      material.base_color = {to_amount(v[0]), to_amount(v[1]), to_amount(v[2]), to_float(v[3], 0, 1)};
      return;
    case AnimatedProperty::metallic:
      material.metallic = to_float(v[0], 0, 1);
      return;
    case AnimatedProperty::roughness:
      material.roughness = to_float(v[0], 0, 1);
      return;
    case AnimatedProperty::emissive:
      material.emissive = {to_amount(v[0]), to_amount(v[1]), to_amount(v[2])};
      return;
    case AnimatedProperty::emissive_strength:
      for (int i = 0; i < 3; ++i)
        material.emissive[i] = to_amount(static_cast<double>(material.emissive[i]) * v[0]);
      return;
    case AnimatedProperty::alpha_cutoff:
      material.alpha_cutoff = to_float(v[0], 0, 2);
      return;
    case AnimatedProperty::normal_scale:
      material.normal_scale = to_float(v[0], -1e6, 1e6);
      return;
    case AnimatedProperty::occlusion_strength:
      material.occlusion_strength = to_float(v[0], 0, 1);
      return;
    default:
      if (const LobeFactor* factor = find_lobe_factor(channel.property))
        return set_lobe_factor(material, *factor, v);
      return multiply_texture(texture_of(material, channel.texture), channel.property, v);
  }
}

// Gathers what channels say of one scene, then puts it there.
class Posing {
 public:
  Posing(Scene& scene, double time) : scene_(scene), time_(time) {}

  void play(const Clip& clip, PoseChanges& changes) {
    const double time = clip_time(clip, duration(clip), time_);
    for (const ClipChannel& channel : clip.channels) {
      const KeyFrames& keys = clip.keys[static_cast<std::size_t>(channel.keys)];
      const std::size_t per_key = keys.values.size() / keys.times.size() /
                                  (keys.interpolation == KeyInterpolation::cubic_spline ? 3 : 1);
      values_.resize(per_key);
      sample_keys(keys, time, channel.property == AnimatedProperty::rotation, values_);
      put(channel, changes);
    }
  }

  void finish() {
    for (const auto& [index, transform] : transforms_)
      scene_.nodes[static_cast<std::size_t>(index)].parent_from_node = to_matrix(transform);
  }

  void set_rest(int node, const Transform& transform) { rest_[node] = &transform; }

 private:
  void put(const ClipChannel& channel, PoseChanges& changes) {
    const auto target = static_cast<std::size_t>(channel.target);
    if (moves_node(channel.property)) {
      changes.nodes = true;
      put_node(channel);
    } else if (changes_light(channel)) {
      changes.lights = true;
      Light& light = scene_.lights[target];
      if (changes_frustum(channel.property)) {
        set_frustum(light.projection, channel.property, values_[0]);
      } else {
        set_light_value(light, channel.property, values_);
      }
    } else if (changes_material(channel.property)) {
      changes.materials = true;
      set_material_value(scene_.materials[target], channel, values_);
    } else {
      changes.cameras = true;
      set_frustum(scene_.cameras[target].projection, channel.property, values_[0]);
    }
  }

  void put_node(const ClipChannel& channel) {
    Node& node = scene_.nodes[static_cast<std::size_t>(channel.target)];
    if (channel.property == AnimatedProperty::weights) {
      node.weights.assign(values_.begin(), values_.end());
      return;
    }
    if (channel.property == AnimatedProperty::look_at) {
      transforms_.erase(channel.target);
      node.parent_from_node = gaze_matrix(values_);
      return;
    }
    Transform& transform = transforms_.try_emplace(channel.target, *rest_.at(channel.target)).first->second;
    if (channel.property == AnimatedProperty::translation) transform.translation = vector_of(values_);
    if (channel.property == AnimatedProperty::rotation)
      transform.rotation = {values_[0], values_[1], values_[2], values_[3]};
    if (channel.property == AnimatedProperty::scale) transform.scale = vector_of(values_);
  }

  Scene& scene_;
  double time_;
  std::vector<double> values_;
  std::map<int, const Transform*> rest_;
  std::map<int, Transform> transforms_;
};

// A node's children and what its skin hangs on move with it.
bool hangs_on_moving(const Scene& scene, const Node& node, const std::vector<bool>& moves) {
  if (node.parent >= 0 && moves[static_cast<std::size_t>(node.parent)]) return true;
  if (node.skin < 0) return false;
  const std::vector<int>& joints = scene.skins[static_cast<std::size_t>(node.skin)].joints;
  return std::any_of(joints.begin(), joints.end(),
                     [&](int joint) { return moves[static_cast<std::size_t>(joint)]; });
}

// All that hang on nodes which move.
void take_along(const Scene& scene, std::vector<bool>& moves) {
  // Parents mostly come first: one pass finds nearly all, and a last one nothing.
  for (bool found = true; found;) {
    found = false;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      if (moves[i] || !hangs_on_moving(scene, scene.nodes[i], moves)) continue;
      moves[i] = found = true;
    }
  }
}

}  // namespace

bool changes_material(AnimatedProperty property) { return property >= AnimatedProperty::base_color; }

Transform parts_of(const glm::dmat4& parent_from_node) {
  Transform parts;
  parts.translation = glm::dvec3(parent_from_node[3]);
  glm::dmat3 turned(parent_from_node);
  for (int axis = 0; axis < 3; ++axis) parts.scale[axis] = glm::length(turned[axis]);
  if (glm::determinant(turned) < 0) parts.scale.x = -parts.scale.x;
  for (int axis = 0; axis < 3; ++axis) {
    // An axis that is flat has no direction of its own.
    turned[axis] = parts.scale[axis] == 0 ? glm::dmat3(1.0)[axis] : turned[axis] / parts.scale[axis];
  }
  const glm::dquat rotation = glm::normalize(glm::quat_cast(turned));
  parts.rotation = {rotation.x, rotation.y, rotation.z, rotation.w};
  return parts;
}

glm::dmat4 gaze_matrix(std::span<const double> v) {
  const glm::dvec3 position = vector_of(v);
  const Result<Pose> pose = Pose::look_at(position, vector_of(v.subspan(3)), vector_of(v.subspan(6)));
  return pose ? pose->world_from_view() : Pose{position, glm::dmat3(1.0)}.world_from_view();
}

std::vector<bool> moving_nodes(const Scene& scene) {
  std::vector<bool> moves(scene.nodes.size(), false);
  bool any = false;
  for (const Clip& clip : scene.clips) {
    if (!clip.plays) continue;
    for (const ClipChannel& channel : clip.channels) {
      if (!moves_node(channel.property)) continue;
      any = true;
      moves[static_cast<std::size_t>(channel.target)] = true;
    }
  }
  if (!any) return {};
  take_along(scene, moves);
  return moves;
}

std::vector<bool> nodes_moved_by(const Scene& scene, int node) {
  std::vector<bool> moves(scene.nodes.size(), false);
  moves[static_cast<std::size_t>(node)] = true;
  take_along(scene, moves);
  return moves;
}

ScenePose::ScenePose(const Scene& scene) {
  for (const Clip& clip : scene.clips) {
    if (!clip.plays) continue;
    for (const ClipChannel& channel : clip.channels) {
      const auto target = static_cast<std::size_t>(channel.target);
      if (moves_node(channel.property)) {
        const Node& node = scene.nodes[target];
        nodes_.try_emplace(channel.target, NodeAtRest{node.parent_from_node,
                                                      node.transform.value_or(Transform{}), node.weights});
      } else if (changes_light(channel)) {
        lights_.try_emplace(channel.target, scene.lights[target]);
      } else if (changes_material(channel.property)) {
        materials_.try_emplace(channel.target, scene.materials[target]);
      } else {
        cameras_.try_emplace(channel.target, scene.cameras[target]);
      }
    }
  }
}

PoseChanges ScenePose::apply(Scene& scene, double time) const {
  for (const auto& [index, rest] : nodes_) {
    Node& node = scene.nodes[static_cast<std::size_t>(index)];
    node.parent_from_node = rest.parent_from_node;
    node.weights = rest.weights;
  }
  for (const auto& [index, rest] : cameras_) scene.cameras[static_cast<std::size_t>(index)] = rest;
  for (const auto& [index, rest] : lights_) scene.lights[static_cast<std::size_t>(index)] = rest;
  for (const auto& [index, rest] : materials_) scene.materials[static_cast<std::size_t>(index)] = rest;
  PoseChanges changes;
  Posing posing(scene, time);
  for (const auto& [index, rest] : nodes_) posing.set_rest(index, rest.transform);
  for (const Clip& clip : scene.clips) {
    if (clip.plays) posing.play(clip, changes);
  }
  posing.finish();
  for (const auto& [index, rest] : lights_) {
    Light& light = scene.lights[static_cast<std::size_t>(index)];
    light.inner_cone = std::min(light.inner_cone, light.outer_cone);
  }
  return changes;
}

void ScenePose::set_light(int light, const Light& value) {
  if (const auto rest = lights_.find(light); rest != lights_.end()) rest->second = value;
}

void ScenePose::set_node(int node, const glm::dmat4& parent_from_node) {
  const auto rest = nodes_.find(node);
  if (rest == nodes_.end()) return;
  rest->second.parent_from_node = parent_from_node;
  rest->second.transform = parts_of(parent_from_node);
}

void pose_scene(Scene& scene, double seconds) { ScenePose(scene).apply(scene, seconds); }

}  // namespace laterna
