// How the machine is put together, and what it does once after power-on.
#include "machine.h"

namespace machine {

Machine::Machine(const Ports& ports, const BoardName& board)
    : wire_(ports.wire),
      drives_(ports.drives),
      aux_(ports.aux),
      clock_(ports.clock),
      board_(board),
      out_(ports.wire),
      table_(ports.table),
      values_(table_, value_room_),
      memory_(ports.bytes, values_),
      axes_(ports.drives, ports.clock),
      keeper_(memory_, axes_),
      cutter_(aux_, values_),
      offsets_(values_.from(kFirstPlaceSetting)) {}

void Machine::begin() {
  const settings::Started started = memory_.start();
  axes_.simulate(values_.at(kSimulatedMotors) != 0);
  // The control tick's rate is taken over once: a new one counts after a reset.
  ticks_per_second_ = values_.at(kLoopRate) > 150 ? 200 : 100;
  axes_.setTicksPerSecond(ticks_per_second_);
  axes_.prepare(values_);
  mover_.prepare(values_, axes_.secondsPerTick());
  geometry_.prepare(values_);
  mover_.setGeometry(geometry_);
  arrangeDrives();
  cutter_.off();
  modal_.feed = values_.at(kGreatestFeed) / 2;
  greet();
  sayMotors();
  sayStart();
  saySource(started);
  sayReady();
  restorePosition(started);
}

}  // namespace machine
