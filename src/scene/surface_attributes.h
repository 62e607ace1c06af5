// Completes a primitive's attributes to what its material needs, whatever format it came from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "laterna/scene.h"
#include "scene/fault_list.h"

namespace laterna {

/// Fills in texture coordinates that the material's textures use (zero, with a warning), repairs normals and
/// tangents without length, and computes tangents where the material needs them. Without normals: flat ones, or
/// smooth ones up to `crease`. `place` is the primitive's, for warnings.
void complete_attributes(Primitive& primitive, const Material* material, std::optional<Angle> crease,
                         const std::string& place, FaultList& faults);

/// The same of a primitive without normals whose vertices move: it stays without, so that its flat normals are those of its
/// triangles as they then lie, unless a normal map needs some.
void complete_moving_attributes(Primitive& primitive, const Material* material, const std::string& place,
                                FaultList& faults);

/// The texture coordinates that tangents run along, where a material's maps or brushed lobes need tangents.
std::optional<int> tangent_uv_set(const Material& material);

/// The textures of a material, in a fixed order: its own, then its lobes' and its layers'.
std::vector<const Texture*> textures_of(const Material& material);

}  // namespace laterna
