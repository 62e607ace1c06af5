#include "technique_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "progress_line.h"
#include "technique_names.h"
#include "unserved_lights.h"

namespace laterna::app {
namespace {

// The scene with every light's technique left to the picture.
Result<Subject> without_own_techniques(const Subject& subject) {
  Scene scene = subject.renderer.scene();
  scene.warnings.clear();
  for (Light& light : scene.lights) light.shadow.technique.reset();
  Result<Renderer> renderer = Renderer::create(
      std::move(scene),
      {subject.renderer.threads(), subject.renderer.instruction_set(), subject.renderer.time()});
  if (!renderer) return tl::unexpected(std::move(renderer.error()));
  return Subject{std::move(*renderer), subject.view, subject.settings, {}};
}

double median_over(const std::vector<RenderStatistics>& frames,
                   const std::function<double(const RenderStatistics&)>& value_of) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const RenderStatistics& frame : frames) values.push_back(value_of(frame));
  return timing_of(std::move(values)).median;
}

Result<TechniqueResult> time_technique(Subject& subject, const FrameSeries& series,
                                       ShadowTechnique technique) {
  subject.settings.shadows = technique;
  subject.settings.keep_shadow_maps = false;
  const Result<FrameCosts> costs = draw_series(subject, series);
  if (!costs) return tl::unexpected(costs.error());
  TechniqueResult result;
  result.technique = technique;
  result.by_map = unserved_lights(subject.renderer.scene(), technique);
  result.frame_ms = costs->frame().median;
  const std::vector<RenderStatistics> frames = costs->drawings();
  result.shadow_ms = median_over(frames, shadow_cost_ms);
  result.map_ms = median_over(frames, [](const RenderStatistics& s) { return s.map_stages.total(); });
  for (const auto& light : costs->last().shadow_memory)
    result.mb += static_cast<double>(light.bytes) / (1U << 20U);
  return result;
}

void take_worst(const AccuracyReport& report, TechniqueResult& result) {
  for (const ShadowAccuracy& m : report.measured) {
    const bool has_map = std::ranges::find(result.by_map, m.light) != result.by_map.end();
    if (m.technique != (has_map ? ShadowTechnique::map : result.technique)) continue;
    const auto raise = [](double& worst, double value) { worst = std::max(worst, value); };
    raise(result.wrong_share, m.false_lit + m.false_dark);
    raise(result.acne, m.acne);
    raise(result.gap_texels, m.gap_texels);
    raise(result.edge_px_median, m.edge_px_median);
    raise(result.edge_px_mean, m.edge_px_mean);
    raise(result.edge_px_p99, m.edge_px_p99);
  }
}

// Why it can serve none of the scene's lights; empty where it can serve one.
std::string find_fault_of_all(const Scene& scene, ShadowTechnique technique) {
  std::string fault;
  for (const Light& light : scene.lights) {
    if (!light.enabled) continue;
    fault = find_fault(technique, light);
    if (fault.empty()) return fault;
  }
  return fault;
}

constexpr double kSmallEdgeError = 0.5;  // pixels
constexpr double kSmallGap = 2;          // texels, as large as defaults may leave one

bool has_no_artefacts(const TechniqueResult& r) { return r.acne == 0 && r.gap_texels < kSmallGap; }

template <class Suits>
std::optional<TechniqueResult> fastest_that(const std::vector<TechniqueResult>& results, Suits suits) {
  std::optional<TechniqueResult> fastest;
  for (const TechniqueResult& r : results) {
    if (r.technique == ShadowTechnique::none || !suits(r)) continue;
    if (!fastest || r.frame_ms < fastest->frame_ms) fastest = r;
  }
  return fastest;
}

std::string described(const TechniqueResult& r) {
  return fmt::format(
      "{} ({:.1f} ms a frame, {:.0f} MB; edges {:.2f} pixels off on average, {:.3g} % of pixels wrong)",
      name_of(r.technique), r.frame_ms, r.mb, r.edge_px_mean, 100 * r.wrong_share);
}

// What must be put up with.
std::string price_of(const TechniqueResult& r) {
  std::vector<std::string> faults;
  if (r.edge_px_mean >= kSmallEdgeError) faults.emplace_back("edges that are off");
  if (r.acne > 0) faults.emplace_back("acne");
  if (r.gap_texels >= kSmallGap)
    faults.push_back(fmt::format("gaps of {:.1f} texels at contacts", r.gap_texels));
  return fmt::format("at the price of {}", fmt::join(faults, ", "));
}

}  // namespace

std::string advise(const std::vector<TechniqueResult>& results) {
  const std::optional<TechniqueResult> good = fastest_that(results, [](const TechniqueResult& r) {
    return has_no_artefacts(r) && r.edge_px_mean < kSmallEdgeError;
  });
  const std::optional<TechniqueResult> right =
      fastest_that(results, [](const TechniqueResult& r) { return r.wrong_share == 0; });
  const std::optional<TechniqueResult> fast =
      fastest_that(results, [](const TechniqueResult&) { return true; });
  std::vector<std::string> parts;
  if (good) {
    parts.push_back(
        fmt::format("{} is the fastest of those with edges under half a pixel off, without acne and gaps",
                    described(*good)));
  }
  if (right && (!good || right->technique != good->technique)) {
    parts.push_back(fmt::format("{} is the fastest of those without a wrong pixel", described(*right)));
  } else if (right) {
    parts.emplace_back("it has no wrong pixel either");
  }
  if (fast && (!good || fast->technique != good->technique)) {
    parts.push_back(fmt::format("{} is faster, {}", described(*fast), price_of(*fast)));
  }
  if (parts.empty()) return "no technique was measured that draws shadows";
  return fmt::format("{}", fmt::join(parts, "; "));
}

Result<TechniqueComparison> compare_techniques(const Subject& subject, const FrameSeries& series,
                                               const std::vector<ShadowTechnique>& techniques) {
  Result<Subject> own = without_own_techniques(subject);
  if (!own) return tl::unexpected(std::move(own.error()));
  TechniqueComparison comparison;
  std::vector<ShadowTechnique> served;
  for (const ShadowTechnique technique : techniques) {
    if (std::string fault = find_fault_of_all(own->renderer.scene(), technique); !fault.empty()) {
      comparison.skipped.push_back({technique, std::move(fault)});
      continue;
    }
    const Result<TechniqueResult> timed = time_technique(*own, series, technique);
    if (timed) {
      comparison.results.push_back(*timed);
      served.push_back(technique);
    } else {
      comparison.skipped.push_back({technique, to_string(timed.error())});
    }
  }
  if (served.empty()) return comparison;
  AccuracySettings settings;
  settings.picture = subject.settings;
  settings.techniques = served;
  // For the lights that have it instead.
  if (std::ranges::find(served, ShadowTechnique::map) == served.end())
    settings.techniques.push_back(ShadowTechnique::map);
  settings.frames = 1;
  const Result<AccuracyReport> report =
      measure_accuracy(own->renderer, own->view, settings, progress_line("measuring"));
  if (!report) return tl::unexpected(report.error());
  for (TechniqueResult& result : comparison.results) take_worst(*report, result);
  comparison.advice = advise(comparison.results);
  return comparison;
}

}  // namespace laterna::app
