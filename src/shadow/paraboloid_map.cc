#include "shadow/paraboloid_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "frame/surface_alpha.h"

namespace laterna::shadow {
namespace {

// Texels are drawn in squares of this side: most of a large triangle's bound is passed over square by square.
constexpr int kSquareSide = 16;

// Cones wider than this are looked for everywhere. A cone of less than half of all directions that holds three corners
// holds the triangle between them.
constexpr double kLeastCosine = 0.05;

}  // namespace

ParaboloidPair::ParaboloidPair(const Pose& pose, int resolution, int border)
    : eye_ws_(pose.position_ws), side_(resolution + 2 * border), step_(2.0 / resolution) {
  const glm::dmat3& axes = pose.world_from_view_rotation;
  local_from_world_ = glm::transpose(glm::dmat3(axes[0], axes[1], -axes[2]));  // views look along −z
}

// The map is a stereographic projection, which takes circles to circles. With (2u, 2v, 1 − r²) / (1 + r²) for the direction,
// direction · axis ≥ cosine becomes r² (cosine + z) − 2 (u x + v y) + cosine − z ≤ 0.
ParaboloidPair::Texels ParaboloidPair::find_cone(const glm::dvec3& axis, double cosine, int map) const {
  constexpr double kSmallest = 1e-6;
  const double half = 0.5 * side_ * step_;
  const double divisor = cosine + (map == 0 ? axis.z : -axis.z);
  if (std::abs(divisor) < kSmallest) return all_texels();
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const glm::dvec2 centre(axis.x / divisor, axis.y / divisor);
  const double radius = sine / std::abs(divisor);
  if (divisor < 0) {
    // The cone holds the direction opposite to the map's axis: its image is what lies outside the circle.
    const bool is_beyond = glm::length(centre) + std::sqrt(2.0) * half < radius * (1 - kSmallest);
    return is_beyond ? Texels() : all_texels();
  }
  const auto texel = [&](double u) {
    const double margin = std::clamp(u / step_ + 0.5 * side_, -2.0, side_ + 2.0);
    return static_cast<int>(std::floor(margin));
  };
  const auto held = [&](int t) { return std::clamp(t, 0, side_); };
  return {held(texel(centre.x - radius) - 1), held(texel(centre.x + radius) + 2),
          held(texel(centre.y - radius) - 1), held(texel(centre.y + radius) + 2)};
}

LocalTriangle::LocalTriangle(const frame::Frame& frame, TriangleId id, const ParaboloidPair& pair) {
  for (unsigned k = 0; k < 3; ++k) corner[k] = pair.to_eye(frame.corner_ws(id, k));
}

double LocalTriangle::volume() const { return glm::dot(corner[0], glm::cross(corner[1], corner[2])); }

class ParaboloidMap::Painter {
 public:
  Painter(const frame::Frame& frame, const ParaboloidPair& pair, const Casters& casters)
      : frame_(frame),
        pair_(pair),
        casters_(casters),
        squares_((pair.side() + kSquareSide - 1) / kSquareSide) {}

  [[nodiscard]] std::size_t band_count() const { return 2 * static_cast<std::size_t>(squares_); }

  // In the order of ids, whoever draws them.
  void bin(const TaskPool& pool) {
    std::vector<std::vector<Entry>> found(frame_.clusters.size());
    pool.for_each(frame_.clusters.size(), [&](std::size_t c, int) { find_entries(c, found[c]); });
    bands_.resize(band_count());
    for (const std::vector<Entry>& entries : found) {
      for (const Entry& entry : entries) {
        const int first = entry.map * squares_ + entry.texels.y_first / kSquareSide;
        const int last = entry.map * squares_ + (entry.texels.y_end - 1) / kSquareSide;
        for (int band = first; band <= last; ++band) bands_[static_cast<std::size_t>(band)].push_back(entry);
      }
    }
  }

  // One row of squares.
  void draw_band(std::size_t band, std::vector<Texel>& texels) const {
    const int row = static_cast<int>(band) % squares_;
    const int y_first = row * kSquareSide, y_end = std::min(y_first + kSquareSide, pair_.side());
    const int map = static_cast<int>(band) / squares_;
    std::vector<glm::dvec3> directions;
    for (int y = y_first; y < y_end; ++y) {
      for (int x = 0; x < pair_.side(); ++x)
        directions.push_back(pair_.direction_of({x + 0.5, y + 0.5}, map));
    }
    const std::vector<Square> squares = find_squares(map, y_first, y_end);
    for (const Entry& entry : bands_[band]) {
      const Edges edges(LocalTriangle(frame_, entry.id, pair_));
      const Texels rows = {entry.texels.x_first, entry.texels.x_end, std::max(y_first, entry.texels.y_first),
                           std::min(y_end, entry.texels.y_end)};
      for (int s = rows.x_first / kSquareSide; s * kSquareSide < rows.x_end; ++s) {
        if (!edges.may_meet(squares[static_cast<std::size_t>(s)])) continue;
        Texels here = rows;
        here.x_first = std::max(rows.x_first, s * kSquareSide);
        here.x_end = std::min(rows.x_end, (s + 1) * kSquareSide);
        draw(edges, entry.id, here, {directions.data(), y_first}, texels);
      }
    }
  }

 private:
  using Texels = ParaboloidPair::Texels;

  struct Entry {
    TriangleId id;
    int map;
    Texels texels;
  };

  // Directions of a square's texels, in a cone.
  struct Square {
    glm::dvec3 axis;
    double sine;
  };

  // Planes through the light and the edges: a direction's weights of the three corners, times a positive number.
  struct Edges {
    std::array<glm::dvec3, 3> normal;
    std::array<double, 3> length;
    double inverse_volume;

    explicit Edges(const LocalTriangle& t) {
      const double volume = t.volume();
      const double sign = volume < 0 ? -1 : 1;
      for (std::size_t k = 0; k < 3; ++k) {
        normal[k] = sign * glm::cross(t.corner[(k + 1) % 3], t.corner[(k + 2) % 3]);
        length[k] = glm::length(normal[k]);
      }
      inverse_volume = 1 / std::abs(volume);
    }
    [[nodiscard]] bool may_meet(const Square& square) const {
      for (std::size_t k = 0; k < 3; ++k) {
        if (glm::dot(normal[k], square.axis) < -square.sine * length[k]) return false;
      }
      return true;
    }
  };

  struct Directions {
    const glm::dvec3* of_band;
    int y_first;
  };

  void find_entries(std::size_t c, std::vector<Entry>& entries) const {
    const Cluster& cluster = frame_.clusters[c];
    if (!is_opaque_caster(cluster) || (cluster.flags & casters_.mask) != casters_.flags) return;
    for (std::uint32_t k = 0; k < cluster.triangle_count; ++k) {
      const TriangleId id = static_cast<TriangleId>(c << kTriangleBits) | k;
      const LocalTriangle triangle(frame_, id, pair_);
      const double volume = triangle.volume();
      // Seen edge-on it hides nothing.
      if (volume == 0 || (casters_.faces == CasterFaces::back_only && volume > 0)) continue;
      for (int map = 0; map < 2; ++map) {
        const Texels texels = find_texels(triangle, map);
        if (!texels.is_empty()) entries.push_back({id, map, texels});
      }
    }
  }

  [[nodiscard]] Texels find_texels(const LocalTriangle& t, int map) const {
    std::array<glm::dvec3, 3> way;
    for (std::size_t k = 0; k < 3; ++k) way[k] = t.corner[k] / glm::length(t.corner[k]);
    const glm::dvec3 sum = way[0] + way[1] + way[2];
    const double length = glm::length(sum);
    if (!(length > kLeastCosine)) return pair_.all_texels();
    const glm::dvec3 axis = sum / length;
    const double cosine = std::min({glm::dot(axis, way[0]), glm::dot(axis, way[1]), glm::dot(axis, way[2])});
    return cosine > kLeastCosine ? pair_.find_cone(axis, cosine, map) : pair_.all_texels();
  }

  [[nodiscard]] std::vector<Square> find_squares(int map, int y_first, int y_end) const {
    std::vector<Square> squares;
    for (int s = 0; s < squares_; ++s) {
      const int x_first = s * kSquareSide, x_end = std::min(x_first + kSquareSide, pair_.side());
      const glm::dvec3 axis = pair_.direction_of({0.5 * (x_first + x_end), 0.5 * (y_first + y_end)}, map);
      double cosine = 1;
      for (const int x : {x_first, x_end}) {
        for (const int y : {y_first, y_end})
          cosine = std::min(cosine, glm::dot(axis, pair_.direction_of({x, y}, map)));
      }
      // Of very small maps a square may show more than half of all directions.
      squares.push_back(
          {axis, cosine < kLeastCosine ? 1.0 : std::sqrt(std::max(0.0, 1 - cosine * cosine)) + 1e-9});
    }
    return squares;
  }

  void draw(const Edges& edges, TriangleId id, const Texels& where, const Directions& directions,
            std::vector<Texel>& texels) const {
    const auto side = static_cast<std::size_t>(pair_.side());
    for (int y = where.y_first; y < where.y_end; ++y) {
      const glm::dvec3* row = directions.of_band + static_cast<std::size_t>(y - directions.y_first) * side;
      Texel* texel_row = texels.data() + static_cast<std::size_t>(y) * side;
      for (int x = where.x_first; x < where.x_end; ++x) {
        const double a = glm::dot(edges.normal[0], row[x]);
        const double b = glm::dot(edges.normal[1], row[x]);
        const double c = glm::dot(edges.normal[2], row[x]);
        if (a < 0 || b < 0 || c < 0) continue;
        // The direction is the corners' sum with these weights over the volume: on the plane where they add up to 1.
        const double sum = a + b + c;
        const auto reverse = static_cast<float>(sum * edges.inverse_volume);
        const Texel& seen = texel_row[x];
        const bool is_before = reverse > seen.reverse_distance ||
                               (reverse == seen.reverse_distance && id < seen.id && seen.id != kNoTriangle);
        if (!is_before) continue;
        if (frame::is_hole(frame_, id, static_cast<float>(b / sum), static_cast<float>(c / sum))) continue;
        texel_row[x] = {reverse, id};
      }
    }
  }

  const frame::Frame& frame_;
  const ParaboloidPair& pair_;
  Casters casters_;
  int squares_;  // in a row
  std::vector<std::vector<Entry>> bands_;
};

ParaboloidMap::ParaboloidMap(const frame::Frame& frame, const ParaboloidPair& pair, const Casters& casters,
                             const ParaboloidMap* under, const TaskPool& pool,
                             const std::function<bool()>& asks_to_stop)
    : pair_(pair) {
  for (std::vector<Texel>& texels : texels_)
    texels.resize(static_cast<std::size_t>(pair_.side()) * static_cast<std::size_t>(pair_.side()));
  if (under != nullptr) texels_ = under->texels_;
  Painter painter(frame, pair_, casters);
  painter.bin(pool);
  pool.for_each(painter.band_count(), [&](std::size_t band, int) {
    if (!asks_to_stop()) painter.draw_band(band, texels_[2 * band / painter.band_count()]);
  });
}

const ParaboloidMap::Texel& ParaboloidMap::at(int map, int x, int y) const {
  const int last = pair_.side() - 1;
  const auto column = static_cast<std::size_t>(std::clamp(x, 0, last));
  const auto row = static_cast<std::size_t>(std::clamp(y, 0, last));
  return texels_[static_cast<std::size_t>(map)][row * static_cast<std::size_t>(pair_.side()) + column];
}

}  // namespace laterna::shadow
