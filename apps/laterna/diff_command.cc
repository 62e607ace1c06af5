// laterna diff: how two pictures differ, in idiff's words.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "laterna/image.h"
#include "outcome.h"
#include "scene_options.h"

namespace laterna::app {
namespace {

struct Options {
  std::string a, b, output;
  DifferenceLimits limits;
  std::optional<double> warn, warn_percent, hard_warn;
  double scale = 4;
  bool json = false;
};

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "PASS";
    case Verdict::warning:
      return "WARNING";
    case Verdict::failure:
      break;
  }
  return "FAILURE";
}

void print_difference(const Comparison& comparison) {
  const Difference& d = comparison.difference;
  fmt::print("  Mean error = {:.6g}\n  RMS error = {:.6g}\n  Peak SNR = {:.4g}\n", d.mean_error, d.rms_error,
             d.psnr_db);
  if (d.max_error > 0) {
    fmt::print("  Max error  = {:.6g} @ ({}, {}, {})  values are {:.6g} vs {:.6g}\n", d.max_error, d.max_x,
               d.max_y, d.max_channel, d.max_value_a, d.max_value_b);
  } else {
    fmt::print("  Max error  = 0\n");
  }
  const auto percent = [&](std::int64_t n) {
    return 100.0 * static_cast<double>(n) / static_cast<double>(d.pixels);
  };
  fmt::print("  {} pixels ({:.3g}%) over warn\n  {} pixels ({:.3g}%) over fail\n{}\n", d.pixels_over_warn,
             percent(d.pixels_over_warn), d.pixels_over_fail, percent(d.pixels_over_fail),
             word(comparison.verdict));
}

nlohmann::json difference_json(const Comparison& comparison) {
  const Difference& d = comparison.difference;
  return {{"verdict", word(comparison.verdict)},
          {"mean_error", d.mean_error},
          {"rms_error", d.rms_error},
          {"max_error", d.max_error},
          {"psnr_db", d.max_error > 0 ? nlohmann::json(d.psnr_db) : nlohmann::json()},
          {"max",
           {{"x", d.max_x},
            {"y", d.max_y},
            {"channel", d.max_channel},
            {"a", d.max_value_a},
            {"b", d.max_value_b}}},
          {"pixels", d.pixels},
          {"pixels_over_warn", d.pixels_over_warn},
          {"pixels_over_fail", d.pixels_over_fail}};
}

// What only warns is what fails, unless told otherwise.
DifferenceLimits limits_of(const Options& options) {
  DifferenceLimits l = options.limits;
  l.warn = options.warn.value_or(l.fail);
  l.warn_percent = options.warn_percent.value_or(l.fail_percent);
  l.hard_warn = options.hard_warn.value_or(l.hard_fail);
  return l;
}

int run_diff(const Options& options) {
  if (options.output == "-") return report(bad_option("diff prints to standard output: give -o a file"));
  const DifferenceLimits l = limits_of(options);
  for (const double limit :
       {l.fail, l.fail_percent, l.hard_fail, l.warn, l.warn_percent, l.hard_warn, options.scale}) {
    if (!(limit >= 0)) return report(bad_option("limits and --scale must be numbers of at least 0"));
  }
  const Result<LayeredImage> a = read_layered_image(options.a, ChannelValues::stored);
  if (!a) return report(a.error());
  const Result<LayeredImage> b = read_layered_image(options.b, ChannelValues::stored);
  if (!b) return report(b.error());
  const Result<Comparison> comparison = compare_images(*a, *b, l);
  if (!comparison) return report(comparison.error());
  if (options.json) {
    fmt::print("{}\n", difference_json(*comparison).dump(2));
  } else {
    fmt::print("Comparing \"{}\" and \"{}\"\n", options.a, options.b);
    print_difference(*comparison);
  }
  if (!options.output.empty()) {
    const Result<LayeredImage> picture = difference_picture(*a, *b, static_cast<float>(options.scale));
    if (!picture) return report(picture.error());
    if (Result<void> written = write_image(*picture, options.output); !written)
      return report(written.error());
  }
  return comparison->verdict == Verdict::failure ? kComparisonFailed : kOk;
}

}  // namespace

void declare_diff(CLI::App& app, Run& run) {
  auto options = std::make_shared<Options>();
  DifferenceLimits& l = options->limits;
  CLI::App* command = app.add_subcommand(
      "diff", "compare two pictures, channel by channel; exit code 1 when they differ too much");
  command->add_option("A", options->a, "picture")->required();
  command->add_option("B", options->b, "picture")->required();
  command->add_option("--fail", l.fail, "a pixel fails when a channel differs by more")
      ->capture_default_str();
  command->add_option("--failpercent", l.fail_percent, "percentage of pixels that may fail, 0 to 100")
      ->capture_default_str();
  command->add_option("--hardfail", l.hard_fail, "no pixel may differ by more")->capture_default_str();
  command->add_option("--warn", options->warn, "like --fail, for a warning; default: the same");
  command->add_option("--warnpercent", options->warn_percent,
                      "like --failpercent, for a warning; default: the same");
  command->add_option("--hardwarn", options->hard_warn, "like --hardfail, for a warning; default: the same");
  command->add_option("-o,--output", options->output, "write a picture of the difference");
  command->add_option("--scale", options->scale, "brightness of that picture")->capture_default_str();
  command->add_flag("--json", options->json, "as JSON");
  command->footer(
      "\nPNG and JPEG are compared as they are stored, as numbers from 0 to 1.\n"
      "\nExample:\n  laterna diff before.exr after.exr --fail 0.004 --failpercent 0.1\n");
  command->callback([options, &run] { run = [options] { return run_diff(*options); }; });
}

}  // namespace laterna::app
