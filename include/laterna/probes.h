// Light meters in a scene: what Renderer::measure_probes() is asked and answers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "laterna/result.h"

namespace laterna {

/// A small flat meter. It reads what falls on its front, with the cosine of the angle to its normal.
struct Probe {
  glm::dvec3 position_ws{0};      ///< metres
  glm::dvec3 normal_ws{0, 1, 0};  ///< of any length but 0
  double area = 0;                ///< square metres that it stands for, in a grid
};

struct ProbeSettings {
  /// Lights that have a size are measured as the mean over this many of their points. 1: from their middle. 1…kMaxAccumulated.
  int accumulate = 1;
};

/// What one meter reads.
struct ProbeReading {
  struct FromLight {
    double lux = 0;         ///< Rec. 709 luminance of what arrives; ambient light is no part of it
    double visibility = 0;  ///< the fraction that arrives: 1 where nothing is in the way
  };
  double lux = 0;                 ///< of all lights
  std::vector<FromLight> lights;  ///< in the order of ProbeReport::lights
};

struct ProbeReport {
  std::vector<std::string> lights;  ///< those that are on
  std::vector<ProbeReading> readings;
};

/// Rays to lights start so far above a probe's plane, in metres: a point that was written down to the millimetre lies on
/// its wall, not in it. What stands nearer throws no shadow on a probe.
inline constexpr double kProbeClearance = 1e-3;
inline constexpr std::size_t kMaxProbes = std::size_t{1} << 24;

/// across × down probes at the middles of equal fields of a parallelogram: from `corner` along `right`, then rows along
/// `up`. Their normals are right × up. Error: the edges span no area, or fewer than 1 or more than kMaxProbes probes.
Result<std::vector<Probe>> probes_on_rectangle(const glm::dvec3& corner_ws, const glm::dvec3& right_ws,
                                               const glm::dvec3& up_ws, int across, int down);

/// Of a set of readings. Means are weighted by the probes' areas where all have one.
struct ProbeSummary {
  double least = 0, greatest = 0, mean = 0;  ///< lux
  double uniformity = 0;  ///< least / mean, U_o of lighting standards (EN 12464-1); 0 where nothing is lit
  double lumens = 0;      ///< Σ lux · area
};
ProbeSummary summarise(const std::vector<Probe>& probes, const ProbeReport& report);

/// Writes a report: .csv (a header, then x, y, z, nx, ny, nz, area_m2, lux, and lux.<light> and visibility.<light> of every
/// light; RFC 4180) or .json (lights, summary, probes). "-" is standard output and takes JSON. Numbers are written so that
/// they read back as the same. Error: another ending, or the file could not be written.
Result<void> write_probes(const std::vector<Probe>& probes, const ProbeReport& report,
                          const std::filesystem::path& file);
/// Whether write_probes() knows the ending.
Result<void> check_probe_output(const std::filesystem::path& file);

}  // namespace laterna
