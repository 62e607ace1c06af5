// Pictures side by side, such as the frames of a film.
#pragma once

#include <vector>

#include "laterna/image.h"

namespace laterna::app {

/// R, G and B of pictures of one size in rows from the top, with white between them. Empty where there is no picture.
LayeredImage contact_sheet(const std::vector<std::vector<LayeredImage>>& rows);

}  // namespace laterna::app
