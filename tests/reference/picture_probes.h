// Measuring in pictures: profiles, where they cross a value, how straight a line is.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "laterna/image.h"

namespace laterna::reference {

/// The values of a channel; throws std::runtime_error where there is none of that name.
std::span<const float> values_of(const LayeredImage& image, const std::string& channel);
std::span<const float> values_of(LayeredImage&&, const std::string&) = delete;  // they live in the picture
/// One row, left to right.
std::span<const float> row_of(const LayeredImage& image, const std::string& channel, int y);
std::span<const float> row_of(LayeredImage&&, const std::string&, int) = delete;

/// Where a profile crosses `threshold`, linearly between pixel centres; the centre of pixel i is at i + 0.5.
std::vector<double> crossings(std::span<const float> values, double threshold);

/// Largest distance of the points from the line that fits them best.
double line_fit_residual(std::span<const glm::dvec2> points);

/// Pixels whose values are not the same bits, over the channels of `a`, which `b` must have too.
std::size_t count_different_pixels(const LayeredImage& a, const LayeredImage& b);

/// Coefficient of determination of `model` as an explanation of `measured`.
double r_squared(std::span<const double> measured, std::span<const double> model);

}  // namespace laterna::reference
