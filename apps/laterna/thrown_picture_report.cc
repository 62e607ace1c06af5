#include "thrown_picture_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace laterna::app {
namespace {

constexpr double kMillimetres = 1000;

nlohmann::json vector_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

nlohmann::json json_of(const ThrownPicture& thrown) {
  nlohmann::json j = {{"light", thrown.light},
                      {"middle", vector_json(thrown.middle_ws)},
                      {"normal", vector_json(thrown.normal_ws)},
                      {"throw_m", thrown.throw_distance},
                      {"incidence_deg", thrown.incidence.in_degrees()},
                      {"lux", thrown.lux},
                      {"corners", nullptr},
                      {"width_m", nullptr},
                      {"height_m", nullptr},
                      {"pixels", nullptr},
                      {"pixel_pitch_mm", nullptr}};
  if (thrown.corners_ws) {
    j["corners"] = nlohmann::json::array();
    for (const glm::dvec3& corner : *thrown.corners_ws) j["corners"].push_back(vector_json(corner));
  }
  if (thrown.size) {
    j["width_m"] = thrown.size->x;
    j["height_m"] = thrown.size->y;
  }
  if (thrown.pixels_across > 0) j["pixels"] = {thrown.pixels_across, thrown.pixels_down};
  if (thrown.pixel_pitch)
    j["pixel_pitch_mm"] = {kMillimetres * thrown.pixel_pitch->x, kMillimetres * thrown.pixel_pitch->y};
  return j;
}

std::string text_of(const ThrownPicture& thrown) {
  constexpr double kSquareOn = 0.05;  // degrees
  const double incidence = thrown.incidence.in_degrees();
  const std::string angle =
      incidence < kSquareOn ? std::string("square-on") : fmt::format("{:.1f}° off square", incidence);
  const std::string size = thrown.size ? fmt::format("{:.3f} x {:.3f} m", thrown.size->x, thrown.size->y)
                                       : std::string("not wholly on that surface,");
  std::string line =
      fmt::format("{} at {:.3f} m, {}; white is {:.4g} lx", size, thrown.throw_distance, angle, thrown.lux);
  if (thrown.pixel_pitch) {
    line += fmt::format("; pixels of {:.3g} x {:.3g} mm", kMillimetres * thrown.pixel_pitch->x,
                        kMillimetres * thrown.pixel_pitch->y);
  }
  return line;
}

}  // namespace laterna::app
