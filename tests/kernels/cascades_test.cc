// Look-ups into cascades on every instruction set: which map answers, how the maps are blended, and that α stays where
// it is while the camera moves.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "light/cascades.h"
#include "reference/shapes.h"
#include "render/depth_map_cache.h"
#include "shadow/shadow_map.h"

namespace laterna::shadow {
namespace {

using Maps = std::vector<std::shared_ptr<DepthMap>>;

constexpr float kFloor = 40;

// Boxes strewn over a floor, in the sun.
reference::OwnedFrame town(const ShadowSettings& settings) {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(kFloor));
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-0.9F * kFloor, 0.9F * kFloor), size(0.2F, 1.5F);
  for (int i = 0; i < 60; ++i) {
    const glm::vec3 half(size(random), size(random), size(random));
    reference::add_object(scene, "box" + std::to_string(i),
                          reference::box({place(random), half.y, place(random)}, half));
  }
  Light light;
  light.name = "sun";
  light.type = LightType::directional;
  light.shadow = settings;
  light.shadow.technique = laterna::ShadowTechnique::cascades;
  reference::add_light(scene, light, {3, 5, 2}, {0, 0, 0});
  return reference::make_frame(std::move(scene));
}

View eye(const glm::dvec3& position, const glm::dvec3& target) {
  return reference::look(position, target, 50, 1.25, {0, 1, 0}, 0.1, 1000);
}

light::LightPlan plan_for(const frame::Frame& frame, const View& camera) {
  return light::make_light_plan(frame, {laterna::ShadowTechnique::map, {}, &camera});
}

Maps draw_maps(const light::PlannedLight& planned, const frame::Frame& frame, InstructionSet set) {
  const TaskPool pool(1);
  render::BinsPool bins;
  StageTimes times;
  Maps maps;
  for (const light::ShadowView& view : planned.shadow_views) {
    maps.push_back(std::make_shared<DepthMap>(
        render::draw_depth_map({frame, pool, bins, set, times}, view, CasterFaces::both, true)));
  }
  return maps;
}

// Points of the floor, as one view sees them whichever camera the maps were made for.
struct FloorSamples {
  raster::RasterView view;
  std::unique_ptr<SurfaceSamples> samples = std::make_unique<SurfaceSamples>();
};

FloorSamples floor_samples(const View& camera, const std::vector<glm::dvec2>& places) {
  FloorSamples made = {raster::RasterView(camera, 500, 400)};
  SurfaceSamples& s = *made.samples;
  s.ray = made.view.homogeneous_ray();
  s.group_count = kMaxGroups;
  s.active.fill(0xFFFF);
  s.position_error = 1e-5F;
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    const glm::dvec2 place = places[i % places.size()];
    const glm::dvec3 from_eye = glm::dvec3(place.x, 0, place.y) - made.view.eye_ws;
    const double w = glm::dot(made.view.w_row, from_eye);
    s.x[i] = static_cast<float>(glm::dot(made.view.x_row, from_eye) / w);
    s.y[i] = static_cast<float>(glm::dot(made.view.y_row, from_eye) / w);
    s.q[i] = static_cast<float>(1 / w);
    s.x_ws[i] = static_cast<float>(place.x), s.y_ws[i] = 0, s.z_ws[i] = static_cast<float>(place.y);
    s.normal_x_ws[i] = 0, s.normal_y_ws[i] = 1, s.normal_z_ws[i] = 0;
    s.dq_dx[i] = s.dq_dy[i] = 0;
    s.id[i] = 0;
  }
  return made;
}

std::vector<glm::dvec2> random_places(const glm::dvec2& middle, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-reach, reach);
  std::vector<glm::dvec2> places;
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    const double x = middle.x + unit(random);
    places.emplace_back(x, middle.y + unit(random));
  }
  return places;
}

std::vector<float> look_up(const light::PlannedLight& planned, const Maps& maps, const frame::Frame& frame,
                           const FloorSamples& floor, InstructionSet set) {
  const ShadowMap shadow(planned, maps, frame, nullptr, floor.view.homogeneous_ray(), 4, set);
  const std::vector<std::uint16_t> wanted(kMaxGroups, 0xFFFF);
  auto arrival = std::make_unique<Arrival>();
  shadow.find_arrival(*floor.samples, wanted, *arrival);
  return {arrival->alpha.begin(), arrival->alpha.end()};
}

// The share of a cascade's answer, from its view alone.
double weight_at(const light::ShadowView& shadow, const glm::dvec2& place, int kernel) {
  const glm::dvec4 st = shadow.view.image_from_world() * glm::dvec4(place.x, 0, place.y, 1);
  const double x = st.x * shadow.width, y = st.y * shadow.height;
  const double inside = std::min(std::min(x, shadow.width - x), std::min(y, shadow.height - y));
  const double band = std::max(4.0, std::max(shadow.width, shadow.height) / 16.0);
  return std::clamp((inside - (2 + static_cast<double>(kernel / 2))) / band, 0.0, 1.0);
}

std::vector<ShadowSettings> each_filter() {
  std::vector<ShadowSettings> all;
  for (const ShadowFilter filter :
       {ShadowFilter::refined, ShadowFilter::bilinear, ShadowFilter::percentage_closer}) {
    ShadowSettings settings;
    settings.filter = filter;
    settings.resolution = 256;
    all.push_back(settings);
  }
  return all;
}

class CascadesOnEverySet : public testing::TestWithParam<InstructionSet> {};

// Each cascade asked by itself, as if it were the light's only map, and the answers mixed by plain arithmetic.
TEST_P(CascadesOnEverySet, TheFinestAnswersAndTheNextIsBlendedInAtItsRim) {
  const View camera = eye({0, 2, 20}, {0, 0, 5});
  for (const ShadowSettings& settings : each_filter()) {
    const reference::OwnedFrame owned = town(settings);
    const light::LightPlan plan = plan_for(owned.frame, camera);
    const light::PlannedLight& planned = plan.lights.at(0);
    ASSERT_GE(planned.shadow_views.size(), 3U);
    const Maps maps = draw_maps(planned, owned.frame, GetParam());
    int blended = 0, differing = 0;
    std::vector<int> answered(maps.size());
    for (unsigned seed = 0; seed < 8; ++seed) {
      const std::vector<glm::dvec2> places = random_places({0, 8}, 1.5 + 3 * seed, seed);
      const FloorSamples floor = floor_samples(camera, places);
      const std::vector<float> got = look_up(planned, maps, owned.frame, floor, GetParam());
      ASSERT_EQ(got, look_up(planned, draw_maps(planned, owned.frame, InstructionSet::scalar), owned.frame,
                             floor, InstructionSet::scalar));
      std::vector<std::vector<float>> alone;
      for (std::size_t k = 0; k < maps.size(); ++k) {
        light::PlannedLight one = planned;
        one.shadow_views = {planned.shadow_views[k]};
        alone.push_back(look_up(one, {maps[k]}, owned.frame, floor, GetParam()));
      }
      for (std::size_t i = 0; i < places.size(); ++i) {
        double expected = alone.back()[i];
        for (std::size_t k = maps.size() - 1; k-- > 0;) {
          const double weight = weight_at(planned.shadow_views[k], places[i], settings.kernel);
          expected += (alone[k][i] - expected) * weight;
          blended += weight > 0 && weight < 1 ? 1 : 0;
          answered[k] += weight == 1 ? 1 : 0;
        }
        ASSERT_NEAR(got[i], expected, 2e-4) << places[i].x << ", " << places[i].y;
        differing += alone.front()[i] != alone.back()[i] ? 1 : 0;
      }
    }
    EXPECT_GT(blended, 50);
    EXPECT_GT(differing, 10) << "all cascades give the same: nothing is shown";
    for (std::size_t k = 0; k + 1 < maps.size(); ++k) EXPECT_GT(answered[k], 20) << k;
  }
}

// Texels lie on a raster fixed to the light, and do not change their size: what the camera does cannot make shadows
// crawl.
TEST_P(CascadesOnEverySet, AlphaStaysWhereItIsWhileTheCameraMoves) {
  const glm::dvec3 position(0, 2, 20), target(0, 0, 5);
  for (const ShadowSettings& settings : each_filter()) {
    const reference::OwnedFrame owned = town(settings);
    const View before = eye(position, target);
    const light::LightPlan plan_before = plan_for(owned.frame, before);
    const Maps maps_before = draw_maps(plan_before.lights[0], owned.frame, GetParam());
    std::mt19937 random(11);
    std::uniform_real_distribution<double> step(-0.4, 0.4);
    int compared = 0, partly = 0;
    for (int move = 0; move < 4; ++move) {
      const glm::dvec3 by(step(random), 0.3 * step(random), step(random));
      const glm::dvec3 turn(step(random), step(random), step(random));
      const View after = eye(position + by, target + by + turn);
      const light::LightPlan plan_after = plan_for(owned.frame, after);
      ASSERT_EQ(plan_before.lights[0].shadow_views.size(), plan_after.lights[0].shadow_views.size());
      const Maps maps_after = draw_maps(plan_after.lights[0], owned.frame, GetParam());
      for (unsigned seed = 0; seed < 6; ++seed) {
        const std::vector<glm::dvec2> places = random_places({0, 8}, 2 + 3 * seed, seed);
        const FloorSamples floor = floor_samples(before, places);
        const auto was = look_up(plan_before.lights[0], maps_before, owned.frame, floor, GetParam());
        const auto is = look_up(plan_after.lights[0], maps_after, owned.frame, floor, GetParam());
        const auto cascade_of = [&](const light::PlannedLight& planned, const glm::dvec2& place) {
          for (std::size_t k = 0; k < planned.shadow_views.size(); ++k) {
            const double weight = weight_at(planned.shadow_views[k], place, settings.kernel);
            if (weight == 1) return static_cast<int>(k);
            if (weight > 0) return -1;
          }
          return -1;
        };
        for (std::size_t i = 0; i < places.size(); ++i) {
          const int cascade = cascade_of(plan_before.lights[0], places[i]);
          if (cascade < 0 || cascade != cascade_of(plan_after.lights[0], places[i])) continue;
          // A bilinear weight of a texel's fraction is rounded where the texel's number is another.
          ASSERT_NEAR(was[i], is[i], settings.filter == ShadowFilter::bilinear ? 1e-4 : 0)
              << "cascade " << cascade << " at " << places[i].x << ", " << places[i].y;
          ++compared;
          partly += was[i] > 0 && was[i] < 1 ? 1 : 0;
        }
      }
    }
    EXPECT_GT(compared, 2000);
    EXPECT_TRUE(settings.filter == ShadowFilter::refined || partly > 50) << partly;
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, CascadesOnEverySet, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::shadow
