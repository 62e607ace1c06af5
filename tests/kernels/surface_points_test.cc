// What is found of a surface at a sample, on every instruction set, against a ray met with its triangle in double.
#include "shade/surface_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>

#include "reference/shapes.h"
#include "shade/surface_cut.h"

namespace laterna::shade {
namespace {

using frame::kNoStream;
using frame::Surface;
using shadow::kGroupSize;
using shadow::kMaxGroups;
using shadow::kMaxSamples;
using shadow::SampleArray;

// ---------------------------------------------------------------------------------------------- textures that measure

constexpr int kSide = 256;

// Filled with a function of the level and the texel's centre.
template <class Function>
image::MipChain make_chain(Function function) {
  image::MipChain chain = image::make_mip_chain(Image(kSide, kSide, 4, PixelType::f32, Transfer::linear),
                                                image::MipUse::colour_with_alpha);
  for (int l = 0; l < chain.level_count; ++l) {
    const image::MipLevel& level = chain.levels[static_cast<std::size_t>(l)];
    for (int y = 0; y < level.height; ++y) {
      for (int x = 0; x < level.width; ++x) {
        const glm::vec3 value = function(l, (static_cast<float>(x) + 0.5F) / static_cast<float>(level.width),
                                         (static_cast<float>(y) + 0.5F) / static_cast<float>(level.height));
        const std::size_t i = level.first + static_cast<std::size_t>(y * level.width + x);
        for (int c = 0; c < 3; ++c)
          chain.wide[std::size_t{chain.texel_count} * static_cast<std::size_t>(c) + i] = value[c];
        chain.alpha[i] = static_cast<std::uint8_t>(value.x * 255);
      }
    }
  }
  return chain;
}

// Every level is filled with its own number: a look-up returns the level of detail.
const image::MipChain& level_meter() {
  static const image::MipChain chain =
      make_chain([](int level, float, float) { return glm::vec3(static_cast<float>(level)); });
  return chain;
}

// r = u, g = v, b = 0.5: a look-up returns the coordinates.
const image::MipChain& coordinate_meter() {
  static const image::MipChain chain =
      make_chain([](int, float u, float v) { return glm::vec3(u, v, 0.5F); });
  return chain;
}

// The coordinate u at full size, nothing at all below.
const image::MipChain& full_size_only() {
  static const image::MipChain chain =
      make_chain([](int level, float u, float) { return glm::vec3(level == 0 ? u : 0.0F); });
  return chain;
}

const image::MipChain& tilted_normals() {
  static const image::MipChain chain =
      make_chain([](int, float, float) { return glm::vec3(0.7F, 0.35F, 0.9F); });
  return chain;
}

Sampler without_mips() {
  Sampler sampler;
  sampler.mip = MipFilter::none;
  return sampler;
}

// ---------------------------------------------------------------------------------------------- triangles

// Random triangles with every attribute; the second mesh has neither colours nor tangents.
reference::OwnedFrame random_triangles() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-3, 3), unit(0, 1), uv(0.15F, 0.85F);
  Scene scene;
  for (const bool is_rich : {true, false}) {
    Primitive p;
    for (int i = 0; i < 90; ++i) {
      p.positions.emplace_back(place(random), place(random), place(random));
      p.normals.push_back(glm::normalize(glm::vec3(unit(random) - 0.5F, unit(random) - 0.5F, 1)));
      p.uv[0].emplace_back(uv(random), uv(random));
      p.uv[1].emplace_back(uv(random), uv(random));
      if (!is_rich) continue;
      p.tangents.emplace_back(glm::normalize(glm::vec3(1, unit(random) - 0.5F, unit(random) - 0.5F)),
                              i % 2 == 0 ? 1 : -1);
      p.colors.emplace_back(unit(random), unit(random), unit(random), 0.5F + 0.5F * unit(random));
    }
    // The sign of a triangle's bitangent is one.
    for (std::size_t i = 0; i < p.tangents.size(); ++i) p.tangents[i].w = p.tangents[i - i % 3].w;
    for (std::uint32_t i = 0; i < 90; ++i) p.indices.push_back(i);
    reference::add_object(scene, is_rich ? "rich" : "plain", std::move(p));
  }
  return reference::make_frame(std::move(scene));
}

// A triangle's corners in double, read straight from the frame.
class Triangle {
 public:
  Triangle(const frame::Frame& frame, TriangleId id)
      : frame_(frame), streams_(frame.streams[cluster_of(id)]) {
    const std::uint32_t packed = frame.corners[id];
    for (std::uint32_t i = 0; i < 3; ++i) local_[i] = packed >> (8 * i) & 255U;
    const std::uint32_t first = frame.clusters[cluster_of(id)].first_vertex;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = first + local_[i];
      corner[i] = frame.positions_ws[v];
    }
    normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
  }

  // Sum in double of a stream's values at the corners.
  template <class Sum, class Values>
  [[nodiscard]] Sum read(const Values& values, std::uint32_t stream, const glm::dvec3& weights) const {
    Sum sum(0);
    for (int i = 0; i < 3; ++i) sum += weights[i] * Sum(values[stream + local_[static_cast<std::size_t>(i)]]);
    return sum;
  }
  [[nodiscard]] glm::dvec3 vertex_normal(const glm::dvec3& w) const {
    return read<glm::dvec3>(frame_.normals_ws, streams_.normal, w);
  }
  [[nodiscard]] bool has_normals() const { return streams_.normal != kNoStream; }
  [[nodiscard]] glm::dvec3 tangent(const glm::dvec3& w) const {
    return read<glm::dvec3>(frame_.tangents_ws, streams_.tangent, w);
  }
  [[nodiscard]] bool has_tangents() const { return streams_.tangent != kNoStream; }
  [[nodiscard]] double tangent_sign() const { return frame_.tangents_ws[streams_.tangent + local_[0]].w; }
  [[nodiscard]] glm::dvec2 uv(std::size_t set, const glm::dvec3& w) const {
    return read<glm::dvec2>(frame_.uvs[set], streams_.uv[set], w);
  }
  [[nodiscard]] glm::dvec4 color(const glm::dvec3& w) const {
    if (streams_.color == kNoStream) return glm::dvec4(1);
    return read<glm::dvec4>(frame_.colors, streams_.color, w);
  }

  glm::dvec3 corner[3], normal;

 private:
  const frame::Frame& frame_;
  const frame::ClusterStreams& streams_;
  std::uint32_t local_[3] = {};
};

// Areas of the three sub-triangles over the whole, signed by the normal.
glm::dvec3 barycentrics(const Triangle& t, const glm::dvec3& p) {
  const auto area = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::dot(glm::cross(b - a, c - a), t.normal);
  };
  const double whole = area(t.corner[0], t.corner[1], t.corner[2]);
  return glm::dvec3(area(p, t.corner[1], t.corner[2]), area(t.corner[0], p, t.corner[2]),
                    area(t.corner[0], t.corner[1], p)) /
         whole;
}

// ---------------------------------------------------------------------------------------------- the camera's rays

struct Camera {
  View view;
  raster::RasterView raster;

  explicit Camera(bool is_orthographic) {
    view.pose = Pose::look_at({1, 0.5, 9}, {0, 0, 0}, {0.1, 1, 0}).value();
    view.projection = is_orthographic ? Projection::orthographic(5, 4, 0.1, 20)
                                      : Projection::perspective(Angle::degrees(50), 1.25, 0.1, 100);
    raster = raster::RasterView(view, 500, 400);
  }
  // The pixel of a point, from the raster's origin, by its clip coordinates.
  [[nodiscard]] glm::dvec2 pixel(const glm::dvec3& point_ws) const {
    const glm::dvec4 image = view.image_from_world() * glm::dvec4(point_ws, 1);
    return {image.x / image.w * 500 - raster.origin_x, image.y / image.w * 400 - raster.origin_y};
  }
  // Where the ray of a pixel meets the triangle's plane.
  [[nodiscard]] glm::dvec3 meet(const Triangle& t, const glm::dvec2& pixel) const {
    const glm::dmat4 world_from_image = glm::inverse(view.image_from_world());
    const glm::dvec2 st((pixel.x + raster.origin_x) / 500, (pixel.y + raster.origin_y) / 400);
    const auto unproject = [&](double depth) {
      const glm::dvec4 p = world_from_image * glm::dvec4(st, depth, 1);
      return glm::dvec3(p) / p.w;
    };
    const glm::dvec3 near = unproject(0.1), along = unproject(0.6) - near;
    return near + along * (glm::dot(t.normal, t.corner[0] - near) / glm::dot(t.normal, along));
  }
  [[nodiscard]] double reversed(const glm::dvec3& point_ws) const {
    const glm::dvec3 p = view.pose.position_ws;
    return raster.reversed_from_distance(glm::dot(point_ws - p, view.pose.forward_ws()));
  }
};

struct Samples {
  std::unique_ptr<shadow::SurfaceSamples> samples = std::make_unique<shadow::SurfaceSamples>();
  std::unique_ptr<SurfacePoints> points = std::make_unique<SurfacePoints>();
};

// Samples within triangles that are not seen edge-on. Every other group lies on one triangle.
Samples random_samples(const frame::Frame& frame, const Camera& camera, unsigned seed) {
  Samples s;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.05, 1);
  s.samples->ray = camera.raster.homogeneous_ray();
  s.samples->group_count = kMaxGroups;
  s.samples->active.fill(0xFFFF);
  TriangleId id = 0;
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    for (;;) {
      const bool keeps_triangle = i % kGroupSize != 0 && i / kGroupSize % 2 == 0;
      if (!keeps_triangle) {
        const auto cluster = static_cast<std::uint32_t>(random() % frame.clusters.size());
        id = cluster << kTriangleBits |
             static_cast<std::uint32_t>(random() % frame.clusters[cluster].triangle_count);
      }
      const Triangle t(frame, id);
      const glm::dvec3 weights(unit(random), unit(random), unit(random));
      const glm::dvec3 point = (t.corner[0] * weights.x + t.corner[1] * weights.y + t.corner[2] * weights.z) /
                               (weights.x + weights.y + weights.z);
      const glm::dvec3 to_eye = glm::normalize(camera.view.pose.position_ws - point);
      const double area = glm::length(glm::cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]));
      const glm::dvec3 axis = camera.raster.is_orthographic ? camera.raster.axis_ws : to_eye;
      if (std::abs(glm::dot(axis, t.normal)) < 0.15 || area < 1) {
        if (keeps_triangle && i % kGroupSize != 0) i -= i % kGroupSize;
        continue;
      }
      const glm::dvec2 pixel = camera.pixel(point);
      s.samples->x[i] = static_cast<float>(pixel.x);
      s.samples->y[i] = static_cast<float>(pixel.y);
      s.samples->q[i] =
          static_cast<float>(camera.reversed(camera.meet(t, {s.samples->x[i], s.samples->y[i]})));
      s.samples->id[i] = id;
      break;
    }
  }
  return s;
}

glm::dvec3 at(const SampleArray<float>& x, const SampleArray<float>& y, const SampleArray<float>& z,
              std::size_t i) {
  return {x[i], y[i], z[i]};
}

// Weights as a function of the pixel: on the surface, or linear on the screen.
class WeightsOnScreen {
 public:
  WeightsOnScreen(const Camera& camera, const Triangle& triangle, Interpolation interpolation)
      : camera_(camera), triangle_(triangle), is_affine_(interpolation == Interpolation::affine) {}
  glm::dvec3 operator()(const glm::dvec2& p) const {
    if (!is_affine_) return barycentrics(triangle_, camera_.meet(triangle_, p));
    const glm::dvec2 a = camera_.pixel(triangle_.corner[0]), b = camera_.pixel(triangle_.corner[1]),
                     c = camera_.pixel(triangle_.corner[2]);
    const auto area = [](const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; };
    const double whole = area(b - a, c - a);
    return {area(b - p, c - p) / whole, area(c - p, a - p) / whole, area(a - p, b - p) / whole};
  }

 private:
  const Camera& camera_;
  const Triangle& triangle_;
  bool is_affine_;
};

class SurfacePointsOnEverySet : public testing::TestWithParam<InstructionSet> {};

Surface measuring_surface() {
  Surface surface;
  surface.base_color = {0.5F, 1, 2, 1};
  surface.base_color_texture = {&level_meter(), {}, 0, {1, 0, 0, 0, 1, 0}};
  // KHR_texture_transform: turned, scaled and moved, within the picture.
  surface.emissive = {1, 1, 1};
  surface.emissive_texture = {&coordinate_meter(), without_mips(), 1, {0.3F, -0.4F, 0.5F, 0.4F, 0.3F, 0.1F}};
  surface.metallic = 0.8F;
  surface.roughness = 0.9F;
  surface.metallic_roughness_texture = {&coordinate_meter(), without_mips(), 0, {1, 0, 0, 0, 1, 0}};
  surface.occlusion_strength = 0.7F;
  surface.occlusion_texture = surface.metallic_roughness_texture;
  return surface;
}

TEST_P(SurfacePointsOnEverySet, PositionsNormalsAndTexturesAreThoseOfTheRaysMeetingPoint) {
  const reference::OwnedFrame owned = random_triangles();
  for (const bool is_orthographic : {false, true}) {
    for (const Interpolation interpolation : {Interpolation::perspective, Interpolation::affine}) {
      const Camera camera(is_orthographic);
      Samples s = random_samples(owned.frame, camera, is_orthographic ? 5 : 6);
      const Surface surface = measuring_surface();
      const PointSource source = {&owned.frame, &camera.raster, interpolation, 1};
      find_surface_points_for(GetParam())(source, surface, *s.samples, *s.points);
      const SurfacePoints& p = *s.points;
      for (std::size_t i = 0; i < kMaxSamples; ++i) {
        const Triangle t(owned.frame, s.samples->id[i]);
        const glm::dvec2 pixel(s.samples->x[i], s.samples->y[i]);
        const glm::dvec3 point = camera.meet(t, pixel);
        SCOPED_TRACE(testing::Message() << "sample " << i << (is_orthographic ? " orthographic" : "")
                                        << " affine " << (interpolation == Interpolation::affine));
        ASSERT_LT(glm::length(at(s.samples->x_ws, s.samples->y_ws, s.samples->z_ws, i) - point), 2e-5);
        const glm::dvec3 to_eye =
            is_orthographic ? camera.raster.axis_ws : glm::normalize(camera.view.pose.position_ws - point);
        ASSERT_LT(glm::length(at(p.to_eye_x_ws, p.to_eye_y_ws, p.to_eye_z_ws, i) - to_eye), 2e-6);
        const double side = glm::dot(t.normal, to_eye) < 0 ? -1 : 1;
        ASSERT_LT(glm::length(at(s.samples->normal_x_ws, s.samples->normal_y_ws, s.samples->normal_z_ws, i) -
                              side * t.normal),
                  2e-6);

        constexpr double kStep = 1e-3;
        const auto q_at = [&](double dx, double dy) {
          return camera.reversed(camera.meet(t, pixel + glm::dvec2(dx, dy)));
        };
        const double q_slope = 1e-4 * std::abs(s.samples->q[i]) / 400 + 1e-8;
        ASSERT_NEAR(s.samples->dq_dx[i], (q_at(kStep, 0) - q_at(-kStep, 0)) / (2 * kStep), q_slope);
        ASSERT_NEAR(s.samples->dq_dy[i], (q_at(0, kStep) - q_at(0, -kStep)) / (2 * kStep), q_slope);

        const WeightsOnScreen weights(camera, t, interpolation);
        const glm::dvec3 w = weights(pixel);
        // Weights are good to about 1e-5: a triangle's smallest height is a few tenths of a metre.
        const glm::dvec3 smooth = t.has_normals() ? glm::normalize(t.vertex_normal(w)) : t.normal;
        ASSERT_LT(glm::length(at(p.normal_x_ws, p.normal_y_ws, p.normal_z_ws, i) - smooth), 1e-4);

        const glm::dvec2 uv0 = t.uv(0, w), mesh_uv1 = t.uv(1, w);
        const glm::dvec2 uv1(0.3 * mesh_uv1.x - 0.4 * mesh_uv1.y + 0.5,
                             0.4 * mesh_uv1.x + 0.3 * mesh_uv1.y + 0.1);
        ASSERT_NEAR(p.emissive_r[i], uv1.x, 1e-4);
        ASSERT_NEAR(p.emissive_g[i], uv1.y, 1e-4);
        ASSERT_NEAR(p.emissive_b[i], 0.5, 1e-6);
        ASSERT_NEAR(p.roughness[i], 0.9 * uv0.y, 1e-4);
        ASSERT_NEAR(p.metallic[i], 0.8 * 0.5, 1e-6);
        ASSERT_NEAR(p.occlusion[i], 1 + 0.7 * (uv0.x - 1), 1e-4);

        // The level of detail from neighbouring pixels' coordinates.
        const auto uv_slope = [&](const glm::dvec2& step) {
          return (t.uv(0, weights(pixel + step)) - t.uv(0, weights(pixel - step))) / (2 * kStep);
        };
        const double texels =
            kSide * std::max(glm::length(uv_slope({kStep, 0})), glm::length(uv_slope({0, kStep})));
        const double level = std::clamp(std::log2(texels), 0.0, 8.0);
        const glm::dvec4 color = t.color(w);
        ASSERT_NEAR(p.base_r[i], 0.5 * level * color.r, 2e-3);
        ASSERT_NEAR(p.base_g[i], level * color.g, 2e-3);
        ASSERT_NEAR(p.base_b[i], 2 * level * color.b, 4e-3);
        ASSERT_EQ(p.alpha[i], 1.0F);
      }
    }
  }
}

// glTF 2.0, 3.9.3, and the mikktspace frame: bitangent = cross(normal, tangent) · w.
TEST_P(SurfacePointsOnEverySet, NormalMapsTurnTheNormalInItsTangentFrame) {
  const reference::OwnedFrame owned = random_triangles();
  const Camera camera(false);
  for (const float scale : {1.0F, 0.5F, -2.0F, 0.0F}) {
    for (const bool is_double_sided : {false, true}) {
      Samples s = random_samples(owned.frame, camera, 8);
      Surface surface;
      surface.normal_texture = {&tilted_normals(), {}, 0, {1, 0, 0, 0, 1, 0}};
      surface.normal_scale = scale;
      surface.double_sided = is_double_sided;
      const PointSource source = {&owned.frame, &camera.raster, Interpolation::perspective, 8};
      find_surface_points_for(GetParam())(source, surface, *s.samples, *s.points);
      int backs = 0;
      for (std::size_t i = 0; i < kMaxSamples; ++i) {
        const Triangle t(owned.frame, s.samples->id[i]);
        const glm::dvec3 point = camera.meet(t, {s.samples->x[i], s.samples->y[i]});
        const glm::dvec3 w = barycentrics(t, point);
        glm::dvec3 expected = t.has_normals() ? glm::normalize(t.vertex_normal(w)) : t.normal;
        if (t.has_tangents()) {
          const glm::dvec3 tangent = t.tangent(w),
                           bitangent = glm::cross(expected, tangent) * t.tangent_sign();
          const glm::dvec3 local((0.7 * 2 - 1) * scale, (0.35 * 2 - 1) * scale, 0.9 * 2 - 1);
          expected = glm::normalize(tangent * local.x + bitangent * local.y + expected * local.z);
        }
        const bool shows_back = glm::dot(t.normal, camera.view.pose.position_ws - point) < 0;
        backs += shows_back ? 1 : 0;
        if (is_double_sided && shows_back) expected = -expected;
        const SurfacePoints& p = *s.points;
        ASSERT_LT(glm::length(at(p.normal_x_ws, p.normal_y_ws, p.normal_z_ws, i) - expected), 2e-4) << i;
      }
      EXPECT_GT(backs, 20);
      EXPECT_LT(backs, static_cast<int>(kMaxSamples) - 20);
    }
  }
}

TEST_P(SurfacePointsOnEverySet, AlphaIsTheProductOfFactorVertexAndTexture) {
  const reference::OwnedFrame owned = random_triangles();
  const Camera camera(false);
  Samples s = random_samples(owned.frame, camera, 9);
  Surface surface;
  surface.base_color[3] = 0.8F;
  surface.base_color_texture = {&coordinate_meter(), without_mips(), 0, {1, 0, 0, 0, 1, 0}};
  const PointSource source = {&owned.frame, &camera.raster, Interpolation::perspective, 1};
  for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend}) {
    surface.alpha_mode = mode;
    find_surface_points_for(GetParam())(source, surface, *s.samples, *s.points);
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      const Triangle t(owned.frame, s.samples->id[i]);
      const glm::dvec3 w = barycentrics(t, camera.meet(t, {s.samples->x[i], s.samples->y[i]}));
      // The texture's alpha is its r = u in eight bits, cut off.
      const double expected = mode == AlphaMode::blend ? 0.8 * t.color(w).a * (t.uv(0, w).x - 0.5 / 255) : 1;
      ASSERT_NEAR(s.points->alpha[i], expected, mode == AlphaMode::blend ? 0.8 / 255 : 0) << i;
    }
  }
}

std::uint32_t kept_of(const SurfaceCut& cut, TriangleId id, raster::CutSamples samples) {
  std::uint16_t kept = 0;
  cut.keep(id, samples, &kept);
  return kept;
}

TEST_P(SurfacePointsOnEverySet, CutOutsKeepTheSamplesThatReachTheCutoff) {
  reference::OwnedFrame owned = random_triangles();
  for (const bool is_orthographic : {false, true}) {
    const Camera camera(is_orthographic);
    const Samples s = random_samples(owned.frame, camera, 10);
    Surface surface;
    surface.alpha_mode = AlphaMode::mask;
    surface.base_color_texture = {&full_size_only(), {}, 0, {1, 0, 0, 0, 1, 0}};
    surface.alpha_cutoff = 0.4F;
    std::fill(owned.frame.surfaces.begin(), owned.frame.surfaces.end(), surface);
    const PointSource source = {&owned.frame, &camera.raster, Interpolation::perspective, 1};
    const SurfaceCut full_size(source, true, GetParam()), in_view(source, false, GetParam());
    int kept_count = 0, asked = 0, minified = 0;
    for (std::size_t n = 0; n < kMaxSamples; ++n) {
      const TriangleId id = s.samples->id[n];
      const Triangle t(owned.frame, id);
      const glm::dvec2 first(s.samples->x[n], s.samples->y[n]);
      raster::CutSamples block;
      block.count = 16;
      for (std::size_t i = 0; i < 16; ++i) {
        block.x[i] = s.samples->x[n] + static_cast<float>(i % 4);
        block.y[i] = s.samples->y[n] + static_cast<float>(i / 4);
        block.reversed_depth[i] =
            static_cast<float>(camera.reversed(camera.meet(t, first + glm::dvec2(i % 4, i / 4))));
      }
      const std::uint32_t kept = kept_of(full_size, id, block);
      ASSERT_EQ(kept, kept_of(SurfaceCut(source, true, InstructionSet::scalar), id, block));
      for (std::size_t i = 0; i < 16; ++i) {
        const glm::dvec3 w = barycentrics(t, camera.meet(t, first + glm::dvec2(i % 4, i / 4)));
        if (std::min({w.x, w.y, w.z}) < 0) continue;
        const double alpha = t.color(w).a * (t.uv(0, w).x - 0.5 / 255);
        if (std::abs(alpha - 0.4) < 1.0 / 255) continue;
        ASSERT_EQ(kept >> i & 1U, alpha >= 0.4 ? 1U : 0U)
            << "block " << n << " sample " << i << " alpha " << alpha;
        kept_count += alpha >= 0.4 ? 1 : 0;
        ++asked;
      }
      // By the view's own size the texture is a mip level down, and empty.
      const WeightsOnScreen weights(camera, t, Interpolation::perspective);
      const double texels =
          kSide * glm::length(t.uv(0, weights(first + glm::dvec2(1, 0))) - t.uv(0, weights(first)));
      if (texels < 2.5) continue;
      ASSERT_EQ(kept_of(in_view, id, block) & 1U, 0U) << "block " << n;
      ++minified;
    }
    EXPECT_GT(kept_count, asked / 4);
    EXPECT_LT(kept_count, asked * 3 / 4);
    EXPECT_GT(minified, 5);
  }
}

TEST_P(SurfacePointsOnEverySet, CutsManySamplesAsItCutsFew) {
  reference::OwnedFrame owned = random_triangles();
  const Camera camera(false);
  const Samples s = random_samples(owned.frame, camera, 12);
  Surface surface;
  surface.alpha_mode = AlphaMode::mask;
  surface.base_color_texture = {&coordinate_meter(), {}, 0, {1, 0, 0, 0, 1, 0}};
  surface.alpha_cutoff = 0.4F;
  std::fill(owned.frame.surfaces.begin(), owned.frame.surfaces.end(), surface);
  const PointSource source = {&owned.frame, &camera.raster, Interpolation::perspective, 1};
  const SurfaceCut cut(source, true, GetParam());
  // Every other group of samples lies on one triangle.
  for (std::size_t first = 0; first < kMaxSamples; first += 2 * kGroupSize) {
    raster::CutSamples many;
    many.count = 3 * kGroupSize + 5;
    for (std::size_t i = 0; i < many.groups() * kGroupSize; ++i) {
      const std::size_t from = first + (i < many.count ? i * 7 % kGroupSize : 0);
      many.x[i] = s.samples->x[from];
      many.y[i] = s.samples->y[from];
      many.reversed_depth[i] = s.samples->q[from];
    }
    std::uint16_t kept[4] = {};
    cut.keep(s.samples->id[first], many, kept);
    for (std::size_t i = 0; i < many.count; ++i) {
      raster::CutSamples one;
      one.count = 1;
      one.x.fill(s.samples->x[first + i * 7 % kGroupSize]);
      one.y.fill(s.samples->y[first + i * 7 % kGroupSize]);
      one.reversed_depth.fill(s.samples->q[first + i * 7 % kGroupSize]);
      ASSERT_EQ(kept[i / 16] >> (i % 16) & 1U, kept_of(cut, s.samples->id[first], one) & 1U) << i;
    }
  }
}

TEST_P(SurfacePointsOnEverySet, GivesTheSameBitsAsScalar) {
  const reference::OwnedFrame owned = random_triangles();
  for (const bool is_orthographic : {false, true}) {
    for (const Interpolation interpolation : {Interpolation::perspective, Interpolation::affine}) {
      const Camera camera(is_orthographic);
      Samples got = random_samples(owned.frame, camera, 11),
              expected = random_samples(owned.frame, camera, 11);
      Surface surface = measuring_surface();
      surface.normal_texture = {&tilted_normals(), {}, 0, {1, 0, 0, 0, 1, 0}};
      surface.alpha_mode = AlphaMode::blend;
      const PointSource source = {&owned.frame, &camera.raster, interpolation, 8};
      find_surface_points_for(GetParam())(source, surface, *got.samples, *got.points);
      find_surface_points_for(InstructionSet::scalar)(source, surface, *expected.samples, *expected.points);
      EXPECT_EQ(std::memcmp(got.points.get(), expected.points.get(), sizeof(SurfacePoints)), 0);
      for (const auto values : {&shadow::SurfaceSamples::x_ws, &shadow::SurfaceSamples::y_ws,
                                &shadow::SurfaceSamples::z_ws, &shadow::SurfaceSamples::normal_x_ws,
                                &shadow::SurfaceSamples::normal_y_ws, &shadow::SurfaceSamples::normal_z_ws,
                                &shadow::SurfaceSamples::dq_dx, &shadow::SurfaceSamples::dq_dy}) {
        EXPECT_EQ((*got.samples).*values, (*expected.samples).*values);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, SurfacePointsOnEverySet, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::shade
