#include "paintings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string_view>
#include <tuple>

#include "solids.h"

namespace laterna::app {
namespace {

std::uint8_t to_code(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
}

/// Colours as they are seen (sRGB), x and y in 0…1 from the top-left corner, mean of 3 × 3 places per pixel.
Image paint(int width, int height, const std::function<glm::vec3(glm::vec2)>& colour) {
  Image image(width, height, 3, PixelType::u8, Transfer::srgb);
  const std::span<std::uint8_t> values = image.values<std::uint8_t>();
  const glm::vec2 size(width, height);
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      glm::vec3 sum(0);
      for (int part = 0; part < 9; ++part) {
        sum += colour((glm::vec2(x, y) + (glm::vec2(part % 3, part / 3) + 0.5F) / 3.0F) / size);
      }
      for (int c = 0; c < 3; ++c) values[i++] = to_code(sum[c] / 9);
    }
  }
  return image;
}

/// The same of a picture that figures ask for again and again: to paint it takes longer than to draw them small. By one
/// thread at a time.
Image paint_once(std::string_view name, int width, int height,
                 const std::function<glm::vec3(glm::vec2)>& colour) {
  static std::map<std::tuple<std::string_view, int, int>, Image> painted;
  const std::tuple key(name, width, height);
  const auto known = painted.find(key);
  if (known != painted.end()) return known->second;
  return painted.emplace(key, paint(width, height, colour)).first->second;
}

/// A number in 0…1 that looks random, for whole x and y.
float scatter(int x, int y) {
  auto n = static_cast<std::uint32_t>(x) * 374761393U + static_cast<std::uint32_t>(y) * 668265263U;
  n = (n ^ (n >> 13U)) * 1274126177U;
  return static_cast<float>((n ^ (n >> 16U)) & 0xFFFFU) / 65535.0F;
}

float fraction(float value) { return value - std::floor(value); }
int whole(float value) { return static_cast<int>(std::floor(value)); }

/// A line of mountains: tops and passes at random heights, 0…1, straight between them.
float ridge(float x, int seed) {
  const int i = whole(x);
  return glm::mix(scatter(i, seed), scatter(i + 1, seed), fraction(x));
}

constexpr float kShore = 0.66F;

/// Sky, sun and mountains; y down to the shore.
glm::vec3 landscape(glm::vec2 p, float aspect) {
  const float height = p.y / kShore;
  glm::vec3 colour = glm::mix(glm::vec3(0.16F, 0.24F, 0.58F), glm::vec3(1.0F, 0.64F, 0.27F), height * height);
  const float sun = glm::length((p - glm::vec2(0.70F, 0.38F)) * glm::vec2(aspect, 1));
  colour = glm::mix(glm::vec3(1.0F, 0.93F, 0.55F), colour, glm::smoothstep(0.085F, 0.10F, sun));
  for (int range = 0; range < 3; ++range) {
    const auto near = static_cast<float>(range);
    const float top = kShore - 0.28F + 0.085F * near + 0.12F * ridge(p.x * (5 + 2 * near), 5 + range);
    if (p.y > top)
      colour = glm::mix(glm::vec3(0.42F, 0.30F, 0.52F), glm::vec3(0.10F, 0.12F, 0.20F), near / 2);
  }
  return colour;
}

}  // namespace

Image paint_tiles(int side) {
  return paint_once("tiles", side, side, [](glm::vec2 p) {
    const glm::vec2 tile = p * 4.0F;
    const glm::vec2 inside(fraction(tile.x), fraction(tile.y));
    const float edge = std::min({inside.x, inside.y, 1 - inside.x, 1 - inside.y});
    if (edge < 0.012F) return glm::vec3(0.58F, 0.57F, 0.55F);
    const int x = whole(tile.x);
    const int y = whole(tile.y);
    const float tone = ((x + y) % 2 == 0 ? 0.80F : 0.73F) + 0.02F * scatter(x, y);
    return glm::vec3(1.0F, 0.98F, 0.94F) * tone;
  });
}

Image paint_boards(int side) {
  return paint_once("boards", side, side, [](glm::vec2 p) {
    constexpr int kBoards = 6;
    const float board = p.x * kBoards;
    const int b = whole(board);
    const float across = fraction(board);
    if (std::min(across, 1 - across) < 0.02F) return glm::vec3(0.34F, 0.28F, 0.22F);
    const float grain =
        0.5F * scatter(whole(p.x * 96), b) + 0.5F * ridge(p.x * 48 + 0.6F * ridge(p.y * 5, b), 3);
    return glm::vec3(0.78F, 0.66F, 0.52F) * (0.86F + 0.14F * scatter(b, 3) + 0.1F * (grain - 0.5F));
  });
}

Image paint_coat(int side) {
  return paint_once("coat", side, side, [](glm::vec2 p) {
    constexpr std::array<glm::vec3, 4> kColours = {
        {{0.86F, 0.36F, 0.22F}, {0.95F, 0.80F, 0.45F}, {0.26F, 0.52F, 0.56F}, {0.93F, 0.90F, 0.82F}}};
    const glm::vec2 q(fraction(p.x * 4) - 0.5F, fraction(p.y * 5) - 0.5F);
    const int band = whole(p.y * 5) % 4;
    const bool is_lozenge = std::abs(q.x) + std::abs(q.y) < 0.36F;
    return kColours.at(static_cast<std::size_t>(is_lozenge ? (band + 2) % 4 : band));
  });
}

Image paint_lake(int width, int height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return paint_once("lake", width, height, [aspect](glm::vec2 p) {
    // The lake shows the sky upside down, a little darker and stirred.
    const bool is_lake = p.y > kShore;
    glm::vec3 colour = landscape(p, aspect);
    if (is_lake) {
      const float stir = 0.012F * (ridge(p.y * 90, 11) - 0.5F);
      colour = landscape({p.x + stir, 2 * kShore - p.y}, aspect) * 0.72F + glm::vec3(0, 0.04F, 0.10F);
    }
    const glm::vec2 boat = (p - glm::vec2(0.30F, 0.80F)) * glm::vec2(aspect, 1);
    const bool is_hull = boat.y > 0 && boat.y < 0.035F && std::abs(boat.x) < 0.10F - boat.y;
    const bool is_sail =
        boat.y < -0.01F && boat.y > -0.30F && boat.x > 0.005F && boat.x < 0.12F * (1 + boat.y / 0.30F);
    const bool is_jib =
        boat.y < -0.03F && boat.y > -0.24F && boat.x < -0.005F && boat.x > -0.07F * (1 + boat.y / 0.24F);
    if (is_hull) colour = glm::vec3(0.95F, 0.95F, 0.92F);
    if (is_sail) colour = glm::vec3(0.92F, 0.10F, 0.08F);
    if (is_jib) colour = glm::vec3(1.0F, 0.95F, 0.85F);
    return colour;
  });
}

Image paint_grid(int width, int height, const std::function<glm::vec2(glm::vec2)>& bend) {
  return paint(width, height, [&](glm::vec2 place) {
    const glm::vec2 p = bend(place);
    if (p.x < 0 || p.x > 1 || p.y < 0 || p.y > 1) return glm::vec3(0);
    const glm::vec2 cell = p * glm::vec2(16, 9);
    const float rim = std::min({cell.x, 16 - cell.x, cell.y, 9 - cell.y});
    if (rim < 0.12F) return glm::vec3(0.92F, 0.25F, 0.12F);
    const float line = std::min(std::min(fraction(cell.x), 1 - fraction(cell.x)),
                                std::min(fraction(cell.y), 1 - fraction(cell.y)));
    if (line < 0.045F) return glm::vec3(0.1F, 0.1F, 0.18F);
    return (whole(cell.x) + whole(cell.y)) % 2 == 0 ? glm::vec3(0.94F, 0.93F, 0.88F)
                                                    : glm::vec3(0.56F, 0.70F, 0.88F);
  });
}

Image paint_focus_chart(int width, int height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(3 * height);
  return paint(width, height, [aspect](glm::vec2 p) {
    const glm::vec2 q(fraction(3 * p.x), p.y);
    if (std::min({q.x * aspect, (1 - q.x) * aspect, q.y, 1 - q.y}) < 0.02F)
      return glm::vec3(0.92F, 0.25F, 0.12F);
    if (q.y < 0.5F) return glm::vec3(fraction(1.5F * q.x + 14 * q.x * q.x) < 0.5F ? 0.05F : 0.95F);
    const glm::vec2 cell(4 * q.x, 4 * (q.y - 0.5F));
    const glm::vec2 from_dot = (glm::vec2(fraction(cell.x), fraction(cell.y)) - 0.5F) * glm::vec2(aspect, 1);
    return glm::vec3(glm::length(from_dot) < 0.10F ? 1.0F : 0.02F);
  });
}

Image paint_dot(int side, float diameter) {
  return paint(side, side,
               [=](glm::vec2 p) { return glm::vec3(glm::length(p - 0.5F) < diameter / 2 ? 1.0F : 0.0F); });
}

Image paint_leader(int width, int height, int number, int count) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const double turns = static_cast<double>(number) / count;
  const glm::vec2 hand(point_of_circle(turns - 0.25));  // clockwise from the top, y downward
  const auto is_clockwise = [](glm::vec2 from, glm::vec2 to) { return from.x * to.y - from.y * to.x >= 0; };
  return paint(width, height, [=](glm::vec2 p) {
    const glm::vec2 q = (p - glm::vec2(0.5F, 0.46F)) * glm::vec2(aspect, 1);
    const float out = glm::length(q);
    const bool is_swept =
        number >= count || (turns <= 0.5 ? is_clockwise({0, -1}, q) && is_clockwise(q, hand)
                                         : is_clockwise({0, -1}, q) || is_clockwise(q, hand));
    glm::vec3 colour =
        number > 0 && is_swept ? glm::vec3(0.95F, 0.62F, 0.20F) : glm::vec3(0.86F, 0.84F, 0.78F);
    if (std::min(std::abs(q.x), std::abs(q.y)) < 0.006F || std::abs(out - 0.36F) < 0.008F ||
        std::abs(out - 0.30F) < 0.008F) {
      colour = glm::vec3(0.12F);
    }
    for (int dot = 0; dot < number; ++dot) {
      const glm::vec2 place(0.10F * (static_cast<float>(dot) - 0.5F * static_cast<float>(number - 1)), 0.46F);
      if (glm::length(q - place) < 0.03F) colour = glm::vec3(0.75F, 0.10F, 0.08F);
    }
    return colour;
  });
}

Image paint_house_front(int width, int height) {
  return paint(width, height, [](glm::vec2 p) {
    const glm::vec2 cell = p * glm::vec2(4, 3);
    const int column = whole(cell.x);
    const int row = whole(cell.y);
    const glm::vec2 q = glm::vec2(fraction(cell.x), fraction(cell.y)) - glm::vec2(0.5F, 0.52F);
    const glm::vec2 a = glm::abs(q);
    constexpr std::array<glm::vec3, 4> kShutters = {
        {{0.20F, 0.42F, 0.34F}, {0.62F, 0.20F, 0.16F}, {0.20F, 0.34F, 0.58F}, {0.76F, 0.52F, 0.16F}}};
    if (a.x < 0.15F && a.y < 0.30F) {  // panes behind a cross
      const bool is_frame = a.x > 0.13F || a.y > 0.28F || a.x < 0.012F || std::abs(q.y + 0.08F) < 0.012F;
      return is_frame ? glm::vec3(0.93F, 0.91F, 0.86F)
                      : glm::vec3(0.25F, 0.33F, 0.42F) + 0.25F * scatter(column, row) * (0.3F - q.y);
    }
    if (a.x < 0.30F && a.y < 0.30F) {  // shutters with their laths
      const auto n = static_cast<std::size_t>(3.999F * scatter(column + 5, row));
      return kShutters.at(n) * (fraction(cell.y * 24) < 0.25F ? 0.72F : 1.0F);
    }
    if (a.x < 0.34F && q.y > 0.30F && q.y < 0.345F) return glm::vec3(0.80F, 0.78F, 0.74F);
    if (fraction(cell.y) < 0.05F) return glm::vec3(0.86F, 0.80F, 0.68F);
    const float grain = scatter(whole(p.x * 160), whole(p.y * 120));
    return glm::vec3(0.84F, 0.68F, 0.42F) * (0.94F + 0.06F * grain);
  });
}

namespace {

Image paint_intensity(int width, int height, const std::function<float(glm::vec2)>& intensity) {
  Image image(width, height, 1, PixelType::u16, Transfer::linear);
  const std::span<std::uint16_t> values = image.values<std::uint16_t>();
  const glm::vec2 size(width, height);
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float value = std::clamp(intensity((glm::vec2(x, y) + 0.5F) / size), 0.0F, 1.0F);
      values[i++] = static_cast<std::uint16_t>(std::lround(65535 * value));
    }
  }
  return image;
}

/// 1 in the middle, ¼ at ±1, and soon nothing.
float bell(float x) { return 1 / ((1 + x * x) * (1 + x * x)); }

}  // namespace

Image paint_dipped_beam(int width) {
  constexpr BeamFrame kFrame = kDippedBeam;
  const float height = static_cast<float>(width) * (kFrame.top - kFrame.bottom) / (2 * kFrame.right);
  return paint_intensity(width, static_cast<int>(std::lround(height)), [&](glm::vec2 p) {
    const float right = (2 * p.x - 1) * kFrame.right;
    const float up = glm::mix(kFrame.top, kFrame.bottom, p.y);
    constexpr float kDip = 0.01F;
    constexpr float kRise = 0.26794919F;  // tan 15°
    constexpr float kEdge = 0.002F;       // half the width of the cut-off
    const float below = std::max(right, 0.0F) * kRise - kDip - up;
    // A hot spot close under the cut-off, and a wide carpet of light.
    const float lit = 0.75F * bell((right - 0.02F) / 0.12F) * bell(below / 0.06F) +
                      0.25F * bell(right / 0.4F) * bell(below / 0.15F);
    const float within = (1 - glm::smoothstep(0.75F, 1.0F, std::abs(right) / kFrame.right)) *
                         (1 - glm::smoothstep(0.6F, 1.0F, up / kFrame.bottom));
    constexpr float kStray = 0.004F;
    return within * (kStray + lit * glm::smoothstep(-kEdge, kEdge, below));
  });
}

Image paint_round_beam(int side) {
  return paint_intensity(side, side, [](glm::vec2 p) {
    const float out = 2 * glm::length(p - 0.5F);
    return bell(2.94F * out) * (1 - glm::smoothstep(0.8F, 1.0F, out));
  });
}

Image paint_star(int side) {
  Image image(side, side, 1, PixelType::u8, Transfer::linear);
  const std::span<std::uint8_t> values = image.values<std::uint8_t>();
  std::size_t i = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const glm::vec2 p = (glm::vec2(x, y) + 0.5F) * (2.0F / static_cast<float>(side)) - 1.0F;
      // The star is what lies within all but one of five lines, at most.
      std::array<float, 5> inside{};
      for (std::size_t line = 0; line < 5; ++line) {
        const glm::vec2 out(point_of_circle(static_cast<double>(line) / 5 - 0.25));
        inside.at(line) = 0.29F - glm::dot(out, p);
      }
      std::ranges::sort(inside);
      const float edge = glm::smoothstep(-0.02F, 0.03F, inside[1]);
      values[i++] = to_code(edge * (1 - 0.6F * glm::dot(p, p)));
    }
  }
  return image;
}

}  // namespace laterna::app
