// laterna inspect: one point in the five coordinate systems of Segal et al. 1992, and where a picture lands.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "laterna/measure.h"
#include "outcome.h"
#include "scene_options.h"
#include "thrown_picture_report.h"

namespace laterna::app {
namespace {

using Json = nlohmann::json;

struct Options {
  SceneOptions scene;
  ViewOptions view;
  std::string light, point, slide;
  double distance = 1;
  bool json = false;
};

Json matrix_json(const glm::dmat4& m) {
  Json rows = Json::array();
  for (int r = 0; r < 4; ++r) rows.push_back({m[0][r], m[1][r], m[2][r], m[3][r]});
  return rows;
}

Json plane_json(const glm::dvec4& plane) { return {plane.x, plane.y, plane.z, plane.w}; }

Json report_json(const PointReport& p) {
  Json slide;  // null: no projector, or the lens throws nothing there
  if (p.slide) slide = {p.slide->x, p.slide->y};
  return {{"world", {p.world.x, p.world.y, p.world.z}},
          {"clip", {p.clip.x, p.clip.y, p.clip.z, p.clip.w}},
          {"screen", {p.screen.x, p.screen.y}},
          {"pixel", {p.pixel.x, p.pixel.y}},
          {"light", {p.light.x, p.light.y, p.light.z, p.light.w}},
          {"texture", {p.texture.x, p.texture.y, p.texture.z}},
          {"slide", slide},
          {"distance", p.distance},
          {"is_ahead", p.is_ahead},
          {"is_inside", p.is_inside},
          {"clip_from_world", matrix_json(p.clip_from_world)},
          {"light_from_world", matrix_json(p.light_from_world)},
          {"texture_from_world", matrix_json(p.texture_from_world)},
          {"eye_linear_planes",
           {{"s", plane_json(p.eye_linear.s)},
            {"t", plane_json(p.eye_linear.t)},
            {"r", plane_json(p.eye_linear.r)},
            {"q", plane_json(p.eye_linear.q)}}}};
}

void print_report(const PointReport& p) {
  fmt::print("world    {:.9g} {:.9g} {:.9g}   m\n", p.world.x, p.world.y, p.world.z);
  fmt::print("clip     {:.9g} {:.9g} {:.9g} {:.9g}   M_c · world\n", p.clip.x, p.clip.y, p.clip.z, p.clip.w);
  fmt::print("screen   {:.9g} {:.9g}   clip x/w, y/w; pixel {:.3f} {:.3f}\n", p.screen.x, p.screen.y,
             p.pixel.x, p.pixel.y);
  fmt::print("light    {:.9g} {:.9g} {:.9g} {:.9g}   M_l · world\n", p.light.x, p.light.y, p.light.z,
             p.light.w);
  fmt::print("texture  {:.9g} {:.9g}, depth {:.9g}   from the top-left corner of the light's view\n",
             p.texture.x, p.texture.y, p.texture.z);
  if (p.slide) {
    fmt::print("slide    {:.9g} {:.9g}   from the top-left corner of the slide, through the lens\n",
               p.slide->x, p.slide->y);
  }
  fmt::print("{:.6g} m along the light's axis, {}\n", p.distance,
             !p.is_ahead   ? "behind the lens"
             : p.is_inside ? "inside its frame"
                           : "outside its frame");
}

// --point, or where --slide is thrown.
Result<glm::dvec3> find_point(const Options& options, const Renderer& renderer) {
  char rest = 0;
  if (options.slide.empty()) {
    glm::dvec3 point;
    if (std::sscanf(options.point.c_str(), "%lf,%lf,%lf%c", &point.x, &point.y, &point.z, &rest) == 3)
      return point;
    return tl::unexpected(
        bad_option(fmt::format("--point: expected x,y,z in metres, got \"{}\"", options.point)));
  }
  glm::dvec2 slide;
  if (std::sscanf(options.slide.c_str(), "%lf,%lf%c", &slide.x, &slide.y, &rest) != 2) {
    return tl::unexpected(bad_option(
        fmt::format("--slide: expected s,t from the slide's top-left corner, got \"{}\"", options.slide)));
  }
  return renderer.world_from_slide(options.light, slide, options.distance);
}

// Without a point: where the light's picture lands.
int tell_thrown_picture(const Options& options, const Renderer& renderer) {
  const Result<std::optional<ThrownPicture>> thrown = find_thrown_picture(renderer, options.light);
  if (!thrown) return report(thrown.error());
  if (options.json) {
    fmt::print("{}\n", *thrown ? json_of(**thrown).dump(2) : "null");
  } else {
    fmt::print("{}\n", *thrown ? text_of(**thrown) : "the middle of its picture meets nothing");
  }
  return kOk;
}

int run_inspect(const Options& options) {
  const Result<ViewOptions::Size> size = options.view.parse_size();
  if (!size) return report(size.error());
  const Result<Renderer> renderer = options.scene.make_renderer();
  if (!renderer) return report(renderer.error());
  if (options.point.empty() && options.slide.empty()) return tell_thrown_picture(options, *renderer);
  const Result<View> view = options.view.find(*renderer, *size);
  if (!view) return report(view.error());
  const Result<glm::dvec3> point = find_point(options, *renderer);
  if (!point) return report(point.error());
  const Result<PointReport> found =
      inspect_point(*renderer, *view, size->width, size->height, options.light, *point);
  if (!found) return report(found.error());
  if (options.json) {
    fmt::print("{}\n", report_json(*found).dump(2));
  } else {
    print_report(*found);
  }
  return kOk;
}

}  // namespace

void declare_inspect(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("inspect", "a point in world, clip, screen, light and texture coordinates");
  options->scene.declare_scene(*command);
  command->add_option("--light", options->light, "light by name")->required();
  CLI::Option_group* which =
      command->add_option_group("point", "one of; without either, where a projector's picture lands");
  which->add_option("--point", options->point, "x,y,z in metres");
  CLI::Option* slide =
      which->add_option("--slide", options->slide,
                        "s,t from a projector's slide's top-left corner, 0 to 1: where it is thrown");
  which->require_option(0, 1);
  command->add_option("--distance", options->distance, "with --slide: metres along the light's axis")
      ->needs(slide)
      ->capture_default_str();
  options->view.declare(*command);
  command->add_flag("--json", options->json,
                    "as JSON, with the matrices and the planes of eye-linear texture generation");
  command->footer(
      "\nExamples:\n  laterna inspect room.glb --rig stage.json --light lantern --point 0,1.2,-3\n"
      "  laterna inspect room.glb --rig stage.json --light lantern     # size of its picture, lux, pixels\n");
  command->callback([options, &run] { run = [options] { return run_inspect(*options); }; });
}

}  // namespace laterna::app
