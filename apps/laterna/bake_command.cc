// laterna bake: light into pictures.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "interruption.h"
#include "laterna/bake.h"
#include "laterna/write_scene.h"
#include "outcome.h"
#include "progress_line.h"
#include "quake_demonstration.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

struct Options {
  SceneOptions scene;
  BakeSettings bake;
  std::string output, quake, into = "light-maps";
  bool embeds = false, json = false;
  RadiositySettings radiosity{.bounces = 0};
  std::optional<double> stops;
  ImageBasedLightSettings environment;
};

std::string text_of(const BakeReport::Page& page) {
  return fmt::format("{} x {}{}", page.width, page.height, page.has_back ? " (two sides)" : "");
}

// "37 of 2048 x 2048, 512 x 300 (two sides), and 3 of other sizes": those of which there are most first.
std::string text_of(const std::vector<BakeReport::Page>& pages) {
  constexpr std::size_t kSizesTold = 4;
  std::vector<std::pair<std::string, std::size_t>> sizes;
  for (const BakeReport::Page& page : pages) {
    const std::string text = text_of(page);
    const auto known = std::ranges::find(sizes, text, &std::pair<std::string, std::size_t>::first);
    if (known == sizes.end()) {
      sizes.emplace_back(text, 1);
    } else {
      ++known->second;
    }
  }
  std::ranges::stable_sort(sizes, std::ranges::greater(), &std::pair<std::string, std::size_t>::second);
  std::string told;
  std::size_t others = pages.size();
  for (std::size_t i = 0; i < std::min(kSizesTold, sizes.size()); ++i) {
    const auto& [text, count] = sizes[i];
    told +=
        fmt::format("{}{}{}", told.empty() ? "" : ", ", count > 1 ? fmt::format("{} of ", count) : "", text);
    others -= count;
  }
  return others == 0 ? told : fmt::format("{}, and {} of other sizes", told, others);
}

void print_report(const BakeReport& r, const std::string& output) {
  std::string lights;
  for (const std::string& light : r.lights) lights += (lights.empty() ? "" : ", ") + light;
  const auto counted = [](std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  fmt::print("{}: {} in {} on {}{}{}\n", output, counted(r.surfaces, "surface"), counted(r.charts, "chart"),
             counted(r.pages.size(), "light map"), r.pages.empty() ? "" : ": ", text_of(r.pages));
  fmt::print("  lights:  {}\n", lights.empty() ? "none" : lights);
  fmt::print(
      "  luxels:  {}, {} of them on surfaces, {} continue these, {:.1f} % of the area is surface, {:.1f} MB "
      "in memory\n",
      r.luxels, r.lit_luxels, r.padding_luxels, 100 * r.used, static_cast<double>(r.bytes) / 1e6);
  if (r.greatest_density > 0)
    fmt::print("  density: {:.4g} to {:.4g} luxels per metre{}\n", r.least_density, r.greatest_density,
               r.thin_triangles == 0 ? "" : ", but for " + counted(r.thin_triangles, "thin triangle"));
  if (r.bounces > 0) fmt::print("  bounces: {}\n", r.bounces);
  if (r.exposure > 0) fmt::print("  shown:   radiance times {:.4g}, 1 is white\n", r.exposure);
  fmt::print("  time:    {:.2f} s laying out, {:.2f} s light", r.layout_ms / 1000, r.light_ms / 1000);
  if (r.resumed_parts > 0) fmt::print("; {} of {} parts were there already", r.resumed_parts, r.parts);
  fmt::print("\n");
}

nlohmann::ordered_json report_json(const BakeReport& r) {
  nlohmann::ordered_json json;
  json["lights"] = r.lights;
  json["pages"] = nlohmann::ordered_json::array();
  for (const BakeReport::Page& page : r.pages)
    json["pages"].push_back({{"width", page.width}, {"height", page.height}, {"has_back", page.has_back}});
  json["surfaces"] = r.surfaces;
  json["charts"] = r.charts;
  json["luxels"] = r.luxels;
  json["lit_luxels"] = r.lit_luxels;
  json["padding_luxels"] = r.padding_luxels;
  json["used"] = r.used;
  json["luxels_per_metre"] = {r.least_density, r.greatest_density};
  json["thin_triangles"] = r.thin_triangles;
  json["bounces"] = r.bounces;
  if (r.exposure > 0) json["exposure"] = r.exposure;
  json["bytes"] = r.bytes;
  json["parts"] = r.parts;
  json["resumed_parts"] = r.resumed_parts;
  json["layout_ms"] = r.layout_ms;
  json["light_ms"] = r.light_ms;
  return json;
}

const char* name_of(BakeStage stage) {
  switch (stage) {
    case BakeStage::layout:
      return "laying out";
    case BakeStage::direct_light:
      return "direct light";
    case BakeStage::reflected_light:
      break;
  }
  return "reflected light";
}

// What was finished stays: `laterna bake --resume` goes on with it.
Result<BakedScene> bake(Scene scene, BakeSettings settings) {
  BakeStage stage = BakeStage::layout;
  settings.stage_begins = [&stage](BakeStage begun) { stage = begun; };
  const Progress line = progress_line([&stage] { return fmt::format("baking: {}", name_of(stage)); });
  int signal = 0;
  Result<BakedScene> baked = [&] {
    const Interruption interruption(true);
    Result<BakedScene> made = bake_light(std::move(scene), settings, [&](double fraction) {
      if (line) line(fraction);
      return interruption.signal() == 0;
    });
    signal = interruption.signal();
    return made;
  }();
  if (signal == 0) return baked;
  if (!baked && baked.error().failure == Failure::cancelled)
    fmt::print(stderr, "{}laterna: stopped: {}\n", line ? "\r\033[K" : "",
               baked.error().diagnostics.front().message);
  end_by_signal(signal);
}

// What would be left aside without a word, or lost.
std::string find_fault(const CLI::App& command, const Options& options) {
  const bool into_emissive = options.bake.into == BakeInto::emissive;
  for (const std::string& file : options.scene.files) {
    std::error_code none;
    if (std::filesystem::equivalent(file, options.output, none))
      return fmt::format(
          "{} is the scene itself: write to another file, as what has been baked is not baked again", file);
  }
  if (options.stops && !into_emissive)
    return "--exposure belongs to --into emissive: light maps keep the light as it is";
  if (options.bake.keep_lights && into_emissive)
    return "--keep-lights belongs to light maps: what is baked --into emissive reflects no light";
  if (command.count("--bounce-rays") > 0 && options.radiosity.bounces == 0)
    return "--bounce-rays belongs to --bounces N: without it no light is reflected";
  if (command.count("--occlusion-distance") > 0 && options.bake.occlusion_rays == 0)
    return "--occlusion-distance belongs to --ambient-occlusion N";
  if (options.quake.empty()) return {};
  if (into_emissive) return "--quake shows light maps: leave --into emissive out";
  if (options.json) return "--quake tells what it found in words: leave --json out";
  return {};
}

int run_bake(const CLI::App& command, Options options) {
  options.bake.into = options.into == "emissive" ? BakeInto::emissive : BakeInto::light_maps;
  if (const Result<void> possible = check_scene_output(options.output); !possible)
    return report(possible.error());
  if (const std::string fault = find_fault(command, options); !fault.empty())
    return report(bad_option(fault));
  if (!options.quake.empty()) {
    if (const Result<void> possible = check_quake_output(options.quake); !possible)
      return report(possible.error());
  }
  Result<Scene> scene = options.scene.load();
  if (!scene) return report(scene.error());
  if (!scene->clips.empty()) {
    if (std::vector<Diagnostic> faults = validate(*scene); !faults.empty())
      return report(Error(Failure::bad_input, std::move(faults)));
    pose_scene(*scene, options.scene.time);
  }
  Result<RendererOptions> machine = options.scene.renderer_options();
  if (!machine) return report(machine.error());
  if (const Result<void> filtered = filter_environment(*scene, options.environment, *machine); !filtered)
    return report(filtered.error());
  options.bake.options = std::move(*machine);
  options.bake.options.time = options.scene.time;
  if (options.radiosity.bounces > 0) options.bake.interreflection = options.radiosity;
  options.bake.work_file = options.output;
  if (options.stops) options.bake.exposure = exposure_from_stops(*options.stops);
  Result<BakedScene> baked = bake(std::move(*scene), options.bake);
  if (!baked) return report(baked.error());
  report_warnings(baked->scene.warnings);
  const Result<std::vector<Diagnostic>> written =
      write_scene(baked->scene, options.output, SceneWriteOptions{.embeds = options.embeds});
  if (!written) return report(written.error());
  report_warnings(*written);
  remove_bake_parts(options.bake.work_file);
  if (options.json) {
    fmt::print("{}\n", report_json(baked->report).dump(2));
  } else {
    print_report(baked->report, options.output);
  }
  if (!options.quake.empty()) {
    if (const Result<void> shown = demonstrate_quake(baked->scene, options.quake); !shown)
      return report(shown.error());
  }
  return kOk;
}

}  // namespace

void declare_bake(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  BakeSettings& b = o.bake;
  CLI::App* command = app.add_subcommand("bake", "light and shadows into light maps, once and for all views");
  o.scene.declare_scene(*command);
  command->add_option("-o,--output", o.output, "the scene with its light to write: .glb or .gltf")
      ->required();
  command->add_option("--density", b.density, "luxels per metre")
      ->check(CLI::Range(kLeastLuxelDensity, kMostLuxelDensity))
      ->capture_default_str();
  command->add_option("--max-size", b.max_size, "largest side of a light map, in luxels")
      ->check(CLI::Range(kLeastLightMapSide, kMostLightMapSide))
      ->capture_default_str();
  command->add_option("--padding", b.padding, "luxels between neighbours in a light map")
      ->check(CLI::Range(1, kMostLuxelPadding))
      ->capture_default_str();
  command
      ->add_option("--samples", b.samples, "N: each luxel is the mean of N x N places in it; 1: its middle")
      ->check(CLI::Range(1, kMostLuxelSamples))
      ->capture_default_str();
  command
      ->add_option("--accumulate", b.light_samples,
                   "lamps that have a size: the mean over so many points of them")
      ->check(CLI::Range(1, kMaxAccumulated))
      ->capture_default_str();
  command
      ->add_option(
          "--bounces", o.radiosity.bounces,
          "how often light is reflected from surface to surface, by radiosity; 0: direct light alone")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--bounce-rays", o.radiosity.rays, "rays from each luxel that find what it is lit by")
      ->check(CLI::Range(16, 65536))
      ->capture_default_str();
  command
      ->add_option("--ambient-occlusion", b.occlusion_rays,
                   "rays from each luxel that find how much ambient light arrives; 0: none")
      ->check(CLI::Range(0, kMostOcclusionRays))
      ->capture_default_str();
  command->add_option("--occlusion-distance", b.occlusion_distance,
                      "metres: what is farther away hides no ambient light (default: everything does)");
  command
      ->add_option(
          "--into", o.into,
          "light-maps: for Laterna; emissive: light times colour into emissive textures, for every program "
          "that reads glTF")
      ->check(CLI::IsMember({"light-maps", "emissive"}))
      ->capture_default_str();
  command
      ->add_option("--exposure", o.stops,
                   "stops, with --into emissive, whose textures end at white (default: automatic)")
      ->check(CLI::Range(-40.0, 40.0));
  command->add_option("--lights", b.lights, "bake these lights only, by name; the others stay")
      ->delimiter(',');
  command->add_flag("--keep-lights", b.keep_lights,
                    "leave the baked lights in the file: with light maps, they shine twice");
  command->add_flag("--unwrap", b.unwrap_all,
                    "lay surfaces out anew even where their second texture coordinates serve");
  command->add_flag_callback(
      "--raw-seams", [&b] { b.join_seams = false; },
      "leave luxels at seams as they were lit: else both sides of a seam are made to read alike");
  command->add_flag("--resume", b.resume, "go on where a run of the same bake was stopped");
  command->add_flag("--embed", o.embeds, "a .gltf of one piece");
  command->add_option("--quake", o.quake,
                      "NAME.png: the first camera's view the way Quake showed it in 1996, with its factors "
                      "NAME.texture.png and "
                      "NAME.light.png, and how often a walk finds its surfaces in the cache");
  declare_written_environment(*command, o.environment);
  o.scene.declare_machine(*command);
  command->add_flag("--json", o.json, "what was done, as JSON, to standard output");
  command->footer(
      "\nEvery surface gets a place in a light map, a picture of floats that holds how much light falls on "
      "it (lux).\n"
      "Surfaces whose second texture coordinates serve keep these; others are cut into charts and laid out. "
      "The file\n"
      "is shown by `laterna render` from any view, as fast as a scene without lights and shadows; highlights "
      "are not\n"
      "kept. Other programs see its materials without the light (the extension LATERNA_light_map says where "
      "it "
      "is,\n"
      "docs/LATERNA_light_map.md), unless it is baked --into emissive; ambient occlusion is glTF's own. "
      "Lights that were baked are left "
      "out;\n"
      "the environment stays, and lights the scene beside the light maps.\n"
      "Shadows are found by rays, whatever the lights' techniques. A luxel of 6 cm (--density 16) shows "
      "shadows to\n"
      "about that.\n"
      "\nWhile it works, finished parts lie beside the output (room.glb.bake-0-3); after Ctrl-C, --resume "
      "takes them.\n"
      "\nExamples:\n"
      "  laterna bake room.glb --rig stage.json -o baked.glb\n"
      "  laterna bake room.glb --rig stage.json -o baked.glb --density 40 --samples 4\n"
      "  laterna bake room.glb --rig stage.json -o baked.glb --bounces 100\n"
      "  laterna bake room.glb -o baked.glb --ambient-occlusion 256 --occlusion-distance 1\n"
      "  laterna bake room.glb --rig stage.json -o anywhere.glb --into emissive --density 100\n"
      "  laterna render baked.glb -o picture.png\n");
  command->callback(
      [command, options, &run] { run = [command, options] { return run_bake(*command, *options); }; });
}

}  // namespace laterna::app
