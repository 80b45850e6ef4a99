// The numbers of a machine by name, so that tests and programs can give it faults.
#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "reference/machine.h"

namespace reference {

/// The field of each number of a machine. Names of a chain's numbers begin with `left.` or
/// `right.`.
inline std::map<std::string, double*> numbersOf(Machine& machine) {
  std::map<std::string, double*> numbers = {
      {"motor_gap", &machine.motor_gap},
      {"motor_height", &machine.motor_height},
      {"motor_center_x", &machine.motor_center_x},
      {"height_difference", &machine.height_difference},
      {"sprocket_radius", &machine.sprocket_radius},
      {"rotation_radius", &machine.rotation_radius},
      {"sled_weight", &machine.sled_weight},
      {"lean", &machine.lean},
      {"plane_gap", &machine.plane_gap},
      {"bit_right", &machine.bit_from_ring.x()},
      {"bit_up", &machine.bit_from_ring.y()},
      {"push_right", &machine.push.x()},
      {"push_up", &machine.push.y()},
  };
  for (ChainSide* side : {&machine.left, &machine.right}) {
    const std::string whose = side == &machine.left ? "left." : "right.";
    numbers[whose + "weight"] = &side->weight;
    numbers[whose + "compliance"] = &side->compliance;
    numbers[whose + "inward"] = &side->inward;
    numbers[whose + "downward"] = &side->downward;
    numbers[whose + "eccentric_x"] = &side->eccentricity.x();
    numbers[whose + "eccentric_y"] = &side->eccentricity.y();
    side->visit([&](const char* name, double& number) { numbers[whose + name] = &number; });
  }
  return numbers;
}

/// The field of a number among numbersOf(). Throws for a name that the judge does not know.
inline double& field(const std::map<std::string, double*>& numbers, const std::string& name) {
  const auto number = numbers.find(name);
  if (number == numbers.end())
    throw std::invalid_argument("the judge has no number " + name +
                                ": add its mechanics and its name to tools/judge/reference "
                                "(links.h for what changes the count of links)");
  return *number->second;
}

}  // namespace reference
