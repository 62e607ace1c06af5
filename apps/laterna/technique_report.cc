#include "technique_report.h"

#include <fmt/format.h>

#include "technique_names.h"

namespace laterna::app {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ProjectionCost::Rate& rate) {
  return {{"ms", rate.ms}, {"mtri_per_s", rate.mtri_per_s}, {"mpix_per_s", rate.mpix_per_s}};
}

}  // namespace

Json json_of(const TechniqueComparison& comparison, const ProjectionCost& projection) {
  Json techniques = Json::array();
  for (const TechniqueResult& r : comparison.results) {
    techniques.push_back({{"technique", name_of(r.technique)},
                          {"frame_ms", r.frame_ms},
                          {"shadow_ms", r.shadow_ms},
                          {"map_ms", r.map_ms},
                          {"mb", r.mb},
                          {"edge_px_median", r.edge_px_median},
                          {"edge_px_mean", r.edge_px_mean},
                          {"edge_px_p99", r.edge_px_p99},
                          {"wrong", r.wrong_share},
                          {"acne", r.acne},
                          {"gap_texels", r.gap_texels},
                          {"lights_by_map", r.by_map}});
  }
  Json skipped = Json::array();
  for (const auto& s : comparison.skipped)
    skipped.push_back({{"technique", name_of(s.technique)}, {"reason", s.reason}});
  return {{"techniques", techniques},
          {"skipped", skipped},
          {"advice", comparison.advice},
          {"textured", json_of(projection.textured)},
          {"projected", json_of(projection.projected)},
          {"projected_over_textured", projection.ratio()}};
}

void print_table(const TechniqueComparison& comparison, const ProjectionCost& projection) {
  fmt::print("{:<11} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9} {:>7}\n", "", "frame", "shadows",
             "maps", "", "edge px", "edge px", "edge px", "wrong", "acne", "gap");
  fmt::print("{:<11} {:>9} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>9} {:>9} {:>7}\n", "technique", "ms", "ms",
             "ms", "MB", "median", "mean", "99 %", "%", "%", "texels");
  for (const TechniqueResult& r : comparison.results) {
    fmt::print(
        "{:<11} {:>9.2f} {:>9.2f} {:>9.2f} {:>8.2f} {:>8.2f} {:>8.3f} {:>8.2f} {:>9.4f} {:>9.4f} {:>7.2f}\n",
        name_of(r.technique), r.frame_ms, r.shadow_ms, r.map_ms, r.mb, r.edge_px_median, r.edge_px_mean,
        r.edge_px_p99, 100 * r.wrong_share, 100 * r.acne, r.gap_texels);
  }
  for (const TechniqueResult& r : comparison.results) {
    for (const std::string& light : r.by_map)
      fmt::print("{}: light \"{}\" has map instead, whose errors count\n", name_of(r.technique), light);
  }
  for (const auto& s : comparison.skipped) fmt::print("{:<11} skipped: {}\n", name_of(s.technique), s.reason);
  fmt::print(
      "Frame by the clock; shadows and maps all threads together, maps being a part of shadows. Errors: of "
      "the "
      "light for which they are largest.\n");
  fmt::print("advice: {}\n\n", comparison.advice);
  fmt::print("{:<11} {:>9} {:>9} {:>9}\n", "", "ms", "Mtri/s", "Mpix/s");
  const auto line = [](const char* name, const ProjectionCost::Rate& rate) {
    fmt::print("{:<11} {:>9.2f} {:>9.2f} {:>9.1f}\n", name, rate.ms, rate.mtri_per_s, rate.mpix_per_s);
  };
  line("textured", projection.textured);
  line("projected", projection.projected);
  fmt::print(
      "The same surfaces with one texture, or under one slide without shadows: projecting takes {:.2f} times "
      "as "
      "long.\n",
      projection.ratio());
}

}  // namespace laterna::app
