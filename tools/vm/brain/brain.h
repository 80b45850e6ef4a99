// The firmware in its machine: what drives a world, whichever way it was built.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace brain {

/// A firmware with its serial line and its memory. It begins without power.
class Brain {
 public:
  virtual ~Brain() = default;

  /// Lets so many milliseconds pass, for the firmware and for the world that it drives.
  virtual void advance(int milliseconds) = 0;
  /// Power comes, or the reset button is let go.
  virtual void start() = 0;
  /// Power goes at once; motors lose theirs. What the EEPROM holds outlives it.
  virtual void stop() = 0;
  virtual bool isRunning() const = 0;

  /// Puts characters on the line to the firmware; they arrive at 57,600 baud.
  virtual void send(const std::string& characters) = 0;
  /// All that the firmware has said since this was last asked.
  virtual std::string takeSaid() = 0;

  virtual std::vector<uint8_t> eeprom() const = 0;
  /// Only while it does not run.
  virtual void setEeprom(const std::vector<uint8_t>& bytes) = 0;
};

}  // namespace brain
