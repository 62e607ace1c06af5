#include "reference/luxel_rooms.h"

#include <glm/geometric.hpp>
#include <limits>

namespace laterna::reference {
namespace {

// The triangle whose middle or inside is nearest: for luxels that lie on it exactly.
TriangleId triangle_at(const frame::Frame& frame, glm::vec3 point, glm::vec3 normal) {
  TriangleId found = kNoTriangle;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t c = 0; c < frame.clusters.size(); ++c) {
    for (std::uint32_t t = 0; t < frame.clusters[c].triangle_count; ++t) {
      const TriangleId id = c << kTriangleBits | t;
      const glm::dvec3 a(frame.corner_ws(id, 0)), b(frame.corner_ws(id, 1)), d(frame.corner_ws(id, 2));
      const glm::dvec3 face = glm::normalize(glm::cross(b - a, d - a));
      if (std::abs(glm::dot(face, glm::dvec3(normal))) < 0.99) continue;
      const glm::dvec3 p(point);
      // How far the point is outside of the triangle, over its plane and over its edges.
      double outside = std::abs(glm::dot(p - a, face));
      outside = std::max(outside, -glm::dot(glm::cross(b - a, p - a), face) / glm::length(b - a));
      outside = std::max(outside, -glm::dot(glm::cross(d - b, p - b), face) / glm::length(d - b));
      outside = std::max(outside, -glm::dot(glm::cross(a - d, p - d), face) / glm::length(a - d));
      if (outside < least) {
        least = outside;
        found = id;
      }
    }
  }
  return found;
}

}  // namespace

std::size_t LuxelRoom::add(const Rectangle& r, float opacity, glm::vec3 color) {
  const std::size_t first = luxels.size();
  Mesher mesher;
  mesher.quad(r.corner, r.corner + r.along, r.corner + r.along + r.up, r.corner + r.up);
  add_object(scene, "rectangle " + std::to_string(scene.nodes.size()), mesher.primitive, color);
  if (opacity < 1) {
    scene.materials.back().base_color[3] = opacity;
    scene.materials.back().alpha_mode = AlphaMode::blend;
  }
  const glm::vec3 cross = glm::cross(r.along, r.up);
  for (int row = 0; row < r.rows; ++row) {
    for (int column = 0; column < r.columns; ++column) {
      const float u = (static_cast<float>(column) + 0.5F) / static_cast<float>(r.columns);
      const float v = (static_cast<float>(row) + 0.5F) / static_cast<float>(r.rows);
      luxels.push_back({r.corner + r.along * u + r.up * v, glm::normalize(cross),
                        glm::length(cross) / static_cast<float>(r.columns * r.rows), kNoTriangle,
                        r.reflectance});
      exitance.push_back(r.exitance);
      direct_irradiance.emplace_back(0);
    }
  }
  return first;
}

std::size_t LuxelRoom::add_box(glm::vec3 low, glm::vec3 high, int n, bool from_inside, glm::vec3 reflectance,
                               glm::vec3 face_exitance) {
  const std::size_t first = luxels.size();
  const glm::vec3 size = high - low;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 along(0), up(0), across(0);
    along[(axis + 1) % 3] = size[(axis + 1) % 3];
    up[(axis + 2) % 3] = size[(axis + 2) % 3];
    across[axis] = size[axis];
    // cross(along, up) points to +axis: outside at the high face, inside at the low one.
    for (const bool is_high : {false, true}) {
      const glm::vec3 corner = is_high ? low + across : low;
      if (is_high != from_inside)
        add({corner, along, up, n, n, reflectance, face_exitance});
      else
        add({corner, up, along, n, n, reflectance, face_exitance});
    }
  }
  return first;
}

LitRoom::LitRoom(LuxelRoom given) : room(std::move(given)), owned(make_frame(std::move(room.scene))) {
  for (bake::Luxel& luxel : room.luxels)
    luxel.triangle = triangle_at(owned.frame, luxel.position_ws, luxel.normal_ws);
  rays = std::make_unique<trace::RayScene>(owned.frame);
}

Result<bake::Interreflection> LitRoom::solve(const RadiositySettings& settings, int threads,
                                             const Progress& progress) const {
  return bake::interreflect(owned.frame, *rays, room.luxels, {room.direct_irradiance, room.exitance},
                            settings, TaskPool(threads), progress);
}

double LitRoom::mean(const bake::Interreflection& solved, std::size_t first, std::size_t count, int channel) {
  double sum = 0;
  for (std::size_t i = first; i < first + count; ++i)
    sum += static_cast<double>(solved.irradiance[i][channel]);
  return sum / static_cast<double>(count);
}

}  // namespace laterna::reference
