// Each possible G code is done as the table in lib/GCode's page says, or refused.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>

#include "host_machine.h"

namespace {

std::string codeNamed(int tenths) {
  std::string name = "G" + std::to_string(tenths / 10);
  if (tenths % 10 != 0) name += "." + std::to_string(tenths % 10);
  return name;
}

/// The codes in the rows of the page that end with `done`, in tenths.
std::set<int> doneCodes() {
  std::ifstream page("lib/GCode/README.md");
  const std::regex code("G(\\d+)(\\.(\\d))?( to G(\\d+))?");
  std::set<int> codes;
  for (std::string line; std::getline(page, line);) {
    if (line.compare(0, 3, "| G") != 0 || line.rfind("| done |") == std::string::npos) continue;
    const std::string cell = line.substr(2, line.find('|', 2) - 2);
    for (std::sregex_iterator at(cell.begin(), cell.end(), code), end; at != end; ++at) {
      const int first = 10 * std::stoi((*at)[1]) + ((*at)[3].matched ? std::stoi((*at)[3]) : 0);
      const int last = (*at)[5].matched ? 10 * std::stoi((*at)[5]) : first;
      for (int tenths = first; tenths <= last; tenths += 10) codes.insert(tenths);
    }
  }
  return codes;
}

/// The words of a code that needs other words than a place on the sheet.
std::string wordsFor(int tenths) {
  switch (tenths) {
    case 40:
      return " P1";
    case 100:
      return " L2 P6 X1";
    case 20:
      return " X1 R500";
    case 281:
    case 301:
      return "";
    case 382:
    case 383:
      return " Z-1";
    case 384:
    case 385:
    case 431:
      return " Z0";
    case 810:
    case 820:
    case 830:
      return " X0 Z0 R0 Q1 F800";
    case 30:
      return " X0 R500";
    default:
      return " X0";
  }
}

/// The height [mm] at which the probe touches, for a code that goes on until it does or lets go.
std::string probeFor(int tenths) {
  return tenths == 383 ? "-1000" : tenths == 384 ? "-1.2" : tenths == 385 ? "1000" : "-0.5";
}

/// Codes that do not affect the next line.
const char* const kTidyUp = "G0 G17 G21 G40 G54 G90 G91.1 G94 G98";

/// A step; a failure names the line that was sent last.
void push(std::vector<Step>& steps, Step::Kind kind, const std::string& text) {
  steps.push_back({kind, text, kind == Step::kSend ? text : steps.back().place});
}

}  // namespace

TEST(EveryGCode, OutsideTheTableIsRefusedAndMovesNothing) {
  const std::set<int> done = doneCodes();
  ASSERT_GT(done.size(), 45u);
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  push(steps, Step::kSend, "$70=1");
  push(steps, Step::kExpect, "ok");
  // Beyond G99 no tenths are in use anywhere.
  for (int tenths = 0; tenths < 9999; tenths += tenths < 1000 ? 1 : 10) {
    if (done.count(tenths) != 0) continue;
    push(steps, Step::kSend, codeNamed(tenths) + " X100 Y50");
    push(steps, Step::kExpect, "error: this machine does no " + codeNamed(tenths));
  }
  push(steps, Step::kAsk, "wait 0.5");
  push(steps, Step::kAsk, "sled X0 Y0 within 0.05");
  EXPECT_GT(steps.size(), 3000u);
  EXPECT_EQ("", HostMachine(steps).play());
}

TEST(EveryGCode, OfTheTableIsDone) {
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  push(steps, Step::kSend, "$70=1");
  push(steps, Step::kExpect, "ok");
  push(steps, Step::kSend, "G28.1 G30.1");
  push(steps, Step::kExpect, "ok");
  for (const int tenths : doneCodes()) {
    push(steps, Step::kSend, kTidyUp);
    push(steps, Step::kExpect, "ok");
    push(steps, Step::kAsk, "probe " + probeFor(tenths));
    push(steps, Step::kAsk, "answers from now");
    push(steps, Step::kSend, codeNamed(tenths) + (tenths == 800 ? "" : wordsFor(tenths)));
    push(steps, Step::kSkipTo, "ok");
    push(steps, Step::kAsk, "answers 1");
  }
  push(steps, Step::kAsk, "wait 1");
  push(steps, Step::kAsk, "answers from now");
  EXPECT_EQ("", HostMachine(steps).play());
}

TEST(EveryModeCode, LeavesCoordinatesOnItsLineToTheCurrentMotion) {
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  int x = 0;
  for (const int tenths : doneCodes()) {
    // Motion, cycles, and codes that take the place words.
    const bool takes_place = tenths < 50 || tenths == 100 || (tenths >= 280 && tenths <= 301) ||
                             (tenths >= 382 && tenths <= 385) || tenths == 431 ||
                             (tenths >= 800 && tenths <= 830) || tenths == 910 || tenths == 200 ||
                             tenths == 920;
    if (takes_place) continue;
    x = x == 5 ? 0 : 5;
    const std::string place = "X" + std::to_string(x);
    push(steps, Step::kSend, kTidyUp);
    push(steps, Step::kSkipTo, "ok");
    push(steps, Step::kSend, codeNamed(tenths) + " " + place);
    push(steps, Step::kSkipTo, "ok");
    push(steps, Step::kSend, "G4 P0");
    push(steps, Step::kSkipTo, "ok");
    push(steps, Step::kAsk, "wait 0.3");
    push(steps, Step::kAsk,
         "status <Idle,MPos:" + std::to_string(x) +
             ".00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.02");
  }
  EXPECT_GT(steps.size(), 200u);
  EXPECT_EQ("", HostMachine(steps).play());
}
