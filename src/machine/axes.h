// The three axes at the control tick: set-points and encoder counts in, duties out. And the main
// program's view of them.
#pragma once

#include "ticked_axis.h"

namespace machine {

using motion::AxisLoop;
using motion::SetPoint;

/// All three axes.
///
/// tick() runs in the control interrupt. All other functions are for the main program; they keep
/// the tick off while they touch numbers that it uses.
class Axes {
 public:
  Axes(Drives& drives, Clock& clock)
      : clock_(clock), axis_{{drives, kLeftAxis}, {drives, kRightAxis}, {drives, kZAxis}} {}

  /// Sets how often tick() is called. To be called once, before prepare().
  void setTicksPerSecond(float ticks) {
    seconds_per_tick_ = 1 / ticks;
    ticks_ahead_ = AxisLoop::ticksAhead(seconds_per_tick_);
  }

  /// Takes over scales, gains and limits. Returns whether the scale changed, so that counts mean
  /// other lengths. A new scale holds for travel from now on: lengths stay, and nothing moves.
  bool prepare(const settings::Values& values);

  /// One control tick.
  void tick();

  // Set-points.
  motion::SetPoints& setPoints() { return set_points_; }
  /// Whether no set-point waits and none is in progress.
  bool isEmpty() const;
  /// Set-points that wait to be taken.
  uint8_t waiting() const { return set_points_.count(); }
  void dropSetPoints();
  /// Brakes everything, the path and z's own motion, and holds it. Only Course calls this, and
  /// goOn().
  void stand();
  /// The path goes on.
  void goOn();
  /// To be called repeatedly at the end of a path: whether it was played, and z is near it, or has
  /// stopped coming nearer.
  bool isZNear();
  /// Whether the path rests, for now; z may still move.
  bool isPathAtRest() const;
  /// Whether nothing moves, for now.
  bool isAtRest() const;
  /// From now on goes at `share` 256ths of the planned speed; see motion::Playback.
  void goAt(uint16_t share);

  /// Strength of a laser at this tick; 0 while motors are simulated.
  uint8_t beam() const { return isSimulated() ? 0 : playback_.beam(); }

  /// Whether the feed yielded much since the last call, because an axis fell behind.
  bool hasYielded();

  // Z during a hold.
  /// Moves z away from its planned height to the height `z` [mm], with `speed` [mm/s] and
  /// `acceleration` [mm/s^2].
  void lift(float z, float speed, float acceleration);
  /// Moves z back to its planned height; speed and acceleration as above.
  void lower(float speed, float acceleration);
  bool isLifted() const;
  float plannedZ() const;  ///< [mm] planned height
  float liftedTo() const;  ///< [mm] height that z is going to
  /// Declares that z is at this height [mm]; the planned heights stay.
  void declareLifted(float z);
  /// The set-point taken last.
  SetPoint setPoint() const;
  /// Sets the set-points to the lengths that the encoders show.
  void standStill();
  /// Makes the set-point of an axis jump to a length [mm].
  void jumpTo(Axis axis, float length);
  float secondsPerTick() const { return seconds_per_tick_; }

  // Power.
  void follow();
  void release(Axis axis);
  void releaseAll();
  /// Takes the power off all motors, brakes them for half a second, and lets them go then.
  void brakeAll();
  void driveOpen(Axis axis, int16_t duty);
  void turn(Axis axis, float rpm);
  bool isPowered() const;
  /// Whether an axis is held to its set-points.
  bool isFollowing(Axis axis) const { return axis_[axis].mode() == AxisMode::kFollow; }
  /// Whether an encoder counted more than an edge at the last tick.
  bool isTurning() const;
  /// Whether a motor runs without its position loop.
  bool isDriven() const;
  /// Simulates the motors from now on: they take no power and follow exactly.
  void simulate(bool on);
  bool isSimulated() const { return axis_[kLeftAxis].isSimulated(); }
  /// Whether simulated motion has changed lengths, so that they are not those of the chains.
  bool isImagined() const;

  // Lengths.
  int32_t counts(Axis axis) const;
  /// Takes over counts: no motor has power then, so none drives to where its set-point was.
  void setCounts(int32_t left, int32_t right, int32_t z);
  float length(Axis axis) const;  ///< [mm] measured
  float target(Axis axis) const;  ///< [mm] set-point
  /// [mm] Largest error() in motion by set-points since the last call.
  float mostBehind(Axis axis);
  float error(Axis axis) const;           ///< [mm] measured less set-point
  void declare(Axis axis, float length);  ///< declares that the axis is at this length [mm]
  AxisState state(Axis axis) const;
  /// To be called when the drives were arranged again: their counters may have jumped.
  void forgetRawCounts();

  /// How often a chain may have slipped, since the start; see motion::SlipWatch. Wraps round.
  uint8_t slips(Axis chain) const { return slips_[chain]; }

  /// The worst fault since the last call, and its axis.
  struct AxisFault {
    motion::Fault fault;
    Axis axis;
  };
  AxisFault fault();
  /// Whether, since the axis last got power, a fault has proved its counts wrong.
  bool isDisproved(Axis axis) const { return axis_[axis].isDisproved(); }
  /// Whether the encoder of an axis missed many steps since a length was declared: the length is
  /// then wrong by more than an eighth of the position error's limit.
  bool hasMissedSteps(Axis axis) const { return axis_[axis].hasMissedSteps(); }

 private:
  void takeSetPoint();
  void watchForSlips();
  void forgetWay();
  /// [counts of motion::kCountsPerMm]
  int32_t plannedHeight() const { return axis_[kZAxis].setPoint() - lift_.at(); }
  void liftTo(int32_t goal, float speed, float acceleration);

  Clock& clock_;
  motion::SetPoints set_points_;
  motion::Playback playback_;
  motion::Lift lift_;
  motion::Yield yield_;
  volatile bool has_yielded_ = false;
  TickedAxis axis_[kAxisCount];
  motion::Pace paces_[kAxisCount];
  motion::SlipWatch slip_watches_[kZAxis];  ///< of the chains
  volatile uint8_t slips_[kZAxis] = {0, 0};
  float nearest_z_ = 0;      ///< [mm] off the end of a way
  uint32_t nearest_ms_ = 0;  ///< when z was asked for at that distance
  float seconds_per_tick_ = 0.01f;
  uint8_t ticks_ahead_ = AxisLoop::ticksAhead(0.01f);
};

}  // namespace machine
