// Lamps as they are measured, and light as meters read it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "laterna/false_color.h"
#include "laterna/light_color.h"
#include "laterna/probes.h"
#include "paintings.h"
#include "sets.h"

namespace laterna::app {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---------------------------------------------------------------------------------------------- measured lamps

/// Angles from `first` to `last`, both included.
std::vector<double> angles(double first, double last, double step) {
  std::vector<double> list;
  for (int i = 0; first + i * step <= last + 1e-9; ++i) list.push_back(first + i * step);
  return list;
}

double cosine(double degrees) { return point_of_circle(degrees / 360).x; }

/// 1 in the middle, ¼ at ±1, and soon nothing.
double bell(double x) { return 1 / ((1 + x * x) * (1 + x * x)); }

/// A lamp from a formula: candela of a vertical and a horizontal angle in degrees.
LightDistribution lamp(const char* luminaire, PhotometricType type, std::vector<double> vertical,
                       std::vector<double> horizontal,
                       double (*candela)(double vertical, double horizontal)) {
  LightDistribution made;
  made.name = luminaire;
  made.format = "formula";
  made.luminaire = luminaire;
  made.type = type;
  made.vertical_deg = std::move(vertical);
  made.horizontal_deg = std::move(horizontal);
  for (const double h : made.horizontal_deg) {
    for (const double v : made.vertical_deg) made.candela.push_back(candela(v, h));
  }
  return made;
}

/// Light to the side of C90, as for lighting walls.
LightDistribution wall_washer() {
  return lamp("Wall washer, type C", PhotometricType::type_c, angles(0, 90, 2.5), angles(0, 360, 10),
              [](double vertical, double horizontal) {
                const double toward = 0.5 + 0.5 * cosine(horizontal - 90);
                return 900 * bell((vertical - 38) / 26) * toward * toward + 250 * bell(vertical / 25);
              });
}

LightDistribution floodlight() {
  return lamp("Floodlight, type B", PhotometricType::type_b, angles(-90, 90, 2.5), angles(-90, 90, 2.5),
              [](double vertical, double horizontal) {
                return 2400 * bell(horizontal / 42) * bell((vertical + 4) / (vertical < -4 ? 22.0 : 9.0));
              });
}

/// Wide and flat, cut off above.
LightDistribution fog_lamp() {
  return lamp("Fog lamp, type A", PhotometricType::type_a, angles(-90, 90, 1), angles(-90, 90, 2.5),
              [](double vertical, double horizontal) {
                const double below = -vertical - 1;
                return below < 0 ? 12.0 : 12 + 4200 * bell(horizontal / 38) * bell((below - 2) / 6);
              });
}

/// A room's end, 5 m wide.
Shot room_end() {
  Shot shot;
  Scene& scene = shot.scene;
  set_mood(scene, 0);
  scene.ambient = glm::vec3(0.6F);
  scene.background = glm::vec3(0);
  const int plaster = add_material(scene, "plaster", glm::vec3(0.75F));
  add_object(scene, "wall", rectangle({0, 1.4F, -1.5F}, {1, 0, 0}, {0, 1, 0}, {5, 2.8F}, 1), plaster);
  add_object(scene, "floor", rectangle({0, 0, 0.5F}, {1, 0, 0}, {0, 0, -1}, {5, 4}, 1), plaster);
  shot.camera = {{0, 1.5, 5.0}, {0, 1.15, -1.5}};
  return shot;
}

/// Turned about its beam as files mean it: what is written as upward is up.
Light& add_measured_lamp(Scene& scene, const LightDistribution& distribution, Gaze gaze) {
  Light& light = add_lamp(scene, "lamp", gaze, Angle::degrees(90), glm::vec3(1));
  light.type = LightType::point;
  light.attenuation = Attenuation::inverse_square;
  light.distribution = std::make_shared<const LightDistribution>(distribution);
  if (distribution.type != PhotometricType::type_c) {  // vertical angles grow toward +X
    const glm::dmat4 quarter(glm::dvec4(0, 1, 0, 0), glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 0, 1, 0),
                             glm::dvec4(0, 0, 0, 1));
    scene.nodes.back().parent_from_node = scene.nodes.back().parent_from_node * quarter;
  }
  return light;
}

std::string describe(const LightDistribution& lamp) {
  const LampSummary s = summarise(lamp);
  const auto angle = [](const std::optional<double>& degrees) {
    return degrees ? fmt::format("{:.0f}°", *degrees) : std::string("none");
  };
  return fmt::format(
      "{}: {:.0f} lm, peak {:.0f} cd; half of the peak within {} by {}, a tenth within {} by {}.",
      lamp.luminaire, s.flux_lm, s.peak_cd, angle(s.sections[0].beam_angle_deg),
      angle(s.sections[1].beam_angle_deg), angle(s.sections[0].field_angle_deg),
      angle(s.sections[1].field_angle_deg));
}

void draw_measured_lamps(Sitting& sitting) {
  struct Hung {
    LightDistribution lamp;
    Gaze gaze;
    double stops;
    const char* sight;
  };
  const std::array<Hung, 3> hung = {
      {{wall_washer(), {{0, 2.6, -0.5}, {0, 0, -0.5}}, -8.2, "Hung 1 m before a wall, C90 toward it."},
       {floodlight(),
        {{0, 1.4, 1.2}, {0, 1.4, -1.5}},
        -8.2,
        "Aimed square at the wall from 2.7 m: wide, flat, and more below."},
       {fog_lamp(),
        {{0, 1.0, 1.6}, {0, 1.0, -1.5}},
        -8.2,
        "Level, 1 m above the floor: above 1° below the level hardly anything."}}};
  for (const Hung& each : hung) {
    sitting.polar_plot(describe(each.lamp), each.lamp);
    Shot shot = room_end();
    add_measured_lamp(shot.scene, each.lamp, each.gaze);
    shot.stops = each.stops;
    sitting.picture(each.sight, shot);
  }
}

// ---------------------------------------------------------------------------------------------- lux

/// A hall with a projection screen, 3,000 lm on 2.0 × 1.125 m, and two lamps over the solids.
Shot lit_hall() {
  Shot shot = solids_set();
  Scene& scene = shot.scene;
  scene.ambient = glm::vec3(0);
  scene.background = glm::vec3(0);
  add_object(scene, "wall", rectangle({0, 1.5F, -2.4F}, {1, 0, 0}, {0, 1, 0}, {8, 3}, 1),
             add_material(scene, "whitewash", glm::vec3(0.7F)));
  Light& lantern =
      add_projector(scene, "projector", {{0, 1.55, 0.6}, {0, 1.55, -2.4}}, Angle::degrees(30), -1);
  lantern.aspect_from_slide = false;
  lantern.projection = Projection::from_throw_ratio(1.5, 16.0 / 9, 0.1, kInfinity);
  lantern.lumens = 3000;
  lantern.attenuation = Attenuation::inverse_square;
  add_two_lamps(scene);
  for (std::size_t i = 1; i < scene.lights.size(); ++i) {
    scene.lights[i].attenuation = Attenuation::inverse_square;
    scene.lights[i].intensity = 12000;
    scene.lights[i].color = color_of_temperature(i == 1 ? 2700 : 5600);
  }
  shot.camera = {{1.6, 2.2, 4.6}, {0, 0.75, -0.7}};
  shot.stops = -10;
  return shot;
}

/// Readings of a grid as colours, a square for each.
LayeredImage meters(const ProbeReport& report, int across, int down) {
  LayeredImage image;
  image.width = across;
  image.height = down;
  Channel& lux = image.channels.emplace_back(Channel{"lux.Y", {}});
  // Rows of probes run upward.
  for (int y = down - 1; y >= 0; --y) {
    for (int x = 0; x < across; ++x)
      lux.values.push_back(static_cast<float>(report.readings[static_cast<std::size_t>(y * across + x)].lux));
  }
  return image;
}

/// Each pixel `factor` × `factor` times.
LayeredImage magnified(const LayeredImage& image, int factor) {
  LayeredImage large;
  large.width = image.width * factor;
  large.height = image.height * factor;
  for (const Channel& channel : image.channels) {
    Channel& to = large.channels.emplace_back(Channel{channel.name, {}});
    for (int y = 0; y < large.height; ++y) {
      for (int x = 0; x < large.width; ++x)
        to.values.push_back(channel.values[static_cast<std::size_t>(y / factor * image.width + x / factor)]);
    }
  }
  return large;
}

void draw_grid_of_meters(Sitting& sitting, const Shot& shot) {
  const std::optional<Drawing> drawing = sitting.prepare(shot);
  if (!drawing) return;
  const auto read = [&](glm::dvec3 corner, glm::dvec3 right, glm::dvec3 up, int across,
                        int down) -> std::optional<std::pair<ProbeSummary, LayeredImage>> {
    const auto probes = sitting.accept(probes_on_rectangle(corner, right, up, across, down));
    if (!probes) return std::nullopt;
    const auto measured = sitting.accept(drawing->renderer.measure_probes(*probes, {}));
    if (!measured) return std::nullopt;
    return std::pair(summarise(*probes, *measured), meters(*measured, across, down));
  };
  const auto floor = read({-2, 0, 2}, {4, 0, 0}, {0, 0, -3}, 32, 24);
  if (!floor) return;
  const ProbeSummary& f = floor->first;
  sitting.print(fmt::format("32 × 24 meters on the floor's 4 × 3 m, as from above: {:.0f} to {:.0f} lx, mean "
                            "{:.0f}, {:.0f} lm in all.",
                            f.least, f.greatest, f.mean, f.lumens),
                false_color_picture(magnified(floor->second, 16), "lux.Y", {0, "lx", false}));
}

/// What the projector alone gives on its picture, which is 2.0 × 1.125 m.
std::string projector_alone(Sitting& sitting, Shot shot) {
  for (std::size_t i = 1; i < shot.scene.lights.size(); ++i) shot.scene.lights[i].enabled = false;
  const std::optional<Drawing> drawing = sitting.prepare(shot);
  if (!drawing) return {};
  const auto probes =
      sitting.accept(probes_on_rectangle({-1, 0.9875, -2.4}, {2, 0, 0}, {0, 1.125, 0}, 16, 9));
  const auto read = probes ? sitting.accept(drawing->renderer.measure_probes(*probes, {})) : std::nullopt;
  if (!read) return {};
  const ProbeSummary s = summarise(*probes, *read);
  return fmt::format("{:.0f} to {:.0f} lx at 16 × 9 meters", s.least, s.greatest);
}

void draw_lux(Sitting& sitting) {
  Shot shot = lit_hall();
  sitting.picture(
      fmt::format("A projector of 3,000 lm on 2.0 × 1.125 m, and two lamps of 12,000 cd, 2700 K and 5600 K. "
                  "Alone, the projector gives {}: 3,000 / 2.25 = 1,333.",
                  projector_alone(sitting, shot)),
      shot);
  sitting.false_color("Illuminance of every surface, with iso-lines.", shot,
                      {Layer::lux, "lux.Y", "lx", 2000});
  Shot physical = shot;
  physical.settings.shading = ShadingModel::pbr;
  sitting.false_color("Luminance, what the camera sees of it.", physical,
                      {Layer::luminance, "luminance.Y", "cd/m2", 500});
  draw_grid_of_meters(sitting, shot);
}

// ---------------------------------------------------------------------------------------------- headlights

constexpr float kLampHeight = 0.65F;
constexpr float kWallDistance = 25;

/// Two dipped beams on a road, and a wall 25 m ahead.
Shot headlights_on_a_wall() {
  Shot shot;
  Scene& scene = shot.scene;
  scene.ambient_is_set = true;
  scene.ambient = glm::vec3(0.03F, 0.035F, 0.05F);
  scene.background = glm::vec3(0.01F, 0.012F, 0.02F);
  add_object(scene, "road", rectangle({0, 0, -12}, {1, 0, 0}, {0, 0, -1}, {14, 30}, 2),
             add_material(scene, "asphalt", glm::vec3(0.22F)));
  Primitive lines;
  for (int dash = 0; dash < 9; ++dash) {
    const float z = -2.8F * static_cast<float>(dash);
    append(lines, rectangle({-1.9F, 0.004F, z}, {1, 0, 0}, {0, 0, -1}, {0.12F, 1.4F}, 1));
  }
  add_object(scene, "lines", lines, add_material(scene, "paint", glm::vec3(0.75F)));
  add_object(scene, "wall", rectangle({0, 2, -kWallDistance}, {1, 0, 0}, {0, 1, 0}, {14, 4}, 1),
             add_material(scene, "render", glm::vec3(0.55F)));
  const int beam = add_picture(scene, "dipped beam", paint_dipped_beam(1024));
  for (const double x : {-0.6, 0.6}) {
    Light& light = add_projector(scene, x < 0 ? "left" : "right", {{x, kLampHeight, 0}, {x, kLampHeight, -1}},
                                 Angle::degrees(20), beam);
    Projection& frame = light.projection;
    frame.right = static_cast<double>(kDippedBeam.right);
    frame.left = -frame.right;
    frame.top = static_cast<double>(kDippedBeam.top);
    frame.bottom = static_cast<double>(kDippedBeam.bottom);
    light.aspect_from_slide = false;
    light.slide_is_intensity = true;
    light.intensity = 24000;
    light.color = color_of_temperature(3200);
    light.attenuation = Attenuation::inverse_square;
  }
  shot.camera = {{-0.35, 1.25, 1.2}, {-0.2, 0.9, -12}};
  shot.stops = -4;
  return shot;
}

/// The cut-off as the regulation has it, in dashes on the wall, for a car between its two lamps.
void mark_cut_off(Scene& scene) {
  const float z = -kWallDistance + 0.012F;
  const float level = kLampHeight - 0.01F * kWallDistance;
  const glm::vec2 rising(point_of_circle(15.0 / 360));
  Primitive marks;
  for (int dash = 0; dash < 9; ++dash) {
    const float along = 0.25F + 0.6F * static_cast<float>(dash);
    append(marks, rectangle({-along, level, z}, {1, 0, 0}, {0, 1, 0}, {0.28F, 0.03F}, 1));
    append(marks, rectangle({rising.x * along, level + rising.y * along, z}, {rising.x, rising.y, 0},
                            {-rising.y, rising.x, 0}, {0.28F, 0.03F}, 1));
  }
  const int paint = add_material(scene, "mark", {1.0F, 0.12F, 0.08F});
  scene.materials[static_cast<std::size_t>(paint)].emissive = {24.0F, 1.0F, 0.5F};
  scene.nodes[static_cast<std::size_t>(add_object(scene, "marks", marks, paint))].casts_shadow = false;
}

/// How far below the lamps light begins on the wall at `x`, in metres: about which tenth of a metre it falls most.
double cut_off_below_lamps(Sitting& sitting, const Renderer& renderer, double x) {
  constexpr int kMeters = 400;
  constexpr double kLow = 0.1, kHigh = 1.1;
  constexpr std::size_t kTenth = kMeters / 10;
  const auto probes = sitting.accept(probes_on_rectangle({x - 0.001, kLow, -kWallDistance}, {0.002, 0, 0},
                                                         {0, kHigh - kLow, 0}, 1, kMeters));
  const auto read = probes ? sitting.accept(renderer.measure_probes(*probes, {})) : std::nullopt;
  if (!read) return 0;
  double steepest = 0;
  double height = 0;
  for (std::size_t i = 0; i + kTenth < read->readings.size(); ++i) {
    const double fall = read->readings[i].lux - read->readings[i + kTenth].lux;
    if (fall <= steepest) continue;
    steepest = fall;
    height = ((*probes)[i].position_ws.y + (*probes)[i + kTenth].position_ws.y) / 2;
  }
  return static_cast<double>(kLampHeight) - height;
}

void draw_headlights(Sitting& sitting) {
  const Shot road = headlights_on_a_wall();
  sitting.picture("From the driver's seat, the wall 25 m ahead.", road);
  Shot wall = road;
  wall.camera = {{0, 1.35, -16}, {0, 1.35, -kWallDistance}};
  wall.yfov = Angle::degrees(17);
  wall.settings.width = 960;
  wall.settings.height = 400;
  wall.stops = -4.6;
  const std::optional<Drawing> drawing = sitting.prepare(wall);
  if (!drawing) return;
  const double below = cut_off_below_lamps(sitting, drawing->renderer, -3);
  mark_cut_off(wall.scene);
  sitting.picture(
      fmt::format(
          "The wall. Red: the cut-off of UN Regulation 112, level 25 cm below the lamps, rising by 15° to "
          "the right of the axis, for a car between its two lamps. Meters 3 m to the left find it {:.1f} cm "
          "below them.",
          100 * below),
      wall);
  Shot lux = headlights_on_a_wall();
  lux.camera = wall.camera;
  lux.yfov = wall.yfov;
  lux.settings = wall.settings;
  sitting.false_color("The same in lux.", lux, {Layer::lux, "lux.Y", "lx", 40});
}

// ---------------------------------------------------------------------------------------------- aircraft

constexpr double kHangar = 30;

/// An apron with a yellow line and a hangar door 30 m ahead of an aircraft's lights.
Shot apron() {
  Shot shot;
  Scene& scene = shot.scene;
  scene.ambient_is_set = true;
  scene.ambient = glm::vec3(0.6F, 0.7F, 1.0F);
  scene.background = glm::vec3(0.4F, 0.5F, 0.9F);
  add_object(
      scene, "apron", rectangle({0, 0, -20}, {1, 0, 0}, {0, 0, -1}, {60, 60}, 4),
      add_material(scene, "concrete", glm::vec3(0.85F), add_picture(scene, "concrete", paint_tiles(256))));
  Primitive line = rectangle({0, 0.01F, -12}, {1, 0, 0}, {0, 0, -1}, {0.25F, 34}, 1);
  append(line, rectangle({0, 0.01F, -20}, {1, 0, 0}, {0, 0, -1}, {40, 0.25F}, 1));
  add_object(scene, "line", line, add_material(scene, "yellow", {0.85F, 0.62F, 0.08F}));
  add_object(scene, "hangar",
             box({-26, 0, static_cast<float>(-kHangar) - 1}, {26, 8, static_cast<float>(-kHangar)}),
             add_material(scene, "door", glm::vec3(0.55F)));
  shot.camera = {{10, 8, 10}, {2, 0.6, -18}};
  shot.yfov = Angle::degrees(46);
  shot.stops = -4.2;
  return shot;
}

Light& add_beam(Scene& scene, const char* name, Gaze gaze, double yfov_deg, double candela) {
  const int beam = add_picture(scene, name, paint_round_beam(256));
  Light& light = add_projector(scene, name, gaze, Angle::degrees(yfov_deg), beam);
  light.slide_is_intensity = true;
  light.intensity = candela;
  light.attenuation = Attenuation::inverse_square;
  light.color = color_of_temperature(3200);
  return light;
}

/// Where along the hangar's door, 1.4 m above the ground, it is lightest.
double lightest_place(Sitting& sitting, const Shot& shot) {
  const std::optional<Drawing> drawing = sitting.prepare(shot);
  if (!drawing) return 0;
  constexpr int kMeters = 1601;
  const auto probes =
      sitting.accept(probes_on_rectangle({-20, 1.399, -kHangar}, {40, 0, 0}, {0, 0.002, 0}, kMeters, 1));
  const auto read = probes ? sitting.accept(drawing->renderer.measure_probes(*probes, {})) : std::nullopt;
  if (!read) return 0;
  const auto most = std::ranges::max_element(read->readings, {}, &ProbeReading::lux);
  return (*probes)[static_cast<std::size_t>(most - read->readings.begin())].position_ws.x;
}

void draw_aircraft(Sitting& sitting) {
  for (const double degrees : {-15.0, 0.0, 25.0}) {
    Shot shot = apron();
    const glm::dvec2 turned = point_of_circle(degrees / 360);
    const double moved = kHangar * turned.y / turned.x;
    add_beam(shot.scene, "taxi light", {{0, 1.4, 0}, {moved, 1.4, -kHangar}}, 16, 60000);
    const double lightest = lightest_place(sitting, shot);
    sitting.picture(
        fmt::format("A taxi light steered by {:.0f}°: on the door 30 m ahead it is lightest {:.2f} m from "
                    "the middle; d tan θ is {:.2f} m.",
                    degrees, lightest, moved),
        shot);
  }
  Shot landing = apron();
  for (const double x : {-5.0, 5.0})
    add_beam(landing.scene, x < 0 ? "left landing light" : "right landing light",
             {{x, 2.2, 3}, {x * 0.7, 0, -22}}, 14, 250000);
  add_beam(landing.scene, "taxi light", {{0, 1.4, 0}, {0, 0.2, -18}}, 22, 60000);
  landing.stops = -5.6;
  sitting.picture("Two landing lights of 250,000 cd, and the taxi light.", landing);
  sitting.false_color("The same in lux.", landing, {Layer::lux, "lux.Y", "lx", 200});
}

// ---------------------------------------------------------------------------------------------- colours of lamps

/// Lamps in a row before a white wall, one for each colour, and the lux that a meter reads in the middle of each.
struct ColourRow {
  Shot shot;
  std::vector<double> places;  ///< x of each on the wall
};

ColourRow lamps_in_a_row(const std::vector<glm::vec3>& colours) {
  ColourRow row;
  Scene& scene = row.shot.scene;
  set_mood(scene, 0.03F);
  scene.background = glm::vec3(0);
  add_object(scene, "wall", rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 2.4F}, 1),
             add_material(scene, "white", glm::vec3(0.9F)));
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double x = 1.1 * (static_cast<double>(i) - 0.5 * static_cast<double>(colours.size() - 1));
    Light& light = add_lamp(scene, fmt::format("lamp {}", i), {{x, 0.75, 0.55}, {x, 0, 0}},
                            Angle::degrees(32), colours[i]);
    light.attenuation = Attenuation::inverse_square;
    light.intensity = 100;
    row.places.push_back(x);
  }
  row.shot.camera = {{0, 0, 6}, {0, 0, 0}};
  row.shot.yfov = Angle::degrees(20);
  row.shot.settings.width = 960;
  row.shot.settings.height = 260;
  row.shot.stops = -7.1;
  return row;
}

/// What each lamp gives in lux where it is aimed.
std::vector<double> read_row(Sitting& sitting, const ColourRow& row) {
  std::vector<double> lux;
  const std::optional<Drawing> drawing = sitting.prepare(row.shot);
  if (!drawing) return lux;
  std::vector<Probe> probes;
  for (const double x : row.places) probes.push_back({{x, 0, 0}, {0, 0, 1}, 0});
  const auto read = sitting.accept(drawing->renderer.measure_probes(probes, {}));
  for (std::size_t i = 0; read && i < row.places.size(); ++i) lux.push_back(read->readings[i].lights[i].lux);
  return lux;
}

void draw_colours(Sitting& sitting) {
  constexpr std::array<double, 7> kKelvin = {1900, 2700, 3200, 4300, 5600, 6504, 10000};
  std::vector<glm::vec3> colours;
  std::string names;
  for (const double kelvin : kKelvin) {
    colours.push_back(color_of_temperature(kelvin));
    names += fmt::format("{}{:.0f}", names.empty() ? "" : ", ", kelvin);
  }
  const ColourRow warm_to_cold = lamps_in_a_row(colours);
  const std::vector<double> lux = read_row(sitting, warm_to_cold);
  if (lux.empty()) return;
  const auto [least, most] = std::ranges::minmax(lux);
  sitting.picture(
      fmt::format("{} K, each of 100 cd. A temperature colours a lamp and keeps its luminance: meters read "
                  "{:.2f} to {:.2f} lx.",
                  names, least, most),
      warm_to_cold.shot);

  colours = {color_of_temperature(3200)};
  names = "none";
  for (const char* name : {"quarter_ctb", "half_ctb", "full_ctb", "half_cto", "full_cto", "nd_0.3"}) {
    const auto gel = std::ranges::find(list_gels(), name, &Gel::name);
    if (gel == list_gels().end()) continue;
    colours.push_back(color_of_temperature(3200) * transmission(*gel));
    names += fmt::format(", {}", name);
  }
  const ColourRow gels = lamps_in_a_row(colours);
  std::string readings;
  for (const double value : read_row(sitting, gels))
    readings += fmt::format("{}{:.0f}", readings.empty() ? "" : ", ", value);
  sitting.picture(
      fmt::format("The lamp of 3200 K behind gels: {}. A gel takes light away: {} lx.", names, readings),
      gels.shot);
}

constexpr Figure kFigures[] = {
    {"measured-lamps", "Lamps as they were measured", "IES LM-63 types C, B and A; EULUMDAT",
     "A lamp file says how many candela leave in every direction; the polar diagram shows two sections, the "
     "wall shows "
     "all of it. Numbers are those of laterna ies.",
     "All light comes from one point, whatever the lamp's size.",
     "{\"type\": \"point\", \"position\": [0, 2.6, -0.5], \"ies\": \"lamp.ies\"}\n"
     "laterna ies lamp.ies --polar lamp.svg",
     draw_measured_lamps},
    {"lux", "Lux and candela per square metre", "What meters read",
     "Lumens, candela and lux in, lux and cd/m² out: as a picture with a scale, and at any point or grid.",
     "Light that is reflected from surface to surface is no part of it.",
     "laterna render hall.glb --rig hall.json --false-colour lux:2000 -o lux.png\n"
     "laterna probe hall.glb --rig hall.json --rectangle -2,0,2,4,0,0,0,0,-3 --grid 32x24 -o floor.csv",
     draw_lux},
    {"headlights", "Headlights on a wall",
     "After the headlights of Segal et al., section 3.2; UN Regulation 112",
     "Two dipped beams, painted by a formula as intensity maps. The wall shows the map where the map puts "
     "it.",
     "",
     "\"type\": \"projector\", \"intensity_map\": \"low_beam.png\", \"candela\": 24000\n"
     "laterna render road.glb --rig headlights.json --false-colour lux:40 -o lux.png",
     draw_headlights},
    {"aircraft", "A steerable taxi light, and landing lights", "Lamps that move",
     "Steered by θ, a taxi light moves its patch on a wall at distance d by d tan θ. Shadow maps of what "
     "stays are kept.",
     "", "Renderer::set_transform() in C++, or another \"target\" in the rig", draw_aircraft},
    {"lamp-colours", "Colour temperatures and gels", "Black bodies, and filters before them",
     "Warm and cold lamps, and what filters make of one of them.",
     "White is 6504 K here, as in sRGB; no camera's white balance is at work.",
     "\"color_temperature\": 3200, \"gel\": \"half_ctb\"", draw_colours},
};

}  // namespace

Chapter lamp_chapter() {
  return {"Lamps and lux", "Measured beams, real units, and what a meter says.", kFigures};
}

}  // namespace laterna::app
