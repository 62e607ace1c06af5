#include "workload.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <nlohmann/json.hpp>

namespace laterna::app {
namespace {

using Json = nlohmann::json;

glm::dvec3 vector_of(const Json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

Error fault(const std::filesystem::path& file, std::string place, std::string message) {
  return {Failure::bad_input, Diagnostic{file.string(), std::move(place), std::move(message)}};
}

void add_node(Scene& scene, Light light, const Pose& pose) {
  scene.lights.push_back(std::move(light));
  Node node;
  node.name = scene.lights.back().name;
  node.light = static_cast<int>(scene.lights.size()) - 1;
  node.parent_from_node = pose.world_from_view();
  scene.nodes.push_back(node);
}

// A square slide of uniform intensity in candela, or a sun whose shadow map has a given frustum.
Result<void> add_light(Scene& scene, const Json& j, const std::filesystem::path& scenes) {
  Light light;
  light.name = fmt::format("light {}", scene.lights.size());
  light.color = glm::vec3(vector_of(j.at("color")));
  light.shadow.resolution = j.at("shadow_size").get<int>();
  const double near = j.at("near").get<double>();
  const double far = j.at("far").get<double>();
  if (j.at("type") == "spot") {
    light.type = LightType::projector;
    light.profile = BeamProfile::uniform_candela;
    light.projection = Projection::perspective(Angle::degrees(j.at("fov_deg").get<double>()), 1, near, far);
    if (j.contains("slide")) {
      Picture slide;
      slide.file = scenes / j.at("slide").get<std::string>();
      slide.name = slide.file.string();
      light.slide = static_cast<int>(scene.pictures.size());
      scene.pictures.push_back(std::move(slide));
    }
  } else {
    light.type = LightType::directional;
    light.fit = false;
    light.projection = Projection::orthographic(j.at("half_width").get<double>(),
                                                j.at("half_height").get<double>(), near, far);
  }
  const Result<Pose> pose =
      Pose::look_at(vector_of(j.at("position")), vector_of(j.at("target")), vector_of(j.at("up")));
  if (!pose) return tl::unexpected(pose.error());
  add_node(scene, std::move(light), *pose);
  return {};
}

// The models of the bunny workloads: one mesh at many places, on a square of ground.
void place_bunnies(Scene& scene, const Json& w) {
  Node& model = scene.nodes.at(0);
  for (const Json& place : w.at("bunnies")) {
    const double angle = place.at(3).get<double>();
    const Result<Pose> turned = Pose::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0});
    glm::dmat4 m = turned->world_from_view();
    const double radians = Angle::degrees(angle).in_radians();
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    m[0] = {c, 0, -s, 0};
    m[2] = {s, 0, c, 0};
    m[3] = {vector_of(place), 1};
    model.node_from_instance.push_back(m);
  }
  const auto half = w.at("ground_half_size").get<float>();
  Material material;
  material.name = "ground";
  material.base_color = {0.6F, 0.6F, 0.6F, 1};
  scene.materials.push_back(material);
  Primitive quad;
  quad.positions = {{-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half}};
  quad.normals.assign(4, {0, 1, 0});
  quad.indices = {0, 1, 2, 0, 2, 3};
  quad.material = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.push_back({"ground", {quad}});
  Node ground;
  ground.name = "ground";
  ground.mesh = static_cast<int>(scene.meshes.size()) - 1;
  scene.nodes.push_back(ground);
}

Result<Workload> build(const Json& all, const Json& w, const std::filesystem::path& scenes) {
  Workload workload;
  const bool is_bunnies = w.at("scene") == "bunnies";
  const std::filesystem::path model =
      is_bunnies ? scenes / "bunny/bunny.gltf" : scenes / "sponza/Sponza.gltf";
  Result<Scene> scene = load_scene({model});
  if (!scene) return tl::unexpected(scene.error());
  workload.scene = std::move(*scene);
  if (is_bunnies) place_bunnies(workload.scene, w);
  for (const Json& light : w.at("lights")) {
    if (Result<void> added = add_light(workload.scene, light, scenes); !added)
      return tl::unexpected(added.error());
  }
  workload.scene.ambient = glm::vec3(vector_of(w.at("ambient")));
  workload.scene.ambient_is_set = true;
  workload.scene.phong = {w.at("ks").get<float>(), w.at("shininess").get<float>()};
  workload.scene.background = glm::vec3(0.25F, 0.45F, 0.75F);

  const Json& camera = w.at("camera");
  const Result<Pose> pose =
      Pose::look_at(vector_of(camera.at("eye")), vector_of(camera.at("target")), vector_of(camera.at("up")));
  if (!pose) return tl::unexpected(pose.error());
  RenderSettings& settings = workload.settings;
  settings.width = all.at("width").get<int>();
  settings.height = all.at("height").get<int>();
  settings.shading = ShadingModel::phong;
  settings.anisotropy = 1;
  workload.view = {*pose,
                   Projection::perspective(Angle::degrees(camera.at("fovy_deg").get<double>()),
                                           static_cast<double>(settings.width) / settings.height,
                                           camera.at("near").get<double>(), camera.at("far").get<double>())};
  return workload;
}

// {"workload": "W2", "light": 0, "size": 4096}: one light of a workload, whose depth map alone is drawn.
Result<Workload> build_depth_map(const Json& all, const Json& entry, const std::filesystem::path& scenes) {
  const Json& of = all.at("workloads").at(entry.at("workload").get<std::string>());
  Result<Workload> workload = build(all, of, scenes);
  if (!workload) return workload;
  const auto number = entry.at("light").get<std::size_t>();
  if (number >= workload->scene.lights.size()) {
    return tl::unexpected(
        Error(Failure::bad_input, Diagnostic{{}, {}, fmt::format("there is no light {}", number)}));
  }
  Light& light = workload->scene.lights[number];
  light.shadow.resolution = entry.at("size").get<int>();
  workload->settings.width = workload->settings.height = light.shadow.resolution;
  workload->depth_light = light.name;
  return workload;
}

// "W4.1" → the second entry of the list "W4"; null where there is none.
const Json* find_in_list(const Json& all, const std::string& name) {
  for (const auto& [key, list] : all.items()) {
    if (!list.is_array()) continue;
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (name == fmt::format("{}.{}", key, i)) return &list[i];
    }
  }
  return nullptr;
}

std::vector<std::string> names_in(const Json& all) {
  std::vector<std::string> names;
  for (const auto& [key, value] : all.at("workloads").items()) names.push_back(key);
  for (const auto& [key, list] : all.items()) {
    for (std::size_t i = 0; list.is_array() && i < list.size(); ++i)
      names.push_back(fmt::format("{}.{}", key, i));
  }
  return names;
}

}  // namespace

Result<Workload> load_workload(const std::filesystem::path& file, const std::string& name,
                               const std::filesystem::path& scenes) {
  std::ifstream stream(file);
  if (!stream) return tl::unexpected(fault(file, {}, "cannot be opened"));
  const Json all = Json::parse(stream, nullptr, false);
  if (all.is_discarded()) return tl::unexpected(fault(file, {}, "is not JSON"));
  const std::filesystem::path beside = file.parent_path() / "scenes";
  try {
    const Json& workloads = all.at("workloads");
    const std::filesystem::path& models = scenes.empty() ? beside : scenes;
    if (workloads.contains(name)) return build(all, workloads.at(name), models);
    if (const Json* entry = find_in_list(all, name); entry != nullptr) {
      return build_depth_map(all, *entry, models);
    }
    return tl::unexpected(
        fault(file, "workloads",
              fmt::format("there is no \"{}\"; there are {}", name, fmt::join(names_in(all), ", "))));
  } catch (const Json::exception& e) {
    return tl::unexpected(fault(file, "workloads." + name, e.what()));
  }
}

std::vector<std::string> workload_names(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const Json all = Json::parse(stream, nullptr, false);
  const bool has_workloads = all.is_object() && all.contains("workloads") && all["workloads"].is_object();
  return has_workloads ? names_in(all) : std::vector<std::string>{};
}

}  // namespace laterna::app
