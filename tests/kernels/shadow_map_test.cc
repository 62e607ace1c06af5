// Look-ups into depth maps on every instruction set: the plain filters texel by texel in double, the refined one
// against rays tested with every triangle.
#include "shadow/shadow_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "reference/shapes.h"
#include "render/depth_map_cache.h"
#include "shade/surface_points.h"
#include "shadow/depth_comparison.h"

namespace laterna::shadow {
namespace {

// ---------------------------------------------------------------------------------------------- samples

glm::dvec3 at(const SampleArray<float>& x, const SampleArray<float>& y, const SampleArray<float>& z,
              std::size_t i) {
  return {x[i], y[i], z[i]};
}

raster::RasterView camera_view() {
  return {reference::look({0.5, 2, 9}, {0, 0, 0}, 55, 1.25, {0, 1, 0}, 0.1, 100), 500, 400};
}

// Points anywhere before the camera, each on a plane of its own.
std::unique_ptr<SurfaceSamples> random_samples(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-0.5F, 0.5F);
  std::uniform_real_distribution<double> metres(2, 16);
  std::normal_distribution<double> normal;
  const raster::RasterView view = camera_view();
  auto s = std::make_unique<SurfaceSamples>();
  s->ray = view.homogeneous_ray();
  s->group_count = kMaxGroups;
  s->active.fill(0xFFFF);
  s->position_error = 1e-6F;
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    s->x[i] = 500 * unit(random);
    s->y[i] = 400 * unit(random);
    s->q[i] = static_cast<float>(1 / metres(random));
    const double w = 1.0 / s->q[i];
    const glm::dvec3 p =
        view.eye_ws + w * (view.direction_0 + view.direction_x * static_cast<double>(s->x[i]) +
                           view.direction_y * static_cast<double>(s->y[i]));
    const glm::dvec3 n = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    s->x_ws[i] = static_cast<float>(p.x), s->y_ws[i] = static_cast<float>(p.y),
    s->z_ws[i] = static_cast<float>(p.z);
    s->normal_x_ws[i] = static_cast<float>(n.x), s->normal_y_ws[i] = static_cast<float>(n.y);
    s->normal_z_ws[i] = static_cast<float>(n.z);
    s->id[i] = 0;
  }
  return s;
}

using Maps = std::vector<std::shared_ptr<DepthMap>>;

std::vector<float> look_up(const light::PlannedLight& planned, const Maps& maps, const frame::Frame& frame,
                           const SurfaceSamples& samples, int samples_per_pixel, InstructionSet set) {
  const ShadowMap shadow(planned, maps, frame, nullptr, samples.ray, samples_per_pixel, set);
  const auto arrival = std::make_unique<Arrival>();
  shadow.find_arrival(samples, std::span(samples.active).first(samples.group_count), *arrival);
  return {arrival->alpha.begin(), arrival->alpha.end()};
}

// ---------------------------------------------------------------------------------------------- plain filters

// Every texel has seen something else, or nothing.
DepthMap random_map(const light::ShadowView& shadow_view, std::mt19937& random) {
  const raster::RasterView view(shadow_view.view, shadow_view.width, shadow_view.height);
  DepthMap map(view, false);
  std::uniform_real_distribution<double> metres(1, 18);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      float& texel = map.tile(
          x / raster::kTileSide,
          y / raster::kTileSide)[raster::index_in_tile(x % raster::kTileSide, y % raster::kTileSide)];
      texel =
          random() % 8 == 0 ? kNothingSeen : static_cast<float>(view.reversed_from_distance(metres(random)));
    }
  }
  return map;
}

struct PlainResult {
  double alpha = 0;
  bool is_ambiguous = false;
};

// One sample and one map in double: the definition of ShadowBias, with the receiver's plane met by each texel's ray.
class PlainReference {
 public:
  PlainReference(const DepthMap& map, const ShadowSettings& settings, const glm::dvec3& point,
                 const glm::dvec3& normal, double position_error)
      : map_(map), view_(map.view()), settings_(settings), point_(point), normal_(normal) {
    const glm::dvec4 image = view_.view.image_from_world() * glm::dvec4(point, 1);
    x_ = image.x / image.w * map.width();
    y_ = image.y / image.w * map.height();
    const double distance = glm::dot(point - view_.view.pose.position_ws, view_.view.pose.forward_ws());
    q_ = view_.reversed_from_distance(distance);
    is_seen_ = (view_.is_orthographic || distance > 0) && distance <= view_.view.projection.far;
    is_ambiguous_ = std::abs(distance) < 0.01 || std::abs(distance - view_.view.projection.far) < 1e-3;
    const glm::dvec3 to_light = view_.is_orthographic ? view_.axis_ws : glm::normalize(view_.eye_ws - point);
    const double facing = glm::dot(normal, to_light);
    is_ambiguous_ |= std::abs(facing) < 0.1;
    const double per_metre = view_.is_orthographic ? 1 : q_ * q_;
    const double texel_size = std::max(glm::length(view_.direction_x), glm::length(view_.direction_y));
    const double texel = view_.is_orthographic ? texel_size : texel_size * q_;
    const double slope = std::abs(plane_at(1, 0) - q_) + std::abs(plane_at(0, 1) - q_);
    const bool is_manual = settings.constant_bias || settings.slope_bias;
    bias_ = position_error * per_metre + 2e-6 * std::abs(q_);
    if (is_manual) bias_ += settings.constant_bias.value_or(0) * per_metre;
    if (facing > 0) bias_ += is_manual ? settings.slope_bias.value_or(0) * slope : 0.5 * texel + 0.25 * slope;
  }

  [[nodiscard]] PlainResult alpha() {
    if (!is_seen_) return {outside(), is_ambiguous_};
    double sum = 0;
    if (settings_.filter == ShadowFilter::bilinear) {
      const double i = std::floor(x_ - 0.5), j = std::floor(y_ - 0.5), a = x_ - 0.5 - i, b = y_ - 0.5 - j;
      sum = (1 - b) * ((1 - a) * tap(i, j) + a * tap(i + 1, j)) +
            b * ((1 - a) * tap(i, j + 1) + a * tap(i + 1, j + 1));
    } else {
      const int kernel = settings_.filter == ShadowFilter::nearest ? 1 : settings_.kernel;
      const double i = first_of(x_, kernel), j = first_of(y_, kernel);
      for (int row = 0; row < kernel; ++row) {
        for (int column = 0; column < kernel; ++column) sum += tap(i + column, j + row) / (kernel * kernel);
      }
    }
    return {sum, is_ambiguous_};
  }

 private:
  // First of the `kernel` texels that lie most evenly about the coordinate.
  double first_of(double x, int kernel) {
    const double first = x - 0.5 * (kernel - 1);
    is_ambiguous_ |= std::abs(first - std::round(first)) < 1e-3;
    return std::floor(first);
  }

  // Reversed depth of the receiver's plane under a point of the map, (dx, dy) texels from the sample.
  [[nodiscard]] double plane_at(double dx, double dy) const {
    const glm::dvec3 direction = view_.direction_0 + view_.direction_x * (x_ + dx - view_.origin_x) +
                                 view_.direction_y * (y_ + dy - view_.origin_y);
    if (view_.is_orthographic)
      return glm::dot(normal_, point_ - direction) / glm::dot(normal_, view_.axis_ws);
    return glm::dot(normal_, direction) / glm::dot(normal_, point_ - view_.eye_ws);
  }

  double tap(double i, double j) {
    if (i < 0 || j < 0 || i >= map_.width() || j >= map_.height()) return outside();
    const bool is_manual = settings_.constant_bias || settings_.slope_bias;
    const double tested = is_manual ? q_ : plane_at(i + 0.5 - x_, j + 0.5 - y_);
    const double stored = map_.reversed_depth(static_cast<int>(i), static_cast<int>(j));
    const double scale = std::max({std::abs(stored), std::abs(tested), bias_});
    is_ambiguous_ |= stored != kNothingSeen && std::abs(stored - tested - bias_) < 2e-4 * scale;
    return stored <= tested + bias_ ? 1 : 0;
  }

  [[nodiscard]] double outside() const { return settings_.outside_is_lit ? 1 : 0; }

  const DepthMap& map_;
  const raster::RasterView& view_;
  const ShadowSettings& settings_;
  glm::dvec3 point_, normal_;
  double x_ = 0, y_ = 0, q_ = 0, bias_ = 0;
  bool is_seen_ = false, is_ambiguous_ = false;
};

// Which face of a cube a ray from its centre leaves through: +X, −X, +Y, −Y, +Z, −Z.
std::size_t face_of(const glm::dvec3& ray) {
  const glm::dvec3 a(std::abs(ray.x), std::abs(ray.y), std::abs(ray.z));
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return static_cast<std::size_t>(2 * axis + (ray[axis] < 0 ? 1 : 0));
}

struct LightCase {
  const char* name;
  LightType type;
  bool is_orthographic;
};
constexpr LightCase kLightCases[] = {{"projector", LightType::projector, false},
                                     {"parallel projector", LightType::projector, true},
                                     {"point", LightType::point, false}};

// A frame with one light over nothing.
reference::OwnedFrame frame_with(const LightCase& c, const ShadowSettings& settings) {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(5));
  Light light;
  light.type = c.type;
  light.range = 14;
  light.projection = c.is_orthographic ? Projection::orthographic(3, 2, 0.5, 14)
                                       : Projection::perspective(Angle::degrees(50), 1.4, 0.5, 14);
  light.shadow = settings;
  light.shadow.resolution = 90;
  reference::add_light(scene, light, {2, 5, 3}, {0, 0, 0});
  return reference::make_frame(std::move(scene));
}

std::vector<ShadowSettings> plain_settings() {
  std::vector<ShadowSettings> all;
  for (const bool outside_is_lit : {true, false}) {
    for (const bool is_manual : {false, true}) {
      ShadowSettings s;
      s.outside_is_lit = outside_is_lit;
      if (is_manual) s.constant_bias = 0.05, s.slope_bias = 1.5;
      s.filter = ShadowFilter::nearest;
      all.push_back(s);
      s.filter = ShadowFilter::bilinear;
      all.push_back(s);
      s.filter = ShadowFilter::percentage_closer;
      for (s.kernel = 2; s.kernel <= 9; ++s.kernel) all.push_back(s);
    }
  }
  return all;
}

class ShadowMapOnEverySet : public testing::TestWithParam<InstructionSet> {};

TEST_P(ShadowMapOnEverySet, PlainFiltersCompareTexelByTexel) {
  for (const LightCase& c : kLightCases) {
    for (const ShadowSettings& settings : plain_settings()) {
      const reference::OwnedFrame owned = frame_with(c, settings);
      const light::LightPlan plan = light::make_light_plan(owned.frame, {});
      const light::PlannedLight& planned = plan.lights.at(0);
      std::mt19937 random(13);
      Maps maps;
      for (const light::ShadowView& view : planned.shadow_views) {
        maps.push_back(std::make_shared<DepthMap>(random_map(view, random)));
      }
      const auto samples = random_samples(static_cast<unsigned>(settings.kernel));
      const std::vector<float> got = look_up(planned, maps, owned.frame, *samples, 1, GetParam());
      int asked = 0;
      double sum = 0;
      for (std::size_t i = 0; i < kMaxSamples; ++i) {
        const glm::dvec3 point = at(samples->x_ws, samples->y_ws, samples->z_ws, i);
        const glm::dvec3 normal = at(samples->normal_x_ws, samples->normal_y_ws, samples->normal_z_ws, i);
        const std::size_t face = maps.size() == 1 ? 0 : face_of(point - maps[0]->view().eye_ws);
        const PlainResult expected =
            PlainReference(*maps[face], settings, point, normal, samples->position_error).alpha();
        if (expected.is_ambiguous) continue;
        ASSERT_NEAR(got[i], expected.alpha, settings.filter == ShadowFilter::bilinear ? 2e-4 : 1e-6)
            << c.name << " filter " << static_cast<int>(settings.filter) << " kernel " << settings.kernel
            << " manual " << settings.constant_bias.has_value() << " sample " << i;
        ++asked;
        sum += expected.alpha;
      }
      EXPECT_GT(asked, 120);
      EXPECT_GT(sum, 5);
      EXPECT_LT(sum, asked - 5);
      EXPECT_EQ(got, look_up(planned, maps, owned.frame, *samples, 1, InstructionSet::scalar));
    }
  }
}

// Row 29's table, through the whole look-up: a map of one depth, and a receiver that squarely faces the light.
TEST_P(ShadowMapOnEverySet, TheComparisonsTableHoldsThroughEveryFilter) {
  struct Row {
    double stored, tested, bias;  // metres from the light
    bool is_lit;
  };
  const Row rows[] = {{5, 5, 0, true},      {5, 4, 0, true},       {5, 6, 0, false},     {5, 5.01, 0, false},
                      {5, 5.2, 0.25, true}, {5, 5.3, 0.25, false}, {5, 4.9, 0.25, true}, {5, 5, -0.1, false}};
  for (const ShadowFilter filter :
       {ShadowFilter::nearest, ShadowFilter::bilinear, ShadowFilter::percentage_closer}) {
    for (const Row& row : rows) {
      ShadowSettings settings;
      settings.filter = filter;
      settings.constant_bias = row.bias;
      const reference::OwnedFrame owned = frame_with(kLightCases[1], settings);
      const light::LightPlan plan = light::make_light_plan(owned.frame, {});
      const light::PlannedLight& planned = plan.lights.at(0);
      const light::ShadowView& shadow_view = planned.shadow_views.at(0);
      DepthMap map(raster::RasterView(shadow_view.view, shadow_view.width, shadow_view.height), false);
      const auto stored = static_cast<float>(map.view().reversed_from_distance(row.stored));
      for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x) std::fill_n(map.tile(x, y), raster::kTilePixels, stored);
      }
      // All samples in the middle of the map, by way of their own rays.
      auto samples = std::make_unique<SurfaceSamples>();
      const Pose& pose = shadow_view.view.pose;
      const glm::dvec3 p = pose.position_ws + pose.forward_ws() * row.tested + pose.right_ws() * 0.3;
      samples->ray = {glm::dvec4(p, 1), glm::dvec4(0), glm::dvec4(0), glm::dvec4(0)};
      samples->group_count = 1;
      samples->active.fill(0xFFFF);
      for (std::size_t i = 0; i < kGroupSize; ++i) {
        samples->x_ws[i] = static_cast<float>(p.x), samples->y_ws[i] = static_cast<float>(p.y);
        samples->z_ws[i] = static_cast<float>(p.z);
        const glm::dvec3 n = -pose.forward_ws();
        samples->normal_x_ws[i] = static_cast<float>(n.x), samples->normal_y_ws[i] = static_cast<float>(n.y);
        samples->normal_z_ws[i] = static_cast<float>(n.z);
      }
      const Maps maps = {std::make_shared<DepthMap>(std::move(map))};
      const std::vector<float> got = look_up(planned, maps, owned.frame, *samples, 1, GetParam());
      for (std::size_t i = 0; i < kGroupSize; ++i) {
        ASSERT_EQ(got[i], row.is_lit ? 1.0F : 0.0F) << row.stored << " " << row.tested << " " << row.bias;
      }
    }
  }
}

// ---------------------------------------------------------------------------------------------- refined

// Every triangle of a frame that blocks light, in double.
class Casters {
 public:
  explicit Casters(const frame::Frame& frame) {
    for (std::uint32_t c = 0; c < frame.clusters.size(); ++c) {
      const Cluster& cluster = frame.clusters[c];
      const frame::Surface& surface = frame.surfaces[cluster.material];
      // Cut-outs of this test have one alpha all over.
      const bool is_hole =
          surface.alpha_mode == AlphaMode::mask && surface.base_color[3] < surface.alpha_cutoff;
      for (std::uint32_t t = 0; t < cluster.triangle_count && !is_hole; ++t) {
        const TriangleId id = c << kTriangleBits | t;
        Triangle triangle = {id, {}, (cluster.flags & kCastsShadow) != 0};
        for (std::uint32_t k = 0; k < 3; ++k) {
          const std::uint32_t v = cluster.first_vertex + (frame.corners[id] >> (8 * k) & 255U);
          triangle.corner[k] = frame.positions_ws[v];
        }
        triangles_.push_back(triangle);
      }
    }
  }

  struct Hit {
    TriangleId id;
    double distance;
  };
  // The nearest triangle along a ray, by the signed volumes of the tetrahedra it makes with the edges.
  [[nodiscard]] std::optional<Hit> first(const glm::dvec3& from, const glm::dvec3& ray, double longest,
                                         TriangleId own, bool casters_only) const {
    std::optional<Hit> nearest;
    for (const Triangle& t : triangles_) {
      if (t.id == own || (casters_only && !t.casts)) continue;
      const glm::dvec3 a = t.corner[0] - from, b = t.corner[1] - from, c = t.corner[2] - from;
      const double u = glm::dot(ray, glm::cross(c, b)), v = glm::dot(ray, glm::cross(a, c)),
                   w = glm::dot(ray, glm::cross(b, a));
      if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) continue;
      if (u + v + w == 0) continue;
      const glm::dvec3 hit = (a * u + b * v + c * w) / (u + v + w);
      const double distance = glm::dot(hit, ray) / glm::dot(ray, ray);
      if (distance > 1e-6 && distance < longest && (!nearest || distance < nearest->distance))
        nearest = {t.id, distance};
    }
    return nearest;
  }

 private:
  struct Triangle {
    TriangleId id;
    glm::dvec3 corner[3];
    bool casts;
  };
  std::vector<Triangle> triangles_;
};

Scene box_scene(LightType type, bool is_parallel) {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(6));
  reference::add_object(scene, "box", reference::box({0.3F, 0.8F, 0.2F}, {0.7F, 0.8F, 0.5F}));
  reference::add_object(scene, "plate", reference::box({-1.7F, 1.5F, 0.5F}, {0.6F, 0.05F, 0.8F}));
  for (const float alpha : {0.2F, 0.9F}) {
    const int node =
        reference::add_object(scene, "cut out", reference::wall(0.5F, 0.5F, alpha < 0.5F ? 2.0F : -1.5F));
    const auto i = static_cast<std::size_t>(node);
    scene.nodes[i].parent_from_node[3] = glm::dvec4(1.5, 1, 0, 1);
    scene.materials.back().alpha_mode = AlphaMode::mask;
    scene.materials.back().base_color.a = alpha;
    scene.materials.back().double_sided = true;
  }
  const int ghost =
      reference::add_object(scene, "casts nothing", reference::box({-2, 0.5F, 2}, {0.4F, 0.5F, 0.4F}));
  scene.nodes[static_cast<std::size_t>(ghost)].casts_shadow = false;
  Light light;
  light.type = type;
  light.outer_cone = Angle::degrees(60);
  light.projection = is_parallel ? Projection::orthographic(6, 6, 0.1, 30)
                                 : Projection::perspective(Angle::degrees(80), 1, 0.1, 60);
  light.shadow.resolution = 512;
  // From behind, so that shadows fall toward the camera.
  reference::add_light(scene, light, {2.2, 5, -3.1}, {0, 0, 0});
  return scene;
}

struct Lit {
  bool value;       // by a ray to the light
  bool is_certain;  // and by those from 2 shadow texels around
};

class Truth {
 public:
  Truth(const frame::Frame& frame, const light::PlannedLight& planned) : casters_(frame) {
    const View& view = planned.shadow_views[0].view;
    is_parallel_ = view.projection.is_orthographic;
    light_ = view.pose.position_ws;
    forward_ = view.pose.forward_ws();
    const raster::RasterView raster(view, planned.shadow_views[0].width, planned.shadow_views[0].height);
    texel_ = glm::length(raster.direction_x);
  }
  [[nodiscard]] const Casters& casters() const { return casters_; }

  [[nodiscard]] bool is_lit(const glm::dvec3& p, TriangleId own) const {
    const glm::dvec3 ray = is_parallel_ ? -forward_ : light_ - p;
    return !casters_.first(p, ray, is_parallel_ ? 1e9 : 1.0, own, true);
  }
  [[nodiscard]] Lit at(const glm::dvec3& p, const glm::dvec3& normal, TriangleId own) const {
    Lit lit = {is_lit(p, own), true};
    const double reach = 2 * texel_ * (is_parallel_ ? 1 : glm::length(light_ - p));
    const glm::dvec3 side = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8)));
    const glm::dvec3 other = glm::cross(normal, side);
    // A texel's square is stretched over a slanting surface.
    const glm::dvec3 to_light = is_parallel_ ? -forward_ : glm::normalize(light_ - p);
    const double stretched = reach / std::max(0.05, std::abs(glm::dot(normal, to_light)));
    for (int k = 0; k < 16; ++k) {
      const double angle = k * 0.39269908169872414;
      const double length = k % 2 == 0 ? stretched : 0.5 * stretched;
      lit.is_certain &=
          is_lit(p + length * (std::cos(angle) * side + std::sin(angle) * other), own) == lit.value;
    }
    return lit;
  }

 private:
  Casters casters_;
  bool is_parallel_ = false;
  glm::dvec3 light_{0}, forward_{0};
  double texel_ = 0;
};

struct RefinedCase {
  const char* name;
  LightType type;
  bool is_parallel;
};

// Samples where camera rays through the middle of the picture, where the objects are, first meet the scene.
std::unique_ptr<SurfaceSamples> seen_samples(const frame::Frame& frame, const Casters& casters,
                                             InstructionSet set, unsigned seed) {
  const raster::RasterView view = camera_view();
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-0.5F, 0.5F);
  auto s = std::make_unique<SurfaceSamples>();
  s->ray = view.homogeneous_ray();
  s->group_count = kMaxGroups;
  s->active.fill(0xFFFF);
  float farthest = 0;
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    std::optional<Casters::Hit> hit;
    while (!hit) {
      s->x[i] = 220 * unit(random);
      s->y[i] = 140 * unit(random) + 20;
      const glm::dvec3 ray = view.direction_0 + view.direction_x * static_cast<double>(s->x[i]) +
                             view.direction_y * static_cast<double>(s->y[i]);
      hit = casters.first(view.eye_ws, ray, 1e9, kNoTriangle, false);
    }
    s->q[i] = static_cast<float>(1 / hit->distance);
    s->id[i] = hit->id;
    farthest = std::max(farthest, static_cast<float>(hit->distance));
  }
  s->position_error = 1.2e-7F * 6 + 4e-7F * farthest;
  const shade::PointSource source = {&frame, &view, Interpolation::perspective, 1};
  shade::SurfacePoints points;
  shade::find_surface_points_for(set)(source, frame::Surface{}, *s, points);
  return s;
}

Maps draw_maps(const light::PlannedLight& planned, const frame::Frame& frame, InstructionSet set,
               bool keeps_triangles) {
  const TaskPool pool(1);
  render::BinsPool bins;
  StageTimes times;
  Maps maps;
  for (const light::ShadowView& view : planned.shadow_views) {
    maps.push_back(std::make_shared<DepthMap>(
        render::draw_depth_map({frame, pool, bins, set, times}, view, CasterFaces::both, keeps_triangles)));
  }
  return maps;
}

constexpr RefinedCase kRefinedCases[] = {{"projector", LightType::projector, false},
                                         {"parallel projector", LightType::projector, true},
                                         {"spot", LightType::spot, false},
                                         {"sun", LightType::directional, true},
                                         {"point", LightType::point, false}};

TEST_P(ShadowMapOnEverySet, RefinedShadowsAreThoseOfRays) {
  for (const RefinedCase& c : kRefinedCases) {
    const reference::OwnedFrame owned = reference::make_frame(box_scene(c.type, c.is_parallel));
    const light::LightPlan plan = light::make_light_plan(owned.frame, {});
    const light::PlannedLight& planned = plan.lights.at(0);
    const Truth truth(owned.frame, planned);
    const Maps maps = draw_maps(planned, owned.frame, GetParam(), true);
    int certain = 0, dark = 0, near_edges = 0, agree_near_edges = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
      const auto samples = seen_samples(owned.frame, truth.casters(), GetParam(), seed);
      const std::vector<float> got = look_up(planned, maps, owned.frame, *samples, 4, GetParam());
      ASSERT_EQ(got, look_up(planned, draw_maps(planned, owned.frame, InstructionSet::scalar, true),
                             owned.frame, *samples, 4, InstructionSet::scalar));
      for (std::size_t i = 0; i < kMaxSamples; ++i) {
        const glm::dvec3 point = at(samples->x_ws, samples->y_ws, samples->z_ws, i);
        const glm::dvec3 normal = at(samples->normal_x_ws, samples->normal_y_ws, samples->normal_z_ws, i);
        const Lit lit = truth.at(point, normal, samples->id[i]);
        if (lit.is_certain) {
          ASSERT_EQ(got[i], lit.value ? 1.0F : 0.0F)
              << c.name << " at " << point.x << ", " << point.y << ", " << point.z << " normal " << normal.x
              << ", " << normal.y << ", " << normal.z;
          ++certain;
          dark += lit.value ? 0 : 1;
        } else {
          ++near_edges;
          agree_near_edges += std::abs(got[i] - (lit.value ? 1.0F : 0.0F)) < 0.5F ? 1 : 0;
        }
      }
    }
    EXPECT_GT(certain, 2500) << c.name;
    EXPECT_GT(dark, 150) << c.name;
    EXPECT_GT(near_edges, 30) << c.name;
    // Within two texels of an edge too nearly all is as by rays: corners narrower than a texel are what is left.
    EXPECT_GE(agree_near_edges, near_edges * 97 / 100) << c.name << " of " << near_edges;
  }
}

// At one sample per pixel α is the mean over five places in the pixel.
TEST_P(ShadowMapOnEverySet, RefinedShadowsOfOneSampleAreAntialiasedInFifths) {
  const reference::OwnedFrame owned = reference::make_frame(box_scene(LightType::projector, false));
  const light::LightPlan plan = light::make_light_plan(owned.frame, {});
  const Truth truth(owned.frame, plan.lights.at(0));
  const Maps maps = draw_maps(plan.lights[0], owned.frame, GetParam(), true);
  int between = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const auto samples = seen_samples(owned.frame, truth.casters(), GetParam(), seed);
    const std::vector<float> got = look_up(plan.lights[0], maps, owned.frame, *samples, 1, GetParam());
    ASSERT_EQ(got, look_up(plan.lights[0], maps, owned.frame, *samples, 1, InstructionSet::scalar));
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      ASSERT_GE(got[i], 0.0F);
      ASSERT_LE(got[i], 1.0F);
      between += got[i] > 0 && got[i] < 1 ? 1 : 0;
      const glm::dvec3 point = at(samples->x_ws, samples->y_ws, samples->z_ws, i);
      const glm::dvec3 normal = at(samples->normal_x_ws, samples->normal_y_ws, samples->normal_z_ws, i);
      const Lit lit = truth.at(point, normal, samples->id[i]);
      // A pixel is wider than two texels on the floor far away; the places reach half a pixel.
      const double pixel = 1 / (400 * static_cast<double>(samples->q[i]));
      if (!lit.is_certain || pixel > 0.02) continue;
      ASSERT_EQ(got[i] >= 0.5F, lit.value);
    }
  }
  EXPECT_GT(between, 5);
}

INSTANTIATE_TEST_SUITE_P(Sets, ShadowMapOnEverySet, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::shadow
