// Interfaces of a board: the hardware, or a simulated board on the host.
#pragma once

#include <Settings.h>
#include <stdint.h>

namespace machine {

/// The three motors, used as an index.
enum Axis : uint8_t { kLeftAxis, kRightAxis, kZAxis, kAxisCount };

/// Why the firmware started.
enum class Start : uint8_t {
  kUsual,     ///< power-on, the reset button, or a computer that opened the line
  kBrownOut,  ///< the processor's supply had broken down
  kWatchdog,  ///< the firmware hung
};

/// The serial line to the computer, both ways.
class Wire {
 public:
  /// The next character that came in, 0 to 255, or -1.
  virtual int16_t read() = 0;
  /// Sends a character; waits only if the line's buffer is full.
  virtual void write(char character) = 0;
  /// How many characters were lost since the last call because they were not read in time.
  virtual uint8_t lost() = 0;

 protected:
  ~Wire() = default;
};

/// Motors and their encoders.
class Drives {
 public:
  /// Drives a motor with a duty of -255 to 255; positive winds chain in and makes its count fall.
  virtual void drive(Axis axis, int16_t duty) = 0;
  /// Takes the power off a motor: it runs on freely.
  virtual void release(Axis axis) = 0;
  /// Takes the power off a motor and shorts its winding: what it generates brakes it.
  virtual void brake(Axis axis) = 0;
  /// Encoder count: rises as chain is paid out, and wraps round.
  virtual uint16_t count(Axis axis) = 0;
  /// How often both channels of an encoder changed at once, so that its direction is unknown: an
  /// edge was missed, or noise came in. Wraps round.
  virtual uint16_t illegalSteps(Axis axis) = 0;
  /// Sets how the chains leave their sprockets, and which of the published PWM frequencies
  /// ($39: 1, 2, 3) to use. Motors stand still meanwhile.
  virtual void arrange(bool over_top, uint8_t pwm_choice) = 0;

 protected:
  ~Drives() = default;
};

/// Outputs for tools.
enum class Output : uint8_t { kSpindle, kLaser };

/// Everything else that is connected to the shield.
class Aux {
 public:
  /// Sets an output high or low.
  virtual void set(Output output, bool high) = 0;
  /// Pulses an output: high for `level` / 255 of the time.
  virtual void pulse(Output output, uint8_t level) = 0;
  /// Holds the spindle's servo at an angle [degrees]; kNoServo stops its pulses.
  virtual void turnServo(uint8_t degrees) = 0;
  /// Whether the probe touches.
  virtual bool probeTouches() = 0;
  /// Whether the driver of a motor reports an error; some drivers never can.
  virtual bool driverFails(Axis) { return false; }
  /// The processor's reference voltage in 1/1024 of its supply; 0 until it is measured.
  virtual uint16_t bandGap() { return 0; }

 protected:
  ~Aux() = default;
};

const uint8_t kNoServo = 255;

/// Time, and the control tick that interrupts the main program.
class Clock {
 public:
  /// [ms] since the start, wrapping round.
  virtual uint32_t milliseconds() = 0;
  /// To be called wherever the main program waits, to show that it is alive.
  virtual void idle() = 0;
  /// To be called when the main program has nothing left to do: the processor may sleep for up to a
  /// millisecond.
  virtual void sleep() {}
  /// Keeps the control tick off while shared numbers are read or written; nests.
  virtual void holdTicks() = 0;
  virtual void releaseTicks() = 0;
  /// [us] Longest time from when a control tick was due until it was over, since the last call; 0
  /// where it is not measured.
  virtual uint16_t longestTick() { return 0; }
  /// Whether the stack has kept out of the program's data since the start. If not, the tick does
  /// not run any more, and the board has taken the power off the motors.
  virtual bool isStackWhole() { return true; }

 protected:
  ~Clock() = default;
};

/// Interfaces of a board that the machine needs.
struct Ports {
  Wire& wire;
  Drives& drives;
  Aux& aux;
  Clock& clock;
  settings::Bytes& bytes;
  const settings::Table& table;
};

/// Keeps the control tick off for the life of this object.
class WithoutTicks {
 public:
  explicit WithoutTicks(Clock& clock) : clock_(clock) { clock_.holdTicks(); }
  ~WithoutTicks() { clock_.releaseTicks(); }
  WithoutTicks(const WithoutTicks&) = delete;
  WithoutTicks& operator=(const WithoutTicks&) = delete;

 private:
  Clock& clock_;
};

}  // namespace machine
