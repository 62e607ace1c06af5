// Layers that cannot be, in rigs and in scenes made in code, and exactly what is said about each.
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

struct LayerCase {
  const char* name;
  const char* surface;  // in line 2
  const char* messages;
};

std::string case_name(const testing::TestParamInfo<LayerCase>& info) { return info.param.name; }

class InvalidLayer : public testing::TestWithParam<LayerCase> {};

// One sheet of "paper" with a first set of texture coordinates, under a lantern, a beam and a bulb.
TEST_P(InvalidLayer, IsRefusedWithItsMessage) {
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  builder.add("materials", {{"name", "paper"}});
  builder.add("meshes",
              {{"name", "sheet"},
               {"primitives",
                json::array({{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"material", 0}}})}});
  builder.add("nodes", {{"name", "sheet"}, {"mesh", 0}});
  builder.add("nodes", {{"name", "nothing"}});
  const TemporaryFolder folder;
  folder.write("label.png", "x");
  const std::string rig = std::string("{\"surfaces\": [\n") + GetParam().surface + R"(],
    "lights": [{"name": "lantern", "type": "projector", "position": [0, 0, 5], "target": [0, 0, 0], "yfov_deg": 30},
               {"name": "beam", "type": "projector", "position": [0, 0, 5], "target": [0, 0, 0], "yfov_deg": 30,
                "aspect": 1, "intensity_map": "label.png"},
               {"name": "bulb", "type": "point", "position": [0, 0, 5]}]})";
  const Result<Scene> scene =
      load_scene({folder.write("s.gltf", builder.text())}, {.rigs = {folder.write("r.json", rig)}});
  EXPECT_EQ(messages_of(scene, folder.path()), GetParam().messages);
}

const LayerCase kLayerCases[] = {
    {"NoLayers", R"({"material": "paper"})", "r.json: line 2: surfaces[0].layers: is missing"},
    {"LayersNoList", R"({"layers": {"color": [0, 0, 0]}})",
     "r.json: line 2: surfaces[0].layers: expected an array, got an object"},
    {"LayerNoObject", R"({"layers": ["label.png"]})",
     "r.json: line 2: surfaces[0].layers[0]: expected an object, got \"label.png\""},
    {"UnknownKeyOfSurface", R"({"materials": "paper", "layers": []})",
     "r.json: line 2: surfaces[0].materials: a surface has no key \"materials\" (did you mean "
     "\"material\"?)"},
    {"UnknownKeyOfLayer", R"({"layers": [{"color": [0, 0, 0], "opacty": 1}]})",
     "r.json: line 2: surfaces[0].layers[0].opacty: a layer has no key \"opacty\" (did you mean "
     "\"opacity\"?)"},
    {"MaterialAndNode", R"({"material": "paper", "node": "sheet", "layers": []})",
     "r.json: line 2: surfaces[0].node: give either material or node, not both"},
    {"NoSuchMaterial", R"({"material": "papper", "layers": [{"color": [0, 0, 0]}]})",
     "r.json: line 2: surfaces[0]: the scene has no material named \"papper\" (did you mean \"paper\"?)"},
    {"NoSuchNode", R"({"node": "sheets", "layers": [{"color": [0, 0, 0]}]})",
     "r.json: line 2: surfaces[0]: the scene has no node named \"sheets\" (did you mean \"sheet\"?)"},
    {"NodeWithoutMesh", R"({"node": "nothing", "layers": [{"color": [0, 0, 0]}]})",
     "r.json: line 2: surfaces[0]: node \"nothing\" and all below it have no mesh"},
    {"NothingToShow", R"({"layers": [{"opacity": 0.5}]})",
     "r.json: line 2: surfaces[0].layers[0]: shows nothing: give a texture, the slide of a projector, or a "
     "color"},
    {"TextureAndSlide", R"({"layers": [{"texture": "label.png", "slide": "lantern"}]})",
     "r.json: line 2: surfaces[0].layers[0].slide: give either texture or slide, not both"},
    {"NoSuchTexture", R"({"layers": [{"texture": "lable.png"}]})",
     "r.json: line 2: surfaces[0].layers[0].texture: \"lable.png\" not found (tried \"lable.png\")"},
    {"NoSuchProjector", R"({"layers": [{"slide": "lantren"}]})",
     "r.json: line 2: surfaces[0].layers[0].slide: there is no projector named \"lantren\" (did you mean "
     "\"lantern\"?)"},
    {"SlideOfABulb", R"({"layers": [{"slide": "bulb"}]})",
     "r.json: line 2: surfaces[0].layers[0].slide: light \"bulb\" is no projector: it has no slide"},
    {"SlideOfAnIntensityMap", R"({"layers": [{"slide": "beam"}]})",
     "r.json: line 2: surfaces[0].layers[0].slide: light \"beam\" throws an intensity map, which is no "
     "colour"},
    {"OpacityAboveOne", R"({"layers": [{"color": [0, 0, 0], "opacity": 1.5}]})",
     "r.json: line 2: surfaces[0].layers[0].opacity: expected a number from 0 to 1, got 1.5"},
    {"ColorNegative", R"({"layers": [{"color": [0, -1, 0]}]})",
     "r.json: line 2: surfaces[0].layers[0].color[1]: expected a number from 0 to 1000000000000, got -1"},
    {"UnknownMode", R"({"layers": [{"color": [0, 0, 0], "blend": "substract"}]})",
     "r.json: line 2: surfaces[0].layers[0].blend: expected one of \"over\", \"modulate\", \"add\", "
     "\"alpha_attenuate\", \"subtract\", \"reverse_subtract\", \"difference\", \"screen\", \"min\", \"max\", "
     "\"dot3\", got \"substract\" (did you mean \"subtract\"?)"},
    {"NoSuchSetAtAll", R"({"layers": [{"texture": "label.png", "uv_set": 2}]})",
     "r.json: line 2: surfaces[0].layers[0].uv_set: expected a whole number from 0 to 1, got 2"},
    {"SetThatTheMeshLacks", R"({"layers": [{"texture": "label.png", "uv_set": 1}]})",
     "r.json: line 2: surfaces[0].layers[0].uv_set: mesh \"sheet\" has no texture coordinates of set 1: a "
     "projector's \"slide\" needs none"},
    {"PlacedWithoutTexture", R"({"layers": [{"color": [0, 0, 0], "scale": [2, 2]}]})",
     "r.json: line 2: surfaces[0].layers[0].scale: belongs to a \"texture\", and there is none"},
    {"OccludedWithoutSlide", R"({"layers": [{"color": [0, 0, 0], "occluded": false}]})",
     "r.json: line 2: surfaces[0].layers[0].occluded: belongs to a \"slide\", and there is none"},
};
INSTANTIATE_TEST_SUITE_P(Rig, InvalidLayer, testing::ValuesIn(kLayerCases), case_name);

TEST(InvalidLayers, TooManyOnOneSurface) {
  std::string layers = R"({"color": [0, 0, 0]})";
  for (int i = 0; i < 64; ++i) layers += R"(, {"color": [0, 0, 0]})";
  const TemporaryFolder folder;
  const Result<Scene> scene =
      load_scene({folder.write("s.gltf", triangle_builder().text())},
                 {.rigs = {folder.write("r.json", R"({"surfaces": [{"layers": [)" + layers + "]}]}")}});
  EXPECT_EQ(messages_of(scene, folder.path()),
            "r.json: line 1: surfaces[0]: material \"\" comes to 65 layers, more than 64");
}

TEST(InvalidLayers, ProjectorsThatCannotBlend) {
  const auto messages = [](const char* keys) {
    const TemporaryFolder folder;
    return messages_of(
        load_scene(
            {}, {.rigs = {folder.write(
                     "r.json", std::string(R"({"lights": [{"position": [0, 0, 5], "target": [0, 0, 0], )") +
                                   keys + "}]}")}}),
        folder.path());
  };
  EXPECT_EQ(messages(R"("type": "spot", "blend": "modulate")"),
            "r.json: line 1: lights[0].blend: a spot light has no key \"blend\"");
  EXPECT_EQ(messages(R"("type": "projector", "yfov_deg": 30, "blend": "over")"),
            "r.json: line 1: lights[0].blend: light has no alpha: only layers of surfaces have this mode");
}

// Made in code: what a rig cannot say wrongly.
TEST(InvalidLayers, InScenesMadeInCode) {
  Scene scene;
  scene.materials.resize(1);
  scene.lights.resize(2);
  scene.lights[0].name = "bulb";
  scene.lights[0].blend = BlendMode::min;
  scene.lights[1].name = "nowhere";
  scene.lights[1].type = LightType::projector;
  scene.lights[1].blend = static_cast<BlendMode>(40);
  std::vector<SurfaceLayer>& layers = scene.materials[0].layers;
  layers.resize(5);
  layers[0].projector = 7;
  layers[1].projector = 0;
  layers[2].projector = 1;
  layers[3].opacity = std::nanf("");
  layers[4].color.y = -1;
  layers[4].blend = static_cast<BlendMode>(11);
  scene.nodes.resize(1);
  scene.nodes[0].light = 0;
  std::string messages;
  for (const Diagnostic& fault : validate(scene)) messages += fault.place + ": " + fault.message + "\n";
  EXPECT_EQ(messages,
            "materials[0].layers[0].projector: 7 is no index into the 2 lights, nor -1 for none\n"
            "materials[0].layers[1].projector: light \"bulb\" is no projector\n"
            "materials[0].layers[2].projector: light \"nowhere\" stands at no node\n"
            "materials[0].layers[3].opacity: expected a number from 0 to 1, got nan\n"
            "materials[0].layers[4].color[1]: expected a number from 0 to 1000000000000, got -1\n"
            "materials[0].layers[4].blend: 11 is no value of the enumeration, which ends at 10\n"
            "lights[0].blend: only a projector combines with light in another way than add\n"
            "lights[1].blend: 40 is no value of the enumeration, which ends at 10\n"
            "lights[1].blend: there is no such mode\n");
}

}  // namespace
}  // namespace laterna
