// Bad scenes built in code, and exactly what is said about each.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

#include "laterna/lamps.h"
#include "laterna/scene.h"

namespace laterna {
namespace {

std::shared_ptr<const LightDistribution> lamp(std::vector<double> vertical_deg,
                                              std::vector<double> horizontal_deg,
                                              std::vector<double> candela) {
  LightDistribution distribution;
  distribution.vertical_deg = std::move(vertical_deg);
  distribution.horizontal_deg = std::move(horizontal_deg);
  distribution.candela = std::move(candela);
  return std::make_shared<const LightDistribution>(std::move(distribution));
}

struct SceneCase {
  const char* name;
  void (*break_it)(Scene&);
  const char* messages;
};

Scene sound_scene() {
  Scene scene;
  Primitive primitive;
  primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  primitive.normals.assign(4, {0, 0, 1});
  primitive.uv[0].assign(4, {0, 0});
  primitive.indices = {0, 1, 2, 1, 3, 2};
  primitive.material = 0;
  scene.meshes = {{"square", {primitive}}};
  scene.pictures.resize(1);
  scene.pictures[0].file = "wood.png";
  scene.materials.resize(1);
  scene.materials[0].base_color_texture.picture = 0;
  scene.cameras.resize(1);
  scene.cameras[0].name = "main";
  scene.lights.resize(2);
  scene.lights[0].name = "bulb";
  scene.lights[1].name = "lantern";
  scene.lights[1].type = LightType::projector;
  scene.lights[1].slide = 0;
  scene.nodes.resize(4);
  scene.nodes[0].mesh = 0;
  scene.nodes[1].camera = 0;
  scene.nodes[2].light = 0;
  scene.nodes[3].light = 1;
  return scene;
}

std::string case_name(const testing::TestParamInfo<SceneCase>& info) { return info.param.name; }

class InvalidBuiltScene : public testing::TestWithParam<SceneCase> {};

TEST_P(InvalidBuiltScene, IsRefusedWithItsMessage) {
  Scene scene = sound_scene();
  GetParam().break_it(scene);
  std::string messages;
  for (const Diagnostic& fault : validate(scene))
    messages += (messages.empty() ? "" : "\n") + to_string(fault);
  EXPECT_EQ(messages, GetParam().messages);
}

TEST(InvalidScene, TheSoundSceneIsSound) { EXPECT_TRUE(validate(sound_scene()).empty()); }

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();

Primitive& primitive_of(Scene& scene) { return scene.meshes[0].primitives[0]; }

Photograph photograph(int picture) {
  Photograph photograph;
  photograph.name = "photo";
  photograph.picture = picture;
  photograph.projection = Projection::perspective(Angle::degrees(40), 1, 0.1, 10);
  return photograph;
}

const SceneCase kSceneCases[] = {
    {"PictureWithoutSource", [](Scene& s) { s.pictures[0].file.clear(); },
     "pictures[0]: expected exactly one of file, encoded and pixels, got 0"},
    {"PictureWithTwoSources", [](Scene& s) { s.pictures[0].encoded = std::as_bytes(std::span("x")); },
     "pictures[0]: expected exactly one of file, encoded and pixels, got 2"},
    {"TexturePicture",
     [](Scene& s) {
       s.materials[0].normal_texture.picture = 1;
       primitive_of(s).tangents.assign(4, {1, 0, 0, 1});
     },
     "materials[0].normal_texture.picture: 1 is no index into the 1 pictures, nor -1 for none"},
    {"TextureSet", [](Scene& s) { s.materials[0].base_color_texture.uv_set = 2; },
     "materials[0].base_color_texture.uv_set: expected 0 or 1, got 2"},
    {"TextureCoordinatesMissing", [](Scene& s) { primitive_of(s).uv[0].clear(); },
     "meshes[0].primitives[0].uv[0]: is empty, but materials[0] has a texture that uses it"},
    {"LightMapWithoutFront", [](Scene& s) { s.materials[0].light_map.back.picture = 0; },
     "materials[0].light_map.front: is not set, but the back is"},
    {"LightMapInTwoPlaces",
     [](Scene& s) {
       s.materials[0].light_map.front.picture = s.materials[0].light_map.back.picture = 0;
       s.materials[0].light_map.back.uv_set = 1;
       primitive_of(s).uv[1] = primitive_of(s).uv[0];
     },
     "materials[0].light_map.back.uv_set: expected the front's, 0, got 1"},
    {"TextureTransform", [](Scene& s) { s.materials[0].base_color_texture.uv_from_mesh_uv[2] = kNan; },
     "materials[0].base_color_texture.uv_from_mesh_uv[2]: expected a finite number, got nan"},
    {"BaseColour", [](Scene& s) { s.materials[0].base_color.g = -0.5F; },
     "materials[0].base_color[1]: expected a number from 0 to 1000000000000, got -0.5"},
    {"Factors",
     [](Scene& s) {
       s.materials[0].metallic = 1.5F;
       s.materials[0].roughness = kNan;
     },
     "materials[0].metallic: expected a number from 0 to 1, got 1.5\n"
     "materials[0].roughness: expected a number from 0 to 1, got nan"},
    {"IndexBeyond", [](Scene& s) { primitive_of(s).indices[4] = 900; },
     "meshes[0].primitives[0].indices[4]: 900 is beyond the 4 positions"},
    {"IndicesNotTriples", [](Scene& s) { primitive_of(s).indices.pop_back(); },
     "meshes[0].primitives[0].indices: expected a multiple of 3, got 5"},
    {"PositionsNotTriples", [](Scene& s) { primitive_of(s).indices.clear(); },
     "meshes[0].primitives[0].positions: without indices, expected a multiple of 3, got 4"},
    {"PositionNan", [](Scene& s) { primitive_of(s).positions[2].y = kNan; },
     "meshes[0].primitives[0].positions[2]: expected finite numbers"},
    {"AttributeLength",
     [](Scene& s) {
       primitive_of(s).normals.resize(3);
       primitive_of(s).colors.resize(5);
     },
     "meshes[0].primitives[0].normals: has 3 elements, but there are 4 positions\n"
     "meshes[0].primitives[0].colors: has 5 elements, but there are 4 positions"},
    {"NormalZero",
     [](Scene& s) {
       primitive_of(s).normals[1] = {0, 0, 0};
     },
     "meshes[0].primitives[0].normals[1]: a normal has no length"},
    {"TangentHand",
     [](Scene& s) {
       primitive_of(s).tangents.assign(4, {1, 0, 0, 0.5F});
     },
     "meshes[0].primitives[0].tangents[0]: expected a direction, and w = 1 or -1"},
    {"TangentsWithoutNormals",
     [](Scene& s) {
       primitive_of(s).tangents.assign(4, {1, 0, 0, 1});
       primitive_of(s).normals.clear();
     },
     "meshes[0].primitives[0].tangents: tangents mean nothing without normals"},
    {"Material", [](Scene& s) { primitive_of(s).material = 1; },
     "meshes[0].primitives[0].material: 1 is no index into the 1 materials, nor -1 for none"},
    {"MaterialNegative", [](Scene& s) { primitive_of(s).material = -2; },
     "meshes[0].primitives[0].material: -2 is no index into the 1 materials, nor -1 for none"},
    {"CameraFrustum", [](Scene& s) { s.cameras[0].projection.near = 0; },
     "cameras[0].projection: near must be greater than zero"},
    {"CameraNames",
     [](Scene& s) {
       s.cameras.resize(3, s.cameras[0]);
       s.cameras[2].name = "other";
     },
     "cameras[1].name: \"main\" is also the name of cameras[0]"},
    {"LightNames", [](Scene& s) { s.lights[1].name = "bulb"; },
     "lights[1].name: \"bulb\" is also the name of lights[0]"},
    {"LightColour", [](Scene& s) { s.lights[0].color.b = -1; },
     "lights[0].color[2]: expected a finite number of at least 0, got -1"},
    {"LightIntensity", [](Scene& s) { s.lights[0].intensity = kEndless; },
     "lights[0].intensity: expected a finite number of at least 0, got inf"},
    {"LightBlinding",
     [](Scene& s) {
       s.lights[0].intensity = 1e20;
       s.lights[0].color = {0, 0, 1e20F};
     },
     "lights[0].intensity: 1e+20 times the colour's 1.0000000200408773e+20 is more than 1e+30"},
    {"LightRange", [](Scene& s) { s.lights[0].range = 0; },
     "lights[0].range: expected a number greater than 0, got 0"},
    {"LightRangeNan", [](Scene& s) { s.lights[0].range = std::nan(""); },
     "lights[0].range: expected a number greater than 0, got nan"},
    {"BlackLevelAboveWhite", [](Scene& s) { s.lights[1].black_level = 1.5; },
     "lights[1].black_level: expected a number from 0 to 1, got 1.5"},
    {"BlackLevelNotANumber", [](Scene& s) { s.lights[1].black_level = std::nan(""); },
     "lights[1].black_level: expected a number from 0 to 1, got nan"},
    {"PanelOfNoHeight", [](Scene& s) { s.lights[1].panel_width = 1920; },
     "lights[1].panel_height: expected a width and a height, or neither, got 1920 x 0"},
    {"LumensOfTheSun",
     [](Scene& s) {
       s.lights[0].type = LightType::directional;
       s.lights[0].lumens = 5;
     },
     "lights[0].lumens: a directional light's brightness is not given in lumens"},
    {"LampOfAProjector",
     [](Scene& s) {
       s.lights[1].distribution = lamp({0, 90}, {0, 360}, {1, 1, 1, 1});
     },
     "lights[1].distribution: only point and spot lights have one"},
    {"LampWithoutAngles",
     [](Scene& s) {
       s.lights[0].distribution = lamp({}, {0, 360}, {});
     },
     "lights[0].distribution: expected 2 to 40000 vertical angles, got 0"},
    {"LampGoesBack",
     [](Scene& s) {
       s.lights[0].distribution = lamp({0, 50, 40}, {0, 360}, {});
     },
     "lights[0].distribution: vertical angle 3: expected more than the 50 degrees before it, got 40"},
    {"LampNotAllRound",
     [](Scene& s) {
       s.lights[0].distribution = lamp({0, 90}, {0, 180}, {1, 1, 1, 1});
     },
     "lights[0].distribution: horizontal angles: expected a full turn from 0 to 360 degrees, got 0 to 180"},
    {"LampNegative",
     [](Scene& s) {
       s.lights[0].distribution = lamp({0, 90}, {0, 360}, {1, 1, -1, 1});
     },
     "lights[0].distribution: candela value 3: expected from 0 to 1e12, got -1"},
    {"LampTooShort",
     [](Scene& s) {
       s.lights[0].distribution = lamp({0, 90}, {0, 360}, {1, 1});
     },
     "lights[0].distribution: expected 4 candela values, one for each pair of angles, got 2"},
    {"LampTooBright",
     [](Scene& s) {
       s.lights[0].distribution = lamp({0, 90}, {0, 360}, {1, 1e12, 1, 1});
       s.lights[0].intensity = 1e20;
     },
     "lights[0].distribution: its candela times the light's intensity are more than 1e+30"},
    {"LampDark",
     [](Scene& s) {
       s.lights[0].distribution = lamp({0, 90}, {0, 360}, {0, 0, 0, 0});
       s.lights[0].lumens = 1;
     },
     "lights[0].distribution: is dark: it cannot be scaled to lumens"},
    {"LumensNegative", [](Scene& s) { s.lights[1].lumens = -5; },
     "lights[1].lumens: expected a finite number of at least 0, got -5"},
    {"SpotCones",
     [](Scene& s) {
       s.lights[0].type = LightType::spot;
       s.lights[0].inner_cone = Angle::degrees(60);
     },
     "lights[0].outer_cone: expected 0 <= inner cone <= outer cone <= 90 degrees, got 60 and 45"},
    {"SpotConeWide",
     [](Scene& s) {
       s.lights[0].type = LightType::spot;
       s.lights[0].outer_cone = Angle::degrees(100);
     },
     "lights[0].outer_cone: expected 0 <= inner cone <= outer cone <= 90 degrees, got 0 and 100"},
    {"CustomAttenuation", [](Scene& s) { s.lights[0].attenuation = Attenuation::custom; },
     "lights[0].custom_attenuation: is not set, but attenuation is custom"},
    {"Slide", [](Scene& s) { s.lights[1].slide = 7; },
     "lights[1].slide: 7 is no index into the 1 pictures, nor -1 for none"},
    {"IntensityMapMissing",
     [](Scene& s) {
       s.lights[1].slide = -1;
       s.lights[1].slide_is_intensity = true;
     },
     "lights[1].slide: is not set, but slide_is_intensity says that it holds the intensities"},
    {"ApertureRadius", [](Scene& s) { s.lights[1].aperture.radius = -1; },
     "lights[1].aperture.radius: expected a number from 0 to 1000000000, got -1"},
    {"ApertureFocus", [](Scene& s) { s.lights[1].aperture.focal_distance = 0; },
     "lights[1].aperture.focal_distance: expected at least 0.001 m, got 0"},
    {"ApertureOfAPoint", [](Scene& s) { s.lights[0].aperture.radius = 1; },
     "lights[0].aperture.radius: only a projector with perspective has a lens to open"},
    {"ApertureAndSize",
     [](Scene& s) {
       s.lights[1].aperture.radius = 1;
       s.lights[1].source.radius = 1;
     },
     "lights[1].aperture.radius: the light shines from its lens: leave out the source's size"},
    {"ProjectorFrustum", [](Scene& s) { s.lights[1].projection.left = 5; },
     "lights[1].projection: the frustum has no width or no height"},
    {"DistortionOfABulb", [](Scene& s) { s.lights[0].distortion.k1 = 0.1; },
     "lights[0].distortion: only a projector has a lens that distorts"},
    {"DistortionOfAFrameOfNoShape", [](Scene& s) { s.lights[1].distortion.k1 = 0.1; },
     "lights[1].distortion: needs a frame of a known shape: set aspect_from_slide to false, and the slide's "
     "aspect in the projection"},
    {"DistortionThatFolds",
     [](Scene& s) {
       s.lights[1].aspect_from_slide = false;
       s.lights[1].distortion.k1 = -5;
     },
     "lights[1].distortion: cannot be inverted: it folds back 14.48 degrees off the lens axis (tangent "
     "0.2582), so that the slide's point (0, 0), from its top-left corner, is thrown nowhere"},
    {"DistortionNotANumber",
     [](Scene& s) {
       s.lights[1].aspect_from_slide = false;
       s.lights[1].distortion.k3 = NAN;
     },
     "lights[1].distortion: expected finite coefficients of at most 1e+06, got nan"},
    {"SunFrustum",
     [](Scene& s) {
       s.lights[0].type = LightType::directional;
       s.lights[0].fit = false;
     },
     "lights[0].projection: a directional light's projection must be orthographic"},
    {"ShadowResolution",
     [](Scene& s) {
       s.lights[0].shadow.resolution = 16385;
       s.lights[1].shadow.resolution = -1;
     },
     "lights[0].shadow.resolution: expected from 1 to 16384, or 0 for the default, got 16385\n"
     "lights[1].shadow.resolution: expected from 1 to 16384, or 0 for the default, got -1"},
    {"ShadowKernel",
     [](Scene& s) {
       s.lights[0].shadow.kernel = 1;
       s.lights[1].shadow.kernel = 10;
     },
     "lights[0].shadow.kernel: expected from 2 to 9, got 1\n"
     "lights[1].shadow.kernel: expected from 2 to 9, got 10"},
    {"ShadowBias",
     [](Scene& s) {
       s.lights[0].shadow.constant_bias = std::nan("");
       s.lights[0].shadow.slope_bias = kEndless;
     },
     "lights[0].shadow.constant_bias: expected a number from -1000000000 to 1000000000, got nan\n"
     "lights[0].shadow.slope_bias: expected a number from -1000000000 to 1000000000, got inf"},
    {"ShadowDepths",
     [](Scene& s) {
       s.lights[0].shadow.soft_edge = -1;
       s.lights[0].shadow.bleeding_reduction = 1.5F;
       s.lights[0].shadow.blur = 65;
       s.lights[1].shadow.moments = static_cast<ShadowMoments>(9);
       s.lights[1].shadow.depth = static_cast<ShadowDepth>(9);
     },
     "lights[0].shadow.soft_edge: expected a number from 0 to 1000000000, got -1\n"
     "lights[0].shadow.bleeding_reduction: expected a number from 0 to 1, got 1.5\n"
     "lights[0].shadow.blur: expected a number from 0 to 64, got 65\n"
     "lights[1].shadow.depth: 9 is no value of the enumeration, which ends at 1\n"
     "lights[1].shadow.moments: 9 is no value of the enumeration, which ends at 1"},
    {"Ambient",
     [](Scene& s) {
       s.ambient.x = kNan;
       s.background = glm::vec3(-1, 0, 0);
     },
     "ambient[0]: expected a number from 0 to 1000000000000, got nan\n"
     "background[0]: expected a number from 0 to 1000000000000, got -1"},
    {"Highlight",
     [](Scene& s) {
       s.phong = PhongHighlight{-1, kNan};
     },
     "phong.specular: expected a finite number of at least 0, got -1\n"
     "phong.shininess: expected a finite number of at least 0, got nan"},
    {"NodeReferences",
     [](Scene& s) {
       s.nodes[0].mesh = 1;
       s.nodes[1].camera = -2;
       s.nodes[2].light = 2;
       s.nodes[3].parent = 4;
     },
     "nodes[0].mesh: 1 is no index into the 1 meshes, nor -1 for none\n"
     "nodes[1].camera: -2 is no index into the 1 cameras, nor -1 for none\n"
     "nodes[2].light: 2 is no index into the 2 lights, nor -1 for none\n"
     "nodes[3].parent: 4 is no index into the 4 nodes, nor -1 for none"},
    {"NodeMatrixNan", [](Scene& s) { s.nodes[0].parent_from_node[3][1] = std::nan(""); },
     "nodes[0].parent_from_node: the matrix holds a value that is not finite"},
    {"NodeMatrixProjective", [](Scene& s) { s.nodes[0].parent_from_node[0][3] = 0.1; },
     "nodes[0].parent_from_node: the matrix's last row must be 0 0 0 1"},
    {"InstanceMatrix",
     [](Scene& s) {
       s.nodes[0].node_from_instance.assign(2, glm::dmat4(1.0));
       s.nodes[0].node_from_instance[1][2][2] = kEndless;
     },
     "nodes[0].node_from_instance[1]: the matrix holds a value that is not finite"},
    {"NodeOwnParent", [](Scene& s) { s.nodes[2].parent = 2; },
     "nodes[2].parent: the node is its own ancestor"},
    {"NodeCycle",
     [](Scene& s) {
       s.nodes[1].parent = 2;
       s.nodes[2].parent = 3;
       s.nodes[3].parent = 1;
     },
     "nodes[1].parent: the node is its own ancestor"},
    {"LightTwice", [](Scene& s) { s.nodes[3].light = 0; }, "nodes[3]: lights[0] already stands at nodes[2]"},
    {"LightFlattened", [](Scene& s) { s.nodes[2].parent_from_node[2] = glm::dvec4(0); },
     "nodes[2]: lights[0] cannot stand here: the matrix has no direction along Z: its third column is zero"},
    {"MeshTooFar", [](Scene& s) { s.nodes[0].parent_from_node[0][0] = 1e13; },
     "nodes[0]: meshes[0] reaches more than 1000000000 m from the origin"},
    {"ChainOverflows",
     [](Scene& s) {
       s.nodes[0].parent = 1;
       s.nodes[0].parent_from_node[0][0] = 1e200;
       s.nodes[1].parent_from_node[0][0] = 1e200;
     },
     "nodes[0]: meshes[0] reaches more than 1000000000 m from the origin"},
    {"InstanceTooFar",
     [](Scene& s) {
       s.nodes[0].node_from_instance.assign(1, glm::dmat4(1.0));
       s.nodes[0].node_from_instance[0][3][0] = -1e13;
     },
     "nodes[0]: meshes[0] reaches more than 1000000000 m from the origin"},
    {"PhotographWithoutPicture", [](Scene& s) { s.photographs.push_back(photograph(-1)); },
     "photographs[0].picture: -1 is no index into the 1 pictures"},
    {"PhotographThatIsAFilm",
     [](Scene& s) {
       s.pictures[0].film.emplace();
       s.photographs.push_back(photograph(0));
       s.materials[0].base_color_texture.picture = -1;
     },
     "photographs[0].picture: is a film: only slides may change with time"},
    {"NarrowSpotInLumens",
     [](Scene& s) {
       s.lights[0].type = LightType::spot;
       s.lights[0].inner_cone = Angle::degrees(0);
       s.lights[0].outer_cone = Angle::degrees(1e-3);
       s.lights[0].lumens = 100;
     },
     "lights[0].outer_cone: expected at least 0.01 degrees of a light in lumens, got 0.001"},
    {"LumensOfAWhiteHole", [](Scene& s) { s.lights[1].lumens = 1e20; },
     "lights[1].lumens: 1e+20 times the colour's 1 is more than 1e+18"},
    {"PhotographParallel",
     [](Scene& s) {
       s.photographs.push_back(photograph(0));
       s.photographs[0].projection = Projection::orthographic(1, 1, 0, 10);
     },
     "photographs[0].projection: a photograph's projection must be perspective"},
    {"PhotographMirrored",
     [](Scene& s) {
       s.photographs.push_back(photograph(0));
       s.photographs[0].pose.world_from_view_rotation[0] *= -1;
     },
     "photographs[0].pose: its rotation must be right-handed, not mirrored"},
    {"PhotographGain",
     [](Scene& s) {
       s.photographs.push_back(photograph(0));
       s.photographs[0].gain.y = 0;
     },
     "photographs[0].gain[1]: expected a number above 0 and up to 1000000, got 0"},
    {"PhotographVisibility", [](Scene& s) { s.photograph_settings.visibility = ShadowTechnique::ground; },
     "photograph_settings.visibility: expected exact, map or raytraced"},
    {"PhotographFeather", [](Scene& s) { s.photograph_settings.feather = 0.6; },
     "photograph_settings.feather: expected a number from 0 to 0.5, got 0.6"},
};

INSTANTIATE_TEST_SUITE_P(Built, InvalidBuiltScene, testing::ValuesIn(kSceneCases), case_name);

}  // namespace
}  // namespace laterna
