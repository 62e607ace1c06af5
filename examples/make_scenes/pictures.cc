#include "pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace laterna::examples {
namespace {

constexpr float kPi = 3.14159265F;

std::uint8_t to_code(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
}

/// Colours as they are seen (sRGB), x and y in 0…1 from the top-left corner, mean of 3 × 3 places per pixel.
Image paint(int width, int height, int channels, const std::function<glm::vec4(glm::vec2)>& colour) {
  Image image(width, height, channels, PixelType::u8, Transfer::srgb);
  const std::span<std::uint8_t> values = image.values<std::uint8_t>();
  const glm::vec2 size(width, height);
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      glm::vec4 sum(0);
      for (int part = 0; part < 9; ++part) {
        const glm::vec2 place = glm::vec2(x, y) + (glm::vec2(part % 3, part / 3) + 0.5F) / 3.0F;
        sum += colour(place / size);
      }
      for (int c = 0; c < channels; ++c) values[i++] = to_code(sum[c] / 9);
    }
  }
  return image;
}

/// A number in 0…1 that looks random, for whole x and y.
float scatter(int x, int y) {
  auto n = static_cast<std::uint32_t>(x) * 374761393U + static_cast<std::uint32_t>(y) * 668265263U;
  n = (n ^ (n >> 13U)) * 1274126177U;
  return static_cast<float>((n ^ (n >> 16U)) & 0xFFFFU) / 65535.0F;
}

/// Value noise in 0…1 that repeats every `period` cells.
float noise(glm::vec2 p, int period) {
  const glm::vec2 cell = glm::floor(p);
  const glm::vec2 f = glm::smoothstep(glm::vec2(0), glm::vec2(1), p - cell);
  const auto at = [&](int dx, int dy) {
    const auto wrap = [&](float v, int d) { return ((static_cast<int>(v) + d) % period + period) % period; };
    return scatter(wrap(cell.x, dx), wrap(cell.y, dy));
  };
  return glm::mix(glm::mix(at(0, 0), at(1, 0), f.x), glm::mix(at(0, 1), at(1, 1), f.x), f.y);
}

/// Octaves of noise; repeats over 0…1.
float clouds(glm::vec2 p, int period) {
  float sum = 0;
  float weight = 0.5F;
  for (int octave = 0; octave < 4; ++octave, period *= 2, weight /= 2) {
    sum += weight * noise(p * static_cast<float>(period), period);
  }
  return sum;
}

}  // namespace

Image paint_bricks(int side) {
  return paint(side, side, 3, [](glm::vec2 p) {
    constexpr int kRows = 8;
    constexpr int kColumns = 4;
    const float row = p.y * kRows;
    const int r = static_cast<int>(row);
    const float column = p.x * kColumns + (r % 2 == 0 ? 0.0F : 0.5F);
    const glm::vec2 inside(column - std::floor(column), row - std::floor(row));
    const glm::vec2 edge = glm::min(inside, 1.0F - inside) * glm::vec2(2, 1);
    const float grain = clouds(p, 16);
    if (std::min(edge.x, edge.y) < 0.06F)
      return glm::vec4(glm::vec3(0.70F, 0.69F, 0.66F) * (0.8F + 0.25F * grain), 1);
    const float tone =
        0.85F + 0.15F * scatter(static_cast<int>(column) % kColumns, r) + 0.2F * (grain - 0.5F);
    return glm::vec4(glm::vec3(0.86F, 0.80F, 0.74F) * tone, 1);
  });
}

Image paint_boards(int side) {
  return paint(side, side, 3, [](glm::vec2 p) {
    constexpr int kBoards = 6;
    const float board = p.x * kBoards;
    const int b = static_cast<int>(board);
    const float across = board - static_cast<float>(b);
    const float grain =
        clouds({p.x * 6 + scatter(b, 7), p.y}, 4) * 0.4F + 0.6F * noise({p.x * 96, p.y * 4}, 96);
    const float seam = std::min(across, 1 - across) < 0.02F ? 0.45F : 1.0F;
    const float tone = seam * (0.72F + 0.25F * scatter(b, 3) + 0.22F * (grain - 0.5F));
    return glm::vec4(glm::vec3(0.78F, 0.66F, 0.52F) * tone, 1);
  });
}

Image paint_marble(int side) {
  return paint(side, side, 3, [](glm::vec2 p) {
    const float vein = std::abs(std::sin(2 * kPi * (p.x + p.y) + 6 * clouds(p, 4)));
    return glm::vec4(glm::vec3(0.93F, 0.92F, 0.90F) * (0.78F + 0.22F * std::pow(vein, 0.35F)), 1);
  });
}

Image paint_trellis(int side) {
  return paint(side, side, 4, [](glm::vec2 p) {
    const auto is_lath = [](float v) { return std::abs(v - std::round(v)) < 0.11F; };
    const float falling = (p.x + p.y) * 6;
    const float rising = (p.x - p.y) * 6;
    const bool is_frame = std::min({p.x, p.y, 1 - p.x, 1 - p.y}) < 0.03F;
    const bool is_wood = is_frame || is_lath(falling) || is_lath(rising);
    return glm::vec4(glm::vec3(0.55F, 0.60F, 0.48F) * (0.8F + 0.3F * clouds(p, 8)), is_wood ? 1 : 0);
  });
}

Image paint_slide(int width, int height) {
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  return paint(width, height, 3, [aspect](glm::vec2 p) {
    constexpr float kShore = 0.66F;
    // The lake shows the sky upside down, a little darker and stirred.
    const bool is_lake = p.y > kShore;
    const float ripple = is_lake ? 0.03F * (p.y - kShore) * std::sin(40 / (p.y - kShore + 0.12F)) : 0;
    const glm::vec2 q(p.x + ripple, is_lake ? 2 * kShore - p.y : p.y);
    glm::vec3 colour =
        glm::mix(glm::vec3(0.16F, 0.22F, 0.55F), glm::vec3(1.0F, 0.62F, 0.25F), std::pow(q.y / kShore, 1.3F));
    const float sun = glm::length((q - glm::vec2(0.70F, 0.40F)) * glm::vec2(aspect, 1));
    colour = glm::mix(colour, glm::vec3(1.0F, 0.93F, 0.55F), 1 - glm::smoothstep(0.085F, 0.10F, sun));
    for (int range = 0; range < 3; ++range) {
      const auto far = static_cast<float>(range);
      const float ridge = kShore - 0.30F + 0.10F * far +
                          0.18F * (clouds({0.6F * q.x + 0.31F * far, 0.17F * far}, 5 + range) - 0.35F) * 1.6F;
      if (q.y > ridge)
        colour = glm::mix(glm::vec3(0.42F, 0.30F, 0.52F), glm::vec3(0.10F, 0.12F, 0.20F), far / 2);
    }
    if (is_lake) colour = colour * 0.72F + glm::vec3(0.0F, 0.04F, 0.10F);
    const glm::vec2 boat = (p - glm::vec2(0.30F, 0.80F)) * glm::vec2(aspect, 1);
    const bool is_hull = boat.y > 0 && boat.y < 0.035F && std::abs(boat.x) < 0.10F - boat.y;
    const bool is_sail =
        boat.y < -0.01F && boat.y > -0.30F && boat.x > 0.005F && boat.x < 0.12F * (1 + boat.y / 0.30F);
    const bool is_jib =
        boat.y < -0.03F && boat.y > -0.24F && boat.x < -0.005F && boat.x > -0.07F * (1 + boat.y / 0.24F);
    if (is_hull) colour = glm::vec3(0.95F, 0.95F, 0.92F);
    if (is_sail) colour = glm::vec3(0.92F, 0.10F, 0.08F);
    if (is_jib) colour = glm::vec3(1.0F, 0.95F, 0.85F);
    return glm::vec4(colour, 1);
  });
}

namespace {

/// The glass of a rose window at a place from −1 to 1.
glm::vec3 rose_glass(glm::vec2 p) {
  constexpr glm::vec3 kLead(0.03F, 0.03F, 0.04F);
  constexpr glm::vec3 kGold(0.98F, 0.78F, 0.22F);
  constexpr glm::vec3 kPetals[] = {{0.10F, 0.22F, 0.80F}, {0.85F, 0.10F, 0.14F}};
  constexpr glm::vec3 kRim[] = {{0.12F, 0.55F, 0.30F}, {0.95F, 0.88F, 0.72F}, {0.45F, 0.14F, 0.60F}};
  constexpr float kThick = 0.014F;  // half of the lead's width
  const float radius = glm::length(p);
  const float turn = std::atan2(p.x, -p.y) / (2 * kPi) * 12 + 24;
  const auto petal = static_cast<int>(std::floor(turn + 0.5F));
  const float from_seam = std::abs(std::abs(turn - std::floor(turn + 0.5F)) - 0.5F) * radius * 2 * kPi / 12;
  for (const float ring : {0.2F, 0.66F, 0.94F}) {
    if (std::abs(radius - ring) < kThick) return kLead;
  }
  if (radius < 0.2F) return kGold;
  if (from_seam < kThick) return kLead;
  // A roundel where a petal meets the rim.
  const float angle = static_cast<float>(petal) * 2 * kPi / 12;
  const float from_roundel = glm::distance(p, 0.8F * glm::vec2(std::sin(angle), -std::cos(angle)));
  if (radius > 0.66F && std::abs(from_roundel - 0.1F) < kThick) return kLead;
  if (from_roundel < 0.1F) return kGold;
  return radius < 0.66F ? kPetals[petal % 2] : kRim[petal % 3];
}

}  // namespace

Image paint_rose(int side) {
  return paint(side, side, 4, [](glm::vec2 place) {
    const glm::vec2 p = 2.0F * place - 1.0F;
    return glm::length(p) < 0.954F ? glm::vec4(rose_glass(p), 1) : glm::vec4(0);
  });
}

Image paint_star(int side) {
  Image image(side, side, 1, PixelType::u8, Transfer::linear);
  const std::span<std::uint8_t> values = image.values<std::uint8_t>();
  std::size_t i = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const glm::vec2 p = (glm::vec2(x, y) + 0.5F) * (2.0F / static_cast<float>(side)) - 1.0F;
      // Between a point of the star (at angle 0) and the notch beside it the outline is straight.
      const float turn = std::atan2(p.x, -p.y) / (2 * kPi) * 5;
      const float angle = std::abs(turn - std::round(turn)) * 2 * kPi / 5;
      const glm::vec2 q = glm::length(p) * glm::vec2(std::cos(angle), std::sin(angle));
      constexpr float kPoint = 0.9F;
      constexpr float kNotch = 0.42F;
      const glm::vec2 notch(kNotch * std::cos(kPi / 5), kNotch * std::sin(kPi / 5));
      const glm::vec2 along = glm::normalize(notch - glm::vec2(kPoint, 0));
      const float inside = along.x * q.y - along.y * (q.x - kPoint);
      const float edge = glm::smoothstep(-0.03F, 0.03F, inside);
      values[i++] = to_code(edge * (1 - 0.6F * glm::dot(p, p)));
    }
  }
  return image;
}

namespace {

Image paint_intensity(int width, int height, const std::function<float(glm::vec2)>& intensity) {
  Image image(width, height, 1, PixelType::u16, Transfer::linear);
  const std::span<std::uint16_t> values = image.values<std::uint16_t>();
  std::size_t i = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float value = std::clamp(intensity(glm::vec2(x, y) + 0.5F), 0.0F, 1.0F);
      values[i++] = static_cast<std::uint16_t>(std::lround(65535 * value));
    }
  }
  return image;
}

/// Candela in a direction with these tangents to the right and up. The cut-off is UN Regulation 112's: level, 1 % below
/// the lamp, and rising by 15° to the right of the axis.
float low_beam_candela(float right, float up) {
  constexpr float kDip = 0.01F;
  constexpr float kRise = 0.26794919F;  // tan 15°
  constexpr float kEdge = 0.002F;       // half the width of the cut-off
  const float below = std::max(right, 0.0F) * kRise - kDip - up;
  const float depth = std::max(below, 0.0F);
  const auto bell = [](float x, float width) { return std::exp(-x * x / (2 * width * width)); };
  // A hot spot close under the cut-off, and a wide carpet of light.
  const float lit = 18000 * bell(right - 0.02F, 0.07F) * std::exp(-depth / 0.035F) +
                    6000 * bell(right, 0.3F) * std::exp(-depth / 0.12F);
  constexpr float kStray = 120;
  // Nothing is cut off by the map's own sides.
  const float within =
      (1 - glm::smoothstep(0.55F, 0.8F, std::abs(right))) * glm::smoothstep(-0.4F, -0.28F, up);
  return within * (kStray * bell(right, 0.3F) + lit * glm::smoothstep(-kEdge, kEdge, below));
}

}  // namespace

Image paint_low_beam() {
  return paint_intensity(1024, 320, [](glm::vec2 p) {
    return low_beam_candela((p.x - 512) / 640, (64 - p.y) / 640) / kLowBeamCandela;
  });
}

Image paint_beam(int width, int height) {
  return paint_intensity(width, height, [width, height](glm::vec2 p) {
    const glm::vec2 q = 2.0F * p / glm::vec2(width, height) - 1.0F;
    const float out = glm::dot(q, q);
    return std::pow(10.0F, -out) * (1 - glm::smoothstep(0.8F, 1.0F, out));
  });
}

}  // namespace laterna::examples
