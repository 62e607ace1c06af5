// laterna info: what is in a scene.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <glm/common.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "laterna/lamps.h"
#include "outcome.h"
#include "scene_options.h"
#include "thrown_picture_report.h"

namespace laterna::app {
namespace {

using Json = nlohmann::json;

std::size_t triangles_of(const Primitive& p) {
  return (p.indices.empty() ? p.positions.size() : p.indices.size()) / 3;
}

struct Totals {
  std::size_t objects = 0, triangles = 0, vertices = 0;
  glm::dvec3 low{0}, high{0};
};

// Where a skin's joints carry a vertex, at rest; without a skin, where its node does.
glm::dvec3 place_vertex(const Scene& scene, const Node& node, const Primitive& primitive, std::size_t vertex,
                        const std::vector<glm::dmat4>& world, const glm::dmat4& world_from_object) {
  const glm::dvec4 position(primitive.positions[vertex], 1);
  if (node.skin < 0 || primitive.influences == 0) return world_from_object * position;
  const Skin& skin = scene.skins[static_cast<std::size_t>(node.skin)];
  const auto influences = static_cast<std::size_t>(primitive.influences);
  glm::dvec3 sum(0);
  for (std::size_t k = vertex * influences; k < (vertex + 1) * influences; ++k) {
    if (primitive.joint_weights[k] == 0) continue;
    const std::size_t joint = primitive.joints[k];
    const glm::dvec4 at =
        world[static_cast<std::size_t>(skin.joints[joint])] * (skin.joint_from_bind[joint] * position);
    sum += static_cast<double>(primitive.joint_weights[k]) * glm::dvec3(at);
  }
  return sum;
}

Totals count(const Scene& scene) {
  Totals totals;
  const std::vector<glm::dmat4> world = world_from_nodes(scene);
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    const Node& node = scene.nodes[n];
    if (node.mesh < 0) continue;
    const std::vector<glm::dmat4> once = {glm::dmat4(1.0)};
    for (const glm::dmat4& instance : node.node_from_instance.empty() ? once : node.node_from_instance) {
      const glm::dmat4 m = world[n] * instance;
      ++totals.objects;
      for (const Primitive& p : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
        totals.triangles += triangles_of(p);
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
          const glm::dvec3 w = place_vertex(scene, node, p, v, world, m);
          totals.low = totals.vertices == 0 ? w : glm::min(totals.low, w);
          totals.high = totals.vertices == 0 ? w : glm::max(totals.high, w);
          ++totals.vertices;
        }
      }
    }
  }
  return totals;
}

const char* type_name(LightType type) {
  switch (type) {
    case LightType::directional:
      return "directional";
    case LightType::point:
      return "point";
    case LightType::spot:
      return "spot";
    case LightType::projector:
      break;
  }
  return "projector";
}

Json vector_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json describe_light(const Light& light, const glm::dmat4& world) {
  Json j = {{"name", light.name},
            {"type", type_name(light.type)},
            {"position", vector_json(glm::dvec3(world[3]))},
            {light.type == LightType::directional ? "lux" : "candela", light.intensity},
            {"enabled", light.enabled}};
  if (light.lumens) j["lumens"] = *light.lumens;
  if (light.distribution != nullptr) {
    const LampSummary lamp = summarise(*light.distribution);
    const double scale = light.lumens ? *light.lumens / lamp.flux_lm : light.intensity;
    j["ies"] = light.distribution->name;
    j["candela"] = scale * lamp.peak_cd;
    j["lumens"] = scale * lamp.flux_lm;
  }
  return j;
}

Json describe_camera(const Camera& camera, const glm::dmat4& world) {
  Json j = {{"name", camera.name}, {"position", vector_json(glm::dvec3(world[3]))}};
  if (camera.projection.is_orthographic) {
    j["height"] = camera.projection.top - camera.projection.bottom;
  } else {
    j["yfov_deg"] = camera.projection.yfov().in_degrees();
  }
  return j;
}

// Its header, and the frame that it shows; null: it is dark.
Json describe_film(const Picture& picture, double time) {
  Json j = {{"name", picture.name}};
  const Result<FilmHeader> header = read_film_header(picture.file, picture.film->frames_per_second);
  if (!header) return j;
  j["format"] = header->format;
  j["size"] = {header->width, header->height};
  j["frames"] = header->frames;
  j["duration_s"] = header->duration;
  j["frame"] = nullptr;
  const Result<std::optional<std::size_t>> frame = find_film_frame(picture.file, *picture.film, time);
  if (frame && *frame) j["frame"] = **frame;
  return j;
}

Json describe_pictures(const Scene& scene, double time) {
  Json all = Json::array();
  for (const Picture& picture : scene.pictures) {
    if (picture.film) {
      all.push_back(describe_film(picture, time));
      continue;
    }
    Json j = {{"name", picture.name}};
    Result<ImageHeader> header = tl::unexpected(Error());
    if (!picture.encoded.empty()) {
      header = read_image_header(picture.encoded, picture.name);
    } else if (!picture.file.empty()) {
      header = read_image_header(picture.file);
    }
    if (header) {
      j["format"] = header->format;
      j["size"] = {header->width, header->height};
      j["channels"] = header->channels;
    }
    all.push_back(j);
  }
  return all;
}

Json describe_clips(const Scene& scene) {
  Json all = Json::array();
  for (const Clip& clip : scene.clips) {
    all.push_back({{"name", clip.name},
                   {"duration_s", duration(clip)},
                   {"channels", clip.channels.size()},
                   {"plays", clip.plays},
                   {"path", clip.is_path}});
  }
  return all;
}

// Null where nothing shines from all around.
Json describe_environment(const Scene& scene) {
  if (!scene.environment) return nullptr;
  const Environment& environment = *scene.environment;
  const bool is_filtered = environment.picture < 0;
  const int picture = is_filtered ? environment.specular_pictures.front().front() : environment.picture;
  constexpr const char* kDistances[] = {"infinite", "box", "sphere"};
  return {{"picture", scene.pictures[static_cast<std::size_t>(picture)].name},
          {"filtered_levels", environment.specular_pictures.size()},
          {"intensity", environment.intensity},
          {"visible", environment.visible},
          {"distance", kDistances[static_cast<std::size_t>(environment.distance)]}};
}

Json describe(const Scene& scene, double time) {
  const Totals totals = count(scene);
  const std::vector<glm::dmat4> world = world_from_nodes(scene);
  Json j = {{"objects", totals.objects},
            {"triangles", totals.triangles},
            {"vertices", totals.vertices},
            {"meshes", scene.meshes.size()},
            {"nodes", scene.nodes.size()},
            {"bounds", {vector_json(totals.low), vector_json(totals.high)}},
            {"ambient", {scene.ambient.r, scene.ambient.g, scene.ambient.b}},
            {"cameras", Json::array()},
            {"lights", Json::array()},
            {"materials", Json::array()},
            {"pictures", describe_pictures(scene, time)},
            {"environment", describe_environment(scene)},
            {"clips", describe_clips(scene)},
            {"skins", scene.skins.size()}};
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    const Node& node = scene.nodes[n];
    if (node.camera >= 0)
      j["cameras"].push_back(describe_camera(scene.cameras[static_cast<std::size_t>(node.camera)], world[n]));
    if (node.light >= 0)
      j["lights"].push_back(describe_light(scene.lights[static_cast<std::size_t>(node.light)], world[n]));
  }
  for (const Material& m : scene.materials) {
    const char* alpha = m.alpha_mode == AlphaMode::mask    ? "mask"
                        : m.alpha_mode == AlphaMode::blend ? "blend"
                                                           : "opaque";
    j["materials"].push_back(
        {{"name", m.name}, {"alpha", alpha}, {"double_sided", m.double_sided}, {"unlit", m.unlit}});
  }
  return j;
}

std::string triple(const Json& v) {
  return fmt::format("{:.3f} {:.3f} {:.3f}", v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

// Of a picture that is a film.
std::string film_text(const Json& picture) {
  if (!picture.contains("frames")) return {};
  const Json& frame = picture["frame"];
  return fmt::format(", {} frames, {:.3f} s, {}", picture["frames"].get<std::size_t>(),
                     picture["duration_s"].get<double>(),
                     frame.is_null() ? "dark now" : fmt::format("now frame {}", frame.get<std::size_t>()));
}

// Where the pictures of projectors that are on land, by the projectors' names. Only for them is the scene made ready.
using ThrownPictures = std::map<std::string, std::optional<ThrownPicture>>;

ThrownPictures find_thrown_pictures(Scene scene, const RendererOptions& options) {
  const auto throws = [](const Light& light) { return light.enabled && light.type == LightType::projector; };
  ThrownPictures all;
  if (std::ranges::none_of(scene.lights, throws)) return all;
  const Result<Renderer> renderer = Renderer::create(std::move(scene), options);
  if (!renderer) {
    report_warnings(renderer.error().diagnostics);
    return all;
  }
  for (const Light& light : renderer->scene().lights) {
    if (!throws(light)) continue;
    const auto thrown = find_thrown_picture(*renderer, light.name);
    if (thrown) all.emplace(light.name, *thrown);
  }
  return all;
}

void print_table(const Json& j, const ThrownPictures& thrown) {
  fmt::print("{:<12} {}\n{:<12} {}\n{:<12} {}\n", "objects", j["objects"].get<std::size_t>(), "triangles",
             j["triangles"].get<std::size_t>(), "vertices", j["vertices"].get<std::size_t>());
  fmt::print("{:<12} {} to {} m\n", "bounds", triple(j["bounds"][0]), triple(j["bounds"][1]));
  fmt::print("{:<12} {}\n", "materials", j["materials"].size());
  fmt::print("{:<12} {}\n", "pictures", j["pictures"].size());
  for (const Json& p : j["pictures"]) {
    const std::string size = p.contains("size")
                                 ? fmt::format("{} {}x{}", p["format"].get<std::string>(),
                                               p["size"][0].get<int>(), p["size"][1].get<int>())
                                 : "in memory";
    fmt::print("  {:<18} {}{}\n", size, p["name"].get<std::string>(), film_text(p));
  }
  if (const Json& e = j["environment"]; !e.is_null()) {
    const auto levels = e["filtered_levels"].get<std::size_t>();
    fmt::print(
        "{:<12} {}{}, times {:.3g}{}, {}\n", "environment", e["picture"].get<std::string>(),
        levels > 0 ? fmt::format(" and {} more, filtered for {} roughnesses", 6 * levels - 1, levels) : "",
        e["intensity"].get<double>(), e["visible"].get<bool>() ? "" : ", hidden",
        e["distance"] == "infinite" ? "infinitely far" : "on a " + e["distance"].get<std::string>());
  }
  fmt::print("{:<12} {}\n", "cameras", j["cameras"].size());
  for (const Json& c : j["cameras"]) {
    const std::string field = c.contains("yfov_deg")
                                  ? fmt::format("{:.1f}°", c["yfov_deg"].get<double>())
                                  : fmt::format("{:.3g} m high", c["height"].get<double>());
    fmt::print("  {:<18} at {}, {}\n", c["name"].get<std::string>(), triple(c["position"]), field);
  }
  fmt::print("{:<12} {}\n", "lights", j["lights"].size());
  for (const Json& l : j["lights"]) {
    const bool is_sun = l.contains("lux");
    const std::string strength = l.contains("lumens") ? fmt::format("{:.4g} lm", l["lumens"].get<double>())
                                 : is_sun             ? fmt::format("{:.4g} lx", l["lux"].get<double>())
                                                      : fmt::format("{:.4g} cd", l["candela"].get<double>());
    fmt::print("  {:<18} {:<12} at {}, {}{}\n", l["name"].get<std::string>(), l["type"].get<std::string>(),
               triple(l["position"]), strength, l["enabled"].get<bool>() ? "" : ", off");
    const auto found = thrown.find(l["name"].get<std::string>());
    if (found == thrown.end()) continue;
    fmt::print("  {:<18} {}\n", "",
               found->second ? text_of(*found->second) : "the middle of its picture meets nothing");
  }
  if (j["clips"].empty()) return;
  fmt::print("{:<12} {}\n", "clips", j["clips"].size());
  for (const Json& c : j["clips"]) {
    fmt::print("  {:<18} {:.3f} s, {} channels{}{}\n", c["name"].get<std::string>(),
               c["duration_s"].get<double>(), c["channels"].get<std::size_t>(),
               c["path"].get<bool>() ? ", a path" : "", c["plays"].get<bool>() ? ", plays" : "");
  }
}

}  // namespace

void declare_info(CLI::App& app, Run& run) {
  struct Options {
    SceneOptions scene;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("info", "tell what is in scenes: sizes, cameras, lights, pictures");
  options->scene.declare_scene(*command);
  command->add_flag("--json", options->json, "as JSON, with all there is");
  command->callback([options, &run] {
    run = [options] {
      Result<Scene> scene = options->scene.load();
      if (!scene) return report(scene.error());
      const Result<RendererOptions> machine = options->scene.renderer_options();
      if (!machine) return report(machine.error());
      Json j = describe(*scene, options->scene.time);
      const ThrownPictures thrown = find_thrown_pictures(std::move(*scene), *machine);
      for (Json& light : j["lights"]) {
        const auto found = thrown.find(light["name"].get<std::string>());
        if (found != thrown.end()) light["picture"] = found->second ? json_of(*found->second) : Json(nullptr);
      }
      if (options->json) {
        fmt::print("{}\n", j.dump(2));
      } else {
        print_table(j, thrown);
      }
      return static_cast<int>(kOk);
    };
  });
}

}  // namespace laterna::app
