// A board on which nothing happens but the start and two questions.
#include "awakened.h"

#include <cstdio>
#include <stdexcept>

#include "host_machine.h"

namespace {

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
  HostMachine machine({});
  machine.brain.setEeprom(eeprom);
  machine.brain.start();
  const auto ask = [&](const char* question, const char* answer) {
    const int kPatience = 300;  // [ms]
    std::string said;
    machine.brain.send(question);
    machine.brain.advance(kPatience, [&] {
      said += machine.brain.takeSaid();
      for (const world::Axis axis : {world::kLeft, world::kRight, world::kZ})
        if (machine.world.duty(axis) != 0) throw std::runtime_error("it drives a motor");
      return holds(said, answer);
    });
    return said;
  };
  Belief belief = {false, 0, 0, 0, ask("", "WPos")};
  belief.is_known = holds(belief.said, "position loaded at:") && !holds(belief.said, "ALARM");
  const std::string place = belief.said.substr(belief.said.rfind("MPos:") + 5);
  float x, y, z;
  if (std::sscanf(place.c_str(), "%f,%f,%f", &x, &y, &z) != 3) throw std::runtime_error(place);
  belief.z = double(z);
  belief.left = numberAfter(ask("B10 L\n", "\nok"), "[Measure: ");
  belief.right = numberAfter(ask("B10 R\n", "\nok"), "[Measure: ");
  return belief;
}
