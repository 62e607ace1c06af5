#include "game_models.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <optional>
#include <utility>

namespace laterna::app {
namespace {

struct Files {
  const char *model, *skin;  // the second model does not name its skin
};
constexpr std::array<Files, 2> kFiles = {
    {{"/usr/share/assimp/models/MD2/sydney.md2", "/usr/share/assimp/models/MD2/sydney.bmp"},
     {"/usr/share/assimp/models/MD2/faerie.md2", "/usr/share/assimp/models/MD2/faerie2.bmp"}}};
constexpr double kMetresPerUnit = 1.75 / 56;  // a player of the game is 56 units tall

/// As it is at that time of its running, without clips.
std::optional<Scene> load_running(int model, double time) {
  const auto& [file, skin] = kFiles.at(static_cast<std::size_t>(model) % kFiles.size());
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  LoadOptions options;
  options.metres_per_unit = kMetresPerUnit;
  Result<Scene> scene = load_scene({file}, options);
  if (!scene || !choose_clip(*scene, "run")) return std::nullopt;
  Texture& texture = scene->materials.front().base_color_texture;
  if (!texture.is_set()) {
    Picture& picture = scene->pictures.emplace_back();
    picture.name = picture.file = skin;
    texture.picture = static_cast<int>(scene->pictures.size()) - 1;
  }
  pose_scene(*scene, time);
  scene->clips.clear();
  return std::move(*scene);
}

/// The height of the lowest vertex, with what morph targets make of it.
double lowest(const Scene& scene) {
  const std::vector<glm::dmat4> places = world_from_nodes(scene);
  double low = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    const Node& node = scene.nodes[n];
    if (node.mesh < 0) continue;
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      for (std::size_t v = 0; v < p.positions.size(); ++v) {
        glm::dvec3 position(p.positions[v]);
        for (std::size_t t = 0; t < std::min(node.weights.size(), p.targets.size()); ++t)
          position += static_cast<double>(node.weights[t]) * glm::dvec3(p.targets[t].positions[v]);
        low = std::min(low, (places[n] * glm::dvec4(position, 1)).y);
      }
    }
  }
  return low;
}

}  // namespace

bool add_game_model(Scene& scene, const std::string& name, int model, const RunningPose& pose) {
  std::optional<Scene> source = load_running(model, pose.time);
  if (!source) return false;
  const auto root = static_cast<int>(scene.nodes.size());
  const auto mesh = static_cast<int>(scene.meshes.size()),
             material = static_cast<int>(scene.materials.size());
  const auto picture = static_cast<int>(scene.pictures.size());
  Node stand;
  stand.name = name;
  const glm::dvec3 place(pose.foot.x, pose.foot.y - lowest(*source), pose.foot.z);
  stand.parent_from_node =
      glm::rotate(glm::translate(glm::dmat4(1), place), static_cast<double>(pose.turn), glm::dvec3(0, 1, 0));
  scene.nodes.push_back(stand);
  for (Node& node : source->nodes) {
    node.parent += 1 + root;  // -1, none, becomes the stand
    if (node.mesh >= 0) {
      node.mesh += mesh;
      node.name = name;
    }
    scene.nodes.push_back(std::move(node));
  }
  for (Mesh& source_mesh : source->meshes) {
    for (Primitive& p : source_mesh.primitives) p.material += p.material < 0 ? 0 : material;
    scene.meshes.push_back(std::move(source_mesh));
  }
  for (Material& skin : source->materials) {
    if (skin.base_color_texture.is_set()) skin.base_color_texture.picture += picture;
    scene.materials.push_back(std::move(skin));
  }
  for (Picture& skin : source->pictures) scene.pictures.push_back(std::move(skin));
  return true;
}

}  // namespace laterna::app
