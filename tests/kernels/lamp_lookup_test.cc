// Intensity of measured lamps on every instruction set against bilinear interpolation in double.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/lamp_lights.h"
#include "unit/lamp_texts.h"

namespace laterna {
namespace {

using namespace testing_lamps;

// Values that change as fast as they can on their grid.
double jagged(double v, double h) {
  const double x = std::sin(v * 12.9898 + h * 78.233) * 43758.5453;
  return 1000 * (x - std::floor(x));
}

struct Grid {
  const char* name;
  IesText ies;
};

std::vector<Grid> grids() {
  std::vector<Grid> all;
  const auto add = [&](const char* name, int type, std::vector<double> vertical,
                       std::vector<double> horizontal) {
    IesText ies;
    ies.type = type;
    ies.vertical = std::move(vertical), ies.horizontal = std::move(horizontal);
    ies.candela = jagged;
    all.push_back({name, std::move(ies)});
  };
  add("even", 1, angles(0, 180, 37), angles(0, 360, 25));
  add("downward", 1, angles(0, 90, 19), angles(0, 90, 5));
  add("upward", 1, angles(90, 180, 10), angles(0, 180, 3));
  add("all round", 1, angles(0, 90, 181), {0});
  add("without 360", 1, angles(0, 180, 7), angles(0, 345, 24));
  add("from C5", 1, angles(0, 180, 7), angles(5, 355, 36));
  add("uneven", 1, {0, 0.5, 3, 3.5, 60, 61, 89.5, 90, 180}, {0, 1, 90, 91.5, 200, 260, 350, 360});
  add("type B", 2, angles(-90, 90, 37), angles(-90, 90, 19));
  add("type A, mirrored", 3, angles(-30, 40, 15), angles(0, 60, 13));
  // More angles within one bin than there are bins for: cells are walked along.
  std::vector<double> crowded = angles(0, 0.3, 31);
  crowded.push_back(90);
  add("crowded", 1, crowded, {0, 10, 90});
  all.back().ies.candela = [](double v, double h) { return 900 - 5 * v - h; };
  return all;
}

TEST(LampLookup, IsTheFilesOwnInterpolationOnEveryInstructionSet) {
  std::vector<glm::dvec3> directions = reference::spread_directions(4000);
  for (const double tiny : {0.0, 1e-7, 1e-3}) {  // around the poles and the axes
    for (const double sign : {-1.0, 1.0}) {
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 direction(tiny, -tiny, tiny);
        direction[axis] = sign;
        directions.push_back(direction);
      }
    }
  }
  for (const Grid& grid : grids()) {
    const LightDistribution lamp = parse_or_fail(grid.ies.text());
    const std::vector<float> scalar = reference::shaded_candela(lamp, directions, InstructionSet::scalar);
    for (const InstructionSet set : supported_instruction_sets())
      EXPECT_EQ(reference::shaded_candela(lamp, directions, set), scalar) << grid.name << " " << name_of(set);
    int lit = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      // Along the seams of the grid single precision may fall to either side; a step beside it tells.
      const glm::dvec3 d = glm::dvec3(glm::vec3(directions[i]));
      double low = 1e30, high = -1e30;
      for (const double step : {0.0, -2e-6, 2e-6}) {
        for (int axis = 0; axis < 3; ++axis) {
          glm::dvec3 beside = d;
          beside[axis] += step;
          const double candela = candela_toward(lamp, beside);
          low = std::min(low, candela), high = std::max(high, candela);
        }
      }
      // Half a thousandth of the peak, a tenth of what is promised.
      ASSERT_GE(scalar[i], low - 0.5) << grid.name << " " << d.x << " " << d.y << " " << d.z;
      ASSERT_LE(scalar[i], high + 0.5) << grid.name << " " << d.x << " " << d.y << " " << d.z;
      lit += high > 0 ? 1 : 0;
    }
    EXPECT_GT(lit, 400) << grid.name;
  }
}

}  // namespace
}  // namespace laterna
