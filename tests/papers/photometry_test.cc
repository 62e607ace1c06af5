// Photometry: closed forms of illuminance, luminance, colour temperature, contrast and pixel density (rows 16 and 19, and
// the numbers that projectors are bought by).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <sstream>

#include "laterna/light_color.h"
#include "laterna/probes.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"

namespace laterna {
namespace {

using namespace reference;

constexpr ShadingModel kModels[] = {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr};

RenderSettings photometric(int width, int height, ShadingModel model = ShadingModel::pbr) {
  RenderSettings settings = test_settings(width, height);
  settings.shading = model;
  settings.layers = {Layer::lux, Layer::luminance, Layer::pixel_density};
  return settings;
}

Light point_light(double candela) {
  Light light;
  light.name = "bulb";
  light.intensity = candela;
  return light;
}

/// A wall at z = 0 that faces +Z, 16 m to each side.
Scene wall_scene() {
  Scene scene;
  add_object(scene, "wall", wall(16, 16, 0));
  return scene;
}

// 100 cd at 2 m are 25 lx square-on, and less by the cosine and the square of the distance beside that, in every shading
// model, whatever the shading normals and however much ambient light there is.
TEST(Photometry, ALampsIlluminanceIsCandelaTimesCosineOverDistanceSquared) {
  for (const ShadingModel model : kModels) {
    Scene scene = wall_scene();
    scene.ambient = {3, 3, 3};
    for (glm::vec3& n : scene.meshes[0].primitives[0].normals) n = glm::normalize(glm::vec3(1, 0.5F, 1));
    add_light(scene, point_light(100), {0, 0, 2}, {0, 0, 0});
    const LayeredImage image =
        render(make_renderer(std::move(scene)), square_on(4.5, 1), photometric(9, 9, model));
    for (int x = 0; x < 9; ++x) {
      const double from_foot = x - 4;
      const double distance = std::hypot(from_foot, 2.0);
      const double expected = 100 * (2 / distance) / (distance * distance);
      EXPECT_NEAR(at(image, "lux.Y", x, 4), expected, 1e-5 * expected) << x;
    }
    EXPECT_NEAR(at(image, "lux.Y", 4, 4), 25, 25e-6);
  }
}

// What a surface is lit by does not depend on how it is coloured, but luminance does: Lambert's E ρ/π, with glTF's 4 %
// that are reflected by the surface itself.
TEST(Photometry, LuminanceOfAMattSurfaceIsIlluminanceTimesReflectanceOverPi) {
  Scene scene = wall_scene();
  scene.materials[0].base_color = {0.5F, 0.5F, 0.5F, 1};
  scene.materials[0].metallic = 0;
  scene.materials[0].roughness = 1;
  add_light(scene, point_light(100), {0, 0, 2}, {0, 0, 0});
  const View from_the_lamp = look({0, 0, 2}, {0, 0, 0}, 0.1, 1);
  const LayeredImage image = render(make_renderer(std::move(scene)), from_the_lamp, photometric(3, 3));
  // Along the normal GGX with roughness 1 gives D V = 1/π · 1/4.
  EXPECT_NEAR(at(image, "luminance.Y", 1, 1), 25 * (0.96 * 0.5 + 0.04 / 4) / std::numbers::pi, 1e-4);
  for (int x = 0; x < 3; ++x) {
    EXPECT_EQ(
        at(image, "luminance.Y", x, 1),
        0.2126F * at(image, "R", x, 1) + 0.7152F * at(image, "G", x, 1) + 0.0722F * at(image, "B", x, 1));
  }
}

// 3,000 lm, 2.0 m × 1.125 m, 3 m away.
constexpr double kPictureWidth = 2.0, kPictureHeight = 1.125, kThrow = 3;

Light data_sheet_projector() {
  Light light = projector("projector", kPictureWidth / 2 / kThrow, kPictureHeight / 2 / kThrow);
  light.lumens = 3000;
  return light;
}

Renderer projected(const Light& light, Scene scene = {}) {
  add_object(scene, "screen", wall(1.5F, 1, 0));
  add_light(scene, light, {0, 0, kThrow}, {0, 0, 0});
  return make_renderer(std::move(scene));
}

TEST(Photometry, ThreeThousandLumensOnTwoMetresAre1333LuxAllOver) {
  const Renderer renderer = projected(data_sheet_projector());
  const View inside = square_on(0.99 * kPictureHeight / 2, kPictureWidth / kPictureHeight);
  const LayeredImage image = render(renderer, inside, photometric(64, 36));
  const double expected = 3000 / (kPictureWidth * kPictureHeight);
  EXPECT_NEAR(expected, 1333.3, 0.05);
  for (const float lux : values_of(image, "lux.Y")) ASSERT_NEAR(lux, expected, 1e-5 * expected);

  // All that arrives on the wall is all that was thrown: by the layer, and by meters all over the screen.
  const LayeredImage whole = render(renderer, square_on(1, 1.5), photometric(600, 400));
  double lumens = 0;
  for (const float lux : values_of(whole, "lux.Y")) lumens += static_cast<double>(lux) * 0.005 * 0.005;
  EXPECT_NEAR(lumens, 3000, 30);
  const std::vector<Probe> probes = renderer.probes_on_object("screen", 0.01).value();
  const ProbeReport report = renderer.measure_probes(probes, {}).value();
  EXPECT_NEAR(summarise(probes, report).lumens, 3000, 30);
}

// A contrast of 2000 : 1 leaves 1333.3 / 2000 lx where the slide is black, and white as it is.
TEST(Photometry, BlackIsWhiteOverContrast) {
  Scene scene;
  Light light = data_sheet_projector();
  light.slide = add_picture(scene, 64, 36, [](int x, int) { return glm::u8vec3(x < 32 ? 0 : 255); });
  light.black_level = 1.0 / 2000;
  for (const ShadingModel model : kModels) {
    const Renderer renderer = projected(light, scene);
    const LayeredImage image =
        render(renderer, square_on(0.7, kPictureWidth / kPictureHeight), photometric(64, 36, model));
    const double white = 3000 / (kPictureWidth * kPictureHeight);
    EXPECT_NEAR(at(image, "lux.Y", 20, 18), white / 2000, 1e-5 * white / 2000);
    EXPECT_NEAR(at(image, "lux.Y", 44, 18), white, 1e-5 * white);
    EXPECT_EQ(at(image, "lux.Y", 0, 18), 0);  // beside the picture nothing leaks
  }
}

// 1920 × 1080 pixels on that picture are 960 to the metre both ways; on a wall turned by 60° half as many across, on the
// axis, while up and down they stay. A plain white projector is told its panel.
TEST(Photometry, PixelDensityIsThatOfTheSparserDirection) {
  Light light = data_sheet_projector();
  light.panel_width = 1920;
  light.panel_height = 1080;
  const LayeredImage flat = render(projected(light), square_on(0.5, 1), photometric(5, 5));
  for (const float density : values_of(flat, "pixel_density.projector")) ASSERT_NEAR(density, 960, 1e-3);

  Scene scene;
  Mesher turned;
  const double c = std::cos(std::numbers::pi / 3);
  const double s = std::sin(std::numbers::pi / 3);
  const auto corner = [&](double x, double y) { return glm::vec3(x * c, y, -x * s); };
  turned.quad(corner(-2, -2), corner(2, -2), corner(2, 2), corner(-2, 2));
  add_object(scene, "turned", turned.primitive);
  add_light(scene, light, {0, 0, kThrow}, {0, 0, 0});
  const LayeredImage image = render(make_renderer(std::move(scene)), square_on(0.5, 1), photometric(5, 5));
  EXPECT_NEAR(at(image, "pixel_density.projector", 2, 2), 480, 1e-2);

  light.panel_width = light.panel_height = 0;
  const LayeredImage unknown = render(projected(light), square_on(0.5, 1), photometric(3, 3));
  for (const float density : values_of(unknown, "pixel_density.projector")) ASSERT_EQ(density, 0);
}

// ---------------------------------------------------------------------------------------------- colour

// (x, y) of linear Rec. 709, from its primaries' chromaticities (ITU-R BT.709-6, table 1).
glm::dvec2 chromaticity(const glm::vec3& color) {
  const auto column = [](double x, double y) { return glm::dvec3(x / y, 1, (1 - x - y) / y); };
  const glm::dmat3 primaries(column(0.64, 0.33), column(0.30, 0.60), column(0.15, 0.06));
  const glm::dvec3 luminances = glm::inverse(primaries) * column(0.3127, 0.3290);
  const glm::dvec3 xyz = primaries * (luminances * glm::dvec3(color));
  return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

// CIE 015: illuminant A is Planckian at 2856 K; CIE 1931 chromaticities of the Planckian locus (Wyszecki and Stiles, Color
// science, 1982, table 1(3.11)) elsewhere.
TEST(Photometry, ColourTemperaturesHaveTheirPublishedChromaticities) {
  struct Known {
    double kelvin, x, y;
  };
  for (const Known& k :
       {Known{2856, 0.44757, 0.40745}, Known{6504, 0.3135, 0.3237}, Known{2000, 0.5267, 0.4133},
        Known{4000, 0.3805, 0.3768}, Known{10000, 0.2807, 0.2884}}) {
    const glm::vec3 color = color_of_temperature(k.kelvin);
    const glm::dvec2 xy = chromaticity(color);
    EXPECT_NEAR(xy.x, k.x, 3e-4) << k.kelvin;
    EXPECT_NEAR(xy.y, k.y, 3e-4) << k.kelvin;
  }
  for (const double kelvin : {1000.0, 1800.0, 2856.0, 6504.0, 40000.0}) {
    const glm::vec3 color = color_of_temperature(kelvin);
    EXPECT_NEAR(0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b, 1, 1e-6) << kelvin;
    for (int i = 0; i < 3; ++i) EXPECT_GE(color[i], 0) << kelvin;
  }
  EXPECT_EQ(color_of_temperature(500), color_of_temperature(kLeastKelvin));
}

// So a warm lamp of 100 cd still gives 25 lx; what gels take shows.
TEST(Photometry, TemperatureKeepsALampsLuxAndGelsLessenIt) {
  const auto lux = [](const glm::vec3& color) {
    Scene scene = wall_scene();
    Light light = point_light(100);
    light.color = color;
    add_light(scene, light, {0, 0, 2}, {0, 0, 0});
    return at(render(make_renderer(std::move(scene)), square_on(0.5, 1), photometric(3, 3)), "lux.Y", 1, 1);
  };
  EXPECT_NEAR(lux(color_of_temperature(2700)), 25, 1e-4);
  std::map<std::string_view, const Gel*> gels;
  for (const Gel& gel : list_gels()) gels[gel.name] = &gel;
  EXPECT_NEAR(lux(color_of_temperature(2700) * transmission(*gels.at("nd_0.3"))), 25 * std::pow(10, -0.3),
              1e-4);
  // A conversion gel does what it is called for, and passes all of the colour that it passes most of.
  const glm::vec3 blue = transmission(*gels.at("full_ctb"));
  const glm::dvec2 daylight = chromaticity(color_of_temperature(3200) * blue);
  EXPECT_LT(glm::distance(daylight, chromaticity(color_of_temperature(5700))), 1e-6);
  EXPECT_EQ(std::max({blue.r, blue.g, blue.b}), 1);
  EXPECT_LT(lux(color_of_temperature(3200) * blue), 0.4 * 25);
}

// ---------------------------------------------------------------------------------------------- probes

/// A room with lights of every kind and a board that shades some of the floor.
Scene lit_room(bool with_board) {
  Scene scene;
  add_object(scene, "floor", floor(4));
  if (with_board) {
    Mesher board;
    board.quad({-1, 1, 0.5F}, {1, 1, 0.5F}, {1, 1, -0.5F}, {-1, 1, -0.5F});
    add_object(scene, "board", board.primitive);
    scene.materials.back().double_sided = true;
  }
  Light bulb = point_light(150);
  bulb.color = {1, 0.8F, 0.5F};
  add_light(scene, bulb, {1.5, 3, 0.5}, {0, 0, 0});
  Light spot = point_light(400);
  spot.name = "spot";
  spot.type = LightType::spot;
  spot.inner_cone = Angle::degrees(10);
  spot.outer_cone = Angle::degrees(40);
  add_light(scene, spot, {-2, 4, 1}, {0.5, 0, 0});
  Light sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  sun.intensity = 12;
  add_light(scene, sun, {3, 10, 4}, {0, 0, 0});
  Light lantern = projector("lantern", 0.5, 0.4,
                            add_picture(scene, 8, 8, [](int, int) { return glm::u8vec3(255, 128, 64); }));
  lantern.intensity = 90;
  add_light(scene, lantern, {0.3, 4, 2}, {0, 0, 0});
  return scene;
}

// A probe reads what layer lux shows at the same point, and the light-by-light readings sum up to it.
TEST(Photometry, ProbesReadWhatTheLuxLayerShows) {
  for (const bool with_board : {false, true}) {
    const Renderer renderer = make_renderer(lit_room(with_board));
    RenderSettings settings = photometric(61, 61);
    settings.shadows = ShadowTechnique::raytraced;
    settings.layers = {Layer::lux, Layer::position, Layer::object};
    const View view = look({0.5, 5, 5}, {0, 0, 0}, 50, 1);
    const LayeredImage image = render(renderer, view, settings);
    std::vector<Probe> probes;
    std::vector<double> shown;
    for (int i = 0; i < 61 * 61; i += 7) {
      if (at(image, "id.object", i % 61, i / 61) != 0) continue;
      probes.push_back(
          {{at(image, "P.X", i % 61, i / 61), 0, at(image, "P.Z", i % 61, i / 61)}, {0, 2, 0}, 0});
      shown.push_back(at(image, "lux.Y", i % 61, i / 61));
    }
    ASSERT_GT(probes.size(), 300U);
    const ProbeReport report = renderer.measure_probes(probes, {}).value();
    EXPECT_EQ(report.lights, (std::vector<std::string>{"bulb", "spot", "sun", "lantern"}));
    int shaded = 0;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const ProbeReading& reading = report.readings[i];
      EXPECT_NEAR(reading.lux, shown[i], 1e-5 * shown[i] + 1e-6) << i;
      double sum = 0;
      for (const ProbeReading::FromLight& light : reading.lights) sum += light.lux;
      EXPECT_EQ(reading.lux, sum);
      shaded += reading.lights[2].visibility == 0 ? 1 : 0;
    }
    EXPECT_EQ(shaded > 0, with_board);
  }
}

TEST(Photometry, ProbesReadTheSameOnEveryInstructionSetAndThreadCount) {
  const std::vector<Probe> probes =
      probes_on_rectangle({-2, 0.5, 2}, {4, 0, 0}, {0, 0.3, -4}, 37, 19).value();
  std::vector<ProbeReport> reports;
  for (const InstructionSet set : {InstructionSet::scalar, best_instruction_set()}) {
    for (const int threads : {1, 3})
      reports.push_back(make_renderer(lit_room(true), threads, set).measure_probes(probes, {}).value());
  }
  for (const ProbeReport& report : reports) {
    for (std::size_t i = 0; i < probes.size(); ++i) {
      EXPECT_EQ(report.readings[i].lux, reports[0].readings[i].lux);
      EXPECT_EQ(report.readings[i].lights[3].visibility, reports[0].readings[i].lights[3].visibility);
    }
  }
}

// Meters that lie on a wall are not shaded by it, nor by what lies behind; they do see what stands before them. Lights
// whose shadows are off pass through everything, and blended surfaces tint.
TEST(Photometry, ProbesSeeWhatStandsInTheWay) {
  Scene scene = wall_scene();
  const int pane = add_object(scene, "pane", wall(1, 1, 1), {0.25F, 0.25F, 0.25F});
  add_light(scene, point_light(100), {0, 0, 2}, {0, 0, 0});
  const std::vector<Probe> probes = {{{0, 0, 0}, {0, 0, 1}, 0},
                                     {{0, 0, -1e-4}, {0, 0, 1}, 0},
                                     {{0, 0, 1.5}, {0, 0, 1}, 0},
                                     {{0, 0, 0}, {0, 0, -1}, 0}};
  const auto read = [&] {
    std::vector<double> lux;
    const Renderer renderer = make_renderer(scene);
    const ProbeReport report = renderer.measure_probes(probes, {}).value();
    lux.reserve(report.readings.size());
    for (const ProbeReading& reading : report.readings) lux.push_back(reading.lux);
    return lux;
  };
  const std::vector<double> behind = read();
  EXPECT_EQ(behind[0], 0);
  EXPECT_NEAR(behind[2], 400, 1e-3);
  EXPECT_EQ(behind[3], 0);

  Material& glass = scene.materials[1];
  glass.alpha_mode = AlphaMode::blend;
  glass.base_color.a = 0.5F;  // passes 1 − 0.5 (1 − 0.25)
  EXPECT_NEAR(read()[0], 25 * 0.625, 1e-4);

  scene.nodes[static_cast<std::size_t>(pane)].casts_shadow = false;
  EXPECT_NEAR(read()[0], 25, 1e-4);
  EXPECT_NEAR(read()[1], 25, 1e-2);

  scene.nodes[static_cast<std::size_t>(pane)].casts_shadow = true;
  glass.alpha_mode = AlphaMode::opaque;
  scene.lights[0].shadow.technique = ShadowTechnique::none;
  EXPECT_NEAR(read()[0], 25, 1e-4);
}

// A strip of length L, h above a meter: E = (I / L) ∫ h / (h² + x²)^(3/2) dx = I / (h √(h² + L²/4)).
TEST(Photometry, AStripLampAboveAMeterHasItsClosedForm) {
  Scene scene;
  add_object(scene, "floor", floor(4));
  Light strip = point_light(100);
  strip.source.width = 3;
  add_light(scene, strip, {0, 2, 0}, {0, 0, 0}, {0, 0, -1});
  const Renderer renderer = make_renderer(std::move(scene));
  const std::vector<Probe> probes = {{{0, 0, 0}, {0, 1, 0}, 0}};
  const double expected = 100 / (2 * std::sqrt(4 + 9 / 4.0));
  EXPECT_NEAR(renderer.measure_probes(probes, {256})->readings[0].lux, expected, 1e-4 * expected);
  EXPECT_NEAR(renderer.measure_probes(probes, {1})->readings[0].lux, 25, 1e-4);
}

// Every triangle's share of an object's grid is its area, and neighbours do not share a meter.
TEST(Photometry, AGridCoversAnObjectOnce) {
  Scene scene;
  add_object(scene, "box", box({0.3F, 0.2F, 0.1F}, {1, 0.5F, 0.25F}));
  add_object(scene, "ball", sphere({0, 0, 0}, 1, 24));
  const Renderer renderer = make_renderer(std::move(scene));
  const auto area = [&](const char* object) {
    double sum = 0;
    const std::vector<Probe> probes = renderer.probes_on_object(object, 0.02).value();
    for (const Probe& probe : probes) sum += probe.area;
    return sum;
  };
  EXPECT_NEAR(area("box"), 2 * (2 * 1 + 2 * 0.5 + 1 * 0.5), 0.05);
  EXPECT_NEAR(area("ball"), 4 * std::numbers::pi, 0.01 * 4 * std::numbers::pi + 0.2);
  const std::vector<Probe> on_ball = renderer.probes_on_object("ball", 0.1).value();
  for (const Probe& probe : on_ball) {
    EXPECT_NEAR(glm::length(probe.position_ws), 1, 0.02);
    EXPECT_GT(glm::dot(probe.position_ws, probe.normal_ws), 0.9);
  }
  // A square of 1 m that two triangles share along its diagonal, on which the middles of the fields lie.
  Scene flat;
  add_object(flat, "square", wall(0.5F, 0.5F, 0));
  EXPECT_EQ(make_renderer(std::move(flat)).probes_on_object("square", 0.125)->size(), 64U);
}

TEST(Photometry, ReadingsAreWrittenForOtherPrograms) {
  Scene scene = wall_scene();
  Light light = point_light(100);
  light.name = "a, \"b\"";
  add_light(scene, light, {0, 0, 2}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  const std::vector<Probe> probes = probes_on_rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 1, 1).value();
  const ProbeReport report = renderer.measure_probes(probes, {}).value();
  const auto written = [&](const char* ending) {
    const std::string file = ::testing::TempDir() + "readings" + ending;
    EXPECT_TRUE(write_probes(probes, report, file));
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  };
  EXPECT_EQ(written(".csv"),
            "x,y,z,nx,ny,nz,area_m2,lux,\"lux.a, \"\"b\"\"\",\"visibility.a, \"\"b\"\"\"\r\n"
            "0,0,0,0,0,1,4,25,25,1\r\n");
  EXPECT_NE(written(".json").find("\"lights\": {\"a, \\\"b\\\"\": {\"lux\": 25, \"visibility\": 1}}"),
            std::string::npos);
  EXPECT_FALSE(write_probes(probes, report, "readings.txt"));
}

TEST(Photometry, FaultyProbesAreRefused) {
  const Renderer renderer = make_renderer(lit_room(false));
  const auto message = [](const auto& result) { return result ? std::string() : to_string(result.error()); };
  const auto measured = [&](const Probe& probe, int accumulate = 1) {
    return message(renderer.measure_probes(std::vector<Probe>{probe}, {accumulate}));
  };
  EXPECT_EQ(measured({{0, 0, 0}, {0, 0, 0}, 0}), "probes[0]: expected a normal of some length, and finite");
  EXPECT_EQ(measured({{NAN, 0, 0}, {0, 1, 0}, 0}),
            "probes[0]: expected a position within 1e+09 m of the origin");
  EXPECT_EQ(measured({{0, 2e9, 0}, {0, 1, 0}, 0}),
            "probes[0]: expected a position within 1e+09 m of the origin");
  EXPECT_EQ(measured({}, 0), "accumulate: expected 1 to 65536, got 0");
  EXPECT_EQ(measured({{0, 0, 0}, {0, 1, 0}, -1}), "probes[0]: expected an area of at least 0, got -1");
  EXPECT_EQ(message(renderer.probes_on_object("flor", 1)),
            "the scene has no object \"flor\": it has \"floor\"");
  EXPECT_EQ(message(renderer.probes_on_object("floor", 0)),
            "the spacing of probes must be greater than 0, got 0");
  EXPECT_EQ(message(renderer.probes_on_object("floor", 1e-4)),
            "object \"floor\" is so large that a spacing of 0.0001 m makes more than 16777216 probes");
  EXPECT_EQ(message(probes_on_rectangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 3, 3)),
            "the edges of a grid of probes span no area");
  EXPECT_EQ(message(probes_on_rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 0)),
            "a grid of probes must have 1 to 16777216 of them, got 3 x 0");
  EXPECT_TRUE(renderer.measure_probes({}, {})->readings.empty());
}

}  // namespace
}  // namespace laterna
