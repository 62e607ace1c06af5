// OBJ with MTL, PLY, STL, MD2's first frame, and whatever else Assimp reads, as a scene.
#pragma once

#include <filesystem>
#include <string>

#include "laterna/scene.h"

namespace laterna {

/// Faces bent more than this at a shared edge keep a sharp edge where a file has no normals: between the 45°
/// of an eight-sided column, which is meant to be round, and the 60° of a hexagonal one, which is not.
inline constexpr double kCreaseDegrees = 50;

/// Largest file handed to Assimp.
inline constexpr std::uintmax_t kMaxMeshFileBytes = std::uintmax_t{1} << 31;

/// Whether Assimp has a reader for files with this ending.
bool can_read_mesh_file(const std::filesystem::path& file);

/// `options.up` and `metres_per_unit` apply to every format but COLLADA and FBX, which say both themselves,
/// and MD2, which is Z-up by definition. Colours are taken as sRGB, as the dialogs that made them showed
/// them. A missing material library is a warning, a missing texture an error (a warning for MD2, whose skins
/// rarely travel along).
Result<Scene> read_mesh_file(const std::filesystem::path& file, const LoadOptions& options);

}  // namespace laterna
