// The machine: what a line from the computer makes the motors do, and all it says meanwhile.
// Knows no Arduino; what it needs of a board stands in ports.h.
#pragma once

#include "axes.h"
#include "geometry.h"
#include "input.h"
#include "mover.h"
#include "ports.h"
#include "printer.h"
#include "settings_table.h"

namespace machine {

/// What the machine is built of.
struct Ports {
  Wire& wire;
  Drives& drives;
  Aux& aux;
  Clock& clock;
  settings::Bytes& bytes;
};

/// Which motor shield was found; without one no motor is ever driven.
struct BoardName {
  uint8_t version;   ///< N of "v1.N"
  const char* driver;  ///< as the greeting names it; null: no shield is known by its straps
};

/// Where the tool is [mm].
struct Place {
  float x, y, z;
};

/// Why motion is refused until somebody acts.
enum class Halt : uint8_t {
  kNone,
  kStopped,  ///< `!`: for as long as the stop takes
  kAlarm,    ///< an alarm: until `!` or ctrl-X
};

/// One Maslow. Commands run to their end in the main program; wherever one waits, service() keeps
/// quick characters, reports, set-points and memory going, and a stop makes every wait return
/// false.
class Machine {
 public:
  Machine(const Ports& ports, const BoardName& board);

  /// Once after power-on: settings and position are read, the greeting is said.
  void begin();

  /// One round of the main program: at most one line is executed.
  void loop();

  /// The control tick; called by an interrupt, a hundred or two hundred times a second.
  void tick() { axes.tick(); }

  bool wantsFastTicks() const { return values.at(kLoopRate) > 100; }
 
 private:
};

}  // namespace machine
