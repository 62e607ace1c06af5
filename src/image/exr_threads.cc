#include "image/exr_threads.h"

#include <ImfThreading.h>

#include <algorithm>
#include <thread>

namespace laterna::image {

int exr_threads(int threads) {
  static const int available = [] {
    if (Imf::globalThreadCount() == 0) {
      Imf::setGlobalThreadCount(std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
    }
    return Imf::globalThreadCount();
  }();
  if (threads == 1) return 0;
  return threads <= 0 ? available : std::min(threads, available);
}

}  // namespace laterna::image
