// The elementary functions of the kernels against the C library in double, and equation 6 against direct
// projection.
#include "kernels/vector_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>

#include "base/aligned_vector.h"
#include "shadow/depth_comparison.h"
#include "shadow/depth_map.h"

namespace laterna::kernels {
namespace {

constexpr std::size_t kCount = 65536;
using Floats = AlignedVector<float>;

Floats spread(float low, float high) {
  Floats values(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    values[i] = low + (high - low) * (static_cast<float>(i) / static_cast<float>(kCount - 1));
  }
  return values;
}

Floats powers_of_two(float low, float high) {
  Floats values = spread(low, high);
  for (float& value : values) value = std::exp2(value);
  return values;
}

Floats random_floats(float low, float high, unsigned seed) {
  std::mt19937 random(seed);
  Floats values(kCount);
  for (float& value : values) value = std::uniform_real_distribution<float>(low, high)(random);
  return values;
}

bool same_bits(const Floats& a, const Floats& b) {
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class VectorFunctions : public testing::TestWithParam<InstructionSet> {
 protected:
  static Floats apply(OneArgument function, const Floats& x) {
    Floats result(x.size());
    function(x, result);
    return result;
  }
};

TEST_P(VectorFunctions, CosineHasAnAbsoluteErrorBelow1e6PlusItsArgumentsRounding) {
  for (const float most : {4.0F, 1000.0F, 1e5F}) {
    const Floats x = spread(-most, most);
    const Floats y = apply(cosines_for(GetParam()), x);
    for (std::size_t i = 0; i < kCount; ++i)
      ASSERT_NEAR(y[i], std::cos(static_cast<double>(x[i])),
                  1e-6 + 2e-7 * std::abs(static_cast<double>(x[i])))
          << x[i];
    if (GetParam() != InstructionSet::scalar) {
      EXPECT_TRUE(same_bits(y, apply(cosines_for(InstructionSet::scalar), x)));
    }
  }
}

TEST_P(VectorFunctions, ExponentialHasARelativeErrorBelow2e7) {
  const Floats x = spread(-126, 127);
  const Floats y = apply(exponentials_for(GetParam()), x);
  for (std::size_t i = 0; i < kCount; ++i)
    ASSERT_NEAR(y[i] / std::exp2(static_cast<double>(x[i])), 1, 2e-7) << x[i];
  EXPECT_TRUE(same_bits(y, apply(exponentials_for(InstructionSet::scalar), x)));
}

TEST_P(VectorFunctions, ExponentialIsHeldAtTheEndsOfItsRange) {
  Floats x(16, 0.0F);
  x[0] = -1000, x[1] = 1000, x[2] = 0, x[3] = 1, x[4] = -126, x[5] = 127;
  const Floats y = apply(exponentials_for(GetParam()), x);
  const float expected[] = {0x1p-126F, 0x1p127F, 1, 2, 0x1p-126F, 0x1p127F};
  for (std::size_t i = 0; i < std::size(expected); ++i) EXPECT_EQ(y[i], expected[i]) << i;
}

TEST_P(VectorFunctions, LogarithmHasAnErrorBelow3e7) {
  for (const Floats& x : {powers_of_two(-126, 127.9F), spread(0.25F, 4), spread(0.999F, 1.001F)}) {
    const Floats y = apply(logarithms_for(GetParam()), x);
    for (std::size_t i = 0; i < kCount; ++i) {
      const double expected = std::log2(static_cast<double>(x[i]));
      // Beyond 8 a float's own spacing counts.
      ASSERT_NEAR(y[i], expected, 3e-7 * std::max(1.0, std::abs(expected))) << x[i];
    }
    EXPECT_TRUE(same_bits(y, apply(logarithms_for(InstructionSet::scalar), x)));
  }
}

TEST_P(VectorFunctions, LogarithmOfAPowerOfTwoIsExact) {
  Floats x(256);
  for (int i = 0; i < 256; ++i) x[static_cast<std::size_t>(i)] = std::ldexp(1.0F, std::min(i, 253) - 126);
  const Floats y = apply(logarithms_for(GetParam()), x);
  for (int i = 0; i < 254; ++i) EXPECT_EQ(y[static_cast<std::size_t>(i)], static_cast<float>(i - 126));
}

TEST_P(VectorFunctions, PowerIsTheLibrarysToTheErrorOfItsLogarithm) {
  const Floats base = random_floats(0, 2, 1), exponent = random_floats(0, 60, 2);
  Floats y(kCount), scalar(kCount);
  powers_for(GetParam())(base, exponent, y);
  powers_for(InstructionSet::scalar)(base, exponent, scalar);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double product = exponent[i] * std::log2(static_cast<double>(base[i]));
    if (product < -126 || product > 127) continue;
    const double expected = std::pow(static_cast<double>(base[i]), static_cast<double>(exponent[i]));
    // The logarithm's error and the product's rounding, through the exponential.
    const double relative = 3e-7 + 0.7 * (3e-7 * exponent[i] + 6e-8 * std::abs(product));
    ASSERT_NEAR(y[i] / expected, 1, relative) << base[i] << "^" << exponent[i];
  }
  EXPECT_TRUE(same_bits(y, scalar));
}

TEST_P(VectorFunctions, PowerOfZeroIsZeroAndOfOneIsOne) {
  Floats base(32), exponent(32), y(32);
  for (std::size_t i = 0; i < 32; ++i) {
    base[i] = i < 16 ? 0.0F : 1.0F;
    exponent[i] = static_cast<float>(i % 16) * 1000;
  }
  powers_for(GetParam())(base, exponent, y);
  for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(y[i], base[i]) << exponent[i];
}

TEST_P(VectorFunctions, SaturateHoldsToZeroAndOne) {
  Floats x(16);
  const float values[] = {-1, -0.0F, 0, 0.25F, 1, 1.5F, 3e38F, -3e38F};
  for (std::size_t i = 0; i < 16; ++i) x[i] = values[i % 8];
  const Floats y = apply(saturated_for(GetParam()), x);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(y[i], std::clamp(x[i], 0.0F, 1.0F)) << x[i];
}

TEST_P(VectorFunctions, NormalisedVectorsAreUnitVectorsAndZeroStaysZero) {
  Floats x = random_floats(-10, 10, 3), y = random_floats(-10, 10, 4), z = random_floats(-10, 10, 5);
  x[7] = y[7] = z[7] = 0;
  Floats ux(kCount), uy(kCount), uz(kCount);
  normalise_for(GetParam())({x, y, z, ux, uy, uz});
  for (std::size_t i = 0; i < kCount; ++i) {
    const glm::dvec3 v(x[i], y[i], z[i]);
    const glm::dvec3 expected = i == 7 ? glm::dvec3(0) : glm::normalize(v);
    ASSERT_LT(glm::length(glm::dvec3(ux[i], uy[i], uz[i]) - expected), 3e-7) << i;
  }
  Floats sx(kCount), sy(kCount), sz(kCount);
  normalise_for(InstructionSet::scalar)({x, y, z, sx, sy, sz});
  EXPECT_TRUE(same_bits(ux, sx) && same_bits(uy, sy) && same_bits(uz, sz));
}

// Row 29: what is stored, what is tested, what comes out. Reversed depths grow toward the light.
struct Comparison {
  float stored, tested, bias;
  bool is_lit;
  const char* why;
};
constexpr float kJustBelowOne = 0x1.fffffep-1F;
constexpr float kJustAboveOne = 0x1.000002p+0F;
constexpr Comparison kComparisons[] = {
    {1.0F, 1.0F, 0, true, "the surface that the light saw"},
    {1.0F, kJustAboveOne, 0, true, "nearer to the light than anything seen"},
    {1.0F, kJustBelowOne, 0, false, "behind what the light saw, by the least that can be"},
    {1.0F, 0.5F, 0, false, "twice as far away as what the light saw"},
    {1.0F, 2.0F, 0, true, "half as far away"},
    {1.0F, 0.75F, 0.25F, true, "behind by exactly the bias"},
    {1.0F, 0.75F, 0.24F, false, "behind by more than the bias"},
    {1.0F, 0.75F, 0.5F, true, "behind by less than the bias"},
    {1.0F, 1.0F, -0.25F, false, "a negative bias darkens"},
    {shadow::kNothingSeen, 0.0F, 0, true, "the light saw nothing, however far the receiver"},
    {shadow::kNothingSeen, 1e-30F, 0, true, "the light saw nothing"},
    {shadow::kNothingSeen, -1e30F, 0, true, "the light saw nothing, beyond an orthographic far plane"},
    {1e-30F, 0.0F, 0, false, "infinitely far behind what is very far"},
    {0.0F, 0.0F, 0, true, "both at the far plane"},
    {-0.0F, 0.0F, 0, true, "zeros are equal"},
    {3e38F, 1.0F, 0, false, "something at the light itself"},
};

TEST_P(VectorFunctions, DepthComparisonFollowsTheTable) {
  Floats stored(16), tested(16), bias(16), result(16);
  static_assert(std::size(kComparisons) == 16);
  for (std::size_t i = 0; i < 16; ++i) {
    stored[i] = kComparisons[i].stored, tested[i] = kComparisons[i].tested, bias[i] = kComparisons[i].bias;
  }
  compare_depths_for(GetParam())(stored, tested, bias, result);
  for (std::size_t i = 0; i < 16; ++i) {
    const Comparison& c = kComparisons[i];
    EXPECT_EQ(result[i], c.is_lit ? 1.0F : 0.0F) << c.why;
    EXPECT_EQ(shadow::is_lit(c.stored, c.tested, c.bias), c.is_lit) << c.why;
  }
}

TEST_P(VectorFunctions, DepthComparisonIsTheOneFunctionForAnyNumbers) {
  const Floats stored = random_floats(0, 1, 6), tested = random_floats(0, 1, 7),
               bias = random_floats(0, 0.1F, 8);
  Floats result(kCount);
  compare_depths_for(GetParam())(stored, tested, bias, result);
  for (std::size_t i = 0; i < kCount; ++i)
    ASSERT_EQ(result[i] == 1.0F, shadow::is_lit(stored[i], tested[i], bias[i]));
}

// ---------------------------------------------------------------------------------------------- equation 6

View random_view(std::mt19937& random, bool is_orthographic) {
  std::uniform_real_distribution<double> place(-3, 3), side(0.3, 1.5);
  View view;
  const glm::dvec3 eye(place(random), place(random), 8 + place(random));
  view.pose = Pose::look_at(eye, {place(random), place(random), place(random)}, {0, 1, 0.1}).value();
  const double scale = is_orthographic ? 5 : 1;
  view.projection = {is_orthographic,
                     -side(random) * scale,
                     side(random) * scale,
                     -side(random) * scale,
                     side(random) * scale,
                     0.5,
                     40};
  return view;
}

TEST_P(VectorFunctions, EquationSixGivesWhatDirectProjectionGives) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 40; ++trial) {
    const View camera = random_view(random, trial % 2 == 1), light = random_view(random, trial % 4 >= 2);
    const raster::RasterView view(camera, 640, 480);
    const raster::RasterView::Ray ray = view.homogeneous_ray();
    const glm::dmat4 rows = glm::transpose(light.image_from_world());
    const shadow::ProjectedRow s(rows[0], ray), t(rows[1], ray), w(rows[3], ray),
        h(shadow::homogeneous_row(ray));
    Floats x = random_floats(-320, 320, static_cast<unsigned>(random())),
           y = random_floats(-240, 240, static_cast<unsigned>(random()));
    Floats q(kCount), s_over(kCount), t_over(kCount), w_over(kCount), h_over(kCount);
    std::uniform_real_distribution<double> metres(0.5, 40);
    for (float& value : q) value = static_cast<float>(view.reversed_from_distance(metres(random)));
    evaluate_row_for(GetParam())({&s, x, y, q, s_over});
    evaluate_row_for(GetParam())({&t, x, y, q, t_over});
    evaluate_row_for(GetParam())({&w, x, y, q, w_over});
    evaluate_row_for(GetParam())({&h, x, y, q, h_over});
    for (std::size_t i = 0; i < kCount; i += 37) {
      const glm::dvec3 direction = view.direction_0 + view.direction_x * static_cast<double>(x[i]) +
                                   view.direction_y * static_cast<double>(y[i]);
      const double depth = q[i];
      const glm::dvec3 point_ws =
          view.is_orthographic ? direction + view.axis_ws * depth : view.eye_ws + direction / depth;
      const glm::dvec4 image = light.image_from_world() * glm::dvec4(point_ws, 1);
      if (image.w < 0.5) continue;
      ASSERT_NEAR(s_over[i] / w_over[i], image.x / image.w, 1e-5 * std::max(1.0, std::abs(image.x / image.w)))
          << trial;
      ASSERT_NEAR(t_over[i] / w_over[i], image.y / image.w, 1e-5 * std::max(1.0, std::abs(image.y / image.w)))
          << trial;
      ASSERT_NEAR(w_over[i] / h_over[i], image.w, 1e-5 * std::max(1.0, std::abs(image.w))) << trial;
    }
    Floats scalar(kCount);
    evaluate_row_for(InstructionSet::scalar)({&s, x, y, q, scalar});
    EXPECT_TRUE(same_bits(s_over, scalar));
  }
}

TEST_P(VectorFunctions, RecordsAreGatheredLaneByLane) {
  std::mt19937 random(3);
  constexpr std::int32_t kRecords = 5000;
  AlignedVector<glm::vec3> records(kRecords + 1);  // one to read beyond
  AlignedVector<glm::ivec3> counts(kRecords + 1);
  for (std::int32_t i = 0; i <= kRecords; ++i) {
    const auto k = static_cast<float>(i);
    records[static_cast<std::size_t>(i)] = {k, k + 0.25F, -k};
    counts[static_cast<std::size_t>(i)] = {i, -i, 2 * i + 1};
  }
  AlignedVector<std::int32_t> index(kCount);
  for (std::int32_t& i : index) i = static_cast<std::int32_t>(random() % kRecords);
  index[17] = 0, index[18] = kRecords - 1;
  Floats x(kCount), y(kCount), z(kCount), last_count(kCount);
  gather_probes_for(GetParam())({records, counts, index, x, y, z, last_count});
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto k = static_cast<float>(index[i]);
    ASSERT_EQ(x[i], k) << i;
    ASSERT_EQ(y[i], k + 0.25F) << i;
    ASSERT_EQ(z[i], -k) << i;
    ASSERT_EQ(last_count[i], 2 * k + 1) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, VectorFunctions, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::kernels
