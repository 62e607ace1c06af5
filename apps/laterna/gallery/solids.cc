#include "solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace laterna::app {
namespace {

/// Triangles of a grid of (rows + 1) × (columns + 1) vertices that starts at `first`; empty ones, as at poles, are left
/// out. The front is where (along a row) × (from row to row) points.
void add_grid_faces(Primitive& p, std::uint32_t first, std::uint32_t rows, std::uint32_t columns) {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::vec3& pa = p.positions[a];
    const glm::vec3& pb = p.positions[b];
    const glm::vec3& pc = p.positions[c];
    if (pa == pb || pb == pc || pc == pa) return;
    p.indices.insert(p.indices.end(), {a, b, c});
  };
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t a = first + r * (columns + 1) + c;
      const std::uint32_t next = a + columns + 1;
      add(a, a + 1, next + 1);
      add(a, next + 1, next);
    }
  }
}

/// A place on the Catmull-Rom curve from b to c (Catmull and Rom, A class of local interpolating splines, 1974).
template <class Vector>
Vector on_curve(const Vector& a, const Vector& b, const Vector& c, const Vector& d, float t) {
  // Slopes by the way from point to point, so that a short step after a long one is not overshot.
  const float step = glm::length(c - b);
  const Vector leaving = (c - a) * (step / (step + glm::length(b - a)));
  const Vector arriving = (d - b) * (step / (step + glm::length(d - c)));
  const float s = 1 - t;
  return b * (s * s * (1 + 2 * t)) + leaving * (t * s * s) + c * (t * t * (1 + 2 * s)) -
         arriving * (t * t * s);
}

/// A smooth line through points, `parts` steps from each to the next. Beyond the ends it goes on straight.
template <class Vector>
std::vector<Vector> smooth_line(const std::vector<Vector>& points, int parts) {
  std::vector<Vector> line = {points.front()};
  const std::size_t last = points.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const Vector before = i > 0 ? points[i - 1] : points[i] * 2.0F - points[i + 1];
    const Vector after = i + 1 < last ? points[i + 2] : points[i + 1] * 2.0F - points[i];
    for (int part = 1; part < parts; ++part) {
      const float t = static_cast<float>(part) / static_cast<float>(parts);
      line.push_back(on_curve(before, points[i], points[i + 1], after, t));
    }
    line.push_back(points[i + 1]);
  }
  return line;
}

/// One smooth stretch of a turned piece: (radius, height) from the foot up.
void add_turned_stretch(Primitive& p, glm::vec3 foot, const std::vector<glm::vec2>& line, int segments) {
  const auto base = static_cast<std::uint32_t>(p.positions.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::vec2 before = line[i > 0 ? i - 1 : i];
    const glm::vec2 after = line[i + 1 < line.size() ? i + 1 : i];
    const glm::vec2 slope = glm::normalize(glm::vec2(after.y - before.y, before.x - after.x));
    for (int s = 0; s <= segments; ++s) {
      // The seam's two columns are the same points.
      const glm::dvec2 turn = point_of_circle(static_cast<double>(s % segments) / segments);
      const glm::vec3 out(static_cast<float>(turn.x), 0, static_cast<float>(-turn.y));
      p.positions.push_back(foot + out * line[i].x + glm::vec3(0, line[i].y, 0));
      p.normals.push_back(glm::normalize(out * slope.x + glm::vec3(0, slope.y, 0)));
      p.uv[0].emplace_back(static_cast<float>(s) / static_cast<float>(segments), -line[i].y);
    }
  }
  add_grid_faces(p, base, static_cast<std::uint32_t>(line.size() - 1), static_cast<std::uint32_t>(segments));
}

/// Circles about each point of a line, joined. The first and the last are where the line ends; a closed line ends
/// where it begins. `side`: where the texture begins around the line, as far as it is square to it.
Primitive round_line(const std::vector<glm::vec4>& line, bool is_closed, int segments, glm::vec3 side) {
  Primitive p;
  const std::size_t last = line.size() - 1;
  const auto centre = [&](std::size_t i) { return glm::vec3(line[i]); };
  float length = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    // The two first points of a line that is not closed, and the two last, are at the same place: its lids.
    const glm::vec3 before = i > 0       ? centre(is_closed ? i - 1 : std::min(i - 1, last - 2))
                             : is_closed ? centre(last - 1)
                                         : centre(i);
    const glm::vec3 after = i < last    ? centre(is_closed ? i + 1 : std::max<std::size_t>(i + 1, 2))
                            : is_closed ? centre(1)
                                        : centre(i);
    const glm::vec3 along = glm::normalize(after - before);
    if (i > 0) length += glm::length(centre(i) - centre(i - 1));
    side = glm::normalize(side - along * glm::dot(side, along));
    const glm::vec3 other = glm::cross(along, side);
    for (int s = 0; s <= segments; ++s) {
      const glm::dvec2 turn = point_of_circle(static_cast<double>(s % segments) / segments);
      const glm::vec3 out = side * static_cast<float>(turn.x) + other * static_cast<float>(turn.y);
      const bool joins_start = is_closed && i == last;
      p.positions.push_back(joins_start ? p.positions[static_cast<std::size_t>(s)]
                                        : centre(i) + out * line[i].w);
      p.normals.push_back(joins_start ? p.normals[static_cast<std::size_t>(s)] : out);
      p.uv[0].emplace_back(static_cast<float>(s) / static_cast<float>(segments), length);
    }
  }
  add_grid_faces(p, 0, static_cast<std::uint32_t>(last), static_cast<std::uint32_t>(segments));
  return p;
}

/// A limb through three joints, rounded at its ends.
Primitive limb(glm::vec3 top, glm::vec3 joint, glm::vec3 end, float thick, float thin) {
  return pipe({{top + (top - joint) * 0.12F, 0.6F * thick},
               {top, thick},
               {joint, 0.5F * (thick + thin)},
               {end, thin},
               {end + (end - joint) * 0.1F, 0.6F * thin}},
              16);
}

}  // namespace

glm::dvec2 point_of_circle(double turns) {
  constexpr double kPi = 3.14159265358979323846;
  // An eighth of a turn to either side of the nearest quarter; there the series settles fast.
  const double quarters = std::floor(4 * turns + 0.5);
  const double x = (4 * turns - quarters) * (kPi / 2);
  double sine = 0;
  double cosine = 0;
  double term = 1;
  for (int power = 0; power < 18; ++power) {
    const double sign = (power / 2) % 2 == 0 ? 1 : -1;
    (power % 2 == 0 ? cosine : sine) += sign * term;
    term *= x / (power + 1);
  }
  const int quarter = ((static_cast<int>(quarters) % 4) + 4) % 4;
  constexpr std::array<glm::dvec2, 4> kQuarters = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  const glm::dvec2 q = kQuarters.at(static_cast<std::size_t>(quarter));
  return {q.x * cosine - q.y * sine, q.y * cosine + q.x * sine};
}

Primitive rectangle(glm::vec3 centre, glm::vec3 right, glm::vec3 up, glm::vec2 size, float metres_per_tile) {
  Primitive p;
  const glm::vec3 half_right = right * (size.x / 2);
  const glm::vec3 half_up = up * (size.y / 2);
  const glm::vec2 tiles = size / metres_per_tile;
  p.positions = {centre - half_right - half_up, centre + half_right - half_up, centre + half_right + half_up,
                 centre - half_right + half_up};
  p.normals.assign(4, glm::normalize(glm::cross(right, up)));
  p.uv[0] = {{0, tiles.y}, {tiles.x, tiles.y}, {tiles.x, 0}, {0, 0}};
  p.indices = {0, 1, 2, 0, 2, 3};
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

Primitive turned_piece(glm::vec3 foot, const std::vector<Turning>& corners, int segments) {
  Primitive p;
  std::vector<glm::vec2> stretch;
  const auto finish = [&] {
    if (stretch.size() == 2) add_turned_stretch(p, foot, stretch, segments);
    if (stretch.size() > 2) add_turned_stretch(p, foot, smooth_line(stretch, 5), segments);
    stretch.clear();
  };
  for (const Turning& corner : corners) {
    const glm::vec2 point(corner.radius, corner.height);
    if (!stretch.empty() && stretch.back() == point) finish();
    stretch.push_back(point);
  }
  finish();
  return p;
}

Primitive ball(glm::vec3 centre, float radius) {
  Primitive p;
  constexpr int kRings = 32;
  std::vector<glm::vec2> line;
  for (int i = 0; i <= kRings; ++i) {
    const glm::dvec2 turn = point_of_circle(0.5 * i / kRings - 0.25);
    const bool is_pole = i == 0 || i == kRings;
    line.emplace_back(is_pole ? 0 : radius * static_cast<float>(turn.x), radius * static_cast<float>(turn.y));
  }
  add_turned_stretch(p, centre, line, 2 * kRings);
  return p;
}

Primitive pipe(const std::vector<PipePoint>& points, int segments) {
  std::vector<glm::vec4> corners;
  corners.reserve(points.size());
  for (const PipePoint& point : points) corners.emplace_back(point.centre, point.radius);
  std::vector<glm::vec4> line = smooth_line(corners, 6);
  // A lid at each end: a circle without size.
  line.insert(line.begin(), glm::vec4(glm::vec3(line.front()), 0));
  line.emplace_back(glm::vec3(line.back()), 0);
  const glm::vec3 along = glm::normalize(points[1].centre - points[0].centre);
  return round_line(line, false, segments,
                    std::abs(along.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
}

Primitive ring(glm::vec3 centre, glm::vec3 axis, float radius, float tube, int segments) {
  axis = glm::normalize(axis);
  const glm::vec3 side =
      glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
  const glm::vec3 other = glm::cross(axis, side);
  std::vector<glm::vec4> line;
  for (int s = 0; s <= segments; ++s) {
    const glm::dvec2 turn = point_of_circle(static_cast<double>(s % segments) / segments);
    line.emplace_back(
        centre + radius * (side * static_cast<float>(turn.x) + other * static_cast<float>(turn.y)), tube);
  }
  // What points along the axis stays where it is all around: the texture meets itself.
  return round_line(line, true, segments / 2, axis);
}

Primitive terrain(glm::vec3 centre, float size, int side, const std::function<float(float, float)>& height) {
  Primitive p;
  const float step = size / static_cast<float>(side);
  for (int row = 0; row <= side; ++row) {
    for (int column = 0; column <= side; ++column) {
      const float x = step * static_cast<float>(column) - size / 2;
      const float z = size / 2 - step * static_cast<float>(row);
      p.positions.push_back(centre + glm::vec3(x, height(x, z), z));
      p.normals.push_back(glm::normalize(glm::vec3(height(x - step, z) - height(x + step, z), 2 * step,
                                                   height(x, z - step) - height(x, z + step))));
      p.uv[0].emplace_back(x, z);
    }
  }
  add_grid_faces(p, 0, static_cast<std::uint32_t>(side), static_cast<std::uint32_t>(side));
  return p;
}

Primitive teapot(glm::vec3 foot, float scale) {
  Primitive p = turned_piece({0, 0, 0}, {{0, 0},
                                         {0.20F, 0},
                                         {0.20F, 0},
                                         {0.22F, 0.02F},
                                         {0.30F, 0.10F},
                                         {0.335F, 0.20F},
                                         {0.31F, 0.31F},
                                         {0.24F, 0.40F},
                                         {0.20F, 0.43F},
                                         {0.20F, 0.43F},
                                         {0.205F, 0.445F},
                                         {0.19F, 0.46F},
                                         {0.14F, 0.50F},
                                         {0.05F, 0.53F},
                                         {0.03F, 0.55F},
                                         {0.035F, 0.575F},
                                         {0.05F, 0.595F},
                                         {0.035F, 0.62F},
                                         {0, 0.627F}});
  append(p, pipe({{{0.26F, 0.14F, 0}, 0.075F},
                  {{0.38F, 0.19F, 0}, 0.062F},
                  {{0.45F, 0.30F, 0}, 0.042F},
                  {{0.49F, 0.39F, 0}, 0.034F},
                  {{0.545F, 0.425F, 0}, 0.036F}}));
  append(p, pipe({{{-0.26F, 0.37F, 0}, 0.026F},
                  {{-0.38F, 0.385F, 0}, 0.027F},
                  {{-0.485F, 0.34F, 0}, 0.028F},
                  {{-0.485F, 0.24F, 0}, 0.027F},
                  {{-0.40F, 0.15F, 0}, 0.026F},
                  {{-0.29F, 0.10F, 0}, 0.024F}}));
  scale_about(p, {0, 0, 0}, scale);
  for (glm::vec3& position : p.positions) position += foot;
  return p;
}

Primitive mannequin(glm::vec3 foot, double turns, float stride) {
  // Made in place, facing +Z; +X is its left.
  Primitive p = pipe({{{0, 0.86F, 0}, 0.05F},
                      {{0, 0.90F, 0}, 0.14F},
                      {{0, 1.08F, 0}, 0.125F},
                      {{0, 1.30F, 0}, 0.17F},
                      {{0, 1.46F, 0}, 0.15F},
                      {{0, 1.52F, 0}, 0.055F},
                      {{0, 1.58F, 0}, 0.05F}},
                     24);
  append(p, ball({0, 1.69F, 0.01F}, 0.125F));
  for (const float left : {-1.0F, 1.0F}) {
    const float step = stride * left;
    const glm::vec3 hip(0.085F * left, 0.92F, 0);
    const glm::vec3 ankle(0.09F * left, 0.09F + 0.05F * std::abs(step), 0.34F * step);
    const glm::vec3 knee = (hip + ankle) * 0.5F + glm::vec3(0, 0, 0.06F);
    append(p, limb(hip, knee, ankle, 0.085F, 0.05F));
    append(p, pipe({{ankle + glm::vec3(0, -0.045F, -0.07F), 0.035F},
                    {ankle + glm::vec3(0, -0.04F, 0.02F), 0.05F},
                    {ankle + glm::vec3(0, -0.055F, 0.16F), 0.034F}},
                   16));
    const glm::vec3 shoulder(0.20F * left, 1.42F, 0);
    const glm::vec3 elbow(0.26F * left, 1.16F, -0.16F * step);
    const glm::vec3 hand(0.25F * left, 0.95F, 0.10F - 0.34F * step);
    append(p, limb(shoulder, elbow, hand, 0.06F, 0.04F));
  }
  const glm::dvec2 turn = point_of_circle(turns);
  const glm::vec2 t(turn);
  const auto rotated = [&](glm::vec3 v) {
    return glm::vec3(t.x * v.x + t.y * v.z, v.y, t.x * v.z - t.y * v.x);
  };
  for (glm::vec3& normal : p.normals) normal = rotated(normal);
  for (glm::vec3& position : p.positions) position = foot + rotated(position);
  return p;
}

void append(Primitive& primitive, const Primitive& more) {
  const auto first = static_cast<std::uint32_t>(primitive.positions.size());
  primitive.positions.insert(primitive.positions.end(), more.positions.begin(), more.positions.end());
  primitive.normals.insert(primitive.normals.end(), more.normals.begin(), more.normals.end());
  primitive.uv[0].insert(primitive.uv[0].end(), more.uv[0].begin(), more.uv[0].end());
  for (const std::uint32_t i : more.indices) primitive.indices.push_back(first + i);
}

void scale_about(Primitive& primitive, glm::vec3 centre, float scale) {
  for (glm::vec3& position : primitive.positions) position = centre + scale * (position - centre);
}

}  // namespace laterna::app
