// Labels in pictures: a font of 5 × 7 squares for printable ASCII.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "laterna/image.h"

namespace laterna::image {

inline constexpr int kGlyphWidth = 5, kGlyphHeight = 7;
inline constexpr int kGlyphAdvance = 6;  ///< from one character to the next

/// Pixels from the first column of a line of text to its last. Its height is kGlyphHeight * scale.
int text_width(std::string_view text, int scale = 1);

/// As many of its characters as fit into a width in pixels, with ".." for the rest; empty where not even one does.
std::string fitted_text(std::string_view text, int width, int scale = 1);

/// Writes one line over the channels R, G and B, its top-left corner at (left, top); what lies beside the picture is cut
/// off. Each square of the font is `scale` × `scale` pixels. Characters beyond ASCII (UTF-8) are drawn as a frame.
void draw_text(LayeredImage& image, int left, int top, std::string_view text,
               const std::array<float, 3>& color, int scale = 1);

}  // namespace laterna::image
