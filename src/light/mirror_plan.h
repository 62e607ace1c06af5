// What mirrors and water show in a picture: an ordered tree of views that depend on one another. docs/mirrors.md
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "frame/frame.h"
#include "laterna/mirrors.h"
#include "laterna/view.h"
#include "light/pixel_box.h"

namespace laterna::light {

/// The surfaces of an object that have one material with a Mirror, and the plane that they lie in.
struct FlatMirror {
  const Mirror* mirror = nullptr;
  glm::dvec3 normal_ws{0};  ///< unit, of the front; the plane: normal · position = offset
  double offset = 0;        ///< metres
  double deviation = 0;     ///< metres that corners lie off the plane, or a little more than rounding
  bool double_sided = false;
  std::uint32_t surface = 0, object = 0;
  int plane = 0;  ///< the first mirror that lies in the same plane, as far as deviations tell: an index
  std::vector<std::uint32_t> clusters;
};

/// In the frame's order. Errors, at the places where their Mirrors are written: those that are not flat (kMirrorFlatness), and waves
/// that run straight through them.
Result<std::vector<FlatMirror>> find_mirrors(const frame::Frame& frame);

/// The view as the mirror has it: what it sees at a pixel, `view` sees by the mirror at the pixel as far from the opposite
/// side of the picture.
View mirrored(const View& view, const glm::dvec3& normal_ws, double offset);

/// The same pixels of the mirrored picture, and back.
inline PixelBox mirrored(const PixelBox& box, int width) {
  return {width - box.x_end, box.y_begin, width - box.x_begin, box.y_end};
}

/// What one mirror shows to a view: what it mirrors, or what lies behind it.
struct MirrorView {
  int mirror = -1;  ///< index into MirrorPlan::mirrors
  int parent = -1;  ///< the view that looks into it: index into MirrorPlan::views, −1: the picture's own
  int depth = 1;    ///< mirrors on the way
  bool is_refracted = false;  ///< what lies behind the surface (Mirror::volume), from refracted_view()
  bool is_turned = false;     ///< its left is the picture's right: an odd number of reflections on the way
  bool sees_back = false;     ///< of the mirror: the parent's eye is where its volume is
  View view;                  ///< of the mirrored picture
  /// Metres on the other side of the plane that are shown too: about two pixels of what is refracted, so that what stands in
  /// water goes on at the waterline.
  double margin = 0;
  PixelBox box;             ///< of the mirrored picture, what its parent needs
  glm::dvec3 normal_ws{0};  ///< toward the parent's eye
  double offset = 0;        ///< of the plane: normal_ws · position = offset
  /// Reflections on the way, 2 · the mirror's number, and refractions, one more: which view it is, in other pictures too.
  std::vector<int> way;

  /// Not negative where what it shows lies, metres from the plane: before the mirror, or behind it where it is refracted.
  [[nodiscard]] double side(const glm::dvec3& position_ws) const {
    const double before = glm::dot(normal_ws, position_ws) - offset;
    return is_refracted ? -before : before;
  }
};

struct MirrorPlan {
  std::vector<FlatMirror> mirrors;
  /// Parents before what they see. To be drawn from the last to the first.
  std::vector<MirrorView> views;
};

/// What a picture of width × height pixels needs: of mirrors that face the view and lie in it, whether or not something stands
/// before them. depth: 0 … kMaxMirrorDepth. Error: as find_mirrors().
Result<MirrorPlan> make_mirror_plan(const frame::Frame& frame, const View& view, int width, int height,
                                    int depth);

}  // namespace laterna::light
