// The picture by which lighting designers know a lamp.
#pragma once

#include <filesystem>
#include <string>

#include "laterna/lamps.h"

namespace laterna {

/// The polar intensity diagram as an SVG document: candela by angle in the sections C0–C180 (C0 to the right) and
/// C90–C270, photometric zero downward. The distribution must have passed find_fault().
std::string polar_plot_svg(const LightDistribution& distribution);

/// The same into a file, which is either complete or not there. Error: it cannot be written.
Result<void> write_polar_plot(const LightDistribution& distribution, const std::filesystem::path& file);

}  // namespace laterna
