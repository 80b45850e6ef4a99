// A board on which nothing happens but the start and three questions.
#include "awakened.h"

#include <cstdio>
#include <stdexcept>

#include "brain/simulated_eeprom.h"
#include "machine/machine.h"
#include "settings_flash.h"

namespace {

class StillBoard : public machine::Wire,
                   public machine::Drives,
                   public machine::Aux,
                   public machine::Clock {
 public:
  int16_t read() override {
    if (input.empty()) return -1;
    const char c = input.front();
    input.erase(0, 1);
    return uint8_t(c);
  }
  void write(char character) override { said += character; }
  uint8_t lost() override { return 0; }
  void drive(machine::Axis, int16_t) override { throw std::runtime_error("it drives a motor"); }
  void release(machine::Axis) override {}
  void brake(machine::Axis) override {}
  uint16_t count(machine::Axis) override { return 0; }
  uint16_t illegalSteps(machine::Axis) override { return 0; }
  void arrange(bool, uint8_t) override {}
  void set(machine::Output, bool) override {}
  void pulse(machine::Output, uint8_t) override {}
  void turnServo(uint8_t) override {}
  bool probeTouches() override { return false; }
  uint32_t milliseconds() override { return now_ms; }
  void idle() override {
    ++now_ms;
    eeprom.advance(1000);
  }
  void holdTicks() override {}
  void releaseTicks() override {}

  SimulatedEeprom eeprom;
  std::string input, said;
  uint32_t now_ms = 0;
};

/// The last number behind a text, as it was said.
double numberAfter(const std::string& said, const std::string& text) {
  const std::size_t at = said.rfind(text);
  if (at == std::string::npos) throw std::runtime_error("no " + text + " in " + said);
  return std::atof(said.c_str() + at + text.size());
}

bool holds(const std::string& said, const char* text) {
  return said.find(text) != std::string::npos;
}

}  // namespace

Belief awaken(const std::vector<uint8_t>& eeprom) {
  StillBoard board;
  board.eeprom.bytes = eeprom;
  const FlashTable table;
  machine::Machine machine({board, board, board, board, board.eeprom, table}, {2, ""});
  machine.begin();
  Belief belief = {false, 0, 0, 0, board.said};
  belief.is_known = holds(board.said, "position loaded at:") && !holds(board.said, "ALARM");
  const auto ask = [&](const char* question, const char* answer) {
    board.said.clear();
    board.input = question;
    for (int i = 0; i < 300 && board.said.find(answer) == std::string::npos; ++i) machine.loop();
    return board.said;
  };
  belief.left = numberAfter(ask("B10 L\n", "\nok"), "[Measure: ");
  belief.right = numberAfter(ask("B10 R\n", "\nok"), "[Measure: ");
  const std::string status = ask("", "WPos");
  const std::string place = status.substr(status.rfind("MPos:") + 5);
  float x, y, z;
  if (std::sscanf(place.c_str(), "%f,%f,%f", &x, &y, &z) != 3) throw std::runtime_error(status);
  belief.z = double(z);
  return belief;
}
