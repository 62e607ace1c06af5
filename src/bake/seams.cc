#include "bake/seams.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "base/triangle_clusters.h"

namespace laterna::bake {
namespace {

// ---------------------------------------------------------------------------------------------- where seams are

// Of shading normals on both sides, at which they count as one.
constexpr float kSmooth = 0.99F;
// Of the triangles' own normals: at sharper bends light comes and goes even on smooth surfaces, as at the rim of a vase.
constexpr float kBend = 0.7F;
// Luxels by which two places of one point lie apart at least; less is rounding.
constexpr double kApart = 1e-2;
constexpr double kPointsPerLuxel = 2;

// One end of an edge, as one of its triangles has it.
struct EdgeEnd {
  glm::dvec2 place;  // in the page, in luxels
  glm::vec3 normal_ws;
};
using Edge = std::array<EdgeEnd, 2>;

class SeamFinder {
 public:
  SeamFinder(const frame::Frame& frame, const frame::TriangleNeighbours& neighbours, glm::ivec2 size)
      : frame_(frame), neighbours_(neighbours), size_(size) {}

  void add(TriangleId id) {
    const auto source = static_cast<std::size_t>(neighbours_.sources[cluster_of(id)]) / 2;
    const glm::ivec3& steps =
        neighbours_.meshes->steps[source << kTriangleBits | (id & (kTrianglesPerCluster - 1))];
    for (int k = 0; k < 3; ++k) {
      const std::int32_t step = steps[k];
      // Each pair once; where more than two share an edge, the last of the ring meets the first again.
      if (step > 0) add(id, static_cast<TriangleId>(static_cast<std::int64_t>(id) + step));
    }
  }

  [[nodiscard]] std::vector<SeamPoint> take() { return std::move(points_); }

 private:
  void add(TriangleId a, TriangleId b) {
    for (unsigned k = 0; k < 3; ++k) {
      const glm::vec3 from = frame_.corner_ws(a, k), to = frame_.corner_ws(a, (k + 1) % 3);
      const std::optional<unsigned> of_from = corner_at(b, from), of_to = corner_at(b, to);
      if (!of_from || !of_to || from == to || !(glm::dot(normal_of(a), normal_of(b)) > kBend)) continue;
      add({end_at(a, k), end_at(a, (k + 1) % 3)}, {end_at(b, *of_from), end_at(b, *of_to)});
    }
  }

  [[nodiscard]] std::optional<unsigned> corner_at(TriangleId id, const glm::vec3& position_ws) const {
    for (unsigned k = 0; k < 3; ++k) {
      if (frame_.corner_ws(id, k) == position_ws) return k;
    }
    return {};
  }

  [[nodiscard]] EdgeEnd end_at(TriangleId id, unsigned corner) const {
    const frame::ClusterStreams& streams = frame_.streams[cluster_of(id)];
    const std::uint32_t local = frame_.corners[id] >> (8 * corner) & 255U;
    const std::size_t uv = streams.uv[1] + local;
    EdgeEnd end = {glm::dvec2(frame_.uvs[1][uv]) * glm::dvec2(size_), {}};
    if (streams.normal != frame::kNoStream) {
      const std::size_t n = streams.normal + local;
      end.normal_ws = frame_.normals_ws[n];
    } else {
      end.normal_ws = normal_of(id);
    }
    return end;
  }

  [[nodiscard]] glm::vec3 normal_of(TriangleId id) const {
    const glm::vec3 at = frame_.corner_ws(id, 0);
    const glm::vec3 normal = glm::cross(frame_.corner_ws(id, 1) - at, frame_.corner_ws(id, 2) - at);
    const float length = glm::length(normal);
    return length > 0 ? normal / length : normal;
  }

  void add(const Edge& a, const Edge& b) {
    double apart = 0, length = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!(glm::dot(a[k].normal_ws, b[k].normal_ws) > kSmooth)) return;
      apart = std::max(apart, glm::length(a[k].place - b[k].place));
    }
    if (!(apart > kApart)) return;
    for (const Edge* edge : {&a, &b})
      length = std::max(length, glm::length((*edge)[1].place - (*edge)[0].place));
    const int count = std::max(1, static_cast<int>(std::ceil(kPointsPerLuxel * length)));
    for (int i = 0; i < count; ++i) {
      const double t = (i + 0.5) / count;
      SeamPoint point;
      look_up(glm::mix(a[0].place, a[1].place, t), 1, 0, point);
      look_up(glm::mix(b[0].place, b[1].place, t), -1, 4, point);
      points_.push_back(point);
    }
  }

  // Bilinear, as textures are read; at the page's rim the outermost luxels go on.
  void look_up(const glm::dvec2& place, double sign, std::size_t first, SeamPoint& point) const {
    const glm::dvec2 from = glm::floor(place - 0.5), share = place - 0.5 - from;
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::dvec2 step(k & 1U, k >> 1U);
      const glm::ivec2 luxel = glm::clamp(glm::ivec2(from + step), glm::ivec2(0), size_ - 1);
      const glm::dvec2 part = glm::mix(1.0 - share, share, step);
      point.luxel[first + k] = static_cast<std::uint32_t>(luxel.y) * static_cast<std::uint32_t>(size_.x) +
                               static_cast<std::uint32_t>(luxel.x);
      point.weight[first + k] = static_cast<float>(sign * part.x * part.y);
    }
  }

  const frame::Frame& frame_;
  const frame::TriangleNeighbours& neighbours_;
  glm::ivec2 size_;
  std::vector<SeamPoint> points_;
};

// ---------------------------------------------------------------------------------------------- what is read there

// Of a difference at a seam against a change of a luxel: what remains of differences is about this share.
constexpr double kKept = 0.05;
constexpr int kMostSteps = 200;
constexpr double kClose = 1e-5;  // of what the differences were

using Colors = std::vector<glm::dvec3>;

glm::dvec3 dot(const Colors& a, const Colors& b) {
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Least squares: (SᵀS + kept) change = −SᵀS x, by conjugate gradients, channel by channel. Luxels are numbered as they are met.
class SeamJoiner {
 public:
  SeamJoiner(std::span<const SeamPoint> seams, std::size_t luxels) : seams_(seams.begin(), seams.end()) {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(luxels, kNone);
    for (SeamPoint& point : seams_) {
      for (std::uint32_t& luxel : point.luxel) {
        if (number[luxel] == kNone) {
          number[luxel] = static_cast<std::uint32_t>(luxel_.size());
          luxel_.push_back(luxel);
        }
        luxel = number[luxel];
      }
    }
  }

  void join(std::span<float> rgb) const {
    Colors values(luxel_.size());
    for (std::size_t i = 0; i < luxel_.size(); ++i) {
      for (int c = 0; c < 3; ++c)
        values[i][c] = rgb[3 * std::size_t{luxel_[i]} + static_cast<std::size_t>(c)];
    }
    const Colors change = solve(values);
    for (std::size_t i = 0; i < luxel_.size(); ++i) {
      const glm::dvec3 joined = glm::max(values[i] + change[i], 0.0);
      for (int c = 0; c < 3; ++c)
        rgb[3 * std::size_t{luxel_[i]} + static_cast<std::size_t>(c)] = static_cast<float>(joined[c]);
    }
  }

 private:
  // SᵀS x + kept · x
  [[nodiscard]] Colors apply(const Colors& x, double kept) const {
    Colors result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = kept * x[i];
    for (const SeamPoint& point : seams_) {
      glm::dvec3 difference(0);
      for (std::size_t k = 0; k < point.luxel.size(); ++k)
        difference += double{point.weight[k]} * x[point.luxel[k]];
      for (std::size_t k = 0; k < point.luxel.size(); ++k)
        result[point.luxel[k]] += double{point.weight[k]} * difference;
    }
    return result;
  }

  [[nodiscard]] Colors solve(const Colors& values) const {
    Colors change(values.size(), glm::dvec3(0)), rest = apply(values, 0);
    for (glm::dvec3& r : rest) r = -r;
    Colors direction = rest;
    glm::dvec3 squared = dot(rest, rest);
    const glm::dvec3 enough = kClose * kClose * squared;
    const auto ratio = [](const glm::dvec3& a, const glm::dvec3& b) {
      return glm::dvec3(b.x > 0 ? a.x / b.x : 0, b.y > 0 ? a.y / b.y : 0, b.z > 0 ? a.z / b.z : 0);
    };
    for (int step = 0; step < kMostSteps && glm::any(glm::greaterThan(squared, enough)); ++step) {
      const Colors applied = apply(direction, kKept);
      const glm::dvec3 length = ratio(squared, dot(direction, applied));
      for (std::size_t i = 0; i < change.size(); ++i) {
        change[i] += length * direction[i];
        rest[i] -= length * applied[i];
      }
      const glm::dvec3 next = dot(rest, rest), turn = ratio(next, squared);
      for (std::size_t i = 0; i < change.size(); ++i) direction[i] = rest[i] + turn * direction[i];
      squared = next;
    }
    return change;
  }

  std::vector<SeamPoint> seams_;      // with the luxels' numbers here
  std::vector<std::uint32_t> luxel_;  // by number
};

}  // namespace

std::vector<SeamPoint> find_seams(const frame::Frame& frame, const frame::TriangleNeighbours& neighbours,
                                  const std::vector<bool>& materials, glm::ivec2 size) {
  SeamFinder finder(frame, neighbours, size);
  if (neighbours.meshes->steps.empty()) return {};
  for (std::uint32_t cluster = 0; cluster < frame.clusters.size(); ++cluster) {
    if (!materials[frame.clusters[cluster].material]) continue;
    for (std::uint32_t t = 0; t < frame.clusters[cluster].triangle_count; ++t)
      finder.add(cluster << kTriangleBits | t);
  }
  return finder.take();
}

void join_seams(std::span<const SeamPoint> seams, std::span<Image* const> pictures) {
  if (seams.empty()) return;
  const Image& first = *pictures.front();
  const SeamJoiner joiner(seams,
                          static_cast<std::size_t>(first.width()) * static_cast<std::size_t>(first.height()));
  for (Image* picture : pictures) joiner.join(picture->values<float>());
}

}  // namespace laterna::bake
