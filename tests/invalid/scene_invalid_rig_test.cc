// Bad rigs, and exactly what is said about each.
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

struct RigCase {
  const char* name;
  const char* text;
  const char* messages;
};

std::string case_name(const testing::TestParamInfo<RigCase>& info) { return info.param.name; }

class InvalidRig : public testing::TestWithParam<RigCase> {};

TEST_P(InvalidRig, IsRefusedWithItsMessage) {
  const TemporaryFolder folder;
  folder.write("slide.png", "x");
  const Result<Scene> scene = load_scene({folder.write("s.gltf", triangle_builder().text())},
                                         {.rigs = {folder.write("r.json", GetParam().text)}});
  EXPECT_EQ(messages_of(scene, folder.path()), GetParam().messages);
}

const RigCase kRigCases[] = {
    {"NotJson", "lights: sun",
     "r.json: line 1: not valid JSON: syntax error while parsing value - invalid literal; last read: 'l'"},
    {"Empty", "",
     "r.json: line 1: not valid JSON: syntax error while parsing value - unexpected end of input; expected "
     "'[', '{', or a literal"},
    {"NotAnObject", "[]", "r.json: line 1: expected an object, got an array of 0"},
    {"CutShort", "{\"lights\": [{\"type\": \"point\"",
     "r.json: line 1: lights[0]: not valid JSON: syntax error while parsing object - unexpected end of "
     "input; expected '}'"},
    {"Comment", "{\n  // the sun\n  \"lights\": []\n}",
     "r.json: line 2: not valid JSON: syntax error while parsing object key - invalid literal; last read: "
     "'{<U+000A>  /'; expected string literal"},
    {"TrailingComma", "{\"ambient\": [0, 0, 0],\n}",
     "r.json: line 2: not valid JSON: syntax error while parsing object key - unexpected '}'; expected "
     "string literal"},
    {"NotANumber", "{\n\"ambient\": [0, NaN, 0]\n}",
     "r.json: line 2: ambient[1]: not valid JSON: syntax error while parsing value - invalid literal; last "
     "read: '0, N'"},
    {"Infinite", "{\n\"lights\": [{\"type\": \"point\", \"position\": [0,0,0],\n\"candela\": Infinity}]}",
     "r.json: line 3: lights[0].candela: not valid JSON: syntax error while parsing value - invalid literal; "
     "last read: '\"candela\": I'"},
    {"NumberTooLarge", "{\"ambient\": [0, 1e400, 0]}",
     "r.json: line 1: ambient[1]: not valid JSON: number overflow parsing '1e400'"},
    {"DuplicateKey", "{\n\"ambient\": [0, 0, 0],\n\"ambient\": [1, 1, 1]\n}",
     "r.json: line 3: the key \"ambient\" appears twice"},
    {"UnknownKey", "{\n\"light\": []\n}",
     "r.json: line 2: light: a rig has no key \"light\" (did you mean \"lights\"?)"},
    {"KeyOfNothing", "{\"xyzzy\": 1}", "r.json: line 1: xyzzy: a rig has no key \"xyzzy\""},
    {"AmbientTooShort", "{\"ambient\": [0, 0]}",
     "r.json: line 1: ambient: expected an array of 3 numbers, got an array of 2"},
    {"AmbientNegative", "{\"ambient\": [0,\n -1, 0]}",
     "r.json: line 2: ambient[1]: expected a number from 0 to 1000000000000, got -1"},
    {"AmbientText", "{\"ambient\": \"white\"}",
     "r.json: line 1: ambient: expected an array of 3 numbers, got \"white\""},
    {"BackgroundOfText", "{\"background\": [0, \"0\", 0]}",
     "r.json: line 1: background[1]: expected a number from 0 to 1000000000000, got \"0\""},
    {"Shading", "{\"shading\": {\"specular\": -1, \"shininess\": 0, \"glow\": 1}}",
     "r.json: line 1: shading.specular: expected a number from 0 to 1000000000000, got -1\n"
     "r.json: line 1: shading.shininess: expected a number greater than 0, got 0\n"
     "r.json: line 1: shading.glow: shading has no key \"glow\""},
    {"CamerasNotAnArray", "{\"cameras\": {}}", "r.json: line 1: cameras: expected an array, got an object"},
    {"CameraNotAnObject", "{\"cameras\": [7]}", "r.json: line 1: cameras[0]: expected an object, got 7"},
    {"CameraIncomplete", "{\"cameras\": [\n{}]}",
     "r.json: line 2: cameras[0].position: is missing\n"
     "r.json: line 2: cameras[0].target: is missing\n"
     "r.json: line 2: cameras[0]: needs one of \"yfov_deg\", \"hfov_deg\", \"focal_length_mm\", "
     "\"intrinsics\", \"orthographic\", \"frustum\""},
    {"CameraLooksNowhere",
     "{\"cameras\": [{\"position\": [1, 2, 3],\n\"target\": [1, 2, 3], \"yfov_deg\": 40}]}",
     "r.json: line 2: cameras[0].target: is the same point as position: there is no direction to look in"},
    {"CameraUpZero",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": 40,\n\"up\": [0, 0, 0]}]}",
     "r.json: line 2: cameras[0].up: up is the zero vector"},
    {"CameraUpAlongTheGaze",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": 40,\n\"up\": [0, 0, 2]}]}",
     "r.json: line 2: cameras[0].up: up points along the direction of view: give another up"},
    {"CameraFar", "{\"cameras\": [{\"position\": [0,0,1e13], \"target\": [0,0,0], \"yfov_deg\": 40}]}",
     "r.json: line 1: cameras[0].position[2]: expected a number from -1000000000 to 1000000000, got "
     "10000000000000"},
    {"FieldOfViewZero", "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0],\n\n\"yfov_deg\": 0}]}",
     "r.json: line 3: cameras[0].yfov_deg: expected a number between 0 and 180, got 0"},
    {"FieldOfView180", "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": 180}]}",
     "r.json: line 1: cameras[0].yfov_deg: expected a number between 0 and 180, got 180"},
    {"FieldOfViewWord", "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": \"40\"}]}",
     "r.json: line 1: cameras[0].yfov_deg: expected a number between 0 and 180, got \"40\""},
    {"FrustumWithAspect",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"aspect\": 2, \"frustum\": {\"left\": -1, "
     "\"right\": 1, \"bottom\": -1}}]}",
     "r.json: line 1: cameras[0].aspect: follows from the sides of the frustum"},
    {"FieldOfViewMissing", "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0]}]}",
     "r.json: line 1: cameras[0]: needs one of \"yfov_deg\", \"hfov_deg\", \"focal_length_mm\", "
     "\"intrinsics\", \"orthographic\", \"frustum\""},
    {"FieldOfViewMisspelt", "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0],\n\"yfov\": 40}]}",
     "r.json: line 1: cameras[0]: needs one of \"yfov_deg\", \"hfov_deg\", \"focal_length_mm\", "
     "\"intrinsics\", \"orthographic\", \"frustum\"\n"
     "r.json: line 2: cameras[0].yfov: a camera has no key \"yfov\" (did you mean \"yfov_deg\"?)"},
    {"FieldOfViewTwice",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": 40,\n\"hfov_deg\": 50, "
     "\"aspect\": 1}]}",
     "r.json: line 2: cameras[0].hfov_deg: only one of \"yfov_deg\" and \"hfov_deg\" may be given"},
    {"HorizontalWithoutAspect",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"hfov_deg\": 50}]}",
     "r.json: line 1: cameras[0].hfov_deg: needs \"aspect\" (width / height) beside it"},
    {"NearNotPositive",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": 50, \"near\": 0}]}",
     "r.json: line 1: cameras[0].near: expected a number greater than 0, got 0"},
    {"FarBeforeNear",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": 50, \"near\": 5, \"far\": "
     "5}]}",
     "r.json: line 1: cameras[0].far: must be beyond near (5), got 5"},
    {"AspectZero",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": 50, \"aspect\": 0}]}",
     "r.json: line 1: cameras[0].aspect: expected a number greater than 0, got 0"},
    {"OrthographicWithoutEnd",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"orthographic\": {\"height\": 2}}]}",
     "r.json: line 1: cameras[0].far: is missing: an orthographic view ends somewhere"},
    {"OrthographicHeight",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"far\": 9, \"orthographic\": {\"hieght\": "
     "2}}]}",
     "r.json: line 1: cameras[0].orthographic.height: is missing\n"
     "r.json: line 1: cameras[0].orthographic.hieght: orthographic has no key \"hieght\" (did you mean "
     "\"height\"?)"},
    {"Intrinsics",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"intrinsics\":\n{\"fx\": 100, \"fy\": -1, "
     "\"cx\": 0, \"width\": 10, \"heigth\": 10}}]}",
     "r.json: line 1: cameras[0].intrinsics.cy: is missing\n"
     "r.json: line 1: cameras[0].intrinsics.height: is missing\n"
     "r.json: line 2: cameras[0].intrinsics.fy: expected a number greater than 0, got -1\n"
     "r.json: line 2: cameras[0].intrinsics.heigth: intrinsics has no key \"heigth\" (did you mean "
     "\"height\"?)"},
    {"IntrinsicsAndAspect",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"aspect\": 1, \"intrinsics\": {\"fx\": 1, "
     "\"fy\": 1, \"cx\": 0, \"cy\": 0, \"width\": 1, \"height\": 1}}]}",
     "r.json: line 1: cameras[0].aspect: follows from the intrinsics"},
    {"NameEmpty",
     "{\"cameras\": [{\"name\": \"\", \"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": 40}]}",
     "r.json: line 1: cameras[0].name: is empty"},
    {"NameTwice",
     "{\"lights\": [{\"name\": \"a\", \"type\": \"point\", \"position\": [0,0,0]},\n{\"name\": \"a\", "
     "\"type\": \"point\", \"position\": [0,0,0]}]}",
     "r.json: line 2: lights[1].name: \"a\" is taken already"},
    {"LightWithoutType", "{\"lights\": [{\"position\": [0,0,0]}]}",
     "r.json: line 1: lights[0].type: is missing"},
    {"LightTypeMisspelt", "{\"lights\": [{\"type\": \"projecter\"}]}",
     "r.json: line 1: lights[0].type: expected one of \"directional\", \"point\", \"spot\", \"projector\", "
     "got \"projecter\" (did you mean \"projector\"?)"},
    {"PointWithoutPosition", "{\"lights\": [{\"type\": \"point\"}]}",
     "r.json: line 1: lights[0].position: is missing"},
    {"PointWithTarget", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0],\n\"target\": [0,0,0]}]}",
     "r.json: line 2: lights[0].target: a point light has no key \"target\""},
    {"KeyMisspelt", "{\"lights\": [{\"type\": \"point\", \"positon\": [0,0,0]}]}",
     "r.json: line 1: lights[0].position: is missing\n"
     "r.json: line 1: lights[0].positon: a point light has no key \"positon\" (did you mean \"position\"?)"},
    {"IntensityHasNoUnit", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"intensity\": 5}]}",
     "r.json: line 1: lights[0].intensity: the brightness of a point light is given in \"candela\" or "
     "\"lumens\""},
    {"SunInCandela",
     "{\"lights\": [{\"type\": \"directional\", \"position\": [0,1,0], \"target\": [0,0,0],\n\"candela\": "
     "5}]}",
     "r.json: line 2: lights[0].candela: the brightness of a directional light is given in \"lux\""},
    {"BulbInLux", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"lux\": 5}]}",
     "r.json: line 1: lights[0].lux: the brightness of a point light is given in \"candela\" or "
     "\"lumens\""},
    {"ProjectorInWatts",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"watts\": 5}]}",
     "r.json: line 1: lights[0].watts: the brightness of a projector is given in \"candela\" or \"lumens\""},
    {"LampOfAProjector",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"ies\": \"a.ies\"}]}",
     "r.json: line 1: lights[0].ies: only point and spot lights have one, not a projector"},
    {"LampMissing", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0],\n\"ies\": \"a.ies\"}]}",
     "r.json: line 2: lights[0].ies: \"a.ies\" not found (tried \"a.ies\")"},
    {"LampIsAPicture",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0],\n\"ies\": \"slide.png\"}]}",
     "r.json: line 2: lights[0].ies: slide.png: line 1: no lamp file: expected IES LM-63, with a line that "
     "begins with "
     "TILT=, or EULUMDAT"},
    {"LampInCandela",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"ies\": 7,\n\"candela\": 5}]}",
     "r.json: line 1: lights[0].ies: expected a string, got 7\n"
     "r.json: line 2: lights[0].candela: the brightness of a measured lamp is given in its file, \"lumens\" "
     "or "
     "\"scale\""},
    {"ScaleOfABulb", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"scale\": 5}]}",
     "r.json: line 1: lights[0].scale: the brightness of a point light is given in \"candela\" or "
     "\"lumens\""},
    {"CandelaAndLumens",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"lumens\": 5, \"candela\": 5}]}",
     "r.json: line 1: lights[0].lumens: give either candela or lumens, not both"},
    {"CandelaNegative", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"candela\": -5}]}",
     "r.json: line 1: lights[0].candela: expected a number from 0 to 1000000000000, got -5"},
    {"ColourNegative",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"color\": [1, 1, -0.5]}]}",
     "r.json: line 1: lights[0].color[2]: expected a number from 0 to 1000000000000, got -0.5"},
    {"ColourAndTemperature",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"color\": [1,1,1],\n\"color_temperature\": "
     "3000}]}",
     "r.json: line 2: lights[0].color_temperature: give either color or color_temperature, not both"},
    {"TemperatureTooLow",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"color_temperature\": 900}]}",
     "r.json: line 1: lights[0].color_temperature: expected a number from 1000 to 40000, got 900"},
    {"FilterThatAddsLight",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"filter\": [1, 1.5, 0]}]}",
     "r.json: line 1: lights[0].filter[1]: expected a number from 0 to 1, got 1.5"},
    {"GelMisspelt", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"gel\": \"full_cbt\"}]}",
     "r.json: line 1: lights[0].gel: expected one of \"full_ctb\", \"half_ctb\", \"quarter_ctb\", "
     "\"full_cto\", "
     "\"half_cto\", \"quarter_cto\", \"nd_0.15\", \"nd_0.3\", \"nd_0.6\", \"nd_0.9\", \"nd_1.2\", got "
     "\"full_cbt\" (did you mean \"full_ctb\"?)"},
    {"BlackLevelAboveWhite",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"black_level\": 2}]}",
     "r.json: line 1: lights[0].black_level: expected a number from 0 to 1, got 2"},
    {"PixelsNotWhole",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"pixels\": [1920.5, 1080]}]}",
     "r.json: line 1: lights[0].pixels: expected whole numbers"},
    {"RangeZero", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"range\": 0}]}",
     "r.json: line 1: lights[0].range: expected a number greater than 0, got 0"},
    {"AttenuationNeedsRange",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"attenuation\": \"linear\"}]}",
     "r.json: line 1: lights[0].attenuation: needs \"range\" beside it"},
    {"AttenuationIgnoresRange",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"attenuation\": \"none\", \"range\": 4}]}",
     "r.json: line 1: lights[0].range: has no effect with this attenuation: leave one of them out"},
    {"AttenuationMisspelt",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"attenuation\": \"inverse-square\"}]}",
     "r.json: line 1: lights[0].attenuation: expected one of \"none\", \"linear\", \"inverse_square\", "
     "\"gltf_windowed\", got \"inverse-square\" (did you mean \"inverse_square\"?)"},
    {"ConesCrossed",
     "{\"lights\": [{\"type\": \"spot\", \"position\": [0,1,0], \"target\": [0,0,0], \"inner_cone_deg\": "
     "50}]}",
     "r.json: line 1: lights[0].inner_cone_deg: the inner cone (50) must not exceed the outer cone (45)"},
    {"ConeTooWide",
     "{\"lights\": [{\"type\": \"spot\", \"position\": [0,1,0], \"target\": [0,0,0], \"outer_cone_deg\": "
     "91}]}",
     "r.json: line 1: lights[0].outer_cone_deg: expected a number from 0 to 90, got 91"},
    {"BoxIncomplete",
     "{\"lights\": [{\"type\": \"directional\", \"position\": [0,1,0], \"target\": [0,0,0], \"half_width\": "
     "5}]}",
     "r.json: line 1: lights[0].half_height: is missing\n"
     "r.json: line 1: lights[0].far: is missing"},
    {"BoxTurned",
     "{\"lights\": [{\"type\": \"directional\", \"position\": [0,1,0], \"target\": [0,0,0], \"half_width\": "
     "5, \"half_height\": 5, \"near\": 3, \"far\": 2}]}",
     "r.json: line 1: lights[0].far: must be beyond near (3), got 2"},
    {"SlideMissing",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": "
     "30,\n\"slide\": \"lost.png\"}]}",
     "r.json: line 2: lights[0].slide: \"lost.png\" not found (tried \"lost.png\")"},
    {"SlideUrl",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"slide\": \"https://example.org/a.png\"}]}",
     "r.json: line 1: lights[0].slide: \"https://example.org/a.png\" not found (tried "
     "\"https://example.org/a.png\")"},
    {"SlideEmpty",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"slide\": \"\"}]}",
     "r.json: line 1: lights[0].slide: the file name is empty"},
    {"SlideWithNul",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"slide\": \"slide.png\\u0000\"}]}",
     "r.json: line 1: lights[0].slide: the file name holds a NUL character"},
    {"SlideIsAFolder",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"slide\": \".\"}]}",
     "r.json: line 1: lights[0].slide: \".\" not found (tried \".\")"},
    {"SlideNotAPictureWhereItsShapeIsNeeded",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"hfov_deg\": 30, "
     "\"slide\": \"slide.png\"}]}",
     "r.json: line 1: lights[0].slide: slide.png: expected a PNG, JPEG, GIF, BMP, TGA, PCX, PNM, PFM, "
     "Radiance "
     "HDR or "
     "OpenEXR picture, found none of these"},
    {"ProfileOfAMap",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"intensity_map\": \"slide.png\",\n\"profile\": \"flat_field\"}]}",
     "r.json: line 2: lights[0].profile: has no effect: an intensity_map says itself how the beam spreads"},
    {"ProjectorWithoutFrustum",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0]}]}",
     "r.json: line 1: lights[0]: needs one of \"yfov_deg\", \"hfov_deg\", \"focal_length_mm\", "
     "\"intrinsics\", \"orthographic\", \"frustum\", \"throw_ratio\""},
    {"ThrowRatioAndField",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"throw_ratio\": 1.5}]}",
     "r.json: line 1: lights[0].throw_ratio: only one of \"yfov_deg\" and \"throw_ratio\" may be given"},
    {"ThrowRatioZero",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"throw_ratio\": "
     "0}]}",
     "r.json: line 1: lights[0].throw_ratio: expected a number greater than 0, got 0"},
    {"ThrowRatioOfACamera",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"throw_ratio\": 1.5}]}",
     "r.json: line 1: cameras[0]: needs one of \"yfov_deg\", \"hfov_deg\", \"focal_length_mm\", "
     "\"intrinsics\", \"orthographic\", \"frustum\"\n"
     "r.json: line 1: cameras[0].throw_ratio: a camera has no key \"throw_ratio\""},
    {"FocalLengthAlone",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], "
     "\"focal_length_mm\": 50}]}",
     "r.json: line 1: lights[0].focal_length_mm: needs \"sensor_mm\" beside it: width, or [width, height]"},
    {"SensorAlone",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"sensor_mm\": 36}]}",
     "r.json: line 1: lights[0].sensor_mm: needs \"focal_length_mm\" beside it"},
    {"SensorOfThreeSides",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], "
     "\"focal_length_mm\": 50, \"sensor_mm\": [36, 24, 1]}]}",
     "r.json: line 1: lights[0].sensor_mm: expected an array of 2 numbers, got an array of 3"},
    {"SensorAndAspect",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], "
     "\"focal_length_mm\": 50, \"sensor_mm\": [36, 24], \"aspect\": 1.5}]}",
     "r.json: line 1: lights[0].aspect: follows from the sensor's width and height"},
    {"FocalLengthOfACameraOfNoShape",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"focal_length_mm\": 50, \"sensor_mm\": "
     "36}]}",
     "r.json: line 1: cameras[0].focal_length_mm: needs \"aspect\" (width / height) beside it"},
    {"LensShiftHuge",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"lens_shift\": [0, 1000]}]}",
     "r.json: line 1: lights[0].lens_shift[1]: expected a number from -100 to 100, got 1000"},
    {"LensShiftOfIntrinsics",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"lens_shift\": "
     "[0, 0.5], \"intrinsics\": {\"fx\": 1, \"fy\": 1, \"cx\": 0, \"cy\": 0, \"width\": 2, \"height\": 1}}]}",
     "r.json: line 1: lights[0].lens_shift: follows from the intrinsics' cx and cy"},
    {"DistortionOfACamera",
     "{\"cameras\": [{\"position\": [0,0,1], \"target\": [0,0,0], \"yfov_deg\": 30, \"distortion\": {\"k1\": "
     "0.1}}]}",
     "r.json: line 1: cameras[0].distortion: a camera has no key \"distortion\""},
    {"DistortionOfThree",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"distortion\": [0.1, 0.2, 0.3]}]}",
     "r.json: line 1: lights[0].distortion: expected 4 or 5 numbers: k1, k2, p1, p2 and k3, as OpenCV orders "
     "them"},
    {"DistortionMisspelt",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"distortion\": {\"k4\": 0.1}}]}",
     "r.json: line 1: lights[0].distortion.k4: a distortion has no key \"k4\" (did you mean \"k1\"?)"},
    {"DistortionHuge",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"distortion\": {\"k1\": 1e9}}]}",
     "r.json: line 1: lights[0].distortion.k1: expected a number from -1000000 to 1000000, got 1000000000"},
    {"DistortionOfParallelLight",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"orthographic\": "
     "{\"height\": 2}, \"far\": 9, \"distortion\": {\"k1\": 0.1}}]}",
     "r.json: line 1: lights[0].distortion: only a perspective frame has a lens that distorts"},
    {"DistortionThatFolds",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 90, "
     "\"aspect\": 1,\n\"distortion\": {\"k1\": -0.3}}]}",
     "r.json: line 2: lights[0].distortion: cannot be inverted: it folds back 46.51 degrees off the lens "
     "axis (tangent 1.054), so that the slide's point (0, 0), from its top-left corner, is thrown nowhere"},
    {"CandelaHuge", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"candela\": 1e300}]}",
     "r.json: line 1: lights[0].candela: expected a number from 0 to 1000000000000, got 1e+300"},
    {"SlideAndMap",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"slide\": \"slide.png\", \"intensity_map\": \"slide.png\"}]}",
     "r.json: line 1: lights[0].intensity_map: give either slide or intensity_map, not both"},
    {"ProfileMisspelt",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,0], \"yfov_deg\": 30, "
     "\"profile\": \"flat\", \"outside\": \"wrap\"}]}",
     "r.json: line 1: lights[0].profile: expected one of \"flat_field\", \"uniform_candela\", got \"flat\" "
     "(did you mean \"flat_field\"?)\n"
     "r.json: line 1: lights[0].outside: expected one of \"black\", \"clamp\", \"repeat\", \"mirror\", got "
     "\"wrap\""},
    {"ShadowText", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"shadow\": \"soft\"}]}",
     "r.json: line 1: lights[0].shadow: expected true, false or an object, got \"soft\""},
    {"ShadowKeys",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"shadow\": {\"technique\": \"ray\", "
     "\"resolution\": 0, \"kernel\": 10,\n\"bias\": 1, \"outside\": \"dark\"}}]}",
     "r.json: line 1: lights[0].shadow.technique: expected one of \"none\", \"ground\", "
     "\"silhouette\", \"map\", \"pcss\", \"variance\", \"cascades\", \"volume\", \"exact\", \"raytraced\", "
     "got \"ray\" "
     "(did you mean \"raytraced\"?)\n"
     "r.json: line 1: lights[0].shadow.resolution: expected a whole number from 1 to 16384, got 0\n"
     "r.json: line 1: lights[0].shadow.kernel: expected a whole number from 2 to 9, got 10\n"
     "r.json: line 2: lights[0].shadow.outside: expected one of \"lit\", \"shadowed\", got \"dark\"\n"
     "r.json: line 2: lights[0].shadow.bias: a shadow has no key \"bias\" (did you mean \"constant_bias\"?)"},
    {"ShadowCascades",
     "{\"lights\": [{\"type\": \"directional\", \"position\": [0,9,0], \"target\": [0,0,1], \"shadow\": "
     "{\"technique\": \"cascades\",\n\"cascades\": 9, \"split_lambda\": 1.5, \"cascade_distance\": 0}}]}",
     "r.json: line 2: lights[0].shadow.cascades: expected a whole number from 1 to 8, got 9\n"
     "r.json: line 2: lights[0].shadow.split_lambda: expected a number from 0 to 1, got 1.5\n"
     "r.json: line 2: lights[0].shadow.cascade_distance: expected a number greater than 0 and at most "
     "1000000000, got "
     "0"},
    {"ShadowCascadesOfALamp",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"shadow\": {\"technique\": "
     "\"cascades\"}}]}",
     "r.json: line 1: lights[0].shadow.technique: cascades serve directional lights only"},
    {"ShadowWarpOfALamp",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"shadow\": {\"warp\": "
     "\"light_space_perspective\"}}]}",
     "r.json: line 1: lights[0].shadow.warp: only the map of a directional light that is fitted to the scene "
     "can be "
     "warped"},
    {"ShadowLayoutOfASun",
     "{\"lights\": [{\"type\": \"directional\", \"position\": [0,1,0], \"target\": [0,0,0], \"shadow\": "
     "{\"layout\": \"dual_paraboloid\"}}]}",
     "r.json: line 1: lights[0].shadow.layout: only point lights and spots wider than 150 degrees have maps "
     "of all directions: others have one map"},
    {"ShadowFilterMisspelt",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"shadow\": {\"filter\": "
     "\"percentage-closer\", "
     "\"caster_faces\": \"front\"}}]}",
     "r.json: line 1: lights[0].shadow.filter: expected one of \"refined\", \"nearest\", \"bilinear\", "
     "\"percentage_closer\", \"averaged_depths\", got \"percentage-closer\" (did you mean "
     "\"percentage_closer\"?)\n"
     "r.json: line 1: lights[0].shadow.caster_faces: expected one of \"both\", \"back_only\", got \"front\""},
    {"ShadowKernelOfAnotherFilter",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"shadow\": {\"kernel\": 5}}]}",
     "r.json: line 1: lights[0].shadow.kernel: has an effect only with \"filter\": \"percentage_closer\" "
     "or \"averaged_depths\" beside it"},
    {"ShadowDepth",
     "{\"lights\": [{\"type\": \"directional\", \"position\": [0,1,0], \"target\": [0,0,0], \"shadow\": "
     "{\"depth\": "
     "\"radial\"}},\n{\"type\": \"point\", \"position\": [0,0,0], \"shadow\": {\"depth\": \"round\", "
     "\"soft_edge\": -1}}]}",
     "r.json: line 1: lights[0].shadow.depth: radial depths are distances from the light, and parallel light "
     "comes "
     "from nowhere: use \"planar\"\n"
     "r.json: line 2: lights[1].shadow.depth: expected one of \"planar\", \"radial\", got \"round\"\n"
     "r.json: line 2: lights[1].shadow.soft_edge: expected a number from 0 to 1000000000, got -1"},
    {"ShadowVariance",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"shadow\": {\"moments\": \"four\", "
     "\"bleeding_reduction\": 2, \"blur\": 65}}]}",
     "r.json: line 1: lights[0].shadow.moments: expected one of \"variance\", \"exponential\", got \"four\"\n"
     "r.json: line 1: lights[0].shadow.bleeding_reduction: expected a number from 0 to 1, got 2\n"
     "r.json: line 1: lights[0].shadow.blur: expected a number from 0 to 64, got 65"},
    {"ShadowSoftParallelProjector",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,1], \"orthographic\": "
     "{\"height\": "
     "2}, \"far\": 9, \"radius\": 0.1, \"shadow\": {\"technique\": \"pcss\"}}]}",
     "r.json: line 1: lights[0].shadow.technique: \"pcss\" cannot serve a parallel projector with a size: "
     "all its "
     "light goes one way"},
    {"Aperture",
     "{\"lights\": [{\"type\": \"projector\", \"position\": [0,1,0], \"target\": [0,0,1], \"yfov_deg\": 30,\n"
     "\"aperture_radius\": -1, \"focus\": 0},\n{\"type\": \"projector\", \"position\": [0,1,0], \"target\": "
     "[0,0,1], \"yfov_deg\": 30, \"focus\": 2},\n{\"type\": \"projector\", \"position\": [0,1,0], "
     "\"target\": "
     "[0,0,1], \"yfov_deg\": 30, \"aperture_radius\": 0.1, \"size\": [1, 1]},\n{\"type\": \"spot\", "
     "\"position\": [0,1,0], \"target\": [0,0,1], \"aperture_radius\": 0.1},\n{\"type\": \"projector\", "
     "\"position\": [0,1,0], \"target\": [0,0,1], \"orthographic\": {\"height\": 2}, \"far\": 9, "
     "\"aperture_radius\": 0.1}]}",
     "r.json: line 2: lights[0].aperture_radius: expected a number from 0 to 1000000000, got -1\n"
     "r.json: line 2: lights[0].focus: expected a number from 0.001 to 1000000000, got 0\n"
     "r.json: line 3: lights[1].focus: needs \"aperture_radius\" beside it: through a pinhole all is in "
     "focus\n"
     "r.json: line 4: lights[2].size: the light shines from its lens: give either this or aperture_radius\n"
     "r.json: line 5: lights[3].aperture_radius: a spot light has no key \"aperture_radius\" (did you mean "
     "\"radius\"?)\n"
     "r.json: line 6: lights[4].aperture_radius: a parallel projector has no lens to open"},
    {"ShadowResolutionFraction",
     "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"shadow\": {\"resolution\": 1024.5}}]}",
     "r.json: line 1: lights[0].shadow.resolution: expected a whole number from 1 to 16384, got 1024.5"},
    {"EnabledNumber", "{\"lights\": [{\"type\": \"point\", \"position\": [0,0,0], \"enabled\": 1}]}",
     "r.json: line 1: lights[0].enabled: expected true or false, got 1"},
    {"NodeWithoutName", "{\"nodes\": [{\"visible\": false}]}", "r.json: line 1: nodes[0].name: is missing"},
    {"NodeUnknown", "{\"nodes\": [\n{\"name\": \"roof\", \"visible\": false}]}",
     "r.json: line 2: nodes[0].name: the scene has no node named \"roof\""},
    {"NodeKey", "{\"nodes\": [{\"name\": \"roof\", \"cast_shadow\": false}]}",
     "r.json: line 1: nodes[0].cast_shadow: a node has no key \"cast_shadow\" (did you mean "
     "\"casts_shadow\"?)"},
};

INSTANTIATE_TEST_SUITE_P(Rig, InvalidRig, testing::ValuesIn(kRigCases), case_name);

}  // namespace
}  // namespace laterna
