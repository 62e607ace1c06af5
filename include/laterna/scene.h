// What is lit, and by what: plain data that a caller may fill in by hand or read from files.
// Spaces, units and directions: docs/conventions.md (glTF's: metres, +Y up, lights and cameras look down −Z).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laterna/animation.h"
#include "laterna/blend.h"
#include "laterna/environment.h"
#include "laterna/film.h"
#include "laterna/image.h"
#include "laterna/lens.h"
#include "laterna/photographs.h"
#include "laterna/result.h"
#include "laterna/sampler.h"
#include "laterna/shadows.h"
#include "laterna/view.h"

namespace laterna {

struct LightDistribution;  // laterna/lamps.h
struct MaterialLobes;      // laterna/material_lobes.h
struct Mirror;             // laterna/mirrors.h
struct Relief;             // laterna/relief.h

// ---------------------------------------------------------------------------------------------- pictures in a scene

/// A picture that a material or a projector uses: a file, encoded bytes, or pixels. Exactly one of the three is set.
/// Pixels are decoded once, when a Renderer is made, all pictures in parallel.
struct Picture {
  std::string name;            ///< for messages: the file, or "scene.glb: images[3]"
  std::filesystem::path file;  ///< a file still to be read
  std::shared_ptr<const std::vector<std::byte>> encoded_owner;  ///< keeps `encoded` alive
  std::span<const std::byte> encoded;                           ///< bytes of a PNG, JPEG, … file
  std::shared_ptr<const Image> pixels;                          ///< decoded by the caller
  /// `file` is a film (film.h), which shows another frame at another time. Only slides of lights may be films.
  std::optional<FilmTiming> film;
};

/// A picture bound to a set of texture coordinates. (u, v) = (0, 0) is the top-left corner of the picture.
struct Texture {
  int picture = -1;  ///< index into Scene::pictures; −1: none
  Sampler sampler;
  int uv_set = 0;  ///< 0 or 1
  /// KHR_texture_transform: uv' = translation · rotation · scale · uv; rows of the 2×3 matrix.
  std::array<float, 6> uv_from_mesh_uv = {1, 0, 0, 0, 1, 0};

  [[nodiscard]] bool is_set() const { return picture >= 0; }
};

// ---------------------------------------------------------------------------------------------- surfaces

/// A picture on a surface's base colour, or the slide of a projector thrown on it as paint: reflectance, not light.
/// Layers lie one over the other, in their order, over the base colour with all that multiplies it (and over what
/// photographs show), before any light shines. A surface's alpha stays as it is. docs/blend.md
struct SurfaceLayer {
  Texture texture;  ///< sRGB; its alpha, linear, is the layer's; unset: white
  /// The texture is there once, from (0, 0) to (1, 1), and beyond it the layer is not there.
  bool once = false;
  /// In place of `texture`: index into Scene::lights, of a projector whose slide is painted on what it faces. Whether its
  /// light is on, and all that is said of how bright it is, plays no part. −1: none.
  int projector = -1;
  bool occluded = true;  ///< the projector's slide does not pass through what casts shadows
  glm::vec3 color{1};    ///< linear, 0 … kMaxRadiance; multiplies the picture
  float opacity = 1;     ///< 0 … 1; multiplies alpha
  BlendMode blend = BlendMode::over;
};
/// On one surface.
inline constexpr std::size_t kMaxSurfaceLayers = 64;

/// What was found to fall on a surface, kept in a picture (laterna/bake.h): irradiance in lux / `intensity`, as the light
/// itself gives it, with the cosine of its angle. It is reflected diffusely, beside what lights give. docs/bake.md
struct LightMap {
  /// Linear light in a float picture; numbers 0 … 1 in others. `back`: of the side where corners run clockwise; unset: as
  /// the front.
  Texture front, back;
  float intensity = 1;  ///< 0 … kMaxRadiance
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// glTF 2.0 metallic-roughness. Factors are linear; textures multiply them.
struct Material {
  std::string name;
  glm::vec4 base_color{1};
  Texture base_color_texture;  ///< sRGB, alpha linear
  float metallic = 1, roughness = 1;
  Texture metallic_roughness_texture;  ///< linear; roughness in G, metallic in B
  Texture normal_texture;              ///< linear, tangent space
  float normal_scale = 1;
  Texture occlusion_texture;  ///< linear, R; scales ambient light only
  float occlusion_strength = 1;
  glm::vec3 emissive{0};     ///< radiance factor, KHR_materials_emissive_strength folded in
  Texture emissive_texture;  ///< sRGB
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5F;
  bool double_sided = false;
  bool unlit = false;                ///< KHR_materials_unlit: base colour is what is seen
  std::vector<SurfaceLayer> layers;  ///< at most kMaxSurfaceLayers
  LightMap light_map;
  /// Clear coats, sheen, glass and more; null: none. docs/materials.md
  std::shared_ptr<const MaterialLobes> lobes;
  std::shared_ptr<const Relief> relief;  ///< null: flat
  std::shared_ptr<const Mirror> mirror;  ///< null: it mirrors nothing but the environment
};

/// Triangles of one material. Attributes are empty or as long as `positions`.
struct Primitive {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;   ///< empty: flat normals are computed
  std::vector<glm::vec4> tangents;  ///< xyz, w = ±1 handedness; empty: computed where a normal map needs them
  std::array<std::vector<glm::vec2>, 2> uv;
  std::vector<glm::vec4> colors;       ///< linear, multiply the base colour
  std::vector<std::uint32_t> indices;  ///< three per triangle; empty: positions come in triples
  int material = -1;                   ///< −1: glTF's default material, white
  // How vertices move (laterna/animation.h). Normals and tangents move along, where they are given.
  std::vector<MorphTarget> targets;  ///< Node::weights says how far toward each
  /// Of each vertex in turn, the joints of the node's skin that pull it, and how much: as many as `influences` each. Weights
  /// are not negative and add up to 1.
  int influences = 0;
  std::vector<std::uint16_t> joints;
  std::vector<float> joint_weights;
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

// ---------------------------------------------------------------------------------------------- light

enum class LightType : std::uint8_t {
  directional,  ///< lux on a surface square to it, from infinitely far
  point,        ///< candela in every direction
  spot,         ///< candela within a cone
  projector,    ///< an image thrown through a frustum
};

/// How a projector's intensity depends on the direction, before the slide colours it (row 16).
enum class BeamProfile : std::uint8_t {
  flat_field,  ///< equal illuminance all over a square-on wall, as a slide projector's condenser is made to give
  uniform_candela,  ///< equal intensity in every direction: illuminance falls with cos³ on that wall
};

/// What a projector throws outside its slide (row 57).
enum class Outside : std::uint8_t { black, clamp, repeat, mirror };

/// How light fades with distance (row 19).
enum class Attenuation : std::uint8_t {
  inverse_square,  ///< 1/d², d the true distance
  gltf_windowed,   ///< 1/d² · clamp(1 − (d/range)⁴, 0, 1): KHR_lights_punctual with a range
  linear,          ///< clamp(1 − z/range, 0, 1), z along the axis
  none,            ///< 1
  custom,          ///< Light::custom_attenuation
};

/// What a light shines from. Without size it is a point and shadows are hard; with it `pcss`, and pictures that average
/// over the light (RenderSettings::accumulate), soften them.
struct LightSource {
  double radius = 0;             ///< metres, of a ball; point, spot, projector
  double width = 0, height = 0;  ///< metres, of a rectangle in the light's own plane, in place of the ball
  Angle angular_diameter;        ///< of a disc in the sky (the sun's: 0.53°); directional
  [[nodiscard]] bool has_size() const {
    return radius > 0 || width > 0 || height > 0 || angular_diameter.in_radians() > 0;
  }
};

/// Metres: nearer than this no projector is in focus.
inline constexpr double kNearestFocus = 1e-3;

/// How wide a projector's lens is open: a thin lens, whose every point throws the slide so that all meet at the focal
/// distance. Elsewhere, at distance d along the axis, a point of the slide is a disc of diameter 2 radius |d − focus| / focus
/// (row 13). docs/focus.md
struct Aperture {
  double radius = 0;  ///< metres; 0: a pinhole, sharp at all distances
  /// Metres along the axis from the lens to the plane on which the slide is sharp; infinity: far away.
  double focal_distance = std::numeric_limits<double>::infinity();
};

struct Light {
  std::string name;
  LightType type = LightType::point;
  bool enabled = true;
  glm::vec3 color{1};  ///< linear
  /// Candela (point, spot, projector: on the axis) or lux (directional); with a `distribution`, a factor on its candela.
  double intensity = 1;
  /// Luminous flux: of a projector's open frame, or of its whole intensity map; of a point light in all directions; of a
  /// spot's cone; of all of a `distribution`. Where set, `intensity` follows from it.
  std::optional<double> lumens;
  /// Point, spot: a measured lamp. Photometric zero is the light's −Z, C0 its +X, C90 its +Y. A spot's cone cuts it.
  std::shared_ptr<const LightDistribution> distribution;

  Attenuation attenuation = Attenuation::inverse_square;
  double range = std::numeric_limits<double>::infinity();  ///< metres; gltf_windowed and linear
  /// Row 19's hook: factor on the intensity as a function of z^t, the distance along the light's axis in metres
  /// (point lights: the distance). Called from several threads at once.
  std::function<float(float)> custom_attenuation;

  Angle inner_cone, outer_cone = Angle::degrees(45);  ///< spot: half angles

  // Projector; directional uses `projection` too when `fit` is false.
  Projection projection =
      Projection::perspective(Angle::degrees(40), 1, 0.1, std::numeric_limits<double>::infinity());
  bool aspect_from_slide = true;  ///< the frustum's width follows the slide's; yfov is kept
  int slide = -1;                 ///< index into Scene::pictures; −1: plain white
  /// The picture is an intensity map: linear, candela per direction in units of `intensity`; there is no `profile`.
  bool slide_is_intensity = false;
  BeamProfile profile = BeamProfile::flat_field;
  Outside outside = Outside::black;
  /// Projector: what a black pixel of the slide still throws, as a fraction of what a white one does: 1 over the contrast
  /// ratio. 0 … 1; not for intensity maps.
  double black_level = 0;
  /// Projector: pixels of its panel, for Layer::pixel_density. 0: the slide's.
  int panel_width = 0, panel_height = 0;
  /// Projector with perspective; the frame's shape must then be its own (`aspect_from_slide` false). `projection` is the
  /// frame as it would be thrown without.
  LensDistortion distortion;
  Aperture aperture;  ///< projector with perspective, in place of a `source` with a size
  /// Projector: what becomes of the light of those before it in the scene where it shines too. Not `over` nor
  /// `alpha_attenuate`. In every mode, its layer light.<name> is what it changes, which may be less than nothing.
  BlendMode blend = BlendMode::add;

  /// Directional: the shadow map's frustum is fitted to the scene; otherwise `projection` (orthographic) holds it.
  bool fit = true;

  LightSource source;
  ShadowSettings shadow;
};

/// Whether all its rays run the same way.
bool is_parallel(const Light& light);
/// Whether its light is held to the sides, near and far plane of its `projection`: projectors, and directional lights that
/// are not fitted to the scene. What is nearer to it than the near plane casts no shadow.
bool has_frustum(const Light& light);

/// Why a light of this kind cannot have its shadows found in this way, and what can; empty where it can.
std::string find_fault(ShadowTechnique technique, const Light& light);
/// The same of what its depths are compared by.
std::string find_fault(ShadowDepth depth, const Light& light);
/// Likewise its map's warp.
std::string find_fault(ShadowWarp warp, const Light& light);
/// Likewise its maps' layout.
std::string find_fault(ShadowLayout layout, const Light& light);

/// Half angle of the widest cone that one map holds, in degrees: beyond, a plane would spend its texels on the rim.
inline constexpr double kWidestSingleMap = 75;
/// Whether a shadow map of this light must hold directions to all sides.
bool shines_all_round(const Light& light);

// ---------------------------------------------------------------------------------------------- the scene

struct Camera {
  std::string name;
  Projection projection =
      Projection::perspective(Angle::degrees(45), 1, 0.1, std::numeric_limits<double>::infinity());
  /// The frustum's width follows the picture's aspect; otherwise a picture of another aspect shows more, never less.
  bool aspect_from_picture = true;
};

/// A place in the scene; parents come before or after their children, without cycles.
struct Node {
  std::string name;
  int parent = -1;
  glm::dmat4 parent_from_node{1.0};
  int mesh = -1, camera = -1, light = -1;      ///< indices into the scene's lists
  std::vector<glm::dmat4> node_from_instance;  ///< EXT_mesh_gpu_instancing; empty: the mesh once
  bool casts_shadow = true, receives_shadow = true;
  bool visible = true;         ///< to cameras; an invisible node may still cast
  std::vector<float> weights;  ///< of its mesh's morph targets; missing ones are 0
  int skin = -1;               ///< index into Scene::skins; its mesh is then placed by the joints alone
  /// What parent_from_node was made of; a node that clips move by parts needs it.
  std::optional<Transform> transform;
};

/// The `phong` model's highlight: k_s (n·h)^shininess, for every surface. Unset: from each material's roughness.
struct PhongHighlight {
  float specular = 0;
  float shininess = 32;
};

// ---------------------------------------------------------------------------------------------- environment

/// How far away what an environment shows is taken to be, when surfaces mirror it.
enum class EnvironmentDistance : std::uint8_t {
  infinite,  ///< the reflected direction alone decides (row 63)
  box,       ///< on the walls of a box: a probe of a room
  sphere,    ///< on a sphere
};

/// Light from all around: a picture of every direction. What it shows has the units of Scene::ambient, radiance: a white
/// matt surface in an environment of 1 everywhere is 1, in every model. Exactly one of `picture` and `specular_pictures`.
struct Environment {
  int picture = -1;  ///< index into Scene::pictures; linear where the file is HDR, EXR or PFM, else sRGB
  std::optional<EnvironmentChart> chart;  ///< of `picture`; unset: told from its shape
  /// EXT_lights_image_based: cube faces +X −X +Y −Y +Z −Z, as seen from inside, prefiltered for roughness 0 … 1 in equal
  /// steps; PNG with alpha is RGBD.
  std::vector<std::array<int, 6>> specular_pictures;
  /// Irradiance by spherical harmonics: L₀₀, L₁₋₁, L₁₀, L₁₁, L₂₋₂, L₂₋₁, L₂₀, L₂₁, L₂₂ in the basis of Ramamoorthi &
  /// Hanrahan 2001, each times its A_l. Unset: found from the picture.
  std::optional<std::array<glm::dvec3, 9>> irradiance;
  double intensity = 1;                    ///< factor on what the picture holds, not negative
  glm::dmat3 world_from_environment{1.0};  ///< a rotation
  bool visible = true;                     ///< behind the scene, over Scene::background
  EnvironmentDistance distance = EnvironmentDistance::infinite;
  glm::dvec3 center_ws{0};  ///< box, sphere: where the picture was taken from
  glm::dvec3 box_low_ws{-1},
      box_high_ws{1};  ///< box: its corners, along the world's axes; `center_ws` lies within
  double radius = 1;   ///< sphere: metres about `center_ws`
};

struct Scene {
  std::vector<Picture> pictures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<Node> nodes;
  glm::vec3 ambient{0};         ///< radiance from everywhere, multiplied by the base colour
  bool ambient_is_set = false;  ///< by a rig; otherwise the renderer may choose one for a scene without light
  std::optional<glm::vec3> background;  ///< linear radiance; unset: black, alpha 0
  std::optional<PhongHighlight> phong;
  std::optional<Environment> environment;
  std::vector<Photograph> photographs;  ///< where there are any, surfaces show their colours
  PhotographSettings photograph_settings;
  std::vector<Skin> skins;
  std::vector<Clip> clips;  ///< of files, the first of each plays; later ones win where two move the same
  std::vector<Diagnostic> warnings;  ///< what was left out or guessed while reading
};

struct LoadOptions {
  enum class Up { y, z } up = Up::y;  ///< for formats that do not say
  double metres_per_unit = 1;         ///< for formats that do not say
  /// Further files, merged: a glTF that holds only lights and cameras is a lighting set.
  std::vector<std::filesystem::path> rigs;
};

/// Reads glTF 2.0 / GLB, OBJ, PLY, STL, MD2 and whatever else Assimp reads, and merges several files into one scene.
/// A second directional light, camera and so on of the same name is renamed ("sun.2") with a warning.
/// Errors name the file and the place in it. The result has passed validate().
Result<Scene> load_scene(const std::vector<std::filesystem::path>& files, const LoadOptions& options = {});

/// Limits of one scene. Corners of triangles (3 · 2^28) and vertices are counted in 32 bits; as many vertices already
/// take 10 GB. A triangle that an instanced mesh shows a thousand times counts a thousand times in kMaxPlacedTriangles.
inline constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 28;
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 28;
inline constexpr std::uint64_t kMaxPlacedTriangles = std::uint64_t{1} << 31;
/// Metres from the origin, of any surface, camera or light. Beyond, single precision has lost all detail.
inline constexpr double kMaxCoordinate = 1e9;
/// What is wrong with a pose: not finite, too far out, or its columns are no right-handed rotation. Or an empty string.
std::string find_fault(const Pose& pose);
/// Largest factor or component of a colour or radiance: products of three stay finite in single precision.
inline constexpr double kMaxRadiance = 1e12;

/// Every fault of a scene: indices out of range, node cycles, attributes of unequal length, values not finite,
/// frustums that are no frustums. Empty when it can be rendered.
std::vector<Diagnostic> validate(const Scene& scene);

/// world_from_node of every node. The scene must have passed validate().
std::vector<glm::dmat4> world_from_nodes(const Scene& scene);

/// A node that holds a camera or light, or −1. Names are unique after load_scene.
int find_camera_node(const Scene& scene, const std::string& name);
int find_light_node(const Scene& scene, const std::string& name);

}  // namespace laterna
