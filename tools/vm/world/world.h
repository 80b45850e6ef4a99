// A whole machine without its firmware: motors, chains, sled, sheet and time. The firmware, built
// for the host or flashed on a simulated Mega, drives it and reads its encoders.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "reference/across.h"
#include "world/motor.h"
#include "world/sheet.h"
#include "world/sled.h"

namespace world {

/// The motors, used as an index.
enum Axis { kLeft, kRight, kZ, kAxisCount };

/// Numbers of a world.
struct Parts {
  std::map<std::string, double> numbers;  ///< of the judge's machine, where they differ
  double friction = 0;                    ///< [N] of the sled on the sheet
  unsigned seed = 0;                      ///< for random motors; 0: nominal motors
  bool over_top = true;      ///< the chains leave over the top of the sprockets, else below
  double motor_step = 1e-4;  ///< [s] of the motors' computation
  double hang_every = 0.01;  ///< [s] in which a chain moves at most 0.3 mm
};

/// The machine in its garage.
class World {
 public:
  /// Begins with chains of `paid_out` [mm], the bit touching the sheet. Throws
  /// std::invalid_argument where no sled can hang, or for a number that the judge does not know.
  World(const Parts& parts, double paid_out);

  /// Drives a motor with a duty of -255 to 255. A positive duty turns a sprocket so that it winds
  /// in a chain over its top and pays out a chain below; it lowers the bit.
  void drive(Axis axis, int duty);
  /// Shorts the winding of a motor, until it is driven again or let go by a duty of zero.
  void brake(Axis axis);
  /// Encoder counts since the world began. They rise as a chain over the top is paid out, as a
  /// chain below is wound in, and as the bit rises.
  int32_t count(Axis axis) { return senses_[axis] * motors_[axis].counts(); }

  /// Lets time pass: a millisecond at most.
  void advance(double seconds);

  double seconds() const { return seconds_; }
  /// [mm] Nominal links that a motor has paid out; for z the height of the bit.
  double travel(Axis axis) const;
  /// [mm] The same where the motor stands after its power has gone now.
  double travelAtRest(Axis axis) const {
    return travel(axis) + motors_[axis].turnsToRest() * per_turn_[axis];
  }
  int duty(Axis axis) const { return duties_[axis]; }
  const Sled& sled() const { return sled_; }
  Sheet& sheet() { return sheet_; }
  bool probeTouches() const { return travel(kZ) <= probe_height_; }

  // Changes by hand, and faults.
  /// Lays the chains on other teeth: the sprockets do not turn, but the links on them change.
  void slip(Axis axis, double links_mm) { laid_[axis] += links_mm; }
  /// Sets the chains so that this sled's bit is at a place [mm].
  void hangAt(const Eigen::Vector2d& place);
  /// Takes the sled off and hooks the chain of a motor on the other motor's sprocket, `beyond` [mm]
  /// of links past its 12 o'clock, so that `slack` [mm] are out beyond the motor gap. Throws
  /// std::invalid_argument where the judge finds no such chain, or for chains off the bottom.
  void hookAcross(Axis axis, double slack, double beyond);
  /// Hangs the sled on its chains again.
  void unhook();
  /// The chain that is hooked across; without pull where none is.
  const reference::Across& across() const { return across_; }
  /// Gives a number of the judge's machine a new value.
  void set(const std::string& number, double value) { sled_.set(number, value); }
  Wires& wires(Axis axis) { return motors_[axis].wires; }
  /// Pays out this much of a chain by hand while its motor has no power.
  void pull(Axis axis, double mm_per_second) {
    motors_[axis].by_hand = mm_per_second / per_turn_[axis] * kTurn;
  }
  /// Lowers the motors' supply by this much below 12 V.
  void weakenSupply(double volts) { lacking_ = volts; }
  void setProbeHeight(double z) { probe_height_ = z; }

 private:
  void hang();
  void tighten();
  bool isHookedAcross() const { return hooked_ != kZ; }
  double radius() const;  // [m] of a sprocket
  /// Whether the sled has moved enough, or waited long enough, to be hung again.
  bool isDue(double step);

  Sled sled_;
  reference::Across across_;
  Sheet sheet_;
  std::array<Motor, kAxisCount> motors_;
  std::array<int, kAxisCount> duties_ = {{0, 0, 0}};
  // [mm] of nominal links that a sprocket pays out, and of the z axis' screw
  std::array<double, kAxisCount> per_turn_ = {{63.5, 63.5, 3.17}};
  std::array<int, kAxisCount> senses_;   // +1, or -1 for a motor that turns the other way
  std::array<double, kAxisCount> laid_;  // [mm] of travel when the motors began
  Eigen::Vector2d hung_on_ = Eigen::Vector2d::Zero();  // [mm] both chains when the sled was hung
  double seconds_ = 0, hung_ = 0, looked_ = 0, probe_height_ = -1e9;
  double lacking_ = 0;  // [V] of the motors' supply
  double hang_every_;   // [s]
  Axis hooked_ = kZ;    // the motor whose chain is hooked across; kZ: none is
  double beyond_ = 0;   // [mm] of that chain's links past 12 o'clock
  double held_at_ = 0;  // [mm] travel of the motor that held the chain's end, when hooked
  bool is_over_top_ = true;
  bool hangs_ = false;
};

}  // namespace world
