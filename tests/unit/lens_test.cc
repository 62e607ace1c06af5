// The distortion of lenses and its inverse, and what rigs say about lenses.
#include "laterna/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "frame/slide_lens.h"
#include "reference/opencv_lens.h"
#include "reference/shapes.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

constexpr LensDistortion kLenses[] = {
    {-0.2, 0, 0, 0, 0},
    {0.3, 0, 0, 0, 0},
    {0, 0, 0.01, -0.02, 0},
    {-0.28, 0.07, 1e-3, -4e-4, 0},
    {0.12, -0.3, -2e-3, 3e-3, 0.09},
    {-1.5, 6, 0, 0, -5},
};

reference::OpenCvLens to_reference(const LensDistortion& l) { return {l.k1, l.k2, l.p1, l.p2, l.k3}; }

// Directions all over the lens's field; at most 60° off the axis.
std::vector<glm::dvec2> directions(const LensDistortion& lens) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  const double field = std::min(lens_field(lens), std::sqrt(3.0));
  std::vector<glm::dvec2> all;
  for (int i = 0; i < 200; ++i) {
    const double r = 0.999 * field * std::sqrt(unit(random)), angle = 2 * std::numbers::pi * unit(random);
    all.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return all;
}

TEST(Lens, DistortsAsOpenCvDoes) {
  for (const LensDistortion& lens : kLenses) {
    for (const glm::dvec2 p : directions(lens)) {
      EXPECT_LT(glm::distance(distorted(lens, p), reference::project(to_reference(lens), p)), 1e-14);
    }
  }
}

TEST(Lens, EveryDirectionOfItsFieldIsFoundAgain) {
  for (const LensDistortion& lens : kLenses) {
    for (const glm::dvec2 p : directions(lens)) {
      const auto found = undistorted(lens, distorted(lens, p));
      ASSERT_TRUE(found) << lens.k1 << " at " << p.x << " " << p.y;
      // Near a fold a place hardly changes with its direction.
      EXPECT_LT(glm::distance(*found, p), 1e-8) << lens.k1 << " at " << p.x << " " << p.y;
    }
  }
}

// r − 0.2 r³ rises up to r = 1 / √0.6, where it is 2/3 of that.
TEST(Lens, TheFieldEndsWhereTheLensFolds) {
  const LensDistortion barrel{.k1 = -0.2};
  EXPECT_NEAR(lens_field(barrel), 1 / std::sqrt(0.6), 1e-14);
  const double rim = 2.0 / 3 / std::sqrt(0.6);
  EXPECT_TRUE(undistorted(barrel, {0.999999 * rim, 0}));
  EXPECT_FALSE(undistorted(barrel, {1.000001 * rim, 0}));
  EXPECT_FALSE(undistorted(barrel, {NAN, 0}));
  EXPECT_EQ(lens_field({.k1 = 0.2}), kWidestLensField);
  EXPECT_EQ(lens_field({}), kWidestLensField);
  // x + 3 p2 x² turns at x = −1 / (6 p2); the same, downward, for p1.
  EXPECT_NEAR(lens_field({.p2 = -0.05}), 1 / 0.3, 1e-12);
  EXPECT_NEAR(lens_field({.p1 = 0.05}), 1 / 0.3, 1e-12);
  // Falls, rises and falls again: only up to the first turn.
  const LensDistortion wave{.k1 = -1.5, .k2 = 6, .k3 = -5};
  const double turn = lens_field(wave), r2 = turn * turn;
  EXPECT_NEAR(1 + r2 * (-4.5 + r2 * (30 - r2 * 35)), 0, 1e-12);
  for (double r = 0; r < 0.999 * turn; r += turn / 50)
    EXPECT_GT(1 + r * r * (-4.5 + r * r * (30 - r * r * 35)), 0);
}

TEST(Lens, FaultsSayWhereItFolds) {
  const Projection frame = Projection::perspective(Angle::degrees(60), 16.0 / 9, 0.1, 100);
  EXPECT_EQ(find_fault({.k1 = -0.1}, frame), "");
  EXPECT_EQ(find_fault({.k1 = -0.3}, frame),
            "cannot be inverted: it folds back 46.51 degrees off the lens axis (tangent 1.054), so that the "
            "slide's "
            "point (0, 0), from its top-left corner, is thrown nowhere");
  // Shifted downward, only the lower corners lie too far out.
  EXPECT_EQ(find_fault({.k1 = -0.1}, frame.shifted(0, -1)),
            "cannot be inverted: it folds back 61.29 degrees off the lens axis (tangent 1.826), so that the "
            "slide's "
            "point (1, 1), from its top-left corner, is thrown nowhere");
  EXPECT_EQ(find_fault({.k2 = 2e6}, frame), "expected finite coefficients of at most 1e+06, got 2e+06");
  EXPECT_EQ(find_fault({.p1 = NAN}, frame), "expected finite coefficients of at most 1e+06, got nan");
  EXPECT_EQ(find_fault({.k1 = 0.1}, Projection::orthographic(1, 1, 0, 5)),
            "only a perspective frame has a lens that distorts");
  EXPECT_EQ(find_fault(LensDistortion{}, Projection::orthographic(1, 1, 0, 5)), "");
}

// The beam holds all of a thrown picture, and hardly more; area and solid angle by counting the beam's image.
TEST(Lens, TheBeamHoldsTheWholePicture) {
  for (const LensDistortion& lens :
       {LensDistortion{.k1 = -0.2}, LensDistortion{.k1 = 0.3}, LensDistortion{-0.28, 0.07, 0.01, -0.02, 0}}) {
    for (const glm::dvec2 shift : {glm::dvec2(0), glm::dvec2(0.2, 0.5)}) {
      const Projection frame =
          Projection::perspective(Angle::degrees(30), 1.5, 0.1, 100).shifted(shift.x, shift.y);
      ASSERT_EQ(find_fault(lens, frame), "");
      const frame::SlideLens slide_lens(lens, frame);
      constexpr int kCount = 800;
      double area = 0, solid_angle = 0;
      glm::dvec2 low(1), high(0);
      const Projection& beam = slide_lens.beam;
      const double cell =
          (beam.right - beam.left) * (beam.top - beam.bottom) / (double{kCount} * double{kCount});
      for (int i = 0; i < kCount * kCount; ++i) {
        const int column = i % kCount, row = i / kCount;
        const glm::dvec2 image((column + 0.5) / kCount, (row + 0.5) / kCount);
        const auto slide = slide_lens.slide_from_beam(image);
        if (!slide || slide->x < 0 || slide->x > 1 || slide->y < 0 || slide->y > 1) continue;
        const double x = beam.left + image.x * (beam.right - beam.left);
        const double y = beam.top - image.y * (beam.top - beam.bottom);
        area += cell;
        solid_angle += cell * std::pow(1 + x * x + y * y, -1.5);
        low = glm::min(low, image);
        high = glm::max(high, image);
      }
      EXPECT_NEAR(slide_lens.area / area, 1, 2e-3);
      EXPECT_NEAR(slide_lens.solid_angle / solid_angle, 1, 2e-3);
      for (int axis = 0; axis < 2; ++axis) {
        EXPECT_GT(low[axis], 0.5 / kCount) << "the picture touches the beam's side";
        EXPECT_LT(low[axis], 3.0 / kCount);
        EXPECT_LT(high[axis], 1 - 0.5 / kCount) << "the picture touches the beam's side";
        EXPECT_GT(high[axis], 1 - 3.0 / kCount);
      }
    }
  }
}

Scene load_projector(const std::string& keys, const TemporaryFolder& folder) {
  // 40 × 20 pixels, and 3 × 1.
  folder.write("wide.ppm", "P6 40 20 255\n" + std::string(2400, 'x'));
  const std::string rig =
      R"({"lights": [{"type": "projector", "position": [0, 5, 0], "target": [0, 0, -5], )" + keys + "}]}";
  return load_or_fail({}, {.rigs = {folder.write("rig.json", rig)}});
}

TEST(LensOfARig, FieldOfViewByAnyKey) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& keys) { return load_projector(keys, folder).lights.at(0); };
  const Projection thrown = load(R"("throw_ratio": 1.5, "slide": "wide.ppm")").projection;
  EXPECT_NEAR(thrown.right, 1 / 3.0, 1e-15);
  EXPECT_NEAR(thrown.left, -1 / 3.0, 1e-15);
  EXPECT_NEAR(thrown.top, 1 / 6.0, 1e-15);
  const Light zoom = load(R"("focal_length_mm": 20, "sensor_mm": 16, "slide": "wide.ppm")");
  EXPECT_NEAR(zoom.projection.right, 0.4, 1e-15);
  EXPECT_NEAR(zoom.projection.top, 0.2, 1e-15);
  EXPECT_FALSE(zoom.aspect_from_slide);
  // A panel of its own shape: the slide fills it.
  const Light panel = load(R"("focal_length_mm": 20, "sensor_mm": [16, 12], "slide": "wide.ppm")");
  EXPECT_NEAR(panel.projection.top, 0.3, 1e-15);
  EXPECT_FALSE(panel.aspect_from_slide);
  EXPECT_NEAR(load(R"("throw_ratio": 0.5)").projection.top, 1, 1e-15);
  EXPECT_NEAR(load(R"("throw_ratio": 0.5, "aspect": 2)").projection.top, 0.5, 1e-15);
  const Scene filmed = load_or_fail({}, {.rigs = {folder.write("camera.json", R"({"cameras": [
    {"position": [0,0,5], "target": [0,0,0], "focal_length_mm": 50, "sensor_mm": [36, 24], "lens_shift": [0.25, -0.5]},
    {"position": [0,0,5], "target": [0,0,0], "focal_length_mm": 18, "sensor_mm": 36, "aspect": 2}]})")}});
  const Projection full_frame = filmed.cameras.at(0).projection;
  EXPECT_NEAR(full_frame.left, -0.18, 1e-15);
  EXPECT_NEAR(full_frame.right, 0.54, 1e-15);
  EXPECT_NEAR(full_frame.bottom, -0.48, 1e-15);
  EXPECT_NEAR(full_frame.top, 0, 1e-15);
  EXPECT_FALSE(filmed.cameras.at(0).aspect_from_picture);
  EXPECT_NEAR(filmed.cameras.at(1).projection.right, 1, 1e-15);
  EXPECT_NEAR(filmed.cameras.at(1).projection.top, 0.5, 1e-15);
}

TEST(LensOfARig, DistortionByNameAndInOpenCvsOrder) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& keys) { return load_projector(keys, folder).lights.at(0); };
  const Light named = load(R"("yfov_deg": 30, "slide": "wide.ppm", "distortion": {"k1": -0.2, "p2": 0.001})");
  EXPECT_EQ(named.distortion, (LensDistortion{-0.2, 0, 0, 0.001, 0}));
  EXPECT_FALSE(named.aspect_from_slide);
  EXPECT_NEAR(named.projection.aspect(), 2, 1e-15);
  EXPECT_EQ(load(R"("yfov_deg": 30, "distortion": [0.1, 0.2, 0.01, 0.02, 0.03])").distortion,
            (LensDistortion{0.1, 0.2, 0.01, 0.02, 0.03}));
  const Light calibrated = load(
      R"("intrinsics": {"fx": 2000, "fy": 2000, "cx": 959.5, "cy": 1079.5, "width": 1920, "height": 1080},
         "distortion": [-0.08, 0.01, 0, 0])");
  EXPECT_EQ(calibrated.distortion, (LensDistortion{-0.08, 0.01, 0, 0, 0}));
  EXPECT_NEAR(calibrated.projection.bottom, 0, 1e-12);
  EXPECT_TRUE(load(R"("yfov_deg": 30, "distortion": {}, "slide": "wide.ppm")").distortion.is_none());
}

// Half a height of shift keeps the frame's lower side on the axis, whatever shape the slide turns out to have.
TEST(LensOfARig, ShiftIsInWidthsAndHeightsOfThePicture) {
  const TemporaryFolder folder;
  const Scene scene =
      load_projector(R"("yfov_deg": 30, "lens_shift": [0.5, 0.5], "slide": "wide.ppm")", folder);
  EXPECT_NEAR(scene.lights.at(0).projection.bottom, 0, 1e-15);
  EXPECT_NEAR(scene.lights.at(0).projection.left, 0, 1e-15);
  const Projection placed = reference::make_frame(scene).frame.lights.at(0).view.projection;
  EXPECT_NEAR(placed.left, 0, 1e-15);
  EXPECT_NEAR(placed.right / placed.top, 2, 1e-14);
}

}  // namespace
}  // namespace laterna
