// The firmware built for the host: the same src/machine and lib/, without a Mega.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "brain/brain.h"
#include "brain/simulated_eeprom.h"
#include "machine/greeting.h"
#include "machine/ports.h"
#include "world/world.h"

namespace machine {
class Machine;
}

namespace brain {

/// The firmware's main program in a separate thread. Only a single thread runs at a time: the
/// program's thread runs while a caller waits in advance().
class HostBrain : public Brain,
                  private machine::Wire,
                  private machine::Drives,
                  private machine::Aux,
                  private machine::Clock {
 public:
  /// `world` must live as long as this object; an L298 drives its motors.
  explicit HostBrain(world::World& world,
                     const machine::BoardName& board = {2, "", machine::Start::kUsual})
      : world_(world), board_(board) {}
  ~HostBrain() override { stop(); }
  HostBrain(const HostBrain&) = delete;
  HostBrain& operator=(const HostBrain&) = delete;

  using Brain::advance;
  void advance(int milliseconds, const std::function<bool()>& is_enough) override;
  void start() override;
  void stop() override;
  bool isRunning() const override { return program_.joinable(); }
  /// Its pins and wires are the same on every shield.
  void setShield(int) override {}
  void send(const std::string& characters) override;
  std::string takeSaid() override;
  std::vector<uint8_t> eeprom() const override { return eeprom_.bytes; }
  void setEeprom(const std::vector<uint8_t>& bytes) override { eeprom_.bytes = bytes; }
  void cutPower(unsigned draw) override;
  void missEdges(int axis, int pairs) override { encoders_[axis].to_miss += pairs; }
  void delayProgram(int milliseconds) override { late_ms_ = milliseconds; }
  void setSupply(double volts) override { supply_ = volts; }
  int spindle() override { return levels_[int(machine::Output::kSpindle)]; }
  int servo() override { return servo_; }
  int laser() override { return levels_[int(machine::Output::kLaser)]; }

  /// From now on a due tick falls into any gap of the main program: where it allows ticks again or
  /// asks the board for something. Without this, ticks fall only where the main program waits.
  void letTicksFallAnywhere(uint32_t seed) { chance_ = seed | 1; }
  /// The firmware's machine, between its start and the end of its power.
  const machine::Machine* machine() const { return ticked_; }
  const SimulatedEeprom& memory() const { return eeprom_; }

 private:
  struct PowerGone {};

  /// Count of an encoder's edges by the board.
  struct Encoder {
    int32_t at = 0;        ///< the world's count at the last look
    uint16_t counted = 0;  ///< since the start
    uint16_t illegal = 0;  ///< steps of two edges at once
    int to_miss = 0;       ///< such steps to come
  };

  // The firmware's interfaces.
  int16_t read() override;
  void write(char character) override;
  uint8_t lost() override;
  void drive(machine::Axis axis, int16_t duty) override {
    world_.drive(world::Axis(axis), senseOf(axis) * duty);
  }
  void release(machine::Axis axis) override { world_.drive(world::Axis(axis), 0); }
  void brake(machine::Axis axis) override { world_.brake(world::Axis(axis)); }
  uint16_t count(machine::Axis axis) override;
  uint16_t illegalSteps(machine::Axis axis) override { return encoders_[axis].illegal; }
  void arrange(bool over_top, uint8_t) override { over_top_ = over_top; }
  void set(machine::Output output, bool high) override { pulse(output, high ? 255 : 0); }
  void pulse(machine::Output output, uint8_t level) override {
    passGap();
    levels_[int(output)] = level;
  }
  void turnServo(uint8_t degrees) override { servo_ = degrees; }
  bool probeTouches() override { return world_.probeTouches(); }
  bool driverFails(machine::Axis axis) override {
    return world_.wires(world::Axis(axis)).driver_complains;
  }
  uint16_t bandGap() override;
  uint32_t milliseconds() override {
    passGap();
    return now_ms_;
  }
  void idle() override;
  void holdTicks() override { ++holds_; }
  void releaseTicks() override {
    --holds_;
    passGap();
  }

  /// The wires of a chain off the bottom are taken the other way.
  int senseOf(machine::Axis axis) const { return over_top_ || axis == machine::kZAxis ? 1 : -1; }
  void live();
  void noteAlive();
  void awaitTurn();
  void handBack();
  void passMillisecond();
  void receive();
  void callTick();
  void runTick();
  void passGap();
  void letGo();

  world::World& world_;
  machine::BoardName board_;
  SimulatedEeprom eeprom_;
  std::string input_, received_, said_;
  double byte_credit_ = 0, supply_ = 5;
  int out_queue_ = 0, lost_ = 0, late_ms_ = 0;
  uint32_t now_ms_ = 0;
  Encoder encoders_[machine::kAxisCount];
  uint8_t levels_[2] = {0, 0}, servo_ = 255;
  machine::Machine* ticked_ = nullptr;
  bool over_top_ = true;  ///< as the firmware has arranged the wires
  int tick_every_ms_ = 10;
  uint32_t chance_ = 0;  ///< 0: ticks fall only where the main program waits
  int holds_ = 0, gaps_to_pass_ = 0;
  bool is_tick_due_ = false, is_ticking_ = false;
  int silent_ticks_ = 0;   ///< since the main program last called idle()
  bool has_hung_ = false;  ///< the main program is back from a hang; its next idle() counts

  // For handing over between both threads.
  std::thread program_;
  std::mutex mutex_;
  std::condition_variable turn_;
  std::atomic<int> left_ms_{0};  // milliseconds until the program hands back
  std::function<bool()> is_enough_;
  bool is_cut_off_ = false;  // the program shall end at its next wait
  std::exception_ptr failure_;
};

}  // namespace brain
