// Shadow volumes as a second oracle beside rays: row 52, for every kind of light, and where volumes are hard to count.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "reference/shadow_scenes.h"
#include "reference/shadow_ties.h"

namespace laterna {
namespace {

using namespace reference;

ShadowMismatches compare(const ShadowScene& shown, int width = 200, int height = 150) {
  return compare_techniques(shown.scene, shown.camera, test_settings(width, height), ShadowTechnique::volume,
                            ShadowTechnique::raytraced);
}

void expect_same(const ShadowScene& shown, std::size_t least_dark) {
  const ShadowMismatches found = compare(shown);
  SCOPED_TRACE(to_string(found));
  EXPECT_TRUE(found.mistakes.empty());
  EXPECT_LE(found.pixels.size(), found.seen / 1000);
  EXPECT_GE(found.dark, least_dark);
  EXPECT_GT(found.seen, 3000U);
}

// ---------------------------------------------------------------------------------------------- kinds of lights

Light light_of(LightType type) {
  Light light;
  light.name = "light";
  light.type = type;
  light.intensity = 50;
  return light;
}

struct LightCase {
  const char* name;
  std::function<Light()> light;
};

const LightCase kLights[] = {
    {"Sun", [] { return light_of(LightType::directional); }},
    // What of the torus and the box is nearer to the sun than the box's near plane casts nothing.
    {"BoxedSun",
     [] {
       Light light = light_of(LightType::directional);
       light.fit = false;
       light.projection = Projection::orthographic(8, 8, 4.3, 20);
       return light;
     }},
    {"Point", [] { return light_of(LightType::point); }},
    {"Spot", [] { return light_of(LightType::spot); }},
    {"Projector",
     [] {
       Light light = light_of(LightType::projector);
       light.projection = Projection::perspective(Angle::degrees(50), 1, 0.1, 100);
       return light;
     }},
    // Its near plane goes through the torus.
    {"ProjectorWithNearPlane",
     [] {
       Light light = light_of(LightType::projector);
       light.projection = Projection::perspective(Angle::degrees(50), 1, 4.5, 100);
       return light;
     }},
    {"OrthographicProjector",
     [] {
       Light light = light_of(LightType::projector);
       light.projection = Projection::orthographic(4, 4, 4.1, 100);
       return light;
     }},
};

class ShadowVolumeOfLight : public testing::TestWithParam<LightCase> {};

ShadowScene lit_by(const LightCase& kind) {
  ShadowScene shown = torus_and_box(4.0 / 3);
  shown.scene.lights[0] = kind.light();
  return shown;
}

// Row 52, closed meshes on an open floor.
TEST_P(ShadowVolumeOfLight, SamePictureAsRays) { expect_same(lit_by(GetParam()), 1500); }

// An orthographic camera's lines of sight never meet.
TEST_P(ShadowVolumeOfLight, SamePictureAsRaysForAnOrthographicCamera) {
  ShadowScene shown = lit_by(GetParam());
  shown.camera = {Pose::look_at({-2.5, 3, 4}, {0, 0.6, 0}, {0, 1, 0}).value(),
                  Projection::orthographic(2.4, 1.8, 0.1, 30)};
  expect_same(shown, 1500);
}

// The camera stands in the shadow of the box and looks at what is lit, and at the box.
TEST_P(ShadowVolumeOfLight, TheCameraMayStandInAVolume) {
  ShadowScene shown = lit_by(GetParam());
  shown.camera = look({-0.65, 0.05, -0.2}, {0.2, 0.3, 0.1}, 90, 4.0 / 3, {0, 1, 0}, 0.001);
  expect_same(shown, 500);
  shown.camera = look({-0.4, 0.02, -0.1}, {-3, 0.1, 1}, 90, 4.0 / 3, {0, 1, 0}, 0.001);
  expect_same(shown, 100);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShadowVolumeOfLight, testing::ValuesIn(kLights),
                         [](const auto& instance) { return std::string(instance.param.name); });

// ---------------------------------------------------------------------------------------------- kinds of casters

TEST(ShadowVolume, SmoothClosedMesh) { expect_same(sphere_over_plane(4.0 / 3), 1500); }

// Open meshes and cut-outs, the leaves with their own alpha.
TEST(ShadowVolume, OpenPolesAndCutOutLeaves) { expect_same(poles_and_leaves(4.0 / 3), 500); }

// A camera inside a closed box, a light inside a closed sphere: everything outside of that is dark.
TEST(ShadowVolume, LightInsideAMesh) {
  for (const bool has_sphere : {false, true}) {
    ShadowScene shown;
    add_object(shown.scene, "room", box({0, 2, 0}, {4, 2, 4}));
    shown.scene.materials.back().double_sided = true;
    add_object(shown.scene, "table", box({1, 0.5F, 0}, {0.8F, 0.05F, 0.5F}));
    if (has_sphere) add_object(shown.scene, "sphere", sphere({0, 3, 0}, 0.3F, 24));
    add_light(shown.scene, light_of(LightType::point), {0, 3, 0.1}, {0, 0, 0});
    shown.camera = look({-3, 2, 3}, {1, 0.5, 0}, 60, 4.0 / 3);
    const ShadowMismatches found = compare(shown);
    SCOPED_TRACE(to_string(found));
    EXPECT_TRUE(found.mistakes.empty());
    if (has_sphere) {
      // The sphere's own triangles do not shadow themselves from inside.
      EXPECT_GT(found.dark, found.seen * 98 / 100);
      EXPECT_LT(found.dark, found.seen);
    } else {
      EXPECT_LT(found.dark, found.seen / 3);
      EXPECT_GT(found.dark, 300U);
    }
  }
}

// A floor, and what hangs over it, seen from above so that the floor's left half lies below.
ShadowScene under_a_lamp(Primitive caster, glm::dvec3 lamp) {
  ShadowScene shown;
  add_object(shown.scene, "floor", floor(3));
  const int node = add_object(shown.scene, "caster", std::move(caster));
  shown.scene.nodes[static_cast<std::size_t>(node)].visible = false;
  add_light(shown.scene, light_of(LightType::point), lamp, {0, 0, 0}, {0, 0, 1});
  shown.camera = look({0, 6, 0}, {0, 0, 0}, 45, 4.0 / 3, {0, 0, -1});
  return shown;
}

// What the light sees edge-on casts a line of no width.
TEST(ShadowVolume, LightInThePlaneOfAFace) {
  Mesher mesh;
  mesh.quad({0, 0.5F, -1}, {0, 0.5F, 1}, {0, 1.5F, 1}, {0, 1.5F, -1});
  const ShadowMismatches edge_on = compare(under_a_lamp(mesh.primitive, {0, 4, 0}));
  SCOPED_TRACE(to_string(edge_on));
  EXPECT_TRUE(edge_on.mistakes.empty());
  EXPECT_EQ(edge_on.dark, 0U);
  // Of a box that lies in two of its faces' planes, the others cast as ever.
  expect_same(under_a_lamp(box({-0.5F, 1, 0}, {0.5F, 0.25F, 0.5F}), {0, 4, 0}), 500);
  // On the very face, and at a corner.
  for (const glm::dvec3 lamp : {glm::dvec3(0, 1.25, 0), glm::dvec3(0, 1.25, 0.5)}) {
    const ShadowMismatches on_face = compare(under_a_lamp(box({-0.5F, 1, 0}, {0.5F, 0.25F, 0.5F}), lamp));
    SCOPED_TRACE(to_string(on_face));
    EXPECT_LE(on_face.mistakes.size(), 2U * 150U) << "more than the line of the light's own faces";
  }
}

TEST(ShadowVolume, DegenerateTrianglesCastNothing) {
  Mesher mesh;
  mesh.triangle({-1, 1, 0}, {1, 1, 0}, {0, 1, 0});                   // a line
  mesh.triangle({0.5F, 1, 0.5F}, {0.5F, 1, 0.5F}, {0.5F, 1, 0.5F});  // a point
  mesh.triangle({-1, 1, -1}, {-1, 1, -1}, {1, 1, -1});               // two corners in one place
  const ShadowMismatches found = compare(under_a_lamp(mesh.primitive, {0.1, 4, 0.2}));
  SCOPED_TRACE(to_string(found));
  EXPECT_TRUE(found.pixels.empty());
  EXPECT_EQ(found.dark, 0U);
}

// Two sheets in one place, both windings, and three sheets on one edge.
TEST(ShadowVolume, CoincidentAndBranchingSheets) {
  Mesher mesh;
  for (int copy = 0; copy < 2; ++copy) {
    mesh.quad({-1, 1, -1}, {-1, 1, 0}, {0, 1, 0}, {0, 1, -1});
    mesh.quad({0, 1, -1}, {0, 1, 0}, {-1, 1, 0}, {-1, 1, -1});
  }
  for (int blade = 0; blade < 3; ++blade) {
    const auto angle = static_cast<float>(blade) * 2.0944F + 0.3F;
    const glm::vec3 out(0.7F * std::cos(angle), 0.7F * std::sin(angle), 0);
    mesh.quad({0.8F, 1, 0}, {0.8F, 1, 1}, glm::vec3(0.8F, 1, 1) + out, glm::vec3(0.8F, 1, 0) + out);
  }
  expect_same(under_a_lamp(mesh.primitive, {0.1, 4, 0.2}), 800);
  // And with a receiver in the very place of the caster.
  Mesher floors;
  floors.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
  const ShadowMismatches found = compare(under_a_lamp(floors.primitive, {0.1, 4, 0.2}));
  SCOPED_TRACE(to_string(found));
  EXPECT_TRUE(found.pixels.empty());
  EXPECT_EQ(found.dark, 0U);
}

// A caster behind the light darkens nothing that lies before it, whichever way the volumes run.
TEST(ShadowVolume, CastersBehindTheLight) {
  for (const LightType type : {LightType::point, LightType::spot, LightType::projector}) {
    ShadowScene shown = under_a_lamp(box({0, 3, 0}, {1, 0.25F, 1}), {0, 2, 0});
    shown.scene.lights[0] = light_of(type);
    shown.scene.lights[0].projection = Projection::perspective(Angle::degrees(60), 1, 0.1, 100);
    const ShadowMismatches found = compare(shown);
    SCOPED_TRACE(to_string(found));
    EXPECT_TRUE(found.pixels.empty());
    EXPECT_EQ(found.dark, 0U);
  }
}

TEST(ShadowVolume, NothingThatCasts) {
  ShadowScene shown = under_a_lamp(box({0, 1, 0}, {1, 0.25F, 1}), {0, 4, 0});
  for (Node& node : shown.scene.nodes) node.casts_shadow = false;
  const ShadowMismatches found = compare(shown);
  EXPECT_TRUE(found.pixels.empty());
  EXPECT_EQ(found.dark, 0U);
  EXPECT_GT(found.seen, 3000U);
  ShadowScene empty;
  add_light(empty.scene, light_of(LightType::directional), {0, 1, 0}, {0, 0, 0}, {0, 0, 1});
  empty.camera = shown.camera;
  EXPECT_EQ(compare(empty).seen, 0U);
}

// A square board half way between lamp and floor: its shadow is twice as wide, to the pixel.
TEST(ShadowVolume, TheShadowOfABoardIsAsWideAsSimilarTrianglesSay) {
  Mesher mesh;
  mesh.quad({-0.5F, 2, 0.5F}, {0.5F, 2, 0.5F}, {0.5F, 2, -0.5F}, {-0.5F, 2, -0.5F});
  ShadowScene shown = under_a_lamp(mesh.primitive, {0, 4, 0});
  // 100 pixels per metre.
  shown.camera = {Pose::look_at({0, 6, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                  Projection::orthographic(2, 2, 0.1, 10)};
  RenderSettings settings = test_settings(400, 400);
  settings.layers = {Layer::visibility};
  settings.shadows = ShadowTechnique::volume;
  const LayeredImage seen = render(make_renderer(shown.scene), shown.camera, settings);
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 400; ++x) {
      const bool is_dark = x >= 100 && x < 300 && y >= 100 && y < 300;
      ASSERT_EQ(at(seen, "visibility.light", x, y), is_dark ? 0 : 1) << x << ' ' << y;
    }
  }
}

// Blended casters only tint, as everywhere; what is drawn over them asks as well.
TEST(ShadowVolume, BlendedSheetsAreAskedAndTint) {
  ShadowScene shown = torus_and_box(4.0 / 3);
  Mesher mesh;
  mesh.quad({-1.5F, 0.7F, 1.2F}, {-0.5F, 0.7F, 1.4F}, {-0.4F, 1.4F, 0.9F}, {-1.4F, 1.4F, 0.7F});
  add_object(shown.scene, "pane", mesh.primitive);
  shown.scene.materials.back().alpha_mode = AlphaMode::blend;
  shown.scene.materials.back().double_sided = true;
  for (const float alpha : {0.3F, 0.7F}) {
    shown.scene.materials.back().base_color[3] = alpha;
    expect_same(shown, 1500);
  }
}

// The same picture for any number of threads and on every instruction set.
TEST(ShadowVolume, SameBitsEverywhere) {
  const ShadowScene shown = poles_and_leaves(4.0 / 3);
  RenderSettings settings = test_settings(160, 120);
  settings.layers = {Layer::visibility};
  settings.shadows = ShadowTechnique::volume;
  const LayeredImage first =
      render(make_renderer(shown.scene, 1, InstructionSet::scalar), shown.camera, settings);
  for (const InstructionSet set : supported_instruction_sets()) {
    for (const int threads : {1, 3}) {
      const LayeredImage other = render(make_renderer(shown.scene, threads, set), shown.camera, settings);
      for (int y = 0; y < settings.height; ++y) {
        for (int x = 0; x < settings.width; ++x) {
          for (const char* channel : {"R", "G", "B", "visibility.light"})
            ASSERT_EQ(at(first, channel, x, y), at(other, channel, x, y)) << name_of(set) << ' ' << threads;
        }
      }
    }
  }
}

TEST(ShadowVolume, MemoryIsReported) {
  const ShadowScene shown = torus_and_box(1);
  RenderSettings settings = test_settings(64, 64);
  settings.shadows = ShadowTechnique::volume;
  RenderStatistics statistics;
  ASSERT_TRUE(make_renderer(shown.scene).render(shown.camera, settings, {}, &statistics));
  ASSERT_EQ(statistics.shadow_memory.size(), 1U);
  EXPECT_GT(statistics.shadow_memory[0].bytes, 100000U);
}

}  // namespace
}  // namespace laterna
