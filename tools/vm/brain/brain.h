// The interface of a firmware that drives a world, for both builds of the firmware.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace brain {

/// A firmware with its serial line and its memory. It begins without power.
class Brain {
 public:
  virtual ~Brain() = default;

  /// Lets time pass, for the firmware and for the world that it drives. `is_enough` is asked after
  /// each millisecond; it may look at all and send, but not stop the firmware.
  virtual void advance(int milliseconds, const std::function<bool()>& is_enough) = 0;
  void advance(int milliseconds) {
    advance(milliseconds, [] { return false; });
  }
  /// Switches power on, or releases the reset button.
  virtual void start() = 0;
  /// Switches power off at once, also that of the motors. The EEPROM keeps its bytes.
  virtual void stop() = 0;
  virtual bool isRunning() const = 0;

  /// Puts the board on another motor shield from the next start on: 2 for v1.2, 3 for v1.3.
  virtual void setShield(int version) = 0;

  /// Sends characters to the firmware; they arrive at 57,600 baud.
  virtual void send(const std::string& characters) = 0;
  /// Everything that the firmware has sent since the last call.
  virtual std::string takeSaid() = 0;

  virtual std::vector<uint8_t> eeprom() const = 0;
  /// Only while the firmware does not run.
  virtual void setEeprom(const std::vector<uint8_t>& bytes) = 0;

  // Faults.
  /// As stop(), but a byte of the EEPROM that is being written is left half written. `draw` picks
  /// the bits that change.
  virtual void cutPower(unsigned draw) = 0;
  /// The next edges of an encoder come in pairs, this many times, so that their direction is
  /// unknown.
  virtual void missEdges(int axis, int pairs) = 0;
  /// The main program hangs for this long; interrupts go on.
  virtual void delayProgram(int milliseconds) = 0;
  /// [V] The processor's supply, 5 if all is well.
  virtual void setSupply(double volts) = 0;

  // Outputs.
  /// How much of the time, in 255ths, the spindle's pin and the laser's are high.
  virtual int spindle() = 0;
  virtual int laser() = 0;
  /// [degrees] of the spindle's servo; 255 where nothing holds it.
  virtual int servo() = 0;
};

}  // namespace brain
