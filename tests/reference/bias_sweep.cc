#include "reference/bias_sweep.h"

#include <cmath>

#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"

namespace laterna::reference {
namespace {

constexpr double kFloorHalf = 2;
constexpr int kResolution = 512;
// The map is fixed, so that texels are known: 6 m wide, 1 m of floor being 1/√2 m of map.
constexpr double kMapHalf = 3;
constexpr double kTexel = 2 * kMapHalf / kResolution;

Renderer sheet_on_floor(const ShadowSettings& settings) {
  Scene scene;
  add_object(scene, "floor", floor(static_cast<float>(kFloorHalf)));
  Mesher mesh;
  mesh.quad({0, 0, 1.5F}, {0, 0, -1.5F}, {0, 1, -1.5F}, {0, 1, 1.5F});
  add_object(scene, "sheet", mesh.primitive);
  Light light = sun("light");
  light.fit = false;
  light.projection = Projection::orthographic(kMapHalf, kMapHalf, 0, 20);
  light.shadow = settings;
  light.shadow.resolution = kResolution;
  add_light(scene, light, {-5, 5, 0}, {0, 0, 0});
  return make_renderer(std::move(scene));
}

}  // namespace

BiasEffect effect_of_bias(const ShadowSettings& settings) {
  const Renderer renderer = sheet_on_floor(settings);
  // From straight above: x to the right.
  const View above = {Pose::look_at({0, 5, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                      Projection::orthographic(kFloorHalf, kFloorHalf, 0, 10)};
  constexpr int kSide = 240;
  BiasEffect effect;
  effect.acne =
      find_shadow_errors(draw_shadow_masks(renderer, above, test_settings(kSide, kSide), "light", 1))
          .far_false_dark;
  RenderSettings seen = test_settings(kSide, kSide);
  seen.layers = {Layer::visibility};
  const LayeredImage image = render(renderer, above, seen);
  const std::span<const float> row = row_of(image, "visibility.light", kSide / 2);
  constexpr int kMiddle = kSide / 2;
  int pixel = kMiddle;  // behind the sheet
  while (pixel < kSide && row[static_cast<std::size_t>(pixel)] >= 0.5F) ++pixel;
  const double gap = (pixel - kMiddle) * 2 * kFloorHalf / kSide;
  effect.gap_texels = gap / std::sqrt(2.0) / kTexel;
  return effect;
}

double expected_gap_texels(double constant_bias) { return constant_bias / 2 / kTexel; }

}  // namespace laterna::reference
