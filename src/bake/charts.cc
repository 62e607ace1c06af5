#include "bake/charts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

#include "base/flat_triangle.h"

namespace laterna::bake {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

bool is_before(const glm::dvec3& a, const glm::dvec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// For each corner, the number of its position among all different ones.
std::vector<std::uint32_t> number_positions(std::span<const glm::dvec3> corners_ws) {
  std::vector<std::uint32_t> order(corners_ws.size()), number(corners_ws.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (is_before(corners_ws[a], corners_ws[b])) return true;
    return corners_ws[a] == corners_ws[b] && a < b;
  });
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && corners_ws[order[i]] != corners_ws[order[i - 1]]) ++last;
    number[order[i]] = last;
  }
  return number;
}

// Beyond each of a triangle's edges, the other triangle of two that share it and run along it in opposite directions.
std::vector<std::uint32_t> find_neighbours(std::span<const glm::dvec3> corners_ws) {
  const std::vector<std::uint32_t> position = number_positions(corners_ws);
  struct Edge {
    std::uint32_t low, high, corner;
    bool is_turned;
  };
  std::vector<Edge> edges;
  for (std::uint32_t corner = 0; corner < corners_ws.size(); ++corner) {
    const std::uint32_t a = position[corner];
    const std::uint32_t b = position[corner % 3 == 2 ? corner - 2 : corner + 1];
    edges.push_back({std::min(a, b), std::max(a, b), corner, b < a});
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  std::vector<std::uint32_t> neighbours(corners_ws.size(), kNone);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    if (end - i == 2 && edges[i].is_turned != edges[i + 1].is_turned) {
      neighbours[edges[i].corner] = edges[i + 1].corner / 3;
      neighbours[edges[i + 1].corner] = edges[i].corner / 3;
    }
    i = end;
  }
  return neighbours;
}

// Any two directions square to n and to each other: Duff et al. 2017, Building an orthonormal basis, revisited.
std::pair<glm::dvec3, glm::dvec3> axes_about(const glm::dvec3& n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

// Counter-clockwise, without points on edges: Andrew's monotone chain.
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<glm::dvec2> hull;
  const auto add = [&](const glm::dvec2& p, std::size_t least) {
    while (hull.size() > least && side_of(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const glm::dvec2& p : points) add(p, 1);
  const std::size_t lower = hull.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

class ChartCutter {
 public:
  ChartCutter(std::span<const glm::dvec3> corners_ws, double resolution, double max_size)
      : corners_ws_(corners_ws), resolution_(resolution), max_size_(max_size) {}

  std::vector<Chart> cut() {
    find_normals();
    neighbours_ = find_neighbours(corners_ws_);
    std::vector<std::uint32_t> seeds;
    for (std::uint32_t t = 0; t < areas_.size(); ++t) {
      if (areas_[t] > 0) seeds.push_back(t);
    }
    std::stable_sort(seeds.begin(), seeds.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return areas_[a] > areas_[b]; });
    std::vector<bool> is_taken(areas_.size(), false);
    for (const std::uint32_t seed : seeds) {
      if (!is_taken[seed]) add(grow(seed, is_taken));
    }
    return std::move(charts_);
  }

 private:
  void find_normals() {
    for (std::size_t t = 0; t < corners_ws_.size() / 3; ++t) {
      const glm::dvec3* p = &corners_ws_[3 * t];
      const glm::dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
      const double length = std::sqrt(glm::dot(n, n));
      const bool is_flat = length > 0 && std::isfinite(length);
      areas_.push_back(is_flat ? length / 2 : 0);
      normals_.push_back(is_flat ? n / length : glm::dvec3(0));
    }
  }

  // The triangles about `seed` that face the same way, those that do so best first.
  std::vector<std::uint32_t> grow(std::uint32_t seed, std::vector<bool>& is_taken) const {
    const auto [u, v] = axes_about(normals_[seed]);
    glm::dvec2 low(INFINITY), high(-INFINITY);
    using Candidate = std::pair<double, std::uint32_t>;  // cosine; the lesser number wins among equals
    const auto is_worse = [](const Candidate& a, const Candidate& b) {
      return a.first != b.first ? a.first < b.first : a.second > b.second;
    };
    std::priority_queue<Candidate, std::vector<Candidate>, decltype(is_worse)> front(is_worse);
    front.emplace(1, seed);
    std::vector<std::uint32_t> triangles;
    while (!front.empty()) {
      const std::uint32_t triangle = front.top().second;
      front.pop();
      if (is_taken[triangle]) continue;
      glm::dvec2 new_low = low, new_high = high;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& corner = corners_ws_[3 * triangle + k];
        const glm::dvec2 flat(glm::dot(corner, u), glm::dot(corner, v));
        new_low = glm::min(new_low, flat);
        new_high = glm::max(new_high, flat);
      }
      const glm::dvec2 size = new_high - new_low;
      if (triangle != seed && std::max(size.x, size.y) > max_size_) continue;
      low = new_low;
      high = new_high;
      is_taken[triangle] = true;
      triangles.push_back(triangle);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = neighbours_[3 * triangle + k];
        if (next == kNone || is_taken[next] || !(areas_[next] > 0)) continue;
        const double cosine = glm::dot(normals_[next], normals_[seed]);
        if (cosine >= kLeastChartCosine) front.emplace(cosine, next);
      }
    }
    return triangles;
  }

  // The mean normal, where none is too far from it; else that of the first.
  [[nodiscard]] glm::dvec3 direction_of(const std::vector<std::uint32_t>& triangles) const {
    glm::dvec3 sum(0);
    for (const std::uint32_t t : triangles) sum += normals_[t] * areas_[t];
    const glm::dvec3 mean = sum / std::sqrt(glm::dot(sum, sum));
    const bool serves_all = std::ranges::all_of(
        triangles, [&](auto t) { return glm::dot(normals_[t], mean) >= kLeastChartCosine; });
    return serves_all ? mean : normals_[triangles.front()];
  }

  void add(std::vector<std::uint32_t> triangles) {
    const auto [u, v] = axes_about(direction_of(triangles));
    Chart chart;
    chart.axis_u = u;
    chart.axis_v = v;
    std::vector<glm::dvec2> flat;
    for (const std::uint32_t t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) flat.push_back(chart.flat(corners_ws_[3 * t + k]));
    }
    if (triangles.size() > 1 && overlap(flat, resolution_)) return split(triangles);
    chart.triangles = std::move(triangles);
    turn(chart, flat);
    charts_.push_back(std::move(chart));
  }

  // Winding surfaces are halved along their way until they lie flat.
  void split(const std::vector<std::uint32_t>& triangles) {
    const std::uint32_t end = by_steps_from(triangles.front(), triangles).back();
    const std::vector<std::uint32_t> order = by_steps_from(end, triangles);
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    add({order.begin(), middle});
    add({middle, order.end()});
  }

  // Triangles by how many edges lead to them; those to which none does come last.
  [[nodiscard]] std::vector<std::uint32_t> by_steps_from(std::uint32_t first,
                                                         const std::vector<std::uint32_t>& triangles) const {
    std::set<std::uint32_t> left(triangles.begin(), triangles.end());
    std::vector<std::uint32_t> order = {first};
    left.erase(first);
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = neighbours_[3 * order[i] + k];
        if (next != kNone && left.erase(next) > 0) order.push_back(next);
      }
    }
    order.insert(order.end(), left.begin(), left.end());
    return order;
  }

  // One side of the smallest rectangle about a set of points lies on an edge of its hull (Freeman & Shapira 1975).
  static void turn(Chart& chart, const std::vector<glm::dvec2>& flat) {
    constexpr std::size_t kMostDirections = 64;  // of hulls with more edges, every so many is tried
    const std::vector<glm::dvec2> hull = convex_hull(flat);
    const std::size_t step = (hull.size() + kMostDirections - 1) / kMostDirections;
    glm::dvec2 best(1, 0);
    double least = INFINITY;
    const auto extent = [&](const glm::dvec2& along, glm::dvec2& low, glm::dvec2& high) {
      low = glm::dvec2(INFINITY);
      high = glm::dvec2(-INFINITY);
      for (const glm::dvec2& p : hull) {
        const glm::dvec2 turned(glm::dot(p, along), along.x * p.y - along.y * p.x);
        low = glm::min(low, turned);
        high = glm::max(high, turned);
      }
    };
    glm::dvec2 low, high;
    for (std::size_t i = 0; i < hull.size(); i += std::max<std::size_t>(step, 1)) {
      const glm::dvec2 edge = hull[(i + 1) % hull.size()] - hull[i];
      const double length = std::sqrt(glm::dot(edge, edge));
      if (!(length > 0)) continue;
      extent(edge / length, low, high);
      const double area = (high.x - low.x) * (high.y - low.y);
      if (!(area < least)) continue;
      least = area;
      best = edge / length;
    }
    extent(best, low, high);
    if (high.y - low.y > high.x - low.x) best = {-best.y, best.x};
    const glm::dvec3 u = chart.axis_u, v = chart.axis_v;
    chart.axis_u = u * best.x + v * best.y;
    chart.axis_v = v * best.x - u * best.y;
    extent(best, low, high);
    chart.low = low;
    chart.size = high - low;
  }

  std::span<const glm::dvec3> corners_ws_;
  double resolution_, max_size_;
  std::vector<glm::dvec3> normals_;
  std::vector<double> areas_;
  std::vector<std::uint32_t> neighbours_;  // beyond each edge
  std::vector<Chart> charts_;
};

}  // namespace

glm::dvec2 Chart::flat(const glm::dvec3& point_ws) const {
  return {glm::dot(point_ws, axis_u), glm::dot(point_ws, axis_v)};
}

bool overlap(std::span<const glm::dvec2> corners, double resolution) {
  // Large charts are looked at more coarsely: a bit each of so many squares.
  constexpr double kMostSquares = 1 << 26;
  glm::dvec2 low(INFINITY), high(-INFINITY);
  for (const glm::dvec2& p : corners) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec2 size = high - low;
  double side = resolution;
  while ((size.x / side + 1) * (size.y / side + 1) > kMostSquares) side *= 2;
  const auto columns = static_cast<std::size_t>(size.x / side) + 1;
  const auto rows = static_cast<std::size_t>(size.y / side) + 1;
  std::vector<bool> is_covered(columns * rows, false);
  for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
    const FlatTriangle triangle(
        {(corners[t] - low) / side, (corners[t + 1] - low) / side, (corners[t + 2] - low) / side});
    const auto first = glm::floor(triangle.low()), last = glm::floor(triangle.high());
    for (double y = first.y; y <= last.y; ++y) {
      for (double x = first.x; x <= last.x; ++x) {
        if (!triangle.holds({x + 0.5, y + 0.5})) continue;
        const std::size_t square = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
        if (is_covered[square]) return true;
        is_covered[square] = true;
      }
    }
  }
  return false;
}

std::vector<Chart> cut_into_charts(std::span<const glm::dvec3> corners_ws, double resolution,
                                   double max_size) {
  return ChartCutter(corners_ws, resolution, max_size).cut();
}

}  // namespace laterna::bake
