#include "silhouette_culling.h"

#include <fmt/format.h>

#include <algorithm>

#include "laterna/accuracy.h"

namespace laterna::app {
namespace {

using Json = nlohmann::json;

// Whether all lights are as asked for already.
bool have_culling(const Scene& scene, bool culls) {
  return std::all_of(scene.lights.begin(), scene.lights.end(),
                     [&](const Light& light) { return light.shadow.culls_occluders == culls; });
}

Result<FrameCosts> draw_with_culling(Subject& subject, const FrameSeries& series, const FrameCosts& as_it_was,
                                     bool was_as_asked, bool culls) {
  if (was_as_asked) return as_it_was;
  for (std::size_t i = 0; i < subject.renderer.scene().lights.size(); ++i) {
    Light light = subject.renderer.scene().lights[i];
    light.shadow.culls_occluders = culls;
    if (Result<void> set = subject.renderer.set_light(static_cast<int>(i), std::move(light)); !set)
      return tl::unexpected(set.error());
  }
  return draw_series(subject, series);
}

Timing shadow_timing(const FrameCosts& costs) {
  std::vector<double> values;
  for (const RenderStatistics& frame : costs.drawings()) values.push_back(shadow_cost_ms(frame));
  return timing_of(std::move(values));
}

Json json_of(const FrameCosts& costs) {
  Json lights = Json::array();
  for (const auto& work : costs.last().silhouettes) {
    lights.push_back({{"light", work.light},
                      {"objects", work.objects},
                      {"pairs", work.pairs},
                      {"silhouettes", work.silhouettes},
                      {"silhouettes_drawn", work.silhouettes_drawn}});
  }
  return {{"frame_ms", costs.frame().median}, {"shadow_ms", shadow_timing(costs).median}, {"lights", lights}};
}

void print_lines(const char* name, const FrameCosts& costs) {
  for (const auto& work : costs.last().silhouettes) {
    fmt::print("{:<12} {:>8} {:>9} {:>12} {:>6}   {}\n", name, work.objects, work.pairs, work.silhouettes,
               work.silhouettes_drawn, work.light);
  }
}

}  // namespace

Result<std::optional<CullingComparison>> compare_culling(Subject& subject, const FrameSeries& series,
                                                         const FrameCosts& costs) {
  if (costs.last().silhouettes.empty()) return std::nullopt;
  const bool was_culled = have_culling(subject.renderer.scene(), true);
  const bool was_unculled = have_culling(subject.renderer.scene(), false);
  Result<FrameCosts> culled = draw_with_culling(subject, series, costs, was_culled, true);
  if (!culled) return tl::unexpected(std::move(culled.error()));
  Result<FrameCosts> unculled = draw_with_culling(subject, series, costs, was_unculled, false);
  if (!unculled) return tl::unexpected(std::move(unculled.error()));
  return CullingComparison{std::move(*culled), std::move(*unculled)};
}

Json json_of(const CullingComparison& comparison) {
  return {{"culled", json_of(comparison.culled)}, {"unculled", json_of(comparison.unculled)}};
}

void print_table(const CullingComparison& comparison) {
  fmt::print("\n{:<12} {:>8} {:>9} {:>12} {:>6}   light\n", "silhouettes", "objects", "pairs", "silhouettes",
             "drawn");
  print_lines("culled", comparison.culled);
  print_lines("unculled", comparison.unculled);
  const auto frame = [](const FrameCosts& costs) { return costs.frame().median; };
  const auto shadows = [](const FrameCosts& costs) { return shadow_timing(costs).median; };
  fmt::print(
      "frame {:.2f} ms culled, {:.2f} ms unculled; shadows, all threads together: {:.2f} and {:.2f} ms\n",
      frame(comparison.culled), frame(comparison.unculled), shadows(comparison.culled),
      shadows(comparison.unculled));
}

}  // namespace laterna::app
