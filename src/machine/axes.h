// The three axes at the control tick: set-points and encoder counts in, duties out; and what the
// main program may ask and tell meanwhile.
#pragma once

#include <Motion.h>
#include <Settings.h>

#include "ports.h"

namespace machine {

using motion::AxisLoop;
using motion::Gains;
using motion::SetPoint;

/// [mm] No axis reaches farther; twice as much still fits the counts of a set-point.
const float kMostTravel = 16000;

/// What an axis does.
enum class AxisMode : uint8_t {
  kOff,     ///< no power
  kFollow,  ///< its set-points
  kTurn,    ///< at a speed
  kOpen,    ///< at a duty
};

/// An axis as it was at the last tick, for the tests of the loops.
struct AxisState {
  float rpm;         ///< measured
  float wanted_rpm;  ///< what the position loop asks for
  int16_t duty;
};

/// All three axes.
///
/// tick() runs in the control interrupt. Everything else is for the main program; what touches
/// numbers that the tick uses holds it off.
class Axes {
 public:
  Axes(Drives& drives, Clock& clock) : drives_(drives), clock_(clock) {}

  /// How often tick() is called; once, before prepare().
  void setTicksPerSecond(float ticks) {
    seconds_per_tick_ = 1 / ticks;
    ticks_ahead_ = AxisLoop::ticksAhead(seconds_per_tick_);
  }

  /// Takes over scales, gains and limits; whether counts mean other lengths now. A new scale holds
  /// for travel from now on: all lengths stay what they are, and nothing moves.
  bool prepare(const settings::Values& values);

  /// One control tick.
  void tick();

  // Set-points.
  motion::SetPoints& setPoints() { return set_points_; }
  /// Nothing moves, nothing waits.
  bool isEmpty() const;
  /// Set-points that wait to be taken.
  uint8_t waiting() const { return set_points_.count(); }
  void dropSetPoints();
  /// Brakes along the way and stays, or goes on.
  void hold(bool yes);
  /// Nothing goes on along the way, for now.
  bool isAtRest() const;
  /// From now on at so many 256ths of the planned speed, see motion::Playback.
  void goAt(uint16_t share);

  /// How strong a laser is at this tick; none where motors run in imagination.
  uint8_t beam() const { return simulated_ ? 0 : playback_.beam(); }

  /// Whether the feed yielded much since this was last asked, as an axis fell behind.
  bool hasYielded();

  // Z while the way is held.
  /// Moves z away from where the way has it, to a height [mm]; [mm/s], [mm/s^2].
  void lift(float z, float speed, float acceleration);
  /// Moves it back.
  void lower();
  bool isLifted() const;
  float plannedZ() const;  ///< [mm] where the way has it
  float liftedTo() const;  ///< [mm] where it is going
  /// Z is at this height [mm]; the way keeps its heights.
  void declareLifted(float z);
  /// The set-points last taken.
  SetPoint setPoint() const;
  /// Makes the set-points what the encoders say.
  void standStill();
  /// Makes one set-point jump [mm].
  void jumpTo(Axis axis, float length);
  float secondsPerTick() const { return seconds_per_tick_; }

  // Power.
  void follow();
  void release(Axis axis);
  void releaseAll();
  void driveOpen(Axis axis, int16_t duty);
  void turn(Axis axis, float rpm);
  bool isPowered() const;
  /// Whether a motor runs without its position loop.
  bool isDriven() const;
  /// Lets motors run in imagination only.
  void simulate(bool on);
  bool isSimulated() const { return simulated_; }
  /// Whether lengths are other than the chains' since motors began to run in imagination.
  bool isImagined() const { return is_imagined_; }

  // Lengths.
  int32_t counts(Axis axis) const;
  void setCounts(int32_t left, int32_t right, int32_t z);
  float length(Axis axis) const;  ///< [mm] measured
  float target(Axis axis) const;  ///< [mm] set-point
  /// [mm] Largest error() in motion by set-points since this was last asked.
  float mostBehind(Axis axis);
  float error(Axis axis) const;           ///< [mm] measured less set-point
  void declare(Axis axis, float length);  ///< the axis is at this length [mm]
  AxisState state(Axis axis) const;
  /// After drives were arranged anew: their counters may have jumped.
  void forgetRawCounts();

  /// What was noticed since this was last asked; the worst of it.
  motion::Fault fault();
  /// Whether a fault was noticed that proves the counts of an axis wrong, since it was last
  /// powered.
  bool isDisproved(Axis axis) const { return (disproved_ & (1 << axis)) != 0; }
  /// Whether its encoder missed so many steps, since a length was declared, that the length is
  /// wrong by more than an eighth of the position error's limit.
  bool hasMissedSteps(Axis axis) const;

 private:
  struct One {
    AxisMode mode = AxisMode::kOff;
    int8_t sign = 1;      ///< of drive against count
    bool is_held = true;  ///< its position loop has a gain; without one nothing is watched
    uint16_t raw = 0;     ///< encoder, as last read
    int16_t moved = 0;    ///< [encoder counts] at the last tick
    int16_t duty = 0;
    uint16_t missed_before = 0;  ///< illegal steps when a length was declared
    uint16_t most_missed = 0;    ///< illegal steps beyond which a length is wrong
    int32_t most_counts = 0;     ///< [encoder counts] of kMostTravel
    int32_t counts = 0;          ///< [encoder counts] since zero length
    int32_t set_point = 0;       ///< [counts of motion::kCountsPerMm]
    int32_t most_behind = 0;     ///< [counts of motion::kCountsPerMm]
    int32_t asked = 0;           ///< by how much a tick soon to come will change it
    int16_t astray = 0;          ///< [encoder counts] turned for real while motion is imagined
    float per_count = 1;         ///< [mm] may be negative
    float turns_per_count = 1;
    float turns_per_mm = 1;
    float turns_per_fine = 1;  ///< per count of motion::kCountsPerMm
    float fine_per_count = 1;  ///< counts of motion::kCountsPerMm per encoder count
    float rpm = 0;             ///< asked for with kTurn
    AxisLoop loop;
    motion::Watch watch;
  };

  void takeSetPoint();
  void forgetWay();
  void readEncoder(One& one, Axis axis);
  void control(One& one, Axis axis);
  int32_t measured(const One& one) const;
  void note(motion::Fault seen, Axis axis);
  void imagine(One& one, int32_t counts);
  void forgetMissed(Axis axis) { axis_[axis].missed_before = drives_.illegalSteps(axis); }
  static int32_t countsOf(const One& one, float length);

  Drives& drives_;
  Clock& clock_;
  motion::SetPoints set_points_;
  motion::Playback playback_;
  motion::Lift lift_;
  motion::Yield yield_;
  int32_t worst_off_ = 0;  ///< [counts of motion::kCountsPerMm] of any axis at this tick
  volatile bool has_yielded_ = false;
  One axis_[kAxisCount];
  float seconds_per_tick_ = 0.01f;
  uint8_t ticks_ahead_ = AxisLoop::ticksAhead(0.01f);
  volatile motion::Fault fault_ = motion::Fault::kNone;
  volatile uint8_t disproved_ = 0;  ///< a bit for each axis
  bool simulated_ = false;
  volatile bool is_imagined_ = false;
};

}  // namespace machine
