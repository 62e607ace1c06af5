// The rasteriser's sinks, flags and depths on every instruction set: orthographic views, triangles that reach from the
// lens to the horizon, cut-outs, near and far planes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <set>

#include "raster/tile_raster.h"
#include "reference/shapes.h"

namespace laterna::raster {
namespace {

using reference::Mesher;

struct Picture {
  int width = 0, height = 0;
  std::vector<float> depth;
  std::vector<TriangleId> ids;
  std::vector<Fragment> fragments;
  [[nodiscard]] std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
  [[nodiscard]] bool covers(int x, int y) const { return ids[index(x, y)] != kNoTriangle; }
};

struct Sinks {
  InstructionSet set = InstructionSet::scalar;
  BinOptions options;
  const AlphaCut* cut = nullptr;
  float start = std::numeric_limits<float>::quiet_NaN();  // NaN: the view's far plane
};

Picture draw_sinks(const frame::Frame& frame, const RasterView& view, Sinks sinks) {
  const TaskPool pool(1);
  sinks.options.pixels = {0, 0, view.width, view.height};
  sinks.options.instruction_set = sinks.set;
  TriangleBins bins;
  bins.fill(view, frame.geometry(), sinks.options, pool);
  Picture picture;
  picture.width = view.width, picture.height = view.height;
  picture.depth.resize(static_cast<std::size_t>(view.width * view.height));
  picture.ids.resize(picture.depth.size());
  const float start = sinks.start == sinks.start ? sinks.start : view.reversed_far;
  for (int ty = 0; ty * kTileSide < view.height; ++ty) {
    for (int tx = 0; tx * kTileSide < view.width; ++tx) {
      alignas(64) float depth[kTilePixels];
      alignas(64) float only_depth[kTilePixels];
      alignas(64) TriangleId ids[kTilePixels];
      std::fill_n(depth, kTilePixels, start);
      std::fill_n(only_depth, kTilePixels, start);
      std::fill_n(ids, kTilePixels, kNoTriangle);
      const TileTask task = {&view, bins.batches(), tx, ty, 0, 0, sinks.cut};
      rasterise_visibility_for(sinks.set)(task, depth, ids);
      rasterise_depth_for(sinks.set)(task, only_depth);
      rasterise_fragments_for(sinks.set)(task, depth, picture.fragments);
      for (int y = 0; y < std::min(kTileSide, view.height - ty * kTileSide); ++y) {
        for (int x = 0; x < std::min(kTileSide, view.width - tx * kTileSide); ++x) {
          const auto from = static_cast<std::size_t>(index_in_tile(x, y));
          const std::size_t to = picture.index(tx * kTileSide + x, ty * kTileSide + y);
          EXPECT_EQ(depth[from], only_depth[from]);
          picture.depth[to] = depth[from];
          picture.ids[to] = ids[from];
        }
      }
    }
  }
  return picture;
}

class RasterSinks : public testing::TestWithParam<InstructionSet> {
 protected:
  static Sinks sinks() {
    Sinks s;
    s.set = GetParam();
    return s;
  }
};

reference::OwnedFrame one_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  Scene scene;
  Mesher mesh;
  mesh.triangle(a, b, c);
  reference::add_object(scene, "triangle", mesh.primitive);
  return reference::make_frame(std::move(scene));
}

// A pixel's ray: where it starts, and per metre along the axis.
struct Ray {
  glm::dvec3 from, along;
};
Ray ray_of(const View& view, int width, int height, int x, int y) {
  const Projection& p = view.projection;
  const double s = p.left + (p.right - p.left) * (x + 0.5) / width,
               t = p.top - (p.top - p.bottom) * (y + 0.5) / height;
  const glm::dvec3 side = view.pose.right_ws() * s + view.pose.up_ws() * t;
  if (p.is_orthographic) return {view.pose.position_ws + side, view.pose.forward_ws()};
  return {view.pose.position_ws, view.pose.forward_ws() + side};
}

// Distance along the axis at which a pixel's ray meets a triangle's plane, and by how much the point is inside: the
// least of its three weights.
struct Meeting {
  double distance, inside;
};
Meeting meet(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double distance = glm::dot(n, a - ray.from) / glm::dot(n, ray.along);
  const glm::dvec3 p = ray.from + ray.along * distance;
  const auto weight = [&](const glm::dvec3& u, const glm::dvec3& v) {
    return glm::dot(glm::cross(v - u, p - u), n) / glm::dot(n, n);
  };
  return {distance, std::min({weight(a, b), weight(b, c), weight(c, a)})};
}

TEST_P(RasterSinks, OrthographicTrianglesLieWhereTheirRaysMeetThem) {
  std::mt19937 random(21);
  std::uniform_real_distribution<float> place(-4, 4);
  View view;
  view.pose = Pose::look_at({3, 4, 9}, {0, 0, 0}, {0, 1, 0}).value();
  view.projection = {true, -4, 5, -3, 4, -2, 30};
  const RasterView raster(view, 140, 109);
  int covered = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const glm::vec3 a(place(random), place(random), place(random)),
        b(place(random), place(random), place(random)), c(place(random), place(random), place(random));
    const auto owned = one_triangle(a, b, c);
    const Picture picture = draw_sinks(owned.frame, raster, sinks());
    // Corners are snapped to 1/256 pixel: weights change by that over the triangle's height in pixels.
    const glm::dvec3 n = glm::cross(glm::dvec3(b - a), glm::dvec3(c - a));
    const double edge_on = std::abs(glm::dot(n, view.pose.forward_ws())) / glm::length(n);
    if (edge_on < 0.05) continue;
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    const double height_pixels = 15 * std::abs(glm::dot(n, view.pose.forward_ws())) / longest;
    for (int y = 0; y < 109; ++y) {
      for (int x = 0; x < 140; ++x) {
        const Meeting m = meet(ray_of(view, 140, 109, x, y), a, b, c);
        if (std::abs(m.inside) < 0.02 / height_pixels + 1e-6) continue;
        ASSERT_EQ(picture.covers(x, y), m.inside > 0) << "trial " << trial << " at " << x << ", " << y;
        if (m.inside < 0) continue;
        ASSERT_NEAR(raster.distance_from_reversed(picture.depth[picture.index(x, y)]), m.distance,
                    2e-5 / edge_on)
            << trial;
        ++covered;
      }
    }
  }
  EXPECT_GT(covered, 10000);
}

// Row 24: near 0.1 m, far 10 km. The far end of such a triangle is thinner than any pixel of an ordinary view: a long
// lens looks at it too.
TEST_P(RasterSinks, OneTriangleFromTheLensToNineKilometresKeepsItsDepth) {
  const glm::vec3 a(0, -0.1F, -0.1F), b(4500, -90, -9000), c(-4500, -90, -9000);
  const auto owned = one_triangle(a, b, c);
  double nearest = 1e9, farthest = 0;
  for (const double height : {2.0, 0.01, 2e-4}) {
    View view = reference::look({0, 0, 0}, {0, 0, -1}, 60, 1);
    view.projection = {false, -0.5 * height, 0.5 * height, -0.01 - height, -0.01, 0.1, 1e4};
    const RasterView raster(view, 256, 256);
    const Picture picture = draw_sinks(owned.frame, raster, sinks());
    int covered = 0;
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) {
        const Meeting m = meet(ray_of(view, 256, 256, x, y), a, b, c);
        if (!picture.covers(x, y) || m.inside < 1e-6) continue;
        // A float's step is 6e-8 of the distance, half a millimetre at 9 km.
        const double distance = raster.distance_from_reversed(picture.depth[picture.index(x, y)]);
        ASSERT_NEAR(distance / m.distance, 1, 3e-7) << x << ", " << y << " of " << height;
        nearest = std::min(nearest, m.distance), farthest = std::max(farthest, m.distance);
        ++covered;
      }
    }
    EXPECT_GT(covered, 5000);
  }
  EXPECT_LT(nearest, 0.12);
  EXPECT_GT(farthest, 8000);
}

TEST_P(RasterSinks, PlatesOneCentimetreApartAtNineKilometresAreToldApart) {
  Scene scene;
  reference::add_object(scene, "behind", reference::wall(5000, 5000, -9000.01F));
  reference::add_object(scene, "before", reference::wall(5000, 5000, -9000.0F));
  const auto owned = reference::make_frame(std::move(scene));
  const RasterView raster(reference::look({0, 0, 0}, {0, 0, -1}, 50, 1, {0, 1, 0}, 0.1, 1e4), 128, 128);
  for (const TriangleId id : draw_sinks(owned.frame, raster, sinks()).ids) {
    ASSERT_NE(id, kNoTriangle);
    ASSERT_EQ(owned.frame.object_names[owned.frame.clusters[cluster_of(id)].object], "before");
  }
}

TEST_P(RasterSinks, NothingIsDrawnBeforeTheNearOrBeyondTheFarPlane) {
  // A slope through both planes: only what lies between them is seen.
  const auto owned = one_triangle({-50, -1, 1}, {50, -1, 1}, {0, 9, -50});
  for (const bool is_orthographic : {false, true}) {
    View view = reference::look({0, 1, 2}, {0, 0.5, -1}, 70, 1, {0, 1, 0}, 3, 12);
    if (is_orthographic) view.projection = Projection::orthographic(4, 4, 3, 12);
    const RasterView raster(view, 120, 120);
    const Picture picture = draw_sinks(owned.frame, raster, sinks());
    int seen = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 120; ++x) {
        const Meeting m = meet(ray_of(view, 120, 120, x, y), {-50, -1, 1}, {50, -1, 1}, {0, 9, -50});
        if (std::abs(m.inside) < 0.01 || std::abs(m.distance - 3) < 0.03 || std::abs(m.distance - 12) < 0.12)
          continue;
        ASSERT_EQ(picture.covers(x, y), m.inside > 0 && m.distance > 3 && m.distance < 12) << x << ", " << y;
        seen += picture.covers(x, y) ? 1 : 0;
      }
    }
    EXPECT_GT(seen, 300);
    EXPECT_LT(seen, 14000);
  }
}

// Keeps every other sample, and remembers what it was asked.
class CheckerCut final : public AlphaCut {
 public:
  void keep(TriangleId, CutSamples& samples, std::uint16_t* kept) const override {
    EXPECT_NE(samples.count, 0U);
    asked += static_cast<int>(samples.count);
    for (std::size_t i = 0; i < samples.groups() * 16; ++i) {
      if (i % 16 == 0) kept[i / 16] = 0;
      const auto x = static_cast<int>(std::floor(samples.x[i])),
                 y = static_cast<int>(std::floor(samples.y[i]));
      if ((x + y) % 2 == 0) kept[i / 16] = static_cast<std::uint16_t>(kept[i / 16] | 1U << (i % 16));
      EXPECT_GT(samples.reversed_depth[i], 0);
    }
  }
  mutable int asked = 0;
};

TEST_P(RasterSinks, CutOutsAreAskedSampleBySample) {
  Scene scene;
  reference::add_object(scene, "back", reference::wall(3, 3, -1));
  reference::add_object(scene, "leaf", reference::wall(0.5F, 0.4F, 0));
  scene.materials.back().alpha_mode = AlphaMode::mask;
  const auto owned = reference::make_frame(std::move(scene));
  const RasterView raster(reference::look({0, 0, 3}, {0, 0, 0}, 40, 1), 128, 128);
  const Picture whole = draw_sinks(owned.frame, raster, sinks());
  const CheckerCut cut;
  Sinks cutting = sinks();
  cutting.cut = &cut;
  const Picture picture = draw_sinks(owned.frame, raster, cutting);
  int leaf = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const auto object = [&](const Picture& p) {
        return owned.frame.clusters[cluster_of(p.ids[p.index(x, y)])].object;
      };
      const bool is_kept = (x - raster.origin_x + y - raster.origin_y) % 2 == 0;
      ASSERT_EQ(object(picture), object(whole) == 1 && is_kept ? 1U : 0U) << x << ", " << y;
      leaf += object(whole) == 1 ? 1 : 0;
    }
  }
  EXPECT_GT(leaf, 1000);
  EXPECT_EQ(cut.asked, 2 * leaf);  // by the two sinks that draw what is not blended
}

TEST_P(RasterSinks, OnlyClustersWithTheRequiredFlagsAreDrawn) {
  Scene scene;
  const int near = reference::add_object(scene, "near", reference::wall(3, 3, 0));
  reference::add_object(scene, "far", reference::wall(3, 3, -1));
  scene.nodes[static_cast<std::size_t>(near)].casts_shadow = false;
  const auto owned = reference::make_frame(std::move(scene));
  const RasterView raster(reference::look({0, 0, 3}, {0, 0, 0}, 40, 1), 64, 64);
  const auto object_seen = [&](std::uint32_t flags) {
    Sinks s = sinks();
    s.options.required_flags = flags;
    const Picture picture = draw_sinks(owned.frame, raster, s);
    return owned.frame.clusters[cluster_of(picture.ids[0])].object;
  };
  EXPECT_EQ(object_seen(0), 0U);
  EXPECT_EQ(object_seen(kVisible), 0U);
  EXPECT_EQ(object_seen(kCastsShadow), 1U);
  EXPECT_EQ(object_seen(kCastsShadow | kVisible), 1U);
}

TEST_P(RasterSinks, BlendedSurfacesAreFragmentsOrAreDrawnAsCutOuts) {
  Scene scene;
  reference::add_object(scene, "wall", reference::wall(0.3F, 3, 0));
  reference::add_object(scene, "glass before", reference::wall(3, 3, 1));
  reference::add_object(scene, "glass behind", reference::wall(3, 3, -1));
  scene.materials[1].alpha_mode = scene.materials[2].alpha_mode = AlphaMode::blend;
  const auto owned = reference::make_frame(std::move(scene));
  const RasterView raster(reference::look({0, 0, 4}, {0, 0, 0}, 40, 1), 64, 64);
  const Picture picture = draw_sinks(owned.frame, raster, sinks());
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const Fragment& f : picture.fragments) {
    const std::uint32_t object = owned.frame.clusters[cluster_of(f.id)].object;
    EXPECT_TRUE(found.emplace(f.pixel, object).second) << "twice";
    EXPECT_NEAR(f.reversed_depth, object == 1 ? 1.0 / 3 : 1.0 / 5, 1e-6);
  }
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto pixel = static_cast<std::uint32_t>(index_in_tile(x, y));
      EXPECT_TRUE(found.count({pixel, 1}) == 1);
      EXPECT_EQ(found.count({pixel, 2}) == 1, !picture.covers(x, y)) << "hidden by the wall";
    }
  }
  Sinks s = sinks();
  s.options.excluded_flags = kAlphaBlend;
  const Picture without = draw_sinks(owned.frame, raster, s);
  EXPECT_TRUE(without.fragments.empty());
  EXPECT_EQ(without.ids, picture.ids);
}

TEST_P(RasterSinks, DrawingGoesOnFromTheDepthThatIsThere) {
  const auto owned = one_triangle({-9, -9, 0}, {9, -9, 0}, {0, 9, 0});
  const RasterView raster(reference::look({0, 0, 4}, {0, 0, 0}, 40, 1), 64, 64);
  Sinks s = sinks();
  s.start = 1 / 3.9F;  // something nearer is there already
  for (const TriangleId id : draw_sinks(owned.frame, raster, s).ids) EXPECT_EQ(id, kNoTriangle);
  s.start = 1 / 4.1F;
  for (const TriangleId id : draw_sinks(owned.frame, raster, s).ids) EXPECT_EQ(id, 0U);
}

TEST_P(RasterSinks, GivesTheSameBitsAsScalarInAnOrthographicView) {
  Scene scene;
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-3, 3);
  for (int i = 0; i < 6; ++i) {
    reference::add_object(scene, "ring",
                          reference::torus({place(random), place(random), place(random)}, 1, 0.3F, 40));
    if (i % 3 == 0) scene.materials.back().alpha_mode = AlphaMode::blend;
  }
  const auto owned = reference::make_frame(std::move(scene));
  View view = reference::look({4, 5, 6}, {0, 0, 0}, 40, 1);
  view.projection = Projection::orthographic(4, 4, 0.1, 20);
  const RasterView raster(view, 200, 150);
  const Picture expected = draw_sinks(owned.frame, raster, {}),
                got = draw_sinks(owned.frame, raster, sinks());
  EXPECT_EQ(got.depth, expected.depth);
  EXPECT_EQ(got.ids, expected.ids);
  ASSERT_EQ(got.fragments.size(), expected.fragments.size());
  for (std::size_t i = 0; i < got.fragments.size(); ++i) {
    EXPECT_EQ(got.fragments[i].pixel, expected.fragments[i].pixel);
    EXPECT_EQ(got.fragments[i].id, expected.fragments[i].id);
    EXPECT_EQ(got.fragments[i].reversed_depth, expected.fragments[i].reversed_depth);
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, RasterSinks, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::raster
