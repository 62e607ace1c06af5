// OpenEXR files of every kind that other programs write, made with OpenEXR itself.
#include <ImfChannelList.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>

#include <cmath>
#include <map>

#include "unit/image_bytes.h"

namespace laterna {
namespace {

using namespace laterna::testing;

// A smooth picture, so that lossy compression stays near it.
float sample(int x, int y, int channel) {
  return 0.5F + 0.25F * static_cast<float>(channel) + 0.01F * static_cast<float>(x) +
         0.003F * static_cast<float>(y);
}

// The values of one channel on its data window, in the type that the file will have.
struct Plane {
  Imf::PixelType type = Imf::FLOAT;
  std::vector<float> floats;
  std::vector<half> halves;
  std::vector<unsigned> integers;

  Plane(Imf::PixelType stored, const Imath::Box2i& window, int channel) : type(stored) {
    for (int y = window.min.y; y <= window.max.y; ++y) {
      for (int x = window.min.x; x <= window.max.x; ++x) {
        floats.push_back(sample(x, y, channel));
        halves.emplace_back(floats.back());
        integers.push_back(static_cast<unsigned>(1000 * y + x));
      }
    }
  }

  [[nodiscard]] Imf::Slice slice(const Imath::Box2i& window) const {
    if (type == Imf::HALF) return Imf::Slice::Make(type, halves.data(), window);
    if (type == Imf::UINT) return Imf::Slice::Make(type, integers.data(), window);
    return Imf::Slice::Make(type, floats.data(), window);
  }
};

class ExrFile {
 public:
  explicit ExrFile(int width, int height) : header(width, height) {}
  ExrFile(const Imath::Box2i& display, const Imath::Box2i& data) : header(display, data) {}

  ExrFile& add(const char* name, Imf::PixelType type) {
    const auto channel = static_cast<int>(planes_.size());
    header.channels().insert(name, Imf::Channel(type));
    planes_.emplace(name, Plane(type, header.dataWindow(), channel));
    return *this;
  }

  [[nodiscard]] Imf::FrameBuffer frame() const {
    Imf::FrameBuffer result;
    for (const auto& [name, plane] : planes_) result.insert(name, plane.slice(header.dataWindow()));
    return result;
  }

  void write(const std::filesystem::path& file) const {
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(frame());
    output.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
  }

  void write_tiled(const std::filesystem::path& file) {
    header.setTileDescription(Imf::TileDescription(8, 16, Imf::MIPMAP_LEVELS));
    Imf::TiledOutputFile output(file.c_str(), header);
    output.setFrameBuffer(frame());
    for (int level = 0; level < output.numLevels(); ++level) {
      output.writeTiles(0, output.numXTiles(level) - 1, 0, output.numYTiles(level) - 1, level);
    }
  }

  Imf::Header header;

 private:
  std::map<std::string, Plane> planes_;
};

Image read(const std::filesystem::path& file) {
  const Result<Image> image = read_image(file);
  if (image) return *image;
  ADD_FAILURE() << to_string(image.error());
  return {};
}

std::string read_error(const TemporaryFolder& directory, std::string_view name) {
  const Result<Image> image = read_image(directory / name);
  if (image) return "no error";
  return to_string(image.error()).substr(directory.path().string().size() + 1);
}

void expect_rgb(const Image& image, int width, int height, float tolerance) {
  ASSERT_EQ(image.width(), width);
  ASSERT_EQ(image.height(), height);
  ASSERT_EQ(image.channels(), 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(image.value(x, y, c), sample(x, y, c), tolerance) << x << " " << y;
    }
  }
}

TEST(ReadExr, EveryCompressionInRowsAndTiles) {
  const TemporaryFolder directory;
  for (int i = 0; i < Imf::NUM_COMPRESSION_METHODS; ++i) {
    ExrFile file(37, 41);
    file.header.compression() = static_cast<Imf::Compression>(i);
    file.add("R", Imf::HALF).add("G", Imf::HALF).add("B", Imf::HALF);
    file.write(directory / "rows.exr");
    file.write_tiled(directory / "tiles.exr");
    SCOPED_TRACE(i);
    const bool is_lossy = i >= Imf::B44_COMPRESSION;
    expect_rgb(read(directory / "rows.exr"), 37, 41, is_lossy ? 0.02F : 0.0005F);
    expect_rgb(read(directory / "tiles.exr"), 37, 41, is_lossy ? 0.02F : 0.0005F);
  }
}

TEST(ReadExr, HalfFloatAndUnsigned) {
  const TemporaryFolder directory;
  ExrFile(5, 3)
      .add("half", Imf::HALF)
      .add("float", Imf::FLOAT)
      .add("id", Imf::UINT)
      .write(directory / "a.exr");
  const Result<LayeredImage> image = read_layered_image(directory / "a.exr");
  ASSERT_TRUE(image) << to_string(image.error());
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      const auto i = static_cast<std::size_t>(y * 5 + x);
      EXPECT_EQ(image->find("half")->values[i], static_cast<float>(half(sample(x, y, 0))));
      EXPECT_EQ(image->find("float")->values[i], sample(x, y, 1));
      EXPECT_EQ(image->find("id")->values[i], static_cast<float>(1000 * y + x));
    }
  }
}

TEST(ReadExr, GreyAndAlpha) {
  const TemporaryFolder directory;
  ExrFile(4, 4).add("Y", Imf::FLOAT).write(directory / "y.exr");
  EXPECT_EQ(read(directory / "y.exr").channels(), 1);
  EXPECT_EQ(read(directory / "y.exr").value(3, 2, 0), sample(3, 2, 0));
  ExrFile(4, 4).add("Y", Imf::FLOAT).add("A", Imf::FLOAT).add("Z", Imf::FLOAT).write(directory / "ya.exr");
  const Image image = read(directory / "ya.exr");
  ASSERT_EQ(image.channels(), 2);
  EXPECT_EQ(image.value(1, 1, 1), sample(1, 1, 1));
  // Colours in the file are multiplied by alpha.
  EXPECT_FLOAT_EQ(image.value(1, 1, 0), sample(1, 1, 0) / sample(1, 1, 1));
}

TEST(ReadExr, DataOutsideTheDisplayWindowIsDroppedAndMissingDataIsZero) {
  const TemporaryFolder directory;
  const Imath::Box2i display({10, 20}, {15, 24});  // 6 × 5
  const Imath::Box2i data({8, 22}, {13, 30});
  ExrFile(display, data).add("Y", Imf::FLOAT).write(directory / "a.exr");
  const Image image = read(directory / "a.exr");
  ASSERT_EQ(image.width(), 6);
  ASSERT_EQ(image.height(), 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) {
      const bool has_data = x <= 3 && y >= 2;
      EXPECT_EQ(image.value(x, y, 0), has_data ? sample(x + 10, y + 20, 0) : 0) << x << " " << y;
    }
  }
}

TEST(ReadExr, WindowsThatDoNotMeetGiveBlack) {
  const TemporaryFolder directory;
  ExrFile({{0, 0}, {3, 3}}, {{-9, 7}, {-5, 8}}).add("Y", Imf::FLOAT).write(directory / "a.exr");
  EXPECT_EQ(values_f32(read(directory / "a.exr")), std::vector<float>(16, 0));
}

TEST(ReadExr, TheFirstOfSeveralParts) {
  const TemporaryFolder directory;
  ExrFile first(7, 5), second(7, 5);
  first.add("R", Imf::FLOAT).add("G", Imf::FLOAT).add("B", Imf::FLOAT);
  second.add("Y", Imf::FLOAT);
  first.header.setName("beauty");
  second.header.setName("other");
  const Imf::Header headers[] = {first.header, second.header};
  std::vector<Imf::Header> typed(headers, headers + 2);
  for (Imf::Header& header : typed) header.setType(Imf::SCANLINEIMAGE);
  {
    Imf::MultiPartOutputFile file((directory / "a.exr").c_str(), typed.data(), 2);
    Imf::OutputPart part(file, 0), other(file, 1);
    part.setFrameBuffer(first.frame());
    part.writePixels(5);
    other.setFrameBuffer(second.frame());
    other.writePixels(5);
  }
  expect_rgb(read(directory / "a.exr"), 7, 5, 0);
  const Result<LayeredImage> layers = read_layered_image(directory / "a.exr");
  ASSERT_TRUE(layers);
  EXPECT_TRUE(layers->metadata.empty());
}

TEST(ReadExr, NamesWhatItDoesNotRead) {
  const TemporaryFolder directory;
  ExrFile(2, 2).add("Z", Imf::FLOAT).add("N.X", Imf::HALF).write(directory / "layers.exr");
  EXPECT_EQ(read_error(directory, "layers.exr"), "layers.exr: expected channels R, G, B or Y, found N.X Z");

  Imf::Header chroma(4, 4);
  chroma.channels().insert("Y", Imf::Channel(Imf::HALF));
  chroma.channels().insert("RY", Imf::Channel(Imf::HALF, 2, 2));
  { const Imf::OutputFile file((directory / "chroma.exr").c_str(), chroma); }
  EXPECT_EQ(read_error(directory, "chroma.exr"),
            "chroma.exr: channel RY: a channel of lower resolution (luminance-chroma) is not read");

  Imf::Header deep(2, 2);
  deep.setType(Imf::DEEPSCANLINE);
  deep.compression() = Imf::ZIPS_COMPRESSION;
  deep.channels().insert("Y", Imf::Channel(Imf::HALF));
  { const Imf::DeepScanLineOutputFile file((directory / "deep.exr").c_str(), deep); }
  EXPECT_EQ(read_error(directory, "deep.exr"),
            "deep.exr: expected one value per pixel, found a deep picture");
}

TEST(ReadExr, RefusesSizesThatTheFileCannotHold) {
  const TemporaryFolder directory;
  const auto claim = [&](const Imath::Box2i& display, const Imath::Box2i& data) {
    Imf::Header header(display, data);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    { const Imf::OutputFile file((directory / "a.exr").c_str(), header); }
    return read_error(directory, "a.exr");
  };
  EXPECT_EQ(
      claim({{0, 0}, {69999, 0}}, {{0, 0}, {3, 3}}),
      "a.exr: the data window is 4 x 4, the display window 70000 x 1, with 1 channels: more than is read");
  EXPECT_EQ(claim({{0, 0}, {9, 9}}, {{0, 0}, {59999, 39999}}),
            "a.exr: the data window is 60000 x 40000, the display window 10 x 10, with 1 channels: more than "
            "is read");
  EXPECT_NE(claim({{0, 0}, {9, 9}}, {{0, 0}, {19999, 19999}}).find("bytes can hold"), std::string::npos);
}

}  // namespace
}  // namespace laterna
