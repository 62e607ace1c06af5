// The accumulation buffer (Haeberli and Akeley, The accumulation buffer: hardware support for high-quality rendering,
// 1990): a picture as the mean of many, each of the same scene seen a little differently.
#pragma once

#include <vector>

#include "base/aligned_vector.h"
#include "laterna/render.h"
#include "render/channels.h"

namespace laterna::render {

/// Pictures are added in their order, so the mean is the same whoever draws them. Beauty is the sum of the mean layers of
/// ambient light and lights, as it is in each picture. Data (depth, normals, ids) is the first picture's.
class PictureAccumulation {
 public:
  PictureAccumulation(const RenderSettings& settings, const frame::Frame& frame, const TaskPool& pool);

  /// With what each picture is to be drawn, and where to.
  [[nodiscard]] const RenderSettings& picture_settings() const { return settings_; }
  [[nodiscard]] RenderTarget picture_target();
  /// The picture has been drawn.
  void add();

  [[nodiscard]] int count() const { return count_; }
  /// Estimated standard error of the mean's luminance over all pixels, as a fraction of the mean luminance: from how the
  /// pictures of even and odd number differ, at the last even number of them; 0 before the second.
  [[nodiscard]] double noise() const { return noise_; }
  /// Writes the mean so far; the target has been checked (PictureWriter::create).
  void write(const RenderSettings& settings, const RenderTarget& target, InstructionSet set,
             const frame::Frame& frame);

 private:
  using Plane = AlignedVector<float>;
  struct Slot {
    std::string name;
    bool is_light;
    Plane picture, sum;  // between pictures, `picture` has room for the mean
  };
  [[nodiscard]] const Slot& slot(const std::string& name) const;
  void find_mean();
  void sum_lights(int channel);
  [[nodiscard]] double estimate_noise() const;

  RenderSettings settings_;
  const TaskPool& pool_;
  std::size_t pixels_;
  std::vector<Slot> slots_;
  Plane alternating_;  // luminance of even pictures less that of odd ones
  double luminance_ = 0;
  double noise_ = 0;
  int count_ = 0;
};

}  // namespace laterna::render
