// Lights that are larger than points, and lenses that are wider: a picture of them is the mean of pictures lit from their
// points.
#pragma once

#include "base/sample_sequence.h"
#include "frame/frame.h"

namespace laterna::light {

/// Whether pictures lit by it differ from sample to sample: it has a size, or a lens that is open.
bool has_samples(const Light& light);

/// The light as it shines from one point of its source or lens, undiminished: the mean over all points is the light. A light
/// that has_samples() not, or a count of 1, is left where it is.
///
/// A rectangle and a strip have their points in equal fields (so that N points along a strip give exactly N + 1 steps of
/// a straight shadow's edge: Chen and Tung's soft shadow); a disc in the sky and a lens on Vogel's spiral; a ball is filled so
/// that it looks evenly bright from everywhere.
///
/// From a point of its lens (Aperture) a projector throws its slide through a sheared frustum, such that it stays where it is
/// on the plane at the focal distance (Haeberli and Akeley 1990, section 4.2). A projector whose source has a size keeps its
/// direction: its slide is in focus at infinity.
frame::PlacedLight at_sample(const frame::PlacedLight& placed, SampleIndex sample);

}  // namespace laterna::light
