#include "bake/luxel_receivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/flat_triangle.h"

namespace laterna::bake {
namespace {

constexpr std::size_t kTileLuxels = std::size_t{kTileSide} * kTileSide;
// Of a luxel's side: how far receivers keep from edges, and how high above a surface a luxel looks along it.
constexpr double kInset = 0.02, kLift = 0.02;
// Of a luxel's area: what those stand for that only continue a surface.
constexpr double kLeastArea = 1e-6;
// Bilinear look-ups read luxels whose middles are less than a luxel away, in either direction.
constexpr double kReadAtRim = 1.5;

std::array<glm::dvec2, 3> corners_on(const frame::Frame& frame, TriangleId id, glm::ivec2 size) {
  const std::uint32_t cluster = cluster_of(id);
  const std::uint32_t first = frame.streams[cluster].uv[1];
  std::array<glm::dvec2, 3> corners{};
  for (unsigned k = 0; k < 3; ++k) {
    const std::size_t v = first + (frame.corners[id] >> (8 * k) & 255U);
    corners[k] = glm::dvec2(frame.uvs[1][v]) * glm::dvec2(size);
  }
  return corners;
}

// A triangle in the world.
class Patch {
 public:
  Patch(const frame::Frame& frame, TriangleId id) : id_(id) {
    for (unsigned k = 0; k < 3; ++k) corner_[k] = glm::dvec3(frame.corner_ws(id, k));
    const glm::dvec3 n = glm::cross(corner_[1] - corner_[0], corner_[2] - corner_[0]);
    twice_area_ = std::sqrt(glm::dot(n, n));
    if (!(twice_area_ > 0)) return;
    normal_ = n / twice_area_;
    normals_.fill(normal_);
    const std::uint32_t first = frame.streams[cluster_of(id)].normal;
    if (first == frame::kNoStream) return;
    for (unsigned k = 0; k < 3; ++k) {
      const std::size_t v = first + (frame.corners[id] >> (8 * k) & 255U);
      normals_[k] = frame.normals_ws[v];
    }
  }

  [[nodiscard]] bool has_area() const { return twice_area_ > 0; }

  [[nodiscard]] double area() const { return twice_area_ / 2; }

  [[nodiscard]] Receiver at(std::uint32_t luxel, FlatWeights weights, double inset, double area) const {
    std::array<double, 3> w = {1 - weights.b - weights.c, weights.b, weights.c};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      // A weight is the distance to the edge opposite, in units of the triangle's height above it.
      const glm::dvec3 edge = corner_[(k + 1) % 3] - corner_[(k + 2) % 3];
      const double height = twice_area_ / std::sqrt(glm::dot(edge, edge));
      w[k] = std::max(w[k], std::min(inset / height, 0.25));
      sum += w[k];
    }
    glm::dvec3 position(0), shading(0);
    for (std::size_t k = 0; k < 3; ++k) {
      position += corner_[k] * (w[k] / sum);
      shading += normals_[k] * w[k];
    }
    const double length = std::sqrt(glm::dot(shading, shading));
    const glm::dvec3 smooth = length > 0 ? shading / length : normal_;
    return {luxel,
            id_,
            glm::vec3(position),
            glm::vec3(normal_),
            glm::vec3(smooth),
            static_cast<float>(w[1] / sum),
            static_cast<float>(w[2] / sum),
            static_cast<float>(area)};
  }

 private:
  TriangleId id_;
  std::array<glm::dvec3, 3> corner_, normals_;
  glm::dvec3 normal_{0};
  double twice_area_ = 0;
};

// One tile, triangle by triangle.
class TileReceivers {
 public:
  TileReceivers(const frame::Frame& frame, const PageTriangles& page, glm::ivec2 tile,
                const ReceiverSettings& settings)
      : frame_(frame), page_(page), low_(tile * kTileSide), settings_(settings) {
    high_ = glm::min(low_ + kTileSide, page.size());
    nearest_.fill(INFINITY);
  }

  void add(TriangleId id) {
    const FlatTriangle flat(corners_on(frame_, id, page_.size()));
    const Patch patch(frame_, id);
    if (!patch.has_area()) return;
    find_nearest(flat, patch);
    find_inside(flat, patch);
  }

  void take(const trace::RayScene& rays, std::vector<Receiver>& receivers) {
    std::stable_sort(inside_.begin(), inside_.end(),
                     [](const Receiver& a, const Receiver& b) { return a.luxel < b.luxel; });
    auto next = inside_.begin();
    for (std::uint32_t luxel = 0; luxel < kTileLuxels; ++luxel) {
      const auto first = next;
      while (next != inside_.end() && next->luxel == luxel) ++next;
      if (nearest_[luxel] > kReadAtRim * kReadAtRim) continue;
      const Receiver& middle = middles_[luxel];
      const std::size_t before = receivers.size();
      for (auto it = first; it != next; ++it) {
        if (settings_.samples == 1 || sees(rays, middle, *it)) receivers.push_back(*it);
      }
      if (receivers.size() == before) receivers.push_back(middle);
    }
  }

  void take_middles(std::vector<Receiver>& receivers) {
    const auto least = static_cast<float>(kLeastArea * settings_.luxel_side * settings_.luxel_side);
    for (const Receiver& inside : inside_) middles_[inside.luxel].area += inside.area;
    for (std::uint32_t luxel = 0; luxel < kTileLuxels; ++luxel) {
      if (nearest_[luxel] > kReadAtRim * kReadAtRim) continue;
      receivers.push_back(middles_[luxel]);
      receivers.back().area = std::max(receivers.back().area, least);
    }
  }

 private:
  [[nodiscard]] double inset() const { return kInset * settings_.luxel_side; }
  [[nodiscard]] std::uint32_t luxel_at(int x, int y) const {
    return static_cast<std::uint32_t>((y - low_.y) * kTileSide + (x - low_.x));
  }
  template <class Use>
  void for_luxels(const glm::dvec2& from, const glm::dvec2& to, Use use) const {
    const glm::ivec2 first(glm::max(glm::floor(from), glm::dvec2(low_)));
    const glm::ivec2 last(glm::min(glm::floor(to), glm::dvec2(high_ - 1)));
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) use(x, y);
    }
  }

  void find_nearest(const FlatTriangle& flat, const Patch& patch) {
    for_luxels(flat.low() - kReadAtRim, flat.high() + kReadAtRim, [&](int x, int y) {
      double squared = 0;
      const FlatWeights weights = flat.nearest({x + 0.5, y + 0.5}, squared);
      const std::uint32_t luxel = luxel_at(x, y);
      if (!(squared < nearest_[luxel])) return;
      nearest_[luxel] = squared;
      middles_[luxel] = patch.at(luxel, weights, inset(), 0);
    });
  }

  void find_inside(const FlatTriangle& flat, const Patch& patch) {
    const int n = settings_.samples;
    const double flat_area = std::abs(flat.twice_area()) / 2;
    const double area = flat_area > 0 ? patch.area() / (flat_area * n * n) : 0;
    for_luxels(flat.low(), flat.high(), [&](int x, int y) {
      for (int i = 0; i < n * n; ++i) {
        const int row = i / n;
        const glm::dvec2 place(x + (i % n + 0.5) / n, y + (row + 0.5) / n);
        if (!flat.holds(place)) continue;
        double squared = 0;
        inside_.push_back(patch.at(luxel_at(x, y), flat.nearest(place, squared), inset(), area));
      }
    });
  }

  // Whether nothing stands on the surface between two of a luxel's points.
  [[nodiscard]] bool sees(const trace::RayScene& rays, const Receiver& middle, const Receiver& other) const {
    const auto lift = static_cast<float>(kLift * settings_.luxel_side);
    const glm::vec3 from = middle.position_ws + lift * middle.normal_ws;
    const glm::vec3 along = other.position_ws + lift * other.normal_ws - from;
    return along == glm::vec3(0) || !rays.is_blocked(from, along, 0, 1, middle.id);
  }

  const frame::Frame& frame_;
  const PageTriangles& page_;
  glm::ivec2 low_, high_{0};
  const ReceiverSettings& settings_;
  std::array<double, kTileLuxels> nearest_;  // of each luxel's middle to a surface, squared
  std::array<Receiver, kTileLuxels> middles_;
  std::vector<Receiver> inside_;
};

}  // namespace

PageTriangles::PageTriangles(const frame::Frame& frame, const std::vector<bool>& materials, glm::ivec2 size)
    : size_(size), tiles_((size + kTileSide - 1) / kTileSide) {
  std::vector<TriangleId> all;
  for (std::size_t cluster = 0; cluster < frame.clusters.size(); ++cluster) {
    const Cluster& c = frame.clusters[cluster];
    if (!materials[c.material] || frame.streams[cluster].uv[1] == frame::kNoStream) continue;
    for (std::uint32_t t = 0; t < c.triangle_count; ++t)
      all.push_back(static_cast<TriangleId>(cluster << kTriangleBits) | t);
  }
  const auto for_tiles = [&](TriangleId id, const auto& use) {
    const FlatTriangle flat(corners_on(frame, id, size_));
    const glm::dvec2 last(tiles_ - 1);
    const glm::ivec2 from(
        glm::clamp(glm::floor((flat.low() - kReadAtRim) / double{kTileSide}), glm::dvec2(0), last));
    const glm::ivec2 to(
        glm::clamp(glm::floor((flat.high() + kReadAtRim) / double{kTileSide}), glm::dvec2(0), last));
    for (int y = from.y; y <= to.y; ++y) {
      for (int x = from.x; x <= to.x; ++x) use(static_cast<std::size_t>(y * tiles_.x + x));
    }
  };
  first_.assign(static_cast<std::size_t>(tiles_.x * tiles_.y) + 1, 0);
  for (const TriangleId id : all) for_tiles(id, [&](std::size_t tile) { ++first_[tile + 1]; });
  for (std::size_t tile = 1; tile < first_.size(); ++tile) first_[tile] += first_[tile - 1];
  triangles_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const TriangleId id : all) for_tiles(id, [&](std::size_t tile) { triangles_[next[tile]++] = id; });
}

std::span<const TriangleId> PageTriangles::at(glm::ivec2 tile) const {
  const auto index = static_cast<std::size_t>(tile.y * tiles_.x + tile.x);
  return std::span(triangles_).subspan(first_[index], first_[index + 1] - first_[index]);
}

void find_receivers(const frame::Frame& frame, const trace::RayScene& rays, const PageTriangles& page,
                    glm::ivec2 tile, const ReceiverSettings& settings, std::vector<Receiver>& receivers) {
  receivers.clear();
  const std::span<const TriangleId> triangles = page.at(tile);
  if (triangles.empty()) return;
  TileReceivers found(frame, page, tile, settings);
  for (const TriangleId id : triangles) found.add(id);
  found.take(rays, receivers);
}

Receiver receiver_on(const frame::Frame& frame, TriangleId id, FlatWeights weights) {
  return Patch(frame, id).at(0, weights, 0, 0);
}

void find_middles(const frame::Frame& frame, const PageTriangles& page, glm::ivec2 tile,
                  const ReceiverSettings& settings, std::vector<Receiver>& receivers) {
  receivers.clear();
  const std::span<const TriangleId> triangles = page.at(tile);
  if (triangles.empty()) return;
  TileReceivers found(frame, page, tile, settings);
  for (const TriangleId id : triangles) found.add(id);
  found.take_middles(receivers);
}

}  // namespace laterna::bake
