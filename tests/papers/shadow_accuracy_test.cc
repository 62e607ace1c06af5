// Shadow maps with default settings against rays, on generated scenes: what the first release promises.
#include <gtest/gtest.h>

#include "reference/shadow_scenes.h"
#include "reference/shadow_truth.h"

namespace laterna {
namespace {

using namespace reference;

ShadowErrors errors_of(const ShadowScene& shown) {
  const Renderer renderer = make_renderer(shown.scene);
  return find_shadow_errors(draw_shadow_masks(renderer, shown.camera, test_settings(480, 360), "light", 3));
}

void expect_as_promised(const ShadowErrors& errors) {
  SCOPED_TRACE(to_string(errors));
  EXPECT_EQ(errors.far_false_dark, 0) << "acne";
  EXPECT_EQ(errors.far_false_lit, 0) << "leaks";
  EXPECT_GE(errors.edge_share(), 0.995);
  EXPECT_GT(errors.edge_pixels, 300);
  EXPECT_GT(errors.pixels, 40000);
}

TEST(ShadowAccuracy, SphereOverPlaneInTheSun) { expect_as_promised(errors_of(sphere_over_plane(4.0 / 3))); }
TEST(ShadowAccuracy, TorusAndBoxUnderASpotlight) { expect_as_promised(errors_of(torus_and_box(4.0 / 3))); }
TEST(ShadowAccuracy, ThinPolesAndCutOutLeavesInALowSun) {
  expect_as_promised(errors_of(poles_and_leaves(4.0 / 3)));
}

// Of the strips that throw the edge, most are seen by no texel: they are found as neighbours of those that are.
TEST(ShadowAccuracy, FinelyMouldedLedgeInAGrazingSun) {
  const ShadowErrors errors = errors_of(moulded_ledge(4.0 / 3));
  expect_as_promised(errors);
  EXPECT_LT(errors.wrong_share(), 0.0005) << to_string(errors);
  EXPECT_LT(errors.contact_gap, 2) << to_string(errors);
}

}  // namespace
}  // namespace laterna
