#include "growth_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace laterna::growth {
namespace {

// What is told of each row.
struct Column {
  std::string name;
  std::function<double(const RowCost&)> value;
};

std::vector<Column> columns_of(const Table& table) {
  std::vector<Column> columns;
  if (table.poses_anew) columns.push_back({"pose", [](const RowCost& c) { return c.pose_ms; }});
  columns.push_back({"maps", [](const RowCost& c) { return c.maps.total(); }});
  for (std::size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    const std::string name(name_of(stage));
    if (!table.of_maps) {
      columns.push_back({name, [stage](const RowCost& c) { return c.picture[stage]; }});
    } else if (stage <= Stage::raster) {
      columns.push_back({"maps: " + name, [stage](const RowCost& c) { return c.maps[stage]; }});
    }
  }
  if (table.of_maps) {
    columns.push_back({"shadow", [](const RowCost& c) { return c.picture[Stage::shadow]; }});
  }
  columns.push_back({"frame", [](const RowCost& c) { return c.frame_ms; }});
  return columns;
}

Result<RowCost> measure(const Row& row, const app::FrameSeries& series,
                        const std::filesystem::path& picture) {
  Result<app::Subject> subject = row.prepare();
  if (!subject) return tl::unexpected(subject.error());
  subject->settings.keep_shadow_maps = row.keeps_maps;
  const Result<app::FrameCosts> costs = app::draw_series(*subject, series, picture);
  if (!costs) return tl::unexpected(costs.error());
  RowCost cost;
  cost.pose_ms = costs->pose().median;
  cost.frame_ms = costs->frame().median;
  cost.maps = costs->stages(&RenderStatistics::map_stages);
  cost.picture = costs->stages(&RenderStatistics::picture_stages);
  return cost;
}

// Median over the rounds.
double median_of(const std::vector<RowCost>& rounds, const std::function<double(const RowCost&)>& value) {
  std::vector<double> values;
  std::transform(rounds.begin(), rounds.end(), std::back_inserter(values), value);
  return app::timing_of(std::move(values)).median;
}

std::string number(double value) {
  if (value < 0.005) return "–";
  const int decimals = value < 1 ? 2 : value < 100 ? 1 : 0;
  return fmt::format("{:.{}f}", value, decimals);
}

void print_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  fmt::print("{}\n", line);
}

using Rounds = std::vector<std::vector<RowCost>>;  // by row

void print_head(const Table& table, const char* unit, const char* last) {
  std::vector<std::string> head = {fmt::format("{}, {}", table.name, unit)};
  for (const Column& column : columns_of(table)) head.push_back(column.name);
  if (*last != '\0') head.emplace_back(last);
  print_line(head);
  print_line(std::vector<std::string>(head.size(), "---"));
}

void print_milliseconds(const Table& table, const Rounds& rounds) {
  print_head(table, "ms", "peak MB");
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::vector<std::string> cells = {table.rows[r].label};
    for (const Column& column : columns_of(table))
      cells.push_back(number(median_of(rounds[r], column.value)));
    cells.push_back(fmt::format("{:.0f}", median_of(rounds[r], [](const RowCost& c) { return c.peak_mb; })));
    print_line(cells);
  }
  fmt::print("\n");
}

void print_per_item(const Table& table, const Rounds& rounds) {
  if (table.item.empty()) return;
  print_head(table, fmt::format("ns per {}", table.item).c_str(), "");
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::vector<std::string> cells = {table.rows[r].label};
    for (const Column& column : columns_of(table)) {
      cells.push_back(number(median_of(rounds[r], column.value) * 1e6 / table.rows[r].items));
    }
    print_line(cells);
  }
  fmt::print("\n");
}

// Where a stage that matters costs a quarter more per item than in the row before: the knees to explain.
void print_knees(const Table& table, const Rounds& rounds) {
  if (table.item.empty()) return;
  for (const Column& column : columns_of(table)) {
    for (std::size_t r = 1; r < table.rows.size(); ++r) {
      const double now = median_of(rounds[r], column.value);
      const double before = median_of(rounds[r - 1], column.value);
      const double frame = median_of(rounds[r], [](const RowCost& c) { return c.frame_ms; });
      const double growth = (now / table.rows[r].items) / (before / table.rows[r - 1].items);
      if (now < 0.03 * frame || growth < 1.25) continue;
      fmt::print("- {}: {:.2f} times as much per {} at {} as at {}\n", column.name, growth, table.item,
                 table.rows[r].label, table.rows[r - 1].label);
    }
  }
  fmt::print("\n");
}

}  // namespace

bool print_growth(const Table& table, const Effort& effort) {
  Rounds rounds(table.rows.size());
  app::FrameSeries series = effort.series;
  series.poses_anew = table.poses_anew;
  series.seconds_per_frame = table.seconds_per_frame;
  for (int round = 0; round < effort.rounds; ++round) {
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      fmt::print(stderr, "{}: round {} of {}, {}\n", table.name, round + 1, effort.rounds,
                 table.rows[r].label);
      std::filesystem::path picture;
      if (!effort.pictures.empty())
        picture = effort.pictures / fmt::format("{}-{}.png", table.name, table.rows[r].label);
      const Result<RowCost> cost =
          run_in_own_process([&] { return measure(table.rows[r], series, picture); });
      if (!cost) {
        fmt::print(stderr, "{}, {}: {}\n", table.name, table.rows[r].label, to_string(cost.error()));
        return false;
      }
      rounds[r].push_back(*cost);
    }
  }
  fmt::print("### {}\n\n{}\n\n", table.name, table.title);
  print_milliseconds(table, rounds);
  print_per_item(table, rounds);
  print_knees(table, rounds);
  std::fflush(stdout);
  return true;
}

}  // namespace laterna::growth
