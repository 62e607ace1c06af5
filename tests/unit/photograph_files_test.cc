// Photographs and their cameras, from every kind of file: the same camera sees the same point at the same pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/photograph_files.h"
#include "reference/photograph_scenes.h"
#include "scene/lens_undistortion.h"
#include "scene/opencv_yaml.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

constexpr int kWidth = 64, kHeight = 48;

// A folder with pictures of that size, and files of cameras beside it.
class PhotographFolder {
 public:
  explicit PhotographFolder(const std::vector<std::string>& photos = {"photos/a.png"}) {
    for (const std::string& photo : photos) {
      std::filesystem::create_directories((folder_ / photo).parent_path());
      const Image picture(kWidth, kHeight, 3, PixelType::u8, Transfer::srgb);
      EXPECT_TRUE(write_image(picture, folder_ / photo).has_value());
    }
  }

  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    folder_.write(name, text);
  }
  [[nodiscard]] PhotographFiles files(const std::string& cameras) const {
    PhotographFiles files;
    files.cameras = cameras.empty() ? folder_.path() : folder_ / cameras;
    files.photos = folder_ / "photos";
    files.threads = 1;
    return files;
  }
  [[nodiscard]] Scene load(const std::string& cameras) const {
    Scene scene;
    const Result<void> added = add_photographs(scene, files(cameras));
    EXPECT_TRUE(added.has_value()) << to_string(added.error());
    return scene;
  }
  [[nodiscard]] std::string messages(const std::string& cameras) const {
    Scene scene;
    const Result<void> added = add_photographs(scene, files(cameras));
    if (added) return "added";
    EXPECT_TRUE(scene.photographs.empty() && scene.pictures.empty());
    std::string text = to_string(added.error());
    const std::string prefix = folder_.path().string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
      text.erase(at, prefix.size());
    return text;
  }

 private:
  TemporaryFolder folder_;
};

// Turned by 0.5 radians about (1, 2, 2)/3, t = (0.3, −0.2, 4): what every file below says, in its own words.
constexpr double kFx = 50, kFy = 52, kCx = 30, kCy = 25;  // OpenCV's pixels
const glm::dvec3 kAxis(1.0 / 3, 2.0 / 3, 2.0 / 3), kTranslation(0.3, -0.2, 4);
constexpr double kAngle = 0.5;

glm::dmat3 rotation_rows() {  // row i as column i
  const glm::dvec3 k = kAxis;
  const double c = std::cos(kAngle), s = std::sin(kAngle), v = 1 - c;
  return {glm::dvec3(c + k.x * k.x * v, k.x * k.y * v - k.z * s, k.x * k.z * v + k.y * s),
          glm::dvec3(k.y * k.x * v + k.z * s, c + k.y * k.y * v, k.y * k.z * v - k.x * s),
          glm::dvec3(k.z * k.x * v - k.y * s, k.z * k.y * v + k.x * s, c + k.z * k.z * v)};
}

std::string rotation_text(const char* separator) {
  std::string text;
  const glm::dmat3 r = rotation_rows();
  for (int i = 0; i < 9; ++i) {
    char number[64];
    std::snprintf(number, sizeof number, "%s%.12f", i == 0 ? "" : separator, r[i / 3][i % 3]);
    text += number;
  }
  return text;
}

// OpenCV's projection, in pixels from the top-left corner.
glm::dvec2 expected_pixel(const glm::dvec3& point_ws) {
  const glm::dmat3 r = rotation_rows();
  const glm::dvec3 p =
      glm::dvec3(glm::dot(r[0], point_ws), glm::dot(r[1], point_ws), glm::dot(r[2], point_ws)) + kTranslation;
  return {kFx * p.x / p.z + kCx + 0.5, kFy * p.y / p.z + kCy + 0.5};
}

void expect_camera(const Scene& scene, const std::string& name) {
  ASSERT_EQ(scene.photographs.size(), 1U);
  const Photograph& photograph = scene.photographs[0];
  EXPECT_EQ(photograph.name, name);
  EXPECT_EQ(find_fault(photograph.pose), "");
  for (const glm::dvec3& point : {glm::dvec3(0, 0, 0), glm::dvec3(0.7, -0.4, 0.5), glm::dvec3(-1, 0.6, 1)}) {
    const glm::dvec2 pixel =
        reference::in_picture({photograph.pose, photograph.projection}, kWidth, kHeight, point);
    EXPECT_LT(glm::length(pixel - expected_pixel(point)), 1e-6);
  }
}

std::string quaternion_text() {
  char text[128];
  const double s = std::sin(kAngle / 2);
  std::snprintf(text, sizeof text, "%.12f %.12f %.12f %.12f", std::cos(kAngle / 2), s / 3, 2 * s / 3,
                2 * s / 3);
  return text;
}

TEST(PhotographFiles, ColmapText) {
  PhotographFolder folder;
  folder.write(
      "sparse/cameras.txt",
      "# Camera list\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n7 PINHOLE 64 48 50 52 30.5 25.5\n");
  folder.write("sparse/images.txt",
               "# Image list\n1 " + quaternion_text() + " 0.3 -0.2 4 7 a.png\n12.5 3.5 -1 10 2 -1\n");
  for (const char* cameras : {"sparse", "sparse/cameras.txt", "sparse/images.txt"})
    expect_camera(folder.load(cameras), "a.png");
  // A picture of half the size is the same camera.
  folder.write("sparse/cameras.txt", "7 PINHOLE 128 96 100 104 61 51\r\n");
  expect_camera(folder.load("sparse"), "a.png");
}

TEST(PhotographFiles, OpenCvJsonAndYaml) {
  PhotographFolder folder;
  const std::string r = rotation_text(", ");
  folder.write(
      "list.json",
      R"({"image_width": 64, "image_height": 48, "camera_matrix": [[50, 0, 30], [0, 52, 25], [0, 0, 1]],
    "cameras": [{"image": "a.png", "rvec": [0.166666666667, 0.333333333333, 0.333333333333], "tvec": [0.3, -0.2, 4]}]})");
  expect_camera(folder.load("list.json"), "a.png");
  folder.write(
      "one.json",
      R"({"image": "photos/a.png", "fx": 50, "fy": 52, "cx": 30, "cy": 25, "dist_coeffs": [0, 0, 0, 0, 0],
    "R": [)" +
          r + R"(], "t": [[0.3], [-0.2], [4]], "avg_reprojection_error": 0.3})");
  expect_camera(folder.load("one.json"), "photos/a.png");
  folder.write(
      "cameras.yml",
      "%YAML:1.0\n---\nimage_width: 64\nimage_height: 48\ncamera_matrix: !!opencv-matrix\n   rows: 3\n"
      "   cols: 3\n   dt: d\n   data: [ 5.0e+01, 0., 30., 0.,\n       52., 25., 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: d\n   data: [ 0., 0., 0., 0. "
      "]\n"
      "cameras:\n   -\n      image: \"a.png\"  # the first\n      R: [" +
          r + "]\n      tvec: [ 0.3, -0.2, 4. ]\n");
  expect_camera(folder.load("cameras.yml"), "a.png");
  // One file for each photograph, called as it.
  folder.write("each/a.yaml", "%YAML:1.0\nK: [50, 0, 30, 0, 52, 25, 0, 0, 1]\nrotation: { R: 1 }\nR: [" + r +
                                  "]\ntvec: [0.3, -0.2, 4]\n");
  EXPECT_EQ(folder.messages("each"), "added");
  expect_camera(folder.load("each"), "a");
}

TEST(PhotographFiles, CamFiles) {
  PhotographFolder folder;
  folder.write("mve/a.cam", "0.3 -0.2 4 " + rotation_text(" ") + "\n0.78125 0 0 1.04 0.4765625 0.53125\n");
  expect_camera(folder.load("mve"), "a");
  const glm::dmat3 r = rotation_rows();
  std::string rows;
  for (int i = 0; i < 3; ++i) {
    char row[160];
    std::snprintf(row, sizeof row, "%.12f %.12f %.12f %.12f\n", r[i].x, r[i].y, r[i].z, kTranslation[i]);
    rows += row;
  }
  folder.write("mvs/a_cam.txt",
               "extrinsic\n" + rows + "0 0 0 1\n\nintrinsic\n50 0 30\n0 52 25\n0 0 1\n\n0.5 0.01\n");
  expect_camera(folder.load("mvs"), "a");
}

TEST(PhotographFiles, GltfCameras) {
  PhotographFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.add("cameras", {{"name", "a"},
                          {"type", "perspective"},
                          {"perspective", {{"yfov", 1.0}, {"znear", 0.5}, {"aspectRatio", 4.0 / 3}}}});
  builder.add("nodes", {{"camera", 0}, {"translation", {1, 2, 3}}});
  folder.write("cameras.gltf", builder.text());
  const Scene scene = folder.load("cameras.gltf");
  ASSERT_EQ(scene.photographs.size(), 1U);
  EXPECT_EQ(scene.photographs[0].pose.position_ws, glm::dvec3(1, 2, 3));
  EXPECT_NEAR(scene.photographs[0].projection.top, std::tan(0.5), 1e-12);
  EXPECT_NEAR(scene.photographs[0].projection.right, std::tan(0.5) * 4 / 3, 1e-12);
}

TEST(PhotographFiles, AxesAndUnitsAreTheMeshs) {
  PhotographFolder folder;
  folder.write(
      "c.json",
      R"({"image": "a.png", "fx": 50, "fy": 50, "cx": 31.5, "cy": 23.5, "R": [1,0,0, 0,0,-1, 0,1,0], "C": [100, -200, 300]})");
  PhotographFiles files = folder.files("c.json");
  files.up = LoadOptions::Up::z;
  files.metres_per_unit = 0.01;
  Scene scene;
  ASSERT_TRUE(add_photographs(scene, files).has_value());
  const Pose& pose = scene.photographs[0].pose;
  EXPECT_LT(glm::length(pose.position_ws - glm::dvec3(1, 3, 2)), 1e-12);
  EXPECT_LT(glm::length(pose.forward_ws() - glm::dvec3(0, 0, -1)), 1e-12);  // the file's +Y
  EXPECT_LT(glm::length(pose.up_ws() - glm::dvec3(0, 1, 0)), 1e-12);
}

// A pinhole's point, seen through the lens and made a pinhole's again.
TEST(PhotographFiles, LensDistortionIsRemoved) {
  constexpr int kSide = 160;
  const Intrinsics k{120, 124, 78, 82, kSide, kSide, false};
  const auto colour = [](glm::dvec2 p) {
    return 0.5 + 0.2 * std::sin(9 * p.x) + 0.2 * std::cos(8 * p.y + p.x);
  };
  CameraDistortion barrel, pincushion, rational;
  barrel.k = {-0.2, 0.05, 0, 0, 0, 0};
  barrel.p = {0.002, -0.001};
  pincushion.k = {0.15, 0.02, 0, 0, 0, 0};
  rational.k = {0.1, -0.02, 0.01, 0.2, 0.01, 0.001};
  for (const CameraDistortion& lens : {barrel, pincushion, rational}) {
    std::string fault;
    const PinholeFrame frame = find_pinhole_frame(k, lens, fault);
    ASSERT_EQ(fault, "");
    // The lens's picture of a pattern: each pixel's own point by fixed-point iteration, which these lenses are mild enough for.
    Image photo(kSide, kSide, 1, PixelType::f32, Transfer::linear);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const glm::dvec2 seen((x + 0.5 - k.cx) / k.fx, (y + 0.5 - k.cy) / k.fy);
        glm::dvec2 point = seen;
        for (int i = 0; i < 80; ++i) point += (seen - distorted(lens, point)) * 0.7;
        photo.values<float>()[static_cast<std::size_t>(y * kSide + x)] = static_cast<float>(colour(point));
      }
    }
    const Image pinhole = undistort(photo, k, lens, frame);
    double worst = 0;
    int seen = 0;
    for (int y = 0; y < pinhole.height(); ++y) {
      for (int x = 0; x < pinhole.width(); ++x) {
        const glm::dvec2 p(frame.left + (frame.right - frame.left) * (x + 0.5) / pinhole.width(),
                           frame.top + (frame.bottom - frame.top) * (y + 0.5) / pinhole.height());
        const glm::dvec2 at = distorted(lens, p) * glm::dvec2(k.fx, k.fy) + glm::dvec2(k.cx, k.cy);
        const bool is_inside = at.x >= 0 && at.y >= 0 && at.x <= kSide && at.y <= kSide;
        EXPECT_EQ(pinhole.value(x, y, 1), is_inside ? 1 : 0);
        if (at.x < 2 || at.y < 2 || at.x > kSide - 2 || at.y > kSide - 2) continue;
        worst = std::max(worst, std::abs(pinhole.value(x, y, 0) - colour(p)));
        ++seen;
      }
    }
    EXPECT_GT(seen, kSide * kSide * 8 / 10);
    EXPECT_LT(worst, 0.002);
  }
}

// The wrong folder: all are missing for one reason, and the first says so.
TEST(PhotographFiles, ManyThatAreMissingAreCounted) {
  std::vector<std::string> photos;
  std::string cameras = R"({"fx": 50, "fy": 50, "cx": 31.5, "cy": 23.5, "cameras": [)";
  for (int i = 0; i < 9; ++i) {
    photos.push_back(fmt::format("photos/p{}.png", i));
    cameras += fmt::format("{}\n{{\"image\": \"c{}.png\", \"rvec\": [0,0,0], \"tvec\": [0,0,0]}}",
                           i == 0 ? "" : ",", i);
  }
  PhotographFolder folder(photos);
  folder.write("c.json", cameras + "]}");
  EXPECT_EQ(folder.messages("c.json"),
            "c.json: line 2: cameras[0].image: there is no photograph \"c0.png\" in \"photos\"\n"
            "photos: 8 more cameras have no photograph\n"
            "photos/p0.png: has no camera in \"c.json\"\n"
            "photos: 8 more photographs have no camera");
}

TEST(PhotographFiles, WhatIsMissingIsNamed) {
  PhotographFolder folder({"photos/a.png", "photos/deep/b.png"});
  folder.write("c.json", R"({"fx": 50, "fy": 50, "cx": 31.5, "cy": 23.5, "cameras": [
    {"image": "a.png", "rvec": [0,0,0], "tvec": [0,0,0]},
    {"image": "c.png", "rvec": [0,0,0], "tvec": [0,0,0]}]})");
  EXPECT_EQ(folder.messages("c.json"),
            "c.json: line 3: cameras[1].image: there is no photograph \"c.png\" in \"photos\"\n"
            "photos/deep/b.png: has no camera in \"c.json\"");
  PhotographFiles files = folder.files("c.json");
  files.skips_missing = true;
  Scene scene;
  ASSERT_TRUE(add_photographs(scene, files).has_value());
  EXPECT_EQ(scene.photographs.size(), 1U);
  EXPECT_EQ(scene.warnings.size(), 2U);
  EXPECT_EQ(folder.messages("none.json"), "none.json: no such file or folder");
}

TEST(PhotographFiles, FaultsAreLocated) {
  PhotographFolder folder;
  const auto colmap = [&](const std::string& cameras, const std::string& images) {
    folder.write("s/cameras.txt", cameras);
    folder.write("s/images.txt", images);
    return folder.messages("s");
  };
  const std::string pinhole = "1 PINHOLE 64 48 50 50 32 24\n", image = "1 1 0 0 0 0 0 0 1 a.png\n\n";
  EXPECT_EQ(colmap(pinhole, image), "added");
  EXPECT_EQ(colmap("#\n1 PINHOLE 64 48 50 50 32\n", image),
            "s/cameras.txt: line 2: PINHOLE has 4 parameters (fx fy cx cy), got 3");
  EXPECT_EQ(colmap("1 PINHOLE 64 48 50 x 32 24\n", image),
            "s/cameras.txt: line 1: expected a number, got \"x\"");
  EXPECT_EQ(colmap(pinhole + pinhole, image), "s/cameras.txt: line 2: a camera \"1\" was there before");
  EXPECT_EQ(
      colmap("1 FISHEYE 64 48 50 50 32 24\n", image),
      "s/cameras.txt: line 1: the camera model \"FISHEYE\" is not read; expected one of SIMPLE_PINHOLE, "
      "PINHOLE, "
      "SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV (COLMAP's image_undistorter makes pinholes of others)");
  EXPECT_EQ(colmap(pinhole, "1 1 0 0 0 0 0 0 2 a.png\n"),
            "s/images.txt: line 1: cameras.txt has no camera \"2\"");
  EXPECT_EQ(colmap(pinhole, "1 0 0 0 0 0 0 0 1 a.png\n"),
            "s/images.txt: line 1: expected a quaternion QW QX QY QZ, got one without length");
  EXPECT_EQ(colmap(pinhole, "1 1 0 0 0 0 0 1 a.png\n"),
            "s/images.txt: line 1: expected IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, got 9 words");
  EXPECT_EQ(colmap(pinhole, image + image),
            "s/images.txt: line 3: the photograph \"a.png\" has a camera already, at line 1");
  EXPECT_EQ(colmap("1 PINHOLE 64 40 50 50 32 20\n", image),
            "s/images.txt: line 1: the camera is for pictures of 64x40, but the photograph is 64x48");
  EXPECT_EQ(colmap("1 PINHOLE 64 48 0 50 32 24\n", image),
            "s/images.txt: line 1: expected focal lengths above 0, got 0 and 50");
  EXPECT_EQ(colmap("1 SIMPLE_RADIAL 64 48 50 32 24 -0.9\n", image),
            "s/images.txt: line 1: the lens distortion cannot be inverted at pixel (0, 0) of 64x48: its "
            "formula folds the "
            "picture over");
  EXPECT_EQ(colmap(pinhole, "# nothing\n"), "s/images.txt: names no photograph");

  const auto json = [&](const std::string& text) {
    folder.write("c.json", text);
    return folder.messages("c.json");
  };
  const std::string pose = R"("rvec": [0, 0, 0], "tvec": [0, 0, 0])";
  EXPECT_EQ(json(R"({"image": "a.png", )" + pose + "}"),
            "c.json: line 1: needs \"camera_matrix\", or \"fx\", \"fy\", \"cx\" and \"cy\"");
  EXPECT_EQ(json(R"({"image": "a.png", "camera_matrix": [1, 2], )" + pose + "}"),
            "c.json: line 1: camera_matrix: expected 9 numbers, got 2");
  EXPECT_EQ(
      json(R"({"image": "a.png", "K": [50,0,32,0,50,24,0,0,1], "dist_coeffs": [1, 2, 3], )" + pose + "}"),
      "c.json: line 1: dist_coeffs: expected 4 or 5 or 8 or 0 numbers, got 3");
  EXPECT_EQ(
      json(R"({"image": "a.png", "K": [50,0,32,0,50,24,0,0,1], "R": [1,0,0,0,1,0,0,0,2], "t": [0,0,0]})"),
      "c.json: line 1: R: the rotation's rows must be perpendicular unit vectors, right-handed");
  EXPECT_EQ(json(R"({"image": "a.png", "K": [50,0,32,0,50,24,0,0,1]})"),
            "c.json: line 1: needs \"rvec\" or \"R\", and \"tvec\", \"t\" or \"C\": where the camera stands");
  EXPECT_EQ(json(R"({"cameras": []})"),
            "c.json: line 1: cameras: expected an array of 1 to 10000 cameras, got an array of 0");

  const auto cam = [&](const std::string& text) {
    folder.write("m/a.cam", text);
    return folder.messages("m");
  };
  EXPECT_EQ(cam("0 0 0 1 0 0 0 1 0 0 0 1\n1 0 0 1 0.5\n"),
            "m/a.cam: line 2: expected f d0 d1 paspect ppx ppy (6 numbers), got the end of the file");
  EXPECT_EQ(cam("0 0 0 1 0 0 0 1 0 0 0 1\n1 0.1 0 1 0.5 0.5\n"),
            "m/a.cam: line 2: expected no distortion (d0 = d1 = 0), got 0.1 and 0: programs differ in what "
            "these mean, "
            "undistort the photographs first");
  EXPECT_EQ(cam("0 0 0 1 0 0 0 1 0 0 0 -1\n1 0 0 1 0.5 0.5\n"),
            "m/a.cam: line 1: the rotation's rows must be perpendicular unit vectors, right-handed");
  EXPECT_EQ(cam("extrinsic\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n50 0 32\n"),
            "m/a.cam: line 6: expected \"intrinsic\", got \"50\"");
}

TEST(PhotographFiles, YamlIsReadAsOpenCvWritesIt) {
  const auto json = [](const std::string& yaml) {
    FaultList faults("f.yml");
    const std::optional<std::string> text = json_from_opencv_yaml(yaml, faults);
    if (text) return *text;
    return to_string(faults.errors().at(0));
  };
  EXPECT_EQ(json("a: 1.\nb: x y # c\nc: \"q: #\"\n"), "{\"a\":1\n,\"b\":\"x y\"\n,\"c\":\"q: #\"}");
  EXPECT_EQ(json("a:\n- 1\n- 2\nb: ~\n"), "{\"a\":\n[1\n,2]\n,\"b\":null}");
  EXPECT_EQ(json("a:\n  - { x:1, y: [2,\n     3] }\n  - k: v\n    w: 2\n"),
            "{\"a\":\n[{\"x\":1,\"y\":[2\n,3]}\n,{\"k\":\"v\"\n,\"w\":2}]}");
  EXPECT_EQ(json("a: 'it''s'\n"), "{\"a\":\"it's\"}");
  EXPECT_EQ(json(""), "f.yml: line 1: expected a mapping, got nothing");
  EXPECT_EQ(json("a: [1, 2\n"), "f.yml: line 1: a list or mapping does not end");
  EXPECT_EQ(json("a: 1\n   b: 2\n"), "f.yml: line 2: is indented more than what it belongs to");
  EXPECT_EQ(json("a: |\n  text\n"),
            "f.yml: line 1: block scalars, anchors and aliases are not read, got \"|\"");
  EXPECT_EQ(json("a: \"x\n"), "f.yml: line 1: a quoted text does not end on its line");
  EXPECT_EQ(json("a: " + std::string(100, '[')), "f.yml: line 1: is nested deeper than 64");
}

// Whatever a file is cut to, it is read or refused with a reason.
TEST(PhotographFiles, NoCutOfAFileCrashes) {
  PhotographFolder folder;
  const std::string r = rotation_text(", ");
  const std::pair<std::string, std::string> files[] = {
      {"s/images.txt", "1 " + quaternion_text() + " 0.3 -0.2 4 7 a.png\n1 2 3\n"},
      {"t/a.cam", "0.3 -0.2 4 " + rotation_text(" ") + "\n0.78125 0 0 1.04 0.4765625 0.53125\n"},
      {"u/a_cam.txt",
       "extrinsic\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n\nintrinsic\n50 0 30\n0 52 25\n0 0 1\n"},
      {"v/c.json",
       R"({"image": "a.png", "K": [50, 0, 32, 0, 50, 24, 0, 0, 1], "R": [)" + r + R"(], "t": [0, 0, 0]})"},
      {"w/c.yml",
       "%YAML:1.0\nimage: \"a.png\"\nK: !!opencv-matrix\n   data: [ 50., 0, 32, 0, 50,\n     24, 0, 0, 1 "
       "]\ncameras:\n"
       "  - { image: a.png, rvec: [0, 0, 0], tvec: [0, 0, 0] }\n"}};
  folder.write("s/cameras.txt", "7 PINHOLE 64 48 50 52 30.5 25.5\n");
  for (const auto& [name, text] : files) {
    const std::string set = name.substr(0, 1);
    folder.write(name, text);
    EXPECT_EQ(folder.messages(set), "added") << name;
    for (std::size_t length = 0; length < text.size(); ++length) {
      folder.write(name, text.substr(0, length));
      EXPECT_NE(folder.messages(set), "") << name << " " << length;
    }
  }
}

}  // namespace
}  // namespace laterna
