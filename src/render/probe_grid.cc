#include "render/probe_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "base/flat_triangle.h"
#include "base/refuse.h"

namespace laterna {
namespace render {
namespace {

struct Triangle {
  std::array<glm::dvec3, 3> corner_ws;
};

Triangle triangle_of(const frame::Frame& frame, TriangleId id) {
  return {{frame.corner_ws(id, 0), frame.corner_ws(id, 1), frame.corner_ws(id, 2)}};
}

// Lines parallel to one world axis, through the middles of squares of the other two.
class Lattice {
 public:
  Lattice(double spacing, std::vector<Probe>& probes) : spacing_(spacing), probes_(probes) {}

  // False: too many.
  bool add(const Triangle& triangle) {
    const auto& p = triangle.corner_ws;
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(normal);
    if (!(length > 0)) return true;
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::array<glm::dvec2, 3> flat;
    for (std::size_t k = 0; k < 3; ++k) flat[k] = {p[k][u], p[k][v]};
    const FlatTriangle flat_triangle(flat);
    const glm::dvec2 low = flat_triangle.low(), high = flat_triangle.high();
    const double columns = std::floor(high.x / spacing_) - std::floor(low.x / spacing_) + 1;
    const double rows = std::floor(high.y / spacing_) - std::floor(low.y / spacing_) + 1;
    // Beyond, whole numbers of steps are no longer told apart, or most of the lattice would be looked at in vain.
    if (!(columns * rows <= 16.0 * static_cast<double>(kMaxProbes))) return false;
    for (double row = std::floor(low.y / spacing_); row * spacing_ <= high.y; ++row) {
      for (double column = std::floor(low.x / spacing_); column * spacing_ <= high.x; ++column) {
        const glm::dvec2 at((column + 0.5) * spacing_, (row + 0.5) * spacing_);
        if (!flat_triangle.holds(at)) continue;
        if (probes_.size() == kMaxProbes) return false;
        Probe probe;
        probe.normal_ws = normal / length;
        probe.position_ws[u] = at.x;
        probe.position_ws[v] = at.y;
        const double along = normal[u] * (at.x - p[0][u]) + normal[v] * (at.y - p[0][v]);
        probe.position_ws[axis] = p[0][axis] - along / normal[axis];
        probe.area = spacing_ * spacing_ * length / size[axis];
        probes_.push_back(probe);
      }
    }
    return true;
  }

 private:
  double spacing_;
  std::vector<Probe>& probes_;
};

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNamed = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    list += (list.empty() ? "\"" : ", \"") + names[i] + "\"";
  return names.size() > kMostNamed ? list + ", …" : list;
}

}  // namespace

Result<std::vector<Probe>> probes_on_object(const frame::Frame& frame, const std::string& object,
                                            double spacing) {
  if (!(spacing > 0) || !std::isfinite(spacing))
    return refuse(fmt::format("the spacing of probes must be greater than 0, got {}", spacing));
  const auto found = std::find(frame.object_names.begin(), frame.object_names.end(), object);
  if (found == frame.object_names.end()) {
    return refuse(fmt::format("the scene has no object \"{}\": it has {}", object,
                              frame.object_names.empty() ? "none" : list_of(frame.object_names)));
  }
  const auto number = static_cast<std::uint32_t>(found - frame.object_names.begin());
  std::vector<Probe> probes;
  Lattice lattice(spacing, probes);
  for (std::size_t cluster = 0; cluster < frame.clusters.size(); ++cluster) {
    if (frame.clusters[cluster].object != number) continue;
    const auto first = static_cast<TriangleId>(cluster << kTriangleBits);
    for (std::uint32_t t = 0; t < frame.clusters[cluster].triangle_count; ++t) {
      if (lattice.add(triangle_of(frame, first | t))) continue;
      return refuse(
          fmt::format("object \"{}\" is so large that a spacing of {:g} m makes more than {} probes", object,
                      spacing, kMaxProbes));
    }
  }
  return probes;
}

}  // namespace render

Result<std::vector<Probe>> probes_on_rectangle(const glm::dvec3& corner_ws, const glm::dvec3& right_ws,
                                               const glm::dvec3& up_ws, int across, int down) {
  if (across < 1 || down < 1 || static_cast<double>(across) * down > static_cast<double>(kMaxProbes)) {
    return refuse(
        fmt::format("a grid of probes must have 1 to {} of them, got {} x {}", kMaxProbes, across, down));
  }
  const glm::dvec3 normal = glm::cross(right_ws, up_ws);
  const double area = glm::length(normal);
  if (!(area > 0) || !std::isfinite(area)) return refuse("the edges of a grid of probes span no area");
  std::vector<Probe> probes;
  probes.reserve(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  for (int row = 0; row < down; ++row) {
    for (int column = 0; column < across; ++column) {
      const glm::dvec3 at = corner_ws + right_ws * ((column + 0.5) / across) + up_ws * ((row + 0.5) / down);
      probes.push_back({at, normal / area, area / across / down});
    }
  }
  return probes;
}

ProbeSummary summarise(const std::vector<Probe>& probes, const ProbeReport& report) {
  ProbeSummary summary;
  const std::size_t count = std::min(probes.size(), report.readings.size());
  if (count == 0) return summary;
  const bool has_areas = std::all_of(probes.begin(), probes.end(), [](const Probe& p) { return p.area > 0; });
  double sum = 0;
  double weights = 0;
  summary.least = summary.greatest = report.readings.front().lux;
  for (std::size_t i = 0; i < count; ++i) {
    const double lux = report.readings[i].lux;
    const double weight = has_areas ? probes[i].area : 1;
    summary.least = std::min(summary.least, lux);
    summary.greatest = std::max(summary.greatest, lux);
    summary.lumens += lux * probes[i].area;
    sum += lux * weight;
    weights += weight;
  }
  summary.mean = sum / weights;
  summary.uniformity = summary.mean > 0 ? summary.least / summary.mean : 0;
  return summary;
}

}  // namespace laterna
