// Terrain: heights from pictures, and surfaces without cracks that keep within their error.
#include "laterna/terrain.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>

#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

HeightMap map_of(int columns, int rows, double (*height)(double, double)) {
  HeightMap map = {columns, rows, {}};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) map.heights.push_back(static_cast<float>(height(i, j)));
  }
  return map;
}

double rugged(double x, double z) {
  return 3 * std::sin(x / 9) * std::cos(z / 7) + 0.4 * std::sin(x * 1.3 + z * 2.1) +
         (x > 20 && z < 15 ? 2 : 0);
}

// The sample that a vertex stands on, where the size is a metre for each cell.
std::pair<int, int> sample_of(const HeightMap& map, const glm::vec3& p) {
  return {static_cast<int>(std::lround(p.x + 0.5 * (map.columns - 1))),
          static_cast<int>(std::lround(p.z + 0.5 * (map.rows - 1)))};
}

Primitive terrain_of(const HeightMap& map, double error) {
  return make_terrain(map, {map.columns - 1.0, map.rows - 1.0, error}).value();
}

// ------------------------------------------------------------------------------------------------------- samples

TEST(HeightMaps, CodesAreFractionsOfTheHeightAndFloatsFactors) {
  const TemporaryFolder folder;
  const auto heights = [&](const std::string& name, std::string_view content, double height) {
    const Result<HeightMap> map = read_height_map(folder.write(name, content), height);
    EXPECT_TRUE(map) << to_string(map.error());
    return map ? map->heights : std::vector<float>();
  };
  EXPECT_EQ(heights("a.pgm", {"P5 2 2 255\n\x00\x33\xCC\xFF", 15}, 10), (std::vector<float>{0, 2, 8, 10}));
  EXPECT_EQ(heights("b.pgm", {"P5 2 2 65535\n\x00\x00\x33\x33\xCC\xCC\xFF\xFF", 21}, -10),
            (std::vector<float>{0, -2, -8, -10}));
  // No transfer function: code 51 of 255 is a fifth, though as sRGB it were 3 %. Of colours, the first counts.
  EXPECT_EQ(heights("c.ppm", {"P6 2 2 255\n\x33zz\x66zz\x99zz\xCCzz", 23}, 5),
            (std::vector<float>{1, 2, 3, 4}));
  const float values[4] = {3, 4, -1.5F, 0.25F};  // PFM begins with the lowest row
  std::string pfm = "Pf\n2 2\n-1.0\n";
  pfm.append(reinterpret_cast<const char*>(values), sizeof(values));
  EXPECT_EQ(heights("d.pfm", pfm, 2), (std::vector<float>{-3, 0.5F, 6, 8}));
}

TEST(HeightMaps, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, std::string_view content) {
    const Result<HeightMap> map = read_height_map(folder.write(name, content), 1);
    return map ? "no error" : to_string(map.error()).substr(folder.path().string().size() + 1);
  };
  EXPECT_EQ(message("a.pgm", "P5 1 3 255\nabc"),
            "a.pgm: a height map has at least 2 x 2 samples, this one has 1 x 3");
  folder.write("b.pbm", "P4 8193 8192\n");
  std::filesystem::resize_file(folder / "b.pbm", 13 + 1025 * 8192);
  const Result<HeightMap> large = read_height_map(folder / "b.pbm", 1);
  ASSERT_FALSE(large);
  EXPECT_EQ(to_string(large.error()).substr(folder.path().string().size() + 1),
            "b.pbm: a height map has at most 67108864 samples (8192 x 8192), this one has 8193 x 8192");
  EXPECT_NE(message("c.pgm", "P5 4 4 255\nabc"), "no error");
  EXPECT_NE(message("d.txt", "hills"), "no error");
  float values[6] = {1, 2, 3, 4, 5, 6};
  const auto pfm = [&] {
    return "Pf\n3 2\n-1.0\n" + std::string(reinterpret_cast<const char*>(values), sizeof(values));
  };
  values[1] = std::nanf("");
  EXPECT_NE(message("e.pfm", pfm()).find("nan"), std::string::npos);
  values[1] = 2e9F;
  EXPECT_EQ(message("f.pfm", pfm()), "f.pfm: column 1, row 1: expected a height within 1e+09 m, got 2e+09");
}

TEST(Terrain, SaysWhatIsWrong) {
  const auto message = [](const HeightMap& map, const TerrainShape& shape) {
    const Result<Primitive> terrain = make_terrain(map, shape);
    return terrain ? "no error" : to_string(terrain.error());
  };
  const HeightMap map = {2, 2, {0, 0, 0, 0}};
  EXPECT_EQ(message({2, 2, {0, 0, 0}}, {}), "expected 2 x 2 to 67108864 heights, got 3 of a map of 2 x 2");
  EXPECT_EQ(message({1, 4, {0, 0, 0, 0}}, {}), "expected 2 x 2 to 67108864 heights, got 4 of a map of 1 x 4");
  EXPECT_EQ(message(map, {0, 1, 0}), "expected a size greater than 0 m, got 0 x 1");
  EXPECT_EQ(message(map, {1, 1, -1}), "expected an error of 0 m or more, got -1");
  EXPECT_EQ(message(map, {1, 1, std::nan("")}), "expected an error of 0 m or more, got nan");
  EXPECT_EQ(message({2, 2, {0, 0, 0, INFINITY}}, {}),
            "expected heights that are finite and no larger than coordinates may be");
}

// ------------------------------------------------------------------------------------------------------- surface

TEST(Terrain, VerticesStandOnSamples) {
  const HeightMap map = map_of(5, 3, rugged);
  const Primitive terrain = make_terrain(map, {8, 6, 0}).value();
  ASSERT_EQ(terrain.positions.size(), 15U);
  EXPECT_EQ(terrain.indices.size(), 3U * 2 * 4 * 2);
  for (std::size_t v = 0; v < 15; ++v) {
    const glm::vec3 p = terrain.positions[v];
    const double i = p.x / 2 + 2, j = p.z / 3 + 1;
    EXPECT_EQ(i, std::floor(i));
    EXPECT_EQ(j, std::floor(j));
    EXPECT_EQ(p.y, map.heights[static_cast<std::size_t>(j * 5 + i)]);
    EXPECT_FLOAT_EQ(terrain.uv[0][v].x, static_cast<float>(i / 4));
    EXPECT_FLOAT_EQ(terrain.uv[0][v].y, static_cast<float>(j / 2));
  }
}

// Central differences of a parabola are its derivatives; its slopes at the border are those half a cell inside.
TEST(Terrain, NormalsInClosedForm) {
  const HeightMap map =
      map_of(9, 7, [](double x, double z) { return 0.5 * x + 0.25 * x * x - 0.125 * z * z; });
  const Primitive terrain = make_terrain(map, {4, 3, 0}).value();  // cells of half a metre
  ASSERT_EQ(terrain.normals.size(), 63U);
  for (std::size_t v = 0; v < terrain.normals.size(); ++v) {
    const double i = terrain.positions[v].x * 2 + 4, j = terrain.positions[v].z * 2 + 3;
    const double at_x = std::clamp(i, 0.5, 7.5), at_z = std::clamp(j, 0.5, 5.5);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-2 * (0.5 + 0.5 * at_x), 1, -2 * (-0.25 * at_z)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(terrain.normals[v][c], normal[c], 1e-6) << i << " " << j;
  }
}

// Each edge has two triangles, one on each side, or lies on the map's border; and all of the map is covered once.
void expect_no_cracks(const HeightMap& map, const Primitive& terrain) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double doubled_area = 0;
  for (std::size_t t = 0; t < terrain.indices.size(); t += 3) {
    std::array<glm::dvec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{terrain.indices[t + k], terrain.indices[t + (k + 1) % 3]}];
      p[k] = terrain.positions[terrain.indices[t + k]];
    }
    const glm::dvec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
    ASSERT_GT(across.y, 0);  // counter-clockwise from above
    doubled_area += across.y;
  }
  EXPECT_EQ(doubled_area, 2.0 * (map.columns - 1) * (map.rows - 1));
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    if (edges.contains({edge.second, edge.first})) continue;
    const auto [x0, z0] = sample_of(map, terrain.positions[edge.first]);
    const auto [x1, z1] = sample_of(map, terrain.positions[edge.second]);
    const bool is_border =
        (x0 == x1 && (x0 == 0 || x0 == map.columns - 1)) || (z0 == z1 && (z0 == 0 || z0 == map.rows - 1));
    ASSERT_TRUE(is_border) << x0 << " " << z0 << " to " << x1 << " " << z1;
  }
}

// Of every sample from the surface, straight up or down.
double largest_deviation(const HeightMap& map, const Primitive& terrain) {
  double largest = 0;
  for (std::size_t t = 0; t < terrain.indices.size(); t += 3) {
    std::array<glm::dvec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [x, z] = sample_of(map, terrain.positions[terrain.indices[t + k]]);
      p[k] = {x, terrain.positions[terrain.indices[t + k]].y, z};
    }
    const glm::dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].z, p[1].z, p[2].z});
    for (double z = top; z <= bottom; ++z) {
      for (double x = left; x <= right; ++x) {
        bool is_inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const glm::dvec3 along = p[(k + 1) % 3] - p[k];
          is_inside &= along.z * (x - p[k].x) - along.x * (z - p[k].z) >= 0;
        }
        if (!is_inside) continue;
        const double surface = p[0].y - (n.x * (x - p[0].x) + n.z * (z - p[0].z)) / n.y;
        const auto sample =
            static_cast<std::size_t>(z) * static_cast<std::size_t>(map.columns) + static_cast<std::size_t>(x);
        largest = std::max(largest, std::abs(map.heights[sample] - surface));
      }
    }
  }
  return largest;
}

TEST(Terrain, IsWithoutCracksAndWithinItsError) {
  for (const auto& [columns, rows] : {std::pair{2, 2}, {2, 9}, {33, 33}, {37, 23}, {129, 33}, {260, 18}}) {
    const HeightMap map = map_of(columns, rows, rugged);
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (const double error : {0.0, 0.05, 0.5, 2.0, 100.0}) {
      SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows) + ", " + std::to_string(error));
      const Primitive terrain = terrain_of(map, error);
      expect_no_cracks(map, terrain);
      EXPECT_LE(largest_deviation(map, terrain), error + 1e-6);
      EXPECT_LE(terrain.indices.size(), before);
      before = terrain.indices.size();
    }
    EXPECT_LE(before / 3, 4U * static_cast<std::size_t>(
                                   columns + rows));  // only borders that are no whole squares are fine
  }
}

TEST(Terrain, WhatIsFlatCostsNothing) {
  const HeightMap slope = map_of(257, 513, [](double x, double z) { return 0.25 * x - 0.5 * z; });
  EXPECT_EQ(terrain_of(slope, 0).indices.size() / 3, 4U);
  HeightMap bump = slope;
  bump.heights[300 * 257 + 100] += 1;
  EXPECT_LT(terrain_of(bump, 0).indices.size() / 3, 200U);
  EXPECT_EQ(largest_deviation(bump, terrain_of(bump, 0)), 0);
}

// ------------------------------------------------------------------------------------------------------- rigs

TEST(RigTerrain, KeysAndDefaults) {
  const TemporaryFolder folder;
  folder.write("map.pgm", std::string_view("P5 2 2 255\n\x00\x33\xCC\xFF", 15));
  const Result<Scene> scene = load_scene({}, {.rigs = {folder.write("r.json", R"({"terrain": [
    {"heights": "map.pgm", "size": [10, 20]},
    {"name": "hills", "heights": "map.pgm", "size": [10, 20], "height": 5, "position": [1, 2, 3], "color": [0.5, 0.25, 1],
     "roughness": 0.5, "texture": "map.pgm", "texture_repeat": 8}],
    "nodes": [{"name": "hills", "casts_shadow": false}]})")}});
  ASSERT_TRUE(scene) << to_string(scene.error());
  ASSERT_EQ(scene->nodes.size(), 2U);
  EXPECT_EQ(scene->nodes[0].name, "terrain 1");
  EXPECT_TRUE(scene->nodes[0].casts_shadow);
  EXPECT_FALSE(scene->nodes[1].casts_shadow);
  EXPECT_EQ(scene->nodes[1].parent_from_node[3], glm::dvec4(1, 2, 3, 1));
  const Material& plain = scene->materials[0];
  EXPECT_EQ(plain.base_color, glm::vec4(1));
  EXPECT_EQ(plain.metallic, 0);
  EXPECT_EQ(plain.roughness, 1);
  EXPECT_FALSE(plain.base_color_texture.is_set());
  const Material& painted = scene->materials[1];
  EXPECT_EQ(painted.base_color, glm::vec4(0.5, 0.25, 1, 1));
  EXPECT_EQ(painted.roughness, 0.5F);
  EXPECT_EQ(scene->pictures.at(static_cast<std::size_t>(painted.base_color_texture.picture)).file,
            folder / "map.pgm");
  EXPECT_EQ(painted.base_color_texture.uv_from_mesh_uv, (std::array<float, 6>{8, 0, 0, 0, 8, 0}));
  for (std::size_t i = 0; i < 2; ++i) {
    const Primitive& surface = scene->meshes[i].primitives.at(0);
    EXPECT_EQ(surface.material, static_cast<int>(i));
    const float height = i == 0 ? 1.0F : 5.0F;
    for (const glm::vec3& p : surface.positions) {
      const bool is_east = p.x > 0, is_south = p.z > 0;
      EXPECT_EQ(std::abs(p.x), 5);
      EXPECT_EQ(std::abs(p.z), 10);
      EXPECT_FLOAT_EQ(p.y, height * (is_south ? (is_east ? 1 : 0.8F) : (is_east ? 0.2F : 0)));
    }
  }
}

TEST(RigTerrain, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  folder.write("map.pgm", std::string_view("P5 2 2 255\n\x00\x33\xCC\xFF", 15));
  folder.write("line.pgm", "P5 1 2 255\nab");
  const auto message = [&](const std::string& terrain) {
    return messages_of(
        load_scene({}, {.rigs = {folder.write("r.json", "{\"terrain\": [\n" + terrain + "]}")}}),
        folder.path());
  };
  EXPECT_EQ(message("{}"),
            "r.json: line 2: terrain[0].heights: is missing\nr.json: line 2: terrain[0].size: is missing");
  EXPECT_EQ(message("7"), "r.json: line 2: terrain[0]: expected an object, got 7");
  EXPECT_EQ(message(R"({"heights": "line.pgm", "size": [1, 1]})"),
            "r.json: line 2: terrain[0].heights: line.pgm: a height map has at least 2 x 2 samples, this one "
            "has 1 x 2");
  EXPECT_NE(message(R"({"heights": "none.pgm", "size": [1, 1]})").find("line 2: terrain[0].heights: "),
            std::string::npos);
  EXPECT_NE(message(R"({"heights": "map.pgm", "size": [1, 1], "texture": "none.png"})")
                .find("terrain[0].texture: "),
            std::string::npos);
  EXPECT_NE(message(R"({"heights": "map.pgm", "size": [1, 0]})").find("terrain[0].size[1]: "),
            std::string::npos);
  EXPECT_NE(message(R"({"heights": "map.pgm", "size": [1, 1], "error": -1})").find("terrain[0].error: "),
            std::string::npos);
  EXPECT_NE(message(R"({"heights": "map.pgm", "size": [1, 1], "texture_repeat": 0})")
                .find("terrain[0].texture_repeat: "),
            std::string::npos);
  EXPECT_NE(
      message(R"({"heights": "map.pgm", "size": [1, 1], "name": ""})").find("terrain[0].name: is empty"),
      std::string::npos);
  EXPECT_EQ(message(R"({"heights": "map.pgm", "size": [1, 1], "hight": 3})"),
            "r.json: line 2: terrain[0].hight: a terrain has no key \"hight\" (did you mean \"height\"?)");
}

}  // namespace
}  // namespace laterna
