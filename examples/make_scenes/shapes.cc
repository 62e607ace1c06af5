#include "shapes.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace laterna::examples {
namespace {

constexpr float kPi = 3.14159265F;

void add_quad(Primitive& p, const std::array<glm::vec3, 4>& corners, const std::array<glm::vec2, 4>& uv) {
  const auto first = static_cast<std::uint32_t>(p.positions.size());
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
  for (std::size_t i = 0; i < 4; ++i) {
    p.positions.push_back(corners[i]);
    p.normals.push_back(normal);
    p.uv[0].push_back(uv[i]);
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) p.indices.push_back(first + i);
}

/// Triangles of a grid of (rows + 1) × (columns + 1) vertices that starts at `first`; empty ones, as at
/// poles, are left out.
void add_grid_faces(Primitive& p, std::uint32_t first, std::uint32_t rows, std::uint32_t columns) {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::vec3 area = glm::cross(p.positions[b] - p.positions[a], p.positions[c] - p.positions[a]);
    if (glm::dot(area, area) < 1e-18F) return;
    p.indices.insert(p.indices.end(), {a, b, c});
  };
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t a = first + r * (columns + 1) + c;
      const std::uint32_t above = a + columns + 1;
      add(a, above + 1, above);
      add(a, a + 1, above + 1);
    }
  }
}

/// Whether the outline breaks between i and i + 1.
bool is_sharp(const std::vector<Turning>& outline, std::size_t i) {
  return outline[i].radius == outline[i + 1].radius && outline[i].height == outline[i + 1].height;
}

/// A Catmull-Rom curve through the points of every stretch between sharp edges (Catmull and Rom, A class of
/// local interpolating splines, 1974). A stretch of two points stays straight.
std::vector<Turning> rounded(const std::vector<Turning>& corners) {
  constexpr int kParts = 4;
  std::vector<Turning> outline = {corners.front()};
  const auto at = [&](std::size_t i) { return glm::vec2(corners[i].radius, corners[i].height); };
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const bool is_start = i == 0 || is_sharp(corners, i - 1);
    const bool is_end = i + 2 == corners.size() || is_sharp(corners, i + 1);
    const glm::vec2 a = at(i);
    const glm::vec2 b = at(i + 1);
    const glm::vec2 leaving = is_start ? b - a : (b - at(i - 1)) * 0.5F;
    const glm::vec2 arriving = is_end ? b - a : (at(i + 2) - a) * 0.5F;
    const int parts = is_sharp(corners, i) || (is_start && is_end) ? 1 : kParts;
    for (int part = 1; part < parts; ++part) {
      const float t = static_cast<float>(part) / kParts;
      const float s = 1 - t;
      const glm::vec2 p = a * (s * s * (1 + 2 * t)) + leaving * (t * s * s) + b * (t * t * (1 + 2 * s)) -
                          arriving * (t * t * s);
      outline.push_back({p.x, p.y});
    }
    outline.push_back(corners[i + 1]);
  }
  return outline;
}

}  // namespace

Primitive rectangle(glm::vec3 centre, glm::vec3 right, glm::vec3 up, glm::vec2 size, float metres_per_tile) {
  Primitive p;
  const glm::vec3 half_right = right * (size.x / 2);
  const glm::vec3 half_up = up * (size.y / 2);
  const glm::vec2 tiles = size / metres_per_tile;
  add_quad(p,
           {centre - half_right - half_up, centre + half_right - half_up, centre + half_right + half_up,
            centre - half_right + half_up},
           {{{0, tiles.y}, {tiles.x, tiles.y}, {tiles.x, 0}, {0, 0}}});
  return p;
}

Primitive box(glm::vec3 low, glm::vec3 high) {
  Primitive p;
  const glm::vec3 centre = (low + high) / 2.0F;
  const glm::vec3 size = high - low;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      glm::vec3 normal(0);
      normal[axis] = side;
      glm::vec3 right(0);
      right[(axis + 1) % 3] = side;
      glm::vec3 up(0);
      up[(axis + 2) % 3] = 1;
      append(p, rectangle(centre + normal * size / 2.0F, right, up,
                          {std::abs(glm::dot(size, right)), glm::dot(size, up)}, 1));
    }
  }
  return p;
}

Primitive lathe(glm::vec3 foot, const std::vector<Turning>& corners, int segments) {
  Primitive p;
  const std::vector<Turning> outline = rounded(corners);
  const auto columns = static_cast<std::uint32_t>(segments);
  // Each stretch between sharp edges is smooth in itself.
  for (std::size_t first = 0; first + 1 < outline.size();) {
    std::size_t last = first + 1;
    while (last + 1 < outline.size() && !is_sharp(outline, last)) ++last;
    const auto base = static_cast<std::uint32_t>(p.positions.size());
    for (std::size_t i = first; i <= last; ++i) {
      const Turning& before = outline[i > first ? i - 1 : i];
      const Turning& after = outline[i < last ? i + 1 : i];
      const glm::vec2 slope =
          glm::normalize(glm::vec2(after.height - before.height, before.radius - after.radius));
      for (int s = 0; s <= segments; ++s) {
        const float angle = 2 * kPi * static_cast<float>(s % segments) / static_cast<float>(segments);
        const glm::vec3 out(std::cos(angle), 0, -std::sin(angle));
        p.positions.push_back(foot + out * outline[i].radius + glm::vec3(0, outline[i].height, 0));
        p.normals.push_back(glm::normalize(out * slope.x + glm::vec3(0, slope.y, 0)));
        p.uv[0].emplace_back(static_cast<float>(s) / static_cast<float>(segments), -outline[i].height);
      }
    }
    add_grid_faces(p, base, static_cast<std::uint32_t>(last - first), columns);
    first = last + (last + 1 < outline.size() ? 1 : 0);
  }
  return p;
}

Primitive ball(glm::vec3 centre, float radius, int rings) {
  std::vector<Turning> outline;
  for (int i = 0; i <= rings; ++i) {
    const float angle = kPi * (static_cast<float>(i) / static_cast<float>(rings) - 0.5F);
    outline.push_back({i == 0 || i == rings ? 0 : radius * std::cos(angle), radius * std::sin(angle)});
  }
  return lathe(centre, outline, 2 * rings);
}

Primitive ring(glm::vec3 centre, glm::vec3 axis, float radius, float tube, int segments) {
  Primitive p;
  axis = glm::normalize(axis);
  const glm::vec3 side =
      glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
  const glm::vec3 other = glm::cross(axis, side);
  const int around = segments / 2;
  for (int s = 0; s <= segments; ++s) {
    const float a = 2 * kPi * static_cast<float>(s % segments) / static_cast<float>(segments);
    const glm::vec3 out = side * std::cos(a) + other * std::sin(a);
    for (int t = 0; t <= around; ++t) {
      const float b = 2 * kPi * static_cast<float>(t % around) / static_cast<float>(around);
      const glm::vec3 normal = out * std::cos(b) - axis * std::sin(b);
      p.positions.push_back(centre + out * radius + normal * tube);
      p.normals.push_back(normal);
      p.uv[0].emplace_back(4 * static_cast<float>(s) / static_cast<float>(segments),
                           static_cast<float>(t) / static_cast<float>(around));
    }
  }
  add_grid_faces(p, 0, static_cast<std::uint32_t>(segments), static_cast<std::uint32_t>(around));
  return p;
}

void append(Primitive& primitive, const Primitive& more) {
  const auto first = static_cast<std::uint32_t>(primitive.positions.size());
  primitive.positions.insert(primitive.positions.end(), more.positions.begin(), more.positions.end());
  primitive.normals.insert(primitive.normals.end(), more.normals.begin(), more.normals.end());
  primitive.uv[0].insert(primitive.uv[0].end(), more.uv[0].begin(), more.uv[0].end());
  for (const std::uint32_t i : more.indices) primitive.indices.push_back(first + i);
}

}  // namespace laterna::examples
