// Lobes of a surface's reflection, with their pictures found.
#pragma once

#include <array>
#include <memory>

#include "frame/frame.h"
#include "laterna/material_lobes.h"

namespace laterna::frame {

struct SurfaceLobes {
  MaterialLobes values;  ///< its textures play no part: they are bound below
  TextureBinding specular, specular_color;
  TextureBinding clearcoat, clearcoat_roughness, clearcoat_normal;
  TextureBinding sheen_color, sheen_roughness;
  TextureBinding anisotropy;
  TextureBinding iridescence, iridescence_thickness;
  TextureBinding transmission, thickness;
  bool has_clearcoat = false, has_sheen = false, has_anisotropy = false, has_iridescence = false,
       has_transmission = false;
};

/// Null where they change nothing.
std::shared_ptr<const SurfaceLobes> bind_lobes(const MaterialLobes& lobes, const TextureLibrary& library);

/// How a picture is kept for each of a material's lobes: textures_of(MaterialLobes)'s order.
extern const std::array<image::MipUse, kLobeTextures> kLobeTextureUses;

/// Whether a lobe shows, now or at another time: its factor or colour is not 0, or a clip moves it.
bool may_show(const Scene& scene, int material, AnimatedProperty factor);
/// Of any material.
bool may_show(const Scene& scene, AnimatedProperty factor);

}  // namespace laterna::frame
