// Bad lamp files, and exactly what is said about each; every truncation of both formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "unit/lamp_texts.h"
#include "unit/temporary_folder.h"

namespace laterna {
namespace {

using namespace testing_lamps;

struct IesCase {
  const char* name;
  void (*break_it)(IesText&);
  const char* message;
};
class InvalidIes : public testing::TestWithParam<IesCase> {};

std::string message_of(const Result<LightDistribution>& lamp) {
  return lamp ? "read" : to_string(lamp.error());
}

// Small: planes at 0 and 90, vertical angles 0, 45 and 90. Numbers begin on line 6.
IesText small_ies() {
  IesText ies;
  ies.vertical = {0, 45, 90};
  ies.horizontal = {0, 90};
  return ies;
}

TEST_P(InvalidIes, IsRefusedWithItsMessage) {
  IesText ies = small_ies();
  GetParam().break_it(ies);
  EXPECT_EQ(message_of(parse(ies.text())), GetParam().message);
}

const IesCase kIesCases[] = {
    {"CandelaNegative",
     [](IesText& i) { i.candela = [](double v, double h) { return v == 45 && h == 90 ? -1.0 : 5.0; }; },
     "lamp.ies: line 11: expected candela value 2 of 3 in plane 2 of 2, from 0 to 1000000000000, got -1"},
    {"CandelaNotANumber",
     [](IesText& i) { i.candela = [](double, double) { return std::numeric_limits<double>::quiet_NaN(); }; },
     "lamp.ies: line 10: expected candela value 1 of 3 in plane 1 of 2, got \"nan\""},
    {"CandelaInfinite", [](IesText& i) { i.multiplier = "1e400"; },
     "lamp.ies: line 6: expected the candela multiplier, got \"1e400\""},
    {"Dark", [](IesText& i) { i.candela = [](double, double) { return 0.0; }; },
     "lamp.ies: every candela value is 0: the lamp gives no light"},
    {"VerticalGoesBack",
     [](IesText& i) {
       i.vertical = {0, 50, 45};
     },
     "lamp.ies: line 8: expected vertical angle 3 of 3 to be more than the 50 before it, got 45"},
    {"VerticalTwice",
     [](IesText& i) {
       i.vertical = {0, 45, 45};
     },
     "lamp.ies: line 8: expected vertical angle 3 of 3 to be more than the 45 before it, got 45"},
    {"VerticalBeyond",
     [](IesText& i) {
       i.vertical = {0, 90, 181};
     },
     "lamp.ies: line 8: expected vertical angle 3 of 3, from 0 to 180, got 181"},
    {"VerticalOfTypeB",
     [](IesText& i) {
       i.type = 2, i.vertical = {-90, 0, 91};
     },
     "lamp.ies: line 8: expected vertical angle 3 of 3, from -90 to 90, got 91"},
    {"HorizontalGoesBack",
     [](IesText& i) {
       i.horizontal = {0, 270, 180};
     },
     "lamp.ies: line 9: expected horizontal angle 3 of 3 to be more than the 270 before it, got 180"},
    {"HorizontalEndsAnywhere",
     [](IesText& i) {
       i.horizontal = {0, 20, 45};
     },
     "lamp.ies: line 9: expected planes from 0 to 90, 0 to 180, 90 to 270 or all round, or a single one, got "
     "0 to 45"},
    {"OnePlaneOfTypeB",
     [](IesText& i) {
       i.type = 2, i.vertical = {-90, 0, 90}, i.horizontal = {0};
     },
     "lamp.ies: line 9: expected at least 2 horizontal angles in photometry of types A and B, got 1"},
    {"TypeFour", [](IesText& i) { i.type = 4; },
     "lamp.ies: line 6: expected the photometric type, a whole number from 1 to 3, got 4"},
    {"UnitThree", [](IesText& i) { i.unit_and_opening = "3 0 0 0"; },
     "lamp.ies: line 6: expected the unit (1 feet, 2 metres), a whole number from 1 to 2, got 3"},
    {"OneVerticalAngle", [](IesText& i) { i.vertical = {0}; },
     "lamp.ies: line 6: expected the number of vertical angles, a whole number from 2 to 10000, got 1"},
    {"OneNumberTooMany", [](IesText& i) { i.lamps_and_lumens = "1 -1 1 4", i.multiplier = ""; },
     "lamp.ies: line 8: expected vertical angle 2 of 4 to be more than the 10 before it, got 0"},
    {"MultiplierZero", [](IesText& i) { i.multiplier = "0"; },
     "lamp.ies: line 6: expected the candela multiplier, from 1e-09 to 1000000000, got 0"},
    {"Words", [](IesText& i) { i.factors = "1 1 ten"; },
     "lamp.ies: line 7: expected the input watts, got \"ten\""},
    {"TiltUnknown", [](IesText& i) { i.tilt = "TILT=a.tlt\n"; },
     "lamp.ies: line 5: expected TILT=NONE, TILT=INCLUDE or a file; \"a.tlt\" not found (tried "
     "\"/nonexistent/a.tlt\")"},
    {"TiltGeometry", [](IesText& i) { i.tilt = "TILT=INCLUDE\n4\n1\n0\n1\n"; },
     "lamp.ies: line 6: expected the lamp-to-luminaire geometry, a whole number from 1 to 3, got 4"},
    {"TiltShort", [](IesText& i) { i.tilt = "TILT=INCLUDE\n1\n2\n0 90\n1 -1\n"; },
     "lamp.ies: line 9: expected multiplying factor 2 of 2, from 0 to 1000000000, got -1"},
    {"NoTilt", [](IesText& i) { i.tilt = ""; },
     "lamp.ies: line 10: the file ends before a line that begins with TILT="},
};
INSTANTIATE_TEST_SUITE_P(Cases, InvalidIes, testing::ValuesIn(kIesCases),
                         [](const auto& tested) { return std::string(tested.param.name); });

struct LdtCase {
  const char* name;
  void (*break_it)(LdtText&);
  const char* message;
};
class InvalidLdt : public testing::TestWithParam<LdtCase> {};

TEST_P(InvalidLdt, IsRefusedWithItsMessage) {
  LdtText ldt;
  ldt.planes = 4, ldt.vertical = {0, 90, 180};
  GetParam().break_it(ldt);
  EXPECT_EQ(message_of(parse(ldt.text(), "lamp.ldt")), GetParam().message);
}

const LdtCase kLdtCases[] = {
    {"PlanesOdd", [](LdtText& l) { l.symmetry = 4, l.planes = 6; },
     "lamp.ldt: line 4: expected the number of C-planes to be a multiple of 4 with symmetry 4, got 6"},
    {"FluxMissing", [](LdtText& l) { l.lumens = ""; },
     "lamp.ldt: line 29: expected the luminous flux of the lamps, a number from 1e-09 to 1000000000000, got "
     "\"\""},
    {"FactorZero", [](LdtText& l) { l.factor = "0"; },
     "lamp.ldt: line 24: expected the conversion factor of intensities, a number from 1e-09 to 1000000000, "
     "got \"0\""},
    {"AnglesGoBack",
     [](LdtText& l) {
       l.vertical = {0, 90, 30};
     },
     "lamp.ldt: line 49: expected vertical angle 3 of 3 to be more than the 90 before it, got 30"},
    {"Negative", [](LdtText& l) { l.value = [](double v, double) { return v - 1; }; },
     "lamp.ldt: line 50: expected intensity 1 of 3 in plane 1 of 4, from 0 to 1000000000000, got -1"},
    {"Dark", [](LdtText& l) { l.value = [](double, double) { return 0.0; }; },
     "lamp.ldt: every candela value is 0: the lamp gives no light"},
};
INSTANTIATE_TEST_SUITE_P(Cases, InvalidLdt, testing::ValuesIn(kLdtCases),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(InvalidLamp, FilesThatAreNone) {
  EXPECT_EQ(
      message_of(parse("")),
      "lamp.ies: line 1: no lamp file: expected IES LM-63, with a line that begins with TILT=, or EULUMDAT");
  EXPECT_EQ(
      message_of(parse("hello\nworld\n")),
      "lamp.ies: line 2: no lamp file: expected IES LM-63, with a line that begins with TILT=, or EULUMDAT");
  EXPECT_EQ(message_of(parse(std::string_view("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16))),
            "lamp.ies: byte 8: no lamp file: expected text, got binary data");
  EXPECT_EQ(message_of(parse("abc", "lamp.ldt")),
            "lamp.ldt: line 1: the file ends before the luminaire's name (line 9)");
  const Result<LightDistribution> missing = read_lamp_file("/nonexistent/lamp.ies");
  EXPECT_FALSE(missing.has_value());
}

TEST(InvalidLamp, TooManyAndTooFewNumbers) {
  const std::string text = small_ies().text();
  EXPECT_EQ(message_of(parse(text + "7\n")),
            "lamp.ies: line 12: expected the file to end after 2 x 3 candela values, got \"7\"");
  EXPECT_EQ(message_of(parse(text.substr(0, text.rfind(' ')))),
            "lamp.ies: line 11: the file ends before candela value 3 of 3 in plane 2 of 2");
  LdtText ldt;
  EXPECT_EQ(message_of(parse(ldt.text() + "end\n", "lamp.ldt")),
            "lamp.ldt: line 992: expected the file to end after 24 x 37 intensities, got \"end\"");
}

TEST(InvalidLamp, LimitsOnSize) {
  IesText ies = small_ies();
  std::string text = ies.text();
  text.replace(text.find("1 3 2 1 2"), 9, "1 9999 9999 1 2");
  EXPECT_EQ(message_of(parse(text)),
            "lamp.ies: line 7: 9999 times 9999 candela values are more than 4194304");
  text.replace(text.find("9999 9999"), 9, "10001 2");
  EXPECT_EQ(
      message_of(parse(text)),
      "lamp.ies: line 6: expected the number of vertical angles, a whole number from 2 to 10000, got 10001");
}

// A file that ends early is refused, but for cuts within the last number, which leave a number.
TEST(InvalidLamp, EveryTruncationIsRefused) {
  IesText tilted = small_ies();
  tilted.tilt = "TILT=INCLUDE\n1\n2\n0 90\n1 0.9\n";
  LdtText ldt;
  ldt.planes = 4, ldt.vertical = {0, 90, 180}, ldt.symmetry = 4;
  for (const auto& [text, name] : {std::pair{small_ies().text(), "lamp.ies"},
                                   std::pair{tilted.text(), "lamp.ies"}, std::pair{ldt.text(), "lamp.ldt"}}) {
    const std::size_t last_number = text.find_last_of(" \n", text.find_last_not_of(" \r\n")) + 1;
    ASSERT_TRUE(parse(text, name).has_value());
    for (std::size_t length = 0; length <= last_number; ++length) {
      const Result<LightDistribution> lamp = parse(std::string_view(text).substr(0, length), name);
      ASSERT_FALSE(lamp.has_value()) << name << ": " << length;
      ASSERT_FALSE(lamp.error().diagnostics.empty());
    }
    for (std::size_t length = last_number + 1; length < text.size(); ++length)
      (void)parse(std::string_view(text).substr(0, length), name);
  }
}

TEST(InvalidLamp, EveryChangedByteIsReadOrRefused) {
  LdtText ldt;
  ldt.planes = 4, ldt.vertical = {0, 90, 180};
  for (const auto& [text, name] :
       {std::pair{small_ies().text(), "lamp.ies"}, std::pair{ldt.text(), "lamp.ldt"}}) {
    for (std::size_t at = 0; at < text.size(); ++at) {
      for (const char value : {'\0', '\xFF', '-', '9', ' ', '\n'}) {
        std::string changed = text;
        changed[at] = value;
        const Result<LightDistribution> lamp = parse(changed, name);
        EXPECT_TRUE(lamp ? find_fault(*lamp).empty() : !lamp.error().diagnostics.empty());
      }
    }
  }
}

}  // namespace
}  // namespace laterna
