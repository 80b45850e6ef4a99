// The firmware built for the host: the same machine and the same laws, without a Mega.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "brain/brain.h"
#include "brain/simulated_eeprom.h"
#include "machine/ports.h"
#include "world/world.h"

namespace brain {

/// The firmware's main program in a thread of its own. Only one thread runs at a time: the
/// program's runs while somebody waits in advance().
class HostBrain : public Brain,
                  private machine::Wire,
                  private machine::Drives,
                  private machine::Aux,
                  private machine::Clock {
 public:
  /// `world` must live as long as this.
  explicit HostBrain(world::World& world) : world_(world) {}
  ~HostBrain() override { stop(); }
  HostBrain(const HostBrain&) = delete;
  HostBrain& operator=(const HostBrain&) = delete;

  void advance(int milliseconds) override;
  void start() override;
  void stop() override;
  bool isRunning() const override { return program_.joinable(); }
  void send(const std::string& characters) override;
  std::string takeSaid() override;
  std::vector<uint8_t> eeprom() const override { return eeprom_.bytes; }
  void setEeprom(const std::vector<uint8_t>& bytes) override { eeprom_.bytes = bytes; }

 private:
  struct PowerGone {};

  // What the firmware sees.
  int16_t read() override;
  void write(char character) override;
  uint8_t lost() override { return 0; }
  void drive(machine::Axis axis, int16_t duty) override { world_.drive(world::Axis(axis), duty); }
  void release(machine::Axis axis) override { world_.drive(world::Axis(axis), 0); }
  uint16_t count(machine::Axis axis) override;
  uint16_t illegalSteps(machine::Axis) override { return 0; }
  void arrange(bool, uint8_t) override {}
  void set(machine::Output, bool) override {}
  void pulse(machine::Output, uint8_t) override {}
  void turnServo(uint8_t) override {}
  bool probeTouches() override { return world_.probeTouches(); }
  uint32_t milliseconds() override { return now_ms_; }
  void idle() override;
  void holdTicks() override {}
  void releaseTicks() override {}

  void live();
  void awaitTurn();
  void handBack();
  void passMillisecond();

  world::World& world_;
  SimulatedEeprom eeprom_;
  std::string input_, said_;
  double byte_credit_ = 0;
  int out_queue_ = 0;
  uint32_t now_ms_ = 0;
  int32_t counts_at_start_[machine::kAxisCount] = {};
  void (*tick_)(void* machine) = nullptr;
  void* ticked_ = nullptr;
  int tick_every_ms_ = 10;

  // The hand-over between both threads.
  std::thread program_;
  std::mutex mutex_;
  std::condition_variable turn_;
  std::atomic<int> left_ms_{0};  // until the program hands back
  bool is_cut_off_ = false;      // the program shall end where it waits
  std::exception_ptr failure_;
};

}  // namespace brain
