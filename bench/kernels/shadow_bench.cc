// Look-ups in a shadow map by filter: where all is lit, and along the edge of a ball's shadow.
#include "drawing.h"
#include "kernel_run.h"
#include "light/light_plan.h"
#include "render/depth_map_cache.h"
#include "shadow/shadow_map.h"

namespace laterna {
namespace {

std::shared_ptr<shadow::DepthMap> draw_map(const frame::Frame& frame, const light::ShadowView& view,
                                           InstructionSet set) {
  const TaskPool pool(1);
  render::BinsPool bins;
  StageTimes times;
  return std::make_shared<shadow::DepthMap>(
      render::draw_depth_map({frame, pool, bins, set, times}, view, CasterFaces::both, true));
}

enum class Where : std::uint8_t { lit, edge };

void look_up(benchmark::State& state, InstructionSet set, ShadowFilter filter, Where where) {
  const FloorSamples floor =
      where == Where::lit ? FloorSamples(256, 448, set, 1) : FloorSamples(224, 320, set, 1);
  const frame::Frame& frame = floor.drawing.frame();
  light::LightPlan plan = light::make_light_plan(frame, {});
  light::PlannedLight& planned = plan.lights[static_cast<std::size_t>(FloorLight::slide)];
  planned.settings.filter = filter;
  const std::vector maps = {draw_map(frame, planned.shadow_views[0], set)};
  const shadow::ShadowMap technique(planned, maps, frame, nullptr, floor.samples->ray, 1, set);
  const auto arrival = std::make_unique<shadow::Arrival>();
  const shadow::SampleArray<float>& alpha = arrival->alpha;
  measure(state, "pixels", shadow::kMaxSamples,
          [&] { technique.find_arrival(*floor.samples, floor.samples->active, *arrival); });
  const auto lit = static_cast<std::size_t>(std::count(alpha.begin(), alpha.end(), 1.0F));
  if ((lit == shadow::kMaxSamples) != (where == Where::lit)) state.SkipWithError("the shadow is elsewhere");
}

const bool kRegistered = [] {
  constexpr std::pair<const char*, ShadowFilter> kFilters[] = {
      {"nearest", ShadowFilter::nearest},
      {"bilinear", ShadowFilter::bilinear},
      {"percentage closer", ShadowFilter::percentage_closer},
      {"refined", ShadowFilter::refined}};
  for (const auto& [name, filter] : kFilters) {
    for (const Where where : {Where::lit, Where::edge}) {
      register_kernel(std::string("shadow look-up, ") + name + (where == Where::lit ? ", lit" : ", edge"),
                      [filter = filter, where](benchmark::State& state, InstructionSet set) {
                        look_up(state, set, filter, where);
                      });
    }
  }
  return true;
}();

}  // namespace
}  // namespace laterna
