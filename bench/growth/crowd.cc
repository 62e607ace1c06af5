#include "crowd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "reference/shapes.h"
#include "scene/key_frames.h"

namespace laterna::growth {
namespace {

// Models and their skins, which the second does not name.
constexpr std::pair<const char*, const char*> kModels[] = {
    {"/usr/share/assimp/models/MD2/sydney.md2", "/usr/share/assimp/models/MD2/sydney.bmp"},
    {"/usr/share/assimp/models/MD2/faerie.md2", "/usr/share/assimp/models/MD2/faerie2.bmp"}};
constexpr double kMetresPerUnit = 1.8 / 56;  // Quake's men are 56 units tall
constexpr double kSpacing = 1.5;             // metres from model to model
constexpr double kGoldenRatio = 0.6180339887498949;

double fraction(double value) { return value - std::floor(value); }

int per_row(const Crowd& crowd) { return static_cast<int>(std::ceil(std::sqrt(crowd.models))); }
double half_side(const Crowd& crowd) { return 0.5 * kSpacing * per_row(crowd); }

// Key frames of a clip that loops, as they are from `start` seconds on.
KeyFrames begun_at(const KeyFrames& keys, double start) {
  const double end = keys.times.back();
  const std::size_t per_key = keys.values.size() / keys.times.size();
  KeyFrames shifted{keys.interpolation, {}, {}};
  const auto push = [&](double time, std::span<const double> values) {
    shifted.times.push_back(time);
    shifted.values.insert(shifted.values.end(), values.begin(), values.end());
  };
  const auto push_keys = [&](double after, double before, double shift) {
    for (std::size_t i = 0; i < keys.times.size(); ++i) {
      if (keys.times[i] > after && keys.times[i] < before)
        push(keys.times[i] + shift, std::span(keys.values).subspan(i * per_key, per_key));
    }
  };
  std::vector<double> first(per_key);
  sample_keys(keys, start, per_key == 4, first);
  push(0, first);
  push_keys(start, end, -start);
  if (start > 0) push(end - start, std::span(keys.values).last(per_key));
  push_keys(0, start, end - start);
  push(end, first);
  return shifted;
}

// A tube of 24 × 12 quads that a chain of joints, one upon the other, bends to and fro.
Scene make_reed() {
  constexpr int kRings = 24, kSides = 12, kJoints = 8;
  constexpr double kTall = 1.8, kTurn = 2 * std::numbers::pi;
  Primitive p;
  p.influences = 2;
  for (int ring = 0; ring <= kRings; ++ring) {
    const double along = static_cast<double>(ring) / kRings, joint = along * (kJoints - 1);
    const int low = std::min(static_cast<int>(joint), kJoints - 2);
    for (int side = 0; side <= kSides; ++side) {
      const double turn = kTurn * side / kSides, radius = 0.25 * (1.2 - along);
      p.positions.emplace_back(radius * std::cos(turn), kTall * along, radius * std::sin(turn));
      p.normals.emplace_back(std::cos(turn), 0, std::sin(turn));
      p.joints.insert(p.joints.end(), {static_cast<std::uint16_t>(low), static_cast<std::uint16_t>(low + 1)});
      p.joint_weights.insert(p.joint_weights.end(),
                             {static_cast<float>(low + 1 - joint), static_cast<float>(joint - low)});
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t a = ring * (kSides + 1) + side, b = a + kSides + 1;
      for (const std::uint32_t i : {a, b, a + 1, a + 1, b, b + 1}) p.indices.push_back(i);
    }
  }
  Scene scene;
  reference::add_object(scene, "reed", std::move(p), {0.4F, 0.7F, 0.3F});
  scene.nodes.front().skin = 0;
  Skin& skin = scene.skins.emplace_back();
  Clip& clip = scene.clips.emplace_back();
  clip.name = "sway";
  KeyFrames keys{KeyInterpolation::linear, {}, {}};
  for (int i = 0; i <= 16; ++i) {
    const double angle = 0.12 * std::sin(kTurn * i / 16);
    keys.times.push_back(i / 8.0);
    keys.values.insert(keys.values.end(), {0, 0, std::sin(angle / 2), std::cos(angle / 2)});
  }
  clip.keys.push_back(std::move(keys));
  for (int joint = 0; joint < kJoints; ++joint) {
    const double height = kTall / (kJoints - 1);
    const int index = static_cast<int>(scene.nodes.size());
    Node node;
    node.parent = joint == 0 ? -1 : index - 1;
    node.transform = Transform{{0, joint == 0 ? 0 : height, 0}};
    node.parent_from_node = to_matrix(*node.transform);
    scene.nodes.push_back(node);
    skin.joints.push_back(index);
    skin.joint_from_bind.push_back(glm::translate(glm::dmat4(1), {0, -height * joint, 0}));
    ClipChannel channel;
    channel.property = AnimatedProperty::rotation;
    channel.target = index;
    channel.keys = 0;
    clip.channels.push_back(channel);
  }
  return scene;
}

Result<std::vector<Scene>> load_models() {
  std::vector<Scene> models;
  for (const auto& [file, skin] : kModels) {
    if (!std::filesystem::exists(file)) continue;
    LoadOptions options;
    options.metres_per_unit = kMetresPerUnit;
    Result<Scene> model = load_scene({file}, options);
    if (!model) return tl::unexpected(model.error());
    if (!model->materials.front().base_color_texture.is_set()) {
      Picture& picture = model->pictures.emplace_back();
      picture.name = picture.file = skin;
      model->materials.front().base_color_texture.picture = static_cast<int>(model->pictures.size()) - 1;
    }
    models.push_back(std::move(*model));
  }
  if (models.empty()) models.push_back(make_reed());
  return models;
}

// Metres that the lowest vertex is above the ground, at rest.
double lowest(const Scene& model) {
  const std::vector<glm::dmat4> places = world_from_nodes(model);
  double low = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    if (model.nodes[n].mesh < 0) continue;
    for (const Primitive& p : model.meshes[static_cast<std::size_t>(model.nodes[n].mesh)].primitives) {
      for (const glm::vec3& v : p.positions) low = std::min(low, (places[n] * glm::dvec4(v, 1)).y);
    }
  }
  return low;
}

// What all of a kind share: meshes, materials and pictures. Copies get nodes, skins and a clip.
class Kind {
 public:
  Kind(Scene model, Scene& scene)
      : model_(std::move(model)), low_(lowest(model_)), first_mesh_(static_cast<int>(scene.meshes.size())) {
    const int first_picture = static_cast<int>(scene.pictures.size());
    const int first_material = static_cast<int>(scene.materials.size());
    for (Picture& picture : model_.pictures) scene.pictures.push_back(std::move(picture));
    for (Material& material : model_.materials) {
      if (material.base_color_texture.is_set()) material.base_color_texture.picture += first_picture;
      scene.materials.push_back(std::move(material));
    }
    for (Mesh& mesh : model_.meshes) {
      for (Primitive& p : mesh.primitives) p.material += p.material < 0 ? 0 : first_material;
      scene.meshes.push_back(std::move(mesh));
    }
  }

  void add_copy(Scene& scene, int number, glm::dvec2 place) const {
    const int root = static_cast<int>(scene.nodes.size()), first = root + 1;
    const int first_skin = static_cast<int>(scene.skins.size());
    Node stand;
    stand.name = "model " + std::to_string(number);
    stand.parent_from_node = glm::rotate(glm::translate(glm::dmat4(1), {place.x, -low_, place.y}),
                                         2 * std::numbers::pi * fraction(kGoldenRatio * number), {0, 1, 0});
    scene.nodes.push_back(stand);
    for (Node node : model_.nodes) {
      node.parent = node.parent < 0 ? root : node.parent + first;
      if (node.mesh >= 0) node.mesh += first_mesh_;
      if (node.skin >= 0) node.skin += first_skin;
      scene.nodes.push_back(std::move(node));
    }
    for (Skin skin : model_.skins) {
      for (int& joint : skin.joints) joint += first;
      scene.skins.push_back(std::move(skin));
    }
    add_clip(scene, number, first);
  }

 private:
  void add_clip(Scene& scene, int number, int first_node) const {
    if (model_.clips.empty()) return;
    Clip clip = model_.clips[static_cast<std::size_t>(number) % model_.clips.size()];
    clip.name += " of model " + std::to_string(number);
    clip.plays = true;
    const double start = duration(clip) * fraction(kGoldenRatio * (number + 1));
    for (KeyFrames& keys : clip.keys) keys = begun_at(keys, start);
    for (ClipChannel& channel : clip.channels) channel.target += first_node;
    scene.clips.push_back(std::move(clip));
  }

  Scene model_;
  double low_;
  int first_mesh_;
};

// Round in 16 s, each at another place of its circle, looking at the ground half way to the middle.
void add_wandering_spot(Scene& scene, const Crowd& crowd, int number) {
  constexpr int kKeys = 32;
  constexpr std::array<glm::vec3, 4> kColours = {
      {{1, 0.8F, 0.6F}, {0.6F, 0.8F, 1}, {1, 0.6F, 0.8F}, {0.8F, 1, 0.7F}}};
  const double side = half_side(crowd);
  Light light;
  light.name = "spot " + std::to_string(number);
  light.type = LightType::spot;
  light.color = kColours.at(static_cast<std::size_t>(number) % kColours.size());
  light.inner_cone = Angle::degrees(26);
  light.outer_cone = Angle::degrees(34);
  light.intensity = 5 * side * side / std::sqrt(crowd.lights);
  light.shadow.resolution = crowd.map_size;
  KeyFrames keys{KeyInterpolation::linear, {}, {}};
  for (int k = 0; k <= kKeys; ++k) {
    const double turn = 2 * std::numbers::pi * (static_cast<double>(k) / kKeys + kGoldenRatio * number);
    const double x = side * std::cos(turn), z = side * std::sin(turn);
    keys.times.push_back(0.5 * k);
    keys.values.insert(keys.values.end(), {0.9 * x, 1.6 * side, 0.9 * z, 0.4 * x, 0, 0.4 * z, 0, 1, 0});
  }
  const std::vector<double>& v = keys.values;
  const int node = reference::add_light(scene, light, {v[0], v[1], v[2]}, {v[3], v[4], v[5]});
  Clip& clip = scene.clips.emplace_back();
  clip.name = "path of " + light.name;
  clip.is_path = true;
  ClipChannel channel;
  channel.property = AnimatedProperty::look_at;
  channel.target = node;
  channel.keys = 0;
  clip.channels.push_back(channel);
  clip.keys.push_back(std::move(keys));
}

}  // namespace

Result<Scene> make_crowd(const Crowd& crowd) {
  Result<std::vector<Scene>> models = load_models();
  if (!models) return tl::unexpected(models.error());
  Scene scene;
  reference::add_object(scene, "ground", reference::floor(static_cast<float>(6 * half_side(crowd))),
                        {0.6F, 0.6F, 0.55F});
  std::vector<Kind> kinds;
  for (Scene& model : *models) kinds.emplace_back(std::move(model), scene);
  const int row = per_row(crowd);
  for (int i = 0; i < crowd.models; ++i) {
    const glm::dvec2 place = kSpacing * (glm::dvec2(i % row, i / row) - 0.5 * (row - 1));
    kinds[static_cast<std::size_t>(i) % kinds.size()].add_copy(scene, i, place);
  }
  for (int i = 0; i < crowd.lights; ++i) add_wandering_spot(scene, crowd, i);
  scene.ambient = glm::vec3(0.08F);
  scene.ambient_is_set = true;
  return scene;
}

View look_at_crowd(const Crowd& crowd, double aspect) {
  const double side = half_side(crowd);
  return reference::look({0, 1.15 * side + 1, 1.9 * side + 0.5}, {0, 0, 0.1 * side}, 36, aspect);
}

}  // namespace laterna::growth
