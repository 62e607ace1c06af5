// Small pictures kept in the repository, bit for bit. A change of the picture that is meant is accepted by running this
// program with LATERNA_UPDATE_GOLDEN=1 and looking at what `laterna diff` says of the old file and the new.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "reference/everything.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

// The shapes are made with the C library's sine, whose last bit is not the same on every machine.
Scene everything_on_a_grid() {
  Scene scene = reference::everything();
  const auto snap = [](std::vector<glm::vec3>& vectors) {
    for (glm::vec3& v : vectors) {
      for (int i = 0; i < 3; ++i) v[i] = std::round(v[i] * 2048) / 2048;
    }
  };
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) {
      snap(primitive.positions);
      snap(primitive.normals);
    }
  }
  return scene;
}

struct GoldenCase {
  const char* name;
  ShadingModel model;
  int samples;
};

class Golden : public testing::TestWithParam<GoldenCase> {};

TEST_P(Golden, PictureIsTheKeptOneBitForBit) {
  const GoldenCase& c = GetParam();
  RenderSettings settings;
  settings.width = 72;
  settings.height = 54;
  settings.shading = c.model;
  settings.samples = c.samples;
  const Renderer renderer = reference::make_renderer(everything_on_a_grid());
  LayeredImage picture = reference::render(renderer, reference::everything_view(72, 54), settings);
  const std::string name = std::string(c.name) + ".exr";
  const std::string kept = LATERNA_SOURCE_DIR "/tests/golden/" + name;
  WriteOptions as_floats;
  as_floats.depth = WriteOptions::Depth::single;
  picture.metadata.clear();
  if (std::getenv("LATERNA_UPDATE_GOLDEN") != nullptr) {
    const Result<void> written = write_image(picture, kept, as_floats);
    ASSERT_TRUE(written) << to_string(written.error());
  }
  const Result<LayeredImage> expected = read_layered_image(kept);
  ASSERT_TRUE(expected) << to_string(expected.error());
  ASSERT_EQ(expected->channels.size(), picture.channels.size());
  for (const Channel& channel : picture.channels) {
    const Channel* same = expected->find(channel.name);
    ASSERT_NE(same, nullptr) << channel.name;
    if (channel.values == same->values) continue;
    const std::string drawn = testing::TempDir() + name;
    EXPECT_TRUE(write_image(picture, drawn, as_floats));
    const Comparison comparison = compare_images(picture, *expected, {}).value();
    FAIL() << comparison.difference.pixels_over_fail << " pixels differ, by up to "
           << comparison.difference.max_error << " at " << comparison.difference.max_x << ", "
           << comparison.difference.max_y << ": compare " << drawn << " with " << kept;
  }
}

INSTANTIATE_TEST_SUITE_P(Everything, Golden,
                         testing::Values(GoldenCase{"everything_papers", ShadingModel::papers, 1},
                                         GoldenCase{"everything_phong", ShadingModel::phong, 4},
                                         GoldenCase{"everything_pbr", ShadingModel::pbr, 4}),
                         [](const auto& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace laterna
