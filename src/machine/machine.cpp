// The machine's parts, and its start after power-on.
#include "machine.h"

namespace machine {

Machine::Machine(const Ports& ports, const BoardName& board)
    : Waiting(ports.clock, base_.axes, base_.planner, base_.course),
      base_(ports, *this),
      greeting_(board, base_.out),
      place_(base_),
      reports_(ports.clock, base_.modal, base_.axes, base_.input, base_.out),
      telemetry_(base_, place_, board.start),
      motors_(base_, place_),
      spindle_(base_),
      z_(base_, place_),
      door_(base_, place_),
      new_values_(base_, place_),
      settings_lines_(base_, new_values_),
      coordinates_(base_, place_),
      operator_lines_(base_, motors_, z_, door_, coordinates_, *this),
      pauses_(base_, operator_lines_, spindle_, place_),
      moves_(base_, motors_, coordinates_, z_, door_, pauses_),
      drilling_(base_, coordinates_, z_, moves_),
      single_axis_(base_, motors_, place_, z_, door_),
      axis_tests_(base_, motors_, place_) {}

void Machine::begin() {
  const settings::Started started = base_.memory.start();
  base_.axes.simulate(base_.values.at(kSimulatedMotors) != 0);
  // The control tick's rate is read once: a new rate counts after a reset.
  ticks_per_second_ = base_.values.at(kLoopRate) > 150 ? 200 : 100;
  base_.axes.setTicksPerSecond(ticks_per_second_);
  new_values_.takeAll();
  base_.modal.feed = base_.values.at(kGreatestFeed) / 2;
  greeting_.sayBoard();
  greeting_.sayMotors(base_.axes.isSimulated());
  greeting_.sayStart();
  greeting_.saySource(started);
  new_values_.sayCarriedTwice();
  greeting_.sayReady();
  place_.restore(started);
  telemetry_.noteStart();
}

}  // namespace machine
