// One picture of `laterna render`: drawn as it was asked for, and written as its format wants it.
#pragma once

#include <functional>
#include <string>

#include "laterna/render.h"
#include "render_request.h"

namespace laterna::app {

/// The view at the renderer's time.
using FindView = std::function<Result<View>(const Renderer& renderer)>;

class StillDrawer {
 public:
  StillDrawer(const RenderOptions& options, const RenderRequest& request, int threads)
      : options_(options), request_(request), threads_(threads) {}

  struct Picture {
    LayeredImage image;
    float exposure = 1;
  };

  /// At the renderer's time. The first picture is remarked upon. `output`: where --progressive writes to.
  Result<Picture> draw(Renderer& renderer, const FindView& find_view, const std::string& output,
                       const Progress& progress, RenderStatistics& statistics);

  /// May be called while draw() runs.
  [[nodiscard]] Result<void> write(LayeredImage image, const std::filesystem::path& file,
                                   float exposure) const;

 private:
  Result<LayeredImage> draw_image(Renderer& renderer, const FindView& find_view, const std::string& output,
                                  const Progress& progress, RenderStatistics& statistics) const;
  Result<LayeredImage> draw_light(Renderer& renderer, const View& view, const FindView& find_view,
                                  const std::string& output, const Progress& progress,
                                  RenderStatistics& statistics) const;
  [[nodiscard]] WriteOptions write_options(const std::filesystem::path& file, float exposure) const;

  const RenderOptions& options_;
  const RenderRequest& request_;
  int threads_;
  bool is_first_ = true;
};

}  // namespace laterna::app
