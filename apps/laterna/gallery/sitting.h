// A figure while it is being drawn: takes pictures of scenes and writes them beside the page.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "figure.h"
#include "laterna/lamps.h"
#include "laterna/render.h"
#include "scenery.h"

namespace laterna::app {

/// A scene, where it is seen from, and how its shadows are found.
struct Shot {
  Scene scene;
  Gaze camera;
  Angle yfov = Angle::degrees(34);
  RenderSettings
      settings;      ///< its size, in pixels, is that of the page's large pictures unless set otherwise
  double stops = 0;  ///< exposure of the picture

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

/// A shot made ready.
struct Drawing {
  Renderer renderer;
  View view;
  RenderSettings settings;  ///< with the size that the pictures of the page have
};

/// An amount of light as colours.
struct Amounts {
  Layer layer = Layer::lux;
  std::string channel = "lux.Y", unit = "lx";
  double maximum = 0;  ///< end of the scale; 0: found
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
  /// A layer as false colours, with a scale and iso-lines.
  void false_color(std::string caption, const Shot& shot, const Amounts& amounts);
  /// The polar intensity diagram of a measured lamp.
  void polar_plot(std::string caption, const LightDistribution& lamp);
  /// A picture that was put together elsewhere.
  void print(std::string caption, Result<LayeredImage> picture, int magnification = 1, double stops = 0) {
    add(std::move(caption), std::move(picture), magnification, stops);
  }

  /// For what no picture above is: the shot made ready; nothing after an error.
  std::optional<Drawing> prepare(const Shot& shot) { return outcome_ ? accept(set_up(shot)) : std::nullopt; }
  /// The value; or nothing, and the figure ends with the error.
  template <class Value>
  std::optional<Value> accept(Result<Value> result) {
    if (result) return std::move(*result);
    if (outcome_) outcome_ = tl::unexpected(std::move(result.error()));
    return std::nullopt;
  }
  /// Where a figure may put files of its own for the time that it is drawn.
  [[nodiscard]] const std::filesystem::path& folder() const { return darkroom_.folder; }
  [[nodiscard]] double scale() const { return darkroom_.scale; }

  /// How much of a light arrives in each pixel, one sample each; empty after an error.
  Visibility visibility(const Shot& shot, const std::string& light);

  [[nodiscard]] const std::vector<Panel>& panels() const { return panels_; }
  [[nodiscard]] const Result<void>& outcome() const { return outcome_; }

 private:
  [[nodiscard]] Result<Drawing> set_up(const Shot& shot) const;
  [[nodiscard]] Result<LayeredImage> draw(const Shot& shot) const;
  /// Writes it as the figure's next picture.
  void add(std::string caption, Result<LayeredImage> image, int magnification = 1, double stops = 0);
  /// Whether the picture can be drawn; otherwise the figure says why not.
  bool can_draw(const std::string& caption, const Shot& shot);
  [[nodiscard]] std::string next_file(const char* ending = "png") const;

  const Darkroom& darkroom_;
  std::string id_;
  std::vector<Panel> panels_;
  Result<void> outcome_;
};

}  // namespace laterna::app
