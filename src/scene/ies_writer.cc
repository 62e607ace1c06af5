#include "scene/ies_writer.h"

#include <fmt/format.h>

#include "scene/ies_reader.h"

namespace laterna {
namespace {

// LM-63-2002 allows lines of 256 characters.
constexpr std::size_t kLongestLine = 256;

std::string plain(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return text;
}

void append_numbers(std::string& text, std::span<const double> numbers) {
  std::size_t line = 0;
  for (const double number : numbers) {
    const std::string word = fmt::format("{}", number);
    if (line > 0 && line + 1 + word.size() > kLongestLine) {
      text += '\n';
      line = 0;
    }
    if (line > 0) text += ' ';
    text += word;
    line += word.size() + 1;
  }
  text += '\n';
}

// The planes as a file has them: those of type C once round from 0, and one that stands for all of a lamp that is round.
std::vector<std::size_t> planes_of(const LightDistribution& lamp) {
  const std::vector<double>& angles = lamp.horizontal_deg;
  std::vector<std::size_t> planes;
  for (std::size_t h = 0; h < angles.size(); ++h) {
    if (lamp.type != PhotometricType::type_c || (angles[h] >= 0 && angles[h] < 360)) planes.push_back(h);
  }
  const bool is_round = planes.size() == 1, begins_at_zero = !planes.empty() && angles[planes.front()] == 0;
  if (lamp.type == PhotometricType::type_c && !is_round && begins_at_zero && angles.back() == 360)
    planes.push_back(angles.size() - 1);
  return planes;
}

std::string text_of(const LightDistribution& lamp) {
  const std::vector<std::size_t> planes = planes_of(lamp);
  // The keywords that the edition requires; "-" is what nobody knows.
  std::string text =
      fmt::format("IESNA:LM-63-2002\n[TEST] -\n[TESTLAB] -\n[ISSUEDATE] -\n[MANUFAC]\n[LUMINAIRE] {}\n",
                  plain(lamp.luminaire));
  if (lamp.tilt.empty()) {
    text += "TILT=NONE\n";
  } else {
    std::vector<double> angles, factors;
    for (const auto& [angle, factor] : lamp.tilt) {
      angles.push_back(angle);
      factors.push_back(factor);
    }
    text += fmt::format("TILT=INCLUDE\n1\n{}\n", lamp.tilt.size());
    append_numbers(text, angles);
    append_numbers(text, factors);
  }
  const int type = lamp.type == PhotometricType::type_c ? 1 : lamp.type == PhotometricType::type_b ? 2 : 3;
  // One lamp, no multiplier, metres; −1 lumen: absolute. Width and length are along Y and X.
  text += fmt::format("1 {} 1 {} {} {} 2 {} {} {}\n1 1 {}\n", lamp.rated_lumens.value_or(-1),
                      lamp.vertical_deg.size(), planes.size(), type, lamp.opening_m.y, lamp.opening_m.x,
                      lamp.opening_m.z, lamp.watts);
  append_numbers(text, lamp.vertical_deg);
  std::vector<double> angles;
  angles.reserve(planes.size());
  for (const std::size_t plane : planes) angles.push_back(lamp.horizontal_deg[plane]);
  append_numbers(text, angles);
  const std::size_t count = lamp.vertical_deg.size();
  for (const std::size_t plane : planes)
    append_numbers(text, std::span(lamp.candela).subspan(plane * count, count));
  return text;
}

}  // namespace

tl::expected<std::string, std::string> write_ies(const LightDistribution& lamp) {
  std::string text = text_of(lamp);
  // What its planes mean depends on where they begin and end: reading them is the proof.
  const Result<LightDistribution> read = read_ies(text, "LM-63", {});
  if (!read) return tl::unexpected("LM-63 cannot hold the lamp: " + to_string(read.error()));
  const bool is_same = read->type == lamp.type && read->vertical_deg == lamp.vertical_deg &&
                       read->horizontal_deg == lamp.horizontal_deg && read->candela == lamp.candela &&
                       read->rated_lumens == lamp.rated_lumens && read->opening_m == lamp.opening_m &&
                       read->tilt == lamp.tilt;
  if (!is_same) return tl::unexpected<std::string>("LM-63 would have other planes of the lamp than it has");
  return text;
}

}  // namespace laterna
