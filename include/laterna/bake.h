// Light baked into pictures: what falls on every surface, found once and kept in light maps (laterna bake). docs/bake.md
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "laterna/radiosity.h"
#include "laterna/render.h"

namespace laterna {

/// Limits of BakeSettings.
inline constexpr double kLeastLuxelDensity = 1e-3, kMostLuxelDensity = 1e5;
inline constexpr int kLeastLightMapSide = 16, kMostLightMapSide = 16384;
inline constexpr int kMostLuxelSamples = 16, kMostLuxelPadding = 64;
inline constexpr int kMostOcclusionRays = 65536;
/// Of all light maps of a scene together.
inline constexpr std::size_t kMostLuxels = std::size_t{1} << 28;
/// Pictures of light for a scene; the backs of double-sided surfaces are not counted.
inline constexpr std::size_t kMostLightMaps = 4096;

/// Where the light goes.
enum class BakeInto : std::uint8_t {
  light_maps,  ///< LightMap of materials: seen by Laterna alone, in every exposure, with the colours of textures
  /// Colours times light in emissive textures, 8-bit, as fine as luxels: seen by every program that reads glTF. Ambient light,
  /// the environment's diffuse light and layers are in them. These surfaces reflect nothing any more.
  emissive,
};

/// What a bake is at, in this order.
enum class BakeStage : std::uint8_t { layout, direct_light, reflected_light };

struct BakeSettings {
  double density = 16;  ///< luxels per metre of the world
  int max_size = 2048;  ///< largest side of a light map, in luxels
  int padding =
      2;  ///< luxels between neighbours in a light map, at least 1; they continue the nearest surface
  /// Positions in each luxel, samples × samples, whose mean it is; those that lie beside the surface, or behind a wall as seen
  /// from the luxel's middle, are left out. 1: its middle alone.
  int samples = 2;
  /// Lights that have a size, and lenses that are open: the mean over this many of their points. 1 … kMaxAccumulated.
  int light_samples = 16;
  /// How what surfaces reflect onto each other is found; unset: light maps hold the direct light alone.
  std::optional<RadiositySettings> interreflection;
  /// Rays to all sides, by the cosine of their angle, that find how much of the ambient light arrives; 0: none is looked for.
  int occlusion_rays = 0;
  double occlusion_distance =
      std::numeric_limits<double>::infinity();  ///< metres: what is farther away hides nothing
  /// Where a smooth surface is cut open for its light map, luxels on both sides are changed until they read alike, by as little as it takes.
  bool join_seams = true;
  bool unwrap_all = false;  ///< surfaces are laid out anew even where their second texture coordinates serve
  BakeInto into = BakeInto::light_maps;
  /// BakeInto::emissive: factor on radiance, such that 1 is a viewer's white; of the whole scene, the environment and what is
  /// not baked included. 0: automatic_exposure() over all luxels.
  float exposure = 0;
  std::vector<std::string> lights;  ///< to be baked, by name; empty: all that are on and add their light
  bool keep_lights = false;  ///< those that were baked stay, and shine as well; not with BakeInto::emissive
  RendererOptions options;   ///< threads, instruction set
  /// Finished parts are kept in files beside this one as they come ("room.glb.bake-0-3"), each whole or absent, until
  /// remove_bake_parts(). Empty: nowhere.
  std::filesystem::path work_file;
  bool resume = false;  ///< parts of the same scene and settings that are there are taken as they are
  std::function<void(BakeStage)> stage_begins;  ///< from the thread that calls bake_light()
};

struct BakeReport {
  struct Page {
    int width = 0, height = 0;
    bool has_back = false;  ///< another picture for the backs of double-sided surfaces
  };
  std::vector<Page> pages;
  std::size_t surfaces = 0;        ///< instances of primitives that have got light maps
  std::size_t charts = 0;          ///< pieces that lie flat in them
  std::size_t luxels = 0;          ///< of all pages
  std::size_t lit_luxels = 0;      ///< of these, on a surface or read at its rim
  std::size_t padding_luxels = 0;  ///< that continue a surface
  double used = 0;                 ///< surfaces' share of the pages' area
  /// Luxels per metre in any direction on any triangle but the thin ones, which are less than a hundredth of a luxel high:
  /// rounding tells on theirs.
  double least_density = 0, greatest_density = 0;
  std::size_t thin_triangles = 0;
  std::size_t bytes = 0;  ///< of the light maps in memory, and of occlusion
  std::size_t parts = 0,
              resumed_parts = 0;  ///< in which the work was done, and those that were there already
  double layout_ms = 0, light_ms = 0;
  float exposure = 0;               ///< that BakeInto::emissive was given, or has found
  int bounces = 0;                  ///< of interreflection, that were worked out
  std::vector<std::string> lights;  ///< that were baked
};

struct BakedScene {
  /// Instances have become meshes of their own, whose second texture coordinates are their places in the light maps;
  /// materials have light maps (LightMap) or shine, and occlusion textures where it was looked for; baked lights are gone. An instant:
  /// without clips. scene.warnings has what could not be baked.
  Scene scene;
  BakeReport report;
};

/// Bakes the direct light of a scene, as it is posed now, with shadows by rays. What arrives at a luxel is what
/// Renderer would find there with ShadowTechnique::raytraced, whatever the lights' own techniques, n·l of the surface's
/// normals included (normal maps not); with
/// BakeSettings::interreflection, what surfaces reflect onto each other as well. What wears a skin or morphs is baked as it
/// stands, and stays so. Surfaces that are not baked, with a warning: those whose textures use both sets of texture coordinates,
/// where the second does not serve for light maps; glass. Those without a light to reflect (unlit) need none.
/// The environment stays in the scene, and lights it beside light maps; filter_environment() makes it such as files can hold.
/// The result depends on neither threads nor instruction set. `progress` may stop it: Failure::cancelled.
/// Errors: a faulty setting or scene, a light that is not there, more than kMostLuxels or kMostLightMaps; with
/// BakeInto::emissive, a light that is on and not among those to be baked.
Result<BakedScene> bake_light(Scene scene, const BakeSettings& settings, const Progress& progress = {});

/// Removes the finished parts of any bake of this file, stopped ones of other settings too: after what was baked is written.
void remove_bake_parts(const std::filesystem::path& work_file);

}  // namespace laterna
