// Lenses of projectors: field of view, shift and distortion. Segal et al. 1992, section 3.2, have a spotlight's distortion
// held in its map (row 17). The oracle is OpenCV's formula in tests/reference.
#include "laterna/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/measure.h"
#include "reference/opencv_lens.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"

namespace laterna {
namespace {

using namespace reference;

// A wall in the plane z = 0, the lantern 3 m before it on the axis, and a camera that sees the wall flat.
constexpr double kDistance = 3;
constexpr int kWidth = 480, kHeight = 300;
constexpr double kHalfHeight = 1.5;
constexpr double kPixelsPerMetre = kHeight / (2 * kHalfHeight);

View flat_view() { return square_on(kHalfHeight, double{kWidth} / kHeight); }

glm::dvec2 pixel_of(glm::dvec2 wall) {
  return {kWidth / 2.0 + wall.x * kPixelsPerMetre, kHeight / 2.0 - wall.y * kPixelsPerMetre};
}
// Tangents, y downward, of what is seen at a pixel; and back.
glm::dvec2 direction_at(glm::dvec2 pixel) {
  return glm::dvec2(pixel.x - kWidth / 2.0, pixel.y - kHeight / 2.0) / (kPixelsPerMetre * kDistance);
}
glm::dvec2 pixel_toward(glm::dvec2 direction) {
  return pixel_of(kDistance * glm::dvec2(direction.x, -direction.y));
}

constexpr OpenCvLens kBarrel{.k1 = -0.2};
constexpr OpenCvLens kLenses[] = {kBarrel, {.k1 = 0.25}, {-0.28, 0.07, 0.01, -0.015, 0.02}};

LensDistortion to_laterna(const OpenCvLens& l) { return {l.k1, l.k2, l.p1, l.p2, l.k3}; }

// 16 : 9, half a unit wide to each side: 53° across.
const Projection kFrame = {false, -0.5, 0.5, -0.28125, 0.28125, 0.1, 100};

glm::dvec2 slide_of(const Projection& frame, glm::dvec2 place) {
  return {(place.x - frame.left) / (frame.right - frame.left),
          (place.y + frame.top) / (frame.top - frame.bottom)};
}
glm::dvec2 place_of(const Projection& frame, glm::dvec2 slide) {
  return {frame.left + slide.x * (frame.right - frame.left),
          -frame.top + slide.y * (frame.top - frame.bottom)};
}

// What a slide of so many texels shows of a function of places on it.
int add_slide(Scene& scene, const Projection& frame, int width,
              const std::function<glm::vec3(glm::dvec2)>& color) {
  const int height = static_cast<int>(std::lround(width / frame.aspect()));
  return add_linear_picture(scene, width, height, [&](int x, int y) {
    return color(place_of(frame, {(x + 0.5) / width, (y + 0.5) / height}));
  });
}

// A picture that tells its own coordinates.
glm::vec3 coordinates(glm::dvec2 slide) { return {slide.x, slide.y, 1}; }

Light lantern(const Projection& frame, int slide, const OpenCvLens& lens = {}) {
  Light light = projector("lantern", 1, 1, slide);
  light.projection = frame;
  light.distortion = to_laterna(lens);
  return light;
}

Scene wall_scene() {
  Scene scene;
  add_object(scene, "wall", wall(9, 9, 0));
  return scene;
}

LayeredImage draw(Scene scene, const Light& light, std::vector<Layer> layers = {}) {
  add_light(scene, light, {0, 0, kDistance}, {0, 0, 0});
  RenderSettings settings = papers_settings(kWidth, kHeight);
  settings.layers = std::move(layers);
  return render(make_renderer(std::move(scene)), flat_view(), settings);
}

// Where the picture shows given coordinates: the nearest pixel, and from it along the picture's own slopes.
glm::dvec2 find_coordinates(const LayeredImage& image, glm::dvec2 wanted) {
  const auto red = values_of(image, "R"), green = values_of(image, "G"), blue = values_of(image, "B");
  const auto value = [&](int x, int y) {
    const auto i = static_cast<std::size_t>(y * kWidth + x);
    return glm::dvec2(red[i], green[i]);
  };
  double nearest = 1e9;
  glm::ivec2 at(0);
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth; ++x) {
      if (blue[static_cast<std::size_t>(y * kWidth + x)] < 0.999F) continue;
      const double distance = glm::distance(value(x, y), wanted);
      if (distance < nearest) nearest = distance, at = {x, y};
    }
  }
  const glm::dvec2 by_x = (value(at.x + 1, at.y) - value(at.x - 1, at.y)) / 2.0;
  const glm::dvec2 by_y = (value(at.x, at.y + 1) - value(at.x, at.y - 1)) / 2.0;
  const glm::dvec2 rest = wanted - value(at.x, at.y);
  const double determinant = by_x.x * by_y.y - by_y.x * by_x.y;
  return glm::dvec2(at) + 0.5 +
         glm::dvec2(rest.x * by_y.y - rest.y * by_y.x, rest.y * by_x.x - rest.x * by_x.y) / determinant;
}

// The corners of a 16 × 9 grid on the slide, as OpenCV's axes have them.
void expect_corners(const LayeredImage& image, const Projection& frame,
                    const std::function<glm::dvec2(glm::dvec2)>& direction_of_place) {
  double worst = 0;
  for (int j = 1; j < 9; ++j) {
    for (int i = 1; i < 16; ++i) {
      const glm::dvec2 slide(i / 16.0, j / 9.0);
      const glm::dvec2 expected = pixel_toward(direction_of_place(place_of(frame, slide)));
      worst = std::max(worst, glm::distance(find_coordinates(image, slide), expected));
    }
  }
  EXPECT_LT(worst, 0.1) << "pixels";
}

// Row 17, the parametric lens: each corner of the slide's grid lies where the inverse of OpenCV's formula throws it.
TEST(Lens, ThrowsTheSlidesCornersWhereOpenCvSaysTheyGo) {
  for (const OpenCvLens& lens : kLenses) {
    for (const Projection& frame : {kFrame, kFrame.shifted(0.1, -0.2)}) {
      Scene scene = wall_scene();
      const int slide =
          add_slide(scene, frame, 256, [&](glm::dvec2 place) { return coordinates(slide_of(frame, place)); });
      const LayeredImage image = draw(std::move(scene), lantern(frame, slide, lens));
      expect_corners(image, frame, [&](glm::dvec2 place) { return unproject(lens, place); });
    }
  }
}

// Row 17, distortion held in the map: a map made as a camera with k1 = −0.2 sees the grid shows the analytic barrel,
// r' = r (1 − 0.2 r²). And thrown through that very lens it is straight again.
TEST(Lens, AMapThatHoldsTheDistortionThrowsTheBarrelAndTheLensUndoesIt) {
  Scene scene = wall_scene();
  const int map = add_slide(scene, kFrame, 512, [&](glm::dvec2 place) {
    return coordinates(slide_of(kFrame, unproject(kBarrel, place)));
  });
  const LayeredImage barrel = draw(scene, lantern(kFrame, map));
  expect_corners(barrel, kFrame, [](glm::dvec2 place) {
    const double r2 = glm::dot(place, place);
    return place * (1 - 0.2 * r2);
  });
  const LayeredImage straight = draw(scene, lantern(kFrame, map, kBarrel));
  expect_corners(straight, kFrame, [](glm::dvec2 place) { return place; });
}

// Row 17: distortion in the lens and distortion in the map give one picture, but for the interpolation of two different
// grids of texels. Texels are larger than pixels, so that it is bilinear: from waves of amplitude a and n texels long it
// strays by at most a (2π / n)² / 8, here 4.1e-4 for either map.
TEST(Lens, DistortionInTheLensAndInTheMapGiveOnePicture) {
  const auto pattern = [](glm::dvec2 slide) {
    const double turn = 2 * 3.14159265358979;
    return glm::vec3(
        glm::dvec3(0.5 + 0.25 * std::sin(turn * 3 * slide.x) + 0.25 * std::cos(turn * 2 * slide.y)));
  };
  Scene scene = wall_scene();
  const int plain =
      add_slide(scene, kFrame, 256, [&](glm::dvec2 place) { return pattern(slide_of(kFrame, place)); });
  const LayeredImage by_lens = draw(scene, lantern(kFrame, plain, kBarrel), {Layer::uv});
  // A little larger, for what bulges.
  const Projection wide = {false, -0.6, 0.6, -0.3375, 0.3375, 0.1, 100};
  const int bent = add_slide(
      scene, wide, 307, [&](glm::dvec2 place) { return pattern(slide_of(kFrame, project(kBarrel, place))); });
  const LayeredImage by_map = draw(scene, lantern(wide, bent));
  int compared = 0;
  double worst = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float u = at(by_lens, "uv.lantern.u", x, y), v = at(by_lens, "uv.lantern.v", x, y);
      if (!(u > 0.01F && u < 0.99F && v > 0.01F && v < 0.99F)) continue;
      ++compared;
      worst = std::max(worst, std::abs(double{at(by_lens, "R", x, y)} - at(by_map, "R", x, y)));
    }
  }
  EXPECT_GT(compared, 40000);
  EXPECT_LT(worst, 8.2e-4);
}

// uv.<light> is the formula at every pixel, and NaN outside the bulging frame and nowhere else.
TEST(Lens, SlideCoordinatesOfEveryPixelAreOpenCvs) {
  for (const OpenCvLens& lens : kLenses) {
    const LayeredImage image = draw(wall_scene(), lantern(kFrame, -1, lens), {Layer::uv});
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec2 slide = slide_of(kFrame, project(lens, direction_at({x + 0.5, y + 0.5})));
        const float u = at(image, "uv.lantern.u", x, y), v = at(image, "uv.lantern.v", x, y);
        const double inside = std::min({slide.x, 1 - slide.x, slide.y, 1 - slide.y});
        if (std::abs(inside) < 1e-5) continue;
        ASSERT_EQ(std::isnan(u), inside < 0) << x << " " << y;
        ASSERT_EQ(at(image, "R", x, y), inside < 0 ? 0.0F : 1.0F);
        if (inside < 0) continue;
        ASSERT_NEAR(u, slide.x, 2e-6);
        ASSERT_NEAR(v, slide.y, 2e-6);
      }
    }
  }
}

// Where a profile of slide coordinates, linear along a flat wall, reaches `value`: beyond its ends by its slope.
double place_of_coordinate(const LayeredImage& image, const std::string& channel, bool along_x,
                           double value) {
  double first = 0, last = 0;
  int first_at = -1, last_at = -1;
  for (int i = 0; i < (along_x ? kWidth : kHeight); ++i) {
    const float u = along_x ? at(image, channel, i, kHeight / 3) : at(image, channel, kWidth / 2, i);
    if (std::isnan(u)) continue;
    if (first_at < 0) first_at = i, first = u;
    last_at = i, last = u;
  }
  return first_at + 0.5 + (value - first) / (last - first) * (last_at - first_at);
}

// A shift of half the height puts the frame's lower side on the axis; half the width, its left side.
TEST(Lens, HalfAShiftPutsASideOfTheFrameOnTheAxis) {
  const LayeredImage up = draw(wall_scene(), lantern(kFrame.shifted(0, 0.5), -1), {Layer::uv});
  EXPECT_NEAR(place_of_coordinate(up, "uv.lantern.v", false, 1), kHeight / 2.0, 0.1);
  EXPECT_EQ(at(up, "R", kWidth / 2, kHeight / 2 - 1), 1);
  EXPECT_EQ(at(up, "R", kWidth / 2, kHeight / 2), 0);
  const LayeredImage right = draw(wall_scene(), lantern(kFrame.shifted(0.5, 0.3), -1), {Layer::uv});
  EXPECT_NEAR(place_of_coordinate(right, "uv.lantern.u", true, 0), kWidth / 2.0, 0.1);
}

// A throw ratio of 1.5 makes a picture 2.00 m wide at 3 m.
TEST(Lens, ThrowRatioIsDistanceOverWidth) {
  const Projection frame = Projection::from_throw_ratio(1.5, 16.0 / 9, 0.1, 100);
  const LayeredImage image = draw(wall_scene(), lantern(frame, -1), {Layer::uv});
  const double width = place_of_coordinate(image, "uv.lantern.u", true, 1) -
                       place_of_coordinate(image, "uv.lantern.u", true, 0);
  EXPECT_NEAR(width / kPixelsPerMetre, 2.00, 1e-4);
  const double height = place_of_coordinate(image, "uv.lantern.v", false, 1) -
                        place_of_coordinate(image, "uv.lantern.v", false, 0);
  EXPECT_NEAR(height / kPixelsPerMetre, 1.125, 1e-4);
}

// Three bars before the wall, which shade the middle and the corners that bulge beyond the ideal frame.
Scene barred_wall() {
  Scene scene = wall_scene();
  for (const float x : {-0.75F, 0.1F, 0.78F})
    add_object(scene, "bar " + std::to_string(x), box({x, 0, 1.5F}, {0.02F, 0.6F, 0.02F}));
  return scene;
}

struct Answers {
  int lit = 0, beyond_the_ideal_frame = 0, dark_beyond = 0, differ = 0;
};

// `judged` against `truth`, where the slide shines.
Answers compare(const LayeredImage& judged, const LayeredImage& truth, const Projection& frame) {
  Answers answers;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (std::isnan(at(truth, "uv.lantern.u", x, y))) continue;
      ++answers.lit;
      const glm::dvec2 ideal = slide_of(frame, direction_at({x + 0.5, y + 0.5}));
      const bool is_beyond = ideal.x < 0 || ideal.x > 1 || ideal.y < 0 || ideal.y > 1;
      const float alpha = at(judged, "visibility.lantern", x, y);
      answers.beyond_the_ideal_frame += is_beyond ? 1 : 0;
      answers.dark_beyond += is_beyond && alpha < 0.5F ? 1 : 0;
      answers.differ += std::abs(alpha - at(truth, "visibility.lantern", x, y)) > 0.5F ? 1 : 0;
    }
  }
  return answers;
}

// Every technique sees all of the bulging picture: shadows are not cropped at the ideal frame.
TEST(Lens, ShadowsReachIntoTheCornersThatBulge) {
  Scene scene = barred_wall();
  add_light(scene, lantern(kFrame, -1, kBarrel), {0, 0, kDistance}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  RenderSettings settings = papers_settings(kWidth, kHeight);
  settings.layers = {Layer::uv, Layer::visibility, Layer::light};
  settings.shadows = ShadowTechnique::raytraced;
  const LayeredImage truth = render(renderer, flat_view(), settings);
  for (const ShadowTechnique technique :
       {ShadowTechnique::map, ShadowTechnique::pcss, ShadowTechnique::variance, ShadowTechnique::volume,
        ShadowTechnique::exact, ShadowTechnique::silhouette}) {
    settings.shadows = technique;
    settings.passes = Passes::single;
    const LayeredImage image = render(renderer, flat_view(), settings);
    const Answers answers = compare(image, truth, kFrame);
    EXPECT_GT(answers.lit, 50000);
    EXPECT_GT(answers.beyond_the_ideal_frame, 1500);
    EXPECT_GT(answers.dark_beyond, 40) << static_cast<int>(technique);
    const bool is_filtered =
        technique == ShadowTechnique::variance || technique == ShadowTechnique::silhouette;
    EXPECT_LE(answers.differ, is_filtered ? answers.lit / 50 : answers.lit / 2000)
        << static_cast<int>(technique);
    settings.passes = Passes::multi;
    EXPECT_EQ(count_different_pixels(image, render(renderer, flat_view(), settings)), 0U);
  }
}

// The picture does not depend on threads or instruction set with a lens either, whatever lies outside the slide.
TEST(Lens, IsTheSameOnEveryInstructionSet) {
  for (const Outside outside : {Outside::black, Outside::clamp, Outside::mirror}) {
    Scene scene = barred_wall();
    const int slide = add_linear_picture(
        scene, 9, 5, [](int x, int y) { return glm::vec3(x * 3 % 5, y * 5 % 7, (x + y) % 3) / 8.0F; });
    Light light = lantern(kFrame.shifted(0.2, 0), slide, kLenses[2]);
    light.outside = outside;
    add_light(scene, light, {0.3, 0.5, kDistance}, {0, 0, 0});
    RenderSettings settings = papers_settings(kWidth / 4, kHeight / 4);
    settings.anisotropy = 8;
    settings.layers = {Layer::uv, Layer::visibility};
    const View view = look({1, 0.4, 2.5}, {0, 0, 0}, 60, 1.6);
    const LayeredImage expected = render(make_renderer(scene, 1, InstructionSet::scalar), view, settings);
    for (const InstructionSet set : supported_instruction_sets())
      EXPECT_EQ(count_different_pixels(expected, render(make_renderer(scene, 2, set), view, settings)), 0U);
  }
}

// Outside the frame the lens goes on, as `outside` says, up to where it folds: nothing is thrown farther out.
TEST(Lens, ThrowsNothingBeyondItsFold) {
  Light light = lantern(kFrame, -1, kBarrel);
  light.outside = Outside::clamp;
  Scene scene = wall_scene();
  add_light(scene, light, {0, 0, 1}, {0, 0, 0});
  const LayeredImage image =
      render(make_renderer(std::move(scene)), flat_view(), papers_settings(kWidth, kHeight));
  const double fold = 1 / std::sqrt(0.6);  // metres on this wall
  for (int x = 0; x < kWidth; ++x) {
    const double metres = std::abs(x + 0.5 - kWidth / 2.0) / kPixelsPerMetre;
    EXPECT_EQ(at(image, "R", x, kHeight / 2), metres < fold ? 1.0F : 0.0F) << metres;
  }
}

// A projector's lumens are what its whole picture throws, however it bulges (row 16's flux).
TEST(Lens, LumensAreSpreadOverTheWholePicture) {
  for (const OpenCvLens& lens : kLenses) {
    for (const BeamProfile profile : {BeamProfile::flat_field, BeamProfile::uniform_candela}) {
      Light light = lantern(kFrame, -1, lens);
      light.profile = profile;
      light.lumens = 600;
      const LayeredImage image = draw(wall_scene(), light, {Layer::lux});
      double lumens = 0;
      for (const float lux : values_of(image, "lux.Y")) lumens += lux / (kPixelsPerMetre * kPixelsPerMetre);
      EXPECT_NEAR(lumens, 600, 6);
    }
  }
}

// A point's slide coordinates in double, and the way back: which place of the slide goes where on the wall.
TEST(Lens, InspectTellsTheDistortedPlaceAndTheWayBack) {
  Scene scene = wall_scene();
  add_light(scene, lantern(kFrame, -1, kLenses[2]), {0, 0, kDistance}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  for (const glm::dvec2 wall : {glm::dvec2(0, 0), glm::dvec2(0.9, -0.4), glm::dvec2(-1.2, 0.7)}) {
    const glm::dvec3 point(wall, 0);
    const PointReport report =
        inspect_point(renderer, flat_view(), kWidth, kHeight, "lantern", point).value();
    ASSERT_TRUE(report.slide);
    const glm::dvec2 slide = slide_of(kFrame, project(kLenses[2], glm::dvec2(wall.x, -wall.y) / kDistance));
    EXPECT_LT(glm::distance(*report.slide, slide), 1e-12);
    EXPECT_TRUE(report.is_inside);
    const glm::dvec3 back = renderer.world_from_slide("lantern", *report.slide, kDistance).value();
    EXPECT_LT(glm::distance(back, point), 1e-10);
  }
  const PointReport behind =
      inspect_point(renderer, flat_view(), kWidth, kHeight, "lantern", {0, 0, 2 * kDistance}).value();
  EXPECT_FALSE(behind.slide);
  EXPECT_FALSE(behind.is_ahead);
  EXPECT_EQ(to_string(renderer.world_from_slide("sun", {0, 0}, 1).error()),
            "the scene has no projector \"sun\" that is on: it has \"lantern\"");
}

// The depth map of a lens's light reaches over the whole picture that it throws.
TEST(Lens, TheDepthMapHoldsTheBulgingPicture) {
  Scene scene = wall_scene();
  add_light(scene, lantern(kFrame, -1, kBarrel), {0, 0, kDistance}, {0, 0, 0});
  const Projection beam = make_renderer(std::move(scene)).light_view("lantern").value().projection;
  const glm::dvec2 corner = unproject(kBarrel, {kFrame.right, -kFrame.top});
  EXPECT_GT(beam.right, corner.x);
  EXPECT_GT(beam.top, -corner.y);
  EXPECT_LT(beam.right, corner.x * 1.005);
}

}  // namespace
}  // namespace laterna
