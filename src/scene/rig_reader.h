// Rigs: cameras, lights and a few settings for people who type. JSON, degrees, look-at vectors; every fault
// names its key and line.
//
//   { "ambient": [r, g, b], "background": [r, g, b], "shading": {"specular": 0.2, "shininess": 32},
//     "cameras": [{"name", "position", "target", "up", a frustum}],
//     "lights":  [{"name", "type", "position", "target", "up", "color", "enabled", "shadow", …}],
//     "nodes":   [{"name", "casts_shadow", "receives_shadow", "visible"}],
//     "terrain": [{"name", "heights", "size", "height", "position", "error", "color", "roughness", "texture", "texture_repeat"}],
//     "surfaces": [{"material" or "node", "layers": [{"texture" or "slide", "blend", "color", "opacity", …}]}] }
//
// A frustum: one of "yfov_deg", "hfov_deg" (with "aspect"), "intrinsics": {"fx", "fy", "cx", "cy", "width",
// "height"}, "orthographic": {"height"}; "aspect" (width / height), "near", "far". Lights by "type":
//   directional  "lux"; "half_width", "half_height", "near", "far": the shadow map's box, otherwise fitted
//   point        "candela" or "lumens", "range", "attenuation"; "ies" with "scale" or "lumens", "target", "up"
//   spot         the same; "inner_cone_deg", "outer_cone_deg" (half angles)
//   projector    "candela" or "lumens", "slide" or "intensity_map", a frustum, "profile", "outside", "range",
//                "attenuation", "black_level", "pixels", "blend"
// All: "color" or "color_temperature", "filter", "gel".
// "attenuation": none, linear, inverse_square, gltf_windowed; a "range" alone means gltf_windowed.
// "shadow": true, false or {"technique", "resolution", "filter", "kernel", "constant_bias", "slope_bias",
// "caster_faces", "outside"}.
// "up" is (0, 1, 0) unless given; without it, who looks straight up or down has −Z (down) or +Z (up) as up.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/scene.h"
#include "scene/merge.h"

namespace laterna {

struct Rig {
  Scene scene;  ///< cameras, lights, terrain and their nodes
  std::vector<NodeOverride> overrides;
  std::vector<SurfaceOverride> surfaces;  ///< their pictures and projectors are the scene's
};

/// `file` stands in messages; slides are looked for in `folder`.
Result<Rig> read_rig(std::string_view text, const std::string& file, const std::filesystem::path& folder);

}  // namespace laterna
