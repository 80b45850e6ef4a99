// Every line, whatever it holds, gets exactly one answer, and the machine keeps working.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "host_machine.h"

namespace {

/// Lines as clients, typing people and broken cables make them; no pauses and no alarms in them.
class Lines {
 public:
  explicit Lines(unsigned seed) : random_(seed) {}

  std::string any() {
    switch (random_() % 8) {
      case 0:
        return noise();
      case 1:
        return setting();
      case 2:
        return chainCode();
      default:
        return code();
    }
  }

 private:
  std::string number() {
    char text[40];
    const double value = std::uniform_real_distribution<double>(-30, 30)(random_);
    std::snprintf(text, sizeof text, random_() % 9 ? "%.*f" : "%.*e", int(random_() % 14), value);
    return text;
  }

  std::string code() {
    const char* const starts[] = {"G0",   "G1",   "g1",  "G2",     "G3",  "G90", "G91",
                                  "G20",  "G21",  "G17", "G4 P20", "G10", "M5",  "M8",
                                  "M106", "M107", "N5 ", "T3",     "",    "G55"};
    std::string line = starts[random_() % 20];
    const char letters[] = "XYZIJRFSxyf";
    for (unsigned i = random_() % 4; i > 0; --i) {
      if (random_() % 2) line += ' ';
      const char letter = letters[random_() % 11];
      // Slow feeds and long ways of z would take half an hour.
      const bool feed = letter == 'F' || letter == 'f';
      line += letter + (feed            ? "800"
                        : letter == 'Z' ? "0." + std::to_string(random_() % 9)
                                        : number());
    }
    if (random_() % 6 == 0) line += " (a comment)";
    return line;
  }

  std::string setting() {
    const char* const forms[] = {
        "$",      "$$",      "$=",    "$9=",   "$15=x", "$43=1",       "$14=2",
        "$300=1", "$9=2000", "$RST=", "$17=0", "$-1=3", "$ 42 = 2.0 ", "$42=-1"};
    return forms[random_() % 14];
  }

  std::string chainCode() {
    const char* const forms[] = {"B01", "B5",  "B05", "B10 L", "B10",
                                 "B20", "B19", "B",   "B00",   "Bxx"};
    return forms[random_() % 10];
  }

  std::string noise() {
    std::string line;
    for (unsigned i = random_() % 40; i > 0; --i) {
      const char c = char(32 + random_() % 95);
      // Letters that ask for something that takes long, or quick characters, are not noise.
      if (std::string("!~`?MmGgB$").find(c) == std::string::npos) line += c;
    }
    return line;
  }

  std::mt19937 random_;
};

std::vector<Step> conversation(unsigned seed, const Step& manner) {
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  steps.push_back(manner);
  if (manner.kind == Step::kSend) steps.push_back({Step::kExpect, "ok", manner.text});
  steps.push_back({Step::kAsk, "answers from now", "start"});
  Lines lines(seed);
  const int count = 80;
  for (int i = 1; i <= count; ++i) {
    const std::string line = lines.any();
    steps.push_back({Step::kSend, line, line});
    steps.push_back({Step::kAsk, "await " + std::to_string(i), line});
  }
  steps.push_back({Step::kAsk, "wait 2", "end"});
  steps.push_back({Step::kAsk, "answers " + std::to_string(count), "end"});
  return steps;
}

/// How many conversations; PLUMB_CONVERSATIONS asks for more, for a long run by hand.
unsigned conversations() {
  const char* const asked = std::getenv("PLUMB_CONVERSATIONS");
  return asked ? unsigned(std::atoi(asked)) : 30;
}

class AnyLine : public testing::TestWithParam<unsigned> {};

}  // namespace

TEST_P(AnyLine, IsAnsweredOnce) {
  HostMachine machine(conversation(GetParam(), {Step::kSend, "$70=1", "errors only"}));
  EXPECT_EQ("", machine.play());
}

TEST_P(AnyLine, IsAnsweredOnceOrHaltsUntilStop) {
  std::vector<Step> steps = conversation(GetParam(), {Step::kAsk, "stop-when-halted", "halts"});
  steps.push_back({Step::kAsk, "halts 1", "end"});
  EXPECT_EQ("", HostMachine(steps).play());
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyLine, testing::Range(1u, conversations() + 1));

TEST(Settings, ComeBackAsTheyWereSentInAnyForm) {
  std::vector<Step> steps = readScript("test/dialogues", "setup.inc");
  const std::pair<const char*, const char*> values[] = {
      {"$3=463.1", "$3=463.1 (*"},    {"$12=8113.73 ", "$12=8113.73 (*"},
      {"$27=0.28", "$27=0.28 (*"},    {"$13=63.50000000000001", "$13=63.5 (*"},
      {"$22=1e-05", "$22=1e-5 (*"},   {"$2=2978.40123456", "$2=2978.40*"},
      {"$15=800.0000", "$15=800 (*"}, {"$40=-0.15", "$40=-0.15 (*"},
  };
  for (const auto& [sent, shown] : values) {
    steps.push_back({Step::kSend, sent, sent});
    steps.push_back({Step::kSkipTo, "ok", sent});
  }
  for (const auto& [sent, shown] : values) {
    steps.push_back({Step::kSend, "$$", sent});
    steps.push_back({Step::kSkipTo, shown, sent});
    steps.push_back({Step::kSkipTo, "ok", sent});
  }
  steps.push_back({Step::kAsk, "wait 2", "end"});
  steps.push_back({Step::kAsk, "answers from now", "end"});
  EXPECT_EQ("", HostMachine(steps).play());
}
