// What the writers of films have in common: frames in, a file out.
#pragma once

#include <string>

#include "laterna/image.h"
#include "laterna/result.h"

namespace laterna::image {

class FilmEncoder {
 public:
  FilmEncoder() = default;
  FilmEncoder(const FilmEncoder&) = delete;
  FilmEncoder& operator=(const FilmEncoder&) = delete;
  virtual ~FilmEncoder() = default;

  /// 8-bit R, G, B of the film's size.
  virtual Result<void> write(const Image& frame) = 0;
  /// The file's end. Nothing is written after it.
  virtual Result<void> finish() = 0;
};

}  // namespace laterna::image
