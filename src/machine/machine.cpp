// The machine's parts, and its start after power-on.
#include "machine.h"

namespace machine {

Machine::Machine(const Ports& ports, const BoardName& board)
    : Waiting(ports.clock, axes_, planner_, course_),
      wire_(ports.wire),
      out_(ports.wire),
      values_(ports.table, value_room_),
      memory_(ports.bytes, values_),
      axes_(ports.drives, ports.clock),
      course_(axes_),
      keeper_(memory_, axes_),
      cutter_(ports.aux, values_),
      greeting_(board, out_),
      answers_(out_, values_),
      place_(out_, axes_, geometry_, planner_, keeper_, memory_, modal_, program_),
      reports_(ports.clock, modal_, axes_, input_, out_),
      telemetry_(ports.drives, ports.aux, ports.clock, axes_, planner_, place_, memory_, values_,
                 out_, board.start),
      motors_(axes_, keeper_, values_, place_, geometry_, out_, *this),
      spindle_(cutter_, ports.aux, out_, *this),
      z_(memory_, values_, axes_, place_, modal_, out_, answers_),
      door_(values_, axes_, place_, answers_),
      new_values_(values_, geometry_, axes_, planner_, ports.drives, cutter_, place_, ports.clock,
                  out_),
      settings_lines_(memory_, values_, new_values_, out_, answers_, *this),
      coordinates_(memory_, values_, modal_, place_, program_, out_, answers_),
      operator_lines_(course_, input_, modal_, axes_, motors_, z_, door_, coordinates_, ports.clock,
                      out_, answers_, *this),
      pauses_(operator_lines_, input_, modal_, spindle_, place_, out_, *this),
      moves_(values_, geometry_, planner_, motors_, coordinates_, program_, z_, door_, cutter_,
             pauses_, modal_, out_, answers_, *this),
      drilling_(modal_, coordinates_, program_, z_, moves_, answers_, *this),
      single_axis_(values_, geometry_, axes_, planner_, motors_, place_, z_, door_, ports.aux,
                   program_, modal_, out_, answers_, *this),
      axis_tests_(axes_, values_, out_, motors_, place_, *this),
      aux_(ports.aux) {}

void Machine::begin() {
  const settings::Started started = memory_.start();
  axes_.simulate(values_.at(kSimulatedMotors) != 0);
  // The control tick's rate is read once: a new rate counts after a reset.
  ticks_per_second_ = values_.at(kLoopRate) > 150 ? 200 : 100;
  axes_.setTicksPerSecond(ticks_per_second_);
  new_values_.takeAll();
  modal_.feed = values_.at(kGreatestFeed) / 2;
  greeting_.sayBoard();
  greeting_.sayMotors(axes_.isSimulated());
  greeting_.sayStart();
  greeting_.saySource(started);
  new_values_.sayCarriedTwice();
  greeting_.sayReady();
  place_.restore(started);
  telemetry_.noteStart();
}

}  // namespace machine
