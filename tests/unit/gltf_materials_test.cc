// Materials, textures, samplers and pictures of glTF files.
#include <gtest/gtest.h>

#include <cmath>

#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

// A triangle with both sets of texture coordinates, normals and the given material.
GltfBuilder surface_builder(const json& material) {
  GltfBuilder builder = triangle_builder();
  json& primitive = builder.document["meshes"][0]["primitives"][0];
  primitive["attributes"]["NORMAL"] = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  primitive["attributes"]["TEXCOORD_0"] = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  primitive["attributes"]["TEXCOORD_1"] = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  primitive["material"] = 0;
  builder.document["materials"] = json::array({material});
  return builder;
}

Material load_material(const TemporaryFolder& folder, const json& material) {
  Scene scene = surface_builder(material).load(folder);
  EXPECT_EQ(scene.materials.size(), 1U);
  return scene.materials.empty() ? Material{} : scene.materials[0];
}

TEST(GltfMaterials, DefaultsAreTheStandards) {
  const TemporaryFolder folder;
  const Material material = load_material(folder, json::object());
  EXPECT_EQ(material.base_color, glm::vec4(1));
  EXPECT_EQ(material.metallic, 1);
  EXPECT_EQ(material.roughness, 1);
  EXPECT_EQ(material.emissive, glm::vec3(0));
  EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(material.alpha_cutoff, 0.5F);
  EXPECT_FALSE(material.double_sided);
  EXPECT_FALSE(material.unlit);
  EXPECT_FALSE(material.base_color_texture.is_set());
}

TEST(GltfMaterials, EveryFactor) {
  const TemporaryFolder folder;
  const Material material = load_material(
      folder,
      {{"name", "all"},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}}},
       {"emissiveFactor", {0.5, 0.25, 1}},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.125},
       {"doubleSided", true},
       {"extensions",
        {{"KHR_materials_unlit", json::object()},
         {"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}});
  EXPECT_EQ(material.name, "all");
  EXPECT_EQ(material.base_color, glm::vec4(0.1, 0.2, 0.3, 0.4));
  EXPECT_EQ(material.metallic, 0.25F);
  EXPECT_EQ(material.roughness, 0.75F);
  EXPECT_EQ(material.emissive, glm::vec3(4, 2, 8));
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.125F);
  EXPECT_TRUE(material.double_sided);
  EXPECT_TRUE(material.unlit);
  EXPECT_EQ(load_material(folder, {{"alphaMode", "BLEND"}}).alpha_mode, AlphaMode::blend);
}

TEST(GltfMaterials, FactorsOutOfRangeAreLimitedWithAWarning) {
  const TemporaryFolder folder;
  const Scene scene =
      surface_builder({{"pbrMetallicRoughness", {{"metallicFactor", 1.5}, {"roughnessFactor", -1}}}})
          .load(folder);
  EXPECT_EQ(scene.materials[0].metallic, 1);
  EXPECT_EQ(scene.materials[0].roughness, 0);
  EXPECT_EQ(warnings_of(scene),
            "materials[0].pbrMetallicRoughness.metallicFactor: 1.5 is out of range and taken as 1\n"
            "materials[0].pbrMetallicRoughness.roughnessFactor: -1 is out of range and taken as 0\n");
}

// Five textures of five files.
json textured_material() {
  return {
      {"name", "bricks"},
      {"pbrMetallicRoughness",
       {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}, {"texCoord", 1}}}}},
      {"normalTexture", {{"index", 2}, {"scale", 0.5}}},
      {"occlusionTexture", {{"index", 3}, {"strength", 0.25}}},
      {"emissiveTexture", {{"index", 4}}}};
}

GltfBuilder textured_builder(const TemporaryFolder& folder) {
  GltfBuilder builder = surface_builder(textured_material());
  for (const std::string name : {"color", "metal", "normal", "occlusion", "glow"}) {
    folder.write(name + ".png", name);
    builder.add("textures", {{"source", builder.add("images", {{"uri", name + ".png"}})}});
  }
  return builder;
}

TEST(GltfMaterials, EveryTexture) {
  const TemporaryFolder folder;
  const Scene scene = textured_builder(folder).load(folder);
  const Material& material = scene.materials.at(0);
  const auto file_of = [&](const Texture& texture) {
    return scene.pictures.at(static_cast<std::size_t>(texture.picture)).file.filename();
  };
  EXPECT_EQ(file_of(material.base_color_texture), "color.png");
  EXPECT_EQ(file_of(material.metallic_roughness_texture), "metal.png");
  EXPECT_EQ(file_of(material.normal_texture), "normal.png");
  EXPECT_EQ(file_of(material.occlusion_texture), "occlusion.png");
  EXPECT_EQ(file_of(material.emissive_texture), "glow.png");
  EXPECT_EQ(material.metallic_roughness_texture.uv_set, 1);
  EXPECT_EQ(material.base_color_texture.uv_set, 0);
  EXPECT_EQ(material.normal_scale, 0.5F);
  EXPECT_EQ(material.occlusion_strength, 0.25F);
  EXPECT_EQ(only_primitive(scene).tangents.size(), 3U);  // a normal map needs them
}

TEST(GltfMaterials, EachFileIsOnePictureHoweverOftenItIsNamed) {
  const TemporaryFolder folder;
  GltfBuilder builder = textured_builder(folder);
  for (json& image : builder.document["images"]) image["uri"] = "color.png";
  builder.document["images"][3]["uri"] = "./sub/../color.png";
  std::filesystem::create_directory(folder.path() / "sub");
  const Scene scene = builder.load(folder);
  EXPECT_EQ(scene.pictures.size(), 1U);
  EXPECT_EQ(scene.materials[0].occlusion_texture.picture, 0);
}

TEST(GltfMaterials, EachBufferViewIsOnePictureHoweverOftenItIsNamed) {
  const TemporaryFolder folder;
  GltfBuilder builder = textured_builder(folder);
  const int view = builder.view({std::byte{1}, std::byte{2}});
  for (json& image : builder.document["images"]) image = {{"bufferView", view}, {"mimeType", "image/png"}};
  const Scene scene = builder.load(folder);
  ASSERT_EQ(scene.pictures.size(), 1U);
  EXPECT_EQ(scene.pictures[0].encoded.size(), 2U);
  EXPECT_EQ(scene.materials[0].occlusion_texture.picture, 0);
}

TEST(GltfMaterials, UnusedMaterialsAndPicturesAreNotLookedFor) {
  const TemporaryFolder folder;
  GltfBuilder builder = surface_builder(json::object());
  builder.add("images", {{"uri", "nowhere.png"}});
  builder.add("textures", {{"source", 0}});
  builder.add("materials", {{"normalTexture", {{"index", 0}}}});
  const Scene scene = builder.load(folder);
  EXPECT_TRUE(scene.pictures.empty());
  EXPECT_EQ(scene.materials.size(), 1U);
}

TEST(GltfMaterials, AMissingPictureNamesItsUserAndWhatWasTried) {
  const TemporaryFolder folder;
  GltfBuilder builder = textured_builder(folder);
  builder.document["images"][0]["uri"] = "lost%20one.png";
  const Result<Scene> scene = load_scene({folder.write("scene.gltf", builder.text())});
  EXPECT_EQ(messages_of(scene, folder.path()),
            "scene.gltf: images[0].uri: \"lost%20one.png\" not found (tried \"lost one.png\"); used by "
            "materials[0].pbrMetallicRoughness.baseColorTexture (\"bricks\")");
}

TEST(GltfMaterials, PicturesInBufferViewsAndDataUris) {
  const TemporaryFolder folder;
  GltfBuilder builder = textured_builder(folder);
  const std::string encoded = "not decoded here";
  const auto* first = reinterpret_cast<const std::byte*>(encoded.data());
  const std::vector<std::byte> bytes(first, first + encoded.size());
  builder.document["images"][0] = {{"bufferView", builder.view(bytes)}, {"mimeType", "image/png"}};
  builder.document["images"][1] = {{"uri", "data:image/png;base64," + base64(bytes)}};
  const Scene scene = load_or_fail({folder.write("scene.glb", builder.glb())});
  for (const std::size_t i : {0U, 1U}) {
    const Picture& picture = scene.pictures.at(i);
    EXPECT_TRUE(picture.file.empty());
    EXPECT_EQ(std::vector<std::byte>(picture.encoded.begin(), picture.encoded.end()), bytes);
    EXPECT_NE(picture.encoded_owner, nullptr);
    EXPECT_EQ(picture.name, (folder.path() / "scene.glb").string() + ": images[" + std::to_string(i) + "]");
  }
}

TEST(GltfMaterials, Samplers) {
  const TemporaryFolder folder;
  GltfBuilder builder = textured_builder(folder);
  builder.document["samplers"] = {
      {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9728}},
      {{"minFilter", 9729}},
      {{"minFilter", 9984}},
      {{"minFilter", 9985}},
      {{"minFilter", 9986}, {"wrapS", 10497}, {"magFilter", 9729}}};
  for (std::size_t i = 0; i < 5; ++i) builder.document["textures"][i]["sampler"] = i;
  const Scene scene = builder.load(folder);
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.base_color_texture.sampler,
            (Sampler{Wrap::clamp, Wrap::mirror, Filter::nearest, Filter::nearest, MipFilter::none}));
  EXPECT_EQ(material.metallic_roughness_texture.sampler,
            (Sampler{Wrap::repeat, Wrap::repeat, Filter::linear, Filter::linear, MipFilter::none}));
  EXPECT_EQ(material.normal_texture.sampler,
            (Sampler{Wrap::repeat, Wrap::repeat, Filter::linear, Filter::nearest, MipFilter::nearest}));
  EXPECT_EQ(material.occlusion_texture.sampler,
            (Sampler{Wrap::repeat, Wrap::repeat, Filter::linear, Filter::linear, MipFilter::nearest}));
  EXPECT_EQ(material.emissive_texture.sampler,
            (Sampler{Wrap::repeat, Wrap::repeat, Filter::linear, Filter::nearest, MipFilter::linear}));
}

TEST(GltfMaterials, TextureTransform) {
  const TemporaryFolder folder;
  GltfBuilder builder = textured_builder(folder);
  builder.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
                  ["KHR_texture_transform"] = {
      {"offset", {0.25, 0.5}}, {"rotation", 1.5707963267948966}, {"scale", {2, 4}}, {"texCoord", 1}};
  builder.document["extensionsRequired"] = {"KHR_texture_transform"};
  const Scene scene = builder.load(folder);
  const Texture& texture = scene.materials.at(0).base_color_texture;
  EXPECT_EQ(texture.uv_set, 1);
  const auto apply = [&](float u, float v) {
    const std::array<float, 6>& m = texture.uv_from_mesh_uv;
    return glm::vec2(m[0] * u + m[1] * v + m[2], m[3] * u + m[4] * v + m[5]);
  };
  // Scaled first, turned counter-clockwise as seen (v points down: (1, 0) goes to (0, −1)), then moved.
  const auto near = [](glm::vec2 a, glm::vec2 b) {
    return std::abs(a.x - b.x) + std::abs(a.y - b.y) < 1e-6F;
  };
  EXPECT_TRUE(near(apply(0, 0), {0.25F, 0.5F}));
  EXPECT_TRUE(near(apply(1, 0), {0.25F, 0.5F - 2}));
  EXPECT_TRUE(near(apply(0, 1), {0.25F + 4, 0.5F}));
  EXPECT_EQ(scene.materials[0].normal_texture.uv_from_mesh_uv, (std::array<float, 6>{1, 0, 0, 0, 1, 0}));
}

TEST(GltfMaterials, ThirdSetOfTextureCoordinatesIsLeftOut) {
  const TemporaryFolder folder;
  GltfBuilder builder = textured_builder(folder);
  builder.document["materials"][0]["emissiveTexture"]["texCoord"] = 2;
  const Scene scene = builder.load(folder);
  EXPECT_FALSE(scene.materials[0].emissive_texture.is_set());
  EXPECT_EQ(warnings_of(scene),
            "materials[0].emissiveTexture: uses TEXCOORD_2, but only two sets are read: left out\n");
}

TEST(GltfMaterials, MissingTextureCoordinatesAreZero) {
  const TemporaryFolder folder;
  GltfBuilder builder = textured_builder(folder);
  builder.document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_1");
  const Scene scene = builder.load(folder);
  EXPECT_EQ(only_primitive(scene).uv[1], std::vector<glm::vec2>(3, glm::vec2(0)));
  EXPECT_EQ(warnings_of(scene),
            "meshes[0].primitives[0]: material \"bricks\" uses texture coordinates 1, which the mesh does "
            "not have: taken as (0, 0)\n");
}

TEST(GltfMaterials, SpecularGlossinessIsApproximated) {
  const TemporaryFolder folder;
  folder.write("wood.png", "x");
  GltfBuilder builder = surface_builder({{"extensions",
                                          {{"KHR_materials_pbrSpecularGlossiness",
                                            {{"diffuseFactor", {0.5, 0.25, 0.125, 1}},
                                             {"glossinessFactor", 0.75},
                                             {"diffuseTexture", {{"index", 0}}}}}}}});
  builder.add("images", {{"uri", "wood.png"}});
  builder.add("textures", {{"source", 0}});
  builder.document["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
  const Scene scene = builder.load(folder);
  const Material& material = scene.materials.at(0);
  EXPECT_EQ(material.base_color, glm::vec4(0.5F, 0.25F, 0.125F, 1));
  EXPECT_EQ(material.metallic, 0);
  EXPECT_EQ(material.roughness, 0.25F);
  EXPECT_TRUE(material.base_color_texture.is_set());
  EXPECT_NE(warnings_of(scene).find("KHR_materials_pbrSpecularGlossiness is not fully supported"),
            std::string::npos);
}

TEST(GltfMaterials, UnknownExtensionsAreSilentUnlessTheyChangeTheLook) {
  const TemporaryFolder folder;
  GltfBuilder builder = surface_builder(json::object());
  builder.document["extensionsUsed"] = {"ACME_harmless", "KHR_materials_dispersion"};
  EXPECT_EQ(
      warnings_of(builder.load(folder)),
      "extensionsUsed[1]: KHR_materials_dispersion is not fully supported: glass has no colour fringes\n");
}

TEST(GltfMaterials, TexturesWithoutAReadableSourceAreLeftOut) {
  const TemporaryFolder folder;
  GltfBuilder builder = surface_builder({{"emissiveTexture", {{"index", 0}}}});
  builder.add("textures", {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
  const Scene scene = builder.load(folder);
  EXPECT_FALSE(scene.materials[0].emissive_texture.is_set());
  EXPECT_EQ(warnings_of(scene),
            "materials[0].emissiveTexture: textures[0] has no PNG or JPEG source: left out\n");
}

}  // namespace
}  // namespace laterna
