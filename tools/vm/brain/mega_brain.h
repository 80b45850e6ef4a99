// The firmware as it is flashed: the ELF file in a simulated Mega whose pins drive the world's
// motors.
#pragma once

#include <memory>

#include "brain/brain.h"
#include "mega/pins.h"
#include "mega/pulse_meter.h"
#include "world/world.h"

namespace brain {

/// A Mega with a motor shield.
class MegaBrain : public Brain {
 public:
  /// `elf` is the file to flash, `bootloader` the bytes of what starts first and may flash another.
  /// `world` must live as long as this object. Throws std::runtime_error if the file cannot be
  /// read.
  MegaBrain(world::World& world, std::string elf, std::string bootloader = "");
  ~MegaBrain() override = default;

  using Brain::advance;
  void advance(int milliseconds, const std::function<bool()>& is_enough) override;
  void start() override;
  void stop() override;
  bool isRunning() const override { return board_ != nullptr; }
  void setShield(int version) override;
  void send(const std::string& characters) override { board_->send(characters); }
  std::string takeSaid() override;
  std::vector<uint8_t> eeprom() const override { return board_ ? board_->eeprom() : eeprom_; }
  void setEeprom(const std::vector<uint8_t>& bytes) override { eeprom_ = bytes; }
  /// The simulated Mega writes a byte of its EEPROM at once, so that none is left half written.
  void cutPower(unsigned) override { stop(); }
  void missEdges(int axis, int pairs) override { encoders_.of[axis].miss(pairs); }
  void delayProgram(int milliseconds) override;
  void setSupply(double volts) override;
  int spindle() override { return spindle_ ? spindle_->level() : 0; }
  int servo() override { return board_ ? vm::servoOf(*board_) : vm::kLoose; }
  int laser() override { return laser_ ? laser_->level() : 0; }

  /// The board while it has power.
  vm::VirtualBoard& board() { return *board_; }
  /// Makes the main program hang where it begins its next report.
  void hangInReport() { hangs_in_report_ = true; }
  bool willHang() const { return hangs_in_report_; }

 private:
  void passMillisecond();
  void turnEncoders();

  world::World& world_;
  const vm::ShieldPins* shield_ = &vm::kShield2;
  std::string elf_, bootloader_;
  std::vector<uint8_t> flash_;  ///< what the bootloader left; empty: as in the file
  std::vector<uint8_t> eeprom_ = std::vector<uint8_t>(4096, 0xff);
  std::unique_ptr<vm::VirtualBoard> board_;
  std::unique_ptr<vm::PulseMeter> spindle_, laser_;
  vm::Encoders encoders_;
  bool hangs_in_report_ = false;
  int late_ms_ = 0;    ///< until the main program goes on
  double supply_ = 5;  ///< [V]
};

}  // namespace brain
