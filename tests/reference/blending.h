// Layers of colour as docs/blend.md defines them: one channel triple at a time, in plain numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "laterna/blend.h"

namespace laterna::reference {

template <class Number>
using Colour = std::array<Number, 3>;

/// The mode's formula: `c` below, `t` and `a` the layer's.
template <class Number>
Colour<Number> blend(BlendMode mode, const Colour<Number>& c, const Colour<Number>& t, Number a) {
  Colour<Number> f{};
  Number dot = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Number one = 1;
    const Number below = c[i];
    const Number layer = t[i];
    dot += (below - one / 2) * (layer - one / 2);
    switch (mode) {
      case BlendMode::over:
        f[i] = layer;
        break;
      case BlendMode::modulate:
        f[i] = below * layer;
        break;
      case BlendMode::add:
        f[i] = below + layer;
        break;
      case BlendMode::alpha_attenuate:
        f[i] = below * a;
        break;
      case BlendMode::subtract:
        f[i] = below > layer ? below - layer : 0;
        break;
      case BlendMode::reverse_subtract:
        f[i] = layer > below ? layer - below : 0;
        break;
      case BlendMode::difference:
        f[i] = below > layer ? below - layer : layer - below;
        break;
      case BlendMode::screen:
        f[i] = below + layer - (below < 1 ? below : one) * (layer < 1 ? layer : one);
        break;
      case BlendMode::min:
        f[i] = below < layer ? below : layer;
        break;
      case BlendMode::max:
        f[i] = below > layer ? below : layer;
        break;
      case BlendMode::dot3:
        break;
    }
  }
  if (mode == BlendMode::dot3) f.fill(std::clamp<Number>(4 * dot, 0, 1));
  return f;
}

/// What comes of the layer with its opacity.
template <class Number>
Colour<Number> lay(BlendMode mode, const Colour<Number>& c, const Colour<Number>& t, Number a,
                   Number opacity) {
  const Number share = mode == BlendMode::alpha_attenuate ? opacity : opacity * a;
  const Colour<Number> f = blend(mode, c, t, a);
  Colour<Number> mixed{};
  for (std::size_t i = 0; i < 3; ++i) mixed[i] = c[i] * (1 - share) + f[i] * share;
  return mixed;
}

}  // namespace laterna::reference
