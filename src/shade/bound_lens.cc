#include "shade/bound_lens.h"

namespace laterna::shade {

BoundLens::BoundLens(const frame::SlideLens& lens)
    : k1(static_cast<float>(lens.distortion.k1)),
      k2(static_cast<float>(lens.distortion.k2)),
      p1(static_cast<float>(lens.distortion.p1)),
      p2(static_cast<float>(lens.distortion.p2)),
      k3(static_cast<float>(lens.distortion.k3)),
      field_squared(static_cast<float>(lens.field * lens.field)) {
  const Projection &beam = lens.beam, &frame = lens.frame;
  const double width = frame.right - frame.left, height = frame.top - frame.bottom;
  x_scale = static_cast<float>(beam.right - beam.left);
  x_offset = static_cast<float>(beam.left);
  y_scale = static_cast<float>(beam.top - beam.bottom);
  y_offset = static_cast<float>(-beam.top);
  s_scale = static_cast<float>(1 / width);
  s_offset = static_cast<float>(-frame.left / width);
  t_scale = static_cast<float>(1 / height);
  t_offset = static_cast<float>(frame.top / height);
}

}  // namespace laterna::shade
