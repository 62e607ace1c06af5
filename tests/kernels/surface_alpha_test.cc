// The alpha of cut-outs: at one point against the definition of its parts, and at N points on every instruction set.
#include "frame/surface_alpha.h"

#include <gtest/gtest.h>

#include <random>

#include "base/aligned_vector.h"
#include "kernels/vector_functions.h"
#include "reference/shapes.h"
#include "reference/texture.h"

namespace laterna::kernels {
namespace {

constexpr int kTrianglesPerMesh = 24;

int add_noise(Scene& scene, int width, int height, int channels, PixelType type, std::mt19937& random) {
  auto image = std::make_shared<Image>(width, height, channels, type, Transfer::srgb);
  for (std::uint8_t& value : image->values<std::uint8_t>()) value = static_cast<std::uint8_t>(random());
  for (float& value : image->values<float>()) value = std::uniform_real_distribution<float>(0, 1)(random);
  Picture picture;
  picture.pixels = std::move(image);
  scene.pictures.push_back(std::move(picture));
  return static_cast<int>(scene.pictures.size()) - 1;
}

Primitive random_mesh(bool has_colors, bool has_uvs, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-1, 1), uv(-1.5F, 2.5F), unit(0.5F, 1);
  Primitive p;
  for (int i = 0; i < 3 * kTrianglesPerMesh; ++i) {
    p.positions.emplace_back(place(random), place(random), place(random));
    if (has_uvs) p.uv[0].emplace_back(uv(random), uv(random));
    if (has_uvs) p.uv[1].emplace_back(uv(random), uv(random));
    if (has_colors) p.colors.emplace_back(unit(random), unit(random), unit(random), unit(random));
  }
  return p;
}

Material& add_mesh(Scene& scene, Primitive primitive, AlphaMode mode) {
  reference::add_object(scene, "mesh", std::move(primitive));
  scene.materials.back().alpha_mode = mode;
  return scene.materials.back();
}

// Surfaces of every kind that alpha can have.
reference::OwnedFrame make_surfaces() {
  std::mt19937 random(11);
  Scene scene;
  const int odd = add_noise(scene, 37, 21, 4, PixelType::u8, random);
  const int even = add_noise(scene, 64, 16, 4, PixelType::f32, random);
  const int solid = add_noise(scene, 8, 8, 3, PixelType::u8, random);
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
    for (const Filter filter : {Filter::linear, Filter::nearest}) {
      Material& m = add_mesh(scene, random_mesh(wrap == Wrap::mirror, true, random), AlphaMode::mask);
      m.base_color_texture.picture = wrap == Wrap::clamp ? even : odd;
      m.base_color_texture.sampler.wrap_u = wrap;
      m.base_color_texture.sampler.wrap_v = filter == Filter::nearest ? Wrap::repeat : wrap;
      m.base_color_texture.sampler.magnify = filter;
      m.base_color_texture.uv_set = filter == Filter::nearest ? 1 : 0;
      m.base_color_texture.uv_from_mesh_uv = {0.8F, 0.3F, 0.1F, -0.4F, 1.2F, 0.7F};
      m.base_color.a = 0.9F;
      m.alpha_cutoff = 0.4F;
    }
  }
  add_mesh(scene, random_mesh(true, true, random), AlphaMode::blend).base_color_texture.picture = odd;
  add_mesh(scene, random_mesh(false, false, random), AlphaMode::mask).base_color_texture.picture = odd;
  add_mesh(scene, random_mesh(true, true, random), AlphaMode::blend).base_color_texture.picture = solid;
  add_mesh(scene, random_mesh(true, false, random), AlphaMode::mask).alpha_cutoff = 0.75F;
  add_mesh(scene, random_mesh(true, true, random), AlphaMode::opaque).base_color_texture.picture = odd;
  return reference::make_frame(std::move(scene));
}

struct Probes {
  AlignedVector<TriangleId> ids;
  AlignedVector<float> b, c;
};

// Points of all triangles, neighbours on different surfaces, with some a hair outside.
Probes random_points(const frame::Frame& frame) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1e-6F, 1);
  Probes p;
  for (int i = 0; i < 16384; ++i) {
    const auto cluster = static_cast<std::uint32_t>(random() % frame.clusters.size());
    p.ids.push_back(cluster << kTriangleBits |
                    static_cast<std::uint32_t>(random() % frame.clusters[cluster].triangle_count));
    const float b = unit(random), c = unit(random);
    p.b.push_back(b + c > 1 ? 1 - b : b);
    p.c.push_back(b + c > 1 ? 1 - c : c);
  }
  return p;
}

const frame::Surface& surface_of(const frame::Frame& frame, TriangleId id) {
  return frame.surfaces[frame.clusters[cluster_of(id)].material];
}

// Interpolates a stream in double.
template <class Value, class Values>
Value interpolate(const frame::Frame& frame, const Values& values, std::uint32_t first, TriangleId id,
                  double b, double c) {
  const std::uint32_t packed = frame.corners[id];
  return Value(values[first + (packed & 255U)]) * (1 - b - c) +
         Value(values[first + (packed >> 8U & 255U)]) * b + Value(values[first + (packed >> 16U & 255U)]) * c;
}

TEST(SurfaceAlpha, IsTheProductOfFactorFullSizeTextureAndVertexAlpha) {
  const reference::OwnedFrame owned = make_surfaces();
  const frame::Frame& frame = owned.frame;
  const Probes p = random_points(frame);
  int compared = 0;
  for (std::size_t i = 0; i < p.ids.size(); ++i) {
    const TriangleId id = p.ids[i];
    const frame::Surface& surface = surface_of(frame, id);
    const frame::ClusterStreams& streams = frame.streams[cluster_of(id)];
    double expected = surface.base_color[3];
    if (streams.color != frame::kNoStream)
      expected *= interpolate<glm::dvec4>(frame, frame.colors, streams.color, id, p.b[i], p.c[i]).a;
    const frame::TextureBinding& binding = surface.base_color_texture;
    if (binding.chain != nullptr) {
      const auto set = static_cast<std::size_t>(binding.uv_set);
      reference::TextureProbe probe;
      if (streams.uv[set] != frame::kNoStream) {
        const auto uv = interpolate<glm::dvec2>(frame, frame.uvs[set], streams.uv[set], id, p.b[i], p.c[i]);
        const std::array<float, 6>& m = binding.uv_from_mesh_uv;
        probe.u = m[0] * uv.x + m[1] * uv.y + m[2];
        probe.v = m[3] * uv.x + m[4] * uv.y + m[5];
      }
      const reference::TextureSample sample = reference::look_up(*binding.chain, binding.sampler, 1, probe);
      if (sample.is_ambiguous) continue;
      expected *= sample.rgba[3];
    }
    ++compared;
    ASSERT_NEAR(frame::alpha_at(frame, id, p.b[i], p.c[i]), expected, 1e-4) << "triangle " << id;
  }
  EXPECT_GT(compared, 15000);
}

class SurfaceAlphaOnEverySet : public testing::TestWithParam<InstructionSet> {};

TEST_P(SurfaceAlphaOnEverySet, HolesAreWhereAlphaAtOnePointIsBelowTheCutoff) {
  const reference::OwnedFrame owned = make_surfaces();
  const Probes p = random_points(owned.frame);
  AlignedVector<float> is_hole(p.ids.size(), -1.0F);
  find_holes_for(GetParam())({&owned.frame, p.ids, p.b, p.c, is_hole});
  std::array<int, 2> seen = {0, 0};
  for (std::size_t i = 0; i < p.ids.size(); ++i) {
    const frame::Surface& surface = surface_of(owned.frame, p.ids[i]);
    const bool expected = surface.alpha_mode == AlphaMode::mask &&
                          frame::alpha_at(owned.frame, p.ids[i], p.b[i], p.c[i]) < surface.alpha_cutoff;
    ASSERT_EQ(is_hole[i], expected ? 1.0F : 0.0F) << "point " << i << " of triangle " << p.ids[i];
    ++seen[expected ? 1 : 0];
  }
  EXPECT_GT(seen[0], 2000);
  EXPECT_GT(seen[1], 2000);
}

INSTANTIATE_TEST_SUITE_P(Sets, SurfaceAlphaOnEverySet, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::kernels
