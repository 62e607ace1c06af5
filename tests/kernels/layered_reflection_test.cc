// Lobes of materials on every instruction set against the reference in double; energy and reciprocity.
#include "shade/layered_reflection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>

#include "kernels/store_vector.h"
#include "kernels/vector_functions.h"
#include "reference/layered_material.h"

namespace laterna::shade {
namespace {

using shadow::kMaxGroups;
using shadow::kMaxSamples;

const SheenAlbedo& sheen_table() {
  static const SheenAlbedo table = make_sheen_albedo(TaskPool(1));
  return table;
}

// The table between its entries.
double table_albedo(double cosine, double roughness) {
  constexpr int kSide = SheenAlbedo::kSide;
  const double x = std::clamp(cosine, 0.0, 1.0) * (kSide - 1), y = roughness * (kSide - 1);
  const int column = std::min(static_cast<int>(x), kSide - 2), row = std::min(static_cast<int>(y), kSide - 2);
  const auto at = [&](int r, int c) {
    return static_cast<double>(sheen_table().share[static_cast<std::size_t>(r * kSide + c)]);
  };
  const auto across = [&](int r) {
    return at(r, column) + (at(r, column + 1) - at(r, column)) * (x - column);
  };
  return across(row) + (across(row + 1) - across(row)) * (y - row);
}

// A batch of one surface: what the kernel reads, and the same for the reference.
class Batch {
 public:
  explicit Batch(const reference::LayeredPoint& point) : point_(point) {
    surface_.values = point.lobes;
    surface_.has_clearcoat = point.lobes.clearcoat.factor > 0;
    surface_.has_sheen = point.lobes.sheen.color != glm::vec3(0);
    surface_.has_anisotropy = point.lobes.anisotropy.strength > 0;
    surface_.has_iridescence = point.lobes.iridescence.factor > 0;
    surface_.has_transmission = point.lobes.transmission.factor > 0;
    const double roughness = point.lobes.sheen.roughness;
    point_.sheen_albedo = [roughness](double cosine) { return table_albedo(cosine, roughness); };
    arrival_->alpha.fill(1);
    irradiance_->r.fill(1), irradiance_->g.fill(1), irradiance_->b.fill(1);
    irradiance_->lit.fill(0xFFFF);
    for (std::size_t i = 0; i < kMaxSamples; ++i) put(i);
  }

  void set_directions(std::size_t i, const glm::dvec3& to_light, const glm::dvec3& to_eye) {
    store(to_light, irradiance_->to_light_x_ws, irradiance_->to_light_y_ws, irradiance_->to_light_z_ws, i);
    store(to_eye, points_->to_eye_x_ws, points_->to_eye_y_ws, points_->to_eye_z_ws, i);
    irradiance_->cosine[i] = static_cast<float>(glm::dot(point_.surface.normal, to_light));
  }

  [[nodiscard]] const Radiance& reflect(InstructionSet set) {
    const LayeredSurface surface = {&surface_, points_.get(), lobes_.get(), &sheen_table()};
    reflect_layered_for(set)(surface, kMaxGroups, *irradiance_, *arrival_, 0, false, *radiance_);
    return *radiance_;
  }

  // From the very numbers that the kernel reads.
  [[nodiscard]] glm::dvec3 expected(std::size_t i) const {
    reference::LayeredPoint p = point_;
    p.surface.to_eye = {points_->to_eye_x_ws[i], points_->to_eye_y_ws[i], points_->to_eye_z_ws[i]};
    return reference::reflect_layered(
        p, {irradiance_->to_light_x_ws[i], irradiance_->to_light_y_ws[i], irradiance_->to_light_z_ws[i]});
  }

 private:
  void put(std::size_t i) {
    const reference::SurfacePoint& s = point_.surface;
    const MaterialLobes& lobes = point_.lobes;
    store(s.normal, points_->normal_x_ws, points_->normal_y_ws, points_->normal_z_ws, i);
    store(s.base, points_->base_r, points_->base_g, points_->base_b, i);
    points_->metallic[i] = static_cast<float>(s.metallic);
    points_->roughness[i] = static_cast<float>(s.roughness);
    const double ratio = (lobes.ior - 1.0) / (lobes.ior + 1.0);
    const double f0 = lobes.ior == 0 ? 1 : ratio * ratio;
    store(glm::min(f0 * glm::dvec3(lobes.specular.color), glm::dvec3(1)), lobes_->f0_r, lobes_->f0_g,
          lobes_->f0_b, i);
    lobes_->specular[i] = lobes.specular.factor;
    lobes_->clearcoat[i] = lobes.clearcoat.factor;
    lobes_->clearcoat_roughness[i] = lobes.clearcoat.roughness;
    store(point_.coat_normal, lobes_->coat_normal_x_ws, lobes_->coat_normal_y_ws, lobes_->coat_normal_z_ws,
          i);
    store(glm::dvec3(lobes.sheen.color), lobes_->sheen_r, lobes_->sheen_g, lobes_->sheen_b, i);
    lobes_->sheen_roughness[i] = lobes.sheen.roughness;
    store(point_.along, lobes_->along_x_ws, lobes_->along_y_ws, lobes_->along_z_ws, i);
    lobes_->anisotropy[i] = lobes.anisotropy.strength;
    lobes_->iridescence[i] = lobes.iridescence.factor;
    lobes_->film_thickness[i] = lobes.iridescence.thickness_maximum;
    lobes_->transmission[i] = lobes.transmission.factor;
    lobes_->thickness[i] = 0;
  }

  reference::LayeredPoint point_;
  frame::SurfaceLobes surface_;
  std::unique_ptr<SurfacePoints> points_ = std::make_unique<SurfacePoints>();
  std::unique_ptr<LobePoints> lobes_ = std::make_unique<LobePoints>();
  std::unique_ptr<Irradiance> irradiance_ = std::make_unique<Irradiance>();
  std::unique_ptr<shadow::Arrival> arrival_ = std::make_unique<shadow::Arrival>();
  std::unique_ptr<Radiance> radiance_ = std::make_unique<Radiance>();
};

// The normal is +Z, exactly, so that no rounding of it enters.
reference::LayeredPoint plain_point(double roughness, double metallic = 0) {
  reference::LayeredPoint p;
  p.surface.normal = {0, 0, 1};
  p.surface.base = {0.875, 0.5, 0.125};
  p.surface.roughness = static_cast<float>(roughness);
  p.surface.metallic = metallic;
  p.coat_normal = {0, 0, 1};
  p.along = {1, 0, 0};
  return p;
}

glm::dvec3 direction_above(std::mt19937& random, double least_cosine) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double z = least_cosine + (1 - least_cosine) * unit(random), turn = 6.28 * unit(random);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

struct Sweep {
  const char* name;
  // Parameter 0 … 1.
  void (*set)(reference::LayeredPoint& point, float t);
};

std::string sweep_name(const testing::TestParamInfo<Sweep>& info) { return info.param.name; }

class LobeSweep : public testing::TestWithParam<Sweep> {};

constexpr float kRoughnesses[] = {0.2F, 0.5F, 1};
constexpr float kSteps[] = {0, 0.25F, 0.5F, 1};

// Row 73. Cosines of single precision are off by 6e-8, of which a lobe of width α makes 2 · 6e-8 / α² of its value, with
// α = 0.04 the 5e-5 that are allowed.
TEST_P(LobeSweep, IsTheReferenceInDouble) {
  for (const float roughness : kRoughnesses) {
    for (const float t : kSteps) {
      std::mt19937 random(7);
      reference::LayeredPoint point = plain_point(roughness);
      GetParam().set(point, t);
      Batch batch(point);
      for (std::size_t i = 0; i < kMaxSamples; ++i)
        batch.set_directions(i, direction_above(random, 0.05), direction_above(random, 0.05));
      Radiance first;
      for (const InstructionSet set : supported_instruction_sets()) {
        const Radiance& radiance = batch.reflect(set);
        if (set == supported_instruction_sets().front()) first = radiance;
        ASSERT_EQ(std::memcmp(&first, &radiance, sizeof(Radiance)), 0) << name_of(set);
      }
      for (std::size_t i = 0; i < kMaxSamples; ++i) {
        const glm::dvec3 expected = batch.expected(i);
        const double tolerance = 5e-5 * std::max({expected.x, expected.y, expected.z}) + 2e-6;
        ASSERT_NEAR(first.r[i], expected.x, tolerance) << roughness << ' ' << t << ' ' << i;
        ASSERT_NEAR(first.g[i], expected.y, tolerance) << roughness << ' ' << t << ' ' << i;
        ASSERT_NEAR(first.b[i], expected.z, tolerance) << roughness << ' ' << t << ' ' << i;
      }
    }
  }
}

constexpr Sweep kSweeps[] = {
    {"plain", [](reference::LayeredPoint&, float) {}},
    {"metal", [](reference::LayeredPoint& p, float t) { p.surface.metallic = t; }},
    {"ior", [](reference::LayeredPoint& p, float t) { p.lobes.ior = t == 0 ? 0 : 1 + 1.5F * t; }},
    {"specular", [](reference::LayeredPoint& p, float t) { p.lobes.specular.factor = t; }},
    {"specular_color",
     [](reference::LayeredPoint& p, float t) {
       p.lobes.specular.color = {30 * t, 1, 1 - t};
     }},
    {"clearcoat",
     [](reference::LayeredPoint& p, float t) {
       p.lobes.clearcoat.factor = t;
       p.lobes.clearcoat.roughness = 0.3F;
     }},
    {"clearcoat_roughness",
     [](reference::LayeredPoint& p, float t) {
       p.lobes.clearcoat.factor = 1;
       p.lobes.clearcoat.roughness = 0.2F + 0.8F * t;
     }},
    {"clearcoat_normal",
     [](reference::LayeredPoint& p, float t) {
       p.lobes.clearcoat.factor = 1;
       p.lobes.clearcoat.roughness = 0.5F;
       p.coat_normal = glm::dvec3(glm::vec3(glm::normalize(glm::dvec3(0.6 * t, -0.3 * t, 1))));
     }},
    {"sheen_color",
     [](reference::LayeredPoint& p, float t) {
       p.lobes.sheen.color = {t, 0.5F * t, 0.1F};
       p.lobes.sheen.roughness = 0.4F;
     }},
    {"sheen_roughness",
     [](reference::LayeredPoint& p, float t) {
       p.lobes.sheen.color = {1, 0.5F, 0.1F};
       p.lobes.sheen.roughness = 0.25F + 0.75F * t;
     }},
    {"anisotropy", [](reference::LayeredPoint& p, float t) { p.lobes.anisotropy.strength = t; }},
    {"anisotropy_direction",
     [](reference::LayeredPoint& p, float t) {
       p.lobes.anisotropy.strength = 0.7F;
       p.surface.metallic = 1;
       const double turn = 3 * t;
       p.along = {static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)), 0};
     }},
    {"iridescence", [](reference::LayeredPoint& p, float t) { p.lobes.iridescence.factor = t; }},
    {"iridescence_thickness",
     [](reference::LayeredPoint& p, float t) {
       p.lobes.iridescence.factor = 1;
       p.lobes.iridescence.thickness_maximum = 1200 * t;
     }},
    {"iridescence_ior_on_metal",
     [](reference::LayeredPoint& p, float t) {
       p.surface.metallic = 0.5;
       p.lobes.iridescence.factor = 1;
       p.lobes.iridescence.ior = 1 + 0.9F * t;
     }},
    {"transmission", [](reference::LayeredPoint& p, float t) { p.lobes.transmission.factor = t; }},
    {"everything",
     [](reference::LayeredPoint& p, float t) {
       p.surface.metallic = 0.25;
       p.lobes.ior = 1.25F + t;
       p.lobes.specular.factor = 0.75F;
       p.lobes.clearcoat.factor = 0.5F;
       p.lobes.clearcoat.roughness = 0.25F;
       p.lobes.sheen.color = {0.25F, 0.5F, t};
       p.lobes.sheen.roughness = 0.5F;
       p.lobes.anisotropy.strength = 0.5F;
       p.lobes.iridescence.factor = 0.5F;
       p.lobes.transmission.factor = 0.5F;
     }},
};
INSTANTIATE_TEST_SUITE_P(Lobes, LobeSweep, testing::ValuesIn(kSweeps), sweep_name);

// The plain material's own formulas, where nothing of the lobes is set.
TEST(LayeredReflection, WithoutLobesIsAppendixB) {
  std::mt19937 random(3);
  for (const double metallic : {0.0, 0.5, 1.0}) {
    const reference::LayeredPoint point = plain_point(0.5, metallic);
    Batch batch(point);
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      const glm::dvec3 l = direction_above(random, 0.05);
      reference::SurfacePoint plain = point.surface;
      plain.to_eye = direction_above(random, 0.05);
      batch.set_directions(i, l, plain.to_eye);
      const glm::dvec3 expected = reference::reflect_gltf(plain, l), layered = batch.expected(i);
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(layered[c], expected[c], 1e-5 * expected[c]);
    }
  }
}

// Light may go either way: f(l, v) = f(v, l) wherever no coat is (whose share is, by definition, the eye's).
TEST(LayeredReflection, IsReciprocalBeneathTheCoat) {
  std::mt19937 random(5);
  reference::LayeredPoint point = plain_point(0.4, 0.25);
  point.lobes.sheen = {{0.5F, 0.25F, 1}, {}, 0.5F, {}};
  point.lobes.anisotropy.strength = 0.5F;
  point.lobes.iridescence.factor = 0.75F;
  point.lobes.specular.color = {1, 0.5F, 2};
  Batch there(point), back(point);
  std::vector<double> ratio;
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    const glm::dvec3 l = direction_above(random, 0.1), v = direction_above(random, 0.1);
    there.set_directions(i, l, v);
    back.set_directions(i, v, l);
    ratio.push_back(l.z / v.z);
  }
  const Radiance& one = there.reflect(best_instruction_set());
  const Radiance& other = back.reflect(best_instruction_set());
  for (std::size_t i = 0; i < kMaxSamples; ++i)
    ASSERT_NEAR(one.g[i], other.g[i] * ratio[i], 2e-4 * one.g[i] + 1e-6) << i;
}

// All that comes back of light of 1 from everywhere, by midpoints over the hemisphere: its largest channel.
double furnace(const reference::LayeredPoint& point, double n_v) {
  Batch batch(point);
  constexpr int kRings = 64, kTurns = 64;
  glm::dvec3 sum(0);
  for (int first = 0; first < kRings * kTurns; first += static_cast<int>(kMaxSamples)) {
    for (int i = 0; i < static_cast<int>(kMaxSamples); ++i) {
      const int ring = (first + i) / kTurns;
      const double z = (ring + 0.5) / kRings, turn = 6.283185307 * (i % kTurns + 0.5) / kTurns;
      const double r = std::sqrt(1 - z * z);
      batch.set_directions(static_cast<std::size_t>(i), {r * std::cos(turn), r * std::sin(turn), z},
                           {std::sqrt(1 - n_v * n_v), 0, n_v});
    }
    const Radiance& radiance = batch.reflect(best_instruction_set());
    for (std::size_t i = 0; i < kMaxSamples; ++i)
      sum += glm::dvec3(radiance.r[i], radiance.g[i], radiance.b[i]);
  }
  sum *= 6.283185307 / (kRings * kTurns);
  return std::max({sum.x, sum.y, sum.z});
}

// What is mirrored is never more than falls, nor what all layers send back together more than a plain white surface does:
// glTF's own mixture, which takes Fresnel's term at the half vector, comes to 1.02 at n·v 0.3. The film's formula, which
// mixes Schlick's terms of two interfaces, comes to 1.08 there, where it is thinnest.
TEST_P(LobeSweep, ReflectsNoMoreThanFalls) {
  for (const float t : kSteps) {
    for (const double n_v : {0.3, 0.6, 0.95}) {
      reference::LayeredPoint point = plain_point(0.6);
      point.surface.base = {1, 1, 1};
      const double plain = furnace(point, n_v);
      GetParam().set(point, t);
      if (point.coat_normal.z < 1) continue;  // light that the surface does not face counts twice
      const double most = point.lobes.iridescence.factor > 0 ? 1.085 : std::max(plain, 1.0) + 0.005;
      EXPECT_LE(furnace(point, n_v), most) << t << ' ' << n_v;
      point.lobes.transmission.factor = 1;  // nothing is scattered back
      EXPECT_LE(furnace(point, n_v), 1.003) << t << ' ' << n_v;
    }
  }
}

TEST(SheenAlbedoTable, IsTheIntegralOfTheLobe) {
  for (const std::size_t row : {9U, 16U, 31U}) {
    for (const std::size_t column : {3U, 12U, 31U}) {
      const double exact =
          reference::sheen_albedo(static_cast<double>(column) / 31, static_cast<double>(row) / 31, 200);
      EXPECT_NEAR(sheen_table().share[row * SheenAlbedo::kSide + column], exact, 2e-3)
          << row << ' ' << column;
    }
  }
}

}  // namespace
}  // namespace laterna::shade
