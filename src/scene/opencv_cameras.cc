// Cameras by OpenCV's names, in JSON: what its calibration writes ("camera_matrix", "dist_coeffs"), with a pose per photograph
// ("rvec" and "tvec", or "R" and "t", or "R" and "C"). The world to the camera, +Y down, +Z forward; the centre of the top-left
// pixel at (0, 0). Other members are whatever else a program keeps there.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/matrix.hpp>

#include "laterna/photograph_files.h"
#include "scene/json_document.h"
#include "scene/photograph_cameras.h"
#include "scene/spelling.h"

namespace laterna {
namespace {

// One of several names that programs use for the same; null where there is none.
const JsonValue* find_any(const JsonValue& object, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    if (const JsonValue* found = object.find(name)) return found;
  }
  return nullptr;
}

// Numbers, however they are nested.
bool flatten(const JsonValue& value, std::vector<double>& numbers, int depth = 0) {
  if (value.kind == JsonValue::Kind::number) {
    numbers.push_back(value.number);
    return true;
  }
  if (!value.is_array() || depth > 2) return false;
  for (const JsonValue& child : value.children) {
    if (!flatten(child, numbers, depth + 1)) return false;
  }
  return true;
}

class CameraReader {
 public:
  CameraReader(const JsonDocument& json, FaultList& faults) : json_(json), faults_(faults) {}

  // `common`: what all cameras share; may be the same object.
  std::optional<PhotographCamera> read(const JsonValue& object, const JsonValue& common,
                                       const std::string& photo) {
    const std::size_t errors_before = faults_.error_count();
    PhotographCamera camera;
    camera.photo = photo;
    camera.place = json_.place(object);
    if (!object.is_object()) {
      faults_.error(json_.place(object), fmt::format("expected an object, got {}", describe(object)));
      return std::nullopt;
    }
    if (const JsonValue* name = find_any(object, {"image", "photo", "file_path", "image_name"})) {
      camera.place = json_.place(*name);
      camera.photo = name->text;
    }
    if (camera.photo.empty()) faults_.error(camera.place, "needs \"image\": the photograph's file name");
    const auto from = [&](std::initializer_list<std::string_view> names) {
      const JsonValue* own = find_any(object, names);
      return own != nullptr ? own : find_any(common, names);
    };
    read_size(from({"image_size"}), from({"image_width", "width"}), from({"image_height", "height"}),
              camera.intrinsics);
    read_intrinsics(object, from, camera.intrinsics);
    read_distortion(from({"dist_coeffs", "distortion_coefficients", "distortion"}), camera.distortion);
    read_pose(object, camera.pose);
    if (faults_.error_count() != errors_before) return std::nullopt;
    return camera;
  }

 private:
  // Nothing, with a message, unless there are so many numbers.
  std::optional<std::vector<double>> numbers(const JsonValue& value,
                                             std::initializer_list<std::size_t> counts) {
    const JsonValue* list = value.is_object() ? value.find("data") : &value;  // an OpenCV matrix
    std::vector<double> found;
    const bool are_numbers = list != nullptr && flatten(*list, found);
    for (const std::size_t count : counts) {
      if (are_numbers && found.size() == count) return found;
    }
    std::string expected;
    for (const std::size_t count : counts)
      expected += fmt::format("{}{}", expected.empty() ? "" : " or ", count);
    faults_.error(json_.place(value),
                  fmt::format("expected {} numbers, got {}", expected,
                              are_numbers ? std::to_string(found.size()) : describe(value)));
    return std::nullopt;
  }

  std::optional<double> number(const JsonValue& value) {
    if (value.kind == JsonValue::Kind::number) return value.number;
    faults_.error(json_.place(value), fmt::format("expected a number, got {}", describe(value)));
    return std::nullopt;
  }

  void read_size(const JsonValue* size, const JsonValue* width, const JsonValue* height,
                 Intrinsics& intrinsics) {
    if (size != nullptr) {
      if (const auto both = numbers(*size, {2}))
        intrinsics.width = (*both)[0], intrinsics.height = (*both)[1];
      return;
    }
    if (width != nullptr) intrinsics.width = number(*width).value_or(0);
    if (height != nullptr) intrinsics.height = number(*height).value_or(0);
  }

  template <class From>
  void read_intrinsics(const JsonValue& object, const From& from, Intrinsics& intrinsics) {
    if (const JsonValue* matrix = from({"camera_matrix", "cameraMatrix", "K"})) {
      const auto k = numbers(*matrix, {9});
      if (!k) return;
      intrinsics.fx = (*k)[0], intrinsics.fy = (*k)[4];
      intrinsics.cx = (*k)[2] + 0.5, intrinsics.cy = (*k)[5] + 0.5;
      return;
    }
    const JsonValue* fx = from({"fx"});
    const JsonValue* fy = from({"fy"});
    const JsonValue* cx = from({"cx"});
    const JsonValue* cy = from({"cy"});
    if (fx == nullptr || fy == nullptr || cx == nullptr || cy == nullptr) {
      faults_.error(json_.place(object), "needs \"camera_matrix\", or \"fx\", \"fy\", \"cx\" and \"cy\"");
      return;
    }
    intrinsics.fx = number(*fx).value_or(0), intrinsics.fy = number(*fy).value_or(0);
    intrinsics.cx = number(*cx).value_or(0) + 0.5, intrinsics.cy = number(*cy).value_or(0) + 0.5;
  }

  // k1 k2 p1 p2 [k3 [k4 k5 k6]], OpenCV's order.
  void read_distortion(const JsonValue* value, CameraDistortion& distortion) {
    if (value == nullptr) return;
    const auto d = numbers(*value, {4, 5, 8, 0});
    if (!d || d->empty()) return;
    distortion.k[0] = (*d)[0], distortion.k[1] = (*d)[1];
    distortion.p = {(*d)[2], (*d)[3]};
    for (std::size_t i = 4; i < d->size(); ++i) distortion.k[i - 2] = (*d)[i];
  }

  void read_pose(const JsonValue& object, Pose& pose) {
    const JsonValue* vector = object.find("rvec");
    const JsonValue* matrix = find_any(object, {"R", "rotation"});
    const JsonValue* translation = find_any(object, {"tvec", "t", "translation"});
    const JsonValue* centre = find_any(object, {"C", "center", "centre"});
    if ((vector == nullptr && matrix == nullptr) || (translation == nullptr && centre == nullptr)) {
      faults_.error(json_.place(object),
                    "needs \"rvec\" or \"R\", and \"tvec\", \"t\" or \"C\": where the camera stands");
      return;
    }
    const std::optional<glm::dmat3> rotation = read_rotation(vector, matrix);
    const auto place = numbers(centre != nullptr ? *centre : *translation, {3});
    if (!rotation || !place) return;
    const glm::dvec3 at((*place)[0], (*place)[1], (*place)[2]);
    const std::optional<Pose> found =
        centre != nullptr ? pose_from_camera(*rotation, at) : pose_from_translation(*rotation, at);
    if (found) {
      pose = *found;
      return;
    }
    faults_.error(json_.place(vector != nullptr ? *vector : *matrix),
                  "the rotation's rows must be perpendicular unit vectors, right-handed");
  }

  std::optional<glm::dmat3> read_rotation(const JsonValue* vector, const JsonValue* matrix) {
    constexpr double kMostRadians = 1e3;
    if (vector != nullptr) {
      const auto r = numbers(*vector, {3});
      if (!r) return std::nullopt;
      for (const double angle : *r) {
        if (std::abs(angle) <= kMostRadians) continue;
        faults_.error(json_.place(*vector),
                      fmt::format("expected radians from -1000 to 1000, got {}", angle));
        return std::nullopt;
      }
      return rotation_from_vector({(*r)[0], (*r)[1], (*r)[2]});
    }
    const auto r = numbers(*matrix, {9, 3});
    if (!r) return std::nullopt;
    if (r->size() == 3) return read_rotation(matrix, nullptr);  // programs call rotation vectors so, too
    return glm::transpose(
        glm::dmat3((*r)[0], (*r)[1], (*r)[2], (*r)[3], (*r)[4], (*r)[5], (*r)[6], (*r)[7], (*r)[8]));
  }

  const JsonDocument& json_;
  FaultList& faults_;
};

}  // namespace

std::vector<PhotographCamera> read_opencv_cameras(std::string_view text, const std::string& photo,
                                                  FaultList& faults) {
  const Result<JsonDocument> json =
      JsonDocument::parse(text, faults.file(), JsonDocument::Place::line_and_path);
  if (!json) {
    for (const Diagnostic& fault : json.error().diagnostics) faults.error(fault.place, fault.message);
    return {};
  }
  const JsonValue& root = json->root();
  CameraReader reader(*json, faults);
  std::vector<PhotographCamera> cameras;
  const JsonValue* list = find_any(root, {"cameras", "frames", "images"});
  if (list == nullptr) {
    if (std::optional<PhotographCamera> one = reader.read(root, root, photo))
      cameras.push_back(std::move(*one));
    return cameras;
  }
  if (!list->is_array() || list->children.empty() || list->children.size() > kMaxPhotographs) {
    faults.error(json->place(*list), fmt::format("expected an array of 1 to {} cameras, got {}",
                                                 kMaxPhotographs, describe(*list)));
    return cameras;
  }
  for (const JsonValue& object : list->children) {
    if (std::optional<PhotographCamera> one = reader.read(object, root, {}))
      cameras.push_back(std::move(*one));
  }
  return cameras;
}

}  // namespace laterna
