// Lamp files become distributions: symmetries, orientation, flux, angles.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "reference/lamp_lights.h"
#include "unit/gltf_builder.h"
#include "unit/lamp_texts.h"

namespace laterna {
namespace {

using namespace testing_lamps;
using testing_scenes::GltfBuilder;
using testing_scenes::json;
using testing_scenes::load_or_fail;
using testing_scenes::triangle_builder;

constexpr double kPi = 3.14159265358979323846;

double toward(const LightDistribution& lamp, double x, double y, double z) {
  return candela_toward(lamp, glm::normalize(glm::dvec3(x, y, z)));
}

// Lumens of beams that can be integrated by hand.
TEST(Lamps, FluxIsTheIntegralOverAllDirections) {
  IesText even;
  even.vertical = angles(0, 180, 5);
  EXPECT_NEAR(luminous_flux(parse_or_fail(even.text())), 400 * kPi, 1e-9);
  IesText lambert;
  lambert.vertical = angles(0, 90, 901);
  lambert.candela = [](double v, double) { return 100 * std::cos(v * kPi / 180); };
  EXPECT_NEAR(luminous_flux(parse_or_fail(lambert.text())), 100 * kPi, 1e-4);
  // I = 100 (1 − γ/90°): 2π ∫ 100 (1 − 2γ/π) sin γ dγ = 200 π (1 − 2/π).
  IesText tent;
  tent.vertical = {0, 90};
  tent.candela = [](double v, double) { return v == 0 ? 100.0 : 0.0; };
  EXPECT_NEAR(luminous_flux(parse_or_fail(tent.text())), 200 * kPi * (1 - 2 / kPi), 1e-9);
  for (const int type : {2, 3}) {  // all directions ahead
    IesText half;
    half.type = type;
    half.vertical = half.horizontal = angles(-90, 90, 7);
    EXPECT_NEAR(luminous_flux(parse_or_fail(half.text())), 200 * kPi, 1e-9) << type;
    half.candela = [](double v, double h) { return 60 + v / 3 + h / 4; };
    const LightDistribution lamp = parse_or_fail(half.text());
    EXPECT_NEAR(luminous_flux(lamp), reference::flux_by_directions(lamp, 200000), 1e-3 * luminous_flux(lamp))
        << type;
  }
}

// SPEC's conventions: 1000 lm within 20° are 2639 cd.
TEST(Lamps, LumensOfACone) {
  EXPECT_NEAR(candela_of_cone(1000, Angle::degrees(20)), 2639, 0.5);
  EXPECT_NEAR(lumens_of_cone(candela_of_cone(1000, Angle::degrees(20)), Angle::degrees(20)), 1000, 1e-9);
  EXPECT_NEAR(lumens_of_cone(1, Angle::degrees(180)), 4 * kPi, 1e-12);
}

// Photometric zero is −Z; C0 is +X and C90 +Y.
TEST(Lamps, TypeCLooksDownMinusZWithC0AlongX) {
  IesText ies;
  ies.vertical = angles(0, 180, 19);
  ies.horizontal = angles(0, 360, 13);
  ies.candela = [](double v, double h) { return 1000 + v + 2 * (h == 360 ? 0 : h); };
  const LightDistribution lamp = parse_or_fail(ies.text());
  EXPECT_NEAR(toward(lamp, 1, 0, 0), 1000 + 90, 1e-9);
  EXPECT_NEAR(toward(lamp, 0, 1, 0), 1000 + 90 + 180, 1e-9);
  EXPECT_NEAR(toward(lamp, -1, 0, 0), 1000 + 90 + 360, 1e-9);
  EXPECT_NEAR(toward(lamp, 0, -1, 0), 1000 + 90 + 540, 1e-9);
  EXPECT_NEAR(toward(lamp, 1, 0, -1), 1000 + 45, 1e-9);
  EXPECT_NEAR(toward(lamp, 1e-9, 0, -1), 1000, 1e-6);
  EXPECT_NEAR(toward(lamp, 1e-9, 0, 1), 1180, 1e-6);
  const LampSummary summary = summarise(lamp);
  EXPECT_NEAR(summary.peak_cd, 1000 + 180 + 660, 1e-9);
}

// EXT_lights_ies: zero of both angles is −Z, vertical angles lie in the X–Z plane, horizontal ones turn clockwise.
TEST(Lamps, TypesAAndBTurnAboutTheirOwnAxes) {
  for (const int type : {2, 3}) {
    IesText ies;
    ies.type = type;
    ies.vertical = ies.horizontal = angles(-90, 90, 37);
    ies.candela = [](double v, double h) { return 1000 + v + 2 * h; };
    const LightDistribution lamp = parse_or_fail(ies.text());
    EXPECT_EQ(lamp.type, type == 2 ? PhotometricType::type_b : PhotometricType::type_a);
    EXPECT_NEAR(toward(lamp, 0, 0, -1), 1000, 1e-9) << type;
    EXPECT_NEAR(toward(lamp, 1, 0, -1), 1045, 1e-9) << type;
    EXPECT_NEAR(toward(lamp, 0, -1, -1), 1090, 1e-9) << type;
    EXPECT_EQ(toward(lamp, 0.1, 0.1, 1), 0) << type;
    // (0.5, −0.5, −√½): type A has V = 30°, H = atan(1/√2); type B has H = 30°, V = atan(1/√2).
    const double other = std::atan(std::sqrt(0.5)) * 180 / kPi;
    EXPECT_NEAR(toward(lamp, 0.5, -0.5, -std::sqrt(0.5)), type == 3 ? 1030 + 2 * other : 1060 + other, 1e-6)
        << type;
    for (const double v : {-80.0, -33.0, 0.0, 61.0}) {
      for (const double h : {-71.0, 0.0, 12.0}) {
        EXPECT_NEAR(candela_toward(lamp, lamp_direction(lamp.type, v, h)), 1000 + v + 2 * h, 1e-6);
      }
    }
    // Only the right half listed: left is like right.
    ies.horizontal = angles(0, 90, 10);
    EXPECT_NEAR(toward(parse_or_fail(ies.text()), 0, 1, -1), 1090, 1e-9) << type;
  }
}

struct Symmetry {
  const char* name;
  int ldt;             // Isym
  double first, last;  // planes of the IES file
  int count;
  Candela candela;
};

// What a symmetry leaves out is as it was: every kind in both formats against the same whole distribution.
TEST(Lamps, SymmetriesAreWrittenOut) {
  const auto radians = [](double degrees) { return degrees * kPi / 180; };
  const auto base = [=](double v) { return 200 + 100 * std::cos(radians(v)); };
  const Symmetry symmetries[] = {
      {"all round", 1, 0, 0, 1, [=](double v, double) { return base(v); }},
      {"about C0", 2, 0, 180, 13,
       [=](double v, double h) { return base(v) + 50 * std::cos(radians(h)) * std::sin(radians(v)); }},
      {"about C90", 3, 90, 270, 13,
       [=](double v, double h) { return base(v) + 50 * std::sin(radians(h)) * std::sin(radians(v)); }},
      {"about both", 4, 0, 90, 7,
       [=](double v, double h) { return base(v) + 50 * std::cos(radians(2 * h)) * std::sin(radians(v)); }},
      {"none", 0, 0, 360, 25,
       [=](double v, double h) { return base(v) + 50 * std::sin(radians(h) + 1) * std::sin(radians(v)); }},
      {"without 360", 0, 0, 345, 24,
       [=](double v, double h) { return base(v) + 50 * std::sin(radians(h) + 1) * std::sin(radians(v)); }}};
  for (const Symmetry& symmetry : symmetries) {
    IesText ies;
    ies.vertical = angles(0, 180, 37);
    ies.horizontal = angles(symmetry.first, symmetry.last, symmetry.count);
    ies.candela = symmetry.candela;
    LdtText ldt;
    ldt.symmetry = symmetry.ldt;
    ldt.value = [&](double v, double h) { return symmetry.candela(v, h) / 2; };  // of 2000 lm
    const LightDistribution a = parse_or_fail(ies.text()), b = parse_or_fail(ldt.text(), "lamp.ldt");
    EXPECT_EQ(find_fault(a), "");
    EXPECT_EQ(find_fault(b), "");
    for (const double v : {0.0, 35.0, 90.0, 140.0, 180.0}) {
      for (double h = 0; h < 360; h += 15) {
        const glm::dvec3 direction = lamp_direction(PhotometricType::type_c, v, h);
        EXPECT_NEAR(candela_toward(a, direction), symmetry.candela(v, h), 1e-4)
            << symmetry.name << v << " " << h;
        EXPECT_NEAR(candela_toward(b, direction), symmetry.candela(v, h), 1e-4)
            << symmetry.name << v << " " << h;
      }
    }
    EXPECT_NEAR(luminous_flux(a), reference::flux_by_directions(a, 200000), 1e-3 * luminous_flux(a))
        << symmetry.name;
  }
}

// Multiplier, ballast factor and, up to 1995, the ballast-lamp factor; feet and metres; lamp lumens.
TEST(Lamps, EditionsOfLm63) {
  IesText ies;
  ies.lamps_and_lumens = "2 500", ies.multiplier = "1.5", ies.factors = "0.9 0.8 15";
  ies.unit_and_opening = "1 1 -2 3";
  const auto peak = [&](const char* first_line) {
    ies.first_line = first_line;
    const LightDistribution lamp = parse_or_fail(ies.text());
    EXPECT_EQ(lamp.rated_lumens, 1000);
    EXPECT_EQ(lamp.watts, 15);
    EXPECT_NEAR(glm::distance(lamp.opening_m, glm::dvec3(-0.6096, 0.3048, 0.9144)), 0, 1e-12);
    return summarise(lamp).peak_cd;
  };
  EXPECT_NEAR(peak("IESNA:LM-63-1986"), 108, 1e-9);
  EXPECT_NEAR(peak("IESNA91"), 108, 1e-9);
  EXPECT_NEAR(peak("IESNA:LM-63-1995"), 108, 1e-9);
  EXPECT_NEAR(peak("IESNA:LM-63-2002"), 135, 1e-9);
  EXPECT_NEAR(peak("IES:LM-63-2019"), 135, 1e-9);
  EXPECT_NEAR(peak("A lamp of 1986, told in its own words"), 108, 1e-9);
  EXPECT_EQ(parse_or_fail(ies.text()).format, "LM-63-1986");
  ies.lamps_and_lumens = "1 -1";
  EXPECT_FALSE(parse_or_fail(ies.text()).rated_lumens.has_value());
  EXPECT_EQ(parse_or_fail(ies.text()).luminaire, "Nobody, Lamp");
}

TEST(Lamps, NumbersMayStandOnAnyLine) {
  IesText ies;
  std::string text = ies.text();
  const std::size_t data = text.find("TILT=NONE\n") + 10;
  std::string spread = text.substr(0, data), commas = spread;
  for (const char c : text.substr(data)) {
    spread += c == ' ' ? std::string("\r\n\r\n  ") : std::string(1, c);
    commas += c == ' ' ? std::string(" ,") : std::string(1, c);
  }
  for (const std::string& variant :
       {spread, commas, text + "\x1A", text + std::string(60, '\0'), "\xEF\xBB\xBF" + text}) {
    EXPECT_EQ(parse_or_fail(variant).candela, parse_or_fail(text).candela);
  }
}

TEST(Lamps, TiltIsReadFromTheFileOrBesideIt) {
  const TemporaryFolder folder;
  IesText ies;
  ies.tilt = "TILT=INCLUDE\n1\n3\n0 45 90\n1.0 0.95 0.9\n";
  const std::vector<std::array<double, 2>> expected = {{0, 1}, {45, 0.95}, {90, 0.9}};
  EXPECT_EQ(parse_or_fail(ies.text()).tilt, expected);
  folder.write("factors.tlt", "1\n3\n0 45 90\n1.0 0.95 0.9\n");
  ies.tilt = "TILT=factors.tlt\n";
  EXPECT_EQ(parse_or_fail(ies.text(), "lamp.ies", folder.path()).tilt, expected);
  EXPECT_EQ(summarise(parse_or_fail(ies.text(), "lamp.ies", folder.path())).peak_cd, 100);
}

TEST(Lamps, EulumdatIsCandelaForAThousandLumens) {
  LdtText ldt;
  ldt.lumens = "2500", ldt.factor = "0,5";
  const LightDistribution lamp = parse_or_fail(ldt.text(), "LAMP.LDT");
  EXPECT_NEAR(summarise(lamp).peak_cd, 125, 1e-9);
  EXPECT_EQ(lamp.rated_lumens, 2500);
  EXPECT_EQ(lamp.watts, 15.5);
  EXPECT_EQ(lamp.luminaire, "Nobody, Lamp");
  ldt.lamps = "-1";  // absolute
  EXPECT_FALSE(parse_or_fail(ldt.text(), "lamp.ldt").rated_lumens.has_value());
  ldt.end_of_line = "\n";
  EXPECT_EQ(parse_or_fail(ldt.text(), "without an ending").format, "EULUMDAT");
}

// Full angles between the outermost directions with 50 % and 10 % of the peak.
TEST(Lamps, BeamAndFieldAngles) {
  IesText tent;  // falls evenly from 1000 cd on the axis to 0 at 50°
  tent.vertical = angles(0, 90, 10);
  tent.candela = [](double v, double) { return std::max(0.0, 1000 - 20 * v); };
  for (const LampSection& section : summarise(parse_or_fail(tent.text())).sections) {
    EXPECT_NEAR(section.beam_angle_deg.value(), 50, 1e-5);
    EXPECT_NEAR(section.field_angle_deg.value(), 90, 1e-5);
    EXPECT_NEAR(section.peak_cd, 1000, 1e-9);
  }
  IesText ceiling = tent;  // the same, and more than a tenth of it upward
  ceiling.vertical = angles(0, 180, 19);
  ceiling.candela = [](double v, double) { return v > 90 ? 300 : std::max(0.0, 1000 - 20 * v); };
  EXPECT_NEAR(summarise(parse_or_fail(ceiling.text())).sections[0].field_angle_deg.value(), 90, 1e-5);
  IesText up = tent;  // the same, upward
  up.vertical = angles(90, 180, 10);
  up.candela = [](double v, double) { return std::max(0.0, 1000 - 20 * (180 - v)); };
  EXPECT_NEAR(summarise(parse_or_fail(up.text())).sections[1].beam_angle_deg.value(), 50, 1e-5);
  IesText oval = tent;  // twice as wide along C0; C90 keeps to itself
  oval.horizontal = angles(0, 90, 2);
  oval.candela = [](double v, double h) { return std::max(0.0, 1000 - (h == 0 ? 12.5 : 25) * v); };
  const LampSummary summary = summarise(parse_or_fail(oval.text()));
  EXPECT_NEAR(summary.sections[0].beam_angle_deg.value(), 80, 1e-5);
  EXPECT_NEAR(summary.sections[1].beam_angle_deg.value(), 40, 1e-5);
  EXPECT_NEAR(summary.sections[0].field_angle_deg.value(), 144, 1e-5);
  // A section that stays below half of the lamp's peak has no beam angle; ends of the grid are edges.
  IesText side = tent;
  side.horizontal = angles(0, 180, 3);
  side.candela = [](double v, double h) { return v == 60 && h == 180 ? 1000.0 : 300.0; };
  const LampSummary odd = summarise(parse_or_fail(side.text()));
  EXPECT_FALSE(odd.sections[1].beam_angle_deg.has_value());
  EXPECT_NEAR(odd.sections[1].field_angle_deg.value(), 180, 1e-5);
  EXPECT_NEAR(odd.sections[0].beam_angle_deg.value(), 20 * 500.0 / 700,
              1e-5);  // 10° to each side of the peak at 60°
  for (const int type : {2, 3}) {
    IesText flood;
    flood.type = type;
    flood.vertical = flood.horizontal = angles(-90, 90, 19);
    flood.candela = [](double v, double h) {
      return std::max(0.0, 1000 - 20 * std::abs(v) - 10 * std::abs(h));
    };
    const LampSummary s = summarise(parse_or_fail(flood.text()));
    EXPECT_NEAR(s.sections[0].beam_angle_deg.value(), 50, 1e-5);
    EXPECT_NEAR(s.sections[1].beam_angle_deg.value(), 100, 1e-5);
  }
}

Scene rig_with(const TemporaryFolder& folder, const std::string& light) {
  return load_or_fail({}, {.rigs = {folder.write("rig.json", R"({"lights": [{)" + light + "}]}")}});
}

glm::dvec3 axis_ws(const Scene& scene, int axis) { return {scene.nodes.at(0).parent_from_node[axis]}; }

TEST(Lamps, InARig) {
  const TemporaryFolder folder;
  IesText ies;
  ies.candela = [](double v, double) { return v < 40 ? 500.0 : 0.0; };
  folder.write("lamp.ies", ies.text());
  // Hanging: −Z down, C0 along +X.
  Scene scene = rig_with(folder, R"("type": "point", "position": [1, 3, 2], "ies": "lamp.ies")");
  ASSERT_NE(scene.lights.at(0).distribution, nullptr);
  EXPECT_EQ(scene.lights[0].intensity, 1);
  EXPECT_EQ(axis_ws(scene, 0), glm::dvec3(1, 0, 0));
  EXPECT_EQ(axis_ws(scene, 1), glm::dvec3(0, 0, -1));
  EXPECT_EQ(axis_ws(scene, 2), glm::dvec3(0, 1, 0));
  EXPECT_EQ(axis_ws(scene, 3), glm::dvec3(1, 3, 2));
  // Aimed, and scaled.
  scene = rig_with(
      folder,
      R"("type": "point", "position": [0, 3, 0], "target": [0, 3, -5], "ies": "lamp.ies", "scale": 2.5)");
  EXPECT_EQ(axis_ws(scene, 2), glm::dvec3(0, 0, 1));
  EXPECT_EQ(scene.lights.at(0).intensity, 2.5);
  scene = rig_with(folder, R"("type": "point", "position": [0, 3, 0], "ies": "lamp.ies", "lumens": 800)");
  EXPECT_EQ(scene.lights.at(0).lumens, 800);
  // A spot's cone is the lamp's own: light ends at the angle after the last that is lit.
  scene =
      rig_with(folder, R"("type": "spot", "position": [0, 3, 0], "target": [0, 0, 0], "ies": "lamp.ies")");
  EXPECT_EQ(scene.lights.at(0).type, LightType::spot);
  EXPECT_NEAR(scene.lights[0].inner_cone.in_degrees(), 40, 1e-9);
  EXPECT_GT(scene.lights[0].outer_cone.in_degrees(), 40);
  EXPECT_LT(scene.lights[0].outer_cone.in_degrees(), 41);
  scene = rig_with(
      folder,
      R"("type": "spot", "position": [0, 3, 0], "target": [0, 0, 0], "ies": "lamp.ies", "outer_cone_deg": 20)");
  EXPECT_NEAR(scene.lights.at(0).outer_cone.in_degrees(), 20, 1e-9);
  ies.vertical = angles(0, 180, 19);
  ies.candela = [](double, double) { return 5.0; };
  folder.write("lamp.ies", ies.text());
  scene =
      rig_with(folder, R"("type": "spot", "position": [0, 3, 0], "target": [0, 0, 0], "ies": "lamp.ies")");
  EXPECT_EQ(scene.lights.at(0).type, LightType::point);
  // Floodlights: vertical angles grow upward (+X of EXT_lights_ies turned to the rig's up).
  ies.type = 2;
  ies.vertical = ies.horizontal = angles(-90, 90, 5);
  folder.write("lamp.ies", ies.text());
  scene =
      rig_with(folder, R"("type": "point", "position": [0, 3, 0], "target": [0, 3, -5], "ies": "lamp.ies")");
  EXPECT_EQ(axis_ws(scene, 0), glm::dvec3(0, 1, 0));
  EXPECT_EQ(axis_ws(scene, 1), glm::dvec3(-1, 0, 0));
}

TEST(Lamps, InAGltf) {
  const TemporaryFolder folder;
  const std::string text = IesText().text();
  folder.write("lamp.ies", text);
  GltfBuilder builder = triangle_builder();
  const int view = builder.view(testing_scenes::bytes_of(std::vector<char>(text.begin(), text.end())));
  builder.document["extensionsUsed"] = {"EXT_lights_ies", "KHR_lights_punctual"};
  builder.document["extensionsRequired"] = {"EXT_lights_ies"};
  builder.document["extensions"] = {
      {"KHR_lights_punctual", {{"lights", {{{"type", "point"}, {"name", "bulb"}}}}}},
      {"EXT_lights_ies",
       {{"lights",
         {{{"uri", "lamp.ies"}, {"name", "downlight"}},
          {{"bufferView", view}, {"mimeType", "application/x-ies-lm-63"}},
          {{"uri", "data:application/octet-stream;base64," +
                       testing_scenes::base64(std::as_bytes(std::span(text)))}}}}}}};
  builder.add("nodes", {{"name", "a"},
                        {"extensions",
                         {{"EXT_lights_ies", {{"light", 0}, {"multiplier", 3.0}, {"color", {1, 0.5, 0}}}}}}});
  builder.add("nodes", {{"name", "b"}, {"extensions", {{"EXT_lights_ies", {{"light", 1}}}}}});
  builder.add("nodes", {{"name", "c"},
                        {"extensions",
                         {{"EXT_lights_ies", {{"light", 2}}}, {"KHR_lights_punctual", {{"light", 0}}}}}});
  const Scene scene = builder.load(folder);
  EXPECT_EQ(testing_scenes::warnings_of(scene), "");
  ASSERT_EQ(scene.lights.size(), 4U);
  const Light& a = scene.lights[0];
  EXPECT_EQ(a.name, "downlight");
  EXPECT_EQ(a.type, LightType::point);
  EXPECT_EQ(a.intensity, 3);
  EXPECT_EQ(a.color, glm::vec3(1, 0.5F, 0));
  EXPECT_EQ(a.attenuation, Attenuation::inverse_square);
  for (const int light : {0, 1, 3}) {
    const auto& lamp = scene.lights[static_cast<std::size_t>(light)].distribution;
    ASSERT_NE(lamp, nullptr);
    EXPECT_EQ(lamp->candela, parse_or_fail(text).candela);
  }
  EXPECT_EQ(scene.lights[1].name, "b");
  EXPECT_EQ(scene.lights[2].name, "bulb");
  EXPECT_EQ(scene.lights[2].distribution, nullptr);
  // The node has one light already: the lamp hangs below it.
  EXPECT_EQ(scene.lights[3].name, "c");
  const Node& child = scene.nodes.back();
  EXPECT_EQ(child.light, 3);
  EXPECT_EQ(scene.nodes.at(static_cast<std::size_t>(child.parent)).name, "c");
}

}  // namespace
}  // namespace laterna
