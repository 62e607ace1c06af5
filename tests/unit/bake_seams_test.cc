// Where smooth surfaces are cut open for their light maps, both sides read alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "laterna/bake.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using namespace reference;

using Key = std::array<float, 3>;
Key key_of(const glm::vec3& p) { return {p.x, p.y, p.z}; }

// What a bilinear look-up reads of red, written independently of the baker's.
double read(const Image& page, const glm::dvec2& uv) {
  const double x = uv.x * page.width() - 0.5, y = uv.y * page.height() - 0.5;
  const double u = x - std::floor(x), v = y - std::floor(y);
  const auto luxel = [&](double column, double row) {
    return double{page.value(std::clamp(static_cast<int>(std::floor(column)), 0, page.width() - 1),
                             std::clamp(static_cast<int>(std::floor(row)), 0, page.height() - 1), 0)};
  };
  return (luxel(x, y) * (1 - u) + luxel(x + 1, y) * u) * (1 - v) +
         (luxel(x, y + 1) * (1 - u) + luxel(x + 1, y + 1) * u) * v;
}

// Of what is read on both sides at the middles of edges that lie twice in the page.
std::vector<double> differences_at_seams(const Scene& baked) {
  std::map<std::tuple<Key, Key>, std::vector<glm::dvec2>> places;
  std::vector<double> differences;
  for (const Mesh& mesh : baked.meshes) {
    for (const Primitive& p : mesh.primitives) {
      places.clear();
      for (std::size_t i = 0; i < p.indices.size(); ++i) {
        const std::uint32_t a = p.indices[i], b = p.indices[i % 3 == 2 ? i - 2 : i + 1];
        const Key from = key_of(p.positions[a]), to = key_of(p.positions[b]);
        places[std::minmax(from, to)].push_back(0.5 * (glm::dvec2(p.uv[1][a]) + glm::dvec2(p.uv[1][b])));
      }
      const Material& material = baked.materials[static_cast<std::size_t>(p.material)];
      const Image& page = *baked.pictures[static_cast<std::size_t>(material.light_map.front.picture)].pixels;
      for (const auto& [edge, at] : places) {
        if (at.size() == 2 && glm::length(at[1] - at[0]) > 1e-3)
          differences.push_back(std::abs(read(page, at[1]) - read(page, at[0])));
      }
    }
  }
  return differences;
}

Scene lit_from_aside(Primitive shape) {
  Scene scene;
  add_object(scene, "shape", std::move(shape));
  add_light(scene, bulb("lamp", 10), {2, 1, 0.5}, {0, 0, 0});
  return scene;
}

// The light ends at the terminator, whose luxels are differently cut in every chart.
TEST(BakedSeams, ReadAlikeOnBothSides) {
  for (const Primitive& shape : {sphere({0, 0, 0}, 1, 32), torus({0, 0, 0}, 1, 0.4F, 48)}) {
    const Scene scene = lit_from_aside(shape);
    BakeSettings settings;
    settings.density = 8;
    settings.join_seams = false;
    const Result<BakedScene> raw = bake_light(scene, settings);
    settings.join_seams = true;
    const Result<BakedScene> joined = bake_light(scene, settings);
    ASSERT_TRUE(raw && joined);
    const std::vector<double> before = differences_at_seams(raw->scene),
                              after = differences_at_seams(joined->scene);
    ASSERT_GT(before.size(), 100U);
    ASSERT_EQ(before.size(), after.size());
    EXPECT_GT(std::ranges::max(before), 0.4);  // lux, of some 5
    EXPECT_LT(std::ranges::max(after), 0.2 * std::ranges::max(before));
    double squares_before = 0, squares_after = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      squares_before += before[i] * before[i], squares_after += after[i] * after[i];
    EXPECT_LT(squares_after, 0.01 * squares_before);
  }
}

// Where a box has its edges, light changes: nothing is mixed.
TEST(BakedSeams, HardEdgesKeepTheirLight) {
  const Scene scene = lit_from_aside(box({0, 0, 0}, {1, 1, 1}));
  BakeSettings settings;
  const Result<BakedScene> joined = bake_light(scene, settings);
  settings.join_seams = false;
  const Result<BakedScene> raw = bake_light(scene, settings);
  ASSERT_TRUE(raw && joined);
  ASSERT_EQ(raw->scene.pictures.size(), joined->scene.pictures.size());
  for (std::size_t i = 0; i < raw->scene.pictures.size(); ++i) {
    const std::span<const float> a = raw->scene.pictures[i].pixels->values<float>();
    EXPECT_TRUE(std::ranges::equal(a, joined->scene.pictures[i].pixels->values<float>()));
  }
}

}  // namespace
}  // namespace laterna
