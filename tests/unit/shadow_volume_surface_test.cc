// What shadow volumes are made of: exact sides of lines of sight, silhouettes, and their closed surface.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "reference/shadow_scenes.h"
#include "shadow/eye_directions.h"
#include "shadow/volume_surface.h"

namespace laterna::shadow {
namespace {

using namespace reference;

// ---------------------------------------------------------------------------------------------- lines of sight

bool passes_through(const EyeDirection& a, const EyeDirection& b, const EyeDirection& c,
                    const EyeDirection& line) {
  const int turn = turn_of(a, b, c);
  if (turn == 0) return false;
  return side_of(edge_between(a, b), line) == turn && side_of(edge_between(b, c), line) == turn &&
         side_of(edge_between(c, a), line) == turn;
}

// A fan around one direction, wide enough to go round: every line of sight passes through one of its triangles, also
// along their edges and through their common corner.
TEST(EyeDirections, ALineThroughACornerMeetsOneTriangleOfTheFan) {
  std::mt19937 random(5);
  const auto number = [&](int reach) { return std::uniform_int_distribution<int>(-reach, reach)(random); };
  for (int round = 0; round < 200; ++round) {
    const EyeDirection middle = {number(1 << 20), number(1 << 20), kDirectionScale};
    const int spokes = 3 + round % 9;
    std::vector<EyeDirection> rim;
    for (int i = 0; i < spokes; ++i) {
      const double angle = 2 * std::acos(-1.0) * (i + 0.3 * (round % 3)) / spokes;
      rim.push_back({middle.x + static_cast<int>(3e8 * std::cos(angle)),
                     middle.y + static_cast<int>(3e8 * std::sin(angle)), kDirectionScale});
    }
    // The corner itself, points on the spokes, and points an atom beside them.
    for (int probe = 0; probe < 40; ++probe) {
      EyeDirection line = middle;
      if (probe > 0) {
        const EyeDirection& end = rim[static_cast<std::size_t>(probe % spokes)];
        const int share = 1 + probe / spokes;
        line.x = middle.x + (end.x - middle.x) / 32 * share + number(1);
        line.y = middle.y + (end.y - middle.y) / 32 * share + number(1);
      }
      int met = 0;
      for (std::size_t i = 0; i < rim.size(); ++i)
        met += passes_through(middle, rim[i], rim[(i + 1) % rim.size()], line) ? 1 : 0;
      EXPECT_EQ(met, 1) << round << ' ' << probe;
    }
  }
}

TEST(EyeDirections, TrianglesBehindTheEyeAndEdgeOnAreNotMet) {
  const EyeDirection ahead = {1 << 20, -(1 << 21), kDirectionScale};
  const EyeDirection a = {1 << 28, 0, kDirectionScale};
  const EyeDirection b = {-(1 << 28), 1 << 28, kDirectionScale};
  const EyeDirection c = {0, -(1 << 28), kDirectionScale};
  const auto behind = [](const EyeDirection& d) { return EyeDirection{-d.x, -d.y, -d.w}; };
  EXPECT_TRUE(passes_through(a, b, c, ahead));
  EXPECT_TRUE(passes_through(a, c, b, ahead));
  EXPECT_FALSE(passes_through(behind(a), behind(b), behind(c), ahead));
  EXPECT_FALSE(
      passes_through(a, b, {0, 1 << 27, kDirectionScale}, a));  // all three in one plane with the eye
  EXPECT_EQ(turn_of(a, b, {0, 1 << 27, kDirectionScale}), 0);
  // With one corner behind the eye: the triangle reaches from the other two to infinity, away from it.
  EXPECT_TRUE(passes_through(a, b, behind(c), {0, (1 << 29), kDirectionScale}));
  EXPECT_FALSE(passes_through(a, b, behind(c), ahead));
}

TEST(EyeDirections, PixelsAreTheCameras) {
  for (const bool is_orthographic : {false, true}) {
    View view = look({1, 2, 9}, {0, 1, 0}, 50, 1.5);
    if (is_orthographic) view.projection = Projection::orthographic(3, 2, 0.1, 40);
    const raster::RasterView camera(view, 300, 200);
    frame::Bounds bounds;
    bounds.low = glm::vec3(-3);
    bounds.high = glm::vec3(3);
    const Eye eye(camera, bounds);
    for (const glm::dvec3 p : {glm::dvec3(0, 1, 0), glm::dvec3(1.5, 0, -2), glm::dvec3(-1, 2, 1.5)}) {
      const glm::dvec4 image = view.image_from_world() * glm::dvec4(p, 1);
      const EyeDirection d = eye.to_point(p);
      // An orthographic camera's lines are nearly parallel: a pixel's fraction apart within the scene.
      const double tolerance = is_orthographic ? 150.0 * 6 / (4096 * 10.0) : 1e-5;
      EXPECT_NEAR(eye.unit() * d.x / d.w, image.x / image.w * 300 - camera.origin_x, tolerance);
      EXPECT_NEAR(eye.unit() * d.y / d.w, image.y / image.w * 200 - camera.origin_y, tolerance);
    }
  }
}

// ---------------------------------------------------------------------------------------------- silhouettes

VolumeSurface surface_of(Primitive primitive, const Light& light, glm::dvec3 position, glm::dvec3 target) {
  Scene scene;
  add_object(scene, "caster", std::move(primitive));
  add_light(scene, light, position, target);
  const OwnedFrame owned = make_frame(std::move(scene));
  return {owned.frame, light::LightRays(owned.frame.lights.at(0))};
}

Light point_light() {
  Light light;
  light.name = "light";
  return light;
}

std::size_t count_parts(const VolumeSurface& surface, VolumePart part) {
  std::size_t count = 0;
  for (const VolumeTriangle& t : surface.triangles()) count += t.part == part ? 1 : 0;
  return count;
}

// Each edge of the surface is run along as often one way as the other.
void expect_closed(const VolumeSurface& surface) {
  std::map<std::array<std::uint32_t, 4>, int> sums;
  for (const VolumeTriangle& t : surface.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VolumeCorner a = t.corner[k];
      const VolumeCorner b = t.corner[(k + 1) % 3];
      const std::array<std::uint32_t, 2> from = {a.point, a.is_infinite ? 1U : 0U};
      const std::array<std::uint32_t, 2> to = {b.point, b.is_infinite ? 1U : 0U};
      const bool is_forward = from < to;
      const auto& low = is_forward ? from : to;
      const auto& high = is_forward ? to : from;
      sums[{low[0], low[1], high[0], high[1]}] += is_forward ? t.count : -t.count;
    }
  }
  for (const auto& [edge, sum] : sums) EXPECT_EQ(sum, 0) << edge[0] << ' ' << edge[2];
}

// Seen from beyond a corner, three faces of a box are lit and six edges are its outline; the surface folds back there.
TEST(VolumeSurface, OutlineOfABox) {
  const VolumeSurface surface = surface_of(box({0, 0, 0}, {1, 1, 1}), point_light(), {3, 4, 5}, {0, 0, 0});
  EXPECT_EQ(surface.points_ws().size(), 8U);
  EXPECT_EQ(surface.silhouette_edges(), 6U);
  EXPECT_EQ(count_parts(surface, VolumePart::cap), 12U);
  EXPECT_EQ(count_parts(surface, VolumePart::end), 12U);
  EXPECT_EQ(count_parts(surface, VolumePart::side), 12U);
  for (const VolumeTriangle& t : surface.triangles()) EXPECT_EQ(t.count, t.part == VolumePart::side ? 2 : 1);
  expect_closed(surface);
  // A box around the light has no outline: every face is seen from inside.
  const VolumeSurface inside =
      surface_of(box({0, 0, 0}, {1, 1, 1}), point_light(), {0.1, 0.2, 0.3}, {0, 0, 0});
  EXPECT_EQ(inside.silhouette_edges(), 0U);
  expect_closed(inside);
}

TEST(VolumeSurface, RimOfAnOpenSheetInTheSun) {
  const VolumeSurface surface = surface_of(floor(1, 1), sun("light"), {1, 5, 2}, {0, 0, 0});
  EXPECT_EQ(surface.silhouette_edges(), 4U);  // not its diagonal
  EXPECT_EQ(count_parts(surface, VolumePart::cap), 2U);
  EXPECT_EQ(count_parts(surface, VolumePart::end), 0U);
  EXPECT_EQ(count_parts(surface, VolumePart::side), 4U);
  for (const VolumeTriangle& t : surface.triangles()) EXPECT_EQ(t.count, 1);
}

// A torus is many clusters, whose copies of vertices are joined; a sheet whose halves wind differently is one sheet.
TEST(VolumeSurface, ClustersAndWindingsLeaveNoSeams) {
  const VolumeSurface torus_surface =
      surface_of(torus({0, 0, 0}, 1, 0.3F, 32), point_light(), {0.3, 7, 0.2}, {0, 0, 0});
  expect_closed(torus_surface);
  EXPECT_LT(torus_surface.silhouette_edges(), 2U * 3U * 32U)
      << "an outer and an inner outline, which may zigzag over quads";
  Mesher mesh;
  mesh.triangle({-1, 0, 1}, {1, 0, 1}, {1, 0, -1});
  mesh.triangle({-1, 0, 1}, {-1, 0, -1}, {1, 0, -1});  // seen from below
  const VolumeSurface sheet = surface_of(mesh.primitive, point_light(), {0.3, 7, 0.2}, {0, 0, 0});
  EXPECT_EQ(sheet.silhouette_edges(), 4U);
  expect_closed(sheet);
}

// What is nearer than a projector's near plane is cut off, and the rest is closed there.
TEST(VolumeSurface, CutAtTheNearPlane) {
  Light projector;
  projector.name = "light";
  projector.type = LightType::projector;
  projector.projection = Projection::perspective(Angle::degrees(40), 1, 4, 100);
  const VolumeSurface surface = surface_of(box({0, 0, 0}, {1, 1, 1}), projector, {0, 0.2, 4}, {0, 0.2, 0});
  expect_closed(surface);
  for (const VolumeTriangle& t : surface.triangles()) {
    for (const VolumeCorner& corner : t.corner) EXPECT_LE(surface.points_ws()[corner.point].z, 1e-12);
  }
  EXPECT_EQ(surface.silhouette_edges(), 4U + 4U) << "around the cut, and around the far side";
}

}  // namespace
}  // namespace laterna::shadow
