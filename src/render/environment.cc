#include "render/environment.h"

#include <fmt/format.h>

#include "base/elementary.h"
#include "frame/decode_picture.h"
#include "image/colour.h"
#include "image/environment_cache.h"

namespace laterna::render {
namespace {

tl::unexpected<Error> fault_of(const Picture& picture, std::string message) {
  const std::string name = picture.name.empty() ? picture.file.string() : picture.name;
  return tl::unexpected(Error(Failure::bad_input, Diagnostic{name, {}, std::move(message)}));
}

// Linear light, 0 … kMaxRadiance. `is_divided`: by alpha, where there is one (RGBD).
std::vector<glm::vec3> linear_texels(const Image& pixels, bool is_divided) {
  // 1/255 is what RGBD's smallest alpha is: a packed 0 is as bright as that.
  constexpr float kLeastAlpha = 1.0F / 255;
  const bool is_srgb = pixels.transfer() == Transfer::srgb;
  const int green = pixels.channels() <= 2 ? 0 : 1, blue = pixels.channels() <= 2 ? 0 : 2;
  const int alpha = pixels.channels() - 1;
  std::vector<glm::vec3> texels;
  texels.reserve(static_cast<std::size_t>(pixels.width()) * static_cast<std::size_t>(pixels.height()));
  const std::array<float, 256>& codes = image::linear_from_srgb8();
  const auto linear = [&](int x, int y, int channel) {
    const float stored = pixels.value(x, y, channel);
    if (!is_srgb) return stored;
    if (pixels.type() == PixelType::u8) return codes[static_cast<std::size_t>(stored * 255 + 0.5F)];
    return static_cast<float>(linear_from_srgb(static_cast<double>(stored)));
  };
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      glm::vec3 texel(linear(x, y, 0), linear(x, y, green), linear(x, y, blue));
      if (is_divided && pixels.has_alpha()) texel /= std::max(pixels.value(x, y, alpha), kLeastAlpha);
      // Sharpened pictures hold some negative light; sums of more than this would not be numbers.
      texels.push_back(glm::clamp(texel, 0.0F, static_cast<float>(kMaxRadiance)));
    }
  }
  return texels;
}

Result<image::EnvironmentMap> from_picture(const Scene& scene, const TaskPool& pool, InstructionSet set,
                                           const std::filesystem::path& folder, const Progress& progress) {
  const Environment& environment = *scene.environment;
  const Picture& picture = scene.pictures[static_cast<std::size_t>(environment.picture)];
  const Result<std::shared_ptr<const Image>> read = frame::decode_picture(picture);
  if (!read) return tl::unexpected(read.error());
  const Image& pixels = **read;
  const std::optional<EnvironmentChart> chart =
      environment.chart ? environment.chart : guess_environment_chart(pixels.width(), pixels.height());
  if (!chart) {
    return fault_of(picture,
                    fmt::format("cannot tell the chart of an environment of {} x {}: name it by the key "
                                "\"chart\" of a rig's \"environment\" (2:1 is taken for latlong, 6:1 for "
                                "cube, 4:3 and 3:4 for crosses)",
                                pixels.width(), pixels.height()));
  }
  if (std::string fault = find_fault(*chart, pixels.width(), pixels.height()); !fault.empty())
    return fault_of(picture, std::move(fault));
  const std::vector<glm::vec3> texels = linear_texels(pixels, false);
  const image::EnvironmentCache cache(folder, kEnvironmentCacheBytes);
  const image::ContentKey key = image::environment_key(*chart, pixels.width(), pixels.height(), texels);
  if (std::optional<image::EnvironmentMap> kept = cache.find(key)) return std::move(*kept);
  const image::EnvironmentPicture source(*chart, pixels.width(), pixels.height(), texels);
  image::EnvironmentMap map = image::make_environment_map(source, pool, set, [&](double fraction) {
    if (progress) progress(fraction);
  });
  cache.keep(key, map);
  return map;
}

// EXT_lights_image_based: the six faces of each level side by side, as OpenGL has them. Its pictures are those faces
// mirrored, which is what one sees from inside.
Result<image::EnvironmentPicture> join_faces(const Scene& scene, const std::array<int, 6>& faces) {
  std::vector<glm::vec3> texels;
  int side = 0;
  for (std::size_t face = 0; face < 6; ++face) {
    const Picture& picture = scene.pictures[static_cast<std::size_t>(faces[face])];
    const Result<std::shared_ptr<const Image>> read = frame::decode_picture(picture);
    if (!read) return tl::unexpected(read.error());
    const Image& pixels = **read;
    if (face == 0) {
      side = pixels.width();
      texels.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 6);
    }
    if (pixels.width() != side || pixels.height() != side) {
      return fault_of(picture, fmt::format("expected a face of {} x {} like the level's first, found {} x {}",
                                           side, side, pixels.width(), pixels.height()));
    }
    const std::vector<glm::vec3> own = linear_texels(pixels, true);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const std::size_t column = face * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
        texels[static_cast<std::size_t>(y) * 6 * static_cast<std::size_t>(side) + column] =
            own[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                static_cast<std::size_t>(side - 1 - x)];
      }
    }
  }
  return image::EnvironmentPicture(EnvironmentChart::cube, 6 * side, side, texels);
}

}  // namespace

Result<image::EnvironmentMap> prepare_environment(const Scene& scene, const TaskPool& pool,
                                                  InstructionSet set, const std::filesystem::path& cache,
                                                  const Progress& progress) {
  const Environment& environment = *scene.environment;
  if (environment.specular_pictures.empty()) return from_picture(scene, pool, set, cache, progress);
  std::vector<image::EnvironmentPicture> levels;
  for (const std::array<int, 6>& faces : environment.specular_pictures) {
    Result<image::EnvironmentPicture> level = join_faces(scene, faces);
    if (!level) return tl::unexpected(std::move(level.error()));
    levels.push_back(std::move(*level));
  }
  return image::make_environment_map(levels, pool);
}

}  // namespace laterna::render
