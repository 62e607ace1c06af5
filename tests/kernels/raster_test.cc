// Coverage and depth of the rasteriser on every instruction set, against plain loops and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "raster/tile_raster.h"
#include "reference/shapes.h"

namespace laterna::raster {
namespace {

using reference::Mesher;

struct Drawn {
  int width, height;
  std::vector<int> count;       // fragments of blended triangles per pixel
  std::vector<float> depth;     // nearest reversed depth
  std::vector<TriangleId> ids;  // of the nearest
};

struct DrawSettings {
  InstructionSet set = InstructionSet::scalar;
  int threads = 1;
  int offset_x = 0, offset_y = 0;
  CullFaces cull = CullFaces::none;
};

Drawn draw(const frame::Frame& frame, const RasterView& view, const DrawSettings& settings) {
  const TaskPool pool(settings.threads);
  BinOptions options;
  options.cull = settings.cull;
  options.pixels = {0, 0, view.width, view.height};
  options.sample_reach = std::max(std::abs(settings.offset_x), std::abs(settings.offset_y));
  options.instruction_set = settings.set;
  TriangleBins bins;
  bins.fill(view, frame.geometry(), options, pool);
  const auto pixels = static_cast<std::size_t>(view.width * view.height);
  Drawn drawn = {view.width, view.height, std::vector<int>(pixels), std::vector<float>(pixels),
                 std::vector<TriangleId>(pixels)};
  for (int ty = 0; ty * kTileSide < view.height; ++ty) {
    for (int tx = 0; tx * kTileSide < view.width; ++tx) {
      alignas(64) float depth[kTilePixels];
      alignas(64) TriangleId ids[kTilePixels];
      std::fill_n(depth, kTilePixels, view.reversed_far);
      std::fill_n(ids, kTilePixels, kNoTriangle);
      const TileTask task = {&view, bins.batches(), tx, ty, settings.offset_x, settings.offset_y, nullptr};
      rasterise_visibility_for(settings.set)(task, depth, ids);
      alignas(64) float only_depth[kTilePixels];
      std::fill_n(only_depth, kTilePixels, view.reversed_far);
      rasterise_depth_for(settings.set)(task, only_depth);
      std::vector<Fragment> fragments;
      rasterise_fragments_for(settings.set)(task, only_depth, fragments);
      for (int y = 0; y < std::min(kTileSide, view.height - ty * kTileSide); ++y) {
        for (int x = 0; x < std::min(kTileSide, view.width - tx * kTileSide); ++x) {
          const auto to = static_cast<std::size_t>((ty * kTileSide + y) * view.width + tx * kTileSide + x);
          const auto from = static_cast<std::size_t>(index_in_tile(x, y));
          EXPECT_EQ(depth[from], only_depth[from]);
          drawn.depth[to] = depth[from];
          drawn.ids[to] = ids[from];
          for (const Fragment& f : fragments) drawn.count[to] += f.pixel == from ? 1 : 0;
        }
      }
    }
  }
  return drawn;
}

// A scene of one blended primitive: every covered sample becomes a fragment, so coverage can be counted.
reference::OwnedFrame counting_frame(Primitive primitive) {
  Scene scene;
  reference::add_object(scene, "mesh", std::move(primitive));
  scene.materials[0].alpha_mode = AlphaMode::blend;
  return reference::make_frame(std::move(scene));
}

// Splits triangles of a plane region again and again at random points of random edges, where both neighbours share
// the new point: a mesh without T-junctions whose triangles are of all sizes and many are slivers.
std::vector<std::array<glm::vec2, 3>> random_tiling(std::mt19937& random, glm::vec2 low, glm::vec2 high,
                                                    int splits) {
  std::vector<glm::vec2> points = {low, {high.x, low.y}, high, {low.x, high.y}};
  std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  for (int n = 0; n < splits; ++n) {
    const std::array<int, 3> chosen = triangles[random() % triangles.size()];
    const int k = static_cast<int>(random() % 3);
    const int a = chosen[static_cast<std::size_t>(k)];
    const int b = chosen[static_cast<std::size_t>((k + 1) % 3)];
    const float t = std::uniform_real_distribution<float>(0.001F, 0.999F)(random);
    const int middle = static_cast<int>(points.size());
    points.push_back(glm::mix(points[static_cast<std::size_t>(a)], points[static_cast<std::size_t>(b)], t));
    const std::size_t before = triangles.size();
    for (std::size_t i = 0; i < before; ++i) {
      for (std::size_t e = 0; e < 3; ++e) {
        const int p = triangles[i][e];
        const int q = triangles[i][(e + 1) % 3];
        const int r = triangles[i][(e + 2) % 3];
        if (!((p == a && q == b) || (p == b && q == a))) continue;
        triangles[i] = {p, middle, r};
        triangles.push_back({middle, q, r});
        break;
      }
    }
  }
  std::vector<std::array<glm::vec2, 3>> out;
  out.reserve(triangles.size());
  for (const auto& t : triangles) {
    out.push_back({points[static_cast<std::size_t>(t[0])], points[static_cast<std::size_t>(t[1])],
                   points[static_cast<std::size_t>(t[2])]});
  }
  return out;
}

class RasterOnEverySet : public testing::TestWithParam<InstructionSet> {};

TEST_P(RasterOnEverySet, MeshesWithSharedEdgesCoverEverySampleOnce) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 40; ++trial) {
    // From far inside the picture to far beyond the guard band.
    const float reach = std::pow(10.0F, static_cast<float>(trial % 5));
    Mesher mesh;
    for (const auto& t :
         random_tiling(random, {-reach - 1.7F, -reach - 1.3F}, {reach + 1.1F, reach + 2.3F}, 120)) {
      mesh.triangle({t[0], 0}, {t[1], 0}, {t[2], 0});
    }
    const auto owned = counting_frame(mesh.primitive);
    const View view = reference::look({0, 0, 2}, {0, 0, 0}, 50, 1.5);
    const RasterView raster(view, 150, 100);
    DrawSettings settings;
    settings.set = GetParam();
    settings.offset_x = static_cast<int>(random() % 255) - 127;
    settings.offset_y = static_cast<int>(random() % 255) - 127;
    const Drawn drawn = draw(owned.frame, raster, settings);
    for (std::size_t i = 0; i < drawn.count.size(); ++i)
      ASSERT_EQ(drawn.count[i], 1) << "trial " << trial << " pixel " << i;
  }
}

TEST_P(RasterOnEverySet, TiltedMeshesThroughTheNearPlaneHaveNoGapsAndNoDoubleHits) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 20; ++trial) {
    Mesher mesh;
    for (const auto& t : random_tiling(random, {-3000, -3000}, {3000, 3000}, 150)) {
      mesh.triangle({t[0].x, 0, t[0].y}, {t[2].x, 0, t[2].y}, {t[1].x, 0, t[1].y});
    }
    const auto owned = counting_frame(mesh.primitive);
    const View view = reference::look({0.3, 1.5, 0.2}, {0.3 + trial, 0.4, -4}, 70, 1, {0, 1, 0}, 0.1, 1e6);
    const RasterView raster(view, 128, 128);
    DrawSettings settings;
    settings.set = GetParam();
    // Near the horizon, snapping turns some slivers over, as on any rasteriser that snaps; each then hides what its
    // neighbours cover twice. Fronts less backs is what must be one.
    settings.cull = CullFaces::single_sided;
    const Drawn fronts = draw(owned.frame, raster, settings);
    settings.cull = CullFaces::front;
    const Drawn backs = draw(owned.frame, raster, settings);
    int covered = 0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        // Where the pixel's ray meets the floor inside the mesh, once; above the horizon, never.
        const glm::dvec3 direction =
            raster.direction_0 + raster.direction_x * (x - 64 + 0.5) + raster.direction_y * (y - 64 + 0.5);
        const double t = -1.5 / direction.y;
        const glm::dvec3 hit = glm::dvec3(0.3, 1.5, 0.2) + t * direction;
        const auto i = static_cast<std::size_t>(y * 128 + x);
        const int count = fronts.count[i] - backs.count[i];
        if (direction.y >= 0) {
          ASSERT_EQ(count, 0) << trial << " " << x << " " << y;
        } else if (std::abs(hit.x) < 2900 && std::abs(hit.z) < 2900) {
          ASSERT_EQ(count, 1) << trial << " " << x << " " << y;
        }
        covered += count;
      }
    }
    EXPECT_GT(covered, 3000);
  }
}

// Coverage by the definition: snapped corners, integer edge functions, the top-left rule, one sample at a time.
int reference_coverage(const RasterView& view, const std::array<glm::dvec3, 3>& triangle_ws, int px, int py) {
  std::int64_t x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    // The pipeline transforms in float; these scenes have coordinates that are exact in it.
    const glm::dvec3 p = triangle_ws[static_cast<std::size_t>(i)] - view.eye_ws;
    const auto w = static_cast<float>(glm::dot(view.w_row, p));
    const float q = 1.0F / w;
    x[i] = static_cast<std::int64_t>(std::nearbyint(static_cast<float>(glm::dot(view.x_row, p)) * q * 256));
    y[i] = static_cast<std::int64_t>(std::nearbyint(static_cast<float>(glm::dot(view.y_row, p)) * q * 256));
  }
  std::int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0) return 0;
  if (area < 0) {
    std::swap(x[1], x[2]);
    std::swap(y[1], y[2]);
  }
  const std::int64_t sx = (px - view.origin_x) * 256 + 128;
  const std::int64_t sy = (py - view.origin_y) * 256 + 128;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const std::int64_t e = (x[j] - x[i]) * (sy - y[i]) - (y[j] - y[i]) * (sx - x[i]);
    const bool top_left = y[j] < y[i] || (y[j] == y[i] && x[j] > x[i]);
    if (e < 0 || (e == 0 && !top_left)) return 0;
  }
  return 1;
}

TEST_P(RasterOnEverySet, CoversExactlyWhatTheEdgeFunctionsSay) {
  std::mt19937 random(5);
  // The view's rows and these corners are dyadic, so that float and double agree: pixel = 64 x / w.
  View view;
  view.projection = {false, -1, 1, -1, 1, 0.5, 100};
  const RasterView raster(view, 128, 128);
  for (int trial = 0; trial < 300; ++trial) {
    const int scale = trial % 3 == 0 ? 4 : trial % 3 == 1 ? 64 : 1024;
    std::array<glm::dvec3, 3> t;
    const glm::dvec2 centre(static_cast<int>(random() % 128) - 64, static_cast<int>(random() % 128) - 64);
    for (auto& v : t) {
      // On a grid of 1/8 pixel at w = 1: many samples and corners fall exactly on edges.
      v = {(centre.x + (static_cast<int>(random() % 256) - 128) / 128.0 * scale) / 64,
           (centre.y + (static_cast<int>(random() % 256) - 128) / 128.0 * scale) / 64, -1};
      v.x = std::round(v.x * 512) / 512;
      v.y = std::round(v.y * 512) / 512;
    }
    Mesher mesh;
    mesh.triangle(glm::vec3(t[0]), glm::vec3(t[1]), glm::vec3(t[2]));
    const auto owned = counting_frame(mesh.primitive);
    DrawSettings settings;
    settings.set = GetParam();
    const Drawn drawn = draw(owned.frame, raster, settings);
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        ASSERT_EQ(drawn.count[static_cast<std::size_t>(y * 128 + x)], reference_coverage(raster, t, x, y))
            << "trial " << trial << " at " << x << ", " << y;
      }
    }
  }
}

TEST_P(RasterOnEverySet, DepthIsThePlanesReciprocalDistance) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-4, 4);
  for (int trial = 0; trial < 200; ++trial) {
    Scene scene;
    Mesher mesh;
    const glm::vec3 a(place(random), place(random), -6 + place(random)),
        b(place(random), place(random), -6 + place(random)),
        c(place(random), place(random), -6 + place(random));
    mesh.triangle(a, b, c);
    reference::add_object(scene, "t", mesh.primitive);
    scene.materials[0].double_sided = true;
    const auto owned = reference::make_frame(std::move(scene));
    const RasterView raster(reference::look({0, 0, 0}, {0, 0, -1}, 60, 1), 100, 100);
    DrawSettings settings;
    settings.set = GetParam();
    const Drawn drawn = draw(owned.frame, raster, settings);
    const glm::dvec3 n = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const double lowest = 1 / std::max({-a.z, -b.z, -c.z});
    const double highest = 1 / std::min({-a.z, -b.z, -c.z});
    for (int y = 0; y < 100; ++y) {
      for (int x = 0; x < 100; ++x) {
        const auto i = static_cast<std::size_t>(y * 100 + x);
        if (drawn.ids[i] == kNoTriangle) continue;
        const glm::dvec3 direction =
            raster.direction_0 + raster.direction_x * (x - 50 + 0.5) + raster.direction_y * (y - 50 + 0.5);
        const double q = std::clamp(glm::dot(n, direction) / glm::dot(n, glm::dvec3(a)), lowest, highest);
        // Small triangles interpolate in float from float corners: the gradient's rounding grows with its steepness.
        const double steepness = (highest - lowest) / lowest;
        EXPECT_NEAR(drawn.depth[i] / q, 1, 4e-7 * (1 + 20 * steepness)) << "trial " << trial;
      }
    }
  }
}

TEST_P(RasterOnEverySet, AtEqualDepthTheFirstTriangleWins) {
  Scene scene;
  reference::add_object(scene, "first", reference::wall(1, 1, 0));
  reference::add_object(scene, "second", reference::wall(1, 1, 0));
  const auto owned = reference::make_frame(std::move(scene));
  const RasterView raster(reference::look({0, 0, 3}, {0, 0, 0}, 30, 1), 64, 64);
  DrawSettings settings;
  settings.set = GetParam();
  const Drawn drawn = draw(owned.frame, raster, settings);
  for (const TriangleId id : drawn.ids) EXPECT_EQ(owned.frame.clusters[cluster_of(id)].object, 0U);
}

TEST_P(RasterOnEverySet, BackFacesOfSingleSidedSurfacesAreCulled) {
  Scene scene;
  reference::add_object(scene, "wall", reference::wall(1, 1, 0));
  const auto owned = reference::make_frame(std::move(scene));
  DrawSettings settings;
  settings.set = GetParam();
  settings.cull = CullFaces::single_sided;
  const auto is_seen = [&](double z) {
    const RasterView raster(reference::look({0, 0, z}, {0, 0, 0}, 30, 1), 64, 64);
    return draw(owned.frame, raster, settings).ids[0] != kNoTriangle;
  };
  EXPECT_TRUE(is_seen(3));
  EXPECT_FALSE(is_seen(-3));
  settings.cull = CullFaces::front;
  EXPECT_FALSE(is_seen(3));
  EXPECT_TRUE(is_seen(-3));
}

Scene crowd() {
  Scene scene;
  for (int i = 0; i < 12; ++i) {
    const auto f = static_cast<float>(i);
    reference::add_object(
        scene, "torus",
        reference::torus({2 * std::sin(f), 0.2F * f - 1, 2 * std::cos(2 * f)}, 0.8F, 0.3F, 48));
  }
  reference::add_object(scene, "floor", reference::floor(60, -1.3F));
  return scene;
}

TEST_P(RasterOnEverySet, GivesTheSameBitsAsScalarForAnyNumberOfThreads) {
  const auto owned = reference::make_frame(crowd());
  const RasterView raster(reference::look({0, 1.5, 6}, {0, 0, 0}, 60, 1.6), 320, 200);
  const Drawn expected = draw(owned.frame, raster, {});
  for (const int threads : {1, 2, 7, 64}) {
    DrawSettings settings;
    settings.set = GetParam();
    settings.threads = threads;
    const Drawn drawn = draw(owned.frame, raster, settings);
    EXPECT_EQ(drawn.depth, expected.depth);
    EXPECT_EQ(drawn.ids, expected.ids);
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, RasterOnEverySet, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::raster
