// Radiosity, the fifth family of shadow algorithms (SPEC.md rows 92 and 106), against closed forms and against photons.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "reference/luxel_rooms.h"

namespace laterna {
namespace {

using bake::Interreflection;
using reference::LitRoom;
using reference::LuxelRoom;

RadiositySettings one_bounce(int rays) { return {rays, 1, 0}; }

// Row 106. Every surface gives off 1 and reflects half: B = 1 + B / 2.
TEST(Radiosity, furnace_glows_twice_as_bright) {
  LuxelRoom room;
  room.add_box({-1, 0, -2}, {1, 1.5F, 3}, 6, true, glm::vec3(0.5F), glm::vec3(1));
  room.add_box({-0.5F, 0.2F, -0.5F}, {0.3F, 0.9F, 0.25F}, 3, false, glm::vec3(0.5F), glm::vec3(1));
  const Interreflection solved = LitRoom(room).solve({64, 100, 1e-3F}).value();
  for (const glm::vec3& irradiance : solved.irradiance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(1 + 0.5F * irradiance[c], 2, 0.01);
  }
  EXPECT_GT(solved.bounces, 5);
  EXPECT_LT(solved.bounces, 20);
}

// Row 106. The same where lights bring what is given off: 2 fall on a surface that reflects half.
TEST(Radiosity, furnace_of_direct_light) {
  LuxelRoom room;
  room.add_box({-1, -1, -1}, {1, 1, 1}, 5, true, glm::vec3(0.5F));
  for (glm::vec3& direct : room.direct_irradiance) direct = glm::vec3(2);
  const Interreflection solved = LitRoom(room).solve({64, 100, 1e-3F}).value();
  for (const glm::vec3& irradiance : solved.irradiance) EXPECT_NEAR(0.5F * (2 + irradiance.x), 2, 0.01);
}

// Row 106. Form factors from a point in a closed room sum to 1, whatever stands in it, and light that is reflected n times
// is ρ^n of that.
TEST(Radiosity, closed_rooms_lose_nothing) {
  LuxelRoom room;
  room.add_box({0, 0, 0}, {4, 3, 2}, 5, true, glm::vec3(0.25F), glm::vec3(1));
  room.add_box({1, 0.01F, 0.5F}, {2, 1, 1.5F}, 3, false, glm::vec3(0.25F), glm::vec3(1));
  const LitRoom lit(room);
  const Interreflection once = lit.solve(one_bounce(32)).value();
  for (const glm::vec3& irradiance : once.irradiance) EXPECT_NEAR(irradiance.x, 1, 1e-5);
  const Interreflection thrice = lit.solve({32, 3, 0}).value();
  for (const glm::vec3& irradiance : thrice.irradiance) EXPECT_NEAR(irradiance.x, 1 + 0.25 + 0.0625, 1e-5);
  const Interreflection none = lit.solve({32, 0, 0}).value();
  for (const glm::vec3& irradiance : none.irradiance) EXPECT_EQ(irradiance, glm::vec3(0));
}

// The form factor between two unit squares of `luxels` each way, from what one brings to the other. Among much that is dark
// the shining one is summed luxel by luxel; alone it is left to rays.
double form_factor(const LuxelRoom::Rectangle& receiver, LuxelRoom::Rectangle emitter, bool among_darkness) {
  emitter.exitance = glm::vec3(1);
  LuxelRoom room;
  const auto count = static_cast<std::size_t>(receiver.columns * receiver.rows);
  room.add(receiver);
  room.add(emitter);
  if (among_darkness) room.add({{-20, -30, 20}, {40, 0, 0}, {0, 0, -40}, 4, 4});
  return LitRoom::mean(LitRoom(room).solve(one_bounce(256)).value(), 0, count);
}

// Row 106. Textbook form factors (Howell, A catalog of radiation heat transfer configuration factors, C-11 and C-14).
TEST(Radiosity, form_factors_of_unit_squares) {
  constexpr int n = 12;
  const LuxelRoom::Rectangle below = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, n, n};
  const LuxelRoom::Rectangle above = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, n, n};
  const LuxelRoom::Rectangle beside = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n, n};
  const LuxelRoom::Rectangle near_above = {{0, 0.1F, 0}, {1, 0, 0}, {0, 0, 1}, n, n};
  for (const bool among_darkness : {false, true}) {
    EXPECT_NEAR(form_factor(below, above, among_darkness), 0.199825, 0.002);
    EXPECT_NEAR(form_factor(below, beside, among_darkness), 0.200044, 0.002);
    EXPECT_NEAR(form_factor(below, near_above, among_darkness), 0.826699, 0.008);
  }
}

// Row 106. A luxel far below a small bright square: E = M A / (π d²), and nothing where something stands between.
TEST(Radiosity, small_bright_squares_are_found_and_cast_shadows) {
  const auto under_lamp = [](bool is_blocked) {
    LuxelRoom room;
    room.add({{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, 25, 25});
    room.add({{-0.05F, 4, -0.05F}, {0.1F, 0, 0}, {0, 0, 0.1F}, 2, 2, glm::vec3(0), glm::vec3(1000)});
    if (is_blocked) room.add({{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 2, 2});
    return LitRoom(room).solve(one_bounce(16)).value().irradiance;
  };
  const std::vector<glm::vec3> open = under_lamp(false);
  const std::vector<glm::vec3> blocked = under_lamp(true);
  for (int row = 0; row < 25; ++row) {
    for (int column = 0; column < 25; ++column) {
      const double x = (column + 0.5) * 0.4 - 5;
      const double z = 5 - (row + 0.5) * 0.4;
      const double squared = x * x + z * z + 16;
      const auto i = static_cast<std::size_t>(row * 25 + column);
      const double expected = 1000 * 0.01 * 16 / (std::numbers::pi * squared * squared);
      EXPECT_NEAR(open[i].x, expected, 0.01 * expected) << x << ' ' << z;
      // The square halfway up throws a shadow of twice its size, and half a lamp more or less.
      const double far_out = std::max(std::abs(x), std::abs(z));
      if (far_out < 1.9) {
        EXPECT_EQ(blocked[i].x, 0) << x << ' ' << z;
      }
      if (far_out > 2.1) {
        EXPECT_NEAR(blocked[i].x, open[i].x, 1e-4F * open[i].x) << x << ' ' << z;
      }
    }
  }
}

// Row 106. Between a sphere and a larger one around it F₁₂ = 1, F₂₁ = A₁ / A₂: two linear equations. The former hold of
// any convex solids within each other.
TEST(Radiosity, concentric_spheres) {
  Scene scene;
  reference::add_object(scene, "inner", reference::sphere({0, 0, 0}, 1, 48));
  reference::add_object(scene, "outer", reference::sphere({0, 0, 0}, 2, 48));
  const reference::OwnedFrame owned = reference::make_frame(std::move(scene));
  const trace::RayScene rays(owned.frame);
  std::vector<bake::Luxel> luxels;
  std::vector<glm::vec3> direct;
  std::array<double, 2> area{};
  for (std::uint32_t c = 0; c < owned.frame.clusters.size(); ++c) {
    for (std::uint32_t t = 0; t < owned.frame.clusters[c].triangle_count; ++t) {
      const TriangleId id = c << kTriangleBits | t;
      const glm::vec3 a = owned.frame.corner_ws(id, 0);
      const glm::vec3 b = owned.frame.corner_ws(id, 1);
      const glm::vec3 d = owned.frame.corner_ws(id, 2);
      const glm::vec3 middle = (a + b + d) / 3.0F;
      const glm::vec3 cross = glm::cross(b - a, d - a);
      const bool is_outer = glm::length(middle) > 1.5F;
      const glm::vec3 outward = glm::normalize(cross) * (glm::dot(cross, middle) > 0 ? 1.0F : -1.0F);
      luxels.push_back({middle, is_outer ? -outward : outward, 0.5F * glm::length(cross), id,
                        glm::vec3(is_outer ? 0.7F : 0.4F)});
      direct.emplace_back(is_outer ? 0.0F : 10.0F);
      area[is_outer ? 1 : 0] += static_cast<double>(luxels.back().area);
    }
  }
  const Interreflection solved =
      bake::interreflect(owned.frame, rays, luxels, {direct}, {32, 200, 1e-4F}, TaskPool(2)).value();
  // E₁ = B₂, E₂ = F₂₁ B₁ + (1 − F₂₁) B₂, B₁ = 0.4 (10 + E₁), B₂ = 0.7 E₂.
  const double f21 = area[0] / area[1];
  const double b2 = 0.7 * f21 * 4 / (1 - 0.7 * (f21 * 0.4 + 1 - f21));
  std::array<double, 2> mean{};
  for (std::size_t i = 0; i < luxels.size(); ++i) {
    const std::size_t which = direct[i].x > 0 ? 0 : 1;
    mean[which] += static_cast<double>(solved.irradiance[i].x * luxels[i].area) / area[which];
  }
  EXPECT_NEAR(mean[0], b2, 0.01 * b2);
  EXPECT_NEAR(mean[1], b2 / 0.7, 0.01 * b2 / 0.7);
}

// A room as the Cornell box: red and green walls, a lamp in the ceiling, a block on the floor.
struct CornellRoom {
  static constexpr double kLamp = 1.0 / 6;  // half the lamp's side, a sixth of the room's
  static constexpr glm::vec3 kRed{0.63F, 0.07F, 0.05F}, kGreen{0.14F, 0.45F, 0.09F}, kWhite{0.73F};
  static constexpr glm::dvec3 kBlockLow{1.0 / 6, -1, -4.0 / 6}, kBlockHigh{4.0 / 6, 1.0 / 6, -1.0 / 6};
  static constexpr float kExitance = 20;

  static glm::vec3 reflectance(int axis, bool is_high) {
    if (axis != 0) return kWhite;
    return is_high ? kGreen : kRed;
  }

  // So many luxels along a wall, a multiple of 12.
  static LuxelRoom luxels(int side) {
    LuxelRoom room;
    const auto per_wall = static_cast<std::size_t>(side * side);
    room.add_box({-1, -1, -1}, {1, 1, 1}, side, true, kWhite);
    for (std::size_t i = 0; i < per_wall; ++i) {
      room.luxels[i].reflectance = kRed;
      room.luxels[per_wall + i].reflectance = kGreen;
    }
    for (std::size_t i = 3 * per_wall; i < 4 * per_wall; ++i) {
      const glm::vec3& p = room.luxels[i].position_ws;
      if (std::abs(p.x) < kLamp && std::abs(p.z) < kLamp) room.exitance[i] = glm::vec3(kExitance);
    }
    room.add_box(glm::vec3(kBlockLow), glm::vec3(kBlockHigh), side / 3, false, kWhite);
    return room;
  }
};

// Photons in double: they leave the lamp, are reflected with what a surface reflects of them, and are counted where they land.
class Photons {
 public:
  static constexpr int kBins = 2;  // along a wall
  // By axis, low or high wall, and bin.
  using Walls = std::array<std::array<std::array<glm::dvec3, kBins * kBins>, 2>, 3>;

  static Walls trace(int count) {
    Photons photons;
    const double lamp = 2 * CornellRoom::kLamp;
    const double power = static_cast<double>(CornellRoom::kExitance) * lamp * lamp / count;
    for (int i = 0; i < count; ++i) photons.follow(glm::dvec3(power));
    const double bin = 4.0 / (kBins * kBins);
    for (auto& axis : photons.walls_)
      for (auto& wall : axis)
        for (glm::dvec3& flux : wall) flux /= bin;
    return photons.walls_;
  }

  static std::size_t bin_of(const glm::dvec3& p, int axis) {
    const auto cell = [](double x) { return std::min(kBins - 1, static_cast<int>((x + 1) / 2 * kBins)); };
    return static_cast<std::size_t>(cell(p[(axis + 1) % 3]) * kBins + cell(p[(axis + 2) % 3]));
  }

 private:
  struct Landing {
    glm::dvec3 point;
    int axis;
    bool is_high, is_on_block;
  };

  double random() { return std::uniform_real_distribution<double>(0, 1)(engine_); }

  glm::dvec3 reflected(int axis, double sign) {
    const double radius = std::sqrt(random());
    const double angle = 2 * std::numbers::pi * random();
    glm::dvec3 d;
    d[(axis + 1) % 3] = radius * std::cos(angle);
    d[(axis + 2) % 3] = radius * std::sin(angle);
    d[axis] = sign * std::sqrt(1 - radius * radius);
    return d;
  }

  static Landing land(const glm::dvec3& from, const glm::dvec3& d) {
    double near = 0;
    double far = 1e9;
    int near_axis = -1;
    int wall_axis = 0;
    double wall = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      const double to_wall = ((d[axis] > 0 ? 1.0 : -1.0) - from[axis]) / d[axis];
      if (to_wall < wall) {
        wall = to_wall;
        wall_axis = axis;
      }
      double in = (CornellRoom::kBlockLow[axis] - from[axis]) / d[axis];
      double out = (CornellRoom::kBlockHigh[axis] - from[axis]) / d[axis];
      if (in > out) std::swap(in, out);
      if (in > near) {
        near = in;
        near_axis = axis;
      }
      far = std::min(far, out);
    }
    if (near_axis >= 0 && near < far && near > 1e-9 && near < wall)
      return {from + d * near, near_axis, d[near_axis] < 0, true};
    return {from + d * wall, wall_axis, d[wall_axis] > 0, false};
  }

  void follow(glm::dvec3 power) {
    const double lamp = CornellRoom::kLamp;
    glm::dvec3 point((2 * random() - 1) * lamp, 1, (2 * random() - 1) * lamp);
    glm::dvec3 direction = reflected(1, -1);
    while (power.x + power.y + power.z > 1e-9) {
      const Landing landing = land(point, direction);
      glm::dvec3 reflectance(CornellRoom::kWhite);
      double sign = landing.is_high ? 1 : -1;  // of a block's face
      if (!landing.is_on_block) {
        walls_[static_cast<std::size_t>(landing.axis)][landing.is_high ? 1 : 0]
              [bin_of(landing.point, landing.axis)] += power;
        reflectance = CornellRoom::reflectance(landing.axis, landing.is_high);
        sign = -sign;
      }
      power *= reflectance;
      // Russian roulette by the strongest channel.
      const double keep = std::max(reflectance.x, std::max(reflectance.y, reflectance.z));
      if (random() >= keep) return;
      power /= keep;
      point = landing.point;
      direction = reflected(landing.axis, sign);
    }
  }

  std::mt19937_64 engine_{20};
  Walls walls_{};
};

// The same bins of what the solver found.
Photons::Walls walls_of(const LuxelRoom& room, int side, const std::vector<glm::vec3>& irradiance) {
  Photons::Walls walls{};
  const auto per_wall = static_cast<std::size_t>(side * side);
  const double luxels = static_cast<double>(per_wall) / (Photons::kBins * Photons::kBins);
  for (std::size_t i = 0; i < 6 * per_wall; ++i) {
    const std::size_t wall = i / per_wall;
    const auto bin = Photons::bin_of(glm::dvec3(room.luxels[i].position_ws), static_cast<int>(wall / 2));
    walls[wall / 2][wall % 2][bin] += glm::dvec3(irradiance[i]) / luxels;
  }
  return walls;
}

// Row 106. Against an independent reference: within 3 % everywhere. By bounces between luxels, and, where there are more of them
// than patches, with a last bounce that luxels share.
TEST(Radiosity, cornell_room_agrees_with_photons) {
  const Photons::Walls expected = Photons::trace(1000000);
  for (const int luxels : {24, 48}) {
    const LitRoom lit(CornellRoom::luxels(luxels));
    const Interreflection solved = lit.solve({64, 100, 1e-3F}).value();
    EXPECT_EQ(solved.patch_count < lit.room.luxels.size(), luxels == 48);
    const Photons::Walls found = walls_of(lit.room, luxels, solved.irradiance);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t bin = 0; bin < Photons::kBins * Photons::kBins; ++bin) {
          for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[axis][side][bin][c], expected[axis][side][bin][c],
                        0.03 * expected[axis][side][bin][c])
                << "axis " << axis << " side " << side << " bin " << bin << " channel " << c;
          }
        }
      }
    }
  }
}

// Form factors from a point to a rectangle of a × b one of whose corners is at unit distance c: in a plane parallel to the point's, above
// it; and in one at right angles, beside it on the floor (Howell, A catalog of radiation heat transfer configuration factors, B-3
// and B-4).
double from_below(double a, double b, double c) {
  const double x = a / c, y = b / c;
  const double u = std::sqrt(1 + x * x), v = std::sqrt(1 + y * y);
  return (x / u * std::atan(y / u) + y / v * std::atan(x / v)) / (2 * std::numbers::pi);
}
double from_beside(double width, double height, double c) {
  const double far = std::sqrt(height * height + c * c);
  return (std::atan(width / c) - c / far * std::atan(width / far)) / (2 * std::numbers::pi);
}

// Luxel by luxel of a black floor of 1 m × 1 m, more than there are patches, what a ceiling 1 m above or a wall beside it gives.
// As the mean of squares, and at worst.
void expect_floor_as_calculated(const LuxelRoom::Rectangle& shining, bool among_darkness,
                                double (*expected)(double x, double z), double mean_error,
                                double worst_error) {
  constexpr int n = 120;
  LuxelRoom room;
  room.add({{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, n, n});
  room.add(shining);
  if (among_darkness) room.add({{-20, -30, 20}, {40, 0, 0}, {0, 0, -40}, 4, 4});
  const LitRoom lit(room);
  const Interreflection solved = lit.solve(one_bounce(256)).value();
  ASSERT_LT(solved.patch_count, lit.room.luxels.size());
  double squares = 0, worst = 0;
  for (std::size_t i = 0; i < n * n; ++i) {
    const glm::dvec3 p(lit.room.luxels[i].position_ws);
    const double error = static_cast<double>(solved.irradiance[i].x) / expected(p.x, p.z) - 1;
    squares += error * error / (n * n);
    worst = std::max(worst, std::abs(error));
  }
  EXPECT_LT(std::sqrt(squares), mean_error);
  EXPECT_LT(worst, worst_error);
}

// Row 106. What luxels share is as right as what each finds for itself.
TEST(Radiosity, every_luxel_of_many_has_its_form_factor) {
  const glm::vec3 one(1);
  const LuxelRoom::Rectangle ceiling = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 20, 20, {}, one};
  const LuxelRoom::Rectangle wall = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 40, 40, {}, one};
  const auto of_ceiling = [](double x, double z) {
    return from_below(x, z, 1) + from_below(1 - x, z, 1) + from_below(x, 1 - z, 1) +
           from_below(1 - x, 1 - z, 1);
  };
  const auto of_wall = [](double x, double z) { return from_beside(x, 1, z) + from_beside(1 - x, 1, z); };
  for (const bool among_darkness : {false, true}) {
    expect_floor_as_calculated(ceiling, among_darkness, of_ceiling, 0.02, 0.1);
    expect_floor_as_calculated(wall, among_darkness, of_wall, 0.02, 0.2);
  }
}

// From a point of the floor to a rectangle at a height above it.
double to_rectangle(const glm::dvec2& low, const glm::dvec2& high, double height, double x, double z) {
  const auto corner = [&](double a, double b) { return from_below(a - x, b - z, height); };
  return corner(high.x, high.y) - corner(low.x, high.y) - corner(high.x, low.y) + corner(low.x, low.y);
}

// Of the first n × n luxels, which are a floor, the mean of what they were found to get over that of what they get.
double mean_share_found(const LuxelRoom& room, int n, int rays,
                        const std::function<double(double x, double z)>& expected) {
  const LitRoom lit(room);
  const Interreflection solved = lit.solve(one_bounce(rays)).value();
  EXPECT_LT(solved.patch_count, lit.room.luxels.size());
  double found = 0, all = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n) * static_cast<std::size_t>(n); ++i) {
    const glm::dvec3 p(lit.room.luxels[i].position_ws);
    found += static_cast<double>(solved.irradiance[i].x);
    all += expected(p.x, p.z);
  }
  return found / all;
}

// Thin strips close above a black floor in the open, no brighter than a great plane that nothing sees. Luxels whose few rays meet
// one by chance must not be told from the others: those would share what they have missed.
TEST(Radiosity, little_that_shines_near_by_is_not_lost) {
  constexpr int n = 120;
  for (const double height : {0.05, 0.02}) {
    LuxelRoom room;
    room.add({{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, n, n});
    for (int i = 0; i < 5; ++i)
      room.add({{0.1F + 0.2F * static_cast<float>(i), static_cast<float>(height), 0},
                {0.01F, 0, 0},
                {0, 0, 1},
                1,
                100,
                {},
                glm::vec3(1)});
    room.add({{-50, -30, -50}, {100, 0, 0}, {0, 0, 100}, 20, 20, {}, glm::vec3(1)});
    const double share = mean_share_found(room, n, 256, [&](double x, double z) {
      double sum = 0;
      for (int i = 0; i < 5; ++i) sum += to_rectangle({0.1 + 0.2 * i, 0}, {0.11 + 0.2 * i, 1}, height, x, z);
      return sum;
    });
    EXPECT_NEAR(share, 1, 0.01) << height;
  }
}

// A black room with a hole in its ceiling, and a shining plane above it: most luxels' rays meet darkness.
TEST(Radiosity, light_that_few_rays_find_is_not_lost) {
  constexpr int n = 80;
  const auto share_through = [&](float side, int rays) {
    const float low = 2 - side / 2, high = 2 + side / 2;
    LuxelRoom room;
    room.add({{0, 0, 4}, {4, 0, 0}, {0, 0, -4}, n, n});
    const auto add_ceiling = [&](float x0, float z0, float x1, float z1) {
      room.add({{x0, 4, z0}, {x1 - x0, 0, 0}, {0, 0, z1 - z0}, 8, 8});
    };
    add_ceiling(0, 0, 4, low);
    add_ceiling(0, high, 4, 4);
    add_ceiling(0, low, low, high);
    add_ceiling(high, low, 4, high);
    room.add({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 10, 10});
    room.add({{4, 0, 4}, {-4, 0, 0}, {0, 4, 0}, 10, 10});
    room.add({{0, 0, 4}, {0, 0, -4}, {0, 4, 0}, 10, 10});
    room.add({{4, 0, 0}, {0, 0, 4}, {0, 4, 0}, 10, 10});
    room.add({{-8, 6, -8}, {20, 0, 0}, {0, 0, 20}, 60, 60, {}, glm::vec3(1)});
    return mean_share_found(room, n, rays, [&](double x, double z) {
      return to_rectangle({low, low}, {high, high}, 4, x, z);
    });
  };
  EXPECT_NEAR(share_through(0.25F, 256), 1, 0.05);
  EXPECT_NEAR(share_through(0.1F, 1024), 1, 0.1);
}

// Row 106. What the lamp gives off is what surfaces take up; the red wall reddens the floor before it, the green one greens it.
TEST(Radiosity, cornell_room_keeps_its_energy_and_bleeds_colour) {
  const LitRoom lit(CornellRoom::luxels(24));
  const Interreflection solved = lit.solve({64, 100, 1e-3F}).value();
  glm::dvec3 given(0);
  glm::dvec3 taken(0);
  for (std::size_t i = 0; i < lit.room.luxels.size(); ++i) {
    const bake::Luxel& luxel = lit.room.luxels[i];
    given += glm::dvec3(lit.room.exitance[i]) * static_cast<double>(luxel.area);
    taken += glm::dvec3((glm::vec3(1) - luxel.reflectance) * solved.irradiance[i] * luxel.area);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(taken[c], given[c], 0.01 * given[c]);

  const Photons::Walls walls = walls_of(lit.room, 24, solved.irradiance);
  const auto floor_at = [&](double x) { return walls[1][0][Photons::bin_of({x, -1, 0.5}, 1)]; };
  const glm::dvec3 at_red = floor_at(-0.5);
  const glm::dvec3 at_green = floor_at(0.5);
  EXPECT_GT(at_red.x / at_red.y, 1.02 * at_green.x / at_green.y);
  EXPECT_GT(at_green.y / at_green.z, 1.02 * at_red.y / at_red.z);
}

// Row 106. Light is the same whether it is called what surfaces give off, or what has fallen on them.
TEST(Radiosity, bounces_add_up) {
  LitRoom lit(CornellRoom::luxels(24));
  const std::vector<glm::vec3> all = lit.solve({128, 6, 0}).value().irradiance;
  const std::vector<glm::vec3> first = lit.solve({128, 1, 0}).value().irradiance;
  lit.room.direct_irradiance = first;
  lit.room.exitance.clear();
  const std::vector<glm::vec3> rest = lit.solve({128, 5, 0}).value().irradiance;
  double difference = 0;
  double total = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    difference += static_cast<double>(std::abs(first[i].x + rest[i].x - all[i].x));
    total += static_cast<double>(all[i].x);
  }
  EXPECT_LT(difference, 0.01 * total);
}

}  // namespace
}  // namespace laterna
