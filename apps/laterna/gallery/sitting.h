// A figure while it is being drawn: takes pictures of scenes and writes them beside the page.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "figure.h"
#include "laterna/render.h"
#include "scenery.h"

namespace laterna::app {

/// A scene, where it is seen from, and how its shadows are found.
struct Shot {
  Scene scene;
  Gaze camera;
  Angle yfov = Angle::degrees(34);
  RenderSettings
      settings;  ///< its size, in pixels, is that of the page's large pictures unless set otherwise

  Shot();
  /// The same with its shadows found in another way.
  [[nodiscard]] Shot with(ShadowTechnique technique) const;
};

/// A part of a picture: of its width and height, from the top-left corner.
struct Detail {
  double left = 0, top = 0, width = 1, height = 1;
  int magnification = 4;
};

/// What of a light arrives in each pixel, 0 to 1; rows from the top.
struct Visibility {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// How pictures are made.
struct Darkroom {
  std::filesystem::path folder;
  double scale = 1;  ///< of the pictures' sides
  RendererOptions renderer;
};

/// After the first error nothing more is drawn, and error() tells it.
class Sitting {
 public:
  Sitting(const Darkroom& darkroom, std::string_view id) : darkroom_(darkroom), id_(id) {}

  void picture(std::string caption, const Shot& shot);
  /// An enlarged part of the picture.
  void detail(std::string caption, const Shot& shot, const Detail& part);
  /// What a light sees.
  void light_view(std::string caption, const Shot& shot, const std::string& light);
  /// Its depth map: near is light, far is dark.
  void depth_map(std::string caption, const Shot& shot, const std::string& light);
  /// That map thrown on the scene.
  void projected_depth(std::string caption, const Shot& shot, const std::string& light);
  /// The scene without shadows, black where the light does not arrive.
  void failures(std::string caption, const Shot& shot, const std::string& light);
  /// A slide or texture as it is.
  void image(std::string caption, const Image& image);
  /// A picture with each technique, and below it what `laterna accuracy` says of it.
  void techniques(const Shot& shot);
  /// How much of a light arrives in each pixel, one sample each; empty after an error.
  Visibility visibility(const Shot& shot, const std::string& light);

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] const Result<void>& outcome() const { return outcome_; }

 private:
  struct Drawing;
  [[nodiscard]] Result<Drawing> set_up(const Shot& shot) const;
  [[nodiscard]] Result<LayeredImage> draw(const Shot& shot) const;
  /// Writes it as the figure's next picture.
  void add(std::string caption, Result<LayeredImage> image, int magnification = 1);
  /// Whether the picture can be drawn; otherwise the figure says why not.
  bool can_draw(const std::string& caption, const Shot& shot);
  std::string next_file();

  const Darkroom& darkroom_;
  std::string id_;
  std::vector<Panel> panels_;
  Result<void> outcome_;
};

}  // namespace laterna::app
