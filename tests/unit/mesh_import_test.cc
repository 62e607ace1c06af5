// OBJ, PLY, STL and MD2, read through Assimp.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"
#include "scene/normals.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

std::size_t triangles_in(const Scene& scene) {
  std::size_t count = 0;
  for (const Mesh& mesh : scene.meshes) {
    for (const Primitive& primitive : mesh.primitives) count += triangle_count(primitive);
  }
  return count;
}

// World-space corners of the first triangle.
std::vector<glm::dvec3> first_triangle(const Scene& scene) {
  const std::vector<glm::dmat4> world = world_from_nodes(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].mesh < 0) continue;
    const Primitive& primitive = scene.meshes[static_cast<std::size_t>(scene.nodes[i].mesh)].primitives[0];
    const Corners at = corners_of(primitive, 0);
    std::vector<glm::dvec3> corners;
    for (const std::size_t v : {at.a, at.b, at.c})
      corners.emplace_back(world[i] * glm::dvec4(glm::dvec3(primitive.positions[v]), 1));
    return corners;
  }
  return {};
}

TEST(MeshImport, ObjPolygonsBecomeTriangles) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail(
      {folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 1.5 0\nf 1 2 3 4\nf 4 3 5\n")});
  EXPECT_EQ(triangles_in(scene), 3U);
  const Primitive& primitive = only_primitive(scene);
  EXPECT_EQ(primitive.positions.size(), 5U);  // corners joined
  for (const glm::vec3& n : primitive.normals) EXPECT_LT(glm::distance(n, glm::vec3(0, 0, 1)), 1e-6F);
}

TEST(MeshImport, ObjNormalsAreKeptAndCreasesMadeWhereMissing) {
  const TemporaryFolder folder;
  const std::string roof = "v 0 0 0\nv 0 1 0\nv -1 0 -1\nv 1 0 -1\n";
  const Scene sharp = load_or_fail({folder.write("a.obj", roof + "f 1 2 3\nf 1 4 2\n")});
  EXPECT_EQ(only_primitive(sharp).positions.size(), 6U);  // 90° between the halves
  const Scene given =
      load_or_fail({folder.write("b.obj", roof + "vn 0 0 2\nf 1//1 2//1 3//1\nf 1//1 4//1 2//1\n")});
  EXPECT_EQ(only_primitive(given).positions.size(), 4U);
  EXPECT_EQ(only_primitive(given).normals[0], glm::vec3(0, 0, 1));
}

TEST(MeshImport, ObjTextureCoordinatesCountFromTheTop) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail(
      {folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0.25\nvt 0 1\nf 1/1 2/2 3/3\n")});
  EXPECT_EQ(only_primitive(scene).uv[0], (std::vector<glm::vec2>{{0, 1}, {1, 0.75F}, {0, 0}}));
}

constexpr const char* kTexturedObj =
    "mtllib my.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3\n";

TEST(MeshImport, MtlColoursAreSrgb) {
  const TemporaryFolder folder;
  folder.write("my.mtl", "newmtl paint\nKd 0.5 1 0\nKs 1 1 1\nNs 98\nd 0.25\nKe 0.5 0 0\n");
  const Scene scene = load_or_fail({folder.write("a.obj", kTexturedObj)});
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.name, "paint");
  EXPECT_NEAR(material.base_color.r, linear_from_srgb(0.5), 1e-6);
  EXPECT_EQ(material.base_color.g, 1);
  EXPECT_EQ(material.base_color.b, 0);
  EXPECT_EQ(material.base_color.a, 0.25F);
  EXPECT_EQ(material.alpha_mode, AlphaMode::blend);
  EXPECT_NEAR(material.emissive.r, linear_from_srgb(0.5), 1e-6);
  EXPECT_EQ(material.metallic, 0);
  EXPECT_NEAR(material.roughness, std::sqrt(std::sqrt(2.0 / 100)), 1e-6);
}

TEST(MeshImport, WithoutHighlightSurfacesAreRough) {
  const TemporaryFolder folder;
  folder.write("my.mtl", "newmtl paint\nKd 1 1 1\nKs 0 0 0\nNs 98\n");
  EXPECT_EQ(load_or_fail({folder.write("a.obj", kTexturedObj)}).materials.at(0).roughness, 1);
}

TEST(MeshImport, MtlTexturesAreFoundBesideTheModel) {
  const TemporaryFolder folder;
  folder.write("my wood.png", "x");
  const auto obj = folder.write("a.obj", kTexturedObj);
  for (const std::string name : {"my wood.png", "./my wood.png", "textures\\my wood.png",
                                 "C:\\work\\my wood.png", "/home/me/my wood.png"}) {
    folder.write("my.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd " + name + "\n");
    const Scene scene = load_or_fail({obj});
    ASSERT_EQ(scene.pictures.size(), 1U) << name;
    EXPECT_EQ(scene.pictures[0].file.filename(), "my wood.png") << name;
    EXPECT_EQ(scene.materials[0].base_color_texture.picture, 0);
  }
}

TEST(MeshImport, AMissingTextureIsAnErrorThatNamesTheMaterial) {
  const TemporaryFolder folder;
  folder.write("my.mtl", "newmtl paint\nmap_Kd textures/lost.png\n");
  const Result<Scene> scene = load_scene({folder.write("a.obj", kTexturedObj)});
  EXPECT_EQ(
      messages_of(scene, folder.path()),
      "a.obj: material \"paint\": texture \"textures/lost.png\" not found (tried \"textures/lost.png\")");
}

TEST(MeshImport, ABlackColourUnderATextureIsTakenAsWhite) {
  const TemporaryFolder folder;
  folder.write("wood.png", "x");
  folder.write("my.mtl", "newmtl paint\nKd 0 0 0\nmap_Kd wood.png\n");
  const Scene scene = load_or_fail({folder.write("a.obj", kTexturedObj)});
  EXPECT_EQ(scene.materials[0].base_color, glm::vec4(1));
  EXPECT_EQ(warnings_of(scene), "material \"paint\": its colour is black under a texture: taken as white\n");
}

TEST(MeshImport, OpacityMaps) {
  const TemporaryFolder folder;
  folder.write("leaf.png", "x");
  folder.write("holes.png", "x");
  folder.write("my.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd leaf.png\nmap_d leaf.png\n");
  EXPECT_EQ(load_or_fail({folder.write("a.obj", kTexturedObj)}).materials[0].alpha_mode, AlphaMode::mask);
  folder.write("my.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd leaf.png\nmap_d holes.png\n");
  const Scene scene = load_or_fail({folder.write("a.obj", kTexturedObj)});
  EXPECT_EQ(scene.materials[0].alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(warnings_of(scene),
            "material \"paint\": the opacity map \"holes.png\" is not the colour map: left out\n");
}

TEST(MeshImport, AMissingMaterialLibraryIsAWarning) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail({folder.write("a.obj", kTexturedObj)});
  EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(1));
  EXPECT_EQ(warnings_of(scene), "material library not found (tried \"" + (folder.path() / "my.mtl").string() +
                                    "\"): its surfaces are white\n");
}

TEST(MeshImport, UpAndUnitOfFormatsThatDoNotSay) {
  const TemporaryFolder folder;
  const auto obj = folder.write("a.obj", "v 100 0 0\nv 0 200 0\nv 0 0 300\nf 1 2 3\n");
  EXPECT_EQ(first_triangle(load_or_fail({obj})),
            (std::vector<glm::dvec3>{{100, 0, 0}, {0, 200, 0}, {0, 0, 300}}));
  const Scene z_up = load_or_fail({obj}, {.up = LoadOptions::Up::z, .metres_per_unit = 0.01, .rigs = {}});
  EXPECT_EQ(first_triangle(z_up), (std::vector<glm::dvec3>{{1, 0, 0}, {0, 0, -2}, {0, 3, 0}}));
}

TEST(MeshImport, PlyWithColours) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail({folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar "
      "int vertex_indices\n"
      "end_header\n0 0 0 255 0 0\n1 0 0 0 128 0\n0 1 0 0 0 255\n3 0 1 2\n")});
  const Primitive& primitive = only_primitive(scene);
  ASSERT_EQ(primitive.colors.size(), 3U);
  EXPECT_EQ(primitive.colors[0], glm::vec4(1, 0, 0, 1));
  EXPECT_NEAR(primitive.colors[1].g, linear_from_srgb(128 / 255.0), 1e-6);
  EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(1));
}

TEST(MeshImport, BinaryAndAsciiStl) {
  const TemporaryFolder folder;
  const std::string ascii =
      "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid t\n";
  std::string binary(80, ' ');
  binary += std::string("\1\0\0\0", 4);
  for (const float f : {0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F}) {
    binary.append(reinterpret_cast<const char*>(&f), 4);
  }
  binary += std::string(2, '\0');
  for (const std::string& content : {ascii, binary}) {
    const Scene scene = load_or_fail({folder.write("a.stl", content)});
    EXPECT_EQ(first_triangle(scene), (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(only_primitive(scene).normals[0], glm::vec3(0, 0, 1));
  }
}

TEST(MeshImport, PointCloudsAreRefused) {
  const TemporaryFolder folder;
  const Result<Scene> scene =
      load_scene({folder.write("a.ply",
                               "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float "
                               "y\nproperty float z\nend_header\n0 0 0\n1 0 0\n")});
  EXPECT_EQ(messages_of(scene, folder.path()), "a.ply: holds no triangles, only 2 points and lines");
}

// One triangle in two frames, as Quake II's tools wrote it.
std::string make_md2(const std::string& skin) {
  std::string file;
  const auto put32 = [&file](int value) { file.append(reinterpret_cast<const char*>(&value), 4); };
  const auto put16 = [&file](int value) {
    file += {static_cast<char>(value & 0xFF), static_cast<char>(value >> 8)};
  };
  const auto put_float = [&file](float value) { file.append(reinterpret_cast<const char*>(&value), 4); };
  const int skins = skin.empty() ? 0 : 1, frame_size = 40 + 3 * 4, header = 68;
  const int skin_at = header, coordinates_at = skin_at + skins * 64, triangles_at = coordinates_at + 3 * 4;
  const int frames_at = triangles_at + 12, commands_at = frames_at + 2 * frame_size, end = commands_at + 4;
  for (const int value : {844121161, 8, 64, 32, frame_size, skins, 3, 3, 1, 1, 2, skin_at, coordinates_at,
                          triangles_at, frames_at, commands_at, end})
    put32(value);
  if (skins > 0) {
    file += skin;
    file.resize(static_cast<std::size_t>(coordinates_at), '\0');
  }
  for (const int value : {0, 0, 64, 0, 0, 32}) put16(value);
  for (const int value : {0, 1, 2, 0, 1, 2}) put16(value);
  for (const float z : {0.0F, 5.0F}) {  // both frames, the second raised
    for (const float value : {0.5F, 0.5F, 0.5F, 10.0F, 20.0F, 30.0F + z}) put_float(value);
    std::string name = z == 0 ? "stand01" : "stand02";
    name.resize(16, '\0');
    file += name;
    file += {0, 0, 0, 5, 0, 2, 0, 5, 2, 0, 0, 5};  // clockwise seen from outside, Quake's way
  }
  put32(0);
  return file;
}

TEST(MeshImport, Md2IsReadInItsFirstFrame) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail({folder.write("ogro.md2", make_md2(""))});
  EXPECT_EQ(triangles_in(scene), 1U);
  for (const glm::dvec3& corner : first_triangle(scene)) {
    EXPECT_EQ(corner.y, 30);  // Quake's z is up
    EXPECT_TRUE(corner.x == 10 || corner.x == 11);
    EXPECT_TRUE(corner.z == -20 || corner.z == -21);
  }
  EXPECT_FALSE(scene.materials.at(0).base_color_texture.is_set());
  EXPECT_EQ(warnings_of(scene), "");
}

TEST(MeshImport, Md2SkinsAreLookedForBesideTheModel) {
  const auto skin_of = [](const std::string& named, const std::string& present) {
    const TemporaryFolder folder;
    folder.write(present, "x");
    const Scene scene = load_or_fail({folder.write("ogro.md2", make_md2(named))});
    return scene.pictures.empty() ? warnings_of(scene) : scene.pictures[0].file.filename().string();
  };
  EXPECT_EQ(skin_of("players/ogro/arboshak.pcx", "arboshak.png"), "arboshak.png");
  EXPECT_EQ(skin_of("players/ogro/arboshak.bmp", "arboshak.bmp"), "arboshak.bmp");
  EXPECT_EQ(skin_of("players/ogro/arboshak.bmp", "players/ogro/arboshak.bmp"), "arboshak.bmp");
  EXPECT_EQ(skin_of("players/ogro/arboshak.pcx", "ogro.jpg"), "ogro.jpg");
  EXPECT_EQ(skin_of("", "ogro.tga"), "ogro.tga");
  EXPECT_NE(skin_of("lost.pcx", "other.png").find("texture \"lost.pcx\" not found"), std::string::npos);
}

}  // namespace
}  // namespace laterna
