// COLMAP's text files. https://colmap.github.io/format.html: cameras.txt has a line per camera, "CAMERA_ID MODEL WIDTH HEIGHT
// PARAMS…"; images.txt two lines per photograph, "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME" and the points seen. World to
// camera, +Y down, +Z forward; (0, 0) is the top-left corner of the top-left pixel.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

#include "laterna/photograph_files.h"
#include "scene/photograph_cameras.h"
#include "scene/spelling.h"
#include "scene/text_numbers.h"

namespace laterna {
namespace {

struct Lens {
  Intrinsics intrinsics;
  CameraDistortion distortion;
};

struct Model {
  std::string_view name, parameters;
  std::size_t count;
  void (*read)(const double* p, Lens& lens);
};

void set_pinhole(Lens& lens, double fx, double fy, double cx, double cy) {
  lens.intrinsics.fx = fx, lens.intrinsics.fy = fy, lens.intrinsics.cx = cx, lens.intrinsics.cy = cy;
}

// COLMAP, src/colmap/sensor/models.h, "camera models": the order of parameters.
constexpr Model kModels[] = {
    {"SIMPLE_PINHOLE", "f cx cy", 3,
     [](const double* p, Lens& lens) { set_pinhole(lens, p[0], p[0], p[1], p[2]); }},
    {"PINHOLE", "fx fy cx cy", 4,
     [](const double* p, Lens& lens) { set_pinhole(lens, p[0], p[1], p[2], p[3]); }},
    {"SIMPLE_RADIAL", "f cx cy k", 4,
     [](const double* p, Lens& lens) {
       set_pinhole(lens, p[0], p[0], p[1], p[2]);
       lens.distortion.k[0] = p[3];
     }},
    {"RADIAL", "f cx cy k1 k2", 5,
     [](const double* p, Lens& lens) {
       set_pinhole(lens, p[0], p[0], p[1], p[2]);
       std::copy_n(p + 3, 2, lens.distortion.k.begin());
     }},
    {"OPENCV", "fx fy cx cy k1 k2 p1 p2", 8,
     [](const double* p, Lens& lens) {
       set_pinhole(lens, p[0], p[1], p[2], p[3]);
       std::copy_n(p + 4, 2, lens.distortion.k.begin());
       std::copy_n(p + 6, 2, lens.distortion.p.begin());
     }},
    {"FULL_OPENCV", "fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6", 12,
     [](const double* p, Lens& lens) {
       set_pinhole(lens, p[0], p[1], p[2], p[3]);
       std::copy_n(p + 4, 2, lens.distortion.k.begin());
       std::copy_n(p + 6, 2, lens.distortion.p.begin());
       std::copy_n(p + 8, 4, lens.distortion.k.begin() + 2);
     }},
};

std::string place_of(const TextLines& lines) { return fmt::format("line {}", lines.number()); }

bool is_comment(std::string_view line) {
  const std::string_view text = rest_after_words(line, 0);
  return text.empty() || text.front() == '#';
}

// Numbers `first` to the last of the words; empty, with a message, where one is none.
std::vector<double> numbers_of(std::span<const std::string_view> words, const std::string& place,
                               FaultList& faults) {
  std::vector<double> numbers;
  for (const std::string_view word : words) {
    const std::optional<double> number = number_of(word);
    if (!number) {
      faults.error(place, fmt::format("expected a number, got {}", in_quotes(word)));
      return {};
    }
    numbers.push_back(*number);
  }
  return numbers;
}

void read_camera(std::string_view line, const std::string& place, std::map<std::string, Lens>& cameras,
                 FaultList& faults) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() < 4) {
    faults.error(place,
                 fmt::format("expected CAMERA_ID MODEL WIDTH HEIGHT PARAMETERS, got {} words", words.size()));
    return;
  }
  const auto model = std::find_if(std::begin(kModels), std::end(kModels),
                                  [&](const Model& known) { return known.name == words[1]; });
  if (model == std::end(kModels)) {
    std::string names;
    for (const Model& known : kModels) names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
    faults.error(
        place, fmt::format("the camera model {} is not read; expected one of {} (COLMAP's image_undistorter "
                           "makes pinholes of others)",
                           in_quotes(words[1]), names));
    return;
  }
  const std::vector<double> numbers = numbers_of(std::span(words).subspan(2), place, faults);
  if (numbers.empty()) return;
  if (numbers.size() != 2 + model->count) {
    faults.error(place, fmt::format("{} has {} parameters ({}), got {}", model->name, model->count,
                                    model->parameters, numbers.size() - 2));
    return;
  }
  Lens lens;
  lens.intrinsics.width = numbers[0], lens.intrinsics.height = numbers[1];
  model->read(numbers.data() + 2, lens);
  if (!cameras.try_emplace(std::string(words[0]), lens).second)
    faults.error(place, fmt::format("a camera {} was there before", in_quotes(words[0])));
}

std::optional<PhotographCamera> read_image(std::string_view line, const std::string& place,
                                           const std::map<std::string, Lens>& cameras, FaultList& faults) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() < 10) {
    faults.error(place, fmt::format("expected IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, got {} words",
                                    words.size()));
    return std::nullopt;
  }
  const std::vector<double> n = numbers_of(std::span(words).subspan(1, 7), place, faults);
  if (n.empty()) return std::nullopt;
  const auto lens = cameras.find(std::string(words[8]));
  if (lens == cameras.end()) {
    faults.error(place, fmt::format("cameras.txt has no camera {}", in_quotes(words[8])));
    return std::nullopt;
  }
  PhotographCamera camera;
  camera.photo = std::string(rest_after_words(line, 9));
  camera.place = place;
  camera.intrinsics = lens->second.intrinsics;
  camera.distortion = lens->second.distortion;
  const std::optional<glm::dmat3> rotation = rotation_from_quaternion(n[0], n[1], n[2], n[3]);
  const std::optional<Pose> pose =
      rotation ? pose_from_translation(*rotation, {n[4], n[5], n[6]}) : std::nullopt;
  if (!pose) {
    faults.error(place, "expected a quaternion QW QX QY QZ, got one without length");
    return std::nullopt;
  }
  camera.pose = *pose;
  return camera;
}

}  // namespace

std::vector<PhotographCamera> read_colmap_cameras(std::string_view cameras_text, std::string_view images_text,
                                                  FaultList& camera_faults, FaultList& image_faults) {
  std::map<std::string, Lens> cameras;
  for (TextLines lines(cameras_text); lines.next();) {
    if (!is_comment(lines.line())) read_camera(lines.line(), place_of(lines), cameras, camera_faults);
  }
  std::vector<PhotographCamera> photographs;
  if (camera_faults.has_errors()) return photographs;
  for (TextLines lines(images_text); lines.next();) {
    if (is_comment(lines.line())) continue;
    if (photographs.size() == kMaxPhotographs) {
      image_faults.error(place_of(lines), fmt::format("more than {} photographs", kMaxPhotographs));
      break;
    }
    std::optional<PhotographCamera> camera = read_image(lines.line(), place_of(lines), cameras, image_faults);
    if (camera) photographs.push_back(std::move(*camera));
    lines.next();  // the points that it sees: may be an empty line
  }
  if (photographs.empty() && !image_faults.has_errors()) image_faults.error({}, "names no photograph");
  return photographs;
}

}  // namespace laterna
