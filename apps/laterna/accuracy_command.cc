// laterna accuracy: every shadow technique against ray-traced truth.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "accuracy_limits.h"
#include "outcome.h"
#include "progress_line.h"
#include "subject.h"
#include "technique_names.h"

namespace laterna::app {
namespace {

struct Options {
  SubjectOptions subject;
  std::string techniques = "all", lights, difference, fail;
  int resolution = 0, subpixels = 1, frames = 3;
  bool json = false, allows_unseen = false;
};

bool has_lights(const Scene& scene) {
  return std::any_of(scene.nodes.begin(), scene.nodes.end(), [](const Node& n) { return n.light >= 0; });
}

Result<Scene> place_lights(Scene scene, const Options& options) {
  if (options.lights == "auto") return with_standard_lights(std::move(scene));
  if (has_lights(scene)) return scene;
  fmt::print(stderr, "laterna: note: the scene has no light: it is measured with --lights auto\n");
  return with_standard_lights(std::move(scene));
}

using Json = nlohmann::ordered_json;

Json json_of(const AccuracyReport& report) {
  Json all = Json::array();
  for (const ShadowAccuracy& measured : report.measured) {
    Json entry = {{"technique", name_of(measured.technique)}, {"light", measured.light}};
    for (const AccuracyMeasure& measure : accuracy_measures())
      entry[std::string(measure.name)] = measured.*measure.value;
    entry["pixels"] = measured.pixels;
    entry["edge_pixels"] = measured.edge_pixels;
    all.push_back(std::move(entry));
  }
  return all;
}

void print_table(const AccuracyReport& report) {
  std::size_t width = 5;
  for (const ShadowAccuracy& m : report.measured) width = std::max(width, m.light.size());
  fmt::print("{:<11} {:<{}} {:>10} {:>10} {:>10} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "", "", width,
             "false lit", "false dark", "acne", "gap", "edge px", "edge px", "edge px", "", "");
  fmt::print("{:<11} {:<{}} {:>10} {:>10} {:>10} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "technique", "light",
             width, "%", "%", "%", "texels", "median", "mean", "99 %", "ms", "MB");
  for (const ShadowAccuracy& m : report.measured) {
    fmt::print(
        "{:<11} {:<{}} {:>10.4f} {:>10.4f} {:>10.4f} {:>9.2f} {:>8.2f} {:>8.3f} {:>8.2f} {:>8.2f} {:>8.2f}\n",
        name_of(m.technique), m.light, width, 100 * m.false_lit, 100 * m.false_dark, 100 * m.acne,
        m.gap_texels, m.edge_px_median, m.edge_px_mean, m.edge_px_p99, m.ms, m.mb);
  }
}

void print_notes(const AccuracyReport& report) {
  for (const ShadowAccuracy& m : report.measured) {
    if (m.pixels > 0 || m.technique != report.measured.front().technique) continue;
    fmt::print(stderr, "laterna: note: light \"{}\" falls on nothing that the picture shows\n", m.light);
  }
  for (const SkippedAccuracy& skipped : report.skipped) {
    fmt::print(stderr, "laterna: note: skipped technique \"{}\", light \"{}\": {}\n",
               name_of(skipped.technique), skipped.light, skipped.reason);
  }
}

Result<void> write_difference(const AccuracyReport& report, const std::string& file) {
  const Result<LayeredImage> picture = accuracy_picture(report);
  if (!picture) return tl::unexpected(picture.error());
  return write_image(*picture, file);
}

// A check that has looked at nothing must not pass for one that has found nothing wrong.
std::vector<std::string> find_unchecked(const AccuracyReport& report, const Options& options) {
  std::vector<std::string> faults;
  if (report.measured.empty())
    faults.emplace_back("nothing could be measured, so nothing is within its limits");
  for (const ShadowAccuracy& m : report.measured) {
    if (m.pixels > 0 || m.technique != report.measured.front().technique) continue;
    faults.push_back(
        fmt::format("light \"{}\" falls on nothing that the picture shows, so its shadows are not checked: "
                    "look from elsewhere "
                    "(--camera), leave it out (--lights), or give --allow-unseen",
                    m.light));
  }
  if (options.techniques == "all") return faults;
  for (const SkippedAccuracy& skipped : report.skipped) {
    const auto is_same = [&](const auto& other) { return other.technique == skipped.technique; };
    if (std::ranges::any_of(report.measured, is_same)) continue;
    if (&skipped != &*std::ranges::find_if(report.skipped, is_same)) continue;
    faults.push_back(fmt::format("technique \"{}\" could be measured with no light: {}",
                                 name_of(skipped.technique), skipped.reason));
  }
  return faults;
}

// Without shadows nothing can be right: `none` is held to limits only where it was asked for by name.
int check_limits(const AccuracyReport& report, const std::vector<AccuracyLimit>& limits,
                 const Options& options) {
  const bool is_none_meant = options.techniques != "all";
  int code = kOk;
  if (!limits.empty() && !options.allows_unseen) {
    for (const std::string& fault : find_unchecked(report, options)) {
      fmt::print(stderr, "laterna: error: --fail: {}\n", fault);
      code = kComparisonFailed;
    }
  }
  for (const ShadowAccuracy& measured : report.measured) {
    if (measured.technique == ShadowTechnique::none && !is_none_meant) continue;
    for (const AccuracyLimit& limit : limits) {
      if (!limit.is_broken_by(measured)) continue;
      fmt::print(stderr, "laterna: error: technique \"{}\", light \"{}\": {} is {:.6g}, which fails {}\n",
                 name_of(measured.technique), measured.light, limit.measure.name,
                 measured.*limit.measure.value, limit.text);
      code = kComparisonFailed;
    }
  }
  return code;
}

Result<AccuracySettings> read_settings(const Options& options, const RenderSettings& picture) {
  AccuracySettings settings;
  settings.picture = picture;
  const Result<std::vector<ShadowTechnique>> techniques = parse_techniques(options.techniques);
  if (!techniques) return tl::unexpected(techniques.error());
  settings.techniques = *techniques;
  if (options.lights != "auto") settings.lights = split_list(options.lights);
  if (settings.lights.empty() && options.lights != "auto" && !options.lights.empty())
    return tl::unexpected(bad_option(fmt::format("--lights: \"{}\" names no light", options.lights)));
  settings.resolution = options.resolution;
  settings.subpixels = options.subpixels;
  settings.frames = options.frames;
  settings.keep_verdicts = !options.difference.empty();
  return settings;
}

// What can be said before a scene is read.
Result<std::vector<AccuracyLimit>> check_options(const Options& options) {
  if (const std::string fault = options.subject.find_fault("accuracy"); !fault.empty())
    return tl::unexpected(bad_option(fault));
  if (const Result<AccuracySettings> settings = read_settings(options, {}); !settings)
    return tl::unexpected(settings.error());
  if (options.difference == "-") {
    return tl::unexpected(bad_option("accuracy prints to standard output: give --difference a file"));
  }
  if (!options.difference.empty()) {
    if (Result<void> writable = check_image_output(options.difference); !writable)
      return tl::unexpected(writable.error());
  }
  return parse_limits(options.fail);
}

int run_accuracy(const Options& options) {
  const Result<std::vector<AccuracyLimit>> limits = check_options(options);
  if (!limits) return report(limits.error());
  const Result<Subject> subject =
      options.subject.prepare([&](Scene scene) { return place_lights(std::move(scene), options); });
  if (!subject) return report(subject.error());
  const Result<AccuracySettings> settings = read_settings(options, subject->settings);
  if (!settings) return report(settings.error());
  const Result<AccuracyReport> measured =
      measure_accuracy(subject->renderer, subject->view, *settings, progress_line("measuring"));
  if (!measured) return report(measured.error());
  if (options.json) {
    fmt::print("{}\n", json_of(*measured).dump(2));
  } else {
    print_table(*measured);
  }
  print_notes(*measured);
  if (!options.difference.empty() && !measured->measured.empty()) {
    if (Result<void> written = write_difference(*measured, options.difference); !written)
      return report(written.error());
  }
  return check_limits(*measured, *limits, options);
}

constexpr const char* kFooter =
    "\nShares are of the pixels that face the light within its cone, frame and range; texels are those of "
    "the\n"
    "light's shadow map, for every technique. The truth is the technique raytraced.\n"
    "  acne     false shadow farther than 2 texels from any true edge; a part of false dark\n"
    "  gap      the longest stretch of false light that begins where caster and receiver touch\n"
    "  edge px  from each edge of shadow, or of true shadow, to the nearest of the other, in pixels, 32 at "
    "most\n"
    "  ms, MB   what the shadows of this light alone cost in a frame, maps drawn anew\n"
    "The difference picture has a block for each light, in it a picture for each technique under its name: "
    "the\n"
    "scene in grey, true shadows darker, what does not count darkest; false light yellow, false shadow "
    "blue,\n"
    "acne red.\n"
    "--fail takes conditions on the measures of --json, where shares are fractions (0.01 is 1 %); the exit "
    "code is 1 where one of them is met, by any\n"
    "technique but none, unless that is asked for by name. It is 1 too where a light falls on nothing that "
    "the\n"
    "picture shows, or a technique asked for by name serves no light: nothing was checked. --allow-unseen "
    "lets\n"
    "that pass.\n"
    "\nExamples:\n"
    "  laterna accuracy scene.glb --lights auto --techniques all --difference wrong.png\n"
    "  laterna accuracy scene.glb --rig stage.json --techniques map --fail \"false_lit>0.01,acne>0\"\n";

}  // namespace

void declare_accuracy(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("accuracy", "how right each technique's shadows are, against rays");
  options->subject.declare(*command);
  command->add_option("--techniques", options->techniques, "all, or names with commas between")
      ->capture_default_str();
  command->add_option(
      "--lights", options->lights,
      "names with commas between; auto: a sun, a spot and a point light by a fixed rule instead "
      "of the scene's own; default: the scene's own, or auto where it has none");
  command->add_option("--resolution", options->resolution, "of shadow maps; default: each light's own");
  command
      ->add_option("--subpixels", options->subpixels,
                   "1 to 8: compare on a grid so many times finer than the picture")
      ->capture_default_str();
  command->add_option("--frames", options->frames, "frames of which ms is the median")->capture_default_str();
  command->add_option("--difference", options->difference, "picture of what is wrong and where");
  command->add_option("--fail", options->fail, "conditions that must not be met, such as \"acne>0\"");
  command->add_flag("--allow-unseen", options->allows_unseen,
                    "--fail lets pass what cannot be measured: a light that no pixel sees, a technique that "
                    "serves no light");
  options->subject.scene.declare_machine(*command);
  command->add_flag("--json", options->json, "as JSON");
  command->footer(kFooter);
  command->callback([options, &run] { run = [options] { return run_accuracy(*options); }; });
}

}  // namespace laterna::app
