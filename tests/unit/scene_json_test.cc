// JSON with places: paths, lines, duplicate keys, suggestions.
#include <gtest/gtest.h>

#include <array>

#include "scene/fault_list.h"
#include "scene/json_document.h"
#include "scene/json_object.h"
#include "scene/spelling.h"

namespace laterna {
namespace {

std::string fault_of(std::string_view text) {
  const Result<JsonDocument> json = JsonDocument::parse(text, "f", JsonDocument::Place::path);
  return json ? "none" : to_string(json.error());
}

TEST(SceneJson, EveryValueKnowsItsPathAndLine) {
  const std::string text =
      "{\n \"a\": [1,\n  2,\n  {\"b\": true}\n ],\n \"c\": {\"d\": 7\n }, \"e\":\n \"text\"}";
  const Result<JsonDocument> json = JsonDocument::parse(text, "f", JsonDocument::Place::line_and_path);
  ASSERT_TRUE(json.has_value());
  const JsonValue& root = json->root();
  const JsonValue& a = *root.find("a");
  EXPECT_EQ(json->place(root), "line 1");
  EXPECT_EQ(json->place(a), "line 2: a");
  EXPECT_EQ(json->place(a.children[0]), "line 2: a[0]");
  EXPECT_EQ(json->place(a.children[1]), "line 3: a[1]");
  EXPECT_EQ(json->place(a.children[2]), "line 4: a[2]");
  EXPECT_EQ(json->place(*a.children[2].find("b")), "line 4: a[2].b");
  EXPECT_EQ(json->place(*root.find("c")->find("d")), "line 6: c.d");
  EXPECT_EQ(json->place(*root.find("e")), "line 7: e");  // where the key is
  EXPECT_EQ(json->place(root, "missing"), "line 1: missing");
}

TEST(SceneJson, NumbersAtTheEndOfALineBelongToThatLine) {
  const std::string text = "[1\n,2\n\n,3]";
  const Result<JsonDocument> json = JsonDocument::parse(text, "f", JsonDocument::Place::line_and_path);
  ASSERT_TRUE(json.has_value());
  EXPECT_EQ(json->place(json->root().children[0]), "line 1: [0]");
  EXPECT_EQ(json->place(json->root().children[1]), "line 2: [1]");
  EXPECT_EQ(json->place(json->root().children[2]), "line 4: [2]");
}

TEST(SceneJson, WhatIsNoJsonIsRefusedWithItsLine) {
  EXPECT_EQ(fault_of("{\"a\": 1,\n \"b\": NaN}").substr(0, 37), "f: line 2: b: not valid JSON: syntax ");
  EXPECT_EQ(fault_of("{\"a\": [1, 2,\n Infinity]}").substr(0, 40),
            "f: line 2: a[2]: not valid JSON: syntax ");
  EXPECT_EQ(fault_of("").substr(0, 26), "f: line 1: not valid JSON:");
  EXPECT_EQ(fault_of("{} {}").substr(0, 26), "f: line 1: not valid JSON:");
  EXPECT_EQ(fault_of("{\"a\": 1e999}").substr(0, 43), "f: line 1: a: not valid JSON: number overfl");
  EXPECT_EQ(fault_of("{\n// no comments\n}").substr(0, 26), "f: line 2: not valid JSON:");
  EXPECT_EQ(fault_of("[1,]").substr(0, 27), "f: line 1: [1]: not valid J");
  EXPECT_EQ(fault_of("\"\xFF\"").substr(0, 26), "f: line 1: not valid JSON:");
}

TEST(SceneJson, DuplicateKeysAreRefused) {
  EXPECT_EQ(fault_of("{\"a\": {\"x\": 1,\n\"y\": 2,\n\"x\": 3}}"),
            "f: line 3: a: the key \"x\" appears twice");
}

TEST(SceneJson, NestingIsLimited) {
  std::string deep(256, '[');
  EXPECT_EQ(fault_of(deep + std::string(256, ']')), "none");
  deep += '[';
  EXPECT_NE(fault_of(deep + std::string(257, ']')).find("nested more than 256 deep"), std::string::npos);
  EXPECT_NE(fault_of(std::string(1000000, '[')).find("nested more than 256 deep"), std::string::npos);
}

TEST(SceneJson, RangesReadLikeSentences) {
  EXPECT_EQ(kAnyNumber.expectation(), "a number");
  EXPECT_EQ(kPositive.expectation(), "a number greater than 0");
  EXPECT_EQ(kNotNegative.expectation(), "a number of at least 0");
  EXPECT_EQ(kZeroToOne.expectation(), "a number from 0 to 1");
  EXPECT_EQ((NumberRange{0, 180, true, true}.expectation()), "a number between 0 and 180");
  EXPECT_FALSE(kPositive.holds(0));
  EXPECT_TRUE(kZeroToOne.holds(0));
}

TEST(SceneJson, WholeNumbersAreCheckedBeforeTheyAreConverted) {
  const std::string text = R"({"a": -1, "b": 1.5, "c": 1e19, "d": 18446744073709551615, "e": 3.0, "f": "3"})";
  const Result<JsonDocument> json = JsonDocument::parse(text, "f", JsonDocument::Place::path);
  ASSERT_TRUE(json.has_value());
  FaultList faults("");
  JsonObject object(*json, json->root(), faults);
  for (const std::string_view name : {"a", "b", "c", "d", "f"})
    EXPECT_EQ(object.whole(name), std::nullopt) << name;
  EXPECT_EQ(object.whole("e"), 3U);
  EXPECT_EQ(faults.error_count(), 5U);
  EXPECT_EQ(to_string(faults.errors()[2]), "c: expected a whole number of at least 0, got 1e+19");
}

TEST(SceneJson, TheNearestWordIsSuggested) {
  constexpr std::array<std::string_view, 6> known = {"position", "target", "yfov_deg",
                                                     "candela",  "color",  "far"};
  EXPECT_EQ(nearest_word("positon", known), "position");
  EXPECT_EQ(nearest_word("Target", known), "target");
  EXPECT_EQ(nearest_word("traget", known), "target");
  EXPECT_EQ(nearest_word("colour", known), "color");
  EXPECT_EQ(nearest_word("yfov", known), "yfov_deg");
  EXPECT_EQ(nearest_word("candelas", known), "candela");
  EXPECT_EQ(nearest_word("zzz", known), "");
  EXPECT_EQ(nearest_word(std::string(100000, 'a'), known), "");
}

TEST(SceneJson, QuotedNamesAreHarmless) {
  EXPECT_EQ(in_quotes("a\x1B[31m\n"), "\"a?[31m?\"");
  const std::string umlauts = in_quotes("x" + [] {
    std::string all;
    for (int i = 0; i < 100; ++i) all += "ü";
    return all;
  }());
  EXPECT_EQ(umlauts.substr(umlauts.size() - 6), "ü…\"");  // never half a character
}

TEST(SceneJson, FaultsBeyondAHundredAreCounted) {
  FaultList faults("f");
  for (int i = 0; i < 250; ++i) faults.error("p", "m");
  ASSERT_EQ(faults.errors().size(), 101U);
  EXPECT_EQ(to_string(faults.errors().back()), "f: and 150 more faults");
}

}  // namespace
}  // namespace laterna
