// Pictures whose texels are numbers.
#pragma once

#include <optional>
#include <string>

#include "laterna/image.h"

namespace laterna::image {

/// The first value that is infinite or no number, as a fault of the picture `name`: it would spread over every level of a
/// mip chain, and from there over what is rendered.
std::optional<Diagnostic> find_not_finite(const Image& image, const std::string& name);

}  // namespace laterna::image
