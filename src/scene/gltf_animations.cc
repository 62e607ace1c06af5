#include "scene/gltf_animations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "scene/gltf_animation_pointers.h"
#include "scene/gltf_extension.h"
#include "scene/gltf_light_extensions.h"
#include "scene/spelling.h"

namespace laterna::gltf {
namespace {

using P = AnimatedProperty;

// A value deep in the file: "pbrMetallicRoughness/baseColorTexture" of a material. Null where it is not there.
const JsonValue* descend(const JsonValue* value, std::string_view path) {
  while (value != nullptr && !path.empty()) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    value = value->find(path.substr(0, slash));
    path.remove_prefix(std::min(slash + 1, path.size()));
  }
  return value;
}

std::size_t morph_target_count(const Scene& scene, int node) {
  const int mesh = scene.nodes[static_cast<std::size_t>(node)].mesh;
  if (mesh < 0) return 0;
  const std::vector<Primitive>& primitives = scene.meshes[static_cast<std::size_t>(mesh)].primitives;
  return primitives.empty() ? 0 : primitives.front().targets.size();
}

}  // namespace

struct Animations::Target {
  AnimatedKind kind;
  P property;
  int index;  // in the file's list
  int texture;
  const JsonValue* value;  // the thing in the file
};

Animations::Animations(const JsonDocument& json, Accessors& accessors, FaultList& faults)
    : json_(json), accessors_(accessors), faults_(faults) {
  JsonObject root(json, json.root(), faults);
  const JsonValue* list = root.array("animations");
  if (list == nullptr) return;
  for (const JsonValue& value : list->children) {
    values_.push_back(&value);
    const JsonValue* channels = JsonObject(json, value, faults).array("channels");
    if (channels == nullptr) continue;
    // What is wrong with a target is told when it is read.
    FaultList unheard(faults.file());
    Animations quiet(*this, unheard);
    for (const JsonValue& channel : channels->children) {
      const std::optional<Target> target = quiet.parse_target(channel);
      if (!target || target->property != P::weights) continue;
      (target->kind == AnimatedKind::mesh ? meshes_with_weights_ : nodes_with_weights_).insert(target->index);
    }
  }
}

Animations::Animations(const Animations& other, FaultList& faults)
    : json_(other.json_), accessors_(other.accessors_), faults_(faults) {}

bool Animations::move_weights(int node, int mesh) const {
  return nodes_with_weights_.contains(node) || meshes_with_weights_.contains(mesh);
}

std::optional<Animations::Target> Animations::parse_target(const JsonValue& channel) {
  JsonObject object(json_, channel, faults_);
  if (!channel.is_object() || !object.require("target")) return std::nullopt;
  const JsonValue* value = object.object("target");
  if (value == nullptr) return std::nullopt;
  JsonObject target(json_, *value, faults_);
  target.require("path");
  const std::optional<std::string> path = target.string("path");
  if (!path) return std::nullopt;
  if (*path == "pointer") {
    const JsonValue* extension = find_extension(*value, "KHR_animation_pointer");
    if (extension == nullptr) {
      target.error("path", "\"pointer\" needs the extension KHR_animation_pointer");
      return std::nullopt;
    }
    JsonObject place(json_, *extension, faults_);
    place.require("pointer");
    const std::optional<std::string> pointer = place.string("pointer");
    return pointer ? parse_pointer(place, *pointer) : std::nullopt;
  }
  const std::optional<NamedProperty> property = find_property(AnimatedKind::node, *path);
  if (!property || property->property == P::look_at) {
    target.error("path", fmt::format("expected translation, rotation, scale, weights or pointer, got {}",
                                     in_quotes(*path)));
    return std::nullopt;
  }
  if (!target.has("node")) return std::nullopt;  // an extension's affair, as the standard says
  const JsonValue* nodes = JsonObject(json_, json_.root(), faults_).array("nodes");
  const int node = target.index("node", nodes == nullptr ? 0 : nodes->children.size(), "nodes");
  if (node < 0) return std::nullopt;
  return Target{AnimatedKind::node, property->property, node, 0,
                &nodes->children[static_cast<std::size_t>(node)]};
}

// A JSON pointer (RFC 6901) into the file: "/cameras/0/perspective/yfov".
std::optional<Animations::Target> Animations::parse_pointer(JsonObject& place, const std::string& pointer) {
  static constexpr std::pair<std::string_view, AnimatedKind> kLists[] = {
      {"/nodes/", AnimatedKind::node},
      {"/meshes/", AnimatedKind::mesh},
      {"/cameras/", AnimatedKind::camera},
      {"/extensions/KHR_lights_punctual/lights/", AnimatedKind::light},
      {"/materials/", AnimatedKind::material}};
  for (const auto& [list, kind] : kLists) {
    if (pointer.compare(0, list.size(), list) != 0) continue;
    std::size_t index = 0;
    const char* const end = pointer.data() + pointer.size();
    const auto [rest, fault] = std::from_chars(pointer.data() + list.size(), end, index);
    const JsonValue* values = descend(&json_.root(), list.substr(1, list.size() - 2));
    const std::size_t count = values != nullptr && values->is_array() ? values->children.size() : 0;
    if (fault != std::errc() || index >= count) {
      place.error("pointer",
                  fmt::format("{} leads nowhere: the file has {} of them", in_quotes(pointer), count));
      return std::nullopt;
    }
    const std::string_view path(rest, static_cast<std::size_t>(end - rest));
    const std::optional<NamedProperty> property =
        path.empty() ? std::nullopt : find_property(kind, path.substr(1));
    if (!property) break;
    const JsonValue& value = values->children[index];
    // Lobes have defaults, but pictures that are not there have no place.
    if (property->property >= P::texture_offset &&
        static_cast<std::size_t>(property->texture) >= kPlainTextures &&
        descend(&value, texture_pointer(static_cast<std::size_t>(property->texture))) == nullptr)
      break;
    // A camera of the other kind has no such lens; other members have defaults.
    if (kind == AnimatedKind::camera && descend(&value, path.substr(1, path.find('/', 1) - 1)) == nullptr) {
      place.error("pointer",
                  fmt::format("{} leads nowhere: the camera is of the other kind", in_quotes(pointer)));
      return std::nullopt;
    }
    return Target{kind, property->property, static_cast<int>(index), property->texture, &value};
  }
  place.warning("pointer", fmt::format("{} cannot be animated: left out", in_quotes(pointer)));
  return std::nullopt;
}

class Animations::ClipReader {
 public:
  ClipReader(Animations& owner, const JsonValue& value, const SceneIndices& indices, const Scene& scene,
             bool plays)
      : owner_(owner),
        json_(owner.json_),
        faults_(owner.faults_),
        indices_(indices),
        scene_(scene),
        object_(json_, value, faults_) {
    clip_.plays = plays;
  }

  Clip read() {
    clip_.name = object_.string("name").value_or("");
    read_lighting();
    object_.require_all({"channels", "samplers"});
    const JsonValue* channels = object_.array("channels");
    samplers_ = object_.array("samplers");
    if (channels == nullptr || samplers_ == nullptr) return std::move(clip_);
    for (const JsonValue& channel : channels->children) read_channel(channel);
    complete_products();
    // Parts of a product follow one another: offset, rotation and scale; a factor and its strength.
    std::stable_sort(clip_.channels.begin(), clip_.channels.end(),
                     [](const ClipChannel& a, const ClipChannel& b) { return a.property < b.property; });
    return std::move(clip_);
  }

 private:
  // How it plays, which glTF leaves to viewers.
  void read_lighting() {
    const JsonValue* extension = find_extension(object_.value(), kLightingExtension);
    if (extension == nullptr) return;
    JsonObject lighting(json_, *extension, faults_, kGltfNames);
    for (const std::string_view allowed : {"extensions", "extras"}) lighting.any(allowed);
    clip_.plays = lighting.boolean("plays").value_or(clip_.plays);
    clip_.is_path = lighting.boolean("path").value_or(clip_.is_path);
    clip_.at_end =
        lighting
            .choice<AtEnd>("at_end",
                           {{"hold", AtEnd::hold}, {"loop", AtEnd::loop}, {"ping_pong", AtEnd::ping_pong}})
            .value_or(clip_.at_end);
    lighting.report_unknown_members("an animation");
  }

  void read_channel(const JsonValue& value) {
    JsonObject channel(json_, value, faults_);
    channel.require("sampler");
    const int sampler = channel.index("sampler", samplers_->children.size(), "samplers");
    const std::optional<Target> target = owner_.parse_target(value);
    if (!target || sampler < 0) return;
    const std::vector<int> shown = scene_targets(*target);
    if (shown.empty()) return;
    auto components = static_cast<std::size_t>(component_count(target->property));
    if (target->property == P::weights) {
      components = morph_target_count(scene_, shown.front());
      if (components == 0)
        return channel.error("target", "moves the weights of a mesh without morph targets");
    } else if (target->kind == AnimatedKind::node && target->value->find("matrix") != nullptr) {
      return channel.error(
          "target",
          fmt::format("nodes[{}] has a matrix: only translation, rotation and scale move", target->index));
    }
    const int keys = read_sampler(sampler, *target, components);
    if (keys < 0) return;
    for (const int index : shown) add(*target, index, keys);
  }

  void add(const Target& target, int index, int keys) {
    ClipChannel channel;
    channel.property = target.property;
    channel.target = index;
    channel.of_light = target.kind == AnimatedKind::light;
    channel.texture = target.texture;
    channel.keys = keys;
    if (channel.of_light && target.property <= P::far &&
        scene_.lights[static_cast<std::size_t>(index)].type != LightType::projector)
      return;
    if (target.kind == AnimatedKind::material) materials_.emplace(index, target.value);
    clip_.channels.push_back(channel);
  }

  [[nodiscard]] std::vector<int> scene_targets(const Target& target) const {
    const auto index = static_cast<std::size_t>(target.index);
    const auto one = [](int i) { return i < 0 ? std::vector<int>{} : std::vector<int>{i}; };
    switch (target.kind) {
      case AnimatedKind::node:
        return one(indices_.nodes[index]);
      case AnimatedKind::camera:
        return indices_.cameras[index];
      case AnimatedKind::light:
        return indices_.lights[index];
      case AnimatedKind::material:
        return one(indices_.materials[index]);
      case AnimatedKind::mesh:
        break;
    }
    // Nodes that show it and have no weights of their own.
    std::vector<int> nodes;
    const JsonValue* list = json_.root().find("nodes");
    for (std::size_t i = 0; list != nullptr && i < indices_.nodes.size(); ++i) {
      const JsonValue* mesh = list->children[i].find("mesh");
      if (indices_.nodes[i] >= 0 && mesh != nullptr && mesh->number == target.index &&
          list->children[i].find("weights") == nullptr)
        nodes.push_back(indices_.nodes[i]);
    }
    return nodes;
  }

  // The clip's index of a sampler's keys, or −1 where it is faulty.
  int read_sampler(int sampler, const Target& target, std::size_t components) {
    const bool is_rotation = target.property == P::rotation;
    const auto [known, is_new] = keys_of_.try_emplace({sampler, components, is_rotation}, -1);
    if (!is_new) return known->second;
    JsonObject object(json_, samplers_->children[static_cast<std::size_t>(sampler)], faults_);
    if (!object.require_all({"input", "output"})) return -1;
    const std::size_t errors_before = faults_.error_count();
    KeyFrames keys;
    keys.interpolation =
        object
            .choice<KeyInterpolation>("interpolation", {{"LINEAR", KeyInterpolation::linear},
                                                        {"STEP", KeyInterpolation::step},
                                                        {"CUBICSPLINE", KeyInterpolation::cubic_spline}})
            .value_or(KeyInterpolation::linear);
    read_times(object, keys);
    if (faults_.error_count() == errors_before) read_values(object, keys, target, components);
    if (faults_.error_count() != errors_before || keys.times.empty()) return -1;
    known->second = static_cast<int>(clip_.keys.size());
    clip_.keys.push_back(std::move(keys));
    return known->second;
  }

  void read_times(JsonObject& object, KeyFrames& keys) {
    const int input = object.index("input", owner_.accessors_.size(), "accessors");
    if (input < 0 || !has_room(object, input)) return;
    const auto times = owner_.accessors_.read_numbers(input, 1, json_.place(object.value(), "input"));
    if (!times) return;
    for (std::size_t i = 0; i < times->size(); ++i) {
      const double time = (*times)[i];
      if (!(time >= 0 && time <= kMaxSceneTime)) {
        object.error("input",
                     fmt::format("key {}: expected seconds from 0 to {:g}, got {}", i, kMaxSceneTime, time));
        return;
      }
      if (i > 0 && time < keys.times.back()) {
        object.error("input", fmt::format("key {} is at {} s, before key {} at {} s", i, time, i - 1,
                                          keys.times.back()));
        return;
      }
      keys.times.push_back(time);
    }
  }

  void read_values(JsonObject& object, KeyFrames& keys, const Target& target, std::size_t components) {
    const int output = object.index("output", owner_.accessors_.size(), "accessors");
    if (output < 0 || keys.times.empty() || !has_room(object, output)) return;
    const bool is_list = target.property == P::weights || target.property == P::look_at;
    const int stored = is_list ? 1 : static_cast<int>(components);
    const auto values = owner_.accessors_.read_numbers(output, stored, json_.place(object.value(), "output"));
    if (!values) return;
    const bool has_slopes = keys.interpolation == KeyInterpolation::cubic_spline;
    const std::size_t per_key = components * (has_slopes ? 3 : 1);
    if (values->size() != per_key * keys.times.size()) {
      object.error("output",
                   fmt::format("expected {} numbers, {} for each of {} keys, got {}",
                               per_key * keys.times.size(), per_key, keys.times.size(), values->size()));
      return;
    }
    keys.values.assign(values->begin(), values->end());
    if (target.property == P::rotation) make_unit(object, keys, has_slopes);
  }

  // Integers and short floats leave quaternions a little off their length; a cubic's are brought to it between keys anyway.
  void make_unit(JsonObject& object, KeyFrames& keys, bool has_slopes) {
    for (std::size_t i = 0; i < keys.times.size(); ++i) {
      double* q = keys.values.data() + (has_slopes ? 12 * i + 4 : 4 * i);
      const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      if (!(length > 1e-6)) {
        object.error("output", fmt::format("the rotation of key {} has no length", i));
        return;
      }
      for (int k = 0; !has_slopes && k < 4; ++k) q[k] /= length;
    }
  }

  bool has_room(JsonObject& object, int accessor) {
    owner_.number_total_ += owner_.accessors_.element_count(accessor) *
                            static_cast<std::uint64_t>(owner_.accessors_.components(accessor));
    if (owner_.number_total_ <= kMaxKeyNumbers) return true;
    object.error({}, fmt::format("the file's animations hold more than {} numbers", kMaxKeyNumbers));
    return false;
  }

  [[nodiscard]] bool has_channel(int material, P property, int texture) const {
    return std::any_of(clip_.channels.begin(), clip_.channels.end(), [&](const ClipChannel& channel) {
      return channel.property == property && channel.target == material && channel.texture == texture;
    });
  }

  void add_constant(int material, P property, int texture, std::vector<double> values) {
    if (has_channel(material, property, texture)) return;
    ClipChannel channel;
    channel.property = property;
    channel.target = material;
    channel.texture = texture;
    channel.keys = static_cast<int>(clip_.keys.size());
    clip_.keys.push_back({KeyInterpolation::step, {0}, std::move(values)});
    clip_.channels.push_back(channel);
  }

  // The scene keeps products: of an emissive colour and its strength, of a texture's offset, rotation and scale. Where a part
  // of one moves, its other parts become channels that stand still.
  void complete_products() {
    const std::vector<ClipChannel> read = clip_.channels;
    for (const ClipChannel& channel : read) {
      const auto found = materials_.find(channel.target);
      if (channel.property < P::base_color || found == materials_.end()) continue;
      const JsonValue& material = *found->second;
      if (channel.property == P::emissive || channel.property == P::emissive_strength) {
        JsonObject factors(json_, material, faults_);
        const auto color = factors.numbers<3>("emissiveFactor").value_or(std::array<double, 3>{0, 0, 0});
        add_constant(channel.target, P::emissive, 0, {color[0], color[1], color[2]});
        const JsonValue* strength =
            descend(&material, "extensions/KHR_materials_emissive_strength/emissiveStrength");
        add_constant(channel.target, P::emissive_strength, 0, {strength == nullptr ? 1 : strength->number});
      } else if (channel.property >= P::texture_offset) {
        add_transform(channel,
                      descend(&material, texture_pointer(static_cast<std::size_t>(channel.texture))));
      }
    }
  }

  void add_transform(const ClipChannel& channel, const JsonValue* texture) {
    const JsonValue* extension =
        texture == nullptr ? nullptr : find_extension(*texture, "KHR_texture_transform");
    std::array<double, 2> offset = {0, 0}, scale = {1, 1};
    double rotation = 0;
    if (extension != nullptr) {
      JsonObject transform(json_, *extension, faults_);
      offset = transform.numbers<2>("offset").value_or(offset);
      scale = transform.numbers<2>("scale").value_or(scale);
      rotation = transform.number("rotation").value_or(0);
    }
    add_constant(channel.target, P::texture_offset, channel.texture, {offset[0], offset[1]});
    add_constant(channel.target, P::texture_rotation, channel.texture, {rotation});
    add_constant(channel.target, P::texture_scale, channel.texture, {scale[0], scale[1]});
  }

  Animations& owner_;
  const JsonDocument& json_;
  FaultList& faults_;
  const SceneIndices& indices_;
  const Scene& scene_;
  JsonObject object_;
  const JsonValue* samplers_ = nullptr;
  struct KeysOf {
    int sampler;
    std::size_t components;
    bool is_rotation;
    auto operator<=>(const KeysOf&) const = default;
  };
  std::map<KeysOf, int> keys_of_;
  std::map<int, const JsonValue*> materials_;  // that move: by the scene's index, in the file
  Clip clip_;
};

std::vector<Clip> Animations::read(const SceneIndices& indices, const Scene& scene) {
  std::vector<Clip> clips;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    Clip clip = ClipReader(*this, *values_[i], indices, scene, i == 0).read();
    if (clip.name.empty()) clip.name = fmt::format("clip {}", i + 1);
    clips.push_back(std::move(clip));
  }
  return clips;
}

}  // namespace laterna::gltf
