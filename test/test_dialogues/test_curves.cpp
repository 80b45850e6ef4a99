// Curves of a hundred arcs, as programs write them: each line is done, and the sled ends at the
// intended place.
#include <gtest/gtest.h>

#include <cstdio>

#include "curves/curve.h"
#include "host_machine.h"

namespace {

/// How a program writes lengths.
struct Text {
  const char* name;
  const char* unit_code;
  double unit;  ///< [mm]
  int decimals;
  bool by_radius;
};

class Curves : public testing::TestWithParam<Text> {};

std::string number(char letter, double mm, const Text& text) {
  char word[40];
  std::snprintf(word, sizeof word, " %c%.*f", letter, text.decimals, mm / text.unit);
  return word;
}

/// The line that cuts an arc.
std::string lineOf(const Meant& meant, const Text& text) {
  std::string line = meant.sweep > 0 ? "G3" : "G2";
  line += number('X', meant.to.x, text) + number('Y', meant.to.y, text);
  if (text.by_radius)
    return line + number('R', std::fabs(meant.sweep) > M_PI ? -meant.radius : meant.radius, text);
  return line + number('I', meant.centre.x - meant.from.x, text) +
         number('J', meant.centre.y - meant.from.y, text);
}

void sendAndExpectOk(std::vector<Step>& steps, const std::string& line) {
  steps.push_back({Step::kSend, line, line});
  steps.push_back({Step::kExpect, "ok", line});
}

}  // namespace

TEST_P(Curves, AreCutLineByLine) {
  const Text& text = GetParam();
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  sendAndExpectOk(steps, text.unit_code);
  Curve curve(5, 0.95 * M_PI);
  Meant last = curve.next();
  sendAndExpectOk(steps, "G0" + number('X', last.to.x, text) + number('Y', last.to.y, text));
  for (int i = 0; i < 100; ++i) {
    last = curve.next();
    sendAndExpectOk(steps, lineOf(last, text) + (i == 0 ? " F10000" : ""));
  }
  steps.push_back({Step::kSend, "G4 P0", "dwell"});
  steps.push_back({Step::kSkipTo, "ok", "dwell"});
  steps.push_back({Step::kAsk, "wait 1", "end"});
  char place[80];
  std::snprintf(place, sizeof place, "sled X%f Y%f within %f", last.to.x, last.to.y,
                0.06 + text.unit * std::pow(10, -text.decimals));
  steps.push_back({Step::kAsk, place, "end"});
  EXPECT_EQ("", HostMachine(steps).play());
}

INSTANTIATE_TEST_SUITE_P(Arcs, Curves,
                         testing::Values(Text{"InchesOfThreeDecimals", "G20", 25.4, 3, false},
                                         Text{"InchesOfFourDecimals", "G20", 25.4, 4, false},
                                         Text{"MillimetresOfTwoDecimals", "G21", 1, 2, false},
                                         Text{"MillimetresOfThreeDecimals", "G21", 1, 3, false},
                                         Text{"InchesByRadius", "G20", 25.4, 4, true},
                                         Text{"MillimetresByRadius", "G21", 1, 3, true}),
                         [](const auto& info) { return info.param.name; });
