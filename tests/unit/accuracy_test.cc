// Shadows against rays, where the answer is known beforehand.
#include "laterna/accuracy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "image/text_drawing.h"
#include "measure/mask_errors.h"
#include "reference/shadow_scenes.h"
#include "reference/shadow_truth.h"

namespace laterna {
namespace {

using namespace reference;
using measure::LitPixels;
using measure::Mask;

constexpr int kSide = 200;         // pixels of 1 cm
constexpr int kTexelsAcross = 20;  // of 10 cm, 10 pixels each
constexpr int kEnd = 150;          // where the shadow of a square metre ends, in pixels

// A floor seen from straight above, and over the camera a sheet in a sun at the zenith.
ShadowScene sheet_under_zenith(float half_width, float half_depth) {
  ShadowScene s;
  add_object(s.scene, "floor", floor(5));
  Mesher sheet;
  sheet.quad({-half_width, 1, half_depth}, {half_width, 1, half_depth}, {half_width, 1, -half_depth},
             {-half_width, 1, -half_depth});
  add_object(s.scene, "sheet", sheet.primitive);
  Light light = sun("light");
  light.fit = false;
  light.projection = Projection::orthographic(1, 1, 0, 20);
  light.shadow.resolution = kTexelsAcross;
  add_light(s.scene, light, {0, 10, 0}, {0, 0, 0}, {0, 0, -1});
  s.camera = look({0, 0.5, 0}, {0, 0, 0}, 40, 1, {0, 0, -1});
  s.camera.projection = Projection::orthographic(1, 1, 0, 10);
  return s;
}

// Its masks, to be changed at will.
class MaskAccuracy : public testing::Test {
 protected:
  void look_at(const ShadowScene& shown, int subpixels = 1) {
    renderer_.emplace(make_renderer(shown.scene));
    const RenderSettings settings = test_settings(kSide, kSide);
    surface_ = measure::draw_picture_surface(*renderer_, shown.camera, settings).value();
    rays_ = measure::ShadowRays::create(shown.scene, pool_).value();
    pixels_.emplace(LitPixels::find(*renderer_, surface_, *rays_, "light").value());
    RenderSettings wanted = settings;
    wanted.shadows = ShadowTechnique::raytraced;
    wanted.layers = {Layer::visibility};
    truth_ = render(*renderer_, shown.camera, wanted).find("visibility.light")->values;
    subpixels_ = subpixels;
  }

  [[nodiscard]] static std::size_t at_pixel(int x, int y) { return static_cast<std::size_t>(y * kSide + x); }
  [[nodiscard]] Mask displaced(int by) const {
    Mask mask(truth_.size(), 1);
    for (int y = 0; y < kSide; ++y) {
      for (int x = by; x < kSide; ++x) mask[at_pixel(x, y)] = truth_[at_pixel(x - by, y)];
    }
    return mask;
  }
  [[nodiscard]] ShadowAccuracy errors_of(const Mask& mask) const {
    return measure::find_mask_errors(*pixels_, truth_, mask, subpixels_, pool_);
  }

  TaskPool pool_{2};
  std::optional<Renderer> renderer_;
  measure::PictureSurface surface_;
  std::unique_ptr<const measure::ShadowRays> rays_;
  std::optional<LitPixels> pixels_;
  Mask truth_;
  int subpixels_ = 1;
};

TEST_F(MaskAccuracy, TheTruthIsRight) {
  look_at(sheet_under_zenith(0.5F, 0.5F));
  const ShadowAccuracy errors = errors_of(truth_);
  EXPECT_EQ(errors.pixels, kSide * kSide);
  EXPECT_EQ(std::count(errors.verdicts.begin(), errors.verdicts.end(), ShadowVerdict::dark), 10000);
  EXPECT_EQ(errors.edge_pixels, 2 * 4 * 100);
  for (const double error :
       {errors.false_lit, errors.false_dark, errors.acne, errors.gap_texels, errors.edge_px_median,
        errors.edge_px_p99, errors.edge_px_mean, errors.mean_error}) {
    EXPECT_EQ(error, 0);
  }
}

TEST_F(MaskAccuracy, ADisplacedSquareIsFalseAlongTwoOfItsSides) {
  look_at(sheet_under_zenith(0.5F, 0.5F));
  const ShadowAccuracy errors = errors_of(displaced(3));
  EXPECT_DOUBLE_EQ(errors.false_lit, 3 * 100.0 / (kSide * kSide));
  EXPECT_DOUBLE_EQ(errors.false_dark, 3 * 100.0 / (kSide * kSide));
  EXPECT_DOUBLE_EQ(errors.mean_error, 6 * 100.0 / (kSide * kSide));
  EXPECT_EQ(errors.acne, 0) << "0.3 texels from a true edge";
  EXPECT_EQ(errors.gap_texels, 0) << "nothing touches";
}

TEST_F(MaskAccuracy, ADisplacedStraightEdgeIsAsFarOffAsItIsDisplaced) {
  look_at(sheet_under_zenith(0.5F, 4));
  for (const int by : {1, 3, 7}) {
    const ShadowAccuracy errors = errors_of(displaced(by));
    EXPECT_EQ(errors.edge_pixels, 2 * 2 * kSide);
    EXPECT_EQ(errors.edge_px_median, by);
    EXPECT_EQ(errors.edge_px_p99, by);
    EXPECT_EQ(errors.edge_px_mean, by);
  }
}

TEST_F(MaskAccuracy, EdgesAreMeasuredInPixelsOfThePictureNotOfTheGrid) {
  look_at(sheet_under_zenith(0.5F, 4), 2);
  EXPECT_EQ(errors_of(displaced(3)).edge_px_median, 1.5);
}

TEST_F(MaskAccuracy, WithoutAnyShadowEveryEdgeIsAsFarOffAsCanBe) {
  look_at(sheet_under_zenith(0.5F, 0.5F));
  const ShadowAccuracy errors = errors_of(Mask(truth_.size(), 1));
  EXPECT_DOUBLE_EQ(errors.false_lit, 0.25);
  EXPECT_EQ(errors.false_dark, 0);
  EXPECT_EQ(errors.edge_px_median, kFarthestEdge);
  EXPECT_EQ(errors.edge_pixels, 4 * 100);
}

TEST_F(MaskAccuracy, HalfLitIsLit) {
  look_at(sheet_under_zenith(0.5F, 0.5F));
  Mask mask = truth_;
  mask[at_pixel(100, 100)] = 0.5F;
  mask[at_pixel(101, 100)] = 0.49F;
  const ShadowAccuracy errors = errors_of(mask);
  EXPECT_DOUBLE_EQ(errors.false_lit, 1.0 / (kSide * kSide));
  EXPECT_NEAR(errors.mean_error, 0.99 / (kSide * kSide), 1e-9);
}

TEST_F(MaskAccuracy, FalseShadowIsAcneBeyondTwoTexelsFromTheTrueEdge) {
  look_at(sheet_under_zenith(0.5F, 0.5F));
  // A texel is ten pixels: right of the shadow's edge, 0.55, 1.95, 2.05 and 4.05 texels off.
  for (const auto& [away, is_acne] :
       {std::pair{5, false}, std::pair{19, false}, std::pair{20, true}, std::pair{40, true}}) {
    Mask mask = truth_;
    mask[at_pixel(kEnd + away, 100)] = 0;
    const ShadowAccuracy errors = errors_of(mask);
    EXPECT_DOUBLE_EQ(errors.false_dark, 1.0 / (kSide * kSide));
    EXPECT_EQ(errors.acne > 0, is_acne) << away;
    EXPECT_EQ(errors.verdicts[at_pixel(kEnd + away, 100)],
              is_acne ? ShadowVerdict::acne : ShadowVerdict::false_dark);
  }
}

// The edge lies beside the picture, where only rays find it.
TEST_F(MaskAccuracy, FalseShadowNearAnEdgeOutOfSightIsNotAcne) {
  ShadowScene shown = sheet_under_zenith(0.5F, 0.5F);
  // Pixels 1 cm as before; the picture begins 0.1 m, one texel, beside the shadow.
  shown.camera.pose.position_ws.x = 1.6;
  shown.scene.lights[0].projection = Projection::orthographic(4, 4, 0, 20);
  shown.scene.lights[0].shadow.resolution = 80;
  look_at(shown);
  ASSERT_EQ(std::count(truth_.begin(), truth_.end(), 0.0F), 0);
  Mask mask = truth_;
  mask[at_pixel(5, 100)] = 0;    // 1.55 texels from the edge
  mask[at_pixel(100, 100)] = 0;  // 11
  const ShadowAccuracy errors = errors_of(mask);
  EXPECT_EQ(errors.verdicts[at_pixel(5, 100)], ShadowVerdict::false_dark);
  EXPECT_EQ(errors.verdicts[at_pixel(100, 100)], ShadowVerdict::acne);
}

// Light ends too where a surface turns away from it.
TEST_F(MaskAccuracy, FalseShadowWhereASurfaceTurnsAwayIsNotAcne) {
  ShadowScene shown = sheet_under_zenith(0.5F, 0.5F);
  shown.scene.nodes[0].visible = shown.scene.nodes[1].visible = false;
  // A ridge along z: its left side faces the light, its right side is turned away by a little.
  Mesher ridge;
  ridge.quad({-1, -0.2F, 1}, {0, 0, 1}, {0, 0, -1}, {-1, -0.2F, -1});
  ridge.quad({0, 0, 1}, {1, -0.2F, 1}, {1, -0.2F, -1}, {0, 0, -1});
  add_object(shown.scene, "ridge", ridge.primitive);
  shown.scene.nodes[0].casts_shadow = shown.scene.nodes[1].casts_shadow = false;
  shown.scene.nodes[2].parent_from_node =
      Pose::look_at({-10, 1, 0}, {0, 0, 0}, {0, 0, -1}).value().world_from_view();
  look_at(shown);
  Mask mask = truth_;
  mask[at_pixel(99, 100)] = 0;
  mask[at_pixel(20, 100)] = 0;
  const ShadowAccuracy errors = errors_of(mask);
  EXPECT_EQ(errors.pixels, kSide * kSide / 2);
  EXPECT_EQ(errors.verdicts[at_pixel(99, 100)], ShadowVerdict::false_dark);
  EXPECT_EQ(errors.verdicts[at_pixel(20, 100)], ShadowVerdict::acne);
}

TEST_F(MaskAccuracy, AnUnlitPictureHasNoErrors) {
  ShadowScene shown = sheet_under_zenith(0.5F, 0.5F);
  shown.scene.nodes.back().parent_from_node =
      Pose::look_at({0, -10, 0}, {0, 0, 0}, {0, 0, -1}).value().world_from_view();
  look_at(shown);
  const ShadowAccuracy errors = errors_of(Mask(truth_.size(), 0));
  EXPECT_EQ(errors.pixels, 0U) << "the floor turns away from the light";
  EXPECT_EQ(errors.false_dark, 0);
}

AccuracySettings settings_of(int width, int height, std::vector<ShadowTechnique> techniques) {
  AccuracySettings settings;
  settings.picture = test_settings(width, height);
  settings.techniques = std::move(techniques);
  settings.frames = 1;
  return settings;
}

ShadowAccuracy measure_map(const ShadowScene& shown, int width, int height) {
  const Renderer renderer = make_renderer(shown.scene);
  const AccuracyReport report =
      measure_accuracy(renderer, shown.camera, settings_of(width, height, {ShadowTechnique::map})).value();
  return report.measured.at(0);
}

// A sheet 1 m high on a floor in a sun 45° high, seen from behind. A bias of b metres along the light leaves
// b cos 45° of the floor lit, which the sun sees at 45° too: b / 2 of its map.
ShadowScene sheet_on_floor(double bias) {
  ShadowScene s;
  add_object(s.scene, "floor", floor(2));
  Mesher mesh;
  mesh.quad({0, 0, 1.5F}, {0, 0, -1.5F}, {0, 1, -1.5F}, {0, 1, 1.5F});
  add_object(s.scene, "sheet", mesh.primitive);
  s.scene.materials.back().double_sided = true;
  Light light = sun("light");
  light.fit = false;
  light.projection = Projection::orthographic(3, 3, 0, 20);
  light.shadow.resolution = 600;  // texels of 1 cm
  light.shadow.constant_bias = bias;
  add_light(s.scene, light, {-5, 5, 0}, {0, 0, 0});
  s.camera = look({2.2, 1.6, 0.4}, {0.3, 0, 0}, 40, 4.0 / 3);
  return s;
}

TEST(ShadowAccuracyMeasure, BiasOpensAGapOfItsOwnSize) {
  for (const double bias : {0.1, 0.2}) {
    EXPECT_NEAR(measure_map(sheet_on_floor(bias), 480, 360).gap_texels, bias / 2 / 0.01, 1.0) << bias;
  }
  ShadowScene shown = sheet_on_floor(0);
  shown.scene.lights[0].shadow.constant_bias.reset();
  EXPECT_LT(measure_map(shown, 480, 360).gap_texels, 1);
}

TEST(ShadowAccuracyMeasure, AGapShowsFromAboveTooWhereTheSheetIsSeenEdgeOn) {
  ShadowScene shown = sheet_on_floor(0.2);
  shown.camera = look({0, 5, 0}, {0, 0, 0}, 40, 1, {0, 0, -1});
  shown.camera.projection = Projection::orthographic(2, 2, 0, 10);
  EXPECT_NEAR(measure_map(shown, 400, 400).gap_texels, 10, 1.5);
}

TEST(ShadowAccuracyMeasure, WithoutBiasThereIsAcneWithDefaultsThereIsNone) {
  for (ShadowScene shown : {sphere_over_plane(4.0 / 3), torus_and_box(4.0 / 3)}) {
    const ShadowAccuracy right = measure_map(shown, 320, 240);
    EXPECT_EQ(right.acne, 0);
    EXPECT_LT(right.gap_texels, 2);
    EXPECT_LT(right.edge_px_mean, 0.1);
    EXPECT_GT(right.pixels, 20000U);
    shown.scene.lights[0].shadow.filter = ShadowFilter::nearest;
    shown.scene.lights[0].shadow.constant_bias = 0;
    const ShadowAccuracy wrong = measure_map(shown, 320, 240);
    EXPECT_GT(wrong.acne, 0.05);
    EXPECT_GE(wrong.false_dark, wrong.acne);
  }
}

// The tests' own, earlier reckoning. It knows no true edge where a surface only turns away from the light, so that it finds
// more acne beside such sides.
TEST(ShadowAccuracyMeasure, AgreesWithAnIndependentCount) {
  struct Case {
    ShadowScene shown;
    bool turns_away;
  };
  std::vector<Case> cases = {{sphere_over_plane(4.0 / 3), true},
                             {torus_and_box(4.0 / 3), true},
                             {poles_and_leaves(4.0 / 3), true},
                             {sheet_on_floor(0), false}};
  for (Case& c : cases) {
    c.shown.scene.lights[0].shadow.filter = ShadowFilter::nearest;
    c.shown.scene.lights[0].shadow.constant_bias = 0.003;
    const ShadowAccuracy found = measure_map(c.shown, 320, 240);
    const Renderer renderer = make_renderer(c.shown.scene);
    const ShadowErrors expected =
        find_shadow_errors(draw_shadow_masks(renderer, c.shown.camera, test_settings(320, 240), "light", 1));
    const auto pixels = static_cast<double>(found.pixels);
    // It counts what lies in a spotlight's map beside its cone, and leaves out what lies beside a fitted map.
    EXPECT_NEAR(pixels, expected.pixels, 0.05 * pixels);
    const double slack = 0.01 * (expected.false_lit + expected.false_dark) + 2;
    EXPECT_NEAR(found.false_lit * pixels, expected.false_lit, slack);
    EXPECT_NEAR(found.false_dark * pixels, expected.false_dark, slack);
    EXPECT_LE(found.acne * pixels, expected.far_false_dark + slack);
    EXPECT_GE(found.acne * pixels, (c.turns_away ? 0.2 : 1) * expected.far_false_dark - slack);
    EXPECT_GT(expected.far_false_dark, 50);
  }
}

TEST(ShadowAccuracyMeasure, EveryTechniqueIsMeasuredForEveryLightAndTheTruthIsFaultless) {
  ShadowScene shown = sphere_over_plane(1);
  add_light(shown.scene, spot("lamp", 40), {2, 5, 0}, {0, 0, 0});
  const Renderer renderer = make_renderer(shown.scene);
  AccuracySettings settings = settings_of(96, 96, {});
  settings.keep_verdicts = true;
  const AccuracyReport report = measure_accuracy(renderer, shown.camera, settings).value();
  EXPECT_EQ(report.measured.size() + report.skipped.size(), 2 * list_techniques().size());
  int truths = 0;
  for (const ShadowAccuracy& m : report.measured) {
    EXPECT_EQ(m.verdicts.size(), 96U * 96U);
    EXPECT_GE(m.ms, 0);
    if (m.technique == ShadowTechnique::map) {
      EXPECT_GT(m.mb, 0.1);
    }
    if (m.technique == ShadowTechnique::none) {
      EXPECT_GT(m.false_lit, 0.01);
    }
    if (m.technique != ShadowTechnique::raytraced) continue;
    ++truths;
    EXPECT_EQ(m.false_lit + m.false_dark + m.gap_texels + m.edge_px_p99 + m.mean_error, 0);
    EXPECT_GT(m.edge_pixels, 50U);
  }
  EXPECT_EQ(truths, 2);
}

TEST(ShadowAccuracyMeasure, DoesNotDependOnTheNumberOfThreads) {
  ShadowScene shown = torus_and_box(1);
  shown.scene.lights[0].shadow.constant_bias = 0;
  AccuracySettings settings = settings_of(128, 128, {ShadowTechnique::map});
  settings.keep_verdicts = true;
  const auto verdicts = [&](int threads) {
    const Renderer renderer = make_renderer(shown.scene, threads);
    return measure_accuracy(renderer, shown.camera, settings).value().measured.at(0).verdicts;
  };
  EXPECT_EQ(verdicts(1), verdicts(3));
}

TEST(ShadowAccuracyMeasure, ALightsOwnTechniqueIsSetAsideAndResolutionCanBeGiven) {
  ShadowScene shown = sphere_over_plane(1);
  shown.scene.lights[0].shadow.technique = ShadowTechnique::none;
  const Renderer renderer = make_renderer(shown.scene);
  AccuracySettings settings = settings_of(96, 96, {ShadowTechnique::map});
  const AccuracyReport fine = measure_accuracy(renderer, shown.camera, settings).value();
  settings.resolution = 64;
  const AccuracyReport coarse = measure_accuracy(renderer, shown.camera, settings).value();
  EXPECT_LT(fine.measured.at(0).false_lit, 0.01);
  EXPECT_LT(coarse.measured.at(0).mb, fine.measured.at(0).mb);
  EXPECT_EQ(renderer.scene().lights[0].shadow.technique, ShadowTechnique::none) << "the caller's scene stays";
}

TEST(ShadowAccuracyMeasure, RefusesWhatMakesNoSense) {
  const ShadowScene shown = sphere_over_plane(1);
  const Renderer renderer = make_renderer(shown.scene);
  const auto message = [&](auto change) {
    AccuracySettings settings = settings_of(32, 32, {ShadowTechnique::map});
    change(settings);
    const Result<AccuracyReport> report = measure_accuracy(renderer, shown.camera, settings);
    return report ? "" : to_string(report.error());
  };
  EXPECT_EQ(message([](AccuracySettings& s) { s.lights = {"moon"}; }),
            "the scene has no light \"moon\" that is on: it has \"light\"");
  EXPECT_EQ(message([](AccuracySettings& s) { s.subpixels = 9; }), "subpixels must be 1 to 8, not 9");
  EXPECT_EQ(message([](AccuracySettings& s) { s.frames = 0; }), "at least one frame must be timed");
  EXPECT_EQ(message([](AccuracySettings& s) { s.resolution = -1; }),
            "a shadow map's resolution cannot be negative");
  EXPECT_NE(message([](AccuracySettings& s) { s.resolution = 100000; }), "");
  EXPECT_NE(message([](AccuracySettings& s) { s.picture.width = 0; }), "");

  Scene dark;
  add_object(dark, "floor", floor(1));
  dark.ambient_is_set = true;
  const Result<AccuracyReport> report =
      measure_accuracy(make_renderer(dark), shown.camera, settings_of(32, 32, {}));
  ASSERT_FALSE(report);
  EXPECT_EQ(to_string(report.error()), "the scene has no light whose shadows could be measured");
}

TEST(ShadowAccuracyMeasure, StopsWhenAskedAndTellsHowFarItIs) {
  const ShadowScene shown = sphere_over_plane(1);
  const Renderer renderer = make_renderer(shown.scene);
  const AccuracySettings settings = settings_of(64, 64, {ShadowTechnique::map, ShadowTechnique::raytraced});
  double last = 0;
  const auto tells = [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  };
  ASSERT_TRUE(measure_accuracy(renderer, shown.camera, settings, tells));
  EXPECT_DOUBLE_EQ(last, 1);
  const Result<AccuracyReport> stopped =
      measure_accuracy(renderer, shown.camera, settings, [](double fraction) { return fraction < 0.4; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().failure, Failure::cancelled);
}

// Where a line of a sheet lies that holds yellow, blue and red beside each other; from the top, after `from`.
int line_of_errors(const LayeredImage& image, int from) {
  for (int y = from + 1; y < image.height; ++y) {
    const bool is_yellow =
        at(image, "R", 3, y) > 0.9F && at(image, "G", 3, y) > 0.5F && at(image, "B", 3, y) < 0.1F;
    const bool is_blue = at(image, "B", 4, y) > 0.9F && at(image, "R", 4, y) < 0.1F;
    const bool is_red = at(image, "R", 5, y) > 0.9F && at(image, "G", 5, y) < 0.1F;
    if (is_yellow && is_blue && is_red) return y;
  }
  return -1;
}

TEST(AccuracyPicture, ShowsEachVerdictInItsColour) {
  AccuracyReport report;
  report.width = 6;
  report.height = 1;
  report.grey.assign(6, 0.5F);
  ShadowAccuracy measured;
  measured.verdicts = {ShadowVerdict::not_counted, ShadowVerdict::dark,       ShadowVerdict::lit,
                       ShadowVerdict::false_lit,   ShadowVerdict::false_dark, ShadowVerdict::acne};
  report.measured = {measured, measured};
  report.measured[1].light = "other";
  const LayeredImage image = accuracy_picture(report).value();
  EXPECT_EQ(image.width, 6);
  const int first = line_of_errors(image, -1);
  const int second = line_of_errors(image, first);
  ASSERT_GT(first, 0) << "a title is above";
  ASSERT_GT(second, first + 1) << "another block for the other light, with its own title";
  for (int x = 0; x < 3; ++x) EXPECT_EQ(at(image, "R", x, first), at(image, "B", x, first)) << "grey";
  EXPECT_LT(at(image, "R", 0, first), at(image, "R", 1, first));
  EXPECT_LT(at(image, "R", 1, first), at(image, "R", 2, first));
  report.measured[0].verdicts.clear();
  EXPECT_EQ(to_string(accuracy_picture(report).error()), "the report has no verdicts to make a picture of");
}

TEST(AccuracyPicture, ASinglePixelStaysVisibleInASheetMadeSmaller) {
  AccuracyReport report;
  report.width = 5001;
  report.height = 3;
  report.grey.assign(5001 * 3, 0.5F);
  ShadowAccuracy measured;
  measured.verdicts.assign(report.grey.size(), ShadowVerdict::lit);
  measured.verdicts[5001 + 100] = ShadowVerdict::acne;
  report.measured = {measured, measured};
  report.measured[1].technique = ShadowTechnique::map;
  const LayeredImage image = accuracy_picture(report).value();
  const int gap = image.width - 5000;
  EXPECT_TRUE(gap > 0 && gap < 50) << "two columns of half the size: " << image.width;
  int found = 0;
  for (int y = 0; y < image.height; ++y) {
    const auto is_acne = [&](int x) { return at(image, "R", x, y) == 1 && at(image, "G", x, y) == 0; };
    if (is_acne(50) && is_acne(2550 + gap) && !is_acne(51)) ++found;
  }
  EXPECT_EQ(found, 1);
}

// Fewer pictures than five stand side by side; more are shared out evenly over rows. Each is named.
TEST(AccuracyPicture, RowsOfAtMostFivePicturesUnderTheirNames) {
  AccuracyReport report;
  report.width = 100;
  report.height = 40;
  report.grey.assign(4000, 0.5F);
  ShadowAccuracy measured;
  measured.light = "sun";
  measured.pixels = 4000;
  measured.verdicts.assign(4000, ShadowVerdict::lit);
  const auto draw = [&](std::size_t techniques) {
    report.measured.assign(techniques, measured);
    for (std::size_t i = 0; i < techniques; ++i)
      report.measured[i].technique = list_techniques()[i].technique;
    return accuracy_picture(report).value();
  };
  const int gap = draw(2).width - 200;
  EXPECT_EQ(draw(5).width, 500 + 4 * gap);
  EXPECT_EQ(draw(6).width, 300 + 2 * gap);
  EXPECT_EQ(draw(10).width, 500 + 4 * gap);
  const LayeredImage one = draw(1);
  EXPECT_GT(draw(6).height, one.height + 40);
  EXPECT_GT(one.height, 40 + 2 * image::kGlyphHeight);
  LayeredImage label = one;
  for (Channel& channel : label.channels) std::fill(channel.values.begin(), channel.values.end(), 0.0F);
  image::draw_text(label, 0, 0, "light: sun", {1, 1, 1});
  const auto ink_is_at = [&](int shift) {
    for (int y = 0; y < image::kGlyphHeight; ++y) {
      for (int x = 0; x < 100; ++x)
        if (at(label, "R", x, y) != at(one, "R", x, y + shift)) return false;
    }
    return true;
  };
  int lines = 0;
  for (int shift = 0; shift + image::kGlyphHeight <= one.height; ++shift) lines += ink_is_at(shift) ? 1 : 0;
  EXPECT_EQ(lines, 1) << "the light's name";
}

TEST(StandardLights, ASunAtFortyFiveDegreesASpotAndAPointWithinTheBounds) {
  Scene scene;
  add_object(scene, "box", box({10, 3, -2}, {4, 3, 2}));
  Light own = sun("auto sun");
  add_light(scene, own, {0, 1, 0}, {1, 0, 0});
  const Scene lit = with_standard_lights(scene).value();
  EXPECT_FALSE(lit.lights.at(0).enabled) << "the scene's own";
  ASSERT_EQ(lit.lights.size(), 4U);
  const std::vector<glm::dmat4> places = world_from_nodes(lit);
  const auto pose_of = [&](const char* name) {
    const int node = find_light_node(lit, name);
    return Pose::from_matrix(places.at(static_cast<std::size_t>(node))).value();
  };
  EXPECT_NEAR(pose_of("auto sun").forward_ws().y, -std::sqrt(0.5), 1e-12);
  for (const char* name : {"auto spot", "auto point"}) {
    const glm::dvec3 position = pose_of(name).position_ws;
    EXPECT_LE(glm::abs(position.x - 10), 4) << name;
    EXPECT_LE(glm::abs(position.y - 3), 3) << name;
    EXPECT_LE(glm::abs(position.z + 2), 2) << name;
  }
  EXPECT_TRUE(validate(lit).empty());
  EXPECT_FALSE(with_standard_lights(Scene()));
}

}  // namespace
}  // namespace laterna
