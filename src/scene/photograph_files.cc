// Puts photographs and their cameras together.
#include "laterna/photograph_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <system_error>

#include "base/lower_case.h"
#include "base/task_pool.h"
#include "base/without_exceptions.h"
#include "scene/lens_undistortion.h"
#include "scene/photograph_cameras.h"
#include "scene/spelling.h"

namespace laterna {
namespace {

using Path = std::filesystem::path;

// Photographs' frusta begin this near to the lens: scenes of photogrammetry have any unit.
constexpr double kNear = 1e-3;
// Sizes that were halved and rounded differ by so many pixels from what their shape says.
constexpr double kRoundedPixels = 1.5;

constexpr std::array<std::string_view, 14> kEndings = {".png", ".jpg", ".jpeg", ".bmp", ".tga",
                                                       ".gif", ".ppm", ".pgm",  ".pnm", ".pbm",
                                                       ".hdr", ".exr", ".pfm",  ".jpe"};

bool is_picture(const Path& file) {
  return std::find(kEndings.begin(), kEndings.end(), lower_case(file.extension().string())) != kEndings.end();
}

// The pictures of a folder, and which of them a name means.
class PhotoFolder {
 public:
  static Result<PhotoFolder> open(const Path& folder) {
    PhotoFolder photos;
    std::error_code fault;
    for (std::filesystem::recursive_directory_iterator entry(folder, fault), end; entry != end;
         entry.increment(fault)) {
      if (fault) break;
      if (!is_picture(entry->path())) continue;
      photos.files_.push_back(entry->path());
    }
    if (fault)
      return tl::unexpected(Error(Failure::bad_input, Diagnostic{folder.string(), {}, fault.message()}));
    std::sort(photos.files_.begin(), photos.files_.end());
    for (std::size_t i = 0; i < photos.files_.size(); ++i) {
      const Path& file = photos.files_[i];
      photos.by_path_[file.lexically_relative(folder).generic_string()].push_back(i);
      photos.by_name_[file.filename().string()].push_back(i);
      photos.by_stem_[file.stem().string()].push_back(i);
    }
    return photos;
  }

  [[nodiscard]] const std::vector<Path>& files() const { return files_; }

  // By its path in the folder, or its name alone, or its name without ending.
  [[nodiscard]] std::vector<std::size_t> find(const std::string& wanted) const {
    const Path path(wanted);
    const std::string name = path.filename().string();
    const std::string stem = is_picture(path) ? path.stem().string() : name;
    for (const auto& [list, key] : {std::pair(&by_path_, path.lexically_normal().generic_string()),
                                    std::pair(&by_name_, name), std::pair(&by_stem_, stem)}) {
      const auto found = list->find(key);
      if (found != list->end()) return found->second;
    }
    return {};
  }

 private:
  std::vector<Path> files_;
  std::map<std::string, std::vector<std::size_t>> by_path_, by_name_, by_stem_;
};

struct Pair {
  PhotographCamera camera;
  Path photo;
  Image pinhole;  // where distortion was removed
  Projection projection;
  std::vector<Diagnostic> faults;
};

glm::dmat3 scene_from_file(LoadOptions::Up up) {
  if (up == LoadOptions::Up::y) return glm::dmat3(1.0);
  return {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0)};
}

class PhotographJoiner {
 public:
  PhotographJoiner(const PhotographFiles& files, Scene& scene) : files_(files), scene_(scene) {}

  Result<void> run() {
    Result<std::vector<PhotographCamera>> cameras = read_photograph_cameras(files_.cameras);
    if (!cameras) return tl::unexpected(std::move(cameras.error()));
    const Result<PhotoFolder> photos = PhotoFolder::open(files_.photos);
    if (!photos) return tl::unexpected(photos.error());
    join(std::move(*cameras), *photos);
    if (!faults_.empty()) return tl::unexpected(Error(Failure::bad_input, std::move(faults_)));
    const TaskPool pool(files_.threads);
    pool.for_each(pairs_.size(), [&](std::size_t i, int) { prepare(pairs_[i]); });
    for (Pair& pair : pairs_) std::move(pair.faults.begin(), pair.faults.end(), std::back_inserter(faults_));
    if (!faults_.empty()) return tl::unexpected(Error(Failure::bad_input, std::move(faults_)));
    for (Pair& pair : pairs_) add(std::move(pair));
    return {};
  }

 private:
  void join(std::vector<PhotographCamera> cameras, const PhotoFolder& photos) {
    std::map<std::size_t, std::string> taken;  // by which camera
    for (PhotographCamera& camera : cameras) {
      const std::vector<std::size_t> found = photos.find(camera.photo);
      if (found.empty()) {
        cameras_missing_.push_back({camera.file, camera.place,
                                    fmt::format("there is no photograph {} in {}", in_quotes(camera.photo),
                                                path_in_quotes(files_.photos.string()))});
        continue;
      }
      if (found.size() > 1) {
        faults_.push_back(
            {camera.file, camera.place,
             fmt::format("{} may be any of {} photographs, among them {} and {}", in_quotes(camera.photo),
                         found.size(), path_in_quotes(photos.files()[found[0]].string()),
                         path_in_quotes(photos.files()[found[1]].string()))});
        continue;
      }
      const auto [other, is_new] = taken.try_emplace(found[0], camera.place);
      if (!is_new) {
        faults_.push_back({camera.file, camera.place,
                           fmt::format("the photograph {} has a camera already, at {}",
                                       in_quotes(camera.photo), other->second)});
        continue;
      }
      pairs_.push_back({std::move(camera), photos.files()[found[0]], {}, {}, {}});
    }
    for (std::size_t i = 0; i < photos.files().size(); ++i) {
      if (taken.contains(i)) continue;
      photos_missing_.push_back(
          {photos.files()[i].string(),
           {},
           fmt::format("has no camera in {}", path_in_quotes(files_.cameras.string()))});
    }
    report_missing(std::move(cameras_missing_), "cameras have no photograph");
    report_missing(std::move(photos_missing_), "photographs have no camera");
    if (pairs_.empty() && faults_.empty())
      faults_.push_back({files_.photos.string(), {}, "holds no photograph that has a camera"});
  }

  // The first by name: where a folder is wrong all are missing, for one reason.
  void report_missing(std::vector<Diagnostic> missing, const char* what) {
    constexpr std::size_t kMostNamed = 1;
    std::vector<Diagnostic>& told = files_.skips_missing ? scene_.warnings : faults_;
    const std::size_t more = missing.size() > kMostNamed + 1 ? missing.size() - kMostNamed : 0;
    missing.resize(missing.size() - more);
    for (Diagnostic& diagnostic : missing) {
      if (files_.skips_missing) diagnostic.message += ": left out";
      told.push_back(std::move(diagnostic));
    }
    if (more > 0) {
      told.push_back({files_.photos.string(),
                      {},
                      fmt::format("{} more {}{}", more, what, files_.skips_missing ? ": left out" : "")});
    }
  }

  // Its projection, and its picture where the lens bends it.
  static void prepare(Pair& pair) {
    const Result<ImageHeader> header = read_image_header(pair.photo);
    if (!header) {
      pair.faults = header.error().diagnostics;
      return;
    }
    const PhotographCamera& camera = pair.camera;
    const auto fault = [&](std::string message) {
      pair.faults.push_back({camera.file, camera.place, std::move(message)});
    };
    const double width = header->width, height = header->height;
    if (camera.projection) {
      set_scene_projection(camera, width, height, pair, fault);
    } else {
      const std::optional<Intrinsics> intrinsics = fitted(camera.intrinsics, width, height, fault);
      if (intrinsics) set_projection(*intrinsics, pair, fault);
    }
    if (!pair.faults.empty()) return;
    if (std::string message = find_fault(pair.projection); !message.empty()) fault(std::move(message));
  }

  template <class Fault>
  static void set_scene_projection(const PhotographCamera& camera, double width, double height, Pair& pair,
                                   const Fault& fault) {
    Projection projection = *camera.projection;
    if (projection.is_orthographic) return fault("a photograph's camera must be perspective");
    const double aspect = width / height;
    if (camera.aspect_from_picture) {
      const double middle = (projection.left + projection.right) / 2;
      const double half = (projection.top - projection.bottom) / 2 * aspect;
      projection.left = middle - half, projection.right = middle + half;
    } else if (std::abs(projection.aspect() * height - width) > kRoundedPixels) {
      return fault(fmt::format("its aspect is {:.6g}, but the photograph is {}x{} ({:.6g})",
                               projection.aspect(), width, height, aspect));
    }
    pair.projection = projection;
    pair.projection.near = kNear;
    pair.projection.far = std::numeric_limits<double>::infinity();
  }

  // Of the photograph, in its pixels. Nothing where they are none, or are of another shape.
  template <class Fault>
  static std::optional<Intrinsics> fitted(Intrinsics k, double width, double height, const Fault& fault) {
    if (k.is_relative) {
      // MVE, libs/mve/camera.cc, CameraInfo::fill_calibration.
      const double pixel_aspect = k.fy / k.fx;
      const bool is_portrait = width * pixel_aspect < height;
      const double scale = is_portrait ? height / pixel_aspect : width;
      k.fx *= scale, k.fy *= scale, k.cx *= width, k.cy *= height;
    } else if (k.width == 0 || k.height == 0) {
      k.width = width, k.height = height;
    }
    if (!k.is_relative) {
      if (!(k.width > 0 && k.height > 0)) {
        fault(fmt::format("expected a width and a height above 0, got {} and {}", k.width, k.height));
        return std::nullopt;
      }
      const double scale = width / k.width;
      if (std::abs(k.height * scale - height) > kRoundedPixels * std::max(1.0, scale)) {
        fault(fmt::format("the camera is for pictures of {}x{}, but the photograph is {}x{}", k.width,
                          k.height, width, height));
        return std::nullopt;
      }
      const double scale_y = height / k.height;
      k.fx *= scale, k.cx *= scale, k.fy *= scale_y, k.cy *= scale_y;
    }
    k.width = width, k.height = height, k.is_relative = false;
    if (!(k.fx > 0 && k.fy > 0 && std::isfinite(k.fx) && std::isfinite(k.fy) && std::isfinite(k.cx) &&
          std::isfinite(k.cy))) {
      fault(fmt::format("expected focal lengths above 0, got {} and {}", k.fx, k.fy));
      return std::nullopt;
    }
    return k;
  }

  template <class Fault>
  static void set_projection(const Intrinsics& k, Pair& pair, const Fault& fault) {
    const double endless = std::numeric_limits<double>::infinity();
    if (pair.camera.distortion.is_none()) {
      pair.projection = {false, -k.cx / k.fx, (k.width - k.cx) / k.fx, -(k.height - k.cy) / k.fy, k.cy / k.fy,
                         kNear, endless};
      return;
    }
    std::string message;
    const PinholeFrame frame = find_pinhole_frame(k, pair.camera.distortion, message);
    if (!message.empty()) return fault(std::move(message));
    const Result<Image> photo = read_image(pair.photo);
    if (!photo) {
      pair.faults = photo.error().diagnostics;
      return;
    }
    pair.pinhole = undistort(*photo, k, pair.camera.distortion, frame);
    pair.projection = {false, frame.left, frame.right, -frame.bottom, -frame.top, kNear, endless};
  }

  void add(Pair pair) {
    Picture picture;
    picture.name = pair.photo.string();
    if (pair.pinhole.empty()) {
      picture.file = pair.photo;
    } else {
      picture.pixels = std::make_shared<const Image>(std::move(pair.pinhole));
    }
    scene_.pictures.push_back(std::move(picture));
    Photograph photograph;
    photograph.name = pair.camera.photo;
    photograph.picture = static_cast<int>(scene_.pictures.size()) - 1;
    photograph.projection = pair.projection;
    photograph.pose = pair.camera.pose;
    // A glTF scene says itself how it lies.
    if (!pair.camera.projection) {
      const glm::dmat3 turn = scene_from_file(files_.up);
      photograph.pose.position_ws = turn * (photograph.pose.position_ws * files_.metres_per_unit);
      photograph.pose.world_from_view_rotation = turn * photograph.pose.world_from_view_rotation;
    }
    scene_.photographs.push_back(std::move(photograph));
  }

  const PhotographFiles& files_;
  Scene& scene_;
  std::vector<Pair> pairs_;
  std::vector<Diagnostic> faults_;
  std::vector<Diagnostic> cameras_missing_, photos_missing_;  // without the other
};

}  // namespace

Result<void> add_photographs(Scene& scene, const PhotographFiles& files) {
  const std::size_t pictures = scene.pictures.size(), photographs = scene.photographs.size();
  Result<void> added = without_exceptions(
      Error(Failure::bad_input,
            Diagnostic{files.photos.string(), {}, "not enough memory for the photographs"}),
      [&] { return PhotographJoiner(files, scene).run(); });
  if (!added) {
    scene.pictures.resize(pictures);
    scene.photographs.resize(photographs);
  }
  return added;
}

}  // namespace laterna
