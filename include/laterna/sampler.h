// How a picture is filtered and continued beyond its sides.
#pragma once

#include <cstdint>

namespace laterna {

enum class Wrap : std::uint8_t { repeat, mirror, clamp };
enum class Filter : std::uint8_t { nearest, linear };
enum class MipFilter : std::uint8_t { none, nearest, linear };

struct Sampler {
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  Filter magnify = Filter::linear, minify = Filter::linear;
  MipFilter mip = MipFilter::linear;
  bool operator==(const Sampler&) const = default;
};

}  // namespace laterna
