// Every format's pixels, from files small enough to be read by eye.
#include <gtest/gtest.h>

#include "unit/image_bytes.h"

namespace laterna {
namespace {

using namespace laterna::testing;

const std::vector<int> kRedGreenBlueWhite = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

void expect_header(const Bytes& file, std::string_view name, const ImageHeader& expected,
                   const Image& image) {
  const Result<ImageHeader> header = read_image_header(file, name);
  ASSERT_TRUE(header) << to_string(header.error());
  EXPECT_EQ(header->format, expected.format);
  EXPECT_EQ(header->width, expected.width);
  EXPECT_EQ(header->height, expected.height);
  EXPECT_EQ(header->channels, expected.channels);
  EXPECT_EQ(header->type, expected.type);
  EXPECT_EQ(image.width(), expected.width);
  EXPECT_EQ(image.height(), expected.height);
  EXPECT_EQ(image.channels(), expected.channels);
  EXPECT_EQ(image.type(), expected.type);
}

TEST(ImageDecode, TellsFormatAndSizeWithoutThePixels) {
  const auto check = [](const Bytes& file, const ImageHeader& expected) {
    expect_header(file, "picture.tga", expected, decoded(file, "picture.tga"));
  };
  check(small_png(), {"PNG", 2, 2, 3, PixelType::u8});
  check(small_jpeg(), {"JPEG", 8, 8, 1, PixelType::u8});
  check(small_colour_jpeg(), {"JPEG", 16, 8, 3, PixelType::u8});
  check(small_gif(), {"GIF", 2, 2, 4, PixelType::u8});
  check(small_bmp(), {"BMP", 2, 2, 3, PixelType::u8});
  check(small_tga(), {"TGA", 2, 2, 3, PixelType::u8});
  check(bytes("P5 3 1 255\nabc"), {"PNM", 3, 1, 1, PixelType::u8});
  check(bytes("P2 1 1 256\n7"), {"PNM", 1, 1, 1, PixelType::u16});
  check(small_pfm(), {"PFM", 2, 1, 3, PixelType::f32});
  check(small_hdr(), {"Radiance HDR", 2, 1, 3, PixelType::f32});
}

TEST(ImageDecode, EightAndSixteenBitFilesAreSrgbAndFloatFilesLinear) {
  EXPECT_EQ(decoded(small_png()).transfer(), Transfer::srgb);
  EXPECT_EQ(decoded(bytes("P2 1 1 65535\n7")).transfer(), Transfer::srgb);
  EXPECT_EQ(decoded(small_hdr()).transfer(), Transfer::linear);
  EXPECT_EQ(decoded(small_pfm()).transfer(), Transfer::linear);
}

TEST(PngDecode, ColourTypes) {
  EXPECT_EQ(values_u8(decoded(small_png())), kRedGreenBlueWhite);
  EXPECT_EQ(values_u8(decoded(png(2, 1, 8, 0, bytes({0, 7, 9})))), (std::vector{7, 9}));
  EXPECT_EQ(values_u8(decoded(png(1, 1, 8, 4, bytes({0, 7, 9})))), (std::vector{7, 9}));
  EXPECT_EQ(values_u8(decoded(png(1, 1, 8, 6, bytes({0, 1, 2, 3, 4})))), (std::vector{1, 2, 3, 4}));
}

TEST(PngDecode, FewBitsBecomeEight) {
  EXPECT_EQ(values_u8(decoded(png(4, 1, 1, 0, bytes({0, 0b1010'0000})))), (std::vector{255, 0, 255, 0}));
  EXPECT_EQ(values_u8(decoded(png(4, 1, 2, 0, bytes({0, 0b00'01'10'11})))), (std::vector{0, 85, 170, 255}));
  EXPECT_EQ(values_u8(decoded(png(2, 1, 4, 0, bytes({0, 0x3F})))), (std::vector{51, 255}));
}

TEST(PngDecode, SixteenBitsStaySixteen) {
  const Image image = decoded(png(1, 1, 16, 2, bytes({0, 0x12, 0x34, 0x00, 0x01, 0xFF, 0xFE})));
  EXPECT_EQ(image.type(), PixelType::u16);
  EXPECT_EQ(values_u16(image), (std::vector{0x1234, 1, 0xFFFE}));
  EXPECT_FLOAT_EQ(image.value(0, 0, 1), 1 / 65535.0F);
}

TEST(PngDecode, PalettesBecomeColoursAndTransparencyBecomesAlpha) {
  const Bytes palette = png_chunk("PLTE", bytes({10, 20, 30, 40, 50, 60}));
  EXPECT_EQ(values_u8(decoded(png(2, 1, 8, 3, bytes({0, 1, 0}), palette))),
            (std::vector{40, 50, 60, 10, 20, 30}));
  const Bytes transparency = png_chunk("tRNS", bytes({99}));
  EXPECT_EQ(values_u8(decoded(png(2, 1, 1, 3, bytes({0, 0b0100'0000}), palette + transparency))),
            (std::vector{10, 20, 30, 99, 40, 50, 60, 255}));
  EXPECT_EQ(values_u8(decoded(png(2, 1, 8, 0, bytes({0, 5, 6}), png_chunk("tRNS", bytes({0, 6}))))),
            (std::vector{5, 255, 6, 0}));
}

TEST(PngDecode, InterlacedRowsComeInOrder) {
  // Adam7 of 2 × 2: the first pixel, then the one right of it, then the second row.
  const Bytes passes = bytes({0, 10, 0, 20, 0, 30, 40});
  EXPECT_EQ(values_u8(decoded(png(2, 2, 8, 0, passes, {}, 1))), (std::vector{10, 20, 30, 40}));
}

TEST(PngDecode, GammaProfilesAndTextsAreNotLookedAt) {
  const Bytes extra =
      png_chunk("gAMA", u32_be(100000)) + png_chunk("iCCP", bytes("damaged")) + png_chunk("tEXt", {});
  EXPECT_EQ(values_u8(decoded(png(1, 1, 8, 0, bytes({0, 7}), extra))), (std::vector{7}));
}

TEST(JpegDecode, GreyStaysOneChannel) { EXPECT_EQ(values_u8(decoded(small_jpeg())), std::vector(64, 77)); }

TEST(JpegDecode, Colour) {
  const Image image = decoded(small_colour_jpeg());
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const std::vector<int> expected = x < 8 ? std::vector{199, 40, 60} : std::vector{10, 200, 250};
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(image.value(x, y, c) * 255, static_cast<float>(expected[static_cast<std::size_t>(c)]));
    }
  }
}

TEST(JpegDecode, BytesBetweenSegmentsDoNoHarm) {
  const Bytes file = small_jpeg();
  const auto end = file.end() - 2;
  EXPECT_EQ(values_u8(decoded(Bytes(file.begin(), end) + bytes({1, 2, 3, 0xFF, 0xD9}))), std::vector(64, 77));
}

TEST(GifDecode, FirstFrameAsRgba) {
  const std::vector expected = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
  EXPECT_EQ(values_u8(decoded(small_gif())), expected);
}

TEST(GifDecode, TransparentColourAndFreeCanvasAreTransparent) {
  const Bytes transparent_green = bytes({0x21, 0xF9, 4, 1, 0, 0, 1, 0});
  const Bytes comment = bytes({0x21, 0xFE, 2, 'h', 'i', 0});
  const Bytes file = gif(3, 1, 1, 0, 2, 1, 0, gif_codes({1, 2}), comment + transparent_green);
  EXPECT_EQ(values_u8(decoded(file)), (std::vector{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255}));
}

TEST(GifDecode, InterlacedRowsComeInOrder) {
  // Rows 0, 4, 2, 1, 3 of five.
  const Image image = decoded(gif(1, 5, 0, 0, 1, 5, 0x40, gif_codes({0, 1, 2, 3, 0})));
  const std::vector<int> values = values_u8(image);
  std::vector<std::vector<int>> rows;
  for (std::size_t y = 0; y < 5; ++y) rows.push_back({values[y * 4], values[y * 4 + 1], values[y * 4 + 2]});
  const std::vector<int> red = {255, 0, 0}, green = {0, 255, 0}, blue = {0, 0, 255}, white = {255, 255, 255};
  EXPECT_EQ(rows, (std::vector{red, white, blue, red, green}));
}

TEST(GifDecode, RepeatedStringsAndGrowingCodes) {
  // Codes 4 (clear), 0, 6 (0 0), 7 (0 0 0), 8 (0 0 0 0), 5 (end); code 7, once in the table, makes the
  // width 4. Ten pixels.
  std::uint32_t bits = 0;
  unsigned at = 0;
  const auto add = [&](unsigned code, unsigned width) {
    bits |= code << at;
    at += width;
  };
  add(4, 3), add(0, 3), add(6, 3), add(7, 3), add(8, 4), add(5, 4);
  const Bytes packed = u32_le(bits);
  const Bytes codes = bytes({2, 3}) + Bytes(packed.begin(), packed.begin() + 3) + bytes({0});
  const std::vector<int> values = values_u8(decoded(gif(10, 1, 0, 0, 10, 1, 0, codes)));
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(values[i * 4], 255) << i;
}

TEST(BmpDecode, TwentyFourBitsFromTheBottomOrTheTop) {
  EXPECT_EQ(values_u8(decoded(small_bmp())), kRedGreenBlueWhite);
  const Bytes top_down =
      bmp(2, -2, 24, 0, {}, bytes({0, 0, 255, 0, 255, 0, 0, 0, 255, 0, 0, 255, 255, 255, 0, 0}));
  EXPECT_EQ(values_u8(decoded(top_down)), kRedGreenBlueWhite);
}

TEST(BmpDecode, Palettes) {
  const Bytes palette = bytes({1, 2, 3, 0, 4, 5, 6, 0});  // blue, green, red, unused
  EXPECT_EQ(values_u8(decoded(bmp(2, 1, 8, 0, palette, bytes({1, 0, 0, 0}), 2))),
            (std::vector{6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(values_u8(decoded(bmp(2, 1, 4, 0, palette, bytes({0x10, 0, 0, 0}), 2))),
            (std::vector{6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(values_u8(decoded(bmp(2, 1, 1, 0, palette, bytes({0b1000'0000, 0, 0, 0})))),
            (std::vector{6, 5, 4, 3, 2, 1}));
}

TEST(BmpDecode, SixteenBitsAndMasks) {
  EXPECT_EQ(values_u8(decoded(bmp(1, 1, 16, 0, {}, bytes({0xFF, 0x7F, 0, 0})))),
            (std::vector{255, 255, 255}));
  EXPECT_EQ(values_u8(decoded(bmp(1, 1, 16, 0, {}, bytes({0x00, 0x40, 0, 0})))), (std::vector{132, 0, 0}));
  const Bytes masks_565 = u32_le(0xF800) + u32_le(0x07E0) + u32_le(0x001F);
  EXPECT_EQ(values_u8(decoded(bmp(1, 1, 16, 3, masks_565, bytes({0xE0, 0x07, 0, 0})))),
            (std::vector{0, 255, 0}));
  const Bytes masks_alpha = u32_le(0xFF) + u32_le(0xFF00) + u32_le(0xFF0000) + u32_le(0xFF000000);
  EXPECT_EQ(values_u8(decoded(bmp(1, 1, 32, 6, masks_alpha, bytes({1, 2, 3, 4})))),
            (std::vector{1, 2, 3, 4}));
  // Without a mask the fourth byte is reserved.
  EXPECT_EQ(values_u8(decoded(bmp(1, 1, 32, 0, {}, bytes({3, 2, 1, 0})))), (std::vector{1, 2, 3}));
}

TEST(BmpDecode, RunLengths) {
  const Bytes palette = bytes({10, 10, 10, 0, 20, 20, 20, 0, 30, 30, 30, 0});
  const auto greys = [&](const Bytes& codes, int bits, unsigned compression) {
    std::vector<int> result;
    const std::vector<int> values = values_u8(decoded(bmp(4, 2, bits, compression, palette, codes, 3)));
    for (std::size_t i = 0; i < values.size(); i += 3) result.push_back(values[i] / 10 - 1);
    return result;
  };
  // A run of three 1, a literal-free last pixel, the end of the row; three literals with padding; the end.
  EXPECT_EQ(greys(bytes({3, 1, 1, 2, 0, 0, 0, 3, 2, 1, 2, 0, 1, 1, 0, 1}), 8, 1),
            (std::vector{2, 1, 2, 1, 1, 1, 1, 2}));
  // A jump over two pixels and to the next row; what is skipped has colour 0.
  EXPECT_EQ(greys(bytes({1, 1, 0, 2, 1, 1, 1, 2, 0, 1}), 8, 1), (std::vector{0, 0, 2, 0, 1, 0, 0, 0}));
  // Four bits: runs alternate between two colours; a run that goes beyond the row is cut.
  EXPECT_EQ(greys(bytes({5, 0x12, 0, 0, 0, 4, 0x01, 0x20, 0, 1}), 4, 2),
            (std::vector{0, 1, 2, 0, 1, 2, 1, 2}));
}

TEST(BmpDecode, TheOldestHeader) {
  const Bytes file = bytes("BM") + u32_le(0) + u32_le(0) + u32_le(26 + 6) + u32_le(12) + u16_le(2) +
                     u16_le(1) + u16_le(1) + u16_le(1) + bytes({1, 2, 3, 4, 5, 6}) +
                     bytes({0b1000'0000, 0, 0, 0});
  EXPECT_EQ(values_u8(decoded(file)), (std::vector{6, 5, 4, 3, 2, 1}));
}

TEST(TgaDecode, OrientationFollowsTheDescriptor) {
  const Bytes pixels = bytes({1, 2, 3, 4});
  EXPECT_EQ(values_u8(decoded(tga(3, 2, 2, 8, 0x20, pixels), "a.tga")), (std::vector{1, 2, 3, 4}));
  EXPECT_EQ(values_u8(decoded(tga(3, 2, 2, 8, 0x00, pixels), "a.TGA")), (std::vector{3, 4, 1, 2}));
  EXPECT_EQ(values_u8(decoded(tga(3, 2, 2, 8, 0x30, pixels), "a.tga")), (std::vector{2, 1, 4, 3}));
  EXPECT_EQ(values_u8(decoded(tga(3, 2, 2, 8, 0x10, pixels), "a.tga")), (std::vector{4, 3, 2, 1}));
  EXPECT_EQ(values_u8(decoded(tga(2, 1, 2, 24, 0x10, bytes({3, 2, 1, 6, 5, 4})), "a.tga")),
            (std::vector{4, 5, 6, 1, 2, 3}));
}

TEST(TgaDecode, Depths) {
  EXPECT_EQ(values_u8(decoded(small_tga(), "a.tga")), kRedGreenBlueWhite);
  EXPECT_EQ(values_u8(decoded(tga(2, 1, 1, 32, 0x28, bytes({3, 2, 1, 4})), "a.tga")),
            (std::vector{1, 2, 3, 4}));
  EXPECT_EQ(values_u8(decoded(tga(2, 1, 1, 16, 0x20, bytes({0x1F, 0x40})), "a.tga")),
            (std::vector{132, 0, 255}));
  EXPECT_EQ(values_u8(decoded(tga(3, 1, 1, 16, 0x20, bytes({7, 9})), "a.tga")), (std::vector{7, 9}));
}

TEST(TgaDecode, AlphaThatIsZeroEverywhereMeansNothing) {
  EXPECT_EQ(values_u8(decoded(tga(2, 1, 1, 32, 0x20, bytes({3, 2, 1, 0})), "a.tga")),
            (std::vector{1, 2, 3, 255}));
}

TEST(TgaDecode, RunLengthsMayCrossRows) {
  const Bytes packets = bytes({0x82, 7, 0x00, 9});
  EXPECT_EQ(values_u8(decoded(tga(11, 2, 2, 8, 0x20, packets), "a.tga")), (std::vector{7, 7, 7, 9}));
  const Bytes colour = bytes({0x81, 1, 2, 3, 0x01, 4, 5, 6, 7, 8, 9});
  EXPECT_EQ(values_u8(decoded(tga(10, 2, 2, 24, 0x20, colour), "a.tga")),
            (std::vector{3, 2, 1, 3, 2, 1, 6, 5, 4, 9, 8, 7}));
}

TEST(TgaDecode, PalettesMayBeginLater) {
  const Bytes palette = bytes({3, 2, 1, 6, 5, 4});  // colours 5 and 6
  EXPECT_EQ(values_u8(decoded(tga(1, 2, 1, 8, 0x20, bytes({6, 5}), palette, 5, 24), "a.tga")),
            (std::vector{4, 5, 6, 1, 2, 3}));
}

TEST(TgaDecode, AFooterIsAsGoodAsAName) {
  const Bytes footer = u32_le(0) + u32_le(0) + bytes("TRUEVISION-XFILE.") + bytes({0});
  EXPECT_EQ(values_u8(decoded(small_tga() + footer, "no ending")), kRedGreenBlueWhite);
}

TEST(PnmDecode, TextAndBytes) {
  EXPECT_EQ(values_u8(decoded(bytes("P1 # a bitmap\n3 2\n1 0 1\n010"))),
            (std::vector{0, 255, 0, 255, 0, 255}));
  EXPECT_EQ(values_u8(decoded(bytes("P2\n2 1\n# the maximum:\n4\n1 4"))), (std::vector{64, 255}));
  EXPECT_EQ(values_u8(decoded(bytes("P3 1 1 255 1 2 3"))), (std::vector{1, 2, 3}));
  EXPECT_EQ(
      values_u8(decoded(bytes("P4 9 2\n") + bytes({0x80, 0x00, 0x00, 0x80}))),
      (std::vector{0, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 0}));
  EXPECT_EQ(values_u8(decoded(bytes("P5 2 1 100\n") + bytes({50, 100}))), (std::vector{128, 255}));
  EXPECT_EQ(values_u8(decoded(bytes("P6 1 1 255\n") + bytes({1, 2, 3}))), (std::vector{1, 2, 3}));
  EXPECT_EQ(values_u16(decoded(bytes("P5 1 1 65535\n") + bytes({0x12, 0x34}))), (std::vector{0x1234}));
  EXPECT_EQ(values_u16(decoded(bytes("P5 1 1 1000\n") + bytes({0x01, 0xF4}))), (std::vector{32768}));
}

TEST(PfmDecode, BothByteOrdersFromTheBottom) {
  EXPECT_EQ(values_f32(decoded(small_pfm())), (std::vector{1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F}));
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  const Bytes big = bytes("Pf\n1 2\n1.0\n") + u32_be(bits(7)) + u32_be(bits(-0.5F));
  EXPECT_EQ(values_f32(decoded(big)), (std::vector{-0.5F, 7.0F}));
}

TEST(HdrDecode, SharedExponents) {
  EXPECT_EQ(values_f32(decoded(small_hdr())), (std::vector{1.0F, 0.5F, 0.25F, 2.0F, 2.0F, 2.0F}));
}

TEST(HdrDecode, ExposureIsTakenOut) {
  const Bytes file =
      bytes("#?RGBE\n# note\nEXPOSURE=4\nEXPOSURE= 0.5\n\n-Y 1 +X 1\n") + bytes({128, 64, 32, 130});
  EXPECT_EQ(values_f32(decoded(file)), (std::vector{1.0F, 0.5F, 0.25F}));
}

TEST(HdrDecode, RunLengthsOldAndNew) {
  const Bytes header = bytes("#?RADIANCE\n\n-Y 1 +X 8\n");
  const std::vector<float> expected(24, 1.0F);
  const Bytes run_of_8 = bytes({136, 128}), literal_8 = bytes({8, 128, 128, 128, 128, 128, 128, 128, 128});
  const Bytes fresh = bytes({2, 2, 0, 8}) + run_of_8 + literal_8 + run_of_8 + bytes({136, 129});
  EXPECT_EQ(values_f32(decoded(header + fresh)), expected);
  const Bytes old = bytes({128, 128, 128, 129, 1, 1, 1, 7});
  EXPECT_EQ(values_f32(decoded(header + old)), expected);
}

TEST(HdrDecode, LongOldRunsHaveSeveralDigits) {
  const Bytes file =
      bytes("#?RADIANCE\n\n-Y 1 +X 601\n") + bytes({128, 128, 128, 129, 1, 1, 1, 88, 1, 1, 1, 2});
  EXPECT_EQ(values_f32(decoded(file)), std::vector<float>(1803, 1.0F));
}

TEST(HdrDecode, OrientationIsFollowed) {
  const Bytes pixels = bytes({128, 0, 0, 129, 128, 0, 0, 130});
  EXPECT_EQ(values_f32(decoded(bytes("#?RADIANCE\n\n+Y 2 +X 1\n") + pixels)),
            (std::vector{2.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F}));
  EXPECT_EQ(values_f32(decoded(bytes("#?RADIANCE\n\n-Y 1 -X 2\n") + pixels)),
            (std::vector{2.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F}));
}

}  // namespace
}  // namespace laterna
