// Normals and tangents that files lack.
#include "scene/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"
#include "scene/normals.h"
#include "scene/vertex_joining.h"

namespace laterna {
namespace {

// A unit square in the plane z = 0, facing +z, wound counter-clockwise; v points down as in glTF pictures.
Primitive square() {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  p.normals.assign(4, {0, 0, 1});
  p.uv[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

glm::vec3 bitangent(const Primitive& p, std::size_t i) {
  return glm::cross(p.normals[i], glm::vec3(p.tangents[i])) * p.tangents[i].w;
}

TEST(Tangents, FollowTheTexture) {
  Primitive p = square();
  compute_tangents(p, 0);
  ASSERT_EQ(p.tangents.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(p.tangents[i], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(bitangent(p, i), glm::vec3(0, 1, 0));  // toward falling v: up in the picture
  }
}

TEST(Tangents, MirroredTexturesHaveTheOtherHand) {
  Primitive p = square();
  for (glm::vec2& uv : p.uv[0]) uv.x = 1 - uv.x;
  compute_tangents(p, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(p.tangents[i], glm::vec4(-1, 0, 0, -1));
    EXPECT_EQ(bitangent(p, i), glm::vec3(0, 1, 0));
  }
}

TEST(Tangents, TurnedTexturesTurnThem) {
  Primitive p = square();
  for (glm::vec2& uv : p.uv[0]) uv = {uv.y, 1 - uv.x};  // a quarter turn
  compute_tangents(p, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(glm::vec3(p.tangents[i]), glm::vec3(0, -1, 0));
    EXPECT_EQ(bitangent(p, i), glm::vec3(1, 0, 0));
  }
}

TEST(Tangents, SeamsBetweenHandsSplitVertices) {
  // Two squares side by side whose texture is mirrored at x = 1.
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  p.normals.assign(6, {0, 0, 1});
  p.uv[0] = {{0, 1}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {0, 0}};
  p.colors.assign(6, {1, 0, 0, 1});
  p.indices = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
  compute_tangents(p, 0);
  ASSERT_EQ(p.positions.size(), 8U);
  EXPECT_EQ(p.normals.size(), 8U);
  EXPECT_EQ(p.uv[0].size(), 8U);
  EXPECT_EQ(p.colors.size(), 8U);
  EXPECT_TRUE(p.uv[1].empty());
  for (std::size_t corner = 0; corner < 12; ++corner) {
    const glm::vec4 tangent = p.tangents[p.indices[corner]];
    EXPECT_EQ(tangent, corner < 6 ? glm::vec4(1, 0, 0, 1) : glm::vec4(-1, 0, 0, -1)) << corner;
  }
  EXPECT_EQ(p.positions[p.indices[6]], glm::vec3(1, 0, 0));
}

TEST(Tangents, AreSharedByEqualVerticesAndWeightedByAngle) {
  // Three faces around the origin, unindexed, with their own directions of u but the same position, normal
  // and uv at the origin: 90° along x, 45° along y and 45° along y.
  const auto face = [](Primitive& p, glm::vec3 b, glm::vec3 c, glm::vec2 uv_b, glm::vec2 uv_c) {
    p.positions.insert(p.positions.end(), {glm::vec3(0), b, c});
    p.uv[0].insert(p.uv[0].end(), {glm::vec2(0), uv_b, uv_c});
    p.normals.insert(p.normals.end(), 3, glm::vec3(0, 0, 1));
  };
  Primitive p;
  face(p, {1, 0, 0}, {0, 1, 0}, {1, 0}, {0, -1});     // u along x
  face(p, {0, 1, 0}, {-1, 1, 0}, {1, 0}, {1, -1});    // u along y
  face(p, {-1, 1, 0}, {-1, 0, 0}, {1, -1}, {0, -1});  // u along y
  compute_tangents(p, 0);
  const glm::vec3 expected = glm::normalize(glm::vec3(1, 1, 0));  // 90° : 45° + 45°
  for (const std::size_t corner : {0U, 3U, 6U}) {
    EXPECT_LT(glm::distance(glm::vec3(p.tangents[corner]), expected), 1e-6F);
  }
  EXPECT_EQ(glm::vec3(p.tangents[1]), glm::vec3(1, 0, 0));
}

TEST(Tangents, ArePerpendicularToTheNormal) {
  Primitive p = square();
  p.normals = {glm::normalize(glm::vec3(1, 2, 3)),
               glm::normalize(glm::vec3(-1, 0.5, 1)),
               {0, 0, 1},
               glm::normalize(glm::vec3(0.2, -3, 0.1))};
  compute_tangents(p, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(glm::dot(glm::vec3(p.tangents[i]), p.normals[i]), 0, 1e-6);
    EXPECT_NEAR(glm::length(glm::vec3(p.tangents[i])), 1, 1e-6);
  }
}

TEST(Tangents, DegenerateFacesGiveNoNan) {
  Primitive p = square();
  p.uv[0].assign(4, {0.5F, 0.5F});  // no area in uv
  compute_tangents(p, 0);
  for (const glm::vec4& t : p.tangents) EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6);
  p = square();
  p.positions.assign(4, {1, 1, 1});  // no area in space
  compute_tangents(p, 0);
  for (const glm::vec4& t : p.tangents) EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6);
  p = square();
  p.positions = {{0, 0, 0},
                 {1e-30F, 0, 0},
                 {1e-30F, 1e-30F, 0},
                 {0, 1e-30F, 0}};  // squares underflow in single precision
  compute_tangents(p, 0);
  for (const glm::vec4& t : p.tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, AFaceWithoutAreaGoesWithItsNeighbours) {
  Primitive p = square();
  for (glm::vec2& uv : p.uv[0]) uv.x = 1 - uv.x;
  p.positions.emplace_back(0, 0, 0);  // equal to vertex 0, used by a degenerate face only
  p.normals.emplace_back(0, 0, 1);
  p.uv[0].push_back(p.uv[0][0]);
  p.indices.insert(p.indices.end(), {4, 4, 4});
  compute_tangents(p, 0);
  EXPECT_EQ(p.tangents[4], p.tangents[0]);
}

// A column with n sides: smooth when the angle between them is within the crease, sharp otherwise.
Primitive column(int sides) {
  Primitive p;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    p.positions.emplace_back(cosine(angle), 0, sine(angle));
    p.positions.emplace_back(cosine(angle), 1, sine(angle));
  }
  for (unsigned i = 0; i < static_cast<unsigned>(sides); ++i) {
    const unsigned a = 2 * i, b = 2 * ((i + 1) % static_cast<unsigned>(sides));
    p.indices.insert(p.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
  }
  return p;
}

TEST(Normals, SmoothWithinTheCreaseAndSharpBeyond) {
  Primitive round = column(8);
  compute_smooth_normals(round, Angle::degrees(50));
  EXPECT_EQ(round.positions.size(), 16U);  // nothing was split
  for (std::size_t i = 0; i < 16; ++i) {
    const glm::vec3 p = round.positions[i];
    EXPECT_LT(glm::distance(round.normals[i], glm::vec3(p.x, 0, p.z)), 1e-6F);
  }
  Primitive sharp = column(6);
  compute_smooth_normals(sharp, Angle::degrees(50));
  EXPECT_EQ(sharp.positions.size(), 24U);  // each edge twice
  for (std::size_t t = 0; t < triangle_count(sharp); ++t) {
    const Corners at = corners_of(sharp, t);
    const glm::vec3 face = glm::normalize(glm::cross(sharp.positions[at.b] - sharp.positions[at.a],
                                                     sharp.positions[at.c] - sharp.positions[at.a]));
    for (const std::size_t corner : {at.a, at.b, at.c})
      EXPECT_LT(glm::distance(sharp.normals[corner], face), 1e-6F);
  }
}

TEST(Normals, ACreaseOfExactlyTheLimitIsSmoothInEveryDirection) {
  Primitive p = column(8);
  compute_smooth_normals(p, Angle::degrees(45));
  EXPECT_EQ(p.positions.size(), 16U);
}

TEST(Normals, AreWeightedByAngleNotByArea) {
  // A cube's corner cut into triangles unevenly: the three faces meet at right angles, so each counts the
  // same.
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  p.indices = {0, 4, 1, 0, 2, 4, 0, 3, 2, 0, 1, 3};  // z = 0 in two triangles, x = 0 and y = 0 in one each
  compute_smooth_normals(p, Angle::degrees(180));
  const glm::vec3 corner = p.normals[p.indices[0]];
  EXPECT_LT(glm::distance(corner, glm::normalize(glm::vec3(-1, -1, -1))), 1e-6F);
}

TEST(Normals, EqualPositionsAreOneCornerWhateverTheirIndices) {
  Primitive p = column(8);
  unshare_vertices(p);
  compute_smooth_normals(p, Angle::degrees(50));
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    EXPECT_LT(glm::distance(p.normals[i], glm::vec3(p.positions[i].x, 0, p.positions[i].z)), 1e-6F);
  }
}

TEST(Normals, ManyFacesAtOnePointTakeNoLongerThanNeeded) {
  Primitive p;
  constexpr int kFaces = 200000;
  p.positions.emplace_back(0, 1, 0);
  for (int i = 0; i < kFaces; ++i) {
    const double angle = 2 * kPi * i / kFaces;
    p.positions.emplace_back(cosine(angle), 0, -sine(angle));
  }
  for (unsigned i = 0; i < kFaces; ++i) p.indices.insert(p.indices.end(), {0, 1 + i, 1 + (i + 1) % kFaces});
  compute_smooth_normals(p, Angle::degrees(50));  // a loop over all pairs would take minutes
  EXPECT_LT(glm::distance(p.normals[p.indices[0]], glm::vec3(0, 1, 0)), 1e-4F);
}

TEST(Normals, DegenerateFacesGiveNoNan) {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  compute_smooth_normals(p, Angle::degrees(50));
  for (const glm::vec3& n : p.normals) EXPECT_NEAR(glm::length(n), 1, 1e-6);
}

TEST(Normals, JoiningKeepsWhatDiffersInAnyAttribute) {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0F, 1, 0}};
  p.uv[0] = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0.5F, 1}};
  join_identical_vertices(p);
  EXPECT_EQ(p.positions.size(), 5U);  // vertex 3 is vertex 1; vertex 5 differs from 2 in uv
  EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 4}));
  EXPECT_EQ(p.uv[0][4], glm::vec2(0.5F, 1));
  Primitive zero;
  zero.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0F, 0, -0.0F}, {1, 0, 0}, {0, 1, 0}};
  join_identical_vertices(zero);
  EXPECT_EQ(zero.positions.size(), 3U);  // −0 is 0
}

}  // namespace
}  // namespace laterna
