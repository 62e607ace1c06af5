// How a scene moves: clips of key frames, skins, morph targets. glTF 2.0 names and meanings throughout.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "laterna/film.h"
#include "laterna/result.h"

namespace laterna {

struct Scene;

/// Translation · rotation · scale: what a node's matrix is made of.
struct Transform {
  glm::dvec3 translation{0};        ///< metres
  glm::dvec4 rotation{0, 0, 0, 1};  ///< unit quaternion x, y, z, w
  glm::dvec3 scale{1};
};
glm::dmat4 to_matrix(const Transform& transform);

/// A shape that a primitive's vertices can be drawn toward: displacements at weight 1. Empty, or one for each vertex.
struct MorphTarget {
  std::vector<glm::vec3> positions, normals, tangents;
};

/// Bones that pull vertices along: a vertex stands at Σ weight · world_from_joint · joint_from_bind · position. The node that
/// wears the skin has no say in it.
struct Skin {
  std::string name;
  std::vector<int> joints;                  ///< indices into Scene::nodes
  std::vector<glm::dmat4> joint_from_bind;  ///< "inverse bind matrices", one for each joint
};

/// How values run between two key frames.
enum class KeyInterpolation : std::uint8_t {
  step,          ///< the earlier key's, until the next
  linear,        ///< straight; rotations along the shorter arc at even speed (slerp)
  cubic_spline,  ///< Hermite's cubic through the keys, with slopes per second before and after each
};

/// Values at times. Before the first key its values hold, after the last one its.
struct KeyFrames {
  KeyInterpolation interpolation = KeyInterpolation::linear;
  std::vector<double> times;   ///< seconds, none before the one before it
  std::vector<double> values;  ///< of each key in turn; cubic_spline: slope before, value, slope after
};

/// What a channel moves, and what its numbers are.
enum class AnimatedProperty : std::uint8_t {
  // Of a node:
  translation,  ///< 3, metres
  rotation,     ///< 4, quaternion x, y, z, w; brought to unit length
  scale,        ///< 3
  weights,      ///< one for each morph target of its mesh
  look_at,      ///< 9: position, target, up; metres. In place of all three above
  // Of a camera, or of a light that is a projector:
  yfov,      ///< radians; the frustum's other sides follow in proportion
  aspect,    ///< width over height
  x_extent,  ///< half the width of an orthographic frustum, metres
  y_extent,  ///< half its height
  near,      ///< metres
  far,       ///< metres
  // Of a light:
  light_color,  ///< 3, linear
  intensity,    ///< candela or lux
  lumens,
  range,       ///< metres
  inner_cone,  ///< radians
  outer_cone,  ///< radians
  // Of a material:
  base_color,  ///< 4, linear
  metallic,
  roughness,
  emissive,           ///< 3
  emissive_strength,  ///< a factor on `emissive` of an earlier channel
  alpha_cutoff,
  normal_scale,
  occlusion_strength,
  // Of its lobes (laterna/material_lobes.h):
  ior,
  specular,
  specular_color,  ///< 3
  clearcoat,
  clearcoat_roughness,
  clearcoat_normal_scale,
  sheen_color,  ///< 3
  sheen_roughness,
  anisotropy_strength,
  anisotropy_rotation,  ///< radians
  iridescence,
  iridescence_ior,
  iridescence_thickness_minimum,  ///< nanometres
  iridescence_thickness_maximum,  ///< nanometres
  transmission,
  thickness,
  attenuation_distance,  ///< metres
  attenuation_color,     ///< 3
  // Of a material's texture number `texture`; each is multiplied on what channels before it gave, the first sets it anew:
  texture_offset,    ///< 2
  texture_rotation,  ///< radians
  texture_scale,     ///< 2
};

struct ClipChannel {
  AnimatedProperty property = AnimatedProperty::translation;
  int target = -1;        ///< index into the scene's nodes, cameras, lights or materials
  bool of_light = false;  ///< yfov, aspect, extents, near, far: of a projector, not of a camera
  /// 0 base colour, 1 metallic-roughness, 2 normal, 3 occlusion, 4 emissive; then those of its lobes.
  int texture = 0;
  int keys = -1;  ///< index into Clip::keys
};

/// Movements that play together.
struct Clip {
  std::string name;
  bool plays = true;
  /// What follows after the last key of all: loop, hold or ping_pong. Time 0 is the start, whenever the first key comes.
  AtEnd at_end = AtEnd::loop;
  /// A path that a rig gives: it plays whatever clip is chosen.
  bool is_path = false;
  std::vector<KeyFrames> keys;
  std::vector<ClipChannel> channels;
};

/// Seconds to the last key of a clip.
double duration(const Clip& clip);
/// Numbers of one key of this property; 0: as many as there are morph targets.
int component_count(AnimatedProperty property);

/// Puts everything that clips move where it is at a time in seconds, once: the clips stay. The scene must have passed validate(),
/// and be at rest. Vertices that skins and morph targets move are left to what draws them.
void pose_scene(Scene& scene, double seconds);

/// Lets clips of this name play and no others, "all": all, "none": none; paths go on. Error: no clip has that name; lists those there are.
Result<void> choose_clip(Scene& scene, const std::string& name);

/// Limits of one scene: numbers of key frames, and displaced vertices of morph targets.
inline constexpr std::uint64_t kMaxKeyNumbers = std::uint64_t{1} << 27;
inline constexpr std::uint64_t kMaxMorphedVertices = std::uint64_t{1} << 28;
inline constexpr std::uint64_t kMaxInfluences = std::uint64_t{1} << 28;
inline constexpr std::size_t kMaxMorphTargets = 4096;

}  // namespace laterna
