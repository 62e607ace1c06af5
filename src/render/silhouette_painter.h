// Silhouettes, drawn by the camera's own raster code.
#pragma once

#include "frame/frame.h"
#include "laterna/instruction_set.h"
#include "light/silhouette_plan.h"
#include "render/reuse_pool.h"
#include "shadow/silhouette_texture.h"

namespace laterna::render {

class SilhouettePainter final : public shadow::SilhouettePainter {
 public:
  /// `frame` and `bins` stay while the painter lives.
  SilhouettePainter(const frame::Frame& frame, BinsPool& bins, InstructionSet set, CasterFaces faces);
  void paint(std::uint32_t object, const raster::RasterView& view,
             shadow::ArrivingLight& picture) const override;

 private:
  const frame::Frame& frame_;
  BinsPool& bins_;
  InstructionSet set_;
  CasterFaces faces_;
  std::vector<std::uint32_t> first_cluster_;  // by object, and the end
};

}  // namespace laterna::render
