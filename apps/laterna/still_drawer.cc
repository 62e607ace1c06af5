#include "still_drawer.h"

#include <fmt/format.h>

#include <algorithm>

#include "laterna/measure.h"
#include "render_option_names.h"
#include "render_remarks.h"

namespace laterna::app {

Result<StillDrawer::Picture> StillDrawer::draw(Renderer& renderer, const FindView& find_view,
                                               const std::string& output, const Progress& progress,
                                               RenderStatistics& statistics) {
  Result<LayeredImage> image = draw_image(renderer, find_view, output, progress, statistics);
  if (!image) return tl::unexpected(std::move(image.error()));
  float exposure = request_.exposure;
  if (request_.shows_light()) {
    const bool is_automatic = exposure == 0;
    if (is_automatic) exposure = automatic_exposure(*image);
    if (is_first_ && !keeps_layers(output)) advise_exposure(*image, exposure, is_automatic);
  } else {
    exposure = 1;
  }
  is_first_ = false;
  return Picture{std::move(*image), exposure};
}

Result<LayeredImage> StillDrawer::draw_image(Renderer& renderer, const FindView& find_view,
                                             const std::string& output, const Progress& progress,
                                             RenderStatistics& statistics) const {
  const Result<View> view = find_view(renderer);
  if (!view) return tl::unexpected(view.error());
  if (request_.false_color)
    return draw_false_color(renderer, *view, request_.settings, *request_.false_color, statistics);
  if (!request_.debug) return draw_light(renderer, *view, find_view, output, progress, statistics);
  Result<ExplainedPicture> shown =
      draw_debug_picture(renderer, *view, request_.settings, *request_.debug, statistics);
  if (!shown) return tl::unexpected(std::move(shown.error()));
  for (const std::string& line : shown->legend) fmt::print(stderr, "laterna: {}\n", line);
  return std::move(shown->picture);
}

Result<LayeredImage> StillDrawer::draw_light(Renderer& renderer, const View& view, const FindView& find_view,
                                             const std::string& output, const Progress& progress,
                                             RenderStatistics& statistics) const {
  Result<void> written;
  Preview preview;
  if (options_.progressive) {
    preview = [&](const PartialMean& mean) {
      if ((mean.pictures & (mean.pictures - 1)) != 0) return true;
      mean.write();
      written = write(*mean.image, output,
                      request_.exposure == 0 ? automatic_exposure(*mean.image) : request_.exposure);
      if (written) tell_noise(mean.pictures, mean.noise);
      return written.has_value();
    };
  }
  const Shutter shutter = {request_.shutter, find_view};
  Result<LayeredImage> image =
      request_.shutter > 0
          ? renderer.render_exposed(view, request_.settings, shutter, progress, &statistics, preview)
          : renderer.render(view, request_.settings, progress, &statistics, preview);
  if (!written) return tl::unexpected(written.error());
  if (!image || !is_first_) return image;
  if (request_.settings.accumulate == 1) {
    advise_softness(renderer.scene(), request_.settings.shadows);
  } else {
    tell_noise(statistics.pictures, statistics.noise);
  }
  return image;
}

WriteOptions StillDrawer::write_options(const std::filesystem::path& file, float exposure) const {
  WriteOptions write;
  write.depth = kDepth.at(options_.depth);
  // In half precision the lights' layers would no longer add up to beauty.
  const bool has_light_layers =
      std::ranges::find(request_.settings.layers, Layer::light) != request_.settings.layers.end();
  if (has_light_layers && keeps_layers(file) && options_.depth == "auto")
    write.depth = WriteOptions::Depth::single;
  write.threads = threads_;
  write.exposure = exposure;
  return write;
}

// Formats for the screen hold neither layers nor, unless it was asked for, coverage.
Result<void> StillDrawer::write(LayeredImage image, const std::filesystem::path& file, float exposure) const {
  if (request_.shows_light() && !keeps_layers(file))
    image.channels.resize(options_.background == "transparent" ? 4 : 3);
  return write_image(image, file, write_options(file, exposure));
}

}  // namespace laterna::app
