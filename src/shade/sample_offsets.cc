#include "shade/sample_offsets.h"

#include <algorithm>
#include <array>
#include <span>

namespace laterna::shade {
namespace {

// Direct3D's standard multisample patterns, each row, column and (for 4 and more) diagonal used once; 1/256 pixel.
constexpr std::array<SampleOffset, 1> kOne = {{{0, 0}}};
constexpr std::array<SampleOffset, 2> kTwo = {{{64, 64}, {-64, -64}}};
constexpr std::array<SampleOffset, 4> kFour = {{{-32, -96}, {96, -32}, {-96, 32}, {32, 96}}};
constexpr std::array<SampleOffset, 8> kEight = {
    {{16, -48}, {-16, 48}, {80, 16}, {-48, -80}, {-80, 80}, {-112, -16}, {48, 112}, {112, -112}}};
constexpr std::array<SampleOffset, 16> kSixteen = {{{16, 16},
                                                    {-16, -48},
                                                    {-48, 32},
                                                    {64, -16},
                                                    {-80, -32},
                                                    {32, 80},
                                                    {80, 48},
                                                    {48, -80},
                                                    {-32, 96},
                                                    {0, -112},
                                                    {-64, -96},
                                                    {-96, 64},
                                                    {-128, 0},
                                                    {112, -64},
                                                    {96, 112},
                                                    {-112, -128}}};

std::span<const SampleOffset> standard_pattern(int count) {
  switch (count) {
    case 2:
      return kTwo;
    case 4:
      return kFour;
    case 8:
      return kEight;
    case 16:
      return kSixteen;
    default:
      return kOne;
  }
}

// Into [−128, 128).
int within_pixel(int offset) { return ((offset + 128) & 255) - 128; }

}  // namespace

std::vector<SampleOffset> sample_offsets(int count, SampleOffset jitter, bool is_turned) {
  const std::span<const SampleOffset> pattern = standard_pattern(count);
  std::vector<SampleOffset> offsets;
  for (const SampleOffset& at : pattern)
    offsets.push_back({within_pixel(at.x + jitter.x), within_pixel(at.y + jitter.y)});
  // Half a pixel to the left would be the next pixel's when turned: it stays in this one, 1/256 pixel short.
  for (SampleOffset& at : offsets) at.x = is_turned ? std::min(-at.x, 127) : at.x;
  return offsets;
}

}  // namespace laterna::shade
