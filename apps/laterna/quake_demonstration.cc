#include "quake_demonstration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "laterna/quake_surfaces.h"

namespace laterna::app {
namespace {

constexpr int kSteps = 128;
constexpr double kMetresToTheSide = 1;

constexpr std::array<std::pair<QuakePicture, const char*>, 3> kPictures = {{
    {QuakePicture::texture, "texture"},
    {QuakePicture::light_map, "light"},
    {QuakePicture::product, ""},
}};

// room.png, room.light.png
std::filesystem::path named(const std::string& file, std::string_view what) {
  std::filesystem::path path(file);
  if (what.empty()) return path;
  return path.replace_extension(fmt::format("{}{}", what, path.extension().string()));
}

Result<View> first_view(const Scene& baked, const QuakeSettings& settings) {
  const Result<Renderer> renderer = Renderer::create(baked);
  if (!renderer) return tl::unexpected(renderer.error());
  if (Result<View> view = renderer->camera_view({}, settings.width, settings.height)) return view;
  return renderer->overview(settings.width, settings.height);
}

}  // namespace

Result<void> check_quake_output(const std::string& file) { return check_image_output(file); }

Result<void> demonstrate_quake(const Scene& baked, const std::string& file) {
  const QuakeSettings settings;
  Result<QuakeWalk> walk = QuakeWalk::create(baked, settings);
  if (!walk) return tl::unexpected(std::move(walk.error()));
  const Result<View> view = first_view(baked, settings);
  if (!view) return tl::unexpected(view.error());
  for (const auto& [picture, name] : kPictures) {
    if (Result<void> written = write_image(walk->draw(*view, picture), named(file, name)); !written)
      return written;
  }
  for (int i = 1; i < kSteps; ++i) {
    const double there = 1 - std::abs(2.0 * i / kSteps - 1);
    View moved = *view;
    moved.pose.position_ws += view->pose.right_ws() * (there * kMetresToTheSide);
    walk->draw(moved);
  }
  const QuakeStatistics& s = walk->statistics();
  fmt::print(
      "Quake's way: {} pictures of {} x {} asked for {} surfaces, {:.2f} % of them in the cache; at most "
      "{:.2f} MB "
      "of {:.0f} MB, {} dropped\n",
      s.pictures, settings.width, settings.height, s.asked, 100 * s.hit_rate(),
      static_cast<double>(s.most_bytes) / 1e6, static_cast<double>(settings.cache_bytes) / 1e6, s.dropped);
  return {};
}

}  // namespace laterna::app
