// Layers of colour on every instruction set against the formulas in double.
#include "shade/blend_layers.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "reference/blending.h"

namespace laterna::shade {
namespace {

using shadow::kGroupSize;
using shadow::kMaxGroups;
using shadow::kMaxSamples;
using shadow::SampleArray;

using Colours = std::array<SampleArray<float>*, 3>;

bool same_bits(const Colours& a, const Colours& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](const auto* x, const auto* y) {
    return std::memcmp(x->data(), y->data(), sizeof(*x)) == 0;
  });
}

reference::Colour<double> at(const Colours& values, std::size_t i) {
  return {(*values[0])[i], (*values[1])[i], (*values[2])[i]};
}

// Colours about [0, 1], some beyond, some equal, some black.
void fill(const Colours& values, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    const float scale = i % 7 == 0 ? 5.0F : i % 11 == 0 ? 0.0F : 1.0F;
    for (SampleArray<float>* channel : values) (*channel)[i] = scale * unit(random);
  }
}

struct Layered {
  std::unique_ptr<LayerColor> color = std::make_unique<LayerColor>();
  std::unique_ptr<SurfacePoints> points = std::make_unique<SurfacePoints>();
  Colours shown = {&color->r, &color->g, &color->b};
  Colours base = {&points->base_r, &points->base_g, &points->base_b};

  Layered() {
    fill(base, 1);
    fill(shown, 2);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      color->alpha[i] = i % 5 == 0 ? 1.0F : unit(random);
      color->presence[i] = i % 3 == 0 ? 1.0F : unit(random);
    }
    for (std::size_t group = 0; group < kMaxGroups; ++group)
      color->covered[group] = static_cast<std::uint16_t>(random());
    color->covered[0] = 0xFFFF;
    color->covered[1] = 0;
    color->covered[2] = 0x8001;
  }
};

// Rows 69 and 70: every mode, with alpha, opacity, a colour and parts that are not there, where the layer is and nowhere
// else; the same bits on every instruction set, whose vectors hold 1, 4, 8 or 16 samples.
TEST(BlendLayers, EveryModeIsItsFormulaOnEveryInstructionSet) {
  for (const BlendModeDescription& mode : list_blend_modes()) {
    frame::LayerBinding layer;
    layer.blend = mode.mode;
    layer.color = {1, 0.5F, 0.75F};
    layer.opacity = 0.625F;
    Layered first;
    const Layered before;
    for (const InstructionSet set : supported_instruction_sets()) {
      Layered found;
      blend_layer_for(set)(layer, kMaxGroups, *found.color, *found.points);
      if (set == supported_instruction_sets().front())
        blend_layer_for(set)(layer, kMaxGroups, *first.color, *first.points);
      EXPECT_TRUE(same_bits(found.base, first.base)) << mode.name;
    }
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      const reference::Colour<double> below = at(before.base, i), result = at(first.base, i);
      if ((first.color->covered[i / kGroupSize] >> i % kGroupSize & 1U) == 0) {
        EXPECT_EQ(result, below) << mode.name << " beside the layer, sample " << i;
        continue;
      }
      const reference::Colour<double> t = at(first.shown, i);
      const auto expected = reference::lay<double>(mode.mode, below, {t[0], t[1] * 0.5, t[2] * 0.75},
                                                   first.color->alpha[i], 0.625 * first.color->presence[i]);
      for (std::size_t channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(result[channel], expected[channel], 1e-5) << mode.name << ", sample " << i;
    }
  }
}

TEST(BlendLayers, BeyondTheMostThatAColourMayBeNothingOverflows) {
  frame::LayerBinding layer;
  layer.color = {1e12F, 1e12F, 1e12F};
  layer.blend = BlendMode::modulate;
  for (const InstructionSet set : supported_instruction_sets()) {
    Layered stack;
    stack.color->covered.fill(0xFFFF);
    for (int i = 0; i < 8; ++i) blend_layer_for(set)(layer, kMaxGroups, *stack.color, *stack.points);
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      EXPECT_LE(stack.points->base_r[i], 1e12F);
      EXPECT_GE(stack.points->base_r[i], 0);
    }
  }
}

struct Lights {
  std::array<std::unique_ptr<Radiance>, 4> all = {std::make_unique<Radiance>(), std::make_unique<Radiance>(),
                                                  std::make_unique<Radiance>(), std::make_unique<Radiance>()};
  Radiance &open = *all[0], &own = *all[1], &earlier = *all[2], &change = *all[3];

  static Colours of(Radiance& r) { return {&r.r, &r.g, &r.b}; }

  // What is thrown is up to 1.5 times white.
  Lights() {
    fill(of(open), 4);
    fill(of(own), 5);
    fill(of(earlier), 6);
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      for (int channel = 0; channel < 3; ++channel) {
        const auto k = static_cast<std::size_t>(channel);
        (*of(own)[k])[i] *= 1.5F * (*of(open)[k])[i];
      }
    }
  }
};

// A light's mode is the formula of light in units of its own white.
TEST(BlendLayers, LightIsCombinedInUnitsOfTheProjectorsWhite) {
  for (const BlendModeDescription& mode : list_blend_modes()) {
    if (!find_light_fault(mode.mode).empty()) continue;
    Lights first;
    Lights before;
    for (const InstructionSet set : supported_instruction_sets()) {
      Lights found;
      Lights& kept = set == supported_instruction_sets().front() ? first : found;
      blend_light_for(set)(mode.mode, kMaxGroups, kept.open, kept.own, kept.earlier, kept.change);
      EXPECT_TRUE(same_bits(Lights::of(kept.change), Lights::of(first.change))) << mode.name;
      EXPECT_TRUE(same_bits(Lights::of(kept.earlier), Lights::of(first.earlier))) << mode.name;
    }
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      const auto white = at(Lights::of(first.open), i), own = at(Lights::of(first.own), i),
                 earlier = at(Lights::of(before.earlier), i), sum = at(Lights::of(first.earlier), i),
                 change = at(Lights::of(first.change), i);
      reference::Colour<double> c{}, t{};
      bool has_white = true;
      for (std::size_t k = 0; k < 3; ++k) {
        has_white = has_white && white[k] > 1e-3;
        c[k] = earlier[k] / white[k], t[k] = own[k] / white[k];
      }
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GE(sum[k], 0) << mode.name;
        EXPECT_EQ(static_cast<float>(sum[k]), static_cast<float>(earlier[k]) + static_cast<float>(change[k]));
        if (!has_white) continue;
        const auto expected = reference::blend<double>(mode.mode, c, t, 1);
        EXPECT_NEAR(sum[k], white[k] * expected[k], 2e-5) << mode.name << ", sample " << i;
      }
    }
  }
}

}  // namespace
}  // namespace laterna::shade
