#include "laterna/image_based_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/elementary.h"
#include "base/refuse.h"
#include "image/colour.h"
#include "image/environment_picture.h"
#include "render/environment.h"
#include "render/memory_guard.h"
#include "render/settings_check.h"

namespace laterna {
namespace {

constexpr int kSmallestFace = 32, kLargestFace = 4096;
// Roughness 1 is smooth enough for so few texels; the extension asks for no more levels below.
constexpr int kLastFace = 16;
constexpr std::array<const char*, 6> kFaceNames = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

// What surfaces of a roughness mirror, between two levels of the map as shading finds it.
image::EnvironmentPicture mirrored_at(const image::OctahedralLevels& mirrored, double roughness) {
  const double level = roughness * static_cast<double>(mirrored.levels.size() - 1);
  const auto sharper = static_cast<std::size_t>(level);
  const std::size_t rougher = std::min(sharper + 1, mirrored.levels.size() - 1);
  const auto picture_of = [&](std::size_t number) {
    const int side = mirrored.levels[number].side;
    std::vector<glm::vec3> texels;
    texels.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const std::size_t at = mirrored.index(number, x, y);
        texels.emplace_back(mirrored.r[at], mirrored.g[at], mirrored.b[at]);
      }
    }
    return texels;
  };
  const int side = mirrored.levels[sharper].side;
  std::vector<glm::vec3> texels = picture_of(sharper);
  const auto blend = static_cast<float>(level - static_cast<double>(sharper));
  if (blend > 0) {
    const int other_side = mirrored.levels[rougher].side;
    const image::EnvironmentPicture other(EnvironmentChart::octahedral, other_side, other_side,
                                          picture_of(rougher));
    for (int y = 0, i = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x, ++i) {
        const auto direction =
            direction_from_image(EnvironmentChart::octahedral, {(x + 0.5) / side, (y + 0.5) / side});
        glm::vec3& texel = texels[static_cast<std::size_t>(i)];
        texel += (glm::vec3(other.look_up(*direction)) - texel) * blend;
      }
    }
  }
  return {EnvironmentChart::octahedral, side, side, texels};
}

// Colours divided by alpha (the extension's RGBD): the largest alpha, in steps of 1/255, that keeps every channel within 1.
Image pack_rgbd(const std::vector<glm::vec3>& cube, int face, int side) {
  Image image(side, side, 4, PixelType::u8, Transfer::srgb);
  std::uint8_t* values = image.values<std::uint8_t>().data();
  const auto across = static_cast<std::size_t>(side);
  for (std::size_t y = 0; y < across; ++y) {
    for (std::size_t x = 0; x < across; ++x, values += 4) {
      // The cube has its faces as seen from outside, the extension as seen from inside.
      const std::size_t column = static_cast<std::size_t>(face) * across + (across - 1 - x);
      const glm::vec3 light = glm::clamp(cube[y * 6 * across + column], 0.0F, 255.0F);
      const double most = std::max({light.r, light.g, light.b, 1.0F});
      const double divisor = std::max(std::floor(255 / most), 1.0);
      for (int k = 0; k < 3; ++k) {
        const double packed = std::min(static_cast<double>(light[k]) * divisor / 255, 1.0);
        values[k] = static_cast<std::uint8_t>(srgb_from_linear(packed) * 255 + 0.5);
      }
      values[3] = static_cast<std::uint8_t>(divisor);
    }
  }
  return image;
}

Result<void> filter(Scene& scene, int face_size, const RendererOptions& options) {
  const TaskPool pool(options.threads);
  const Result<image::EnvironmentMap> map =
      render::prepare_environment(scene, pool, options.instruction_set.value_or(best_instruction_set()),
                                  options.environment_cache, options.environment_progress);
  if (!map) return tl::unexpected(map.error());
  Environment& environment = *scene.environment;
  const int levels = std::countr_zero(static_cast<unsigned>(face_size / kLastFace)) + 1;
  for (int level = 0; level < levels; ++level) {
    const int side = face_size >> level;
    const image::EnvironmentPicture mirrored =
        mirrored_at(map->mirrored, static_cast<double>(level) / (levels - 1));
    const std::vector<glm::vec3> cube = image::resample(mirrored, EnvironmentChart::cube, side, pool);
    std::array<int, 6> faces{};
    for (int face = 0; face < 6; ++face) {
      Picture picture;
      picture.name = fmt::format("environment {} {}", level, kFaceNames[static_cast<std::size_t>(face)]);
      picture.pixels = std::make_shared<const Image>(pack_rgbd(cube, face, side));
      faces[static_cast<std::size_t>(face)] = static_cast<int>(scene.pictures.size());
      scene.pictures.push_back(std::move(picture));
    }
    environment.specular_pictures.push_back(faces);
  }
  if (!environment.irradiance) environment.irradiance = map->irradiance;
  environment.picture = -1;
  environment.chart.reset();
  return {};
}

}  // namespace

Result<void> filter_environment(Scene& scene, const ImageBasedLightSettings& settings,
                                const RendererOptions& options) {
  const int size = settings.face_size;
  if (size < kSmallestFace || size > kLargestFace || !std::has_single_bit(static_cast<unsigned>(size))) {
    return refuse(
        fmt::format("the size of an environment's faces must be a power of two, {}, {}, {} ... {}, got {}",
                    kSmallestFace, 2 * kSmallestFace, 4 * kSmallestFace, kLargestFace, size));
  }
  if (Result<void> checked = render::check_options(options); !checked) return checked;
  if (std::vector<Diagnostic> faults = validate(scene); !faults.empty())
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  if (!scene.environment || !scene.environment->specular_pictures.empty()) return {};
  return render::guarded([&] { return filter(scene, size, options); });
}

}  // namespace laterna
