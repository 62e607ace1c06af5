// Points of lights that have a size. A picture of such a light is the mean of pictures lit from its points.
#pragma once

#include "frame/frame.h"

namespace laterna::light {

/// Point number `index` of `count`. The first of them are spread over the source too, so that one may stop early.
struct SourcePoint {
  int index = 0, count = 1;
};

/// The light as it shines from one point of its source, undiminished: the mean over all points is the light. A light
/// without size, or a count of 1, is left where it is.
///
/// A rectangle and a strip have their points in equal fields (so that N points along a strip give exactly N + 1 steps of
/// a straight shadow's edge: Chen and Tung's soft shadow); a disc in the sky on Vogel's spiral; a ball is filled so that
/// it looks evenly bright from everywhere. A projector keeps its direction: its slide is thrown from each point of the lens,
/// in focus at infinity.
frame::PlacedLight at_source_point(const frame::PlacedLight& placed, SourcePoint point);

}  // namespace laterna::light
