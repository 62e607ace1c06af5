// Pictures in memory and in files. Row 0 is the top row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/result.h"

namespace laterna {

enum class PixelType : std::uint8_t { u8, u16, f32 };

/// What the numbers of a picture's colour channels mean. Alpha is always linear.
enum class Transfer : std::uint8_t {
  srgb,    ///< IEC 61966-2-1 encoded colour
  linear,  ///< linear light, or data that is no colour
};

/// One picture: interleaved pixels, rows from the top, no padding.
/// Channels: 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA (alpha not premultiplied).
class Image {
 public:
  Image() = default;
  /// Zero-filled. width and height in [1, kMaxImageSide], channels in [1, 4]; anything else makes an empty
  /// picture.
  Image(int width, int height, int channels, PixelType type, Transfer transfer);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int channels() const { return channels_; }
  [[nodiscard]] PixelType type() const { return type_; }
  [[nodiscard]] Transfer transfer() const { return transfer_; }
  void set_transfer(Transfer transfer) { transfer_ = transfer; }
  [[nodiscard]] bool empty() const { return width_ == 0; }
  [[nodiscard]] bool has_alpha() const { return channels_ == 2 || channels_ == 4; }

  /// All values in storage order: ((y * width) + x) * channels + channel. T is std::uint8_t, std::uint16_t or
  /// float; for another than the picture's own type the span is empty.
  template <class T>
  [[nodiscard]] std::span<T> values();
  template <class T>
  [[nodiscard]] std::span<const T> values() const;

  /// One value as a float: u8 and u16 are divided by 255 and 65535; no transfer function is applied.
  [[nodiscard]] float value(int x, int y, int channel) const;

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::span<std::byte> bytes() { return bytes_; }

 private:
  int width_ = 0, height_ = 0, channels_ = 0;
  PixelType type_ = PixelType::u8;
  Transfer transfer_ = Transfer::srgb;
  std::vector<std::byte> bytes_;
};

/// Largest width or height that is read, held or written.
inline constexpr int kMaxImageSide = 65536;
/// Largest number of pixels that is read: 2^30. A file that claims more is refused before memory is taken.
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 30;

/// Decodes PNG (1–16 bit, grey, palette, RGB, with or without alpha, interlaced), JPEG (grey, RGB), GIF (the
/// first frame), BMP (RLE too), TGA, PCX, PNM (P1 … P6), Radiance HDR, OpenEXR (RGB[A] or Y[A] of the first part)
/// or PFM. The kind is told from the bytes; the name decides only for TGA, which has no signature. Transfer:
/// sRGB for 8- and 16-bit files, linear for HDR, EXR and PFM. Palettes become RGB, a transparent colour
/// becomes alpha; colour profiles, gamma and EXIF orientation are not applied. A file that ends before its
/// picture does is an error, as is damage that the format can show. `name` stands in messages.
Result<Image> decode_image(std::span<const std::byte> encoded, std::string_view name);

/// Reads and decodes a file.
Result<Image> read_image(const std::filesystem::path& file);

/// Width, height, channels and type without decoding the pixels.
struct ImageHeader {
  std::string format;  ///< "PNG", "JPEG", …
  int width = 0, height = 0, channels = 0;
  PixelType type = PixelType::u8;
};
Result<ImageHeader> read_image_header(std::span<const std::byte> encoded, std::string_view name);
Result<ImageHeader> read_image_header(const std::filesystem::path& file);

/// A picture of named float channels, as in OpenEXR: "R", "G", "B", "A", "Z", "N.X", "light.sun.R", …
struct Channel {
  std::string name;
  std::vector<float> values;  ///< width * height, rows from the top
};
struct LayeredImage {
  int width = 0, height = 0;
  std::vector<Channel> channels;  ///< linear light; R, G, B or Y multiplied by A where there is an A
  std::map<std::string, std::string> metadata;  ///< settings, names of object ids, …

  [[nodiscard]] const Channel* find(std::string_view name) const;
};

/// What read_layered_image() makes of an 8- or 16-bit file.
enum class ChannelValues : std::uint8_t {
  linear,  ///< linear light, colours multiplied by alpha: what OpenEXR holds
  stored,  ///< the stored codes as 0…1, for comparing files as idiff does
};

/// Reads every channel of a file: EXR as it is (half, float and unsigned integers; on the display window, 0
/// where there is no data; string attributes as metadata); other formats as R, G, B or Y, and A.
Result<LayeredImage> read_layered_image(const std::filesystem::path& file,
                                        ChannelValues values = ChannelValues::linear);

struct WriteOptions {
  /// automatic: 8 bits for PNG; for EXR half for colours and single for data (Z, P, N, uv, id, lux,
  /// visibility).
  enum class Depth { automatic, bits8, bits16, half, single } depth = Depth::automatic;
  float exposure = 1;  ///< factor on R, G, B before encoding; 8- and 16-bit formats only
  int threads = 0;     ///< for encoding; 0: all
};

/// Writes the picture by the ending of `file`: .png (8 or 16 bit, sRGB; R G B [A] or Y [A]), .exr (half or
/// float, all channels, metadata), .hdr (R G B or Y), .pfm (R G B, Y or the only channel). "-" is stdout and
/// takes PNG. PNG colours are divided by alpha. An EXR channel with finite values beyond half's range is
/// written in single precision. The file is written beside its target and renamed into place; on failure
/// nothing is left behind. The bytes do not depend on the number of threads. Errors: bad_usage where the
/// format cannot hold the picture, cannot_write.
Result<void> write_image(const LayeredImage& image, const std::filesystem::path& file,
                         const WriteOptions& = {});
/// The same for pixels. A PNG of the picture's own depth, at exposure 1, holds exactly its values.
Result<void> write_image(const Image& image, const std::filesystem::path& file, const WriteOptions& = {});
/// Whether write_image() could write such a file, to ask before a long render: the ending is known, the folder exists and
/// may be written. Nothing is left behind; an existing file is kept. Errors as write_image()'s.
Result<void> check_image_output(const std::filesystem::path& file);
/// Whether such a file would keep every channel of a LayeredImage (OpenEXR), not only colour and coverage.
[[nodiscard]] bool keeps_layers(const std::filesystem::path& file);

/// How two pictures differ, in idiff's terms, over all channels. The values are compared as they are: in
/// linear light or, for 8- and 16-bit files read with ChannelValues::stored, in stored values. Equal
/// infinities and two NaN do not differ; a NaN and a number differ infinitely.
struct Difference {
  double mean_error = 0, rms_error = 0, max_error = 0;
  double psnr_db = 0;  ///< of the largest value, at least 1, over the RMS error; +infinity when equal
  int max_x = 0, max_y = 0;
  std::string max_channel;
  float max_value_a = 0, max_value_b = 0;
  std::int64_t pixels = 0, pixels_over_warn = 0, pixels_over_fail = 0;
};
struct DifferenceLimits {
  double warn = 1e-6, fail = 1e-6;            ///< per-pixel, largest channel
  double warn_percent = 0, fail_percent = 0;  ///< share of pixels allowed over the limit
  double hard_warn = 1e30, hard_fail = 1e30;  ///< no pixel may differ by more
};
enum class Verdict { pass, warning, failure };
struct Comparison {
  Difference difference;
  Verdict verdict = Verdict::pass;
};
/// Error: sizes or channel names differ.
Result<Comparison> compare_images(const LayeredImage& a, const LayeredImage& b,
                                  const DifferenceLimits& limits);

/// A picture of |a − b| · scale over the shared R, G, B (or first) channels, for the eye.
Result<LayeredImage> difference_picture(const LayeredImage& a, const LayeredImage& b, float scale);

}  // namespace laterna
