#include "scene/photograph_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/file_io.h"
#include "base/lower_case.h"
#include "laterna/photograph_files.h"
#include "scene/opencv_yaml.h"

namespace laterna {
namespace {

using Path = std::filesystem::path;

enum class Kind : std::uint8_t { unknown, colmap, gltf, cam, json, yaml };

Kind kind_of(const Path& file) {
  const std::string name = lower_case(file.filename().string());
  const std::string ending = lower_case(file.extension().string());
  if (name == "cameras.txt" || name == "images.txt") return Kind::colmap;
  if (ending == ".gltf" || ending == ".glb") return Kind::gltf;
  if (ending == ".cam" || name.ends_with("_cam.txt")) return Kind::cam;
  if (ending == ".json") return Kind::json;
  return ending == ".yml" || ending == ".yaml" ? Kind::yaml : Kind::unknown;
}

// "00012_cam.txt" and "00012.cam" belong to the photograph "00012".
std::string photo_of(const Path& camera_file) {
  std::string stem = camera_file.stem().string();
  if (lower_case(camera_file.filename().string()).ends_with("_cam.txt")) stem.resize(stem.size() - 4);
  return stem;
}

tl::unexpected<Error> fault(const Path& file, std::string message) {
  return tl::unexpected(Error(Failure::bad_input, Diagnostic{file.string(), {}, std::move(message)}));
}

Result<std::string> read_text(const Path& file) {
  return read_file(file).map([](const std::vector<std::byte>& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  });
}

using Cameras = std::vector<PhotographCamera>;

Result<Cameras> finish(Cameras cameras, const FaultList& faults) {
  if (faults.has_errors()) return tl::unexpected(Error(Failure::bad_input, faults.errors()));
  for (PhotographCamera& camera : cameras) camera.file = faults.file();
  return cameras;
}

Result<Cameras> read_colmap(const Path& folder) {
  const Path camera_file = folder / "cameras.txt", image_file = folder / "images.txt";
  const Result<std::string> cameras = read_text(camera_file);
  if (!cameras) return tl::unexpected(cameras.error());
  const Result<std::string> images = read_text(image_file);
  if (!images) return tl::unexpected(images.error());
  FaultList camera_faults(camera_file.string()), image_faults(image_file.string());
  Cameras found = read_colmap_cameras(*cameras, *images, camera_faults, image_faults);
  if (camera_faults.has_errors()) return finish({}, camera_faults);
  return finish(std::move(found), image_faults);
}

Result<Cameras> read_scene_cameras(const Path& file) {
  const Result<Scene> scene = load_scene({file});
  if (!scene) return tl::unexpected(scene.error());
  Cameras cameras = cameras_of_scene(*scene, file.string());
  if (cameras.empty()) return fault(file, "has no camera");
  return cameras;
}

Result<Cameras> read_one_file(const Path& file) {
  const Kind kind = kind_of(file);
  if (kind == Kind::colmap) return read_colmap(file.parent_path());
  if (kind == Kind::gltf) return read_scene_cameras(file);
  const Result<std::string> text = read_text(file);
  if (!text) return tl::unexpected(text.error());
  FaultList faults(file.string());
  switch (kind) {
    case Kind::cam:
      return finish(read_cam_file(*text, photo_of(file), faults), faults);
    case Kind::json:
      return finish(read_opencv_cameras(*text, photo_of(file), faults), faults);
    case Kind::yaml: {
      const std::optional<std::string> json = json_from_opencv_yaml(*text, faults);
      return finish(json ? read_opencv_cameras(*json, photo_of(file), faults) : Cameras(), faults);
    }
    default:
      return fault(
          file,
          "is no file of cameras that is read; expected cameras.txt or images.txt (COLMAP), .gltf, .glb, "
          ".json, .yml, .yaml, .cam or _cam.txt");
  }
}

Result<Cameras> read_folder(const Path& folder) {
  std::error_code fault_code;
  if (std::filesystem::exists(folder / "images.txt", fault_code)) return read_colmap(folder);
  if (std::filesystem::exists(folder / "images.bin", fault_code)) {
    return fault(folder,
                 "holds COLMAP's binary files; write text with: colmap model_converter --output_type TXT");
  }
  std::vector<Path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, fault_code)) {
    const Kind kind = kind_of(entry.path());
    if (kind != Kind::unknown && kind != Kind::gltf) files.push_back(entry.path());
  }
  if (fault_code) return fault(folder, fault_code.message());
  if (files.empty())
    return fault(folder, "holds no file of cameras: no images.txt, .cam, _cam.txt, .json, .yml or .yaml");
  if (files.size() > kMaxPhotographs)
    return fault(
        folder, fmt::format("holds {} files of cameras; at most {} are read", files.size(), kMaxPhotographs));
  std::sort(files.begin(), files.end());
  Cameras all;
  Error error;
  for (const Path& file : files) {
    Result<Cameras> cameras = read_one_file(file);
    if (cameras) {
      all.insert(all.end(), cameras->begin(), cameras->end());
    } else {
      const std::vector<Diagnostic>& faults = cameras.error().diagnostics;
      error.diagnostics.insert(error.diagnostics.end(), faults.begin(), faults.end());
    }
  }
  if (!error.diagnostics.empty()) return tl::unexpected(std::move(error));
  return all;
}

}  // namespace

std::vector<PhotographCamera> cameras_of_scene(const Scene& scene, const std::string& file) {
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene);
  Cameras cameras;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].camera < 0) continue;
    const Camera& camera = scene.cameras[static_cast<std::size_t>(scene.nodes[i].camera)];
    const Result<Pose> pose = Pose::from_matrix(world_from_node[i]);
    if (!pose) continue;  // validate() has refused such a scene
    PhotographCamera found;
    found.photo = camera.name;
    found.place = fmt::format("camera \"{}\"", camera.name);
    found.file = file;
    found.pose = *pose;
    found.projection = camera.projection;
    found.aspect_from_picture = camera.aspect_from_picture;
    cameras.push_back(std::move(found));
  }
  return cameras;
}

Result<std::vector<PhotographCamera>> read_photograph_cameras(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return fault(path, "no such file or folder");
  return std::filesystem::is_directory(path, ignored) ? read_folder(path) : read_one_file(path);
}

}  // namespace laterna
