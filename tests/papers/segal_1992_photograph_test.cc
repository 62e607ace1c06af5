// Segal et al. 1992, section 2 and 3: a photograph thrown back from where it was taken.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "laterna/measure.h"
#include "reference/photograph_scenes.h"
#include "reference/picture_probes.h"

namespace laterna {
namespace {

using namespace reference;

RenderSettings photo_settings(int width, int height) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.layers = {Layer::photographs, Layer::position, Layer::normal};
  return settings;
}

// Every pixel another colour than its neighbours.
glm::vec3 noise(int x, int y) {
  unsigned h = static_cast<unsigned>(x) * 73856093U ^ static_cast<unsigned>(y) * 19349663U;
  glm::vec3 color;
  for (int c = 0; c < 3; ++c) {
    h = (h ^ (h >> 13U)) * 1274126177U;
    color[c] = static_cast<float>(h >> 8U & 255U) / 255;
  }
  return color * color;
}

// Row 14, first half: from the original camera at the same size the render is the photograph.
TEST(Segal1992Photograph, FromItsOwnCameraTheRenderIsThePhotograph) {
  constexpr int kWidth = 320, kHeight = 200;
  for (const PhotographBlend blend : {PhotographBlend::surface, PhotographBlend::view}) {
    Scene scene = facade();
    const View view = photograph_view({-2, 1, 9}, {0.3, 0, 0}, 260, {150, 110}, kWidth, kHeight);
    add_photograph(scene, "photo", view, kWidth, kHeight, noise, true);
    scene.photograph_settings.blend = blend;
    const Image photo = *scene.pictures[0].pixels;
    const Renderer renderer = make_renderer(std::move(scene));
    const LayeredImage image = render(renderer, view, photo_settings(kWidth, kHeight));
    double squares = 0;
    int inside = 0, unseen = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (at(image, "photo.seen", x, y) < 0) continue;
        unseen += at(image, "photo.seen", x, y) == 0 ? 1 : 0;
        ++inside;
        constexpr const char* kRgb[] = {"R", "G", "B"};
        for (int c = 0; c < 3; ++c) {
          const double off = code_of(at(image, kRgb[c], x, y)) / 255.0 - photo.value(x, y, c);
          squares += off * off / 3;
        }
      }
    }
    ASSERT_GT(inside, kWidth * kHeight / 3);
    EXPECT_GT(-10 * std::log10(squares / inside + 1e-12), 45);
    // Pictures snap corners to 1/256 pixel, rays do not: of the pixels along a rim, one in some hundred shows what is hidden by
    // less than that.
    EXPECT_LE(unseen, 4);
  }
}

// Row 14, second half: the corner of a painted window, photographed at a slant, lands within a pixel in another view.
TEST(Segal1992Photograph, ACornerOfTheFacadeLandsWhereItIs) {
  constexpr int kPhotoWidth = 480, kPhotoHeight = 360, kWidth = 400, kHeight = 300;
  const View photo =
      photograph_view({-3, 2, 7}, {0.5, 0.5, 0}, 480, {239.5, 179.5}, kPhotoWidth, kPhotoHeight);
  Scene scene;
  add_object(scene, "wall", wall(4, 3, 0));
  const glm::dvec2 low(-1, -0.5), high(1.25, 1.5);
  add_photograph(scene, "photo", photo, kPhotoWidth, kPhotoHeight, [&](int x, int y) {
    int inside = 0;
    for (int i = 0; i < 64; ++i) {
      const glm::dvec2 p =
          on_facade(photo, kPhotoWidth, kPhotoHeight, {x + (i % 8 + 0.5) / 8, y + (i / 8 + 0.5) / 8});
      inside += p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y ? 1 : 0;
    }
    return glm::vec3(static_cast<float>(inside) / 64);
  });
  const View camera = photograph_view({2.5, -1, 6}, {0.2, 0.3, 0}, 380, {199.5, 149.5}, kWidth, kHeight);
  const Renderer renderer = make_renderer(std::move(scene));
  const LayeredImage image = render(renderer, camera, photo_settings(kWidth, kHeight));
  const glm::dvec2 corner = in_picture(camera, kWidth, kHeight, {high, 0});
  // Both edges that meet there, up to 40 pixels away: carried back to the wall, each must be where it was painted.
  const double pixel =
      glm::length(in_picture(camera, kWidth, kHeight, {high.x + 0.01, high.y, 0}) - corner) / 0.01;
  int found = 0;
  for (int away = 6; away < 40; away += 4) {
    const int y = static_cast<int>(corner.y) + away, x = static_cast<int>(corner.x) - away;
    for (const double edge : crossings(row_of(image, "R", y), 0.5)) {
      const glm::dvec2 p = on_facade(camera, kWidth, kHeight, {edge, y + 0.5});
      if (std::abs(p.x - high.x) > 0.5) continue;
      EXPECT_LT(std::abs(p.x - high.x) * pixel, 0.5) << y;
      ++found;
    }
    std::vector<float> column;
    for (int row = 0; row < kHeight; ++row) column.push_back(at(image, "R", x, row));
    for (const double edge : crossings(column, 0.5)) {
      const glm::dvec2 p = on_facade(camera, kWidth, kHeight, {x + 0.5, edge});
      if (std::abs(p.y - high.y) > 0.5) continue;
      EXPECT_LT(std::abs(p.y - high.y) * pixel, 0.5) << x;
      ++found;
    }
  }
  EXPECT_EQ(found, 18);
}

// Row 60: the layer of what no photograph sees is exact against rays, and there nothing is painted.
TEST(Segal1992Photograph, WhatItDoesNotSeeStaysUnshaded) {
  constexpr int kWidth = 240, kHeight = 160;
  const View photo = photograph_view({-4, 1.5, 6}, {0, 0, 0}, 200, {119.5, 79.5}, kWidth, kHeight);
  const View camera = photograph_view({3, 2, 8}, {0, -0.3, 0}, 240, {119.5, 79.5}, kWidth, kHeight);
  for (const ShadowTechnique technique :
       {ShadowTechnique::exact, ShadowTechnique::raytraced, ShadowTechnique::map}) {
    Scene scene = facade();
    add_photograph(scene, "photo", photo, kWidth, kHeight, [](int, int) { return glm::vec3(1); });
    scene.photograph_settings.visibility = technique;
    scene.photograph_settings.unseen = glm::vec3(0.25F);
    const Renderer renderer = make_renderer(std::move(scene));
    const LayeredImage image = render(renderer, camera, photo_settings(kWidth, kHeight));
    int seen = 0, hidden = 0, wrong = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (at(image, "photo.seen", x, y) < 0) continue;
        const auto vector = [&](const char* layer) {
          const std::string name = layer;
          return glm::dvec3(at(image, name + ".X", x, y), at(image, name + ".Y", x, y),
                            at(image, name + ".Z", x, y));
        };
        const bool is_seen =
            sees(renderer.scene(), renderer.scene().photographs[0], vector("P"), vector("N"));
        (is_seen ? seen : hidden) += 1;
        wrong += is_seen != (at(image, "photo.seen", x, y) == 1) ? 1 : 0;
        EXPECT_NEAR(at(image, "R", x, y), at(image, "photo.seen", x, y) == 1 ? 1 : 0.25, 1e-5);
      }
    }
    EXPECT_GT(seen, 10000);
    EXPECT_GT(hidden, 3000);
    EXPECT_EQ(wrong, 0) << static_cast<int>(technique);
  }
}

// Row 108: an image cast on one plane, carried to another, follows the homography between them. The photograph's colours are its
// own coordinates, so that every pixel of the render says which point of it it shows.
TEST(Segal1992Photograph, FromPlaneToPlaneIsTheHomography) {
  constexpr int kPhotoWidth = 400, kPhotoHeight = 300, kWidth = 360, kHeight = 270;
  const View photo = photograph_view({-2, 1, 6}, {0.5, 0, 0}, 350, {190, 155}, kPhotoWidth, kPhotoHeight);
  const View camera = photograph_view({3, 0.5, 5}, {0, 0, 0}, 300, {179.5, 134.5}, kWidth, kHeight);
  Scene scene;
  add_object(scene, "wall", wall(4, 3, 0));
  add_photograph(scene, "photo", photo, kPhotoWidth, kPhotoHeight, [](int x, int y) {
    return glm::vec3(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, 1);
  });
  const Renderer renderer = make_renderer(std::move(scene));
  const LayeredImage image = render(renderer, camera, photo_settings(kWidth, kHeight));
  int compared = 0;
  double worst = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (at(image, "photo.seen", x, y) != 1) continue;
      const glm::dvec2 wall_point = on_facade(camera, kWidth, kHeight, {x + 0.5, y + 0.5});
      const glm::dvec2 expected = in_picture(photo, kPhotoWidth, kPhotoHeight, {wall_point, 0});
      // At the photograph's own rim its last texels go on.
      if (expected.x < 4 || expected.y < 4 || expected.x > kPhotoWidth - 4 || expected.y > kPhotoHeight - 4)
        continue;
      worst = std::max(worst, glm::length(glm::dvec2(at(image, "R", x, y), at(image, "G", x, y)) - expected));
      ++compared;
    }
  }
  EXPECT_GT(compared, 30000);
  EXPECT_LT(worst, 0.1);
}

// Row 15: dots on the facade stay within half a pixel of where they are, over a flight of 100 pictures.
TEST(Segal1992Photograph, NothingSwimsDuringAFlight) {
  constexpr int kPhotoWidth = 480, kPhotoHeight = 360, kWidth = 240, kHeight = 180, kFrames = 100;
  const View photos[] = {
      photograph_view({-3, 1, 7}, {-0.5, 0, 0}, 420, {239.5, 179.5}, kPhotoWidth, kPhotoHeight),
      photograph_view({3, 0, 7}, {0.5, 0, 0}, 420, {239.5, 179.5}, kPhotoWidth, kPhotoHeight)};
  const std::vector<glm::dvec2> dots = {{-1.5, 1.2}, {0.2, 0.3}, {1.4, -0.9}, {-1.2, -1.1}, {1.3, 1.0}};
  constexpr double kRadius = 0.06;
  Scene scene;
  add_object(scene, "wall", wall(4, 3, 0));
  for (const View& photo : photos) {
    add_photograph(scene, &photo == &photos[0] ? "left" : "right", photo, kPhotoWidth, kPhotoHeight,
                   [&](int x, int y) {
                     const glm::dvec2 p = on_facade(photo, kPhotoWidth, kPhotoHeight, {x + 0.5, y + 0.5});
                     double value = 0;
                     for (const glm::dvec2& dot : dots)
                       value += std::exp(-glm::dot(p - dot, p - dot) / (kRadius * kRadius));
                     return glm::vec3(static_cast<float>(value));
                   });
  }
  const Renderer renderer = make_renderer(std::move(scene));
  RenderSettings settings;
  settings.width = kWidth, settings.height = kHeight;
  double worst = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const double t = static_cast<double>(frame) / (kFrames - 1);
    const View camera = photograph_view({-2.5 + 5 * t, 1 - 2 * t, 7 - 2 * std::sin(3 * t)}, {0, 0, 0}, 200,
                                        {119.5, 89.5}, kWidth, kHeight);
    const LayeredImage image = render(renderer, camera, settings);
    for (const glm::dvec2& dot : dots) {
      const glm::dvec2 expected = in_picture(camera, kWidth, kHeight, {dot, 0});
      double sum = 0;
      glm::dvec2 centre(0);
      for (int y = static_cast<int>(expected.y) - 8; y <= static_cast<int>(expected.y) + 8; ++y) {
        for (int x = static_cast<int>(expected.x) - 8; x <= static_cast<int>(expected.x) + 8; ++x) {
          const double value = at(image, "R", x, y);
          sum += value;
          centre += value * glm::dvec2(x + 0.5, y + 0.5);
        }
      }
      ASSERT_GT(sum, 1);
      worst = std::max(worst, glm::length(centre / sum - expected));
    }
  }
  EXPECT_LT(worst, 0.5);
}

// Largest difference of neighbours along the middle rows of a grey wall, in codes of 255.
int largest_step(const LayeredImage& image) {
  int largest = 0;
  for (const char* channel : {"R", "G", "B"}) {
    for (int y = image.height / 4; y < image.height * 3 / 4; y += 5) {
      for (int x = 1; x < image.width; ++x) {
        if (at(image, "photo.seen", x - 1, y) < 1 || at(image, "photo.seen", x, y) < 1) continue;
        largest = std::max(
            largest, std::abs(code_of(at(image, channel, x, y)) - code_of(at(image, channel, x - 1, y))));
      }
    }
  }
  return largest;
}

// Photographs of different exposure and white balance, made to agree: no step at their seams reaches 2/255, be the seams
// feathered or hard.
TEST(Segal1992Photograph, GainsHideTheSeams) {
  constexpr int kWidth = 200, kHeight = 150;
  const glm::vec3 exposures[] = {{1, 1, 1}, {0.6F, 0.7F, 0.65F}, {1.3F, 1.2F, 1.25F}};
  for (const double feather : {0.0, 0.1}) {
    Scene scene;
    add_object(scene, "wall", wall(4, 3, 0));
    for (int i = 0; i < 3; ++i) {
      const View view = photograph_view({-2.2 + 2.2 * i, 0.1 * i, 6}, {-2 + 2 * i, 0, 0}, 330, {99.5, 74.5},
                                        kWidth, kHeight);
      add_photograph(
          scene, "photo " + std::to_string(i), view, kWidth, kHeight,
          [&](int x, int y) {
            const glm::dvec2 p = on_facade(view, kWidth, kHeight, {x + 0.5, y + 0.5});
            return exposures[i] * static_cast<float>(0.4 + 0.02 * p.x);
          },
          true);
    }
    scene.photograph_settings.feather = feather;
    Renderer renderer = make_renderer(std::move(scene));
    const View camera = photograph_view({0, 0, 9}, {0, 0, 0}, 240, {119.5, 79.5}, 240, 160);
    RenderSettings settings;
    settings.width = 240, settings.height = 160;
    settings.layers = {Layer::photographs};
    if (feather == 0) {
      EXPECT_GT(largest_step(render(renderer, camera, settings)), 10);
    }
    const Result<std::vector<glm::vec3>> gains = balance_photographs(renderer);
    ASSERT_TRUE(gains.has_value());
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR((*gains)[0][c] / (*gains)[1][c], exposures[1][c], 0.005);
      EXPECT_NEAR((*gains)[0][c] / (*gains)[2][c], exposures[2][c], 0.01);
      EXPECT_NEAR((*gains)[0][c] * (*gains)[1][c] * (*gains)[2][c], 1, 1e-4);
    }
    ASSERT_TRUE(renderer.set_photograph_gains(*gains).has_value());
    EXPECT_LT(largest_step(render(renderer, camera, settings)), 2);
  }
}

// A facade of known colours, photographed from four places and looked at from a fifth: what any photograph sees is as it is, but
// for pixels of photographs that show two things at once. Where seams are feathered, these count less.
TEST(Segal1992Photograph, APhotographedFacadeLooksAsItDoes) {
  constexpr int kWidth = 240, kHeight = 160, kPhotoWidth = 480, kPhotoHeight = 320;
  Scene truth = facade();
  const int picture = add_picture(truth, 8, 8, [](int x, int y) {
    return glm::u8vec3(60 + 20 * ((3 * x + 5 * y) % 8), 80 + 15 * ((5 * x + y) % 8),
                       100 + 10 * ((x + 7 * y) % 8));
  });
  for (std::size_t i = 0; i < truth.materials.size(); ++i) {
    truth.materials[i].unlit = true;
    truth.materials[i].base_color =
        glm::vec4(1, 1 - 0.15F * static_cast<float>(i), 0.4F + 0.15F * static_cast<float>(i), 1);
    truth.materials[i].base_color_texture.picture = picture;
  }
  Scene photographed = facade();
  const Renderer original = make_renderer(std::move(truth));
  RenderSettings settings = photo_settings(kPhotoWidth, kPhotoHeight);
  settings.layers.clear();
  for (const glm::dvec3 place :
       {glm::dvec3(-4, 1, 8), glm::dvec3(-1.5, 0, 8), glm::dvec3(1.5, 2, 8), glm::dvec3(4, 1, 8)}) {
    const View view =
        photograph_view(place, {0.3 * place.x, 0, 0}, 400, {239.5, 159.5}, kPhotoWidth, kPhotoHeight);
    const LayeredImage photo = render(original, view, settings);
    add_photograph(photographed, "from " + std::to_string(place.x), view, kPhotoWidth, kPhotoHeight,
                   [&](int x, int y) {
                     return glm::vec3(at(photo, "R", x, y), at(photo, "G", x, y), at(photo, "B", x, y));
                   });
  }
  const View camera = photograph_view({0.5, 1, 7.5}, {0, 0, 0}, 200, {119.5, 79.5}, kWidth, kHeight);
  settings = photo_settings(kWidth, kHeight);
  const LayeredImage expected = render(original, camera, settings);
  double squares_before = 1e9;
  for (const double feather : {0.0, 0.05}) {
    photographed.photograph_settings.feather = feather;
    const LayeredImage image = render(make_renderer(photographed), camera, settings);
    double squares = 0;
    int seen = 0, off = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (at(image, "photo.seen", x, y) < 1) continue;
        double largest = 0;
        for (const char* channel : {"R", "G", "B"})
          largest = std::max(
              largest, std::abs(static_cast<double>(at(image, channel, x, y)) - at(expected, channel, x, y)));
        squares += largest * largest;
        off += largest > 0.05 ? 1 : 0;
        ++seen;
      }
    }
    EXPECT_GT(seen, kWidth * kHeight / 2);
    EXPECT_LT(off, seen / 50);
    EXPECT_GT(-10 * std::log10(squares / seen), 32);
    EXPECT_LT(squares, squares_before);
    squares_before = squares;
  }
}

// Of several photographs the weights are (ρ cos θ)², and shares add up to 1.
TEST(Segal1992Photograph, SharesFollowAngleAndResolution) {
  Scene scene;
  add_object(scene, "wall", wall(4, 3, 0));
  const View near = photograph_view({0, 0, 3}, {0, 0, 0}, 200, {99.5, 99.5}, 200, 200);
  const View slanted = photograph_view({4, 0, 4}, {0, 0, 0}, 400, {199.5, 199.5}, 400, 400);
  add_photograph(scene, "near", near, 200, 200, [](int, int) { return glm::vec3(1, 0, 0); });
  add_photograph(scene, "slanted", slanted, 400, 400, [](int, int) { return glm::vec3(0, 1, 0); });
  scene.photograph_settings.feather = 0;
  const Renderer renderer = make_renderer(std::move(scene));
  const LayeredImage image = render(renderer, photograph_view({0, 0, 5}, {0, 0, 0}, 300, {50, 50}, 101, 101),
                                    photo_settings(101, 101));
  // At the origin: 200² / 3² square-on, and 400² / 32 at 45°.
  const double a = 200.0 * 200 / 9, b = 400.0 * 400 / 32 * 0.5;
  const double share = a * a / (a * a + b * b);
  EXPECT_NEAR(at(image, "photo.weight.near", 50, 50), share, 1e-3);
  EXPECT_NEAR(at(image, "photo.weight.near", 50, 50) + at(image, "photo.weight.slanted", 50, 50), 1, 1e-6);
  EXPECT_NEAR(at(image, "R", 50, 50), share, 1e-3);
  EXPECT_NEAR(at(image, "G", 50, 50), 1 - share, 1e-3);
  EXPECT_EQ(at(image, "photo.seen", 50, 50), 2);
}

// The same bits on every instruction set and for every number of threads; and lit photographs are base colours.
TEST(Segal1992Photograph, IsTheSameEverywhereAndCanBeLit) {
  constexpr int kWidth = 130, kHeight = 90;
  const auto draw = [&](int threads, InstructionSet set, bool is_lit) {
    Scene scene = facade();
    for (int i = 0; i < 2; ++i) {
      const View view = photograph_view({-3.0 + 5 * i, 1, 8}, {0, 0, 0}, 130, {70, 40}, kWidth, kHeight);
      add_photograph(scene, "photo " + std::to_string(i), view, kWidth, kHeight, noise, true);
    }
    scene.photograph_settings.are_lit = is_lit;
    scene.ambient = glm::vec3(0.5F);
    scene.ambient_is_set = true;
    const Renderer renderer = make_renderer(std::move(scene), threads, set);
    return render(renderer, photograph_view({1, 2, 8}, {0, 0, 0}, 140, {64, 44}, kWidth, kHeight),
                  photo_settings(kWidth, kHeight));
  };
  const LayeredImage first = draw(1, InstructionSet::scalar, false);
  for (const InstructionSet set : supported_instruction_sets())
    EXPECT_EQ(count_different_pixels(first, draw(3, set, false)), 0U) << name_of(set);
  const LayeredImage lit = draw(1, InstructionSet::scalar, true);
  for (int x = 0; x < kWidth; x += 7) EXPECT_NEAR(at(lit, "R", x, 45), 0.5F * at(first, "R", x, 45), 1e-6);
}

}  // namespace
}  // namespace laterna
