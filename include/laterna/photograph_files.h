// Photographs with their cameras, from the files of photogrammetry. Formats and conventions: docs/photographs.md.
#pragma once

#include <filesystem>

#include "laterna/result.h"
#include "laterna/scene.h"

namespace laterna {

struct PhotographFiles {
  /// COLMAP's cameras.txt or images.txt, or the folder of both; a glTF scene; OpenCV's parameters as JSON or YAML; or a folder
  /// of one camera file per photograph (.cam, _cam.txt, .json, .yml, .yaml).
  std::filesystem::path cameras;
  /// A folder of pictures, searched with all its folders.
  std::filesystem::path photos;
  /// How the cameras' world lies: as the mesh's.
  LoadOptions::Up up = LoadOptions::Up::y;
  double metres_per_unit = 1;
  /// Cameras without a photograph, and photographs without a camera, are left out with a warning instead of refused.
  bool skips_missing = false;
  int threads = 0;  ///< for removing lens distortion; 0: one per processor
};

/// At most so many cameras in one set.
inline constexpr std::size_t kMaxPhotographs = 10'000;

/// Appends the photographs, named as their cameras name them, and their pictures. Lens distortion is removed here: pictures
/// become a pinhole's, masked where the lens saw nothing. What is left out is told in Scene::warnings.
/// Errors name the file and the place: a camera without its photograph, a photograph without its camera, a shape that is not
/// the camera's, distortion that cannot be inverted, and whatever a format can have wrong.
Result<void> add_photographs(Scene& scene, const PhotographFiles& files);

}  // namespace laterna
