// GIF87a and GIF89a as a stream of frames. What a still and a film make of them: gif_decode.cc, gif_film.cc.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image/byte_reader.h"
#include "image/decoder.h"

namespace laterna::image {

using GifColour = std::array<std::uint8_t, 3>;
using GifPalette = std::vector<GifColour>;

struct GifCanvas {
  std::size_t width = 0, height = 0;
  GifPalette palette;
};

/// What becomes of a frame's pixels when the next frame is drawn.
enum class GifDisposal : std::uint8_t { keep, clear, restore };

struct GifFrame {
  std::string name;  ///< for messages: "the first frame", "frame 12"
  std::size_t left = 0, top = 0, width = 0, height = 0;
  bool is_interlaced = false;
  std::optional<unsigned> transparent;
  unsigned delay = 0;  ///< hundredths of a second, as stored
  GifDisposal disposal = GifDisposal::keep;
  GifPalette palette;
};

/// The first bytes, signature included.
GifCanvas read_gif_canvas(ByteReader& in);

/// The blocks up to the next frame's compressed pixels. Nothing: the file says that it ends here. `number`: of the frame,
/// from 0. Errors are located.
Result<std::optional<GifFrame>> read_gif_frame(const EncodedPicture& encoded, const GifCanvas& canvas,
                                               std::size_t number, ByteReader& in);

/// Passes by the compressed pixels of a frame.
void skip_gif_pixels(ByteReader& in);

/// Decodes the pixels that `in` stands at and lays them over the canvas: RGBA of canvas.width × canvas.height. Transparent
/// pixels leave what is there. Errors are located.
Result<void> draw_gif_frame(const EncodedPicture& encoded, const GifCanvas& canvas, const GifFrame& frame,
                            ByteReader& in, std::span<std::uint8_t> rgba);

}  // namespace laterna::image
