// What follows from a lamp's table of candela: intensity by direction, flux, beam angles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "base/elementary.h"
#include "laterna/lamps.h"

namespace laterna {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kBeamShare = 0.5, kFieldShare = 0.1;

struct LampAngles {
  double vertical_deg, horizontal_deg;
};

// The inverse of lamp_direction(): its equations solved for the angles.
LampAngles angles_of(PhotometricType type, const glm::dvec3& d) {
  const double forward = -d.z;
  switch (type) {
    case PhotometricType::type_a:
      return {arctangent2(d.x, std::sqrt(d.y * d.y + forward * forward)) / kDegree,
              arctangent2(-d.y, forward) / kDegree};
    case PhotometricType::type_b:
      return {arctangent2(d.x, forward) / kDegree,
              arctangent2(-d.y, std::sqrt(d.x * d.x + forward * forward)) / kDegree};
    case PhotometricType::type_c:
      break;
  }
  const double horizontal = arctangent2(d.y, d.x) / kDegree;
  return {arctangent2(std::sqrt(d.x * d.x + d.y * d.y), forward) / kDegree,
          horizontal < 0 ? horizontal + 360 : horizontal};
}

// A cell of a list of angles, and how far into it; nothing outside the list.
struct Place {
  std::size_t cell;
  double share;
};
std::optional<Place> find_place(const std::vector<double>& angles, double angle) {
  constexpr double kRounding = 1e-9;
  if (angle < angles.front() - kRounding || angle > angles.back() + kRounding) return std::nullopt;
  const auto above = std::upper_bound(angles.begin(), angles.end(), angle) - angles.begin();
  const std::size_t cell =
      std::clamp<std::ptrdiff_t>(above - 1, 0, static_cast<std::ptrdiff_t>(angles.size()) - 2);
  const double share = (angle - angles[cell]) / (angles[cell + 1] - angles[cell]);
  return Place{cell, std::clamp(share, 0.0, 1.0)};
}

double mix(double a, double b, double share) { return a + (b - a) * share; }

double candela_at(const LightDistribution& lamp, LampAngles angles) {
  const std::optional<Place> v = find_place(lamp.vertical_deg, angles.vertical_deg);
  const std::optional<Place> h = find_place(lamp.horizontal_deg, angles.horizontal_deg);
  if (!v || !h) return 0;
  return mix(mix(lamp.at(h->cell, v->cell), lamp.at(h->cell, v->cell + 1), v->share),
             mix(lamp.at(h->cell + 1, v->cell), lamp.at(h->cell + 1, v->cell + 1), v->share), h->share);
}

// ∫ L(x) w(x) dx for L linear from `a` at x0 to `b` at x1 and w = sin (γ of type C) or cos (latitudes of A and B).
double integral_with_sine(double x0, double x1, double a, double b) {
  return a * cosine(x0) - b * cosine(x1) + (b - a) * (sine(x1) - sine(x0)) / (x1 - x0);
}
double integral_with_cosine(double x0, double x1, double a, double b) {
  return b * sine(x1) - a * sine(x0) + (b - a) * (cosine(x1) - cosine(x0)) / (x1 - x0);
}

std::string fault_of_angles(std::string_view which, const std::vector<double>& angles, double low,
                            double high) {
  if (angles.size() < 2 || angles.size() > 4 * kMaxLampAngles)
    return fmt::format("expected 2 to {} {} angles, got {}", 4 * kMaxLampAngles, which, angles.size());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    // Written so that NaN fails.
    if (!(angles[i] >= low && angles[i] <= high))
      return fmt::format("{} angle {}: expected from {} to {} degrees, got {}", which, i + 1, low, high,
                         angles[i]);
    // Mirrored angles differ from the file's by a rounding.
    if (i > 0 && !(angles[i] - angles[i - 1] >= 0.999 * kLeastLampStep))
      return fmt::format("{} angle {}: expected more than the {} degrees before it, got {}", which, i + 1,
                         angles[i - 1], angles[i]);
  }
  return "";
}

// Directions of a section by their angle from the light's axis: `turn_deg` 0 is the X–Z plane, 90 the Y–Z plane.
glm::dvec3 section_direction(double from_axis_deg, double turn_deg) {
  return lamp_direction(PhotometricType::type_c, from_axis_deg, turn_deg);
}

// Between these angles from the axis a section is linear: the grid's own, on both sides, and its ends from outside.
std::vector<double> section_corners(const LightDistribution& lamp) {
  constexpr double kBeyond = 1e-7;
  std::set<double> corners = {-180, -90, 0, 90, 180};
  for (const std::vector<double>* angles : {&lamp.vertical_deg, &lamp.horizontal_deg}) {
    if (angles == &lamp.horizontal_deg && lamp.type == PhotometricType::type_c) continue;
    for (const double sign : {-1.0, 1.0}) {
      for (const double angle : *angles) corners.insert(sign * angle);
      corners.insert(sign * (angles->front() - kBeyond));
      corners.insert(sign * (angles->back() + kBeyond));
    }
  }
  std::vector<double> within(corners.begin(), corners.end());
  std::erase_if(within, [](double angle) { return angle < -180 || angle > 180; });
  return within;
}

// Full angle between the outermost directions that reach `level`, counted from the middle of `profile`.
std::optional<double> width_at(const std::vector<std::array<double, 2>>& profile, double level) {
  const auto reaches = [&](const std::array<double, 2>& p) { return p[1] >= level; };
  const auto first = std::find_if(profile.begin(), profile.end(), reaches);
  if (first == profile.end() || level <= 0) return std::nullopt;
  const auto last = std::find_if(profile.rbegin(), profile.rend(), reaches).base() - 1;
  const auto crossing = [&](const std::array<double, 2>& below, const std::array<double, 2>& above) {
    return mix(below[0], above[0], (level - below[1]) / (above[1] - below[1]));
  };
  const double low = first == profile.begin() ? (*first)[0] : crossing(*(first - 1), *first);
  const double high = last + 1 == profile.end() ? (*last)[0] : crossing(*(last + 1), *last);
  return high - low;
}

LampSection section_of(const LightDistribution& lamp, double turn_deg, double peak, bool shines_back) {
  std::vector<std::array<double, 2>> profile;
  for (const double angle : section_corners(lamp))
    profile.push_back({angle, candela_toward(lamp, section_direction(angle, turn_deg))});
  if (shines_back) {  // Counted from the opposite of the axis: what was in the middle is at the ends.
    for (auto& [angle, candela] : profile) angle += angle < 0 ? 180 : -180;
    std::stable_sort(profile.begin(), profile.end(),
                     [](const auto& a, const auto& b) { return a[0] < b[0]; });
    profile.push_back({180, candela_toward(lamp, section_direction(0, turn_deg))});
  }
  LampSection section;
  for (const auto& [angle, candela] : profile) section.peak_cd = std::max(section.peak_cd, candela);
  // What a downlight throws at the ceiling is not its beam.
  std::erase_if(profile, [](const auto& p) { return std::abs(p[0]) > 90; });
  section.beam_angle_deg = width_at(profile, kBeamShare * peak);
  section.field_angle_deg = width_at(profile, kFieldShare * peak);
  return section;
}

}  // namespace

std::string find_fault(const LightDistribution& lamp) {
  const bool is_c = lamp.type == PhotometricType::type_c;
  std::string fault = fault_of_angles("vertical", lamp.vertical_deg, is_c ? 0 : -90, is_c ? 180 : 90);
  if (fault.empty())
    fault = fault_of_angles("horizontal", lamp.horizontal_deg, is_c ? -360 : -90, is_c ? 720 : 90);
  if (!fault.empty()) return fault;
  if (is_c && (lamp.horizontal_deg.front() > 0 || lamp.horizontal_deg.back() < 360))
    return fmt::format("horizontal angles: expected a full turn from 0 to 360 degrees, got {} to {}",
                       lamp.horizontal_deg.front(), lamp.horizontal_deg.back());
  const std::size_t expected = lamp.vertical_deg.size() * lamp.horizontal_deg.size();
  if (lamp.candela.size() != expected)
    return fmt::format("expected {} candela values, one for each pair of angles, got {}", expected,
                       lamp.candela.size());
  for (std::size_t i = 0; i < expected; ++i) {
    if (!(lamp.candela[i] >= 0 && lamp.candela[i] <= 1e12))
      return fmt::format("candela value {}: expected from 0 to 1e12, got {}", i + 1, lamp.candela[i]);
  }
  return "";
}

glm::dvec3 lamp_direction(PhotometricType type, double vertical_deg, double horizontal_deg) {
  const double v = vertical_deg * kDegree, h = horizontal_deg * kDegree;
  switch (type) {
    case PhotometricType::type_a:
      return {sine(v), -cosine(v) * sine(h), -cosine(v) * cosine(h)};
    case PhotometricType::type_b:
      return {cosine(h) * sine(v), -sine(h), -cosine(h) * cosine(v)};
    case PhotometricType::type_c:
      break;
  }
  return {sine(v) * cosine(h), sine(v) * sine(h), -cosine(v)};
}

double candela_toward(const LightDistribution& distribution, const glm::dvec3& direction_ls) {
  return candela_at(distribution, angles_of(distribution.type, direction_ls));
}

double luminous_flux(const LightDistribution& lamp) {
  // The angle from the poles, and the one around them: only the first weighs.
  const bool is_polar_vertical = lamp.type != PhotometricType::type_b;
  const std::vector<double>& polar = is_polar_vertical ? lamp.vertical_deg : lamp.horizontal_deg;
  const std::vector<double>& around = is_polar_vertical ? lamp.horizontal_deg : lamp.vertical_deg;
  const bool is_turn = lamp.type == PhotometricType::type_c;
  const auto integral = is_turn ? integral_with_sine : integral_with_cosine;
  const auto at = [&](std::size_t a, std::size_t p) {
    return is_polar_vertical ? lamp.at(a, p) : lamp.at(p, a);
  };
  double flux = 0;
  for (std::size_t a = 0; a + 1 < around.size(); ++a) {
    // Planes beyond a full turn show a second time what is there already.
    const double begin = is_turn ? std::clamp(around[a], 0.0, 360.0) : around[a];
    const double end = is_turn ? std::clamp(around[a + 1], 0.0, 360.0) : around[a + 1];
    const double middle = ((begin + end) / 2 - around[a]) / (around[a + 1] - around[a]);
    for (std::size_t p = 0; p + 1 < polar.size(); ++p) {
      flux += (end - begin) * kDegree *
              integral(polar[p] * kDegree, polar[p + 1] * kDegree, mix(at(a, p), at(a + 1, p), middle),
                       mix(at(a, p + 1), at(a + 1, p + 1), middle));
    }
  }
  return flux;
}

double angle_from_axis(const LightDistribution& lamp) {
  double widest = 0;
  for (std::size_t h = 0; h < lamp.horizontal_deg.size(); ++h) {
    for (std::size_t v = 0; v < lamp.vertical_deg.size(); ++v) {
      if (lamp.at(h, v) <= 0) continue;
      // The cells around a corner are lit up to their other corners. In types A and B both angles lead away from the axis.
      const std::size_t beyond = std::min(v + 1, lamp.vertical_deg.size() - 1);
      if (lamp.type == PhotometricType::type_c) {
        widest = std::max(widest, lamp.vertical_deg[beyond]);
        continue;
      }
      const auto farthest = [](const std::vector<double>& angles, std::size_t i) {
        return std::max(std::abs(angles[i > 0 ? i - 1 : i]),
                        std::abs(angles[std::min(i + 1, angles.size() - 1)]));
      };
      widest = std::max(widest, farthest(lamp.vertical_deg, v) + farthest(lamp.horizontal_deg, h));
    }
  }
  return std::min(widest, 180.0);
}

LampSummary summarise(const LightDistribution& lamp) {
  LampSummary summary;
  const auto peak = std::max_element(lamp.candela.begin(), lamp.candela.end());
  const auto index = static_cast<std::size_t>(peak - lamp.candela.begin());
  summary.flux_lm = luminous_flux(lamp);
  summary.peak_cd = *peak;
  summary.peak_vertical_deg = lamp.vertical_deg[index % lamp.vertical_deg.size()];
  summary.peak_horizontal_deg = lamp.horizontal_deg[index / lamp.vertical_deg.size()];
  const bool shines_back = lamp.type == PhotometricType::type_c && summary.peak_vertical_deg > 90;
  for (const std::size_t i : {0U, 1U})
    summary.sections[i] = section_of(lamp, 90.0 * static_cast<double>(i), *peak, shines_back);
  return summary;
}

double lumens_of_cone(double candela, Angle half_angle) {
  return candela * 2 * kPi * (1 - cosine(half_angle.in_radians()));
}

double candela_of_cone(double lumens, Angle half_angle) { return lumens / lumens_of_cone(1, half_angle); }

}  // namespace laterna
