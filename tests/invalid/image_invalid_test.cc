// Picture files that are damaged, cut short, absurd or something else: the exact message of each, and every
// length.
#include <gtest/gtest.h>

#include <algorithm>

#include "unit/image_bytes.h"

namespace laterna {
namespace {

using namespace laterna::testing;

std::string error_of(const Bytes& file, std::string_view name) {
  const Result<Image> image = decode_image(file, name);
  if (image) return "no error";
  EXPECT_EQ(image.error().failure, Failure::bad_input);
  return to_string(image.error());
}

Bytes with_byte(Bytes file, std::size_t position, int value) {
  file.at(position) = static_cast<std::byte>(value);
  return file;
}

struct Row {
  Bytes file;
  std::string name;
  std::string message;
};

void expect_messages(const std::vector<Row>& rows) {
  for (const Row& row : rows) EXPECT_EQ(error_of(row.file, row.name), row.message);
}

TEST(InvalidPicture, NotAPicture) {
  const std::string expected =
      ": expected a PNG, JPEG, GIF, BMP, TGA, PCX, PNM, PFM, Radiance HDR or OpenEXR picture, found ";
  expect_messages({
      {{}, "empty.png", "empty.png: the file is empty"},
      {bytes("hello"), "a.png", "a.png" + expected + "none of these"},
      {bytes({0x89}), "a.png", "a.png" + expected + "none of these"},
      {bytes("RIFF....WEBPVP8 "), "a.webp", "a.webp" + expected + "WebP"},
      {bytes("II*") + bytes({0, 8}), "a.tif", "a.tif" + expected + "TIFF"},
      {bytes("DDS |"), "a.dds", "a.dds" + expected + "DDS"},
      {small_tga(), "a.png", "a.png" + expected + "none of these"},
      {bytes("v/1"), "a.exr", "a.exr" + expected + "none of these"},
      {bytes("P8 1 1 1 1"), "a.ppm", "a.ppm" + expected + "none of these"},
      {bytes("P7\nWIDTH 1\n"), "a.pam", "a.pam" + expected + "PAM"},
  });
}

TEST(InvalidPicture, Png) {
  const Bytes good = small_png();
  const Bytes rows = bytes({0, 1, 2, 3});
  expect_messages({
      {with_byte(good, 29, 0), "a.png", "a.png: chunk IHDR: CRC error"},
      {with_byte(good, 41, 0), "a.png", "a.png: chunk IDAT: incorrect header check"},
      {with_byte(good, 50, 77), "a.png", "a.png: chunk IDAT: incorrect data check"},
      {png(0, 1, 8, 2, rows), "a.png", "a.png: byte 33: Invalid IHDR data (Image width is zero in IHDR)"},
      {png(1, 0, 8, 2, rows), "a.png", "a.png: byte 33: Invalid IHDR data (Image height is zero in IHDR)"},
      {png(70000, 1, 8, 2, rows), "a.png",
       "a.png: byte 33: Invalid IHDR data (Image width exceeds user limit in IHDR)"},
      {png(65536, 65536, 8, 2, rows), "a.png",
       "a.png: the picture is 65536 x 65536 pixels; at most 65536 per side and 1073741824 in all are read"},
      {png(30000, 30000, 8, 2, rows), "a.png",
       "a.png: the header claims 30000 x 30000 pixels, more than a PNG file of 72 bytes can hold"},
      {png(1000, 1000, 16, 6, rows), "a.png",  // would do at one bit per pixel
       "a.png: the header claims 1000 x 1000 pixels, more than a PNG file of 72 bytes can hold"},
      {png(1, 1, 3, 2, rows), "a.png",
       "a.png: byte 33: Invalid IHDR data (Invalid color type/bit depth combination in IHDR)"},
      {png(1, 1, 8, 5, rows), "a.png", "a.png: byte 33: Invalid IHDR data (Invalid color type in IHDR)"},
      {png(1, 1, 8, 3, bytes({0, 0})), "a.png", "a.png: chunk IDAT: Missing PLTE before IDAT"},
      {png(1, 2, 8, 2, rows), "a.png", "a.png: byte 68: Not enough image data"},
      {png(1, 1, 8, 2, bytes({9, 1, 2, 3})), "a.png", "a.png: byte 56: bad adaptive filter value"},
      {kPngSignature, "a.png", "a.png: byte 8: the file ends here, before the picture is complete"},
      {bytes({0x89, 'P', 'N', 'G', '\n', 0x1A, '\n', 0, 0, 0}), "a.png",
       "a.png: byte 8: PNG file corrupted by ASCII conversion"},
      {first(good, 60), "a.png", "a.png: byte 60: the file ends here, before the picture is complete"},
      {first(good, good.size() - 12), "a.png",
       "a.png: byte 70: the file ends here, before the picture is complete"},
      {png_header(1, 1, 8, 2) + png_chunk("IEND", {}), "a.png", "a.png: chunk IEND: out of place"},
  });
}

TEST(InvalidPicture, Jpeg) {
  const Bytes good = small_jpeg();
  expect_messages({
      {first(good, 3), "a.jpg", "a.jpg: the file ends before its picture begins"},
      {first(good, 50), "a.jpg", "a.jpg: the file ends before its picture begins"},
      {first(good, good.size() - 2), "a.jpg", "a.jpg: Premature end of JPEG file"},
      {first(good, good.size() - 3), "a.jpg", "a.jpg: Premature end of JPEG file"},
      {with_byte(with_byte(good, 94, 0), 95, 0), "a.jpg", "a.jpg: Empty JPEG image (DNL not supported)"},
      {with_byte(with_byte(good, 94, 255), 96, 255), "a.jpg",
       "a.jpg: the picture is 65288 x 65288 pixels; at most 65536 per side and 1073741824 in all are read"},
      {with_byte(good, 93, 12), "a.jpg", "a.jpg: Unsupported JPEG data precision 12"},
      {with_byte(good, 90, 0xC3), "a.jpg", "a.jpg: Unsupported JPEG process: SOF type 0xc3"},
      {small_cmyk_jpeg(), "a.jpg",
       "a.jpg: expected grey or RGB colour, found CMYK: its inks are not known, convert it to RGB"},
  });
}

TEST(InvalidPicture, Gif) {
  const Bytes good = small_gif();
  const Bytes no_palette = with_byte(good, 10, 0);
  expect_messages({
      {with_byte(good, 6, 0), "a.gif", "a.gif: the picture has no pixels: its size is 0 x 2"},
      {first(good, 11), "a.gif", "a.gif: byte 11: the file ends here, inside the header"},
      {first(good, 30), "a.gif", "a.gif: byte 30: the file ends here, inside the first frame"},
      {gif(60000, 15000, 0, 0, 1, 1, 0, gif_codes({0})), "a.gif",
       "a.gif: the header claims 60000 x 15000 pixels, more than a GIF file of 41 bytes can hold"},
      {gif(2, 2, 1, 1, 2, 1, 0, gif_codes({0, 1})), "a.gif",
       "a.gif: byte 35: the first frame is not inside the picture"},
      {gif(2, 2, 0, 0, 2, 2, 0, gif_codes({0, 1, 2})), "a.gif",
       "a.gif: byte 40: the first frame ends after 3 of 4 pixels"},
      {gif(2, 2, 0, 0, 2, 2, 0, bytes({9, 1, 0, 0})), "a.gif",
       "a.gif: byte 35: expected 1 to 8 bits per value, found 9"},
      {gif(2, 2, 0, 0, 2, 2, 0, bytes({2, 1, 0xFF, 0})), "a.gif",
       "a.gif: byte 38: the compressed pixels are damaged"},
      {first(good, 25) + bytes({0x3B}), "a.gif", "a.gif: byte 25: expected a frame, found block 59"},
      {bytes("GIF89a") + u16_le(1) + u16_le(1) + bytes({0, 0, 0, 0x2C}) + u32_le(0) + u16_le(1) + u16_le(1) +
           bytes({0, 2, 1, 4, 0}),
       "a.gif", "a.gif: byte 23: the first frame has no palette"},
      {bytes("GIF89a") + u16_le(1) + u16_le(1) + bytes({0x80, 0, 0, 1, 2, 3, 4, 5, 6, 0x2C}) + u32_le(0) +
           u16_le(1) + u16_le(1) + bytes({0}) + gif_codes({3}),
       "a.gif", "a.gif: a pixel has colour 3 of a palette of 2"},
  });
}

TEST(InvalidPicture, Bmp) {
  const Bytes good = small_bmp();
  const Bytes palette = bytes({1, 2, 3, 0});
  expect_messages({
      {first(good, 20), "a.bmp", "a.bmp: byte 20: the file ends here, inside the header"},
      {first(good, 50), "a.bmp", "a.bmp: byte 50: the file ends here, inside the header"},
      {first(good, 60), "a.bmp", "a.bmp: byte 60: the file ends here, inside the pixels"},
      {with_byte(good, 14, 41), "a.bmp",
       "a.bmp: byte 14: expected a header of 12, 40, 52, 56, 64, 108 or 124 bytes, found 41"},
      {with_byte(good, 10, 20), "a.bmp", "a.bmp: byte 10: the pixels begin at byte 20, inside the header"},
      {with_byte(good, 28, 13), "a.bmp",
       "a.bmp: byte 14: expected 1, 4, 8, 16, 24 or 32 bits per pixel, found 13"},
      {with_byte(good, 30, 4), "a.bmp",
       "a.bmp: byte 14: compression 4 (JPEG) is not read at 24 bits per pixel"},
      {with_byte(good, 30, 1), "a.bmp",
       "a.bmp: byte 14: compression 1 (RLE8) is not read at 24 bits per pixel"},
      {with_byte(good, 18, 0), "a.bmp", "a.bmp: the picture has no pixels: its size is 0 x 2"},
      {with_byte(good, 21, 0x80), "a.bmp", "a.bmp: the picture has no pixels: its size is -2147483646 x 2"},
      {bmp(1, -2147483647 - 1, 24, 0, {}, {}), "a.bmp",
       "a.bmp: the picture is 1 x 2147483647 pixels; at most 65536 per side and 1073741824 in all are read"},
      {bmp(40000, 20000, 24, 0, {}, {}), "a.bmp",
       "a.bmp: the header claims 40000 x 20000 pixels, more than a BMP file of 54 bytes can hold"},
      {bmp(40000, 20000, 8, 1, palette, bytes({0, 1}), 1), "a.bmp",
       "a.bmp: the header claims 40000 x 20000 pixels, more than a BMP file of 60 bytes can hold"},
      {bmp(2, 1, 8, 0, palette, bytes({0, 1, 0, 0}), 1), "a.bmp",
       "a.bmp: a pixel has colour 1 of a palette of 1"},
      {bmp(2, 1, 8, 1, palette, bytes({2, 0}), 1), "a.bmp",
       "a.bmp: byte 60: the file ends here, inside the pixels"},
      {bmp(1, 1, 16, 3, u32_le(0xF800) + u32_le(0) + u32_le(0x1F), bytes({0, 0, 0, 0})), "a.bmp",
       "a.bmp: byte 14: a colour mask is empty"},
      {bmp(1, 1, 16, 3, u32_le(0xF800) + u32_le(0x550) + u32_le(0x1F), bytes({0, 0, 0, 0})), "a.bmp",
       "a.bmp: byte 14: a colour mask has gaps"},
  });
}

TEST(InvalidPicture, Tga) {
  const Bytes good = small_tga();
  const Bytes palette = bytes({3, 2, 1});
  expect_messages({
      {first(good, 17), "a.tga", "a.tga: byte 17: the file ends here, inside the header"},
      {first(good, 20), "a.tga", "a.tga: byte 20: the file ends here, inside the pixels"},
      {with_byte(good, 2, 4), "a.tga",
       "a.tga: byte 2: expected TGA image type 1, 2, 3, 9, 10 or 11, found 4"},
      {with_byte(good, 16, 12), "a.tga",
       "a.tga: byte 16: a TGA of type 2 with 12 bits per colour is not read"},
      {with_byte(good, 12, 0), "a.tga", "a.tga: the picture has no pixels: its size is 0 x 2"},
      {with_byte(good, 17, 0xC0), "a.tga", "a.tga: byte 17: interleaved rows are not read"},
      {tga(1, 1, 1, 8, 0x20, bytes({0})), "a.tga",
       "a.tga: byte 1: a palette picture needs a palette and 8 or 16 bits per pixel"},
      {tga(1, 1, 1, 8, 0x20, bytes({7}), palette, 5, 24), "a.tga",
       "a.tga: a pixel has a colour outside the palette, which holds colours 5 to 5"},
      {tga(1, 1, 1, 8, 0x20, bytes({4}), palette, 5, 24), "a.tga",
       "a.tga: a pixel has a colour outside the palette, which holds colours 5 to 5"},
      {tga(1, 1, 1, 8, 0x20, bytes({0}), palette, 0, 13), "a.tga",
       "a.tga: byte 7: a TGA of type 1 with 13 bits per colour is not read"},
      {tga(10, 2, 2, 24, 0x20, bytes({0x81, 1, 2, 3, 0x00, 1})), "a.tga",
       "a.tga: byte 24: the file ends here, inside the pixels"},
      {tga(2, 60000, 10000, 24, 0x20, bytes({0})), "a.tga",
       "a.tga: the header claims 60000 x 10000 pixels, more than a TGA file of 19 bytes can hold"},
  });
}

TEST(InvalidPicture, Pnm) {
  expect_messages({
      {bytes("P5 "), "a.pgm", "a.pgm: byte 3: the file ends here, inside the header"},
      {bytes("P5 x 1 255\n1"), "a.pgm", "a.pgm: byte 2: expected a width and a height in pixels"},
      {bytes("P5 1 -1 255\n1"), "a.pgm", "a.pgm: byte 5: expected a width and a height in pixels"},
      {bytes("P5 0 1 255\n1"), "a.pgm", "a.pgm: the picture has no pixels: its size is 0 x 1"},
      {bytes("P5 1 1 0\n1"), "a.pgm", "a.pgm: byte 7: expected a maximum value from 1 to 65535"},
      {bytes("P5 1 1 65536\n1"), "a.pgm", "a.pgm: byte 7: expected a maximum value from 1 to 65535"},
      {bytes("P5 2 1 255\n1"), "a.pgm", "a.pgm: byte 12: the file ends here, inside the pixels"},
      {bytes("P5 999999999 1 255\n1"), "a.pgm", "a.pgm: byte 2: expected a width and a height in pixels"},
      {bytes("P5 99999999 1 255\n1"), "a.pgm",
       "a.pgm: the picture is 99999999 x 1 pixels; at most 65536 per side and 1073741824 in all are read"},
      {bytes("P5 30000 30000 255\n1"), "a.pgm",
       "a.pgm: the header claims 30000 x 30000 pixels, more than a PNM file of 20 bytes can hold"},
      {bytes("P5 1 1 100\n") + bytes({101}), "a.pgm", "a.pgm: byte 11: expected a value from 0 to 100"},
      {bytes("P2 2 1 100\n 7 101"), "a.pgm", "a.pgm: byte 14: expected a value from 0 to 100"},
      {bytes("P2 2 1 100\n 7 "), "a.pgm", "a.pgm: byte 14: the file ends here, inside the pixels"},
      {bytes("P2 2 1 100\n 7 x"), "a.pgm", "a.pgm: byte 14: expected a value from 0 to 100"},
      {bytes("P1 2 1\n 2"), "a.pbm", "a.pbm: byte 7: expected a value from 0 to 1"},
  });
}

TEST(InvalidPicture, FloatFormats) {
  expect_messages({
      {bytes("PF\n"), "a.pfm", "a.pfm: byte 3: the file ends here, inside the header"},
      {bytes("PF\n1 1\n"), "a.pfm", "a.pfm: byte 7: the file ends here, inside the header"},
      {bytes("PF\n1 1\n0\n"), "a.pfm",
       "a.pfm: byte 7: expected a scale, negative for little-endian values, found \"0\""},
      {bytes("PF\n1 1\nnan\n"), "a.pfm",
       "a.pfm: byte 7: expected a scale, negative for little-endian values, found \"nan\""},
      {bytes("PF\n1 1\n-1.0\n12345678901"), "a.pfm", "a.pfm: byte 23: the file ends here, inside the pixels"},
      {bytes("PF\n20000 20000\n-1.0\n1"), "a.pfm",
       "a.pfm: the header claims 20000 x 20000 pixels, more than a PFM file of 21 bytes can hold"},
      {bytes("#?RADIANCE\n"), "a.hdr", "a.hdr: byte 11: the file ends here, inside the header"},
      {bytes("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234"), "a.hdr",
       "a.hdr: line 2: expected FORMAT=32-bit_rle_rgbe, found 32-bit_rle_xyze"},
      {bytes("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n1234"), "a.hdr",
       "a.hdr: line 2: EXPOSURE must be greater than 0"},
      {bytes("#?RADIANCE\n\n+X 1 -Y 1\n1234"), "a.hdr",
       "a.hdr: line 3: expected a resolution such as \"-Y 512 +X 1024\", found \"+X 1 -Y 1\""},
      {bytes("#?RADIANCE\n\n-Y 1 +X 1\n123"), "a.hdr",
       "a.hdr: byte 25: the file ends here, inside the pixels"},
      {bytes("#?RADIANCE\n\n-Y 1 +X 1\n") + bytes({1, 1, 1, 1}), "a.hdr",
       "a.hdr: byte 26: row 0: a run does not fit the row"},
      {bytes("#?RADIANCE\n\n-Y 1 +X 8\n") + bytes({2, 2, 0, 8, 137, 1}), "a.hdr",
       "a.hdr: byte 27: row 0: a run does not fit the row"},
      {bytes("#?RADIANCE\n\n-Y 1 +X 8\n") + bytes({2, 2, 0, 9, 136, 1}), "a.hdr",
       "a.hdr: byte 26: row 0: a run does not fit the row"},
      {bytes("#?RADIANCE\n\n-Y 1 +X 0\n"), "a.hdr", "a.hdr: the picture has no pixels: its size is 0 x 1"},
  });
}

TEST(InvalidPicture, File) {
  const TemporaryFolder directory;
  const auto error = [&](const std::filesystem::path& file) {
    const Result<Image> image = read_image(file);
    return image ? "no error" : to_string(image.error()).substr(directory.path().string().size() + 1);
  };
  store(directory / "empty.png", {});
  EXPECT_EQ(error(directory / "none.png"), "none.png: cannot open: No such file or directory");
  EXPECT_EQ(error(directory / "."), ".: expected a file, found a directory");
  EXPECT_EQ(error(directory / "empty.png"), "empty.png: the file is empty");
}

Bytes small_exr() {
  const TemporaryFolder directory;
  LayeredImage image{
      3, 40, {{"R", std::vector<float>(120, 0.5F)}, {"G", {}}, {"B", {}}, {"Z", {}}}, {{"key", "value"}}};
  for (std::size_t c = 1; c < 4; ++c) {
    for (std::size_t i = 0; i < 120; ++i)
      image.channels[c].values.push_back(0.37F * static_cast<float>(i * c));
  }
  const Result<void> written = write_image(image, directory / "a.exr");
  EXPECT_TRUE(written);
  return load(directory / "a.exr");
}

// Where `text` begins in the file.
std::size_t position_of(const Bytes& file, std::string_view text) {
  const Bytes wanted = bytes(text);
  const auto found = std::search(file.begin(), file.end(), wanted.begin(), wanted.end());
  EXPECT_NE(found, file.end()) << text;
  return static_cast<std::size_t>(found - file.begin());
}

TEST(InvalidPicture, Exr) {
  const Bytes good = small_exr();
  // The size of an attribute follows its name and its type, each with a zero byte.
  const std::size_t channels_size = position_of(good, "chlist") + 7;
  const std::size_t key_size = position_of(good, "key") + 4 + 7;
  const std::size_t window = position_of(good, "displayWindow") + 14 + 6 + 4;
  const std::size_t compression = position_of(good, "compression") + 12 + 12 + 4;
  expect_messages({
      {first(good, 7), "a.exr", "a.exr: byte 7: the file ends here, inside the header"},
      {first(good, 40), "a.exr",
       "a.exr: byte 24: attribute \"channels\" of type chlist claims 73 bytes; the file has 12 more"},
      {first(good, good.size() - 100), "a.exr", "a.exr: the file ends before the picture is complete"},
      {with_byte(good, channels_size, 1), "a.exr",
       "a.exr: byte 24: attribute \"channels\" of type chlist claims 1 bytes; expected 73"},
      {with_byte(good, key_size + 3, 0x7F), "a.exr",
       "a.exr: byte 218: attribute \"key\" of type string claims 2130706437 bytes; the file has 1181 more"},
      {with_byte(good, 4, 9), "a.exr",
       "a.exr: Cannot read version 9 image files.  Current file format version is 2."},
      {with_byte(good, compression, 77), "a.exr", "a.exr: Unknown compression type in image header."},
      {with_byte(good, window + 11, 0xFF), "a.exr", "a.exr: Invalid display window in image header."},
      {with_byte(good, good.size() - 60, 0x55), "a.exr", "a.exr: Data decompression (zlib) failed."},
  });
}

struct Sample {
  std::string name;
  Bytes file;
  std::size_t complete;  // so many bytes hold the whole picture
};

// Most pictures end with their file. `rest` bytes at the end of a file belong to the format but not to the
// picture.
std::vector<Sample> samples() {
  const auto sample = [](std::string name, Bytes file, std::size_t rest = 0) {
    const std::size_t complete = file.size() - rest;
    return Sample{std::move(name), std::move(file), complete};
  };
  const Bytes png_palette = png_chunk("PLTE", bytes({1, 2, 3, 4, 5, 6})) + png_chunk("tRNS", bytes({9}));
  const Bytes bmp_palette = bytes({1, 2, 3, 0, 4, 5, 6, 0}), tga_palette = bytes({3, 2, 1, 6, 5, 4});
  const Bytes bmp_runs = bytes({2, 1, 1, 0, 0, 0, 0, 3, 1, 0, 1, 0, 0, 1});
  const Bytes tga_runs = bytes({0x81, 1, 2, 3, 0x01, 4, 5, 6, 7, 8, 9});
  const Bytes hdr_runs = bytes({2, 2, 0, 8, 136, 128, 8, 1, 2, 3, 4, 5, 6, 7, 8, 136, 128, 136, 128});
  return {
      sample("a.png", small_png()),
      sample("palette.png", png(2, 1, 8, 3, bytes({0, 1, 0}), png_palette)),
      sample("interlaced.png", png(2, 2, 8, 0, bytes({0, 10, 0, 20, 0, 30, 40}), {}, 1)),
      sample("a.jpg", small_jpeg()),
      sample("colour.jpg", small_colour_jpeg()),
      sample("a.tga", small_tga()),
      sample("runs.tga", tga(10, 2, 2, 24, 0x20, tga_runs)),
      sample("palette.tga", tga(1, 2, 1, 8, 0x20, bytes({1, 0}), tga_palette, 0, 24)),
      sample("a.bmp", small_bmp(), 2),  // the last row's padding
      sample("palette.bmp", bmp(3, 2, 4, 0, bmp_palette, bytes({0x01, 0x10, 0, 0, 0x10, 0, 0, 0}), 2), 2),
      sample("runs.bmp", bmp(3, 2, 8, 1, bmp_palette, bmp_runs, 2)),
      sample("a.gif", small_gif(), 2),  // the end of the frame's blocks and of the file
      sample("a.hdr", small_hdr()),
      sample("runs.hdr", bytes("#?RADIANCE\n\n-Y 1 +X 8\n") + hdr_runs),
      sample("a.pfm", small_pfm()),
      sample("a.ppm", bytes("P6 2 1 255\n123456")),
      sample("text.ppm", bytes("P3 1 1 9 1 2 3")),
      sample("a.exr", small_exr()),
  };
}

TEST(InvalidPicture, EveryLengthShortOfThePictureIsAnError) {
  for (const Sample& sample : samples()) {
    const Image whole = decoded(sample.file, sample.name);
    for (std::size_t length = 0; length < sample.file.size(); ++length) {
      // A copy of its own size, so that a sanitizer sees every read beyond it.
      const Result<Image> image = decode_image(first(sample.file, length), sample.name);
      if (length < sample.complete) {
        EXPECT_FALSE(image) << sample.name << " cut to " << length;
      } else {
        ASSERT_TRUE(image) << sample.name << " cut to " << length;
        EXPECT_TRUE(std::equal(whole.bytes().begin(), whole.bytes().end(), image->bytes().begin(),
                               image->bytes().end()))
            << sample.name << " cut to " << length;
      }
    }
  }
}

TEST(InvalidPicture, ADamagedByteGivesAnErrorOrAPictureOfTheSizeThatTheHeaderSays) {
  for (const Sample& sample : samples()) {
    for (std::size_t position = 0; position < sample.file.size(); ++position) {
      for (const int mask : {0x01, 0x80, 0xFF}) {
        const Bytes file =
            with_byte(sample.file, position, std::to_integer<int>(sample.file[position]) ^ mask);
        const Result<ImageHeader> header = read_image_header(file, sample.name);
        if (header && std::int64_t{header->width} * header->height > 1 << 20)
          continue;  // a test of patience only
        const Result<Image> image = decode_image(file, sample.name);
        if (!image) continue;
        ASSERT_TRUE(header) << sample.name << " at " << position;
        EXPECT_EQ(image->width(), header->width) << sample.name << " at " << position;
        EXPECT_EQ(image->height(), header->height) << sample.name << " at " << position;
        EXPECT_EQ(image->channels(), header->channels) << sample.name << " at " << position;
      }
    }
  }
}

}  // namespace
}  // namespace laterna
