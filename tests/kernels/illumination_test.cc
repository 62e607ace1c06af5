// Arriving and reflected light on every instruction set against the formulas in double.
#include "shade/illumination.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

#include "kernels/store_vector.h"
#include "reference/reflection.h"
#include "reference/texture.h"

namespace laterna::shade {
namespace {

using shadow::kGroupSize;
using shadow::kMaxGroups;
using shadow::kMaxSamples;
using shadow::SampleArray;

glm::dvec3 vector_at(const SampleArray<float>& x, const SampleArray<float>& y, const SampleArray<float>& z,
                     std::size_t i) {
  return {x[i], y[i], z[i]};
}

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

bool same_bits(const SampleArray<float>& a, const SampleArray<float>& b) {
  return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;
}

// Points in front of a camera, with random normals that face it.
struct Points {
  std::unique_ptr<shadow::SurfaceSamples> samples = std::make_unique<shadow::SurfaceSamples>();
  std::unique_ptr<SurfacePoints> points = std::make_unique<SurfacePoints>();
  raster::RasterView view;

  explicit Points(unsigned seed, bool is_orthographic = false) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1), metres(2, 12);
    View camera;
    camera.pose = Pose::look_at({0.5, 1, 9}, {0, 0.3, 0}, {0, 1, 0}).value();
    camera.projection = is_orthographic ? Projection::orthographic(4, 3, 0.1, 20)
                                        : Projection::perspective(Angle::degrees(45), 4.0 / 3, 0.1, 100);
    view = raster::RasterView(camera, 640, 480);
    samples->ray = view.homogeneous_ray();
    samples->group_count = kMaxGroups;
    for (std::size_t i = 0; i < kMaxSamples; ++i) add(i, random, unit, metres);
    for (std::size_t g = 0; g < kMaxGroups; ++g) samples->active[g] = 0xFFFF;
    samples->active[3] = 0x5A01;
  }

 private:
  void add(std::size_t i, std::mt19937& random, std::uniform_real_distribution<float>& unit,
           std::uniform_real_distribution<float>& metres) const {
    shadow::SurfaceSamples& s = *samples;
    SurfacePoints& p = *points;
    s.x[i] = 640 * (unit(random) - 0.5F);
    s.y[i] = 480 * (unit(random) - 0.5F);
    s.q[i] = static_cast<float>(view.reversed_from_distance(metres(random)));
    s.dq_dx[i] = s.q[i] * (unit(random) - 0.5F) * 0.01F;
    s.dq_dy[i] = s.q[i] * (unit(random) - 0.5F) * 0.01F;
    store(position(i, 0, 0), s.x_ws, s.y_ws, s.z_ws, i);
    const glm::dvec3 to_eye =
        view.is_orthographic ? view.axis_ws : glm::normalize(view.eye_ws - position(i, 0, 0));
    glm::dvec3 normal = random_direction(random);
    if (glm::dot(normal, to_eye) < 0) normal = -normal;
    store(to_eye, p.to_eye_x_ws, p.to_eye_y_ws, p.to_eye_z_ws, i);
    store(normal, p.normal_x_ws, p.normal_y_ws, p.normal_z_ws, i);
    p.base_r[i] = unit(random), p.base_g[i] = unit(random), p.base_b[i] = unit(random);
    p.alpha[i] = 1;
    p.metallic[i] = i % 3 == 0 ? 0.0F : i % 3 == 1 ? 1.0F : unit(random);
    p.roughness[i] = 0.15F + 0.85F * unit(random);
    p.occlusion[i] = unit(random);
    p.emissive_r[i] = unit(random), p.emissive_g[i] = 0, p.emissive_b[i] = 2 * unit(random);
  }

 public:
  // The point of the sample's plane seen (dx, dy) pixels away.
  [[nodiscard]] glm::dvec3 position(std::size_t i, double dx, double dy) const {
    const shadow::SurfaceSamples& s = *samples;
    const double q = s.q[i] + dx * s.dq_dx[i] + dy * s.dq_dy[i];
    const glm::dvec3 direction =
        view.direction_0 + view.direction_x * (s.x[i] + dx) + view.direction_y * (s.y[i] + dy);
    return view.is_orthographic ? direction + view.axis_ws * q : view.eye_ws + direction / q;
  }
  [[nodiscard]] reference::SurfacePoint at(std::size_t i) const {
    const SurfacePoints& p = *points;
    return {vector_at(p.normal_x_ws, p.normal_y_ws, p.normal_z_ws, i),
            vector_at(p.to_eye_x_ws, p.to_eye_y_ws, p.to_eye_z_ws, i),
            vector_at(p.base_r, p.base_g, p.base_b, i), p.metallic[i], p.roughness[i]};
  }
};

struct TestLight {
  Light light;
  Pose pose;
  const image::MipChain* slide = nullptr;

  [[nodiscard]] frame::PlacedLight placed() const {
    frame::PlacedLight placed;
    placed.light = &light;
    placed.node = 0;
    placed.pose = pose;
    placed.view = {pose, light.projection};
    placed.intensity = light.intensity;
    placed.slide = slide;
    return placed;
  }
};

TestLight light_of(LightType type, Attenuation attenuation) {
  TestLight t;
  t.light.type = type;
  t.light.color = {1, 0.5F, 0.25F};
  t.light.intensity = 250;
  t.light.attenuation = attenuation;
  t.light.range = 11;
  t.light.custom_attenuation = [](float z) { return 1 / (1 + z); };
  t.light.inner_cone = Angle::degrees(12);
  t.light.outer_cone = Angle::degrees(35);
  t.light.projection = Projection::perspective(Angle::degrees(50), 1.5, 0.1, 100);
  t.pose = Pose::look_at({3, 4, 6}, {0, 0, 1}, {0, 1, 0}).value();
  return t;
}

std::unique_ptr<Irradiance> arriving(const TestLight& t, const Points& points, ShadingModel model,
                                     InstructionSet set, int anisotropy = 1) {
  const frame::PlacedLight placed = t.placed();
  const BoundLight bound(placed, points.samples->ray, model, anisotropy);
  auto irradiance = std::make_unique<Irradiance>();
  find_irradiance_for(set)(bound, *points.samples, *points.points, nullptr, *irradiance);
  return irradiance;
}

bool bit(const std::array<std::uint16_t, kMaxGroups>& bits, std::size_t i) {
  return (bits[i / kGroupSize] >> (i % kGroupSize) & 1U) != 0;
}

// Where a light does not shine, its direction means nothing.
bool same_bits(const Irradiance& a, const Irradiance& b) {
  for (const auto channel : {&Irradiance::to_light_x_ws, &Irradiance::to_light_y_ws,
                             &Irradiance::to_light_z_ws, &Irradiance::cosine}) {
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      if (bit(a.lit, i) && (a.*channel)[i] != (b.*channel)[i]) return false;
    }
  }
  return same_bits(a.r, b.r) && same_bits(a.g, b.g) && same_bits(a.b, b.b) &&
         same_bits(a.slide_s, b.slide_s) && same_bits(a.slide_t, b.slide_t) && a.lit == b.lit;
}

class Illumination : public testing::TestWithParam<InstructionSet> {};

constexpr Attenuation kAttenuations[] = {Attenuation::inverse_square, Attenuation::gltf_windowed,
                                         Attenuation::linear, Attenuation::none, Attenuation::custom};

// Where the light's image has coordinates (s, t), and whether the point is in front of the lens.
struct SlidePlace {
  double s, t;
  bool is_ahead;
};
SlidePlace slide_place(const TestLight& t, const glm::dvec3& point_ws) {
  const glm::dvec4 image = View{t.pose, t.light.projection}.image_from_world() * glm::dvec4(point_ws, 1);
  const double along = glm::dot(point_ws - t.pose.position_ws, t.pose.forward_ws());
  return {image.x / image.w, image.y / image.w, along > 0};
}

TEST_P(Illumination, EveryLightTypeFadesAsDefined) {
  for (const LightType type :
       {LightType::directional, LightType::point, LightType::spot, LightType::projector}) {
    for (const Attenuation attenuation : kAttenuations) {
      for (const BeamProfile profile : {BeamProfile::flat_field, BeamProfile::uniform_candela}) {
        for (const bool is_parallel : {false, true}) {
          if (is_parallel && type != LightType::projector) continue;
          TestLight t = light_of(type, attenuation);
          t.light.profile = profile;
          t.light.outside = Outside::clamp;
          if (is_parallel) t.light.projection = Projection::orthographic(3, 2, 0.1, 50);
          const Points points(static_cast<unsigned>(type) * 10 + static_cast<unsigned>(attenuation));
          const auto got = arriving(t, points, ShadingModel::pbr, GetParam());
          int lit = 0;
          for (std::size_t i = 0; i < kMaxSamples; ++i) {
            const glm::dvec3 at = points.position(i, 0, 0);
            const bool shines = type != LightType::projector || slide_place(t, at).is_ahead;
            const double expected = shines ? 250 * reference::illuminance(t.light, t.pose, at) : 0;
            // What fades to zero at the range keeps the rounding of a number near 1; the cone's slope magnifies that of
            // the angle's cosine.
            const double tolerance = 2e-5 * expected + 250 * (type == LightType::spot ? 2e-6 : 3e-7);
            ASSERT_NEAR(got->r[i], expected, tolerance)
                << static_cast<int>(type) << " " << static_cast<int>(attenuation);
            ASSERT_NEAR(got->g[i], 0.5 * expected, tolerance);
            ASSERT_NEAR(got->b[i], 0.25 * expected, tolerance);
            if (expected <= tolerance) continue;
            glm::dvec3 to_light = glm::normalize(t.pose.position_ws - at);
            if (type == LightType::directional || is_parallel) to_light = -t.pose.forward_ws();
            ASSERT_LT(glm::length(vector_at(got->to_light_x_ws, got->to_light_y_ws, got->to_light_z_ws, i) -
                                  to_light),
                      2e-6);
            const double cosine = glm::dot(points.at(i).normal, to_light);
            ASSERT_NEAR(got->cosine[i], cosine, 2e-6);
            if (std::abs(cosine) < 1e-5) continue;
            ASSERT_EQ(bit(got->lit, i), cosine > 0 && bit(points.samples->active, i));
            ++lit;
          }
          EXPECT_GT(lit, type == LightType::spot ? 5 : 50);
          EXPECT_TRUE(same_bits(*got, *arriving(t, points, ShadingModel::pbr, InstructionSet::scalar)));
        }
      }
    }
  }
}

TEST_P(Illumination, ThePapersModelKnowsNeitherDistanceNorAngle) {
  for (const LightType type : {LightType::directional, LightType::point, LightType::projector}) {
    for (const Attenuation attenuation : kAttenuations) {
      TestLight t = light_of(type, attenuation);
      t.light.outside = Outside::clamp;
      const Points points(5);
      const auto got = arriving(t, points, ShadingModel::papers, GetParam());
      for (std::size_t i = 0; i < kMaxSamples; ++i) {
        const glm::dvec3 at = points.position(i, 0, 0);
        if (type == LightType::projector && !slide_place(t, at).is_ahead) continue;
        const glm::dvec3 from_light = at - t.pose.position_ws;
        const double z =
            type == LightType::point ? glm::length(from_light) : glm::dot(from_light, t.pose.forward_ws());
        double expected = 1;
        if (type != LightType::directional && attenuation == Attenuation::linear)
          expected = std::clamp(1 - z / 11, 0.0, 1.0);
        if (type != LightType::directional && attenuation == Attenuation::custom) expected = 1 / (1 + z);
        ASSERT_NEAR(got->r[i], expected, 2e-5);
        ASSERT_NEAR(got->b[i], 0.25 * expected, 2e-5);
        ASSERT_EQ(got->cosine[i], 1.0F);
        if (expected < 1e-4) continue;
        ASSERT_EQ(bit(got->lit, i), bit(points.samples->active, i));
      }
    }
  }
}

image::MipChain noise_slide(int width, int height) {
  std::mt19937 random(77);
  Image slide(width, height, 3, PixelType::f32, Transfer::linear);
  for (float& value : slide.values<float>()) value = std::uniform_real_distribution<float>(0, 1)(random);
  return image::make_mip_chain(slide, image::MipUse::colour);
}

// Slide coordinates of a neighbouring point of the same plane, for the footprint.
reference::TextureProbe footprint(const TestLight& t, const Points& points, std::size_t i) {
  constexpr double kStep = 1e-4;
  const SlidePlace here = slide_place(t, points.position(i, 0, 0));
  const SlidePlace right = slide_place(t, points.position(i, kStep, 0));
  const SlidePlace below = slide_place(t, points.position(i, 0, kStep));
  return {here.s,
          here.t,
          (right.s - here.s) / kStep,
          (right.t - here.t) / kStep,
          (below.s - here.s) / kStep,
          (below.t - here.t) / kStep};
}

TEST_P(Illumination, SlidesAreLookedUpWhereEquationSixPutsThem) {
  const image::MipChain slide = noise_slide(64, 48);
  const Wrap wraps[] = {Wrap::clamp, Wrap::clamp, Wrap::repeat, Wrap::mirror};
  for (const Outside outside : {Outside::black, Outside::clamp, Outside::repeat, Outside::mirror}) {
    for (const int anisotropy : {1, 8}) {
      for (const bool is_parallel : {false, true}) {
        TestLight t = light_of(LightType::projector, Attenuation::none);
        t.light.color = glm::vec3(1);
        t.light.intensity = 1;
        t.light.outside = outside;
        t.light.profile = BeamProfile::uniform_candela;
        if (is_parallel) t.light.projection = Projection::orthographic(3, 2, 0.1, 50);
        t.slide = &slide;
        const Points points(9 + static_cast<unsigned>(outside), anisotropy == 8);
        const auto got = arriving(t, points, ShadingModel::pbr, GetParam(), anisotropy);
        Sampler sampler;
        sampler.wrap_u = sampler.wrap_v = wraps[static_cast<int>(outside)];
        int inside = 0;
        for (std::size_t i = 0; i < kMaxSamples; ++i) {
          const SlidePlace place = slide_place(t, points.position(i, 0, 0));
          const bool is_in_frame = place.s >= 0 && place.s <= 1 && place.t >= 0 && place.t <= 1;
          const double to_border = std::min(std::min(std::abs(place.s), std::abs(1 - place.s)),
                                            std::min(std::abs(place.t), std::abs(1 - place.t)));
          if (to_border < 1e-4 || std::abs(place.s) > 50 || std::abs(place.t) > 50) continue;
          if (!place.is_ahead || (outside == Outside::black && !is_in_frame)) {
            ASSERT_EQ(got->r[i], 0.0F);
            ASSERT_FALSE(bit(got->lit, i));
            ASSERT_TRUE(std::isnan(got->slide_s[i]) && std::isnan(got->slide_t[i]));
            continue;
          }
          ASSERT_NEAR(got->slide_s[i], place.s, 1e-5 * std::max(1.0, std::abs(place.s)));
          ASSERT_NEAR(got->slide_t[i], place.t, 1e-5 * std::max(1.0, std::abs(place.t)));
          const reference::TextureSample expected =
              reference::look_up(slide, sampler, anisotropy, footprint(t, points, i));
          if (expected.is_ambiguous) continue;
          // A texel is 1/64 of the slide: coordinates good to 1e-5 are good to 64e-5 of a texel, on each of
          // two axes.
          ASSERT_NEAR(got->r[i], expected.rgba[0],
                      2e-3 * std::max(1.0, std::abs(place.s) + std::abs(place.t)));
          ++inside;
        }
        EXPECT_GT(inside, 20);
        EXPECT_TRUE(
            same_bits(*got, *arriving(t, points, ShadingModel::pbr, InstructionSet::scalar, anisotropy)));
      }
    }
  }
}

TEST_P(Illumination, OverriddenSlideCoordinatesAreTaken) {
  TestLight t = light_of(LightType::projector, Attenuation::none);
  t.light.outside = Outside::clamp;
  const Points points(15);
  auto coordinates = std::make_unique<SlideCoordinates>();
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    coordinates->s[i] = static_cast<float>(i) / kMaxSamples;
    coordinates->t[i] = 0.25F;
  }
  coordinates->valid.fill(0x00FF);
  const frame::PlacedLight placed = t.placed();
  const BoundLight bound(placed, points.samples->ray, ShadingModel::pbr, 1);
  auto got = std::make_unique<Irradiance>();
  find_irradiance_for(GetParam())(bound, *points.samples, *points.points, coordinates.get(), *got);
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    const SlidePlace place = slide_place(t, points.position(i, 0, 0));
    if (!place.is_ahead) continue;
    const double expected = i % kGroupSize < 8 ? static_cast<double>(i) / kMaxSamples : place.s;
    ASSERT_NEAR(got->slide_s[i], expected, 1e-5 * std::max(1.0, std::abs(expected)));
  }
}

// ---------------------------------------------------------------------------------------------- reflection

struct ReflectionCase {
  const char* name;
  ReflectionSettings settings;
};

std::vector<ReflectionCase> reflection_cases() {
  std::vector<ReflectionCase> cases = {
      {"papers", {}}, {"phong 32", {}}, {"phong 5.5", {}}, {"phong", {}}, {"pbr", {}}};
  cases[0].settings.model = ShadingModel::papers;
  for (std::size_t i = 1; i < 4; ++i) cases[i].settings.model = ShadingModel::phong;
  cases[1].settings.phong = {0.6F, 32};
  cases[2].settings.phong = {0.3F, 5.5F};
  cases[4].settings.model = ShadingModel::pbr;
  return cases;
}

glm::dvec3 expected_reflection(const ReflectionSettings& settings, const reference::SurfacePoint& point,
                               const glm::dvec3& to_light) {
  switch (settings.model) {
    case ShadingModel::papers:
      return point.base;
    case ShadingModel::phong:
      return settings.phong ? reference::reflect_blinn_phong(point, to_light, *settings.phong)
                            : reference::reflect_blinn_phong(point, to_light);
    case ShadingModel::pbr:
      break;
  }
  return reference::reflect_gltf(point, to_light);
}

// Single precision in the half vector is magnified by sharp lobes: α = roughness² = 0.0225 at the least here.
double tolerance_of(const ReflectionSettings& settings, const reference::SurfacePoint& point) {
  if (settings.model == ShadingModel::papers) return 1e-6;
  const double a2 = std::pow(point.roughness, 4);
  return 2e-5 + (settings.phong ? 2e-6 * settings.phong->shininess : 2e-6 / a2);
}

TEST_P(Illumination, EveryModelReflectsByItsFormula) {
  for (const ReflectionCase& c : reflection_cases()) {
    for (const bool add : {false, true}) {
      const Points points(21);
      const TestLight t = light_of(LightType::point, Attenuation::inverse_square);
      const auto irradiance = arriving(t, points, c.settings.model, GetParam());
      const auto arrival = std::make_unique<shadow::Arrival>();
      SampleArray<float>& alpha = arrival->alpha;
      for (std::size_t i = 0; i < kMaxSamples; ++i) alpha[i] = static_cast<float>(i % 5) / 4;
      Radiance got, scalar;
      for (SampleArray<float>* channel : {&got.r, &got.g, &got.b, &scalar.r, &scalar.g, &scalar.b})
        channel->fill(7);
      reflect_for(GetParam())(c.settings, kMaxGroups, *points.points, *irradiance, *arrival, 0, add, got);
      reflect_for(InstructionSet::scalar)(c.settings, kMaxGroups, *points.points, *irradiance, *arrival, 0,
                                          add, scalar);
      EXPECT_TRUE(same_bits(got.r, scalar.r) && same_bits(got.g, scalar.g) && same_bits(got.b, scalar.b))
          << c.name;
      int lit = 0;
      for (std::size_t i = 0; i < kMaxSamples; ++i) {
        const glm::dvec3 radiance = vector_at(got.r, got.g, got.b, i) - (add ? glm::dvec3(7) : glm::dvec3(0));
        if (!bit(irradiance->lit, i)) {
          ASSERT_EQ(radiance, glm::dvec3(0)) << c.name;
          continue;
        }
        const reference::SurfacePoint point = points.at(i);
        const glm::dvec3 to_light = glm::normalize(t.pose.position_ws - points.position(i, 0, 0));
        const glm::dvec3 factor = expected_reflection(c.settings, point, to_light);
        const auto share = static_cast<double>(alpha[i]);
        for (int k = 0; k < 3; ++k) {
          const double e = vector_at(irradiance->r, irradiance->g, irradiance->b, i)[k] * share;
          const double allowed =
              e * factor[k] * tolerance_of(c.settings, point) + e * 1e-6 + (add ? 2e-6 : 0);
          ASSERT_NEAR(radiance[k], e * factor[k], allowed)
              << c.name << " sample " << i << " roughness " << point.roughness;
        }
        ++lit;
      }
      EXPECT_GT(lit, 50);
    }
  }
}

// Every channel has a share of its own, and of what is missing `fill` is reflected without the highlight: for a matt
// surface that is as if so much more had arrived.
TEST_P(Illumination, TintAndFill) {
  const Points points(22);
  const TestLight t = light_of(LightType::point, Attenuation::inverse_square);
  const auto arrival = std::make_unique<shadow::Arrival>();
  arrival->is_tinted = true;
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    arrival->r[i] = static_cast<float>(i % 5) / 4;
    arrival->g[i] = static_cast<float>(i % 3) / 2;
    arrival->b[i] = 1;
  }
  const auto full = std::make_unique<shadow::Arrival>();
  full->alpha.fill(1);
  for (const ReflectionCase& c : reflection_cases()) {
    const auto irradiance = arriving(t, points, c.settings.model, GetParam());
    const auto reflected = [&](const shadow::Arrival& share, float fill) {
      auto out = std::make_unique<Radiance>();
      reflect_for(GetParam())(c.settings, kMaxGroups, *points.points, *irradiance, share, fill, false, *out);
      return out;
    };
    const auto lit = reflected(*full, 0), tinted = reflected(*arrival, 0),
               filled = reflected(*arrival, 0.25F);
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      ASSERT_NEAR(tinted->r[i], lit->r[i] * arrival->r[i], 2e-6F * lit->r[i]) << c.name;
      ASSERT_NEAR(tinted->g[i], lit->g[i] * arrival->g[i], 2e-6F * lit->g[i]) << c.name;
      ASSERT_EQ(tinted->b[i], lit->b[i]) << c.name;
      ASSERT_EQ(filled->b[i], lit->b[i]) << c.name;
      const float most = tinted->r[i] + 0.25F * (lit->r[i] - tinted->r[i]);
      ASSERT_LE(filled->r[i], most * 1.00001F) << c.name;
      if (c.settings.model == ShadingModel::papers) {
        ASSERT_NEAR(filled->r[i], most, 2e-6F * lit->r[i]);
      }
      if (lit->r[i] > 0 && arrival->r[i] == 0 && points.points->base_r[i] > 0 &&
          points.points->metallic[i] < 1) {
        ASSERT_GT(filled->r[i], 0) << c.name;
      }
    }
  }
}

// Below α = 0.001 the lobe is held: a mirror would show a point light as nothing or as infinitely bright.
TEST_P(Illumination, MirrorsAndGrazingAnglesStayFinite) {
  Points points(33);
  SurfacePoints& p = *points.points;
  std::mt19937 random(4);
  auto irradiance = std::make_unique<Irradiance>();
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    p.roughness[i] = 0;
    const glm::dvec3 n = random_direction(random);
    const glm::dvec3 side = glm::normalize(glm::cross(n, random_direction(random)));
    // Toward the eye: along the normal, grazing, or behind the shading normal, as on the rim of a smooth
    // sphere.
    const double lift = i % 4 == 0 ? 1.0 : i % 4 == 1 ? 1e-6 : i % 4 == 2 ? 0.0 : -0.3;
    const glm::dvec3 to_eye = glm::normalize(side + lift * n),
                     to_light = glm::normalize(-side + std::max(lift, 1e-7) * n);
    store(n, p.normal_x_ws, p.normal_y_ws, p.normal_z_ws, i);
    store(to_eye, p.to_eye_x_ws, p.to_eye_y_ws, p.to_eye_z_ws, i);
    store(to_light, irradiance->to_light_x_ws, irradiance->to_light_y_ws, irradiance->to_light_z_ws, i);
    irradiance->r[i] = irradiance->g[i] = irradiance->b[i] = 1000;
    irradiance->cosine[i] = static_cast<float>(glm::dot(n, to_light));
  }
  irradiance->lit.fill(0xFFFF);
  const auto arrival = std::make_unique<shadow::Arrival>();
  arrival->alpha.fill(1);
  for (const ReflectionCase& c : reflection_cases()) {
    Radiance got;
    reflect_for(GetParam())(c.settings, kMaxGroups, p, *irradiance, *arrival, 0, false, got);
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      for (const float value : {got.r[i], got.g[i], got.b[i]}) {
        ASSERT_TRUE(std::isfinite(value)) << c.name << " " << i;
        ASSERT_GE(value, -1e-3F) << c.name << " " << i;
      }
    }
  }
}

TEST_P(Illumination, AmbientIsBaseTimesAmbientTimesOcclusionPlusEmission) {
  const Points points(40);
  const SurfacePoints& p = *points.points;
  ReflectionSettings settings;
  settings.ambient[0] = 0.2F, settings.ambient[1] = 0.3F, settings.ambient[2] = 0.4F;
  frame::Surface surface;
  Radiance got;
  find_ambient_for(GetParam())(settings, surface, kMaxGroups, p, got);
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    ASSERT_NEAR(got.r[i], 0.2 * p.base_r[i] * p.occlusion[i] + p.emissive_r[i], 1e-6);
    ASSERT_NEAR(got.g[i], 0.3 * p.base_g[i] * p.occlusion[i] + p.emissive_g[i], 1e-6);
    ASSERT_NEAR(got.b[i], 0.4 * p.base_b[i] * p.occlusion[i] + p.emissive_b[i], 1e-6);
  }
  surface.unlit = true;
  find_ambient_for(GetParam())(settings, surface, kMaxGroups, p, got);
  EXPECT_TRUE(same_bits(got.r, p.base_r) && same_bits(got.g, p.base_g) && same_bits(got.b, p.base_b));
}

INSTANTIATE_TEST_SUITE_P(Sets, Illumination, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::shade
