// A table of how the cost of a frame grows with one number, as Markdown.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "frame_costs.h"
#include "own_process.h"

namespace laterna::growth {

struct Row {
  std::string label;
  double items = 0;  ///< how many of what the table is about
  std::function<Result<app::Subject>()> prepare;
  bool keeps_maps = false;
};

struct Table {
  std::string name;   ///< on the command line
  std::string title;  ///< what grows, and what stays
  std::string item;   ///< "triangle"; empty: costs per item say nothing
  std::vector<Row> rows = {};
  bool poses_anew = true;        ///< geometry is posed before each frame, and that is part of the frame
  double seconds_per_frame = 0;  ///< of scene time, where things move of themselves
  bool of_maps =
      false;  ///< tells the stages of shadow maps, and of the picture only how long it looks them up
};

struct Effort {
  int rounds = 3;                       ///< all rows, one after the other, so often
  app::FrameSeries series;              ///< of each row in each round
  std::filesystem::path pictures = {};  ///< a folder for the last frame of every row; empty: nowhere
};

/// Measures and prints: milliseconds by stage, and nanoseconds per item. False where a row could not be measured.
bool print_growth(const Table& table, const Effort& effort);

}  // namespace laterna::growth
