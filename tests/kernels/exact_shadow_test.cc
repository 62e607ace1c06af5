// Exact shadows on every instruction set, against a judge that asks every triangle in extended precision.
#include "shadow/exact_shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "reference/shadow_judge.h"
#include "reference/shapes.h"

namespace laterna::shadow {
namespace {

using reference::Judgement;

// ---------------------------------------------------------------------------------------------- samples

constexpr float kPixel = 1e-3F;  // metres, whatever the distance

std::unique_ptr<SurfaceSamples> no_samples() {
  auto s = std::make_unique<SurfaceSamples>();
  // The homogeneous point's fourth coordinate is 1, and a step of a pixel is kPixel to the side.
  s->ray = {{0, 0, 0, 1}, {kPixel, 0, 0, 0}, {0, kPixel, 0, 0}, {0, 0, 0, 0}};
  s->group_count = kMaxGroups;
  s->active.fill(0xFFFF);
  s->position_error = 1e-6F;
  for (SampleArray<float>* values : {&s->x, &s->y, &s->q, &s->dq_dx, &s->dq_dy, &s->x_ws, &s->y_ws, &s->z_ws})
    values->fill(0);
  s->id.fill(kNoTriangle);
  return s;
}
constexpr double kNearest = 2 * 1e-6 + 2 * kPixel / 256.0;

void put(SurfaceSamples& s, std::size_t i, const glm::dvec3& p, TriangleId own) {
  s.x_ws[i] = static_cast<float>(p.x), s.y_ws[i] = static_cast<float>(p.y),
  s.z_ws[i] = static_cast<float>(p.z);
  s.id[i] = own;
}

glm::dvec3 position(const SurfaceSamples& s, std::size_t i) { return {s.x_ws[i], s.y_ws[i], s.z_ws[i]}; }

glm::dvec3 corner(const frame::Frame& frame, TriangleId id, std::uint32_t k) {
  const std::uint32_t v = frame.clusters[cluster_of(id)].first_vertex + (frame.corners[id] >> (8 * k) & 255U);
  return frame.positions_ws[v];
}

// Points on the frame's triangles: groups lie close together on one, or anywhere.
std::unique_ptr<SurfaceSamples> samples_on(const frame::Frame& frame, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  auto s = no_samples();
  TriangleId id = 0;
  double b = 0, c = 0;
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    const bool is_close = i / kGroupSize % 4 != 0 && i % kGroupSize != 0;
    if (!is_close) {
      const auto cluster = static_cast<std::uint32_t>(random() % frame.clusters.size());
      id = cluster << kTriangleBits |
           static_cast<std::uint32_t>(random() % frame.clusters[cluster].triangle_count);
      b = unit(random), c = unit(random);
      if (b + c > 1) b = 1 - b, c = 1 - c;
    }
    const double u = b * (is_close ? 1 - 0.02 * unit(random) : 1),
                 v = c * (is_close ? 1 - 0.02 * unit(random) : 1);
    const glm::dvec3 a = corner(frame, id, 0);
    put(*s, i, a + u * (corner(frame, id, 1) - a) + v * (corner(frame, id, 2) - a), id);
  }
  return s;
}

std::vector<float> arrival(const reference::OwnedFrame& owned, const SurfaceSamples& samples,
                           InstructionSet set, std::size_t light = 0) {
  const light::LightPlan plan = light::make_light_plan(owned.frame, {laterna::ShadowTechnique::exact, {}});
  const ExactShadow shadow(plan.lights.at(light), owned.frame,
                           {std::make_shared<const CasterTree>(owned.frame, CasterTree::Casters::opaque)},
                           set);
  auto arrival = std::make_unique<Arrival>();
  shadow.find_arrival(samples, std::span(samples.active).first(samples.group_count), *arrival);
  EXPECT_FALSE(arrival->is_tinted);
  return {arrival->alpha.begin(),
          arrival->alpha.begin() + static_cast<std::ptrdiff_t>(samples.group_count * kGroupSize)};
}

// ---------------------------------------------------------------------------------------------- scenes

struct LightCase {
  const char* name;
  LightType type;
  bool is_parallel;
  bool fit = true;
};
constexpr LightCase kLightCases[] = {{"projector", LightType::projector, false},
                                     {"parallel projector", LightType::projector, true},
                                     {"spot", LightType::spot, false},
                                     {"sun", LightType::directional, true},
                                     {"confined sun", LightType::directional, true, false},
                                     {"point", LightType::point, false}};

void add_light(Scene& scene, const LightCase& c, glm::dvec3 from, glm::dvec3 to, double near = 0.1) {
  Light light;
  light.type = c.type;
  light.fit = c.fit;
  light.projection = c.is_parallel ? Projection::orthographic(6, 6, near, 30)
                                   : Projection::perspective(Angle::degrees(80), 1, near, 60);
  reference::add_light(scene, light, from, to);
}

void add_cut_outs(Scene& scene) {
  for (const float alpha : {0.2F, 0.9F}) {
    const int node =
        reference::add_object(scene, "cut out", reference::wall(0.5F, 0.5F, alpha < 0.5F ? 2.0F : -1.5F));
    scene.nodes[static_cast<std::size_t>(node)].parent_from_node[3] = glm::dvec4(1.5, 1, 0, 1);
    scene.materials.back().alpha_mode = alpha < 0.5F ? AlphaMode::mask : AlphaMode::blend;
    scene.materials.back().base_color.a = alpha;
    scene.materials.back().double_sided = true;
  }
}

Scene solids() {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(6));
  reference::add_object(scene, "box", reference::box({0.3F, 0.8F, 0.2F}, {0.7F, 0.8F, 0.5F}));
  reference::add_object(scene, "ball", reference::sphere({-1.7F, 1.5F, 0.5F}, 0.8F, 24));
  add_cut_outs(scene);
  const int ghost =
      reference::add_object(scene, "casts nothing", reference::box({-2, 0.5F, 2}, {0.4F, 0.5F, 0.4F}));
  scene.nodes[static_cast<std::size_t>(ghost)].casts_shadow = false;
  return scene;
}

// Triangles of all sizes in a box of 8 m: slivers, points and lines among them.
Scene soup(unsigned seed, glm::vec3 offset) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto anywhere = [&](float reach) {
    return glm::vec3(unit(random), unit(random), unit(random)) * reach;
  };
  reference::Mesher mesher;
  for (int i = 0; i < 700; ++i) {
    const glm::vec3 a = offset + anywhere(4);
    const float size = std::pow(10.0F, -0.7F + 1.2F * unit(random));
    glm::vec3 b = a + anywhere(size), c = a + anywhere(size);
    if (i % 16 == 1) c = a + (b - a) * 0.5F;   // a line
    if (i % 16 == 2) b = c = a;                // a point
    if (i % 16 == 3) c = b + anywhere(1e-5F);  // a sliver
    if (i % 16 == 4) b.y = c.y = a.y;          // level
    mesher.triangle(a, b, c);
  }
  Scene scene;
  reference::add_object(scene, "soup", mesher.primitive);
  scene.materials.back().double_sided = true;
  return scene;
}

struct Tally {
  int lit = 0, dark = 0, ties = 0;
};

// Every sample as judged, where moving things by `tolerance` metres cannot change that.
Tally expect_as_judged(const reference::OwnedFrame& owned, InstructionSet set, unsigned seed,
                       double tolerance) {
  const auto samples = samples_on(owned.frame, seed);
  const std::vector<float> got = arrival(owned, *samples, set);
  const reference::ShadowJudge judge(owned.frame, owned.frame.lights.at(0));
  Tally tally;
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    const glm::dvec3 p = position(*samples, i);
    const Judgement judged = judge.judge(p, samples->id[i], static_cast<float>(kNearest), tolerance);
    ++(judged == Judgement::tie ? tally.ties : judged == Judgement::lit ? tally.lit : tally.dark);
    if (judged == Judgement::tie) continue;
    EXPECT_EQ(got[i], judged == Judgement::lit ? 1.0F : 0.0F)
        << "seed " << seed << " sample " << i << " at " << p.x << ", " << p.y << ", " << p.z;
  }
  return tally;
}

class ExactShadowOnEverySet : public testing::TestWithParam<InstructionSet> {};

TEST_P(ExactShadowOnEverySet, AnswersAsJudgedForEveryLight) {
  for (const LightCase& c : kLightCases) {
    SCOPED_TRACE(c.name);
    Scene scene = solids();
    add_light(scene, c, {2.2, 5, -3.1}, {0, 0, 0});
    const reference::OwnedFrame owned = reference::make_frame(std::move(scene));
    Tally sum;
    for (unsigned seed = 0; seed < 4; ++seed) {
      const Tally tally = expect_as_judged(owned, GetParam(), seed, 1e-9);
      sum.lit += tally.lit, sum.dark += tally.dark, sum.ties += tally.ties;
    }
    EXPECT_GT(sum.lit, 100);
    EXPECT_GT(sum.dark, 100);
    EXPECT_LT(sum.ties, 30);
  }
}

// The light among the triangles, so that it shines all round and bundles have to be taken apart; and their near planes.
TEST_P(ExactShadowOnEverySet, AnswersAsJudgedFromWithinASoup) {
  for (const LightCase& c : kLightCases) {
    SCOPED_TRACE(c.name);
    for (unsigned seed = 0; seed < 3; ++seed) {
      Scene scene = soup(seed, {0, 0, 0});
      add_light(scene, c, {0.3, 0.2, -0.1}, {3, 2, -0.5}, 1.3);
      const reference::OwnedFrame owned = reference::make_frame(std::move(scene));
      const Tally tally = expect_as_judged(owned, GetParam(), seed, 1e-9);
      EXPECT_GT(tally.lit, 10);
      EXPECT_GT(tally.dark, 10);
      EXPECT_LT(tally.ties, 5);
    }
  }
}

// Far from the origin, and lit from so far that its light is nearly parallel: 10⁻¹⁶ of the distance is what double holds.
TEST_P(ExactShadowOnEverySet, AnswersAsJudgedFarOut) {
  for (const double distance : {1e3, 1e6}) {
    Scene scene = soup(7, {4000, -2000, 1000});
    add_light(scene, kLightCases[5], {4000 + distance, -2000 + 2 * distance, 1000 + 0.3 * distance},
              {4000, -2000, 1000});
    const reference::OwnedFrame owned = reference::make_frame(std::move(scene));
    const Tally tally = expect_as_judged(owned, GetParam(), 3, 1e-7);
    EXPECT_GT(tally.lit, 10);
    EXPECT_GT(tally.dark, 10);
    EXPECT_LT(tally.ties, 10);
  }
}

TEST_P(ExactShadowOnEverySet, IsTheSameOnAll) {
  for (const LightCase& c : kLightCases) {
    Scene scene = soup(11, {1, 2, 3});
    add_light(scene, c, {2.2, 5, -3.1}, {1, 2, 3});
    const reference::OwnedFrame owned = reference::make_frame(std::move(scene));
    for (unsigned seed = 0; seed < 8; ++seed) {
      const auto samples = samples_on(owned.frame, seed);
      EXPECT_EQ(arrival(owned, *samples, GetParam()), arrival(owned, *samples, InstructionSet::scalar))
          << c.name;
    }
  }
}

// A wall of triangles with shared corners in no order, and samples that see the light straight through corners, along
// edges, and to one side of them by a unit in the last place: no light comes through.
TEST_P(ExactShadowOnEverySet, NoLightComesThroughSeams) {
  constexpr int kSide = 24;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> jitter(-0.03F, 0.03F);
  std::vector<glm::vec3> grid;
  for (int i = 0; i <= kSide * (kSide + 2); ++i) {
    const auto x = static_cast<float>(i % (kSide + 1)), y = static_cast<float>(i / (kSide + 1));
    grid.emplace_back(0.1F * x - 1.2F + jitter(random), 0.1F * y - 1.2F + jitter(random), jitter(random));
  }
  reference::Mesher mesher;
  for (std::size_t i = 0; i + kSide + 2 < grid.size(); ++i) {
    if (i % (kSide + 1) == kSide) continue;
    mesher.triangle(grid[i], grid[i + 1], grid[i + kSide + 2]);
    mesher.triangle(grid[i + kSide + 2], grid[i + kSide + 1], grid[i]);
  }
  for (const LightCase& c : kLightCases) {
    SCOPED_TRACE(c.name);
    Scene scene;
    reference::add_object(scene, "wall", mesher.primitive);
    add_light(scene, c, {0.4, 0.3, 3}, {0, 0, 0});
    const reference::OwnedFrame owned = reference::make_frame(std::move(scene));
    const Pose& pose = owned.frame.lights.at(0).pose;
    for (int round = 0; round < 12; ++round) {
      auto s = no_samples();
      for (std::size_t i = 0; i < kMaxSamples; ++i) {
        // Well inside the wall's rim.
        const std::size_t column = 6 + random() % (kSide - 12), row = 6 + random() % (kSide - 12);
        const std::size_t v = row * (kSide + 1) + column;
        const std::size_t other = v + (round % 2 == 0 ? 0 : round % 4 == 1 ? 1 : kSide + 2);
        const float share = std::uniform_real_distribution<float>(0, 1)(random);
        const glm::dvec3 at(glm::mix(grid[v], grid[other], share));
        const glm::dvec3 way = c.is_parallel ? pose.forward_ws() : at - pose.position_ws;
        put(*s, i, at + way * 0.5, kNoTriangle);
        float& x = s->x_ws[i];
        if (round % 3 != 0) x = std::nextafter(x, round % 3 == 1 ? 9.0F : -9.0F);
      }
      for (const float alpha : arrival(owned, *s, GetParam())) ASSERT_EQ(alpha, 0);
    }
  }
}

TEST_P(ExactShadowOnEverySet, ASampleAtTheLightIsLitAndNothingIsDarkWithoutCasters) {
  Scene scene;
  reference::add_object(scene, "box", reference::box({0, 0, 0}, {1, 1, 1}));
  add_light(scene, kLightCases[5], {0.5, 0.25, 0.125}, {0, 0, -1});
  auto s = no_samples();
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    const double angle = 0.1 * static_cast<double>(i);
    // Around the light inside of the box, at the light, and beyond the box.
    const double reach = i % 16 == 5 ? 0 : i % 2 == 0 ? 0.2 : 5;
    put(*s, i,
        glm::dvec3(0.5, 0.25, 0.125) +
            reach * glm::dvec3(std::cos(angle), std::sin(angle), std::sin(3 * angle)),
        kNoTriangle);
  }
  const std::vector<float> inside = arrival(reference::make_frame(scene), *s, GetParam());
  scene.nodes[0].casts_shadow = false;
  const std::vector<float> without = arrival(reference::make_frame(scene), *s, GetParam());
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    EXPECT_EQ(inside[i], i % 16 == 5 || i % 2 == 0 ? 1 : 0) << i;
    EXPECT_EQ(without[i], 1);
  }
}

// Light that lies in a triangle's plane sees its edge alone: it casts nothing, nor does a surface in the very plane of the
// one that is lit.
TEST_P(ExactShadowOnEverySet, EdgeOnAndCoincidentSurfacesCastNothing) {
  for (const LightCase& c : kLightCases) {
    SCOPED_TRACE(c.name);
    Scene scene;
    reference::add_object(scene, "floor", reference::floor(4));
    reference::add_object(scene, "the same floor", reference::floor(3));
    reference::Mesher fin;  // upright, in the plane of the light
    fin.quad({0, 0, 1}, {0, 0, -1}, {0, 1, -1}, {0, 1, 1});
    reference::add_object(scene, "fin", fin.primitive);
    add_light(scene, c, {0, 5, 2}, {0, 0, 0});
    const reference::OwnedFrame owned = reference::make_frame(std::move(scene));
    auto s = no_samples();
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      put(*s, i, {0.01 * static_cast<double>(i % 16) - 0.075, 0, 0.01 * static_cast<double>(i / 16)}, 0);
    }
    for (const float alpha : arrival(owned, *s, GetParam())) ASSERT_EQ(alpha, 1);
  }
}

TEST_P(ExactShadowOnEverySet, OnlyAskedForSamplesAreAnswered) {
  Scene scene = solids();
  add_light(scene, kLightCases[0], {2.2, 5, -3.1}, {0, 0, 0});
  const reference::OwnedFrame owned = reference::make_frame(std::move(scene));
  const auto all = samples_on(owned.frame, 2);
  const std::vector<float> whole = arrival(owned, *all, GetParam());
  auto some = samples_on(owned.frame, 2);
  std::mt19937 random(1);
  for (std::uint16_t& mask : some->active) mask = static_cast<std::uint16_t>(random() & random());
  some->active[3] = 0;
  // What is not asked for may be anything.
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    if ((some->active[i / kGroupSize] >> (i % kGroupSize) & 1U) == 0) some->x_ws[i] = std::nanf("");
  }
  const std::vector<float> part = arrival(owned, *some, GetParam());
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    if ((some->active[i / kGroupSize] >> (i % kGroupSize) & 1U) == 0) continue;
    EXPECT_EQ(part[i], whole[i]) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, ExactShadowOnEverySet, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& instance) { return std::string(name_of(instance.param)); });

}  // namespace
}  // namespace laterna::shadow
