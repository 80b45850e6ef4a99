// One axis at the control tick: its encoder is read, and its motor gets a duty.
#pragma once

#include <Motion.h>
#include <Settings.h>

#include "axis_scale.h"
#include "ports.h"

namespace machine {

/// Mode of an axis.
enum class AxisMode : uint8_t {
  kOff,     ///< no power
  kFollow,  ///< follows its set-points
  kTurn,    ///< turns at a speed
  kOpen,    ///< driven at a duty
};

/// An axis as it was at the last tick, for the tests of the loops.
struct AxisState {
  float rpm;         ///< measured
  float wanted_rpm;  ///< output of the position loop
  int16_t duty;
};

/// One axis: where it is, where it shall be, and the loops that bring it there.
///
/// Lengths are in mm, or "fine": in the counts of a set-point, motion::kCountsPerMm. tick() runs in
/// the control interrupt; callers of the other functions keep the tick off.
class TickedAxis {
 public:
  TickedAxis(Drives& drives, Axis axis) : drives_(drives), axis_(axis) {}

  /// Takes over scale, gains and limits. Returns whether the scale changed; lengths stay.
  bool prepare(const settings::Values& values, float seconds_per_tick);

  /// Reads the encoder and sets the duty. Returns how far [fine] the axis is off its set-point, if
  /// its position loop holds it there; else 0.
  int32_t tick();

  // The set-point.
  int32_t setPoint() const { return set_point_; }  ///< [fine]
  void setSetPoint(int32_t at) { set_point_ = at; }
  /// [fine] Change of the set-point in a tick soon to come.
  int32_t asked() const { return asked_; }
  void ask(int32_t change) { asked_ = change; }
  /// Sets the set-point to the length that the encoder shows. The drive begins at zero: that of
  /// before would go on if the encoder is lost, as it shows no error then.
  void standStill() {
    set_point_ = measured();
    loop_.rest();
  }

  // The length.
  int32_t counts() const { return counts_; }
  void setCounts(int32_t counts) { counts_ = counts; }
  float length() const { return scale_.lengthOf(counts_); }  ///< [mm] measured
  int32_t error() const { return measured() - set_point_; }  ///< [fine]
  /// [fine] Largest distance from the set-point while it was followed, since the last call.
  int32_t mostBehind();
  /// Declares that the axis is at this length [mm], and shall be.
  void declare(float length);
  /// The encoder's counter may have jumped.
  void forgetRawCount();
  /// Whether the encoder missed many steps since a length was declared.
  bool hasMissedSteps() const;

  // Power.
  AxisMode mode() const { return mode_; }
  void follow();
  void release();
  /// Takes the power off the motor, and shorts its winding for this number of ticks.
  void brake(uint8_t ticks);
  void driveOpen(int16_t duty);
  void turn(float rpm);
  int16_t duty() const { return duty_; }
  AxisState state() const { return {loop_.rpm(), loop_.wanted(), duty_}; }
  /// Whether the encoder counted more than an edge at the last tick.
  bool isTurning() const { return moved_ > 1 || moved_ < -1; }

  // Simulation of the motor.
  /// From now on the motor takes no power and follows exactly, or not any more.
  void simulate(bool on);
  bool isSimulated() const { return is_simulated_; }
  /// Whether simulated motion has changed the length, so that it is not that of the chain.
  bool isImagined() const { return is_imagined_; }

  // Faults.
  /// The worst fault since the last call.
  motion::Fault fault();
  /// Whether, since the axis last got power, a fault has proved its counts wrong.
  bool isDisproved() const { return is_disproved_; }

 private:
  void readEncoder();
  int32_t followSetPoint(float turned);
  void letGoInTime();
  void note(motion::Fault seen);
  int32_t measured() const { return scale_.fineOf(counts_); }
  void forgetMissed() { missed_before_ = drives_.illegalSteps(axis_); }

  Drives& drives_;
  const Axis axis_;
  AxisMode mode_ = AxisMode::kOff;
  bool is_held_ = true;  ///< the position loop has a gain; without a gain nothing is watched
  uint8_t braking_ = 0;  ///< [ticks] until a motor without power is let go
  bool is_simulated_ = false;
  volatile bool is_imagined_ = false;
  motion::Fault fault_ = motion::Fault::kNone;
  volatile bool is_disproved_ = false;
  uint16_t raw_ = 0;   ///< encoder, as last read
  int16_t moved_ = 0;  ///< [encoder counts] at the last tick
  int16_t duty_ = 0;
  int32_t counts_ = 0;       ///< [encoder counts] since zero length
  int32_t set_point_ = 0;    ///< [fine]
  int32_t asked_ = 0;        ///< [fine]
  int32_t most_behind_ = 0;  ///< [fine]
  AxisScale scale_;
  int16_t astray_ = 0;          ///< [encoder counts] that the motor turned while it was simulated
  uint16_t missed_before_ = 0;  ///< illegal steps when a length was declared
  uint16_t most_missed_ = 0;    ///< illegal steps beyond which a length is wrong
  float rpm_ = 0;               ///< commanded with kTurn
  motion::AxisLoop loop_;
  motion::Watch watch_;
};

}  // namespace machine
