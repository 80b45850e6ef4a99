// A whole machine without its firmware: motors, chains, sled, sheet and time. The firmware, built
// for the host or flashed on a simulated Mega, drives it and reads its encoders.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <string>

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
  double chain_per_turn = 63.5;           ///< [mm] of nominal links that a sprocket pays out
  double z_per_turn = 3.17;               ///< [mm] of the z axis' screw
};

/// The machine in its garage.
class World {
 public:
  /// Begins with chains of `paid_out` [mm], the bit touching the sheet. Throws
  /// std::invalid_argument where no sled can hang, or for a number that the judge does not know.
  World(const Parts& parts, double paid_out);

  /// Drives a motor with a duty of -255 to 255; a positive duty winds chain in, or the bit down.
  void drive(Axis axis, int duty);
  /// Encoder counts since the world began. They rise as chain is paid out, and as the bit rises.
  int32_t count(Axis axis) { return motors_[axis].counts(); }

  /// Lets time pass: a millisecond at most.
  void advance(double seconds);

  double seconds() const { return seconds_; }
  /// [mm] Nominal links that a motor has paid out; for z the height of the bit.
  double travel(Axis axis) const;
  int duty(Axis axis) const { return duties_[axis]; }
  const Sled& sled() const { return sled_; }
  Sheet& sheet() { return sheet_; }
  /// Whether a sled can hang from these chains.
  bool hangs() const { return hangs_; }
  bool probeTouches() const { return travel(kZ) <= probe_height_; }

  // Changes by hand, and faults.
  /// Lays the chains on other teeth: the sprockets do not turn, but the links on them change.
  void slip(Axis axis, double links_mm) { laid_[axis] += links_mm; }
  /// Sets the chains so that this sled's bit is at a place [mm].
  void hangAt(const Eigen::Vector2d& place);
  /// Turns the screw by hand until the bit is at a height [mm].
  void setHeight(double z) { laid_[kZ] += z - travel(kZ); }
  /// Gives a number of the judge's machine a new value, or lets it creep by an amount each second.
  void set(const std::string& number, double value) { sled_.set(number, value); }
  void creep(const std::string& number, double per_second) { creeps_[number] = per_second; }
  Wires& wires(Axis axis) { return motors_[axis].wires; }
  /// Somebody pays out so much of a chain while its motor has no power.
  void pull(Axis axis, double mm_per_second) {
    motors_[axis].by_hand = mm_per_second / per_turn_[axis] * kTurn;
  }
  /// Lets the motors' supply be so much lower than 12 V.
  void weakenSupply(double volts) { lacking_ = volts; }
  void setProbeHeight(double z) { probe_height_ = z; }

 private:
  void hang();
  /// Whether the sled has moved enough, or waited long enough, to be hung again.
  bool isDue(double step);

  Sled sled_;
  Sheet sheet_;
  std::array<Motor, kAxisCount> motors_;
  std::array<int, kAxisCount> duties_ = {{0, 0, 0}};
  std::array<double, kAxisCount> per_turn_;            // [mm]
  std::array<double, kAxisCount> laid_;                // [mm] of travel when the motors began
  std::map<std::string, double> creeps_;               // change of each number in a second
  Eigen::Vector2d hung_on_ = Eigen::Vector2d::Zero();  // [mm] both chains when the sled was hung
  double seconds_ = 0, hung_ = 0, looked_ = 0, probe_height_ = -1e9;
  double lacking_ = 0;  // [V] of the motors' supply
  bool hangs_ = false;
};

}  // namespace world
