// Text files of one camera each. World to camera, +Y down, +Z forward.
//
// MVE's .cam, which texrecon (mvs-texturing) reads beside each picture: "tx ty tz R00 R01 … R22" and "f d0 d1 paspect ppx ppy",
// the focal length in units of the picture's longer side, the principal point of its width and height.
//
// MVSNet's _cam.txt, which OpenMVS exchanges too: "extrinsic" and four rows of [R t; 0 1], "intrinsic" and three rows of the
// camera matrix in pixels, the centre of the top-left pixel at (0, 0); then depths, which do not matter here.
#include <fmt/format.h>

#include <algorithm>

#include "scene/photograph_cameras.h"
#include "scene/spelling.h"
#include "scene/text_numbers.h"

namespace laterna {
namespace {

// All words of a text, with their lines.
class WordReader {
 public:
  WordReader(std::string_view text, FaultList& faults) : faults_(faults) {
    for (TextLines lines(text); lines.next();) {
      for (const std::string_view word : words_of(lines.line())) words_.push_back({word, lines.number()});
      if (words_.size() > kMostWords) break;
    }
  }

  [[nodiscard]] std::string_view peek() const { return at_ < words_.size() ? words_[at_].text : ""; }
  [[nodiscard]] std::string place() const {
    if (words_.empty()) return {};
    return fmt::format("line {}", words_[std::min(at_, words_.size() - 1)].line);
  }
  bool expect(std::string_view word) {
    if (peek() == word) {
      ++at_;
      return true;
    }
    faults_.error(place(), fmt::format("expected {}, got {}", in_quotes(word), got()));
    return false;
  }
  // False, with a message, where there are fewer.
  bool read(std::span<double> numbers, std::string_view what) {
    for (double& number : numbers) {
      const std::optional<double> found = number_of(peek());
      if (!found) {
        faults_.error(place(), fmt::format("expected {} ({} numbers), got {}", what, numbers.size(), got()));
        return false;
      }
      number = *found;
      ++at_;
    }
    return true;
  }

 private:
  static constexpr std::size_t kMostWords = 10'000;
  struct Word {
    std::string_view text;
    std::size_t line;
  };
  [[nodiscard]] std::string got() const {
    return at_ < words_.size() ? in_quotes(words_[at_].text) : "the end of the file";
  }

  FaultList& faults_;
  std::vector<Word> words_;
  std::size_t at_ = 0;
};

constexpr const char* kNoRotation = "the rotation's rows must be perpendicular unit vectors, right-handed";

glm::dmat3 from_rows(const double* r) {
  return {glm::dvec3(r[0], r[3], r[6]), glm::dvec3(r[1], r[4], r[7]), glm::dvec3(r[2], r[5], r[8])};
}

bool read_mve(WordReader& words, PhotographCamera& camera, FaultList& faults) {
  double extrinsic[12], intrinsic[6];
  const std::string pose_place = words.place();
  if (!words.read(extrinsic, "tx ty tz and a rotation, row by row")) return false;
  const std::string place = words.place();
  if (!words.read(intrinsic, "f d0 d1 paspect ppx ppy")) return false;
  const std::optional<Pose> pose =
      pose_from_translation(from_rows(extrinsic + 3), {extrinsic[0], extrinsic[1], extrinsic[2]});
  if (!pose) {
    faults.error(pose_place, kNoRotation);
    return false;
  }
  if (intrinsic[1] != 0 || intrinsic[2] != 0) {
    faults.error(
        place,
        fmt::format("expected no distortion (d0 = d1 = 0), got {} and {}: programs differ in what these "
                    "mean, undistort the photographs first",
                    intrinsic[1], intrinsic[2]));
    return false;
  }
  camera.pose = *pose;
  camera.place = place;
  // "paspect": a pixel's width over its height.
  camera.intrinsics = {intrinsic[0], intrinsic[0] * intrinsic[3], intrinsic[4], intrinsic[5], 0, 0, true};
  return true;
}

bool read_mvsnet(WordReader& words, PhotographCamera& camera, FaultList& faults) {
  double extrinsic[16], k[9];
  words.expect("extrinsic");
  const std::string pose_place = words.place();
  if (!words.read(extrinsic, "the rows of [R t; 0 1]") || !words.expect("intrinsic")) return false;
  const std::string place = words.place();
  if (!words.read(k, "the rows of a camera matrix")) return false;
  const double rotation[9] = {extrinsic[0], extrinsic[1], extrinsic[2], extrinsic[4], extrinsic[5],
                              extrinsic[6], extrinsic[8], extrinsic[9], extrinsic[10]};
  const std::optional<Pose> pose =
      pose_from_translation(from_rows(rotation), {extrinsic[3], extrinsic[7], extrinsic[11]});
  if (!pose) {
    faults.error(pose_place, kNoRotation);
    return false;
  }
  camera.pose = *pose;
  camera.place = place;
  camera.intrinsics = {k[0], k[4], k[2] + 0.5, k[5] + 0.5, 0, 0, false};
  return true;
}

}  // namespace

std::vector<PhotographCamera> read_cam_file(std::string_view text, const std::string& photo,
                                            FaultList& faults) {
  WordReader words(text, faults);
  PhotographCamera camera;
  camera.photo = photo;
  const bool is_read =
      words.peek() == "extrinsic" ? read_mvsnet(words, camera, faults) : read_mve(words, camera, faults);
  if (!is_read) return {};
  return {camera};
}

}  // namespace laterna
