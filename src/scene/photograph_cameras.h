// Cameras of photographs, as files of several kinds have them, in one form.
#pragma once

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/camera_distortion.h"
#include "laterna/scene.h"
#include "scene/fault_list.h"

namespace laterna {

/// Focal lengths and principal point. (0, 0) is the top-left corner of the picture.
struct Intrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  /// Of the picture that these are for; 0: whatever the photograph's is.
  double width = 0, height = 0;
  /// fx and fy in units of the picture's longer side, cx and cy of its width and height; otherwise pixels.
  bool is_relative = false;
};

struct PhotographCamera {
  std::string photo;  ///< as the file names it, perhaps without a folder or an ending
  std::string place;  ///< in the file, for messages
  std::string file;
  Pose pose;
  Intrinsics intrinsics;
  CameraDistortion distortion;
  /// In place of the intrinsics; its width follows the photograph's where `aspect_from_picture` is set.
  std::optional<Projection> projection;
  bool aspect_from_picture = false;
};

/// From the rotation and position of a camera that looks along +Z with +Y downward: x_camera = R (x_world − C). Rows may be off
/// by what few digits leave. Nothing where they are no rotation.
std::optional<Pose> pose_from_camera(const glm::dmat3& camera_from_world, const glm::dvec3& position_ws);
/// The same from x_camera = R x_world + t.
std::optional<Pose> pose_from_translation(const glm::dmat3& camera_from_world, const glm::dvec3& translation);
/// The rotation of a unit quaternion, of any length but 0. Row by row of the matrix, as GLM's columns of its transpose.
std::optional<glm::dmat3> rotation_from_quaternion(double w, double x, double y, double z);
/// Rodrigues' formula: by |r| radians about r.
glm::dmat3 rotation_from_vector(const glm::dvec3& r);

/// COLMAP's text files, "Output Format" of its documentation. The texts of cameras.txt and images.txt.
std::vector<PhotographCamera> read_colmap_cameras(std::string_view cameras, std::string_view images,
                                                  FaultList& camera_faults, FaultList& image_faults);
/// One camera: MVE's .cam (as texrecon reads it), or the _cam.txt of MVSNet and OpenMVS ("extrinsic", "intrinsic").
std::vector<PhotographCamera> read_cam_file(std::string_view text, const std::string& photo,
                                            FaultList& faults);
/// OpenCV's names in JSON: one camera, or a list "cameras". `photo`: of a camera that does not say.
std::vector<PhotographCamera> read_opencv_cameras(std::string_view json, const std::string& photo,
                                                  FaultList& faults);
/// The cameras of a scene, by their nodes' names or their own.
std::vector<PhotographCamera> cameras_of_scene(const Scene& scene, const std::string& file);

/// Whatever kind of file or folder it is.
Result<std::vector<PhotographCamera>> read_photograph_cameras(const std::filesystem::path& path);

}  // namespace laterna
