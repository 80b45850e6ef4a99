// Plays a dialogue: a simulated board around the firmware's machine, in simulated time.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "brain/simulated_eeprom.h"
#include "machine/ports.h"
#include "reference/machine.h"
#include "simulated_motor.h"
#include "vm/line_match.h"
#include "vm/script.h"

/// What went wrong, with the line of the dialogue.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown out of the firmware's main program, wherever it waits.
struct PowerGone {};
struct TheEnd {};

/// The board, its motors and the computer at the other end of the wire.
class Stage : public machine::Wire,
              public machine::Drives,
              public machine::Aux,
              public machine::Clock {
 public:
  explicit Stage(std::vector<Step> steps);

  // The firmware's interfaces.
  int16_t read() override;
  void write(char character) override;
  uint8_t lost() override { return 0; }
  void drive(machine::Axis axis, int16_t duty) override;
  void release(machine::Axis axis) override;
  void brake(machine::Axis axis) override;
  uint16_t count(machine::Axis axis) override;
  uint16_t illegalSteps(machine::Axis axis) override { return motor_[axis].illegal; }
  void arrange(bool over_top, uint8_t pwm_choice) override;
  void set(machine::Output output, bool high) override;
  void pulse(machine::Output output, uint8_t level) override;
  void turnServo(uint8_t degrees) override { servo = degrees; }
  bool probeTouches() override { return motor_[machine::kZAxis].travel <= probe_touches_at_; }
  bool driverFails(machine::Axis axis) override { return motor_[axis].complains; }
  uint16_t bandGap() override { return uint16_t(1.1 * 1024 / supply_ + 0.5); }
  uint32_t milliseconds() override {
    passGap();
    return uint32_t(now_ms_);
  }
  void idle() override;
  void holdTicks() override { ++holds_; }
  void releaseTicks() override {
    --holds_;
    passGap();
  }

  /// From now on a due tick falls into any gap of the main program: where it allows ticks again or
  /// asks the board for something. Without this, ticks fall only where the main program waits.
  void letTicksFallAnywhere(uint32_t seed) { chance_ = seed | 1; }

  /// Called every control tick, as the interrupt would be.
  std::function<void()> tick = [] {};
  /// Called every millisecond, for tests that watch the machine.
  std::function<void()> look = [] {};
  SimulatedEeprom eeprom;
  uint8_t servo = machine::kNoServo;

  /// The motors as they truly are, and what was reported last.
  SimulatedMotor& motor(machine::Axis axis) { return motor_[axis]; }
  const std::string& status() const { return latest_status_; }
  long milliseconds_since_status() const { return now_ms_ - status_ms_; }
  std::string whereInTheScript() const;

  /// What is left after a power cut.
  void restart();

 private:
  void passMillisecond();
  void passGap();
  void runTick();
  void callTick();
  void takeLine(const std::string& line);
  bool takeStep(const Step& step);
  bool expect(const Step& step);
  bool skipTo(const Step& step);
  bool ask(const Step& step);
  bool change(const std::string& verb, const std::string& rest);
  bool wait(const std::string& seconds);
  bool askHold(double most);
  static bool isLevel(const std::string& wanted, int level);
  void askSled(const std::string& place);
  void askChains(const std::string& lengths);
  void hang(const std::string& place);
  void hook(SimulatedMotor& motor, double slack);
  void declare();
  void tellOr(bool holds, const std::string& what);
  SimulatedMotor& motorNamed(const std::string& name);
  [[noreturn]] void fail(const std::string& why) const;

  std::vector<Step> steps_;
  std::size_t at_ = 0;
  long now_ms_ = 0, step_since_ms_ = 0, last_line_ms_ = 0, status_ms_ = 0;
  std::deque<std::string> lines_;
  std::string partial_, latest_status_, latest_errors_, input_;
  double byte_credit_ = 0;
  uint32_t chance_ = 0;  ///< 0: ticks fall only where the main program waits
  int holds_ = 0, gaps_to_pass_ = 0;
  bool is_tick_due_ = false, is_ticking_ = false;
  int out_queue_ = 0, answers_ = 0, halts_ = 0;
  bool stops_when_halted_ = false;
  double held_x_ = 0, held_y_ = 0;  // of the bit when a hold was asked for
  bool is_holding_ = false;
  double probe_touches_at_ = -1e9;
  double supply_ = 5;            // [V]
  int spindle_ = 0, laser_ = 0;  // 255ths of the time
  reference::Machine judge_;
  SimulatedMotor motor_[machine::kAxisCount];
};
