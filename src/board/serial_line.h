// The serial line to the computer: 57,600 baud as the Mega's USB chip makes it, buffered both ways.
#pragma once

#include "machine/ports.h"

namespace board {

/// UART 0. Its buffers are shared with the interrupts.
class SerialLine : public machine::Wire {
 public:
  void begin();
  int16_t read() override;
  void write(char character) override;
  uint8_t lost() override;
};

}  // namespace board
