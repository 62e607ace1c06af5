// From a lens's picture to a pinhole's.
#pragma once

#include <string>

#include "laterna/image.h"
#include "laterna/view.h"
#include "scene/photograph_cameras.h"

namespace laterna {

/// The pinhole's picture: as many pixels per radian on the axis, and as wide as what the lens saw, but no more than twice the
/// pinhole's own frame to any side. It has an alpha channel, 0 where the lens saw nothing.
struct PinholeFrame {
  double left = 0, right = 0, top = 0, bottom = 0;  ///< at unit distance, y downward
  int width = 0, height = 0;
  double largest_radius = 0;  ///< beyond, the formula folds the picture over
};

/// `intrinsics` are of the picture, in its pixels. What is wrong is in `fault`: the distortion cannot be inverted somewhere in
/// the frame.
PinholeFrame find_pinhole_frame(const Intrinsics& intrinsics, const CameraDistortion& distortion,
                                std::string& fault);

/// Bicubic in the stored values (Keys 1981, a = −1/2); what lies outside continues the lens's edge.
Image undistort(const Image& picture, const Intrinsics& intrinsics, const CameraDistortion& distortion,
                const PinholeFrame& frame);

}  // namespace laterna
