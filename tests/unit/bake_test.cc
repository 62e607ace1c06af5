// Layout, light on both sides, files, and going on where a bake was stopped.
#include "laterna/bake.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "bake/atlas_packer.h"
#include "bake/charts.h"
#include "laterna/relief.h"
#include "laterna/write_scene.h"
#include "reference/shapes.h"
#include "unit/temporary_folder.h"

namespace laterna {
namespace {

using namespace reference;

std::vector<float> numbers_of(const BakedScene& baked) {
  std::vector<float> numbers;
  for (const Picture& picture : baked.scene.pictures) {
    if (picture.pixels == nullptr || picture.pixels->type() != PixelType::f32) continue;
    const std::span<const float> values = picture.pixels->values<float>();
    numbers.insert(numbers.end(), values.begin(), values.end());
  }
  return numbers;
}

Scene lit_shapes() {
  Scene scene;
  add_object(scene, "ball", sphere({0, 1, 0}, 0.6F, 12));
  add_object(scene, "floor", floor(2));
  add_light(scene, bulb("left", 30), {-1, 3, 1}, {0, 0, 0});
  add_light(scene, bulb("right", 20), {2, 2, -1}, {0, 0, 0});
  return scene;
}

TEST(Bake, PackedRectanglesKeepTheirDistance) {
  std::vector<glm::ivec2> sizes;
  for (unsigned i = 0; i < 300; ++i) sizes.emplace_back(1 + (i * 7919U) % 37U, 1 + (i * 104729U) % 23U);
  for (const int gap : {1, 3}) {
    for (const int side : {37, 128, 1024}) {
      const bake::PackedRectangles packed = bake::pack_rectangles(sizes, gap, side, 100).value();
      std::vector<std::vector<int>> owner(packed.pages.size());
      for (std::size_t p = 0; p < packed.pages.size(); ++p) {
        ASSERT_LE(std::max(packed.pages[p].x, packed.pages[p].y), side);
        owner[p].assign(static_cast<std::size_t>((side + gap) * (side + gap)), -1);
      }
      for (std::size_t i = 0; i < sizes.size(); ++i) {
        const auto& place = packed.places[i];
        ASSERT_LE(place.corner.x + sizes[i].x, packed.pages[place.page].x);
        ASSERT_LE(place.corner.y + sizes[i].y, packed.pages[place.page].y);
        for (int y = 0; y < sizes[i].y + gap; ++y) {
          for (int x = 0; x < sizes[i].x + gap; ++x) {
            int& cell =
                owner[place.page]
                     [static_cast<std::size_t>((place.corner.y + y) * (side + gap) + place.corner.x + x)];
            ASSERT_EQ(cell, -1) << i;
            cell = static_cast<int>(i);
          }
        }
      }
    }
  }
}

// Every triangle is in one chart, none is turned over in it, and no place of a chart belongs to two.
TEST(Bake, ChartsHoldEveryTriangleOnceAndLieFlat) {
  const Primitive shapes[] = {sphere({0, 0, 0}, 1, 16), torus({0, 0, 0}, 1, 0.4F, 16),
                              box({0, 0, 0}, {1, 2, 3})};
  for (const Primitive& shape : shapes) {
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < std::max(shape.indices.size(), shape.positions.size()); ++i) {
      if (!shape.indices.empty() && i >= shape.indices.size()) break;
      corners.emplace_back(shape.positions[shape.indices.empty() ? i : shape.indices[i]]);
    }
    std::vector<int> uses(corners.size() / 3, 0);
    for (const bake::Chart& chart : bake::cut_into_charts(corners, 0.01, 100)) {
      std::vector<glm::dvec2> flat;
      double sign = 0;
      for (const std::uint32_t t : chart.triangles) {
        ++uses[t];
        for (std::size_t k = 0; k < 3; ++k) flat.push_back(chart.flat(corners[3 * t + k]) - chart.low);
        const glm::dvec2 u = flat[flat.size() - 2] - flat[flat.size() - 3],
                         v = flat.back() - flat[flat.size() - 3];
        const double area = u.x * v.y - u.y * v.x;
        const double true_area =
            glm::length(glm::cross(corners[3 * t + 1] - corners[3 * t], corners[3 * t + 2] - corners[3 * t]));
        EXPECT_GE(area * (sign == 0 ? 1 : sign) * (area < 0 && sign == 0 ? -1 : 1), 0.866 * true_area);
        sign = area < 0 ? -1 : 1;
      }
      EXPECT_GE(chart.size.x, chart.size.y);
      for (double x = 0.013; x < chart.size.x; x += 0.05) {
        for (double y = 0.017; y < chart.size.y; y += 0.05) {
          int covering = 0;
          for (std::size_t i = 0; i < flat.size(); i += 3) {
            const auto side = [&](std::size_t a, std::size_t b) {
              const glm::dvec2 e = flat[i + b] - flat[i + a], d = glm::dvec2(x, y) - flat[i + a];
              return e.x * d.y - e.y * d.x > 0;
            };
            covering += side(0, 1) == side(1, 2) && side(1, 2) == side(2, 0) ? 1 : 0;
          }
          ASSERT_LE(covering, 1);
        }
      }
    }
    for (std::size_t t = 0; t < uses.size(); ++t) {
      const bool has_area = glm::length(glm::cross(corners[3 * t + 1] - corners[3 * t],
                                                   corners[3 * t + 2] - corners[3 * t])) > 0;
      EXPECT_EQ(uses[t], has_area ? 1 : 0);
    }
  }
}

TEST(Bake, AWindingRampIsLaidOutWithoutOverlap) {
  Mesher ramp;
  const auto at = [](int i, float radius) {
    const float angle = 0.2F * static_cast<float>(i);
    return glm::vec3(radius * std::cos(angle), 0.02F * static_cast<float>(i), radius * std::sin(angle));
  };
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 70; ++i) {
    for (const glm::vec3& p : {at(i, 1), at(i + 1, 2), at(i, 2), at(i, 1), at(i + 1, 1), at(i + 1, 2)})
      corners.emplace_back(p);
  }
  const std::vector<bake::Chart> charts = bake::cut_into_charts(corners, 0.02, 100);
  EXPECT_GE(charts.size(), 3U);
  EXPECT_LE(charts.size(), 6U);
}

TEST(Bake, TheResultDependsOnNeitherThreadsNorInstructionSet) {
  BakeSettings settings;
  settings.occlusion_rays = 8;
  settings.options.threads = 1;
  settings.options.instruction_set = InstructionSet::scalar;
  const Result<BakedScene> first = bake_light(lit_shapes(), settings);
  settings.options.threads = 3;
  settings.options.instruction_set.reset();
  const Result<BakedScene> second = bake_light(lit_shapes(), settings);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(numbers_of(*first), numbers_of(*second));
}

TEST(Bake, WhatIsWrittenIsReadAndShownAsItWas) {
  const TemporaryFolder folder;
  BakeSettings settings;
  settings.occlusion_rays = 4;
  const Result<BakedScene> baked = bake_light(lit_shapes(), settings);
  ASSERT_TRUE(baked);
  EXPECT_TRUE(baked->scene.lights.empty());
  const View view = look({2, 2, 3}, {0, 0.5, 0}, 45, 1);
  const LayeredImage shown = render(make_renderer(baked->scene), view, test_settings(64, 64));
  for (const char* name : {"baked.glb", "baked.gltf"}) {
    const std::filesystem::path file = folder.path() / name;
    ASSERT_TRUE(write_scene(baked->scene, file));
    const Result<Scene> read = load_scene({file});
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->warnings.empty());
    const LayeredImage again = render(make_renderer(*read), view, test_settings(64, 64));
    for (std::size_t c = 0; c < shown.channels.size(); ++c)
      EXPECT_EQ(again.channels[c].values, shown.channels[c].values);
  }
}

// A sheet that is lit from below is bright below and dark above.
TEST(Bake, DoubleSidedSurfacesHaveLightOnBothSides) {
  Scene scene;
  add_object(scene, "sheet", floor(1));
  scene.materials[0].double_sided = true;
  scene.phong = PhongHighlight{};
  add_light(scene, bulb("below", 10), {0, -1, 0}, {1, 0, 0});
  BakeSettings settings;
  settings.density = 32;
  const Result<BakedScene> baked = bake_light(scene, settings);
  ASSERT_TRUE(baked);
  ASSERT_TRUE(baked->report.pages.at(0).has_back);
  const Renderer live = make_renderer(scene), kept = make_renderer(baked->scene);
  for (const double side : {1.0, -1.0}) {
    const View view = look({0, 3 * side, 0}, {0, 0, 0}, 30, 1, {0, 0, -1});
    const float expected = at(render(live, view, test_settings(9, 9)), "G", 4, 4);
    EXPECT_NEAR(at(render(kept, view, test_settings(9, 9)), "G", 4, 4), expected, 0.01F * expected);
    EXPECT_EQ(expected > 0, side < 0);
  }
}

// Each instance is lit where it stands; an instance that is nearer to the lamp is brighter by the square.
TEST(Bake, InstancesHaveTheirOwnLight) {
  Scene scene;
  add_object(scene, "tile", floor(0.05F));
  scene.nodes[0].node_from_instance = {glm::dmat4(1), glm::dmat4(1)};
  scene.nodes[0].node_from_instance[1][3] = {0, -1, 0, 1};
  scene.nodes[0].casts_shadow = false;
  add_light(scene, bulb("lamp", 10), {0, 1, 0}, {1, 0, 0});
  const Result<BakedScene> baked = bake_light(scene, {});
  ASSERT_TRUE(baked);
  std::vector<float> greatest;
  for (const Node& node : baked->scene.nodes) {
    if (node.mesh < 0) continue;
    const Primitive& p = baked->scene.meshes[static_cast<std::size_t>(node.mesh)].primitives[0];
    const Material& material = baked->scene.materials[static_cast<std::size_t>(p.material)];
    const Image& map =
        *baked->scene.pictures[static_cast<std::size_t>(material.light_map.front.picture)].pixels;
    const glm::vec2 uv = p.uv[1][0] * glm::vec2(map.width(), map.height());
    greatest.push_back(map.value(static_cast<int>(uv.x), static_cast<int>(uv.y), 0));
  }
  ASSERT_EQ(greatest.size(), 2U);
  EXPECT_NEAR(greatest[0], 10, 0.1);
  EXPECT_NEAR(greatest[1], 2.5, 0.05);
}

TEST(Bake, SecondTextureCoordinatesThatServeAreKept) {
  Scene scene;
  add_object(scene, "floor", floor(1));
  Primitive& p = scene.meshes[0].primitives[0];
  for (const glm::vec3& at : p.positions) p.uv[1].emplace_back(at.x / 4 + 0.5F, at.z / 4 + 0.5F);
  add_light(scene, bulb("lamp", 10), {0, 1, 0}, {1, 0, 0});
  BakeSettings settings;
  settings.density = 10;
  const Result<BakedScene> kept = bake_light(scene, settings);
  ASSERT_TRUE(kept);
  EXPECT_TRUE(kept->scene.warnings.empty());
  // Half the square is covered, in each direction: 40 luxels and the two that are read beyond.
  EXPECT_EQ(kept->report.pages.at(0).width, 42);
  for (glm::vec2& uv : p.uv[1]) uv *= 2;
  const Result<BakedScene> anew = bake_light(scene, settings);
  ASSERT_TRUE(anew);
  EXPECT_EQ(anew->report.pages.at(0).width, 21);
  ASSERT_EQ(anew->scene.warnings.size(), 1U);
}

TEST(Bake, GoesOnWhereItWasStopped) {
  const TemporaryFolder folder;
  Scene scene;
  add_object(scene, "floor", floor(10));
  add_light(scene, bulb("lamp", 10), {0, 1, 0}, {1, 0, 0});
  BakeSettings settings;
  settings.density = 32;
  settings.samples = 1;
  settings.options.threads = 1;
  const Result<BakedScene> whole = bake_light(scene, settings);
  ASSERT_TRUE(whole);
  ASSERT_EQ(whole->report.parts, 3U);
  settings.work_file = folder.path() / "floor.glb";
  settings.resume = true;
  const Result<BakedScene> stopped = bake_light(scene, settings, [](double done) { return done < 0.8; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().failure, Failure::cancelled);
  EXPECT_NE(to_string(stopped.error()).find("2 finished parts lie beside"), std::string::npos);
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "floor.glb.bake-0-1"));
  ASSERT_FALSE(std::filesystem::exists(folder.path() / "floor.glb.bake-0-2"));
  std::filesystem::resize_file(folder.path() / "floor.glb.bake-0-1", 1000);
  const Result<BakedScene> resumed = bake_light(scene, settings);
  ASSERT_TRUE(resumed);
  EXPECT_EQ(resumed->report.resumed_parts, 1U);
  EXPECT_EQ(numbers_of(*resumed), numbers_of(*whole));
  // Parts stay until what was baked is written. What only looks like one is not touched.
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "floor.glb.bake-0-2"));
  std::ofstream(folder.path() / "floor.glb.bake-9-9") << "somebody's notes";
  std::ofstream(folder.path() / "floor.glb.bake-9-8") << "";
  std::ofstream(folder.path() / ".floor.glb.bake-mine.part") << "";
  // Ours, of a run that was killed.
  std::filesystem::copy_file(folder.path() / "floor.glb.bake-0-2",
                             folder.path() / ".floor.glb.bake-0-9.1a2b.part");
  std::filesystem::copy_file(folder.path() / "floor.glb.bake-0-2", folder.path() / "floor.glb.bake-7-1");
  std::filesystem::copy_file(folder.path() / "floor.glb.bake-0-2", folder.path() / "other.glb.bake-0-2");
  remove_bake_parts(settings.work_file);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "floor.glb.bake-0-2"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "floor.glb.bake-7-1"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "floor.glb.bake-9-9"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "floor.glb.bake-9-8"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / ".floor.glb.bake-0-9.1a2b.part"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / ".floor.glb.bake-mine.part"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "other.glb.bake-0-2"));
}

// What patches see is kept, and the light of each luxel.
TEST(Bake, ReflectedLightGoesOnWhereItWasStopped) {
  const TemporaryFolder folder;
  BakeSettings settings;
  settings.density = 40;
  settings.samples = 1;
  settings.interreflection = RadiositySettings{.rays = 16, .bounces = 3};
  settings.options.threads = 1;
  std::size_t calls_of_whole = 0;
  const Result<BakedScene> whole =
      bake_light(lit_shapes(), settings, [&](double) { return ++calls_of_whole > 0; });
  ASSERT_TRUE(whole);
  ASSERT_GT(whole->report.lit_luxels, 32768U);  // more than there are patches: the last bounce goes to luxels
  settings.work_file = folder.path() / "shapes.glb";
  settings.resume = true;
  ASSERT_FALSE(bake_light(lit_shapes(), settings, [](double done) { return done < 0.97; }));
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "shapes.glb.bake-seen-0"));
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "shapes.glb.bake-lit-0"));
  std::filesystem::resize_file(folder.path() / "shapes.glb.bake-seen-1", 5000);
  std::size_t calls = 0;
  const Result<BakedScene> resumed = bake_light(lit_shapes(), settings, [&](double) { return ++calls > 0; });
  ASSERT_TRUE(resumed);
  EXPECT_EQ(numbers_of(*resumed), numbers_of(*whole));
  EXPECT_LT(4 * calls, 3 * calls_of_whole);
  EXPECT_EQ(resumed->report.parts, whole->report.parts);
  EXPECT_EQ(whole->report.resumed_parts, 0U);
  EXPECT_GE(resumed->report.resumed_parts, resumed->report.parts / 2);
  EXPECT_LT(resumed->report.resumed_parts, resumed->report.parts);
}

// Layers of a rig are in no glTF file, and change what surfaces reflect.
TEST(Bake, ReflectedLightOfOtherLayersIsNotTakenUp) {
  const TemporaryFolder folder;
  BakeSettings settings;
  settings.density = 40;
  settings.samples = 1;
  settings.interreflection = RadiositySettings{.rays = 16, .bounces = 3};
  const Result<BakedScene> plain = bake_light(lit_shapes(), settings);
  ASSERT_TRUE(plain);
  Scene black = lit_shapes();
  SurfaceLayer layer;
  layer.color = glm::vec3(0);
  for (Material& material : black.materials) material.layers.push_back(layer);
  settings.work_file = folder.path() / "shapes.glb";
  settings.resume = true;
  ASSERT_FALSE(bake_light(black, settings, [](double done) { return done < 0.97; }));
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "shapes.glb.bake-lit-0"));
  const Result<BakedScene> resumed = bake_light(lit_shapes(), settings);
  ASSERT_TRUE(resumed);
  EXPECT_GT(resumed->report.resumed_parts, 0U);  // direct light is the same
  EXPECT_EQ(numbers_of(*resumed), numbers_of(*plain));
}

TEST(Bake, SceneSmallerThanItsLuxelsIsTold) {
  const auto notes_at = [](double density) {
    Scene scene;
    Mesher mesher;
    for (int i = 0; i < 100; ++i) {
      const int row = i / 10;
      const float x = 0.03F * static_cast<float>(i % 10), z = 0.03F * static_cast<float>(row);
      mesher.triangle({x, 0, z}, {x, 0, z + 0.003F}, {x + 0.02F, 0, z});
    }
    add_object(scene, "splinters", mesher.primitive);
    add_light(scene, bulb("lamp", 10), {0, 1, 0}, {1, 0, 0});
    BakeSettings settings;
    settings.density = density;
    std::string notes;
    const BakedScene baked = bake_light(scene, settings).value();
    for (const Diagnostic& note : baked.scene.warnings) notes += note.message;
    return notes;
  };
  EXPECT_NE(notes_at(4).find("the scene is 0.398 m across, and luxels 0.25 m: about 2600 in a metre "),
            std::string::npos)
      << notes_at(4);
  EXPECT_EQ(notes_at(400).find("across"), std::string::npos);
}

// All luxels that hold light are counted, once. A triangle that is thinner than rounding says nothing of the density.
TEST(Bake, CountsWhatItHasDone) {
  Scene scene;
  Mesher mesher;
  mesher.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
  mesher.triangle({2, 0, 1}, {3, 0, 1}, {2.5F, 0, 1 - 1e-6F});
  add_object(scene, "floor", mesher.primitive);
  add_light(scene, bulb("lamp", 10), {0, 1, 0}, {1, 0, 0});
  BakeSettings settings;
  settings.padding = 3;
  const Result<BakedScene> baked = bake_light(scene, settings);
  ASSERT_TRUE(baked);
  EXPECT_EQ(baked->report.thin_triangles, 1U);
  EXPECT_NEAR(baked->report.least_density, 16, 0.6);
  EXPECT_NEAR(baked->report.greatest_density, 16, 1);
  std::size_t lit = 0;
  for (const Picture& picture : baked->scene.pictures) {
    const std::span<const float> rgb = picture.pixels->values<float>();
    for (std::size_t i = 0; i < rgb.size(); i += 3) lit += rgb[i] > 0 ? 1 : 0;
  }
  EXPECT_EQ(lit, baked->report.lit_luxels + baked->report.padding_luxels);
  EXPECT_GE(baked->report.lit_luxels, 33U * 33U);
  EXPECT_GT(baked->report.padding_luxels, 100U);
}

// A disk that cannot be written costs no light: it is told.
TEST(Bake, PartsThatCannotBeKeptAreTold) {
  Scene scene;
  add_object(scene, "floor", floor(1));
  add_light(scene, bulb("lamp", 10), {0, 1, 0}, {1, 0, 0});
  BakeSettings settings;
  settings.work_file = "/nowhere/floor.glb";
  const Result<BakedScene> baked = bake_light(scene, settings);
  ASSERT_TRUE(baked);
  ASSERT_EQ(baked->scene.warnings.size(), 1U);
  EXPECT_NE(to_string(baked->scene.warnings[0]).find("were not kept"), std::string::npos);
}

// The lights that the first maps hold are gone from the scene.
TEST(Bake, IsNotDoneTwice) {
  const Result<BakedScene> once = bake_light(lit_shapes(), {});
  ASSERT_TRUE(once);
  const Result<BakedScene> twice = bake_light(once->scene, {});
  ASSERT_FALSE(twice);
  EXPECT_NE(to_string(twice.error()).find("has a light map already"), std::string::npos);
}

TEST(Bake, RefusesWhatMakesNoSense) {
  const auto message = [](const Scene& scene, const BakeSettings& settings) {
    const Result<BakedScene> baked = bake_light(scene, settings);
    return baked ? std::string("baked") : to_string(baked.error().diagnostics.at(0));
  };
  BakeSettings settings;
  settings.density = 0;
  EXPECT_EQ(message(lit_shapes(), settings), "density: expected 0.001 to 100000 luxels per metre, got 0");
  settings = {};
  settings.padding = 0;
  EXPECT_EQ(message(lit_shapes(), settings), "padding: expected 1 to 64, got 0");
  settings = {};
  settings.lights = {"moon"};
  EXPECT_EQ(message(lit_shapes(), settings), "the scene has no light \"moon\"");
  settings = {};
  settings.max_size = 16;
  Scene tiles;
  Mesher mesher;
  for (int i = 0; i < 5000; ++i) {
    const auto y = static_cast<float>(i);
    mesher.triangle({0, y, 0}, {0, y, 0.9F}, {0.9F, y, 0});
  }
  add_object(tiles, "splinters", mesher.primitive);
  EXPECT_EQ(
      message(tiles, settings),
      "max_size: the light maps would be more than 4096 of 16 luxels a side: ask for larger ones, or for a "
      "lower density");
  settings.max_size = 64;
  EXPECT_EQ(message(lit_shapes(), settings),
            "object \"floor\": a triangle of 5.65685 m takes more than a light map of 64 luxels: at most "
            "11.1369 luxels per "
            "metre fit, asked for were 16");
}

// As with any texture (the surface is drawn, and it is said): all of it takes one luxel.
TEST(LightMapFiles, MeshesWithoutTheCoordinatesAreTold) {
  const TemporaryFolder folder;
  Scene scene = lit_shapes();
  scene.materials[1].light_map.front.picture =
      add_picture(scene, 2, 2, [](int x, int y) { return glm::u8vec3(x + y == 0 ? 255 : 0); });
  scene.materials[1].light_map.front.uv_set = 1;
  Primitive& floor = scene.meshes[1].primitives[0];
  floor.uv[1] = floor.uv[0];
  ASSERT_TRUE(write_scene(scene, folder.path() / "map.gltf"));
  std::ifstream in(folder.path() / "map.gltf");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::string word = "\"TEXCOORD_1\"";
  ASSERT_NE(text.find(word), std::string::npos);
  text.replace(text.find(word), word.size(), "\"_UNUSED\"");
  std::ofstream(folder.path() / "map.gltf") << text;
  const Result<Scene> read = load_scene({folder.path() / "map.gltf"});
  ASSERT_TRUE(read);
  ASSERT_EQ(read->warnings.size(), 1U);
  EXPECT_NE(to_string(read->warnings[0])
                .find("material \"floor\" uses texture coordinates 1, which the mesh does not have"),
            std::string::npos)
      << to_string(read->warnings[0]);
}

TEST(LightMapFiles, FaultsAreNamedWithTheirPlaces) {
  const struct {
    const char* extension;
    const char* message;
  } kCases[] = {
      {R"({})", "materials[0].extensions.LATERNA_light_map.front: is missing"},
      {R"({"front": 3})", "materials[0].extensions.LATERNA_light_map.front: expected an object"},
      {R"({"front": {"index": 9}})", "materials[0].extensions.LATERNA_light_map.front.index"},
      {R"({"front": {"uri": "data:,"}, "texCoord": 2})",
       "materials[0].extensions.LATERNA_light_map.texCoord"},
      {R"({"front": {"uri": "data:,"}, "intensity": -1})",
       "materials[0].extensions.LATERNA_light_map.intensity"},
  };
  const TemporaryFolder folder;
  for (const auto& [extension, message] : kCases) {
    const std::filesystem::path file = folder.path() / "map.gltf";
    std::ofstream(file)
        << R"({"asset": {"version": "2.0"}, "materials": [{"extensions": {"LATERNA_light_map": )" << extension
        << R"(}}], "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}], "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})";
    const Result<Scene> read = load_scene({file});
    ASSERT_FALSE(read) << extension;
    std::string all;
    for (const Diagnostic& d : read.error().diagnostics) all += to_string(d) + "\n";
    EXPECT_NE(all.find(message), std::string::npos) << all;
  }
}

}  // namespace
}  // namespace laterna
