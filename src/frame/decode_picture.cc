#include "frame/decode_picture.h"

#include "image/finite_values.h"

namespace laterna::frame {

Result<std::shared_ptr<const Image>> decode_picture(const Picture& picture) {
  std::shared_ptr<const Image> pixels = picture.pixels;
  if (pixels == nullptr) {
    Result<Image> decoded =
        picture.encoded.empty() ? read_image(picture.file) : decode_image(picture.encoded, picture.name);
    if (!decoded) return tl::unexpected(std::move(decoded.error()));
    pixels = std::make_shared<const Image>(std::move(*decoded));
  }
  const std::string name = picture.name.empty() ? picture.file.string() : picture.name;
  if (auto fault = image::find_not_finite(*pixels, name))
    return tl::unexpected(Error(Failure::bad_input, std::move(*fault)));
  return pixels;
}

}  // namespace laterna::frame
